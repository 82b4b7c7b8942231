//! What a person waits for at the cursor is answered soon, whatever is analysed meanwhile.
//!
//! Knows: a program whose analysis takes seconds, how long people wait. Must not know: what answers say.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

mod served;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use gcheck_db::Settings;
use gcheck_lint::RuleTable;
use gcheck_server::{Choice, Host, InForce, ProgramFile, ProgramQuery, ProgramText};
use gcheck_testkit::language_client::LanguageClient;
use serde_json::{Value, json};

/// Half of the answers come in this time: a tenth of a second, and as much more as a build without optimisation is slower.
const MEDIAN: Duration = Duration::from_millis(if cfg!(debug_assertions) { 400 } else { 100 });
/// Every answer does, on a busy machine as well: an analysis that is waited for takes at least twice as long.
const WORST: Duration = Duration::from_millis(1_400);
/// Every answer about a program whose state is not known yet: the server waits for it as long as it may.
const WORST_WITHOUT_STATE: Duration =
    Duration::from_millis(if cfg!(debug_assertions) { 3_000 } else { 1_000 });

/// Questions: more than the times that an analysis is given up for any question.
const QUESTIONS: usize = 50;
/// Each takes as long as the server waits for the state.
const FEW_QUESTIONS: usize = 6;

const SMALL: &str = "file:///work/small.nc";
const LARGE: &str = "file:///work/large.nc";

/// No files and no configuration.
struct Bare;

impl Host for Bare {
    fn in_force(&self, _: &ProgramQuery<'_>) -> InForce {
        let control = gcheck_controls::load(gcheck_controls::fallback()).unwrap();
        InForce {
            settings: Some(Settings::new(control, gcheck_rules::RULES)),
            choice: Choice::default(),
            style: None,
            folders: vec![PathBuf::from("/work")],
            configuration: None,
            problems: Vec::new(),
        }
    }

    fn programs_in(&self, _: &Path) -> Vec<ProgramFile> {
        Vec::new()
    }

    fn programs_below(&self, _: &Path) -> Vec<ProgramFile> {
        Vec::new()
    }

    fn read(&self, _: &Path) -> Option<ProgramText> {
        None
    }

    fn rules(&self) -> RuleTable {
        gcheck_rules::RULES
    }

    fn forget(&self) {}

    fn watched(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Programs that call each other under conditions: a megabyte, which is analysed until its time is used up, three seconds.
fn hard() -> String {
    let mut text = "%\n".to_owned();
    for program in 1..10 {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "O{program}");
        for call in 1..3_300 {
            let _ = write!(text, "IF[#{}EQ{call}]GOTO{call}\nM98 P{}\nN{call}\n", 100 + program, program + 1);
        }
        text.push_str("M99\n");
    }
    text + "O10\nG0 X1.\nM99\n%\n"
}

fn at(uri: &str, line: u32) -> Value {
    json!({ "textDocument": { "uri": uri }, "position": { "line": line, "character": 1 } })
}

/// A session with the large program open, and a small one.
fn session(capabilities: &Value) -> LanguageClient {
    let (mut client, _) = served::session(Bare, (LARGE, "gcode"), &hard(), capabilities);
    let text = "%\nO1\nG21 G90 G0 X1.\nS500 M3\nG1 X2. F100.\nM30\n%\n";
    let document = json!({ "uri": SMALL, "languageId": "gcode", "version": 1, "text": text });
    client.notify("textDocument/didOpen", json!({ "textDocument": document }));
    client
}

/// Asks again and again; gives how long the answers took, the shortest first.
fn times(client: &mut LanguageClient, uri: &str, questions: usize) -> Vec<Duration> {
    let mut times: Vec<Duration> = (0..questions)
        .map(|number| {
            // The owner of the documents turns to the analysis.
            thread::sleep(Duration::from_millis(20));
            let method = ["textDocument/hover", "textDocument/completion", "textDocument/signatureHelp"];
            let start = Instant::now();
            client.request(method.get(number % 3).unwrap(), at(uri, 4));
            start.elapsed()
        })
        .collect();
    times.sort();
    times
}

fn assert_soon(times: &[Duration], median: Duration, worst: Duration) {
    assert!(times.get(times.len() / 2).unwrap() < &median, "{times:?}");
    assert!(times.last().unwrap() < &worst, "{times:?}");
}

#[test]
fn what_is_asked_of_another_program_does_not_wait_for_the_analysis() {
    let mut client = session(&json!({}));
    client.notification("textDocument/publishDiagnostics", |params| params["uri"] == SMALL);
    let times = times(&mut client, SMALL, QUESTIONS);
    assert_soon(&times, MEDIAN, WORST);
    client.notification("textDocument/publishDiagnostics", |params| params["uri"] == LARGE);
}

#[test]
fn what_is_asked_goes_before_findings_that_were_asked_for() {
    let mut client = session(&json!({ "textDocument": { "diagnostic": {} } }));
    client.request("textDocument/hover", at(SMALL, 4));
    let report = client.send_request("textDocument/diagnostic", json!({ "textDocument": { "uri": LARGE } }));
    let times = times(&mut client, SMALL, QUESTIONS);
    assert_soon(&times, MEDIAN, WORST);
    let answer = client.answer(report);
    let is_told = answer["error"]["data"]["retriggerRequest"] == true || answer["result"]["kind"] == "full";
    assert!(is_told, "{answer}");
}

#[test]
fn what_is_asked_of_the_program_itself_is_answered_from_its_text() {
    let mut client = session(&json!({}));
    let times = times(&mut client, LARGE, FEW_QUESTIONS);
    assert_soon(&times, WORST_WITHOUT_STATE, WORST_WITHOUT_STATE);
}
