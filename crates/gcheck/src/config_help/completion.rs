//! What may be written at a place of a configuration: keys that its table does not have yet, values that are listed.
//!
//! Knows: how keys and values are written. Must not know: any key.

use std::collections::BTreeMap;
use std::ops::Range;

use gcheck_server::ConfigurationOffer;

use super::open_keys::{Name, control_at, names};
use super::outline::{Form, KeyPlace, Outline, Spot, Step, ValuePlace};
use super::shape::{Kind, Shape};

/// Of more values a key lists none: they are offered where the value is written.
const MOST_CHOICES: usize = 12;

/// All that may be written at a byte, what fits best first.
pub(crate) fn completion(text: &str, offset: usize) -> Vec<ConfigurationOffer> {
    let outline = Outline::read(text);
    let asked = Asked { text, outline: &outline, offset };
    let (mut offers, typed) = match outline.at(offset) {
        Spot::Key(key, path) => {
            let table = path.split_last().map_or(&[][..], |(_, table)| table);
            (asked.keys(table, key.form, Some(key)), asked.before(&key.range))
        }
        Spot::NewKey(table, form) => (asked.keys(&table, form, None), ""),
        Spot::Value(value, path) => (asked.values(&path, Some(value)), asked.before(&value.range)),
        Spot::NewValue(path) => (asked.values(&path, None), ""),
        Spot::Nothing => (Vec::new(), ""),
    };
    let typed = typed.trim_start_matches(['"', '\'']).to_lowercase();
    offers.retain(|offer| offer.label.to_lowercase().contains(&typed));
    offers.sort_by_key(|offer| !offer.label.to_lowercase().starts_with(&typed));
    offers
}

/// How a key may be written once more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// As one that the table does not have.
    Whole,
    /// As the head of another key: `tools.` for `[tools.7]`.
    Head,
}

/// How a key may be written beside the places where its table has it already; `None` where TOML allows it once.
fn way(form: Form, value: &Shape, there: &[&KeyPlace]) -> Option<Way> {
    let only_in = |form: Form| there.iter().all(|place| place.form == form);
    let only_heads = there.iter().all(|place| place.is_head);
    match form {
        _ if there.is_empty() => Some(Way::Whole),
        // Each header begins another table of the list.
        Form::ListHeader => there.iter().all(|place| place.form != Form::Plain).then_some(Way::Whole),
        // What is the value of a key has no header.
        Form::Header if there.iter().any(|place| place.form == Form::Plain && !place.is_head) => None,
        // Of a table of tables, such as the tools, there may be a header for each.
        Form::Header if value.is_of_tables() => Some(Way::Head),
        Form::Header => (only_in(Form::Header) && only_heads).then_some(Way::Whole),
        Form::Plain => (value.may_be_table() && only_in(Form::Plain) && only_heads).then_some(Way::Head),
    }
}

struct Asked<'a> {
    text: &'a str,
    outline: &'a Outline,
    offset: usize,
}

