//! From facts to the text of `gcheck.toml`: comments and order of what is there stay.
//!
//! Knows: TOML with its comments, units of the file that is written. Must not know: where facts come from, how files are written.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, TableLike};

use super::sheet::{Fact, Tells, Value, is_rotary, rounded, unit_name};
use super::{FileFacts, Surroundings};
use crate::config::{self, Units};
use crate::{Problem, paths};

/// How a new file begins.
const HEADING: &str = "# Configuration of gcheck for the programs in this folder and below.\n";
/// Longer comments are cut.
const LONGEST_COMMENT: usize = 100;
/// Axes of a machine that names none.
const USUAL_AXES: [&str; 3] = ["X", "Y", "Z"];

/// The text with the facts in it.
#[derive(Debug, Default)]
pub(crate) struct Merged {
    pub(crate) text: String,
    /// Values that are new or other than before.
    pub(crate) written: usize,
    /// Values that were there already, the same.
    pub(crate) same: usize,
    /// What is there with another value, in words.
    pub(crate) kept: Vec<String>,
    /// Values for all axes that gave way to values by axis, in words.
    pub(crate) opened: Vec<String>,
}

/// The file that is written.
pub(crate) struct Target<'t> {
    pub(crate) path: &'t Path,
    /// What is in it; empty where there is none.
    pub(crate) before: &'t str,
    pub(crate) overwrite: bool,
    pub(crate) surroundings: &'t Surroundings,
}

/// Puts the facts of files into the text of a configuration.
///
/// # Errors
/// The text cannot be read, its lengths have no unit, facts contradict each other, or the result would not do.
pub(crate) fn merge(
    target: &Target<'_>,
    files: &[FileFacts],
    control: Option<&str>,
) -> Result<Merged, Problem> {
    let shown = paths::shown_from_here(target.path);
    config::check_text(target.path, target.before)?;
    let plain = target.before.trim_start_matches('\u{FEFF}').replace("\r\n", "\n");
    let mut document: DocumentMut = plain.parse().map_err(|error: toml_edit::TomlError| {
        Problem::at(&shown, &plain, &error.span().unwrap_or(0..0), error.message().to_owned())
    })?;
    let units = units_of(target, &shown, files)?;
    let facts = facts(target, &shown, files, control, units.as_ref())?;
    let mut merging = Merging {
        merged: Merged::default(),
        shown: &shown,
        overwrite: target.overwrite,
        blocked: BTreeSet::new(),
        axes: axes(&facts, target.surroundings),
        keys: facts.iter().map(|fact| fact.key.clone()).collect(),
    };
    for fact in &facts {
        merging.put(&mut document, fact);
    }
    let mut merged = merging.merged;
    let gives_rapids = facts.iter().any(|fact| fact.key.get(1).is_some_and(|key| key == "rapid"));
    if let (Some((rate, file)), true) = (&target.surroundings.inherited_rapid, gives_rapids) {
        merged.opened.push(format!(
            "machine.rapid is {rate} in {file} for every linear axis, and by axis in {shown}: axes without one are as fast as the fastest"
        ));
    }
    let mut text = document.to_string();
    if plain.trim().is_empty() {
        let text_alone = text.trim_start();
        text = format!("{HEADING}{}{text_alone}", if text_alone.starts_with('[') { "\n" } else { "" });
    }
    config::check_text(target.path, &text)
        .map_err(|problem| problem.note(format!("this is {shown} as it would be; it was left as it is")))?;
    if target.before.contains("\r\n") {
        text = text.replace('\n', "\r\n");
    }
    if target.before.starts_with('\u{FEFF}') {
        text.insert(0, '\u{FEFF}');
    }
    merged.text = text;
    Ok(merged)
}

/// A fact in the unit of the file that is written.
struct Ready {
    key: Vec<String>,
    value: toml_edit::Value,
    comment: String,
    /// Where it is from, as messages say it.
    place: String,
}

/// What lengths of the configuration count in.
struct InForce {
    units: Units,
    /// Where the unit is from, if it is to be written.
    from: Option<String>,
}

