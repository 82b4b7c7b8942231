//! Running a program with an end in time and size.
//!
//! Knows: processes. Must not know: what is run or what its output means.

use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// Output beyond this is not read: a program that prints more does not end.
const MOST_OUTPUT: u64 = 64 << 20;

/// What a finished process left.
#[derive(Debug)]
pub struct Finished {
    /// The exit code; `None` when it was killed, by a signal or by us.
    pub code: Option<i32>,
    /// Whether we ended it because time or output ran out.
    pub endless: bool,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

/// Runs a command to its end, or kills it when `limit` has passed.
pub fn run(command: &mut Command, limit: Duration) -> Finished {
    let mut child =
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let (sender, receiver) = mpsc::channel();
    let stderr = collect(child.stderr.take().unwrap(), mpsc::channel().0);
    let stdout = collect(child.stdout.take().unwrap(), sender);
    let complete = receiver.recv_timeout(limit).unwrap_or(false);
    if !complete {
        kill(&mut child);
        child.wait().unwrap();
        // What it printed is of no use, and a child of its own may still hold the streams open.
        return Finished { code: None, endless: true, stdout: String::new(), stderr: String::new() };
    }
    let status = child.wait().unwrap();
    Finished {
        code: status.code(),
        endless: false,
        stdout: stdout.join().unwrap(),
        stderr: stderr.join().unwrap(),
    }
}

/// Reads a stream to its end in a thread of its own; says whether the end was reached.
fn collect(stream: impl Read + Send + 'static, done: mpsc::Sender<bool>) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        let read = stream.take(MOST_OUTPUT).read_to_end(&mut bytes);
        let complete = read.is_ok_and(|count| (count as u64) < MOST_OUTPUT);
        // Nobody listens any more when time ran out first.
        let _ = done.send(complete);
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

fn kill(child: &mut Child) {
    // A process that ended in this moment cannot be killed, and need not be.
    let _ = child.kill();
}

#[test]
fn a_process_that_does_not_end_is_ended() {
    let finished = run(Command::new("sleep").arg("60"), Duration::from_millis(50));
    assert!(finished.endless);
    let finished = run(Command::new("yes").arg("no end"), Duration::from_mins(1));
    assert!(finished.endless);
}
