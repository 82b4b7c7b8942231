//! A coolant code under a setting that refuses it.

use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run, limit};

declare_rule! {
    /// A block switches coolant, and the configuration says that a setting of the machine refuses coolant codes.
    ///
    /// ## Why it matters
    /// The control stops with an alarm at the block.
    ///
    /// Without the setting in the configuration nothing is reported.
    ///
    /// ## Reported
    /// With `settings.32 = "off"`:
    /// ```nc,reported,haas-mill
    /// M8
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// M5
    /// M30
    /// ```
    /// ## How to fix it
    /// * Remove the coolant code.
    /// * Or set the setting to normal on the control and in `[settings]` of `gcheck.toml`.
    rule "coolant-locked" in "machine" {
        summary: "coolant code that a setting refuses",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::CODE, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    let semantics = cx.control().semantics();
    let Some(number) = &semantics.coolant_setting else { return };
    if cx.environment.machine.settings.get(number).is_none_or(|value| value != "off") {
        return;
    }
    for (word, code) in cx.codes() {
        if !code.effect().switches_coolant() {
            continue;
        }
        let (name, entry) = (code.number(), code.entry());
        report.add(
            Finding::new(&META, cx.range(word), format!("coolant code while coolant is locked (`{name}`)"))
                .label("the control stops here")
                .note(format!(
                    "setting {number} is off: `{name}` ({}) is refused  [{}]",
                    entry.title, semantics.source
                ))
                .help("remove the code, or set the setting to normal on the machine and in the configuration")
                .at_most(limit(entry.confidence)),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule_in};

    #[test]
    fn each_code_is_marked() {
        let mut world = World::default();
        world.machine.settings.insert("32".to_owned(), "off".to_owned());
        check_rule_in(
            &RULE,
            "haas-mill",
            "M8\nG0 X1. M88\nM9\nM30\n",
            &world,
            &expect![[r#"
            1 | M8
              | ^^ error[coolant-locked] coolant code while coolant is locked (`M8`)
            2 | G0 X1. M88
              |        ^^^ error[coolant-locked] coolant code while coolant is locked (`M88`)
            3 | M9
              | ^^ error[coolant-locked] coolant code while coolant is locked (`M9`)
        "#]],
        );
    }

    #[test]
    fn a_setting_that_passes_over_them_refuses_nothing() {
        let mut world = World::default();
        world.machine.settings.insert("32".to_owned(), "ignore".to_owned());
        check_rule_in(&RULE, "haas-mill", "M8\nM30\n", &world, &expect![[""]]);
    }
}
