//! Dialects that look like G-code and that no control of the data reads: printers, conversational languages, other builders'
//! own; and controls that read much of what the controls of the data read, and are none of them.
//!
//! Knows: how the hints of `data/unsupported.toml` match the first part of a file and the end of its name. Must not know: what
//! follows from a match.

use std::sync::LazyLock;

use serde::Deserialize;

use crate::SyntaxForm;
use crate::whole_word::Words;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    dialect: Vec<UnsupportedDialect>,
    other: Vec<OtherControl>,
}

/// A control, or a builder's controls, that no control here is for, though its programs look like those of one.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OtherControl {
    /// In words: "a Mazak control".
    pub(crate) name: String,
    /// Whole words of comments that name it.
    pub(crate) comments: Vec<String>,
    /// Controls as which its programs may still be read: the nearest there is.
    #[serde(default)]
    pub(crate) like: Vec<String>,
    /// Forms that it does not have: in a program with one of them its name is a word like others.
    #[serde(default)]
    pub(crate) without: Vec<SyntaxForm>,
    /// The source of the words.
    #[cfg_attr(not(test), expect(dead_code, reason = "for the reader of the data"))]
    source: String,
}

/// A dialect that no control here reads.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnsupportedDialect {
    /// What reads it: "a 3-D printer".
    pub name: String,
    /// The dialect, in words.
    pub reads: String,
    needs: u32,
    /// The source of the hints.
    pub source: String,
    hints: Vec<Hint>,
}

impl UnsupportedDialect {
    /// Which files are in it, and that gcheck does not read them.
    pub fn sentence(&self) -> String {
        format!("the file is for {}, which gcheck does not read", self.name)
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Hint {
    points: u32,
    line: Option<String>,
    text: Option<String>,
    within: Option<String>,
    placeholder: Option<String>,
    word: Option<char>,
    extension: Option<String>,
}

static DATA: LazyLock<File> = LazyLock::new(|| {
    let file = serde_json::from_str::<File>(include_str!(concat!(env!("OUT_DIR"), "/unsupported.json")));
    #[expect(clippy::expect_used, reason = "embedded data; a test reads it")]
    file.expect("data/unsupported.toml has the shape of `File`")
});

/// The controls that comments may name and that no control here is for.
pub(crate) fn other_controls() -> &'static [OtherControl] {
    &DATA.other
}

/// The first part of a file that is looked at.
const HEAD_BYTES: usize = 16 << 10;

/// Lines that must have a hint's word.
const ENOUGH_LINES: usize = 3;

/// The dialect that the first part of a file and the end of its name show, if it is one that no control here reads.
/// `extension` is without the dot, in lower case.
pub fn unsupported_dialect(head: &str, extension: Option<&str>) -> Option<&'static UnsupportedDialect> {
    let head = head.get(..head.floor_char_boundary(HEAD_BYTES)).unwrap_or(head);
    let lines = Lines::of(head);
    let words = Words::of(head);
    let is_met = |hint: &&Hint| {
        hint.extension.as_deref().is_some_and(|end| Some(end) == extension) || hint.is_in(&words, &lines)
    };
    let points = |dialect: &UnsupportedDialect| -> u32 {
        dialect.hints.iter().filter(is_met).map(|hint| hint.points).sum()
    };
    let scored = DATA.dialect.iter().map(|dialect| (points(dialect), dialect));
    let enough = scored.filter(|(points, dialect)| *points >= dialect.needs);
    enough.max_by_key(|(points, _)| *points).map(|(_, dialect)| dialect)
}

/// The lines of a head without their numbers, sorted by what hints look for: there are many hints.
struct Lines<'a> {
    /// By the first letter, in lower case: letters that are not ASCII, and other characters, are one.
    by_first: [Vec<&'a str>; 128],
    moves: Vec<&'a str>,
    with_placeholders: Vec<&'a str>,
    with_operators: Vec<&'a str>,
}

