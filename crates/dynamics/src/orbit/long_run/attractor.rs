//! What a motion comes to: the word and the forcing periods of its last impacts.

use crate::impact::{Event, Kind};
use crate::model::{MotionError, Parameters, Side};
use crate::orbit::long_run::repetition::{repeated, start};
use crate::orbit::long_run::resting::RestingCycle;
use crate::orbit::long_run::symbols::{self, Symbol, symbols};
use crate::orbit::options::OrbitOptions;
use std::collections::VecDeque;
use std::f64::consts::TAU;

/// The most symbols of a word that is written out; of a longer one its length is told.
pub const LONGEST_WRITTEN: usize = 10_000;

/// The most symbols that are held at once.
const HELD: usize = 1_000_000;

/// Impacts a cycle apart that differ by no more, in phase and in velocity, repeat but for rounding.
const REPEATED: f64 = 1e-14;

/// A motion that repeats itself, or rests for ever.
#[derive(Clone, Debug, PartialEq)]
pub struct Attractor {
    /// The impacts of one cycle by wall, written as a [`Word`](crate::orbit::Word) is: from a bottom impact that follows a top
    /// one; of several such, the fastest first; on one wall, from the fastest. Without a rest it has at most
    /// [`longest_word`](OrbitOptions::longest_word) symbols; of more than [`LONGEST_WRITTEN`] it only says how many there are. A chatter that comes to
    /// rest is infinitely many impacts and one letter with a star: `BT*` is a bottom impact, then a chatter that ends at
    /// rest on the top, and a release from there.
    pub word: String,
    /// The forcing periods of one cycle; none where the ball rests for ever (`B*`, `T*`).
    pub periods: Option<i64>,
    /// The impacts of the last cycle in word order, those of a chatter as far as they are listed; none where the ball
    /// rests for ever, or where there is [`Attractor::resting`].
    pub impacts: Vec<Event<f64>>,
    /// The cycle through a rest that is known to be one.
    pub resting: Option<RestingCycle>,
}

impl Attractor {
    /// What a motion has come to by its last events; `None` where they do not repeat: the motion is chaotic, has not
    /// settled, or an undecided contact ended it.
    ///
    /// The least number of impacts that repeats: two more cycles before the last must be the same to [`settled`](OrbitOptions::settled). Of a
    /// cycle with a rest one is enough, for a rest forgets what was before: the release that follows has its phase from
    /// g alone. `events` are the last ones of a motion in order, impacts, rests and releases; a rest as the last of all
    /// is one that nothing releases.
    pub fn of(events: &[Event<f64>], options: &OrbitOptions) -> Option<Self> {
        let last = events.last()?;
        match last.kind {
            Kind::Undecided => return None,
            Kind::Rest => return Some(Self::at_rest(last.side)),
            Kind::Impact | Kind::Release => {}
        }
        let symbols = symbols(events);
        // A chatter that the list cuts off is no letter yet: then the last rest is the end.
        let rested = symbols
            .iter()
            .rposition(|letter| letter.rests)
            .map_or(0, |last| last + 1);
        let ends = [symbols.len(), rested];
        let (cycle, periods) = ends.iter().find_map(|end| repeated(&symbols[..*end], options))?;
        let first = start(cycle);
        let rotated = || cycle[first..].iter().chain(&cycle[..first]);
        let impacts_of = |letter: &Symbol, turns: i64| {
            let of_letter = &events[letter.from..letter.to];
            let impacts = of_letter.iter().filter(|event| event.kind == Kind::Impact);
            let later = impacts.map(move |event| Event {
                turns: event.turns + turns,
                ..event.clone()
            });
            later.collect::<Vec<_>>()
        };
        let impacts = cycle[first..]
            .iter()
            .flat_map(|letter| impacts_of(letter, 0))
            // those before the first one come again a cycle later
            .chain(cycle[..first].iter().flat_map(|letter| impacts_of(letter, periods)))
            .collect();
        Some(Self {
            word: rotated().map(Symbol::text).collect(),
            periods: Some(periods),
            resting: None,
            impacts,
        })
    }

    /// A cycle through a rest; its impacts are shown by [`RestingCycle::visit`].
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn through(parameters: &impl Parameters, cycle: RestingCycle) -> Result<Self, MotionError> {
        let mut symbols = Vec::new();
        let mut index = 0;
        cycle.visit(parameters, |event| {
            if symbols.len() < HELD {
                symbols::add(&mut symbols, index, event);
            }
            index += 1;
        })?;
        let word = match symbols.len() {
            HELD.. => format!("more than {HELD} symbols"),
            length if length > LONGEST_WRITTEN => format!("{length} symbols"),
            _ => {
                let (before, after) = symbols.split_at(start(&symbols));
                after.iter().chain(before).map(Symbol::text).collect()
            }
        };
        Ok(Self {
            word,
            periods: Some(cycle.periods),
            impacts: Vec::new(),
            resting: Some(cycle),
        })
    }

