//! The rules by which claims are reduced to goals: each goal that is not the claim as read names one.

use crate::common::{attacks, sample};
use std::collections::HashMap;
use vibro_audit::claim::{
    Matched, Proposal, Proposals, Reduced, Rule, Sheet, Statements, other_ways, questions, reduced, reduced_by_cases,
    vocabulary,
};
use vibro_audit::kernel::term_value;
use vibro_audit::prove::integration::{antiderivative, known_integral, zeros};
use vibro_audit::prove::summation::{summation, telescoping};
use vibro_audit::prove::{Options, decide};
use vibro_audit::tex::{DoubtKind, Name, Names, Symbols, Tree, read_expression, rewrite};

struct First;

impl Proposals for First {
    fn antiderivative(&self, of: &Tree, by: &Name, symbols: &Symbols) -> Option<Tree> {
        antiderivative(of, by, symbols)
    }

    fn zeros(&self, of: &Tree, by: &Name, between: [&Tree; 2]) -> Vec<Tree> {
        zeros(of, by, between)
    }

    fn known_integral(&self, of: &Tree, by: &Name, limits: [&Tree; 2]) -> Option<Matched> {
        known_integral(of, by, limits)
    }

    fn telescoping(&self, term: &Tree, index: &Name, _: &Symbols) -> Option<Tree> {
        telescoping(term, index)
    }

    fn summation(&self, term: &Tree, index: &Name, symbols: &Symbols) -> Option<Proposal> {
        summation(term, index, symbols)
    }
}

/// The goals of a claim, with the rules that name how they came of it.
fn all_reductions(read: &Statements, sheet: &Sheet) -> Vec<Reduced> {
    let of_operations = reduced(read, &sheet.symbols, &First).ok().flatten();
    let statements = match &of_operations {
        Some(Reduced { sufficient, .. }) => sufficient.iter().map(|goal| &goal.statements).collect(),
        None => vec![read],
    };
    let by_cases = statements
        .iter()
        .filter_map(|own| reduced_by_cases(own, &sheet.symbols));
    by_cases
        .collect::<Vec<_>>()
        .into_iter()
        .chain(of_operations.clone())
        .collect()
}

#[test]
fn every_goal_that_is_not_the_claim_as_read_names_a_rule() {
    let mut texts: Vec<(String, String)> = attacks::sampled()
        .into_iter()
        .map(|attack| (attack.path(), attack.text))
        .collect();
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    texts.extend(
        ["tests/handbook/formulas.toml", "golden/oscillator/equations.toml"].map(|path| {
            let text = std::fs::read_to_string(root.join(path)).unwrap();
            (path.to_owned(), text)
        }),
    );
    let (mut goals, mut ways) = (0, 0);
    for (path, text) in texts {
        let Ok(sheet) = Sheet::read(&text, &vocabulary().unwrap()) else {
            continue;
        };
        for position in (0..sheet.entries.len()).filter(|&n| sheet.is_claim(n)) {
            let Ok(read) = Statements::gather(&sheet, position) else {
                continue;
            };
            // what tends to a value is left out, and nothing decided of it
            let tends = |kind: &DoubtKind| matches!(kind, DoubtKind::Tends(_));
            if sheet.doubts(position).iter().any(tends) {
                continue;
            }
            let label = format!("{path} ({})", sheet.entries[position].label);
            assert!(read.rules.is_empty(), "{label}");
            for reduced in all_reductions(&read, &sheet) {
                for goal in reduced
                    .lemmas
                    .iter()
                    .chain(&reduced.sufficient)
                    .chain(&reduced.necessary)
                {
                    let is_read = goal.statements.has_formulas_of(&read);
                    assert!(is_read || !goal.statements.rules.is_empty(), "{label}: {}", goal.part);
                    goals += 1;
                }
            }
            // of an inequality or a root, one goal of each way at least
            for way in other_ways(&read, &sheet.symbols).into_iter().flatten().flatten() {
                let is_read = way.iter().all(|goal| goal.statements.claims == read.claims);
                let is_one_claim = way.len() == 1 && read.claims.contains(&way[0].statements.claims[0]);
                let has_rule = way.iter().any(|goal| !goal.statements.rules.is_empty());
                assert!(is_read || is_one_claim || has_rule, "{label}");
                ways += 1;
            }
        }
    }
    let [most_goals, most_ways] = sample::of([400, 100], [200, 50]);
    assert!(goals > most_goals && ways > most_ways, "{goals} goals, {ways} ways");
}

fn rules_of(symbols: &str, tex: &str) -> String {
    let text = format!("[symbols]\n{symbols}\n[[equation]]\nlabel = 'a'\nrole = 'claim'\ntex = '{tex}'\n");
    let sheet = Sheet::read(&text, &vocabulary().unwrap()).unwrap();
    let decision = decide(&sheet, 0, &Options::default());
    format!("{}: {}", decision.verdict, decision.reductions())
}

