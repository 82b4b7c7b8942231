//! Executes part programs: what is active before every block, on every path, and where the tool goes.
//!
//! Knows: machine state, one `step` generic over a value domain, the concrete runner, the analysis of all paths, moves,
//! typed faults, fuel. Must not know: words for people, files, how results are cached.

mod assumption;
mod block_lines;
pub mod cycles;
mod cylinder;
mod eval;
mod event;
mod exec;
mod fault;
mod flow;
#[cfg(feature = "forgetful")]
pub mod forgetful;
mod lattice;
mod machine;
mod model;
mod observer;
mod origin;
mod polar_plane;
mod position;
mod program;
mod run;
mod start;
mod state;

pub use assumption::{Assumption, Unsettled};
pub use block_lines::{BlockLines, CallLine, CallLines, outline_cycle};
pub use cylinder::Cylinder;
pub use eval::value::*;
pub use event::*;
pub use exec::context::{Ending, Options};
pub use exec::look::{Look, Trial};
pub use fault::{ArcFault, CompensationFault, CornerFault, CycleFault, Fault, ValueFault};
pub use flow::{
    Branch, Budget, Checkpoint, Choice, Decision, Fact, Facts, FlowCx, FlowObserver, FlowResult, GivenUp,
    Leg, Limit, MOST_EXACT_TURNS, Parting, Reach, ReachingDefinitions, Task, flow, flow_branch, flow_from,
};
pub use gcheck_controls::{CornerRules, Halt, MotionRules, RapidRules, SpindleWaitRules, TapRules};
pub use lattice::Lattice;
pub use machine::{BarFeeder, Cutting, Dynamics, Guesses, Machine, Tool, WorkOffset};
pub use model::{Model, Role};
pub use observer::{Nobody, Observer};
pub use origin::{At, Origin};
pub use position::{Axis, Position};
pub use program::{Library, LookedUp, NoLibrary, Program, ProgramFile, SourceFile, number_of_name};
pub use run::{Alarm, MOST_ALARMS, RunResult, Stopped, run};
#[cfg(feature = "forgetful")]
pub use state::state_fields;
pub use state::{
    Bar, CycleWords, Diameters, Frame, FrameKind, ModeSet, NameId, State, Tables, ToolData, ToolShift, Touch,
    Transform, Variables, Way, Ways,
};
