//! What a check found in every file: the input of all formats.
//!
//! Knows: files in order, findings in order, sums. Must not know: how anything looks.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::Arc;

use gcheck_diagnostics::{Finding, RuleMeta, Severity, StatedAssumption};
use gcheck_syntax::SourceText;
use serde::Serialize;

use crate::source::Source;
use crate::{ControlChoice, ControlSource, Fingerprint, Fingerprinter, PathBase};

/// What a check found in one file.
#[derive(Debug, Clone)]
pub struct FileReport {
    /// As shown: relative where possible, forward slashes.
    pub path: String,
    /// The program. A file without findings may pass an empty text, to let go of a large one early.
    pub text: Arc<SourceText>,
    /// The control it was checked for.
    pub control: ControlChoice,
    /// Its findings, with severities as configured and without those suppressed or in the baseline.
    pub findings: Vec<Finding>,
    /// Findings beyond those kept, by rule and severity: counted, not shown.
    pub omitted: Vec<(&'static RuleMeta, Severity, usize)>,
    /// Lines read.
    pub lines: usize,
    /// Findings that a comment of the program suppressed.
    pub suppressed: usize,
    /// Findings that the baseline knows.
    pub baseline: usize,
    /// Findings that were fixed.
    pub fixed: usize,
    /// The analysis ended before the program did.
    pub out_of_fuel: bool,
    /// Rules that failed by a mistake of ours, by id: whatever they would have found is missing.
    pub failed_rules: Vec<&'static str>,
    /// The assumptions of the verdict.
    pub assumptions: Vec<StatedAssumption>,
}

impl FileReport {
    /// The report of a file that holds these findings and nothing else to tell.
    pub fn new(path: String, text: SourceText, control: ControlChoice, findings: Vec<Finding>) -> Self {
        Self {
            path,
            lines: text.text().lines().count(),
            text: Arc::new(text),
            control,
            findings,
            omitted: Vec::new(),
            suppressed: 0,
            baseline: 0,
            fixed: 0,
            out_of_fuel: false,
            failed_rules: Vec::new(),
            assumptions: Vec::new(),
        }
    }
}

/// A file that labels point to and that was not itself checked, e.g. a subprogram from a library.
#[derive(Debug, Clone)]
pub struct RelatedFile {
    /// As in [`gcheck_diagnostics::Label::file`].
    pub path: String,
    /// The program.
    pub text: Arc<SourceText>,
}

/// What a check found in all files.
///
/// Files are in the order of their paths and findings in the order of their places, whatever order they came in: the
/// output is the same for every number of threads.
#[derive(Debug)]
pub struct Report {
    files: Vec<File>,
    skipped: Vec<Skipped>,
    related: Vec<(String, Source)>,
    rules: Vec<&'static RuleMeta>,
    folds: bool,
    base: Option<PathBase>,
    fails_from: Option<Severity>,
    fails_when_incomplete: bool,
    passed: &'static str,
}

/// The rule that reports that a budget was used up.
const INCOMPLETE: &str = "analysis-incomplete";

/// The rule that reports a file as one that is for no control of ours.
const UNSUPPORTED: &str = "unsupported-dialect";

/// How many files show the same finding; those after them are folded.
const SHOWN: usize = 5;

/// A file among others that have the same only finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum InFold {
    /// It is told as every file is.
    Not,
    /// It stands for this many files, itself among them.
    First(usize),
    /// Another one stands for it.
    Hidden,
}

/// Folds the files of which all that is found is that they are for one and the same control, which gcheck does not read.
fn fold_files(files: &mut [File]) {
    let mut alike: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (index, file) in files.iter().enumerate() {
        if let [finding] = file.findings.as_slice()
            && finding.rule.id == UNSUPPORTED
        {
            alike.entry(finding.message.clone()).or_default().push(index);
        }
    }
    for indexes in alike.into_values() {
        let folded = indexes.get(SHOWN..).unwrap_or_default();
        // One line in place of one line folds nothing.
        if folded.len() < 2 {
            continue;
        }
        for (at, index) in folded.iter().enumerate() {
            if let Some(file) = files.get_mut(*index) {
                file.in_fold = if at == 0 { InFold::First(folded.len()) } else { InFold::Hidden };
            }
        }
    }
}