#[test]
fn a_verdict_names_the_rules_that_it_rests_on() {
    let real = "parameters = ['x', 'y', 'n']\nintegers = ['n']\npositive = ['n']";
    for (tex, rules) in [
        (r"(x + 1)^2 = x^2 + 2 x + 1", "proved: "),
        (r"(x + 1)^2 = x^2 + 1", "refuted: "),
        (r"\int_0^x s^2 ds = \frac{x^3}{3}", "proved: integral: antiderivative"),
        (r"\int x^2 dx = \frac{x^3}{3}", "proved: integral: differentiated"),
        (r"\frac{d}{dx} x^2 = 2 x", "proved: derivative: rules"),
        (r"\frac{d}{dx} x^2 = x", "refuted: derivative: rules"),
        (r"\lim_{x \to 0} \frac{\sin x}{x} = 1", "proved: limit: series"),
        (r"\sum_{k=1}^{3} k = 6", "proved: sum: terms"),
        (
            r"\begin{pmatrix} x & 1 \end{pmatrix} = \begin{pmatrix} x & 1 \end{pmatrix}",
            "proved: matrix: entries",
        ),
    ] {
        assert_eq!(rules_of(real, tex), rules, "{tex}");
    }
    let closed = rules_of(real, r"\sum_{k=1}^{n} k = \frac{n (n + 1)}{2}");
    assert_eq!(closed, "proved: sum: telescoping");
    let induction = rules_of(real, r"\sum_{k=1}^{n} \frac{1}{k (k + 1)} = \frac{n}{n + 1}");
    assert!(
        induction.starts_with("proved: ") && induction.contains("sum: induction"),
        "{induction}"
    );
    let parts = rules_of("complex = ['z', 'w']", r"\overline{z w} = \bar z \bar w");
    assert!(
        parts.starts_with("proved: ") && parts.contains("complex: parts"),
        "{parts}"
    );
    let signs = rules_of(real, r"e^x \ge 1 + x");
    assert_eq!(signs, "proved: inequality: signs of derivatives");
    let bars = rules_of(real, r"|x + y| \le |x| + |y|");
    assert!(bars == "proved: " || bars.contains("modulus: "), "{bars}");
}

/// A rule has a name of its own: what it works on, and how.
#[test]
fn rules_have_different_names() {
    let some = [
        Rule::Definitions,
        Rule::SeriesInduction,
        Rule::IntegralAntiderivative,
        Rule::InverseRange,
    ];
    let names: std::collections::BTreeSet<String> = some.iter().map(ToString::to_string).collect();
    assert_eq!(names.len(), some.len());
    assert!(names.iter().all(|name| name.split_once(": ").is_some()));
}

/// No search, so that integrals of numbers are enclosed.
struct NoSearch;

impl Proposals for NoSearch {}

/// The value of a claim's larger side less the smaller one, with its integral enclosed; none where it is not.
fn enclosed(tex: &str) -> Option<f64> {
    let text = format!("[[equation]]\nlabel = 'a'\nrole = 'claim'\ntex = '{tex}'\n");
    let sheet = Sheet::read(&text, &Symbols::default()).unwrap();
    let statements = Statements::gather(&sheet, 0).unwrap();
    let reduced = reduced(&statements, &sheet.symbols, &NoSearch).ok()??;
    let goal = reduced.sufficient.first()?;
    let asked = questions(&goal.statements, &goal.symbols).ok()?;
    let statement = &asked.first()?.statement;
    let (_, term) = statement.goal()[0];
    let value = term_value::<f64>(statement.terms(), term, &mut HashMap::new())?;
    Some(value.low())
}

#[test]
fn each_row_of_the_table_of_integrals_holds_as_far_as_integrals_are_enclosed() {
    let table = include_str!("../../crates/claims/src/reduce/integrals.txt");
    let mut open = Vec::new();
    for line in table.lines().filter(|line| !line.starts_with('#')) {
        let parts: Vec<&str> = line.split('|').map(str::trim).collect();
        let [limits, of, value, conditions, source] = parts[..] else {
            panic!("{line}");
        };
        assert!(!source.is_empty(), "{line}");
        let (low, high) = limits.split_once(" to ").unwrap();
        // a and b as numbers that meet the conditions
        let numbers = if conditions.contains("a < 0") {
            ["-0.3", "0"]
        } else {
            ["1.3", "0.7"]
        };
        let names = Names::default();
        let with = |tex: &str| {
            let tree = read_expression(tex, &names).unwrap();
            let number = |name: &Name| {
                let place = ["a", "b"].into_iter().position(|letter| *name == Name::plain(letter))?;
                Some(read_expression(numbers[place], &names).unwrap())
            };
            rewrite(&tree, &number).to_string()
        };
        let (of, value) = (with(of), with(value));
        let integral = format!(r"\int_{{{low}}}^{{{high}}} ({of}) \, dx");
        let bounds = [
            enclosed(&format!(r"{integral} > ({value}) - \frac{{1}}{{200}}")),
            enclosed(&format!(r"({value}) + \frac{{1}}{{200}} > {integral}")),
        ];
        match bounds {
            [Some(below), Some(above)] => assert!(below > 0.0 && above > 0.0, "{line}: {below}, {above}"),
            _ => open.push(of),
        }
    }
    // those that converge without their absolute values
    assert_eq!(open.len(), 4, "{open:?}");
}
