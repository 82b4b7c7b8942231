//! Random programs: loops, jumps, nested calls, block deletes, modal macros, and every kind of code that changes the state.
//!
//! Knows: how each style of control writes them. Must not know: what is compared.

use std::fmt::Write as _;

const PLAIN: &[&str] = &[
    "G90",
    "G91",
    "G17",
    "G18",
    "G19",
    "G54",
    "G55",
    "S500 M3",
    "S? M4",
    "M5",
    "F200.",
    "F?",
    "M7",
    "M8",
    "M9",
    "G20",
    "G21",
    "S#100",
    "F[#101+10.]",
    "G94",
    "G93",
    "G95",
    "T1",
    "T2",
    "G43 H1",
    "G43 H2 Z5.",
    "G49",
    "G92 X0.",
    "G92 Z?",
    "G92.1",
    "G4 P1",
    "T2 M6",
    "T3 M6",
    "G81 X1. Y1. Z-2. R1. F100.",
    "G81 X? Z? R?",
    "G83 X2. Z-3. R1. Q1. F100.",
    "G73 Z-3. R1. Q.5 F100.",
    "G82 Z-1. R2. P500 F100.",
    "G85 X1. Z-1. R1. F50.",
    "X3.",
    "X?",
    "G80",
    "G98",
    "G99",
    "G2 X2. Y0. R5. F100.",
    "G3 X0. Y2. I1. J1. F100.",
    "G2 X? R10.",
    "G28 Z0.",
    "G28",
    "G30 Z0.",
    "G53 G0 Z-1.",
    "G10 L2 P1 X5.",
    "G10 L2 P2 Y?",
    "G10 L2 P#100 X1.",
    "G40",
    "G41 D1",
    "G42 D2",
    "G1 X[#110+5.] F50.",
    "G61",
    "G64",
    "G0 X[#5001]",
    "M19",
    "M48",
    "M49",
    "M0",
    "M1",
    "G28.1",
    "G59",
];

/// What controls without O-words have.
const TRANSFORMED: &[&str] = &[
    "G52 X1.",
    "G52 X? Y2.",
    "G68 X0. Y0. R30.",
    "G68 R?",
    "G69",
    "G51 X0. Y0. Z0. P2.",
    "G51 P?",
    "G51 X? Y? P2.",
    "G50",
    "G51.1 X0.",
    "G51.1 X? Y0.",
    "G50.1 X0.",
    "G101 X0.",
    "G100 X0.",
    "G41 D#101",
    "G41 D3 X5. F100.",
    "G42 D? Y5.",
    "G40 X?",
    "G16",
    "G15",
    "G0 X10. Y30.",
    "G10 L10 P1 R10.",
    "G10 L11 P1 R.1",
    "G10 L12 P1 R4.",
    "G10 L12 P#100 R?",
    "G10 L13 P1 R.2",
    "G10 L20 P1 X1.",
    "G54.1 P1",
    "G54.1 P2",
    "G10 L20 P? Y1.",
    "G54.4",
    "G12 I5. D1 F100.",
    "G13 I? D1 F100.",
    "G70 I5. J0. L4",
    "G81 Z-2. R1. F50.",
    "G84 Z-3. R1. F500.",
    "G76 Z-3. R1. Q.1 F50.",
    "G09 X1.",
    "G29 X1.",
    "G30 P2 Z0.",
    "G61",
    "G61.1",
    "G64",
    "G05.1 Q1",
    "G05.1 Q0",
    "G8 P1",
    "G62",
    "G160",
    "G161",
    "#5221=?",
    "#2001=10.",
    "#2401=?",
    "G66 P7777 A1.",
    "M97 P9999",
];

const SPINDLE_AND_OFFSETS: &[&str] = &[
    "S1000 M3",
    "S? M3",
    "M4",
    "M5",
    "G96 S100",
    "G96 S?",
    "G97 S500",
    "G50 S3000",
    "G92 S2000",
    "M8",
    "M9",
    "M88",
    "M89",
    "F0.2",
    "F?",
    "G95",
    "G94",
    "G99",
    "G98",
    "T1 M6",
    "T? M6",
    "M6",
    "T#101",
    "G43 H#101",
    "G44 H1",
    "G43 H? Z1.",
    "H2",
    "D2",
    "D?",
    "G49",
    "M29 S500",
    "M133 P500",
    "M135",
    "M10",
    "M11",
    "G0 Z?",
    "G54",
    "G56",
    "G55 X?",
    "G59",
];

