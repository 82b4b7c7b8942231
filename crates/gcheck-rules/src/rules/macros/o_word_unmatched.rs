//! An O-word without its partner.

use gcheck_program::{OKeyword, OLabel, OWord};

use crate::declare::declare_rule;
use crate::{FileCx, Finding, Report, Run, Severity};

declare_rule! {
    /// An O-word that opens, continues or closes a structure has no partner with its label.
    ///
    /// ## Why it matters
    /// The control searches the file for the partner when it needs it. A subroutine without `endsub` is refused, and so is
    /// a closing or a middle word that comes first. A branch or a loop without its end is refused when the control has to
    /// skip it; else the program goes on to its end, and a loop runs only once.
    ///
    /// An `if` without `endif` is a warning: the program runs as long as the condition holds.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// o100 if [#1 GT 0]
    /// G0 X1
    /// o101 endif
    /// M2
    /// ```
    /// ```nc,reported,linuxcnc
    /// o100 if [#1 GT 0]
    /// o100 break
    /// o100 endif
    /// M2
    /// ```
    /// ## Not reported
    /// Each subroutine has its own labels; a `break` names its loop from inside other structures.
    /// ```nc,quiet,linuxcnc
    /// o1 sub
    /// o2 while [#1 GT 0]
    /// o3 if [#1 EQ 5]
    /// o2 break
    /// o3 endif
    /// #1=[#1-1]
    /// o2 endwhile
    /// o1 endsub
    /// o2 do
    /// #1=[#1+1]
    /// o2 while [#1 LT 3]
    /// M2
    /// ```
    rule "o-word-unmatched" in "macros" {
        summary: "O-word without its partner",
        severity: Error,
        tier: Program,
        since: "0.1.0",
        run: Run::Program { check },
    }
}

/// No real program nests more structures than this.
const DEEPEST: usize = 256;

fn check(cx: &FileCx<'_>, report: &mut Report<'_>) {
    let structural = |o: &&OWord| !matches!(o.keyword, OKeyword::Call | OKeyword::Return);
    let words: Vec<&OWord> = cx.file_index.o_words.iter().filter(structural).collect();
    // A computed label could be any.
    if words.is_empty() || !cx.control().syntax().o_words || words.iter().any(|o| o.label == OLabel::Computed)
    {
        return;
    }
    let mut open: Vec<&OWord> = Vec::new();
    for (ix, this) in words.iter().enumerate() {
        let openers: &[OKeyword] = match this.keyword {
            OKeyword::EndSub => &[OKeyword::Sub],
            OKeyword::ElseIf | OKeyword::Else | OKeyword::EndIf => &[OKeyword::If],
            OKeyword::EndWhile => &[OKeyword::While],
            OKeyword::EndRepeat => &[OKeyword::Repeat],
            OKeyword::Break | OKeyword::Continue => &[OKeyword::While, OKeyword::Do],
            // `o1 while` closes `o1 do`.
            OKeyword::While if open.iter().any(|o| o.label == this.label && o.keyword == OKeyword::Do) => {
                &[OKeyword::Do]
            }
            _ if open.len() >= DEEPEST => return,
            _ => {
                open.push(this);
                continue;
            }
        };
        let Some(at) = open.iter().rposition(|o| o.label == this.label && openers.contains(&o.keyword))
        else {
            report.add(no_opener(cx, this, openers));
            continue;
        };
        if matches!(this.keyword, OKeyword::ElseIf | OKeyword::Else | OKeyword::Break | OKeyword::Continue) {
            continue;
        }
        let rest = words.get(ix + 1..).unwrap_or_default();
        let inner = open.split_off(at);
        for inside in inner.into_iter().skip(1) {
            if closes_later(inside, rest) {
                open.push(inside);
            } else {
                report.add(no_closer(cx, inside));
            }
        }
    }
    for left in open {
        report.add(no_closer(cx, left));
    }
}

/// The keyword that closes a structure.
fn closer(opener: OKeyword) -> OKeyword {
    match opener {
        OKeyword::Sub => OKeyword::EndSub,
        OKeyword::If => OKeyword::EndIf,
        OKeyword::Do => OKeyword::While,
        OKeyword::Repeat => OKeyword::EndRepeat,
        _ => OKeyword::EndWhile,
    }
}

fn closes_later(opener: &OWord, rest: &[&OWord]) -> bool {
    let same = rest.iter().filter(|o| o.label == opener.label);
    let closer = closer(opener.keyword);
    same.take_while(|o| o.keyword != opener.keyword).any(|o| o.keyword == closer)
}

fn written(cx: &FileCx<'_>, word: &OWord) -> String {
    let text = cx.slice(word.range.clone());
    let closed_by = |close: char| text.find(close).map_or(text.len(), |at| at + 1);
    let label_end = match text.get(1..).and_then(|rest| rest.trim_start().chars().next()) {
        Some('<') => closed_by('>'),
        Some('[') => closed_by(']'),
        _ => 1 + text.bytes().skip(1).take_while(|b| b.is_ascii_digit() || *b == b' ').count(),
    };
    format!(
        "{} {}",
        text.get(..label_end).unwrap_or_default().trim_end(),
        word.keyword.name().to_ascii_lowercase()
    )
}

fn no_opener(cx: &FileCx<'_>, word: &OWord, openers: &[OKeyword]) -> Finding {
    let names: Vec<String> = openers.iter().map(|k| format!("`{}`", k.name().to_ascii_lowercase())).collect();
    let wanted = names.join(" or ");
    Finding::new(&META, word.range.clone(), format!("O-word `{}` has no {wanted}", written(cx, word)))
        .label(format!("no {wanted} with this label is open here"))
        .note("labels are compared as numbers, or as names without case and blanks")
        .help("correct the label, or add the O-word that opens the structure")
}