impl<'a> Asked<'a> {
    /// What is typed of a key or value.
    fn before(&self, range: &Range<usize>) -> &'a str {
        self.text.get(range.start..self.offset).unwrap_or_default()
    }

    /// Does one of these follow a byte, in its line?
    fn is_followed(&self, offset: usize, by: &[char]) -> bool {
        self.text.get(offset..).unwrap_or_default().trim_start_matches([' ', '\t']).starts_with(by)
    }

    fn keys(&self, table: &[Step], form: Form, typed: Option<&KeyPlace>) -> Vec<ConfigurationOffer> {
        let Some(shape) = Shape::at(table) else { return Vec::new() };
        let range = typed.map_or(self.offset..self.offset, |key| key.range.clone());
        let others = self.outline.keys_of(table).filter(|(_, place)| place.range != range);
        let mut there: BTreeMap<&str, Vec<&KeyPlace>> = BTreeMap::new();
        for (name, place) in others {
            there.entry(name).or_default().push(place);
        }
        let control = control_at(self.outline, self.text, table);
        let open = names(table, control.as_deref()).into_iter();
        let open = open.filter_map(|name| shape.value_of(&name.name).map(|value| (name, value)));
        let listed = shape.keys().into_iter().map(|(name, value)| {
            let description = value.description().replace('\n', " ");
            (Name { name: name.to_owned(), description }, value)
        });
        let is_at_top = table.is_empty();
        let takes_keys = !self.is_followed(range.end, &['=', '.']) && self.outline.header_takes_keys(&range);
        let mut offers = Vec::new();
        for (Name { name, description }, value) in listed.chain(open) {
            let fits = match form {
                Form::Header => value.kind() == Kind::Table,
                Form::ListHeader => value.kind() == Kind::ListOfTables,
                Form::Plain => true,
            };
            let places = there.get(name.as_str()).map(Vec::as_slice).unwrap_or_default();
            let Some(way) = way(form, &value, places).filter(|_| fits) else { continue };
            let is_header = match form {
                Form::Header | Form::ListHeader => true,
                Form::Plain => way == Way::Whole && matches!(value.kind(), Kind::Table | Kind::ListOfTables),
            };
            if is_header && is_at_top && takes_keys {
                continue;
            }
            let (text, snippet) = match way {
                Way::Whole => self.key_written(&name, &value, form, &range, is_at_top),
                // What is the head of other keys has no value.
                Way::Head if self.is_followed(range.end, &['=']) => continue,
                Way::Head if self.is_followed(range.end, &['.']) => (quoted(&name), None),
                Way::Head => (format!("{}.", quoted(&name)), None),
            };
            let quote = self.before(&range).chars().next().filter(|first| ['"', '\''].contains(first));
            let filter = quote.map_or_else(|| name.clone(), |quote| format!("{quote}{name}"));
            let range = range.clone();
            offers.push(ConfigurationOffer {
                label: name,
                description,
                is_key: true,
                range,
                filter,
                text,
                snippet,
            });
        }
        offers
    }

    /// A key with what comes after it, plain and as a snippet.
    fn key_written(
        &self,
        name: &str,
        value: &Shape,
        form: Form,
        range: &Range<usize>,
        is_at_top: bool,
    ) -> (String, Option<String>) {
        let key = quoted(name);
        match form {
            Form::Header if !self.is_followed(range.end, &[']', '.']) => {
                return (format!("{key}]"), None);
            }
            Form::ListHeader if !self.is_followed(range.end, &[']', '.']) => {
                return (format!("{key}]]"), None);
            }
            Form::Plain if !self.is_followed(range.end, &['=', '.']) => {}
            _ => return (key, None),
        }
        let after = match value.kind() {
            Kind::Table if is_at_top => return (format!("[{key}]"), None),
            Kind::ListOfTables => return (format!("[[{key}]]"), None),
            Kind::Text => {
                let choices: Vec<String> = value.allowed().into_iter().map(|allowed| allowed.text).collect();
                match choices.len() {
                    1..=MOST_CHOICES => format!("\"${{1|{}|}}\"", choices.join(",")),
                    _ => "\"$1\"".to_owned(),
                }
            }
            Kind::List => "[$1]".to_owned(),
            Kind::Table => "{ $1 }".to_owned(),
            Kind::Other => "$1".to_owned(),
        };
        (format!("{key} = "), Some(format!("{key} = {after}")))
    }

    fn values(&self, path: &[Step], typed: Option<&ValuePlace>) -> Vec<ConfigurationOffer> {
        let Some(shape) = Shape::at(path) else { return Vec::new() };
        let control = control_at(self.outline, self.text, path);
        let list = path.split_last().filter(|(last, _)| last.key().is_none()).map(|(_, list)| list);
        let open = list.map(|list| names(list, control.as_deref())).unwrap_or_default();
        let allowed = shape.allowed().into_iter();
        let allowed = allowed.map(|value| (value.text, value.description.replace('\n', " "), value.is_text));
        let allowed = allowed.chain(open.into_iter().map(|name| (name.name, name.description, true)));
        let Some(gap) = self.gap(typed) else { return Vec::new() };
        let written: Vec<&str> = list
            .map(|list| {
                self.outline.values_of(list).filter(|value| typed.is_none_or(|t| t.range != value.range))
            })
            .into_iter()
            .flatten()
            .filter_map(|value| Some(self.text.get(value.range.clone())?.trim_matches(['"', '\''])))
            .collect();
        // What is written in full needs no list: in many editors Enter would take its row and not begin a line.
        let whole = self.text.get(gap.range.clone()).filter(|_| gap.quote.is_none()).unwrap_or_default();
        let is_fitting = |text: &str, is_text: bool| {
            (is_text || gap.quote.is_none()) && !written.contains(&text) && text != whole
        };
        allowed
            .filter(|(text, _, is_text)| is_fitting(text, *is_text))
            .map(|(label, description, is_text)| {
                let text = match gap.quote {
                    Some(_) if gap.is_closed => label.clone(),
                    Some(quote) => format!("{label}{quote}"),
                    None if is_text => format!("{}\"{label}\"", gap.blank),
                    None => format!("{}{label}", gap.blank),
                };
                let (range, filter) = (gap.range.clone(), label.clone());
                ConfigurationOffer { label, description, is_key: false, range, filter, text, snippet: None }
            })
            .collect()
    }

    /// Where a value is written; `None` after the end of a text.
    fn gap(&self, typed: Option<&ValuePlace>) -> Option<Gap> {
        let Some(value) = typed else {
            let is_close = self.text.get(..self.offset).is_some_and(|before| before.ends_with('='));
            let blank = if is_close { " " } else { "" };
            return Some(Gap { range: self.offset..self.offset, quote: None, is_closed: true, blank });
        };
        let written = self.text.get(value.range.clone())?;
        let quote = written.chars().next().filter(|_| value.is_quoted);
        let Some(quote) = quote else {
            return Some(Gap { range: value.range.clone(), quote: None, is_closed: true, blank: "" });
        };
        // Nothing that is listed goes over several lines.
        if written.len() > 2 && written.starts_with(&quote.to_string().repeat(3)) {
            return None;
        }
        let is_closed = written.len() > 1 && written.ends_with(quote);
        let range = value.range.start + 1..value.range.end - usize::from(is_closed);
        let is_inside = range.start <= self.offset && self.offset <= range.end;
        is_inside.then_some(Gap { range, quote: Some(quote), is_closed, blank: "" })
    }
}