/// What lengths of the configuration count in; `None` where no length is imported and it does not say.
///
/// A unit that is written is also that of programs without a code for it, so it is never that of a library or table.
fn units_of(target: &Target<'_>, shown: &str, files: &[FileFacts]) -> Result<Option<InForce>, Problem> {
    let surroundings = target.surroundings;
    if let Some(units) = surroundings.units {
        return Ok(Some(InForce { units, from: None }));
    }
    let Some(first) = files.iter().find(|file| file.has_lengths()) else { return Ok(None) };
    let own = |tells: Tells| {
        let file = files.iter().find(|file| file.tells == tells && file.units.is_some())?;
        Some((file.units?, file.units_from.clone()))
    };
    let power_on = surroundings.power_on.as_ref();
    let chosen = surroundings
        .told
        .map(|units| (units, "--config".to_owned()))
        .or_else(|| own(Tells::Machine))
        .or_else(|| power_on.map(|(units, control)| (*units, format!("{control}, its unit at power-on"))))
        .or_else(|| own(Tells::Offsets));
    let Some((units, from)) = chosen else {
        let of_file = first.units.map_or("units", unit_name);
        let message = format!(
            "its lengths count in {of_file}, which does not tell the unit of the machine, and {shown} does not say it"
        );
        let help = "name the unit of the machine, which is also that of programs without a code for it: \
            `--config machine.units=mm` or `--config machine.units=inch`";
        return Err(Problem::with_file(Path::new(&first.shown), message).help(help));
    };
    if let Some(key) = &surroundings.length
        && power_on.is_none_or(|(own, _)| *own != units)
    {
        let message = format!(
            "`{key}` is a length, and `[machine] units` is missing: imported lengths cannot be put beside it"
        );
        let help = "write `units = \"mm\"` or `units = \"inch\"` into its [machine]";
        return Err(Problem::with_file(Path::new(shown), message).help(help));
    }
    Ok(Some(InForce { units, from: Some(from) }))
}

/// Axes of the machine: as configured, else as imported, else the usual ones.
fn axes(facts: &[Ready], surroundings: &Surroundings) -> Vec<String> {
    let imported = facts.iter().find(|fact| fact.key == ["machine", "axes"]);
    let imported = imported.and_then(|fact| fact.value.as_array());
    let imported =
        imported.map(|names| names.iter().filter_map(|name| name.as_str()).map(str::to_owned).collect());
    let known = surroundings.axes.clone().or(imported);
    known.unwrap_or_else(|| USUAL_AXES.map(str::to_owned).to_vec())
}

/// All facts, in the unit of the configuration; each key once.
fn facts(
    target: &Target<'_>,
    shown: &str,
    files: &[FileFacts],
    control: Option<&str>,
    in_force: Option<&InForce>,
) -> Result<Vec<Ready>, Problem> {
    let mut ready = Facts::default();
    let plain = |key: &[&str], value: &str, comment: &str| Ready {
        key: key.iter().map(ToString::to_string).collect(),
        value: value.into(),
        comment: comment.to_owned(),
        place: comment.to_owned(),
    };
    if let Some(control) = control {
        ready.add(plain(&["control"], control, "--control"))?;
    }
    let units = in_force.map(|in_force| in_force.units);
    if let Some(InForce { units, from: Some(from) }) = in_force {
        ready.add(plain(&["machine", "units"], unit_name(*units), from))?;
        let machines = files.iter().filter(|file| file.tells == Tells::Machine);
        for (own, file) in machines.filter_map(|file| Some((file.units?, file))) {
            if target.surroundings.told.is_none() {
                ready.add(plain(&["machine", "units"], unit_name(own), &file.units_from))?;
            }
        }
    }
    for file in files {
        for fact in &file.facts {
            if let (Value::Table(_), Some(own)) = (&fact.value, file.units) {
                let other = target.surroundings.table_units.filter(|other| *other != own);
                if let Some(other) = other.filter(|_| !target.overwrite) {
                    let message = format!(
                        "the tool table counts in {}, and `machine.table_units` of {shown} is {}",
                        unit_name(own),
                        unit_name(other)
                    );
                    return Err(Problem::with_file(Path::new(&file.shown), message)
                        .help("`--overwrite` takes the unit of the imported table"));
                }
                if other.is_some() || (target.surroundings.table_units.is_none() && units != Some(own)) {
                    ready.add(plain(&["machine", "table_units"], unit_name(own), &file.units_from))?;
                }
            }
            let value = value(target, fact, file.units, units);
            let place = format!("{}:{}", file.shown, fact.line);
            ready.add(Ready { key: fact.key.clone(), value, comment: fact.from.clone(), place })?;
        }
    }
    Ok(ready.list)
}

/// Facts in their order, each key once.
#[derive(Default)]
struct Facts {
    list: Vec<Ready>,
    by_key: BTreeMap<Vec<String>, usize>,
}

