//! What is not done again after an edit.

#![expect(clippy::unwrap_used, clippy::string_slice, reason = "tests")]

use std::ops::Range;
use std::sync::{Arc, Mutex};

use gcheck_db::{Database, DocumentId, Settings};
use gcheck_testkit::inputs;

/// A database, and the queries that it has executed.
struct Watched {
    database: Database,
    id: DocumentId,
    text: String,
    executed: Arc<Mutex<Vec<String>>>,
}

impl Watched {
    fn open(text: String) -> Self {
        let executed: Arc<Mutex<Vec<String>>> = Arc::default();
        let told = Arc::clone(&executed);
        let mut database = Database::telling(move |query| told.lock().unwrap().push(query.to_owned()));
        let id = database
            .open(&text, Settings::new(gcheck_controls::load("haas-mill").unwrap(), gcheck_rules::RULES));
        let mut watched = Self { database, id, text, executed };
        watched.analyse();
        watched
    }

    /// How often each query was executed: facts of chunks, findings of chunks.
    fn analyse(&mut self) -> (usize, usize) {
        self.executed.lock().unwrap().clear();
        self.database.analysis(self.id, &|| false).unwrap();
        (self.executed("facts"), self.executed("findings"))
    }

    /// How often the last analysis executed a query.
    fn executed(&self, name: &str) -> usize {
        self.executed.lock().unwrap().iter().filter(|query| query.starts_with(name)).count()
    }

    /// The line in which `line` falls, its end included.
    fn line(&self, line: usize) -> Range<usize> {
        let start = self.text.match_indices('\n').nth(line - 1).unwrap().0 + 1;
        start..start + self.text[start..].find('\n').unwrap() + 1
    }

    fn edit(&mut self, range: Range<usize>, insert: &str) -> (usize, usize) {
        self.database.edit(self.id, range.start as u32..range.end as u32, insert).unwrap();
        self.text.replace_range(range, insert);
        let chunks = self.analyse();
        let fresh = Database::new().open_and_analyse(&self.text);
        let known = self.database.analysis(self.id, &|| false).unwrap();
        assert_eq!(format!("{:?}", known.findings), format!("{:?}", fresh.findings));
        chunks
    }
}

trait OpenAndAnalyse {
    fn open_and_analyse(&mut self, text: &str) -> Arc<gcheck_db::Analysis>;
}

impl OpenAndAnalyse for Database {
    fn open_and_analyse(&mut self, text: &str) -> Arc<gcheck_db::Analysis> {
        let id =
            self.open(text, Settings::new(gcheck_controls::load("haas-mill").unwrap(), gcheck_rules::RULES));
        self.analysis(id, &|| false).unwrap()
    }
}

#[test]
fn the_tree_of_an_edited_chunk_is_made_once_and_everything_follows_from_it() {
    let mut watched = Watched::open(inputs::surfacing(60_000));
    let of_opened = watched.executed("tree") + watched.executed("blocks");
    assert_eq!(of_opened, 0, "a text that is opened goes from tokens to blocks");
    let line = watched.line(50_000);
    watched.edit(line.start..line.start, "(HERE) ");
    let made = ["tree", "blocks", "facts", "findings"].map(|query| watched.executed(query));
    let [trees, ..] = made;
    assert!((1..=2).contains(&trees) && made.iter().all(|count| *count == trees), "{made:?}");
}

#[test]
fn a_snapshot_has_tree_and_blocks_of_the_edited_chunk_from_the_queries() {
    let mut watched = Watched::open(inputs::surfacing(60_000));
    let line = watched.line(50_000);
    watched.edit(line.start..line.start, "(HERE) ");
    let snapshot = watched.database.indexed(watched.id).unwrap();
    let chunk = snapshot.chunk_at(line.start as u32).unwrap().index;
    let (tree, table) = (snapshot.tree(chunk).unwrap(), snapshot.table(chunk).unwrap());
    assert_eq!(snapshot.tables_read(), 0);
    assert_eq!(tree.syntax().to_string(), snapshot.chunk(chunk).unwrap().text);
    assert!(table.blocks().next().is_some());
    assert!(Arc::ptr_eq(&tree, &snapshot.tree(chunk).unwrap()), "the tree is kept");
    assert_ne!(snapshot.tree(0).unwrap().syntax().to_string(), tree.syntax().to_string());
}

#[test]
fn a_comment_is_read_again_in_its_chunk_alone() {
    let mut watched = Watched::open(inputs::surfacing(60_000));
    let line = watched.line(50_000);
    let (facts, findings) = watched.edit(line.start..line.start, "(HERE) ");
    assert!((1..=2).contains(&facts) && (1..=2).contains(&findings), "{facts} {findings}");
    let work = watched.database.work(watched.id).unwrap();
    assert!(work.executed <= 3 && work.from_the_start == 0, "{work:?}");
}

#[test]
fn behind_another_coordinate_states_are_the_same_again() {
    let mut watched = Watched::open(inputs::surfacing(60_000));
    let line = watched.line(50_000);
    let digit = line.start + watched.text[line].find('X').unwrap() + 2;
    let (facts, _) = watched.edit(digit..digit + 1, "9");
    let work = watched.database.work(watched.id).unwrap();
    assert!(facts <= 2 && work.executed <= 3 && work.from_the_start == 0, "{facts} {work:?}");
}

