//! The premises of a claim as equations over slots.

use super::compiler::{Compiler, Unwitnessed};
use super::flight::{self, Law};
use super::maps::{Maps, Step};
use super::period::{Period, period_of};
use super::program::Node;
use super::question::Question;
use super::space::{Slot, Space};
use crate::claim::{Local, Map, Statements, Vocabulary};
use crate::tex::{At, Equation, Tree};
use std::collections::BTreeSet;

/// An equation that holds.
#[derive(Clone, Debug)]
pub struct Row {
    pub node: Node,
    /// The impacts it speaks of.
    pub impacts: BTreeSet<i32>,
    /// Whether it says what a flight is, at one of its times.
    pub in_flight: bool,
}

/// Which forcing stands for the function of the claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One of many harmonics, for any function.
    Any,
    /// cos(pi t + phi).
    Cosine,
}

/// All that bears on one claim, over slots.
#[derive(Clone, Debug)]
pub struct System {
    pub space: Space,
    pub maps: Maps,
    /// What holds of times, states and parameters.
    pub rows: Vec<Row>,
    /// For each map the rows that its derivatives follow from, in the order in which they are asked.
    pub step_rows: Vec<Vec<Row>>,
    /// What holds of derivatives, traces and determinants.
    pub late: Vec<Node>,
    /// What must come out as zero besides.
    pub checks: Vec<Node>,
    /// Coefficients that are zero, because a course repeats.
    pub zeros: BTreeSet<usize>,
    /// Whether a premise says what the functions are, so that their coefficients are unknowns.
    pub shaped: bool,
    /// What must be positive, and what must not exceed 1.
    pub positive: Vec<Node>,
    pub at_most_one: Vec<Node>,
    pub questions: Vec<Question>,
    /// The time of the impact from which the flight of the claim starts, and whether the claim has a running time.
    pub start: usize,
    pub runs: bool,
    pub kind: Kind,
    /// The letter that numbers impacts.
    pub letter: String,
}

/// What premises are sorted into.
#[derive(Default)]
struct Sorted {
    rows: Vec<Node>,
    flights: Vec<Law>,
    functions: Vec<Node>,
    periods: Vec<Period>,
}

impl System {
    /// Reads premises and claim.
    ///
    /// # Errors
    /// [`Unwitnessed`] where something has no concrete form.
    pub fn new(statements: &Statements, vocabulary: &Vocabulary, kind: Kind) -> Result<Self, Unwitnessed> {
        let (mut space, first) = (Space::default(), statements.first.unwrap_or(0));
        let mut maps = Maps::default();
        {
            let mut compiler = compiler(vocabulary, &mut space, None, &[], None, first);
            maps = read_maps(vocabulary, &mut compiler, maps)?;
        }
        let mut sorted = Sorted::default();
        let (mut late, mut of_maps) = (Vec::new(), Vec::new());
        for statement in &statements.premises {
            if any(&statement.equation, &|tree| matches!(tree, Tree::Invariant { .. })) {
                of_maps.push(statement);
                continue;
            }
            let flight = if statements.claim_runs {
                first
            } else {
                statement.first.unwrap_or(first)
            };
            let mut compiler = compiler(
                vocabulary,
                &mut space,
                Some(&maps),
                &statement.locals,
                statement.first,
                flight,
            );
            let sides = [
                compiler.tree(&statement.equation.left)?,
                compiler.tree(&statement.equation.right)?,
            ];
            sorted.sort(sides, &space, &mut late);
        }
        for equation in &vocabulary.relations {
            let mut compiler = compiler(vocabulary, &mut space, Some(&maps), &[], None, first);
            let sides = [compiler.tree(&equation.left)?, compiler.tree(&equation.right)?];
            sorted.sort(sides, &space, &mut late);
        }
        for (name, shift) in &vocabulary.periods {
            let mut compiler = compiler(vocabulary, &mut space, Some(&maps), &[], None, first);
            if let Node::Value { course, level, .. } = compiler.tree(&Tree::Symbol(name.clone(), At(0)))? {
                let shift = compiler.tree(shift)?;
                sorted.periods.push(Period { course, level, shift });
            }
        }
        let mut system = Self {
            space,
            maps,
            rows: Vec::new(),
            step_rows: Vec::new(),
            late,
            checks: Vec::new(),
            zeros: BTreeSet::new(),
            shaped: false,
            positive: Vec::new(),
            at_most_one: Vec::new(),
            questions: Vec::new(),
            start: 0,
            runs: statements.claim_runs,
            kind,
            letter: vocabulary.index.clone(),
        };
        system.fill(statements, vocabulary, sorted)?;
        system.ask(statements, vocabulary, &of_maps)?;
        Ok(system)
    }

