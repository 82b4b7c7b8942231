//! Where the keys and values of a configuration are, of any text: half-typed and broken ones too.
//!
//! Knows: TOML's form, which key or value a place belongs to. Must not know: which keys there are.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::ops::Range;

use toml_parser::decoder::Encoding;
use toml_parser::parser::{EventReceiver, RecursionGuard, parse_document};
use toml_parser::{ErrorSink, Source, Span};

/// Lists and tables inside each other; what is deeper has no places.
const MOST_DEPTH: u32 = 32;

/// A step on the way to a value.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Step {
    /// Into a table.
    Key(String),
    /// Into a list, by the number of the item.
    Item(usize),
}

impl Step {
    /// The key of a table.
    pub(super) fn key(&self) -> Option<&str> {
        match self {
            Self::Key(key) => Some(key),
            Self::Item(_) => None,
        }
    }
}

/// How a key is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// `[machine]`
    Header,
    /// `[[overrides]]`
    ListHeader,
    /// In front of `=`.
    Plain,
}

/// A path from the top of the file, as a number of the outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PathIx(u32);

impl PathIx {
    const TOP: Self = Self(0);
}

/// A path: one step from another, so that the paths of a text take no more room than the text.
#[derive(Debug)]
struct PathNode {
    /// The path before the last step, and this step; `None` at the top.
    last: Option<(PathIx, Step)>,
    /// The keys of the table at this path, in text order.
    keys: Vec<usize>,
    /// The values at this path, in text order.
    values: Vec<usize>,
    /// The items of the list at this path, in text order.
    items: Vec<PathIx>,
    /// How many tables the list of tables at this path has.
    tables: usize,
}

impl PathNode {
    fn new(last: Option<(PathIx, Step)>) -> Self {
        Self { last, keys: Vec::new(), values: Vec::new(), items: Vec::new(), tables: 0 }
    }
}

/// A key in the text.
#[derive(Debug, Clone)]
pub(super) struct KeyPlace {
    path: PathIx,
    /// Bytes, with quotation marks.
    pub(super) range: Range<usize>,
    pub(super) form: Form,
    /// A point and another key follow: `tools` in `[tools.7]`.
    pub(super) is_head: bool,
}

/// A single value in the text.
#[derive(Debug, Clone)]
pub(super) struct ValuePlace {
    path: PathIx,
    /// Bytes, with quotation marks.
    pub(super) range: Range<usize>,
    pub(super) is_quoted: bool,
}

