//! What an audit costs: the proof of (22) as mended, the refutation of (22) as printed, the reader of TeX, a whole
//! sheet, the evidence.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use vibro_audit::claim::{self, Sheet, Verdict};
use vibro_audit::evidence::witness;
use vibro_audit::tex::read;

/// The paper's sheet with the three misprints of (22) mended.
fn mended() -> String {
    claim::EQUATIONS
        .replace(r"[r_B + r_B T_1(f", r"[r_B \epsilon_1 + r_B T_1(f")
        .replace(r"[r_T - r_T T_2(f", r"[r_T \epsilon_2 - r_T T_2(f")
        .replace(
            r"\overline{g} T_1 + \dot{Z}_k r_B'''",
            r"\overline{g} T_1 - \dot{Z}_k r_B'''",
        )
}

fn audit(criterion: &mut Criterion) {
    let vocabulary = claim::vocabulary().expect("the embedded vocabulary");
    let printed = claim::paper().expect("the embedded sheet");
    let mended = Sheet::read(&mended(), &vocabulary).expect("the mended sheet");
    let position = |sheet: &Sheet, label: &str| sheet.find(label).expect("an equation of the paper");
    let (right, wrong) = (position(&mended, "22"), position(&printed, "22"));
    assert_eq!(mended.decide(right).expect("a decision").verdict, Verdict::Proved);
    assert_eq!(printed.decide(wrong).expect("a decision").verdict, Verdict::Refuted);
    criterion.bench_function("prove (22), mended", |b| b.iter(|| mended.decide(black_box(right))));
    criterion.bench_function("refute (22), printed", |b| b.iter(|| printed.decide(black_box(wrong))));
    let tex = &printed.entries[wrong].tex.tex;
    criterion.bench_function("read the TeX of (22)", |b| {
        b.iter(|| read(black_box(tex), &vocabulary.names))
    });
    criterion.bench_function("read and decide the paper", |b| {
        b.iter(|| Sheet::read(black_box(claim::EQUATIONS), &vocabulary).map(|sheet| sheet.audit()))
    });
    criterion.bench_function("evidence for (22), six points", |b| {
        b.iter(|| witness(&printed, black_box(wrong), Verdict::Refuted, 6))
    });
}

criterion_group!(benches, audit);
criterion_main!(benches);
