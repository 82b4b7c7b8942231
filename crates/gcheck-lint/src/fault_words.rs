//! What a fault is called, why the control refuses the block, and what to do.
//!
//! Knows: the wording of every fault. Must not know: how it is printed.

use gcheck_controls::{Code, CodeIx, Letter, LetterSet, Motion};
use gcheck_engine::{
    ArcFault, CompensationFault, Concrete, ConcreteValue, CornerFault, CycleFault, Fault, Model, Origin,
    Program, Role, State, Units, ValueFault,
};
use gcheck_program::{Op, Place, Value, Word};

/// A fault in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Words {
    /// What is wrong, in one sentence without an end.
    pub message: String,
    /// Why the control stops there.
    pub why: Option<String>,
    /// What to do.
    pub help: Option<String>,
}

impl Words {
    fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), why: None, help: None }
    }

    fn why(mut self, why: impl Into<String>) -> Self {
        self.why = Some(why.into());
        self
    }

    fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// A fault of a block that is executed in a state, in words; lengths are shown in `units` where the state does not tell those of
/// the program.
pub fn at_block(
    fault: &Fault,
    program: &Program<'_>,
    model: &Model<'_>,
    origin: Origin,
    state: &State<Concrete>,
    units: Units,
) -> Words {
    let place = || place(program, origin);
    match fault {
        Fault::Alarm(number) => {
            let file = program.file(origin.at.file);
            let comment = file.zip(place()).and_then(|(file, place)| {
                // A comment after a statement is not part of the block's own range.
                first_comment(file.loaded.line_from(place.range().start))
            });
            alarm(*number, comment.as_deref())
        }
        Fault::Undecidable => {
            undecidable(&place().map(|place| unknown_variables(&place, model, state)).unwrap_or_default())
        }
        _ => {
            let units = state.units(model).unwrap_or(units);
            let place = place();
            let block = place.as_ref().map(|place| Written::of(place, model)).unwrap_or_default();
            words(fault, model, &block, units)
        }
    }
}

fn place(program: &Program<'_>, origin: Origin) -> Option<Place> {
    program.file(origin.at.file)?.loaded.place(origin.at.block, program.dialect())
}

/// What the first comment of a line says.
fn first_comment(line: &str) -> Option<String> {
    let (_, rest) = line.split_once('(')?;
    let comment = rest.split(')').next()?.trim();
    (!comment.is_empty()).then(|| comment.to_owned())
}

/// Variables of a block that have no known value; those of the call at hand only where there are no others.
fn unknown_variables(place: &Place, model: &Model<'_>, state: &State<Concrete>) -> Vec<u32> {
    let table = &place.table;
    let of_words = table.words(place.block()).iter().filter_map(|word| match word.value {
        Value::Expr(expr) => Some(expr),
        _ => None,
    });
    let of_statements = table.statements(place.ix).flat_map(|statement| statement.kind.expressions());
    let mut read: Vec<u32> = of_words
        .chain(of_statements)
        .flat_map(|expr| table.ops(table.expr(expr)))
        .filter_map(|op| match op {
            Op::Variable(number) => Some(*number),
            _ => None,
        })
        .collect();
    read.sort_unstable();
    read.dedup();
    let [first, last] = model.semantics().locals;
    let (own, mut others): (Vec<u32>, Vec<u32>) =
        read.into_iter().filter(|number| *number > 0).partition(|number| (first..=last).contains(number));
    others.retain(|number| state.variables().get(*number) == ConcreteValue::Unknown);
    if others.is_empty() { own } else { others }
}

/// Is this a word that looks like a code and names none?
pub fn is_unknown_code(word: &Word) -> bool {
    let is_code = word.letter == Letter::of('G') || word.letter == Letter::of('M');
    is_code && !word.code.is_some()
}

