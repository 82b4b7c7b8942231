//! A code that the control does not have.

use gcheck_controls::{Code, CodeNumber, Confidence, Effect, Letter, load, names};
use gcheck_program::{BlockFlags, Value, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Fix, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// A G or M code is not in the control's list.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block. Most often the program was posted for another control, and then
    /// codes that both controls have may differ in meaning too.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// G154 P2
    /// ```
    /// A number that cannot be a code:
    /// ```nc,reported,haas-mill
    /// G54.25
    /// ```
    /// A code of another control, for which this one has its own:
    /// ```nc,reported,haas-mill
    /// G54.1 P3
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G154 P2
    /// ```
    /// M codes on a control to which machine builders add their own; see `undeclared-m-code`.
    /// ```nc,quiet,fanuc-mill
    /// M244
    /// ```
    rule "unknown-code" in "words" {
        summary: "code that the control does not have",
        severity: Error,
        tier: Block,
        control_specific: true,
        fixable: OnRequest,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::UNKNOWN_CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if cx.block().flags.contains(BlockFlags::ERROR) || cx.words_may_be_arguments() {
        return;
    }
    for word in cx.code_words() {
        if let Value::Number(number) = word.value
            && !word.code.is_some()
            && !cx.control().may_be_of_builder(word.letter, number)
        {
            report.add(finding(cx, word));
        }
    }
}

fn finding(cx: &BlockCx<'_>, word: &Word) -> Finding {
    let text = cx.text(word);
    let list = cx.control().code_list();
    let is_g = word.letter == Letter::of('G');
    let number = word
        .number()
        .filter(|_| word.shape.decimals < 2)
        .and_then(|n| CodeNumber::from_value(word.letter.ascii(), n));
    let finding = Finding::new(&META, cx.range(word), format!("unknown code `{text}`"));
    let Some(number) = number else {
        return finding
            .label("no control has a code of this form")
            .alarm(word.number().and_then(|n| cx.alarm_of(META.id, &format!("{}{n}", word.letter))))
            .note("a code is a number from 0, with one decimal at most")
            .help("correct the number");
    };
    let control = cx.control();
    let finding = finding
        .alarm(cx.alarm_of(META.id, &number.to_string()))
        .note(format!("{} has no `{number}`  [{}]", control.title(), list.source))
        .at_most(limit(if is_g { list.g_codes } else { list.m_codes }));
    let finding = if cx.environment.control_is_chosen() {
        finding
    } else {
        finding
            .assuming(format!("the program is written for {}", control.title()))
            .at_most(limit(Confidence::Assumed))
    };
    let elsewhere = elsewhere(cx, number);
    let finding = finding.fix_if(instead(cx, word, &elsewhere));
    let is_configured = list.configured_m_codes.is_some_and(|from| {
        word.letter == Letter::of('M') && word.number().is_some_and(|number| number >= f64::from(from))
    });
    if is_configured {
        return finding
            .label("only the configuration of the machine gives it a meaning")
            .help(format!("declare `{number}` under `[codes]` if the machine has it"))
            .at_most(Severity::Info);
    }
    if list.depends_on_setting(number) {
        let finding = finding
            .label("not in the set of codes that is assumed")
            .note("another setting of the control chooses a set of codes that has it")
            .help("check which set of codes the machine is set to, and choose its control")
            .at_most(Severity::Info);
        return match elsewhere.iter().find(|other| other.is_set && other.same_kind) {
            Some(other) => finding.note(format!("on {}: {}", other.title, other.meaning)),
            None => finding,
        };
    }
    match elsewhere.first() {
        Some(other) => finding
            .label(format!("on {}: {}", other.title, other.meaning))
            .help("use the equivalent of this control, or choose the control that the program is written for")
            .note(format!("if it is a code of your shop, declare it under `[codes]`: `{number}`")),
        None => finding.label("no such code").help(format!(
            "correct the code, or declare `{number}` under `[codes]` if it is a code of your shop"
        )),
    }
}

/// The one code that was meant: what does here what the code does on another control of the same kind of machine, else the only
/// code that a slip of the finger leads to.
fn instead(cx: &BlockCx<'_>, word: &Word, elsewhere: &[Elsewhere]) -> Option<Fix> {
    let control = cx.control();
    let code = match elsewhere.first() {
        Some(other) => {
            let is_same = |code: &Code<'_>| {
                other.same_kind && code.effect() == other.effect && code.effect() != Effect::None
            };
            let mut same = control.codes().filter(is_same);
            same.next().filter(|_| same.next().is_none())?
        }
        None => {
            let digits = cx.text(word).get(1..)?;
            let mut meant = slips(digits)
                .into_iter()
                .filter_map(|digits| digits.parse().ok())
                .filter_map(|number| CodeNumber::from_value(word.letter.ascii(), number))
                .collect::<Vec<CodeNumber>>();
            meant.sort_unstable();
            meant.dedup();
            let mut known = meant.into_iter().filter_map(|number| control.code(number));
            known.next().filter(|_| known.next().is_none())?
        }
    };
    let name = code.entry().code.clone();
    Some(Fix::risky(format!("write `{name}` ({})", code.entry().title), cx.range(word), name))
}

