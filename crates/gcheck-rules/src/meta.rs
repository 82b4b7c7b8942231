//! What is known about a rule without running it: identity, defaults, documentation.
//!
//! Knows: metadata, and how to read a rule's documentation. Must not know: programs.

use crate::{Run, Severity};

/// Which facts a rule may see, and so when it runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tier {
    /// Mistakes in form.
    Token,
    /// One block at a time, resolved against the control.
    Block,
    /// The whole file: labels, calls, program structure.
    Program,
    /// Every path of the program, executed: what is active, where the tool goes.
    Path,
}

impl Tier {
    /// The name used in documentation.
    pub fn name(self) -> &'static str {
        match self {
            Self::Token => "token",
            Self::Block => "block",
            Self::Program => "program",
            Self::Path => "path",
        }
    }
}

/// A rule's identity, defaults and documentation.
#[derive(Debug)]
pub struct RuleMeta {
    /// Kebab-case; names the defect.
    pub id: &'static str,
    /// The folder it stands in: `syntax`, `words`, `modal`, ….
    pub group: &'static str,
    /// Names the defect in one line, lower case.
    pub summary: &'static str,
    /// Severity when nothing weakens it.
    pub severity: Severity,
    /// On by default.
    pub recommended: bool,
    /// Version that brought it.
    pub since: &'static str,
    /// Former ids, still accepted in configuration, suppressions and baselines.
    pub aliases: &'static [&'static str],
    /// Which facts it sees.
    pub tier: Tier,
    /// The doc comment as written: one line a `///`, each with its leading blank. See [`RuleMeta::docs`].
    pub raw_docs: &'static str,
}

/// A rule: what it is and how it runs.
#[derive(Debug)]
pub struct RuleEntry {
    /// What it is.
    pub meta: &'static RuleMeta,
    /// How it runs.
    pub run: Run,
}

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
    /// Address of the rule's page.
    pub fn page(&self) -> String {
        format!("{}/blob/main/docs/rules/{}.md", env!("CARGO_PKG_REPOSITORY"), self.id)
    }

    /// Markdown: meaning, why it matters, examples.
    pub fn docs(&self) -> String {
        let mut docs = String::with_capacity(self.raw_docs.len());
        for line in self.raw_docs.lines() {
            docs.push_str(line.strip_prefix(' ').unwrap_or(line));
            docs.push('\n');
        }
        docs
    }

    /// The examples: fences that read ```` ```nc,reported,CONTROL ```` or ```` ```nc,quiet,CONTROL ````, with `,guessed` behind
    /// the control where nobody chose it.
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
                Some(_) if line.trim() == "```" => examples.extend(open.take()),
                Some(example) => {
                    example.code.push_str(line);
                    example.code.push('\n');
                }
            }
        }
        examples
    }
}

/// Declares a rule: its documentation, its metadata and how it runs.
///
/// Expands to two statics, `META` and `RULE`.
macro_rules! declare_rule {
    (
        $(#[doc = $doc:literal])*
        rule $id:literal in $group:literal {
            summary: $summary:literal,
            severity: $severity:ident,
            tier: $tier:ident,
            $(recommended: $recommended:literal,)?
            $(aliases: $aliases:expr,)?
            since: $since:literal,
            run: $run:expr,
        }
    ) => {
        pub(crate) static META: $crate::RuleMeta = $crate::RuleMeta {
            id: $id,
            group: $group,
            summary: $summary,
            severity: $crate::Severity::$severity,
            recommended: true $(&& $recommended)?,
            since: $since,
            aliases: declare_rule!(@aliases $($aliases)?),
            tier: $crate::Tier::$tier,
            raw_docs: concat!($($doc, "\n",)*),
        };

        pub(crate) static RULE: $crate::RuleEntry = $crate::RuleEntry { meta: &META, run: $run };
    };
    (@aliases $aliases:expr) => { $aliases };
    (@aliases) => { &[] };
}
pub(crate) use declare_rule;