    /// The same cycle, followed on along the `events` after it until it repeats to rounding, or for
    /// [`settling_impacts`](OrbitOptions::settling_impacts): a
    /// motion that comes in slowly is told by [`settled`](OrbitOptions::settled) long before it is there.
    pub fn settled_further(mut self, events: impl Iterator<Item = Event<f64>>, options: &OrbitOptions) -> Self {
        let length = self.impacts.len();
        if self.rests() || length == 0 {
            return self;
        }
        let mut last: VecDeque<Event<f64>> = VecDeque::with_capacity(2 * length);
        for event in events.take(options.settling_impacts as usize) {
            if event.kind != Kind::Impact {
                return self;
            }
            if last.len() == 2 * length {
                last.pop_front();
            }
            last.push_back(event);
            let mut pairs = last.iter().zip(last.iter().skip(length));
            if last.len() == 2 * length && pairs.all(|(before, after)| is_same(before, after)) {
                break;
            }
        }
        // the window that starts where the word does
        let first = &self.impacts[0];
        let apart = |event: &Event<f64>| (event.velocity - first.velocity).abs() + (event.phase - first.phase).abs();
        let starts = 0..(last.len() + 1).saturating_sub(length).min(length);
        if let Some(first) = starts.min_by(|one, other| apart(&last[*one]).total_cmp(&apart(&last[*other]))) {
            self.impacts = last.range(first..first + length).cloned().collect();
        }
        self
    }

    /// Whether the ball rests in each cycle, or for ever.
    pub fn rests(&self) -> bool {
        self.word.contains('*') || self.resting.is_some()
    }

    fn at_rest(side: Side) -> Self {
        let text = match side {
            Side::Bottom => "B*",
            Side::Top => "T*",
        };
        Self {
            word: text.to_owned(),
            periods: None,
            impacts: Vec::new(),
            resting: None,
        }
    }
}

