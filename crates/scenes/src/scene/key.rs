//! The keys a scene may have: one table of names, ranges and meanings.

use super::{MapWant, Over, Quantity, Want};
use std::cmp::Ordering;
use texmath::nearest;

/// A key of a scene.
#[derive(Debug, PartialEq)]
pub(super) struct Key {
    /// Its section; empty for the keys above the sections.
    pub section: &'static str,
    pub name: &'static str,
    pub allowed: Allowed,
    /// The meaning in words.
    pub meaning: &'static str,
    /// Its unit; empty for what has none.
    pub unit: &'static str,
    /// A value, as TOML has it.
    pub example: &'static str,
}

/// What a key may hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Allowed {
    Text,
    /// One of these texts; the first where the key is not given.
    OneOf(&'static [&'static str]),
    /// The name of a parameter that may vary.
    Parameter,
    /// A list of names, or one of them.
    Names,
    /// Any finite number.
    Finite,
    NotNegative,
    Positive,
    /// Above 0 and at most 1.
    Part,
    /// From 0 to 1.
    Restitution,
    /// From -pi/2 to pi/2.
    Angle,
    /// An integer from 1 to this.
    Count(u32),
    /// A list of finite numbers.
    Numbers,
    /// A list of starts.
    Starts,
    /// Two numbers that the parameter of the same name may have, the lower one first.
    Range,
}

/// The most digits that can be asked for: beyond, a slip of the keyboard is likelier than a need.
pub const MOST_DIGITS: u32 = 10_000;

/// Beyond, nobody waits for the answer.
const MOST_PERIODS: u32 = 1000;
const MOST_POINTS: u32 = 1_000_000;
const MOST_LINES: u32 = 1000;
const IMPACTS_AT_MOST: u32 = 1_000_000_000;
const KEPT_AT_MOST: u32 = 1_000_000;
const MOST_CELLS_OF_A_COVER: u32 = 10_000_000;
const MOST_TIMES: u32 = 1000;
const MOST_SYMBOLS: u32 = 10_000;
/// The widest number has no more.
const MOST_RESTING_DIGITS: u32 = 200;

macro_rules! keys {
    ($($constant:ident = $section:literal $name:literal $allowed:expr, $meaning:literal, $unit:literal, $example:literal;)*) => {
        $(pub(super) static $constant: Key = Key {
            section: $section,
            name: $name,
            allowed: $allowed,
            meaning: $meaning,
            unit: $unit,
            example: $example,
        };)*
        /// Every key, in the order of DESIGN.
        pub(super) static KEYS: &[&Key] = &[$(&$constant),*];
    };
}

