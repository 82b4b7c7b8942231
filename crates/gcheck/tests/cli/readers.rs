//! Formats that other programs read, read as they do: strictly, by what their documentation and schemas ask for.
//!
//! SARIF has a validator of its own (see `formats`), and `xmllint` holds `JUnit` against a schema (`junit.xsd`). `GitLab` publishes no
//! schema, and the others have no validator that could be had everywhere, so each has a reader here that refuses what it
//! does not know.

use std::collections::BTreeSet;

use gcheck_testkit::skips::skip;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use serde_json::{Map, Value};

use crate::shop::{GOOD, Shop, WARNED};

/// Findings of each severity, a fix, and everything that needs escaping somewhere.
const HOSTILE: &[u8] = b"%\r\nO0001 G90 (D\xE9P <&\"']]> %0A ::error:: ##vso[x] \x07)\r\n(\xE6\x97\xA5\xE6\x9C\xAC \xF0\x9F\x98\x80) G0 X1O.\r\n(A) G999 X1\r\nG0 X1 X1\r\ng1 X2. F100.\r\nM98 P100\r\nM30\r\n%\r\n";
const NAME: &str = "jobs/a b,c;d 100% #1 [x] 'ä' & <y>.nc";

fn shop() -> Shop {
    let shop = Shop::with(&[("jobs/good.nc", GOOD), ("warned.nc", WARNED)]);
    shop.file(NAME, HOSTILE);
    shop
}

/// What the format prints, and the findings as our own JSON has them.
fn output(shop: &Shop, format: &str) -> (String, Vec<Value>) {
    let arguments = "check --control haas-mill --extend-select all";
    let run = shop.gcheck(&format!("{arguments} --output-format {format}"));
    assert_eq!(run.code, 1, "{run}");
    let findings = shop.gcheck(&format!("{arguments} --output-format json")).json()["findings"]
        .as_array()
        .unwrap()
        .clone();
    let severities: BTreeSet<&str> =
        findings.iter().map(|finding| finding["severity"].as_str().unwrap()).collect();
    assert!(severities.len() >= 3 && findings.len() > 6, "too few to prove anything: {severities:?}");
    (run.stdout, findings)
}

/// An object of exactly these members; `?` marks those that may be missing.
fn object<'v>(value: &'v Value, members: &[&str]) -> &'v Map<String, Value> {
    let object = value.as_object().unwrap_or_else(|| panic!("no object: {value}"));
    for member in members.iter().filter(|member| !member.ends_with('?')) {
        assert!(object.contains_key(*member), "`{member}` is missing: {value}");
    }
    for member in object.keys() {
        assert!(
            members.iter().any(|m| m.trim_end_matches('?') == member),
            "`{member}` is not known: {value}"
        );
    }
    object
}

fn text(value: &Value) -> &str {
    value.as_str().filter(|text| !text.is_empty()).unwrap_or_else(|| panic!("no text: {value}"))
}

fn number(value: &Value) -> u64 {
    value.as_u64().filter(|number| *number > 0).unwrap_or_else(|| panic!("not counted from 1: {value}"))
}

#[test]
fn gitlab_code_quality() {
    let shop = shop();
    let (said, findings) = output(&shop, "gitlab");
    let list: Vec<Value> = serde_json::from_str(&said).unwrap();
    assert_eq!(list.len(), findings.len());
    let mut fingerprints = BTreeSet::new();
    for (entry, finding) in list.iter().zip(&findings) {
        object(entry, &["description", "check_name", "fingerprint", "severity", "location"]);
        assert!(text(&entry["description"]).contains(text(&finding["message"])));
        assert_eq!(entry["check_name"], finding["rule"]);
        assert!(
            fingerprints.insert(text(&entry["fingerprint"])),
            "merge requests drop the second of two: {entry}"
        );
        assert!(
            ["info", "minor", "major", "critical", "blocker"].contains(&text(&entry["severity"])),
            "{entry}"
        );
        let location = object(&entry["location"], &["path", "positions"]);
        let path = text(&location["path"]);
        assert!(path == finding["file"] && !path.starts_with('/') && !path.starts_with("./"), "{entry}");
        let positions = object(&location["positions"], &["begin", "end"]);
        for (end, ours) in [("begin", "start"), ("end", "end")] {
            object(&positions[end], &["line", "column"]);
            assert_eq!(number(&positions[end]["line"]), number(&finding["range"][ours]["line"]));
            assert!(number(&positions[end]["column"]) > 0);
        }
    }
}

