//! Whether a vocabulary makes sense: every name in it declared, nothing defined by itself.

use super::atom::Atoms;
use super::fault::Fault;
use super::jacobian::Jacobians;
use super::meaning::Meaning;
use super::premise::message;
use super::reading::Reading;
use super::vocabulary::Vocabulary;
use crate::number::Field;
use crate::tex::{Name, Tree};

impl Vocabulary {
    /// Reads everything that the vocabulary says, used or not.
    ///
    /// # Errors
    /// A [`Fault`] that quotes what makes no sense.
    pub fn check(&self) -> Result<(), Fault> {
        let mut atoms = Atoms::new(&self.index);
        let jacobians = Jacobians::new(self, &mut atoms).map_err(Fault::new)?;
        let blank = Meaning::default();
        let mut reading = Reading::new(self, &jacobians, &mut atoms, &blank, &[]);
        for (name, _) in &self.periods {
            if !self.names.functions.contains(name) {
                return Err(Fault::new(format!(
                    "`{name}` in `periods` is neither a function nor a state"
                )));
            }
        }
        let derivatives = self
            .functions
            .iter()
            .filter_map(|(name, tree)| Some((name, tree.as_ref()?)));
        let defined = self
            .abbreviations
            .iter()
            .chain(&self.periods)
            .map(|(name, tree)| (name, tree));
        for (name, tree) in defined.chain(derivatives) {
            reading
                .tree(tree)
                .map_err(|error| Fault::new(format!("`{name}`: {}", message(&error))))?;
        }
        for (list, names) in [("generic", &self.generic), ("positive", &self.positive)] {
            for name in names {
                if !reading.knows(name) {
                    return Err(Fault::new(format!("`{name}` in `{list}` is not declared")));
                }
            }
        }
        for relation in &self.relations {
            let about = |problem: String| Fault::new(format!("relation `{relation}`: {problem}"));
            if !is_square(&relation.left) {
                return Err(about(
                    "its left side must be the square of a symbol or of a function".to_string(),
                ));
            }
            for side in [&relation.left, &relation.right] {
                reading.tree(side).map_err(|error| about(message(&error)))?;
            }
        }
        for (name, _) in &self.maps {
            self.check_map(name, &jacobians)?;
        }
        Ok(())
    }

    fn check_map(&self, name: &Name, jacobians: &Jacobians) -> Result<(), Fault> {
        let one = |_| crate::algebra::Fraction::from_integer(1);
        let matrix = jacobians.matrix(name, &mut Atoms::new(&self.index), &one);
        let problem = "is a product of itself, or its factors do not fit together";
        matrix
            .map(|_| ())
            .ok_or_else(|| Fault::new(format!("map `{name}` {problem}")))
    }
}

fn is_square(tree: &Tree) -> bool {
    match tree {
        Tree::Power(base, 2, _) => matches!(base.as_ref(), Tree::Symbol(..) | Tree::Call(..)),
        _ => false,
    }
}
