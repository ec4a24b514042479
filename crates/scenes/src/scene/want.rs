//! What a scene may want.

use std::fmt;

/// Something that can be wanted of a scene; a command serves each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Want {
    /// Every orbit of the wanted words.
    Orbits,
    /// The orbits followed over the sweep, with every bifurcation.
    Branch,
    /// The impacts from the start on.
    Impacts,
    /// The bifurcation diagram.
    Sweep,
    /// The motion between the impacts.
    Trajectory,
    /// The voltage of the impacts.
    Voltage,
    /// What each point of two parameters comes to.
    Map,
    /// Which attractor each of a grid of starts comes to.
    Basins,
    /// The best device of a box.
    Optimum,
}

impl Want {
    /// Every want, in the order in which DESIGN lists them.
    pub const ALL: [Self; 9] = [
        Self::Orbits,
        Self::Branch,
        Self::Impacts,
        Self::Sweep,
        Self::Trajectory,
        Self::Voltage,
        Self::Map,
        Self::Basins,
        Self::Optimum,
    ];

    /// The word in `want = [...]`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Orbits => "orbits",
            Self::Branch => "branch",
            Self::Impacts => "impacts",
            Self::Sweep => "sweep",
            Self::Trajectory => "trajectory",
            Self::Voltage => "voltage",
            Self::Map => "map",
            Self::Basins => "basins",
            Self::Optimum => "optimum",
        }
    }

    /// The want of this name.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|want| want.name() == name)
    }

    /// The command that serves it.
    pub const fn command(self) -> &'static str {
        match self {
            Self::Impacts => "simulate",
            Self::Voltage => "sweep",
            Self::Optimum => "optimise",
            other => other.name(),
        }
    }

    /// What is computed.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Orbits => "every orbit of the wanted words",
            Self::Branch => "the orbits followed over the sweep, and their bifurcations",
            Self::Impacts => "the impacts from the start on, in order",
            Self::Sweep => "the bifurcation diagram: the impacts at each value of the sweep",
            Self::Trajectory => "the motion between the impacts, from the start on",
            Self::Voltage => "the voltage that the membrane gives at each impact, and its mean",
            Self::Map => "what each point of two parameters comes to",
            Self::Basins => "which attractor each of a grid of starts comes to",
            Self::Optimum => "the device of a box whose 1-1 motion gives the largest voltage",
        }
    }
}

impl fmt::Display for Want {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_want_is_found_by_its_name_and_nothing_else_is() {
        for want in Want::ALL {
            assert_eq!(Want::find(want.name()), Some(want));
        }
        assert_eq!(Want::find("Orbits"), None);
    }
}
