//! Which O-words belong together.
//!
//! Knows: O-words in text order, program by program, and that labels are a subroutine's own. Must not know: conditions,
//! counts, which pairings a control refuses when it runs.
//!
//! Structures are found by label alone, as the interpreter does it: `o1 if … o2 if … o1 endif … o2 endif` are two
//! overlapping structures, not a mistake of nesting. Where a label is used again while its structure is open, the innermost
//! is meant.

use std::collections::HashMap;
use std::ops::Range;

use super::link::{NONE, known};
use crate::statement::{OKeyword, OLabel};

/// What an O-word block is joined to. All fields are numbers of blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OWordLinks {
    /// The keyword.
    pub keyword: OKeyword,
    /// The block that opens the structure: `sub` for `endsub` and `return`, `if` for its branches, `while`, `do` or `repeat`
    /// for the loop's end, `while` or `do` for `break` and `continue`. `None` for a block that opens one; so a `while` with a head closes a `do`.
    pub head: Option<u32>,
    /// For `if`, `elseif` and `else`: the next branch or the `endif`.
    pub next: Option<u32>,
    /// The block that closes the structure: `endsub`, `endif`, `endwhile`, `endrepeat`, the `while` of a `do`.
    pub end: Option<u32>,
    /// For `call`: the block of the subroutine, when it is in this file and its label is not computed.
    pub callee: Option<u32>,
    /// The `sub` around the block.
    pub inside: Option<u32>,
    /// The block that `break`, `continue` or `return` leads to; `None` for other keywords.
    ///
    /// `break`: the block that closes the loop; the program goes on after it. `continue`: the block that decides on the
    /// next turn (`while`). `return`: the `endsub`.
    pub leads_to: Option<u32>,
}

/// An O-word; links are indices of entries or [`NONE`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Entry {
    block: u32,
    keyword: OKeyword,
    head: u32,
    next: u32,
    /// The closing entry; of a `call`, the `sub`.
    end: u32,
    /// The `sub` around it.
    scope: u32,
}

/// The O-words of a file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct OWords {
    /// In text order, one a block.
    entries: Vec<Entry>,
    /// By label: the block of the first subroutine of that name.
    subs: HashMap<OLabel, u32>,
    unmatched: Vec<u32>,
    reused: Vec<u32>,
    /// Is a label computed that opens, goes on with or closes a structure?
    computed: bool,
}

impl OWords {
    fn block(&self, ix: u32) -> Option<u32> {
        self.entries.get(known(ix)? as usize).map(|e| e.block)
    }

    pub(super) fn links(&self, block: u32) -> Option<OWordLinks> {
        let at = self.entries.binary_search_by_key(&block, |e| e.block).ok()?;
        let entry = self.entries.get(at)?;
        let is_call = entry.keyword == OKeyword::Call;
        let head = known(entry.head).and_then(|head| self.entries.get(head as usize));
        let leads_to = match entry.keyword {
            OKeyword::Continue if head.is_some_and(|h| h.keyword == OKeyword::While) => {
                self.block(entry.head)
            }
            OKeyword::Break | OKeyword::Continue | OKeyword::Return => self.block(entry.end),
            _ => None,
        };
        Some(OWordLinks {
            keyword: entry.keyword,
            head: head.map(|h| h.block),
            next: self.block(entry.next),
            end: if is_call { None } else { self.block(entry.end) },
            callee: if is_call { self.block(entry.end) } else { None },
            inside: self.block(entry.scope),
            leads_to,
        })
    }

    /// First and last block of each loop.
    pub(super) fn turns(&self) -> impl Iterator<Item = (u32, u32)> {
        let loops = [OKeyword::While, OKeyword::Do, OKeyword::Repeat];
        let begun = self.entries.iter().filter(move |entry| loops.contains(&entry.keyword));
        // Which loops have computed labels only a run knows: any of its O-words may lead back to any.
        let ends = self.entries.first().zip(self.entries.last()).filter(|_| self.computed);
        let all = ends.map(|(first, last)| (first.block, last.block));
        begun.filter_map(|entry| Some((entry.block, self.block(entry.end)?))).chain(all)
    }

    /// Does a computed label open, go on with or close a structure?
    pub(super) fn has_computed(&self) -> bool {
        self.computed
    }

    /// Blocks of the range with an O-word, in text order.
    pub(super) fn within(&self, blocks: Range<u32>) -> impl DoubleEndedIterator<Item = (u32, OKeyword)> {
        let at = |block: u32| self.entries.partition_point(|entry| entry.block < block);
        let entries = self.entries.get(at(blocks.start)..at(blocks.end)).unwrap_or_default();
        entries.iter().map(|entry| (entry.block, entry.keyword))
    }

    pub(super) fn sub(&self, label: &OLabel) -> Option<u32> {
        self.subs.get(label).copied()
    }

