//! Where a control answers what it refuses with a number, the finding has this number.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use gcheck_diagnostics::{Finding, Severity};
use gcheck_lint::{ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, Selection, check};
use gcheck_program::Dialect;
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

fn findings(control: &str, program: &str) -> Vec<Finding> {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let machine = MachineFacts::default();
    let environment = Environment {
        dialect: &dialect,
        machine: &machine,
        programs: &NoPrograms,
        control_basis: ControlBasis::Chosen,
        unsupported: None,
    };
    let source = SourceText::from(program);
    let selection = Selection::recommended(RULES);
    let job = Job {
        source: &source,
        environment,
        selection: &selection,
        suppressions: false,
        execution: Execution::default(),
    };
    check(&job).findings
}

/// Rules and numbers of the errors, in the order of the text.
fn errors(control: &str, program: &str) -> Vec<String> {
    let errors = findings(control, program).into_iter().filter(|finding| finding.severity == Severity::Error);
    errors.map(|finding| format!("{} {}", finding.rule.id, finding.alarm.unwrap_or_default())).collect()
}

/// Which programs after a header without mistakes are not answered as the table says.
fn answered_otherwise(control: &str, refused: &[(&str, &str)]) -> String {
    let mut wrong = Vec::new();
    for (program, expected) in refused {
        let found = errors(control, &format!("G21 G90 G17 G54\nG0 X0 Y0 Z5\n{program}\nM30\n"));
        if found != [*expected] {
            wrong.push(format!("{program:?}: {found:?}, not {expected:?}"));
        }
    }
    wrong.join("\n")
}

/// Each line of the table: a program after a header without mistakes, and the error that is found.
const REFUSED: &[(&str, &str)] = &[
    // A word is a letter and a number.
    ("G0 X", "address-without-value error 2"),
    ("5X1", "value-without-address error 1"),
    ("G1 X1 F-100", "sign-not-accepted error 4"),
    ("S-100 M3", "sign-not-accepted error 4"),
    // Letters that are not read.
    ("G0 A10", "unknown-address error 20"),
    ("G1 X1 Q2 F100", "unknown-address error 20"),
    ("T1 H1", "unknown-address error 20"),
    // Codes that do not exist, with and without a decimal.
    ("G81 X1 Z-1 R1 F100", "unknown-code error 20"),
    ("G41 X1 F100", "unknown-code error 20"),
    ("G64 P0.01", "unknown-code error 20"),
    ("G90.1", "unknown-code error 20"),
    ("G43.2", "unknown-code error 20"),
    ("G92.3", "unknown-code error 20"),
    ("G59.1", "unknown-code error 23"),
    ("G17.1", "unknown-code error 23"),
    ("G54.25", "unknown-code error 23"),
    // Two codes of a group, one code twice.
    ("G90 G91", "two-codes-of-one-group error 21"),
    ("G0 G1 X1 F100", "two-codes-of-one-group error 21"),
    ("M3 M5", "two-codes-of-one-group error 21"),
    ("M8 M9", "two-codes-of-one-group error 21"),
    ("G4 G53 P1", "two-codes-of-one-group error 21"),
    ("G80 G0 X1", "codes-conflict error 21"),
    ("G21 G21", "code-given-twice error 21"),
    // Feed.
    ("G93 G1 X1", "inverse-time-feed-missing error 22"),
    ("G1 X1 F0", "feed-zero error 22"),
    // Two codes that use axis words.
    ("G92 G0 X0", "codes-conflict error 24"),
    ("G28 G0 Z0", "codes-conflict error 24"),
    ("G49 G0 X1", "codes-conflict error 24"),
    ("G10 G92 L20 P1 X0", "two-codes-of-one-group error 24"),
    // Words.
    ("G0 X1 X2", "word-given-twice error 25"),
    ("G2 I5 F100", "word-choice-missing error 26"),
    ("G92", "word-choice-missing error 26"),
    ("G38.2 F100", "word-choice-missing error 26"),
    ("G10 L20 P1", "word-choice-missing error 26"),
    ("N10000001 G0 X1", "sequence-number-too-high error 27"),
    ("G4", "required-word-missing error 28"),
    ("G10 L2 P7 X0", "number-out-of-range error 29"),
    ("G2 X1 Y0 R1 F100\nG53 X2", "axis-words-without-motion-mode error 30"),
    ("G80\nX1", "axis-words-without-motion-mode error 31"),
    ("G2 X10 Y0 I4 F100", "arc-end-off-circle error 33"),
    ("G2 X0 Y0 R5 F100", "full-circle-by-radius error 33"),
    ("G2 X10 Y0 R4 F100", "arc-radius-too-small error 34"),
    ("G2 X10 Y0 F100", "arc-without-centre error 35"),
    ("G2 X10 Y0 R5 I5 F100", "words-exclude-each-other error 36"),
    ("G0 X1 P5", "word-not-read error 36"),
    ("G1 X1 I5 F100", "word-not-read error 36"),
    ("$J=X10", "system-command-refused error 22"),
    ("$J=G2 X1 F10", "system-command-refused error 16"),
    ("$J=X1 S100 F10", "system-command-refused error 36"),
    ("$999=1", "system-command-refused error 3"),
    ("$130=abc", "system-command-refused error 2"),
    ("$130=-5", "system-command-refused error 4"),
    ("$foo", "system-command-refused error 2"),
    ("$hq", "system-command-refused error 3"),
    ("$J", "system-command-refused error 3"),
    ("G43.1", "required-word-missing error 37"),
    ("G43.1 X5 Z1", "word-forbidden error 37"),
    ("T256", "number-out-of-range error 38"),
    (
        "G1 X1000.123456 Y1000.123456 Z-1000.123456 F1000.123456 S10000.123456 N1234567 T200 M3 G90",
        "line-too-long error 11",
    ),
];

