//! Clean programs, checked by somebody who configures nothing: a rule of infos speaks once in 500 lines at most.
//!
//! Knows: the clean programs. Must not know: any rule.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::shop::Shop;

/// Lines for one finding of a rule.
const LINES: usize = 500;

#[test]
fn a_rule_of_infos_speaks_once_in_500_lines_of_clean_programs() {
    let clean = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/clean");
    let shop = Shop::new();
    for folder in fs::read_dir(clean).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir())
    {
        for file in fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
            // Without its configuration the control is guessed.
            if file.extension().is_some_and(|extension| extension != "toml") {
                let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
                shop.file(&format!("{}/{}", name(&folder), name(&file)), fs::read(&file).unwrap());
            }
        }
    }
    let report = shop.gcheck("check --output-format json").json();
    let lines = usize::try_from(report["summary"]["lines"].as_u64().unwrap()).unwrap();
    assert!(lines > LINES, "{lines}");
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for finding in report["findings"].as_array().unwrap() {
        if ["info", "hint"].contains(&finding["severity"].as_str().unwrap()) {
            *counts.entry(finding["rule"].as_str().unwrap()).or_default() += 1;
        }
    }
    let talkative: Vec<_> = counts.into_iter().filter(|(_, count)| count * LINES > lines).collect();
    assert!(talkative.is_empty(), "in {lines} lines: {talkative:?}");
}
