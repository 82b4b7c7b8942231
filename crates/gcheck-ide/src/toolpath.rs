//! The toolpath of a document for a preview.
//!
//! Knows: what a preview is told beside the drawing. Must not know: how moves are recorded and drawn.

use gcheck_db::{Cancelled, Snapshot};
use gcheck_engine::{Fault, Machine, Model};
use gcheck_toolpath::plot::{Heading, Note, Plot};
use gcheck_toolpath::{Names, Statistics, Timing, WorkCoordinates};
use serde::Serialize;
use serde_json::Value;

use crate::caller::Caller;
use crate::running::{LINEAR, Pictured, Shown, is_turned, picture, view};
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
    /// What a reader of the picture has to know: what is assumed, that it is thinned, what is not drawn.
    pub notes: Vec<Note>,
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
    /// What is wrong with it, in a few words; of a decision that nobody knows, what the picture does.
    pub words: String,
}

/// Alarms that are told one by one.
const MOST_ALARMS: usize = 100;

/// Runs the document for its toolpath, at most so many blocks; a macro with the arguments of a caller.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn toolpath(
    snapshot: &Snapshot,
    caller: Option<&Caller>,
    fuel: u64,
    most_segments: usize,
    stop: &dyn Fn() -> bool,
) -> Result<Toolpath, Cancelled> {
    let model = Model::new(snapshot.control());
    let begin = |machine: &Machine| {
        let timing = Timing::of_machine(&model, machine);
        let work = WorkCoordinates::at_power_on(&model, machine);
        let view = view(snapshot, &model);
        let statistics = Statistics::new(view, timing, model.work_at_power_on());
        let plot = Plot::new(view, timing, work, most_segments).on_machine(machine);
        let plot = if is_turned(snapshot) { plot.for_lathe() } else { plot };
        Seen { plot, statistics, alarms: Vec::new() }
    };
    let Pictured { shown, ran, machine, is_at_zero } =
        picture(snapshot, caller, fuel, stop, begin, Seen::see)?;
    let Seen { plot, statistics, alarms } = shown;
    let stopped = ran.stopped;
    let drawing = plot.finish();
    let names = tool_names(snapshot);
    let tool = |tool| names.get(tool).map(str::to_owned);
    let offset = |number| Some(gcheck_lint::work_offset_name(number, &model));
    let found = headings(snapshot);
    let lines = found.iter().map(|heading| snapshot.line_at(heading.from) + 1);
    let headings: Vec<_> =
        found.iter().zip(lines).map(|(found, line)| Heading { file: "", line, name: &found.name }).collect();
    let at_zero =
        is_at_zero.then(|| "a subprogram by itself: drawn as if it were called at zero of all axes".into());
    let by_caller = caller.map(|caller| Note {
        words: format!(
            "drawn with the arguments of the call in {}, line {}: {}",
            caller.file, caller.line, caller.text
        ),
        file: Some(caller.file.clone()),
        line: Some(caller.line),
    });
    let notes = at_zero
        .into_iter()
        .chain(by_caller)
        .chain(drawing.notes())
        .chain(stopped.clone().map(Note::from))
        .collect();
    Ok(Toolpath {
        data: drawing.to_json(&Names { tool: &tool, offset: &offset }, &headings),
        moves: drawing.moves(),
        seconds: statistics.total().times.total().0,
        notes,
        travel: LINEAR.map(|axis| machine.travel.get(&axis).copied()),
        stopped,
        alarms,
    })
}

/// What is recorded of a run.
struct Seen {
    plot: Plot,
    /// The time is the one that stands above the tool sections.
    statistics: Statistics,
    alarms: Vec<PassedAlarm>,
}