/// A key as TOML writes it.
fn quoted(name: &str) -> String {
    let is_bare = name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
    if is_bare { name.to_owned() } else { format!("\"{name}\"") }
}

/// Where a value is written.
struct Gap {
    range: Range<usize>,
    /// The quotation mark in front of it.
    quote: Option<char>,
    /// The quotation mark after it is there, or none is needed.
    is_closed: bool,
    /// What keeps it apart from `=`.
    blank: &'static str,
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;
    use std::time::{Duration, Instant};

    use gcheck_server::ConfigurationOffer;

    use super::completion;

    fn offers(text: &str) -> Vec<ConfigurationOffer> {
        let offset = text.find("$0").unwrap();
        completion(&text.replace("$0", ""), offset)
    }

    fn labels(text: &str) -> Vec<String> {
        offers(text).into_iter().map(|offer| offer.label).collect()
    }

    /// The text after an offer was taken, by an editor that knows snippets.
    fn taken(text: &str, label: &str) -> String {
        let plain = text.replace("$0", "");
        let offer = offers(text).into_iter().find(|offer| offer.label == label);
        let offer = offer.unwrap_or_else(|| panic!("{label} is not offered in {text}: {:?}", labels(text)));
        let typed = &plain[offer.range.start..text.find("$0").unwrap()];
        assert!(offer.filter.to_lowercase().contains(&typed.to_lowercase()), "{typed} in {}", offer.filter);
        let written = offer.snippet.unwrap_or(offer.text);
        format!("{}{written}{}", &plain[..offer.range.start], &plain[offer.range.end..])
    }

    #[test]
    fn keys_that_the_table_does_not_have_yet() {
        let all = labels("[machine]\nmax_rpm = 1\nunits = \"mm\"\n$0\n");
        assert!(all.iter().any(|label| label == "max_feed"), "{all:?}");
        assert!(!all.iter().any(|label| label == "max_rpm" || label == "units"), "{all:?}");
        let top = labels("control = \"haas-mill\"\n$0");
        assert!(top.iter().any(|label| label == "machine") && !top.iter().any(|label| label == "control"));
        assert_eq!(
            labels("[machine]\n[$0"),
            [
                "codes",
                "files",
                "format",
                "offsets",
                "per-file-ignores",
                "rules",
                "search",
                "settings",
                "tools",
                "variables"
            ]
        );
        assert_eq!(labels("[[$0"), ["overrides"]);
        assert_eq!(labels("[tools]\n1 = { length = 1, dia$0 }"), ["diameter"]);
        assert_eq!(labels("[machine]\nmax_r$0pm = 1\n"), ["max_rpm"]);
    }

    #[test]
    fn keys_that_depend_on_the_control() {
        assert_eq!(
            labels("[machine]\ntravel.X = [0, 1]\ntravel.$0"),
            ["Y", "Z", "A", "B", "C", "U", "V", "W"]
        );
        assert!(labels("control = \"haas-mill\"\n[settings]\n$0").contains(&"34".to_owned()));
        assert!(labels("[settings]\n$0").is_empty());
        assert!(labels("control = \"haas-mill\"\n[offsets]\nG15$0").contains(&"G154 P1".to_owned()));
        assert_eq!(labels("[offsets]\nG54 = { X = 1 }\nG55$0"), ["G55"]);
    }

