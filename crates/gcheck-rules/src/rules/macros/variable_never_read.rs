//! A local variable that is set and never read.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use gcheck_controls::Ends;
use gcheck_program::{Op, StatementKind, Target};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run};

declare_rule! {
    /// A local variable gets a value, and nothing in the program reads it.
    ///
    /// ## Why it matters
    /// Either the value is not needed, or the block that should read it reads another variable: `#12` for `#21`.
    ///
    /// ## Reported
    /// ```nc,reported,fanuc-mill
    /// O1
    /// #1=10.
    /// #2=20.
    /// G0 X#1
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,fanuc-mill
    /// O1
    /// #1=10.
    /// #500=1.
    /// G0 X#1
    /// M30
    /// ```
    /// A call or a computed number may read any variable.
    /// ```nc,quiet,fanuc-mill
    /// O1
    /// #2=20.
    /// G0 X#[#1+1]
    /// M30
    /// ```
    rule "variable-never-read" in "macros" {
        summary: "local variable that is set and never read",
        severity: Hint,
        tier: Program,
        recommended: false,
        sets: [Strict],
        since: "0.1.0",
        run: Run::Program { check },
    }
}

/// A limit, because a file may consist of assignments only.
const MOST: usize = 1000;

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    // Subprograms share the variables of their callers.
    let shares =
        !cx.file_index.calls.is_empty() || cx.file_index.ends.iter().any(|end| end.ends == Ends::Subprogram);
    if shares || cx.file_index.assigned.is_empty() || !cx.file_index.o_words.is_empty() {
        return;
    }
    let [first, last] = cx.control().semantics().locals;
    let mut set: BTreeMap<u32, Range<u32>> = BTreeMap::new();
    let mut read: BTreeSet<u32> = BTreeSet::new();
    let mut is_open = false;
    cx.each_block(|block| {
        is_open |= block.codes().any(|(_, code)| code.is_user() || code.entry().any_words);
        for statement in block.statements() {
            if let StatementKind::Assign { target: Target::Variable(number), .. } = &statement.kind
                && (first..=last).contains(number)
                && set.len() < MOST
            {
                set.entry(*number).or_insert_with(|| block.in_file(statement.range.clone()));
            }
        }
        for expr in block.expressions() {
            for op in block.table().ops(expr) {
                match op {
                    Op::Variable(number) => drop(read.insert(*number)),
                    Op::Indirect => is_open = true,
                    _ => {}
                }
            }
        }
    });
    if is_open {
        return;
    }
    let mut unread: Vec<(u32, Range<u32>)> =
        set.into_iter().filter(|(number, _)| !read.contains(number)).collect();
    unread.sort_by_key(|(_, range)| range.start);
    for (number, range) in unread {
        report.add(
            Finding::new(&META, range, format!("`#{number}` is set and never read"))
                .label("nothing in the program reads it")
                .help("remove the assignment, or read the variable where its value is needed"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn arguments_of_calls_are_read_elsewhere() {
        check_rule(&RULE, "fanuc-mill", "O1\n#1=1\nG65 P9010 A1.\nM30\n", &expect![[""]]);
        check_rule(&RULE, "fanuc-mill", "O1\n#1=1\nM98 P2\nM30\n", &expect![[""]]);
    }

    #[test]
    fn one_that_counts_itself_is_read() {
        check_rule(&RULE, "haas-mill", "O1\n#1=1\n#1=#1+1\nM30\n", &expect![[""]]);
    }
}
