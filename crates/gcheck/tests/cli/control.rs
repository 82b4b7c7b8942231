//! The control that was used, and why: said on standard error for people, in the document for programs.

use crate::shop::Shop;

const NEUTRAL: &str = "G0 X1.\nM30\n";
const COMMENTED: &str = "%\nO0001 (PART)\n(gcheck: control=fanuc-mill)\nG0 X1.\nM30\n%\n";
const DETECTED: &str = "%\nO0001 (PART FOR HAAS VF-2)\nG0 X1.\nM30\n%\n";

/// Checks name and source in JSON, and what the text formats say.
fn check_control(program: &str, configuration: &str, arguments: &str, name: &str, source: &str, said: &str) {
    let shop = Shop::with(&[("part.nc", program)]);
    if !configuration.is_empty() {
        shop.file("gcheck.toml", configuration);
    }
    let run = shop.gcheck(&format!("check {arguments} --output-format json"));
    let files = &run.json()["files"];
    assert_eq!(files[0]["file"], "part.nc");
    assert_eq!(files[0]["control"]["name"], name, "{run}");
    assert_eq!(files[0]["control"]["source"], source, "{run}");
    assert_eq!(run.stderr, "", "JSON says it in the document");
    for format in ["full", "concise", "github"] {
        let run = shop.gcheck(&format!("check {arguments} --output-format {format}"));
        assert_eq!(run.stderr.lines().next(), Some(format!("part.nc: control {name}, {said}").as_str()));
        assert!(!run.stdout.contains(": control "), "{run}");
    }
    assert_eq!(shop.gcheck(&format!("check {arguments} --quiet")).stderr, "");
    let sarif = shop.gcheck(&format!("check {arguments} --output-format sarif"));
    assert!(sarif.stdout.contains(name), "{sarif}");
}

#[test]
fn by_option() {
    let said = "set by `--control`";
    check_control(NEUTRAL, "", "--control haas-lathe", "haas-lathe", "option", said);
    check_control(COMMENTED, "control = \"haas-mill\"", "--control linuxcnc", "linuxcnc", "option", said);
}

#[test]
fn by_comment() {
    let said = "set by the comment (gcheck: control=fanuc-mill)";
    check_control(COMMENTED, "", "", "fanuc-mill", "comment", said);
    check_control(COMMENTED, "control = \"haas-mill\"", "", "fanuc-mill", "comment", said);
}

#[test]
fn by_configuration() {
    check_control(
        NEUTRAL,
        "control = \"fanuc-lathe\"",
        "",
        "fanuc-lathe",
        "configuration",
        "set in gcheck.toml",
    );
    check_control(
        DETECTED,
        "control = \"fanuc-mill\"",
        "",
        "fanuc-mill",
        "configuration",
        "set in gcheck.toml",
    );
    let said = "set by the configuration";
    check_control(NEUTRAL, "", "--config control=linuxcnc", "linuxcnc", "configuration", said);
}

#[test]
fn by_detection() {
    let shop = Shop::with(&[("part.nc", DETECTED)]);
    let control = &shop.gcheck("check --output-format json").json()["files"][0]["control"];
    assert_eq!(control["source"], "detected");
    assert_eq!(control["name"], "haas-mill");
    let because = control["because"].as_str().unwrap();
    check_control(DETECTED, "", "", "haas-mill", "detected", &format!("detected from {because}"));
    assert!(because.contains("VF-2"), "{because}");
}

/// Five digits after `O` are the custom of one builder, and alone a weak sign.
const WEAK: &str = "%\nO00012\nG0 X1. Y1.\nX2. Y2.\nX3. Y3.\nX4. Y4.\nGOTO 99\nM30\n%\n";

#[test]
fn by_a_guess() {
    let said = "guessed from a program number of five digits: no finding is above a warning";
    check_control(WEAK, "", "", "haas-mill", "guessed", said);
    let severity = |program: &str| {
        let shop = Shop::with(&[("part.nc", program)]);
        let found = shop.gcheck("check --output-format json").json();
        let findings = found["findings"].as_array().unwrap().iter();
        let mut jumps = findings.filter(|finding| finding["rule"] == "jump-target-missing");
        jumps.next().unwrap()["severity"].as_str().unwrap().to_owned()
    };
    assert_eq!(severity(WEAK), "warning");
    assert_eq!(severity(&WEAK.replace("O00012", "O00012 (VF-2)")), "error");
}

#[test]
fn by_its_neighbours() {
    let shop = Shop::with(&[("part.nc", NEUTRAL), ("fanuc.nc", "(FANUC 31I)\nG0 X1.\nM30\n")]);
    for name in ["a.nc", "b.nc", "c.nc"] {
        shop.file(name, DETECTED);
    }
    let said = |name: &str| {
        shop.gcheck(&format!("check {name}")).stderr.lines().next().unwrap_or_default().to_owned()
    };
    assert_eq!(said("part.nc"), "part.nc: control generic-mill, by default", "one beside it names another");
    assert!(
        said("fanuc.nc").starts_with("fanuc.nc: control fanuc-mill, guessed from (FANUC 31I)"),
        "{}",
        said("fanuc.nc")
    );
    shop.file("fanuc.nc", NEUTRAL);
    assert_eq!(
        said("part.nc"),
        "part.nc: control haas-mill, guessed from its neighbours (3 of 4 show it): no finding is above a warning"
    );
}

#[test]
fn by_default() {
    check_control(NEUTRAL, "", "", "generic-mill", "default", "by default");
}

/// A program for a control of Fagor, which gcheck does not read.
const FAGOR: &str = "%00214\nN0 T1.1\nN10   M6\nN20 G0 X10 Y10\nN30 M30\n";

#[test]
fn a_program_of_another_dialect_is_not_executed_drawn_compared_or_rewritten() {
    let shop = Shop::with(&[("a.pim", FAGOR), ("b.pim", FAGOR)]);
    for command in [
        "run a.pim",
        "stats a.pim",
        "plot a.pim -o a.svg",
        "fmt a.pim",
        "diff a.pim b.pim",
        "edit translate --x 10 a.pim",
    ] {
        let run = shop.gcheck(command);
        assert!(
            run.code == 2
                && run.stderr.contains("a.pim: the file is for a Fagor control, which gcheck does not read")
                && run.stderr.contains("name a control to read it all the same"),
            "{command}: {run}"
        );
        assert_eq!(shop.read("a.pim"), FAGOR, "{command}");
    }
    // A control that somebody names is taken at its word.
    for command in ["run a.pim --control haas-mill", "fmt a.pim --isolated --config control=haas-mill"] {
        assert!(!shop.gcheck(command).stderr.contains("does not read"), "{command}");
    }
}

#[test]
fn advice_about_the_control_does_not_contradict_the_finding() {
    let shop = Shop::with(&[
        ("printed.gcode", "G92 E0\nG1 X1 E1.1\nG1 X2 E1.2\nG1 Y2 E1.3\n"),
        ("open.nc", "%\nO1 (A)\nG21 G90 G17 G40 G80\nG0 X1. Y2.\nM30\n%\n"),
    ]);
    let run = shop.gcheck("check printed.gcode");
    assert!(run.stdout.contains("the file is for a 3-D printer"), "{run}");
    assert!(!run.stdout.contains("nothing shows which control"), "{run}");
    // Without findings, too, nobody should take the default for the machine.
    let run = shop.gcheck("check .");
    assert!(run.stdout.contains("nothing shows which control runs a program: name it"), "{run}");
}
