//! O-words: subroutines, branches and loops by label.
//!
//! Knows: where each keyword leads, and what a loop or a branch keeps meanwhile. Must not know: conditions' values (the domain
//! decides), what a call does with its arguments.

use std::ops::Range;
use std::rc::Rc;

use gcheck_controls::Letter;
use gcheck_program::{BlockTable, ExprIx, OKeyword, OLabel, OWordLinks, Place, StatementKind};

use crate::assumption::Assumption;
use crate::eval::value::{Domain, Truth};
use crate::exec::context::{Callee, Executor, OLabels, Outcome, Step};
use crate::fault::Fault;
use crate::lattice::{Flat, Perhaps};
use crate::observer::Observer;
use crate::origin::At;
use crate::program::ProgramFile;
use crate::state::{FrameKind, State};

/// An O-word of the block under way.
#[derive(Clone, Copy)]
struct OWordBlock<'b> {
    place: &'b Place,
    table: &'b BlockTable,
    at: At,
    links: OWordLinks,
    /// Its first expression: the condition, the count, the result.
    first: Option<ExprIx>,
}

impl OWordBlock<'_> {
    /// A block of the same file.
    fn to(&self, block: u32) -> At {
        At { file: self.at.file, block }
    }
}

impl<D: Domain, O: Observer<D>> Executor<'_, '_, D, O> {
    /// Where an O-word leads.
    pub(super) fn o_word(
        &mut self,
        place: &Place,
        table: &BlockTable,
        label: &OLabel,
        keyword: OKeyword,
        arguments: Range<u32>,
        state: &mut State<D>,
    ) -> Step<Outcome<D>> {
        let at = self.origin.at;
        let links = self.file(at.file).and_then(|file| file.loaded.flow_graph().o_word(at.block));
        let Some(mut links) = links else { return Err(Fault::LoopMismatch) };
        if self.is_paired_by_value(at, label, &links) {
            self.pair_by_value(at, place, label, &arguments, &mut links, state)?;
        }
        let first = StatementKind::arguments(&arguments).nth(label.expressions());
        let word = OWordBlock { place, table, at, links, first };
        let is_called = state.calls.last().is_some_and(|f| f.entry == at && f.kind == FrameKind::OWord);
        self.define_label(label, &word, is_called)?;
        match keyword {
            OKeyword::Sub => self.begin_subroutine(word, state),
            OKeyword::EndSub | OKeyword::Return => self.return_from_subroutine(word, state),
            OKeyword::Call => self.call_subroutine(word, label, &arguments, state),
            OKeyword::If => self.branch(word, state),
            // An ELSEIF or ELSE met by running into it ends the branch before.
            OKeyword::ElseIf => match unwanted_branch(at, links.end, state)? {
                Some(outcome) => Ok(outcome),
                None => self.branch(word, state),
            },
            OKeyword::Else => {
                if let Some(outcome) = unwanted_branch(at, links.end, state)? {
                    return Ok(outcome);
                }
                want_branch(None, state);
                Ok(Outcome::Next)
            }
            OKeyword::EndIf => {
                if links.head.is_none() {
                    return Err(Fault::LoopMismatch);
                }
                want_branch(None, state);
                Ok(Outcome::Next)
            }
            OKeyword::While => self.begin_or_end_while(word, state),
            OKeyword::EndWhile => {
                links.head.map_or(Err(Fault::LoopMismatch), |head| Ok(Outcome::Jump(word.to(head))))
            }
            // The control looks for the end when it comes to it, or has to leave the loop.
            OKeyword::Do => Ok(Outcome::Next),
            OKeyword::Repeat => self.begin_repeat(word, state),
            OKeyword::EndRepeat => end_repeat(word, state),
            OKeyword::Break => match links.leads_to {
                Some(end) => {
                    if let Some(head) = links.head {
                        drop_counter(word.to(head), state);
                    }
                    Ok(Outcome::Jump(word.to(end + 1)))
                }
                None => Err(Fault::LoopMismatch),
            },
            // The control looks for the end of the loop first, also where the head decides.
            OKeyword::Continue if links.end.is_none() => Err(Fault::LoopMismatch),
            OKeyword::Continue => links.leads_to.map_or(Err(Fault::LoopMismatch), |end| {
                let block = match (links.head, end) {
                    // A WHILE decides at its head.
                    (Some(head), end) if end == head => head,
                    (_, end) => end,
                };
                Ok(Outcome::Jump(word.to(block)))
            }),
        }
    }

