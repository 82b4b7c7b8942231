//! `docs/dev/editor-tests.md`: what gcheck adds to editors, and the tests in real editors that use it; and the list of actions that
//! the tests in VS Code compare with what they did.
//!
//! Knows: where an extension declares what it adds, how a test says what it uses. Must not know: what any test does.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use gcheck_ide::{LENSES, Offer, PROVED, WITH_FIGURES};
use serde_json::Value;

use super::generated::Generated;
use super::markdown;

const PAGE: &str = "docs/dev/editor-tests.md";
/// What a test in VS Code must have done when it says that it uses an action.
const OFFERED: &str = "editors/vscode/src/test/offered.ts";
const VSCODE: &str = "editors/vscode";
const NEOVIM: &str = "editors/neovim";
const EMACS: &str = "editors/emacs";

/// Something that gcheck adds to an editor.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Contributed {
    /// `command`, `setting`, `action` …
    kind: &'static str,
    /// Its name, as tests give it.
    name: String,
    /// What people read of it.
    what: String,
}

impl Contributed {
    fn new(kind: &'static str, name: impl Into<String>, what: impl Into<String>) -> Self {
        Self { kind, name: name.into(), what: what.into() }
    }
}

/// The tests of an editor by what they use, in the order in which they run.
type Uses = BTreeMap<String, Vec<String>>;

/// An editor: its name, what gcheck adds to it, the tests by what they use.
struct Editor {
    name: &'static str,
    contributed: Vec<Contributed>,
    uses: Uses,
}

/// The page and the list; an error where something has no test.
pub(super) fn generate(root: &Path) -> anyhow::Result<Generated> {
    let editors = editors(root)?;
    let wrong = wrong(&editors);
    if !wrong.is_empty() {
        bail!("{PAGE} cannot be written:\n{}", wrong.join("\n"));
    }
    Ok(vec![(PathBuf::from(PAGE), page(&editors)), (PathBuf::from(OFFERED), offered())])
}

fn editors(root: &Path) -> anyhow::Result<Vec<Editor>> {
    let read = |path: String| fs::read_to_string(root.join(&path)).context(path);
    let manifest: Value = serde_json::from_str(&read(format!("{VSCODE}/package.json"))?)?;
    let mut of_vscode = of_manifest(&manifest);
    of_vscode.extend(actions());
    let mut uses = Uses::new();
    for suite in ["basics", "commands", "looks", "typing"] {
        let text = read(format!("{VSCODE}/src/test/{suite}.ts"))?;
        for (test, used) in marked_tests(&text) {
            for name in used {
                uses.entry(name).or_default().push(test.clone());
            }
        }
    }
    let plugin =
        read(format!("{NEOVIM}/plugin/gcheck.lua"))? + &read(format!("{NEOVIM}/lua/gcheck/init.lua"))?;
    let of_neovim = of_neovim(&plugin);
    let neovim_uses = naming(&of_neovim, &read(format!("{NEOVIM}/test/run.lua"))?, "test(\"", "end)");
    let of_emacs = of_emacs(&read(format!("{EMACS}/gcheck.el"))?);
    let emacs_uses = naming(&of_emacs, &read(format!("{EMACS}/test.el"))?, "(check \"", "");
    Ok(vec![
        Editor { name: "VS Code", contributed: of_vscode, uses },
        Editor { name: "Neovim", contributed: of_neovim, uses: neovim_uses },
        Editor { name: "Emacs", contributed: of_emacs, uses: emacs_uses },
    ])
}

