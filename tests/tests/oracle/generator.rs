//! Random programs that are mostly valid, and some with one mistake.
//!
//! Knows: what the dialect accepts, well enough to use all of it. Must not know: what any of it means for the machine
//! beyond what validity needs (the units, the plane, which axes are at a known place).

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::random::Random;

/// Appends words to a line.
macro_rules! add {
    ($line:expr, $($words:tt)+) => {{
        // Writing to a string cannot fail.
        let _ = write!($line, $($words)+);
    }};
}

/// In one of so many programs a word is taken out or changed.
const MISTAKE_EVERY: i64 = 8;

/// The program of a seed.
pub(crate) fn program(seed: u64) -> String {
    let mut writer = Writer::new(seed);
    writer.head();
    for _ in 0..writer.random.whole(3, 9) {
        writer.part();
    }
    writer.tail();
    let mut random = writer.random.clone();
    let mut lines = writer.numbered();
    if random.one_in(MISTAKE_EVERY) {
        make_mistake(&mut random, &mut lines);
    }
    lines.iter().flat_map(|line| [line.as_str(), "\n"]).collect()
}

/// Takes a word out of a line, doubles it, or puts another code there.
///
/// Lines with O-words stay: the reference finds their mistakes when it gets there, and never where it skips them; we find
/// them where the structure begins. Our own programs show them one by one.
fn make_mistake(random: &mut Random, lines: &mut [String]) {
    let ix = random.whole(0, i64::try_from(lines.len()).unwrap() - 1);
    let Some(line) = lines.get_mut(usize::try_from(ix).unwrap()) else { return };
    if line.starts_with(['o', 'O']) {
        return;
    }
    let words: Vec<&str> = line.split(' ').collect();
    let at = usize::try_from(random.whole(0, i64::try_from(words.len()).unwrap() - 1)).unwrap();
    let other = random
        .pick(&["", "G1", "G2", "G53", "G83", "G41", "M2", "X5", "R-1", "P0", "L2", "F0", "G91", "G18"]);
    let word = words.get(at).copied().unwrap_or_default();
    let double = format!("{word} {word}");
    let other = if random.one_in(4) { double.as_str() } else { other };
    let words: Vec<&str> =
        words.iter().enumerate().map(|(ix, word)| if ix == at { other } else { *word }).collect();
    *line = words.join(" ");
}

/// Writes a number as short as it goes.
fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// The plane of arcs and cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Plane {
    Xy,
    Xz,
    Yz,
}

impl Plane {
    const fn code(self) -> &'static str {
        match self {
            Self::Xy => "G17",
            Self::Xz => "G18",
            Self::Yz => "G19",
        }
    }

    /// First axis, second axis, the axis across, and the centre words of the first two.
    ///
    /// In XZ the first axis is Z, so that counter-clockwise stays what the control calls so.
    const fn axes(self) -> [&'static str; 5] {
        match self {
            Self::Xy => ["X", "Y", "Z", "I", "J"],
            Self::Xz => ["Z", "X", "Y", "K", "I"],
            Self::Yz => ["Y", "Z", "X", "J", "K"],
        }
    }
}

/// What the writer knows of the program up to here.
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "modes of the program, each on or off")]
struct Writer {
    random: Random,
    lines: Vec<String>,
    /// Subroutines, written before everything else.
    subs: Vec<Vec<String>>,
    /// Programs for M98, written after everything else.
    behind: Vec<Vec<String>>,
    plane: Plane,
    inch: bool,
    incremental: bool,
    diameter: bool,
    /// The next free O number.
    next_o: i64,
    /// Depth of loops and branches.
    depth: usize,
    /// Whether percent signs are around the program.
    percent: bool,
    /// Whether it has a DO, and whether it breaks out of a WHILE: after such a break the reference runs a DO once only.
    has_do: bool,
    has_break: bool,
}

impl Writer {
    fn new(seed: u64) -> Self {
        Self {
            random: Random::new(seed),
            lines: Vec::new(),
            subs: Vec::new(),
            behind: Vec::new(),
            plane: Plane::Xy,
            inch: false,
            incremental: false,
            diameter: false,
            next_o: 100,
            depth: 0,
            percent: false,
            has_do: false,
            has_break: false,
        }
    }

    fn line(&mut self, text: impl Into<String>) {
        self.lines.push(text.into());
    }

    fn o_number(&mut self) -> i64 {
        self.next_o += 1;
        self.next_o
    }