keys! {
    TITLE = "" "title" Allowed::Text, "what stands above tables and plots", "", r#""A device of mine""#;
    WANT = "" "want" Allowed::Names, "what is wanted", "", r#"["orbits", "sweep"]"#;
    WORDS = "" "words" Allowed::Names, "the impacts of one motion by wall", "", r#"["BT", "BTT"]"#;
    MAX_PERIODS = "" "max_periods" Allowed::Count(MOST_PERIODS), "the most forcing periods of a motion", "", "2";
    DIGITS = "" "digits" Allowed::Count(MOST_DIGITS), "the significant digits to reach", "", "30";
    CAPSULE_MASS = "device" "capsule_mass" Allowed::Positive, "the mass of the capsule", "kg", "0.1245";
    FORCING_AMPLITUDE = "device" "forcing_amplitude" Allowed::Positive, "the amplitude of the force", "N", "5.0";
    ANGULAR_FREQUENCY = "device" "angular_frequency" Allowed::Positive, "the angular frequency of the force", "rad/s", r#""5 pi""#;
    INCLINE = "device" "incline" Allowed::Angle, "the angle against the horizontal", "rad", r#""pi/6""#;
    GRAVITY = "device" "gravity" Allowed::NotNegative, "the acceleration of gravity", "m/s²", "9.8";
    CAPSULE_LENGTH = "device" "capsule_length" Allowed::Positive, "the distance that the ball has between the walls, which box.forcing_amplitude leaves as it is", "m", "0.5";
    G = "motion" "g" Allowed::Finite, "gravity along the capsule; [device] gives it too", "A/M", "0.122";
    D = "motion" "d" Allowed::Positive, "the gap between the walls: the length that the ball has", "A pi²/(M omega²)", "0.26";
    R_B = "motion" "r_b" Allowed::Restitution, "the restitution of the bottom; 0 is a plastic impact", "", "0.6";
    R_T = "motion" "r_t" Allowed::Restitution, "the restitution of the top; 0 is a plastic impact", "", "0.3";
    WALLS = "motion" "walls" Allowed::OneOf(&["both", "bottom"]), "which walls there are; bottom alone is a ball on a shaken table at Z = 0, without d and r_t", "", r#""bottom""#;
    COSINES = "forcing" "cosines" Allowed::Numbers, "the amplitudes of cos(n pi t), n = 1, 2, ...", "A/M", "[1, 0, 0.3]";
    SINES = "forcing" "sines" Allowed::Numbers, "the amplitudes of sin(n pi t), n = 1, 2, ...", "A/M", "[0, 0.2]";
    BALL_MASS = "membrane" "ball_mass" Allowed::Positive, "the mass of the ball", "kg", "0.0035";
    STIFFNESS = "membrane" "stiffness" Allowed::Positive, "K of the elastic force K delta^exponent", "N/m^exponent", "4.0847e5";
    EXPONENT = "membrane" "exponent" Allowed::Positive, "the exponent of the elastic force", "", "2.6";
    BALL_RADIUS = "membrane" "ball_radius" Allowed::Positive, "the radius of the ball", "m", "0.005";
    MEMBRANE_RADIUS = "membrane" "membrane_radius" Allowed::Positive, "the radius of the undeformed membrane", "m", "0.0063";
    INPUT_VOLTAGE = "membrane" "input_voltage" Allowed::Positive, "the input voltage", "V", "2000.0";
    PHASE = "start" "phase" Allowed::Finite, "the phase of the forcing at the start", "rad", "6.18";
    VELOCITY = "start" "velocity" Allowed::Finite, "the size of the velocity just before the first impact; with start.z the velocity in flight, Zdot", "A pi/(M omega)", "0.5293";
    SIDE = "start" "side" Allowed::OneOf(&["bottom", "top"]), "the wall of the first impact", "", r#""top""#;
    Z = "start" "z" Allowed::Finite, "where the ball starts in flight: between -d/2 at the top and d/2 at the bottom; of one wall below 0", "A pi²/(M omega²)", "0.05";
    OVER = "sweep" "over" Allowed::Parameter, "what is swept", "", r#""d""#;
    FROM = "sweep" "from" Allowed::Finite, "the first value", "", "0.1";
    TO = "sweep" "to" Allowed::Finite, "the last value", "", "0.5";
    POINTS = "sweep" "points" Allowed::Count(MOST_POINTS), "the number of values, both ends counted", "", "401";
    IMPACTS = "sweep" "impacts" Allowed::Count(IMPACTS_AT_MOST), "the impacts at each value", "", "500";
    KEEP = "sweep" "keep" Allowed::Count(KEPT_AT_MOST), "the last impacts at each value, which are kept", "", "60";
    BEGIN = "sweep" "start" Allowed::OneOf(&["each", "follow"]), "where each value starts from: \"each\" from [start], \"follow\" from the end of the value before", "", r#""each""#;
    ERROR = "sweep" "error" Allowed::Positive, "the relative standard error that mean voltages are to have", "", "0.01";
    MOST_IMPACTS = "sweep" "most_impacts" Allowed::Count(IMPACTS_AT_MOST), "the most impacts for sweep.error", "", "1000000";
    MAP_WANT = "map" "want" Allowed::Names, "what is wanted at each point", "", r#"["word", "voltage_rate"]"#;
    MAP_IMPACTS = "map" "impacts" Allowed::Count(IMPACTS_AT_MOST), "the impacts at each point", "", "500";
    MAP_KEEP = "map" "keep" Allowed::Count(KEPT_AT_MOST), "the last impacts at each point, among which a cycle is looked for", "", "60";
    MAP_BEGIN = "map" "start" Allowed::OneOf(&["each", "follow"]), "where each value of x starts from: \"each\" from [start], \"follow\" from the end of the value before", "", r#""follow""#;
    MAP_ERROR = "map" "error" Allowed::Positive, "the relative standard error that mean voltages are to have", "", "0.01";
    MAP_MOST_IMPACTS = "map" "most_impacts" Allowed::Count(IMPACTS_AT_MOST), "the most impacts for map.error", "", "1000000";
    MAP_STARTS = "map" "starts" Allowed::Starts, "the starts at each point, instead of [start]", "", "[{ phase = 6.18, velocity = 0.53 }]";
    X_OVER = "map.x" "over" Allowed::Parameter, "the parameter along x", "", r#""d""#;
    X_FROM = "map.x" "from" Allowed::Finite, "the first value along x", "", "0.1";
    X_TO = "map.x" "to" Allowed::Finite, "the last value along x", "", "0.5";
    X_POINTS = "map.x" "points" Allowed::Count(MOST_POINTS), "the number of values along x, both ends counted", "", "201";
    Y_OVER = "map.y" "over" Allowed::Parameter, "the parameter along y", "", r#""r_b""#;
    Y_FROM = "map.y" "from" Allowed::Finite, "the first value along y", "", "0.3";
    Y_TO = "map.y" "to" Allowed::Finite, "the last value along y", "", "0.9";
    Y_POINTS = "map.y" "points" Allowed::Count(MOST_POINTS), "the number of values along y, both ends counted", "", "121";
    LINES = "branch" "lines" Allowed::Count(MOST_LINES), "into how many parts lines on which curves are looked for divide each side", "", "8";
    CURVE_X_OVER = "branch.x" "over" Allowed::Parameter, "the first of two parameters", "", r#""d""#;
    CURVE_X_FROM = "branch.x" "from" Allowed::Finite, "one end of its range", "", "0.1";
    CURVE_X_TO = "branch.x" "to" Allowed::Finite, "the other end of its range", "", "0.6";
    CURVE_Y_OVER = "branch.y" "over" Allowed::Parameter, "the second of two parameters", "", r#""r_b""#;
    CURVE_Y_FROM = "branch.y" "from" Allowed::Finite, "one end of its range", "", "0.2";
    CURVE_Y_TO = "branch.y" "to" Allowed::Finite, "the other end of its range", "", "0.8";
    BASINS_IMPACTS = "basins" "impacts" Allowed::Count(IMPACTS_AT_MOST), "the impacts from each start", "", "1000";
    BASINS_KEEP = "basins" "keep" Allowed::Count(KEPT_AT_MOST), "the last impacts from each start, among which a cycle is looked for", "", "60";
    PHASES_FROM = "basins.phase" "from" Allowed::Finite, "the first phase of the forcing at the first impact", "rad", "0";
    PHASES_TO = "basins.phase" "to" Allowed::Finite, "the last phase of the forcing at the first impact", "rad", r#""2 pi""#;
    PHASES_POINTS = "basins.phase" "points" Allowed::Count(MOST_POINTS), "the number of phases, both ends counted", "", "41";
    VELOCITIES_FROM = "basins.velocity" "from" Allowed::NotNegative, "the first velocity just before the first impact", "A pi/(M omega)", "0";
    VELOCITIES_TO = "basins.velocity" "to" Allowed::NotNegative, "the last velocity just before the first impact", "A pi/(M omega)", "1.5";
    VELOCITIES_POINTS = "basins.velocity" "points" Allowed::Count(MOST_POINTS), "the number of velocities, both ends counted", "", "21";
    BOX_D = "box" "d" Allowed::Range, "the range of the gap", "A pi²/(M omega²)", "[0.1, 0.5]";
    BOX_R_B = "box" "r_b" Allowed::Range, "the range of the restitution of the bottom", "", "[0.3, 0.7]";
    BOX_R_T = "box" "r_t" Allowed::Range, "the range of the restitution of the top", "", "[0.3, 0.7]";
    BOX_INCLINE = "box" "incline" Allowed::Range, "the range of the angle against the horizontal", "rad", r#"[0, "pi/4"]"#;
    BOX_G = "box" "g" Allowed::Range, "the range of gravity along the capsule", "A/M", "[0, 0.2]";
    BOX_FORCING_AMPLITUDE = "box" "forcing_amplitude" Allowed::Range, "the range of the amplitude of the force", "N", "[4.0, 6.0]";
    BOX_MARGIN = "box" "margin" Allowed::NotNegative, "what 1 + Det - |Tr| is at least", "", "0.01";
    BOX_CLEARANCE = "box" "clearance" Allowed::NotNegative, "the least clearance", "A pi²/(M omega²)", "0.01";
    FINEST_CELL = "options" "finest_cell" Allowed::Part, "1-1 motions: the width of the finest cells in T_1 and psi", "", "1e-10";
    MOST_CELLS = "options" "most_cells" Allowed::Count(MOST_POINTS), "1-1 motions: the most cells at one value, for each forcing period", "", "500000";
    MOST_COVER_CELLS = "options" "most_cover_cells" Allowed::Count(MOST_CELLS_OF_A_COVER), "1-1 motions over a range: the most cells of their cover", "", "1000000";
    MOST_COVERS = "options" "most_covers" Allowed::Count(MOST_TIMES), "1-1 motions over a range: how often what is undecided is covered again", "", "20";
    WORD_STARTS = "options" "word_starts" Allowed::Count(MOST_POINTS), "other words: the starts at one value, for each impact and forcing period", "", "1000";
    BRANCH_VALUES = "options" "branch_values" Allowed::Count(MOST_TIMES), "other words over a range: the values at which motions are searched for", "", "33";
    BRANCH_STARTS = "options" "branch_starts" Allowed::Count(MOST_POINTS), "other words over a range: the starts at each, for each impact and forcing period", "", "500";
    LONGEST_STEP = "options" "longest_step" Allowed::Part, "continuation: the longest step, in radians and ranges of the parameter", "", "0.05";
    SHORTEST_STEP = "options" "shortest_step" Allowed::Part, "continuation: the step below which a branch is left", "", "1e-8";
    SWITCHES = "options" "switches" Allowed::Count(MOST_TIMES), "continuation: how often the branch that parts at a period doubling, or where a symmetry breaks, is followed in its turn", "", "2";
    MOST_STEPS = "options" "most_steps" Allowed::Count(MOST_POINTS), "continuation: the most steps in one direction", "", "10000";
    LONGEST_WORD = "options" "longest_word" Allowed::Count(MOST_SYMBOLS), "long runs: the most symbols of a word that is looked for", "", "200";
    SETTLED = "options" "settled" Allowed::Part, "long runs: how far impacts a cycle apart may differ, in phase (rad) and in velocity", "", "1e-8";
    SETTLING_IMPACTS = "options" "settling_impacts" Allowed::Count(IMPACTS_AT_MOST), "long runs: the most impacts for which a cycle is followed on", "", "100000";
    RESTING_DIGITS = "options" "resting_digits" Allowed::Count(MOST_RESTING_DIGITS), "long runs: the digits that may be spent on a cycle through a rest", "", "31";
}

