//! How a line is broken, so that lines are told apart without colour.

/// The pattern of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Dash {
    Solid,
    Dashed,
    Dotted,
    DashDot,
}

impl Dash {
    /// Drawn and left out in turn, in tenths of a pixel.
    const fn pattern(self) -> &'static [f64] {
        match self {
            Self::Solid => &[],
            Self::Dashed => &[65.0, 40.0],
            Self::Dotted => &[14.0, 32.0],
            Self::DashDot => &[75.0, 30.0, 14.0, 30.0],
        }
    }

    /// The pieces of a line on the grid that are drawn.
    pub(super) fn pieces(self, line: &[(i32, i32)]) -> Vec<Vec<(i32, i32)>> {
        let pattern = self.pattern();
        if pattern.is_empty() {
            return vec![line.to_vec()];
        }
        let mut pieces: Vec<Vec<(i32, i32)>> = Vec::new();
        let mut piece: Vec<(i32, i32)> = line.first().copied().into_iter().collect();
        let (mut at, mut left) = (0, pattern[0]);
        for ends in line.windows(2) {
            let [(x, y), (to_x, to_y)] = [ends[0], ends[1]].map(|(x, y)| (f64::from(x), f64::from(y)));
            let length = (to_x - x).hypot(to_y - y);
            let mut done = 0.0;
            while length - done > left {
                done += left;
                let part = done / length;
                let cut = (
                    (x + part * (to_x - x)).round() as i32,
                    (y + part * (to_y - y)).round() as i32,
                );
                if at % 2 == 0 {
                    piece.push(cut);
                    pieces.push(std::mem::take(&mut piece));
                } else {
                    piece = vec![cut];
                }
                at = (at + 1) % pattern.len();
                left = pattern[at];
            }
            left -= length - done;
            if at % 2 == 0 {
                piece.push(ends[1]);
            }
        }
        pieces.push(piece);
        pieces.retain(|piece| piece.len() > 1);
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dashed_line_is_drawn_and_left_out_in_turn_around_corners_too() {
        let pieces = Dash::Dashed.pieces(&[(0, 0), (100, 0), (100, 100)]);
        assert_eq!(pieces[0], [(0, 0), (65, 0)]);
        assert_eq!(pieces[1], [(100, 5), (100, 70)]);
        assert_eq!(pieces.len(), 2);
        let corner = Dash::Dashed.pieces(&[(0, 0), (40, 0), (40, 40)]);
        assert_eq!(corner, [vec![(0, 0), (40, 0), (40, 25)]]);
    }

    #[test]
    fn many_short_pieces_make_the_same_dashes_as_a_long_one() {
        let fine: Vec<(i32, i32)> = (0..=300).map(|x| (x, 0)).collect();
        for dash in [Dash::Dashed, Dash::Dotted, Dash::DashDot] {
            let ends = |pieces: Vec<Vec<(i32, i32)>>| -> Vec<[(i32, i32); 2]> {
                pieces.iter().map(|piece| [piece[0], piece[piece.len() - 1]]).collect()
            };
            assert_eq!(ends(dash.pieces(&fine)), ends(dash.pieces(&[(0, 0), (300, 0)])));
        }
    }

    #[test]
    fn what_is_no_line_has_no_pieces() {
        assert!(Dash::Dashed.pieces(&[]).is_empty() && Dash::Dotted.pieces(&[(1, 1)]).is_empty());
        assert!(
            Dash::Dashed
                .pieces(&[(1, 1), (1, 1)])
                .iter()
                .all(|piece| piece.len() == 2)
        );
    }
}
