//! Modes that shift the axes by the tool: a length along a tilting tool, a cutter's size along a vector.
//!
//! Knows: which effects they are, what they exclude. Must not know: any rule.

use gcheck_controls::{Code, CodeIx, Effect};
use gcheck_engine::{At, Fact, Role};

use crate::facts::modes::{ActiveMode, forbids, in_effect};
use crate::facts::probing::is_touch;
use crate::{Finding, PathCx, RuleMeta, Severity, limit};

/// Is the length of the tool added along the tool?
pub(crate) fn is_along_tool(effect: Effect) -> bool {
    effect == Effect::LengthFiveAxis
}

/// Does the path hold for the tip of the tool, however it is tilted?
pub(crate) fn follows_the_tip(effect: Effect) -> bool {
    is_along_tool(effect) || effect == Effect::ToolCentrePoint
}

/// Is the path shifted along the vector of each block?
pub(crate) fn is_along_vectors(effect: Effect) -> bool {
    effect == Effect::CompensationVector
}

/// The codes of the two modes where a block brings them together: the length's, and that of increments.
pub(crate) fn length_and_increments(cx: &PathCx<'_>) -> Option<[ActiveMode; 2]> {
    if !cx.has_effect(|effect| is_along_tool(effect) || effect == Effect::Incremental) {
        return None;
    }
    let length = in_effect(cx, Role::Length, is_along_tool)?;
    let increments = in_effect(cx, Role::Distance, |effect| effect == Effect::Incremental)?;
    Some([length, increments])
}

/// What `length_and_increments` rules say of it.
pub(crate) fn increments_finding(
    cx: &PathCx<'_>,
    rule: &'static RuleMeta,
    message: String,
    length: Code<'_>,
    increments: Code<'_>,
) -> Finding {
    let (name, entry) = (length.number(), length.entry());
    let range = cx.effect_range(|effect| effect == Effect::Incremental);
    let range = if range == cx.range() { cx.effect_range(is_along_tool) } else { range };
    let finding = cx
        .finding(rule, range, message)
        .label(format!("`{}` cannot be used with `{name}`", increments.number()))
        .note(format!("`{name}` ({}) needs absolute words (`G90`)  [{}]", entry.title, entry.source))
        .help(format!(
            "write absolute words (`G90`), or end `{name}` with `G49` before `{}`",
            increments.number()
        ))
        .at_most(limit(entry.confidence));
    finding.at_most(cx.environment.most_for_this_control())
}

/// A mode of five axes and a code that it excludes, in one block.
pub(crate) struct Clash {
    /// The mode's role.
    pub(crate) role: Role,
    /// The mode's code.
    pub(crate) mode: ActiveMode,
    /// What it excludes.
    pub(crate) code: CodeIx,
    /// The excluded code holds on every path that comes here.
    pub(crate) is_certain: bool,
    /// No page says so: general knowledge.
    pub(crate) is_assumed: bool,
}

/// Does the program use such a mode at all?
pub(crate) fn uses_five_axis_modes(cx: &PathCx<'_>) -> bool {
    cx.file_may_use(|effect| is_along_tool(effect) || is_along_vectors(effect))
}

/// The block that switched a mode on.
pub(crate) fn switched_on_by(cx: &PathCx<'_>, mode: CodeIx) -> At {
    let here = cx.origin().at;
    if cx.codes().contains(&mode) {
        return here;
    }
    let role = cx.model.role(mode);
    role.and_then(|role| cx.definitions().set_by(Fact::Mode(role))).unwrap_or(here)
}

/// What the block brings together that does not go together.
pub(crate) fn clashes(cx: &PathCx<'_>) -> Vec<Clash> {
    let mut found = Vec::new();
    for role in [Role::Length, Role::Compensation] {
        let Some(mode) = in_effect(cx, role, |effect| is_along_tool(effect) || is_along_vectors(effect))
        else {
            if role == Role::Compensation {
                found.extend(changed_over(cx));
            }
            continue;
        };
        let (ActiveMode::Certain(ix) | ActiveMode::Possible(ix)) = mode;
        let Some(entry) = cx.control().code_at(ix) else { continue };
        let mut add = |code: CodeIx, is_certain: bool| {
            let Some(other) = cx.control().code_at(code) else { return };
            let is_assumed = is_along_tool(entry.effect()) && is_along_vectors(other.effect());
            if is_assumed || excludes(entry, other) {
                found.push(Clash { role, mode, code, is_certain, is_assumed });
            }
        };
        for code in cx.codes().iter().copied() {
            add(code, true);
        }
        if cx.codes().contains(&ix) {
            // Switched on while something else is active that the block does not end.
            for (code, is_certain) in still_active(cx, role) {
                add(code, is_certain);
            }
        }
    }
    found
}

