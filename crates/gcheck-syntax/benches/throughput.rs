//! How fast text becomes tokens and trees. `cargo xtask bench` prints the same figures beside their budgets.

#![expect(clippy::indexing_slicing, reason = "the ranges are those of the chunks")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use gcheck_syntax::{Document, SyntaxProfile, count_tokens, cut, parse};
use gcheck_testkit::inputs;

fn throughput(c: &mut Criterion) {
    let text = inputs::surfacing(100_000);
    let cuts = cut(&text);
    let mut group = c.benchmark_group("surfacing, 100,000 lines");
    group.sample_size(20).throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("tokens", |b| b.iter(|| count_tokens(&text, false)));
    group.bench_function("cut", |b| b.iter(|| cut(&text)));
    group.finish();

    let chunk = &text[cuts[cuts.len() / 2].clone()];
    let mut group = c.benchmark_group("one chunk");
    group.throughput(Throughput::Bytes(chunk.len() as u64));
    group.bench_function("tree", |b| b.iter(|| parse(chunk, SyntaxProfile::MACRO_B)));
    group.finish();

    let document = Document::new(&text);
    let middle = text.len() / 2;
    c.bench_function("edit in the middle", |b| b.iter(|| document.clone().edit(middle..middle, "G1 ")));
}

criterion_group!(benches, throughput);
criterion_main!(benches);