/// A file that was to be checked and could not be.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, schemars::JsonSchema)]
pub struct Skipped {
    /// As shown; empty when the problem is not one of a single file.
    pub file: String,
    /// Why, in one sentence without an end.
    pub reason: String,
}

/// The order of findings in a file.
pub(crate) fn order(a: &Finding, b: &Finding) -> Ordering {
    let key = |f: &Finding| (f.range.start, f.range.end, f.rule.id);
    key(a).cmp(&key(b)).then_with(|| a.message.cmp(&b.message))
}

/// Does a fix that changes no move settle the finding?
pub(crate) fn is_fixable(finding: &Finding) -> bool {
    finding.fixes.iter().any(|fix| fix.safe)
}

/// A file of the report with its lines.
#[derive(Debug)]
pub(crate) struct File {
    pub(crate) path: String,
    /// From the root of the repository, where that is another path.
    rooted: Option<String>,
    /// What becomes of the file's only finding, which is that of other files too.
    pub(crate) in_fold: InFold,
    pub(crate) source: Source,
    pub(crate) control: ControlChoice,
    pub(crate) findings: Vec<Finding>,
    pub(crate) omitted: Vec<(&'static RuleMeta, Severity, usize)>,
    lines: usize,
    suppressed: usize,
    baseline: usize,
    fixed: usize,
    pub(crate) out_of_fuel: bool,
    pub(crate) failed_rules: Vec<&'static str>,
    assumptions: Vec<StatedAssumption>,
}

/// Sums over all files.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, schemars::JsonSchema)]
pub struct Summary {
    /// Files checked.
    pub files: usize,
    /// Lines read.
    pub lines: usize,
    /// Findings of severity error.
    pub errors: usize,
    /// Findings of severity warning.
    pub warnings: usize,
    /// Findings of severity info.
    pub infos: usize,
    /// Findings of severity hint.
    pub hints: usize,
    /// Of all these, findings that are counted and not shown: a file keeps a bounded number.
    pub omitted: usize,
    /// Findings suppressed by comments.
    pub suppressed: usize,
    /// Findings that the baseline knows.
    pub baseline: usize,
    /// Findings that were fixed.
    pub fixed: usize,
    /// Paths of the files whose analysis ended early.
    pub out_of_fuel: Vec<String>,
    /// Rules that failed by a mistake of ours, with the file of each: their findings there are missing.
    pub failed_rules: Vec<FailedRule>,
    /// Files that could not be checked.
    pub skipped: Vec<Skipped>,
    /// The assumptions of the verdicts, each once, with the number of files that depend on it.
    pub assumptions: Vec<Assumed>,
}

/// A rule that failed in a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, schemars::JsonSchema)]
pub struct FailedRule {
    /// The file, as shown.
    pub file: String,
    /// The rule's id.
    pub rule: &'static str,
}

/// Something assumed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, schemars::JsonSchema)]
pub struct Assumed {
    /// One sentence without an end.
    pub text: String,
    /// The line of `gcheck.toml` that would settle it.
    pub pin: Option<String>,
    /// Files whose verdict rests on it.
    pub files: usize,
}

impl Report {
    /// A report about files, in any order.
    pub fn new(files: Vec<FileReport>) -> Self {
        let mut files: Vec<File> = files.into_iter().map(File::new).collect();
        files.sort_by(|a, b| a.path.cmp(&b.path));
        Self {
            files,
            skipped: Vec::new(),
            related: Vec::new(),
            rules: Vec::new(),
            folds: false,
            base: None,
            fails_from: Some(Severity::Error),
            fails_when_incomplete: false,
            passed: "no findings",
        }
    }

    /// With the roots from which the formats of servers name files.
    #[must_use]
    pub fn with_path_base(mut self, base: PathBase) -> Self {
        for file in &mut self.files {
            file.rooted = Some(base.rooted(&file.path).into_owned());
        }
        self.base = Some(base);
        self
    }

    /// The paths of its files, as they were named.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|file| file.path.as_str())
    }

