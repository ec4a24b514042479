//! The problems: inputs alone, no result.

use super::problem::{Kind, Level, Problem};
use Level::{Easy, Extreme, Hard};
use Side::{Bottom, Top};
use dynamics::model::Side;

/// Every problem, in order of kind and level.
pub fn list() -> Vec<Problem> {
    let lists: [Vec<Problem>; 5] = [orbits(), impacts(), runs(), jacobians(), voltages()];
    lists.concat()
}

/// g of the paper at an incline of pi/6.
const G: &str = "0.12201";

/// What a problem has where it needs nothing.
const NOTHING: Problem = Problem {
    name: "",
    kind: Kind::Orbit,
    level: Easy,
    motion: [""; 4],
    cycle: None,
    side: None,
    phase: "",
    velocity: "",
    impacts: None,
    membrane: [""; 6],
    velocity_unit: "",
};

type Motion = [&'static str; 4];
type Cycle = (&'static str, u32);
type Start = (Side, &'static str, &'static str);

/// A periodic motion near a first impact at the bottom.
fn orbit(name: &'static str, level: Level, motion: Motion, cycle: Cycle, near: [&'static str; 2]) -> Problem {
    let [phase, velocity] = near;
    Problem {
        name,
        level,
        motion,
        cycle: Some(cycle),
        side: Some(Bottom),
        phase,
        velocity,
        ..NOTHING
    }
}

/// A motion from a start impact to a later one; to its first rest where that is none.
fn run(name: &'static str, level: Level, motion: Motion, start: Start, impacts: Option<u32>) -> Problem {
    let (side, phase, velocity) = start;
    Problem {
        name,
        level,
        kind: Kind::Run,
        motion,
        side: Some(side),
        phase,
        velocity,
        impacts,
        ..NOTHING
    }
}

/// A motion from a start impact to the next one.
fn impact(name: &'static str, level: Level, motion: Motion, start: Start) -> Problem {
    let kind = Kind::Impact;
    Problem {
        kind,
        ..run(name, level, motion, start, Some(1))
    }
}

/// The derivative at the impact after a start.
fn flight_jacobian(name: &'static str, level: Level, motion: Motion, start: Start) -> Problem {
    let kind = Kind::Jacobian;
    Problem {
        kind,
        ..run(name, level, motion, start, Some(1))
    }
}

/// The derivative over a cycle.
fn cycle_jacobian(name: &'static str, level: Level, motion: Motion, cycle: Cycle, near: [&'static str; 2]) -> Problem {
    let kind = Kind::Jacobian;
    Problem {
        kind,
        ..orbit(name, level, motion, cycle, near)
    }
}

/// The membrane of Table 1.
const TABLE_1: [&str; 6] = ["0.0035", "408470", "2.6", "0.005", "0.0063", "2000"];

/// A pi/(M omega) of Table 1 with A = 5 N and omega = 5 pi rad/s, m/s.
const UNIT: &str = "8.032128514";

/// The voltage of one impact, in m/s.
fn voltage(name: &'static str, level: Level, membrane: [&'static str; 6], speed: &'static str) -> Problem {
    Problem {
        name,
        level,
        kind: Kind::Voltage,
        side: Some(Bottom),
        phase: "0",
        velocity: speed,
        membrane,
        velocity_unit: "1",
        ..NOTHING
    }
}

/// The mean voltage over a cycle.
fn mean(name: &'static str, level: Level, motion: Motion, cycle: Cycle, near: [&'static str; 2]) -> Problem {
    Problem {
        kind: Kind::Voltage,
        membrane: TABLE_1,
        velocity_unit: UNIT,
        ..orbit(name, level, motion, cycle, near)
    }
}

const PAIR: Cycle = ("BT", 1);
const PAIR_OVER_TWO: Cycle = ("BT", 2);

