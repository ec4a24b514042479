//! What a golden row asks a command for, and the memory of what has been answered.

use super::{Computed, Fault, Record, Setting};
use std::collections::HashMap;

/// A command, and the scene with its overrides that it is asked about.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Request {
    /// The command.
    pub command: String,
    /// The scene as the row names it.
    pub scene: String,
    /// Keys of the scene with their values as written, in order.
    pub overrides: Vec<(String, String)>,
}

impl Request {
    /// What the row of `record` and `setting` asks `command` for.
    pub fn new(command: &str, record: &Record, setting: &Setting) -> Self {
        Self {
            command: command.to_owned(),
            scene: record.field("scene").to_owned(),
            overrides: setting.overrides.clone(),
        }
    }
}

/// Who answers: a table, or a message for a person.
pub type Answer<'a> = dyn FnMut(&Request) -> Result<Computed, String> + 'a;

/// Asks each request once, however many rows make it.
pub struct Asked<'a> {
    answer: &'a mut Answer<'a>,
    known: HashMap<Request, Result<Computed, String>>,
}

impl<'a> Asked<'a> {
    /// Nothing has been asked yet.
    pub fn new(answer: &'a mut Answer<'a>) -> Self {
        Self {
            answer,
            known: HashMap::new(),
        }
    }

    /// The table that answers the request.
    ///
    /// # Errors
    /// What the answer says, at the row of `record`.
    pub fn ask(&mut self, request: &Request, record: &Record) -> Result<&Computed, Fault> {
        if !self.known.contains_key(request) {
            let answer = (self.answer)(request);
            self.known.insert(request.clone(), answer);
        }
        match self.known.get(request) {
            Some(Ok(computed)) => Ok(computed),
            Some(Err(message)) => Err(record.fault_of_row(message.clone())),
            None => Err(record.fault_of_row("nothing was answered")),
        }
    }
}
