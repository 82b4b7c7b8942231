//! A mode that the position of the block delete switch decides.

use std::ops::Range;

use gcheck_controls::{CodeIx, Effect, LetterSet};
use gcheck_engine::{At, Axis, Event, Fact, Role};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::facts::modes::ignores_distance_mode;
use crate::{PathCx, PathRule, Report, Run, Severity, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block with a block delete (`/`) changes a mode, and a later block without one moves in that mode: its move
    /// depends on the switch on the panel.
    ///
    /// ## Why it matters
    /// With the switch in its other position the same block moves to another place, in another plane or from another
    /// zero. Blocks to be skipped should not change modes.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G90 G54 G0 X0. Y0.
    /// /G91 G1 Z-1. F100.
    /// G0 X50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// G90 G54 G0 X0. Y0.
    /// /G91 G1 Z-1. F100.
    /// /G90
    /// G0 X50.
    /// M30
    /// ```
    /// The end of cylindrical mapping is reported as a warning: without it the next move turns the part.
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0. A0.
    /// G107 Y0. A0. Q50.
    /// G1 Y10. F100.
    /// /G107
    /// G0 Y50.
    /// M30
    /// ```
    rule "modal-change-in-skipped-block" in "modal" {
        summary: "mode depends on the block delete switch",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::RAPIDS).union(Watch::CUTS),
            make: || Box::new(ModalChangeInSkippedBlock { skipped: Vec::new(), changes: Vec::new(), unwrapped: None }),
        },
    }
}

/// Modes that decide where a move goes.
const ROLES: [Role; 9] = [
    Role::Distance,
    Role::Units,
    Role::Plane,
    Role::WorkOffset,
    Role::Length,
    Role::Compensation,
    Role::Scaling,
    Role::Rotation,
    Role::FeedMode,
];

/// A mode that a block to be skipped changed.
#[derive(Clone, PartialEq)]
struct Change {
    role: Role,
    at: At,
    code: CodeIx,
    range: Range<u32>,
}

remembers!(Change: at, range);

#[derive(Clone, PartialEq)]
struct ModalChangeInSkippedBlock {
    /// By role: the code that is in effect with the blocks skipped, once one of them changed it.
    skipped: Vec<(Role, CodeIx)>,
    /// The last change of each role by a block to be skipped.
    changes: Vec<Change>,
    /// A block to be skipped that ended cylindrical mapping: the wrapped axis, the one that turned, the code.
    unwrapped: Option<Unwrapped>,
}

remembers!(ModalChangeInSkippedBlock: changes, unwrapped);

/// The end of cylindrical mapping in a block to be skipped.
#[derive(Clone, PartialEq)]
struct Unwrapped {
    linear: Axis,
    rotary: Axis,
    name: String,
    range: Range<u32>,
}

remembers!(Unwrapped: range);

impl PathRule for ModalChangeInSkippedBlock {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.survey.block_deletes != 0
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.note_mapping(cx);
        for code in cx.codes().iter().copied() {
            let Some(role) = cx.model.role(code).filter(|role| ROLES.contains(role)) else { continue };
            if !is_optional(cx) {
                self.skipped.retain(|(other, _)| *other != role);
                self.changes.retain(|change| change.role != role);
                continue;
            }
            let Some(before) = cx.state().mode(role).only() else { continue };
            if self.skipped.iter().all(|(other, _)| *other != role) {
                self.skipped.push((role, before));
            }
            self.changes.retain(|change| change.role != role);
            let range = cx.word_range(|word| word.code == code);
            self.changes.push(Change { role, at: cx.origin().at, code, range });
        }
    }

    fn rapid(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }

    fn cut(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        self.moves(cx, report);
    }
}

/// Does the block have a block delete?
fn is_optional(cx: &PathCx<'_>) -> bool {
    cx.origin().flags.contains(BlockFlags::BLOCK_DELETE)
        && cx.place().is_some_and(|place| place.block().delete > 0)
}