    /// All lines, with block numbers where they may be.
    fn numbered(self) -> Vec<String> {
        let mut program: Vec<String> = self.subs.into_iter().flatten().collect();
        program.extend(self.lines);
        program.extend(self.behind.into_iter().flatten());
        let mut number = 0;
        let mut lines: Vec<String> = program
            .into_iter()
            .map(|line| {
                if line.starts_with(['o', 'O', '(']) {
                    return line;
                }
                number += 10;
                format!("N{number} {line}")
            })
            .collect();
        if self.percent {
            lines.insert(0, "%".to_owned());
            lines.push("%".to_owned());
        }
        lines
    }

    /// A length of the size of a part, in the units in force.
    fn length(&mut self) -> f64 {
        let length = self.random.number(-40, 40);
        if self.inch { (length * 100.0).round() / 2500.0 } else { length }
    }

    /// A length above zero.
    fn positive(&mut self, most: i64) -> f64 {
        let length = self.random.number(1, most);
        if self.inch { (length * 400.0).round() / 10_000.0 } else { length }
    }

    /// A number, sometimes as an expression of the same value.
    fn value(&mut self, value: f64) -> String {
        if !self.random.one_in(5) {
            return number(value);
        }
        let part = self.random.number(-9, 9);
        let rest = value - part;
        match self.random.whole(0, 5) {
            0 => format!("[{}+{}]", number(part), number(rest)),
            1 => format!("[{}-{}]", number(value + part), number(part)),
            2 => format!("[{}*2/2]", number(value)),
            3 => format!("[[{}]]", number(value)),
            4 => format!("[{} + [{}*1]]", number(rest), number(part)),
            _ => {
                let parameter = self.random.whole(31, 60);
                let lines = self.lines.len();
                // Not inside a block that is already begun: the value is there from the next block on.
                self.lines.insert(lines, format!("#{parameter}={}", number(value)));
                format!("#{parameter}")
            }
        }
    }

    fn feed(&mut self) -> String {
        let feed = if self.inch { self.random.whole(2, 40) } else { self.random.whole(50, 900) };
        format!("F{feed}")
    }

    fn head(&mut self) {
        self.percent = self.random.one_in(12);
        match self.random.whole(0, 3) {
            0 => self.line("G21 G17 G40 G49 G80 G90 G94"),
            1 => {
                self.inch = true;
                self.line("G20 G90");
            }
            _ => {}
        }
        if self.random.one_in(2) {
            let tool = self.random.whole(1, 4);
            self.line(format!("T{tool} M6"));
        }
        let (speed, code) = (self.random.whole(100, 6000), self.random.pick(&["M3", "M3", "M4"]));
        let feed = self.feed();
        self.line(format!("{feed} S{speed} {code}"));
    }

    fn tail(&mut self) {
        if self.random.one_in(2) {
            self.line("M5 M9");
        }
        let end = if self.percent && self.random.one_in(2) { "G0" } else { self.random.pick(&["M2", "M30"]) };
        self.line(end);
        if end == "G0" {
            // Programs after a percent sign would not be read, those before it would be run.
            self.lines.pop();
            self.line("M5");
            if !self.behind.is_empty() {
                self.line("M2");
            }
        }
    }

    /// One part of a program: a few blocks that belong together.
    fn part(&mut self) {
        match self.random.whole(0, 29) {
            0..=3 => self.moves(),
            4 | 5 => self.centre_arcs(),
            6 => self.radius_arcs(),
            7..=9 => self.cycle(),
            10 | 11 => self.work_offsets(),
            12 => self.shift(),
            13 => self.reference_points(),
            14 => self.tools(),
            15 => self.units(),
            16 => self.modes(),
            17 => self.machine_functions(),
            18 => self.values(),
            19..=21 => self.control_flow(),
            22 | 23 => self.compensation(),
            24 => self.feed_modes(),
            25 => self.polar(),
            26 => self.probing(),
            27 => self.threads(),
            28 => self.splines(),
            _ => self.saved_state(),
        }
    }

    fn axis_words(&mut self, axes: &[&str]) -> String {
        let mut words = String::new();
        for axis in axes {
            if self.random.one_in(2) {
                let length = self.length();
                add!(words, " {axis}{}", self.value(length));
            }
        }
        if words.is_empty() {
            let (first, length) = (axes.first().copied().unwrap_or("X"), self.length());
            words = format!(" {first}{}", self.value(length));
        }
        words
    }

    fn moves(&mut self) {
        let code = self.random.pick(&["G0", "G1"]);
        for ix in 0..self.random.whole(1, 5) {
            let axes: &[&str] =
                if self.random.one_in(6) { &["X", "Y", "Z", "A", "B", "C"] } else { &["X", "Y", "Z"] };
            let words = self.axis_words(axes);
            let code = if ix == 0 || self.random.one_in(3) { format!("{code} ") } else { String::new() };
            let feed = if self.random.one_in(5) { format!(" {}", self.feed()) } else { String::new() };
            self.line(format!("{code}{}{feed}", words.trim_start()));
        }
    }

