//! The keys a scene may have: one table of names, ranges and meanings.

use super::Quantity;
use std::cmp::Ordering;
use texmath::nearest;

/// A key of a scene.
#[derive(Debug, PartialEq)]
pub(super) struct Key {
    /// Its section; empty for the keys above the sections.
    pub section: &'static str,
    pub name: &'static str,
    pub allowed: Allowed,
    /// What it is, with its unit.
    pub meaning: &'static str,
}

/// What a key may hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Allowed {
    Text,
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
    ($($constant:ident = $section:literal $name:literal $allowed:expr, $meaning:literal;)*) => {
        $(pub(super) static $constant: Key = Key {
            section: $section,
            name: $name,
            allowed: $allowed,
            meaning: $meaning,
        };)*
        /// Every key, in the order of DESIGN.
        pub(super) static KEYS: &[&Key] = &[$(&$constant),*];
    };
}

keys! {
    TITLE = "" "title" Allowed::Text, "what stands above tables and plots";
    WANT = "" "want" Allowed::Names, "what is wanted: some of orbits, branch, impacts, sweep, trajectory, voltage, map, basins, optimum";
    WORDS = "" "words" Allowed::Names, "the impacts of one motion by wall";
    MAX_PERIODS = "" "max_periods" Allowed::Count(MOST_PERIODS), "the most forcing periods of a motion";
    DIGITS = "" "digits" Allowed::Count(MOST_DIGITS), "the significant digits to reach";
    CAPSULE_MASS = "device" "capsule_mass" Allowed::Positive, "the mass of the capsule, kg";
    FORCING_AMPLITUDE = "device" "forcing_amplitude" Allowed::Positive, "the amplitude of the force, N";
    ANGULAR_FREQUENCY = "device" "angular_frequency" Allowed::Positive, "the angular frequency of the force, rad/s";
    INCLINE = "device" "incline" Allowed::Angle, "the angle against the horizontal, rad";
    GRAVITY = "device" "gravity" Allowed::NotNegative, "the acceleration of gravity, m/s²";
    CAPSULE_LENGTH = "device" "capsule_length" Allowed::Positive, "the distance that the ball has between the walls, m, which box.forcing_amplitude leaves as it is";
    G = "motion" "g" Allowed::Finite, "gravity along the capsule in units of the forcing; [device] gives it too";
    D = "motion" "d" Allowed::Positive, "the gap between the walls: the length that the ball has, m, over A pi²/(M omega²)";
    R_B = "motion" "r_b" Allowed::Restitution, "the restitution of the bottom; 0 is a plastic impact";
    R_T = "motion" "r_t" Allowed::Restitution, "the restitution of the top; 0 is a plastic impact";
    WALLS = "motion" "walls" Allowed::Text, "which walls there are: both, or bottom, a ball on a shaken table at Z = 0, without d and r_t";
    COSINES = "forcing" "cosines" Allowed::Numbers, "the amplitudes of cos(n pi t), n = 1, 2, ..., in units of the forcing";
    SINES = "forcing" "sines" Allowed::Numbers, "the amplitudes of sin(n pi t), n = 1, 2, ..., in units of the forcing";
    BALL_MASS = "membrane" "ball_mass" Allowed::Positive, "the mass of the ball, kg";
    STIFFNESS = "membrane" "stiffness" Allowed::Positive, "K of the elastic force K delta^exponent, N/m^exponent";
    EXPONENT = "membrane" "exponent" Allowed::Positive, "the exponent of the elastic force";
    BALL_RADIUS = "membrane" "ball_radius" Allowed::Positive, "the radius of the ball, m";
    MEMBRANE_RADIUS = "membrane" "membrane_radius" Allowed::Positive, "the radius of the undeformed membrane, m";
    INPUT_VOLTAGE = "membrane" "input_voltage" Allowed::Positive, "the input voltage, V";
    PHASE = "start" "phase" Allowed::Finite, "the phase of the forcing at the start, rad";
    VELOCITY = "start" "velocity" Allowed::Finite, "the velocity, without unit: its size just before the first impact, or with start.z Zdot in flight";
    SIDE = "start" "side" Allowed::Text, "the wall of the first impact: bottom or top";
    Z = "start" "z" Allowed::Finite, "where the ball starts in flight, without unit: between -d/2 at the top and d/2 at the bottom; of one wall below 0";
    OVER = "sweep" "over" Allowed::Text, "what is swept";
    FROM = "sweep" "from" Allowed::Finite, "the first value";
    TO = "sweep" "to" Allowed::Finite, "the last value";
    POINTS = "sweep" "points" Allowed::Count(MOST_POINTS), "the number of values, both ends counted";
    IMPACTS = "sweep" "impacts" Allowed::Count(IMPACTS_AT_MOST), "the impacts at each value";
    KEEP = "sweep" "keep" Allowed::Count(KEPT_AT_MOST), "the last impacts at each value, which are kept";
    BEGIN = "sweep" "start" Allowed::Text, "where each value starts from: \"each\" from [start], \"follow\" from the end of the value before";
    ERROR = "sweep" "error" Allowed::Positive, "the relative standard error that mean voltages are to have";
    MOST_IMPACTS = "sweep" "most_impacts" Allowed::Count(IMPACTS_AT_MOST), "the most impacts for sweep.error";
    MAP_WANT = "map" "want" Allowed::Names, "what is wanted at each point: some of word, mean_voltage, voltage_rate, lyapunov";
    MAP_IMPACTS = "map" "impacts" Allowed::Count(IMPACTS_AT_MOST), "the impacts at each point";
    MAP_KEEP = "map" "keep" Allowed::Count(KEPT_AT_MOST), "the last impacts at each point, among which a cycle is looked for";
    MAP_BEGIN = "map" "start" Allowed::Text, "where each value of x starts from: \"each\" from [start], \"follow\" from the end of the value before";
    MAP_ERROR = "map" "error" Allowed::Positive, "the relative standard error that mean voltages are to have";
    MAP_MOST_IMPACTS = "map" "most_impacts" Allowed::Count(IMPACTS_AT_MOST), "the most impacts for map.error";
    MAP_STARTS = "map" "starts" Allowed::Starts, "the starts at each point, instead of [start]";
    X_OVER = "map.x" "over" Allowed::Text, "the parameter along x";
    X_FROM = "map.x" "from" Allowed::Finite, "the first value along x";
    X_TO = "map.x" "to" Allowed::Finite, "the last value along x";
    X_POINTS = "map.x" "points" Allowed::Count(MOST_POINTS), "the number of values along x, both ends counted";
    Y_OVER = "map.y" "over" Allowed::Text, "the parameter along y";
    Y_FROM = "map.y" "from" Allowed::Finite, "the first value along y";
    Y_TO = "map.y" "to" Allowed::Finite, "the last value along y";
    Y_POINTS = "map.y" "points" Allowed::Count(MOST_POINTS), "the number of values along y, both ends counted";
    LINES = "branch" "lines" Allowed::Count(MOST_LINES), "into how many parts lines on which curves are looked for divide each side";
    CURVE_X_OVER = "branch.x" "over" Allowed::Text, "the first of two parameters";
    CURVE_X_FROM = "branch.x" "from" Allowed::Finite, "one end of its range";
    CURVE_X_TO = "branch.x" "to" Allowed::Finite, "the other end of its range";
    CURVE_Y_OVER = "branch.y" "over" Allowed::Text, "the second of two parameters";
    CURVE_Y_FROM = "branch.y" "from" Allowed::Finite, "one end of its range";
    CURVE_Y_TO = "branch.y" "to" Allowed::Finite, "the other end of its range";
    BASINS_IMPACTS = "basins" "impacts" Allowed::Count(IMPACTS_AT_MOST), "the impacts from each start";
    BASINS_KEEP = "basins" "keep" Allowed::Count(KEPT_AT_MOST), "the last impacts from each start, among which a cycle is looked for";
    PHASES_FROM = "basins.phase" "from" Allowed::Finite, "the first phase of the forcing at the first impact, rad";
    PHASES_TO = "basins.phase" "to" Allowed::Finite, "the last phase of the forcing at the first impact, rad";
    PHASES_POINTS = "basins.phase" "points" Allowed::Count(MOST_POINTS), "the number of phases, both ends counted";
    VELOCITIES_FROM = "basins.velocity" "from" Allowed::NotNegative, "the first velocity just before the first impact, without unit";
    VELOCITIES_TO = "basins.velocity" "to" Allowed::NotNegative, "the last velocity just before the first impact, without unit";
    VELOCITIES_POINTS = "basins.velocity" "points" Allowed::Count(MOST_POINTS), "the number of velocities, both ends counted";
    BOX_D = "box" "d" Allowed::Range, "the range of the gap";
    BOX_R_B = "box" "r_b" Allowed::Range, "the range of the restitution of the bottom";
    BOX_R_T = "box" "r_t" Allowed::Range, "the range of the restitution of the top";
    BOX_INCLINE = "box" "incline" Allowed::Range, "the range of the angle against the horizontal, rad";
    BOX_G = "box" "g" Allowed::Range, "the range of gravity along the capsule in units of the forcing";
    BOX_FORCING_AMPLITUDE = "box" "forcing_amplitude" Allowed::Range, "the range of the amplitude of the force, N";
    BOX_MARGIN = "box" "margin" Allowed::NotNegative, "what 1 + Det - |Tr| is at least";
    BOX_CLEARANCE = "box" "clearance" Allowed::NotNegative, "the least clearance";
    FINEST_CELL = "options" "finest_cell" Allowed::Part, "1-1 motions: the width of the finest cells in T_1 and psi";
    MOST_CELLS = "options" "most_cells" Allowed::Count(MOST_POINTS), "1-1 motions: the most cells at one value, for each forcing period";
    MOST_COVER_CELLS = "options" "most_cover_cells" Allowed::Count(MOST_CELLS_OF_A_COVER), "1-1 motions over a range: the most cells of their cover";
    MOST_COVERS = "options" "most_covers" Allowed::Count(MOST_TIMES), "1-1 motions over a range: how often what is undecided is covered again";
    WORD_STARTS = "options" "word_starts" Allowed::Count(MOST_POINTS), "other words: the starts at one value, for each impact and forcing period";
    BRANCH_VALUES = "options" "branch_values" Allowed::Count(MOST_TIMES), "other words over a range: the values at which motions are searched for";
    BRANCH_STARTS = "options" "branch_starts" Allowed::Count(MOST_POINTS), "other words over a range: the starts at each, for each impact and forcing period";
    LONGEST_STEP = "options" "longest_step" Allowed::Part, "continuation: the longest step, in radians and ranges of the parameter";
    SHORTEST_STEP = "options" "shortest_step" Allowed::Part, "continuation: the step below which a branch is left";
    SWITCHES = "options" "switches" Allowed::Count(MOST_TIMES), "continuation: how often the branch that parts at a period doubling, or where a symmetry breaks, is followed in its turn";
    MOST_STEPS = "options" "most_steps" Allowed::Count(MOST_POINTS), "continuation: the most steps in one direction";
    LONGEST_WORD = "options" "longest_word" Allowed::Count(MOST_SYMBOLS), "long runs: the most symbols of a word that is looked for";
    SETTLED = "options" "settled" Allowed::Part, "long runs: how far impacts a cycle apart may differ, in phase, rad, and in velocity";
    SETTLING_IMPACTS = "options" "settling_impacts" Allowed::Count(IMPACTS_AT_MOST), "long runs: the most impacts for which a cycle is followed on";
    RESTING_DIGITS = "options" "resting_digits" Allowed::Count(MOST_RESTING_DIGITS), "long runs: the digits that may be spent on a cycle through a rest";
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

/// What is allowed, where `value` is not.
pub(super) fn allowed_number(allowed: Allowed, value: &Quantity) -> Option<&'static str> {
    let sign = value.sign();
    let (is_right, words) = match allowed {
        Allowed::Positive => (sign == Ordering::Greater, "above 0"),
        Allowed::NotNegative => (sign != Ordering::Less, "0 or more"),
        Allowed::Part => (
            sign == Ordering::Greater && value.compared_with_one() != Ordering::Greater,
            "above 0 and at most 1",
        ),
        Allowed::Restitution => (
            sign != Ordering::Less && value.compared_with_one() != Ordering::Greater,
            "from 0 to 1",
        ),
        Allowed::Angle => (
            value.value::<f64>().abs() <= std::f64::consts::FRAC_PI_2 * (1.0 + f64::EPSILON),
            "an angle in rad from -pi/2 to pi/2; 20 degrees are \"20 pi/180\"",
        ),
        _ => (true, ""),
    };
    (!is_right).then_some(words)
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
            assert!(!key.meaning.is_empty());
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
