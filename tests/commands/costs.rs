//! The model by which `--digits` chooses a number is what is measured.

use std::path::Path;
use vibro_audit::accuracy::{COSTS, Cost, costs, measured_costs};

fn as_text(rows: &[Cost]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).expect("a row");
    }
    String::from_utf8(writer.into_inner().expect("a table")).expect("text")
}

/// `VIBRO_AUDIT_BLESS=1 cargo test --test commands costs` rewrites the model from what is measured.
#[test]
fn the_model_of_costs_is_what_is_measured() {
    let measured = measured_costs().expect("costs");
    if std::env::var_os("VIBRO_AUDIT_BLESS").is_some() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/accuracy/costs.csv");
        std::fs::write(path, as_text(&measured)).expect("a file");
        return;
    }
    let golden = costs(COSTS).expect("a model");
    assert_eq!(golden.len(), measured.len());
    for (golden, measured) in golden.iter().zip(&measured) {
        assert_eq!(
            [&golden.task, &golden.method, &golden.number],
            [&measured.task, &measured.method, &measured.number]
        );
        // a function that rounds otherwise on another machine may change a step of Newton's method here and there
        let near = |a: u64, b: u64| a.abs_diff(b) as f64 <= 0.02 * b as f64;
        assert!(near(golden.operations, measured.operations), "{golden:?} {measured:?}");
        assert!(near(golden.cost, measured.cost), "{golden:?} {measured:?}");
        for (golden, measured) in [
            (golden.worst_digits, measured.worst_digits),
            (golden.median_digits, measured.median_digits),
            (golden.best_digits, measured.best_digits),
        ] {
            assert!((golden - measured).abs() < 0.3, "{golden} {measured}");
        }
    }
}