impl<'a> Lines<'a> {
    fn of(head: &'a str) -> Self {
        let mut by_first = [const { Vec::new() }; 128];
        let (mut moves, mut with_placeholders, mut with_operators) = (Vec::new(), Vec::new(), Vec::new());
        for line in head.split(['\n', '\r']).map(without_number) {
            if let Some(lines) = line.chars().next().and_then(|first| by_first.get_mut(place_of(first))) {
                lines.push(line);
            }
            if is_move(line) {
                moves.push(line);
            }
            if line.contains('#') {
                with_placeholders.push(line);
            }
            if line.contains(['&', '|', '!']) || line.contains("==") {
                with_operators.push(line);
            }
        }
        Self { by_first, moves, with_placeholders, with_operators }
    }

    /// Does a line begin as the pattern says?
    fn begin(&self, pattern: &str) -> bool {
        let lines = match pattern.chars().next() {
            Some(first) if !matches!(first, '#' | '~') => {
                self.by_first.get(place_of(first)..=place_of(first))
            }
            _ => Some(self.by_first.as_slice()),
        };
        lines.into_iter().flatten().flatten().any(|line| begins(line, pattern))
    }
}

/// Where lines are that begin with this letter.
fn place_of(first: char) -> usize {
    if first.is_ascii() { first.to_ascii_lowercase() as usize } else { 0 }
}

impl Hint {
    fn is_in(&self, words: &Words, lines: &Lines<'_>) -> bool {
        let by_line = self.line.as_ref().is_some_and(|begin| lines.begin(begin));
        let by_text = self.text.as_ref().is_some_and(|text| words.have(text));
        let by_word = self.word.is_some_and(|word| {
            lines.moves.iter().filter(|line| has_word(line, word)).count() >= ENOUGH_LINES
        });
        let by_placeholder = self
            .placeholder
            .as_ref()
            .is_some_and(|name| lines.with_placeholders.iter().any(|line| has_placeholder(line, name)));
        let by_operator = self
            .within
            .as_ref()
            .is_some_and(|signs| lines.with_operators.iter().any(|line| code_of(line).contains(signs)));
        by_line || by_text || by_word || by_placeholder || by_operator
    }
}

/// A line without blanks, `/` and block number at its start.
fn without_number(line: &str) -> &str {
    let line = line.trim_start().trim_start_matches('/');
    let rest = line.strip_prefix(['N', 'n']).unwrap_or(line);
    let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    // A number without `N` is a block number only with a blank after it.
    let is_number = after.len() < rest.len() && (rest.len() < line.len() || after.starts_with(' '));
    if is_number { after.trim_start() } else { line }
}

/// Does the line begin as the pattern says? A pattern that ends in a letter or digit ends a word there.
fn begins(line: &str, pattern: &str) -> bool {
    let mut rest = line;
    for part in pattern.chars() {
        let matched = match part {
            '#' => rest.trim_start_matches(|c: char| c.is_ascii_digit()),
            '~' => rest.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_'),
            _ => rest.strip_prefix(|c: char| c.eq_ignore_ascii_case(&part)).unwrap_or(rest),
        };
        if matched.len() == rest.len() {
            return false;
        }
        rest = matched;
    }
    let ends_word = pattern.ends_with(|c: char| c.is_ascii_alphabetic()) && pattern.len() > 2;
    let ends_number = pattern.ends_with(|c: char| c.is_ascii_digit());
    !(ends_word && rest.starts_with(|c: char| c.is_alphabetic() || c == '_')
        || ends_number && rest.starts_with(|c: char| c.is_ascii_digit()))
}

/// A line up to its first comment.
fn code_of(line: &str) -> &str {
    line.split([';', '(']).next().unwrap_or_default()
}

fn is_move(line: &str) -> bool {
    let rest = line.strip_prefix(['G', 'g']).map(|rest| rest.trim_start_matches('0'));
    rest.is_some_and(|rest| !rest.trim_start_matches('1').starts_with(|c: char| c.is_ascii_digit()))
}

