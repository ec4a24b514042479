//! A command's table as golden values see it: every field as CSV prints it, and the row that is meant.

use super::across::across;
use super::figures::{Figures, rounded, size};
use super::quantity::{FieldName, Quantity};
use super::setting::{Selector, Setting, Wanted};
use super::value::{Value, bound};
use num_traits::Zero;
use numbers::{Field, Rational};
use texmath::nearest;

/// A table with its fields as CSV prints them, so that each reads back to the same value.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Computed {
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The rows, each as long as the columns.
    pub rows: Vec<Vec<String>>,
    /// What the command has to say of its rows besides, for the reason of a row.
    pub note: String,
    /// The column whose values are those of a sweep, and the step between two of them.
    pub swept: Option<(String, Rational)>,
}

/// The columns that tell the rows of a table apart, in the order in which errors list them.
const TELLING: [&str; 9] = [
    "label",
    "kind",
    "word",
    "periods",
    "d",
    "velocities",
    "stable",
    "admissible",
    "verdict",
];

/// The places after the point in which distances are told.
const PLACES: i32 = 9;

/// The most rows that an error lists.
const MOST_LISTED: usize = 8;

type Narrowed<'a> = (Vec<&'a Vec<String>>, Option<Rational>);

impl Computed {
    /// The value of `quantity` in the row that `setting` names: of several, the stable admissible one; or what is asked
    /// of all rows that its selectors name.
    ///
    /// # Errors
    /// A message for a person: no such column or index, no row or several (they are listed), an extreme of words.
    pub fn value(&self, quantity: &Quantity, setting: &Setting) -> Result<Value, String> {
        let rows = self.meant(quantity, setting)?;
        if let Some(asked) = quantity.across {
            let of = |row: &Vec<String>| self.of_row(row, &quantity.field);
            let values: Vec<Value> = rows.iter().map(|row| of(row)).collect::<Result<_, String>>()?;
            let all: Vec<Value> = self.rows.iter().filter_map(|row| of(row).ok()).collect();
            return across(asked, &values, &all)
                .map_err(|message| format!("`{quantity}`: {message}; {}", self.listed(rows.iter().copied())));
        }
        match rows.as_slice() {
            [row] => self.of_row(row, &quantity.field),
            [] => Err(format!("no row is meant; {}", self.listed(self.rows.iter()))),
            several => Err(format!(
                "{} rows are meant, `row.column=value` in `set` names one; {}",
                several.len(),
                self.listed(several.iter().copied())
            )),
        }
    }

    /// The rows that `setting` names: of several, the stable admissible ones, where one is asked for.
    fn meant(&self, quantity: &Quantity, setting: &Setting) -> Result<Vec<&Vec<String>>, String> {
        let mut rows: Vec<&Vec<String>> = self.rows.iter().collect();
        for selector in &setting.selectors {
            (rows, _) = self.narrow(rows, selector)?;
        }
        if rows.len() > 1 && quantity.across.is_none() {
            for column in ["stable", "admissible"] {
                if let Some(index) = self.column(column) {
                    rows.retain(|row| row.get(index).is_some_and(|field| field == "true"));
                }
            }
        }
        Ok(rows)
    }

    /// The row and the entry of a list that `quantity` picked, for a person: its number of how many, what tells it from
    /// others, and the list. Of several rows at once, how many; nothing where there was no choice.
    pub fn picked(&self, quantity: &Quantity, setting: &Setting) -> String {
        let Ok(rows) = self.meant(quantity, setting) else {
            return String::new();
        };
        let (all, field) = (self.rows.len(), &quantity.field);
        let [row] = rows.as_slice() else {
            return format!("{} of {all} rows", rows.len());
        };
        let number = self
            .rows
            .iter()
            .position(|own| std::ptr::eq(own, *row))
            .map_or(0, |place| place + 1);
        let tells = self.tells(row).filter(|told| !told.starts_with("velocities="));
        let tells = tells.collect::<Vec<_>>().join(" ");
        let row_of_all = (all > 1).then(|| {
            format!("row {number} of {all}: {tells}")
                .trim_end_matches(": ")
                .to_owned()
        });
        let list = self.column(&field.column).and_then(|column| row.get(column));
        let entry = field
            .index
            .zip(list)
            .map(|_| format!("{field} of {}", list.map_or("", String::as_str)));
        row_of_all.into_iter().chain(entry).collect::<Vec<_>>().join("; ")
    }

