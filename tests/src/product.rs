//! What we execute.
//!
//! Knows: how `gcheck run` is called and its exit codes. Must not know: what its output is compared with.

use std::env;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use crate::canonical::{End, Outcome, read};
use crate::process::run;
use crate::setup::Setup;

const LIMIT: Duration = Duration::from_secs(20);

/// Runs a program in its folder with the build of `gcheck` at `gcheck`, or with the one that `GCHECK_ORACLE_PROGRAM` names.
pub fn execute(gcheck: &str, program: &Path, setup: &Setup) -> Outcome {
    let gcheck = env::var_os("GCHECK_ORACLE_PROGRAM").unwrap_or_else(|| OsString::from(gcheck));
    let mut command = Command::new(gcheck);
    command.current_dir(program.parent().unwrap());
    command.args(["run", "--isolated", "--control", "linuxcnc", "--output-format", "canonical", "--config"]);
    command.arg(format!("tools.table={}", quoted(&setup.table)));
    // The reference reads its table in inches, whatever its programs are written in.
    command.args(["--config", "machine.table_units=\"inch\""]);
    if !setup.search.is_empty() {
        let folders: Vec<String> = setup.search.iter().map(|folder| quoted(folder)).collect();
        command.arg("--config").arg(format!("search.paths=[{}]", folders.join(", ")));
    }
    for key in &setup.config {
        command.arg("--config").arg(key);
    }
    command.arg(program);
    let finished = run(&mut command, LIMIT);
    let message = || finished.stderr.trim().to_owned();
    let end = match finished.code {
        _ if finished.endless => End::Endless,
        Some(0) => End::Ended,
        Some(1) if !finished.stderr.contains("panicked at") => End::Refused(message()),
        code => End::Broken(format!("exit {code:?}: {}", message())),
    };
    Outcome { calls: read(&finished.stdout), end }
}

/// A path as a TOML string.
fn quoted(path: &Path) -> String {
    format!("{:?}", path.to_string_lossy())
}