/// Is `#` and the name on the line, outside comments?
fn has_placeholder(line: &str, name: &str) -> bool {
    code_of(line).split('#').skip(1).any(|after| {
        let (head, rest) = after.split_at_checked(name.len()).unwrap_or_default();
        head.eq_ignore_ascii_case(name) && !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_')
    })
}

/// Is the address on the line, outside comments, with a number after it?
fn has_word(line: &str, word: char) -> bool {
    let code = code_of(line);
    let next = code.chars().skip(1);
    code.chars().zip(next).any(|(c, next)| {
        c.eq_ignore_ascii_case(&word) && (next.is_ascii_digit() || matches!(next, '+' | '-' | '.'))
    })
}

#[cfg(test)]
mod tests {
    use super::{begins, unsupported_dialect, without_number};

    fn check(head: &str, expected: Option<&str>) {
        check_named(head, None, expected);
    }

    fn check_named(head: &str, extension: Option<&str>, expected: Option<&str>) {
        assert_eq!(
            unsupported_dialect(head, extension).map(|dialect| dialect.name.as_str()),
            expected,
            "{head}"
        );
    }

    #[test]
    fn each_dialect_by_a_program_of_its_kind() {
        check("G92 E0\nG1 X1 E1.1\nG1 X2 E1.2 F900\nG1 Y2 E1.3\n", Some("a 3-D printer"));
        check("; generated by PrusaSlicer 2.6\nM104 S200\nG28\n", Some("a 3-D printer"));
        check("N10 G54\nN20 R1=5 R2=7\nN30 TRANS X=R1\nN40 G0 X=R2\n", Some("a SINUMERIK control"));
        check("0 BEGIN PGM PLATE MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n", Some("a Heidenhain control"));
        check("R1=150\nR20=-R6\nG00 X=R1 Y=0\n", Some("a SINUMERIK control"));
        check("MSG(\"EDGE\")\nBRETON_INIT(0)\nG518\n", Some("a SINUMERIK control"));
        check("IF [[#1<=0] || [#1>12]]\n{\n#3000=1\n}\n", Some("a control with a macro language like C"));
        check("IF [#1 EQ 0] THEN #3000=1 (A && B || C != D)\n{\n", None);
        check("G15 H1\nVC1=12\nG0 X=VC1\n", Some("an OSP control"));
        check("%FLANGE,MX--,\nN10 (P1=5)\n", Some("a Fagor control"));
        check("%PM\nN9001\n", Some("a MAHO control"));
        check(
            "dlgmsg \"hole\" \"diameter\" 100\nif [#100 < 1]\n  errmsg \"too small\"\nendif\n",
            Some("an EdingCNC control"),
        );
        check("sub hole\n  g1 x#100\nendsub\ngosub hole\n", Some("an EdingCNC control"));
        check("o<hole> sub\ng1 x#1\no<hole> endsub\n", None);
        check("//WEDM\nE001=10 17\n", Some("a wire erosion machine"));
        check("M48\nMETRIC,TZ\nT01C0.8\n%\nX10Y10\n", Some("a drilling machine for circuit boards"));
    }

    #[test]
    fn the_end_of_the_name_counts_where_one_builder_uses_it() {
        check_named("G1 X1 Y1 F1000\n", Some("mpf"), Some("a SINUMERIK control"));
        check_named("G1 X1 Y1 F1000\n", Some("min"), Some("an OSP control"));
        check_named("G1 X1 Y1 F1000\n", Some("nc"), None);
        check_named("int main(void);\n", Some("h"), None);
        check_named("0 BEGIN PGM PLATE MM\n", Some("h"), Some("a Heidenhain control"));
    }

