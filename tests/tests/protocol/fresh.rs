//! Whatever happens to programs, files, configuration and settings: every answer is that of a fresh server.
//!
//! Knows: what an editor and other programs do to a folder. Must not know: what any answer says.
//!
//! The usual run is short; `GCHECK_SOAK=20000` makes about that many steps, as `cargo xtask test --soak` does.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{env, fs, thread};

use gcheck_testkit::language_client::LanguageClient;
use gcheck_testkit::language_questions::{self, Question};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::session::{pulling, server, uri_of};
use crate::synchronizing::{Dice, Mirror};

/// Steps before the answers are compared.
const STEPS: usize = 30;
/// Comparisons of the usual run.
const SHORT: usize = 20;
/// Places of a document that are asked about.
const PLACES: usize = 4;
/// Answers that are to come are asked for so often, with a pause between.
const MOST_QUESTIONS: usize = 2_000;
const PAUSE: Duration = Duration::from_millis(5);
/// A shell of a text with more bytes is taken for another one: runs of it would be most of the test.
const MOST_BYTES: usize = 3_000;

const NAMES: [&str; 5] = ["a.nc", "b.nc", "O9010.nc", "O9020.nc", "below/c.nc"];

const PROGRAMS: [&str; 7] = [
    "%\nO1 (PART)\nG21 G90 G17 G40 G49 G80\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 Z5. H1\nG1 Z-1. F100.\nM98 P9010\nG65 P9020 A1.5 \
     B2.\nG0 Z50.\nM30\n%\n",
    "O9010\n#100=#100+1.\nIF[#100GT5.]GOTO20\nG91 G1 X1. F200.\nN20 G90\nM99\n",
    "O9020 (µm 日本 😀)\nG1 X#1 Y#2 F150.\nM98 P9010\nM99\n",
    "O2\nG20\nG81 X1. Y1. Z-0.5 R0.1 F5.\nX2.\nG80\nM98 P9020\nM30\n",
    "",
    "O3\nG2 X10. Y0. I5. J0.\nG41 D1\nG1 X20.\nM30\nO9010\nG4 P100\nM99\n",
    "(gcheck: control = linuxcnc)\no<sub> sub\nG1 X[#1 * 2] F100\no<sub> endsub\no<sub> call [3]\nM2\n",
];

const PIECES: [&str; 18] = [
    "",
    "",
    "",
    "G1 ",
    "X1.5",
    "Y-2. ",
    "\n",
    "\n\n",
    "N10 ",
    "(µm)",
    "日本",
    "😀",
    "G91\n",
    "M98 P9010\n",
    "G65 P9020 A1. B3.\n",
    ".",
    "M30\n",
    "#100=2.\n",
];

const CONFIGURATIONS: [Option<&str>; 6] = [
    None,
    Some("control = \"haas-mill\"\n"),
    Some("control = \"linuxcnc\"\n[tools]\n1 = { length = 50.0 }\n"),
    Some("control = \"fanuc-mill\"\n[rules]\nselect = [\"all\"]\n[format]\nspaces = false\n"),
    Some("control = \"no-such\"\n"),
    Some("control = \"fanuc-mill\"\nsearch = [\"below\"]\n"),
];

fn settings(dice: &mut Dice) -> Value {
    match dice.below(5) {
        0 => json!({ "control": "linuxcnc" }),
        1 => json!({ "foldRepeats": false }),
        2 => json!({ "inlayHints": false, "codeLens": { "enable": false } }),
        3 => json!({ "run": "onSave" }),
        _ => Value::Null,
    }
}

/// An editor with its server over a folder.
struct Editor {
    client: LanguageClient,
    folder: PathBuf,
}

impl Editor {
    fn new(folder: &Path, settings: &Value) -> Self {
        let mut client = server(folder);
        client.settings = settings.clone();
        let root = uri_of(folder);
        let mut abilities = pulling();
        abilities["textDocument"]["codeAction"]["dataSupport"] = true.into();
        abilities["textDocument"]["codeAction"]["resolveSupport"] = json!({ "properties": ["edit"] });
        client.initialize(json!({
            "processId": std::process::id(),
            "rootUri": root,
            "workspaceFolders": [{ "uri": root, "name": "work" }],
            "capabilities": abilities,
        }));
        let mut editor = Self { client, folder: folder.to_owned() };
        editor.settle();
        editor
    }

    fn uri(&self, name: &str) -> String {
        uri_of(&self.folder.join(name))
    }

    /// Waits until the server has asked for settings, and has them.
    fn settle(&mut self) {
        for _ in 0..2 {
            self.client.request("gcheck/explain", json!({ "subject": "G0" }));
            thread::sleep(PAUSE);
        }
    }

