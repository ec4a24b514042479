//! Matrices by their entries.

use super::build::{difference, integer, negative, power, product, root, sum};
use texmath::{At, Tree};

/// A number, or rows of numbers of equal length.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    Number(Tree),
    Matrix(Vec<Vec<Tree>>),
}

/// The most columns of a determinant that is written out, and of an inverse.
const LARGEST_DETERMINANT: usize = 8;
const LARGEST_INVERSE: usize = 4;

/// The highest power of a matrix.
const HIGHEST: i32 = 64;

type Rows = Vec<Vec<Tree>>;

fn columns(rows: &Rows) -> usize {
    rows.first().map_or(0, Vec::len)
}

pub(super) fn is_square(rows: &Rows) -> bool {
    rows.len() == columns(rows)
}

fn shape(rows: &Rows) -> String {
    format!("{} by {}", rows.len(), columns(rows))
}

fn entry(rows: &Rows, row: usize, column: usize) -> Tree {
    rows.get(row)
        .and_then(|row| row.get(column))
        .cloned()
        .unwrap_or_else(|| integer(0))
}

/// The rows with each entry replaced.
fn each(rows: &Rows, new: impl Fn(&Tree) -> Tree) -> Rows {
    rows.iter().map(|row| row.iter().map(&new).collect()).collect()
}

pub(super) fn negated(value: Value) -> Value {
    match value {
        Value::Number(tree) => Value::Number(negative(tree)),
        Value::Matrix(rows) => Value::Matrix(each(&rows, |tree| negative(tree.clone()))),
    }
}

pub(super) fn added(values: Vec<Value>) -> Result<Value, String> {
    let mut numbers = Vec::new();
    let mut total: Option<Rows> = None;
    for value in values {
        match (value, &mut total) {
            (Value::Number(tree), _) => numbers.push(tree),
            (Value::Matrix(rows), None) => total = Some(rows),
            (Value::Matrix(rows), Some(total)) => {
                if (rows.len(), columns(&rows)) != (total.len(), columns(total)) {
                    return Err(format!("matrices {} and {} are added", shape(total), shape(&rows)));
                }
                for (row, more) in total.iter_mut().zip(rows) {
                    for (entry, more) in row.iter_mut().zip(more) {
                        *entry = sum(vec![entry.clone(), more]);
                    }
                }
            }
        }
    }
    match (total, numbers.is_empty()) {
        (None, _) => Ok(Value::Number(match numbers.len() {
            1 => numbers.remove(0),
            _ => Tree::Sum(numbers),
        })),
        (Some(rows), true) => Ok(Value::Matrix(rows)),
        (Some(rows), false) => Err(format!("a number and a matrix {} are added", shape(&rows))),
    }
}

pub(super) fn multiplied(values: Vec<Value>) -> Result<Value, String> {
    let mut numbers: Vec<Tree> = Vec::new();
    let mut total: Option<Rows> = None;
    for value in values {
        match (value, &mut total) {
            (Value::Number(tree), _) => numbers.push(tree),
            (Value::Matrix(rows), None) => total = Some(rows),
            (Value::Matrix(rows), Some(total)) => *total = times(total, &rows)?,
        }
    }
    Ok(match total {
        None => Value::Number(match numbers.len() {
            1 => numbers.remove(0),
            _ => Tree::Product(numbers),
        }),
        Some(rows) if numbers.is_empty() => Value::Matrix(rows),
        Some(rows) => Value::Matrix(each(&rows, |entry| {
            product(numbers.iter().cloned().chain([entry.clone()]).collect())
        })),
    })
}

