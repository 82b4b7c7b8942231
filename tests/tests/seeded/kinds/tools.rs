//! Mistakes with tools, their offsets and the work offset.
//!
//! Knows: how each is made. Must not know: the findings about it.

use gcheck_controls::Effect;

use crate::kind::{Fear, Kind};
use crate::program::{Block, Program, Word};

const COMPENSATION: [Effect; 2] = [Effect::CompensationLeft, Effect::CompensationRight];

/// `G43` with an `H` that is the number of the tool.
fn length(block: &Block) -> Option<(&Word, &Word)> {
    let (code, offset) = (block.code(&[Effect::LengthPlus])?, block.word(b'H')?);
    (offset.number == block.before.tool).then_some((code, offset))
}

/// Cutter compensation by offset number on a mill.
fn diameter<'b>(p: &Program, block: &'b Block) -> Option<&'b Word> {
    block.code(&COMPENSATION).filter(|_| !p.is_lathe())?;
    block.word(b'D')
}

/// The tool moves in Z before another tool comes.
fn goes_down(p: &Program, block: &Block) -> bool {
    let mut rest = p.behind(block).iter().take_while(|next| next.before.section == block.after.section);
    block.has(b"Z") || rest.any(|next| next.moves(&[Effect::Rapid, Effect::Linear]) && next.has(b"Z"))
}

