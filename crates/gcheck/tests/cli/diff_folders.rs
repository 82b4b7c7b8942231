//! `gcheck diff` of two folders: which programs belong together, what is accepted, exit codes and formats.

use expect_test::expect;
use serde_json::Value;

use crate::shop::{Run, Shop};

/// A program that cuts two sides with tool 1, and drills with tool 2.
fn program(number: u32, first: &str, second: &str) -> String {
    format!(
        "%\nO{number}\nG21 G17 G90 G94 G54\nT1 M6\nG0 X0. Y0. S1000 M3\nG43 H1 Z5.\nG1 Z-1. F200.\n{first}\nG0 Z50.\n\
         T2 M6\nG0 X0. Y0. S900 M3\nG43 H2 Z5.\n{second}\nG0 Z50.\nM30\n%\n"
    )
}

const SIDE: &str = "X50.\nY20.";
const HOLE: &str = "G81 X5. Y5. Z-5. R2. F100.\nG80";

/// Folders `old` and `new` with the same program under one path, and others.
fn shop(files: &[(&str, &str)]) -> Shop {
    let plate = program(1, SIDE, HOLE);
    let shop = Shop::with(&[("old/plate.nc", &plate), ("new/plate.nc", &plate)]);
    for (name, text) in files {
        shop.file(name, text);
    }
    shop
}

fn diff(shop: &Shop, arguments: &str) -> Run {
    shop.gcheck(&format!("diff old new --control fanuc-mill -q {arguments}"))
}

