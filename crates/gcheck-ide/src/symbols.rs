//! What programs name: labels, programs, subroutines, branches, variables, parameters; and every place that names them.
//!
//! Knows: which place names which symbol, and how far a symbol reaches. Must not know: what is done with the places.

use std::ops::Range;

use gcheck_controls::{CodeIx, Control, Effect, ReturnTo, VariableKind, WordKind};
use gcheck_db::{DocumentId, Snapshot};
use gcheck_program::{Call, CallKind, FileIndex, Jump, OKeyword, OLabel, OWord, profile};
use gcheck_syntax::SyntaxKind;
use gcheck_syntax::ast::{Variable, variable_name};

use crate::lexemes::{Lexeme, lexemes, touches};
use crate::{Place, Workspace, WorkspaceFile};

/// Something that has a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Symbol {
    /// `N100` of the program that these bytes hold.
    Label { number: u32, program: Range<u32> },
    /// `O1234`.
    Program(u32),
    /// `O100 SUB`, `O<probe> SUB`.
    Subroutine(OLabel),
    /// The label of an O-word that is not a subroutine, in the subroutine or main part of these bytes.
    Branch { label: OLabel, part: Range<u32> },
    /// `#100`; of a local variable, the program that it lives in.
    Variable { number: u32, part: Option<Range<u32>> },
    /// `#<depth>`, lower case without blanks; of a local one, the subroutine or main part that it lives in.
    Parameter { name: String, part: Option<Range<u32>> },
}

/// What a place does with what it names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ReferenceKind {
    /// Defines it: the label itself, the head of a program, an assignment.
    Write,
    /// Uses it.
    Read,
}

/// A place that names a symbol.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Occurrence {
    pub(crate) symbol: Symbol,
    /// Bytes of the name itself: digits without address, the name without brackets.
    pub(crate) range: Range<u32>,
    pub(crate) kind: ReferenceKind,
}

/// The symbol that is named at an offset.
pub(crate) fn symbol_at(snapshot: &Snapshot, offset: u32) -> Option<Occurrence> {
    let file_index = snapshot.file_index();
    let at = |range: &Range<u32>| touches(range, offset);
    let end = code_end(snapshot);
    if offset > end {
        return None;
    }
    // A variable is inside what else may be named: `GOTO #1`, `M98 P#2`.
    if let Some(occurrence) = variable_at(snapshot, offset) {
        return Some(occurrence);
    }
    let label = || {
        let label = around(&file_index.labels, |label| &label.range, offset)?;
        naming_of_label(snapshot, label.number, &label.range, ReferenceKind::Write)
    };
    let program = || {
        let program = around(&file_index.programs, |program| &program.range, offset)?;
        naming_of_program(snapshot, program.number?, &program.range, ReferenceKind::Write)
    };
    let o_word = || o_word_occurrence(snapshot, file_index.o_words.iter().find(|word| at(&word.range))?);
    let jump = || {
        let mut jumps = file_index.jumps.iter().filter(|jump| at(&jump.range));
        jumps.find_map(|jump| jump_occurrence(snapshot, jump))
    };
    let call = || {
        let mut calls = file_index.calls.iter().filter(|call| at(&call.range));
        calls.find_map(|call| call_occurrence(snapshot, call))
    };
    label().or_else(program).or_else(o_word).or_else(jump).or_else(call)
}

/// The variable or parameter at an offset; the sigil and the brackets belong to what people point at.
fn variable_at(snapshot: &Snapshot, offset: u32) -> Option<Occurrence> {
    let tree = snapshot.tree_at(offset)?;
    let tokens = [tree.token_before(offset), tree.token_at(offset)].into_iter().flatten();
    tokens.filter_map(|token| Variable::cast(token.into())).find_map(|variable| {
        let (range, name) = variable.name()?;
        let kind = if variable.is_target() { ReferenceKind::Write } else { ReferenceKind::Read };
        let is_named = matches!(variable, Variable::Named(_));
        naming_of_variable(snapshot, &Scopes::of(snapshot), name, is_named, (tree.in_file(range), kind))
    })
}

