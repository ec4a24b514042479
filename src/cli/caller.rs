//! A program that asks in place of a shell: what it gives stands for stdin, and what stderr would say it is told.

use super::answer::Copied;
use super::{Command, Content, Exit, Failure, Line, described};
use crate::report::{Column, Frame, Page, Part, Table, Values, forget_inputs};
use crate::stop::Token;
use std::cell::RefCell;
use std::ffi::OsString;
use std::sync::{Mutex, PoisonError};

/// The cells of all rows that are held at once, at most: some hundred MB.
const MOST_CELLS: usize = 20_000_000;

thread_local! {
    static CALLER: RefCell<Option<Caller>> = const { RefCell::new(None) };
}

/// What stands for stdin and for stderr of this thread.
struct Caller {
    input: Option<Input>,
    notes: Vec<String>,
}

/// A text in place of stdin.
#[derive(Clone, Debug)]
pub struct Input {
    /// How errors name it.
    pub name: String,
    /// The text.
    pub text: String,
}

/// What a command found, as data.
#[derive(Debug)]
pub struct Reply {
    /// Its tables: of a document with printed numbers two, of what is no table none.
    pub tables: Vec<Frame>,
    /// The page, where `--format html` asks for one.
    pub page: Option<String>,
    /// Text that has one form only: a figure, a proof, a scene.
    pub text: Option<String>,
    /// Whether all is as expected.
    pub exit: Exit,
    /// What stderr would say.
    pub notes: Vec<String>,
}

/// Looks at the input of the program that asks, where one does.
pub(super) fn with_input<R>(look: impl FnOnce(&Input) -> R) -> Option<R> {
    CALLER.with_borrow(|caller| caller.as_ref()?.input.as_ref().map(look))
}

/// Returns true if a program asks, and no shell.
pub(super) fn is_there() -> bool {
    CALLER.with_borrow(Option::is_some)
}

/// Whether a program hears the message, so that stderr need not.
pub(super) fn hears(text: &str) -> bool {
    CALLER.with_borrow_mut(|caller| match caller {
        Some(caller) => {
            caller.notes.push(text.to_owned());
            true
        }
        None => false,
    })
}

/// Puts back what was there, after a panic as well.
struct Before(Option<Caller>);

impl Drop for Before {
    fn drop(&mut self) {
        CALLER.set(self.0.take());
    }
}

/// Runs `work` with `input` in place of stdin, and returns what stderr would say with its result.
pub(super) fn during<R>(input: Option<Input>, work: impl FnOnce() -> R) -> (R, Vec<String>) {
    let notes = Vec::new();
    let _before = Before(CALLER.replace(Some(Caller { input, notes })));
    let found = work();
    (found, CALLER.take().map(|caller| caller.notes).unwrap_or_default())
}

/// Works, and says nothing meanwhile.
pub(super) fn quietly<R>(work: impl FnOnce() -> R) -> R {
    during(None, work).0
}

/// The number of command lines that are being answered in this process.
static ANSWERING: Mutex<usize> = Mutex::new(0);

/// A command line that is being answered.
struct Answering;

impl Answering {
    /// Begins an answer. Inputs of earlier answers are forgotten, unless another answer still reads its own.
    fn begin() -> Self {
        let mut count = ANSWERING.lock().unwrap_or_else(PoisonError::into_inner);
        if *count == 0 {
            forget_inputs();
        }
        *count += 1;
        Self
    }
}

impl Drop for Answering {
    fn drop(&mut self) {
        *ANSWERING.lock().unwrap_or_else(PoisonError::into_inner) -= 1;
    }
}

/// Answers a command line, the program's name first, as data: the tables, the page, the text that the command would print.
/// `-` is `input`, where there is one. It stops with the current [`Token`].
///
/// ```
/// use vibro_audit::cli::{Input, ask};
///
/// let text = "[motion]\ng = 0.122\nd = 0.4\nr_b = 0.5\nr_t = 0.5\n".to_owned();
/// let scene = Input { name: "my scene".to_owned(), text };
/// let reply = ask(["vibro-audit", "orbits", "-"].map(Into::into), Some(scene))?;
/// assert_eq!(reply.tables[0].rows, 2);
/// # Ok::<(), vibro_audit::cli::Failure>(())
/// ```
///
/// # Errors
/// A command line or an input that cannot be used, and more than memory should hold.
pub fn ask(arguments: impl IntoIterator<Item = OsString>, input: Option<Input>) -> Result<Reply, Failure> {
    let line = line(arguments)?;
    if matches!(line.command, Some(Command::Lsp(_) | Command::Mcp(_))) {
        return Err(Failure::Usage(
            "a server has standard input and output for itself: start it from a command line".to_owned(),
        ));
    }
    let _answering = Answering::begin();
    let (reply, notes) = during(input, || reply(&line));
    Ok(Reply { notes, ..reply? })
}

/// Reads a command line, the program's name first.
///
/// # Errors
/// A command line that cannot be used, in one sentence.
pub(super) fn line(arguments: impl IntoIterator<Item = OsString>) -> Result<Line, Failure> {
    Line::read(arguments).map_err(|error| {
        let text = error.to_string();
        let said = text.strip_prefix("error: ").unwrap_or(&text);
        // what follows tells how to type a command
        Failure::Usage(said.split("\n\n").next().unwrap_or_default().trim_end().to_owned())
    })
}