/// What a control with shifts by the tool has.
const FIVE_AXIS: &[&str] = &[
    "G143 H1 X1. Y2. Z3. A10. B5.",
    "G143 H#100",
    "G143",
    "G0 A20. B#101",
    "X1. Y1. Z1. A0. B0.",
    "H0",
    "H#102",
    "G49",
    "G43 H1 Z5.",
    "G1 G141 D1 X1. I0. J.6 K.8 F100.",
    "X2. Y#102 I1. J0. K0.",
    "D0",
    "D#103",
    "G40",
    "G10 L10 P1 R10.",
    "G10 L12 P1 R4.",
    "G55",
    "G54",
    "G52 X1.",
    "G53 G0 Z-1.",
    "G90",
    "G91",
    "G93",
    "G94 F200.",
    "G254",
    "G255",
    "G234 H1",
    "G161 Z-2. E5. F100.",
    "G268 X0. Y0. Z0. A10. B20.",
    "G269",
    "T2 M6",
    "G0 A?",
];

/// Drawings around a cylinder on A.
const WRAPPED: &[&str] = &[
    "G107 Y0. A0. Q50.",
    "G107",
    "G107 A0. R#100",
    "G107 Y0. A0.",
    "G0 A90.",
    "G107 X0. A0. Q#100",
    "G1 Y#101 F100.",
    "/G107 Y0. A0. Q20.",
    "G1 Y? A?",
];

const LOCAL: &[&str] = &[
    "G12 I5. D1 F100.",
    "G13 I5. K10. Q2. D1 F100. L2 Z-1.",
    "G150 P7000 X0. Y0. Z-5. Q2. R1. D1 F100.",
    "G47 P0 X1. Z-1. R1. J3. F50.",
    "G70 I5. J0. L4",
    "G71 I5. J0. K10. L3",
    "G72 I5. J0. L3",
    "G103 P1",
    "G103",
    "G187 P2 E.1",
    "G187",
    "G110",
    "G111 X1.",
    "G154 P2",
    "G154 P#100",
    "G136 X-1. F50.",
    "G35 D1 X1. F50.",
    "G36 X1. F50.",
    "M30.",
    "M96 P10 Q1",
    "#3006=1",
    "#3004=?",
    "M109 P501",
    "G65 P9999",
    "G31 Z-1. F10. M79",
    "G31 Z-1. F10. M78",
    "M78",
    "M79",
    "G74 Z-3. R1. F100.",
    "G112",
    "G113",
    "G2 X5. I2.5 Z-1. F50.",
    "G84 Z-2. R1. F500.",
    "M19 P90.",
    "M19 R?",
    "M81 P1",
    "G09",
    "T3",
    "G93 F2.",
    "G28 X? Y0.",
];

const TURNING: &[&str] = &[
    "G0 X50. Z5.",
    "G0 X? Z2.",
    "G1 X40. Z-10. F.2",
    "G90 X40. Z-20. F.2",
    "G90 X? Z-20. R-1.",
    "X38.",
    "X? Z?",
    "G92 X30. Z-20. F1.5",
    "G92 X? Z? F?",
    "G94 X20. Z-2. F.1",
    "G94 X20. Z?",
    "G71 U1. R.5",
    "G71 P100 Q200 U.4 W.1 F.2",
    "G72 W1. R.5",
    "G73 U5. W2. R3",
    "G74 R1.",
    "G74 X10. Z-20. P1000 Q2000 F.1",
    "G75 R.5",
    "G75 X10. Z-5. P1000 Q1000 F.1",
    "G76 P021060 Q100 R.05",
    "G76 X20. Z-20. P900 Q300 F1.5",
    "T0101",
    "T0202",
    "T0100",
    "T?",
    "G41",
    "G42",
    "G40",
    "G2 X30. Z-5. R5. F.1",
    "G3 X? Z-5. R5.",
    "U2. W-1.",
    "U?",
    "G50 S2000",
    "G50 X?",
    "G28 U0. W0.",
    "G83 Z-5. R1. Q1. F.1",
    "G84 Z-5. R2. F1.",
    "G85 X30. R2. F.1",
    "G80",
    "G54",
    "G55",
    "G10 P1 X? Z1.",
    "G32 Z-10. F1.5",
    "G33 Z-5. F1.",
    "G53 X0.",
    "G52 Z1.",
    "M3 S500",
    "M4",
    "M5",
    "C90.",
    "H10.",
    "G112",
    "G113",
    "G12.1",
    "G13.1",
    "G107 C20.",
    "G4 P1.",
    "G90",
    "G91",
];

