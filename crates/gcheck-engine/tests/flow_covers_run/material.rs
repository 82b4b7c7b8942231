//! Programs of the repository and of the corpus.
//!
//! Knows: where they are, which control reads them. Must not know: what is compared.

use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gcheck_engine::{Library, Machine, SourceFile};
use gcheck_testkit::corpus;

use crate::law::Case;

/// A program on disk or in a test.
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) control: String,
    pub(crate) text: String,
    pub(crate) machine: Machine,
    pub(crate) folder: Folder,
}

impl Source {
    /// The program as a case of the law, with what a run may execute.
    pub(crate) fn case(&self, fuel: u64) -> Case<'_> {
        Case {
            name: &self.name,
            control: &self.control,
            text: &self.text,
            machine: &self.machine,
            library: &self.folder,
            work: 200_000,
            fuel,
        }
    }
}

/// Programs beside a program.
pub(crate) struct Folder(pub(crate) Option<PathBuf>);

impl Folder {
    fn find(&self, name: &str) -> Option<SourceFile> {
        let path = self.0.as_ref()?.join(name);
        let text = String::from_utf8_lossy(&fs::read(path).ok()?).into_owned();
        Some(SourceFile { name: Rc::from(name), text })
    }
}

impl Library for Folder {
    fn by_number(&self, number: u32) -> Option<SourceFile> {
        ["nc", "NC", "ngc", "cnc"].iter().find_map(|ending| {
            self.find(&format!("O{number:04}.{ending}")).or_else(|| self.find(&format!("{number}.{ending}")))
        })
    }

    fn by_name(&self, name: &str) -> Option<SourceFile> {
        self.find(&format!("{name}.ngc"))
    }
}

/// Larger programs would take longer than they show.
const LARGEST: u64 = 40_000;

/// The programs under `fixtures`.
pub(crate) fn fixtures() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().join("fixtures");
    let mut sources = Vec::new();
    for control in ["fanuc-lathe", "fanuc-lathe-b", "fanuc-lathe-c", "fanuc-mill", "generic-mill", "grbl"]
        .into_iter()
        .chain(["haas-lathe", "haas-mill", "linuxcnc"])
    {
        collect(&root.join("clean").join(control), control, &mut sources);
    }
    for folder in ["oracle", "timing"] {
        collect(&root.join(folder), "linuxcnc", &mut sources);
    }
    for name in ["bore", "bracket", "bushing", "impeller", "manifold", "pin", "plate", "shaft", "sleeve"] {
        let control = match name {
            "bushing" | "pin" | "shaft" => "haas-lathe",
            _ => "haas-mill",
        };
        read(&root.join("tour").join(name).with_extension("nc"), control, &mut sources);
    }
    read(&root.join("tour/probe-grid.ngc"), "linuxcnc", &mut sources);
    assert!(sources.len() > 500, "{} fixtures", sources.len());
    sources
}

fn collect(folder: &Path, control: &str, sources: &mut Vec<Source>) {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            collect(&path, control, sources);
        } else if path.extension().is_some_and(|ending| ending == "nc" || ending == "ngc") {
            read(&path, control, sources);
        }
    }
}

fn read(path: &Path, control: &str, sources: &mut Vec<Source>) {
    let text = String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
    sources.push(Source {
        name: path.file_name().unwrap().to_string_lossy().into_owned(),
        control: control.to_owned(),
        text,
        machine: Machine::default(),
        folder: Folder(path.parent().map(Path::to_owned)),
    });
}

/// The smaller programs of the corpus, where there is one.
pub(crate) fn corpus() -> Option<Vec<Source>> {
    let mut sources = Vec::new();
    for program in corpus::programs()? {
        let is_small = fs::metadata(&program.path).is_ok_and(|file| file.len() <= LARGEST);
        if is_small && gcheck_controls::load(&program.control).is_ok() {
            read(&program.path, &program.control, &mut sources);
            sources.last_mut().unwrap().name.clone_from(&program.name);
        }
    }
    Some(sources)
}