#[test]
fn reviewdog() {
    let shop = shop();
    let (said, findings) = output(&shop, "rdjson");
    let result: Value = serde_json::from_str(&said).unwrap();
    object(&result, &["source", "diagnostics"]);
    object(&result["source"], &["name", "url"]);
    let list = result["diagnostics"].as_array().unwrap();
    assert_eq!(list.len(), findings.len());
    for (entry, finding) in list.iter().zip(&findings) {
        object(entry, &["message", "location", "severity", "code", "suggestions?"]);
        assert!(["ERROR", "WARNING", "INFO"].contains(&text(&entry["severity"])), "{entry}");
        object(&entry["code"], &["value", "url"]);
        assert_eq!(entry["code"]["value"], finding["rule"]);
        object(&entry["location"], &["path", "range"]);
        assert_eq!(entry["location"]["path"], finding["file"]);
        let place = in_bytes(&shop, finding, &entry["location"]["range"]);
        let offset = |end: &str| usize::try_from(finding["range"][end]["offset"].as_u64().unwrap()).unwrap();
        assert_eq!(place, offset("start")..offset("end"), "{entry}");
        for suggestion in entry["suggestions"].as_array().into_iter().flatten() {
            object(suggestion, &["range", "text"]);
            in_bytes(&shop, finding, &suggestion["range"]);
        }
    }
}

/// The bytes of a range whose columns count bytes, as this format's do.
fn in_bytes(shop: &Shop, finding: &Value, range: &Value) -> std::ops::Range<usize> {
    let bytes = std::fs::read(shop.path(text(&finding["file"]))).unwrap();
    let at = |end: &str| {
        object(&range[end], &["line", "column"]);
        let line = usize::try_from(number(&range[end]["line"])).unwrap();
        let start: usize = bytes.split_inclusive(|b| *b == b'\n').take(line - 1).map(<[u8]>::len).sum();
        start + usize::try_from(number(&range[end]["column"])).unwrap() - 1
    };
    object(range, &["start", "end"]);
    at("start")..at("end")
}

/// An element: its name, attributes, text and children.
#[derive(Debug, Default)]
struct Element {
    name: String,
    attributes: Vec<(String, String)>,
    text: String,
    children: Vec<Element>,
}

