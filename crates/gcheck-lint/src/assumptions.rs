//! What a result rests on, in words, with the lines of the configuration that would settle it.
//!
//! Knows: the wording of every assumption and the keys of `gcheck.toml`. Must not know: how assumptions come about, files.

use std::collections::{BTreeMap, BTreeSet};

use gcheck_controls::{CodeIx, Effect, Machine};
use gcheck_diagnostics::StatedAssumption;
use gcheck_engine::{Assumption, Axis, Model, Units, Unsettled};

/// Words for one assumption.
pub fn describe(assumption: &Assumption, model: &Model<'_>) -> StatedAssumption {
    match assumption {
        Assumption::StartMode(_, code) => {
            StatedAssumption::new(format!("{} is in effect at the start", named(*code, model)))
        }
        Assumption::StartPosition => {
            StatedAssumption::new("the positions of the axes at the start are not known")
        }
        Assumption::WorkOffset(number) => work_offset(*number, model),
        Assumption::ToolLength(tool) => {
            StatedAssumption::new(format!("the length of tool {tool} is not known"))
                .pin(format!("[tools] {tool}.length = …"))
        }
        Assumption::ToolRadius(tool) => tool_radius(*tool, model),
        Assumption::ReferencePosition(number) => reference_position(*number, model),
        Assumption::Setting(number) => setting(number, model),
        Assumption::UnpointedNumbers => unpointed_numbers(model),
        Assumption::Variable(number) => {
            StatedAssumption::new(format!("the value of `#{number}` at the start is not known"))
                .pin(format!("[variables] \"#{number}\" = …"))
        }
        Assumption::MissingProgram(number) => missing(&format!("program {number}")),
        Assumption::MissingSubroutine(name) => missing(&format!("the subroutine `{name}`")),
        Assumption::BlockSkip(true) => {
            StatedAssumption::new("block delete is on: blocks with `/` were skipped")
        }
        Assumption::BlockSkip(false) => {
            StatedAssumption::new("block delete is off: blocks with `/` were executed")
        }
        Assumption::OptionalStop => StatedAssumption::new("the optional stop is off: `M1` was passed over"),
        Assumption::ProbeTouch => StatedAssumption::new("probing moves touch, at unknown points"),
        Assumption::Axis(axis) => has_axis(*axis, model),
        Assumption::HeadKinematics => StatedAssumption::new(
            "the head tilts in A, which carries B, and both turn by the right-hand rule",
        )
        .pin("[machine] rotary_order = [\"A\", \"B\"]"),
        Assumption::UprightTool => {
            StatedAssumption::new("the tool is parallel to Z where the work positions of A and B are zero")
        }
        Assumption::CylinderDiameter(axis) => StatedAssumption::new(format!(
            "no program before this one gave cylinders on {} a diameter",
            axis.name()
        )),
        Assumption::CylinderCarrier(axis) => {
            StatedAssumption::new(format!("{} can carry a cylinder: the manuals differ in that", axis.name()))
        }
        Assumption::CylinderStart(axis) => StatedAssumption::new(format!(
            "a contour on {} begins at the present angle of the axis",
            axis.name()
        )),
        Assumption::PocketEnd => StatedAssumption::new(
            "a pocket that the control clears leaves the tool over its start hole, at the rapid level",
        ),
        Assumption::BarLength => {
            StatedAssumption::new("the bar is long enough for the next part: its length is not known")
                .pin("[machine] bar_length = …")
        }
        Assumption::BarAtLimit => StatedAssumption::new(
            "a bar just as long as a part and its clamping is taken for too short: the manual does not say",
        ),
        Assumption::NewBar => StatedAssumption::new(
            "the program starts with a new bar in the chuck, pushed out as new bars are, and the feeder's counters at zero",
        ),
        Assumption::BarLimits => {
            StatedAssumption::new("the bar feeder stops when its limit of parts, bars or length is reached")
        }
        Assumption::Unsettled(what) => StatedAssumption::new(unsettled(*what)),
        Assumption::PathsJoined => StatedAssumption::new(
            "the program has more conditions than are followed by themselves: where paths meet after the others, what only one of them sets is not known",
        ),
        Assumption::Code(code) => {
            StatedAssumption::new(format!("what {} changes is not known", named(*code, model)))
        }
        Assumption::Passes(code) => {
            StatedAssumption::new(format!("the passes of {} are not computed", named(*code, model)))
        }
    }
}

