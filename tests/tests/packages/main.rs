//! The packages of a release, installed from local files as people install them, and what they install checks a program.
//!
//! Knows: pip, npm, dpkg, tar and shells, and what runs hooks, which are skipped where they are missing. Must not know: how a package is laid
//! out. Nothing here reaches a registry. What is packed is the binary of these tests: a build in the profile `dist` would
//! take minutes.

#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

mod containers;
mod hooks;
mod place;

use std::fs;
use std::os::unix::fs::PermissionsExt as _;

use gcheck_packages::{
    PUBLISHED, Package, Target, archive, deb, npm_launcher, npm_platform, recipes, vsix, wheel,
};

use place::{Place, VERSION, here, names, papers, with_build};

#[test]
fn the_archive_unpacks_to_a_program_with_its_texts() {
    let place = Place::with(&[with_build(here(), archive)]);
    let stem = here().stem(VERSION);
    place.runs("tar", &["-xzf", &here().archive_name(VERSION)]);
    for file in ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE", "completions/gcheck.zsh"] {
        assert!(place.path(&format!("{stem}/{file}")).is_file(), "{file}");
    }
    place.works(&[&place.text(&format!("{stem}/gcheck"))]);
}

#[test]
fn pip_installs_the_wheel_and_takes_it_away_again() {
    let package = with_build(here(), wheel);
    let place = Place::with(std::slice::from_ref(&package));
    if !place.has_environment() {
        return;
    }
    place.pip(&["install", "--quiet", "--no-index", &package.name]);
    place.works(&["venv/bin/gcheck"]);
    place.works(&["venv/bin/python", "-m", "gcheck"]);
    place.pip(&["check"]);
    let shown = place.pip(&["show", "gcheck"]);
    assert!(shown.contains(&format!("Version: {VERSION}")), "{shown}");
    place.pip(&["uninstall", "--quiet", "--yes", "gcheck"]);
    assert!(!place.path("venv/bin/gcheck").exists());
}

#[test]
fn a_published_wheel_installs_on_every_linux_of_its_processor() {
    let target = Target::named(&here().triple.replace("-gnu", "-musl")).unwrap();
    let package = with_build(target, wheel);
    assert!(package.name.contains("manylinux") && package.name.contains("musllinux"), "{}", package.name);
    let place = Place::with(std::slice::from_ref(&package));
    if place.has_environment() {
        place.pip(&["install", "--quiet", "--no-index", &package.name]);
        place.works(&["venv/bin/gcheck"]);
    }
}

#[test]
fn a_wheel_whose_binary_cannot_run_says_so() {
    let package = with_build(here(), wheel);
    let place = Place::with(std::slice::from_ref(&package));
    if !place.has_environment() {
        return;
    }
    place.pip(&["install", "--quiet", "--no-index", &package.name]);
    fs::set_permissions(place.path("venv/bin/gcheck"), fs::Permissions::from_mode(0o644)).unwrap();
    let (code, said) = place.run("venv/bin/python", &["-m", "gcheck", "--version"]);
    assert_eq!(code, 1, "{said}");
    assert!(
        said.starts_with("gcheck cannot be started: ") && said.contains("install the package again"),
        "{said}"
    );
}

/// pre-commit installs the repository of a hook with pip; here the wheel comes from a folder in place of a registry.
#[test]
fn the_hook_of_pre_commit_installs_the_wheel_of_its_version() {
    let file = |name: &str| Package {
        name: format!("hook/{name}"),
        bytes: fs::read(place::root().join(name)).unwrap(),
    };
    let hook = [file("pyproject.toml"), file("packages/python/pre_commit_backend.py")];
    let place = Place::with(&[&[with_build(here(), wheel)], &hook[..]].concat());
    if !place.has_environment() {
        return;
    }
    place.pip(&["install", "--quiet", "--no-index", "--find-links", ".", "./hook"]);
    place.works(&["venv/bin/gcheck"]);
}

#[test]
fn npm_installs_the_launcher_with_the_binary_of_this_system() {
    let platform = with_build(here(), npm_platform);
    let launcher = npm_launcher(names(), VERSION, papers()).unwrap();
    let place = Place::with(&[platform.clone(), launcher.clone()]);
    if !place.has("npm") {
        return;
    }
    place.npm_installs(&[&platform.name, &launcher.name]);
    place.works(&["node_modules/.bin/gcheck"]);
    let (code, said) = place.run("node_modules/.bin/gcheck", &["check", "missing.nc"]);
    assert_eq!(code, 2, "the exit code is that of the binary: {said}");
}

#[test]
fn the_launcher_without_a_binary_says_what_to_do() {
    let launcher = npm_launcher(names(), VERSION, papers()).unwrap();
    let place = Place::with(std::slice::from_ref(&launcher));
    if !place.has("npm") {
        return;
    }
    place.runs("tar", &["-xzf", &launcher.name]);
    let (code, said) = place.run("node", &["package/bin/gcheck.js", "--version"]);
    assert_eq!(code, 1, "{said}");
    assert!(said.contains("with the binary for this system is not installed"), "{said}");
    assert!(said.contains("--omit=optional") && said.contains("GCHECK_BINARY"), "{said}");
}

