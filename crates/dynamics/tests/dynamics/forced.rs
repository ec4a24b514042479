//! Motions under several harmonics, from any start, over one wall, with plastic impacts, beside a plain integrator that
//! steps through time and knows nothing of the program's flights.

use dynamics::impact::{
    Enclosure, Event, Extent, Grown, Kind, Simulation, Start, Trajectory, Widening, in_lanes, rows,
};
use dynamics::model::{Forcing, Motion, Side};
use numbers::{Analytic, Interval, Rung, Sequence, Wide};
use std::f64::consts::{PI, TAU};

/// What a test knows of a motion.
#[derive(Clone, Debug)]
struct Device {
    g: f64,
    /// `None` of one wall.
    d: Option<f64>,
    r: [f64; 2],
    cosines: Vec<f64>,
    sines: Vec<f64>,
}

impl Device {
    fn drawn(sequence: &mut Sequence, with_top: bool) -> Self {
        let count = 1 + (sequence.between(0.0, 5.0) as usize);
        let mut amplitudes = || (1..=count).map(|n| sequence.between(-1.0, 1.0) / n as f64).collect();
        let (cosines, sines) = (amplitudes(), amplitudes());
        let g = if with_top {
            sequence.between(-0.6, 0.6)
        } else {
            sequence.between(0.1, 0.6)
        };
        Self {
            g,
            d: with_top.then(|| sequence.between(0.05, 0.9)),
            r: [sequence.between(0.2, 0.95), sequence.between(0.2, 0.95)],
            cosines,
            sines,
        }
    }

    fn motion<T: Analytic>(&self) -> Motion<T> {
        let number = |value: &f64| T::from_f64(*value);
        let [r_b, r_t] = [&self.r[0], &self.r[1]].map(number);
        let motion = match &self.d {
            Some(d) => Motion::new(number(&self.g), number(d), r_b, r_t),
            None => Motion::one_wall(number(&self.g), r_b),
        };
        let list = |values: &[f64]| values.iter().map(number).collect::<Vec<_>>();
        let forcing = Forcing::periodic(number(&2.0), &list(&self.cosines), &list(&self.sines)).expect("a forcing");
        motion
            .and_then(|motion| motion.with_forcing(forcing))
            .expect("a motion")
    }

    /// Z as given by (4), with f summed harmonic by harmonic, a time `s` after a departure at time `t` from `z` with `v`.
    fn state(&self, [t, z, v]: [f64; 3], s: f64) -> [f64; 2] {
        let (mut place, mut velocity) = (z + v * s + 0.5 * self.g * s * s, v + self.g * s);
        let mut add = |n: usize, a: f64, phase: f64| {
            // a cos(w t + phase)
            let w = PI * n as f64;
            let angle = |time: f64| w * time + phase;
            velocity += a / w * (angle(t + s).sin() - angle(t).sin());
            place += -a / (w * w) * (angle(t + s).cos() - angle(t).cos()) - a / w * angle(t).sin() * s;
        };
        for (index, a) in self.cosines.iter().enumerate() {
            add(index + 1, *a, 0.0);
        }
        for (index, b) in self.sines.iter().enumerate() {
            add(index + 1, *b, -PI / 2.0);
        }
        [place, velocity]
    }

    fn push(&self, phase: f64) -> f64 {
        let sum = |list: &[f64], of: fn(f64) -> f64| {
            let terms = list
                .iter()
                .enumerate()
                .map(|(index, a)| a * of((index + 1) as f64 * phase));
            terms.sum::<f64>()
        };
        self.g + sum(&self.cosines, f64::cos) + sum(&self.sines, f64::sin)
    }

