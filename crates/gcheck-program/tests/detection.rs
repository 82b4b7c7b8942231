//! Which control is guessed of a program.
//!
//! Knows: programs of each kind. Must not know: any hint. Real programs are measured by the end-to-end tests.

fn guess(program: &str) -> Option<String> {
    gcheck_controls::guess(&gcheck_program::collect_evidence(program)).map(|guess| guess.control)
}

#[test]
fn headers_of_senders_and_lines_for_the_firmware_speak_for_their_control() {
    for program in [
        "; LightBurn 1.4.00\n; GRBL device profile, absolute coords\nG00 G17 G40 G21 G54\nG90\nM4\n",
        "(Carbide Create 7)\nG90\nG21\nM3 S12000\nG0 X1 Y1\n",
        "(posted for grbl 1.1)\nG21 G90\nG0 X1\n",
        "$H\nG21 G90\nG0 X1\nG38.2 Z-10 F50\n",
        "$110=500\nG0 X1\n",
    ] {
        assert_eq!(guess(program).as_deref(), Some("grbl"), "{program}");
    }
    for program in [
        "G21 G90\nG0 X1\n",
        "; LightBurn 1.4.00\n; Marlin device profile\nG0 X1\n",
        "(for grblHAL)\nG81 X1 Z-1 R1 F100\n",
        "(FluidNC, grbl)\nT1 M6\n",
        "(for Grbl_ESP32)\nT1 M6\n",
        "(carbide end mill)\nO1\nT1 M6\nG43 H1\n",
        "$1 S100 M3\n",
    ] {
        assert_ne!(guess(program).as_deref(), Some("grbl"), "{program}");
    }
}

/// A program that names one of them is its own; codes alone, which several firmwares read, speak for none.
#[test]
fn descendants_of_a_firmware_are_told_by_their_names() {
    for (program, control) in [
        ("(for grblHAL)\nG81 X1 Z-1 R1 F100\n", Some("grblhal")),
        ("; grblHAL 1.1f\nT1 M6\nG0 X1\n", Some("grblhal")),
        ("(FluidNC, grbl)\nT1 M6\n", Some("fluidnc")),
        ("(FluidNC)\n#<depth>=2\nG1 Z[-#<depth>] F100\n", Some("fluidnc")),
        ("(grblHAL)\n#<depth>=2\no100 if [1]\no100 endif\n", Some("grblhal")),
        ("(for grblHAL or FluidNC)\nG0 X1\n", None),
        ("T1 M6\nG0 X1\n", None),
    ] {
        assert_eq!(guess(program).as_deref(), control, "{program}");
    }
}

#[test]
fn a_lathe_is_of_another_system_of_codes_only_where_that_is_decisive() {
    let body = "T0101\nG96 S180 M3\nG0 X60. Z5.\nG1 X58. Z0.\nX56. Z-1.\nX54. Z-2.\n";
    for (head, control) in [
        ("O1\nG21 G99\nG50 S2500\n", "fanuc-lathe"),
        ("O1\nG21\n", "fanuc-lathe"),
        ("O1\nG21 G90 G95\nG92 S2500\n", "fanuc-lathe-b"),
        ("O1\nG71\nG90 G95\nG92 S2500\n", "fanuc-lathe-c"),
        ("O1\nG90 G95\nG50 S2500\n", "fanuc-lathe"),
    ] {
        assert_eq!(guess(&format!("{head}{body}")).as_deref(), Some(control), "{head}");
    }
}

#[test]
fn a_threading_cycle_of_two_blocks_outweighs_a_number_of_five_digits() {
    let program = |cycle: &str| {
        format!("O20111\nT0404\nG97 S600 M3\nG0 X28. Z6.\n{cycle}G0 X100. Z100.\nG28 U0. W0.\nM30\n")
    };
    let two = "G76 P020060 Q50 R0.02\nG76 X21.546 Z-30. P1227 Q300 F2.\n";
    assert_eq!(guess(&program(two)).as_deref(), Some("fanuc-lathe"));
    let one = "G76 X.4056 Z-.9 K.0472 D.012 F.0769\n";
    assert_eq!(guess(&program(one)).as_deref(), Some("haas-lathe"));
}