/// A fault in words; lengths are shown in `units`, those of the program.
pub fn words(fault: &Fault, model: &Model<'_>, block: &Written<'_>, units: Units) -> Words {
    match fault {
        Fault::Value(value) => of_value(*value),
        Fault::Undecidable => undecidable(&[]),
        Fault::UnsetParameter => Words::new("this named parameter was never set")
            .why("a named parameter has no value before the program gives it one")
            .help("assign it first, or give it for this run: `--set '#<name>=1'`"),
        Fault::ReadOnlyVariable(number) => Words::new(format!("`#{number}` can be read but not written"))
            .why("the control keeps this variable itself"),
        Fault::VariableNumber => Words::new("there is no variable of this number")
            .why("the number is not whole, or outside the range of the control's variables"),
        Fault::MissingValue(letter) => Words::new(format!("`{letter}` has no value"))
            .help("write a number after the letter, or remove the letter"),
        Fault::MissingWord(letter) => missing(*letter, block),
        Fault::WordRange(letter) => {
            Words::new(format!("the value of `{letter}` is outside what the code takes"))
        }
        Fault::UnknownCode => unknown_code(block),
        Fault::NotNow(refused, active) => not_now(*refused, *active, model),
        Fault::Malformed => Words::new("the control cannot read this block")
            .help("`gcheck check` says what is wrong with its form"),
        Fault::Conflict => conflict(block),

        Fault::WordTwice(letter) => Words::new(format!("`{letter}` is in this block twice"))
            .help("keep one of the two, or put the second on a block of its own"),
        Fault::UnreadWord(letter) => Words::new(format!("no code of this block reads `{letter}`"))
            .why("neither the codes of the block nor the motion in effect take this word")
            .help(format!("take `{letter}` away, or write the code that it belongs to")),
        Fault::Misplaced(letter) => Words::new(format!("`{letter}` is after other words"))
            .help(format!("write `{letter}` at the start of the block")),
        Fault::TooManyCodes => {
            Words::new("more M codes than a block may have").help("put some of them on a block of their own")
        }
        Fault::TooFewPoints => Words::new("the curve has fewer control points than its order needs")
            .why("a curve has at least as many points, with its start, as its order `L` says, and three without it"),
        Fault::LineTooLong => {
            Words::new("the line is longer than the control reads").help("divide it into several blocks")
        }

        Fault::NoFeed
        | Fault::NoInverseTimeFeed
        | Fault::SpindleStopped
        | Fault::SpindleDirection
        | Fault::NoSuchAxis(_)
        | Fault::NoMotionMode
        | Fault::NoAxisWords => of_move(fault),
        Fault::Arc(arc) => of_arc(arc, units),
        Fault::Corner(corner) => of_corner(*corner, units),
        Fault::Cycle(cycle) => of_cycle(*cycle, block),
        Fault::Compensation(compensation) => of_compensation(compensation, units),
        Fault::NoSuchTool(tool) => Words::new(format!("the tool table has no tool {tool}"))
            .help("add it to the tool table, or to `[tools]` in gcheck.toml"),
        Fault::NoToolSelected => Words::new("a tool change, and no tool was called for")
            .help("give the tool before or beside the change: `T1 M6`"),
        Fault::Probe => Words::new("the probing move cannot start")
            .why("it needs a feed, a way to go, and neither cutter compensation nor inverse-time feed"),
        Fault::NoDwellTime => Words::new("a dwell without its time").help("say how long: `P` with the dwell"),
        Fault::Profile => Words::new("the profile of this cycle is not found, or cannot be cut")
            .why("the blocks from `P` to `Q` must be in this program and go in one direction"),
        Fault::OverTravel(letter) => Words::new(format!("`{letter}` would leave the travel of the machine"))
            .why("the end point lies outside `travel` of `[machine]` in gcheck.toml"),
        Fault::NoSavedModes => {
            Words::new("modes are to be restored, and none were saved").help("save them before, with `M70`")
        }

        Fault::NoSuchLabel(_)
        | Fault::JumpTarget(_)
        | Fault::NoSuchProgram
        | Fault::TooDeep
        | Fault::LoopMismatch
        | Fault::StrayReturn
        | Fault::NoProgramEnd => of_way(fault),
        Fault::Alarm(number) => alarm(*number, None),
    }
}

fn unknown_code(block: &Written<'_>) -> Words {
    Words::new(match &block.unknown {
        Some(code) => format!("the control does not have the code `{code}`"),
        None => "the control does not have this code".to_owned(),
    })
    .help("`gcheck codes` lists the codes; `[codes]` in gcheck.toml adds those of the shop")
}

/// A code that the modes do not allow, or the one in effect of its group.
fn not_now(refused: CodeIx, active: Option<CodeIx>, model: &Model<'_>) -> Words {
    let name = code(model, refused);
    match active {
        None => Words::new(format!("{name} cannot be carried out here"))
            .why("the modes in effect do not allow it"),
        Some(active) if refused == active => Words::new(format!("{name} is in effect already")),
        Some(active) => {
            let words = Words::new(format!(
                "{name} cannot be carried out while {} is in effect",
                code(model, active)
            ));
            match ends(model, active) {
                Some(end) => words.help(format!("end it first, with `{end}`")),
                None => words,
            }
        }
    }
}

