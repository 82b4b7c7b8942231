//! Giving a symbol another name wherever it is named.
//!
//! Knows: when that is safe. Must not know: how symbols are found in the text.

use std::ops::Range;

use gcheck_controls::{Effect, Ends, ReturnTo, VariableKind, WordKind};
use gcheck_db::{DocumentId, Snapshot};
use gcheck_diagnostics::Edit;
use gcheck_program::OLabel;

use crate::symbols::{
    Occurrence, Symbol, callers, computed_call, files_of, has_indirect_variables, is_elsewhere, leaves,
    o_name_range, occurrences, parameter_key, returned_to, stem_matches, subs, symbol_at,
};
use crate::{FileEdits, ReferenceKind, Workspace, WorkspaceFile};

/// What can be renamed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RenameTarget {
    /// Bytes of the name at the cursor.
    pub range: Range<u32>,
    /// The name as it is written.
    pub name: String,
}

/// Why something cannot be renamed: one sentence for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RenameRefused(pub String);

type Checked<T = ()> = Result<T, RenameRefused>;

fn refuse<T>(reason: impl Into<String>) -> Checked<T> {
    Err(RenameRefused(reason.into()))
}

/// What would be renamed at `offset`.
///
/// # Errors
/// [`RenameRefused`] when there is nothing with a name, or renaming it cannot be safe.
pub fn prepare_rename(workspace: &Workspace, document: DocumentId, offset: u32) -> Checked<RenameTarget> {
    let (asked, file, occurrence) = find(workspace, document, offset)?;
    check_symbol(workspace, file, &occurrence.symbol)?;
    Ok(RenameTarget {
        name: asked.snapshot.slice(occurrence.range.clone()).into_owned(),
        range: occurrence.range,
    })
}

/// The edits that give the symbol at `offset` a new name: a number with or without its address, or a name.
///
/// # Errors
/// [`RenameRefused`] as for [`prepare_rename`], and when the name is taken, is not such a name, or is beyond the
/// control's limit.
pub fn rename(
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
    new_name: &str,
) -> Checked<Vec<FileEdits>> {
    let (_, file, occurrence) = find(workspace, document, offset)?;
    check_symbol(workspace, file, &occurrence.symbol)?;
    let new = NewName::read(&occurrence.symbol, new_name)?;
    check_new(workspace, file, &occurrence.symbol, &new)?;
    let mut all: Vec<FileEdits> = Vec::new();
    for (id, place) in occurrences(workspace, file.id, &occurrence.symbol) {
        let Some(file) = workspace.file(id) else { continue };
        let text = new.written(&file.snapshot.slice(place.range.clone()), &file.snapshot, &place);
        let edit = Edit { range: place.range, text };
        match all.iter_mut().find(|edits| edits.file == id) {
            Some(edits) => edits.edits.push(edit),
            None => all.push(FileEdits { file: id, edits: vec![edit] }),
        }
    }
    Ok(all)
}

/// The file that was asked about, the file that the symbol belongs to, and what is named there.
fn find(
    workspace: &Workspace,
    document: DocumentId,
    offset: u32,
) -> Checked<(&WorkspaceFile, &WorkspaceFile, Occurrence)> {
    let nothing = || RenameRefused("there is nothing here that has a name".to_owned());
    let file = workspace.file(document).ok_or_else(nothing)?;
    if let Some(occurrence) = symbol_at(&file.snapshot, offset) {
        return Ok((file, file, occurrence));
    }
    let mut returned = returned_to(workspace, file, offset);
    if returned.len() > 1 {
        return refuse("this return names a block of each program that calls its own: rename that block");
    }
    let (owner, occurrence) = returned.pop().ok_or_else(nothing)?;
    Ok((file, workspace.file(owner).ok_or_else(nothing)?, occurrence))
}

/// A name that can be written.
enum NewName {
    Number(u32),
    Name(String),
}

