//! A motion of any word that is proved to be there, and its orbit over any number.

use crate::model::{Motion, Parameters};
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::inconclusive::{Inconclusive, Property};
use crate::orbit::orbit::Orbit;
use crate::orbit::solve::krawczyk::{ProvedRoot, prove_over};
use crate::orbit::solve::refine::refine_one_one;
use crate::orbit::solve::words::WordOrbit;
use crate::orbit::word::Word;
use numbers::{DoubleDouble, Endpoint, Interval};

/// A motion known to be there, not yet to the last digit.
pub enum ProvedOrbit<'a> {
    /// A 1-1 motion.
    Pair {
        /// (T_1, psi)
        root: &'a ProvedRoot<f64, 2>,
        /// The forcing periods it takes.
        periods: u32,
    },
    /// One of two or more that f64 could not tell apart.
    Close {
        /// (T_1, psi)
        root: &'a ProvedRoot<DoubleDouble, 2>,
        /// The forcing periods it takes.
        periods: u32,
    },
    /// One of any other word.
    Word(&'a WordOrbit),
}

impl ProvedOrbit<'_> {
    /// The orbit over `E`.
    ///
    /// # Errors
    /// `Undecided` where `E` is too narrow, and what else [`Orbit::from_impacts`] says.
    pub fn orbit<E: Endpoint>(&self, parameters: &impl Parameters) -> Result<Orbit<E>, Inconclusive> {
        let open = |what| Inconclusive::Undecided { what };
        let motion = parameters
            .motion::<Interval<E>>()
            .map_err(|_| open(Property::Existence))?;
        self.at(&motion)
    }

    /// One copy for all parameters.
    fn at<E: Endpoint>(&self, motion: &Motion<Interval<E>>) -> Result<Orbit<E>, Inconclusive> {
        match self {
            Self::Word(cycle) => cycle.orbit(motion),
            Self::Pair { root, periods } => pair(root, *periods, motion),
            Self::Close { root, periods } => pair(root, *periods, motion),
        }
    }
}

/// The digits of a number, guard digits counted, for which one evaluation does.
const REFINED: std::ops::Range<f64> = 40.0..65.0;

/// The 1-1 motion at a root.
fn pair<F: Endpoint, E: Endpoint>(
    root: &ProvedRoot<F, 2>,
    periods: u32,
    motion: &Motion<Interval<E>>,
) -> Result<Orbit<E>, Inconclusive> {
    let balance = OneOneEquations::new(motion, periods);
    let digits = -E::epsilon().to_f64().log10();
    let quickly = if REFINED.contains(&digits) {
        refine_one_one(motion, periods, root)
    } else {
        None
    };
    let found = quickly.or_else(|| prove_over(&balance, root));
    let [t_1, middle] = found.ok_or(Inconclusive::Undecided {
        what: Property::Existence,
    })?;
    Orbit::from_impacts(&Word::pair(), periods, motion, &balance.impacts(&t_1, &middle))
}
