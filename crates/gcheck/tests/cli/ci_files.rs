//! The files of the repository that run gcheck elsewhere: the GitHub Action, workflows, the pre-commit hook, the recipes of
//! the documentation. Their scripts are run where a shell is enough; the rest is held against what exists.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::shop::{BAD, GOOD, Run, Shop};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn yaml(path: &str) -> Value {
    serde_saphyr::from_str(&text(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The action's last step in a shell, with inputs as GitHub gives them.
#[cfg(unix)]
fn action(shop: &Shop, inputs: &[(&str, &str)]) -> Run {
    let action = yaml("action.yml");
    let step = action["runs"]["steps"].as_array().unwrap().last().unwrap();
    let given: BTreeMap<&str, &str> = inputs.iter().copied().collect();
    for name in given.keys() {
        assert!(action["inputs"].get(*name).is_some(), "the action has no input `{name}`");
    }
    let mut command = Command::new("bash");
    // As runners call it.
    command.args(["--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"].as_str().unwrap()]);
    command.current_dir(shop.path("")).env_clear();
    let bin = Path::new(env!("CARGO_BIN_EXE_gcheck")).parent().unwrap().to_string_lossy().into_owned();
    command.env("PATH", format!("{bin}:{}", std::env::var("PATH").unwrap()));
    command.env("RUNNER_TEMP", shop.path("temp")).env("GITHUB_STEP_SUMMARY", shop.path("temp/summary.md"));
    fs::create_dir_all(shop.path("temp")).unwrap();
    for (variable, value) in step["env"].as_object().unwrap() {
        let input = value.as_str().unwrap().strip_prefix("${{ inputs.").unwrap().strip_suffix(" }}").unwrap();
        let default = action["inputs"][input]["default"].as_str().unwrap();
        command.env(variable, given.get(input).copied().unwrap_or(default));
    }
    shop.finish(&mut command, b"")
}

#[cfg(unix)]
#[test]
fn the_action_annotates_summarises_and_fails() {
    let shop = Shop::with(&[("jobs/bad.nc", BAD), ("jobs/good.nc", GOOD)]);
    let run = action(&shop, &[("control", "haas-mill"), ("paths", "jobs"), ("sarif", "out.sarif")]);
    assert_eq!(run.code, 1, "{run}");
    assert!(run.stdout.starts_with("::error title=gcheck (unknown-code),file=jobs/bad.nc,"), "{run}");
    assert!(shop.read("out.sarif").contains("\"2.1.0\""));
    let summary = shop.read("temp/summary.md");
    assert!(summary.starts_with("### gcheck\n```text\n") && summary.ends_with("```\n"), "{summary}");
    assert!(
        summary.contains("error     unknown-code") && summary.contains("1 error in 2 files"),
        "{summary}"
    );
    assert!(shop.path("temp/gcheck-cache/CACHEDIR.TAG").exists(), "what the next run begins with");
}

#[cfg(unix)]
#[test]
fn the_action_passes_with_a_baseline_or_without_findings() {
    let shop = Shop::with(&[("bad.nc", BAD), ("good.nc", GOOD)]);
    assert_eq!(action(&shop, &[("paths", "good.nc")]).code, 0);
    assert_eq!(shop.gcheck("check --control haas-mill --baseline known.json --update-baseline").code, 0);
    let run = action(&shop, &[("control", "haas-mill"), ("baseline", "known.json")]);
    assert_eq!((run.code, run.stdout.as_str()), (0, ""), "{run}");
    let run =
        action(&shop, &[("args", "--fail-on never --select unknown-code"), ("paths", "bad.nc good.nc")]);
    assert_eq!(run.code, 0, "{run}");
    assert_eq!(action(&shop, &[("paths", "missing.nc")]).code, 2);
}

#[cfg(unix)]
#[test]
fn inputs_of_the_action_do_not_run_as_commands() {
    let shop = Shop::with(&[("good.nc", GOOD)]);
    for input in ["paths", "control", "baseline", "args", "sarif"] {
        action(&shop, &[(input, "$(touch ran) `touch ran` ; touch ran")]);
        assert!(!shop.path("ran").exists(), "{input}");
    }
}

/// The step of the action that installs, with a `curl` that writes down what it is asked for.
#[cfg(unix)]
#[test]
fn the_action_installs_the_release_that_it_belongs_to() {
    let action = yaml("action.yml");
    let steps = action["runs"]["steps"].as_array().unwrap();
    let step = steps.iter().find(|step| step["name"] == "Install gcheck").unwrap();
    let shop = Shop::new();
    let curl = "#!/bin/sh\n\
                while [ $# -gt 1 ]; do if [ \"$1\" = --output ]; then out=$2; fi; shift; done\n\
                echo \"$1\" > asked\n\
                echo 'echo into $GCHECK_INSTALL_DIR' > \"$out\"\n";
    shop.file("bin/curl", curl);
    shop.chmod("bin/curl", 0o755);
    fs::create_dir(shop.path("temp")).unwrap();
    let mut command = Command::new("bash");
    command.args(["--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"].as_str().unwrap()]);
    command.current_dir(shop.path("")).env_clear();
    let bin = shop.path("bin").to_string_lossy().into_owned();
    command.env("PATH", format!("{bin}:/usr/bin:/bin")).env("RUNNER_TEMP", shop.path("temp"));
    command.env("GITHUB_ACTION_PATH", root()).env("GITHUB_PATH", shop.path("path"));
    let run = shop.finish(&mut command, b"");
    assert_eq!((run.code, run.stdout.as_str()), (0, "into [SHOP]/temp/gcheck-bin\n"), "{run}");
    assert!(shop.read("path").ends_with("/temp/gcheck-bin\n"));
    let workspace: toml::Table = toml::from_str(&text("Cargo.toml")).unwrap();
    let package = &workspace["workspace"]["package"];
    let (repository, version) =
        (package["repository"].as_str().unwrap(), package["version"].as_str().unwrap());
    assert_eq!(shop.read("asked"), format!("{repository}/releases/download/v{version}/install.sh\n"));
}

