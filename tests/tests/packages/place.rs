//! A folder where packages are installed, with a home and a search path of its own.
//!
//! Knows: processes, and how the binary of these tests is packed. Must not know: what is tested.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::thread::sleep;
use std::time::Duration;

use gcheck_packages::{Build, Names, Package, Papers, SHELLS, Target};
use gcheck_testkit::skips::skip;
use tempfile::TempDir;

/// The version of the packages, which is that of the binary.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

const GCHECK: &str = env!("CARGO_BIN_EXE_gcheck-under-test");

/// A mistake on every control.
const PROGRAM: &str = "%\nO0001 (BAD)\nG999\nM30\n%\n";

pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// The system of this machine, with its own C library.
pub(crate) fn here() -> &'static Target {
    Target::named(&format!("{}-unknown-linux-gnu", std::env::consts::ARCH)).unwrap()
}

pub(crate) fn names() -> &'static Names {
    static NAMES: OnceLock<Names> = OnceLock::new();
    NAMES.get_or_init(|| Names::read().unwrap())
}

pub(crate) fn papers() -> &'static Papers {
    static PAPERS: OnceLock<Papers> = OnceLock::new();
    PAPERS.get_or_init(|| {
        let completions: BTreeMap<String, String> = SHELLS
            .into_iter()
            .map(|shell| {
                let output = Command::new(GCHECK).args(["completions", shell]).output().unwrap();
                (shell.to_owned(), String::from_utf8(output.stdout).unwrap())
            })
            .collect();
        Papers::new(completions)
    })
}

/// The binary without symbols, where they can be taken away: a test build has 100 MB of them.
fn binary() -> &'static [u8] {
    static BINARY: OnceLock<Vec<u8>> = OnceLock::new();
    BINARY.get_or_init(|| {
        let folder = TempDir::new().unwrap();
        let stripped = folder.path().join("gcheck");
        let strip = Command::new("strip").arg("-o").arg(&stripped).arg(GCHECK).status();
        fs::read(if strip.is_ok_and(|status| status.success()) { &stripped } else { Path::new(GCHECK) })
            .unwrap()
    })
}

