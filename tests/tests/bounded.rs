//! Law 7 on generated text: whatever the bytes, a check ends, does not panic, and its places lie in the file.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_lint::{ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Selection, check};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;
use proptest::prelude::*;

fn check_everywhere(bytes: Vec<u8>) {
    let source = SourceText::from_bytes(bytes).unwrap();
    let mut selection = Selection::recommended(RULES);
    selection.enable("all").unwrap();
    for name in gcheck_controls::names() {
        let control = gcheck_controls::load(name).unwrap();
        let dialect = Dialect::new(&control);
        let machine = MachineFacts::default();
        let environment = Environment {
            dialect: &dialect,
            machine: &machine,
            programs: &NoPrograms,
            control_basis: ControlBasis::Guessed,
            unsupported: None,
        };
        let outcome = check(&Job {
            source: &source,
            environment,
            selection: &selection,
            suppressions: true,
            execution: Execution::default(),
        });
        for finding in outcome.findings {
            let places = finding.labels.iter().map(|l| &l.range).chain([&finding.range]);
            let edits = finding.fixes.iter().flat_map(|f| &f.edits).map(|e| &e.range);
            for range in places.chain(edits) {
                let inside = source.text().get(range.start as usize..range.end as usize).is_some();
                assert!(inside, "{name}: {}: {range:?} of {}", finding.rule.id, source.text().len());
            }
        }
    }
}

/// Pieces of programs that reach into every part of the grammar and the rules.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        "[GMXYZIJKRPQFSTHDNOLUW][-+]?[0-9]{1,7}\\.?[0-9]{0,5}",
        prop::sample::select(vec![
            "\n",
            "\r\n",
            "\r",
            "\n\n",
            " ",
            ";",
            "%",
            "%\n",
            "/",
            "/9",
            "(",
            ")",
            "(a)",
            "(gcheck: ignore all - x)",
            "(gcheck: off x)",
            "(gcheck: on all)",
            "[",
            "]",
            "#",
            "=",
            "#0=1",
            "#1=#2",
            "#<a>=1",
            "O100 sub",
            "o100 endsub",
            "o<x> call [1]",
            "O1\n",
            ":5",
            "IF[#1EQ2]GOTO",
            "THEN",
            "WHILE[1]DO1",
            "END1",
            "DO4",
            "GOTO10",
            "M98P1",
            "M99",
            "M30",
            "G65P1",
            "G71P1Q2",
            "N1",
            "G#1",
            "\u{FEFF}",
            "µ",
            "日本",
            "😀",
            "\0",
            "\x1A",
            "XO.5",
            "G01.5.5",
            ",R1.",
            "M6 T1",
            "SIN[",
            "**",
            "DPRNT[",
        ])
        .prop_map(str::to_owned),
        any::<char>().prop_map(String::from),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn broken_programs_are_checked(pieces in prop::collection::vec(piece(), 0..120)) {
        check_everywhere(pieces.concat().into_bytes());
    }

    #[test]
    fn arbitrary_bytes_are_checked(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        check_everywhere(bytes);
    }
}

#[test]
fn monsters_are_checked_in_linear_time() {
    for monster in [
        "[".repeat(10_000),
        "(".repeat(1_000_000),
        "X1".repeat(500_000),
        "G1".repeat(200_000),
        "M98P1".repeat(40_000),
        "N1\n".repeat(200_000),
        "GOTO5\n".repeat(100_000),
        "DO1\n".repeat(100_000),
        "O1\n".repeat(100_000),
        "o1 if [1]\n".repeat(100_000),
        "#1=1\n".repeat(100_000),
        "(gcheck: off all)\n".repeat(3_000),
        "%\n".repeat(100_000),
        ";".repeat(500_000),
        (0..100_000).map(|n| format!("#{n}=1\nN{n}GOTO{n}\n")).collect(),
        (0..60_000).map(|n| format!("O{n} M98P{n}\n")).collect(),
        (0..20_000).map(|n| format!("G{}.{} M{}\n", n % 2_000, n % 7, n)).collect(),
    ] {
        check_everywhere(monster.into_bytes());
    }
}