#[test]
fn programs_are_paired_by_path_content_number_and_name() {
    let (lid, rib, pin) = (program(2, "X10.", HOLE), program(3, "X20.", HOLE), program(4, "X30.", HOLE));
    let shop = shop(&[
        ("old/a/lid.nc", &lid),
        ("new/b/cover.nc", &lid),
        ("old/rib.nc", &rib),
        ("new/O0003.nc", &rib.replace("X20.", "X20.000")),
        ("old/a/pin.nc", &pin.replace("O4", "")),
        ("new/b/pin.nc", &pin.replace("O4\n", "")),
    ]);
    let run = diff(&shop, "--output-format json");
    let json: Value = serde_json::from_str(&run.stdout).unwrap();
    let pairs: Vec<String> = json["pairs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|pair| format!("{} {} {}", pair["a"], pair["b"], pair["paired_by"]).replace('"', ""))
        .collect();
    expect![[r#"
        old/a/lid.nc new/b/cover.nc content
        old/a/pin.nc new/b/pin.nc name
        old/plate.nc new/plate.nc path
        old/rib.nc new/O0003.nc program-number"#]]
    .assert_eq(&pairs.join("\n"));
    assert_eq!((run.code, &json["same"]), (0, &Value::from(4)), "{}", run.stdout);
    // The text names the partner of a program that is not at the same path, where it names the program.
    shop.file("new/O0003.nc", rib.replace("F100.", "F120."));
    let run = diff(&shop, "");
    let of =
        |start: &str| run.stdout.lines().find(|line| line.starts_with(start)).unwrap_or_default().to_owned();
    assert!(of("rib.nc").ends_with("  (with new/O0003.nc, by program number)"), "{}", run.stdout);
    assert_eq!(of("pairs at"), "pairs at different paths: 1 by content, 1 by program number, 1 by name");
}

#[test]
fn a_changed_tool_is_one_difference_and_the_next_tool_is_compared_again() {
    let shop = shop(&[
        ("new/plate.nc", &program(1, "X50.\nY20.5\nX0.", &HOLE.replace("F100.", "F150."))),
        ("old/gone.nc", &program(7, SIDE, HOLE)),
        ("new/more.nc", &program(8, "X1.", HOLE)),
    ]);
    let run = diff(&shop, "");
    expect![[r#"
        plate.nc  differs: path, feed  [digest 1e045be3]
            tool section T1 changed: the paths part at X50 Y20 Z-1
              - old/plate.nc:10  to X50 Y20 Z50   | G0 Z50.
              + new/plate.nc:9  to X50 Y20.5 Z-1   | Y20.5
              compared again from tool 2 on (old/plate.nc:11, new/plate.nc:12)
            the feed differs, once
              - old/plate.nc:14  100 mm/min   | G81 X5. Y5. Z-5. R2. F100.
              + new/plate.nc:15  150 mm/min   | G81 X5. Y5. Z-5. R2. F150.
            old/plate.nc and new/plate.nc move differently; from there to the next tool change they are not compared
        gone.nc  only in old
        more.nc  only in new
        1 pair of programs compared, within 0.001 mm: 0 the same, 1 different, 1 only in old, 1 only in new
    "#]]
    .assert_eq(&run.stdout);
    assert_eq!(run.code, 1);
}

#[test]
fn a_retract_of_another_height_is_a_difference_of_that_tool_alone() {
    // The first program is at its retract height already, and goes on to the next tool change at once.
    let [stays, moves] = ["G0 Z50.\nG0 Z50.", "G0 Z50.\nG0 Z40."]
        .map(|end| program(1, SIDE, HOLE).replacen("Y20.\nG0 Z50.", &format!("Y20.\n{end}"), 1));
    let run = diff(&shop(&[("old/plate.nc", &stays), ("new/plate.nc", &moves)]), "");
    expect![[r#"
        plate.nc  differs: path  [digest aef908b7]
            tool section T1 changed: the paths part at X50 Y20 Z50
              - old/plate.nc:13  to X0 Y0 Z50   | G0 X0. Y0. S900 M3
              + new/plate.nc:11  to X50 Y20 Z40   | G0 Z40.
              compared again from tool 2 on (old/plate.nc:12, new/plate.nc:12)
            old/plate.nc and new/plate.nc move differently; from there to the next tool change they are not compared
        1 pair of programs compared, within 0.001 mm: 0 the same, 1 different
    "#]]
    .assert_eq(&run.stdout);
}

#[test]
fn an_added_section_is_named_and_can_be_accepted() {
    let more =
        program(1, SIDE, HOLE).replace("M30", "T9 M6\nG0 X80. Y0. S900 M3\nG43 H9 Z5.\nG1 Z-1. F100.\nM30");
    let shop = shop(&[("new/plate.nc", &more)]);
    shop.file(
        "ok.toml",
        "[[accepted]]\nfile = \"plate.nc\"\ndifferences = [\"section-added\"]\nreason = \"chamfered now\"\n",
    );
    let run = diff(&shop, "");
    assert!(
        run.code == 1 && run.stdout.starts_with("plate.nc  differs: section-added  [digest "),
        "{}",
        run.stdout
    );
    let run = diff(&shop, "--accepted ok.toml");
    assert!(
        run.code == 0 && run.stdout.contains("accepted: section-added (chamfered now)"),
        "{}",
        run.stdout
    );
    let run = diff(&shop, "--output-format github");
    assert!(
        run.stdout.contains("line=17,") && run.stdout.contains("tool section T9 is only in new/plate.nc"),
        "{}",
        run.stdout
    );
}

#[test]
fn what_is_accepted_passes_until_its_date() {
    let shop = shop(&[("new/plate.nc", &program(1, SIDE, &HOLE.replace("F100.", "F150.")))]);
    assert_eq!(diff(&shop, "").code, 1);
    let accept = |rest: &str| {
        let text = format!("[[accepted]]\nfile = \"*.nc\"\n{rest}\nreason = \"drills run faster now\"\n");
        shop.file("accepted.toml", text);
        diff(&shop, "--accepted accepted.toml")
    };
    let run = accept("differences = [\"feed\"]");
    expect![[r#"
        plate.nc  accepted: feed (drills run faster now)  [digest 84c0fc4c]
        1 pair of programs compared, within 0.001 mm: 0 the same, 1 accepted
    "#]]
    .assert_eq(&run.stdout);
    assert_eq!(run.code, 0);
    assert_eq!(accept("until = 2999-12-31").code, 0);
    let run = accept("until = 2020-01-31");
    assert!(run.code == 1 && run.stdout.contains("(was accepted until 2020-01-31)"), "{}", run.stdout);
    assert_eq!(accept("differences = [\"path\"]").code, 1);
    assert_eq!(accept("digest = \"00000000\"").code, 1);
}

#[test]
fn an_accepted_difference_says_what_was_not_compared_after_it() {
    let shop = shop(&[("new/plate.nc", &program(1, "X50.\nY20.5", HOLE))]);
    shop.file("ok.toml", "[[accepted]]\nfile = \"plate.nc\"\nreason = \"seen\"\n");
    let run = diff(&shop, "--accepted ok.toml");
    expect![[r#"
        plate.nc  accepted: path (seen); from there to the next tool change they are not compared  [digest 961de347]
        1 pair of programs compared, within 0.001 mm: 0 the same, 1 accepted, of which a part was not compared
    "#]].assert_eq(&run.stdout);
    assert_eq!(run.code, 0);
    let changed = program(1, "X50.\nY20.5", HOLE).replace("T2 M6", "T3 M6");
    shop.file("new/plate.nc", changed);
    let run = diff(&shop, "--accepted ok.toml");
    assert!(run.stdout.contains("accepted: path, tool (seen); from there to the next"), "{}", run.stdout);
}

/// Cuts from a place that nobody knows.
const UNKNOWN: &str = "G21 G90\nG1 X500. F100.\nG1 Y5.\nM30\n";

#[test]
fn what_could_not_be_compared_is_part_of_the_verdict_in_every_format() {
    let shop = shop(&[("old/a.nc", UNKNOWN), ("new/a.nc", &UNKNOWN.replace("Y5.", "Y5.0"))]);
    let run = diff(&shop, "");
    expect![[r#"
        a.nc  the same as far as known: some cutting moves start or end at unknown coordinates, which were not compared
        2 pairs of programs compared, within 0.001 mm: 1 the same, 1 the same as far as known
    "#]].assert_eq(&run.stdout);
    assert_eq!(run.code, 0);
    let json: Value = serde_json::from_str(&diff(&shop, "--output-format json").stdout).unwrap();
    assert_eq!((&json["same"], &json["same_as_far_as_known"]), (&1.into(), &1.into()));
    assert_eq!(json["pairs"][0]["verdict"], "same-as-far-as-known");
    let run = diff(&shop, "--output-format junit");
    expect![[r#"
        <?xml version="1.0" encoding="UTF-8"?>
        <testsuites name="gcheck" tests="2" failures="0" errors="0">
          <testsuite name="new/a.nc" tests="1" failures="0" errors="0" file="new/a.nc">
            <testcase name="1:1 program-partly-compared" classname="new/a.nc">
              <system-out>new/a.nc:1:1: info[program-partly-compared] the same as far as known: some cutting moves start or end at unknown coordinates, which were not compared</system-out>
            </testcase>
          </testsuite>
          <testsuite name="new/plate.nc" tests="1" failures="0" errors="0" file="new/plate.nc">
            <testcase name="makes the machine do the same" classname="new/plate.nc"/>
          </testsuite>
        </testsuites>
    "#]].assert_eq(&run.stdout);
    let run = diff(&shop, "--output-format github");
    expect![[r#"
        ::notice title=gcheck (program-partly-compared),file=new/a.nc,line=1,endLine=1,col=1,endColumn=8::the same as far as known: some cutting moves start or end at unknown coordinates, which were not compared
    "#]].assert_eq(&run.stdout);
    let run = diff(&shop, "--output-format html");
    assert!(run.stdout.contains("the same as far as known: some cutting moves"), "{}", run.stdout);
}

#[test]
fn a_strict_gate_passes_only_what_was_compared_as_a_whole() {
    let shop = shop(&[("old/a.nc", UNKNOWN), ("new/a.nc", &UNKNOWN.replace("Y5.", "Y5.0"))]);
    for what in ["old new", "old/a.nc new/a.nc", "old/a.nc new/a.nc --output-format junit"] {
        let run = |strict| shop.gcheck(&format!("diff {what} --control fanuc-mill -q {strict}")).code;
        assert_eq!((run(""), run("--strict")), (0, 1), "{what}");
    }
    let run = diff(&shop, "--strict --output-format junit");
    assert!(run.stdout.contains("failures=\"1\""), "{}", run.stdout);
    assert_eq!(shop.gcheck("diff old/plate.nc new/plate.nc --control fanuc-mill -q --strict").code, 0);
}

#[test]
fn the_controls_of_folders_are_named_in_groups() {
    let shop = shop(&[
        ("old/gcheck.toml", "control = \"fanuc-mill\"\n"),
        ("new/gcheck.toml", "control = \"haas-mill\"\n"),
    ]);
    let run = shop.gcheck("diff old new");
    expect![[r#"
        new/plate.nc: control haas-mill, set in new/gcheck.toml
        old/plate.nc: control fanuc-mill, set in old/gcheck.toml
    "#]]
    .assert_eq(&run.stderr);
}

#[test]
fn a_digest_names_these_very_differences() {
    let shop = shop(&[("new/plate.nc", &program(1, SIDE, &HOLE.replace("F100.", "F150.")))]);
    let run = diff(&shop, "");
    let digest = run.stdout.split("[digest ").nth(1).and_then(|rest| rest.split(']').next()).unwrap();
    shop.file(
        "ok.toml",
        format!("[[accepted]]\nfile = \"plate.nc\"\ndigest = \"{digest}\"\nreason = \"seen\"\n"),
    );
    assert_eq!(diff(&shop, "--accepted ok.toml").code, 0);
    shop.file("new/plate.nc", program(1, SIDE, &HOLE.replace("F100.", "F180.")));
    assert_eq!(diff(&shop, "--accepted ok.toml").code, 1);
}

#[test]
fn mistakes_in_the_list_are_told_with_their_place() {
    let shop = shop(&[]);
    for (text, message) in [
        ("[[accepted]]\nfile = \"a.nc\"\n", "the key `reason` is missing"),
        ("[[accepted]]\nfile = \"a.nc\"\nreason = \" \"\n", "an accepted difference needs a reason"),
        ("[[accepted]]\nfile = \"[a\"\nreason = \"b\"\n", "`[a` is not a pattern"),
        ("[[accepted]]\nfile = \"a\"\ndifferences = [\"fed\"]\nreason = \"b\"\n", "unknown difference `fed`"),
        ("[[accepted]]\nfile = \"a\"\nuntil = 12:00:00\nreason = \"b\"\n", "`until` is a date"),
        (
            "[[accepted]]\nfile = \"a\"\nuntil = \"2020-01-01\"\nreason = \"b\"\n",
            "write it without quotes: `until = 2027-06-30`",
        ),
        ("[[accepted]]\nfiles = \"a\"\nreason = \"b\"\n", "unknown key `files`; did you mean `file`?"),
    ] {
        shop.file("list.toml", text);
        let run = diff(&shop, "--accepted list.toml");
        assert!(
            run.code == 2 && run.stderr.contains("list.toml:") && run.stderr.contains(message),
            "{}",
            run.stderr
        );
    }
    shop.file("list.toml", "[[accepted]]\nfile = \"none.nc\"\nreason = \"b\"\n");
    let run = shop.gcheck("diff old new --control fanuc-mill --accepted list.toml");
    assert!(run.code == 0 && run.stderr.contains("list.toml:2: accepts nothing"), "{}", run.stderr);
}

#[test]
fn a_program_without_a_verdict_fails_and_the_others_are_compared() {
    let shop = shop(&[
        ("old/stops.nc", &program(5, SIDE, HOLE)),
        ("new/stops.nc", &program(5, SIDE, "G2 X9. Y9. I1. J0.")),
    ]);
    let run = diff(&shop, "");
    assert_eq!(run.code, 2, "{}", run.stdout);
    assert!(run.stdout.contains("stops.nc  no verdict: "), "{}", run.stdout);
    assert!(
        run.stdout
            .ends_with("2 pairs of programs compared, within 0.001 mm: 1 the same, 1 without a verdict\n")
    );
}

#[test]
fn ci_servers_get_their_formats() {
    let shop = shop(&[
        ("new/plate.nc", &program(1, "X50.\nY21.", HOLE)),
        ("old/same.nc", &program(2, SIDE, HOLE)),
        ("new/same.nc", &program(2, SIDE, HOLE)),
        ("new/more.nc", &program(8, "X1.", HOLE)),
    ]);
    let run = diff(&shop, "--output-format junit");
    expect![[r#"
        <?xml version="1.0" encoding="UTF-8"?>
        <testsuites name="gcheck" tests="3" failures="2" errors="0">
          <testsuite name="new/more.nc" tests="1" failures="1" errors="0" file="new/more.nc">
            <testcase name="1:1 program-added" classname="new/more.nc">
              <failure type="error" message="the program is in the second folder only">new/more.nc:1:1: error[program-added] the program is in the second folder only</failure>
            </testcase>
          </testsuite>
          <testsuite name="new/plate.nc" tests="1" failures="1" errors="0" file="new/plate.nc">
            <testcase name="9:1 program-differs" classname="new/plate.nc">
              <failure type="error" message="differs: path">new/plate.nc:9:1: error[program-differs] differs: path
        note: tool section T1 changed: the paths part at X50 Y20 Z-1
          - old/plate.nc:10  to X50 Y20 Z50   | G0 Z50.
          + new/plate.nc:9  to X50 Y21 Z-1   | Y21.
          compared again from tool 2 on (old/plate.nc:11, new/plate.nc:11)
        old/plate.nc and new/plate.nc move differently; from there to the next tool change they are not compared</failure>
            </testcase>
          </testsuite>
          <testsuite name="new/same.nc" tests="1" failures="0" errors="0" file="new/same.nc">
            <testcase name="makes the machine do the same" classname="new/same.nc"/>
          </testsuite>
        </testsuites>
    "#]].assert_eq(&run.stdout);
    let run = diff(&shop, "--output-format github");
    expect![[r#"
        ::error title=gcheck (program-added),file=new/more.nc,line=1,endLine=1,col=1,endColumn=1::the program is in the second folder only
        ::error title=gcheck (program-differs),file=new/plate.nc,line=9,endLine=9,col=1,endColumn=5::differs: path%0A  note: tool section T1 changed: the paths part at X50 Y20 Z-1%0A  - old/plate.nc:10  to X50 Y20 Z50   | G0 Z50.%0A  + new/plate.nc:9  to X50 Y21 Z-1   | Y21.%0A  compared again from tool 2 on (old/plate.nc:11, new/plate.nc:11)%0Aold/plate.nc and new/plate.nc move differently; from there to the next tool change they are not compared
    "#]].assert_eq(&run.stdout);
    assert_eq!(run.code, 1);
}

#[test]
fn a_page_shows_both_paths_and_escapes_what_others_wrote() {
    let shop = shop(&[("new/plate.nc", &program(1, "X50.\nY21. (<script src=x>)", HOLE))]);
    let run = diff(&shop, "--output-format html -o report.html");
    let page = shop.read("report.html");
    assert_eq!(run.code, 1);
    assert!(page.contains("<g class=\"was\">") && page.contains("<g class=\"is\">"));
    assert!(!page.contains("<script") && page.contains("&lt;script src=x&gt;"));
}

#[test]
fn two_programs_may_be_gated_like_folders() {
    let shop = shop(&[("new/plate.nc", &program(1, SIDE, &HOLE.replace("F100.", "F150.")))]);
    shop.file("ok.toml", "[[accepted]]\nfile = \"plate.nc\"\nreason = \"seen\"\n");
    let run = shop.gcheck("diff old/plate.nc new/plate.nc --control fanuc-mill -q --accepted ok.toml");
    assert_eq!(run.code, 0, "{}", run.stdout);
    let run = shop.gcheck("diff old new/plate.nc");
    assert!(
        run.code == 2 && run.stderr.contains("old: is a folder, and new/plate.nc is not"),
        "{}",
        run.stderr
    );
}

#[test]
fn no_output_replaces_what_is_read() {
    let shop = shop(&[]);
    for command in [
        "diff old/plate.nc new/plate.nc -o old/plate.nc",
        "stats old/plate.nc -o old/plate.nc",
        "run old/plate.nc -o old/plate.nc",
        "diff old new -o old/plate.nc",
        "stats old -o old/plate.nc",
    ] {
        let run = shop.gcheck(&format!("{command} --control fanuc-mill"));
        assert!(run.code == 2 && run.stderr.contains("is read in this run"), "{command}: {}", run.stderr);
        assert_eq!(shop.read("old/plate.nc"), program(1, SIDE, HOLE));
    }
}

#[test]
fn what_is_not_there_is_not_called_a_file_of_another_kind() {
    let run = shop(&[]).gcheck("diff old nosuch");
    assert_eq!((run.code, run.stderr.as_str()), (2, "error: nosuch: no such file or folder\n"));
}

#[test]
fn mistakes_in_accepted_differences_are_named_at_their_place() {
    let shop = shop(&[]);
    let with = |text: &str| {
        shop.file("accepted.toml", text);
        diff(&shop, "--accepted accepted.toml").to_string()
    };
    expect![[r#"
        ! error: accepted.toml:4:15: `differences` is empty, so that nothing is accepted
        !   |
        ! 4 | differences = []
        !   |               ^^
        !   help: leave it out to accept all
        exit 2
    "#]]
    .assert_eq(&with("[[accepted]]\nfile = \"*.nc\"\nreason = \"a\"\ndifferences = []\n"));
    expect![[r#"
        ! error: accepted.toml:1:1: the key `reason` is missing
        !   |
        ! 1 | [[accepted]]
        !   | ^^^^^^^^^^^^
        exit 2
    "#]]
    .assert_eq(&with("[[accepted]]\nfile = \"*.nc\"\n"));
    expect![[r#"
        ! error: accepted.toml:2:1: unknown key `fil`; did you mean `file`?
        !   |
        ! 2 | fil = "*.nc"
        !   | ^^^
        exit 2
    "#]]
    .assert_eq(&with("[[accepted]]\nfil = \"*.nc\"\n"));
    expect![[r#"
        ! error: accepted.toml:2:8: wrong type: number `5`, expected a text
        !   |
        ! 2 | file = 5
        !   |        ^
        exit 2
    "#]]
    .assert_eq(&with("[[accepted]]\nfile = 5\n"));
}