    /// The paths of the files that could not be checked.
    pub fn skipped_paths(&self) -> impl Iterator<Item = &str> {
        self.skipped.iter().map(|skipped| skipped.file.as_str())
    }

    /// With what makes the run fail: findings from a severity on (`None`: no finding does), and an analysis that ended early.
    #[must_use]
    pub fn failing(mut self, from: Option<Severity>, when_incomplete: bool) -> Self {
        (self.fails_from, self.fails_when_incomplete) = (from, when_incomplete);
        self
    }

    /// With the name of the test of a file without findings.
    #[must_use]
    pub fn with_passed(mut self, name: &'static str) -> Self {
        self.passed = name;
        self
    }

    /// With texts of files that labels point to; without its text a file is named, but no line of it is shown.
    #[must_use]
    pub fn with_related(mut self, files: Vec<RelatedFile>) -> Self {
        self.related = files.into_iter().map(|file| (file.path, Source::new(file.text))).collect();
        self
    }

    /// With the files that could not be checked.
    #[must_use]
    pub fn with_skipped(mut self, mut skipped: Vec<Skipped>) -> Self {
        skipped.sort();
        skipped.dedup();
        self.skipped = skipped;
        self
    }

    /// Is there more to find: a file was skipped, a rule failed, or a budget was used up before the end of an analysis?
    pub fn is_incomplete(&self) -> bool {
        let gave_up = |file: &File| {
            let mut rules = file.findings.iter().map(|finding| finding.rule);
            let mut omitted = file.omitted.iter().map(|(rule, ..)| *rule);
            file.out_of_fuel
                || !file.failed_rules.is_empty()
                || rules.any(|rule| rule.id == INCOMPLETE)
                || omitted.any(|rule| rule.id == INCOMPLETE)
        };
        !self.skipped.is_empty() || self.files.iter().any(gave_up)
    }

    /// With the rules that ran, for the formats that list them; rules of findings are listed anyway.
    #[must_use]
    pub fn with_rules(mut self, rules: impl IntoIterator<Item = &'static RuleMeta>) -> Self {
        self.rules = rules.into_iter().collect();
        self
    }

    /// With repeats of one rule in one file folded, in the formats that people read: a few, and the number of the others. Files
    /// that are all for the same control, which gcheck does not read, are folded in the same way.
    #[must_use]
    pub fn folded(mut self) -> Self {
        self.folds = true;
        fold_files(&mut self.files);
        self
    }

    /// Findings that have a fix which changes no move.
    pub fn fixable(&self) -> usize {
        self.findings().filter(|(_, finding)| is_fixable(finding)).count()
    }

    /// Files of which nobody said, and nothing in them shows, which control runs them. One that is for a control that gcheck
    /// does not have is not among them: it shows it, and the choice has that for a reason.
    pub fn files_by_default(&self) -> usize {
        let is_default =
            |file: &&File| file.control.source == ControlSource::Default && file.control.because.is_none();
        self.files.iter().filter(is_default).count()
    }

    /// Files that are for a control which gcheck does not read.
    pub fn unsupported_files(&self) -> usize {
        let is_it = |file: &&File| {
            let mut rules = file.findings.iter().map(|finding| finding.rule);
            let mut omitted = file.omitted.iter().map(|(rule, ..)| *rule);
            rules.any(|rule| rule.id == UNSUPPORTED) || omitted.any(|rule| rule.id == UNSUPPORTED)
        };
        self.files.iter().filter(is_it).count()
    }