    /// The first crossing of a wall after a departure, by steps of 1/2000 and bisection: the side, the time since, Zdot; and
    /// how near the ball came to a wall that it did not cross. `None` within 40.
    fn crossing(&self, from: [f64; 3], left: Option<Side>) -> Option<(Side, f64, f64, f64)> {
        let half = 0.5 * self.d.unwrap_or(0.0);
        let beyond = |side: Side, s: f64| {
            let [z, _] = self.state(from, s);
            side.sign() * z - half
        };
        let mut nearest = f64::INFINITY;
        let mut low = 0.0;
        let h = 1.0 / 2000.0;
        while low < 40.0 {
            let high = low + h;
            for side in [Side::Bottom, Side::Top] {
                if side == Side::Top && self.d.is_none() {
                    continue;
                }
                let first = low == 0.0 && left == Some(side);
                if beyond(side, high) > 0.0 {
                    let (mut a, mut b) = (if first { h / 1e6 } else { low }, high);
                    for _ in 0..200 {
                        let middle = 0.5 * (a + b);
                        if beyond(side, middle) > 0.0 {
                            b = middle
                        } else {
                            a = middle
                        }
                    }
                    let [_, velocity] = self.state(from, b);
                    return Some((side, b, velocity, nearest));
                }
                if low > 0.05 {
                    nearest = nearest.min(-beyond(side, high));
                }
            }
            low = high;
        }
        None
    }
}

fn time(event: &Event<f64>) -> f64 {
    2.0 * event.turns as f64 + event.phase / PI
}

/// Holds each ordinary flight of a motion against the plain one from its departure; the number compared.
fn compare(device: &Device, events: &[Event<f64>]) -> usize {
    let half = 0.5 * device.d.unwrap_or(0.0);
    let mut compared = 0;
    for pair in events.windows(2) {
        let [before, after] = pair else { continue };
        if before.kind != Kind::Impact || after.kind != Kind::Impact || before.velocity.abs() < 0.05 {
            continue;
        }
        let launch = -device.r[before.side as usize] * before.velocity;
        let from = [time(before), before.side.sign() * half, launch];
        let Some((side, s, velocity, nearest)) = device.crossing(from, Some(before.side)) else {
            continue;
        };
        // what the steps cannot tell, and what an error blows up
        if nearest < 1e-4 || velocity.abs() < 0.02 || s < 0.01 {
            continue;
        }
        compared += 1;
        assert_eq!(side, after.side, "{device:?} {before:?} {after:?}");
        let late = time(after) - time(before) - s;
        assert!(
            late.abs() < 1e-11 / velocity.abs(),
            "{device:?} {before:?} {after:?} {late:e}"
        );
        assert!(
            (velocity - after.velocity).abs() < 1e-10 / velocity.abs(),
            "{device:?} {before:?} {after:?}"
        );
    }
    compared
}

#[test]
fn flights_under_harmonics_are_those_of_a_plain_integrator() {
    let mut sequence = Sequence::new(4901);
    for with_top in [true, false] {
        let mut compared = 0;
        for _ in 0..60 {
            let device = Device::drawn(&mut sequence, with_top);
            let start = Start::impact(Side::Bottom, sequence.between(0.0, TAU), sequence.between(0.2, 1.5));
            let events: Vec<Event<f64>> = Widening::new(&device.motion(), &start).take(40).collect();
            compared += compare(&device, &events);
        }
        assert!(compared > 700, "{with_top} {compared}");
    }
}

#[test]
fn a_ball_that_starts_in_flight_meets_the_wall_of_the_plain_integrator() {
    let mut sequence = Sequence::new(4902);
    let mut compared = 0;
    for index in 0..160 {
        let mut device = Device::drawn(&mut sequence, index % 3 > 0);
        if index % 2 == 0 {
            (device.cosines, device.sines) = (vec![1.0], Vec::new());
        }
        let z = match device.d {
            Some(d) => sequence.between(-0.49, 0.49) * d,
            None => -sequence.between(0.0, 2.0),
        };
        let (phase, velocity) = (sequence.between(-9.0, 9.0), sequence.between(-1.0, 1.0));
        let Some((side, s, arrival, nearest)) = device.crossing([phase / PI, z, velocity], None) else {
            continue;
        };
        if nearest < 1e-4 || arrival.abs() < 0.02 {
            continue;
        }
        compared += 1;
        let start = Start::in_flight(phase, z, velocity);
        let mut motions = vec![device.motion::<f64>()];
        if index % 2 == 0 {
            // the paper's forcing as it is, and as the first of several harmonics
            let d = device.d;
            motions.push(match d {
                Some(d) => Motion::new(device.g, d, device.r[0], device.r[1]).expect("a motion"),
                None => Motion::one_wall(device.g, device.r[0]).expect("a motion"),
            });
        }
        for motion in motions {
            let mut simulation = Simulation::new(&motion, &start).with_growth();
            let first = simulation.next().expect("an impact");
            assert_eq!((first.kind, first.side), (Kind::Impact, side), "{device:?} {start:?}");
            let late = first.time(&start.phase) - s;
            assert!(late.abs() < 1e-11 / arrival.abs(), "{device:?} {start:?} {late:e}");
            let growth = simulation.growth().expect("followed");
            assert!(
                growth.holds() && growth.phase_error() < 1e-12 / arrival.abs(),
                "{device:?} {start:?}"
            );
            let mut trajectory = Trajectory::in_flight(motion, phase, z, velocity, std::iter::once(first));
            for part in [0.0, 0.3, 0.9, 1.0 - 1e-9] {
                let at = trajectory.at(&(part * s)).expect("in flight");
                let [place, speed] = device.state([phase / PI, z, velocity], part * s);
                assert!(
                    (at.z - place).abs() < 1e-13 && (at.zdot - speed).abs() < 1e-12,
                    "{device:?} {part}"
                );
            }
        }
    }
    assert!(compared > 90, "{compared}");
}