    /// The equations that come of what was sorted.
    fn fill(&mut self, statements: &Statements, vocabulary: &Vocabulary, sorted: Sorted) -> Result<(), Unwitnessed> {
        let first = statements.first.unwrap_or(0);
        let flights = {
            let mut compiler = compiler(vocabulary, &mut self.space, None, &[], None, first);
            self.start = compiler.time(first);
            flight::rows(&sorted.flights, statements.claim_runs, &mut compiler)
        };
        for period in sorted.periods {
            self.declare(period)?;
        }
        self.shaped = !sorted.functions.is_empty();
        for law in sorted.functions {
            self.rows.extend(flight::everywhere(&law, self.start));
        }
        let bound = self.bound(&sorted.rows);
        for node in sorted.rows {
            let impacts = self.impacts(&node, &bound);
            self.rows.push(Row {
                node,
                impacts,
                in_flight: false,
            });
        }
        let flights = flights.into_iter().map(|(start, node)| Row {
            node,
            impacts: BTreeSet::from([start, start + 1]),
            in_flight: true,
        });
        self.rows.extend(flights);
        self.choose_step_rows(statements.speaks_of_maps);
        self.maps.opaque = self.step_rows.iter().all(Vec::is_empty) && !statements.has_partials;
        Ok(())
    }

    /// The claim, and the premises that speak of maps.
    fn ask(
        &mut self,
        statements: &Statements,
        vocabulary: &Vocabulary,
        of_maps: &[&crate::claim::Statement],
    ) -> Result<(), Unwitnessed> {
        let first = statements.first.unwrap_or(0);
        let maps = self.maps.clone();
        for statement in of_maps {
            let locals = &statement.locals;
            let mut compiler = compiler(vocabulary, &mut self.space, Some(&maps), locals, statement.first, first);
            let left = compiler.tree(&statement.equation.left)?;
            self.late.push(left.minus(compiler.tree(&statement.equation.right)?));
        }
        for equation in &statements.claims {
            let mut compiler = compiler(
                vocabulary,
                &mut self.space,
                Some(&maps),
                &statements.locals,
                None,
                first,
            );
            let question = Question::new(equation, &mut compiler)?;
            self.questions.push(question);
        }
        for name in &vocabulary.positive {
            let mut compiler = compiler(vocabulary, &mut self.space, Some(&maps), &[], None, first);
            let node = compiler.tree(&Tree::Symbol(name.clone(), At(0)))?;
            if vocabulary.at_most_one.contains(name) {
                self.at_most_one.push(node.clone());
            }
            self.positive.push(node);
        }
        Ok(())
    }

    /// Makes a course repeat.
    fn declare(&mut self, period: Period) -> Result<(), Unwitnessed> {
        let Some(course) = self.space.courses.get_mut(period.course) else {
            return Ok(());
        };
        if course.flight.is_some() {
            return Err(Unwitnessed::Kind("a motion that repeats has no witness yet"));
        }
        self.zeros
            .extend((period.level + 1..course.powers).map(|power| course.first + power));
        match (&course.period, self.kind) {
            (None, Kind::Any) => course.period = Some(Box::new(period.shift)),
            (None, Kind::Cosine) => {
                course.period = Some(Box::new(Node::Number(2, 1)));
                let square = Node::Power(Box::new(period.shift), 2);
                self.rows.push(Row {
                    node: square.minus(Node::Number(4, 1)),
                    impacts: BTreeSet::new(),
                    in_flight: false,
                });
            }
            // A second period must agree with the first at some times.
            (Some(_), _) => self.checks.extend(period.checks()),
        }
        Ok(())
    }

