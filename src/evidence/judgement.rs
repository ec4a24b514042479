//! What the points say of a verdict.

use super::compiler::Unwitnessed;
use super::motion::Flown;
use super::point::Point;
use super::question::{Gap, is_named};
use super::system::{Kind, System};
use super::tolerance::{APART_WIDE, DOUBTFUL_PROOF, DOUBTFUL_REFUTATION, EQUAL_WIDE};
use crate::claim::{Fault, Sheet, Statements, Verdict};
use crate::number::Wide;
use crate::tex::Tree;

/// What numbers say of one claim.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evidence {
    /// Decimal digits in which the sides agree, at the worst point; nothing where there is no point.
    pub digits: Option<f64>,
    /// The same at the median of the points.
    pub median: Option<f64>,
    /// Points at which all premises hold and both sides have a value.
    pub points: usize,
    /// The largest residual of a premise at any of the points, relative to the size of its terms.
    pub residual: Option<f64>,
    /// The worst point: names, values, and the two sides.
    pub worst: String,
    /// What contradicts the verdict.
    pub against: Option<String>,
    /// How the derivatives compare with the maps of the device, where points are of its motion.
    pub flown: Option<Flown>,
    pub notes: Vec<String>,
}

/// Witnesses for the claim at `position` of the sheet, at up to `points` points, held against the verdict.
///
/// # Errors
/// The [`Fault`] of a claim or premise that makes no sense.
pub fn witness(sheet: &Sheet, position: usize, verdict: Verdict, points: usize) -> Result<Evidence, Fault> {
    let statements = sheet.statements(position)?;
    Ok(of_statements(sheet, &statements, verdict, points))
}

fn of_statements(sheet: &Sheet, statements: &Statements, verdict: Verdict, points: usize) -> Evidence {
    let system = match System::new(statements, &sheet.vocabulary, Kind::Any) {
        Ok(system) => system,
        Err(reason) => {
            return Evidence {
                notes: vec![no_witness(&reason)],
                ..Evidence::default()
            };
        }
    };
    let found = asked(&system, points);
    let Some((worst, gap)) = found.iter().max_by(|(_, a), (_, b)| a.relative.total_cmp(&b.relative)) else {
        let notes = vec!["no point was found at which the premises hold and both sides have a value".to_string()];
        return Evidence {
            notes,
            ..Evidence::default()
        };
    };
    let mut digits: Vec<f64> = found.iter().map(|(_, gap)| gap.digits()).collect();
    digits.sort_by(f64::total_cmp);
    let mut evidence = Evidence {
        digits: digits.first().copied(),
        median: digits.get(digits.len() / 2).copied(),
        points: found.len(),
        residual: found.iter().map(|(point, _)| system.residual(point)).reduce(f64::max),
        worst: show(&system, worst, gap),
        ..Evidence::default()
    };
    let flown = found
        .iter()
        .filter_map(|(point, _)| system.flown(&point.values))
        .reduce(Flown::and);
    evidence.notes.extend(flown.map(|flown| flown.to_string()));
    evidence.flown = flown;
    match verdict {
        Verdict::Proved => against_proof(&system, &found, &mut evidence),
        Verdict::Refuted => {
            // What random points with moderate numbers cannot tell is not held against an exact counterexample.
            if statements.claims.iter().any(is_beyond_points) {
                return evidence;
            }
            against_refutation(&system, &found, &mut evidence);
            if evidence.against.is_none() && holds_for_cosine(sheet, statements) {
                evidence
                    .notes
                    .push("true for this forcing: it holds where f is a cosine alone, cos(pi t + phi)".to_string());
            }
        }
        Verdict::Undecided => {}
    }
    evidence
}

fn no_witness(reason: &Unwitnessed) -> String {
    format!("no witness: {reason}")
}

/// Points with the largest gap there of all equations of the claim.
fn asked(system: &System, points: usize) -> Vec<(Point<f64>, Gap)> {
    let gap = |point: &Point<f64>| {
        let gaps = system
            .questions
            .iter()
            .map(|question| question.gap(system, &point.values, &point.running));
        let gaps: Option<Vec<Gap>> = gaps.collect();
        gaps?.into_iter().max_by(|a, b| a.relative.total_cmp(&b.relative))
    };
    let found = system.points(points, 1);
    found
        .into_iter()
        .filter_map(|point| gap(&point).map(|gap| (point, gap)))
        .collect()
}

/// The largest relative gap at a point over 40 digits.
fn wide_gap(system: &System, point: &Point<f64>) -> Option<f64> {
    let wide: Point<Wide<40>> = system.widened(point)?;
    let gaps = system
        .questions
        .iter()
        .map(|question| question.gap(system, &wide.values, &wide.running));
    gaps.map(|gap| gap.map(|gap| gap.relative))
        .try_fold(0.0, |worst: f64, gap| Some(worst.max(gap?)))
}

