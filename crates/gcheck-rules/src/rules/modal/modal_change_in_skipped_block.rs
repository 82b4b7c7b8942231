//! A mode that the position of the block delete switch decides.

use std::ops::Range;

use gcheck_controls::{CodeIx, Effect, LetterSet};
use gcheck_engine::{At, Axis, Event, Fact, Position, Role};

use crate::declare::declare_rule;
use crate::facts::block_delete::is_optional;
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
    /// A shift of the work zero that only one position of the switch makes:
    /// ```nc,reported,haas-mill
    /// G90 G54 G0 X0. Y0.
    /// /G52 X10.
    /// G0 X50.
    /// M30
    /// ```
    rule "modal-change-in-skipped-block" in "modal" {
        summary: "mode depends on the block delete switch",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::RAPIDS).union(Watch::CUTS),
            make: || Box::new(ModalChangeInSkippedBlock::default()),
        },
    }
}

/// Modes that decide where a move goes.
const ROLES: [Role; 10] = [
    Role::Distance,
    Role::Units,
    Role::Plane,
    Role::WorkOffset,
    Role::Length,
    Role::Compensation,
    Role::Scaling,
    Role::Rotation,
    Role::Mirror,
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

#[derive(Default, Clone, PartialEq)]
struct ModalChangeInSkippedBlock {
    /// By role: the code that is in effect with the blocks skipped, once one of them changed it.
    skipped: Vec<(Role, CodeIx)>,
    /// The last change of each role by a block to be skipped.
    changes: Vec<Change>,
    /// A block to be skipped that began or ended cylindrical mapping.
    mapping: Option<Mapping>,
    /// A block to be skipped that shifted the work zero.
    shift: Option<Shift>,
}

remembers!(ModalChangeInSkippedBlock: changes, mapping, shift);

/// A shift of the work zero in a block to be skipped.
#[derive(Clone, PartialEq)]
struct Shift {
    /// The shift in effect with the blocks skipped.
    skipped: Position,
    /// Its code: `G52`.
    name: String,
    range: Range<u32>,
}

remembers!(Shift: range);

/// The beginning or the end of cylindrical mapping in a block to be skipped.
#[derive(Clone, PartialEq)]
struct Mapping {
    /// The axis that was wrapped, and the one that turned, where the block ends the mapping.
    ended: Option<(Axis, Axis)>,
    name: String,
    range: Range<u32>,
}

remembers!(Mapping: range);

impl PathRule for ModalChangeInSkippedBlock {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.file_index.block_deletes != 0
    }

    fn block(&mut self, cx: &PathCx<'_>, _: &mut Report<'_>) {
        self.note_mapping(cx);
        self.note_shift(cx);
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

impl ModalChangeInSkippedBlock {
    /// The code that begins mapping ends it too, so its mode does not tell them apart.
    fn note_mapping(&mut self, cx: &PathCx<'_>) {
        let is_mapping = |effect| effect == Effect::CylinderMapping;
        if !cx.has_effect(is_mapping) {
            return;
        }
        self.mapping = None;
        let begins = cx.origin().letters.intersects(LetterSet::of("XYZABCQR"));
        let ended = cx.state().cylinder().map(|cylinder| (cylinder.linear, cylinder.rotary));
        if is_optional(cx) && (begins || ended.is_some()) {
            self.mapping = Some(Mapping {
                ended: ended.filter(|_| !begins),
                name: cx.name_of_effect(Effect::CylinderMapping).unwrap_or_default(),
                range: cx.effect_range(is_mapping),
            });
        }
    }

    fn tell_mapping(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let wrapped = || cx.state().cylinder().map(|cylinder| (cylinder.linear, cylinder.rotary));
        let Some(mapping) = &self.mapping else { return };
        let Some((linear, rotary)) = mapping.ended.or_else(wrapped) else { return };
        if !cx.origin().letters.contains(linear.letter()) {
            return;
        }
        let Some(Mapping { ended, name, range }) = self.mapping.take() else { return };
        let (linear, rotary) = (linear.name(), rotary.name());
        let (does, moves) = match ended {
            Some(_) => ("ends", format!("moves {linear}, or turns {rotary} when that block is skipped")),
            None => ("begins", format!("turns {rotary}, or moves {linear} when that block is skipped")),
        };
        report.add(
            cx.finding(
                &META,
                range,
                format!("what follows depends on the block delete switch (`/`, `{name}`)"),
            )
            .label(format!("{does} the mapping of {linear} only when the switch is off"))
            .also(cx.range(), moves)
            .help(format!("write `{name}` in a block without `/`")),
        );
    }

    fn note_shift(&mut self, cx: &PathCx<'_>) {
        let Some(code) = cx.codes().iter().copied().find(|code| cx.model.effect(*code).is_about_shifts())
        else {
            return;
        };
        if !is_optional(cx) {
            self.shift = None;
            return;
        }
        let skipped = self.shift.as_ref().map_or_else(|| cx.state().shift(), |shift| shift.skipped);
        let range = cx.word_range(|word| word.code == code);
        self.shift = Some(Shift { skipped, name: cx.name_of(code), range });
    }

    fn tell_shift(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // A position of the machine, or one in increments, does not go by the work zero.
        let is_apart = cx.has_effect(|effect| effect == Effect::MachineCoordinates)
            || cx.state().effect(Role::Distance, cx.model) == Some(Effect::Incremental);
        let Some(Shift { skipped, .. }) = self.shift.as_ref().filter(|_| !is_apart) else { return };
        let (now, letters) = (cx.state().shift(), cx.origin().letters);
        // What is not known differs from nothing.
        let differs = |axis: &Axis| (now.raw(*axis) - skipped.raw(*axis)).abs() > 1e-6;
        if !Axis::ALL.iter().any(|axis| letters.contains(axis.letter()) && differs(axis)) {
            return;
        }
        let Some(Shift { name, range, .. }) = self.shift.take() else { return };
        report.add(
            cx.finding(
                &META,
                range,
                format!("what follows depends on the block delete switch (`/`, `{name}`)"),
            )
            .label("shifts the work zero only when the switch is off")
            .also(cx.range(), "goes to another place when that block is skipped")
            .help(format!("write `{name}` in a block without `/`, or give the moves a `/` too"))
            .at_most(Severity::Info),
        );
    }

    fn moves(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if cx.file_index.block_deletes == 0 {
            cx.enough();
            return;
        }
        if !is_optional(cx) {
            self.tell_mapping(cx, report);
            self.tell_shift(cx, report);
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
            let is_still = cx.definitions().set_by(Fact::Mode(change.role)) == Some(change.at)
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
    fn a_shift_counts_where_it_changes_the_zero_of_a_move() {
        check_rule(
            &RULE,
            "haas-mill",
            "G90 G54 G0 X0.\n/G52 X10.\nG0 X50.\nM30\n",
            &expect![[r#"
            2 | /G52 X10.
              |  ^^^ info[modal-change-in-skipped-block] what follows depends on the block delete switch (`/`, `G52`)
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "G90 G54 G0 X1\n/G92 X10\nG0 X50\nM2\n",
            &expect![[r#"
            2 | /G92 X10
              |  ^^^ info[modal-change-in-skipped-block] what follows depends on the block delete switch (`/`, `G92`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "G90 G54 G0 X1. Y0.\n/G92 X0.\nG0 X5.\nM30\n",
            &expect![[r#"
            2 | /G92 X0.
              |  ^^^ info[modal-change-in-skipped-block] what follows depends on the block delete switch (`/`, `G92`)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G54 G0 X20. Z1.\n/G50 X30. Z5.\nG0 X50.\nM30\n",
            &expect![[r#"
            2 | /G50 X30. Z5.
              |  ^^^ info[modal-change-in-skipped-block] what follows depends on the block delete switch (`/`, `G50`)
        "#]],
        );
        // Taken back, in another axis, as it was, and no shift at all.
        let quiet = [
            "/G52 X10.\n/G0 X50.\n/G52 X0.\nG0 X50.",
            "/G52 Z1.\nG0 X5.",
            "/G52 X0. Y0.\nG0 X5.",
            "G52 X10.\n/G52 X10.\nG0 X50.",
            "/G52 X10.\nG91 G0 X50.",
            "/G52 X10.\nG53 G0 X0.",
        ];
        for blocks in quiet {
            check_rule(
                &RULE,
                "haas-mill",
                &format!("G90 G54 G0 X0. Y0. Z1.\n{blocks}\nM30\n"),
                &expect![[""]],
            );
        }
        check_rule(&RULE, "fanuc-lathe", "G54 G0 X0.\n/G50 S2000\nG0 X50.\nM30\n", &expect![[""]]);
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
