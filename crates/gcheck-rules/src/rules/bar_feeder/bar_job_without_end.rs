//! A bar job that repeats until no bar is left.

use gcheck_controls::{Effect, Ends};
use gcheck_engine::{At, Ending, Event};

use crate::declare::declare_rule;
use crate::facts::bar_feed::{bar_feeder, lengths};
use crate::{PathCx, PathRule, Report, Run, Watch};
use crate::{Remembers, remembers};

declare_rule! {
    /// A bar job starts again (`M99`) as long as there is bar: no limit of the feeder and no end of program stops it.
    ///
    /// Many post-processors write bar jobs like this, so it is an *info*.
    ///
    /// ## Why it matters
    /// The machine makes parts until the magazine is empty. To stop earlier, the job needs a limit, or a block with
    /// block delete (`/M30`) before the return.
    ///
    /// ## Reported
    /// ```nc,reported,haas-lathe
    /// G1 X0. F0.004
    /// M5
    /// G105 J1.75
    /// M99
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-lathe
    /// G1 X0. F0.004
    /// M5
    /// G105 J1.75
    /// /M30
    /// M99
    /// ```
    /// ```nc,quiet,haas-lathe
    /// #3103=50 (PARTS)
    /// G1 X0. F0.004
    /// M5
    /// G105 J1.75
    /// M99
    /// ```
    rule "bar-job-without-end" in "bar_feeder" {
        summary: "bar job that repeats until no bar is left",
        severity: Info,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::CHANGES.union(Watch::ENDS).union(Watch::ENDLESS),
            make: || Box::new(BarJobWithoutEnd { feeds: false }),
        },
    }
}

#[derive(Clone, PartialEq)]
struct BarJobWithoutEnd {
    feeds: bool,
}

remembers!(BarJobWithoutEnd);

impl PathRule for BarJobWithoutEnd {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn changed(&mut self, _: &PathCx<'_>, event: &Event, _: &mut Report<'_>) {
        self.feeds |= lengths(event).is_some();
    }

    fn ended(&mut self, cx: &PathCx<'_>, ending: Ending, report: &mut Report<'_>) {
        if ending == Ending::Restart && self.feeds {
            check(cx, Effect::Return, report);
        }
    }

    fn endless(&mut self, cx: &PathCx<'_>, head: At, report: &mut Report<'_>) {
        let turn = cx.origin().at;
        let feeds = |block: u32| {
            cx.find_word(At { file: head.file, block }, |word| cx.model.effect(word.code) == Effect::BarFeed)
                .is_some()
        };
        if self.feeds && (head.block..=turn.block).take(20_000).any(feeds) {
            check(cx, Effect::None, report);
        }
    }
}

/// `back` is the effect of the word that leads back to the start, if a code does.
fn check(cx: &PathCx<'_>, back: Effect, report: &mut Report<'_>) {
    let Some(rules) = bar_feeder(cx) else { return };
    let limits = [rules.most_parts, rules.most_bars, rules.most_length];
    // Zero is not a limit; an unknown limit is taken as one.
    let is_limited = limits
        .iter()
        .any(|limit| cx.state().variables().is_written(*limit) && cx.known_variable(*limit) != Some(0.0));
    let has_end = cx.file_index.ends.iter().any(|end| end.ends == Ends::Program);
    if is_limited || has_end {
        return;
    }
    let range = cx.word_range(|word| word.code.is_some() && cx.model.effect(word.code) == back);
    report.add(
        cx.finding(&META, range, "bar job repeats until no bar is left")
            .label("starts the next part, however many were made")
            .assuming(format!(
                "the feeder's limits (`#{}`, `#{}`) are not set on its page",
                limits[0], limits[1]
            ))
            .help(format!(
                "set the number of parts (`#{}`), or put a `/M30` before this block to end the job",
                limits[0]
            )),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn a_loop_inside_the_program() {
        check_rule(
            &RULE,
            "haas-lathe",
            "N1 G1 X0. F0.004\nG0 X3.\nM5\nG105 J1.75\nGOTO 1\n",
            &expect![[r#"
                5 | GOTO 1
                  | ^^^^^^ info[bar-job-without-end] bar job repeats until no bar is left
            "#]],
        );
    }

    #[test]
    fn a_limit_that_is_not_known_is_one_and_zero_is_none() {
        check_rule(&RULE, "haas-lathe", "#3103=#500\nM5\nG105 J1.75\nM99\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            "#3103=0\nM5\nG105 J1.75\nM99\n",
            &expect![[r#"
            4 | M99
              | ^^^ info[bar-job-without-end] bar job repeats until no bar is left
        "#]],
        );
    }

    #[test]
    fn a_program_that_ends_or_feeds_no_bar() {
        check_rule(&RULE, "haas-lathe", "M5\nG105 J1.75\nM30\n", &expect![[""]]);
        check_rule(&RULE, "haas-lathe", "G0 X1.\nM99\n", &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            "M5\nIF [#500 EQ 1] GOTO 9\nG105 J1.75\nM99\nN9 M30\n",
            &expect![[""]],
        );
    }
}