    /// Does the text alone not say which O-words belong to this one?
    fn is_paired_by_value(&self, at: At, label: &OLabel, links: &OWordLinks) -> bool {
        let is_alone = match links.keyword {
            OKeyword::Call | OKeyword::Return | OKeyword::EndSub => false,
            OKeyword::Sub | OKeyword::If | OKeyword::Do | OKeyword::Repeat => links.end.is_none(),
            OKeyword::While => links.head.is_none() && links.end.is_none(),
            _ => links.head.is_none(),
        };
        is_alone
            && (*label == OLabel::Computed
                || self.file(at.file).is_some_and(|file| file.loaded.flow_graph().has_computed_o_labels()))
    }

    /// Joins an O-word to those whose labels have its value, as the control does when it comes to it.
    fn pair_by_value(
        &mut self,
        at: At,
        place: &Place,
        label: &OLabel,
        arguments: &Range<u32>,
        links: &mut OWordLinks,
        state: &State<D>,
    ) -> Step {
        use OKeyword as K;
        let own = self.label_value(place, label, arguments, state)?;
        let (above, below) =
            (self.equal_labels(at, &own, true, state), self.equal_labels(at, &own, false, state));
        let first = |found: &[(u32, K)], keywords: &[K]| {
            found.iter().find(|(_, keyword)| keywords.contains(keyword)).map(|(block, _)| *block)
        };
        match links.keyword {
            K::Sub => links.end = first(&below?, &[K::EndSub]),
            K::If | K::ElseIf | K::Else => {
                let below = below?;
                links.next = first(&below, &[K::ElseIf, K::Else, K::EndIf]);
                links.end = first(&below, &[K::EndIf]);
                if links.keyword != K::If {
                    links.head = first(&above?, &[K::If]);
                }
            }
            K::EndIf => links.head = first(&above?, &[K::If]),
            K::EndWhile => links.head = first(&above?, &[K::While]),
            K::EndRepeat => links.head = first(&above?, &[K::Repeat]),
            K::Do => links.end = first(&below?, &[K::While]),
            K::Repeat => links.end = first(&below?, &[K::EndRepeat]),
            K::While => {
                let opener = above?.into_iter().find(|(_, keyword)| matches!(keyword, K::Do | K::While));
                match opener {
                    Some((head, K::Do)) => links.head = Some(head),
                    _ => links.end = first(&below?, &[K::EndWhile]),
                }
            }
            K::Break | K::Continue => {
                let opener = above?.into_iter().find(|(_, keyword)| matches!(keyword, K::Do | K::While));
                let Some((head, keyword)) = opener else { return Ok(()) };
                let closer = if keyword == K::Do { K::While } else { K::EndWhile };
                (links.head, links.end) = (Some(head), first(&below?, &[closer]));
                let decides_at_head = links.keyword == K::Continue && keyword == K::While;
                links.leads_to = if decides_at_head { Some(head) } else { links.end };
            }
            K::Call | K::Return | K::EndSub => {}
        }
        Ok(())
    }

    /// O-words of the same label in the same subroutine, the nearest first, above the block or below it.
    fn equal_labels(
        &mut self,
        at: At,
        own: &OLabel,
        above: bool,
        state: &State<D>,
    ) -> Step<Vec<(u32, OKeyword)>> {
        let Some(file) = self.file(at.file) else { return Err(Fault::Undecidable) };
        let graph = file.loaded.flow_graph();
        let part = graph.part_of(at.block);
        let own_links = graph.o_word(at.block);
        let begins = own_links.is_some_and(|links| links.keyword == OKeyword::Sub);
        let inside = if begins { Some(at.block) } else { own_links.and_then(|links| links.inside) };
        let blocks = if above { part.start..at.block } else { at.block + 1..part.end };
        let is_near = |block: u32| graph.o_word(block).is_some_and(|links| links.inside == inside);
        let labels = self.o_labels(at.file);
        let mut equal: Vec<(u32, OKeyword)> =
            labels.written(own, &blocks).filter(|(block, _)| is_near(*block)).collect();
        let computed: Vec<(u32, OKeyword)> =
            labels.computed(&blocks).filter(|(block, _)| is_near(*block)).take(MOST_LABELS + 1).collect();
        if computed.len() > MOST_LABELS {
            return Err(Fault::Undecidable);
        }
        for (block, keyword) in computed {
            if self.computed_label_of(&file, block, state)?.as_ref() == Some(own) {
                equal.push((block, keyword));
            }
        }
        equal.sort_unstable_by_key(|(block, _)| *block);
        if above {
            equal.reverse();
        }
        Ok(equal)
    }

