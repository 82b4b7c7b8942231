//! Comments that say what a tool is.
//!
//! Knows: which comments belong to a tool, and how lists of tools at the head of a program are written. Must not know: any
//! rule, what kinds of tools there are.

use std::rc::Rc;

use gcheck_engine::{Abstract, At, Domain, Fact, Units};
use gcheck_geometry::Mm;
use gcheck_program::BlockFlags;

use crate::PathCx;
use crate::facts::offset_schemes::whole;

/// Blocks at the head of a program that are searched for a list of its tools.
pub(crate) const HEAD: u32 = 100;

/// What comments say of a tool.
#[derive(Debug)]
pub(crate) struct ToolComment {
    /// The block of the comment.
    pub(crate) at: At,
    /// Its words, in capitals.
    pub(crate) words: Vec<String>,
    text: String,
}

impl ToolComment {
    /// Is one of these words in it?
    pub(crate) fn has(&self, names: &[&str]) -> bool {
        self.words.iter().any(|word| names.contains(&word.as_str()))
    }

    /// Does it name a tool that cuts counter-clockwise?
    pub(crate) fn is_left_hand(&self) -> bool {
        // `M12X1.75LH`, and `M12X1.75L`: `100L` is a length.
        let is_left_thread = |word: &str| {
            let word = word.to_ascii_uppercase();
            let names_thread = word.starts_with('M') && word.contains(['X', '-']);
            let size = word.strip_suffix("LH").or_else(|| word.strip_suffix('L').filter(|_| names_thread));
            size.is_some_and(|size| size.ends_with(|c: char| c.is_ascii_digit()))
        };
        let mut words = self.text.split(|c: char| c.is_whitespace() || matches!(c, '(' | ')' | ',' | ';'));
        self.has(&["LH", "L", "LEFT", "LEFTHAND", "REVERSE", "CCW", "M4", "M04"]) || words.any(is_left_thread)
    }

    /// The radius of a nose that it gives (`R0.8`, in the units of the program), or that of a round insert by its code
    /// (`RCMT 12`, `RCMT1204`), whose first two digits are its diameter in millimetres.
    pub(crate) fn nose_radius(&self, units: Option<Units>) -> Option<Mm> {
        let upper = self.text.to_ascii_uppercase();
        let ends = |c: char| c.is_whitespace() || matches!(c, ',' | ':' | ';' | '|' | '=' | '-');
        let tokens: Vec<&str> = upper.split(ends).filter(|token| !token.is_empty()).collect();
        let two_digits = |text: &str| text.get(..2)?.parse::<f64>().ok();
        let of_insert = tokens.iter().enumerate().find_map(|(at, token)| {
            let own = round_insert(token)?;
            let size = if own.is_empty() { tokens.get(at + 1)? } else { own };
            Some(Mm(two_digits(size)? / 2.0))
        });
        let given = || {
            let radius = tokens.iter().find_map(|token| token.strip_prefix('R')?.parse::<f64>().ok())?;
            // A larger one is of the part, not of an insert.
            Some(Mm(radius * units?.in_mm())).filter(|radius| radius.0 <= LARGEST_NOSE)
        };
        of_insert.or_else(given).filter(|radius| radius.0 > 0.0 && radius.0.is_finite())
    }

    /// Does it name a round insert?
    pub(crate) fn names_round_insert(&self) -> bool {
        self.has(&["BUTTON", "ROUND"]) || self.words.iter().any(|word| round_insert(word).is_some())
    }

    /// The one size that it gives, as `10 MM`, `1/4 IN` or `DRILL 3/4`: of a drill or an end mill its diameter. `None` where it
    /// gives none or several, or says that it is the size of something else (`LEAVE .01 IN`). `D=12.`, as posts list their tools,
    /// counts in the units of the program.
    pub(crate) fn size(&self, units: Option<Units>) -> Option<Mm> {
        if self.has(&OTHER_SIZES) {
            return None;
        }
        let ends = |c: char| c.is_whitespace() || matches!(c, ',' | ':' | ';' | '|' | '=');
        let tokens: Vec<&str> = self.text.split(ends).filter(|token| !token.is_empty()).collect();
        let mut sizes = tokens.iter().enumerate().filter_map(|(at, token)| {
            let before = at.checked_sub(1).and_then(|before| tokens.get(before)).copied().unwrap_or_default();
            let next = tokens.get(at + 1).copied().unwrap_or_default();
            let is_diameter = matches!(before, "D" | "d" | "DIA" | "Dia" | "dia");
            let in_units =
                || Some(Mm(token.parse::<f64>().ok()? * units?.in_mm())).filter(|size| size.0 > 0.0);
            size(token, next, before.parse().unwrap_or(0)).or_else(|| in_units().filter(|_| is_diameter))
        });
        sizes.next().filter(|_| sizes.next().is_none())
    }
}

