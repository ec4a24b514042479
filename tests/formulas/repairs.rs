//! Repairs of refuted claims: misprints made of true formulas are mended to what they were made of.

use crate::common::mutants;
use crate::common::paper;
use crate::common::trees;

use paper::{Bench, PAPER, display, vocabulary};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Instant;
use vibro_audit::claim::{Document, Entry, Markup, Sheet, Verdict};
use vibro_audit::evidence::witness;
use vibro_audit::prove::{self, Options};
use vibro_audit::repair::{Part, Repair, parts, repairs, reprinted};
use vibro_audit::tex::{Equation, Symbols, Tree};

/// A sheet, and one of its formulas as it stands there and misprinted.
struct Misprint {
    name: String,
    sheet: Arc<Sheet>,
    position: usize,
    part: Part,
    right: Equation,
    wrong: Equation,
}

impl Misprint {
    /// The sheet with the formula as an author misprints it: in its text.
    fn printed(&self) -> Option<Sheet> {
        let entry = &self.sheet.entries[self.position];
        let sheet = reprinted(&self.sheet, self.position, &[(self.part, self.wrong.clone())])?.sheet;
        let is_alike = sheet.entries.get(self.position).is_some_and(|new| {
            new.unread.is_none() && new.equations.len() == entry.equations.len() && new.local.len() == entry.local.len()
        });
        is_alike.then_some(sheet)
    }
}

fn nodes(tree: &Tree) -> usize {
    1 + parts(tree).iter().map(nodes).sum::<usize>()
}

fn length(equation: &Equation) -> usize {
    nodes(&equation.left) + nodes(&equation.right)
}

fn flat(equation: &Equation) -> [Tree; 2] {
    [trees::flat(&equation.left), trees::flat(&equation.right)]
}

/// Every single edit of a formula of the claim at a position of a sheet.
fn misprints_of(name: &str, sheet: &Arc<Sheet>, position: usize, into: &mut Vec<Misprint>) {
    let entry = &sheet.entries[position];
    let stated = entry
        .equations
        .iter()
        .enumerate()
        .map(|(n, equation)| (Part::Stated(n), equation));
    // the side that a link shares with the one before it is misprinted there
    let shares = |part: Part| match part {
        Part::Stated(n @ 1..) => entry.equations[n].at.0 < entry.equations[n - 1].end.0,
        _ => false,
    };
    let local = entry
        .local
        .iter()
        .enumerate()
        .map(|(n, (equation, _))| (Part::Definition(n), equation));
    for (part, right) in stated.chain(local) {
        let gives = matches!(&right.left, Tree::Symbol(name, _) if entry.gives().contains(name));
        for wrong in mutants::edited(right, !gives && entry.label != "19") {
            if shares(part) && wrong.left != right.left {
                continue;
            }
            into.push(Misprint {
                name: format!("{name} ({})", entry.label),
                sheet: Arc::clone(sheet),
                position,
                part,
                right: right.clone(),
                wrong,
            });
        }
    }
}

/// The misprints of the paper's true claims, (16) and (22) as mended.
fn of_the_paper() -> Vec<Misprint> {
    let bench = Bench::new();
    let mut all = Vec::new();
    for claim in bench.claims() {
        // one equation of several is decided alone where it can be
        let equations = bench.read(&claim.tex);
        let alone: Vec<Vec<Equation>> = match claim.label {
            "19" => vec![equations],
            _ => equations.into_iter().map(|equation| vec![equation]).collect(),
        };
        for equations in alone {
            let text = bench.sheet(claim.label, &display(&equations), &claim.local);
            let sheet = Arc::new(Sheet::read(&text, &bench.symbols).unwrap());
            let position = sheet.find("claim").unwrap();
            misprints_of(&format!("paper ({})", claim.label), &sheet, position, &mut all);
        }
    }
    all
}