const O_WORD_MODES: &[&str] = &[
    "G64 P0.1 Q0.05",
    "G64 P?",
    "G64",
    "G61.1",
    "G5 I0. J3. P0. Q-3. X1. Y1.",
    "G5 P1. Q1. X2. Y?",
    "G5.1 X2. Y0. I1. J1.",
    "G5.2 X1. Y1. P1 L3",
    "G5.2 X? Y2. P2",
    "X3. Y3. P1",
    "X4. Y1.",
    "G5.3",
    "G41 D1",
    "G41.1 D4",
    "G41.1 D?",
    "G42.1 D3 L0",
    "G40",
    "G43.1 Z5.",
    "G43.1 Z?",
    "G43.2 H2",
    "G43",
    "G49",
    "G10 L1 P1 R5. Z10.",
    "G10 L1 P2 R?",
    "G10 L1 P3 R1. I90. J30. Q2",
    "G10 L10 P1 Z1.",
    "G10 L11 P1 Z2.",
    "G10 L2 P1 R30.",
    "G10 L2 P0 X?",
    "G10 L20 P2 X1.",
    "M61 Q3",
    "M61 Q?",
    "G38.2 Z-5. F50.",
    "G38.3 X? F50.",
    "G38.4 Z5. F50.",
    "G38.5 Y? F20.",
    "M70",
    "M71",
    "M72",
    "M73",
    "M48",
    "M49",
    "M50 P0",
    "M50 P1",
    "M51 P0",
    "M52 P1",
    "M52 P0",
    "M53 P0",
    "M53 P1",
    "G96 D1000 S200",
    "G96 S?",
    "G97 S500",
    "G92.2",
    "G92.3",
    "G92 X? Y1.",
    "G7",
    "G8",
    "#<a>=?",
    "#<_g>=?",
    "#110=#<_g>",
    "#111=EXISTS[#<a>]",
    "M66 P0 L3 Q1",
    "#110=#5399",
    "M62 P1",
    "M67 E0 Q?",
    "G33 Z-1. K1.",
    "G33.1 Z-1. K1.",
    "G73 Z-3. R1. Q.5",
    "G76 P1. Z-5. I-1. J.2 K1. Q30.",
    "@5. ^30.",
    "@? ^?",
    "G17.1",
    "G90.1",
    "G91.1",
    "G30.1",
    "G28.1",
    "G30",
    "G54",
    "G59.3",
    "T1",
    "T? M6",
    "G80 G98",
    "G81 X1. Y1. Z-2. R1. L2",
    "M100 P1 Q?",
    "G84 Z-1. R2.",
    "G89 Z-1. R1. P.5",
    "G86 Z-1. R1. P1.",
];

const PROBING: &[&str] = &[
    "G31 X[#110] F50. M75",
    "G31 Y-1. F50.",
    "#111=#5061",
    "G31 X2. F50. M78",
    "G136 X-1. F50.",
    "G36 Y1. I2. F50.",
    "G37 H1 Z0. F50.",
    "M75",
    "G31 Z? F20.",
    "#110=#5063",
    "G35 D1 X1. F50.",
];

const SKIPPING: &[&str] =
    &["G31 X[#110] F50.", "G31 Y-1. F50.", "#111=#5061", "G31 Z? F20.", "#110=#5063", "#3=#5041", "G37 Z1."];

const TOUCHING: &[&str] = &[
    "G38.2 X? F50.",
    "G38.3 Z-2. F50.",
    "#111=#5061",
    "#110=#5070",
    "G38.4 Z5. F20.",
    "G38.5 Y1. F20.",
    "#110=#5063",
    "#3=#5001",
];

/// How a control writes loops and calls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// `GOTO`, `WHILE … DO`, `M98`, `G65`.
    Macro,
    /// As [`Style::Macro`], with `M97`.
    Local,
    /// As [`Style::Local`], with modes that shift the axes by the tool.
    FiveAxis,
    /// O-words.
    OWords,
    /// As [`Style::Macro`], on a lathe.
    Lathe,
}