    #[test]
    fn values_that_are_listed() {
        assert_eq!(labels("[machine]\nunits = \"$0"), ["mm", "inch"]);
        assert_eq!(labels("[machine]\nunits = \"i$0\""), ["inch"]);
        assert_eq!(labels("[machine]\nunits = $0\n"), ["mm", "inch"]);
        assert_eq!(labels("[rules]\nunknown-code = \"$0\"\n"), ["off", "hint", "info", "warning", "error"]);
        assert_eq!(labels("[rules]\nselect = [\"recommended\", \"recomm$0\"]"), [] as [&str; 0]);
        assert!(labels("control = \"$0\"\n").iter().eq(gcheck_controls::names()));
        assert_eq!(labels("control = \"haas-mill\"\n[settings]\n162 = fals$0"), ["false"]);
        assert_eq!(labels("control = \"haas-mill\"\n[settings]\n162 = false$0"), [] as [&str; 0]);
        assert_eq!(labels("[machine]\naxes = [\"X\", \"Z\", $0]")[..2], ["Y", "A"]);
        let rules = labels("[rules]\nignore = [\"unknown-c$0");
        assert_eq!(rules.first().map(String::as_str), Some("unknown-code"), "{rules:?}");
    }

    #[test]
    fn what_is_taken_is_whole() {
        for (text, label, expected) in [
            ("ext$0", "extend", "extend = \"$1\""),
            ("$0", "machine", "[machine]"),
            ("over$0", "overrides", "[[overrides]]"),
            ("[mach$0", "machine", "[machine]"),
            ("[mach$0]", "machine", "[machine]"),
            ("[[$0]]", "overrides", "[[overrides]]"),
            ("[machine]\nun$0", "units", "[machine]\nunits = \"${1|mm,inch|}\""),
            ("[machine]\nmax_$0 = 5", "max_rpm", "[machine]\nmax_rpm = 5"),
            ("[machine]\n$0", "axes", "[machine]\naxes = [$1]"),
            ("[machine]\n$0", "travel", "[machine]\ntravel = { $1 }"),
            ("[machine]\nunits =$0", "mm", "[machine]\nunits = \"mm\""),
            ("[machine]\nunits = \"m$0", "mm", "[machine]\nunits = \"mm\""),
            ("[machine]\nunits = \"m$0\" # x", "mm", "[machine]\nunits = \"mm\" # x"),
            ("[machine]\nunits = 'm$0\n", "mm", "[machine]\nunits = 'mm'\n"),
            ("[machine]\nunits = m$0", "mm", "[machine]\nunits = \"mm\""),
            (
                "control = \"haas-mill\"\n[offsets]\n$0",
                "G154 P1",
                "control = \"haas-mill\"\n[offsets]\n\"G154 P1\" = { $1 }",
            ),
            (
                "control = \"haas-mill\"\n[offsets]\n\"G1$0\"",
                "G154 P1",
                "control = \"haas-mill\"\n[offsets]\n\"G154 P1\" = { $1 }",
            ),
        ] {
            assert_eq!(taken(text, label), expected, "{text}");
        }
    }

    #[test]
    fn a_table_that_is_there_has_no_second_header() {
        for (text, label, expected) in [
            ("[tools]\n1 = {}\n[$0", "tools", "[tools]\n1 = {}\n[tools."),
            ("[tools.7]\n[too$0]", "tools", "[tools.7]\n[tools.]"),
            ("[tools.7]\n[too$0.8]", "tools", "[tools.7]\n[tools.8]"),
            ("[machine.travel]\n[mach$0", "machine", "[machine.travel]\n[machine]"),
            (
                "[[overrides]]\n[overrides.tools]\n[overrides.$0",
                "tools",
                "[[overrides]]\n[overrides.tools]\n[overrides.tools.",
            ),
            ("[[overrides]]\n[[$0", "overrides", "[[overrides]]\n[[overrides]]"),
        ] {
            assert_eq!(taken(text, label), expected, "{text}");
        }
        for (text, label) in [
            ("[variables]\n\"#500\" = 1\n[$0", "variables"),
            ("[rules]\n[$0", "rules"),
            ("[machine]\n[$0", "machine"),
            ("tools = { 1 = {} }\n[$0", "tools"),
            ("machine.units = \"mm\"\n[$0", "machine"),
            ("overrides = []\n[[$0", "overrides"),
            ("control = \"haas-mill\"\n[offsets]\nG54 = { X = 1 }\n[offsets.$0", "G54"),
        ] {
            assert!(!labels(text).iter().any(|offered| offered == label), "{label} in {text}");
        }
    }

