//! The systems that gcheck runs on, by what each kind of package calls them.
//!
//! Knows: names of systems and processors. Must not know: what is in a package.

use anyhow::{Context as _, bail};

/// A system with its processor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Target {
    /// As Rust calls it.
    pub triple: &'static str,
    /// Tags of a wheel, one or more with `.` between.
    pub wheel: &'static str,
    /// `os` and `cpu` of npm.
    pub npm: (&'static str, &'static str),
    /// As VS Code calls it.
    pub vscode: &'static str,
    /// Debian's architecture; empty for other systems.
    pub debian: &'static str,
    /// The name of the processor in images; empty where there is no image.
    pub image: &'static str,
    /// Whether the binary needs the C library of the system.
    pub needs_libc: bool,
}

/// Linux binaries use musl: one file that runs on every distribution, whatever its C library.
const LINUX_X64: Target = Target {
    triple: "x86_64-unknown-linux-musl",
    wheel: "manylinux_2_17_x86_64.manylinux2014_x86_64.musllinux_1_1_x86_64",
    npm: ("linux", "x64"),
    vscode: "linux-x64",
    debian: "amd64",
    image: "amd64",
    needs_libc: false,
};

/// A build for this machine's own Linux: to try packages, not to publish them.
const LOCAL_LINUX_X64: Target =
    Target { triple: "x86_64-unknown-linux-gnu", wheel: "linux_x86_64", needs_libc: true, ..LINUX_X64 };

const LINUX_ARM64: Target = Target {
    triple: "aarch64-unknown-linux-musl",
    wheel: "manylinux_2_17_aarch64.manylinux2014_aarch64.musllinux_1_1_aarch64",
    npm: ("linux", "arm64"),
    vscode: "linux-arm64",
    debian: "arm64",
    image: "arm64",
    needs_libc: false,
};

const LOCAL_LINUX_ARM64: Target =
    Target { triple: "aarch64-unknown-linux-gnu", wheel: "linux_aarch64", needs_libc: true, ..LINUX_ARM64 };

const OTHER: Target =
    Target { triple: "", wheel: "", npm: ("", ""), vscode: "", debian: "", image: "", needs_libc: false };

/// What releases are built for.
pub const PUBLISHED: &[Target] = &[
    LINUX_X64,
    LINUX_ARM64,
    Target {
        triple: "x86_64-apple-darwin",
        wheel: "macosx_10_12_x86_64",
        npm: ("darwin", "x64"),
        vscode: "darwin-x64",
        ..OTHER
    },
    Target {
        triple: "aarch64-apple-darwin",
        wheel: "macosx_11_0_arm64",
        npm: ("darwin", "arm64"),
        vscode: "darwin-arm64",
        ..OTHER
    },
    Target {
        triple: "x86_64-pc-windows-msvc",
        wheel: "win_amd64",
        npm: ("win32", "x64"),
        vscode: "win32-x64",
        ..OTHER
    },
    Target {
        triple: "aarch64-pc-windows-msvc",
        wheel: "win_arm64",
        npm: ("win32", "arm64"),
        vscode: "win32-arm64",
        ..OTHER
    },
];

static LOCAL: &[Target] = &[LOCAL_LINUX_X64, LOCAL_LINUX_ARM64];

impl Target {
    /// The target of a triple.
    ///
    /// # Errors
    /// When there are no packages for it.
    pub fn named(triple: &str) -> anyhow::Result<&'static Self> {
        let known = PUBLISHED.iter().chain(LOCAL).find(|target| target.triple == triple);
        if known.is_none() {
            let all: Vec<&str> = PUBLISHED.iter().chain(LOCAL).map(|target| target.triple).collect();
            bail!("there are no packages for `{triple}`; there are for {}", all.join(", "));
        }
        known.context("the target is known")
    }

    /// Runs on Windows.
    pub fn is_windows(&self) -> bool {
        self.triple.contains("windows")
    }

    /// The file name of the binary.
    pub fn binary_name(&self) -> &'static str {
        if self.is_windows() { "gcheck.exe" } else { "gcheck" }
    }

    /// The name of its npm package without the scope.
    pub fn npm_name(&self) -> String {
        format!("cli-{}-{}", self.npm.0, self.npm.1)
    }

    /// The file name of its archive.
    pub fn archive_name(&self, version: &str) -> String {
        format!("{}.{}", self.stem(version), if self.is_windows() { "zip" } else { "tar.gz" })
    }

    /// The name of the folder in its archive.
    pub fn stem(&self, version: &str) -> String {
        format!("gcheck-v{version}-{}", self.triple)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_of_a_published_target_is_its_own() {
        let kinds: [fn(&Target) -> String; 4] =
            [|t| t.triple.to_owned(), |t| t.wheel.to_owned(), Target::npm_name, |t| t.vscode.to_owned()];
        for name in kinds {
            let mut names: Vec<String> = PUBLISHED.iter().map(name).collect();
            assert!(names.iter().all(|name| !name.is_empty()));
            names.sort();
            names.dedup();
            assert_eq!(names.len(), PUBLISHED.len());
        }
    }

    #[test]
    fn the_workflow_builds_for_every_published_target_once() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
        let workflow = std::fs::read_to_string(root.join(".github/workflows/release.yml")).unwrap();
        let built = workflow.lines().filter_map(|line| line.split_once(", target: "));
        let mut built: Vec<&str> = built.map(|(_, rest)| rest.trim_end_matches(" }")).collect();
        let mut published: Vec<&str> = PUBLISHED.iter().map(|target| target.triple).collect();
        built.sort_unstable();
        published.sort_unstable();
        assert_eq!(built, published);
    }

    #[test]
    fn a_system_without_packages_is_refused_with_those_that_have_them() {
        let error = Target::named("riscv64gc-unknown-linux-gnu").unwrap_err().to_string();
        assert!(error.starts_with("there are no packages for `riscv64gc-unknown-linux-gnu`"), "{error}");
        assert!(error.contains("x86_64-unknown-linux-musl"), "{error}");
    }
}
