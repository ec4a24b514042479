//! Answers as CSV: `problem,quantity,answer` and, if the writer likes, `seconds`.

use crate::problems::{Certified, Number, list};
use scenes::reference::Lines;
use std::collections::HashMap;

/// A file of answers that cannot be scored.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}{}{}: {message}", line.map(|line| format!(", line {line}")).unwrap_or_default(),
    column.map(|column| format!(", column {column}")).unwrap_or_default())]
pub struct AnswerError {
    /// The file as the user named it.
    pub file: String,
    /// The line, from 1.
    pub line: Option<u64>,
    /// The column by its name in the header.
    pub column: Option<&'static str>,
    /// What is wrong, and what would be right.
    pub message: String,
}

/// An answer as given.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Its value; none where no number is known: nothing at all, NaN or an infinity.
    pub value: Option<Number>,
    /// How long the problem took, s.
    pub seconds: Option<f64>,
}

/// Answers by problem and quantity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers(HashMap<(String, String), Given>);

const PROBLEM: &str = "problem";
const QUANTITY: &str = "quantity";
const ANSWER: &str = "answer";
const SECONDS: &str = "seconds";

/// Where the columns stand that are read.
struct Header {
    problem: usize,
    quantity: usize,
    answer: usize,
    seconds: Option<usize>,
    columns: usize,
}

impl Answers {
    /// The answers in `text`, named `file` in errors, to what is `asked`. Columns in any order; other columns, and other
    /// problems of the list, are passed over.
    ///
    /// # Errors
    /// No header, a column missing or twice, a row of another length, a problem or a quantity that there is not, one
    /// that is answered twice, an answer that is no number, seconds that are none or negative.
    pub fn read(file: &str, text: &str, asked: &[Certified]) -> Result<Self, AnswerError> {
        let reading = Reading { file, asked };
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            return Err(reading.error(None, "it is empty; its header is problem,quantity,answer".to_owned()));
        }
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut lines = Lines::new(text);
        let mut header = None;
        let (mut answers, mut seen) = (HashMap::new(), HashMap::new());
        let mut row = csv::StringRecord::new();
        while reader
            .read_record(&mut row)
            .map_err(|error| reading.error(None, error.to_string()))?
        {
            lines.to(row.position().map_or(0, csv::Position::byte));
            let Some(header) = &header else {
                header = Some(reading.header(&row)?);
                continue;
            };
            let Some((key, given)) = reading.row(header, &row, lines.line)? else {
                continue;
            };
            if let Some(first) = seen.insert(key.clone(), lines.line) {
                let (problem, quantity) = key;
                let message = format!("{problem} {quantity} is answered on line {first} already; answer each once");
                return Err(reading.error(Some(lines.line), message));
            }
            answers.insert(key, given);
        }
        Ok(Self(answers))
    }

    /// The answer to a quantity of a problem.
    pub fn get(&self, problem: &str, quantity: &str) -> Option<&Given> {
        self.0.get(&(problem.to_owned(), quantity.to_owned()))
    }

    /// How many quantities are answered.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether nothing is answered.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// Problem and quantity, and what is given for them.
type Row = ((String, String), Given);

/// What the rows are read against.
struct Reading<'a> {
    file: &'a str,
    asked: &'a [Certified],
}

impl Reading<'_> {
    fn error(&self, line: Option<u64>, message: String) -> AnswerError {
        AnswerError {
            file: self.file.to_owned(),
            line,
            column: None,
            message,
        }
    }

    fn header(&self, row: &csv::StringRecord) -> Result<Header, AnswerError> {
        let of = |name: &str| {
            let mut places = row.iter().enumerate().filter(|(_, field)| *field == name);
            let place = places.next().map(|(index, _)| index);
            match places.next() {
                Some(_) => Err(self.error(Some(1), format!("the header has `{name}` twice"))),
                None => Ok(place),
            }
        };
        let needed = |name: &str| {
            let missing = || format!("the header has no `{name}`; it is problem,quantity,answer in any order");
            of(name)?.ok_or_else(|| self.error(Some(1), missing()))
        };
        Ok(Header {
            problem: needed(PROBLEM)?,
            quantity: needed(QUANTITY)?,
            answer: needed(ANSWER)?,
            seconds: of(SECONDS)?,
            columns: row.len(),
        })
    }

    fn row(&self, header: &Header, row: &csv::StringRecord, line: u64) -> Result<Option<Row>, AnswerError> {
        let fault = |message: String| self.error(Some(line), message);
        let within = |column: &'static str, message: String| AnswerError {
            column: Some(column),
            ..fault(message)
        };
        if row.len() != header.columns {
            let (found, wanted) = (row.len(), header.columns);
            return Err(fault(format!("{found} fields where the header has {wanted}")));
        }
        let field = |index: usize| row.get(index).unwrap_or_default();
        let (problem, quantity) = (field(header.problem), field(header.quantity));
        let Some(known) = self.asked.iter().find(|known| known.problem.name == problem) else {
            let is_other = list().iter().any(|known| known.name == problem);
            let none = || {
                within(
                    PROBLEM,
                    format!("there is no problem `{problem}`; `problems` lists them"),
                )
            };
            return if is_other { Ok(None) } else { Err(none()) };
        };
        if !known.answers.iter().any(|answer| answer.quantity == quantity) {
            let asked: Vec<&str> = known.answers.iter().map(|answer| answer.quantity.as_str()).collect();
            let asked = asked.join(", ");
            let message = format!("{problem} has no quantity `{quantity}`; it asks for {asked}");
            return Err(within(QUANTITY, message));
        }
        let value = value(field(header.answer)).map_err(|message| within(ANSWER, message))?;
        let seconds = header
            .seconds
            .map_or(Ok(None), |index| seconds(field(index)))
            .map_err(|message| within(SECONDS, message))?;
        Ok(Some((
            (problem.to_owned(), quantity.to_owned()),
            Given { value, seconds },
        )))
    }
}

