//! What holds the part of a lathe: which codes open the chuck, and how sure that is.
//!
//! Knows: effects for the main chuck, modal groups of the devices around the part, words of comments that name other devices. Must not
//! know: any rule, where the part is.

use gcheck_controls::{Code, Confidence, Control, Effect};
use gcheck_engine::{At, Event};
use gcheck_program::Word;

use crate::PathCx;
use crate::facts::tool_comment::comments_in;
use crate::facts::work_offset::writes_zero_at;

/// Does the code open the main chuck?
pub(crate) fn opens(effect: Effect) -> bool {
    effect == Effect::ChuckUnclamp
}

/// What a block does to a device that a modal group of two codes moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Moved {
    /// The code that another one ends: out, up, on.
    Out,
    /// The code that ends it.
    Back,
}

impl Moved {
    /// By a code of such a group.
    pub(crate) fn by(code: Code<'_>) -> Self {
        if code.entry().cancelled_by.is_empty() { Self::Back } else { Self::Out }
    }
}

/// What the block does to the device of the modal group.
pub(crate) fn moved(cx: &PathCx<'_>, group: &str) -> Option<Moved> {
    let codes = cx.codes();
    let own = codes.iter().rev().filter_map(|ix| cx.code_of(*ix)).find(|code| code.entry().group == group)?;
    Some(Moved::by(own))
}

/// The control's code that moves the device of the modal group so.
pub(crate) fn code_that<'c>(control: &'c Control, group: &str, moved: Moved) -> Option<Code<'c>> {
    control.codes().find(|code| code.entry().group == group && Moved::by(*code) == moved)
}

/// The spindle may be at rest although the program has not stopped it: it is oriented, or the operator may have stopped it.
#[derive(Debug, Default, Clone, PartialEq)]
pub(crate) struct MayRest(bool);

impl MayRest {
    /// Takes note of an event.
    pub(crate) fn see(&mut self, event: &Event) {
        match event {
            Event::OrientSpindle { .. } | Event::Stop(_) => self.0 = true,
            Event::Spindle(_) => self.0 = false,
            _ => {}
        }
    }

    /// May it be at rest?
    pub(crate) fn is_so(&self) -> bool {
        self.0
    }
}

/// Does the machine builder decide what the code does?
pub(crate) fn is_builders(code: Code<'_>) -> bool {
    code.entry().group == "m-user" || code.entry().confidence == Confidence::Assumed
}

/// Does the block bring another part into the work, by what is not a code for the chuck: the parts catcher takes one away, or the main
/// program begins again?
pub(crate) fn changes_part(cx: &PathCx<'_>) -> bool {
    const CATCHER: &str = "parts-catcher";
    let begins_again = cx.depth() == 1 && cx.has_effect(|effect| effect == Effect::Return);
    begins_again || moved(cx, CATCHER) == Some(Moved::Back) || changes_part_at(cx, cx.origin().at)
}

/// Does a block work with the bar or the chuck by a code of the machine builder, as its comment tells, or write the zero of the part?
pub(crate) fn changes_part_at(cx: &PathCx<'_>, at: At) -> bool {
    const BAR: [&str; 22] = [
        "BAR",
        "BARFEED",
        "BARPULLER",
        "CATCH",
        "CATCHER",
        "CHUCK",
        "CLAMP",
        "COLLET",
        "EJECT",
        "EJECTOR",
        "FEEDER",
        "FLIP",
        "GRIPPER",
        "LOAD",
        "PULL",
        "PULLER",
        "ROBOT",
        "STOCK",
        "STOPPER",
        "UNCLAMP",
        "UNLOAD",
        "VISE",
    ];
    let Some(place) = cx.place_of(at) else { return false };
    let words = place.table.words(place.block());
    let names_bar = || {
        comments_in(cx, at).is_some_and(|comment| {
            let comment = comment.to_ascii_uppercase();
            comment.split(|c: char| !c.is_ascii_alphanumeric()).any(|word| BAR.contains(&word))
        })
    };
    let writes = |word: &Word| cx.model.effect(word.code) == Effect::WriteOffsets;
    words.iter().any(|word| is_builders_m(cx, word)) && names_bar()
        || words.iter().any(writes)
        || writes_zero_at(cx, at)
}

/// An M code whose meaning is the machine builder's or the shop's: it switches nothing that the control knows.
fn is_builders_m(cx: &PathCx<'_>, word: &Word) -> bool {
    let is_m = word.letter.ascii() == b'M';
    let switches = |code: Code<'_>| code.effect() != Effect::None && !code.is_user() && !is_builders(code);
    is_m && !cx.code_of(word.code).is_some_and(switches)
}

/// Does a comment of the block say that its code moves something else than the chuck?
pub(crate) fn names_something_else(cx: &PathCx<'_>, at: At) -> bool {
    const OTHERS: [&str; 18] = [
        "CATCHER",
        "CATCH",
        "TRAY",
        "CONVEYOR",
        "TAILSTOCK",
        "QUILL",
        "CENTER",
        "CENTRE",
        "STEADY",
        "REST",
        "BRAKE",
        "AXIS",
        "DOOR",
        "AIR",
        "PROBE",
        "ARM",
        "SETTER",
        "TURRET",
    ];
    comments_in(cx, at).is_some_and(|comment| {
        let comment = comment.to_ascii_uppercase();
        comment.split(|c: char| !c.is_ascii_alphanumeric()).any(|word| OTHERS.contains(&word))
    })
}
