//! What the execution engine must know of a control: the effect of each code, and where controls read one thing two ways.
//!
//! Knows: the closed vocabulary of effects, the choices of `execution.toml`. Must not know: how an effect is carried out
//! (`gcheck-engine`), or which control makes which choice (data).

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::bar_feeder::BarFeederRules;
use crate::motion::MotionRules;
use crate::schema::Confidence;

/// `execution.toml`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct ExecutionFile {
    /// By code: `G1 = "linear"`, `G55 = { work-offset = 2 }`. A code of a base is replaced, or taken away with `"none"`.
    #[serde(default)]
    pub(crate) effects: BTreeMap<String, Effect>,
    #[serde(default)]
    pub(crate) semantics: Option<Semantics>,
    #[serde(default)]
    pub(crate) motion: Option<MotionRules>,
    #[serde(default, rename = "lasting")]
    pub(crate) lasting: Vec<LastingWords>,
}

/// Words that stay in effect after their block, and the codes that they stay for.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LastingWords {
    /// The addresses, one letter after the other: `"RZQ"`.
    pub letters: String,
    /// Modal groups whose codes use the last word: those with `need = "modal"`.
    pub groups: Vec<String>,
    /// Which blocks may give it.
    pub from: LastingFrom,
    /// What makes the control forget it.
    #[serde(default)]
    pub until: Vec<LastingEnd>,
    /// Its source.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// Which blocks may give a word that stays in effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LastingFrom {
    /// Every block, also one without a code that reads it.
    AnyBlock,
    /// A block with a code of the groups, or one that repeats it while it is on.
    OwnCodes,
}

/// What ends the effect of a word that stays in effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LastingEnd {
    /// The code that cancels the group: `G80`.
    Cancel,
    /// The end of the program.
    ProgramEnd,
}

/// Which stroke a cycle along the tool makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the names are those of the cycles along an axis, in `Effect`")]
pub enum AlongTool {
    Drill,
    DrillDwell,
    Peck,
    ChipBreak,
    Tap,
    LeftTap,
    BoreFeedOut,
    BoreStop,
    BoreDwell,
}

impl AlongTool {
    /// The cycle along an axis that makes the same stroke.
    pub const fn upright(self) -> Effect {
        match self {
            Self::Drill => Effect::CycleDrill,
            Self::DrillDwell => Effect::CycleDrillDwell,
            Self::Peck => Effect::CyclePeck,
            Self::ChipBreak => Effect::CycleChipBreak,
            Self::Tap => Effect::CycleTap,
            Self::LeftTap => Effect::CycleLeftTap,
            Self::BoreFeedOut => Effect::CycleBoreFeedOut,
            Self::BoreStop => Effect::CycleBoreStop,
            Self::BoreDwell => Effect::CycleBoreDwell,
        }
    }
}

/// What a code does to the machine's state. A code without an effect changes nothing that the engine follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the names are the field's own terms; those that are not carry a comment")]
pub enum Effect {
    /// Nothing that the engine follows.
    None,

    // Interpolation.
    Rapid,
    Linear,
    ArcClockwise,
    ArcCounterClockwise,
    Dwell,
    SplineCubic,
    SplineQuadratic,
    NurbsOpen,
    NurbsClose,
    /// Feed tied to the spindle's angle (`G33`, lathe `G32`).
    Thread,
    /// Thread in and, with the spindle reversed, out again (`G33.1`).
    RigidTap,
    /// Taps from the tool's position to the block's point and back, the control turning the spindle (`G184` of mills).
    TapHere,
    /// The same with a left-hand thread (`G174`).
    LeftTapHere,
    /// Toward the work, contact required (`G38.2`).
    ProbeToward,
    /// Toward the work, no contact is not a fault (`G38.3`).
    ProbeTowardOptional,
    ProbeAway,
    ProbeAwayOptional,
    /// Feed until a skip signal, contact or not (`G31`).
    Skip,
    /// Measures a tool's diameter (`G35`).
    ProbeDiameter,
    /// Sets a work offset from one touch (`G36`).
    ProbeOffset,
    /// Sets a tool length from a touch (`G37`).
    ProbeLength,
    /// Sets a work offset between two touches (`G136`).
    ProbeCentre,
    /// Keeps the first touch for a two-touch measurement (`M75`).
    KeepTouch,
    /// An alarm when the probe touched (`M78`): after its block it has not.
    AlarmIfTouched,
    /// An alarm when the probe did not touch (`M79`).
    AlarmIfNotTouched,

    // Canned cycles that stay on.
    CycleDrill,
    CycleDrillDwell,
    CyclePeck,
    CycleChipBreak,
    CycleTap,
    CycleLeftTap,
    CycleBoreFeedOut,
    CycleBoreStop,
    CycleBackBore,
    CycleBoreManual,
    CycleBoreDwellManual,
    CycleBoreDwell,
    CycleFineBore,
    /// Along the tool at any angle, depth in `E`.
    CycleAlongTool(AlongTool),
    CycleCancel,

