//! The state before and after the block at a place, in full.
//!
//! Knows: what of a state people read. Must not know: how states come about, how they are drawn.

use std::collections::BTreeMap;

use gcheck_db::{Cancelled, Database, DocumentId, Snapshot, StateAt};
use gcheck_engine::{
    Abstract, AbstractValue, At, Axis, Fact, Look, Position, ReachingDefinitions, Role, State,
};
use gcheck_program::line_starts;
use serde::Serialize;

use crate::assumed::assumed;
use crate::number_text::{in_units, unit, value};
use crate::sections::tool_names;
use crate::state_reader::{StateReader, tool_of};

/// Variables that are shown.
const MOST_VARIABLES: usize = 200;

/// The state around a block.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct StateView {
    /// Line of the block, from 0.
    pub line: u32,
    /// First byte of the block.
    pub start: u32,
    /// Byte after the block.
    pub end: u32,
    /// Every path comes here.
    pub on_every_path: bool,
    /// How often it was executed: turns of loops and calls.
    pub visits: u32,
    /// What it rests on that nobody can know, in a few words: that a program which was not found changes nothing.
    pub assumed: Option<String>,
    /// The blocks that call the program of the block, the outermost first; the last alone where nobody knows who called it.
    pub calls: Vec<CallView>,
    /// Before the block.
    pub before: StateSide,
    /// After it; of a call, when the program is back. `None` when the program does not go on from here.
    pub after: Option<StateSide>,
}

/// A state.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct StateSide {
    /// Units of all lengths here: `mm` or `inch`.
    pub units: &'static str,
    /// X counts diameters.
    pub diameter: bool,
    /// What may be in effect, by what it decides.
    pub modes: Vec<ModeView>,
    /// The feed with its unit; `None` when none was given or it is not known.
    pub feed: Option<String>,
    /// The speed with its unit.
    pub speed: Option<String>,
    /// What the spindle does.
    pub spindle: &'static str,
    /// The tool in the spindle; `None` not known.
    pub tool: Option<String>,
    /// What program and configuration tell of that tool.
    pub tool_is: Option<ToolView>,
    /// The speed of its edge with the unit, where its diameter and the speed are known.
    pub surface_speed: Option<String>,
    /// What each of its teeth cuts with the unit, where they are known.
    pub chip_load: Option<String>,
    /// The tool called for.
    pub selected_tool: Option<String>,
    /// Number of the tool length offset (`H`); 0 for none.
    pub length_offset: Option<String>,
    /// Number of the cutter compensation offset (`D`); 0 for none.
    pub cutter_offset: Option<String>,
    /// The active work coordinate system.
    pub work_offset: Option<String>,
    /// Its origin in machine coordinates.
    pub origin: AxisPlaces,
    /// Programmed point.
    pub programmed: AxisPlaces,
    /// Where the axes are, work coordinates.
    pub work: AxisPlaces,
    /// Where the axes are, machine coordinates.
    pub machine: AxisPlaces,
    /// The tool's tip, work coordinates.
    pub tip: AxisPlaces,
    /// Tool offsets in effect.
    pub length: AxisPlaces,
    /// Shift of `G52` and `G92`.
    pub shift: AxisPlaces,
    /// Variables that the program uses.
    pub variables: Vec<VariableView>,
}

/// A tool, as far as somebody told.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ToolView {
    /// What the program calls it.
    pub name: Option<String>,
    /// Its length, in the units of the program.
    pub length: Option<f64>,
    /// Its diameter, in the units of the program.
    pub diameter: Option<f64>,
}

/// A block that calls a program.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct CallView {
    /// The block.
    pub text: String,
    /// Its file; empty for the document.
    pub file: String,
    /// Its line, from 1.
    pub line: u32,
}

/// What a modal group decides and what may be active of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ModeView {
    /// What the group decides.
    pub group: String,
    /// The code, or the few that it may be.
    pub codes: Vec<String>,
    /// First byte of the block that set it; `None` when it is as at the start, or was set in another file.
    pub set_at: Option<u32>,
}

/// A variable and what it may hold.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct VariableView {
    /// `#100`, `#<depth>`.
    pub name: String,
    /// Its value or range.
    pub value: String,
}

/// Where the axes are, by axis; `None` unknown.
pub type AxisPlaces = BTreeMap<char, Option<f64>>;

