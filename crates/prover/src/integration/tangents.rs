//! Sines and cosines as rational functions of one tangent, and back without the jumps of the tangent.

use super::fraction::{Fraction, times};
use super::tower::{Kind, Tower, one_of};
use crate::algebra::{coefficients_in, degree_in, exponent, power};
use dashu_ratio::RBig;
use kernel::{Polynomial, Term};
use numbers::{Field, Rational};

/// The tangent that a sine and its cosine are expressed by.
#[derive(Clone, Debug)]
pub(super) struct Tangent {
    pub tangent: Term,
    sine: Term,
    is_half: bool,
}

/// The degrees in a sine and its cosine are all even, or all odd, where the bit 0, or the bit 1, is set.
fn parities(p: &Polynomial, sine: Term) -> u8 {
    let of = |monomial| (exponent(monomial, sine) + exponent(monomial, Term(sine.0 + 1))) % 2;
    p.terms().iter().fold(0, |met, (monomial, _)| met | (1 << of(monomial)))
}

fn repeats_in_half_turn(f: &Fraction, sine: Term) -> bool {
    let (above, below) = (parities(&f.above, sine), parities(&f.below, sine));
    above | below != 3 || f.is_zero()
}

/// The tangents for all sines in these: of the angle where all repeat after half a turn, else of half of it.
pub(super) fn tangents(tower: &mut Tower, of: &[Fraction]) -> Option<Vec<Tangent>> {
    let mut found = Vec::new();
    for place in 0..tower.kinds.len() {
        let sine = Term(u32::try_from(place).ok()?);
        let Kind::Sine(angle) = tower.kind(sine).clone() else {
            continue;
        };
        let occurs = |f: &Fraction| f.holds(sine) || f.holds(Term(sine.0 + 1));
        if !tower.varies(sine) || !of.iter().any(occurs) {
            continue;
        }
        let is_half = !of.iter().all(|f| repeats_in_half_turn(f, sine));
        let tangent = tower.term_of(Kind::Tangent { angle, is_half, sine });
        found.push(Tangent { tangent, sine, is_half });
    }
    Some(found)
}

impl Tangent {
    /// The quotient with the tangent for the sine and the cosine.
    pub fn put_in(&self, f: &Fraction, tower: &mut Tower) -> Option<Fraction> {
        if !f.holds(self.sine) && !f.holds(Term(self.sine.0 + 1)) {
            return Some(f.clone());
        }
        let (above, degree) = self.polynomial(&f.above, tower)?;
        let (below, other) = self.polynomial(&f.below, tower)?;
        let difference = i32::try_from(other).ok()? - i32::try_from(degree).ok()?;
        let exponent = if self.is_half { difference } else { difference / 2 };
        let square = Fraction::of(self.secant_squared()).power(exponent, &mut tower.steps)?;
        Fraction::new(&above, &below, &mut tower.steps)?.times(&square, &mut tower.steps)
    }

    /// `1 + t^2`.
    pub fn secant_squared(&self) -> Polynomial {
        Polynomial::integer(1).plus(&one_of(self.tangent, 2))
    }

    /// The polynomial times this power of `1 + t^2`, or of its root where the tangent is of the whole angle.
    fn polynomial(&self, p: &Polynomial, tower: &mut Tower) -> Option<(Polynomial, u32)> {
        let cosine = Term(self.sine.0 + 1);
        let degree = |monomial: &kernel::Monomial| exponent(monomial, self.sine) + exponent(monomial, cosine);
        let highest = p
            .terms()
            .iter()
            .map(|(monomial, _)| degree(monomial))
            .max()
            .unwrap_or(0);
        let square = self.secant_squared();
        let mut total = Polynomial::default();
        for (monomial, coefficient) in p.terms() {
            let (sines, cosines) = (exponent(monomial, self.sine), exponent(monomial, cosine));
            let rest = monomial
                .iter()
                .filter(|(term, _)| *term != self.sine && *term != cosine)
                .copied();
            let mut part = Polynomial::from_terms([(rest.collect(), coefficient.clone())]);
            part = times(&part, &one_of(self.tangent, sines), &mut tower.steps).ok()?;
            let missing = highest - sines - cosines;
            let missing = if self.is_half { missing } else { missing / 2 };
            part = times(
                &part,
                &power(&square, missing, &mut tower.steps).ok()?,
                &mut tower.steps,
            )
            .ok()?;
            if self.is_half {
                let difference = Polynomial::integer(1).minus(&one_of(self.tangent, 2));
                let factor = power(&difference, cosines, &mut tower.steps).ok()?;
                part = times(&part, &factor, &mut tower.steps).ok()?;
                part = part.scaled(&Rational(RBig::from(2).pow(sines as isize)));
            }
            total = total.plus(&part);
        }
        Some((total, highest))
    }