fn work_offset(number: u16, model: &Model<'_>) -> StatedAssumption {
    let name = work_offset_name(number, model);
    StatedAssumption::new(format!("the work offset {name} is not known")).pin(format!(
        "[offsets] {} = {{ {} }}",
        key(&name),
        axes(model)
    ))
}

fn tool_radius(tool: u32, model: &Model<'_>) -> StatedAssumption {
    let (what, pin) = match model.control().machine() {
        Machine::Mill => ("diameter", "diameter"),
        Machine::Lathe => ("nose radius", "corner_radius"),
    };
    StatedAssumption::new(format!("the {what} of tool {tool} is not known"))
        .pin(format!("[tools] {tool}.{pin} = …"))
}

fn reference_position(number: u8, model: &Model<'_>) -> StatedAssumption {
    StatedAssumption::new(match with_effect(Effect::ReturnReference(number), model) {
        Some(code) => format!("the reference position of `{code}` is not known"),
        None => format!("reference position {number} is not known"),
    })
}

fn unpointed_numbers(model: &Model<'_>) -> StatedAssumption {
    let text = "numbers without a decimal point count as the control usually reads them";
    match &model.control().numbers().unpointed_setting {
        Some(name) => {
            let number = name.rsplit(' ').next().unwrap_or_default();
            StatedAssumption {
                pin: setting(number, model).pin,
                ..StatedAssumption::new(format!("{text} ({name})"))
            }
        }
        None => StatedAssumption::new(text),
    }
}

/// A program or subroutine is not here.
fn missing(what: &str) -> StatedAssumption {
    StatedAssumption::new(format!("what {what} does is not known: it was not found"))
        .pin("[search] paths = [\"…\"]")
}

fn has_axis(axis: Axis, model: &Model<'_>) -> StatedAssumption {
    let name = axis.name();
    StatedAssumption::new(format!("the machine has the axis `{name}`"))
        .pin(format!("[machine] axes = [{}, \"{name}\"]", quoted_axes(model)))
}

/// What a picture of a path says of an assumption, at the block that is the first to need it; `None` for what changes no move.
pub fn in_picture(assumption: &Assumption, model: &Model<'_>) -> Option<String> {
    match assumption {
        Assumption::MissingProgram(number) => Some(format!(
            "program {number} was not found; what it does is not drawn, and modes and position are assumed to stay as they were"
        )),
        Assumption::MissingSubroutine(name) => Some(format!(
            "the subroutine `{name}` was not found; what it does is not drawn, and modes and position are assumed to stay as they were"
        )),
        Assumption::ProbeTouch => {
            Some("probing moves are assumed to touch at the ends of their moves".to_owned())
        }
        _ if assumption.leaves_moves_out() => {
            Some(format!("not drawn: {}", describe(assumption, model).text))
        }
        _ => None,
    }
}

/// Words for what paths differ in where they become one.
fn unsettled(what: Unsettled) -> &'static str {
    match what {
        Unsettled::ModalCall => {
            "whether a modal macro call is on, and which, depends on the path: what the macro changes is not known after the moves"
        }
        Unsettled::Compensation => {
            "whether cutter compensation is on depends on the path: where the tool goes beside the programmed path is not known"
        }
        Unsettled::Curve => {
            "which control points a curve has depends on the path: where the curve ends is not known"
        }
        Unsettled::SavedModes => {
            "which modes were saved depends on the path: the modes that come back are not known"
        }
        Unsettled::Parameter => {
            "whether a named parameter was set depends on the path: it is taken to be set"
        }
        Unsettled::Caller => {
            "which program called a subprogram depends on the path: its return is not followed"
        }
        Unsettled::BarFeed => {
            "whether a bar feed follows a subprogram depends on the path: what it changes is not known"
        }
    }
}

/// Words for all assumptions of a result, what matters most first. The modes at the start share one sentence.
pub fn describe_all(assumptions: &BTreeSet<Assumption>, model: &Model<'_>) -> Vec<StatedAssumption> {
    let at_start: Vec<CodeIx> = assumptions
        .iter()
        .filter_map(|assumption| match assumption {
            Assumption::StartMode(_, code) => Some(*code),
            _ => None,
        })
        .collect();
    let mut all: Vec<(u8, StatedAssumption)> = assumptions
        .iter()
        .filter(|assumption| !matches!(assumption, Assumption::StartMode(..)))
        .map(|assumption| (weight(assumption), describe(assumption, model)))
        .collect();
    // Stable: assumptions of one weight keep their order.
    all.sort_by_key(|(weight, _)| *weight);
    let mut all: Vec<StatedAssumption> = all.into_iter().map(|(_, described)| described).collect();
    match at_start.as_slice() {
        [] => {}
        [code] => {
            all.push(StatedAssumption::new(format!("{} is in effect at the start", named(*code, model))));
        }
        codes => {
            let mut names: Vec<&str> = codes.iter().filter_map(|code| name(*code, model)).collect();
            names.dedup();
            all.push(StatedAssumption::new(format!(
                "in effect at the start, as at power-on: {}",
                names.join(" ")
            )));
        }
    }
    all
}

