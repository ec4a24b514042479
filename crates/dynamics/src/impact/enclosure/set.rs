//! The states that a departure may have: a turned rectangle.

use numbers::{Analytic, Endpoint, Interval};

/// A square matrix over intervals, by rows.
type Matrix<E> = [[Interval<E>; 2]; 2];

/// A set of phases and speeds: a centre, and a rectangle around it turned with what errors have become (R. Lohner, 1987,
/// "QR-decomposition method"), so that what shrinks in one direction is not blown up by what grows in the other. Within
/// the box `hull`.
#[derive(Clone, Debug)]
pub(super) struct Set<E: Endpoint> {
    centre: [E; 2],
    /// The axes, by columns; orthogonal but for rounding.
    axes: [[f64; 2]; 2],
    sides: [Interval<E>; 2],
    hull: [Interval<E>; 2],
}

impl<E: Endpoint> Set<E> {
    /// All of a box.
    pub fn of(hull: [Interval<E>; 2]) -> Self {
        let centre = hull.each_ref().map(Interval::midpoint);
        Self {
            sides: apart(&hull, &centre),
            centre,
            axes: [[1.0, 0.0], [0.0, 1.0]],
            hull,
        }
    }

    /// A box that holds all of it.
    pub fn hull(&self) -> &[Interval<E>; 2] {
        &self.hull
    }

    /// The centre, as a box.
    pub fn centre(&self) -> [Interval<E>; 2] {
        self.centre.clone().map(Interval::point)
    }

    /// What a map makes of the set: `image` holds that of the centre, `slopes` its derivatives on the hull, `hull` all of
    /// what comes out. `None` where these contradict each other, or have lost all bounds.
    pub fn mapped(&self, image: [Interval<E>; 2], slopes: &Matrix<E>, hull: &[Interval<E>; 2]) -> Option<Self> {
        let turned = product(slopes, &self.axes.map(|row| row.map(Interval::from_f64)));
        let column = |index: usize| [0, 1].map(|row| turned[row][index].to_f64());
        let reach = |index: usize| {
            let [x, y] = column(index);
            x.hypot(y) * self.sides[index].magnitude().to_f64()
        };
        let [x, y] = column(usize::from(reach(1) > reach(0)));
        let length = x.hypot(y);
        let (cos, sin) = if length > 0.0 && length.is_finite() {
            (x / length, y / length)
        } else {
            (1.0, 0.0)
        };
        let axes = [[cos, -sin], [sin, cos]];
        let [cos, sin] = [cos, sin].map(Interval::<E>::from_f64);
        let size = cos.square() + sin.square();
        let back = [
            [cos.clone() / size.clone(), sin.clone() / size.clone()],
            [-sin / size.clone(), cos / size],
        ];
        // a centre in the hull, on which the derivatives hold
        let [phase, speed] = &image;
        let image = [phase.intersection(&hull[0])?, speed.intersection(&hull[1])?];
        let centre = image.each_ref().map(Interval::midpoint);
        let moved = applied(&product(&back, &turned), &self.sides);
        let off = applied(&back, &apart(&image, &centre));
        let sides = added(moved, off);
        let around = applied(&axes.map(|row| row.map(Interval::from_f64)), &sides);
        let found = added(centre.clone().map(Interval::point), around);
        let [phase, speed] = &found;
        let hull = [phase.intersection(&hull[0])?, speed.intersection(&hull[1])?];
        let is_bounded = hull.iter().all(Interval::is_finite);
        is_bounded.then_some(Self {
            centre,
            axes,
            sides,
            hull,
        })
    }
}

fn added<E: Endpoint>([a, b]: [Interval<E>; 2], [c, d]: [Interval<E>; 2]) -> [Interval<E>; 2] {
    [a + c, b + d]
}

/// How far the numbers of a box are from a point.
fn apart<E: Endpoint>(hull: &[Interval<E>; 2], centre: &[E; 2]) -> [Interval<E>; 2] {
    [0, 1].map(|index| hull[index].clone() - Interval::point(centre[index].clone()))
}

fn applied<E: Endpoint>(matrix: &Matrix<E>, vector: &[Interval<E>; 2]) -> [Interval<E>; 2] {
    matrix
        .each_ref()
        .map(|[a, b]| a.clone() * vector[0].clone() + b.clone() * vector[1].clone())
}

fn product<E: Endpoint>(left: &Matrix<E>, right: &Matrix<E>) -> Matrix<E> {
    left.each_ref()
        .map(|[a, b]| [0, 1].map(|column| a.clone() * right[0][column].clone() + b.clone() * right[1][column].clone()))
}
