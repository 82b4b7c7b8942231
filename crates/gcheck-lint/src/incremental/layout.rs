//! Where things stand in a file that is edited: names for blocks and bytes that stay while text in front of them comes and goes.
//!
//! Knows: chunks, how many blocks each has, what an edit left of them. Must not know: what blocks are.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use gcheck_engine::At;

/// The file index under which a block of the main file stands by its name.
const NAMED: u32 = u32::MAX;
/// The name of what stands behind the last block or byte.
const BEHIND: u64 = u64::MAX;

/// A chunk of the file as the layout takes it.
#[derive(Debug, Clone)]
pub(crate) struct ChunkShape {
    /// Its text.
    pub text: Arc<str>,
    /// Its blocks in the part that the control reads.
    pub blocks: u32,
}

/// Names in order, as runs of numbers that follow each other: the first, and how many.
#[derive(Debug, Clone, Default)]
struct Runs(Vec<(u64, u32)>);

impl Runs {
    fn push(&mut self, first: u64, len: u32) {
        match self.0.last_mut() {
            Some((last, count)) if *last + u64::from(*count) == first => *count += len,
            _ if len == 0 => {}
            _ => self.0.push((first, len)),
        }
    }

    /// The name at an index.
    fn name(&self, index: u32) -> Option<u64> {
        let mut left = index;
        for (first, len) in &self.0 {
            if left < *len {
                return Some(first + u64::from(left));
            }
            left -= len;
        }
        None
    }

    /// Where a name stands.
    fn find(&self, name: u64) -> Option<u32> {
        let mut before = 0;
        for (first, len) in &self.0 {
            if (*first..first + u64::from(*len)).contains(&name) {
                return Some(before + (name - first) as u32);
            }
            before += len;
        }
        None
    }

    /// Adds the names of a range of another.
    fn extend(&mut self, other: &Self, range: Range<u32>) {
        let mut before = 0;
        for (first, len) in &other.0 {
            let start = range.start.max(before).min(before + len);
            let end = range.end.max(before).min(before + len);
            if start < end {
                self.push(first + u64::from(start - before), end - start);
            }
            before += len;
        }
    }
}

#[derive(Debug)]
struct Chunk {
    text: Arc<str>,
    /// Stands for the chunk as it is written now; never used again for another.
    slot: u32,
    /// Offset in the file.
    base: u32,
    /// Number of its first block.
    first: u32,
    blocks: u32,
    block_names: Runs,
    byte_names: Runs,
}

/// The chunks of a file, with names for what stands in them.
#[derive(Debug, Default)]
pub(crate) struct Layout {
    chunks: Vec<Chunk>,
    /// By slot: the index of its chunk, while that is as it was.
    slots: Vec<Option<u32>>,
    next_block: u64,
    next_byte: u64,
    /// By the first name of a run of blocks: the slot of its chunk.
    blocks: BTreeMap<u64, u32>,
    /// By the first name of a run of bytes: the slot of its chunk.
    bytes: BTreeMap<u64, u32>,
}

/// What is left of the chunks in the middle of a file, where something was changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Unchanged {
    /// Bytes at the start that are as they were.
    pub bytes_before: u32,
    /// Bytes at the end that are as they were.
    pub bytes_behind: u32,
    /// Blocks in whole lines at the start that are as they were.
    pub blocks_before: u32,
    /// Blocks in whole lines at the end that are as they were.
    pub blocks_behind: u32,
}

impl Layout {
    /// The chunks that differ from those of a new text: a range of the old ones, and the range of the new ones in their place.
    pub(crate) fn changed(&self, new: &[Arc<str>]) -> (Range<usize>, Range<usize>) {
        let same = |chunk: &Chunk, text: &Arc<str>| Arc::ptr_eq(&chunk.text, text) || chunk.text == *text;
        let before = self.chunks.iter().zip(new).take_while(|(chunk, text)| same(chunk, text)).count();
        let most = self.chunks.len().min(new.len()) - before;
        let pairs = self.chunks.iter().rev().zip(new.iter().rev()).take(most);
        let behind = pairs.take_while(|(chunk, text)| same(chunk, text)).count();
        (before..self.chunks.len() - behind, before..new.len() - behind)
    }