pub(super) const KINDS: &[Kind] = &[
    Kind::new(
        "length-forgotten",
        Fear::Crash,
        "length compensation is forgotten after a tool change (no `G43`): the tool works without length, or with the one of the tool before",
        &["tool-length-missing", "length-offset-of-another-tool", "length-cancelled-before-cut"],
        |p| {
            p.each(|block| {
                let (code, offset) = length(block).filter(|_| goes_down(p, block) && block.before.section > 0)?;
                Some(vec![p.without(code), p.without(offset)])
            })
        },
    )
    .anywhere(),
    Kind::new(
        "length-after-approach",
        Fear::Crash,
        "the tool approaches in Z before length compensation is on",
        &["tool-length-missing", "length-offset-of-another-tool"],
        |p| {
            p.each(|block| {
                length(block)?;
                let above = p.previous(block).filter(|above| above.moves(&[Effect::Rapid]) && !above.has(b"Z"))?;
                let fits = above.before.section > 0 && !above.before.has_length && above.code(&[Effect::LengthPlus]).is_none();
                fits.then(|| p.behind_words(above, "Z1."))
            })
        },
    ),
    Kind::new(
        "length-without-number",
        Fear::Crash,
        "`G43` without `H`",
        &["required-word-missing", "lasting-word-never-given", "length-offset-of-another-tool"],
        |p| {
            p.each(|block| {
                let (_, offset) = length(block)?;
                // LinuxCNC takes the length of the tool in the spindle then.
                (!p.is_for(&["linuxcnc"])).then(|| p.without(offset))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "length-number-zero",
        Fear::Crash,
        "`G43 H00`: no length at all",
        &["tool-length-missing", "length-offset-of-another-tool", "length-offset-zero"],
        |p| p.each(|block| length(block).filter(|_| !p.is_for(&["linuxcnc"]) && goes_down(p, block)).map(|(_, offset)| p.value(offset, "00"))),
    )
    .anywhere(),
    Kind::new(
        "length-of-another-tool",
        Fear::Crash,
        "`H` of another tool of the program",
        &["length-offset-of-another-tool"],
        |p| {
            p.each(|block| {
                let (_, offset) = length(block)?;
                let mut others = p.blocks.iter().filter_map(|other| length(other)?.1.number);
                let other = others.rfind(|other| Some(*other) != offset.number)?;
                Some(p.value(offset, format!("{other:02}")))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "length-of-no-tool",
        Fear::Crash,
        "a digit of `H` is mistyped, and no tool of the program has that offset",
        &["length-offset-of-another-tool"],
        |p| {
            let tools = p.blocks.iter().filter(|block| length(block).is_some()).count();
            p.each(|block| {
                let (_, offset) = length(block).filter(|_| tools > 2)?;
                Some(p.value(offset, format!("{:02}", offset.number? + 30.0)))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "length-subtracted",
        Fear::Crash,
        "`G44` is typed for `G43`: the length of one tool is subtracted",
        &["length-subtracted", "unknown-code"],
        |p| {
            let tools = p.blocks.iter().filter(|block| length(block).is_some()).count();
            p.each(|block| length(block).filter(|_| tools > 1).map(|(code, _)| p.instead(code, "G44")))
        },
    ),
    Kind::new(
        "tool-mistyped",
        Fear::Crash,
        "the number of another tool of the program is typed at a tool change",
        &["length-offset-of-another-tool", "diameter-offset-of-another-tool", "tool-comment-of-another-tool"],
        |p| {
            p.each(|block| {
                let tool = block.word(b'T').filter(|_| block.code(&[Effect::ToolChange]).is_some())?;
                let mut section = p.behind(block).iter().take_while(|next| next.before.section == block.after.section);
                let works = section.any(|next| length(next).is_some_and(|(_, offset)| offset.number == tool.number));
                let mut others = p.blocks.iter().filter_map(|other| length(other)?.1.number);
                let other = others.rfind(|other| Some(*other) != tool.number).filter(|_| works && goes_down(p, block))?;
                Some(p.value(tool, format!("{other}")))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "diameter-of-another-tool",
        Fear::Scrap,
        "`D` of another tool of the program",
        &["diameter-offset-of-another-tool"],
        |p| {
            p.each(|block| {
                let offset = diameter(p, block).filter(|word| word.number == block.before.tool)?;
                let mut others = p.blocks.iter().filter_map(|other| length(other)?.1.number);
                let other = others.rfind(|other| Some(*other) != offset.number)?;
                Some(p.value(offset, format!("{other:02}")))
            })
        },
    )
    .anywhere(),
    Kind::new(
        "diameter-left-out",
        Fear::Scrap,
        "`G41` without `D`",
        &["required-word-missing", "lasting-word-never-given", "compensation-offset-missing", "diameter-offset-of-another-tool"],
        |p| {
            p.each(|block| {
                let offset = diameter(p, block).filter(|_| !p.is_for(&["linuxcnc"]))?;
                let given = p.blocks[..block.ix].iter().any(|before| before.has(b"D"));
                (!given).then(|| p.without(offset))
            })
        },
    ),
    Kind::new(
        "diameter-number-zero",
        Fear::Scrap,
        "`G41 D00`: the tool's middle runs on the contour",
        &["compensation-offset-missing"],
        |p| p.each(|block| diameter(p, block).filter(|_| !p.is_for(&["linuxcnc"])).map(|offset| p.value(offset, "00"))),
    ),
    Kind::new(
        "tool-not-changed",
        Fear::Crash,
        "a tool is called and not changed in (no `M06`)",
        &["tool-called-not-changed"],
        |p| {
            p.each(|block| {
                let change = block.code(&[Effect::ToolChange]).filter(|_| block.word(b'T').is_some_and(|tool| tool.number != Some(0.0)))?;
                let changes = p.blocks.iter().filter(|other| other.code(&[Effect::ToolChange]).is_some()).count();
                (!p.is_lathe() && changes > 1).then(|| p.without(change))
            })
        },
    ),
    Kind::new(
        "change-without-tool",
        Fear::Crash,
        "a tool change without a tool called (no `T`)",
        &["tool-change-without-t"],
        |p| {
            p.each(|block| {
                let tool = block.word(b'T').filter(|_| block.code(&[Effect::ToolChange]).is_some())?;
                // A tool that was called before the last change is changed in again.
                let called = p.blocks[..block.ix].iter().rev().take_while(|before| before.code(&[Effect::ToolChange]).is_none()).any(|before| before.has(b"T"));
                (!called).then(|| p.without(tool))
            })
        },
    ),
    Kind::new(
        "tool-not-there",
        Fear::Alarm,
        "a tool that the machine does not have",
        &["tool-not-in-table", "number-out-of-range"],
        |p| {
            p.each(|block| {
                let tool = block.word(b'T').filter(|_| block.code(&[Effect::ToolChange]).is_some())?;
                p.is_for(&["haas"]).then(|| p.value(tool, "9999"))
            })
        },
    )
    .with_machine(),
    Kind::new(
        "offset-never-chosen",
        Fear::Crash,
        "no work offset is chosen before the first move",
        &["work-offset-never-chosen", "work-offset-not-chosen"],
        |p| {
            let offsets = p.blocks.iter().filter_map(|block| {
                let word = block.words.iter().find(|w| matches!(w.effect, Some(Effect::WorkOffset(_) | Effect::WorkOffsetByP(_))))?;
                Some(p.without(word))
            });
            let all: Vec<_> = offsets.collect();
            // The tools of a turret carry the part's place in their own offsets; where each end of a program brings back the
            // first work offset, a program that uses no other means that one, with or without a word of it.
            let semantics = p.facts.semantics();
            let comes_back = semantics.at_end.iter().any(|code| code == "G54") && semantics.tools.change_by_t;
            let is_first = |word: &&Word| !matches!(word.effect, Some(Effect::WorkOffset(2..) | Effect::WorkOffsetByP(_)));
            let is_only_first = p.blocks.iter().flat_map(|block| &block.words).all(|word| is_first(&word));
            if all.is_empty() || comes_back && is_only_first { Vec::new() } else { vec![all.into()] }
        },
    )
    .anywhere(),
    Kind::new(
        "offset-of-another-part",
        Fear::Crash,
        "one tool works in another work offset than the others",
        &["work-offset-of-one-tool", "work-offset-not-listed"],
        |p| {
            let changes = p.blocks.iter().filter(|block| block.code(&[Effect::WorkOffset(1)]).is_some());
            if changes.count() < 2 {
                return Vec::new();
            }
            let chooses = |block: &&Block| {
                block.words.iter().any(|w| matches!(w.effect, Some(Effect::WorkOffset(_) | Effect::WorkOffsetByP(_))))
            };
            p.each(|block| {
                // Chosen again before the tool moves, it is right again.
                let next = p.behind(block).iter().find(|next| chooses(next) || next.moves(&[Effect::Rapid, Effect::Linear]));
                let is_mended = !block.has(b"XYZ") && next.is_some_and(|next| chooses(&next));
                block.code(&[Effect::WorkOffset(1)]).filter(|_| !is_mended).map(|word| p.instead(word, "G56"))
            })
        },
    )
    .anywhere(),
];
