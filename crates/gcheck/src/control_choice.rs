//! Which control runs a program: option, comment, configuration, detection, neighbours, fallback, in this order.
//!
//! Knows: the order. Must not know: any control.

use std::path::Path;

use gcheck_controls::{Guess, UnsupportedDialect, Weighed};
use gcheck_lint::{ControlBasis, Selection};
use gcheck_program::control_comment;
use gcheck_report::{ControlChoice, ControlSource};
use gcheck_syntax::SourceText;

use crate::config::validate_control;
use crate::neighbours::{Majority, Neighbours};
use crate::{Problem, paths};

/// The control of a program, and what was seen when it was chosen.
#[derive(Debug, Clone)]
pub(crate) struct Chosen {
    pub(crate) choice: ControlChoice,
    /// The programs beside it may change the choice.
    pub(crate) depends_on_neighbours: bool,
    /// The dialect, where no control here reads it and nobody chose one.
    pub(crate) unsupported: Option<&'static UnsupportedDialect>,
}

/// Chooses the control of a program; `configured` is the configuration's, with the file that says so.
pub(crate) fn choose(
    path: &Path,
    source: &SourceText,
    option: Option<&str>,
    configured: Option<(&str, Option<&Path>)>,
    neighbours: &Neighbours,
) -> Result<Chosen, Problem> {
    let choice = |name: &str, source, because| Chosen {
        choice: ControlChoice { name: name.to_owned(), source, because },
        depends_on_neighbours: false,
        unsupported: None,
    };
    if let Some(name) = option {
        return Ok(choice(name, ControlSource::Option, None));
    }
    if let Some((name, comment)) = named_in_comment(path, source)? {
        return Ok(choice(&name, ControlSource::Comment, Some(comment)));
    }
    if let Some((name, file)) = configured {
        let because = file.map(paths::shown_from_here);
        return Ok(choice(name, ControlSource::Configuration, because));
    }
    let evidence = neighbours.evidence(path, source.text());
    let weighed = Weighed::new(&evidence);
    let guess = weighed.guess();
    // Only a program that leaves a choice is worth the reading of its neighbours.
    let depends_on_neighbours =
        evidence.unsupported.is_none() && guess.as_ref().is_none_or(|guess| !guess.is_clear);
    Ok(Chosen {
        choice: guessed(guess, &weighed, || {
            depends_on_neighbours.then(|| neighbours.majority(path)).flatten()
        })
        .unwrap_or_else(|| fallback(&weighed, evidence.unsupported)),
        depends_on_neighbours,
        unsupported: evidence.unsupported,
    })
}

/// The choice that the program shows, or those beside it; `majority` is the control that they show.
fn guessed(
    guess: Option<Guess>,
    weighed: &Weighed<'_>,
    majority: impl FnOnce() -> Option<Majority>,
) -> Option<ControlChoice> {
    let choice =
        |name: String, source, because: String| Some(ControlChoice { name, source, because: Some(because) });
    // What a program says of itself counts more than what is beside it.
    let is_possible = |control: &String| match &guess {
        Some(guess) => [Some(&guess.control), guess.rival.as_ref()].contains(&Some(control)),
        None => weighed.may_be_for(control),
    };
    let is_clear = guess.as_ref().is_some_and(|guess| guess.is_clear);
    if !is_clear && let Some(majority) = majority().filter(|majority| is_possible(&majority.control)) {
        let because = majority.words();
        return choice(majority.control, ControlSource::Neighbours, because);
    }
    let Guess { control, because, rival, is_clear } = guess?;
    match rival {
        Some(rival) => {
            choice(control, ControlSource::Guessed, format!("{because}; {rival} fits nearly as well"))
        }
        None if is_clear => choice(control, ControlSource::Detected, because),
        None => choice(control, ControlSource::Guessed, because),
    }
}

/// The choice where nothing shows a control; the reason names the dialect or the control that is shown and not to be had.
fn fallback(weighed: &Weighed<'_>, unsupported: Option<&UnsupportedDialect>) -> ControlChoice {
    let because = match unsupported {
        Some(dialect) => Some(format!("the file is for {}", dialect.name)),
        None => weighed
            .foreign()
            .map(|other| format!("{} names {}, which gcheck does not have", other.comment, other.name)),
    };
    ControlChoice { name: gcheck_controls::fallback().to_owned(), source: ControlSource::Default, because }
}

impl Chosen {
    /// Why the program is taken to be for it.
    pub(crate) fn basis(&self) -> ControlBasis {
        match self.choice.source {
            ControlSource::Option | ControlSource::Comment | ControlSource::Configuration => {
                ControlBasis::Chosen
            }
            ControlSource::Detected => ControlBasis::Shown,
            ControlSource::Guessed | ControlSource::Neighbours | ControlSource::Default => {
                ControlBasis::Guessed
            }
        }
    }

    /// Refuses a program that no control here reads, where nobody chose one: as a program of another control it would be
    /// executed, or written, as nobody meant it.
    pub(crate) fn refuse_unsupported(&self, path: &Path) -> Result<(), Problem> {
        match self.unsupported {
            Some(dialect) => Err(Problem::with_file(path, dialect.sentence()).help(
                "name a control to read it all the same: `--control NAME`, or `control = …` in `gcheck.toml`",
            )),
            None => Ok(()),
        }
    }

    /// Of a program whose control nobody chose, and whose dialect no control here reads, only the rule that says so is run.
    pub(crate) fn narrow(&self, selection: &mut Selection) {
        if self.unsupported.is_some() {
            selection.keep_only(UNSUPPORTED_DIALECT);
        }
    }
}