/// What the manifest of the extension contributes.
fn of_manifest(manifest: &Value) -> Vec<Contributed> {
    let text =
        |value: &Value, key: &str| value.get(key).and_then(Value::as_str).unwrap_or_default().to_owned();
    let list = |key: &str| manifest.pointer(&format!("/contributes/{key}")).and_then(Value::as_array);
    let table = |key: &str| manifest.pointer(&format!("/contributes/{key}")).and_then(Value::as_object);
    let mut all = Vec::new();
    for command in list("commands").into_iter().flatten() {
        let title = format!("gcheck: {}", text(command, "title"));
        all.push(Contributed::new("command", text(command, "command"), title));
    }
    for (name, setting) in table("configuration/properties").into_iter().flatten() {
        let what = ["description", "markdownDescription"].map(|key| text(setting, key)).concat();
        all.push(Contributed::new("setting", name, what));
    }
    let views = table("views").into_iter().flatten().filter_map(|(_, views)| views.as_array());
    for view in views.flatten() {
        all.push(Contributed::new("view", text(view, "id"), text(view, "name")));
    }
    for key in list("keybindings").into_iter().flatten() {
        all.push(Contributed::new("key", format!("key {}", text(key, "key")), text(key, "command")));
    }
    for (kind, place, name, what) in [
        ("problem matcher", "problemMatchers", "name", "label"),
        ("walkthrough", "walkthroughs", "id", "title"),
    ] {
        for one in list(place).into_iter().flatten() {
            all.push(Contributed::new(kind, format!("{kind} {}", text(one, name)), text(one, what)));
        }
    }
    all
}

/// What the server adds to every editor, tested in VS Code: actions and lenses.
fn actions() -> Vec<Contributed> {
    let plain = Offer::ALL.iter().map(|offer| match offer {
        Offer::Fix => (offer.name(), "the fix of a finding".to_owned()),
        offer => (offer.name(), offer.title().to_owned()),
    });
    let proved = PROVED.into_iter().map(|(name, title)| (name, format!("{title}, with proof")));
    let asking = WITH_FIGURES.into_iter().map(|(name, title)| (name, format!("{title} …, with proof")));
    let actions = plain.chain(proved).chain(asking);
    let actions = actions.map(|(name, title)| Contributed::new("action", format!("action {name}"), title));
    let lenses =
        LENSES.into_iter().map(|(name, what)| Contributed::new("lens", format!("lens {name}"), what));
    actions.chain(lenses).collect()
}

/// The tests of a suite with what they say they use: `uses("NAME", …)` at the end of a test.
fn marked_tests(text: &str) -> Vec<(String, Vec<String>)> {
    let mut tests: Vec<(String, Vec<String>)> = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line == "  [" || line.ends_with("Test => [") {
            let name = lines.next().unwrap_or_default().trim().trim_end_matches(',');
            tests.push((name.trim_matches(['"', '`']).to_owned(), Vec::new()));
        } else if line.starts_with("    uses(") {
            let mut call = line.to_owned();
            while !call.contains(')') {
                let Some(more) = lines.next() else { break };
                call.push_str(more);
            }
            let names = call.split('"').skip(1).step_by(2).map(str::to_owned);
            if let Some((_, uses)) = tests.last_mut() {
                uses.extend(names);
            }
        }
    }
    tests
}

/// The names after a word of a source, each up to the end of its quotes or the next blank.
fn names_after<'t>(text: &'t str, word: &str) -> Vec<&'t str> {
    let ends = |c: char| c == '"' || c == '\'' || c.is_whitespace();
    text.split(word)
        .skip(1)
        .filter_map(|rest| rest.split(ends).next())
        .filter(|name| !name.is_empty())
        .collect()
}

/// Commands and options of the plugin.
fn of_neovim(plugin: &str) -> Vec<Contributed> {
    let commands = names_after(plugin, "nvim_create_user_command(\"");
    let mut all: Vec<Contributed> = commands
        .into_iter()
        .map(|name| {
            let declared = plugin.split(&format!("(\"{name}\"")).nth(1).unwrap_or_default();
            let what = names_in_quotes(declared, "desc = \"");
            Contributed::new("command", name, what)
        })
        .collect();
    let options = plugin.split("M.options = {").nth(1).and_then(|rest| rest.split("\n}").next());
    let mut what = String::new();
    for line in options.unwrap_or_default().lines().map(str::trim) {
        if let Some(comment) = line.strip_prefix("--- ") {
            comment.clone_into(&mut what);
        } else if let Some((name, _)) = line.split_once(" = ") {
            all.push(Contributed::new("option", name, what.clone()));
        }
    }
    all
}

/// The text in quotes after a word.
fn names_in_quotes(text: &str, word: &str) -> String {
    text.split(word).nth(1).and_then(|rest| rest.split('"').next()).unwrap_or_default().to_owned()
}

