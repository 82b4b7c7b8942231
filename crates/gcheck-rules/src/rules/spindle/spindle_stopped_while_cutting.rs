//! A cut while the spindle is stopped.

use gcheck_controls::{Code, CodeIx, Effect};
use gcheck_engine::{Abstract, At, Domain, Event, Fact, Fault, FeedMode, Role, Spindle, TravelKind, Truth};

use crate::declare::declare_rule;
use crate::facts::broaching::{Shows, Strokes};
use crate::facts::cutting::{is_cut, starts_spindle};
use crate::facts::cycles::cycle_code;
use crate::facts::feed::goes_by_feed;
use crate::facts::live_tool::{Executed, LiveTool};
use crate::facts::probing::{is_measurement, is_near, is_probing_move, touches_work};
use crate::facts::program_calls::calls_other_files;
use crate::facts::tool_words::ToolWords;
use crate::{Finding, FollowedCx, PathCx, PathRule, Report, Run, Severity, Watch, limit};
use crate::{Remembers, remembers};

declare_rule! {
    /// A block cuts while the spindle is stopped: it was never started, or `M5` or a tool change stopped it.
    ///
    /// ## Why it matters
    /// The tool is pushed through the material and breaks. Exceptions are probing, drag knives, scratch engraving and
    /// machines whose spindle is switched by hand. Under feed per turn (`G95`; `G99` on lathes) the axes do not even
    /// move: the program waits forever.
    ///
    /// It is an error where the control refuses the block (a cycle that taps, a thread, feed per turn) and the program itself stopped
    /// the spindle on every path; otherwise it is a warning, or information where the machine may have no spindle.
    ///
    /// ## Reported
    /// ```nc,reported,haas-mill
    /// G0 X1. S1000 M3
    /// G1 X2. F10.
    /// T2 M6
    /// G1 X3.
    /// M30
    /// ```
    /// Under feed per turn the spindle has to turn for every feed move, the retract as well.
    /// ```nc,reported,generic-mill
    /// G21 G90 G95 G0 Z-5. S1000 M3
    /// G1 X20. F0.2
    /// M5
    /// G1 Z50.
    /// M30
    /// ```
    /// ## Not reported
    /// ```nc,quiet,haas-mill
    /// G0 X1. S1000 M3
    /// G1 X2. F10.
    /// M5
    /// G0 Z5.
    /// M30
    /// ```
    /// Feed per minute does not need the spindle.
    /// ```nc,quiet,generic-mill
    /// G21 G90 G95 G0 Z-5. S1000 M3
    /// G1 X20. F0.2
    /// M5
    /// G94 G1 Z50. F500.
    /// M30
    /// ```
    /// A bar puller grips the bar with the spindle stopped, and a chuck that opens lets it out.
    /// ```nc,quiet,fanuc-lathe
    /// G21 G99 T0909 (BAR PULLER)
    /// G97 S500 M3
    /// M5
    /// G0 X0 Z-35.
    /// G98 G1 Z-50. F2000
    /// M69
    /// M30
    /// ```
    /// A feed move straight up is a retract, not a cut.
    /// ```nc,quiet,fanuc-mill
    /// G21 G90 G0 Z-5. S1000 M3
    /// G1 X20. F100.
    /// M5
    /// G1 Z50. F500.
    /// M30
    /// ```
    rule "spindle-stopped-while-cutting" in "spindle" {
        summary: "cut while the spindle is stopped",
        severity: Error,
        tier: Path,
        since: "0.1.0",
        run: Run::Path {
            watch: Watch::BLOCKS
                .union(Watch::MOVES)
                .union(Watch::CUTS)
                .union(Watch::CHANGES)
                .union(Watch::FAULTS)
                .union(Watch::FOLLOWED),
            make: || Box::new(SpindleStoppedWhileCutting::default()),
        },
    }
}

#[derive(Default, Clone, PartialEq)]
struct SpindleStoppedWhileCutting {
    /// What stopped the spindle in each case that was reported; `None` for one that was never started.
    told: Vec<Option<At>>,
    /// Stopped at an angle: for a probe or a boring bar.
    is_oriented: bool,
    executed: Executed,
    /// A stroke along Z, which may be the first of a broach.
    waiting: Option<Waiting>,
}

remembers!(SpindleStoppedWhileCutting: told, executed, waiting);

/// A finding of a stroke along Z, until the next moves show what the tool does.
#[derive(Clone, PartialEq)]
struct Waiting {
    strokes: Strokes,
    finding: Finding,
    /// The program holds the spindle at an angle, or by the C axis.
    is_held: bool,
}

remembers!(Waiting: strokes, finding);

/// A cut while the spindle is stopped.
#[expect(clippy::struct_excessive_bools, reason = "independent facts of the cut and its program")]
struct CutAtRest {
    stopped_by: Option<At>,
    /// The move goes by turns of the spindle.
    needs_turns: bool,
    /// It cuts a thread.
    threads: bool,
    is_ever_started: bool,
    /// The file uses tool lengths, as mills do.
    has_length: bool,
    /// A probe may be in the spindle.
    probes: bool,
    live: LiveTool,
}

impl SpindleStoppedWhileCutting {
    fn works_with_live_tool(&self, cx: &PathCx<'_>) -> bool {
        !cx.is_mill() && has_live_tool(cx, self.executed.live_tool(cx))
    }

    /// Tells what waited for the next moves: they show no broach.
    fn tell(&mut self, report: &mut Report<'_>) {
        if let Some(waiting) = self.waiting.take() {
            report.add(waiting.finding);
        }
    }

