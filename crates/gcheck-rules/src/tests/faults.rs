//! Every fault of the engine is reported by a rule.

use gcheck_engine::{ArcFault, CompensationFault, CornerFault, CycleFault, Fault, ValueFault};

use crate::RULES;
use crate::testing::{World, findings, recommended};

/// The rules that report a fault. Without a wildcard, so that a new fault needs a line here.
fn said(fault: &Fault) -> &'static [&'static str] {
    match fault {
        Fault::Value(fault) => said_of_value(*fault),
        Fault::Undecidable => &["block-not-decided"],
        Fault::UnsetParameter => &["named-parameter-unset"],
        Fault::ReadOnlyVariable(_) => &["assignment-to-read-only-variable", "computed-variable-read-only"],
        Fault::VariableNumber => &["variable-number-not-whole"],
        Fault::MissingValue(_) => &["address-without-value"],
        Fault::MissingWord(_) => &[
            "required-word-missing",
            "word-choice-missing",
            "thread-without-lead",
            "needed-word-missing",
            "word-unfit-for-another",
        ],
        Fault::WordRange(_) => &[
            "number-out-of-range",
            "sign-not-accepted",
            "decimal-point-on-integer",
            "computed-value-out-of-range",
            "word-unfit-for-another",
        ],
        Fault::UnknownCode => &["unknown-code", "code-must-come-first"],
        Fault::NotNow(..) => &["refused-in-plane", "cycle-in-inverse-time", "codes-conflict"],
        Fault::Malformed => {
            &["unexpected-text", "unclosed-bracket", "malformed-number", "words-beside-o-word"]
        }
        Fault::Conflict => &[
            "codes-conflict",
            "two-codes-of-one-group",
            "words-exclude-each-other",
            "machine-coordinates-in-increments",
            "polar-word-refused",
            "too-many-arguments",
            "word-unfit-for-another",
        ],
        Fault::WordTwice(_) => &["word-given-twice", "code-given-twice"],
        Fault::UnreadWord(_) => &["word-not-read", "word-forbidden", "word-of-newer-version"],
        Fault::Misplaced(_) => &["block-number-not-first"],
        Fault::TooManyCodes => &["too-many-m-codes"],
        Fault::LineTooLong => &["line-too-long"],
        Fault::TooFewPoints => &["curve-not-complete"],
        Fault::NoFeed => &["feed-missing", "feed-zero", "probe-without-feed"],
        Fault::NoInverseTimeFeed => &["inverse-time-feed-missing"],
        Fault::SpindleStopped => &["spindle-stopped-while-cutting"],
        Fault::SpindleDirection => &["tap-in-wrong-direction"],
        Fault::NoSuchAxis(_) => &["axis-not-on-machine", "cylinder-axis-not-on-machine", "unknown-address"],
        Fault::NoMotionMode => &["axis-words-without-motion-mode", "curve-not-complete"],
        Fault::NoAxisWords => &["motion-without-axis-words"],
        Fault::Arc(fault) => said_of_arc(*fault),
        Fault::Corner(CornerFault::RapidAfter) => &["corner-before-rapid"],
        Fault::Corner(_) => &["corner-does-not-fit"],
        Fault::Cycle(fault) => match fault {
            CycleFault::Missing(_) => &["cycle-word-missing", "cycle-words-lost", "cycle-dwell-missing"],
            CycleFault::RBelowBottom => &["cycle-r-below-bottom"],
            CycleFault::NotPositive(_) | CycleFault::ZeroRepeats => &["cycle-word-not-positive"],
            CycleFault::Zero(_) => &["number-out-of-range", "computed-value-out-of-range"],
            CycleFault::Rotary => &["cycle-with-rotary-word"],
            CycleFault::InverseTime => &["cycle-in-inverse-time"],
            CycleFault::Compensated => &["cycle-under-compensation"],
            CycleFault::Plane | CycleFault::Geometry => &["cycle-numbers-contradict"],
            CycleFault::OutlineOpen(_) | CycleFault::OutlineEmpty => &["pocket-outline-open"],
            CycleFault::StartOutside => &["pocket-start-outside"],
            CycleFault::ArcBelowTool { .. } => &["pocket-arc-below-tool"],
        },
        Fault::Compensation(fault) => match fault {
            CompensationFault::EntryTooShort { .. } => &["lead-in-too-short"],
            CompensationFault::EntryIsArc => &["compensation-on-in-arc"],
            CompensationFault::ExitIsArc => &["compensation-off-in-arc"],
            CompensationFault::Gouge => &["compensation-gouge"],
            CompensationFault::Plane | CompensationFault::NotWhileOn | CompensationFault::AlreadyOn => {
                &["refused-under-compensation"]
            }
        },
        Fault::NoSuchTool(_) => &["tool-not-in-table"],
        Fault::NoToolSelected => &["tool-change-without-t"],
        Fault::Probe => &["probe-move-refused"],
        Fault::NoDwellTime => &["required-word-missing", "word-choice-missing"],
        Fault::Profile => &["turning-profile-not-usable"],
        Fault::OverTravel(_) => &["move-outside-travel"],
        Fault::NoSavedModes => &["saved-modes-missing"],
        Fault::NoSuchLabel(_) => &["jump-target-missing", "jump-to-missing-block"],
        Fault::JumpTarget(_) => {
            &["jump-to-missing-block", "computed-value-out-of-range", "sign-not-accepted"]
        }
        Fault::NoSuchProgram => {
            &["subprogram-missing", "o-word-subroutine-missing", "turning-profile-not-usable"]
        }
        Fault::TooDeep => &["calls-nested-too-deep"],
        Fault::LoopMismatch => &[
            "loop-end-missing",
            "loop-begin-missing",
            "crossed-loops",
            "o-word-unmatched",
            "subroutine-inside-subroutine",
        ],
        Fault::StrayReturn => &["return-outside-subroutine", "o-word-unmatched"],
        Fault::NoProgramEnd => &["subprogram-without-return", "program-end-missing"],
        Fault::Alarm(_) => &["alarm-reached"],
    }
}

