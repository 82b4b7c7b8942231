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
        assert!(!run.stdout.contains("control "), "{run}");
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

#[test]
fn by_default() {
    check_control(NEUTRAL, "", "", "generic-mill", "default", "by default");
}