    /// The value of the computed label of a block.
    fn computed_label_of(
        &mut self,
        file: &ProgramFile<'_>,
        block: u32,
        state: &State<D>,
    ) -> Step<Option<OLabel>> {
        let Some(place) = file.loaded.place(block, self.program.dialect()) else { return Ok(None) };
        let table = Rc::clone(&place.table);
        let computed = o_word_of(&table, &place).filter(|(label, _)| **label == OLabel::Computed);
        let Some((label, arguments)) = computed else { return Ok(None) };
        self.label_value(&place, label, arguments, state).map(Some)
    }

    /// The labels of a file, read once.
    fn o_labels(&mut self, file: u32) -> Rc<OLabels> {
        if let Some(labels) = self.o_labels.get(&file) {
            return Rc::clone(labels);
        }
        let mut labels = OLabels::default();
        if let Some(file) = self.file(file) {
            let graph = file.loaded.flow_graph();
            for (block, keyword) in graph.o_words_in(0..graph.blocks()) {
                if matches!(keyword, OKeyword::Call | OKeyword::Return) {
                    continue;
                }
                let Some(place) = file.loaded.place(block, self.program.dialect()) else { continue };
                match o_word_of(&place.table, &place) {
                    Some((OLabel::Computed, _)) => labels.computed.push((block, keyword)),
                    Some((label, _)) => {
                        labels.written.entry(label.clone()).or_default().push((block, keyword));
                    }
                    None => {}
                }
            }
        }
        let labels = Rc::new(labels);
        self.o_labels.insert(file, Rc::clone(&labels));
        labels
    }

    /// A label, with its number where it is computed.
    fn label_value(
        &mut self,
        place: &Place,
        label: &OLabel,
        arguments: &Range<u32>,
        state: &State<D>,
    ) -> Step<OLabel> {
        match label {
            OLabel::Computed => {
                let Some(expr) = StatementKind::arguments(arguments).next() else {
                    return Err(Fault::Malformed);
                };
                let value = self.value_of(place, &place.table, place.table.expr(expr), state)?;
                let number = D::known(&value).ok_or(Fault::Undecidable)?;
                whole_label(number)
            }
            _ => Ok(label.clone()),
        }
    }

    /// A control keeps one place for a label of a subroutine: it refuses the second block that opens a structure with it. An
    /// analysis of all paths leaves that to a rule of the text. A call of a subroutine does not define it again.
    fn define_label(&mut self, label: &OLabel, word: &OWordBlock<'_>, is_called: bool) -> Step {
        let opens = match word.links.keyword {
            OKeyword::If | OKeyword::Repeat | OKeyword::Sub => true,
            OKeyword::While => word.links.head.is_none(),
            _ => false,
        };
        let at = word.at;
        if !opens || self.leaves_to_rules() || !self.refuses_incomplete() || *label == OLabel::Computed {
            return Ok(());
        }
        let has_reused =
            self.file(at.file).is_some_and(|file| !file.loaded.flow_graph().reused_o_labels().is_empty());
        if !has_reused {
            return Ok(());
        }
        let scope = if word.links.keyword == OKeyword::Sub { None } else { Some(word.links.inside) };
        if scope.is_none() && is_called {
            return Ok(());
        }
        let first = *self.labels_defined.entry((at.file, scope, label.clone())).or_insert(at.block);
        if first == at.block { Ok(()) } else { self.refuse(Fault::LoopMismatch) }
    }