/// Packs the binary of these tests.
pub(crate) fn with_build(
    target: &'static Target,
    pack: impl FnOnce(&Build<'_>) -> anyhow::Result<Package>,
) -> Package {
    let papers = papers();
    pack(&Build { names: names(), version: VERSION, target, binary: binary(), papers, effort: 1 }).unwrap()
}

pub(crate) struct Place {
    folder: TempDir,
}

/// Runs a program that a test has written just now.
///
/// While another test starts a child, that one holds open what this process writes, and the system refuses to start a file
/// that is being written: a moment later it does not.
pub(crate) fn output(command: &mut Command) -> Output {
    const TRIES: usize = 100;
    for _ in 0..TRIES {
        match command.output() {
            Err(error) if error.kind() == ErrorKind::ExecutableFileBusy => sleep(Duration::from_millis(20)),
            result => return result.unwrap_or_else(|error| panic!("{command:?}: {error}")),
        }
    }
    panic!("{command:?}: is being written all the time");
}

impl Place {
    /// A folder with packages in it, and a program to check.
    pub(crate) fn with(packages: &[Package]) -> Self {
        let place = Self { folder: TempDir::new().unwrap() };
        for folder in ["home", "bin"] {
            fs::create_dir(place.path(folder)).unwrap();
        }
        for package in packages {
            let path = place.path(&package.name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, &package.bytes).unwrap();
        }
        fs::write(place.path("part.nc"), PROGRAM).unwrap();
        place
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn text(&self, name: &str) -> String {
        self.path(name).to_string_lossy().into_owned()
    }

    /// Writes a program that comes first on the search path.
    pub(crate) fn program(&self, name: &str, script: &str) {
        fs::write(self.path(name), script).unwrap();
        fs::set_permissions(self.path(name), fs::Permissions::from_mode(0o755)).unwrap();
    }

    /// Puts the binary of these tests somewhere, as a release has it.
    pub(crate) fn install_binary(&self, name: &str) {
        fs::write(self.path(name), binary()).unwrap();
        fs::set_permissions(self.path(name), fs::Permissions::from_mode(0o755)).unwrap();
    }

    /// Runs a program, one with `/` from this folder; its exit code, and all that it said.
    pub(crate) fn run(&self, program: &str, arguments: &[&str]) -> (i32, String) {
        let program = if program.contains('/') { self.path(program) } else { PathBuf::from(program) };
        let mut command = Command::new(&program);
        command.args(arguments).current_dir(self.folder.path()).env_clear();
        let path = std::env::var("PATH").unwrap_or_default();
        command.env("PATH", format!("{}:{path}", self.text("bin")));
        command.env("HOME", self.path("home")).env("PIP_DISABLE_PIP_VERSION_CHECK", "1");
        command.env("GCHECK_DOWNLOAD", format!("file://{}", self.folder.path().display()));
        let output = output(&mut command);
        let said = [output.stdout, output.stderr].concat();
        (output.status.code().unwrap_or(-1), String::from_utf8_lossy(&said).into_owned())
    }

    /// Runs a program that must succeed.
    pub(crate) fn runs(&self, program: &str, arguments: &[&str]) -> String {
        let (code, said) = self.run(program, arguments);
        assert_eq!(code, 0, "{program} {arguments:?}: {said}");
        said
    }

    /// A gcheck that was installed tells its version and finds a mistake.
    pub(crate) fn works(&self, command: &[&str]) {
        let (program, before) = command.split_first().unwrap();
        let call = |arguments: &[&str]| self.run(program, &[before, arguments].concat());
        assert_eq!(call(&["--version"]), (0, format!("gcheck {VERSION}\n")));
        let (code, said) = call(&[
            "check",
            "--quiet",
            "--no-cache",
            "--control",
            "haas-mill",
            "--output-format",
            "concise",
            "part.nc",
        ]);
        assert_eq!(code, 1, "{said}");
        assert!(said.starts_with("part.nc:3:1: error[unknown-code]"), "{said}");
    }

    /// Is a program installed on this machine? Says so when it is not.
    #[expect(clippy::unused_self, reason = "reads as what the place has")]
    pub(crate) fn has(&self, program: &str) -> bool {
        let folders = std::env::var_os("PATH").unwrap_or_default();
        let has = std::env::split_paths(&folders).any(|folder| folder.join(program).is_file());
        if !has {
            skip("a test of packages", program, "install it");
        }
        has
    }

    /// Makes a virtual environment, where Python can. It has no pip of its own: that would take seconds.
    pub(crate) fn has_environment(&self) -> bool {
        let has = self.has("python3")
            && self.run("python3", &["-m", "venv", "--without-pip", "venv"]).0 == 0
            && self.run("python3", &["-m", "pip", "--python", "venv/bin/python", "--version"]).0 == 0;
        if !has {
            skip("a test of the wheel", "pip from 22.3 on with virtual environments", "install python3-venv");
        }
        has
    }

    /// Runs pip on the virtual environment.
    pub(crate) fn pip(&self, arguments: &[&str]) -> String {
        self.runs("python3", &[&["-m", "pip", "--python", "venv/bin/python"], arguments].concat())
    }

    /// Installs tarballs with npm and no registry.
    pub(crate) fn npm_installs(&self, tarballs: &[&str]) {
        let files: Vec<String> = tarballs.iter().map(|name| format!("./{name}")).collect();
        let mut arguments = vec!["install", "--offline", "--no-audit", "--no-fund", "--loglevel=error"];
        arguments.extend(files.iter().map(String::as_str));
        fs::write(self.path("package.json"), "{ \"private\": true }").unwrap();
        self.runs("npm", &arguments);
    }

    /// The files of an extension that say what it is, packed without a server.
    pub(crate) fn extension(&self) -> Vec<u8> {
        let manifest = "<PackageManifest><Metadata><Identity Id=\"gcheck\"/></Metadata></PackageManifest>";
        fs::write(self.path("extension.vsixmanifest"), manifest).unwrap();
        fs::create_dir_all(self.path("extension")).unwrap();
        fs::copy(root().join("editors/vscode/package.json"), self.path("extension/package.json")).unwrap();
        let files = ["-m", "zipfile", "--create", "plain.vsix", "extension.vsixmanifest", "extension/"];
        self.runs("python3", &files);
        fs::read(self.path("plain.vsix")).unwrap()
    }
}
