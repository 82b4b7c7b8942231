//! What may be typed at a place.
//!
//! Knows: which kinds of things can be written where, which of them fit best. Must not know: how editors show a list.
//!
//! A list must not harm who types on: where the word before the cursor is complete, the first entry is that word as it is
//! written, so that an editor that takes the first entry at Enter changes nothing; after a number there is no list; a list
//! that could offer the typed word alone is empty.

use std::fmt::Write as _;
use std::ops::Range;

use gcheck_controls::{Code, CodeIx, CodeNumber, Control, Effect, Letter, Motion, Need, Variable, WordKind};
use gcheck_db::{Cancelled, Database, DocumentId, Snapshot};
use gcheck_diagnostics::Edit;
use gcheck_engine::{Abstract, Look, Role, State};
use gcheck_program::{OKeyword, OLabel};
use gcheck_syntax::SyntaxKind;

use crate::arguments::{arguments, called};
use crate::document_symbols::o_name;
use crate::number_text::value;
use crate::remarks::title;
use crate::sections::{sections, tool_names};
use crate::state_at::look_at;
use crate::symbols::{parameter_key, parameter_names, program_around};
use crate::tool_words::told_of_tool;
use crate::typing::{Expected, Typing};
use crate::{Workspace, describe, keywords};

/// Characters that open the list without being asked. No blank: after one, everything is possible.
pub const TRIGGERS: &[&str] = &["G", "M", "#", "<", ":", "="];

/// Items of one kind that are offered.
const MOST: usize = 1_000;
/// Bytes of a file that is searched for names while somebody types.
const LARGE: u32 = 1 << 20;

/// One thing that may be typed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Completion {
    /// Shown in the list.
    pub label: String,
    /// What it is, beside the label, in a few words.
    pub description: String,
    /// What kind of thing it is.
    pub kind: CompletionKind,
    /// What is written, in the place of what is typed already.
    pub edit: Edit,
    /// The text of the edit is a snippet: `$1`, `${2:0.1}` and `$0` are places for the cursor; `$`, `}` and `\` are escaped.
    pub is_snippet: bool,
    /// What editors compare with what is typed; it begins so.
    pub filter: String,
}

/// What a completion is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CompletionKind {
    /// A G or M code.
    Code,
    /// A word of the block's code, or a tool.
    Word,
    /// A numbered or named variable.
    Variable,
    /// A function of expressions.
    Function,
    /// A keyword of macro statements, or a directive of ours.
    Keyword,
    /// A sequence number.
    Label,
    /// A program or subroutine.
    Program,
    /// A cycle with places for its words.
    Snippet,
    /// A rule.
    Rule,
    /// A control.
    Control,
}

/// What may be typed at `offset`, the most fitting first. `trigger` is the character that opened the list by being typed,
/// `None` where somebody asks for it.
///
/// When `stop` says yes before the state is known, the list does not depend on it.
pub fn completion(
    database: &mut Database,
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
    trigger: Option<char>,
    stop: &dyn Fn() -> bool,
) -> Vec<Completion> {
    let Some(snapshot) = database.indexed(document) else { return Vec::new() };
    let typing = Typing::new(&snapshot, offset);
    let mut items = Items { typing: &typing, document, from: typing.offset, list: Vec::new() };
    if let Some(comment) = typing.comment() {
        items.directives(comment);
        return items.finish();
    }
    let (prefix, from) = typing.prefix();
    items.from = from;
    let first = prefix.chars().next().map(|c| c.to_ascii_uppercase());
    let last = typing.last_before(from).map(|token| token.kind());
    // It opens the list in comments of ours alone.
    if first.is_none() && matches!(trigger, Some('=' | ':')) {
        return Vec::new();
    }
    if first.is_none_or(|first| first.is_ascii_alphabetic()) {
        match typing.expected(from) {
            Expected::OKeyword => {
                items.o_keywords();
                return items.finish();
            }
            Expected::Operator { in_condition } => {
                items.operators(in_condition);
                return items.finish();
            }
            // Words may follow as well.
            Expected::AfterCondition(keyword) => items.after_condition(keyword),
            Expected::Anything => {}
        }
    }
    let mut asked = Asked { database, snapshot: &snapshot, document, typing: &typing, stop };
    match first {
        Some('#') => {
            items.variables();
            items.parameters();
            // Values of variables cost an execution: only where they are asked for.
            asked.with_state(&mut |state, look| items.values(state, look));
        }
        _ if last == Some(SyntaxKind::GOTO_KW) => items.labels(),
        _ if typing.in_brackets() || last == Some(SyntaxKind::EQUALS) => {
            if !is_number(Some(prefix)) || prefix.is_empty() {
                items.functions();
                items.variables();
                items.parameters();
            }
        }
        Some('G' | 'M') if is_number(prefix.get(1..)) => {
            items.codes(&asked.active(), first);
            items.keywords();
        }
        Some('O') => items.o_words(workspace),
        Some('T') if is_number(prefix.get(1..)) => items.tools(),
        Some(letter @ ('H' | 'D')) if is_number(prefix.get(1..)) && items.offsets(letter) => {}
        Some(letter) if items.named(workspace, prefix, letter) => {}
        // A number is being typed, or is complete: nobody knows which.
        Some(_) if prefix.bytes().any(|byte| byte.is_ascii_digit()) => {}
        Some(_) => {
            items.words(&Active::default());
            items.arguments(workspace);
            items.keywords();
        }
        None => {
            let active = asked.active();
            items.words(&active);
            items.arguments(workspace);
            items.codes(&active, None);
            items.keywords();
        }
    }
    items.finish()
}

/// All about an entry of a list, as Markdown, by its kind and label; `None` where the list says it all.
pub fn completion_details(snapshot: &Snapshot, kind: CompletionKind, label: &str) -> Option<String> {
    let control = snapshot.control();
    match kind {
        CompletionKind::Code | CompletionKind::Snippet => {
            let code = control.code(CodeNumber::parse(label.trim_end_matches(" …"))?)?;
            Some(describe::code(control, code))
        }
        CompletionKind::Variable => {
            let name = label.strip_prefix('#')?;
            let entry = match name.strip_prefix('<').and_then(|name| name.strip_suffix('>')) {
                Some(name) => control.named_parameter(name)?,
                None => match control.variable(name.parse().ok()?) {
                    Variable::Known(entry) => entry,
                    Variable::Unlisted => return None,
                },
            };
            Some(describe::variable(entry))
        }
        CompletionKind::Function => {
            let function = control.functions().iter().find(|function| function.name == label)?;
            Some(format!(
                "**{}** {}\n\n*{}{}*",
                function.name,
                function.title,
                function.source,
                function.confidence.remark()
            ))
        }
        CompletionKind::Rule => {
            let rule = snapshot.settings().selection.table().by_id(label)?;
            Some(format!("{}\n\n[{}]({})", rule.meta.summary, rule.meta.id, rule.meta.page()))
        }
        CompletionKind::Word
        | CompletionKind::Keyword
        | CompletionKind::Label
        | CompletionKind::Program
        | CompletionKind::Control => None,
    }
}

/// Is there nothing that a number cannot have?
fn is_number(text: Option<&str>) -> bool {
    text.is_some_and(|text| text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.'))
}

/// Who asks for a list, and until when.
struct Asked<'a> {
    database: &'a mut Database,
    snapshot: &'a Snapshot,
    document: DocumentId,
    typing: &'a Typing<'a>,
    stop: &'a dyn Fn() -> bool,
}

impl Asked<'_> {
    fn with_state(&mut self, with: &mut dyn FnMut(&State<Abstract>, &mut Look<'_, '_>)) {
        with_state(self.database, self.snapshot, self.document, self.typing, self.stop, with);
    }

    /// The codes in effect, as far as the state is known in time.
    fn active(&mut self) -> Active {
        let mut active = Active::default();
        self.with_state(&mut |state, look| active = Active::of(state, look));
        active
    }
}

