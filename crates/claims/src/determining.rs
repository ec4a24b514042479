//! Maps given implicitly: which of the givens determine a map.

use kernel::{Expansion, Implicit, Node, Origin, Polynomial, Property, Quantity, Statement, Symbol, Term};
use std::collections::BTreeSet;

/// A Mersenne prime, 2^61 - 1.
const PRIME: u128 = (1 << 61) - 1;

/// The vanishing terms among the givens that determine the map: of those that speak of no other impact, the ones with
/// a state before the others, each taken if it makes the rank of the slopes by what the map gives larger. What is left
/// and does not lead from one impact to the next, or speaks of times alone where those with states suffice, restricts the
/// point; where something else is left, nothing tells which of these is the map, and none determines it. What is given
/// under a origin of `pointwise` may hold at single points only.
pub fn determining(statement: &mut Statement, step: &Implicit, pointwise: &[Origin]) -> Vec<(Origin, Term)> {
    let mut candidates: Vec<(Origin, Term)> = Vec::new();
    let mut slopes: Vec<(Origin, Term)> = Vec::new();
    for number in 0..statement.givens().len() {
        let given = statement.givens()[number].clone();
        // what is assumed of the claim is said of the point, and a law that holds at times only of these
        let everywhere = given.law.as_ref().is_none_or(|law| law.conditions.is_empty());
        let everywhere = everywhere && !pointwise.contains(&given.origin);
        if given.property != Property::Zero || given.origin == Origin::Assumptions || !everywhere {
            continue;
        }
        match &given.law {
            None => candidates.push((given.origin, given.term)),
            Some(law) if law.interval.is_some() => {
                let (flight, origin) = (law.interval.unwrap_or(0), given.origin);
                let times: Vec<(i32, Symbol)> = statement.instants().iter().map(|(n, t)| (*n, *t)).collect();
                let ends = times.into_iter().filter(|(_, time)| step.of.contains(time));
                for (index, time) in ends.collect::<Vec<_>>() {
                    let time = statement.terms_mut().symbol(time);
                    let shift = index - 1 - flight;
                    if let Some(instance) = statement.instance(number, Some(time), shift, None) {
                        candidates.push((origin.clone(), instance.term));
                    }
                    // of a law that holds at all times its derivative holds as well
                    let running = statement.fresh("t");
                    let now = statement.terms_mut().symbol(running);
                    let of = Some((running, index - 1));
                    let moves = |_: &Statement, symbol| symbol == running;
                    if let Some(instance) = statement.instance(number, Some(now), shift, of)
                        && let Some(near) = statement.holding_near(&instance.conditions, &[instance.term], &moves)
                        && near.is_empty()
                    {
                        let slope = statement.derivative(instance.term, running);
                        slopes.push((origin.clone(), statement.moved(slope, Some((running, time)), 0)));
                    }
                }
            }
            Some(_) => {}
        }
    }
    // a slope may be what another premise says, as (3) is that of (4); else it holds at every impact, and is no condition
    // on the point
    let mut universal: BTreeSet<Term> = BTreeSet::new();
    for (origin, slope) in slopes {
        let is_said = candidates.clone().into_iter().any(|(_, term)| {
            let terms = statement.terms_mut();
            let apart = [terms.difference(term, slope), terms.sum(vec![term, slope])];
            apart.into_iter().any(|apart| {
                let written = statement.written_out(apart);
                let form = Expansion::new(BTreeSet::new(), 100_000).of(statement.terms(), written);
                form.is_ok_and(|form| form.numerator.is_zero())
            })
        });
        if !is_said {
            candidates.push((origin, slope));
            universal.insert(slope);
        }
    }
    let mut fitting: Vec<(bool, Origin, Term)> = Vec::new();
    let mut leading: BTreeSet<(bool, Term)> = BTreeSet::new();
    for (origin, term) in candidates {
        let written = statement.written_out(term);
        let met: BTreeSet<Symbol> = statement
            .terms()
            .inside(written)
            .into_iter()
            .filter_map(|inner| match statement.terms().node(inner) {
                Node::Symbol(symbol) => Some(*symbol),
                _ => None,
            })
            .collect();
        let met: Vec<Symbol> = met.into_iter().filter(|symbol| statement.depends(*symbol)).collect();
        let inside = met
            .iter()
            .all(|symbol| step.of.contains(symbol) || step.by.contains(symbol));
        let speaks = met.iter().any(|symbol| step.of.contains(symbol));
        let partial = statement
            .terms()
            .inside(written)
            .into_iter()
            .any(|inner| match statement.terms().node(inner) {
                Node::Symbol(symbol) => {
                    matches!(statement.quantity(*symbol), Some(Quantity::Partial { .. }))
                }
                _ => false,
            });
        if inside && speaks && !partial {
            let state = met.iter().any(|symbol| statement.number_of(*symbol).is_some());
            if universal.contains(&term) || met.iter().any(|symbol| step.by.contains(symbol)) {
                leading.insert((!state, term));
            }
            fitting.push((!state, origin, term));
        }
    }
    fitting.sort_by_key(|(without_state, ..)| *without_state);
    let mut chosen: Vec<(bool, Origin, Term)> = Vec::new();
    let mut rows: Vec<Vec<u128>> = Vec::new();
    for (without_state, origin, term) in fitting {
        if chosen.len() == step.of.len() {
            break;
        }
        let slopes: Option<Vec<u128>> = step.of.iter().map(|&of| slope_at_random(statement, term, of)).collect();
        let Some(slopes) = slopes else { continue };
        rows.push(slopes);
        if rank(&rows) == rows.len() {
            chosen.push((without_state, origin, term));
        } else {
            rows.pop();
        }
    }
    let all_have_states = chosen.iter().all(|(without_state, ..)| !without_state);
    let is_rival = |(without_state, term): &(bool, Term)| {
        let restricts = *without_state && all_have_states;
        !restricts && chosen.iter().all(|(.., known)| known != term)
    };
    match chosen.len() == step.of.len() && leading.iter().any(is_rival) {
        true => Vec::new(),
        false => chosen.into_iter().map(|(_, origin, term)| (origin, term)).collect(),
    }
}

