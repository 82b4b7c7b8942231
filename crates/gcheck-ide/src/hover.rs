//! What is shown for the word under the pointer: a few lines, the state first.
//!
//! Knows: which parts of an answer a place has, and their order. Must not know: how editors draw Markdown.
//!
//! Findings are left to the editor, which shows them at the same place; all that manuals say of a code is a page of its own.

use std::fmt::Write as _;
use std::ops::Range;

use gcheck_controls::{Code, CodeIx, Control, Effect, Letter, Motion, Need, Variable, WordEntry, WordKind};
use gcheck_db::{BlockPlace, Cancelled, Database, DocumentId, Snapshot, StateAt};
use gcheck_engine::{
    Abstract, AbstractValue, At, Axis, Domain as _, Look, Position, Role, State, Truth, Units,
};
use gcheck_geometry::Plane;
use gcheck_program::{ExprIx, StatementKind, Value, Word};
use gcheck_syntax::ast::{self, Element};
use gcheck_syntax::{SyntaxKind, SyntaxToken};

use crate::ReferenceKind;
use crate::assumed::assumed;
use crate::describe;
use crate::foreign::Foreign;
use crate::keywords;
use crate::lexemes::touches;
use crate::number_text::{coordinate, decimals, plain, unit, value};
use crate::remarks::title;
use crate::sections::tool_names;
use crate::state_at::look_at;
use crate::state_reader::{Item, StateReader};
use crate::symbols::{Symbol, occurrences_in, program_around, symbol_at};
use crate::tool_words::{told_of_tool, tool_of, tool_word_at};

/// Places that set a variable which are shown.
const MOST_ASSIGNMENTS: usize = 5;
/// Ways to a block that are shown.
const MOST_DECISIONS: usize = 3;

/// What is shown for a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hover {
    /// Bytes that it speaks of.
    pub range: Range<u32>,
    /// Markdown.
    pub markdown: String,
    /// The code that `gcheck explain` tells more of.
    pub code: Option<String>,
    /// It was asked to stop before the state was known.
    pub is_without_state: bool,
}

/// What is to be said of the place at `offset`: the code, word, number, variable or label there, and the state before and
/// after its block.
///
/// When `stop` says yes before the state is known, the answer is what the text says, and [`Hover::is_without_state`].
pub fn hover(
    database: &mut Database,
    document: DocumentId,
    offset: u32,
    stop: &dyn Fn() -> bool,
) -> Option<Hover> {
    let snapshot = database.indexed(document)?;
    let place = snapshot.block_at(offset).filter(|place| touches(&place.range(), offset))?;
    let subject = subject(&snapshot, &place, offset);
    if let Some(dialect) = snapshot.settings().unsupported {
        // What the words mean there is not known here.
        let markdown = format!("{}; name a control to read it all the same", dialect.sentence());
        return Some(Hover { range: subject.range(), markdown, code: None, is_without_state: false });
    }
    let with_state = parts_with_state(database, document, &snapshot, &place, &subject, stop);
    let is_without_state = with_state.is_err();
    let mut parts = with_state.ok().flatten().unwrap_or_else(|| {
        let cx = Cx { snapshot: &snapshot, place: &place, state: None, is_without_state };
        cx.parts(&subject, None)
    });
    parts.retain(|part| !part.trim().is_empty());
    if parts.is_empty() {
        return None;
    }
    let parts: Vec<&str> = parts.iter().map(|part| part.trim_end()).collect();
    let code = match subject {
        Subject::Code(_, ix) => snapshot.control().code_at(ix).map(|code| code.entry().code.clone()),
        _ => None,
    };
    let markdown = parts.join("\n\n---\n\n");
    Some(Hover { range: subject.range(), markdown, code, is_without_state })
}

/// What is to be said where the state is known; `None` where no path comes.
fn parts_with_state(
    database: &mut Database,
    document: DocumentId,
    snapshot: &Snapshot,
    place: &BlockPlace,
    subject: &Subject,
    stop: &dyn Fn() -> bool,
) -> Result<Option<Vec<String>>, Cancelled> {
    let mut parts = None;
    let looked = look_at(database, document, place.number, stop, &mut |state, look| {
        let state = Some(state);
        let cx = Cx { snapshot, place, state, is_without_state: false };
        parts = Some(cx.parts(subject, Some(look)));
    });
    // Time may be over just after the state was shown.
    match (parts, looked) {
        (None, Err(cancelled)) => Err(cancelled),
        (parts, _) => Ok(parts),
    }
}

/// What is at a place.
enum Subject {
    /// A G or M word that names a code.
    Code(Range<u32>, CodeIx),
    /// Any other word of a block.
    Word(Range<u32>, Word),
    /// A label, program, subroutine, variable or parameter.
    Symbol(Range<u32>, Symbol),
    /// A function of expressions.
    Function(Range<u32>, String),
    /// A keyword of a statement or an expression, and what the statement names.
    Keyword(Range<u32>, SyntaxKind, Option<Symbol>),
    /// Nothing that can be told of.
    Nothing(Range<u32>),
}

impl Subject {
    fn range(&self) -> Range<u32> {
        match self {
            Self::Code(range, _)
            | Self::Word(range, _)
            | Self::Symbol(range, _)
            | Self::Function(range, _)
            | Self::Keyword(range, ..)
            | Self::Nothing(range) => range.clone(),
        }
    }
}

/// The token that is pointed at, and its bytes of the file: where two meet the one after the cursor, unless it is a blank.
fn pointed_at(snapshot: &Snapshot, offset: u32) -> Option<(SyntaxToken, Range<u32>)> {
    let tree = snapshot.tree_at(offset)?;
    let is_solid =
        |token: &SyntaxToken| !matches!(token.kind(), SyntaxKind::WHITESPACE | SyntaxKind::NEWLINE);
    let after = tree.token_at(offset).filter(is_solid);
    let token = after.or_else(|| tree.token_before(offset).filter(is_solid))?;
    let range = tree.place_of(&token);
    Some((token, range))
}

fn subject(snapshot: &Snapshot, place: &BlockPlace, offset: u32) -> Subject {
    let Some((token, at)) = pointed_at(snapshot, offset) else { return Subject::Nothing(offset..offset) };
    match Element::of(token) {
        Element::Comment(_) => return Subject::Nothing(at),
        Element::Function(name) => return Subject::Function(at, name.text().to_ascii_uppercase()),
        Element::Keyword(token) | Element::Operator(token)
            if keywords::does(token.kind(), "", false).is_some()
                || token.kind() == SyntaxKind::COMPARISON =>
        {
            let named = symbol_at(snapshot, offset).filter(|_| token.kind().is_keyword());
            return Subject::Keyword(at, token.kind(), named.map(|occurrence| occurrence.symbol));
        }
        Element::Variable(ast::Variable::Numbered(_) | ast::Variable::Named(_)) => {
            if let Some(occurrence) = symbol_at(snapshot, at.start + 1) {
                return Subject::Symbol(at, occurrence.symbol);
            }
        }
        _ => {}
    }
    let words = place.table.words(place.block()).iter();
    let word = words.copied().find(|word| {
        let range = place.in_file(word.range());
        range.start <= at.start && at.end <= range.end
    });
    match word {
        Some(word) if word.code.is_some() => Subject::Code(place.in_file(word.range()), word.code),
        Some(word) => Subject::Word(place.in_file(word.range()), word),
        None => match symbol_at(snapshot, offset) {
            Some(occurrence) => Subject::Symbol(occurrence.range, occurrence.symbol),
            None => Subject::Nothing(at),
        },
    }
}

/// What a block is hovered with.
struct Cx<'a> {
    snapshot: &'a Snapshot,
    place: &'a BlockPlace,
    /// `None` where no path comes, or where nobody waits for it.
    state: Option<&'a StateAt>,
    /// Nobody waits for it.
    is_without_state: bool,
}