#[test]
fn enclosures_hold_what_sixty_digits_say() {
    let mut sequence = Sequence::new(4903);
    let mut compared = 0;
    for index in 0..24 {
        let device = Device::drawn(&mut sequence, index % 3 > 0);
        let start = match index % 2 {
            0 => Start::impact(Side::Bottom, sequence.between(0.0, TAU), sequence.between(0.2, 1.5)),
            _ => {
                let z = device.d.map_or(-0.3, |d| 0.2 * d);
                Start::in_flight(sequence.between(0.0, TAU), z, sequence.between(-1.0, 1.0))
            }
        };
        let exact = Simulation::new(
            &device.motion::<Wide<60>>(),
            &start.convert(|value| Wide::from_f64(*value)),
        );
        let enclosed = Enclosure::new(&device.motion(), &start.convert(|value| Interval::point(*value)));
        for (exact, enclosed) in exact.take(12).zip(enclosed) {
            let enclosed: Event<Interval<f64>> = enclosed;
            if enclosed.kind == Kind::Undecided {
                break;
            }
            compared += 1;
            assert_eq!((exact.kind, exact.side), (enclosed.kind, enclosed.side), "{device:?}");
            let angle = (exact.turns - enclosed.turns) as f64 * TAU;
            for (value, told) in [(&exact.phase, &enclosed.phase), (&exact.velocity, &enclosed.velocity)] {
                let value = value.to_f64();
                let shift = if std::ptr::eq(told, &enclosed.phase) {
                    angle
                } else {
                    0.0
                };
                let (low, high) = (told.low() - shift, told.high() - shift);
                assert!(
                    low.next_down() <= value && value <= high.next_up(),
                    "{device:?} {value} {told}"
                );
            }
        }
    }
    assert!(compared > 120, "{compared}");
}

#[test]
fn a_ball_rests_until_f_plus_g_lets_it_go() {
    let mut sequence = Sequence::new(4904);
    let mut released = 0;
    for index in 0..60 {
        let mut device = Device::drawn(&mut sequence, index % 2 == 0);
        device.r = [0.3 * sequence.between(0.0, 1.0), 0.3];
        let start = Start::impact(Side::Bottom, sequence.between(0.0, TAU), 0.4);
        let events: Vec<Event<f64>> = Widening::new(&device.motion(), &start).take(60).collect();
        for pair in events.windows(2) {
            let [rest, release] = pair else { continue };
            if rest.kind != Kind::Rest {
                continue;
            }
            assert_eq!((release.kind, release.side), (Kind::Release, rest.side), "{device:?}");
            let away = |phase: f64| -rest.side.sign() * device.push(phase);
            assert!(device.push(release.phase).abs() < 1e-12, "{device:?} {release:?}");
            let angle = TAU * (release.turns - rest.turns) as f64 + release.phase - rest.phase;
            assert!((0.0..=TAU).contains(&angle), "{device:?} {rest:?} {release:?}");
            // pressed all the while, and pulled off behind
            for part in 1..100 {
                let phase = rest.phase + angle * f64::from(part) / 100.0;
                assert!(away(phase) < 1e-9, "{device:?} {rest:?} {release:?}");
            }
            assert!(away(release.phase + 1e-4) > 0.0, "{device:?} {release:?}");
            released += 1;
        }
    }
    assert!(released > 100, "{released}");
}

