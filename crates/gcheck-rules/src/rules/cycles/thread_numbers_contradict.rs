//! A threading cycle whose words do not belong to one thread.

use gcheck_controls::Effect;
use gcheck_engine::{Axis, Event, Travel, TravelKind};
use gcheck_geometry::{Mm, Plane};
use gcheck_program::Word;

use crate::declare::declare_rule;
use crate::facts::thread_cycles::{is_cycle, is_pointed, length, number, words};
use crate::facts::turning::shown_radius;
use crate::{PathCx, PathRule, Report, Run, Uses, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// The words of a threading cycle of several passes do not belong to one thread:
    ///
    /// * the first cut is as deep as the whole thread, or deeper,
    /// * the lead is more than ten times the height,
    /// * the cycle starts inside the root, and the part is turned to the crest of an outside thread there, with no bore.
    ///
    /// Threads that are less than 0.25 mm (0.01 inch) high may be cut in one pass and at any lead.
    ///
    /// ## Why it matters
    /// The insert takes the whole thread in one pass, is pulled along too fast, or is driven into the face of the part.
    /// It breaks.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G20 G99 T404
    /// G97 S800 M3
    /// G0 X1.7 Z0.3
    /// G76 X1.3978 Z-0.9 K0.0511 D0.06 F0.083333
    /// M30
    /// ```
    /// ```nc,reported,haas-lathe
    /// G20 G99 T404
    /// G97 S800 M3
    /// G0 X1.7 Z0.3
    /// G76 X1.3978 Z-0.9 K0.0511 D0.0122 F0.83333
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G20 G99 T404
    /// G97 S800 M3
    /// G0 X1.7 Z0.3
    /// G76 X1.3978 Z-0.9 K0.0511 D0.0122 F0.083333
    /// M30
    /// ```
    rule "thread-numbers-contradict" in "cycles" {
        summary: "words of a threading cycle that belong to different threads",
        severity: Warning,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS.union(Watch::MOVES),
            make: || Box::new(ThreadNumbersContradict::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct ThreadNumbersContradict {
    cuts: Vec<Cut>,
    /// X and Z after the last move.
    last: Option<[f64; 2]>,
    /// X at the start of the cycle that comes next; a radius.
    start: Option<f64>,
    /// Where the tool cut is not known throughout.
    is_blind: bool,
}

remembers!(ThreadNumbersContradict);

/// A cut that is not a thread: X as a radius, and Z, of both ends.
#[derive(Clone, Copy, PartialEq)]
struct Cut([[f64; 2]; 2]);

/// Leads of this many heights belong to another thread: four starts of the shallowest thread have seven.
const MOST_HEIGHTS: f64 = 10.0;
/// Heights of this many leads belong to no thread: the deepest, a saw-tooth thread, has 0.87.
const MOST_LEADS: f64 = 1.2;
/// Shallower threads may be cut in one pass: millimetres.
const SHALLOW: f64 = 0.25;
/// Cuts that are kept. Longer programs come from a system.
const MOST_CUTS: usize = 5000;
/// Radii that differ by less are one: millimetres.
const SLACK: f64 = 0.01;

impl PathRule for ThreadNumbersContradict {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn concerns(&self, program: &Uses<'_>) -> bool {
        program.may(|effect| effect == Effect::ThreadCycle)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.start = None;
        if !cx.has_effect(|effect| effect == Effect::ThreadCycle) || cx.is_malformed() {
            return;
        }
        self.start = cx.state().position().get(Axis::X).filter(|_| cx.is_on_every_path());
        let Some(words) = words(cx) else { return };
        if let Some(first) = &words.first {
            first_cut(cx, &words.height, first, report);
        }
        if let Some(lead) = &words.lead {
            lead_for_height(cx, &words.height, lead, report);
            height_for_lead(cx, &words.height, lead, report);
        }
    }

    fn moved(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        match event {
            Event::Travel(travel) if travel.kind == TravelKind::Thread => {
                self.last = Some(point(&travel.programmed));
                if let Some(start) = self.start.take().filter(|_| !self.is_blind) {
                    self.thread(cx, start, travel, report);
                }
            }
            // As programmed: the nose radius is small beside a thread, and mostly not known.
            Event::Travel(travel) => self.go(&travel.programmed, travel.kind != TravelKind::Rapid),
            Event::Arc(arc) => self.go(&arc.programmed, true),
            _ => self.is_blind = true,
        }
    }
}

fn point(position: &gcheck_engine::Position) -> [f64; 2] {
    [position.raw(Axis::X), position.raw(Axis::Z)]
}

impl ThreadNumbersContradict {
    /// A move, which may cut.
    fn go(&mut self, to: &gcheck_engine::Position, cuts: bool) {
        let to = point(to);
        let from = self.last.replace(to);
        if !cuts || self.is_blind {
            return;
        }
        let ends = [from.unwrap_or([f64::NAN; 2]), to];
        if ends.iter().flatten().any(|coordinate| coordinate.is_nan()) || self.cuts.len() >= MOST_CUTS {
            *self = Self { is_blind: true, ..Self::default() };
        } else {
            self.cuts.push(Cut(ends));
        }
    }

    /// The first pass of a cycle that starts at this radius.
    fn thread(&self, cx: &PathCx<'_>, start: f64, travel: &Travel, report: &mut Report<'_>) {
        let Some([height, lead]) =
            words(cx).and_then(|words| Some([length(cx, &words.height)?, length(cx, words.lead.as_ref()?)?]))
        else {
            return;
        };
        let [[x0, z0], [x1, z1]] = [&travel.from, &travel.to].map(point);
        // A tapered thread has no one root, and a start at the other side of the spindle counts the other way.
        if cx.state().plane(cx.model) != Some(Plane::Zx) || (x0 - x1).abs() > SLACK || start < 0.0 {
            return;
        }
        // Of the first pass. From inside, the crest is within it, and from outside the root is.
        let pass = x1.min(x0);
        let Some(turned) = self.least_radius(f64::midpoint(z0, z1)) else { return };
        let crest = pass + height * 0.9..pass + height * 2.0 + lead;
        if start > pass - SLACK || !crest.contains(&turned) {
            return;
        }
        let shown = |radius: f64| shown_radius(cx, radius);
        report.add(
            cx.finding(&META, cx.effect_range(is_cycle), "an outside thread that starts inside its root")
                .label(format!("starts at X {}, and the part is turned to X {}", shown(start), shown(turned)))
                .note("a cycle that starts inside the root cuts outward, as in a bore")
                .assuming("the part has no bore before the program starts")
                .help("start the cycle outside the crest of the thread"),
        );
    }

    /// The smallest radius that was cut at this Z.
    fn least_radius(&self, z: f64) -> Option<f64> {
        let radii = self.cuts.iter().filter_map(|Cut([[x0, z0], [x1, z1]])| {
            let (low, high) = (z0.min(*z1), z0.max(*z1));
            let along = if high - low < SLACK { 0.0 } else { (z - z0) / (z1 - z0) };
            (low - SLACK..=high + SLACK).contains(&z).then_some(x0 + along * (x1 - x0))
        });
        radii.min_by(f64::total_cmp)
    }
}

fn first_cut(cx: &PathCx<'_>, height: &Word, first: &Word, report: &mut Report<'_>) {
    let (Some(whole), Some(depth)) = (number(cx, height), number(cx, first)) else { return };
    // A number without a point counts otherwise than one with it.
    if is_pointed(cx, height) != is_pointed(cx, first) || whole <= 0.0 || depth < whole {
        return;
    }
    if length(cx, height).is_none_or(|height| height < SHALLOW) {
        return;
    }
    let (height, first) = (height.letter, first.letter);
    report.add(
        cx.finding(
            &META,
            cx.word_range(|word| word.letter == first),
            "the first cut takes the whole thread at once",
        )
        .label(format!("not less than the height of the thread (`{height}`)"))
        .also(cx.word_range(|word| word.letter == height), "the height, from crest to root")
        .help(format!("correct `{height}`, or give a first cut that is less deep")),
    );
}

fn lead_for_height(cx: &PathCx<'_>, height: &Word, lead: &Word, report: &mut Report<'_>) {
    let (Some(height_mm), Some(lead_mm)) = (length(cx, height), length(cx, lead)) else { return };
    if height_mm < SHALLOW || lead_mm <= height_mm * MOST_HEIGHTS {
        return;
    }
    let (letter, height_letter) = (lead.letter, height.letter);
    let times = (lead_mm / height_mm).round();
    report.add(
        cx.finding(
            &META,
            cx.word_range(|word| word.letter == letter),
            format!("a lead of {} for a thread {} high", cx.shown(Mm(lead_mm)), cx.shown(Mm(height_mm))),
        )
        .label(format!("{times} times the height"))
        .also(cx.word_range(|word| word.letter == height_letter), "the height, from crest to root")
        .note("a thread of 60 degrees with one start is about 0.6 times as high as its lead is long")
        .help("check the point and the digits of both words"),
    );
}

fn height_for_lead(cx: &PathCx<'_>, height: &Word, lead: &Word, report: &mut Report<'_>) {
    let (Some(height_mm), Some(lead_mm)) = (length(cx, height), length(cx, lead)) else { return };
    // A computed number may count in least increments.
    let is_unsure = height.is_computed() || lead.is_computed();
    if is_unsure || height_mm < SHALLOW || lead_mm <= 0.0 || height_mm <= lead_mm * MOST_LEADS {
        return;
    }
    let (letter, lead_letter) = (height.letter, lead.letter);
    report.add(
        cx.finding(
            &META,
            cx.word_range(|word| word.letter == letter),
            format!("a thread {} high for a lead of {}", cx.shown(Mm(height_mm)), cx.shown(Mm(lead_mm))),
        )
        .label("the thread is higher than its lead")
        .also(cx.word_range(|word| word.letter == lead_letter), "the lead")
        .note("a thread of 60 degrees with one start is about 0.6 times as high as its lead is long")
        .help("check the point and the digits of both words"),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    /// A shaft turned to 29.8, then a thread M30 x 1.5.
    fn shaft(start: &str, cycle: &str) -> String {
        format!(
            "G21 G18 G99 T0101\nG97 S500 M3\nG0 X29.8 Z2.\nG1 Z-30. F0.2\nX40.\nG0 X150. Z100.\nT0404\n{start}\nG76 P020060 Q100 R0.05\n{cycle}\nG0 X150. Z100.\nM30\n"
        )
    }

    const CYCLE: &str = "G76 X28.16 Z-27. P920 Q300 F1.5";

    #[test]
    fn a_thread_that_is_higher_than_its_lead() {
        let program = |height: &str| {
            format!("G21 G18 G8 G97 S300 M3\nG0 X28 Z4\nG76 P1.5 Z-16 I-2 J0.3 R1.5 {height} Q29.5 H2\nM2\n")
                .replace("G8", "G7")
        };
        check_rule(
            &RULE,
            "linuxcnc",
            &program("K18.4"),
            &expect![[r#"
                3 | G76 P1.5 Z-16 I-2 J0.3 R1.5 K18.4 Q29.5 H2
                  |                             ^^^^^ warning[thread-numbers-contradict] a thread 9.2 mm high for a lead of 1.5 mm
            "#]],
        );
        check_rule(&RULE, "linuxcnc", &program("K1.84"), &expect![[""]]);
    }

    #[test]
    fn an_outside_thread_starts_outside() {
        check_rule(&RULE, "fanuc-lathe", &shaft("G0 X34. Z5.", CYCLE), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft("G0 X24. Z5.", CYCLE),
            &expect![[r#"
            10 | G76 X28.16 Z-27. P920 Q300 F1.5
               | ^^^ warning[thread-numbers-contradict] an outside thread that starts inside its root
        "#]],
        );
    }

    #[test]
    fn a_thread_in_a_bore_starts_inside() {
        let bored = shaft("G0 X24. Z5.", CYCLE)
            .replace("G0 X150. Z100.\nT", "G0 X26. Z2.\nG1 Z-30.\nX20.\nG0 Z100.\nT");
        check_rule(&RULE, "fanuc-lathe", &bored, &expect![[""]]);
        let drilled =
            shaft("G0 X24. Z5.", CYCLE).replace("G0 X150. Z100.\nT", "G0 X0. Z2.\nG1 Z-30.\nG0 Z100.\nT");
        check_rule(&RULE, "fanuc-lathe", &drilled, &expect![[""]]);
        let alone = "G21 G18 G99 T0404\nG97 S500 M3\nG0 X24. Z5.\nG76 P020060 Q100 R0.05\nG76 X28.16 Z-27. P920 Q300 F1.5\nM30\n";
        check_rule(&RULE, "fanuc-lathe", alone, &expect![[""]]);
    }

    #[test]
    fn the_first_cut_is_a_part_of_the_height() {
        let start = "G0 X34. Z5.";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft(start, "G76 X28.16 Z-27. P290 Q300 F1.5"),
            &expect![[r#"
            10 | G76 X28.16 Z-27. P290 Q300 F1.5
               |                       ^^^^ warning[thread-numbers-contradict] the first cut takes the whole thread at once
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &shaft(start, "G76 X28.16 Z-27. P920 Q#1 F1.5"), &expect![[""]]);
    }

    #[test]
    fn a_lead_of_many_heights() {
        let start = "G0 X34. Z5.";
        check_rule(
            &RULE,
            "fanuc-lathe",
            &shaft(start, "G76 X28.16 Z-27. P920 Q300 F15."),
            &expect![[r#"
            10 | G76 X28.16 Z-27. P920 Q300 F15.
               |                            ^^^^ warning[thread-numbers-contradict] a lead of 15 mm for a thread 0.92 mm high
        "#]],
        );
        check_rule(&RULE, "fanuc-lathe", &shaft(start, "G76 X28.16 Z-27. P920 Q300 F6."), &expect![[""]]);
        check_rule(
            &RULE,
            "linuxcnc",
            "G18 G21 G90 G7 G0 X22 Z4\nS600 M3\nG76 P15 Z-16 I-2 J0.3 R1.5 K0.92 Q29.5 H2\nG0 X60\nM2\n",
            &expect![[r#"
                3 | G76 P15 Z-16 I-2 J0.3 R1.5 K0.92 Q29.5 H2
                  |     ^^^ warning[thread-numbers-contradict] a lead of 15 mm for a thread 0.46 mm high
            "#]],
        );
    }
}