/// The misprints of the claims of other sheets and documents that are proved.
fn of_others() -> Vec<Misprint> {
    let document = |text: &str| {
        let document = Document::read(text, Markup::Tex, &mut |_| Err("nothing is included".to_owned()));
        document.sheet(&Symbols::default()).unwrap()
    };
    let oscillator = include_str!("../../golden/oscillator/equations.toml");
    let sheets = [
        ("oscillator", Sheet::read(oscillator, &vocabulary()).unwrap()),
        ("bouncing ball", document(include_str!("../papers/bouncing_ball.tex"))),
        (
            "impact oscillator",
            document(include_str!("../papers/impact_oscillator.tex")),
        ),
        (
            "rigid body, optics",
            document(include_str!("../papers/rigid_body_optics.tex")),
        ),
    ];
    let mut all = Vec::new();
    for (name, sheet) in sheets {
        let sheet = Arc::new(sheet);
        for position in sheet.rows() {
            misprints_of(name, &sheet, position, &mut all);
        }
    }
    all
}

/// Some of a list, the same ones each time.
/// A number of misprints: the first where corpora are run whole.
fn one_of(all: usize, some: usize) -> usize {
    crate::common::sample::of(all, some)
}

fn sample<T>(mut list: Vec<T>, count: usize, mut seed: u64) -> Vec<T> {
    let mut kept = Vec::new();
    while kept.len() < count && !list.is_empty() {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        kept.push(list.swap_remove((seed >> 33) as usize % list.len()));
    }
    kept
}

/// The size of the smallest edits.
const SMALLEST: u32 = 11;

/// What came of the repair of misprints.
#[derive(Default, Debug)]
struct Shares {
    refuted: usize,
    /// Repairs that are shown, all true as shown.
    shown: usize,
    /// The original, or a formula no longer than it, which is proved to be equal to it.
    first: usize,
    among_five: usize,
    /// Another edit that is as small as any makes the formula true as well: nothing tells which was meant.
    open: usize,
    none: usize,
    seconds: Vec<f64>,
    missed: Vec<String>,
}

fn is_meant(repair: &Repair, misprint: &Misprint) -> bool {
    repair.mended.iter().all(|(part, equation)| {
        *part == misprint.part
            && (flat(equation) == flat(&misprint.right) || length(equation) <= length(&misprint.right))
    })
}

/// Whether the formula was proved before it was misprinted.
fn is_true(misprint: &Misprint) -> bool {
    prove::decide(&misprint.sheet, misprint.position, &Options::default()).verdict == Verdict::Proved
}

fn measured(misprints: &[Misprint]) -> Shares {
    let (next, shares) = (AtomicUsize::new(0), Mutex::new(Shares::default()));
    let work = || {
        while let Some(misprint) = misprints.get(next.fetch_add(1, Ordering::Relaxed)) {
            let options = Options::default();
            let Some(sheet) = misprint.printed() else { continue };
            let decision = prove::decide(&sheet, misprint.position, &options);
            // what is compared with printed figures has no repairs
            let printed = &sheet.entries[misprint.position].tex.tex;
            if decision.verdict != Verdict::Refuted || printed.contains(r"\approx") || !is_true(misprint) {
                continue;
            }
            let start = Instant::now();
            let found = repairs(&sheet, misprint.position, &options).found;
            let seconds = start.elapsed().as_secs_f64();
            for repair in &found {
                assert_is_true_as_shown(repair, &sheet, misprint);
            }
            let place = found.iter().position(|repair| is_meant(repair, misprint));
            let mut shares = shares.lock().unwrap();
            shares.refuted += 1;
            shares.shown += found.len();
            shares.seconds.push(seconds);
            match place {
                Some(0) => shares.first += 1,
                None if found.is_empty() => shares.none += 1,
                // one sign, name or digit as well
                _ if found[0].edits.len() == 1 && found[0].size <= SMALLEST => shares.open += 1,
                _ => {}
            }
            shares.among_five += usize::from(place.is_some());
            if place != Some(0) {
                let shown: Vec<String> = found
                    .iter()
                    .map(|repair| format!("\n      {repair} [{}]", repair.size))
                    .collect();
                shares.missed.push(format!(
                    "{} {seconds:.2} s\n    wrong {}\n    right {}{}",
                    misprint.name,
                    misprint.wrong,
                    misprint.right,
                    shown.concat()
                ));
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(work);
        }
    });
    let mut shares = shares.into_inner().unwrap();
    shares.seconds.sort_by(f64::total_cmp);
    shares
}

