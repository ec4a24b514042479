//! Where a period doubling or a symmetry breaking is degenerate: the cubic coefficients of what parts there.
//!
//! Near a 1-1 motion with a multiplier of -1 the equations F(phases) = 0 of BTBT over 2 n periods have solutions
//! u + s q + s² a + ..., q and -q in the two halves, a the same in both (Lyapunov and Schmidt; Kuznetsov, *Elements of
//! Applied Bifurcation Theory*, 2004, 4.5): F' q = 0, F' a = -F''(q, q)/2, and the parameter turns with s² times the part
//! of s³ in F(u + s q + s² a) along the left kernel of F'. Where that changes its sign, a branch of stable motions of
//! twice the period becomes one of unstable ones.

use crate::model::Motion;
use crate::orbit::equations::one_one::OneOneEquations;
use crate::orbit::equations::words::WordEquations;
use crate::orbit::word::Word;
use num_dual::DualNum;
use numbers::{Analytic, Dual};

/// The part of s³, times a factor that is not 0 where the entries of F' that are in `kernels` are not: of this row q, of
/// this column the left kernel.
pub(crate) fn doubling_coefficient<T: Analytic + DualNum>(
    motion: &Motion<T>,
    periods: u32,
    [t_1, middle]: [&T; 2],
    kernels: [usize; 2],
) -> Option<T> {
    let phases = doubled(motion, periods, [t_1, middle]);
    let system = system(motion, periods, Clone::clone)?;
    let jacobian = system.jacobian(&phases);
    let [odd, even] = halves(&jacobian);
    let [row, column] = kernels;
    let q = [-odd[row][1].clone(), odd[row][0].clone()];
    let left = [-odd[1][column].clone(), odd[0][column].clone()];

    let twice = system_of(&system, |value| Dual::from_re(Dual::from_re(value.clone())))?;
    let s = Dual::new(Dual::new(T::zero(), T::one()), Dual::from_re(T::one()));
    let lifted = |value: &T| Dual::from_re(Dual::from_re(value.clone()));
    let along: Vec<_> = (0..4)
        .map(|i| lifted(&phases[i]) + lifted(&signed(&q, i)) * s.clone())
        .collect();
    let curved: Vec<T> = twice.residuals(&along).into_iter().map(|value| value.eps.eps).collect();
    let determinant = even[0][0].clone() * even[1][1].clone() - even[0][1].clone() * even[1][0].clone();
    let half = T::from_ratio(-1, 2) / determinant;
    let a = [
        (even[1][1].clone() * curved[0].clone() - even[0][1].clone() * curved[1].clone()) * half.clone(),
        (even[0][0].clone() * curved[1].clone() - even[1][0].clone() * curved[0].clone()) * half,
    ];

    let lifted = |value: &T| Dual::from_re(Dual::from_re(Dual::from_re(value.clone())));
    let thrice = system_of(&system, lifted)?;
    let s = Dual::new(
        Dual::new(Dual::new(T::zero(), T::one()), Dual::from_re(T::one())),
        Dual::from_re(Dual::from_re(T::one())),
    );
    let along: Vec<_> = (0..4)
        .map(|i| {
            let bent = lifted(&signed(&q, i)) + lifted(&a[i % 2]) * s.clone();
            lifted(&phases[i]) + bent * s.clone()
        })
        .collect();
    let cubic: Vec<T> = thrice
        .residuals(&along)
        .into_iter()
        .map(|value| value.eps.eps.eps)
        .collect();
    Some(left[0].clone() * cubic[0].clone() + left[1].clone() * cubic[1].clone())
}

