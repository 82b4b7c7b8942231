//! A mode that one tool's work switched on, that the next tool cuts with, and that nothing in the file switches off.
//!
//! Knows: where the first tool comes, where a mode was set, what the file can switch. Must not know: any rule.

use gcheck_controls::Effect;
use gcheck_engine::{At, Fact, Role};

use crate::boundary::{Boundary, is_before};
use crate::memory::remembers;
use crate::{Finding, PathCx, RuleMeta};

/// Looks whether tools cut with a mode of the tool before.
///
/// A mode of the head of the program is meant for all tools, and one that the file switches off somewhere may be meant to
/// last until there. A mode that begins in the middle of one tool's work and never ends is meant for that tool.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Carried {
    /// Where the first tool comes.
    first_tool: Option<At>,
    /// One cut speaks for all behind it, and for the end of the program.
    pub(crate) is_told: bool,
}

remembers!(Carried: first_tool);

impl Carried {
    /// Before a block.
    pub(crate) fn block(&mut self, cx: &PathCx<'_>) {
        if self.first_tool.is_none() && cx.boundary() == Some(Boundary::ToolChange) {
            self.first_tool = Some(cx.origin().at);
        }
    }

    /// After a cut. The mode is `what`; codes with the effect `off` switch it off.
    pub(crate) fn cut(
        &mut self,
        cx: &PathCx<'_>,
        rule: &'static RuleMeta,
        (of, on, off): (Role, Effect, Effect),
        what: &str,
    ) -> Option<Finding> {
        let first_tool = self.first_tool.filter(|_| !self.is_told)?;
        let code = cx.state().mode(of).only()?;
        if !code.is_some() || cx.model.effect(code) != on {
            return None;
        }
        let (set, changed) = (cx.trace().set_by(Fact::Mode(of))?, cx.trace().set_by(Fact::Tool)?);
        if !is_before(first_tool, set) || !is_before(set, changed) || cx.file_uses(|effect| effect == off) {
            return None;
        }
        self.is_told = true;
        let (name, cancel) = (cx.name_of(code), cx.cancel_of(off).unwrap_or_default());
        let finding = cx
            .finding(rule, cx.range(), format!("the tool cuts with {what} of the tool before (`{name}`)"))
            .label("nothing in the file switches it off")
            .help(format!("switch it off with `{cancel}` where the work of the tool before ends"));
        let finding = match cx.range_of(changed) {
            Some(range) => finding.also(range, "the tool comes here"),
            None => finding,
        };
        Some(cx.resting_on(finding, Fact::Mode(of), &format!("`{name}`")))
    }
}