/// What follows the code of a round insert (`RCMT`, `RNMG`): `R`, the clearance, the tolerance, the way it is held.
fn round_insert(word: &str) -> Option<&str> {
    let rest = word.strip_prefix('R')?;
    let (code, size) = rest.split_at_checked(3)?;
    let is_one_of = |place: usize, letters: &str| {
        code.as_bytes().get(place).is_some_and(|letter| letters.as_bytes().contains(letter))
    };
    let is_code = is_one_of(0, "BCDENP") && is_one_of(1, "CEGHKMNU") && is_one_of(2, "AGMNTWX");
    (is_code && size.bytes().all(|byte| byte.is_ascii_digit())).then_some(size)
}

/// The largest nose radius that a comment gives as `R`: millimetres.
const LARGEST_NOSE: f64 = 8.0;
/// Words beside which a size is not a diameter.
const OTHER_SIZES: [&str; 32] = [
    "ALLOW",
    "ALLOWANCE",
    "CORNER",
    "CR",
    "DEEP",
    "DEPTH",
    "DOC",
    "FOR",
    "LEAVE",
    "LEAVES",
    "LENGTH",
    "LG",
    "LOC",
    "LONG",
    "OAL",
    "OFFSET",
    "OVERSIZE",
    "PITCH",
    "R",
    "RAD",
    "RADIUS",
    "REACH",
    "SHANK",
    "STEP",
    "STEPOVER",
    "STICKOUT",
    "STOCK",
    "THICK",
    "TOL",
    "TOLERANCE",
    "WEAR",
    "WOC",
];

/// What the comment of the tool in the spindle says.
pub(crate) fn comment_at_work(cx: &PathCx<'_>) -> Option<Rc<ToolComment>> {
    comment_of_tool(cx, cx.definitions().set_by(Fact::Tool)?)
}

/// What the comment of the tool says that a block put in: the one of its block, the tool's entry in a list at the head of the
/// program, or one alone in the block before or after.
pub(crate) fn comment_of_tool(cx: &PathCx<'_>, changed: At) -> Option<Rc<ToolComment>> {
    comment_of_number(cx, changed, Abstract::known(cx.state().tool()).and_then(whole))
}

/// The same, of a tool that is known by its number, and need not be in the spindle any more.
pub(crate) fn comment_of_number(cx: &PathCx<'_>, changed: At, tool: Option<u32>) -> Option<Rc<ToolComment>> {
    cx.from_text(changed, tool.unwrap_or(u32::MAX), || {
        // A comment alone near the change may name the operation: `(2D ADAPTIVE1)`.
        let own = comments_in(cx, changed).map(|text| (changed, text));
        let (at, text) = own.or_else(|| listed(cx, tool?)).or_else(|| beside(cx, changed))?;
        let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        let words = words.map(str::to_ascii_uppercase).collect();
        Some(Rc::new(ToolComment { at, words, text }))
    })
}

/// A comment that is alone in the block before or after a block.
fn beside(cx: &PathCx<'_>, changed: At) -> Option<(At, String)> {
    let is_alone =
        |at: &At| cx.place_of(*at).is_some_and(|place| place.table.words(place.block()).is_empty());
    let before = changed.block.checked_sub(1).map(|block| At { block, ..changed });
    let mut near = [before, Some(changed.next())].into_iter().flatten().filter(is_alone);
    near.find_map(|at| Some((at, comments_in(cx, at)?)))
}

/// `10MM`, `10` before `MM`, `.25"`, `1/4` before anything: a number with its unit, or a fraction, which is one of an inch. A whole
/// number before a fraction counts with it.
fn size(token: &str, next: &str, whole: u32) -> Option<Mm> {
    let digits = token.find(|c: char| !matches!(c, '0'..='9' | '.' | '/')).unwrap_or(token.len());
    let (number, suffix) = token.split_at_checked(digits)?;
    let unit = if suffix.is_empty() { next } else { suffix };
    let unit = unit.trim_end_matches('.').to_ascii_uppercase();
    let (value, is_fraction) = match number.split_once('/') {
        Some((above, below)) => {
            (f64::from(whole) + above.parse::<f64>().ok()? / below.parse::<f64>().ok()?, true)
        }
        None => (number.parse().ok()?, false),
    };
    let in_mm = match unit.as_str() {
        "MM" if !is_fraction => 1.0,
        "IN" | "INCH" | "\"" => 25.4,
        _ if is_fraction && suffix.is_empty() => 25.4,
        _ => return None,
    };
    Some(Mm(value * in_mm)).filter(|size| size.0 > 0.0 && size.0.is_finite())
}

