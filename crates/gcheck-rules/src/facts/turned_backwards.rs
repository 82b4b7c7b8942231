//! Tools that cut clockwise and turn counter-clockwise.
//!
//! Knows: which tool turns so, where the spindle was started, how that is told. Must not know: any rule, which tools cut
//! clockwise.

use gcheck_controls::{Effect, Machine};
use gcheck_engine::{Abstract, At, Domain, Fact, Spindle};

use crate::facts::cutting::turns_backwards;
use crate::facts::offset_schemes::whole;
use crate::facts::tool_comment::{ToolComment, comment_of_tool};
use crate::{Finding, PathCx, RuleMeta, Uses, remembers};

/// The tool that was judged last: each is judged once.
#[derive(Default, Clone, PartialEq)]
pub(crate) struct TurnedBackwards {
    /// The block that put it in.
    changed: Option<At>,
    tool: Option<u32>,
}

remembers!(TurnedBackwards: changed);

/// How a kind of tool is called.
pub(crate) struct Called {
    /// `drill`.
    pub(crate) tool: &'static str,
    /// In short, where it may be named left-hand.
    pub(crate) in_short: &'static str,
    /// What it does where it cuts: `drills`.
    pub(crate) cuts: &'static str,
    /// What its comment names: `a drill`.
    pub(crate) named: &'static str,
}

/// May a tool turn so at all?
pub(crate) fn may_turn_backwards(program: &Uses<'_>) -> bool {
    program.may(turns_backwards) && program.environment.control().machine() == Machine::Mill
}

impl TurnedBackwards {
    /// The tool that cuts here turns counter-clockwise, and its comment is of this kind.
    pub(crate) fn judge(
        &mut self,
        cx: &PathCx<'_>,
        meta: &'static RuleMeta,
        called: &Called,
        is_of_kind: impl Fn(&ToolComment) -> bool,
    ) -> Option<Finding> {
        let changed = cx.definitions().set_by(Fact::Tool)?;
        let tool = Abstract::known(cx.state().tool()).and_then(whole);
        if cx.state().spindle() != Some(Spindle::CounterClockwise)
            || self.changed == Some(changed) && self.tool == tool
        {
            return None;
        }
        (self.changed, self.tool) = (Some(changed), tool);
        let comment = comment_of_tool(cx, changed).filter(|comment| is_of_kind(comment))?;
        let started = cx.definitions().set_by(Fact::Spindle);
        let start =
            started.and_then(|at| cx.find_word(at, |word| turns_backwards(cx.model.effect(word.code))));
        let name = cx.name_of_effect(Effect::SpindleCounterClockwise).unwrap_or_default();
        let right = cx.name_of_effect(Effect::SpindleClockwise).unwrap_or_default();
        let Called { tool, in_short, cuts, named } = called;
        let message = format!("the {tool} turns backwards (`{name}`)");
        let here = format!("{cuts} here");
        let mut finding = match start {
            Some(range) => cx.finding(meta, range, message).label("counter-clockwise").also(cx.range(), here),
            None => cx.finding(meta, cx.range(), message).label(here),
        };
        if let Some(range) = cx.range_of(comment.at) {
            finding = finding.also(range, format!("names {named}"));
        }
        let help = format!("start the spindle with `{right}`, or name the {in_short} left-hand (`LH`)");
        Some(finding.help(help))
    }
}
