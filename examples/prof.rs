use vibro_audit::claim::*;
fn main() {
    let v = read_symbols(include_str!("../golden/paper/symbols.toml")).unwrap_or_else(|e| panic!("{e}"));
    let sheet = Sheet::read(include_str!("../golden/paper/equations.toml"), &v).unwrap_or_else(|e| panic!("{e}"));
    let n = sheet.find(&std::env::args().nth(1).unwrap()).unwrap();
    for _ in 0..std::env::args().nth(2).unwrap().parse::<usize>().unwrap() {
        sheet.decide(n).unwrap();
    }
}