    /// Text of a range of chunks.
    pub(crate) fn text_of(&self, chunks: Range<usize>) -> String {
        self.chunks.get(chunks).unwrap_or_default().iter().map(|chunk| &*chunk.text).collect()
    }

    /// Puts new chunks in the place of old ones.
    pub(crate) fn replace(&mut self, old: Range<usize>, new: Vec<ChunkShape>, same: Unchanged) {
        let (mut blocks, mut bytes) = (Runs::default(), Runs::default());
        for chunk in self.chunks.get(old.clone()).unwrap_or_default() {
            for (first, len) in &chunk.block_names.0 {
                blocks.push(*first, *len);
                self.blocks.remove(first);
            }
            for (first, len) in &chunk.byte_names.0 {
                bytes.push(*first, *len);
                self.bytes.remove(first);
            }
            if let Some(slot) = self.slots.get_mut(chunk.slot as usize) {
                *slot = None;
            }
        }
        let count = |chunks: &[ChunkShape]| chunks.iter().map(|chunk| chunk.blocks).sum::<u32>();
        let size = |chunks: &[ChunkShape]| chunks.iter().map(|chunk| chunk.text.len() as u32).sum::<u32>();
        // Of what was rewritten, as many blocks as were there before keep their names: who remembers one of them compares what
        // it says elsewhere.
        let blocks =
            renamed(&blocks, count(&new), same.blocks_before, same.blocks_behind, true, &mut self.next_block);
        let bytes =
            renamed(&bytes, size(&new), same.bytes_before, same.bytes_behind, false, &mut self.next_byte);
        let (mut block, mut byte) = (0, 0);
        let mut chunks = Vec::with_capacity(new.len());
        for shape in new {
            let slot = self.slots.len() as u32;
            self.slots.push(None);
            let (mut block_names, mut byte_names) = (Runs::default(), Runs::default());
            block_names.extend(&blocks, block..block + shape.blocks);
            byte_names.extend(&bytes, byte..byte + shape.text.len() as u32);
            block += shape.blocks;
            byte += shape.text.len() as u32;
            self.blocks.extend(block_names.0.iter().map(|(first, _)| (*first, slot)));
            self.bytes.extend(byte_names.0.iter().map(|(first, _)| (*first, slot)));
            let ChunkShape { text, blocks } = shape;
            chunks.push(Chunk { text, slot, base: 0, first: 0, blocks, block_names, byte_names });
        }
        let from = old.start;
        self.chunks.splice(old, chunks);
        self.number(from);
    }

    /// The number of blocks of a chunk is another, though its text is the same: the part that the control reads has changed.
    pub(crate) fn has_blocks(&self, chunk: usize, blocks: u32) -> bool {
        self.chunks.get(chunk).is_some_and(|chunk| chunk.blocks == blocks)
    }

    fn number(&mut self, from: usize) {
        let before = from.checked_sub(1).and_then(|last| self.chunks.get(last));
        let (mut base, mut first) =
            before.map_or((0, 0), |last| (last.base + last.text.len() as u32, last.first + last.blocks));
        for (index, chunk) in self.chunks.iter_mut().enumerate().skip(from) {
            (chunk.base, chunk.first) = (base, first);
            base += chunk.text.len() as u32;
            first += chunk.blocks;
            if let Some(slot) = self.slots.get_mut(chunk.slot as usize) {
                *slot = Some(index as u32);
            }
        }
    }

    /// How many chunks there are.
    pub(crate) fn len(&self) -> usize {
        self.chunks.len()
    }

    /// Slots used so far, in which every edit leaves some without use.
    pub(crate) fn slots(&self) -> usize {
        self.slots.len()
    }

    /// Is the chunk of a slot still as it was?
    pub(crate) fn is_there(&self, slot: u32) -> bool {
        self.slots.get(slot as usize).is_some_and(Option::is_some)
    }

    /// The slot of a chunk.
    pub(crate) fn slot(&self, chunk: usize) -> Option<u32> {
        self.chunks.get(chunk).map(|chunk| chunk.slot)
    }