/// All places of a file that name a symbol, in text order.
pub(crate) fn occurrences_in(snapshot: &Snapshot, symbol: &Symbol) -> Vec<Occurrence> {
    let file_index = snapshot.file_index();
    let mut found: Vec<Occurrence> = match symbol {
        Symbol::Label { number, program } => {
            let inside = |range: &Range<u32>| program.contains(&range.start);
            let labels =
                file_index.labels.iter().filter(|label| label.number == *number && inside(&label.range));
            let labels = labels.filter_map(|label| {
                naming_of_label(snapshot, label.number, &label.range, ReferenceKind::Write)
            });
            let jumps =
                file_index.jumps.iter().filter(|jump| jump.target == Some(*number) && inside(&jump.range));
            labels.chain(jumps.filter_map(|jump| jump_occurrence(snapshot, jump))).collect()
        }
        Symbol::Program(number) => {
            let heads = file_index.programs.iter().filter(|program| program.number == Some(*number));
            let heads = heads.filter_map(|program| {
                naming_of_program(snapshot, *number, &program.range, ReferenceKind::Write)
            });
            heads.chain(file_index.calls.iter().filter_map(|call| call_occurrence(snapshot, call))).collect()
        }
        Symbol::Subroutine(_) | Symbol::Branch { .. } => {
            file_index.o_words.iter().filter_map(|word| o_word_occurrence(snapshot, word)).collect()
        }
        Symbol::Variable { .. } | Symbol::Parameter { .. } => all_variables(snapshot),
    };
    found.retain(|occurrence| occurrence.symbol == *symbol);
    found.sort_by_key(|occurrence| occurrence.range.start);
    found
}

/// All places that name a symbol which is named in `document`, by file.
pub(crate) fn occurrences(
    workspace: &Workspace,
    document: DocumentId,
    symbol: &Symbol,
) -> Vec<(DocumentId, Occurrence)> {
    let mut all: Vec<(DocumentId, Occurrence)> = files_of(workspace, document, symbol)
        .into_iter()
        .flat_map(|file| {
            occurrences_in(&file.snapshot, symbol).into_iter().map(|occurrence| (file.id, occurrence))
        })
        .collect();
    if let Symbol::Label { number, program } = symbol {
        let place = |id: DocumentId| workspace.files.iter().position(|file| file.id == id);
        all.extend(returns_to(workspace, document, *number, program));
        all.sort_by_key(|(id, occurrence)| (place(*id), occurrence.range.start));
    }
    all
}

/// The returns of called programs that name a label of the program that calls them (`M99 P100`).
fn returns_to(
    workspace: &Workspace,
    document: DocumentId,
    number: u32,
    program: &Range<u32>,
) -> Vec<(DocumentId, Occurrence)> {
    let mut found = Vec::new();
    for file in &workspace.files {
        let returns = file.snapshot.file_index().jumps.iter().filter(|jump| jump.target == Some(number));
        for jump in returns.filter(|jump| leaves(&file.snapshot, jump)) {
            let is_called = callers(workspace, file, jump).contains(&(document, program.clone()));
            let range = digits(&file.snapshot, &jump.range, number).filter(|_| is_called);
            found.extend(range.map(|range| {
                let symbol = Symbol::Label { number, program: program.clone() };
                (file.id, Occurrence { symbol, range, kind: ReferenceKind::Read })
            }));
        }
    }
    found
}

/// What a return at `offset` names in the programs that call its own: the label of each, with its file.
pub(crate) fn returned_to(
    workspace: &Workspace,
    file: &WorkspaceFile,
    offset: u32,
) -> Vec<(DocumentId, Occurrence)> {
    let returns = |jump: &&Jump| touches(&jump.range, offset) && leaves(&file.snapshot, jump);
    let Some(jump) = file.snapshot.file_index().jumps.iter().find(returns) else { return Vec::new() };
    let Some(number) = jump.target else { return Vec::new() };
    let Some(range) = digits(&file.snapshot, &jump.range, number) else { return Vec::new() };
    let named = |(caller, program): (DocumentId, Range<u32>)| {
        let labels = &workspace.file(caller)?.snapshot.file_index().labels;
        let is_it =
            |label: &gcheck_program::Label| label.number == number && program.contains(&label.range.start);
        labels.iter().any(is_it).then(|| {
            let symbol = Symbol::Label { number, program: program.clone() };
            (caller, Occurrence { symbol, range: range.clone(), kind: ReferenceKind::Read })
        })
    };
    callers(workspace, file, jump).into_iter().filter_map(named).collect()
}

