//! Fuzz targets: each makes something of bytes (a program, edits, a configuration, messages), gives it to gcheck, and panics
//! where a law does not hold.
//!
//! Knows: the laws, and how bytes become inputs that reach far. Must not know: what chooses the bytes. A fuzzer that is guided
//! by coverage does (`cargo xtask fuzz`, `fuzz/`), and so does a test that replays a small corpus (`tests/replay.rs`).
//!
//! Never part of a release.

mod choices;
#[path = "../../gcheck-engine/tests/flow_covers_run/draw.rs"]
#[expect(clippy::indexing_slicing, reason = "shared with a test")]
mod draw;
#[path = "../../gcheck-engine/tests/flow_covers_run/generator.rs"]
#[expect(clippy::indexing_slicing, reason = "shared with a test")]
mod generator;
#[path = "../../gcheck-engine/tests/flow_covers_run/law.rs"]
#[expect(clippy::unwrap_used, reason = "shared with a test")]
mod law;
mod programs;
mod targets;

/// Something that is fuzzed.
#[derive(Clone, Copy)]
pub struct Target {
    /// Its name on the command line, and that of its seeds.
    pub name: &'static str,
    /// Panics where a law does not hold for what these bytes make.
    pub run: fn(&[u8]),
}

/// Every target.
pub const TARGETS: &[Target] = &[
    Target { name: "tokens", run: targets::tokens::run },
    Target { name: "tree", run: targets::tree::run },
    Target { name: "lowering", run: targets::lowering::run },
    Target { name: "edits", run: targets::edits::run },
    Target { name: "flow", run: targets::flow::run },
    Target { name: "running", run: targets::running::run },
    Target { name: "formatting", run: targets::formatting::run },
    Target { name: "fixes", run: targets::fixes::run },
    Target { name: "configuration", run: targets::configuration::run },
    Target { name: "imports", run: targets::imports::run },
    Target { name: "stored", run: targets::stored::run },
    Target { name: "editor", run: targets::editor::run },
    Target { name: "messages", run: targets::messages::run },
];

/// The target of a name.
pub fn target(name: &str) -> Option<Target> {
    TARGETS.iter().copied().find(|target| target.name == name)
}

/// The program that the program targets make of these bytes, and the control that reads it; for a person who looks at an input that
/// failed.
pub fn shown(bytes: &[u8]) -> String {
    let case = programs::case(bytes);
    format!("{}\n{}", case.control.name(), case.text)
}
