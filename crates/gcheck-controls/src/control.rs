//! A control with everything it inherits, ready for look-up.
//!
//! Knows: codes by number, groups, addresses, variables, settings. Must not know: files, TOML, or which control it is.

use std::any::Any;
use std::fmt;
use std::panic::{RefUnwindSafe, UnwindSafe};
use std::sync::OnceLock;

use crate::execution::{Effect, LastingWords, Semantics};
use crate::motion::MotionRules;
use crate::schema::{
    Access, AlarmEntry, BlockRules, CodeEntry, CodeList, Confidence, FormatCustoms, FunctionEntry, Hint,
    LetterEntry, Limits, Machine, ModalGroup, Motion, NumberRules, Reference, SettingEntry, SyntaxRules,
    SystemCommands, VariableEntry, VariableKind,
};
use crate::{CodeNumber, Letter, LetterSet};

/// Index of a code in its control; small, so that a word of a program can carry it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CodeIx(u16);

impl CodeIx {
    /// "No such code": what a word holds whose code the control does not have.
    pub const NONE: Self = Self(u16::MAX);

    /// A number usable as an index into tables made from [`Control::codes`]; out of range for [`CodeIx::NONE`].
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// False for [`CodeIx::NONE`].
    pub fn is_some(self) -> bool {
        self != Self::NONE
    }
}

/// Index of a modal group in its control.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GroupIx(u8);

impl GroupIx {
    /// A small number usable as an index or a bit.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

/// One control: the resolved knowledge of a `data/` folder and its bases.
#[derive(Debug, Clone)]
pub struct Control {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) machine: Machine,
    pub(crate) syntax: SyntaxRules,
    pub(crate) numbers: NumberRules,
    pub(crate) limits: Limits,
    pub(crate) code_list: CodeList,
    pub(crate) block: BlockRules,
    pub(crate) format: FormatCustoms,
    pub(crate) phases: Vec<String>,
    pub(crate) axes: LetterSet,
    pub(crate) hints: Vec<Hint>,
    pub(crate) references: Vec<Reference>,
    pub(crate) groups: Vec<ModalGroup>,
    pub(crate) codes: Vec<CodeFacts>,
    pub(crate) by_number: [Vec<CodeIx>; 2],
    pub(crate) letters: Vec<Option<LetterEntry>>,
    pub(crate) variables: Vec<VariableEntry>,
    /// First numbers of stretches of variables, rising, with the entry of `variables` that holds for the stretch.
    pub(crate) numbered: Vec<(u32, Option<usize>)>,
    pub(crate) functions: Vec<FunctionEntry>,
    pub(crate) settings: Vec<SettingEntry>,
    pub(crate) alarms: Vec<AlarmOfRule>,
    pub(crate) commands: Option<SystemCommands>,
    pub(crate) semantics: Semantics,
    pub(crate) motion: MotionRules,
    pub(crate) lasting: Vec<LastingWords>,
    pub(crate) prepared: PreparedSlot,
}

/// What another crate made of a control; a copy, which may be changed, has none.
#[derive(Default)]
pub(crate) struct PreparedSlot(OnceLock<Box<dyn AnyPrepared>>);

/// What another crate may make of a control.
pub trait AnyPrepared: Any + Send + Sync + UnwindSafe + RefUnwindSafe {}

impl<T: Any + Send + Sync + UnwindSafe + RefUnwindSafe> AnyPrepared for T {}

impl Clone for PreparedSlot {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl fmt::Debug for PreparedSlot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("PreparedSlot").field(&self.0.get().is_some()).finish()
    }
}

/// The alarm for what a rule finds: of some codes and addresses, or of all others.
#[derive(Debug, Clone)]
pub(crate) struct AlarmOfRule {
    pub(crate) rule: String,
    pub(crate) of: Vec<String>,
    pub(crate) entry: AlarmEntry,
}