/// Points at which a repair is tried beside its proof.
const POINTS: usize = 8;

/// Reads a repair from what is shown of it, by a search for its texts in the file that is not the gate's, and decides it anew.
fn assert_is_true_as_shown(repair: &Repair, wrong: &Sheet, misprint: &Misprint) {
    let entry = &wrong.entries[misprint.position];
    let shown = repair.to_string();
    let mut texts = shown.trim_matches('$').split("$, $");
    let is_stated = repair.mended.iter().any(|(part, _)| matches!(part, Part::Stated(_)));
    let tex = if is_stated {
        texts.next().unwrap()
    } else {
        &entry.tex.tex
    };
    let mut changed: Vec<String> = Vec::new();
    for (part, _) in &repair.mended {
        if let Part::Definition(n) = part
            && !changed.contains(&entry.local[*n].1.tex)
        {
            changed.push(entry.local[*n].1.tex.clone());
        }
    }
    let local: Vec<(String, String)> = changed.into_iter().zip(texts.map(str::to_owned)).collect();
    let sheet = wrong.reprinted(misprint.position, tex, &local).unwrap();
    let decision = prove::decide(&sheet, misprint.position, &Options::default());
    assert_eq!(decision.verdict, Verdict::Proved, "{}: {shown}", misprint.name);
    let evidence = witness(&sheet, misprint.position, Verdict::Proved, POINTS).unwrap();
    assert_eq!(evidence.against, None, "{}: {shown}", misprint.name);
    let conditions = |entry: &Entry| entry.assume.len();
    assert_eq!(
        conditions(&sheet.entries[misprint.position]),
        conditions(entry),
        "{shown}"
    );
}

fn print(name: &str, shares: &Shares) {
    let of = |count: usize| 100.0 * count as f64 / shares.refuted.max(1) as f64;
    let median = shares
        .seconds
        .get(shares.seconds.len() / 2)
        .copied()
        .unwrap_or_default();
    let most = shares.seconds.last().copied().unwrap_or_default();
    println!("{}", shares.missed.join("\n"));
    println!(
        "{name}: {} misprints refuted, {} repairs shown, each true as shown; mended first {:.1}%, among five {:.1}%; not first, but another true formula by one of the smallest edits {}; no repair {}; {median:.3} s each, at most {most:.2} s",
        shares.refuted,
        shares.shown,
        of(shares.first),
        of(shares.among_five),
        shares.open,
        shares.none
    );
}

fn assert_shares(name: &str, misprints: &[Misprint], first: f64, among_five: f64) {
    let shares = measured(misprints);
    print(name, &shares);
    let of = |count: usize| 100.0 * count as f64 / shares.refuted as f64;
    assert!(
        of(shares.first) >= first && of(shares.among_five) >= among_five,
        "{name}: {} of {} first, {} among five",
        shares.first,
        shares.refuted,
        shares.among_five
    );
}

#[test]
fn single_misprints_of_the_paper_are_mended() {
    // samples of 60 give 86% to 98%
    assert_shares("paper", &sample(of_the_paper(), one_of(60, 14), 16), 80.0, 85.0);
}

#[test]
fn single_misprints_of_other_sheets_are_mended() {
    assert_shares("others", &sample(of_others(), one_of(60, 16), 22), 90.0, 90.0);
}

