//! The toolpath of a document for a preview.
//!
//! Knows: what a preview is told beside the drawing. Must not know: how moves are recorded and drawn.

use gcheck_db::{Cancelled, Snapshot};
use gcheck_engine::{Fault, Machine, Model, Options, Position};
use gcheck_toolpath::plot::{Heading, Plot};
use gcheck_toolpath::{Names, Timing, WorkCoordinates};
use serde::Serialize;
use serde_json::Value;

use crate::running::{Ran, Shown, is_turned, run_through, view};
use crate::sections::{headings, tool_names};

/// Most segments of a toolpath; more are thinned, and the answer says so.
pub const MAX_SEGMENTS: usize = 200_000;

/// The toolpath of one run.
#[derive(Debug, Clone, PartialEq, Serialize, Default)]
#[serde(rename_all = "camelCase")]
pub struct Toolpath {
    /// Data for the viewer, as the head of `gcheck-toolpath/src/plot/viewer.js` describes it. The document itself is the file
    /// with the empty name; lines count from 1.
    pub data: Value,
    /// How many moves the run had.
    pub moves: u64,
    /// Time of the run in seconds, as far as it is known.
    pub seconds: f64,
    /// What a reader of the picture has to know, one sentence each: that it is thinned, what is not drawn.
    pub notes: Vec<String>,
    /// Lowest and highest machine coordinates of X, Y and Z, where the machine's travel is told: millimetres.
    pub travel: [Option<(f64, f64)>; 3],
    /// How the run ended, where it did not reach the program's end.
    pub stopped: Option<String>,
    /// Where the control would stop, and decisions that nobody knows, in the order of the run: the picture goes on after them.
    pub alarms: Vec<PassedAlarm>,
}

/// A block that a run for a picture goes past.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PassedAlarm {
    /// The file; empty for the document.
    pub file: String,
    /// Its line, from 1.
    pub line: u32,
    /// What the picture does there, in a few words.
    pub words: String,
}

/// Alarms that are told one by one.
const MOST_ALARMS: usize = 100;

/// Runs the document for its toolpath, at most so many blocks.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn toolpath(
    snapshot: &Snapshot,
    fuel: u64,
    most_segments: usize,
    stop: &dyn Fn() -> bool,
) -> Result<Toolpath, Cancelled> {
    let machine = &snapshot.settings().machine.engine;
    let drawn = draw(snapshot, machine, fuel, most_segments, stop)?;
    if !drawn.is_subprogram || machine.start.is_some() {
        return Ok(drawn.path);
    }
    // A subprogram by itself: from where it is called nobody knows, and its increments lead nowhere without a start.
    let at_zero = Machine { start: Some(Position::ZERO), ..machine.clone() };
    let mut path = draw(snapshot, &at_zero, fuel, most_segments, stop)?.path;
    path.notes.insert(0, "a subprogram by itself: drawn as if it were called at zero of all axes".to_owned());
    Ok(path)
}

struct Drawn {
    path: Toolpath,
    is_subprogram: bool,
}

fn draw(
    snapshot: &Snapshot,
    machine: &Machine,
    fuel: u64,
    most_segments: usize,
    stop: &dyn Fn() -> bool,
) -> Result<Drawn, Cancelled> {
    let model = Model::new(snapshot.control());
    let timing = Timing::of_machine(&model, machine);
    let work = WorkCoordinates::at_power_on(&model, machine);
    let mut plot = Plot::new(view(snapshot, &model), timing, work, most_segments).on_machine(machine);
    if is_turned(snapshot) {
        plot = plot.for_lathe();
    }
    let mut alarms: Vec<PassedAlarm> = Vec::new();
    let options = Options { past_alarms: true, ..Options::NONE };
    let ran = run_through(snapshot, machine, options, fuel, stop, &mut |shown| match shown {
        Shown::Event(event) => plot.add(event),
        Shown::Alarm { file, line, fault } => {
            if **fault != Fault::Undecidable {
                plot.alarm(file, *line);
            }
            if alarms.len() < MOST_ALARMS {
                alarms.push(PassedAlarm {
                    file: (*file).to_owned(),
                    line: *line,
                    words: words(fault, *line),
                });
            }
        }
    })?;
    let Ran { stopped, is_subprogram, without } = ran;
    let drawing = plot.finish();
    let names = tool_names(snapshot);
    let tool = |tool| names.get(tool).map(str::to_owned);
    let offset = |number| Some(gcheck_lint::work_offset_name(number, &model));
    let found = headings(snapshot);
    let lines = found.iter().map(|heading| snapshot.line_at(heading.from) + 1);
    let headings: Vec<_> =
        found.iter().zip(lines).map(|(found, line)| Heading { file: "", line, name: &found.name }).collect();
    let mut notes = drawing.notes();
    notes.extend(without.into_iter().map(|what| format!("not drawn: {what}")));
    notes.extend(stopped.clone());
    let path = Toolpath {
        data: drawing.to_json(&Names { tool: &tool, offset: &offset }, &headings),
        moves: drawing.moves(),
        seconds: drawing.seconds().0,
        notes,
        travel: crate::running::LINEAR.map(|axis| machine.travel.get(&axis).copied()),
        stopped,
        alarms,
    };
    Ok(Drawn { path, is_subprogram })
}