    fn open(&mut self, name: &str, version: i32, text: &str) {
        let document =
            json!({ "uri": self.uri(name), "languageId": "gcode", "version": version, "text": text });
        self.client.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// Writes a file or deletes it, as another program does, and tells of it.
    fn put(&mut self, name: &str, text: Option<&str>) {
        let path = self.folder.join(name);
        match text {
            Some(text) => fs::write(&path, text).unwrap(),
            None if path.exists() => fs::remove_file(&path).unwrap(),
            None => {}
        }
        let change = json!({ "uri": self.uri(name), "type": if text.is_some() { 2 } else { 3 } });
        self.client.notify("workspace/didChangeWatchedFiles", json!({ "changes": [change] }));
    }

    fn ask(&mut self, questions: &[Question]) -> Vec<Value> {
        let ids: Vec<i64> = questions
            .iter()
            .map(|(method, params)| self.client.send_request(method, params.clone()))
            .collect();
        ids.into_iter().map(|id| self.client.answer(id)).collect()
    }

    /// The answers to questions; what is to come is asked for again, until it is as expected where that is known.
    fn answers(&mut self, questions: &[Question], expected: Option<&[Value]>) -> Vec<Value> {
        let mut answers = self.ask(questions);
        for _ in 0..MOST_QUESTIONS {
            let open: Vec<usize> = (0..questions.len())
                .filter(|&at| {
                    let (method, answer) = (questions[at].0, &answers[at]);
                    let is_expected = expected
                        .map_or(method == "textDocument/codeLens" && answer.get("error").is_none(), |all| {
                            comparable(answer) == comparable(&all[at])
                        });
                    !is_expected && language_questions::is_to_come(method, answer)
                })
                .collect();
            if open.is_empty() {
                break;
            }
            thread::sleep(PAUSE);
            let again: Vec<Question> = open.iter().map(|&at| questions[at].clone()).collect();
            for (at, answer) in open.into_iter().zip(self.ask(&again)) {
                answers[at] = answer;
            }
        }
        answers
    }
}

fn comparable(answer: &Value) -> Value {
    language_questions::comparable(answer.clone())
}

/// What an editor holds, and has told the server.
struct World {
    dice: Dice,
    editor: Editor,
    /// Open documents with their versions.
    open: BTreeMap<&'static str, (Mirror, i32)>,
    settings: Value,
    /// What was done, for a person who looks at a failure.
    story: Vec<String>,
}

impl World {
    fn step(&mut self) {
        let name = NAMES[self.dice.below(NAMES.len())];
        match self.dice.below(14) {
            0..=5 => self.edit(name),
            6 => self.open_or_close(name),
            7 => {
                let Some((mirror, _)) = self.open.get(name) else { return };
                let text = mirror.text.clone();
                self.note(format!("save {name}"));
                self.editor.put(name, Some(&text));
                let saved = json!({ "textDocument": { "uri": self.editor.uri(name) } });
                self.editor.client.notify("textDocument/didSave", saved);
            }
            8 => {
                let text = (self.dice.below(3) > 0).then(|| self.dice.pick(&PROGRAMS));
                self.note(format!("{name} on disk becomes {text:?}"));
                self.editor.put(name, text);
            }
            9 => {
                let text = CONFIGURATIONS[self.dice.below(CONFIGURATIONS.len())];
                self.note(format!("gcheck.toml becomes {text:?}"));
                self.editor.put("gcheck.toml", text);
            }
            10 if self.dice.below(2) == 0 => {
                self.settings = settings(&mut self.dice);
                self.note(format!("settings become {}", self.settings));
                self.editor.client.settings = self.settings.clone();
                self.editor.client.notify("workspace/didChangeConfiguration", json!({ "settings": {} }));
                self.editor.settle();
            }
            _ => self.ask_something(name),
        }
    }

    fn note(&mut self, what: String) {
        self.story.push(what);
    }

    fn edit(&mut self, name: &'static str) {
        let Some((mirror, version)) = self.open.get_mut(name) else { return self.open_or_close(name) };
        *version += 1;
        let change = if mirror.text.len() > MOST_BYTES {
            *mirror = Mirror::new(PROGRAMS[0], false);
            json!({ "text": PROGRAMS[0] })
        } else {
            mirror.random_edit(&mut self.dice, &PIECES)
        };
        let document = json!({ "uri": self.editor.uri(name), "version": *version });
        self.note(format!("{name}: {change}"));
        let params = json!({ "textDocument": document, "contentChanges": [change] });
        self.editor.client.notify("textDocument/didChange", params);
    }