    /// The `sub` whose text holds the block, its own two blocks included; O-words before `first` do not count.
    pub(super) fn sub_around(&self, block: u32, first: u32) -> Option<u32> {
        let behind = self.entries.partition_point(|e| e.block <= block);
        let entry = self.entries.get(behind.checked_sub(1)?).filter(|e| e.block >= first)?;
        match entry.keyword {
            OKeyword::Sub => Some(entry.block),
            OKeyword::EndSub if entry.head != NONE && entry.block == block => self.block(entry.head),
            _ => self.block(entry.scope),
        }
    }

    pub(super) fn unmatched(&self) -> &[u32] {
        &self.unmatched
    }

    pub(super) fn reused(&self) -> &[u32] {
        &self.reused
    }

    #[cfg(test)]
    pub(super) fn heap_bytes(&self) -> usize {
        self.entries.capacity() * size_of::<Entry>()
            + self.subs.capacity() * (size_of::<(OLabel, u32)>() + 1)
            + (self.unmatched.capacity() + self.reused.capacity()) * size_of::<u32>()
    }
}

/// A structure that waits for its end.
#[derive(Debug, Clone, Copy)]
struct Open {
    head: u32,
    /// The last branch so far; the head itself at first.
    last: u32,
}

/// The labels of a subroutine, or of what is outside subroutines.
#[derive(Debug, Clone)]
struct Scope {
    sub: u32,
    label: u32,
    /// By label: what is open, innermost last. An entry means that a structure of this label has been opened.
    known: HashMap<u32, Vec<Open>>,
}

impl Scope {
    fn new(sub: u32, label: u32) -> Self {
        Self { sub, label, known: HashMap::new() }
    }

    fn close(&mut self, label: u32) -> Option<Open> {
        self.known.get_mut(&label)?.pop()
    }

    fn innermost(&mut self, label: u32) -> Option<&mut Open> {
        self.known.get_mut(&label)?.last_mut()
    }
}

/// Joins O-words as they come.
#[derive(Debug, Clone)]
pub(super) struct OWordBuilder {
    words: OWords,
    /// Labels as numbers; a computed label has none.
    labels: HashMap<OLabel, u32>,
    /// By label: the entry of the first subroutine.
    subs: HashMap<u32, u32>,
    /// Entry and label of each call.
    calls: Vec<(u32, u32)>,
    /// Scopes of the subroutines around this place, innermost last.
    scopes: Vec<Scope>,
    /// The scope of this program outside its subroutines.
    main: Scope,
    /// By label: how many of `scopes` have it.
    open_subs: HashMap<u32, u32>,
}

impl Default for OWordBuilder {
    fn default() -> Self {
        Self {
            words: OWords::default(),
            labels: HashMap::new(),
            subs: HashMap::new(),
            calls: Vec::new(),
            scopes: Vec::new(),
            main: Scope::new(NONE, NONE),
            open_subs: HashMap::new(),
        }
    }
}

impl OWordBuilder {
    /// The next O-word.
    pub(super) fn add(&mut self, block: u32, keyword: OKeyword, label: &OLabel) {
        if self.words.entries.last().is_some_and(|last| last.block == block) {
            // No control reads two O-words in one block.
            self.words.unmatched.push(block);
            return;
        }
        let this = self.words.entries.len() as u32;
        let scope = self.scopes.last().map_or(NONE, |s| s.sub);
        self.words.entries.push(Entry { block, keyword, head: NONE, next: NONE, end: NONE, scope });
        let label = self.label(label);
        self.words.computed |= label.is_none() && !matches!(keyword, OKeyword::Call | OKeyword::Return);
        match keyword {
            OKeyword::Sub => self.open_sub(this, label),
            OKeyword::EndSub => self.close_sub(this, label),
            OKeyword::Return => self.set(this, |entry| entry.head = scope),
            OKeyword::Call => self.calls.extend(label.map(|label| (this, label))),
            _ => {
                if let Some(label) = label {
                    self.structure(this, keyword, label);
                }
            }
        }
    }

    /// Another program begins: what is open stays open.
    pub(super) fn end_program(&mut self) {
        self.scopes.clear();
        self.main = Scope::new(NONE, NONE);
        self.open_subs = HashMap::new();
    }

