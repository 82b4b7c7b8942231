//! The words of the code that is being typed, and the arguments of a macro call.
//!
//! Knows: which words a block still needs, which one the cursor is at. Must not know: how a code moves the machine.
//!
//! Help that stays covers the lines around, so it is there only while the block needs a word that is not yet typed.

use std::fmt::Write as _;
use std::ops::Range;

use gcheck_controls::{Code, Control, Letter, Need, WordEntry};
use gcheck_db::{Database, DocumentId};
use gcheck_engine::{Abstract, Domain as _, Look, State};
use gcheck_syntax::ast::Statement;
use gcheck_syntax::{SyntaxKind, byte_range};

use crate::arguments::{Argument, arguments, arguments_of_sub, called, is_call};
use crate::completion::{Knowledge, with_state};
use crate::typing::{Typing, address};
use crate::{Workspace, describe};

/// Characters that open the help.
pub const TRIGGERS: &[&str] = &[" "];

/// A code with its words, or a call with its arguments.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// One line: `G83 X Y Z R Q [P] [F]`.
    pub label: String,
    /// Markdown.
    pub documentation: String,
    /// The words in the order of the label.
    pub parameters: Vec<Parameter>,
    /// Index of the word at the cursor, else of the first that the block still needs.
    pub active: Option<u32>,
}

/// A word of a signature.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Bytes of the label, which is ASCII.
    pub label: Range<u32>,
    /// Markdown.
    pub documentation: String,
}

/// The signatures of the codes of the block at `offset` that read words, that of the nearest code before the cursor first.
///
/// Unless somebody asks for it (`is_asked`), only of codes that still need a word: one that must be in the block, one of a
/// choice, or one that may be given earlier and was not. When `stop` says yes before that is known, such a word counts as given.
pub fn signature_help(
    database: &mut Database,
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
    is_asked: bool,
    stop: &dyn Fn() -> bool,
) -> Vec<Signature> {
    let Some(snapshot) = database.indexed(document) else { return Vec::new() };
    let typing = Typing::new(&snapshot, offset);
    if typing.comment().is_some() {
        return Vec::new();
    }
    if let Some(shown) = call_of_sub(workspace, &typing, is_asked) {
        return vec![shown];
    }
    let mut codes: Vec<Code<'_>> = typing
        .codes()
        .into_iter()
        .filter(|(range, _)| range.end <= typing.offset)
        .map(|(_, code)| code)
        .filter(|code| !code.entry().words.is_empty() || is_call(*code))
        .collect();
    codes.reverse();
    if codes.is_empty() {
        return Vec::new();
    }
    // After a blank the next word is to come; a cursor inside a word is at the word.
    let at = typing.word_here().and_then(|word| address(&word));
    let block = Block { typing: &typing, present: typing.letters(), at };
    // What was given earlier costs an execution: only where a word of that kind is missing.
    let mut missing: Vec<Vec<Letter>> = codes.iter().map(|code| block.missing(*code, &|_| false)).collect();
    if missing.iter().any(|missing| !missing.is_empty()) {
        let knowledge = with_state(database, &snapshot, document, &typing, stop, &mut |state, look| {
            missing = codes
                .iter()
                .map(|code| block.missing(*code, &|word| is_given(*code, word, state, look)))
                .collect();
        });
        if knowledge == Knowledge::OfTheTextAlone {
            missing = codes.iter().map(|code| block.missing(*code, &|_| true)).collect();
        }
    }
    let mut shown = Vec::new();
    for (code, missing) in codes.into_iter().zip(missing) {
        let taken = called(&typing, code).and_then(|number| arguments(workspace, typing.control(), number));
        let taken = taken.unwrap_or_default();
        let needed = taken.iter().filter(|argument| argument.is_needed);
        let needed = needed.filter_map(|argument| Letter::parse(&argument.letter));
        let missing: Vec<Letter> =
            missing.into_iter().chain(needed.filter(|l| !block.present.contains(l))).collect();
        if is_asked || !missing.is_empty() {
            let next = at.or_else(|| missing.first().copied()).or_else(|| block.next(code));
            shown.push(signature(typing.control(), code, &taken, next));
        }
    }
    shown
}