impl NewName {
    fn read(symbol: &Symbol, text: &str) -> Checked<Self> {
        let text = text.trim();
        let (sigil, is_number) = match symbol {
            Symbol::Label { .. } => (&['N', 'n'][..], true),
            Symbol::Program(_) => (&['O', 'o', ':'][..], true),
            Symbol::Variable { .. } => (&['#'][..], true),
            Symbol::Subroutine(label) | Symbol::Branch { label, .. } => {
                (&['O', 'o'][..], matches!(label, OLabel::Number(_)))
            }
            Symbol::Parameter { .. } => (&['#'][..], false),
        };
        if is_number {
            let digits = text.strip_prefix(sigil).unwrap_or(text).trim();
            let number = digits.bytes().all(|b| b.is_ascii_digit()).then(|| digits.parse().ok()).flatten();
            return match number {
                Some(number) => Ok(Self::Number(number)),
                None => refuse(format!("`{text}` is not a whole number")),
            };
        }
        let bare = text.strip_prefix(sigil).filter(|rest| rest.trim_start().starts_with('<')).unwrap_or(text);
        let bare = bare.trim().trim_start_matches('<').trim_end_matches('>').trim();
        let is_name = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
        if bare.is_empty() || !bare.chars().all(is_name) {
            return refuse(format!(
                "`{text}` is not a name: use letters, digits, `_`, `-` and `.`, without blanks"
            ));
        }
        Ok(Self::Name(bare.to_owned()))
    }

    /// As it is written in the place of an old name: numbers as wide as that was, where it had leading zeros.
    fn written(&self, old: &str, snapshot: &Snapshot, place: &Occurrence) -> String {
        match self {
            Self::Name(name) => name.clone(),
            Self::Number(number) => {
                let before = snapshot.slice(place.range.start.saturating_sub(1)..place.range.start);
                // Repeats in front of a program number leave it four digits.
                let is_packed = before.starts_with(|c: char| c.is_ascii_digit());
                if is_packed || old.starts_with('0') && old.len() > 1 {
                    format!("{number:0width$}", width = old.len())
                } else {
                    number.to_string()
                }
            }
        }
    }
}

/// Can the symbol be renamed at all?
fn check_symbol(workspace: &Workspace, file: &WorkspaceFile, symbol: &Symbol) -> Checked {
    match symbol {
        Symbol::Label { number, program } => check_label(workspace, file, *number, program),
        Symbol::Program(_) | Symbol::Subroutine(_) => {
            check_calls(workspace)?;
            let heads = occurrences(workspace, file.id, symbol);
            let heads =
                heads.iter().filter(|(_, occurrence)| occurrence.kind == ReferenceKind::Write).count();
            let name = shown(symbol);
            match heads {
                0 => return refuse(format!("{name} is not in a file of this workspace")),
                1 => {}
                _ => {
                    return refuse(format!(
                        "{name} exists more than once: it is not certain which one is called"
                    ));
                }
            }
            if let Symbol::Subroutine(label) = symbol {
                for file in &workspace.files {
                    check_written(&file.snapshot, label)?;
                }
            }
            named_by_file(workspace, file, symbol)
        }
        Symbol::Branch { label, .. } => {
            check_written(&file.snapshot, label)?;
            let words = &file.snapshot.file_index().o_words;
            if words.iter().any(|word| word.label == OLabel::Computed) {
                return refuse(
                    "an O-word of this file computes its label, so which block it means is not certain",
                );
            }
            Ok(())
        }
        Symbol::Variable { number, part } => check_variable(workspace, file, *number, part.as_ref()),
        Symbol::Parameter { name, .. } => {
            if file.snapshot.control().named_parameter(name).is_some() || name.contains('[') {
                return refuse(format!("`#<{name}>` is the control's own"));
            }
            Ok(())
        }
    }
}

