//! The guide is short and its links lead somewhere: lines, sentences and words have a limit.

use super::{File, assert_clean, files};
use std::path::{Component, Path, PathBuf};

const LONGEST_LINE: usize = 120;
const LONGEST_SENTENCE: usize = 30;
/// Words of all hand-written pages: without code, in blocks or between backquotes, and without pictures.
const MOST_WORDS: usize = 9_000;
/// Pages that the program writes, and the table of contents.
const GENERATED: [&str; 4] = [
    "doc/SUMMARY.md",
    "doc/reference/columns.md",
    "doc/reference/keys.md",
    "doc/reference/options.md",
];
/// The section that lists works with file and line: data.
const WORKS: &str = "## Works";

/// Returns the lines of a page without blocks of code and without the table that `.ci/trusted` writes.
fn prose(text: &str) -> Vec<&str> {
    let (mut inside, mut table) = (false, false);
    let is_prose = |line: &&str| {
        let fence = line.starts_with("```");
        inside ^= fence;
        table = (table || line.starts_with("<!-- .ci/trusted")) && !line.starts_with("<!-- end");
        !inside && !fence && !table && !line.starts_with("<!--")
    };
    text.lines().filter(is_prose).collect()
}

/// Returns a line with CODE for code, without pictures and without the targets of links.
fn plain(line: &str) -> String {
    let mut text = String::new();
    for (index, part) in line.replace("``", "`").split('`').enumerate() {
        text.push_str(if index % 2 == 1 { "CODE" } else { part });
    }
    while let Some((before, rest)) = text.split_once("![") {
        let after = rest.split_once(')').map_or("", |(_, after)| after);
        text = format!("{before}{after}");
    }
    while let Some((before, rest)) = text.split_once("](") {
        let after = rest.split_once(')').map_or("", |(_, after)| after);
        text = format!("{before} {after}");
    }
    text
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split_whitespace()
        .filter(|word| word.contains(char::is_alphanumeric))
}

/// Returns the paragraphs, items of lists and cells of tables of some lines.
fn paragraphs(lines: &[&str]) -> Vec<String> {
    let mut found = vec![String::new()];
    for line in lines {
        let start = line.trim_start();
        let is_item = ["- ", "#"].iter().any(|sign| start.starts_with(sign))
            || start.split(". ").next().is_some_and(|number| {
                !number.is_empty() && number.len() < start.len() && number.chars().all(|digit| digit.is_ascii_digit())
            });
        match start.starts_with('|') {
            true => found.extend(plain(line).split('|').map(str::to_owned)),
            false if start.is_empty() || is_item => found.push(plain(line)),
            false => *found.last_mut().expect("a paragraph") += &format!(" {}", plain(line)),
        }
        if start.starts_with('|') {
            found.push(String::new());
        }
    }
    found
}

/// Returns the sentences of a paragraph: each ends with a full stop or the like before a blank.
fn sentences(paragraph: &str) -> Vec<String> {
    let mut found = vec![String::new()];
    for word in paragraph.split_whitespace() {
        let last = found.last_mut().expect("a sentence");
        last.push_str(word);
        last.push(' ');
        if word.trim_end_matches(['*', ')', '"']).ends_with(['.', '?', '!']) {
            found.push(String::new());
        }
    }
    found
}

/// Returns the anchor of a heading, as mdBook and code hosts make it.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text
        .chars()
        .filter(|letter| letter.is_alphanumeric() || [' ', '-', '_'].contains(letter));
    kept.map(|letter| if letter == ' ' { '-' } else { letter }).collect()
}

/// Returns the path that a link leads to, without `..`.
fn target(page: &str, link: &str) -> PathBuf {
    let mut found = PathBuf::new();
    for part in Path::new(page).parent().expect("a folder").join(link).components() {
        match part {
            Component::ParentDir => drop(found.pop()),
            part => found.push(part),
        }
    }
    found
}