#[test]
fn the_debian_package_unpacks_to_a_program_with_completions() {
    let package = with_build(here(), deb);
    let place = Place::with(std::slice::from_ref(&package));
    if !place.has("dpkg-deb") {
        return;
    }
    for (field, value) in [("Package", "gcheck"), ("Version", VERSION), ("Architecture", here().debian)] {
        assert_eq!(place.runs("dpkg-deb", &["--field", &package.name, field]).trim(), value);
    }
    let depends = place.runs("dpkg-deb", &["--field", &package.name, "Depends"]);
    let names_version = depends.trim().starts_with("libc6 (>= 2.");
    assert_eq!(names_version, here().needs_libc, "{depends}");
    place.runs("dpkg-deb", &["--extract", &package.name, "root"]);
    place.works(&["root/usr/bin/gcheck"]);
    for file in ["bash-completion/completions/gcheck", "doc/gcheck/copyright"] {
        assert!(place.path(&format!("root/usr/share/{file}")).is_file(), "{file}");
    }
}

/// With a database of its own, so that nothing of this machine's is touched.
#[test]
fn dpkg_installs_the_package_and_removes_it() {
    let package = with_build(here(), deb);
    let place = Place::with(std::slice::from_ref(&package));
    if !place.has("dpkg") {
        return;
    }
    for folder in ["root/var/lib/dpkg/info", "root/var/lib/dpkg/updates", "root/var/lib/dpkg/triggers"] {
        fs::create_dir_all(place.path(folder)).unwrap();
    }
    fs::write(place.path("root/var/lib/dpkg/status"), "").unwrap();
    let dpkg = |arguments: &[&str]| {
        let root = format!("--root={}", place.text("root"));
        let log = format!("--log={}", place.text("dpkg.log"));
        let always = [root.as_str(), &log, "--force-not-root", "--force-depends", "--force-bad-path"];
        place.runs("dpkg", &[&always[..], arguments].concat())
    };
    dpkg(&["--install", &package.name]);
    place.works(&["root/usr/bin/gcheck"]);
    assert!(dpkg(&["--list", "gcheck"]).contains(VERSION));
    dpkg(&["--purge", "gcheck"]);
    assert!(!place.path("root/usr/bin/gcheck").exists());
}

/// An extension as `vsce` packs it holds these files and others.
#[test]
fn the_server_in_the_extension_starts() {
    let place = Place::with(&[]);
    let extension = place.extension();
    let package = with_build(here(), |build| vsix(build, &extension));
    fs::write(place.path(&package.name), &package.bytes).unwrap();
    if !place.has("python3") {
        return;
    }
    place.runs("python3", &["-m", "zipfile", "--extract", &package.name, "unpacked"]);
    let server = place.path("unpacked/extension/server/gcheck");
    // Python's unzip forgets permissions; VS Code keeps them, and the test of the layout looks at them.
    fs::set_permissions(server, fs::Permissions::from_mode(0o755)).unwrap();
    place.works(&["unpacked/extension/server/gcheck"]);
}

/// A folder with the archives of a release for all systems, and the recipes that go with them.
fn release() -> Place {
    let linux = Target::named(&here().triple.replace("-gnu", "-musl")).unwrap();
    let mut archives = vec![with_build(linux, archive)];
    for target in PUBLISHED.iter().filter(|target| *target != linux) {
        archives.push(Package { name: target.archive_name(VERSION), bytes: target.triple.into() });
    }
    let recipes = recipes(names(), VERSION, &archives).unwrap();
    archives.extend(recipes);
    Place::with(&archives)
}

#[test]
fn the_installer_compares_the_checksum_and_installs() {
    let place = release();
    if !place.has("curl") {
        return;
    }
    let said = place.runs("sh", &["install.sh"]);
    assert!(said.contains(&format!("gcheck {VERSION} is in ")), "{said}");
    assert!(said.contains("is not on the search path"), "{said}");
    place.works(&["home/.local/bin/gcheck"]);
    // Again, over the one that is there.
    place.runs("sh", &["install.sh"]);
    place.works(&["home/.local/bin/gcheck"]);
}

#[test]
fn an_archive_with_another_checksum_is_not_installed() {
    let place = release();
    if !place.has("curl") {
        return;
    }
    let name = Target::named(&here().triple.replace("-gnu", "-musl")).unwrap().archive_name(VERSION);
    fs::write(place.path(&name), "something else").unwrap();
    let (code, said) = place.run("sh", &["install.sh"]);
    assert_eq!(code, 1, "{said}");
    assert!(said.starts_with(&format!("gcheck is not installed: the checksum of {name} is ")), "{said}");
    fs::remove_file(place.path(&name)).unwrap();
    let (code, said) = place.run("sh", &["install.sh"]);
    assert_eq!(code, 1, "{said}");
    assert!(said.contains(&format!("/{name} cannot be downloaded")), "{said}");
    assert!(!place.path("home/.local/bin/gcheck").exists());
}

#[test]
fn a_system_without_a_binary_is_told_so() {
    let place = release();
    place.program("bin/uname", "#!/bin/sh\ncase $1 in -s) echo FreeBSD ;; *) echo riscv64 ;; esac\n");
    let (code, said) = place.run("sh", &["install.sh"]);
    assert_eq!(code, 1, "{said}");
    assert_eq!(
        said,
        "gcheck is not installed: there is no binary for FreeBSD on riscv64; build it from source (see README.md)\n"
    );
}
