use vibro_audit::claim::*;
fn main() {
    let v = read_symbols(include_str!("../golden/paper/symbols.toml")).unwrap_or_else(|e| panic!("{e}"));
    let text = match std::env::args().nth(1) {
        Some(f) => std::fs::read_to_string(f).unwrap(),
        None => include_str!("../golden/paper/equations.toml").to_string(),
    };
    let sheet = Sheet::read(&text, &v).unwrap_or_else(|e| panic!("{e}"));
    for (n, e) in sheet.entries.iter().enumerate() {
        if e.role != Role::Claim {
            continue;
        }
        let t = std::time::Instant::now();
        let d = sheet.decide(n);
        let t = t.elapsed();
        match d {
            Ok(d) => println!(
                "{:14} {} {:?} {}\n    {}",
                d.label,
                d.verdict,
                t,
                d.reason,
                d.counterexample.map(|c| c.to_string()).unwrap_or_default()
            ),
            Err(e2) => println!("{} ERROR {e2}", e.label),
        }
    }
}
