//! How a finding is recognised again in a later version of its program.
//!
//! Knows: paths, rule ids, lines of text. Must not know: wording, severity, line numbers, formats — a fingerprint survives
//! a change of any of them.
//!
//! A fingerprint is the hash of the path, the rule's id, the normalised line on which the finding starts, and how many
//! findings of that rule on equal lines came before. The recipe is a promise to baselines and to code hosts: changing it
//! loses every stored one, so it is versioned with the formats and pinned by a test.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use gcheck_diagnostics::Finding;
use serde::{Serialize, Serializer};

/// Identity of a finding across versions of its program; shown as 32 hexadecimal digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fingerprint(u128);

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl Serialize for Fingerprint {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl Fingerprint {
    /// Reads the 32 digits back.
    pub fn parse(digits: &str) -> Option<Self> {
        if digits.len() != 32 || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            return None;
        }
        u128::from_str_radix(digits, 16).ok().map(Self)
    }
}

/// Fingerprints of one file's findings, asked for in the order of the file.
#[derive(Debug)]
pub struct Fingerprinter<'t> {
    path: Hash,
    text: &'t str,
    /// The line asked for last: a line of a megabyte may hold thousands of findings and is hashed once.
    line: Option<(Range<usize>, Hash)>,
    /// How often a rule was met on equal lines.
    met: BTreeMap<u128, u64>,
}

impl<'t> Fingerprinter<'t> {
    /// For a file. `path` is relative to the project's root and has forward slashes, so that the place of the checkout
    /// does not matter; a leading `./` does not count.
    pub fn new(path: &str, text: &'t str) -> Self {
        let path = path.strip_prefix("./").unwrap_or(path);
        Self { path: Hash::default().field(path.as_bytes()), text, line: None, met: BTreeMap::new() }
    }

    /// The fingerprint of the next finding, which starts at `offset`.
    ///
    /// The rule is given by id so that a baseline can ask under a rule's former id as well (with a fingerprinter of its
    /// own, since findings are counted).
    pub fn next(&mut self, rule: &str, offset: u32) -> Fingerprint {
        let line = self.line(offset as usize);
        let subject = self.path.field(rule.as_bytes()).field(&line.0.to_le_bytes());
        let met = self.met.entry(subject.0).or_default();
        let fingerprint = Fingerprint(subject.field(&met.to_le_bytes()).0);
        *met += 1;
        fingerprint
    }

    /// The fingerprints of all findings of the file, in their order.
    pub fn all(path: &str, text: &'t str, findings: &[Finding]) -> Vec<Fingerprint> {
        let mut fingerprinter = Self::new(path, text);
        findings.iter().map(|finding| fingerprinter.next(finding.rule.id, finding.range.start)).collect()
    }

    fn line(&mut self, offset: usize) -> Hash {
        let bytes = self.text.as_bytes();
        // The half of a CRLF belongs to the line that it ends.
        let offset = offset.min(bytes.len());
        let inside_crlf = offset > 0 && bytes.get(offset - 1..=offset) == Some(b"\r\n");
        let offset = offset - usize::from(inside_crlf);
        if let Some((range, hash)) = &self.line
            && range.contains(&offset)
        {
            return *hash;
        }
        let start =
            memchr::memrchr2(b'\n', b'\r', bytes.get(..offset).unwrap_or_default()).map_or(0, |at| at + 1);
        let end = memchr::memchr2(b'\n', b'\r', bytes.get(offset..).unwrap_or_default())
            .map_or(bytes.len(), |at| offset + at);
        let hash = normalised(bytes.get(start..end).unwrap_or_default());
        self.line = Some((start..end + 1, hash));
        hash
    }
}

