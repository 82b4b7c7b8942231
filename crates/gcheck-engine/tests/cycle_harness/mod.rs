//! Runs a program and shows what the machine does, one event a line, lengths in millimetres (X as a radius).

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write;

use gcheck_engine::{
    Axis, Concrete, Event, Fault, Machine, Model, NoLibrary, Observer, Options, Origin, Position, Program,
    State, Tool, TravelKind, run,
};
use gcheck_geometry::Mm;
use gcheck_program::{Dialect, Loaded};

struct Recorder {
    text: String,
    plane_axes: &'static str,
}

/// At most four decimals; `?` unknown.
fn number(value: f64) -> String {
    if value.is_nan() {
        return "?".to_owned();
    }
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

impl Recorder {
    fn point(&self, position: &Position) -> String {
        let axes = Axis::ALL.into_iter().filter(|axis| self.plane_axes.contains(axis.name()));
        axes.map(|axis| format!(" {}{}", axis.name().to_ascii_lowercase(), number(position.raw(axis))))
            .collect()
    }
}

impl Observer<Concrete> for Recorder {
    fn event(&mut self, _: Origin, _: &State<Concrete>, event: &Event) {
        let line = match event {
            Event::Travel(travel) => {
                let name = match travel.kind {
                    TravelKind::Rapid => "rapid",
                    TravelKind::Feed => "feed",
                    TravelKind::Thread => "thread",
                    TravelKind::Probe { .. } => "probe",
                };
                format!("{name}{}", self.point(&travel.to))
            }
            Event::Arc(arc) => {
                let way = if arc.turns > 0 { "ccw" } else { "cw" };
                let (Mm(first), Mm(second)) = arc.centre;
                format!("{way}{} about {} {}", self.point(&arc.to), number(first), number(second))
            }
            Event::SpindleSync { lead: Some(lead), .. } => format!("sync {:.6}", lead.0),
            Event::SpindleSync { lead: None, .. } => "sync off".to_owned(),
            Event::Override { on, .. } => format!("override {}", if *on { "on" } else { "off" }),
            Event::Dwell(seconds) => format!("dwell {}", number(seconds.0)),
            _ => return,
        };
        writeln!(self.text, "{line}").unwrap();
    }

    fn fault(&mut self, origin: Origin, _: &State<Concrete>, fault: &Fault) {
        let n = origin.n.map(|n| format!(" in N{n}")).unwrap_or_default();
        writeln!(self.text, "{fault:?}{n}").unwrap();
    }
}

/// A tool of this diameter under number 1; everything else is fresh.
pub(crate) fn machine(diameter: f64) -> Machine {
    let tool = Tool {
        pocket: 1,
        offset: Position::ZERO,
        diameter: Mm(diameter),
        corner_radius: Mm(0.0),
        angles: [0.0; 2],
        orientation: 0,
    };
    Machine { fresh: true, start: Some(Position::ZERO), tools: [(1, tool)].into(), ..Machine::default() }
}

/// What a program does on a control. `axes` are those shown.
pub(crate) fn shown_on(control: &str, axes: &'static str, machine: &Machine, text: &str) -> String {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let model = Model::new(&control);
    let mut recorder = Recorder { text: String::new(), plane_axes: axes };
    let result = run(&program, &model, machine, Options::NONE, 100_000, &mut recorder);
    write!(recorder.text, "at{}", recorder.point(result.state.position())).unwrap();
    recorder.text
}