#[test]
fn each_refusal_has_its_number() {
    assert_eq!(answered_otherwise("grbl", REFUSED), "");
}

/// What the source of the control reads as a G code, in tenths.
const G_CODES: &[u32] = &[
    0, 10, 20, 30, 40, 100, 170, 180, 190, 200, 210, 280, 281, 300, 301, 382, 383, 384, 385, 400, 431, 490,
    530, 540, 550, 560, 570, 580, 590, 610, 800, 900, 910, 911, 920, 921, 930, 940,
];

/// Numbers whose decimals are judged on their own: another one than those above is an unknown code.
const WITH_DECIMALS: &[u32] = &[28, 30, 38, 43, 49, 61, 90, 91, 92];

/// What the control answers for a G code that it does not have.
fn answer(tenths: u32) -> &'static str {
    let (whole, decimal) = (tenths / 10, tenths % 10);
    let is_read = G_CODES.iter().any(|code| code / 10 == whole);
    if decimal != 0 && is_read && !WITH_DECIMALS.contains(&whole) { "error 23" } else { "error 20" }
}

#[test]
fn every_code_that_the_control_does_not_have_is_refused_with_its_number() {
    for tenths in 0..1_000 {
        let code = if tenths % 10 == 0 {
            format!("G{}", tenths / 10)
        } else {
            format!("G{}.{}", tenths / 10, tenths % 10)
        };
        let found: Vec<_> = findings("grbl", &format!("{code}\n"))
            .into_iter()
            .filter(|finding| finding.rule.id == "unknown-code")
            .map(|finding| (finding.severity, finding.alarm))
            .collect();
        if G_CODES.contains(&tenths) {
            assert_eq!(found, [], "{code} is a code");
        } else {
            assert_eq!(found, [(Severity::Error, Some(answer(tenths).to_owned()))], "{code}");
        }
    }
}

/// A sender may take an M code out before the control sees it: no error, and so no number.
#[test]
fn m_codes_that_the_control_does_not_have_are_warnings() {
    let known = [0, 1, 2, 3, 4, 5, 7, 8, 9, 30, 56];
    for number in 0..200 {
        let found: Vec<_> = findings("grbl", &format!("M{number}\n"))
            .into_iter()
            .filter(|finding| finding.rule.id == "unknown-code")
            .map(|finding| (finding.severity, finding.alarm))
            .collect();
        let expected = if known.contains(&number) { vec![] } else { vec![(Severity::Warning, None)] };
        assert_eq!(found, expected, "M{number}");
    }
}