/// A work coordinate system as the control calls it: `G54`, `G154 P3`.
pub fn work_offset_name(number: u16, model: &Model<'_>) -> String {
    if let Some(code) = with_effect(Effect::WorkOffset(number), model) {
        return code.to_owned();
    }
    let by_p = model.control().codes().find_map(|code| match code.effect() {
        Effect::WorkOffsetByP(first) if first <= number => {
            Some(format!("{} P{}", code.entry().code, number - first + 1))
        }
        _ => None,
    });
    by_p.unwrap_or_else(|| format!("number {number}"))
}

/// What is unknown of positions comes first, what an operator switches last.
fn weight(assumption: &Assumption) -> u8 {
    match assumption {
        Assumption::MissingProgram(_) | Assumption::MissingSubroutine(_) => 0,
        Assumption::Code(_) | Assumption::Passes(_) | Assumption::Unsettled(_) | Assumption::PathsJoined => 1,
        Assumption::UnpointedNumbers | Assumption::Setting(_) => 2,
        Assumption::StartPosition | Assumption::ReferencePosition(_) => 3,
        Assumption::WorkOffset(_) => 4,
        Assumption::ToolLength(_) | Assumption::ToolRadius(_) => 5,
        Assumption::Variable(_) => 6,
        Assumption::Axis(_)
        | Assumption::ProbeTouch
        | Assumption::HeadKinematics
        | Assumption::UprightTool
        | Assumption::CylinderDiameter(_)
        | Assumption::CylinderCarrier(_)
        | Assumption::CylinderStart(_)
        | Assumption::PocketEnd
        | Assumption::BarLength
        | Assumption::BarAtLimit
        | Assumption::NewBar
        | Assumption::BarLimits => 7,
        Assumption::BlockSkip(_) | Assumption::OptionalStop => 8,
        Assumption::StartMode(..) => 9,
    }
}

fn setting(number: &str, model: &Model<'_>) -> StatedAssumption {
    let Some(entry) = model.control().setting(number) else {
        return StatedAssumption::new(format!("setting {number} is not known"))
            .pin(format!("[settings] {} = …", key(number)));
    };
    let told = format!("setting {number} ({})", entry.title);
    let is_length = entry.values.iter().any(|value| value == "length");
    match &entry.default {
        Some(value) if is_length && value.parse::<f64>().is_ok_and(|length| length != 0.0) => {
            let unit = match model.units_at_power_on(&BTreeMap::new()) {
                Some(Units::Inch) => " inch",
                Some(Units::Mm) => " mm",
                None => "",
            };
            // The setting counts in the unit of the program, which may be another one.
            StatedAssumption::new(format!("{told} is {value}{unit}, as usual"))
                .pin(format!("[settings] {} = …", key(number)))
        }
        Some(value) => StatedAssumption::new(format!("{told} is `{value}`, as usual")).pin(format!(
            "[settings] {} = {}",
            key(number),
            scalar(value)
        )),
        None => StatedAssumption::new(format!("{told} is not known"))
            .pin(format!("[settings] {} = …", key(number))),
    }
}

/// A setting's value as TOML.
fn scalar(value: &str) -> String {
    match value {
        "on" => "true".to_owned(),
        "off" => "false".to_owned(),
        number if number.parse::<f64>().is_ok() => number.to_owned(),
        text => format!("\"{text}\""),
    }
}

/// A key of TOML, in quotes where it needs them.
fn key(name: &str) -> String {
    let is_bare =
        !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'-' | b'_'));
    if is_bare { name.to_owned() } else { format!("\"{name}\"") }
}

fn axes(model: &Model<'_>) -> &'static str {
    match model.control().machine() {
        Machine::Mill => "X = …, Y = …, Z = …",
        Machine::Lathe => "X = …, Z = …",
    }
}

fn quoted_axes(model: &Model<'_>) -> &'static str {
    match model.control().machine() {
        Machine::Mill => "\"X\", \"Y\", \"Z\"",
        Machine::Lathe => "\"X\", \"Z\"",
    }
}

fn with_effect<'c>(effect: Effect, model: &Model<'c>) -> Option<&'c str> {
    model.control().codes().find(|code| code.effect() == effect).map(|code| code.entry().code.as_str())
}