    /// The body runs only when it is called.
    fn begin_subroutine(&mut self, word: OWordBlock<'_>, state: &State<D>) -> Step<Outcome<D>> {
        let at = word.at;
        let Some(end) = word.links.end else { return Err(Fault::LoopMismatch) };
        if state.calls.last().is_some_and(|f| f.entry == at && f.kind == FrameKind::OWord) {
            return Ok(Outcome::Next);
        }
        if self.holds_subroutine(at, end) {
            self.refuse(Fault::LoopMismatch)?;
        }
        Ok(Outcome::Jump(word.to(end + 1)))
    }

    fn return_from_subroutine(&mut self, word: OWordBlock<'_>, state: &mut State<D>) -> Step<Outcome<D>> {
        let is_called = state.calls.last().is_some_and(|f| f.kind == FrameKind::OWord);
        if !is_called {
            return Err(Fault::StrayReturn);
        }
        let result = match word.first {
            Some(expr) => Some(self.evaluate(word.place, word.table, word.table.expr(expr), state)?),
            None => None,
        };
        self.leave(None, result, state)
    }

    fn call_subroutine(
        &mut self,
        word: OWordBlock<'_>,
        label: &OLabel,
        arguments: &Range<u32>,
        state: &mut State<D>,
    ) -> Step<Outcome<D>> {
        let mut values = Vec::new();
        for (number, expr) in StatementKind::arguments(arguments).enumerate() {
            let value = self.evaluate(word.place, word.table, word.table.expr(expr), state)?;
            values.push((number as u32 + 1, value));
        }
        if values.len() > self.model.semantics().locals[1] as usize {
            return Err(Fault::Conflict);
        }
        let computed = match label {
            // `O[#1] CALL`: the first expression is the label's.
            OLabel::Computed => {
                let number = (!values.is_empty()).then(|| values.remove(0).1);
                let number = number.as_ref().and_then(D::known).ok_or(Fault::Undecidable)?;
                for (slot, _) in &mut values {
                    *slot -= 1;
                }
                Some(whole_label(number)?)
            }
            _ => None,
        };
        let label = computed.as_ref().unwrap_or(label);
        let target = match self.program.find_subroutine(label, word.at.file) {
            Some(target) => Some(target),
            None => self.subroutine_by_value(label, word.at, state)?,
        };
        let Some(target) = target else {
            self.assumptions.insert(Assumption::MissingSubroutine(match label {
                OLabel::Name(name) => name.clone(),
                OLabel::Number(number) => number.to_string(),
                OLabel::Computed => String::new(),
            }));
            self.refuse_in(Fault::NoSuchProgram, state)?;
            self.lose_everything(state)?;
            return Ok(Outcome::Next);
        };
        self.enter(Callee::of_subroutine(target, values), state)
    }

    /// A subroutine of the file whose label is computed: `O[#1] SUB`.
    fn subroutine_by_value(&mut self, label: &OLabel, at: At, state: &State<D>) -> Step<Option<At>> {
        let Some(file) = self.file(at.file) else { return Ok(None) };
        let graph = file.loaded.flow_graph();
        if !graph.has_computed_o_labels() {
            return Ok(None);
        }
        let labels = self.o_labels(at.file);
        let all = 0..graph.blocks();
        let subs = labels.computed(&all).filter(|(_, keyword)| *keyword == OKeyword::Sub);
        for (block, _) in subs.take(MOST_LABELS) {
            if self.computed_label_of(&file, block, state)?.as_ref() == Some(label) {
                return Ok(Some(At { file: at.file, block }));
            }
        }
        Ok(None)
    }

    /// `IF`, or an `ELSEIF` that is wanted.
    fn branch(&mut self, word: OWordBlock<'_>, state: &mut State<D>) -> Step<Outcome<D>> {
        let Some(condition) = word.first else { return Err(Fault::Malformed) };
        let truth = self.condition(word.place, word.table, condition, state)?;
        let Some(next) = word.links.next.or(word.links.end).map(|next| word.to(next)) else {
            want_branch(None, state);
            return self.open_end(word.table, condition, truth, state);
        };
        match truth {
            Truth::True => {
                self.assume(word.table, condition, true, state);
                want_branch(None, state);
                Ok(Outcome::Next)
            }
            Truth::False => {
                self.assume(word.table, condition, false, state);
                want_branch(Some(next), state);
                Ok(Outcome::Jump(next))
            }
            Truth::Unknown => {
                let mut yes = state.clone();
                self.assume(word.table, condition, true, &mut yes);
                want_branch(None, &mut yes);
                let mut no = state.clone();
                self.assume(word.table, condition, false, &mut no);
                want_branch(Some(next), &mut no);
                Ok(Outcome::Fork(vec![(word.at.next(), yes), (next, no)]))
            }
        }
    }