fn against_proof(system: &System, found: &[(Point<f64>, Gap)], evidence: &mut Evidence) {
    let mut doubtful: Vec<&(Point<f64>, Gap)> = found.iter().filter(|(_, gap)| gap.digits() < DOUBTFUL_PROOF).collect();
    doubtful.sort_by(|(_, a), (_, b)| b.relative.total_cmp(&a.relative));
    for (point, gap) in doubtful.into_iter().take(3) {
        match wide_gap(system, point) {
            Some(relative) if relative > APART_WIDE => {
                evidence.against = Some(format!("proved, but the sides differ: {}", show(system, point, gap)));
                return;
            }
            Some(_) => evidence
                .notes
                .push("few digits in f64 at one point; in 40 digits the sides agree there".to_string()),
            None => evidence
                .notes
                .push("few digits in f64 at one point, which could not be refined".to_string()),
        }
    }
}

/// Characters of the longest printed number, and the highest power, with which random points tell a difference.
const LONGEST_NUMBER: usize = 9;
const HIGHEST_POWER: u32 = 8;

/// Whether a formula can part from a right one where no random point in f64 sees it: at another sign of a root, or by
/// numbers and powers so large or small that one side drowns the other.
fn is_beyond_points(equation: &crate::tex::Equation) -> bool {
    [&equation.left, &equation.right].into_iter().any(beyond_points)
}

fn beyond_points(tree: &Tree) -> bool {
    match tree {
        Tree::Root(..) | Tree::RealPower(..) => true,
        Tree::Number(value) => value.to_string().len() > LONGEST_NUMBER,
        Tree::Power(base, exponent, _) => exponent.unsigned_abs() > HIGHEST_POWER || beyond_points(base),
        Tree::Symbol(..) | Tree::Partial { .. } | Tree::Invariant { .. } => false,
        Tree::Call(_, inner, _) | Tree::Negate(inner) | Tree::PlusMinus(inner) | Tree::MinusPlus(inner) => {
            beyond_points(inner)
        }
        Tree::Sum(parts) | Tree::Product(parts) => parts.iter().any(beyond_points),
        Tree::Quotient(above, below, _) => beyond_points(above) || beyond_points(below),
    }
}

fn against_refutation(system: &System, found: &[(Point<f64>, Gap)], evidence: &mut Evidence) {
    if found.len() < 3 || found.iter().any(|(_, gap)| gap.digits() < DOUBTFUL_REFUTATION) {
        return;
    }
    let wide: Option<Vec<f64>> = found.iter().take(3).map(|(point, _)| wide_gap(system, point)).collect();
    let Some(wide) = wide else {
        evidence
            .notes
            .push("the sides agree in f64; the points could not be refined".to_string());
        return;
    };
    let worst = wide.into_iter().fold(0.0, f64::max);
    if worst < EQUAL_WIDE {
        let text = format!(
            "refuted, but the sides agree at each of {} points, at three of them to 25 digits",
            found.len()
        );
        evidence.against = Some(text);
    } else {
        evidence
            .notes
            .push(format!("the sides differ by {worst:.0e} of their size"));
    }
}

/// Whether the claim holds, to the precision of f64, where the forcing is a cosine of period 2.
fn holds_for_cosine(sheet: &Sheet, statements: &Statements) -> bool {
    let Ok(system) = System::new(statements, &sheet.vocabulary, Kind::Cosine) else {
        return false;
    };
    if system.space.courses.iter().all(|course| course.flight.is_some()) {
        return false;
    }
    let found = asked(&system, 3);
    found.len() == 3 && found.iter().all(|(_, gap)| gap.digits() > DOUBTFUL_REFUTATION)
}