fn check_label(workspace: &Workspace, file: &WorkspaceFile, number: u32, program: &Range<u32>) -> Checked {
    let file_index = file.snapshot.file_index();
    let inside = |range: &Range<u32>| program.contains(&range.start);
    if file_index.jumps.iter().any(|jump| jump.target.is_none() && inside(&jump.range)) {
        return refuse("a jump of this program computes its target, so which block it means is not certain");
    }
    let labels =
        file_index.labels.iter().filter(|label| label.number == number && inside(&label.range)).count();
    match labels {
        0 => return refuse(format!("N{number} is not in this program")),
        1 => {}
        _ => return refuse(format!("N{number} is in this program more than once")),
    }
    let returns_to_caller = file.snapshot.control().semantics().return_to == ReturnTo::Caller;
    for other in workspace.files.iter().filter(|_| returns_to_caller) {
        let file_index = other.snapshot.file_index();
        // A return into this program alone is renamed with the label.
        let is_certain = |jump: &gcheck_program::Jump| {
            let own = (file.id, program.clone());
            jump.target.is_some()
                && leaves(&other.snapshot, jump)
                && callers(workspace, other, jump) == [own]
                && check_calls(workspace).is_ok()
        };
        let names_it = |jump: &&gcheck_program::Jump| {
            is_elsewhere(other.snapshot.control(), jump.code, WordKind::Label)
                && jump.target.is_none_or(|target| target == number)
                && (other.id != file.id || !inside(&jump.range))
                && !is_certain(jump)
        };
        if let Some(jump) = file_index.jumps.iter().find(names_it) {
            let text = other.snapshot.slice(jump.range.clone());
            return refuse(format!(
                "a return in {} names a block of its caller (`{}`): that may be this one",
                other.name,
                text.trim()
            ));
        }
    }
    Ok(())
}

fn check_calls(workspace: &Workspace) -> Checked {
    for file in &workspace.files {
        if let Some(call) = computed_call(file.snapshot.file_index()) {
            let text = file.snapshot.slice(call.range.clone());
            return refuse(format!(
                "a call in {} computes what it calls (`{}`), so what it means is not certain",
                file.name,
                text.trim()
            ));
        }
    }
    Ok(())
}

/// A label that is computed from numbers alone (`O[50*2]`) has no text that can be replaced.
fn check_written(snapshot: &Snapshot, label: &OLabel) -> Checked {
    let words = &snapshot.file_index().o_words;
    match words.iter().find(|word| word.label == *label && o_name_range(snapshot, word).is_none()) {
        None => Ok(()),
        Some(word) => {
            let text = snapshot.slice(word.range.clone());
            refuse(format!("`{}` computes the same label", text.trim()))
        }
    }
}

/// A file that is found by its name would no longer be.
fn named_by_file(workspace: &Workspace, file: &WorkspaceFile, symbol: &Symbol) -> Checked {
    if !file.snapshot.control().syntax().o_words {
        return Ok(());
    }
    let name = match symbol {
        Symbol::Program(number) | Symbol::Subroutine(OLabel::Number(number)) => number.to_string(),
        Symbol::Subroutine(OLabel::Name(name)) => name.clone(),
        _ => return Ok(()),
    };
    match workspace.files.iter().find(|file| stem_matches(&file.name, &name, symbol)) {
        Some(named) => {
            refuse(format!("the control finds {} by the name of its file, {}", shown(symbol), named.name))
        }
        None => Ok(()),
    }
}

fn check_variable(
    workspace: &Workspace,
    file: &WorkspaceFile,
    number: u32,
    part: Option<&Range<u32>>,
) -> Checked {
    let control = file.snapshot.control();
    match control.variable_kind(number) {
        VariableKind::System => return refuse(format!("#{number} is the control's own")),
        VariableKind::Retained => {
            return refuse(format!("the control keeps #{number} over power off: other programs may use it"));
        }
        VariableKind::Common | VariableKind::Local => {}
    }
    if number == 0 {
        return refuse("#0 is the control's own");
    }
    let symbol = Symbol::Variable { number, part: part.cloned() };
    for other in files_of(workspace, file.id, &symbol) {
        if has_indirect_variables(&other.snapshot) {
            return refuse(format!(
                "{} computes the numbers of variables, so which one it means is not certain",
                other.name
            ));
        }
    }
    let Some(part) = part else { return Ok(()) };
    let file_index = file.snapshot.file_index();
    let is_argument = control.semantics().argument_letters.values().any(|n| u32::from(*n) == number)
        || control.syntax().o_words;
    let returns =
        file_index.ends.iter().any(|end| end.ends == Ends::Subprogram && part.contains(&end.range.start))
            || subs(&file.snapshot).iter().any(|sub| sub.range == *part);
    if is_argument && returns {
        return refuse(format!("#{number} may be given by callers of this program"));
    }
    let shares = !control.semantics().locals_per_subprogram
        && file_index.calls.iter().any(|call| {
            part.contains(&call.range.start)
                && control.code_at(call.code).is_some_and(|code| code.effect() == Effect::CallProgram)
        });
    if shares {
        return refuse(format!("programs that this one calls share #{number} with it"));
    }
    Ok(())
}

