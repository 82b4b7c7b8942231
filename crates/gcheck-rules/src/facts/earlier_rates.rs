//! Feeds and speeds that a program gave to the same tool before a block that has none.
//!
//! Knows: the text in front of a block, which number of `F` and `S` means the same there. Must not know: any rule, which rates
//! are sensible for a material.

use std::ops::Range;

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{At, Role};
use gcheck_program::{Place, Value, Word};

use crate::{Fix, PathCx};

/// Blocks in front of a block that are read: a program may have as many findings as blocks.
const MOST_BLOCKS: u32 = 250;

/// A feed or a speed as it is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Rate {
    /// The word: `F120.`.
    word: String,
    /// Where it is.
    range: Range<u32>,
    /// The program changes tools.
    by_tool: bool,
}

/// What must be the same for a number to mean the same.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Setting {
    tool: Option<u32>,
    units: Option<Effect>,
    mode: Option<Effect>,
}

/// The fix that writes the last feed or speed of this tool at the end of a block, or in the place of the one that is there;
/// `None` where the program gives the tool none before the block of the finding.
pub(crate) fn last_rate_of_tool(cx: &PathCx<'_>, letter: Letter, at: At) -> Option<Fix> {
    if at.file != 0 {
        return None;
    }
    let here = cx.origin().at;
    let rate = cx.from_text(here, u32::from(letter.ascii()), || rate_before(cx, letter))?;
    let place = cx.place_of(at)?;
    let words = place.table.words(place.block());
    let bytes = |word: &Word| place.base + word.range().start..place.base + word.range().end;
    let own = words.iter().find(|word| word.letter == letter).map(bytes);
    let last = words.iter().map(bytes).max_by_key(|range| range.end)?;
    // As the block has its words: with a blank between them, or without.
    let is_close = |pair: &[Word]| matches!(pair, [a, b] if a.range().end == b.range().start);
    let gap = if words.windows(2).any(is_close) { "" } else { " " };
    let Rate { word, range, by_tool } = rate;
    let line = cx.program.file(0)?.loaded.line_number(range.start);
    let what = if letter == Letter::of('S') { "speed" } else { "feed" };
    let of =
        if by_tool { format!("the last {what} of this tool") } else { format!("the last {what} before") };
    let title = format!("write `{word}`, {of} (line {line})");
    Some(match own {
        Some(own) => Fix::risky(title, own, word),
        None => Fix::risky(title, last.end..last.end, format!("{gap}{word}")),
    })
}

/// The last rate in front of the block that is executed, which means the same there.
fn rate_before(cx: &PathCx<'_>, letter: Letter) -> Option<Rate> {
    let here = cx.origin().at;
    let file = cx.program.file(0).filter(|_| here.file == 0)?;
    let start =
        file.loaded.flow_graph().part_of(here.block).start.max(here.block.saturating_sub(MOST_BLOCKS));
    let mut reading = Reading::new(cx, letter);
    for number in start..here.block {
        let Some(place) = file.loaded.place(number, cx.program.dialect()) else { continue };
        reading.block(&place, Some(&|range: Range<u32>| file.loaded.slice(range).to_owned()));
    }
    reading.block(&file.loaded.place(here.block, cx.program.dialect())?, None);
    let setting = reading.setting;
    let found = reading.found.into_iter().rev().find(|(of, _)| *of == setting);
    let by_tool = reading.changes_tools;
    found.and_then(|(_, rate)| rate).map(|rate| Rate { by_tool, ..rate })
}

/// The text in front of a block, as it is read.
struct Reading<'a> {
    cx: &'a PathCx<'a>,
    letter: Letter,
    setting: Setting,
    /// The tool that the next change brings.
    next_tool: Option<u32>,
    changes_tools: bool,
    motion: Option<Effect>,
    /// By what it was given under; `None` for a rate that is computed.
    found: Vec<(Setting, Option<Rate>)>,
}

impl<'a> Reading<'a> {
    fn new(cx: &'a PathCx<'a>, letter: Letter) -> Self {
        Self {
            cx,
            letter,
            setting: Setting::default(),
            next_tool: None,
            changes_tools: false,
            motion: None,
            found: Vec::new(),
        }
    }

    /// Reads a block; `text` gives the text of its words, and is `None` for the block that needs a rate.
    fn block(&mut self, place: &Place, text: Option<&dyn Fn(Range<u32>) -> String>) {
        let model = self.cx.model;
        // What block delete may skip is not what the tool last cut with for sure.
        if text.is_some() && place.block().delete > 0 {
            return;
        }
        let words = place.table.words(place.block());
        let codes = || words.iter().map(|word| word.code).filter(|code| code.is_some());
        if codes().any(|code| self.cx.code_of(code).is_some_and(|code| code.entry().any_words)) {
            return;
        }
        let tool = words.iter().find(|word| word.letter == Letter::of('T'));
        if let Some(tool) = tool {
            self.next_tool = tool.integer();
        }
        let tools = &model.semantics().tools;
        if tool.is_some() && tools.change_by_t || codes().any(|code| model.effect(code) == Effect::ToolChange)
        {
            self.setting.tool = self.next_tool;
            self.changes_tools = true;
        }
        for code in codes() {
            let effect = model.effect(code);
            match model.role(code) {
                Some(Role::Units) => self.setting.units = Some(effect),
                Some(Role::FeedMode) if self.letter == Letter::of('F') => self.setting.mode = Some(effect),
                Some(Role::SpindleMode) if self.letter == Letter::of('S') => self.setting.mode = Some(effect),
                Some(Role::Motion | Role::Cycle) => self.motion = Some(effect),
                _ => {}
            }
        }
        let Some((text, word)) = text.zip(words.iter().find(|word| word.letter == self.letter)) else {
            return;
        };
        let is_other = codes().any(|code| takes_otherwise(model.effect(code), self.letter));
        if is_other || self.motion.is_some_and(|motion| takes_otherwise(motion, self.letter)) {
            return;
        }
        let range = place.base + word.range().start..place.base + word.range().end;
        let rate = match word.value {
            Value::Number(number) if number > 0.0 => {
                Some(Rate { word: text(range.clone()), range, by_tool: false })
            }
            Value::Number(_) | Value::Missing => return,
            Value::Expr(_) => None,
        };
        self.found.retain(|(setting, _)| *setting != self.setting);
        self.found.push((self.setting, rate));
    }
}

/// Does a code take the word as something else than the feed of a cut, or the speed of the spindle?
fn takes_otherwise(effect: Effect, letter: Letter) -> bool {
    if letter == Letter::of('S') {
        return effect == Effect::SpeedLimitOrSetPosition;
    }
    effect.is_probing_move()
        || matches!(
            effect,
            Effect::Dwell
                | Effect::Thread
                | Effect::RigidTap
                | Effect::ThreadingPass
                | Effect::ThreadCycle
                | Effect::TapHere
                | Effect::LeftTapHere
                | Effect::CycleTap
                | Effect::CycleLeftTap
        )
}
