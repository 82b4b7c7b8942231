//! Consistency of a control's data: every name resolves, every fact has a source.
//!
//! Knows: what an entry must satisfy. Must not know: TOML. Law 9 of the architecture ("data is true") starts here;
//! that examples are legal blocks is proved where programs can be checked.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use crate::control::Variable;
use crate::schema::{Confidence, LetterCase, Motion, VariableKind};
use crate::{BarFeederRules, CodeNumber, Control, CornerRules, Effect, Letter, SystemValue, SystemVariable};

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
    found.semantics();
    found.lasting();
    found.motion();
    found.system_variables();
    found.list
}

/// The names of all sources, whichever control they tell of.
static REFERENCES: LazyLock<BTreeSet<&str>> = LazyLock::new(|| crate::loader::all_references().collect());

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
        // Sources have notes in words too: of names only those that another control has are surely wrong here.
        for id in source.split(';').filter_map(|part| part.split_whitespace().next()) {
            let is_own = self.control.references().iter().any(|reference| reference.id == id);
            if !is_own && REFERENCES.contains(id) {
                self.say(place, format!("the source `{id}` is of another control"));
            }
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
        let customs = self.control.format_customs();
        if customs.letter_case == LetterCase::Lower && !self.control.syntax().lower_case {
            self.say("format", "small letters are customary, but the control does not read them");
        }
        let source = customs.source.clone();
        self.source("format", &source);
    }

    fn groups(&mut self) {
        let control = self.control;
        for group in control.groups() {
            self.source(&group.id, &group.source);
            if let Some(default) = &group.default {
                match CodeNumber::parse(default).and_then(|n| control.code(n)) {
                    Some(code) if code.group().id == group.id => {}
                    _ => self.say(&group.id, format!("default `{default}` is not a code of the group")),
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
        self.prose(code, entry);
        let lists = [&entry.requires, &entry.recommends, &entry.forbids, &entry.conflicts, &entry.cancels];
        for item in lists.into_iter().flatten() {
            if !self.resolves(item) {
                self.say(code, format!("refers to `{item}`, which is not a code or group here"));
            }
        }
        self.around(code, entry);
        for item in &entry.cancelled_by {
            if !self.resolves(item) && !is_word(item) {
                self.say(code, format!("is cancelled by `{item}`, which is not a code, group or word here"));
            }
        }
        if let Some(opens) = &entry.opens_data
            && (!has_word(entry, &opens.letter)
                || opens.values.is_empty()
                || opens.values.iter().any(|value| opens.in_one_block.contains(value))
                || !entry.cancelled_by.iter().any(|item| self.resolves(item)))
        {
            self.say(code, "opens lines of data by a word that it does not have, by a value that does not, or no code ends them");
        }
        self.words(code, entry);
        for alarm in &entry.alarms {
            if alarm.text.trim().is_empty() {
                self.say(code, "has an alarm without text");
            }
        }
        self.effect(entry);
    }

    /// What people read of a code.
    fn prose(&mut self, code: &str, entry: &crate::CodeEntry) {
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
            self.say(code, "summary is not a sentence");
        }
        if entry.example.contains('\n') {
            self.say(code, "example is more than one line; use `setup`");
        }
    }

    /// The words of a code: each one once, with what it needs beside it.
    fn words(&mut self, code: &str, entry: &crate::CodeEntry) {
        let mut seen = crate::LetterSet::EMPTY;
        for word in &entry.words {
            match Letter::parse(&word.letter) {
                None => self.say(code, format!("`{}` is not an address", word.letter)),
                Some(letter) if !seen.insert(letter) => {
                    self.say(code, format!("word `{letter}` is listed twice"));
                }
                Some(_) => {}
            }
            self.word(code, entry, word);
        }
        let combined = entry.one_of.iter().chain(&entry.not_together).flatten();
        for letter in combined.flat_map(|item| item.bytes()).filter_map(Letter::new) {
            if !seen.contains(letter) && !entry.any_words {
                self.say(code, format!("combines `{letter}`, which is not among its words"));
            }
        }
    }

    fn word(&mut self, code: &str, entry: &crate::CodeEntry, word: &crate::WordEntry) {
        for letter in word.instead.iter().chain(&word.instead_here) {
            if Letter::parse(letter).is_none_or(|letter| self.control.letter(letter).is_none()) {
                self.say(code, format!("`{letter}` instead of `{}` is not an address here", word.letter));
            }
        }
        self.packed(code, word);
        for item in &word.required_with {
            if !(is_word(item) || has_word(entry, item)) || word.need != crate::Need::Conditional {
                self.say(code, format!("word `{}` cannot be required with `{item}`", word.letter));
            }
        }
        for beside in &word.beside {
            let bounds = [beside.min, beside.max, beside.above].into_iter().flatten().count();
            if !beside.with.iter().all(|item| is_word(item)) || beside.with.is_empty() {
                self.say(code, format!("word `{}` is beside something that is not a word", word.letter));
            }
            if beside.refused == (bounds > 0) {
                self.say(code, format!("word `{}` is refused or has a range, one of them", word.letter));
            }
        }
        if word.need == crate::Need::Conditional && word.when.is_none() {
            self.say(code, format!("word `{}` is conditional but does not say when", word.letter));
        }
    }

    /// What a code takes beside its words: settings, comments, words about which pages differ.
    fn around(&mut self, code: &str, entry: &crate::CodeEntry) {
        for row in &entry.refused_with {
            let listed = self.control.setting(&row.setting).map(|setting| setting.values.as_slice());
            if !listed.is_some_and(|listed| row.values.iter().all(|value| listed.contains(value))) {
                self.say(code, format!("is refused with a value that setting {} does not have", row.setting));
            }
        }
        for word in &entry.disputed {
            let is_listed = entry.words.iter().any(|own| own.letter == word.letter);
            if is_listed || !self.is_letter(&word.letter) || word.why.trim().is_empty() {
                self.say(code, format!("disputes `{}`, which it lists or does not explain", word.letter));
            }
        }
        for comment in &entry.reads_comment {
            if comment.is.trim().is_empty() || !comment.with.iter().all(|item| is_word(item)) {
                self.say(code, "reads a comment, and does not say what it is, or beside which words");
            }
        }
    }

    /// Groups of digits fit into a number, and have values that fit into the group.
    fn packed(&mut self, code: &str, word: &crate::WordEntry) {
        let are_letters = word.packed_without.chars().all(|letter| self.is_letter(&letter.to_string()));
        if !are_letters || word.packed.is_empty() && !word.packed_without.is_empty() {
            self.say(
                code,
                format!("word `{}` is not packed beside something that is not an address", word.letter),
            );
        }
        let digits: u32 = word.packed.iter().map(|part| u32::from(part.digits)).sum();
        if digits > 8 || word.packed.iter().any(|part| part.digits == 0) {
            self.say(code, format!("word `{}` packs too many digits, or none", word.letter));
            return;
        }
        let fits = |part: &crate::PackedPart| {
            part.values.iter().all(|value| *value < 10_u32.pow(u32::from(part.digits)))
        };
        if !word.packed.iter().all(fits) {
            self.say(code, format!("word `{}` has a value that its digits do not hold", word.letter));
        }
    }

    /// An effect that switches a mode belongs to a code of that mode's group.
    fn effect(&mut self, entry: &crate::CodeEntry) {
        let effect =
            CodeNumber::parse(&entry.code).and_then(|n| self.control.code(n)).map(crate::Code::effect);
        let group = entry.group.as_str();
        if let Some(wanted) = effect.and_then(group_of)
            && wanted != group
        {
            self.say(&entry.code, format!("has an effect of the group `{wanted}` but is of `{group}`"));
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
        if let Some(commands) = control.system_commands() {
            self.source("commands.toml", &commands.source);
            for code in commands.jog_codes.iter().filter(|code| !is_code(control, code)) {
                self.say("commands.toml", format!("`{code}` in `jog-codes` is not a code of the control"));
            }
        }
        for (rule, _, alarm) in control.alarms_of_rules() {
            if alarm.text.trim().is_empty() {
                self.say("alarms.toml", format!("the alarm of `{rule}` has no text"));
            }
        }
        for function in control.functions() {
            self.source(&function.name, &function.source);
        }
        if control.limits().m_codes_per_block.is_some() && control.limits().m_codes_confidence.is_none() {
            self.say("limits", "`m-codes-per-block` needs `m-codes-confidence`");
        }
        for code in &control.limits().never_aliased {
            if CodeNumber::parse(code).is_none() {
                self.say("limits", format!("`{code}` in `never-aliased` is not a code"));
            }
        }
        if let Some(switch) = &control.limits().rapid_override {
            self.source("rapid-override", &switch.source);
            if !switch.positions.is_sorted() || switch.positions.last() != Some(&100.0) {
                self.say("rapid-override", "positions do not rise to 100 percent");
            }
        }
        if let Some(switch) = &control.limits().feed_override {
            self.source("feed-override", &switch.source);
            if !(switch.step > 0.0 && switch.takes(switch.max) && switch.takes(100.0)) {
                self.say("feed-override", "steps do not lead to the highest position and to 100 percent");
            }
        }
        if control.numbers().max_digits.is_some() && control.numbers().max_digits_confidence.is_none() {
            self.say("numbers", "`max-digits` needs `max-digits-confidence`");
        }
        debug_assert!(Confidence::Assumed < Confidence::Manual, "severity relies on this order");
    }

    /// An address of the control.
    fn is_letter(&self, text: &str) -> bool {
        Letter::parse(text).is_some_and(|letter| self.control.letter(letter).is_some())
    }

    /// How the control moves axes: sources that exist, and figures that a planner can work with.
    fn motion(&mut self) {
        const PLACE: &str = "motion";
        let control = self.control;
        let motion = control.motion();
        self.source(PLACE, &motion.source);
        for part in motion.source.split(';').map(str::trim) {
            let known = control.references().iter().any(|r| part.starts_with(r.id.as_str()));
            if !known && !part.starts_with("general knowledge") {
                self.say(PLACE, format!("the source `{part}` is not among the references of the control"));
            }
        }
        if motion.look_ahead == 0 {
            self.say(PLACE, "a control knows at least the stretch that it runs");
        }
        let mut within = |name: &str, value: f64, range: std::ops::RangeInclusive<f64>| {
            if !range.contains(&value) {
                let (least, most) = (range.start(), range.end());
                self.say(PLACE, format!("`{name}` is {value}, not from {least} to {most}"));
            }
        };
        within("even-below", motion.even_below, 0.0..=1.0);
        within("shortest", motion.shortest, 0.0..=1.0);
        within("halt-time", motion.halt_time, 0.0..=1.0);
        for corners in [Some(&motion.corners), motion.contour.as_ref()].into_iter().flatten() {
            match corners {
                CornerRules::Rounded {
                    tolerance,
                    part_of_length,
                    sharpest_between_arcs,
                    across,
                    along,
                    unrounded,
                    cycle,
                    least_cycles,
                    ..
                } => {
                    within("tolerance", tolerance.unwrap_or(1.0), 1e-4..=100.0);
                    within("part-of-length", *part_of_length, 0.0..=0.5);
                    within("sharpest-between-arcs", sharpest_between_arcs.unwrap_or(180.0), 0.0..=180.0);
                    within("across", *across, 0.01..=1.0);
                    within("along", *along, 0.01..=1.0);
                    within("unrounded", *unrounded, 0.0..=0.9);
                    within("cycle", *cycle, 1e-5..=0.1);
                    within("least-cycles", *least_cycles, 0.0..=100.0);
                }
                CornerRules::Slowed { change } => within("change", *change, 1.0..=1e5),
                CornerRules::Filtered {} => {}
            }
        }
        let setting = |corners: &CornerRules| match corners {
            CornerRules::Rounded { tolerance_setting, .. } => tolerance_setting.clone(),
            CornerRules::Slowed { .. } | CornerRules::Filtered {} => None,
        };
        if let Some(number) = setting(&motion.corners)
            && control.setting(&number).is_none()
        {
            self.say(PLACE, format!("the setting `{number}` is not one of the control"));
        }
    }

    fn semantics(&mut self) {
        const PLACE: &str = "semantics";
        let control = self.control;
        let semantics = control.semantics();
        self.source(PLACE, &semantics.source);
        for part in semantics.source.split(';').map(str::trim) {
            let known = control.references().iter().any(|r| part.starts_with(r.id.as_str()));
            if !known && !part.starts_with("general knowledge") {
                self.say(PLACE, format!("the source `{part}` is not a reference of the control"));
            }
        }
        for code in &semantics.millimetre_distances {
            if CodeNumber::parse(code).is_none_or(|n| control.code(n).is_none()) {
                self.say(PLACE, format!("`{code}`, whose words are millimetres, is not a code here"));
            }
        }
        for code in semantics.at_end.iter().chain(&semantics.at_start) {
            if CodeNumber::parse(code).is_none_or(|n| control.code(n).is_none()) {
                self.say(PLACE, format!("`{code}` at the start or end is not a code here"));
            }
        }
        self.refusals();
        self.bar_feeder();
        self.arguments();
        self.addresses();
        let named = semantics.compensation.setting.iter().chain(&semantics.arcs.straight_setting);
        for setting in named.chain(&semantics.helix.setting) {
            if control.setting(setting).is_none() {
                self.say(PLACE, format!("the setting `{setting}` does not exist here"));
            }
        }
        if semantics.loop_depth == Some(0) {
            self.say(PLACE, "`loop-depth` 0 allows no loop");
        }
        self.lengths();
    }

    /// What calls hand over: local variables, and the addresses that fill them.
    fn arguments(&mut self) {
        const PLACE: &str = "semantics";
        let control = self.control;
        let semantics = control.semantics();
        let [first, last] = semantics.locals;
        for number in [first, last] {
            let is_local =
                matches!(control.variable(number), Variable::Known(v) if v.kind == VariableKind::Local);
            if first <= last && !is_local {
                self.say(PLACE, format!("#{number} is not a local variable"));
            }
        }
        for (letter, number) in &semantics.argument_letters {
            if Letter::parse(letter).is_none() {
                self.say(PLACE, format!("the argument `{letter}` is not an address"));
            }
            if !(first..=last).contains(&u32::from(*number)) {
                self.say(PLACE, format!("the argument `{letter}` fills #{number}, which is not local"));
            }
        }
    }

    /// Addresses and axes that the semantics give a meaning of their own.
    fn addresses(&mut self) {
        const PLACE: &str = "semantics";
        let control = self.control;
        let semantics = control.semantics();
        let cycles = &semantics.cycles;
        for letter in semantics.call_repeats.iter().chain([&cycles.repeat]) {
            if !self.is_letter(letter.encode_utf8(&mut [0; 4])) {
                self.say(PLACE, format!("`{letter}` counts repeats but is not an address here"));
            }
        }
        for letter in semantics.dwell.keys().chain(semantics.increments.keys()) {
            if !self.is_letter(letter) {
                self.say(PLACE, format!("`{letter}` is not an address here"));
            }
        }
        for name in &cycles.across {
            let code = CodeNumber::parse(name).and_then(|number| control.code(number));
            if !code.is_some_and(|code| code.entry().motion == Motion::Cycle) {
                self.say(PLACE, format!("`{name}` drills across, but is not a canned cycle here"));
            }
        }
        if let Some(rules) = &semantics.polar_interpolation {
            for axis in [rules.rotary, rules.second] {
                if Letter::parse(&axis.to_string()).is_none_or(|axis| !control.axes().contains(axis)) {
                    self.say(PLACE, format!("polar interpolation moves `{axis}`, which is not an axis here"));
                }
            }
        }
        for (letter, axis) in &semantics.increments {
            if letter == axis || Letter::parse(axis).is_none_or(|axis| !control.axes().contains(axis)) {
                self.say(
                    PLACE,
                    format!("`{letter}` is an increment of `{axis}`, which is not another axis here"),
                );
            }
        }
    }

    /// Refusals speak of words that their codes read, and of addresses that the control has.
    /// Each word that may come from an earlier block has a row that says from which, and each row has such words.
    fn lasting(&mut self) {
        const PLACE: &str = "lasting";
        let control = self.control;
        for row in control.lasting() {
            self.source(PLACE, &row.source);
            if row.groups.iter().all(|group| control.group_by_id(group).is_none()) {
                self.say(PLACE, format!("`{}` is for no group of the control", row.letters));
            }
        }
        for code in control.codes() {
            let entry = code.entry();
            for word in entry.words.iter().filter(|word| word.need == crate::Need::Modal) {
                let letter = Letter::parse(&word.letter);
                if letter.is_none_or(|letter| control.lasting_in(letter, &entry.group).is_none()) {
                    self.say(
                        &entry.code,
                        format!("no row of `lasting` has `{}` for `{}`", word.letter, entry.group),
                    );
                }
            }
        }
    }

    fn refusals(&mut self) {
        const PLACE: &str = "semantics.refusals";
        let control = self.control;
        let refusals = &control.semantics().refusals;
        for (code, letters) in
            refusals.late_words.iter().chain(&refusals.late_values).chain(&refusals.newer_words)
        {
            let entry = CodeNumber::parse(code).and_then(|n| control.code(n)).map(crate::Code::entry);
            for letter in letters.chars() {
                let letter = letter.to_string();
                let is_word = |word: &crate::WordEntry| word.letter == letter;
                let speaks = |entry: &crate::CodeEntry| {
                    entry.words.iter().any(is_word) || entry.forbidden.contains(&letter)
                };
                if entry.is_none_or(|entry| !speaks(entry)) {
                    self.say(PLACE, format!("`{letter}` is not a word of a code `{code}` here"));
                }
            }
        }
        for code in &refusals.first_only {
            if CodeNumber::parse(code).is_none_or(|n| control.code(n).is_none()) {
                self.say(PLACE, format!("`{code}` is not a code here"));
            }
        }
        for (letter, others) in &refusals.beside {
            for letter in std::iter::once(letter.clone()).chain(others.chars().map(String::from)) {
                if !self.is_letter(&letter) {
                    self.say(PLACE, format!("`{letter}` is not an address here"));
                }
            }
        }
        for axis in refusals.axes.iter().flat_map(|axes| axes.chars()) {
            if Letter::parse(&axis.to_string()).is_none_or(|axis| !control.axes().contains(axis)) {
                self.say(PLACE, format!("`{axis}` is not an axis here"));
            }
        }
    }

    /// Tolerances and clearances, in millimetres: none so large that it would be a mistake of units.
    fn lengths(&mut self) {
        let semantics = self.control.semantics();
        let arcs = &semantics.arcs;
        let cycles = &semantics.cycles;
        for (name, value, range) in [
            ("equal-within", semantics.equal_within, 0.0..=1e-3),
            ("radius-difference", arcs.radius_difference, 0.0..=1.0),
            ("relative", arcs.relative, 0.0..=0.1),
            ("hard-factor", arcs.hard_factor, 1.0..=1e4),
            ("radius-slack", arcs.radius_slack, 0.0..=1.0),
            ("zero-radius", arcs.zero_radius, 0.0..=0.1),
            ("peck-clearance", cycles.peck_clearance, 0.0..=10.0),
            ("chip-break-retract", cycles.chip_break_retract, 0.0..=10.0),
        ] {
            if !range.contains(&value) {
                let (least, most) = range.into_inner();
                self.say("semantics", format!("`{name}` is {value}, not from {least} to {most}"));
            }
        }
    }

    /// Every variable of a bar feeder is one of the control's own.
    fn bar_feeder(&mut self) {
        let control = self.control;
        for number in control.semantics().bar_feeder.iter().flat_map(BarFeederRules::variables) {
            let is_own = matches!(control.variable(number), Variable::Known(entry)
                if matches!(entry.kind, VariableKind::System | VariableKind::Retained));
            if !is_own {
                self.say("semantics.bar-feeder", format!("#{number} is not a variable of the control's own"));
            }
        }
    }

    fn system_variables(&mut self) {
        let control = self.control;
        let variables = &control.semantics().system_variables;
        let mut seen = std::collections::HashSet::new();
        for variable in variables {
            let place = match (variable.first, &variable.name) {
                (Some(first), None) => format!("system variable #{first}"),
                (None, Some(name)) => format!("system variable #<{name}>"),
                _ => {
                    self.say("system-variables", format!("{variable:?} needs a number or a name"));
                    continue;
                }
            };
            if let Some(name) = &variable.name {
                let known = control.named_parameter(name).is_some_and(|v| v.kind == VariableKind::System);
                if !known || variable.count != 1 || variable.rows != 1 {
                    self.say(&place, "is not a predefined parameter, or more than one");
                }
                if !seen.insert(name.clone()) {
                    self.say(&place, "is listed twice");
                }
            }
            if variable.rows > 1 && variable.stride < variable.count {
                self.say(&place, "has rows that overlap");
            }
            for number in numbers(variable) {
                let kind = match control.variable(number) {
                    Variable::Known(entry) => Some(entry.kind),
                    Variable::Unlisted => None,
                };
                if !matches!(kind, Some(VariableKind::System | VariableKind::Retained)) {
                    self.say(&place, format!("#{number} is not a variable of the control's own"));
                    break;
                }
                if !seen.insert(number.to_string()) {
                    self.say(&place, format!("#{number} is listed twice"));
                    break;
                }
            }
            self.argument(&place, variable);
        }
    }

    /// What `holds` needs is there, and nothing else.
    fn argument(&mut self, place: &str, variable: &SystemVariable) {
        use SystemValue as V;
        let of = variable.of.as_deref();
        let by_axis = |text: &str| {
            u32::try_from(text.len()) == Ok(variable.count)
                && text
                    .bytes()
                    .all(|b| Letter::new(b).is_some_and(|letter| self.control.axes().contains(letter)))
        };
        let is_first = |text: &str| text.parse::<u16>().is_ok_and(|number| number > 0);
        let right = match variable.holds {
            V::ModalCode => of.is_some_and(|group| self.control.group_by_id(group).is_some()),
            V::LastWord => of.is_some_and(|letter| self.is_letter(letter)),
            V::WorkOffset
            | V::WorkRotation
            | V::ToolLength
            | V::ToolDiameter
            | V::ToolRadius
            | V::ToolLengthWear
            | V::ToolDiameterWear => of.is_none_or(is_first),
            V::WorkPosition
            | V::EndPosition
            | V::MachinePosition
            | V::ProbePosition
            | V::LengthOffset
            | V::Shift
            | V::Reference1
            | V::Reference2 => of.is_none_or(by_axis),
            V::CodeActive => {
                let code = of.and_then(CodeNumber::parse);
                code.is_some_and(|number| self.control.code(number).is_some())
            }
            V::Constant => of.is_some_and(|text| text.parse::<f64>().is_ok()),
            _ => of.is_none(),
        };
        if !right {
            self.say(place, format!("`of` is {of:?}, which does not fit what it holds"));
        }
    }
}

/// All numbers of a system variable: columns of rows.
fn numbers(variable: &SystemVariable) -> impl Iterator<Item = u32> {
    let (first, stride, count) = (variable.first, variable.stride, variable.count);
    let rows = if first.is_some() { variable.rows } else { 0 };
    (0..rows).flat_map(move |row| {
        let start = first.unwrap_or(0).saturating_add(row.saturating_mul(stride));
        (0..count).map(move |column| start.saturating_add(column))
    })
}

/// The modal group whose codes have an effect, where all controls agree on it.
fn group_of(effect: Effect) -> Option<&'static str> {
    use Effect as E;
    Some(match effect {
        E::PlaneXy | E::PlaneZx | E::PlaneYz | E::PlaneSecondary => "plane",
        E::Absolute | E::Incremental => "distance",
        E::ArcCentreAbsolute | E::ArcCentreIncremental => "arc-distance",
        E::FeedInverseTime | E::FeedPerMinute | E::FeedPerRevolution => "feed-mode",
        E::Inch | E::Millimetre => "units",
        E::DiameterOn | E::DiameterOff => "diameter-mode",
        E::CompensationOff
        | E::CompensationLeft
        | E::CompensationRight
        | E::CompensationLeftByDiameter
        | E::CompensationRightByDiameter
        | E::CompensationVector => "cutter-compensation",
        E::LengthOff
        | E::LengthPlus
        | E::LengthMinus
        | E::LengthFromBlock
        | E::LengthAdd
        | E::LengthFiveAxis
        | E::ToolCentrePoint => "tool-length",
        E::ReturnToInitial | E::ReturnToR => "return-level",
        E::WorkOffset(_) | E::WorkOffsetByP(_) => "work-offset",
        E::ExactPath | E::ExactStop | E::PathBlending => "path-control",
        E::SurfaceSpeed | E::ConstantSpeed => "spindle-mode",
        E::ScalingOn | E::ScalingOff => "scaling",
        E::RotationOn | E::RotationOff => "rotation",
        E::MirrorOn | E::MirrorOff => "mirror",
        E::PolarOn | E::PolarOff => "polar",
        E::PolarInterpolationOn | E::PolarInterpolationOff => "polar-interpolation",
        E::CylinderMapping => "cylindrical",
        E::DynamicOffsetOn | E::DynamicOffsetOff => "dynamic-offset",
        E::MacroModal | E::MacroModalOff => "macro-call",
        E::CycleCancel => "canned-cycle",
        _ => return None,
    })
}

/// Does a code list the address among its words?
fn has_word(entry: &crate::CodeEntry, letter: &str) -> bool {
    entry.words.iter().any(|word| word.letter == letter) && Letter::parse(letter).is_some()
}

/// A word with a whole value, as data writes it: `H0`.
fn is_word(item: &str) -> bool {
    let (letter, value) = item.split_at_checked(1).unwrap_or_default();
    Letter::parse(letter).is_some() && !value.is_empty() && value.bytes().all(|b| b.is_ascii_digit())
}

fn is_code(control: &Control, written: &str) -> bool {
    CodeNumber::parse(written).is_some_and(|number| control.code(number).is_some())
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};
    use std::fs;
    use std::path::{Path, PathBuf};

    use crate::execution::ExecutionFile;
    use crate::schema::ControlFile;
    use crate::{CodeNumber, Effect, Motion};

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

    #[test]
    fn a_source_of_another_control_is_refused() {
        let control = crate::load("fluidnc").unwrap();
        let said = |source: &str| {
            let mut found = super::Problems { control: &control, list: Vec::new() };
            found.source("M62", source);
            found.list
        };
        assert_eq!(said("FNC-GCODE; FNC-ERRORS; seen in real programs"), [] as [&str; 0]);
        assert_eq!(
            said("FNC-GCODE; GHAL-ERRORS p. 4"),
            ["fluidnc: M62: the source `GHAL-ERRORS` is of another control"]
        );
    }

    /// Groups whose codes all do something that the engine follows, or explicitly do nothing (`"none"`).
    const FOLLOWED: &[&str] = &[
        "motion",
        "canned-cycle",
        "plane",
        "distance",
        "arc-distance",
        "feed-mode",
        "units",
        "diameter-mode",
        "cutter-compensation",
        "tool-length",
        "return-level",
        "work-offset",
        "path-control",
        "spindle-mode",
        "scaling",
        "rotation",
        "mirror",
        "polar",
        "polar-interpolation",
        "cylindrical",
        "dynamic-offset",
        "macro-call",
        "offset-clear",
    ];

    fn folder(name: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(name)
    }

    /// What the files of a control and its bases state, `"none"` included: a loaded control no longer tells it from silence.
    fn stated_effects(name: &str) -> BTreeMap<String, Effect> {
        let mut stated = BTreeMap::new();
        let mut next = Some(name.to_owned());
        while let Some(name) = next {
            let text = fs::read_to_string(folder(&name).join("execution.toml")).unwrap_or_default();
            let file: ExecutionFile = toml::from_str(&text).unwrap();
            for (code, effect) in file.effects {
                stated.entry(code).or_insert(effect);
            }
            let head = fs::read_to_string(folder(&name).join("control.toml")).unwrap();
            next = toml::from_str::<ControlFile>(&head).unwrap().base;
        }
        stated
    }

    #[test]
    fn every_effect_is_that_of_a_code() {
        let mut wrong = BTreeSet::new();
        for name in crate::names() {
            let control = crate::load(name).unwrap();
            for code in stated_effects(name).keys() {
                let found = CodeNumber::parse(code).and_then(|number| control.code(number));
                if found.is_none_or(|found| found.entry().code != *code) {
                    wrong.insert(format!("{name}: `{code}` is not a code, or not written as the code is"));
                }
            }
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }

    #[test]
    fn every_code_of_a_group_that_the_engine_follows_states_its_effect() {
        let mut silent = BTreeSet::new();
        for name in crate::names() {
            let control = crate::load(name).unwrap();
            let stated = stated_effects(name);
            for code in control.codes() {
                let entry = code.entry();
                if FOLLOWED.contains(&code.group().id.as_str()) && !stated.contains_key(&entry.code) {
                    silent.insert(format!("{name}: {} ({})", entry.code, code.group().id));
                }
            }
        }
        assert!(silent.is_empty(), "{silent:#?}");
    }

    /// A move that the engine would not make leaves it at the wrong place without a word: the list is short and known.
    #[test]
    fn codes_that_move_but_are_not_followed_are_known() {
        let mut found = BTreeSet::new();
        for name in crate::names() {
            for code in crate::load(name).unwrap().codes() {
                if code.motion() != Motion::None && code.effect() == Effect::None {
                    found.insert(code.entry().code.clone());
                }
            }
        }
        // Broaching, involutes, a sleep of hours.
        let found: Vec<_> = found.iter().map(String::as_str).collect();
        assert_eq!(found, ["G156", "G2.2", "G3.2", "M95"]);
    }

    /// Stops, ends and calls decide what runs at all.
    #[test]
    fn codes_that_end_something_have_the_effect() {
        for name in crate::names() {
            for code in crate::load(name).unwrap().codes() {
                let wanted = match code.entry().ends {
                    Some(crate::Ends::Program) => Effect::ProgramEnd,
                    Some(crate::Ends::Subprogram) => Effect::Return,
                    None => continue,
                };
                // Some ends exchange pallets on the way.
                let effect = match code.effect() {
                    Effect::ProgramEndWithPallet => Effect::ProgramEnd,
                    effect => effect,
                };
                assert_eq!(effect, wanted, "{name}: {}", code.entry().code);
            }
        }
    }
}
