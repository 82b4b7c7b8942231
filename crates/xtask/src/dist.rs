//! `cargo xtask dist`: the packages of a release, in a folder.
//!
//! Knows: the order of the work, where the binary comes from. Must not know: how a package is laid out; that is
//! `gcheck-packages`.

mod components;
mod vscode;

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

use anyhow::{Context as _, bail, ensure};
use gcheck_packages::{
    Build, Names, PUBLISHED, Package, Papers, SHELLS, Target, archive, deb, image, npm_launcher,
    npm_platform, recipes, sbom, sums, vsix, wheel,
};

use crate::workspace;

/// Bytes of a stripped binary that nobody has to think about before publishing it.
const MOST: usize = 18_000_000;

/// What the command line asks for.
#[derive(Default)]
struct Wishes {
    release: bool,
    vscode: bool,
    target: Option<String>,
    binary: Option<PathBuf>,
    out: Option<PathBuf>,
}

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> anyhow::Result<ExitCode> {
    let wishes = wishes(arguments)?;
    let members = workspace::members()?;
    let gcheck = members.packages.iter().find(|package| package.name.as_str() == "gcheck");
    let version = gcheck.context("the workspace has no gcheck")?.version.to_string();
    let target_folder = members.target_directory.into_std_path_buf();
    let out = wishes.out.clone().unwrap_or_else(|| target_folder.join("packages"));
    fs::create_dir_all(&out).with_context(|| out.display().to_string())?;
    let names = Names::read()?;
    if wishes.release {
        return release(&names, &version, &out);
    }
    let triple = wishes.target.clone().map_or_else(host, Ok)?;
    let target = Target::named(&triple)?;
    let path = match &wishes.binary {
        Some(path) => path.clone(),
        None => build(target, wishes.target.is_some(), &target_folder)?,
    };
    let binary = fs::read(&path).with_context(|| path.display().to_string())?;
    let papers = Papers::new(completions(&path)?);
    let build =
        Build { names: &names, version: &version, target, binary: &binary, papers: &papers, effort: 9 };
    let packers: [fn(&Build<'_>) -> anyhow::Result<Package>; 3] = [archive, wheel, npm_platform];
    for packer in packers {
        pack(&out, || packer(&build))?;
    }
    if !target.debian.is_empty() {
        pack(&out, || deb(&build))?;
    }
    if wishes.vscode {
        pack(&out, || vsix(&build, &vscode::extension(&out)?))?;
    }
    pack(&out, || sbom(&build, &components::components(target.triple)?))?;
    println!("{:>11}  {} itself", binary.len(), path.display());
    if binary.len() > MOST {
        println!("the binary has more than {MOST} bytes, which is what a published one should have at most");
    }
    Ok(ExitCode::SUCCESS)
}

fn wishes(arguments: &[String]) -> anyhow::Result<Wishes> {
    let mut wishes = Wishes::default();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let mut value = || rest.next().with_context(|| format!("`{argument}` needs a value"));
        match argument.as_str() {
            "release" => wishes.release = true,
            "--vscode" => wishes.vscode = true,
            "--target" => wishes.target = Some(value()?.clone()),
            "--binary" => wishes.binary = Some(env::current_dir()?.join(value()?)),
            "--out" => wishes.out = Some(env::current_dir()?.join(value()?)),
            unknown => bail!("`{unknown}` is not an option of `cargo xtask dist`"),
        }
    }
    let of_one_system = wishes.vscode || wishes.target.is_some() || wishes.binary.is_some();
    ensure!(!(wishes.release && of_one_system), "`dist release` takes `--out` only");
    Ok(wishes)
}

/// The triple of this machine.
fn host() -> anyhow::Result<String> {
    let version = Command::new("rustc").arg("-vV").output().context("rustc does not start")?;
    let version = String::from_utf8_lossy(&version.stdout).into_owned();
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    Ok(host.context("`rustc -vV` does not name the host")?.to_owned())
}

/// Builds the binary in the profile `dist`.
fn build(target: &Target, is_named: bool, target_folder: &Path) -> anyhow::Result<PathBuf> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(workspace::root());
    cargo.args(["build", "--profile", "dist", "--locked", "--package", "gcheck"]);
    let mut folder = target_folder.to_owned();
    if is_named {
        cargo.args(["--target", target.triple]);
        folder.push(target.triple);
    }
    ensure!(cargo.status().context("cargo does not start")?.success(), "the build fails");
    Ok(folder.join("dist").join(target.binary_name()))
}