/// Of an expression without a value.
fn said_of_value(fault: ValueFault) -> &'static [&'static str] {
    match fault {
        ValueFault::DivisionByZero
        | ValueFault::NegativeRoot
        | ValueFault::LogarithmOfNonPositive
        | ValueFault::ArcFunctionRange
        | ValueFault::NegativePower
        | ValueFault::NotFinite => &["expression-without-value"],
        ValueFault::Malformed => &["missing-operand", "expression-too-deep", "stray-bracket"],
        ValueFault::NoSuchFunction => &["function-unknown"],
    }
}

/// Of an arc.
fn said_of_arc(fault: ArcFault) -> &'static [&'static str] {
    match fault {
        ArcFault::NoCentre => &["arc-without-centre", "arc-mode-left-on", "arc-wrong-plane-word"],
        ArcFault::CentreAndRadius => &["arc-centre-and-radius"],
        ArcFault::WrongPlane(_) => &["arc-wrong-plane-word"],
        ArcFault::ZeroRadius => &["zero-radius-arc"],
        ArcFault::RadiusTooSmall { .. } => &["arc-radius-too-small"],
        ArcFault::OffCircle { .. } => &["arc-end-off-circle"],
        ArcFault::FullCircleByRadius => &["full-circle-by-radius"],
        ArcFault::Turns => &["arc-turns-not-whole"],
    }
}