/// As above, for what the descendants with tool changes answer.
const REFUSED_BY_GRBLHAL: &[(&str, &str)] = &[
    ("G0 X", "address-without-value error 2"),
    ("S-100 M3", "sign-not-accepted error 4"),
    ("T-1", "sign-not-accepted error 4"),
    // Every letter is read: one that nothing takes is another error than in grbl.
    ("G0 X1 P5", "word-not-read error 36"),
    ("G0 X1 H2", "word-not-read error 36"),
    ("G0 X1 Q2", "word-not-read error 36"),
    ("G90 G91", "two-codes-of-one-group error 21"),
    ("G81 G0 X1 Z-1 R1 F100", "two-codes-of-one-group error 21"),
    ("G98 G99", "two-codes-of-one-group error 21"),
    ("G80 G0 X1", "codes-conflict error 21"),
    ("M48 M49", "two-codes-of-one-group error 21"),
    ("G93 G1 X1", "inverse-time-feed-missing error 22"),
    ("G1 X1 F0", "feed-zero error 22"),
    ("G92 G0 X0", "codes-conflict error 24"),
    ("G28 G0 Z0", "codes-conflict error 24"),
    ("G43.1 G0 Z1", "codes-conflict error 24"),
    ("G0 X1 X2", "word-given-twice error 25"),
    ("G92", "word-choice-missing error 26"),
    ("G51", "word-choice-missing error 26"),
    ("N10000001 G0 X1", "sequence-number-too-high error 27"),
    ("G4", "required-word-missing error 28"),
    ("M61", "required-word-missing error 28"),
    ("G10 L2 P10 X0", "word-unfit-for-another "),
    ("G2 X1 Y0 R1 F100\nG53 X2", "axis-words-without-motion-mode error 30"),
    ("G80\nX1", "axis-words-without-motion-mode error 31"),
    ("G2 X10 Y0 I4 F100", "arc-end-off-circle error 33"),
    ("G2 X10 Y0 F100", "arc-without-centre error 35"),
    ("G2 X10 Y0 R4 F100", "arc-radius-too-small error 34"),
    ("G43.1", "word-choice-missing error 37"),
    ("M3 S1000\nG81 X1 Z-1 F100", "lasting-word-never-given error 28"),
    ("M3 S1000\nG82 X1 Z-1 R1 F100", "lasting-word-never-given error 28"),
    ("M3 S1000\nG83 X1 Z-1 R1 F100", "lasting-word-never-given error 28"),
    ("M3 S1000\nG81 X1 Z2 R1 F100", "cycle-r-below-bottom error 54"),
    ("M3 S1000\nG81 X1 Z-1 R1 L0 F100", "number-out-of-range error 19"),
    ("M3 S1000\nG83 X1 Z-1 R1 Q0 F100", "number-out-of-range error 4"),
    ("G18 G5 X1 Y1 I1 J1 P1 Q1 F100", "refused-in-plane error 42"),
    ("G5 X1 Y1 Z1 I1 J1 P1 Q1 F100", "word-forbidden error 24"),
    ("G5.1 X1 Y1 I1 F100", "required-word-missing error 28"),
    ("G0 X#<depth>", "named-parameter-unset error 2"),
    ("G2 X10 Y0 I5 P0 F100", "arc-turns-not-whole error 39"),
    ("G51 X2 G0", "codes-conflict error 24"),
    ("G51 X2 G1 F100", "codes-conflict error 24"),
];

#[test]
fn refusals_of_grblhal_have_its_numbers() {
    assert_eq!(answered_otherwise("grblhal", REFUSED_BY_GRBLHAL), "");
}

const REFUSED_BY_FLUIDNC: &[(&str, &str)] = &[
    ("G0 X", "address-without-value error 2"),
    ("S-100 M3", "sign-not-accepted error 4"),
    ("T1 H1", "unknown-address error 20"),
    ("G81 X1 Z-1 R1 F100", "unknown-code error 20"),
    ("G41 X1 F100", "unknown-code error 20"),
    ("G43 Z1", "unknown-code error 20"),
    ("G95", "unknown-code error 20"),
    ("G17.1", "unknown-code error 23"),
    ("G90 G91", "two-codes-of-one-group error 21"),
    ("M62 M63 P1", "two-codes-of-one-group error 21"),
    ("G1 X1 F0", "feed-zero error 22"),
    ("G0 G49 X1", "codes-conflict error 24"),
    ("G0 G92 X1", "codes-conflict error 24"),
    ("G0 X1 X2", "word-given-twice error 25"),
    ("G2 I5 F100", "word-choice-missing error 26"),
    ("G4", "required-word-missing error 28"),
    ("M62", "required-word-missing error 28"),
    ("M67 E0", "required-word-missing error 28"),
    ("M61", "required-word-missing error 28"),
    ("G10 L2 P7 X0", "number-out-of-range error 29"),
    ("G80\nX1", "axis-words-without-motion-mode error 31"),
    ("G2 X10 Y0 I4 F100", "arc-end-off-circle error 33"),
    ("G2 X10 Y0 R4 F100", "arc-radius-too-small error 34"),
    ("G0 X1 P5", "word-not-read error 36"),
    ("G43.1", "required-word-missing error 37"),
    ("T100000000", "number-out-of-range error 38"),
    ("M64 P8", "number-out-of-range error 39"),
    ("M66 L0", "word-choice-missing error 28"),
    ("G0 X#<depth>", "named-parameter-unset error 2"),
];

#[test]
fn refusals_of_fluidnc_have_its_numbers() {
    assert_eq!(answered_otherwise("fluidnc", REFUSED_BY_FLUIDNC), "");
}