fn no_closer(cx: &FileCx<'_>, word: &OWord) -> Finding {
    let closer = closer(word.keyword).name().to_ascii_lowercase();
    let comes = match word.keyword {
        OKeyword::Sub => "the control looks for the end to the end of the file, and stops with an error",
        OKeyword::If => {
            "the control stops with an error when the condition does not hold; when it holds, the program runs on to its end"
        }
        OKeyword::Do => {
            "the program runs on to its end, so the loop runs once; the control stops with an error at `break`"
        }
        _ => {
            "the control stops with an error when it has to skip the loop; else the program runs on to its end, so the loop runs once"
        }
    };
    let finding =
        Finding::new(&META, word.range.clone(), format!("O-word `{}` has no `{closer}`", written(cx, word)))
            .label("opened here and not closed where it should be")
            .note(comes)
            .help(format!("close it with `{closer}` and the same label"));
    if word.keyword == OKeyword::If { finding.at_most(Severity::Warning) } else { finding }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn every_opener_wants_its_own_closer() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 if [1 GT 0]\no2 while [1 LT 0]\no3 repeat [2]\no4 do\no<five> sub\nM2\n",
            &expect![[r#"
                1 | o1 if [1 GT 0]
                  | ^^^^^^^^^^^^^^ warning[o-word-unmatched] O-word `o1 if` has no `endif`
                2 | o2 while [1 LT 0]
                  | ^^^^^^^^^^^^^^^^^ error[o-word-unmatched] O-word `o2 while` has no `endwhile`
                3 | o3 repeat [2]
                  | ^^^^^^^^^^^^^ error[o-word-unmatched] O-word `o3 repeat` has no `endrepeat`
                4 | o4 do
                  | ^^^^^ error[o-word-unmatched] O-word `o4 do` has no `while`
                5 | o<five> sub
                  | ^^^^^^^^^^^ error[o-word-unmatched] O-word `o<five> sub` has no `endsub`
            "#]],
        );
    }

    #[test]
    fn closers_and_middles_want_their_opener() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 else\no1 elseif [1 GT 0]\no1 endif\no2 endwhile\no3 endrepeat\no4 endsub\no5 continue\n",
            &expect![[r#"
                1 | o1 else
                  | ^^^^^^^ error[o-word-unmatched] O-word `o1 else` has no `if`
                2 | o1 elseif [1 GT 0]
                  | ^^^^^^^^^^^^^^^^^^ error[o-word-unmatched] O-word `o1 elseif` has no `if`
                3 | o1 endif
                  | ^^^^^^^^ error[o-word-unmatched] O-word `o1 endif` has no `if`
                4 | o2 endwhile
                  | ^^^^^^^^^^^ error[o-word-unmatched] O-word `o2 endwhile` has no `while`
                5 | o3 endrepeat
                  | ^^^^^^^^^^^^ error[o-word-unmatched] O-word `o3 endrepeat` has no `repeat`
                6 | o4 endsub
                  | ^^^^^^^^^ error[o-word-unmatched] O-word `o4 endsub` has no `sub`
                7 | o5 continue
                  | ^^^^^^^^^^^ error[o-word-unmatched] O-word `o5 continue` has no `while` or `do`
            "#]],
        );
    }

    #[test]
    fn an_inner_structure_without_end_is_told_and_the_outer_one_is_not() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 while [#1 LT 2]\no2 if [#1 EQ 1]\no1 endwhile\nM2\n",
            &expect![[r#"
            2 | o2 if [#1 EQ 1]
              | ^^^^^^^^^^^^^^^ warning[o-word-unmatched] O-word `o2 if` has no `endif`
        "#]],
        );
    }

    #[test]
    fn each_opener_tells_what_comes_of_it() {
        let text = "o1 if [#1 GT 0]\no2 repeat [#1]\no3 do\no4 sub\nM2\n";
        let told: Vec<String> =
            findings(&only(&RULE), "linuxcnc", text, &World::default()).iter().map(words).collect();
        expect![[r#"
            O-word `o1 if` has no `endif`
              here: opened here and not closed where it should be
              note: the control stops with an error when the condition does not hold; when it holds, the program runs on to its end
              help: close it with `endif` and the same label
            O-word `o2 repeat` has no `endrepeat`
              here: opened here and not closed where it should be
              note: the control stops with an error when it has to skip the loop; else the program runs on to its end, so the loop runs once
              help: close it with `endrepeat` and the same label
            O-word `o3 do` has no `while`
              here: opened here and not closed where it should be
              note: the program runs on to its end, so the loop runs once; the control stops with an error at `break`
              help: close it with `while` and the same label
            O-word `o4 sub` has no `endsub`
              here: opened here and not closed where it should be
              note: the control looks for the end to the end of the file, and stops with an error
              help: close it with `endsub` and the same label
        "#]].assert_eq(&told.concat());
    }

    #[test]
    fn what_is_said() {
        let found = findings(&only(&RULE), "linuxcnc", "o<A B> endsub\n", &World::default());
        expect![[r#"
            O-word `o<A B> endsub` has no `sub`
              here: no `sub` with this label is open here
              note: labels are compared as numbers, or as names without case and blanks
              help: correct the label, or add the O-word that opens the structure
        "#]]
        .assert_eq(&words(&found[0]));
    }
}