    /// What is wrong with a cut, if it needs a spindle that is stopped and was not reported for that stop.
    fn judge(&self, cx: &PathCx<'_>, event: &Event) -> Option<CutAtRest> {
        let stands = cx.state().spindle() == Some(Spindle::Stopped) && cx.state().live_tool() == Truth::False;
        // A program that chose feed per turn needs the spindle for every move.
        let by_turns = cx.state().feed_mode(cx.model) == Some(FeedMode::PerRevolution);
        // Probing has the spindle stopped, but a feed per turn does not move the probe then.
        let measures = is_probing_move(event) && cx.has_effect(is_measurement);
        let needs_turns = by_turns
            && cx.definitions().set_by(Fact::Mode(Role::FeedMode)).is_some()
            && (goes_by_feed(event) || measures)
            && !cx.has_effect(|effect| matches!(effect, Effect::MachineCoordinates | Effect::Skip));
        // A strict control refuses the block, which is reported as a fault.
        let is_refused =
            by_turns && cx.model.semantics().strict && Abstract::known(cx.state().speed()) == Some(0.0);
        let threads = is_thread(cx, event);
        let is_work = needs_turns || threads || is_cut(cx, event);
        if !stands || is_refused || !is_work || cx.is_called_only() {
            return None;
        }
        let stopped_by = cx.definitions().set_by(Fact::Spindle);
        let is_ever_started = cx.file_uses(starts_spindle);
        // Neither start nor speed anywhere: a spindle that is switched by hand, or no spindle: a laser, a knife, a pen. The
        // length of a tool is that of a mill; the strict controls are those of machines that people build themselves, with
        // a switch for the spindle.
        let has_length = !cx.model.semantics().strict && cx.file_uses(|effect| effect == Effect::LengthPlus);
        let has_speed = cx.definitions().set_by(Fact::Speed).is_some();
        if !is_ever_started && !needs_turns && !has_speed && !has_length && !self.works_with_live_tool(cx) {
            return None;
        }
        if self.told.contains(&stopped_by) || !is_ever_started && !self.told.is_empty() {
            return None;
        }
        let probes = !gives_speed_after(cx, touches_work);
        if probes && !(needs_turns && measures) && is_near(cx, touches_work)
            || feeds_bar(cx)
            || !measures && ToolWords::of(cx).needs_no_spindle()
        {
            return None;
        }
        let live = self.executed.live_tool(cx);
        if live == LiveTool::MayTurn {
            return None;
        }
        Some(CutAtRest { stopped_by, needs_turns, threads, is_ever_started, has_length, probes, live })
    }
}

impl CutAtRest {
    fn message(&self, cx: &PathCx<'_>, is_oriented: bool) -> String {
        match (self.stopped_by, self.needs_turns) {
            (Some(at), _) if self.threads => {
                format!("thread cut after the spindle was stopped (`{}`)", stop_code(cx, at))
            }
            (None, _) if self.threads => "thread cut, and the spindle was not started (no `M3`)".to_owned(),
            (Some(at), false) if is_oriented => {
                format!("cut with the spindle held at an angle (`{}`)", stop_code(cx, at))
            }
            (Some(at), false) if stop_effect(cx, at) == Some(Effect::ToolChange) => format!(
                "no `{}` since the tool change (`{}` stopped the spindle)",
                cx.name_of_effect(Effect::SpindleClockwise).unwrap_or_else(|| "M3".to_owned()),
                stop_code(cx, at)
            ),
            (Some(_), false) if has_live_tool(cx, self.live) => {
                let name = cx.name_of_effect(Effect::LiveToolOn).unwrap_or_default();
                format!("cut, and the live tool does not turn (no `{name}`)")
            }
            (Some(at), false) => format!("cut after the spindle was stopped (`{}`)", stop_code(cx, at)),
            (None, false) if self.live == LiveTool::Stands => match cx.name_of_effect(Effect::LiveToolOn) {
                Some(name) => format!("cut, and the live tool was not started (no `{name}`)"),
                None => "cut, and neither the spindle nor a live tool was started".to_owned(),
            },
            (None, false) => "cut, and the spindle was not started (no `M3`)".to_owned(),
            (Some(at), true) if self.live == LiveTool::Stands => {
                format!("feed per turn of the main spindle, which was stopped (`{}`)", stop_code(cx, at))
            }
            (Some(at), true) => {
                format!("feed per turn of a spindle that was stopped (`{}`)", stop_code(cx, at))
            }
            (None, true) => "feed per turn of a spindle that was not started (no `M3`)".to_owned(),
        }
    }

    /// May the machine have no spindle, or the tool work without one?
    fn may_be_meant(&self, cx: &PathCx<'_>, is_oriented: bool) -> bool {
        // A speed, or the power of a laser, that nothing switches on is forgotten; a number for an M code of the shop is not.
        let is_for_code = |at| cx.find_word(at, |word| word.letter.ascii() == b'M').is_some();
        let has_speed = cx.definitions().set_by(Fact::Speed).is_some_and(|at| !is_for_code(at));
        let is_mill = self.is_ever_started
            || self.has_length
            || has_speed
            || has_live_tool(cx, self.live)
            || cx.file_uses(|effect| effect == Effect::ToolChange);
        // Held at an angle, a tool may broach.
        // What starts the spindle may be in a program of another file.
        let is_elsewhere = !self.is_ever_started && calls_other_files(cx.file_index);
        !is_mill && !self.needs_turns
            || is_oriented
            || is_elsewhere
            || self.probes && cx.file_uses(touches_work)
    }
}

