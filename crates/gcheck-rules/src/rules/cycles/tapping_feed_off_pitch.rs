//! A tap that is not fed by its pitch each turn.

use gcheck_controls::{Effect, Letter};
use gcheck_engine::{Abstract, At, Domain, Fact, FeedMode, Role, Units};
use gcheck_program::BlockFlags;

use crate::declare::declare_rule;
use crate::facts::boundary::is_before;
use crate::facts::offset_schemes::whole;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The feed per turn of a tapping cycle is not the pitch of the thread that the tool's comment names: the comment
    /// at the tool change, or the entry of the tool in a list at the head of the program.
    ///
    /// A little less than the pitch is accepted, for tension-compression holders. More is accepted only within the
    /// rounding of the feed.
    ///
    /// ## Why it matters
    /// A tap pulls itself in by its pitch. With another feed it tears the thread out, pulls out of its holder or
    /// breaks. The feed per minute is the speed times the pitch; the feed per turn is the pitch.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// T5 M6 (M6X1 TAP)
    /// G21 G90 G54 G0 X0. Y0.
    /// S500 M3
    /// G43 H5 Z10.
    /// G84 Z-12. R5. F600.
    /// G80
    /// M30
    /// ```
    /// ## Not reported
    /// A tension-compression holder is fed a little short.
    /// ```nc,quiet,haas-mill
    /// T5 M6 (M6X1 TAP)
    /// G21 G90 G54 G0 X0. Y0.
    /// S500 M3
    /// G43 H5 Z10.
    /// G84 Z-12. R5. F490.
    /// G80
    /// M30
    /// ```
    rule "tapping-feed-off-pitch" in "cycles" {
        summary: "tap fed by another distance per turn than its pitch",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::BLOCKS, make: || Box::new(TappingFeedOffPitch { told: None }) },
    }
}

#[derive(Clone, PartialEq)]
struct TappingFeedOffPitch {
    /// The tool change whose tool was reported.
    told: Option<At>,
}

remembers!(TappingFeedOffPitch: told);

/// A tension-compression holder is fed short by a few per cent.
const SHORT: f64 = 0.93;
/// For pitches that were rounded before the feed was computed from them.
const LONG: f64 = 1.006;

impl PathRule for TappingFeedOffPitch {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(is_tapping)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        if !cx.has_effect(is_tapping) || cx.depth() > 1 {
            return;
        }
        let Some(changed) = cx.trace().set_by(Fact::Tool) else { return };
        let state = cx.state();
        let given = |letter: char, before: Option<f64>| {
            if cx.origin().letters.contains(Letter::of(letter)) { cx.known_number(letter) } else { before }
        };
        let feed = given('F', Abstract::known(state.feed_word()));
        let speed = given('S', Abstract::known(state.speed()));
        let (Some(feed), Some(speed), Some(units)) = (feed, speed, state.units(cx.model)) else { return };
        // A mode in the block itself, and a feed from before a change of modes, are not what the state holds.
        let is_switched = cx.code_of_role(Role::FeedMode).is_some() || cx.code_of_role(Role::Units).is_some();
        let is_older = |fact| cx.trace().set_by(fact).is_some_and(|at| is_before(at, changed));
        let is_stale = is_older(Fact::Speed) && !cx.origin().letters.contains(Letter::of('S'));
        if self.told == Some(changed) || is_switched || is_stale || feed <= 0.0 || speed <= 0.0 {
            return;
        }
        let a_turn = match state.feed_mode(cx.model) {
            Some(FeedMode::PerMinute) => feed / speed,
            Some(FeedMode::PerRevolution) => feed,
            _ => return,
        } * units.in_mm();
        let Some(thread) = thread_of_tool(cx, changed).or_else(|| thread_in_list(cx)) else { return };
        let pitch = gcheck_geometry::Mm(thread.pitch);
        let by_turns = state.feed_mode(cx.model) == Some(FeedMode::PerRevolution);
        let right = if by_turns { thread.pitch } else { thread.pitch * speed } / units.in_mm();
        let is_rounded = (feed - right).abs() <= rounding(feed);
        if is_rounded || (SHORT..=LONG).contains(&(a_turn / thread.pitch)) {
            return;
        }
        // A program without units has its feed in those that fit the pitch.
        let are_written =
            cx.trace().set_by(Fact::Mode(Role::Units)).is_some() || cx.environment.machine.units_are_told;
        let in_others = a_turn / units.in_mm() * other(units).in_mm() / thread.pitch;
        if !are_written && (SHORT..=LONG).contains(&in_others) {
            return;
        }
        self.told = Some(changed);
        let right = trimmed(right);
        let message = format!(
            "the tap is fed {} per turn, and the pitch is {}",
            cx.shown(gcheck_geometry::Mm(a_turn)),
            cx.shown(pitch)
        );
        let mut finding = cx
            .finding(&META, cx.letter_range('F'), message)
            .label(format!(
                "`F{right}` for this pitch{}",
                if by_turns { String::new() } else { format!(" at `S{}`", trimmed(speed)) }
            ))
            .help("give the feed that belongs to speed and pitch, or correct the comment");
        if let Some(range) = cx.range_of(thread.at) {
            finding = finding.also(range, format!("names the thread: {}", thread.name));
        }
        report.add(finding);
    }
}