impl Seen {
    fn see(&mut self, shown: &Shown<'_>) {
        match shown {
            Shown::Event(event) => {
                self.plot.add(event);
                self.statistics.add(event);
            }
            Shown::Assumed { file, line, words, .. } => self.plot.assumed(file, *line, words),
            Shown::Alarm { file, line, fault, words } => {
                let is_decision = **fault == Fault::Undecidable;
                if !is_decision {
                    self.plot.alarm(file, *line);
                }
                if self.alarms.len() < MOST_ALARMS {
                    let then = if is_decision { "; the picture goes on with the next block" } else { "" };
                    let words = Note::of_block(file, *line, &format!("{words}{then}")).words;
                    self.alarms.push(PassedAlarm { file: (*file).to_owned(), line: *line, words });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use serde_json::json;

    use super::{MAX_SEGMENTS, Toolpath, toolpath};
    use crate::fixture::Fixture;

    fn drawn(text: &str, most_segments: usize) -> Toolpath {
        let snapshot = Fixture::new("haas-mill", text).snapshot();
        toolpath(&snapshot, None, 1_000, most_segments, &|| false).unwrap()
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
        assert_eq!(path.alarms[1].words, "line 5: `G83` needs `Z`");
        assert_eq!(path.data["alarms"][1], json!({ "file": 0, "line": 5, "at": [5.0, 0.0, 50.0] }));
    }

    #[test]
    fn a_program_that_is_not_there_is_named() {
        let path = drawn("O1\nG21 G90 G0 X1. Y0. Z1.\nM98 P4711\nM30\n", MAX_SEGMENTS);
        assert!(
            path.notes
                .iter()
                .any(|note| note.words.contains("program 4711 was not found") && note.line == Some(3)),
            "{:?}",
            path.notes
        );
    }

    #[test]
    fn after_a_program_that_is_not_there_the_path_goes_on_as_if_it_changed_nothing() {
        let text = "O1\nT1 M6\nG0 G54 X0. Y0.\nG43 H1 Z50.\nG65 P9832\nG65 P9810 Z10. F1000.\nT2 M6\nG0 G54 X-30. Y0.\nG43 H2 Z5.\nG1 Z-5. F200.\nX30.\nM30\n";
        let snapshot = Fixture::new("fanuc-mill", text).snapshot();
        let path = toolpath(&snapshot, None, 1_000, MAX_SEGMENTS, &|| false).unwrap();
        assert_eq!(path.data["cut"], json!([[-30.0, 0.0, -5.0], [30.0, 0.0, 5.0]]), "{:?}", path.notes);
        let lines: Vec<_> = path.notes.iter().filter_map(|note| note.line).collect();
        assert_eq!(lines, [5, 6, 9], "{:?}", path.notes);
    }

    #[test]
    fn a_probe_touches_at_the_end_of_its_move() {
        let path = drawn(
            "O1\nG21 G90 G0 G54 X0. Y0. Z2.\nG31 Z-1. F5.\n#500=#5063\nG1 Z[#500-.1] F50.\nX10.\nM30\n",
            MAX_SEGMENTS,
        );
        assert_eq!(path.data["all"], json!([[0.0, 0.0, -1.1], [10.0, 0.0, 2.0]]), "{:?}", path.notes);
        assert!(
            path.notes.iter().any(|note| note.words.starts_with("line 3: probing moves")),
            "{:?}",
            path.notes
        );
    }

    #[test]
    fn moves_that_are_left_out_are_counted_and_named() {
        let path = drawn("O1\nG21 G90 G0 G54 X0. Y0. Z2.\nG1 X#501 F50.\nX10.\nX20.\nM30\n", MAX_SEGMENTS);
        let words: Vec<_> = path.notes.iter().map(|note| note.words.as_str()).collect();
        assert!(
            words.contains(
                &"2 moves are not drawn, since a coordinate of their start or end is not known: X in line 3, X in line 4"
            ),
            "{words:?}"
        );
    }

    #[test]
    fn the_alarm_of_a_program_itself_does_not_end_its_picture() {
        let path =
            drawn("O1\nG21 G90 G0 G54 X0. Y0. Z2.\n#3000=1 (NO TOOL)\nG1 X10. F50.\nM30\n", MAX_SEGMENTS);
        assert_eq!(path.data["cut"], json!([[0.0, 0.0, 2.0], [10.0, 0.0, 2.0]]));
        assert_eq!(path.alarms.iter().map(|alarm| alarm.line).collect::<Vec<_>>(), [3]);
    }

    #[test]
    fn a_subprogram_by_itself_is_drawn_from_an_assumed_start() {
        let path = drawn("O9010 (SLOT)\nG91 G1 Z-2. F100.\nX20.\nZ2.\nG90\nM99\n", MAX_SEGMENTS);
        assert_eq!(path.data["all"].as_array().map(Vec::len), Some(2), "{:?}", path.data);
        assert!(path.notes[0].words.contains("called at zero"), "{:?}", path.notes);
        assert!(path.data["count"].as_u64() >= Some(4), "{}", path.data);
    }

    #[test]
    fn a_subprogram_by_itself_takes_feed_speed_and_tool_from_whoever_calls_it() {
        let path =
            drawn("O9010 (SLOT)\nG91 G17 G1 Z-2.\nG3 I-5.\nG84 Z-5. R1.\nG80 G90\nM99\n", MAX_SEGMENTS);
        assert_eq!(path.alarms, []);
        assert_eq!(path.data["all"][0][1], json!(-127.0), "a circle, no line: {}", path.data["all"]);
    }

    #[test]
    fn a_macro_by_itself_is_drawn_with_the_arguments_of_a_caller() {
        let fixture = Fixture::new(
            "fanuc-mill",
            "//- part.nc\nO1\nG65 P9010 A10. C-2.\nM30\n//- O9010.nc\n$0O9010\nIF [#1 EQ #0] GOTO 900\nG90 G1 X#1 Y0. F100.\nZ#3\nM99\nN900 #3000=1 (A MISSING)\n",
        );
        let caller = crate::caller(&fixture.workspace, fixture.document);
        let path = toolpath(&fixture.snapshot(), caller.as_ref(), 1_000, MAX_SEGMENTS, &|| false).unwrap();
        assert_eq!(path.alarms, []);
        assert_eq!(path.data["all"], json!([[0.0, 0.0, -2.0], [10.0, 0.0, 0.0]]), "{:?}", path.notes);
        assert!(path.notes.iter().any(|note| note.words.ends_with("part.nc, line 2: G65 P9010 A10. C-2.")));
    }

    #[test]
    fn a_call_leads_to_its_moves() {
        let text = "O1\nG21 G90 G0 G54 X0. Y0. Z2.\nM97 P100 L2\nM30\nN100 G91 G1 X1. F100.\nM97 P200\nM99\nN200 Y1.\nM99\n";
        let path = drawn(text, MAX_SEGMENTS);
        assert_eq!(path.data["calls"], json!([[], [[0, 3]], [[0, 3], [0, 6]]]));
        assert!(path.data["callOf"].is_string());
    }

    #[test]
    fn moves_of_a_tilting_tool_are_drawn_where_they_were_posted() {
        let path = drawn(
            "O1\nG20 G90 G54 G0 X1. Y0. Z3. A0. B0.\nG143 H1 X1. Y0. Z3. A-15. B8.\nG1 X1.25 Z2. F20.\nM30\n",
            MAX_SEGMENTS,
        );
        assert_eq!(path.data["all"], json!([[25.4, 0.0, 50.8], [31.75, 0.0, 76.2]]));
        assert!(path.notes.iter().any(|note| note.words.contains("posted points")), "{:?}", path.notes);
    }

    #[test]
    fn passes_under_compensation_of_unknown_size_are_drawn_on_the_contour() {
        let text =
            "O1\nG21 G18 G99 T101\nG0 X60. Z5.\nG42 G0 X20. Z1.\nG1 Z-20. F0.1\nX40.\nG40 G0 X60. Z5.\nM30\n";
        let snapshot = Fixture::new("haas-lathe", text).snapshot();
        let path = toolpath(&snapshot, None, 1_000, MAX_SEGMENTS, &|| false).unwrap();
        assert_eq!(path.data["cut"], json!([[10.0, 0.0, -20.0], [20.0, 0.0, 1.0]]));
        assert!(path.notes.iter().any(|note| note.words.contains("programmed contour")), "{:?}", path.notes);
    }

    #[test]
    fn alarms_and_decisions_say_why() {
        let path = drawn(
            "O1\nG21 G90 G0 X1. Y0. Z50.\nG54.1 X2.\nIF [#101 GT 1] GOTO 9\n#3000=1 (NO TOOL)\nN9 X3.\nM30\n",
            MAX_SEGMENTS,
        );
        let words: Vec<_> = path.alarms.iter().map(|alarm| alarm.words.as_str()).collect();
        assert_eq!(
            words,
            [
                "line 3: the control does not have the code `G54.1`",
                "line 4: what happens next depends on `#101`, and its value is not known; the picture goes on with the next block",
                "line 5: the program raises alarm 1 itself: NO TOOL",
            ]
        );
    }

    #[test]
    fn it_is_given_up_when_nobody_waits_any_more() {
        let endless = Fixture::new("haas-mill", "O1\nN1 G91 G0 X1.\nGOTO 1\nM30\n").snapshot();
        let asked = Cell::new(0);
        let stop = || {
            asked.set(asked.get() + 1);
            asked.get() > 3
        };
        assert!(toolpath(&endless, None, u64::MAX, MAX_SEGMENTS, &stop).is_err());
        assert_eq!(asked.get(), 4);
    }
}