impl Facts {
    /// Adds a fact; two that contradict each other are a problem.
    fn add(&mut self, fact: Ready) -> Result<(), Problem> {
        // Names of the same machine differ from file to file, and so do lists of its axes.
        let is_named = matches!(fact.key.last().map(String::as_str), Some("name" | "axes"));
        match self.by_key.get(&fact.key).and_then(|ix| self.list.get(*ix)) {
            None => {
                self.by_key.insert(fact.key.clone(), self.list.len());
                self.list.push(fact);
            }
            Some(other) if is_named || is_equal(&other.value, &fact.value) => {}
            Some(other) => {
                let key = fact.key.join(".");
                let message = format!(
                    "`{key}` is {} in {} and {} in {}",
                    told(&other.value),
                    other.place,
                    told(&fact.value),
                    fact.place
                );
                return Err(Problem::new(message).help(
                    "import the files one after the other, with `--overwrite` for the one that counts",
                ));
            }
        }
        Ok(())
    }
}

fn value(target: &Target<'_>, fact: &Fact, from: Option<Units>, to: Option<Units>) -> toml_edit::Value {
    let in_units = |length: f64| match (from, to) {
        (Some(Units::Mm), Some(Units::Inch)) => rounded(length / 25.4),
        (Some(Units::Inch), Some(Units::Mm)) => rounded(length * 25.4),
        _ => length,
    };
    let ends =
        |ends: [f64; 2]| toml_edit::Value::Array(ends.map(|end| end + 0.0).into_iter().collect::<Array>());
    match &fact.value {
        Value::Length(length) => (in_units(*length) + 0.0).into(),
        Value::Ends(both) => ends(both.map(in_units)),
        Value::Number(number) => (*number + 0.0).into(),
        Value::Count(count) => i64::from(*count).into(),
        Value::Plain(both) => ends(*both),
        Value::Text(text) => text.as_str().into(),
        Value::List(names) => names.iter().map(String::as_str).collect::<Array>().into(),
        Value::Table(path) => {
            let folder = paths::absolute(target.path);
            relative(path, folder.parent().unwrap_or(&folder)).into()
        }
    }
}

/// A path from a folder, with slashes; the path itself where both have nothing in common.
fn relative(path: &Path, folder: &Path) -> String {
    let common = path.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    let is_apart = !folder.components().take(common).any(|part| matches!(part, Component::Normal(_)));
    if is_apart && folder.components().count() > 1 {
        return paths::shown(path);
    }
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    let way: PathBuf = up.chain(path.components().skip(common)).collect();
    paths::shown(&way)
}

/// A value as messages show it.
fn told(value: &toml_edit::Value) -> String {
    let mut value = value.clone().decorated("", "");
    if let Some(array) = value.as_array_mut() {
        // On one line, without comments.
        array.fmt();
    }
    value.to_string()
}

fn is_equal(one: &toml_edit::Value, other: &toml_edit::Value) -> bool {
    #[expect(clippy::cast_precision_loss, reason = "no figure of a machine is as large")]
    let number =
        |value: &toml_edit::Value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    if let (Some(a), Some(b)) = (number(one), number(other)) {
        return (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
    }
    match (one.as_array(), other.as_array()) {
        (Some(a), Some(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_equal(a, b)),
        _ => one.as_str().is_some() && one.as_str() == other.as_str(),
    }
}

struct Merging<'m> {
    merged: Merged,
    shown: &'m str,
    overwrite: bool,
    /// Keys with a value where facts need a table; told once.
    blocked: BTreeSet<String>,
    /// Axes that the machine will have.
    axes: Vec<String>,
    /// Keys of all facts.
    keys: BTreeSet<Vec<String>>,
}

/// Where in a document a value goes.
#[derive(Clone, Copy)]
struct Spot<'s> {
    path: &'s [String],
    depth: usize,
    /// A comment ends the line, so none fits here.
    in_inline: bool,
}

