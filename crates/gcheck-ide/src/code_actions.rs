//! What an editor offers to do at a place.
//!
//! Knows: which changes are offered where. Must not know: how editors ask, how each change is made.

mod action;
mod arcs;
mod cycles;
mod fixes;
mod lines;
mod points;
mod proved;
mod suppress;

use std::ops::Range;

use gcheck_db::{Analysis, Cancelled, Database, DocumentId};

pub use action::{ActionKind, CodeAction, Offer};
pub use proved::{
    PROVED, PathChange, Proved, ProvedChange, WITH_FIGURES, proved, proved_change_at, proved_changes,
    whole_lines,
};

/// Bytes of a file for which changes of the whole file are offered at every place; of a larger one only when all of it is
/// selected, because editors ask at every move of the cursor.
const LARGE: u32 = 256 << 10;

/// What can be done in a range, as findings of `analysis` and the text suggest.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn code_actions(
    database: &mut Database,
    document: DocumentId,
    range: Range<u32>,
    analysis: Option<&Analysis>,
    stop: &dyn Fn() -> bool,
) -> Result<Vec<CodeAction>, Cancelled> {
    let snapshot = database.indexed(document).ok_or(Cancelled)?;
    let range =
        range.start.min(snapshot.len())..range.end.clamp(range.start.min(snapshot.len()), snapshot.len());
    let is_whole = snapshot.len() <= LARGE || range == (0..snapshot.len());
    let mut actions = Vec::new();
    if let Some(analysis) = analysis {
        fixes::offer(&snapshot, analysis, &range, &mut actions);
    }
    arcs::offer(database, document, &snapshot, range.start, stop, &mut actions)?;
    lines::offer_block_skip(&snapshot, &range, &mut actions);
    if is_whole {
        points::offer(&snapshot, &mut actions);
        lines::offer_renumber(&snapshot, &mut actions);
    }
    Ok(actions)
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;
    use std::ops::Range;

    use expect_test::{Expect, expect};

    use super::{ActionKind, CodeAction, Offer, code_actions};
    use crate::fixture::{Fixture, applied};

    /// All actions at a range.
    fn offered(fixture: &mut Fixture, at: Range<u32>) -> Vec<CodeAction> {
        let analysis = fixture.analysis();
        code_actions(&mut fixture.database, fixture.document, at, Some(&analysis), &|| false).unwrap()
    }

    /// All actions at the cursor.
    fn offered_at_cursor(fixture: &mut Fixture) -> Vec<CodeAction> {
        offered(fixture, fixture.offset..fixture.offset)
    }

    /// Does a title fit the one with `…` that lists have?
    fn fits(title: &str, pattern: &str) -> bool {
        let mut rest = title;
        let mut parts = pattern.split('…');
        let first = parts.next().unwrap();
        let Some(after) = rest.strip_prefix(first) else { return false };
        rest = after;
        parts.all(|part| {
            let found = rest.find(part);
            rest = found.map_or("", |at| &rest[at + part.len()..]);
            found.is_some()
        })
    }

    #[test]
    fn each_action_has_the_title_that_lists_have() {
        let mut seen = std::collections::BTreeSet::new();
        for (control, text) in [
            (
                "fanuc-mill",
                "%\nO1\nG21 G90 G54 G0 X1. Y0.\nG1 G1 X5 F100.\nN7 G2 X6. Y$05. R5.\nG1 X6\nM30\n%\n",
            ),
            ("haas-mill", "%\nO1\nG21 G90 G54 G0 X1. Y0.\n/G2 X6. Y$05. I0. J5. F100.\nM30\n%\n"),
        ] {
            let mut fixture = Fixture::new(control, text);
            let whole = 0..fixture.snapshot().len();
            let at_cursor = offered_at_cursor(&mut fixture);
            for action in offered(&mut fixture, whole).into_iter().chain(at_cursor) {
                let title = action.offer.title();
                assert!(fits(&action.title, title), "{} is titled {title}", action.title);
                seen.insert(action.offer.name());
            }
        }
        let missing: Vec<_> =
            Offer::ALL.iter().map(|offer| offer.name()).filter(|name| !seen.contains(name)).collect();
        assert_eq!(missing, [""; 0]);
    }

    /// The actions at the cursor of some kinds, and the text after each.
    fn check(control: &str, text: &str, kinds: &[ActionKind], expected: &Expect) {
        let mut fixture = Fixture::new(control, text);
        let actions = offered_at_cursor(&mut fixture);
        let mut out = String::new();
        for action in actions.iter().filter(|action| kinds.contains(&action.kind)) {
            let preferred = if action.is_preferred { " (preferred)" } else { "" };
            let _ = writeln!(out, "# {:?}: {}{preferred}", action.kind, action.title);
            out.push_str(&action.link.clone().map(|link| link + "\n").unwrap_or_default());
            if !action.edits.is_empty() {
                out.push_str(&applied(&fixture.snapshot().text(), &action.edits));
            }
        }
        expected.assert_eq(&out);
    }

    #[test]
    fn fixes_of_a_finding_of_its_rule_and_of_the_file() {
        let text = "%\nO1\nG21 G90 G54 G0 X1.\nG1 X5$0 F100.\nG1 X6\nM30\n%\n";
        check(
            "haas-mill",
            text,
            &[ActionKind::Fix, ActionKind::FixAll],
            &expect![[r#"
                # Fix: Write a decimal point after `X5` (may change moves)
                %
                O1
                G21 G90 G54 G0 X1.
                G1 X5. F100.
                G1 X6
                M30
                %
                # Fix: Fix all 2 `missing-decimal-point` findings in this file (may change moves)
                %
                O1
                G21 G90 G54 G0 X1.
                G1 X5. F100.
                G1 X6.
                M30
                %
            "#]],
        );
    }

    #[test]
    fn a_finding_is_silenced_or_explained() {
        let text = "%\nO1\nG21 G90 G54 G0 X1.\nG1 X5$0.\nM30\n%\n";
        check(
            "haas-mill",
            text,
            &[ActionKind::Suppress, ActionKind::Explain],
            &expect![[r#"
                # Suppress: Ignore `feed-missing` on this line
                %
                O1
                G21 G90 G54 G0 X1.
                G1 X5. (gcheck: ignore feed-missing - say why)
                M30
                %
                # Suppress: Ignore `feed-missing` in this file
                %
                O1
                (gcheck: ignore-file feed-missing - say why)
                G21 G90 G54 G0 X1.
                G1 X5.
                M30
                %
                # Explain: Explain `feed-missing`
                https://github.com/gcheck/gcheck/blob/main/docs/rules/feed-missing.md
            "#]],
        );
        let text = "G21 G90 G54 G0 X1\nG1 X5$0 ; cut\nM2\n";
        check(
            "linuxcnc",
            text,
            &[ActionKind::Suppress],
            &expect![[r#"
                # Suppress: Ignore `feed-missing` on this line
                G21 G90 G54 G0 X1
                (gcheck: ignore feed-missing - say why)
                G1 X5 ; cut
                M2
                # Suppress: Ignore `feed-missing` in this file
                (gcheck: ignore-file feed-missing - say why)
                G21 G90 G54 G0 X1
                G1 X5 ; cut
                M2
            "#]],
        );
    }

    #[test]
    fn decimal_points_in_the_file() {
        let text = "O1\nG21 G90 G54 G0 X1000 Y0$0\nG4 P500\nG1 Z-1. F200\nG65 P9010 A1\nM30\n";
        check(
            "fanuc-mill",
            text,
            &[ActionKind::Source],
            &expect![[r#"
                # Source: Write 1 number with decimal points, as the control counts them
                O1
                G21 G90 G54 G0 X1. Y0
                G4 P500
                G1 Z-1. F200
                G65 P9010 A1
                M30
                # Source: Write decimal points after 1 number without one (changes what they count)
                O1
                G21 G90 G54 G0 X1000. Y0
                G4 P500
                G1 Z-1. F200
                G65 P9010 A1
                M30
            "#]],
        );
    }

    #[test]
    fn arcs_by_radius_and_by_centre() {
        check(
            "haas-mill",
            "O1\nG21 G90 G54 G0 X0. Y0.\nG2 X10. Y10. R$010. F100.\nM30\n",
            &[ActionKind::Rewrite],
            &expect![[r#"
                # Rewrite: Write this arc with its centre
                O1
                G21 G90 G54 G0 X0. Y0.
                G2 X10. Y10. I10. J0. F100.
                M30
                # Rewrite: Add block delete to this block
                O1
                G21 G90 G54 G0 X0. Y0.
                /G2 X10. Y10. R10. F100.
                M30
            "#]],
        );
        check(
            "haas-mill",
            "O1\nG21 G90 G54 G0 X0. Y0.\nG2 X10. Y10. I$010. J0. F100.\nM30\n",
            &[ActionKind::Rewrite],
            &expect![[r#"
                # Rewrite: Write this arc with its radius
                O1
                G21 G90 G54 G0 X0. Y0.
                G2 X10. Y10. R10. F100.
                M30
                # Rewrite: Add block delete to this block
                O1
                G21 G90 G54 G0 X0. Y0.
                /G2 X10. Y10. I10. J0. F100.
                M30
            "#]],
        );
        check(
            "haas-lathe",
            "O1\nG20 G54 G18 G0 X1. Z0.\nG3 X1.5 Z-.25 R.2$05 F.01\nM30\n",
            &[ActionKind::Rewrite],
            &expect![[r#"
                # Rewrite: Write this arc with its centre
                O1
                G20 G54 G18 G0 X1. Z0.
                G3 X1.5 Z-.25 I0. K-0.25 F.01
                M30
                # Rewrite: Add block delete to this block
                O1
                G20 G54 G18 G0 X1. Z0.
                /G3 X1.5 Z-.25 R.25 F.01
                M30
            "#]],
        );
        check(
            "linuxcnc",
            "G21 G90 G90.1 G0 X0 Y0\nG3 X10 Y10 I$00 J10 F100\nM2\n",
            &[ActionKind::Rewrite],
            &expect![[r#"
                # Rewrite: Write this arc with its radius
                G21 G90 G90.1 G0 X0 Y0
                G3 X10 Y10 R10. F100
                M2
                # Rewrite: Add block delete to this block
                G21 G90 G90.1 G0 X0 Y0
                /G3 X10 Y10 I0 J10 F100
                M2
            "#]],
        );
    }

    #[test]
    fn a_full_circle_has_no_radius() {
        check(
            "haas-mill",
            "O1\nG21 G90 G54 G0 X0. Y0.\nG2 I$010. F100.\nM30\n",
            &[ActionKind::Rewrite],
            &expect![[r#"
                # Rewrite: Add block delete to this block
                O1
                G21 G90 G54 G0 X0. Y0.
                /G2 I10. F100.
                M30
            "#]],
        );
    }

    #[test]
    fn what_is_written_otherwise_moves_as_before() {
        let moves = |control: &str, text: &str| {
            let snapshot = Fixture::new(control, text).snapshot();
            let mut moves: Vec<String> = Vec::new();
            let rounded = |position: &gcheck_engine::Position| {
                position.values().map(|value| (value * 1_000.0).round() / 1_000.0 + 0.0)
            };
            let mut show = |shown: &crate::running::Shown<'_>| {
                let crate::running::Shown::Event(step) = shown else { return };
                match step.event {
                    gcheck_engine::Event::Travel(travel) if travel.from != travel.to => {
                        moves.push(format!("{:?} {:?}", travel.kind, rounded(&travel.to)));
                    }
                    gcheck_engine::Event::Arc(arc) => {
                        moves.push(format!("arc {:.2} {:?}", arc.sweep, rounded(&arc.to)));
                    }
                    gcheck_engine::Event::Dwell(time) => moves.push(format!("dwell {}", time.0)),
                    _ => {}
                }
            };
            let machine = &snapshot.settings().machine.engine;
            let options = gcheck_engine::Options::NONE;
            crate::running::run_through(&snapshot, machine, options, 10_000, &|| false, &mut show).unwrap();
            moves
        };
        for (control, text) in [
            ("haas-mill", "O1\nG20 G90 G54 G0 X0. Y0.\nG3$0 X1.234 Y.777 R1.1 F10.\nM30\n"),
            ("haas-mill", "O1\nG20 G90 G54 G0 X0. Y0.\nG3$0 X1.234 Y.777 R-1.1 F10.\nM30\n"),
            ("fanuc-mill", "O1\nG21 G18 G90 G54 G0 X0. Z0.\nG2$0 X10. Z10. K10. I0. F10.\nM30\n"),
        ] {
            let mut fixture = Fixture::new(control, text);
            let actions = offered_at_cursor(&mut fixture);
            let before = fixture.snapshot().text();
            let action = actions.iter().find(|action| action.title.starts_with("Write this"));
            let after = applied(&before, &action.unwrap_or_else(|| panic!("nothing offered: {text}")).edits);
            assert_eq!(moves(control, &before), moves(control, &after), "{before}\nbecame\n{after}");
        }
    }

    #[test]
    fn lines_with_and_without_block_skip() {
        let text = "O1\nN10 G0 X1.\n\n/N20 X2.\n(NOTE)\nM30\n";
        let mut fixture = Fixture::new("haas-mill", text);
        let mut toggled = |range: Range<u32>, text: &str| {
            let mut actions = offered(&mut fixture, range).into_iter();
            let action = actions.find(|action| action.title.contains("block delete")).unwrap();
            applied(text, &action.edits)
        };
        assert_eq!(toggled(4..25, text), "O1\n/N10 G0 X1.\n\n/N20 X2.\n(NOTE)\nM30\n");
        assert_eq!(toggled(16..18, text), "O1\nN10 G0 X1.\n\nN20 X2.\n(NOTE)\nM30\n");
    }

    #[test]
    fn numbers_in_tens() {
        let text = "O1\nN1 G0 X1.$0\nN2 X2.\nGOTO 1\nM30\n";
        check(
            "haas-mill",
            text,
            &[ActionKind::Source],
            &expect![[r#"
                # Source: Renumber blocks in tens, with the jumps to them
                O1
                N10 G0 X1.
                N20 X2.
                GOTO 10
                M30
            "#]],
        );
    }
}
