//! Configurations in the editor: what is told of them, what may be written, where programs lead into them.
//!
//! Knows: their forms in the protocol. Must not know: any key of a configuration.

use std::collections::BTreeMap;
use std::path::Path;

use gcheck_ide::{Completion, CompletionKind, Edit, configured_at};

use crate::owner::Owner;
use crate::position::range_in;
use crate::proto::{
    Hover, HoverContents, Location, MarkupContent, MarkupKind, Result, TextDocumentPositionParams, Uri,
};
use crate::{ConfigurationOffer, ConfiguredPlace, ProgramQuery};

/// An entry of a configuration, as the client names its place.
#[derive(Debug)]
pub(super) struct Entry {
    /// Bytes of the program that name it.
    pub(super) from: std::ops::Range<u32>,
    pub(super) location: Location,
}

impl Owner {
    /// What is told of a place in a configuration.
    pub(super) fn configuration_hover(&mut self, at: &TextDocumentPositionParams) -> Result<Option<Hover>> {
        let uri = &at.text_document.uri;
        let snapshot = self.snapshot(uri)?;
        let mut places = self.places(&snapshot);
        let offset = places.offset(at.position);
        let path = self.document(uri)?.path.clone();
        let told = self.host.0.configuration_hover(&path, &snapshot.text(), offset as usize);
        let kind = if self.abilities.markdown_hover { MarkupKind::Markdown } else { MarkupKind::PlainText };
        Ok(told.map(|told| Hover {
            contents: HoverContents::Markup(MarkupContent { kind, value: told.markdown }),
            range: Some(places.range(&(told.range.start as u32..told.range.end as u32))),
        }))
    }

    /// What may be written at a place of a configuration.
    pub(super) fn configuration_offers(
        &mut self,
        at: &TextDocumentPositionParams,
    ) -> Result<Vec<Completion>> {
        let uri = &at.text_document.uri;
        let snapshot = self.snapshot(uri)?;
        let offset = self.places(&snapshot).offset(at.position);
        let path = self.document(uri)?.path.clone();
        let offers = self.host.0.configuration_completion(&path, &snapshot.text(), offset as usize);
        self.offered = offers.iter().map(|offer| (offer.label.clone(), offer.description.clone())).collect();
        let has_snippets = self.abilities.snippets;
        Ok(offers.into_iter().map(|offer| row(offer, has_snippets)).collect())
    }

    /// All about a row of the last list for a configuration.
    pub(super) fn offered_details(&self, label: &str) -> Option<String> {
        self.offered.get(label).filter(|text| !text.is_empty()).cloned()
    }

    /// The entries of the configuration for what a program names at a place.
    pub(super) fn configured(&mut self, uri: &Uri, offset: u32) -> Result<Vec<Entry>> {
        let snapshot = self.indexed(uri)?;
        let Some((named, from)) = configured_at(&snapshot, offset) else { return Ok(Vec::new()) };
        let mut texts = BTreeMap::new();
        for open in self.documents.values().filter(|document| !document.is_program) {
            let text = self.database.snapshot(open.id).map(|snapshot| snapshot.text());
            texts.extend(text.map(|text| (open.path.clone(), text)));
        }
        let document = self.document(uri)?;
        let client = self.client_settings(document);
        let open = self.open_programs();
        let query = ProgramQuery {
            path: &document.path,
            head: "",
            control: client.control.as_deref(),
            configuration: client.config_path.as_deref(),
            open: &open,
        };
        let text = |path: &Path| texts.get(path).cloned();
        let found = self.host.0.configured(&query, snapshot.control(), named, &text);
        let encoding = self.abilities.encoding;
        let location = |place: ConfiguredPlace| {
            let open = self.documents.values().find(|document| document.path == place.path);
            let uri =
                open.map(|document| document.uri.clone()).or_else(|| Uri::from_file_path(&place.path))?;
            Some(Location::new(uri, range_in(&place.text, &place.key, encoding)))
        };
        let locations = found.into_iter().filter_map(location);
        Ok(locations.map(|location| Entry { from: from.clone(), location }).collect())
    }
}

fn row(offer: ConfigurationOffer, has_snippets: bool) -> Completion {
    let snippet = offer.snippet.filter(|_| has_snippets);
    let is_snippet = snippet.is_some();
    let range = offer.range.start as u32..offer.range.end as u32;
    Completion {
        label: offer.label,
        description: offer.description,
        kind: if offer.is_key { CompletionKind::Word } else { CompletionKind::Rule },
        edit: Edit { range, text: snippet.unwrap_or(offer.text) },
        is_snippet,
        filter: offer.filter,
    }
}