#[rustfmt::skip]
fn orbits() -> Vec<Problem> {
    let pair = |name, level, motion, near| orbit(name, level, motion, PAIR, near);
    vec![
        pair("orbit-focus", Easy, [G, "0.4", "0.5", "0.5"], ["0.49", "0.83"]),
        pair("orbit-node", Easy, [G, "0.26", "0.5", "0.5"], ["0.15", "0.68"]),
        pair("orbit-saddle", Easy, [G, "0.4", "0.5", "0.5"], ["2.88", "0.35"]),
        pair("orbit-two-restitutions", Easy, [G, "0.33", "0.6", "0.3"], ["1.21", "0.73"]),
        pair("orbit-wide", Easy, [G, "0.5", "0.6", "0.3"], ["1.21", "0.89"]),
        pair("orbit-steep", Easy, ["0.2113", "0.5", "0.6", "0.3"], ["1.08", "0.95"]),
        pair("orbit-from-above", Easy, ["-0.3", "0.4", "0.5", "0.7"], ["0.32", "0.58"]),
        orbit("orbit-three-impacts", Easy, [G, "0.26", "0.6", "0.3"], ("BTT", 1), ["0.94", "0.7"]),
        orbit("orbit-one-wall", Easy, [G, "0.8", "0.5", "0.5"], ("B", 1), ["3.01", "0.16"]),
        pair("orbit-without-gravity", Hard, ["0", "0.3", "0.5", "0.5"], ["0.52", "0.63"]),
        pair("orbit-elastic-nearly", Hard, [G, "2", "0.9", "0.9"], ["0.37", "2.37"]),
        pair("orbit-heavy", Hard, ["1.1", "1.572303", "0.8", "0.8"], ["0.68", "2.53"]),
        pair("orbit-heavier", Hard, ["2.5", "1.572303", "0.8", "0.8"], ["2.03", "3.02"]),
        pair("orbit-dull", Hard, [G, "0.4", "0.1", "0.1"], ["1.58", "0.78"]),
        pair("orbit-below-a-doubling", Hard, [G, "0.251", "0.5", "0.5"], ["0.13", "0.67"]),
        orbit("orbit-doubled", Hard, [G, "0.25", "0.5", "0.5"], ("BTBT", 2), ["0.141", "0.676"]),
        orbit("orbit-three-at-the-top", Hard, [G, "0.2", "0.6", "0.3"], ("BTTT", 1), ["0.84", "0.63"]),
        orbit("orbit-two-periods", Hard, [G, "0.44", "0.6", "0.3"], PAIR_OVER_TWO, ["2.971", "0.349"]),
        orbit("orbit-three-periods", Hard, [G, "1.5", "0.8", "0.8"], ("BT", 3), ["2.933", "0.685"]),
        pair("orbit-near-a-fold", Extreme, [G, "0.9717697321", "0.5", "0.5"], ["1.75059", "1.32104"]),
        pair("orbit-at-a-fold", Extreme, [G, "0.9717697321666", "0.5", "0.5"], ["1.7506077", "1.321032"]),
        pair("orbit-at-a-fold-unstable", Extreme, [G, "0.9717697321666", "0.5", "0.5"], ["1.7506083", "1.321032"]),
        pair("orbit-at-a-doubling", Extreme, [G, "0.25107018538986", "0.5", "0.5"], ["0.125", "0.668"]),
        pair("orbit-at-a-grazing", Extreme, [G, "0.2612231724144", "0.6", "0.3"], ["1.318", "0.667"]),
        pair("orbit-in-the-layer-of-small-gravity", Extreme, ["0.0000000001", "0.3", "0.5", "0.5"], ["0.52", "0.63"]),
        pair("orbit-elastic-but-a-millionth", Extreme, [G, "0.4", "0.999999", "0.999999"], ["0", "0.66"]),
        pair("orbit-at-a-symmetry-breaking", Extreme, ["0", "0.29590372670807", "1", "1"], ["0.089", "0.4993"]),
        pair("orbit-elastic-and-far", Extreme, ["0", "50", "1", "1"], ["0", "50.2"]),
        orbit("orbit-four-periods", Extreme, [G, "1.5", "0.8", "0.8"], ("BT", 4), ["3.0064", "0.654"]),
        orbit("orbit-five-periods", Extreme, [G, "1.5", "0.8", "0.8"], ("BT", 5), ["0.2139", "0.6823"]),
        orbit("orbit-one-wall-elastic-nearly", Extreme, [G, "0.8", "0.999", "0.5"], ("B", 1), ["3.1414", "0.122"]),
    ]
}