impl AlarmOfRule {
    /// Is the row for this code or address by name?
    fn names(&self, thing: &str) -> bool {
        self.of.iter().any(|item| match item.strip_suffix(".*") {
            Some(whole) => thing.split_once('.').is_some_and(|(before, _)| before == whole),
            None => item == thing,
        })
    }
}

/// A code and what is derived from its entry once, at load time.
#[derive(Debug, Clone)]
pub(crate) struct CodeFacts {
    pub(crate) entry: CodeEntry,
    pub(crate) number: CodeNumber,
    pub(crate) group: GroupIx,
    pub(crate) reads: LetterSet,
    pub(crate) effect: Effect,
    pub(crate) alias: Option<String>,
    pub(crate) user: bool,
}

/// A code that the user's configuration declares: a shop's M code or an alias of a macro.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct UserCode {
    /// The code.
    pub number: CodeNumber,
    /// Title for hover and listings.
    pub title: String,
    /// The program an alias calls, `O9010`.
    pub alias: Option<String>,
}

/// A code seen through its control.
#[derive(Debug, Clone, Copy)]
pub struct Code<'c> {
    control: &'c Control,
    facts: &'c CodeFacts,
}

/// What the blocks after a code are; see [`Code::data_opening`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DataOpening {
    /// Commands.
    Never,
    /// Lines of data if a code comes that ends them, before any other code.
    IfEnded,
    /// Lines of data.
    Certain,
}

impl<'c> Code<'c> {
    /// The entry as written in data.
    pub fn entry(self) -> &'c CodeEntry {
        &self.facts.entry
    }

    /// May the blocks after one with this code be lines of data? `value` is that of an address in the block: `None` without a
    /// word, `Some(None)` where the number is computed.
    pub fn data_opening(self, value: impl FnOnce(Letter) -> Option<Option<f64>>) -> DataOpening {
        let Some(opens) = &self.facts.entry.opens_data else { return DataOpening::Never };
        match Letter::parse(&opens.letter).and_then(value) {
            None => DataOpening::Never,
            Some(Some(number)) if opens.values.contains(&number) => DataOpening::Certain,
            Some(Some(number)) if opens.in_one_block.contains(&number) => DataOpening::Never,
            Some(_) => DataOpening::IfEnded,
        }
    }

    /// Does this code end lines of data that another one opened?
    pub fn ends_data_of(self, opener: Self) -> bool {
        opener.facts.entry.opens_data.is_some()
            && opener.facts.entry.cancelled_by.contains(&self.facts.entry.code)
    }

    /// The code's number.
    pub fn number(self) -> CodeNumber {
        self.facts.number
    }

    /// The modal group.
    pub fn group(self) -> &'c ModalGroup {
        self.control.group(self.facts.group)
    }

    /// The modal group's index.
    pub fn group_ix(self) -> GroupIx {
        self.facts.group
    }

    /// Addresses that the code reads.
    pub fn reads(self) -> LetterSet {
        self.facts.reads
    }

    /// Addresses that some sources of the code list and others do not.
    pub fn disputed(self) -> LetterSet {
        self.entry().disputed.iter().filter_map(|row| Letter::parse(&row.letter)).collect()
    }

    /// Addresses of which one is enough where `missing` is missing and `present` are in the block: itself, and those that the
    /// data list as its alternatives. Where one of these is in the block already, none takes the place of `missing`.
    pub fn would_do_for(self, missing: Letter, present: LetterSet) -> LetterSet {
        let own = LetterSet::from_iter([missing]);
        let entry = self.entry();
        let lists = entry.one_of.iter().chain(&entry.not_together);
        let lists = lists.map(|items| items.iter().map(|item| LetterSet::of_item(item)).collect::<Vec<_>>());
        let alternatives = lists.filter(|sets| sets.iter().any(|set| set.contains(missing)));
        let all = alternatives.flatten().fold(own, LetterSet::or);
        if all.intersects(present) { own } else { all }
    }

    /// The program that a code of the user calls, `O9010`.
    pub fn alias(self) -> Option<&'c str> {
        self.facts.alias.as_deref()
    }

    /// Declared by the user, so nothing is known about its words.
    pub fn is_user(self) -> bool {
        self.facts.user
    }

    /// What the code does to the machine's state.
    pub fn effect(self) -> Effect {
        self.facts.effect
    }

    /// What moves.
    pub fn motion(self) -> Motion {
        self.facts.entry.motion
    }
}

