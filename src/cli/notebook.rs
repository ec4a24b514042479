//! Jupyter notebooks as documents: their Markdown cells.

use serde::Deserialize;

/// A notebook of nbformat 4, as far as it is read.
#[derive(Deserialize)]
struct Notebook {
    cells: Vec<Cell>,
}

#[derive(Deserialize)]
struct Cell {
    cell_type: String,
    #[serde(default)]
    source: Lines,
}

/// A text, whole or line by line with the ends of lines.
#[derive(Deserialize)]
#[serde(untagged)]
enum Lines {
    Whole(String),
    Each(Vec<String>),
}

impl Default for Lines {
    fn default() -> Self {
        Self::Each(Vec::new())
    }
}

impl Lines {
    fn text(self) -> String {
        match self {
            Self::Whole(text) => text,
            Self::Each(lines) => lines.concat(),
        }
    }
}

/// Returns the Markdown cells of a notebook as one Markdown document. A line of it has the number that it has in the notebook,
/// where that is written as Jupyter does, one line of a cell to a line of the file; else its number within all Markdown cells,
/// an empty line after each.
///
/// # Errors
/// A text that is no notebook, with the reason.
pub fn markdown(notebook: &str) -> Result<String, String> {
    let read: Notebook = serde_json::from_str(notebook).map_err(|error| {
        format!("no notebook of Jupyter's format 4 ({error}); save it anew with Jupyter, or convert it with `jupyter nbconvert --to markdown`")
    })?;
    let cells = read.cells.into_iter().filter(|cell| cell.cell_type == "markdown");
    let cells: Vec<String> = cells.map(|cell| cell.source.text()).collect();
    Ok(in_place(notebook, &cells).unwrap_or_else(|| cells.join("\n\n")))
}

/// The cells with each line where it stands in the notebook; `None` unless all are found.
fn in_place(notebook: &str, cells: &[String]) -> Option<String> {
    let mut expected = cells.iter().flat_map(|cell| cell.lines()).peekable();
    let (mut found, mut is_markdown) = (String::new(), false);
    for line in notebook.lines() {
        let written = line.trim();
        if let Some(kind) = written.strip_prefix(r#""cell_type": "#) {
            is_markdown = kind.starts_with(r#""markdown""#);
        }
        let text: Option<String> = serde_json::from_str(written.trim_end_matches(',')).ok();
        if let Some(text) = text.filter(|_| is_markdown)
            && let Some(line) = expected.next_if_eq(&text.trim_end_matches(['\n', '\r']))
        {
            found.push_str(line);
        }
        found.push('\n');
    }
    expected.peek().is_none().then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A notebook as nbformat writes it.
    const WRITTEN: &str = r##"{
 "cells": [
  {
   "cell_type": "code",
   "execution_count": 1,
   "outputs": [{"text": ["$$ 1 = 2 $$"]}],
   "source": [
    "# Fall\n",
    "print('$$ 3 = 4 $$')"
   ]
  },
  {
   "cell_type": "markdown",
   "metadata": {},
   "source": [
    "# Fall\n",
    "\n",
    "$$ (a+b)^2 = a^2 + \\beta $$"
   ]
  }
 ],
 "metadata": {},
 "nbformat": 4,
 "nbformat_minor": 5
}
"##;

    #[test]
    fn a_line_of_a_markdown_cell_keeps_its_number() {
        let found = markdown(WRITTEN).unwrap();
        let lines: Vec<(usize, &str)> = (1..).zip(found.lines()).filter(|(_, line)| !line.is_empty()).collect();
        assert_eq!(lines, [(16, "# Fall"), (18, r"$$ (a+b)^2 = a^2 + \beta $$")]);
        assert_eq!(found.lines().count(), WRITTEN.lines().count());
    }

    #[test]
    fn a_notebook_in_one_line_is_read_cell_after_cell() {
        let short = r#"{"cells":[{"cell_type":"markdown","source":"$$ a = b $$"},{"cell_type":"markdown","source":["c\n","d"]},{"cell_type":"raw"}]}"#;
        assert_eq!(markdown(short).unwrap(), "$$ a = b $$\n\nc\nd");
    }

    #[test]
    fn what_is_no_notebook_is_refused_with_a_reason() {
        for text in ["", "{}", "[1]", "$$ a = b $$"] {
            let problem = markdown(text).unwrap_err();
            assert!(problem.contains("format 4"), "{text}: {problem}");
        }
    }
}