    // Turning.
    TurningPass,
    ThreadingPass,
    FacingPass,
    ThreadCycle,
    FinishProfile,
    RoughAlongZ,
    RoughAlongX,
    RepeatPattern,
    GrooveFace,
    GrooveDiameter,

    // Operations of one block.
    CircularPocketClockwise,
    CircularPocketCounterClockwise,
    GeneralPocket,
    BoltCircle,
    BoltArc,
    BoltLine,
    Engrave,
    BarFeed,

    // Positions and offsets.
    /// Return to reference position 1 (`G28`), 2 (`G30`).
    ReturnReference(u8),
    ReturnFromReference,
    StoreReference(u8),
    MachineCoordinates,
    WriteOffsets,
    LocalShift,
    /// The present position gets the words' coordinates (`G92` of mills).
    SetPosition,
    /// Lathe `G50`, `G92`: a spindle speed limit with S, else coordinates of the present position.
    SpeedLimitOrSetPosition,
    ClearShift,
    SuspendShift,
    RestoreShift,
    /// Work coordinate system n, counted from 1 (`G54` = 1).
    WorkOffset(u16),
    /// Work coordinate system by `P`; the number is that of `P1` (7 where `G54`–`G59` come first).
    WorkOffsetByP(u16),

    // Modes.
    PlaneXy,
    PlaneZx,
    PlaneYz,
    /// A plane of U, V, W.
    PlaneSecondary,
    Absolute,
    Incremental,
    ArcCentreAbsolute,
    ArcCentreIncremental,
    FeedInverseTime,
    FeedPerMinute,
    FeedPerRevolution,
    Inch,
    Millimetre,
    DiameterOn,
    DiameterOff,
    CompensationOff,
    CompensationLeft,
    CompensationRight,
    /// `D` is a diameter, not an offset number (`G41.1`).
    CompensationLeftByDiameter,
    CompensationRightByDiameter,
    /// Along a vector I J K (`G141`).
    CompensationVector,
    LengthOff,
    LengthPlus,
    LengthMinus,
    /// Offsets are in the block (`G43.1`).
    LengthFromBlock,
    /// Adds to the offsets in effect (`G43.2`).
    LengthAdd,
    /// Along the tool axis of two rotary axes (`G143`).
    LengthFiveAxis,
    ToolCentrePoint,
    ReturnToInitial,
    ReturnToR,
    ExactPath,
    ExactStop,
    PathBlending,
    /// A stop at the end of the block's move (`G9`).
    ExactStopOnce,
    /// How exactly corners are taken: a level in `P`, a tolerance in `E` (`G187`).
    Smoothing,
    /// Looking ahead on command: on or off by `Q`, a level in `R` (`G5.1`).
    ContourControl,
    /// Looking ahead on command: on or off by `P` (`G8`).
    LookAheadControl,
    SurfaceSpeed,
    ConstantSpeed,
    ScalingOn,
    ScalingOff,
    RotationOn,
    RotationOff,
    MirrorOn,
    MirrorOff,
    PolarOn,
    PolarOff,
    CylinderMapping,
    /// XY programmed, XC moved (`G112`, `G12.1`).
    PolarInterpolationOn,
    PolarInterpolationOff,
    DynamicOffsetOn,
    DynamicOffsetOff,
    TiltedPlaneOn,
    TiltedPlaneOff,
    /// The rotary axes turn the tool square to the plane in effect.
    SquareToPlane,

    // Programs.
    MacroCall,
    MacroModal,
    MacroModalOff,
    CallProgram,
    CallLocal,
    Return,
    /// Jump to `P` when an input is off (`M96`).
    JumpUnlessInput,
    Stop,
    OptionalStop,
    PalletStop,
    ProgramEnd,
    /// Program end with an exchange of pallets.
    ProgramEndWithPallet,
    SaveModes,
    ForgetModes,
    RestoreModes,
    SaveModesUntilReturn,
    /// A program outside the control's own (`M100` to `M199`).
    UserCommand,
    /// Puts the operator's answer into the variable of `P` (`M109`).
    AskOperator,

