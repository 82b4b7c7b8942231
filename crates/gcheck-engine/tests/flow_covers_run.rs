//! Law 4: the analysis of all paths covers every run.
//!
//! Random programs with loops, jumps, calls, block deletes and inputs (`#100` to `#105`) that the analysis does not know
//! and the run does. At every block that a run comes to, its state must be one that the analysis allows there; no block it
//! comes to may be called unreachable; and when it comes to the program's end, it was at every block that the analysis says
//! every path comes to.

#![expect(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a test that meets the unexpected is to fail"
)]

use std::collections::BTreeMap;
use std::fmt::Write as _;

use gcheck_engine::{
    Abstract, At, Axis, Concrete, FlowCx, FlowObserver, Machine, Model, NoLibrary, Observer, Options, Origin,
    Position, Program, Reach, Role, State, Stopped, Task, WorkOffset, flow, run,
};
use gcheck_program::{Dialect, Loaded};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

// ---- programs ----

/// How a control writes loops and calls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Style {
    /// `GOTO`, `WHILE … DO`, `M98`, `G65`.
    Macro,
    /// As [`Style::Macro`], with `M97`.
    Local,
    /// As [`Style::Local`], with modes that shift the axes by the tool.
    FiveAxis,
    /// O-words.
    OWords,
}

/// Writes a program by choices. When the choices run out, each is 0, which is always the plainest.
struct Writer<'a> {
    choices: std::slice::Iter<'a, u8>,
    style: Style,
    text: String,
    /// Subprograms, written behind the main program.
    subprograms: Vec<String>,
    next_label: u32,
    loop_depth: u32,
    depth: u32,
    statements: u32,
    /// Inside a subprogram, which calls no other.
    inside: bool,
}

/// Variables of a program: inputs, and common ones it sets.
const INPUTS: [u32; 6] = [100, 101, 102, 103, 104, 105];
const COMMON: [u32; 3] = [110, 111, 112];