/// Does a jump name a block of the program that calls its own?
pub(crate) fn leaves(snapshot: &Snapshot, jump: &Jump) -> bool {
    is_elsewhere(snapshot.control(), jump.code, WordKind::Label) && !is_in_main(snapshot, jump.range.start)
}

/// The programs that call the one that a jump is in, each once.
pub(crate) fn callers(
    workspace: &Workspace,
    file: &WorkspaceFile,
    jump: &Jump,
) -> Vec<(DocumentId, Range<u32>)> {
    let called = program_around(&file.snapshot, jump.range.start);
    let mut found = Vec::new();
    for caller in &workspace.files {
        for call in &caller.snapshot.file_index().calls {
            let place = callee(&caller.snapshot, call)
                .and_then(|symbol| definition_of(workspace, caller.id, &symbol))
                .filter(|place| place.file == file.id && called.contains(&place.range.start));
            let from = (caller.id, program_around(&caller.snapshot, call.range.start));
            if place.is_some() && !found.contains(&from) {
                found.push(from);
            }
        }
    }
    found
}

/// The files that may name a symbol which is named in `document`.
pub(crate) fn files_of<'w>(
    workspace: &'w Workspace,
    document: DocumentId,
    symbol: &Symbol,
) -> Vec<&'w WorkspaceFile> {
    match symbol {
        Symbol::Label { .. }
        | Symbol::Branch { .. }
        | Symbol::Variable { part: Some(_), .. }
        | Symbol::Parameter { part: Some(_), .. } => workspace.file(document).into_iter().collect(),
        Symbol::Program(_) | Symbol::Subroutine(_) => workspace.files.iter().collect(),
        Symbol::Variable { number, .. } => {
            let kind = workspace.file(document).map(|file| file.snapshot.control().variable_kind(*number));
            match kind {
                // What the control keeps over programs may be set by any of them.
                Some(VariableKind::Retained | VariableKind::System) => workspace.files.iter().collect(),
                _ => joined_by_calls(workspace, document),
            }
        }
        Symbol::Parameter { .. } => joined_by_calls(workspace, document),
    }
}

/// The files that calls join with a file, itself included, in the order of the workspace.
pub(crate) fn joined_by_calls(workspace: &Workspace, document: DocumentId) -> Vec<&WorkspaceFile> {
    let mut edges: Vec<(DocumentId, DocumentId)> = Vec::new();
    for file in &workspace.files {
        for call in &file.snapshot.file_index().calls {
            let target =
                callee(&file.snapshot, call).and_then(|symbol| definition_of(workspace, file.id, &symbol));
            if let Some(target) = target.filter(|target| target.file != file.id) {
                edges.push((file.id, target.file));
            }
        }
    }
    let mut joined = vec![document];
    let mut next = 0;
    while let Some(at) = joined.get(next).copied() {
        for (from, to) in &edges {
            for (one, other) in [(from, to), (to, from)] {
                if *one == at && !joined.contains(other) {
                    joined.push(*other);
                }
            }
        }
        next += 1;
    }
    workspace.files.iter().filter(|file| joined.contains(&file.id)).collect()
}

/// The program or subroutine that a call names.
pub(crate) fn callee(snapshot: &Snapshot, call: &Call) -> Option<Symbol> {
    match &call.target {
        CallKind::Program(number) => Some(Symbol::Program(unpacked(snapshot.control(), call.code, *number))),
        CallKind::OWord(OLabel::Computed) | CallKind::Unknown => None,
        CallKind::OWord(label) => Some(Symbol::Subroutine(label.clone())),
    }
}