/// Returns a complaint for a page that starts without an example, for each line or sentence that is too long, and for each
/// relative link that leads nowhere.
fn complaints(page: &File, read: &dyn Fn(&Path) -> Option<String>) -> Vec<String> {
    let lines = prose(&page.text);
    let mut found = Vec::new();
    if !GENERATED.contains(&page.path.as_str()) {
        let start = page.text.split("\n## ").next().unwrap_or_default();
        if !start.contains("\n```") {
            found.push(format!("{}: no example at its start", page.path));
        }
        let long = lines
            .iter()
            .filter(|line| !line.starts_with('|') && line.chars().count() > LONGEST_LINE);
        found.extend(long.map(|line| format!("{}: a long line: {line}", page.path)));
        for sentence in paragraphs(&lines).iter().flat_map(|paragraph| sentences(paragraph)) {
            if words(&sentence).count() > LONGEST_SENTENCE {
                found.push(format!("{}: a long sentence: {sentence}", page.path));
            }
        }
    }
    for line in lines {
        for link in line.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let path = match file {
                _ if link.contains("://") => continue,
                "" => PathBuf::from(&page.path),
                file => target(&page.path, file),
            };
            let leads = read(&path).is_some_and(|text| {
                let mut headings = prose(&text).into_iter().filter(|line| line.starts_with('#'));
                heading.is_empty() || headings.any(|line| anchor(line) == heading)
            });
            if !leads {
                found.push(format!("{}: `{link}` leads nowhere", page.path));
            }
        }
    }
    found
}

/// Returns the words of a page, without code, pictures and works.
fn count(page: &File) -> usize {
    let (before, rest) = page.text.split_once(WORKS).unwrap_or((&page.text, ""));
    let after = rest.split_once("\n## ").map_or("", |(_, after)| after);
    let text = [before, after].map(|text| prose(text).into_iter().map(plain).collect::<Vec<_>>().join("\n"));
    text.iter().map(|text| words(&text.replace("CODE", "")).count()).sum()
}

fn pages() -> Vec<File> {
    let pages: Vec<File> = files("doc")
        .into_iter()
        .filter(|file| file.path.ends_with(".md"))
        .collect();
    assert!(pages.len() > 10, "the guide was not found");
    pages
}

#[test]
fn a_page_that_breaks_a_rule_is_found() {
    let long = "word ".repeat(31);
    let text = format!(
        "# A page\n{}\n\n## A part\n{long}\n\n[a](b.md) [c](#a-page) [d](#e) [f](https://g.h)\n```text\n{}\n```\n",
        "x".repeat(121),
        "y".repeat(121)
    );
    let page = File::new("doc/a.md", &text);
    let own = text.clone();
    let found = complaints(&page, &move |path| (path == Path::new("doc/a.md")).then(|| own.clone()));
    let kinds: Vec<&str> = ["no example", "long line", "long sentence", "`b.md` leads", "`#e` leads"]
        .into_iter()
        .filter(|kind| found.iter().any(|complaint| complaint.contains(kind)))
        .collect();
    assert_eq!((kinds.len(), found.len()), (5, 6), "{found:?}");
    assert_eq!(
        count(&File::new(
            "doc/a.md",
            "One `two` [three](four.md).\n```\nfive\n```\n![six](seven.svg)\n"
        )),
        2
    );
    assert_eq!(target("doc/reference/a.md", "../../b/c.md"), Path::new("b/c.md"));
    assert_eq!(anchor("## Sheets, and `more`"), "sheets-and-more");
}

#[test]
fn the_guide_has_short_lines_and_sentences_and_its_links_lead_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &Path| {
        let place = root.join(path);
        let text = || std::fs::read(&place).map_or(String::new(), |bytes| String::from_utf8_lossy(&bytes).into_owned());
        place.exists().then(text)
    };
    let found: Vec<String> = pages().iter().flat_map(|page| complaints(page, &read)).collect();
    assert_clean(&found);
}

#[test]
fn the_hand_written_guide_is_short() {
    let pages = pages()
        .into_iter()
        .filter(|page| !GENERATED.contains(&page.path.as_str()));
    let counts: Vec<(usize, String)> = pages.map(|page| (count(&page), page.path)).collect();
    let all: usize = counts.iter().map(|(words, _)| words).sum();
    assert!(all <= MOST_WORDS, "{all} words: {counts:?}");
}