impl PathRule for SpindleStoppedWhileCutting {
    fn memory(&mut self) -> Remembers<'_> {
        Remembers::All(self)
    }

    fn block(&mut self, cx: &PathCx<'_>, report: &mut Report<'_>) {
        self.executed.block(cx);
        let semantics = cx.model.semantics();
        if !semantics.strict || !semantics.cycles.tap_needs_spindle || !cx.has_effect(needs_turning_spindle) {
            return;
        }
        let stands = cx.state().spindle() == Some(Spindle::Stopped);
        let stopped_by = cx.definitions().set_by(Fact::Spindle);
        if !stands || cx.has_effect(starts_spindle) || cx.is_called_only() || self.told.contains(&stopped_by)
        {
            return;
        }
        // The cycle stops the spindle once more.
        self.told.extend([stopped_by, Some(cx.origin().at)]);
        let codes = cx.codes();
        let code = codes.iter().find(|ix| needs_turning_spindle(cx.model.effect(**ix)));
        let Some(code) = code.and_then(|ix| cx.code_of(*ix)) else { return };
        let (name, entry) = (code.number(), code.entry());
        let finding = cx
            .finding(
                &META,
                cx.effect_range(needs_turning_spindle),
                format!("cycle while the spindle is stopped (`{name}`)"),
            )
            .label("the control refuses the cycle")
            .note(format!("`{name}` ({}) needs a spindle that turns  [{}]", entry.title, entry.source))
            .help("start the spindle with `S` and `M3` or `M4` before this block");
        report.add(refused(cx, since(cx, finding, stopped_by)));
    }

    fn moved(&mut self, _: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(waiting) = &mut self.waiting else { return };
        match waiting.strokes.moved(event) {
            Shows::Nothing => {}
            Shows::Broaching => {
                let is_held = waiting.is_held;
                if let Some(waiting) = self.waiting.take().filter(|_| !is_held) {
                    report.add(waiting.finding.note(BROACHING).at_most(Severity::Info));
                }
            }
            Shows::Other => self.tell(report),
        }
    }

    fn followed(&mut self, _: &FollowedCx<'_>, report: &mut Report<'_>) {
        self.tell(report);
    }

    fn changed(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        self.executed.changed(cx, event);
        if matches!(event, Event::Spindle(_) | Event::ToolChange(_)) {
            self.tell(report);
        }
        match event {
            // A boring cycle orients the spindle on its way, and cuts with it as it was before.
            Event::OrientSpindle { .. } => self.is_oriented = !cycle_code(cx).is_some_and(bores),
            // A new bar is taken at an angle, and after that the spindle has to turn again.
            Event::Spindle(_) | Event::BarPush(_) => self.is_oriented = false,
            _ => {}
        }
    }

    fn cut(&mut self, cx: &PathCx<'_>, event: &Event, report: &mut Report<'_>) {
        let Some(cut) = self.judge(cx, event) else { return };
        let CutAtRest { stopped_by, needs_turns, is_ever_started, live, .. } = cut;
        self.told.push(stopped_by);
        // A boring cycle stops the spindle once more, at the bottom of its hole.
        if cycle_code(cx).is_some() {
            self.told.push(Some(cx.origin().at));
        }
        // `T1 M6 M3` in one block: the machine builder decides which comes first.
        let is_started_with_change =
            stopped_by.and_then(|at| cx.find_word(at, |word| starts_spindle(cx.model.effect(word.code))));
        if is_started_with_change.is_some() {
            return;
        }
        let mut finding = cx
            .finding(&META, cx.range(), cut.message(cx, self.is_oriented))
            .label(match (needs_turns || cut.threads, is_ever_started) {
                (true, _) => "the axes wait for the spindle, which does not turn",
                (false, _) if live == LiveTool::Stands => {
                    "neither the main spindle nor a live tool turns here"
                }
                (false, true) => "the spindle does not turn here",
                (false, false) => "the program never starts the spindle",
            })
            .help(help(cx, live, needs_turns))
            .at_most(Severity::Warning);
        if cut.may_be_meant(cx, self.is_oriented) {
            finding = finding.at_most(Severity::Info);
        }
        if needs_turns && let Some(name) = cx.code_name(Role::FeedMode) {
            finding = cx.resting_on(finding, Fact::Mode(Role::FeedMode), &format!("`{name}`"));
        }
        let finding = since(cx, finding, stopped_by);
        let may_broach = !needs_turns && !cut.threads && !ToolWords::of(cx).turns_to_cut();
        match Strokes::begin(event).filter(|_| may_broach) {
            Some(strokes) => {
                self.tell(report);
                let is_held = self.is_oriented || live == LiveTool::Stands;
                self.waiting = Some(Waiting { strokes, finding, is_held });
            }
            None => report.add(finding),
        }
    }

    fn fault(&mut self, cx: &PathCx<'_>, fault: &Fault, report: &mut Report<'_>) {
        if *fault != Fault::SpindleStopped {
            return;
        }
        // The cut of the block, as if it were corrected, comes after.
        let stopped_by = cx.definitions().set_by(Fact::Spindle);
        self.told.push(stopped_by);
        let by = stopped_by.map(|at| format!(" (`{}`)", stop_code(cx, at))).unwrap_or_default();
        let finding = cx
            .finding(&META, cx.range(), format!("feed per turn while the spindle is stopped{by}"))
            .label("waits for the spindle, which does not turn")
            .note("this control refuses the block")
            .help("start the spindle with `S` and `M3` or `M4` before this block");
        report.add(refused(cx, since(cx, finding, stopped_by)));
    }
}

