//! The playground in a real browser: a program is typed, and its findings, states and toolpath appear; the page tells what goes
//! wrong.
//!
//! Knows: how the playground is built and opened, its budgets. Must not know: how it works. The test does nothing, and prints
//! why, where Rust cannot build for browsers (`rustup target add wasm32-unknown-unknown`), or where there is no Chromium or no
//! Playwright (`cargo xtask test` installs both).

#![expect(clippy::expect_used, reason = "a test that meets the unexpected is to fail")]

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use flate2::Compression;
use flate2::write::GzEncoder;
use gcheck_testkit::skips::skip;
use serde_json::{Value, json};

/// What the module is built for.
const TARGET: &str = "wasm32-unknown-unknown";
/// Bytes of the packed module.
const MOST_BYTES: usize = 3_000_000;
/// Milliseconds for the findings of 1,000 lines.
const MOST_MILLISECONDS: f64 = 200.0;
/// The picture that the page about the playground shows, and its size: that of the window in `look.mjs`.
const PICTURE: &str = "docs/pictures/playground.png";
const WINDOW: [u32; 2] = [1360, 860];
/// Where a browser may be.
const BROWSERS: [&str; 4] = [
    "/usr/bin/chromium",
    "/usr/bin/chromium-browser",
    "/usr/bin/google-chrome",
    "/usr/bin/google-chrome-stable",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(PathBuf::from).expect("tests are in the workspace")
}

/// Can this Rust build for browsers?
fn has_target() -> bool {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc)
        .current_dir(root())
        .args(["--print", "target-libdir", "--target", TARGET])
        .output()
        .expect("rustc starts");
    let folder = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    output.status.success() && Path::new(&folder).is_dir()
}

/// The folder of the playground, built.
fn built() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("playground");
    // What an older page had is not to be found by this one.
    let _ = fs::remove_dir_all(&folder);
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .current_dir(root())
        .args(["xtask", "playground", "--out"])
        .arg(&folder)
        .output()
        .expect("cargo starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

fn packed(file: &Path) -> usize {
    let bytes = fs::read(file).expect("the module is there");
    let mut packer = GzEncoder::new(Vec::new(), Compression::default());
    std::io::Write::write_all(&mut packer, &bytes).expect("memory can be written");
    packer.finish().expect("memory can be written").len()
}

/// Width and height in the first chunk of a PNG.
fn size(png: &[u8]) -> [u32; 2] {
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"), "not a PNG");
    [16, 20].map(|at| {
        let bytes = png.get(at..at + 4).and_then(|bytes| bytes.try_into().ok());
        u32::from_be_bytes(bytes.expect("a PNG begins with its size"))
    })
}

/// The test below takes it: `UPDATE_EXPECT=1` puts what it took there.
#[test]
fn the_page_about_the_playground_shows_it() {
    let page = fs::read_to_string(root().join("docs/playground.md")).expect("the page is there");
    assert!(page.contains(PICTURE.strip_prefix("docs/").unwrap_or_default()), "the page shows {PICTURE}");
    assert_eq!(size(&fs::read(root().join(PICTURE)).expect("the picture is there")), WINDOW);
}

#[test]
fn a_program_is_checked_in_a_browser() {
    let tools = root().join(".test-tools");
    let browser = BROWSERS.iter().map(Path::new).find(|path| path.exists());
    let why = if !has_target() {
        Some(format!("no {TARGET} (`rustup target add {TARGET}`)"))
    } else if browser.is_none() || !tools.join("node_modules/playwright-core").exists() {
        Some("no Chromium or no Playwright (`cargo xtask test` installs both)".to_owned())
    } else {
        None
    };
    if let Some(why) = why {
        return skip("a_program_is_checked_in_a_browser", &why, "`cargo xtask test` installs it");
    }
    let folder = built();
    let bytes = packed(&folder.join("gcheck_bg.wasm"));
    assert!(bytes <= MOST_BYTES, "the packed module has {bytes} bytes");

    // Pictures of the last run stay for people to look at.
    let pictures = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("playground-pictures");
    fs::create_dir_all(&pictures).expect("a folder can be made");
    let output = Command::new("node")
        .arg(root().join("tests/tests/playground/look.mjs"))
        .args([tools.as_path(), browser.unwrap_or(Path::new("")), &folder, &pictures])
        .output()
        .expect("node starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let seen: Value = serde_json::from_slice(&output.stdout).expect("the script prints JSON");
    let taken = fs::read(pictures.join("light.png")).expect("the script takes it");
    assert_eq!(size(&taken), WINDOW);
    if env::var_os("UPDATE_EXPECT").is_some() {
        fs::write(root().join(PICTURE), taken).expect("the picture can be written");
    }
    let text = |key: &str| seen[key].as_str().unwrap_or_else(|| panic!("{key}: {seen:#}")).to_owned();
    let has = |key: &str, part: &str| assert!(seen[key].to_string().contains(part), "{key}: {seen:#}");

    assert_eq!(seen["problems"], json!([]), "{seen:#}");
    assert_eq!(seen["strangers"], json!([]), "nothing is loaded from elsewhere");
    assert_eq!(seen["samples"].as_array().map(Vec::len), Some(4), "{seen:#}");
    has("firstReading", "Haas mill");
    assert!(seen["firstFindings"].as_u64() > Some(2), "{seen:#}");

    assert_eq!(seen["markup"], 0, "text of a program is text");
    has("findings", "error: cut without a feed (F)");
    has("marked", "G1 X50.");
    assert_eq!((text("chosen").as_str(), text("focus").as_str()), ("G1 X50.", "text"));
    has("state", "G1 straight cut at feed");
    assert!(text("run").starts_with("3 moves"), "{seen:#}");
    assert!(text("readout").starts_with("line 6 · feed · X50.000"), "{seen:#}");
    assert_eq!(text("afterF8"), "At the cursor: line 2, column 38");
    assert_eq!(text("corrected"), "G1 X50. F200.");

    has("empty", " ms");
    has("tooLong", "the text has 2051 KB; the playground reads up to 1024 KB");
    has("panicAnswer", "on purpose");
    assert_eq!((&seen["workersBefore"], &seen["workersAfter"]), (&json!(1), &json!(2)));
    has("afterPanic", "no findings");
    assert_eq!(seen["problemAfterPanic"], false);
    has("tooSlow", "longer than 10 seconds");
    assert_eq!(seen["clockOfNothing"], json!(["", "0"]), "the run of the program before is gone");
    assert_eq!(seen["workersAfterWaiting"], 3);
    has("afterWaiting", "no findings");
    assert_eq!(seen["sideways"], false, "a narrow page does not scroll sideways");

    assert_eq!(seen["lines"], 1000);
    for key in ["millisecondsFirst", "milliseconds"] {
        assert!(seen[key].as_f64().is_some_and(|took| took <= MOST_MILLISECONDS), "{key}: {seen:#}");
    }
    eprintln!(
        "the playground: {bytes} bytes packed; 1,000 lines in {} ms, then in {} ms",
        seen["millisecondsFirst"], seen["milliseconds"]
    );
}
