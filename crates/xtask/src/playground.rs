//! `cargo xtask playground`: the page that checks programs in a browser, in a folder that any web server hands out.
//!
//! Knows: how the module is built, what is in the folder, how large the module may be. Must not know: what the page does.
//!
//! The module is made of the library of wasm-bindgen's tool, whose version `Cargo.lock` keeps equal to that of the crate in
//! the module. A fresh machine needs the target of Rust and nothing else.

use std::env;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use anyhow::{Context as _, bail, ensure};
use flate2::Compression;
use flate2::write::GzEncoder;
use serde::Serialize;
use wasm_bindgen_cli_support::Bindgen;

use crate::browser_target::{self, NAME as TARGET};
use crate::workspace;

const PACKAGE: &str = "gcheck-playground";
/// Of the module and of its script.
const NAME: &str = "gcheck";
/// Of `Cargo.toml`; its folder in `target` must not be the one that the page goes to.
const PROFILE: &str = "wasm";
/// Bytes of the stack. The usual one is small for programs that are nested deep.
const STACK: usize = 8 << 20;
/// Bytes of the packed module that a reader may have to load.
const MOST: usize = 3_000_000;

const PAGE: &str = "crates/gcheck-playground/page";
/// The viewer of `gcheck plot` and its parts, which name one another by their places.
const VIEWER: &str = "crates/gcheck-toolpath/src/plot";

/// Programs to begin with: what they show, and where they are. A folder `*` is the one that has the file.
const SAMPLES: [(&str, &str, &str); 3] = [
    ("Mill: a bracket with mistakes", "fixtures/tour", "bracket.nc"),
    ("Lathe: a bushing with mistakes", "fixtures/tour", "bushing.nc"),
    ("Mill: a plate with subroutines", "fixtures/clean/*", "plate.ngc"),
];

#[derive(Debug, Serialize)]
struct Sample {
    title: &'static str,
    name: &'static str,
    text: String,
}

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let members = workspace::members()?;
    let target_folder = members.target_directory.into_std_path_buf();
    let out = match arguments {
        [] => target_folder.join("playground"),
        [option, folder] if option == "--out" => env::current_dir()?.join(folder),
        _ => bail!("usage: cargo xtask playground [--out FOLDER]"),
    };
    ensure!(
        browser_target::is_installed()?,
        "Rust cannot build for {TARGET}; `rustup target add {TARGET}` installs that"
    );
    let module = build(&target_folder)?;
    fs::create_dir_all(&out).with_context(|| out.display().to_string())?;
    let mut bindgen = Bindgen::new();
    bindgen.input_path(&module).web(true)?.typescript(false).out_name(NAME);
    bindgen.remove_name_section(true).remove_producers_section(true);
    bindgen.generate(&out).with_context(|| format!("wasm-bindgen cannot read {}", module.display()))?;

    let root = workspace::root();
    copy(&root.join(PAGE), &out, |_| true)?;
    let plot = out.join("plot");
    copy(&root.join(VIEWER), &plot, |name| name == "viewer.js")?;
    copy(&root.join(VIEWER).join("viewer"), &plot.join("viewer"), |_| true)?;
    fs::write(out.join("samples.json"), serde_json::to_vec(&samples(root)?)?)?;

    let module = fs::read(out.join(format!("{NAME}_bg.wasm")))?;
    let packed = packed(&module)?;
    println!("{:>11}  the module", module.len());
    println!("{packed:>11}  the module as a web server packs it (gzip)");
    println!("{}", out.join("index.html").display());
    ensure!(packed <= MOST, "the packed module has more than {MOST} bytes");
    Ok(ExitCode::SUCCESS)
}

/// Builds the module as the linker leaves it.
fn build(target_folder: &Path) -> anyhow::Result<PathBuf> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(workspace::root());
    // A library of C where it is built for browsers, and only there: native builds need none.
    cargo.args(["rustc", "--locked", "--package", PACKAGE, "--lib", "--crate-type", "cdylib"]);
    cargo.args(["--target", TARGET, "--profile", PROFILE]);
    cargo.args(["--", "-C", &format!("link-arg=-zstack-size={STACK}")]);
    ensure!(cargo.status().context("cargo does not start")?.success(), "the build fails");
    let file = format!("{}.wasm", PACKAGE.replace('-', "_"));
    Ok(target_folder.join(TARGET).join(PROFILE).join(file))
}

/// Copies the files of a folder that have such names.
fn copy(from: &Path, to: &Path, is_wanted: impl Fn(&str) -> bool) -> anyhow::Result<()> {
    fs::create_dir_all(to).with_context(|| to.display().to_string())?;
    for entry in fs::read_dir(from).with_context(|| from.display().to_string())? {
        let entry = entry?;
        if entry.file_type()?.is_file() && entry.file_name().to_str().is_some_and(&is_wanted) {
            fs::copy(entry.path(), to.join(entry.file_name()))?;
        }
    }
    Ok(())
}

fn samples(root: &Path) -> anyhow::Result<Vec<Sample>> {
    let sample = |(title, folder, name): (&'static str, &str, &'static str)| {
        let file = sample_file(root, folder, name)?;
        let text = fs::read_to_string(&file).with_context(|| file.display().to_string())?;
        Ok(Sample { title, name, text })
    };
    SAMPLES.into_iter().map(sample).collect()
}

fn sample_file(root: &Path, folder: &str, name: &str) -> anyhow::Result<PathBuf> {
    let Some(parent) = folder.strip_suffix("/*") else { return Ok(root.join(folder).join(name)) };
    let folders = fs::read_dir(root.join(parent)).with_context(|| parent.to_owned())?;
    let mut files = folders.flatten().map(|folder| folder.path().join(name)).filter(|file| file.is_file());
    files.next().with_context(|| format!("no folder of {parent} has {name}"))
}

/// How many bytes web servers send.
fn packed(bytes: &[u8]) -> anyhow::Result<usize> {
    let mut packer = GzEncoder::new(Vec::new(), Compression::default());
    packer.write_all(bytes)?;
    Ok(packer.finish()?.len())
}
