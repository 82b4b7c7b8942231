//! The files of the repository that run gcheck elsewhere: the GitHub Action, workflows, the pre-commit hook, the recipes of
//! the documentation. Their scripts are run where a shell is enough; the rest is held against what exists.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use gcheck_testkit::skips::skip;
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

/// A tool that `.ci/run` demands in CI is installed before it, in a version that is named.
#[test]
fn ci_installs_the_checker_of_advisories() {
    let workflow = yaml(".github/workflows/ci.yml");
    let steps = workflow["jobs"]["test"]["steps"].as_array().unwrap();
    let at = |wanted: &dyn Fn(&Value) -> bool| steps.iter().position(wanted).unwrap();
    let installed = at(&|step| {
        let tool = step["with"]["tool"].as_str().unwrap_or_default();
        tool.strip_prefix("cargo-deny@").is_some_and(|version| {
            version.split('.').filter_map(|part| part.parse::<u32>().ok()).count() == 3
        })
    });
    assert!(installed < at(&|step| step["run"] == ".ci/run"));
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

/// The blocks of a language on a page.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let text = text(page);
    let open = format!("```{language}\n");
    text.split(&open).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// Runs a command line of a recipe in a shell, in the folder of a shop and with the program on the search path.
#[cfg(unix)]
fn shell(shop: &Shop, line: &str, input: &[u8]) -> Run {
    let mut command = Command::new("bash");
    command.args(["-c", line]).current_dir(shop.path(""));
    let bin = Path::new(env!("CARGO_BIN_EXE_gcheck")).parent().unwrap().to_string_lossy().into_owned();
    command.env("PATH", format!("{bin}:{}", std::env::var("PATH").unwrap()));
    shop.finish(&mut command, input)
}

/// The words of a finding as other programs take the line apart: file, line, column, severity, rule, message.
#[cfg(unix)]
fn taken_apart(line: &str) -> Option<[&str; 6]> {
    let mut parts = line.splitn(4, ':');
    let (file, row, column, rest) = (parts.next()?, parts.next()?, parts.next()?, parts.next()?);
    let (severity, rest) = rest.trim_start().split_once('[')?;
    let (rule, message) = rest.split_once("] ")?;
    Some([file, row, column, severity, rule, message])
}

#[cfg(unix)]
#[test]
fn recipes_for_hooks_and_linters_find_what_is_wrong() {
    let shop =
        Shop::with(&[("gcheck.toml", "control = \"haas-mill\"\n"), ("bad one.nc", BAD), ("good.nc", GOOD)]);
    let lefthook =
        blocks("docs/ci.md", "yaml").into_iter().find(|block| block.contains("{staged_files}")).unwrap();
    let lefthook: Value = serde_saphyr::from_str(&lefthook).unwrap();
    let line = lefthook["pre-commit"]["commands"]["gcheck"]["run"].as_str().unwrap();
    let run = |files: &str| shell(&shop, &line.replace("{staged_files}", files), b"");
    assert_eq!(run("'good.nc'").code, 0);
    let bad = run("'bad one.nc' good.nc");
    assert!(bad.code == 1 && bad.stdout.contains("unknown-code"), "{bad}");

    let path = "packages/mega-linter-plugin-gcheck/gcheck.megalinter-descriptor.yml";
    let linter = &yaml(path)["linters"][0];
    let words = |member: &str| -> Vec<String> {
        linter[member].as_array().unwrap().iter().map(|word| word.as_str().unwrap().to_owned()).collect()
    };
    let call = [linter["cli_executable"].as_str().unwrap().to_owned()];
    let call = call.into_iter().chain(words("cli_lint_extra_args")).collect::<Vec<_>>().join(" ");
    let run = shell(&shop, &format!("{call} 'bad one.nc' good.nc"), b"");
    assert!(run.code == 1 && run.stdout.starts_with("bad one.nc:"), "{run}");
    let sarif = words("cli_sarif_args").join(" ").replace("{{SARIF_OUTPUT_FILE}}", "out.sarif");
    let run = shell(&shop, &format!("gcheck check {sarif} 'bad one.nc'"), b"");
    assert!(run.code == 1 && shop.read("out.sarif").contains("\"2.1.0\""), "{run}");
    for argument in ["cli_version_arg_name", "cli_help_arg_name"] {
        assert_eq!(shell(&shop, &format!("gcheck {}", linter[argument].as_str().unwrap()), b"").code, 0);
    }
    for example in words("examples") {
        assert!(shell(&shop, &example.replace("part.nc", "good.nc"), b"").code == 0, "{example}");
    }
}

/// A shop whose program has a finding of every severity, and its lines as the recipe for nvim-lint gets them.
#[cfg(unix)]
fn one_of_each_severity() -> (Shop, Run) {
    let configuration = "control = \"haas-mill\"\n\
                         [rules]\n\
                         lasting-word-never-given = \"info\"\n\
                         missing-decimal-point = \"hint\"\n";
    let program = "%\nO0001 (EACH)\nG999\nG43 Z5.\nG0 X15\nG1 Y3. F200.\nM30\n%\n";
    let shop = Shop::with(&[("gcheck.toml", configuration), ("bad.nc", program)]);
    let lua =
        blocks("docs/editors.md", "lua").into_iter().find(|block| block.contains("linters.gcheck")).unwrap();
    let arguments = lua.split("args = {").nth(1).unwrap().split('}').next().unwrap().replace(['"', ','], " ");
    let run = shell(&shop, &format!("gcheck {arguments} bad.nc"), b"");
    (shop, run)
}

/// The recipe for efm-langserver, and its tool.
#[cfg(unix)]
fn efm_recipe() -> (String, Value) {
    let text =
        blocks("docs/editors.md", "yaml").into_iter().find(|block| block.contains("lint-formats")).unwrap();
    let recipe: Value = serde_saphyr::from_str(&text).unwrap();
    (text, recipe["tools"]["gcheck"].clone())
}

/// The characters that a field takes.
#[cfg(unix)]
type Accepts = Box<dyn Fn(char) -> bool>;

/// The fields of a line by a format of efm-langserver: `%f`, `%l`, `%c`, `%t`, `%m`; `%*[^…]` is a run of other characters,
/// whose list ends with the first `]`. What else is in the format is a regular expression there.
#[cfg(unix)]
fn fields(format: &str, line: &str) -> Option<BTreeMap<char, String>> {
    let Some(first) = format.chars().next() else { return line.is_empty().then(BTreeMap::new) };
    let (length, field, accepts): (usize, Option<char>, Accepts) = match format.strip_prefix('%') {
        Some(rest) if rest.starts_with("*[^") => {
            let (others, _) = rest[3..].split_once(']').unwrap();
            assert!(!others.is_empty(), "an empty list in {format}");
            let others = others.to_owned();
            (others.len() + 5, None, Box::new(move |c| !others.contains(c)))
        }
        Some(rest) => match rest.chars().next().unwrap() {
            digits @ ('l' | 'c') => (2, Some(digits), Box::new(|c: char| c.is_ascii_digit())),
            any @ ('f' | 't' | 'm') => (2, Some(any), Box::new(|_| true)),
            other => panic!("unknown field `%{other}`"),
        },
        None => {
            assert!(!"[](){}*+?.|^$\\".contains(first), "`{first}` is not itself in {format}");
            let rest = line.strip_prefix(first)?;
            return fields(&format[first.len_utf8()..], rest);
        }
    };
    let most = if field == Some('t') { 1 } else { usize::MAX };
    let ends = line.char_indices().take_while(|(_, c)| accepts(*c)).take(most);
    let ends = ends.map(|(at, c)| at + c.len_utf8());
    for end in ends.collect::<Vec<_>>() {
        if let Some(mut found) = fields(&format[length..], &line[end..]) {
            found.extend(field.map(|name| (name, line[..end].to_owned())));
            return Some(found);
        }
    }
    None
}

#[cfg(unix)]
#[test]
fn recipes_for_editors_without_the_server_print_findings_a_line() {
    let (shop, by_name) = one_of_each_severity();
    let (_, tool) = efm_recipe();
    let command = tool["lint-command"].as_str().unwrap().replace("${INPUT}", "bad.nc");
    let by_text = shell(&shop, &command, shop.read("bad.nc").as_bytes());
    assert_eq!(by_name.stdout, by_text.stdout);
    let lines: Vec<[&str; 6]> = by_name.stdout.lines().filter_map(taken_apart).collect();
    assert_eq!(lines.len(), by_name.stdout.lines().count(), "{by_name}");
    let severities: Vec<&str> = lines.iter().map(|line| line[3]).collect();
    for severity in ["error", "warning", "info", "hint"] {
        assert!(severities.contains(&severity), "no {severity}: {by_name}");
    }
    let formats = tool["lint-formats"].as_array().unwrap();
    for (line, [file, row, column, severity, _, message]) in by_name.stdout.lines().zip(lines) {
        let read = formats.iter().find_map(|format| fields(format.as_str().unwrap(), line));
        let read = read.unwrap_or_else(|| panic!("no format reads `{line}`"));
        assert_eq!(
            [&read[&'f'], &read[&'l'], &read[&'c'], &read[&'t'], &read[&'m']],
            [file, row, column, &severity[..1], message],
            "{line}"
        );
    }
}

/// Reads messages of the language server until one with this method.
#[cfg(unix)]
fn message_with(input: &mut impl std::io::BufRead, method: &str) -> Value {
    loop {
        let mut length = 0;
        loop {
            let mut header = String::new();
            assert!(input.read_line(&mut header).unwrap() > 0, "the server ended before {method}");
            match header.trim_end().split_once(": ") {
                Some(("Content-Length", number)) => length = number.parse().unwrap(),
                Some(_) => {}
                None => break,
            }
        }
        let mut body = vec![0; length];
        input.read_exact(&mut body).unwrap();
        let message: Value = serde_json::from_slice(&body).unwrap();
        if message["method"] == method {
            return message;
        }
    }
}

#[cfg(unix)]
#[test]
fn efm_publishes_every_finding_with_its_severity() {
    use std::io::Write as _;

    let (shop, run) = one_of_each_severity();
    let (recipe, tool) = efm_recipe();
    shop.file("config.yaml", recipe);
    let mut command = Command::new("efm-langserver");
    // It writes what it does on standard error.
    command.args(["-q", "-c", "config.yaml"]).current_dir(shop.path("")).stderr(std::process::Stdio::null());
    let bin = Path::new(env!("CARGO_BIN_EXE_gcheck")).parent().unwrap().to_string_lossy().into_owned();
    command.env("PATH", format!("{bin}:{}", std::env::var("PATH").unwrap()));
    command.stdin(std::process::Stdio::piped()).stdout(std::process::Stdio::piped());
    let Ok(mut server) = command.spawn() else {
        return skip(
            "efm_publishes_every_finding_with_its_severity",
            "efm-langserver",
            "`cargo xtask test` installs it",
        );
    };
    let (mut input, output) = (server.stdin.take().unwrap(), server.stdout.take().unwrap());
    let mut send = |message: Value| {
        let body = message.to_string();
        write!(input, "Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
    };
    let uri = |name: &str| format!("file://{}", shop.path(name).display());
    let root = format!("file://{}", shop.path("").display());
    let initialize =
        serde_json::json!({ "processId": null, "rootUri": root.trim_end_matches('/'), "capabilities": {} });
    send(serde_json::json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": initialize }));
    send(serde_json::json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }));
    let document = serde_json::json!({
        "uri": uri("bad.nc"), "languageId": "gcode", "version": 1, "text": shop.read("bad.nc")
    });
    let opened = serde_json::json!({ "textDocument": document });
    send(serde_json::json!({ "jsonrpc": "2.0", "method": "textDocument/didOpen", "params": opened }));
    let mut output = std::io::BufReader::new(output);
    let published = message_with(&mut output, "textDocument/publishDiagnostics");
    let diagnostics = published["params"]["diagnostics"].as_array().unwrap();
    let said: Vec<String> = diagnostics
        .iter()
        .map(|one| {
            let severity = match one["severity"].as_u64().unwrap() {
                1 => "error",
                2 => "warning",
                3 => "info",
                _ => "hint",
            };
            let start = &one["range"]["start"];
            let at = |key: &str| start[key].as_u64().unwrap() + 1;
            let source = tool["lint-source"].as_str();
            assert_eq!(one["source"].as_str(), source);
            format!("{}:{}: {severity} {}", at("line"), at("character"), one["message"].as_str().unwrap())
        })
        .collect();
    let expected: Vec<String> = run
        .stdout
        .lines()
        .map(|line| {
            let [_, row, column, severity, _, message] = taken_apart(line).unwrap();
            format!("{row}:{column}: {severity} {message}")
        })
        .collect();
    // Its input ends, so it ends.
    drop(input);
    assert_eq!(said, expected);
    server.wait().unwrap();
}

/// Settings of editors and containers are JSON, and what they start and install exists.
#[test]
fn settings_of_editors_start_the_server() {
    let mut starts = 0;
    for page in ["docs/editors.md", "docs/ci.md"] {
        for block in blocks(page, "json") {
            let value: Value =
                serde_json::from_str(&block).unwrap_or_else(|error| panic!("{page}: {error}: {block}"));
            let mut waiting = vec![&value];
            while let Some(value) = waiting.pop() {
                if let Some(command) = value.get("command") {
                    assert_eq!(*command, serde_json::json!(["gcheck", "lsp"]));
                    starts += 1;
                }
                if value.get("path").is_some() {
                    let call = (&value["path"], &value["arguments"]);
                    assert_eq!(call, (&Value::from("gcheck"), &serde_json::json!(["lsp"])));
                    starts += 1;
                }
                waiting.extend(value.as_object().into_iter().flat_map(|object| object.values()));
            }
            if let Some(install) = value.get("postCreateCommand") {
                assert_eq!(*install, "pip install gcheck");
                let extension: Value = serde_json::from_str(&text("editors/vscode/package.json")).unwrap();
                let id = format!(
                    "{}.{}",
                    extension["publisher"].as_str().unwrap(),
                    extension["name"].as_str().unwrap()
                );
                assert_eq!(value["customizations"]["vscode"]["extensions"], serde_json::json!([id]));
            }
        }
    }
    assert_eq!(starts, 3, "Zed, Kate, Sublime Text");
    let toml = blocks("docs/editors.md", "toml");
    let helix: toml::Table =
        toml.iter().find(|block| block.contains("language-server")).unwrap().parse().unwrap();
    assert_eq!(helix["language-server"]["gcheck"]["command"].as_str(), Some("gcheck"));
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
        skip("the_book_builds_without_a_warning", "mdbook", "`cargo xtask test` installs it");
        return;
    };
    let said =
        String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && !said.contains("WARN") && !said.contains("ERROR"), "{said}");
    assert!(shop.path("book/index.html").is_file() && shop.path("book/rules/index.html").is_file());
}