impl Cx<'_> {
    fn control(&self) -> &Control {
        self.snapshot.control()
    }

    fn parts(&self, subject: &Subject, mut look: Option<&mut Look<'_, '_>>) -> Vec<String> {
        let mut parts: Vec<String> = Vec::new();
        match subject {
            Subject::Code(_, ix) => {
                let code = self.control().code_at(*ix);
                let title = code.map(describe::title);
                let around = look.as_deref().map(|look| self.around(look)).or_else(|| self.way());
                let head: Vec<String> = title.into_iter().chain(around).collect();
                parts.push(head.join("\n\n"));
                let plane = look.as_deref().and_then(|look| self.plane(look));
                parts.extend(code.map(|code| in_short(code, plane)));
            }
            Subject::Word(_, word) => parts.push(self.word(word, look)),
            Subject::Symbol(_, symbol) => parts.push(self.symbol(symbol, look.take())),
            Subject::Function(_, name) => {
                let known = self.control().functions().iter().find(|function| function.name == *name);
                parts.extend(known.map(|function| {
                    let unsure = function.confidence.remark();
                    format!("**{name}** {}\n\n*{}{unsure}*", function.title, function.source)
                }));
            }
            Subject::Keyword(range, kind, named) => {
                parts.push(self.keyword(range, *kind, look));
                parts.extend(named.as_ref().map(|symbol| self.symbol(symbol, None)));
            }
            Subject::Nothing(_) => {}
        }
        parts
    }

    /// What a keyword does, and whether its condition holds here.
    fn keyword(&self, range: &Range<u32>, kind: SyntaxKind, look: Option<&mut Look<'_, '_>>) -> String {
        let written = self.snapshot.slice(range.clone());
        let statement = self.place.table.statements(self.place.ix).find(|statement| {
            let of = self.place.in_file(statement.range.clone());
            of.start <= range.start && range.end <= of.end
        });
        let is_o_word =
            statement.is_some_and(|statement| matches!(statement.kind, StatementKind::OWord { .. }));
        let Some(does) = keywords::does(kind, &written.to_ascii_uppercase(), is_o_word) else {
            return String::new();
        };
        let mut text = format!("**{written}** {does}");
        let condition = match statement.map(|statement| &statement.kind) {
            Some(StatementKind::If { condition } | StatementKind::Do { condition, .. }) => *condition,
            Some(kind @ StatementKind::OWord { label, .. }) => kind.expressions().nth(label.expressions()),
            _ => None,
        };
        let is_condition = matches!(kind, SyntaxKind::IF_KW | SyntaxKind::ELSEIF_KW | SyntaxKind::WHILE_KW);
        let held = condition.zip(look).and_then(|(condition, look)| self.held(condition, look));
        match held {
            Some(held) if is_condition => {
                let verdict = match Abstract::truth(&held) {
                    Truth::True => "the condition holds here",
                    Truth::False => "the condition does not hold here",
                    Truth::Unknown => "whether the condition holds here is not known",
                };
                let _ = write!(text, "\n\n{verdict}");
            }
            Some(held) if kind == SyntaxKind::REPEAT_KW => {
                // A half goes to the even neighbour (observed).
                let turns = Abstract::known(&held).map(|count| count.round_ties_even().max(0.0));
                let count = turns.map_or_else(|| value(&held), |turns| turns.to_string());
                let _ = write!(text, "\n\nhere: {count} times");
            }
            _ => {}
        }
        text
    }

    /// What an expression of the block comes to before the block.
    fn held(&self, expr: ExprIx, look: &mut Look<'_, '_>) -> Option<AbstractValue> {
        let range = self.place.in_file(self.place.table.expr(expr).range.clone());
        let at = At { file: 0, block: self.place.number };
        let values = look.expressions(at, &self.state?.before);
        values.into_iter().find(|(of, _)| *of == range).map(|(_, held)| held)
    }

    /// How the program comes to the block, where not every path does once.
    fn way(&self) -> Option<String> {
        let Some(state) = self.state else {
            return (!self.is_without_state).then(|| "no path comes here".to_owned());
        };
        if state.on_every_path {
            return (state.visits > 1).then(|| format!("comes here {} times", state.visits));
        }
        let place = |at: At| {
            let place = self.snapshot.place(at.block).filter(|_| at.file == 0)?;
            Some(self.snapshot.line_at(place.range().start) + 1)
        };
        let decisions: Vec<String> = state
            .definitions
            .decisions()
            .iter()
            .rev()
            .filter_map(|decision| {
                Some(format!("line {} goes on at line {}", place(decision.at)?, place(decision.to)?))
            })
            .take(MOST_DECISIONS)
            .collect();
        Some(if decisions.is_empty() {
            "some paths come here".to_owned()
        } else {
            format!("some paths come here: {}", decisions.into_iter().rev().collect::<Vec<_>>().join(", "))
        })
    }

    /// What the state rests on that nobody can know.
    fn assumed(&self) -> Option<String> {
        self.state.filter(|state| state.is_assumed)?;
        assumed(self.snapshot, self.place.range().end).map(|words| format!("*{words}*"))
    }

    /// Where the machine is before and after the block, what the block changes, and what else is in effect.
    fn around(&self, look: &Look<'_, '_>) -> String {
        let Some(state) = self.state else { return String::new() };
        let reader = StateReader::new(self.snapshot, look.model());
        let from = reader.point(&state.before, state.before.actual());
        let mut lines: Vec<String> = Vec::new();
        let after = state.settled().map(|(after, _)| after).or(state.after.as_ref());
        // Nothing comes back: people see what the call begins with.
        let is_inside = state.calls() && state.returned.is_none();
        let in_effect: Vec<String> = match after {
            Some(inside) if is_inside => {
                lines.push("calls a program: what it leaves in effect is not known here".to_owned());
                reader.items(inside).into_iter().map(|(_, item)| item).collect()
            }
            None => {
                lines.extend((!from.is_empty()).then(|| format!("at `{from}`")));
                lines.push("the program does not go on after this block".to_owned());
                reader.items(&state.before).into_iter().map(|(_, item)| item).collect()
            }
            Some(state_after) => {
                let to = reader.point(state_after, state_after.actual());
                lines.extend(match (from.as_str(), to.as_str()) {
                    ("", "") => None,
                    (_, "") => Some(format!("at `{from}`, then not known")),
                    _ => changed(&from, &to).or_else(|| Some(format!("at `{to}`"))),
                });
                let (before, after) = (reader.items(&state.before), reader.items(state_after));
                let held = |items: &[(Item, String)], item: Item| {
                    items.iter().find(|(of, _)| *of == item).map(|(_, text)| text.clone()).unwrap_or_default()
                };
                // A motion that a cycle took the place of is not over.
                let is_hidden = |item: Item| {
                    item == Item::Mode(Role::Motion)
                        && after.iter().any(|(of, _)| *of == Item::Mode(Role::Cycle))
                };
                let all = before.iter().chain(&after).map(|(item, _)| *item);
                let mut seen: Vec<Item> = Vec::new();
                for item in all.filter(|item| !is_hidden(*item)) {
                    if !seen.contains(&item) {
                        seen.push(item);
                    }
                }
                let changes: Vec<String> = seen
                    .iter()
                    .filter_map(|item| {
                        let (was, is) = (held(&before, *item), held(&after, *item));
                        if is.is_empty() && StateReader::is_unknown(state_after, *item) {
                            return Some(format!("`{was}` → not known"));
                        }
                        changed(&was, &is)
                    })
                    .collect();
                lines.push(if changes.is_empty() {
                    "changes no mode".to_owned()
                } else {
                    changes.join(", ")
                });
                after.into_iter().filter(|item| before.contains(item)).map(|(_, item)| item).collect()
            }
        };
        lines.extend(after.and_then(|after| self.wrap(after, &reader)));
        if !in_effect.is_empty() {
            lines.push(format!("in effect: {}", list(&in_effect)));
        }
        lines.extend(self.way());
        lines.extend(self.assumed());
        lines.join("\n\n")
    }

    /// What a block that has the code for it wraps, and around what.
    fn wrap(&self, after: &State<Abstract>, reader: &StateReader<'_>) -> Option<String> {
        let mut words = self.place.table.words(self.place.block()).iter();
        let wraps = |word: &Word| reader.model.effect(word.code) == Effect::CylinderMapping;
        if !words.any(wraps) {
            return None;
        }
        let cylinder = after.cylinder()?;
        let units = reader.units(after);
        let diameter = if cylinder.diameter.is_finite() {
            format!("{} {}", plain(cylinder.diameter / units.in_mm(), decimals(units)), unit(units))
        } else {
            "not known".to_owned()
        };
        let (linear, rotary) = (cylinder.linear.name(), cylinder.rotary.name());
        Some(format!("`{linear}` goes around the cylinder on `{rotary}`, diameter {diameter}"))
    }

    /// The plane of the block, where it is known.
    fn plane(&self, look: &Look<'_, '_>) -> Option<Plane> {
        let state = self.state?;
        state.after.as_ref().unwrap_or(&state.before).plane(look.model())
    }

    /// What is in effect at the block and may read its words: the cycle, the motion, compensation and length.
    fn in_effect(&self, look: &Look<'_, '_>) -> Vec<Code<'_>> {
        let control = self.snapshot.control();
        let Some(state) = self.state else { return Vec::new() };
        let words = self.place.table.words(self.place.block());
        let is_changed = |role: Role| {
            words.iter().any(|word| word.code.is_some() && look.model().role(word.code) == Some(role))
        };
        let mode = |role: Role| state.before.mode(role).only().filter(|_| !is_changed(role));
        let cycle = state.before.active_cycle(look.model());
        let motion = state.before.mode(Role::Motion).only();
        let modes = [cycle, motion, mode(Role::Compensation), mode(Role::Length)];
        modes.into_iter().flatten().filter_map(|code| control.code_at(code)).collect()
    }

    /// Under inverse time the feed is a time, whatever other code of the block reads it.
    fn inverse_time(&self, look: Option<&Look<'_, '_>>) -> Option<Code<'_>> {
        let control = self.snapshot.control();
        let mut words = self.place.table.words(self.place.block()).iter();
        let own = words.find_map(|word| {
            control.code_at(word.code).filter(|code| Role::of(code.effect()) == Some(Role::FeedMode))
        });
        let before = || {
            let (_, state) = look.zip(self.state)?;
            control.code_at(state.before.mode(Role::FeedMode).only()?)
        };
        own.or_else(before).filter(|code| code.effect() == Effect::FeedInverseTime)
    }

    /// The code that gives a word its meaning: one of the block, else one in effect.
    fn reader(&self, word: &Word, look: Option<&Look<'_, '_>>) -> Option<(Code<'_>, &WordEntry)> {
        let control = self.snapshot.control();
        let words = || self.place.table.words(self.place.block()).iter();
        let in_block = words().filter_map(|word| control.code_at(word.code));
        // After a call words are arguments, whatever motion is in effect.
        let look = look.filter(|_| !in_block.clone().any(|code| code.entry().any_words));
        let in_effect = look.map(|look| self.in_effect(look)).unwrap_or_default();
        let found =
            in_block.chain(in_effect).find_map(|code| Some((code, describe::word_of(code, word.letter)?)));
        let is_feed = word.letter == Letter::of('F')
            && found.as_ref().is_none_or(|(code, _)| code.motion() != Motion::None);
        match self.inverse_time(look).filter(|_| is_feed) {
            Some(code) => Some((code, describe::word_of(code, word.letter)?)),
            None => found,
        }
    }

    /// A word that is not a code: its meaning, what its number counts, where the axis is.
    fn word(&self, word: &Word, mut look: Option<&mut Look<'_, '_>>) -> String {
        let control = self.snapshot.control();
        let general = control.letter(word.letter);
        let reader = self.reader(word, look.as_deref());
        let plane = look.as_deref().and_then(|look| self.plane(look));
        let calls = self
            .place
            .table
            .words(self.place.block())
            .iter()
            .find_map(|word| control.code_at(word.code).filter(|code| code.entry().any_words));
        let mut text = match (&reader, calls, general) {
            (Some((code, entry)), _, _) => {
                let height = match self.axis(word.letter) {
                    Some(axis)
                        if code.motion() == Motion::Arc
                            && plane.is_some_and(|plane| is_across(axis, plane)) =>
                    {
                        ", the height of the helix"
                    }
                    _ => "",
                };
                let is = format!("{}{height} (`{}`)", self.meaning(*code, entry), code.entry().code);
                format!("**{}** {}", word.letter, describe::meaning(&is, &describe::needs(entry)))
            }
            (None, Some(code), _) if argument(control, word.letter).is_some() => {
                let number = argument(control, word.letter).unwrap_or_default();
                format!(
                    "**{}** argument `#{number}` of the program that `{}` calls",
                    word.letter,
                    code.entry().code
                )
            }
            (None, _, Some(entry)) => {
                format!("**{}** {}", word.letter, describe::meaning(&entry.is, entry.kind.in_words()))
            }
            (None, _, None) => format!("**{}** no address of {}", word.letter, control.title()),
        };
        let kind = reader.as_ref().map(|(_, entry)| entry.kind).or(general.map(|entry| entry.kind));
        let or_label = reader.as_ref().is_some_and(|(_, entry)| entry.or_label);
        let moved = self.moved(word, reader);
        let letters = self.place.block().letters;
        let is_packed = reader.as_ref().is_some_and(|(_, entry)| entry.is_packed_beside(letters));
        // What an argument counts is for the macro to say, and digits that are packed count nothing together.
        if calls.is_none()
            && !is_packed
            && let Some(counted) = self.counted(word, kind, &moved, look.as_deref_mut())
        {
            let _ = write!(text, "\n\n{counted}");
        }
        let target = match kind {
            Some(WordKind::Label | WordKind::Program) => {
                symbol_at(self.snapshot, self.place.in_file(word.range()).end)
            }
            _ => None,
        };
        if let Some(occurrence) = target {
            let symbol = self.label_of(&occurrence.symbol).filter(|_| or_label).unwrap_or(occurrence.symbol);
            let _ = write!(text, "\n\n{}", self.symbol(&symbol, None));
        }
        let here = self.place.in_file(word.range());
        let tool = tool_word_at(self.snapshot, here.end).filter(|word| word.range == here);
        if let Some(tool) = tool {
            let number = tool_of(self.snapshot, &tool);
            let told = told_of_tool(self.snapshot, &tool_names(self.snapshot), number);
            if !told.is_empty() {
                let told: Vec<String> = told.iter().map(|told| Foreign::Prose(told).to_string()).collect();
                let _ = write!(text, "\n\ntool {number}: {}", told.join(", "));
            }
        }
        if let (Some(look), Some(axis), None) = (look, moved.axis.filter(|_| moved.is_target), calls) {
            text.push_str(&self.coordinate(axis, look));
            let wrapped = self.state.and_then(|state| state.after.as_ref()?.cylinder().copied());
            if let Some(cylinder) = wrapped.filter(|cylinder| cylinder.linear == axis) {
                let _ = write!(text, "\n\nturns `{}` instead:", cylinder.rotary.name());
                text.push_str(&self.coordinate(cylinder.rotary, look));
            }
        }
        text
    }

    /// The label of the program under way that has the number of a called one: newer software looks there first.
    fn label_of(&self, symbol: &Symbol) -> Option<Symbol> {
        let Symbol::Program(number) = symbol else { return None };
        let program = program_around(self.snapshot, self.place.range().start);
        let labels = &self.snapshot.file_index().labels;
        let is_it =
            |label: &gcheck_program::Label| label.number == *number && program.contains(&label.range.start);
        labels.iter().any(is_it).then(|| Symbol::Label { number: *number, program: program.clone() })
    }

    /// What a word means to a code. Of a code of two blocks, what it means in this one.
    fn meaning<'e>(&self, code: Code<'_>, entry: &'e WordEntry) -> &'e str {
        let Some(parts) = entry.is.strip_prefix("first block: ") else { return &entry.is };
        let Some((first, second)) = parts.split_once("; second block: ") else { return &entry.is };
        if self.is_second_block(code) { second } else { first }
    }

    /// Of a code of two blocks, is this one the second? It has the words that only the second one needs.
    fn is_second_block(&self, code: Code<'_>) -> bool {
        let letters = self.place.block().letters;
        let has = |letter: &str| Letter::parse(letter).is_some_and(|letter| letters.contains(letter));
        code.entry().words.iter().any(|word| {
            let is_of_second = word.when.as_deref() == Some("in the second block");
            let is_of_both = word.is.starts_with("first block: ");
            is_of_second && !is_of_both && has(&word.letter)
                || word.packed_without.chars().any(|letter| has(&letter.to_string()))
        })
    }

    /// Which axis a word speaks of, and how.
    fn moved(&self, word: &Word, reader: Option<(Code<'_>, &WordEntry)>) -> Moved {
        let axis = self.axis(word.letter);
        let Some((code, entry)) = reader else { return Moved { axis, is_target: true, counts: None } };
        let meaning = self.meaning(code, entry);
        let counts = match (meaning.contains("radius"), meaning.contains("diameter")) {
            (true, _) => Some(Counts::Radius),
            (_, true) => Some(Counts::Diameter),
            _ => None,
        };
        // Words of these are depths, stock and shifts of a profile, values of tables, factors and angles.
        let is_amount = matches!(
            code.effect(),
            Effect::RoughAlongZ
                | Effect::RoughAlongX
                | Effect::RepeatPattern
                | Effect::FinishProfile
                | Effect::WriteOffsets
                | Effect::Dwell
                | Effect::ScalingOn
                | Effect::RotationOn
                | Effect::GeneralPocket
        );
        let is_place = matches!(entry.kind, WordKind::Length | WordKind::Angle);
        Moved { axis, is_target: is_place && !is_amount && counts != Some(Counts::Radius), counts }
    }

    /// The axis that an address moves.
    fn axis(&self, letter: Letter) -> Option<Axis> {
        let control = self.snapshot.control();
        let increments = &control.semantics().increments;
        let increment = increments.get(&letter.to_string()).and_then(|axis| Axis::of(Letter::parse(axis)?));
        increment.or_else(|| Axis::of(letter).filter(|_| control.axes().contains(letter)))
    }

    /// What the number of a word comes to: its value and unit, where the text does not say so itself.
    fn counted(
        &self,
        word: &Word,
        kind: Option<WordKind>,
        moved: &Moved,
        look: Option<&mut Look<'_, '_>>,
    ) -> Option<String> {
        let (look, state) = look.zip(self.state)?;
        let written = self.snapshot.slice(self.place.in_file(word.range()));
        let written = Foreign::Code(written.trim());
        let reader = StateReader::new(self.snapshot, look.model());
        let units = reader.units(&state.before);
        let unit = match kind? {
            WordKind::Length | WordKind::LeastIncrements => unit(units),
            WordKind::Angle => "degrees",
            WordKind::Seconds => "s",
            WordKind::Milliseconds => "ms",
            WordKind::Feed => {
                return Some(format!("{written} {}", reader.feed(state.after.as_ref()?)?.split_once(' ')?.1));
            }
            WordKind::SecondsOrMilliseconds => {
                return Some(format!(
                    "{written} is {} {}",
                    plain(word.number()?, 6),
                    if word.shape.point { "s" } else { "ms" }
                ));
            }
            _ => return None,
        };
        let is_diameter = moved.axis == Some(Axis::X)
            && kind == Some(WordKind::Length)
            && reader.diameter(&state.before)
            && match moved.counts {
                Some(Counts::Radius) => false,
                Some(Counts::Diameter) => true,
                None => moved.is_target,
            };
        let diameter = if is_diameter { ", a diameter" } else { "" };
        match word.value {
            Value::Number(number) => {
                let control = self.snapshot.control();
                let counts_steps = kind == Some(WordKind::LeastIncrements);
                let is_scaled = !word.shape.point
                    && (counts_steps || control.letter(word.letter).is_some_and(|entry| entry.scaled));
                let counts = match is_scaled {
                    true if counts_steps => number * control.numbers().least(units == Units::Inch),
                    true => look.counted(word.letter, number, Some(units)),
                    false => number,
                };
                let why = if is_scaled && counts.to_bits() != number.to_bits() {
                    ": without a decimal point it counts least increments"
                } else {
                    ""
                };
                Some(format!("{written} is {} {unit}{diameter}{why}", plain(counts, 6)))
            }
            Value::Expr(expr) => {
                let held = self.held(expr, look)?;
                Some(format!("{written} is {} {unit}{diameter}", value(&held)))
            }
            Value::Missing => None,
        }
    }

    /// Where an axis is before and after the block.
    fn coordinate(&self, axis: Axis, look: &Look<'_, '_>) -> String {
        let Some(state) = self.state else { return String::new() };
        let reader = StateReader::new(self.snapshot, look.model());
        let before = reader.places(&state.before);
        let after = state.after.as_ref().map(|after| (after, reader.places(after)));
        let mut text = String::new();
        let shown = |state: &State<Abstract>, point: &Position| {
            let (units, diameter) = (reader.units(state), reader.diameter(state));
            point.get(axis).map(|value| coordinate(axis, value, units, diameter))
        };
        for (name, of) in [
            ("work", (|places| places.work) as fn(&crate::state_reader::Places) -> Position),
            ("programmed", |places| places.programmed),
            ("machine", |places| places.machine),
            ("tool tip", |places| places.tip),
        ] {
            let from = shown(&state.before, &of(&before));
            let to = after.as_ref().and_then(|(after, places)| shown(after, &of(places)));
            let same_as_work = name == "programmed"
                && of(&before).raw(axis).to_bits() == before.work.raw(axis).to_bits()
                && after.as_ref().is_none_or(|(_, places)| {
                    places.programmed.raw(axis).to_bits() == places.work.raw(axis).to_bits()
                });
            if (from.is_none() && to.is_none()) || same_as_work {
                continue;
            }
            let unknown = || "not known".to_owned();
            let _ = write!(
                text,
                "\n| {name} | {} | {} |",
                from.unwrap_or_else(unknown),
                to.unwrap_or_else(unknown)
            );
        }
        if text.is_empty() {
            return text;
        }
        format!("\n\n| {} | before | after |\n|---|---|---|{text}", axis.name())
    }

    /// A label, program, subroutine, variable or parameter.
    fn symbol(&self, symbol: &Symbol, look: Option<&mut Look<'_, '_>>) -> String {
        match symbol {
            Symbol::Variable { number, .. } => {
                let entry = match self.control().variable(*number) {
                    Variable::Known(entry) => describe::variable(entry),
                    Variable::Unlisted => {
                        format!("not among the variables listed for {}", self.control().title())
                    }
                };
                let held = look.zip(self.state).map(|(look, state)| Held {
                    before: look.variable(*number, &state.before),
                    after: state.after.as_ref().and_then(|after| look.variable(*number, after)),
                });
                self.variable(&format!("#{number}"), &entry, held.as_ref(), symbol)
            }
            Symbol::Parameter { name, part } => {
                let entry = match self.control().named_parameter(name) {
                    Some(entry) => describe::variable(entry),
                    None if part.is_some() => "named parameter, local".to_owned(),
                    None => "named parameter, global".to_owned(),
                };
                let held = look.zip(self.state).map(|(look, state)| Held {
                    before: look.parameter(name, &state.before),
                    after: state.after.as_ref().and_then(|after| look.parameter(name, after)),
                });
                self.variable(&format!("#<{name}>"), &entry, held.as_ref(), symbol)
            }
            Symbol::Label { .. } | Symbol::Program(_) | Symbol::Subroutine(_) | Symbol::Branch { .. } => {
                self.named_places(symbol)
            }
        }
    }

    fn variable(&self, name: &str, entry: &str, held: Option<&Held>, symbol: &Symbol) -> String {
        let mut text = format!("**{}** {entry}", Foreign::Prose(name));
        match held {
            Some(Held { before, after: Some(after) }) if before.as_ref() != Some(after) => {
                let before = before.as_ref().map_or_else(|| "not known".to_owned(), value);
                let _ = write!(text, "\n\nafter this block: {} (before it: {before})", value(after));
            }
            Some(Held { before: Some(before), .. }) => {
                let _ = write!(text, "\n\nhere: {}", value(before));
            }
            _ => {}
        }
        // Large files are not searched while somebody waits for a hover.
        if self.snapshot.len() > LARGE {
            return text;
        }
        let own = self.place.range();
        let set: Vec<Range<u32>> = occurrences_in(self.snapshot, symbol)
            .into_iter()
            .filter(|occurrence| {
                occurrence.kind == ReferenceKind::Write && !own.contains(&occurrence.range.start)
            })
            .map(|occurrence| occurrence.range)
            .collect();
        // The nearest before the place say most.
        let before = set.partition_point(|range| range.start < own.start);
        let from = before.saturating_sub(MOST_ASSIGNMENTS - 1);
        for range in set.iter().skip(from).take(MOST_ASSIGNMENTS) {
            let line = self.snapshot.line_at(range.start);
            let written = self.snapshot.line_text(line);
            let _ = write!(text, "\n- set in line {}: {}", line + 1, Foreign::Code(written.trim()));
        }
        text
    }

    /// The file that holds a program, and what its head calls it.
    fn elsewhere(&self, symbol: &Symbol) -> Option<String> {
        let Symbol::Program(number) = symbol else { return None };
        let source = self.snapshot.settings().programs.source_of_number(*number)?;
        let is_head = |line: &&str| {
            let line = line.trim_start();
            line.strip_prefix(['O', 'o', ':']).is_some_and(|rest| {
                let digits = rest.trim_start_matches('0');
                digits
                    .strip_prefix(&number.to_string())
                    .is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
            })
        };
        let title = source.text.lines().find(is_head).and_then(title);
        let title = title.map(|title| format!(" ({})", Foreign::Prose(title))).unwrap_or_default();
        Some(format!(", in {}{title}", Foreign::Code(&source.name)))
    }

    /// Where a label, program or subroutine is, and how many places of the file name it.
    fn named_places(&self, symbol: &Symbol) -> String {
        let occurrences = occurrences_in(self.snapshot, symbol);
        let head = occurrences.iter().find(|occurrence| occurrence.kind == ReferenceKind::Write);
        let uses = occurrences.iter().filter(|occurrence| occurrence.kind == ReferenceKind::Read).count();
        let what = match symbol {
            Symbol::Label { number, .. } => format!("**N{number}** sequence number"),
            Symbol::Program(number) => format!("**O{number}** program"),
            Symbol::Subroutine(label) => {
                format!("**{}** subroutine", Foreign::Prose(&crate::document_symbols::o_name(label)))
            }
            Symbol::Branch { label, .. } => {
                format!("**{}** label", Foreign::Prose(&crate::document_symbols::o_name(label)))
            }
            Symbol::Variable { .. } | Symbol::Parameter { .. } => String::new(),
        };
        let place = match head {
            Some(head) => {
                let line = self.snapshot.line_at(head.range.start);
                let text = self.snapshot.line_text(line).into_owned();
                let comment =
                    title(&text).map(|title| format!(" ({})", Foreign::Prose(title))).unwrap_or_default();
                format!(", line {}{comment}: {}", line + 1, Foreign::Code(text.trim()))
            }
            None => self.elsewhere(symbol).unwrap_or_else(|| ", not in this file".to_owned()),
        };
        let named = match uses {
            0 => "nothing in this file names it".to_owned(),
            1 => "named in 1 place".to_owned(),
            _ => format!("named in {uses} places"),
        };
        format!("{what}{place}\n\n{named}")
    }
}

