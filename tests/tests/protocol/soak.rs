//! Thousands of random edits and requests against a real program: in the end the server knows what a fresh one would, and has
//! grown no more than the text.
//!
//! Knows: where real programs are, how much memory a process has. Must not know: what any answer says.
//!
//! The usual run is short; `GCHECK_SOAK=20000` makes that many, as `cargo xtask test --soak` does.

use std::{env, fs};

use gcheck_testkit::{corpus, inputs};
use serde_json::json;

use crate::session::{Session, usual};
use crate::synchronizing::{Dice, Mirror};

/// Edits and requests of the usual run.
const SHORT: usize = 600;
/// The program is of this size, or less.
const LARGEST: u64 = 128 << 10;
/// Memory may grow by this much in the second half of the run, in kilobytes: allocators keep what they have.
const GROWTH: u64 = 96 << 10;

/// A real program of some size, or one of our own where there is no corpus.
fn program() -> String {
    let programs = corpus::programs().unwrap_or_default();
    let mut sized: Vec<_> = programs
        .into_iter()
        .filter_map(|program| Some((fs::metadata(&program.path).ok()?.len(), program.path)))
        .filter(|(size, _)| *size <= LARGEST)
        .collect();
    sized.sort();
    let real = sized.pop().and_then(|(_, path)| fs::read_to_string(path).ok());
    let text = real.unwrap_or_else(|| inputs::surfacing(3_000) + &inputs::macros(1_000));
    // This client knows one end of lines; the others have tests of their own.
    text.replace("\r\n", "\n").replace('\r', "\n")
}

const PIECES: [&str; 22] = [
    "",
    "",
    "",
    "G1 ",
    "G01 ",
    "X1.5",
    "Y-2. ",
    "\n",
    "\n\n",
    "N10 ",
    "N20\n",
    "GOTO 10\n",
    "(µm)",
    "日本",
    "😀",
    "G91\n",
    "G90\n",
    ".",
    "M30\n",
    "#100=2.\n",
    "WHILE [#1 LT 3.] DO1\n",
    "END1\n",
];

const AT_A_PLACE: [&str; 6] = [
    "textDocument/hover",
    "textDocument/completion",
    "textDocument/definition",
    "textDocument/documentHighlight",
    "gcheck/stateAt",
    "textDocument/signatureHelp",
];

const OF_THE_WHOLE: [&str; 5] = [
    "textDocument/documentSymbol",
    "textDocument/foldingRange",
    "textDocument/semanticTokens/full",
    "textDocument/codeLens",
    "textDocument/documentLink",
];

/// Kilobytes of memory that a process holds.
fn memory(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
fn after_thousands_of_edits_the_server_knows_what_a_fresh_one_does() {
    let rounds = env::var("GCHECK_SOAK").ok().and_then(|n| n.parse().ok()).unwrap_or(SHORT);
    let start = program();
    let mut session = Session::new(&[]);
    session.open("a.nc", &start);
    let mut mirror = Mirror::new(&start, false);
    let mut dice = Dice(7);
    let mut version = 1;
    let mut asked = Vec::new();
    let mut grown_from = None;
    for round in 0..rounds {
        match dice.below(10) {
            0..=5 => {
                version += 1;
                let change = mirror.random_edit(&mut dice, &PIECES);
                session.change("a.nc", version, &json!([change]));
            }
            6..=8 => {
                let [line, column] = mirror.position(0);
                let line = line + u32::try_from(dice.below(mirror.text.matches('\n').count() + 2)).unwrap();
                let at = session.at("a.nc", line, column + u32::try_from(dice.below(30)).unwrap());
                asked.push(session.client.send_request(dice.pick(&AT_A_PLACE), at));
            }
            _ => {
                let document = session.document("a.nc");
                asked.push(session.client.send_request(dice.pick(&OF_THE_WHOLE), document));
            }
        }
        if dice.below(20) == 0
            && let Some(id) = asked.last()
        {
            session.client.notify("$/cancelRequest", json!({ "id": id }));
        }
        // A person takes a breath now and then, in which findings are worked out.
        if round % 50 == 49 {
            for id in asked.drain(..) {
                session.client.answer(id);
            }
            session.published("a.nc", version);
            session.client.requests.clear();
            session.client.notifications.clear();
            // A text that only grows says nothing about memory.
            if mirror.text.len() > start.len() + start.len() / 4 {
                version += 1;
                mirror = Mirror::new(&start, false);
                session.change("a.nc", version, &json!([{ "text": start }]));
            }
        }
        if round == rounds / 2 {
            grown_from = memory(session.client.process());
        }
    }
    for id in asked {
        session.client.answer(id);
    }
    if let (Some(from), Some(now)) = (grown_from, memory(session.client.process())) {
        assert!(now < from + GROWTH, "from {from} kB to {now} kB");
    }
    // One more, so that the last findings are surely of the last text.
    version += 1;
    let change = mirror.random_edit(&mut dice, &PIECES);
    session.change("a.nc", version, &json!([change]));
    let text = session.text("a.nc");
    let same = text.bytes().zip(mirror.text.bytes()).take_while(|(a, b)| a == b).count();
    assert!(text == mirror.text, "differs at {same} of {} and {} bytes", text.len(), mirror.text.len());
    let findings = session.published_whole("a.nc", version);
    let mut fresh = Session::with(&usual(), &[]);
    fresh.open("a.nc", &mirror.text);
    let by_fresh = fresh.published_whole("a.nc", 1);
    let uri = session.uri("a.nc");
    let fresh_uri = fresh.uri("a.nc");
    let shown = |all: &[serde_json::Value]| {
        serde_json::to_string_pretty(all).unwrap_or_default().replace(&uri, "U").replace(&fresh_uri, "U")
    };
    assert!(shown(&findings) == shown(&by_fresh), "{}\n{}", shown(&findings), shown(&by_fresh));
    assert_eq!(session.client.end(), Some(0));
}