/// What may have been meant by digits: without one of two that are alike, with two in the other order, without a point.
fn slips(digits: &str) -> Vec<String> {
    let all: Vec<char> = digits.chars().collect();
    let mut slips = Vec::new();
    for (ix, pair) in all.windows(2).enumerate() {
        let [a, b] = pair else { continue };
        let mut other = all.clone();
        if a == b {
            other.remove(ix);
            slips.push(other.into_iter().collect());
        } else if *a != '.' && *b != '.' {
            other.swap(ix, ix + 1);
            slips.push(other.into_iter().collect());
        }
    }
    if digits.contains('.') {
        slips.push(digits.replace('.', ""));
    }
    slips
}

/// A control that is known to have the code.
struct Elsewhere {
    title: String,
    /// What the code is there.
    meaning: String,
    /// What it does there.
    effect: Effect,
    /// Both are mills, or both lathes.
    same_kind: bool,
    /// Its codes are one of several sets, which a setting chooses.
    is_set: bool,
}

/// Controls that are known to have the code, those of the same kind of machine first: they are better hints.
fn elsewhere(cx: &BlockCx<'_>, number: CodeNumber) -> Vec<Elsewhere> {
    let others =
        names().iter().filter(|name| **name != cx.control().name()).filter_map(|name| load(name).ok());
    let known = others.filter_map(|control| {
        let code = control.code(number)?;
        let entry = code.entry();
        (entry.confidence == Confidence::Manual).then(|| Elsewhere {
            title: control.title().to_owned(),
            meaning: entry.title.clone(),
            effect: code.effect(),
            same_kind: control.machine() == cx.control().machine(),
            is_set: !control.code_list().by_setting.is_empty(),
        })
    });
    let mut known: Vec<_> = known.collect();
    known.sort_by_key(|other| !other.same_kind);
    known
}

