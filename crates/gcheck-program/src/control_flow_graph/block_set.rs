//! A set of block numbers that costs little where they are few and less where they are many.
//!
//! Knows: numbers. Must not know: what a block in the set is.

/// How many blocks a group covers.
const GROUP: u32 = u32::BITS;

/// Block numbers, as bits in groups; only groups with a member are kept, in order.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct BlockSet {
    /// Number of the group, and its members.
    groups: Vec<(u32, u32)>,
}

impl BlockSet {
    /// Adds a block that is not below the greatest one in the set. (A lesser one must come by [`BlockSet::merge`].)
    pub(super) fn push(&mut self, block: u32) {
        let (group, bit) = (block / GROUP, 1 << (block % GROUP));
        match self.groups.last_mut() {
            Some((last, bits)) if *last == group => *bits |= bit,
            last => {
                debug_assert!(last.is_none_or(|(last, _)| *last < group), "blocks come in order");
                self.groups.push((group, bit));
            }
        }
    }

    /// Adds blocks that may lie anywhere.
    pub(super) fn merge(&mut self, mut blocks: Vec<u32>) {
        blocks.sort_unstable();
        let mut other = Self::default();
        for block in blocks {
            other.push(block);
        }
        self.groups.append(&mut other.groups);
        self.groups.sort_unstable_by_key(|(group, _)| *group);
        self.groups.dedup_by(|later, earlier| {
            let is_same = later.0 == earlier.0;
            if is_same {
                earlier.1 |= later.1;
            }
            is_same
        });
        self.groups.shrink_to_fit();
    }

    /// Gives back what growing has reserved.
    pub(super) fn shrink(&mut self) {
        self.groups.shrink_to_fit();
    }

    pub(super) fn contains(&self, block: u32) -> bool {
        self.next_from(block) == Some(block)
    }

    /// The least member that is not below `block`.
    pub(super) fn next_from(&self, block: u32) -> Option<u32> {
        let group = block / GROUP;
        let at = self.groups.partition_point(|(number, _)| *number < group);
        let rest = self.groups.get(at..).unwrap_or_default();
        rest.iter().take(2).find_map(|(number, bits)| {
            let below = if *number == group { (1 << (block % GROUP)) - 1 } else { 0 };
            let bits = bits & !below;
            (bits != 0).then(|| number * GROUP + bits.trailing_zeros())
        })
    }

    /// Bytes on the heap.
    #[cfg(test)]
    pub(super) fn heap_bytes(&self) -> usize {
        self.groups.capacity() * size_of::<(u32, u32)>()
    }
}

#[cfg(test)]
mod tests {
    use super::BlockSet;

    fn members(set: &BlockSet) -> Vec<u32> {
        let mut all = Vec::new();
        let mut from = 0;
        while let Some(block) = set.next_from(from) {
            all.push(block);
            from = block + 1;
        }
        all
    }

    #[test]
    fn members_come_back_in_order() {
        let mut set = BlockSet::default();
        for block in [0, 31, 32, 33, 33, 1000] {
            set.push(block);
        }
        assert_eq!(members(&set), [0, 31, 32, 33, 1000]);
        assert!(set.contains(31) && !set.contains(30) && !set.contains(1001));
    }

    #[test]
    fn late_members_find_their_place() {
        let mut set = BlockSet::default();
        set.push(40);
        set.push(u32::MAX);
        set.merge(vec![70, 5, 41, 40]);
        assert_eq!(set.next_from(71), Some(u32::MAX));
        assert_eq!([0, 6, 41, 42].map(|from| set.next_from(from)), [Some(5), Some(40), Some(41), Some(70)]);
    }

    #[test]
    fn an_empty_set_has_no_member() {
        assert_eq!(BlockSet::default().next_from(0), None);
        assert!(!BlockSet::default().contains(u32::MAX));
    }
}