    // Spindle, tool, coolant, inputs and outputs.
    SpindleClockwise,
    SpindleCounterClockwise,
    SpindleClockwiseWithCoolant,
    SpindleCounterClockwiseWithCoolant,
    SpindleStop,
    SpindleOrient,
    /// The turning tool's own spindle.
    LiveToolOn,
    LiveToolOff,
    ToolChange,
    SetToolNumber,
    /// The changer turns to `T`, and no tool is changed (`M39`).
    TurnCarousel,
    MistOn,
    FloodOn,
    ThroughCoolantOn,
    ThroughCoolantOff,
    CoolantOff,
    OverridesOn,
    OverridesOff,
    FeedOverride,
    SpeedOverride,
    AdaptiveFeed,
    FeedStopInput,
    OutputOnWithMove,
    OutputOffWithMove,
    OutputOn,
    OutputOff,
    WaitForInput,
    AnalogOutputWithMove,
    AnalogOutput,
    ChuckClamp,
    ChuckUnclamp,
    /// The chuck of a second spindle. The state does not follow it.
    SecondChuckClamp,
    SecondChuckUnclamp,
}

/// Where controls read one thing two ways.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent yes/no facts of a control, named one by one in data"
)]
pub struct Semantics {
    /// Blocks whose words and codes do not fit together are refused, before anything of them acts.
    #[serde(default)]
    pub strict: bool,
    /// What a strict control refuses beside what its codes, addresses and block rules say, and when.
    #[serde(default)]
    pub refusals: Refusals,
    /// What a variable holds that was never set.
    pub unset: Unset,
    /// How `FIX` and `FUP` round.
    pub fix: Fix,
    /// `AND`, `OR`, `XOR` work on bits of whole numbers; else on zero and not zero.
    pub logic_on_bits: bool,
    /// Numbers closer than this are equal to `EQ` and `NE`; the other comparisons are exact.
    pub equal_within: f64,
    /// `ATAN[a]` may be alone; else it needs `/[b]` after it.
    pub atan_alone: bool,
    /// A value that no decimal point follows, computed from an expression, counts as with a point.
    pub computed_words_are_pointed: bool,
    /// A computed count (an offset, a tool, repeats) is rounded to a whole number; else a fraction is refused.
    #[serde(default)]
    pub computed_counts_round: bool,
    /// Inverse time is asked for where two rotary axes turn in a cut of linear ones; the manual and page that say so.
    #[serde(default)]
    pub inverse_time_for_five_axes: Option<String>,
    /// A computed length or angle is rounded to the least that the control resolves.
    #[serde(default)]
    pub computed_lengths_round: bool,
    /// Assignments of a block act after all its values are read.
    pub assignments_after_block: bool,
    /// The letters of a macro call's arguments, by local variable: `{ A = 1, B = 2, … }`.
    #[serde(default)]
    pub argument_letters: BTreeMap<String, u8>,
    /// Letters whose argument of a macro call counts as it is written where it has no decimal point: `"DEF"`. The others
    /// then count least increments of length. Without this every letter counts as it does elsewhere.
    #[serde(default)]
    pub whole_arguments: Option<String>,
    /// An `M` after a macro call in its block is an argument, and the control does not execute it as a code.
    #[serde(default)]
    pub m_is_argument: bool,
    /// Variables that have a second number each.
    #[serde(default)]
    pub mirrored_variables: Vec<MirroredVariables>,
    /// Words act before a condition or a jump that is after them in the block; an unconditional jump acts last of all. Else
    /// the control does not read words beside a jump.
    #[serde(default)]
    pub words_before_conditions: bool,
    /// Local variables: first and last number; empty range when none.
    pub locals: [u32; 2],
    /// A call of a numbered subprogram (`M98`) gets its own local variables.
    pub locals_per_subprogram: bool,
    /// What `M99 P` does in a subprogram.
    pub return_to: ReturnTo,
    /// The word that repeats a call.
    pub call_repeats: Option<char>,
    /// The word that repeats a cut (`G1`, `G2`, `G3`): under increments each goes on from the last.
    #[serde(default)]
    pub cut_repeats: Option<char>,
    /// `L0` calls nothing; else it calls once.
    pub zero_repeats_skip: bool,
    /// A code that sets the position adds what the addresses of increments say (`G50 W-5.`); else what they do is not known.
    #[serde(default)]
    pub increments_set_position: bool,
    /// Loops (`DO`) nest this deep in one program.
    #[serde(default)]
    pub loop_depth: Option<u8>,
    /// Circles: how far start and end radius may differ, and what else is refused.
    pub arcs: ArcRules,
    /// Arcs that leave their plane.
    #[serde(default)]
    pub helix: HelixRules,
    /// A new feed mode forgets the feed.
    pub feed_mode_clears_feed: bool,
    /// Outputs that variables show: variable number of output 0.
    #[serde(default)]
    pub output_variables: Option<u32>,
    /// Settings that variables show: variable number of setting 0.
    #[serde(default)]
    pub setting_variables: Option<u32>,
    /// The setting by which coolant codes are refused (`off`) or passed over (`ignore`).
    #[serde(default)]
    pub coolant_setting: Option<String>,
    /// The setting under which increments (`G91`) hold for their own block only.
    #[serde(default)]
    pub increments_of_block_setting: Option<String>,
    /// Where a setting may demand that `H` is the number of the tool in the spindle.
    #[serde(default)]
    pub length_agreement: Option<LengthAgreement>,
    /// A stop of the program (`M0`), and an optional one that is carried out, stops the spindle and all coolant.
    #[serde(default)]
    pub stop_switches_off: bool,
    /// The setting under which optional stops are never carried out.
    #[serde(default)]
    pub optional_stop_lock: Option<String>,
    /// The code that ends coolant through the spindle stops the spindle.
    #[serde(default)]
    pub through_off_stops_spindle: bool,
    /// `P` of a code that orients the spindle is the angle in degrees; else it is the way there, and the angle is `R`.
    #[serde(default)]
    pub orients_to_p: bool,
    /// Under inverse time no move is slower than this, in the program's units a minute.
    #[serde(default)]
    pub least_inverse_feed: f64,
    /// The fastest feed that the manual lets a probing move have.
    #[serde(default)]
    pub probe_feed: Option<ProbeFeed>,
    /// Outputs that switch the probes on and off.
    #[serde(default)]
    pub probe_outputs: Option<ProbeOutputs>,
    /// Codes that `M2` and `M30` bring into effect.
    #[serde(default)]
    pub at_end: Vec<String>,
    /// The alarm of a called program that runs to the end of the text without a return.
    #[serde(default)]
    pub missing_return_alarm: Option<String>,
    /// The setting that keeps what is in effect at the end of the program while it is off, where one does.
    #[serde(default)]
    pub at_end_setting: Option<String>,
    /// The setting against which the codes of units are checked: a code of the other unit is an alarm.
    #[serde(default)]
    pub units_setting: Option<String>,
    /// `ATAN` takes one number: a slash after it divides the angle.
    #[serde(default)]
    pub atan_takes_one: bool,
    /// Codes active at power-on beside the groups' defaults.
    #[serde(default)]
    pub at_start: Vec<String>,
    /// The end of the program, and power-on, clear the feed.
    pub end_clears_feed: bool,
    /// Canned cycles.
    pub cycles: CycleRules,
    /// Cutter compensation.
    pub compensation: CompensationRules,
    /// The settings of scaling, rotation and mirrors.
    #[serde(default)]
    pub transform_settings: TransformSettings,
    /// How tools are called and measured.
    pub tools: ToolRules,
    /// Cylindrical mapping that wraps a linear axis, by the words of its code; where a word for the rotary axis holds the
    /// radius, there is none.
    #[serde(default)]
    pub cylinder: Option<CylinderRules>,
    /// Addresses that are increments of an axis whatever the mode: `{ U = "X", W = "Z" }`.
    #[serde(default)]
    pub increments: BTreeMap<String, String>,
    /// X counts diameters at power-on.
    pub diameter: bool,
    /// How polar interpolation reads words, where it is known.
    #[serde(default)]
    pub polar_interpolation: Option<PolarInterpolationRules>,
    /// The code of a tilted plane gives its origin and three Euler angles.
    #[serde(default)]
    pub tilted_plane_by_euler_angles: bool,
    /// The settings that hold where the axes of a table meet: machine coordinates X, Y and Z.
    #[serde(default)]
    pub rotary_centre_settings: Option<[String; 3]>,
    /// What a feed per minute counts where rotary axes move; without it the books do not say.
    #[serde(default)]
    pub feed_with_rotary: Option<FeedWithRotary>,
    /// What `G52` and `G92` are to each other.
    pub local_shift: LocalShift,
    /// The setting that decides whether the end of a program clears the shift of `G52`, with the values that do.
    #[serde(default)]
    pub shift_cleared_at_end: Option<crate::SettingValues>,
    /// A work offset may hold a rotation in XY: `R` of `G10 L2`, degrees.
    #[serde(default)]
    pub work_offsets_rotate: bool,
    /// A reference return (`G28`) without axis words returns all axes.
    pub reference_without_axes: bool,
    /// The first reference position is the machine's zero, from which `G53` counts.
    #[serde(default)]
    pub reference_at_zero: bool,
    /// A reference return cancels tool length compensation.
    #[serde(default)]
    pub reference_cancels_length: bool,
    /// `H0` ends length compensation also in a block without a code for it.
    #[serde(default)]
    pub zero_length_number_cancels: bool,
    /// `G53` moves in rapid whatever motion is in effect; else as `G0` or `G1` in effect says, and not under another one.
    pub machine_coordinates_rapid: bool,
    /// `G53` beside a probing code reads the limit of its move in machine coordinates.
    #[serde(default)]
    pub machine_coordinates_in_probing: bool,
    /// Codes whose blocks have words in millimetres and as distances, whatever unit and distance mode are in effect. A later block
    /// that goes on with the motion without naming the code reads its words as usual.
    #[serde(default)]
    pub millimetre_distances: Vec<String>,
    /// Dwell words: letter to kind.
    pub dwell: BTreeMap<String, DwellWord>,
    /// Computed jumps and `GOTO` look forward first, then from the head of the program.
    #[serde(default)]
    pub goto_forward_first: bool,
    /// Commands to the firmware after which the axes are elsewhere, by what follows the `$`: homing (`H`), jogging (`J=`).
    #[serde(default)]
    pub commands_that_move: Vec<String>,
    /// Comments that are shown to the operator, by the word that they begin with: `(MSG, …)`.
    #[serde(default)]
    pub message_comments: BTreeMap<String, MessageComment>,
    /// System variables that the engine computes: first number of a row of axes or a single one.
    #[serde(default)]
    pub system_variables: Vec<SystemVariable>,
    /// The variables of a bar feeder, where the control commands one.
    #[serde(default)]
    pub bar_feeder: Option<BarFeederRules>,
    /// Its source.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// What a feed per minute counts where rotary axes move. Where only they move it counts degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeedWithRotary {
    /// The way of the linear axes; the rotary ones come along.
    LinearAxes,
    /// The way of all axes together, with a degree for each millimetre or inch.
    AllAxes,
}