/// What both add to grbl is read: no error.
#[test]
fn what_the_descendants_read_is_no_error() {
    let both = [
        "T1 M6\nM3 S1000\nG1 X10 F100",
        "M61 Q3",
        "G0 X1 A90",
        "G2 X10 Y0 I5 P2 F100",
        "#<depth>=2\nG1 Z[-#<depth>] F100",
        "#100=[2+3*4]\nG1 X#100 F100",
        "o100 if [#5220 EQ 1]\nG1 X1 F100\no100 endif",
        "M62 P1\nG1 X1 F100",
        "%\nG0 X1",
    ];
    for program in both {
        for control in ["grblhal", "fluidnc"] {
            let text = format!("G21 G90 G17 G54\nG0 X0 Y0 Z5\n{program}\nM30\n");
            assert_eq!(errors(control, &text), [] as [String; 0], "{control}: {program}");
        }
    }
    let one = [
        ("grblhal", "M3 S1000\nG99 G81 X1 Y1 Z-3 R1 F100\nX2\nG80"),
        ("grblhal", "M3 S1000\nG98 G83 X1 Y1 Z-3 R1 Q1 F100\nG80"),
        ("grblhal", "M3 S1000\nG82 X1 Y1 Z-3 R1 P0.5 F100\nG73 X2 Y1 Z-3 R1 Q1\nG80"),
        ("grblhal", "G59.1 G0 X1"),
        ("grblhal", "T1 M6 G43 H1"),
        ("grblhal", "G2 I5 F100"),
        ("grblhal", "G92 X0\nG92.2\nG92.3\nG92.1"),
        ("grblhal", "/G0 X1"),
        // The factor is read, and the motion is lost, and no alarm follows.
        ("grblhal", "G0 G51 X2\nG50"),
        ("grblhal", "G51 X2\nG0 X1\nG50"),
        ("grblhal", "G50 G80"),
        ("fluidnc", "G53 G38.2 Z-20 F60"),
        ("fluidnc", "G38.2 Z-20 F60 P0"),
        ("fluidnc", "M7\nM8\nM7.1\nM8.1"),
        ("fluidnc", "M66 P0 L0\no1 if [#5399 EQ 0]\nM0\no1 endif"),
        ("fluidnc", "D#5220"),
        ("fluidnc", "G2 X10 Y0 I5 P0 F100"),
    ];
    for (control, program) in one {
        let text = format!("G21 G90 G17 G54\nG0 X0 Y0 Z5\n{program}\nM30\n");
        assert_eq!(errors(control, &text), [] as [String; 0], "{control}: {program}");
    }
}

/// Newer builds of the one have more codes, so one that is not listed is a warning without a number; a cycle that the
/// other does not have is an error.
#[test]
fn a_list_that_depends_on_the_build_is_no_ground_for_errors() {
    let unknown = |control: &str, program: &str| {
        let found = findings(control, program).into_iter().find(|finding| finding.rule.id == "unknown-code");
        found.map(|finding| (finding.severity, finding.alarm))
    };
    assert_eq!(unknown("grblhal", "G41\n"), Some((Severity::Warning, None)));
    assert_eq!(unknown("grblhal", "M150\n"), Some((Severity::Warning, None)));
    assert_eq!(unknown("fluidnc", "G83 X1\n"), Some((Severity::Error, Some("error 20".to_owned()))));
}

/// In one of the two orders the control reads both codes and loses one of them: a mistake, but no refusal.
#[test]
fn codes_that_are_refused_in_one_order_are_a_warning_in_the_other() {
    let found = findings("fluidnc", "G21 G90\nG92 G0 X1\nM30\n");
    let conflict = found.iter().find(|finding| finding.rule.id == "codes-conflict").unwrap();
    assert_eq!((conflict.severity, conflict.alarm.as_deref()), (Severity::Warning, None));
}

/// Whole jobs, as a shop would run them.
#[test]
fn jobs_without_a_mistake_have_no_finding() {
    for (control, program) in [
        ("grblhal", include_str!("../../../fixtures/firmware/grblhal.nc")),
        ("fluidnc", include_str!("../../../fixtures/firmware/fluidnc.nc")),
    ] {
        let found = findings(control, program);
        let told: Vec<_> = found.iter().map(|f| format!("{} {}", f.rule.id, f.message)).collect();
        assert_eq!(told, [] as [String; 0], "{control}");
        let told_by_its_head = gcheck_controls::guess(&gcheck_program::collect_evidence(program));
        assert_eq!(told_by_its_head.map(|guess| guess.control).as_deref(), Some(control));
    }
}
