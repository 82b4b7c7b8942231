//! Laws of resources: every command ends within limits of the system on programs that are made to cost much, and twice the
//! program costs at most twice as much.
//!
//! Knows: shapes of programs that once cost more than their text is worth, limits of a process. Must not know: what is found in
//! them.
//!
//! The cost is the time of the processor, which other processes of the machine change little; a law is broken when it is broken
//! three times in a row.
#![cfg(target_os = "linux")]

use std::fmt::Write as _;
use std::process::Stdio;

use crate::shop::Shop;

/// Address space of a child, in kilobytes: stacks and what allocators reserve are in it.
const MOST_KILOBYTES: u64 = 1_500_000;
/// Time of the processor of a child, in seconds.
const MOST_SECONDS: u32 = 120;
/// Blocks that a run of an [`ENDLESS`] program may execute here, beside the usual number for all others.
const FUEL: u32 = 300_000;
/// Shapes whose runs end when their fuel is used up: what such a run costs is fuel, not text.
const ENDLESS: [&str; 2] = ["call bomb", "call bomb with conditions"];
/// What a process costs that does next to nothing, and what the clock cannot tell, in seconds.
const NOISE: f64 = 0.15;
/// Twice the program may cost so many times as much.
const GROWTH: f64 = 2.4;

/// A program of some size.
type Shape = (&'static str, usize, fn(usize) -> String);

const SHAPES: &[Shape] = &[
    ("call bomb", 200, call_bomb),
    ("call bomb with conditions", 60, conditional_call_bomb),
    ("jump table", 800, jump_table),
    ("nests of loops", 150, nests),
    ("long line", 20_000, long_line),
    ("deep line", 20_000, |n| format!("O1\n{}\nM30\n", "IF[#1EQ1]THEN ".repeat(n))),
    ("blocks of one line", 10_000, |n| format!("O1\n{}\nM30\n", "G0;".repeat(n))),
    ("labels", 3_000, labels),
    ("variables", 3_000, variables),
    ("programs", 1_000, |n| (1..=n).map(|p| format!("O{p}\nG0 X1.\nM98 P{}\nM99\n", p % n + 1)).collect()),
    ("comments that open comments", 50_000, |n| format!("O1\n{}\nM30\n", "(".repeat(n))),
    // One control repeats a cycle by `K`, another one by `L`.
    ("holes of one block", 4, |n| {
        let holes = "X1. K99999\nX1. L99999\n".repeat(n);
        format!("O1\nG21 G90 G0 X0. Y0. Z5.\nM3 S900\nG91 G83 X1. R-2. Z-20. Q0.01 F100.\n{holes}G80\nM30\n")
    }),
    ("moves", 10_000, |n| {
        let moves: String = (0..n).map(|x| format!("G1 X{}. Y{}. F100.\n", x % 97, x % 31)).collect();
        format!("O1\nG21 G90\n{moves}M30\n")
    }),
];

/// Nine programs, each of which calls the next so often: what they execute is not a function of their text.
fn call_bomb(calls: usize) -> String {
    let bodies = (1..10).map(|p| format!("O{p}\n{}M99\n", format!("M98 P{}\n", p + 1).repeat(calls / 9)));
    format!("%\n{}O10\nG0 X1.\nM99\n%\n", bodies.collect::<String>())
}

fn conditional_call_bomb(calls: usize) -> String {
    let body = |p: usize| {
        let calls = (0..calls / 9)
            .map(|n| format!("IF[#{}EQ{n}]GOTO{}\nM98 P{}\nN{}\n", 100 + p, n + 1, p + 1, n + 1));
        format!("O{p}\n{}M99\n", calls.collect::<String>())
    };
    format!("%\n{}O10\nG0 X1.\nM99\n%\n", (1..10).map(body).collect::<String>())
}

fn jump_table(labels: usize) -> String {
    let arms = (1..=labels).map(|n| format!("N{n} G0 X{n}.\n#1=#1+{n}\nGOTO #1\n"));
    format!("O1\nGOTO #500\n{}M30\n", arms.collect::<String>())
}

fn nests(count: usize) -> String {
    let nest = "#1=0\nWHILE[#1LT9]DO1\n#1=#1+1\n#2=0\nWHILE[#2LT9]DO2\n#2=#2+1\n#3=0\nWHILE[#3LT#500]DO3\n#3=#3+1\nG0 X#3\n\
                END3\nEND2\nEND1\n";
    format!("O1\n{}M30\n", nest.repeat(count))
}

fn long_line(words: usize) -> String {
    let mut line = String::new();
    for word in 0..words {
        // Writing to a string cannot fail.
        let _ = write!(line, "X{word}. ");
    }
    format!("O1\nG1 {line}\nM30\n")
}

fn labels(count: usize) -> String {
    let lines = (1..=count).map(|n| format!("N{n} IF[#500EQ{n}]GOTO{}\n", count + 1 - n));
    format!("O1\n{}M30\n", lines.collect::<String>())
}

fn variables(count: usize) -> String {
    let lines = (0..count).map(|n| format!("#{}=#{}+1\n", 100 + n % 900, 100 + (n * 7) % 900));
    format!("O1\n{}M30\n", lines.collect::<String>())
}

/// Seconds of the processor that a command takes on a file; it must end by itself, within the limits.
fn cost(shop: &Shop, arguments: &str, name: &str) -> f64 {
    cost_within(MOST_KILOBYTES, shop, arguments, name)
}

/// The same within so much address space.
fn cost_within(kilobytes: u64, shop: &Shop, arguments: &str, name: &str) -> f64 {
    let mut shell = std::process::Command::new("sh");
    // The second line of `times` is that of the children.
    let script = format!(
        "ulimit -v {kilobytes}; ulimit -t {MOST_SECONDS}; \"$0\" \"$@\" >/dev/null 2>err; echo code $?; times"
    );
    shell.current_dir(shop.path("")).env_clear().arg("-c").arg(script).arg(env!("CARGO_BIN_EXE_gcheck"));
    // Each thread would reserve memory of its own.
    shell.env("MALLOC_ARENA_MAX", "1").env("RAYON_NUM_THREADS", "1");
    let output = shell.args(arguments.split_whitespace()).stdin(Stdio::null()).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = said.lines().collect();
    let code: i32 = lines[0].trim_start_matches("code ").parse().unwrap();
    assert!((0..=2).contains(&code), "{arguments} of {name}: exit code {code}, {}", shop.read("err"));
    assert!(!shop.read("err").contains("internal"), "{arguments} of {name}: {}", shop.read("err"));
    lines[2].split_whitespace().map(seconds).sum()
}

/// `0m1.25s` in seconds.
fn seconds(text: &str) -> f64 {
    let (minutes, seconds) = text.trim_end_matches('s').split_once('m').unwrap();
    minutes.parse::<f64>().unwrap() * 60.0 + seconds.parse::<f64>().unwrap()
}

/// What a command takes on a shape beside the usual.
fn with_fuel(command: &str, shape: &str) -> String {
    let runs = ["run", "stats", "plot", "diff"].iter().any(|name| command.starts_with(name));
    if runs && ENDLESS.contains(&shape) { format!("{command} --fuel {FUEL}") } else { command.to_owned() }
}

/// Twice a program costs a command at most twice as much.
fn check_growth(command: &str) {
    let shop = Shop::new();
    let mut curves = String::new();
    let mut broken = Vec::new();
    for (name, size, shape) in SHAPES {
        shop.file("once.nc", shape(*size));
        shop.file("twice.nc", shape(2 * size));
        let command = with_fuel(command, name);
        let mut left = 3;
        loop {
            let once = cost(&shop, &command.replace("FILE", "once.nc"), name);
            let twice = cost(&shop, &command.replace("FILE", "twice.nc"), name);
            let holds = twice <= once * GROWTH + NOISE;
            let _ = writeln!(curves, "{command:<60} {name:<30} {once:6.2} s {twice:6.2} s");
            left -= 1;
            if holds || left == 0 {
                if !holds {
                    broken.push(format!("{name}: {once:.2} s, then {twice:.2} s"));
                }
                break;
            }
        }
    }
    assert!(broken.is_empty(), "{command}: {}\n{curves}", broken.join("; "));
}

macro_rules! laws {
    ($($test:ident $command:expr;)*) => {
        $(#[test]
        fn $test() {
            check_growth($command);
        })*
    };
}

laws! {
    twice_the_program_is_checked_in_twice_the_time "check FILE --no-cache --control fanuc-mill";
    twice_the_program_is_checked_with_all_rules_in_twice_the_time "check FILE --no-cache --control haas-mill --select all";
    twice_the_program_is_formatted_in_twice_the_time "fmt --diff FILE --control fanuc-mill";
    twice_the_program_is_fixed_in_twice_the_time "check --diff --unsafe-fixes FILE --no-cache --control fanuc-mill";
    twice_the_program_is_run_in_twice_the_time "run FILE --control fanuc-mill";
    twice_the_program_is_counted_in_twice_the_time "stats FILE --control fanuc-mill";
    twice_the_program_is_drawn_in_twice_the_time "plot FILE -o out.html --control fanuc-mill";
    twice_the_program_is_compared_in_twice_the_time "diff FILE once.nc --control fanuc-mill";
}

/// Programs that run until their fuel is used up, and keep as much as they can meanwhile.
fn endless() -> [(&'static str, String); 5] {
    [
        ("calls", call_bomb(200)),
        ("moves", "O1\nG21 G90\nN1 G1 X1. F100.\n#1=#1+0.001\nG1 X#1 Y2.\nGOTO1\nM30\n".to_owned()),
        (
            "arcs",
            "O1\nG21 G90 G0 X0. Y0.\nN1 G2 X1. Y0. I0.5 F100.\nG2 X0. Y0. I-0.5\nGOTO1\nM30\n".to_owned(),
        ),
        ("tools", "O1\nN1 T#1 M6\n#1=#1+1\nS#1 M3\nG1 X#1 F#1\nM0\nGOTO1\nM30\n".to_owned()),
        ("variables", "O1\nN1 #[100+#1]=#1\n#1=#1+1\nIF[#1LT890]GOTO1\n#1=0\nGOTO1\nM30\n".to_owned()),
    ]
}

/// What a run of a short program costs is its fuel: its time grows with it, its memory does not.
fn check_fuel(command: &str) {
    let shop = Shop::new();
    shop.file("other.nc", "O1\nG21 G90\nG1 X1. F100.\nM30\n");
    for (name, text) in endless() {
        shop.file("a.nc", text);
        let mut left = 3;
        loop {
            let cost = |fuel: u32| {
                let command = format!("{command} --fuel {fuel} --control fanuc-mill");
                let beside = if command.starts_with("plot") { DRAWN_KILOBYTES } else { SHORT_KILOBYTES };
                cost_within(EMPTY_KILOBYTES + beside, &shop, &command, name)
            };
            let (once, twice) = (cost(2 * FUEL), cost(4 * FUEL));
            left -= 1;
            if twice <= once * GROWTH + NOISE {
                break;
            }
            assert!(left > 0, "{command} of endless {name}: {once:.2} s, then {twice:.2} s");
        }
    }
}

macro_rules! laws_of_fuel {
    ($($test:ident $command:literal;)*) => {
        $(#[test]
        fn $test() {
            check_fuel($command);
        })*
    };
}

laws_of_fuel! {
    a_run_without_end_costs_its_fuel "run a.nc";
    counting_a_run_without_end_costs_its_fuel "stats a.nc";
    drawing_a_run_without_end_costs_its_fuel "plot a.nc -o out.html";
    comparing_a_run_without_end_costs_its_fuel "diff a.nc other.nc";
}

#[test]
fn wide_tables_cost_what_they_hold() {
    let shop = Shop::with(&[("a.nc", "O1\nG21\nM30\n")]);
    let tools =
        |count: usize| -> String { (1..=count).map(|t| format!("{t} = {{ length = {t}.5 }}\n")).collect() };
    let offsets =
        |count: usize| -> String { (0..count).map(|v| format!("\"#{}\" = {v}.5\n", 100 + v)).collect() };
    let mut costs = Vec::new();
    for count in [2_000, 4_000] {
        shop.file(
            "gcheck.toml",
            format!("control = \"haas-mill\"\n[tools]\n{}[variables]\n{}", tools(count), offsets(count)),
        );
        costs.push(cost(&shop, "run a.nc", "wide tables"));
    }
    assert!(costs[1] <= costs[0] * GROWTH + NOISE, "{costs:?}");
}

/// What the program and its threads take of the address space, whatever they read.
const EMPTY_KILOBYTES: u64 = 200_000;

/// A short program may take so much beside that, and a long one so much and four times its text.
const SHORT_KILOBYTES: u64 = 100 * 1024;
const LONG_KILOBYTES: u64 = 200 * 1024;
/// A picture has at most so many moves as fit in this, and is made smaller when it has more.
const DRAWN_KILOBYTES: u64 = 400 * 1024;

#[test]
fn what_an_analysis_keeps_does_not_grow_with_its_paths() {
    let shop = Shop::new();
    // Ten blocks that call the next program in each of nine, with and without conditions.
    for (name, text) in [("calls", call_bomb(90)), ("conditional calls", conditional_call_bomb(27))] {
        shop.file("short.nc", text);
        cost_within(
            EMPTY_KILOBYTES + SHORT_KILOBYTES,
            &shop,
            "check short.nc --no-cache --control haas-mill",
            name,
        );
    }
    let text = conditional_call_bomb(29_000);
    let kilobytes = LONG_KILOBYTES + 4 * text.len() as u64 / 1024;
    assert!(text.len() > 900_000, "{} bytes", text.len());
    shop.file("long.nc", text);
    let command = "check long.nc --no-cache --control haas-mill";
    cost_within(EMPTY_KILOBYTES + kilobytes, &shop, command, "conditional calls");
}

#[test]
fn one_line_costs_at_most_twice_its_size() {
    let megabytes = 150;
    let shop = Shop::new();
    for (name, piece) in
        [("words", "X1.5 "), ("blocks", "G0;  "), ("expressions", "#1=2+"), ("comment", "(abcd")]
    {
        shop.file("a.nc", format!("O1\n{}\nM30\n", piece.repeat(megabytes * 200_000)));
        let most = EMPTY_KILOBYTES + 2 * megabytes as u64 * 1_000;
        for command in ["check a.nc --no-cache", "fmt --check a.nc", "run a.nc", "stats a.nc"] {
            cost_within(most, &shop, &format!("{command} --control fanuc-mill"), name);
        }
    }
}
