//! Canned cycles and other operations of one block, as the strokes they are made of.
//!
//! Knows: geometry of cycles on known numbers. Must not know: words, modal state, where a block stands.
//!
//! Every function here ends: a block gives at most [`MAX_STROKES`] strokes, then [`CycleError::TooManyStrokes`].
//! Strokes are handed out as they are found, so those before an error stay handed out, as they would on a machine.

mod cycle_error;
mod drilling;
mod layered;
mod patterns;
mod pockets;
mod profile;
mod roughing;
mod turning;

use gcheck_geometry::{Mm, Seconds};

use crate::event::Units;

pub use cycle_error::{CycleError, ProfileFault};
pub use drilling::{Hole, Overrides, hole};
pub use layered::{LayeredFinish, LayeredRoughing, Pockets, layered_finish, layered_roughing};
pub use patterns::{bolt_arc, bolt_circle, bolt_line};
pub use pockets::{CircularPocket, GeneralPocket, PocketPlan, circular_pocket, general_pocket};
pub use profile::ProfileSegment;
pub use roughing::{PatternRepeat, Roughing, RoughingDirection, finish_profile, pattern_repeat, roughing};
pub use turning::{
    Grooving, InFeed, TaperEnds, TaperedThread, ThreadHeights, box_pass, grooving, multi_pass_thread,
    tapered_thread,
};

/// Most strokes that one block may give. A peck of a micrometre in a hole of a hundred millimetres would give as many.
pub const MAX_STROKES: u32 = 100_000;

/// One element of a cycle, in the active work coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stroke {
    /// Rapid to a point.
    Rapid([Mm; 3]),
    /// Feed to a point.
    Feed([Mm; 3]),
    /// Arc at feed in the active plane: end, centre in the plane's axes, turns as in [`crate::ArcMove`].
    Arc {
        /// End.
        to: [Mm; 3],
        /// Centre in the plane's first and second axis.
        centre: (Mm, Mm),
        /// 1 counter-clockwise, −1 clockwise, more for full turns before.
        turns: i32,
    },
    /// Feed tied to the spindle, millimetres a turn.
    Thread {
        /// End.
        to: [Mm; 3],
        /// Millimetres a turn.
        lead: Mm,
    },
    /// Standing still.
    Dwell(Seconds),
    /// The spindle stops.
    SpindleStop,
    /// The spindle turns again as before the cycle.
    SpindleRestart,
    /// The spindle turns the other way than before the cycle.
    SpindleReverse,
    /// The spindle turns as the cycle demands, whatever it did before.
    SpindleTurn {
        /// Clockwise (`M3`), else counter-clockwise.
        clockwise: bool,
    },
    /// Spindle and feed go so many times as fast as the program has them; 1 brings them back.
    Pace(f64),
    /// The spindle is oriented.
    Orient,
    /// From here on every point is passed exactly, until the block ends. Only for controls that change the path mode.
    ExactPath,
    /// Feeds from here on are tied to the spindle, millimetres a turn; `None` ends it.
    Sync(Option<Mm>),
    /// Overrides of the feed are allowed from here on, or not.
    FeedOverride(bool),
    /// Overrides of the spindle speed are allowed from here on, or not.
    SpeedOverride(bool),
    /// The program waits for the operator, who may move the axes by hand.
    OperatorStop,
}

impl Stroke {
    /// The point that a move ends at; `None` for what moves no axis.
    pub const fn end(&self) -> Option<[Mm; 3]> {
        match self {
            Self::Rapid(to) | Self::Feed(to) | Self::Arc { to, .. } | Self::Thread { to, .. } => Some(*to),
            _ => None,
        }
    }
}

/// Where strokes go: counts them and keeps the last point.
struct Sink<'a> {
    out: &'a mut dyn FnMut(Stroke),
    left: u32,
    at: [Mm; 3],
}

impl<'a> Sink<'a> {
    fn new(from: [Mm; 3], out: &'a mut dyn FnMut(Stroke)) -> Self {
        Self { out, left: MAX_STROKES, at: from }
    }

    fn put(&mut self, stroke: Stroke) -> Result<(), CycleError> {
        self.left = self.left.checked_sub(1).ok_or(CycleError::TooManyStrokes)?;
        if let Some(end) = stroke.end() {
            self.at = end;
        }
        (self.out)(stroke);
        Ok(())
    }

    fn rapid(&mut self, to: [Mm; 3]) -> Result<(), CycleError> {
        self.put(Stroke::Rapid(to))
    }

    fn feed(&mut self, to: [Mm; 3]) -> Result<(), CycleError> {
        self.put(Stroke::Feed(to))
    }

