//! The example programs of the Haas mill manual, pages 243 to 361: chapters 7 and 8; chapter 9 has none.
//!
//! Knows: where each program is, what is around a snippet to make it a program, verdicts on findings, numbers that text and
//! figures state. Must not know: how anything is checked. Left out: outlines whose blocks are dots or headings (pages 284, 352,
//! 359), and single blocks that only switch an output.

use super::example::{Expected, Finding, Shows, Verdict};
use super::haas_manual::{Example, Part, Place, every_example};

#[test]
fn every_example_does_what_the_manual_says() {
    every_example(EXAMPLES, "Haas mill manual, chapters 7 to 9");
}

const EXAMPLES: &[Example] = &[
    Example {
        at: "p. 243",
        what: "one hole, then nine more by increments",
        text: &[
            Part::Ours("%\nO1\nG20 G90 G54\nT1 M6\nG0 X0 Y0\nS1000 M3\nG43 H1 Z1. M8\n"),
            Part::Theirs(Place {
                page: 243,
                first: 0x0740_144b_a27b_251f,
                lines: 4,
                all: 0xc5ba_bb6d_2c1b_5498,
            }),
            Part::Ours("G80 G90 G0 Z1. M9\nM5\nG53 G49 Z0\nM30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 0.0000 0.0000 -0.5000 6.5",
                "feed -0.5625 0.0000 -0.5000 6.5",
                "feed -1.1250 0.0000 -0.5000 6.5",
                "feed -1.6875 0.0000 -0.5000 6.5",
                "feed -2.2500 0.0000 -0.5000 6.5",
                "feed -2.8125 0.0000 -0.5000 6.5",
                "feed -3.3750 0.0000 -0.5000 6.5",
                "feed -3.9375 0.0000 -0.5000 6.5",
                "feed -4.5000 0.0000 -0.5000 6.5",
                "feed -5.0625 0.0000 -0.5000 6.5",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 244",
        what: "a bolt circle about a place that is not drilled",
        text: &[
            Part::Ours("%\nO1\nG20 G90 G54\nT1 M6\nG0 X0 Y0\nS1000 M3\nG43 H1 Z1. M8\n"),
            Part::Theirs(Place {
                page: 244,
                first: 0x930a_6827_e41a_147e,
                lines: 4,
                all: 0x826c_8b35_1229_8542,
            }),
            Part::Ours("G80 G90 G0 Z1. M9\nM5\nG53 G49 Z0\nM30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 1.9886 -0.6198 -0.5000",
                "feed 1.5065 -0.0452 -0.5000",
                "feed 0.7679 -0.1755 -0.5000",
                "feed 0.5114 -0.8802 -0.5000",
                "feed 0.9935 -1.4548 -0.5000",
                "feed 1.7321 -1.3245 -0.5000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 246",
        what: "a grid of holes, row by row",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 246,
                first: 0xcc07_60f5_11f3_8070,
                lines: 24,
                all: 0xe4c9_7222_4a1d_f779,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 1.0000 -1.0000 -1.5000 15",
                "feed 2.0000 -1.0000 -1.5000 15",
                "feed 3.0000 -1.0000 -1.5000 15",
                "feed 3.0000 -2.0000 -1.5000 15",
                "feed 2.0000 -2.0000 -1.5000 15",
                "feed 1.0000 -2.0000 -1.5000 15",
                "feed 1.0000 -3.0000 -1.5000 15",
                "feed 2.0000 -3.0000 -1.5000 15",
                "feed 3.0000 -3.0000 -1.5000 15",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 247, 248",
        what: "holes around an obstacle",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 247,
                first: 0x7864_077a_e7d8_aed7,
                lines: 28,
                all: 0x9dc6_a95f_14d6_2704,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[Finding(
                "info[cycle-r-in-material] 13",
                Verdict::True,
                "the zero is the top of the part, and every hole begins below it at rapid",
            )],
            shows: &[Shows::Run(&[
                "feed 2.0000 -0.5000 -2.0000",
                "rapid 2.0000 -0.5000 0.1000",
                "feed 4.0000 -0.5000 -2.0000",
                "rapid 5.5000 -0.5000 0.1000",
                "rapid 5.5000 -2.0000 0.1000",
                "feed 5.5000 -2.0000 -2.0000",
                "feed 5.5000 -4.0000 -2.0000",
                "rapid 5.5000 -5.5000 0.1000",
                "feed 4.0000 -5.5000 -2.0000",
                "feed 2.0000 -5.5000 -2.0000",
                "rapid 0.5000 -5.5000 0.1000",
                "feed 0.5000 -4.0000 -2.0000",
                "feed 0.5000 -2.0000 -2.0000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 250",
        what: "a chamfer and a rounded corner",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 250,
                first: 0xf40f_ee1c_a28e_7f32,
                lines: 22,
                all: 0x23f6_5bc0_c419_96d0,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 0.0000 -4.0000 -0.5000",
                "feed -1.0000 -5.0000 -0.5000",
                "feed -4.0000 -5.0000 -0.5000",
                "arc -5.0000 -4.0000 -0.5000",
                "feed -5.0000 0.0000 -0.5000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 252",
        what: "an arc by a positive radius",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 252,
                first: 0x24ad_21c8_64a6_a760,
                lines: 21,
                all: 0x0ea3_a264_3833_b576,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed -0.2500 1.5000 -0.5000 12",
                "arc 1.8840 2.3840 -0.5000 12 14.728 cw 135.02 deg",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 253",
        what: "an arc by a negative radius",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 253,
                first: 0x9457_6e23_af2d_ef53,
                lines: 21,
                all: 0x10f6_9c7c_1aeb_a282,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed -0.2500 1.5000 -0.5000 12",
                "arc 1.8840 0.6160 -0.5000 12 24.542 cw 224.98 deg",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 255",
        what: "a thread milled inside",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 255,
                first: 0x24ed_2c6f_f5ff_6d27,
                lines: 28,
                all: 0x43b8_059a_444c_b8ff,
            }),
        ],
        files: &[],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[Finding(
                "warning[missing-decimal-point] 23",
                Verdict::True,
                "the manual's way out goes to Y1 without a point, which is 0.0001",
            )],
            shows: &[Shows::Run(&[
                "feed 0.0000 0.0000 -0.5156 50",
                "-0.5000",
                "arc 0.2500 0.0000 -0.3750 20",
                "-0.3594",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 256, 257",
        what: "a thread milled outside",
        text: &[Part::Theirs(Place {
            page: 256,
            first: 0x00f7_ded2_5fdb_f5e7,
            lines: 26,
            all: 0x5448_55a1_9e40_74c6,
        })],
        files: &[],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "rapid 0.0000 2.4000 -1.0000",
                "arc 0.0000 1.2120 -1.0625 25",
                "feed 0.0000 2.4000 -1.0625",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 257, 258",
        what: "a thread milled by one point, turn by turn",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 257,
                first: 0x2ce1_ccc8_268e_ffb3,
                lines: 26,
                all: 0x3650_4956_4e76_84b1,
            }),
        ],
        files: &[],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[],
            shows: &[],
            not_yet: &[Shows::Run(&[
                "arc 0.2500 0.0000 -0.2750 20",
                "arc 0.2500 0.0000 -0.1500 20",
                "arc 0.2500 0.0000 -0.0250 20",
                "arc 0.2500 0.0000 0.1000 20",
                "arc 0.2500 0.0000 0.2250 20",
            ])],
        },
    },
    Example {
        at: "p. 259",
        what: "offsets written by a program",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 259,
                first: 0x7d13_b732_8414_ce24,
                lines: 11,
                all: 0xb96a_5e97_60c3_1ffc,
            }),
            Part::Ours("M30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 260, 261",
        what: "round pockets by one pass and by several",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 260,
                first: 0x54a6_e712_dfe2_40a9,
                lines: 30,
                all: 0xd30b_1e0f_c043_708c,
            }),
        ],
        files: &[],
        config: &["tools.1.diameter=0.25"],
        expected: Expected {
            findings: &[
                Finding(
                    "warning[pocket-step-above-tool] 17",
                    Verdict::True,
                    "circles 1 in apart leave ridges with the tool of 0.25 in, as the same page tells",
                ),
                Finding(
                    "warning[pocket-step-above-tool] 24",
                    Verdict::True,
                    "circles 0.3 in apart leave ridges with the tool of 0.25 in",
                ),
            ],
            shows: &[Shows::Run(&[
                "arc 0.6250 0.0000 -1.2000 10",
                "rapid 5.0000 0.0000 0.1000",
                "arc 5.1750 0.0000 -1.2000",
                "arc 6.3750 0.0000 -1.2000",
                "arc 11.3750 0.0000 -1.2000",
                "arc 15.1750 0.0000 -1.2000",
                "arc 16.3750 0.0000 -1.2000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 262",
        what: "a round pocket in four steps of depth",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 262,
                first: 0x32a8_2bfb_da57_155d,
                lines: 20,
                all: 0x63c4_fe5d_b87f_2dea,
            }),
        ],
        files: &[],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "arc 1.7500 0.0000 -0.4000 20",
                "arc 1.7500 0.0000 -0.9000 20",
                "arc 1.7500 0.0000 -1.4000 20",
                "arc 1.7500 0.0000 -1.9000 20",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 265",
        what: "a surface touched by the spindle's probe",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 265,
                first: 0x6b33_6d45_8682_bbc4,
                lines: 17,
                all: 0x9864_62d4_f352_bc50,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&["probe 0.0000 0.0000 -0.2500 50", "rapid 0.0000 0.0000 1.0000"])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 266, 267",
        what: "a tool's diameter measured",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 266,
                first: 0x4ac1_5240_d665_c434,
                lines: 29,
                all: 0xff46_230a_26d2_9e4c,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "dwell 1.000",
                "feed 0.0000 -1.0000 -0.2500 50",
                "probe 0.0000 -0.2500 -0.2500 10",
                "feed 0.0000 1.0000 -0.2500 25",
                "probe 0.0000 0.2050 -0.2500 10",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 268",
        what: "a work offset measured",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 268,
                first: 0x31f2_4f40_911e_1a5a,
                lines: 19,
                all: 0xa848_2f25_1073_0595,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&["feed 0.0000 0.5000 -0.5000 50", "probe 0.0000 -0.2000 -0.5000 10"])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 270",
        what: "a tool's length measured",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 270,
                first: 0x530f_391c_3038_4605,
                lines: 17,
                all: 0x74f5_0f17_6706_faec,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&["dwell 1.000", "probe 0.0000 0.0000"])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 271",
        what: "text with sharp corners",
        text: &[
            Part::Ours("%\nO1\nG20 G90 G54\nT1 M6\nG0 X0 Y0\nS1000 M3\nG43 H1 Z1. M8\n"),
            Part::Theirs(Place {
                page: 271,
                first: 0xbdf2_2fa4_4f16_1c7a,
                lines: 4,
                all: 0xce53_7183_b99d_a649,
            }),
            Part::Ours("G80 G90 G0 Z1. M9\nM5\nG53 G49 Z0\nM30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 272",
        what: "text at an angle",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 272,
                first: 0x8509_9175_e459_79db,
                lines: 20,
                all: 0xe50f_b4bb_e6d2_8652,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 274",
        what: "a serial number",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 274,
                first: 0xf2fc_5ba7_04d9_63f5,
                lines: 11,
                all: 0x1f6a_de0f_ec25_e710,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 275",
        what: "a serial number around a part",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 275,
                first: 0x1fba_3b2e_cef1_2c94,
                lines: 19,
                all: 0x5984_2962_8c7a_56ca,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 278",
        what: "scaling from the origin",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 278,
                first: 0x9510_6e15_c313_20ff,
                lines: 1,
                all: 0x5e0c_03fa_7981_004f,
            }),
        ],
        files: &[(
            "O60511.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 277,
                    first: 0x7a74_c423_d332_5c70,
                    lines: 11,
                    all: 0x850d_4c2b_3035_9088,
                }),
            ],
        )],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 2.0000 0.0000",
                "feed 2.0000 2.0000",
                "arc 1.0000 2.0000",
                "feed 1.0000 1.0000",
                "feed 4.0000 2.0000",
                "feed 4.0000 4.0000",
                "arc 2.0000 4.0000",
                "feed 2.0000 2.0000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 278, 279",
        what: "scaling from the middle",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 278,
                first: 0x99ba_7a10_dcde_1f3b,
                lines: 20,
                all: 0x72db_e9c8_33a6_ff03,
            }),
        ],
        files: &[(
            "O60511.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 277,
                    first: 0x7a74_c423_d332_5c70,
                    lines: 11,
                    all: 0x850d_4c2b_3035_9088,
                }),
            ],
        )],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 2.5000 0.5000",
                "feed 2.5000 2.5000",
                "arc 0.5000 2.5000",
                "feed 0.5000 0.5000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 279, 280",
        what: "scaling from an edge",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 279,
                first: 0x5c8c_9f2b_d67e_3892,
                lines: 24,
                all: 0xeef8_687b_294d_864e,
            }),
        ],
        files: &[(
            "O60511.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 277,
                    first: 0x7a74_c423_d332_5c70,
                    lines: 11,
                    all: 0x850d_4c2b_3035_9088,
                }),
            ],
        )],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 3.0000 1.0000",
                "feed 3.0000 3.0000",
                "arc 1.0000 3.0000",
                "feed 1.0000 1.0000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 282",
        what: "rotation about the origin",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 282,
                first: 0x2390_74b0_1aa6_50ea,
                lines: 9,
                all: 0x940a_1158_3207_e9b0,
            }),
            Part::Ours("%\n"),
        ],
        files: &[(
            "O60681.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 282,
                    first: 0x3889_4bc8_7a46_0608,
                    lines: 8,
                    all: 0x84e4_72c4_b334_3b43,
                }),
                Part::Ours("%\n"),
            ],
        )],
        config: &[],
        expected: Expected {
            findings: &[Finding(
                "info[spindle-stopped-while-cutting] 9",
                Verdict::True,
                "the programs of the figure set a speed and never start the spindle",
            )],
            shows: &[Shows::Run(&[
                "feed 2.0000 1.0000",
                "feed 2.0000 2.0000",
                "arc 1.0000 2.0000",
                "feed 1.0000 1.0000",
                "rapid -0.3660 1.3660",
                "feed 0.1340 2.2321",
                "feed -0.7321 2.7321",
                "arc -1.2321 1.8660",
                "feed -0.3660 1.3660",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 283",
        what: "rotation about the middle of a window",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 283,
                first: 0xb833_36d9_b32b_d558,
                lines: 10,
                all: 0x879b_4c39_ea04_049b,
            }),
        ],
        files: &[(
            "O60681.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 282,
                    first: 0x3889_4bc8_7a46_0608,
                    lines: 8,
                    all: 0x84e4_72c4_b334_3b43,
                }),
                Part::Ours("%\n"),
            ],
        )],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 2.1830 1.6830",
                "feed 1.3170 2.1830",
                "arc 0.8170 1.3170",
                "feed 1.6830 0.8170",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 283, 284",
        what: "a pattern rotated six times",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 283,
                first: 0x72be_3fdd_ce01_9242,
                lines: 11,
                all: 0xba4e_f124_5a0a_f764,
            }),
        ],
        files: &[(
            "O60681.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 282,
                    first: 0x3889_4bc8_7a46_0608,
                    lines: 8,
                    all: 0x84e4_72c4_b334_3b43,
                }),
                Part::Ours("%\n"),
            ],
        )],
        config: &["settings.73=true"],
        expected: Expected {
            findings: &[],
            shows: &[],
            not_yet: &[Shows::Run(&[
                "feed 0.1340 2.2321",
                "feed -1.8660 1.2321",
                "feed -2.0000 -1.0000",
                "feed -0.1340 -2.2321",
                "feed 1.8660 -1.2321",
                "feed 2.0000 1.0000",
            ])],
        },
    },
    Example {
        at: "p. 284, 285",
        what: "holes on a bolt circle",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 284,
                first: 0x1155_40cc_62a4_5580,
                lines: 23,
                all: 0x2064_00b4_8b93_1c28,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 4.8296 1.2941 -1.0000 15",
                "feed 3.5355 3.5355 -1.0000 15",
                "feed 1.2941 4.8296 -1.0000 15",
                "feed -1.2941 4.8296 -1.0000 15",
                "feed -3.5355 3.5355 -1.0000 15",
                "feed -4.8296 1.2941 -1.0000 15",
                "feed -4.8296 -1.2941 -1.0000 15",
                "feed -3.5355 -3.5355 -1.0000 15",
                "feed -1.2941 -4.8296 -1.0000 15",
                "feed 1.2941 -4.8296 -1.0000 15",
                "feed 3.5355 -3.5355 -1.0000 15",
                "feed 4.8296 -1.2941 -1.0000 15",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 290",
        what: "back boring",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 290,
                first: 0x9d4a_1294_614b_37fa,
                lines: 11,
                all: 0x73b6_8214_58e0_ac58,
            }),
        ],
        files: &[],
        config: &["settings.27=\"x+\""],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "rapid 0.1000 0.0000 -1.6000",
                "rapid 0.0000 0.0000 -1.6000",
                "feed 0.0000 0.0000 -1.0000 10",
                "rapid 0.1000 0.0000 0.1000",
                "rapid -1.9000 0.0000 -1.6000",
                "feed -2.0000 0.0000 -1.0000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 293",
        what: "drilling",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 293,
                first: 0x5856_1c36_c4a6_8b55,
                lines: 23,
                all: 0xb532_3492_46c3_ad9f,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 2.0000 -2.0000 -0.7200 15",
                "feed 2.0000 -4.0000 -0.7200 15",
                "feed 4.0000 -4.0000 -0.7200 15",
                "feed 4.0000 -2.0000 -0.7200 15",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 294",
        what: "spot drilling",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 294,
                first: 0x87c8_2745_a725_2c6d,
                lines: 22,
                all: 0xa6c8_86b8_8dce_bed4,
            }),
            Part::Ours("%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 2.0000 -2.0000 -0.7200 15",
                "dwell 0.3",
                "feed 2.0000 -4.0000 -0.7200 15",
                "dwell 0.3",
                "feed 4.0000 -4.0000 -0.7200 15",
                "dwell 0.3",
                "feed 4.0000 -2.0000 -0.7200 15",
                "dwell 0.3",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 295",
        what: "a dwell at the end of the last peck",
        text: &[
            Part::Ours("%\nO1\nG20 G90 G54\nT1 M6\nG0 X0 Y0\nS1000 M3\nG43 H1 Z1. M8\n"),
            Part::Theirs(Place {
                page: 295,
                first: 0x6741_1ea1_1fbe_7b95,
                lines: 1,
                all: 0x3222_aac8_f0ac_0f2d,
            }),
            Part::Ours("G80 G90 G0 Z1. M9\nM5\nG53 G49 Z0\nM30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 0.0000 0.0000 -0.0750 15",
                "feed 0.0000 0.0000 -0.2500 15",
                "feed 0.0000 0.0000 -0.4250 15",
                "feed 0.0000 0.0000 -0.6000 15",
                "feed 0.0000 0.0000 -0.6200 15",
                "dwell 1.5",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 296, 297",
        what: "pecks",
        text: &[Part::Theirs(Place {
            page: 296,
            first: 0xd07e_7ab6_9ad7_3ec5,
            lines: 23,
            all: 0x2e61_8b36_fe11_9897,
        })],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 2.0000 -2.0000 -0.0750 15",
                "feed 2.0000 -2.0000 -0.2500 15",
                "feed 2.0000 -2.0000 -0.4250 15",
                "feed 2.0000 -2.0000 -0.6000 15",
                "feed 2.0000 -2.0000 -0.7200 15",
                "feed 2.0000 -4.0000 -0.0750 15",
                "feed 2.0000 -4.0000 -0.2500 15",
                "feed 2.0000 -4.0000 -0.4250 15",
                "feed 2.0000 -4.0000 -0.6000 15",
                "feed 2.0000 -4.0000 -0.7200 15",
                "feed 4.0000 -4.0000 -0.0750 15",
                "feed 4.0000 -4.0000 -0.2500 15",
                "feed 4.0000 -4.0000 -0.4250 15",
                "feed 4.0000 -4.0000 -0.6000 15",
                "feed 4.0000 -4.0000 -0.7200 15",
                "feed 4.0000 -2.0000 -0.0750 15",
                "feed 4.0000 -2.0000 -0.2500 15",
                "feed 4.0000 -2.0000 -0.4250 15",
                "feed 4.0000 -2.0000 -0.6000 15",
                "feed 4.0000 -2.0000 -0.7200 15",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 298",
        what: "tapping",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 298,
                first: 0x13e1_3d92_ec0e_351f,
                lines: 24,
                all: 0x146a_b597_7efb_753e,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 2.0000 -2.0000 -0.6000 56.25",
                "feed 2.0000 -4.0000 -0.6000 56.25",
                "feed 4.0000 -4.0000 -0.6000 56.25",
                "feed 4.0000 -2.0000 -0.6000 56.25",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 302",
        what: "offsets shifted and shifted back",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 302,
                first: 0xc99d_9f5c_308e_bb7c,
                lines: 9,
                all: 0x1924_0477_4023_96e6,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 303",
        what: "between the holes to the start or to R",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 303,
                first: 0x375e_91f8_f4e7_8148,
                lines: 20,
                all: 0x13a8_036a_5178_27bd,
            }),
            Part::Ours("%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 1.0000 -0.5000 -0.5000 10",
                "rapid 2.0000 -0.5000 0.1000",
                "feed 2.0000 -0.5000 -0.5000 10",
                "rapid 2.0000 -0.5000 2.0000",
                "rapid 4.0000 -0.5000 2.0000",
                "feed 4.0000 -0.5000 -0.5000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 304, 305",
        what: "between the holes to R",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 304,
                first: 0x375e_91f8_f4e7_8148,
                lines: 21,
                all: 0x7e52_ff34_e68a_1526,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 1.0000 -0.5000 -0.5000 10",
                "rapid 2.0000 -0.5000 0.1000",
                "feed 2.0000 -0.5000 -0.5000 10",
                "rapid 2.0000 -0.5000 2.0000",
                "rapid 4.0000 -0.5000 2.0000",
                "feed 4.0000 -0.5000 -0.5000",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 308",
        what: "the middle of a part measured",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 308,
                first: 0x27e7_2976_6cbb_4e22,
                lines: 26,
                all: 0x8220_83fb_134c_2514,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "feed 0.0000 1.0000 -11.0000 20",
                "probe 0.0000 0.0000 -11.0000 10",
                "-9.0000",
                "-11.0000 20",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 310",
        what: "compensation in space",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 310,
                first: 0xf3f3_b88b_b722_379b,
                lines: 27,
                all: 0x26c5_a1c9_41c6_5531,
            }),
            Part::Ours("%\n"),
        ],
        files: &[],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[Finding(
                "warning[tool-length-missing] 9",
                Verdict::True,
                "the page moves to Z0 of the work before it gives a length",
            )],
            shows: &[Shows::Run(&[
                "feed 0.0350 0.0600 0.2537",
                "feed 0.0575 0.0925 0.2792",
                "feed 0.0700 0.1300 0.2972",
                "feed 2.4075 0.2109 -1.0083",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 311, 312",
        what: "compensation in space along one axis",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 311,
                first: 0x8f70_abfa_488e_1802,
                lines: 24,
                all: 0xbdd1_a9bc_46b4_0010,
            }),
        ],
        files: &[],
        config: &["tools.1.diameter=-0.02"],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&["feed 5.0000 0.0100 0.0000 300"])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 312, 313",
        what: "length along the tool's axis",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 312,
                first: 0xc595_2092_fc07_146c,
                lines: 26,
                all: 0xb607_95d7_dd05_0005,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&[
                "0.200  inverse time  posted point X0.01 Y0.01 Z0.01",
                "0.300  inverse time  posted point X2.345 Y0.1234 Z-1.234",
            ])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 314, 315",
        what: "a pocket with rounded corners",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 314,
                first: 0xe8dd_d163_f817_ae63,
                lines: 23,
                all: 0x07d4_95bd_527c_80ca,
            }),
        ],
        files: &[(
            "O61502.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 315,
                    first: 0xbf22_d986_6230_7aac,
                    lines: 15,
                    all: 0x8355_cab9_51ee_d824,
                }),
            ],
        )],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[Finding(
                "error[nested-comment] 17",
                Verdict::False,
                "the manual writes a comment in this way in four examples",
            )],
            shows: &[],
            not_yet: &[Shows::Run(&["-0.1500", "-0.4000", "-1.5000"])],
        },
    },
    Example {
        at: "p. 316, 317",
        what: "a square pocket by positions",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 316,
                first: 0xb8cb_b97a_cf87_75a2,
                lines: 24,
                all: 0x7542_3200_9783_fec1,
            }),
        ],
        files: &[(
            "O61504.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 317,
                    first: 0x97d3_6668_1b6a_f8ac,
                    lines: 11,
                    all: 0xe25f_06a8_1eaf_ce3e,
                }),
            ],
        )],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[Finding(
                "error[nested-comment] 18",
                Verdict::False,
                "the manual writes a comment in this way in four examples",
            )],
            shows: &[],
            not_yet: &[Shows::Run(&["-0.2400", "-0.4900", "-0.5000"])],
        },
    },
    Example {
        at: "p. 318, 319",
        what: "a pocket with a square island",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 318,
                first: 0x27e9_1a68_370f_41ea,
                lines: 24,
                all: 0x1964_ae48_f7e3_fb4c,
            }),
        ],
        files: &[(
            "O61507.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 319,
                    first: 0x8488_f344_b0ea_3bff,
                    lines: 19,
                    all: 0xcb8e_9fdc_eff6_615b,
                }),
            ],
        )],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[Finding(
                "error[nested-comment] 18",
                Verdict::False,
                "the manual writes a comment in this way in four examples",
            )],
            shows: &[],
            not_yet: &[Shows::Run(&["-0.4900"])],
        },
    },
    Example {
        at: "p. 319, 320",
        what: "a pocket with a round island",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 319,
                first: 0x9ef8_4de8_a8da_a9c3,
                lines: 21,
                all: 0x9e27_be5a_a3aa_4db8,
            }),
        ],
        files: &[(
            "O61509.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 320,
                    first: 0x3b4a_b6f3_1c94_6df6,
                    lines: 17,
                    all: 0x6b98_495e_4f2f_8f9f,
                }),
            ],
        )],
        config: &["tools.1.diameter=0.5"],
        expected: Expected {
            findings: &[Finding(
                "error[nested-comment] 16",
                Verdict::False,
                "the manual writes a comment in this way in four examples",
            )],
            shows: &[],
            not_yet: &[Shows::Run(&["-0.4900"])],
        },
    },
    Example {
        at: "p. 325, 326",
        what: "a drill along a tilted head",
        text: &[Part::Theirs(Place {
            page: 325,
            first: 0x95d8_8a6b_1fe1_c08c,
            lines: 16,
            all: 0x0c0f_6bd8_c806_9a9b,
        })],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[Finding("info[program-number-missing] 7", Verdict::True, "the page gives no number")],
            shows: &[],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 326, 327",
        what: "a spot drill along a tilted head",
        text: &[
            Part::Ours("%\nO1\n"),
            Part::Theirs(Place {
                page: 326,
                first: 0x8ab1_2db0_e821_c3bc,
                lines: 13,
                all: 0xbad0_8eb6_42f4_479f,
            }),
            Part::Ours("M30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[
                Finding(
                    "error[five-axis-length-in-incremental] 13",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "error[five-axis-length-in-incremental] 14",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "info[five-axis-length-left-on] 16",
                    Verdict::True,
                    "the example stops before it ends the length",
                ),
            ],
            shows: &[],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 328",
        what: "pecks along a tilted head",
        text: &[
            Part::Ours("%\nO1\n"),
            Part::Theirs(Place {
                page: 328,
                first: 0x8500_8d13_e219_591b,
                lines: 12,
                all: 0xaf59_548b_81fb_1b6a,
            }),
            Part::Ours("M30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[
                Finding(
                    "error[five-axis-length-in-incremental] 12",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "error[five-axis-length-in-incremental] 13",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "info[five-axis-length-left-on] 15",
                    Verdict::True,
                    "the example stops before it ends the length",
                ),
            ],
            shows: &[],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 329",
        what: "a tap along a tilted head",
        text: &[
            Part::Ours("%\nO1\n"),
            Part::Theirs(Place {
                page: 329,
                first: 0xe44f_38cd_f752_b152,
                lines: 13,
                all: 0x0479_0551_6463_6716,
            }),
            Part::Ours("M30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[
                Finding(
                    "error[five-axis-length-in-incremental] 13",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "error[five-axis-length-in-incremental] 14",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "info[five-axis-length-left-on] 16",
                    Verdict::True,
                    "the example stops before it ends the length",
                ),
            ],
            shows: &[],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 330",
        what: "a bore along a tilted head",
        text: &[
            Part::Ours("%\nO1\n"),
            Part::Theirs(Place {
                page: 330,
                first: 0x2c2e_1a59_4d0e_cbcb,
                lines: 13,
                all: 0x7b73_f8a4_e290_81b8,
            }),
            Part::Ours("M30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[
                Finding(
                    "error[five-axis-length-in-incremental] 13",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "error[five-axis-length-in-incremental] 14",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "info[five-axis-length-left-on] 16",
                    Verdict::True,
                    "the example stops before it ends the length",
                ),
            ],
            shows: &[],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 331, 332",
        what: "a bore with a stop along a tilted head",
        text: &[
            Part::Ours("%\nO1\n"),
            Part::Theirs(Place {
                page: 331,
                first: 0x9db1_ba20_233a_d7a5,
                lines: 12,
                all: 0xb9ff_4d21_584e_1781,
            }),
            Part::Ours("M30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[
                Finding(
                    "error[five-axis-length-in-incremental] 12",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "error[five-axis-length-in-incremental] 13",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "info[five-axis-length-left-on] 15",
                    Verdict::True,
                    "the example stops before it ends the length",
                ),
            ],
            shows: &[],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 333",
        what: "a bore with a dwell along a tilted head",
        text: &[
            Part::Ours("%\nO1\n"),
            Part::Theirs(Place {
                page: 333,
                first: 0x3189_a687_0d74_1c4d,
                lines: 13,
                all: 0x7ad7_bcc1_c2eb_9cbd,
            }),
            Part::Ours("M30\n%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[
                Finding(
                    "error[five-axis-length-in-incremental] 13",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "error[five-axis-length-in-incremental] 14",
                    Verdict::False,
                    "the manual goes home by G28 in this way; G28 takes no part in the length",
                ),
                Finding(
                    "info[five-axis-length-left-on] 16",
                    Verdict::True,
                    "the example stops before it ends the length",
                ),
            ],
            shows: &[],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 336, 337",
        what: "tool centre point control",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 336,
                first: 0x26eb_6f07_92d7_4e96,
                lines: 26,
                all: 0x5767_ec26_8ecf_d4e8,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 340",
        what: "a dynamic work offset",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 340,
                first: 0x203d_7772_ce79_70bd,
                lines: 26,
                all: 0xe26c_c1aa_4969_a3a4,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[Finding(
                "warning[rotary-motion-under-dynamic-offset] 19",
                Verdict::True,
                "p. 342, note 5: the offset is cancelled before any rotary motion",
            )],
            shows: &[],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 356",
        what: "coolant through the spindle",
        text: &[
            Part::Ours("%\nO1\nG20\n"),
            Part::Theirs(Place {
                page: 356,
                first: 0x9e4f_3535_b47e_8bf6,
                lines: 10,
                all: 0x8f21_a4a9_3a5d_2be0,
            }),
            Part::Ours("%\n"),
        ],
        files: &[],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[Shows::Run(&["clockwise", "feed 0.0000 0.0000 -2.2500 44"])],
            not_yet: &[],
        },
    },
    Example {
        at: "p. 357",
        what: "a jump that an input decides",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 357,
                first: 0x29f6_762d_f4fb_7a87,
                lines: 25,
                all: 0xa667_5d84_a131_8b2e,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 358",
        what: "a local subprogram",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 358,
                first: 0x8c76_71d6_6e57_e97d,
                lines: 7,
                all: 0xc857_0826_b177_dca8,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 358",
        what: "a subprogram by its number",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 358,
                first: 0x4ed6_1ec4_d794_1cd6,
                lines: 4,
                all: 0x86b3_3bf8_0e53_c9f6,
            }),
        ],
        files: &[(
            "O00100.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 358,
                    first: 0x30c1_dcc8_2d4b_38f6,
                    lines: 4,
                    all: 0x8cda_66b0_75be_f674,
                }),
            ],
        )],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 358, 359",
        what: "a subprogram by its path",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 358,
                first: 0x2c13_fb71_21b7_2934,
                lines: 4,
                all: 0xe10b_5de4_c50a_b7dc,
            }),
        ],
        files: &[(
            "USB0/O00001.nc",
            &[
                Part::Ours("%\n"),
                Part::Theirs(Place {
                    page: 358,
                    first: 0x30c1_dcc8_2d4b_38f6,
                    lines: 4,
                    all: 0x8cda_66b0_75be_f674,
                }),
            ],
        )],
        config: &[],
        expected: Expected {
            findings: &[],
            shows: &[],
            not_yet: &[Shows::Run(&["stop", "stop", "stop", "stop"])],
        },
    },
    Example {
        at: "p. 360",
        what: "a question with two answers",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 360,
                first: 0x4c32_86ba_2894_0bd0,
                lines: 16,
                all: 0xcb89_ef47_6b49_668f,
            }),
        ],
        files: &[],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
    Example {
        at: "p. 360, 361",
        what: "a question with five answers",
        text: &[
            Part::Ours("%\n"),
            Part::Theirs(Place {
                page: 360,
                first: 0xc24a_8867_0590_157e,
                lines: 7,
                all: 0x36ed_b17a_b574_b0ed,
            }),
            Part::Ours("N10\n"),
            Part::Theirs(Place {
                page: 361,
                first: 0x7b51_ee64_c731_cf1b,
                lines: 1,
                all: 0xbe07_263e_79a2_d9e3,
            }),
            Part::Ours("N20\n"),
            Part::Theirs(Place {
                page: 361,
                first: 0x459f_e7ca_a68e_708f,
                lines: 1,
                all: 0xdd27_6259_0409_31ff,
            }),
            Part::Ours("N30\n"),
            Part::Theirs(Place {
                page: 361,
                first: 0x480e_f048_d631_5bd7,
                lines: 1,
                all: 0xa2be_28c3_f5df_1887,
            }),
            Part::Ours("N40\n"),
            Part::Theirs(Place {
                page: 361,
                first: 0xea1d_e725_269d_330c,
                lines: 1,
                all: 0x6e02_ca20_9d1d_b332,
            }),
            Part::Ours("N50\n"),
            Part::Theirs(Place {
                page: 361,
                first: 0x6c8e_ba61_4d29_6761,
                lines: 1,
                all: 0x9fee_1e56_1d5a_bad1,
            }),
            Part::Ours("N100\n"),
            Part::Theirs(Place {
                page: 361,
                first: 0x0b22_3a9c_2e26_c20f,
                lines: 1,
                all: 0x11eb_9c62_6bdb_ae7f,
            }),
            Part::Ours("%\n"),
        ],
        files: &[
            ("O00020.nc", &[Part::Ours("%\nO20\nM99\n%\n")]),
            ("O00022.nc", &[Part::Ours("%\nO22\nM99\n%\n")]),
        ],
        config: &[],
        expected: Expected { findings: &[], shows: &[], not_yet: &[] },
    },
];
