//! Which control a program is read for: the one that is chosen on the page, else the one that a comment names, else the one
//! that the program speaks for, else the usual one.
//!
//! Knows: this order. Must not know: any control.

use std::sync::Arc;

use gcheck_controls::Control;
use gcheck_db::Settings;
use gcheck_lint::{ControlBasis, Selection};
use gcheck_program::{collect_evidence, control_comment};

use crate::answers::{Choice, Refused, Source};

/// The rule that names a dialect that no control here reads.
const UNSUPPORTED_DIALECT: &str = "unsupported-dialect";

/// A control and why it is the one.
pub(crate) fn choose(text: &str, chosen: &str) -> Result<(Choice, Arc<Control>), Refused> {
    let found = if chosen.is_empty() { in_text(text) } else { Found::new(chosen, Source::Chosen, None) };
    let control = gcheck_controls::load(&found.name).map_err(|error| Refused(error.to_string()))?;
    let title = control.title().to_owned();
    let Found { name, source, because } = found;
    Ok((Choice { name, title, source, because }, control))
}

struct Found {
    name: String,
    source: Source,
    because: Option<String>,
}

impl Found {
    fn new(name: &str, source: Source, because: Option<String>) -> Self {
        Self { name: name.to_owned(), source, because }
    }
}

/// The control that a program shows by itself.
fn in_text(text: &str) -> Found {
    if let Some(comment) = control_comment(text) {
        let name = text.get(comment.name).unwrap_or_default();
        // Loading it refuses a name that is not a control.
        return Found::new(name, Source::Comment, text.get(comment.comment).map(str::to_owned));
    }
    match gcheck_controls::guess(&collect_evidence(text)) {
        Some(guess) => {
            let because = match guess.rival {
                Some(rival) => format!("{}; {rival} fits nearly as well", guess.because),
                None => guess.because,
            };
            let source = if guess.is_clear { Source::Shown } else { Source::Guessed };
            Found::new(&guess.control, source, Some(because))
        }
        None => Found::new(gcheck_controls::fallback(), Source::Usual, None),
    }
}

/// What is in force for a program: a control, its recommended rules, and no machine that is known.
pub(crate) fn settings(text: &str, choice: &Choice, control: Arc<Control>) -> Settings {
    let mut settings = Settings::new(control, gcheck_rules::RULES);
    settings.control_basis = match choice.source {
        Source::Chosen | Source::Comment => ControlBasis::Chosen,
        Source::Shown => ControlBasis::Shown,
        Source::Guessed | Source::Usual => ControlBasis::Guessed,
    };
    if settings.control_basis != ControlBasis::Chosen {
        settings.unsupported = gcheck_controls::unsupported_dialect(text, None);
    }
    if settings.unsupported.is_some() {
        let mut selection = Selection::recommended(gcheck_rules::RULES);
        selection.keep_only(UNSUPPORTED_DIALECT);
        settings.selection = Arc::new(selection);
    }
    settings
}
