use claims::Sheet;
use prover::{Options, decided, file_names, rocq};
use std::collections::BTreeMap;
fn main() {
    let mut args = std::env::args().skip(1);
    let dir = args.next().unwrap();
    std::fs::create_dir_all(&dir).unwrap();
    for (n, t) in rocq::LIBRARY {
        std::fs::write(format!("{dir}/{n}"), t).unwrap();
    }
    let mut reasons: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut all: BTreeMap<&str, usize> = BTreeMap::new();
    for path in args {
        let text = std::fs::read_to_string(&path).unwrap();
        let stem = std::path::Path::new(&path)
            .file_stem()
            .unwrap()
            .to_string_lossy()
            .replace('-', "_");
        let sheet = match Sheet::read(&text, &texmath::Symbols::default()) {
            Ok(s) => s,
            Err(e) => {
                eprintln!("{path}: {e}");
                continue;
            }
        };
        let positions: Vec<usize> = (0..sheet.entries.len())
            .filter(|&i| sheet.entries[i].role == claims::Role::Claim)
            .collect();
        let names = file_names(&sheet, &positions);
        for (position, name) in positions.iter().zip(&names) {
            for (n, one) in decided(&sheet, *position, &Options::default()).iter().enumerate() {
                let verdict = match one.found {
                    prover::Found::Proved { .. } => "proved",
                    _ => "refuted",
                };
                *all.entry(verdict).or_default() += 1;
                match rocq::file(one) {
                    Ok(text) => {
                        std::fs::write(format!("{dir}/c_{stem}_{}_{n}.v", name.replace(['.', '-'], "_")), text).unwrap()
                    }
                    Err(e) => reasons
                        .entry(format!("{verdict}: {e}"))
                        .or_default()
                        .push(format!("{stem}/{name}")),
                }
            }
        }
    }
    println!("{all:?}");
    for (r, l) in reasons {
        println!(
            "{:4} {r}: {}",
            l.len(),
            l.iter().take(6).cloned().collect::<Vec<_>>().join(" ")
        );
    }
}
