//! `SHA256SUMS`: the checksums of a release, in the form that `sha256sum --check` reads.
//!
//! Knows: that form. Must not know: what the files are.

use std::fmt::Write as _;

use sha2::{Digest as _, Sha256};

use crate::Package;

/// The SHA-256 of bytes, in hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(64);
    for byte in Sha256::digest(bytes) {
        // Writing into a string does not fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// The file with the checksums of packages, by name.
pub fn sums(packages: &[Package]) -> Package {
    let mut lines: Vec<(&str, String)> =
        packages.iter().map(|package| (package.name.as_str(), sha256(&package.bytes))).collect();
    lines.sort();
    let text: String = lines.iter().map(|(name, sum)| format!("{sum}  {name}\n")).collect();
    Package { name: "SHA256SUMS".to_owned(), bytes: text.into_bytes() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_by_name_and_as_sha256sum_writes_them() {
        let package = |name: &str, text: &str| Package { name: name.to_owned(), bytes: text.into() };
        let sums = sums(&[package("b", ""), package("a", "abc")]);
        assert_eq!(
            String::from_utf8(sums.bytes).unwrap(),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  a\n\
             e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855  b\n"
        );
    }
}