/// The call of a subroutine of O-words that is being typed: `o<probe> call [1] [2]`.
fn call_of_sub(workspace: &Workspace, typing: &Typing<'_>, is_asked: bool) -> Option<Signature> {
    let (statement, call) = typing.statements().find_map(|statement| {
        let Statement::O(statement) = statement else { return None };
        let keyword = statement.keyword().filter(|keyword| keyword.kind() == SyntaxKind::CALL_KW)?;
        let call = typing.in_file(byte_range(keyword.text_range()));
        (call.end <= typing.offset).then_some((statement, call))
    })?;
    let written = typing.snapshot.slice(typing.in_file(statement.label()?.range()));
    let mut words = typing.snapshot.file_index().o_words.iter();
    let label = words.find(|word| word.range.start <= call.start && call.end <= word.range.end)?;
    let taken = arguments_of_sub(workspace, &label.label)?;
    let active = statement.argument_at(typing.in_chunk(typing.offset));
    if taken.is_empty() || !is_asked && active >= taken.len() {
        return None;
    }
    let mut text = format!("{} {}", written.trim(), typing.snapshot.slice(call));
    let mut parameters = Vec::new();
    for argument in &taken {
        text.push(' ');
        let start = text.len() as u32;
        // Writing to a string cannot fail.
        let _ = write!(text, "[#{}]", argument.variable);
        let says = argument.says.as_ref().map(|says| format!(": {says}")).unwrap_or_default();
        let documentation = format!("becomes `#{}` in the subroutine{says}", argument.variable);
        parameters.push(Parameter { label: start..text.len() as u32, documentation });
    }
    let active = (active < taken.len()).then_some(active as u32);
    let documentation = "calls the subroutine; an argument that is left out is 0".to_owned();
    // Editors count in other units than bytes.
    text.is_ascii().then_some(Signature { label: text, documentation, parameters, active })
}

/// Was a word that may be given earlier given?
fn is_given(code: Code<'_>, word: &WordEntry, state: &State<Abstract>, look: &Look<'_, '_>) -> bool {
    let is_number = |value: &gcheck_engine::AbstractValue| Abstract::known(value) != Some(0.0);
    match word.letter.as_str() {
        "F" => is_number(state.feed_word()),
        "S" => is_number(state.speed()),
        "T" => is_number(state.selected()),
        "H" => is_number(state.h()),
        "D" => is_number(state.d()),
        // The other words that last are those of a cycle that is in effect.
        _ => {
            let active = state.active_cycle(look.model());
            active
                .and_then(|active| look.model().control().code_at(active))
                .is_some_and(|active| active.number() == code.number())
        }
    }
}

/// The words of a block that is being typed.
struct Block<'t, 's> {
    typing: &'t Typing<'s>,
    /// Those that are complete.
    present: Vec<Letter>,
    /// The one that is being typed.
    at: Option<Letter>,
}

impl Block<'_, '_> {
    /// The words that a code needs and that are not complete, in the order in which it lists them.
    fn missing(&self, code: Code<'_>, is_given: &dyn Fn(&WordEntry) -> bool) -> Vec<Letter> {
        let entry = code.entry();
        let has = |letter: &str| Letter::parse(letter).is_some_and(|letter| self.present.contains(&letter));
        let is_needed = |word: &&WordEntry| {
            let replaced = word.instead.iter().chain(&word.instead_here).any(|other| has(other));
            if has(&word.letter) || replaced {
                return false;
            }
            match word.need {
                Need::Required => true,
                Need::Modal => !is_given(word),
                Need::Conditional => {
                    word.required_with.iter().any(|other| has(other) || self.has_word(other))
                }
                Need::Optional => false,
            }
        };
        let mut missing: Vec<Letter> =
            entry.words.iter().filter(is_needed).filter_map(|word| Letter::parse(&word.letter)).collect();
        for choice in entry.one_of.iter().filter(|choice| !choice.iter().any(|letter| has(letter))) {
            // The one that is being typed is the one that was chosen.
            let letters = || choice.iter().filter_map(|letter| Letter::parse(letter));
            let chosen = letters().find(|letter| Some(*letter) == self.at).or_else(|| letters().next());
            missing.extend(chosen);
        }
        // In the order in which the label has them.
        let place = |letter: &Letter| {
            entry.words.iter().position(|word| Letter::parse(&word.letter) == Some(*letter))
        };
        missing.sort_by_key(place);
        missing
    }