    fn open_or_close(&mut self, name: &'static str) {
        if self.open.remove(name).is_some() {
            self.note(format!("close {name}"));
            let closed = json!({ "textDocument": { "uri": self.editor.uri(name) } });
            self.editor.client.notify("textDocument/didClose", closed);
            return;
        }
        let text = self.dice.pick(&PROGRAMS);
        self.note(format!("open {name} as {text:?}"));
        self.editor.open(name, 1, text);
        self.open.insert(name, (Mirror::new(text, false), 1));
    }

    /// A question whose answer nobody waits for, which is cancelled now and then.
    fn ask_something(&mut self, name: &'static str) {
        let Some((mirror, _)) = self.open.get(name) else { return };
        let questions = questions_about(&self.editor, name, mirror);
        let (method, params) = &questions[self.dice.below(questions.len())];
        self.story.push(format!("ask {method} of {name}"));
        let id = self.editor.client.send_request(method, params.clone());
        if self.dice.below(3) == 0 {
            self.editor.client.notify("$/cancelRequest", json!({ "id": id }));
        }
    }

    /// Compares every answer with that of a fresh server over the same folder.
    fn compare(&mut self) {
        let mut questions = Vec::new();
        for (name, (mirror, _)) in &self.open {
            if questions.is_empty() {
                questions.extend(language_questions::of_workspace(&self.editor.uri(name)));
            }
            questions.extend(questions_about(&self.editor, name, mirror));
        }
        let mut fresh = Editor::new(&self.editor.folder, &self.settings);
        for (name, (mirror, version)) in &self.open {
            fresh.open(name, *version, &mirror.text);
        }
        let (of_editor, of_fresh) = self.compare_answers(&mut fresh, &questions, &questions);
        let about = |answers: &[Value]| -> Vec<Question> {
            let all = questions.iter().zip(answers);
            all.flat_map(|((method, _), answer)| language_questions::about_the_first(method, answer))
                .collect()
        };
        self.compare_answers(&mut fresh, &about(&of_editor), &about(&of_fresh));
        assert_eq!(fresh.client.end(), Some(0));
    }

    fn compare_answers(
        &mut self,
        fresh: &mut Editor,
        of_editor: &[Question],
        of_fresh: &[Question],
    ) -> (Vec<Value>, Vec<Value>) {
        assert_eq!(of_editor.len(), of_fresh.len(), "{}", self.story.join("\n"));
        let expected = fresh.answers(of_fresh, None);
        let answers = self.editor.answers(of_editor, Some(&expected));
        for ((method, params), (answer, expected)) in of_editor.iter().zip(answers.iter().zip(&expected)) {
            let (answer, expected) = (comparable(answer).to_string(), comparable(expected).to_string());
            let same = answer.bytes().zip(expected.bytes()).take_while(|(a, b)| a == b).count();
            let around = |text: &str| {
                let from = text.floor_char_boundary(same.saturating_sub(200));
                text[from..text.floor_char_boundary(same + 400)].to_owned()
            };
            assert!(
                answer == expected,
                "{method} of {params}\nanswers … {} …\na fresh server … {} …\n{}",
                around(&answer),
                around(&expected),
                self.story.join("\n")
            );
        }
        (answers, expected)
    }
}

fn questions_about(editor: &Editor, name: &str, mirror: &Mirror) -> Vec<Question> {
    let uri = editor.uri(name);
    let place = |mut at: usize| {
        while !mirror.text.is_char_boundary(at) {
            at -= 1;
        }
        let [line, character] = mirror.position(at);
        json!({ "line": line, "character": character })
    };
    let len = mirror.text.len();
    let mut questions = language_questions::of_document(&uri, &place(len));
    for part in 0..PLACES {
        questions.extend(language_questions::at_place(&uri, &place(len * part / PLACES)));
    }
    questions
}

#[test]
fn whatever_happens_every_answer_is_that_of_a_fresh_server() {
    let steps = env::var("GCHECK_SOAK").ok().and_then(|n| n.parse().ok()).unwrap_or(SHORT * STEPS);
    let seed = env::var("GCHECK_SOAK_SEED").ok().and_then(|n| n.parse().ok()).unwrap_or(1);
    let folder = TempDir::new().unwrap();
    fs::create_dir(folder.path().join("below")).unwrap();
    fs::write(folder.path().join("O9010.nc"), PROGRAMS[1]).unwrap();
    let editor = Editor::new(folder.path(), &Value::Null);
    let mut world =
        World { dice: Dice(seed), editor, open: BTreeMap::new(), settings: Value::Null, story: Vec::new() };
    world.open_or_close("a.nc");
    for step in 1..=steps {
        world.step();
        if step % STEPS == 0 {
            world.compare();
        }
    }
    assert_eq!(world.editor.client.end(), Some(0));
}
