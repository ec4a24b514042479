//! A decision in full: the proof, or the counterexample worked out.

use super::audit::Decision;
use super::certificate::{Certificate, certify};
use super::counterexample::Counterexample;
use super::fault::Fault;
use super::problem::Problem;
use super::proof::{ask, ask_with};
use super::sheet::{Entry, Sheet};
use super::verdict::Verdict;
use crate::algebra::Variable;
use crate::tex::Equation;
use std::fmt::Write;

impl Sheet {
    /// The proof or the counterexample of the claim at a position, as text.
    ///
    /// # Errors
    /// As [`Sheet::audit`].
    pub fn explain(&self, position: usize, decision: &Decision) -> Result<String, Fault> {
        let Some(entry) = self.entries.get(position) else {
            return Err(Fault::new("there is no such equation"));
        };
        let mut problem = Problem::new(self, position)?;
        let mut text = format!("({}) {}: {}\n", entry.label, decision.verdict, decision.reason);
        premises(&mut text, &problem);
        for equation in problem.statements.claims.clone() {
            let _ = write!(text, "\nclaim\n  {equation}\n");
            match decision.verdict {
                Verdict::Proved => proof(&mut text, &mut problem, entry, &equation)?,
                _ => {
                    if decision.failed.as_ref() == Some(&equation)
                        && let Some(counterexample) = &decision.counterexample
                    {
                        worked_out(&mut text, counterexample);
                    }
                }
            }
        }
        Ok(text)
    }
}

fn premises(text: &mut String, problem: &Problem) {
    let _ = writeln!(text, "\npremises, each an expression that is zero");
    for given in &problem.givens {
        let _ = writeln!(
            text,
            "  ({})  {}",
            given.label,
            problem.atoms.show_polynomial(&given.residual)
        );
    }
    let solved = |variable: &Variable, value: &crate::algebra::Fraction| {
        format!(
            "  {} = {}",
            problem.atoms.show(*variable),
            problem.atoms.show_fraction(value)
        )
    };
    let mut known: Vec<(&Variable, &crate::algebra::Fraction)> = problem.times.values.iter().collect();
    known.sort_by_key(|(variable, _)| **variable);
    if !known.is_empty() {
        let _ = writeln!(text, "\ntimes and parameters put in");
        for (variable, value) in known {
            let _ = writeln!(text, "{}", solved(variable, value));
        }
    }
    for (function, period) in &problem.times.periods {
        let _ = writeln!(
            text,
            "  {function} has the period {}",
            problem.atoms.show_fraction(period)
        );
    }
}

fn proof(text: &mut String, problem: &mut Problem, entry: &Entry, equation: &Equation) -> Result<(), Fault> {
    let times = problem.times.clone();
    let Some(question) = ask_with(problem, &times, None, entry, equation)? else {
        return Ok(());
    };
    problem.meet_squares();
    let Some(certificates) = certify(problem, &question) else {
        // The sign of a root decided it: the normal form is the proof.
        if ask(problem, entry, equation)?.is_some() {
            let _ = writeln!(
                text,
                "  left - right has the normal form 0 once the roots are taken positive"
            );
        }
        return Ok(());
    };
    for certificate in certificates {
        certified(text, problem, &certificate);
    }
    Ok(())
}

fn certified(text: &mut String, problem: &Problem, certificate: &Certificate) {
    let show = |p| problem.atoms.show_polynomial(p);
    let _ = writeln!(
        text,
        "the numerator of left - right is\n  N = {}",
        show(&certificate.residual)
    );
    if certificate.residual.is_zero() {
        let _ = writeln!(text, "which is 0 as it stands");
        return;
    }
    let _ = writeln!(text, "and reduces to 0, exactly (multiplied out again to make sure):");
    let head = if certificate.multiplier.is_one() {
        "N".to_string()
    } else {
        format!("[{}] N", show(&certificate.multiplier))
    };
    let _ = writeln!(text, "  {head} =");
    for (at, coefficient) in &certificate.terms {
        let label = match problem.givens.get(*at) {
            Some(given) => given.label.clone(),
            None => "the square of the root".to_string(),
        };
        let _ = writeln!(text, "    + [{}] ({label})", show(coefficient));
    }
}

fn worked_out(text: &mut String, counterexample: &Counterexample) {
    let _ = writeln!(text, "counterexample: every premise holds at");
    for (name, value) in &counterexample.point {
        let _ = writeln!(text, "  {name} = {value}");
    }
    let _ = writeln!(
        text,
        "where\n  left  = {}\n  right = {}",
        counterexample.left, counterexample.right
    );
    for (term, value) in &counterexample.terms {
        let _ = writeln!(text, "    {term} = {value}");
    }
}
