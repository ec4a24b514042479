//! The paper's own TeX, evaluated over any number.

use super::StressError;
use claims::{Sheet, paper};
use numbers::{Analytic, Field};
use std::collections::BTreeMap;
use texmath::{At, Equation, Invariant, Name, Scope, Tree, Unsupported, evaluate, read};

/// One display of the paper.
pub(super) struct Formula {
    /// What its `where` defines.
    local: Vec<Equation>,
    equations: Vec<Equation>,
}

/// The paper, read once.
pub(super) struct Paper(Sheet);

impl Paper {
    /// Reads the embedded sheet.
    ///
    /// # Errors
    /// None: a test reads it.
    pub fn new() -> Result<Self, StressError> {
        paper().map(Self).map_err(|fault| StressError::Paper(fault.to_string()))
    }

    /// The display of this label as printed, each of `mended`, misprint and mend, replaced in it and in its `where`.
    ///
    /// # Errors
    /// `Paper` where there is no such display, or a misprint is not found in it.
    pub fn formula(&self, label: &str, mended: &[(&str, &str)]) -> Result<Formula, StressError> {
        let Self(sheet) = self;
        let fault = |what: String| StressError::Paper(format!("({label}): {what}"));
        let entry = sheet.find(label).and_then(|index| sheet.entries.get(index));
        let entry = entry.ok_or_else(|| fault("no such equation".into()))?;
        let mut texts: Vec<String> = entry.local.iter().map(|(_, source)| source.tex.clone()).collect();
        texts.push(entry.tex.tex.clone());
        for (misprint, mend) in mended {
            let text = texts.iter_mut().find(|text| text.contains(misprint));
            let text = text.ok_or_else(|| fault(format!("no `{misprint}` to mend")))?;
            *text = text.replace(misprint, mend);
        }
        let read = |text: &String| read(text, &sheet.symbols.names).map_err(|error| fault(error.to_string()));
        let equations = texts.pop().map_or(Ok(Vec::new()), |text| read(&text))?;
        let local: Result<Vec<_>, _> = texts.iter().map(read).collect();
        let local = local?.into_iter().flatten().collect();
        Ok(Formula { local, equations })
    }
}

/// What the names of a formula stand for, each by its TeX: `r_B`, `F_1(t_k)`.
#[derive(Clone)]
pub(super) struct Values<T> {
    known: BTreeMap<String, T>,
    upper_sign: bool,
}

impl<T: Field> Values<T> {
    pub fn new<const N: usize>(known: [(&str, T); N]) -> Self {
        let known = known.into_iter().map(|(name, value)| (name.to_owned(), value));
        Self {
            known: known.collect(),
            upper_sign: true,
        }
    }

    /// With the lower one of `\pm`.
    pub fn lower(mut self) -> Self {
        self.upper_sign = false;
        self
    }

    fn at(&self, tree: &Tree) -> Option<T> {
        self.known.get(&tree.to_string()).cloned()
    }
}

impl<T: Analytic> Scope<T> for Values<T> {
    type Error = Unsupported;

    fn symbol(&mut self, name: &Name) -> Result<T, Unsupported> {
        let value = self.at(&Tree::Symbol(name.clone(), At(0)));
        value.ok_or_else(|| Unsupported::Symbol(name.clone()))
    }

    fn call(&mut self, function: &Name, argument: &Tree) -> Result<T, Unsupported> {
        let value = self.at(&Tree::Call(function.clone(), Box::new(argument.clone()), At(0)));
        value.ok_or_else(|| Unsupported::Call(function.clone()))
    }

    fn partial(&mut self, of: &Name, by: &Name) -> Result<T, Unsupported> {
        let [name, other] = [of, by].map(Name::clone);
        let value = self.at(&Tree::Partial {
            of: name,
            by: other,
            at: At(0),
        });
        value.ok_or_else(|| Unsupported::Partial(Box::new(of.clone()), Box::new(by.clone())))
    }

    fn invariant(&mut self, kind: Invariant, of: &Name) -> Result<T, Unsupported> {
        let (matrix, at) = (of.clone(), At(0));
        let value = self.at(&Tree::Invariant { kind, of: matrix, at });
        value.ok_or_else(|| Unsupported::Invariant(of.clone()))
    }

    fn root(&mut self, radicand: T, index: u32) -> Result<T, Unsupported> {
        match index {
            2 => Ok(Analytic::sqrt(&radicand)),
            _ => Err(Unsupported::Root),
        }
    }

    fn upper_sign(&self) -> Option<bool> {
        Some(self.upper_sign)
    }
}

impl Formula {
    /// The right sides, the last definitions first: what an equation defines, its local definitions and the later
    /// equations of the display, is known to those that stand before. `None` where one has no value, as where a
    /// denominator is 0.
    pub fn values<T: Analytic>(&self, mut values: Values<T>) -> Option<Vec<T>> {
        for definition in &self.local {
            values.learn(definition)?;
        }
        // (19) uses Delta before it says what it is; (20) uses the derivatives of its first equations in the later ones
        let forwards = self.equations.iter().try_for_each(|equation| {
            let learned = values.learn(equation);
            learned.map(drop)
        });
        if forwards.is_none() {
            for equation in self.equations.iter().rev() {
                values.learn(equation)?;
            }
        }
        self.equations
            .iter()
            .map(|equation| values.at(&equation.left))
            .collect()
    }
}

impl<T: Analytic> Values<T> {
    /// Evaluates a right side and remembers it under the left one.
    fn learn(&mut self, equation: &Equation) -> Option<()> {
        let value = evaluate(&equation.right, self).ok()?;
        self.known.insert(equation.left.to_string(), value);
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_display_is_evaluated_in_either_order_of_its_definitions() {
        let paper = Paper::new().unwrap();
        let roots = paper.formula("19", &[]).unwrap();
        let values = Values::new([("Tr(DP)", 5.0), ("Det(DP)", 6.0)]);
        let upper = roots.values(values.clone()).unwrap();
        let lower = roots.values(values.lower()).unwrap();
        assert_eq!((upper[0], lower[0], upper[1]), (3.0, 2.0, 1.0));
    }

    #[test]
    fn a_misprint_that_is_not_there_cannot_be_mended() {
        let paper = Paper::new().unwrap();
        assert!(matches!(
            paper.formula("14", &[("q_B", "r_B")]),
            Err(StressError::Paper(_))
        ));
        assert!(matches!(paper.formula("99", &[]), Err(StressError::Paper(_))));
    }

    #[test]
    fn a_vanishing_denominator_is_no_value() {
        let paper = Paper::new().unwrap();
        let velocity = paper.formula("14", &[]).unwrap();
        let at = |r: f64| {
            velocity.values(Values::new([
                ("r_B", r),
                ("r_T", 1.0),
                (r"\overline{g}", 0.1),
                ("T", 2.0),
                ("T_1", 1.0),
                ("F_1(t_{k+1})", 0.0),
                ("F_1(t_k)", 0.0),
            ]))
        };
        assert_eq!(at(1.0), None);
        assert_eq!(at(0.5), Some(vec![0.0]));
    }
}