    /// Rapid, unless the point is where the tool stands. An axis that nobody knows, before and after, stays where it is.
    fn rapid_if_elsewhere(&mut self, to: [Mm; 3]) -> Result<(), CycleError> {
        let stays = |(at, to): (&Mm, &Mm)| at == to || at.0.is_nan() && to.0.is_nan();
        if self.at.iter().zip(&to).all(stays) { Ok(()) } else { self.rapid(to) }
    }
}

/// Refuses numbers that are unknown or infinite.
fn known(numbers: &[Mm]) -> Result<(), CycleError> {
    if numbers.iter().all(|number| number.is_finite()) { Ok(()) } else { Err(CycleError::Unknown) }
}

/// A length in the program's units, as the program wrote it.
///
/// How many pecks or passes a cycle makes hangs on the last bit of sums of its words, so those sums are done in the
/// program's units. A length that came from inches is rounded to nine decimals, which undoes the way through millimetres.
fn in_program_units(length: Mm, units: Units) -> f64 {
    match units {
        Units::Mm => length.0,
        Units::Inch => (length.inch() * 1e9).round() / 1e9,
    }
}

/// The way back: millimetres of a length in the program's units.
fn from_program_units(length: f64, units: Units) -> Mm {
    Mm(length * units.in_mm())
}

#[cfg(test)]
mod test_support {
    use std::fmt::Write;

    use gcheck_geometry::{Mm, Seconds};

    use super::{CycleError, Stroke};

    /// Strokes as lines of text; the numbers are millimetres.
    pub(super) fn shown(run: impl FnOnce(&mut dyn FnMut(Stroke)) -> Result<(), CycleError>) -> String {
        let mut text = String::new();
        let outcome = run(&mut |stroke| writeln!(text, "{}", line(stroke)).unwrap());
        if let Err(error) = outcome {
            writeln!(text, "{error:?}").unwrap();
        }
        text
    }

    /// Strokes as lines of text in the plane of a lathe: `Z X`.
    pub(super) fn shown_zx(run: impl FnOnce(&mut dyn FnMut(Stroke)) -> Result<(), CycleError>) -> String {
        let mut text = String::new();
        let outcome = run(&mut |stroke| {
            let [x, _, z] = stroke.end().unwrap_or_default();
            let name = line(stroke);
            let name = name.split_once(' ').map_or(name.as_str(), |(name, _)| name);
            match stroke {
                Stroke::Arc { centre: (cz, cx), turns, .. } => {
                    writeln!(text, "arc z{} x{} about z{} x{} turns {turns}", n(z), n(x), n(cz), n(cx))
                        .unwrap();
                }
                Stroke::Thread { lead, .. } => {
                    writeln!(text, "thread z{} x{} lead {}", n(z), n(x), n(lead)).unwrap();
                }
                Stroke::Rapid(_) | Stroke::Feed(_) => writeln!(text, "{name} z{} x{}", n(z), n(x)).unwrap(),
                _ => writeln!(text, "{}", line(stroke)).unwrap(),
            }
        });
        if let Err(error) = outcome {
            writeln!(text, "{error:?}").unwrap();
        }
        text
    }

    fn line(stroke: Stroke) -> String {
        match stroke {
            Stroke::Rapid(to) => format!("rapid {}", point(to)),
            Stroke::Feed(to) => format!("feed {}", point(to)),
            Stroke::Arc { to, centre, turns } => {
                format!("arc {} about {} {} turns {turns}", point(to), n(centre.0), n(centre.1))
            }
            Stroke::Thread { to, lead } => format!("thread {} lead {}", point(to), n(lead)),
            Stroke::Dwell(Seconds(time)) => format!("dwell {time}"),
            Stroke::SpindleStop => "spindle stops".to_owned(),
            Stroke::SpindleRestart => "spindle as before".to_owned(),
            Stroke::SpindleReverse => "spindle reversed".to_owned(),
            Stroke::SpindleTurn { clockwise: true } => "spindle clockwise".to_owned(),
            Stroke::SpindleTurn { clockwise: false } => "spindle counter-clockwise".to_owned(),
            Stroke::Pace(times) => format!("pace {times}"),
            Stroke::Orient => "orient".to_owned(),
            Stroke::ExactPath => "exact path".to_owned(),
            Stroke::Sync(Some(lead)) => format!("sync {:.6}", lead.0),
            Stroke::Sync(None) => "sync off".to_owned(),
            Stroke::FeedOverride(on) => format!("feed override {on}"),
            Stroke::SpeedOverride(on) => format!("speed override {on}"),
            Stroke::OperatorStop => "operator stop".to_owned(),
        }
    }

    fn point([x, y, z]: [Mm; 3]) -> String {
        format!("{} {} {}", n(x), n(y), n(z))
    }

    /// Four decimals, without zeros at the end.
    fn n(Mm(value): Mm) -> String {
        let text = format!("{value:.4}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        if text == "-0" { "0".to_owned() } else { text.to_owned() }
    }
}
