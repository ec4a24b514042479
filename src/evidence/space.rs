//! The quantities that a claim and its premises speak of, each a numbered slot.

use super::course::Course;
use crate::tex::{Invariant, Name};

/// What a slot holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Slot {
    /// A parameter, or an unknown symbol of a premise.
    Parameter(Name),
    /// The time of an impact.
    Time { family: Name, index: i32 },
    /// A state at an impact, just before or just after it.
    State { state: Name, index: i32, after: bool },
    /// A coefficient of a course of time.
    Coefficient { course: usize, term: usize },
    /// A partial derivative of one slot by another.
    Partial { of: usize, by: usize },
    /// The trace or determinant of a map that nothing more is known of.
    Invariant { kind: Invariant, of: Name },
}

/// All slots, and the courses of time whose coefficients are among them.
#[derive(Clone, Debug, Default)]
pub struct Space {
    pub slots: Vec<Slot>,
    pub courses: Vec<Course>,
}

impl Space {
    /// The number of a slot, made where it is new.
    pub fn slot(&mut self, slot: Slot) -> usize {
        match self.slots.iter().position(|known| *known == slot) {
            Some(position) => position,
            None => {
                self.slots.push(slot);
                self.slots.len() - 1
            }
        }
    }

    /// Adds a course and its coefficients.
    pub fn add_course(&mut self, mut course: Course) -> usize {
        let number = self.courses.len();
        course.first = self.slots.len();
        for term in 0..course.terms() {
            self.slots.push(Slot::Coefficient { course: number, term });
        }
        self.courses.push(course);
        number
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
            Slot::State { state, index, after } => {
                let mark = if *after { "+".to_string() } else { String::new() };
                Name {
                    subscript: subscript(*index),
                    mark,
                    ..state.clone()
                }
                .to_string()
            }
            _ => return None,
        })
    }
}
