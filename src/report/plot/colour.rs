//! Colours that every eye tells apart.

use plotters::style::RGBColor;

/// The palette of Okabe and Ito, black, white, and three greys that are told apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Colour {
    Black,
    /// That of the paper, around what stands over other colours.
    White,
    /// For places without a value.
    LightGrey,
    /// For the background.
    Grey,
    DarkGrey,
    Orange,
    Sky,
    Green,
    Yellow,
    Blue,
    Vermillion,
    Purple,
    /// A place on a scale from dark to light, which orders for every eye: from 0 to 255.
    Level(u8),
}

/// Sixteen steps of the map viridis (S. van der Walt and N. Smith, 2015), between which colours are interpolated.
const SCALE: [(u8, u8, u8); 17] = [
    (68, 1, 84),
    (72, 24, 106),
    (71, 45, 123),
    (66, 64, 134),
    (59, 82, 139),
    (51, 99, 141),
    (44, 114, 142),
    (38, 130, 142),
    (33, 145, 140),
    (31, 160, 136),
    (40, 174, 128),
    (63, 188, 115),
    (94, 201, 98),
    (132, 212, 75),
    (173, 220, 48),
    (216, 226, 25),
    (253, 231, 37),
];

impl Colour {
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
            Self::LightGrey => (222, 222, 222),
            Self::Grey => (150, 150, 150),
            Self::DarkGrey => (75, 75, 75),
            Self::Orange => (230, 159, 0),
            Self::Sky => (86, 180, 233),
            Self::Green => (0, 158, 115),
            Self::Yellow => (240, 228, 66),
            Self::Blue => (0, 114, 178),
            Self::Vermillion => (213, 94, 0),
            Self::Purple => (204, 121, 167),
            Self::Level(place) => {
                let (step, part) = (place as usize / 16, place % 16);
                let (one, other) = (SCALE[step], SCALE[step + 1]);
                (
                    between(one.0, other.0, part),
                    between(one.1, other.1, part),
                    between(one.2, other.2, part),
                )
            }
        }
    }

    /// Place number `index` of `count` on the scale.
    pub fn level(index: usize, count: usize) -> Self {
        Self::Level((255 * index / count.saturating_sub(1).max(1)).min(255) as u8)
    }

    pub(super) fn pen(self) -> RGBColor {
        let (red, green, blue) = self.rgb();
        RGBColor(red, green, blue)
    }
}

/// So many sixteenths of the way from one to the other.
const fn between(one: u8, other: u8, part: u8) -> u8 {
    ((one as u16 * (16 - part as u16) + other as u16 * part as u16 + 8) / 16) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_goes_from_dark_to_light_and_greys_differ() {
        let light = |colour: Colour| {
            let (red, green, blue) = colour.rgb();
            f64::from(red) * 0.299 + f64::from(green) * 0.587 + f64::from(blue) * 0.114
        };
        assert!((0..255).all(|place| light(Colour::Level(place)) <= light(Colour::Level(place + 1)) + 1.0));
        assert_eq!(Colour::level(11, 12), Colour::Level(255));
        let greys = [
            Colour::Black,
            Colour::DarkGrey,
            Colour::Grey,
            Colour::LightGrey,
            Colour::White,
        ];
        assert!(greys.windows(2).all(|pair| light(pair[1]) - light(pair[0]) > 30.0));
    }
}
