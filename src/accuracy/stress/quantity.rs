//! A quantity at the points where its formula loses digits, and how its forms are judged there.

use super::StressError;
use super::row::{Form, StressRow, allowed, place};
use crate::accuracy::trade::digits_of;
use crate::number::{Analytic, Any, Dual, Rung, Wide, of_type, seeded};
use num_dual::DualNum;

/// A number that every form works over, dual numbers among them.
pub(super) trait Number: Analytic + DualNum {}
impl<T: Analytic + DualNum> Number for T {}

/// The number that judges: fifty digits beyond the widest one that is judged.
pub(super) type Exact = Wide<100>;

/// The reference and the form of this program, both in the number that judges, have to agree this far.
const REFERENCE_DIGITS: f64 = 60.0;

/// A quantity near an extreme. Its inputs are numbers of f64, taken as exact; what a form is given, the parameters and
/// the state of a motion that they fix, are the exact values rounded once to the number of the form.
pub(super) trait Quantity {
    /// The extreme.
    fn case(&self) -> &'static str;
    /// The formula.
    fn formula(&self) -> &'static str;
    /// The names of the inputs.
    fn inputs(&self) -> &'static [&'static str];
    /// The ranges of the dials by which a search moves, distances from the extreme as logarithms.
    fn dials(&self) -> Vec<[f64; 2]>;
    /// The inputs that dials set.
    fn set(&self, dials: &[f64]) -> Vec<f64>;
    /// The settings that are always looked at, from harmless to extreme.
    fn settings(&self) -> Vec<Vec<f64>>;
    /// What the forms are given; `None` where there is no such motion.
    fn given<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>>;
    /// The quantity, by a formula that neither form uses.
    fn reference<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>>;
    /// The paper's form.
    fn printed<T: Number>(&self, given: &[T]) -> Option<Vec<T>>;
    /// The default form: the very function that the program calls.
    fn stable<T: Number>(&self, given: &[T]) -> Option<Vec<T>>;
}

/// Something to be done with each quantity; their types differ.
pub(super) trait Visitor {
    /// Does it.
    fn visit(&mut self, quantity: &impl Quantity) -> Result<(), StressError>;
}

/// What the forms are judged by at a point.
pub(super) struct Judge {
    inputs: Vec<Exact>,
    given: Vec<Exact>,
    exact: Vec<Exact>,
}

impl Judge {
    /// `None` where the inputs are those of no motion.
    ///
    /// # Errors
    /// `Reference` where the reference and the stable form disagree in the number that judges.
    pub fn new(quantity: &impl Quantity, inputs: &[f64]) -> Result<Option<Self>, StressError> {
        let lifted: Vec<Exact> = inputs
            .iter()
            .map(|&input| <Exact as Analytic>::from_f64(input))
            .collect();
        let both = quantity.given(&lifted).zip(quantity.reference(&lifted));
        let Some((given, exact)) = both else {
            return Ok(None);
        };
        let confirmed = quantity.stable(&given).map_or(f64::NAN, |found| apart(&found, &exact));
        let digits = digits_of(confirmed, 1e-100);
        if digits < REFERENCE_DIGITS {
            return Err(StressError::Reference {
                case: quantity.case(),
                at: place(quantity.inputs(), inputs),
                digits,
            });
        }
        Ok(Some(Self {
            inputs: lifted,
            given,
            exact,
        }))
    }

    /// The most that the quantity changes, relatively to its largest component, for relative changes of all inputs;
    /// NaN where it has no derivative.
    pub fn condition(&self, quantity: &impl Quantity) -> f64 {
        let mut changes = vec![0.0; self.exact.len()];
        let size = size(&self.exact);
        for seed in 0..self.inputs.len() {
            let lifted: Vec<Dual<Exact>> = self.inputs.iter().cloned().map(Dual::from_re).collect();
            let lifted = lifted.into_iter().enumerate();
            let lifted = lifted.map(|(index, input)| if index == seed { seeded(input.re) } else { input });
            let Some(values) = quantity.reference(&lifted.collect::<Vec<_>>()) else {
                return f64::NAN;
            };
            for (change, value) in changes.iter_mut().zip(values) {
                *change += (value.eps * self.inputs[seed].clone() / size.clone()).to_f64().abs();
            }
        }
        largest(changes)
    }