/// What stands for no number, as C, Fortran, Python and others print it.
const NO_NUMBER: [&str; 4] = ["", "nan", "inf", "infinity"];

fn value(text: &str) -> Result<Option<Number>, String> {
    let size = text.strip_prefix(['-', '+']).unwrap_or(text).to_ascii_lowercase();
    if NO_NUMBER.contains(&size.as_str()) {
        return Ok(None);
    }
    let read = Number::parse(text).filter(Number::is_valid);
    let message = || format!("the answer `{text}` is no number such as -0.25, 1.5e-7 or NaN");
    read.map(Some).ok_or_else(message)
}

fn seconds(text: &str) -> Result<Option<f64>, String> {
    if text.is_empty() {
        return Ok(None);
    }
    let read = text
        .parse()
        .ok()
        .filter(|seconds: &f64| seconds.is_finite() && *seconds >= 0.0);
    let message = || format!("the seconds `{text}` are no number from 0 on, such as 0.004");
    read.map(Some).ok_or_else(message)
}

#[cfg(test)]
mod tests {
    use super::super::rating::tests::known;
    use super::*;
    use numbers::Analytic;

    fn read(text: &str) -> Result<Answers, AnswerError> {
        Answers::read("a.csv", text, &known())
    }

    #[test]
    fn columns_stand_in_any_order_and_others_are_passed_over() {
        let text = "\u{feff}note, answer ,quantity,problem,seconds\r\n\r\n\"a, b\", 0.5,time,one,1e-3\r\nx,-1.5e+2,velocity,one,\r\n";
        let answers = read(text).unwrap();
        let time = answers.get("one", "time").unwrap();
        assert_eq!(time.seconds, Some(1e-3));
        assert_eq!(time.value.as_ref().map(Analytic::to_f64), Some(0.5));
        let velocity = answers.get("one", "velocity").unwrap();
        assert_eq!(velocity.value.as_ref().map(Analytic::to_f64), Some(-150.0));
        assert_eq!((velocity.seconds, answers.len()), (None, 2));
    }

    #[test]
    fn a_problem_that_is_not_asked_is_passed_over() {
        let answers = read("problem,quantity,answer\norbit-node,whatever,7\none,time,1\n").unwrap();
        assert_eq!(answers.len(), 1);
    }

    #[test]
    fn a_header_alone_answers_nothing() {
        assert!(read("problem,quantity,answer").unwrap().is_empty());
    }

    #[test]
    fn no_number_is_an_answer_without_a_value() {
        for text in ["", "nan", "NaN", "-NAN", "inf", "-Inf", "Infinity", "+inf"] {
            let answers = read(&format!("problem,quantity,answer\none,time,{text}\n")).unwrap();
            assert_eq!(answers.get("one", "time").unwrap().value, None, "{text}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_named_with_its_line() {
        for (text, words) in [
            ("", "a.csv: it is empty"),
            (" \n\n", "a.csv: it is empty"),
            ("one,time,1\n", "a.csv, line 1: the header has no `problem`"),
            ("problem,quantity\n", "a.csv, line 1: the header has no `answer`"),
            (
                "problem,answer,quantity,answer\n",
                "a.csv, line 1: the header has `answer` twice",
            ),
            (
                "problem,quantity,answer\r\n\r\none,time\r\n",
                "a.csv, line 3: 2 fields where the header has 3",
            ),
            (
                "problem,quantity,answer\ntwo,time,1\n",
                "a.csv, line 2, column problem: there is no problem `two`",
            ),
            (
                "problem,quantity,answer\none,mass,1\n",
                "one has no quantity `mass`; it asks for time, velocity, phase",
            ),
            (
                "problem,quantity,answer\none,time,1\n\none,time,1\n",
                "line 4: one time is answered on line 2 already",
            ),
            (
                "problem,quantity,answer\none,time,1d-3\n",
                "line 2, column answer: the answer `1d-3` is no number",
            ),
            (
                "problem,quantity,answer\none,time,fast\n",
                "the answer `fast` is no number",
            ),
            ("problem,quantity,answer\none,time,1_0\n", "no number"),
            ("problem,quantity,answer\none,time,1e\n", "no number"),
            ("problem,quantity,answer\none,time,0x1p3\n", "no number"),
            ("problem,quantity,answer\none,time,1e999999999\n", "no number"),
            (
                "problem,quantity,answer,seconds\none,time,1,-1\n",
                "the seconds `-1` are no number from 0 on",
            ),
            (
                "problem,quantity,answer,seconds\none,time,1,soon\n",
                "the seconds `soon`",
            ),
        ] {
            let found = read(text).map_or_else(|error| error.to_string(), |answers| format!("{answers:?}"));
            assert!(found.contains(words), "{text:?}: {found}");
        }
    }

    #[test]
    fn any_size_of_number_is_read() {
        for text in [
            "1.0e5000",
            "-1e-5000",
            "+.5",
            "5.",
            "0",
            "12345678901234567890123456789012345678901234567890",
        ] {
            let answers = read(&format!("problem,quantity,answer\none,time,{text}\n")).unwrap();
            assert!(answers.get("one", "time").unwrap().value.is_some(), "{text}");
        }
    }
}
