//! Law 6: formatting and renumbering leave the moves of a program as they are, and twice is once.
//!
//! On our own programs for every control, and on the real-program corpus (`GCHECK_CORPUS`) where there is one.

#![expect(clippy::unwrap_used, reason = "a test that meets the unexpected is to fail")]

mod moves;

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use gcheck_diagnostics::apply_to_bytes;
use gcheck_format::{
    Indentation, LeadingZeros, LetterCase, Numbering, SequenceNumbers, Style, TrailingZeros, WordSpacing,
    formatted, renumber,
};
use gcheck_program::Dialect;
use gcheck_syntax::SourceText;
use gcheck_testkit::corpus;
use moves::{moves, own_programs};
use rayon::prelude::*;

/// The control's own, one that packs as much as can be, one that spreads out.
fn styles(dialect: &Dialect<'_>) -> [Style; 3] {
    let own = Style::of(dialect.control());
    let packed = Style {
        word_spacing: WordSpacing::None,
        letter_case: LetterCase::Upper,
        leading_zeros: LeadingZeros::Drop,
        trailing_zeros: TrailingZeros::Drop,
        sequence_numbers: SequenceNumbers::Drop,
        comment_column: 1,
        blank_lines: 0,
        indentation: Indentation::None,
        ..own.clone()
    };
    let wide = Style {
        letter_case: LetterCase::Lower,
        leading_zeros: LeadingZeros::Add,
        word_column: 8,
        comment_column: 40,
        indentation: Indentation::Nested(2),
        ..own.clone()
    };
    [own, packed, wide]
}

/// What became of the programs.
#[derive(Debug, Default)]
struct Counts {
    formatted: AtomicUsize,
    renumbered: AtomicUsize,
    refused: AtomicUsize,
}

/// A program in another form.
struct Form {
    name: &'static str,
    bytes: Vec<u8>,
}

/// The forms of a program that differ from it; formatted and renumbered once more they stay.
fn forms(name: &str, program: &[u8], control: &str, counts: &Counts) -> Vec<Form> {
    let control = gcheck_controls::load(control).unwrap();
    let dialect = Dialect::new(&control);
    let source = SourceText::from_bytes(program.to_vec()).unwrap();
    let mut forms = Vec::new();
    for (style, style_name) in styles(&dialect).into_iter().zip(["own", "packed", "wide"]) {
        let Some(bytes) = formatted(&source, &dialect, &style) else { continue };
        counts.formatted.fetch_add(1, Ordering::Relaxed);
        let again = SourceText::from_bytes(bytes.clone()).unwrap();
        assert_eq!(formatted(&again, &dialect, &style), None, "{name}: twice is once, {style_name}");
        forms.push(Form { name: style_name, bytes });
    }
    let numbering = Numbering { start: 7, step: 3 };
    match renumber(source.text(), &dialect, &numbering) {
        Ok(edits) if edits.is_empty() => {}
        Ok(edits) => {
            counts.renumbered.fetch_add(1, Ordering::Relaxed);
            let bytes = apply_to_bytes(program, &edits);
            let again = SourceText::from_bytes(bytes.clone()).unwrap();
            assert_eq!(renumber(again.text(), &dialect, &numbering), Ok(Vec::new()), "{name}: twice is once");
            forms.push(Form { name: "renumbered", bytes });
        }
        Err(_) => {
            counts.refused.fetch_add(1, Ordering::Relaxed);
        }
    }
    forms.dedup_by(|one, other| one.bytes == other.bytes);
    forms
}

fn holds(name: &str, program: &[u8], control: &str, folder: &Path, counts: &Counts) {
    let forms = forms(name, program, control, counts);
    if forms.is_empty() {
        return;
    }
    let before = moves(program, control, folder);
    for form in forms {
        let after = moves(&form.bytes, control, folder);
        assert_eq!(before, after, "{name} ({control}), {}", form.name);
    }
}

#[test]
fn on_our_own_programs() {
    let files = own_programs();
    let counts = Counts::default();
    files.par_iter().enumerate().for_each(|(ix, path)| {
        let program = fs::read(path).unwrap();
        let name = path.display().to_string();
        let folder = path.parent().unwrap();
        let own = if path.extension().is_some_and(|e| e == "nc") { "haas-mill" } else { "linuxcnc" };
        // Every control sees its share of all programs: written for it or not, they are read as before.
        let names = gcheck_controls::names();
        let other = names.get(ix % names.len()).copied().unwrap_or(own);
        for control in [own, other] {
            holds(&name, &program, control, folder, &counts);
        }
    });
    eprintln!("{} programs: {counts:?}", files.len());
    assert!(counts.formatted.load(Ordering::Relaxed) > 100 && counts.renumbered.load(Ordering::Relaxed) > 0);
}

#[test]
fn on_the_corpus() {
    let Some(programs) = corpus::programs() else { return };
    let counts = Counts::default();
    programs.par_iter().for_each(|program| {
        if gcheck_controls::names().contains(&program.control.as_str()) {
            let bytes = fs::read(&program.path).unwrap();
            let folder = program.path.parent().unwrap();
            holds(&program.name, &bytes, &program.control, folder, &counts);
        }
    });
    eprintln!("{} programs: {counts:?}", programs.len());
    assert!(counts.formatted.load(Ordering::Relaxed) > 100 && counts.renumbered.load(Ordering::Relaxed) > 10);
}