    fn set_incremental(&mut self, incremental: bool) {
        if self.incremental != incremental {
            self.incremental = incremental;
            self.line(if incremental { "G91" } else { "G90" });
        }
    }

    fn set_plane(&mut self, plane: Plane) {
        if self.plane != plane {
            self.plane = plane;
            self.line(plane.code());
        }
    }

    fn set_diameter(&mut self, diameter: bool) {
        if self.diameter != diameter {
            self.diameter = diameter;
            self.line(if diameter { "G7" } else { "G8" });
        }
    }

    fn any_plane(&mut self) -> Plane {
        self.random.pick(&[Plane::Xy, Plane::Xy, Plane::Xz, Plane::Yz])
    }

    /// Goes to a known place of the plane.
    fn known_place(&mut self) -> (f64, f64) {
        self.set_incremental(false);
        let (first, second) = (self.length(), self.length());
        let [a, b, ..] = self.plane.axes();
        self.line(format!("G0 {a}{} {b}{}", number(first), number(second)));
        (first, second)
    }

    fn centre_arcs(&mut self) {
        self.set_diameter(false);
        let plane = self.any_plane();
        self.set_plane(plane);
        let absolute_centre = self.random.one_in(4);
        let incremental = self.random.one_in(3);
        let (mut first, mut second) = self.known_place();
        self.set_incremental(incremental);
        if absolute_centre {
            // Absolute centres need to know the place, which is known here.
            self.line("G90.1");
        }
        let [a, b, across, i, j] = plane.axes();
        for _ in 0..self.random.whole(1, 4) {
            let clockwise = self.random.one_in(2);
            let (radius, angle) = (self.positive(30), f64::from(self.random.whole(0, 71) as i32) * 5.0);
            let (sin, cos) = angle.to_radians().sin_cos();
            let round = |x: f64| (x * 10_000.0).round() / 10_000.0;
            let (ci, cj) = (round(-radius * cos), round(-radius * sin));
            let turn = f64::from(self.random.whole(1, 35) as i32) * 10.0;
            let turn = if clockwise { -turn } else { turn };
            let end = (angle + turn).to_radians() % TAU;
            let (mut da, mut db) = (round(ci + radius * end.cos()), round(cj + radius * end.sin()));
            let full = self.random.one_in(6);
            if full {
                (da, db) = (0.0, 0.0);
            }
            let code = if clockwise { "G2" } else { "G3" };
            let mut line = code.to_owned();
            let (ea, eb) = if incremental { (da, db) } else { (first + da, second + db) };
            if !full || self.random.one_in(2) {
                add!(line, " {a}{} {b}{}", number(ea), number(eb));
            }
            if self.random.one_in(4) {
                let depth = self.length();
                add!(line, " {across}{}", number(depth));
            }
            let (wi, wj) = if absolute_centre { (first + ci, second + cj) } else { (ci, cj) };
            add!(line, " {i}{} {j}{}", number(wi), number(wj));
            if self.random.one_in(5) {
                add!(line, " P{}", self.random.whole(1, 4));
            }
            self.line(line);
            first += da;
            second += db;
        }
        if absolute_centre {
            self.line("G91.1");
        }
    }

    fn radius_arcs(&mut self) {
        self.set_diameter(false);
        let plane = self.any_plane();
        self.set_plane(plane);
        let (mut first, mut second) = self.known_place();
        let [a, b, across, ..] = plane.axes();
        for _ in 0..self.random.whole(1, 4) {
            let chord = (self.length(), self.length());
            let chord = if chord.0.abs() + chord.1.abs() < 0.01 { (1.0, 1.0) } else { chord };
            let least = chord.0.hypot(chord.1) / 2.0;
            let radius = (least * self.random.pick(&[1.0, 1.01, 1.2, 2.0, 5.0]) * 1e4).ceil() / 1e4;
            let sign = self.random.pick(&["", "", "-"]);
            let code = self.random.pick(&["G2", "G3"]);
            first += chord.0;
            second += chord.1;
            let mut line =
                format!("{code} {a}{} {b}{} R{sign}{}", number(first), number(second), number(radius));
            if self.random.one_in(5) {
                let depth = self.length();
                add!(line, " {across}{}", number(depth));
            }
            self.line(line);
        }
    }