/// Names with values, and the two sides.
fn show(system: &System, point: &Point<f64>, gap: &Gap) -> String {
    let named = system
        .space
        .slots
        .iter()
        .zip(&point.values)
        .enumerate()
        .filter(|(_, (slot, _))| is_named(slot));
    let mut parts: Vec<String> = named
        .filter_map(|(number, (_, value))| Some(format!("{}={value:.6}", system.space.show(number, &system.letter)?)))
        .collect();
    if system.runs {
        parts.push(format!("t={:.6}", point.running));
    }
    format!("{}; left={:.15e}; right={:.15e}", parts.join("; "), gap.left, gap.right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::read_symbols;

    fn paper() -> Sheet {
        let vocabulary = read_symbols(include_str!("../../golden/paper/symbols.toml")).unwrap();
        Sheet::read(include_str!("../../golden/paper/equations.toml"), &vocabulary).unwrap()
    }

    #[test]
    fn every_claim_of_the_paper_has_a_witness() {
        let sheet = paper();
        for (position, entry) in sheet.entries.iter().enumerate() {
            if entry.role != crate::claim::Role::Claim {
                continue;
            }
            let evidence = witness(&sheet, position, entry.expect, 6).unwrap();
            assert_eq!(evidence.against, None, "{}", entry.label);
            assert_eq!(evidence.points, 6, "{}", entry.label);
            let proved = entry.expect == Verdict::Proved;
            assert_eq!(evidence.digits > Some(10.0), proved, "{} {evidence:?}", entry.label);
        }
    }

    #[test]
    fn a_wrong_verdict_is_contradicted() {
        let sheet = paper();
        for (label, wrong) in [
            ("16", Verdict::Proved),
            ("22", Verdict::Proved),
            ("14", Verdict::Refuted),
        ] {
            let evidence = witness(&sheet, sheet.find(label).unwrap(), wrong, 6).unwrap();
            assert!(evidence.against.is_some(), "{label} {evidence:?}");
        }
    }

    fn of(tex: &str, premises: &[(&str, &str)], verdict: Verdict) -> Evidence {
        let mut text = String::new();
        for (label, tex) in premises {
            text += &format!("[[equation]]\nlabel = \"{label}\"\nrole = \"premise\"\ntex = '''{tex}'''\n");
        }
        let labels: Vec<&str> = premises.iter().map(|(label, _)| *label).collect();
        text +=
            &format!("[[equation]]\nlabel = \"c\"\nrole = \"claim\"\ntex = '''{tex}'''\nfollows_from = {labels:?}\n");
        let vocabulary = read_symbols(include_str!("../../golden/paper/symbols.toml")).unwrap();
        let sheet = Sheet::read(&text, &vocabulary).unwrap();
        witness(&sheet, sheet.find("c").unwrap(), verdict, 6).unwrap()
    }

    #[test]
    fn what_holds_for_a_cosine_alone_is_said() {
        let periodic = [("p", "f(t) = f(t + T)"), ("q", "T = T_1 + T_2")];
        let evidence = of(r"F_1(t_{k+2}) = F_1(t_k)", &periodic, Verdict::Refuted);
        assert!(
            evidence.against.is_none() && evidence.digits < Some(3.0),
            "{evidence:?}"
        );
        assert!(
            evidence
                .notes
                .iter()
                .any(|note| note.starts_with("true for this forcing")),
            "{evidence:?}"
        );
        let evidence = of("f(t_{k+2}) = f(t_k)", &periodic, Verdict::Proved);
        assert!(
            evidence.against.is_none() && evidence.digits > Some(12.0),
            "{evidence:?}"
        );
    }

    #[test]
    fn a_term_too_small_for_f64_is_no_reason_to_contradict() {
        let given = [("p", "d = r T")];
        let evidence = of("d = r T + 0.0000000000000000001", &given, Verdict::Refuted);
        assert!(
            evidence.against.is_none() && evidence.digits > Some(14.0),
            "{evidence:?}"
        );
        assert!(of("d = T r", &given, Verdict::Refuted).against.is_some());
        assert!(of("d = 1.000001 T r", &given, Verdict::Proved).against.is_some());
    }

    #[test]
    fn laws_of_functions_shape_the_forcing() {
        let opposite = [("p", "f(t) = -f(t + T_1)")];
        let evidence = of("f(t_{k+1}) = -f(t_k)", &opposite, Verdict::Proved);
        assert!(
            evidence.against.is_none() && evidence.digits > Some(12.0),
            "{evidence:?}"
        );
        let growing = [("p", "f(t) = d t")];
        let integral = r"F_1(t_{k+1}) - F_1(t_k) = d (t_{k+1}^2 - t_k^2)/2";
        assert!(of(integral, &growing, Verdict::Proved).digits > Some(12.0));
    }

    #[test]
    fn a_flight_has_the_slope_of_its_law() {
        let law = [(
            "3",
            r"\dot{Z}(t) = -r\dot{Z}^{-}(t_k) + \overline{g}(t - t_k) + F_1(t) - F_1(t_k)",
        )];
        let slope = of(r"\ddot{Z}(t) = f(t) + \overline{g}", &law, Verdict::Proved);
        assert!(slope.against.is_none() && slope.digits > Some(12.0), "{slope:?}");
        assert!(
            of(r"\ddot{Z}(t) = f(t) - \overline{g}", &law, Verdict::Proved)
                .against
                .is_some()
        );
    }

    #[test]
    fn what_premises_leave_open_of_a_map_stays_open() {
        let velocity = [(
            "9",
            r"\dot{Z}_{k+1} = -r_B \dot{Z}_k + \overline{g}T_1 + F_1(t_{k+1}) - F_1(t_k)",
        )];
        let by_velocity = r"\frac{\partial \dot{Z}_{k+1}}{\partial \dot{Z}_k}";
        let chain = r"-r_B + \frac{\partial t_{k+1}}{\partial \dot{Z}_k} [f(t_{k+1}) + \overline{g}]";
        let evidence = of(&format!("{by_velocity} = {chain}"), &velocity, Verdict::Proved);
        assert!(evidence.digits > Some(12.0) && evidence.flown.is_none(), "{evidence:?}");
        let alone = of(&format!("{by_velocity} = -r_B"), &velocity, Verdict::Refuted);
        assert!(alone.digits < Some(3.0), "{alone:?}");
    }

    #[test]
    fn premises_without_a_common_point_leave_no_digits() {
        let evidence = of("r = 2", &[("p", "d = -1")], Verdict::Refuted);
        assert_eq!((evidence.digits, evidence.points), (None, 0));
        assert!(!evidence.notes.is_empty());
    }
}
