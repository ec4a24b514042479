//! A question about numbers, decided: a proof or a counterexample that the kernel accepts. Points come before proofs.
//!
//! Each proof and each refutation is a value that the kernel made. That givens contradict each other rests on the kernel too, but
//! is said by `without_points` alone.

use super::budget::{Budget, CONTRADICTION_STEPS, Depth, PROOF_STEPS, QUICK_STEPS};
use super::{point, proof, small_numbers};

/// The decision on a question.
pub(super) enum Outcome {
    Proved(
        kernel::Proved,
        Box<kernel::With<kernel::Certificate>>,
        Box<kernel::With<kernel::Witness>>,
    ),
    Refuted(kernel::Refuted, Box<kernel::With<kernel::Witness>>),
    /// The labels of a smallest set of premises that contradict each other.
    Contradictory(Vec<String>),
    Undecided(String),
}

/// Points of the premises at which the claim holds, before it is taken to be true rather than false.
const ENOUGH_POINTS: usize = 4;

/// Decides a question, quickly if it can be.
pub(super) fn decided_outcome(statement: &kernel::Statement, budget: &Budget) -> Outcome {
    match outcome(statement, Depth::Quick, budget) {
        Outcome::Undecided(_) => outcome(statement, Depth::Deep, budget),
        outcome => outcome,
    }
}

/// Decides a question, as far as is asked for, in the steps that are left.
pub(super) fn outcome(statement: &kernel::Statement, depth: Depth, budget: &Budget) -> Outcome {
    let effort = budget.effort;
    // a point of the premises comes first: a wrong formula costs less than its proof would, a proof needs one anyway
    let mut point = None;
    let plain = small_numbers::points(statement).into_iter().filter_map(|witness| {
        let evaluated = kernel::evaluate(statement, &witness).ok()?;
        Some((witness, evaluated))
    });
    let searched = std::iter::once_with(|| points(statement, point::Wanted::Either, effort)).flatten();
    for (place, (witness, evaluated)) in plain.chain(searched).enumerate() {
        match evaluated {
            kernel::Evaluated::Fails(refuted) => return Outcome::Refuted(refuted, Box::new(witness)),
            kernel::Evaluated::Holds(found) => point = Some((witness, found)),
        }
        if place + 1 >= ENOUGH_POINTS {
            break;
        }
    }
    // what holds at the points met is likely to be true
    let most = match (depth, &point) {
        (Depth::Deep, _) => PROOF_STEPS.saturating_mul(effort),
        (Depth::Quick, Some(_)) => QUICK_STEPS,
        (Depth::Quick, None) => QUICK_STEPS / 5,
    };
    let certificate = budget.proof(statement, depth, most);
    if certificate.is_none()
        && depth == Depth::Quick
        && let Some((witness, kernel::Evaluated::Fails(refuted))) = points(statement, point::Wanted::Failure, effort)
    {
        return Outcome::Refuted(refuted, Box::new(witness));
    }
    let follows = certificate.is_some();
    // that what is written has a value is a question of its own, which says nothing of the claim
    let is_identity = certificate.as_ref().is_some_and(|certificate| {
        let of_nothing =
            |step: &kernel::Inference| matches!(step, kernel::Inference::Zero { target, .. } if target.is_zero());
        certificate.evidence.steps.iter().all(of_nothing)
    });
    if let Some(certificate) = certificate
        && let Some((proved, witness)) = proved(statement, &certificate, point, effort)
    {
        return Outcome::Proved(proved, Box::new(certificate), Box::new(witness));
    }
    let vacuous = || {
        (depth == Depth::Deep || follows)
            .then(|| without_points(statement, effort))
            .flatten()
    };
    vacuous().unwrap_or_else(|| {
        let reason = match follows {
            true if is_identity => "no point is found at which the premises hold and all that is written is defined",
            true => "it follows, but no point is found at which all that is written is defined and holds",
            false => "neither a proof nor a counterexample is found",
        };
        Outcome::Undecided(reason.into())
    })
}

/// A claim that follows is proved where a point is found at which its premises hold, and that the proof does not exclude.
fn proved(
    statement: &kernel::Statement,
    certificate: &kernel::With<kernel::Certificate>,
    known: Option<(kernel::With<kernel::Witness>, kernel::Point)>,
    effort: u64,
) -> Option<(kernel::Proved, kernel::With<kernel::Witness>)> {
    if let Some((witness, point)) = known
        && let Ok(proved) = kernel::prove(statement, certificate, &point)
    {
        return Some((proved, witness));
    }
    let mut proved = None;
    let witness = point::search(statement, point::Wanted::Premises, effort, &mut |witness| {
        if let Ok(kernel::Evaluated::Holds(point)) = kernel::evaluate(statement, witness) {
            proved = kernel::prove(statement, certificate, &point).ok();
        }
        proved.is_some()
    })?;
    Some((proved?, witness))
}

/// A point at which the premises hold, and whether the claim fails there.
pub(super) fn points(
    statement: &kernel::Statement,
    wanted: point::Wanted,
    effort: u64,
) -> Option<(kernel::With<kernel::Witness>, kernel::Evaluated)> {
    let mut found = None;
    let witness = point::search(statement, wanted, effort, &mut |witness| {
        found = kernel::evaluate(statement, witness)
            .ok()
            .filter(|evaluated| wanted != point::Wanted::Failure || matches!(evaluated, kernel::Evaluated::Fails(_)));
        found.is_some()
    })?;
    Some((witness, found?))
}

/// The outcome where all that is given, with the domain of the claim, contradicts itself.
fn without_points(statement: &kernel::Statement, effort: u64) -> Option<Outcome> {
    let budget = CONTRADICTION_STEPS * effort;
    let certificate = proof::contradiction(statement, budget).filter(|found| kernel::contradicts(found).is_ok())?;
    let mut refuted = None;
    let witness = point::search(statement, point::Wanted::PremisesAlone, effort, &mut |witness| {
        refuted = kernel::refute_nowhere(statement, &certificate, witness).ok();
        refuted.is_some()
    });
    if let (Some(witness), Some(refuted)) = (witness, refuted) {
        return Some(Outcome::Refuted(refuted, Box::new(witness)));
    }
    smallest_contradiction(&statement.premises(), budget).map(Outcome::Contradictory)
}

/// The labels of givens that contradict each other, none of which can be left out.
fn smallest_contradiction(premises: &kernel::Statement, budget: u64) -> Option<Vec<String>> {
    let contradicts = |kept: &[kernel::Origin]| {
        let fewer = premises.with_givens(&|given| kept.contains(&given.origin));
        proof::contradiction(&fewer, budget).is_some_and(|found| kernel::contradicts(&found).is_ok())
    };
    let mut kept: Vec<kernel::Origin> = Vec::new();
    for given in premises.givens() {
        if !kept.contains(&given.origin) {
            kept.push(given.origin.clone());
        }
    }
    if !contradicts(&kept) {
        return None;
    }
    let mut place = 0;
    while place < kept.len() && kept.len() <= 40 {
        let mut fewer = kept.clone();
        fewer.remove(place);
        match contradicts(&fewer) {
            true => kept = fewer,
            false => place += 1,
        }
    }
    Some(kept.iter().map(ToString::to_string).collect())
}