/// Where a program or subroutine is that is called in `from`: its name, or the start of the file that is named so.
pub(crate) fn definition_of(workspace: &Workspace, from: DocumentId, symbol: &Symbol) -> Option<Place> {
    let own = workspace.files.iter().filter(|file| file.id == from);
    let others = || workspace.files.iter().filter(|file| file.id != from);
    let head =
        |file: &WorkspaceFile| head_in(&file.snapshot, symbol).map(|range| Place { file: file.id, range });
    if let Some(place) = own.clone().chain(others()).find_map(head) {
        return Some(place);
    }
    let name = file_stem_of(symbol)?;
    let named = others().find(|file| stem_matches(&file.name, &name, symbol))?;
    Some(Place { file: named.id, range: 0..0 })
}

/// The stem of the name of a file that holds a program or subroutine.
fn file_stem_of(symbol: &Symbol) -> Option<String> {
    match symbol {
        Symbol::Program(number) | Symbol::Subroutine(OLabel::Number(number)) => Some(number.to_string()),
        Symbol::Subroutine(OLabel::Name(name)) => Some(name.clone()),
        _ => None,
    }
}

/// `O0123.nc`, `123.ngc`, `probe.ngc`.
pub(crate) fn stem_matches(file: &str, name: &str, symbol: &Symbol) -> bool {
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    if matches!(symbol, Symbol::Subroutine(OLabel::Name(_))) {
        return stem.eq_ignore_ascii_case(name);
    }
    let digits = stem.strip_prefix(['O', 'o']).unwrap_or(stem).trim_start_matches('0');
    digits == name.trim_start_matches('0') && stem.ends_with(|c: char| c.is_ascii_digit())
}

fn head_in(snapshot: &Snapshot, symbol: &Symbol) -> Option<Range<u32>> {
    let file_index = snapshot.file_index();
    match symbol {
        Symbol::Program(number) => {
            let head = file_index.programs.iter().find(|program| program.number == Some(*number))?;
            Some(head.range.clone())
        }
        Symbol::Subroutine(label) => {
            let is_sub = |word: &&OWord| word.keyword == OKeyword::Sub && word.label == *label;
            let sub = file_index.o_words.iter().find(is_sub)?;
            Some(o_name_range(snapshot, sub).unwrap_or_else(|| sub.range.clone()))
        }
        _ => None,
    }
}

/// Bytes of the program around an offset: from its `O` number to the next. What is in front of the first belongs to it.
pub(crate) fn program_around(snapshot: &Snapshot, offset: u32) -> Range<u32> {
    let programs = &snapshot.file_index().programs;
    let end = snapshot.len();
    let next = programs.partition_point(|program| program.range.start <= offset);
    let start = |ix: usize| programs.get(ix).map(|program| program.range.start);
    match next {
        0 | 1 => 0..start(1).unwrap_or(end),
        _ => start(next - 1).unwrap_or(0)..start(next).unwrap_or(end),
    }
}

/// End of the part of the file that the control reads.
pub(crate) fn code_end(snapshot: &Snapshot) -> u32 {
    // A closing mark ends the file as the control sees it; an opening one is followed by blocks.
    let file_index = snapshot.file_index();
    match file_index.tape_marks.as_slice() {
        [_, second, ..] => second.end,
        [only] if file_index.first_block.as_ref().is_some_and(|first| first.start < only.start) => only.end,
        _ => snapshot.len(),
    }
}

/// A subroutine of O-words, from `SUB` to `ENDSUB`.
#[derive(Debug, Clone)]
pub(crate) struct Sub {
    pub(crate) label: OLabel,
    /// Bytes from its first statement to its last.
    pub(crate) range: Range<u32>,
    /// Bytes of the label.
    pub(crate) name: Range<u32>,
}