fn reply(line: &Line) -> Result<Reply, Failure> {
    let answer = line.answer()?;
    let name = line.command.as_ref().and_then(|command| command.table());
    let mut reply = Reply {
        tables: Vec::new(),
        page: None,
        text: None,
        exit: answer.exit,
        notes: Vec::new(),
    };
    match answer.content {
        Content::Text(text) => reply.text = Some(text),
        Content::Copied(Copied(copy)) => {
            let mut bytes = Vec::new();
            copy(&mut bytes).map_err(Failure::Page)?;
            reply.text = Some(String::from_utf8_lossy(&bytes).into_owned());
        }
        Content::Table(table) => reply.tables.push(framed(name, table)),
        // the numbers that a document prints stand behind its verdicts
        Content::Tables(tables) => {
            let names = std::iter::once(name).chain(std::iter::repeat(Some("check")));
            reply.tables = names
                .zip(tables)
                .map(|(name, (_, table))| framed(name, table))
                .collect();
        }
        Content::Page(page) => {
            reply.page = Some(written(&page, line.options.figures())?);
            for (place, part) in page.parts.into_iter().enumerate() {
                if let Part::Formulas(table, ..) | Part::Table(.., table) = part {
                    let name = if place == 0 || name != Some("audit") {
                        name
                    } else {
                        Some("check")
                    };
                    reply.tables.push(framed(name, table));
                }
            }
        }
        Content::Unfinished(..) | Content::Recorded(..) => {
            return Err(Failure::Usage(
                "--resume writes to a file, on a command line".to_owned(),
            ));
        }
        Content::Rows(rows) => {
            let token = Token::current();
            let mut frame = empty(name, &rows.columns);
            let most = MOST_CELLS / rows.columns.len().max(1);
            // what follows has a command of its own
            let (is_met, _) = rows.each(|row| {
                frame.push(row);
                match frame.rows > most {
                    true => Err(Failure::TooManyCells { most: MOST_CELLS }),
                    false => Ok(!token.is_stopped()),
                }
            })?;
            if !is_met {
                reply.exit = Exit::NotAsExpected;
            }
            reply.tables.push(frame);
        }
    }
    Ok(reply)
}

fn written(page: &Page, figures: usize) -> Result<String, Failure> {
    let mut bytes = Vec::new();
    page.write(&mut bytes, figures).map_err(Failure::Page)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn framed(command: Option<&str>, table: Table) -> Frame {
    empty(command, table.columns()).with(table)
}

/// Columns of the types that are described.
fn empty(command: Option<&str>, columns: &[Column]) -> Frame {
    let known: Vec<_> = command.map(|name| described(name).collect()).unwrap_or_default();
    let column = |own: &Column| {
        let found = known.iter().find(|known| known.column == own.name);
        let values = Values::new(
            found.map(|found| found.form),
            found.is_some_and(|found| found.is_optional),
        );
        (own.name.clone(), values)
    };
    Frame {
        columns: columns.iter().map(column).collect(),
        rows: 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(line: &str, input: Option<&str>) -> Result<Reply, Failure> {
        let input = input.map(|text| Input {
            name: "given".to_owned(),
            text: text.to_owned(),
        });
        let words = std::iter::once("vibro-audit").chain(line.split(' '));
        ask(words.map(Into::into), input)
    }

    #[test]
    fn an_error_names_the_text_that_was_given_and_the_place_in_it() {
        let failure = asked("orbits -", Some("[motion]\nd = 0.4\nzeta = 1\n")).unwrap_err();
        assert_eq!(failure.place(), (Some("given"), Some(3), Some(1)), "{failure}");
        let failure = asked("audit -", Some("[[equation]]\nlabel = 3\n")).unwrap_err();
        assert!(matches!(failure.place(), (Some("given"), ..)), "{failure}");
        let failure = asked("orbits fig02 --digits many", None).unwrap_err();
        assert!(
            failure.to_string().contains("'many'") && !failure.to_string().contains("--help"),
            "{failure}"
        );
    }

    #[test]
    fn servers_are_refused() {
        for server in ["lsp", "mcp"] {
            assert!(asked(server, None).unwrap_err().to_string().contains("command line"));
        }
    }

    #[test]
    fn notes_are_heard_and_nothing_stays_behind() {
        let reply = asked(
            "orbits -",
            Some("words = ['B']\n[motion]\ng = 0.1\nd = 0.4\nr_b = 0.5\nr_t = 0.5\n"),
        )
        .unwrap();
        assert!(!reply.notes.is_empty());
        assert!(!hears("afterwards") && with_input(|_| ()).is_none());
    }

    #[test]
    fn more_rows_than_memory_should_hold_are_refused_on_the_way() {
        let failure = asked("simulate fig03 --impacts 1000000000000", None).unwrap_err();
        assert!(matches!(failure, Failure::TooManyCells { .. }), "{failure}");
    }

    #[test]
    fn what_is_no_table_is_text_and_an_audit_has_its_page() {
        let reply = asked("scenes fig02", None).unwrap();
        assert!(reply.tables.is_empty() && reply.text.unwrap().contains("[device]"));
        let reply = asked("audit --format html", None).unwrap();
        assert!(reply.page.unwrap().starts_with("<!DOCTYPE html>"));
        assert_eq!(reply.tables.len(), 1);
        let names: Vec<&str> = reply.tables[0].columns.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!((names[0], names.len()), ("label", 12));
    }
}
