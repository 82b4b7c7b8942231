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

/// Rules that a shop chooses together, beside the set `recommended`, which is on by default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RuleSet {
    /// What is worth a look in a careful shop, though good programs do it too; `recommended` is part of it.
    Strict,
    /// Every tool's part of a program can be started by itself.
    RestartSafe,
    /// A file is written in one hand: one form of numbers, blanks and line ends.
    HouseStyle,
}

impl RuleSet {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Strict, Self::RestartSafe, Self::HouseStyle];

    /// The name used in selections.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Strict => "strict",
            Self::RestartSafe => "restart-safe",
            Self::HouseStyle => "house-style",
        }
    }

    /// What it is for, in one line.
    pub const fn summary(self) -> &'static str {
        match self {
            Self::Strict => {
                "everything in `recommended`, and what is worth a look in a careful shop though good programs do it too"
            }
            Self::RestartSafe => "every tool's part of a program can be started by itself",
            Self::HouseStyle => "a file is written in one hand: one form of numbers, blanks and line ends",
        }
    }
}

/// Whether a rule mends what it finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mends {
    /// It only tells.
    Nothing,
    /// Some of it, by fixes that change no move.
    Safely,
    /// Some of it, by fixes that change moves or need the programmer's word.
    OnRequest,
}

impl Mends {
    /// As lists of rules show it: the option that applies the fix.
    pub const fn option(self) -> &'static str {
        match self {
            Self::Nothing => "",
            Self::Safely => "--fix",
            Self::OnRequest => "--unsafe-fixes",
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
    /// The sets that it is in beside `recommended`; see [`RuleMeta::sets`].
    pub other_sets: &'static [RuleSet],
    /// Whether it mends what it finds.
    pub mends: Mends,
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

    /// Is the rule in a set?
    pub fn is_in(&self, set: RuleSet) -> bool {
        self.other_sets.contains(&set) || set == RuleSet::Strict && self.recommended
    }

    /// The sets that the rule is in, as selections name them.
    pub fn sets(&self) -> Vec<&'static str> {
        let others = RuleSet::ALL.into_iter().filter(|set| self.is_in(*set)).map(RuleSet::name);
        self.recommended.then_some("recommended").into_iter().chain(others).collect()
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
    /// the control where nobody chose it. In them `␠` stands for a blank, `␉` for a tabulator, `␍` for a carriage return, and
    /// `␃` for the end of the file: signs that nobody sees.
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
            $(sets: [$($set:ident),+],)?
            $(mends: $mends:ident,)?
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
            other_sets: &[$($($crate::RuleSet::$set),+)?],
            mends: declare_rule!(@mends $($mends)?),
            since: $since,
            aliases: declare_rule!(@aliases $($aliases)?),
            tier: $crate::Tier::$tier,
            raw_docs: concat!($($doc, "\n",)*),
        };

        pub(crate) static RULE: $crate::RuleEntry = $crate::RuleEntry { meta: &META, run: $run };
    };
    (@mends $mends:ident) => { $crate::Mends::$mends };
    (@mends) => { $crate::Mends::Nothing };
    (@aliases $aliases:expr) => { $aliases };
    (@aliases) => { &[] };
}
pub(crate) use declare_rule;
