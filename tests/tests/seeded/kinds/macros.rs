//! Mistakes with variables and expressions.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;
use gcheck_program::{StatementKind, Target};

use crate::kind::{Edit, Fear, Kind, Seed};
use crate::program::{Block, Program};

/// Assignments that stand alone in their block, with the bytes of the statement.
fn assignments(
    p: &Program,
    seed: impl Fn(&Block, &std::ops::Range<usize>, &str) -> Option<Vec<Edit>>,
) -> Vec<Seed> {
    p.each(|block| match &block.statements[..] {
        [(range, StatementKind::Assign { target, .. })]
            if block.words.is_empty() && !matches!(target, Target::Invalid) =>
        {
            seed(block, range, &p.text[range.clone()])
        }
        _ => None,
    })
}

/// A place inside a block's text is written so.
fn rewrite(p: &Program, from: &str, to: &str, condition: bool) -> Vec<Seed> {
    p.each(|block| {
        let is_condition = block.statements.iter().any(|(_, kind)| {
            matches!(kind, StatementKind::If { .. } | StatementKind::Do { .. })
                || matches!(kind, StatementKind::OWord { .. })
        });
        if condition && !is_condition {
            return None;
        }
        let end = block.end_of_words();
        let at = p.text[block.range.start..end].find(from)? + block.range.start;
        Some(Edit { range: at..at + from.len(), text: to.to_owned() })
    })
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "variable-never-set",
        Fear::Crash,
        "the line that sets a variable is lost",
        &[
            "variable-read-before-set",
            "maybe-variable-unset",
            "common-variable-never-set",
            "named-parameter-unset",
            "loop-condition-unchanged",
            "feed-missing",
        ],
        |p| {
            assignments(p, |block, _, text| {
                let name = text.split('=').next()?.trim();
                // Kept between programs, or set by a caller: not the program's to set.
                let number = name.strip_prefix('#').and_then(|n| n.parse::<u32>().ok());
                let own = number.is_none_or(|n| (100..200).contains(&n)) && !name.contains("<_");
                let sole = p.text.matches(name).count() > 1
                    && !p.blocks[..block.ix].iter().any(|b| p.text_of(b).contains(name));
                let literal = text.split('=').nth(1)?.trim().parse::<f64>().is_ok();
                (own && sole && literal && !block.before.is_subprogram).then(|| vec![p.without_line(block)])
            })
        },
    )
    .anywhere(),
    Kind::new(
        "variable-mistyped",
        Fear::Crash,
        "the number of a variable is mistyped where it is read",
        &[
            "variable-read-before-set",
            "maybe-variable-unset",
            "common-variable-never-set",
            "variable-unlisted",
        ],
        |p| {
            if p.is_for(&["linuxcnc"]) {
                return Vec::new();
            }
            p.each(|block| {
                // A word with nothing but the variable: `X#101`.
                let word = block.words.iter().find(|word| {
                    let digits = p.words_of(word).get(2..).unwrap_or_default();
                    p.words_of(word).get(1..2) == Some("#")
                        && digits.len() <= 3
                        && digits.parse::<u32>().is_ok_and(|number| number < 200)
                })?;
                let number: u32 = p.words_of(word)[2..].parse().ok()?;
                let other = if number < 34 { 33 - number } else { 299 - number };
                let is_free = other > 0 && !p.text.contains(&format!("#{other}"));
                (is_free && !block.before.is_subprogram).then(|| p.value(word, format!("#{other}")))
            })
        },
    ),
    Kind::new(
        "macro-call-without-program",
        Fear::Alarm,
        "a macro is called without its number (`G65` without `P`)",
        &["required-word-missing", "word-choice-missing", "lasting-word-never-given"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::MacroCall])?;
                Some(p.without(block.word(b'P')?))
            })
        },
    ),
    Kind::new(
        "equals-lost",
        Fear::Alarm,
        "the `=` of an assignment is lost",
        &["assignment-without-equals"],
        |p| {
            assignments(p, |_, range, text| {
                let at = range.start + text.find('=')?;
                Some(vec![Edit { range: at..at + 1, text: " ".to_owned() }])
            })
        },
    ),
    Kind::new(
        "bracket-not-closed",
        Fear::Alarm,
        "a bracket is not closed",
        &["unclosed-bracket", "named-parameter-unset"],
        |p| {
            p.each(|block| {
                let end = block.end_of_words();
                let at = p.text[block.range.start..end].rfind(']')? + block.range.start;
                Some(Edit { range: at..at + 1, text: String::new() })
            })
        },
    ),
    Kind::new(
        "parentheses-for-brackets",
        Fear::Alarm,
        "parentheses are written instead of the brackets of an expression",
        &[
            "missing-operand",
            "unclosed-bracket",
            "stray-bracket",
            "address-without-value",
            "assignment-without-equals",
            "condition-missing",
            "expression-needs-brackets",
            "function-unknown",
            "unexpected-text",
            "nested-comment",
        ],
        |p| {
            p.each(|block| {
                let plain =
                    !block.statements.iter().any(|(_, kind)| matches!(kind, StatementKind::OWord { .. }));
                plain.then_some(())?;
                let words = &p.text[block.range.start..block.end_of_words()];
                let (open, close) = (words.find('[')?, words.rfind(']')?);
                // The brackets of `#<_hal[pin]>` belong to a name.
                if words[..open].rfind('<') > words[..open].rfind('>') {
                    return None;
                }
                let one = words.matches('[').count() == 1 && words.matches(']').count() == 1 && open < close;
                let at = |place: usize, text: &str| Edit {
                    range: block.range.start + place..block.range.start + place + 1,
                    text: text.to_owned(),
                };
                one.then(|| vec![at(open, "("), at(close, ")")])
            })
        },
    ),
    Kind::new(
        "condition-with-equals",
        Fear::Alarm,
        "`=` or `==` is written for `EQ` in a condition",
        &[
            "unexpected-text",
            "stray-bracket",
            "unclosed-bracket",
            "missing-operand",
            "condition-missing",
            "assignment-without-equals",
        ],
        |p| rewrite(p, " EQ ", " = ", true),
    ),
    Kind::new(
        "condition-with-sign",
        Fear::Alarm,
        "`<` is written for `LT` in a condition",
        &[
            "unexpected-text",
            "stray-bracket",
            "unclosed-bracket",
            "missing-operand",
            "condition-missing",
            "assignment-without-equals",
        ],
        |p| rewrite(p, " LT ", " < ", true),
    ),
    Kind::new(
        "operator-mistyped",
        Fear::Alarm,
        "an operator is mistyped (`LTE` for `LE`)",
        &[
            "unexpected-text",
            "stray-bracket",
            "unclosed-bracket",
            "missing-operand",
            "condition-missing",
            "stray-keyword",
            "address-without-value",
            "function-unknown",
        ],
        |p| rewrite(p, " LT ", " LTE ", true),
    ),
    Kind::new("do-forgotten", Fear::Alarm, "`WHILE` without `DO`", &["while-without-do"], |p| {
        rewrite(p, " DO1", "", true)
    }),
    Kind::new(
        "function-mistyped",
        Fear::Alarm,
        "the name of a function is mistyped (`COZ`)",
        &[
            "function-unknown",
            "unexpected-text",
            "missing-operand",
            "address-without-value",
            "unknown-address",
            "unclosed-bracket",
            "letter-o-for-zero",
            "stray-bracket",
        ],
        |p| rewrite(p, "COS[", "COZ[", false),
    ),
    Kind::new(
        "read-only-variable",
        Fear::Alarm,
        "a system variable that can only be read is written to",
        &["assignment-to-read-only-variable", "computed-variable-read-only"],
        |p| {
            assignments(p, |_, range, text| {
                let name = text.split('=').next()?.trim_end();
                let number = if p.is_for(&["linuxcnc"]) { "#5420" } else { "#5041" };
                let fits = !name.contains('[');
                fits.then(|| {
                    vec![Edit { range: range.start..range.start + name.len(), text: number.to_owned() }]
                })
            })
        },
    ),
    Kind::new(
        "variable-that-is-not-there",
        Fear::Alarm,
        "the number of a variable has digits too many",
        &["variable-unlisted", "number-out-of-range", "variable-number-not-whole"],
        |p| {
            assignments(p, |_, range, text| {
                let name = text.split('=').next()?.trim_end();
                let number: u32 = name.strip_prefix('#')?.parse().ok()?;
                let fits = (100..200).contains(&number) && !p.is_for(&["fanuc"]);
                fits.then(|| {
                    vec![Edit {
                        range: range.start..range.start + name.len(),
                        text: format!("#{number}9999"),
                    }]
                })
            })
        },
    ),
    Kind::new(
        "division-by-zero",
        Fear::Alarm,
        "a value is divided by zero",
        &["expression-without-value", "computed-value-out-of-range"],
        |p| {
            assignments(p, |block, range, text| {
                let value = text.find('=')? + range.start + 1;
                let zero = format!("[{}/[5.-5.]]", p.text[value..range.end].trim());
                (!block.before.is_subprogram).then(|| vec![Edit { range: value..range.end, text: zero }])
            })
        },
    )
    .anywhere(),
    Kind::new(
        "root-of-a-negative",
        Fear::Alarm,
        "the root of a negative number is taken",
        &["expression-without-value", "computed-value-out-of-range"],
        |p| {
            assignments(p, |block, range, text| {
                let value = text.find('=')? + range.start + 1;
                (!block.before.is_subprogram)
                    .then(|| vec![Edit { range: value..range.end, text: "SQRT[2.-6.]".to_owned() }])
            })
        },
    )
    .anywhere(),
    Kind::new(
        "argument-left-out",
        Fear::Crash,
        "an argument that the macro needs is left out",
        &["alarm-reached", "variable-read-before-set", "maybe-variable-unset"],
        |p| {
            p.each(|block| {
                block.code(&[Effect::MacroCall])?;
                let own = block.word(b'P')?.number?;
                let here = p.blocks.iter().any(|b| b.word(b'O').is_some_and(|w| w.number == Some(own)));
                let word =
                    block.words.iter().rev().find(|word| !matches!(word.letter, b'G' | b'P' | b'N'))?;
                here.then(|| p.without(word))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "modal-macro-left-on",
        Fear::Crash,
        "a modal macro call (`G66`) is never cancelled",
        &["modal-call-left-on"],
        |p| {
            p.each(|block| {
                let code = block.code(&[Effect::MacroCall]).filter(|_| p.is_for(&["fanuc"]))?;
                Some(p.instead(code, "G66"))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "own-alarm-reached",
        Fear::Alarm,
        "the program stops itself on the normal way (`#3000`)",
        &["alarm-reached"],
        |p| {
            p.each(|block| {
                let fits = p.is_for(&["fanuc", "haas"])
                    && block.code(&[Effect::ToolChange]).is_some()
                    && !p.is_lathe();
                fits.then(|| p.line_above(block, "#3000=1 (NOT PROVED)"))
            })
        },
    )
    .anywhere(),
];
