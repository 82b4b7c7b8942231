//! Bad input: each gives one clear message with its place and the right exit code, and the other files are still checked.

use std::fmt::Write as _;
use std::fs;
use std::time::{Duration, Instant};

use expect_test::{Expect, expect};

use crate::shop::{BAD, GOOD, Shop};

/// Longer than any of these may take in a debug build on a busy machine; hangs and quadratic work take far longer.
const PATIENCE: Duration = Duration::from_mins(1);

/// Checks the messages when `part.nc` has this content, beside a file with a finding.
fn check_content(content: &[u8], expected: &Expect) {
    let shop = Shop::with(&[("other.nc", BAD)]);
    shop.file("part.nc", content);
    expected.assert_eq(
        &shop
            .gcheck("check part.nc other.nc --control haas-mill --output-format concise --quiet")
            .to_string(),
    );
}

/// Checks the messages when `gcheck.toml` has this content, beside a folder with a sound one.
fn check_configuration(content: &str, expected: &Expect) {
    let shop = Shop::with(&[
        ("shop/gcheck.toml", content),
        ("shop/a.nc", BAD),
        ("shop/b.nc", BAD),
        ("sound/gcheck.toml", "control = \"haas-mill\"\n"),
        ("sound/a.nc", BAD),
    ]);
    expected.assert_eq(&shop.gcheck("check shop sound --output-format concise --quiet").to_string());
}

/// Checks the messages about arguments, in a folder with one good program.
fn check_arguments(arguments: &str, expected: &Expect) {
    let shop = Shop::with(&[("part.nc", GOOD)]);
    expected.assert_eq(&shop.gcheck(arguments).to_string());
}