/// A setting under which the control refuses the length of another tool than the one in the spindle; zero is allowed.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LengthAgreement {
    /// The setting, `on` or `off`.
    pub setting: String,
    /// The alarm that the control raises.
    pub alarm: String,
}

impl Semantics {
    /// The number under which a variable is kept: the first of those that name it.
    pub fn kept_as(&self, number: u32) -> u32 {
        let of = |row: &MirroredVariables| {
            let place = number.checked_sub(row.at).filter(|place| *place < row.count);
            place.map(|place| row.first + place)
        };
        self.mirrored_variables.iter().find_map(of).unwrap_or(number)
    }
}

/// The outputs that choose a probe and switch it on and off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProbeOutputs {
    /// Chooses the probe on the table, which measures tools, in place of the one in the spindle.
    pub table: u32,
    /// Switches the chosen probe on.
    pub on: u32,
}

/// The fastest feed of a probing move, in the units of the program a minute.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ProbeFeed {
    /// Inches a minute, in an inch program.
    pub inch: f64,
    /// Millimetres a minute, in a metric program.
    pub mm: f64,
}

/// Variables that have a second number each: both name one value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct MirroredVariables {
    /// First number.
    pub first: u32,
    /// How many.
    pub count: u32,
    /// The second number of the first of them.
    pub at: u32,
}