/// The part of s³ where motions with T_1 = n + s part from those with T_1 = T_2, on motions that are their own mirror images:
/// of the two equations that of index `odd` vanishes on all of the latter, and the other one gives the phase psi with s².
pub(crate) fn breaking_coefficient<T: Analytic + DualNum>(
    motion: &Motion<T>,
    periods: u32,
    [t_1, middle]: [&T; 2],
    odd: usize,
) -> Option<T> {
    let even = 1 - odd;
    let [by_t, by_psi] = OneOneEquations::new(motion, periods).linearised(t_1, middle).1[even].clone();
    let q = [by_psi.clone(), -by_t];

    let lifted = |value: &T| Dual::from_re(Dual::from_re(value.clone()));
    let s = Dual::new(Dual::new(T::zero(), T::one()), Dual::from_re(T::one()));
    let twice = OneOneEquations::new(&motion.convert(lifted).ok()?, periods);
    let along = [t_1, middle].map(lifted);
    let along: [_; 2] = std::array::from_fn(|i| along[i].clone() + lifted(&q[i]) * s.clone());
    let curved = twice.residual(&along[0], &along[1])[even].eps.eps.clone();
    let a = T::from_ratio(-1, 2) * curved / by_psi;

    let lifted = |value: &T| Dual::from_re(Dual::from_re(Dual::from_re(value.clone())));
    let s = Dual::new(
        Dual::new(Dual::new(T::zero(), T::one()), Dual::from_re(T::one())),
        Dual::from_re(Dual::from_re(T::one())),
    );
    let thrice = OneOneEquations::new(&motion.convert(lifted).ok()?, periods);
    let along = [
        lifted(t_1) + lifted(&q[0]) * s.clone(),
        lifted(middle) + (lifted(&q[1]) + lifted(&a) * s.clone()) * s,
    ];
    let [first, second] = thrice.residual(&along[0], &along[1]);
    Some([first, second][odd].eps.eps.eps.clone())
}

/// Which of the two equations vanishes on all motions with T_1 = T_2.
pub(crate) fn odd_equation(motion: &Motion<f64>, periods: u32, [t_1, middle]: [&f64; 2]) -> usize {
    let [[_, first], [_, second]] = OneOneEquations::new(motion, periods).linearised(t_1, middle).1;
    usize::from(second.abs() < first.abs())
}

/// The row and the column of the largest entry of F' over what is q and -q in the halves.
pub(crate) fn kernels(motion: &Motion<f64>, periods: u32, at: [&f64; 2]) -> Option<[usize; 2]> {
    let phases = doubled(motion, periods, at);
    let [odd, _] = halves(&system(motion, periods, Clone::clone)?.jacobian(&phases));
    let size = |row: usize, column: usize| odd[row][column].abs();
    let row = usize::from(size(1, 0).hypot(size(1, 1)) > size(0, 0).hypot(size(0, 1)));
    let column = usize::from(size(0, 1).hypot(size(1, 1)) > size(0, 0).hypot(size(1, 0)));
    Some([row, column])
}

/// Part `i` of what is q in the first half and -q in the second.
fn signed<T: Analytic>(q: &[T; 2], i: usize) -> T {
    let part = q[i % 2].clone();
    if i < 2 { part } else { -part }
}

/// The phases of the motion gone through twice.
fn doubled<T: Analytic>(motion: &Motion<T>, periods: u32, [t_1, middle]: [&T; 2]) -> Vec<T> {
    let [bottom, top] = OneOneEquations::new(motion, periods).phases(t_1, middle);
    let turns = T::from_integer(2 * i64::from(periods)) * T::pi();
    vec![bottom.clone(), top.clone(), bottom + turns.clone(), top + turns]
}

/// The equations of BTBT over another number.
fn system<T: Analytic, U: Analytic>(
    motion: &Motion<T>,
    periods: u32,
    convert: impl Fn(&T) -> U,
) -> Option<WordEquations<U>> {
    Some(WordEquations {
        motion: motion.convert(convert).ok()?,
        word: Word::pair().twice()?,
        periods: 2 * periods,
    })
}

fn system_of<T: Analytic, U: Analytic>(
    system: &WordEquations<T>,
    convert: impl Fn(&T) -> U,
) -> Option<WordEquations<U>> {
    system.convert(convert).ok()
}

/// F' on what is q and -q in the halves, and on what is the same in both.
fn halves<T: Analytic>(jacobian: &[Vec<T>]) -> [[[T; 2]; 2]; 2] {
    let part = |row: usize, column: usize| jacobian[row][column].clone();
    let entry = |odd: bool| {
        std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let other = part(row, column + 2);
                part(row, column) + if odd { -other } else { other }
            })
        })
    };
    [entry(true), entry(false)]
}
