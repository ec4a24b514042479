//! Curves of bifurcations of motions of any word over two parameters, from bifurcations on lines across their
//! rectangle.

use crate::model::{Motion, MotionError, Side};
use crate::orbit::bifurcation::point::BifurcationPoint;
use crate::orbit::bifurcation::words::{ConditionedWord, Listing, conditioned};
use crate::orbit::continuation::branch::{Branch, BranchEnd, BranchPoint, Continued, TOGETHER};
use crate::orbit::continuation::curve::CurveEquations;
use crate::orbit::continuation::extended_system::{ExtendedSystem, parameter_at, place_of};
use crate::orbit::continuation::segment::CertifiedSegment;
use crate::orbit::continuation::test_functions::{TestFunctions, WALLS};
use crate::orbit::curves::follow::CurvePoint;
use crate::orbit::curves::queue::{CurveQueue, PlaneCurves, ROOM, Start, scanned_lines};
use crate::orbit::curves::special_points::SpecialPoint;
use crate::orbit::equations::conditions::{BifurcationCondition, BifurcationKind};
use crate::orbit::equations::duals::rows_by_duals;
use crate::orbit::equations::words::WordEquations;
use crate::orbit::family::{Family, ParameterPlane};
use crate::orbit::options::OrbitOptions;
use crate::orbit::parallel::each;
use crate::orbit::solve::starts::{brought_near, listed_from};
use crate::orbit::word::Word;
use crate::orbit::word_branches::WordBranches;
use numbers::{Analytic, Interval};
use std::f64::consts::PI;
use std::ops::Range;

/// The motions of a plane of parameters along one of them.
struct Along<'a, P> {
    plane: &'a P,
    /// The parameter that is held, 0 or 1, and its value.
    held: usize,
    value: f64,
}

impl<P: ParameterPlane> Family for Along<'_, P> {
    fn motion_at<T: Analytic>(&self, parameter: &T) -> Result<Motion<T>, MotionError> {
        let value = T::from_f64(self.value);
        match self.held {
            0 => self.plane.motion_at([&value, parameter]),
            _ => self.plane.motion_at([parameter, &value]),
        }
    }

    fn is_symmetric(&self) -> bool {
        self.plane.is_symmetric()
    }
}

/// The equations of a word and a condition as those of a curve, in the phases, the places of both parameters in their
/// ranges and, for a touch, its time.
struct WordCurve<'a, P> {
    plane: &'a P,
    word: Word,
    periods: u32,
    condition: BifurcationCondition,
    options: OrbitOptions,
}

impl<P: ParameterPlane> WordCurve<'_, P> {
    fn at<T: Analytic>(&self, places: &[T]) -> Option<WordEquations<T>> {
        let [x, y] = self.plane.ranges();
        let (x, y) = (parameter_at(&x, &places[0]), parameter_at(&y, &places[1]));
        Some(WordEquations {
            motion: self.plane.motion_at([&x, &y]).ok()?,
            word: self.word.clone(),
            periods: self.periods,
        })
    }

    fn equations<T: Analytic>(&self, at: &[T]) -> Option<Vec<T>> {
        let (phases, rest) = at.split_at(self.word.impacts());
        conditioned(&self.at(rest)?, self.condition, phases, rest.last()?)
    }

    /// Returns the coordinate along which a curve runs least: the parameter that is held where a point of it is proved.
    fn held(&self, node: &BranchPoint) -> usize {
        let [x, y] = [0, 1].map(|i| node.tangent[self.word.impacts() + i].abs());
        usize::from(y > x)
    }

    /// Locates the bifurcation at a node, proved with one of the parameters held; and the box in which it is, if it is
    /// proved, in the coordinates of the curve.
    fn located(&self, node: &BranchPoint) -> Option<(CurvePoint, Option<Vec<Interval<f64>>>)> {
        let count = self.word.impacts();
        let ranges = self.plane.ranges();
        let held = self.held(node);
        let [x, y] = [0, 1].map(|i| parameter_at(&ranges[i], &node.point[count + i]));
        let (value, other) = if held == 0 { (x, y) } else { (y, x) };
        let plane = self.plane;
        let extended = ExtendedSystem {
            family: Along { plane, held, value },
            word: self.word.clone(),
            periods: self.periods,
            range: ranges[1 - held],
            options: self.options,
        };
        let system = ConditionedWord {
            extended: &extended,
            condition: self.condition,
            listing: Listing::Plain,
        };
        let mut point = node.point.clone();
        point.remove(count + held);
        point[count] = other;
        let (mut motion, cell) = system.enclosed_at(&system.solved(&point).unwrap_or(point))?;
        let found = motion.parameter;
        let [x, y] = if held == 0 { [value, found] } else { [found, value] };
        motion.parameter = x;
        let place = |i: usize, parameter: Interval<f64>| {
            let low = Interval::point(ranges[i].low());
            (parameter - low) / (parameter_at(&ranges[i], &Interval::point(1.0)) - low)
        };
        let cell = cell.map(|mut cell| {
            cell[count] = place(1 - held, cell[count]);
            cell.insert(count + held, place(held, Interval::point(value)));
            cell
        });
        let point = CurvePoint {
            special: SpecialPoint::Step,
            motion,
            y,
            has_clearance: true,
            is_joined: None,
        };
        Some((point, cell))
    }

    /// Returns the points of a branch, in order.
    fn points(&self, branch: &Branch) -> Vec<CurvePoint> {
        let last = branch.nodes.len() - 1;
        let mut points: Vec<CurvePoint> = Vec::new();
        let mut before: Option<(&[f64], f64)> = None;
        for (index, node) in branch.nodes.iter().enumerate() {
            if self.ends(node) == Some(BranchEnd::Slow) {
                continue;
            }
            let Some((mut point, cell)) = self.located(node) else {
                continue;
            };
            // a point that is proved, and how far from it the node may be
            let here = cell.map(|cell| {
                let sides = cell.iter().zip(&node.point);
                let off = sides.map(|(side, at)| (*side - Interval::point(*at)).magnitude());
                (node.point.as_slice(), off.fold(0.0, f64::max))
            });
            if !points.is_empty() {
                let segment = index.checked_sub(1).and_then(|piece| branch.segments[piece].as_ref());
                let ends = here.zip(before);
                let holds = |segment: &CertifiedSegment, (point, room)| segment.holds(point, room);
                let joins = |(segment, (here, before))| holds(segment, here) && holds(segment, before);
                point.is_joined = Some(segment.zip(ends).is_some_and(joins));
            }
            let end = [(0, branch.ends[0]), (last, branch.ends[1])]
                .into_iter()
                .find(|(at, _)| *at == index);
            point.special = match end {
                Some((_, BranchEnd::Range)) => SpecialPoint::Edge,
                Some((at, BranchEnd::Closed)) if at > 0 => SpecialPoint::Closed,
                Some((_, BranchEnd::Lost | BranchEnd::Slow)) => SpecialPoint::Lost,
                _ => SpecialPoint::Step,
            };
            before = here;
            points.push(point);
        }
        points
    }
}

