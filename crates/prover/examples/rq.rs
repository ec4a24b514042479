use claims::Sheet;
use prover::{Options, decided, file_names, rocq};
use std::collections::BTreeMap;
fn main() {
    let mut args = std::env::args().skip(1);
    let dir = args.next().unwrap();
    std::fs::create_dir_all(&dir).unwrap();
    for (n, t) in rocq::LIBRARY { std::fs::write(format!("{dir}/{n}"), t).unwrap(); }
    let mut reasons: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for path in args {
        let is_paper = path == "--paper";
        let text = if is_paper { claims::EQUATIONS.to_owned() } else { std::fs::read_to_string(&path).unwrap() };
        let symbols = if is_paper || path.contains("/at/") { claims::vocabulary().unwrap() } else { texmath::Symbols::default() };
        let stem = std::path::Path::new(&path).file_stem().unwrap().to_string_lossy().replace('-', "_");
        let sheet = match Sheet::read(&text, &symbols) { Ok(s) => s, Err(e) => { eprintln!("{path}: {e}"); continue } };
        let positions: Vec<usize> = sheet.rows();
        let names = file_names(&sheet, &positions);
        for (position, name) in positions.iter().zip(&names) {
            let all = decided(&sheet, *position, &Options::default());
            let Some(first) = all.first() else { continue };
            let verdict = match first.found { prover::Found::Proved { .. } => "proved", _ => "refuted" };
            *counts.entry(verdict).or_default() += 1;
            for (n, one) in rocq::files(&sheet, *position, &all).into_iter().enumerate() {
                match one {
                    Ok(text) => std::fs::write(format!("{dir}/c_{}_{}_{n}.v", stem.trim_start_matches('_'), name.replace(['.', '-'], "_")), text).unwrap(),
                    Err(e) => reasons.entry(format!("{verdict}: {e}")).or_default().push(format!("{stem}/{name}")),
                }
            }
        }
    }
    println!("{counts:?}");
    for (r, l) in reasons { println!("{:4} {r}: {}", l.len(), l.iter().take(6).cloned().collect::<Vec<_>>().join(" ")); }
}
