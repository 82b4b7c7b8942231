//! Where output goes: standard output or a file replaced whole, colours or none, what is said besides.

use std::fmt::Write as _;
use std::io::Read as _;
use std::process::{Command, Stdio};

use expect_test::expect;

use crate::shop::{BAD, GOOD, Shop, WARNED};

const ESCAPE: char = '\x1b';

#[test]
fn a_file_takes_the_findings() {
    let shop = Shop::with(&[("part.nc", BAD), ("out.json", "what was there before")]);
    let run = shop.gcheck("check part.nc --control haas-mill --output-format json -o out.json");
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (1, "", ""));
    let direct = shop.gcheck("check part.nc --control haas-mill --output-format json");
    assert_eq!(shop.read("out.json"), direct.stdout);
    assert_eq!(shop.names(), ["out.json", "part.nc"], "nothing else stays behind");
}

#[test]
fn a_file_gets_no_colours() {
    let shop = Shop::with(&[("part.nc", BAD)]);
    let run = shop.gcheck("check --control haas-mill --color always --output-file out.txt");
    assert_eq!(run.stdout, "");
    assert!(!shop.read("out.txt").contains(ESCAPE));
    assert!(run.stderr.ends_with("1 error in 1 file (5 lines)\n"), "{run}");
}

#[test]
fn a_folder_cannot_take_them() {
    let shop = Shop::with(&[("part.nc", BAD), ("out/x", "")]);
    expect![[r#"
        ! error: out: cannot write: is a folder
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check --control haas-mill --quiet -o out").to_string());
    expect![[r#"
        ! error: missing/out.txt: cannot write: no such file or directory
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check --control haas-mill --quiet -o missing/out.txt").to_string());
    assert_eq!(shop.names(), ["out", "part.nc"]);
}

#[cfg(unix)]
#[test]
fn a_folder_that_is_read_only() {
    let shop = Shop::with(&[("part.nc", BAD), ("locked/x", "")]);
    if !shop.permissions_count("a_folder_that_is_read_only") {
        return;
    }
    shop.chmod("locked", 0o555);
    let run = shop.gcheck("check part.nc --control haas-mill --quiet -o locked/out.txt");
    shop.chmod("locked", 0o755);
    assert_eq!(run.code, 2);
    assert_eq!(run.stderr, "error: locked/out.txt: cannot write: permission denied\n");
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link() {
    let shop = Shop::with(&[("part.nc", BAD), ("real/out.txt", "before")]);
    std::os::unix::fs::symlink("real/out.txt", shop.path("out.txt")).unwrap();
    assert_eq!(
        shop.gcheck("check part.nc --control haas-mill --quiet --output-format concise -o out.txt").code,
        1
    );
    assert!(shop.path("out.txt").symlink_metadata().unwrap().is_symlink());
    assert!(shop.read("real/out.txt").contains("unknown-code"));
}

#[cfg(unix)]
#[test]
fn a_pipe_is_written_to_and_not_replaced() {
    use std::os::unix::fs::FileTypeExt as _;

    let shop = Shop::with(&[("part.nc", BAD)]);
    let made = std::process::Command::new("mkfifo").arg(shop.path("pipe")).status();
    if !made.is_ok_and(|status| status.success()) {
        gcheck_testkit::skips::skip(
            "a_pipe_is_written_to_and_not_replaced",
            "mkfifo",
            "it is one of the coreutils",
        );
        return;
    }
    let mut child = shop
        .command()
        .args([
            "check",
            "part.nc",
            "--control",
            "haas-mill",
            "--quiet",
            "--output-format",
            "concise",
            "-o",
            "pipe",
        ])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // Opened for both ends, so that a program that never opens it does not block the test.
    let path = shop.path("pipe");
    let mut pipe = std::fs::File::options().read(true).write(true).open(&path).unwrap();
    let code = child.wait().unwrap().code();
    assert_eq!(code, Some(1));
    assert!(path.symlink_metadata().unwrap().file_type().is_fifo(), "the pipe was replaced by a file");
    let mut text = [0; 7];
    pipe.read_exact(&mut text).unwrap();
    assert_eq!(&text, b"part.nc");
}

#[test]
fn colours_are_for_terminals_and_those_who_ask() {
    let shop = Shop::with(&[("part.nc", BAD)]);
    let coloured = |variables: &[(&str, &str)], arguments: &str| {
        let run = shop.gcheck_with(variables, &format!("check --control haas-mill {arguments}"));
        assert!(!run.stderr.contains(ESCAPE), "{run}");
        run.stdout.contains(ESCAPE)
    };
    assert!(!coloured(&[], ""), "a pipe gets none");
    assert!(!coloured(&[("NO_COLOR", "1")], ""));
    assert!(coloured(&[], "--color always"));
    assert!(coloured(&[], "--color always --output-format concise"));
    assert!(coloured(&[("NO_COLOR", "1")], "--color always"), "the option wins over the environment");
    assert!(coloured(&[("CLICOLOR_FORCE", "1")], ""));
    assert!(!coloured(&[("CLICOLOR_FORCE", "1")], "--color never"));
    assert!(!coloured(&[("CLICOLOR_FORCE", "0")], ""));
    for format in ["json", "sarif", "github"] {
        assert!(!coloured(&[], &format!("--color always --output-format {format}")), "{format}");
    }
}

#[test]
fn the_format_can_come_from_the_environment() {
    let shop = Shop::with(&[("part.nc", BAD)]);
    let run = shop.gcheck_with(&[("GCHECK_OUTPUT_FORMAT", "json")], "check");
    assert_eq!(run.json()["version"], 1);
    let run = shop.gcheck_with(&[("GCHECK_OUTPUT_FORMAT", "json")], "check --quiet --output-format concise");
    assert_eq!(run.rules(), ["unknown-code"]);
    assert_eq!(shop.gcheck_with(&[("GCHECK_OUTPUT_FORMAT", "xml")], "check").code, 2);
}

#[test]
fn quiet_says_findings_only() {
    let shop = Shop::with(&[("part.nc", BAD), ("good.nc", GOOD)]);
    let run = shop.gcheck("check good.nc --control haas-mill --quiet");
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
    let run = shop.gcheck("check -q part.nc --control haas-mill");
    assert!(run.stdout.starts_with("error[unknown-code]"), "{run}");
    assert!(!run.stdout.contains("1 file"), "{run}");
    assert_eq!(run.stderr, "");
}

#[test]
fn statistics_are_counts_alone() {
    let shop = Shop::with(&[("a.nc", BAD), ("b.nc", BAD), ("c.nc", WARNED)]);
    let run = shop.gcheck("check --control haas-mill --statistics");
    expect![[r#"
        findings  files  fixable  severity  rule
               2      2           error     unknown-code           code that the control does not have
               1      1           warning   missing-decimal-point  no decimal point where the control counts least increments
        2 errors, 1 warning in 3 files (15 lines)
        the verdicts rest on 1 assumption about the machines; `--output-format json` lists them
        ! a.nc and 2 more files: control haas-mill, set by `--control`
        exit 1
    "#]]
    .assert_eq(&run.to_string());
    let concise = shop.gcheck("check --control haas-mill --statistics --output-format concise -o counts.txt");
    assert_eq!((concise.code, concise.stdout.as_str()), (1, ""), "{concise}");
    assert!(run.stdout.starts_with(&shop.read("counts.txt")), "a file takes them as well");
}

#[test]
fn a_summary_has_the_worst_file_first() {
    let shop = Shop::with(&[("a.nc", WARNED), ("b.nc", GOOD), ("c.nc", BAD)]);
    let run = shop.gcheck("check --control haas-mill --summary");
    expect![[r#"
        errors  warnings  infos  hints  file
             1         0      0      0  c.nc
             0         1      0      0  a.nc
        1 error, 1 warning in 3 files (16 lines)
        the verdicts rest on 1 assumption about the machines; `--output-format json` lists them
        ! a.nc and 2 more files: control haas-mill, set by `--control`
        exit 1
    "#]]
    .assert_eq(&run.to_string());
    let both =
        shop.gcheck("check --control haas-mill --summary --statistics --quiet --output-format grouped");
    expect![[r#"
        findings  files  fixable  severity  rule
               1      1           warning   missing-decimal-point  no decimal point where the control counts least increments
               1      1           error     unknown-code           code that the control does not have

        errors  warnings  infos  hints  file
             1         0      0      0  c.nc
             0         1      0      0  a.nc
        exit 1
    "#]]
    .assert_eq(&both.to_string());
}

#[test]
fn counts_leave_formats_for_programs_whole() {
    let shop = Shop::with(&[("a.nc", BAD)]);
    for format in ["json", "jsonl", "sarif", "github", "gitlab", "checkstyle", "junit", "rdjson", "azure"] {
        let run = |counts: &str| {
            shop.gcheck(&format!("check --control haas-mill --quiet {counts} --output-format {format}"))
        };
        let counted = run("--statistics --summary");
        assert_eq!(counted.stdout, run("").stdout, "{format}");
        assert!(counted.stderr.contains("unknown-code") && counted.stderr.contains("a.nc"), "{counted}");
    }
    let run = shop.gcheck("check --control haas-mill --quiet --statistics -o concise=all.txt");
    assert!(shop.read("all.txt").starts_with("a.nc:3:1: error[unknown-code]"), "{run}");
}

#[test]
fn repeats_are_folded_and_everything_is_shown_on_request() {
    let program = format!("%\nO0001\n{}M30\n%\n", "G999\n".repeat(1_198));
    let shop = Shop::with(&[("part.nc", &program)]);
    let check = "check --control haas-mill --select unknown-code";
    let run = shop.gcheck(&format!("{check} --output-format concise"));
    expect![[r#"
        part.nc:3:1: error[unknown-code] unknown code `G999`
        part.nc:4:1: error[unknown-code] unknown code `G999`
        part.nc:5:1: error[unknown-code] unknown code `G999`
        part.nc:6:1: error[unknown-code] unknown code `G999`
        part.nc:7:1: error[unknown-code] unknown code `G999`
        part.nc:8:1: error[unknown-code] … and 1,193 more, lines 8 to 1,200
        ! part.nc: control haas-mill, set by `--control`
        ! 1,198 errors in 1 file (1,202 lines)
        ! repeats are folded: `--show-all` shows every finding, `--statistics` counts them
        exit 1
    "#]]
    .assert_eq(&run.to_string());
    let full = shop.gcheck(check);
    assert_eq!(full.stdout.matches("error[unknown-code]: unknown code").count(), 5, "{full}");
    assert!(
        full.stdout.contains("error[unknown-code]: … and 1,193 more in part.nc, lines 8 to 1,200\n"),
        "{full}"
    );
    let whole = shop.gcheck(&format!("{check} --show-all --output-format concise"));
    assert_eq!(whole.stdout.lines().count(), 1_198);
    assert!(!whole.stderr.contains("folded"), "{}", whole.stderr);
}

#[test]
fn a_check_ends_with_what_to_do_next() {
    let shop = Shop::with(&[("part.nc", WARNED), ("open.nc", "%\nO0001 (PART\nG21 G90 G17\nM30\n%\n")]);
    for number in 0..25 {
        shop.file(&format!("old/{number}.nc"), format!("%\nO0001\n{}M30\n%\n", "G999\n".repeat(4)));
    }
    let last = |arguments: &str| {
        let stdout = shop.gcheck(&format!("check {arguments}")).stdout;
        format!("{}\n", stdout.lines().last().unwrap_or_default())
    };
    let said = [
        "part.nc --control haas-mill",
        "part.nc --extend-select house-style",
        "open.nc --control haas-mill",
        "old --control haas-mill",
    ]
    .map(last);
    expect![[r#"
          numbers without a decimal point count as the control usually reads them (Setting 162); to settle it: [settings] 162 = false
        nothing shows which control runs a program: name it with `--control` (`gcheck controls` lists them) or in a `gcheck.toml` (`gcheck init`)
        1 finding has a fix that changes no move: `--diff` shows, `--fix` applies
        old programs: `--baseline gcheck-baseline.json --update-baseline` accepts what is found today, and later checks with that baseline show only what is new
    "#]]
    .assert_eq(&said.concat());
    let run = shop.gcheck("check --control haas-mill old --quiet --output-format concise");
    assert_eq!(run.stderr, "", "who asks for findings alone gets no advice");
    let run = shop.gcheck("check old part.nc open.nc --output-format json");
    assert_eq!(run.stderr, "", "nor does a program");
}

#[test]
fn no_programs_are_said() {
    let run = Shop::new().gcheck("check");
    assert_eq!((run.code, run.stdout.as_str()), (0, "no programs found\n"));
    assert_eq!(Shop::new().gcheck("check --output-format json").json()["summary"]["files"], 0);
}

#[test]
fn a_thousand_findings() {
    let mut text = String::from("%\nO0001\n");
    for line in 0..1_000 {
        let _ = writeln!(text, "G999 X{line}.");
    }
    text.push_str("M30\n%\n");
    let shop = Shop::with(&[("part.nc", &text)]);
    let run = shop.gcheck("check --control haas-mill --select unknown-code --output-format json");
    let json = run.json();
    assert_eq!(json["summary"]["errors"], 1_000);
    assert_eq!(
        json["findings"].as_array().unwrap().len() as u64,
        1_000 - json["summary"]["omitted"].as_u64().unwrap()
    );
    let run = shop.gcheck("check --control haas-mill --select unknown-code --statistics");
    assert!(run.stdout.contains("   1,000      1           error     unknown-code"), "{run}");
    assert!(run.stdout.contains("1,000 errors in 1 file"));
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let shop = Shop::new();
    for number in 0..50 {
        shop.file(&format!("{number}.nc"), format!("%\nO0001\n{}M30\n%\n", "G999\n".repeat(100)));
    }
    for arguments in [
        "check --control haas-mill",
        "check --output-format json",
        "rules",
        "codes",
        "schema",
        "completions bash",
    ] {
        let mut command = shop.command();
        command
            .args(arguments.split_whitespace())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut first = [0; 1];
        child.stdout.take().unwrap().read_exact(&mut first).unwrap();
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!said.contains("panicked") && !said.contains("error:"), "{arguments}: {said}");
        assert!(matches!(output.status.code(), Some(0 | 1)), "{arguments}: {:?}", output.status);
    }
}

#[test]
fn several_outputs_of_one_run() {
    let shop = Shop::with(&[("part.nc", BAD)]);
    let run = shop.gcheck(
        "check --control haas-mill --quiet --output-format concise -o sarif=out.sarif -o junit=out.xml -o gitlab=q.json",
    );
    assert_eq!((run.code, run.rules().as_slice()), (1, ["unknown-code".to_owned()].as_slice()), "{run}");
    assert_eq!(shop.names(), ["out.sarif", "out.xml", "part.nc", "q.json"]);
    for (file, format) in [("out.sarif", "sarif"), ("out.xml", "junit"), ("q.json", "gitlab")] {
        let alone = shop.gcheck(&format!("check --control haas-mill --quiet --output-format {format}"));
        assert_eq!(shop.read(file), alone.stdout, "{format}");
    }
    // What is before `=` and is not a format belongs to the name.
    let run = shop.gcheck("check --control haas-mill --quiet -o a=b.txt");
    assert_eq!(run.code, 1, "{run}");
    assert!(shop.read("a=b.txt").contains("unknown-code"));
}

#[test]
fn two_outputs_do_not_share_a_file() {
    let shop = Shop::with(&[("part.nc", BAD)]);
    expect![[r#"
        ! error: out: two outputs cannot go to one file
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check --quiet -o sarif=out -o junit=./out").to_string());
    expect![[r#"
        ! error: two: is a second file for the same output
        !   help: give it a format of its own: `-o sarif=FILE`
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check --quiet -o one -o two").to_string());
    assert_eq!(shop.names(), ["part.nc"]);
}

/// What is found in many files is bounded together: a thousand times a thousand findings, told whole and shown in part.
#[test]
fn a_thousand_files_with_a_thousand_findings() {
    let program = format!("%\nO0001\n{}M30\n%\n", "G999\n".repeat(1_000));
    let shop = Shop::new();
    for number in 0..1_000 {
        shop.file(&format!("{number:03}.nc"), &program);
    }
    let arguments = "check --control haas-mill --select unknown-code -o concise=findings.txt --show-all --output-format junit";
    let run = |jobs: usize| {
        // Half a gigabyte is more than it takes, and half of what all findings would. One heap for
        // all threads, because the space that a heap reserves counts too.
        let mut command = shop.command();
        if cfg!(target_os = "linux") {
            let gcheck = env!("CARGO_BIN_EXE_gcheck");
            command = Command::new("sh");
            command.current_dir(shop.path("")).env_clear();
            command.args([
                "-c",
                &format!(
                    "ulimit -v 600000; MALLOC_ARENA_MAX=1 exec {gcheck} {arguments} --jobs {jobs} -o all.xml"
                ),
            ]);
        } else {
            command.args(arguments.split_whitespace()).args(["-o", "all.xml"]);
        }
        let run = shop.finish(&mut command, b"");
        assert_eq!((run.code, run.stderr.as_str()), (1, ""), "{run}");
        (shop.read("findings.txt"), shop.read("all.xml"))
    };
    let (concise, junit) = run(1);
    assert_eq!(concise.lines().count(), 100_000, "those of the first files");
    assert!(concise.lines().last().unwrap().starts_with("099.nc:1002:1: "));
    assert_eq!(junit.matches("<testsuite ").count(), 1_000, "every file is told");
    assert!(run(4) == (concise, junit), "which of them does not depend on the number of threads");
    let run = shop.gcheck("check --control haas-mill --select unknown-code --output-format gitlab -o a.json");
    assert_eq!(run.stderr, "", "{run}");
    let run = shop.gcheck("check --control haas-mill --select unknown-code --output-format concise -o b.txt");
    assert!(run.stderr.contains("1,000,000 errors in 1,000 files"), "{run}");
    assert!(run.stderr.contains("900,000 of them counted but not shown"), "{run}");
}

/// Findings never take the place of what they were found in.
#[test]
fn an_output_does_not_replace_what_is_read() {
    let shop = Shop::with(&[("part.nc", BAD), ("jobs/other.nc", BAD), ("gcheck.toml", "")]);
    assert_eq!(shop.gcheck("check --baseline known.json --update-baseline").code, 0);
    let baseline = shop.read("known.json");
    expect![[r#"
        ! error: jobs/../part.nc: is read in this run, and findings would replace it
        !   help: name another file for them
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check -o sarif=jobs/../part.nc").to_string());
    for arguments in [
        "check part.nc -o part.nc",
        "check -o junit=gcheck.toml",
        "check --baseline known.json -o json=known.json",
    ] {
        let run = shop.gcheck(arguments);
        assert!(run.code == 2 && run.stderr.contains("findings would replace it"), "{run}");
    }
    assert_eq!(
        (shop.read("part.nc"), shop.read("gcheck.toml"), shop.read("known.json")),
        (BAD.into(), String::new(), baseline)
    );
}

#[cfg(unix)]
#[test]
fn two_outputs_do_not_meet_through_links() {
    let shop = Shop::with(&[("part.nc", BAD), ("real.txt", "")]);
    std::os::unix::fs::symlink("real.txt", shop.path("link.txt")).unwrap();
    std::os::unix::fs::symlink("part.nc", shop.path("program.txt")).unwrap();
    for arguments in ["check -o json=real.txt -o junit=link.txt", "check part.nc -o program.txt"] {
        assert_eq!(shop.gcheck(arguments).code, 2, "{arguments}");
    }
    assert_eq!((shop.read("part.nc"), shop.read("real.txt")), (BAD.into(), String::new()));
}

#[test]
fn a_folder_of_files_that_are_not_read_gets_another_next_step_than_a_baseline() {
    let shop = Shop::with(&[("good.nc", GOOD)]);
    let printed = ";FLAVOR:Marlin\nM104 S200\nM109 S200\nG28\nG92 E0\nG1 X10 Y10 E0.5 F1200\nM84\n";
    for number in 0..120 {
        shop.file(&format!("{number}.gcode"), printed);
    }
    let run = shop.gcheck("check --quiet --no-cache --summary");
    assert!(run.stdout.contains("0.gcode"), "{run}");
    let run = shop.gcheck("check --no-cache");
    let says = "120 of 121 files are for controls that gcheck does not read: leave them out with `exclude` under `[files]`";
    assert!(run.stdout.contains(says) && !run.stdout.contains("old programs"), "{run}");
    assert!(
        run.stdout.contains("begin with the counts: `--statistics` has them by rule, `--summary` by file")
    );
}