    fn cycle(&mut self) {
        self.set_diameter(false);
        let plane = self.any_plane();
        self.set_plane(plane);
        self.set_incremental(false);
        let [a, b, across, ..] = plane.axes();
        let clear = self.positive(20) + 5.0;
        self.line(format!("G0 {across}{}", number(clear)));
        if self.random.one_in(3) {
            let code = self.random.pick(&["G98", "G99"]);
            self.line(code);
        }
        let code =
            self.random.pick(&["G81", "G81", "G82", "G83", "G83", "G73", "G85", "G86", "G89", "G84", "G74"]);
        match code {
            "G84" | "G86" => self.line("M3 S400"),
            "G74" => self.line("M4 S400"),
            _ => {}
        }
        let incremental = self.random.one_in(4);
        self.set_incremental(incremental);
        let (top, depth) = (self.positive(4), self.positive(12));
        let words = if incremental {
            // From the clear height down to R, from R down to the bottom.
            format!("R{} {across}{}", number(top - clear), number(-depth))
        } else {
            format!("R{} {across}{}", number(top), number(top - depth))
        };
        let mut line = format!("{code} {words}");
        for axis in [a, b] {
            if self.random.one_in(2) {
                let length = self.length();
                add!(line, " {axis}{}", self.value(length));
            }
        }
        match code {
            "G83" | "G73" => {
                let peck = self.positive(5);
                add!(line, " Q{}", number(peck));
            }
            "G82" | "G86" | "G89" => add!(line, " P{}", self.random.pick(&["0", "0.5", "2"])),
            _ => {}
        }
        // G74 takes no repeats; now and then it is to be refused.
        let repeats = code != "G74" || self.random.one_in(8);
        if repeats && self.random.one_in(4) {
            add!(line, " L{}", self.random.whole(1, 4));
        }
        self.line(line);
        for _ in 0..self.random.whole(0, 4) {
            let mut words = self.axis_words(&[a, b]);
            if repeats && self.random.one_in(5) {
                add!(words, " L{}", self.random.whole(1, 3));
            }
            if self.random.one_in(6) {
                words.push_str(if self.random.one_in(2) { " G98" } else { " G99" });
            }
            self.line(words.trim_start());
        }
        self.line("G80");
        self.set_incremental(false);
        if matches!(code, "G84" | "G74") && plane != Plane::Xy {
            // The reference feeds to a wrong place there and finds out at the next tool change; we do not find out.
            self.known_place();
        }
    }

    fn work_offsets(&mut self) {
        let systems = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"];
        for _ in 0..self.random.whole(1, 4) {
            match self.random.whole(0, 4) {
                0 | 1 => {
                    let system = self.random.whole(0, 9);
                    let mut words = self.axis_words(&["X", "Y", "Z", "A"]);
                    if self.random.one_in(4) {
                        add!(words, " R{}", number(self.random.number(-180, 180)));
                    }
                    self.line(format!("G10 L2 P{system}{words}"));
                }
                2 => {
                    let system = self.random.whole(0, 9);
                    let words = self.axis_words(&["X", "Y", "Z"]);
                    self.line(format!("G10 L20 P{system}{words}"));
                }
                _ => {
                    let system = self.random.pick(&systems);
                    self.line(system);
                }
            }
            if self.random.one_in(2) {
                self.moves();
            }
        }
    }

    fn shift(&mut self) {
        for _ in 0..self.random.whole(1, 4) {
            match self.random.whole(0, 5) {
                0 | 1 => {
                    let words = self.axis_words(&["X", "Y", "Z"]);
                    self.line(format!("G92{words}"));
                }
                2 => {
                    let words = self.axis_words(&["X", "Y"]);
                    self.line(format!("G52{words}"));
                }
                _ => {
                    let code = self.random.pick(&["G92.1", "G92.2", "G92.3", "G52 X0 Y0 Z0"]);
                    self.line(code);
                }
            }
            self.moves();
        }
        if self.random.one_in(2) {
            self.line("G92.1");
        }
    }

    fn reference_points(&mut self) {
        for _ in 0..self.random.whole(1, 4) {
            match self.random.whole(0, 5) {
                0 => {
                    let code = self.random.pick(&["G28.1", "G30.1"]);
                    self.line(code);
                }
                1 => {
                    let code = self.random.pick(&["G28", "G30"]);
                    self.line(code);
                }
                2 | 3 => {
                    let code = self.random.pick(&["G28", "G30"]);
                    let words = self.axis_words(&["X", "Y", "Z"]);
                    self.line(format!("{code}{words}"));
                }
                _ => {
                    self.set_incremental(false);
                    let code = self.random.pick(&["G0", "G1"]);
                    let words = self.axis_words(&["X", "Y", "Z"]);
                    self.line(format!("G53 {code}{words}"));
                }
            }
            self.moves();
        }
    }

