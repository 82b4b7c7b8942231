//! A rule that panics takes its own findings with it and no others, in a check and in the database, and is named.
//!
//! Knows: a table of rules of which some panic at a word. Must not know: the rules that are published.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail, and so are its rules")]

use gcheck_db::{Database, Settings};
use gcheck_diagnostics::{Finding, Fixability, RuleMeta, Severity, Tier};
use gcheck_engine::Event;
use gcheck_lint::{
    BlockCx, ControlBasis, Environment, Execution, FileCx, Job, MachineFacts, NoPrograms, Outcome, PathCx,
    PathRule, Report, RuleEntry, RuleTable, Run, Selection, Watch, check,
};
use gcheck_program::{BlockFlags, Dialect};
use gcheck_syntax::SourceText;

const fn meta(id: &'static str, tier: Tier) -> RuleMeta {
    RuleMeta {
        id,
        group: "words",
        summary: "",
        severity: Severity::Warning,
        tier,
        recommended: true,
        other_sets: &[],
        control_specific: false,
        fixability: Fixability::Never,
        since: "0.1.0",
        aliases: &[],
        raw_docs: "",
    }
}

static SOUND_BLOCK: RuleMeta = meta("sound-block", Tier::Block);
static FRAIL_BLOCK: RuleMeta = meta("frail-block", Tier::Block);
static FRAIL_FILE: RuleMeta = meta("frail-file", Tier::Program);
static SOUND_PATH: RuleMeta = meta("sound-path", Tier::Path);
static FRAIL_PATH: RuleMeta = meta("frail-path", Tier::Path);

fn sound_block(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    report.add(Finding::new(&SOUND_BLOCK, cx.block_range(), "a block"));
}

/// Panics at `N111`, and finds the blocks before it.
fn frail_block(cx: &BlockCx<'_>, report: &mut Report<'_>) {
    assert!(!cx.block_text().contains("N111"), "the block holds the word");
    report.add(Finding::new(&FRAIL_BLOCK, cx.block_range(), "a block"));
}

/// Panics at `N112`.
fn frail_file(cx: &FileCx<'_>, report: &mut Report<'_>) {
    report.add(Finding::new(&FRAIL_FILE, 0..1, "a file"));
    cx.each_block(|cx| assert!(!cx.block_text().contains("N112"), "the file holds the word"));
}

#[derive(Default)]
struct SoundPath;

impl PathRule for SoundPath {
    fn moved(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        report.add(Finding::new(&SOUND_PATH, cx.range(), "a move"));
    }
}

/// Panics when it is shown a move to `X113`.
#[derive(Default)]
struct FrailPath;

impl PathRule for FrailPath {
    fn moved(&mut self, cx: &PathCx<'_>, _: &Event, report: &mut Report<'_>) {
        report.add(Finding::new(&FRAIL_PATH, cx.range(), "a move"));
        let target = cx.word('X').and_then(|word| word.number());
        assert!(target.is_none_or(|target| target < 113.0), "the move goes too far");
    }
}

static TABLE: RuleTable = RuleTable::new(&[
    &RuleEntry { meta: &FRAIL_BLOCK, run: Run::Block { trigger: BlockFlags::CODE, check: frail_block } },
    &RuleEntry { meta: &FRAIL_FILE, run: Run::Program { check: frail_file } },
    &RuleEntry { meta: &FRAIL_PATH, run: Run::Path { watch: Watch::MOVES, make: || Box::new(FrailPath) } },
    &RuleEntry { meta: &SOUND_BLOCK, run: Run::Block { trigger: BlockFlags::CODE, check: sound_block } },
    &RuleEntry { meta: &SOUND_PATH, run: Run::Path { watch: Watch::MOVES, make: || Box::new(SoundPath) } },
]);

const PROGRAM: &str = "%\nO1\nG0 X1.\nG1 X2. F100.\nX3.\nM30\n%\n";

