//! A computed word is judged as its number, and a computed code as its code.
//!
//! Knows: the examples of every rule, words that variables give. Must not know: how values are known.

use std::collections::{BTreeMap, BTreeSet};

use expect_test::expect;
use gcheck_diagnostics::{DocExample, Finding, Tier};
use gcheck_lint::RuleEntry;
use gcheck_program::{Dialect, lower};

use crate::RULES;
use crate::testing::{World, findings, only, recommended, words};

/// Controls with variables.
const CONTROLS: [&str; 5] = ["haas-mill", "haas-lathe", "fanuc-mill", "fanuc-lathe", "linuxcnc"];

/// The example with one of its words computed from a variable that a block before sets, once for each word: the address,
/// and the program.
fn with_computed_words(example: &DocExample) -> Vec<(char, String)> {
    let control = gcheck_controls::load(&example.control).unwrap();
    let dialect = Dialect::new(&control);
    let table = lower(&example.code, &dialect);
    let mut programs = Vec::new();
    for (_, block) in table.blocks() {
        for word in table.words(block) {
            let letter = char::from(word.letter.ascii());
            let Some(value) = word.number().filter(|_| !matches!(letter, 'N' | 'O')) else { continue };
            let range = word.range().start as usize..word.range().end as usize;
            let line = example.code[..range.start].rfind('\n').map_or(0, |at| at + 1);
            let mut program = example.code.clone();
            let address = example.code[range.clone()].trim_end_matches(|c: char| !c.is_ascii_alphabetic());
            program.replace_range(range.clone(), &format!("{address}#149"));
            program.insert_str(line, &format!("#149={value}\n"));
            programs.push((letter, program));
        }
    }
    programs
}

fn is_reported(rule: &RuleEntry, example: &DocExample, program: &str) -> bool {
    let world = World::of_example(rule.meta, example);
    let found = findings(&only(rule), &example.control, program, &world);
    found.iter().any(|finding| std::ptr::eq(finding.rule, rule.meta))
}

