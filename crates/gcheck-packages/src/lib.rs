//! The packages in which people get gcheck, made from a binary that is built already.
//!
//! Knows: how archives, wheels, npm packages, Debian packages, installers, manifests and bills of materials are laid
//! out. Must not know: how the binary is built, what it does, the network.
//!
//! `cargo xtask dist` writes them to a folder; `tests/tests/packages` installs them from there. The same input gives the
//! same bytes: no clock, no order of a file system.

mod archive;
mod container;
mod deb;
mod image;
mod names;
mod npm;
mod papers;
mod recipes;
mod sbom;
mod sums;
mod target;
mod vsix;
mod wheel;

pub use archive::archive;
pub use container::Package;
pub use deb::deb;
pub use image::image;
pub use names::Names;
pub use npm::{npm_launcher, npm_platform};
pub use papers::{Papers, SHELLS};
pub use recipes::recipes;
pub use sbom::{Component, sbom};
pub use sums::sums;
pub use target::{PUBLISHED, Target};
pub use vsix::vsix;
pub use wheel::wheel;

/// A binary that is to be packed, and what goes with it.
#[derive(Debug, Clone, Copy)]
pub struct Build<'b> {
    /// Names to publish under.
    pub names: &'b Names,
    /// The version, without `v`.
    pub version: &'b str,
    /// What the binary runs on.
    pub target: &'static Target,
    /// The binary.
    pub binary: &'b [u8],
    /// Licences, README, completions.
    pub papers: &'b Papers,
    /// How hard compression tries: 0 to 9.
    pub effort: u32,
}
