//! What the words of a block are: places, heights, centres, feeds.
//!
//! Knows: which codes give words another meaning. Must not know: how words are rewritten.

use gcheck_controls::{CodeIx, Effect, Letter, WordKind};
use gcheck_engine::{Axis, Model, Role};
use gcheck_geometry::Plane;
use gcheck_program::{Place, Value, Word};

use crate::facts::Facts;

/// What a block does with its words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Class {
    /// Its words of axes are where it moves to.
    Moves,
    /// A code makes several moves from its words.
    Operation,
    /// Its words of axes are places of the machine.
    Machine,
    /// It goes to a reference point of the machine.
    Reference,
    /// It moves the zero that places count from.
    Origin {
        /// By the coordinates that the present point gets, else by a shift of its own.
        by_point: bool,
    },
    /// It switches on a mode that makes other places of words.
    Mapping(Role),
    /// Its words are arguments of a program.
    Call,
    /// Its words are something else: a time, an offset.
    Other,
    /// One of its codes is computed.
    Computed,
}

/// What a word is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// A coordinate of an axis, 0 for X, or a way along it.
    Place {
        axis: usize,
        incremental: bool,
    },
    /// The level that a cycle comes out to, on the axis of its depth.
    Height {
        axis: usize,
        incremental: bool,
    },
    /// Centre of an arc along an axis.
    Centre {
        axis: usize,
        incremental: bool,
    },
    /// A way along an axis that has a direction.
    Vector {
        axis: usize,
    },
    /// A word that a turned path would need to have changed in a way that is not known.
    Direction,
    /// A distance from the zero of the program, or the angle at which it is seen from there.
    Polar,
    Feed,
    Speed,
    Other,
}

/// A block as it was read.
#[derive(Debug, Clone)]
pub(crate) struct Read {
    pub(crate) class: Class,
    pub(crate) words: Vec<(Word, Meaning)>,
    /// The axis along which a cycle drills, 0 for X.
    pub(crate) depth: usize,
    /// It makes a move that is not at rapid.
    pub(crate) cuts: bool,
    /// It cuts a thread, or taps.
    pub(crate) threads: bool,
    /// It taps by a canned cycle, at the feed in effect.
    pub(crate) taps: bool,
}

impl Read {
    /// Do its words say where it goes, or to what angle an axis turns?
    pub(crate) fn has_ways(&self, model: &Model<'_>) -> bool {
        let goes = matches!(self.class, Class::Moves | Class::Operation);
        self.has_places() || goes && self.words.iter().any(|(word, _)| rotary_axis(word, model).is_some())
    }

    /// Do its words say where it goes?
    pub(crate) fn has_places(&self) -> bool {
        self.words.iter().any(|(_, meaning)| {
            matches!(
                meaning,
                Meaning::Place { .. }
                    | Meaning::Height { .. }
                    | Meaning::Centre { .. }
                    | Meaning::Vector { .. }
                    | Meaning::Direction
                    | Meaning::Polar
            )
        })
    }
}

/// The rotary axis that a word turns, on a control that has it.
pub(crate) fn rotary_axis(word: &Word, model: &Model<'_>) -> Option<Axis> {
    let is_there = model.control().axes().contains(word.letter);
    Axis::of(word.letter).filter(|axis| axis.is_rotary() && is_there)
}

