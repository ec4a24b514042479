//! A table by columns, for programs that compute with it.

use super::{Cell, Table};

/// What the cells of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// Words.
    Text,
    /// A number; where more figures are asked for than f64 has, a decimal.
    Number,
    /// The numbers of one motion in word order.
    Numbers,
    /// A count.
    Integer,
    /// `true` or `false`.
    Flag,
    /// An exact decimal.
    Decimal,
}

impl Form {
    /// Every form.
    pub const ALL: [Self; 6] = [
        Self::Text,
        Self::Number,
        Self::Numbers,
        Self::Integer,
        Self::Flag,
        Self::Decimal,
    ];

    /// The name in descriptions of columns.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Number => "number",
            Self::Numbers => "numbers",
            Self::Integer => "integer",
            Self::Flag => "flag",
            Self::Decimal => "decimal",
        }
    }
}

/// The cells of a column one behind the other.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers; NaN where there is none.
    Numbers(Vec<f64>),
    /// Counts.
    Integers(Vec<i64>),
    /// Flags.
    Flags(Vec<bool>),
    /// Exact decimals as text; nothing where there is none.
    Decimals(Vec<Option<String>>),
    /// Anything.
    Cells(Vec<Cell>),
}

impl Values {
    /// An empty column. What may lack a value are numbers, with NaN there, or cells: the type does not depend on the rows.
    pub fn new(form: Option<Form>, is_optional: bool) -> Self {
        match (form, is_optional) {
            (Some(Form::Number), _) | (Some(Form::Integer), true) => Self::Numbers(Vec::new()),
            (Some(Form::Integer), false) => Self::Integers(Vec::new()),
            (Some(Form::Flag), false) => Self::Flags(Vec::new()),
            (Some(Form::Decimal), _) => Self::Decimals(Vec::new()),
            _ => Self::Cells(Vec::new()),
        }
    }

    /// Adds a cell. One that is of another form, as decimals are, makes cells of all.
    pub fn push(&mut self, cell: Cell) {
        match (&mut *self, cell) {
            (Self::Numbers(own), Cell::Number(number)) => own.push(number),
            (Self::Numbers(own), Cell::Integer(count)) => own.push(count as f64),
            (Self::Numbers(own), Cell::Empty) => own.push(f64::NAN),
            (Self::Integers(own), Cell::Integer(count)) => own.push(count),
            (Self::Flags(own), Cell::Flag(flag)) => own.push(flag),
            (Self::Decimals(own), Cell::Text(text)) => own.push(Some(text).filter(|text| !text.is_empty())),
            (Self::Decimals(own), Cell::Empty) => own.push(None),
            (Self::Cells(own), cell) => own.push(cell),
            (_, cell) => {
                let mut cells = std::mem::replace(self, Self::Cells(Vec::new())).into_cells();
                cells.push(cell);
                *self = Self::Cells(cells);
            }
        }
    }

    fn into_cells(self) -> Vec<Cell> {
        match self {
            Self::Numbers(own) => own
                .into_iter()
                .map(|number| {
                    if number.is_nan() {
                        Cell::Empty
                    } else {
                        Cell::Number(number)
                    }
                })
                .collect(),
            Self::Integers(own) => own.into_iter().map(Cell::Integer).collect(),
            Self::Flags(own) => own.into_iter().map(Cell::Flag).collect(),
            Self::Decimals(own) => own.into_iter().map(Cell::from).collect(),
            Self::Cells(own) => own,
        }
    }
}

/// A table by columns, each of one type.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Frame {
    /// The columns by their names, in order.
    pub columns: Vec<(String, Values)>,
    /// The number of rows.
    pub rows: usize,
}

impl Frame {
    /// Adds a row, as long as there are columns.
    pub fn push(&mut self, row: Vec<Cell>) {
        for ((_, values), cell) in self.columns.iter_mut().zip(row) {
            values.push(cell);
        }
        self.rows += 1;
    }

    /// The rows of a table, in these columns.
    pub fn with(mut self, table: Table) -> Self {
        let (_, rows) = table.into_parts();
        rows.into_iter().for_each(|row| self.push(row));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_may_lack_a_value_has_one_type_whatever_the_rows() {
        for cells in [
            vec![Cell::Integer(3)],
            vec![Cell::Empty],
            vec![Cell::Empty, Cell::Integer(3)],
        ] {
            let mut values = Values::new(Some(Form::Integer), true);
            cells.into_iter().for_each(|cell| values.push(cell));
            assert!(matches!(values, Values::Numbers(_)), "{values:?}");
        }
    }

    #[test]
    fn a_decimal_among_numbers_loses_none_of_its_digits_and_no_empty_cell() {
        let decimal = Cell::from("0.1234567890123456789012345");
        let mut values = Values::new(Some(Form::Number), true);
        for cell in [Cell::Number(0.5), Cell::Empty, decimal.clone()] {
            values.push(cell);
        }
        assert_eq!(values, Values::Cells(vec![Cell::Number(0.5), Cell::Empty, decimal]));
    }
}
