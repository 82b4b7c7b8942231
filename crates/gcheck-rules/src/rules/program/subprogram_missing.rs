//! A call of a program that is not known.

use std::collections::BTreeSet;

use gcheck_controls::{Code, WordKind};
use gcheck_program::{Call, CallKind};

use crate::declare::declare_rule;
use crate::facts::program_calls::Programs;
use crate::facts::sections::target_word;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A call names a program that is neither in the file nor beside it. Reported at the first call.
    ///
    /// ## Why it matters
    /// If the program is not in the control's memory either, the control stops with an alarm at the call.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O0001
    /// M98 P2000
    /// M30
    /// O0100
    /// M99
    /// ```
    /// ## Not reported
    /// Repeats before the number, computed numbers (see `computed-subprogram-missing`), and programs from 8000 up, which
    /// machine builders and makers of probes put into the control.
    /// ```nc,quiet,fanuc-mill
    /// O0001
    /// M98 P30100
    /// G65 P9810 Z10. F1000.
    /// M98 P#1
    /// M30
    /// O0100
    /// M99
    /// ```
    /// ```nc,quiet,linuxcnc
    /// M98 P100
    /// M2
    /// O100
    /// M99
    /// ```
    rule "subprogram-missing" in "program" {
        summary: "called program is not in the file or beside it",
        severity: Warning,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    if cx.file_index.calls.is_empty() {
        return;
    }
    let programs = Programs::new(cx.environment, cx.file_index);
    let mut told: BTreeSet<u32> = BTreeSet::new();
    let places = cx.places(cx.file_index.calls.iter().filter_map(|call| match call.target {
        CallKind::Program(number) => Some((number, call.range.clone())),
        _ => None,
    }));
    for call in &cx.file_index.calls {
        let CallKind::Program(number) = call.target else { continue };
        if told.contains(&number) {
            continue;
        }
        let Some((code, word)) = target_word(cx, call.code, WordKind::Program, cx.slice(call.range.clone()))
        else {
            continue;
        };
        if let Some(missing) = programs.missing(number, word) {
            told.insert(number);
            let same = places.get(&number).map_or(&[][..], Vec::as_slice);
            report.add(cx.if_run(finding(call, code, missing), same));
        }
    }
}

fn finding(call: &Call, code: Code<'_>, number: u32) -> Finding {
    Finding::new(&META, call.range.clone(), format!("called program `O{number}` is missing"))
        .label(format!("`{}` calls `O{number}`", code.entry().code))
        .note("gcheck searched this file and the folders that it was given")
        .assuming(format!("`O{number}` may be in the memory of the control"))
        .help(format!("add the program `O{number}`, name its folder under `[search]`, or correct the number"))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, check_rule_in};

    #[test]
    fn a_file_without_subprograms_may_rely_on_the_control() {
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM98 P5000 L2\nM30\n",
            &expect![[r#"
                2 | M98 P5000 L2
                  |     ^^^^^ warning[subprogram-missing] called program `O5000` is missing
            "#]],
        );
    }

    #[test]
    fn an_outline_may_be_a_block_of_the_program() {
        let pocket = "G150 P9 X0. Y0. Z-0.5 Q0.25 R0.1 I0.2 K0.01 G41 D1 F10.\nG40 X0. Y0.\nM30\n";
        check_rule(&RULE, "haas-mill", &format!("O1\n{pocket}N9 G1 Y1.\nX1.\nM99\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &format!("O1\n{pocket}N8 G1 Y1.\nX1.\nM99\n"),
            &expect![[r#"
                2 | G150 P9 X0. Y0. Z-0.5 Q0.25 R0.1 I0.2 K0.01 G41 D1 F10.
                  |      ^^ warning[subprogram-missing] called program `O9` is missing
            "#]],
        );
    }

    #[test]
    fn each_program_is_told_once() {
        check_rule(
            &RULE,
            "haas-lathe",
            "O1\nM98 P7\nM98 P7\nM98 P90001\nM30\n",
            &expect![[r#"
                2 | M98 P7
                  |     ^^ warning[subprogram-missing] called program `O7` is missing
            "#]],
        );
    }

    #[test]
    fn repeats_in_front_are_read_only_where_the_control_reads_them() {
        check_rule(&RULE, "fanuc-mill", "O1\nM98 P50007\nM30\nO7\nM99\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            "O1\nM98 P50007\nM30\nO7\nM99\n",
            &expect![[r#"
                2 | M98 P50007
                  |     ^^^^^^ warning[subprogram-missing] called program `O50007` is missing
            "#]],
        );
    }

    #[test]
    fn programs_beside_the_file_count() {
        struct Folder;
        impl crate::Programs for Folder {
            fn has_number(&self, number: u32) -> bool {
                number == 77
            }
            fn has_name(&self, _: &str) -> bool {
                false
            }
        }
        let world = World { programs: &Folder, ..World::default() };
        check_rule_in(
            &RULE,
            "fanuc-mill",
            "M98 P77\nM98 P78\n",
            &world,
            &expect![[r#"
                2 | M98 P78
                  |     ^^^ warning[subprogram-missing] called program `O78` is missing
            "#]],
        );
    }
}
