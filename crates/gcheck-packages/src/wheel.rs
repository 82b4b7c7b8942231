//! The wheel: `pip install` and `uv tool install` put the binary among the scripts of an environment.
//!
//! Knows: the layout of wheels, that of maturin's `bindings = "bin"`. Must not know: any other package.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use sha2::{Digest as _, Sha256};

use crate::Build;
use crate::container::{Entry, Package, zip};

/// `python -m gcheck`.
const MAIN: &str = include_str!("../../../packages/python/__main__.py");
const INIT: &str = include_str!("../../../packages/python/__init__.py");

/// Packs the wheel.
///
/// # Errors
/// When packing fails.
pub fn wheel(build: &Build<'_>) -> anyhow::Result<Package> {
    let Build { names, version, target, papers, .. } = build;
    let distribution = names.pypi.replace('-', "_");
    let info = format!("{distribution}-{version}.dist-info");
    let mut entries = vec![
        Entry::text("gcheck/__init__.py", INIT),
        Entry::text("gcheck/__main__.py", MAIN),
        Entry::program(
            format!("{distribution}-{version}.data/scripts/{}", target.binary_name()),
            build.binary,
        ),
        Entry::text(format!("{info}/METADATA"), metadata(build)),
        Entry::text(format!("{info}/WHEEL"), tags(target.wheel)),
    ];
    entries.extend(papers.licences(&format!("{info}/licenses")));
    let record = record(&entries, &info);
    entries.push(Entry::text(format!("{info}/RECORD"), record));
    let name = format!("{distribution}-{version}-py3-none-{}.whl", target.wheel);
    Ok(Package { name, bytes: zip(&entries, build.effort)? })
}

fn metadata(build: &Build<'_>) -> String {
    let Build { names, version, papers, .. } = build;
    format!(
        "Metadata-Version: 2.4\n\
         Name: {}\n\
         Version: {version}\n\
         Summary: Checks CNC part programs (G-code) before they run on the machine\n\
         Keywords: cnc,gcode,linter,language-server\n\
         License-Expression: MIT OR Apache-2.0\n\
         License-File: LICENSE-APACHE\n\
         License-File: LICENSE-MIT\n\
         Requires-Python: >=3.8\n\
         Project-URL: Source, {}\n\
         Description-Content-Type: text/markdown\n\
         \n\
         {}",
        names.pypi,
        names.url(),
        papers.readme
    )
}

fn tags(platforms: &str) -> String {
    let mut text = String::from("Wheel-Version: 1.0\nGenerator: gcheck-packages\nRoot-Is-Purelib: false\n");
    for platform in platforms.split('.') {
        // Writing into a string does not fail.
        let _ = writeln!(text, "Tag: py3-none-{platform}");
    }
    text
}

/// The list of all files with their digests; its own line has none.
fn record(entries: &[Entry], info: &str) -> String {
    let mut text = String::new();
    for Entry { path, bytes, .. } in entries {
        let digest = URL_SAFE_NO_PAD.encode(Sha256::digest(bytes));
        let _ = writeln!(text, "{path},sha256={digest},{}", bytes.len());
    }
    let _ = writeln!(text, "{info}/RECORD,,");
    text
}
