//! The hover of the codes of the founding pages, statement by statement: each is in the text that people read.
//!
//! Knows: the statements in our words, the code whose text has each, and by which words it is found there. Must not know: what
//! the codes do.

use std::fmt::Write as _;

use expect_test::expect_file;
use gcheck_controls::load;
use gcheck_ide::explain;

/// A statement of a page in our words, and the words by which it is found in the text of the code.
type Statement = (&'static str, &'static str);

/// The statements of a page that one code's text has.
struct Page {
    source: &'static str,
    control: &'static str,
    code: &'static str,
    statements: &'static [Statement],
}

const PAGES: &[Page] = &[
    Page {
        source: "Haas bar feeder manual 96-8913A p.21",
        control: "haas-lathe",
        code: "G105",
        statements: &[
            ("The code commands a bar feeder.", "needs the option bar feeder"),
            (
                "`I` is the first push of a new bar, in place of #3101.",
                "initial push of a new bar, instead of #3101",
            ),
            (
                "`J` is the part with its cutoff, in place of #3100.",
                "part length with cutoff, instead of #3100",
            ),
            (
                "`K` is the least length to clamp, in place of #3102.",
                "least clamping length, instead of #3102",
            ),
            ("`P` is a cutoff program.", "cutoff program, run first"),
            ("`Q` sets the feeder up.", "setup mode; 0 is the normal feed"),
            ("`R` turns the spindle for a new bar.", "spindle orientation for a new bar"),
            (
                "`I`, `J` and `K` count in their block only; stored values stay.",
                "count in this block only; the stored values stay",
            ),
            (
                "The length of the bar and the sum of clamping length and part decide.",
                "**clamping length + part**",
            ),
            ("The cutoff program runs first, with either length of bar.", "1. Cutoff program `P`, if given"),
            (
                "The spindle stops, then the workholding opens.",
                "2. The spindle stops, the workholding opens.",
            ),
            ("A longer bar is pushed by the part.", "**Bar longer:** push by the part (`J` or #3100)"),
            (
                "With a shorter bar the pushrod goes to its unloaded position.",
                "pushrod to its unloaded position",
            ),
            ("Then the spindle orients if `R` is given.", "spindle to the angle `R` if given"),
            ("A new bar is pushed by `I` or #3101.", "new bar, push by `I` or #3101"),
            ("Where both are zero, #3112 is the push.", "by the reference position #3112 when both are zero"),
            ("The workholding closes and the program goes on.", "The workholding closes"),
        ],
    },
    Page {
        source: "Haas mill operator's manual 2017, p. 264",
        control: "haas-mill",
        code: "G31",
        statements: &[
            ("The code is an option and needs a probe.", "needs the option probe"),
            (
                "The axes move until the position is reached or the probe signals.",
                "It ends at the touch, or at its end point",
            ),
            ("The program goes on in either case.", "the program goes on either way"),
            ("The point is kept in variables, one for each axis.", "in `#5061` to `#5066`"),
            ("The block has an axis and a feed.", "Needs an axis word and `F` in its block"),
            ("The feed stays below 100 inch or 2500 mm a minute.", "under 100 inch (2500 mm) a minute"),
            ("Cutter compensation is off.", "Not in cutter compensation"),
            ("The probe is switched on before.", "Switch the probe on first"),
            ("The code counts in its block only.", "for its own block"),
        ],
    },
    Page {
        source: "Haas mill operator's manual 2017, p. 265",
        control: "haas-mill",
        code: "G35",
        statements: &[
            ("The code is an option and needs a probe.", "needs the option tool probe"),
            ("Two touches measure a tool, one on each side.", "touch the other side with G35"),
            ("The first touch is a `G31` with `M75`.", "with `G31 ... M75`"),
            ("Their distance becomes the size offset `D`.", "becomes size offset `D`"),
            ("`D` is not zero.", "D0 is not allowed"),
            (
                "The width of the probe is taken away (Setting 63).",
                "less the width of the probe (Setting 63)",
            ),
            ("Cutter compensation is off.", "No cutter compensation"),
            ("A right-hand cutter turns backward.", "Turn a right-hand cutter **backward** (M4)"),
            ("The code counts in its block only.", "for its own block"),
        ],
    },
    Page {
        source: "Haas mill operator's manual 2017, p. 267",
        control: "haas-mill",
        code: "G36",
        statements: &[
            ("The code is an option and needs a probe.", "needs the option probe"),
            (
                "The touched point becomes zero of the active work offset on each axis of the block.",
                "makes that point zero of the **active work offset**, on each axis named",
            ),
            ("A block without an axis is an alarm.", "without an axis, alarm"),
            (
                "`I`, `J` and `K` shift the offset from the touch.",
                "shift the zero from the touch along X, Y, Z",
            ),
            ("Settings 59 to 62 correct the point.", "Settings 59 to 62 correct for the tip"),
            ("Tool length compensation is off.", "Tool length compensation off (G49)"),
            ("Cutter compensation is off.", "cutter compensation off (G40)"),
            ("The feed stays below 100 inch or 2500 mm a minute.", "under 100 inch (2500 mm) a minute"),
            ("The code counts in its block only.", "for its own block"),
        ],
    },
    Page {
        source: "Haas mill operator's manual 2017, p. 269",
        control: "haas-mill",
        code: "G37",
        statements: &[
            ("The code is an option and needs a probe.", "needs the option tool probe"),
            (
                "Z moves until the probe signals or its travel ends.",
                "The move ends only at the probe or at the end of Z travel",
            ),
            (
                "`G43` or `G44` is on, with `H` other than zero.",
                "G43 or G44 with an H other than 0 must be on",
            ),
            ("The touched point sets the length offset `H`.", "writes length offset `H`"),
            ("A `Z` that is not zero shifts the offset.", "it shifts the length by as much"),
            ("`Z0` shifts nothing.", "0 for no shift"),
            ("The work offset counts.", "The work offset counts"),
            (
                "The work offset and the length may be chosen in the block or in the one before.",
                "in the block before or in this one",
            ),
            ("The code counts in its block only.", "for its own block"),
        ],
    },
    Page {
        source: "Haas mill operator's manual 2017, p. 187 and 303",
        control: "haas-mill",
        code: "G93",
        statements: &[
            ("`F` counts strokes a minute.", "moves a minute"),
            ("The time of a block in seconds is 60 divided by `F`.", "60/F seconds"),
            ("Each block that feeds has its own `F`.", "in every block that feeds"),
            ("It is meant for work with rotary axes.", "mix linear and rotary axes"),
            ("The largest `F` is 45000.", "The largest F is 45000"),
            ("`G94` goes back to feed per minute.", "ended by `G94`"),
            ("It is recommended with `G143`.", "Recommended with G143"),
        ],
    },
    Page {
        source: "Haas 96-8000 June 1999 p.203",
        control: "haas-mill",
        code: "G107",
        statements: &[
            ("X, Y or Z begins mapping and names the linear axis.", "`X`, `Y` **or** `Z`: the axis to wrap"),
            ("The value of that word does not count.", "Their values do not count"),
            (
                "A linear axis without a rotary axis is an alarm.",
                "A linear axis, Q or R without A or B is an alarm",
            ),
            (
                "A or B names the rotary axis; its value does not count.",
                "the cylinder is on A; the value does not count",
            ),
            ("The pages differ about another axis.", "Of C the manuals differ"),
            ("`Q` is the diameter.", "diameter of the cylinder"),
            (
                "`Q` without a rotary axis is an alarm when the block runs.",
                "A linear axis, Q or R without A or B is an alarm",
            ),
            ("`R` is the radius.", "radius of the cylinder"),
            (
                "Without `Q` and `R` the last size since power-on counts.",
                "the last size given since power-on",
            ),
            (
                "Else, or where it was zero, the setting of the axis counts.",
                "or it was 0, Setting 34 (4th axis) or 79 (5th)",
            ),
            (
                "A size stays the default of its axis until power-off.",
                "stays the axis' default until power off",
            ),
            (
                "A size without a linear axis sets the default and leaves mapping.",
                "sets the default and leaves mapping as it is",
            ),
            (
                "A size equal to the setting follows it when it changes.",
                "In sync: as long as the last size equals the setting",
            ),
            (
                "Another size keeps its own value until the two are equal.",
                "it keeps its own value until the two are equal again",
            ),
            ("A surface of another diameter can be chosen in the program.", "`Q` diameter or `R` radius"),
        ],
    },
    Page {
        source: "TSNC-YH-A1M operation manual p.17",
        control: "generic-mill",
        code: "G2",
        statements: &[
            (
                "The two words of the plane are the end point.",
                "The two words of the active plane give the end point",
            ),
            (
                "The third word is the linear axis beside the plane: the height of the helix.",
                "its value is the height reached at the end",
            ),
            ("All else is as for an arc.", "all else is as for the plain arc"),
        ],
    },
    Page {
        source: "TSNC-YH-A1M operation manual p.17",
        control: "generic-mill",
        code: "G3",
        statements: &[
            (
                "The two words of the plane are the end point.",
                "The two words of the active plane give the end point",
            ),
            (
                "The third word is the linear axis beside the plane: the height of the helix.",
                "its value is the height reached at the end",
            ),
            ("All else is as for an arc.", "all else is as for the plain arc"),
        ],
    },
    Page {
        source: "TSNC-YH-A1M operation manual p.17",
        control: "generic-mill",
        code: "G94",
        statements: &[
            (
                "`F` is a length a minute, mm or inch.",
                "F is millimetres (`G21`) or inches (`G20`) per minute",
            ),
            ("The feed is the speed along the tangent.", "**along the path**"),
            ("It stays until `G95`.", "stays until `G95`"),
            ("It is the mode at power-on.", "The state at **power-on**"),
            ("The override works from 0 to 150 % in steps of 10 %.", "0 to 150 % in steps of 10 %"),
            ("Some codes, as tapping, cannot be changed by the switch.", "tapping cycles for one"),
        ],
    },
    Page {
        source: "TSNC-YH-A1M operation manual p.17",
        control: "generic-mill",
        code: "G95",
        statements: &[
            (
                "`F` is a length for each turn of the spindle, mm or inch.",
                "F is millimetres or inches for each turn of the spindle",
            ),
            ("It stays until `G94`.", "Stays until `G94`"),
            ("The override works from 0 to 150 % in steps of 10 %.", "0 to 150 % in steps of 10 %"),
            ("Some codes, as tapping, cannot be changed by the switch.", "tapping cycles for one"),
        ],
    },
    Page {
        source: "TSNC-YH-A1M operation manual p.17",
        control: "generic-mill",
        code: "G4",
        statements: &[
            (
                "The tool dwells with no feed, in flat boring and countersinking.",
                "clean bottom in flat boring and countersinking",
            ),
            ("`P` is milliseconds.", "**P** is milliseconds"),
            ("`X` and `U` are seconds.", "**X** or **U** seconds"),
            (
                "The next block begins when the time is over.",
                "the axes wait for a time, then the next block begins",
            ),
            ("The time is from 0.001 to 99999.999 s.", "From 0.001 to 99999.999 seconds"),
            ("`P` is 1 to 99999999 ms.", "time in milliseconds | optional, milliseconds, 1 to 99999999"),
            (
                "In cutting mode a pause makes an exact stop.",
                "In cutting mode `G64` a pause also makes the axes stop in position",
            ),
        ],
    },
    Page {
        source: "Haas 96-8000 rev AC May 2010 p.184",
        control: "haas-mill",
        code: "G143",
        statements: &[
            (
                "The code is an option, for machines whose rotary axes move the tool.",
                "machines on which both rotary axes move the tool",
            ),
            ("It needs no CAM system for another length of tool.", "so that nothing is posted again"),
            ("An `H` selects the length.", "`H` here or in effect"),
            ("`G49` or `H00` ends it.", "G49 or H0 ends it"),
            ("There must be two rotary axes, A and B.", "head tilts in A **and** B"),
            ("Only absolute positioning works.", "**G90 only.**"),
            (
                "At work position A0 B0 the tool is parallel to Z.",
                "At work position A0 B0 the tool must be parallel to Z",
            ),
            (
                "The length is the difference to the tool that was posted for.",
                "how much longer (+) or shorter (-)",
            ),
            ("Only G0 and G1: no arcs, no canned cycles.", "Only G0 and G1: no arcs, canned cycles"),
            ("A positive length moves Z up.", "A positive length moves Z up"),
            ("An axis that is left out does not move.", "**X, Y or Z left out of a block does not move**"),
            ("A typical block has all five axes.", "write all five words"),
            ("Inverse time is recommended.", "G93 is recommended"),
            ("At the end `G94` needs a new `F`.", "Then G94 with a new F"),
        ],
    },
    Page {
        source: "Haas 96-8000 rev AC May 2010 p.184",
        control: "haas-mill",
        code: "G150",
        statements: &[
            ("`D` selects the offset of the tool.", "tool size offset"),
            ("`F` is the feed.", "feed rate"),
            (
                "`I` is the step in X, above zero.",
                "step in X; strokes run along Y | without J, length, above 0",
            ),
            (
                "`J` is the step in Y, above zero.",
                "step in Y; strokes run along X | without I, length, above 0",
            ),
            ("`K` is the finishing pass, not below zero.", "`K` is not below"),
            ("`P` names the program of the outline.", "A program `P` describes the outline"),
            ("`Q` is the depth of each pass, above zero.", "`I`, `J` and `Q` are above zero"),
            ("`R` is the rapid plane.", "rapid plane"),
            ("`S` may give the speed.", "spindle speed"),
            ("`X` and `Y` are the start hole.", "X, Y name it"),
        ],
    },
    Page {
        source: "Haas 96-8000 rev R June 2007 p.153",
        control: "haas-mill",
        code: "G141",
        statements: &[
            ("X, Y, Z and, if wanted, A and B are the point.", "A target"),
            ("`D` selects the size and stays.", "tool size offset; stays in effect"),
            ("`F` stays under G94.", "modal under G94"),
            (
                "The table of the page calls I, J, K depths; the text is right.",
                "explains I, J, K as peck depths; its text is right",
            ),
            (
                "I, J and K are the direction between the tool's centre and its contact point.",
                "between the tool's centre and its contact point",
            ),
            ("The control shifts the path along it.", "shifts the path along it"),
            ("The size may be positive or negative.", "Negative turns the shift round"),
            ("The offset is a radius or a diameter, by Setting 40.", "by Setting 40 a diameter"),
            ("The amount counts in moves of two or three axes.", "Moves of two axes are shifted too"),
            ("Only G00 and G01 can be used.", "Only G0 and G1"),
            ("Under G93 each block needs `F`.", "Under G93 each cut needs its `F`"),
            ("The vector has the length 1.", "I² + J² + K² = 1"),
        ],
    },
    Page {
        source: "Haas 96-8000 rev R June 2007 p.153",
        control: "haas-mill",
        code: "G136",
        statements: &[
            (
                "The probe is switched on by M53, a dwell of P100 and M63.",
                "`M53`, a dwell of `G4 P100`, `M63`",
            ),
            ("The first touch is `G31` with `M75`.", "First touch: `G31 ... M75`"),
            ("The second one comes from the other side.", "The two touches go opposite ways"),
            ("Moves are increments.", "work in **G91**"),
        ],
    },
];

