//! A hole that a cycle makes again, at a place where it has just made it.

use std::collections::btree_map::{BTreeMap, Entry};
use std::ops::Range;

use gcheck_controls::{CodeIx, Effect};
use gcheck_engine::{At, Axis, Event, Position, Role, TravelKind};

use crate::declare::declare_rule;
use crate::facts::cycles::is_cycle;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A cycle makes a hole where the same cycle has already made one, as deep.
    ///
    /// ## Why it matters
    /// A coordinate is wrong, most often its sign: one hole is made twice, and the one that is meant is missing. A tap that
    /// goes a second time into its thread may cut it away.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// G21 G17 G90 G54 S500 M3
    /// G0 Z50.
    /// G99 G84 X25. Y40. Z-12. R5. F625.
    /// X-25.
    /// Y-40.
    /// X-25.
    /// G80 G0 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// Another cycle, or another depth.
    /// ```nc,quiet,fanuc-mill
    /// G21 G17 G90 G54 S2000 M3
    /// G0 Z50.
    /// G99 G81 X25. Y40. Z-3. R5. F200.
    /// X-25.
    /// G83 X25. Y40. Z-20. R5. Q4. F200.
    /// X-25.
    /// Z-30.
    /// G80 G0 Z50.
    /// M30
    /// ```
    rule "hole-made-twice" in "cycles" {
        summary: "hole that the cycle has already made",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::FEED_STROKES.union(Watch::CHANGES).union(Watch::MODES),
            make: || Box::new(HoleMadeTwice::default()),
        },
    }
}

/// Holes of one cycle that are kept; a program with more comes from a system.
const MOST: usize = 2_000;
#[derive(Default, Clone, PartialEq)]
struct HoleMadeTwice {
    /// The cycle that makes the holes.
    cycle: Option<CodeIx>,
    /// The holes that it has made, by their places, with the bytes of the blocks that made them.
    holes: BTreeMap<Place, Range<u32>>,
    /// The hole that is being made.
    current: Option<Hole>,
}

remembers!(HoleMadeTwice: holes, current);

/// Where a hole is, in X, Y and the rotary axes, and its bottom: bits of millimetres and degrees.
type Place = [u64; 6];

/// A hole.
#[derive(Clone, PartialEq)]
struct Hole {
    at: Place,
    /// The block that makes it.
    block: At,
    /// Bytes of that block.
    bytes: Range<u32>,
}

remembers!(Hole: block, bytes);

impl PathRule for HoleMadeTwice {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_hole)
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        if let Event::Travel(travel) = event
            && travel.kind == TravelKind::Feed
            && travel.expanded
        {
            self.stroke(cx, &travel.to, report);
        }
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        match event {
            Event::RigidTap { to, .. } => self.stroke(cx, to, report),
            // Another tool, or places that count from another zero.
            Event::ToolChange(_)
            | Event::WorkOffset { .. }
            | Event::Shift(_)
            | Event::LengthOffset(_)
            | Event::Rotation(_)
            | Event::Stop(_) => self.end(cx, report),
            Event::Modal(code) if cx.model.role(*code) == Some(Role::Cycle) => self.end(cx, report),
            _ => {}
        }
    }
}

impl HoleMadeTwice {
    /// A stroke of a cycle.
    fn stroke(&mut self, cx: &PathCx<'_>, to: &Position, report: &mut Report<'_>) {
        let cycle = cx.state().active_cycle(cx.model).filter(|code| is_hole(cx.model.effect(*code)));
        // Of several paths, each may make the hole once.
        if cycle.is_none() || !cx.is_on_every_path() || cx.is_called_only() {
            (self.holes, self.current) = (BTreeMap::new(), None);
            return;
        }
        if self.cycle != cycle {
            self.end(cx, report);
            self.cycle = cycle;
        }
        // The strokes of a hole, and its repeats in one block, which another rule reports, go to one bottom.
        if let Some(hole) = self.current.as_mut().filter(|hole| hole.block == cx.origin().at) {
            hole.deepen(rounded(to.raw(Axis::Z)));
            return;
        }
        self.close(cx, report);
        let at = PLACE.map(|axis| rounded(to.raw(axis)).to_bits());
        self.current = Some(Hole { at, block: cx.origin().at, bytes: cx.range() });
    }

    /// The holes so far do not count any more.
    fn end(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.close(cx, report);
        self.holes.clear();
    }

    /// The hole that is being made is done.
    fn close(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        let Some(hole) = self.current.take().filter(Hole::is_known) else { return };
        let has_room = self.holes.len() < MOST;
        let before = match self.holes.entry(hole.at) {
            Entry::Occupied(before) => before.into_mut(),
            Entry::Vacant(place) => {
                if has_room {
                    place.insert(hole.bytes);
                }
                return;
            }
        };
        report.add(
            cx.finding(&META, hole.bytes, "the cycle makes the same hole once more")
                .label("at the same place, and as deep")
                .also(before.clone(), "made here before")
                .help("check the coordinates, and their signs"),
        );
    }
}

/// What makes a place: the bottom comes last.
const PLACE: [Axis; 6] = [Axis::X, Axis::Y, Axis::A, Axis::B, Axis::C, Axis::Z];

impl Hole {
    /// The bottom is that of its deepest stroke.
    fn deepen(&mut self, bottom: f64) {
        let [.., own] = &mut self.at;
        *own = f64::from_bits(*own).min(bottom).to_bits();
    }

    /// Are X, Y and Z known?
    fn is_known(&self) -> bool {
        let [x, y, .., z] = self.at.map(f64::from_bits);
        [x, y, z].iter().all(|number| number.is_finite())
    }
}

/// To micrometres, so that places which differ by less are one; unknown stays unknown.
fn rounded(number: f64) -> f64 {
    // Adding zero makes zero of minus zero.
    (number * 1_000.0).round() / 1_000.0 + 0.0
}

fn is_hole(effect: Effect) -> bool {
    is_cycle(effect) && !matches!(effect, Effect::CycleAlongTool(_))
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_peck_cycle_is_one_hole() {
        let program = |z: &str| {
            format!(
                "G21 G17 G90 G54 S2000 M3\nG0 Z50.\nG99 G83 X0. Y0. Z-20. R5. Q4. F200.\nX10.\nX0.{z}\nG80 G0 Z50.\nM30\n"
            )
        };
        check_rule(
            &RULE,
            "fanuc-mill",
            &program(""),
            &expect![[r#"
            5 | X0.
              | ^^^ warning[hole-made-twice] the cycle makes the same hole once more
        "#]],
        );
        check_rule(&RULE, "fanuc-mill", &program(" Z-30."), &expect![[""]]);
    }

    #[test]
    fn another_angle_of_the_part_is_another_hole() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "G21 G17 G90 G54 S2000 M3\nG0 Z50. A0.\nG99 G81 X0. Y0. Z-20. R5. F200.\nA90.\nX0. A90.\nG80 G0 Z50.\nM30\n",
            &expect![[r#"
                5 | X0. A90.
                  | ^^^^^^^^ warning[hole-made-twice] the cycle makes the same hole once more
            "#]],
        );
    }

    #[test]
    fn a_tap_of_linuxcnc() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G17 G90 G54 G94 S500 M3\nG0 X0 Y0 Z5\nG84 X5 Z-5 R2 F500\nX10\nX5\nG80\nM2\n",
            &expect![[r#"
                5 | X5
                  | ^^ warning[hole-made-twice] the cycle makes the same hole once more
            "#]],
        );
    }
}
