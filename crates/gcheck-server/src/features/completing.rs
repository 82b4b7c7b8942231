//! What may be typed: lists that are short on the wire, and what is told of one row when somebody looks at it.
//!
//! Knows: the forms of lists and rows in the protocol, what a client spares us to repeat. Must not know: what is on a list.

use gcheck_db::Snapshot;
use gcheck_ide::{Completion, CompletionKind};
use serde::Serialize;
use serde_json::Value;

use super::{markdown, text_edit};
use crate::client::Abilities;
use crate::owner::Owner;
use crate::proto::{
    CompletionItem, CompletionItemKind, CompletionItemLabelDetails, CompletionParams, CompletionTextEdit,
    Documentation, InsertTextFormat, Range, Result,
};

/// Bytes of a list. It is sent at each letter, so one that is longer ends with its most fitting rows.
const MOST_BYTES: usize = 10_000;

/// Characters beside a label: no list is wider. The rest is told when the row is looked at.
const MOST_BESIDE: usize = 48;

/// A list. The library's own type has no defaults.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct CompletionList {
    /// What fits depends on the block, so each letter asks again.
    is_incomplete: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    item_defaults: Option<ItemDefaults>,
    items: Vec<CompletionItem>,
}

/// What is said once for all rows.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct ItemDefaults {
    #[serde(skip_serializing_if = "Option::is_none")]
    edit_range: Option<Range>,
    #[serde(skip_serializing_if = "Option::is_none")]
    data: Option<u64>,
}

impl Owner {
    pub(crate) fn completion(
        &mut self,
        params: &CompletionParams,
        stop: &dyn Fn() -> bool,
    ) -> Result<CompletionList> {
        let at = &params.text_document_position;
        let uri = &at.text_document.uri;
        let Some((id, offset)) = self.place(at)? else {
            let found = self.configuration_offers(at)?;
            let snapshot = self.snapshot(uri)?;
            let number = self.document(uri)?.number;
            return Ok(list(&self.abilities, &snapshot, found, number));
        };
        let files = self.workspace_of(uri)?;
        let trigger = params.context.as_ref().and_then(|context| context.trigger_character.as_deref());
        let trigger = trigger.and_then(|trigger| trigger.chars().next());
        let workspace = &files.workspace;
        let found = gcheck_ide::completion(&mut self.database, workspace, id, offset, trigger, stop);
        let snapshot = self.snapshot(uri)?;
        let number = self.document(uri)?.number;
        Ok(list(&self.abilities, &snapshot, found, number))
    }

    /// All about a row of a list.
    pub(crate) fn resolve_completion(&mut self, mut item: CompletionItem) -> CompletionItem {
        let number = item.data.as_ref().and_then(Value::as_u64);
        let document = self.documents.values().find(|document| Some(document.number) == number);
        let Some(snapshot) = document.and_then(|document| self.database.snapshot(document.id)) else {
            return item;
        };
        if document.is_some_and(|document| !document.is_program) {
            let details = self.offered_details(&item.label);
            item.documentation = details.map(|text| Documentation::MarkupContent(markdown(text)));
            return item;
        }
        let kind = KINDS.iter().find(|(_, kind)| Some(*kind) == item.kind).map(|(kind, _)| *kind);
        let details = kind.and_then(|kind| gcheck_ide::completion_details(&snapshot, kind, &item.label));
        item.documentation = details.map(|text| Documentation::MarkupContent(markdown(text)));
        item
    }
}

/// Our kinds and those of the protocol, which are told apart by their pictures alone.
const KINDS: [(CompletionKind, CompletionItemKind); 10] = [
    (CompletionKind::Code, CompletionItemKind::OPERATOR),
    (CompletionKind::Word, CompletionItemKind::PROPERTY),
    (CompletionKind::Variable, CompletionItemKind::VARIABLE),
    (CompletionKind::Function, CompletionItemKind::FUNCTION),
    (CompletionKind::Keyword, CompletionItemKind::KEYWORD),
    (CompletionKind::Label, CompletionItemKind::REFERENCE),
    (CompletionKind::Program, CompletionItemKind::MODULE),
    (CompletionKind::Snippet, CompletionItemKind::SNIPPET),
    (CompletionKind::Rule, CompletionItemKind::ENUM_MEMBER),
    (CompletionKind::Control, CompletionItemKind::CONSTANT),
];

/// The list as a client with these abilities reads it; `number` names the document.
fn list(abilities: &Abilities, snapshot: &Snapshot, found: Vec<Completion>, number: u64) -> CompletionList {
    let mut places = crate::position::Places::new(snapshot, abilities.encoding);
    let common = found.first().map(|first| first.edit.range.clone());
    let defaults = ItemDefaults {
        edit_range: common.as_ref().filter(|_| abilities.common_range).map(|range| places.range(range)),
        data: abilities.common_data.then_some(number),
    };
    let mut items = Vec::new();
    let mut bytes = 0;
    for item in found.into_iter().filter(|item| abilities.snippets || !item.is_snippet) {
        let has_common_edit = defaults.edit_range.is_some()
            && item.edit.text == item.label
            && Some(&item.edit.range) == common.as_ref();
        let description = Some(in_short(item.description)).filter(|description| !description.is_empty());
        let (beside, detail) = if abilities.label_details {
            (
                description.map(|text| CompletionItemLabelDetails { detail: None, description: Some(text) }),
                None,
            )
        } else {
            (None, description)
        };
        let kind = KINDS.iter().find(|(kind, _)| *kind == item.kind).map(|(_, kind)| *kind);
        let mut item = CompletionItem {
            filter_text: Some(item.filter).filter(|filter| *filter != item.label),
            label: item.label,
            label_details: beside,
            kind,
            detail,
            sort_text: Some(in_order(items.len())),
            insert_text_format: item.is_snippet.then_some(InsertTextFormat::SNIPPET),
            text_edit: (!has_common_edit)
                .then(|| CompletionTextEdit::Edit(text_edit(item.edit, &mut places))),
            // How long a list is must not depend on how many documents were opened before this one.
            data: defaults.data.is_none().then(|| 0.into()),
            ..CompletionItem::default()
        };
        bytes += serde_json::to_vec(&item).map_or(0, |text| text.len() + 1);
        if bytes > MOST_BYTES {
            break;
        }
        item.data = item.data.map(|_| number.into());
        items.push(item);
    }
    let has_defaults = defaults.edit_range.is_some() || defaults.data.is_some();
    CompletionList { is_incomplete: true, item_defaults: has_defaults.then_some(defaults), items }
}

/// A text as far as a list shows it.
fn in_short(text: String) -> String {
    match text.char_indices().nth(MOST_BESIDE) {
        Some((end, _)) => format!("{}…", text.get(..end).unwrap_or_default().trim_end()),
        None => text,
    }
}

/// Two characters that sort as the number does; a list of ten thousand bytes has no more rows.
fn in_order(index: usize) -> String {
    let digit = |n: usize| char::from_digit((n % 36) as u32, 36).unwrap_or('z');
    [digit(index / 36), digit(index)].into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::in_order;

    #[test]
    fn rows_sort_as_they_are_numbered() {
        let all: Vec<String> = (0..1_296).map(in_order).collect();
        assert!(all.is_sorted());
        assert_eq!((all[0].as_str(), all[37].as_str()), ("00", "11"));
    }
}
