//! Calls of programs that are in other files, as links.
//!
//! Knows: which call goes to another file. Must not know: addresses of files.

use std::ops::Range;

use gcheck_db::DocumentId;

use crate::symbols::{Symbol, callee, definition_of};
use crate::{Place, Workspace};

/// A link.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DocumentLink {
    /// Bytes of the file: the word or statement that names the program.
    pub range: Range<u32>,
    /// The program's head.
    pub target: Place,
    /// What it leads to, in a few words.
    pub tooltip: String,
}

/// The links of a document, in text order.
pub fn document_links(workspace: &Workspace, document: DocumentId) -> Vec<DocumentLink> {
    let Some(file) = workspace.file(document) else { return Vec::new() };
    // A program calls few others, many times.
    let mut known: Vec<(Symbol, Option<Place>)> = Vec::new();
    let mut links = Vec::new();
    for call in &file.snapshot.file_index().calls {
        let Some(symbol) = callee(&file.snapshot, call) else { continue };
        let target = match known.iter().find(|(known, _)| *known == symbol) {
            Some((_, place)) => place.clone(),
            None => {
                let place = definition_of(workspace, document, &symbol);
                known.push((symbol, place.clone()));
                place
            }
        };
        if let Some(target) = target.filter(|target| target.file != document) {
            let name = workspace.file(target.file).map(|file| &*file.name).unwrap_or_default();
            let tooltip = format!("open {name}");
            links.push(DocumentLink { range: call.range.clone(), target, tooltip });
        }
    }
    links.sort_by_key(|link| link.range.start);
    links
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::document_links;
    use crate::fixture::Fixture;

    #[test]
    fn calls_of_programs_in_other_files() {
        let files = "//- a.nc\nO1\nM98 P2\nM98 P3\nG65 P9010 A1.\nM30\nO3\nM99\n//- b.nc\n%\nO2\nM99\n//- O9010.nc\nM99\n";
        let fixture = Fixture::new("haas-mill", files);
        let links = document_links(&fixture.workspace, fixture.document).into_iter().map(|link| {
            let from = fixture.shown(fixture.document, &link.range);
            format!("{from} -> {} ({})\n", fixture.shown(link.target.file, &link.target.range), link.tooltip)
        });
        expect![[r#"
            a.nc:2: P2 -> b.nc:2: O2 (open b.nc)
            a.nc:4: P9010 -> O9010.nc:1:  (open O9010.nc)
        "#]]
        .assert_eq(&links.collect::<String>());
    }
}
