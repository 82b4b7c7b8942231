//! Words beside an O-word.

use gcheck_program::{BlockFlags, StatementKind, Word};

use crate::declare::declare_rule;
use crate::{BlockCx, Finding, Report, Run};

declare_rule! {
    /// A block with an O-word (`o1 if`, `o1 call`, `O100`) has other words, too.
    ///
    /// ## Why it matters
    /// An O-word is alone in its block, after a block number at most. The control stops with an error, and what the words
    /// were to do is not done.
    ///
    /// ## Reported
    /// ```nc,reported,linuxcnc
    /// o1 if [#1 GT 0]
    /// G0 X1
    /// o1 endif X2
    /// M2
    /// ```
    /// ## Not reported
    /// ```nc,quiet,linuxcnc
    /// N10 o1 if [#1 GT 0]
    /// G0 X1
    /// N20 o1 endif (BACK)
    /// X2
    /// M2
    /// ```
    rule "words-beside-o-word" in "macros" {
        summary: "words in the block of an O-word",
        severity: Error,
        tier: Block,
        since: "0.1.0",
        run: Run::Block { trigger: BlockFlags::STATEMENT.union(BlockFlags::PROGRAM_NUMBER), check },
    }
}

fn check(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    if !cx.control().syntax().o_words || cx.block().flags.contains(BlockFlags::ERROR) {
        return;
    }
    // A colon in a word of another dialect is not a program number.
    let number = cx.word('O').filter(|word| cx.text(word).starts_with(['o', 'O']));
    let statement = cx.statements().find(|statement| matches!(statement.kind, StatementKind::OWord { .. }));
    let label = match (number, statement) {
        (Some(word), _) => cx.range(word),
        (None, Some(statement)) => cx.in_file(statement.range.clone()),
        (None, None) => return,
    };
    let is_other = |word: &&Word| !matches!(word.letter.ascii(), b'N' | b'O') || word.letter.is_corner();
    let words = cx.words().iter().filter(is_other).map(|word| cx.range(word));
    let is_own = |range: &std::ops::Range<u32>| cx.in_file(range.clone()) == label;
    let statements = cx.statements().filter(|statement| !is_own(&statement.range));
    let others = words.chain(statements.map(|statement| cx.in_file(statement.range.clone())));
    let Some(first) = others.min_by_key(|range| range.start) else { return };
    let text = cx.slice(first.start - cx.in_file(0..0).start..first.end - cx.in_file(0..0).start);
    report.add(
        Finding::new(&META, first, format!("`{}` in the block of an O-word", text.trim()))
            .label("the control refuses the block")
            .also(label, "the O-word")
            .note("an O-word is alone in its block, after a block number at most")
            .help("put the other words in a block of their own"),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn the_first_other_word_is_marked() {
        check_rule(
            &RULE,
            "linuxcnc",
            "o1 sub G0\nG0 X#1\no1 endsub\no1 call [1] F100 (FAST)\nN5 o1 call [2]\no1 call [3] #5=1\nM2\n",
            &expect![[r#"
                1 | o1 sub G0
                  |        ^^ error[words-beside-o-word] `G0` in the block of an O-word
                4 | o1 call [1] F100 (FAST)
                  |             ^^^^ error[words-beside-o-word] `F100` in the block of an O-word
                6 | o1 call [3] #5=1
                  |             ^^^^ error[words-beside-o-word] `#5=1` in the block of an O-word
            "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "G0 X1\no100 X2\nM2\n",
            &expect![[r#"
            2 | o100 X2
              |      ^^ error[words-beside-o-word] `X2` in the block of an O-word
        "#]],
        );
    }

    #[test]
    fn a_program_number_of_another_control_may_have_company() {
        check_rule(&RULE, "fanuc-mill", "O0001 G0 X1.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn what_is_said() {
        let found = findings(&only(&RULE), "linuxcnc", "o1 call [1] F100\nM2\n", &World::default());
        expect![[r#"
            `F100` in the block of an O-word
              here: the control refuses the block
              there: the O-word
              note: an O-word is alone in its block, after a block number at most
              help: put the other words in a block of their own
        "#]]
        .assert_eq(&found.iter().map(words).collect::<String>());
    }
}
