//! gcheck in a browser: what the page of the playground asks, and the module that answers it there.
//!
//! Knows: one program and the control that is chosen for it, answers as JSON. Must not know: files, clocks, threads, the page,
//! how anything is computed.
//!
//! [`Session`] is the interface; it is the same natively, where its tests run. The module for browsers is [`Playground`], which
//! turns the answers into JSON. `cargo xtask playground` builds it and puts the page around it, which is in `page/`.

mod answers;
mod choice;
mod module;
mod place;
mod session;

pub use answers::{Choice, ControlRow, Findings, Found, Refused, Related, Shown, Source};
pub use module::{Playground, controls, last_panic, limits, panic_on_purpose};
pub use place::{Place, Span};
pub use session::{MAX_BLOCKS, MAX_FINDINGS, MAX_TEXT, Session};
