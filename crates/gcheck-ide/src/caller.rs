//! A call of a macro by another program: what the macro is shown with where it is opened by itself.
//!
//! Knows: calls with numbers for arguments. Must not know: runs, what arguments are for.

use gcheck_db::{DocumentId, Snapshot};
use gcheck_program::CallKind;

use crate::Workspace;
use crate::arguments::is_call;

/// A call of the program that a document holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Caller {
    /// The name of its file.
    pub file: String,
    /// Its line, from 1.
    pub line: u32,
    /// The block.
    pub text: String,
    /// The local variables that it gives, with their values.
    pub variables: Vec<(u32, f64)>,
}

/// The first call of a macro among the other files of the workspace that gives it arguments; `None` where the document is not
/// called so.
pub fn caller(workspace: &Workspace, document: DocumentId) -> Option<Caller> {
    let own = workspace.file(document)?;
    let head = own.snapshot.file_index().programs.first().and_then(|program| program.number);
    let stem = || own.name.split('.').next().and_then(gcheck_engine::number_of_name);
    let number = head.or_else(stem)?;
    let mut others = workspace.files.iter().filter(|file| file.id != document);
    others.find_map(|file| call(&file.snapshot, &file.name, number))
}

/// The first call of a program in a file that gives it arguments.
fn call(snapshot: &Snapshot, file: &str, number: u32) -> Option<Caller> {
    let control = snapshot.control();
    let letters = &control.semantics().argument_letters;
    snapshot.file_index().calls.iter().find_map(|call| {
        let is_it =
            call.target == CallKind::Program(number) && control.code_at(call.code).is_some_and(is_call);
        let place = is_it.then(|| snapshot.block_at(call.range.start)).flatten()?;
        let words = place.table.words(place.block()).iter().filter(|word| !word.code.is_some());
        let variables: Vec<(u32, f64)> = words
            .filter_map(|word| Some((u32::from(*letters.get(&word.letter.to_string())?), word.number()?)))
            .collect();
        let range = place.range();
        let text = snapshot.slice(range.clone()).trim().to_owned();
        let line = snapshot.line_at(range.start) + 1;
        (!variables.is_empty()).then(|| Caller { file: file.to_owned(), line, text, variables })
    })
}

#[cfg(test)]
mod tests {
    use super::caller;
    use crate::fixture::Fixture;

    #[test]
    fn the_first_call_with_arguments_is_found() {
        let fixture = Fixture::new(
            "fanuc-mill",
            "//- part.nc\nO1\nG65 P9010\nG65 P9010 A10. B#100 C-2.\nM30\n//- O9010.nc\n$0O9010\nG1 X#1 Z#3\nM99\n",
        );
        let found = caller(&fixture.workspace, fixture.document).unwrap();
        assert_eq!((found.file.as_str(), found.line), ("part.nc", 3));
        assert_eq!(found.variables, [(1, 10.0), (3, -2.0)]);
    }

    #[test]
    fn a_program_that_nobody_calls_has_no_caller() {
        let fixture =
            Fixture::new("fanuc-mill", "//- part.nc\nO1\nG65 P9010 A1.\nM30\n//- O2.nc\n$0O2\nM99\n");
        assert_eq!(caller(&fixture.workspace, fixture.document), None);
    }
}