/// What is known about one macro variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Variable<'c> {
    /// The control has it.
    Known(&'c VariableEntry),
    /// Not among the variables listed for the control.
    Unlisted,
}

impl Control {
    /// What the crate that executes programs makes of the control, made once for all programs.
    ///
    /// # Panics
    /// When two types are asked of one control: there is one such crate.
    pub fn prepared<T: AnyPrepared>(&self, prepare: impl FnOnce(&Self) -> T) -> &T {
        let prepared: &dyn Any = &**self.prepared.0.get_or_init(|| Box::new(prepare(self)));
        #[expect(clippy::expect_used, reason = "one crate prepares controls, as one type")]
        prepared.downcast_ref().expect("a control is prepared as one type")
    }

    /// Identifier: the folder's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Name for people.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Mill or lathe.
    pub fn machine(&self) -> Machine {
        self.machine
    }

    /// Where controls read one thing two ways.
    pub fn semantics(&self) -> &Semantics {
        &self.semantics
    }

    /// How it moves axes.
    pub fn motion(&self) -> &MotionRules {
        &self.motion
    }

    /// Words that stay in effect after their block.
    pub fn lasting(&self) -> &[LastingWords] {
        &self.lasting
    }

    /// How an address stays in effect for the codes of a modal group.
    pub fn lasting_in(&self, letter: Letter, group: &str) -> Option<&LastingWords> {
        let is_own = |row: &&LastingWords| {
            LetterSet::of(&row.letters).contains(letter) && row.groups.iter().any(|own| own == group)
        };
        self.lasting.iter().rfind(is_own)
    }

    /// How text is read.
    pub fn syntax(&self) -> &SyntaxRules {
        &self.syntax
    }

    /// How numbers are read.
    pub fn numbers(&self) -> &NumberRules {
        &self.numbers
    }

    /// Limits of the control.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// How complete the list of codes is.
    pub fn code_list(&self) -> &CodeList {
        &self.code_list
    }

    /// May a number that is not a code of the control be an M code of the machine's builder? Builders' codes have up to eight
    /// digits.
    pub fn may_be_of_builder(&self, letter: Letter, value: f64) -> bool {
        let is_whole = (0.0..1e8).contains(&value) && value.fract() == 0.0;
        letter == Letter::of('M')
            && self.code_list().builder_m_codes
            && (is_whole || CodeNumber::from_value(letter.ascii(), value).is_some())
    }

    /// What becomes of contradictions and repetitions in a block.
    pub fn block_rules(&self) -> &BlockRules {
        &self.block
    }

    /// How programs are written by default.
    pub fn format_customs(&self) -> &FormatCustoms {
        &self.format
    }

    /// Order in which the parts of a block take effect.
    pub fn phases(&self) -> &[String] {
        &self.phases
    }

    /// Axis addresses that machines with this control may have.
    pub fn axes(&self) -> LetterSet {
        self.axes
    }

    /// Hints by which a program shows that it is written for this control.
    pub fn hints(&self) -> &[Hint] {
        &self.hints
    }

    /// Manuals and pages that sources refer to.
    pub fn references(&self) -> &[Reference] {
        &self.references
    }

    /// All modal groups.
    pub fn groups(&self) -> &[ModalGroup] {
        &self.groups
    }

    /// A modal group.
    #[expect(clippy::indexing_slicing, reason = "a GroupIx is only made by the loader for an existing group")]
    pub fn group(&self, ix: GroupIx) -> &ModalGroup {
        &self.groups[ix.index()]
    }