    #[test]
    fn heads_and_tool_words_that_only_one_builder_writes() {
        check("%MPF 90\nN1 G0 X1\n", Some("a SINUMERIK control"));
        check("(FOR SIEMENS)\nN70 M1=5\n", Some("a SINUMERIK control"));
        check("(POSTED BY SIEMENS NX)\nG0 X1.\n", None);
        check("$FLANGE.MIN%\nG50 S2000\n", Some("an OSP control"));
        check("%4100 G71 *\nN20 G30 G17 X+0 Y+0 Z-20*\n", Some("a Heidenhain control"));
        check("%00214\nN0 T1.1\nN10 M6\n", Some("a Fagor control"));
        check("%\nO0001\nN10 T1 M6\n", None);
        check("; end of print\nM104 S0\nM140 S0\nM106 S0\nM84\n", Some("a 3-D printer"));
        check("M92 E415\nM500\n", Some("a 3-D printer"));
        check("G0 X1.\nM84\n", None);
        check("G0 Z10\nM3 P100\nG1 Z-1\n", Some("a Snapmaker"));
        check("S1000 M3 P11\nM3 P1000\n", None);
        check("G38.3 Z-50 F100\nG43.1 Z#PRBZ\n", Some("a sender program"));
        check("#<PRBX> = 5 ; kept in #PRBX\n(laser module from Snapmaker on a grbl frame)\nG0 X1\n", None);
    }

    #[test]
    fn printers_by_their_slicers_macros_and_temperatures() {
        for slicer in ["ideaMaker", "KISSlicer", "Kiri:Moto", "SuperSlicer"] {
            check(&format!("; sliced by {slicer} 4.1\nM104 S200\nG28\n"), Some("a 3-D printer"));
        }
        check("START_PRINT BED=60 EXTRUDER=200\nG28\n", Some("a 3-D printer"));
        check("M104\nG1 X1 E1.1\nG1 X2 E1.2\nG1 Y2 E1.3\n", Some("a 3-D printer"));
        // A fish, a user's own codes, and words that end elsewhere.
        check("(MARLIN BRACKET)\nM104 P1\nG1 X1.\n", None);
        check("(PRINT_STARTED BY HAND)\nG0 X1.\n", None);
    }

    #[test]
    fn routers_that_read_words_with_commas() {
        check("'SHOPBOT FILE\nMS,2,1\nJZ,0.5\nJ2,1,1\nMZ,-0.1\nM2,3,1\n", Some("a ShopBot"));
        check_named("VD,1\n", Some("sbp"), Some("a ShopBot"));
        check("units(METRIC);\nfeed(400);\n", Some("a script interpreter"));
        check("M3\nM2\n", None);
    }

    #[test]
    fn scripts_are_no_programs() {
        check("#!/bin/sh\necho G0 X1\n", Some("a script interpreter"));
        check("feed(400);\nrapid({z: 5});\ncut({z: -3});\n", Some("a script interpreter"));
        check("G0 X1. (feed(400) is too much, rapid(5) too)\n", None);
    }

    #[test]
    fn other_controls_are_like_controls_that_there_are() {
        for other in super::other_controls() {
            assert!(!other.comments.is_empty() && !other.source.is_empty(), "{other:?}");
            for like in &other.like {
                assert!(crate::names().contains(&like.as_str()), "{like}");
            }
        }
    }

    #[test]
    fn programs_of_supported_controls_are_none() {
        check("%\nO1 (A)\nG20 G90 G54\nT1 M6\nG43 H1 Z1.\nM48\nM30\n%\n", None);
        check("T0101\nG50 S2000\nG96 S200 M3\nG71 U1. R.5\nM30\n", None);
        check("o<sub> sub\n#<_x> = 1\nM104 P1\nM109 P2\no<sub> endsub\n", None);
        check("(R1 = 5)\n(IF THE PART IS LOOSE, TIGHTEN IT)\n(CALL 2 PEOPLE)\nG0 X1.\n", None);
        check("(TRANSFER LINE)\nROTATE\n", None);
        check("", None);
    }

    #[test]
    fn lines_begin_after_their_number() {
        assert_eq!(without_number("  /N120 TRANS X1"), "TRANS X1");
        assert_eq!(without_number("12 L X+1"), "L X+1");
        assert_eq!(without_number("12X"), "12X");
        assert!(begins("R12=5", "R#=") && !begins("R=5", "R#=") && !begins("TRANSFER", "TRANS"));
        assert!(begins("cycle81(1)", "CYCLE#(") && begins("PROC part_1", "PROC ~"));
    }
}
