//! Executes part programs: what is active before every block, on every path, and where the tool goes.
//!
//! Knows: machine state, one `step` generic over a value domain, the concrete runner, the analysis of all paths, moves,
//! typed faults, fuel. Must not know: words for people, files, how results are cached.

mod assumption;
pub mod cycles;
mod cylinder;
mod event;
mod fault;
mod flow;
mod machine;
mod modal;
mod model;
mod number;
mod observer;
mod position;
mod program;
mod run;
mod start;
mod state;
mod step;
mod tool_shift;
mod touch;
mod value;
mod variables;
mod words;

pub use assumption::Assumption;
pub use cylinder::{Cylinder, Diameters, Wrapped};
pub use event::*;
pub use fault::{ArcFault, CompensationFault, CycleFault, Fault, ValueFault};
pub use flow::{
    Checkpoint, Decision, Fact, Facts, FlowCx, FlowObserver, FlowResult, Leg, MOST_EXACT_TURNS, Reach, Trace,
    flow, flow_from,
};
pub use machine::{BarFeeder, Machine, Tool, WorkOffset};
pub use modal::ModeSet;
pub use model::{Model, Role};
pub use observer::{Nobody, Observer, Origin};
pub use position::{Axis, Position};
pub use program::{Library, LookedUp, NoLibrary, Program, ProgramFile, SourceFile};
pub use run::{RunResult, Stopped, run};
pub use state::{At, CycleWords, Frame, FrameKind, State, Tables, Transform};
pub use step::bar::Bar;
pub use step::compensation::Compensation;
pub use step::look::{Look, Trial};
pub use step::{Ending, Options};
pub use tool_shift::ToolShift;
pub use touch::{Touch, Way, Ways};
pub use value::*;
pub use variables::{NameId, Variables};
