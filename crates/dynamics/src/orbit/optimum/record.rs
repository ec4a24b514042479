//! What became of the boxes of a search, put down as they are examined, so that a search that was stopped goes on from it.
//!
//! A search takes the same steps each time: only what it found in each box has to be known to be where it was. The devices
//! are looked for and proved again.

use crate::orbit::interval_box::is_subset;
use crate::orbit::optimum::cell::{Cell, UNKNOWNS};
use numbers::Interval;
use std::cmp::Ordering;
use std::convert::Infallible;
use std::fmt;

/// A box to examine: where, over how many periods, and the bound of what it is part of.
pub type Start = (Cell, u32, f64);

/// A box that is left.
#[derive(Clone, Debug)]
pub struct Left {
    /// Its bound, in volts per forcing period.
    pub most: f64,
    /// The forcing periods of its motions.
    pub periods: u32,
    /// What is left of it.
    pub cell: Cell,
    /// The side to halve.
    pub direction: usize,
}

impl Left {
    /// Both halves, with the bound of the whole.
    pub fn halves(&self) -> [Start; 2] {
        let (low, high) = self.cell[self.direction].halves();
        [low, high].map(|half| {
            let mut cell = self.cell;
            cell[self.direction] = half;
            (cell, self.periods, self.most)
        })
    }

    /// Reads what is left of a box: no more than the box, with no larger bound.
    fn read(text: &str, (cell, periods, of_whole): &Start) -> Option<Self> {
        let mut parts = text.split(',');
        let (most, direction) = (parts.next()?.parse::<f64>().ok()?, parts.next()?.parse().ok()?);
        let mut left = *cell;
        for side in &mut left {
            let [low, high] = [parts.next()?, parts.next()?].map(|end| end.parse::<f64>().ok());
            *side = Interval::new(low?, high.filter(|high| low <= Some(*high))?);
        }
        let is_part = is_subset(&left, cell) && most <= *of_whole && direction < UNKNOWNS && parts.next().is_none();
        is_part.then_some(Self {
            most,
            periods: *periods,
            cell: left,
            direction,
        })
    }
}

impl fmt::Display for Left {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?},{}", self.most, self.direction)?;
        let mut sides = self.cell.iter();
        sides.try_for_each(|side| write!(f, ",{:?},{:?}", side.low(), side.high()))
    }
}

impl PartialEq for Left {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Left {}

impl PartialOrd for Left {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Left {
    fn cmp(&self, other: &Self) -> Ordering {
        self.most.total_cmp(&other.most)
    }
}

/// Boxes that are examined together. As text, the question that their outcomes answer.
#[derive(Clone, Copy, Debug)]
pub struct SearchBatch<'a> {
    /// The boxes.
    pub(crate) boxes: &'a [Start],
    /// Volts per forcing period of the best device that is proved: what is worth no more is dropped.
    pub(crate) best: Option<f64>,
}

impl fmt::Display for SearchBatch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.best)?;
        for (cell, periods, most) in self.boxes {
            write!(f, ";{periods},{most:?}")?;
            cell.iter()
                .try_for_each(|side| write!(f, ",{:?},{:?}", side.low(), side.high()))?;
        }
        Ok(())
    }
}

impl SearchBatch<'_> {
    /// Reads what became of these boxes; `None` where the text cannot be that.
    pub fn read(&self, text: &str) -> Option<SearchOutcomes> {
        let mut parts = text.split(';');
        let outcome = |of: &Start| match parts.next()? {
            "" => Some(None),
            left => Left::read(left, of).map(Some),
        };
        let outcomes = self.boxes.iter().map(outcome).collect::<Option<_>>()?;
        parts.next().is_none().then_some(SearchOutcomes(outcomes))
    }
}

/// What became of each box of a batch: what is left of it, nothing where it holds no better motion. As text, exact.
#[derive(Clone, Debug)]
pub struct SearchOutcomes(pub(crate) Vec<Option<Left>>);

impl fmt::Display for SearchOutcomes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, left) in self.0.iter().enumerate() {
            let parted = if place > 0 { ";" } else { "" };
            write!(f, "{parted}")?;
            left.iter().try_for_each(|left| write!(f, "{left}"))?;
        }
        Ok(())
    }
}

/// Where the outcomes of a search stand.
pub trait SearchRecord {
    /// Why it cannot be read or written.
    type Error;

    /// What became of the boxes that are examined next, where that is known. It is believed: a record makes sure that it is
    /// of the same search and was not changed.
    ///
    /// # Errors
    /// What was put down is of other boxes, or cannot be read.
    fn known(&mut self, batch: &SearchBatch<'_>) -> Result<Option<SearchOutcomes>, Self::Error>;

    /// Puts down what became of boxes that were not known.
    ///
    /// # Errors
    /// It cannot be written.
    fn keep(&mut self, batch: &SearchBatch<'_>, outcomes: &SearchOutcomes) -> Result<(), Self::Error>;
}

/// No record.
impl SearchRecord for () {
    type Error = Infallible;

    fn known(&mut self, _: &SearchBatch<'_>) -> Result<Option<SearchOutcomes>, Infallible> {
        Ok(None)
    }

    fn keep(&mut self, _: &SearchBatch<'_>, _: &SearchOutcomes) -> Result<(), Infallible> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_are_read_as_they_were_written_and_nothing_else_is() {
        let side = |low, high| Interval::new(low, high);
        let cell = [side(0.1, 0.5), side(0.2, 0.2), side(0.0, 2.0), side(-3.0, 3.0)];
        let boxes = [(cell, 1, 1e5), (cell, 2, f64::MAX), (cell, 1, f64::INFINITY)];
        let batch = SearchBatch {
            boxes: &boxes,
            best: Some(0.1 + 0.2),
        };
        let mut smaller = cell;
        smaller[0] = side(0.1, 1.0 / 3.0);
        let left = |most, periods| Left {
            most,
            periods,
            cell: smaller,
            direction: 2,
        };
        let outcomes = SearchOutcomes(vec![None, Some(left(f64::MAX, 2)), Some(left(1.0 / 3.0, 1))]);
        let text = outcomes.to_string();
        let read = batch.read(&text).unwrap();
        assert_eq!(format!("{outcomes:?}"), format!("{read:?}"));
        let dropped = batch.read(";;").unwrap();
        assert!(dropped.0.iter().all(Option::is_none));
        for wrong in [
            "",
            ";",
            ";;;",
            &text[..text.len() - 1].replace("3.0", ""),
            &text.replace("0.1,", "0.0,"),
            &text.replace("0.1,", "0.4,"),
            &text.replace("0.1,", "NaN,"),
            &text.replace(",2,0.1", ",4,0.1"),
            &format!("2e5,{}", &text[text.len() - 40..]),
            &format!("{text},1"),
        ] {
            assert!(batch.read(wrong).is_none(), "{wrong}");
        }
        assert!(
            batch
                .to_string()
                .starts_with("Some(0.30000000000000004);1,100000.0,0.1,0.5,")
        );
    }
}