/// What a strict control refuses beside what its codes, addresses and block rules say, and when.
///
/// Letters follow each other: `"IJ"`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Refusals {
    /// By code: words that are judged (given, alone, in range) only when the code acts, so that earlier parts of the block
    /// have acted by then. All others are judged before the block.
    #[serde(default)]
    pub late_words: BTreeMap<String, String>,
    /// By code: words that the block must have when it begins, but whose value is judged when the code acts, or not at
    /// all.
    #[serde(default)]
    pub late_values: BTreeMap<String, String>,
    /// By code: words that newer versions of the control read, and the one followed here does not.
    #[serde(default)]
    pub newer_words: BTreeMap<String, String>,
    /// Codes that are read only where they open the block.
    #[serde(default)]
    pub first_only: Vec<String>,
    /// By address: addresses beside which it is allowed though no code reads it.
    #[serde(default)]
    pub beside: BTreeMap<String, String>,
    /// Axes of a machine that nobody described; all of the control's when not given.
    #[serde(default)]
    pub axes: Option<String>,
    /// The setting that says how many spindles a machine has; any number when not given.
    #[serde(default)]
    pub spindles: Option<String>,
    /// The highest number of a variable.
    #[serde(default)]
    pub last_variable: Option<u32>,
}

/// What a variable holds that was never set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Unset {
    /// Nothing: a word with it is left out.
    Vacant,
    /// Zero.
    Zero,
}

/// How `FIX` and `FUP` round.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fix {
    /// Toward zero, away from zero.
    Magnitude,
    /// Down, up.
    NumberLine,
}

/// What `M99 P` does in a subprogram.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ReturnTo {
    /// Returns, and goes on at block `P` of the caller.
    Caller,
    /// Jumps to block `P` of the same program, without returning.
    Same,
    /// The word is not read.
    Ignored,
}

