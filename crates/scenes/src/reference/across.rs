//! What is asked of several rows at once.

use super::figures::{Figures, rounded};
use super::quantity::Across;
use super::value::Value;
use num_traits::Zero;
use numbers::Rational;

/// A value with its number.
struct Row<'a> {
    value: &'a Value,
    figures: Figures,
}

impl<'a> Row<'a> {
    fn read(value: &'a Value) -> Result<Self, String> {
        let figures = Figures::read(&value.text).ok_or_else(|| format!("`{}` is no number", value.text))?;
        Ok(Self { value, figures })
    }
}

/// What is asked of the values of rows, in the order of their table.
///
/// A trend is what is certain of it: `neither` where one value is certainly above the next and another one below it,
/// whatever the rest do; `increases` or `decreases` where every step is certain; else it is not known.
///
/// How many they are is certain where every value of `all` is: else another one might be meant too.
///
/// # Errors
/// A message for a person: no row, but for a count, a value that is no number, a trend of one row.
pub fn across(asked: Across, values: &[Value], all: &[Value]) -> Result<Value, String> {
    if asked == Across::Count {
        let is_certain = all.iter().all(|value| value.bound.is_some());
        return Ok(Value {
            text: if is_certain {
                values.len().to_string()
            } else {
                String::new()
            },
            bound: is_certain.then(Rational::zero),
        });
    }
    let rows: Vec<Row> = values.iter().map(Row::read).collect::<Result<_, String>>()?;
    let least = rows.iter().min_by(|a, b| a.figures.value.cmp(&b.figures.value));
    let greatest = rows.iter().max_by(|a, b| a.figures.value.cmp(&b.figures.value));
    let (Some(least), Some(greatest)) = (least, greatest) else {
        return Err("no row is meant".to_owned());
    };
    // The bound of an extreme is the worst of all: another row might be the true one.
    let bounds: Option<Vec<&Rational>> = values.iter().map(|value| value.bound.as_ref()).collect();
    let bound = bounds.and_then(|bounds| bounds.into_iter().max().cloned());
    Ok(match asked {
        Across::Least => Value {
            text: least.value.text.clone(),
            bound,
        },
        Across::Greatest => Value {
            text: greatest.value.text.clone(),
            bound,
        },
        Across::Spread => Value {
            text: difference(greatest, least),
            bound: bound.map(|bound| bound.clone() + bound),
        },
        Across::Trend | Across::Count if rows.len() < 2 => return Err("one row has no trend".to_owned()),
        Across::Trend | Across::Count => Value {
            text: trend(&rows).unwrap_or_default().to_owned(),
            bound: Some(Rational::zero()),
        },
    })
}

/// The exact difference, with a point where either has one: without, it would be a count.
fn difference(greatest: &Row, least: &Row) -> String {
    let places = greatest.figures.places.max(least.figures.places).max(0);
    let mut text = rounded(&(greatest.figures.value.clone() - least.figures.value.clone()), places);
    if places > 0 && !text.contains('.') {
        text.push_str(".0");
    }
    text
}

fn trend(rows: &[Row]) -> Option<&'static str> {
    let known: Vec<(&Rational, &Rational)> = rows
        .iter()
        .filter_map(|row| Some((&row.figures.value, row.value.bound.as_ref()?)))
        .collect();
    let steps = || known.windows(2).filter_map(|pair| Some((pair.first()?, pair.get(1)?)));
    let surely = |(low, low_bound): &(&Rational, &Rational), (high, high_bound): &(&Rational, &Rational)| {
        (*low).clone() + (*low_bound).clone() < (*high).clone() - (*high_bound).clone()
    };
    let rises = steps().filter(|(one, next)| surely(one, next)).count();
    let falls = steps().filter(|(one, next)| surely(next, one)).count();
    let all = rows.len() - 1;
    match (rises, falls) {
        (1.., 1..) => Some("neither"),
        (rises, 0) if rises == all => Some("increases"),
        (0, falls) if falls == all => Some("decreases"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(texts: &[&str], bound: &str) -> Vec<Value> {
        let bound = Figures::read(bound).map(|figures| figures.value);
        let value = |text: &&str| Value {
            text: (*text).to_owned(),
            bound: bound.clone(),
        };
        texts.iter().map(value).collect()
    }

    fn text(asked: Across, texts: &[&str], bound: &str) -> String {
        let values = values(texts, bound);
        across(asked, &values, &values).map_or_else(|message| message, |value| value.text)
    }

    #[test]
    fn extremes_and_spread_are_exact_and_as_certain_as_the_worst_row() {
        let texts = ["0.25", "-1.5", "7"];
        assert_eq!(text(Across::Least, &texts, "0"), "-1.5");
        assert_eq!(text(Across::Greatest, &texts, "0"), "7");
        assert_eq!(text(Across::Spread, &texts, "0"), "8.5");
        assert_eq!(text(Across::Spread, &["2.5", "0.5"], "0"), "2.0", "no count");
        let mut rows = values(&texts, "1e-9");
        let spread = across(Across::Spread, &rows, &rows).unwrap();
        assert_eq!(spread.bound, Figures::read("2e-9").map(|figures| figures.value));
        rows[1].bound = None;
        assert_eq!(across(Across::Least, &rows, &rows).unwrap().bound, None);
    }

    #[test]
    fn a_trend_is_only_what_is_certain_of_it() {
        assert_eq!(text(Across::Trend, &["1.0", "2.0", "3.5"], "1e-3"), "increases");
        assert_eq!(text(Across::Trend, &["3.5", "2.0", "1.0"], "1e-3"), "decreases");
        assert_eq!(text(Across::Trend, &["1.0", "2.0", "1.5"], "1e-3"), "neither");
        assert_eq!(
            text(Across::Trend, &["1.0", "2.0", "2.001"], "1e-3"),
            "",
            "too near to tell"
        );
        let mut rows = values(&["1.0", "1.5", "2.0", "1.9"], "1e-3");
        rows[1].bound = None;
        assert_eq!(
            across(Across::Trend, &rows, &rows).unwrap().text,
            "neither",
            "whatever the second row is"
        );
        rows[3].text = "2.1".to_owned();
        assert_eq!(across(Across::Trend, &rows, &rows).unwrap().text, "");
    }

    #[test]
    fn rows_are_counted_where_none_is_in_doubt() {
        let mut all = values(&["0.0", "-0.5", "0.0"], "1e-9");
        let count = |rows: &[Value], all: &[Value]| across(Across::Count, rows, all).map(|value| value.text);
        assert_eq!(count(&all[..1], &all).as_deref(), Ok("1"));
        assert_eq!(count(&[], &all).as_deref(), Ok("0"));
        all[1].bound = None;
        assert_eq!(count(&all[..1], &all).as_deref(), Ok(""), "the second might be 0 too");
    }

    #[test]
    fn what_has_no_answer_says_why() {
        assert_eq!(text(Across::Least, &[], "0"), "no row is meant");
        assert_eq!(text(Across::Trend, &["1.0"], "0"), "one row has no trend");
        assert_eq!(text(Across::Spread, &["1.0", "BT"], "0"), "`BT` is no number");
    }
}
