//! A quantity at the points where its formula loses digits, and how its forms are judged there.

use super::StressError;
use super::approach::Approach;
use super::row::{Evaluation, Form, StressRow, place};
use crate::trade::digits_of;
use num_dual::DualNum;
use numbers::{Analytic, Any, Dual, Rung, Wide, of_type, seeded};

/// A number that every form works over, dual numbers among them.
pub(super) trait Number: Analytic + DualNum {}
impl<T: Analytic + DualNum> Number for T {}

/// The number that judges: fifty digits beyond the widest one that is judged.
pub(super) type Exact = Wide<100>;

/// The reference and the form of this program, both in the number that judges, have to agree this far.
pub(super) const REFERENCE_DIGITS: f64 = 60.0;

/// A quantity near an extreme. Its inputs are numbers of f64, taken as exact; what a form is given, the parameters and
/// the state of a motion that they fix, are the exact values rounded once to the number of the form.
pub(super) trait Quantity: Sync {
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
    /// The extreme that is approached step by step.
    fn approach(&self) -> Approach;
    /// The dials where the distance from the extreme is 10^`exponent`; both where there are two ways there.
    fn near(&self, exponent: f64) -> Vec<Vec<f64>>;
    /// The exponents of the settings that are always looked at, from harmless to extreme.
    fn exponents(&self) -> Vec<f64>;
    /// The settings that are always looked at.
    fn settings(&self) -> Vec<Vec<f64>> {
        let exponents = self.exponents().into_iter();
        exponents.flat_map(|exponent| self.near(exponent)).collect()
    }
    /// The names of what the forms are given, in the order of [`Quantity::given`]; those of the inputs among them.
    fn given_names(&self) -> &'static [&'static str] {
        self.inputs()
    }
    /// Those of them that are no inputs.
    fn derived_names(&self) -> Vec<&'static str> {
        let given = self.given_names().iter().copied();
        given.filter(|name| !self.inputs().contains(name)).collect()
    }
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

    /// What is given, rounded to `T`.
    fn given<T: Number>(&self) -> Vec<T> {
        self.given.iter().map(narrow).collect()
    }

    /// What is given beyond the inputs, as the forms in the number `rung` are given it.
    fn derived(&self, quantity: &impl Quantity, rung: Rung) -> String {
        let text = |value: &Any| match rung {
            Rung::Single | Rung::Double => format!("{:?}", value.to_f64()),
            _ => widen(value).convert::<READ_BACK>().to_string(),
        };
        let given = quantity.given_names().iter().zip(self.given::<Any>());
        given
            .filter(|(name, _)| !quantity.inputs().contains(name))
            .map(|(name, value)| format!(";{name}={}", text(&value)))
            .collect()
    }

    /// The relative error of `form` in `T`; NaN where it has no answer.
    pub fn error<T: Number>(&self, quantity: &impl Quantity, form: Form) -> f64 {
        let given = self.given::<T>();
        let found = match form {
            Form::Printed => quantity.printed(&given),
            _ => quantity.stable(&given),
        };
        found.map_or(f64::NAN, |found| {
            let found: Vec<Exact> = found.iter().map(widen).collect();
            apart(&found, &self.exact)
        })
    }
}

/// The decimal digits by which a number of double-double, whose lower part may be far below the higher one, and one of fifty
/// digits with those that guard it read back to the same.
const READ_BACK: usize = 64;

/// The numbers in which the forms are judged.
pub(super) const JUDGED: [Rung; 4] = [Rung::Single, Rung::Double, Rung::DoubleDouble, Rung::Wide(50)];

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
    let at = place(quantity.inputs(), inputs);
    for form in [Form::Printed, Form::Stable] {
        rows.extend(JUDGED.map(|rung| {
            // one copy of all formulas does for every type: the values are those of the type itself
            of_type(rung, || {
                let evaluation = Evaluation::of::<Any>(rung, form, judge.error::<Any>(quantity, form));
                let at = format!("{at}{}", judge.derived(quantity, rung));
                StressRow::new(quantity.case(), quantity.formula(), evaluation, condition, at)
            })
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

    /// In the last bit a wider number may not read back; where digits cancel, a form then keeps about as many others.
    const REWRITTEN: f64 = 2.0;

    /// Evaluates every row of every setting again from its `at` alone, its own names and numbers.
    pub struct Again;

    impl Visitor for Again {
        fn visit(&mut self, quantity: &impl Quantity) -> Result<(), StressError> {
            for setting in quantity.settings() {
                let inputs = quantity.set(&setting);
                let judge = Judge::new(quantity, &inputs)?.expect("a motion");
                for row in rows(quantity, &inputs)?.expect("a motion") {
                    let at: Vec<(&str, &str)> = row.at.split(';').filter_map(|pair| pair.split_once('=')).collect();
                    let text = |name: &str| {
                        let found = at.iter().find(|(own, _)| *own == name);
                        found.expect("named in `at`").1
                    };
                    // an input is a number of f64, whatever the row's own
                    let value = |name: &&str| match quantity.inputs().contains(name) {
                        true => Exact::from(text(name).parse::<f64>().expect("an input")),
                        false => Exact::parse(text(name)).expect("a number"),
                    };
                    let given: Vec<Exact> = quantity.given_names().iter().map(value).collect();
                    let again = Judge {
                        inputs: judge.inputs.clone(),
                        exact: judge.exact.clone(),
                        given,
                    };
                    let rung = Rung::named(&row.number).expect("a number type");
                    let (error, epsilon) = of_type(rung, || {
                        let epsilon = <Any as Analytic>::epsilon().to_f64();
                        (again.error::<Any>(quantity, row.form), epsilon)
                    });
                    let apart = (digits_of(error, epsilon) - row.digits).abs();
                    let is_exact = rung <= Rung::Double;
                    assert!(apart == 0.0 || !is_exact && apart < REWRITTEN, "{row:#?}: {apart}");
                }
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
        fn approach(&self) -> Approach {
            Approach::ALL[1]
        }
        fn near(&self, exponent: f64) -> Vec<Vec<f64>> {
            vec![vec![exponent]]
        }
        fn exponents(&self) -> Vec<f64> {
            vec![-8.0]
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
