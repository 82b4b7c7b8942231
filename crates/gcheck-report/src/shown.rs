//! Text as it may be shown: nothing in a program or in a message can steer a terminal or reorder a line.
//!
//! Knows: characters. Must not know: where they come from.

use std::borrow::Cow;

/// What stands for a byte or character that cannot be shown.
pub(crate) const REPLACEMENT: char = '\u{FFFD}';

/// A character of a program as it is shown: one character, at least one column wide. A tab stays.
pub(crate) fn program_char(c: char) -> char {
    match c {
        '\t' => '\t',
        '\u{7F}' => '\u{2421}',
        // The pictures of the control characters are in their order.
        '\0'..='\u{1F}' => char::from_u32(0x2400 + u32::from(c)).unwrap_or(REPLACEMENT),
        c if steers(c) => REPLACEMENT,
        c => c,
    }
}

/// Second control set, marks that turn the direction of writing, separators, characters without width.
fn steers(c: char) -> bool {
    matches!(
        c,
        '\u{80}'..='\u{9F}' | '\u{AD}' | '\u{61C}' | '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}'
            | '\u{2060}'..='\u{206F}' | '\u{FEFF}' | '\u{FFF9}'..='\u{FFFB}'
    )
}

/// A message, a path: one line.
pub fn one_line(text: &str) -> Cow<'_, str> {
    shown(text, |c| if c == '\n' || c == '\t' { ' ' } else { message_char(c) })
}

/// A note: lines stay lines.
pub(crate) fn lines(text: &str) -> Cow<'_, str> {
    shown(text, |c| match c {
        '\n' => '\n',
        '\t' => ' ',
        c => message_char(c),
    })
}

/// A text of any number of lines as it may be printed: nothing in it steers the terminal.
pub fn harmless(text: &str) -> Cow<'_, str> {
    lines(text)
}

/// In a message SUB is most likely quoted from a program, where it stands for a byte that is not UTF-8.
fn message_char(c: char) -> char {
    if c == gcheck_syntax::SourceText::STAND_IN { REPLACEMENT } else { program_char(c) }
}

fn shown(text: &str, map: impl Fn(char) -> char) -> Cow<'_, str> {
    if text.bytes().all(|byte| (0x20..0x7F).contains(&byte)) {
        return Cow::Borrowed(text);
    }
    Cow::Owned(text.replace("\r\n", "\n").chars().map(map).collect())
}

/// `1,204`.
pub(crate) fn number(n: usize) -> String {
    let digits = n.to_string();
    let mut grouped = String::with_capacity(digits.len() + digits.len() / 3);
    for (at, digit) in digits.char_indices() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_steers_the_terminal() {
        assert_eq!(
            one_line("a\x1b[31mb\r\n\tc\r\u{202E}d\u{9B}e\x1Af µ日😀"),
            "a␛[31mb  c␍\u{FFFD}d\u{FFFD}e\u{FFFD}f µ日😀"
        );
        assert_eq!(lines("first\r\nsecond\x07"), "first\nsecond␇");
        assert_eq!(program_char('\x1A'), '␚');
    }

    #[test]
    fn numbers_are_grouped() {
        assert_eq!(
            [0, 999, 1_000, 12_345, 1_234_567].map(number),
            ["0", "999", "1,000", "12,345", "1,234,567"]
        );
    }
}