/// The rule that names a dialect that no control here reads.
const UNSUPPORTED_DIALECT: &str = "unsupported-dialect";

/// `(gcheck: control=NAME)` in the first lines: the name, and the comment as written.
fn named_in_comment(path: &Path, source: &SourceText) -> Result<Option<(String, String)>, Problem> {
    let text = source.text();
    let Some(found) = control_comment(text) else { return Ok(None) };
    let name = text.get(found.name.clone()).unwrap_or_default();
    validate_control(name).map_err(|message| Problem::at(&paths::shown(path), text, &found.name, message))?;
    let comment = text.get(found.comment).unwrap_or_default();
    Ok(Some((name.to_owned(), comment.to_owned())))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use gcheck_report::ControlSource;
    use gcheck_syntax::SourceText;

    use super::choose;
    use crate::neighbours::Neighbours;

    fn choice(
        text: &str,
        option: Option<&str>,
        configured: Option<&str>,
    ) -> (String, ControlSource, Option<String>) {
        let source = SourceText::from(text);
        let configured = configured.map(|name| (name, None));
        let choice =
            choose(Path::new("a.nc"), &source, option, configured, &Neighbours::default()).unwrap().choice;
        (choice.name, choice.source, choice.because)
    }

    #[test]
    fn the_option_wins_then_the_comment_then_the_configuration() {
        let text = "%\nO1 (A)\n(gcheck: control=linuxcnc)\n";
        assert_eq!(choice(text, Some("haas-mill"), Some("fanuc-mill")).1, ControlSource::Option);
        assert_eq!(
            choice(text, None, Some("fanuc-mill")),
            ("linuxcnc".to_owned(), ControlSource::Comment, Some("(gcheck: control=linuxcnc)".to_owned()))
        );
        assert_eq!(choice("G0\n", None, Some("fanuc-mill")).1, ControlSource::Configuration);
        assert_eq!(choice("G0\n", None, None).1, ControlSource::Default);
        assert_eq!(
            choice("; gcheck: control = linuxcnc\n", None, None).2.as_deref(),
            Some("; gcheck: control = linuxcnc")
        );
    }

    #[test]
    fn of_an_unsupported_dialect_one_rule_is_run() {
        let printed = "G92 E0\nG1 X1 E1.1\nG1 X2 E1.2\nG1 Y2 E1.3\n";
        let rules = |option, text| {
            let mut selection = gcheck_lint::Selection::recommended(gcheck_rules::RULES);
            let (path, source) = (Path::new("a.nc"), SourceText::from(text));
            choose(path, &source, option, None, &Neighbours::default()).unwrap().narrow(&mut selection);
            selection.rules().map(|(rule, _)| rule.meta.id).collect::<Vec<_>>()
        };
        assert_eq!(rules(None, printed), ["unsupported-dialect"]);
        assert!(rules(Some("linuxcnc"), printed).len() > 100);
        assert!(rules(None, "G0 X1.\n").len() > 100);
    }

    #[test]
    fn an_unclear_program_is_for_the_control_of_its_neighbours() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        let of = |name: &str, neighbours: &Neighbours| {
            let path = folder.path().join(name);
            let source = SourceText::from(std::fs::read_to_string(&path).unwrap().as_str());
            let choice = choose(&path, &source, None, None, neighbours).unwrap().choice;
            (choice.name, choice.source, choice.because.unwrap_or_default())
        };
        write("clear.nc", "G0 X1. Y1.\nM30\n");
        write("other.nc", "#<depth> = 1\nM2\n");
        for name in ["a.nc", "b.nc", "c.nc"] {
            write(name, "(VF-2)\nG0 X1.\nM30\n");
        }
        let neighbours = Neighbours::default();
        assert_eq!(of("clear.nc", &neighbours).1, ControlSource::Default, "one beside it shows another");
        std::fs::remove_file(folder.path().join("other.nc")).unwrap();
        let neighbours = Neighbours::default();
        assert_eq!(
            of("clear.nc", &neighbours),
            ("haas-mill".to_owned(), ControlSource::Neighbours, "3 of 3 show it".to_owned())
        );
        write("fanuc.nc", "(FANUC 31I)\nG0 X1.\nM30\n");
        let fanuc = of("fanuc.nc", &neighbours);
        assert_eq!((fanuc.0.as_str(), fanuc.1), ("fanuc-mill", ControlSource::Guessed), "it says so itself");
        write("named.nc", "(MAZAK VTC)\nG0 X1.\n");
        assert_eq!(
            of("clear.nc", &Neighbours::default()).1,
            ControlSource::Default,
            "one is for another builder's"
        );
        write("printed.nc", "G92 E0\nG1 X1 E1.1\nG1 X2 E1.2\nG1 Y2 E1.3\n");
        write("named.nc", "(MAZAK VTC)\nG0 X1.\n");
        let printed = of("printed.nc", &neighbours);
        assert_eq!(
            (printed.1, printed.2.as_str()),
            (ControlSource::Default, "the file is for a 3-D printer")
        );
        let named = of("named.nc", &neighbours);
        assert_eq!(named.2, "(MAZAK VTC) names a Mazak control, which gcheck does not have");
    }

    #[test]
    fn an_unknown_name_in_a_comment_is_refused_at_its_place() {
        let source = SourceText::from("%\n(gcheck: control=linuxcn)\n");
        let chosen = choose(Path::new("a.nc"), &source, None, None, &Neighbours::default());
        let problem = chosen.err().unwrap().to_string();
        assert!(
            problem.starts_with("a.nc:2:18: no control is called `linuxcn`; did you mean `linuxcnc`?"),
            "{problem}"
        );
    }
}
