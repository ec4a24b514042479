//! A table: what a command has to say, before any layout.

use crate::number::Decimal;

/// One value of a row.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Cell {
    /// Words, a formula.
    Text(String),
    /// Words that say what symbols are, and these values by their names; in JSON, beside the words, an object under the name
    /// of the column with `_values` behind it.
    Values(String, Vec<(String, String)>),
    /// A number; infinities and NaN are written `inf`, `-inf`, `NaN`.
    Number(f64),
    /// The numbers of one motion in word order: joined by `;`, in JSON an array.
    Numbers(Vec<f64>),
    /// A number of more figures than f64 has; never rounded. In JSON a string, which every reader keeps whole.
    Decimal(Decimal),
    /// Several, in word order: joined by `;`, in JSON an array of strings.
    Decimals(Vec<Decimal>),
    /// A count; never rounded.
    Integer(i64),
    /// `true` or `false`.
    Flag(bool),
    /// Nothing is known or nothing applies: an empty field, in JSON `null`.
    #[default]
    Empty,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<Vec<f64>> for Cell {
    fn from(numbers: Vec<f64>) -> Self {
        Self::Numbers(numbers)
    }
}

impl From<Decimal> for Cell {
    fn from(decimal: Decimal) -> Self {
        Self::Decimal(decimal)
    }
}

impl From<Vec<Decimal>> for Cell {
    fn from(decimals: Vec<Decimal>) -> Self {
        Self::Decimals(decimals)
    }
}

impl From<i64> for Cell {
    fn from(integer: i64) -> Self {
        Self::Integer(integer)
    }
}

impl From<bool> for Cell {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

/// `None` is an empty cell: what is not known is never guessed.
impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// A column, by the name that scripts rely on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// The name in the header of CSV, text and Markdown, and the key in JSON.
    pub name: String,
}

impl<S: Into<String>> From<S> for Column {
    fn from(name: S) -> Self {
        Self { name: name.into() }
    }
}

/// A row whose length is not that of the header.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a row of {found} cells in a table of {expected} columns ({columns})")]
pub struct RowError {
    /// The number of columns of the table.
    pub expected: usize,
    /// The number of cells of the row.
    pub found: usize,
    /// The names of the columns.
    pub columns: String,
}

/// Columns and rows; every row has a cell for every column.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table of these columns and no rows yet. Names should differ: they are the keys in JSON.
    pub fn new<C: Into<Column>>(columns: impl IntoIterator<Item = C>) -> Self {
        Self {
            columns: columns.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row, which must have as many cells as the table has columns.
    pub fn push(&mut self, row: impl Into<Vec<Cell>>) -> Result<(), RowError> {
        let row = row.into();
        if row.len() != self.columns.len() {
            let names: Vec<&str> = self.columns.iter().map(|column| column.name.as_str()).collect();
            return Err(RowError {
                expected: self.columns.len(),
                found: row.len(),
                columns: names.join(","),
            });
        }
        self.rows.push(row);
        Ok(())
    }

    /// Returns the rows of all tables in one, under the columns of all, the last one of all of them at the end; a cell of a column
    /// that a row does not have is empty.
    pub fn joined(tables: &[&Self]) -> Self {
        let mut joined = Self::default();
        for column in tables.iter().flat_map(|table| &table.columns) {
            if joined.position(&column.name).is_none() {
                joined.columns.push(column.clone());
            }
        }
        let mut last = tables.iter().map(|table| table.columns.last());
        let shared = last
            .next()
            .flatten()
            .filter(|first| last.all(|other| other == Some(*first)));
        if let Some(place) = shared.and_then(|shared| joined.position(&shared.name)) {
            let shared = joined.columns.remove(place);
            joined.columns.push(shared);
        }
        for table in tables {
            let places: Vec<Option<usize>> = joined
                .columns
                .iter()
                .map(|column| table.position(&column.name))
                .collect();
            let cell = |row: &[Cell], place: Option<usize>| place.and_then(|place| row.get(place)).cloned();
            let rows = table.rows.iter();
            let rows = rows.map(|row| {
                places
                    .iter()
                    .map(|place| cell(row, *place).unwrap_or_default())
                    .collect()
            });
            joined.rows.extend(rows);
        }
        joined
    }

    /// Adds a column at the end that says the same of each row.
    pub fn with_column(mut self, name: &str, cell: &Cell) -> Self {
        self.columns.push(Column::from(name));
        for row in &mut self.rows {
            row.push(cell.clone());
        }
        self
    }

    /// Leaves the columns and no rows.
    pub(super) fn clear(&mut self) {
        self.rows.clear();
    }

    /// The columns, in order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The columns, and the rows in order.
    pub fn into_parts(self) -> (Vec<Column>, Vec<Vec<Cell>>) {
        (self.columns, self.rows)
    }

    /// The rows, in order.
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// Whether the column holds numbers or counts and nothing else but empty cells: such a column is aligned right.
    pub fn is_numeric(&self, index: usize) -> bool {
        let mut cells = self
            .rows
            .iter()
            .filter_map(|row| row.get(index))
            .filter(|cell| **cell != Cell::Empty)
            .peekable();
        cells.peek().is_some()
            && cells.all(|cell| matches!(cell, Cell::Number(_) | Cell::Decimal(_) | Cell::Integer(_)))
    }

    /// Whether its rows have a verdict and the one expected, as test reports need.
    pub fn has_verdicts(&self) -> bool {
        ["verdict", "expected"].iter().all(|name| self.position(name).is_some())
    }

    /// Returns true if a verdict is the expected one; where none is expected, nothing may be suspect or refuted.
    pub fn is_expected(verdict: &str, expected: &str) -> bool {
        match expected {
            "" => !["suspect", "refuted"].contains(&verdict),
            expected => verdict == expected,
        }
    }

    /// Where the column of this name stands.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_of_another_length_is_refused_and_not_kept() {
        let mut table = Table::new(["label", "verdict"]);
        let error = table.push([Cell::from("22")]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "a row of 1 cells in a table of 2 columns (label,verdict)"
        );
        assert!(table.rows().is_empty());
    }

    #[test]
    fn tables_are_joined_under_the_columns_of_all() {
        let mut one = Table::new(["label", "verdict"]);
        one.push(["1", "proved"].map(Cell::from)).unwrap();
        let mut two = Table::new(["id", "verdict"]);
        two.push(["a", "wrong"].map(Cell::from)).unwrap();
        let joined = Table::joined(&[&one, &two]);
        let names: Vec<&str> = joined.columns().iter().map(|column| column.name.as_str()).collect();
        assert_eq!(names, ["label", "id", "verdict"]);
        assert_eq!(joined.rows()[0], [Cell::from("1"), Cell::Empty, Cell::from("proved")]);
        assert_eq!(joined.rows()[1], [Cell::Empty, Cell::from("a"), Cell::from("wrong")]);
        let [one, two] = [one, two].map(|table| table.with_column("file", &Cell::from("f")));
        let joined = Table::joined(&[&one, &two]);
        let names: Vec<&str> = joined.columns().iter().map(|column| column.name.as_str()).collect();
        assert_eq!(
            names,
            ["label", "verdict", "id", "file"],
            "the column that both end with is the last"
        );
        assert_eq!(
            joined.rows()[1],
            ["", "wrong", "a", "f"].map(|text| match text {
                "" => Cell::Empty,
                text => Cell::from(text),
            })
        );
    }

    #[test]
    fn what_is_not_known_is_an_empty_cell() {
        assert_eq!(Cell::from(None::<f64>), Cell::Empty);
        assert_eq!(Cell::from(Some(0.5)), Cell::Number(0.5));
    }
}