impl<'a> Writer<'a> {
    fn new(choices: &'a [u8], style: Style) -> Self {
        Self {
            choices: choices.iter(),
            style,
            text: String::new(),
            subprograms: Vec::new(),
            next_label: 0,
            loop_depth: 0,
            depth: 0,
            statements: 0,
            inside: false,
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

    fn program(mut self) -> String {
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

    fn mode(&mut self) {
        if self.style == Style::FiveAxis {
            return self.five_axis_mode();
        }
        let line = [
            "G90",
            "G91",
            "G17",
            "G18",
            "G54",
            "G55",
            "S500 M3",
            "M5",
            "F200.",
            "M8",
            "M9",
            "G20",
            "G21",
            "S#100",
            "F[#101+10.]",
            "G94",
            "G93",
            "T1",
            "G43 H1",
            "G49",
            "G92 X0.",
            "G52 X1.",
            "G4 P1",
            "T2 M6",
            "G81 X1. Y1. Z-2. R1. F100.",
            "G83 X2. Z-3. R1. Q1. F100.",
            "X3.",
            "G80",
            "G98",
            "G99",
            "G2 X2. Y0. R5. F100.",
            "G3 X0. Y2. I1. J1. F100.",
            "G28 Z0.",
            "G53 G0 Z-1.",
            "G10 L2 P1 X5.",
            "G40",
            "G41 D1",
            "G1 X[#110+5.] F50.",
            "G61",
            "G10 L2 P2 Y#100",
            "G92.1",
            "G0 X[#5001]",
            "G68 X0. Y0. R30.",
            "G69",
        ][self.choose(44) as usize];
        if self.style == Style::Local && self.choose(8) == 7 {
            return self.wrapped();
        }
        // What LinuxCNC has not, or not without a tool table.
        let is_foreign =
            self.style == Style::OWords && ["G52", "G41", "G68", "G69"].iter().any(|g| line.starts_with(g));
        self.line(if is_foreign { "G92.1" } else { line });
    }

    fn five_axis_mode(&mut self) {
        let line = [
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
        ][self.choose(24) as usize];
        self.line(line);
    }

    /// Drawings around a cylinder on A.
    fn wrapped(&mut self) {
        let line = [
            "G107 Y0. A0. Q50.",
            "G107",
            "G107 A0. R#100",
            "G107 Y0. A0.",
            "G0 A90.",
            "G107 X0. A0. Q#100",
            "G1 Y#101 F100.",
            "/G107 Y0. A0. Q20.",
        ][self.choose(8) as usize];
        self.line(line);
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
        let line = [
            "G31 X[#110] F50. M75",
            "G31 Y-1. F50.",
            "#111=#5061",
            "G31 X2. F50. M78",
            "G136 X-1. F50.",
            "G36 Y1. I2. F50.",
            "G37 H1 Z0. F50.",
            "M75",
        ][self.choose(8) as usize];
        let is_foreign = match self.style {
            Style::Local | Style::FiveAxis => false,
            Style::Macro => !line.starts_with("G31") && !line.starts_with('#'),
            Style::OWords => true,
        };
        self.line(if is_foreign { "#110=#5001" } else { line });
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
            Style::Macro | Style::Local | Style::FiveAxis => {
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
        if self.inside || self.subprograms.len() >= 3 {
            return self.mode();
        }
        // Written apart from its caller, with labels of its own.
        let number = 1000 + self.subprograms.len() as u32;
        let caller = std::mem::take(&mut self.text);
        let (depth, loop_depth) = (self.depth, self.loop_depth);
        (self.inside, self.depth, self.loop_depth) = (true, 1, 0);
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
        (self.inside, self.depth, self.loop_depth) = (false, depth, loop_depth);
        let body = std::mem::replace(&mut self.text, caller);
        let calls = 1 + self.choose(2);
        for _ in 0..calls {
            let value = self.value();
            match self.style {
                Style::OWords => self.line(format!("o{number} call [{value}]")),
                _ if is_local => self.line(format!("M97 P{number}")),
                _ => match self.choose(3) {
                    0 => self.line(format!("M98 P{number}")),
                    1 => self.line(format!("M98 P{number} L2")),
                    _ => self.line(format!("G65 P{number} A{value} B1.")),
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

// ---- what is compared ----

/// States of the analysis by block.
#[derive(Default)]
struct Recorder(BTreeMap<At, Vec<State<Abstract>>>);

impl FlowObserver for Recorder {
    fn before(&mut self, cx: &FlowCx<'_>) {
        let states = self.0.entry(cx.origin.at).or_default();
        if states.last() != Some(cx.state) {
            states.push(cx.state.clone());
        }
    }
}

/// The blocks of a run with their states.
#[derive(Default)]
struct Visits(Vec<(At, State<Concrete>)>);

impl Observer<Concrete> for Visits {
    fn before(&mut self, origin: Origin, state: &State<Concrete>) {
        self.0.push((origin.at, state.clone()));
    }
}

/// Why an abstract state does not stand for a concrete one; `None` when it does.
fn difference(model: &Model<'_>, outer: &State<Abstract>, inner: &State<Concrete>) -> Option<String> {
    let a: Vec<At> = outer.frames().iter().map(|frame| frame.caller).collect();
    let b: Vec<At> = inner.frames().iter().map(|frame| frame.caller).collect();
    if a != b {
        return Some(format!("calls {a:?} / {b:?}"));
    }
    for (a, b) in outer.frames().iter().zip(inner.frames()) {
        if a.repeats().is_some() && a.repeats() != b.repeats() {
            return Some(format!("repeats {:?} / {:?}", a.repeats(), b.repeats()));
        }
    }
    for role in Role::ALL {
        if !outer.mode(role).contains(inner.mode(role)) {
            return Some(format!("mode {role:?} {:?} / {:?}", outer.mode(role), inner.mode(role)));
        }
    }
    let positions = [
        ("programmed", *outer.position(), *inner.position()),
        ("actual", *outer.actual(), *inner.actual()),
        ("machine", outer.machine(model), inner.machine(model)),
        ("length", *outer.length(), *inner.length()),
        ("shift", outer.shift(), inner.shift()),
    ];
    for (name, a, b) in positions {
        for axis in Axis::ALL {
            // What the run does not know contradicts nothing.
            if let (Some(known), Some(value)) = (a.get(axis), b.get(axis))
                && (value - known).abs() > 1e-9
            {
                return Some(format!("{name} {} {known} / {value}", axis.name()));
            }
        }
    }
    let values = [
        ("feed", outer.feed(), inner.feed()),
        ("speed", outer.speed(), inner.speed()),
        ("tool", outer.tool(), inner.tool()),
        ("selected", outer.selected(), inner.selected()),
        ("h", outer.h(), inner.h()),
        ("d", outer.d(), inner.d()),
    ];
    for (name, a, b) in values {
        if !a.allows(*b) {
            return Some(format!("{name} {a:?} / {b:?}"));
        }
    }
    for number in INPUTS.into_iter().chain(COMMON) {
        let (a, b) = (outer.variables().get(number), inner.variables().get(number));
        if !a.allows(b) {
            return Some(format!("#{number} {a:?} / {b:?}"));
        }
    }
    for number in (1..=5).chain([21, 22]) {
        if let (Some(a), Some(b)) = (outer.local(number), inner.local(number))
            && !a.allows(*b)
        {
            return Some(format!("#{number} {a:?} / {b:?}"));
        }
    }
    if outer.spindle().is_some() && outer.spindle() != inner.spindle() {
        return Some(format!("spindle {:?} / {:?}", outer.spindle(), inner.spindle()));
    }
    if outer.work().is_some() && outer.work() != inner.work() {
        return Some(format!("work offset {:?} / {:?}", outer.work(), inner.work()));
    }
    None
}

/// How a run was covered; the reason when it was not.
fn check(control: &str, style: Style, choices: &[u8], inputs: &[u8], skip: bool) -> Result<Stopped, String> {
    let text = Writer::new(choices, style).program();
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let model = Model::new(&control);
    let loaded = Loaded::new(text.as_str(), &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let options = if skip { Options::SKIP_ALL } else { Options::NONE };

    let mut recorder = Recorder::default();
    let result = flow(
        &program,
        &model,
        &Machine::default(),
        Task { options, ..Task::all_paths(40_000) },
        &mut recorder,
    );

    let value = |byte: u8| [0.0, 1.0, 2.0, 3.0, -1.0, 2.5][usize::from(byte) % 6];
    let machine = Machine {
        variables: INPUTS.into_iter().zip(inputs).map(|(number, byte)| (number, value(*byte))).collect(),
        offsets: [(1, 10.0), (2, 20.0)]
            .map(|(number, x)| {
                let mut origin = Position::ZERO;
                origin.set(Axis::X, x);
                (number, WorkOffset { origin, rotation: 0.0 })
            })
            .into(),
        start: Some(Position::ZERO),
        fresh: inputs.first().is_some_and(|byte| byte % 2 == 0),
        ..Machine::default()
    };
    let mut visits = Visits::default();
    let done = run(&program, &model, &machine, options, 3_000, &mut visits);

    if result.is_incomplete() {
        return Ok(Stopped::OutOfFuel);
    }
    let fail = |at: At, why: String| {
        let mut listing = String::new();
        for (number, line) in text.lines().enumerate() {
            let mark = if number as u32 == at.block { '>' } else { ' ' };
            let _ = writeln!(listing, "{mark} {number:3} {line}");
        }
        Err(format!("block {}: {why}\ninputs {:?}, skip {skip}\n{listing}", at.block, machine.variables))
    };
    for (at, state) in &visits.0 {
        if result.reach(*at) == Reach::Never {
            return fail(*at, "visited, and said to be unreachable".to_owned());
        }
        let states = recorder.0.get(at).map(Vec::as_slice).unwrap_or_default();
        let why: Vec<String> = states.iter().map_while(|outer| difference(&model, outer, state)).collect();
        // One that stands for it is enough.
        if why.len() == states.len() {
            let why: Vec<_> = why.into_iter().filter(|why| !why.starts_with("calls")).collect();
            return fail(*at, if why.is_empty() { "never shown".to_owned() } else { why.join("\n") });
        }
    }
    if let Stopped::Ended(_) = done.stopped {
        let visited: std::collections::BTreeSet<At> = visits.0.iter().map(|(at, _)| *at).collect();
        let blocks = program.file(0).map_or(0, |file| file.loaded.outline().blocks());
        for block in 0..blocks {
            let at = At { file: 0, block };
            // A block that is skipped is come to, though not executed.
            let is_skipped = text.lines().nth(block as usize).is_some_and(|line| line.starts_with('/'));
            if result.reach(at) == Reach::Always && !visited.contains(&at) && !is_skipped {
                return fail(at, "said to be on every path, and not visited".to_owned());
            }
        }
    }
    Ok(done.stopped)
}

fn law(control: &'static str, style: Style, cases: u32) {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 20_000, ..Config::default() };
    // The same programs in every run.
    let mut runner = TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    );
    let strategy =
        (prop::collection::vec(any::<u8>(), 10..260), prop::collection::vec(any::<u8>(), 6), any::<bool>());
    let ended = std::cell::Cell::new(0);
    let result = runner.run(&strategy, |(choices, inputs, skip)| {
        let stopped = check(control, style, &choices, &inputs, skip).map_err(TestCaseError::fail)?;
        ended.set(ended.get() + u32::from(matches!(stopped, Stopped::Ended(_))));
        Ok(())
    });
    if let Err(error) = result {
        panic!("{control}: {error}");
    }
    // A law that hardly any program comes to the end of would say little.
    assert!(ended.get() * 2 > cases, "{control}: only {} of {cases} runs came to their end", ended.get());
}

#[test]
fn the_flow_covers_the_run_with_gotos_and_macros() {
    law("fanuc-mill", Style::Macro, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_local_subprograms() {
    law("haas-mill", Style::Local, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_shifts_by_the_tool() {
    law("haas-mill", Style::FiveAxis, 2_000);
}

#[test]
fn the_flow_covers_the_run_with_o_words() {
    law("linuxcnc", Style::OWords, 2_000);
}