/// The flights of near misses and light touches graze a wall at the velocities 0.63376724981757582... and
/// 0.57332596901541513...; the decimals given stand just before and behind.
#[rustfmt::skip]
fn impacts() -> Vec<Problem> {
    vec![
        impact("impact-fast", Easy, [G, "0.26", "0.6", "0.3"], (Bottom, "6.18", "0.5293")),
        impact("impact-from-the-top", Easy, [G, "0.26", "0.6", "0.3"], (Top, "3", "-0.5555")),
        impact("impact-on-the-same-wall", Easy, [G, "0.26", "0.6", "0.3"], (Top, "4.34", "-0.12")),
        impact("impact-wide", Easy, [G, "0.5", "0.5", "0.5"], (Bottom, "1", "0.9")),
        impact("impact-from-above", Easy, ["-0.4", "0.35", "0.7", "0.6"], (Bottom, "2", "0.6")),
        impact("impact-very-fast", Hard, [G, "0.3", "0.6", "0.3"], (Bottom, "6.18", "67")),
        impact("impact-slow", Hard, [G, "0.3", "0.6", "0.3"], (Bottom, "6", "0.001")),
        impact("impact-after-several-periods", Hard, ["0.01", "4", "0.9", "0.9"], (Bottom, "1", "0.25")),
        impact("impact-heavy", Hard, ["3", "2", "0.9", "0.9"], (Bottom, "1", "2")),
        impact("impact-dull", Hard, [G, "0.3", "0.001", "0.001"], (Bottom, "2", "0.7")),
        impact("impact-after-a-near-miss", Hard, ["-0.12201", "0.2612", "0.3", "0.6"], (Bottom, "6.2687", "0.6338")),
        impact("impact-with-a-light-touch", Hard, [G, "0.8", "0.5", "0.5"], (Bottom, "0.5", "0.5734")),
        impact("impact-after-a-miss-of-a-trillionth", Extreme, ["-0.12201", "0.2612", "0.3", "0.6"], (Bottom, "6.2687", "0.633767249818")),
        impact("impact-by-a-touch-of-a-trillionth", Extreme, ["-0.12201", "0.2612", "0.3", "0.6"], (Bottom, "6.2687", "0.633767249817")),
        impact("impact-grazing-the-other-wall", Extreme, [G, "0.8", "0.5", "0.5"], (Bottom, "0.5", "0.573325969015414")),
        impact("impact-missing-the-other-wall", Extreme, [G, "0.8", "0.5", "0.5"], (Bottom, "0.5", "0.573325969015413")),
        impact("impact-as-fast-as-a-bullet", Extreme, [G, "0.3", "0.6", "0.3"], (Bottom, "6.18", "1000000")),
        impact("impact-of-a-billionth", Extreme, [G, "0.3", "0.6", "0.3"], (Bottom, "2.5", "0.000000001")),
        impact("impact-within-a-chatter", Extreme, [G, "0.3", "0.6", "0.3"], (Bottom, "6", "0.000004")),
        impact("impact-in-a-narrow-gap", Extreme, [G, "0.000001", "0.6", "0.3"], (Bottom, "2.5", "0.01")),
        impact("impact-after-many-periods", Extreme, ["0.01", "20", "1", "1"], (Bottom, "1", "0.5")),
        impact("impact-across-a-hall", Extreme, ["-0.000001", "10000", "0.9", "0.9"], (Bottom, "1", "20")),
        impact("impact-at-the-wrap-of-the-phase", Extreme, [G, "0.3", "0.6", "0.3"], (Bottom, "6.283185307179586", "0.5")),
        impact("impact-off-a-weightless-moment", Extreme, ["0.5", "0.3", "0.6", "0.3"], (Bottom, "2.0943951", "0.00001")),
    ]
}