/// Modes, options and commands of the package.
fn of_emacs(package: &str) -> Vec<Contributed> {
    let mut all = Vec::new();
    for (kind, word) in [
        ("mode", "(define-derived-mode "),
        ("option", "(defcustom "),
        ("command", "(defun "),
        ("face", "(defface "),
    ] {
        for name in names_after(package, word) {
            let declared = package.split(&format!("{word}{name}")).nth(1).unwrap_or_default();
            let declared = declared.split("\n(").next().unwrap_or_default();
            let is_internal = name.contains("--") || kind == "command" && !declared.contains("(interactive");
            if !is_internal {
                // The documentation is the first text that is a sentence.
                let what = declared.split('"').skip(1).step_by(2).find(|text| text.ends_with('.'));
                all.push(Contributed::new(kind, name, what.unwrap_or_default()));
            }
        }
    }
    all
}

/// The tests of a script by what their text names. A test begins with `start` and its own name in quotes, and its text goes on to
/// the first line that is `end`, as far to the right as the start.
fn naming(contributed: &[Contributed], script: &str, start: &str, end: &str) -> Uses {
    let mut uses = Uses::new();
    let mut lines = script.lines();
    while let Some(line) = lines.next() {
        let trimmed = line.trim_start();
        let name = trimmed.strip_prefix(start).and_then(|rest| rest.split('"').next());
        let Some(name) = name else { continue };
        let indent = line.strip_suffix(trimmed).unwrap_or_default();
        let is_end = |line: &&str| line.strip_prefix(indent) == Some(end);
        let body = lines.by_ref().take_while(|line| !is_end(line)).collect::<Vec<_>>().join("\n");
        for one in contributed.iter().filter(|one| is_named(&body, one)) {
            uses.entry(one.name.clone()).or_default().push(name.to_owned());
        }
    }
    uses
}

/// Does a text use it? An option of Lua is given a value; everything else is named.
fn is_named(text: &str, one: &Contributed) -> bool {
    let is_lua_option = one.kind == "option" && !one.name.contains('-');
    if is_lua_option { has_word(text, &format!("{} =", one.name)) } else { has_word(text, &one.name) }
}

