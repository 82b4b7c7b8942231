//! A mode that one tool's work switched on, and that is still on where the next tool cuts or the program ends.
//!
//! Knows: where the first tool comes, where a mode was set, what the file can switch. Must not know: any rule; each rule gives
//! its mode and the words for it.

use std::ops::Range;

use crate::{Finding, RuleMeta};
use crate::{PathCx, PathRule, Remembers, Report, Uses, remembers};
use gcheck_controls::Effect;
use gcheck_engine::{At, Ending, Event, Fact, Role, Units};
use gcheck_program::Word;

use crate::facts::boundary::{Boundary, boundary, ends_at_tape_mark, is_before, with_tool_change};
use crate::facts::modes::left_at_end;

/// A mode of coordinates that may be left on.
pub(crate) struct Mode {
    pub(crate) rule: &'static RuleMeta,
    pub(crate) role: Role,
    pub(crate) on: Effect,
    pub(crate) off: Effect,
    /// What the next tool cuts with: "the scaling".
    pub(crate) of_tool: &'static str,
    /// What is still on at the end: "scaling".
    pub(crate) at_end: &'static str,
    /// What is to be switched off: "scaling".
    pub(crate) switched: &'static str,
    /// Programs choose the mode at their head for all their work, and leave it on.
    pub(crate) is_usual_from_head: bool,
}

/// Looks whether a mode is left on: by tools for the next one, or by the program at its end.
///
/// A mode from the head of the program is meant for all tools, and one that the file switches off somewhere may last
/// until there. A mode that begins in the middle of one tool's work and never ends is meant for that tool.
pub(crate) struct ModeLeftOn {
    mode: &'static Mode,
    carried: Carried,
}

#[derive(Debug, Clone, Default, PartialEq)]
struct Carried {
    /// Where the first tool comes.
    first_tool: Option<At>,
    /// The block that switched the mode on with which a tool change was made.
    over: Option<At>,
    /// The last block of the main program itself that switches the mode.
    own: Option<At>,
    /// The first cut of the main program with a mode that a subprogram has left on, and the block that switched it on.
    after_call: Option<(At, Range<u32>)>,
    /// The first cut.
    first_cut: Option<At>,
    /// The block that switched on the mode with which something was cut last.
    cut_with: Option<At>,
    /// The last block of the main program itself that switched the mode off.
    switched_off: Option<At>,
    /// The units of that block.
    units: Option<Units>,
    /// A cut was reported: later cuts and the end of the program are not.
    is_reported: bool,
}

remembers!(Carried: first_tool, over, own, after_call, first_cut, cut_with, switched_off);

impl ModeLeftOn {
    pub(crate) fn new(mode: &'static Mode) -> Self {
        Self { mode, carried: Carried::default() }
    }

    /// The tool cuts with the mode of the tool before.
    fn at_cut(&self, cx: &PathCx<'_>) -> Option<Finding> {
        let Mode { rule, role, on, off, of_tool, .. } = *self.mode;
        let first_tool = self.carried.first_tool.filter(|_| !self.carried.is_reported)?;
        let code = cx.state().mode(role).only()?;
        if !code.is_some() || cx.model.effect(code) != on {
            return None;
        }
        let (set, changed) =
            (cx.definitions().set_by(Fact::Mode(role))?, cx.definitions().set_by(Fact::Tool)?);
        let is_carried = is_before(set, changed) || self.carried.over == Some(set);
        let is_later = is_before(first_tool, set) || first_tool.file != set.file;
        if !is_later || !is_carried || cx.file_uses(|effect| effect == off) {
            return None;
        }
        // A control that has nothing else leaves it on by its nature.
        let (name, cancel) = (cx.name_of(code), cx.name_of_effect(off)?);
        let finding = cx
            .finding(rule, cx.range(), format!("the tool cuts with {of_tool} of the tool before (`{name}`)"))
            .label("nothing in the file switches it off")
            .help(format!("switch it off with `{cancel}` where the work of the tool before ends"));
        let finding = with_tool_change(cx, finding);
        Some(cx.resting_on(finding, Fact::Mode(role), &format!("`{name}`")))
    }