/// Bytes of a file that is searched for a hover.
const LARGE: u32 = 1 << 20;

/// The local variable that an argument of a macro call is.
fn argument(control: &Control, letter: Letter) -> Option<u8> {
    control.semantics().argument_letters.get(&letter.to_string()).copied()
}

/// Items as code, in one line.
fn list(items: &[String]) -> String {
    items.iter().map(|item| format!("`{item}`")).collect::<Vec<_>>().join(" ")
}

/// Which axis a word speaks of, and how.
struct Moved {
    axis: Option<Axis>,
    /// The word says where the axis goes.
    is_target: bool,
    /// What the control's own words say of its number.
    counts: Option<Counts>,
}

/// Across the work, a number is a radius or a diameter.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Counts {
    Radius,
    Diameter,
}

/// What a variable holds around a block, where it can be said.
struct Held {
    before: Option<AbstractValue>,
    after: Option<AbstractValue>,
}

/// What becomes of a text: `` `G0` → `G1` ``; `None` where it stays.
fn changed(before: &str, after: &str) -> Option<String> {
    match (before, after) {
        _ if before == after => None,
        ("", _) => Some(format!("`{after}`")),
        (_, "") => Some(format!("`{before}` off")),
        _ => Some(format!("`{before}` → `{after}`")),
    }
}