    fn tools(&mut self) {
        for _ in 0..self.random.whole(1, 4) {
            let tool = self.random.pick(&[1, 2, 3, 4, 99]);
            let kind = self.random.whole(0, 8);
            match kind {
                0 => self.line(format!("T{tool}")),
                1 | 2 => self.line(format!("T{tool} M6")),
                3 => self.line("G43"),
                4 => self.line(format!("G43 H{tool}")),
                5 => self.line("G49"),
                6 => {
                    let words = self.axis_words(&["Z", "X"]);
                    self.line(format!("G43.1{words}"));
                }
                7 => {
                    let (length, radius) = (self.positive(60), self.positive(5));
                    self.line(format!("G10 L1 P{tool} Z{} R{}", number(length), number(radius)));
                }
                _ => {
                    let length = self.positive(60);
                    let kind = self.random.pick(&["L10", "L11"]);
                    self.line(format!("G10 {kind} P{tool} Z{}", number(length)));
                }
            }
            // The reference alone, without a machine, forgets at a tool change what a length did to its position.
            let changes_length = (3..=6).contains(&kind);
            if changes_length || self.random.one_in(2) {
                self.moves();
            }
        }
        self.line("M3 S300");
    }

    fn units(&mut self) {
        self.inch = self.random.one_in(2);
        // The reference does not convert a tool length that is in effect.
        self.line("G49");
        self.line(if self.inch { "G20" } else { "G21" });
        let feed = self.feed();
        self.line(feed);
        self.moves();
    }

    fn modes(&mut self) {
        match self.random.whole(0, 5) {
            0 => {
                let plane = self.any_plane();
                self.set_plane(plane);
            }
            1 | 2 => {
                let incremental = !self.incremental;
                self.set_incremental(incremental);
            }
            3 => {
                let diameter = !self.diameter;
                self.set_plane(Plane::Xz);
                self.set_diameter(diameter);
            }
            _ => {
                let code = self.random.pick(&["G61", "G61.1", "G64", "G64 P0.1", "G64 P0.2 Q0.05"]);
                self.line(code);
            }
        }
        self.moves();
    }

    fn machine_functions(&mut self) {
        let codes = [
            "M7",
            "M8",
            "M9",
            "M0",
            "M1",
            "M60",
            "M48",
            "M49",
            "M50 P0",
            "M51 P1",
            "M52 P1",
            "M53 P0",
            "G4 P0.5",
            "M3 S900",
            "M4",
            "M5",
            "S1500",
            "M19 R45",
            "M62 P1",
            "M63 P1",
            "M64 P2",
            "M65 P2",
            "M66 P1 L0",
            "M67 E1 Q2.5",
            "M68 E0 Q-1",
            "G96 D2000 S100",
            "G97 S700",
            "M8 M3 S50",
        ];
        for _ in 0..self.random.whole(1, 5) {
            let code = self.random.pick(&codes);
            self.line(code);
        }
        self.line("G97 S800 M3");
    }

    fn expression(&mut self, depth: usize) -> String {
        if depth == 0 || self.random.one_in(4) {
            return match self.random.whole(0, 2) {
                0 => format!("#{}", self.random.whole(31, 60)),
                1 => format!("#<v{}>", self.random.whole(1, 3)),
                _ => number(self.random.number(-20, 20)),
            };
        }
        let depth = depth - 1;
        match self.random.whole(0, 9) {
            0..=4 => {
                let operator = self.random.pick(&[
                    "+", "-", "*", " mod ", " gt ", " lt ", " ge ", " le ", " eq ", " ne ", " and ", " or ",
                    " xor ",
                ]);
                let (left, right) = (self.expression(depth), self.expression(depth));
                // A zero after MOD is a mistake.
                let right = if operator == " mod " { number(self.random.number(1, 9)) } else { right };
                format!("{left}{operator}{right}")
            }
            5 => format!("[{}]", self.expression(depth)),
            6 | 7 => {
                let function = self.random.pick(&["abs", "sin", "cos", "fix", "fup", "round"]);
                format!("{function}[{}]", self.expression(depth))
            }
            8 => format!("sqrt[abs[{}]]", self.expression(depth)),
            _ => format!("atan[{}]/[{}]", self.expression(depth), self.expression(depth)),
        }
    }

    fn values(&mut self) {
        for ix in 1..=3 {
            let value = self.random.number(-9, 9);
            self.line(format!("#<v{ix}>={}", number(value)));
        }
        for _ in 0..self.random.whole(1, 5) {
            let expression = self.expression(3);
            match self.random.whole(0, 3) {
                0 => {
                    let parameter = self.random.whole(31, 60);
                    self.line(format!("#{parameter}=[{expression}]"));
                }
                1 => self.line(format!("#<v1>=[{expression}]")),
                _ => {
                    // Kept to a size that prints the same with four decimals on both sides.
                    let axis = self.random.pick(&["X", "Y", "Z"]);
                    self.line(format!("G0 {axis}[[{expression}] mod 100]"));
                }
            }
        }
        if self.random.one_in(2) {
            let parameter = self
                .random
                .pick(&["5220", "5221", "5420", "5421", "5400", "5410", "<_x>", "<_z>", "<_feed>"]);
            self.line(format!("G0 X#{parameter}"));
        }
    }