impl Merging<'_> {
    fn put(&mut self, document: &mut DocumentMut, fact: &Ready) {
        self.put_in(document.as_item_mut(), fact, Spot { path: &fact.key, depth: 0, in_inline: false });
    }

    fn put_in(&mut self, parent: &mut Item, fact: &Ready, spot: Spot<'_>) {
        let is_inline = spot.in_inline || parent.is_inline_table();
        let Some(table) = parent.as_table_like_mut() else { return };
        let Some((name, rest)) = spot.path.split_first() else { return };
        // Axes are written in either case.
        let is_axis = spot.depth > 1 && !table.contains_key(name);
        let alike =
            table.iter().map(|(key, _)| key).filter(|_| is_axis).find(|key| key.eq_ignore_ascii_case(name));
        let name = alike.unwrap_or(name).to_owned();
        if rest.is_empty() {
            return self.leaf(table, &name, fact, is_inline);
        }
        let is_table = table.get(&name).is_some_and(Item::is_table_like);
        let mut outer = None;
        if let Some(old) = table.get(&name).filter(|_| !is_table) {
            let key = fact.key.iter().take(spot.depth + 1).cloned().collect::<Vec<_>>().join(".");
            if !self.overwrite {
                if self.blocked.insert(key.clone()) {
                    let old = old.as_value().map(told).unwrap_or_default();
                    self.kept(&key, &old, &fact.place, "gives it by axis");
                }
                return;
            }
            outer = self.open(table, &name, fact, is_inline);
        }
        if !table.contains_key(&name) {
            table.insert(&name, new_table(spot.depth, &fact.key, is_inline));
        }
        let Some(child) = table.get_mut(&name) else { return };
        let before = self.merged.written;
        self.put_in(child, fact, Spot { path: rest, depth: spot.depth + 1, in_inline: is_inline });
        if let (Some(outer), Some(rows)) = (outer, child.as_table_like_mut()) {
            outer.dress(rows);
        }
        if let (Some(inline), false, true) =
            (child.as_inline_table_mut(), is_inline, self.merged.written > before)
        {
            let decor = inline.decor_mut();
            let old = decor.suffix().and_then(|suffix| suffix.as_str()).unwrap_or_default();
            if !old.contains('#') {
                decor.set_suffix(comment(fact));
            }
        }
    }

    /// Makes the value of a key a table in its place. The linear axes that no fact is about keep the value.
    fn open(
        &mut self,
        table: &mut dyn TableLike,
        name: &str,
        fact: &Ready,
        is_inline: bool,
    ) -> Option<Outer> {
        let before = table.key(name).and_then(|key| key.leaf_decor().prefix()?.as_str()).unwrap_or_default();
        let before = before.to_owned();
        let item = table.get_mut(name)?;
        let old = item.as_value()?.clone();
        let way = fact.key.get(..fact.key.len() - 1).unwrap_or_default();
        let is_imported = |axis: &str| self.keys.contains(&[way, &[axis.to_owned()]].concat());
        let is_linear = |axis: &str| !axis.chars().next().is_some_and(is_rotary);
        let carried: Vec<&str> = self
            .axes
            .iter()
            .map(String::as_str)
            .filter(|axis| is_linear(axis) && !is_imported(axis))
            .collect();
        *item = new_table(1, &fact.key, is_inline);
        let rows = item.as_table_like_mut()?;
        for axis in &carried {
            let value = if is_inline { old.clone().decorated(" ", "") } else { old.clone() };
            rows.insert(axis, Item::Value(value));
        }
        let has_rows = !carried.is_empty();
        let stays = if has_rows { format!("; {} keep it", carried.join(", ")) } else { String::new() };
        let key = way.join(".");
        let told = told(&old);
        self.merged.opened.push(format!("{key} was {told} for every linear axis and is by axis{stays}"));
        let after = old.decor().suffix().and_then(|suffix| suffix.as_str()).unwrap_or_default().trim_end();
        let after = if has_rows { String::new() } else { after.to_owned() };
        (!is_inline).then_some(Outer { before, after })
    }

    fn leaf(&mut self, table: &mut dyn TableLike, name: &str, fact: &Ready, is_inline: bool) {
        let mut value = fact.value.clone();
        match table.get_mut(name) {
            None => {
                if is_inline {
                    close_up(table);
                } else {
                    value.decor_mut().set_suffix(comment(fact));
                }
                table.insert(name, Item::Value(value));
                self.merged.written += 1;
            }
            Some(item) => {
                let old = item.as_value();
                if old.is_some_and(|old| is_equal(old, &value)) {
                    self.merged.same += 1;
                    return;
                }
                let told_old = old.map_or_else(|| "a table".to_owned(), told);
                if !self.overwrite {
                    let says = format!("says {}", told(&value));
                    return self.kept(&fact.key.join("."), &told_old, &fact.place, &says);
                }
                if !is_inline {
                    let suffix =
                        old.and_then(|old| old.decor().suffix()?.as_str()).unwrap_or_default().trim_end();
                    let suffix = match own_comment(suffix) {
                        Some(own) => format!("{own}; from {}", cut(&fact.comment)),
                        None => comment(fact),
                    };
                    let prefix = old.and_then(|old| old.decor().prefix()?.as_str()).unwrap_or(" ").to_owned();
                    value.decor_mut().set_suffix(suffix);
                    value.decor_mut().set_prefix(prefix);
                }
                if let (Some(new), Some(old)) =
                    (value.as_array_mut(), old.and_then(toml_edit::Value::as_array))
                {
                    dress_array(new, old);
                }
                *item = Item::Value(value);
                self.merged.written += 1;
            }
        }
    }

    fn kept(&mut self, key: &str, old: &str, place: &str, says: &str) {
        self.merged.kept.push(format!("{key} is {old} in {}, and {place} {says}", self.shown));
    }
}