    fn back_polynomial(&self, p: &Polynomial, degree: u32, tower: &mut Tower) -> Option<Polynomial> {
        let (sine, cosine) = (
            Polynomial::generator(self.sine),
            Polynomial::generator(Term(self.sine.0 + 1)),
        );
        let half = Rational::from_ratio(1, 2);
        let one = Polynomial::integer(1);
        let (down, up) = (one.minus(&cosine).scaled(&half), one.plus(&cosine).scaled(&half));
        let mut total = Polynomial::default();
        for (exponent, coefficient) in (0_u32..).zip(coefficients_in(p, self.tangent)) {
            let rest = degree.checked_sub(exponent)?;
            let (left, right) = match self.is_half {
                true => (
                    power(&down, exponent / 2, &mut tower.steps).ok()?,
                    power(&up, rest / 2, &mut tower.steps).ok()?,
                ),
                false => (
                    power(&sine, exponent, &mut tower.steps).ok()?,
                    power(&cosine, rest, &mut tower.steps).ok()?,
                ),
            };
            let mut part = times(
                &coefficient,
                &times(&left, &right, &mut tower.steps).ok()?,
                &mut tower.steps,
            )
            .ok()?;
            if self.is_half && exponent % 2 == 1 {
                part = times(&part, &sine.scaled(&half), &mut tower.steps).ok()?;
            }
            total = total.plus(&part);
        }
        tower.reduced(&total)
    }

    /// The quotient with sines and cosines for the tangent.
    fn back(&self, f: &Fraction, tower: &mut Tower) -> Option<Fraction> {
        if !f.holds(self.tangent) {
            return Some(f.clone());
        }
        let (high, low) = (degree_in(&f.above, self.tangent), degree_in(&f.below, self.tangent));
        let (mut above, mut below, mut degree) = (f.above.clone(), f.below.clone(), high.max(low));
        if self.is_half && degree % 2 == 1 {
            // where half the angle is a right one, only what is infinite there may get a zero below
            if low >= high {
                above = times(&above, &f.below, &mut tower.steps).ok()?;
                below = times(&below, &f.below, &mut tower.steps).ok()?;
                degree *= 2;
            } else {
                degree += 1;
            }
        }
        let above = self.back_polynomial(&above, degree, tower)?;
        let below = self.back_polynomial(&below, degree, tower)?;
        Fraction::new(&above, &below, &mut tower.steps)
    }

    /// The polynomial, times a power of the cosine of the angle of the tangent that makes it one in sines and cosines; and
    /// this power. Of half an angle only an even one does.
    pub fn made_whole(&self, p: &Polynomial, tower: &mut Tower) -> Option<(Polynomial, u32)> {
        let degree = degree_in(p, self.tangent);
        match self.is_half && degree % 2 == 1 {
            true => None,
            false => Some((self.back_polynomial(p, degree, tower)?, degree)),
        }
    }

    /// `t t'/(1 + t^2)`, the derivative of the logarithm of the secant of its angle.
    pub fn slope_of_secant(&self, tower: &mut Tower) -> Option<Fraction> {
        let slope = tower.slope(self.tangent)?;
        let above = tower.times(&slope, &Fraction::generator(self.tangent))?;
        tower.over(&above, &Fraction::of(self.secant_squared()))
    }

    /// The sine and the cosine of twice the angle of the tangent, and the angle of the tangent.
    pub fn doubled(&self, tower: &mut Tower) -> Option<[Fraction; 3]> {
        let (sine, cosine) = (
            Fraction::generator(self.sine),
            Fraction::generator(Term(self.sine.0 + 1)),
        );
        let Kind::Sine(angle) = tower.kind(self.sine).clone() else {
            return None;
        };
        if self.is_half {
            return Some([sine, cosine, angle.scaled(&Rational::from_ratio(1, 2))]);
        }
        let two = Rational::from_integer(2);
        let square = sine.times(&sine, &mut tower.steps)?.scaled(&Rational::from_integer(-2));
        let twice = Fraction::integer(1).plus(&square, &mut tower.steps)?;
        Some([sine.times(&cosine, &mut tower.steps)?.scaled(&two), twice, angle])
    }

    /// The power of the cosine of the angle of the tangent, with its sign turned, that [`Self::inverse_of_secant`] is.
    pub fn power_of_inverse(&self) -> Rational {
        Rational::from_integer(if self.is_half { -2 } else { -1 })
    }

    /// The cosine of the angle of the tangent, or twice its square.
    pub fn inverse_of_secant(&self) -> Polynomial {
        let cosine = Polynomial::generator(Term(self.sine.0 + 1));
        match self.is_half {
            true => Polynomial::integer(1).plus(&cosine),
            false => cosine,
        }
    }
}

/// The quotient with sines and cosines for all tangents.
pub(super) fn without_tangents(tangents: &[Tangent], f: &Fraction, tower: &mut Tower) -> Option<Fraction> {
    let mut f = f.clone();
    for tangent in tangents {
        f = tangent.back(&f, tower)?;
    }
    Some(f)
}

impl Tangent {
    /// True if only the square of the polynomial is made whole.
    pub fn made_whole_is_odd(&self, p: &Polynomial) -> bool {
        self.is_half && degree_in(p, self.tangent) % 2 == 1
    }
}