/// The keys of evenly spaced numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpacedKeys {
    pub from: &'static Key,
    pub to: &'static Key,
    pub points: &'static Key,
}

impl SpacedKeys {
    pub const PHASE: Self = Self {
        from: &PHASES_FROM,
        to: &PHASES_TO,
        points: &PHASES_POINTS,
    };
    pub const VELOCITY: Self = Self {
        from: &VELOCITIES_FROM,
        to: &VELOCITIES_TO,
        points: &VELOCITIES_POINTS,
    };

    pub const fn all(self) -> [&'static Key; 3] {
        [self.from, self.to, self.points]
    }
}

/// The keys of a parameter and the ends of its range.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExtentKeys {
    pub over: &'static Key,
    pub from: &'static Key,
    pub to: &'static Key,
}

impl ExtentKeys {
    /// Those of `[branch]`.
    pub const X: Self = Self {
        over: &CURVE_X_OVER,
        from: &CURVE_X_FROM,
        to: &CURVE_X_TO,
    };
    pub const Y: Self = Self {
        over: &CURVE_Y_OVER,
        from: &CURVE_Y_FROM,
        to: &CURVE_Y_TO,
    };

    pub const fn all(self) -> [&'static Key; 3] {
        [self.over, self.from, self.to]
    }
}