/// The blank before the brace of an inline table is not one before a comma.
fn close_up(table: &mut dyn TableLike) {
    let last = table.iter_mut().last().and_then(|(_, item)| item.as_value_mut());
    if let Some(decor) = last.map(toml_edit::Value::decor_mut)
        && decor.suffix().and_then(|suffix| suffix.as_str()).is_some_and(|suffix| suffix.trim().is_empty())
    {
        decor.set_suffix("");
    }
}

/// Comments of a key whose value has become a table.
struct Outer {
    /// Before the key: lines of its own.
    before: String,
    /// After the value, where no axis keeps it.
    after: String,
}

impl Outer {
    /// Gives the comments to the first row of the table.
    fn dress(self, rows: &mut dyn TableLike) {
        let Some(first) = rows.iter().next().map(|(key, _)| key.to_owned()) else { return };
        if let Some(mut key) = rows.key_mut(&first) {
            key.leaf_decor_mut().set_prefix(self.before);
        }
        if let (Some(value), true) =
            (rows.get_mut(&first).and_then(Item::as_value_mut), self.after.contains('#'))
        {
            let decor = value.decor_mut();
            let own = decor.suffix().and_then(|suffix| suffix.as_str()).unwrap_or_default();
            let own = own.trim_start_matches([' ', '#']).to_owned();
            decor.set_suffix(format!("{}; {own}", self.after));
        }
    }
}

/// Gives the elements of a new list the lines and comments of the old one.
fn dress_array(new: &mut Array, old: &Array) {
    let raw =
        |raw: Option<&toml_edit::RawString>| raw.and_then(|raw| raw.as_str()).unwrap_or_default().to_owned();
    let count = new.len();
    for (ix, value) in new.iter_mut().enumerate() {
        if let Some(old) = old.get(ix) {
            *value.decor_mut() = old.decor().clone();
        } else if let Some(last) = old.iter().last() {
            let prefix = raw(last.decor().prefix());
            // The comment is that of the other element; its line break and blanks are those of the list.
            let blank =
                prefix.rsplit_once('\n').map_or_else(|| " ".to_owned(), |(_, blank)| format!("\n{blank}"));
            value.decor_mut().set_prefix(if blank.contains('#') { "\n".to_owned() } else { blank });
        }
    }
    let lost = old
        .iter()
        .skip(count)
        .map(|value| [raw(value.decor().prefix()), raw(value.decor().suffix())].concat());
    let lost: String = lost.filter(|text| text.contains('#')).collect();
    new.set_trailing(format!("{lost}{}", old.trailing().as_str().unwrap_or_default()));
    new.set_trailing_comma(old.trailing_comma());
}

/// A table on the way to a key: a section, dotted keys of `[machine]`, an inline table of a tool or an offset.
fn new_table(depth: usize, key: &[String], is_inline: bool) -> Item {
    let is_machine = key.first().is_some_and(|section| section == "machine");
    if is_inline || (depth > 0 && !is_machine) {
        return Item::Value(InlineTable::new().into());
    }
    let mut table = Table::new();
    table.set_dotted(depth > 0);
    if depth == 0 {
        table.decor_mut().set_prefix("\n");
    }
    Item::Table(table)
}

/// The comment of a value, with the blanks before it.
fn comment(fact: &Ready) -> String {
    format!("  # from {}", cut(&fact.comment))
}

/// The comment after a value, with the blanks before it and without what earlier imports say in it; `None` if nothing is left.
fn own_comment(suffix: &str) -> Option<String> {
    let (blanks, text) = suffix.split_once('#')?;
    let of_import = |part: &&str| !part.trim_start().starts_with("from ");
    let own: Vec<&str> = text.split("; ").filter(of_import).collect();
    (!own.is_empty()).then(|| format!("{blanks}# {}", own.join("; ").trim_start()))
}

/// What others wrote, on one line of a comment. A semicolon in a comment ends what an import says.
fn cut(text: &str) -> String {
    text.replace("; ", ", ")
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .take(LONGEST_COMMENT)
        .collect::<String>()
        .trim_end()
        .to_owned()
}