    pub(super) fn finish(mut self) -> OWords {
        for (call, label) in std::mem::take(&mut self.calls) {
            let sub = self.subs.get(&label).copied().unwrap_or(NONE);
            self.set(call, |entry| entry.end = sub);
        }
        let mut words = self.words;
        // Branches, `break`, `continue` and `return` close where their heads do.
        for at in 0..words.entries.len() {
            let Some(entry) = words.entries.get(at) else { break };
            if entry.end != NONE || entry.head == NONE {
                continue;
            }
            let end = words.entries.get(entry.head as usize).map_or(NONE, |head| head.end);
            if let Some(entry) = words.entries.get_mut(at).filter(|_| end != at as u32) {
                entry.end = end;
            }
        }
        let lacks_partner = |entry: &&Entry| match entry.keyword {
            OKeyword::Call => false,
            OKeyword::Sub | OKeyword::If | OKeyword::Do | OKeyword::Repeat => entry.end == NONE,
            // A `while` either opens or closes.
            OKeyword::While => entry.end == NONE && entry.head == NONE,
            _ => entry.head == NONE,
        };
        words.unmatched.extend(words.entries.iter().filter(lacks_partner).map(|e| e.block));
        words.unmatched.sort_unstable();
        words.unmatched.dedup();
        words.subs = self
            .labels
            .into_iter()
            .filter_map(|(label, number)| {
                let sub = self.subs.get(&number)?;
                Some((label, words.entries.get(*sub as usize)?.block))
            })
            .collect();
        words.entries.shrink_to_fit();
        words.unmatched.shrink_to_fit();
        words.reused.shrink_to_fit();
        words
    }

    /// The label's number; `None` for a computed one, which could be any.
    fn label(&mut self, label: &OLabel) -> Option<u32> {
        if *label == OLabel::Computed {
            return None;
        }
        if let Some(number) = self.labels.get(label) {
            return Some(*number);
        }
        let number = self.labels.len() as u32;
        self.labels.insert(label.clone(), number);
        Some(number)
    }

    fn set(&mut self, ix: u32, change: impl FnOnce(&mut Entry)) {
        if let Some(entry) = self.words.entries.get_mut(ix as usize) {
            change(entry);
        }
    }

    fn reuse(&mut self, this: u32) {
        if let Some(entry) = self.words.entries.get(this as usize) {
            self.words.reused.push(entry.block);
        }
    }

    fn open_sub(&mut self, this: u32, label: Option<u32>) {
        if let Some(label) = label {
            if *self.subs.entry(label).or_insert(this) != this {
                self.reuse(this);
            }
            *self.open_subs.entry(label).or_default() += 1;
        }
        self.scopes.push(Scope::new(this, label.unwrap_or(NONE)));
    }

    /// An `endsub` closes the `sub` of its label; with another label it closes nothing.
    fn close_sub(&mut self, this: u32, label: Option<u32>) {
        let Some(label) = label.filter(|label| self.open_subs.get(label).is_some_and(|open| *open > 0))
        else {
            return;
        };
        while let Some(scope) = self.scopes.pop() {
            if let Some(open) = self.open_subs.get_mut(&scope.label) {
                *open = open.saturating_sub(1);
            }
            if scope.label == label {
                let outer = self.scopes.last().map_or(NONE, |s| s.sub);
                self.set(scope.sub, |sub| sub.end = this);
                self.set(this, |entry| {
                    entry.head = scope.sub;
                    entry.scope = outer;
                });
                return;
            }
        }
    }

    fn scope(&mut self) -> &mut Scope {
        self.scopes.last_mut().unwrap_or(&mut self.main)
    }

    /// A branch or loop: opens, goes on with, or closes the innermost structure of its label.
    fn structure(&mut self, this: u32, keyword: OKeyword, label: u32) {
        let open = self.scope().innermost(label).copied();
        let opener = open.and_then(|open| self.words.entries.get(open.head as usize)).map(|e| e.keyword);
        match (keyword, opener, open) {
            (OKeyword::ElseIf | OKeyword::Else, Some(OKeyword::If), Some(open)) => {
                self.set(open.last, |entry| entry.next = this);
                self.set(this, |entry| entry.head = open.head);
                if let Some(open) = self.scope().innermost(label) {
                    open.last = this;
                }
            }
            (OKeyword::EndIf, Some(OKeyword::If), Some(open)) => {
                self.set(open.last, |entry| entry.next = this);
                self.close(this, label);
            }
            (OKeyword::EndWhile, Some(OKeyword::While), _)
            | (OKeyword::EndRepeat, Some(OKeyword::Repeat), _)
            | (OKeyword::While, Some(OKeyword::Do), _) => self.close(this, label),
            // A `repeat` has neither.
            (OKeyword::Break | OKeyword::Continue, Some(OKeyword::While | OKeyword::Do), Some(open)) => {
                self.set(this, |entry| entry.head = open.head);
            }
            (OKeyword::If | OKeyword::While | OKeyword::Do | OKeyword::Repeat, _, _) => {
                if self.scope().known.contains_key(&label) {
                    self.reuse(this);
                }
                let open = Open { head: this, last: this };
                self.scope().known.entry(label).or_default().push(open);
            }
            _ => {}
        }
    }

    fn close(&mut self, this: u32, label: u32) {
        if let Some(open) = self.scope().close(label) {
            self.set(open.head, |head| head.end = this);
            self.set(this, |entry| entry.head = open.head);
        }
    }
}
