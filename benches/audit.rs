//! What an audit costs: the refutation of (22) as printed, the reader of TeX, a whole sheet, the evidence. The proof
//! of (22) as mended is in figures.rs.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use vibro_audit::claim::{self, Sheet, Verdict};
use vibro_audit::evidence::witness;
use vibro_audit::prove::{self, Options};
use vibro_audit::tex::read;

fn audit(criterion: &mut Criterion) {
    let symbols = claim::vocabulary().expect("the embedded vocabulary");
    let printed = claim::paper().expect("the embedded sheet");
    let wrong = printed.find("22").expect("an equation of the paper");
    let options = Options::default();
    assert_eq!(prove::decide(&printed, wrong, &options).verdict, Verdict::Refuted);
    criterion.bench_function("refute (22), printed", |b| {
        b.iter(|| prove::decide(&printed, black_box(wrong), &options))
    });
    let tex = &printed.entries[wrong].tex.tex;
    criterion.bench_function("read the TeX of (22)", |b| {
        b.iter(|| read(black_box(tex), &symbols.names))
    });
    criterion.bench_function("read and decide the paper", |b| {
        b.iter(|| Sheet::read(black_box(claim::EQUATIONS), &symbols).map(|sheet| prove::audit(&sheet, &options)))
    });
    criterion.bench_function("evidence for (22), six points", |b| {
        b.iter(|| witness(&printed, black_box(wrong), Verdict::Refuted, 6))
    });
}

criterion_group!(benches, audit);
criterion_main!(benches);