/// Is the axis perpendicular to the plane?
fn is_across(axis: Axis, plane: Plane) -> bool {
    let (_, _, across) = plane.axes();
    Axis::ALL.get(across) == Some(&axis)
}

/// What a code does, how long, and which words it reads.
fn in_short(code: Code<'_>, plane: Option<Plane>) -> String {
    let entry = code.entry();
    let lasts = if code.group().modal { "stays in effect" } else { "for its own block" };
    let mut text = format!("{} *({}, {lasts})*", entry.summary, code.group().title);
    let words = words_in_short(code, plane);
    if !words.is_empty() {
        let _ = write!(text, "\n\n{}", words.join("; "));
    }
    text
}

/// The words of a code: those that it needs, those of which it needs one, those that an earlier block may give, the others.
fn words_in_short(code: Code<'_>, plane: Option<Plane>) -> Vec<String> {
    let entry = code.entry();
    // The centre of an arc is in its plane.
    let stray = plane.filter(|_| code.motion() == Motion::Arc).map(|plane| match plane {
        Plane::Xy => "K",
        Plane::Zx => "J",
        Plane::Yz => "I",
    });
    let mut left: Vec<&WordEntry> =
        entry.words.iter().filter(|word| Some(word.letter.as_str()) != stray).collect();
    let mut take = |of: &dyn Fn(&WordEntry) -> bool| {
        let (taken, others): (Vec<_>, Vec<_>) = left.iter().copied().partition(|word| of(word));
        left = others;
        taken.into_iter().map(|word| word.letter.clone()).collect::<Vec<_>>()
    };
    let mut said: Vec<String> = Vec::new();
    let needed = take(&|word| word.need == Need::Required);
    if !needed.is_empty() {
        said.push(format!("needs {}", list(&needed)));
    }
    let has = |letters: &[String], word: &WordEntry| letters.contains(&word.letter);
    for letters in &entry.one_of {
        let choice = take(&|word| has(letters, word));
        if choice.is_empty() {
            continue;
        }
        let excludes = entry.not_together.iter().any(|set| choice.iter().all(|letter| set.contains(letter)));
        let how = if excludes { "exactly one of" } else { "at least one of" };
        said.push(if code.motion() == Motion::Arc && choice.iter().any(|letter| letter == "R") {
            let centre: Vec<String> = choice.into_iter().filter(|letter| letter != "R").collect();
            format!("a centre {} or `R`", list(&centre))
        } else {
            format!("{how} {}", list(&choice))
        });
    }
    let lasting = take(&|word| {
        let is_here_or = word.when.as_deref().is_some_and(|when| when.starts_with("here or "));
        word.need == Need::Modal || word.need == Need::Conditional && is_here_or
    });
    if !lasting.is_empty() {
        said.push(format!("here or earlier {}", list(&lasting)));
    }
    let mut others: Vec<String> = Vec::new();
    for letters in &entry.not_together {
        let exclusive = letters.iter().all(|letter| left.iter().any(|word| word.letter == *letter));
        if exclusive {
            let (of, rest): (Vec<_>, Vec<_>) = left.iter().copied().partition(|word| has(letters, word));
            left = rest;
            let of: Vec<String> = of.into_iter().map(|word| word.letter.clone()).collect();
            others.push(format!("one of {}", list(&of)));
        }
    }
    let rest: Vec<String> = left.into_iter().map(|word| word.letter.clone()).collect();
    if !rest.is_empty() {
        others.push(list(&rest));
    }
    if !others.is_empty() {
        said.push(format!("may have {}", others.join(", ")));
    }
    said
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use expect_test::{Expect, expect};
    use gcheck_db::Settings;
    use gcheck_engine::{Cutting, Position, Tool};
    use gcheck_geometry::Mm;

    use super::hover;
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        let mut fixture = Fixture::new(control, text);
        let found = hover(&mut fixture.database, fixture.document, fixture.offset, &|| false);
        let shown = found.map_or_else(
            || "nothing\n".to_owned(),
            |found| format!("[{}]\n{}\n", fixture.snapshot().slice(found.range), found.markdown),
        );
        expected.assert_eq(&shown);
    }

    #[test]
    fn a_tool_shows_its_name_and_what_the_configuration_tells_of_it() {
        check(
            "haas-mill",
            "%\nO1\nG21\nT3 M6 (10 MM END MILL)\nG43 $0H3 Z1.\nM30\n%\n",
            &expect![[r#"
            [H3]
            **H** length offset, normally that of the tool in the spindle; H0 cancels (`G43`), here or earlier, whole number, 0 to 2999, but not 201 to 999

            tool 3: 10 MM END MILL
        "#]],
        );
    }

    #[test]
    fn after_a_program_that_is_not_here_the_state_goes_on_as_assumed() {
        check(
            "fanuc-mill",
            "O1\nG21 G90 G0 G54 X0. Y0.\nG43 H1 Z50.\nG65 P9832\nG65 P9810 Z10. F1000.\nG0 X5.\n$0G1 Z-5. F200.\nM30\n",
            &expect![[r#"
                [G1]
                **G1** linear interpolation

                `X5 Y0 Z50` → `X5 Y0 Z-5`

                `G0` → `G1`, `F200 mm/min`

                in effect: `G17` `G90` `G94` `G21` `G43` `G98` `G54` `G64` `G97` `spindle stopped` `H1`

                *assumed: O9832 and O9810, which were not found, change nothing*

                ---

                Moves in a straight line at the feed rate. *(motion, stays in effect)*

                here or earlier `F`; may have `X` `Y` `Z` `A` `B` `C` `U` `V` `W` `,R` `,C` `,A`
            "#]],
        );
    }

    #[test]
    fn after_a_probing_move_the_state_goes_on_at_its_target() {
        check(
            "haas-mill",
            "O1\nG21 G90 G0 G54 X0. Y0. Z2.\nG31 Z-1. F5.\n$0G1 X5. F200.\nM30\n",
            &expect![[r#"
                [G1]
                **G1** straight cut at feed

                `X0 Y0 Z-1` → `X5 Y0 Z-1`

                `G0` → `G1`, `F5 mm/min` → `F200 mm/min`

                in effect: `G17` `G90` `G94` `G21` `G98` `G54` `G64` `spindle stopped`

                *assumed: the probe touches at its target*

                ---

                Moves the named axes on a straight line at the programmed feed. *(motion, stays in effect)*

                here or earlier `F`; may have `X` `Y` `Z` `A` `B` `C` `U` `V` `W` `L` `,C` `,R`
            "#]],
        );
    }

    #[test]
    fn a_tool_with_teeth_shows_chip_load_and_surface_speed_and_blending_its_tolerance() {
        let mut settings = Settings::new(gcheck_controls::load("linuxcnc").unwrap(), gcheck_rules::RULES);
        let mut machine = (*settings.machine).clone();
        machine.engine.cutting.insert(1, Cutting { teeth: Some(4), ..Cutting::default() });
        let tool = Tool {
            pocket: 1,
            offset: Position::ZERO,
            diameter: Mm(10.0),
            corner_radius: Mm(0.0),
            angles: [0.0; 2],
            orientation: 0,
        };
        machine.engine.tools.insert(1, tool);
        settings.machine = Arc::new(machine);
        let text = "G21 G90 G17 G94 G64 P0.02\nT1 M6\nS3000 M3\nG1 X0 F600\n$0G4 P1\nX10\nM2\n";
        let mut fixture = Fixture::with(text, &settings);
        let found = hover(&mut fixture.database, fixture.document, fixture.offset, &|| false).unwrap();
        for shown in ["`F600 mm/min, 0.05 mm a tooth`", "`S3000 rpm, 94 m/min`", "`G64 within 0.02 mm`"] {
            assert!(found.markdown.contains(shown), "{shown} is not in {}", found.markdown);
        }
    }

    #[test]
    fn a_call_shows_the_state_when_it_is_back() {
        check(
            "haas-lathe",
            "O1\nG21 G18 G54 G97 S500 M3\n$0G105 J30. K60. I35. P2\nM30\nO2\nG99 S200\nM99\n",
            &expect![[r#"
                [G105]
                **G105** servo bar feed

                `S500 rpm` → `S200 rpm`, `spindle clockwise` → `spindle stopped`

                in effect: `G18` `G390` `G99` `G21` `G54` `G64` `G97` `G170`

                ---

                Pushes the bar for the next part, or loads a new bar when the rest is too short. *(codes for one block, for its own block)*

                may have `I` `J` `K` `P` `Q` `R`
            "#]],
        );
        check(
            "haas-lathe",
            "O1\nG21 G18 G99 G54 M3 S500\n$0M98 P77\nG0 X1.\nM30\n",
            &expect![[r#"
                [M98]
                **M98** subprogram call

                changes no mode

                in effect: `G18` `G390` `G99` `G21` `G54` `G64` `G97` `G170` `S500 rpm` `spindle clockwise`

                *assumed: O77, which was not found, changes nothing*

                ---

                Calls program P; M99 brings it back. *(calls, jumps, questions, for its own block)*

                may have `P` `L`
            "#]],
        );
        check(
            "haas-lathe",
            "O1\nG21 G18 G99 G54 M3 S500\n$0M97 P5 (NO BLOCK AFTER)\nN5 G97 S300 M4\nM99\n",
            &expect![[r#"
                [M97]
                **M97** local subprogram call

                `S500 rpm` → `S300 rpm`, `spindle clockwise` → `spindle counter-clockwise`

                in effect: `G18` `G390` `G99` `G21` `G54` `G64` `G97` `G170`

                ---

                Calls the blocks from N = P on in this program; M99 brings it back. *(calls, jumps, questions, for its own block)*

                needs `P`; may have `L`
            "#]],
        );
    }

    #[test]
    fn a_variable_where_it_is_set() {
        check(
            "haas-mill",
            "O1\n#100$0=2.\n#100=#100+1.\nM30\n",
            &expect![[r#"
            [100]
            **#100** common variables (kept over power off)

            after this block: 2 (before it: not known)
            - set in line 3: `#100=#100+1.`
        "#]],
        );
        check(
            "haas-mill",
            "O1\n#100=2.\n#10$00=#100+1.\nM30\n",
            &expect![[r#"
            [#100]
            **#100** common variables (kept over power off)

            after this block: 3 (before it: 2)
            - set in line 2: `#100=2.`
        "#]],
        );
        check(
            "linuxcnc",
            "#<dep$0th> = 2\nM2\n",
            &expect![[r#"
            [#<depth>]
            **#\<depth\>** named parameter, local

            after this block: 2 (before it: not known)
        "#]],
        );
    }

    #[test]
    fn a_code_that_ends_something_or_nothing() {
        check(
            "haas-mill",
            "O1\nG54 G0 X1. Z1.\nG81 Z-1. R.1 F9.\nG8$00\nM30\n",
            &expect![[r#"
            [G80]
            **G80** canned cycle off

            at `X1 Z1`

            `G81` off, `G0`

            in effect: `G17` `G90` `G94` `G20` `G98` `G54` `G64` `F9 inch/min` `spindle stopped`

            ---

            Ends the active canned cycle and forgets its dwell. *(canned cycle, stays in effect)*
        "#]],
        );
        check(
            "haas-mill",
            "O1\nG54 G0 X1. Z1.\nG$080\nM30\n",
            &expect![[r#"
            [G80]
            **G80** canned cycle off

            at `X1 Z1`

            changes no mode

            in effect: `G0` `G17` `G90` `G94` `G20` `G98` `G54` `G64` `spindle stopped`

            ---

            Ends the active canned cycle and forgets its dwell. *(canned cycle, stays in effect)*
        "#]],
        );
        check(
            "haas-mill",
            "O1\nG54 G0 X1.\nM3$00\n",
            &expect![[r#"
                [M30]
                **M30** program end and rewind

                at `X1`, then not known

                changes no mode

                in effect: `G0` `G17` `G90` `G94` `G20` `G98` `G54` `G64` `spindle stopped`

                ---

                Ends the program and goes back to its head. *(program stop and end, for its own block)*
            "#]],
        );
        check(
            "haas-mill",
            "O1\nGOTO 10\nG$054\nN10 M30\n",
            &expect![[r#"
            [G54]
            **G54** work offset 1

            no path comes here

            ---

            Positions are counted from work offset 1, kept in #5221 to #5226. *(work offset, stays in effect)*
        "#]],
        );
    }

    #[test]
    fn a_code_with_its_state() {
        check(
            "haas-mill",
            "%\nO1\nG21 G90 G54 G0 X1. Y2.\nG43 H1 Z5.\nG$083 Z-10. R2. Q3. F100.\nM30\n%\n",
            &expect![[r#"
                [G83]
                **G83** peck drilling

                at `X1 Y2 Z5`

                `G83`, `F100 mm/min`

                in effect: `G17` `G90` `G94` `G21` `G43` `G98` `G54` `G64` `spindle stopped` `H1`

                ---

                Drills in pecks and goes up to R after each to clear the chips. *(canned cycle, stays in effect)*

                here or earlier `Z` `R` `F` `Q`; may have `X` `Y` `A` `B` `C` `L` `I` `J` `K` `P` `E`
            "#]],
        );
    }

    #[test]
    fn a_coordinate() {
        check(
            "haas-mill",
            "%\nO1\nG21 G90 G54 G0 X1. Y2.\nG1 X$03. F100.\nM30\n%\n",
            &expect![[r#"
            [X3.]
            **X** X target (`G1`), optional, length

            `X3.` is 3 mm

            | X | before | after |
            |---|---|---|
            | work | 1 | 3 |
        "#]],
        );
        check(
            "haas-lathe",
            "O1\nG20 G54 T0101\nG0 X2. Z.1\nG1 U$0-.5 F.01\nM30\n",
            &expect![[r#"
            [U-.5]
            **U** distance in X, diameter (`G1`), optional, length

            `U-.5` is -0.5 inch, a diameter

            | X | before | after |
            |---|---|---|
            | work | 2 | 1.5 |
        "#]],
        );
    }

    #[test]
    fn a_length_in_least_increments() {
        let head = "O1\nG21 G18 G54\nG0 X22. Z4.\nG76 P$0010060 Q50 R0.02\n";
        // The digits of the first `P` are three numbers, and no length.
        check(
            "fanuc-lathe",
            head,
            &expect![[r#"
            [P010060]
            **P** six digits for spring passes, pull-out and angle (`G76`), in the second block, length in least increments, a whole number
        "#]],
        );
        let program = format!("{}G76 X18. Z-20. P$0920 Q300 F1.5\nM30\n", head.replace("$0", ""));
        check(
            "fanuc-lathe",
            &program,
            &expect![[r#"
            [P920]
            **P** thread height (`G76`), in the second block, length in least increments, a whole number

            `P920` is 0.92 mm: without a decimal point it counts least increments
        "#]],
        );
    }

    #[test]
    fn a_number_without_a_point() {
        check(
            "fanuc-mill",
            "O1\nG21 G90 G54 G0 X$01000\nM30\n",
            &expect![[r#"
                [X1000]
                **X** end point in X (`G0`), optional, length

                `X1000` is 1 mm: without a decimal point it counts least increments

                | X | before | after |
                |---|---|---|
                | work | not known | 1 |
            "#]],
        );
        check(
            "linuxcnc",
            "G21 G0 X1$0\nM2\n",
            &expect![[r#"
            [X1]
            **X** X end point (`G0`), optional, length

            `X1` is 1 mm

            | X | before | after |
            |---|---|---|
            | work | not known | 1 |
        "#]],
        );
        check(
            "haas-mill",
            "O1\nG20 G4 P$0500\nM30\n",
            &expect![[r#"
            [P500]
            **P** time: seconds with decimal point, milliseconds without (`G4`), required, seconds with a decimal point, milliseconds without, from 0

            `P500` is 500 ms
        "#]],
        );
    }

    #[test]
    fn variables_and_parameters() {
        check(
            "haas-mill",
            "O1\n#100=2.\nIF [#500 EQ 1] GOTO 10\n#100=3.\nN10 G0 X#10$00\nM30\n",
            &expect![[r#"
            [#100]
            **#100** common variables (kept over power off)

            here: 2 or 3
            - set in line 2: `#100=2.`
            - set in line 4: `#100=3.`
        "#]],
        );
        check(
            "haas-mill",
            "O1\nG0 X#502$01\nM30\n",
            &expect![[r#"
            [#5021]
            **#5021** present position, machine coordinates (the control's own, may only be read)

            here: not known
        "#]],
        );
        check(
            "linuxcnc",
            "#<depth> = 2\nG21 G0 Z[#<dep$0th> * 2]\nM2\n",
            &expect![[r#"
            [#<depth>]
            **#\<depth\>** named parameter, local

            here: 2
            - set in line 1: `#<depth> = 2`
        "#]],
        );
        check(
            "linuxcnc",
            "#<depth> = 2\nG21 G0 Z$0[#<depth> * 2]\nM2\n",
            &expect![[r#"
            [Z[#<depth> * 2]]
            **Z** Z end point (`G0`), optional, length

            `Z[#<depth> * 2]` is 4 mm

            | Z | before | after |
            |---|---|---|
            | work | not known | 4 |
        "#]],
        );
    }

    #[test]
    fn labels_programs_and_arguments() {
        check(
            "haas-mill",
            "O1\nN10 G0 X1.\nIF [#1 EQ 1] GOTO 1$00\nM30\n",
            &expect![[r#"
            [10]
            **N10** sequence number, line 2: `N10 G0 X1.`

            named in 1 place
        "#]],
        );
        check(
            "haas-mill",
            "O1\nM98 P$02\nM30\nO2 (SLOT)\nM99\n",
            &expect![[r#"
            [P2]
            **P** program to call (`M98`), unless a path in parentheses names the program, program number, from 0

            **O2** program, line 4 (SLOT): `O2 (SLOT)`

            named in 1 place
        "#]],
        );
        check(
            "haas-mill",
            "O1\nG65 P9010 A$01.5\nM30\n",
            &expect![[r#"
                [A1.5]
                **A** argument `#1` of the program that `G65` calls
            "#]],
        );
    }

    #[test]
    fn a_code_on_some_paths_says_how_the_program_comes_there() {
        check(
            "haas-mill",
            "%\nO1\nG20 G90 G54 G0 X1.\nIF [#500 EQ 1] GOTO 10\nG$01 X2.\nN10 M30\n%\n",
            &expect![[r#"
                [G1]
                **G1** straight cut at feed

                at `X1`

                the program does not go on after this block

                in effect: `G0` `G17` `G90` `G94` `G20` `G98` `G54` `G64` `spindle stopped`

                some paths come here: line 4 goes on at line 5

                ---

                Moves the named axes on a straight line at the programmed feed. *(motion, stays in effect)*

                here or earlier `F`; may have `X` `Y` `Z` `A` `B` `C` `U` `V` `W` `L` `,C` `,R`
            "#]],
        );
    }

    #[test]
    fn without_time_for_the_state_the_text_is_told() {
        let text = "G21 G90\nS500 M3\n$0G4 P1.\nM30\n";
        let mut fixture = Fixture::new("fanuc-mill", text);
        let found = hover(&mut fixture.database, fixture.document, fixture.offset, &|| true).unwrap();
        assert!(found.is_without_state && found.markdown.contains("Waits"), "{}", found.markdown);
        assert!(!found.markdown.contains("no path"), "{}", found.markdown);
        let found = hover(&mut fixture.database, fixture.document, fixture.offset, &|| false).unwrap();
        assert!(!found.is_without_state && found.markdown.contains("S500"), "{}", found.markdown);
    }

    #[test]
    fn text_of_a_program_is_never_more_than_text() {
        let shown = |control: &str, text: &str| {
            let mut fixture = Fixture::new(control, text);
            let found = hover(&mut fixture.database, fixture.document, fixture.offset, &|| false);
            found.unwrap().markdown
        };
        let called = "O1\nM98 P$02\nM30\nO2 ([HELP]`evil` ![a] <img src=x>)\nM99\n";
        let text = shown("haas-mill", called);
        assert!(text.contains(r"(\[HELP\]\`evil\` \!\[a\] \<img src\=x\>)"), "{text}");
        assert!(text.contains("`` O2 ([HELP]`evil` ![a] <img src=x>) ``"), "{text}");
        let text = shown("linuxcnc", "#<d$0epth> = 2\nM2\n");
        assert!(text.starts_with(r"**#\<depth\>** "), "{text}");
    }

    #[test]
    fn functions_comments_and_nothing() {
        check(
            "haas-mill",
            "#1=AT$0AN[1.]/[2.]\n",
            &expect![[r#"
                [ATAN]
                **ATAN** arc tangent of one number, in degrees; ATAN[y]/[x] is a division here, not the angle of a point

                *HM17 6.14.10*
            "#]],
        );
        check(
            "haas-mill",
            "G0 (CLE$0AR) X1.\n",
            &expect![[r#"
                nothing
            "#]],
        );
        check(
            "haas-mill",
            "G0 X1.\n\n$0\n",
            &expect![[r#"
            nothing
        "#]],
        );
    }

    #[test]
    fn a_local_call_shows_the_state_after_its_return() {
        check(
            "haas-mill",
            "O1\nG20 G90 G54 G0 X1.\nM9$07 P10\nG0 Z1.\nM30\nN10 G1 X5. F5.\nM99\n",
            &expect![[r#"
                [M97]
                **M97** local subprogram call

                `X1` → `X5`

                `G0` → `G1`, `F5 inch/min`

                in effect: `G17` `G90` `G94` `G20` `G98` `G54` `G64` `spindle stopped`

                ---

                Calls the lines from N P of this program up to M99, L times. *(calls and jumps, for its own block)*

                needs `P`; may have `L`
            "#]],
        );
    }

    #[test]
    fn a_depth_of_cut_is_a_radius_and_no_target() {
        check(
            "fanuc-lathe",
            "O1\nG21 G99 G54\nG0 X50. Z2.\nG71 U$02. R.5\nG71 P10 Q20 U.4 W.1 F.2\nN10 G0 X10.\nN20 G1 X50.\nM30\n",
            &expect![[r#"
                [U2.]
                **U** depth of cut, a radius (`G71`), optional, length

                `U2.` is 2 mm
            "#]],
        );
        check(
            "fanuc-lathe",
            "O1\nG21 G99 G54\nG0 X50. Z2.\nG71 U2. R.5\nG71 P10 Q20 U$0.4 W.1 F.2\nN10 G0 X10.\nN20 G1 X50.\nM30\n",
            &expect![[r#"
                [U.4]
                **U** stock in X, a diameter (`G71`), optional, length

                `U.4` is 0.4 mm, a diameter
            "#]],
        );
        check(
            "fanuc-lathe",
            "O1\nG21 G99 G54\nG0 X50. Z2.\nG73 U$08. W2. R4\nG73 P10 Q20 U.4 W.1 F.2\nN10 G0 X10.\nN20 G1 X50.\nM30\n",
            &expect![[r#"
                [U8.]
                **U** shift in X, a radius (`G73`), optional, length

                `U8.` is 8 mm
            "#]],
        );
    }

    #[test]
    fn a_computed_diameter_is_a_diameter() {
        check(
            "fanuc-lathe",
            "O1\n#1=10.\nG21 G54\nG0 $0X#1\nM30\n",
            &expect![[r#"
                [X#1]
                **X** end point in X, a diameter (`G0`), optional, length

                `X#1` is 10 mm, a diameter

                | X | before | after |
                |---|---|---|
                | work | not known | 10 |
            "#]],
        );
        check(
            "fanuc-lathe",
            "O1\n#1=10.\nG21 G54\nG0 $0X[#1+5.]\nM30\n",
            &expect![[r#"
            [X[#1+5.]]
            **X** end point in X, a diameter (`G0`), optional, length

            `X[#1+5.]` is 15 mm, a diameter

            | X | before | after |
            |---|---|---|
            | work | not known | 15 |
        "#]],
        );
        check(
            "fanuc-lathe",
            "O1\n#1=10.\nG21 G54 G0 X1.\nG0 $0U#1\nM30\n",
            &expect![[r#"
                [U#1]
                **U** increment of X, a diameter (`G0`), optional, length

                `U#1` is 10 mm, a diameter

                | X | before | after |
                |---|---|---|
                | work | 1 | 11 |
            "#]],
        );
    }

    #[test]
    fn a_directive_is_not_the_title_of_a_program() {
        check(
            "haas-mill",
            "O1$0 (gcheck: control=haas-mill) (SLOT)\nM30\n",
            &expect![[r#"
            [O1]
            **O** program number

            **O1** program, line 1 (SLOT): `O1 (gcheck: control=haas-mill) (SLOT)`

            nothing in this file names it
        "#]],
        );
    }

    #[test]
    fn a_word_says_nothing_twice() {
        check(
            "haas-mill",
            "O1\nS$0500 M3\nM30\n",
            &expect![[r#"
            [S500]
            **S** speed in rev/min (`M3`), here or earlier, spindle speed
        "#]],
        );
        check(
            "haas-mill",
            "O1\nN$010 G0 X1.\nM30\n",
            &expect![[r#"
            [N10]
            **N** sequence number, target of M97, M99 P and GOTO

            **N10** sequence number, line 2: `N10 G0 X1.`

            nothing in this file names it
        "#]],
        );
        check(
            "fanuc-mill",
            "O1\nM98 P$02\nM30\nO2\nM99\n",
            &expect![[r#"
            [P2]
            **P** program to call, with repeats in the digits before the last four (`M98`), unless a block of the same program is called by Q, program number, from 0

            **O2** program, line 4: `O2`

            named in 1 place
        "#]],
        );
    }

    #[test]
    fn keywords_say_what_they_do_and_whether_their_condition_holds() {
        check(
            "haas-mill",
            "O1\n#1=1.\nI$0F [#1 EQ 1] GOTO 10\nN10 M30\n",
            &expect![[r#"
            [IF]
            **IF** executes the rest of the block when the condition holds

            the condition holds here
        "#]],
        );
        check(
            "haas-mill",
            "O1\n#1=2.\nI$0F [#1 EQ 1] GOTO 10\nN10 M30\n",
            &expect![[r#"
            [IF]
            **IF** executes the rest of the block when the condition holds

            the condition does not hold here
        "#]],
        );
        check(
            "haas-mill",
            "O1\nIF [#500 E$0Q 1] GOTO 10\nN10 M30\n",
            &expect![[r#"
            [EQ]
            **EQ** is true when both sides are equal
        "#]],
        );
        check(
            "haas-mill",
            "O1\nIF [#500 EQ 1] GO$0TO 10\nN10 M30\n",
            &expect![[r#"
            [GOTO]
            **GOTO** goes on at the block with this sequence number

            ---

            **N10** sequence number, line 3: `N10 M30`

            named in 1 place
        "#]],
        );
        check(
            "fanuc-mill",
            "O1\n#1=0\nWH$0ILE [#1 LT 3] DO1\n#1=#1+1\nEND1\nM30\n",
            &expect![[r#"
            [WHILE]
            **WHILE** repeats the blocks from `DO` to its `END` as long as the condition holds

            whether the condition holds here is not known
        "#]],
        );
        check(
            "linuxcnc",
            "o1 sub\no1 endsub\no1 ca$0ll [1]\no2 repeat [3]\no2 endrepeat\nm2\n",
            &expect![[r#"
                [call]
                **call** calls a subroutine with arguments, which it reads as `#1`, `#2` and so on

                ---

                **O1** subroutine, line 1: `o1 sub`

                named in 2 places
            "#]],
        );
        check(
            "linuxcnc",
            "o2 rep$0eat [3]\no2 endrepeat\nm2\n",
            &expect![[r#"
            [repeat]
            **repeat** repeats the blocks up to `endrepeat` as often as the number says

            here: 3 times

            ---

            **O2** label, line 1: `o2 repeat [3]`

            named in 1 place
        "#]],
        );
        check(
            "linuxcnc",
            "#1=1\no2 i$0f [#1 GT 2]\no2 endif\nm2\n",
            &expect![[r#"
            [if]
            **if** executes the blocks up to `else`, `elseif` or `endif` when the condition holds

            the condition does not hold here

            ---

            **O2** label, line 2: `o2 if [#1 GT 2]`

            named in 1 place
        "#]],
        );
    }

    /// The paragraphs of the hover that hold some words.
    fn lines_with(control: &str, text: &str, words: &str) -> String {
        let mut fixture = Fixture::new(control, text);
        let found = hover(&mut fixture.database, fixture.document, fixture.offset, &|| false);
        let markdown = found.map(|found| found.markdown).unwrap_or_default();
        let lines = markdown.lines().filter(|line| line.contains(words));
        lines.map(|line| format!("{line}\n")).collect()
    }

    #[test]
    fn the_vector_of_a_mode_is_no_arc_centre() {
        let program = |block: &str| {
            format!("O1\nG20 G90 G94\nG1 G141 D1 X0. Y0. Z0.5 I0. J0. K1. F20.\n{block}\nG40\nM30\n")
        };
        for block in
            ["X1. Y0.2 Z0.5 $0I0. J0.6 K0.8", "G1 X1. Y0.2 Z0.5 $0I0. J0.6 K0.8", "$0I0. J0.6 K0.8 X1."]
        {
            let shown = lines_with("haas-mill", &program(block), "**I**");
            assert!(
                shown.contains("X part of the unit vector") && shown.contains("`G141`"),
                "{block}: {shown}"
            );
        }
        let shown = lines_with("haas-mill", &program("G40\nG2 X1. Y1. $0I1. J0."), "**I**");
        assert!(!shown.contains("vector"), "{shown}");
    }

    #[test]
    fn a_feed_of_inverse_time_is_one_in_any_order() {
        for block in ["G93 G1 X1. $0F20.", "G1 G93 X1. $0F20.", "G93\nG1 X1. $0F20.", "G93\nX1. $0F20."] {
            let program = format!("O1\nG20 G90 G94\nG1 X0. F10.\n{block}\nG94\nM30\n");
            let shown = lines_with("haas-mill", &program, "**F**");
            assert!(shown.contains("moves a minute") && shown.contains("`G93`"), "{block}: {shown}");
        }
        let shown = lines_with("haas-mill", "O1\nG20 G90 G93\nG94 G1 X1. $0F20.\nM30\n", "**F**");
        assert!(!shown.contains("moves a minute"), "{shown}");
    }

    #[test]
    fn words_of_a_code_are_told_as_choices() {
        for (control, block, words) in [
            (
                "haas-mill",
                "$0G150 G41 D1 P77 Z-0.5 Q0.25 R0.1 I0.3 F15.",
                "exactly one of `I` `J`; here or earlier `R` `D` `F`; may have",
            ),
            (
                "haas-mill",
                "$0G107 Y0. A0. Q2.5",
                "may have one of `X` `Y` `Z`, one of `A` `B`, one of `Q` `R`",
            ),
            (
                "haas-mill",
                "$0G136 Y1. F10.",
                "needs `F`; at least one of `X` `Y` `Z` `A`; may have `I` `J` `K`",
            ),
            (
                "haas-mill",
                "$0G141 D1 X0. Y0. Z0.",
                "here or earlier `D`; may have `X` `Y` `Z` `A` `B` `I` `J` `K` `F`",
            ),
            (
                "haas-mill",
                "$0G143 H1 X0. Y0. Z0. A0. B0.",
                "here or earlier `H`; may have `X` `Y` `Z` `A` `B` `F`",
            ),
            ("generic-mill", "$0G4 P500", "may have one of `P` `X` `U`"),
            (
                "generic-mill",
                "G17 $0G2 X1. Y1. I1. J0. F100.",
                "a centre `I` `J` or `R`; here or earlier `F`;",
            ),
            (
                "generic-mill",
                "G18 $0G2 X1. Z1. I1. K0. F100.",
                "a centre `I` `K` or `R`; here or earlier `F`;",
            ),
        ] {
            let shown = lines_with(control, &format!("O1\nG90\n{block}\nM30\n"), words);
            assert!(!shown.is_empty(), "{control} {block}: {words}");
        }
    }

    #[test]
    fn the_outline_may_be_a_label_of_the_program() {
        let program = |label: &str| {
            format!(
                "O1\nG20 G90\nG150 G41 D1 $0P77 X0. Y0. Z-0.5 Q0.25 R0.1 I0.3 F15.\nG40 X1.\nM30\n{label} G1 Y1.\nX1.\nM99\n"
            )
        };
        assert_eq!(
            lines_with("haas-mill", &program("N77"), "77** "),
            "**N77** sequence number, line 6: `N77 G1 Y1.`\n"
        );
        assert_eq!(
            lines_with("haas-mill", &program("O77"), "77** "),
            "**O77** program, line 6: `O77 G1 Y1.`\n"
        );
    }

    #[test]
    fn a_wrapped_word_tells_the_angle() {
        let program = "O1\nG20 G90 G54\nG0 X0. Y0. Z1. A0.\nG107 Y0. A0. Q2.5\nG1 $0Y1. F20.\nG107\nM30\n";
        assert_eq!(lines_with("haas-mill", program, "| work"), "| work | 0 | 1 |\n| work | 0 | 45.837 |\n");
        let program = "O1\nG20 G90 G54\nG0 X0. Y0. Z1. A0.\n$0G107 Y0. A0. Q2.5\nG1 Y1. F20.\nG107\nM30\n";
        assert_eq!(
            lines_with("haas-mill", program, "around the cylinder on `A`"),
            "`Y` goes around the cylinder on `A`, diameter 2.5 inch\n"
        );
    }

    #[test]
    fn the_word_across_the_plane_is_the_height() {
        let program = |block: &str| format!("O1\nG21 G90 G54\nG0 X0. Y0. Z0.\n{block}\nG17\nM30\n");
        for block in ["G17 G2 X10. Y10. $0Z-3. I10. J0. F100.", "G18 G3 X20. Z0. R10. $0Y12. F100."] {
            let shown = lines_with("tsnc-yh-a1m", &program(block), "the height of the helix");
            assert!(!shown.is_empty(), "{block}");
        }
        for block in ["G17 G2 $0X10. Y10. Z-3. I10. J0. F100.", "G1 $0Z-3. F100."] {
            assert_eq!(lines_with("tsnc-yh-a1m", &program(block), "helix"), "", "{block}");
        }
    }

    #[test]
    fn in_a_dialect_that_no_control_reads_nothing_is_said_of_modes() {
        let mut settings = Settings::new(gcheck_controls::load("generic-mill").unwrap(), gcheck_rules::RULES);
        let text = "G92 E0\nG1 X1 E1.1\nG1 X2 E1.2\nG1 Y2 E1.3\n";
        settings.unsupported = gcheck_controls::unsupported_dialect(text, None);
        let mut fixture = Fixture::with(text, &settings);
        let found = hover(&mut fixture.database, fixture.document, 8, &|| false).unwrap();
        assert_eq!(
            found.markdown,
            "the file is for a 3-D printer, which gcheck does not read; name a control to read it all the same"
        );
    }
}
