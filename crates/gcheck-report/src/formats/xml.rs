//! What the XML formats share: the document around the elements, and text that XML can hold.
//!
//! Knows: XML 1.0. Must not know: elements.

use std::borrow::Cow;
use std::io::{self, Write};

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::shown::{REPLACEMENT, lines, one_line};

/// A document with its declaration and a line end after it.
pub(super) fn document(
    out: &mut dyn Write,
    write: impl FnOnce(&mut Writer<&mut dyn Write>) -> io::Result<()>,
) -> io::Result<()> {
    let mut writer = Writer::new_with_indent(out, b' ', 2);
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    write(&mut writer)?;
    writeln!(writer.get_mut())
}

/// A text for an attribute: one line.
pub(super) fn text(text: &str) -> Cow<'_, str> {
    allowed(one_line(text))
}

/// A text between elements: lines stay lines.
pub(super) fn block(text: &str) -> Cow<'_, str> {
    allowed(lines(text))
}

/// Without the characters that no XML document may hold. The control characters among them have gone already.
fn allowed(text: Cow<'_, str>) -> Cow<'_, str> {
    let refused = ['\u{FFFE}', '\u{FFFF}'];
    if text.contains(refused) { Cow::Owned(text.replace(refused, &REPLACEMENT.to_string())) } else { text }
}