fn checked(text: &str) -> Outcome {
    let control = gcheck_controls::load(gcheck_controls::fallback()).unwrap();
    let source = SourceText::from(text);
    check(&Job {
        source: &source,
        environment: Environment {
            dialect: &Dialect::new(&control),
            machine: &MachineFacts::default(),
            programs: &NoPrograms,
            control_basis: ControlBasis::Chosen,
            unsupported: None,
        },
        selection: &Selection::recommended(TABLE),
        suppressions: true,
        execution: Execution::default(),
    })
}

fn ids(rules: &[&RuleMeta]) -> Vec<&'static str> {
    rules.iter().map(|rule| rule.id).collect()
}

/// The findings of all rules but these.
fn of_others(outcome: &Outcome, but: &[&str]) -> Vec<Finding> {
    outcome.findings.iter().filter(|finding| !but.contains(&finding.rule.id)).cloned().collect()
}

/// In a program with more lines these rules panic, and nothing else changes.
fn check_failing(line: &str, failing: &[&str]) {
    let text = PROGRAM.replace("X3.\n", &format!("X3.\n{line}\n"));
    let harmless = text.replace("N11", "N22").replace("X113.", "X012.");
    let (outcome, expected) = (checked(&text), checked(&harmless));
    assert_eq!(ids(&outcome.failed), failing, "{line}");
    assert_eq!(expected.failed, Vec::<&RuleMeta>::new(), "{line}");
    assert!(
        of_others(&expected, failing).len() < expected.findings.len(),
        "{line}: the rules find something"
    );
    assert_eq!(outcome.findings, of_others(&expected, failing), "{line}");

    // The same from edit to edit, there and back.
    let settings = Settings::new(gcheck_controls::load(gcheck_controls::fallback()).unwrap(), TABLE);
    let mut database = Database::new();
    let id = database.open(PROGRAM, settings);
    let at = text.find(line).unwrap() as u32;
    let with = line.len() as u32 + 1;
    for (range, insert, expected) in
        [(at..at, format!("{line}\n"), &outcome), (at..at + with, String::new(), &checked(PROGRAM))]
    {
        database.analysis(id, &|| false).unwrap();
        database.edit(id, range, &insert).unwrap();
        let known = database.analysis(id, &|| false).unwrap();
        assert_eq!(known.findings, expected.findings, "{line}");
        assert_eq!(ids(&known.failed), ids(&expected.failed), "{line}");
    }
}

#[test]
fn a_rule_of_blocks_takes_its_own_findings_with_it() {
    check_failing("N111 G4 P1.", &["frail-block"]);
}

#[test]
fn a_rule_of_files_takes_its_own_findings_with_it() {
    check_failing("N112 G4 P1.", &["frail-file"]);
}

#[test]
fn a_rule_of_paths_takes_its_own_findings_with_it() {
    check_failing("X113.", &["frail-path"]);
}

#[test]
fn several_rules_may_fail_in_one_program() {
    check_failing("N111 G4 P1.\nN112 G4 P1.\nX113.", &["frail-block", "frail-file", "frail-path"]);
}

#[test]
fn a_panic_outside_of_a_rule_is_not_laid_on_one() {
    struct Broken;
    impl gcheck_lint::Programs for Broken {
        fn has_number(&self, _: u32) -> bool {
            panic!("not a rule")
        }
        fn has_name(&self, _: &str) -> bool {
            panic!("not a rule")
        }
        fn source_of_number(&self, _: u32) -> Option<gcheck_engine::SourceFile> {
            panic!("not a rule")
        }
    }
    let control = gcheck_controls::load(gcheck_controls::fallback()).unwrap();
    let source = SourceText::from("%\nO1\nM98 P5\nM30\n%\n");
    let ended = std::panic::catch_unwind(|| {
        check(&Job {
            source: &source,
            environment: Environment {
                dialect: &Dialect::new(&control),
                machine: &MachineFacts::default(),
                programs: &Broken,
                control_basis: ControlBasis::Chosen,
                unsupported: None,
            },
            selection: &Selection::recommended(TABLE),
            suppressions: true,
            execution: Execution::default(),
        })
    });
    assert!(ended.is_err(), "who calls the check hears of it");
}