fn words(fault: &Fault, line: u32) -> String {
    let what = match fault {
        Fault::Undecidable => {
            "which way the program goes is not known; the picture goes on with the next block"
        }
        _ => "the control would stop; the picture goes on as if the block were corrected",
    };
    format!("line {line}: {what}")
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use serde_json::json;

    use super::{MAX_SEGMENTS, Toolpath, toolpath};
    use crate::fixture::Fixture;

    fn drawn(text: &str, most_segments: usize) -> Toolpath {
        let snapshot = Fixture::new("haas-mill", text).snapshot();
        toolpath(&snapshot, 1_000, most_segments, &|| false).unwrap()
    }

    #[test]
    fn points_with_their_lines() {
        let text = "%\nO1\nG21 G90 G54\nT1 M6 (END MILL)\nG0 X0. Y0. Z2.\nG1 X50. F100.\nG2 X60. Y10. R10.\nM30\n%\n";
        let path = drawn(text, MAX_SEGMENTS);
        assert_eq!(path.data["version"], json!(2));
        assert_eq!(path.data["tools"][0]["name"], json!("END MILL"));
        assert_eq!(path.moves, 3);
        assert!(path.data["count"].as_u64().unwrap() > 3, "{}", path.data);
        assert_eq!(path.stopped, None);
    }

    #[test]
    fn an_endless_program_is_drawn_as_far_as_it_ran() {
        let path = drawn("O1\nN1 G91 G0 X1.\nGOTO 1\nM30\n", 100);
        assert_eq!(path.stopped.as_deref(), Some("ended after 1000 blocks"));
    }

    #[test]
    fn a_half_typed_cycle_leaves_the_rest_of_the_picture() {
        let before = "O1\nG21 G90 G54 G0 X0. Y0. Z50.\nG1 X5. F100.\n";
        let after = "G80\nG1 X50. Y50.\nM30\n";
        let path = drawn(&format!("{before}G83\nG83 X9.\n{after}"), MAX_SEGMENTS);
        assert_eq!(path.stopped, None);
        assert_eq!(path.data["all"], json!([[0.0, 0.0, 50.0], [50.0, 50.0, 50.0]]));
        assert_eq!(path.alarms.iter().map(|alarm| alarm.line).collect::<Vec<_>>(), [4, 5]);
        assert_eq!(path.data["alarms"][1], json!({ "file": 0, "line": 5, "at": [5.0, 0.0, 50.0] }));
    }

    #[test]
    fn a_program_that_is_not_there_is_named() {
        let path = drawn("O1\nG21 G90 G0 X1. Y0. Z1.\nM98 P4711\nM30\n", MAX_SEGMENTS);
        assert!(
            path.notes.iter().any(|note| note.starts_with("not drawn: ") && note.contains("4711")),
            "{:?}",
            path.notes
        );
    }

    #[test]
    fn a_subprogram_by_itself_is_drawn_from_an_assumed_start() {
        let path = drawn("O9010 (SLOT)\nG91 G1 Z-2. F100.\nX20.\nZ2.\nG90\nM99\n", MAX_SEGMENTS);
        assert_eq!(path.data["all"].as_array().map(Vec::len), Some(2), "{:?}", path.data);
        assert!(path.notes[0].contains("called at zero"), "{:?}", path.notes);
        assert!(path.data["count"].as_u64() >= Some(4), "{}", path.data);
    }

    #[test]
    fn moves_of_a_tilting_tool_are_drawn_where_they_were_posted() {
        let path = drawn(
            "O1\nG20 G90 G54 G0 X1. Y0. Z3. A0. B0.\nG143 H1 X1. Y0. Z3. A-15. B8.\nG1 X1.25 Z2. F20.\nM30\n",
            MAX_SEGMENTS,
        );
        assert_eq!(path.data["all"], json!([[25.4, 0.0, 50.8], [31.75, 0.0, 76.2]]));
        assert!(path.notes.iter().any(|note| note.contains("posted points")), "{:?}", path.notes);
    }

    #[test]
    fn passes_under_compensation_of_unknown_size_are_drawn_on_the_contour() {
        let text =
            "O1\nG21 G18 G99 T101\nG0 X60. Z5.\nG42 G0 X20. Z1.\nG1 Z-20. F0.1\nX40.\nG40 G0 X60. Z5.\nM30\n";
        let snapshot = Fixture::new("haas-lathe", text).snapshot();
        let path = toolpath(&snapshot, 1_000, MAX_SEGMENTS, &|| false).unwrap();
        assert_eq!(path.data["cut"], json!([[10.0, 0.0, -20.0], [20.0, 0.0, 1.0]]));
        assert!(path.notes.iter().any(|note| note.contains("programmed contour")), "{:?}", path.notes);
    }

    #[test]
    fn it_is_given_up_when_nobody_waits_any_more() {
        let endless = Fixture::new("haas-mill", "O1\nN1 G91 G0 X1.\nGOTO 1\nM30\n").snapshot();
        let asked = Cell::new(0);
        let stop = || {
            asked.set(asked.get() + 1);
            asked.get() > 3
        };
        assert!(toolpath(&endless, u64::MAX, MAX_SEGMENTS, &stop).is_err());
        assert_eq!(asked.get(), 4);
    }
}