/// Shows the state that holds where the block at the cursor is typed, unless no path comes there, or `stop` says yes before it
/// is known.
pub(crate) fn with_state(
    database: &mut Database,
    snapshot: &Snapshot,
    document: DocumentId,
    typing: &Typing<'_>,
    stop: &dyn Fn() -> bool,
    with: &mut dyn FnMut(&State<Abstract>, &mut Look<'_, '_>),
) -> Knowledge {
    let Some(place) = snapshot.block_at(typing.offset) else { return Knowledge::Complete };
    let is_typed = place.range().end >= typing.start;
    let looked = look_at(database, document, place.number, stop, &mut |state, look| match &state.after {
        Some(after) if !is_typed => with(after, look),
        _ => with(&state.before, look),
    });
    match looked {
        Ok(()) => Knowledge::Complete,
        Err(Cancelled) => Knowledge::OfTheTextAlone,
    }
}

/// What an answer rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Knowledge {
    /// The state is known, or no path comes there.
    Complete,
    /// The state was not known in time.
    OfTheTextAlone,
}

/// The codes that are in effect, or may be.
#[derive(Default)]
struct Active {
    codes: Vec<CodeIx>,
    /// The cycle in effect, else the motion: what words of a block without a code belong to.
    reader: Option<CodeIx>,
    has_cycle: bool,
}

impl Active {
    fn of(state: &State<Abstract>, look: &Look<'_, '_>) -> Self {
        let all = Role::ALL.into_iter().flat_map(|role| state.mode(role).alternatives().to_vec());
        let cycle = state.active_cycle(look.model()).filter(|code| code.is_some());
        Self {
            codes: all.filter(|code| look.model().control().code_at(*code).is_some()).collect(),
            reader: cycle.or_else(|| state.mode(Role::Motion).only()),
            has_cycle: cycle.is_some(),
        }
    }

    /// Why a code cannot be written here, as far as the codes in effect say it.
    fn objection(&self, control: &Control, code: Code<'_>) -> Option<String> {
        let entry = code.entry();
        let names = |list: &[String], other: Code<'_>| {
            list.iter().any(|item| match item.strip_prefix('@') {
                Some(group) => other.group().id == group,
                None => *item == other.entry().code,
            })
        };
        let active = || self.codes.iter().filter_map(|code| control.code_at(*code));
        // Of a code that ends another nobody says that the other forbids it.
        if let Some(other) = active()
            .find(|other| names(&other.entry().forbids, code) && !entry.cancels.contains(&other.entry().code))
        {
            return Some(format!("not in {}", other.entry().code));
        }
        if self.codes.is_empty() {
            return None;
        }
        let missing =
            entry.requires.iter().find(|needed| !active().any(|other| other.entry().code == **needed));
        missing.map(|needed| format!("needs {needed}"))
    }
}

/// The entries of a list while it is made.
struct Items<'t, 's> {
    typing: &'t Typing<'s>,
    document: DocumentId,
    /// Where what is replaced begins.
    from: u32,
    /// With a number by which they are sorted.
    list: Vec<(u32, Completion)>,
}

/// Entries that fit best: words of the cycle in hand.
const WORDS: u32 = 0;
/// What ends the cycle in hand.
const ENDS: u32 = 90_000;
/// Codes that the program uses already.
const USED: u32 = 100_000;
const UNUSED: u32 = 200_000;
/// Codes that cannot be written here.
const OBJECTED: u32 = 300_000;
/// Variables of the program that come before the functions.
const FEW: usize = 40;
/// Functions of expressions: a list that is cut has them all.
const FUNCTIONS: u32 = 900_000;
/// Other variables of the program; then those of the control.
const OWN: u32 = 1_000_000;

/// Bytes after the cursor that an entry takes the place of: what it would write once more, or the rest of the word that the
/// cursor is in. `typed` is what is before the cursor, in lower case.
fn overwritten(typed: &str, text: &str, rest: &str) -> usize {
    let Some(new) = text.get(typed.len()..).filter(|new| !typed.is_empty() && !new.is_empty()) else {
        return 0;
    };
    if rest.get(..new.len()).is_some_and(|same| same.eq_ignore_ascii_case(new)) {
        return new.len();
    }
    let length = |is_part: &dyn Fn(char) -> bool| rest.find(|c| !is_part(c)).unwrap_or(rest.len());
    let is_name = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    let is_open = typed.contains('<') && !typed.contains('>');
    if is_open || typed == "#" && rest.starts_with('<') {
        let name = length(&|c| is_name(c) || c == '<');
        return name + usize::from(rest.get(name..).is_some_and(|rest| rest.starts_with('>')));
    }
    let is_keyword = typed.len() > 1 && typed.bytes().all(|b| b.is_ascii_alphabetic());
    if is_keyword {
        length(&|c| c.is_ascii_alphabetic())
    } else {
        length(&|c| c.is_ascii_digit() || c == '.')
    }
}

/// A snippet's text with what its places hold before they are filled in: `DO1` of `DO${1:1}`.
fn filled_in(snippet: &str) -> String {
    let mut text = String::with_capacity(snippet.len());
    let mut rest = snippet;
    while let Some((before, place)) = rest.split_once('$') {
        text.push_str(before);
        rest = match place.strip_prefix('{').and_then(|place| place.split_once('}')) {
            Some((held, after)) => {
                text.push_str(held.split_once(':').map_or("", |(_, held)| held));
                after
            }
            None => place.trim_start_matches(|c: char| c.is_ascii_digit()),
        };
    }
    text + rest
}

impl Items<'_, '_> {
    fn control(&self) -> &Control {
        self.typing.snapshot.control()
    }

    fn replaced(&self) -> Range<u32> {
        self.from..self.typing.offset
    }

    /// What is typed already of what is replaced.
    fn typed(&self) -> &str {
        let from = self.from.saturating_sub(self.typing.start) as usize;
        self.typing.before.get(from..).unwrap_or_default()
    }

    fn add(&mut self, kind: CompletionKind, label: &str, description: &str, rank: u32) -> &mut Completion {
        let edit = Edit { range: self.replaced(), text: label.to_owned() };
        let item = Completion {
            label: label.to_owned(),
            description: description.to_owned(),
            kind,
            edit,
            is_snippet: false,
            filter: label.to_owned(),
        };
        self.list.push((rank, item));
        #[expect(clippy::expect_used, reason = "one was pushed right above")]
        let (_, item) = self.list.last_mut().expect("pushed above");
        item
    }

    /// What is typed is a complete word, whatever it may still become: it is offered as it is, unless it is.
    fn add_typed(&mut self, kind: CompletionKind, description: &str) {
        let typed = self.typed().to_owned();
        if !self.list.iter().any(|(_, item)| item.edit.text == typed) {
            self.add(kind, &typed, description, 0);
        }
    }

    /// The list in its order: what is typed first, where it is complete; entries that do not begin so are left out.
    fn finish(self) -> Vec<Completion> {
        let typed = self.typed().to_ascii_lowercase();
        let is_typed = |item: &Completion| item.edit.text.to_ascii_lowercase() == typed;
        let mut list = self.list;
        list.retain(|(_, item)| {
            item.filter.get(..typed.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(&typed))
        });
        list.sort_by(|(rank, item), (other_rank, other)| {
            let key = |rank: u32, item: &Completion| (!is_typed(item), rank);
            key(*rank, item).cmp(&key(*other_rank, other)).then_with(|| item.label.cmp(&other.label))
        });
        // Nothing is left to be chosen.
        if let [(_, only)] = list.as_slice()
            && is_typed(only)
        {
            return Vec::new();
        }
        let rest = self.typing.rest();
        for (_, item) in &mut list {
            let filled = item.is_snippet.then(|| filled_in(&item.edit.text));
            let text = filled.as_ref().unwrap_or(&item.edit.text);
            item.edit.range.end += overwritten(&typed, text, &rest) as u32;
        }
        list.into_iter().map(|(_, item)| item).collect()
    }

