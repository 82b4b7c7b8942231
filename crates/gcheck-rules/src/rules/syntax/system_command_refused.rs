//! A `$` line that the control refuses.

use std::ops::Range;

use gcheck_controls::{AlarmEntry, CodeNumber, SystemCommands};
use gcheck_program::{BlockFlags, StatementKind};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, limit};

declare_rule! {
    /// A line for the control itself (`$H`, `$110=500`, `$J=G91 X1 F100`) is not one that the control knows, sets a setting
    /// that it does not have or to what is not a number, or jogs without a feed or with a code that jogging does not take.
    ///
    /// ## Why it matters
    /// The control answers with an error and does nothing: the axes are not homed, the setting stays, the axis does not move.
    /// What follows is sent all the same, and starts from another state than the program means.
    ///
    /// ## Reported
    /// ```nc,reported,grbl
    /// $J=G91 X10
    /// ```
    /// ```nc,reported,grbl
    /// $J=G2 X1 F10
    /// ```
    /// ```nc,reported,grbl
    /// $999=1
    /// ```
    /// ```nc,reported,grbl
    /// $130=abc
    /// ```
    /// ```nc,reported,grbl
    /// $foo
    /// ```
    /// ## Not reported
    /// ```nc,quiet,grbl
    /// $H
    /// $130 = 200.5 (TRAVEL OF X)
    /// $j=g91 g21 x10 f500
    /// $N0=G21 G90
    /// ```
    rule "system-command-refused" in "syntax" {
        summary: "`$` line that the control refuses",
        severity: Error,
        tier: Block,
        control_specific: true,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(commands) = cx.control().system_commands() else { return };
    let lines = cx.statements().filter(|statement| statement.kind == StatementKind::Command);
    for line in lines {
        let written = Written::new(cx.slice(line.range.clone()), line.range.start);
        // The control takes comments out of a line; what follows one is not seen here.
        let is_whole = !cx.block().flags.contains(BlockFlags::COMMENT);
        let Some(refusal) = refusal(&written, commands, is_whole) else { continue };
        let Refusal { at, message, label, help, alarm } = refusal;
        report.add(
            Finding::new(&META, cx.in_file(at), message)
                .label(label)
                .alarm(alarm.number.clone())
                .help(help)
                .at_most(limit(commands.confidence).min(limit(alarm.confidence)))
                // Other controls read such lines too, with other commands and settings.
                .at_most(cx.environment.most_for_this_control()),
        );
    }
}

/// What the control answers to a line.
struct Refusal<'c> {
    at: Range<u32>,
    message: String,
    label: &'static str,
    help: String,
    alarm: &'c AlarmEntry,
}

/// A line as the control compares it, capitals without blanks, each with its place. `?`, `!` and `~` act as they arrive and never
/// come into a line.
struct Written {
    bytes: Vec<u8>,
    places: Vec<u32>,
}

impl Written {
    fn new(text: &str, start: u32) -> Self {
        let is_kept = |byte: u8| !byte.is_ascii_whitespace() && !b"?!~".contains(&byte);
        let kept = (start..).zip(text.bytes()).filter(|(_, byte)| is_kept(*byte));
        let (places, bytes) = kept.map(|(at, byte)| (at, byte.to_ascii_uppercase())).unzip();
        Self { bytes, places }
    }

    fn text(&self, from: usize, to: usize) -> String {
        String::from_utf8_lossy(self.bytes.get(from..to).unwrap_or_default()).into_owned()
    }

    /// The bytes of the chunk that these are written in.
    fn range(&self, from: usize, to: usize) -> Range<u32> {
        let place = |at: usize| self.places.get(at).copied();
        let start = place(from).or_else(|| self.places.last().copied()).unwrap_or_default();
        start..to.checked_sub(1).and_then(place).map_or(start + 1, |last| last + 1).max(start + 1)
    }
}

fn refusal<'c>(line: &Written, commands: &'c SystemCommands, is_whole: bool) -> Option<Refusal<'c>> {
    let all = line.bytes.len();
    let text = line.text(0, all);
    if commands.plain.contains(&text) || commands.texts.iter().any(|head| text.starts_with(head.as_str())) {
        return None;
    }
    if text.starts_with(commands.jog.as_str()) {
        return jog_refusal(line, commands, is_whole);
    }
    let whole = line.range(0, all);
    let digits = text.bytes().skip(1).take_while(u8::is_ascii_digit).count();
    let Some(value) = text.get(1 + digits..).filter(|_| digits > 0).and_then(|rest| rest.strip_prefix('='))
    else {
        return Some(Refusal {
            at: whole,
            message: format!("`{text}` is not a command of the control"),
            label: "the control does not know this line",
            help: "correct the command, or remove the line".to_owned(),
            // What is read as a number first is not found to be one.
            alarm: if is_read_as_number(&text, commands) { &commands.bad_number } else { &commands.unknown },
        });
    };
    let number = text.get(1..=digits).unwrap_or_default();
    if !number.parse().is_ok_and(|number| commands.has_setting(number)) {
        return Some(Refusal {
            at: line.range(0, 1 + digits),
            message: format!("setting `${number}` does not exist"),
            label: "the control has no setting of this number",
            help: "correct the number of the setting".to_owned(),
            alarm: &commands.unknown,
        });
    }
    let refused = |message: String, alarm| Refusal {
        at: line.range(2 + digits, all),
        message,
        label: "the setting stays as it was",
        help: "write a number from 0".to_owned(),
        alarm,
    };
    let is_plain = value.bytes().all(|byte| byte.is_ascii_digit() || b"+-.".contains(&byte));
    match value.parse::<f64>() {
        // The control reads no exponent.
        _ if !is_plain => {
            Some(refused(format!("value of setting `${number}` is not a number"), &commands.bad_number))
        }
        Ok(value) if value < 0.0 => {
            Some(refused(format!("setting `${number}` below zero"), &commands.negative))
        }
        Ok(value) if value.is_finite() => None,
        _ => Some(refused(format!("value of setting `${number}` is not a number"), &commands.bad_number)),
    }
}

