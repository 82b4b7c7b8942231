//! What a block does not say but means, beside it.
//!
//! Knows: which facts of the state are worth reading there. Must not know: how states come about.

use std::cell::OnceCell;
use std::ops::Range;

use gcheck_controls::{Effect, Letter};
use gcheck_db::{BlockPlace, Cancelled, Database, DocumentId, Snapshot, StateAt};
use gcheck_engine::{Abstract, AbstractValue, At, Axis, Look, Role, State};
use gcheck_program::{BlockFlags, OKeyword, StatementKind, ToolNames, Value, Word};

use crate::number_text::{coordinate, value};
use crate::sections::tool_names;
use crate::state_reader::StateReader;

/// Blocks of a range that are looked at: more than any window shows.
const MOST_BLOCKS: u32 = 2_000;
/// Bytes of a file that is searched for the names of its tools.
const LARGE: u32 = 4 << 20;

/// Which hints are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "independent switches, named one by one in the settings of editors"
)]
pub struct InlayOptions {
    /// The feed of a cutting move whose block has no `F`, at the first of the range and where it changes.
    pub feed: bool,
    /// The speed likewise.
    pub speed: bool,
    /// What a computed word or assignment comes to.
    pub values: bool,
    /// Where an incremental move ends.
    pub positions: bool,
    /// What a tool is called, beside its number.
    pub tools: bool,
}

impl Default for InlayOptions {
    /// All of them.
    fn default() -> Self {
        Self { feed: true, speed: true, values: true, positions: true, tools: true }
    }
}

/// A hint beside the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InlayHint {
    /// Byte of the file in front of which it is.
    pub offset: u32,
    /// Its text.
    pub label: String,
    /// Markdown; may be empty.
    pub tooltip: String,
    /// Which switch it belongs to.
    pub kind: InlayKind,
}

/// What a hint tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "as the switches")]
pub enum InlayKind {
    Feed,
    Speed,
    Value,
    Position,
    Tool,
}

/// Hints in a range, in text order.
///
/// # Errors
/// [`Cancelled`] when `stop` said yes.
pub fn inlay_hints(
    database: &mut Database,
    document: DocumentId,
    range: Range<u32>,
    options: InlayOptions,
    stop: &dyn Fn() -> bool,
) -> Result<Vec<InlayHint>, Cancelled> {
    let snapshot = database.indexed(document).ok_or(Cancelled)?;
    let Some(last) = snapshot.block_at(range.end) else { return Ok(Vec::new()) };
    let first = snapshot.block_at(range.start).map_or(0, |place| place.number);
    let blocks = first..(last.number + 1).min(first.saturating_add(MOST_BLOCKS));
    let names = OnceCell::new();
    let mut hints = Hints { snapshot: &snapshot, options, names, shown: [None, None], list: Vec::new() };
    database.look(document, blocks, stop, &mut |state, look| {
        if let Some(place) = snapshot.place(state.block) {
            hints.block(&place, state, look);
        }
    })?;
    let mut shown = hints.list;
    shown.retain(|hint| range.start <= hint.offset && hint.offset <= range.end);
    shown.sort_by_key(|hint| hint.offset);
    Ok(shown)
}

struct Hints<'s> {
    snapshot: &'s Snapshot,
    options: InlayOptions,
    /// Asked for by a block that names a tool and no more.
    names: OnceCell<ToolNames<'s>>,
    /// Feed and speed as they were read last.
    shown: [Option<String>; 2],
    list: Vec<InlayHint>,
}