/// Can the symbol have this name?
fn check_new(workspace: &Workspace, file: &WorkspaceFile, symbol: &Symbol, new: &NewName) -> Checked {
    let control = file.snapshot.control();
    let renamed = match (symbol, new) {
        (Symbol::Label { program, .. }, NewName::Number(number)) => {
            if let Some(most) = control.limits().max_sequence_number.filter(|most| number > most) {
                return refuse(format!("N{number} is beyond the highest sequence number, {most}"));
            }
            Symbol::Label { number: *number, program: program.clone() }
        }
        (Symbol::Program(_), NewName::Number(number)) => {
            if let Some([first, last]) = control.limits().program_numbers
                && !(first..=last).contains(number)
            {
                return refuse(format!("program numbers go from {first} to {last}"));
            }
            Symbol::Program(*number)
        }
        (Symbol::Subroutine(_), NewName::Number(number)) => Symbol::Subroutine(OLabel::Number(*number)),
        (Symbol::Subroutine(_), NewName::Name(name)) => {
            Symbol::Subroutine(OLabel::of_name(parameter_key(name)))
        }
        (Symbol::Branch { part, .. }, NewName::Number(number)) => {
            Symbol::Branch { label: OLabel::Number(*number), part: part.clone() }
        }
        (Symbol::Branch { part, .. }, NewName::Name(name)) => {
            Symbol::Branch { label: OLabel::of_name(parameter_key(name)), part: part.clone() }
        }
        (Symbol::Variable { number: old, part }, NewName::Number(number)) => {
            if *number == 0 || control.variable_kind(*number) != control.variable_kind(*old) {
                return refuse(format!("#{number} is not the same kind of variable as #{old}"));
            }
            Symbol::Variable { number: *number, part: part.clone() }
        }
        (Symbol::Parameter { part, .. }, NewName::Name(name)) => {
            let name = parameter_key(name);
            if control.named_parameter(&name).is_some() {
                return refuse(format!("`#<{name}>` is the control's own"));
            }
            if name.starts_with('_') == part.is_some() {
                return refuse(
                    "names that begin with `_` are global, others are local: that would change it",
                );
            }
            Symbol::Parameter { name, part: part.clone() }
        }
        _ => return refuse("that is not such a name"),
    };
    if renamed == *symbol {
        return Ok(());
    }
    let taken_by_label = |label: &OLabel| {
        // Subroutines and branches share their labels with what is around them.
        file.snapshot.file_index().o_words.iter().any(|word| word.label == *label)
    };
    let is_taken = match &renamed {
        Symbol::Subroutine(label) | Symbol::Branch { label, .. } => {
            taken_by_label(label) || !occurrences(workspace, file.id, &renamed).is_empty()
        }
        _ => !occurrences(workspace, file.id, &renamed).is_empty(),
    };
    if is_taken { refuse(format!("{} is taken", shown(&renamed))) } else { Ok(()) }
}

