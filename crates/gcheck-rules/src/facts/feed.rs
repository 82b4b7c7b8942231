//! The feed: what a number of `F` means, which moves it drives, what gave it.
//!
//! Knows: feed modes and kinds of moves. Must not know: any rule, which feeds are sensible.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Event, Fact, Role, TravelKind};

use crate::PathCx;

/// What a number of `F` `meaning_of_feed`; `None` for codes that choose no meaning of it.
pub(crate) fn meaning_of_feed(mode: Effect) -> Option<&'static str> {
    match mode {
        Effect::FeedInverseTime => Some("moves per minute"),
        Effect::FeedPerMinute => Some("a length per minute"),
        Effect::FeedPerRevolution => Some("a length per turn"),
        _ => None,
    }
}

/// Does the feed in effect drive the move? A thread has its lead, a tap its pitch.
pub(crate) fn goes_by_feed(event: &Event) -> bool {
    match event {
        Event::Travel(travel) => travel.kind == TravelKind::Feed,
        Event::Arc(_) | Event::Curve(_) => true,
        _ => false,
    }
}

/// The block whose `F` word gave a feed of zero, if that is why there is none.
pub(crate) fn zero_feed_given(cx: &PathCx<'_>) -> Option<At> {
    let at = cx.definitions().set_by(Fact::Feed)?;
    let place = cx.place_of(at)?;
    place.block().letters.contains(Letter::of('F')).then_some(at)
}

/// Is probing the motion mode?
pub(crate) fn is_probing_motion(cx: &PathCx<'_>) -> bool {
    cx.state().effect(Role::Motion, cx.model).is_some_and(Effect::is_probing_move)
}
