//! A run made by hand: a state that the tests change, and the events they let happen in it.

#![expect(dead_code, reason = "every test file uses its part")]
#![expect(clippy::unwrap_used, clippy::indexing_slicing, reason = "a test fails by panicking")]

use gcheck_engine::{ArcMove, Axis, Event, FeedMode, Position, Travel, TravelKind, Units};
use gcheck_geometry::{Mm, Plane, Seconds};
use gcheck_toolpath::{
    Beside, Canonical, Csv, Ending, JsonLines, Start, Statistics, Step, Text, Timing, View,
};

/// A recorded step.
#[derive(Debug, Clone)]
pub(crate) struct Happened {
    pub(crate) event: Event,
    pub(crate) n: Option<u32>,
    line: u32,
    pub(crate) units: Units,
    feed_mode: FeedMode,
    feed: f64,
    rpm: f64,
    pub(crate) machine: Position,
    tool: Option<u32>,
    beside: Option<Beside>,
    aim: Position,
}

#[derive(Debug, Clone)]
pub(crate) struct Run {
    pub(crate) steps: Vec<Happened>,
    pub(crate) n: Option<u32>,
    pub(crate) line: u32,
    pub(crate) units: Units,
    pub(crate) feed_mode: FeedMode,
    pub(crate) feed: f64,
    pub(crate) rpm: f64,
    pub(crate) tool: Option<u32>,
    pub(crate) at: Position,
    /// Machine coordinates of the work's zero.
    pub(crate) zero: Position,
    pub(crate) expanded: bool,
    pub(crate) beside: Option<Beside>,
    /// Where moves would end without compensation.
    pub(crate) aim: Position,
}

/// Lines after bars, which keep their columns in an expectation.
pub(crate) fn barred(lines: &[&str]) -> String {
    lines.iter().flat_map(|line| ["|", line, "\n"]).collect()
}

pub(crate) fn point(x: f64, y: f64, z: f64) -> Position {
    Position::new([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
}

impl Run {
    pub(crate) fn new() -> Self {
        Self {
            steps: Vec::new(),
            n: None,
            line: 0,
            units: Units::Mm,
            feed_mode: FeedMode::PerMinute,
            feed: 0.0,
            rpm: 0.0,
            tool: Some(0),
            at: Position::ZERO,
            zero: Position::ZERO,
            expanded: false,
            beside: None,
            aim: Position::UNKNOWN,
        }
    }

    /// The next block, with this N word.
    pub(crate) fn n(&mut self, n: u32) -> &mut Self {
        self.n = Some(n);
        self.line += 1;
        self
    }

    /// The next block.
    pub(crate) fn block(&mut self) -> &mut Self {
        self.n = None;
        self.line += 1;
        self
    }

    pub(crate) fn event(&mut self, event: Event) -> &mut Self {
        self.steps.push(Happened {
            event,
            n: self.n,
            line: self.line,
            units: self.units,
            feed_mode: self.feed_mode,
            feed: self.feed,
            rpm: self.rpm,
            machine: self.at + self.zero,
            tool: self.tool,
            beside: self.beside,
            aim: self.aim,
        });
        self
    }

    pub(crate) fn travel(&mut self, kind: TravelKind, to: Position) -> &mut Self {
        let from = std::mem::replace(&mut self.at, to);
        self.event(Event::Travel(Travel { kind, from, programmed: to, to, expanded: self.expanded }))
    }

    pub(crate) fn rapid(&mut self, x: f64, y: f64, z: f64) -> &mut Self {
        self.travel(TravelKind::Rapid, self.at.with_xyz([x, y, z].map(Mm)))
    }

    pub(crate) fn feed(&mut self, x: f64, y: f64, z: f64) -> &mut Self {
        self.travel(TravelKind::Feed, self.at.with_xyz([x, y, z].map(Mm)))
    }

    pub(crate) fn turn(&mut self, kind: TravelKind, axis: Axis, degrees: f64) -> &mut Self {
        let mut to = self.at;
        to.set(axis, degrees);
        self.travel(kind, to)
    }

    /// An arc; `sweep` in degrees.
    pub(crate) fn arc(&mut self, plane: Plane, to: [f64; 3], centre: (f64, f64), sweep: f64) -> &mut Self {
        let to = self.at.with_xyz(to.map(Mm));
        let from = std::mem::replace(&mut self.at, to);
        let turns = ((sweep.abs() / 360.0).ceil() * sweep.signum()) as i32;
        self.event(Event::Arc(ArcMove {
            plane,
            from,
            programmed: to,
            to,
            centre: (Mm(centre.0), Mm(centre.1)),
            turns,
            sweep: sweep.to_radians(),
            expanded: self.expanded,
        }))
    }

    pub(crate) fn change(&mut self, tool: u32) -> &mut Self {
        self.tool = Some(tool);
        self.event(Event::ToolChange(Some(tool)))
    }

    pub(crate) fn each(&self, mut each: impl FnMut(&Step<'_>)) {
        for step in &self.steps {
            each(&Step {
                swings: false,
                swung_arc: None,
                event: &step.event,
                n: step.n,
                line: step.line,
                units: step.units,
                feed_mode: step.feed_mode,
                feed: step.feed,
                rpm: step.rpm,
                machine: step.machine,
                tool: step.tool,
                aim: step.aim,
                h: None,
                d: None,
                beside: step.beside,
                file: "part.nc",
                calls: &[],
            });
        }
    }

    /// Canonical functions without prologue and epilogue.
    pub(crate) fn canonical(&self, tools: &[u32]) -> String {
        let mut out = Canonical::new(Vec::new()).with_tool_table(tools.to_vec());
        out.prologue(&Start::default()).unwrap();
        self.each(|step| out.step(step).unwrap());
        let text = String::from_utf8(out.epilogue(Ending::Program).unwrap()).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        barred(&lines[6..lines.len() - 2])
    }

    pub(crate) fn jsonl(&self, view: View) -> String {
        let mut out = JsonLines::new(Vec::new(), view, timing());
        self.each(|step| out.step(step).unwrap());
        String::from_utf8(out.finish().unwrap()).unwrap()
    }

    pub(crate) fn csv(&self, view: View) -> String {
        let mut out = Csv::new(Vec::new(), view, timing()).unwrap();
        self.each(|step| out.step(step).unwrap());
        String::from_utf8(out.finish().unwrap()).unwrap()
    }

    pub(crate) fn text(&self, view: View) -> String {
        let mut out = Text::new(Vec::new(), view, timing());
        self.each(|step| out.step(step).unwrap());
        String::from_utf8(out.finish().unwrap()).unwrap()
    }

    pub(crate) fn statistics(&self, view: View, timing: Timing) -> Statistics {
        let mut out = Statistics::new(view, timing, Some(1));
        self.each(|step| out.add(step));
        out
    }
}

pub(crate) fn xyz() -> View {
    View::new(&[Axis::X, Axis::Y, Axis::Z])
}

/// 6000 mm a minute, that is 100 mm a second; 4 s a tool change.
pub(crate) fn timing() -> Timing {
    Timing::new(Some(gcheck_geometry::MmPerMin(6000.0)), Some(Seconds(4.0)))
}