/// Does the C axis hold the part of a lathe whose control has a code that starts live tools? Then only such a tool cuts.
fn has_live_tool(cx: &PathCx<'_>, live: LiveTool) -> bool {
    live == LiveTool::Stands && !cx.is_mill() && cx.control_has(|effect| effect == Effect::LiveToolOn)
}

/// Does a pass of a thread wait for the angle of the spindle? Taps that a cycle drives start and stop it themselves.
fn is_thread(cx: &PathCx<'_>, event: &Event) -> bool {
    let Event::Travel(travel) = event else { return false };
    let is_pass = Effect::cuts_thread;
    let by_mode = || cx.state().effect(Role::Motion, cx.model).is_some_and(is_pass);
    travel.kind == TravelKind::Thread && (cx.has_effect(is_pass) || by_mode())
}

/// Did the tool in the spindle touch the work, and was a speed given after that, which is for what is cut next?
fn gives_speed_after(cx: &PathCx<'_>, touches: impl Fn(Effect) -> bool) -> bool {
    let here = cx.origin().at;
    let given = cx.definitions().set_by(Fact::Speed).filter(|at| at.file == here.file);
    let Some(given) = given.filter(|at| here.block.checked_sub(at.block).is_some_and(|blocks| blocks <= FEW))
    else {
        return false;
    };
    let has = |block: u32| {
        let place = cx.place_of(At { block, ..here });
        place.is_some_and(|place| {
            place.table.words(place.block()).iter().any(|word| touches(cx.model.effect(word.code)))
        })
    };
    let changed = cx.definitions().set_by(Fact::Tool).filter(|at| at.file == here.file);
    let first = changed.map_or(0, |at| at.block).max(given.block.saturating_sub(FEW));
    (first..given.block).any(has) && !(given.block..=here.block.saturating_add(SOON)).any(has)
}

fn help(cx: &PathCx<'_>, live: LiveTool, needs_turns: bool) -> String {
    if live != LiveTool::Stands {
        return "start the spindle with `S` and `M3` or `M4`; probing, engraving and drag knives are exceptions to suppress"
            .to_owned();
    }
    let start = match cx.name_of_effect(Effect::LiveToolOn) {
        Some(name) => format!("start the live tool with `{name}` and its speed"),
        None => "start the live tool with the code of the machine builder and its speed".to_owned(),
    };
    let mode = if needs_turns { ", and feed per minute" } else { "" };
    format!("{start}{mode}; the spindle holds the part as the C axis, so `M3` does not help")
}

/// Of strokes to one depth that go a little further across each time.
const BROACHING: &str =
    "the tool goes along Z again and again, a little further across each time, as a broach does";

/// Blocks between a touch and a speed, and between a speed and the cut that it is for.
const FEW: u32 = 50;
/// Blocks after a move in which a touch shows that it was the way there.
const SOON: u32 = 3;
/// Blocks beside the move in which a chuck that opens or closes shows that bar is fed.
const BESIDE: u32 = 4;

/// Does a chuck or collet open or close beside the block, with no tool change and no start of the spindle between them?
fn feeds_bar(cx: &PathCx<'_>) -> bool {
    let here = cx.origin().at;
    let shows = |block: u32| {
        let place = cx.place_of(At { block, ..here })?;
        let words = place.table.words(place.block());
        let effects = words.iter().map(|word| cx.model.effect(word.code));
        if effects.clone().any(|effect| matches!(effect, Effect::ChuckClamp | Effect::ChuckUnclamp)) {
            return Some(true);
        }
        let by_t = cx.model.semantics().tools.change_by_t;
        let parts = effects.clone().any(starts_spindle)
            || by_t && words.iter().any(|word| word.letter.ascii() == b'T');
        parts.then_some(false)
    };
    let first = here.block.saturating_sub(BESIDE);
    let before = (first..=here.block).rev().find_map(shows);
    let after = (here.block + 1..=here.block.saturating_add(BESIDE)).find_map(shows);
    !cx.is_mill() && (before == Some(true) || after == Some(true))
}

/// The control refuses the block: an error where the program itself stopped the spindle, on every path.
fn refused(cx: &PathCx<'_>, finding: Finding) -> Finding {
    let is_sure = cx.definitions().set_by(Fact::Spindle).is_some() && cx.is_on_every_path();
    finding.at_most(if is_sure { limit(cx.model.semantics().confidence) } else { Severity::Warning })
}

/// Adds the place where the spindle was stopped.
fn since(cx: &PathCx<'_>, finding: Finding, stopped_by: Option<At>) -> Finding {
    let Some(at) = stopped_by else {
        return finding.assuming("the spindle is stopped when the program starts");
    };
    let range = cx.find_word(at, |word| stops(cx.model.effect(word.code))).or_else(|| cx.range_of(at));
    match range {
        Some(range) if cx.is_mill() => finding.also(range, "stopped here"),
        Some(range) => finding.also(range, "the main spindle is stopped here"),
        None => finding,
    }
}

fn stops(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::SpindleStop
            | Effect::ToolChange
            | Effect::SpindleOrient
            | Effect::BarFeed
            | Effect::Stop
            | Effect::OptionalStop
            | Effect::ThroughCoolantOff
    )
}

/// The code that stopped the spindle, as programs write it.
fn stop_code(cx: &PathCx<'_>, at: At) -> String {
    stopping(cx, at).map_or_else(|| "M5".to_owned(), |code| cx.name_of(code))
}

fn stop_effect(cx: &PathCx<'_>, at: At) -> Option<Effect> {
    stopping(cx, at).map(|code| cx.model.effect(code))
}

