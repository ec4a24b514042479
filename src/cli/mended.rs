//! A sheet or document written anew, with a repair as a comment before each formula that is refuted.

use crate::claim::Sheet;
use crate::repair::Repair;
use std::collections::BTreeMap;

/// How a comment is written, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comment {
    /// `# ...` before the key `tex`.
    Toml,
    /// `% ...` before the line of the formula.
    Tex,
    /// `<!-- ... -->` before the display.
    Markdown,
}

impl Comment {
    /// That of a file with this name.
    pub fn of(name: &str) -> Self {
        match name.rsplit_once('.').map(|(_, extension)| extension) {
            Some("tex" | "ltx") => Self::Tex,
            Some("md" | "markdown") => Self::Markdown,
            _ => Self::Toml,
        }
    }

    fn write(self, said: &str) -> String {
        match self {
            Self::Toml => format!("# {said}"),
            Self::Tex => format!("% {said}"),
            Self::Markdown => format!("<!-- {} -->", said.replace("--", "- -")),
        }
    }

    /// The line before which the comment on a formula that starts in a line stands; from 0.
    fn place(self, lines: &[&str], line: usize) -> usize {
        let opens = |text: &str| match self {
            Self::Toml => text
                .strip_prefix("tex")
                .is_some_and(|rest| rest.trim_start().starts_with('=')),
            Self::Tex => true,
            Self::Markdown => text.contains("$$") || text.contains(r"\[") || text.starts_with("```"),
        };
        let before = lines.get(..=line).unwrap_or_default();
        before.iter().rposition(|text| opens(text.trim_start())).unwrap_or(line)
    }
}

/// The text with these comments, each with the line of its formula from 1.
pub fn with_comments(text: &str, comment: Comment, said: &[(usize, String)]) -> String {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let mut before: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    for (line, said) in said {
        let place = comment.place(&lines, line.saturating_sub(1));
        before.entry(place).or_default().push(comment.write(said));
    }
    let mut written = String::new();
    for (place, line) in lines.iter().enumerate() {
        let indent: String = line.chars().take_while(|c| matches!(c, ' ' | '\t')).collect();
        for said in before.get(&place).into_iter().flatten() {
            written.push_str(&format!("{indent}{said}\n"));
        }
        written.push_str(line);
    }
    written
}

/// What is said of the formula at a position, with its line; nothing of one that stands in another file.
pub fn said(sheet: &Sheet, position: usize, repair: &Repair) -> Option<(usize, String)> {
    let entry = sheet.entries.get(position).filter(|entry| entry.tex.file.is_none())?;
    let (line, _) = entry.tex.place();
    let said = format!("repair of ({}): {repair} ({})", entry.label, repair.words());
    Some((line, said.replace(['\n', '\r'], " ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str, name: &str, line: usize) -> String {
        with_comments(text, Comment::of(name), &[(line, "repair of (1): $a--b$".to_owned())])
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
