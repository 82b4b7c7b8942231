//! Models of machines: what their builders or the files of their controls publish of them.
//!
//! Knows: the embedded files of `data/machines`, by name. Must not know: what their tables mean, which is for whoever reads
//! configurations.

/// A model of a machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MachineModel {
    /// Its name, as configurations give it.
    pub name: &'static str,
    /// Its file: TOML with `title`, `extent`, the keys of `[machine]`, and their `[sources]`.
    pub text: &'static str,
}

include!(concat!(env!("OUT_DIR"), "/machines.rs"));

/// The models there are, in alphabetical order.
pub fn machine_models() -> &'static [MachineModel] {
    MACHINES
}
