//! A problem: inputs that decimal text states exactly, and what is asked.

use super::Why;
use dynamics::impact::{Origin, Start};
use dynamics::model::{Exact, Membrane, Motion, MotionError, Parameters, Side};
use dynamics::orbit::Word;
use numbers::{Analytic, Rational};
use std::fmt;

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// A periodic motion: `phase_k`, `velocity_k` and `time_k` of each impact k from 1, and `trace`.
    Orbit,
    /// The impact after the start: `time` since the start, `phase`, `velocity`.
    Impact,
    /// The same of a later impact; or, of a motion that comes to rest, `rest_time`, `release_time`, and `landing_time`
    /// and `landing_velocity` of the impact after that.
    Run,
    /// The derivative of (t, Zdot) at the next impact, or of a periodic motion after one cycle, by those at the start:
    /// `dt_dt`, `dt_dv`, `dv_dt`, `dv_dv`, `trace` (of a cycle), `determinant`.
    Jacobian,
    /// The voltage of an impact, `voltage`, or its mean over a cycle, `mean_voltage`; V.
    Voltage,
}

impl Kind {
    /// Every kind, in the order of the problems.
    pub const ALL: [Self; 5] = [Self::Orbit, Self::Impact, Self::Run, Self::Jacobian, Self::Voltage];

    /// The word in the column `kind`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Orbit => "orbit",
            Self::Impact => "impact",
            Self::Run => "run",
            Self::Jacobian => "jacobian",
            Self::Voltage => "voltage",
        }
    }
}

/// How they are answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Means {
    /// As the commands do: parameters as typed, orbits and runs in a wider number wherever f64 does not hold its
    /// digits; formulas in f64.
    Default,
    /// In f64 alone, parameters rounded to it.
    Double,
}

/// How much a problem asks of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Level {
    /// The paper's own range, well conditioned.
    Easy,
    /// Long, badly conditioned, or beyond the paper's range.
    Hard,
    /// Beside a bifurcation or a grazing, chaotic, or with parameters at the ends of what physics allows.
    Extreme,
}

impl Level {
    /// Every level, in order.
    pub const ALL: [Self; 3] = [Self::Easy, Self::Hard, Self::Extreme];