    // ---- our own directives ----

    fn directives(&mut self, comment: &str) {
        let Some((_, directive)) = comment.split_once("gcheck:") else { return };
        let directive = directive.trim_start();
        let typed = directive.rsplit([' ', '\t', ',', '=']).next().unwrap_or_default();
        self.from = self.typing.offset - typed.len() as u32;
        if directive.trim_start_matches("control").trim_start().starts_with('=')
            && directive.starts_with("control")
        {
            for name in gcheck_controls::names() {
                let title = gcheck_controls::load(name).map(|control| control.title().to_owned());
                self.add(CompletionKind::Control, name, &title.unwrap_or_default(), 0);
            }
            return;
        }
        let Some((verb, rest)) = directive.split_once([' ', '\t']) else {
            for (verb, description) in [
                ("ignore", "silence a rule on this line, or on the next"),
                ("ignore-file", "silence a rule in this file"),
                ("off", "silence a rule from here on"),
                ("on", "end of `off`"),
                ("control=", "the control that reads this program"),
            ] {
                self.add(CompletionKind::Keyword, verb, description, 0);
            }
            return;
        };
        // After the dash there is a reason in words.
        if !matches!(verb, "ignore" | "ignore-file" | "off" | "on") || rest.contains(" - ") {
            return;
        }
        for rule in self.typing.snapshot.settings().selection.table().iter() {
            self.add(CompletionKind::Rule, rule.meta.id, rule.meta.summary, 0);
        }
    }

    // ---- codes and words ----

    /// G and M codes, those that can be written here first, and cycles with their words.
    fn codes(&mut self, active: &Active, letter: Option<char>) {
        let file_index = self.typing.snapshot.file_index();
        let mut style = Spelling::of(self.typing, letter);
        let in_block = self.typing.codes();
        let control = self.typing.snapshot.control();
        let typed = self.typed().to_owned();
        // `G0` may become `G01`, however the program spells its codes.
        style.padded |= typed.get(1..2) == Some("0");
        let typed_code = CodeNumber::parse(&typed);
        for code in control.codes() {
            let number = code.number();
            if letter.is_some_and(|letter| number.letter() != letter as u8) {
                continue;
            }
            let entry = code.entry();
            let text = if typed_code == Some(number) { typed.clone() } else { style.code(&entry.code) };
            if !text.get(..typed.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(&typed)) {
                continue;
            }
            let objection = active.objection(control, code).or_else(|| {
                let (_, other) = in_block.iter().find(|(_, other)| {
                    other.group_ix() == code.group_ix() && other.group().exclusive
                        || entry.conflicts.contains(&other.entry().code)
                })?;
                Some(format!("not beside {}", other.entry().code))
            });
            let is_used =
                file_index.codes.iter().any(|(used, at)| *used == number && at.end != self.typing.offset);
            let rank = match (&objection, is_used) {
                _ if active.has_cycle && code.effect() == Effect::CycleCancel => ENDS,
                (None, true) => USED,
                (None, false) => UNUSED,
                (Some(_), _) => OBJECTED,
            };
            let rank = rank + u32::from(number.tenths()) + if number.letter() == b'M' { 10_000 } else { 0 };
            let description = match &objection {
                Some(objection) => format!("{objection}: {}", entry.title),
                None => entry.title.clone(),
            };
            self.add(CompletionKind::Code, &text, &description, rank);
            // A letter alone may become so much that the cycles wait for the next.
            let is_cycle = matches!(code.motion(), Motion::Cycle | Motion::Operation);
            if is_cycle && typed.len() > 1 && in_block.is_empty() {
                self.cycle(code, &style, rank);
            }
        }
    }

