//! Colours that every eye tells apart.

use plotters::style::RGBColor;

/// The palette of Okabe and Ito, black, white, and a grey for what stays in the background.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Colour {
    Black,
    /// That of the paper, around what stands over other colours.
    White,
    Grey,
    Orange,
    Sky,
    Green,
    Yellow,
    Blue,
    Vermillion,
    Purple,
    /// A step of a scale from dark to light, which orders for every eye: from 0 to [`Colour::LEVELS`] - 1.
    Level(u8),
}

/// Eight steps of the map viridis (S. van der Walt and N. Smith, 2015).
const SCALE: [(u8, u8, u8); 8] = [
    (68, 1, 84),
    (70, 51, 127),
    (54, 92, 141),
    (39, 127, 142),
    (31, 161, 135),
    (74, 194, 109),
    (159, 218, 58),
    (253, 231, 37),
];

impl Colour {
    /// How many steps the scale has.
    pub const LEVELS: u8 = SCALE.len() as u8;

    /// Those that differ to every eye, darkest first: lines of one panel take them in this order.
    pub const LINES: [Self; 7] = [
        Self::Black,
        Self::Blue,
        Self::Vermillion,
        Self::Green,
        Self::Purple,
        Self::Orange,
        Self::Sky,
    ];

    /// Red, green and blue.
    pub const fn rgb(self) -> (u8, u8, u8) {
        match self {
            Self::Black => (0, 0, 0),
            Self::White => (255, 255, 255),
            Self::Grey => (150, 150, 150),
            Self::Orange => (230, 159, 0),
            Self::Sky => (86, 180, 233),
            Self::Green => (0, 158, 115),
            Self::Yellow => (240, 228, 66),
            Self::Blue => (0, 114, 178),
            Self::Vermillion => (213, 94, 0),
            Self::Purple => (204, 121, 167),
            Self::Level(step) => {
                SCALE[if step < Self::LEVELS {
                    step as usize
                } else {
                    SCALE.len() - 1
                }]
            }
        }
    }

    pub(super) fn pen(self) -> RGBColor {
        let (red, green, blue) = self.rgb();
        RGBColor(red, green, blue)
    }
}
