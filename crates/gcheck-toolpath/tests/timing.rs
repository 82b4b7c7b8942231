//! Times of programs against those that a real planner took.
//!
//! `fixtures/timing/measured.tsv` holds the seconds that LinuxCNC's own motion planner took for each program of that folder at
//! each acceleration; `cargo xtask timing` measures them again. `docs/dev/timing.md` is the table of both;
//! `UPDATE_EXPECT=1` writes it.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

mod runner;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use expect_test::expect_file;
use gcheck_engine::{Axis, Dynamics, Machine, Position, Tool, Units};
use gcheck_geometry::{Mm, MmPerMin, Rpm, Seconds};

/// A program that takes this long is held to [`EACH`].
const LONG: f64 = 5.0;
/// How far a program may be off, by its time.
const EACH: f64 = 0.03;
/// How far all programs of an acceleration together may be off.
const SUM: f64 = 0.01;

/// The machine that the programs are timed on, at an acceleration in mm/s²: what `linuxcnc-timing` configures, and the times
/// of its simulated tool changer and coolant.
fn machine(acceleration: f64) -> Machine {
    let tool = Tool {
        pocket: 1,
        offset: Position::ZERO,
        diameter: Mm(6.0),
        corner_radius: Mm(0.0),
        angles: [0.0; 2],
        orientation: 0,
    };
    Machine {
        units: Some(Units::Mm),
        fresh: true,
        start: Some(Position::ZERO),
        rapid: Some(MmPerMin(12_000.0)),
        tool_change: Some(Seconds(0.38)),
        tools: [(1, tool)].into(),
        dynamics: Dynamics {
            acceleration: Axis::ALL.into_iter().map(|axis| (axis, acceleration)).collect(),
            auxiliary: Some(Seconds(0.082)),
            block_time: Some(Seconds(0.001_033)),
            spindle_acceleration: Some(Rpm(1e9)),
            ..Dynamics::default()
        },
        ..Machine::default()
    }
}

/// Programs that are off by more than [`EXPLAINED`] at some acceleration: by how much at most, and why.
const CAUSES: &[(&str, f64, &str)] = &[
    ("collinear-tiny", 0.03, "data starved: what a block takes varied from run to run"),
    ("coolant-between", 0.08, "the control answers coolant and tool changes in cycles of 0.1 s"),
    ("corner-002", 0.02, "not explained"),
    ("drop-in-blend", 0.05, "moves that no flat arc joins, without a tolerance"),
    ("helix-corners", 0.1, "helices that end where the path nearly turns back"),
    ("line-arc-corner-exact", 0.02, "not explained"),
    ("messages-between", 0.03, "not explained"),
    ("noisy-line", 0.02, "not explained"),
    ("outputs-between", 0.02, "not explained"),
    ("shifts-between", 0.04, "not explained"),
    ("starved", 0.03, "data starved: what a block takes varied from run to run"),
    ("tool-changes", 0.05, "the control answers coolant and tool changes in cycles of 0.1 s"),
    ("waves", 0.03, "not explained"),
];
/// Programs whose corners the control cuts: the path is shorter than they say, and so may be the time.
const CUTS_CORNERS: &[&str] = &[
    "corner-030-blend",
    "corner-150-blend",
    "corner-slow",
    "drop-in-blend",
    "line-arc-corner-blend",
    "pocket-blend",
    "rapids-blend",
    "square-blend",
    "square-p2",
];
/// What is nearer needs no cause.
const EXPLAINED: f64 = 0.01;

/// A program at an acceleration.
#[derive(Debug)]
struct Row {
    program: String,
    acceleration: u32,
    ours: f64,
    theirs: f64,
    /// The time without acceleration.
    bound: f64,
}

