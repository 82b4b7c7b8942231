//! Times of programs against those that a real planner took.
//!
//! `fixtures/timing/measured.tsv` holds the seconds that LinuxCNC's own motion planner took for each program of that folder at
//! each acceleration; `cargo xtask timing` measures them again. `docs/dev/timing.md` is the table of both, and pictures beside
//! `docs/time.md` show the speed along the path of some programs; `UPDATE_EXPECT=1` writes them.
//!
//! Programs of other authors are read where `GCHECK_CORPUS` says, and `docs/dev/timing-corpus.md` is their table.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

mod runner;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use expect_test::expect_file;
use gcheck_engine::{Axis, Dynamics, Machine, Position, Tool, Units};
use gcheck_geometry::{Mm, MmPerMin, Rpm, Seconds};
use gcheck_testkit::corpus;
use gcheck_testkit::skips::skip;
use gcheck_toolpath::Stretch;

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

/// A program, by how much it may be off, and why.
type Cause = (&'static str, f64, &'static str);

/// Why threads are off.
const MARK: &str =
    "the wait for the spindle's mark is half a turn on average, and here the same at each pass";

/// Programs that are off by more than [`EXPLAINED`] at some acceleration: by how much at most, and why.
const CAUSES: &[Cause] = &[
    ("coolant-between", 0.08, "the control answers coolant and tool changes in cycles of 0.1 s"),
    ("near-tangents", 0.03, "not explained"),
    ("tap", 0.03, MARK),
    ("thread", 0.03, MARK),
    ("thread-cycle", 0.03, MARK),
    ("thread-run-out", 0.03, MARK),
    ("tool-changes", 0.05, "the control answers coolant and tool changes in cycles of 0.1 s"),
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

/// Our own programs, or those of the corpus: an empty list without a corpus.
fn rows(of_corpus: bool) -> Vec<Row> {
    let corpus_folder = corpus::folder();
    let table = std::fs::read_to_string(folder().join("measured.tsv")).unwrap();
    let mut rows = Vec::new();
    for line in table.lines().skip(1) {
        let [program, acceleration, seconds] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        let text = match (program.strip_prefix("corpus/"), &corpus_folder) {
            (Some(part), Some(folder)) if of_corpus => {
                String::from_utf8_lossy(&corpus::part(folder, part).unwrap()).into_owned()
            }
            (None, _) if !of_corpus => text_of(&folder().join(format!("{program}.ngc"))),
            _ => continue,
        };
        let (acceleration, theirs): (u32, f64) = (acceleration.parse().unwrap(), seconds.parse().unwrap());
        let machine = machine(acceleration.into());
        let time = |machine: &Machine| runner::figures("linuxcnc", machine, &text).total().times.total().0;
        let bound = time(&Machine { dynamics: Dynamics::default(), ..machine.clone() });
        rows.push(Row { program: program.to_owned(), acceleration, ours: time(&machine), theirs, bound });
    }
    rows
}

fn text_of(path: &Path) -> String {
    String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned()
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
fn page(title: &str, about: &str, rows: &[Row], causes: &[Cause]) -> String {
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
        let cause = causes.iter().find(|(name, ..)| *name == program).map_or("", |(_, _, cause)| cause);
        writeln!(page, " {cause} |").unwrap();
    }
    page
}

/// Programs that are off by more than they may be.
fn programs_off<'r>(rows: &'r [Row], causes: &[Cause]) -> Vec<&'r Row> {
    let is_off = |row: &&Row| match causes.iter().find(|(program, ..)| *program == row.program) {
        Some((_, most, _)) => row.off().abs() > *most,
        None => row.theirs >= LONG && row.off().abs() > EACH,
    };
    rows.iter().filter(is_off).collect()
}

