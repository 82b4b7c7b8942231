//! What a run of a program does, without where in the text.
//!
//! Knows: events of a run. Must not know: what they are compared with.

use gcheck_engine::{
    Concrete, Event, Machine, Model, NoLibrary, Observer, Options, Origin, Program, State, Stopped, run,
};
use gcheck_program::{Dialect, Loaded};

/// Blocks that a run may execute.
const FUEL: u64 = 3_000;
/// Events that are kept.
const MOST: usize = 20_000;

/// What a run did.
pub(super) struct Moves {
    /// In words: numbers that are not known are equal to each other there.
    pub(super) events: Vec<String>,
    pub(super) stopped: Stopped,
}

impl Moves {
    pub(super) fn of(text: &str, dialect: &Dialect<'_>) -> Self {
        let model = Model::new(dialect.control());
        let loaded = Loaded::new(text, dialect, |_, _, _| ());
        let program = Program::new(loaded, dialect, &NoLibrary);
        let mut seen = Seen::default();
        let ran = run(&program, &model, &Machine::default(), Options::NONE, FUEL, &mut seen);
        Self { events: seen.0, stopped: ran.stopped }
    }

    /// Did the run come to an end of the program?
    pub(super) fn ended(&self) -> bool {
        matches!(self.stopped, Stopped::Ended(_))
    }
}

#[derive(Default)]
struct Seen(Vec<String>);

impl Observer<Concrete> for Seen {
    fn event(&mut self, _: Origin, _: &State<Concrete>, event: &Event) {
        // A message is not a move, and a mode that is given twice says nothing more.
        if self.0.len() >= MOST || matches!(event, Event::Message(_) | Event::Modal(_)) {
            return;
        }
        let words = format!("{event:?}");
        if !matches!(event, Event::PathMode(_)) || self.0.last() != Some(&words) {
            self.0.push(words);
        }
    }

    fn stops(&mut self) -> bool {
        self.0.len() >= MOST
    }
}