impl Hints<'_> {
    fn block(&mut self, place: &BlockPlace, state: &StateAt, look: &mut Look<'_, '_>) {
        let block = place.block();
        let words = place.table.words(block);
        if self.options.values && block.flags.intersects(BlockFlags::EXPRESSION | BlockFlags::STATEMENT) {
            self.values(place, state, look);
        }
        if self.options.tools && block.letters.contains(Letter::of('T')) {
            self.tool(place, words);
        }
        let Some(after) = &state.after else { return };
        let reader = StateReader::new(self.snapshot, look.model());
        if self.options.positions {
            self.position(place, &state.before, after, &reader);
        }
        self.modal(place, after, &reader);
    }

    fn add(&mut self, offset: u32, label: String, tooltip: &str, kind: InlayKind) {
        self.list.push(InlayHint { offset, label, tooltip: tooltip.to_owned(), kind });
    }

    /// Feed and speed that hold though the block does not say them.
    fn modal(&mut self, place: &BlockPlace, after: &State<Abstract>, reader: &StateReader<'_>) {
        let block = place.block();
        let (has_feed, has_speed) =
            (block.letters.contains(Letter::of('F')), block.letters.contains(Letter::of('S')));
        let [feed, speed] = &mut self.shown;
        if has_feed {
            *feed = reader.feed(after);
        }
        if has_speed {
            *speed = reader.speed(after);
        }
        if !block.letters.intersects(reader.model.control().axes()) || !cuts(after, reader) {
            return;
        }
        let mut new = Vec::new();
        for (slot, now, has, is_on, kind) in [
            (feed, reader.feed(after), has_feed, self.options.feed, InlayKind::Feed),
            (speed, reader.speed(after), has_speed, self.options.speed, InlayKind::Speed),
        ] {
            let changed = now.is_some() && *slot != now && !has;
            slot.clone_from(&now);
            if let Some(now) = now.filter(|_| changed && is_on) {
                new.push((now, kind));
            }
        }
        for (label, kind) in new {
            self.add(place.range().end, label, "in effect here", kind);
        }
    }

    /// What computed words and assignments come to.
    fn values(&mut self, place: &BlockPlace, state: &StateAt, look: &mut Look<'_, '_>) {
        let table = &place.table;
        let mut wanted: Vec<Range<u32>> = Vec::new();
        let mut assignments = 0;
        for statement in table.statements(place.ix) {
            if let StatementKind::Assign { value: Some(value), .. } = &statement.kind {
                assignments += 1;
                // What is after an assignment may rest on it.
                if assignments == 1 && table.constant(*value).is_none() {
                    wanted.push(place.in_file(table.expr(*value).range.clone()));
                }
            }
            let calls = |keyword: &OKeyword| *keyword == OKeyword::Call;
            if let StatementKind::OWord { keyword, arguments, .. } = &statement.kind
                && calls(keyword)
            {
                let all = StatementKind::arguments(arguments).filter(|ix| table.constant(*ix).is_none());
                wanted.extend(all.map(|ix| place.in_file(table.expr(ix).range.clone())));
            }
        }
        if assignments == 0 {
            let computed = table.words(place.block()).iter().filter_map(|word| match word.value {
                Value::Expr(ix) if table.constant(ix).is_none() => Some(ix),
                _ => None,
            });
            wanted.extend(computed.map(|ix| place.in_file(table.expr(ix).range.clone())));
        }
        if wanted.is_empty() {
            return;
        }
        let at = At { file: 0, block: place.number };
        for (range, held) in look.expressions(at, &state.before) {
            let says_something = matches!(
                held,
                AbstractValue::Number(_) | AbstractValue::Set(_) | AbstractValue::Interval { .. }
            ) && held != AbstractValue::any_number();
            if says_something && wanted.contains(&range) {
                self.add(range.end, format!("= {}", value(&held)), "", InlayKind::Value);
            }
        }
    }

    /// Where an incremental move ends.
    fn position(
        &mut self,
        place: &BlockPlace,
        before: &State<Abstract>,
        after: &State<Abstract>,
        reader: &StateReader<'_>,
    ) {
        let letters = place.block().letters;
        let increments = &reader.model.semantics().increments;
        let is_incremental = after.is_incremental(reader.model) == Some(true);
        let moved = |axis: &Axis| {
            let by_increment = increments.iter().any(|(letter, of)| {
                *of == axis.name().to_string()
                    && Letter::parse(letter).is_some_and(|letter| letters.contains(letter))
            });
            by_increment || is_incremental && letters.contains(axis.letter())
        };
        let (units, diameter) = (reader.units(after), reader.diameter(after));
        let has_moved =
            |axis: &Axis| before.position().raw(*axis).to_bits() != after.position().raw(*axis).to_bits();
        let axes: Vec<String> = reader
            .axes()
            .into_iter()
            .filter(moved)
            .filter(has_moved)
            .filter_map(|axis| {
                let at = after.position().get(axis)?;
                Some(format!("{}{}", axis.name(), coordinate(axis, at, units, diameter)))
            })
            .collect();
        if !axes.is_empty() {
            self.add(
                place.range().end,
                format!("→ {}", axes.join(" ")),
                "where the move ends",
                InlayKind::Position,
            );
        }
    }

    /// What the tool is called, where the block does not say it itself.
    fn tool(&mut self, place: &BlockPlace, words: &[Word]) {
        if place.block().flags.contains(BlockFlags::COMMENT) || self.snapshot.len() > LARGE {
            return;
        }
        let control = self.snapshot.control();
        let is_call = |word: &Word| control.code_at(word.code).is_some_and(|code| code.entry().any_words);
        if words.iter().any(is_call) {
            return;
        }
        let Some(word) = words.iter().find(|word| word.letter == Letter::of('T')) else { return };
        let number = word.integer();
        let number = number.map(|tool| if control.semantics().tools.offset_in_t { tool / 100 } else { tool });
        let Some(number) = number else { return };
        let names = self.names.get_or_init(|| tool_names(self.snapshot));
        if let Some(name) = names.get(number) {
            let (offset, name) = (place.in_file(word.range()).end, name.to_owned());
            self.add(offset, name, "what the program calls this tool", InlayKind::Tool);
        }
    }
}