/// Faults of a move: its feed, its spindle, its axes.
fn of_move(fault: &Fault) -> Words {
    match fault {
        Fault::NoFeed => Words::new("a cut without a feed rate")
            .why("no `F` was given since the program began, or the last change of the feed mode cleared it")
            .help("give `F` on this block or before it"),
        Fault::NoInverseTimeFeed => Words::new("inverse-time feed, and the block has no `F`")
            .why("in inverse time `F` is the time of one move, so that every cutting block needs its own")
            .help("give `F` on this block"),
        Fault::SpindleStopped => Words::new("this needs a turning spindle, and it is stopped")
            .help("start the spindle first: `S` with `M3` or `M4`"),
        Fault::SpindleDirection => Words::new("the spindle turns the wrong way for this cycle"),
        Fault::NoSuchAxis(letter) => Words::new(format!("the machine has no axis `{letter}`"))
            .help("`[machine] axes` in gcheck.toml says which axes it has"),
        Fault::NoMotionMode => Words::new("axis words, and no code says how to move")
            .why("no motion code is in effect: none was given, or `G80` ended it")
            .help("write `G0`, `G1`, `G2` or `G3` on this block"),
        Fault::NoAxisWords => Words::new("the code needs axis words, and the block has none"),
        _ => Words::new("the move cannot be made"),
    }
}

/// Faults of the way through a program: jumps, calls, loops, its end.
fn of_way(fault: &Fault) -> Words {
    match fault {
        Fault::NoSuchLabel(number) => Words::new(format!("the program has no block `N{number}` to jump to")),
        Fault::JumpTarget(number) => {
            Words::new(format!("the jump leads to block {number}, which cannot exist"))
                .why("sequence numbers are whole numbers from 0 on")
                .help("correct the target, or the variables that it reads")
        }
        Fault::NoSuchProgram => Words::new("the called program is not found")
            .help("it may be in the folder of the program, or in one of `[search] paths` of gcheck.toml"),
        Fault::TooDeep => Words::new("calls are nested deeper than the control allows")
            .why("a program that calls itself without an end does this"),
        Fault::LoopMismatch => Words::new("the other end of this loop or condition is not found"),
        Fault::StrayReturn => Words::new("a return, and nothing was called"),
        Fault::NoProgramEnd => Words::new("the program ends without an end of program")
            .help("write `M2` or `M30` at its end, or `%` around it"),
        _ => Words::new("the program cannot go on here"),
    }
}

/// The block in which a fault is, as far as words about it depend on it.
#[derive(Default)]
pub struct Written<'m> {
    /// Its codes.
    pub codes: Vec<Code<'m>>,
    /// Its addresses.
    pub letters: LetterSet,
    /// The first word that looks like a code and names none.
    pub unknown: Option<String>,
}

impl<'m> Written<'m> {
    /// What a block says.
    pub fn of(place: &Place, model: &'m Model<'_>) -> Self {
        let words = place.table.words(place.block());
        let control = model.control();
        let unknown = words.iter().find(|word| is_unknown_code(word));
        Self {
            codes: words.iter().filter_map(|word| control.code_at(word.code)).collect(),
            letters: words.iter().map(|word| word.letter).collect(),
            unknown: unknown.and_then(|word| Some(format!("{}{}", word.letter, word.number()?))),
        }
    }
}

/// A word that the block does not have, with those that would do as well.
fn missing(letter: Letter, block: &Written<'_>) -> Words {
    if block.letters.contains(letter) {
        return Words::new(format!("`{letter}` has no value in this block"))
            .why("its variable holds nothing, and the control ignores the word")
            .help("set the variable before this block");
    }
    let needs = |code: &&Code<'_>| code.reads().contains(letter);
    let Some(code) = block.codes.iter().find(needs) else {
        return Words::new(format!("`{letter}` is missing in this block"))
            .why(format!("a code of the block needs a `{letter}` word"));
    };
    let names = names(code.would_do_for(letter, block.letters), "or");
    Words::new(format!("{names} is missing in this block"))
        .why(format!("`{}` needs {names}", code.entry().code))
}