    /// Was the mode switched on for the whole program: before anything was cut, or where nothing is cut any more?
    fn is_usual(&self, cx: &PathCx<'_>) -> bool {
        let set = cx.definitions().set_by(Fact::Mode(self.mode.role));
        match (set, self.carried.first_cut) {
            (Some(at), Some(cut)) => is_before(at, cut) || self.carried.cut_with != set,
            _ => true,
        }
    }

    /// What switches the mode off, with the words with which the program did so before: `G64 P0.05`, and not the `G64` of a
    /// path that nobody bounds. Words of other units, and computed ones, say something else here.
    fn as_before(&self, cx: &PathCx<'_>, name: String) -> String {
        let words = || {
            let at = self.carried.switched_off?;
            if self.mode.off != Effect::PathBlending || cx.state().units(cx.model) != self.carried.units {
                return None;
            }
            let (file, place) = (cx.program.file(at.file)?, cx.place_of(at)?);
            let words = place.table.words(place.block());
            let is_off = |word: &&Word| word.code.is_some() && cx.model.effect(word.code) == self.mode.off;
            let code = words.iter().find(is_off)?.code;
            let reads = cx.code_of(code)?.reads();
            let mut text = cx.name_of(code);
            for word in words.iter().filter(|word| reads.contains(word.letter)) {
                word.number()?;
                text.push(' ');
                text.push_str(
                    file.loaded.slice(place.base + word.range().start..place.base + word.range().end),
                );
            }
            Some(text)
        };
        words().unwrap_or(name)
    }

    fn check_end(&self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Mode { rule, role, on, off, at_end, switched, .. } = *self.mode;
        if self.carried.is_reported {
            return;
        }
        if self.mode.is_usual_from_head && self.is_usual(cx) {
            return;
        }
        let Some(cancel) = cx.name_of_effect(off).map(|name| self.as_before(cx, name)) else { return };
        let Some(finding) = left_at_end(cx, rule, role, |effect| effect == on, at_end) else { return };
        let set = cx.definitions().set_by(Fact::Mode(role));
        let after_call = self.carried.after_call.clone().filter(|(at, _)| Some(*at) == set);
        let finding = match after_call {
            Some((_, range)) => finding.also(range, "the first cut with it after the subprogram"),
            None => finding,
        };
        report.add(
            finding
                .assuming("the end of the program keeps it, as the control's book leaves to a parameter")
                .help(format!("switch {switched} off with `{cancel}` before the program ends"))
                .fix_if(cx.block_before(Some(&cancel))),
        );
    }
}

impl PathRule for ModeLeftOn {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(&mut self.carried)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == self.mode.on)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let role = self.mode.role;
        if let Some(code) = cx.code_of_role(role) {
            if cx.depth() == 1 {
                self.carried.own = Some(cx.origin().at);
            }
            if cx.depth() == 1 && cx.model.effect(code) == self.mode.off {
                self.carried.switched_off = Some(cx.origin().at);
                self.carried.units = cx.state().units(cx.model);
            }
        }
        if boundary(cx) == Some(Boundary::ToolChange) {
            if self.carried.first_tool.is_none() {
                self.carried.first_tool = Some(cx.origin().at);
            } else if cx.state().effect(role, cx.model) == Some(self.mode.on) {
                self.carried.over = cx.definitions().set_by(Fact::Mode(role));
            }
        }
        if boundary(cx) == Some(Boundary::ProgramEnd) {
            self.check_end(cx, report);
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        let role = self.mode.role;
        self.carried.first_cut.get_or_insert(cx.origin().at);
        let set = cx.definitions().set_by(Fact::Mode(role));
        let is_first = self.carried.after_call.as_ref().is_none_or(|(at, _)| Some(*at) != set);
        let is_on = cx.state().effect(role, cx.model) == Some(self.mode.on);
        if is_on {
            self.carried.cut_with = set;
        }
        if is_on && is_first && cx.depth() == 1 && set != self.carried.own {
            self.carried.after_call = set.map(|at| (at, cx.range()));
        }
        if let Some(finding) = self.at_cut(cx) {
            self.carried.is_reported = true;
            report.add(finding);
        }
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ends_at_tape_mark(cx, ending) {
            self.check_end(cx, report);
        }
    }
}
