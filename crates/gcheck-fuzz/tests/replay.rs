//! Every target on its seeds, and on bytes that are drawn: what fuzzing once found stays found.
//!
//! Knows: where seeds are. Must not know: any target.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::path::Path;
use std::time::{Duration, Instant};
use std::{env, fs};

use gcheck_fuzz::{TARGETS, Target, target};

/// Drawn inputs of a target stop after that long.
const TIME_OF_DRAWING: Duration = Duration::from_millis(500);
/// Drawn inputs of a target, at most.
const MOST_DRAWN: u64 = 200;

/// How long inputs are drawn, and how many at most: `GCHECK_DRAW=N` draws for N seconds.
fn drawing() -> (Duration, u64) {
    let seconds = env::var("GCHECK_DRAW").ok().and_then(|seconds| seconds.parse().ok());
    seconds.map_or((TIME_OF_DRAWING, MOST_DRAWN), |seconds| (Duration::from_secs(seconds), u64::MAX))
}

/// The seeds of a target: a line each, in hexadecimal.
fn seeds(target: Target) -> Vec<Vec<u8>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds").join(target.name).with_extension("hex");
    let text = fs::read_to_string(path).unwrap();
    text.lines()
        .map(|line| {
            (0..line.len() / 2).map(|at| u8::from_str_radix(&line[2 * at..2 * at + 2], 16).unwrap()).collect()
        })
        .collect()
}

#[expect(clippy::print_stdout, reason = "a person who draws for long wants to know how many there were")]
fn replay(name: &str) {
    let target = target(name).unwrap();
    // As much stack as every thread of gcheck that works on a program has.
    let work = std::thread::Builder::new().stack_size(8 << 20).spawn(move || {
        for seed in seeds(target) {
            (target.run)(&seed);
        }
        let started = Instant::now();
        let (time, most) = drawing();
        for number in 0..most {
            if started.elapsed() > time {
                println!("{number} inputs were drawn");
                break;
            }
            (target.run)(&drawn(number));
        }
    });
    work.unwrap().join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
}

/// Bytes that look random and are the same every time.
fn drawn(number: u64) -> Vec<u8> {
    let mut state = number.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state.to_le_bytes()[3]
    };
    let length = 8 + usize::from(next()) * 2;
    (0..length).map(|_| next()).collect()
}

macro_rules! replays {
    ($($test:ident $name:literal)*) => {
        $(#[test]
        fn $test() {
            replay($name);
        })*

        #[test]
        fn every_target_is_replayed() {
            let names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
            assert_eq!(names, [$($name),*]);
        }
    };
}

replays! {
    any_bytes_have_a_tree_that_is_the_text "tokens"
    an_edited_document_is_a_fresh_one "tree"
    the_tree_and_the_tokens_give_the_same_blocks "lowering"
    an_edited_program_has_the_findings_of_a_fresh_check "edits"
    the_analysis_covers_runs_and_faults_have_findings "flow"
    runs_end "running"
    formatting_keeps_the_moves_and_twice_is_once "formatting"
    fixes_end_and_safe_ones_keep_the_moves "fixes"
    configurations_are_read_or_refused "configuration"
    machine_descriptions_are_read_or_refused "imports"
    stored_results_are_read_or_refused "stored"
    editor_features_stay_inside_the_file "editor"
    the_server_answers_every_request "messages"
}