    /// The impacts of a row, with those of parameters that are bound to times.
    fn impacts(&self, node: &Node, bound: &[(usize, BTreeSet<i32>)]) -> BTreeSet<i32> {
        let of = |slot: usize| -> BTreeSet<i32> {
            let own = self.space.impact(slot).into_iter();
            let bound = bound
                .iter()
                .filter(|(known, _)| *known == slot)
                .flat_map(|(_, impacts)| impacts.clone());
            own.chain(bound).collect()
        };
        node.written().into_iter().flat_map(of).collect()
    }

    /// Parameters that an equation of times and parameters alone gives, such as the period `T = t_{k+2} - t_k`.
    fn bound(&self, rows: &[Node]) -> Vec<(usize, BTreeSet<i32>)> {
        let mut bound = Vec::new();
        for node in rows.iter().filter(|node| self.is_pure(node)) {
            let impacts = self.impacts(node, &[]);
            let parameters = node
                .written()
                .into_iter()
                .filter(|&slot| self.space.impact(slot).is_none());
            bound.extend(
                parameters
                    .filter(|_| !impacts.is_empty())
                    .map(|slot| (slot, impacts.clone())),
            );
        }
        bound
    }

    /// Whether a row speaks of times and parameters alone.
    fn is_pure(&self, node: &Node) -> bool {
        node.courses().is_empty() && !node.written().iter().any(|&slot| self.space.is_state(slot))
    }

    /// The rows each map follows from: flights first, then what has a state, then the rest.
    fn choose_step_rows(&mut self, speaks_of_maps: bool) {
        for step in &self.maps.steps {
            if !speaks_of_maps {
                self.step_rows.push(Vec::new());
                continue;
            }
            if !step.equations.is_empty() {
                let row = |node: &Node| Row {
                    node: node.clone(),
                    impacts: BTreeSet::new(),
                    in_flight: false,
                };
                self.step_rows.push(step.equations.iter().map(row).collect());
                continue;
            }
            let impacts: BTreeSet<i32> = step
                .of
                .iter()
                .chain(&step.by)
                .filter_map(|&s| self.space.impact(s))
                .collect();
            let speaks = |row: &Row| {
                row.in_flight
                    || row
                        .node
                        .written()
                        .iter()
                        .any(|&s| self.space.impact(s).is_some() && !step.by.contains(&s))
            };
            let fits = |row: &&Row| !self.is_pure(&row.node) && speaks(row) && row.impacts.is_subset(&impacts);
            let mut rows: Vec<Row> = self.rows.iter().filter(fits).cloned().collect();
            let has_state = |row: &Row| row.node.written().iter().any(|&s| self.space.is_state(s));
            rows.sort_by_key(|row| (!row.in_flight, !has_state(row)));
            self.step_rows.push(rows);
        }
        let explicit: Vec<Node> = self.maps.steps.iter().flat_map(|step| step.equations.clone()).collect();
        let row = |node| Row {
            node,
            impacts: BTreeSet::new(),
            in_flight: false,
        };
        self.rows.extend(explicit.into_iter().map(row));
    }
}

impl Sorted {
    fn sort(&mut self, [left, right]: [Node; 2], space: &Space, late: &mut Vec<Node>) {
        let is_partial = |node: &Node| match node {
            Node::Slot(slot) => matches!(space.slots.get(*slot), Some(Slot::Partial { .. })),
            _ => false,
        };
        if let Some(period) = period_of(&left, &right, space) {
            self.periods.push(period);
            return;
        }
        let node = left.minus(right);
        if node.any(is_partial) {
            late.push(node);
        } else if !node.any(|node| matches!(node, Node::Running)) {
            self.rows.push(node);
        } else {
            let flight = |course: usize| space.courses.get(course).and_then(|course| course.flight);
            match node.courses().into_iter().find(|&course| flight(course).is_some()) {
                Some(course) => self.flights.push(Law {
                    course,
                    start: flight(course).unwrap_or(0),
                    node,
                }),
                None => self.functions.push(node),
            }
        }
    }
}