fn name<'c>(code: CodeIx, model: &Model<'c>) -> Option<&'c str> {
    model.control().code_at(code).map(|code| code.entry().code.as_str())
}

fn named(code: CodeIx, model: &Model<'_>) -> String {
    match model.control().code_at(code) {
        Some(code) => format!("`{}` ({})", code.entry().code, code.entry().title),
        None => "a code".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use gcheck_engine::{Assumption, Axis, Model, Role};

    use gcheck_diagnostics::pins;

    use super::{describe, describe_all, work_offset_name};

    fn check(control: &str, assumptions: impl IntoIterator<Item = Assumption>, expected: &Expect) {
        let control = gcheck_controls::load(control).unwrap();
        let model = Model::new(&control);
        let described = describe_all(&assumptions.into_iter().collect(), &model);
        let texts: String = described.iter().map(|described| format!("{}\n", described.text)).collect();
        expected.assert_eq(&format!("{texts}--\n{}\n", pins(&described).join("\n")));
    }

    #[test]
    fn lines_of_one_table_stand_together() {
        check(
            "haas-mill",
            [
                Assumption::ToolLength(2),
                Assumption::WorkOffset(1),
                Assumption::ToolRadius(2),
                Assumption::WorkOffset(9),
                Assumption::Variable(100),
                Assumption::StartPosition,
            ],
            &expect![[r##"
                the positions of the axes at the start are not known
                the work offset G54 is not known
                the work offset G112 is not known
                the length of tool 2 is not known
                the diameter of tool 2 is not known
                the value of `#100` at the start is not known
                --
                [offsets]
                G54 = { X = …, Y = …, Z = … }
                G112 = { X = …, Y = …, Z = … }
                [tools]
                2.length = …
                2.diameter = …
                [variables]
                "#100" = …
            "##]],
        );
    }

    #[test]
    fn what_is_missing_comes_first_and_modes_last() {
        let control = gcheck_controls::load("linuxcnc").unwrap();
        let code = |name: &str| control.code_ix(gcheck_controls::CodeNumber::parse(name).unwrap());
        check(
            "linuxcnc",
            [
                Assumption::StartMode(Role::Plane, code("G17")),
                Assumption::StartMode(Role::Distance, code("G90")),
                Assumption::BlockSkip(false),
                Assumption::OptionalStop,
                Assumption::ProbeTouch,
                Assumption::ReferencePosition(2),
                Assumption::MissingSubroutine("edge".to_owned()),
                Assumption::MissingProgram(9_010),
                Assumption::Axis(Axis::A),
            ],
            &expect![[r##"
                what program 9010 does is not known: it was not found
                what the subroutine `edge` does is not known: it was not found
                the reference position of `G30` is not known
                probing moves touch, at unknown points
                the machine has the axis `A`
                block delete is off: blocks with `/` were executed
                the optional stop is off: `M1` was passed over
                in effect at the start, as at power-on: G17 G90
                --
                [search]
                paths = ["…"]
                [machine]
                axes = ["X", "Y", "Z", "A"]
            "##]],
        );
    }

    #[test]
    fn settings_say_what_they_are_taken_to_be() {
        let control = gcheck_controls::load("haas-mill").unwrap();
        let model = Model::new(&control);
        for setting in control.settings() {
            let described = describe(&Assumption::Setting(setting.number.clone()), &model);
            assert!(described.text.contains(&setting.title), "{}", described.text);
            let pin = described.pin.unwrap();
            // A length counts in the unit of the program, so that no value of it can be copied.
            let is_length = setting.values.iter().any(|value| value == "length");
            let is_open = setting.default.as_ref().is_none_or(|value| is_length && value != "0");
            assert_eq!(pin.contains('…'), is_open, "{pin}");
        }
    }

    #[test]
    fn pins_are_toml_but_for_what_only_the_machine_can_tell() {
        let control = gcheck_controls::load("haas-lathe").unwrap();
        let model = Model::new(&control);
        let all = [Assumption::WorkOffset(3), Assumption::ToolRadius(1), Assumption::Variable(5)];
        for pin in all.iter().filter_map(|assumption| describe(assumption, &model).pin) {
            let (table, line) = pin.split_once("] ").unwrap();
            assert!(table.starts_with('[') && line.contains(" = "), "{pin}");
        }
        assert_eq!(work_offset_name(1, &model), "G54");
    }
}
