//! A bar feed: where its lengths come from, and how they are named.
//!
//! Knows: the words of the feed and the variables that replace them. Must not know: any rule.

use std::ops::Range;

use crate::PathCx;
use crate::facts::units;
use crate::{Finding, Severity};
use gcheck_controls::{BarFeederRules, Effect, Letter};
use gcheck_engine::{BarLengths, Event, Role};
use gcheck_geometry::Mm;

/// A length that a bar is fed by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Length {
    /// A part with its cutoff.
    Part,
    /// The push of a new bar.
    Initial,
    /// What must stay clamped.
    Clamping,
}

/// Where a length comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Given {
    /// A word of the block.
    Word,
    /// Its variable, which the program set or the user configured.
    Variable,
    /// The control's own page, which is not configured.
    Nowhere,
}

impl Length {
    pub(crate) const ALL: [Self; 3] = [Self::Part, Self::Initial, Self::Clamping];

    pub(crate) const fn letter(self) -> char {
        match self {
            Self::Part => 'J',
            Self::Initial => 'I',
            Self::Clamping => 'K',
        }
    }

    pub(crate) const fn words(self) -> &'static str {
        match self {
            Self::Part => "part length",
            Self::Initial => "initial push",
            Self::Clamping => "clamping length",
        }
    }

    pub(crate) const fn variable(self, rules: &BarFeederRules) -> u32 {
        match self {
            Self::Part => rules.part,
            Self::Initial => rules.initial_push,
            Self::Clamping => rules.clamping,
        }
    }

    /// As the feed has it; NaN unknown.
    pub(crate) const fn of(self, lengths: &BarLengths) -> Mm {
        match self {
            Self::Part => lengths.part,
            Self::Initial => lengths.initial,
            Self::Clamping => lengths.clamping,
        }
    }
}

/// Does the code feed the bar?
pub(crate) const fn is_bar_feed(effect: Effect) -> bool {
    matches!(effect, Effect::BarFeed)
}

/// The variables of the control's bar feeder, for rules about programs that use one. In all others the rule stops watching.
pub(crate) fn bar_feeder<'a>(cx: &PathCx<'a>) -> Option<&'a BarFeederRules> {
    let rules = cx.model.semantics().bar_feeder.as_ref();
    if rules.is_none() || !cx.file_may_use(is_bar_feed) {
        cx.enough();
        return None;
    }
    rules
}

/// Where a length of this bar feed comes from.
pub(crate) fn given(cx: &PathCx<'_>, length: Length, rules: &BarFeederRules) -> Given {
    if cx.origin().letters.contains(Letter::of(length.letter())) {
        Given::Word
    } else if cx.state().variables().is_written(length.variable(rules)) {
        Given::Variable
    } else {
        Given::Nowhere
    }
}

/// Bytes of the word that gives a length, else of the feed's code.
pub(crate) fn length_range(cx: &PathCx<'_>, length: Length) -> Range<u32> {
    if cx.origin().letters.contains(Letter::of(length.letter())) {
        cx.letter_range(length.letter())
    } else {
        bar_feed_range(cx)
    }
}

/// Bytes of the feed's code.
pub(crate) fn bar_feed_range(cx: &PathCx<'_>) -> Range<u32> {
    cx.effect_range(is_bar_feed)
}

/// The feed's code as programs write it.
pub(crate) fn bar_feed_name(cx: &PathCx<'_>) -> String {
    cx.name_of_effect(Effect::BarFeed).unwrap_or_default()
}

/// The finding no more severe than the units that the block's lengths are read in.
pub(crate) fn resting_on_units(cx: &PathCx<'_>, finding: Finding) -> Finding {
    if units::are_stated(cx) {
        return finding;
    }
    let code = cx.code_name(Role::Units).map_or_else(String::new, |code| format!(" (`{code}`)"));
    finding
        .at_most(Severity::Warning)
        .assuming(format!("the units{code} are as the control has them at the start"))
}

