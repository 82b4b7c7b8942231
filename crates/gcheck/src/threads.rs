//! Threads that do the work, and the room on their stacks.
//!
//! Knows: how much stack work needs. Must not know: the work.

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::Problem;

/// Stack of each thread, in bytes. Nothing recurses deeper than its guard allows; guards count levels and not bytes, so there
/// is room.
pub(crate) const STACK: usize = 16 << 20;

/// A pool of some threads.
pub(crate) fn pool(jobs: usize) -> Result<ThreadPool, Problem> {
    ThreadPoolBuilder::new()
        .stack_size(STACK)
        .num_threads(jobs.max(1))
        .build()
        .map_err(|error| Problem::new(format!("cannot start {jobs} threads: {error}")))
}

/// Gives the threads that everybody shares their room.
pub(crate) fn prepare() {
    // Fails only when they run already, and then they stay as they are.
    let _ = ThreadPoolBuilder::new().stack_size(STACK).build_global();
}
