//! What a run of a program does, without where in the text.
//!
//! Knows: events of a run. Must not know: what they are compared with.

use std::collections::HashMap;
use std::mem::{Discriminant, discriminant};

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
        Self { events: seen.events, stopped: ran.stopped }
    }

    /// Did the run come to an end of the program?
    pub(super) fn ended(&self) -> bool {
        matches!(self.stopped, Stopped::Ended(_))
    }
}

#[derive(Default)]
struct Seen {
    events: Vec<String>,
    /// The last of each kind that sets something.
    set: HashMap<Discriminant<Event>, String>,
}

impl Observer<Concrete> for Seen {
    fn event(&mut self, _: Origin, _: &State<Concrete>, event: &Event) {
        // A message is not a move.
        if self.events.len() >= MOST || matches!(event, Event::Message(_) | Event::Modal(_)) {
            return;
        }
        let words = format!("{event:?}");
        // What is set twice to one value says nothing more.
        let sets = matches!(
            event,
            Event::PathMode(_) | Event::WorkOffset { .. } | Event::Shift(_) | Event::Rotation(_)
        );
        if sets && self.set.insert(discriminant(event), words.clone()).as_ref() == Some(&words) {
            return;
        }
        self.events.push(words);
    }

    fn stops(&mut self) -> bool {
        self.events.len() >= MOST
    }
}
