//! Baselines: what was there before is not shown, what is new is, and nobody's entries are lost.

use expect_test::expect;

use crate::shop::{BAD, GOOD, Shop, WARNED};

const CHECK: &str = "check --control haas-mill --output-format concise --baseline gcheck-baseline.json";

fn shop() -> Shop {
    Shop::with(&[("a.nc", BAD), ("jobs/b.nc", WARNED)])
}

fn update(shop: &Shop) {
    let run = shop.gcheck(&format!("{CHECK} --update-baseline"));
    assert_eq!(run.code, 0, "{run}");
}

#[test]
fn what_is_known_does_not_fail() {
    let shop = shop();
    expect![[r#"
        ! gcheck-baseline.json: 2 findings are known from now on
        ! a.nc and 1 more file: control haas-mill, set by `--control`
        ! no findings in 2 files (10 lines); 2 in the baseline
        ! the verdicts rest on 1 assumption about the machines; `--output-format json` lists them
        exit 0
    "#]]
    .assert_eq(&shop.gcheck(&format!("{CHECK} --update-baseline")).to_string());
    expect![[r#"
        {
        "version": 1,
        "findings": [
          {"file":"a.nc","rule":"unknown-code","fingerprint":"ab8772c5926a2cac732df622b945a7d0"},
          {"file":"jobs/b.nc","rule":"missing-decimal-point","fingerprint":"616b587cc226f24aab9b56253e94c3be"}
        ]
        }
    "#]]
    .assert_eq(&shop.read("gcheck-baseline.json"));
    expect![[r#"
        ! a.nc and 1 more file: control haas-mill, set by `--control`
        ! no findings in 2 files (10 lines); 2 in the baseline
        ! the verdicts rest on 1 assumption about the machines; `--output-format json` lists them
        exit 0
    "#]]
    .assert_eq(&shop.gcheck(CHECK).to_string());
}

#[test]
fn what_is_new_does() {
    let shop = shop();
    update(&shop);
    shop.file("a.nc", BAD.replace("G999", "G999\nG998"));
    expect![[r#"
        a.nc:4:1: error[unknown-code] unknown code `G998`
        ! a.nc and 1 more file: control haas-mill, set by `--control`
        ! 1 error in 2 files (11 lines); 2 in the baseline
        ! the verdicts rest on 1 assumption about the machines; `--output-format json` lists them
        exit 1
    "#]]
    .assert_eq(&shop.gcheck(CHECK).to_string());
}

#[test]
fn what_was_found_many_times_in_a_file_is_named_once() {
    let shop = shop();
    shop.file("a.nc", BAD.replace("G999", "G999\nG999\nG999"));
    update(&shop);
    shop.file("a.nc", GOOD);
    expect![[r#"
        ! gcheck-baseline.json: 3 entries are stale, nothing is found there any more: unknown-code of a.nc; `--update-baseline` drops them
        ! a.nc and 1 more file: control haas-mill, set by `--control`
        ! no findings in 2 files (11 lines); 1 in the baseline
        ! the verdicts rest on 1 assumption about the machines; `--output-format json` lists them
        exit 0
    "#]].assert_eq(&shop.gcheck(CHECK).to_string());
}

#[test]
fn what_is_fixed_is_stale_until_the_next_update() {
    let shop = shop();
    update(&shop);
    shop.file("a.nc", GOOD);
    std::fs::remove_file(shop.path("jobs/b.nc")).unwrap();
    expect![[r#"
        ! gcheck-baseline.json: 2 entries are stale, nothing is found there any more: unknown-code of a.nc, missing-decimal-point of jobs/b.nc; `--update-baseline` drops them
        ! a.nc: control haas-mill, set by `--control`
        ! no findings in 1 file (6 lines)
        exit 0
    "#]].assert_eq(&shop.gcheck(CHECK).to_string());
    update(&shop);
    expect![[r#"
        {
        "version": 1,
        "findings": []
        }
    "#]]
    .assert_eq(&shop.read("gcheck-baseline.json"));
}

#[test]
fn a_run_of_one_file_keeps_the_entries_of_others() {
    let shop = shop();
    update(&shop);
    let before = shop.read("gcheck-baseline.json");
    assert_eq!(shop.gcheck(&format!("{CHECK} a.nc --update-baseline")).code, 0);
    assert_eq!(shop.read("gcheck-baseline.json"), before);
    let run = shop.gcheck(&format!("{CHECK} a.nc"));
    assert!(!run.stderr.contains("stale"), "{run}");
}

#[test]
fn a_run_of_some_rules_calls_nothing_stale_and_updates_nothing() {
    let shop = shop();
    update(&shop);
    let run = shop.gcheck(&format!("{CHECK} --select arcs"));
    assert!(run.code == 0 && !run.stderr.contains("stale"), "{run}");
    let run = shop.gcheck(&format!("{CHECK} --select arcs --update-baseline"));
    assert!(run.code == 2 && run.stderr.contains("cannot be used with"), "{run}");
}

#[test]
fn it_does_not_matter_where_gcheck_is_started() {
    let shop = shop();
    update(&shop);
    let mut command = shop.command();
    command.current_dir(shop.path("jobs"));
    command.args([
        "check",
        "--control",
        "haas-mill",
        "--baseline",
        "../gcheck-baseline.json",
        ".",
        "../a.nc",
    ]);
    let run = shop.finish(&mut command, b"");
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.contains("2 in the baseline"), "{run}");
}

#[test]
fn a_baseline_that_is_missing_or_damaged_is_left_alone() {
    let shop = shop();
    expect![[r#"
        ! error: gcheck-baseline.json: there is no such baseline
        !   help: write it with `--update-baseline`
        exit 2
    "#]]
    .assert_eq(&shop.gcheck(CHECK).to_string());
    update(&shop);
    let good = shop.read("gcheck-baseline.json");
    let conflict = good.replace("  {\"file\":\"a.nc\"", "<<<<<<< HEAD\n  {\"file\":\"a.nc\"");
    let later = good.replace("\"version\": 1", "\"version\": 2");
    let twice = format!("{good}{good}");
    let cut = good.get(..good.len() / 2).unwrap();
    for (damage, also) in [
        (conflict.as_str(), ""),
        (conflict.as_str(), " --update-baseline"),
        (later.as_str(), ""),
        (later.as_str(), " --update-baseline"),
        (twice.as_str(), ""),
        (cut, ""),
        ("{", ""),
        ("[]", ""),
        ("null", ""),
        ("", " --update-baseline"),
    ] {
        shop.file("gcheck-baseline.json", damage);
        let run = shop.gcheck(&format!("{CHECK}{also}"));
        assert_eq!((run.code, shop.read("gcheck-baseline.json").as_str()), (2, damage), "{run}");
    }
    shop.file("gcheck-baseline.json", &conflict);
    expect![[r#"
        ! error: gcheck-baseline.json:4:1: a merge left conflict marks
        !   |
        ! 4 | <<<<<<< HEAD
        !   | ^^^^^^^^^^^^
        !   help: keep the entries of both sides and delete the marks
        exit 2
    "#]]
    .assert_eq(&shop.gcheck(CHECK).to_string());
}

#[test]
fn nobody_is_told_to_delete_a_program() {
    let shop = shop();
    shop.file("O2000", "%\nO2000 (PART)\nM30\n%\n");
    let check = |also: &str| shop.gcheck(&format!("check --control haas-mill --baseline O2000{also}"));
    expect![[r#"
        ! error: O2000:1:1: this is not a baseline that gcheck wrote
        !   |
        ! 1 | %
        !   | ^
        !   help: name another file; `--update-baseline` writes a new one
        exit 2
    "#]]
    .assert_eq(&check("").to_string());
    assert_eq!(check(" --update-baseline").code, 2);
    assert_eq!(shop.read("O2000"), "%\nO2000 (PART)\nM30\n%\n");
}

#[test]
fn a_baseline_of_a_later_version_is_refused() {
    let shop = shop();
    shop.file("gcheck-baseline.json", "{\n\"version\": 2,\n\"findings\": []\n}\n");
    expect![[r#"
        ! error: gcheck-baseline.json:1:1: is of version 2; this gcheck reads version 1
        !   |
        ! 1 | {
        !   | ^
        !   help: use the gcheck that wrote it, or delete it and write it again with `--update-baseline`
        exit 2
    "#]]
    .assert_eq(&shop.gcheck(CHECK).to_string());
}

#[test]
fn a_merge_that_kept_lines_of_both_sides_is_read() {
    let shop = shop();
    update(&shop);
    let good = shop.read("gcheck-baseline.json");
    let line = good.lines().find(|line| line.contains("a.nc")).unwrap().trim_end_matches(',');
    // The same entry twice, out of order.
    shop.file("gcheck-baseline.json", good.replace("\n]", &format!(",\n{line}\n]")));
    let run = shop.gcheck(CHECK);
    assert_eq!(run.code, 0, "{run}");
    update(&shop);
    assert_eq!(shop.read("gcheck-baseline.json"), good);
}

#[test]
fn json_counts_what_is_known() {
    let shop = shop();
    update(&shop);
    let run = shop.gcheck("check --control haas-mill --output-format json --baseline gcheck-baseline.json");
    assert_eq!(run.json()["summary"]["baseline"], 2);
    assert_eq!(run.json()["findings"].as_array().unwrap().len(), 0);
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_whose_name_is_not_text_is_known_too() {
    use std::os::unix::ffi::OsStrExt as _;

    let shop = Shop::new();
    let name = std::ffi::OsStr::from_bytes(b"part\xE9.nc");
    std::fs::write(shop.path("").join(name), crate::shop::BAD).unwrap();
    let run = shop.gcheck("check --control haas-mill --baseline known.json --update-baseline");
    assert_eq!(run.code, 0, "{run}");
    let run = shop.gcheck("check --control haas-mill --baseline known.json");
    assert_eq!((run.code, run.stderr.contains("stale")), (0, false), "{run}");
    // A run of nothing of it does not call it gone.
    shop.file("good.nc", crate::shop::GOOD);
    let run = shop.gcheck("check good.nc --control haas-mill --baseline known.json");
    assert_eq!((run.code, run.stderr.contains("stale")), (0, false), "{run}");
}