    /// `WHILE` at the head of its loop, or at the end of `DO … WHILE`.
    fn begin_or_end_while(&mut self, word: OWordBlock<'_>, state: &mut State<D>) -> Step<Outcome<D>> {
        let Some(condition) = word.first else { return Err(Fault::Malformed) };
        let truth = self.condition(word.place, word.table, condition, state)?;
        let (holds, fails) = match (word.links.head, word.links.end) {
            (Some(head), _) => (word.to(head + 1), word.at.next()),
            (None, Some(end)) => (word.at.next(), word.to(end + 1)),
            (None, None) => return self.open_end(word.table, condition, truth, state),
        };
        match truth {
            Truth::True => {
                self.assume(word.table, condition, true, state);
                Ok(Outcome::Jump(holds))
            }
            Truth::False => {
                self.assume(word.table, condition, false, state);
                Ok(Outcome::Jump(fails))
            }
            Truth::Unknown => Ok(self.both_ways(word.table, condition, holds, fails, state)),
        }
    }

    fn begin_repeat(&mut self, word: OWordBlock<'_>, state: &mut State<D>) -> Step<Outcome<D>> {
        let Some(count) = word.first else { return Err(Fault::Malformed) };
        let value = self.evaluate(word.place, word.table, word.table.expr(count), state)?;
        // A half goes to the even neighbour (observed).
        let turns = D::known(&value).map(|n| n.round_ties_even().max(0.0));
        let Some(past) = word.links.end.map(|end| word.to(end + 1)) else {
            return if turns == Some(0.0) { Err(Fault::LoopMismatch) } else { Ok(Outcome::Next) };
        };
        #[expect(clippy::cast_sign_loss, reason = "not negative")]
        match turns {
            Some(0.0) => Ok(Outcome::Jump(past)),
            Some(turns) => {
                set_counter(word.at, Flat::Known(turns.min(f64::from(u32::MAX)) as u32), state);
                Ok(Outcome::Next)
            }
            None => {
                let skipped = state.clone();
                set_counter(word.at, Flat::Unknown, state);
                Ok(Outcome::Fork(vec![(word.at.next(), state.clone()), (past, skipped)]))
            }
        }
    }

    /// A branch or a loop without its end in the text: the control looks for it only when it has to skip the blocks, and
    /// refuses the program then. Where the condition is open the path that it refuses ends here.
    fn open_end(
        &mut self,
        table: &BlockTable,
        condition: ExprIx,
        truth: Truth,
        state: &mut State<D>,
    ) -> Step<Outcome<D>> {
        if truth == Truth::False {
            return Err(Fault::LoopMismatch);
        }
        self.assume(table, condition, true, state);
        Ok(Outcome::Next)
    }

    /// Is a subroutine defined inside the one that begins here?
    fn holds_subroutine(&mut self, at: At, end: u32) -> bool {
        if let Some(holds) = self.nested.get(&at) {
            return *holds;
        }
        let is_sub = |graph: &gcheck_program::ControlFlowGraph, block: u32| {
            graph.o_word(block).is_some_and(|links| links.keyword == OKeyword::Sub)
        };
        let file = self.file(at.file);
        let holds = file.is_some_and(|file| {
            let graph = file.loaded.flow_graph();
            (at.block + 1..end).any(|block| is_sub(graph, block))
        });
        self.nested.insert(at, holds);
        holds
    }
}

/// Computed labels that are looked at for the partner of an O-word: each is computed every time.
const MOST_LABELS: usize = 256;

