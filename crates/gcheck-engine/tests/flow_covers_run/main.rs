//! Law 4: the analysis of all paths covers every run.
//!
//! Programs run many times, each time with other values for what nobody told: variables, block delete switches, touches of
//! probes, offsets, tools. Before every block the state of the run must be one that the analysis shows there
//! ([`Lattice::covers`](gcheck_engine::Lattice::covers), the function that the engine itself asks), on the same way of calls;
//! every move, every other event, every fault and every end of the run must be one that the analysis shows. No block that a
//! run comes to may be called unreachable, and when it comes to the program's end, it was at every block that the analysis
//! says every path comes to.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::print_stderr,
    reason = "a test that meets the unexpected is to fail, and says what it compared"
)]

mod draw;
mod generator;
mod law;
mod material;
#[cfg(feature = "forgetful")]
mod mutations;
mod programs;

use std::collections::BTreeMap;

use gcheck_engine::{Machine, NoLibrary};

use crate::draw::Random;
use crate::generator::{Style, Writer};
use crate::law::{Case, Counts, check};

/// Controls and the styles of their random programs.
#[cfg(feature = "forgetful")]
const GENERATED: [(&str, Style); 6] = [
    ("fanuc-mill", Style::Macro),
    ("haas-mill", Style::Local),
    ("haas-mill", Style::FiveAxis),
    ("linuxcnc", Style::OWords),
    ("fanuc-lathe", Style::Lathe),
    ("haas-lathe", Style::Lathe),
];

/// Random programs of a control, the same in every test run. Of those that fail in the same way, the one that is left of the
/// shortest is shown.
fn law(control: &'static str, style: Style, cases: u64) {
    let mut counts = Counts::default();
    let mut failures: BTreeMap<String, (String, u64)> = BTreeMap::new();
    for seed in 0..cases {
        let text = generated(style, seed);
        match generated_law(control, &text, seed) {
            Ok(seen) => counts.add(seen),
            Err(why) => {
                let slot = failures.entry(kind_of(&why)).or_insert_with(|| (text.clone(), seed));
                if text.len() < slot.0.len() {
                    *slot = (text, seed);
                }
            }
        }
    }
    eprintln!("{control}, {style:?}: {counts:?}");
    let shown: Vec<String> = failures
        .iter()
        .map(|(kind, (text, seed))| {
            let fails =
                |less: &str| generated_law(control, less, *seed).is_err_and(|why| kind_of(&why) == *kind);
            let text = shortened(text, fails);
            generated_law(control, &text, *seed).err().unwrap_or_default()
        })
        .collect();
    assert!(shown.is_empty(), "{control}, {style:?}: {} kinds\n{}", shown.len(), shown.join("\n"));
    // A law that hardly says anything of a program would say little.
    assert!(counts.left_out * 10 < counts.programs, "{control}: {counts:?}");
    assert!(counts.ended * 5 > counts.runs, "{control}: {counts:?}");
}

/// The program of a style and a number.
fn generated(style: Style, seed: u64) -> String {
    let mut random = Random::new(seed);
    let length = 10 + random.below(250);
    let choices: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
    Writer::new(&choices, style).program()
}

fn generated_law(control: &str, text: &str, seed: u64) -> Result<Counts, String> {
    let case = Case {
        name: "generated",
        control,
        text,
        machine: &Machine::default(),
        library: &NoLibrary,
        work: 40_000,
        fuel: 3_000,
    };
    check(&case, 3, &mut Random::new(seed))
}

/// A failure without its numbers.
fn kind_of(why: &str) -> String {
    let (_, why) = why.split_once(": ").unwrap_or_default();
    let end = why.find([':', '{', '\n']).unwrap_or(why.len());
    let rest = if why.starts_with("not shown") { &why[..why.len().min(34)] } else { &why[..end] };
    rest.chars().filter(|c| !c.is_ascii_digit()).collect()
}

/// The program without the lines that the failure does not need.
fn shortened(text: &str, fails: impl Fn(&str) -> bool) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let mut count = lines.len() / 2;
    while count > 0 {
        let mut at = 0;
        while at < lines.len() {
            let is_left = |number: &usize| !(at..at + count).contains(number);
            let less: Vec<&str> = lines
                .iter()
                .enumerate()
                .filter(|(number, _)| is_left(number))
                .map(|(_, line)| *line)
                .collect();
            if fails(&(less.join("\n") + "\n")) {
                lines = less;
            } else {
                at += count;
            }
        }
        count /= 2;
    }
    lines.join("\n") + "\n"
}

#[test]
fn the_flow_covers_the_run_with_gotos_and_macros() {
    law("fanuc-mill", Style::Macro, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_local_subprograms() {
    law("haas-mill", Style::Local, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_shifts_by_the_tool() {
    law("haas-mill", Style::FiveAxis, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_o_words() {
    law("linuxcnc", Style::OWords, 2_000);
}

#[test]
fn the_flow_covers_the_run_on_a_lathe() {
    law("fanuc-lathe", Style::Lathe, 1_000);
    law("haas-lathe", Style::Lathe, 1_000);
}

/// Checks programs one after the other; all that fail are named.
fn all(programs: &[material::Source], runs: u32, fuel: u64) -> Counts {
    let mut counts = Counts::default();
    let mut failures: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (number, source) in programs.iter().enumerate() {
        match check(&source.case(fuel), runs, &mut Random::new(number as u64)) {
            Ok(seen) => counts.add(seen),
            Err(why) => failures.entry(kind_of(&why)).or_default().push(why),
        }
    }
    let count: usize = failures.values().map(Vec::len).sum();
    let shortest = |all: &Vec<String>| all.iter().min_by_key(|why| why.len()).cloned();
    let shown: Vec<String> = failures.values().filter_map(shortest).collect();
    assert!(
        shown.is_empty(),
        "{count} of {} programs, {} kinds:\n{}",
        programs.len(),
        shown.len(),
        shown.join("\n")
    );
    counts
}

#[test]
fn the_flow_covers_the_runs_of_programs_written_for_each_field() {
    let counts = all(&programs::sources(), 24, 3_000);
    eprintln!("programs for each field: {counts:?}");
}

/// A gap that is closed goes from the list.
#[test]
fn the_gaps_that_are_known_are_there() {
    for (name, control, text) in programs::GAPS {
        let case = Case {
            name,
            control,
            text,
            machine: &Machine::default(),
            library: &NoLibrary,
            work: 40_000,
            fuel: 3_000,
        };
        assert!(check(&case, 64, &mut Random::new(1)).is_err(), "{name}: the law holds");
    }
}

#[test]
fn the_flow_covers_the_runs_of_the_fixtures() {
    let counts = all(&material::fixtures(), 6, 20_000);
    eprintln!("fixtures: {counts:?}");
    assert!(counts.left_out * 20 < counts.programs, "{counts:?}");
}

#[test]
fn the_flow_covers_the_runs_of_the_corpus() {
    let Some(programs) = material::corpus() else { return };
    let counts = all(&programs, 4, 10_000);
    eprintln!("corpus: {counts:?}");
    assert!(counts.left_out * 5 < counts.programs, "{counts:?}");
}