/// Two words of a code that exclude each other; else two codes.
fn conflict(block: &Written<'_>) -> Words {
    for code in &block.codes {
        for items in &code.entry().not_together {
            let present = |item: &String| block.letters.and(LetterSet::of_item(item));
            let found: Vec<LetterSet> = items.iter().map(present).filter(|set| !set.is_empty()).collect();
            if found.len() > 1 {
                let both = found.into_iter().fold(LetterSet::EMPTY, LetterSet::or);
                let names = names(both, "and");
                return Words::new(format!(
                    "{names} cannot be together in a block of `{}`",
                    code.entry().code
                ))
                .why("each of these words takes the place of the others")
                .help("keep one of them");
            }
        }
    }
    Words::new("the codes and words of this block do not go together")
        .why("two of them exclude each other, or one of them does not go with a mode in effect")
        .help("`gcheck check` names them")
}

/// Addresses for people: "`A` or `B`".
fn names(letters: LetterSet, joint: &str) -> String {
    let names: Vec<String> = letters.iter().map(|letter| format!("`{letter}`")).collect();
    match names.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} {joint} {last}", others.join(", ")),
        Some((last, _)) => last.clone(),
        None => String::new(),
    }
}

/// `#3000`: the alarm that a program raises itself, with the text it gives.
pub fn alarm(number: i64, text: Option<&str>) -> Words {
    let text = text.map(|text| format!(": {text}")).unwrap_or_default();
    Words::new(format!("the program raises alarm {number} itself{text}"))
        .why("it assigns to `#3000`, which stops the machine")
}

/// More blocks than allowed.
pub fn out_of_fuel(blocks: u64) -> Words {
    let blocks = if blocks == 1 { "1 block".to_owned() } else { format!("{blocks} blocks") };
    Words::new(format!("the program had not ended after {blocks}; here gcheck stopped executing it"))
        .why("a loop may never end, or repeats give very many moves, which count as blocks too")
        .help("`--fuel BLOCKS` allows more")
}

/// A way on that cannot be chosen; `variables` are those of the block that have no known value.
pub fn undecidable(variables: &[u32]) -> Words {
    let names: Vec<String> = variables.iter().map(|number| format!("`#{number}`")).collect();
    let (what, example) = match (names.split_last(), variables.first()) {
        (Some((last, [])), Some(first)) => (format!("{last}, and its value is not known"), *first),
        (Some((last, others)), Some(first)) => {
            (format!("{} and {last}, and their values are not known", others.join(", ")), *first)
        }
        _ => ("an unknown value".to_owned(), 100),
    };
    Words::new(format!("what happens next depends on {what}"))
        .why("a condition, a repeat count, a target or a code is computed from it")
        .help(format!(
            "give the value: `--set '#{example}=1'`, or `[variables]`, `[offsets]`, `[tools]` in gcheck.toml"
        ))
}

fn of_value(fault: ValueFault) -> Words {
    match fault {
        ValueFault::DivisionByZero => {
            Words::new("division by zero").help("make sure that the divisor is not zero before this block")
        }
        ValueFault::NegativeRoot => Words::new("the square root of a negative number"),
        ValueFault::LogarithmOfNonPositive => Words::new("the logarithm of zero or of a negative number"),
        ValueFault::ArcFunctionRange => Words::new("`ASIN` and `ACOS` take numbers from -1 to 1"),
        ValueFault::NegativePower => Words::new("a negative number to a power that is not whole"),
        ValueFault::NotFinite => Words::new("the result is too large for the control"),
        ValueFault::Malformed => Words::new("the expression is not well formed")
            .help("`gcheck check` says what is wrong with its form"),
        ValueFault::NoSuchFunction => {
            Words::new("the control does not have this function, or takes other arguments with it")
        }
    }
}

fn of_arc(fault: &ArcFault, units: Units) -> Words {
    match *fault {
        ArcFault::NoCentre => Words::new("an arc without centre and radius")
            .help("give the centre (`I`, `J`, `K`, those of the plane) or the radius (`R`)"),
        ArcFault::CentreAndRadius => {
            Words::new("an arc with both centre and radius").help("take `R` or the centre away")
        }
        ArcFault::WrongPlane(letter) => Words::new(format!("`{letter}` belongs to an arc of another plane"))
            .why("`G17` takes `I` and `J`, `G18` `I` and `K`, `G19` `J` and `K`"),
        ArcFault::ZeroRadius => {
            Words::new("the radius of the arc is zero").why("the centre is the start point, or `R` is zero")
        }
        ArcFault::RadiusTooSmall { half_chord, radius } => {
            Words::new("the radius is too small to reach the end point").why(format!(
                "the radius is {}, and half the way from start to end is {}",
                length(radius, units),
                length(half_chord, units)
            ))
        }
        ArcFault::OffCircle { start, end } => {
            Words::new("the end point is not on the circle of the start point").why(format!(
                "it lies {} from the centre, and the start {}",
                length(end, units),
                length(start, units)
            ))
        }
        ArcFault::FullCircleByRadius => Words::new("a full circle by its radius")
            .why("start and end are one point, so that `R` does not say where the centre lies")
            .help("give the centre (`I`, `J`, `K`)"),
        ArcFault::Turns => Words::new("`P` of an arc is its number of turns, a whole number from 1"),
    }
}

