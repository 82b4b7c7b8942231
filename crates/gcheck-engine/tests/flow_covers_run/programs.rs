//! Programs written for each field of the state.
use crate::material::Source;
pub(crate) const UNSEEN: &[(&str, &str, &str)] = &[];
pub(crate) fn sources() -> Vec<Source> { Vec::new() }
