//! The proof that one curve of solutions, and no other, leads from a point to the next.

use crate::orbit::continuation::curve::{CurveEquations, dot};
use crate::orbit::interval_box::apart;
use crate::orbit::solve::contraction::{contraction, largest, times};
use numbers::{Field, Interval};

/// How wide a tube is, as a part of its length.
const SLENDER: f64 = 0.25;

/// A tube reaches beyond its ends by this part of its length: well above the rounding of the ends, so that the curve
/// in it is the curve in the next one.
const OVERLAP: f64 = 1e-4;

/// A tube with one piece of curve in it.
///
/// c(tau) the chord, X the box around it within R in the maximum norm, Y about the inverse of the derivative with the
/// direction of the chord as last row: for each tau the plane across the chord at c(tau) holds one solution of the
/// equations within R of it, and no other, if |I - Y G'| <= q < 1 on X and |Y G(c(tau))| < (1 - q) R for all tau
/// (Krawczyk, as for one solution, with tau as a parameter). Both are checked in intervals: the solutions in the tube are
/// one curve from end to end.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CertifiedSegment {
    from: Vec<f64>,
    chord: Vec<f64>,
    /// R
    pub radius: f64,
}

impl CertifiedSegment {
    /// The proof for the piece between two points of a curve; `None` where intervals are too coarse for its length.
    pub fn prove(curve: &impl CurveEquations, from: &[f64], to: &[f64]) -> Option<Self> {
        let chord: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
        let square = dot(&chord, &chord);
        let radius = SLENDER * square.sqrt();
        let normal: Vec<f64> = chord.iter().map(|part| part / square).collect();
        let middle: Vec<f64> = from.iter().zip(to).map(|(from, to)| 0.5 * (from + to)).collect();
        let (_, matrix) = curve.bordered(&middle, &normal)?;
        let inverse = matrix.try_inverse()?;
        if !inverse.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        let ends = from
            .iter()
            .zip(to)
            .map(|(from, to)| Interval::point(*from).hull(&Interval::point(*to)));
        let cell: Vec<_> = ends.map(|side| side + Interval::new(-radius, radius)).collect();
        let mut rows = curve.slopes(&cell)?;
        rows.push(normal.iter().map(|part| Interval::point(*part)).collect());
        let contraction = contraction(&inverse, &rows);
        if contraction.is_nan() || contraction >= 1.0 {
            return None;
        }
        // G at the middle, then along the chord by the mean value theorem
        let at: Vec<_> = middle.iter().map(|side| Interval::point(*side)).collect();
        let mut values = curve.values(&at)?;
        values.push(Interval::point(0.0));
        let along = |row: &Vec<Interval<f64>>| {
            let terms = row.iter().zip(&chord);
            terms.fold(Interval::point(0.0), |sum, (slope, part)| {
                sum + *slope * Interval::point(*part)
            })
        };
        let along: Vec<_> = rows.iter().map(along).collect();
        let reach = Interval::new(-0.5 - OVERLAP, 0.5 + OVERLAP);
        let count = values.len();
        let distances = times(&inverse, &values).into_iter().zip(times(&inverse, &along));
        let distances = distances.enumerate().map(|(row, (at_middle, across))| {
            // the plane moves with tau, by as much as the chord does across it
            let plane = Interval::point(inverse[(row, count - 1)]);
            at_middle + (across - plane) * reach
        });
        let farthest = largest(&distances.collect::<Vec<_>>());
        let room = (Interval::from_integer(1) - Interval::point(contraction)) * Interval::point(radius);
        (farthest < room.low()).then(|| Self {
            from: from.to_vec(),
            chord,
            radius,
        })
    }

    /// Whether a solution within `room` of a point is the one of this tube in its plane across the chord.
    pub fn holds(&self, point: &[f64], room: f64) -> bool {
        let ahead: Vec<f64> = point.iter().zip(&self.from).map(|(point, from)| point - from).collect();
        let square = dot(&self.chord, &self.chord);
        let part = dot(&ahead, &self.chord) / square;
        let on: Vec<f64> = self.chord.iter().map(|chord| part * chord).collect();
        // the room along the chord, as a part of it
        let within = OVERLAP - room * (point.len() as f64 / square).sqrt();
        (-within..=1.0 + within).contains(&part) && apart(&ahead, &on) + 2.0 * room < self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Motion;
    use crate::orbit::continuation::extended_system::ExtendedSystem;
    use crate::orbit::family::Family;
    use crate::orbit::options::OrbitOptions;
    use crate::orbit::solve::words::search_word;

    #[test]
    fn a_tube_holds_the_motions_of_its_piece_and_no_others() {
        let family = Motion::new(0.12201, 0.3, 0.6, 0.3).expect("a motion");
        let extended = ExtendedSystem {
            family: &family,
            word: "BTT".parse().expect("a word"),
            periods: 1,
            range: Interval::new(0.1, 0.5),
            options: OrbitOptions::DEFAULT,
        };
        let at = |place: f64| {
            family
                .motion_at(&extended.parameter(&Interval::point(place)))
                .expect("a motion")
        };
        let cycles = search_word(&extended.word, 1, &at(0.25), &OrbitOptions::DEFAULT).expect("a search");
        assert!(!cycles.is_empty());
        for cycle in &cycles {
            let (from, _) = extended
                .solved_at(&[cycle.phases(), &[0.25]].concat(), 3, 0.25)
                .expect("a motion");
            let (middle, _) = extended.solved_at(&from, 3, 0.2502).expect("a motion");
            let (to, _) = extended.solved_at(&middle, 3, 0.2504).expect("a motion");
            let segment = CertifiedSegment::prove(&extended, &from, &to).expect("a proof");
            assert!([&from, &middle, &to].iter().all(|point| segment.holds(point, 0.0)));
            let beside: Vec<f64> = middle.iter().map(|side| side + 2.0 * segment.radius).collect();
            assert!(!segment.holds(&beside, 0.0));
            // a chord that leads away from the curve is none
            assert_eq!(CertifiedSegment::prove(&extended, &from, &beside), None);
        }
    }
}
