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
        let symbols = if path.contains("golden/paper") { claims::vocabulary().unwrap() } else { texmath::Symbols::default() };
        let sheet = match Sheet::read(&text, &symbols) {
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
                if std::env::var("DUMP").is_ok() { dump(one); }
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

fn dump(one: &prover::Decided) {
    use kernel::*;
    println!("==== {} {} [{}] {}", one.label, one.printed, one.question.instance, one.question.equation);
    let (st, steps): (Statement, Vec<Inference>) = match &one.found {
        prover::Found::Proved { certificate, .. } => (certificate.statement.clone(), certificate.evidence.steps.clone()),
        prover::Found::Refuted { witness } => (witness.statement.clone(), vec![]),
    };
    let show = |t: Term| prover_show(&st, t);
    for (n, g) in st.givens().iter().enumerate() {
        println!("G{n} [{}] {:?} {}", g.origin, g.property, show(g.term));
        if let Some(l) = &g.law { println!("     law time {:?} flight {:?} every {} cond {:?}", l.time.map(|s| st.terms().symbol_name(s).to_owned()), l.flight, l.every_impact, l.conditions.iter().map(|(p, t)| format!("{p:?} {}", show(*t))).collect::<Vec<_>>()); }
    }
    for (p, t) in st.goal() { println!("GOAL {p:?} {}", show(*t)); }
    for (s, t) in st.definitions() { println!("DEF {} = {}", st.terms().symbol_name(*s), show(*t)); }
    for m in st.maps() {
        let n = |v: &Vec<Symbol>| v.iter().map(|s| st.terms().symbol_name(*s).to_owned()).collect::<Vec<_>>().join(", ");
        println!("MAP {} of {} by {}", m.name, n(&m.of), n(&m.by));
        for (o, t) in &m.equations { println!("    eq [{o}] {}", show(*t)); }
        for (p, t) in &m.conditions { println!("    cond {p:?} {}", show(*t)); }
    }
    for m in st.outright_maps() { println!("OUTRIGHT {}", m.name); }
    for (n, q) in st.quantities().iter().enumerate() { println!("  q{n} {} {:?}", st.terms().symbol_name(Symbol(n as u32)), q); }
    for (n, q) in st.functions().iter().enumerate() { println!("  f{n} {} {:?}", st.terms().function_name(Function(n as u32)), q); }
    println!("times {:?} flight {:?} letter {}", st.times(), st.flight(), st.letter());
    fn walk(steps: &[Inference], st: &Statement, d: usize) {
        for s in steps {
            let text = match s {
                Inference::Zero { terms, .. } => format!("Zero from {:?}", terms.iter().map(|t| t.1).collect::<Vec<_>>()),
                Inference::Law { source, at } => format!("Law {source:?} at {}", at.map_or("-".into(), |t| prover_show(st, t))),
                Inference::Constant { of, time, at, flight, .. } => format!("Constant of {} time {} at {} flight {flight:?}", prover_show(st, *of), st.terms().symbol_name(*time), prover_show(st, *at)),
                Inference::Along { map, equation, by } => format!("Along {map} {equation} by {}", st.terms().symbol_name(*by)),
                Inference::Axiom(a) => format!("Axiom {} {:?}", a.name, a.terms.iter().map(|t| prover_show(st, *t)).collect::<Vec<_>>()),
                s => { let t = format!("{s:?}"); t.chars().take(60).collect() }
            };
            println!("{}- {text}", "  ".repeat(d));
            let w: Vec<Inference> = s.within().into_iter().cloned().collect();
            walk(&w, st, d + 1);
        }
    }
    walk(&steps, &st, 0);
}

fn prover_show(st: &kernel::Statement, t: kernel::Term) -> String {
    use kernel::*;
    let of = |t: &Term| prover_show(st, *t);
    match st.terms().node(t) {
        Node::Number(v) => v.to_string(),
        Node::Symbol(s) => st.terms().symbol_name(*s).to_owned(),
        Node::Sum(p) => format!("({})", p.iter().map(of).collect::<Vec<_>>().join(" + ")),
        Node::Product(p) => format!("({})", p.iter().map(of).collect::<Vec<_>>().join("*")),
        Node::Power(b, e) => format!("{}^{e}", of(b)),
        Node::Quotient(a, b) => format!("({}/{})", of(a), of(b)),
        Node::Elementary(f, a) => format!("{f:?}({})", of(a)),
        Node::Value(f, o, a) => format!("{}#{}<{o}>({})", st.terms().function_name(*f), f.0, of(a)),
        Node::RealPower(a, b) => format!("{}^^{}", of(a), of(b)),
        n => format!("{n:?}"),
    }
}
