//! Figures above each tool section: time, extents.
//!
//! Knows: what of a run's statistics is above a section. Must not know: how figures are computed.

use std::ops::Range;

use gcheck_db::{Cancelled, Snapshot};
use gcheck_engine::{Axis, Fault, Machine, Model, Units};
use gcheck_geometry::Bounds;
use gcheck_toolpath::{Statistics, Timing, View};

use crate::caller::Caller;
use crate::number_text::{clock, coordinate, unit};
use crate::running::{LINEAR, Pictured, Ran, Shown, picture, view};
use crate::sections::{ToolSection, sections};

/// What one run of a document amounts to. It takes a while: whoever shows it keeps it, and shows it until the next is there.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunStatistics {
    /// Tool sections of this document in the order in which they began.
    pub sections: Vec<SectionStatistics>,
    /// Time of the whole run in seconds, called programs included.
    pub seconds: f64,
    /// The machine does more, in more time: something of the program is not in the figures.
    pub is_less: bool,
    /// Where the control would stop first, which way is not known, or how the run ended, in a few words.
    pub remark: Option<String>,
}

/// What one tool section amounts to.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionStatistics {
    /// Line of this document where it begins, from 0.
    pub line: u32,
    /// The tool; `None` unknown.
    pub tool: Option<u32>,
    /// Time in seconds.
    pub seconds: f64,
    /// Where cutting moves went, as text; empty when nothing was cut.
    pub extents: String,
}

/// The kinds of lenses: their names, and what they tell.
pub const LENSES: [(&str, &str); 2] = [
    ("program", "time of the whole program, tools, where the control would stop"),
    ("tool", "tool, time and extents of a tool section"),
];

/// A line above a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CodeLens {
    /// Bytes of the line that it is above.
    pub range: Range<u32>,
    /// Its text.
    pub title: String,
}

/// Runs the document for its figures, at most so many blocks; a macro with the arguments of a caller.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn run_statistics(
    snapshot: &Snapshot,
    caller: Option<&Caller>,
    fuel: u64,
    stop: &dyn Fn() -> bool,
) -> Result<RunStatistics, Cancelled> {
    let model = Model::new(snapshot.control());
    let view = view(snapshot, &model);
    let begin = |machine: &Machine| {
        let timing = Timing::of_machine(&model, machine);
        (Statistics::new(view, timing, model.work_at_power_on()), Passed::default())
    };
    let Pictured { shown: (statistics, passed), ran: Ran { stopped, .. }, .. } =
        picture(snapshot, caller, fuel, stop, begin, |(statistics, passed), shown| match shown {
            Shown::Event(seen) => statistics.add(seen),
            Shown::Alarm { file, line, fault, .. } => passed.alarm(file, *line, fault),
            Shown::Assumed { assumption, .. } => passed.is_less |= assumption.leaves_moves_out(),
        })?;
    let units = statistics.units();
    let total = statistics.total();
    let unaccounted = total.unaccounted;
    // Sections that began in a called program belong to lines of other files.
    let own = statistics.sections().iter().filter(|section| section.file.is_empty() && section.line > 0);
    Ok(RunStatistics {
        sections: own
            .map(|section| SectionStatistics {
                line: section.line - 1,
                tool: section.tool,
                seconds: section.times.total().0,
                extents: extents(&section.tip, view, units),
            })
            .collect(),
        seconds: total.times.total().0,
        is_less: passed.is_less || stopped.is_some() || unaccounted.feeds + unaccounted.speeds > 0,
        remark: passed.first.or(stopped),
    })
}

/// What a run went past.
#[derive(Debug, Default)]
struct Passed {
    /// The first alarm or decision, in a few words.
    first: Option<String>,
    /// Not all that the machine does is in the figures.
    is_less: bool,
}

impl Passed {
    fn alarm(&mut self, file: &str, line: u32, fault: &Fault) {
        self.is_less = true;
        let place = if file.is_empty() { format!("line {line}") } else { format!("{file}, line {line}") };
        self.first.get_or_insert_with(|| match fault {
            Fault::Undecidable => format!("which way {place} goes is not known"),
            _ => format!("the control would stop in {place}"),
        });
    }
}

