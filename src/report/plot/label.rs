//! Where the labels of marks stand so that none hides another.

/// Labels on one line are so far apart at least.
const BETWEEN: i32 = 80;

/// A box on the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub left: i32,
    pub top: i32,
    pub width: i32,
    pub height: i32,
}

impl Rect {
    /// A square around a point.
    pub fn around((x, y): (i32, i32), side: i32) -> Self {
        Self {
            left: x - side / 2,
            top: y - side / 2,
            width: side,
            height: side,
        }
    }

    /// The point of it nearest to another.
    pub fn nearest(&self, (x, y): (i32, i32)) -> (i32, i32) {
        (
            x.clamp(self.left, self.left + self.width),
            y.clamp(self.top, self.top + self.height),
        )
    }

    /// The area that two have in common.
    fn overlap(&self, other: &Self) -> i64 {
        let common = |low: i32, length: i32, other_low: i32, other_length: i32| {
            i64::from((low + length).min(other_low + other_length) - low.max(other_low)).max(0)
        };
        common(self.left, self.width, other.left, other.width) * common(self.top, self.height, other.top, other.height)
    }

    fn area(&self) -> i64 {
        i64::from(self.width) * i64::from(self.height)
    }
}

/// The free room of a panel.
#[derive(Debug)]
pub(super) struct Room {
    frame: Rect,
    taken: Vec<Rect>,
    /// From a mark to its label.
    apart: i32,
}

impl Room {
    /// All of a frame but what is taken.
    pub fn new(frame: Rect) -> Self {
        Self {
            frame,
            taken: Vec::new(),
            apart: 0,
        }
    }

    /// The line that leads from a mark to a label that is far from it.
    pub fn leader(&self, label: &Rect, (x, y): (i32, i32)) -> Option<[(i32, i32); 2]> {
        let (to_x, to_y) = label.nearest((x, y));
        let (right, down) = (f64::from(to_x - x), f64::from(to_y - y));
        let part = f64::from(self.apart) / right.hypot(down);
        // not over the mark itself
        let start = || (x + (part * right) as i32, y + (part * down) as i32);
        (part < 0.6).then(|| [start(), (to_x, to_y)])
    }

    /// Labels stand at least so far from their marks.
    pub fn keep_apart(&mut self, apart: i32) {
        self.apart = self.apart.max(apart);
    }

    /// Nothing else may stand here.
    pub fn take(&mut self, rect: Rect) {
        self.taken.push(rect);
    }

    /// The place for a label so wide and high beside a mark: of twelve around it the first that hides nothing, else
    /// the one that hides least. It is taken then.
    pub fn place(&mut self, (x, y): (i32, i32), (width, height): (i32, i32)) -> Rect {
        let apart = self.apart;
        let rect = |left: i32, top: i32| Rect {
            left,
            top,
            width,
            height,
        };
        let (right, left) = (x + apart, x - apart - width);
        let (above, below) = (y - apart - height, y + apart);
        let (middle_x, middle_y) = (x - width / 2, y - height / 2);
        let farther = 2 * apart + height;
        let candidates = [
            rect(right, above),
            rect(left, above),
            rect(right, below),
            rect(left, below),
            rect(right, middle_y),
            rect(left, middle_y),
            rect(middle_x, above),
            rect(middle_x, below),
            rect(right, above - farther),
            rect(left, above - farther),
            rect(right, below + farther),
            rect(left, below + farther),
        ];
        let hidden = |candidate: &Rect| {
            let outside = candidate.area() - candidate.overlap(&self.frame);
            // what stands around the mark itself is kept apart from
            let others = self.taken.iter().filter(|taken| taken.nearest((x, y)) != (x, y));
            outside * 4 + others.map(|taken| taken.overlap(candidate)).sum::<i64>()
        };
        let mut best = candidates[0];
        for candidate in candidates {
            if hidden(&candidate) < hidden(&best) {
                best = candidate;
            }
        }
        self.taken.push(Rect {
            left: best.left - BETWEEN,
            width: best.width + 2 * BETWEEN,
            ..best
        });
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_marks_close_together_do_not_overlap_and_stay_in_the_frame() {
        let frame = Rect {
            left: 0,
            top: 0,
            width: 2000,
            height: 1000,
        };
        let mut room = Room::new(frame);
        room.keep_apart(50);
        let places: Vec<Rect> = [(1950, 20), (1900, 60), (1980, 900), (1000, 500), (1010, 510)]
            .into_iter()
            .map(|at| room.place(at, (300, 110)))
            .collect();
        for (index, place) in places.iter().enumerate() {
            assert_eq!(place.overlap(&frame), place.area(), "{place:?}");
            assert!(
                places[..index].iter().all(|other| other.overlap(place) == 0),
                "{place:?}"
            );
        }
    }
}
