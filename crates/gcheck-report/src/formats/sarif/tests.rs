//! `sarif`, read back as a consumer would.
//!
//! Knows: the structure that viewers rely on. Must not know: the order of members.

use std::ops::Range;

use expect_test::expect_file;
use gcheck_diagnostics::{Finding, Severity};
use serde_json::Value;

use super::*;
use crate::Format;
use crate::testing::{ARC_OFF_CIRCLE, FEED_MISSING, everything, file, on, render, report};

fn parsed(report: &Report) -> Value {
    serde_json::from_str(&render(report, Format::Sarif)).unwrap()
}

fn at_path<'v>(value: &'v Value, path: &str) -> &'v Value {
    value.pointer(path).unwrap_or_else(|| panic!("{path} is missing"))
}

#[test]
fn everything_a_finding_can_say() {
    expect_file!["everything.sarif"].assert_eq(&render(&everything(), Format::Sarif));
}

#[test]
fn every_reference_resolves() {
    let log = parsed(&everything());
    assert_eq!(at_path(&log, "/version"), "2.1.0");
    let run = at_path(&log, "/runs/0");
    let bases = at_path(run, "/originalUriBaseIds");
    let results = at_path(run, "/results").as_array().unwrap();
    assert_eq!(results.len(), 2);
    for result in results {
        let index = at_path(result, "/ruleIndex");
        assert_eq!(at_path(run, &format!("/tool/driver/rules/{index}/id")), at_path(result, "/ruleId"));
        let place = at_path(result, "/locations/0/physicalLocation/artifactLocation");
        let index = at_path(place, "/index");
        assert_eq!(at_path(run, &format!("/artifacts/{index}/location/uri")), at_path(place, "/uri"));
        assert!(bases.get(at_path(place, "/uriBaseId").as_str().unwrap()).is_some());
    }
}

#[test]
fn too_many_results_are_cut_and_it_says_so() {
    let mild = |_| Finding { severity: Severity::Hint, ..Finding::new(&FEED_MISSING, 0..0, "mild") };
    let severe = Finding::new(&ARC_OFF_CIRCLE, 1..1, "severe");
    let report = report("G1", (0..25_000).map(mild).chain([severe]).collect());
    let log = parsed(&report);
    let results = at_path(&log, "/runs/0/results").as_array().unwrap();
    assert_eq!(results.len(), MOST_RESULTS);
    assert_eq!(at_path(results.last().unwrap(), "/message/text"), "severe.");
    assert_eq!(
        at_path(&log, "/runs/0/invocations/0/toolExecutionNotifications/0/message/text"),
        "1 of 25,001 findings are left out, the mildest first: a run holds at most 25,000."
    );
    let ids: Vec<&Value> = results.iter().map(|r| at_path(r, "/partialFingerprints")).collect();
    assert_ne!(ids[0], ids[1], "equal findings stay apart");
}

#[test]
fn paths_become_uris() {
    let uri = |path| {
        let location = artifact_location(path);
        (location.uri, location.uri_base_id.is_some())
    };
    let is = |uri: &str, relative| (uri.to_owned(), relative);
    assert_eq!(uri("./sub dir/100%,µ#1.nc"), is("sub%20dir/100%25%2C%C2%B5%231.nc", true));
    assert_eq!(uri("/home/a b/O1"), is("file:///home/a%20b/O1", false));
    assert_eq!(uri("C:/nc/part.nc"), is("file:///C:/nc/part.nc", false));
    assert_eq!(uri("//server/nc/part.nc"), is("file://server/nc/part.nc", false));
    assert_eq!(uri("a:b.nc"), is("a%3Ab.nc", true), "not a scheme");
}

#[test]
fn regions_of_odd_texts() {
    let region = |text: &str, range: Range<u32>| {
        let log = parsed(&report(text, vec![Finding::new(&FEED_MISSING, range, "m")]));
        let region = at_path(&log, "/runs/0/results/0/locations/0/physicalLocation/region");
        ["startLine", "startColumn", "endLine", "endColumn", "byteOffset", "byteLength"]
            .map(|name| region[name].as_u64().unwrap())
    };
    assert_eq!(region("", 0..0), [1, 1, 1, 1, 0, 0]);
    assert_eq!(region("G1\r\n", 4..4), [2, 1, 2, 1, 4, 0]);
    assert_eq!(region("(µ日😀)G1", 11..13), [1, 6, 1, 8, 11, 2]);
    assert_eq!(region("G1\rG2\rG3", 1..7), [1, 2, 3, 2, 1, 6]);
    assert_eq!(
        region("G1", Range { start: 9, end: 7 }),
        [1, 3, 1, 3, 2, 0],
        "outside, and the wrong way round"
    );
}

#[test]
fn a_result_names_its_file_wherever_it_is() {
    let report = Report::new(vec![file("b.nc", "G1", vec![on("G1", "G1")]), file("a.nc", "", vec![])]);
    let log = parsed(&report);
    assert_eq!(at_path(&log, "/runs/0/results/0/locations/0/physicalLocation/artifactLocation/index"), 1);
}
