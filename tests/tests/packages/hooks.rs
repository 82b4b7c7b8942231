//! The recipes of `docs/ci.md` for programs that check a commit, in those programs.
//!
//! Knows: prek and lefthook, as `cargo xtask test` installs them. Must not know: how a package is laid out.

use std::fs;
use std::path::PathBuf;

use gcheck_packages::wheel;
use gcheck_testkit::skips::skip;

use crate::place::{Place, here, root, with_build};

/// The program of a tool, where it is installed.
fn tool(path: &str) -> Option<String> {
    let program: PathBuf = root().join(".test-tools").join(path);
    if program.exists() {
        return Some(program.to_string_lossy().into_owned());
    }
    skip("a recipe for hooks", path, "`cargo xtask test` installs it");
    None
}

/// The recipe of the documentation that has some words.
fn recipe(words: &str) -> String {
    let page = fs::read_to_string(root().join("docs/ci.md")).unwrap();
    let mut blocks = page.split("```yaml\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.find(|block| block.contains(words)).unwrap().to_owned()
}

/// Makes a folder of the place a repository with all its files, in one commit that is tagged.
fn commit(place: &Place, folder: &str, tag: &str) {
    let author = ["-c", "user.name=a", "-c", "user.email=a@example.invalid"];
    for command in
        [&["init", "--quiet"][..], &["add", "--all"], &["commit", "--quiet", "-m", "a"], &["tag", tag]]
    {
        place.runs("git", &[&["-C", folder], &author[..], command].concat());
    }
}

/// prek takes the hook from a repository, and the wheel from a folder in place of a registry.
#[test]
fn prek_installs_the_hook_and_finds_what_is_wrong() {
    let package = with_build(here(), wheel);
    let place = Place::with(std::slice::from_ref(&package));
    // It looks for uv beside itself.
    let (Some(prek), Some(_)) = (tool("python/bin/prek"), tool("python/bin/uv")) else { return };
    for file in ["pyproject.toml", ".pre-commit-hooks.yaml", "packages/python/pre_commit_backend.py"] {
        let copy = place.path("hook").join(file);
        fs::create_dir_all(copy.parent().unwrap()).unwrap();
        fs::copy(root().join(file), copy).unwrap();
    }
    let recipe = recipe("- id: gcheck");
    let line = |key: &str| recipe.lines().find_map(|line| line.trim().strip_prefix(key)).unwrap().to_owned();
    commit(&place, "hook", &line("rev: "));
    fs::create_dir_all(place.path("home/.config/uv")).unwrap();
    let from_here = format!("no-index = true\nfind-links = [{:?}]\n", place.text(""));
    fs::write(place.path("home/.config/uv/uv.toml"), from_here).unwrap();

    fs::create_dir(place.path("shop")).unwrap();
    let in_shop = |name: &str| place.path("shop").join(name);
    fs::write(in_shop(".pre-commit-config.yaml"), recipe.replace(&line("- repo: "), &place.text("hook")))
        .unwrap();
    fs::write(in_shop("gcheck.toml"), "control = \"haas-mill\"\n").unwrap();
    fs::write(in_shop("notes.txt"), "G999\n").unwrap();
    fs::copy(place.path("part.nc"), in_shop("-o bad.nc")).unwrap();
    commit(&place, "shop", "start");
    let (code, said) = place.run(&prek, &["--cd", "shop", "run", "--all-files"]);
    assert_eq!(code, 1, "{said}");
    assert!(said.contains("error[unknown-code]") && said.contains("1 error in 1 file"), "{said}");

    fs::write(in_shop("-o bad.nc"), "%\nO0001 (GOOD)\nM30\n%\n").unwrap();
    let (code, said) = place.run(&prek, &["--cd", "shop", "run", "--all-files"]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("Passed"), "{said}");
}

#[test]
fn lefthook_runs_the_recipe_on_the_files_of_the_commit() {
    let place = Place::with(&[]);
    let Some(lefthook) = tool("node_modules/.bin/lefthook") else { return };
    if !place.has("node") {
        return;
    }
    place.install_binary("bin/gcheck");
    fs::create_dir(place.path("shop")).unwrap();
    let in_shop = |name: &str| place.path("shop").join(name);
    fs::write(in_shop("lefthook.yml"), recipe("{staged_files}")).unwrap();
    fs::write(in_shop("gcheck.toml"), "control = \"haas-mill\"\n").unwrap();
    commit(&place, "shop", "start");
    let run = || {
        place.runs("git", &["-C", "shop", "add", "--all"]);
        // It looks for its configuration where it is started.
        let script = "cd shop && exec \"$0\" run pre-commit --no-tty";
        place.run("sh", &["-c", script, &lefthook])
    };
    fs::copy(place.path("part.nc"), in_shop("-o bad.nc")).unwrap();
    fs::write(in_shop("notes.txt"), "G999\n").unwrap();
    let (code, said) = run();
    assert_eq!(code, 1, "{said}");
    assert!(said.contains("error[unknown-code]") && !said.contains("notes.txt"), "{said}");

    fs::write(in_shop("-o bad.nc"), "%\nO0001 (GOOD)\nM30\n%\n").unwrap();
    let (code, said) = run();
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("gcheck"), "it ran: {said}");
}
