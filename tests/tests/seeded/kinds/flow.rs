//! Mistakes with programs, jumps, calls and loops.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;
use gcheck_program::{OKeyword, StatementKind};

use crate::kind::{Edit, Fear, Kind, Seed};
use crate::program::{Block, Program, Word};

const ENDS: [Effect; 2] = [Effect::ProgramEnd, Effect::ProgramEndWithPallet];
const CALLS: [Effect; 2] = [Effect::CallProgram, Effect::MacroCall];

/// Statements that are of a kind.
fn statements(
    p: &Program,
    seed: impl Fn(&Block, &std::ops::Range<usize>, &StatementKind) -> Option<Edit>,
) -> Vec<Seed> {
    let all = p.blocks.iter().flat_map(|block| block.statements.iter().map(move |s| (block, s)));
    all.filter_map(|(block, (range, kind))| seed(block, range, kind).map(Into::into)).collect()
}

/// The keyword of an O-word.
fn keyword(kind: &StatementKind) -> Option<OKeyword> {
    match kind {
        StatementKind::OWord { keyword, .. } => Some(*keyword),
        _ => None,
    }
}

/// A sequence number that a jump of the text names.
fn target<'b>(p: &Program, block: &'b Block) -> Option<&'b Word> {
    let label = block.word(b'N')?;
    let number = label.number?;
    let named = p.blocks.iter().any(|other| {
        other.statements.iter().any(|(range, kind)| {
            matches!(kind, StatementKind::Goto { .. })
                && p.text[range.clone()].trim_end().ends_with(&format!("{number}"))
        })
    });
    named.then_some(label)
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "end-forgotten",
        Fear::Alarm,
        "the program has no end (`M30`)",
        &["program-end-missing", "fall-into-subprogram"],
        |p| {
            let ends: Vec<&Block> = p.blocks.iter().filter(|block| block.code(&ENDS).is_some()).collect();
            match ends[..] {
                [end] if !end.is_skippable => vec![p.without_line(end).into()],
                _ => Vec::new(),
            }
        },
    )
    .anywhere(),
    Kind::new(
        "end-for-return",
        Fear::Crash,
        "a subprogram ends the job (`M30` for `M99`)",
        &["subprogram-without-return", "unreachable-block"],
        |p| {
            p.each(|block| {
                // A main program that `/M30` ends goes on after it.
                let mut before = p.blocks[..block.ix].iter();
                let is_behind = before.any(|other| !other.is_skippable && other.code(&ENDS).is_some());
                let word = block.code(&[Effect::Return]).filter(|_| is_behind)?;
                (block.words.len() == 1 && !block.is_skippable).then(|| p.instead(word, "M30"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "end-too-early",
        Fear::Trap,
        "an `M30` from a trial is left in the middle",
        &["unreachable-block"],
        |p| {
            p.each(|block| {
                let fits = block.code(&[Effect::ToolChange]).is_some()
                    && block.before.section > 0
                    && !block.before.is_subprogram;
                fits.then(|| p.line_above(block, "M30"))
            })
        },
    ),
    Kind::new(
        "number-of-another-program",
        Fear::Alarm,
        "two programs of a file have the same number",
        &["program-number-duplicate"],
        |p| {
            let numbers: Vec<&Word> = p.blocks.iter().filter_map(|block| block.word(b'O')).collect();
            match numbers[..] {
                [first, second, ..] => vec![p.instead(second, p.words_of(first)).into()],
                _ => Vec::new(),
            }
        },
    )
    .anywhere(),
    Kind::new(
        "program-number-lost",
        Fear::Alarm,
        "the program has no number",
        &["program-number-missing"],
        |p| {
            p.each(|block| {
                let word =
                    block.word(b'O').filter(|_| p.is_for(&["fanuc", "haas"]) && block.words.len() == 1)?;
                let first = p.blocks[..block.ix].iter().all(|before| before.words.is_empty());
                first.then(|| p.without(word))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "jump-to-nowhere",
        Fear::Alarm,
        "the sequence number that a jump looks for was renumbered",
        &["jump-target-missing"],
        |p| {
            p.each(|block| {
                target(p, block).map(|word| p.value(word, format!("{}", word.number.unwrap() + 7.0)))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "jump-target-twice",
        Fear::Crash,
        "the sequence number of a jump exists twice",
        &["ambiguous-jump-target"],
        |p| {
            p.each(|block| {
                let word = target(p, block)?;
                let next = p
                    .behind(block)
                    .iter()
                    .find(|next| next.is_plain() && !next.has(b"NO") && next.words.len() > 1)?;
                Some(Edit {
                    range: next.range.start..next.range.start,
                    text: format!("{} ", p.words_of(word)),
                })
            })
        },
    )
    .anywhere(),
    Kind::new(
        "subprogram-mistyped",
        Fear::Alarm,
        "the number of a called program is mistyped",
        &["subprogram-missing"],
        |p| {
            p.each(|block| {
                block.code(&CALLS)?;
                let word = block.word(b'P').filter(|word| word.number.is_some())?;
                Some(p.value(word, format!("{}7", &p.words_of(word)[1..])))
            })
        },
    ),
    Kind::new(
        "subprogram-in-the-file-mistyped",
        Fear::Alarm,
        "the block that `M97` calls is mistyped",
        &["jump-target-missing", "subprogram-missing"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::CallLocal])?;
                let word = block.word(b'P').filter(|word| word.number.is_some())?;
                Some(p.value(word, format!("{}7", &p.words_of(word)[1..])))
            })
        },
    ),
    Kind::new(
        "return-forgotten",
        Fear::Crash,
        "a subprogram does not return (no `M99`)",
        &["subprogram-without-return", "program-end-missing", "fall-into-subprogram"],
        |p| {
            // Where each subprogram of the file has one return.
            let called = p.blocks.iter().any(|block| block.code(&CALLS).is_some());
            p.each(|block| {
                let fits = called
                    && block.before.is_subprogram
                    && block.code(&[Effect::Return]).is_some()
                    && block.words.len() == 1;
                fits.then(|| p.without_line(block))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "main-runs-into-subprogram",
        Fear::Crash,
        "the main program has no end and runs into the subprogram after it",
        &["fall-into-subprogram", "program-end-missing", "return-outside-subroutine"],
        |p| {
            p.each(|block| {
                block.code(&ENDS).filter(|_| {
                    !block.before.is_subprogram && block.words.len() == 1 && !block.is_skippable
                })?;
                let behind = p.behind(block).iter().any(|next| next.code(&[Effect::Return]).is_some());
                behind.then(|| p.without_line(block))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "calls-itself",
        Fear::Alarm,
        "a subprogram calls itself",
        &["calls-nested-too-deep", "endless-loop"],
        |p| {
            p.each(|block| {
                let number = block
                    .word(b'O')
                    .filter(|_| block.before.is_subprogram && p.is_for(&["fanuc", "haas"]))?;
                let called = p.blocks.iter().any(|b| {
                    b.code(&CALLS).is_some() && b.word(b'P').is_some_and(|w| w.number == number.number)
                });
                let next = p.next(block)?;
                called.then(|| p.line_above(next, format!("M98 P{}", &p.words_of(number)[1..])))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "loop-end-forgotten",
        Fear::Alarm,
        "a loop has no end",
        &["loop-end-missing", "o-word-unmatched"],
        |p| {
            statements(p, |block, _, kind| {
                let ends =
                    matches!(kind, StatementKind::End { .. }) || keyword(kind) == Some(OKeyword::EndWhile);
                ends.then(|| p.without_line(block))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "loop-begin-forgotten",
        Fear::Alarm,
        "the start of a loop is lost",
        &["loop-begin-missing", "o-word-unmatched"],
        |p| {
            statements(p, |block, _, kind| {
                let begins =
                    matches!(kind, StatementKind::Do { .. }) || keyword(kind) == Some(OKeyword::While);
                begins.then(|| p.without_line(block))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "loop-numbers-differ",
        Fear::Alarm,
        "the numbers of `DO` and `END` differ",
        &["loop-end-missing", "loop-begin-missing", "crossed-loops", "o-word-unmatched"],
        |p| {
            statements(p, |_, range, kind| {
                let text = &p.text[range.clone()];
                let ends = matches!(kind, StatementKind::End { .. }) && text.ends_with('1');
                ends.then(|| Edit { range: range.end - 1..range.end, text: "2".to_owned() })
            })
        },
    )
    .anywhere(),
    Kind::new(
        "loop-never-ends",
        Fear::Crash,
        "the counter of a loop is not counted",
        &["loop-condition-unchanged", "endless-loop"],
        |p| {
            statements(p, |block, range, kind| {
                let StatementKind::Assign { .. } = kind else { return None };
                let text: String = p.text[range.clone()].split_whitespace().collect();
                let (name, value) = text.split_once('=')?;
                let counts = value.trim_start_matches('[').starts_with(&format!("{name}+"));
                let rest = p.behind(block);
                let in_loop = rest.iter().take(3).any(|next| {
                    next.statements.iter().any(|(_, kind)| {
                        matches!(kind, StatementKind::End { .. }) || keyword(kind) == Some(OKeyword::EndWhile)
                    })
                });
                (counts && in_loop && block.words.is_empty()).then(|| p.without_line(block))
            })
        },
    )
    .anywhere(),
    Kind::new("jump-into-loop", Fear::Alarm, "a jump leads into a loop", &["jump-into-loop"], |p| {
        p.each(|block| {
            let begins = block.statements.iter().any(|(_, kind)| matches!(kind, StatementKind::Do { .. }));
            let inside = p.next(block).filter(|next| begins && !next.has(b"N"))?;
            Some(vec![
                p.line_above(block, "IF [#519 EQ 1.] GOTO7777"),
                Edit { range: inside.range.start..inside.range.start, text: "N7777 ".to_owned() },
            ])
        })
    })
    .anywhere(),
    Kind::new(
        "subroutine-mistyped",
        Fear::Alarm,
        "the name of a called subroutine is mistyped",
        &["o-word-subroutine-missing"],
        |p| {
            statements(p, |_, range, kind| {
                let text = &p.text[range.clone()];
                let named = text.find('<').filter(|_| keyword(kind) == Some(OKeyword::Call))?;
                Some(Edit {
                    range: range.start + named + 1..range.start + named + 1,
                    text: "the_".to_owned(),
                })
            })
        },
    ),
    Kind::new(
        "subroutine-end-forgotten",
        Fear::Alarm,
        "a subroutine has no `endsub`",
        &["o-word-unmatched"],
        |p| {
            statements(p, |block, _, kind| {
                (keyword(kind) == Some(OKeyword::EndSub)).then(|| p.without_line(block))
            })
        },
    )
    .anywhere(),
    Kind::new("branch-end-forgotten", Fear::Alarm, "an `if` has no `endif`", &["o-word-unmatched"], |p| {
        statements(p, |block, _, kind| {
            (keyword(kind) == Some(OKeyword::EndIf)).then(|| p.without_line(block))
        })
    })
    .anywhere(),
    Kind::new(
        "jump-without-number",
        Fear::Alarm,
        "`GOTO` without its number",
        &["statement-number-missing"],
        |p| {
            statements(p, |_, range, kind| {
                let StatementKind::Goto { .. } = kind else { return None };
                let text = &p.text[range.clone()];
                let digits = text.len() - text.trim_end_matches(|c: char| c.is_ascii_digit()).len();
                (digits > 0).then(|| Edit { range: range.end - digits..range.end, text: String::new() })
            })
        },
    ),
];