#[test]
fn every_statement_is_in_the_text_of_its_code() {
    let mut page = "\
<!-- Written by `UPDATE_EXPECT=1 cargo test -p gcheck-ide --test founding_hover`; edit `crates/gcheck-ide/tests/founding_hover.rs`. -->
# The hover of the founding codes, statement by statement

Each statement of the founding pages that says what a code does, in our words, and the words by which the code's text has it.
Hover shows the summary and the words of a code; its page (`gcheck explain`, and the link of the hover) has the whole text.
The test reads every text.
"
    .to_owned();
    let mut missing = Vec::new();
    for Page { source, control, code, statements } in PAGES {
        let text = explain(gcheck_rules::RULES, &load(control).unwrap(), code).unwrap();
        let _ = write!(page, "\n## `{code}` ({control})\n\nSource: {source}.\n\n");
        page.push_str("| no. | what the page says | where in the text |\n|---|---|---|\n");
        for (index, (says, by)) in statements.iter().enumerate() {
            if !text.contains(by) {
                missing.push(format!("{code} on {control}: {says} by {by:?}"));
            }
            let by = by.replace('|', "\\|");
            let _ = writeln!(page, "| {code}-{} | {says} | “{by}” |", index + 1);
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
    expect_file!["../../../docs/dev/statements/founding-hover.md"].assert_eq(&page);
}

#[test]
fn no_text_offers_what_its_page_excludes() {
    let words = |control: &str, code: &str| -> Vec<String> {
        let text = explain(gcheck_rules::RULES, &load(control).unwrap(), code).unwrap();
        let rows = text.lines().filter_map(|line| line.strip_prefix("| `")?.split_once('`'));
        rows.map(|(letter, _)| letter.to_owned()).collect()
    };
    for (control, code, excluded) in [
        ("haas-mill", "G107", &["C"][..]),
        ("generic-mill", "G2", &["A", "B", "C"]),
        ("generic-mill", "G3", &["A", "B", "C"]),
        ("tsnc-yh-a1m", "G3", &["A", "B", "C"]),
    ] {
        let words = words(control, code);
        assert!(!words.is_empty(), "{code} on {control}");
        for letter in excluded {
            assert!(!words.iter().any(|word| word == letter), "{code} on {control} offers {letter}");
        }
    }
}