    /// The digits that `form` keeps in `T`; 0 where it has no answer.
    pub fn digits<T: Number>(&self, quantity: &impl Quantity, form: Form) -> f64 {
        let given: Vec<T> = self.given.iter().map(narrow).collect();
        let found = match form {
            Form::Printed => quantity.printed(&given),
            _ => quantity.stable(&given),
        };
        let error = found.map_or(f64::NAN, |found| {
            let found: Vec<Exact> = found.iter().map(widen).collect();
            apart(&found, &self.exact)
        });
        digits_of(error, <T as Analytic>::epsilon().to_f64())
    }
}

/// The numbers in which the forms are judged.
const JUDGED: [Rung; 4] = [Rung::Single, Rung::Double, Rung::DoubleDouble, Rung::Wide(50)];

/// The rows of a point, all numbers and both forms; `None` where the inputs are those of no motion.
///
/// # Errors
/// Those of [`Judge::new`].
pub(super) fn rows(quantity: &impl Quantity, inputs: &[f64]) -> Result<Option<Vec<StressRow>>, StressError> {
    let Some(judge) = Judge::new(quantity, inputs)? else {
        return Ok(None);
    };
    let condition = judge.condition(quantity);
    let mut rows = Vec::new();
    for form in [Form::Printed, Form::Stable] {
        let kept = JUDGED.map(|rung| {
            // one copy of all formulas does for every type: the values are those of the type itself
            of_type(rung, || {
                let epsilon = <Any as Analytic>::epsilon().to_f64();
                (rung, judge.digits::<Any>(quantity, form), epsilon)
            })
        });
        rows.extend(kept.map(|(number, digits, epsilon)| StressRow {
            case: quantity.case().to_owned(),
            formula: quantity.formula().to_owned(),
            number: number.to_string(),
            form,
            digits,
            condition,
            at: place(quantity.inputs(), inputs),
            allowed: allowed(epsilon, condition),
            frozen: None,
            answer: String::new(),
        }));
    }
    Ok(Some(rows))
}

/// The largest of some sizes; unlike `f64::max` this lets NaN through.
pub(super) fn largest(sizes: impl IntoIterator<Item = f64>) -> f64 {
    sizes
        .into_iter()
        .fold(0.0, |most, size| if size <= most { most } else { size })
}

/// The largest size of a component; in Exact, where what is below the range of f64 has digits too.
fn size(values: &[Exact]) -> Exact {
    values.iter().cloned().fold(Exact::from(0.0), |most, value| {
        let size = if value < 0.0 { -value } else { value };
        if size > most { size } else { most }
    })
}

/// The largest difference over the largest exact value, 0 for 0/0.
fn apart(found: &[Exact], exact: &[Exact]) -> f64 {
    if found.len() != exact.len() {
        return f64::NAN;
    }
    let size = size(exact);
    largest(found.iter().zip(exact).map(|(found, exact)| {
        let apart = found.clone() - exact.clone();
        let is_same = num_traits::Zero::is_zero(&apart);
        if is_same {
            0.0
        } else {
            (apart / size.clone()).to_f64().abs()
        }
    }))
}

/// So many pieces of f64 make a number of the widest type that is judged.
const PIECES: usize = 5;

/// An exact value, rounded to `T`.
pub(super) fn narrow<T: Analytic>(value: &Exact) -> T {
    let (mut rest, mut sum) = (value.clone(), T::zero());
    for _ in 0..PIECES {
        let piece = rest.to_f64();
        sum += T::from_f64(piece);
        rest -= <Exact as Analytic>::from_f64(piece);
        if num_traits::Zero::is_zero(&rest) {
            break;
        }
    }
    sum
}