/// The subroutines of a file in text order.
pub(crate) fn subs(snapshot: &Snapshot) -> Vec<Sub> {
    let mut subs: Vec<Sub> = Vec::new();
    for word in &snapshot.file_index().o_words {
        match word.keyword {
            OKeyword::Sub => subs.push(Sub {
                label: word.label.clone(),
                range: word.range.clone(),
                name: o_name_range(snapshot, word).unwrap_or_else(|| word.range.clone()),
            }),
            OKeyword::EndSub => {
                let open = subs.iter_mut().rev().find(|sub| sub.label == word.label);
                if let Some(open) = open {
                    open.range.end = word.range.end;
                }
            }
            _ => {}
        }
    }
    subs
}

/// Which local variables live where.
struct Scopes {
    subs: Vec<Sub>,
}

impl Scopes {
    fn of(snapshot: &Snapshot) -> Self {
        Self { subs: subs(snapshot) }
    }

    /// The subroutine around an offset, else the program.
    fn around(&self, snapshot: &Snapshot, offset: u32) -> Range<u32> {
        let sub = self.subs.iter().rev().find(|sub| sub.range.contains(&offset));
        sub.map_or_else(|| program_around(snapshot, offset), |sub| sub.range.clone())
    }
}

/// The innermost of sorted items that touches an offset.
fn around<T>(items: &[T], range: impl Fn(&T) -> &Range<u32>, offset: u32) -> Option<&T> {
    let upto = items.partition_point(|item| range(item).start <= offset);
    items.get(upto.checked_sub(1)?).filter(|item| touches(range(item), offset))
}

fn naming_of_label(
    snapshot: &Snapshot,
    number: u32,
    word: &Range<u32>,
    kind: ReferenceKind,
) -> Option<Occurrence> {
    let program = program_around(snapshot, word.start);
    Some(Occurrence {
        symbol: Symbol::Label { number, program },
        range: digits(snapshot, word, number)?,
        kind,
    })
}

fn naming_of_program(
    snapshot: &Snapshot,
    number: u32,
    word: &Range<u32>,
    kind: ReferenceKind,
) -> Option<Occurrence> {
    Some(Occurrence { symbol: Symbol::Program(number), range: digits(snapshot, word, number)?, kind })
}

/// The label of its own program that a jump names. What a return names is in the caller, unless the control says that it
/// does not, or there is no such label but here.
fn jump_occurrence(snapshot: &Snapshot, jump: &Jump) -> Option<Occurrence> {
    let number = jump.target?;
    if leaves(snapshot, jump) {
        return None;
    }
    naming_of_label(snapshot, number, &jump.range, ReferenceKind::Read)
}

/// Does the place belong to the first program of the file, or to one that nothing returns from?
pub(crate) fn is_in_main(snapshot: &Snapshot, offset: u32) -> bool {
    let file_index = snapshot.file_index();
    program_around(snapshot, offset).start == 0
        && file_index
            .programs
            .first()
            .is_none_or(|first| program_around(snapshot, first.range.start).start == 0)
        && file_index.ends.iter().any(|end| end.ends == gcheck_controls::Ends::Program)
}

/// May the target of a word of this kind be in another program? What a return names is where the control says: in the caller, or
/// in the program that has the return.
pub(crate) fn is_elsewhere(control: &Control, code: CodeIx, kind: WordKind) -> bool {
    control.code_at(code).is_some_and(|code| {
        code.effect() == Effect::Return && control.semantics().return_to == ReturnTo::Caller
            || code.entry().words.iter().any(|word| word.kind == kind && word.elsewhere)
    })
}

fn call_occurrence(snapshot: &Snapshot, call: &Call) -> Option<Occurrence> {
    let symbol = callee(snapshot, call)?;
    let Symbol::Program(number) = &symbol else { return None };
    let CallKind::Program(written) = call.target else { return None };
    let mut range = digits(snapshot, &call.range, written)?;
    if written != *number {
        // Repeats are before the last four digits.
        range.start = range.end.checked_sub(4)?;
    }
    Some(Occurrence { symbol, range, kind: ReferenceKind::Read })
}

/// A program number without the repeats that a control packs in front of it.
pub(crate) fn unpacked(control: &Control, code: CodeIx, number: u32) -> u32 {
    let packs =
        control.code_at(code).is_some_and(|code| code.entry().words.iter().any(|word| word.packed_repeats));
    if packs && number > 9_999 { number % 10_000 } else { number }
}

