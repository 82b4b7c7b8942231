//! Messages in a stream of bytes: a header with the length, an empty line, the body.
//!
//! Knows: JSON-RPC's frame, and how to go on after a broken one. Must not know: methods.
//!
//! A header that says no length is skipped up to the next one that does; the body of a message is read as it comes, so that
//! a length that nobody keeps costs no memory.

use std::io::{self, BufRead, Read as _, Write};

use serde_json::Value;

use crate::proto::{Message, Response};

/// Longer messages are passed over: editors do not give programs of that size to servers.
const MOST_BYTES: u64 = 256 << 20;
/// What says that it is longer is not a message.
const MOST_SKIPPED_BYTES: u64 = 1 << 40;
/// Longer lines of a header are none.
const MOST_HEADER_BYTES: u64 = 4 << 10;

/// What came from the other side.
#[derive(Debug)]
pub(crate) enum Incoming {
    /// A request or notification.
    Message(Message),
    /// The answer to one of ours.
    Answer(Response),
    /// Bytes that are not a message.
    Malformed(Malformed),
}

/// What came in place of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Bytes without sense.
    Bytes,
    /// JSON, but no request.
    Json,
    /// A message that is too long to be read.
    TooLong,
}

/// Why something is not a message.
#[derive(Debug)]
pub(crate) struct Malformed {
    /// What came in place of a message.
    pub(crate) kind: Kind,
    /// Its id, as far as it had one.
    pub(crate) id: Option<Value>,
    /// What is wrong, for the log.
    pub(crate) reason: String,
}

impl Malformed {
    fn frame(reason: impl Into<String>) -> Incoming {
        Incoming::Malformed(Self { kind: Kind::Bytes, id: None, reason: reason.into() })
    }

    fn too_long(bytes: u64) -> Self {
        let reason = format!(
            "the editor sends {} MB at once, and the server reads at most {} MB: a program of that size is not checked in the \
             editor, but by `gcheck check` on the command line",
            bytes >> 20,
            MOST_BYTES >> 20
        );
        Self { kind: Kind::TooLong, id: None, reason }
    }
}

/// Reads the next message; `None` at the end of the stream.
pub(crate) fn read(from: &mut impl BufRead) -> io::Result<Option<Incoming>> {
    let Some(length) = header(from)? else { return Ok(None) };
    let length = match length {
        Ok(length) => length,
        Err(reason) => return Ok(Some(Malformed::frame(reason))),
    };
    if length > MOST_BYTES {
        let came = io::copy(&mut from.take(length), &mut io::sink())?;
        return Ok((came == length).then(|| Incoming::Malformed(Malformed::too_long(length))));
    }
    // Grows with what really comes, not with what is promised.
    let mut body = Vec::new();
    from.take(length).read_to_end(&mut body)?;
    if (body.len() as u64) < length {
        return Ok(None);
    }
    Ok(Some(message(&body)))
}

/// Reads a header; the inner error is a header without a length.
fn header(from: &mut impl BufRead) -> io::Result<Option<Result<u64, String>>> {
    let mut length = None;
    let mut strange = None;
    loop {
        let mut line = Vec::new();
        from.by_ref().take(MOST_HEADER_BYTES).read_until(b'\n', &mut line)?;
        if line.is_empty() {
            return Ok(None);
        }
        let text = String::from_utf8_lossy(&line);
        let text = text.trim();
        if text.is_empty() {
            match (length, strange.take()) {
                (Some(length), _) => return Ok(Some(Ok(length))),
                (None, Some(strange)) => return Ok(Some(Err(strange))),
                // Empty lines between two messages.
                (None, None) => continue,
            }
        }
        match text.split_once(':') {
            Some((name, value)) if name.trim().eq_ignore_ascii_case("content-length") => {
                match value.trim().parse() {
                    Ok(bytes) if bytes <= MOST_SKIPPED_BYTES => length = Some(bytes),
                    _ => strange = Some(format!("`{text}` is not the length of a message")),
                }
            }
            Some((name, _)) if name.trim().eq_ignore_ascii_case("content-type") => {}
            _ => strange = Some("the header of a message has no `Content-Length`".to_owned()),
        }
    }
}

fn message(body: &[u8]) -> Incoming {
    let value: Value = match serde_json::from_slice(body) {
        Ok(value) => value,
        Err(error) => return Malformed::frame(format!("a message is not JSON: {error}")),
    };
    let id = value.get("id").cloned();
    let malformed =
        |reason: String| Incoming::Malformed(Malformed { kind: Kind::Json, id: id.clone(), reason });
    if value.get("method").is_some() {
        serde_json::from_value(value)
            .map_or_else(|error| malformed(format!("a message is not a request: {error}")), Incoming::Message)
    } else if value.get("result").is_some() || value.get("error").is_some() {
        serde_json::from_value(value)
            .map_or_else(|error| malformed(format!("a message is not an answer: {error}")), Incoming::Answer)
    } else {
        malformed("a message has neither method nor result".to_owned())
    }
}