    /// How far the rows that `setting` names are from the numbers that it calls near; empty where they are there.
    ///
    /// # Errors
    /// As [`Computed::value`].
    pub fn distances(&self, setting: &Setting) -> Result<String, String> {
        let (mut rows, mut told) = (self.rows.iter().collect(), Vec::new());
        for selector in &setting.selectors {
            let least;
            (rows, least) = self.narrow(rows, selector)?;
            if let (Wanted::Nearest(wanted), Some(least)) = (&selector.wanted, least.filter(|least| !least.is_zero())) {
                let wanted = rounded(&wanted.value, wanted.places);
                told.push(format!(
                    "{} is {:.1e} from {wanted}",
                    selector.field,
                    least.0.to_f64().value()
                ));
            }
        }
        Ok(told.join(", "))
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }

    /// The rows that a selector leaves, and how far the nearest of them is from its number.
    fn narrow<'a>(&'a self, rows: Vec<&'a Vec<String>>, selector: &Selector) -> Result<Narrowed<'a>, String> {
        let mut found = Vec::new();
        for row in rows {
            // A word with fewer impacts has no such velocity: it is not the one that is meant.
            let text = self.text(row, &selector.field, true)?;
            let number = Figures::read(&text).map(|figures| figures.value);
            let distance = |wanted: &Figures| number.clone().map(|number| size(number - wanted.value.clone()));
            match &selector.wanted {
                Wanted::Word(word) if *word == text => found.push((row, Rational::zero())),
                Wanted::Number(wanted) => {
                    let half = wanted.unit() / Rational::from_integer(2);
                    found.extend(
                        distance(wanted)
                            .filter(|distance| *distance <= half)
                            .map(|_| (row, Rational::zero())),
                    );
                }
                Wanted::Nearest(wanted) => found.extend(distance(wanted).map(|distance| (row, distance))),
                Wanted::Word(_) => {}
            }
        }
        let least = found.iter().map(|(_, distance)| distance.clone()).min();
        if let (Wanted::Nearest(wanted), Some(least)) = (&selector.wanted, &least) {
            self.is_near(wanted, selector, &found, least)?;
        }
        found.retain(|(_, distance)| Some(distance) == least.as_ref());
        Ok((found.into_iter().map(|(row, _)| row).collect(), least))
    }

    /// Whether what is nearest is near enough: a value of a sweep is meant within half a step, an event wherever it is.
    fn is_near(
        &self,
        wanted: &Figures,
        selector: &Selector,
        found: &[(&Vec<String>, Rational)],
        least: &Rational,
    ) -> Result<(), String> {
        let Some((column, step)) = self
            .swept
            .as_ref()
            .filter(|(column, _)| *column == selector.field.column)
        else {
            return Ok(());
        };
        let kind = |row: &Vec<String>| self.column("kind").and_then(|index| row.get(index).cloned());
        let is_value = |row: &Vec<String>| kind(row).is_none_or(|kind| kind == "point");
        let nearest = found.iter().find(|(_, distance)| distance == least);
        if least.clone() + least.clone() <= *step || !nearest.is_some_and(|(row, _)| is_value(row)) {
            return Ok(());
        }
        let [wanted, apart, step] = [&wanted.value, least, step].map(|value| rounded(value, PLACES));
        Err(format!(
            "no value of the sweep is near {column} = {wanted}: the nearest is {apart} away, and the step is {step}"
        ))
    }

    /// The field of a row as text; where `shorter` rows are allowed, an index beyond the list gives none.
    fn text(&self, row: &[String], field: &FieldName, shorter: bool) -> Result<String, String> {
        let column = self.column(&field.column).ok_or_else(|| {
            let meant = nearest(&field.column, self.columns.iter().map(String::as_str));
            let meant = meant.map_or(String::new(), |meant| format!("did you mean `{meant}`? "));
            format!(
                "there is no column `{}`; {meant}there are {}",
                field.column,
                self.columns.join(", ")
            )
        })?;
        let text = row.get(column).map_or("", String::as_str);
        let list: Vec<&str> = text.split(';').collect();
        match field.index {
            None if list.len() > 1 => Err(format!(
                "`{field}` is the list {text}; say which, from {field}[0] to {field}[{}]",
                list.len() - 1
            )),
            None => Ok(text.to_owned()),
            Some(index) => match list.get(index) {
                Some(text) => Ok((*text).to_owned()),
                None if shorter => Ok(String::new()),
                None => Err(format!("there is no `{field}`: `{}` is {text}", field.column)),
            },
        }
    }