/// Whether two impacts a cycle apart are the same to a few dozen roundings.
fn is_same(before: &Event<f64>, after: &Event<f64>) -> bool {
    let apart = (after.phase - before.phase).abs();
    apart.min((TAU - apart).abs()) <= REPEATED && (after.velocity - before.velocity).abs() <= REPEATED
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// An impact: wall, time in forcing periods, speed.
    type Told = (char, f64, f64);

    fn impact((wall, time, speed): Told) -> Event<f64> {
        let side = if wall == 'B' { Side::Bottom } else { Side::Top };
        Event {
            kind: Kind::Impact,
            side,
            turns: time.floor() as i64,
            phase: (time - time.floor()) * TAU,
            velocity: side.signed(speed),
        }
    }

    fn at(kind: Kind, wall: char, time: f64) -> Event<f64> {
        Event {
            kind,
            ..impact((wall, time, 0.0))
        }
    }

    /// `count` impacts of the motion that repeats `cycle` every `periods`, from impact `first` of it on.
    fn repeating(cycle: &[Told], periods: i64, first: usize, count: usize) -> Vec<Event<f64>> {
        let told = (first..first + count).map(|index| {
            let (wall, time, speed) = cycle[index % cycle.len()];
            (wall, time + (index / cycle.len()) as f64 * periods as f64, speed)
        });
        told.map(impact).collect()
    }

    fn found(events: &[Event<f64>]) -> Option<(String, Option<i64>, usize)> {
        Attractor::of(events, &OrbitOptions::DEFAULT).map(|found| (found.word, found.periods, found.impacts.len()))
    }

    fn word(text: &str, periods: i64, impacts: usize) -> Option<(String, Option<i64>, usize)> {
        Some((text.to_owned(), Some(periods), impacts))
    }

    #[test]
    fn a_cycle_is_followed_on_to_rounding() {
        let coming = |index: usize| 1e-9 * 0.99_f64.powi(index as i32);
        let motion = |from: usize| {
            (from..).flat_map(move |index| {
                [
                    ('B', index as f64 + 0.2, 0.7 + coming(index)),
                    ('T', index as f64 + 0.7, 0.5),
                ]
                .map(impact)
            })
        };
        let events: Vec<Event<f64>> = motion(0).take(60).collect();
        let found = Attractor::of(&events, &OrbitOptions::DEFAULT)
            .expect("a cycle")
            .settled_further(motion(30), &OrbitOptions::DEFAULT);
        assert!(
            (found.impacts[0].velocity - 0.7).abs() < 2e-12,
            "{}",
            found.impacts[0].velocity
        );
        assert_eq!((found.impacts.len(), found.impacts[1].side), (2, Side::Top));
    }

    #[test]
    fn a_motion_that_turns_over_as_it_settles_has_not_doubled() {
        let turning = |index: usize, size: f64| if index.is_multiple_of(2) { size } else { -size };
        let motion = |sizes: &dyn Fn(usize) -> f64| -> Vec<Event<f64>> {
            (0..60)
                .flat_map(|index| {
                    let apart = turning(index, sizes(index));
                    [('B', index as f64 + 0.2, 0.7 + apart), ('T', index as f64 + 0.7, 0.5)]
                })
                .map(impact)
                .collect()
        };
        assert_eq!(
            found(&motion(&|index| 1e-8 * 0.97_f64.powi(index as i32))),
            word("BT", 1, 2)
        );
        assert_eq!(found(&motion(&|_| 1e-5)), word("BTBT", 2, 4));
    }

    #[test]
    fn the_least_cycle_that_comes_three_times_is_the_word() {
        let pair = [('B', 0.1, 0.7), ('T', 0.7, 0.5)];
        assert_eq!(found(&repeating(&pair, 1, 0, 6)), word("BT", 1, 2));
        assert_eq!(found(&repeating(&pair, 1, 0, 5)), None);
        assert_eq!(found(&repeating(&pair, 3, 1, 20)), word("BT", 3, 2));
        let three = [('T', 0.2, 0.5), ('T', 0.5, 0.1), ('B', 0.9, 0.7)];
        assert_eq!(found(&repeating(&three, 1, 0, 60)), word("BTT", 1, 3));
        let doubled = [
            ('B', 0.1, 0.7),
            ('T', 0.7, 0.5),
            ('B', 1.1, 0.7 + 1e-6),
            ('T', 1.7, 0.5),
        ];
        assert_eq!(found(&repeating(&doubled, 2, 0, 60)), word("BTBT", 2, 4));
        assert_eq!(found(&repeating(&[('T', 0.0, 0.3)], 1, 0, 3)), word("T", 1, 1));
        assert_eq!(found(&[]), None);
    }

    #[test]
    fn the_impacts_are_those_of_the_last_cycle_in_word_order() {
        let cycle = [
            ('B', 0.1, 0.3),
            ('T', 0.7, 0.5),
            ('B', 1.1, 0.7),
            ('B', 1.5, 0.1),
            ('T', 1.9, 0.2),
        ];
        let found = Attractor::of(&repeating(&cycle, 2, 3, 40), &OrbitOptions::DEFAULT).expect("a cycle");
        assert_eq!((found.word.as_str(), found.periods), ("BBTBT", Some(2)));
        let speeds: Vec<f64> = found.impacts.iter().map(|event| event.velocity.abs()).collect();
        assert_eq!(speeds, [0.7, 0.1, 0.2, 0.3, 0.5]);
        let times: Vec<f64> = found.impacts.iter().map(|event| event.time(&0.0)).collect();
        assert!(times.is_sorted() && times[4] - times[0] < 4.0, "{times:?}");
    }

    #[test]
    fn a_phase_that_rounding_moves_across_a_whole_turn_is_the_same_phase() {
        let mut events = repeating(&[('B', 0.0, 0.7), ('T', 0.5, 0.5)], 1, 0, 12);
        let early = &mut events[10];
        (early.turns, early.phase) = (early.turns - 1, TAU.next_down());
        assert_eq!(found(&events), word("BT", 1, 2));
    }

    /// A bottom impact, a chatter on the top of as many impacts as are asked for, rest and release; again and again.
    fn chattering(counts: &[usize]) -> Vec<Event<f64>> {
        let mut events = Vec::new();
        for (turn, &count) in counts.iter().enumerate() {
            let turn = turn as f64;
            events.push(impact(('B', turn + 0.1, 0.6)));
            let chatter = (0..count).map(|index| {
                let part = 0.3_f64.powi(index as i32);
                impact(('T', turn + 0.8 - 0.2 * part, 0.5 * part))
            });
            events.extend(chatter);
            events.push(at(Kind::Rest, 'T', turn + 0.8));
            events.push(at(Kind::Release, 'T', turn + 0.9));
        }
        events
    }

    #[test]
    fn a_chatter_that_comes_to_rest_is_one_letter_with_a_star() {
        // the last impact that is listed may come to lie on either side of the limit
        let events = chattering(&[12, 11, 12]);
        assert_eq!(found(&events), word("BT*", 1, 13));
        // cut off at any impact after two whole cycles and the first letter of the next
        let next = chattering(&[12; 4]);
        let ends = (events.len()..next.len()).filter(|end| next[end - 1].kind == Kind::Impact);
        for end in ends {
            assert_eq!(found(&next[..end]), word("BT*", 1, 13), "{end}");
        }
        assert_eq!(found(&chattering(&[12])), None);
    }

    #[test]
    fn a_ball_that_is_not_released_rests_for_ever() {
        let mut events = chattering(&[12, 12]);
        events.pop();
        assert_eq!(found(&events), Some(("T*".to_owned(), None, 0)));
        assert_eq!(found(&[at(Kind::Rest, 'B', 0.2)]), Some(("B*".to_owned(), None, 0)));
        let returning: Vec<_> = (0..2)
            .flat_map(|turn| {
                let turn = f64::from(turn);
                [
                    impact(('B', turn + 0.1, 0.2)),
                    at(Kind::Rest, 'B', turn + 0.3),
                    at(Kind::Release, 'B', turn + 0.8),
                ]
            })
            .collect();
        assert_eq!(found(&returning), word("B*", 1, 1));
    }

    #[test]
    fn after_an_undecided_contact_nothing_is_known() {
        let mut events = repeating(&[('B', 0.1, 0.7), ('T', 0.7, 0.5)], 1, 0, 60);
        events.push(at(Kind::Undecided, 'T', 31.0));
        assert_eq!(found(&events), None);
    }

    /// Cycles of up to 12 impacts in up to 3 periods, times in order.
    fn cycles() -> impl Strategy<Value = (Vec<Told>, i64)> {
        let letter = (prop::bool::ANY, 0.02_f64..1.0, 0.05_f64..1.0);
        (prop::collection::vec(letter, 1..12), 1_i64..4).prop_map(|(symbols, periods)| {
            let whole: f64 = symbols.iter().map(|(_, step, _)| step).sum();
            let mut time = 0.0;
            let cycle = symbols.iter().map(|&(bottom, step, speed)| {
                let told = (if bottom { 'B' } else { 'T' }, time, speed);
                time += step / whole * periods as f64;
                told
            });
            (cycle.collect(), periods)
        })
    }

    proptest! {
        #[test]
        fn every_rotation_of_a_cycle_has_the_same_word_and_impacts((cycle, periods) in cycles(), first in 0_usize..12) {
            let [straight, rotated] = [0, first].map(|first| Attractor::of(&repeating(&cycle, periods, first, 60), &OrbitOptions::DEFAULT));
            let (straight, rotated) = (straight.expect("a cycle"), rotated.expect("a cycle"));
            prop_assert_eq!(straight.periods, Some(periods));
            prop_assert_eq!(straight.word.len(), cycle.len());
            prop_assert_eq!((&straight.word, straight.periods), (&rotated.word, rotated.periods));
            for (one, other) in straight.impacts.iter().zip(&rotated.impacts) {
                prop_assert_eq!((one.side, one.velocity), (other.side, other.velocity));
            }
            let mixed = straight.word.contains('B') && straight.word.contains('T');
            prop_assert!(!mixed || (straight.word.starts_with('B') && straight.word.ends_with('T')));
        }

        #[test]
        fn noise_below_the_tolerance_changes_nothing_and_noise_above_it_leaves_no_word(
            (cycle, periods) in cycles(), seed in 0_u64..1000, below: bool
        ) {
            let mut events = repeating(&cycle, periods, 0, 60);
            let size = if below { 1e-12 } else { 1e-6 };
            for (index, event) in events.iter_mut().enumerate() {
                let noise = numbers::mix(seed ^ index as u64) as f64 / u64::MAX as f64;
                event.velocity += size * (noise - 0.5);
            }
            let word = Attractor::of(&events, &OrbitOptions::DEFAULT).map(|found| found.word.len());
            prop_assert_eq!(word, below.then_some(cycle.len()));
        }

        #[test]
        fn the_mirror_image_exchanges_the_walls((cycle, periods) in cycles()) {
            let events = repeating(&cycle, periods, 0, 60);
            let mirrored: Vec<_> = events.iter().map(|event| Event {
                side: event.side.opposite(),
                velocity: -event.velocity,
                ..event.clone()
            }).collect();
            let [word, image] = [events, mirrored].map(|events| Attractor::of(&events, &OrbitOptions::DEFAULT).expect("a cycle").word);
            let exchanged: String = word.chars().map(|wall| if wall == 'B' { 'T' } else { 'B' }).collect();
            prop_assert!(image.len() == word.len() && image.repeat(2).contains(&exchanged), "{} {}", word, image);
        }
    }
}