/// Motion, cycle and compensation that stay active in the block.
fn still_active(cx: &PathCx<'_>, of: Role) -> Vec<(CodeIx, bool)> {
    let chosen = |role: Role| cx.code_of_role(role).is_some();
    let mut active = Vec::new();
    for role in [Role::Motion, Role::Cycle, Role::Compensation] {
        // A motion ends a cycle.
        if role == of || chosen(role) || role == Role::Cycle && chosen(Role::Motion) {
            continue;
        }
        let mode = cx.state().mode(role);
        match mode.only() {
            Some(code) => active.push((code, true)),
            None => active.extend(mode.alternatives().iter().map(|code| (*code, false))),
        }
    }
    active
}

/// Compensation in a plane takes the place of that along vectors without an end between.
fn changed_over(cx: &PathCx<'_>) -> Option<Clash> {
    let code = cx.codes().iter().copied().find(|code| cx.model.effect(*code).offsets_path_by_number())?;
    let mode = cx.state().mode(Role::Compensation).only()?;
    is_along_vectors(cx.model.effect(mode)).then_some(Clash {
        role: Role::Compensation,
        mode: ActiveMode::Certain(mode),
        code,
        is_certain: true,
        is_assumed: true,
    })
}

/// Does the data of a mode exclude a code? What ends a cycle is none, and increments have a rule of their own.
fn excludes(mode: Code<'_>, other: Code<'_>) -> bool {
    !matches!(other.effect(), Effect::CycleCancel | Effect::Incremental) && forbids(mode, other)
}

/// A finding about a clash; `may` comes before "under".
pub(crate) fn clash_finding(
    cx: &PathCx<'_>,
    rule: &'static RuleMeta,
    clash: &Clash,
    may: &str,
) -> Option<Finding> {
    let control = cx.control();
    let (ActiveMode::Certain(mode) | ActiveMode::Possible(mode)) = clash.mode;
    let (mode, code) = (control.code_at(mode)?, control.code_at(clash.code)?);
    let (name, other) = (mode.number(), code.number());
    let range = cx.find_word(cx.origin().at, |word| word.code == clash.code);
    let is_here = range.is_some();
    let range = range.unwrap_or_else(|| cx.word_range(|word| cx.model.role(word.code) == Some(clash.role)));
    let cancel = cx.name_of_effect(if clash.role == Role::Length {
        Effect::LengthOff
    } else {
        Effect::CompensationOff
    })?;
    let finding = cx.finding(rule, range, format!("{} (`{other}`) {may}under `{name}`", kind(code))).label(
        if is_here && Role::of(code.effect()) == Some(Role::Compensation) {
            format!("`{name}` moves the tool off its path already, and takes no second offset")
        } else if is_here {
            format!("`{name}` works with straight moves only")
        } else {
            format!("`{other}` is still active")
        },
    );
    let finding = if clash.is_assumed {
        finding
            .note(format!("no page says what becomes of `{other}` together with `{name}`"))
            .at_most(Severity::Warning)
    } else {
        finding
            .note(format!(
                "under `{name}` ({}) only `G0` and `G1` can be used  [{}]",
                mode.entry().title,
                mode.entry().source
            ))
            .at_most(limit(mode.entry().confidence))
    };
    let finding = finding.help(format!("end `{name}` with `{cancel}` before `{other}`"));
    Some(finding.at_most(cx.environment.most_for_this_control()))
}