/// How circles are judged. Lengths in millimetres.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent yes/no facts of a control, named one by one in data"
)]
pub struct ArcRules {
    /// Start and end radius may differ by this much…
    pub radius_difference: f64,
    /// …and by more if the difference is below this part of the radius…
    #[serde(default)]
    pub relative: f64,
    /// …but never by more than this many times the first.
    #[serde(default = "one")]
    pub hard_factor: f64,
    /// Under inch units the difference may be this many times as large: its figure is a round number of the unit.
    #[serde(default = "one")]
    pub inch_factor: f64,
    /// Half the chord may be longer than `R` by this much.
    pub radius_slack: f64,
    /// A radius below this is zero.
    pub zero_radius: f64,
    /// `P` counts turns.
    pub turns: bool,
    /// `P0` is one turn as well; else it is refused.
    #[serde(default)]
    pub zero_turns: bool,
    /// Centre words beside `R`: `R` wins, else refused.
    pub radius_wins: bool,
    /// The centre word of the axis across the plane is passed over where other centre words stand, else refused.
    #[serde(default)]
    pub passes_over_across: bool,
    /// Without centre and radius the move is straight, unless this setting says `alarm`; refused where no setting is named.
    #[serde(default)]
    pub straight_setting: Option<String>,
    /// A chamfer or rounding is between two straight cuts in two directions: an arc does not end it, nor does a cut that goes
    /// straight on.
    #[serde(default)]
    pub corner_needs_lines: bool,
    /// How sure it is that a full circle by `R` is refused; without it, as sure as the tolerances are.
    #[serde(default)]
    pub full_circle_confidence: Option<Confidence>,
    /// How sure the tolerances are.
    pub confidence: Confidence,
}

impl ArcRules {
    /// How sure it is that a full circle by `R` is refused.
    pub fn full_circle_confidence(&self) -> Confidence {
        self.full_circle_confidence.unwrap_or(self.confidence)
    }
}

/// Arcs that leave their plane.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct HelixRules {
    /// What `F` is measured along.
    #[serde(default)]
    pub feed: HelixFeed,
    /// The setting that decides it, by number, where one does; it is worded as the values of `feed`.
    #[serde(default)]
    pub setting: Option<String>,
}

/// What the feed of a helix is measured along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HelixFeed {
    /// The path of the tool, the way along the normal included.
    #[default]
    Path,
    /// Its circle in the plane: the tool itself is faster.
    Circle,
}

/// How canned cycles move. Lengths in millimetres.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent yes/no facts of a control, named one by one in data"
)]
pub struct CycleRules {
    /// The letter that repeats a cycle: `L`, `K`.
    pub repeat: char,
    /// With no repeats (`L0`) the tool goes to the place of the hole at rapid, without the hole; else it stays where it is.
    #[serde(default)]
    pub zero_repeats_move: bool,
    /// Peck drilling goes back to this far above the last depth.
    pub peck_clearance: f64,
    /// Chip breaking backs off by this much.
    pub chip_break_retract: f64,
    /// A motion code of another group ends a cycle, and the other way round.
    pub motion_ends_cycle: bool,
    /// A block without axis words runs the cycle only when it names the code.
    pub needs_axis: bool,
    /// Cycles work in all planes; else only in XY.
    pub all_planes: bool,
    /// In `G91` `R` counts from the starting level, `Z` from `R`.
    pub incremental_r: bool,
    /// A cycle whose R lies above the tool first rises to R.
    pub rise_to_r: bool,
    /// Tapping needs a turning spindle before.
    pub tap_needs_spindle: bool,
    /// Cycles of live tools across the spindle's axis: they drill along X, whatever the plane.
    #[serde(default)]
    pub across: Vec<String>,
    /// `R` is a distance from the level at which the cycle begins, along X a radius; else it is a level.
    #[serde(default)]
    pub r_is_distance: bool,
    /// Moves that the outline of a pocket may have, where a book gives a number.
    #[serde(default)]
    pub pocket_moves: Option<u32>,
    /// The setting with the distance that pecks back off, and go in again above the last depth.
    #[serde(default)]
    pub clearance_setting: Option<String>,
    /// The setting with the distance above `R` that pecks come out to.
    #[serde(default)]
    pub above_r_setting: Option<String>,
    /// The setting with the direction (`x+`) in which `Q` takes a fine or back bore off the wall; `Q` then counts before
    /// `I` and `J`. Without one `I` and `J` count first, and `Q` goes along the plane's first axis.
    #[serde(default)]
    pub shift_setting: Option<String>,
    /// A fine or back bore without `Q`, `I` and `J` does not shift; else it is refused.
    #[serde(default)]
    pub shift_optional: bool,
    /// `J` of a tap is how many times faster it comes out than it goes in; this is the setting that counts without `J`.
    #[serde(default)]
    pub tap_out_setting: Option<String>,
}

