//! Exit codes of `check`: 0 nothing at or above `--fail-on`, 1 findings, 2 the work could not be done.

use crate::shop::{BAD, GOOD, INFORMED, Shop, WARNED};

fn check_code(program: &str, arguments: &str, code: i32) {
    let shop = Shop::with(&[("part.nc", program)]);
    let run = shop.gcheck(&format!("check part.nc --control haas-mill {arguments}"));
    assert_eq!(run.code, code, "{arguments}\n{run}");
}

#[test]
fn errors_fail_unless_never_is_said() {
    check_code(GOOD, "", 0);
    check_code(BAD, "", 1);
    for severity in ["error", "warning", "info"] {
        check_code(BAD, &format!("--fail-on {severity}"), 1);
        check_code(GOOD, &format!("--fail-on {severity}"), 0);
    }
    check_code(BAD, "--fail-on never", 0);
}

#[test]
fn milder_findings_fail_from_their_severity_on() {
    check_code(WARNED, "", 0);
    check_code(WARNED, "--fail-on warning", 1);
    check_code(WARNED, "--fail-on info", 1);
    check_code(INFORMED, "--fail-on warning", 0);
    check_code(INFORMED, "--fail-on info", 1);
}

#[test]
fn too_many_warnings_fail() {
    check_code(WARNED, "--max-warnings 0", 1);
    check_code(WARNED, "--max-warnings 1", 0);
    check_code(WARNED, "--max-warnings 0 --fail-on never", 1);
    check_code(INFORMED, "--max-warnings 0", 0);
}

#[test]
fn a_finding_that_is_off_does_not_fail() {
    check_code(BAD, "--ignore unknown-code", 0);
    check_code(BAD, "--select modal", 0);
    check_code(BAD, "--config rules.unknown-code=info", 0);
    check_code(WARNED, "--config rules.missing-decimal-point=error", 1);
}

#[test]
fn problems_win_over_findings() {
    check_code(BAD, "missing.nc", 2);
    check_code(GOOD, "missing.nc --fail-on never", 2);
    check_code(GOOD, "missing.nc --show-files", 2);
}

#[test]
fn formats_do_not_change_the_code() {
    for format in ["full", "concise", "json", "sarif", "github"] {
        check_code(GOOD, &format!("--output-format {format}"), 0);
        check_code(BAD, &format!("--output-format {format}"), 1);
        check_code(BAD, &format!("--output-format {format} -o out"), 1);
    }
}

#[test]
fn help_and_version_are_no_errors() {
    let shop = Shop::new();
    for arguments in ["--help", "--version", "check --help", "help check"] {
        assert_eq!(shop.gcheck(arguments).code, 0, "{arguments}");
    }
}