impl Element {
    fn read(document: &str) -> Self {
        assert!(document.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"), "{document}");
        // What XML 1.0 has no way to say must not be in it, not even escaped.
        let is_allowed = |c: char| matches!(c, '\t' | '\n' | '\r' | '\u{20}'..='\u{FFFD}' | '\u{10000}'..);
        assert!(document.chars().all(is_allowed), "{document:?}");
        let mut reader = Reader::from_str(document);
        reader.config_mut().check_end_names = true;
        let mut open = vec![Self::default()];
        loop {
            match reader.read_event().unwrap() {
                Event::Start(start) => open.push(Self::begin(&start)),
                Event::Empty(start) => open.last_mut().unwrap().children.push(Self::begin(&start)),
                Event::End(_) => {
                    let done = open.pop().unwrap();
                    open.last_mut().unwrap().children.push(done);
                }
                Event::Text(text) => {
                    open.last_mut().unwrap().text.push_str(&text);
                }
                Event::GeneralRef(_) | Event::Decl(_) => {}
                Event::Eof => break,
                other => panic!("not known: {other:?}"),
            }
        }
        assert_eq!(open.len(), 1);
        let mut document = open.pop().unwrap();
        assert_eq!(document.children.len(), 1, "one root");
        document.children.pop().unwrap()
    }

    fn begin(start: &BytesStart<'_>) -> Self {
        let attributes = start.attributes().map(|attribute| {
            let attribute = attribute.unwrap();
            let value = quick_xml::escape::unescape(&attribute.value).unwrap().into_owned();
            (attribute.key.as_ref().to_owned(), value)
        });
        Self { name: start.name().as_ref().to_owned(), attributes: attributes.collect(), ..Self::default() }
    }

    /// An element of this name with exactly these attributes.
    fn is(&self, name: &str, attributes: &[&str]) -> &Self {
        let names: Vec<&str> = self.attributes.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!((self.name.as_str(), names.as_slice()), (name, attributes), "{self:#?}");
        self
    }

    fn get(&self, name: &str) -> &str {
        self.attributes.iter().find(|(n, _)| n == name).map(|(_, value)| value.as_str()).unwrap()
    }

    fn count(&self, name: &str) -> usize {
        self.get(name).parse().unwrap()
    }
}

#[test]
fn checkstyle() {
    let shop = shop();
    let (said, findings) = output(&shop, "checkstyle");
    let root = Element::read(&said);
    root.is("checkstyle", &["version"]);
    let mut left = findings.iter();
    for file in &root.children {
        file.is("file", &["name"]);
        for error in &file.children {
            error.is("error", &["line", "column", "severity", "message", "source"]);
            let finding = left.next().unwrap();
            assert_eq!(file.get("name"), finding["file"]);
            assert_eq!(error.count("line") as u64, finding["range"]["start"]["line"]);
            assert_eq!(error.count("column") as u64, finding["range"]["start"]["column"]);
            assert!(["ignore", "info", "warning", "error"].contains(&error.get("severity")));
            assert!(error.get("message").contains(text(&finding["message"])), "{error:?}");
            assert_eq!(error.get("source"), format!("gcheck.{}", text(&finding["rule"])));
            assert!(error.children.is_empty());
        }
    }
    assert!(left.next().is_none());
}

/// What the schema of Jenkins' xUnit plugin allows, which is the strictest of those in use.
#[test]
fn junit() {
    let shop = shop();
    let (said, findings) = output(&shop, "junit");
    let root = Element::read(&said);
    root.is("testsuites", &["name", "tests", "failures", "errors"]);
    let (mut tests, mut failures) = (0, 0);
    for suite in &root.children {
        suite.is("testsuite", &["name", "tests", "failures", "errors", "file"]);
        assert!(!suite.children.is_empty(), "a suite without cases is taken for a mistake");
        assert_eq!(suite.count("tests"), suite.children.len());
        let mut failed = 0;
        for case in &suite.children {
            case.is("testcase", &["name", "classname"]);
            for child in &case.children {
                match child.name.as_str() {
                    "failure" => {
                        child.is("failure", &["type", "message"]);
                        failed += 1;
                    }
                    _ => {
                        child.is("system-out", &[]);
                    }
                }
                assert!(!child.text.is_empty() && child.children.is_empty(), "{child:?}");
            }
        }
        assert_eq!(suite.count("failures"), failed);
        (tests, failures) = (tests + suite.children.len(), failures + failed);
    }
    assert_eq!((root.count("tests"), root.count("failures")), (tests, failures));
    // Only errors make the run fail.
    assert_eq!(failures, findings.iter().filter(|finding| text(&finding["severity"]) == "error").count());
    let with_findings: BTreeSet<&str> = findings.iter().map(|finding| text(&finding["file"])).collect();
    let programs = root.children.len();
    assert_eq!(tests, findings.len() + programs - with_findings.len(), "and the programs without findings");
}

/// Findings that fail, findings that do not, a program without any, a file that is missing; and nothing at all.
#[test]
fn junit_fits_the_schema() {
    let shop = shop();
    shop.file("empty/notes.txt", "");
    let schema = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cli/junit.xsd");
    let valid = |report: &str| {
        let mut command = std::process::Command::new("xmllint");
        command.args(["--noout", "--schema"]).arg(&schema).arg(shop.path(report)).output().ok()
    };
    for (paths, code) in [(". gone.nc", 2), (".", 1), ("empty", 0)] {
        let run = shop.gcheck(&format!(
            "check {paths} --control haas-mill --extend-select all --output-format junit -o out.xml"
        ));
        assert_eq!(run.code, code, "{run}");
        let Some(output) = valid("out.xml") else {
            return skip(
                "junit_fits_the_schema",
                "xmllint",
                "`cargo xtask test` installs it (libxml2-utils)",
            );
        };
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{paths}: {said}\n{}", shop.read("out.xml"));
    }
    // The schema can refuse: `file` is known at the suite alone.
    let wrong = "<testsuites><testsuite name=\"a\" tests=\"1\" failures=\"0\" errors=\"0\">\
                 <testcase name=\"b\" file=\"a\"/></testsuite></testsuites>";
    shop.file("wrong.xml", wrong);
    assert!(!valid("wrong.xml").unwrap().status.success());
}

/// A workflow command, as the runner reads it: `::name key=value,…::message`.
#[test]
fn github_annotations() {
    let shop = shop();
    let (said, findings) = output(&shop, "github");
    assert_eq!(said.lines().count(), findings.len(), "each is one line");
    let unescape = |text: &str| {
        [("%2C", ","), ("%3A", ":"), ("%0A", "\n"), ("%0D", "\r"), ("%25", "%")]
            .iter()
            .fold(text.to_owned(), |text, (code, letter)| text.replace(code, letter))
    };
    for (line, finding) in said.lines().zip(&findings) {
        let (command, message) = line.strip_prefix("::").unwrap().split_once("::").unwrap();
        let (name, properties) = command.split_once(' ').unwrap();
        assert!(["error", "warning", "notice"].contains(&name), "{line}");
        let get = |key: &str| {
            let value = properties.split(',').find_map(|property| property.strip_prefix(&format!("{key}=")));
            unescape(value.unwrap_or_else(|| panic!("no `{key}`: {line}")))
        };
        assert_eq!(get("file"), text(&finding["file"]));
        assert_eq!(get("line"), finding["range"]["start"]["line"].to_string());
        assert!(unescape(message).contains(text(&finding["message"])), "{line}");
    }
}

/// A logging command, as the agent reads it: `##vso[task.logissue key=value;…]message`.
#[test]
fn azure_issues() {
    let shop = shop();
    let (said, findings) = output(&shop, "azure");
    assert_eq!(said.lines().count(), findings.len(), "each is one line");
    let unescape = |text: &str| {
        [("%3B", ";"), ("%5D", "]"), ("%0A", "\n"), ("%0D", "\r"), ("%AZP25", "%")]
            .iter()
            .fold(text.to_owned(), |text, (code, letter)| text.replace(code, letter))
    };
    for (line, finding) in said.lines().zip(&findings) {
        let (properties, message) =
            line.strip_prefix("##vso[task.logissue ").unwrap().split_once(']').unwrap();
        let get = |key: &str| {
            let value = properties.split(';').find_map(|property| property.strip_prefix(&format!("{key}=")));
            unescape(value.unwrap_or_else(|| panic!("no `{key}`: {line}")))
        };
        assert!(["error", "warning"].contains(&get("type").as_str()), "{line}");
        assert_eq!(get("sourcepath"), text(&finding["file"]));
        assert_eq!(get("linenumber"), finding["range"]["start"]["line"].to_string());
        assert!(unescape(message).contains(text(&finding["message"])), "{line}");
    }
}

#[test]
fn json_lines() {
    let shop = shop();
    let (said, findings) = output(&shop, "jsonl");
    assert_eq!(said.lines().count(), findings.len());
    for (line, finding) in said.lines().zip(&findings) {
        let mut line: Value = serde_json::from_str(line).unwrap();
        let control = line.as_object_mut().unwrap().remove("control").unwrap();
        assert_eq!(control["name"], "haas-mill", "a line stands alone, so it says the control");
        assert_eq!(line, *finding, "the rest is as the whole document has it");
    }
}

/// Where a value is not as a schema says, with the path to it. It knows the keywords that our schema has and refuses others; an
/// object may have no member that the schema does not name, so that a new one is described before it is written.
fn misfits(schema: &Value, root: &Value, value: &Value, path: &str, found: &mut Vec<String>) {
    let Some(rules) = schema.as_object() else { panic!("not a schema: {schema}") };
    for (keyword, rule) in rules {
        let fits = match keyword.as_str() {
            "$schema" | "$defs" | "title" | "description" | "required" | "format" => true,
            "type" => {
                let names: Vec<&str> = match rule {
                    Value::Array(names) => names.iter().filter_map(Value::as_str).collect(),
                    name => name.as_str().into_iter().collect(),
                };
                names.iter().any(|name| match *name {
                    "object" => value.is_object(),
                    "array" => value.is_array(),
                    "string" => value.is_string(),
                    "boolean" => value.is_boolean(),
                    "integer" => value.is_u64() || value.is_i64(),
                    "null" => value.is_null(),
                    other => panic!("type {other}"),
                })
            }
            "const" => rule == value,
            "enum" => rule.as_array().unwrap().contains(value),
            "minimum" => value.as_i64() >= rule.as_i64(),
            "maximum" => value.as_i64() <= rule.as_i64(),
            "pattern" => {
                assert_eq!(rule, "^[0-9a-f]{32}$");
                let text = value.as_str().unwrap();
                text.len() == 32 && text.bytes().all(|b| b.is_ascii_digit() || (b'a'..=b'f').contains(&b))
            }
            "items" => {
                for (ix, item) in value.as_array().into_iter().flatten().enumerate() {
                    misfits(rule, root, item, &format!("{path}/{ix}"), found);
                }
                true
            }
            "anyOf" | "oneOf" => {
                let fit = rule.as_array().unwrap().iter().filter(|one| {
                    let mut misses = Vec::new();
                    misfits(one, root, value, path, &mut misses);
                    misses.is_empty()
                });
                fit.count() == 1
            }
            "$ref" => {
                let place = rule.as_str().unwrap().strip_prefix('#').unwrap();
                misfits(root.pointer(place).unwrap(), root, value, path, found);
                true
            }
            "properties" => {
                let known = rule.as_object().unwrap();
                let required: Vec<&Value> =
                    rules.get("required").and_then(Value::as_array).into_iter().flatten().collect();
                for name in required.iter().filter_map(|name| name.as_str()) {
                    if value.get(name).is_none() {
                        found.push(format!("{path}: `{name}` is missing"));
                    }
                }
                for (name, member) in value.as_object().into_iter().flatten() {
                    match known.get(name) {
                        Some(rule) => misfits(rule, root, member, &format!("{path}/{name}"), found),
                        None => found.push(format!("{path}: the schema does not know `{name}`")),
                    }
                }
                // All members are always there, so a program need not ask whether they are.
                assert_eq!(required.len(), known.len(), "{path}: members that may be missing");
                true
            }
            other => panic!("keyword {other}"),
        };
        if !fits {
            found.push(format!("{path}: not as `{keyword}` says: {value}"));
        }
    }
}

fn schema_of_findings() -> Value {
    Shop::new().gcheck("schema findings").json()
}

#[test]
fn json_and_each_line_of_jsonl_are_as_their_schema_says() {
    let schema = schema_of_findings();
    let shop = shop();
    let mut found = Vec::new();
    let (whole, findings) = output(&shop, "json");
    let whole: Value = serde_json::from_str(&whole).unwrap();
    misfits(&schema, &schema, &whole, "", &mut found);
    // Every member is met with something in it.
    for member in ["labels", "notes", "assumptions", "fixes"] {
        let is_used =
            findings.iter().any(|finding| finding[member].as_array().is_some_and(|all| !all.is_empty()));
        assert!(is_used, "no finding has {member}");
    }
    let (lines, _) = output(&shop, "jsonl");
    let line = schema.pointer("/$defs/Line").unwrap();
    for text in lines.lines() {
        misfits(line, &schema, &serde_json::from_str(text).unwrap(), "", &mut found);
    }
    // Nothing found, nothing to check, a file that cannot be read.
    for arguments in
        ["check jobs/good.nc --control haas-mill", "check warned.nc missing.nc --control haas-mill"]
    {
        let run = shop.gcheck(&format!("{arguments} --output-format json"));
        misfits(&schema, &schema, &serde_json::from_str(&run.stdout).unwrap(), arguments, &mut found);
    }
    assert_eq!(found, [""; 0], "{}", found.join("\n"));
}

#[test]
fn what_is_not_as_the_schema_says_is_found() {
    let schema = schema_of_findings();
    let (whole, _) = output(&shop(), "json");
    let whole: Value = serde_json::from_str(&whole).unwrap();
    let spoilt: [(&str, Value); 6] = [
        ("/version", Value::from(2)),
        ("/findings/0/severity", Value::from("fatal")),
        ("/findings/0/range/start/line", Value::from("one")),
        ("/findings/0/fingerprint", Value::from("12")),
        ("/findings/0/labels", Value::Null),
        ("/files/0/control/source", Value::from("somewhere")),
    ];
    for (place, value) in spoilt {
        let mut copy = whole.clone();
        *copy.pointer_mut(place).unwrap() = value;
        let mut found = Vec::new();
        misfits(&schema, &schema, &copy, "", &mut found);
        assert!(!found.is_empty(), "{place}");
    }
    let mut copy = whole;
    copy["findings"][0]["new"] = Value::Null;
    copy["summary"].as_object_mut().unwrap().remove("hints");
    let mut found = Vec::new();
    misfits(&schema, &schema, &copy, "", &mut found);
    assert_eq!(found.len(), 2, "{found:?}");
}
