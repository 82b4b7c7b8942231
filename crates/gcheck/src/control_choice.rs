//! Which control runs a program: option, comment, configuration, detection, fallback, in this order.
//!
//! Knows: the order, and how a comment names a control. Must not know: any control.

use std::path::Path;

use gcheck_controls::{Evidence, Guess};
use gcheck_lint::Selection;
use gcheck_report::{ControlChoice, ControlSource};
use gcheck_syntax::SourceText;

use crate::config::validate_control;
use crate::{Problem, paths};

/// Lines in which a comment may name the control.
const HEAD_LINES: usize = 50;

/// Chooses the control of a program; `configured` is the configuration's, with the file that says so.
pub(crate) fn choose(
    path: &Path,
    source: &SourceText,
    option: Option<&str>,
    configured: Option<(&str, Option<&Path>)>,
) -> Result<ControlChoice, Problem> {
    let choice = |name: &str, source, because| ControlChoice { name: name.to_owned(), source, because };
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
    if let Some(guess) = detected(path, source.text()) {
        return Ok(choice(&guess.control, ControlSource::Detected, Some(guess.because)));
    }
    Ok(choice(gcheck_controls::fallback(), ControlSource::Default, None))
}

/// The control that a program and the end of its name speak for.
pub(crate) fn detected(path: &Path, text: &str) -> Option<Guess> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    gcheck_controls::guess(&Evidence { extension, ..gcheck_program::collect_evidence(text) })
}

/// Of a program whose control nobody chose, and whose dialect no control here reads, only the rule that says so is run.
pub(crate) fn narrow_for_dialect(selection: &mut Selection, source: ControlSource, head: &str) {
    let is_guessed = matches!(source, ControlSource::Detected | ControlSource::Default);
    if is_guessed && gcheck_controls::unsupported_dialect(head).is_some() {
        selection.keep_only(UNSUPPORTED_DIALECT);
    }
}

/// The rule that names a dialect that no control here reads.
const UNSUPPORTED_DIALECT: &str = "unsupported-dialect";

/// `(gcheck: control=NAME)` in the first lines: the name, and the comment as written.
fn named_in_comment(path: &Path, source: &SourceText) -> Result<Option<(String, String)>, Problem> {
    let text = source.text();
    let mut start = 0;
    for line in text.split_inclusive(['\n', '\r']).take(HEAD_LINES) {
        if let Some((before, directive)) = line.split_once("gcheck:") {
            let directive = directive.trim_start();
            let name = directive
                .strip_prefix("control")
                .map(str::trim_start)
                .and_then(|rest| rest.strip_prefix('='));
            if let Some(rest) = name.map(str::trim_start) {
                let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).unwrap_or(rest.len());
                let name = rest.get(..end).unwrap_or_default();
                let at = start + line.len() - rest.len();
                validate_control(name)
                    .map_err(|message| Problem::at(&paths::shown(path), text, &(at..at + end), message))?;
                let open = before.rfind(['(', ';']).unwrap_or(before.len());
                let comment = line.get(open..).unwrap_or_default();
                let comment = comment.split_inclusive(')').next().unwrap_or(comment).trim_end();
                return Ok(Some((name.to_owned(), comment.to_owned())));
            }
        }
        start += line.len();
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use gcheck_report::ControlSource;
    use gcheck_syntax::SourceText;

    use super::choose;

    fn choice(
        text: &str,
        option: Option<&str>,
        configured: Option<&str>,
    ) -> (String, ControlSource, Option<String>) {
        let source = SourceText::from(text);
        let choice = choose(Path::new("a.nc"), &source, option, configured.map(|name| (name, None))).unwrap();
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
        let rules = |source, text| {
            let mut selection = gcheck_lint::Selection::recommended(gcheck_rules::RULES);
            super::narrow_for_dialect(&mut selection, source, text);
            selection.rules().map(|(rule, _)| rule.meta.id).collect::<Vec<_>>()
        };
        for source in [ControlSource::Default, ControlSource::Detected] {
            assert_eq!(rules(source, printed), ["unsupported-dialect"]);
        }
        assert!(rules(ControlSource::Option, printed).len() > 100);
        assert!(rules(ControlSource::Default, "G0 X1.\n").len() > 100);
    }

    #[test]
    fn an_unknown_name_in_a_comment_is_refused_at_its_place() {
        let source = SourceText::from("%\n(gcheck: control=linuxcn)\n");
        let problem = choose(Path::new("a.nc"), &source, None, None).unwrap_err().to_string();
        assert!(
            problem.starts_with("a.nc:2:18: no control is called `linuxcn`; did you mean `linuxcnc`?"),
            "{problem}"
        );
    }
}
