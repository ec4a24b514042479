//! What of a line lies in the frame.

use super::series::Point;
use super::span::Span;

/// The pieces of a line in the frame of two spans. What is not finite breaks the line; a piece has two points or more.
pub(super) fn pieces(line: &[Point], x: &Span, y: &Span) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut piece: Vec<Point> = Vec::new();
    for ends in line.windows(2) {
        let Some((from, to)) = inside(ends[0], ends[1], x, y) else {
            pieces.push(std::mem::take(&mut piece));
            continue;
        };
        if piece.last() != Some(&from) {
            pieces.push(std::mem::take(&mut piece));
            piece.push(from);
        }
        piece.push(to);
    }
    pieces.push(piece);
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

/// The part of a segment in the frame, by the method of Liang and Barsky.
fn inside(one: Point, other: Point, x: &Span, y: &Span) -> Option<(Point, Point)> {
    if ![one.0, one.1, other.0, other.1].iter().all(|number| number.is_finite()) {
        return None;
    }
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (start, end, span) in [(one.0, other.0, x), (one.1, other.1, y)] {
        let step = end - start;
        if step == 0.0 {
            if !span.contains(start) {
                return None;
            }
            continue;
        }
        let (near, far) = ((span.low() - start) / step, (span.high() - start) / step);
        from = from.max(near.min(far));
        to = to.min(near.max(far));
    }
    if from > to {
        return None;
    }
    let at = |part: f64| {
        (
            (one.0 + part * (other.0 - one.0)).clamp(x.low(), x.high()),
            (one.1 + part * (other.1 - one.1)).clamp(y.low(), y.high()),
        )
    };
    let start = if from == 0.0 { one } else { at(from) };
    let end = if to == 1.0 { other } else { at(to) };
    Some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(line: &[Point]) -> Vec<Vec<Point>> {
        pieces(line, &Span::new(0.0, 1.0), &Span::new(0.0, 1.0))
    }

    #[test]
    fn a_line_that_leaves_and_comes_back_is_two() {
        let found = cut(&[(0.0, 0.5), (0.5, 0.5), (0.5, 2.0), (0.75, 0.0)]);
        assert_eq!(found.len(), 2);
        assert_eq!(found[0], [(0.0, 0.5), (0.5, 0.5), (0.5, 1.0)]);
        assert_eq!(found[1][0].1, 1.0);
        assert_eq!(found[1][1], (0.75, 0.0));
    }

    #[test]
    fn what_is_not_finite_breaks_a_line() {
        let found = cut(&[
            (0.0, 0.0),
            (0.1, 0.1),
            (f64::NAN, 0.1),
            (0.2, 0.2),
            (0.3, 0.3),
            (0.4, f64::INFINITY),
        ]);
        assert_eq!(found, [vec![(0.0, 0.0), (0.1, 0.1)], vec![(0.2, 0.2), (0.3, 0.3)]]);
        assert!(cut(&[]).is_empty() && cut(&[(0.5, 0.5)]).is_empty());
    }

    #[test]
    fn what_passes_by_is_left_out() {
        assert!(cut(&[(-1.0, 0.5), (0.5, 3.0)]).is_empty());
        assert!(cut(&[(2.0, 0.0), (2.0, 1.0)]).is_empty());
        assert_eq!(cut(&[(-1.0, 0.5), (2.0, 0.5)]), [vec![(0.0, 0.5), (1.0, 0.5)]]);
    }
}