    fn control_flow(&mut self) {
        if self.depth >= 2 {
            return self.moves();
        }
        self.depth += 1;
        match self.random.whole(0, 6) {
            0 | 1 => self.branch(),
            2 => self.while_loop(),
            3 => self.do_loop(),
            4 => {
                let o = self.o_number();
                let count = self.random.whole(0, 4);
                self.line(format!("o{o} repeat [{count}]"));
                self.body();
                self.line(format!("o{o} endrepeat"));
            }
            5 => self.subroutine(),
            _ => self.called_program(),
        }
        self.depth -= 1;
    }

    /// Blocks that may be run any number of times.
    fn body(&mut self) {
        for _ in 0..self.random.whole(1, 2) {
            match self.random.whole(0, 5) {
                0 => self.cycle(),
                1 => self.control_flow(),
                2 => self.radius_arcs(),
                _ => self.moves(),
            }
        }
    }

    fn branch(&mut self) {
        let o = self.o_number();
        let modes = (self.plane, self.incremental, self.diameter);
        let (parameter, limit) = (self.random.whole(31, 60), self.random.whole(-3, 3));
        let operator = self.random.pick(&["gt", "lt", "eq", "ne", "ge", "le"]);
        self.line(format!("o{o} if [#{parameter} {operator} {limit}]"));
        self.body();
        self.back_to(modes);
        if self.random.one_in(3) {
            self.line(format!("o{o} elseif [#{parameter} gt {}]", limit - 1));
            self.body();
            self.back_to(modes);
        }
        if self.random.one_in(2) {
            self.line(format!("o{o} else"));
            self.body();
            self.back_to(modes);
        }
        self.line(format!("o{o} endif"));
    }

    /// Puts the modes back that a part of the program may have changed, whether it is run or not.
    fn back_to(&mut self, (plane, incremental, diameter): (Plane, bool, bool)) {
        self.set_plane(plane);
        self.set_incremental(incremental);
        self.set_diameter(diameter);
    }

    fn while_loop(&mut self) {
        let o = self.o_number();
        let modes = (self.plane, self.incremental, self.diameter);
        let counter = 60 + o;
        self.line(format!("#{counter}=0"));
        let count = self.random.whole(0, 4);
        self.line(format!("o{o} while [#{counter} lt {count}]"));
        self.line(format!("#{counter}=[#{counter}+1]"));
        if self.random.one_in(3) {
            let (inner, word) = (self.o_number(), self.random.pick(&["break", "continue"]));
            let word = if self.has_do { "continue" } else { word };
            self.has_break |= word == "break";
            self.line(format!("o{inner} if [#{counter} eq 2]"));
            self.line(format!("o{o} {word}"));
            self.line(format!("o{inner} endif"));
        }
        self.body();
        self.back_to(modes);
        self.line(format!("o{o} endwhile"));
    }

    fn do_loop(&mut self) {
        if self.has_break {
            return self.while_loop();
        }
        self.has_do = true;
        let o = self.o_number();
        let counter = 60 + o;
        self.line(format!("#{counter}=0"));
        self.line(format!("o{o} do"));
        self.line(format!("#{counter}=[#{counter}+1]"));
        self.body();
        let count = self.random.whole(0, 3);
        self.line(format!("o{o} while [#{counter} lt {count}]"));
    }

    /// A part written to a place of its own, in known modes at its start and its end.
    fn apart(&mut self) -> Vec<String> {
        let lines = std::mem::take(&mut self.lines);
        self.body();
        self.back_to((Plane::Xy, false, false));
        std::mem::replace(&mut self.lines, lines)
    }

    fn subroutine(&mut self) {
        self.back_to((Plane::Xy, false, false));
        let o = self.o_number();
        let name = if self.random.one_in(3) { format!("<sub{o}>") } else { o.to_string() };
        let mut lines = vec![format!("o{name} sub"), "G0 X#1 Y#2".to_owned()];
        lines.extend(self.apart());
        if self.random.one_in(3) {
            let inner = self.o_number();
            lines.push(format!("o{inner} if [#1 gt 5]"));
            lines.push(format!("o{name} return [#1*2]"));
            lines.push(format!("o{inner} endif"));
        }
        lines.push("G1 Z#3".to_owned());
        lines.push(format!("o{name} endsub{}", self.random.pick(&["", " [#2+1]"])));
        self.subs.push(lines);
        for _ in 0..self.random.whole(1, 2) {
            let mut call = format!("o{name} call");
            for _ in 0..self.random.whole(0, 3) {
                let length = self.length();
                add!(call, " [{}]", number(length));
            }
            self.line(call);
            if self.random.one_in(2) {
                self.line("G0 Y#<_value>");
            }
        }
    }