/// The keys of a range of values of one parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct RangeKeys {
    pub over: &'static Key,
    pub values: SpacedKeys,
}

impl RangeKeys {
    pub const SWEEP: Self = Self {
        over: &OVER,
        values: SpacedKeys {
            from: &FROM,
            to: &TO,
            points: &POINTS,
        },
    };
    pub const X: Self = Self {
        over: &X_OVER,
        values: SpacedKeys {
            from: &X_FROM,
            to: &X_TO,
            points: &X_POINTS,
        },
    };
    pub const Y: Self = Self {
        over: &Y_OVER,
        values: SpacedKeys {
            from: &Y_FROM,
            to: &Y_TO,
            points: &Y_POINTS,
        },
    };

    pub fn all(self) -> impl Iterator<Item = &'static Key> {
        std::iter::once(self.over).chain(self.values.all())
    }

    pub const fn extent(self) -> ExtentKeys {
        let SpacedKeys { from, to, .. } = self.values;
        ExtentKeys {
            over: self.over,
            from,
            to,
        }
    }
}

/// The keys of how motions are followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct DiagramKeys {
    pub impacts: &'static Key,
    pub keep: &'static Key,
    pub begin: &'static Key,
    pub error: &'static Key,
    pub most_impacts: &'static Key,
}