/// What is at a place, or may be written there.
#[derive(Debug)]
pub(super) enum Spot<'o> {
    /// A key that is there, with its path from the top of the file to the key itself.
    Key(&'o KeyPlace, Vec<Step>),
    /// A key of this table may begin here.
    NewKey(Vec<Step>, Form),
    /// A value that is there, with its path.
    Value(&'o ValuePlace, Vec<Step>),
    /// The value of this key may begin here.
    NewValue(Vec<Step>),
    /// Neither.
    Nothing,
}

/// The keys and values of a text.
#[derive(Debug)]
pub(super) struct Outline {
    paths: Vec<PathNode>,
    /// The path one step further than another.
    steps: BTreeMap<(PathIx, Step), PathIx>,
    /// In text order.
    keys: Vec<KeyPlace>,
    values: Vec<ValuePlace>,
    comments: Vec<Range<usize>>,
    /// What may be written from a byte on, in text order.
    marks: Vec<(usize, Mark)>,
}

#[derive(Debug)]
enum Mark {
    Key(PathIx, Form),
    Value(PathIx),
    Nothing,
}

impl Outline {
    /// Reads a text; whatever cannot be read is passed over.
    pub(super) fn read(text: &str) -> Self {
        let source = Source::new(text);
        let tokens = source.lex().into_vec();
        let mut reader = Reader::new(source);
        parse_document(&tokens, &mut RecursionGuard::new(&mut reader, MOST_DEPTH), &mut ());
        reader.outline
    }

    /// What is at a byte.
    pub(super) fn at(&self, offset: usize) -> Spot<'_> {
        let touches = |range: &Range<usize>| range.start <= offset && offset <= range.end;
        if self.comments.iter().any(|comment| comment.start < offset && offset <= comment.end) {
            return Spot::Nothing;
        }
        if let Some(key) = self.keys.iter().find(|key| !key.range.is_empty() && touches(&key.range)) {
            return Spot::Key(key, self.steps_to(key.path));
        }
        if let Some(value) = self.values.iter().find(|value| touches(&value.range)) {
            return Spot::Value(value, self.steps_to(value.path));
        }
        match self.marks.iter().take_while(|(from, _)| *from <= offset).last() {
            Some((_, Mark::Key(table, form))) => Spot::NewKey(self.steps_to(*table), *form),
            Some((_, Mark::Value(path))) => Spot::NewValue(self.steps_to(*path)),
            _ => Spot::Nothing,
        }
    }

    /// The keys that a table has, each as often as it is written.
    pub(super) fn keys_of(&self, table: &[Step]) -> impl Iterator<Item = (&str, &KeyPlace)> {
        let keys = self.node_at(table).map(|node| node.keys.as_slice()).unwrap_or_default();
        keys.iter().filter_map(|ix| {
            let key = self.keys.get(*ix)?;
            let (_, last) = self.node(key.path)?.last.as_ref()?;
            Some((last.key()?, key))
        })
    }

    /// The tables of a list of tables: `[[overrides]]`.
    pub(super) fn items_of(&self, list: &[Step]) -> Vec<Vec<Step>> {
        let items = self.node_at(list).map(|node| node.items.as_slice()).unwrap_or_default();
        items.iter().map(|item| self.steps_to(*item)).collect()
    }

    /// The values at a path, or of the list there.
    pub(super) fn values_of(&self, path: &[Step]) -> impl Iterator<Item = &ValuePlace> {
        let own = self.node_at(path);
        let items = own.map(|node| node.items.as_slice()).unwrap_or_default();
        let nodes = own.into_iter().chain(items.iter().filter_map(|item| self.node(*item)));
        nodes.flat_map(|node| &node.values).filter_map(|ix| self.values.get(*ix))
    }

    /// Would a header in these bytes take keys that are of the top table without it?
    pub(super) fn header_takes_keys(&self, range: &Range<usize>) -> bool {
        let mut before = self.keys.iter().take_while(|key| key.range.start < range.start);
        let next = self.keys.iter().find(|key| range.end <= key.range.start);
        before.all(|key| key.form == Form::Plain) && next.is_some_and(|key| key.form == Form::Plain)
    }

    fn node(&self, path: PathIx) -> Option<&PathNode> {
        self.paths.get(path.0 as usize)
    }

    fn node_at(&self, path: &[Step]) -> Option<&PathNode> {
        let find = |path, step: &Step| self.steps.get(&(path, step.clone())).copied();
        self.node(path.iter().try_fold(PathIx::TOP, find)?)
    }

    fn steps_to(&self, path: PathIx) -> Vec<Step> {
        let mut steps = Vec::new();
        let mut at = path;
        while let Some((before, step)) = self.node(at).and_then(|node| node.last.as_ref()) {
            steps.push(step.clone());
            at = *before;
        }
        steps.reverse();
        steps
    }
}

/// What a value is written in.
#[derive(Debug)]
enum Frame {
    Table(PathIx),
    List(PathIx, usize),
}

/// Follows the text and writes down what is where.
struct Reader<'t> {
    source: Source<'t>,
    outline: Outline,
    /// Of the last header.
    table: PathIx,
    /// The header that is being read.
    header: Option<Form>,
    /// The key that was read last, from the top of the file.
    key: PathIx,
    /// The key goes on after a point.
    goes_on: bool,
    frames: Vec<Frame>,
}

impl<'t> Reader<'t> {
    fn new(source: Source<'t>) -> Self {
        let outline = Outline {
            paths: vec![PathNode::new(None)],
            steps: BTreeMap::new(),
            keys: Vec::new(),
            values: Vec::new(),
            comments: Vec::new(),
            marks: vec![(0, Mark::Key(PathIx::TOP, Form::Plain))],
        };
        Self {
            source,
            outline,
            table: PathIx::TOP,
            header: None,
            key: PathIx::TOP,
            goes_on: false,
            frames: Vec::new(),
        }
    }

    fn mark(&mut self, from: usize, mark: Mark) {
        self.outline.marks.push((from, mark));
    }

    fn form(&self) -> Form {
        self.header.unwrap_or(Form::Plain)
    }

    fn node(&mut self, path: PathIx) -> Option<&mut PathNode> {
        self.outline.paths.get_mut(path.0 as usize)
    }

    /// The path one step further.
    fn step(&mut self, before: PathIx, step: Step) -> PathIx {
        let new = PathIx(self.outline.paths.len() as u32);
        match self.outline.steps.entry((before, step.clone())) {
            Entry::Occupied(known) => return *known.get(),
            Entry::Vacant(place) => place.insert(new),
        };
        if matches!(step, Step::Item(_))
            && let Some(list) = self.node(before)
        {
            list.items.push(new);
        }
        self.outline.paths.push(PathNode::new(Some((before, step))));
        new
    }

    /// The table that keys belong to.
    fn base(&mut self) -> PathIx {
        match self.frames.last() {
            _ if self.header.is_some() => PathIx::TOP,
            Some(Frame::Table(path)) => *path,
            Some(Frame::List(path, item)) => {
                let (path, item) = (*path, *item);
                self.step(path, Step::Item(item))
            }
            None => self.table,
        }
    }