    /// A cycle as its example writes it, with places for the numbers.
    fn cycle(&mut self, code: Code<'_>, style: &Spelling, rank: u32) {
        let entry = code.entry();
        let is_tap = matches!(
            code.effect(),
            Effect::CycleTap
                | Effect::CycleLeftTap
                | Effect::TapHere
                | Effect::LeftTapHere
                | Effect::RigidTap
        );
        let mut text = String::new();
        let mut places = 0;
        for word in entry.example.split_whitespace() {
            let Some(letter) = word.chars().next().filter(char::is_ascii_alphabetic) else { return };
            if !text.is_empty() {
                text.push(' ');
            }
            if matches!(letter, 'G' | 'M') {
                text.push_str(&style.code(word));
                continue;
            }
            let Some(number) = word.get(1..) else { return };
            if number.is_empty() || !number.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'-')) {
                return;
            }
            places += 1;
            // The feed of a tap is its lead: the tap's own number, and no other.
            let number = if letter == 'F' && is_tap { "" } else { number };
            // Writing to a string cannot fail.
            let _ = match number {
                "" => write!(text, "{}${places}", style.letter(letter)),
                _ => write!(text, "{}${{{places}:{number}}}", style.letter(letter)),
            };
        }
        if places == 0 {
            return;
        }
        let label = format!("{} …", style.code(&entry.code));
        let description = format!("{} with its words", entry.title);
        let item = self.add(CompletionKind::Snippet, &label, &description, rank + 1);
        item.edit.text = text;
        item.is_snippet = true;
        item.filter = style.code(&entry.code);
    }

    /// Words that the codes of the block read and that are not there yet; without codes, those of the cycle or motion in effect.
    fn words(&mut self, active: &Active) {
        let present = self.typing.letters();
        let style = Spelling::of(self.typing, self.typing.prefix().0.chars().next());
        let control = self.typing.snapshot.control();
        let mut codes: Vec<Code<'_>> = self.typing.codes().into_iter().rev().map(|(_, code)| code).collect();
        if codes.is_empty() {
            codes.extend(active.reader.and_then(|code| control.code_at(code)));
        }
        let mut offered: Vec<Letter> = Vec::new();
        let mut rank = WORDS;
        for code in codes {
            for word in &code.entry().words {
                let Some(letter) = Letter::parse(&word.letter) else { continue };
                if present.contains(&letter) || offered.contains(&letter) {
                    continue;
                }
                offered.push(letter);
                rank += 1;
                // How deep a cycle goes comes first, though a control that has other planes lets it be left out.
                let is_depth = letter == Letter::of('Z') && matches!(code.motion(), Motion::Cycle);
                let needed = match word.need {
                    Need::Required => 0,
                    Need::Modal | Need::Optional | Need::Conditional if is_depth => 0,
                    Need::Modal => 1_000,
                    Need::Optional | Need::Conditional => 2_000,
                };
                let text = if style.lower { word.letter.to_ascii_lowercase() } else { word.letter.clone() };
                let need = if word.need == Need::Required {
                    String::new()
                } else {
                    format!("{}, ", word.need_in_words())
                };
                let description = format!("{} ({need}{})", word.is, word.values_in_words());
                self.add(CompletionKind::Word, &text, &description, needed + rank);
            }
        }
    }

    /// The letters that the macro of a call reads, with what its comments call them.
    fn arguments(&mut self, workspace: &Workspace) {
        let typing = self.typing;
        let number = typing.codes().into_iter().find_map(|(_, code)| called(typing, code));
        let taken = number.and_then(|number| arguments(workspace, typing.control(), number));
        let present = typing.letters();
        for (index, argument) in taken.unwrap_or_default().into_iter().enumerate() {
            if Letter::parse(&argument.letter).is_some_and(|letter| present.contains(&letter)) {
                continue;
            }
            let says = argument.says.as_ref().map(|says| format!("{says}, ")).unwrap_or_default();
            let description = format!("{says}#{} of the macro", argument.variable);
            let rank = if argument.is_needed { 0 } else { 1_000 } + index as u32;
            self.add(CompletionKind::Word, &argument.letter, &description, rank);
        }
    }

    /// Labels, programs or subroutines for a word that names one (`M97 P`, `M98 P`); false for a word that names none.
    fn named(&mut self, workspace: &Workspace, prefix: &str, letter: char) -> bool {
        let digits = prefix.get(1..).unwrap_or_default();
        let entry = Letter::new(letter as u8).and_then(|letter| self.typing.entry(letter));
        let Some((_, entry)) = entry.filter(|_| digits.bytes().all(|b| b.is_ascii_digit())) else {
            return false;
        };
        let kind = entry.kind;
        self.from += 1;
        match kind {
            WordKind::Label => self.labels(),
            WordKind::Program => self.programs(workspace),
            _ => {
                self.from -= 1;
                return false;
            }
        }
        true
    }

    // ---- what the program names ----

    /// Sequence numbers of the program.
    fn labels(&mut self) {
        let snapshot = self.typing.snapshot;
        let program = program_around(snapshot, self.typing.offset);
        let labels = snapshot.file_index().labels.iter();
        let inside = labels.filter(|label| program.contains(&label.range.start)).take(MOST);
        for label in inside {
            let line = snapshot.line_text(snapshot.line_at(label.range.start)).into_owned();
            self.add(
                CompletionKind::Label,
                &label.number.to_string(),
                line.trim(),
                label.number.min(9_999_999),
            );
        }
    }

    /// Programs of all files, but for the one that the cursor is in.
    fn programs(&mut self, workspace: &Workspace) {
        let own = program_around(self.typing.snapshot, self.typing.offset);
        let mut known = Vec::new();
        for file in &workspace.files {
            let document = self.document;
            let is_own = |start: u32| file.id == document && own.contains(&start);
            let programs = file.snapshot.file_index().programs.iter();
            for program in programs.filter(|program| !is_own(program.range.start)) {
                let Some(number) = program.number.filter(|number| !known.contains(number)) else { continue };
                if known.len() >= MOST {
                    return;
                }
                known.push(number);
                let line = file.snapshot.line_text(file.snapshot.line_at(program.range.start)).into_owned();
                let comment = title(&line).map(|title| format!("{title}, ")).unwrap_or_default();
                let description = format!("{comment}{}", file.name);
                self.add(CompletionKind::Program, &number.to_string(), &description, number.min(9_999_999));
            }
        }
    }

    /// Subroutines and labels of O-words, where the control has them.
    fn o_words(&mut self, workspace: &Workspace) {
        if !self.control().syntax().o_words {
            return;
        }
        let mut known = Vec::new();
        for file in &workspace.files {
            let subs = file.snapshot.file_index().o_words.iter().filter(|word| word.keyword == OKeyword::Sub);
            for sub in subs.take(MOST) {
                if known.contains(&sub.label) {
                    continue;
                }
                known.push(sub.label.clone());
                let name = o_name(&sub.label);
                // A name may be followed by other words than `call`.
                if name.eq_ignore_ascii_case(self.typed()) {
                    self.add_typed(CompletionKind::Program, "subroutine");
                }
                self.add(CompletionKind::Program, &format!("{name} call"), &file.name, 0);
            }
        }
    }

    fn tools(&mut self) {
        let snapshot = self.typing.snapshot;
        if snapshot.len() > LARGE {
            return;
        }
        let names = tool_names(snapshot);
        let mut known = Vec::new();
        for tool in sections(snapshot).tools {
            let is_typed = tool.word.end == self.typing.offset;
            let Some(number) = tool.tool.filter(|number| !is_typed && !known.contains(number)) else {
                continue;
            };
            known.push(number);
            let text = if tool.is_named {
                snapshot.slice(tool.word.clone()).trim().to_owned()
            } else {
                format!("T{number}")
            };
            let told = told_of_tool(snapshot, &names, number).join(", ");
            self.add(CompletionKind::Word, &text, &told, number.min(9_999_999));
        }
        // Then those of the machine. Where the offset is a part of the word, it is not known which one is meant.
        let machine = &snapshot.settings().machine.engine;
        let by_t = snapshot.control().semantics().tools.offset_in_t;
        for number in
            machine.tools.keys().copied().filter(|number| !by_t && !known.contains(number)).take(MOST)
        {
            let told = told_of_tool(snapshot, &names, number).join(", ");
            self.add(CompletionKind::Word, &format!("T{number}"), &told, OWN + number.min(999_999));
        }
        if self.typed().len() > 1 {
            self.add_typed(CompletionKind::Word, "");
        }
    }

    /// Numbers of offsets: those of the tools, that of the tool in hand first. `false` for an address that names no offset.
    fn offsets(&mut self, letter: char) -> bool {
        let snapshot = self.typing.snapshot;
        let is_offset = Letter::new(letter as u8).and_then(|letter| self.typing.entry(letter)).is_some_and(
            |(code, _)| {
                matches!(
                    code.effect(),
                    Effect::LengthPlus
                        | Effect::LengthMinus
                        | Effect::ToolCentrePoint
                        | Effect::CompensationLeft
                        | Effect::CompensationRight
                )
            },
        );
        if !is_offset || snapshot.len() > LARGE {
            return false;
        }
        let sections = sections(snapshot).tools;
        let here = sections.iter().rev().find(|tool| tool.change.start <= self.typing.offset);
        let here = here.and_then(|tool| tool.tool);
        let machine = &snapshot.settings().machine.engine;
        let mut numbers: Vec<u32> = here
            .into_iter()
            .chain(sections.iter().filter_map(|tool| tool.tool))
            .chain(machine.tools.keys().copied())
            .collect();
        let mut seen = std::collections::BTreeSet::new();
        numbers.retain(|number| *number > 0 && seen.insert(*number));
        let names = tool_names(snapshot);
        for number in numbers.into_iter().take(MOST) {
            let told = told_of_tool(snapshot, &names, number).join(", ");
            let rank = if Some(number) == here { 0 } else { number.min(9_999_999) };
            self.add(CompletionKind::Word, &format!("{letter}{number}"), &told, rank);
        }
        if self.typed().len() > 1 {
            self.add_typed(CompletionKind::Word, "");
        }
        true
    }

    /// Numbered variables that the program sets, then the control's own.
    fn variables(&mut self) {
        let snapshot = self.typing.snapshot;
        let control = snapshot.control();
        for (index, (number, range)) in snapshot.file_index().assigned.iter().take(MOST).enumerate() {
            // The one that is being typed is not a news.
            if range.end == self.typing.offset {
                continue;
            }
            let line = snapshot.line_text(snapshot.line_at(range.start)).into_owned();
            let rank = if index < FEW { 0 } else { OWN } + (*number).min(899_999);
            self.add(CompletionKind::Variable, &format!("#{number}"), line.trim(), rank);
        }
        for entry in control.variables() {
            let Some([first, last]) = entry.range else { continue };
            // Of a row of common variables none is worth naming.
            if last - first > 64 {
                continue;
            }
            let range = if last > first { format!(" (to #{last})") } else { String::new() };
            let description = format!("{}{range}", entry.title);
            self.add(
                CompletionKind::Variable,
                &format!("#{first}"),
                &description,
                2 * OWN + first.min(999_999),
            );
        }
        let number = self.typed().strip_prefix('#').and_then(|number| number.parse().ok());
        if let Some(number) = number {
            let title = match control.variable(number) {
                Variable::Known(entry) => entry.title.clone(),
                Variable::Unlisted => String::new(),
            };
            self.add_typed(CompletionKind::Variable, &title);
        }
    }

    /// Named parameters of the program, then the control's own.
    fn parameters(&mut self) {
        let snapshot = self.typing.snapshot;
        if !snapshot.control().syntax().named_parameters {
            return;
        }
        if snapshot.len() <= LARGE {
            for (index, name) in parameter_names(snapshot).into_iter().take(MOST).enumerate() {
                let rank = if index < FEW { 0 } else { OWN };
                self.add(CompletionKind::Variable, &format!("#<{name}>"), "named parameter", rank);
            }
        }
        for entry in snapshot.control().variables() {
            let Some(name) = &entry.name else { continue };
            self.add(CompletionKind::Variable, &format!("#<{name}>"), &entry.title, 3 * OWN);
        }
    }

    /// What the variables on the list hold here.
    fn values(&mut self, state: &State<Abstract>, look: &mut Look<'_, '_>) {
        for (_, item) in &mut self.list {
            let number = item.label.strip_prefix('#').and_then(|number| number.parse().ok());
            let name = item.label.strip_prefix("#<").and_then(|name| name.strip_suffix('>'));
            let held = match (number, name) {
                (Some(number), _) => look.variable(number, state),
                (None, Some(name)) => look.parameter(name, state),
                (None, None) => None,
            };
            if let Some(held) = held.filter(|held| *held != gcheck_engine::AbstractValue::Unknown) {
                item.description = format!("= {}; {}", value(&held), item.description);
            }
        }
    }

    // ---- macro statements ----

    fn functions(&mut self) {
        let control = self.typing.snapshot.control();
        for function in control.functions() {
            let is_typed = function.name.eq_ignore_ascii_case(self.typed());
            let item = self.add(CompletionKind::Function, &function.name, &function.title, FUNCTIONS);
            if !is_typed {
                item.edit.text = format!("{}[$0]", function.name);
                item.is_snippet = true;
            }
        }
    }

    /// What may follow a condition.
    fn after_condition(&mut self, keyword: SyntaxKind) {
        let all: &[(&str, &str, &str)] = match keyword {
            SyntaxKind::IF_KW => &[
                ("GOTO", "GOTO $0", "jump to a sequence number when the condition holds"),
                ("THEN", "THEN $0", "one statement when the condition holds"),
            ],
            _ => &[
                ("DO", "DO${1:1}", "the loop begins here"),
                ("DO … END", "DO${1:1}\n$0\nEND${1:1}", "the loop with its end"),
            ],
        };
        for (label, text, description) in all {
            let item = self.add(CompletionKind::Keyword, label, description, WORDS);
            (*text).clone_into(&mut item.edit.text);
            item.is_snippet = true;
            label.split(' ').next().unwrap_or(label).clone_into(&mut item.filter);
        }
    }

    /// What may follow an operand.
    fn operators(&mut self, in_condition: bool) {
        if self.control().functions().is_empty() {
            return;
        }
        let comparisons = ["EQ", "NE", "GT", "LT", "GE", "LE"].map(|name| (name, SyntaxKind::COMPARISON));
        let others = [
            ("AND", SyntaxKind::AND_KW),
            ("OR", SyntaxKind::OR_KW),
            ("XOR", SyntaxKind::OR_KW),
            ("MOD", SyntaxKind::MOD_KW),
        ];
        let has_comparisons = in_condition || self.control().syntax().o_words;
        let all = comparisons.into_iter().filter(|_| has_comparisons).chain(others);
        for (rank, (name, kind)) in all.enumerate() {
            let name = self.in_hand(name);
            let does = keywords::does(kind, &name.to_ascii_uppercase(), false).unwrap_or_default();
            self.add(CompletionKind::Keyword, &name, does, rank as u32);
        }
    }

    /// The keywords of O-words. After a label that the file has opened, what goes on with it comes first.
    fn o_keywords(&mut self) {
        let typed = self.typing.o_label();
        let typed_name = typed.as_ref().and_then(|label| label.name()).map(parameter_key);
        let typed_number = typed.as_ref().and_then(gcheck_syntax::ast::OLabel::number);
        let mut opened = None;
        for word in &self.typing.snapshot.file_index().o_words {
            if word.range.start >= self.typing.start {
                break;
            }
            let is_same = match &word.label {
                OLabel::Number(number) => typed_number == Some(*number),
                OLabel::Name(name) => typed_name.as_ref() == Some(&parameter_key(name)),
                OLabel::Computed => false,
            };
            if !is_same {
                continue;
            }
            opened = match word.keyword {
                // After `do` it ends the loop.
                OKeyword::While if opened == Some(OKeyword::Do) => None,
                OKeyword::Sub | OKeyword::If | OKeyword::While | OKeyword::Do | OKeyword::Repeat => {
                    Some(word.keyword)
                }
                OKeyword::EndSub | OKeyword::EndIf | OKeyword::EndWhile | OKeyword::EndRepeat => None,
                _ => opened,
            };
        }
        for (rank, (keyword, kind)) in keywords::after_label(opened).into_iter().enumerate() {
            let name = self.in_hand(keyword.name());
            let does = keywords::does(kind, keyword.name(), true).unwrap_or_default();
            self.add(CompletionKind::Keyword, &name, does, rank as u32);
        }
    }

    /// A keyword in small letters, where what the line has so far is in small letters.
    fn in_hand(&self, keyword: &str) -> String {
        let typed = &self.typing.before;
        let is_lower = typed.contains(|c: char| c.is_ascii_lowercase())
            && !typed.contains(|c: char| c.is_ascii_uppercase());
        if is_lower { keyword.to_ascii_lowercase() } else { keyword.to_owned() }
    }

    fn keywords(&mut self) {
        let syntax = self.typing.snapshot.control().syntax();
        // A statement begins its block.
        let begins = self.typing.codes().is_empty() && self.typing.letters().is_empty();
        if !begins || !syntax.macro_statements {
            return;
        }
        for (label, text, description) in [
            ("IF … GOTO", "IF [$1] GOTO $0", "jump when a condition holds"),
            ("IF … THEN", "IF [$1] THEN $0", "one statement when a condition holds"),
            ("WHILE … DO", "WHILE [$1] DO${2:1}\n$0\nEND${2:1}", "loop while a condition holds"),
            ("GOTO …", "GOTO $0", "jump to a sequence number"),
        ] {
            let keyword = label.split(' ').next().unwrap_or(label);
            if keyword.eq_ignore_ascii_case(self.typed()) {
                self.add_typed(CompletionKind::Keyword, "");
            }
            let item = self.add(CompletionKind::Keyword, label, description, 900_000);
            text.clone_into(&mut item.edit.text);
            item.is_snippet = true;
            keyword.clone_into(&mut item.filter);
        }
    }
}