impl DiagramKeys {
    pub const SWEEP: Self = Self {
        impacts: &IMPACTS,
        keep: &KEEP,
        begin: &BEGIN,
        error: &ERROR,
        most_impacts: &MOST_IMPACTS,
    };
    pub const MAP: Self = Self {
        impacts: &MAP_IMPACTS,
        keep: &MAP_KEEP,
        begin: &MAP_BEGIN,
        error: &MAP_ERROR,
        most_impacts: &MAP_MOST_IMPACTS,
    };
}

/// The sections, in the order of DESIGN.
pub(super) const SECTIONS: [&str; 17] = [
    "device",
    "motion",
    "forcing",
    "membrane",
    "start",
    "sweep",
    "map",
    "map.x",
    "map.y",
    "branch",
    "branch.x",
    "branch.y",
    "basins",
    "basins.phase",
    "basins.velocity",
    "box",
    "options",
];

impl Key {
    /// The name with its section: `motion.d`.
    pub fn path(&self) -> String {
        match self.section {
            "" => self.name.to_string(),
            section => format!("{section}.{}", self.name),
        }
    }

    /// Returns the meaning with the unit.
    pub fn described(&self) -> String {
        match self.unit {
            "" => self.meaning.to_owned(),
            unit => format!("{}, {unit}", self.meaning),
        }
    }

    /// Returns the meaning with the unit or the texts that are allowed.
    pub fn asked(&self) -> String {
        match self.allowed {
            Allowed::Names | Allowed::OneOf(_) | Allowed::Parameter => format!("{}: {}", self.meaning, self.range()),
            _ => self.described(),
        }
    }

    /// Returns the allowed values in words.
    pub fn range(&self) -> String {
        match (self.allowed, self.section, self.name) {
            (Allowed::Names, "", "want") => format!("some of {}", Want::ALL.map(Want::name).join(", ")),
            (Allowed::Names, "map", "want") => format!("some of {}", MapWant::ALL.map(MapWant::name).join(", ")),
            (Allowed::Names, ..) => "words of B and T, one or a list".to_owned(),
            (allowed, ..) => allowed.in_words(),
        }
    }

    /// The key of this name in a section.
    pub fn find(section: &str, name: &str) -> Option<&'static Self> {
        KEYS.iter()
            .copied()
            .find(|key| key.section == section && key.name == name)
    }
}

/// Returns true if some section has a key of this name.
pub fn has_key(name: &str) -> bool {
    KEYS.iter().any(|key| key.name == name)
}

/// The first key of this name with its section, as `motion.d`; the name itself where there is none.
pub fn path_of_key(name: &str) -> String {
    let key = KEYS.iter().find(|key| key.name == name);
    key.map_or(name.to_owned(), |key| key.path())
}

