//! A code that the control does not have.

use gcheck_controls::{CodeNumber, Confidence, Letter, load, names};
use gcheck_program::{BlockFlags, Value, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, limit};

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
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::UNKNOWN_CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if cx.block().flags.contains(BlockFlags::ERROR) || cx.words_may_be_arguments() {
        return;
    }
    let builder = cx.control().code_list().builder_m_codes;
    for word in cx.code_words() {
        let is_m = word.letter == Letter::of('M');
        if !word.code.is_some() && matches!(word.value, Value::Number(_)) && !(is_m && builder) {
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
    let finding = if cx.environment.control_is_guessed {
        finding
            .assuming(format!("the program is written for {}", control.title()))
            .at_most(limit(Confidence::Assumed))
    } else {
        finding
    };
    let elsewhere = elsewhere(cx, number);
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

/// A control that is known to have the code.
struct Elsewhere {
    title: String,
    /// What the code is there.
    meaning: String,
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
        let entry = control.code(number)?.entry();
        (entry.confidence == Confidence::Manual).then(|| Elsewhere {
            title: control.title().to_owned(),
            meaning: entry.title.clone(),
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
                  | ^^^^ warning[unknown-code] unknown code `M200`
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