    fn of_slot(&self, slot: u32) -> Option<&Chunk> {
        self.chunks.get((*self.slots.get(slot as usize)?)? as usize)
    }

    /// A place in bytes as slot and offset in its chunk. The end of a chunk belongs to it when `is_end`.
    pub(crate) fn inside(&self, byte: u32, is_end: bool) -> Option<(u32, u32)> {
        let probe = if is_end { byte.saturating_sub(1) } else { byte };
        let index = self.chunks.partition_point(|chunk| chunk.base <= probe).checked_sub(1)?;
        let chunk = self.chunks.get(index)?;
        Some((chunk.slot, byte - chunk.base))
    }

    /// The place of a slot's offset in bytes.
    pub(crate) fn outside(&self, slot: u32, offset: u32) -> Option<u32> {
        Some(self.of_slot(slot)?.base + offset)
    }

    /// A run of blocks of the main file by slots.
    pub(crate) fn runs_inside(&self, mut blocks: Range<u32>, mut take: impl FnMut(u32, Range<u32>)) {
        while blocks.start < blocks.end {
            let Some(chunk) = self.chunk_of_block(blocks.start) else { return };
            let end = blocks.end.min(chunk.first + chunk.blocks);
            take(chunk.slot, blocks.start - chunk.first..end - chunk.first);
            blocks.start = end;
        }
    }

    /// The blocks of a run in a slot.
    pub(crate) fn run_outside(&self, slot: u32, run: &Range<u32>) -> Option<Range<u32>> {
        let chunk = self.of_slot(slot)?;
        Some(chunk.first + run.start..chunk.first + run.end)
    }

    fn chunk_of_block(&self, block: u32) -> Option<&Chunk> {
        let behind = self.chunks.partition_point(|chunk| chunk.first <= block);
        self.chunks.get(behind.checked_sub(1)?).filter(|chunk| block - chunk.first < chunk.blocks)
    }

    /// Gives a block of the main file its name.
    pub(crate) fn name(&self, at: &mut At) {
        if at.file == 0 {
            let name = self
                .chunk_of_block(at.block)
                .and_then(|chunk| chunk.block_names.name(at.block - chunk.first))
                .unwrap_or(BEHIND);
            *at = At { file: NAMED, block: name as u32 };
        }
    }

    /// Gives a named block its number again. `false`: it is not there any more.
    pub(crate) fn number_again(&self, at: &mut At) -> bool {
        if at.file != NAMED {
            return true;
        }
        let number = if at.block == BEHIND as u32 {
            self.chunks.last().map(|chunk| chunk.first + chunk.blocks)
        } else {
            let name = u64::from(at.block);
            let slot = self.blocks.range(..=name).next_back().map(|(_, slot)| *slot);
            slot.and_then(|slot| self.of_slot(slot))
                .and_then(|chunk| Some(chunk.first + chunk.block_names.find(name)?))
        };
        let is_there = number.is_some();
        *at = At { file: 0, block: number.unwrap_or(0) };
        is_there
    }

    /// The names of the first and the last byte of a range.
    pub(crate) fn name_bytes(&self, range: &Range<u32>) -> [u64; 2] {
        let last = if range.end > range.start { self.byte_name(range.end - 1) } else { BEHIND };
        [self.byte_name(range.start), last]
    }

    fn byte_name(&self, byte: u32) -> u64 {
        let behind = self.chunks.partition_point(|chunk| chunk.base <= byte);
        let chunk = behind.checked_sub(1).and_then(|index| self.chunks.get(index));
        chunk.and_then(|chunk| chunk.byte_names.name(byte - chunk.base)).unwrap_or(BEHIND)
    }

    /// The range of two named bytes; `None` when one of them is not there any more.
    pub(crate) fn bytes_again(&self, [first, last]: [u64; 2]) -> Option<Range<u32>> {
        let start = match first {
            BEHIND => self.chunks.last().map_or(0, |chunk| chunk.base + chunk.text.len() as u32),
            name => self.byte_number(name)?,
        };
        let end = match last {
            BEHIND => start,
            name => self.byte_number(name)? + 1,
        };
        (start <= end).then_some(start..end)
    }