impl<P: ParameterPlane> CurveEquations for WordCurve<'_, P> {
    fn linearised(&self, point: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        rows_by_duals(|at| self.equations(at), point)
    }

    fn values(&self, cell: &[Interval<f64>]) -> Option<Vec<Interval<f64>>> {
        self.equations(cell)
    }

    fn slopes(&self, cell: &[Interval<f64>]) -> Option<Vec<Vec<Interval<f64>>>> {
        Some(rows_by_duals(|at| self.equations(at), cell)?.1)
    }
}

impl<P: ParameterPlane> Continued for WordCurve<'_, P> {
    type Functions = TestFunctions;

    fn options(&self) -> &OrbitOptions {
        &self.options
    }

    fn places(&self) -> Range<usize> {
        self.word.impacts()..self.word.impacts() + 2
    }

    fn functions(&self, point: &[f64]) -> Option<TestFunctions> {
        let (phases, rest) = point.split_at(self.word.impacts());
        Some(TestFunctions::new(&self.at(rest)?, phases))
    }

    fn ends(&self, node: &BranchPoint) -> Option<BranchEnd> {
        let functions = &node.functions;
        let own = |impact| self.condition == BifurcationCondition::ZeroVelocity(impact);
        let mut speeds = functions.speeds.iter().enumerate();
        let moves = speeds.all(|(impact, speed)| *speed > 0.0 || own(impact));
        let touches = match (self.condition, node.point.last()) {
            (BifurcationCondition::Touch(flight, _), Some(after)) => *after > 0.0 && *after < functions.times[flight],
            _ => true,
        };
        let shortest = functions.times.iter().copied().fold(f64::INFINITY, f64::min);
        let slow = !moves || !touches || shortest <= 0.0;
        let shorter = PI * shortest < TOGETHER;
        slow.then_some(BranchEnd::Slow)
            .or(shorter.then_some(BranchEnd::Shorter))
    }

    fn images(&self, point: &[f64], near: &[f64]) -> Vec<Vec<f64>> {
        let (phases, rest) = point.split_at(self.word.impacts());
        // a rotation of the impacts leaves a condition on all of them as it is
        let is_of_all = BifurcationCondition::MULTIPLIERS.contains(&self.condition);
        let symmetries = self.word.symmetries().filter(|_| is_of_all);
        let image = |first| {
            [
                brought_near(&listed_from(phases, first, self.periods), near[0]),
                rest.to_vec(),
            ]
            .concat()
        };
        std::iter::once(0).chain(symmetries).map(image).collect()
    }
}

/// The curves of folds, period doublings and grazings of motions of a word that take so many periods, one after the
/// other, computed as they are asked for.
///
/// Along lines across the rectangle, its sides among them, the branches that a search leads to are followed
/// ([`WordBranches`]); each bifurcation on them is followed over both parameters to where its curve ends, if it lies on
/// no curve that is known. Each point is proved by itself, with one of the parameters held, and from each to the next
/// it is proved that one curve leads there. Special points between the steps are not looked for. **Completeness is not
/// claimed**: a branch on a line may be missed, and a closed curve between the lines is not seen.
pub struct WordCurves<P: ParameterPlane> {
    curves: CurvesOfWord<P>,
    queue: CurveQueue<CurvesOfWord<P>>,
}