    fn of_row(&self, row: &[String], field: &FieldName) -> Result<Value, String> {
        let text = self.text(row, field, false)?;
        let field = |name| {
            self.column(name)
                .and_then(|index| row.get(index))
                .map_or("", String::as_str)
        };
        let bound = bound(&text, field("error_bound"), field("digits"));
        Ok(Value { text, bound })
    }

    /// The fields that tell a row from others, as `column=field`.
    fn tells<'a>(&'a self, row: &'a [String]) -> impl Iterator<Item = String> + 'a {
        TELLING.iter().filter_map(|name| {
            let field = row.get(self.column(name)?).filter(|field| !field.is_empty())?;
            Some(format!("{name}={field}"))
        })
    }

    fn listed<'a>(&self, rows: impl Iterator<Item = &'a Vec<String>>) -> String {
        let mut rows: Vec<String> = rows.map(|row| self.tells(row).collect::<Vec<_>>().join(" ")).collect();
        let left = rows.len().saturating_sub(MOST_LISTED);
        rows.truncate(MOST_LISTED);
        if rows.is_empty() {
            return "the table has no rows".to_owned();
        }
        let more = if left > 0 {
            format!("; and {left} more")
        } else {
            String::new()
        };
        format!("there are: {}{more}", rows.join("; "))
    }
}

#[cfg(test)]
mod tests {
    use super::super::records;
    use super::*;

    fn table() -> Computed {
        let row = |fields: &[&str]| fields.iter().map(|&field| field.to_owned()).collect::<Vec<_>>();
        Computed {
            columns: row(&[
                "word",
                "periods",
                "d",
                "velocities",
                "stable",
                "admissible",
                "error_bound",
            ]),
            rows: vec![
                row(&["BT", "1", "0.26", "0.6774485;-0.5147685", "true", "true", "1e-9"]),
                row(&["BT", "1", "0.26", "0.2;-0.05", "false", "true", "1e-9"]),
                row(&["BTT", "1", "0.2513", "0.7;-0.5;-0.1", "true", "false", ""]),
            ],
            note: String::new(),
            swept: None,
        }
    }

    fn value(quantity: &str, set: &str) -> Result<Value, String> {
        let text = format!("id,set\na,{set}\n");
        let records = records::read("x.csv", &text, &["id", "set"]).map_err(|fault| fault.to_string())?;
        let setting = Setting::read(records.first().ok_or("none")?).map_err(|fault| fault.to_string())?;
        let quantity: Quantity = quantity.parse().map_err(|error| format!("{error}"))?;
        table().value(&quantity, &setting)
    }

    fn text(quantity: &str, set: &str) -> String {
        value(quantity, set).map_or_else(|message| message, |value| value.text)
    }

    #[test]
    fn the_row_and_the_entry_that_were_picked_are_said() {
        let table = Computed {
            columns: ["word", "phases"].map(str::to_owned).to_vec(),
            rows: ["BT", "BTT"]
                .map(|word| vec![word.to_owned(), "0.1;0.2".to_owned()])
                .to_vec(),
            note: String::new(),
            swept: None,
        };
        let picked = |quantity: &str, set: &str| {
            let text = format!("id,set\na,{set}\n");
            let records = records::read("f", &text, &["id", "set"]).unwrap();
            table.picked(&quantity.parse().unwrap(), &Setting::read(&records[0]).unwrap())
        };
        assert_eq!(
            picked("orbits.phases[1]", "row.word=BTT"),
            "row 2 of 2: word=BTT; phases[1] of 0.1;0.2"
        );
        assert_eq!(picked("orbits.word", "row.word=BT"), "row 1 of 2: word=BT");
        assert_eq!(picked("orbits.phases[0].max", ""), "2 of 2 rows");
    }

