//! Does the law fail when it must? Every field of the state is forgotten once where two states become one.
//!
//! Knows: the programs that are tried, in their order. Must not know: what fields mean.

use std::collections::BTreeSet;
use std::env;
use std::fmt::Write as _;
use std::fs;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use gcheck_engine::forgetful::{Field, asked, forgetting};
use gcheck_engine::state_fields;

use crate::draw::Random;
use crate::generator::Style;
use crate::law::{Counts, check};
use crate::programs::{UNSEEN, sources};
use crate::{GENERATED, generated, generated_law};

/// So many random programs of each style are tried.
const EACH: u64 = 300;

/// A program that is tried.
enum Trial {
    Own(usize),
    Random(&'static str, Style, u64),
}

fn trials() -> Vec<Trial> {
    let own = (0..sources().len()).map(Trial::Own);
    let random =
        (0..EACH).flat_map(|seed| GENERATED.map(|(control, style)| Trial::Random(control, style, seed)));
    own.chain(random).collect()
}

/// The name of a program, and whether the law holds for it.
fn hold(trial: &Trial) -> (String, Result<Counts, String>) {
    match trial {
        Trial::Own(number) => {
            let source = sources().swap_remove(*number);
            let held = check(&source.case(3_000), 24, &mut Random::new(*number as u64));
            (source.name, held)
        }
        Trial::Random(control, style, seed) => {
            let held = generated_law(control, &generated(*style, *seed), *seed);
            (format!("{control}, {style:?} {seed}"), held)
        }
    }
}

/// Does something for every item, on all processors.
fn on_all<T: Sync>(items: &[T], act: impl Fn(&T) + Sync) {
    let next = AtomicUsize::new(0);
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed)) {
                    act(item);
                }
            });
        }
    });
}

#[test]
fn the_law_fails_for_every_field_that_is_forgotten() {
    let trials = trials();
    let sum = Mutex::new((Counts::default(), BTreeSet::new()));
    on_all(&trials, |trial| {
        let (name, held) = hold(trial);
        let counts = held.unwrap_or_else(|why| panic!("{name}: {why}"));
        let mut sum = sum.lock().unwrap();
        sum.0.add(counts);
        sum.1.extend(asked());
    });
    let (counts, asked) = sum.into_inner().unwrap();
    let fields = state_fields();
    let unlisted: Vec<Field> = asked.into_iter().filter(|field| !fields.contains(field)).collect();
    assert!(unlisted.is_empty(), "fields that are joined and not listed: {unlisted:?}");

    let found = Mutex::new(Vec::new());
    on_all(&fields, |field| {
        let red = trials.iter().find_map(|trial| {
            let (name, held) = forgetting(*field, || hold(trial));
            held.is_err().then_some(name)
        });
        found.lock().unwrap().push((*field, red));
    });
    let mut found = found.into_inner().unwrap();
    found.sort_by_key(|(field, _)| fields.iter().position(|known| known == field));
    if let Some(path) = env::var_os("GCHECK_MUTATIONS") {
        fs::write(path, page(&found, &counts)).unwrap();
    }
    let is_excused = |field: &Field| UNSEEN.iter().any(|(owner, name, _)| (*owner, *name) == *field);
    let green: Vec<Field> = found
        .iter()
        .filter(|(field, red)| red.is_none() && !is_excused(field))
        .map(|(field, _)| *field)
        .collect();
    assert!(green.is_empty(), "forgotten, and no program shows it: {green:?}");
    let excused: Vec<Field> = found
        .iter()
        .filter(|(field, red)| red.is_some() && is_excused(field))
        .map(|(field, _)| *field)
        .collect();
    assert!(excused.is_empty(), "excused, though a program shows it: {excused:?}");
}

/// The table of `docs/dev/law-4.md`.
fn page(found: &[(Field, Option<String>)], counts: &Counts) -> String {
    let red = found.iter().filter(|(_, red)| red.is_some()).count();
    let mut page = format!(
        "# Law 4, and that it can fail\n\n\
        The analysis of all paths covers every run (`crates/gcheck-engine/tests/flow_covers_run`).\n\
        For this table each field of the machine's state was forgotten once where two states become one: the joined state \
        kept what the older of the two had.\n\
        The law must then fail for some program.\n\n\
        `cargo xtask mutations` makes this page; do not edit it.\n\n\
        | | |\n|---|---|\n\
        | programs | {} |\n| runs | {} |\n| states compared | {} |\n| moves compared | {} |\n\
        | fields | {} |\n| found when forgotten | {red} |\n\n\
        A program is one of `programs.rs` by its name, or a random one by control, style and number.\n\n\
        | field | law 4 | shown by |\n|---|---|---|\n",
        counts.programs,
        counts.runs,
        counts.states,
        counts.moves,
        found.len(),
    );
    for ((owner, name), red) in found {
        let (colour, by) = match red {
            Some(program) => ("red", program.clone()),
            None => {
                let excuse = UNSEEN.iter().find(|(a, b, _)| (a, b) == (owner, name));
                ("green", excuse.map_or("no program", |(_, _, reason)| reason).to_owned())
            }
        };
        let _ = writeln!(page, "| `{owner}.{name}` | {colour} | {by} |");
    }
    page
}