/// One of each, those with details apart.
fn plain_faults() -> Vec<Fault> {
    let letter = gcheck_controls::Letter::of('X');
    let code = gcheck_controls::CodeIx::NONE;
    vec![
        Fault::Undecidable,
        Fault::UnsetParameter,
        Fault::ReadOnlyVariable(0),
        Fault::VariableNumber,
        Fault::MissingValue(letter),
        Fault::MissingWord(letter),
        Fault::WordRange(letter),
        Fault::UnknownCode,
        Fault::NotNow(code, None),
        Fault::Malformed,
        Fault::Conflict,
        Fault::WordTwice(letter),
        Fault::UnreadWord(letter),
        Fault::Misplaced(letter),
        Fault::TooManyCodes,
        Fault::LineTooLong,
        Fault::TooFewPoints,
        Fault::NoFeed,
        Fault::NoInverseTimeFeed,
        Fault::SpindleStopped,
        Fault::SpindleDirection,
        Fault::NoSuchAxis(letter),
        Fault::NoMotionMode,
        Fault::NoAxisWords,
        Fault::NoSuchTool(1),
        Fault::NoToolSelected,
        Fault::Probe,
        Fault::NoDwellTime,
        Fault::Profile,
        Fault::OverTravel(letter),
        Fault::NoSavedModes,
        Fault::NoSuchLabel(1),
        Fault::JumpTarget(-1.0),
        Fault::NoSuchProgram,
        Fault::TooDeep,
        Fault::LoopMismatch,
        Fault::StrayReturn,
        Fault::NoProgramEnd,
        Fault::Alarm(1),
    ]
}

fn detailed_faults() -> Vec<Fault> {
    let letter = gcheck_controls::Letter::of('X');
    let mut faults = Vec::new();
    faults.extend(
        [
            ValueFault::DivisionByZero,
            ValueFault::NegativeRoot,
            ValueFault::LogarithmOfNonPositive,
            ValueFault::ArcFunctionRange,
            ValueFault::NegativePower,
            ValueFault::NotFinite,
            ValueFault::Malformed,
            ValueFault::NoSuchFunction,
        ]
        .map(Fault::Value),
    );
    faults.extend(
        [
            ArcFault::NoCentre,
            ArcFault::CentreAndRadius,
            ArcFault::WrongPlane(letter),
            ArcFault::ZeroRadius,
            ArcFault::RadiusTooSmall { half_chord: 2.0, radius: 1.0 },
            ArcFault::OffCircle { start: 1.0, end: 2.0 },
            ArcFault::FullCircleByRadius,
            ArcFault::Turns,
        ]
        .map(Fault::Arc),
    );
    faults.extend(
        [
            CornerFault::NoCutAfter,
            CornerFault::RapidAfter,
            CornerFault::NoTurn,
            CornerFault::TooLong { needed: 2.0, available: 1.0 },
        ]
        .map(Fault::Corner),
    );
    faults.extend(
        [
            CycleFault::Missing(letter),
            CycleFault::RBelowBottom,
            CycleFault::NotPositive(letter),
            CycleFault::Zero(letter),
            CycleFault::ZeroRepeats,
            CycleFault::Rotary,
            CycleFault::InverseTime,
            CycleFault::Compensated,
            CycleFault::Plane,
            CycleFault::Geometry,
            CycleFault::OutlineOpen(1.0),
            CycleFault::OutlineEmpty,
            CycleFault::StartOutside,
            CycleFault::ArcBelowTool { arc: 1.0, tool: 2.0 },
        ]
        .map(Fault::Cycle),
    );
    faults.extend(
        [
            CompensationFault::EntryTooShort { needed: 2.0, got: 1.0 },
            CompensationFault::EntryIsArc,
            CompensationFault::ExitIsArc,
            CompensationFault::Gouge,
            CompensationFault::Plane,
            CompensationFault::NotWhileOn,
            CompensationFault::AlreadyOn,
        ]
        .map(Fault::Compensation),
    );
    faults
}

#[test]
fn every_fault_is_spoken_for_by_rules_that_exist() {
    let faults: Vec<Fault> = plain_faults().into_iter().chain(detailed_faults()).collect();
    let mut wrong = Vec::new();
    for fault in &faults {
        let rules = said(fault);
        assert!(!rules.is_empty(), "{fault:?}");
        let unknown = rules.iter().filter(|id| RULES.by_id(id).is_none());
        wrong.extend(unknown.map(|id| format!("{fault:?}: {id}")));
    }
    assert!(wrong.is_empty(), "rules that do not exist: {wrong:#?}");
}

