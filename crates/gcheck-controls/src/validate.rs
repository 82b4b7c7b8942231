//! Consistency of a control's data: every name resolves, every fact has a source.
//!
//! Knows: what an entry must satisfy. Must not know: TOML. Law 9 of the architecture ("data is true") starts here;
//! that examples are legal blocks is proved where programs can be checked.

use crate::schema::Confidence;
use crate::{CodeNumber, Control, Letter};

/// Everything that is wrong with the data of a control; empty for every control of a release.
pub fn problems(control: &Control) -> Vec<String> {
    let mut found = Problems { control, list: Vec::new() };
    found.head();
    found.groups();
    for code in control.codes() {
        found.code(code.entry());
    }
    found.letters();
    found.rest();
    found.list
}

struct Problems<'c> {
    control: &'c Control,
    list: Vec<String>,
}

impl Problems<'_> {
    fn say(&mut self, place: &str, what: impl AsRef<str>) {
        self.list.push(format!("{}: {place}: {}", self.control.name(), what.as_ref()));
    }

    fn source(&mut self, place: &str, source: &str) {
        if source.trim().is_empty() {
            self.say(place, "has no source");
        }
    }

    fn head(&mut self) {
        if self.control.phases().is_empty() {
            self.say("control.toml", "has no phases");
        }
        if self.control.axes().is_empty() {
            self.say("control.toml", "has no axes");
        }
        let numbers = self.control.numbers();
        for (name, least) in [
            ("least-inch", numbers.least_inch),
            ("least-mm", numbers.least_mm),
            ("least-angle", numbers.least_angle),
        ] {
            if least.is_nan() || least <= 0.0 {
                self.say("numbers", format!("`{name}` must be positive"));
            }
        }
        let source = numbers.source.clone();
        self.source("numbers", &source);
    }

    fn groups(&mut self) {
        let control = self.control;
        for group in control.groups() {
            self.source(&group.id, &group.source);
            if let Some(default) = &group.default {
                match CodeNumber::parse(default).and_then(|n| control.code(n)) {
                    Some(code) if code.group().id == group.id => {}
                    _ => self.say(&group.id, format!("default `{default}` is no code of the group")),
                }
            }
        }
    }

    /// A list item is a code of this control or `@group`.
    fn resolves(&self, item: &str) -> bool {
        match item.strip_prefix('@') {
            Some(group) => self.control.group_by_id(group).is_some(),
            None => CodeNumber::parse(item).is_some_and(|n| self.control.code(n).is_some()),
        }
    }

    fn code(&mut self, entry: &crate::CodeEntry) {
        let code = entry.code.as_str();
        self.source(code, &entry.source);
        if CodeNumber::parse(code).map(|n| n.to_string()).as_deref() != Some(code) {
            self.say(code, "is not written canonically (no leading zeros)");
        }
        if !self.control.phases().contains(&entry.phase) {
            self.say(code, format!("phase `{}` is not among the control's phases", entry.phase));
        }
        for (what, text) in
            [("title", &entry.title), ("summary", &entry.summary), ("example", &entry.example)]
        {
            if text.trim().is_empty() {
                self.say(code, format!("has no {what}"));
            }
        }
        if entry.title.ends_with('.') {
            self.say(code, "title ends with a full stop");
        }
        if !entry.summary.ends_with(['.', '!', '?']) {
            self.say(code, "summary is no sentence");
        }
        if entry.example.contains('\n') {
            self.say(code, "example is more than one line; use `setup`");
        }
        let lists = [&entry.requires, &entry.recommends, &entry.forbids, &entry.conflicts, &entry.cancels];
        for item in lists.into_iter().flatten() {
            if !self.resolves(item) {
                self.say(code, format!("refers to `{item}`, which is no code or group here"));
            }
        }
        for item in &entry.cancelled_by {
            let is_word = Letter::new(item.as_bytes().first().copied().unwrap_or(0)).is_some()
                && item.len() > 1
                && item.bytes().skip(1).all(|b| b.is_ascii_digit());
            if !self.resolves(item) && !is_word {
                self.say(code, format!("is cancelled by `{item}`, which is no code, group or word here"));
            }
        }
        let mut seen = crate::LetterSet::EMPTY;
        for word in &entry.words {
            match Letter::parse(&word.letter) {
                None => self.say(code, format!("`{}` is no address", word.letter)),
                Some(letter) if !seen.insert(letter) => {
                    self.say(code, format!("word `{letter}` is listed twice"));
                }
                Some(_) => {}
            }
            for letter in &word.instead {
                if Letter::parse(letter).is_none_or(|letter| self.control.letter(letter).is_none()) {
                    self.say(code, format!("`{letter}` instead of `{}` is no address here", word.letter));
                }
            }
            if word.need == crate::Need::Conditional && word.when.is_none() {
                self.say(code, format!("word `{}` is conditional but does not say when", word.letter));
            }
        }
        let combined = entry.one_of.iter().chain(&entry.not_together).flatten();
        for letter in combined.flat_map(|item| item.bytes()).filter_map(Letter::new) {
            if !seen.contains(letter) && !entry.any_words {
                self.say(code, format!("combines `{letter}`, which is not among its words"));
            }
        }
        for alarm in &entry.alarms {
            if alarm.text.trim().is_empty() {
                self.say(code, "has an alarm without text");
            }
        }
    }

    fn letters(&mut self) {
        let control = self.control;
        for (ix, entry) in control.letters.iter().enumerate() {
            match entry {
                Some(entry) => self.source(&entry.letter, &entry.source),
                None if ix < 26 && control.axes().iter().any(|a| a.index() == ix) => {
                    self.say("letters.toml", format!("axis number {ix} has no entry"));
                }
                None => {}
            }
        }
        for code in control.codes() {
            for word in &code.entry().words {
                if Letter::parse(&word.letter).is_some_and(|l| control.letter(l).is_none()) {
                    self.say(
                        &code.entry().code,
                        format!("word `{}` has no entry in letters.toml", word.letter),
                    );
                }
            }
        }
    }

    fn rest(&mut self) {
        let control = self.control;
        for variable in control.variables() {
            let place = match (&variable.range, &variable.name) {
                (Some([first, last]), None) if first <= last => format!("#{first}-#{last}"),
                (None, Some(name)) => format!("#<{name}>"),
                _ => {
                    self.say("variables.toml", format!("`{}` needs a range or a name", variable.title));
                    continue;
                }
            };
            self.source(&place, &variable.source);
        }
        for setting in control.settings() {
            self.source(&setting.number, &setting.source);
            if setting.values.is_empty() {
                self.say(&setting.number, "lists no values");
            }
        }
        for rule in control.rules_with_alarms() {
            if control.alarm(rule).is_none_or(|a| a.text.trim().is_empty()) {
                self.say("alarms.toml", format!("the alarm of `{rule}` has no text"));
            }
        }
        for function in control.functions() {
            self.source(&function.name, &function.source);
        }
        if control.limits().m_codes_per_block.is_some() && control.limits().m_codes_confidence.is_none() {
            self.say("limits", "`m-codes-per-block` needs `m-codes-confidence`");
        }
        if control.numbers().max_digits.is_some() && control.numbers().max_digits_confidence.is_none() {
            self.say("numbers", "`max-digits` needs `max-digits-confidence`");
        }
        debug_assert!(Confidence::Assumed < Confidence::Manual, "severity relies on this order");
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn one_control_is_the_fallback() {
        let fallbacks = crate::loader::all_control_files().filter(|c| c.fallback).count();
        assert_eq!(fallbacks, 1);
        assert!(crate::names().contains(&crate::fallback()));
    }

    #[test]
    fn every_control_is_consistent() {
        let mut wrong = Vec::new();
        for name in crate::names() {
            match crate::load(name) {
                Ok(control) => wrong.extend(super::problems(&control)),
                Err(error) => wrong.push(error.to_string()),
            }
        }
        assert!(wrong.is_empty(), "{} problems:\n{}", wrong.len(), wrong.join("\n"));
    }
}