/// The comments of a block of the main file.
pub(crate) fn comments_in(cx: &PathCx<'_>, at: At) -> Option<String> {
    let place = cx.place_of(at).filter(|_| at.file == 0)?;
    let block = place.block();
    if !block.flags.contains(BlockFlags::COMMENT) {
        return None;
    }
    let file = cx.program.file(0)?;
    let text = file.loaded.chunk_text(place.chunk);
    let text = text.get(block.range.start as usize..block.range.end as usize)?;
    Some(only_comments(text)).filter(|comments| !comments.trim().is_empty())
}

/// The text in parentheses, and what follows a semicolon.
fn only_comments(text: &str) -> String {
    let mut comments = String::new();
    let mut rest = text;
    while let Some(open) = rest.find(['(', ';']) {
        let (_, comment) = rest.split_at(open);
        let is_to_the_end = comment.starts_with(';');
        let comment = comment.get(1..).unwrap_or_default();
        let end = comment.find(')').filter(|_| !is_to_the_end).unwrap_or(comment.len());
        let (own, behind) = comment.split_at(end);
        comments.push_str(own);
        comments.push(' ');
        rest = behind;
    }
    comments
}

/// The entry of a tool in a list at the head of the program.
pub(crate) fn listed(cx: &PathCx<'_>, tool: u32) -> Option<(At, String)> {
    (0..HEAD).map(|block| At { file: 0, block }).find_map(|at| {
        let place = cx.place_of(at)?;
        // A list is in comments alone.
        let comments = comments_in(cx, at).filter(|_| place.table.words(place.block()).is_empty())?;
        let text = format!(" {comments}");
        let own = entries(&text).find(|(number, _)| *number == tool).map(|(_, entry)| entry.to_owned());
        own.map(|entry| (at, entry))
    })
}

/// The entries of a list of tools in a comment: `T4 1/4-20 TAP`, `T1 END MILL, T2 M6 TAP`; the number, and what follows.
pub(crate) fn entries(text: &str) -> impl Iterator<Item = (u32, &str)> {
    let starts = text.char_indices().filter_map(move |(at, letter)| {
        let before = text.get(..at)?.bytes().next_back();
        let begins = matches!(letter, 'T' | 't') && before.is_some_and(|b| !b.is_ascii_alphanumeric());
        let rest = text.get(at + 1..).filter(|_| begins)?;
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        let (number, behind) = rest.split_at_checked(digits)?;
        let ends = behind.starts_with([' ', ':', '-', '=', '|', ',', '\t']);
        number.parse().ok().filter(|_| ends && digits <= 4).map(|number: u32| (at, number, behind))
    });
    let starts: Vec<_> = starts.collect();
    let ends: Vec<usize> = starts.iter().skip(1).map(|(at, ..)| *at).chain([text.len()]).collect();
    starts.into_iter().zip(ends).filter_map(move |((_, number, behind), end)| {
        let length = end.saturating_sub(text.len() - behind.len());
        Some((number, behind.get(..length)?))
    })
}

#[cfg(test)]
mod tests {
    use gcheck_engine::{At, Units};

    use super::{ToolComment, entries, only_comments};

    #[test]
    fn comments_without_the_code_beside_them() {
        for (block, comments) in [
            ("T1 M6 (1/4 DRILL) M4", "1/4 DRILL "),
            ("(A)(B) X1.", "A B "),
            ("T1 M6 ; 6 mm drill (long)", " 6 mm drill (long) "),
            ("(not closed", "not closed "),
            ("X1.", ""),
        ] {
            assert_eq!(only_comments(block), comments, "{block}");
        }
    }

    #[test]
    fn a_comment_gives_one_size() {
        let size = |text: &str| {
            let comment =
                ToolComment { at: At { file: 0, block: 0 }, words: Vec::new(), text: text.to_owned() };
            comment.size(Some(Units::Inch)).map(|size| (size.0 * 1000.0).round() / 1000.0)
        };
        for text in ["10 MM DRILL", "DRILL 10MM", "END MILL D: 10.0 mm."] {
            assert_eq!(size(text), Some(10.0), "{text}");
        }
        for text in ["1/4 IN END MILL", "DRILL 1/4", ".25\" DRILL", "0.25 INCH"] {
            assert_eq!(size(text), Some(6.35), "{text}");
        }
        assert_eq!(size("1 1/2 IN FACE MILL"), Some(38.1));
        assert_eq!(size("D=0.5 CR=0. - ZMIN=-0.4 - flat end mill"), Some(12.7));
        for text in ["1/4-20 TAP", "DRILL 10 MM, 60 MM LONG", "M6 DRILL", "#7 DRILL", "DRILL 1/0", "", "T5"] {
            assert_eq!(size(text), None, "{text}");
        }
    }

    #[test]
    fn lists_of_tools() {
        let list = entries("(T4 1/4-20 TAP, T5 - M6 DRILL)");
        assert_eq!(list.collect::<Vec<_>>(), [(4, " 1/4-20 TAP, "), (5, " - M6 DRILL)")]);
    }
}
