//! Rules of one block, asked again with the values of its computed words.
//!
//! Knows: how a state makes a block of numbers of a block of expressions, and what a finding says of it. Must not know: any
//! rule, which values are certain.

use std::ops::Range;

use gcheck_diagnostics::Finding;
use gcheck_program::{BlockFlags, Word};

use crate::evaluated::BlockOfValues;
use crate::{BlockCx, PathCx, PathRule, Remembers, Report};

/// Words of a block whose values a finding names.
const MOST_NAMED: usize = 6;

/// A rule of one block that also judges the values of computed words.
pub(crate) struct WithValues {
    pub(crate) trigger: BlockFlags,
    pub(crate) check: fn(&BlockCx<'_>, &mut Report<'_>),
}

impl PathRule for WithValues {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::Nothing
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        // The caller may give other values.
        if cx.depth() == 1 && cx.file_index.is_called_from_elsewhere() {
            return;
        }
        let Some(known) = cx.block_of_values().filter(|known| known.block.flags.intersects(self.trigger))
        else {
            return;
        };
        // Shared with the caller: a block of a loop is asked for by many rules at every turn.
        let own = if cx.read_block().is_none() { cx.place() } else { None };
        let place = cx.read_block().map(|read| &read.place).or(own.as_ref());
        let (Some(place), Some(file)) = (place, cx.program.file(cx.origin().at.file)) else { return };
        let text = file.loaded.chunk_text(place.chunk);
        let written = BlockCx::new(cx.environment, &place.table, place.ix, text, place.base);
        let computed = BlockCx { block: &known.block, words: &known.words, ..written };
        let found = self.findings(&computed);
        if found.is_empty() {
            return;
        }
        // What the block shows as it is written was reported without executing it.
        let shown: Vec<Range<u32>> = if written.block().flags.intersects(self.trigger) {
            self.findings(&written).into_iter().map(|finding| finding.range).collect()
        } else {
            Vec::new()
        };
        for mut finding in found.into_iter().filter(|finding| !shown.contains(&finding.range)) {
            let missed = known.left_out.iter().find(|word| self.is_cause(word, &finding, &computed));
            if let Some(word) = missed {
                finding.help =
                    Some(format!("give the variable of `{}` a value before this block", computed.text(word)));
            }
            report.add(cx.with_calls(name_values(finding, &computed, known)));
        }
    }
}

impl WithValues {
    fn findings(&self, cx: &BlockCx<'_>) -> Vec<Finding> {
        let mut found = Vec::new();
        (self.check)(cx, &mut Report::new(&mut |finding| found.push(finding)));
        found
    }

    /// Is it because a word counts for nothing, its variable being empty, that there is this finding?
    fn is_cause(&self, left_out: &Word, finding: &Finding, cx: &BlockCx<'_>) -> bool {
        // Any number would do: what is asked is whether the word is there.
        let words: Vec<Word> =
            cx.words.iter().copied().chain([left_out.with_value(1.0, left_out.code)]).collect();
        let block = cx.environment.dialect.with_words(cx.block, &words);
        let with = BlockCx { block: &block, words: &words, ..*cx };
        !self
            .findings(&with)
            .iter()
            .any(|other| other.range == finding.range && other.message == finding.message)
    }
}

/// Adds what the computed words are. A correction of the text would hold for these values only.
fn name_values(mut finding: Finding, cx: &BlockCx<'_>, known: &BlockOfValues) -> Finding {
    finding.fixes.clear();
    for word in known.computed().take(MOST_NAMED) {
        let Some(value) = word.number() else { continue };
        let is = match cx.control().code_at(word.code) {
            Some(code) => format!("`{}`", code.number()),
            None => value.to_string(),
        };
        finding = finding.note(format!("`{}` is {is} here", cx.text(word)));
    }
    for word in known.left_out.iter().take(MOST_NAMED) {
        finding = finding
            .note(format!("the variable of `{}` is empty here, so the word does not count", cx.text(word)));
    }
    finding
}
