//! A code that a setting of the control refuses.

use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Reads, Report, Run, Severity, limit};

declare_rule! {
    /// A code cannot be used with a setting that the configuration tells.
    ///
    /// ## Why it matters
    /// The control stops with an alarm, or the code does something else than its page says: a text is engraved at wrong
    /// places.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G47 P0 (LOT 7) X0. Y0. Z-0.01 R0.1 J0.5 F10.
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G1 X1. F10.
    /// ```
    /// ## How to fix it
    /// * Change the setting on the control before the program runs, and in `[settings]` of `gcheck.toml`.
    /// * Or take the code out of the program.
    rule "code-refused-by-setting" in "machine" {
        summary: "code that cannot be used with a setting of the control",
        severity: Warning,
        tier: Block,
        since: "0.1.0",
        run: Run::BlockAndValues { trigger: BlockFlags::CODE, reads: Reads::Codes, check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    for (word, code) in cx.codes() {
        let entry = code.entry();
        for row in &entry.refused_with {
            // A setting that is not configured is as it should be.
            let Some((value, None)) = cx.environment.setting(&row.setting) else { continue };
            if !row.values.iter().any(|own| own == value) {
                continue;
            }
            let title = cx.control().setting(&row.setting).map_or("", |setting| setting.title.as_str());
            let name = cx.text(word);
            report.add(
                Finding::new(
                    &META,
                    cx.range(word),
                    format!("`{name}` cannot be used with setting {} `{value}`", row.setting),
                )
                .label(entry.title.as_str())
                .note(format!(
                    "setting {} ({title}) is `{value}`, as configured  [{}]",
                    row.setting, entry.source
                ))
                .help(format!("change setting {} before the program runs", row.setting))
                .at_most(Severity::Warning)
                .at_most(limit(entry.confidence)),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{META, RULE};
    use crate::testing::{World, check_rule, check_rule_in};

    const ENGRAVES: &str = "G47 P0 (LOT 7) X0. Y0. Z-0.01 R0.1 J0.5 F10.\nM30\n";

    fn check_with(setting: &str, value: &str, expected: &expect_test::Expect) {
        let mut world = World::of_examples(&META);
        world.machine.settings.insert(setting.to_owned(), value.to_owned());
        check_rule_in(&RULE, "haas-mill", ENGRAVES, &world, expected);
    }

    #[test]
    fn the_value_of_the_setting_decides() {
        check_with("73", "off", &expect![[""]]);
        check_with(
            "29",
            "on",
            &expect![[r#"
            1 | G47 P0 (LOT 7) X0. Y0. Z-0.01 R0.1 J0.5 F10.
              | ^^^ warning[code-refused-by-setting] `G47` cannot be used with setting 29 `on`
            1 | G47 P0 (LOT 7) X0. Y0. Z-0.01 R0.1 J0.5 F10.
              | ^^^ warning[code-refused-by-setting] `G47` cannot be used with setting 73 `on`
        "#]],
        );
    }

    #[test]
    fn what_is_not_configured_is_not_reported() {
        check_rule(&RULE, "haas-mill", ENGRAVES, &expect![[""]]);
    }
}