/// Writes a program by choices. When the choices run out, each is 0, which is always the plainest.
pub(crate) struct Writer<'a> {
    choices: std::slice::Iter<'a, u8>,
    style: Style,
    text: String,
    /// Subprograms, written behind the main program.
    subprograms: Vec<String>,
    next_label: u32,
    next_program: u32,
    loop_depth: u32,
    depth: u32,
    statements: u32,
    /// Inside a subprogram: how deep.
    inside: u32,
}

/// Variables of a program: inputs, and common ones it sets.
const INPUTS: [u32; 6] = [100, 101, 102, 103, 104, 105];
const COMMON: [u32; 3] = [110, 111, 112];

impl<'a> Writer<'a> {
    pub(crate) fn new(choices: &'a [u8], style: Style) -> Self {
        Self {
            choices: choices.iter(),
            style,
            text: String::new(),
            subprograms: Vec::new(),
            next_label: 0,
            next_program: 0,
            loop_depth: 0,
            depth: 0,
            statements: 0,
            inside: 0,
        }
    }

    fn choose(&mut self, of: u32) -> u32 {
        self.choices.next().map_or(0, |byte| u32::from(*byte) % of)
    }

    fn line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }

    fn label(&mut self) -> u32 {
        self.next_label += 1;
        self.next_label * 10
    }

    pub(crate) fn program(mut self) -> String {
        if self.style != Style::OWords {
            self.line("O1");
        }
        self.line("G21 G90");
        self.block();
        self.line(if self.style == Style::OWords { "M2" } else { "M30" });
        let mut subprograms = std::mem::take(&mut self.subprograms);
        if self.style == Style::OWords {
            // A subroutine stands in front of what calls it.
            subprograms.push(self.text);
            subprograms.concat()
        } else {
            self.text + &subprograms.concat()
        }
    }

    fn block(&mut self) {
        self.depth += 1;
        let count = 1 + self.choose(4);
        for _ in 0..count {
            self.statement();
        }
        self.depth -= 1;
    }

    fn statement(&mut self) {
        self.statements += 1;
        let deep = self.depth > 3 || self.statements > 40;
        match self.choose(if deep { 9 } else { 18 }) {
            0 | 1 => self.movement(),
            2 | 3 => self.assignment(),
            4 | 5 => self.mode(),
            6 => self.skipped(),
            7 => self.unlikely(),
            8 => self.condition_of_one_block(),
            9..=11 => self.branch(),
            12 | 13 => self.counted_loop(),
            14 => self.loop_by_jump(),
            _ => self.call(),
        }
    }

    fn number(&mut self) -> String {
        ["1.", "0.", "2.5", "-3.", "10."][self.choose(5) as usize].to_owned()
    }

    fn variable(&mut self) -> u32 {
        let choice = self.choose(12) as usize;
        match choice {
            0..=2 => COMMON[choice],
            3..=8 => INPUTS[choice - 3],
            _ => choice as u32 - 8,
        }
    }

    fn value(&mut self) -> String {
        match self.choose(6) {
            0 | 1 => format!("[{}]", self.number()),
            2 => format!("[#{}+{}]", self.variable(), self.number()),
            3 => format!("[#{}*2.]", self.variable()),
            4 => format!("[#{}-#{}]", self.variable(), self.variable()),
            _ => format!("#{}", self.variable()),
        }
    }

    fn movement(&mut self) {
        let code = ["G0", "G1", ""][self.choose(3) as usize];
        let mut line = code.to_owned();
        for axis in ["X", "Y", "Z"] {
            if self.choose(2) == 1 || axis == "X" {
                let value = self.value();
                let _ = write!(line, " {axis}{value}");
            }
        }
        if self.choose(3) == 0 {
            line.push_str(" F100.");
        }
        self.line(line);
    }

    fn assignment(&mut self) {
        let target = match self.choose(6) as usize {
            choice @ 0..=2 => COMMON[choice],
            choice => choice as u32 - 2,
        };
        let value = self.value();
        self.line(format!("#{target}={value}"));
    }

    /// A code that changes the state. `?` in its line is any value.
    fn mode(&mut self) {
        let wraps = self.style == Style::Local && self.choose(8) == 7;
        let lines: &[&str] = match self.style {
            Style::FiveAxis => FIVE_AXIS,
            Style::Local if wraps => WRAPPED,
            Style::Lathe => [TURNING, SPINDLE_AND_OFFSETS][self.choose(2) as usize],
            Style::OWords => [PLAIN, O_WORD_MODES][self.choose(2) as usize],
            Style::Local => [PLAIN, TRANSFORMED, SPINDLE_AND_OFFSETS, LOCAL][self.choose(4) as usize],
            Style::Macro => [PLAIN, TRANSFORMED, SPINDLE_AND_OFFSETS][self.choose(3) as usize],
        };
        let line = lines[self.choose(lines.len() as u32) as usize];
        self.filled(line);
    }

    /// A line with a value in place of each `?`.
    fn filled(&mut self, line: &str) {
        let mut filled = String::new();
        for character in line.chars() {
            if character == '?' {
                let value = self.value();
                filled.push_str(&value);
            } else {
                filled.push(character);
            }
        }
        self.line(filled);
    }

    fn skipped(&mut self) {
        match self.choose(3) {
            0 => self.line("/G91"),
            1 => self.line("/#110=7."),
            _ => self.line("/G0 X4."),
        }
    }

    fn unlikely(&mut self) {
        match self.choose(8) {
            0 => self.line("(NOTE)"),
            1 => self.line("G0 Z5."),
            2 => self.line("#[109+#1]=3."),
            3 => self.line("#2=#[110]"),
            4 => self.line("#111=#5001"),
            5 | 6 => self.probing(),
            _ => self.line("#3=[1./#104]"),
        }
    }

    fn probing(&mut self) {
        let lines = match self.style {
            Style::Local | Style::FiveAxis => PROBING,
            Style::Macro | Style::Lathe => SKIPPING,
            Style::OWords => TOUCHING,
        };
        let line = lines[self.choose(lines.len() as u32) as usize];
        self.filled(line);
    }

    fn condition(&mut self) -> String {
        let variable = self.variable();
        let op = ["EQ", "GT", "LT", "NE", "GE", "LE"][self.choose(6) as usize];
        let mut condition = match self.choose(4) {
            0 => format!("#{variable} {op} {}", self.number()),
            1 => format!("#{variable} {op} #{}", self.variable()),
            2 if self.style != Style::OWords => format!("#{variable} {op} #0"),
            _ => format!("#{variable} {op} 1."),
        };
        if self.choose(8) == 7 {
            let _ = write!(condition, "] AND [#{} GT 0", self.variable());
            return format!("[[{condition}]]");
        }
        condition.insert(0, '[');
        condition.push(']');
        condition
    }

    fn condition_of_one_block(&mut self) {
        let condition = self.condition();
        if self.style == Style::OWords {
            let label = self.label();
            self.line(format!("o{label} if {condition}"));
            self.assignment();
            self.line(format!("o{label} endif"));
        } else {
            let value = self.value();
            let target = COMMON[self.choose(3) as usize];
            self.line(format!("IF {condition} THEN #{target}={value}"));
        }
    }

    fn branch(&mut self) {
        let condition = self.condition();
        let label = self.label();
        if self.style == Style::OWords {
            self.line(format!("o{label} if {condition}"));
            self.block();
            if self.choose(2) == 1 {
                self.line(format!("o{label} else"));
                self.block();
            }
            self.line(format!("o{label} endif"));
        } else if self.choose(2) == 0 {
            self.line(format!("IF {condition} GOTO {label}"));
            self.block();
            self.line(format!("N{label} (MEETS)"));
        } else {
            let end = self.label();
            self.line(format!("IF {condition} GOTO {label}"));
            self.block();
            self.line(format!("GOTO {end}"));
            self.line(format!("N{label}"));
            self.block();
            self.line(format!("N{end}"));
        }
    }

    /// A counter that no other statement uses.
    fn counter(&mut self) -> u32 {
        20 + self.loop_depth
    }

    fn bound(&mut self) -> String {
        match self.choose(4) {
            0 | 1 => "2".to_owned(),
            2 => "3".to_owned(),
            _ => format!("#{}", INPUTS[self.choose(3) as usize]),
        }
    }

    fn counted_loop(&mut self) {
        if self.loop_depth >= 2 {
            return self.movement();
        }
        self.loop_depth += 1;
        let (counter, bound) = (self.counter(), self.bound());
        let label = self.label();
        let repeats = self.style == Style::OWords && self.choose(3) == 2;
        match self.style {
            Style::OWords if repeats => {
                self.line(format!("o{label} repeat [{bound}]"));
                self.block();
                self.line(format!("o{label} endrepeat"));
            }
            Style::OWords => {
                self.line(format!("#{counter}=0"));
                self.line(format!("o{label} while [#{counter} LT {bound}]"));
                self.line(format!("#{counter}=[#{counter}+1]"));
                self.block();
                if self.choose(3) == 2 {
                    let (inner, condition) = (self.label(), self.condition());
                    self.line(format!("o{inner} if {condition}"));
                    let word = ["break", "continue"][self.choose(2) as usize];
                    self.line(format!("o{label} {word}"));
                    self.line(format!("o{inner} endif"));
                }
                self.line(format!("o{label} endwhile"));
            }
            Style::Macro | Style::Local | Style::FiveAxis | Style::Lathe => {
                let number = self.loop_depth;
                self.line(format!("#{counter}=0"));
                self.line(format!("WHILE [#{counter} LT {bound}] DO{number}"));
                self.line(format!("#{counter}=#{counter}+1"));
                self.block();
                let leaves = self.choose(3) == 2;
                if leaves {
                    let condition = self.condition();
                    self.line(format!("IF {condition} GOTO {label}"));
                }
                self.line(format!("END{number}"));
                if leaves {
                    self.line(format!("N{label}"));
                }
            }
        }
        self.loop_depth -= 1;
    }

    fn loop_by_jump(&mut self) {
        if self.style == Style::OWords || self.loop_depth >= 2 {
            return self.assignment();
        }
        self.loop_depth += 1;
        let (counter, bound, label) = (self.counter(), self.bound(), self.label());
        self.line(format!("#{counter}=0"));
        self.line(format!("N{label}"));
        self.block();
        self.line(format!("#{counter}=#{counter}+1"));
        self.line(format!("IF [#{counter} LT {bound}] GOTO {label}"));
        self.loop_depth -= 1;
    }

    fn call(&mut self) {
        if self.inside >= 2 || self.subprograms.len() >= 4 {
            return self.mode();
        }
        // Written apart from its caller, with labels of its own.
        self.next_program += 1;
        let number = 1000 + self.next_program;
        let caller = std::mem::take(&mut self.text);
        let (depth, loop_depth) = (self.depth, self.loop_depth);
        (self.inside, self.depth, self.loop_depth) = (self.inside + 1, 1, 0);
        let is_local = matches!(self.style, Style::Local | Style::FiveAxis) && self.choose(2) == 1;
        match self.style {
            Style::OWords => self.line(format!("o{number} sub")),
            _ if is_local => self.line(format!("N{number}")),
            _ => {}
        }
        self.block();
        if self.choose(3) == 2 {
            let condition = self.condition();
            if self.style == Style::OWords {
                let label = self.label();
                self.line(format!("o{label} if {condition}"));
                self.line(format!("o{number} return [#1]"));
                self.line(format!("o{label} endif"));
            } else {
                let label = self.label();
                self.line(format!("IF {condition} GOTO {label}"));
                self.line("M99");
                self.line(format!("N{label}"));
            }
        }
        self.line(if self.style == Style::OWords { format!("o{number} endsub") } else { "M99".to_owned() });
        (self.inside, self.depth, self.loop_depth) = (self.inside - 1, depth, loop_depth);
        let body = std::mem::replace(&mut self.text, caller);
        let calls = 1 + self.choose(2);
        for _ in 0..calls {
            let value = self.value();
            match self.style {
                Style::OWords => self.line(format!("o{number} call [{value}]")),
                _ if is_local => self.line(format!("M97 P{number}")),
                _ => match self.choose(5) {
                    0 => self.line(format!("M98 P{number}")),
                    1 => self.line(format!("M98 P{number} L2")),
                    2 => self.line(format!("G65 P{number} A{value} B1.")),
                    // On some ways only.
                    3 => {
                        let (condition, label) = (self.condition(), self.label());
                        self.line(format!("IF {condition} GOTO {label}"));
                        self.line(format!("G66 P{number} A{value}"));
                        self.movement();
                        self.line(format!("N{label}"));
                        self.movement();
                        self.line("G67");
                    }
                    _ => {
                        self.line(format!("G66 P{number} A{value} B2."));
                        self.movement();
                        self.line("G67");
                    }
                },
            }
        }
        // Local subprograms belong to the main program: they stand behind its end, before other programs.
        match (self.style, is_local) {
            (Style::OWords, _) => self.subprograms.push(body),
            (_, true) => self.subprograms.insert(0, body),
            (_, false) => self.subprograms.push(format!("O{number}\n{body}")),
        }
    }
}