/// Does the mode in effect cut?
fn cuts(state: &State<Abstract>, reader: &StateReader<'_>) -> bool {
    let is_cut = |effect: Effect| {
        matches!(
            effect,
            Effect::Linear
                | Effect::ArcClockwise
                | Effect::ArcCounterClockwise
                | Effect::SplineCubic
                | Effect::SplineQuadratic
                | Effect::Thread
                | Effect::TurningPass
                | Effect::FacingPass
                | Effect::ThreadingPass
        )
    };
    let cycle = state.active_cycle(reader.model).is_some_and(gcheck_controls::CodeIx::is_some);
    cycle || state.effect(Role::Motion, reader.model).is_some_and(is_cut)
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::{InlayOptions, inlay_hints};
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, expected: &Expect) {
        let mut fixture = Fixture::new(control, text);
        let end = fixture.snapshot().len();
        let hints =
            inlay_hints(&mut fixture.database, fixture.document, 0..end, InlayOptions::default(), &|| false)
                .unwrap();
        let mut shown = fixture.snapshot().text();
        for hint in hints.iter().rev() {
            shown.insert_str(hint.offset as usize, &format!("«{}»", hint.label));
        }
        expected.assert_eq(&shown);
    }

    #[test]
    fn modal_feed_and_speed() {
        check(
            "haas-mill",
            "O1\nG21 G90 S500 M3\nG0 X0.\nG1 X1. F100.\nX2.\nX3. F200.\nS800\nX4.\nM30\n",
            &expect![[r#"
            O1
            G21 G90 S500 M3
            G0 X0.
            G1 X1. F100.
            X2.
            X3. F200.
            S800
            X4.
            M30
        "#]],
        );
    }

    #[test]
    fn only_the_visible_part() {
        let text = "O1\nG21 G90 S500 M3\nG0 X0.\nG1 X1. F100.\nX2.\nX3.\nM30\n";
        let mut fixture = Fixture::new("haas-mill", text);
        let from = text.find("X2.").unwrap() as u32;
        let options = InlayOptions { speed: false, ..InlayOptions::default() };
        let hints =
            inlay_hints(&mut fixture.database, fixture.document, from..from + 8, options, &|| false).unwrap();
        let labels: Vec<_> = hints.iter().map(|hint| (hint.offset, hint.label.as_str())).collect();
        assert_eq!(labels, [(from + 3, "F100 mm/min")]);
    }

    #[test]
    fn values_of_what_is_computed() {
        check(
            "haas-mill",
            "O1\n#100=2.\n#101=#100*3.\nG90 G0 X#101 Y[#101+1.]\nIF [#500 EQ 1] GOTO 9\n#100=5.\nN9 Z#100\nM30\n",
            &expect![[r#"
            O1
            #100=2.
            #101=#100*3.«= 6»
            G90 G0 X#101«= 6» Y[#101+1.]«= 7»
            IF [#500 EQ 1] GOTO 9
            #100=5.
            N9 Z#100«= 2 or 5»
            M30
        "#]],
        );
        check(
            "linuxcnc",
            "#<d> = [2 * 3]\no<a> call [#<d> + 1]\nM2\n",
            &expect![[r#"
            #<d> = [2 * 3]«= 6»
            o<a> call [#<d> + 1]«= 7»
            M2
        "#]],
        );
    }

    #[test]
    fn ends_of_incremental_moves() {
        check(
            "haas-mill",
            "O1\nG21 G90 G0 X10. Y5.\nG91 X2.\nY-1. X1.\nM30\n",
            &expect![[r#"
            O1
            G21 G90 G0 X10. Y5.
            G91 X2.«→ X12»
            Y-1. X1.«→ X13 Y4»
            M30
        "#]],
        );
        check(
            "haas-lathe",
            "O1\nG20 G0 X2. Z.1\nU-.5 W.2\nM30\n",
            &expect![[r#"
            O1
            G20 G0 X2. Z.1
            U-.5 W.2«→ X1.5 Z0.3»
            M30
        "#]],
        );
    }

    #[test]
    fn names_of_tools() {
        check(
            "haas-mill",
            "O1\n(T1 DRILL)\n(T2 TAP)\nT1 M6\nT2\nG65 P9010 T2\nM30\n",
            &expect![[r#"
            O1
            (T1 DRILL)
            (T2 TAP)
            T1«DRILL» M6
            T2«TAP»
            G65 P9010 T2
            M30
        "#]],
        );
    }

    #[test]
    fn a_few_lines_cost_their_surroundings_not_the_file() {
        let section = |tool: usize| {
            format!("T{tool} M6 (TOOL)\nG90 G0 X0. Y0.\n{}T0\n", "G91 X1.5 Y2.25\n".repeat(300))
        };
        let text: String = (1..200).map(section).collect();
        let mut fixture = Fixture::new("haas-mill", &text);
        fixture.analysis();
        let from = text.find("T100 ").unwrap() as u32 + 20;
        // Typed: what is known of the rest stays so.
        fixture.database.edit(fixture.document, from..from, "\n").unwrap();
        let snapshot = fixture.database.indexed(fixture.document).unwrap();
        let hints = inlay_hints(
            &mut fixture.database,
            fixture.document,
            from..from + 1_000,
            InlayOptions::default(),
            &|| false,
        )
        .unwrap();
        assert!(hints.len() > 30, "{hints:?}");
        assert!(snapshot.tables_read() < 5, "{} of {}", snapshot.tables_read(), snapshot.chunks().len());
    }
}