/// A symbol as people call it.
fn shown(symbol: &Symbol) -> String {
    let label = |label: &OLabel| match label {
        OLabel::Number(number) => format!("O{number}"),
        OLabel::Name(name) => format!("O<{name}>"),
        OLabel::Computed => "O[…]".to_owned(),
    };
    match symbol {
        Symbol::Label { number, .. } => format!("N{number}"),
        Symbol::Program(number) => format!("O{number}"),
        Symbol::Subroutine(name) | Symbol::Branch { label: name, .. } => label(name),
        Symbol::Variable { number, .. } => format!("#{number}"),
        Symbol::Parameter { name, .. } => format!("#<{name}>"),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::rename;
    use crate::fixture::Fixture;

    fn check(control: &str, text: &str, new: &str, expected: &Expect) {
        let fixture = Fixture::new(control, text);
        let result = match rename(&fixture.workspace, fixture.document, fixture.offset, new) {
            Ok(edits) => fixture.edited(&edits),
            Err(refused) => format!("refused: {}\n", refused.0),
        };
        expected.assert_eq(&result);
    }

    #[test]
    fn a_label_and_its_jumps() {
        let text = "O1\nN010 G0 X0.\nGOTO 1$00\nM99 P10\nM30\nO2\nN10 M99\n";
        check(
            "haas-mill",
            text,
            "20",
            &expect![[r#"
            O1
            N020 G0 X0.
            GOTO 20
            M99 P20
            M30
            O2
            N10 M99
        "#]],
        );
        check(
            "haas-mill",
            text,
            "N20",
            &expect![[r#"
            O1
            N020 G0 X0.
            GOTO 20
            M99 P20
            M30
            O2
            N10 M99
        "#]],
        );
        check(
            "haas-mill",
            text,
            "100000",
            &expect![[r#"
            refused: N100000 is beyond the highest sequence number, 99999
        "#]],
        );
        check(
            "haas-mill",
            text,
            "x",
            &expect![[r#"
            refused: `x` is not a whole number
        "#]],
        );
        check(
            "haas-mill",
            "O1\nN10$0 G0 X0.\nN20 X1.\nGOTO 10\n",
            "20",
            &expect![[r#"
            refused: N20 is taken
        "#]],
        );
    }

    #[test]
    fn a_label_that_a_computed_jump_may_mean_stays() {
        check(
            "haas-mill",
            "O1\nN10$0 G0 X0.\nGOTO #1\nM30\n",
            "20",
            &expect![[r#"
            refused: a jump of this program computes its target, so which block it means is not certain
        "#]],
        );
        check(
            "haas-mill",
            "O1\nN10$0 G0 X0.\nN10 X1.\nM30\n",
            "20",
            &expect![[r#"
            refused: N10 is in this program more than once
        "#]],
        );
        let files = "//- a.nc\nO1\nM98 P2\nN10$0 G0 X0.\nM30\n//- b.nc\nO2\nM99 P10\n";
        check(
            "fanuc-mill",
            files,
            "20",
            &expect![[r#"
                //- a.nc
                O1
                M98 P2
                N20 G0 X0.
                M30
                //- b.nc
                O2
                M99 P20
            "#]],
        );
    }

    #[test]
    fn a_program_across_files() {
        let files = "//- a.nc\nO0001\nM98 P9010$0\nG65 P09010 A1.\nM30\n//- b.nc\nO09010 (PROBE)\nM99\n";
        check(
            "haas-mill",
            files,
            "9020",
            &expect![[r#"
            //- a.nc
            O0001
            M98 P9020
            G65 P09020 A1.
            M30
            //- b.nc
            O09020 (PROBE)
            M99
        "#]],
        );
        check(
            "haas-mill",
            files,
            "O1",
            &expect![[r#"
            refused: O1 is taken
        "#]],
        );
        check(
            "fanuc-mill",
            "O1$0\nM98 P30001\nM98 P1\nM30\n",
            "25",
            &expect![[r#"
            O25
            M98 P30025
            M98 P25
            M30
        "#]],
        );
        check(
            "haas-mill",
            "O1\nM98 P77$0\nM30\n",
            "78",
            &expect![[r#"
            refused: O77 is not in a file of this workspace
        "#]],
        );
        check(
            "haas-mill",
            "O1\nM98 P#1\nM98 P2\nM30\nO2$0\nM99\n",
            "3",
            &expect![[r#"
            refused: a call in main.nc computes what it calls (`P#1`), so what it means is not certain
        "#]],
        );
    }

    #[test]
    fn subroutines_and_branches_of_o_words() {
        let text = "o<probe> sub\no1 if [#1]\no1 endif\no<probe> endsub\no<Pro be> call$0 [1]\nM2\n";
        check(
            "linuxcnc",
            text,
            "touch",
            &expect![[r#"
            o<touch> sub
            o1 if [#1]
            o1 endif
            o<touch> endsub
            o<touch> call [1]
            M2
        "#]],
        );
        check(
            "linuxcnc",
            "o1 while$0 [1]\no1 endwhile\nM2\n",
            "2",
            &expect![[r#"
            o2 while [1]
            o2 endwhile
            M2
        "#]],
        );
        let files = "//- a.ngc\no<probe> call$0\nM2\n//- probe.ngc\no<probe> sub\no<probe> endsub\n";
        check(
            "linuxcnc",
            files,
            "touch",
            &expect![[r#"
            refused: the control finds O<probe> by the name of its file, probe.ngc
        "#]],
        );
    }

    #[test]
    fn variables() {
        let files =
            "//- a.nc\nO1\n#100=1.\nM98 P2\nM30\n//- b.nc\nO2\nG0 X#100$0\nM99\n//- c.nc\nO3\n#100=5.\nM30\n";
        check(
            "fanuc-mill",
            files,
            "#120",
            &expect![[r#"
            //- a.nc
            O1
            #120=1.
            M98 P2
            M30
            //- b.nc
            O2
            G0 X#120
            M99
        "#]],
        );
        check(
            "fanuc-mill",
            files,
            "33",
            &expect![[r#"
            refused: #33 is not the same kind of variable as #100
        "#]],
        );
        check(
            "haas-mill",
            "O1\n#500$0=1.\nM30\n",
            "501",
            &expect![[r#"
            refused: the control keeps #500 over power off: other programs may use it
        "#]],
        );
        check(
            "haas-mill",
            "O1\n#5021$0=1.\nM30\n",
            "501",
            &expect![[r#"
            refused: #5021 is the control's own
        "#]],
        );
        check(
            "fanuc-mill",
            "O1\n#100$0=1.\n#[#100]=2.\nM30\n",
            "101",
            &expect![[r#"
            refused: main.nc computes the numbers of variables, so which one it means is not certain
        "#]],
        );
        check(
            "haas-mill",
            "O9\n#1$0=1.\nM99\n",
            "2",
            &expect![[r#"
            refused: #1 may be given by callers of this program
        "#]],
        );
        check(
            "linuxcnc",
            "#<depth> = 1\nG0 Z[#<De pth$0>]\nM2\n",
            "deep",
            &expect![[r#"
            #<deep> = 1
            G0 Z[#<deep>]
            M2
        "#]],
        );
        check(
            "linuxcnc",
            "#<depth$0> = 1\nM2\n",
            "_deep",
            &expect![[r#"
            refused: names that begin with `_` are global, others are local: that would change it
        "#]],
        );
        check(
            "linuxcnc",
            "G0 X#<_x$0>\nM2\n",
            "_deep",
            &expect![[r#"
            refused: `#<_x>` is the control's own
        "#]],
        );
    }

    #[test]
    fn nothing_has_a_name() {
        check(
            "haas-mill",
            "O1\nG0 X$01.\nM30\n",
            "2",
            &expect![[r#"
            refused: there is nothing here that has a name
        "#]],
        );
    }

    #[test]
    fn a_name_with_a_blank_is_refused() {
        check(
            "linuxcnc",
            "#<dep$0th> = 1\nm2\n",
            "two words",
            &expect![[r#"
            refused: `two words` is not a name: use letters, digits, `_`, `-` and `.`, without blanks
        "#]],
        );
        check(
            "linuxcnc",
            "o<pro$0be> sub\no<probe> endsub\nm2\n",
            "two words",
            &expect![[r#"
            refused: `two words` is not a name: use letters, digits, `_`, `-` and `.`, without blanks
        "#]],
        );
    }

    #[test]
    fn what_a_return_names_is_renamed_where_the_control_looks_for_it() {
        check(
            "haas-mill",
            "O1\nM98 P2\nN20 G0 X0.\nM30\nO2\nM99 P2$00\nN20 M99\n",
            "30",
            &expect![[r#"
            O1
            M98 P2
            N20 G0 X0.
            M30
            O2
            M99 P30
            N30 M99
        "#]],
        );
        check(
            "fanuc-mill",
            "//- a.nc\nO1\nM98 P2\nN10 G0 X0.\nM30\n//- b.nc\nO2\nM99 P1$00\n",
            "30",
            &expect![[r#"
                //- a.nc
                O1
                M98 P2
                N30 G0 X0.
                M30
                //- b.nc
                O2
                M99 P30
            "#]],
        );
        check(
            "fanuc-mill",
            "//- a.nc\nO1\nM98 P2\nN10$0 G0 X0.\nM30\n//- c.nc\nO3\nM98 P2\nN10 M30\n//- b.nc\nO2\nM99 P10\n",
            "30",
            &expect![[r#"
                refused: a return in b.nc names a block of its caller (`P10`): that may be this one
            "#]],
        );
    }
}