#[rustfmt::skip]
fn runs() -> Vec<Problem> {
    let start = (Bottom, "6.18", "0.5293");
    vec![
        run("run-to-a-focus", Easy, [G, "0.4", "0.5", "0.5"], start, Some(10)),
        run("run-to-a-node", Easy, [G, "0.33", "0.6", "0.3"], start, Some(10)),
        run("run-of-twenty", Easy, [G, "0.5", "0.5", "0.5"], start, Some(20)),
        run("run-to-three-impacts", Easy, [G, "0.26", "0.6", "0.3"], (Bottom, "0.9", "0.7"), Some(15)),
        run("run-to-rest", Easy, [G, "0.26", "0.3", "0.6"], start, None),
        run("run-of-sixty", Hard, [G, "0.4", "0.6", "0.3"], start, Some(60)),
        run("run-from-a-bullet", Hard, [G, "0.26", "0.6", "0.3"], (Bottom, "6.18", "67"), Some(60)),
        run("run-beside-a-doubling", Hard, [G, "0.25107", "0.5", "0.5"], start, Some(60)),
        run("run-dull", Hard, [G, "0.5", "0.2", "0.2"], (Bottom, "1.3", "0.85"), Some(40)),
        run("run-heavy", Hard, ["1.1", "1.572303", "0.8", "0.8"], (Bottom, "0.7", "2.5"), Some(40)),
        run("run-far", Hard, [G, "10", "0.99", "0.99"], (Bottom, "1", "3"), Some(60)),
        run("run-to-rest-dull", Hard, [G, "0.3", "0.01", "0.01"], (Bottom, "2.5", "0.1"), None),
        run("run-to-rest-at-the-top", Hard, ["-0.2", "0.5", "0.5", "0.4"], (Top, "4", "-0.1"), None),
        run("run-to-rest-lively", Hard, [G, "0.4", "0.7", "0.7"], (Bottom, "4.9", "0.01"), None),
        run("run-chaotic", Extreme, [G, "0.25", "0.4", "0.5"], start, Some(60)),
        run("run-chaotic-and-steep", Extreme, ["0.5", "0.08", "0.9", "0.9"], (Bottom, "6.18", "1"), Some(60)),
        run("run-chaotic-in-a-narrow-gap", Extreme, [G, "0.02", "0.95", "0.95"], (Bottom, "1", "1"), Some(80)),
        run("run-elastic", Extreme, [G, "0.3", "1", "1"], start, Some(60)),
        run("run-elastic-without-gravity", Extreme, ["0", "0.3", "1", "1"], (Bottom, "1", "0.5"), Some(100)),
        run("run-chaotic-of-hundred", Extreme, [G, "0.04", "0.8", "0.8"], (Bottom, "6.18", "1"), Some(100)),
        run("run-nearly-as-heavy-as-shaken", Extreme, ["0.99", "3", "0.9", "0.9"], (Bottom, "1", "2"), Some(60)),
        run("run-to-rest-livelier", Extreme, [G, "0.4", "0.85", "0.85"], (Bottom, "4.8", "0.001"), None),
        run("run-to-rest-just-in-time", Extreme, [G, "0.3", "0.5", "0.5"], (Bottom, "1.6", "0.0001"), None),
    ]
}

#[rustfmt::skip]
fn jacobians() -> Vec<Problem> {
    let pair = |name, level, motion, near| cycle_jacobian(name, level, motion, PAIR, near);
    vec![
        flight_jacobian("jacobian-of-a-flight", Easy, [G, "0.26", "0.6", "0.3"], (Bottom, "6.18", "0.5293")),
        flight_jacobian("jacobian-from-the-top", Easy, [G, "0.26", "0.6", "0.3"], (Top, "3", "-0.5555")),
        flight_jacobian("jacobian-on-the-same-wall", Easy, [G, "0.26", "0.6", "0.3"], (Top, "4.34", "-0.12")),
        pair("jacobian-of-a-focus", Easy, [G, "0.4", "0.5", "0.5"], ["0.49", "0.83"]),
        pair("jacobian-of-a-node", Easy, [G, "0.33", "0.6", "0.3"], ["1.21", "0.73"]),
        cycle_jacobian("jacobian-of-three-impacts", Easy, [G, "0.26", "0.6", "0.3"], ("BTT", 1), ["0.94", "0.7"]),
        flight_jacobian("jacobian-after-a-bullet", Hard, [G, "0.3", "0.6", "0.3"], (Bottom, "6.18", "67")),
        flight_jacobian("jacobian-after-several-periods", Hard, ["0.01", "4", "0.9", "0.9"], (Bottom, "1", "0.25")),
        flight_jacobian("jacobian-beside-a-grazing", Hard, [G, "0.8", "0.5", "0.5"], (Bottom, "0.5", "0.5734")),
        cycle_jacobian("jacobian-of-two-periods", Hard, [G, "0.44", "0.6", "0.3"], PAIR_OVER_TWO, ["2.971", "0.349"]),
        cycle_jacobian("jacobian-doubled", Hard, [G, "0.25", "0.5", "0.5"], ("BTBT", 2), ["0.141", "0.676"]),
        flight_jacobian("jacobian-at-a-grazing", Extreme, [G, "0.8", "0.5", "0.5"], (Bottom, "0.5", "0.573325969015414")),
        flight_jacobian("jacobian-of-a-light-touch", Extreme, ["-0.12201", "0.2612", "0.3", "0.6"], (Bottom, "6.2687", "0.633767249817")),
        flight_jacobian("jacobian-within-a-chatter", Extreme, [G, "0.3", "0.6", "0.3"], (Bottom, "6", "0.000004")),
        pair("jacobian-at-a-fold", Extreme, [G, "0.9717697321666", "0.5", "0.5"], ["1.7506077", "1.321032"]),
        cycle_jacobian("jacobian-of-five-periods", Extreme, [G, "1.5", "0.8", "0.8"], ("BT", 5), ["0.2139", "0.6823"]),
        pair("jacobian-dull", Extreme, [G, "0.4", "0.1", "0.1"], ["1.58", "0.78"]),
    ]
}