/// Reads a block in its modes.
pub(crate) fn read(place: &Place, facts: &Facts, model: &Model<'_>) -> Read {
    let control = model.control();
    let words = place.table.words(place.block());
    let codes: Vec<CodeIx> = words.iter().map(|word| word.code).filter(|code| code.is_some()).collect();
    let is_code = |word: &Word| matches!(word.letter.ascii(), b'G' | b'M') && !word.letter.is_corner();
    let class = if facts.is_row {
        Class::Other
    } else if words.iter().any(|word| is_code(word) && matches!(word.value, Value::Expr(_))) {
        Class::Computed
    } else {
        class(&codes, words, model)
    };
    // On many controls a cycle drills along Z whatever the plane.
    let drilled = if model.semantics().cycles.all_planes { facts.plane } else { None };
    let depth = if model.drills_across(facts.cycle) { 0 } else { drilled.unwrap_or(Plane::Xy).axes().2 };
    let meanings = words.iter().map(|word| {
        if facts.is_row {
            return (*word, Meaning::Other);
        }
        let entry = codes.iter().filter_map(|code| control.code_at(*code)).find_map(|code| {
            code.entry().words.iter().find(|entry| Letter::parse(&entry.letter) == Some(word.letter))
        });
        let kind = entry.map(|entry| entry.kind).or_else(|| Some(control.letter(word.letter)?.kind));
        (*word, meaning(*word, kind, class, depth, facts, model))
    });
    let meanings: Vec<(Word, Meaning)> = meanings.collect();
    let cycle = model.effect(facts.cycle);
    let names_place = |(_, meaning): &(Word, Meaning)| {
        matches!(meaning, Meaning::Place { .. } | Meaning::Centre { .. } | Meaning::Height { .. })
    };
    let moves = meanings.iter().any(names_place);
    let runs_cycle = facts.cycle.is_some() && (moves || codes.contains(&facts.cycle));
    let cuts = match class {
        Class::Operation => true,
        Class::Moves => runs_cycle || moves && facts.motion != Effect::Rapid,
        Class::Machine => {
            moves && facts.motion != Effect::Rapid && !model.semantics().machine_coordinates_rapid
        }
        _ => false,
    };
    let mut here = codes.iter().map(|code| model.effect(*code));
    let cuts_thread = here.any(is_thread) || is_thread(facts.motion) && class == Class::Moves && moves;
    let taps = cycle.is_tapping_cycle() && runs_cycle;
    Read { class, words: meanings, depth, cuts: cuts || cuts_thread, threads: cuts_thread || taps, taps }
}

fn is_thread(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::Thread
            | Effect::RigidTap
            | Effect::ThreadingPass
            | Effect::ThreadCycle
            | Effect::TapHere
            | Effect::LeftTapHere
    )
}

fn class(codes: &[CodeIx], words: &[Word], model: &Model<'_>) -> Class {
    let control = model.control();
    let axes = control.axes();
    let names_axis = words.iter().any(|word| axes.contains(word.letter));
    let mut class = Class::Moves;
    for code in codes.iter().filter_map(|code| control.code_at(*code)) {
        let effect = code.effect();
        class = match effect {
            Effect::MachineCoordinates => Class::Machine,
            Effect::ReturnReference(_) | Effect::ReturnFromReference | Effect::StoreReference(_) => {
                Class::Reference
            }
            Effect::SpeedLimitOrSetPosition if !names_axis => continue,
            Effect::SetPosition
            | Effect::SpeedLimitOrSetPosition
            | Effect::ClearShift
            | Effect::SuspendShift
            | Effect::RestoreShift => Class::Origin { by_point: true },
            Effect::LocalShift => Class::Origin { by_point: false },
            Effect::ScalingOn | Effect::RotationOn | Effect::MirrorOn | Effect::PolarOn => {
                Role::of(effect).map_or(Class::Other, Class::Mapping)
            }
            Effect::CylinderMapping
            | Effect::PolarInterpolationOn
            | Effect::DynamicOffsetOn
            | Effect::TiltedPlaneOn => Role::of(effect).map_or(Class::Other, Class::Mapping),
            Effect::MacroCall | Effect::MacroModal | Effect::CallProgram | Effect::CallLocal => Class::Call,
            Effect::WriteOffsets if names_axis && writes_by_point(words, model) => {
                Class::Origin { by_point: true }
            }
            // A dwell that takes no word of an axis leaves those to the motion.
            Effect::Dwell if !dwells_by_axis(words, model) => continue,
            Effect::Dwell | Effect::WriteOffsets | Effect::UserCommand => Class::Other,
            _ if code.entry().any_words => Class::Call,
            _ => {
                let role = Role::of(effect);
                let is_own = code.entry().takes_axes && !matches!(role, Some(Role::Motion | Role::Cycle));
                if !is_own {
                    continue;
                }
                if code.motion() == gcheck_controls::Motion::None { Class::Other } else { Class::Operation }
            }
        };
        break;
    }
    class
}

