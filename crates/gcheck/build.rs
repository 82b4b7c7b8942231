//! Names the build: a hash over the sources that a verdict comes from.
//!
//! Knows: which folders of the workspace end up in the program. Must not know: what is in them. The result cache keeps the
//! findings of one build from another; between releases the version alone does not tell them apart. Built from a registry,
//! where the other crates lie elsewhere, the versions in the lock file's place do: a published version never changes.

use std::collections::hash_map::DefaultHasher;
use std::fs;
use std::hash::{Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::{env, io};

/// Siblings that never end up in the program.
const NOT_IN_IT: [&str; 2] = ["gcheck-testkit", "xtask"];

fn main() -> io::Result<()> {
    let own = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let mut crates = vec![own.clone()];
    if let Some(folder) = own.parent().filter(|folder| folder.join("gcheck-rules").is_dir()) {
        crates = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>()?;
        crates.retain(|path| {
            let name = path.file_name().unwrap_or_default();
            path.join("Cargo.toml").is_file() && NOT_IN_IT.iter().all(|not| name != *not)
        });
    }
    let mut files = Vec::new();
    for path in &crates {
        for part in ["src", "data", "build.rs", "Cargo.toml"] {
            let part = path.join(part);
            if part.exists() {
                println!("cargo::rerun-if-changed={}", part.display());
                collect(&part, &mut files)?;
            }
        }
    }
    let lock = own.join("../../Cargo.lock");
    if lock.exists() {
        println!("cargo::rerun-if-changed={}", lock.display());
        files.push(lock);
    }
    files.sort();
    let mut hasher = DefaultHasher::new();
    for file in &files {
        // The place of the checkout does not count.
        file.strip_prefix(own.parent().unwrap_or(&own)).unwrap_or(file).hash(&mut hasher);
        fs::read(file)?.hash(&mut hasher);
    }
    println!("cargo::rustc-env=GCHECK_BUILD={:016x}", hasher.finish());
    Ok(())
}

/// The files at and below a path.
fn collect(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !path.is_dir() {
        files.push(path.to_owned());
        return Ok(());
    }
    for entry in fs::read_dir(path)? {
        collect(&entry?.path(), files)?;
    }
    Ok(())
}