fn of_corner(fault: CornerFault, units: Units) -> Words {
    match fault {
        CornerFault::NoTurn => {
            Words::new("a chamfer or rounding, and the next cut goes on in the same direction")
                .why("a corner is between two straight cuts that turn")
                .help("check the end points of the two cuts, or take the word of the corner away")
        }
        CornerFault::NoCutAfter => {
            Words::new("a chamfer or rounding, and no straight cut in the plane comes after it")
                .why("a corner is between two straight cuts")
                .help("write the second cut, or take the word of the corner away")
        }
        CornerFault::RapidAfter => Words::new("a chamfer or rounding before a rapid move")
            .why("a corner is between two straight cuts")
            .help("end the contour with a cut after the corner, or take the word away"),
        CornerFault::TooLong { needed, available } => {
            let words = Words::new("the chamfer or rounding does not fit between the two cuts")
                .help("make the corner smaller, or the shorter cut longer");
            if needed.is_finite() {
                words.why(format!(
                    "it takes {} of each cut, and the shorter one has {}",
                    length(needed, units),
                    length(available, units)
                ))
            } else {
                words.why("the second cut goes straight back")
            }
        }
    }
}

fn of_cycle(fault: CycleFault, block: &Written<'_>) -> Words {
    // As the block names it; a block of a cycle in effect does not.
    let is_cycle = |code: &&Code<'_>| matches!(code.motion(), Motion::Cycle | Motion::Operation);
    let code = block.codes.iter().find(is_cycle);
    let cycle = code.map_or_else(|| "the canned cycle".to_owned(), |code| format!("`{}`", code.entry().code));
    match fault {
        CycleFault::Missing(letter) if block.letters.contains(letter) => {
            Words::new(format!("`{letter}` of {cycle} has no value that the control can use"))
                .why("a variable that is empty takes its word out, and a value below zero counts as none")
        }
        CycleFault::Missing(letter) => Words::new(format!("{cycle} needs `{letter}`"))
            .why("it is neither in this block nor in an earlier one of the cycle"),
        CycleFault::RBelowBottom => Words::new("the retract level `R` lies below the final depth"),
        CycleFault::NotPositive(letter) => {
            let takes_zero = code.is_some_and(|code| {
                let mut words = code.entry().words.iter();
                words.any(|word| Letter::parse(&word.letter) == Some(letter) && word.min == Some(0.0))
            });
            let bound = if takes_zero { "not be below zero" } else { "be above zero" };
            Words::new(format!("`{letter}` of {cycle} must {bound}"))
        }
        CycleFault::Zero(letter) => Words::new(format!("`{letter}` of the pattern is zero"))
            .why("all its holes would lie on each other"),
        CycleFault::ZeroRepeats => Words::new(format!("{cycle} is repeated `L0` times")),
        CycleFault::Rotary => Words::new("rotary axes cannot move in a canned cycle"),
        CycleFault::InverseTime => Words::new("a canned cycle cannot run with inverse-time feed")
            .help("go back to feed per minute (`G94`) before it"),
        CycleFault::Compensated => Words::new("a canned cycle cannot run while cutter compensation is on")
            .help("end compensation (`G40`) before it"),
        CycleFault::Plane => Words::new("the canned cycle does not run in this plane"),
        CycleFault::Geometry => Words::new("the words of the cycle contradict each other"),
        CycleFault::OutlineOpen(_) => Words::new("the outline of the pocket is not closed")
            .why("its last move does not end where its first move leads to")
            .help("end the outline at the point that its first move reaches"),
        CycleFault::OutlineEmpty => Words::new("the pocket has no outline")
            .why("there is no move after the one that leads to the outline"),
        CycleFault::StartOutside => Words::new("the start hole of the pocket lies outside its outline")
            .help("give the start hole with `X` and `Y`, inside the outline"),
        CycleFault::ArcBelowTool { .. } => {
            Words::new("the tool is larger than an inside arc of the pocket's outline")
                .why("its centre cannot follow the wall there")
                .help("take a smaller tool, or a larger radius in the outline")
        }
    }
}

