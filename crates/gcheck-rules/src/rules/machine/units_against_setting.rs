//! A unit that the control refuses because of its setting.

use gcheck_controls::Effect;
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, limit};

declare_rule! {
    /// A code chooses inches or millimetres, and the setting of the control is told to be the other unit.
    ///
    /// ## Why it matters
    /// The control checks the code against its setting and stops with an alarm.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G21
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G20
    /// ```
    /// ## How to fix it
    /// * Write the program in the unit of the setting.
    /// * Or change the setting on the control before the program runs, and in `[settings]` of `gcheck.toml`.
    rule "units-against-setting" in "machine" {
        summary: "unit that the control's setting refuses",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let Some(number) = cx.control().semantics().units_setting.as_deref() else { return };
    // A setting that is not configured is not a reason for an alarm.
    let Some((value, None)) = cx.environment.setting(number) else { return };
    for (word, code) in cx.codes() {
        let other = match code.effect() {
            Effect::Inch => "mm",
            Effect::Millimetre => "inch",
            _ => continue,
        };
        if value != other {
            continue;
        }
        let entry = code.entry();
        let finding = Finding::new(
            &META,
            cx.range(word),
            format!("the control is set to the other unit: `{}` is an alarm", cx.text(word)),
        )
        .label(entry.title.as_str())
        .note(format!(
            "setting {number} is {value}; the control checks the code against it  [{}]",
            entry.source
        ))
        .help(format!("write the program in the unit of the setting, or change setting {number}"))
        .at_most(limit(entry.confidence));
        report.add(finding);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn only_a_setting_that_is_told_counts() {
        check_rule(&RULE, "haas-mill", "G20\nG21\n", &expect![[""]]);
        let mut metric = World::default();
        metric.machine.settings.insert("9".to_owned(), "mm".to_owned());
        check_rule_in(
            &RULE,
            "haas-mill",
            "G21\nG20 G0 X1.\n",
            &metric,
            &expect![[r#"
            2 | G20 G0 X1.
              | ^^^ error[units-against-setting] the control is set to the other unit: `G20` is an alarm
        "#]],
        );
    }
}
