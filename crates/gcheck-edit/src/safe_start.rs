//! Lines that say the modes of a program in front of its tool changes, so that an operator can start there.
//!
//! Knows: which modes a start needs, and which of them are in effect at each tool change of a run. Must not know: text beside
//! these lines.
//!
//! A line says what is in effect anyway: a mode that is off gets its code, and one that is on gets none. Only `G90` is in
//! every line.

use std::collections::BTreeMap;
use std::ops::Range;

use gcheck_controls::Effect;
use gcheck_engine::{At, Concrete, Event, Model, Role, State};
use gcheck_program::Place;

use crate::refusal::Refusal;
use crate::scope::Scope;
use crate::sheet::Sheet;

/// The modes of a line, in the order of the line.
const ROLES: [Role; 7] =
    [Role::Units, Role::Plane, Role::Distance, Role::FeedMode, Role::Compensation, Role::Length, Role::Cycle];
/// A block with as many codes of these modes is such a line already.
const ENOUGH: usize = 3;

/// The tool changes of a run. Has to see every block before it is executed, and every event.
pub(crate) struct Starts<'c> {
    scope: Scope,
    model: &'c Model<'c>,
    /// The block under way, with its codes.
    block: Option<(u32, Range<u32>, Vec<String>)>,
    found: BTreeMap<u32, Vec<String>>,
}

impl<'c> Starts<'c> {
    pub(crate) fn new(scope: &Scope, model: &'c Model<'c>) -> Self {
        Self { scope: scope.clone(), model, block: None, found: BTreeMap::new() }
    }

    pub(crate) fn before(&mut self, at: At, place: &Place, state: &State<Concrete>) {
        self.block = (at.file == 0).then(|| (at.block, place.range(), self.codes(state)));
    }

    /// The codes in effect that a start needs.
    fn codes(&self, state: &State<Concrete>) -> Vec<String> {
        let code = |role: Role| {
            let code = state.mode(role).only().filter(|code| code.is_some())?;
            let is_off = match role {
                Role::Compensation => self.model.effect(code) == Effect::CompensationOff,
                Role::Length => self.model.effect(code) == Effect::LengthOff,
                Role::Cycle => self.model.effect(code) == Effect::CycleCancel,
                _ => true,
            };
            let control = self.model.control();
            // An operator starts with absolute coordinates; whether the program does too, the proof tells.
            if self.model.effect(code) == Effect::Incremental {
                let absolute = control.codes().find(|code| code.effect() == Effect::Absolute)?;
                return Some(absolute.number().to_string());
            }
            is_off.then(|| control.code_at(code).map(|code| code.number().to_string()))?
        };
        ROLES.into_iter().filter_map(code).collect()
    }

    pub(crate) fn event(&mut self, event: &Event) -> Result<(), Refusal> {
        let Event::ToolChange(tool) = event else { return Ok(()) };
        let Some((block, range, codes)) = self.block.take() else { return Ok(()) };
        if !self.scope.selects(range.start, *tool) || codes.is_empty() {
            return Ok(());
        }
        if self.found.get(&block).is_some_and(|other| *other != codes) {
            return Err(Refusal::at(range, "this tool change runs more than once, under different modes"));
        }
        self.found.insert(block, codes);
        Ok(())
    }

    /// Writes the lines.
    pub(crate) fn write(
        &self,
        sheet: &mut Sheet<'_, '_>,
        number: u32,
        place: &Place,
        before: Option<&Place>,
    ) {
        let Some(codes) = self.found.get(&number) else { return };
        let says = |place: &Place| {
            let words = place.table.words(place.block()).iter();
            let roles = words.filter_map(|word| self.model.role(word.code));
            roles.filter(|role| ROLES.contains(role)).count() >= ENOUGH
        };
        if says(place) || before.is_some_and(says) {
            return;
        }
        let line = format!("{}{}", codes.join(sheet.hand.gap()), sheet.line_end());
        sheet.insert(place.range().start, line);
    }
}
