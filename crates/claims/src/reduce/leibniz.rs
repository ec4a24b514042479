//! Derivatives of definite integrals by a letter in their limits and in what is integrated (Leibniz's rule; Whittaker and Watson,
//! A Course of Modern Analysis, section 4.2): where the integrand and its derivative are continuous on the closed interval,
//! `d/dx \int_a^b f dt = f(b) b' - f(a) a' + \int_a^b df/dx dt`.

use super::super::premise::Statements;
use super::build::{difference, infinity, product, sum, symbol};
use super::derivative::{By, mentions};
use super::integral::{continuous, outermost, replaced};
use super::{Goal, Rule, fresh, rewritten, trees};
use texmath::{At, Equation, Name, Operation, Symbols, Tree, any, mapped, rewrite};

/// The derivative of what holds definite integrals.
struct Derivative<'a> {
    of: &'a Tree,
    by: &'a Name,
    at: &'a Tree,
}

/// The statements with derivatives of definite integrals differentiated, and what must hold for that.
pub(super) fn differentiated(statements: &Statements, symbols: &Symbols) -> Result<(Statements, Vec<Goal>), String> {
    let mut out = statements.clone();
    let mut lemmas = Vec::new();
    while let Some(operation) = first_derivative(&out) {
        let Operation::Derivative { of, by, at, .. } = &operation else {
            break;
        };
        let (value, beside, needed) = Derivative { of, by, at }.differentiated(&out, symbols)?;
        lemmas.extend(needed);
        let beside = beside.into_iter().map(|tree| Equation::between(tree.clone(), tree));
        out.claims.extend(beside);
        out = rewritten(&out, Rule::IntegralLeibniz, &|tree| {
            mapped(tree, &|node| match node {
                Tree::Operation(own, _) if **own == operation => Some(value.clone()),
                _ => None,
            })
        });
    }
    Ok((out, lemmas))
}

/// The first derivative of order 1 of what holds a definite integral, in claims alone.
fn first_derivative(statements: &Statements) -> Option<Operation> {
    let mut found = None;
    for side in statements.claims.iter().flat_map(|claim| [&claim.left, &claim.right]) {
        any(side, &mut |node| {
            if let Tree::Operation(operation, _) = node
                && let Operation::Derivative { of, order: 1, .. } = &**operation
                && !outermost(of).is_empty()
            {
                found = Some((**operation).clone());
            }
            false
        });
    }
    found
}

impl Derivative<'_> {
    /// The derivative, what must have a value beside it, and what must hold.
    fn differentiated(
        &self,
        statements: &Statements,
        symbols: &Symbols,
    ) -> Result<(Tree, Vec<Tree>, Vec<Goal>), String> {
        let by = self.by;
        super::is_continuous(statements, symbols, by)?;
        if super::is_spoken_of(statements, symbols, by) || symbols.running() == Some(by) {
            return Err(format!(
                "premises speak of `{by}`: what depends on it there is not differentiated"
            ));
        }
        if trees(statements).into_iter().any(|tree| symbols.may_be_complex(tree)) {
            return Err("the derivative of an integral of complex numbers".to_owned());
        }
        let mut extended = symbols.clone();
        let (mut integrals, mut slopes, mut lemmas) = (Vec::new(), Vec::new(), Vec::new());
        for operation in outermost(self.of) {
            if integrals.iter().any(|(known, _)| *known == operation) {
                continue;
            }
            let name = fresh(statements, &extended, "I");
            extended.let_be_parameter(&name, false);
            let (slope, needed) = self.of_integral(&operation, statements, &extended)?;
            lemmas.extend(needed);
            slopes.push((name.clone(), slope));
            integrals.push((operation, symbol(&name)));
        }
        let whole = replaced(self.of, &integrals);
        let own = By {
            symbols: &extended,
            name: by,
        }
        .of(&whole)?;
        let (mut terms, mut beside) = (vec![own], vec![whole.clone()]);
        for (name, slope) in &slopes {
            let factor = By {
                symbols: &extended,
                name,
            }
            .of(&whole)?;
            beside.push(factor.clone());
            terms.push(product(vec![factor, slope.clone()]));
        }
        let there = |tree: &Tree| {
            let tree = rewrite(tree, &|name| {
                let (operation, _) = integrals.iter().find(|(_, own)| *own == symbol(name))?;
                Some(Tree::Operation(Box::new(operation.clone()), At::default()))
            });
            match self.at {
                Tree::Symbol(name, _) if name == by => tree,
                at => rewrite(&tree, &|name| (name == by).then(|| at.clone())),
            }
        };
        // that the integrals have values is shown
        let is_plain = |tree: &&Tree| !slopes.iter().any(|(name, _)| mentions(tree, name));
        let beside = beside.iter().filter(is_plain).map(there).collect();
        Ok((there(&sum(terms)), beside, lemmas))
    }

    /// The derivative of one integral, and what must hold for it to be that.
    fn of_integral(
        &self,
        operation: &Operation,
        statements: &Statements,
        symbols: &Symbols,
    ) -> Result<(Tree, Vec<Goal>), String> {
        let Operation::Integral {
            of,
            by: letter,
            limits: Some((low, high)),
        } = operation
        else {
            return Err("an integral without limits within a derivative".to_owned());
        };
        if [low, high].into_iter().any(|limit| infinity(limit).is_some()) || letter == self.by {
            return Err("the derivative of an improper integral".to_owned());
        }
        if !outermost(of).is_empty() {
            return Err("the derivative of an integral of integrals".to_owned());
        }
        let by = By { symbols, name: self.by };
        let mut all = vec![of.clone()];
        let mut terms = Vec::new();
        if mentions(of, self.by) {
            let slope = by.of(of)?;
            all.push(slope.clone());
            let of_slope = Operation::Integral {
                of: slope,
                by: letter.clone(),
                limits: Some((low.clone(), high.clone())),
            };
            terms.push(Tree::Operation(Box::new(of_slope), At::default()));
        }
        let at = |limit: &Tree| rewrite(of, &|name| (name == letter).then(|| limit.clone()));
        let (up, down) = (by.of(high)?, by.of(low)?);
        terms.push(difference(product(vec![at(high), up]), product(vec![at(low), down])));
        Ok((
            sum(terms),
            continuous(operation, &all, statements, symbols, Rule::IntegralLeibniz)?,
        ))
    }
}
