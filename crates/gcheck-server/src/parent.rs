//! The process that started the server: when it is gone, so is the reason to be here.
//!
//! Knows: how to find out whether a process lives. Must not know: what else ends the server.

use std::thread;
use std::time::Duration;

/// How often it is looked whether the process lives.
const INTERVAL: Duration = Duration::from_secs(3);

/// Who is told.
type Gone = Box<dyn Fn() + Send + Sync>;

/// Watches the client's process once its number is known.
pub(crate) struct Parent {
    gone: std::sync::Arc<Gone>,
}

impl std::fmt::Debug for Parent {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Parent")
    }
}

impl Parent {
    pub(crate) fn new(gone: impl Fn() + Send + Sync + 'static) -> Self {
        Self { gone: std::sync::Arc::new(Box::new(gone)) }
    }

    /// Begins to watch. A process that is not to be seen, such as one outside of our container, is not watched: the end of
    /// standard input tells of its end too.
    pub(crate) fn watch(&self, process: Option<u32>) {
        let Some(process) = process.filter(|process| is_alive(*process)) else { return };
        let gone = std::sync::Arc::clone(&self.gone);
        thread::spawn(move || {
            while is_alive(process) {
                thread::sleep(INTERVAL);
            }
            gone();
        });
    }
}

#[cfg(unix)]
fn is_alive(process: u32) -> bool {
    use nix::errno::Errno;
    use nix::sys::signal::kill;
    use nix::unistd::Pid;

    let Ok(process) = i32::try_from(process) else { return false };
    // No signal is sent; one that may not be sent is to somebody who lives.
    process > 0 && matches!(kill(Pid::from_raw(process), None), Ok(()) | Err(Errno::EPERM))
}

/// Elsewhere the end of standard input has to do.
#[cfg(not(unix))]
fn is_alive(_: u32) -> bool {
    false
}
