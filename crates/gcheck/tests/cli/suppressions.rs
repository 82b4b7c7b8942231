//! Comments that silence rules: the line, the line above, the file, a range; unused ones are reported.

use crate::shop::Shop;

/// The findings of a program on a Haas mill, without messages, and the exit code.
fn check_program(lines: &[&str], arguments: &str, findings: &[&str]) {
    let program = format!("%\nO0001 G90 (PART)\n{}\nM30\n%\n", lines.join("\n"));
    let shop = Shop::with(&[("part.nc", &program)]);
    let run = shop
        .gcheck(&format!("check part.nc --control haas-mill --output-format concise --quiet {arguments}"));
    let found: Vec<String> =
        run.findings().iter().map(|line| line.trim_start_matches("part.nc:").to_owned()).collect();
    assert_eq!(found, findings, "{program}\n{run}");
    assert_eq!(run.code, i32::from(findings.iter().any(|finding| finding.contains("error"))));
}

#[test]
fn on_the_line_itself() {
    check_program(
        &["G999 (gcheck: ignore unknown-code - old machine)", "G998"],
        "",
        &["4:1: error[unknown-code]"],
    );
}

#[test]
fn on_the_line_above() {
    check_program(
        &["(gcheck: ignore unknown-code - old machine)", "G999", "G998"],
        "",
        &["5:1: error[unknown-code]"],
    );
}

#[test]
fn for_the_file() {
    check_program(&["G999", "(gcheck: ignore-file unknown-code - old machine)", "G998"], "", &[]);
}

#[test]
fn from_off_to_on() {
    check_program(
        &["(gcheck: off unknown-code)", "G999", "G998", "(gcheck: on unknown-code)", "G997"],
        "--ignore suppression-without-reason",
        &["7:1: error[unknown-code]"],
    );
}

#[test]
fn for_a_group() {
    check_program(&["G999 (gcheck: ignore words - old machine)"], "", &[]);
}

#[test]
fn only_the_rule_that_is_named() {
    check_program(
        &["G999 X1 (gcheck: ignore missing-decimal-point - thousandths are meant)"],
        "--select unknown-code,missing-decimal-point",
        &["3:1: error[unknown-code]"],
    );
}

#[test]
fn an_unused_one_is_reported() {
    check_program(
        &["G0 X1. (gcheck: ignore unknown-code - old machine)"],
        "",
        &["3:8: warning[unused-suppression]"],
    );
}

#[test]
fn one_that_says_nothing_sensible_is_reported() {
    check_program(
        &["G0 X1. (gcheck: ignore unknwn-code - old machine)"],
        "",
        &["3:8: warning[malformed-suppression]"],
    );
    check_program(
        &["G0 X1. (gcheck: ignroe unknown-code - old machine)"],
        "",
        &["3:8: warning[malformed-suppression]"],
    );
}

#[test]
fn none_counts_when_they_are_off() {
    check_program(
        &["G999 (gcheck: ignore unknown-code - old machine)"],
        "--no-suppressions",
        &["3:1: error[unknown-code]"],
    );
}

#[test]
fn semicolon_comments_count_where_the_control_has_them() {
    let program = "G999 ; gcheck: ignore unknown-code - old machine\nM2\n";
    let shop = Shop::with(&[("part.ngc", program)]);
    let run = shop.gcheck("check part.ngc --control linuxcnc --select unknown-code,suppressions --output-format concise --quiet");
    assert!(run.findings().is_empty(), "{run}");
}

#[test]
fn they_are_counted() {
    let program = "%\nO0001 (PART)\nG999 (gcheck: ignore unknown-code - old machine)\nM30\n%\n";
    let shop = Shop::with(&[("part.nc", program)]);
    let run = shop.gcheck("check --control haas-mill");
    assert_eq!(run.stdout, "no findings in 1 file (5 lines); 1 suppressed\n");
    assert_eq!(
        shop.gcheck("check --control haas-mill --output-format json").json()["summary"]["suppressed"],
        1
    );
}
