//! The output formats: what people read, and the shapes that other programs rely on.

use std::path::Path;
use std::process::Command;

use expect_test::expect;
use gcheck_testkit::skips::skip;
use serde_json::Value;

use crate::shop::{Shop, WARNED};

/// A program with an error, a warning with an assumption, and letters that count as one column each.
const PART: &str = "%\r\nO0001 G90 (PÄRT)\r\nG0 (Ä) X1\r\nG999\r\nM30\r\n%\r\n";

fn shop() -> Shop {
    Shop::with(&[("jobs/part.nc", PART), ("jobs/other.nc", WARNED)])
}

#[test]
fn full() {
    let run = shop().gcheck("check jobs/part.nc --control haas-mill --select unknown-code");
    expect![[r#"
        error[unknown-code]: unknown code `G999`
          ┌─ jobs/part.nc:4:1
          │
        4 │ G999
          │ ^^^^ no such code
          │
          = note: Haas mill (classic control and NGC) has no `G999`  [HM17 p.243 to 356, Haas online manual; M codes of options may be missing]
          = help: correct the code, or declare `G999` under `[codes]` if it is a code of your shop

        1 error in 1 file (6 lines)
        the verdict assumes:
          numbers without a decimal point count as the control usually reads them (Setting 162); to settle it: [settings] 162 = false
        ! jobs/part.nc: control haas-mill, set by `--control`
        exit 1
    "#]].assert_eq(&run.to_string());
}

#[test]
fn concise() {
    let run = shop().gcheck("check --control haas-mill --output-format concise");
    expect![[r#"
        jobs/other.nc:3:4: warning[missing-decimal-point] decimal point missing: `X1`
        jobs/part.nc:3:8: warning[missing-decimal-point] decimal point missing: `X1`
        jobs/part.nc:4:1: error[unknown-code] unknown code `G999`
        ! jobs/other.nc and 1 more file: control haas-mill, set by `--control`
        ! 1 error, 2 warnings in 2 files (11 lines)
        ! the verdicts rest on 1 assumption about the machines; `--output-format json` lists them
        exit 1
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn github() {
    let run =
        shop().gcheck("check jobs/part.nc --control haas-mill --select unknown-code --output-format github");
    expect![[r#"
        ::error title=gcheck (unknown-code),file=jobs/part.nc,line=4,endLine=4,col=1,endColumn=5::unknown code `G999`%0A  note: Haas mill (classic control and NGC) has no `G999`  [HM17 p.243 to 356, Haas online manual; M codes of options may be missing]%0A  help: correct the code, or declare `G999` under `[codes]` if it is a code of your shop
        ! jobs/part.nc: control haas-mill, set by `--control`
        ! 1 error in 1 file (6 lines)
        ! the verdict assumes:
        !   numbers without a decimal point count as the control usually reads them (Setting 162); to settle it: [settings] 162 = false
        exit 1
    "#]].assert_eq(&run.to_string());
}

/// The members of an object, with the types that the contract gives them.
fn check_shape(value: &Value, shape: &[(&str, &str)], whole: &Value) {
    for (key, kinds) in shape {
        let kind = match &value[key] {
            Value::Null if value.get(key).is_none() => "missing",
            Value::Null => "null",
            Value::Bool(_) => "boolean",
            Value::Number(number) if number.is_u64() => "count",
            Value::Number(_) => "number",
            Value::String(_) => "text",
            Value::Array(_) => "list",
            Value::Object(_) => "object",
        };
        assert!(kinds.split('|').any(|k| k == kind), "`{key}` is {kind}, not {kinds}, in {whole:#}");
    }
}

fn check_range(range: &Value, whole: &Value) {
    for end in ["start", "end"] {
        check_shape(&range[end], &[("line", "count"), ("column", "count"), ("offset", "count")], whole);
    }
}

#[test]
fn json_has_the_shape_of_the_contract() {
    let run = shop().gcheck("check --control haas-mill --output-format json");
    assert_eq!(run.stderr, "");
    let json = run.json();
    check_shape(
        &json,
        &[("version", "count"), ("files", "list"), ("findings", "list"), ("summary", "object")],
        &json,
    );
    assert_eq!(json["version"], 1);
    for file in json["files"].as_array().unwrap() {
        check_shape(file, &[("file", "text"), ("control", "object")], &json);
        check_shape(&file["control"], &[("name", "text"), ("source", "text")], &json);
    }
    let finding_shape = [
        ("rule", "text"),
        ("severity", "text"),
        ("certainty", "text"),
        ("message", "text"),
        ("file", "text"),
        ("range", "object"),
        ("labels", "list"),
        ("notes", "list"),
        ("help", "text|null"),
        ("alarm", "text|null"),
        ("assumptions", "list"),
        ("fixes", "list"),
    ];
    for finding in json["findings"].as_array().unwrap() {
        check_shape(finding, &finding_shape, &json);
        check_range(&finding["range"], &json);
        assert!(["error", "warning", "info", "hint"].contains(&finding["severity"].as_str().unwrap()));
        assert!(["always", "maybe"].contains(&finding["certainty"].as_str().unwrap()));
        for label in finding["labels"].as_array().unwrap() {
            check_shape(label, &[("message", "text"), ("file", "text"), ("range", "object")], &json);
        }
        for fix in finding["fixes"].as_array().unwrap() {
            check_shape(fix, &[("title", "text"), ("safe", "boolean"), ("edits", "list")], &json);
            for edit in fix["edits"].as_array().unwrap() {
                check_shape(edit, &[("file", "text"), ("range", "object"), ("text", "text")], &json);
                check_range(&edit["range"], &json);
            }
        }
    }
    let counts = ["files", "lines", "errors", "warnings", "infos", "hints", "suppressed", "baseline"];
    check_shape(&json["summary"], &counts.map(|count| (count, "count")), &json);
    check_shape(&json["summary"], &[("out_of_fuel", "list"), ("failed_rules", "list")], &json);
    assert_eq!(json["summary"]["files"], 2);
    assert_eq!(json["summary"]["errors"], 1);
    assert_eq!(json["summary"]["warnings"], 2);
    assert_eq!(json["summary"]["lines"], 11);
}

#[test]
fn json_counts_columns_in_characters_and_offsets_in_bytes() {
    let run = shop().gcheck("check jobs/part.nc --control haas-mill --output-format json");
    let finding = &run.json()["findings"][0];
    assert_eq!(finding["rule"], "missing-decimal-point");
    assert_eq!(finding["file"], "jobs/part.nc");
    assert_eq!(finding["range"]["start"]["line"], 3);
    assert_eq!(finding["range"]["start"]["column"], 8);
    let range = |end: &str| usize::try_from(finding["range"][end]["offset"].as_u64().unwrap()).unwrap();
    assert_eq!(&PART[range("start")..range("end")], "X1");
    assert_eq!(finding["assumptions"].as_array().unwrap().len(), 1, "{finding:#}");
}

#[test]
fn documents_are_whole_without_files() {
    let shop = Shop::new();
    assert_eq!(shop.gcheck("check --output-format json").json()["findings"], Value::Array(Vec::new()));
    assert_eq!(shop.gcheck("check --output-format sarif").json()["version"], "2.1.0");
    assert_eq!(shop.gcheck("check missing.nc --output-format json").json()["summary"]["files"], 0);
}

#[test]
fn sarif_says_rule_place_and_control() {
    let run = shop().gcheck("check --control haas-mill --output-format sarif");
    assert_eq!(run.stderr, "");
    let json = run.json();
    assert_eq!(json["version"], "2.1.0");
    let run = &json["runs"][0];
    assert_eq!(run["tool"]["driver"]["name"], "gcheck");
    let results = run["results"].as_array().unwrap();
    assert_eq!(results.len(), 3);
    let error = results.iter().find(|result| result["level"] == "error").unwrap();
    assert_eq!(error["ruleId"], "unknown-code");
    let place = &error["locations"][0]["physicalLocation"];
    assert_eq!(place["artifactLocation"]["uri"], "jobs/part.nc");
    assert_eq!(place["region"]["startLine"], 4);
    let index = usize::try_from(error["ruleIndex"].as_u64().unwrap()).unwrap();
    assert_eq!(run["tool"]["driver"]["rules"][index]["id"], "unknown-code");
    assert!(run["artifacts"].to_string().contains("haas-mill"), "{:#}", run["artifacts"]);
}

#[test]
fn sarif_is_valid() {
    let validator = "node_modules/@microsoft/sarif-multitool-linux/Sarif.Multitool";
    let validator = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../.test-tools").join(validator);
    if !validator.exists() {
        skip("sarif_is_valid", "SARIF validator", "`cargo xtask test` installs it");
        return;
    }
    let shop = shop();
    shop.file("jobs/strange name, ä.nc", "%\nO0001 G90\nG999 (\u{7f})\nX1 X1\n%\n");
    assert_eq!(shop.gcheck("check --control haas-mill --output-format sarif -o out.sarif").code, 1);
    let mut command = Command::new(validator);
    command.args(["validate", "out.sarif"]).current_dir(shop.path(""));
    let output = command.env("DOTNET_SYSTEM_GLOBALIZATION_INVARIANT", "1").output().unwrap();
    // It ends with 0 whatever it finds.
    let said =
        String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(!said.contains(": error "), "{said}");
    assert!(said.contains("Analysis completed successfully") || said.contains("Done"), "{said}");
}

/// The files that the formats of servers name, when gcheck runs in a folder of a repository.
fn named(shop: &Shop, folder: &str, variables: &[(&str, &str)], arguments: &str) -> Vec<String> {
    let of = |format: &str| {
        let mut command = shop.command();
        let all =
            format!("check {arguments} --control haas-mill --no-cache --quiet --output-format {format}");
        command.current_dir(shop.path(folder)).envs(variables.iter().copied()).args(all.split_whitespace());
        shop.finish(&mut command, b"").stdout
    };
    let between = |text: &str, start: &str, end: char| {
        let rest = text.split(start).nth(1).unwrap_or_else(|| panic!("{start} in {text}"));
        rest.split(end).next().unwrap().to_owned()
    };
    vec![
        between(&of("gitlab"), "\"path\":\"", '"'),
        between(&of("rdjson"), "\"path\":\"", '"'),
        between(&of("junit"), "classname=\"", '"'),
        between(&of("checkstyle"), "<file name=\"", '"'),
        between(&of("sarif"), "\"uri\": \"", '"'),
        between(&of("github"), "file=", ','),
        between(&of("azure"), "sourcepath=", ';'),
    ]
}

#[test]
fn servers_get_paths_from_the_root_of_the_repository() {
    let shop = Shop::with(&[("repo/.git/HEAD", ""), ("repo/sub/w.nc", WARNED)]);
    let root = shop.path("repo");
    let absolute = root.join("sub/w.nc");
    for arguments in ["w.nc", ".", "../sub/w.nc", absolute.to_str().unwrap()] {
        assert_eq!(named(&shop, "repo/sub", &[], arguments), ["sub/w.nc"; 7], "{arguments}");
    }
    // The server's own word counts more than where a repository begins, unless it is about another folder.
    let (outer, elsewhere) = (shop.path("."), shop.path("elsewhere"));
    let [outer, elsewhere] = [outer.to_str().unwrap(), elsewhere.to_str().unwrap()];
    for variable in ["CI_PROJECT_DIR", "GITHUB_WORKSPACE"] {
        assert_eq!(named(&shop, "repo/sub", &[(variable, outer)], "w.nc"), ["repo/sub/w.nc"; 7]);
        assert_eq!(named(&shop, "repo/sub", &[(variable, elsewhere)], "w.nc"), ["sub/w.nc"; 7]);
    }
    // It is the file that a repository holds, wherever gcheck runs.
    for arguments in ["repo/sub/w.nc", "repo", "repo/../repo/sub/w.nc", absolute.to_str().unwrap()] {
        assert_eq!(named(&shop, ".", &[], arguments), ["sub/w.nc"; 7], "{arguments}");
        for variable in ["CI_PROJECT_DIR", "GITHUB_WORKSPACE"] {
            let named = named(&shop, ".", &[(variable, root.to_str().unwrap())], arguments);
            assert_eq!(named, ["sub/w.nc"; 7], "{arguments}");
        }
    }
    assert_eq!(named(&shop, "repo/sub", &[], "w.nc --path-base ."), ["w.nc"; 7]);
    assert_eq!(named(&shop, "repo/sub", &[], "w.nc --path-base ../.."), ["repo/sub/w.nc"; 7]);
}

#[test]
fn each_file_is_named_from_its_own_repository() {
    let shop = Shop::with(&[
        ("a/.git/HEAD", ""),
        ("a/sub/one.nc", WARNED),
        ("a/vendored/.git", ""),
        ("a/vendored/two.nc", WARNED),
        ("loose/three.nc", WARNED),
    ]);
    let run = shop.gcheck("check --control haas-mill --quiet --output-format github");
    let files: Vec<&str> = { run.stdout.lines() }
        .map(|line| line.split("file=").nth(1).unwrap().split(',').next().unwrap())
        .collect();
    assert_eq!(files, ["sub/one.nc", "two.nc", "loose/three.nc"], "{run}");
}

#[test]
fn a_path_base_that_is_not_a_folder_is_refused() {
    let shop = Shop::with(&[("w.nc", WARNED)]);
    for (base, says) in [("nowhere", "nowhere: does not exist"), ("w.nc", "w.nc: is not a folder")] {
        let run = shop.gcheck(&format!("check w.nc --output-format github --path-base {base}"));
        assert!(run.code == 2 && run.stderr.contains(says) && run.stdout.is_empty(), "{run}");
    }
}

#[test]
fn people_and_programs_get_paths_from_where_gcheck_runs() {
    let shop = Shop::with(&[("repo/.git/HEAD", ""), ("repo/sub/w.nc", WARNED)]);
    for (format, name) in [("concise", "w.nc:3:4"), ("full", "┌─ w.nc:3:4"), ("json", "\"file\":\"w.nc\"")]
    {
        let mut command = shop.command();
        command.current_dir(shop.path("repo/sub"));
        command.args(["check", "w.nc", "--control", "haas-mill", "--output-format", format]);
        let run = shop.finish(&mut command, b"");
        assert!(run.stdout.replace(": ", ":").contains(name) || run.stdout.contains(name), "{run}");
    }
}

#[test]
fn junit_fails_where_the_exit_code_does() {
    let shop = Shop::with(&[("w.nc", WARNED)]);
    for (options, code, failures) in [
        ("", 0, 0),
        ("--fail-on warning", 1, 1),
        ("--max-warnings 0", 1, 1),
        ("--max-warnings 1", 0, 0),
        ("--fail-on never", 0, 0),
    ] {
        let run = shop.gcheck(&format!("check --control haas-mill --output-format junit {options}"));
        assert_eq!((run.code, run.stdout.matches("<failure").count()), (code, failures), "{options}: {run}");
        assert_eq!(run.stdout.matches("<system-out>").count(), 1 - failures, "{options}: {run}");
    }
}

#[test]
fn a_file_that_cannot_be_read_is_told_to_servers_and_counted() {
    let shop = Shop::with(&[("w.nc", WARNED)]);
    let check = |format: &str| {
        shop.gcheck(&format!("check w.nc gone.nc lost.nc --control haas-mill --output-format {format}"))
    };
    let run = check("full");
    assert!(run.stdout.contains("1 warning in 1 file (5 lines); 2 more files could not be checked"), "{run}");
    let run = check("junit");
    assert!(run.stdout.contains("tests=\"3\" failures=\"0\" errors=\"2\""), "{run}");
    assert!(run.stdout.contains("<error type=\"not-checked\""), "{run}");
    let run = check("sarif");
    let invocation = &run.json()["runs"][0]["invocations"][0];
    assert_eq!(invocation["executionSuccessful"], false);
    assert_eq!(invocation["toolExecutionNotifications"].as_array().unwrap().len(), 2, "{run}");
    assert_eq!(run.code, 2);
}