/// What the binary prints as completions, by shell.
fn completions(binary: &Path) -> anyhow::Result<BTreeMap<String, String>> {
    let mut completions = BTreeMap::new();
    for shell in SHELLS {
        let output = Command::new(binary).args(["completions", shell]).output();
        let output = output.with_context(|| format!("{} does not start", binary.display()))?;
        ensure!(output.status.success(), "{} has no completions for {shell}", binary.display());
        completions.insert(shell.to_owned(), String::from_utf8(output.stdout)?);
    }
    Ok(completions)
}

/// Everything that is made once, from the packages of all systems.
fn release(names: &Names, version: &str, out: &Path) -> anyhow::Result<ExitCode> {
    let read = |name: String| -> anyhow::Result<Package> {
        let bytes = fs::read(out.join(&name)).with_context(|| out.join(&name).display().to_string())?;
        Ok(Package { name, bytes })
    };
    let archives: Vec<Package> =
        PUBLISHED.iter().map(|target| read(target.archive_name(version))).collect::<anyhow::Result<_>>()?;
    let papers = Papers::new(BTreeMap::new());
    let mut packages = recipes(names, version, &archives)?;
    packages.extend(image(version, &archives)?);
    packages.push(npm_launcher(names, version, &papers)?);
    write(out, &packages)?;
    let files = attached(out, out)?;
    write(out, &[sums(&files)])?;
    Ok(ExitCode::SUCCESS)
}

/// What a release attaches, by file name: everything but the list of checksums and what an image is built from.
fn attached(out: &Path, folder: &Path) -> anyhow::Result<Vec<Package>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if path.is_dir() {
            if path != out.join("docker") {
                files.extend(attached(out, &path)?);
            }
        } else if name != "SHA256SUMS" {
            let bytes = fs::read(&path).with_context(|| path.display().to_string())?;
            files.push(Package { name, bytes });
        }
    }
    Ok(files)
}

/// Makes a package and writes it; says how large it is and how long it took.
fn pack(out: &Path, make: impl FnOnce() -> anyhow::Result<Package>) -> anyhow::Result<()> {
    let start = Instant::now();
    let package = make()?;
    let seconds = start.elapsed().as_secs_f64();
    write(out, &[package])?;
    println!("{:>11}  in {seconds:.1} s", "");
    Ok(())
}

fn write(out: &Path, packages: &[Package]) -> anyhow::Result<()> {
    for package in packages {
        let path = out.join(&package.name);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(&path, &package.bytes).with_context(|| path.display().to_string())?;
        say(&path)?;
    }
    Ok(())
}

/// Prints the size of a file and its path.
fn say(path: &Path) -> anyhow::Result<()> {
    println!("{:>11}  {}", fs::metadata(path)?.len(), path.display());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::wishes;

    fn refused(arguments: &[&str]) -> String {
        let arguments: Vec<String> = arguments.iter().map(|argument| (*argument).to_owned()).collect();
        wishes(&arguments).err().map(|error| error.to_string()).unwrap_or_default()
    }

    #[test]
    fn options_that_do_not_exist_or_contradict_are_refused() {
        assert_eq!(refused(&["--target", "x86_64-unknown-linux-musl", "--vscode"]), "");
        assert_eq!(refused(&["--target"]), "`--target` needs a value");
        assert_eq!(refused(&["--fast"]), "`--fast` is not an option of `cargo xtask dist`");
        assert_eq!(refused(&["release", "--vscode"]), "`dist release` takes `--out` only");
    }
}