    fn called_program(&mut self) {
        if self.percent {
            return self.moves();
        }
        self.back_to((Plane::Xy, false, false));
        let o = self.o_number();
        // The reference does not find a program that it passed over on its way to another one: callers are first.
        let place = self.behind.len();
        self.behind.push(Vec::new());
        let mut lines = vec![format!("O{o}")];
        lines.extend(self.apart());
        lines.push("M99".to_owned());
        if let Some(program) = self.behind.get_mut(place) {
            *program = lines;
        }
        // Inside a loop or branch the reference does not find its end any more after `L0`.
        let repeats = if self.depth > 1 { ["", " L2", "", " L3"] } else { ["", " L2", " L0", " L3"] };
        let repeats = self.random.pick(&repeats);
        self.line(format!("M98 P{o}{repeats}"));
    }

    /// A convex outline with sharp or rounded corners, run inside or outside.
    fn compensation(&mut self) {
        self.back_to((Plane::Xy, false, false));
        self.line("G40");
        let (scale, diameter) = if self.inch { (0.04, 0.25) } else { (1.0, 6.0) };
        let sides = self.random.whole(3, 7);
        let radius = f64::from(self.random.whole(30, 60) as i32) * scale;
        let start = f64::from(self.random.whole(0, 11) as i32) * 30.0;
        let counterclockwise = self.random.one_in(2);
        let corner = |ix: i64| {
            let turn = f64::from(ix as i32) * 360.0 / f64::from(sides as i32);
            let angle = (start + if counterclockwise { turn } else { -turn }).to_radians();
            (radius * angle.cos(), radius * angle.sin())
        };
        let left = self.random.one_in(2);
        let inside = left == counterclockwise;
        let (side, dynamic) = (if left { "G41" } else { "G42" }, self.random.one_in(2));
        let on = if dynamic { format!("{side}.1 D{}", number(diameter)) } else { format!("{side} D2") };
        // The lead-in comes along the first side's line, or square to it, from the side where the tool will be.
        let ((ax, ay), (bx, by)) = (corner(0), corner(1));
        let middle = (f64::midpoint(ax, bx), f64::midpoint(ay, by));
        let reach = if inside { 0.3 } else { 2.5 };
        let lead = (middle.0 * reach, middle.1 * reach);
        self.line(format!("G0 X{} Y{}", number(lead.0), number(lead.1)));
        let rapid = self.random.pick(&["G1", "G1", "G0"]);
        self.line(format!("{on} {rapid} X{} Y{}", number(middle.0), number(middle.1)));
        let rounded = self.random.one_in(3);
        let fillet = if inside { 14.0 } else { 5.0 } * scale;
        for ix in 1..=sides {
            let ((px, py), (cx, cy), (nx, ny)) = (corner(ix - 1), corner(ix), corner(ix + 1));
            if rounded && ix < sides {
                // From one tangent point of the corner's arc to the other.
                let half = std::f64::consts::PI * (1.0 - 2.0 / f64::from(sides as i32)) / 2.0;
                let cut = fillet / half.tan();
                let toward = |(tx, ty): (f64, f64)| {
                    let long = (tx - cx).hypot(ty - cy);
                    (cx + (tx - cx) * cut / long, cy + (ty - cy) * cut / long)
                };
                let ((sx, sy), (ex, ey)) = (toward((px, py)), toward((nx, ny)));
                if cut * 2.05 < (px - cx).hypot(py - cy) {
                    self.line(format!("G1 X{} Y{}", number(sx), number(sy)));
                    let code = if counterclockwise { "G3" } else { "G2" };
                    self.line(format!("{code} X{} Y{} R{}", number(ex), number(ey), number(fillet)));
                    continue;
                }
            }
            self.line(format!("G1 X{} Y{}", number(cx), number(cy)));
            if self.random.one_in(6) {
                let depth = self.length();
                self.line(format!("Z{}", number(depth)));
            }
            if self.random.one_in(8) {
                let code = self.random.pick(&["M8", "M9", "F33", "G4 P1", "S77", "M0"]);
                self.line(code);
            }
        }
        self.line(format!("G1 X{} Y{}", number(middle.0), number(middle.1)));
        self.line("G40");
        let back = self.random.pick(&["G0", "G1"]);
        self.line(format!("{back} X{} Y{}", number(lead.0), number(lead.1)));
    }

