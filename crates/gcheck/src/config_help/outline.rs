//! Where the keys and values of a configuration are, of any text: half-typed and broken ones too.
//!
//! Knows: TOML's form, which key or value a place belongs to. Must not know: which keys there are.

use std::collections::BTreeMap;
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

/// A key in the text.
#[derive(Debug, Clone)]
pub(super) struct KeyPlace {
    /// From the top of the file to the key itself.
    pub(super) path: Vec<Step>,
    /// Bytes, with quotation marks.
    pub(super) range: Range<usize>,
    pub(super) form: Form,
}

/// A single value in the text.
#[derive(Debug, Clone)]
pub(super) struct ValuePlace {
    pub(super) path: Vec<Step>,
    /// Bytes, with quotation marks.
    pub(super) range: Range<usize>,
    pub(super) is_quoted: bool,
}

/// What is at a place, or may be written there.
#[derive(Debug)]
pub(super) enum Spot<'o> {
    /// A key that is there.
    Key(&'o KeyPlace),
    /// A key of this table may begin here.
    NewKey(&'o [Step], Form),
    /// A value that is there.
    Value(&'o ValuePlace),
    /// The value of this key may begin here.
    NewValue(&'o [Step]),
    /// Neither.
    Nothing,
}

/// The keys and values of a text.
#[derive(Debug, Default)]
pub(super) struct Outline {
    keys: Vec<KeyPlace>,
    values: Vec<ValuePlace>,
    comments: Vec<Range<usize>>,
    /// What may be written from a byte on, in text order.
    marks: Vec<(usize, Mark)>,
}

#[derive(Debug)]
enum Mark {
    Key(Vec<Step>, Form),
    Value(Vec<Step>),
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
            return Spot::Key(key);
        }
        if let Some(value) = self.values.iter().find(|value| touches(&value.range)) {
            return Spot::Value(value);
        }
        match self.marks.iter().take_while(|(from, _)| *from <= offset).last() {
            Some((_, Mark::Key(table, form))) => Spot::NewKey(table, *form),
            Some((_, Mark::Value(path))) => Spot::NewValue(path),
            _ => Spot::Nothing,
        }
    }

    /// The keys that a table has, each as often as it is written.
    pub(super) fn keys_of<'o>(&'o self, table: &'o [Step]) -> impl Iterator<Item = (&'o str, &'o KeyPlace)> {
        self.keys.iter().filter_map(move |key| {
            let (last, before) = key.path.split_last()?;
            Some((last.key().filter(|_| before == table)?, key))
        })
    }

    /// The tables of a list of tables: `[[overrides]]`.
    pub(super) fn items_of(&self, list: &[Step]) -> Vec<Vec<Step>> {
        let items = self.keys.iter().filter_map(|key| {
            let item = key.path.get(list.len()).filter(|step| matches!(step, Step::Item(_)))?;
            key.path.starts_with(list).then(|| [list, std::slice::from_ref(item)].concat())
        });
        let mut items: Vec<_> = items.collect();
        items.sort();
        items.dedup();
        items
    }

    /// The values at a path, or of the list there.
    pub(super) fn values_of(&self, path: &[Step]) -> impl Iterator<Item = &ValuePlace> {
        self.values.iter().filter(move |value| {
            let rest = value.path.strip_prefix(path);
            matches!(rest, Some([] | [Step::Item(_)]))
        })
    }
}

/// What a value is written in.
#[derive(Debug)]
enum Frame {
    Table(Vec<Step>),
    List(Vec<Step>, usize),
}

/// Follows the text and writes down what is where.
struct Reader<'t> {
    source: Source<'t>,
    outline: Outline,
    /// Of the last header.
    table: Vec<Step>,
    /// The header that is being read.
    header: Option<Form>,
    /// The key that was read last, from the top of the file.
    key: Vec<Step>,
    /// The key goes on after a point.
    goes_on: bool,
    frames: Vec<Frame>,
    /// How many tables each list of tables has.
    lists: BTreeMap<Vec<Step>, usize>,
}

impl<'t> Reader<'t> {
    fn new(source: Source<'t>) -> Self {
        let outline = Outline { marks: vec![(0, Mark::Key(Vec::new(), Form::Plain))], ..Outline::default() };
        Self {
            source,
            outline,
            table: Vec::new(),
            header: None,
            key: Vec::new(),
            goes_on: false,
            frames: Vec::new(),
            lists: BTreeMap::new(),
        }
    }

    fn mark(&mut self, from: usize, mark: Mark) {
        self.outline.marks.push((from, mark));
    }

    fn form(&self) -> Form {
        self.header.unwrap_or(Form::Plain)
    }

    /// The table that keys belong to.
    fn base(&self) -> Vec<Step> {
        match self.frames.last() {
            _ if self.header.is_some() => Vec::new(),
            Some(Frame::Table(path)) => path.clone(),
            Some(Frame::List(path, item)) => [path.as_slice(), &[Step::Item(*item)]].concat(),
            None => self.table.clone(),
        }
    }

    /// The path of the value that comes next.
    fn value_path(&self) -> Vec<Step> {
        match self.frames.last() {
            Some(Frame::List(..)) => self.base(),
            _ => self.key.clone(),
        }
    }

    fn begin_header(&mut self, span: Span, form: Form) {
        self.header = Some(form);
        self.goes_on = false;
        self.key.clear();
        self.mark(span.end(), Mark::Key(Vec::new(), form));
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
        self.table = self.key.clone();
        if form == Form::ListHeader {
            let count = self.lists.entry(self.key.clone()).or_default();
            self.table.push(Step::Item(*count));
            *count += 1;
        }
    }

    /// In a list of tables a header means the last of them.
    fn enter_list(&mut self) {
        if self.header.is_some()
            && let Some(count) = self.lists.get(&self.key)
        {
            self.key.push(Step::Item(count.saturating_sub(1)));
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
        self.frames.push(Frame::Table(path.clone()));
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
        self.key.push(Step::Key(self.text_of(span, encoding)));
        if span.is_empty() {
            return;
        }
        let (path, form) = (self.key.clone(), self.form());
        let range = span.start()..span.end();
        self.outline.keys.push(KeyPlace { path, range, form });
        self.mark(span.end(), Mark::Nothing);
    }

    fn key_sep(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.goes_on = true;
        self.enter_list();
        self.mark(span.end(), Mark::Key(self.key.clone(), self.form()));
    }

    fn key_val_sep(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.mark(span.end(), Mark::Value(self.key.clone()));
    }

    fn scalar(&mut self, span: Span, encoding: Option<Encoding>, _: &mut dyn ErrorSink) {
        // A value that is missing is an empty one.
        if !span.is_empty() {
            let (path, range) = (self.value_path(), span.start()..span.end());
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
            Spot::Key(key) => format!("key {}", written(&key.path)),
            Spot::NewKey(table, Form::Plain) => format!("a key of [{}]", written(table)),
            Spot::NewKey(table, _) => format!("a header in [{}]", written(table)),
            Spot::Value(value) => format!("value of {}", written(&value.path)),
            Spot::NewValue(path) => format!("a value for {}", written(path)),
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
    }
}
