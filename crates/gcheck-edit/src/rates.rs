//! Feeds and speeds of a run, of which some are scaled.
//!
//! Knows: which block's `F` and `S` are scaled, and where a block needs one of its own because the number in effect is
//! scaled and the block's is not to be, or the other way round. Must not know: text.
//!
//! A thread keeps its feed, which is its lead. A tap under feed per minute goes with the speed of the spindle.

use std::collections::BTreeMap;

use gcheck_engine::{Concrete, ConcreteValue, Domain as _, FeedMode, Model, Spindle};
use gcheck_toolpath::{Act, Doing, Driven, Feed};

use crate::change::Change;
use crate::facts::Facts;
use crate::meaning::{Class, Meaning, Read, read};
use crate::refusal::Refusal;
use crate::run::Executed;

/// Feed and speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pair<T> {
    pub(crate) feed: T,
    pub(crate) speed: T,
}

/// A rate that a block gets in a word of its own: the number as the program would write it.
pub(crate) type Given = Pair<Option<f64>>;

/// The rates of a run. Has to see every block and act.
pub(crate) struct Rates<'c> {
    change: &'c Change,
    model: &'c Model<'c>,
    /// By how much the numbers in effect are scaled.
    factors: Pair<f64>,
    /// By how much a block's own numbers are scaled, by its number.
    own: BTreeMap<u32, Pair<f64>>,
    /// Blocks that get a number, by their number: the number in effect, and by how much it is scaled there.
    inserted: BTreeMap<u32, (Given, Pair<f64>)>,
    /// The block under way cuts a thread.
    threads: bool,
    /// A tap or a thread of the selection has a feed that stays.
    pub(crate) keeps_threads: bool,
    /// Another file has feeds or speeds of its own, which stay.
    pub(crate) leaves: Option<String>,
}

const SAME: Pair<f64> = Pair { feed: 1.0, speed: 1.0 };

impl<'c> Rates<'c> {
    pub(crate) fn new(change: &'c Change, model: &'c Model<'c>) -> Self {
        Self {
            change,
            model,
            factors: SAME,
            own: BTreeMap::new(),
            inserted: BTreeMap::new(),
            threads: false,
            keeps_threads: false,
            leaves: None,
        }
    }

    pub(crate) fn begin(&mut self) {
        self.factors = SAME;
    }

    /// By how much a block's own numbers are scaled.
    pub(crate) fn own(&self, block: u32) -> Pair<f64> {
        self.own.get(&block).copied().unwrap_or(SAME)
    }

    /// Blocks that get a number of their own: the number as it was, and its factor.
    pub(crate) fn inserted(&self) -> impl Iterator<Item = (u32, &Given, &Pair<f64>)> {
        self.inserted.iter().map(|(block, (given, factors))| (*block, given, factors))
    }

    /// The factors of the moves of a block.
    fn wanted(&self, is_selected: bool, read: &Read, facts: &Facts) -> Pair<f64> {
        match self.change {
            _ if !is_selected => SAME,
            Change::ScaleFeeds(factor) if !read.threads => Pair { feed: *factor, ..SAME },
            Change::ScaleSpeeds(factor) => {
                let follows = read.threads && facts.feed_mode == Some(FeedMode::PerMinute);
                Pair { feed: if follows { *factor } else { 1.0 }, speed: *factor }
            }
            _ => SAME,
        }
    }

    pub(crate) fn executed(&mut self, block: &Executed<'_>) -> Result<(), Refusal> {
        let read = read(block.place, &block.facts, self.model);
        let wanted = self.wanted(block.is_selected, &read, &block.facts);
        self.threads = read.threads && !read.taps;
        self.keeps_threads |=
            block.is_selected && read.threads && matches!(self.change, Change::ScaleFeeds(_));
        let is_limit = matches!(read.class, Class::Origin { .. }) || self.is_limit(block);
        let gives = |sought: Meaning| read.words.iter().any(|(_, meaning)| *meaning == sought);
        let gives = Pair { feed: gives(Meaning::Feed), speed: gives(Meaning::Speed) && !is_limit };
        if block.file.is_some() {
            if gives.feed || gives.speed {
                self.leaves = block.file.map(str::to_owned);
            }
            self.factors.feed = if gives.feed { 1.0 } else { self.factors.feed };
            self.factors.speed = if gives.speed { 1.0 } else { self.factors.speed };
            Ok(())
        } else {
            // `G71 U2. R1.` only tells how the cycle after it cuts.
            let cuts = read.cuts && (read.class != Class::Operation || block.has_cut);
            let numbers = numbers(block);
            // A thread has its lead from its own words, or else the proof fails.
            let feeds = cuts && (!read.threads || read.taps);
            let turns = cuts && block.state.spindle() != Some(Spindle::Stopped);
            let turns = turns && Concrete::known(block.state.speed()) != Some(0.0);
            let mut added = Given { feed: None, speed: None };
            let (factor, needs) = one(self.factors.feed, wanted.feed, gives.feed, feeds);
            self.factors.feed = factor;
            if needs {
                added.feed = Some(known(block, numbers.feed, "feed")?);
            }
            let (factor, needs) = one(self.factors.speed, wanted.speed, gives.speed, turns);
            self.factors.speed = factor;
            if needs {
                added.speed = Some(known(block, numbers.speed, "speed")?);
            }
            self.note(block, gives, added, cuts)
        }
    }