    /// The word in the column `level`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Easy => "easy",
            Self::Hard => "hard",
            Self::Extreme => "extreme",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A problem. Every number is a plain decimal and means exactly that; an empty text says that none is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Permanent and unique.
    pub name: &'static str,
    /// What is asked.
    pub kind: Kind,
    /// How much that asks of a solver.
    pub level: Level,
    /// g, d, r_B and r_T.
    pub motion: [&'static str; 4],
    /// The word of a periodic motion, and the forcing periods it takes.
    pub cycle: Option<(&'static str, u32)>,
    /// The wall of the start impact, or of the first impact of a cycle.
    pub side: Option<Side>,
    /// The phase of the forcing at the start impact, rad. Of a cycle, about that of its first impact.
    pub phase: &'static str,
    /// Zdot just before the start impact. Of a cycle, about that of its first impact.
    pub velocity: &'static str,
    /// The impact that is asked for, counted from the one after the start; none where the motion is followed to its
    /// first rest.
    pub impacts: Option<u32>,
    /// ball_mass, stiffness, exponent, ball_radius, membrane_radius and input_voltage, SI.
    pub membrane: [&'static str; 6],
    /// The velocity 1 in m/s.
    pub velocity_unit: &'static str,
}

impl Problem {
    /// The names of [`Problem::fields`].
    pub const COLUMNS: [&'static str; 20] = [
        "problem",
        "kind",
        "level",
        "g",
        "d",
        "r_b",
        "r_t",
        "word",
        "periods",
        "side",
        "phase",
        "velocity",
        "impacts",
        "ball_mass",
        "stiffness",
        "exponent",
        "ball_radius",
        "membrane_radius",
        "input_voltage",
        "velocity_unit",
    ];

    /// All that is given, as text.
    pub fn fields(&self) -> [String; 20] {
        let told = |value: Option<String>| value.unwrap_or_default();
        let [g, d, r_b, r_t] = self.motion.map(str::to_owned);
        let [mass, stiffness, exponent, ball, rim, volts] = self.membrane.map(str::to_owned);
        [
            self.name.to_owned(),
            self.kind.to_string(),
            self.level.to_string(),
            g,
            d,
            r_b,
            r_t,
            told(self.cycle.map(|(word, _)| word.to_owned())),
            told(self.cycle.map(|(_, periods)| periods.to_string())),
            told(self.side.map(|side| side.to_string())),
            self.phase.to_owned(),
            self.velocity.to_owned(),
            told(self.impacts.map(|impacts| impacts.to_string())),
            mass,
            stiffness,
            exponent,
            ball,
            rim,
            volts,
            self.velocity_unit.to_owned(),
        ]
    }

    /// The four parameters.
    pub(super) fn given(&self) -> Result<Given, Why> {
        let [g, d, r_b, r_t] = self.motion;
        Ok(Given([
            exact("g", g)?,
            exact("d", d)?,
            exact("r_b", r_b)?,
            exact("r_t", r_t)?,
        ]))
    }

    /// The start impact.
    pub(super) fn begin(&self) -> Result<Begin, Why> {
        Ok(Begin {
            side: self.side.ok_or(Why::Missing("side"))?,
            phase: exact("phase", self.phase)?,
            velocity: exact("velocity", self.velocity)?,
        })
    }

    /// The word and the forcing periods of a cycle.
    pub(super) fn word(&self) -> Result<(Word, u32), Why> {
        let (word, periods) = self.cycle.ok_or(Why::Missing("word"))?;
        Ok((word.parse().map_err(|_| Why::Missing("word"))?, periods))
    }

    /// The six quantities of the membrane, in order, over a number.
    pub(super) fn membrane_values<T: Analytic>(&self) -> Result<[T; 6], Why> {
        let columns: &[&'static str] = &Self::COLUMNS[13..19];
        let mut values = Vec::new();
        for (column, text) in columns.iter().zip(self.membrane) {
            values.push(exact(column, text)?.value());
        }
        values.try_into().map_err(|_| Why::Missing("ball_mass"))
    }

    /// The membrane over a number.
    pub(super) fn membrane<T: Analytic>(&self) -> Result<Membrane<T>, Why> {
        let [mass, stiffness, exponent, ball, rim, volts] = self.membrane_values()?;
        Ok(Membrane::new(mass, stiffness, exponent, ball, rim, volts)?)
    }

    /// The velocity 1 in m/s.
    pub(super) fn unit<T: Analytic>(&self) -> Result<T, Why> {
        Ok(exact("velocity_unit", self.velocity_unit)?.value())
    }
}

/// The value of a plain decimal in this column.
fn exact(column: &'static str, text: &str) -> Result<Rational, Why> {
    let value = match text.strip_prefix('-') {
        Some(size) => Rational::from_decimal(size).map(|value| -value),
        None => Rational::from_decimal(text),
    };
    value.ok_or(Why::Missing(column))
}

/// The parameters of a motion, exactly.
#[derive(Clone, Debug)]
pub(super) struct Given([Rational; 4]);

impl Parameters for Given {
    fn motion<T: Analytic>(&self) -> Result<Motion<T>, MotionError> {
        let [g, d, r_b, r_t] = self.0.each_ref().map(Exact::value);
        Motion::new(g, d, r_b, r_t)
    }
}

/// A start impact, exactly.
#[derive(Clone, Debug)]
pub(super) struct Begin {
    pub side: Side,
    pub phase: Rational,
    pub velocity: Rational,
}

impl Origin for Begin {
    fn start<T: Analytic>(&self) -> Start<T> {
        Start::impact(self.side, self.phase.value(), self.velocity.value())
    }
}
