//! The toolpath of a document for a preview.
//!
//! Knows: what a preview is told beside the drawing. Must not know: how moves are recorded and drawn.

use gcheck_db::{Cancelled, Snapshot};
use gcheck_engine::Model;
use gcheck_toolpath::plot::Plot;
use gcheck_toolpath::{Names, Timing, WorkCoordinates};
use serde::Serialize;
use serde_json::Value;

use crate::parts::tool_names;
use crate::running::{is_turned, run_through, view};

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
}

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
    let model = Model::new(snapshot.control());
    let machine = &snapshot.settings().machine.engine;
    let timing = Timing::of_machine(&model, machine);
    let work = WorkCoordinates::at_power_on(&model, machine);
    let mut plot = Plot::new(view(snapshot, &model), timing, work, most_segments);
    if is_turned(snapshot) {
        plot = plot.for_lathe();
    }
    let stopped = run_through(snapshot, fuel, stop, &mut |seen| plot.add(seen))?;
    let drawing = plot.finish();
    let names = tool_names(snapshot);
    let tool = |tool| names.get(tool).map(str::to_owned);
    let mut notes = drawing.notes();
    notes.extend(stopped.clone());
    Ok(Toolpath {
        data: drawing.to_json(&Names { tool: &tool, ..Names::NONE }),
        moves: drawing.moves(),
        seconds: drawing.seconds().0,
        notes,
        travel: crate::running::LINEAR.map(|axis| machine.travel.get(&axis).copied()),
        stopped,
    })
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
        assert_eq!(path.data["version"], json!(1));
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
