//! Programs for the 4th and 5th axis: pages 176 to 188.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: choosing, naming
//! and switching off rotary units, their grid and tool change offsets, measuring the centres of rotation, jogging (pages
//! 176–186, 189, 190): work at the machine. G93, G187, G234 and G254 have their own pages in chapter 7.

use super::mill::{explains, gap, held, legal, mill, not_modelled, reports, rule};
use crate::proof::Proof;
use crate::statements::statement::{Chapter, prove};

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "4th and 5th axis",
    key: "FIVE",
    file: "haas_mill/five_axis.rs",
    statements: &[
        not_modelled(
            "p. 177, 182",
            "Tool center point control and dynamic work offsets need A, B, C to turn about X, Y, Z, and are an option.",
            "how the rotary axes are built and which options a machine has is not told; the entries of G234 and G254 name the option",
        ),
        not_modelled(
            "p. 182, 183",
            "Settings 255 to 257 are the centre of rotation from the home position, in the units of setting 9; G234 and G254 rest on them.",
            "machine coordinates under both codes are unknown here while a rotary axis is turned, whatever the centre",
        ),
        gap(
            "p. 182",
            "Without right settings 255 to 257 tool center point control and dynamic work offsets cannot be used.",
            "with `settings.255` to `257` told to be zero: a warning for G234 and G254; without them an assumption that they are right",
            &[Proof::Assumes {
                program: mill(
                    "O1\nT1 M6\nG20 G54 G0 G90 X0. Y0. B0. C0.\nG234 H1 Z1.\nG1 X1. B10. F20.\nG49\nM30\n",
                ),
                says: "setting 255",
            }],
        ),
        held(
            "p. 183",
            "Programs cannot change these settings: #20255 to #20257 are read only.",
            "variables 20000–29999",
            &[
                rule(
                    "error[assignment-to-read-only-variable]",
                    "O1\n#20255=1.\nM30\n",
                    "O1\n#100=#20255\nM30\n",
                ),
                rule(
                    "error[assignment-to-read-only-variable]",
                    "O1\n#20257=1.\nM30\n",
                    "O1\n#100=#20257\nM30\n",
                ),
            ],
        ),
        gap(
            "p. 187",
            "G93 is needed for moves of 4 or 5 axes together; with G234 feed per minute will do.",
            "warning[five-axis-feed-per-minute] for a feed move of linear and rotary axes in G94 without G234: the speed at the tool is not F",
            &[
                rule(
                    "warning[five-axis-feed-per-minute]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1. A0.\nS500 M3\nG1 X1. A10. F20.\nX2. A20.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1. A0.\nS500 M3\nG93 G1 X1. A10. F20.\nX2. A20. F20.\nG94\nM30\n",
                ),
                rule(
                    "warning[five-axis-feed-per-minute]",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1. A0. B0.\nS500 M3\nG1 X1. A10. B5. F20.\nM30\n",
                    "O1\nG20 G54 G0 G90 X0. Y0. Z1. A0. B0.\nS500 M3\nG234 H1 Z1.\nG1 X1. A10. B5. F20.\nG49\nM30\n",
                ),
            ],
        ),
        held(
            "p. 187",
            "In G93 the largest F is 45000.",
            "word `F` of `G93`",
            &[rule(
                "error[number-out-of-range]",
                "O1\nG20 G54 G0 G90 X0. A0.\nG93 G1 X1. A10. F45001.\nG94\nM30\n",
                "O1\nG20 G54 G0 G90 X0. A0.\nG93 G1 X1. A10. F45000.\nG94\nM30\n",
            )],
        ),
        gap(
            "p. 187",
            "In G93 the largest F is 45000, in every block that feeds.",
            "error[number-out-of-range] for F above 45000 in a later block under G93 as well",
            &[rule(
                "error[number-out-of-range]",
                "O1\nG20 G54 G0 G90 X0. A0.\nG93 G1 X1. A10. F40.\nX2. A20. F45001.\nG94\nM30\n",
                "O1\nG20 G54 G0 G90 X0. A0.\nG93 G1 X1. A10. F40.\nX2. A20. F45000.\nG94\nM30\n",
            )],
        ),
        not_modelled(
            "p. 187",
            "In a rapid move each axis runs at its own speed: the nearest arrives first, the farthest last.",
            "the way between the ends of a rapid is drawn straight; the time is that of the slowest axis",
        ),
        held(
            "p. 187",
            "A feed move brings all axes to their ends at the same time.",
            "times of feed moves",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90 X0. Y0. Z0. A0.\nG93 G1 X1. A10. F2.\nG94\nM30\n"),
                are: &["rapid", "feed X1. A10. T30."],
            }],
        ),
        not_modelled(
            "p. 187",
            "With lengths that were measured automatically, the Z of the work offsets is left at zero.",
            "how the lengths were measured is not in the program; what is told as an offset is taken as it is",
        ),
        held(
            "p. 188",
            "M10 and M11 close and open the brake of the 4th axis, M12 and M13 that of the 5th.",
            "entries of `M10` to `M13`",
            &[
                explains("M10", "Applies the brake of the 4th axis"),
                explains("M11", "Releases the brake of the 4th axis"),
                explains("M12", "Applies the brake of the 5th axis"),
                explains("M13", "Releases the brake of the 5th axis"),
                legal("O1\nM11\nM13\nG4 P1.\nM10\nM12\nM30\n"),
            ],
        ),
        gap(
            "p. 188",
            "A brake that M11 or M13 opened stays open until it is closed; cutting on other axes wears the gears then.",
            "info where the program ends, or cuts without rotary motion for a whole tool, after M11 without M10 (M13 without M12)",
            &[rule(
                "info[brake-left-open]",
                "O1\nG20 G54 G0 G90 X0. A0.\nS500 M3\nM11\nG93 G1 X1. A10. F20.\nG94\nM30\n",
                "O1\nG20 G54 G0 G90 X0. A0.\nS500 M3\nM11\nG93 G1 X1. A10. F20.\nG94\nM10\nM30\n",
            )],
        ),
        not_modelled(
            "p. 188",
            "With the brakes working by themselves the machine pauses between the blocks of a 4 or 5-axis cut.",
            "a time of the machine that no page gives",
        ),
        held(
            "p. 188",
            "G187 with P or E chooses smoothness or corner rounding in place of setting 85 until further notice.",
            "entry of `G187`",
            &[
                legal("O1\nG187 P1\nG187 P3 E.01\nG187 E.005\nG187\nM30\n"),
                rule("error[number-out-of-range]", "O1\nG187 P4\nM30\n", "O1\nG187 P3\nM30\n"),
                explains("G187", "counts instead of Setting 85"),
            ],
        ),
        not_modelled(
            "p. 188",
            "Setting 85 should be 0.05 for 5-axis cutting; smaller values come nearer to an exact stop and make the motion uneven.",
            "corner rounding is below what runs and plots show",
        ),
        gap(
            "p. 188",
            "Settings 34 and 79 are the diameters of the 4th and 5th axis, by which a feed per minute turns them.",
            "with the setting told, a rotary move in G94 takes its feed along that diameter; now the told setting is passed over and the number counts degrees a minute",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90 A0.\nG1 A360. F31.415927\nM30\n").with(&[
                    "machine.units=\"inch\"",
                    "machine.axes=[\"X\", \"Y\", \"Z\", \"A\"]",
                    "settings.34=10.0",
                ]),
                are: &["rapid", "feed A360. T60."],
            }],
        ),
        held(
            "p. 176",
            "A trunnion turns without end on its platter and to ±120° on its tilt.",
            "`machine.travel` of a rotary axis, rule move-outside-travel",
            &[
                Proof::Rule {
                    finding: "error[move-outside-travel]",
                    violates: mill("O1\nG20 G0 G90 G53 A121.\nM30\n")
                        .with(&["machine.units=\"inch\"", "machine.travel.A=[-120.0, 120.0]"]),
                    conforms: mill("O1\nG20 G0 G90 G53 A120.\nM30\n")
                        .with(&["machine.units=\"inch\"", "machine.travel.A=[-120.0, 120.0]"]),
                },
                reports("O1\nG20 G54 G0 G90 C720.\nC-1000.\nM30\n", &[]),
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