    /// The path of the value that comes next.
    fn value_path(&mut self) -> PathIx {
        match self.frames.last() {
            Some(Frame::List(..)) => self.base(),
            _ => self.key,
        }
    }

    fn begin_header(&mut self, span: Span, form: Form) {
        self.header = Some(form);
        self.goes_on = false;
        self.key = PathIx::TOP;
        self.mark(span.end(), Mark::Key(PathIx::TOP, form));
    }

    /// One that is never closed goes on to the end of the text.
    fn end_frame(&mut self, span: Span) {
        self.frames.pop();
        if !span.is_empty() {
            self.mark(span.end(), Mark::Nothing);
        }
    }

    fn end_header(&mut self) {
        let Some(form) = self.header.take() else { return };
        self.table = self.key;
        if form == Form::ListHeader
            && let Some(list) = self.node(self.table)
        {
            let item = Step::Item(list.tables);
            list.tables += 1;
            self.table = self.step(self.table, item);
        }
    }

    /// In a list of tables a header means the last of them.
    fn enter_list(&mut self) {
        let tables = self.node(self.key).map_or(0, |list| list.tables);
        if self.header.is_some()
            && let Some(last) = tables.checked_sub(1)
        {
            self.key = self.step(self.key, Step::Item(last));
        }
    }

    fn text_of(&self, span: Span, encoding: Option<Encoding>) -> String {
        let mut decoded = String::new();
        if let Some(raw) = self.source.get(span) {
            let raw = toml_parser::Raw::new_unchecked(raw.as_str(), encoding, span);
            raw.decode_key(&mut decoded, &mut ());
        }
        decoded
    }
}