impl Row {
    fn off(&self) -> f64 {
        self.ours / self.theirs - 1.0
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/timing")
}

/// The programs of our own, or those of the corpus; none of these without `GCHECK_CORPUS`.
fn rows(of_corpus: bool) -> Vec<Row> {
    let corpus = std::env::var_os("GCHECK_CORPUS").map(PathBuf::from);
    let table = std::fs::read_to_string(folder().join("measured.tsv")).unwrap();
    let mut rows = Vec::new();
    for line in table.lines().skip(1) {
        let [program, acceleration, seconds] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        let path = match (program.strip_prefix("corpus/"), &corpus) {
            (Some(name), Some(corpus)) if of_corpus => corpus.join(name),
            (None, _) if !of_corpus => folder().join(format!("{program}.ngc")),
            _ => continue,
        };
        let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
        let (acceleration, theirs): (u32, f64) = (acceleration.parse().unwrap(), seconds.parse().unwrap());
        let machine = machine(acceleration.into());
        let time = |machine: &Machine| runner::figures("linuxcnc", machine, &text).total().times.total().0;
        let bound = time(&Machine { dynamics: Dynamics::default(), ..machine.clone() });
        rows.push(Row { program: program.to_owned(), acceleration, ours: time(&machine), theirs, bound });
    }
    rows
}

fn sums(rows: &[Row]) -> BTreeMap<u32, (f64, f64, f64)> {
    let mut sums: BTreeMap<u32, (f64, f64, f64)> = BTreeMap::new();
    for row in rows {
        let sum = sums.entry(row.acceleration).or_default();
        *sum = (sum.0 + row.bound, sum.1 + row.ours, sum.2 + row.theirs);
    }
    sums
}

#[expect(clippy::cast_precision_loss, reason = "few programs")]
fn share(rows: &[Row], off: impl Fn(&Row) -> f64, most: f64) -> String {
    let within = rows.iter().filter(|row| off(row).abs() <= most).count();
    format!("{:.1} %", within as f64 / rows.len() as f64 * 100.0)
}

/// The page: sums, shares, every program.
fn page(title: &str, about: &str, rows: &[Row]) -> String {
    let mut page = format!(
        "<!-- Written by `UPDATE_EXPECT=1 cargo test -p gcheck-toolpath --test timing`. -->\n\n# {title}\n\n{about}\n\n"
    );
    page += "## Sums\n\n| acceleration, mm/s² | programs | lower bound, s | estimate, s | measured, s | estimate is off by |\n|---|---|---|---|---|---|\n";
    for (acceleration, (bound, ours, theirs)) in sums(rows) {
        let count = rows.iter().filter(|row| row.acceleration == acceleration).count();
        let off = (ours / theirs - 1.0) * 100.0;
        writeln!(page, "| {acceleration} | {count} | {bound:.1} | {ours:.1} | {theirs:.1} | {off:+.2} % |")
            .unwrap();
    }
    page += "\n## Programs within a share of the measured time\n\n| | 1 % | 3 % | 5 % | 15 % |\n|---|---|---|---|---|\n";
    let shares =
        |off: &dyn Fn(&Row) -> f64| [0.01, 0.03, 0.05, 0.15].map(|most| share(rows, off, most)).join(" | ");
    writeln!(page, "| estimate | {} |", shares(&Row::off)).unwrap();
    writeln!(page, "| lower bound | {} |", shares(&|row| row.bound / row.theirs - 1.0)).unwrap();
    page += "\n## Programs\n\nMeasured seconds, and by how much the estimate is off.\n\n| program |";
    let accelerations: Vec<u32> = sums(rows).into_keys().collect();
    for acceleration in &accelerations {
        write!(page, " at {acceleration} | |").unwrap();
    }
    page += " cause |\n|---|";
    page += &"---|---|".repeat(accelerations.len());
    page += "---|\n";
    let mut programs: BTreeMap<&str, BTreeMap<u32, &Row>> = BTreeMap::new();
    for row in rows {
        programs.entry(&row.program).or_default().insert(row.acceleration, row);
    }
    for (program, by_acceleration) in programs {
        write!(page, "| {program} |").unwrap();
        for acceleration in &accelerations {
            match by_acceleration.get(acceleration) {
                Some(row) => write!(page, " {:.3} | {:+.2} % |", row.theirs, row.off() * 100.0).unwrap(),
                None => page += " | |",
            }
        }
        let cause = CAUSES.iter().find(|(name, ..)| *name == program).map_or("", |(_, _, cause)| cause);
        writeln!(page, " {cause} |").unwrap();
    }
    page
}

#[test]
fn times_are_those_of_the_real_planner() {
    let rows = rows(false);
    let sums = sums(&rows);
    assert_eq!(sums.len(), 4, "{sums:?}");
    for (acceleration, (_, ours, theirs)) in &sums {
        assert!((ours / theirs - 1.0).abs() < SUM, "at {acceleration}: {ours} s, measured {theirs} s");
    }
    let is_off = |row: &&Row| match CAUSES.iter().find(|(program, ..)| *program == row.program) {
        Some((_, most, _)) => row.off().abs() > *most,
        None => row.theirs >= LONG && row.off().abs() > EACH,
    };
    let off: Vec<&Row> = rows.iter().filter(is_off).collect();
    assert!(off.is_empty(), "{off:#?}");
    let about = "Times of the programs in `fixtures/timing` on a machine of 200 mm/s for every axis, by gcheck and by LinuxCNC's own motion planner (`cargo xtask timing`).\nEach program isolates one thing: an angle of corners, a path mode, a length of segments, a cycle.\n[time.md](../time.md) explains the model and its limits.";
    expect_file!["../../../docs/dev/timing.md"].assert_eq(&page(
        "Times beside those of a real planner",
        about,
        &rows,
    ));
}

#[test]
fn programs_that_are_far_off_have_a_cause() {
    let rows = rows(false);
    let is_explained = |row: &&Row| CAUSES.iter().any(|(program, ..)| *program == row.program);
    let unexplained: Vec<&Row> =
        rows.iter().filter(|row| row.off().abs() > EXPLAINED && !is_explained(row)).collect();
    assert!(unexplained.is_empty(), "{unexplained:#?}");
    for (program, ..) in CAUSES {
        assert!(rows.iter().any(|row| row.program == *program && row.off().abs() > EXPLAINED), "{program}");
    }
}

/// The bound is that of the path as it is programmed.
#[test]
fn no_time_is_below_the_bound_but_for_corners_that_are_cut() {
    for row in rows(false).iter().filter(|row| !CUTS_CORNERS.contains(&&*row.program)) {
        let least = row.bound * 0.998;
        assert!(row.ours >= least && row.theirs >= least, "{row:?}");
    }
}

/// With less acceleration the arcs in corners are wider, and the path is shorter.
#[test]
fn a_slow_path_of_corners_takes_longer_with_more_acceleration() {
    let rows = rows(false);
    let at = |acceleration| {
        rows.iter().find(|row| row.program == "corner-slow" && row.acceleration == acceleration).unwrap()
    };
    let [less, more] = [at(1_000), at(4_000)];
    assert!(more.theirs > less.theirs * 1.005 && more.ours > less.ours * 1.005, "{less:?} {more:?}");
}