/// `X 0 to 50, Z -5 to 2 mm`.
fn extents(bounds: &Bounds, view: View, units: Units) -> String {
    let shown = |axis: Axis, value: f64| coordinate(axis, value, units, view.has_diameters());
    let axes = LINEAR.into_iter().filter(|axis| view.shows(*axis));
    let texts: Vec<String> = axes
        .filter_map(|axis| {
            let (low, high) = bounds.range(axis.index())?;
            let (low, high) = (shown(axis, low), shown(axis, high));
            Some(if low == high {
                format!("{} {low}", axis.name())
            } else {
                format!("{} {low} to {high}", axis.name())
            })
        })
        .collect();
    if texts.is_empty() { String::new() } else { format!("{} {}", texts.join(", "), unit(units)) }
}

/// The lenses of a document whose run gave these figures: one above the first block, one above each tool section. A section
/// that has moved since the run is found again by its tool.
pub fn code_lenses(snapshot: &Snapshot, statistics: &RunStatistics) -> Vec<CodeLens> {
    let mut lenses = Vec::new();
    let Some(first) = snapshot.file_index().first_block.clone() else { return lenses };
    let line = |offset: u32| snapshot.line_range(snapshot.line_at(offset));
    let tools = statistics.sections.iter().filter(|section| section.tool.is_some()).count();
    let least = if statistics.is_less { "at least " } else { "" };
    let mut title = format!("{least}{} in all", clock(statistics.seconds));
    if tools > 1 {
        title = format!("{title}, {tools} tool sections");
    }
    if let Some(remark) = &statistics.remark {
        title = format!("{title} ({remark})");
    }
    lenses.push(CodeLens { range: line(first.start), title });
    // A section is run again in a loop or by a call: its turns count together.
    let mut left: Vec<&SectionStatistics> = statistics.sections.iter().collect();
    for part in sections(snapshot).tools {
        let at = snapshot.line_at(part.change.start);
        let nearest = left
            .iter()
            .filter(|section| section.tool == part.tool)
            .min_by_key(|section| section.line.abs_diff(at))
            .map(|section| section.line);
        let Some(nearest) = nearest else { continue };
        let (own, rest): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|section| section.tool == part.tool && section.line == nearest);
        left = rest;
        lenses.extend(lens(&part, &own, line(part.change.start)));
    }
    lenses
}