/// What a code is, in a machinist's words.
fn kind(code: Code<'_>) -> &'static str {
    match (Role::of(code.effect()), code.effect()) {
        (_, Effect::ArcClockwise | Effect::ArcCounterClockwise) => "arc",
        (Some(Role::Cycle), _) => "canned cycle",
        (_, Effect::CompensationVector) => "3D cutter compensation",
        (Some(Role::Compensation), _) => "cutter compensation",
        (
            _,
            Effect::CircularPocketClockwise | Effect::CircularPocketCounterClockwise | Effect::GeneralPocket,
        ) => "pocket",
        (_, Effect::BoltArc | Effect::BoltCircle | Effect::BoltLine) => "hole pattern",
        (_, effect) if is_touch(effect) => "probing",
        (_, Effect::Engrave) => "engraving",
        (_, Effect::TapHere | Effect::LeftTapHere) => "tapping",
        _ => "code",
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;

    use expect_test::expect;

    use crate::Severity;
    use crate::testing::{World, findings, recommended};

    /// What is done to a word of a block, and the block afterwards.
    fn variants(block: &str, letter: char) -> Vec<(&'static str, String)> {
        let words: Vec<&str> = block.split(' ').collect();
        let changed = |with: &dyn Fn(&str) -> String| {
            let words = words
                .iter()
                .map(|word| if word.starts_with(letter) { with(word) } else { (*word).to_owned() });
            words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
        };
        vec![
            ("missing", changed(&|_| String::new())),
            ("doubled", changed(&|word| format!("{word} {word}"))),
            ("negative", changed(&|_| format!("{letter}-3."))),
            ("zero", changed(&|_| format!("{letter}0"))),
            ("huge", changed(&|_| format!("{letter}99999999."))),
            ("no number", changed(&|_| format!("{letter}abc"))),
            ("unknown", changed(&|_| format!("{letter}#500"))),
            ("computed", changed(&|_| format!("{letter}[#500*2.]"))),
        ]
    }

    /// Rules with findings in the program, with their severities, each once.
    fn said(program: &str) -> Vec<(String, Severity)> {
        let found = findings(&recommended(), "haas-mill", program, &World::default());
        let style =
            ["program-number-missing", "tape-mark-missing", "units-not-stated", "five-axis-feed-per-minute"];
        let mut said: Vec<_> = found
            .iter()
            .filter(|finding| !style.contains(&finding.rule.id))
            .map(|finding| (format!("{}[{}]", finding.severity, finding.rule.id), finding.severity))
            .collect();
        said.sort();
        said.dedup();
        said
    }

    /// Each word of a block made wrong in every way; an unknown value never makes an error, and the same rules of five
    /// axes report wherever the block is.
    fn check(before: &str, block: &str, letters: &str, after: &str, expected: &expect_test::Expect) {
        let mut shown = String::new();
        for letter in letters.chars() {
            for (how, changed) in variants(block, letter) {
                let program = format!("{before}{changed}\n{after}M30\n");
                let plain = said(&program);
                let names: Vec<&str> = plain.iter().map(|(name, _)| name.as_str()).collect();
                let _ = writeln!(shown, "{letter} {how}: {}", names.join(" "));
                if matches!(how, "unknown" | "computed") {
                    assert!(
                        plain.iter().all(|(_, severity)| *severity < Severity::Error),
                        "{letter} {how}: {names:?}"
                    );
                }
                let elsewhere = [
                    format!("{before}/{changed}\n{after}M30\n"),
                    format!("{before}M97 P70\n{after}M30\nN70 {changed}\nM99\n"),
                    format!("{before}#10=0\nWHILE [#10 LT 2] DO1\n{changed}\n#10=#10+1\nEND1\n{after}M30\n"),
                ];
                for program in elsewhere {
                    let there = said(&program);
                    let of_five_axes = |said: &[(String, Severity)]| -> Vec<String> {
                        let is_ours =
                            |name: &&String| name.contains("five-axis") || name.contains("cutter-vector");
                        said.iter().map(|(name, _)| name).filter(is_ours).cloned().collect()
                    };
                    let ours = of_five_axes(&plain);
                    assert!(
                        ours.iter().all(|name| of_five_axes(&there).contains(name)),
                        "{ours:?} / {there:?}\n{program}"
                    );
                }
            }
        }
        expected.assert_eq(&shown);
    }

    #[test]
    fn bad_words_of_a_length_along_the_tool() {
        check(
            "T1 M6\nG20 G90 G54 G94 G0 X0. Y0. Z1. A0. B0.\n",
            "G143 H1 X1. Y1. Z1. A5. B5.",
            "HXA",
            "G49\n",
            &expect![[r#"
                H missing: error[five-axis-length-without-offset]
                H doubled: warning[word-given-twice]
                H negative: error[decimal-point-on-integer] error[sign-not-accepted]
                H zero: error[five-axis-length-without-offset]
                H huge: error[decimal-point-on-integer] error[number-out-of-range]
                H no number: error[unexpected-text]
                H unknown: 
                H computed: 
                X missing: warning[five-axis-axis-left-out]
                X doubled: warning[word-given-twice]
                X negative: 
                X zero: 
                X huge: 
                X no number: error[unexpected-text]
                X unknown: 
                X computed: 
                A missing: 
                A doubled: warning[word-given-twice]
                A negative: 
                A zero: 
                A huge: 
                A no number: error[unexpected-text]
                A unknown: 
                A computed: 
            "#]],
        );
    }

    #[test]
    fn bad_words_of_a_shift_along_vectors() {
        check(
            "T1 M6\nG20 G90 G54 G94 S1000 M3\nG43 H1 Z1.\nG0 X0. Y0.\n",
            "G1 G141 D1 X1. Y1. Z1. I0. J0.6 K0.8 F20.",
            "DXIF",
            "G40\nG49\n",
            &expect![[r#"
                D missing: error[cutter-vector-without-size]
                D doubled: warning[word-given-twice]
                D negative: error[decimal-point-on-integer] error[sign-not-accepted]
                D zero: warning[cutter-vector-without-size]
                D huge: error[decimal-point-on-integer] error[number-out-of-range]
                D no number: error[unexpected-text]
                D unknown: 
                D computed: 
                X missing: 
                X doubled: warning[word-given-twice]
                X negative: 
                X zero: 
                X huge: 
                X no number: error[unexpected-text]
                X unknown: 
                X computed: 
                I missing: 
                I doubled: warning[word-given-twice]
                I negative: error[cutter-vector-not-unit]
                I zero: 
                I huge: error[cutter-vector-not-unit]
                I no number: error[unexpected-text]
                I unknown: 
                I computed: 
                F missing: error[feed-missing]
                F doubled: warning[word-given-twice]
                F negative: error[sign-not-accepted]
                F zero: error[feed-zero]
                F huge: 
                F no number: error[unexpected-text]
                F unknown: 
                F computed: 
            "#]],
        );
    }
}