/// A compiler for one equation.
fn compiler<'a>(
    vocabulary: &'a Vocabulary,
    space: &'a mut Space,
    maps: Option<&'a Maps>,
    locals: &'a [Local],
    first: Option<i32>,
    flight: i32,
) -> Compiler<'a> {
    Compiler {
        vocabulary,
        space,
        maps,
        locals,
        first,
        flight,
        open: Vec::new(),
    }
}

fn read_maps(vocabulary: &Vocabulary, compiler: &mut Compiler, mut maps: Maps) -> Result<Maps, Unwitnessed> {
    for (name, map) in &vocabulary.maps {
        let step = match map {
            Map::Product(factors) => {
                maps.products.push((name.clone(), factors.clone()));
                continue;
            }
            Map::Premises { of, by } => {
                let mut slots = |trees: &[Tree]| {
                    trees
                        .iter()
                        .filter_map(|tree| match tree {
                            Tree::Symbol(name, _) => compiler.quantity(name),
                            _ => None,
                        })
                        .collect()
                };
                Step {
                    name: name.clone(),
                    of: slots(of),
                    by: slots(by),
                    equations: Vec::new(),
                }
            }
            Map::Equations(equations) => explicit(name, equations, compiler)?,
        };
        maps.steps.push(step);
    }
    Ok(maps)
}

/// The map from the first impact that its equations name to the last: times before states, as declared.
fn explicit(name: &crate::tex::Name, equations: &[Equation], compiler: &mut Compiler) -> Result<Step, Unwitnessed> {
    let mut nodes = Vec::new();
    for equation in equations {
        let left = compiler.tree(&equation.left)?;
        nodes.push(left.minus(compiler.tree(&equation.right)?));
    }
    let mut order: Vec<(i32, usize, usize)> = Vec::new();
    for slot in nodes.iter().flat_map(Node::written) {
        match compiler.space.slots.get(slot) {
            Some(Slot::Time { index, .. }) => order.push((*index, 0, slot)),
            Some(Slot::State { state, index, .. }) => {
                let rank = compiler.vocabulary.states.iter().position(|known| known == state);
                order.push((*index, rank.map_or(usize::MAX, |rank| rank + 1), slot));
            }
            _ => {}
        }
    }
    order.sort_unstable();
    order.dedup();
    let side = |index: Option<i32>| {
        order
            .iter()
            .filter(|(i, ..)| Some(*i) == index)
            .map(|(.., slot)| *slot)
            .collect()
    };
    let (of, by) = (side(order.last().map(|o| o.0)), side(order.first().map(|o| o.0)));
    Ok(Step {
        name: name.clone(),
        of,
        by,
        equations: nodes,
    })
}

/// Whether any node of an equation passes the test.
pub fn any(equation: &Equation, test: &dyn Fn(&Tree) -> bool) -> bool {
    fn below(tree: &Tree, test: &dyn Fn(&Tree) -> bool) -> bool {
        test(tree)
            || match tree {
                Tree::Number(_) | Tree::Symbol(..) | Tree::Partial { .. } | Tree::Invariant { .. } => false,
                Tree::Call(_, body, _) | Tree::Negate(body) | Tree::Power(body, ..) | Tree::Root(body, _) => {
                    below(body, test)
                }
                Tree::PlusMinus(body) | Tree::MinusPlus(body) => below(body, test),
                Tree::Sum(parts) | Tree::Product(parts) => parts.iter().any(|part| below(part, test)),
                Tree::Quotient(a, b, _) => below(a, test) || below(b, test),
            }
    }
    below(&equation.left, test) || below(&equation.right, test)
}
