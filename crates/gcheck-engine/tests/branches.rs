//! A way of a condition that is followed from where it begins shows what an analysis from the beginning shows of it.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write as _;

use gcheck_engine::{
    At, Branch, Choice, Ending, Event, Fault, FlowCx, FlowObserver, FlowResult, Machine, Model, NoLibrary,
    Program, Task, flow, flow_branch,
};
use gcheck_program::{Dialect, Loaded};

/// Everything that was shown, each with the state and the facts that go with it; and the branches.
#[derive(Default)]
struct Watcher {
    shown: Vec<String>,
    branches: Vec<Branch>,
}

impl Watcher {
    fn note(&mut self, cx: &FlowCx<'_>, what: &str) {
        let mut line = format!("{:?} {what} solo {} ", cx.origin.at, cx.solo);
        let _ = write!(line, "{:?} {:?}", cx.state, cx.definitions.decisions());
        self.shown.push(line);
    }
}

impl FlowObserver for Watcher {
    fn before(&mut self, cx: &FlowCx<'_>) {
        self.note(cx, "before");
    }

    fn event(&mut self, cx: &FlowCx<'_>, event: &Event) {
        self.note(cx, &format!("{event:?}"));
    }

    fn fault(&mut self, cx: &FlowCx<'_>, fault: &Fault) {
        self.note(cx, &format!("{fault:?}"));
    }

    fn ended(&mut self, cx: &FlowCx<'_>, ending: Ending) {
        self.note(cx, &format!("{ending:?}"));
    }

    fn endless(&mut self, cx: &FlowCx<'_>, head: At) {
        self.note(cx, &format!("endless {head:?}"));
    }

    fn wanted_branches(&self, _: At) -> usize {
        9
    }

    fn branches(&mut self, branches: Vec<Branch>) {
        self.branches.extend(branches);
    }
}

/// Follows each way of each condition both ways of looking, and the ways that these come by, to a depth.
fn check_branches(control: &str, text: &str) {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let model = Model::new(&control);
    let program = Program::new(Loaded::new(text, &dialect, |_, _, _| ()), &dialect, &NoLibrary);
    let machine = Machine::default();
    let analyse = |choices: &[Choice], from: Option<Branch>| -> (Watcher, FlowResult) {
        let mut watcher = Watcher::default();
        let task = Task { choices, ..Task::all_paths(100_000) };
        let result = match from {
            Some(branch) => flow_branch(&program, &model, &machine, task, branch, &mut watcher),
            None => flow(&program, &model, &machine, task, &mut watcher),
        };
        (watcher, result)
    };
    let (first, _) = analyse(&[], None);
    assert!(!first.branches.is_empty(), "nothing parts in this program:\n{text}");
    let mut waiting: Vec<(Vec<Choice>, Branch)> =
        first.branches.into_iter().map(|branch| (vec![branch.choice()], branch)).collect();
    let mut followed = 0;
    while let Some((choices, branch)) = waiting.pop() {
        let (whole, of_whole) = analyse(&choices, None);
        let (part, of_part) = analyse(&choices, Some(branch));
        assert!(
            whole.shown.ends_with(&part.shown),
            "from the beginning it shows something else after {choices:?}:\n{text}"
        );
        assert_eq!(of_whole.work, of_part.work, "{choices:?} of\n{text}");
        assert_eq!(of_whole.is_incomplete(), of_part.is_incomplete(), "{choices:?} of\n{text}");
        followed += 1;
        if choices.len() < 3 && followed < 40 {
            for next in part.branches.into_iter().filter(|next| !choices.contains(&next.choice())) {
                waiting.push(([&choices[..], &[next.choice()]].concat(), next));
            }
        }
    }
}

const HEAD: &str = "G21 G90 G17 G40 G49 G80 G54\nT1 M6\nS1000 M3\nG0 X0. Y0.\nG43 H1 Z5.\n";

#[test]
fn after_a_jump_over_a_mode() {
    check_branches("fanuc-mill", &format!("{HEAD}IF [#500 EQ 1.] GOTO 10\nG91\nN10 G1 X5. F100.\nM30\n"));
}

#[test]
fn after_one_of_several_conditions() {
    check_branches(
        "fanuc-mill",
        &format!(
            "{HEAD}IF [#500 EQ 1.] GOTO 10\nG91\nN10 G1 X5. F100.\nIF [#501 GT #502] GOTO 20\nG55\n\
             IF [#503 LT 2.] GOTO 20\nG68 X0. Y0. R30.\nN20 X10.\nG69\nM30\n"
        ),
    );
}

#[test]
fn inside_a_loop_that_has_turned() {
    check_branches(
        "fanuc-mill",
        &format!(
            "{HEAD}#1=0\nWHILE [#1 LT 5.] DO1\n#1=#1+1\nIF [#1 NE #500] GOTO 30\nG1 X#1 F100.\nN30 END1\nM30\n"
        ),
    );
}

#[test]
fn of_a_loop_that_nobody_can_count() {
    check_branches(
        "haas-mill",
        &format!(
            "{HEAD}WHILE [#500 LT 5.] DO1\nG1 X#501 F100.\n#500=#500+1.\nIF [#502 EQ 3.] GOTO 90\nEND1\nN90 M30\n"
        ),
    );
}

#[test]
fn in_a_subprogram_that_is_called_twice() {
    check_branches(
        "haas-mill",
        &format!(
            "{HEAD}M97 P100\nG0 X20.\nM97 P100\nM30\nN100 IF [#500 EQ 1.] GOTO 110\nG91\n\
             WHILE [#3 LT 3.] DO1\n#3=#3+1\nG1 X1. F100.\nEND1\nG90\nN110 M99\n"
        ),
    );
}

#[test]
fn after_a_block_that_the_control_refuses() {
    check_branches(
        "fanuc-mill",
        &format!(
            "{HEAD}GOTO 999\nG2 X50. Y50. I1. J0. F100.\nIF [#500 EQ 1.] GOTO 10\nG91\nN10 G1 X5.\nM30\n"
        ),
    );
}

#[test]
fn of_a_computed_jump() {
    check_branches("fanuc-mill", &format!("{HEAD}GOTO #500\nN10 G91\nN20 G1 X5. F100.\nN30 X6.\nM30\n"));
}

#[test]
fn of_words_with_branches() {
    check_branches(
        "linuxcnc",
        "G21 G90 G17 G94\nG0 X0 Y0 Z5\no100 if [#<_a> gt 1]\nG91\no100 elseif [#500 gt 2]\nG20\no100 else\nF200\n\
         o100 endif\nG1 X5 F100\no110 while [#501 lt 3]\n#501=[#501+1]\no110 endwhile\nM2\n",
    );
}