    /// Is `S` of the block a limit, and not a speed?
    fn is_limit(&self, block: &Executed<'_>) -> bool {
        use gcheck_controls::Effect;
        let words = block.place.table.words(block.place.block());
        words.iter().any(|word| {
            matches!(self.model.effect(word.code), Effect::SpeedLimitOrSetPosition | Effect::SetPosition)
        })
    }

    /// Keeps what a block gets; it must be the same each time that it runs.
    fn note(
        &mut self,
        block: &Executed<'_>,
        gives: Pair<bool>,
        added: Given,
        cuts: bool,
    ) -> Result<(), Refusal> {
        let number = block.at.block;
        if gives.feed || gives.speed {
            let factors = Pair {
                feed: if gives.feed { self.factors.feed } else { 1.0 },
                speed: if gives.speed { self.factors.speed } else { 1.0 },
            };
            if self.own.insert(number, factors).is_some_and(|before| before != factors) {
                return Err(block.refusal("this block runs more than once, and its feed or speed is scaled only in some of the turns"));
            }
        }
        let differs = if added.feed.is_some() || added.speed.is_some() {
            let new = (added, self.factors);
            self.inserted.insert(number, new).is_some_and(|before| before != new)
        } else if cuts && let Some((old, _)) = self.inserted.get(&number) {
            let new = numbers(block);
            let other = |old: Option<f64>, new: Option<f64>| old.is_some() && old != new;
            other(old.feed, new.feed) || other(old.speed, new.speed)
        } else {
            false
        };
        if differs {
            let reason = "this block runs more than once, each time with another feed or speed in effect";
            return Err(block.refusal(reason));
        }
        Ok(())
    }

    /// An act with its rates scaled. Acts have the rates that are in effect when they show, which under cutter compensation
    /// are those of the block after theirs.
    pub(crate) fn act(&self, act: Act) -> Act {
        let Doing::Move(made) = &act.doing else { return act };
        let factors = self.factors;
        let is_lead = made.driven == Driven::Thread || self.threads;
        let mut setting = act.setting;
        setting.feed = setting.feed.map(|feed| match feed {
            Feed::PerMinute(feed) if !is_lead => Feed::PerMinute(feed * factors.feed),
            Feed::PerTurn(feed) if !is_lead => Feed::PerTurn(feed * factors.feed),
            feed => feed,
        });
        setting.speed *= factors.speed;
        Act { setting, ..act }
    }
}

/// The number in effect that a block has to repeat, scaled as its moves are.
fn known(block: &Executed<'_>, number: Option<f64>, what: &str) -> Result<f64, Refusal> {
    let reason = || format!("this block needs a {what} of its own, and the {what} in effect is not known");
    number.ok_or_else(|| block.refusal(reason()))
}

/// The factor of the number in effect after a block, and whether the block needs a number of its own.
fn one(current: f64, wanted: f64, gives: bool, cuts: bool) -> (f64, bool) {
    let differs = (current - wanted).abs() > 1e-12;
    if gives {
        (wanted, false)
    } else if cuts && differs {
        (wanted, true)
    } else {
        (current, false)
    }
}

/// The numbers in effect in a block, as the program wrote them.
fn numbers(block: &Executed<'_>) -> Pair<Option<f64>> {
    let known = |value: &ConcreteValue| Concrete::known(value).filter(|number| *number > 0.0);
    Pair { feed: known(block.state.feed_word()), speed: known(block.state.speed()) }
}