fn lens(part: &ToolSection, turns: &[&SectionStatistics], range: Range<u32>) -> Option<CodeLens> {
    let first = turns.first()?;
    let seconds: f64 = turns.iter().map(|section| section.seconds).sum();
    let mut title = match part.tool {
        Some(tool) => format!("T{tool}"),
        None => "tool".to_owned(),
    };
    for text in [part.name.as_str(), &clock(seconds), &first.extents] {
        if !text.is_empty() {
            title = format!("{title} · {text}");
        }
    }
    if turns.len() > 1 {
        title = format!("{title} · {} times", turns.len());
    }
    Some(CodeLens { range, title })
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::{code_lenses, run_statistics};
    use crate::fixture::{Fixture, shown};

    fn check(control: &str, text: &str, expected: &Expect) {
        let snapshot = Fixture::new(control, text).snapshot();
        let lenses =
            code_lenses(&snapshot, &run_statistics(&snapshot, None, 100_000, &|| false).unwrap()).into_iter();
        let lines = lenses.map(|lens| format!("{}\n  {}\n", shown(&snapshot, &lens.range), lens.title));
        expected.assert_eq(&lines.collect::<String>());
    }

    #[test]
    fn time_and_extents_of_each_tool() {
        let text = "%\nO1\nG21 G90 G54\nT1 M6 (END MILL)\nS1000 M3\nG0 X0. Y0.\nZ2.\nG1 Z-1. F100.\nX50.\nG0 Z50.\nT2 M6\nG0 X10. Y5.\nM30\n%\n";
        check(
            "haas-mill",
            text,
            &expect![[r#"
            2: O1
              0:42 in all, 2 tool sections
            4: T1 M6 (END MILL)
              T1 · END MILL · 0:37 · X 0 to 50, Y 0, Z -1 to 2 mm
            11: T2 M6
              T2 · 0:05
        "#]],
        );
    }

    #[test]
    fn a_lathe_in_diameters_and_a_run_that_stops() {
        check(
            "haas-lathe",
            "O1\nG20 G54 T0101 (ROUGH)\nG97 S500 M3\nG0 X2. Z.1\nG1 Z-1. F.01\nG1 X1. Q\n",
            &expect![[r#"
                1: O1
                  at least 0:24 in all (the control would stop in line 6)
                2: G20 G54 T0101 (ROUGH)
                  T1 · ROUGH · 0:24 · X 1 to 2, Z -1 to 0.1 inch
            "#]],
        );
    }

    #[test]
    fn what_is_not_in_the_figures_makes_them_the_least() {
        let text = "O1\nG21 G90 G54 G0 X0. Y0. Z2.\nG1 Z-1. F100.\nIF [#101 GT 1] GOTO 9\nX50.\nN9 G65 P4711\nX90.\nM30\n";
        let snapshot = Fixture::new("fanuc-mill", text).snapshot();
        let figures = run_statistics(&snapshot, None, 100_000, &|| false).unwrap();
        let lenses = code_lenses(&snapshot, &figures);
        assert_eq!(lenses[0].title, "at least 0:56 in all (which way line 4 goes is not known)");
        let path = crate::toolpath(&snapshot, None, 100_000, crate::MAX_SEGMENTS, &|| false).unwrap();
        assert!((path.seconds - figures.seconds).abs() < 1e-9, "the panel says {}", path.seconds);
    }

    #[test]
    fn a_tool_that_tilts_cuts_where_the_picture_shows_its_tip() {
        let text = "O1\nG20 G90 G54 T1 M6\nG0 X1. Y0. Z3. A0. B0.\nG143 H1 X1. Y0. Z3. A-15. B8.\nG1 X1.25 Z2. F20.\nX1.5\nM30\n";
        let snapshot = Fixture::new("haas-mill", text).snapshot();
        let figures = run_statistics(&snapshot, None, 100_000, &|| false).unwrap();
        assert_eq!(figures.sections[0].extents, "X 1.25 to 1.5, Y 0, Z 2 inch");
    }

    #[test]
    fn what_a_tool_cuts_before_it_tilts_and_after_is_in_its_extents() {
        let text = "O1\nG20 G90 G54 T1 M6\nG0 X0. Y0. Z3. A0. B0.\nG1 X-9. Z1. F20.\nG143 H1 X1. Y0. Z3. A-15. B8.\nG1 X1.25 Z2. F20.\nG49\nG0 Z5. A0. B0.\nG1 X5. Z4.5\nM30\n";
        let snapshot = Fixture::new("haas-mill", text).snapshot();
        let figures = run_statistics(&snapshot, None, 100_000, &|| false).unwrap();
        assert_eq!(figures.sections[0].extents, "X -9 to 5, Y 0, Z 1 to 5 inch");
    }

    #[test]
    fn a_loop_without_an_end_is_run_for_a_moment() {
        let text = "O1\nG21 G90 G54 G0 X0. Y0. Z2.\nWHILE [1 EQ 1] DO1\nG91 G1 X1. F100.\nEND1\nM30\n";
        let snapshot = Fixture::new("haas-mill", text).snapshot();
        let figures = run_statistics(&snapshot, None, u64::MAX, &|| false).unwrap();
        assert_eq!(figures.remark.as_deref(), Some("ended after 3000000 blocks"));
    }

    #[test]
    fn no_figures_without_blocks() {
        check("haas-mill", "", &expect![[""]]);
    }
}
