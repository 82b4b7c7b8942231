//! `xtask measure COMMAND…`: runs one command and prints its CPU seconds, wall seconds and peak memory.
//!
//! Knows: the operating system's accounts of finished children. Must not know: what is measured. It is a process of its
//! own because those accounts are sums and maxima over all children a process ever had.

use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::time::Instant;
use std::{env, fmt};

use anyhow::{Context as _, bail};

/// What a finished command has used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Usage {
    /// Seconds of all processors together, in user and system code.
    pub(crate) cpu: f64,
    /// Seconds that passed.
    pub(crate) wall: f64,
    /// Bytes of memory at the peak.
    pub(crate) memory: f64,
    /// Its exit code; -1 when a signal ended it.
    pub(crate) code: i32,
}

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {} {}", self.cpu, self.wall, self.memory, self.code)
    }
}

impl Usage {
    fn parse(line: &str) -> Option<Self> {
        let mut fields = line.split_whitespace();
        let mut number = || fields.next()?.parse::<f64>().ok();
        let (cpu, wall, memory) = (number()?, number()?, number()?);
        Some(Self { cpu, wall, memory, code: fields.next()?.parse().ok()? })
    }
}

/// The subcommand, not meant for people.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let Some((program, rest)) = arguments.split_first() else { bail!("which command?") };
    let start = Instant::now();
    let status = Command::new(program)
        .args(rest)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .with_context(|| format!("{program} does not start"))?;
    let wall = start.elapsed().as_secs_f64();
    let (cpu, memory) = children()?;
    println!("{}", Usage { cpu, wall, memory, code: status.code().unwrap_or(-1) });
    Ok(ExitCode::SUCCESS)
}

/// Measures a command in a process of its own.
pub(crate) fn measure(program: &Path, arguments: &[&str]) -> anyhow::Result<Usage> {
    let output = Command::new(env::current_exe()?).arg("measure").arg(program).args(arguments).output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    Usage::parse(&text).with_context(|| String::from_utf8_lossy(&output.stderr).into_owned())
}

/// CPU seconds and peak memory of all children so far.
#[cfg(unix)]
pub(crate) fn children() -> anyhow::Result<(f64, f64)> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeValLike as _;

    let usage = getrusage(UsageWho::RUSAGE_CHILDREN)?;
    let microseconds = usage.user_time().num_microseconds() + usage.system_time().num_microseconds();
    // Linux counts kilobytes, Apple's systems bytes.
    let unit = if cfg!(target_vendor = "apple") { 1.0 } else { 1024.0 };
    #[expect(clippy::cast_precision_loss, reason = "measured values, far below 2^53")]
    Ok((microseconds as f64 / 1e6, usage.max_rss() as f64 * unit))
}

#[cfg(not(unix))]
pub(crate) fn children() -> anyhow::Result<(f64, f64)> {
    bail!("measured on Unix systems only")
}

#[cfg(test)]
mod tests {
    use super::Usage;

    #[test]
    fn what_is_printed_is_read_back() {
        let usage = Usage { cpu: 0.25, wall: 1.5, memory: 1_048_576.0, code: 1 };
        assert_eq!(Usage::parse(&usage.to_string()), Some(usage));
        assert_eq!(Usage::parse("nothing"), None);
    }
}
