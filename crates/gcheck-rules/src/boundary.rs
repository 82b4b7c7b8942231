//! Where something left on hurts: at a tool change, at the end of the program, and where a file may be called by another.
//!
//! Knows: which blocks are such places, which modes an end of the program resets, which facts come from a caller. Must not
//! know: any rule.

use std::ops::Range;

use gcheck_controls::{Code, CodeIx, CodeNumber, Effect, Ends, Letter, Machine};
use gcheck_engine::{Abstract, At, Domain, Ending, Fact, Role, State};
use gcheck_program::OKeyword;

use crate::{Finding, PathCx, RuleMeta};

/// A place at which the work of a tool, or of the program, is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Boundary {
    /// The tool is changed.
    ToolChange,
    /// The program ends.
    ProgramEnd,
}

impl Boundary {
    /// As findings name it: "at the tool change".
    pub(crate) const fn words(self) -> &'static str {
        match self {
            Self::ToolChange => "at the tool change",
            Self::ProgramEnd => "at the end of the program",
        }
    }
}

/// A mode that some block before this one left on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LeftOn {
    /// On every path that comes here.
    Surely(CodeIx),
    /// On some path that comes here.
    Maybe(CodeIx),
}

impl PathCx<'_> {
    /// What ends with this block.
    pub(crate) fn boundary(&self) -> Option<Boundary> {
        if self.has_effect(|effect| matches!(effect, Effect::ProgramEnd | Effect::ProgramEndWithPallet)) {
            return Some(Boundary::ProgramEnd);
        }
        self.changes_tool().then_some(Boundary::ToolChange)
    }

    /// Does the block put another tool in place?
    pub(crate) fn changes_tool(&self) -> bool {
        let rules = self.model.semantics().tools;
        if !rules.change_by_t {
            return self.has_effect(|effect| effect == Effect::ToolChange);
        }
        if !self.origin().letters.contains(Letter::of('T')) {
            return false;
        }
        let Some(place) = self.place() else { return false };
        let words = place.table.words(place.block());
        let Some(word) = words.iter().find(|word| word.letter == Letter::of('T')) else { return false };
        // A computed tool may be the same one.
        let Some(number) = word.integer() else { return false };
        let tool = if rules.offset_in_t && number >= 100 { number / 100 } else { number };
        // `T0` takes offsets away; the tool at work called again only changes its offsets.
        tool != 0 && Abstract::known(self.state().tool()) != Some(f64::from(tool))
    }

    /// Bytes of the word that ends it.
    pub(crate) fn boundary_range(&self, place: Boundary) -> Range<u32> {
        let by_t = self.model.semantics().tools.change_by_t;
        self.word_range(|word| {
            let effect = self.model.effect(word.code);
            match place {
                Boundary::ToolChange => {
                    effect == Effect::ToolChange || by_t && word.letter == Letter::of('T')
                }
                Boundary::ProgramEnd => matches!(effect, Effect::ProgramEnd | Effect::ProgramEndWithPallet),
            }
        })
    }

    /// A tape mark that ends the program as `M2` does.
    pub(crate) fn ends_at_tape_mark(&self, ending: Ending) -> bool {
        ending == Ending::Tape && self.scene.control().syntax().tape_marks_end
    }

    /// A mode that is on before this block, which itself says nothing of it.
    pub(crate) fn left_on(&self, role: Role, is_on: impl Fn(Effect) -> bool) -> Option<LeftOn> {
        if self.code_of_role(role).is_some() { None } else { self.on_before(role, is_on) }
    }

    /// The code of the block that sets the mode of a role; the last one, as controls take it.
    pub(crate) fn code_of_role(&self, role: Role) -> Option<CodeIx> {
        self.codes().iter().copied().rfind(|code| self.model.role(*code) == Some(role))
    }

    /// A mode that is on before this block, whatever the block says.
    pub(crate) fn on_before(&self, role: Role, is_on: impl Fn(Effect) -> bool) -> Option<LeftOn> {
        let mode = self.state().mode(role);
        let on = |code: &CodeIx| code.is_some() && is_on(self.model.effect(*code));
        match mode.only() {
            Some(code) => on(&code).then_some(LeftOn::Surely(code)),
            None => mode.alternatives().iter().copied().find(on).map(LeftOn::Maybe),
        }
    }

    /// A finding about a mode that the program leaves on for the next one, where its end does not reset it.
    pub(crate) fn left_at_end(
        &self,
        rule: &'static RuleMeta,
        of: Role,
        is_on: impl Fn(Effect) -> bool,
        what: &str,
    ) -> Option<Finding> {
        if self.end_resets(of) {
            return None;
        }
        let Some(LeftOn::Surely(code)) = self.left_on(of, is_on) else { return None };
        let fact = Fact::Mode(of);
        // As it was at the start: the program neither switched it on nor can be blamed.
        self.trace().set_by(fact)?;
        let name = self.name_of(code);
        let place = Boundary::ProgramEnd;
        let message = format!("{what} is still on {} (`{name}`)", place.words());
        let finding = self.finding(rule, self.boundary_range(place), message);
        let finding = finding.label("what runs next begins with it");
        Some(self.resting_on(finding, fact, &format!("`{name}`")))
    }

    /// Does the end of the program bring a mode back to the control's start?
    pub(crate) fn end_resets(&self, role: Role) -> bool {
        self.at_end().any(|code| Role::of(code.effect()) == Some(role))
    }

    /// Codes that the end of the program brings into effect.
    pub(crate) fn at_end(&self) -> impl Iterator<Item = Code<'_>> {
        let control = self.scene.control();
        let names = &self.model.semantics().at_end;
        names.iter().filter_map(|name| control.code_at(control.code_ix(CodeNumber::parse(name)?)))
    }

    /// The file holds what others call, and no main program: what its caller set is not known.
    pub(crate) fn is_called_only(&self) -> bool {
        let survey = self.survey;
        let has_end = |ends: Ends| survey.ends.iter().any(|end| end.ends == ends);
        let is_library = survey.o_words.first().is_some_and(|o| o.keyword == OKeyword::Sub);
        // A bar job starts again by the code that returns elsewhere.
        if self.file_uses(|effect| effect == Effect::BarFeed) {
            return false;
        }
        !has_end(Ends::Program) && (has_end(Ends::Subprogram) || is_library)
    }

    /// Does the file use a code with an effect that `is` says yes to, on some path or none?
    pub(crate) fn file_uses(&self, is: impl Fn(Effect) -> bool) -> bool {
        let control = self.scene.control();
        let mut codes =
            self.survey.codes.iter().filter_map(|(number, _)| control.code_at(control.code_ix(*number)));
        codes.any(|code| is(code.effect()))
    }

    /// Does the control have a code with an effect that `is` says yes to?
    pub(crate) fn control_has(&self, is: impl Fn(Effect) -> bool) -> bool {
        self.scene.control().codes().any(|code| is(code.effect()))
    }

    /// A program was called that is not at hand: it may have changed anything.
    pub(crate) fn is_behind_unknown_program(&self) -> bool {
        is_unknown(self.state())
    }

    /// The code as programs write it.
    pub(crate) fn name_of(&self, code: CodeIx) -> String {
        self.scene.control().code_at(code).map(|code| code.number().to_string()).unwrap_or_default()
    }

    /// The code of a role that cancels it, as programs write it.
    pub(crate) fn cancel_of(&self, effect: Effect) -> Option<String> {
        let code = self.scene.control().codes().find(|code| code.effect() == effect)?;
        Some(code.number().to_string())
    }

    /// A mill, not a lathe.
    pub(crate) fn is_mill(&self) -> bool {
        self.scene.control().machine() == Machine::Mill
    }

    /// Marks where the tool at work was changed in.
    pub(crate) fn with_tool_change(&self, finding: Finding) -> Finding {
        match self.trace().set_by(Fact::Tool).and_then(|at| self.range_of(at)) {
            Some(range) => finding.also(range, "the tool comes here"),
            None => finding,
        }
    }

    /// How deep in calls the block stands: 1 for the main program.
    pub(crate) fn depth(&self) -> usize {
        self.state().frames().len()
    }
}

/// Modes that hardly any program switches are known to be what the control starts with, unless a program was called of which
/// nothing is known.
fn is_unknown(state: &State<Abstract>) -> bool {
    let is_any = |role: Role| {
        let mode = state.mode(role);
        mode.only().is_none() && mode.alternatives().is_empty()
    };
    is_any(Role::Polar) && is_any(Role::Cylinder)
}

/// Text order of two blocks of one file.
pub(crate) fn is_before(first: At, second: At) -> bool {
    first.file == second.file && first.block < second.block
}