/// Does the control look for the number of a setting there, since no command begins so?
fn is_read_as_number(text: &str, commands: &SystemCommands) -> bool {
    let first = text.get(1..2).unwrap_or_default();
    let heads = commands.plain.iter().chain(&commands.texts).chain([&commands.jog]);
    !heads.filter_map(|head| head.get(1..2)).any(|known| known == first)
        && !first.bytes().all(|byte| byte.is_ascii_digit())
}

fn jog_refusal<'c>(line: &Written, commands: &'c SystemCommands, is_whole: bool) -> Option<Refusal<'c>> {
    let mut at = commands.jog.len();
    let mut feeds = false;
    while let Some(letter) = line.bytes.get(at).copied() {
        let is_number = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+');
        let digits = line.bytes.iter().skip(at + 1).take_while(|byte| is_number(byte)).count();
        let end = at + 1 + digits;
        let word = line.text(at, end);
        let refused = |message: String, help: &str, alarm| {
            let label = "the control does not jog with it";
            Some(Refusal { at: line.range(at, end), message, label, help: help.to_owned(), alarm })
        };
        if digits == 0 || !letter.is_ascii_alphabetic() {
            // What is not a word is an error of the control for every block.
            return None;
        }
        let is_code = matches!(letter, b'G' | b'M');
        let is_same = |code: &String| CodeNumber::parse(code) == CodeNumber::parse(&word);
        if is_code && !commands.jog_codes.iter().any(is_same) {
            let help = format!("jog with {} alone", commands.jog_codes.join(", "));
            return refused(format!("`{word}` in a jog command"), &help, &commands.jog_code);
        }
        if !is_code && !commands.jog_letters.iter().any(|known| known.as_bytes() == [letter]) {
            return refused(format!("`{word}` in a jog command"), "remove the word", &commands.jog_word);
        }
        feeds |= letter == b'F';
        at = end;
    }
    (is_whole && !feeds).then(|| Refusal {
        at: line.range(0, line.bytes.len()),
        message: "jog without a feed (`F`)".to_owned(),
        label: "the feed of the program does not count for jogging",
        help: "write the feed into the line: `F500`".to_owned(),
        alarm: &commands.jog_feed,
    })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn each_mistake_has_its_error() {
        check_rule(
            &RULE,
            "grbl",
            "$J=X10\n$J=G2 X1 F10\n$J=X1 S100 F10\n$999=1\n$40=1\n$130=abc\n$130=-5\n$130=\n$foo\n$hq\n$J\n",
            &expect![[r#"
                1 | $J=X10
                  | ^^^^^^ error[system-command-refused] jog without a feed (`F`)
                2 | $J=G2 X1 F10
                  |    ^^ error[system-command-refused] `G2` in a jog command
                3 | $J=X1 S100 F10
                  |       ^^^^ error[system-command-refused] `S100` in a jog command
                4 | $999=1
                  | ^^^^ error[system-command-refused] setting `$999` does not exist
                5 | $40=1
                  | ^^^ error[system-command-refused] setting `$40` does not exist
                6 | $130=abc
                  |      ^^^ error[system-command-refused] value of setting `$130` is not a number
                7 | $130=-5
                  |      ^^ error[system-command-refused] setting `$130` below zero
                8 | $130=
                  |     ^ error[system-command-refused] value of setting `$130` is not a number
                9 | $foo
                  | ^^^^ error[system-command-refused] `$FOO` is not a command of the control
                10 | $hq
                   | ^^^ error[system-command-refused] `$HQ` is not a command of the control
                11 | $J
                   | ^^ error[system-command-refused] `$J` is not a command of the control
            "#]],
        );
    }

    #[test]
    fn blanks_and_small_letters_make_no_difference() {
        check_rule(
            &RULE,
            "grbl",
            "$ h\n$ 1 3 0 = 2 0 0\n$j = g53 x-1 f100\n$rst=*\n$\n$$\n$x\n$X~\n$J=G91 X1 (in) F100\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_control_whose_commands_are_not_listed_is_not_judged() {
        check_rule(&RULE, "fluidnc", "$foo\n$999=1\n", &expect![[""]]);
    }
}