#[test]
fn a_modal_word_that_changes_nothing_leaves_the_rest_as_it_was() {
    let mut watched = Watched::open(inputs::surfacing(60_000));
    let line = watched.line(50_000);
    watched.edit(line.start..line.start, "G01 ");
    let line = watched.line(50_001);
    watched.edit(line.start..line.start, "G1 ");
    let work = watched.database.work(watched.id).unwrap();
    assert!(work.executed <= 3 && work.from_the_start == 0, "{work:?}");
}

#[test]
fn lines_at_the_top_do_not_move_what_is_known() {
    let mut watched = Watched::open(inputs::surfacing(60_000));
    let line = watched.line(2);
    let (facts, _) = watched.edit(line.start..line.start, "(ONE)\n(TWO)\n");
    let work = watched.database.work(watched.id).unwrap();
    assert!(facts <= 2 && work.executed <= 3, "{facts} {work:?}");
}

#[test]
fn a_jump_has_the_control_flow_analysed_again_and_no_chunk_read() {
    let mut watched = Watched::open(inputs::surfacing(60_000));
    let line = watched.line(50_000);
    let (facts, _) = watched.edit(line.start..line.start, "IF [#500 EQ 1.] GOTO 7\nN7 ");
    let work = watched.database.work(watched.id).unwrap();
    assert!(facts <= 2 && work.from_the_start >= 1 && work.kept == 0, "{facts} {work:?}");
}

#[test]
fn work_that_was_given_up_is_taken_up_where_it_was() {
    let text = inputs::surfacing(60_000);
    let mut database = Database::new();
    let id =
        database.open(&text, Settings::new(gcheck_controls::load("haas-mill").unwrap(), gcheck_rules::RULES));
    let asked = std::cell::Cell::new(0);
    let stop = || {
        asked.set(asked.get() + 1);
        asked.get() > 6
    };
    assert!(database.analysis(id, &stop).is_err());
    let analysis = database.analysis(id, &|| false).unwrap();
    let fresh = Database::new().open_and_analyse(&text);
    assert_eq!(format!("{:?}", analysis.findings), format!("{:?}", fresh.findings));
}

#[test]
fn states_are_those_of_the_place() {
    let mut watched = Watched::open(inputs::surfacing(5_000));
    let line = watched.line(4_000);
    watched.edit(line, "X1. Y2. Z3.\n");
    let snapshot = watched.database.snapshot(watched.id).unwrap();
    let at = watched.line(4_000).start as u32;
    let block = snapshot.block_at(at).unwrap().number;
    let states = watched.database.states(watched.id, block..block + 1, &|| false).unwrap();
    let [state] = states.as_slice() else { panic!("one state, not {}", states.len()) };
    let after = state.after.as_ref().unwrap().position();
    let values =
        [gcheck_engine::Axis::X, gcheck_engine::Axis::Y, gcheck_engine::Axis::Z].map(|axis| after.raw(axis));
    assert!(state.on_every_path && state.visits == 1);
    assert_eq!(format!("{values:?}"), "[1.0, 2.0, 3.0]");
}

#[test]
fn the_first_lines_of_a_document_are_checked_ahead_of_the_rest() {
    // Nobody has said a feed, and in the last lines is a code that is none.
    let text = inputs::surfacing(60_000).replace(" F2500.", "").replace("\nM30", "\nG999\nM30");
    let executed = Arc::new(Mutex::new(0));
    let told = Arc::clone(&executed);
    let mut database = Database::telling(move |query| {
        *told.lock().unwrap() += usize::from(query.starts_with("findings"));
    });
    let id =
        database.open(&text, Settings::new(gcheck_controls::load("haas-mill").unwrap(), gcheck_rules::RULES));
    let first = database.first_findings(id, 20_000, &|| false).unwrap().unwrap();
    let states = database.states(id, 20..30, &|| false).unwrap();
    assert_eq!(states.len(), 10);
    let (work, executed) = (database.work(id).unwrap(), *executed.lock().unwrap());
    assert!(work.executed <= 5 && executed <= 5, "{work:?} {executed}");
    let rules: Vec<&str> = first.findings.iter().map(|finding| finding.rule.id).collect();
    assert_eq!(rules, ["feed-missing"]);

    let whole = database.analysis(id, &|| false).unwrap();
    assert!(first.findings.iter().all(|finding| whole.findings.contains(finding)));
    assert!(database.work(id).unwrap().from_the_start == 0);
    assert!(whole.findings.iter().any(|finding| finding.rule.id == "unknown-code"));
    let fresh = Database::new().open_and_analyse(&text);
    assert_eq!(format!("{:?}", whole.findings), format!("{:?}", fresh.findings));
    assert!(database.first_findings(id, 20_000, &|| false).unwrap().is_none());
    // Edited, it is not known ahead of the analysis.
    database.edit(id, 2..2, "(HERE)\n").unwrap();
    let after = database.states(id, 21..31, &|| false).unwrap();
    let places = |states: &[gcheck_db::StateAt]| {
        states.iter().map(|state| format!("{:?}", state.before.position())).collect::<Vec<_>>()
    };
    assert_eq!(places(&after), places(&states));
}