/// The code of a block that stops the spindle.
fn stopping(cx: &PathCx<'_>, at: At) -> Option<CodeIx> {
    let place = cx.place_of(at)?;
    let mut words = place.table.words(place.block()).iter();
    words.find(|word| stops(cx.model.effect(word.code))).map(|word| word.code)
}

/// Is it a cycle that stops the spindle at an angle to bring the tool off the wall?
fn bores(code: Code<'_>) -> bool {
    code.effect().shifts_boring_bar()
}

/// Is it a cycle that a strict control begins only while the spindle turns?
fn needs_turning_spindle(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::CycleTap
            | Effect::CycleLeftTap
            | Effect::CycleBoreStop
            | Effect::CycleBackBore
            | Effect::CycleBoreManual
            | Effect::CycleBoreDwellManual
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::RULE;
    use crate::testing::{World, check_rule, findings, only, words};

    #[test]
    fn a_live_tool_that_no_block_starts() {
        let drilled = |start: &str, cycle: &str| {
            format!("G20 G98 T808\nM154\nG54 G0 X2. Z0.5 C0.\n{start}{cycle}\nC120.\nG80\nM155\nM30\n")
        };
        let cycle = "G83 X2. Z-0.75 R0.1 Q0.2 F8.";
        check_rule(
            &RULE,
            "haas-lathe",
            &drilled("", cycle),
            &expect![[r#"
                4 | G83 X2. Z-0.75 R0.1 Q0.2 F8.
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[spindle-stopped-while-cutting] cut, and the live tool was not started (no `M133`)
            "#]],
        );
        for start in ["M133 P2000\n", "P2000 M133\n", "M134 P1500\n"] {
            check_rule(&RULE, "haas-lathe", &drilled(start, cycle), &expect![[""]]);
        }
        // A cycle that taps turns the live tool itself.
        check_rule(&RULE, "haas-lathe", &drilled("G99\n", "G95 Z-0.5 R0.1 F0.05 S500"), &expect![[""]]);
        // The C axis holds the part for a tool that does not turn.
        let broached = drilled("", "G1 Z-0.5 F20.").replace("T808", "T808 (KEYWAY BROACH)");
        check_rule(&RULE, "haas-lathe", &broached, &expect![[""]]);
        let milled = "G20 G98 T909\nM154\nG54 G0 X3. Z0.2 C0.\nG17 G112\nG0 X1.5 Y0.\nZ0.1\nG1 Z-0.25 F20.\nX0.6 F10.\nG113\nG18\nM155\nM30\n";
        check_rule(
            &RULE,
            "haas-lathe",
            milled,
            &expect![[r#"
                7 | G1 Z-0.25 F20.
                  | ^^^^^^^^^^^^^^ warning[spindle-stopped-while-cutting] cut, and the live tool was not started (no `M133`)
            "#]],
        );
    }

    #[test]
    fn a_power_that_nothing_switches_on() {
        let program = |power: &str| format!("G21 G90 G94 G17\nG0 X0 Y0\n{power}\nG1 X10 F500\nX20\nM2\n");
        check_rule(
            &RULE,
            "grbl",
            &program("S800"),
            &expect![[r#"
            4 | G1 X10 F500
              | ^^^^^^^^^^^ warning[spindle-stopped-while-cutting] cut, and the spindle was not started (no `M3`)
        "#]],
        );
        check_rule(
            &RULE,
            "grbl",
            &program("M300 S30"),
            &expect![[r#"
            4 | G1 X10 F500
              | ^^^^^^^^^^^ info[spindle-stopped-while-cutting] cut, and the spindle was not started (no `M3`)
        "#]],
        );
    }

    #[test]
    fn a_called_file_may_start_the_spindle() {
        let program =
            |call: &str| format!("G21 G90 T5 M6\nG54 G1 X0. Y0. F5000.\nG43 Z5. H5\n{call}\nM30\nO77\nM99\n");
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("M98 P78"),
            &expect![[r#"
            2 | G54 G1 X0. Y0. F5000.
              | ^^^^^^^^^^^^^^^^^^^^^ info[spindle-stopped-while-cutting] no `M3` since the tool change (`M6` stopped the spindle)
        "#]],
        );
        check_rule(
            &RULE,
            "fanuc-mill",
            &program("M98 P77"),
            &expect![[r#"
            2 | G54 G1 X0. Y0. F5000.
              | ^^^^^^^^^^^^^^^^^^^^^ warning[spindle-stopped-while-cutting] no `M3` since the tool change (`M6` stopped the spindle)
        "#]],
        );
    }

    #[test]
    fn a_boring_cycle_that_stops_the_spindle_needs_one_that_turns() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G90 G0 X0 Y0 Z5\nG86 X1 Z-1 R1 P1 F100\nX2\nG80\nS900 M3\nG86 X1 Z-1 R1 P1\nG80\nM2\n",
            &expect![[r#"
                2 | G86 X1 Z-1 R1 P1 F100
                  | ^^^ warning[spindle-stopped-while-cutting] cycle while the spindle is stopped (`G86`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0. Y0. Z1.\nG86 X1. Z-1. R1. F9.\nG80\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn moves_around_a_touch_cut_nothing() {
        check_rule(
            &RULE,
            "haas-mill",
            "T20 M6\nG1 X1. Z-.3 F50.\nG91 G31 Y-1. F8. M75\nG1 Y.2 F50.\nG136 Y1. F8.\nM5\nG1 Y-.2\nT1 M6\nS3000 M3\n\
             G1 X1. F10.\nG90\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_touch_with_another_tool_is_no_excuse() {
        check_rule(
            &RULE,
            "haas-mill",
            "S1000 M3\nG1 X1. F10.\nT20 M6\nG31 Y1. F8.\nT2 M6\nG1 X2. F10.\nM30\n",
            &expect![[r#"
                6 | G1 X2. F10.
                  | ^^^^^^^^^^^ info[spindle-stopped-while-cutting] no `M3` since the tool change (`M6` stopped the spindle)
            "#]],
        );
    }

    #[test]
    fn the_first_cut_of_each_stop_is_marked() {
        check_rule(
            &RULE,
            "haas-mill",
            "G0 X1. S1000 M3\nG1 X2. F10.\nM5\nG1 X3.\nM8\nX4.\nT2 M6\nG1 X5.\nM30\n",
            &expect![[r#"
                4 | G1 X3.
                  | ^^^^^^ warning[spindle-stopped-while-cutting] cut after the spindle was stopped (`M5`)
                8 | G1 X5.
                  | ^^^^^^ warning[spindle-stopped-while-cutting] no `M3` since the tool change (`M6` stopped the spindle)
            "#]],
        );
    }

    /// A bar job ends by starting again, and its bar feed stops the spindle, at an angle for a new bar or not.
    #[test]
    fn a_bar_feed_stops_the_spindle() {
        check_rule(
            &RULE,
            "haas-lathe",
            "T101\nG97 S900 M3\nG1 X1. F.01\nG0 X3.\nG105 J1.75 R90.\nG1 X0.\nM99\n",
            &expect![[r#"
                6 | G1 X0.
                  | ^^^^^^ warning[spindle-stopped-while-cutting] cut after the spindle was stopped (`G105`)
            "#]],
        );
    }

    #[test]
    fn a_program_that_knows_no_spindle_says_nothing() {
        check_rule(&RULE, "haas-mill", "G1 X2. F10.\nM0\nX3.\nM30\n", &expect![""]);
    }

    #[test]
    fn a_speed_that_nothing_starts_is_a_likely_slip() {
        check_rule(
            &RULE,
            "haas-mill",
            "T1 M6\nS1000\nG1 X2. F10.\nM30\n",
            &expect![[r#"
                3 | G1 X2. F10.
                  | ^^^^^^^^^^^ warning[spindle-stopped-while-cutting] no `M3` since the tool change (`M6` stopped the spindle)
            "#]],
        );
    }

    #[test]
    fn a_spindle_that_is_held_at_an_angle_may_broach() {
        check_rule(
            &RULE,
            "haas-mill",
            "S100 M3\nG1 X1. F5.\nM19\nG1 X2.\nM30\n",
            &expect![[r#"
                4 | G1 X2.
                  | ^^^^^^ info[spindle-stopped-while-cutting] cut with the spindle held at an angle (`M19`)
            "#]],
        );
    }

    #[test]
    fn a_back_bore_cuts_on_its_way_up() {
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0. Y0. Z.1 S900 M3\nM5\nG77 Z-.5 R-1.6 Q.1 F10.\nG80\nM30\n",
            &expect![[r#"
                3 | G77 Z-.5 R-1.6 Q.1 F10.
                  | ^^^^^^^^^^^^^^^^^^^^^^^ warning[spindle-stopped-while-cutting] cut after the spindle was stopped (`M5`)
            "#]],
        );
        check_rule(
            &RULE,
            "haas-mill",
            "G20 G90 G0 X0. Y0. Z.1 S900 M3\nG77 Z-.5 R-1.6 Q.1 F10.\nX1.\nG80\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_subprogram_is_called_with_the_spindle_on() {
        check_rule(&RULE, "haas-mill", "O100\nG1 X2. F10.\nM99\n", &expect![[""]]);
        check_rule(&RULE, "haas-mill", "S100 M3\nM97 P10\nM30\nN10 G1 X2. F10.\nM99\n", &expect![[""]]);
    }

    #[test]
    fn a_start_in_the_block_of_the_tool_change_counts() {
        check_rule(&RULE, "haas-mill", "T1 M6 S1000 M3\nG1 X1. F5.\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_live_tool_turns() {
        check_rule(&RULE, "haas-lathe", "T101\nP1000 M133\nG1 X2. F.01\nM135\nM30\n", &expect![[""]]);
    }

    #[test]
    fn a_live_tool_is_started_by_its_own_code() {
        let program = "G21 G98 T0303\nG97 S900 M3\nG1 X20. F99.\nM5\nM154\nG0 C90.\nG1 X10. F60.\nM30\n";
        let found = findings(&only(&RULE), "haas-lathe", program, &World::default());
        expect![[r#"
            cut, and the live tool does not turn (no `M133`)
              here: neither the main spindle nor a live tool turns here
              there: the main spindle is stopped here
              help: start the live tool with `M133` and its speed; the spindle holds the part as the C axis, so `M3` does not help
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
        let found = findings(&only(&RULE), "fanuc-lathe", &program.replace("M154\n", ""), &World::default());
        expect![[r#"
            cut after the spindle was stopped (`M5`)
              here: neither the main spindle nor a live tool turns here
              there: the main spindle is stopped here
              help: start the live tool with the code of the machine builder and its speed; the spindle holds the part as the C axis, so `M3` does not help
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
        // A function of the machine builder with a speed.
        check_rule(&RULE, "fanuc-lathe", &program.replace("M154", "M33 S1500"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G98 T0303\nG97 S900\nM33 S1500\nG0 X20. C0\nG1 X10. F60.\nM30\n",
            &expect![[""]],
        );
    }

    #[test]
    fn a_tool_that_broaches_under_another_name() {
        let stroke = |x: &str| format!("G0 X{x}\nG1 Z-20. F2500.\nG0 X9.\nZ3.\n");
        let keyway = |hold: &str, strokes: &str| {
            format!(
                "G21 G98 T0303\nG97 S900 M3\nG0 X20. Z2.\nG1 Z-5. F99.\nG0 X50.\nT0909 (SLOT BAR 6)\n{hold}\nG0 X9. Z3.\n{strokes}M30\n"
            )
        };
        let strokes = format!("{}{}{}{}", stroke("20."), stroke("20.2"), stroke("20.4"), stroke("20.4"));
        for hold in ["M19", "M5\nM19 R90.", "M5\nM154\nG0 C0."] {
            check_rule(&RULE, "haas-lathe", &keyway(hold, &strokes), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "haas-lathe",
            &keyway("M5", &strokes),
            &expect![[r#"
                10 | G1 Z-20. F2500.
                   | ^^^^^^^^^^^^^^^ info[spindle-stopped-while-cutting] cut after the spindle was stopped (`M5`)
            "#]],
        );
        // What turns to cut plunges so, and does not broach.
        let plunged = keyway("M5\nM154\nG0 C0.", &strokes).replace("SLOT BAR 6", "LIVE END MILL 6");
        let found = findings(&only(&RULE), "haas-lathe", &plunged, &World::default());
        assert!(found.iter().any(|finding| finding.severity == crate::Severity::Warning), "{found:#?}");
        // In a loop, and fed in with increments.
        let looped =
            "#1=20.\nWHILE [#1 LT 23.] DO1\nG0 X#1\nG1 Z-20. F2500.\nG1 U-1.\nG0 Z3.\n#1=#1+.2\nEND1\n";
        check_rule(&RULE, "haas-lathe", &keyway("M19", looped), &expect![[""]]);
        check_rule(&RULE, "fanuc-lathe", &keyway("M19", looped), &expect![[""]]);
        let mill = "G21 G90 G54 T5 M6 (SHAPER)\nS900 M3\nG1 X1. F9.\nT6 M6 (HSS BLANK)\nG43 H6 Z5.\nM19\nG0 X10. Y0.\nG1 Z-20. F3000.\nG0 Y-1.\nZ5.\nY.1\nG1 Z-20.\nG0 Y-1.\nZ5.\nY.2\nG1 Z-20.\nG0 Z50.\nM30\n";
        check_rule(&RULE, "haas-mill", mill, &expect![[""]]);
    }

    /// Holes around a part, far apart or at several angles, a hole in pecks, and one stroke alone do not broach.
    #[test]
    fn strokes_that_drill() {
        let holes = |moves: &str| {
            format!(
                "G21 G98 T0303\nG97 S900 M3\nG0 X20. Z2.\nG1 Z-5. F99.\nG0 X50.\nM5\nM154\nT0909\nG0 X30. Z3. C0.\n{moves}M30\n"
            )
        };
        for moves in [
            "G1 Z-20. F250.\nG0 Z3.\nC120.\nG1 Z-20.\nG0 Z3.\nC240.\nG1 Z-20.\nG0 Z3.\n",
            "G1 Z-20. F250.\nG0 Z3.\nX36.\nG1 Z-20.\nG0 Z3.\nX42.\nG1 Z-20.\nG0 Z3.\n",
            "G1 Z-5. F250.\nG0 Z3.\nG1 Z-10.\nG0 Z3.\nG1 Z-15.\nG0 Z3.\n",
            "G1 Z-20. F250.\nG0 Z3.\n",
            "G1 Z-2. F250.\nX20.\nG0 Z3.\n",
        ] {
            let found = findings(&only(&RULE), "haas-lathe", &holes(moves), &World::default());
            let [finding] = found.as_slice() else { panic!("{moves}: {found:#?}") };
            assert_eq!(finding.message, "cut, and the live tool does not turn (no `M133`)", "{moves}");
        }
    }

    #[test]
    fn a_called_program_may_start_the_live_tool() {
        let program = |started: &str| {
            format!(
                "O1\nG21 G98 T0303\nG97 S900\nM98 P200\nG0 X20. Z2.\nG1 X10. F60.\nM30\nO200\n{started}M99\n"
            )
        };
        check_rule(&RULE, "fanuc-lathe", &program("M45\nM33 S1500\n"), &expect![[""]]);
        check_rule(
            &RULE,
            "haas-lathe",
            &program("M154\nG0 C0.\n"),
            &expect![[r#"
                6 | G1 X10. F60.
                  | ^^^^^^^^^^^^ warning[spindle-stopped-while-cutting] cut, and the live tool was not started (no `M133`)
            "#]],
        );
        check_rule(&RULE, "haas-lathe", &program("M154\nP1500 M133\nG0 C0.\n"), &expect![[""]]);
    }

    #[test]
    fn tools_that_need_no_spindle() {
        for comment in ["DRAG KNIFE", "BROACH 6MM", "ENGRAVER, SPINDLE OFF", "PROBE"] {
            let program = format!("S900 M3\nG1 X1. F9.\nT5 M6 ({comment})\nG1 X2.\nM30\n");
            check_rule(&RULE, "haas-mill", &program, &expect![[""]]);
        }
        check_rule(
            &RULE,
            "haas-mill",
            "S900 M3\nG1 X1. F9.\nT5 M6 (1/2 END MILL)\nG1 X2.\nM30\n",
            &expect![[r#"
                4 | G1 X2.
                  | ^^^^^^ warning[spindle-stopped-while-cutting] no `M3` since the tool change (`M6` stopped the spindle)
            "#]],
        );
    }

    #[test]
    fn a_bar_is_fed_with_the_chuck_open() {
        let program = |code: &str| {
            format!(
                "G21 G99 T0101\nG97 S900 M3\nG1 X20. F.2\nM5\nG0 X0 Z2.\n{code}\nG98 G1 Z-50. F2000.\nM30\n"
            )
        };
        check_rule(&RULE, "fanuc-lathe", &program("M69"), &expect![[""]]);
        check_rule(&RULE, "haas-lathe", &program("M11"), &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            &program("M8"),
            &expect![[r#"
            7 | G98 G1 Z-50. F2000.
              | ^^^^^^^^^^^^^^^^^^^ warning[spindle-stopped-while-cutting] cut after the spindle was stopped (`M5`)
        "#]],
        );
    }

    #[test]
    fn a_thread_waits_for_the_spindle() {
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G0 X0 Z5\nG33 Z-10 K1\nM2\n",
            &expect![[r#"
                2 | G33 Z-10 K1
                  | ^^^^^^^^^^^ warning[spindle-stopped-while-cutting] feed per turn while the spindle is stopped
            "#]],
        );
    }

    #[test]
    fn a_feed_by_turns_needs_them_for_every_move() {
        check_rule(
            &RULE,
            "generic-mill",
            "G21 G90 G95 G0 X0. Z5.\nG1 Z-1. F0.1\nS900 M3\nG1 X5.\nM5\nG1 Z5.\nG94 G1 Z9. F99.\nM30\n",
            &expect![[r#"
                2 | G1 Z-1. F0.1
                  | ^^^^^^^^^^^^ warning[spindle-stopped-while-cutting] feed per turn of a spindle that was not started (no `M3`)
                6 | G1 Z5.
                  | ^^^^^^ warning[spindle-stopped-while-cutting] feed per turn of a spindle that was stopped (`M5`)
            "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G95\nG1 X1 F0.1\nM2\n",
            &expect![[r#"
                2 | G1 X1 F0.1
                  | ^^^^^^^^^^ warning[spindle-stopped-while-cutting] feed per turn while the spindle is stopped
            "#]],
        );
        check_rule(
            &RULE,
            "linuxcnc",
            "G21 G95 S900\nG1 X1 F0.1\nM2\n",
            &expect![[r#"
                2 | G1 X1 F0.1
                  | ^^^^^^^^^^ warning[spindle-stopped-while-cutting] feed per turn of a spindle that was not started (no `M3`)
            "#]],
        );
    }

    #[test]
    fn a_lathe_at_power_on_feeds_by_turns_but_may_be_left_so() {
        check_rule(&RULE, "fanuc-lathe", "G21 G0 X5.\nG1 Z5. F0.1\nM30\n", &expect![[""]]);
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G99 S900 M3\nG1 X5. F0.1\nM5\nG1 Z5.\nM30\n",
            &expect![[r#"
                4 | G1 Z5.
                  | ^^^^^^ warning[spindle-stopped-while-cutting] feed per turn of a spindle that was stopped (`M5`)
            "#]],
        );
    }

    #[test]
    fn a_thread_needs_the_spindle() {
        for (control, pass) in [
            ("fanuc-lathe", "G32 Z-20. F1.5"),
            ("fanuc-lathe", "G92 X19. Z-20. F1.5"),
            ("fanuc-lathe", "G76 P010060 Q80 R0.03\nG76 X18.16 Z-20. P920 Q250 F1.5"),
            ("haas-lathe", "G76 X18.16 Z-20. K.92 D.25 F1.5"),
        ] {
            let program = |stop: &str| {
                format!("G21 G99 T0101\nG97 S500 M3\nG0 X24. Z5.\n{stop}{pass}\nG0 X100.\nM30\n")
            };
            assert_eq!(
                findings(&only(&RULE), control, &program("M5\n"), &World::default()).len(),
                1,
                "{pass}"
            );
            check_rule(&RULE, control, &program(""), &expect![[""]]);
        }
        check_rule(
            &RULE,
            "fanuc-lathe",
            "G21 G99 T0101\nG97 S500 M3\nG0 X24. Z5.\nM5\nG92 X19. Z-20. F1.5\nX18.5\nM30\n",
            &expect![[r#"
                5 | G92 X19. Z-20. F1.5
                  | ^^^^^^^^^^^^^^^^^^^ warning[spindle-stopped-while-cutting] thread cut after the spindle was stopped (`M5`)
            "#]],
        );
    }

    #[test]
    fn what_it_says() {
        let found =
            findings(&only(&RULE), "haas-mill", "S1000 M3\nG1 X1. F5.\nM5\nG1 X2.\nM30\n", &World::default());
        expect![[r#"
            cut after the spindle was stopped (`M5`)
              here: the spindle does not turn here
              there: stopped here
              help: start the spindle with `S` and `M3` or `M4`; probing, engraving and drag knives are exceptions to suppress
        "#]].assert_eq(&found.iter().map(words).collect::<String>());
    }

    #[test]
    fn a_probe_waits_for_the_spindle_under_feed_per_turn() {
        let program = |before: &str| {
            format!(
                "G20 G17 G90 G94\nT1 M06\nG00 G54 X0. Y1.\nG91 G31 Y-1. F10. M75\nG00 Y-3.\n{before}\nG136 Y1. F0.01\nG94 G90\nM30\n"
            )
        };
        let found =
            |before: &str| findings(&only(&RULE), "haas-mill", &program(before), &World::default()).len();
        assert_eq!([found("M05\nG95"), found("M05\nG94")], [1, 0]);
    }
}
