//! One program and what is known of it, from question to question.
//!
//! Knows: which question needs what, how much text and work there may be. Must not know: JSON, browsers.

use std::cmp::Reverse;

use gcheck_db::{Database, DocumentId};
use gcheck_diagnostics::Finding;
use gcheck_ide::{MAX_SEGMENTS, Toolpath};

use crate::answers::{Choice, ControlRow, Findings, Found, Refused, Shown};
use crate::choice::{choose, settings};
use crate::place::{Place, offset, span};

/// Bytes of text that are read; of more nothing is.
pub const MAX_TEXT: usize = 1 << 20;
/// Findings that are listed.
pub const MAX_FINDINGS: usize = 500;
/// Blocks that a run for the picture executes.
pub const MAX_BLOCKS: u64 = 500_000;

/// A program and what is known of it: questions about the same text share the work.
#[derive(Debug, Default)]
pub struct Session {
    database: Database,
    open: Option<Open>,
}

#[derive(Debug)]
struct Open {
    document: DocumentId,
    text: String,
    /// As the question named it; empty where the program decides.
    chosen: String,
    choice: Choice,
    /// What reads it, where no control here does.
    unsupported: Option<&'static str>,
}

impl Session {
    /// Without a program.
    pub fn new() -> Self {
        Self::default()
    }

    /// The controls that can be chosen.
    pub fn controls() -> Vec<ControlRow> {
        let controls = gcheck_controls::names().iter().filter_map(|name| gcheck_controls::load(name).ok());
        controls
            .map(|control| ControlRow { name: control.name().to_owned(), title: control.title().to_owned() })
            .collect()
    }

    /// What is found in a program. `control` is a name of [`Session::controls`], or empty where the program decides.
    ///
    /// # Errors
    /// [`Refused`] where the text is too long, or the control is not known.
    pub fn check(&mut self, text: &str, control: &str) -> Result<Findings, Refused> {
        let document = self.document(text, control)?;
        let analysis = self.database.analysis(document, &|| false).map_err(|_| gone())?;
        let snapshot = self.database.snapshot(document).ok_or_else(gone)?;
        let mut listed: Vec<&Finding> = analysis.findings.iter().collect();
        let counted: usize = analysis.omitted.iter().map(|(_, _, count)| count).sum();
        let more = counted + listed.len().saturating_sub(MAX_FINDINGS);
        if listed.len() > MAX_FINDINGS {
            // Stable: of one severity the first in the text stay.
            listed.sort_by_key(|finding| Reverse(finding.severity));
            listed.truncate(MAX_FINDINGS);
            listed.sort_by_key(|finding| (finding.range.start, finding.range.end));
        }
        Ok(Findings {
            control: self.open.as_ref().map(|open| open.choice.clone()).ok_or_else(gone)?,
            findings: listed.into_iter().map(|finding| Found::new(&snapshot, finding)).collect(),
            more,
            suppressed: analysis.suppressed,
            out_of_fuel: analysis.out_of_fuel,
        })
    }

    /// What is known of a place: the code or word there, and the state before and after its block. `None` where there is no
    /// block.
    ///
    /// # Errors
    /// As [`Session::check`].
    pub fn hover(&mut self, text: &str, control: &str, place: Place) -> Result<Option<Shown>, Refused> {
        let document = self.document(text, control)?;
        let snapshot = self.database.snapshot(document).ok_or_else(gone)?;
        let at = offset(&snapshot, place);
        let hover = gcheck_ide::hover(&mut self.database, document, at, &|| false);
        Ok(hover.map(|hover| Shown { span: span(&snapshot, &hover.range), markdown: hover.markdown }))
    }

    /// The path of a run of the program, for the viewer of `gcheck plot`.
    ///
    /// # Errors
    /// As [`Session::check`].
    pub fn toolpath(&mut self, text: &str, control: &str) -> Result<Toolpath, Refused> {
        let document = self.document(text, control)?;
        let snapshot = self.database.indexed(document).ok_or_else(gone)?;
        gcheck_ide::toolpath(&snapshot, None, MAX_BLOCKS, MAX_SEGMENTS, &|| false).map_err(|_| gone())
    }