/// Writes a message.
pub(crate) fn write(to: &mut impl Write, message: &impl serde::Serialize) -> io::Result<()> {
    let body = serde_json::to_vec(message)?;
    write!(to, "Content-Length: {}\r\n\r\n", body.len())?;
    to.write_all(&body)?;
    to.flush()
}

#[cfg(test)]
mod tests {
    use std::fmt::Write as _;
    use std::io::{self, Read as _};

    use expect_test::expect;

    use super::{Incoming, Kind, read};

    fn all(bytes: &[u8]) -> String {
        let mut from = bytes;
        let mut out = String::new();
        while let Some(incoming) = read(&mut from).unwrap() {
            match incoming {
                Incoming::Message(message) => writeln!(out, "message {}", message.method()),
                Incoming::Answer(answer) => writeln!(out, "answer to {}", answer.id()),
                Incoming::Malformed(malformed) => {
                    writeln!(out, "malformed, id {:?}: {}", malformed.id, malformed.reason)
                }
            }
            .unwrap();
        }
        out
    }

    fn framed(body: &str) -> String {
        format!("Content-Length: {}\r\n\r\n{body}", body.len())
    }

    #[test]
    fn messages_follow_each_other() {
        let stream = framed(r#"{"jsonrpc":"2.0","method":"exit"}"#)
            + &framed(r#"{"jsonrpc":"2.0","id":1,"result":null}"#)
            + "content-type: application/vscode-jsonrpc; charset=utf8\r\n"
            + &framed(r#"{"jsonrpc":"2.0","id":2,"method":"shutdown"}"#);
        expect![[r"
            message exit
            answer to 1
            message shutdown
        "]]
        .assert_eq(&all(stream.as_bytes()));
    }

    #[test]
    fn what_is_no_message_is_said_and_passed_over() {
        let good = framed(r#"{"jsonrpc":"2.0","method":"good"}"#);
        let stream = [
            framed("{\"jsonrpc\""),
            framed(r#"{"method":"no version","id":7}"#),
            framed("[]"),
            framed(""),
            "garbage\r\n\r\n".to_owned(),
            "Content-Length: much\r\n\r\n".to_owned(),
            "Content-Length: 99999999999999\r\n\r\n".to_owned(),
        ];
        let stream: String = stream.iter().flat_map(|bad| [bad.as_str(), &good]).collect();
        expect![[r#"
            malformed, id None: a message is not JSON: EOF while parsing an object at line 1 column 10
            message good
            malformed, id Some(Number(7)): a message is not a request: missing field `jsonrpc`
            message good
            malformed, id None: a message has neither method nor result
            message good
            malformed, id None: a message is not JSON: EOF while parsing a value at line 1 column 0
            message good
            malformed, id None: the header of a message has no `Content-Length`
            message good
            malformed, id None: `Content-Length: much` is not the length of a message
            message good
            malformed, id None: `Content-Length: 99999999999999` is not the length of a message
            message good
        "#]]
        .assert_eq(&all(stream.as_bytes()));
    }

    #[test]
    fn a_message_of_two_gigabytes_is_passed_over_in_little_memory() {
        let head = format!("Content-Length: {}\r\n\r\n", 2_u64 << 30);
        let good = framed(r#"{"jsonrpc":"2.0","method":"good"}"#);
        let body = io::repeat(b'1').take(2 << 30);
        let mut from = io::BufReader::new(head.as_bytes().chain(body).chain(good.as_bytes()));
        let Some(Incoming::Malformed(malformed)) = read(&mut from).unwrap() else { panic!("it is read") };
        assert_eq!(malformed.kind, Kind::TooLong);
        assert!(malformed.reason.starts_with("the editor sends 2048 MB at once"), "{}", malformed.reason);
        let Some(Incoming::Message(message)) = read(&mut from).unwrap() else { panic!("the next is lost") };
        assert_eq!(message.method(), "good");
    }

    #[test]
    fn bytes_that_are_no_utf_8_are_no_json() {
        let mut stream = b"Content-Length: 3\r\n\r\n\"\xFF\"".to_vec();
        stream.extend(framed(r#"{"jsonrpc":"2.0","method":"good"}"#).bytes());
        expect![[r#"
            malformed, id None: a message is not JSON: invalid unicode code point at line 1 column 2
            message good
        "#]]
        .assert_eq(&all(&stream));
    }

    #[test]
    fn a_stream_that_breaks_off_ends() {
        assert_eq!(all(b"Content-Length: 4000000000\r\n\r\n{"), "");
        assert_eq!(all(b"Content-Le"), "");
        assert_eq!(all(b""), "");
    }
}
