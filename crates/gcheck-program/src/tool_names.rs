//! What a program calls its tools: a remark beside the tool change, a list at the head of the program, a remark above the
//! change.
//!
//! Knows: where such remarks are and how lists are written. Must not know: what tools do.

use std::collections::BTreeMap;

use gcheck_controls::{Control, Effect, Letter, LetterSet};

use crate::block::{Block, BlockFlags, BlockTable, Word};

/// Remarks longer than this are cut: they are names, not instructions.
const LONGEST: usize = 100;

/// How sure a remark is to be the tool's name. The better one wins, of equals the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// On a line of its own above the tool change: often the name of the operation.
    Above,
    /// Beside a `T` that only calls for the tool.
    BesideCall,
    /// In a list: `(T1 D=10. FLAT END MILL)`.
    List,
    /// Beside the tool change.
    BesideChange,
}

/// Names of tools by number, gathered block by block.
#[derive(Debug)]
pub struct ToolNames<'c> {
    control: &'c Control,
    names: BTreeMap<u32, (Place, String)>,
    /// The remark of the block before, when it has nothing else.
    above: Option<String>,
    /// The tool called for last.
    called: Option<u32>,
}

impl<'c> ToolNames<'c> {
    /// Knows no names yet.
    pub fn new(control: &'c Control) -> Self {
        Self { control, names: BTreeMap::new(), above: None, called: None }
    }

    /// What a tool is called.
    pub fn get(&self, tool: u32) -> Option<&str> {
        self.names.get(&tool).map(|(_, name)| name.as_str())
    }

    /// Looks at the blocks of the next chunk, with its text.
    pub fn look(&mut self, table: &BlockTable, text: &str) {
        let interesting =
            |block: &Block| block.flags.contains(BlockFlags::COMMENT) || block.letters.intersects(LETTERS);
        for (_, block) in table.blocks() {
            if !interesting(block) {
                if !block.letters.is_empty() {
                    self.pass_over();
                }
                continue;
            }
            let remark = block
                .flags
                .contains(BlockFlags::COMMENT)
                .then(|| text.get(block.range.start as usize..block.range.end as usize).and_then(remark))
                .flatten();
            self.block(table, block, remark);
        }
    }

    /// Passes over blocks with words that have neither a remark nor anything of tools: what is above them names no tool
    /// behind them.
    pub fn pass_over(&mut self) {
        self.above = None;
    }

    fn block(&mut self, table: &BlockTable, block: &Block, remark: Option<&str>) {
        let words = table.words(block);
        let mut changes = false;
        let mut has_arguments = false;
        for word in words {
            let effect = self.control.code_at(word.code).map_or(Effect::None, gcheck_controls::Code::effect);
            changes |= effect == Effect::ToolChange;
            has_arguments |= effect.calls_macro();
        }
        let tools = &self.control.semantics().tools;
        let t = words.iter().find(|word| word.letter == Letter::of('T')).filter(|_| !has_arguments);
        let t = t.and_then(Word::integer).map(|t| if tools.offset_in_t { t / 100 } else { t });
        changes |= t.is_some() && tools.change_by_t;
        self.called = t.or(self.called);
        if let Some((tool, name)) = remark.and_then(entry) {
            self.name(tool, Place::List, name);
        }
        if let Some(tool) = t.or(self.called.filter(|_| changes)) {
            match remark {
                Some(remark) => {
                    self.name(tool, if changes { Place::BesideChange } else { Place::BesideCall }, remark);
                }
                None => {
                    if let Some(above) = self.above.take() {
                        self.name(tool, Place::Above, &above);
                    }
                }
            }
        }
        // A sequence number and the O of a program leave a remark what it is.
        let has_code = words.iter().any(|word| !matches!(word.letter.ascii(), b'N' | b'O'));
        let is_head = block.letters.contains(Letter::of('O'));
        self.above = remark.filter(|_| !has_code && !is_head).map(str::to_owned);
    }

    fn name(&mut self, tool: u32, place: Place, name: &str) {
        let name: String = name.trim().chars().take(LONGEST).collect();
        let better = |(known, _): &(Place, String)| place > *known;
        if !name.is_empty() && self.names.get(&tool).is_none_or(better) {
            self.names.insert(tool, (place, name));
        }
    }
}