/// How `G41` and `G42` move.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CompensationRules {
    /// The shape of entry, corners and exit.
    pub style: CompensationStyle,
    /// What a `D` number's value is.
    pub value: OffsetValue,
    /// Planes, units, tools and offsets must not change while it is on.
    #[serde(default)]
    pub freezes_modes: bool,
    /// The plane must not change while it is on.
    #[serde(default)]
    pub freezes_plane: bool,
    /// A rotation of its plane may begin and end while it is on, but not while scaling is on too.
    #[serde(default)]
    pub rotates_within: bool,
    /// The setting that decides between radius and diameter, where one does.
    pub setting: Option<String>,
    /// What the control refuses while it is on, where a manual says so.
    #[serde(default)]
    pub refuses: Option<CompensationRefusals>,
}

/// What a control refuses while cutter compensation is on.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CompensationRefusals {
    /// The end of the program and a stop (`M30`, `M2`, `M0`, `M1`).
    #[serde(default)]
    pub ends: bool,
    /// Planes other than XY: compensation does not begin in them, and arcs are not in them.
    #[serde(default)]
    pub other_planes: bool,
    /// Another offset number in the block of an arc.
    #[serde(default)]
    pub offset_on_arc: bool,
    /// Codes that limit how far the control reads ahead: neither while it is on, nor on while they limit.
    #[serde(default)]
    pub read_ahead_limits: Vec<String>,
    /// Its source.
    pub source: String,
    /// How sure it is.
    pub confidence: Confidence,
}

/// Settings that scaling, rotation and mirrors rest on, by number.
#[derive(Debug, Clone, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TransformSettings {
    /// The factor of scaling without one in its block; 0 hands over to `by_axis`.
    #[serde(default)]
    pub factor: Option<String>,
    /// The factors of X, Y and Z.
    #[serde(default)]
    pub by_axis: Vec<String>,
    /// The angle of rotation without one in its block.
    #[serde(default)]
    pub angle: Option<String>,
    /// The settings that mirror X, Y and Z while they are on.
    #[serde(default)]
    pub mirrors: Vec<String>,
}

/// Cylindrical mapping that wraps a linear axis around a rotary one.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CylinderRules {
    /// Settings with the diameter that counts until a program gives one: of the first rotary axis, of the second.
    pub settings: Vec<String>,
    /// The end of the program ends mapping when this setting is on.
    pub ended_by_setting: Option<String>,
}

/// How the mode reads words in which X and a rotary axis make the moves of a flat plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct PolarInterpolationRules {
    /// The rotary axis.
    pub rotary: char,
    /// The address of the plane's second coordinate: that of the rotary axis, a length then, or `Y`.
    pub second: char,
    /// Words of X count radii, whatever they count outside.
    #[serde(default)]
    pub by_radius: bool,
    /// The rotary axis counts from where it is when the mode begins; else from its own zero.
    #[serde(default)]
    pub starts_at_zero: bool,
    /// Arcs and compensation lie in the plane of the mode, whatever plane was selected.
    #[serde(default)]
    pub own_plane: bool,
}

/// Shapes of compensated paths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CompensationStyle {
    /// Entry tangent to the first element, arcs around corners.
    TangentEntry,
    /// Entry and exit perpendicular, corners by intersection.
    Intersection,
}

/// What an offset number's value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OffsetValue {
    /// A radius.
    Radius,
    /// A diameter.
    Diameter,
}

/// How tools are called.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent yes/no facts of a control, named one by one in data"
)]
pub struct ToolRules {
    /// `T` alone changes the tool (turrets); else a code does.
    pub change_by_t: bool,
    /// `T0101`: the last two digits choose the offset.
    pub offset_in_t: bool,
    /// A tool change takes the tool whose number is in `T`, and a block with `T` and the change uses it.
    pub change_needs_t: bool,
    /// `H` left out of a length code means the tool in the spindle.
    pub length_from_tool: bool,
    /// `D` left out of a compensation code means the tool in the spindle.
    pub radius_from_tool: bool,
    /// A tool change stops the spindle.
    pub change_stops_spindle: bool,
    /// A tool change cancels tool length compensation.
    #[serde(default)]
    pub change_cancels_length: bool,
    /// `D0` means the tool in the spindle; else it is no size.
    #[serde(default)]
    pub zero_is_loaded: bool,
    /// The number of a length or size is that of a tool, and the manual asks for the tool in the spindle.
    #[serde(default)]
    pub offsets_of_tools: bool,
    /// A tool change switches all coolant off; mist that was on comes on again after it.
    #[serde(default)]
    pub change_stops_coolant: bool,
    /// The axis that a tool change takes to the machine's zero.
    #[serde(default)]
    pub change_at_zero: Option<char>,
    /// The axes stay where they are at a tool change: the next tool swings in at the place where the last one was. Else
    /// the change takes them to a place of its own, or the builder decides.
    #[serde(default)]
    pub change_in_place: bool,
}