    /// The sums.
    pub fn summary(&self) -> Summary {
        let mut sum =
            Summary { files: self.files.len(), skipped: self.skipped.clone(), ..Summary::default() };
        for file in &self.files {
            sum.lines += file.lines;
            sum.suppressed += file.suppressed;
            sum.baseline += file.baseline;
            sum.fixed += file.fixed;
            for assumption in &file.assumptions {
                match sum.assumptions.iter_mut().find(|a| a.text == assumption.text) {
                    Some(known) => known.files += 1,
                    None => sum.assumptions.push(Assumed {
                        text: assumption.text.clone(),
                        pin: assumption.pin.clone(),
                        files: 1,
                    }),
                }
            }
            if file.out_of_fuel {
                sum.out_of_fuel.push(file.path.clone());
            }
            let failed = |rule: &&'static str| FailedRule { file: file.path.clone(), rule };
            sum.failed_rules.extend(file.failed_rules.iter().map(failed));
            sum.omitted += file.omitted.iter().map(|(_, _, count)| count).sum::<usize>();
            let kept = file.findings.iter().map(|finding| (finding.severity, 1));
            let omitted = file.omitted.iter().map(|(_, severity, count)| (*severity, *count));
            for (severity, count) in kept.chain(omitted) {
                match severity {
                    Severity::Error => sum.errors += count,
                    Severity::Warning => sum.warnings += count,
                    Severity::Info => sum.infos += count,
                    Severity::Hint => sum.hints += count,
                }
            }
        }
        sum.assumptions.sort_by(|a, b| b.files.cmp(&a.files).then_with(|| a.text.cmp(&b.text)));
        sum
    }

    pub(crate) fn files(&self) -> &[File] {
        &self.files
    }

    /// The files that could not be checked.
    pub(crate) fn skipped(&self) -> &[Skipped] {
        &self.skipped
    }

    /// A path as the formats of servers name it.
    pub(crate) fn rooted<'p>(&self, path: &'p str) -> Cow<'p, str> {
        self.base.as_ref().map_or(Cow::Borrowed(path), |base| base.rooted(path))
    }

    /// Does the finding make the run fail?
    pub(crate) fn is_failed_by(&self, finding: &Finding) -> bool {
        self.fails_from.is_some_and(|from| finding.severity >= from)
            || self.fails_when_incomplete && finding.rule.id == INCOMPLETE
    }

    /// The name of the test of a file without findings.
    pub(crate) fn passed(&self) -> &'static str {
        self.passed
    }

    /// Every finding with its file, in order.
    pub(crate) fn findings(&self) -> impl Iterator<Item = (&File, &Finding)> {
        self.files.iter().flat_map(|file| file.findings.iter().map(move |finding| (file, finding)))
    }

    /// Whether formats for people fold repeats.
    pub(crate) fn folds(&self) -> bool {
        self.folds
    }

    /// The rules that ran and those of findings, by id.
    pub(crate) fn rules(&self) -> Vec<&'static RuleMeta> {
        let mut rules = self.rules.clone();
        rules.extend(self.findings().map(|(_, finding)| finding.rule));
        rules.sort_by_key(|rule| rule.id);
        rules.dedup_by_key(|rule| rule.id);
        rules
    }

    /// The text of a file that a label points to.
    pub(crate) fn source(&self, path: &str) -> Option<&Source> {
        let checked = self.files.binary_search_by(|file| file.path.as_str().cmp(path)).ok();
        let checked = checked.and_then(|at| self.files.get(at)).map(|file| &file.source);
        checked.or_else(|| self.related.iter().find(|(name, _)| name == path).map(|(_, source)| source))
    }
}

impl File {
    fn new(file: FileReport) -> Self {
        let FileReport {
            path,
            text,
            control,
            mut findings,
            omitted,
            lines,
            suppressed,
            baseline,
            fixed,
            out_of_fuel,
            failed_rules,
            assumptions,
        } = file;
        findings.sort_by(order);
        Self {
            path,
            rooted: None,
            in_fold: InFold::Not,
            source: Source::new(text),
            control,
            findings,
            omitted,
            lines,
            suppressed,
            baseline,
            fixed,
            out_of_fuel,
            failed_rules,
            assumptions,
        }
    }

    /// The path as the formats of servers name it.
    pub(crate) fn rooted(&self) -> &str {
        let path = self.rooted.as_ref().unwrap_or(&self.path);
        path.strip_prefix("./").unwrap_or(path)
    }

    /// One for each finding.
    pub(crate) fn fingerprints(&self) -> Vec<Fingerprint> {
        Fingerprinter::all(self.rooted.as_ref().unwrap_or(&self.path), self.source.text(), &self.findings)
    }
}
