//! How fast text becomes blocks. `cargo xtask bench` prints the same figures beside their budgets.

#![expect(clippy::unwrap_used, reason = "a measurement that meets the unexpected is to fail")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use gcheck_program::{Dialect, lower};
use gcheck_syntax::cut;
use gcheck_testkit::inputs;

fn throughput(c: &mut Criterion) {
    let control = gcheck_controls::load("haas-mill").unwrap();
    let dialect = Dialect::new(&control);
    let programs = [
        ("surfacing", inputs::surfacing(100_000)),
        ("drilling", inputs::drilling(100_000)),
        ("macros", inputs::macros(20_000)),
    ];
    let mut group = c.benchmark_group("tokens and blocks");
    group.sample_size(20);
    for (name, text) in &programs {
        let cuts = cut(text);
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(*name, |b| {
            b.iter(|| cuts.iter().map(|range| lower(&text[range.clone()], &dialect).len()).sum::<usize>());
        });
    }
    group.finish();
}

criterion_group!(benches, throughput);
criterion_main!(benches);