impl OLabels {
    /// Those of a label that is written, among the blocks.
    fn written(&self, label: &OLabel, blocks: &Range<u32>) -> impl Iterator<Item = (u32, OKeyword)> {
        among(self.written.get(label).map_or(&[], Vec::as_slice), blocks)
    }

    /// Those whose label is computed, among the blocks.
    fn computed(&self, blocks: &Range<u32>) -> impl Iterator<Item = (u32, OKeyword)> {
        among(&self.computed, blocks)
    }
}

fn among<'w>(
    words: &'w [(u32, OKeyword)],
    blocks: &Range<u32>,
) -> impl Iterator<Item = (u32, OKeyword)> + use<'w> {
    let at = |block: u32| words.partition_point(|(word, _)| *word < block);
    words.get(at(blocks.start)..at(blocks.end)).unwrap_or_default().iter().copied()
}

/// The label of the O-word of a block, with its expressions.
fn o_word_of<'t>(table: &'t BlockTable, place: &Place) -> Option<(&'t OLabel, &'t Range<u32>)> {
    table.statements(place.ix).find_map(|statement| match &statement.kind {
        StatementKind::OWord { label, arguments, .. } => Some((label, arguments)),
        _ => None,
    })
}

/// The label of a computed number.
fn whole_label(number: f64) -> Step<OLabel> {
    let whole = number.round();
    if (whole - number).abs() > 1e-4 {
        return Err(Fault::WordRange(Letter::of('O')));
    }
    #[expect(clippy::cast_sign_loss, reason = "the range is checked")]
    if (0.0..=f64::from(u32::MAX)).contains(&whole) {
        Ok(OLabel::Number(whole as u32))
    } else {
        Ok(OLabel::Name(whole.to_string()))
    }
}

/// The branch of an IF that was jumped to because the condition before it failed.
fn want_branch<D: Domain>(branch: Option<At>, state: &mut State<D>) {
    let branch = branch.map_or(Perhaps::No, Perhaps::Yes);
    if state.calls.kept().is_some_and(|kept| kept.wanted_branch != branch)
        && let Some(kept) = state.calls.kept_mut()
    {
        kept.wanted_branch = branch;
    }
}

fn set_counter<D: Domain>(block: At, turns: Flat<u32>, state: &mut State<D>) {
    if let Some(kept) = state.calls.kept_mut() {
        kept.counters.set(block, turns);
    }
}

fn drop_counter<D: Domain>(block: At, state: &mut State<D>) {
    if let Some(kept) = state.calls.kept_mut() {
        kept.counters.remove(block);
    }
}

fn end_repeat<D: Domain>(word: OWordBlock<'_>, state: &mut State<D>) -> Step<Outcome<D>> {
    let Some(head) = word.links.head.map(|head| word.to(head)) else { return Err(Fault::LoopMismatch) };
    match state.calls.kept().and_then(|kept| kept.counters.get(head)) {
        Some(Flat::Known(left)) if left > 1 => {
            set_counter(head, Flat::Known(left - 1), state);
            Ok(Outcome::Jump(head.next()))
        }
        Some(Flat::Known(_)) | None => {
            drop_counter(head, state);
            Ok(Outcome::Next)
        }
        Some(Flat::Unknown) => {
            let mut done = state.clone();
            drop_counter(head, &mut done);
            Ok(Outcome::Fork(vec![(head.next(), state.clone()), (word.at.next(), done)]))
        }
    }
}

/// Where a branch leads that is not wanted: past its `IF`. `None` when it is wanted; both ways when nobody knows.
fn unwanted_branch<D: Domain>(at: At, end: Option<u32>, state: &mut State<D>) -> Step<Option<Outcome<D>>> {
    let wanted = state.calls.kept().map_or(Perhaps::No, |kept| kept.wanted_branch);
    if wanted.yes() == Some(&at) {
        return Ok(None);
    }
    let past = At { file: at.file, block: end.ok_or(Fault::LoopMismatch)? + 1 };
    if !wanted.is_unknown() {
        return Ok(Some(Outcome::Jump(past)));
    }
    let mut chosen = state.clone();
    want_branch(Some(at), &mut chosen);
    want_branch(None, state);
    Ok(Some(Outcome::Fork(vec![(past, state.clone()), (at, chosen)])))
}