    #[test]
    fn no_header_is_offered_above_keys_of_the_top_table() {
        let is_offered = |text: &str| labels(text).iter().any(|label| label == "machine");
        for text in ["$0\ncontrol = \"haas-mill\"\n", "mach$0\ncontrol = 1\n[tools]\n"] {
            assert!(!is_offered(text), "{text}");
        }
        for text in ["[$0\ncontrol = 1\n", "[mach$0]\ncontrol = 1\n", "over$0\ncontrol = 1\n"] {
            assert_eq!(labels(text), [] as [&str; 0], "{text}");
        }
        assert!(labels("$0\ncontrol = \"haas-mill\"\n").contains(&"extend".to_owned()));
        for text in ["control = 1\n$0\n[tools]\n1 = {}\n", "[$0\n[tools]\n1 = {}\n", "[rules]\n[$0\nx = 1"] {
            assert!(is_offered(text), "{text}");
        }
        assert_eq!(taken("mach$0.units = 1\ncontrol = 1", "machine"), "machine.units = 1\ncontrol = 1");
    }

    #[test]
    fn the_head_of_dotted_keys_is_written_again_with_its_point() {
        for (text, label, expected) in [
            ("[machine]\ntravel.X = [0, 1]\ntra$0", "travel", "[machine]\ntravel.X = [0, 1]\ntravel."),
            ("[machine]\nrapid.X = 1\nrap$0", "rapid", "[machine]\nrapid.X = 1\nrapid."),
            ("[machine]\ntravel.X = [0, 1]\ntra$0.Y", "travel", "[machine]\ntravel.X = [0, 1]\ntravel.Y"),
            ("machine.units = 1\nmach$0\ncontrol = 1", "machine", "machine.units = 1\nmachine.\ncontrol = 1"),
        ] {
            assert_eq!(taken(text, label), expected, "{text}");
        }
        for text in [
            "[machine]\ntravel = { X = [0, 1] }\ntra$0",
            "[machine]\ntra$0\n[machine.travel]",
            "[machine]\ntravel.X = [0, 1]\ntra$0 = 1",
            "control.x = 1\ncontr$0",
        ] {
            assert_eq!(labels(text), [] as [&str; 0], "{text}");
        }
    }

    #[test]
    fn nothing_is_offered_where_nothing_is_listed() {
        for text in [
            "# con$0",
            "control = \"haas-mill\"$0\n",
            "control = \"haas-mill\" $0\n",
            "[machine]$0",
            "[nothing]\n$0",
            "[machine]\nmax_rpm = 1$0",
            "[machine]\nname = \"$0\"",
            "control $0",
            "x = \"\"\"m$0",
        ] {
            assert_eq!(labels(text), [] as [&str; 0], "{text}");
        }
    }

    #[test]
    fn a_large_configuration_is_answered_soon() {
        let mut text = "control = \"haas-mill\"\n[tools]\n".to_owned();
        for number in 1..5_000 {
            let _ = writeln!(text, "{number} = {{ length = 80.0, diameter = 10.0, offset = {{ X = 1.0 }} }}");
        }
        text.push_str("[rules]\n");
        let start = Instant::now();
        assert!(completion(&text, text.len()).len() > 100);
        assert!(crate::config_help::hover(&text, text.len() - 3).is_some());
        let most = Duration::from_millis(if cfg!(debug_assertions) { 2_000 } else { 200 });
        assert!(start.elapsed() < most, "{:?}", start.elapsed());
    }

    #[test]
    fn every_prefix_of_a_configuration_has_an_answer_at_every_place() {
        let text = "control = \"haas-mill\"\n[machine]\nunits = 'mm'\ntravel.X = [-1.0, 0.0]\nrapid = { X = 1 } # é\n[tools]\n3 = { length = 5, chip_load = [0.1, 0.2] }\n[rules]\nselect = [\"recommended\",\n \"words\"]\n[[overrides]]\nfiles = [\"a/**\"]\n[overrides.machine]\nname = \"\"\"x\ny\"\"\"\n";
        for end in 0..=text.len() {
            let Some(part) = text.get(..end) else { continue };
            completion(part, end);
            crate::config_help::hover(part, end);
        }
        for offset in 0..=text.len() {
            if text.is_char_boundary(offset) {
                completion(text, offset);
                crate::config_help::hover(text, offset);
            }
        }
    }
}
