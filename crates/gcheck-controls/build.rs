//! Lists the folders of `data/` so that a control is added by adding a folder, never by editing code.

use std::fmt::Write as _;
use std::{env, fs, path::Path};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let data = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("data");
    println!("cargo::rerun-if-changed={}", data.display());
    let mut folders: Vec<_> = fs::read_dir(&data)?.collect::<Result<_, _>>()?;
    folders.sort_by_key(fs::DirEntry::file_name);
    let mut out = String::from("pub(crate) static SOURCES: &[Source] = &[\n");
    for folder in folders.iter().filter(|f| f.path().join("control.toml").exists()) {
        writeln!(out, "    Source {{ name: {}, files: &[", literal(folder.file_name().as_ref())?)?;
        let mut files: Vec<_> = fs::read_dir(folder.path())?.collect::<Result<_, _>>()?;
        files.sort_by_key(fs::DirEntry::file_name);
        for file in files.iter().filter(|f| f.path().extension().is_some_and(|e| e == "toml")) {
            println!("cargo::rerun-if-changed={}", file.path().display());
            let name = literal(file.file_name().as_ref())?;
            writeln!(out, "        ({name}, include_str!({})),", literal(&file.path())?)?;
        }
        out.push_str("    ] },\n");
    }
    out.push_str("];\n");
    fs::write(Path::new(&env::var("OUT_DIR")?).join("sources.rs"), out)?;
    Ok(())
}

/// A path as a string literal of Rust source.
fn literal(path: &Path) -> Result<String, Box<dyn std::error::Error>> {
    Ok(format!("{:?}", path.to_str().ok_or("a path of the data folder is not UTF-8")?))
}