#[test]
fn the_hook_takes_the_files_that_a_folder_gives() {
    let hooks = yaml(".pre-commit-hooks.yaml");
    assert_eq!(hooks[0]["entry"], "gcheck check");
    assert_eq!(hooks[0]["language"], "python", "pre-commit installs a wheel");
    let pattern = hooks[0]["files"].as_str().unwrap();
    // Extensions stand between `(` and `)` in the pattern, in the order of the documentation.
    let guide = text("docs/guide.md");
    let listed = guide.split('`').find(|code| code.starts_with(".nc ")).unwrap();
    let extensions: Vec<&str> =
        listed.split(' ').map(|extension| extension.trim_start_matches('.')).collect();
    assert!(pattern.contains(&format!("({})", extensions.join("|"))), "{pattern}");
}

/// Steps with their scripts, of all jobs of a workflow.
fn scripts(workflow: &Value) -> Vec<(String, String)> {
    let jobs = workflow["jobs"].as_object().unwrap();
    let steps = jobs.values().flat_map(|job| job["steps"].as_array().unwrap().clone());
    steps
        .filter_map(|step| {
            let script = step["run"].as_str()?.to_owned();
            Some((step["name"].as_str().unwrap_or("unnamed").to_owned(), script))
        })
        .collect()
}

#[cfg(unix)]
#[test]
fn scripts_of_workflows_are_shell_without_foreign_text_in_them() {
    for path in [".github/workflows/ci.yml", ".github/workflows/release.yml"] {
        let workflow = yaml(path);
        // `on` is a word of YAML 1.1, and a key here.
        for key in ["name", "on", "jobs", "permissions"] {
            assert!(workflow.get(key).is_some(), "{path} has no `{key}`");
        }
        let scripts = scripts(&workflow);
        assert!(!scripts.is_empty());
        for (name, script) in scripts {
            assert!(
                !script.contains("${{"),
                "{path}, {name}: what GitHub puts into a script may run as a command"
            );
            let parsed = Command::new("bash").args(["-n", "-c", &script]).output().unwrap();
            assert!(parsed.status.success(), "{path}, {name}: {}", String::from_utf8_lossy(&parsed.stderr));
        }
    }
}

/// Options and formats in the recipes of docs/ci.md are those of the program.
#[test]
fn recipes_name_options_that_exist() {
    let help = Shop::new().gcheck("check --help").stdout;
    for path in ["docs/ci.md", "docs/guide.md", "action.yml"] {
        let page = text(path);
        for line in page.lines().filter(|line| line.contains("gcheck check")) {
            let command = line.split("gcheck check").nth(1).unwrap().split(['`', '#']).next().unwrap();
            for option in command.split_whitespace().filter(|word| word.starts_with("--")) {
                let name = option.split('=').next().unwrap().trim_end_matches(|c: char| !c.is_alphanumeric());
                assert!(help.contains(name), "{path}: `{name}` is no option of `gcheck check`");
            }
        }
        for block in page.split("```yaml").skip(1) {
            let block = block.split("```").next().unwrap();
            let parsed: Result<Value, _> = serde_saphyr::from_str(block);
            assert!(parsed.is_ok(), "{path}: {parsed:?}");
        }
    }
}

/// What a registry asks of a crate before it takes it.
#[test]
fn crates_say_what_a_registry_asks_for() {
    let workspace: toml::Table = toml::from_str(&text("Cargo.toml")).unwrap();
    let shared = workspace["workspace"]["package"].as_table().unwrap();
    for key in ["license", "repository", "rust-version", "readme"] {
        assert!(shared[key].as_str().is_some_and(|value| !value.is_empty()), "{key}");
    }
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        let name = folder.file_name().unwrap().to_string_lossy().into_owned();
        // Never published.
        if ["gcheck-fuzz", "gcheck-packages", "gcheck-testkit", "xtask"].contains(&name.as_str()) {
            continue;
        }
        let manifest: toml::Table = toml::from_str(&text(&format!("crates/{name}/Cargo.toml"))).unwrap();
        let package = manifest["package"].as_table().unwrap();
        let length = |key: &str| package.get(key).and_then(toml::Value::as_array).map_or(0, Vec::len);
        assert!(package["description"].as_str().is_some_and(|text| text.len() > 20), "{name}");
        assert!((1..=5).contains(&length("keywords")), "{name} has one to five keywords");
        assert!((1..=5).contains(&length("categories")), "{name} has one to five categories");
        for key in ["license", "repository", "rust-version", "readme", "publish"] {
            assert_eq!(package[key]["workspace"].as_bool(), Some(true), "{name}: {key}");
        }
    }
}

#[test]
fn the_book_builds_without_a_warning() {
    let installed = root().join(".test-tools/python/bin/mdbook");
    let mdbook = if installed.exists() { installed } else { PathBuf::from("mdbook") };
    let shop = Shop::new();
    let mut command = Command::new(mdbook);
    command.arg("build").arg(root().join("docs")).arg("--dest-dir").arg(shop.path("book"));
    let Ok(output) = command.output() else {
        eprintln!("skipped: the_book_builds_without_a_warning (no mdbook; `cargo xtask test` installs it)");
        return;
    };
    let said =
        String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && !said.contains("WARN") && !said.contains("ERROR"), "{said}");
    assert!(shop.path("book/index.html").is_file() && shop.path("book/rules/index.html").is_file());
}