    /// The group with an identifier.
    pub fn group_by_id(&self, id: &str) -> Option<GroupIx> {
        self.groups.iter().position(|g| g.id == id).map(|ix| GroupIx(ix as u8))
    }

    /// All codes, in order of their numbers.
    pub fn codes(&self) -> impl Iterator<Item = Code<'_>> {
        self.codes.iter().map(|facts| Code { control: self, facts })
    }

    /// Index of a code, [`CodeIx::NONE`] if the control does not have it.
    pub fn code_ix(&self, number: CodeNumber) -> CodeIx {
        let [g, m] = &self.by_number;
        let table = if number.letter() == b'G' { g } else { m };
        table.get(usize::from(number.tenths())).copied().unwrap_or(CodeIx::NONE)
    }

    /// A code by its number.
    pub fn code(&self, number: CodeNumber) -> Option<Code<'_>> {
        self.code_at(self.code_ix(number))
    }

    /// A code by its index.
    pub fn code_at(&self, ix: CodeIx) -> Option<Code<'_>> {
        self.codes.get(usize::from(ix.0)).map(|facts| Code { control: self, facts })
    }

    /// An address as read when no code of the block says otherwise.
    pub fn letter(&self, letter: Letter) -> Option<&LetterEntry> {
        self.letters.get(letter.index())?.as_ref()
    }

    /// A numbered macro variable.
    pub fn variable(&self, number: u32) -> Variable<'_> {
        let next = self.numbered.partition_point(|(first, _)| *first <= number);
        let row = next.checked_sub(1).and_then(|row| self.numbered.get(row));
        let entry = row.and_then(|(_, entry)| self.variables.get((*entry)?));
        entry.map_or(Variable::Unlisted, Variable::Known)
    }

    /// How long a numbered macro variable lives. One that is not listed is taken to live until power off.
    pub fn variable_kind(&self, number: u32) -> VariableKind {
        let [first, last] = self.semantics().locals;
        if (first.max(1)..=last).contains(&number) {
            return VariableKind::Local;
        }
        match self.variable(number) {
            Variable::Known(entry) => entry.kind,
            Variable::Unlisted => VariableKind::Common,
        }
    }

    /// A predefined named parameter, by its name without brackets, any case.
    pub fn named_parameter(&self, name: &str) -> Option<&VariableEntry> {
        self.variables.iter().find(|v| v.name.as_deref().is_some_and(|n| n.eq_ignore_ascii_case(name)))
    }

    /// All variables listed for the control.
    pub fn variables(&self) -> &[VariableEntry] {
        &self.variables
    }

    /// All functions of macro expressions.
    pub fn functions(&self) -> &[FunctionEntry] {
        &self.functions
    }

    /// Settings or parameters that change what a program means.
    pub fn settings(&self) -> &[SettingEntry] {
        &self.settings
    }

    /// A setting by its number.
    pub fn setting(&self, number: &str) -> Option<&SettingEntry> {
        self.settings.iter().find(|s| s.number == number)
    }

    /// What the control reads on lines for itself (`$H`), where they are listed.
    pub fn system_commands(&self) -> Option<&SystemCommands> {
        self.commands.as_ref()
    }

    /// The alarm that the control raises for what a rule finds, where it is known.
    pub fn alarm(&self, rule: &str) -> Option<&AlarmEntry> {
        self.alarms.iter().find(|alarm| alarm.rule == rule && alarm.of.is_empty()).map(|alarm| &alarm.entry)
    }

    /// The alarm for what a rule finds about a code or an address, as data writes it: `G43.1`, `T`.
    pub fn alarm_of(&self, rule: &str, thing: &str) -> Option<&AlarmEntry> {
        let own = self.alarms.iter().find(|alarm| alarm.rule == rule && alarm.names(thing));
        own.map_or_else(|| self.alarm(rule), |alarm| Some(&alarm.entry))
    }

    /// Rules that `alarms.toml` names.
    pub fn rules_with_alarms(&self) -> impl Iterator<Item = &str> {
        self.alarms.iter().map(|alarm| alarm.rule.as_str())
    }

    /// All alarms that `alarms.toml` gives: the rule, the codes and addresses that the row is for (none: all others), the alarm.
    pub fn alarms_of_rules(&self) -> impl Iterator<Item = (&str, &[String], &AlarmEntry)> {
        self.alarms.iter().map(|alarm| (alarm.rule.as_str(), alarm.of.as_slice(), &alarm.entry))
    }

    /// The same control with codes that the user's configuration declares, which replace entries of the same number.
    #[must_use]
    pub fn with_user_codes(&self, user: &[UserCode]) -> Self {
        let mut control = self.clone();
        for code in user {
            let group = control.user_group();
            let entry = CodeEntry {
                code: code.number.to_string(),
                title: code.title.clone(),
                group: control.group(group).id.clone(),
                phase: control.phases.last().cloned().unwrap_or_default(),
                summary: match &code.alias {
                    Some(program) => format!("Calls {program} (declared in the configuration)."),
                    None => "Declared in the configuration.".to_owned(),
                },
                words: Vec::new(),
                undefined: false,
                any_words: true,
                one_of: Vec::new(),
                not_together: Vec::new(),
                choice_confidence: None,
                reads_comment: Vec::new(),
                refused_with: Vec::new(),
                disputed: Vec::new(),
                forbidden: Vec::new(),
                requires: Vec::new(),
                recommends: Vec::new(),
                forbids: Vec::new(),
                forbids_confidence: None,
                conflicts: Vec::new(),
                conflicts_when_later: false,
                refused_after: Vec::new(),
                cancels: Vec::new(),
                cancelled_by: Vec::new(),
                opens_data: None,
                motion: Motion::None,
                takes_axes: true,
                alone: false,
                ends: None,
                option: None,
                alarms: Vec::new(),
                hover: None,
                setup: Vec::new(),
                example: code.number.to_string(),
                source: "the user's configuration".to_owned(),
                confidence: Confidence::Manual,
            };
            let facts = CodeFacts {
                entry,
                number: code.number,
                group,
                reads: LetterSet::EMPTY,
                effect: if code.alias.is_some() { Effect::MacroCall } else { Effect::None },
                alias: code.alias.clone(),
                user: true,
            };
            control.put_code(facts);
        }
        control
    }

    /// Is the variable writable by a program, as far as is known?
    pub fn is_writable(&self, number: u32) -> bool {
        !matches!(self.variable(number), Variable::Known(v) if v.access == Access::Read)
    }

    pub(crate) fn put_code(&mut self, facts: CodeFacts) {
        let at = match self.codes.iter().position(|c| c.number == facts.number) {
            Some(at) => at,
            None => self.codes.len(),
        };
        let [g, m] = &mut self.by_number;
        let table = if facts.number.letter() == b'G' { g } else { m };
        let tenths = usize::from(facts.number.tenths());
        if table.len() <= tenths {
            table.resize(tenths + 1, CodeIx::NONE);
        }
        if let Some(slot) = table.get_mut(tenths) {
            *slot = CodeIx(at as u16);
        }
        match self.codes.get_mut(at) {
            Some(old) => *old = facts,
            None => self.codes.push(facts),
        }
    }

    /// The group of declared codes: not exclusive, made on first use.
    fn user_group(&mut self) -> GroupIx {
        const ID: &str = "user";
        self.group_by_id(ID).unwrap_or_else(|| {
            self.groups.push(ModalGroup {
                id: ID.to_owned(),
                number: None,
                title: "codes of the user".to_owned(),
                modal: false,
                exclusive: false,
                default: None,
                source: "the user's configuration".to_owned(),
                confidence: Confidence::Manual,
            });
            GroupIx((self.groups.len() - 1) as u8)
        })
    }
}
