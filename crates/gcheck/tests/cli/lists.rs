//! The commands that tell about gcheck itself: `explain`, `rules`, `codes`, `controls`, `init`, `schema`, `completions`.

use std::fs;

use expect_test::{Expect, expect};
use serde_json::Value;

use crate::shop::{GOOD, Shop};

/// The first lines that a command prints.
fn check_head(arguments: &str, lines: usize, expected: &Expect) {
    let run = Shop::new().gcheck(arguments);
    assert_eq!(run.stderr, "");
    assert_eq!(run.code, 0);
    let head: Vec<&str> = run.stdout.lines().take(lines).collect();
    expected.assert_eq(&head.join("\n"));
}

/// What a command that cannot do its work says.
fn check_refusal(arguments: &str, expected: &Expect) {
    expected.assert_eq(&Shop::new().gcheck(arguments).to_string());
}

fn list(arguments: &str) -> Vec<Value> {
    let run = Shop::new().gcheck(&format!("{arguments} --output-format json"));
    assert_eq!(run.code, 0, "{run}");
    run.json().as_array().unwrap().clone()
}

#[test]
fn a_code_is_explained_for_a_control() {
    check_head(
        "explain G143",
        4,
        &expect![[r#"
        G143: 5-axis tool length compensation
        on Haas mill (classic control and NGC)

        Turns the tool length with A and B, so that a tool of another length keeps the programmed tip path."#]],
    );
    check_head(
        "explain g0143 --control haas-mill",
        2,
        &expect![[r#"
        G143: 5-axis tool length compensation
        on Haas mill (classic control and NGC)"#]],
    );
    check_head(
        "explain G71 --control haas-lathe",
        2,
        &expect![[r#"
        G71: roughing cycle along Z
        on Haas lathe (ST, DS, SL, TL; NGC and classic)"#]],
    );
}

#[test]
fn a_code_without_a_control_has_a_line_for_each_meaning() {
    let shop = Shop::new();
    expect![[r#"
        M98 on 9 controls

          subprogram call             fanuc-lathe, fanuc-lathe-b, fanuc-lathe-c, fanuc-mill, generic-mill, haas-lathe, haas-mill, tsnc-yh-a1m
          call a numbered subprogram  linuxcnc

        `gcheck explain M98 --control fanuc-lathe` prints its words, alarms and source there.
    "#]].assert_eq(&shop.gcheck("explain M98").stdout);
    expect![[r#"
        G43 on 7 controls

          tool length compensation, positive  fanuc-mill, generic-mill, haas-mill, tsnc-yh-a1m
          tool length of the tool table       grblhal
          tool length compensation plus       haas-lathe
          tool length offset on               linuxcnc

        `gcheck explain G43 --control fanuc-mill` prints its words, alarms and source there.
    "#]]
    .assert_eq(&shop.gcheck("explain g43").stdout);
}

#[test]
fn an_answer_of_a_control_and_its_settings_are_explained() {
    let shop = Shop::new();
    let run = shop.gcheck_words(&["explain", "Error 22"]);
    assert!(run.code == 0 && run.stdout.contains("  no feed rate has been set"), "{run}");
    assert!(run.stdout.contains("Reported by ") && run.stdout.contains("feed-missing"), "{run}");
    let run = shop.gcheck_words(&["explain", "error 16", "--control", "grbl"]);
    assert!(run.stdout.contains("the jog command has a code that jogging does not take"), "{run}");
    let run = shop.gcheck("explain $32=1");
    assert!(
        run.stdout.starts_with("$32: laser mode\non FluidNC, grbl 1.1, grblHAL\n")
            && run.stdout.contains("0 as delivered"),
        "{run}"
    );
    let run = shop.gcheck("explain $h");
    assert!(run.stdout.starts_with("$H: a line for the control itself\n"), "{run}");
    let run = shop.gcheck("explain $999 --control grbl");
    assert!(run.code == 2 && run.stderr.contains("no control that gcheck knows lists `$999`"), "{run}");
    let run = shop.gcheck_words(&["explain", "error 9999"]);
    assert!(run.code == 2 && run.stderr.contains("neither a rule nor a code"), "{run}");
}

#[test]
fn an_address_is_explained_and_a_bare_number_is_taken_for_a_code() {
    let shop = Shop::new();
    expect![[r#"
        T: an address

          tool and offset: T0203 is tool 2 with offset 3       fanuc-lathe, fanuc-lathe-b, fanuc-lathe-c
          tool to make ready                                   fanuc-mill
          tool number; without M6 it is only kept              fluidnc
          tool                                                 generic-mill
          tool number; only reported, nothing is changed       grbl
          tool number; without a tool change it is only kept   grblhal
          turret station and offset, T0101; offset 00 cancels  haas-lathe
          tool, or tool group from 1000 on                     haas-mill
          tool to prepare; M6 loads it                         linuxcnc
          tool and offset digits                               tsnc-yh-a1m
    "#]]
    .assert_eq(&shop.gcheck("explain t").stdout);
    check_refusal(
        "explain 43",
        &expect![[r#"
        ! error: `43` is neither a rule nor a code; did you mean `G43` or `M43`?
        !   help: `gcheck rules` and `gcheck codes` list them
        exit 2
    "#]],
    );
    check_refusal(
        "explain 9999",
        &expect![[r#"
        ! error: `9999` is neither a rule nor a code
        !   help: `gcheck rules` and `gcheck codes` list them
        exit 2
    "#]],
    );
}

#[test]
fn a_control_is_named_in_any_case_and_a_builder_is_not_enough() {
    check_head(
        "explain G43 --control Haas-Mill",
        2,
        &expect![[r#"
        G43: tool length compensation, positive
        on Haas mill (classic control and NGC)"#]],
    );
    check_refusal(
        "explain G43 --control haas",
        &expect![[r#"
        ! error: no control is called `haas`; did you mean `haas-lathe` or `haas-mill`?
        exit 2
    "#]],
    );
}

#[test]
fn programs_in_the_page_of_a_rule_are_indented() {
    let run = Shop::new().gcheck("explain missing-decimal-point");
    assert!(!run.stdout.contains("```") && run.stdout.contains("\n\n    G"), "{run}");
}

#[test]
fn the_configuration_chooses_the_control_of_an_explanation() {
    let shop = Shop::with(&[("gcheck.toml", "control = \"linuxcnc\"")]);
    let run = shop.gcheck("explain G64");
    assert!(run.stdout.contains("\non LinuxCNC"), "{run}");
    let run = shop.gcheck("explain G64 --isolated --config control=fanuc-mill");
    assert!(run.stdout.contains("\non Fanuc"), "{run}");
}

#[test]
fn a_rule_is_explained() {
    check_head(
        "explain unknown-code",
        3,
        &expect![[r#"
            unknown-code: code that the control does not have

            severity error, on by default, fixed by --unsafe-fixes, group words, since 0.1.0"#]],
    );
    for rule in list("rules") {
        let id = rule["id"].as_str().unwrap();
        let run = Shop::new().gcheck(&format!("explain {id}"));
        assert_eq!(run.code, 0, "{id}");
        assert!(run.stdout.lines().count() > 4, "{id} has documentation");
    }
}

#[test]
fn what_cannot_be_explained() {
    check_refusal(
        "explain unknwn-code",
        &expect![[r#"
        ! error: `unknwn-code` is neither a rule nor a code; did you mean `unknown-code`?
        !   help: `gcheck rules` and `gcheck codes` list them
        exit 2
    "#]],
    );
    check_refusal(
        "explain G999",
        &expect![[r#"
        ! error: no control that gcheck knows has `G999`
        exit 2
    "#]],
    );
    check_refusal(
        "explain G143 --control linuxcnc",
        &expect![[r#"
        ! error: LinuxCNC has no `G143`
        !   help: it is a code of haas-mill
        exit 2
    "#]],
    );
    check_refusal(
        "explain G0 --control nonsense",
        &expect![[r#"
            ! error: no control is called `nonsense`; there are fanuc-lathe, fanuc-lathe-b, fanuc-lathe-c, fanuc-mill, fluidnc, generic-mill, grbl, grblhal, haas-lathe, haas-mill, linuxcnc, tsnc-yh-a1m
            exit 2
        "#]],
    );
    assert_eq!(Shop::new().gcheck("explain").code, 2);
}

#[test]
fn rules_are_listed() {
    let rules = list("rules");
    assert!(rules.len() >= 35);
    for key in
        ["id", "group", "summary", "severity", "recommended", "sets", "mends", "tier", "since", "aliases"]
    {
        assert!(rules.iter().all(|rule| rule.get(key).is_some()), "{key}");
    }
    let text = Shop::new().gcheck("rules").stdout;
    assert_eq!(text.lines().count(), rules.len());
    assert!(text.lines().all(|line| line.trim_end() == line));
}

#[test]
fn codes_are_listed() {
    let codes = list("codes --control haas-mill");
    assert!(codes.iter().any(|code| code["code"] == "G143"));
    for key in ["code", "title", "group", "summary", "confidence", "source"] {
        assert!(codes.iter().all(|code| code.get(key).is_some()), "{key}");
    }
    assert!(!list("codes --control linuxcnc").iter().any(|code| code["code"] == "G143"));
    let shop = Shop::with(&[("gcheck.toml", "control = \"haas-lathe\"")]);
    assert!(shop.gcheck("codes").stdout.starts_with("haas-lathe: "));
    check_refusal(
        "codes --control nonsense",
        &expect![[r#"
            ! error: no control is called `nonsense`; there are fanuc-lathe, fanuc-lathe-b, fanuc-lathe-c, fanuc-mill, fluidnc, generic-mill, grbl, grblhal, haas-lathe, haas-mill, linuxcnc, tsnc-yh-a1m
            exit 2
        "#]],
    );
}

#[test]
fn controls_are_listed() {
    let controls = list("controls");
    let names: Vec<&str> = controls.iter().map(|control| control["name"].as_str().unwrap()).collect();
    for name in ["haas-mill", "haas-lathe", "fanuc-mill", "fanuc-lathe", "linuxcnc", "generic-mill"] {
        assert!(names.contains(&name), "{name}");
        assert!(Shop::new().gcheck("controls").stdout.contains(name));
    }
    assert_eq!(controls.iter().filter(|control| control["fallback"] == true).count(), 1);
}

#[test]
fn init_writes_a_configuration_that_is_valid() {
    let shop = Shop::with(&[("part.nc", "%\nO0001 (PART FOR HAAS VF-2)\nM30\n%\n")]);
    let run = shop.gcheck("init");
    expect![[r#"
        wrote gcheck.toml: the control is haas-mill, detected from 1 program
        next: `gcheck check`
        exit 0
    "#]]
    .assert_eq(&run.to_string());
    assert!(
        shop.read("gcheck.toml")
            .contains("\ncontrol = \"haas-mill\"  # detected from 1 of the programs here\n")
    );
    assert_eq!(shop.names(), ["gcheck.toml", "part.nc"]);
    let run = shop.gcheck("check --output-format json");
    assert_eq!(run.code, 0, "{run}");
    assert_eq!(run.json()["files"][0]["control"]["source"], "configuration");
}

/// Editors read the first line: `#:schema`, and a path from the folder of the file.
#[test]
fn init_names_the_schema_beside_it() {
    let shop = Shop::new();
    let run = shop.gcheck("init --schema --control haas-mill");
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.starts_with("wrote gcheck.toml and gcheck.schema.json:"), "{run}");
    assert_eq!(shop.names(), ["gcheck.schema.json", "gcheck.toml"]);
    let text = shop.read("gcheck.toml");
    let named = text.lines().next().unwrap().strip_prefix("#:schema ./").unwrap();
    assert_eq!(shop.read(named), shop.gcheck("schema").stdout);
    // What was there is left as it is.
    fs::remove_file(shop.path("gcheck.toml")).unwrap();
    let again = shop.gcheck("init --schema");
    assert_eq!(again.stderr, "error: gcheck.schema.json: is here already; it was left as it is\n");
    assert_eq!(shop.names(), ["gcheck.schema.json"]);
}

/// One line for all would be wrong for many of them.
#[test]
fn init_chooses_no_control_for_a_mixed_folder() {
    let shop = Shop::with(&[
        ("a.nc", "%\nO0001 (PART FOR HAAS VF-2)\nM30\n%\n"),
        ("b.nc", "%\nO0002 (PART FOR HAAS VF-2)\nM30\n%\n"),
        ("c.ngc", "o<sub> sub\n#<_x> = 1\no<sub> endsub\nM2\n"),
    ]);
    let run = shop.gcheck("init");
    assert_eq!(
        run.stdout.lines().next(),
        Some("wrote gcheck.toml: the programs here look like those of several controls, and it lists them"),
        "{run}"
    );
    let text = shop.read("gcheck.toml");
    assert!(text.contains("# The programs here look like several: haas-mill (2), linuxcnc (1).\n"), "{text}");
    assert!(text.contains("\n# control = \"haas-mill\"\n"), "{text}");
    assert_eq!(
        shop.gcheck("check --output-format json c.ngc").json()["files"][0]["control"]["source"],
        "detected"
    );
}

#[test]
fn what_init_leaves_in_comments_is_valid_too() {
    for control in ["haas-mill", "haas-lathe", "fanuc-mill", "fanuc-lathe", "linuxcnc", "generic-mill"] {
        let shop = Shop::with(&[("part.nc", GOOD), ("macros/O9010.nc", GOOD)]);
        assert_eq!(shop.gcheck(&format!("init --control {control}")).code, 0);
        let text = shop.read("gcheck.toml").replace('…', control);
        let is_key =
            |line: &&str| line.starts_with("# ") && (line.contains(" = ") || line.starts_with("# [["));
        let lines = text.lines().map(|line| if is_key(&line) { line.trim_start_matches("# ") } else { line });
        shop.file("gcheck.toml", lines.collect::<Vec<_>>().join("\n"));
        let run = shop.gcheck("check --fail-on never");
        // A key may be of no use on a control, but then what is wrong has to be its value, not its form.
        assert!(run.code == 0, "{run}\n{}", shop.read("gcheck.toml"));
    }
}

#[test]
fn init_writes_over_nothing() {
    for name in ["gcheck.toml", ".gcheck.toml"] {
        let shop = Shop::with(&[(name, "control = \"linuxcnc\"")]);
        let run = shop.gcheck("init");
        assert_eq!(run.code, 2);
        assert_eq!(run.stderr, format!("error: {name}: is here already; it was left as it is\n"));
        assert_eq!(shop.read(name), "control = \"linuxcnc\"");
        assert_eq!(shop.names(), [name]);
    }
    check_refusal(
        "init --control nonsense",
        &expect![[r#"
            ! error: no control is called `nonsense`; there are fanuc-lathe, fanuc-lathe-b, fanuc-lathe-c, fanuc-mill, fluidnc, generic-mill, grbl, grblhal, haas-lathe, haas-mill, linuxcnc, tsnc-yh-a1m
            exit 2
        "#]],
    );
}

#[test]
fn the_schema_knows_the_keys() {
    let schema = Shop::new().gcheck("schema").json();
    let keys = [
        "extend",
        "control",
        "machine",
        "settings",
        "variables",
        "offsets",
        "tools",
        "codes",
        "search",
        "rules",
        "per-file-ignores",
        "overrides",
        "files",
    ];
    for key in keys {
        assert!(schema["properties"].get(key).is_some(), "{key}");
    }
    assert_eq!(schema["additionalProperties"], false);
}

#[test]
fn completions_are_printed_for_shells() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = Shop::new().gcheck(&format!("completions {shell}"));
        assert_eq!(run.code, 0);
        assert!(run.stdout.contains("gcheck") && run.stdout.len() > 500, "{shell}");
    }
    assert_eq!(Shop::new().gcheck("completions tcsh").code, 2);
}