#[test]
#[ignore = "minutes: for .ci/long"]
fn every_single_misprint_of_the_paper_is_mended() {
    assert_shares("paper, all", &of_the_paper(), 97.0, 97.0);
}

#[test]
#[ignore = "minutes: for .ci/long"]
fn many_misprints_of_other_sheets_are_mended() {
    assert_shares("others, many", &sample(of_others(), 600, 7), 95.0, 97.0);
}

#[test]
fn no_repair_says_nothing_and_none_is_given_twice() {
    let claims = [
        r"|x + y| = |x| + |y|",
        r"\sqrt{x^2} = x",
        r"\arctan x = \frac{1}{\arctan x}",
        r"x^2 = x",
        r"\pi \approx 3.15",
        r"\sin 2x = \sin x \cos x",
    ];
    let mut tex = "[symbols]\nparameters = ['x', 'y']\n".to_owned();
    for (number, claim) in claims.iter().enumerate() {
        tex.push_str(&format!(
            "[[equation]]\nlabel = '{number}'\nrole = 'claim'\ntex = '{claim}'\n"
        ));
    }
    let sheet = Sheet::read(&tex, &vocabulary()).unwrap();
    for (position, claim) in claims.iter().enumerate() {
        let shown: Vec<String> = repairs(&sheet, position, &Options::default())
            .found
            .iter()
            .map(|repair| repair.to_string())
            .collect();
        let mut different = shown.clone();
        different.sort();
        different.dedup();
        assert_eq!(different.len(), shown.len(), "{shown:?}");
        for repair in &shown {
            let (left, right) = repair.trim_matches('$').split_once(" = ").expect("an equation");
            assert_ne!(left, right);
            assert!(repair.contains(['x', 'y']), "{repair}");
            assert!(!repair.contains("3.15"), "{repair}");
        }
        // what only a factor would mend that says nothing has none
        let has_none = ["approx", "arctan", "x^2 = x"].iter().any(|own| claim.contains(own));
        assert_eq!(shown.is_empty(), has_none, "{claim}: {shown:?}");
    }
}

#[test]
fn a_forgotten_chain_rule_a_digit_bars_and_a_logarithm_are_mended_first() {
    let cases = [
        (
            r"\frac{d}{dx} \sin(x^2) = \cos(x^2)",
            r"\frac{d}{dx} [\sin(x^2)] = \cos(x^2) \cdot 2 x",
        ),
        (
            r"\int_0^k x^2 \, dx = \frac{k^3}{5}",
            r"\int_{0}^{k} x^2 \, dx = \frac{k^3}{3}",
        ),
        (
            r"\int_{-L/2}^{L/2} a x^2 \, dx = \frac{a L^3}{21}",
            r"\int_{-\frac{L}{2}}^{\frac{L}{2}} a x^2 \, dx = \frac{a L^3}{12}",
        ),
        (r"\sqrt{x^2} = x", r"\sqrt{x^2} = \left|x\right|"),
        (
            r"\ln\frac{k}{m} = \frac{\ln k}{\ln m}",
            r"\ln(\frac{k}{m}) = \ln(k) - \ln(m)",
        ),
        (
            r"(\frac{-m}{k + m})^2 + \frac{4 k m}{(k + m)^2} = 1",
            r"(\frac{k - m}{k + m})^2 + \frac{4 k m}{(k + m)^2} = 1",
        ),
    ];
    let mut tex = "[symbols]\nparameters = ['x', 'a', 'L', 'k', 'm']\npositive = ['k', 'm']\n".to_owned();
    for (number, (claim, _)) in cases.iter().enumerate() {
        tex.push_str(&format!(
            "[[equation]]\nlabel = '{number}'\nrole = 'claim'\ntex = '{claim}'\n"
        ));
    }
    let sheet = Sheet::read(&tex, &vocabulary()).unwrap();
    for (position, (claim, wanted)) in cases.iter().enumerate() {
        let first = repairs(&sheet, position, &Options::default())
            .found
            .first()
            .map(ToString::to_string);
        assert_eq!(first.as_deref(), Some(&*format!("${wanted}$")), "{claim}");
    }
}