fn times(left: &Rows, right: &Rows) -> Result<Rows, String> {
    if columns(left) != right.len() {
        return Err(format!(
            "a matrix {} is multiplied by one {}: write \\cdot between vectors with arrows, or a transpose",
            shape(left),
            shape(right)
        ));
    }
    let cell = |row: &Vec<Tree>, column: usize| {
        let terms = row.iter().enumerate();
        sum(terms
            .map(|(place, factor)| product(vec![factor.clone(), entry(right, place, column)]))
            .collect())
    };
    let row = |row: &Vec<Tree>| (0..columns(right)).map(|column| cell(row, column)).collect();
    Ok(left.iter().map(row).collect())
}

pub(super) fn divided(value: Value, by: &Tree) -> Value {
    match value {
        Value::Number(tree) => Value::Number(Tree::Quotient(Box::new(tree), Box::new(by.clone()), At::default())),
        Value::Matrix(rows) => Value::Matrix(each(&rows, |entry| {
            Tree::Quotient(Box::new(entry.clone()), Box::new(by.clone()), At::default())
        })),
    }
}

pub(super) fn transposed(rows: &Rows) -> Rows {
    (0..columns(rows))
        .map(|column| (0..rows.len()).map(|row| entry(rows, row, column)).collect())
        .collect()
}

pub(super) fn trace(rows: &Rows) -> Result<Tree, String> {
    match is_square(rows) {
        true => Ok(sum((0..rows.len()).map(|at| entry(rows, at, at)).collect())),
        false => Err(format!("the trace of a matrix {}", shape(rows))),
    }
}

/// The determinant, by its first row.
pub(super) fn determinant(rows: &Rows) -> Result<Tree, String> {
    if !is_square(rows) || rows.is_empty() {
        return Err(format!("the determinant of a matrix {}", shape(rows)));
    }
    if rows.len() > LARGEST_DETERMINANT {
        return Err(format!("determinants are written out up to {LARGEST_DETERMINANT} rows"));
    }
    Ok(minor(rows, 0, &(0..rows.len()).collect::<Vec<_>>()))
}

/// The determinant of the rows from `first` on, in these columns.
fn minor(rows: &Rows, first: usize, columns: &[usize]) -> Tree {
    let mut terms = Vec::new();
    for (place, &column) in columns.iter().enumerate() {
        let factor = entry(rows, first, column);
        if columns.len() == 1 {
            return factor;
        }
        if super::build::is_zero(&factor) {
            continue;
        }
        let rest: Vec<usize> = columns.iter().copied().filter(|&other| other != column).collect();
        let term = product(vec![factor, minor(rows, first + 1, &rest)]);
        terms.push(if place % 2 == 0 { term } else { negative(term) });
    }
    sum(terms)
}

/// The inverse, by cofactors.
fn inverse(rows: &Rows) -> Result<Rows, String> {
    let size = rows.len();
    if !is_square(rows) || size > LARGEST_INVERSE {
        return Err(format!(
            "the inverse of a matrix {}: up to {LARGEST_INVERSE} rows are inverted",
            shape(rows)
        ));
    }
    let whole = determinant(rows)?;
    let cofactor = |row: usize, column: usize| {
        let kept = |at: usize, from: &Rows| -> Rows {
            from.iter()
                .enumerate()
                .filter(|(other, _)| *other != at)
                .map(|(_, row)| row.clone())
                .collect()
        };
        let rest = transposed(&kept(column, &transposed(&kept(row, rows))));
        let minor = match rest.is_empty() {
            true => integer(1),
            false => determinant(&rest)?,
        };
        Ok::<Tree, String>(if (row + column).is_multiple_of(2) {
            minor
        } else {
            negative(minor)
        })
    };
    (0..size)
        .map(|row| {
            (0..size)
                .map(|column| {
                    let above = cofactor(column, row)?;
                    Ok(Tree::Quotient(Box::new(above), Box::new(whole.clone()), At::default()))
                })
                .collect()
        })
        .collect()
}

