//! The examples in a rule's documentation.
//!
//! Knows: how an example is fenced, and the signs for invisible characters. Must not know: how examples are checked.

use crate::RuleMeta;

/// One fenced example of a rule's documentation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DocExample {
    /// True for `reported`, false for `quiet`.
    pub reported: bool,
    /// The control named in the fence, e.g. `haas-mill`.
    pub control: String,
    /// The control counts as guessed: the fence ends in `,guessed`.
    pub guessed: bool,
    /// The program.
    pub code: String,
    /// Line of the documentation on which the program starts, from one.
    pub line: usize,
}

impl RuleMeta {
    /// The examples: fences that read ```` ```nc,reported,CONTROL ```` or ```` ```nc,quiet,CONTROL ````, with
    /// `,guessed` after the control, which is then guessed. Invisible characters are written as signs: `␠` is a blank,
    /// `␉` a tab, `␍` a carriage return, `␃` the end of the file.
    pub fn examples(&self) -> Vec<DocExample> {
        let mut examples = Vec::new();
        let mut open: Option<DocExample> = None;
        for (number, line) in self.docs().lines().enumerate() {
            match &mut open {
                None => {
                    if let Some(info) = line.trim().strip_prefix("```nc,") {
                        let (kind, control) = info.split_once(',').unwrap_or((info, ""));
                        let (control, mark) = control.split_once(',').unwrap_or((control, ""));
                        open = Some(DocExample {
                            reported: kind == "reported",
                            control: control.to_owned(),
                            guessed: mark == "guessed",
                            code: String::new(),
                            line: number + 2,
                        });
                    }
                }
                Some(_) if line.trim() == "```" => {
                    examples.extend(open.take().map(|mut example| {
                        // `␃`: the file ends here, without a line end.
                        if let Some((code, _)) = example.code.split_once('␃') {
                            example.code = code.to_owned();
                        }
                        example
                    }));
                }
                Some(example) => {
                    example.code.push_str(&with_signs(line));
                    example.code.push('\n');
                }
            }
        }
        examples
    }
}

/// A line of an example with the characters that its signs stand for.
fn with_signs(line: &str) -> String {
    line.replace('␠', " ").replace('␉', "\t").replace('␍', "\r")
}
