//! Turns the folders of `data/` into what the crate embeds: a list of folders and their files, each as JSON.
//!
//! A control is added by adding a folder, never by editing code. The files are written as TOML for people; JSON is read
//! several times faster, and the start of every run reads a control.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    let data = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("data");
    let out = PathBuf::from(env::var("OUT_DIR")?);
    println!("cargo::rerun-if-changed={}", data.display());
    let mut list = String::from("pub(crate) static SOURCES: &[Source] = &[\n");
    for folder in sorted(&data)?.iter().filter(|folder| folder.join("control.toml").exists()) {
        let name = file_name(folder)?;
        writeln!(list, "    Source {{ name: {name:?}, files: &[")?;
        fs::create_dir_all(out.join(name))?;
        for file in sorted(folder)?.iter().filter(|file| file.extension().is_some_and(|e| e == "toml")) {
            println!("cargo::rerun-if-changed={}", file.display());
            let json = out.join(name).join(file_name(file)?).with_extension("json");
            fs::write(&json, to_json(file)?)?;
            let json = json.to_str().ok_or("the build folder's path is not UTF-8")?;
            writeln!(list, "        ({:?}, include_str!({json:?})),", file_name(file)?)?;
        }
        list.push_str("    ] },\n");
    }
    list.push_str("];\n");
    fs::write(out.join("sources.rs"), list)?;
    fs::write(out.join("machines.rs"), machines(&data.join("machines"))?)?;
    fs::write(out.join("unsupported.json"), to_json(&data.join("unsupported.toml"))?)?;
    Ok(())
}

/// The list of machines by name, with the texts of their files: they are read as a configuration is.
fn machines(folder: &Path) -> Result<String> {
    let mut list = String::from("pub(crate) static MACHINES: &[MachineModel] = &[\n");
    for file in sorted(folder)?.iter().filter(|file| file.extension().is_some_and(|e| e == "toml")) {
        println!("cargo::rerun-if-changed={}", file.display());
        let name =
            file.file_stem().and_then(|name| name.to_str()).ok_or("a name of a machine is not UTF-8")?;
        let path = file.to_str().ok_or("the path of the data is not UTF-8")?;
        writeln!(list, "    MachineModel {{ name: {name:?}, text: include_str!({path:?}) }},")?;
    }
    list.push_str("];\n");
    Ok(list)
}

fn sorted(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

fn file_name(path: &Path) -> Result<&str> {
    Ok(path.file_name().and_then(|name| name.to_str()).ok_or("a name in the data folder is not UTF-8")?)
}

fn to_json(file: &Path) -> Result<String> {
    let table: toml::Table =
        toml::from_str(&fs::read_to_string(file)?).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(serde_json::to_string(&table)?)
}
