//! The words of the code that is being typed, and the arguments of a macro call.
//!
//! Knows: which word the cursor stands at. Must not know: states.

use std::ops::Range;

use gcheck_controls::{Code, Control, Effect, Letter, Need};
use gcheck_db::DocumentId;
use gcheck_syntax::SyntaxKind;

use crate::typing::Typing;
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
    /// Index of the word at the cursor.
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
pub fn signature_help(workspace: &Workspace, document: DocumentId, offset: u32) -> Vec<Signature> {
    let Some(file) = workspace.file(document) else { return Vec::new() };
    let typing = Typing::new(&file.snapshot, offset);
    if typing.comment().is_some() {
        return Vec::new();
    }
    let at = typing
        .line
        .iter()
        .rfind(|piece| piece.range.start < typing.offset && !piece.kind.is_trivia())
        // Behind a blank the next word is to come.
        .filter(|piece| piece.range.end == typing.offset)
        .filter(|piece| matches!(piece.kind, SyntaxKind::WORD | SyntaxKind::LETTER))
        .and_then(|piece| typing.letter(piece));
    let mut codes: Vec<Code<'_>> = typing
        .codes()
        .into_iter()
        .filter(|(range, _)| range.end <= typing.offset)
        .map(|(_, code)| code)
        .filter(|code| !code.entry().words.is_empty() || is_call(*code))
        .collect();
    codes.reverse();
    codes.into_iter().map(|code| signature(typing.control(), code, at)).collect()
}

fn is_call(code: Code<'_>) -> bool {
    matches!(code.effect(), Effect::MacroCall | Effect::MacroModal)
}

fn signature(control: &Control, code: Code<'_>, at: Option<Letter>) -> Signature {
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
    for word in &entry.words {
        let text = match word.need {
            Need::Required | Need::Modal => word.letter.clone(),
            Need::Optional | Need::Conditional => format!("[{}]", word.letter),
        };
        let letter = Letter::parse(&word.letter);
        add(text, letter, format!("**{}** {}, {}", word.letter, word.is, describe::needs(word)));
    }
    if is_call(code) {
        for (name, number) in &control.semantics().argument_letters {
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
        let fixture = Fixture::new(control, text);
        let found = signature_help(&fixture.workspace, fixture.document, fixture.offset).into_iter().map(
            |signature| {
                let active = signature.active.and_then(|index| signature.parameters.get(index as usize));
                let label =
                    |range: &std::ops::Range<u32>| &signature.label[range.start as usize..range.end as usize];
                let active = active.map(|word| format!("{}: {}", label(&word.label), word.documentation));
                format!("{}\n  {}\n", signature.label, active.unwrap_or_else(|| "no word".to_owned()))
            },
        );
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
                  no word
            "#]],
        );
        check("haas-mill", "G0 (G83 $0)\n", &expect![[""]]);
    }

    #[test]
    fn arguments_of_a_macro_call() {
        check(
            "fanuc-mill",
            "G65 P9010 A1. D$0\n",
            &expect![[r#"
            G65 P [L] [A] [B] [C] [D] [E] [F] [H] [I] [J] [K] [M] [Q] [R] [S] [T] [U] [V] [W] [X] [Y] [Z]
              [D]: **D** argument #7, optional, number
        "#]],
        );
    }
}