#[test]
fn what_is_missing_beside_sums_series_moduli_determinants_and_a_turned_relation_are_mended_first() {
    let cases = [
        (r"\sum_{j = 1}^{n} j = \frac{n n}{2}", "n n + n"),
        (r"\sum_{j = 1}^{n} j^2 = \frac{n (2 n + 1)}{6}", "(1 + n)"),
        (r"e^{-a x} = -a x + O(x^2)", "= 1 - a x"),
        (r"\left| 1 - x e^{i a} \right|^2 = 1 - 2 x \cos a", "+ x^2"),
        (
            r"\det \begin{pmatrix} 1 - x & 1 \\ a & L - x \end{pmatrix} = -(1 + L) x + L - a",
            "(1 + L - x) x",
        ),
        (r"k^2 + m^2 \le 2 k m", r"\ge"),
    ];
    let mut tex = "[symbols]\nparameters = ['x', 'a', 'L', 'k', 'm']\nintegers = ['n']\n".to_owned();
    for (number, (claim, _)) in cases.iter().enumerate() {
        tex.push_str(&format!(
            "[[equation]]\nlabel = '{number}'\nrole = 'claim'\nassume = ['n \\ge 1']\ntex = '{claim}'\n"
        ));
    }
    let sheet = Sheet::read(&tex, &vocabulary()).unwrap();
    for (position, (claim, wanted)) in cases.iter().enumerate() {
        let found = repairs(&sheet, position, &Options::default()).found;
        let first = found.first().map(ToString::to_string).unwrap_or_default();
        assert!(first.contains(wanted), "{claim}: {first}");
    }
}

#[test]
fn what_is_missing_in_a_side_or_an_argument_is_mended_first() {
    let cases = [
        (
            r"\frac{k m^2}{12} + \frac{k m^2}{4} = \frac{1}{3}",
            r"\frac{k m^2}{12} + \frac{k m^2}{4} = \frac{k m^2}{3}",
        ),
        (r"\cos x = \sin x", r"\cos(x) = \sin(x + \frac{\pi}{2})"),
        (r"\frac{x - x^2}{x - 1} = 1", r"\frac{x - x^2}{x - 1} = -x"),
    ];
    for (claim, wanted) in cases {
        let text = format!(
            "[symbols]\nparameters = ['x', 'k', 'm']\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = '{claim}'\n"
        );
        let sheet = Sheet::read(&text, &vocabulary()).unwrap();
        let found = repairs(&sheet, 0, &Options::default()).found;
        let first = found.first().map(ToString::to_string).unwrap_or_default();
        assert_eq!(first, format!("${wanted}$"), "{claim}");
    }
}

#[test]
fn the_two_wrong_formulas_of_the_paper_are_mended_by_search() {
    let sheet = Sheet::read(PAPER, &vocabulary()).unwrap();
    let of = |label: &str| repairs(&sheet, sheet.find(label).unwrap(), &Options::default()).found;
    let sixteen = of("16");
    assert_eq!(
        sixteen[0].to_string(),
        r"$\dot{Z}_k = \frac{1}{r_B T_1} [d + \frac{\overline{g}}{2} T_1^2 + F_2(t_{k+1}) - F_2(t_k) - F_1(t_k) T_1]$"
    );
    assert_eq!(sixteen[0].words(), "the term `F_1(t_k) T_1` belongs inside the bracket");
    let twenty_two = of("22");
    let first = twenty_two.first().expect("a repair of (22)");
    assert_eq!(first.edits.len(), 3);
    let shown = first.to_string();
    assert!(
        shown.contains(r"r_B \epsilon_1 + r_B T_1") && shown.contains(r"r_T \epsilon_2 - r_T T_2"),
        "{shown}"
    );
    assert!(
        shown.contains(r"\epsilon_4 = f(t_k) T_1 + \overline{g} T_1 - \dot{Z}_k r_B"),
        "{shown}"
    );
}