#[test]
fn a_missing_file() {
    let shop = Shop::with(&[("other.nc", BAD)]);
    let run = shop.gcheck("check missing.nc other.nc --control haas-mill --output-format concise --quiet");
    expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: missing.nc: no such file or folder
        exit 2
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn an_unreadable_file() {
    let shop = Shop::with(&[("other.nc", BAD), ("part.nc", GOOD)]);
    if !shop.permissions_count("an_unreadable_file") {
        return;
    }
    shop.chmod("part.nc", 0);
    let run = shop.gcheck("check part.nc other.nc --control haas-mill --output-format concise --quiet");
    assert_eq!(run.code, 2);
    assert_eq!(run.stderr, "error: part.nc: cannot read: permission denied\n");
    assert_eq!(run.rules(), ["unknown-code"]);
}

#[test]
fn a_folder_with_the_name_of_a_file_is_walked() {
    let shop = Shop::with(&[("part.nc/inner.nc", BAD)]);
    for arguments in ["check part.nc", "check"] {
        let run = shop.gcheck(&format!("{arguments} --control haas-mill --output-format concise --quiet"));
        assert_eq!(run.findings(), ["part.nc/inner.nc:3:1: error[unknown-code]"], "{arguments}");
        assert_eq!(run.code, 1);
    }
}

#[test]
fn a_folder_without_programs() {
    check_arguments(
        "check --config=files.include=[\"*.none\"]",
        &expect![[r#"
        no programs found
        exit 0
    "#]],
    );
}

#[test]
fn a_binary() {
    let noise: Vec<u8> = (0..4_000_u32).map(|n| (n.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    check_content(
        &noise,
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: part.nc: is not text, so it is not a part program
        exit 2
    "#]],
    );
}

#[test]
fn utf_16() {
    let text: Vec<u8> =
        std::iter::once(0xFEFF).chain(GOOD.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    check_content(
        &text,
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: part.nc: is UTF-16 text
        !   help: save it as UTF-8 or plain ASCII
        exit 2
    "#]],
    );
    // Without a byte order mark every second byte is NUL.
    let text: Vec<u8> = GOOD.encode_utf16().flat_map(u16::to_le_bytes).collect();
    check_content(
        &text,
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: part.nc: is not text, so it is not a part program
        exit 2
    "#]],
    );
}

#[test]
fn problems_in_a_folder_name_files_as_findings_do() {
    let shop = Shop::with(&[("other.nc", BAD)]);
    shop.file("part.nc", b"\xFF\xFEx\0");
    expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: part.nc: is UTF-16 text
        !   help: save it as UTF-8 or plain ASCII
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check --control haas-mill --output-format concise --quiet").to_string());
}

#[test]
fn bytes_of_a_code_page_in_a_comment_are_no_binary() {
    check_content(
        b"%\nO0001 (FR\xC4SEN)\nM30\n%\n",
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        exit 1
    "#]],
    );
}

#[test]
fn an_empty_file() {
    check_content(
        b"",
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        part.nc:1:1: warning[empty-program] file is empty
        exit 1
    "#]],
    );
    check_content(
        b"\xEF\xBB\xBF",
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        part.nc:1:1: info[empty-program] program has comments only
        exit 1
    "#]],
    );
}

#[test]
fn a_large_file() {
    let mut text = String::from("%\nO0001 (LARGE)\nG21 G90 G54\nS3000 M3\n");
    let mut line = 0;
    while text.len() < 30 << 20 {
        let _ = writeln!(text, "N{line} G1 X{}.{:03} Y-1.5 F200.", line % 300, line % 1000);
        line = (line + 1) % 90_000;
    }
    text.push_str("M30\n%\n");
    let shop = Shop::new();
    shop.file("large.nc", &text);
    let start = Instant::now();
    let run = shop.gcheck("check large.nc --control haas-mill --output-format concise --quiet --ignore duplicate-sequence-number");
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
}

/// A program whose first lines are text, with a hole behind them that takes no room on the disk.
fn a_program_of(shop: &Shop, bytes: u64) {
    shop.file("huge.nc", GOOD.repeat(2_000));
    let file = fs::File::options().write(true).open(shop.path("huge.nc")).unwrap();
    file.set_len(bytes).unwrap();
}

#[test]
fn a_file_of_two_gigabytes() {
    let shop = Shop::with(&[("other.nc", BAD)]);
    a_program_of(&shop, 2 << 30);
    let start = Instant::now();
    for arguments in [
        "check huge.nc",
        "fmt huge.nc",
        "fmt --check huge.nc",
        "run huge.nc",
        "stats huge.nc",
        "plot huge.nc -o huge.svg",
        "diff huge.nc other.nc",
        "diff other.nc huge.nc",
    ] {
        let run = shop.gcheck(&format!("{arguments} --control haas-mill"));
        assert_eq!(run.code, 2, "{arguments}: {run}");
        let said = "huge.nc: is larger than 1 GB, the largest program that gcheck reads\n";
        assert!(run.stderr.contains(said), "{arguments}: {run}");
        assert!(run.stderr.contains("help: split it, for example at its tool changes"), "{arguments}: {run}");
    }
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
    assert_eq!(fs::metadata(shop.path("huge.nc")).unwrap().len(), 2 << 30);
    // The other files are checked.
    let run = shop.gcheck("check huge.nc other.nc --control haas-mill --output-format concise --quiet");
    assert_eq!(run.rules(), ["unknown-code"]);
    assert_eq!(run.code, 2);
}

#[test]
fn a_line_of_a_million_characters() {
    let shop = Shop::new();
    shop.file("words.nc", format!("%\nO0001\n{}\nM30\n%\n", "X1.".repeat(333_333)));
    shop.file("comment.nc", format!("%\nO0001\n({})\nM30\n%\n", "A".repeat(1_000_000)));
    shop.file("digits.nc", format!("%\nO0001\nG0 X{}.\nM30\n%\n", "1".repeat(1_000_000)));
    for format in ["full", "json", "sarif", "github"] {
        let start = Instant::now();
        let run = shop.gcheck(&format!("check --control linuxcnc --output-format {format}"));
        assert!(start.elapsed() < PATIENCE, "{format}: {:?}", start.elapsed());
        assert_eq!(run.code, 1, "{format}: {}", run.stderr);
        assert!(!run.stderr.contains("error:"), "{format}: {}", run.stderr);
    }
    let run = shop.gcheck("check --control linuxcnc --select line-too-long --output-format concise --quiet");
    assert_eq!(run.findings().len(), 3, "{run}");
    let longest = shop.gcheck("check --control linuxcnc").stdout.lines().map(str::len).max().unwrap();
    assert!(longest < 2_000, "the full format shows a part of a long line, not {longest} bytes");
}

#[test]
fn ten_thousand_nested_brackets() {
    let nested = format!("%\nO0001\n#100={}1{}\nM30\n%\n", "[".repeat(10_000), "]".repeat(10_000));
    check_content(
        nested.as_bytes(),
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        part.nc:3:70: error[expression-too-deep] expression is nested too deeply
        exit 1
    "#]],
    );
    let open = format!("%\nO0001\nG0 X{}\nM30\n%\n", "[".repeat(10_000));
    check_content(
        open.as_bytes(),
        &expect![[r#"
            other.nc:3:1: error[unknown-code] unknown code `G999`
            part.nc:3:69: error[expression-too-deep] expression is nested too deeply
            exit 1
        "#]],
    );
    let loops = format!("%\nO0001\n{}M30\n%\n", "WHILE [1 EQ 1] DO1\n".repeat(10_000));
    let shop = Shop::new();
    shop.file("loops.nc", loops);
    assert_eq!(shop.gcheck("check --control haas-mill --quiet").code, 1);
}

#[test]
fn a_wrong_key() {
    check_configuration(
        "# shop\ncontrl = \"haas-mill\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:1: unknown key `contrl`; did you mean `control`?
        !   |
        ! 2 | contrl = "haas-mill"
        !   | ^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn a_wrong_type() {
    check_configuration(
        "[machine]\nmax_rpm = \"fast\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:11: wrong type: text "fast", expected a number
        !   |
        ! 2 | max_rpm = "fast"
        !   |           ^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn broken_toml() {
    check_configuration(
        "control = \"haas-mill\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:1:21: invalid basic string, expected `"`
        !   |
        ! 1 | control = "haas-mill
        !   |                     ^
        exit 2
    "#]],
    );
    check_configuration(
        "control = \"haas-mill\"\ncontrol = \"haas-mill\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:1: duplicate key
        !   |
        ! 2 | control = "haas-mill"
        !   | ^^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn a_configuration_that_is_no_text() {
    let shop = Shop::with(&[("part.nc", BAD)]);
    shop.file("gcheck.toml", b"control = \"\xFF\"\n");
    expect![[r#"
        ! error: gcheck.toml: is not a configuration: it holds bytes that are not UTF-8
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check").to_string());
}

#[test]
fn names_that_do_not_exist() {
    check_configuration(
        "control = \"haas-mil\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:1:11: no control is called `haas-mil`; did you mean `haas-mill`?
        !   |
        ! 1 | control = "haas-mil"
        !   |           ^^^^^^^^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[rules]\nselect = [\"words\", \"unknwn-code\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:20: `unknwn-code` is not a rule, group or set of rules; did you mean `unknown-code`?
        !   |
        ! 2 | select = ["words", "unknwn-code"]
        !   |                    ^^^^^^^^^^^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[rules]\nunknwn-code = \"off\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:1: `unknwn-code` is not a rule, group or set of rules; did you mean `unknown-code`?
        !   |
        ! 2 | unknwn-code = "off"
        !   | ^^^^^^^^^^^
        exit 2
    "#]],
    );
    check_configuration(
        "control = \"haas-mill\"\n[machine]\naxes = [\"X\", \"Q\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:3:14: `Q` is not an axis of haas-mill; the axes are A, B, C, U, V, W, X, Y, Z
        !   |
        ! 3 | axes = ["X", "Q"]
        !   |              ^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[codes]\nX5 = { title = \"no code\" }\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:1: `X5` is not a code; write `M51` or `G150`
        !   |
        ! 2 | X5 = { title = "no code" }
        !   | ^^
        exit 2
    "#]],
    );
    check_configuration(
        "control = \"haas-mill\"\n[offsets]\nG999 = { X = 1.0 }\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:3:1: `G999` is not a work offset of haas-mill; write `G54` or "G154 P1"
        !   |
        ! 3 | G999 = { X = 1.0 }
        !   | ^^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[per-file-ignores]\n\"old/**\" = [\"quirk\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:13: `quirk` is not a rule, group or set of rules; `gcheck rules` lists them
        !   |
        ! 2 | "old/**" = ["quirk"]
        !   |             ^^^^^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[[overrides]]\nfiles = [\"a.nc\"]\ncontrol = \"hass-lathe\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:3:11: no control is called `hass-lathe`; did you mean `haas-lathe`?
        !   |
        ! 3 | control = "hass-lathe"
        !   |           ^^^^^^^^^^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[files]\nexclude = [\"[a\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:12: `[a` is not a pattern: unclosed character class; missing ']'
        !   |
        ! 2 | exclude = ["[a"]
        !   |            ^^^^
        exit 2
    "#]],
    );
    check_configuration(
        "control = \"haas-mill\"\n[settings]\n126 = true\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:3:1: gcheck reads no setting 126 of haas-mill
        !   |
        ! 3 | 126 = true
        !   | ^^^
        !   help: leave it out: it changes nothing here
        exit 2
    "#]],
    );
    check_configuration(
        "[settings]\n99999 = true\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:1: gcheck reads no setting 99999 of any control
        !   |
        ! 2 | 99999 = true
        !   | ^^^^^
        !   help: leave it out: it changes nothing here
        exit 2
    "#]],
    );
    check_configuration(
        "[search]\npaths = [\".\", \"macros\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:15: `macros` is not a folder; programs that are called are looked for in it
        !   |
        ! 2 | paths = [".", "macros"]
        !   |               ^^^^^^^^
        !   help: a path counts from the folder of this file
        exit 2
    "#]],
    );
    check_configuration(
        "control = \"haas-mill\"\n[settings]\n162 = \"perhaps\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:3:7: setting 162 (default to float) is one of `on`, `off`
        !   |
        ! 3 | 162 = "perhaps"
        !   |       ^^^^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn a_configuration_that_extends_itself_or_nothing() {
    check_configuration(
        "extend = \"gcheck.toml\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml: `extend` leads back to shop/gcheck.toml
        exit 2
    "#]],
    );
    check_configuration(
        "extend = \"base.toml\"\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:1:10: `extend` names `base.toml`, which is not a file
        !   |
        ! 1 | extend = "base.toml"
        !   |          ^^^^^^^^^^^
        exit 2
    "#]],
    );
}

#[test]
fn an_unknown_control_among_the_arguments() {
    check_arguments(
        "check --control haas-mlil",
        &expect![[r#"
        ! error: no control is called `haas-mlil`; did you mean `haas-mill`?
        exit 2
    "#]],
    );
    check_arguments(
        "check --control nonsense",
        &expect![[r#"
            ! error: no control is called `nonsense`; there are fanuc-lathe, fanuc-lathe-b, fanuc-lathe-c, fanuc-mill, fluidnc, generic-mill, grbl, grblhal, haas-lathe, haas-mill, linuxcnc, tsnc-yh-a1m
            exit 2
        "#]],
    );
}

#[test]
fn an_unknown_rule_among_the_arguments() {
    check_arguments(
        "check --select nonsense",
        &expect![[r#"
        ! error: `nonsense` is not a rule, group or set of rules; `gcheck rules` lists them
        exit 2
    "#]],
    );
    check_arguments(
        "check --ignore unknown-cod",
        &expect![[r#"
        ! error: `unknown-cod` is not a rule, group or set of rules; did you mean `unknown-code`?
        exit 2
    "#]],
    );
    check_arguments(
        "check --extend-select unknown-code,modl",
        &expect![[r#"
        ! error: `modl` is not a rule, group or set of rules; did you mean `modal`?
        exit 2
    "#]],
    );
}

#[test]
fn an_unknown_control_in_a_program() {
    check_content(
        b"%\nO0001\n(gcheck: control=nonsense)\nM30\n%\n",
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        exit 1
    "#]],
    );
    let shop =
        Shop::with(&[("part.nc", "%\nO0001\n(gcheck: control=nonsense)\nM30\n%\n"), ("other.nc", BAD)]);
    expect![[r#"
        other.nc:3:1: info[unknown-code] unknown code `G999`
        ! error: part.nc:3:18: no control is called `nonsense`; there are fanuc-lathe, fanuc-lathe-b, fanuc-lathe-c, fanuc-mill, fluidnc, generic-mill, grbl, grblhal, haas-lathe, haas-mill, linuxcnc, tsnc-yh-a1m
        !   |
        ! 3 | (gcheck: control=nonsense)
        !   |                  ^^^^^^^^
        exit 2
    "#]].assert_eq(&shop.gcheck("check --output-format concise --quiet").to_string());
}

#[test]
fn wrong_arguments() {
    check_arguments(
        "chek",
        &expect![[r#"
        ! error: unrecognized subcommand 'chek'
        ! 
        !   tip: some similar subcommands exist: 'schema', 'check'
        ! 
        ! Usage: gcheck [OPTIONS] <COMMAND>
        ! 
        ! For more information, try '--help'.
        exit 2
    "#]],
    );
    check_arguments(
        "check --output-format xml",
        &expect![[r#"
            ! error: invalid value 'xml' for '--output-format <FORMAT>'
            !   [possible values: full, concise, grouped, json, jsonl, sarif, github, gitlab, checkstyle, junit, rdjson, azure]
            ! 
            ! For more information, try '--help'.
            exit 2
        "#]],
    );
    check_arguments(
        "check --fail-on always",
        &expect![[r#"
        ! error: invalid value 'always' for '--fail-on <SEVERITY>'
        !   [possible values: error, warning, info, never]
        ! 
        ! For more information, try '--help'.
        exit 2
    "#]],
    );
    check_arguments(
        "check --config missing.toml",
        &expect![[r#"
        ! error: missing.toml: cannot read the configuration: no such file or directory
        exit 2
    "#]],
    );
    check_arguments(
        "check --config contrl=haas-mill",
        &expect![[r#"
        ! error: --config:1:1: unknown key `contrl`; did you mean `control`?
        !   |
        ! 1 | contrl="haas-mill"
        !   | ^^^^^^
        exit 2
    "#]],
    );
    check_arguments(
        "check --isolated --config part.nc",
        &expect![[r#"
        ! error: `--isolated` means no configuration file, and `--config` names one
        exit 2
    "#]],
    );
    assert_eq!(Shop::new().gcheck("").code, 2);
}

#[test]
fn nothing_hangs_or_breaks_a_run() {
    let programs: [(&str, Vec<u8>); 12] = [
        ("empty", Vec::new()),
        ("blank", b"\n\n\r\n".to_vec()),
        ("tape", b"%\n%\n".to_vec()),
        ("binary", b"\x7fELF\x02\x01\x01\0\0\0\0\0\0\0\0\0\x02\0>\0\x01".to_vec()),
        ("latin-1", b"(Fr\xE4sen)\nG0 X1\nM30\n".to_vec()),
        ("words", format!("G0 {}\nM30\n", "X1.".repeat(100_000)).into_bytes()),
        ("brackets", format!("#1={}1\nM30\n", "[".repeat(10_000)).into_bytes()),
        ("recursion", b"O1\nM98 P1\nM30\n".to_vec()),
        ("calls", b"O1\nM98 P2 L999999999\nM30\nO2\nM98 P3 L999999999\nM99\nO3\nM99\n".to_vec()),
        ("jump", b"N1 GOTO 1\nM30\n".to_vec()),
        ("holes", b"G91 G81 X1. Z-1. R1. F100. L999999999\nM30\n".to_vec()),
        ("numbers", b"G0 X99999999999999999999999999 Y-1e99 Z.\nG1 X#[1/0] F0\nM30\n".to_vec()),
    ];
    let shop = Shop::new();
    for (name, program) in &programs {
        shop.file(name, program);
        for control in ["haas-mill", "haas-lathe", "fanuc-mill", "linuxcnc"] {
            for command in ["run --output-format jsonl -o moves", "stats -o figures"] {
                let start = Instant::now();
                let run = shop.gcheck(&format!("{command} {name} --control {control} --fuel 200000"));
                assert!(
                    matches!(run.code, 0..=2) && !run.stderr.contains("mistake of gcheck"),
                    "{command} {name}\n{run}"
                );
                assert!(start.elapsed() < PATIENCE, "{command} {name} {:?}", start.elapsed());
            }
        }
    }
}

#[test]
fn rotary_axes_that_cannot_be() {
    check_configuration(
        "[machine]\nrotary_order = [\"A\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:17: rotary_order names two different axes
        !   |
        ! 2 | rotary_order = ["A"]
        !   |                 ^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[machine]\nrotary_order = [\"A\", \"A\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:22: rotary_order names two different axes
        !   |
        ! 2 | rotary_order = ["A", "A"]
        !   |                      ^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[machine]\nrotary_order = [\"A\", \"B\", \"C\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:27: rotary_order names two different axes
        !   |
        ! 2 | rotary_order = ["A", "B", "C"]
        !   |                           ^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[machine]\nrotary_order = [\"X\", \"B\"]\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:17: `X` is not a rotary axis
        !   |
        ! 2 | rotary_order = ["X", "B"]
        !   |                 ^^^
        exit 2
    "#]],
    );
    check_configuration(
        "[machine]\nrotary_sign = { A = 2 }\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:2:21: a sense of rotation is 1 or -1
        !   |
        ! 2 | rotary_sign = { A = 2 }
        !   |                     ^
        exit 2
    "#]],
    );
}

/// Checks that a program is not checked with such a configuration, and the first line that says why.
fn check_refused(tables: &[(&str, &str)], expected: &Expect) {
    let mut messages = String::new();
    for (control, table) in tables {
        let config = format!("control = \"{control}\"\n{table}\n");
        let shop = Shop::with(&[("part.nc", GOOD), ("gcheck.toml", &config)]);
        let run = shop.gcheck("check part.nc");
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{table}: {run}");
        let first = run.stderr.lines().next().unwrap_or_default();
        let _ = writeln!(messages, "{}\n  {first}", table.replace('\n', " | "));
    }
    expected.assert_eq(&messages);
}

/// Each was accepted without a word, or no machine has it.
#[test]
fn figures_and_axes_that_no_machine_has() {
    check_refused(
        &[
            ("haas-mill", "[machine]\naxes = []"),
            ("haas-mill", "[machine]\ntravel = { X = [nan, 5.0] }"),
            ("haas-mill", "[machine]\ntravel = { X = [0.0, inf] }"),
            ("haas-mill", "[machine]\ntravel = { X = [0.0, 1.0], x = [0.0, 2.0] }"),
            ("haas-mill", "[machine]\nrapid = { X = 1000.0, x = 2.0 }"),
            ("haas-mill", "[offsets]\nG54 = { X = 1.0, x = 2.0 }"),
            ("haas-mill", "[machine]\nfeed_override = 0"),
            ("haas-mill", "[machine]\nfeed_override = 5000"),
            ("generic-mill", "[machine]\nfeed_override = 5000"),
            ("haas-mill", "[machine]\nacceleration = 1000.0\njerk = 1e-9"),
            ("haas-mill", "[machine]\njerk = 50000.0"),
            ("haas-mill", "[machine]\nacceleration = { A = 100.0 }"),
            ("haas-mill", "[machine]\nacceleration = 1e30"),
            ("haas-mill", "[machine]\nunits = \"inch\"\nacceleration = { X = 1e30 }"),
            ("haas-mill", "[machine]\nspindle_acceleration = 1"),
            ("haas-mill", "[machine]\nspindle_acceleration = 1e20"),
            ("haas-mill", "[machine]\ntool_change_seconds = 1e9"),
            ("haas-mill", "[machine]\nspindle_orient_seconds = 1e4"),
            ("haas-mill", "[machine]\npockets = 4000000000"),
            ("haas-mill", "[machine]\naxes = [\"X\", \"Y\", \"Z\"]\ntravel = { A = [0.0, 90.0] }"),
            ("haas-mill", "[machine]\naxes = [\"X\", \"Y\", \"Z\", \"A\"]\nrotary_order = [\"A\", \"B\"]"),
            ("haas-mill", "[machine]\naxes = [\"X\", \"Y\", \"Z\", \"A\"]\nrotary = \"table-table\""),
            ("haas-mill", "[machine]\nrotary_sign = { X = 1 }"),
            ("haas-mill", "[tools]\n1 = { surface_speed = [60.0, 140.0] }"),
            ("haas-mill", "[tools]\n1 = { diameter = 0.0, surface_speed = [60.0, 140.0] }"),
            ("grbl", "[machine]\npreset = \"sherline-5400\"\nunits = \"inch\"\nmax_feed = 900.0"),
        ],
        &expect![[r#"
        [machine] | axes = []
          error: gcheck.toml:3:8: `axes` is empty: a machine has at least one axis
        [machine] | travel = { X = [nan, 5.0] }
          error: gcheck.toml:3:16: travel of X must have two finite ends
        [machine] | travel = { X = [0.0, inf] }
          error: gcheck.toml:3:16: travel of X must have two finite ends
        [machine] | travel = { X = [0.0, 1.0], x = [0.0, 2.0] }
          error: gcheck.toml:3:28: the axis X is listed twice
        [machine] | rapid = { X = 1000.0, x = 2.0 }
          error: gcheck.toml:3:23: the axis X is listed twice
        [offsets] | G54 = { X = 1.0, x = 2.0 }
          error: gcheck.toml:3:18: the axis X is listed twice
        [machine] | feed_override = 0
          error: gcheck.toml:3:17: a feed override is above 0 and at most 999 percent
        [machine] | feed_override = 5000
          error: gcheck.toml:3:17: a feed override is above 0 and at most 999 percent
        [machine] | feed_override = 5000
          error: gcheck.toml:3:17: the feed override of generic-mill has 0 to 150 percent in steps of 10  [TSNC-YH-A1M operation manual p.17]
        [machine] | acceleration = 1000.0 | jerk = 1e-9
          error: gcheck.toml:4:8: the jerk of an axis is 0.04 to 1000000000 units a second cubed, not 0.000000001
        [machine] | jerk = 50000.0
          error: gcheck.toml:3:8: `jerk` has no effect without `acceleration`: it is how quickly that changes
        [machine] | acceleration = { A = 100.0 }
          error: gcheck.toml:3:16: `acceleration` names no linear axis: times come from it only where X, Y and Z have one
        [machine] | acceleration = 1e30
          error: gcheck.toml:3:16: the acceleration of an axis is 0.04 to 1000000 units a second squared, not 1000000000000000000000000000000
        [machine] | units = "inch" | acceleration = { X = 1e30 }
          error: gcheck.toml:4:22: the acceleration of X is 0.04 to 39370 inch a second squared, not 1000000000000000000000000000000
        [machine] | spindle_acceleration = 1
          error: gcheck.toml:3:24: a spindle gains 5 to 1000000 1/min in a second, not 1
        [machine] | spindle_acceleration = 1e20
          error: gcheck.toml:3:24: a spindle gains 5 to 1000000 1/min in a second, not 100000000000000000000
        [machine] | tool_change_seconds = 1e9
          error: gcheck.toml:3:23: must be at most 3600: it counts in seconds
        [machine] | spindle_orient_seconds = 1e4
          error: gcheck.toml:3:26: must be at most 60: it counts in seconds
        [machine] | pockets = 4000000000
          error: gcheck.toml:3:11: a magazine has at most 1000 pockets
        [machine] | axes = ["X", "Y", "Z"] | travel = { A = [0.0, 90.0] }
          error: gcheck.toml:4:12: `A` is not among the machine's `axes`: X, Y, Z
        [machine] | axes = ["X", "Y", "Z", "A"] | rotary_order = ["A", "B"]
          error: gcheck.toml:4:22: `B` is not among the machine's `axes`: X, Y, Z, A
        [machine] | axes = ["X", "Y", "Z", "A"] | rotary = "table-table"
          error: gcheck.toml:4:10: `rotary` is for machines with two rotary axes, and `axes` lists X, Y, Z, A
        [machine] | rotary_sign = { X = 1 }
          error: gcheck.toml:3:17: `X` is not a rotary axis
        [tools] | 1 = { surface_speed = [60.0, 140.0] }
          error: gcheck.toml:3:23: a surface speed needs the tool's `diameter`, above zero
        [tools] | 1 = { diameter = 0.0, surface_speed = [60.0, 140.0] }
          error: gcheck.toml:3:39: a surface speed needs the tool's `diameter`, above zero
        [machine] | preset = "sherline-5400" | units = "inch" | max_feed = 900.0
          error: gcheck.toml:5:12: max_feed is 900, and the preset `sherline-5400` has a rapid rate of 25: no axis cuts faster than it moves at rapid
    "#]],
    );
}

#[test]
fn directions_that_no_axis_turns_about() {
    check_refused(
        &[
            ("haas-mill", "[machine]\nrotary_direction = { X = [0.0, 1.0, 1.0] }"),
            ("haas-mill", "[machine]\nrotary_direction = { B = [0.0, 0.0, 0.0] }"),
            ("haas-mill", "[machine]\nrotary_direction = { B = [0.0, nan, 1.0] }"),
            ("haas-mill", "[machine]\nrotary_direction = { B = [inf, 0.0, 1.0] }"),
            ("haas-mill", "[machine]\nrotary_direction = { B = [0.0, 1.0] }"),
            ("haas-mill", "[machine]\nrotary_direction = { B = [0.0, 1.0, 1.0], b = [0.0, 1.0, 0.0] }"),
            (
                "haas-mill",
                "[machine]\naxes = [\"X\", \"Y\", \"Z\", \"A\"]\nrotary_direction = { B = [0.0, 1.0, 1.0] }",
            ),
            (
                "haas-mill",
                "[machine]\nrotary_order = [\"C\", \"B\"]\nrotary_direction = { B = [0.0, 0.0, -2.0] }",
            ),
        ],
        &expect![[r#"
        [machine] | rotary_direction = { X = [0.0, 1.0, 1.0] }
          error: gcheck.toml:3:22: `X` is not a rotary axis
        [machine] | rotary_direction = { B = [0.0, 0.0, 0.0] }
          error: gcheck.toml:3:26: [0, 0, 0] is not a direction: an axis turns about a line
        [machine] | rotary_direction = { B = [0.0, nan, 1.0] }
          error: gcheck.toml:3:26: [0, NaN, 1] is not a direction: an axis turns about a line
        [machine] | rotary_direction = { B = [inf, 0.0, 1.0] }
          error: gcheck.toml:3:26: [inf, 0, 1] is not a direction: an axis turns about a line
        [machine] | rotary_direction = { B = [0.0, 1.0] }
          error: gcheck.toml:3:26: invalid length 2, expected an array of length 3
        [machine] | rotary_direction = { B = [0.0, 1.0, 1.0], b = [0.0, 1.0, 0.0] }
          error: gcheck.toml:3:43: the axis B is listed twice
        [machine] | axes = ["X", "Y", "Z", "A"] | rotary_direction = { B = [0.0, 1.0, 1.0] }
          error: gcheck.toml:4:22: `B` is not among the machine's `axes`: X, Y, Z, A
        [machine] | rotary_order = ["C", "B"] | rotary_direction = { B = [0.0, 0.0, -2.0] }
          error: gcheck.toml:4:26: both axes of rotary_order turn about parallel lines
    "#]],
    );
}

#[test]
fn a_list_of_axes_names_each_once_and_those_of_the_machine() {
    for (list, message) in [
        ("axes = [\"X\", \"Y\", \"x\"]", "3:19: the axis X is listed twice"),
        ("rotary_shorter_way = [\"C\", \"c\"]", "3:28: the axis C is listed twice"),
        ("rotary_shorter_way = [\"X\"]", "3:23: `X` is not a rotary axis"),
        (
            "axes = [\"X\", \"Z\", \"A\"]\nrotary_shorter_way = [\"A\", \"C\"]",
            "4:28: `C` is not among the machine's `axes`: X, Z, A",
        ),
    ] {
        let config = format!("control = \"haas-mill\"\n[machine]\n{list}\n");
        let shop = Shop::with(&[("part.nc", GOOD), ("gcheck.toml", &config)]);
        let run = shop.gcheck("check part.nc");
        let first = run.stderr.lines().next().unwrap_or_default();
        assert_eq!((run.code, first), (2, format!("error: gcheck.toml:{message}").as_str()), "{list}");
    }
}

/// What one machine has and another lacks, and figures that shops write.
#[test]
fn figures_of_real_machines_are_taken() {
    for (control, table) in [
        (
            "haas-mill",
            "[machine]\nunits = \"inch\"\nrapid = 1000.0\nacceleration = 40.0\njerk = 4000.0\nspindle_acceleration = 4000",
        ),
        (
            "haas-mill",
            "[machine]\nunits = \"mm\"\nacceleration = { X = 5000.0, A = 2000.0 }\ntool_change_seconds = 90",
        ),
        (
            "haas-mill",
            "[machine]\naxes = [\"x\", \"Y\", \"Z\", \"B\", \"C\"]\nrotary = \"table-table\"\nrotary_order = [\"B\", \"c\"]\ntravel = { X = [0.0, 9.0] }",
        ),
        ("haas-mill", "[machine]\nfeed_override = 120\npockets = 40"),
        ("generic-mill", "[machine]\nfeed_override = 0"),
        ("haas-lathe", "[tools]\n1 = { surface_speed = [60.0, 140.0] }"),
        ("linuxcnc", "[tools]\n1 = { surface_speed = [60.0, 140.0] }"),
        ("haas-mill", "[tools]\n1 = { diameter = -0.02 }\n2 = { diameter = 0.0 }"),
    ] {
        let config = format!("control = \"{control}\"\n{table}\n");
        let shop = Shop::with(&[("part.nc", GOOD), ("gcheck.toml", &config)]);
        let run = shop.gcheck("check part.nc");
        assert!(run.code < 2, "{table}: {run}");
    }
}

/// A part of a machine may come with the command line, or with another file.
#[test]
fn what_one_text_leaves_out_another_may_give() {
    let shop = Shop::with(&[
        ("part.nc", GOOD),
        ("gcheck.toml", "control = \"haas-mill\"\n[machine]\nacceleration = 1000.0\n"),
    ]);
    let run = shop.gcheck("check part.nc --config machine.jerk=50000.0");
    assert!(run.code < 2, "{run}");
    let shop = Shop::with(&[("part.nc", GOOD)]);
    expect![[r#"
        ! error: [machine] `jerk` has no effect without `acceleration`: it is how quickly that changes
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check part.nc --control haas-mill --config machine.jerk=50000.0").to_string());
}

/// Each mistake is named at its place, whoever says which control it is.
#[test]
fn values_are_held_to_the_control_whoever_names_it() {
    for (table, place, message) in [
        ("[offsets]\nG53 = { X = 1.0 }", "2:1", "`G53` is not a work offset"),
        ("[offsets]\nG999 = { X = 1.0 }", "2:1", "`G999` is not a work offset"),
        ("[offsets]\n\"G154 P9999\" = { X = 1.0 }", "2:1", "`G154 P9999` is not a work offset"),
        ("[settings]\n40 = \"foo\"", "2:6", "setting 40 (tool offset measure) is one of"),
        ("[machine]\nfeed_override = 0", "2:17", "a feed override is above 0"),
        (
            "[[overrides]]\nfiles = [\"*.nc\"]\nsettings.40 = \"foo\"",
            "3:15",
            "setting 40 (tool offset measure)",
        ),
    ] {
        let with = |config: &str, arguments: &str, program: &str| {
            let shop = Shop::with(&[("part.nc", program), ("gcheck.toml", config)]);
            ["check", "run", "stats"].map(|command| shop.gcheck(&format!("{command} part.nc {arguments}")))
        };
        let detected = GOOD.replace("(GOOD)", "(VF-2)");
        let own = format!("{table}\n");
        for run in with(&own, "--control haas-mill", GOOD).into_iter().chain(with(&own, "", &detected)) {
            assert_eq!(run.code, 2, "{table}: {run}");
            let told = format!("error: gcheck.toml:{place}: {message}");
            assert!(run.stderr.contains(&told), "{table}: {run}");
        }
        for run in with(&format!("control = \"haas-mill\"\n{table}\n"), "", GOOD) {
            assert!(run.code == 2 && run.stderr.contains(message), "{table}: {run}");
        }
    }
}

/// What one control of a folder has is not wrong for the programs of another.
#[test]
fn what_another_control_of_the_folder_has_is_taken() {
    let config = "[offsets]\n\"G154 P2\" = { X = 1.0 }\n[settings]\n162 = false\n";
    let shop = Shop::with(&[("part.ngc", "G21 G90\nG0 X1\nM2\n"), ("gcheck.toml", config)]);
    let run = shop.gcheck("check part.ngc --control linuxcnc");
    assert!(run.code < 2, "{run}");
}

#[test]
fn figures_that_no_machine_has() {
    for (table, place, message) in [
        ("[machine]\nrapid = 1e308", "2:9", "no axis moves 1e308 units a minute"),
        ("[machine]\nunits = \"mm\"\nrapid = { X = 1e10 }", "3:15", "no axis moves 1e10 mm a minute"),
        ("[machine]\nmax_feed = 1e300", "2:12", "no axis moves 1e300 units a minute"),
        ("[machine]\nmax_rpm = 1e300", "2:11", "no spindle turns 1e300 times a minute"),
        ("[machine]\ntravel.X = [-1e300, 1e300]", "2:12", "no axis goes to -1e300"),
        ("[machine]\nbar_length = 1e300", "2:14", "a length is at most"),
        ("[offsets]\nG54 = { X = 1e300 }", "2:9", "X is at most 1000000 units, not 1e300"),
        ("[tools]\n1 = { length = 1e300 }", "2:1", "a size of a tool is at most 10000 units, not 1e300"),
        (
            "[tools]\n1 = { diameter = 10.0, corner_radius = 6.0 }",
            "2:1",
            "the corner radius 6 is larger than half",
        ),
    ] {
        let shop = Shop::with(&[("part.nc", GOOD), ("gcheck.toml", &format!("{table}\n"))]);
        let run = shop.gcheck("check part.nc");
        let told = format!("error: gcheck.toml:{place}: {message}");
        assert!(run.code == 2 && run.stderr.contains(&told), "{table}: {run}");
    }
}

#[test]
fn a_list_that_is_empty_is_named_with_its_line() {
    check_configuration(
        "[machine]\nunits = \"mm\"\naxes = []\n",
        &expect![[r#"
        sound/a.nc:3:1: error[unknown-code] unknown code `G999`
        ! error: shop/gcheck.toml:3:8: `axes` is empty: a machine has at least one axis
        !   |
        ! 3 | axes = []
        !   |        ^^
        exit 2
    "#]],
    );
}

#[test]
fn an_output_format_that_is_misspelt() {
    check_arguments(
        "check part.nc -o sarfi=x.json",
        &expect![[r#"
        ! error: invalid value 'sarfi=x.json' for '--output-file <[FORMAT=]FILE>': no format is called `sarfi`; did you mean `sarif`? A file of this name is `./sarfi=x.json`
        ! 
        ! For more information, try '--help'.
        exit 2
    "#]],
    );
    let shop = Shop::with(&[("part.nc", GOOD)]);
    let run = shop.gcheck("check part.nc --control haas-mill -o ./sarfi=x.json -q");
    assert_eq!((run.code, shop.names().contains(&"sarfi=x.json".to_owned())), (0, true), "{run}");
    let run = shop.gcheck("check part.nc --control haas-mill -o report=x.txt -q");
    assert_eq!((run.code, shop.names().contains(&"report=x.txt".to_owned())), (0, true), "{run}");
}

#[test]
fn numbers_of_options_in_words() {
    check_arguments(
        "run part.nc --control haas-mill --fuel 1.5",
        &expect![[r#"
        ! error: invalid value '1.5' for '--fuel <BLOCKS>': write a whole number of blocks, such as `1000000` or `1e6`
        ! 
        ! For more information, try '--help'.
        exit 2
    "#]],
    );
    check_arguments(
        "check part.nc --fuel -3",
        &expect![[r#"
        ! error: invalid value '-3' for '--fuel <BLOCKS>': write a whole number of blocks, such as `1000000` or `1e6`
        ! 
        ! For more information, try '--help'.
        exit 2
    "#]],
    );
    check_arguments(
        "check part.nc --max-warnings -1",
        &expect![[r#"
        ! error: invalid value '-1' for '--max-warnings <N>': write a whole number from 0
        ! 
        ! For more information, try '--help'.
        exit 2
    "#]],
    );
    check_arguments(
        "diff part.nc part.nc --tolerance 1e9",
        &expect![[r#"
        ! error: invalid value '1e9' for '--tolerance <MM>': within 100 mm any two paths may be the same; write a smaller length
        ! 
        ! For more information, try '--help'.
        exit 2
    "#]],
    );
    let shop = Shop::with(&[("part.nc", GOOD)]);
    for fuel in ["1e6", "1_000_000", "1000000"] {
        assert_eq!(shop.gcheck(&format!("run part.nc --control haas-mill --fuel {fuel}")).code, 0, "{fuel}");
    }
}

#[test]
fn two_pages_at_once() {
    let shop = Shop::with(&[("part.nc", GOOD)]);
    let run = shop.gcheck("check --show-files --show-settings");
    assert!(run.code == 2 && run.stderr.contains("cannot be used with"), "{run}");
}

#[test]
fn marks_of_a_tape_alone() {
    check_content(
        b"%\n%\n",
        &expect![[r#"
        other.nc:3:1: error[unknown-code] unknown code `G999`
        part.nc:1:1: info[empty-program] program has no block between its `%`
        exit 1
    "#]],
    );
}

#[test]
fn a_list_of_files_has_comments() {
    let shop = Shop::with(&[("part.nc", BAD), ("list.txt", "# changed today\npart.nc\n\n#other.nc\n")]);
    let run = shop.gcheck("check --files-from list.txt --control haas-mill --output-format concise -q");
    assert_eq!((run.code, run.rules()), (1, vec!["unknown-code".to_owned()]), "{run}");
}

#[test]
fn nothing_is_done_by_no_threads_or_with_no_fuel() {
    let shop = Shop::with(&[("good.nc", GOOD)]);
    for (command, says) in [
        ("check --jobs 0", "write a whole number from 1"),
        ("check --jobs -1", "write a whole number from 1"),
        ("fmt --jobs 0", "write a whole number from 1"),
        ("check --fuel 0", "nothing is executed with 0 blocks"),
        ("run good.nc --fuel 0", "nothing is executed with 0 blocks"),
    ] {
        let run = shop.gcheck(command);
        assert!(run.code == 2 && run.stderr.contains(says), "{command}: {run}");
    }
    assert_eq!(shop.gcheck("check --jobs 1 --fuel 1").code, 0);
}

#[test]
fn a_picture_with_the_name_of_a_program_is_not_one() {
    let shop = Shop::new();
    shop.file("x.nc", b"\x89PNG\r\n\x1A\n\0\0");
    let run = shop.gcheck("check x.nc");
    assert!(run.code == 2 && run.stderr.contains("x.nc: is not text, so it is not a part program"), "{run}");
}