/// How the program spells its codes.
struct Spelling {
    lower: bool,
    /// `G01`, not `G1`.
    padded: bool,
}

impl Spelling {
    fn of(typing: &Typing<'_>, typed: Option<char>) -> Self {
        let snapshot = typing.snapshot;
        let typed_lower = typing.prefix().0.chars().next().is_some_and(|c| c.is_ascii_lowercase());
        let single = snapshot.file_index().codes.iter().filter(|(number, _)| number.tenths() < 100);
        let (mut padded, mut bare) = (0, 0);
        for (_, range) in single.filter(|(_, range)| !range.contains(&typing.offset)) {
            if range.end - range.start > 2 { padded += 1 } else { bare += 1 }
        }
        Self {
            lower: typed_lower && typed.is_some() && typing.control().syntax().lower_case,
            padded: padded > bare,
        }
    }

    fn letter(&self, letter: char) -> char {
        if self.lower { letter.to_ascii_lowercase() } else { letter }
    }

    fn code(&self, code: &str) -> String {
        let (letter, number) = code.split_at_checked(1).unwrap_or((code, ""));
        let pad = if self.padded && number.len() == 1 { "0" } else { "" };
        let text = format!("{letter}{pad}{number}");
        if self.lower { text.to_ascii_lowercase() } else { text }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::completion;
    use crate::fixture::Fixture;

    /// The first items, and what the document's line becomes with each.
    fn check(control: &str, text: &str, most: usize, expected: &Expect) {
        let mut fixture = Fixture::new(control, text);
        let items = completion(
            &mut fixture.database,
            &fixture.workspace,
            fixture.document,
            fixture.offset,
            None,
            &|| false,
        );
        let line = |item: &super::Completion| {
            let start = &fixture.snapshot().line_range(fixture.snapshot().line_at(fixture.offset)).start;
            let kept = fixture.snapshot().slice(*start..item.edit.range.start).into_owned();
            format!(
                "{:?} {} | {} | {kept}{}\n",
                item.kind,
                item.label,
                item.description,
                item.edit.text.replace('\n', "⏎")
            )
        };
        expected.assert_eq(&items.iter().take(most).map(line).collect::<String>());
    }

    #[test]
    fn codes_that_can_stand_here_come_first() {
        check(
            "haas-mill",
            "%\nO1\nG00 G90 X1.\nG83 Z-1. R1. Q1. F9.\nG0$0\nM30\n",
            12,
            &expect![[r#"
                Code G0 | rapid positioning | G0
                Code G01 | straight cut at feed | G01
                Code G02 | clockwise arc at feed | G02
                Code G03 | counter-clockwise arc at feed | G03
                Code G04 | dwell | G04
                Code G09 | exact stop, this block | G09
            "#]],
        );
        check(
            "haas-mill",
            "O1\nG0 X1.\nM$0\n",
            6,
            &expect![[r#"
            Code M0 | program stop | M0
            Code M1 | optional stop | M1
            Code M2 | program end | M2
            Code M3 | spindle clockwise | M3
            Code M4 | spindle counter-clockwise | M4
            Code M5 | spindle stop | M5
        "#]],
        );
        check(
            "linuxcnc",
            "g0 x1\ng8$0\n",
            4,
            &expect![[r#"
                Code g8 | radius mode | g8
                Code g80 | cancel the motion mode | g80
                Code g81 | drilling | g81
                Snippet g81 … | drilling with its words | g81 x${1:10.} y${2:10.} z${3:-8.} r${4:2.} f${5:100.}
            "#]],
        );
    }

    /// Takes the entry of a label in the place where the cursor is.
    fn check_taken(control: &str, text: &str, label: &str, expected: &str) {
        let mut fixture = Fixture::new(control, text);
        let offset = fixture.offset;
        let items =
            completion(&mut fixture.database, &fixture.workspace, fixture.document, offset, None, &|| false);
        let item = items.iter().find(|item| item.label == label);
        let labels: Vec<&str> = items.iter().map(|item| item.label.as_str()).collect();
        let Some(item) = item else { panic!("{label} is not in {labels:?}") };
        let mut taken = text.replace("$0", "");
        taken.replace_range(item.edit.range.start as usize..item.edit.range.end as usize, &item.edit.text);
        assert_eq!(taken, expected, "{text}");
    }

    #[test]
    fn an_entry_takes_the_place_of_the_whole_word_under_the_cursor() {
        check_taken(
            "haas-mill",
            "O1\nGOTO 1$00\nN10 X1.\nN100 M30\n",
            "100",
            "O1\nGOTO 100\nN10 X1.\nN100 M30\n",
        );
        check_taken(
            "linuxcnc",
            "#<abc>=1\n#<axy>=2\ng0 x#<a$0bc>\n",
            "#<axy>",
            "#<abc>=1\n#<axy>=2\ng0 x#<axy>\n",
        );
        check_taken(
            "linuxcnc",
            "#<abc>=1\n#<axy>=2\ng0 x#<a$0bc>\n",
            "#<abc>",
            "#<abc>=1\n#<axy>=2\ng0 x#<abc>\n",
        );
        check_taken("haas-mill", "O1\nG0$01 X1.\n", "G04", "O1\nG04 X1.\n");
        check_taken(
            "haas-mill",
            "O1\nWHILE [#1 LT 2] D$0O1\nEND1\n",
            "DO",
            "O1\nWHILE [#1 LT 2] DO${1:1}\nEND1\n",
        );
    }

    #[test]
    fn words_of_the_code() {
        check(
            "haas-mill",
            "O1\nG83 X1. Z-1. $0\n",
            6,
            &expect![[r#"
            Word R | R plane, where feeding begins (here or earlier, length) | G83 X1. Z-1. R
            Word F | feed rate (here or earlier, feed rate) | G83 X1. Z-1. F
            Word Q | depth of one peck (here or earlier, length, above 0) | G83 X1. Z-1. Q
            Word Y | hole position (optional, length) | G83 X1. Z-1. Y
            Word A | rotary position of the hole (optional, degrees) | G83 X1. Z-1. A
            Word B | rotary position of the hole (optional, degrees) | G83 X1. Z-1. B
        "#]],
        );
    }

    #[test]
    fn words_of_the_cycle_in_effect_come_first() {
        check(
            "haas-mill",
            "O1\nG83 X1. Z-1. R.1 Q.1 F9.\nX2. $0\n",
            6,
            &expect![[r#"
                Word Z | bottom of the hole (here or earlier, length) | X2. Z
                Word R | R plane, where feeding begins (here or earlier, length) | X2. R
                Word F | feed rate (here or earlier, feed rate) | X2. F
                Word Q | depth of one peck (here or earlier, length, above 0) | X2. Q
                Word Y | hole position (optional, length) | X2. Y
                Word A | rotary position of the hole (optional, degrees) | X2. A
            "#]],
        );
        check(
            "haas-mill",
            "O1\nG83 X1. Z-1. R.1 Q.1 F9.\nG$0\n",
            2,
            &expect![[r#"
            Code G80 | canned cycle off | G80
            Code G83 | peck drilling | G83
        "#]],
        );
    }

    #[test]
    fn what_is_complete_comes_first_as_it_is_written() {
        check(
            "haas-mill",
            "O1\nG00 X1.\nG1$0\n",
            3,
            &expect![[r#"
            Code G1 | straight cut at feed | G1
            Code G10 | set offsets from the program | G10
            Code G12 | circular pocket, clockwise | G12
        "#]],
        );
        check("haas-mill", "O1\nG00 X1.\nG43$0\n", 3, &expect![[""]]);
        check(
            "haas-mill",
            "O1\n#100=1.\n#1000=2.\nX#10$0\n",
            3,
            &expect![[r#"
            Variable #10 | = nothing (never set); local variables, filled by the words of G65 | X#10
            Variable #100 | = 1; #100=1. | X#100
            Variable #1000 | #1000=2. | X#1000
        "#]],
        );
        check(
            "haas-mill",
            "O1\nIF$0\n",
            3,
            &expect![[r#"
            Keyword IF |  | IF
            Keyword IF … GOTO | jump when a condition holds | IF [$1] GOTO $0
            Keyword IF … THEN | one statement when a condition holds | IF [$1] THEN $0
        "#]],
        );
        check("haas-mill", "O1\n#1=[SIN$0\n", 3, &expect![[""]]);
        check(
            "haas-mill",
            "O1\nT10 M6\nT1$0\n",
            3,
            &expect![[r#"
            Word T1 |  | T1
            Word T10 |  | T10
        "#]],
        );
    }

    #[test]
    fn no_list_where_nothing_is_left_to_choose() {
        for text in ["O1\nM99$0\n", "O1\nG83 X$0\n", "O1\nG0 X1$0\n", "O1\nX1.$0\n", "(NOTE G$0)\n"] {
            check("haas-mill", text, 5, &expect![[""]]);
        }
    }

    #[test]
    fn a_sign_of_ours_opens_no_other_list() {
        let mut fixture = Fixture::new("haas-mill", "O1\n#101=$0\n");
        let (workspace, id, at) = (&fixture.workspace, fixture.document, fixture.offset);
        let found = completion(&mut fixture.database, workspace, id, at, Some('='), &|| false);
        assert_eq!(found, []);
    }

    #[test]
    fn variables_with_their_values() {
        check(
            "haas-mill",
            "O1\n#100=5. (DEPTH)\n#101=#100+1.\nG0 X#$0\n",
            4,
            &expect![[r#"
            Variable #100 | = 5; #100=5. (DEPTH) | G0 X#100
            Variable #101 | = 6; #101=#100+1. | G0 X#101
            Variable #0 | = nothing (never set); null: never has a value; a word given #0 is dropped from the block | G0 X#0
            Variable #1 | = nothing (never set); local variables, filled by the words of G65 (to #33) | G0 X#1
        "#]],
        );
        check(
            "linuxcnc",
            "#<depth> = 2\n#<wide> = 3\nG0 X[#<$0]\n",
            3,
            &expect![[r#"
                Variable #<depth> | = 2; named parameter | G0 X[#<depth>
                Variable #<wide> | = 3; named parameter | G0 X[#<wide>
                Variable #<_a> | present A in the active work system | G0 X[#<_a>
            "#]],
        );
        check(
            "haas-mill",
            "O1\n#101=$0\n",
            3,
            &expect![[r#"
                Function ABS | absolute value | #101=ABS[$0]
                Function ACOS | arc cosine, in degrees | #101=ACOS[$0]
                Function ASIN | arc sine, in degrees | #101=ASIN[$0]
            "#]],
        );
    }

    #[test]
    fn a_call_offers_the_letters_that_the_macro_reads() {
        check(
            "fanuc-mill",
            "O1\nG65 P9010 X1. $0\nM30\nO9010 (BORE)\n(A=START ANGLE)\nIF [#24 EQ #0] GOTO 9\nG1 X#24 A#1\nG1 Z#26\nN9 M99\n",
            2,
            &expect![[r#"
                Word A | START ANGLE, #1 of the macro | G65 P9010 X1. A
                Word Z | #26 of the macro | G65 P9010 X1. Z
            "#]],
        );
    }

    #[test]
    fn offsets_are_those_of_the_tools_and_the_one_in_hand_comes_first() {
        check(
            "haas-mill",
            "O1\nT1 M6 (DRILL)\nG43 H1 Z1.\nT2 M6 (END MILL)\nG43 H$0\n",
            3,
            &expect![[r#"
                Word H2 | END MILL | G43 H2
                Word H1 | DRILL | G43 H1
            "#]],
        );
        check(
            "haas-mill",
            "O1\nT1 M6 (DRILL)\nG41 D$0\n",
            3,
            &expect![[r#"
            Word D1 | DRILL | G41 D1
        "#]],
        );
    }

    #[test]
    fn labels_programs_and_tools() {
        check(
            "haas-mill",
            "O1\nN10 G0 X1. (START)\nGOTO $0\nO2\nN20 M99\n",
            5,
            &expect![[r#"
            Label 10 | N10 G0 X1. (START) | GOTO 10
        "#]],
        );
        check(
            "haas-mill",
            "O1\nM97 P$0\nN10 G0 X1.\nM99\n",
            5,
            &expect![[r#"
            Label 10 | N10 G0 X1. | M97 P10
        "#]],
        );
        check(
            "haas-mill",
            "//- a.nc\nO1\nM98 P$0\nM30\n//- b.nc\nO2 (SLOT)\nM99\n",
            5,
            &expect![[r#"
                Program 2 | SLOT, b.nc | M98 P2
            "#]],
        );
        check(
            "haas-mill",
            "O1\nT1 M6 (DRILL)\nT2 M6\nT$0\n",
            5,
            &expect![[r#"
                Word T1 | DRILL | T1
                Word T2 |  | T2
            "#]],
        );
        check(
            "linuxcnc",
            "//- a.ngc\no$0\nM2\n//- probe.ngc\no<probe> sub\no<probe> endsub\n",
            5,
            &expect![[r#"
            Program o<probe> call | probe.ngc | o<probe> call
        "#]],
        );
    }

    #[test]
    fn directives_of_ours() {
        check(
            "haas-mill",
            "G0 X1. (gcheck: $0)\n",
            9,
            &expect![[r#"
            Keyword control= | the control that reads this program | G0 X1. (gcheck: control=
            Keyword ignore | silence a rule on this line, or on the next | G0 X1. (gcheck: ignore
            Keyword ignore-file | silence a rule in this file | G0 X1. (gcheck: ignore-file
            Keyword off | silence a rule from here on | G0 X1. (gcheck: off
            Keyword on | end of `off` | G0 X1. (gcheck: on
        "#]],
        );
        check(
            "haas-mill",
            "(gcheck: ignore feed-m$0)\n",
            2,
            &expect![[r#"
                Rule feed-missing | cut without a feed | (gcheck: ignore feed-missing
            "#]],
        );
        check(
            "haas-mill",
            "(gcheck: control=$0)\n",
            3,
            &expect![[r#"
            Control fanuc-lathe | Fanuc 0i-T / 30i-T, turning centre, G code system A | (gcheck: control=fanuc-lathe
            Control fanuc-lathe-b | Fanuc 0i-T / 30i-T, turning centre, G code system B | (gcheck: control=fanuc-lathe-b
            Control fanuc-lathe-c | Fanuc 0i-T / 30i-T, turning centre, G code system C | (gcheck: control=fanuc-lathe-c
        "#]],
        );
        check("haas-mill", "(NOTE $0)\n", 3, &expect![[""]]);
    }

    #[test]
    fn statements_begin_a_block() {
        check(
            "fanuc-mill",
            "O1\nI$0\n",
            4,
            &expect![[r#"
                Keyword IF … GOTO | jump when a condition holds | IF [$1] GOTO $0
                Keyword IF … THEN | one statement when a condition holds | IF [$1] THEN $0
            "#]],
        );
    }

    #[test]
    fn after_a_condition_comes_what_it_decides() {
        check(
            "haas-mill",
            "O1\nIF [#1 EQ 1] $0\n",
            3,
            &expect![[r#"
            Keyword GOTO | jump to a sequence number when the condition holds | IF [#1 EQ 1] GOTO $0
            Keyword THEN | one statement when the condition holds | IF [#1 EQ 1] THEN $0
            Word X | X target (optional, length) | IF [#1 EQ 1] X
        "#]],
        );
        check(
            "haas-mill",
            "O1\nIF [#1 EQ 1] GO$0\n",
            3,
            &expect![[r#"
            Keyword GOTO | jump to a sequence number when the condition holds | IF [#1 EQ 1] GOTO $0
        "#]],
        );
        check(
            "haas-mill",
            "O1\nIF [#1 EQ 1] T$0\n",
            3,
            &expect![[r#"
            Keyword THEN | one statement when the condition holds | IF [#1 EQ 1] THEN $0
        "#]],
        );
        check(
            "fanuc-mill",
            "O1\nWHILE [#1 LT 1] $0\n",
            3,
            &expect![[r#"
            Keyword DO | the loop begins here | WHILE [#1 LT 1] DO${1:1}
            Keyword DO … END | the loop with its end | WHILE [#1 LT 1] DO${1:1}⏎$0⏎END${1:1}
            Word X | end point in X (optional, length) | WHILE [#1 LT 1] X
        "#]],
        );
        check(
            "fanuc-mill",
            "O1\nWHILE [#1 LT 1] D$0\n",
            3,
            &expect![[r#"
            Keyword DO | the loop begins here | WHILE [#1 LT 1] DO${1:1}
            Keyword DO … END | the loop with its end | WHILE [#1 LT 1] DO${1:1}⏎$0⏎END${1:1}
        "#]],
        );
    }

    #[test]
    fn after_an_operand_come_operators() {
        check(
            "haas-mill",
            "O1\nIF [#1 $0\n",
            20,
            &expect![[r#"
                Keyword EQ | is true when both sides are equal | IF [#1 EQ
                Keyword NE | is true when the sides differ | IF [#1 NE
                Keyword GT | is true when the left side is greater than the right side | IF [#1 GT
                Keyword LT | is true when the left side is less than the right side | IF [#1 LT
                Keyword GE | is true when the left side is greater than the right side, or equal | IF [#1 GE
                Keyword LE | is true when the left side is less than the right side, or equal | IF [#1 LE
                Keyword AND | is true when both sides are true | IF [#1 AND
                Keyword OR | is true when one side is true, or both | IF [#1 OR
                Keyword XOR | is true when exactly one side is true | IF [#1 XOR
                Keyword MOD | gives the remainder of a division | IF [#1 MOD
            "#]],
        );
        check(
            "haas-mill",
            "O1\nIF [#1 EQ 1 A$0]\n",
            20,
            &expect![[r#"
                Keyword AND | is true when both sides are true | IF [#1 EQ 1 AND
            "#]],
        );
        check(
            "haas-mill",
            "O1\n#1=[#2 $0]\n",
            20,
            &expect![[r#"
                Keyword AND | is true when both sides are true | #1=[#2 AND
                Keyword OR | is true when one side is true, or both | #1=[#2 OR
                Keyword XOR | is true when exactly one side is true | #1=[#2 XOR
                Keyword MOD | gives the remainder of a division | #1=[#2 MOD
            "#]],
        );
        check(
            "linuxcnc",
            "o1 while [#1 g$0]\n",
            20,
            &expect![[r#"
            Keyword gt | is true when the left side is greater than the right side | o1 while [#1 gt
            Keyword ge | is true when the left side is greater than the right side, or equal | o1 while [#1 ge
        "#]],
        );
    }

    #[test]
    fn after_the_label_of_an_o_word_come_its_keywords() {
        check(
            "linuxcnc",
            "o100 $0\nm2\n",
            20,
            &expect![[r#"
            Keyword sub | begins a subroutine, which is executed when it is called | o100 sub
            Keyword call | calls a subroutine with arguments, which it reads as `#1`, `#2` and so on | o100 call
            Keyword if | executes the blocks up to `else`, `elseif` or `endif` when the condition holds | o100 if
            Keyword while | repeats the blocks up to `endwhile` as long as the condition holds | o100 while
            Keyword do | repeats the blocks up to `while`, whose condition is looked at after them | o100 do
            Keyword repeat | repeats the blocks up to `endrepeat` as often as the number says | o100 repeat
            Keyword endsub | ends a subroutine: goes back to the caller | o100 endsub
            Keyword return | goes back to the caller at once | o100 return
            Keyword else | begins the blocks that are executed when no condition above holds | o100 else
            Keyword elseif | begins the blocks that are executed when no condition above holds, and this one does | o100 elseif
            Keyword endif | ends the blocks of `if` | o100 endif
            Keyword endwhile | ends the loop: the condition is looked at again | o100 endwhile
            Keyword endrepeat | ends the blocks of `repeat` | o100 endrepeat
            Keyword break | leaves the loop | o100 break
            Keyword continue | goes on with the next turn of the loop | o100 continue
        "#]],
        );
        check(
            "linuxcnc",
            "o<foo> $0\nm2\n",
            3,
            &expect![[r#"
            Keyword sub | begins a subroutine, which is executed when it is called | o<foo> sub
            Keyword call | calls a subroutine with arguments, which it reads as `#1`, `#2` and so on | o<foo> call
            Keyword if | executes the blocks up to `else`, `elseif` or `endif` when the condition holds | o<foo> if
        "#]],
        );
        check(
            "linuxcnc",
            "O<foo> C$0\nm2\n",
            3,
            &expect![[r#"
            Keyword CALL | calls a subroutine with arguments, which it reads as `#1`, `#2` and so on | O<foo> CALL
            Keyword CONTINUE | goes on with the next turn of the loop | O<foo> CONTINUE
        "#]],
        );
        check(
            "linuxcnc",
            "o100 if [#1 GT 0]\no100 $0\nm2\n",
            3,
            &expect![[r#"
            Keyword endif | ends the blocks of `if` | o100 endif
            Keyword else | begins the blocks that are executed when no condition above holds | o100 else
            Keyword elseif | begins the blocks that are executed when no condition above holds, and this one does | o100 elseif
        "#]],
        );
        check(
            "linuxcnc",
            "o100 sub\no100 e$0\nm2\n",
            3,
            &expect![[r#"
            Keyword endsub | ends a subroutine: goes back to the caller | o100 endsub
            Keyword else | begins the blocks that are executed when no condition above holds | o100 else
            Keyword elseif | begins the blocks that are executed when no condition above holds, and this one does | o100 elseif
        "#]],
        );
    }

    #[test]
    fn functions_are_offered_before_a_letter_is_typed() {
        check(
            "haas-mill",
            "O1\nG0 X[$0\n",
            3,
            &expect![[r#"
            Function ABS | absolute value | G0 X[ABS[$0]
            Function ACOS | arc cosine, in degrees | G0 X[ACOS[$0]
            Function ASIN | arc sine, in degrees | G0 X[ASIN[$0]
        "#]],
        );
        check(
            "haas-mill",
            "O1\nG0 X[$0]\n",
            3,
            &expect![[r#"
            Function ABS | absolute value | G0 X[ABS[$0]
            Function ACOS | arc cosine, in degrees | G0 X[ACOS[$0]
            Function ASIN | arc sine, in degrees | G0 X[ASIN[$0]
        "#]],
        );
    }

    #[test]
    fn a_leading_zero_matches_the_codes() {
        check(
            "haas-mill",
            "O1\nG1 X1.\nG2 X1.\nG0$0\n",
            4,
            &expect![[r#"
            Code G0 | rapid positioning | G0
            Code G01 | straight cut at feed | G01
            Code G02 | clockwise arc at feed | G02
            Code G03 | counter-clockwise arc at feed | G03
        "#]],
        );
        check(
            "haas-mill",
            "O1\nG1 X1.\nM3\nM0$0\n",
            4,
            &expect![[r#"
            Code M0 | program stop | M0
            Code M03 | spindle clockwise | M03
            Code M01 | optional stop | M01
            Code M02 | program end | M02
        "#]],
        );
        check(
            "linuxcnc",
            "g1 x1\ng0$0\n",
            4,
            &expect![[r#"
            Code g0 | rapid move | g0
            Code g01 | straight feed move | g01
            Code g02 | clockwise arc | g02
            Code g03 | counter-clockwise arc | g03
        "#]],
        );
    }

    #[test]
    fn a_tap_gets_no_lead_from_an_example() {
        check(
            "fanuc-lathe",
            "O1\nG21\nG84$0\n",
            2,
            &expect![[r#"
            Code G84 | face tapping with a live tool | G84
            Snippet G84 … | face tapping with a live tool with its words | G84 Z${1:-20.} C${2:0.} R${3:-3.} P${4:200} F$5
        "#]],
        );
        check(
            "haas-mill",
            "O1\nG21\nG84$0\n",
            2,
            &expect![[r#"
            Code G84 | tapping | G84
            Snippet G84 … | tapping with its words | G84 X${1:1.} Y${2:1.} Z${3:-0.5} R${4:0.2} F$5 S${6:600}
        "#]],
        );
    }

    #[test]
    fn a_program_is_offered_by_its_title() {
        check(
            "haas-mill",
            "O1\nM98 P$0\nM30\nO2 (gcheck: off) (SLOT)\nM99\n",
            3,
            &expect![[r#"
            Program 2 | SLOT, main.nc | M98 P2
        "#]],
        );
    }
}