    /// What may follow in a block that needs nothing more: in the order in which the code lists its words, the first that is not
    /// there after the last that is.
    fn next(&self, code: Code<'_>) -> Option<Letter> {
        let letters = || code.entry().words.iter().filter_map(|word| Letter::parse(&word.letter));
        let finished =
            self.typing.words().filter(|word| self.typing.in_file(word.range()).end < self.typing.offset);
        let last = finished.filter_map(|word| address(&word)).last()?;
        let place = letters().position(|letter| letter == last)?;
        letters().skip(place + 1).find(|letter| !self.present.contains(letter))
    }

    /// Does the block have a word with its value: `L2`?
    fn has_word(&self, word: &str) -> bool {
        let plain = |text: &str| {
            let text = text.trim_end_matches('.').to_ascii_uppercase();
            let (letter, number) = text.split_at_checked(1).unwrap_or((&text, ""));
            format!("{letter}{}", number.trim_start_matches('0'))
        };
        self.typing.words().any(|written| plain(&written.text()) == plain(word))
    }
}

fn signature(control: &Control, code: Code<'_>, taken: &[Argument], at: Option<Letter>) -> Signature {
    let entry = code.entry();
    let mut label = entry.code.clone();
    let mut parameters = Vec::new();
    let mut active = None;
    let mut add = |text: String, letter: Option<Letter>, documentation: String| {
        label.push(' ');
        let start = label.len() as u32;
        label.push_str(&text);
        if letter.is_some() && letter == at {
            active = Some(parameters.len() as u32);
        }
        parameters.push(Parameter { label: start..start + text.len() as u32, documentation });
    };
    let optional =
        |text: &str, is_needed: bool| if is_needed { text.to_owned() } else { format!("[{text}]") };
    let argument_letters = &control.semantics().argument_letters;
    for word in &entry.words {
        // Where the macro is known, its own arguments are told in the place of all that there may be.
        if !taken.is_empty() && argument_letters.contains_key(&word.letter) {
            continue;
        }
        let text = optional(&word.letter, matches!(word.need, Need::Required | Need::Modal));
        let letter = Letter::parse(&word.letter);
        add(
            text,
            letter,
            format!("**{}** {}", word.letter, describe::meaning(&word.is, &describe::needs(word))),
        );
    }
    for argument in taken {
        let name = format!("{}=#{}", argument.letter, argument.variable);
        let says = argument.says.as_ref().map(|text| format!(": {text}")).unwrap_or_default();
        let documentation =
            format!("**{}** becomes `#{}` in the macro{says}", argument.letter, argument.variable);
        add(optional(&name, argument.is_needed), Letter::parse(&argument.letter), documentation);
    }
    if is_call(code) && taken.is_empty() {
        for (name, number) in argument_letters {
            let letter = Letter::parse(name);
            if letter.is_some_and(|letter| describe::word_of(code, letter).is_none()) {
                let documentation = format!("**{name}** becomes `#{number}` in the program that is called");
                add(format!("[{name}=#{number}]"), letter, documentation);
            }
        }
    }
    Signature { label, documentation: format!("**{}** {}", entry.title, entry.summary), parameters, active }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::signature_help;
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        check_asked(control, text, false, expected);
    }

    fn check_asked(control: &str, text: &str, is_asked: bool, expected: &Expect) {
        let mut fixture = Fixture::new(control, text);
        let (database, workspace) = (&mut fixture.database, &fixture.workspace);
        let found =
            signature_help(database, workspace, fixture.document, fixture.offset, is_asked, &|| false);
        let found = found.into_iter().map(|signature| {
            let active = signature.active.and_then(|index| signature.parameters.get(index as usize));
            let label =
                |range: &std::ops::Range<u32>| &signature.label[range.start as usize..range.end as usize];
            let active = active.map(|word| format!("{}: {}", label(&word.label), word.documentation));
            format!("{}\n  {}\n", signature.label, active.unwrap_or_else(|| "no word".to_owned()))
        });
        expected.assert_eq(&found.collect::<String>());
    }

    #[test]
    fn words_of_the_codes_before_the_cursor() {
        check(
            "haas-mill",
            "G98 G83 X1. Q$0\n",
            &expect![[r#"
            G83 [X] [Y] [A] [B] [C] Z R F [L] Q [I] [J] [K] [P] [E]
              Q: **Q** depth of one peck, here or earlier, length, above 0
        "#]],
        );
        check(
            "linuxcnc",
            "g81 $0\n",
            &expect![[r#"
                G81 [X] [Y] [Z] [U] [V] [W] [@] [^] R [L] F
                  [X]: **X** X of the hole, optional, length
            "#]],
        );
        check("haas-mill", "G0 (G83 $0)\n", &expect![[""]]);
    }

    #[test]
    fn help_goes_when_the_block_is_complete() {
        check(
            "haas-mill",
            "G83 Z-1. R.1 Q.1 $0\n",
            &expect![[r#"
                G83 [X] [Y] [A] [B] [C] Z R F [L] Q [I] [J] [K] [P] [E]
                  F: **F** feed rate, here or earlier
            "#]],
        );
        check(
            "haas-mill",
            "G83 Z-1. R.1 Q.1 F8$0\n",
            &expect![[r#"
                G83 [X] [Y] [A] [B] [C] Z R F [L] Q [I] [J] [K] [P] [E]
                  F: **F** feed rate, here or earlier
            "#]],
        );
        check("haas-mill", "G83 Z-1. R.1 Q.1 F8. $0\n", &expect![[""]]);
        check("haas-mill", "F8.\nG83 Z-1. R.1 Q.1 $0\n", &expect![[""]]);
        check("haas-mill", "G83 Z-1. R.1 Q.1 F8.\n$0\n", &expect![[""]]);
        check_asked(
            "haas-mill",
            "G83 Z-1. R.1 Q.1 F8. $0\n",
            true,
            &expect![[r#"
                G83 [X] [Y] [A] [B] [C] Z R F [L] Q [I] [J] [K] [P] [E]
                  [L]: **L** number of repeats; 0 only stores the cycle, optional, else 1, whole number, from 0
            "#]],
        );
    }

    #[test]
    fn a_move_that_lacks_nothing_has_none() {
        check("haas-mill", "G0 $0\n", &expect![[""]]);
        check(
            "haas-mill",
            "G1 X1. $0\n",
            &expect![[r#"
                G1 [X] [Y] [Z] [A] [B] [C] [U] [V] [W] F [L] [,C] [,R]
                  F: **F** feed rate, here or earlier
            "#]],
        );
        check("haas-mill", "F10.\nG1 X1. $0\n", &expect![[""]]);
        check(
            "haas-mill",
            "F10.\nG2 X1. $0\n",
            &expect![[r#"
            G2 [X] [Y] [Z] [A] [I] [J] [K] [R] [L] F
              [I]: **I** centre along X, from the start point, without R, length
        "#]],
        );
        check(
            "haas-mill",
            "F10.\nG2 X1. J$0\n",
            &expect![[r#"
            G2 [X] [Y] [Z] [A] [I] [J] [K] [R] [L] F
              [J]: **J** centre along Y, from the start point, without R, length
        "#]],
        );
        check("haas-mill", "F10.\nG2 X1. J1. $0\n", &expect![[""]]);
    }

    #[test]
    fn arguments_of_a_macro_call() {
        check_asked(
            "fanuc-mill",
            "G65 P9010 A1. D$0\n",
            true,
            &expect![[r#"
            G65 P [L] [A] [B] [C] [D] [E] [F] [H] [I] [J] [K] [M] [Q] [R] [S] [T] [U] [V] [W] [X] [Y] [Z]
              [D]: **D** argument #7, optional, number
        "#]],
        );
        check("fanuc-mill", "G65 P9010 $0\n", &expect![[""]]);
        check(
            "fanuc-mill",
            "G65 $0\n",
            &expect![[r#"
                G65 P [L] [A] [B] [C] [D] [E] [F] [H] [I] [J] [K] [M] [Q] [R] [S] [T] [U] [V] [W] [X] [Y] [Z]
                  P: **P** program number, required, from 1
            "#]],
        );
    }

    /// A call of a macro that needs `A` and `Z`, and does without `D`.
    fn check_call(typed: &str, expected: &Expect) {
        let macros = "//- b.nc\nO9010\n(A=#1 DIAMETER)\nIF [#7 EQ #0] THEN #7=2.\nG0 X#1 Y#7 Z#26\nM99\n";
        check("fanuc-mill", &format!("//- a.nc\nO1\n{typed}\nM30\n{macros}"), expected);
    }

    #[test]
    fn arguments_that_the_macro_reads() {
        check_call(
            "G65 P9010 $0",
            &expect![[r#"
            G65 P [L] A=#1 [D=#7] Z=#26
              A=#1: **A** becomes `#1` in the macro: DIAMETER
        "#]],
        );
        check_call(
            "G65 P9010 A$0",
            &expect![[r#"
            G65 P [L] A=#1 [D=#7] Z=#26
              A=#1: **A** becomes `#1` in the macro: DIAMETER
        "#]],
        );
        check_call(
            "G65 P9010 A1. Z2.$0",
            &expect![[r#"
            G65 P [L] A=#1 [D=#7] Z=#26
              Z=#26: **Z** becomes `#26` in the macro
        "#]],
        );
        check_call("G65 P9010 A1. Z2. $0", &expect![[""]]);
    }

    #[test]
    fn the_word_of_a_cursor_inside_it_is_active() {
        check_asked(
            "haas-mill",
            "G43 H$01 Z1.\n",
            true,
            &expect![[r#"
            G43 H [X] [Y] [Z] [A] [B] [C]
              H: **H** length offset, normally that of the tool in the spindle; H0 cancels, here or earlier, whole number, 0 to 2999, but not 201 to 999
        "#]],
        );
        check_asked(
            "haas-mill",
            "G43 H1$0\n",
            true,
            &expect![[r#"
            G43 H [X] [Y] [Z] [A] [B] [C]
              H: **H** length offset, normally that of the tool in the spindle; H0 cancels, here or earlier, whole number, 0 to 2999, but not 201 to 999
        "#]],
        );
    }

    #[test]
    fn what_may_follow_is_active_when_nothing_is_missing() {
        check_asked(
            "haas-mill",
            "O1\nM98 P2000 $0\n",
            true,
            &expect![[r#"
            M98 [P] [L]
              [L]: **L** number of calls, optional, else 1, whole number, 1 to 99
        "#]],
        );
    }

    #[test]
    fn arguments_of_a_subroutine_of_o_words() {
        check(
            "linuxcnc",
            "o<foo> sub\n(#1 - depth)\ng1 z[#1] f#3 (feed)\no<foo> endsub\no<foo> call $0\nm2\n",
            &expect![[r#"
                o<foo> call [#1] [#2] [#3]
                  [#1]: becomes `#1` in the subroutine: depth
            "#]],
        );
        check(
            "linuxcnc",
            "o<foo> sub\n(#1 - depth)\ng1 z[#1] f#3 (feed)\no<foo> endsub\no<foo> call [1] [$0\nm2\n",
            &expect![[r#"
                o<foo> call [#1] [#2] [#3]
                  [#2]: becomes `#2` in the subroutine
            "#]],
        );
        check(
            "linuxcnc",
            "o<foo> sub\n(#1 - depth)\ng1 z[#1] f#3 (feed)\no<foo> endsub\no<foo> call [1] [2] $0\nm2\n",
            &expect![[r#"
                o<foo> call [#1] [#2] [#3]
                  [#3]: becomes `#3` in the subroutine: feed
            "#]],
        );
        check(
            "linuxcnc",
            "o<foo> sub\n(#1 - depth)\ng1 z[#1] f#3 (feed)\no<foo> endsub\no<foo> call [1] [2] [3] $0\nm2\n",
            &expect![[""]],
        );
        check("linuxcnc", "o<foo> call [$0\nm2\n", &expect![[""]]);
    }
}
