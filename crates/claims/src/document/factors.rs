//! Letters before a bracket, `M(L/2)^2`: which are factors, and which may have an argument.

use std::collections::{BTreeSet, HashMap, HashSet};
use texmath::{DoubtKind, Equation, Name, Tree, any_side, is_constant, names_in};

/// The letters by which the equations of a document give those that stand before brackets.
pub(super) struct Factors(HashMap<Name, BTreeSet<Name>>);

impl Factors {
    pub fn new<'e>(equations: impl Iterator<Item = &'e Equation> + Clone) -> Self {
        let before = equations
            .clone()
            .flat_map(arguments)
            .map(|(of, _)| (of.clone(), BTreeSet::new()));
        let mut given_by: HashMap<Name, BTreeSet<Name>> = before.collect();
        for equation in equations {
            for (name, meaning) in [(&equation.left, &equation.right), (&equation.right, &equation.left)] {
                if let Tree::Symbol(name, _) = name
                    && let Some(letters) = given_by.get_mut(name)
                {
                    names_in(meaning, letters);
                }
            }
        }
        Self(given_by)
    }

    /// The places of an equation at which a letter before a bracket may have an argument: it stands in front of brackets
    /// alone there, or what gives it is written with a letter of the bracket. A sum is put in brackets behind a factor too.
    pub fn doubts(&self, equation: &Equation) -> Vec<String> {
        let insides: HashSet<&Tree> = arguments(equation).map(|(_, inside)| inside).collect();
        let shares = |of: &Name, inside: &Tree| {
            let mut letters = BTreeSet::new();
            names_in(inside, &mut letters);
            let given_by = self.0.get(of);
            given_by.is_some_and(|given_by| letters.iter().any(|name| !is_constant(name) && given_by.contains(name)))
        };
        arguments(equation)
            .filter(|(of, inside)| {
                !matches!(inside, Tree::Sum(_)) && (shares(of, inside) || !stands_alone(of, equation, &insides))
            })
            .map(|(of, inside)| {
                let (of, inside) = (of.clone(), inside.clone());
                let readings = Vec::new();
                DoubtKind::Argument { of, inside, readings }.to_string()
            })
            .collect()
    }
}

/// The letters of an equation that stand before a bracket, each with what stands in it.
fn arguments(equation: &Equation) -> impl Iterator<Item = (&Name, &Tree)> {
    equation.doubts.0.iter().filter_map(|doubt| match &doubt.kind {
        DoubtKind::Argument { of, inside, .. } => Some((of, inside)),
        _ => None,
    })
}

/// Returns true if a letter stands somewhere in an equation without a bracket behind it, as numbers do.
fn stands_alone(letter: &Name, equation: &Equation, insides: &HashSet<&Tree>) -> bool {
    let is_letter = |node: &Tree| matches!(node, Tree::Symbol(name, _) if name == letter);
    let is_bracket = |node: &Tree| match node {
        Tree::Power(base, ..) | Tree::RealPower(base, ..) if insides.contains(&**base) => true,
        _ => insides.contains(node),
    };
    let (mut places, mut before_brackets) = (0, 0);
    any_side(equation, &mut |node| {
        places += usize::from(is_letter(node));
        if let Tree::Product(parts) = node {
            let pairs = parts.iter().zip(parts.iter().skip(1));
            before_brackets += pairs
                .filter(|(first, next)| is_letter(first) && is_bracket(next))
                .count();
        }
        false
    });
    places > before_brackets
}