#[cfg(test)]
mod tests {
    use expect_test::expect;
    use gcheck_controls::{CodeNumber, UserCode};

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in, findings, only, words};

    #[test]
    fn codes_that_a_configuration_may_give() {
        check_rule(
            &RULE,
            "linuxcnc",
            "M248\nM2\n",
            &expect![[r#"
            1 | M248
              | ^^^^ info[unknown-code] unknown code `M248`
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "M77\nM2\n",
            &expect![[r#"
            1 | M77
              | ^^^ warning[unknown-code] unknown code `M77`
        "#]],
        );
    }

    #[test]
    fn each_unknown_code_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G54.25 G154 P2\nM200\nG#1 X1\n",
            &expect![[r#"
                1 | G54.25 G154 P2
                  | ^^^^^^ error[unknown-code] unknown code `G54.25`
                1 | G54.25 G154 P2
                  |        ^^^^ warning[unknown-code] unknown code `G154`
                2 | M200
                  | ^^^^ info[unknown-code] unknown code `M200`
            "#]],
        );
    }

    #[test]
    fn a_machine_may_remap_free_codes() {
        check_rule(
            &RULE,
            "linuxcnc",
            "g68.2 x5 i20\nG47 X2\n",
            &expect![[r#"
                1 | g68.2 x5 i20
                  | ^^^^^ warning[unknown-code] unknown code `g68.2`
                2 | G47 X2
                  | ^^^ warning[unknown-code] unknown code `G47`
            "#]],
        );
    }

    #[test]
    fn builders_and_macros_have_codes_of_their_own() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "M244\nG65 P9010 M99.5\nG301 X1.\n",
            &expect![[r#"
                3 | G301 X1.
                  | ^^^^ warning[unknown-code] unknown code `G301`
            "#]],
        );
    }

    #[test]
    fn another_set_of_codes_may_have_it() {
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G91 G1 X1.\n",
            &expect![[r#"
                1 | G91 G1 X1.
                  | ^^^ info[unknown-code] unknown code `G91`
            "#]],
        );
    }

    #[test]
    fn the_control_with_the_other_set_is_named() {
        let found = findings(&only(&RULE), "fanuc-lathe", "G91 G1 X1.\n", &World::default());
        expect![[r#"
            unknown code `G91`
              here: not in the set of codes that is assumed
              note: Fanuc 0i-T / 30i-T, turning centre, G code system A has no `G91`  [ABC-TABLE; general knowledge]
              note: another setting of the control chooses a set of codes that has it
              note: on Fanuc 0i-T / 30i-T, turning centre, G code system B: incremental distances
              help: check which set of codes the machine is set to, and choose its control
        "#]].assert_eq(&words(&found[0]));
    }

    #[test]
    fn the_code_that_was_meant_is_offered_where_there_is_only_one() {
        let offered = |control: &str, text: &str| {
            let found = findings(&only(&RULE), control, text, &World::default());
            found.first().and_then(|finding| Some(finding.fixes.first()?.edits[0].text.clone()))
        };
        assert_eq!(offered("haas-mill", "G54.1 P3\n").as_deref(), Some("G154"), "the same elsewhere");
        assert_eq!(offered("linuxcnc", "G433 H1\n").as_deref(), Some("G43"), "a digit twice");
        assert_eq!(offered("haas-mill", "G54.25\n"), None);
    }

    #[test]
    fn a_declared_code_is_known() {
        let user = UserCode { number: CodeNumber::g(154), title: "our offsets".to_owned(), alias: None };
        let control = gcheck_controls::load("linuxcnc").unwrap().with_user_codes(&[user]);
        assert!(control.code(CodeNumber::g(154)).unwrap().is_user());
    }

    #[test]
    fn where_nothing_speaks_for_a_control_another_one_may_have_it() {
        let guessed = World { control_is_guessed: true, ..World::default() };
        check_rule_in(
            &RULE,
            "generic-mill",
            "G91.1\n",
            &guessed,
            &expect![[r#"
            1 | G91.1
              | ^^^^^ info[unknown-code] unknown code `G91.1`
        "#]],
        );
        check_rule(
            &RULE,
            "generic-mill",
            "G91.1\n",
            &expect![[r#"
            1 | G91.1
              | ^^^^^ warning[unknown-code] unknown code `G91.1`
        "#]],
        );
        check_rule_in(
            &RULE,
            "linuxcnc",
            "G154\n",
            &guessed,
            &expect![[r#"
            1 | G154
              | ^^^^ warning[unknown-code] unknown code `G154`
        "#]],
        );
    }

    #[test]
    fn the_control_that_has_the_code_is_named() {
        let found = findings(&only(&RULE), "linuxcnc", "G154 P2\n", &World::default());
        expect![[r#"
            unknown code `G154`
              here: on Haas mill (classic control and NGC): extra work offsets P1 to P99
              note: LinuxCNC has no `G154`  [LCNC-SRC; RS274-2.9]
              note: if it is a code of your shop, declare it under `[codes]`: `G154`
              help: use the equivalent of this control, or choose the control that the program is written for
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