/// The state around the block at `offset`; `None` where no block is, or no path comes.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn state_at(
    database: &mut Database,
    document: DocumentId,
    offset: u32,
    stop: &dyn Fn() -> bool,
) -> Result<Option<StateView>, Cancelled> {
    let snapshot = database.indexed(document).ok_or(Cancelled)?;
    let Some(place) = snapshot.block_at(offset) else { return Ok(None) };
    let range = place.range();
    let mut view = None;
    database.look(document, place.number..place.number.saturating_add(1), stop, &mut |state, look| {
        let reader = StateReader::new(&snapshot, look.model());
        let before = side(&reader, look, &state.before, &state.definitions);
        let after = state.settled().map(|(after, definitions)| {
            let mut after = side(&reader, look, after, definitions);
            if !state.calls() {
                set_here(&before, &mut after, range.start);
            }
            after
        });
        view = Some(StateView {
            line: snapshot.line_at(range.start),
            start: range.start,
            end: range.end,
            on_every_path: state.on_every_path,
            visits: state.visits,
            assumed: if state.is_assumed { assumed(&snapshot, range.end) } else { None },
            calls: calls(&snapshot, look, &state.before),
            before,
            after,
        });
    })?;
    Ok(view)
}

/// A mode that is another one after the block was set by the block, also where no code of the block names it: the end of a program
/// sets what holds at power-on.
fn set_here(before: &StateSide, after: &mut StateSide, block: u32) {
    for mode in &mut after.modes {
        let was = before.modes.iter().find(|was| was.group == mode.group);
        if was.is_some_and(|was| was.codes != mode.codes && was.set_at == mode.set_at) {
            mode.set_at = Some(block);
        }
    }
}

fn side(
    reader: &StateReader<'_>,
    look: &mut Look<'_, '_>,
    state: &State<Abstract>,
    definitions: &ReachingDefinitions,
) -> StateSide {
    let model = reader.model;
    let places = reader.places(state);
    let named = |point: &Position| axes(reader, state, point);
    let number = |held: &AbstractValue| {
        (!matches!(held, AbstractValue::Vacant | AbstractValue::Unknown)).then(|| value(held))
    };
    StateSide {
        units: unit(reader.units(state)),
        diameter: reader.diameter(state),
        modes: Role::ALL.into_iter().filter_map(|role| mode(reader, state, role, definitions)).collect(),
        feed: reader.feed(state),
        speed: reader.speed(state),
        spindle: StateReader::spindle(state),
        tool: number(state.tool()),
        tool_is: tool(reader, state),
        surface_speed: reader.edge_speed(state),
        chip_load: reader.chip_load(state),
        selected_tool: number(state.selected()),
        length_offset: number(state.h()),
        cutter_offset: number(state.d()),
        work_offset: state.work().map(|number| gcheck_lint::work_offset_name(number, model)),
        origin: named(&state.work_offset().origin),
        programmed: named(&places.programmed),
        work: named(&places.work),
        machine: named(&places.machine),
        tip: named(&places.tip),
        length: named(state.length()),
        shift: named(&state.shift()),
        variables: variables(reader.snapshot, look, state),
    }
}

/// What is told of the tool in the spindle.
fn tool(reader: &StateReader<'_>, state: &State<Abstract>) -> Option<ToolView> {
    let number = tool_of(state)?;
    let machine = &reader.snapshot.settings().machine.engine;
    let entry = machine.tools.get(&number);
    let units = reader.units(state);
    let shown = |mm: f64| mm.is_finite().then(|| rounded(mm / units.in_mm()));
    let view = ToolView {
        name: tool_names(reader.snapshot).get(number).map(str::to_owned),
        length: entry.and_then(|entry| shown(entry.offset.raw(Axis::Z))),
        diameter: entry.and_then(|entry| shown(entry.diameter.0)),
    };
    (view.name.is_some() || view.length.is_some() || view.diameter.is_some()).then_some(view)
}