/// Claims with what stands around an equation, and what their repairs must keep and may not be.
const SHOWN_WHOLE: [(&str, &str, &str); 9] = [
    (r"\frac{d}{dx} e^x = e^{-x}", "", r"= e^{-x}$"),
    (
        r"\sqrt{x^2} = -x, \quad \text{for } x > 0.",
        r"\quad \text{for } x > 0$",
        "0.$",
    ),
    (r"x = 2 \Rightarrow x^2 = 5", r"x = 2 \Rightarrow ", r"$x^2"),
    (
        r"x^2 = 4 \Leftrightarrow x = \pm 3",
        r"\Leftrightarrow x = \pm 3$",
        "- (x - 3)",
    ),
    (r"(x + y)^2 = x^2 + y^2 = (y + x)^2", "", r"= x^2 + y^2 ="),
    (r"e^x e^y = e^{x y}", "", r"\frac{e}{e}"),
    (r"a^0 = 0", "a^0", "a^0 = 0"),
    (
        r"\text{for all } x > 0: \ \sqrt{x^2} = -x",
        r"\text{for all } x > 0",
        r"$\sqrt",
    ),
    (
        r"\ln(x^2) = \ln x \quad (x > 0)",
        r"\quad (x > 0)$",
        r"$\ln(x^2) = 2 \ln(x)$",
    ),
];

#[test]
fn a_repair_is_shown_whole_and_is_no_other_spelling() {
    for (claim, kept, never) in SHOWN_WHOLE {
        let text = format!(
            "[symbols]\nparameters = ['x', 'y', 'a']\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = '{claim}'\n"
        );
        let sheet = Sheet::read(&text, &vocabulary()).unwrap();
        let rows = sheet.rows();
        for position in rows {
            let decision = prove::decide(&sheet, position, &Options::default());
            if decision.verdict != Verdict::Refuted {
                assert_eq!(decision.verdict, Verdict::Proved, "{claim}: {}", decision.reason);
                continue;
            }
            let found = repairs(&sheet, position, &Options::default());
            for repair in &found.found {
                let shown = repair.to_string();
                assert!(shown.contains(kept) && !shown.contains(never), "{claim}: {shown}");
                assert_ne!(shown, format!("${claim}$"));
                // in the file, as shown
                let mended = text.replace(claim, shown.trim_matches('$'));
                let sheet = Sheet::read(&mended, &vocabulary()).unwrap();
                for position in sheet.rows() {
                    let decision = prove::decide(&sheet, position, &Options::default());
                    assert_eq!(decision.verdict, Verdict::Proved, "{shown}: {}", decision.reason);
                }
            }
            assert_eq!(found.none().is_some(), found.found.is_empty(), "{claim}");
        }
    }
}

#[test]
fn how_far_a_search_without_a_repair_went_is_said() {
    let text = "[symbols]\nparameters = ['x', 'y']\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = 'x^7 y = \\cos(y)'\n\
        [[equation]]\nlabel = '2'\nrole = 'claim'\ntex = '\\pi \\approx 3.15'\n";
    let sheet = Sheet::read(text, &vocabulary()).unwrap();
    let found = repairs(&sheet, 0, &Options::default());
    let extent = found.extent.expect("a search");
    assert!(
        found.found.is_empty() && extent.edits > 20 && extent.together == 3,
        "{found:?}"
    );
    let said = found.none().expect("words");
    assert!(
        said.starts_with(&format!(
            "no repair found among {} edits, up to 3 together",
            extent.edits
        )),
        "{said}"
    );
    let none = repairs(&sheet, 1, &Options::default());
    assert_eq!(none.extent, None);
    assert!(
        none.none()
            .is_some_and(|said| said.starts_with("no repair is looked for"))
    );
}
