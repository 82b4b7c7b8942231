//! A named parameter that is read before it is set.

use std::ops::Range;

use gcheck_engine::Fault;
use gcheck_program::{BlockFlags, Op, Place, StatementKind, Target};

use crate::declare::declare_rule;
use crate::{PathCx, PathRule, Report, Run, Severity, Watch};

declare_rule! {
    /// A named parameter (`#<name>`) is read on a path that does not set it.
    ///
    /// ## Why it matters
    /// The control stops: the name is not defined. Often the name is mistyped, or it is a local name of another
    /// subroutine.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// #<depth>=-3
    /// G1 Z#<dept> F100
    /// M2
    /// ```
    /// ```nc,reported,linuxcnc
    /// o<hole> sub
    /// G1 Z#<depth> F100
    /// o<hole> endsub
    /// #<depth>=-3
    /// o<hole> call
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// #<depth>=-3
    /// #<_clear>=5
    /// G1 Z#<depth> F100
    /// o1 if [EXISTS[#<_probe>]]
    /// G0 Z#<_clear>
    /// o1 endif
    /// M2
    /// ```
    rule "named-parameter-unset" in "macros" {
        summary: "named parameter read before it is set",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path { watch: Watch::FAULTS, make: || Box::new(NamedParameterUnset) },
    }
}

struct NamedParameterUnset;

impl PathRule for NamedParameterUnset {
    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::UnsetParameter {
            return;
        }
        let Some(place) = cx.place() else { return };
        let Some(file) = cx.program.file(0) else { return };
        let text = file.loaded.chunk_text(place.chunk);
        let names = names(&place, text);
        // Of several names, those that the file sets somewhere are unlikely to be the cause.
        let suspects: Vec<_> = match names.as_slice() {
            [only] => vec![only],
            several => several.iter().filter(|(name, _)| !is_set(cx, name)).collect(),
        };
        let finding = match suspects.as_slice() {
            // The control has a value for its own names.
            [(name, _)] if cx.control().named_parameter(name).is_some() => return,
            [(name, range)] => {
                let range = place.base + range.start..place.base + range.end;
                let finding = cx
                    .finding(&META, range, format!("named parameter `#<{name}>` is read before it is set"))
                    .label("no block on this path sets it")
                    .help(format!("set `#<{name}>` before this block, or correct the name"));
                if name.contains('[') && !name.contains(']') {
                    report.add(finding.help("close the bracket `[` of the name"));
                    return;
                }
                let is_local_elsewhere = !name.starts_with('_') && is_set(cx, name);
                if is_local_elsewhere {
                    finding.note("a name that does not begin with `_` belongs to one subroutine, or to the main program")
                } else if name.starts_with('_') {
                    finding
                        .at_most(Severity::Warning)
                        .assuming(format!("nothing outside this program sets `#<{name}>`"))
                } else {
                    finding
                }
            }
            _ => cx
                .finding(&META, cx.range(), "named parameter is read before it is set")
                .label("a name in this block has no value on this path")
                .help("set the parameter before this block, or correct its name")
                .at_most(Severity::Warning),
        };
        report.add(finding);
    }
}

/// Names that a block reads, with their bytes in the chunk.
fn names(place: &Place, text: &str) -> Vec<(String, Range<u32>)> {
    let mut names: Vec<(String, Range<u32>)> = Vec::new();
    for expr in place.expressions() {
        for op in place.table.ops(place.table.expr(expr)) {
            if let Op::Named { start, end } = op {
                let name = key(text, &(*start..*end));
                if !names.iter().any(|(known, _)| *known == name) {
                    names.push((name, *start..*end));
                }
            }
        }
    }
    names
}

/// Does the file set a name anywhere? A program may read thousands of names that nothing has set, so nothing is collected.
fn is_set(cx: &PathCx<'_>, name: &str) -> bool {
    let Some(file) = cx.program.file(0) else { return false };
    file.loaded.blocks_with(BlockFlags::STATEMENT, cx.environment.dialect).any(|(_, place)| {
        let text = file.loaded.chunk_text(place.chunk);
        place.table.statements(place.ix).any(|statement| match &statement.kind {
            StatementKind::Assign { target: Target::Named(range), .. } => {
                letters(text, range).eq(name.chars())
            }
            _ => false,
        })
    })
}

fn key(text: &str, range: &Range<u32>) -> String {
    letters(text, range).collect()
}

/// A name as the control compares it: without blanks, in small letters.
fn letters(text: &str, range: &Range<u32>) -> impl Iterator<Item = char> {
    let name = text.get(range.start as usize..range.end as usize).unwrap_or_default();
    name.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase)
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::check_rule;

    #[test]
    fn the_name_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X#<width>\nM2\n",
            &expect![[r#"
            1 | G0 X#<width>
              |       ^^^^^ error[named-parameter-unset] named parameter `#<width>` is read before it is set
        "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "#<a>=1\nG0 X[#<a>+#<b>]\nM2\n",
            &expect![[r#"
            2 | G0 X[#<a>+#<b>]
              |             ^ error[named-parameter-unset] named parameter `#<b>` is read before it is set
        "#]],
        );
    }

    #[test]
    fn a_global_may_be_set_before_the_program() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X#<_width>\nM2\n",
            &expect![[r#"
            1 | G0 X#<_width>
              |       ^^^^^^ warning[named-parameter-unset] named parameter `#<_width>` is read before it is set
        "#]],
        );
    }

    #[test]
    fn names_of_the_control_are_there() {
        check_rule(&RULE, "linuxcnc", "G0 X[#<_x>+1] Y#<_ini[axis_y]max> Z#<_task>\nM2\n", &expect![""]);
    }

    #[test]
    fn a_name_that_some_path_does_not_set_is_named_with_its_condition() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 if [#100 GT 0]\n#<a>=1\no1 endif\nG0 X#<a>\nM2\n",
            &expect![[r#"
            4 | G0 X#<a>
              |       ^ warning[named-parameter-unset] named parameter `#<a>` is read before it is set, when `#100` is not greater than 0
        "#]],
        );
    }
}