const LETTERS: LetterSet = LetterSet::of("TM");

/// The text of a block's first comment, without what encloses it; `None` without one, or when it is empty.
pub fn remark(block: &str) -> Option<&str> {
    let at = block.find(['(', ';'])?;
    let rest = block.get(at + 1..)?;
    let inner = if block.as_bytes().get(at) == Some(&b'(') { rest.split(')').next()? } else { rest };
    let inner = inner.trim();
    (!inner.is_empty()).then_some(inner)
}

/// A line of a list: `T1 D=10. FLAT END MILL`, `T01 | 1/2 DRILL | H1`, `TOOL 3 - REAMER`; the number, and what follows.
fn entry(remark: &str) -> Option<(u32, &str)> {
    let upper = remark.get(..4).map(str::to_ascii_uppercase);
    let rest = match upper.as_deref() {
        Some("TOOL") => remark.get(4..)?.trim_start_matches([' ', '#', ':', '-', '=']),
        _ => remark.strip_prefix(['T', 't'])?,
    };
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let number = rest.get(..end)?.parse().ok()?;
    let name = rest.get(end..)?;
    // `T1000X2` is not an entry, nor `T5.`
    if !name.starts_with([' ', '\t', '|', ':', '-', '=', ',', ';']) {
        return None;
    }
    let name = name.trim_start_matches([' ', '\t', '|', ':', '-', '=', ',', ';']).trim();
    (!name.is_empty()).then_some((number, name))
}

#[cfg(test)]
mod tests {
    use super::ToolNames;
    use crate::{Dialect, Loaded};

    fn check(control: &str, program: &str, expected: &[(u32, &str)]) {
        let control = gcheck_controls::load(control).unwrap();
        let mut names = ToolNames::new(&control);
        let _ = Loaded::new(program, &Dialect::new(&control), |_, table, part| names.look(table, part));
        let found: Vec<(u32, &str)> =
            names.names.iter().map(|(tool, (_, name))| (*tool, name.as_str())).collect();
        assert_eq!(found, expected, "{program}");
    }

    #[test]
    fn beside_the_change() {
        check("haas-mill", "T1 M6 (END MILL)\nT2 M6\nM6 T3 (TAP)\n", &[(1, "END MILL"), (3, "TAP")]);
        check("haas-mill", "T1 (NEXT)\nM6 (END MILL)\n", &[(1, "END MILL")]);
        check("linuxcnc", "t1 m6 ; end mill\n", &[(1, "end mill")]);
        check("haas-lathe", "T0303 (GROOVER)\n", &[(3, "GROOVER")]);
    }

    #[test]
    fn above_the_change_unless_something_stands_between() {
        check("haas-mill", "(FACE)\nT1 M6\n", &[(1, "FACE")]);
        check("haas-mill", "(FACE)\nN10 T1 M6\n", &[(1, "FACE")]);
        check("haas-mill", "(FACE)\nG0 G53 Z0.\nT1 M6\n", &[]);
        check("haas-mill", "O0001 (PART 7)\nT1 M6\n", &[]);
    }

    #[test]
    fn a_list_is_better_than_what_stands_above() {
        check(
            "haas-mill",
            "(T1 D=10. CR=0. - FLAT END MILL)\n(T02 | DRILL | H2)\n(TOOL 3: REAMER)\n(FACING)\nT1 M6\n(HOLES)\nT2 M6\n",
            &[(1, "D=10. CR=0. - FLAT END MILL"), (2, "DRILL | H2"), (3, "REAMER")],
        );
        check("haas-mill", "(T1 ONE)\nT1 M6 (TWO)\n", &[(1, "TWO")]);
    }

    #[test]
    fn arguments_of_a_macro_call_are_no_tools() {
        check("haas-mill", "G65 P9000 T5 (PROBE)\n", &[]);
    }

    #[test]
    fn what_only_looks_like_an_entry_is_none() {
        check("haas-mill", "(T-SLOT)\n(T12X5)\n(TAPER)\n(TOOL)\n(T)\n()\n(\nT1 M6\n", &[]);
    }
}
