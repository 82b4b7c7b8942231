//! Text that a program gives to the operator, or to a printer.
//!
//! Knows: comments that are shown, the text of a stop, what a print statement makes of variables. Must not know: who reads it.

use std::fmt::Write;
use std::rc::Rc;

use gcheck_controls::{MessageComment, Semicolon};
use gcheck_program::{Place, Statement};

use crate::eval::value::Domain;
use crate::event::Event;
use crate::exec::context::Executor;
use crate::observer::Observer;
use crate::state::State;

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// `(MSG, …)`: the last comment of the block, where the control shows such comments. True where it ends the program.
    pub(super) fn message_comment(&mut self, state: &mut State<D>) -> bool {
        let shown = &self.model.semantics().message_comments;
        if shown.is_empty() {
            return false;
        }
        let starts_remark = self.model.control().syntax().semicolon == Semicolon::Comment;
        let Some(comment) = self.comment_in(|text| {
            // What comes after a `;` is a remark, whatever parentheses are in it.
            let text = if starts_remark { before_remark(text) } else { text };
            let (_, last) = text.rsplit_once('(')?;
            Some(Rc::from(last.split(')').next()?))
        }) else {
            return false;
        };
        let Some((word, text)) = comment.split_once(',') else { return false };
        let Some((_, kind)) = shown.iter().find(|(name, _)| word.trim().eq_ignore_ascii_case(name)) else {
            return false;
        };
        let text = match kind {
            MessageComment::Text | MessageComment::Abort => Rc::from(text),
            MessageComment::Values => self.with_values(text, state),
        };
        self.emit(state, Event::Message(text));
        *kind == MessageComment::Abort
    }

    /// The first comment of the block, which the control shows beside a stop; empty without one.
    pub(crate) fn stop_text(&self) -> Rc<str> {
        let comment = self.comment_in(|text| {
            let (_, comment) = text.split_once('(')?;
            Some(Rc::from(comment.split(')').next()?.trim()))
        });
        comment.unwrap_or_else(|| Rc::from(""))
    }

    fn comment_in(&self, part: impl FnOnce(&str) -> Option<Rc<str>>) -> Option<Rc<str>> {
        let file = self.file(self.origin.at.file)?;
        // A comment behind a statement is no part of the block's own range.
        part(file.loaded.line_from(self.origin.start))
    }

    /// `#5` and `#<name>` become their values, with six decimals, or as the last `%d`, `%f` (four) or `%.3f` before them says;
    /// a parameter that nobody set becomes `######`.
    fn with_values(&mut self, text: &str, state: &State<D>) -> Rc<str> {
        let mut shown = String::with_capacity(text.len());
        let mut rest = text;
        let mut decimals = 6;
        while let Some(at) = rest.find(['#', '%']) {
            let (before, behind) = rest.split_at(at);
            shown.push_str(before);
            if let Some(format) = behind.strip_prefix('%') {
                if let Some((wanted, behind)) = decimals_of(format) {
                    decimals = wanted;
                    rest = behind;
                } else {
                    shown.push('%');
                    rest = format;
                }
                continue;
            }
            let behind = behind.strip_prefix('#').unwrap_or_default();
            let digits = behind.chars().take_while(char::is_ascii_digit).count();
            let name = behind.strip_prefix('<').and_then(|name| name.split_once('>'));
            let value = if let Some((name, behind)) = name {
                rest = behind;
                let name: String =
                    name.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect();
                self.read_name(self.program.name(&name), state).ok()
            } else if let (Ok(number), Some(behind)) =
                (behind.get(..digits).unwrap_or_default().parse(), behind.get(digits..))
            {
                rest = behind;
                self.read_variable(number, state).ok()
            } else {
                shown.push('#');
                rest = behind;
                continue;
            };
            match value.as_ref().map(D::known) {
                Some(Some(number)) => {
                    let text = format!("{number:.decimals$}");
                    // What rounds to zero has no sign.
                    let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
                    shown.push_str(text.strip_prefix('-').filter(|_| is_zero).unwrap_or(&text));
                }
                Some(None) => shown.push('?'),
                None => shown.push_str("######"),
            }
        }
        shown.push_str(rest);
        Rc::from(shown)
    }

    /// A command to the firmware: after homing and jogging the axes are where the program does not say.
    pub(super) fn system_command(&mut self, place: &Place, statement: &Statement, state: &mut State<D>) {
        let Some(file) = self.file(self.origin.at.file) else { return };
        let range = statement.range.start as usize..statement.range.end as usize;
        let text = file.loaded.chunk_text(place.chunk).get(range).unwrap_or_default();
        let command = text.strip_prefix('$').unwrap_or_default();
        let is = |head: &String| {
            command.get(..head.len()).is_some_and(|written| written.eq_ignore_ascii_case(head))
        };
        if self.model.semantics().commands_that_move.iter().any(is) {
            state.points.lose();
        }
    }

    /// `DPRNT[…]`: a line for the printer. `#5[53]` prints a variable with three decimals, `*` a blank; what is not known, and
    /// what is computed, is a question mark.
    pub(super) fn print(&mut self, place: &Place, statement: &Statement, state: &mut State<D>) {
        let Some(file) = self.file(self.origin.at.file) else { return };
        let range = statement.range.start as usize..statement.range.end as usize;
        let text = file.loaded.chunk_text(place.chunk).get(range).unwrap_or_default();
        let Some((head, text)) = text.split_once('[') else { return };
        if !head.trim().eq_ignore_ascii_case("DPRNT") {
            // Opening and closing the port, and what is printed in binary.
            return;
        }
        let text = text.trim_end().strip_suffix(']').unwrap_or(text);
        let mut printed = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(first) = rest.chars().next() {
            rest = rest.get(first.len_utf8()..).unwrap_or_default();
            if first != '#' {
                printed.push(if first == '*' { ' ' } else { first });
                continue;
            }
            let mut value = None;
            if rest.starts_with('[') {
                rest = rest.get(bracketed(rest)..).unwrap_or_default();
            } else {
                let digits = rest.chars().take_while(char::is_ascii_digit).count();
                let number = rest.get(..digits).and_then(|digits| digits.parse().ok());
                value = number.and_then(|number| self.read_variable(number, state).ok());
                rest = rest.get(digits..).unwrap_or_default();
            }
            let mut decimals = None;
            if rest.starts_with('[') {
                let end = bracketed(rest);
                let format = rest.get(..end).unwrap_or_default();
                decimals = format.chars().filter_map(|c| c.to_digit(10)).next_back();
                rest = rest.get(end..).unwrap_or_default();
            }
            match (value.as_ref().and_then(D::known), decimals) {
                (Some(number), Some(decimals)) => {
                    let _ = write!(printed, "{number:.*}", decimals as usize);
                }
                (Some(number), None) => {
                    let _ = write!(printed, "{number}");
                }
                (None, _) => printed.push('?'),
            }
        }
        self.emit(state, Event::Message(Rc::from(printed)));
    }
}

/// The text in front of the first `;` that is in no parentheses.
fn before_remark(text: &str) -> &str {
    let mut is_open = false;
    let end = text.find(|c| {
        match c {
            '(' => is_open = true,
            ')' => is_open = false,
            _ => {}
        }
        c == ';' && !is_open
    });
    end.and_then(|end| text.get(..end)).unwrap_or(text)
}

/// The decimals of a format behind its `%`, and what stands behind it.
fn decimals_of(format: &str) -> Option<(usize, &str)> {
    if let Some(behind) = format.strip_prefix('d') {
        return Some((0, behind));
    }
    if let Some(behind) = format.strip_prefix('f') {
        return Some((4, behind));
    }
    let digits = format.strip_prefix('.')?;
    let digit = digits.chars().next()?.to_digit(10)?;
    Some((digit as usize, digits.get(1..)?.strip_prefix('f')?))
}

/// Length of what stands in the brackets that the text begins with, brackets included; all of it when they stay open.
fn bracketed(text: &str) -> usize {
    let mut depth = 0_u32;
    for (at, c) in text.char_indices() {
        match c {
            '[' => depth += 1,
            ']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + c.len_utf8();
        }
    }
    text.len()
}
