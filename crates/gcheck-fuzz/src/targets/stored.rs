//! Baselines and cache entries: what is not one is refused, and what is one is written as it was read.
//!
//! Knows: both forms. Must not know: where files are.

use gcheck::of_bytes;
use gcheck_report::Baseline;

use crate::choices::Choices;

const PIECES: &[&str] = &[
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"version\":1",
    "\"version\":2",
    "\"findings\":[",
    "{\"file\":\"a.nc\",\"rule\":\"words\",",
    "\"fingerprint\":\"0123456789abcdef0123456789abcdef\"}",
    "\"omitted\":3}",
    "\"fingerprint\":\"\"}",
    "\n",
    "<<<<<<< a\n",
    "=======\n",
    "null",
    "-1",
    "18446744073709551615",
    "\"\\ud800\"",
    "\"é\"",
    "\"omitted\":18446744073709551615}",
];

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    match choices.below(3) {
        0 => {
            of_bytes::stored_result(choices.rest());
        }
        1 => baseline(&String::from_utf8_lossy(choices.rest())),
        _ => {
            let mut text = String::from("{\"version\":1,\"findings\":[");
            while !choices.is_empty() && text.len() < 4_000 {
                text.push_str(choices.text(PIECES));
            }
            text.push_str("]}");
            baseline(&text);
        }
    }
}

fn baseline(text: &str) {
    let Ok(read) = Baseline::parse(text) else { return };
    let written = read.to_text();
    assert_eq!(Baseline::parse(&written), Ok(read), "a baseline is written as it was read");
}