fn is_tapping(effect: Effect) -> bool {
    matches!(effect, Effect::CycleTap | Effect::CycleLeftTap)
}

/// Inches for millimetres, and millimetres for inches.
fn other(units: Units) -> Units {
    match units {
        Units::Inch => Units::Mm,
        Units::Mm => Units::Inch,
    }
}

/// The rounding error of a number with these digits.
fn rounding(number: f64) -> f64 {
    let text = trimmed(number);
    let digits = text.split_once('.').map_or(0, |(_, behind)| behind.len());
    // A little more, for the numbers of the machine.
    0.501 / 10_f64.powi(i32::try_from(digits).unwrap_or(0))
}

fn trimmed(number: f64) -> String {
    let text = format!("{number:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A thread that a comment names.
struct Thread {
    /// As the comment writes it.
    name: String,
    /// Millimetres.
    pitch: f64,
    /// The block of the comment.
    at: At,
}

/// The thread that the comment at a tool change names: in its block, in the one before it or in the one after it.
fn thread_of_tool(cx: &PathCx<'_>, changed: At) -> Option<Thread> {
    let before = changed.block.checked_sub(1).map(|block| At { block, ..changed });
    let places = [Some(changed), before, Some(changed.next())];
    let mut found = None;
    for at in places.into_iter().flatten() {
        let Some(place) = cx.place_of(at).filter(|_| at.file == 0) else { continue };
        let block = place.block();
        // Only a comment alone in its block belongs to the tool beside it.
        let is_alone = at == changed || place.table.words(block).is_empty();
        if !is_alone || !block.flags.contains(BlockFlags::COMMENT) {
            continue;
        }
        let Some(file) = cx.program.file(0) else { continue };
        let text = file.loaded.chunk_text(place.chunk);
        let text = text.get(block.range.start as usize..block.range.end as usize).unwrap_or_default();
        let Some((name, pitch)) = text.find(['(', ';']).and_then(|open| thread_in(text.get(open..)?)) else {
            continue;
        };
        if found.is_none() {
            found = Some(Thread { name, pitch, at });
        }
    }
    found
}

/// Blocks at the head of a program that are searched for a list of its tools.
const HEAD: u32 = 100;

/// The thread that the entry of the tool in a list at the head of the program names.
fn thread_in_list(cx: &PathCx<'_>) -> Option<Thread> {
    let tool = Abstract::known(cx.state().tool()).and_then(whole)?;
    let file = cx.program.file(0)?;
    let mut found: Option<Thread> = None;
    for block in 0..HEAD {
        let at = At { file: 0, block };
        let Some(place) = cx.place_of(at) else { break };
        let block = place.block();
        if !block.flags.contains(BlockFlags::COMMENT) || !place.table.words(block).is_empty() {
            continue;
        }
        let text = file.loaded.chunk_text(place.chunk);
        let text = text.get(block.range.start as usize..block.range.end as usize).unwrap_or_default();
        for entry in entries(text).filter(|(number, _)| *number == tool) {
            let Some((name, pitch)) = thread_in(entry.1) else { continue };
            // Two entries of one tool: a list for another machine, or of two set-ups.
            if found.as_ref().is_some_and(|thread| thread.pitch.to_bits() != pitch.to_bits()) {
                return None;
            }
            found = Some(Thread { name, pitch, at });
        }
    }
    found
}

/// The entries of a list of tools in a comment: `T4 1/4-20 TAP`, `T1 END MILL, T2 M6 TAP`; the number, and what follows.
fn entries(text: &str) -> impl Iterator<Item = (u32, &str)> {
    let starts = text.char_indices().filter_map(move |(at, letter)| {
        let before = text.get(..at)?.bytes().next_back();
        let begins = matches!(letter, 'T' | 't') && before.is_some_and(|b| !b.is_ascii_alphanumeric());
        let rest = text.get(at + 1..).filter(|_| begins)?;
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        let (number, behind) = rest.split_at_checked(digits)?;
        let ends = behind.starts_with([' ', ':', '-', '=', '|', ',', '\t']);
        number.parse().ok().filter(|_| ends && digits <= 4).map(|number: u32| (at, number, behind))
    });
    let starts: Vec<_> = starts.collect();
    let ends: Vec<usize> = starts.iter().skip(1).map(|(at, ..)| *at).chain([text.len()]).collect();
    starts.into_iter().zip(ends).filter_map(move |((_, number, behind), end)| {
        let length = end.saturating_sub(text.len() - behind.len());
        Some((number, behind.get(..length)?))
    })
}

/// The one thread that a comment about a tap names, and its pitch in millimetres.
fn thread_in(comment: &str) -> Option<(String, f64)> {
    let upper = comment.to_ascii_uppercase();
    let is_letter = |c: char| c.is_ascii_alphanumeric();
    let mut words = upper.split(|c: char| !is_letter(c));
    // A drill for a tap, and a thread that is milled, are not taps.
    let taps = words.clone().any(|word| matches!(word, "TAP" | "TAPS" | "TAPPING"));
    if !taps || words.any(|word| matches!(word, "DRILL" | "MILL" | "PREDRILL" | "CHAMFER" | "SPOT")) {
        return None;
    }
    let mut found: Vec<(String, f64)> = Vec::new();
    let pieces = upper.split(|c: char| !(is_letter(c) || matches!(c, '.' | '/' | '-' | '#' | '*')));
    for piece in pieces.filter(|piece| !piece.is_empty()) {
        if let Some(pitch) = metric(piece).or_else(|| inch(piece)) {
            found.push((piece.to_owned(), pitch));
        }
    }
    match found.as_slice() {
        [one] => Some(one.clone()),
        // `M6 (M6X1.0)` names one thread twice; anything else is not clear.
        [first, others @ ..] if others.iter().all(|other| other.1.to_bits() == first.1.to_bits()) => {
            Some(first.clone())
        }
        _ => None,
    }
}

/// `M6X1`, `M10-1.25`, `M8` with its coarse pitch.
fn metric(piece: &str) -> Option<f64> {
    const COARSE: [(f64, f64); 13] = [
        (2.0, 0.4),
        (2.5, 0.45),
        (3.0, 0.5),
        (4.0, 0.7),
        (5.0, 0.8),
        (6.0, 1.0),
        (8.0, 1.25),
        (10.0, 1.5),
        (12.0, 1.75),
        (14.0, 2.0),
        (16.0, 2.0),
        (20.0, 2.5),
        (24.0, 3.0),
    ];
    let size = piece.strip_prefix('M')?;
    match size.split_once(['X', '-', '*']) {
        Some((size, pitch)) => {
            let (size, pitch) = (number(size)?, number(pitch)?);
            ((0.2..=6.0).contains(&pitch) && pitch < size).then_some(pitch)
        }
        None => {
            let size = number(size)?;
            COARSE.iter().find(|(known, _)| known.to_bits() == size.to_bits()).map(|(_, pitch)| *pitch)
        }
    }
}

/// `1/4-20`, `#10-32`, `10-24`: threads per inch after the dash, and only if such a thread exists.
fn inch(piece: &str) -> Option<f64> {
    const NUMBERED: [(u32, u32); 17] = [
        (0, 80),
        (1, 64),
        (1, 72),
        (2, 56),
        (2, 64),
        (3, 48),
        (4, 40),
        (4, 48),
        (5, 40),
        (6, 32),
        (6, 40),
        (8, 32),
        (8, 36),
        (10, 24),
        (10, 32),
        (12, 24),
        (12, 28),
    ];
    const FRACTIONS: [(&str, [u32; 2]); 10] = [
        ("1/4", [20, 28]),
        ("5/16", [18, 24]),
        ("3/8", [16, 24]),
        ("7/16", [14, 20]),
        ("1/2", [13, 20]),
        ("9/16", [12, 18]),
        ("5/8", [11, 18]),
        ("3/4", [10, 16]),
        ("7/8", [9, 14]),
        ("1", [8, 12]),
    ];
    let (size, threads) = piece.split_once('-')?;
    let threads = threads.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let threads: u32 = threads.parse().ok()?;
    let is_made = match FRACTIONS.iter().find(|(known, _)| *known == size) {
        Some((_, made)) => made.contains(&threads),
        None => {
            let number: u32 = size.trim_start_matches('#').parse().ok()?;
            NUMBERED.contains(&(number, threads))
        }
    };
    is_made.then(|| 25.4 / f64::from(threads))
}

fn number(text: &str) -> Option<f64> {
    let is_number = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    text.parse().ok().filter(|_| is_number)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{RULE, thread_in};
    use crate::testing::check_rule;

    #[test]
    fn threads_as_shops_write_them() {
        for (comment, expected) in [
            ("(M6X1 TAP)", Some(1.0)),
            ("(TAP M8)", Some(1.25)),
            ("(T5 - M10-1.25 SPIRAL TAP)", Some(1.25)),
            ("(1/4-20 TAP)", Some(25.4 / 20.0)),
            ("(#10-32UNF TAP)", Some(25.4 / 32.0)),
            ("(TAPER PIN M6)", None),
            ("(DRILL 5.0 FOR M6 TAP)", None),
            ("(TAP 1-1/4 DEEP)", None),
            ("(TAP M6 OR M8)", None),
            ("(M6 THREAD MILL TAP)", None),
        ] {
            assert_eq!(thread_in(comment).map(|(_, pitch)| pitch), expected, "{comment}");
        }
    }

    #[test]
    fn feed_a_turn_is_the_pitch() {
        check_rule(
            &RULE,
            "fanuc-mill",
            "(1/4-20 TAP)\nT5 M6\nG20 G90 G54 G0 X0. Y0.\nG95 S500 M3\nG84 Z-1. R.1 F.05\nG80\nM30\n",
            &expect![[""]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            "(1/4-20 TAP)\nT5 M6\nG20 G90 G54 G0 X0. Y0.\nG94 S500 M3\nG84 Z-1. R.1 F.05\nG80\nM30\n",
            &expect![[r#"
                5 | G84 Z-1. R.1 F.05
                  |              ^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.0001 in per turn, and the pitch is 0.05 in
            "#]],
        );
    }

    #[test]
    fn without_units_the_feed_is_in_those_that_fit_the_pitch() {
        let program = |units: &str, feed: &str| {
            format!(
                "(M3X0.5 FORM TAP)\nM6 T15\nG90 G54 {units}G0 X0. Y0.\nG95 S300 M3\nG84 Z-1. R.1 {feed}\nG80\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-mill", &program("", "F0.019685"), &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", &program("", "F0.5"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("", "F0.03"),
            &expect![[r#"
                5 | G84 Z-1. R.1 F0.03
                  |              ^^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.03 mm per turn, and the pitch is 0.5 mm
            "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("G21 ", "F0.019685"),
            &expect![[r#"
                5 | G84 Z-1. R.1 F0.019685
                  |              ^^^^^^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.02 mm per turn, and the pitch is 0.5 mm
            "#]],
        );
    }

    #[test]
    fn the_list_at_the_head_names_the_thread() {
        let program = |feed: &str| {
            format!(
                "O1\n(T3 5 MM DRILL)\n(T4 M6 TAP)\nT4 M6\nG21 G90 G54 G0 X0. Y0.\nS300 M3\nG84 Z-9. R3. F{feed}\nG80\nM30\n"
            )
        };
        check_rule(&RULE, "haas-mill", &program("300."), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-mill",
            &program("307."),
            &expect![[r#"
            7 | G84 Z-9. R3. F307.
              |              ^^^^^ warning[tapping-feed-off-pitch] the tap is fed 1.023 mm per turn, and the pitch is 1 mm
        "#]],
        );
        let list = "; T1 drill, T2 M6 tap, T3 M8 tap\nT2 M6\nG21 G90 G54 G0 X0 Y0\nS300 M3\nG84 Z-9 R3 F400\nG80\nM2\n";
        check_rule(
            &RULE,
            "linuxcnc",
            list,
            &expect![[r#"
            5 | G84 Z-9 R3 F400
              |            ^^^^ warning[tapping-feed-off-pitch] the tap is fed 1.333 mm per turn, and the pitch is 1 mm
        "#]],
        );
    }

    #[test]
    fn a_feed_that_was_rounded_belongs_to_the_pitch() {
        let program = |feed: &str| {
            format!("T4 M6 (5/16-18 TAP)\nG20 G90 G54 G0 X0. Y0.\nS480 M3\nG84 Z-.9 R.2 F{feed}\nG80\nM30\n")
        };
        for feed in ["26.667", "26.67", "26.7", "27."] {
            check_rule(&RULE, "haas-mill", &program(feed), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "haas-mill",
            &program("27.5"),
            &expect![[r#"
                4 | G84 Z-.9 R.2 F27.5
                  |              ^^^^^ warning[tapping-feed-off-pitch] the tap is fed 0.0573 in per turn, and the pitch is 0.0556 in
            "#]],
        );
    }

    #[test]
    fn a_speed_that_is_not_this_tools_says_nothing() {
        check_rule(
            &RULE,
            "haas-mill",
            "G21 G90 G54 S3000 M3\nT5 M6 (M6 TAP)\nG0 X0. Y0.\nG84 Z-12. R5. F500.\nG80\nM30\n",
            &expect![[""]],
        );
    }
}
