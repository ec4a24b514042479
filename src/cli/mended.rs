//! A sheet or document written anew, with a repair as a comment before each formula that is refuted.

use super::document::Form;
use crate::claim::Sheet;
use crate::repair::Repair;
use std::path::Path;

/// How a comment is written, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comment {
    /// `# ...` before the key `tex`.
    Toml,
    /// `% ...` before the line of the formula.
    Tex,
    /// `<!-- ... -->` before the display.
    Markdown,
    /// The same, as a line of a cell.
    Notebook,
}

impl Comment {
    /// That of a file with this name.
    pub fn of(name: &str) -> Self {
        match Form::of_path(Path::new(name)) {
            Some(Form::Tex) => Self::Tex,
            Some(Form::Markdown) => Self::Markdown,
            Some(Form::Notebook) => Self::Notebook,
            None => Self::Toml,
        }
    }

    fn write(self, said: &str) -> String {
        match self {
            Self::Toml => format!("# {said}"),
            Self::Tex => format!("% {said}"),
            Self::Markdown => format!("<!-- {} -->", said.replace("--", "- -")),
            Self::Notebook => {
                let line = format!("{}\n", Self::Markdown.write(said));
                format!("{},", serde_json::Value::from(line))
            }
        }
    }

    /// Returns true if a formula in this line is told of before it, and not further up: the line that opens its display.
    fn opens(self, line: &str) -> bool {
        match self {
            Self::Toml | Self::Tex => true,
            Self::Markdown | Self::Notebook => {
                line.contains('$') || line.contains(r"\[") || line.trim_start().starts_with("```")
            }
        }
    }
}

/// A comment, and where its formula starts.
pub struct Said {
    /// The label of the formula.
    label: String,
    start: Start,
    text: String,
}

/// Where a formula starts in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Start {
    Line(usize),
    Byte(usize),
}

/// What is read of a file, by which it is told that a comment changes nothing.
#[derive(Debug, PartialEq)]
pub enum Content {
    Sheet(toml::Table),
    /// The TeX of each formula.
    Document(Vec<String>),
}

/// How many lines before a formula are tried for a comment.
const MOST_LINES: usize = 200;

/// Returns the text with these comments, each in a line of its own before its formula, where `read` gives what it gave before.
///
/// # Errors
/// The label of a formula before which no line takes a comment.
pub fn with_comments(
    text: &str,
    comment: Comment,
    mut said: Vec<Said>,
    read: &dyn Fn(&str) -> Option<Content>,
) -> Result<String, String> {
    let before = read(text);
    let line_of = |said: &Said| match said.start {
        Start::Line(line) => line.saturating_sub(1),
        Start::Byte(at) => text.get(..at).map_or(0, |before| before.matches('\n').count()),
    };
    // from the last on, so that the lines of the others stay
    said.sort_by_key(|said| std::cmp::Reverse(line_of(said)));
    let mut lines: Vec<String> = text.split_inclusive('\n').map(str::to_owned).collect();
    for said in said {
        let line = line_of(&said).min(lines.len().saturating_sub(1));
        let places = (0..=line).rev().take(MOST_LINES);
        let opening = places.filter(|place| lines.get(*place).is_some_and(|line| comment.opens(line)));
        let mut tried = opening.map(|place| with_comment(&lines, place, &comment.write(&said.text)));
        lines = tried.find(|lines| read(&lines.concat()) == before).ok_or(said.label)?;
    }
    Ok(lines.concat())
}

/// The lines with a comment before one of them, indented as that.
fn with_comment(lines: &[String], place: usize, comment: &str) -> Vec<String> {
    let mut lines = lines.to_vec();
    let line = lines.get(place).map_or("", String::as_str);
    let indent: String = line.chars().take_while(|c| matches!(c, ' ' | '\t')).collect();
    let end = if line.ends_with("\r\n") { "\r\n" } else { "\n" };
    lines.insert(place, format!("{indent}{comment}{end}"));
    lines
}

/// Returns what is said of the formula at a position; nothing of one that stands in another file.
pub fn said(sheet: &Sheet, position: usize, repair: &Repair, comment: Comment) -> Option<Said> {
    let entry = sheet.entries.get(position).filter(|entry| entry.tex.file.is_none())?;
    // in a sheet the first line of a formula may stand within a string of several
    let start = match (comment, sheet.span(position)) {
        (Comment::Toml, Some(span)) => Start::Byte(span.start),
        _ => Start::Line(entry.tex.place().0),
    };
    let text = format!("repair of ({}): {repair} ({})", entry.label, repair.words());
    Some(Said {
        label: entry.label.clone(),
        start,
        text: text.replace(char::is_control, " "),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(text: &str, name: &str, start: Start) -> Result<String, String> {
        let comment = Comment::of(name);
        let said = Said {
            label: "1".to_owned(),
            start,
            text: "repair of (1): $a--b$".to_owned(),
        };
        let read = |text: &str| match comment {
            Comment::Toml => text.parse().ok().map(Content::Sheet),
            _ => Some(Content::Document(Vec::new())),
        };
        with_comments(text, comment, vec![said], &read)
    }

    fn one(text: &str, name: &str, line: usize) -> String {
        with(text, name, Start::Line(line)).unwrap()
    }

    #[test]
    fn no_comment_is_written_into_a_string() {
        let comment = "# repair of (1): $a--b$\n";
        for (before, after) in [
            ("[[equation]]\nlabel = '1'\n", "tex = '''\ntex = 1\na = c'''\n"),
            ("[[equation]]\ntitle = '''\ntex = 'a = c'\n'''\n", "tex = 'a = c'\n"),
            ("equation = [\n", "{ label = \"\"\"\n1\"\"\", tex = 'a = c' },\n]\n"),
        ] {
            let text = format!("{before}{after}");
            let at = text.rfind("tex = '''").or(text.rfind("tex = 'a")).unwrap() + 6;
            assert_eq!(
                with(&text, "a.toml", Start::Byte(at)),
                Ok(format!("{before}{comment}{after}"))
            );
        }
        // no line before it is free
        let text = format!("x = '''{}'''\n", "\n".repeat(MOST_LINES + 10));
        assert_eq!(with(&text, "a.toml", Start::Byte(text.len() - 8)), Err("1".to_owned()));
    }

    #[test]
    fn a_comment_stands_before_the_formula_as_the_file_has_comments() {
        let toml = "[[equation]]\nlabel = '1'\ntex = '''\na = c'''\n";
        assert_eq!(
            one(toml, "a.toml", 4),
            "[[equation]]\nlabel = '1'\n# repair of (1): $a--b$\ntex = '''\na = c'''\n"
        );
        let tex = "\\begin{equation}\n  a = c\n\\end{equation}";
        assert_eq!(
            one(tex, "a.tex", 2),
            "\\begin{equation}\n  % repair of (1): $a--b$\n  a = c\n\\end{equation}"
        );
        let markdown = "Text\n$$\na = c\n$$\n";
        assert_eq!(
            one(markdown, "a.md", 3),
            "Text\n<!-- repair of (1): $a- -b$ -->\n$$\na = c\n$$\n"
        );
    }
}