#[test]
fn a_plastic_impact_leaves_the_ball_at_rest_or_takes_it_off_at_once() {
    let motion = Motion::new(0.122_01, 0.3, 0.0, 0.5).expect("a motion");
    let push = |phase: f64| phase.cos() + 0.122_01;
    let mut seen = [0, 0];
    for index in 0..40 {
        let start = Start::impact(Side::Bottom, 0.157 * f64::from(index), 0.6);
        let events: Vec<Event<f64>> = Simulation::new(&motion, &start).take(30).collect();
        let enclosed: Vec<_> = Enclosure::new(
            &motion.convert(|value| Interval::point(*value)).expect("a motion"),
            &start.convert(|value| Interval::point(*value)),
        )
        .take(30)
        .take_while(|event: &Event<Interval<f64>>| event.kind != Kind::Undecided)
        .collect();
        for (one, other) in events.iter().zip(&enclosed) {
            assert_eq!(
                (one.kind, one.side, one.turns),
                (other.kind, other.side, other.turns),
                "{index}"
            );
        }
        assert!(enclosed.len() > 5, "{index} {}", enclosed.len());
        for pair in events.windows(2) {
            let [impact, next] = pair else { continue };
            if impact.kind != Kind::Impact || impact.side != Side::Bottom {
                continue;
            }
            if push(impact.phase) > 0.0 {
                seen[0] += 1;
                assert_eq!((next.kind, next.phase), (Kind::Rest, impact.phase));
            } else {
                seen[1] += 1;
                assert_eq!(next.kind, Kind::Impact);
                let device = Device {
                    g: 0.122_01,
                    d: Some(0.3),
                    r: [0.0, 0.5],
                    cosines: vec![1.0],
                    sines: Vec::new(),
                };
                let crossing = device.crossing([time(impact), 0.15, 0.0], Some(Side::Bottom));
                let (side, s, _, _) = crossing.expect("a wall");
                assert!(
                    next.side == side && (time(next) - time(impact) - s).abs() < 1e-9,
                    "{impact:?} {next:?}"
                );
            }
        }
    }
    assert!(seen[0] > 50 && seen[1] > 5, "{seen:?}");
}

#[test]
fn in_lanes_such_motions_are_what_they_are_alone() {
    let mut sequence = Sequence::new(4905);
    let drawn: Vec<(Motion<f64>, Start<f64>)> = (0..40)
        .map(|index| {
            let device = Device::drawn(&mut sequence, index % 2 == 0);
            let phase = sequence.between(0.0, TAU);
            let start = match index % 4 {
                3 => Start::in_flight(phase, -0.01, 0.3),
                _ => Start::impact(Side::Bottom, phase, 0.5),
            };
            (device.motion(), start)
        })
        .collect();
    let mut together = vec![Vec::new(); drawn.len()];
    let motions = drawn.iter().enumerate();
    let motions = motions.map(|(index, (motion, start))| (Widening::new(motion, start), (index, 30)));
    let each = |(index, left): &mut (usize, u32), event: &Event<f64>, _: &Grown| {
        together[*index].push(event.clone());
        *left -= 1;
        *left > 0
    };
    in_lanes(motions, true, each, |_, _| {});
    for ((motion, start), events) in drawn.iter().zip(together) {
        let alone: Vec<Event<f64>> = Widening::new(motion, start).take(events.len()).collect();
        assert_eq!(alone, events);
    }
}