/// The line without spaces, case and sequence number: formatting and renumbering leave it alone.
fn normalised(line: &[u8]) -> Hash {
    let mut bytes =
        line.iter().filter(|byte| !byte.is_ascii_whitespace()).map(u8::to_ascii_uppercase).peekable();
    let mut hash = Hash::default();
    while let Some(skip) = bytes.next_if(|byte| *byte == b'/') {
        hash = hash.byte(skip);
    }
    if bytes.next_if_eq(&b'N').is_some() {
        let mut digits = 0;
        while bytes.next_if(|byte| byte.is_ascii_digit() || *byte == b'.').is_some() {
            digits += 1;
        }
        if digits == 0 {
            hash = hash.byte(b'N');
        }
    }
    bytes.fold(hash, Hash::byte)
}

/// FNV-1a of 128 bits: small, and the same on every machine for ever.
#[derive(Debug, Clone, Copy)]
struct Hash(u128);

impl Default for Hash {
    fn default() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Hash {
    fn byte(self, byte: u8) -> Self {
        Self((self.0 ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b))
    }

    /// A field with its length, so that no two lists of fields run together into the same bytes.
    fn field(self, bytes: &[u8]) -> Self {
        let hash = (bytes.len() as u64).to_le_bytes().into_iter().fold(self, Self::byte);
        bytes.iter().copied().fold(hash, Self::byte)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(path: &str, text: &str, rule: &str, at: &str) -> Fingerprint {
        Fingerprinter::new(path, text).next(rule, text.find(at).unwrap() as u32)
    }

    #[test]
    fn the_recipe_is_a_promise() {
        // If this fails, every stored baseline is lost. Do not update it.
        assert_eq!(one("part.nc", "G1 X1.\n", "feed-missing", "X").to_string(), PINNED);
        assert_eq!(Fingerprint::parse(PINNED).unwrap().to_string(), PINNED);
        assert_eq!(Fingerprint::parse("+123"), None);
    }

    const PINNED: &str = "f7cfa82180c00dc3b9ecdc8b57c8debe";

    #[test]
    fn it_survives_moved_renumbered_and_reformatted_lines() {
        let before = one("part.nc", "%\nN10 G1 X1.\n", "r", "X1");
        assert_eq!(one("./part.nc", "%\r\n(more)\r\n\r\nn0020g1  x1.\r\n", "r", "x1"), before);
        assert_eq!(one("part.nc", "G1 X1.", "r", "G1"), before, "where on the line does not matter");
    }

    #[test]
    fn it_tells_findings_apart() {
        let before = one("part.nc", "G1 X1.\n", "r", "X1");
        assert_ne!(one("part.nc", "G1 X1.\n", "s", "X1"), before);
        assert_ne!(one("other.nc", "G1 X1.\n", "r", "X1"), before);
        assert_ne!(one("part.nc", "G1 X2.\n", "r", "X2"), before);
        assert_ne!(one("part.nc", "/G1 X1.\n", "r", "X1"), before);
        assert_ne!(one("part.nc", "N G1 X1.\n", "r", "X1"), before);

        let text = "G1 X1.\nG1 X1.\n";
        let mut file = Fingerprinter::new("part.nc", text);
        let (first, second, third) = (file.next("r", 0), file.next("r", 7), file.next("s", 7));
        assert_eq!(first, before);
        assert!(first != second && second != third, "equal lines are counted");
    }

    #[test]
    fn every_line_end_ends_a_line() {
        for text in ["G1 X1.\nG2", "G1 X1.\rG2", "G1 X1.\r\nG2"] {
            let mut file = Fingerprinter::new("p", text);
            let on_first: Vec<_> =
                (0..text.find("G2").unwrap()).map(|at| file.next("r", at as u32)).collect();
            let mut whole = Fingerprinter::new("p", "G1 X1.");
            assert!(on_first.iter().all(|f| *f == whole.next("r", 0)), "{text:?}");
            assert_eq!(file.next("r", text.find("G2").unwrap() as u32), one("p", "G2", "r", "G2"));
        }
        assert_eq!(Fingerprinter::new("p", "").next("r", 0), Fingerprinter::new("p", "G1\n").next("r", 3));
    }
}