    /// The document with this text and control.
    fn document(&mut self, text: &str, chosen: &str) -> Result<DocumentId, Refused> {
        if text.len() > MAX_TEXT {
            let (has, most) = (text.len().div_ceil(1024), MAX_TEXT / 1024);
            return Err(Refused(format!(
                "the text has {has} KB; the playground reads up to {most} KB, and `gcheck check` reads files of any size"
            )));
        }
        if let Some(open) = self.open.as_ref().filter(|open| open.text == text && open.chosen == chosen) {
            return Ok(open.document);
        }
        let (choice, control) = choose(text, chosen)?;
        let settings = settings(text, &choice, control);
        let unsupported = settings.unsupported.map(|dialect| dialect.name.as_str());
        let document = match &self.open {
            Some(open) => {
                self.database.set_text(open.document, text);
                let is_same = open.choice.name == choice.name
                    && open.choice.source == choice.source
                    && open.unsupported == unsupported;
                if !is_same {
                    self.database.set_settings(open.document, settings);
                }
                open.document
            }
            None => self.database.open(text, settings),
        };
        let (text, chosen) = (text.to_owned(), chosen.to_owned());
        self.open = Some(Open { document, text, chosen, choice, unsupported });
        Ok(document)
    }
}

/// The database does not give up and forgets no document, unless it has a mistake.
fn gone() -> Refused {
    Refused("gcheck lost the program: this is a mistake of gcheck".to_owned())
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::{MAX_FINDINGS, MAX_TEXT, Session};
    use crate::answers::Source;
    use crate::place::Place;

    const PART: &str = "%\nO1 (\u{d8}20 PART)\nG21 G90 G54\nT1 M6\nG0 X0. Y0. Z5.\nG1 X50.\nM30\n%\n";

    #[test]
    fn every_control_can_be_chosen() {
        let controls = Session::controls();
        assert!(controls.len() > 3);
        let mut session = Session::new();
        for control in controls {
            let found = session.check(PART, &control.name).unwrap();
            assert_eq!((found.control.name, found.control.source), (control.name, Source::Chosen));
        }
    }

    #[test]
    fn a_finding_has_its_place_and_its_words() {
        let mut session = Session::new();
        let found = session.check(PART, "haas-mill").unwrap();
        let feed = found.findings.iter().find(|found| found.rule == "feed-missing").unwrap();
        let json = serde_json::to_string_pretty(feed).unwrap();
        expect![[r#"
            {
              "rule": "feed-missing",
              "page": "https://github.com/gcheck/gcheck/blob/main/docs/rules/feed-missing.md",
              "severity": "error",
              "span": {
                "start": {
                  "line": 6,
                  "column": 1
                },
                "end": {
                  "line": 6,
                  "column": 8
                }
              },
              "message": "cut without a feed (`F`)",
              "label": "no feed is in effect here",
              "related": [],
              "notes": [
                "a cutting move needs a feed; every control of this family stops with an alarm without one"
              ],
              "help": "give `F` in this block or before it"
            }"#]]
        .assert_eq(&json);
    }

    #[test]
    fn the_program_decides_where_nobody_chooses() {
        let mut session = Session::new();
        let found = session.check("#<depth> = 1\no100 sub\no100 endsub\nM2\n", "").unwrap();
        assert_eq!((found.control.name.as_str(), found.control.source), ("linuxcnc", Source::Shown));
        assert!(found.control.because.is_some());
        // The same session, another program.
        let found = session.check("G0 X1.\n", "").unwrap();
        assert_eq!(found.control.name, gcheck_controls::fallback());
        assert_eq!((found.control.source, found.control.because), (Source::Usual, None));
        let found = session.check("(gcheck: control=grbl)\nG0 X1.\n", "").unwrap();
        assert_eq!((found.control.name.as_str(), found.control.source), ("grbl", Source::Comment));
        assert_eq!(session.check("(gcheck: control=grbl)\n", "linuxcnc").unwrap().control.name, "linuxcnc");
        assert!(session.check("(gcheck: control=no-such)\n", "").unwrap_err().0.contains("no-such"));
    }

    #[test]
    fn of_an_unsupported_dialect_this_alone_is_said() {
        let printed = "G92 E0\nG1 X1 E1.1\nG1 X2 E1.2\nG1 Y2 E1.3\n";
        let mut session = Session::new();
        let rules = |session: &mut Session, control| {
            let found = session.check(printed, control).unwrap().findings;
            found.into_iter().map(|found| found.rule).collect::<Vec<_>>()
        };
        assert_eq!(rules(&mut session, ""), ["unsupported-dialect"]);
        assert!(!rules(&mut session, "haas-mill").contains(&"unsupported-dialect"));
        assert_eq!(rules(&mut session, ""), ["unsupported-dialect"]);
    }

    /// Both are read for the usual control, for want of another one.
    #[test]
    fn the_dialect_that_is_named_is_that_of_the_text() {
        let mut session = Session::new();
        let mut named = |text: &str| {
            let found = session.check(text, "").unwrap();
            found.findings.into_iter().map(|found| found.message).collect::<Vec<_>>().join("\n")
        };
        let printed = named("G92 E0\nG1 X1 E1.1\nG1 X2 E1.2\nG1 Y2 E1.3\n");
        let other = named("N10 G54\nN20 R1=5 R2=7\nN30 TRANS X=R1\nN40 G0 X=R2\n");
        assert!(printed.contains("a 3-D printer"), "{printed}");
        assert!(other.contains("a SINUMERIK control"), "{other}");
    }

    #[test]
    fn a_text_that_changes_is_a_new_program() {
        let mut session = Session::new();
        let has_feed_missing = |session: &mut Session, text: &str| {
            session
                .check(text, "haas-mill")
                .unwrap()
                .findings
                .iter()
                .any(|found| found.rule == "feed-missing")
        };
        assert!(has_feed_missing(&mut session, PART));
        assert!(!has_feed_missing(&mut session, &PART.replace("G1 X50.", "G1 X50. F200.")));
        assert!(has_feed_missing(&mut session, PART));
    }

    #[test]
    fn hover_tells_the_code_and_the_state() {
        let mut session = Session::new();
        let shown = session.hover(PART, "haas-mill", Place { line: 6, column: 1 }).unwrap().unwrap();
        assert!(shown.markdown.contains("G1"), "{}", shown.markdown);
        assert!(shown.markdown.contains("`X0 Y0 Z5`"), "{}", shown.markdown);
        assert_eq!((shown.span.start.line, shown.span.start.column, shown.span.end.column), (6, 1, 3));
        assert_eq!(session.hover(PART, "haas-mill", Place { line: 1, column: 1 }).unwrap(), None);
    }

    #[test]
    fn the_path_is_drawn() {
        let path = Session::new().toolpath(PART, "haas-mill").unwrap();
        assert_eq!(path.moves, 2);
        assert!(path.data["count"].as_u64() > Some(1), "{}", path.data);
    }

    #[test]
    fn an_endless_program_is_drawn_as_far_as_it_ran() {
        let path = Session::new().toolpath("O1\nN1 G91 G0 X1.\nGOTO 1\nM30\n", "haas-mill").unwrap();
        assert!(path.stopped.unwrap().contains("500000 blocks"));
    }

    #[test]
    fn an_empty_text_has_answers() {
        let mut session = Session::new();
        session.check("", "").unwrap();
        assert_eq!(session.hover("", "", Place { line: 1, column: 1 }).unwrap(), None);
        assert_eq!(session.toolpath("", "").unwrap().moves, 0);
    }

    #[test]
    fn a_long_text_is_refused_in_words() {
        let mut session = Session::new();
        let refused = session.check(&"G0 X1.\n".repeat(300_000), "").unwrap_err();
        assert!(
            refused.0.starts_with("the text has 2051 KB; the playground reads up to 1024 KB"),
            "{refused}"
        );
        session.check(&" ".repeat(MAX_TEXT), "").unwrap();
    }

    #[test]
    fn an_unknown_control_is_refused_in_words() {
        let refused = Session::new().check(PART, "no-such").unwrap_err();
        assert!(refused.0.contains("no-such"), "{refused}");
    }

    #[test]
    fn of_many_findings_the_gravest_are_listed() {
        let text = format!("%\nO1\nG20 G90 G54\n{}M30\n%\n", "X1. ]\n".repeat(MAX_FINDINGS + 20));
        let found = Session::new().check(&text, "haas-mill").unwrap();
        assert_eq!(found.findings.len(), MAX_FINDINGS);
        assert!(found.more >= 20);
        assert!(found.findings.is_sorted_by_key(|found| found.span.start.line));
    }
}
