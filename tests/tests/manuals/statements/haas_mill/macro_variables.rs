//! Macro variables, one by one: pages 199 to 218.
//!
//! Knows: statements in our words, programs, expectations. Must not know: how they are checked. Left out: wiring of the user
//! inputs (page 209).

use super::mill::{
    assumes, gap, held, legal, mill, moves, moves_told, not_modelled, reports, rule, run, stops, variables,
};
use crate::proof::Proof;
use crate::statements::statement::{Chapter, prove};

const fn read_only(violates: &'static str, conforms: &'static str) -> Proof {
    rule("error[assignment-to-read-only-variable]", violates, conforms)
}

pub(crate) const CHAPTER: Chapter = Chapter {
    title: "Macros: table of variables",
    key: "VAR",
    file: "haas_mill/macro_variables.rs",
    statements: &[
        held(
            "p. 199",
            "There are local, global and system variables; constants may have decimals and a sign.",
            "expressions",
            &[moves(
                "O1\nG20 G54 G0 G90\n#1=.0001\n#2=5.3\n#3=-10\nX[#1*10000]\nX#2\nX#3\nM30\n",
                &["rapid X1.", "rapid X5.3", "rapid X-10."],
            )],
        ),
        held(
            "p. 200, 218",
            "#0 is not a number, and can only be read; a variable that is set to it is unset.",
            "variable 0",
            &[
                variables([0, 0], "null", "read"),
                read_only("O1\n#0=1\nM30\n", "O1\n#1=#0\nM30\n"),
                moves("O1\nG20 G54 G0 G90 X0. Y0.\n#1=2.\n#1=#0\nX1. Y#1\nM30\n", &["rapid X0. Y0.", "rapid X1. Y0."]),
            ],
        ),
        held(
            "p. 199, 200",
            "Programs keep numbers in #100 to #199, #500 to #699 and #800 to #999, which stay over power off; #200 to #499 do not exist.",
            "variables 100–999, rule variable-unlisted",
            &[
                variables([100, 149], "common variables", "read-write"),
                variables([500, 549], "common variables", "read-write"),
                variables([800, 999], "common variables", "read-write"),
                legal("O1\n#199=1\n#500=1\n#699=1\n#800=1\n#999=1\nM30\n"),
                rule("warning[variable-unlisted]", "O1\n#200=1\nM30\n", "O1\n#199=1\nM30\n"),
                rule("warning[variable-unlisted]", "O1\n#499=1\nM30\n", "O1\n#500=1\nM30\n"),
            ],
        ),
        held(
            "p. 200, 208",
            "#550 to #580 (#10550 to #10580) hold the probe's calibration where there is a probe, else they are free.",
            "variables 550–580, 10550–10580",
            &[
                variables([550, 580], "probe calibration", "read-write"),
                variables([10550, 10580], "probe calibration", "read-write"),
                variables([581, 699], "common variables", "read-write"),
                variables([10581, 10699], "common variables", "read-write"),
            ],
        ),
        not_modelled(
            "p. 208",
            "A program that writes #550 to #580 of a machine with a probe spoils its calibration.",
            "whether the machine has a probe is not told; without one the variables are free",
        ),
        held(
            "p. 200",
            "#700 to #749 are the control's own; #709 (#10709) is one of them.",
            "variables 700–749",
            &[
                variables([700, 708], "internal", "read"),
                variables([710, 749], "internal", "read"),
                read_only("O1\n#700=1\nM30\n", "O1\n#699=1\nM30\n"),
            ],
        ),
        held(
            "p. 200, 205, 208",
            "#11000 to #11255 are inputs: they can only be read, and nobody knows them beforehand.",
            "variables 11000–11255",
            &[
                variables([11000, 11255], "inputs", "read"),
                read_only("O1\n#11018=1\nM30\n", "O1\n#10000=#11018\nM30\n"),
                stops("O1\nIF [#11018 EQ 1] GOTO5\nG4 P1.\nN5 M30\n", "depends on `#11018`"),
                reports("O1\nIF [#11018 EQ 1] GOTO5\nG4 P1.\nN5 M30\n", &[]),
            ],
        ),
        held(
            "p. 200, 210",
            "#1064 to #1068 and #1264 to #1268 hold the highest loads of X, Y, Z, A, B and C, U, V, W, T; they may be cleared.",
            "variables 1064–1068, 1264–1268",
            &[
                variables([1064, 1068], "highest load", "read-write"),
                variables([1264, 1268], "highest load", "read-write"),
                legal("O1\n#1064=0\n#100=#1268\nM30\n"),
            ],
        ),
        held(
            "p. 200, 205",
            "#1080 to #1087 are raw, #1090 to #1098 and #13000 to #13063 filtered analog inputs, read only.",
            "variables 1080–1098, 13000–13063",
            &[
                variables([1080, 1087], "analog inputs", "read"),
                variables([1090, 1098], "analog inputs", "read"),
                variables([13000, 13063], "analog inputs", "read"),
                read_only("O1\n#13013=1\nM30\n", "O1\n#100=#13013\nM30\n"),
                read_only("O1\n#1098=1\nM30\n", "O1\n#100=#1098\nM30\n"),
            ],
        ),
        held(
            "p. 200, 201, 210",
            "#1601 on: flutes; #1801 on: vibration; #2001 on: length; #2201 on: its wear; #2401 on: size; #2601 on: its wear; 200 tools each.",
            "variables 1601–2800",
            &[
                variables([1601, 1800], "number of flutes", "read-write"),
                variables([1801, 2000], "vibration", "read-write"),
                variables([2001, 2200], "tool length offsets", "read-write"),
                variables([2201, 2400], "tool length wear", "read-write"),
                variables([2401, 2600], "tool diameter or radius offsets", "read-write"),
                variables([2601, 2800], "tool diameter or radius wear", "read-write"),
            ],
        ),
        held(
            "p. 200, 210",
            "Programs set the length of a tool by #2000 + H, and its size by #2400 + D, in the units in effect.",
            "system variables 2001, 2401",
            &[
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90 X0. Y0.\n#2001=3.\n#2005=4.\nG43 H1 Z1.\nG43 H5 Z1.\nM30\n")
                        .with(&["machine.units=\"inch\"", "offsets.G54={Z=-8}"]),
                    are: &["rapid", "rapid Z1. MZ-4.", "rapid Z1. MZ-3."],
                },
                Proof::Moves {
                    program: mill("O1\nG20 G54 G0 G90 X0. Y0. Z0.\n#2403=.5\n#2603=0\nG1 G41 D3 X1. F10.\nY1.\nG40 X-1.\nM30\n")
                        .with(&["machine.units=\"inch\"", "settings.40=\"diameter\"", "tools.3.diameter=1"]),
                    are: &["rapid", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
                },
            ],
        ),
        held(
            "p. 200, 210",
            "A program that sets a tool's size by #2401 needs nothing else for compensation.",
            "system variable 2401",
            &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0. Z0.\n#2403=.5\nG1 G41 D3 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                &["rapid", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
            )],
        ),
        held(
            "p. 200, 210",
            "A length acts along Z only: where it is unknown, X and Y are as known as before.",
            "effect `length-plus`",
            &[moves(
                "O1\nG20\n#2401=.5\nT1 M6\nG54 G0 G90 X0. Y0.\nG43 H1 Z1.\nG1 G41 D1 X1. F10.\nY1.\nG40 X-1.\nM30\n",
                &["rapid X0. Y0.", "rapid X0. Y0. Z1.", "feed X.75 Y0.", "feed X.75 Y1.", "feed X-1. Y1."],
            )],
        ),
        held(
            "p. 211",
            "#3000 = n stops the program with an alarm and the comment of the block.",
            "system variable 3000; rule alarm-reached",
            &[
                stops("O1\n#3000=15 (NO PART)\nM30\n", "NO PART"),
                rule("error[alarm-reached]", "O1\n#3000=15 (NO PART)\nM30\n", "O1\nIF [#11018 EQ 1] GOTO5\n#3000=15 (NO PART)\nN5 M30\n"),
                rule("hint[unreachable-block]", "O1\n#3000=15 (NO PART)\nG4 P1.\nM30\n", "O1\nIF [#500 EQ 1] GOTO5\n#3000=15 (NO PART)\nN5 M30\n"),
                variables([3000, 3000], "user alarm", "write"),
            ],
        ),
        gap(
            "p. 211",
            "The alarm's number is n + 1000, for n from 1 to 999.",
            "run and alarm-reached name alarm 1015 for #3000=15; a number outside 1 to 999 is reported as a warning",
            &[
                stops("O1\n#3000=15 (NO PART)\nM30\n", "1015"),
                super::mill::says("O1\n#3000=15 (NO PART)\nM30\n", "error[alarm-reached]", "1015"),
                rule("warning[number-out-of-range]", "O1\n#3000=1000\nM30\n", "O1\n#3000=999\nM30\n"),
            ],
        ),
        held(
            "p. 211, 229",
            "#3001 counts milliseconds and #3002 hours from the value that was assigned; a program may wait for them.",
            "system variables 3001, 3002: their values are never known",
            &[
                reports("O1\n#3001=0\nWH [#3001 LT 500] DO1\nEND1\nG4 P1.\nM30\n", &[]),
                reports("O1\n#3002=0\nWHILE [#3002 LT 1] DO1\nEND1\nG4 P1.\nM30\n", &[]),
                stops("O1\n#3001=0\nWH [#3001 LT 500] DO1\nEND1\nG4 P1.\nM30\n", "depends on an unknown value"),
            ],
        ),
        held(
            "p. 201, 211",
            "#3001 and #3002 are read and assigned.",
            "variables 3001, 3002",
            &[variables([3001, 3001], "milliseconds", "read-write"), variables([3002, 3002], "hours", "read-write")],
        ),
        held(
            "p. 211",
            "#3003 = 1 has single block passed over, 0 restores it.",
            "variable 3003",
            &[variables([3003, 3003], "single block suppressed", "read-write"), legal("O1\n#3003=1\nG4 P1.\n#3003=0\nM30\n")],
        ),
        held(
            "p. 211, 212",
            "#3004 has three bits: feed hold, feed override and exact stop are off while theirs is 1.",
            "variable 3004",
            &[variables([3004, 3004], "feed hold", "read-write"), legal("O1\n#3004=7\nG4 P1.\n#3004=0\nM30\n")],
        ),
        held(
            "p. 211",
            "Feed hold and single block stay off until the variable is 0 again.",
            "`zero-at-end` of `#3003` and `#3004`",
            &[rule(
                "info[switched-off-at-end]",
                "O1\n#3004=1\nG4 P1.\nM30\n",
                "O1\n#3004=1\nG4 P1.\n#3004=0\nM30\n",
            )],
        ),
        held(
            "p. 212",
            "#3006 = 1 stops as M0 does and shows the comment; the program goes on with the next block.",
            "system variable 3006",
            &[
                run("O1\n#3006=1 (TURN THE PART)\nG4 P1.\nM30\n", &["2 stop TURN THE PART", "3 dwell 1.000"]),
                variables([3006, 3006], "stop with message", "write"),
            ],
        ),
        gap(
            "p. 212, 137",
            "#3006 acts like M0.",
            "what M0 stops and refuses holds for #3006: a cut after it with the spindle stopped, compensation on. The rule is silent about both so far, as it is about M0",
            &[rule(
                "warning[spindle-stopped-while-cutting]",
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG1 X1. F10.\n#3006=1 (LOOK)\nX2.\nM30\n",
                "O1\nG20 G54 G0 G90 X0. Y0. Z1.\nS500 M3\nG1 X1. F10.\n#3006=1 (LOOK)\nM3\nX2.\nM30\n",
            )],
        ),
        held(
            "p. 201",
            "#3011 and #3012 are date and time.",
            "variables 3011, 3012",
            &[variables([3011, 3011], "date", "read"), variables([3012, 3012], "time of day", "read")],
        ),
        held(
            "p. 201",
            "#3020, #3023, #3025, #3026 and #3027 can only be read; #3021, #3022 and #3024 are timers that a program may set.",
            "variables 3020–3027",
            &[
                variables([3020, 3020], "power-on timer", "read"),
                variables([3021, 3021], "cycle start timer", "read-write"),
                variables([3022, 3022], "feed timer", "read-write"),
                variables([3023, 3023], "present part", "read"),
                variables([3024, 3024], "last complete part", "read-write"),
                variables([3025, 3025], "part before", "read"),
                variables([3026, 3026], "tool in the spindle", "read"),
                variables([3027, 3027], "spindle speed", "read"),
                read_only("O1\n#3023=0\nM30\n", "O1\n#3024=0\nM30\n"),
            ],
        ),
        held(
            "p. 201",
            "#3026 is the tool in the spindle.",
            "system variable 3026",
            &[moves("O1\nG20 G54 G0 G90\nT3 M6\nX#3026\nM30\n", &["rapid X3."])],
        ),
        gap(
            "p. 201",
            "#3027 is the speed of the spindle.",
            "#3027 reads S of the running spindle, 0 after M5; now it is unknown, which is safe",
            &[moves("O1\nG20 G54 G0 G90\nS3 M3\nX#3027\nM30\n", &["rapid X3."])],
        ),
        held(
            "p. 201",
            "#3028 is the pallet on the receiver, #3030, #3032 and #3033 the switches for single block, block delete and optional stop.",
            "variables 3028–3033",
            &[
                variables([3028, 3028], "pallet", "read-write"),
                variables([3030, 3030], "single block", "read-write"),
                variables([3032, 3032], "block delete", "read-write"),
                variables([3033, 3033], "optional stop", "read-write"),
            ],
        ),
        gap(
            "p. 201",
            "#3032 and #3033 are the positions of the switches.",
            "where paths are told apart by block delete, #3032 is 1 on the path with the switch on and 0 on the other, so that a condition on it does not make a third case",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90\n#100=1.\n/#100=2.\nIF [#3032 EQ 1] GOTO5\nX#100\nN5 M30\n"),
                are: &["rapid X2."],
            }],
        ),
        held("p. 201", "#3196 is the cell safe timer.", "variable 3196", &[variables([3196, 3196], "cell safe timer", "read-write")]),
        held(
            "p. 201, 202",
            "#3201 on: actual diameters; #3401 on: positions of the coolant spigot; 200 tools each; #3901 and #3902 count M30.",
            "variables 3201–3902",
            &[
                variables([3201, 3400], "actual diameter", "read-write"),
                variables([3401, 3600], "coolant spigot", "read-write"),
                variables([3901, 3902], "M30 counters", "read-write"),
            ],
        ),
        held(
            "p. 202, 212",
            "#4001 to #4021 hold the code in effect of groups 1 to 21.",
            "system variables 4001–4016",
            &[
                moves(
                    "O1\nG20 G54 G0 G90\nX#4001\nX#4002\nX#4003\nX#4005\nX#4006\nX#4007\nX#4008\nX#4009\nX#4010\nX#4012\nX#4016\nM30\n",
                    &[
                        "rapid X0.", "rapid X17.", "rapid X90.", "rapid X94.", "rapid X20.", "rapid X40.", "rapid X49.", "rapid X80.",
                        "rapid X98.", "rapid X54.", "rapid X69.",
                    ],
                ),
                moves("O1\nG20 G54 G0 G90 X0.\nG91\nX#4003\nM30\n", &["rapid X0.", "rapid X91."]),
                moves("O1\nG20 G55 G1 G90 F5.\nX#4012\nX#4001\nM30\n", &["feed X55.", "feed X1."]),
                variables([4001, 4021], "active code of each G group", "read"),
            ],
        ),
        held(
            "p. 202, 213",
            "#4101 to #4126 hold the last value of each address, by the number that the letter has in G65: #4109 is F, #4119 S, #4120 T.",
            "system variables 4101–4126",
            &[
                moves(
                    "O1\nG20 G54 G0 G90 X0. Y0. Z0.\nT5 S100\nG1 X1. F6.\nY#4109\nY#4119\nY#4120\nM30\n",
                    &["rapid", "feed X1.", "feed Y6.", "feed Y100.", "feed Y5."],
                ),
                moves("O1\nG20 G54 G0 G90 X0. Y0.\nG43 H3\nY#4111\nG41 D4\nG40\nY#4107\nM30\n", &["rapid", "rapid Y3.", "rapid Y4."]),
                variables([4101, 4113], "last value of each address", "read"),
            ],
        ),
        gap(
            "p. 202, 203",
            "#4124 is the last X: X1.3 sets it to 1.3; so are #4125 and #4126, and #4104 to #4106 for I, J, K.",
            "the words of axes and I, J, K, Q, R are kept too; now they are unknown, which is safe but stops runs of macros that M codes call",
            &[
                moves("O1\nG20 G54 G0 G90 X1.3 Y0.\nY#4124\nM30\n", &["rapid X1.3", "rapid Y1.3"]),
                moves("O1\nG20 G54 G0 G90 X0. Y0.\nG2 X2. I1. F5.\nG0 Y#4104\nM30\n", &["rapid", "arc X2.", "rapid Y1."]),
            ],
        ),
        held("p. 213", "#4107 is the last D, #4111 the last H, whatever block they stood in.", "`last-word` of the variables", &[moves(
                "O1\nG20 G54 G0 G90 X0. Y0.\nD9\nY#4107\nH7\nY#4111\nM30\n",
                &["rapid", "rapid Y9.", "rapid Y7."],
            )],
        ),
        gap(
            "p. 213",
            "#5001 to #5006 are the end of the last motion block in work coordinates; the text orders them X, Z, Y, A, B, C, the other ranges X, Y, Z.",
            "an assumption where #5002 or #5003 decides anything: the manual contradicts itself, X Y Z is taken",
            &[assumes("O1\nG20 G54 G0 G90 X1. Y2. Z3.\nX#5002\nM30\n", "#5002")],
        ),
        held(
            "p. 202, 213",
            "#5001 to #5006 are the end of the last motion block, in work coordinates.",
            "system variables 5001–5006",
            &[
                moves_told("O1\nG20 G54 G0 G90 X3. Y4. Z1.\nX[#5001+1.]\nY[#5002+1.]\nM30\n", &["rapid", "rapid X4.", "rapid Y5."]),
                read_only("O1\n#5001=1\nM30\n", "O1\n#100=#5001\nM30\n"),
            ],
        ),
        held(
            "p. 202, 213",
            "#5021 to #5026 are the present position in machine coordinates, with the length compensation in Z.",
            "system variables 5021–5026",
            &[
                moves_told("O1\nG20 G54 G0 G90 X3. Y4. Z1.\nX#5022\nX#5021\nM30\n", &["rapid MY-1.", "rapid X-1.", "rapid X-11."]),
                moves_told(
                    "O1\nG20 T1 M6\nG54 G0 G90 X0. Y0.\nG43 H1 Z1.\nX#5023\nM30\n",
                    &["rapid", "rapid Z1. MZ-4.", "rapid X-4."],
                ),
                read_only("O1\n#5021=1\nM30\n", "O1\n#100=#5021\nM30\n"),
            ],
        ),
        held(
            "p. 202, 213",
            "#5041 to #5046 are the present position in work coordinates, with the length compensation in Z.",
            "system variables 5041–5046",
            &[
                moves_told("O1\nG20 G54 G0 G90 X3. Y4. Z1.\nX[#5041+3.5]\nY[#5042+1.]\nM30\n", &["rapid", "rapid X6.5", "rapid Y5."]),
                moves_told("O1\nG20 T1 M6\nG54 G0 G90 X0. Y0.\nG43 H1 Z1.\nX#5043\nM30\n", &["rapid", "rapid Z1.", "rapid X1."]),
            ],
        ),
        gap(
            "p. 213",
            "#5021 to #5026 and #5041 to #5046 cannot be read while the machine moves.",
            "info where such a variable is read in the block after a move without G103 P1: what is read may not be the position",
            &[rule(
                "info[position-read-in-motion]",
                "O1\nG20 G54 G0 G90 X1.\n#100=#5021\nM30\n",
                "O1\nG103 P1\nG20 G54 G0 G90 X1.\n;\n;\n#100=#5021\nG103\nM30\n",
            )],
        ),
        held(
            "p. 202, 214",
            "#5061 to #5069 are where the last skip signal came, in work coordinates; nobody knows beforehand.",
            "system variables 5061–5066",
            &[
                moves("O1\nG20 G54 G0 G90 X0. Y0. Z1.\nG31 X5. F5.\nY#5061\nM30\n", &["rapid", "probe X5.", "rapid Y?"]),
                read_only("O1\n#5061=1\nM30\n", "O1\n#100=#5061\nM30\n"),
                variables([5061, 5069], "skip", "read"),
            ],
        ),
        held(
            "p. 202, 214",
            "#5081 to #5086 are the tool length compensation in effect, by axis.",
            "system variables 5081–5086",
            &[moves_told(
                "O1\nG20 T1 M6\nG54 G0 G90 X0. Y0.\nX[#5083+1.]\nG43 H1 Z1.\nX#5083\nM30\n",
                &["rapid", "rapid X1.", "rapid Z1.", "rapid X3."],
            )],
        ),
        held(
            "p. 214",
            "#5083 includes the wear of the length.",
            "`tool-length-wear` of the system variables",
            &[moves_told(
                "O1\nG20 T1 M6\nG54 G0 G90 X0. Y0.\n#2201=.1\nG43 H1 Z1.\nX#5083\nM30\n",
                &["rapid", "rapid Z1. MZ-3.9", "rapid X3.1"],
            )],
        ),
        held(
            "p. 202, 214",
            "#5221 on are G54, each further work offset 20 numbers on: G59 is #5321 to #5326; programs read and set them.",
            "system variables 5221–5326",
            &[
                Proof::Moves {
                    program: mill("O1\nG20 G0 G90\n#5221=-9.\n#5321=-8.\nG54 X1.\nG59 X1.\nX#5321\nM30\n").with(&["machine.units=\"inch\""]),
                    are: &["rapid X1. MX-8.", "rapid X1. MX-7.", "rapid X-8."],
                },
                variables([5221, 5226], "G54", "read-write"),
                variables([5321, 5326], "G59", "read-write"),
            ],
        ),
        held(
            "p. 202, 214",
            "#5201 to #5206 are the shift of G52.",
            "`local-shift` of the system variables",
            &[
                moves_told("O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG52 X1.\nX#5201\nM30\n", &["rapid", "rapid MX-8."]),
                moves_told("O1\nG20 G54 G0 G90 X0. Y0. Z0.\nG52 X1.\n#5201=2.\nX0.\nM30\n", &["rapid", "rapid MX-8."]),
            ],
        ),
        held(
            "p. 203, 214, 215",
            "#14001 on (and #7001 on) are G110 to G129, G154 P1 to P20; #14401 on are P21 and further, to #15966 for P99.",
            "system variables 7001–7386, 14001–15966",
            &[
                Proof::Moves {
                    program: mill(
                        "O1\nG20 G0 G90\n#14001=-3.\nG110 X1.\nX#7001\n#7021=-4.\nG154 P2 X1.\n#14401=-6.\nG154 P21 X1.\n#15961=-5.\nG154 P99 X1.\nM30\n",
                    )
                    .with(&["machine.units=\"inch\""]),
                    are: &["rapid MX-2.", "rapid X-3.", "rapid MX-3.", "rapid MX-5.", "rapid MX-4."],
                },
                variables([14001, 15966], "work offsets G154 P1 to P99", "read-write"),
            ],
        ),
        not_modelled(
            "p. 214",
            "Reading a work offset stops reading ahead until its block is executed.",
            "what is read is what the blocks before it set, as here",
        ),
        held(
            "p. 203",
            "#5401 on: feed timers; #5501 on: total timers; #5601 on: limits; #5701 on: counters; #5801 on: loads; #5901 on: load limits of tools.",
            "variables 5401–6000",
            &[
                variables([5401, 5500], "tool feed timers", "read-write"),
                variables([5501, 5600], "tool total timers", "read-write"),
                variables([5601, 5699], "tool life limits", "read-write"),
                variables([5701, 5800], "tool life counters", "read-write"),
                variables([5801, 5900], "highest load of each tool", "read-write"),
                variables([5901, 6000], "load limit of each tool", "read-write"),
            ],
        ),
        held(
            "p. 203",
            "#6001 to #6999 are reserved and not to be used, but for #6198.",
            "rule variable-reserved",
            &[
                rule("warning[variable-reserved]", "O1\n#6001=1\nM30\n", "O1\n#5999=1\nM30\n"),
                rule("warning[variable-reserved]", "O1\n#6999=1\nM30\n", "O1\n#7001=1.\nM30\n"),
                rule("warning[variable-reserved]", "O1\n#100=#6001\nM30\n", "O1\n#100=#6198\nM30\n"),
            ],
        ),
        held(
            "p. 203, 215",
            "#6198 can only be read and tells the control's generation.",
            "variable 6198",
            &[
                variables([6198, 6198], "1000000", "read"),
                read_only("O1\n#6198=1\nM30\n", "O1\n#100=#6198\nM30\n"),
            ],
        ),
        gap(
            "p. 216",
            "#6198 is 1000000 on this control.",
            "the value is known on the control of this manual, so that a run takes the branch for it; on a classic control it is not: told by configuration or assumed and said",
            &[moves(
                "O1\nG20 G54 G0 G90\nIF[#6198 EQ 1000000] GOTO5\nX1.\nGOTO6\nN5 X2.\nN6 M30\n",
                &["rapid X2."],
            )],
        ),
        held(
            "p. 204, 217",
            "#7501 on: priority; #7601 on: status; #7701 on: programs; #7801 on: usage of six pallets.",
            "variables 7501–7806",
            &[
                variables([7501, 7506], "pallet", "read-write"),
                variables([7601, 7606], "pallet", "read-write"),
                variables([7701, 7706], "pallet", "read-write"),
                variables([7801, 7806], "pallet", "read-write"),
            ],
        ),
        held(
            "p. 204, 216, 217",
            "#8500 takes a group of tools, #8501 to #8515 tell about it; #8550 takes a tool, #8551 to #8567 tell about it.",
            "variables 8500–8567",
            &[
                variables([8500, 8500], "tool group", "read-write"),
                variables([8501, 8515], "tool group", "read"),
                variables([8550, 8550], "tool", "read-write"),
                variables([8551, 8567], "tool", "read"),
            ],
        ),
        held(
            "p. 206",
            "#9000 to #9031 hold compensation for heat and are reserved.",
            "variables 9000–9031",
            &[variables([9000, 9031], "thermal", "read"), read_only("O1\n#9000=1\nM30\n", "O1\n#100=#9000\nM30\n")],
        ),
        held(
            "p. 206, 218",
            "#12000 to #12255 are outputs that a program reads and writes.",
            "variables 12000–12255",
            &[
                variables([12000, 12255], "outputs", "read-write"),
                legal("O1\n#10000=#12018\n#12018=1\nM30\n"),
            ],
        ),
        held(
            "p. 208, 218",
            "#20000 + n is setting n, read only; #30000 on are parameters.",
            "variables 20000–39999",
            &[
                variables([20001, 20999], "settings", "read"),
                variables([30000, 39999], "parameters", "read"),
                read_only("O1\n#30001=1\nM30\n", "O1\n#100=#30001\nM30\n"),
            ],
        ),
        held(
            "p. 218",
            "#20000 + n reads setting n.",
            "variables of settings",
            &[Proof::Moves {
                program: mill("O1\nG20 G54 G0 G90\nX#20034\nM30\n").with(&["machine.units=\"inch\"", "settings.34=4.0"]),
                are: &["rapid X4."],
            }],
        ),
        held(
            "p. 208",
            "#50001 on: type; #50201 on: material; #51801 on: approximate length; #52001 on: diameter; #52201 on: measuring height; #52401 on: tolerance; #52601 on: kind of probe of 200 tools.",
            "variables 50001–52800",
            &[
                variables([50001, 50200], "tool type", "read-write"),
                variables([50201, 50400], "tool material", "read-write"),
                variables([51801, 52000], "approximate length", "read-write"),
                variables([52001, 52200], "approximate diameter", "read-write"),
                variables([52201, 52400], "edge measure height", "read-write"),
                variables([52401, 52600], "tolerance", "read-write"),
                variables([52601, 52800], "probe type", "read-write"),
            ],
        ),
    ],
};

#[test]
fn holds() {
    prove(&CHAPTER);
}