/// The power of a square matrix.
pub(super) fn raised(rows: &Rows, exponent: i32) -> Result<Rows, String> {
    if !is_square(rows) || exponent.abs() > HIGHEST {
        return Err(format!("the power {exponent} of a matrix {}", shape(rows)));
    }
    let base = if exponent < 0 { inverse(rows)? } else { rows.clone() };
    let size = rows.len();
    let mut total: Rows = (0..size)
        .map(|row| (0..size).map(|column| integer(i64::from(row == column))).collect())
        .collect();
    for _ in 0..exponent.unsigned_abs() {
        total = times(&total, &base)?;
    }
    Ok(total)
}

/// The entries of a row or a column.
pub(super) fn vector(rows: &Rows) -> Option<Vec<Tree>> {
    match (rows.len(), columns(rows)) {
        (1, _) => rows.first().cloned(),
        (_, 1) => Some(rows.iter().flatten().cloned().collect()),
        _ => None,
    }
}

/// The length of a vector.
pub(super) fn norm(rows: &Rows) -> Result<Tree, String> {
    let entries = vector(rows).ok_or("bars around a matrix: write \\det")?;
    let squares = entries.into_iter().map(|entry| power(entry, 2));
    Ok(root(sum(squares.collect())))
}

pub(super) fn dot(left: &Value, right: &Value) -> Result<Value, String> {
    match (left, right) {
        (Value::Matrix(one), Value::Matrix(other)) => match (vector(one), vector(other)) {
            (Some(one), Some(other)) if one.len() == other.len() => {
                let products = one.into_iter().zip(other).map(|(a, b)| product(vec![a, b]));
                Ok(Value::Number(sum(products.collect())))
            }
            _ => Ok(Value::Matrix(times(one, other)?)),
        },
        _ => multiplied(vec![left.clone(), right.clone()]),
    }
}

pub(super) fn cross(left: &Value, right: &Value) -> Result<Value, String> {
    let (Value::Matrix(one), Value::Matrix(other)) = (left, right) else {
        return match (left, right) {
            (Value::Number(_), Value::Number(_)) => multiplied(vec![left.clone(), right.clone()]),
            _ => Err("\\times between a number and a vector".to_owned()),
        };
    };
    let (Some(a), Some(b)) = (vector(one), vector(other)) else {
        return Err("\\times between matrices".to_owned());
    };
    let ([a1, a2, a3], [b1, b2, b3]) = (a.as_slice(), b.as_slice()) else {
        return Err("\\times is between vectors of three entries".to_owned());
    };
    let cell = |p: &Tree, q: &Tree, r: &Tree, s: &Tree| {
        difference(product(vec![p.clone(), q.clone()]), product(vec![r.clone(), s.clone()]))
    };
    let entries = [cell(a2, b3, a3, b2), cell(a3, b1, a1, b3), cell(a1, b2, a2, b1)];
    Ok(Value::Matrix(entries.into_iter().map(|entry| vec![entry]).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use texmath::{Names, read_expression};

    fn rows(tex: &[&[&str]]) -> Rows {
        let entry = |tex: &&str| read_expression(tex, &Names::default()).unwrap();
        tex.iter().map(|row| row.iter().map(entry).collect()).collect()
    }

    #[test]
    fn products_determinants_and_inverses() {
        let (a, b) = (rows(&[&["a", "b"], &["c", "d"]]), rows(&[&["x"], &["y"]]));
        assert_eq!(times(&a, &b).unwrap(), rows(&[&["a x + b y"], &["c x + d y"]]));
        assert!(times(&b, &a).is_err());
        assert_eq!(determinant(&a).unwrap().to_string(), "a d - b c");
        assert_eq!(raised(&a, 0).unwrap(), rows(&[&["1", "0"], &["0", "1"]]));
        assert_eq!(
            inverse(&a).unwrap(),
            rows(&[
                &[r"\frac{d}{a d - b c}", r"\frac{-b}{a d - b c}"],
                &[r"\frac{-c}{a d - b c}", r"\frac{a}{a d - b c}"]
            ])
        );
        assert!(determinant(&b).is_err() && raised(&b, 2).is_err());
    }
}