/// The lengths of the feed that an event begins.
pub(crate) const fn lengths(event: &Event) -> Option<&BarLengths> {
    if let Event::BarFeed(lengths) = event { Some(lengths) } else { None }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use expect_test::expect;
    use gcheck_geometry::Mm;

    use crate::Severity;
    use crate::testing::{World, findings, recommended};

    /// Findings of every rule on a bar job with this feed, in one line.
    fn found(feed: &str, world: &World<'_>) -> Vec<(Severity, &'static str)> {
        let program = format!("%\nO1\nG21 G18 G40 G80 G99\n{feed}\nM30\n%\n");
        let found = findings(&recommended(), "haas-lathe", &program, world);
        found.iter().map(|one| (one.severity, one.rule.id)).collect()
    }

    fn world() -> World<'static> {
        let mut world = World::default();
        world.machine.engine.bar.new_bar = Some(Mm(1000.0));
        world
    }

    /// Every word missing, doubled, negative, zero, huge, no number, unknown.
    #[test]
    fn bad_input() {
        let whole = [("I", "30."), ("J", "25."), ("K", "60."), ("Q", "0"), ("R", "90.")];
        let mut shown = String::new();
        for (letter, usual) in whole {
            for value in ["", "twice", "-1.", "0", "99999.", "1.2.3", "X", "#500", "[1/0]"] {
                let mut feed = "G105".to_owned();
                for (other, usual) in whole.iter().filter(|(other, _)| *other != letter) {
                    let _ = write!(feed, " {other}{usual}");
                }
                match value {
                    "" => {}
                    "twice" => {
                        let _ = write!(feed, " {letter}{usual} {letter}{usual}");
                    }
                    "X" => {
                        let _ = write!(feed, " {letter}");
                    }
                    value => {
                        let _ = write!(feed, " {letter}{value}");
                    }
                }
                let found: Vec<String> = found(&feed, &world())
                    .iter()
                    .map(|(severity, id)| format!("{}[{id}]", severity.name()))
                    .collect();
                let case = if value.is_empty() { "missing" } else { value };
                let found = if found.is_empty() { "nothing".to_owned() } else { found.join(" ") };
                let _ = writeln!(shown, "{letter} {case}: {found}");
            }
        }
        expect![[r#"
            I missing: info[bar-length-missing]
            I twice: warning[word-given-twice]
            I -1.: warning[number-out-of-range]
            I 0: info[bar-initial-push-zero]
            I 99999.: warning[bar-too-short-for-part]
            I 1.2.3: error[malformed-number]
            I X: error[address-without-value]
            I #500: nothing
            I [1/0]: error[expression-without-value]
            J missing: warning[bar-length-missing]
            J twice: warning[word-given-twice]
            J -1.: warning[number-out-of-range]
            J 0: warning[number-out-of-range]
            J 99999.: error[bar-too-short-for-part]
            J 1.2.3: error[malformed-number]
            J X: error[address-without-value]
            J #500: nothing
            J [1/0]: error[expression-without-value]
            K missing: warning[bar-length-missing]
            K twice: warning[word-given-twice]
            K -1.: warning[number-out-of-range]
            K 0: nothing
            K 99999.: error[bar-too-short-for-part]
            K 1.2.3: error[malformed-number]
            K X: error[address-without-value]
            K #500: nothing
            K [1/0]: error[expression-without-value]
            Q missing: nothing
            Q twice: warning[word-given-twice]
            Q -1.: warning[decimal-point-on-integer] warning[number-out-of-range]
            Q 0: nothing
            Q 99999.: warning[decimal-point-on-integer] warning[number-out-of-range]
            Q 1.2.3: error[malformed-number]
            Q X: error[address-without-value]
            Q #500: nothing
            Q [1/0]: error[expression-without-value]
            R missing: nothing
            R twice: warning[word-given-twice]
            R -1.: warning[number-out-of-range]
            R 0: nothing
            R 99999.: warning[number-out-of-range]
            R 1.2.3: error[malformed-number]
            R X: error[address-without-value]
            R #500: nothing
            R [1/0]: error[expression-without-value]
        "#]]
        .assert_eq(&shown);
    }

    /// An unknown value makes no finding, wherever the feed is.
    #[test]
    fn unknown_values_make_no_findings_of_this_group() {
        let feed = "G105 I#500 J#501 K#502 R#503";
        for program in [
            feed.to_owned(),
            format!("/{feed}"),
            format!("#1=0\nWHILE [#1 LT 3] DO1\n{feed}\n#1=#1+1\nEND1"),
            format!("M97 P10\nM30\nN10 {feed}\nM99"),
            format!("IF [#504 EQ 1] GOTO 5\n{feed}\nN5 {feed}"),
            "G105 I30. J25. K60. Q#500".to_owned(),
            "G105 I30. J25. K60. P#500".to_owned(),
        ] {
            let found = found(&program, &world());
            let of_group = found.iter().filter(|(_, id)| id.contains("bar-") || id.contains("cutoff"));
            assert_eq!(of_group.count(), 0, "{program}: {found:?}");
            assert!(!found.iter().any(|(severity, _)| *severity == Severity::Error), "{program}: {found:?}");
        }
    }
}
