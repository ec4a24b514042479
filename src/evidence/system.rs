//! The premises of a claim as equations over slots.

use super::compiler::{Compiler, Unwitnessed};
use super::course::Course;
use super::flight;
use super::maps::{Maps, read_maps};
use super::period::Period;
use super::program::Node;
use super::question::Question;
use super::sorted::{Sorted, speaks_of_matrix};
use super::space::Space;
use crate::claim::{Local, Statements, Vocabulary};
use crate::tex::{At, Tree};
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

impl System {
    /// Reads premises and claim.
    ///
    /// # Errors
    /// [`Unwitnessed`] where something has no concrete form.
    pub fn new(statements: &Statements, vocabulary: &Vocabulary, kind: Kind) -> Result<Self, Unwitnessed> {
        let (mut space, first) = (Space::default(), statements.first.unwrap_or(0));
        let maps = read_maps(
            vocabulary,
            &mut compiler(vocabulary, &mut space, None, &[], None, first),
        )?;
        let sorted = Sorted::read(statements, vocabulary, &mut space, &maps)?;
        let mut system = Self {
            space,
            maps,
            rows: Vec::new(),
            step_rows: Vec::new(),
            late: sorted.late.clone(),
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
        system.ask(statements, vocabulary)?;
        system.align_periods();
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
        if !self.shaped {
            // Constants of integration are enough for any function at a few times.
            let functions = self.space.courses.iter().filter(|course| course.flight.is_none());
            let powers = functions.flat_map(|c| c.first + c.names.len()..c.first + c.powers);
            self.zeros.extend(powers);
        }
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
    fn ask(&mut self, statements: &Statements, vocabulary: &Vocabulary) -> Result<(), Unwitnessed> {
        let first = statements.first.unwrap_or(0);
        let maps = self.maps.clone();
        for statement in statements
            .premises
            .iter()
            .filter(|statement| speaks_of_matrix(&statement.equation))
        {
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

    /// A flight has the harmonics of what drives it; a cosine has the period 2.
    fn align_periods(&mut self) {
        let is_function = |course: &Course| course.flight.is_none();
        if self.kind == Kind::Cosine {
            for course in self.space.courses.iter_mut().filter(|course| is_function(course)) {
                course.period = Some(Box::new(Node::Number(2, 1)));
            }
        }
        let driving = self.space.courses.iter().find(|course| is_function(course));
        let period = driving.and_then(|course| course.period.clone());
        for course in self.space.courses.iter_mut().filter(|course| !is_function(course)) {
            course.period.clone_from(&period);
        }
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

/// A compiler for one equation.
pub fn compiler<'a>(
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