/// A number of `T`, exactly.
pub(super) fn widen<T: Analytic>(value: &T) -> Exact {
    let (mut rest, mut sum) = (value.clone(), Exact::from(0.0));
    for _ in 0..PIECES {
        let piece = rest.to_f64();
        sum += <Exact as Analytic>::from_f64(piece);
        rest -= T::from_f64(piece);
        if rest.is_zero() {
            break;
        }
    }
    sum
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Holds every setting of a quantity to its reference, in the number that judges: the stable form as the judge
    /// does, and the printed one.
    pub struct Agreeing;

    impl Visitor for Agreeing {
        fn visit(&mut self, quantity: &impl Quantity) -> Result<(), StressError> {
            for setting in quantity.settings() {
                let inputs = quantity.set(&setting);
                let judge = Judge::new(quantity, &inputs)?.expect("a motion");
                let printed = quantity.printed(&judge.given).expect("a value");
                let apart = apart(&printed, &judge.exact);
                assert!(
                    apart < 1e-30,
                    "{} {} at {inputs:?}: {apart:e}",
                    quantity.case(),
                    quantity.formula()
                );
            }
            Ok(())
        }
    }

    /// 1 - x for x near 1, printed as (1 - x²)/(1 + x).
    pub struct Loss {
        pub broken: bool,
    }

    impl Quantity for Loss {
        fn case(&self) -> &'static str {
            "x near 1"
        }
        fn formula(&self) -> &'static str {
            "1 - x"
        }
        fn inputs(&self) -> &'static [&'static str] {
            &["x"]
        }
        fn dials(&self) -> Vec<[f64; 2]> {
            vec![[-15.0, -1.0]]
        }
        fn set(&self, dials: &[f64]) -> Vec<f64> {
            dials.iter().map(|dial| 1.0 - 10_f64.powf(*dial)).collect()
        }
        fn settings(&self) -> Vec<Vec<f64>> {
            vec![vec![-8.0]]
        }
        fn given<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
            Some(inputs.to_vec())
        }
        fn reference<T: Number>(&self, inputs: &[T]) -> Option<Vec<T>> {
            let x = inputs.first()?.clone();
            let square = x.clone() * x.clone();
            Some(vec![
                (<T as num_traits::One>::one() - square) / (x + <T as num_traits::One>::one()),
            ])
        }
        fn printed<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
            self.reference(given)
        }
        fn stable<T: Number>(&self, given: &[T]) -> Option<Vec<T>> {
            let x = given.first()?.clone();
            let two = T::from_integer(if self.broken { 2 } else { 1 });
            Some(vec![two - x])
        }
    }

    #[test]
    fn digits_are_those_that_cancellation_leaves() {
        let rows = rows(&Loss { broken: false }, &[1.0 - 1e-8]).unwrap().unwrap();
        let digits = |form, number: &str| {
            let row = rows
                .iter()
                .find(|row| row.form == form && row.number == number)
                .unwrap();
            row.digits
        };
        assert!((7.0..9.5).contains(&digits(Form::Printed, "f64")));
        assert!(digits(Form::Stable, "f64") > 15.9);
        // the square of a number of f64 is exact there
        assert!(digits(Form::Printed, "double-double") > 31.0);
        // f32 cannot even hold the input
        assert!(digits(Form::Stable, "f32") < 1.0);
        assert!(rows.iter().all(|row| (row.condition / 1e8 - 1.0).abs() < 1e-6));
        assert!(!rows.iter().any(StressRow::is_below_bar));
    }

    #[test]
    fn a_reference_that_disagrees_judges_nothing() {
        let found = rows(&Loss { broken: true }, &[0.5]);
        assert!(matches!(found, Err(StressError::Reference { .. })), "{found:?}");
    }

    #[test]
    fn numbers_go_back_and_forth_unchanged() {
        let third = Exact::from(1.0) / Exact::from(3.0);
        let narrowed: Wide<50> = narrow(&third);
        assert!((widen(&narrowed) / third.clone() - Exact::from(1.0)).to_f64().abs() < 1e-50);
        assert_eq!(narrow::<f64>(&third), 1.0 / 3.0);
        assert_eq!(widen(&(1.0_f32 / 3.0)).to_f64(), f64::from(1.0_f32 / 3.0));
        assert!(widen(&f64::NAN).to_f64().is_nan());
    }
}