fn o_word_occurrence(snapshot: &Snapshot, word: &OWord) -> Option<Occurrence> {
    let range = o_name_range(snapshot, word)?;
    let is_of_sub =
        matches!(word.keyword, OKeyword::Sub | OKeyword::EndSub | OKeyword::Call | OKeyword::Return);
    let opens = matches!(
        word.keyword,
        OKeyword::Sub | OKeyword::If | OKeyword::While | OKeyword::Do | OKeyword::Repeat
    );
    let kind = if opens { ReferenceKind::Write } else { ReferenceKind::Read };
    let symbol = if is_of_sub {
        Symbol::Subroutine(word.label.clone())
    } else {
        let part = Scopes::of(snapshot).around(snapshot, word.range.start);
        Symbol::Branch { label: word.label.clone(), part }
    };
    Some(Occurrence { symbol, range, kind })
}

/// Bytes of an O-word's label without `O` and brackets; `None` for a computed one.
pub(crate) fn o_name_range(snapshot: &Snapshot, word: &OWord) -> Option<Range<u32>> {
    let text = snapshot.slice(word.range.clone());
    let is_named = text.get(1..).is_some_and(|rest| rest.trim_start().starts_with('<'));
    match &word.label {
        OLabel::Number(number) if !is_named => digits(snapshot, &word.range, *number),
        OLabel::Number(_) | OLabel::Name(_) => {
            let open = text.find('<')?;
            let close = text.find('>')?;
            (open < close).then(|| word.range.start + open as u32 + 1..word.range.start + close as u32)
        }
        OLabel::Computed => None,
    }
}

/// Bytes of the first run of digits in a word or statement that read as `number`.
fn digits(snapshot: &Snapshot, within: &Range<u32>, number: u32) -> Option<Range<u32>> {
    let text = snapshot.slice(within.clone());
    let start = text.find(|c: char| c.is_ascii_digit())?;
    let rest = text.get(start..)?;
    let len = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    (rest.get(..len)?.parse() == Ok(number))
        .then(|| within.start + start as u32..within.start + (start + len) as u32)
}

/// All places of a file that name a variable or parameter, in text order.
pub(crate) fn all_variables(snapshot: &Snapshot) -> Vec<Occurrence> {
    let scopes = Scopes::of(snapshot);
    let end = code_end(snapshot);
    let with_variables = snapshot.chunks().filter(|chunk| chunk.base < end && chunk.text.contains('#'));
    let mut all: Vec<Occurrence> = with_variables
        .flat_map(|chunk| variables(snapshot, &lexemes(snapshot, chunk.text, chunk.base), &scopes))
        .collect();
    all.retain(|occurrence| occurrence.range.start < end);
    all
}

/// Variables and parameters among tokens.
///
/// Of a whole file these are found without trees, which take several times as long: 512 lines of a macro are 0.09 ms of tokens,
/// or 0.41 ms of a tree and 0.23 ms to look through it. [`variable_at`] asks the tree, and a test holds both together.
fn variables(snapshot: &Snapshot, lexemes: &[Lexeme], scopes: &Scopes) -> Vec<Occurrence> {
    let solid: Vec<&Lexeme> = lexemes
        .iter()
        .filter(|lexeme| lexeme.kind == SyntaxKind::NEWLINE || !lexeme.kind.is_trivia())
        .collect();
    let mut found = Vec::new();
    for (index, lexeme) in solid.iter().enumerate() {
        let is_named = lexeme.kind == SyntaxKind::NAMED_VARIABLE;
        if !is_named && lexeme.kind != SyntaxKind::VARIABLE {
            continue;
        }
        let kind_of =
            |index: Option<usize>| index.and_then(|index| solid.get(index)).map(|lexeme| lexeme.kind);
        let is_written = kind_of(Some(index + 1)) == Some(SyntaxKind::EQUALS)
            && kind_of(index.checked_sub(1)) != Some(SyntaxKind::HASH);
        let kind = if is_written { ReferenceKind::Write } else { ReferenceKind::Read };
        let text = snapshot.slice(lexeme.range.clone());
        let Some((place, name)) = variable_name(&text) else { continue };
        let range = lexeme.range.start + place.start..lexeme.range.start + place.end;
        found.extend(naming_of_variable(snapshot, scopes, name, is_named, (range, kind)));
    }
    found
}