/// What `G52` and `G92` are to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LocalShift {
    /// One shift: `G52` writes it as it is written, `G92` so that the position reads as programmed.
    Shared,
    /// Two shifts that add up.
    Separate,
}

/// What a comment for the operator shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MessageComment {
    /// Its text.
    Text,
    /// Its text with the values of its parameters, six decimals each.
    Values,
    /// Its text, and the program stops for good before the rest of the block.
    Abort,
}

/// How a dwell word counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DwellWord {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
    /// Seconds with a decimal point, milliseconds without.
    SecondsOrMilliseconds,
}

/// A system variable, a row of one an axis, or a table of such rows, that the engine computes.
///
/// Number `first + row * stride + column`, where columns count up to `count` and rows up to `rows`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SystemVariable {
    /// First number.
    #[serde(default)]
    pub first: Option<u32>,
    /// Name of a named parameter, instead of a number; one a parameter (`_x` with `of = "X"`).
    #[serde(default)]
    pub name: Option<String>,
    /// How many; axes in the order X Y Z A B C U V W, unless `of` names them.
    #[serde(default = "one_u32")]
    pub count: u32,
    /// Distance between rows (work offsets), when `rows` is more than one.
    #[serde(default)]
    pub stride: u32,
    /// Rows.
    #[serde(default = "one_u32")]
    pub rows: u32,
    /// What it holds.
    pub holds: SystemValue,
    /// What `holds` needs to be told:
    /// the id of a modal group ([`SystemValue::ModalCode`]); an address ([`SystemValue::LastWord`]); the number of the first
    /// row or tool ([`SystemValue::WorkOffset`], 1 when left out, and the tables of tools); the axes in their order, one
    /// letter each (values by axis).
    #[serde(default)]
    pub of: Option<String>,
}

impl SystemVariable {
    /// The row and the column of a number, if it is one of these variables.
    pub const fn cell(&self, number: u32) -> Option<(u32, u32)> {
        let Some(first) = self.first else { return None };
        let Some(offset) = number.checked_sub(first) else { return None };
        let (row, column) = match self.stride {
            0 => (0, offset),
            stride => (offset / stride, offset % stride),
        };
        if row < self.rows && column < self.count { Some((row, column)) } else { None }
    }
}

/// What a system variable holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum SystemValue {
    /// Position of the tool's point in the active work coordinates, program units.
    WorkPosition,
    /// End of the last block, work coordinates.
    EndPosition,
    /// Position in machine coordinates.
    MachinePosition,
    /// Where the probe touched, work coordinates.
    ProbePosition,
    /// 1 after a touch, else 0.
    ProbeResult,
    /// Tool length offsets in effect, by axis.
    LengthOffset,
    /// Work offset n = row + 1, or counted from `of`.
    WorkOffset,
    /// Rotation of work offset n.
    WorkRotation,
    /// `G52`/`G92` shift.
    Shift,
    /// The shift of `G52`, where it is apart from that of `G92`.
    LocalShift,
    ShiftActive,
    WorkOffsetNumber,
    Reference1,
    Reference2,
    /// The tool in the spindle.
    ToolNumber,
    /// The tool called for.
    SelectedTool,
    /// By tool, the first that of `of`; without `of` the offsets of the tool in the spindle, by axis.
    ToolLength,
    /// By tool, the first that of `of`; without `of` that of the tool in the spindle. What the table of `D` holds.
    ToolDiameter,
    /// As the diameter.
    ToolRadius,
    /// The wear of the length, which counts with it; by tool, the first that of `of`.
    ToolLengthWear,
    /// The wear of the diameter, which counts with it; by tool, the first that of `of`.
    ToolDiameterWear,
    /// The number of the active code of the modal group `of`; ten times it in a named parameter (`170` for `G17`).
    ModalCode,
    /// The last value of the address `of`.
    LastWord,
    Feed,
    Speed,
    IsMetric,
    IsInch,
    IsAbsolute,
    IsIncremental,
    IsInverseTime,
    IsPerMinute,
    IsPerRevolution,
    SpindleOn,
    SpindleClockwise,
    MistOn,
    FloodOn,
    CompensationOn,
    CallLevel,
    /// 1 while the code `of` is in effect.
    CodeActive,
    FeedOverrideOn,
    SpeedOverrideOn,
    AdaptiveFeedOn,
    FeedStopOn,
    LengthOffsetOn,
    /// The line of the block in its file, from 1.
    LineNumber,
    /// The number `of`.
    Constant,
    /// An alarm: the program ends with the block's comment.
    Alarm,
    /// A stop with a message; the program goes on after cycle start.
    StopWithMessage,
    /// Time and the like: never known.
    Unknown,
}

fn one() -> f64 {
    1.0
}

fn one_u32() -> u32 {
    1
}