#[rustfmt::skip]
fn voltages() -> Vec<Problem> {
    let pair = |name, level, motion, near| mean(name, level, motion, PAIR, near);
    let narrow = ["0.0035", "408470", "2.6", "0.005", "0.0050000001", "2000"];
    let stiff = ["0.000001", "1000000000000", "1", "0.001", "1", "0.001"];
    vec![
        voltage("voltage-at-1", Easy, TABLE_1, "1"),
        voltage("voltage-at-5", Easy, TABLE_1, "5.4413"),
        voltage("voltage-from-the-top", Easy, TABLE_1, "-7.26"),
        pair("voltage-of-a-node", Easy, [G, "0.26", "0.5", "0.5"], ["0.15", "0.68"]),
        pair("voltage-of-a-wide-gap", Easy, [G, "0.5", "0.6", "0.3"], ["1.21", "0.89"]),
        mean("voltage-of-three-impacts", Easy, [G, "0.26", "0.6", "0.3"], ("BTT", 1), ["0.94", "0.7"]),
        voltage("voltage-slight", Hard, TABLE_1, "0.001"),
        voltage("voltage-strong", Hard, TABLE_1, "100"),
        voltage("voltage-in-a-narrow-rim", Hard, narrow, "2"),
        mean("voltage-of-two-periods", Hard, [G, "0.44", "0.6", "0.3"], PAIR_OVER_TWO, ["2.971", "0.349"]),
        voltage("voltage-of-a-millionth", Extreme, TABLE_1, "0.000001"),
        voltage("voltage-of-a-trillionth", Extreme, TABLE_1, "0.000000000001"),
        voltage("voltage-of-a-million", Extreme, TABLE_1, "1000000"),
        voltage("voltage-of-a-bullet-in-a-narrow-rim", Extreme, narrow, "100000"),
        voltage("voltage-of-a-stiff-membrane", Extreme, stiff, "0.0001"),
        mean("voltage-of-five-periods", Extreme, [G, "1.5", "0.8", "0.8"], ("BT", 5), ["0.2139", "0.6823"]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn names_are_unique_and_say_their_kind() {
        let problems = list();
        let names: HashSet<&str> = problems.iter().map(|problem| problem.name).collect();
        assert_eq!(names.len(), problems.len());
        for problem in &problems {
            assert!(problem.name.starts_with(problem.kind.name()), "{}", problem.name);
        }
    }

    #[test]
    fn every_kind_has_every_level_and_they_stand_in_order() {
        let order: Vec<(Kind, Level)> = list().iter().map(|problem| (problem.kind, problem.level)).collect();
        assert!(
            order.is_sorted() && (60..=150).contains(&order.len()),
            "{}",
            order.len()
        );
        for kind in Kind::ALL {
            for level in Level::ALL {
                assert!(order.contains(&(kind, level)), "{kind} {level}");
            }
        }
    }
}
