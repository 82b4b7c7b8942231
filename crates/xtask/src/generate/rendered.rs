//! The first finding of an example, as `gcheck check` prints it.
//!
//! Knows: how an example is checked. Must not know: any rule, how a page looks.

use gcheck_controls::unsupported_dialect;
use gcheck_diagnostics::DocExample;
use gcheck_lint::{
    ControlBasis, Environment, Execution, Job, MachineFacts, NoPrograms, RuleEntry, Selection, check,
};
use gcheck_program::Dialect;
use gcheck_report::{Colour, ControlChoice, ControlSource, FileReport, Format, Report};
use gcheck_rules::RULES;
use gcheck_syntax::SourceText;

/// What the name of the example's file is.
const NAME: &str = "part.nc";

/// A finding, and what it says to do.
#[derive(Debug, Clone, Default)]
pub(super) struct Rendered {
    /// As `gcheck check` prints it.
    pub(super) text: String,
    /// Its help, then what its fixes do.
    pub(super) remedies: Vec<String>,
}

/// The rule's first finding in the example; `None` where there is none, as in a rule that needs more than one file.
pub(super) fn finding(rule: &RuleEntry, example: &DocExample) -> Option<Rendered> {
    let control = gcheck_controls::load(&example.control).ok()?;
    let dialect = Dialect::new(&control);
    let machine = MachineFacts::default();
    // A rule about suppressions needs other rules that are silenced.
    let is_of_suppressions = rule.meta.group == "suppressions";
    let selection =
        if is_of_suppressions { Selection::recommended(RULES) } else { Selection::only(RULES, rule) };
    let source = SourceText::from(example.code.as_str());
    let environment = Environment {
        dialect: &dialect,
        machine: &machine,
        programs: &NoPrograms,
        control_basis: if example.guessed { ControlBasis::Shown } else { ControlBasis::Chosen },
        unsupported: example.guessed.then(|| unsupported_dialect(&example.code, None)).flatten(),
    };
    let execution = Execution::default();
    let job = Job { source: &source, environment, selection: &selection, suppressions: true, execution };
    let found = check(&job).findings.into_iter().find(|found| std::ptr::eq(found.rule, rule.meta))?;
    let fixes = found.fixes.iter().map(|fix| fix.title.clone());
    let remedies = found.help.iter().cloned().chain(fixes).collect();
    let choice =
        ControlChoice { name: example.control.clone(), source: ControlSource::Option, because: None };
    let report = Report::new(vec![FileReport::new(NAME.to_owned(), source, choice, vec![found])]);
    let mut out = Vec::new();
    gcheck_report::write(&report, Format::Full, Colour::Plain, &mut out).ok()?;
    Some(Rendered { text: String::from_utf8_lossy(&out).trim_end().to_owned(), remedies })
}