/// What a variable with such a name is, at bytes of the file.
fn naming_of_variable(
    snapshot: &Snapshot,
    scopes: &Scopes,
    name: &str,
    is_named: bool,
    (range, kind): (Range<u32>, ReferenceKind),
) -> Option<Occurrence> {
    let control = snapshot.control();
    let around = || scopes.around(snapshot, range.start);
    let symbol = if is_named {
        let name = parameter_key(name);
        let part = (!name.starts_with('_')).then(around);
        profile(control).named_parameters.then_some(Symbol::Parameter { name, part })?
    } else {
        let number = name.parse().ok()?;
        let part = (control.variable_kind(number) == VariableKind::Local).then(around);
        Symbol::Variable { number, part }
    };
    Some(Occurrence { symbol, range, kind })
}

/// The names of parameters in a file, each once, in order.
pub(crate) fn parameter_names(snapshot: &Snapshot) -> Vec<String> {
    let mut names: Vec<String> = all_variables(snapshot)
        .into_iter()
        .filter_map(|occurrence| match occurrence.symbol {
            Symbol::Parameter { name, .. } => Some(name),
            _ => None,
        })
        .collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// A parameter's name as the control compares it.
pub(crate) fn parameter_key(name: &str) -> String {
    name.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect()
}

/// Does the file compute the number of a variable somewhere (`#[#1+2]`, `##1`)?
pub(crate) fn has_indirect_variables(snapshot: &Snapshot) -> bool {
    let with_variables = snapshot.chunks().filter(|chunk| chunk.text.contains('#'));
    with_variables
        .flat_map(|chunk| lexemes(snapshot, chunk.text, chunk.base))
        .any(|lexeme| lexeme.kind == SyntaxKind::HASH)
}

/// The first place of a file where a call or jump of the given kind is computed.
pub(crate) fn computed_call(file_index: &FileIndex) -> Option<&Call> {
    file_index
        .calls
        .iter()
        .find(|call| matches!(call.target, CallKind::Unknown | CallKind::OWord(OLabel::Computed)))
}

#[cfg(test)]
mod tests {
    use super::{all_variables, has_indirect_variables, symbol_at};
    use crate::fixture::Fixture;

    #[test]
    fn a_variable_of_the_whole_file_is_the_one_at_its_place() {
        for (control, text) in [
            (
                "haas-mill",
                "O1\n#1=#2+##3\n#100.=[#101*SIN[#4]]\n##5=1.\n#[#6+1]=#7\nIF [#1 EQ #0] THEN #8=2.\n\
                 WHILE [#9 LT 3] DO1\nEND1\nDPRNT[X#10[53]]\nG1 X#11 Y-[#12]\nM98 P#13\nGOTO #14\nM30\n",
            ),
            (
                "linuxcnc",
                "o<sub> sub\n#<Depth>=[#<_global> + #1]\n# <b c>=#<depth>\no1 if [#<depth> GT #2]\n#3=4\n\
                 o1 endif\no<sub> endsub\no<sub> call [#5] [#<_x>]\nM2\n",
            ),
        ] {
            let snapshot = Fixture::new(control, text).snapshot();
            let all = all_variables(&snapshot);
            assert!(all.len() > 8, "{all:?}");
            for occurrence in all {
                let found = symbol_at(&snapshot, occurrence.range.start);
                assert_eq!(found.as_ref(), Some(&occurrence), "{control}");
            }
        }
    }

    #[test]
    fn numbers_of_variables_may_be_computed() {
        let computes = |text: &str| has_indirect_variables(&Fixture::new("haas-mill", text).snapshot());
        assert!(computes("#[#1+2]=1.\n") && computes("X##1\n"));
        assert!(!computes("#1=[#2+2.]\n"));
    }
}