/// The blocks that led to the program of a state.
fn calls(snapshot: &Snapshot, look: &Look<'_, '_>, state: &State<Abstract>) -> Vec<CallView> {
    let program = look.program();
    let view = |caller: At| {
        let file = program.file(caller.file)?;
        let start = file.loaded.place(caller.block, program.dialect())?.range().start;
        // The lines of the document are known; those of other files are counted.
        let line = if caller.file == 0 {
            snapshot.line_at(start) + 1
        } else {
            line_starts(&file.loaded.text()).partition_point(|line| *line <= start) as u32
        };
        let text = file.loaded.line_from(start).trim().to_owned();
        Some(CallView { text, file: file.name.to_string(), line })
    };
    state.frames().iter().skip(1).filter_map(|frame| view(frame.caller)).collect()
}

/// Nobody reads more than six decimals, and after them there is only the noise of conversions.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

fn mode(
    reader: &StateReader<'_>,
    state: &State<Abstract>,
    role: Role,
    definitions: &ReachingDefinitions,
) -> Option<ModeView> {
    let mode = state.mode(role);
    if mode.is_taken_for_kept() {
        return None;
    }
    let codes = reader.mode(state, role);
    let first = mode.alternatives().iter().find_map(|code| reader.model.control().code_at(*code))?;
    let set = definitions.set_by(Fact::Mode(role)).filter(|at| at.file == 0);
    let set_at = set.and_then(|at| reader.snapshot.place(at.block)).map(|place| place.range().start);
    Some(ModeView { group: first.group().title.clone(), codes, set_at })
}

/// A point by axis, in the units of the program.
fn axes(reader: &StateReader<'_>, state: &State<Abstract>, point: &Position) -> AxisPlaces {
    let (units, diameter) = (reader.units(state), reader.diameter(state));
    let value = |axis| point.get(axis).map(|value| rounded(in_units(axis, value, units, diameter)));
    reader.axes().into_iter().map(|axis| (axis.name(), value(axis))).collect()
}

/// The numbered variables that the file assigns, and the locals that hold something.
fn variables(snapshot: &Snapshot, look: &mut Look<'_, '_>, state: &State<Abstract>) -> Vec<VariableView> {
    let [first, last] = look.model().semantics().locals;
    let assigned = snapshot.file_index().assigned.iter().map(|(number, _)| *number);
    let mut numbers: Vec<u32> = assigned.chain(first.max(1)..=last).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let mut views = Vec::new();
    for number in numbers {
        if views.len() >= MOST_VARIABLES {
            break;
        }
        let held = look.variable(number, state);
        let is_local = (first..=last).contains(&number);
        if let Some(held) = held.filter(|held| !(is_local && nothing(held))) {
            views.push(VariableView { name: format!("#{number}"), value: value(&held) });
        }
    }
    views
}

/// Says nothing worth a line: never set, or not known.
fn nothing(held: &AbstractValue) -> bool {
    matches!(held, AbstractValue::Vacant | AbstractValue::Unknown) || *held == AbstractValue::Number(0.0)
}