    fn byte_number(&self, name: u64) -> Option<u32> {
        let (_, slot) = self.bytes.range(..=name).next_back()?;
        let chunk = self.of_slot(*slot)?;
        Some(chunk.base + chunk.byte_names.find(name)?)
    }
}

/// Names of what stands in the place of `old`: those at both ends stay, and in between they are new, but for as many as stood
/// there before when `keeps` says so.
fn renamed(old: &Runs, len: u32, before: u32, behind: u32, keeps: bool, next: &mut u64) -> Runs {
    let old_len: u32 = old.0.iter().map(|(_, len)| len).sum();
    let before = before.min(len).min(old_len);
    let behind = behind.min(len - before).min(old_len - before);
    let (middle, old_middle) = (len - before - behind, old_len - before - behind);
    let kept = if keeps { middle.min(old_middle) } else { 0 };
    let mut names = Runs::default();
    names.extend(old, 0..before + kept);
    if middle > kept {
        // Runs of new names do not follow those given before, so that a run never spans what two edits made.
        names.0.push((*next, middle - kept));
        *next += u64::from(middle - kept) + 1;
    }
    let mut tail = Runs::default();
    tail.extend(old, old_len - behind..old_len);
    for (first, len) in tail.0 {
        names.push(first, len);
    }
    names
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use gcheck_engine::At;

    use super::{ChunkShape, Layout, Unchanged};

    const NOTHING: Unchanged =
        Unchanged { bytes_before: 0, bytes_behind: 0, blocks_before: 0, blocks_behind: 0 };

    fn shape(text: &str) -> ChunkShape {
        ChunkShape { text: Arc::from(text), blocks: text.lines().count() as u32 }
    }

    fn layout(chunks: &[&str]) -> Layout {
        let mut layout = Layout::default();
        layout.replace(0..0, chunks.iter().map(|text| shape(text)).collect(), NOTHING);
        layout
    }

    #[test]
    fn a_block_keeps_its_name_while_lines_are_put_in_above() {
        let mut layout = layout(&["A\nB\n", "C\nD\n"]);
        let mut block = At { file: 0, block: 3 };
        layout.name(&mut block);
        let bytes = layout.name_bytes(&(2..3));
        let same = Unchanged { bytes_before: 2, bytes_behind: 2, blocks_before: 1, blocks_behind: 1 };
        layout.replace(0..1, vec![shape("A\nX\nY\nB\n")], same);
        assert!(layout.number_again(&mut block));
        assert_eq!(block, At { file: 0, block: 5 });
        assert_eq!(layout.bytes_again(bytes), Some(6..7));
    }

    #[test]
    fn what_was_deleted_is_not_found() {
        let mut layout = layout(&["A\nB\n", "C\nD\n"]);
        let mut block = At { file: 0, block: 1 };
        layout.name(&mut block);
        let bytes = layout.name_bytes(&(2..3));
        let same = Unchanged { bytes_before: 2, bytes_behind: 0, blocks_before: 1, blocks_behind: 0 };
        layout.replace(0..1, vec![shape("A\n")], same);
        assert!(!layout.number_again(&mut block));
        assert_eq!(layout.bytes_again(bytes), None);
    }

    #[test]
    fn chunks_that_are_cut_anew_keep_their_names() {
        let mut layout = layout(&["A\nB\n", "C\nD\n"]);
        let mut names: Vec<At> = (0..4).map(|block| At { file: 0, block }).collect();
        for at in &mut names {
            layout.name(at);
        }
        let same = Unchanged { bytes_before: 8, bytes_behind: 0, blocks_before: 4, blocks_behind: 0 };
        layout.replace(0..2, vec![shape("A\n"), shape("B\nC\nD\n")], same);
        assert!(names.iter_mut().all(|at| layout.number_again(at)));
        assert_eq!(names.iter().map(|at| at.block).collect::<Vec<_>>(), [0, 1, 2, 3]);
        assert_eq!(layout.inside(2, true).map(|(_, at)| at), Some(2));
        assert_eq!(layout.inside(2, false).map(|(_, at)| at), Some(0));
    }
}
