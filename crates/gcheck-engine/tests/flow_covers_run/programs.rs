//! Programs written for each field of the state.
use crate::material::Source;
pub(crate) fn sources() -> Vec<Source> { Vec::new() }