/// The states of one block, for features that look at several things of it.
pub(crate) fn look_at(
    database: &mut Database,
    document: DocumentId,
    block: u32,
    stop: &dyn Fn() -> bool,
    with: &mut dyn FnMut(&StateAt, &mut Look<'_, '_>),
) -> Result<(), Cancelled> {
    database.look(document, block..block.saturating_add(1), stop, with)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use expect_test::{Expect, expect};
    use gcheck_db::Settings;
    use gcheck_engine::{Axis, Machine, Position, Tool, WorkOffset};
    use gcheck_geometry::{Arrangement, Kinematics, Mm, RotaryAxis};

    use super::state_at;
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        let mut fixture = Fixture::new(control, text);
        let view = state_at(&mut fixture.database, fixture.document, fixture.offset, &|| false).unwrap();
        expected.assert_debug_eq(&view);
    }

    #[test]
    fn a_tool_with_its_name_and_the_calls_that_lead_to_the_block() {
        let text = "O1\nG21 G90 G54\nT3 M6 (END MILL)\nM97 P100 L2\nM30\nN100 G0 X1.\nM97 P200\nM99\nN200 G0 Y$01.\nM99\n";
        let mut fixture = Fixture::new("haas-mill", text);
        let view =
            state_at(&mut fixture.database, fixture.document, fixture.offset, &|| false).unwrap().unwrap();
        assert_eq!(view.before.tool_is.unwrap().name.as_deref(), Some("END MILL"));
        let calls: Vec<_> = view.calls.iter().map(|call| (call.text.as_str(), call.line)).collect();
        assert_eq!(calls, [("M97 P100 L2", 4), ("M97 P200", 7)]);
    }

    #[test]
    fn the_tip_goes_where_the_program_says_however_long_the_tool_is() {
        let text = "O1\nG21 G90 G54 G0 X1. Y2.\nT3 M6\nG43 H3 Z5.\n$0G1 Z-1. F100.\nM30\n";
        let mut fixture = Fixture::new("haas-mill", text);
        let view =
            state_at(&mut fixture.database, fixture.document, fixture.offset, &|| false).unwrap().unwrap();
        assert_eq!(view.before.tip.get(&'Z'), Some(&Some(5.0)));
    }

    #[test]
    fn a_tip_that_nobody_knows_is_not_told() {
        let tip = |text: &str| {
            let mut fixture = Fixture::new("haas-mill", text);
            let view = state_at(&mut fixture.database, fixture.document, fixture.offset, &|| false);
            let side = view.unwrap().unwrap().before;
            (side.work.get(&'Z').copied(), side.programmed.get(&'Z').copied(), side.tip.get(&'Z').copied())
        };
        let other = "O1\nG21 G90 G54 G0 X1. Y2.\nT3 M6\nG43 H4 Z5.\n$0G1 Z-1. F100.\nM30\n";
        assert_eq!(tip(other), (Some(Some(5.0)), Some(Some(5.0)), Some(None)), "the length of another tool");
        let nobody = "O1\nG21 G90 G54 G0 X1. Y2.\nG43 H4 Z5.\n$0G1 Z-1. F100.\nM30\n";
        assert_eq!(tip(nobody).2, Some(None), "any tool");
        let tilted = "O1\nG20 G90 G54 T1 M6\nG0 X1. Y0. Z3. A0. B0.\nG143 H1 X1. Y0. Z3. A-15. B8.\n$0G1 X1.25 Z2. F20.\nM30\n";
        let (_, programmed, tip) = tip(tilted);
        assert_eq!((programmed, tip), (Some(Some(3.0)), Some(None)), "the posted length is not known");
    }

    #[test]
    fn tool_centre_point_control_keeps_the_tip_where_the_program_says() {
        let tip = |control: &str, code: &str, h: u32, machine: &Machine| {
            let text = format!(
                "O1\nG21 G90 G54\nT3 M6\nG0 X1. Y2. Z50. A0. C0.\n{code} H{h} X1. Y2. Z5.\nG1 X1. Y2. Z5. A30. C40. F100.\n$0G1 X7. F100.\nM30\n"
            );
            let mut settings = Settings::new(gcheck_controls::load(control).unwrap(), gcheck_rules::RULES);
            let mut facts = (*settings.machine).clone();
            facts.engine = machine.clone();
            settings.machine = Arc::new(facts);
            let mut fixture = Fixture::with(&text, &settings);
            let view = state_at(&mut fixture.database, fixture.document, fixture.offset, &|| false);
            let tip = view.unwrap().unwrap().before.tip;
            ['X', 'Y', 'Z'].map(|axis| tip.get(&axis).copied().flatten())
        };
        let axes = vec![Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C];
        let nothing_told = Machine { axes: Some(axes), ..Machine::default() };
        let tool = |length: f64| Tool {
            pocket: 0,
            offset: Position::ZERO.with_xyz([Mm::ZERO, Mm::ZERO, Mm(length)]),
            diameter: Mm::UNKNOWN,
            corner_radius: Mm::UNKNOWN,
            angles: [0.0; 2],
            orientation: 0,
        };
        let mut described = nothing_told.clone();
        described.tools.extend([(3, tool(80.0)), (4, tool(90.0))]);
        let mut with_table = described.clone();
        with_table.kinematics = Some(Kinematics {
            arrangement: Arrangement::TableTable,
            order: [RotaryAxis::A, RotaryAxis::C],
            sign: [-1.0, -1.0],
            inclined: [None; 2],
            pivot_length: None,
            offset: [Mm::ZERO; 3],
        });
        with_table.offsets.insert(1, WorkOffset { origin: Position::ZERO, rotation: 0.0 });
        for (control, code) in [("haas-mill", "G234"), ("fanuc-mill", "G43.4")] {
            for machine in [&nothing_told, &described, &with_table] {
                assert_eq!(tip(control, code, 3, machine), [Some(1.0), Some(2.0), Some(5.0)], "{code}");
            }
            // The length of another tool: nobody knows where the tip is, unless both lengths are told, and how the tool leans.
            assert_eq!(tip(control, code, 4, &nothing_told), [None; 3], "{code}");
            assert_eq!(tip(control, code, 4, &described), [None; 3], "{code}");
            let [x, y, z] = tip(control, code, 4, &with_table).map(|place| place.unwrap());
            let away = (x - 1.0).hypot(y - 2.0).hypot(z - 5.0);
            assert!((away - 10.0).abs() < 1e-5, "{code}: {x} {y} {z} is {away} away");
            assert!((z - 5.0 - 10.0 * 30.0_f64.to_radians().cos()).abs() < 1e-5, "{code}: {z}");
        }
    }

    #[test]
    #[expect(clippy::too_many_lines, reason = "a view has many parts")]
    fn modes_places_and_variables() {
        check(
            "haas-mill",
            "%\nO1\nG20 G90 G54 G0 X1. Y2.\n#100=2.5\nG1 X$03. F20.\nM30\n%\n",
            &expect![[r##"
                Some(
                    StateView {
                        line: 4,
                        start: 37,
                        end: 48,
                        on_every_path: true,
                        visits: 1,
                        assumed: None,
                        calls: [],
                        before: StateSide {
                            units: "inch",
                            diameter: false,
                            modes: [
                                ModeView {
                                    group: "motion",
                                    codes: [
                                        "G0",
                                    ],
                                    set_at: Some(
                                        5,
                                    ),
                                },
                                ModeView {
                                    group: "canned cycle",
                                    codes: [
                                        "G80",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "plane of arcs, rotation and compensation",
                                    codes: [
                                        "G17",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "absolute or incremental",
                                    codes: [
                                        "G90",
                                    ],
                                    set_at: Some(
                                        5,
                                    ),
                                },
                                ModeView {
                                    group: "meaning of F",
                                    codes: [
                                        "G94",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "inch or millimetre",
                                    codes: [
                                        "G20",
                                    ],
                                    set_at: Some(
                                        5,
                                    ),
                                },
                                ModeView {
                                    group: "cutter compensation",
                                    codes: [
                                        "G40",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "tool length compensation, tool center point control",
                                    codes: [
                                        "G49",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "height to return to in canned cycles",
                                    codes: [
                                        "G98",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "work offset",
                                    codes: [
                                        "G54",
                                    ],
                                    set_at: Some(
                                        5,
                                    ),
                                },
                                ModeView {
                                    group: "exact stop",
                                    codes: [
                                        "G64",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "scaling",
                                    codes: [
                                        "G50",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "rotation",
                                    codes: [
                                        "G69",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "mirror image, axis by axis",
                                    codes: [
                                        "G100",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "dynamic work offset",
                                    codes: [
                                        "G255",
                                    ],
                                    set_at: None,
                                },
                            ],
                            feed: None,
                            speed: None,
                            spindle: "spindle stopped",
                            tool: None,
                            tool_is: None,
                            surface_speed: None,
                            chip_load: None,
                            selected_tool: None,
                            length_offset: Some(
                                "0",
                            ),
                            cutter_offset: Some(
                                "0",
                            ),
                            work_offset: Some(
                                "G54",
                            ),
                            origin: {
                                'X': None,
                                'Y': None,
                                'Z': None,
                            },
                            programmed: {
                                'X': Some(
                                    1.0,
                                ),
                                'Y': Some(
                                    2.0,
                                ),
                                'Z': None,
                            },
                            work: {
                                'X': Some(
                                    1.0,
                                ),
                                'Y': Some(
                                    2.0,
                                ),
                                'Z': None,
                            },
                            machine: {
                                'X': None,
                                'Y': None,
                                'Z': None,
                            },
                            tip: {
                                'X': None,
                                'Y': None,
                                'Z': None,
                            },
                            length: {
                                'X': Some(
                                    0.0,
                                ),
                                'Y': Some(
                                    0.0,
                                ),
                                'Z': Some(
                                    0.0,
                                ),
                            },
                            shift: {
                                'X': Some(
                                    0.0,
                                ),
                                'Y': Some(
                                    0.0,
                                ),
                                'Z': Some(
                                    0.0,
                                ),
                            },
                            variables: [
                                VariableView {
                                    name: "#100",
                                    value: "2.5",
                                },
                            ],
                        },
                        after: Some(
                            StateSide {
                                units: "inch",
                                diameter: false,
                                modes: [
                                    ModeView {
                                        group: "motion",
                                        codes: [
                                            "G1",
                                        ],
                                        set_at: Some(
                                            37,
                                        ),
                                    },
                                    ModeView {
                                        group: "canned cycle",
                                        codes: [
                                            "G80",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "plane of arcs, rotation and compensation",
                                        codes: [
                                            "G17",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "absolute or incremental",
                                        codes: [
                                            "G90",
                                        ],
                                        set_at: Some(
                                            5,
                                        ),
                                    },
                                    ModeView {
                                        group: "meaning of F",
                                        codes: [
                                            "G94",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "inch or millimetre",
                                        codes: [
                                            "G20",
                                        ],
                                        set_at: Some(
                                            5,
                                        ),
                                    },
                                    ModeView {
                                        group: "cutter compensation",
                                        codes: [
                                            "G40",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "tool length compensation, tool center point control",
                                        codes: [
                                            "G49",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "height to return to in canned cycles",
                                        codes: [
                                            "G98",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "work offset",
                                        codes: [
                                            "G54",
                                        ],
                                        set_at: Some(
                                            5,
                                        ),
                                    },
                                    ModeView {
                                        group: "exact stop",
                                        codes: [
                                            "G64",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "scaling",
                                        codes: [
                                            "G50",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "rotation",
                                        codes: [
                                            "G69",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "mirror image, axis by axis",
                                        codes: [
                                            "G100",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "dynamic work offset",
                                        codes: [
                                            "G255",
                                        ],
                                        set_at: None,
                                    },
                                ],
                                feed: Some(
                                    "F20 inch/min",
                                ),
                                speed: None,
                                spindle: "spindle stopped",
                                tool: None,
                                tool_is: None,
                                surface_speed: None,
                                chip_load: None,
                                selected_tool: None,
                                length_offset: Some(
                                    "0",
                                ),
                                cutter_offset: Some(
                                    "0",
                                ),
                                work_offset: Some(
                                    "G54",
                                ),
                                origin: {
                                    'X': None,
                                    'Y': None,
                                    'Z': None,
                                },
                                programmed: {
                                    'X': Some(
                                        3.0,
                                    ),
                                    'Y': Some(
                                        2.0,
                                    ),
                                    'Z': None,
                                },
                                work: {
                                    'X': Some(
                                        3.0,
                                    ),
                                    'Y': Some(
                                        2.0,
                                    ),
                                    'Z': None,
                                },
                                machine: {
                                    'X': None,
                                    'Y': None,
                                    'Z': None,
                                },
                                tip: {
                                    'X': None,
                                    'Y': None,
                                    'Z': None,
                                },
                                length: {
                                    'X': Some(
                                        0.0,
                                    ),
                                    'Y': Some(
                                        0.0,
                                    ),
                                    'Z': Some(
                                        0.0,
                                    ),
                                },
                                shift: {
                                    'X': Some(
                                        0.0,
                                    ),
                                    'Y': Some(
                                        0.0,
                                    ),
                                    'Z': Some(
                                        0.0,
                                    ),
                                },
                                variables: [
                                    VariableView {
                                        name: "#100",
                                        value: "2.5",
                                    },
                                ],
                            },
                        ),
                    },
                )
            "##]],
        );
    }

    #[test]
    #[expect(clippy::too_many_lines, reason = "a view has many parts")]
    fn a_lathe_in_diameters() {
        check(
            "haas-lathe",
            "O1\nG20 G54 T0101\nG0 X2. Z.1\nG1 X1.$0 F.01\nM30\n",
            &expect![[r#"
                Some(
                    StateView {
                        line: 3,
                        start: 28,
                        end: 39,
                        on_every_path: true,
                        visits: 1,
                        assumed: None,
                        calls: [],
                        before: StateSide {
                            units: "inch",
                            diameter: true,
                            modes: [
                                ModeView {
                                    group: "motion, with the box cycles",
                                    codes: [
                                        "G0",
                                    ],
                                    set_at: Some(
                                        17,
                                    ),
                                },
                                ModeView {
                                    group: "drilling and tapping cycles",
                                    codes: [
                                        "G80",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "plane of arcs and compensation",
                                    codes: [
                                        "G18",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "absolute or incremental positions",
                                    codes: [
                                        "G390",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "feed per minute or per revolution",
                                    codes: [
                                        "G99",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "units",
                                    codes: [
                                        "G20",
                                    ],
                                    set_at: Some(
                                        3,
                                    ),
                                },
                                ModeView {
                                    group: "tool nose compensation",
                                    codes: [
                                        "G40",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "tool length compensation",
                                    codes: [
                                        "G49",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "work offset",
                                    codes: [
                                        "G54",
                                    ],
                                    set_at: Some(
                                        3,
                                    ),
                                },
                                ModeView {
                                    group: "exact stop",
                                    codes: [
                                        "G64",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "surface speed or rpm",
                                    codes: [
                                        "G97",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "X as radius or diameter",
                                    codes: [
                                        "G170",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "scaling",
                                    codes: [
                                        "G250",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "rotation",
                                    codes: [
                                        "G69",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "mirror image, axis by axis",
                                    codes: [
                                        "G100",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "XY to XC interpolation",
                                    codes: [
                                        "G113",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "dynamic work offset",
                                    codes: [
                                        "G255",
                                    ],
                                    set_at: None,
                                },
                                ModeView {
                                    group: "tilted plane",
                                    codes: [
                                        "G269",
                                    ],
                                    set_at: None,
                                },
                            ],
                            feed: None,
                            speed: None,
                            spindle: "spindle stopped",
                            tool: Some(
                                "1",
                            ),
                            tool_is: None,
                            surface_speed: None,
                            chip_load: None,
                            selected_tool: Some(
                                "1",
                            ),
                            length_offset: Some(
                                "1",
                            ),
                            cutter_offset: Some(
                                "1",
                            ),
                            work_offset: Some(
                                "G54",
                            ),
                            origin: {
                                'X': None,
                                'Z': None,
                            },
                            programmed: {
                                'X': Some(
                                    2.0,
                                ),
                                'Z': Some(
                                    0.1,
                                ),
                            },
                            work: {
                                'X': Some(
                                    2.0,
                                ),
                                'Z': Some(
                                    0.1,
                                ),
                            },
                            machine: {
                                'X': None,
                                'Z': None,
                            },
                            tip: {
                                'X': None,
                                'Z': None,
                            },
                            length: {
                                'X': None,
                                'Z': None,
                            },
                            shift: {
                                'X': Some(
                                    0.0,
                                ),
                                'Z': Some(
                                    0.0,
                                ),
                            },
                            variables: [],
                        },
                        after: Some(
                            StateSide {
                                units: "inch",
                                diameter: true,
                                modes: [
                                    ModeView {
                                        group: "motion, with the box cycles",
                                        codes: [
                                            "G1",
                                        ],
                                        set_at: Some(
                                            28,
                                        ),
                                    },
                                    ModeView {
                                        group: "drilling and tapping cycles",
                                        codes: [
                                            "G80",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "plane of arcs and compensation",
                                        codes: [
                                            "G18",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "absolute or incremental positions",
                                        codes: [
                                            "G390",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "feed per minute or per revolution",
                                        codes: [
                                            "G99",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "units",
                                        codes: [
                                            "G20",
                                        ],
                                        set_at: Some(
                                            3,
                                        ),
                                    },
                                    ModeView {
                                        group: "tool nose compensation",
                                        codes: [
                                            "G40",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "tool length compensation",
                                        codes: [
                                            "G49",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "work offset",
                                        codes: [
                                            "G54",
                                        ],
                                        set_at: Some(
                                            3,
                                        ),
                                    },
                                    ModeView {
                                        group: "exact stop",
                                        codes: [
                                            "G64",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "surface speed or rpm",
                                        codes: [
                                            "G97",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "X as radius or diameter",
                                        codes: [
                                            "G170",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "scaling",
                                        codes: [
                                            "G250",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "rotation",
                                        codes: [
                                            "G69",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "mirror image, axis by axis",
                                        codes: [
                                            "G100",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "XY to XC interpolation",
                                        codes: [
                                            "G113",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "dynamic work offset",
                                        codes: [
                                            "G255",
                                        ],
                                        set_at: None,
                                    },
                                    ModeView {
                                        group: "tilted plane",
                                        codes: [
                                            "G269",
                                        ],
                                        set_at: None,
                                    },
                                ],
                                feed: Some(
                                    "F0.01 inch/rev",
                                ),
                                speed: None,
                                spindle: "spindle stopped",
                                tool: Some(
                                    "1",
                                ),
                                tool_is: None,
                                surface_speed: None,
                                chip_load: None,
                                selected_tool: Some(
                                    "1",
                                ),
                                length_offset: Some(
                                    "1",
                                ),
                                cutter_offset: Some(
                                    "1",
                                ),
                                work_offset: Some(
                                    "G54",
                                ),
                                origin: {
                                    'X': None,
                                    'Z': None,
                                },
                                programmed: {
                                    'X': Some(
                                        1.0,
                                    ),
                                    'Z': Some(
                                        0.1,
                                    ),
                                },
                                work: {
                                    'X': Some(
                                        1.0,
                                    ),
                                    'Z': Some(
                                        0.1,
                                    ),
                                },
                                machine: {
                                    'X': None,
                                    'Z': None,
                                },
                                tip: {
                                    'X': None,
                                    'Z': None,
                                },
                                length: {
                                    'X': None,
                                    'Z': None,
                                },
                                shift: {
                                    'X': Some(
                                        0.0,
                                    ),
                                    'Z': Some(
                                        0.0,
                                    ),
                                },
                                variables: [],
                            },
                        ),
                    },
                )
            "#]],
        );
    }

    #[test]
    fn what_no_path_comes_to_has_no_state() {
        check(
            "haas-mill",
            "O1\nM30\nG0 X$01.\nM30\n",
            &expect![[r#"
            None
        "#]],
        );
        check(
            "haas-mill",
            "$0",
            &expect![[r#"
            None
        "#]],
        );
    }

    /// What `of` shows of the state after the block.
    fn after(control: &str, text: &str, of: impl Fn(&super::StateSide) -> String) -> Option<String> {
        let mut fixture = Fixture::new(control, text);
        let view = state_at(&mut fixture.database, fixture.document, fixture.offset, &|| false).unwrap();
        view.and_then(|view| view.after).map(|after| of(&after))
    }

    fn x(side: &super::StateSide) -> String {
        format!("{:?} {:?}", side.work.get(&'X'), side.feed)
    }

    #[test]
    fn after_a_call_is_where_it_is_back() {
        for call in ["M98 P2", "M98 P2 L3", "G65 P2", "G65 P2 L3"] {
            let text =
                format!("O1\nG20 G90 G54 G0 X1.\n$0{call}\nG0 Z1.\nM30\nO2\nG91 G1 X1. F5.\nG90\nM99\n");
            let expected = if call.ends_with("L3") {
                "Some(Some(4.0)) Some(\"F5 inch/min\")"
            } else {
                "Some(Some(2.0)) Some(\"F5 inch/min\")"
            };
            assert_eq!(after("haas-mill", &text, x).as_deref(), Some(expected), "{call}");
        }
        let text = "O1\nG20 G90 G54 G0 X1.\n$0M97 P10 L2\nG0 Z1.\nM30\nN10 G91 G1 X1. F5.\nG90 M99\n";
        assert_eq!(after("haas-mill", text, x).as_deref(), Some("Some(Some(3.0)) Some(\"F5 inch/min\")"));
        let text = "o1 sub\ng1 x[#1] f5\no1 endsub\ng21 g90 g54 g0 x1\n$0o1 call [7]\ng0 z1\nm2\n";
        assert_eq!(after("linuxcnc", text, x).as_deref(), Some("Some(Some(7.0)) Some(\"F5 mm/min\")"));
        // What never comes back has no state after it.
        assert_eq!(after("haas-mill", "O1\nG0 X1.\n$0M98 P2\nG0 Z1.\nM30\nO2\nM30\n", x), None);
    }

    #[test]
    fn the_end_of_the_program_sets_the_modes_of_power_on() {
        let distance = |side: &super::StateSide| {
            let mode = side.modes.iter().find(|mode| mode.group == "absolute or incremental").unwrap();
            format!("{:?} {:?}", mode.codes, mode.set_at)
        };
        for end in ["M30", "M2"] {
            let text = format!("G20 G90\nG91 G0 X1.\n$0{end}\n");
            assert_eq!(after("haas-mill", &text, distance).as_deref(), Some("[\"G90\"] Some(19)"), "{end}");
        }
    }
}