#[test]
fn wider_numbers_hold_more_impacts() {
    let device = Device {
        g: 0.12,
        d: Some(0.3),
        r: [0.9, 0.9],
        cosines: vec![1.0, 0.0, -1.0 / 3.0],
        sines: vec![0.2],
    };
    let start = Start::in_flight(0.3, 0.05, 0.4);
    let motion: Motion<f64> = device.motion();
    let extent = Extent {
        impacts: 120,
        until: f64::INFINITY,
        digits: 12,
        proved: false,
    };
    let told: Vec<_> = rows(&motion, &start, &extent, Rung::Double).expect("rows").collect();
    assert_eq!(told.len(), 120);
    assert!(
        told.iter().all(|row| row.as_ref().is_ok_and(|row| row.digits >= 12)),
        "{told:?}"
    );
    let proved = Extent {
        impacts: 40,
        proved: true,
        ..extent
    };
    let enclosed = rows(&motion, &start, &proved, Rung::Double).expect("rows");
    let mut count = 0;
    for (row, free) in enclosed.zip(&told) {
        let (row, free) = (row.expect("a row"), free.as_ref().expect("a row"));
        let [time, phase, velocity] = row.bounds.expect("bounds");
        let apart = [
            row.time - free.time,
            row.phase - free.phase,
            row.velocity - free.velocity,
        ];
        assert!(
            apart
                .iter()
                .zip([time, phase, velocity])
                .all(|(apart, bound)| apart.abs() <= bound + 1e-11)
        );
        count += usize::from(row.digits >= 10);
    }
    assert!(count > 30, "{count}");
}

#[test]
fn a_ball_that_starts_closer_to_a_wall_than_a_number_tells_is_left_to_a_wider_one() {
    // 1e-18 off the bottom and moving towards it so slowly that it turns before
    let motion = Motion::new(-0.3315, 0.1839, 0.82, 0.66).expect("a motion");
    let nearest = 0.5 * 0.1839_f64;
    let start = Start::in_flight(3.843_155_921_538_758, nearest.next_down(), 1e-9);
    let mut simulation = Simulation::new(&motion, &start);
    assert_eq!(simulation.next().map(|event| event.kind), Some(Kind::Undecided));
    let wide = motion.convert(|value| Wide::<60>::from_f64(*value)).expect("a motion");
    let mut exact = Simulation::new(&wide, &start.convert(|value| Wide::from_f64(*value)));
    assert_eq!(exact.next().map(|event| event.kind), Some(Kind::Impact));
}

#[test]
fn a_pressed_ball_without_speed_rests_at_once_even_where_nothing_is_lost() {
    let motion = Motion::new(0.122_01, 0.3, 1.0, 1.0).expect("a motion");
    let start = Start::impact(Side::Bottom, 0.3, 0.0);
    let mut enclosed = Enclosure::new(
        &motion.convert(|value| Interval::point(*value)).expect("a motion"),
        &start.convert(|value| Interval::point(*value)),
    );
    let kinds: Vec<Kind> = (0..3)
        .filter_map(|_| enclosed.next())
        .map(|event: Event<Interval<f64>>| event.kind)
        .collect();
    assert_eq!(kinds, [Kind::Impact, Kind::Rest, Kind::Release]);
}

#[test]
fn an_enclosure_holds_for_every_forcing_of_wide_intervals() {
    // the second amplitude is anything in [-1, 1], of middle 0
    let wide = |value: f64, radius: f64| Interval::new(value - radius, value + radius);
    let forcing = Forcing::periodic(Interval::point(2.0), &[wide(1.0, 0.0), wide(0.0, 1.0)], &[]).expect("a forcing");
    let [g, d, r] = [0.1, 0.4, 0.6].map(Interval::point);
    let motion = Motion::new(g, d, r, r)
        .and_then(|motion| motion.with_forcing(forcing))
        .expect("a motion");
    for velocity in [0.01, 0.05, 0.3, 20.0] {
        let start = Start::impact(Side::Bottom, 0.0, velocity);
        let first = Enclosure::new(&motion, &start.convert(|value| Interval::point(*value))).nth(1);
        let first: Event<Interval<f64>> = first.expect("an event");
        for part in [-1.0, -0.5, 0.3, 1.0] {
            let device = Device {
                g: 0.1,
                d: Some(0.4),
                r: [0.6, 0.6],
                cosines: vec![1.0, part],
                sines: Vec::new(),
            };
            let event = Simulation::new(&device.motion::<f64>(), &start)
                .nth(1)
                .expect("an event");
            let (told, held) = (time(&event), 2.0 * first.turns as f64 + first.phase.low() / PI);
            match first.kind {
                Kind::Undecided => assert!(told >= held - 1e-12, "{velocity} {part}: {told} {held}"),
                _ => assert!((first.kind, first.side) == (event.kind, event.side) && told >= held - 1e-12),
            }
        }
    }
}