/// Is the time of a dwell given by the word of an axis, as lathes do?
fn dwells_by_axis(words: &[Word], model: &Model<'_>) -> bool {
    let mut times = model.semantics().dwell.keys().filter_map(|letter| Letter::parse(letter));
    times.any(|letter| Axis::of(letter).is_some() && words.iter().any(|word| word.letter == letter))
}

/// Does a block that writes offsets give the coordinates that the present point is to have? A strict control has forms for
/// that.
fn writes_by_point(words: &[Word], model: &Model<'_>) -> bool {
    let form = words.iter().find(|word| word.letter == Letter::of('L'));
    model.semantics().strict
        && form.is_some_and(|form| form.number().is_none_or(|form| [10.0, 11.0, 20.0].contains(&form)))
}

/// What a word is; `kind` is that of its value, as its code says or else its address.
fn meaning(
    word: Word,
    kind: Option<WordKind>,
    class: Class,
    depth: usize,
    facts: &Facts,
    model: &Model<'_>,
) -> Meaning {
    if class == Class::Call {
        return Meaning::Other;
    }
    match kind {
        Some(WordKind::Feed) if word.letter == Letter::of('F') => return Meaning::Feed,
        Some(WordKind::Speed) if word.letter == Letter::of('S') => return Meaning::Speed,
        _ => {}
    }
    let is_path = matches!(class, Class::Moves | Class::Operation | Class::Machine | Class::Reference);
    if !is_path {
        return Meaning::Other;
    }
    let incremental = facts.incremental.unwrap_or(false);
    if let Some(meaning) = axis_word(word.letter, incremental, class, model) {
        return meaning;
    }
    if word.letter == Letter::CORNER_A {
        return Meaning::Direction;
    }
    if word.letter.is_corner() || class != Class::Moves {
        return Meaning::Other;
    }
    if word.letter == Letter::AT || word.letter == Letter::CARET {
        return Meaning::Polar;
    }
    let vector = match word.letter.ascii() {
        b'I' => Some(0),
        b'J' => Some(1),
        b'K' => Some(2),
        _ => None,
    };
    let cycle = model.effect(facts.cycle);
    let rules = &model.semantics().cycles;
    match (word.letter.ascii(), vector) {
        (b'R', _) if facts.cycle.is_some() => Meaning::Height {
            axis: depth,
            incremental: incremental && rules.incremental_r || rules.r_is_distance,
        },
        (_, Some(axis)) if facts.is_arc() => Meaning::Centre { axis, incremental: !facts.centre_absolute },
        (_, Some(axis)) if cycle.shifts_boring_bar() => Meaning::Vector { axis },
        (_, Some(_)) if matches!(facts.motion, Effect::SplineCubic | Effect::SplineQuadratic) => {
            Meaning::Direction
        }
        _ => Meaning::Other,
    }
}

/// A word of X, Y or Z, or of their increments.
fn axis_word(letter: Letter, incremental: bool, class: Class, model: &Model<'_>) -> Option<Meaning> {
    let index = |axis: Axis| Some(axis.index()).filter(|index| *index < 3);
    let increments = &model.semantics().increments;
    let own = increments.iter().find(|(name, _)| Letter::parse(name) == Some(letter));
    if let Some((_, axis)) = own {
        // In an operation of several moves such words are stock and the like.
        let axis = Letter::parse(axis).and_then(Axis::of).and_then(index)?;
        return (class != Class::Operation).then_some(Meaning::Place { axis, incremental: true });
    }
    let axis = Axis::of(letter).filter(|_| model.control().axes().contains(letter)).and_then(index)?;
    Some(Meaning::Place { axis, incremental })
}
