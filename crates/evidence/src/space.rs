//! The quantities that a claim and its premises speak of, each a numbered slot, and the functions of time.

use super::formula::Formula;
use texmath::{Invariant, Name};

/// What a slot holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Slot {
    /// A parameter.
    Parameter(Name),
    /// The time of an impact.
    Time { family: Name, index: i32 },
    /// A state at an impact, just before or just after it.
    State { state: Name, index: i32, after: bool },
    /// A coefficient of a function of time, or a value it starts with.
    Coefficient { course: usize, term: usize },
    /// A partial derivative of one slot by another.
    Partial { of: usize, by: usize },
    /// The trace or determinant of a map that nothing more is known of.
    Invariant { kind: Invariant, of: Name },
    /// What an inequality leaves over, or an integer that an expression is equal to.
    Slack(usize),
}

/// A function of time with those that come from it by differentiating.
#[derive(Clone, Debug)]
pub struct Course {
    /// From the highest integral down; each is the derivative of the one before it.
    pub names: Vec<Name>,
    /// The impact whose flight this is, for a state in flight.
    pub flight: Option<i32>,
    /// What gives its derivative of some order, at the running time.
    pub law: Option<(usize, Formula)>,
    /// The law among those of the formulas, for the derivatives below that order.
    pub flow: Option<usize>,
    /// The period, where there is one: of member `level` and all below it.
    pub period: Option<(usize, Formula)>,
    /// The slot of the first coefficient, once these are there.
    pub first: Option<usize>,
}

/// All slots, and the functions of time whose coefficients are among them.
#[derive(Clone, Debug, Default)]
pub struct Space {
    pub slots: Vec<Slot>,
    pub courses: Vec<Course>,
}

impl Space {
    /// The number of a slot, made where it is new.
    pub fn slot(&mut self, slot: Slot) -> usize {
        match self.find(&slot) {
            Some(position) => position,
            None => {
                self.slots.push(slot);
                self.slots.len() - 1
            }
        }
    }

    pub fn find(&self, slot: &Slot) -> Option<usize> {
        self.slots.iter().position(|known| known == slot)
    }

    /// The number of a course, made where it is new.
    pub fn course(&mut self, names: Vec<Name>, flight: Option<i32>) -> usize {
        let same = |course: &Course| course.flight == flight && course.names == names;
        self.courses.iter().position(same).unwrap_or_else(|| {
            self.courses.push(Course {
                names,
                flight,
                law: None,
                flow: None,
                period: None,
                first: None,
            });
            self.courses.len() - 1
        })
    }

    /// The impact that a slot belongs to.
    pub fn impact(&self, slot: usize) -> Option<i32> {
        match self.slots.get(slot)? {
            Slot::Time { index, .. } | Slot::State { index, .. } => Some(*index),
            _ => None,
        }
    }

    /// Whether a slot is a state at an impact.
    pub fn is_state(&self, slot: usize) -> bool {
        matches!(self.slots.get(slot), Some(Slot::State { .. }))
    }

    /// The name of a symbol's slot, without index.
    pub fn name(&self, slot: usize) -> Option<&Name> {
        match self.slots.get(slot)? {
            Slot::Parameter(name) | Slot::Time { family: name, .. } | Slot::State { state: name, .. } => Some(name),
            _ => None,
        }
    }

    /// The slot as a reader would name it, with the letter that numbers impacts.
    pub fn show(&self, slot: usize, letter: &str) -> Option<String> {
        let subscript = |index: i32| match index {
            0 => letter.to_string(),
            index => format!("{letter}{index:+}"),
        };
        Some(match self.slots.get(slot)? {
            Slot::Parameter(name) => name.to_string(),
            Slot::Time { family, index } => Name {
                subscript: subscript(*index),
                ..family.clone()
            }
            .to_string(),
            Slot::State { state, index, after } => Name {
                subscript: subscript(*index),
                mark: if *after { "+".to_string() } else { String::new() },
                ..state.clone()
            }
            .to_string(),
            _ => return None,
        })
    }
}