#[test]
fn a_mistake_is_found_whether_its_words_are_written_or_computed() {
    let mut silent: BTreeMap<&str, BTreeSet<char>> = BTreeMap::new();
    let mut tried = 0;
    for rule in RULES.iter().filter(|rule| matches!(rule.meta.tier, Tier::Block | Tier::Path)) {
        let examples = rule.meta.examples();
        let shown = examples.iter().filter(|e| e.reported && CONTROLS.contains(&e.control.as_str()));
        for example in shown {
            for (letter, program) in with_computed_words(example) {
                tried += 1;
                if !is_reported(rule, example, &program) {
                    silent.entry(rule.meta.id).or_default().insert(letter);
                }
            }
        }
    }
    let line = |(rule, letters): (&str, BTreeSet<char>)| {
        format!("{rule}: {}\n", letters.into_iter().map(String::from).collect::<Vec<_>>().join(" "))
    };
    let shown: String = silent.into_iter().map(line).collect();
    expect![[r#"
        6599 words
        allowance-into-contour: F G X Z
        blank-inside-number: G Y
        block-number-not-first: G
        chuck-left-open: M
        code-must-come-first: M
        coolant-locked: M
        corner-before-rapid: G Z
        corner-does-not-fit: Y
        cycle-ended-in-subprogram: X
        cycle-repeated-in-place: F G M X Z
        decimal-point-on-integer: H
        drilled-beside-the-centre: M
        dwell-unit-unsure: P
        dwell-very-short: P
        fall-into-subprogram: M P
        incremental-left-on: G M S X Y
        kept-touch-never-used: M
        lasting-word-on-one-way: G
        loop-condition-unchanged: G
        maybe-computed-value-out-of-range: G
        maybe-cycle-left-on: M
        maybe-cylinder-left-on: M
        maybe-feed-missing: F G
        maybe-feed-of-another-mode: G
        maybe-first-touch-missing: G
        maybe-five-axis-length-in-incremental: G
        maybe-incremental-left-on: G
        maybe-probing-in-wrong-mode: G
        maybe-refused-in-five-axis-mode: G
        maybe-spindle-stopped-while-cutting: G M
        number-out-of-range: P Q
        offset-words-beside-motion: G
        parts-catcher-left-out: M
        peck-longer-than-hole: Q
        peck-very-short: Q
        pocket-arc-below-tool: G M
        pocket-on-wrong-side: G M
        pocket-outline-open: G M
        pocket-start-outside: G
        polar-word-refused: @ ^
        rapid-between-cuts: G X Z
        rapid-through-bore-wall: X
        roughing-in-one-pass: G X
        sign-not-accepted: F
        thread-beside-part: P
        thread-height-off-pitch: P T
        thread-off-turned-diameter: P
        thread-start-below-crest: K P
        thread-without-lead: G
        tilt-without-orientation: J M
        tool-call-without-station: T
        tool-comment-of-another-tool: M T
        turning-profile-turns-back: F G X Z
        turning-start-inside-profile: F G X Z
        undefined-code: G
        unknown-address: @ G ^
        unreachable-block: G M
        unwanted-word: G
        variable-read-before-set: M
        word-of-another-form: G
        word-of-newer-version: $ M
        word-passed-over: G
    "#]]
    .assert_eq(&format!("{tried} words\n{shown}"));
}

fn found(control: &str, program: &str) -> Vec<Finding> {
    let ignored = ["program-number-missing", "tape-mark-missing", "units-not-stated", "program-end-missing"];
    let mut found = findings(&recommended(), control, program, &World::default());
    found.retain(|finding| !ignored.contains(&finding.rule.id));
    found
}

fn lines(control: &str, program: &str) -> String {
    let line = |finding: &Finding| {
        let number = program[..finding.range.start as usize].matches('\n').count() + 1;
        format!("{number}: {}[{}] {}\n", finding.severity, finding.rule.id, finding.message)
    };
    found(control, program).iter().map(line).collect()
}

#[test]
fn the_finding_names_the_values_and_offers_no_fix() {
    let program = "O1\nG20 G90 G54 G0 X0. Y0.\n#1=41\n#2=2\nG#1 G#2 X1. Y1. R1. D1 F10.\nG40 X0.\nM30\n";
    let found = found("haas-mill", program);
    let conflict = found.iter().filter(|finding| finding.rule.id == "codes-conflict");
    expect![[r#"
        `G#1` and `G#2` cannot share a block
          here: clockwise arc at feed
          there: cutter compensation left
          note: `G41` (cutter compensation left) cannot be in a block with the other code  [Haas online manual, entry and exit of cutter compensation; Haas 96-8000 rev R June 2007 (easymanua.ls page 91); Renishaw H-1000-5068 p.48; HM17 p.270]
          note: `G#1` is `G41` here
          note: `G#2` is `G2` here
          help: put the two codes in separate blocks
    "#]].assert_eq(&conflict.map(words).collect::<String>());
}

#[test]
fn what_the_text_shows_is_reported_once() {
    expect![[r#"
        4: warning[cylinder-word-value-ignored] the value of `Y7.` does not count (`G107`)
    "#]]
    .assert_eq(&lines("haas-mill", "O1\nG20 G54\n#1=0\nG107 Y7. A#1 Q2.\nG107\nM30\n"));
}

#[test]
fn a_value_of_one_way_is_a_finding_of_that_way() {
    let program = "O1\nG20 G54\n#1=0\nIF [#500 EQ 1] GOTO 10\n#1=7.\nN10 G107 Y#1 A0. Q2.\nG107\nM30\n";
    expect![[r#"
        6: info[cylinder-word-value-ignored] the value of `Y#1` does not count (`G107`), when `#500` is not 1
    "#]]
    .assert_eq(&lines("haas-mill", program));
}

#[test]
fn a_value_that_nobody_knows_is_not_judged() {
    expect![[""]].assert_eq(&lines("haas-mill", "O1\nG20 G54\nG107 Y#500 A0. Q2.\nG107\nM30\n"));
    // Another program calls this one, and gives it its variables.
    expect![[""]]
        .assert_eq(&lines("haas-mill", "O9001\nIF [#1 EQ #0] THEN #1=7.\nG107 Y#1 A0. Q2.\nG107\nM99\n"));
}

#[test]
fn a_called_program_is_judged_with_the_values_of_its_call() {
    let program = "O1\nG20 G54\nG65 P2 A0.\nG65 P2 A7.\nM30\nO2\nG107 Y#1 A0. Q2.\nG107\nM99\n";
    expect![[r#"
        7: warning[cylinder-word-value-ignored] the value of `Y#1` does not count (`G107`)
    "#]]
    .assert_eq(&lines("haas-mill", program));
}

#[test]
fn a_value_of_a_loop_is_judged_in_each_turn() {
    let program = "O1\nG20 G54\n#1=0\nWHILE [#1 LT 3] DO1\nG107 Y#1 A0. Q2.\nG107\n#1=#1+1\nEND1\nM30\n";
    expect![[r#"
        5: warning[cylinder-word-value-ignored] the value of `Y#1` does not count (`G107`)
    "#]]
    .assert_eq(&lines("haas-mill", program));
}