    fn feed_modes(&mut self) {
        if self.random.one_in(2) {
            self.line("G93");
            for _ in 0..self.random.whole(1, 3) {
                let words = self.axis_words(&["X", "Y", "Z"]);
                let feed = self.random.whole(1, 9);
                self.line(format!("G1{words} F{feed}"));
            }
        } else {
            self.line("S500 M3");
            self.line("G95 F0.1");
            for _ in 0..self.random.whole(1, 3) {
                let words = self.axis_words(&["X", "Y", "Z"]);
                self.line(format!("G1{words}"));
            }
        }
        self.line("G94");
        let feed = self.feed();
        self.line(feed);
    }

    fn polar(&mut self) {
        self.back_to((Plane::Xy, false, false));
        // At the origin a distance alone has no direction.
        self.line("G0 X3 Y4");
        for _ in 0..self.random.whole(1, 4) {
            let (distance, angle) = (self.positive(30), self.random.whole(-180, 360));
            let code = self.random.pick(&["G0", "G1"]);
            let line = match self.random.whole(0, 3) {
                0 => format!("{code} ^{angle}"),
                1 => format!("{code} @{}", number(distance)),
                _ => format!("{code} @{} ^{angle}", number(distance)),
            };
            self.line(line);
        }
    }

    fn probing(&mut self) {
        self.set_incremental(false);
        let (from, to) = (self.positive(9), -self.positive(9));
        let code = self.random.pick(&["G38.2", "G38.3", "G38.4", "G38.5"]);
        let axis = self.random.pick(&["X", "Y", "Z"]);
        self.line(format!("G0 {axis}{}", number(from)));
        self.line(format!("{code} {axis}{}", number(to)));
        let result = self.random.pick(&["5061", "5062", "5063", "5070"]);
        self.line(format!("G0 {axis}#{result}"));
    }

    fn threads(&mut self) {
        self.set_incremental(false);
        self.line("S300 M3");
        let (x, z) = (self.positive(30) + 3.0, self.positive(5));
        self.line(format!("G0 X{} Z{}", number(x), number(z)));
        let pitch = if self.inch { 0.05 } else { 1.25 };
        match self.random.whole(0, 3) {
            0 => self.line(format!("G33 Z{} K{}", number(-z), number(pitch))),
            1 => self.line(format!("G33.1 Z{} K{}", number(-z), number(pitch))),
            _ => {
                let side = self.random.pick(&["-", ""]);
                let mut line = format!(
                    "G76 P{} Z{} I{side}{} J{} K{}",
                    number(pitch),
                    number(-z * 2.0),
                    number(pitch / 2.0),
                    number(pitch / 5.0),
                    number(pitch * 0.6),
                );
                for (letter, values) in [
                    ("R", ["1", "1.5", "2"]),
                    ("Q", ["0", "29.5", "30"]),
                    ("H", ["0", "1", "2"]),
                    ("L", ["0", "1", "3"]),
                ] {
                    if self.random.one_in(3) {
                        add!(line, " {letter}{}", self.random.pick(&values));
                        if letter == "L" {
                            add!(line, " E{}", number(pitch / 2.0));
                        }
                    }
                }
                self.line(line);
            }
        }
        self.line("G0");
    }

    fn splines(&mut self) {
        self.back_to((Plane::Xy, false, false));
        let words = |writer: &mut Self| {
            let (x, y) = (writer.length(), writer.length());
            format!("X{} Y{}", number(x), number(y))
        };
        let (end, first, second) = (words(self), self.length(), self.length());
        match self.random.whole(0, 2) {
            0 => self.line(format!("G5 {end} I{} J{} P1 Q-1", number(first), number(second))),
            1 => self.line(format!("G5.1 {end} I{} J{}", number(first), number(second + 0.5))),
            _ => {
                self.line(format!("G5.2 {end} P1 L3"));
                for _ in 0..self.random.whole(2, 4) {
                    let point = words(self);
                    let weight = self.random.pick(&["1", "0.5", "2"]);
                    self.line(format!("{point} P{weight}"));
                }
                self.line("G5.3");
            }
        }
        self.line("G0");
    }

    fn saved_state(&mut self) {
        self.line("M70");
        let modes = (self.plane, self.incremental, self.diameter, self.inch);
        for _ in 0..self.random.whole(1, 3) {
            match self.random.whole(0, 3) {
                0 => self.modes(),
                1 => self.units(),
                2 => self.machine_functions(),
                _ => self.moves(),
            }
        }
        self.line("M72");
        (self.plane, self.incremental, self.diameter, self.inch) = modes;
        let feed = self.feed();
        self.line(format!("{feed} S250 M3"));
    }
}