impl EventReceiver for Reader<'_> {
    fn std_table_open(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.begin_header(span, Form::Header);
    }

    fn std_table_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.end_header();
        self.mark(span.end(), Mark::Nothing);
    }

    fn array_table_open(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.begin_header(span, Form::ListHeader);
    }

    fn array_table_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.end_header();
        self.mark(span.end(), Mark::Nothing);
    }

    fn inline_table_open(&mut self, span: Span, _: &mut dyn ErrorSink) -> bool {
        let path = self.value_path();
        self.frames.push(Frame::Table(path));
        self.mark(span.end(), Mark::Key(path, Form::Plain));
        true
    }

    fn inline_table_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.end_frame(span);
    }

    fn array_open(&mut self, span: Span, _: &mut dyn ErrorSink) -> bool {
        let path = self.value_path();
        self.frames.push(Frame::List(path, 0));
        let item = self.base();
        self.mark(span.end(), Mark::Value(item));
        true
    }

    fn array_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.end_frame(span);
    }

    fn simple_key(&mut self, span: Span, encoding: Option<Encoding>, _: &mut dyn ErrorSink) {
        if !std::mem::take(&mut self.goes_on) {
            self.key = self.base();
        }
        self.enter_list();
        let table = self.key;
        self.key = self.step(table, Step::Key(self.text_of(span, encoding)));
        if span.is_empty() {
            return;
        }
        let (path, form, range) = (self.key, self.form(), span.start()..span.end());
        let number = self.outline.keys.len();
        if let Some(table) = self.node(table) {
            table.keys.push(number);
        }
        self.outline.keys.push(KeyPlace { path, range, form, is_head: false });
        self.mark(span.end(), Mark::Nothing);
    }

    fn key_sep(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.goes_on = true;
        let own = self.key;
        if let Some(key) = self.outline.keys.last_mut().filter(|key| key.path == own) {
            key.is_head = true;
        }
        self.enter_list();
        self.mark(span.end(), Mark::Key(self.key, self.form()));
    }

    fn key_val_sep(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.mark(span.end(), Mark::Value(self.key));
    }

    fn scalar(&mut self, span: Span, encoding: Option<Encoding>, _: &mut dyn ErrorSink) {
        // A value that is missing is an empty one.
        if !span.is_empty() {
            let (path, range) = (self.value_path(), span.start()..span.end());
            let number = self.outline.values.len();
            if let Some(node) = self.node(path) {
                node.values.push(number);
            }
            self.outline.values.push(ValuePlace { path, range, is_quoted: encoding.is_some() });
            self.mark(span.end(), Mark::Nothing);
        }
    }

    fn value_sep(&mut self, span: Span, _: &mut dyn ErrorSink) {
        if let Some(Frame::List(_, item)) = self.frames.last_mut() {
            *item += 1;
            let item = self.base();
            self.mark(span.end(), Mark::Value(item));
        } else {
            let table = self.base();
            self.mark(span.end(), Mark::Key(table, Form::Plain));
        }
    }

    fn comment(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.outline.comments.push(span.start()..span.end());
    }

    fn newline(&mut self, span: Span, _: &mut dyn ErrorSink) {
        if self.frames.is_empty() {
            self.end_header();
            let table = self.base();
            self.mark(span.end(), Mark::Key(table, Form::Plain));
        }
    }

    fn error(&mut self, span: Span, _: &mut dyn ErrorSink) {
        if !span.is_empty() {
            self.mark(span.end(), Mark::Nothing);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Form, Outline, Spot, Step};

    fn written(path: &[Step]) -> String {
        let step = |step: &Step| match step {
            Step::Key(key) => key.clone(),
            Step::Item(item) => format!("#{item}"),
        };
        path.iter().map(step).collect::<Vec<_>>().join(".")
    }

    /// What is at `$0`.
    fn spot(text: &str) -> String {
        let offset = text.find("$0").unwrap();
        let outline = Outline::read(&text.replace("$0", ""));
        match outline.at(offset) {
            Spot::Key(_, path) => format!("key {}", written(&path)),
            Spot::NewKey(table, Form::Plain) => format!("a key of [{}]", written(&table)),
            Spot::NewKey(table, _) => format!("a header in [{}]", written(&table)),
            Spot::Value(_, path) => format!("value of {}", written(&path)),
            Spot::NewValue(path) => format!("a value for {}", written(&path)),
            Spot::Nothing => "nothing".to_owned(),
        }
    }

    #[test]
    fn places_of_whole_and_half_typed_texts() {
        for (text, expected) in [
            ("$0", "a key of []"),
            ("con$0", "key con"),
            ("control $0", "nothing"),
            ("control =$0", "a value for control"),
            ("control = $0\n[machine]\n", "a value for control"),
            ("control = \"ha$0", "value of control"),
            ("control = \"haas-mill\" $0", "nothing"),
            ("control = \"haas-mill\"\n$0", "a key of []"),
            ("control = 1 # wh$0at\n", "nothing"),
            ("[$0", "a header in []"),
            ("[$0\n[machine]\n", "a header in []"),
            ("[mach$0", "key mach"),
            ("[machine]$0\n", "nothing"),
            ("[machine]\n$0", "a key of [machine]"),
            ("[machine]\nunits = \"mm\"\n$0\n[rules]\n", "a key of [machine]"),
            ("[machine.$0]", "a header in [machine]"),
            ("[machine\n$0", "a key of [machine]"),
            ("[machine]\ntravel.$0", "a key of [machine.travel]"),
            ("[machine]\ntravel.X = [$0", "a value for machine.travel.X.#0"),
            ("[machine]\ntravel.X = [1, $0", "a value for machine.travel.X.#1"),
            ("[machine]\nunits = \"mm\" x\n$0", "a key of [machine]"),
            ("[tools]\n3 = { $0", "a key of [tools.3]"),
            ("[tools]\n3 = { length = 1.0, di$0", "key tools.3.di"),
            ("[tools]\n3 = { length = $0 }", "a value for tools.3.length"),
            ("[tools]\n3 = { length = 5 }$0\n", "nothing"),
            ("[rules]\nselect = [\"recommended\",\n  $0\n]\n", "a value for rules.select.#1"),
            ("[[overrides]]\n[overrides.machine]\n$0", "a key of [overrides.#0.machine]"),
            ("[[overrides]]\n[[overrides]]\n$0", "a key of [overrides.#1]"),
            ("[[over$0", "key over"),
            ("\"#100\" = 1\n[offsets]\n\"G154 P2\"$0 = 1", "key offsets.G154 P2"),
            ("x = \"\"\"\n$0", "value of x"),
            ("[machine]\r\nunits = \"mm\"\r\n$0", "a key of [machine]"),
        ] {
            assert_eq!(spot(text), expected, "{text}");
        }
    }

    #[test]
    fn any_text_has_an_outline() {
        let hostile =
            ["[", "]", "=", "{", "}", ".", ",", "\"", "'", "#", "a", "\n", "\"\"\"", "é", "1", "[["];
        let mut seed = 7_usize;
        for _ in 0..3_000 {
            let mut text = String::new();
            for _ in 0..12 {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                text.push_str(hostile[(seed >> 33) % hostile.len()]);
            }
            let outline = Outline::read(&text);
            for offset in 0..=text.len() {
                outline.at(offset);
            }
        }
        Outline::read(&"[".repeat(200_000));
        Outline::read(&"{a=".repeat(200_000));
        Outline::read(&format!("a = {}", "[".repeat(200_000)));
        // Paths of that many keys take no more room than the text.
        for text in ["a.".repeat(200_000), format!("[{}a]\nb = 1\n", "a.".repeat(200_000))] {
            let outline = Outline::read(&text);
            outline.at(text.len());
            outline.at(0);
        }
    }
}