/// The equations of the curves of one word.
struct CurvesOfWord<P> {
    plane: P,
    word: Word,
    periods: u32,
    options: OrbitOptions,
}

impl<P: ParameterPlane> WordCurves<P> {
    /// Looks for bifurcations along the sides and along `lines` - 1 lines between them, in both directions; at least 1.
    ///
    /// # Errors
    /// A parameter out of its range; `NoTop` for a word with T of motions with one wall.
    pub fn new(plane: P, word: &Word, periods: u32, lines: u32, options: &OrbitOptions) -> Result<Self, MotionError> {
        let scanned = scanned_lines(lines);
        let found = each(&scanned, |(held, index)| {
            let (line, value) = plane.line(*held, *index, lines);
            let branches = WordBranches::new(line, word, periods, plane.ranges()[1 - held], options)?;
            Ok::<_, MotionError>((value, branches.bifurcations()))
        });
        let mut curves = Self {
            curves: CurvesOfWord {
                plane,
                word: word.spelled(),
                periods,
                options: *options,
            },
            queue: CurveQueue::new(),
        };
        for ((held, _), found) in scanned.into_iter().zip(found) {
            let (value, events) = found?;
            for event in events {
                curves.queue.starts.extend(curves.curves.start(event, held, value));
            }
        }
        Ok(curves)
    }
}

impl<P: ParameterPlane> CurvesOfWord<P> {
    /// Returns the point of a curve that a bifurcation is, for those of the word itself whose curves are followed.
    fn start(&self, event: BifurcationPoint, held: usize, value: f64) -> Option<Start<Self>> {
        let (word, mut point) = event.listed()?;
        let is_twice = event.kind == BifurcationKind::PeriodDoubling && event.trace > 0.0;
        if word != self.word || is_twice || event.times.contains(&0.0) {
            return None;
        }
        let parameters = if held == 0 {
            [value, event.parameter]
        } else {
            [event.parameter, value]
        };
        let ranges = self.plane.ranges();
        point.extend((0..2).map(|i| place_of(&ranges[i], parameters[i])));
        let curve = self.curve(&BifurcationCondition::MultiplierOne);
        let functions = curve.functions(&point)?;
        let condition = match event.kind {
            BifurcationKind::PeriodDoubling => BifurcationCondition::MultiplierMinusOne,
            BifurcationKind::Fold => BifurcationCondition::MultiplierOne,
            BifurcationKind::Grazing => match functions.speeds.iter().position(|speed| speed.abs() < ROOM) {
                Some(impact) => BifurcationCondition::ZeroVelocity(impact),
                None => {
                    let (flight, wall, after) = nearest_touch(&functions)?;
                    point.push(after);
                    BifurcationCondition::Touch(flight, wall)
                }
            },
            BifurcationKind::SymmetryBreaking | BifurcationKind::NodeFocus => return None,
        };
        let found = CurvePoint {
            special: SpecialPoint::Lost,
            motion: BifurcationPoint {
                parameter: parameters[0],
                ..event
            },
            y: parameters[1],
            has_clearance: true,
            is_joined: None,
        };
        Some(Start {
            condition,
            point,
            lost: found,
        })
    }
}

impl<P: ParameterPlane> PlaneCurves for CurvesOfWord<P> {
    type Condition = BifurcationCondition;
    type Functions = TestFunctions;
    type Curve<'a>
        = WordCurve<'a, P>
    where
        P: 'a;
    /// The bifurcation itself.
    type Lost = CurvePoint;

    fn curve(&self, condition: &BifurcationCondition) -> WordCurve<'_, P> {
        WordCurve {
            plane: &self.plane,
            word: self.word.clone(),
            periods: self.periods,
            condition: *condition,
            options: self.options,
        }
    }

    fn points(&self, condition: &BifurcationCondition, branch: &Branch) -> Vec<CurvePoint> {
        self.curve(condition).points(branch)
    }

    fn lost(&self, start: &Start<Self>) -> Vec<CurvePoint> {
        vec![start.lost.clone()]
    }
}

/// Returns the flight, the wall and the time of the turning point that is nearest to a wall.
fn nearest_touch(functions: &TestFunctions) -> Option<(usize, Side, f64)> {
    let flights = (0..functions.times.len()).flat_map(|flight| WALLS.map(|wall| (flight, wall)));
    let touches = flights.filter_map(|(flight, wall)| {
        let turn = functions.nearest(flight, wall)?;
        let distance = turn.distances[usize::from(wall == Side::Top)].abs();
        Some((distance, (flight, wall, turn.after)))
    });
    let nearest = touches.min_by(|(one, _), (other, _)| one.total_cmp(other));
    nearest.map(|(_, touch)| touch)
}

impl<P: ParameterPlane> Iterator for WordCurves<P> {
    /// The points of a curve in order along it; of one that could not be followed, the bifurcation on the line, `Lost`.
    type Item = Vec<CurvePoint>;

    fn next(&mut self) -> Option<Vec<CurvePoint>> {
        self.queue.next(&self.curves)
    }
}
