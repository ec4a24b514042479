use vibro_audit::claim::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let v = read_symbols(include_str!("../golden/paper/symbols.toml")).unwrap_or_else(|e| panic!("{e}"));
    let sheet = Sheet::read(&std::fs::read_to_string(&a[1]).unwrap(), &v).unwrap_or_else(|e| panic!("{e}"));
    let n = sheet.find(&a[2]).unwrap();
    let t = std::time::Instant::now();
    let k = a[3].parse::<u32>().unwrap();
    for _ in 0..k {
        sheet.decide(n).unwrap();
    }
    println!("{:?}", t.elapsed() / k);
}