    #[test]
    fn of_several_rows_the_stable_admissible_one_is_meant_unless_the_set_names_another() {
        assert_eq!(text("orbits.velocities[0]", ""), "0.6774485");
        assert_eq!(text("orbits.velocities[2]", "row.word=BTT"), "-0.1");
        assert_eq!(text("orbits.velocities[1]", "row.stable=false"), "-0.05");
        assert_eq!(text("orbits.word", "row.velocities[2]=-0.1"), "BTT");
        assert_eq!(text("orbits.word", "row.d=0.251"), "BTT");
        assert_eq!(text("orbits.word", "row.d=near 0.1"), "BTT");
        assert_eq!(text("orbits.velocities[0].min", ""), "0.2");
        assert_eq!(text("orbits.velocities[1].max", "row.word=BT"), "-0.05");
    }

    #[test]
    fn near_a_value_of_a_sweep_is_within_half_a_step_and_an_event_is_near_wherever_it_is() {
        let kinds = ["point", "point", "point", "fold"];
        let rows = kinds.iter().zip(["0.1", "0.2", "0.3", "0.37"]);
        let table = Computed {
            columns: ["kind", "d"].map(str::to_owned).to_vec(),
            rows: rows.map(|(kind, d)| vec![(*kind).to_owned(), d.to_owned()]).collect(),
            note: String::new(),
            swept: Figures::read("0.1").map(|step| ("d".to_owned(), step.value)),
        };
        let d = |set: &str| {
            let records = records::read("x.csv", &format!("id,set\na,{set}\n"), &["id", "set"]).unwrap();
            let setting = Setting::read(&records[0]).unwrap();
            table
                .value(&"branch.d".parse().unwrap(), &setting)
                .map(|value| value.text)
        };
        assert_eq!(d("row.kind=point;row.d=near 0.24").as_deref(), Ok("0.2"));
        assert_eq!(d("row.kind=fold;row.d=near 0.9").as_deref(), Ok("0.37"));
        let records = records::read("x.csv", "id,set\na,row.kind=fold;row.d=near 0.9\n", &["id", "set"]).unwrap();
        let far = table.distances(&Setting::read(&records[0]).unwrap());
        assert_eq!(far.as_deref(), Ok("d is 5.3e-1 from 0.9"));
        let far = d("row.kind=point;row.d=near 0.36").unwrap_err();
        assert!(
            far.contains("the nearest is 0.06") && far.contains("the step is 0.1"),
            "{far}"
        );
    }

    #[test]
    fn none_or_two_rows_are_an_error_that_lists_them() {
        let none = text("orbits.d", "row.word=BBT");
        assert!(
            none.starts_with("no row is meant; there are: word=BT periods=1 d=0.26"),
            "{none}"
        );
        let mut doubled = table();
        doubled.rows = vec![doubled.rows.first().cloned().unwrap_or_default(); 11];
        let quantity: Result<Quantity, _> = "orbits.d".parse();
        let two = quantity.map(|quantity| doubled.value(&quantity, &Setting::default()));
        assert!(
            matches!(&two, Ok(Err(message)) if message.starts_with("11 rows are meant") && message.ends_with("and 3 more")),
            "{two:?}"
        );
    }

    #[test]
    fn columns_and_places_in_lists_are_never_guessed() {
        assert!(text("orbits.velocity", "").contains("there are word, periods"));
        assert!(text("orbits.velocities", "").contains("say which, from velocities[0] to velocities[1]"));
        assert!(text("orbits.velocities[2]", "").contains("there is no `velocities[2]`"));
        assert!(text("orbits.word.max", "").contains("no number"));
        assert!(text("orbits.d", "row.speed=1").contains("no column `speed`"));
    }

    #[test]
    fn a_value_knows_how_far_it_may_be_wrong() {
        let bound = |quantity: &str, set: &str| value(quantity, set).ok().and_then(|value| value.bound);
        assert_eq!(bound("orbits.velocities[0]", "row.word=BTT"), None, "nothing certified");
        assert_eq!(
            bound("orbits.periods", "row.word=BTT"),
            Some(Rational::zero()),
            "a count"
        );
        assert_eq!(bound("orbits.word", "row.word=BTT"), Some(Rational::zero()), "a word");
        let certified = Figures::read("1e-9").map(|figures| figures.value);
        assert!(bound("orbits.velocities[0]", "") > certified);
        assert_eq!(
            bound("orbits.velocities[0].min", ""),
            None,
            "one of the rows is not certified"
        );
    }
}
