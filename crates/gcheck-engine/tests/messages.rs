//! What a program tells its operator.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

use std::fmt::Write;

use expect_test::{Expect, expect};
use gcheck_engine::{
    Concrete, Event, Machine, Model, NoLibrary, Observer, Options, Origin, Program, State, Stop, run,
};
use gcheck_program::{Dialect, Loaded};

#[derive(Default)]
struct Recorder(String);

impl Observer<Concrete> for Recorder {
    fn event(&mut self, _: Origin, _: &State<Concrete>, event: &Event) {
        match event {
            Event::Message(text) => writeln!(self.0, "message {text:?}").unwrap(),
            Event::Stop(Stop::Message(text)) => writeln!(self.0, "stop {text:?}").unwrap(),
            Event::Travel(_) => writeln!(self.0, "move").unwrap(),
            _ => {}
        }
    }
}

fn check(control: &str, text: &str, expected: &Expect) {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let loaded = Loaded::new(text, &dialect, |_, _, _| ());
    let program = Program::new(loaded, &dialect, &NoLibrary);
    let model = Model::new(&control);
    let mut recorder = Recorder::default();
    run(&program, &model, &Machine::default(), Options::NONE, 1_000, &mut recorder);
    expected.assert_eq(recorder.0.trim_end());
}

#[test]
fn a_stop_shows_the_comment_of_its_block() {
    check(
        "fanuc-mill",
        "O1\n#3006=1(CHECK THE PART)\n#3006=2\nM30\n",
        &expect![[r#"
        stop "CHECK THE PART"
        stop """#]],
    );
    check("haas-mill", "O1\nIF [#1 EQ #0] THEN #3006=1 ( no tool )\nM30\n", &expect![[r#"stop "no tool""#]]);
}

#[test]
fn the_last_comment_of_a_block_is_the_message_and_comes_first() {
    check(
        "linuxcnc",
        "G0 X1 (MSG, one) (msg,two)\n(M S G, three)\n; MSG, four\nM2\n",
        &expect![[r#"
        message "two"
        move"#]],
    );
    check("fanuc-mill", "O1 (MSG, no such thing here)\nM30\n", &expect![]);
}

#[test]
fn values_stand_in_the_place_of_parameters() {
    check(
        "linuxcnc",
        "#1=1.23456789\n(DEBUG,%d #1 %% %.2f#1 %f #1 %x %)\nM2\n",
        &expect![[r#"message " 1 %% 1.23  1.2346 %x %""#]],
    );
    check(
        "linuxcnc",
        "#1=2.5\n#<n>=1\n(DEBUG, #1 #<N> #<unset> # 5 #[1])\nM2\n",
        &expect![[r#"message " 2.500000 1.000000 ###### # 5 #[1]""#]],
    );
}

#[test]
fn a_printed_line_has_its_variables_with_their_decimals() {
    check(
        "fanuc-mill",
        "O1\n#100=12.5\n#101=-3\nPOPEN\nDPRNT[X#100[53]*Y#101[44]*T#101[20]]\nDPRNT[#500[33]*#[1+2][20]*#100]\nPCLOS\nM30\n",
        &expect![[r#"
            message "X12.500 Y-3.0000 T-3"
            message "? ? 12.5""#]],
    );
    check("fanuc-mill", "O1\nDPRNT[\nDPRNT[#[1\nDPRNT[#99999999999[\nM30\n", &expect![]);
}

#[test]
fn a_comment_in_a_remark_is_no_message() {
    check(
        "linuxcnc",
        ";(msg,one)\nG0 X1 (msg,two) ; (debug,three)\n(msg,four; five)\nM2\n",
        &expect![[r#"
        message "two"
        move
        message "four; five""#]],
    );
}