#[test]
fn times_are_those_of_the_real_planner() {
    let rows = rows(false);
    let about = "Times of the programs in `fixtures/timing` on a machine of 200 mm/s for every axis, by gcheck and by LinuxCNC's own motion planner (`cargo xtask timing`).\nEach program isolates one thing: an angle of corners, a path mode, a length of segments, a cycle.\n[time.md](../time.md) explains the model and its limits.";
    expect_file!["../../../docs/dev/timing.md"].assert_eq(&page(
        "Times beside those of a real planner",
        about,
        &rows,
        CAUSES,
    ));
    let sums = sums(&rows);
    assert_eq!(sums.len(), 4, "{sums:?}");
    for (acceleration, (_, ours, theirs)) in &sums {
        assert!((ours / theirs - 1.0).abs() < SUM, "at {acceleration}: {ours} s, measured {theirs} s");
    }
    let off = programs_off(&rows, CAUSES);
    assert!(off.is_empty(), "{off:#?}");
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

/// Programs that `docs/time.md` shows before and after.
const SHOWN: [&str; 3] = ["contour-exact", "drill-peck", "tool-changes"];

#[test]
fn the_guide_shows_three_programs_before_and_after() {
    const BEGIN: &str = "--test timing`. -->\n";
    const END: &str = "<!-- end -->";
    let rows = rows(false);
    let mut table = "\n| program | lower bound | estimate | cutting | rapid | acceleration | auxiliary functions | tool change | measured |\n|---|---|---|---|---|---|---|---|---|\n".to_owned();
    for program in SHOWN {
        let row = rows.iter().find(|row| row.program == program && row.acceleration == 1_000).unwrap();
        let text = text_of(&folder().join(format!("{program}.ngc")));
        let times = runner::figures("linuxcnc", &machine(SAMPLED_AT), &text).total().times;
        let shown = [times.cutting, times.rapid, times.acceleration, times.auxiliary, times.tool_change]
            .map(|time| time.0);
        let rest = times.total().0 - shown.iter().sum::<f64>();
        assert!(rest.abs() < 0.05, "{program}: {rest} s are in no column");
        let shares: Vec<String> = shown.iter().map(|time| format!("{time:.1} s")).collect();
        let Row { bound, ours, theirs, .. } = row;
        writeln!(
            table,
            "| `{program}` | {bound:.1} s | {ours:.1} s | {} | {theirs:.1} s |",
            shares.join(" | ")
        )
        .unwrap();
    }
    let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/time.md");
    let text = text_of(&guide);
    let (before, rest) = text.split_once(BEGIN).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    expect_file![guide].assert_eq(&format!("{before}{BEGIN}{table}\n{END}{after}"));
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

/// Programs of other authors that are off by more than [`EACH`] at some acceleration: by how much at most, and why.
const CAUSES_OF_CORPUS: &[Cause] = &[];

#[test]
fn times_of_other_authors_programs_are_those_of_the_real_planner() {
    if corpus::folder().is_none() {
        let test = "times_of_other_authors_programs_are_those_of_the_real_planner";
        return skip(test, "corpus", "set GCHECK_CORPUS to the folder of the corpus");
    }
    let rows = rows(true);
    assert!(!rows.is_empty());
    let about = "Times of programs of other authors, or of their first lines, on the machine of [timing.md](timing.md), by gcheck and by LinuxCNC's own motion planner.\nThe model was made without most of them: `arc-arc-sawtooth`, `contour`, `blur_torus`, `cap` and `tort` showed what it lacked, and programs of our own isolate that.\nThe programs are not part of this repository: `GCHECK_CORPUS` names the folder that they are read from, and without it the test that makes this page is skipped.";
    let page = page("Times of other authors' programs", about, &rows, CAUSES_OF_CORPUS);
    expect_file!["../../../docs/dev/timing-corpus.md"].assert_eq(&page);
    let off = programs_off(&rows, CAUSES_OF_CORPUS);
    assert!(off.is_empty(), "{off:#?}");
}

/// Seconds and speed, mm/s, that were sampled along a program.
fn sampled(program: &str) -> Vec<(f64, f64)> {
    let table = text_of(&folder().join(format!("speeds/{program}.tsv")));
    let sample = |line: &str| {
        let (seconds, speed) = line.split_once('\t').unwrap();
        (seconds.parse().unwrap(), speed.parse().unwrap())
    };
    table.lines().skip(1).map(sample).collect()
}

/// The same by the estimate, at the same times.
fn estimated(program: &str, times: &[f64]) -> Vec<(f64, f64)> {
    let text = text_of(&folder().join(format!("{program}.ngc")));
    let statistics = runner::figures("linuxcnc", &machine(SAMPLED_AT), &text);
    let stretches = statistics.stretches();
    let start = stretches.iter().find(|stretch| stretch.is_motion()).unwrap().begin;
    let speed = |now: Seconds| {
        let under_way = |stretch: &&Stretch| stretch.begin <= now && now <= stretch.end();
        let speeds = stretches.iter().filter(under_way).map(|stretch| stretch.speed_at(now).0 / 60.0);
        speeds.fold(0.0, f64::max)
    };
    times.iter().map(|time| (*time, speed(start + Seconds(*time)))).collect()
}

/// Both as curves over time.
fn picture(program: &str, measured: &[(f64, f64)], ours: &[(f64, f64)]) -> String {
    const SIZE: (f64, f64) = (1000.0, 300.0);
    const LEFT: f64 = 50.0;
    const BOTTOM: f64 = 36.0;
    const TOP: f64 = 28.0;
    let fastest = measured.iter().chain(ours).fold(0.0, |most: f64, (_, speed)| most.max(*speed));
    let most = (fastest / 20.0).ceil() * 20.0;
    let last = measured.last().unwrap().0.ceil();
    let x = |time: f64| LEFT + time / last * (SIZE.0 - LEFT - 10.0);
    let y = |speed: f64| SIZE.1 - BOTTOM - speed / most * (SIZE.1 - BOTTOM - TOP);
    let line = |points: &[(f64, f64)], style: &str| {
        let mut path = String::new();
        for (time, speed) in points {
            write!(path, "{}{:.1} {:.1}", if path.is_empty() { "M" } else { "L" }, x(*time), y(*speed))
                .unwrap();
        }
        format!("<path d=\"{path}\" fill=\"none\" {style}/>\n")
    };
    let text = |at: (f64, f64), anchor: &str, words: &str| {
        format!("<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{words}</text>\n", at.0, at.1)
    };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        SIZE.0, SIZE.1
    );
    for part in 0..=4 {
        let (time, speed) = (last * f64::from(part) / 4.0, most * f64::from(part) / 4.0);
        let (right, height) = (SIZE.0 - 10.0, y(speed));
        writeln!(svg, "<path d=\"M{LEFT} {height:.1}H{right}\" stroke=\"#dddddd\"/>").unwrap();
        svg += &text((LEFT - 6.0, height + 4.0), "end", &format!("{speed}"));
        svg += &text((x(time), SIZE.1 - BOTTOM + 18.0), "middle", &format!("{time} s"));
    }
    svg += &text((LEFT, TOP - 10.0), "start", &format!("{program}: speed along the path, mm/s"));
    svg += &text(
        (SIZE.0 - 10.0, TOP - 10.0),
        "end",
        "<tspan fill=\"#f0a030\">measured</tspan>, <tspan fill=\"#1040a0\">estimate</tspan>",
    );
    svg += &line(measured, "stroke=\"#f0a030\" stroke-width=\"4\" stroke-linejoin=\"round\"");
    svg += &line(ours, "stroke=\"#1040a0\" stroke-width=\"1.2\"");
    svg + "</svg>\n"
}

/// The acceleration at which speeds were sampled.
const SAMPLED_AT: f64 = 1_000.0;
/// How far the way that a tool has gone may be off while it is sampled, by the whole way. Where moves overlap, the speed of
/// both together is more than that of the faster one.
const WAY: f64 = 0.05;

#[test]
fn the_way_gone_is_the_one_that_was_sampled() {
    let mut names: Vec<String> = std::fs::read_dir(folder().join("speeds"))
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    names.sort();
    assert_eq!(names.len(), 6, "{names:?}");
    for name in names {
        let measured = sampled(&name);
        let times: Vec<f64> = measured.iter().map(|(time, _)| *time).collect();
        let ours = estimated(&name, &times);
        let way = |curve: &[(f64, f64)]| {
            let pieces = curve.windows(2).map(|two| match two {
                [(before, one), (after, other)] => (after - before) * one.midpoint(*other),
                _ => 0.0,
            });
            pieces.sum::<f64>()
        };
        let [ours_goes, theirs_goes] = [way(&ours), way(&measured)];
        assert!(
            (ours_goes / theirs_goes - 1.0).abs() < WAY,
            "{name}: {ours_goes} mm, measured {theirs_goes} mm"
        );
        let file =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../docs/pictures/speed-{name}.svg"));
        expect_file![file].assert_eq(&picture(&name, &measured, &ours));
    }
}