fn slope_at_random(statement: &mut Statement, term: Term, of: Symbol) -> Option<u128> {
    let slope = statement.derivative(term, of);
    let quotient = Expansion::new(BTreeSet::new(), 100_000)
        .of(statement.terms(), slope)
        .ok()?;
    residue(&quotient.numerator)
}

/// The value of a polynomial modulo the prime, where each generator has a value that depends on its number alone.
fn residue(polynomial: &Polynomial) -> Option<u128> {
    let value = |generator: Term| {
        let mixed = (u128::from(generator.0) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        (mixed ^ (mixed >> 29)) % PRIME
    };
    polynomial.terms().iter().try_fold(0, |sum, (monomial, coefficient)| {
        let (above, below) = (coefficient.numerator(), coefficient.denominator());
        let modulus = dashu_int::IBig::from(PRIME);
        let positive = |value: &dashu_int::IBig| u128::try_from((value % &modulus + &modulus) % &modulus).ok();
        let (above, below) = (positive(above)?, positive(&dashu_int::IBig::from(below.clone()))?);
        let product = monomial
            .iter()
            .fold(times(above, inverse(below)), |product, (generator, power)| {
                times(product, raise(value(*generator), u128::from(*power)))
            });
        Some((sum + product) % PRIME)
    })
}

fn times(a: u128, b: u128) -> u128 {
    a * b % PRIME
}

fn raise(base: u128, mut exponent: u128) -> u128 {
    let (mut result, mut square) = (1, base % PRIME);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = times(result, square);
        }
        square = times(square, square);
        exponent >>= 1;
    }
    result
}

fn inverse(value: u128) -> u128 {
    raise(value, PRIME - 2)
}

/// The rank of a matrix modulo the prime.
fn rank(rows: &[Vec<u128>]) -> usize {
    let mut matrix = rows.to_vec();
    let mut rank = 0;
    for column in 0..matrix.first().map_or(0, Vec::len) {
        let Some(pivot) = (rank..matrix.len()).find(|&row| matrix[row][column] != 0) else {
            continue;
        };
        matrix.swap(rank, pivot);
        let lead = matrix[rank].clone();
        for row in matrix.iter_mut().skip(rank + 1) {
            let factor = times(row[column], inverse(lead[column]));
            for (entry, top) in row.iter_mut().zip(&lead) {
                *entry = (*entry + PRIME - times(factor, *top)) % PRIME;
            }
        }
        rank += 1;
    }
    rank
}