/// What to write instead of a key that does not exist: the nearest name, the same name elsewhere, and all there are.
pub(super) fn instead_of_key(section: &str, name: &str) -> String {
    let here: Vec<&str> = KEYS
        .iter()
        .filter(|key| key.section == section)
        .map(|key| key.name)
        .collect();
    let elsewhere = || {
        let same = KEYS.iter().find(|key| key.name == name);
        same.or_else(|| {
            KEYS.iter()
                .find(|key| name.len() > 2 && key.name.ends_with(&format!("_{name}")))
        })
    };
    let begun: Vec<&str> = here
        .iter()
        .copied()
        .filter(|known| known.strip_prefix(name).is_some_and(|rest| rest.starts_with('_')))
        .collect();
    let meant = match nearest(name, here.iter().copied()) {
        // r for r_b or r_t
        _ if !begun.is_empty() => Some(begun.join(" or ")),
        Some(near) if name.chars().count() > 1 => Some(near.to_string()),
        _ => elsewhere().map(|key| key.path()),
    };
    let place = match section {
        "" => "above the sections".to_string(),
        section => format!("in [{section}]"),
    };
    let sections = if section.is_empty() {
        format!("; the sections are {}", SECTIONS.join(", "))
    } else {
        String::new()
    };
    format!(
        "{}there are, {place}: {}{sections}",
        did_you_mean(meant.as_deref()),
        here.join(", ")
    )
}

/// What to write instead of a section that does not exist.
pub(super) fn instead_of_section(name: &str) -> String {
    let meant = nearest(name, SECTIONS);
    format!("{}there are: {}", did_you_mean(meant), SECTIONS.join(", "))
}

/// `did you mean X? `, where there is one.
pub(super) fn did_you_mean(meant: Option<&str>) -> String {
    meant.map(|meant| format!("did you mean {meant}? ")).unwrap_or_default()
}

impl Allowed {
    /// Returns the allowed values in words.
    pub fn in_words(self) -> String {
        match self {
            Self::Text => "text between quotes".to_owned(),
            Self::OneOf(known) => format!("one of {}", known.join(", ")),
            Self::Parameter => format!("one of {}", Over::ALL.map(Over::name).join(", ")),
            Self::Names => "a list of texts, as in [\"\u{2026}\", \"\u{2026}\"]".to_owned(),
            Self::Finite => "any number".to_owned(),
            Self::NotNegative => "0 or more".to_owned(),
            Self::Positive => "above 0".to_owned(),
            Self::Part => "above 0 and at most 1".to_owned(),
            Self::Restitution => "from 0 to 1".to_owned(),
            Self::Angle => "an angle in rad from -pi/2 to pi/2; 20 degrees are \"20 pi/180\"".to_owned(),
            Self::Count(most) => format!("an integer from 1 to {most}"),
            Self::Numbers => "a list of numbers, as in [1.0, 0.0, 0.3]".to_owned(),
            Self::Starts => "a list of starts".to_owned(),
            Self::Range => "a list of two numbers, the lower one first, as in [0.1, 0.5]".to_owned(),
        }
    }

    /// Returns what is allowed, in words, where the number is not.
    pub fn instead_of(self, value: &Quantity) -> Option<String> {
        let sign = value.sign();
        let is_at_most_one = || value.compared_with_one() != Ordering::Greater;
        let is_right = match self {
            Self::Positive => sign == Ordering::Greater,
            Self::NotNegative => sign != Ordering::Less,
            Self::Part => sign == Ordering::Greater && is_at_most_one(),
            Self::Restitution => sign != Ordering::Less && is_at_most_one(),
            Self::Angle => value.value::<f64>().abs() <= std::f64::consts::FRAC_PI_2 * (1.0 + f64::EPSILON),
            _ => true,
        };
        (!is_right).then(|| self.in_words())
    }
}

/// `one of a, b`, with the nearest first where one is near.
pub(super) fn one_of(found: &str, known: &[&str]) -> String {
    let meant = nearest(found, known.iter().copied());
    let hint = did_you_mean(meant);
    let list = known.join(", ");
    match hint.trim_end() {
        "" => format!("one of {list}"),
        hint => format!("one of {list} ({hint})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_found_in_its_own_section_only() {
        for &key in KEYS {
            assert_eq!(Key::find(key.section, key.name), Some(key));
            assert!(key.section.is_empty() || SECTIONS.contains(&key.section));
            assert!(!key.meaning.is_empty() && !key.example.is_empty());
        }
        assert!(Key::find("device", "d").is_none() && Key::find("", "").is_none());
    }

    #[test]
    fn a_key_in_the_wrong_section_is_sent_to_the_right_one() {
        assert!(instead_of_key("device", "ball_mass").starts_with("did you mean membrane.ball_mass? "));
        assert!(instead_of_key("motion", "dd").starts_with("did you mean d? "));
        assert!(instead_of_section("motoin").starts_with("did you mean motion? "));
    }
}