fn of_compensation(fault: &CompensationFault, units: Units) -> Words {
    match *fault {
        CompensationFault::EntryTooShort { needed, got } => {
            Words::new("the move that switches cutter compensation on is too short")
                .why(format!(
                    "it is {} long, and the radius is {}",
                    length(got, units),
                    length(needed, units)
                ))
                .help("start compensation on a longer straight move, away from the contour")
        }
        CompensationFault::EntryIsArc => {
            Words::new("cutter compensation cannot begin on an arc").help("switch it on with a straight move")
        }
        CompensationFault::ExitIsArc => {
            Words::new("cutter compensation cannot end on an arc").help("switch it off with a straight move")
        }
        CompensationFault::Gouge => Words::new("the cutter does not fit into the contour")
            .why("with its radius it would cut into a part of the contour that comes before or after")
            .help("take a smaller cutter, or open the corner"),
        CompensationFault::Plane => Words::new("cutter compensation does not work in this plane"),
        CompensationFault::NotWhileOn => Words::new("this cannot be done while cutter compensation is on")
            .help("end compensation (`G40`) before it"),
        CompensationFault::AlreadyOn => Words::new("cutter compensation is on already")
            .help("end it (`G40`) before switching it on again"),
    }
}

/// A code as people name it.
fn code(model: &Model<'_>, ix: CodeIx) -> String {
    match model.control().code_at(ix) {
        Some(code) => format!("`{}` ({})", code.entry().code, code.entry().title),
        None => "this code".to_owned(),
    }
}

/// The code that ends a mode: by its own entry, else the other side of its switch.
fn ends(model: &Model<'_>, active: CodeIx) -> Option<String> {
    use gcheck_controls::Effect as E;
    let entry = model.control().code_at(active)?.entry();
    if let Some(code) = entry.cancelled_by.iter().find(|code| !code.starts_with('@')) {
        return Some(code.clone());
    }
    let off = match model.role(active)? {
        Role::Compensation => E::CompensationOff,
        Role::Cycle => E::CycleCancel,
        Role::Length => E::LengthOff,
        Role::Scaling => E::ScalingOff,
        Role::Rotation => E::RotationOff,
        Role::Mirror => E::MirrorOff,
        Role::Polar => E::PolarOff,
        Role::TiltedPlane => E::TiltedPlaneOff,
        Role::DynamicOffset => E::DynamicOffsetOff,
        Role::FeedMode => E::FeedPerMinute,
        Role::SpindleMode => E::ConstantSpeed,
        _ => return None,
    };
    let found = model.control().codes().find(|code| code.effect() == off)?;
    (model.control().code_ix(found.number()) != active).then(|| found.entry().code.clone())
}

/// A length in the units of the program.
fn length(mm: f64, units: Units) -> String {
    let (value, decimals, unit) = match units {
        Units::Inch => (mm / 25.4, 4, "inch"),
        Units::Mm => (mm, 3, "mm"),
    };
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    format!("{text} {unit}")
}

/// The word of the block that a fault is about, if it is about one.
pub fn culprit(fault: &Fault) -> Option<Culprit> {
    Some(match fault {
        Fault::MissingValue(letter)
        | Fault::WordRange(letter)
        | Fault::NoSuchAxis(letter)
        | Fault::OverTravel(letter)
        | Fault::Arc(ArcFault::WrongPlane(letter))
        | Fault::Cycle(CycleFault::NotPositive(letter) | CycleFault::Zero(letter)) => {
            Culprit::Letter(*letter)
        }
        Fault::Arc(ArcFault::Turns) => Culprit::Letter(Letter::of('P')),
        Fault::Arc(ArcFault::RadiusTooSmall { .. } | ArcFault::FullCircleByRadius) => {
            Culprit::Letter(Letter::of('R'))
        }
        Fault::NoSuchTool(_) => Culprit::Letter(Letter::of('T')),
        Fault::NotNow(code, _) => Culprit::Code(*code),
        Fault::UnknownCode => Culprit::UnknownCode,
        _ => return None,
    })
}

/// A word of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Culprit {
    /// The last with this address.
    Letter(Letter),
    /// The one that names this code.
    Code(CodeIx),
    /// The first `G` or `M` that names no code.
    UnknownCode,
}