impl ModalChangeInSkippedBlock {
    /// The code that begins mapping ends it too, so its mode does not tell them apart.
    fn note_mapping(&mut self, cx: &PathCx<'_>) {
        let is_mapping = |effect| effect == Effect::CylinderMapping;
        if !cx.has_effect(is_mapping) {
            return;
        }
        self.unwrapped = None;
        let ends = !cx.origin().letters.intersects(LetterSet::of("XYZABCQR"));
        if let Some(cylinder) = cx.state().wrapped().cylinder().filter(|_| ends && is_optional(cx)) {
            self.unwrapped = Some(Unwrapped {
                linear: cylinder.linear,
                rotary: cylinder.rotary,
                name: cx.name_of_effect(Effect::CylinderMapping).unwrap_or_default(),
                range: cx.effect_range(is_mapping),
            });
        }
    }

    fn still_wrapped(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let moves = |unwrapped: &Unwrapped| cx.origin().letters.contains(unwrapped.linear.letter());
        let Some(Unwrapped { linear, rotary, name, range }) = self.unwrapped.take_if(|it| moves(it)) else {
            return;
        };
        let (linear, rotary) = (linear.name(), rotary.name());
        report.add(
            cx.finding(
                &META,
                range,
                format!("what follows depends on the block delete switch (`/`, `{name}`)"),
            )
            .label(format!("ends the mapping of {linear} only when the switch is off"))
            .also(cx.range(), format!("moves {linear}, or turns {rotary} when that block is skipped"))
            .help(format!("write `{name}` in a block without `/`")),
        );
    }

    fn moves(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.survey.block_deletes == 0 {
            cx.enough();
            return;
        }
        if !is_optional(cx) {
            self.still_wrapped(cx, report);
        }
        if self.changes.is_empty()
            || is_optional(cx)
            || ignores_distance_mode(cx)
            || !cx.origin().letters.intersects(LetterSet::of("XYZABCUVW"))
        {
            return;
        }
        for change in std::mem::take(&mut self.changes) {
            let skipped = self.skipped.iter().find(|(role, _)| *role == change.role).map(|(_, code)| *code);
            // Another program may have set it since; a plane matters to arcs only.
            let is_still = cx.trace().set_by(Fact::Mode(change.role)) == Some(change.at)
                && cx.state().mode(change.role).only() == Some(change.code);
            let matters = change.role != Role::Plane || cx.origin().letters.intersects(LetterSet::of("IJKR"));
            if !is_still || skipped == Some(change.code) {
                continue;
            }
            if !matters {
                self.changes.push(change);
                continue;
            }
            let name = cx.name_of(change.code);
            let otherwise = match skipped.filter(|code| code.is_some()) {
                Some(code) => format!(
                    "moves under `{name}`, or under `{}` when that block is skipped",
                    cx.name_of(code)
                ),
                None => format!("moves under `{name}`, or without it when that block is skipped"),
            };
            report.add(
                cx.finding(
                    &META,
                    change.range,
                    format!("what follows depends on the block delete switch (`/`, `{name}`)"),
                )
                .label("changes a mode only when the switch is off")
                .also(cx.range(), otherwise)
                .help("set the mode back in a block with `/`, or state it in the next block without `/`")
                .at_most(Severity::Info),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_code_in_the_optional_block_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0.\n/G55\nG1 X1. F5.\nX2.\nM30\n",
            &expect![[r#"
            2 | /G55
              |  ^^^ info[modal-change-in-skipped-block] what follows depends on the block delete switch (`/`, `G55`)
        "#]],
        );
    }

    #[test]
    fn a_mode_stated_again_depends_on_nothing() {
        check_rule(&RULE, "haas-mill", "G20 G90 G54 G0 X0.\n/G91 X1.\n/X1.\nG90 X5.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_mode_that_was_on_anyway_changes_nothing() {
        check_rule(&RULE, "haas-mill", "G20 G90 G54 G0 X0.\n/G90 X1.\nX5.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_plane_matters_to_arcs() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G54 G0 X0. Y0.\n/G18\nG1 X5. F5.\nG2 X6. I.5\nM30\n",
            &expect![[r#"
            2 | /G18
              |  ^^^ info[modal-change-in-skipped-block] what follows depends on the block delete switch (`/`, `G18`)
        "#]],
        );
    }
}