/// Is a name in a text, and not as a part of a longer one?
fn has_word(text: &str, name: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    text.match_indices(name).any(|(at, _)| {
        let before = text.get(..at).and_then(|before| before.chars().next_back());
        let after = text.get(at + name.len()..).and_then(|after| after.chars().next());
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}

/// What no test uses, and what tests use that is not there.
fn wrong(editors: &[Editor]) -> Vec<String> {
    let mut wrong = Vec::new();
    for Editor { name, contributed, uses } in editors {
        let unused = contributed.iter().filter(|one| !uses.contains_key(&one.name));
        wrong.extend(unused.map(|one| format!("{name}: no test uses the {} `{}`", one.kind, one.name)));
        let unknown = uses.keys().filter(|used| !contributed.iter().any(|one| one.name == **used));
        wrong.extend(unknown.map(|used| format!("{name}: a test uses `{used}`, which is not there")));
    }
    wrong
}

fn page(editors: &[Editor]) -> String {
    let mut text = markdown::header(&format!(
        "{VSCODE}/package.json, the plugins beside it, the actions of crates/gcheck-ide and the tests in editors"
    ));
    text.push_str(
        "# What editors show, and the tests that use it\n\n\
        Each command, setting, view, key, action and lens that gcheck adds to an editor, with the tests that use it in the real \
        editor and look at what comes of it.\n\
        `cargo xtask gen` fails where a row has no test.\n\
        In VS Code a test says what it uses, and fails when it did not use it: a command that ran, a setting that changed, a key \
        that was pressed, an action whose edit was applied, a lens that was in the text.\n\
        In Neovim and Emacs a test uses what its text names.\n",
    );
    for Editor { name, contributed, uses } in editors {
        let _ = writeln!(text, "\n## {name}\n");
        let rows: Vec<Vec<String>> = contributed
            .iter()
            .map(|one| {
                let tests = uses.get(&one.name).map(|tests| tests.join("; ")).unwrap_or_default();
                let shown = one.name.strip_prefix(&format!("{} ", one.kind)).unwrap_or(&one.name);
                vec![one.kind.to_owned(), format!("`{shown}`"), one.what.clone(), tests]
            })
            .collect();
        text.push_str(&markdown::table(&["kind", "name", "does", "tests"], &rows));
    }
    text
}

fn offered() -> String {
    let mut text = "// Written by `cargo xtask gen` from the actions of crates/gcheck-ide; edit those.\n\n\
        /** The actions by name, with their titles; `…` is what depends on the place. */\n\
        export const OFFERED: Record<string, string> = {\n"
        .to_owned();
    let plain = Offer::ALL.iter().map(|offer| (offer.name(), offer.title()));
    for (name, title) in plain.chain(PROVED).chain(WITH_FIGURES) {
        let _ = writeln!(text, "  {}: {},", Value::from(name), Value::from(title));
    }
    text.push_str("};\n");
    text
}

#[cfg(test)]
mod tests {
    use super::{Contributed, Editor, Uses, editors, has_word, marked_tests, of_emacs, of_neovim, wrong};
    use crate::workspace;

    #[test]
    fn a_test_in_a_real_editor_uses_all_that_gcheck_adds_to_it() {
        let wrong = wrong(&editors(workspace::root()).unwrap());
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }

    #[test]
    fn what_no_test_uses_is_found_and_so_is_what_is_not_there() {
        let contributed =
            vec![Contributed::new("command", "a.one", ""), Contributed::new("setting", "a.two", "")];
        let uses = Uses::from([("a.two".to_owned(), vec![]), ("a.three".to_owned(), vec![])]);
        let editors = [Editor { name: "Ed", contributed, uses }];
        assert_eq!(
            wrong(&editors),
            ["Ed: no test uses the command `a.one`", "Ed: a test uses `a.three`, which is not there"]
        );
    }

    #[test]
    fn tests_say_what_they_use_on_one_line_or_several() {
        let text = "export const all: Test[] = [\n  [\n    \"one\",\n    async () => {\n      uses(\"no\");\n    },\n    uses(\"a\", \"b c\"),\n  ],\n  ...X.map(([name]): Test => [\n    `two ${name}`,\n    async () => {},\n    uses(\n      \"d\",\n    ),\n  ]),\n];\n";
        let found = marked_tests(text);
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        assert_eq!(
            found,
            [("one".to_owned(), names(&["a", "b c"])), ("two ${name}".to_owned(), names(&["d"]))]
        );
    }

    #[test]
    fn what_plugins_add_is_read_from_their_sources() {
        let plugin = "nvim_create_user_command(\"Gone\", function()\nend, { desc = \"Goes\" })\nM.options = {\n  --- The program.\n  cmd = nil,\n}\n";
        assert_eq!(
            of_neovim(plugin),
            [Contributed::new("command", "Gone", "Goes"), Contributed::new("option", "cmd", "The program.")]
        );
        let package = "(defcustom a-b nil\n  \"An option.\"\n  :type 'x)\n(defun a--in ()\n  \"No.\"\n  (interactive))\n(defun a-do ()\n  \"Does.\"\n  (interactive)\n  1)\n(define-derived-mode a-mode prog-mode \"A\"\n  \"Mode of a.\")\n";
        let found: Vec<_> = of_emacs(package).into_iter().map(|one| (one.kind, one.name, one.what)).collect();
        let row = |kind, name: &str, what: &str| (kind, name.to_owned(), what.to_owned());
        assert_eq!(
            found,
            [
                row("mode", "a-mode", "Mode of a."),
                row("option", "a-b", "An option."),
                row("command", "a-do", "Does.")
            ]
        );
        assert!(has_word("(a-do)", "a-do") && !has_word("(a-done)", "a-do"));
        let options = [Contributed::new("option", "cmd", ""), Contributed::new("command", "Gone", "")];
        let script = "if x then\n  test(\"one\", function()\n    vim.cmd(\"Gone\")\n  end)\nend\n-- Gone\ntest(\"two\", function()\n  f({ cmd = 1 })\nend)\n";
        let uses = super::naming(&options, script, "test(\"", "end)");
        assert_eq!(uses["Gone"], ["one"]);
        assert_eq!(uses["cmd"], ["two"]);
    }
}