/// Programs that raise a fault, each with the words that the table above promises.
#[test]
fn a_program_that_cannot_be_executed_has_a_finding() {
    let programs: &[(&str, &str, Fault)] = &[
        ("fanuc-mill", "O1\n#2=1/0\nM30\n", Fault::Value(ValueFault::DivisionByZero)),
        ("linuxcnc", "G21\nG0 X#<width>\nM2\n", Fault::UnsetParameter),
        ("fanuc-mill", "O1\n#0=1\nM30\n", Fault::ReadOnlyVariable(0)),
        ("fanuc-mill", "O1\n#1=#[1.5]\nM30\n", Fault::VariableNumber),
        ("fanuc-mill", "O1\nG0 X\nM30\n", Fault::MissingValue(gcheck_controls::Letter::of('X'))),
        ("fanuc-mill", "O1\nM98\nM30\n", Fault::MissingWord(gcheck_controls::Letter::of('P'))),
        ("linuxcnc", "G21\nM3 S-5\nM2\n", Fault::WordRange(gcheck_controls::Letter::of('S'))),
        ("fanuc-mill", "O1\nG999\nM30\n", Fault::UnknownCode),
        ("linuxcnc", "G0 G1 X1 F10\nM2\n", Fault::Conflict),
        ("linuxcnc", "G21 G91\nG53 G0 X1\nM2\n", Fault::Conflict),
        ("linuxcnc", "G21\nG1 X1\nM2\n", Fault::NoFeed),
        ("linuxcnc", "G21 G90 F9 G0 X0 Y0 Z9\nM4 S9\nG84 Z1 R5\nM2\n", Fault::SpindleDirection),
        ("linuxcnc", "G21 G93\nG1 X1\nM2\n", Fault::NoInverseTimeFeed),
        ("linuxcnc", "G21\nX1\nM2\n", Fault::NoMotionMode),
        (
            "linuxcnc",
            "G21 F100 G90 G0 X0 Y0\nG2 X10 Y0 R1\nM2\n",
            Fault::Arc(ArcFault::RadiusTooSmall { half_chord: 5.0, radius: 1.0 }),
        ),
        (
            "linuxcnc",
            "G21 F100 G90 G0 X0 Y0 Z5\nG81 X1 Y1 Z2 R1\nM2\n",
            Fault::Cycle(CycleFault::RBelowBottom),
        ),
        (
            "linuxcnc",
            "G21 G90 F100\nG41.1 D6 G1 X10\nG1 Y10\nG28\nM2\n",
            Fault::Compensation(CompensationFault::NotWhileOn),
        ),
        ("linuxcnc", "M72\nM2\n", Fault::NoSavedModes),
        ("fanuc-mill", "O1\nGOTO 50\nM30\n", Fault::NoSuchLabel(50)),
        ("fanuc-mill", "O1\nGOTO-3\nM30\n", Fault::JumpTarget(-3.0)),
        ("haas-mill", "O1\n#100=-3\nGOTO#100\nM30\n", Fault::JumpTarget(-3.0)),
        ("haas-lathe", "O1\nGOTO[0-3]\nM30\n", Fault::JumpTarget(-3.0)),
        ("linuxcnc", "o7 call\nM2\n", Fault::NoSuchProgram),
        ("fanuc-mill", "O1\nM98 P2\nM30\nO2\nM98 P2\nM99\n", Fault::TooDeep),
        ("fanuc-mill", "O1\nEND1\nM30\n", Fault::LoopMismatch),
        ("linuxcnc", "o1 return\nM2\n", Fault::StrayReturn),
        ("haas-mill", "M97 P10\nM30\nN10 G0 X1.\n", Fault::NoProgramEnd),
    ];
    let mut silent = Vec::new();
    for (control, program, fault) in programs {
        let rules = said(fault);
        let found = findings(&recommended(), control, program, &World::default());
        if !found.iter().any(|finding| rules.contains(&finding.rule.id)) {
            let ids: Vec<_> = found.iter().map(|finding| finding.rule.id).collect();
            silent.push(format!("{control} {program:?}: {fault:?} is told by {ids:?}, not by {rules:?}"));
        }
    }
    assert!(silent.is_empty(), "{silent:#?}");
}
