//! A document from its beginning to its end: its displays, its comments, its macros, the files that it includes.

use super::super::fault::File;
use super::asides::{self, Announced};
use super::comment::{is_misspelt, is_of_document};
use super::fonts;
use super::macros::{DEFINING, Macros};
use super::markdown::{unescaped, unquoted};
use super::rows::{Row, blank, print_relations, rows};
use super::tex::{BRACES, Groups, Outside, SQUARE, after_blanks, command, outside, words};
use std::collections::{HashMap, HashSet, VecDeque};
use std::ops::Range;

/// The most files, and how deep they may include each other.
const MOST_FILES: usize = 100;
const DEEPEST: usize = 16;

/// The longest document, files that it includes taken together, in bytes.
const LONGEST: usize = 16 << 20;

/// The most formulas of a document.
const MOST_FORMULAS: usize = 20_000;

/// The most faults that are listed.
const MOST_FAULTS: usize = 100;

/// How a document is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Markup {
    Tex,
    Markdown,
}

/// The text of a file by the name that a document includes it by, or why it cannot be had.
pub type Include<'a> = &'a mut dyn FnMut(&str) -> Result<String, String>;

/// How a display counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Numbers {
    None,
    One,
    Rows,
}

/// A formula as it stands in the document.
#[derive(Clone, Debug)]
pub(super) struct Formula {
    /// Where it stands in the text, without labels and tags.
    pub part: Range<usize>,
    /// Its TeX, macros replaced; of a link of a chain with the side before it. Else what is wrong with its macros.
    pub tex: Result<String, String>,
    /// The number or tag that it prints.
    pub number: Option<String>,
    pub labels: Vec<String>,
    /// Whether another row of its display could be a condition on it.
    pub is_doubtful: bool,
    /// Whether it continues the formula before it.
    pub is_link: bool,
    /// Whether it goes with the formula before it: as a link, or as another row of a display with one number or none.
    pub goes_with_last: bool,
    /// The number of the first formula of its display.
    pub first: usize,
    /// The comments that are about it, by number.
    pub comments: Vec<usize>,
    /// Whether they stand behind its display, and are about all of that.
    pub is_of_display: bool,
    /// True if it stands within the text.
    pub is_aside: bool,
    /// The place in the text from which it no longer holds: of a formula within the text the end of the environment, item or section
    /// around it, of a display that of the example, case or proof.
    pub until: usize,
}

/// A formula within the text, and how many formulas stand before it: `where` is said of the display before it.
#[derive(Clone, Debug)]
pub(super) struct Aside {
    pub formula: Formula,
    /// The display that it is said of.
    pub announced: Announced,
    pub after: usize,
}

/// The most bytes behind a formula within the text that are looked at.
const FARTHEST: usize = 400;

/// A comment that begins with `audit:`, or is meant to.
#[derive(Clone, Debug)]
pub(super) struct Comment {
    /// Where it stands.
    pub part: Range<usize>,
    /// The keys, without `audit:`; all of a comment that misspells this.
    pub text: String,
    /// The printed text around it: of its line before it, else the next line.
    pub line: String,
    /// Whether that is the line that it stands on.
    pub is_on_line: bool,
    /// How many formulas stand before it.
    pub after: usize,
}

/// Displays by their environments.
fn numbers_of(environment: &str) -> Option<Numbers> {
    let plain = environment.trim_end_matches('*');
    let numbers = match plain {
        "equation" | "multline" | "dmath" => Numbers::One,
        "align" | "gather" | "eqnarray" | "alignat" | "flalign" | "xalignat" | "IEEEeqnarray" => Numbers::Rows,
        "displaymath" => Numbers::None,
        _ => return None,
    };
    Some(if plain == environment { numbers } else { Numbers::None })
}

/// What holds no formulas to be decided.
const VERBATIM: [&str; 9] = [
    "verbatim",
    "verbatim*",
    "Verbatim",
    "lstlisting",
    "minted",
    "comment",
    "tikzpicture",
    "filecontents",
    "filecontents*",
];

/// The directive of Markdown that is a display.
const MATH: &str = "math";

/// The directives of Markdown that hold text; so do all of `prf:` and `proof:`.
const TEXT: [&str; 44] = [
    "admonition",
    "aside",
    "assumption",
    "attention",
    "axiom",
    "card",
    "caution",
    "conjecture",
    "corollary",
    "criterion",
    "danger",
    "definition",
    "details",
    "dropdown",
    "epigraph",
    "error",
    "example",
    "exercise",
    "figure",
    "grid",
    "grid-item",
    "grid-item-card",
    "hint",
    "important",
    "lemma",
    "margin",
    "note",
    "observation",
    "proof",
    "property",
    "proposition",
    "pull-quote",
    "remark",
    "seealso",
    "sidebar",
    "solution",
    "tab-item",
    "tab-set",
    "theorem",
    "tip",
    "todo",
    "topic",
    "versionadded",
    "warning",
];

/// Classes of documents that number equations within chapters.
const CLASSES_WITH_CHAPTERS: [&str; 6] = ["book", "report", "scrbook", "scrreprt", "memoir", "svmono"];

/// What prints numbers and is not read.
const COUNTING: [&str; 6] = ["empheq", "numcases", "subnumcases", "dgroup", "dseries", "darray"];

/// What lays out displays or names them, and is not looked for in macros.
const LAYOUT: [&str; 12] = [
    "begin",
    "end",
    "[",
    "]",
    "label",
    "tag",
    "notag",
    "nonumber",
    "setcounter",
    "addtocounter",
    "stepcounter",
    "refstepcounter",
];

/// What a conditional must not decide, beside displays and counters.
const DECIDED: [&str; 7] = ["[", "label", "tag", "input", "include", "subfile", "appendix"];

/// Conditionals whose branches stand in braces.
const BRACED: [&str; 10] = [
    "ifthenelse",
    "ifdef",
    "ifundef",
    "ifcsdef",
    "ifdefempty",
    "ifblank",
    "ifstrequal",
    "ifboolexpr",
    "ifbool",
    "iftoggle",
];

/// How far ends of conditionals are looked for, taken together, in bytes.
const MOST_SEARCHED: usize = 8 * LONGEST;

/// The most text of a line that is kept with a comment, in bytes.
const LONGEST_LINE: usize = 4096;

/// The longest text of `\\verb`, in characters.
const LONGEST_VERB: usize = 10_000;

/// The last letter of a group of equations.
const MOST_LETTERS: u32 = 25;

/// Ends of environments by where their bodies start, and how far was searched.
type Endings = (HashMap<usize, (usize, usize)>, Range<usize>);

pub(super) struct Scan<'a> {
    markup: Markup,
    include: Include<'a>,
    /// All files one after the other, comments, labels and tags blanked out.
    pub text: String,
    pub files: Vec<File>,
    pub formulas: Vec<Formula>,
    /// Formulas within the text that words announce.
    pub asides: Vec<Aside>,
    pub comments: Vec<Comment>,
    /// What is wrong, and where.
    pub faults: Vec<(usize, String)>,
    /// The length of the shortest fence that no later one ends: those of its length are looked for once.
    endless: Option<usize>,
    /// What is passed over although it may be meant, and where.
    pub notes: Vec<(usize, String)>,
    macros: Macros,
    /// Where the groups of the text close.
    groups_of_text: Groups,
    /// For signs that are searched for: from where on up to where there is none.
    absent: HashMap<&'static str, Range<usize>>,
    /// For environments without an end: where those within them end, by where their bodies start; and how far was searched.
    endings: HashMap<String, Endings>,
    /// Where the line ends that was looked for last, and from where on.
    line_end: Option<Range<usize>>,
    /// The line that was found last for a comment that stands alone.
    line: Range<usize>,
    /// The comments of the file at hand that no formula has taken yet.
    waiting: VecDeque<usize>,
    /// The author's environments: which one each stands for; none where it is more.
    environments: HashMap<String, Option<String>>,
    /// Environments that do not print.
    hidden: Vec<String>,
    /// The author's conditionals, and whether they hold.
    switches: HashMap<String, bool>,
    /// Macros that lay out displays or number them, and are not read.
    layouts: HashSet<String>,
    /// Whether what was not read may have numbered displays.
    has_lost_count: bool,
    /// The last number, that of a group of equations, and the letter within it.
    counted: usize,
    group: Option<(usize, u32)>,
    /// The number of the section, whether it is an appendix, and whether equations are numbered within sections.
    section: usize,
    is_appendix: bool,
    within_sections: bool,
    /// Whether chapters stand in the place of sections.
    has_chapters: bool,
    /// How many groups are open: braces, and environments other than the document.
    groups: usize,
    /// The conditionals that are open: whether what stands behind `\\else` is left out.
    conditionals: Vec<bool>,
    /// Where a conditional ends of which nobody knows which branch prints.
    unknown_until: usize,
    /// How far ends of conditionals were looked for.
    searched: usize,
    open: Vec<String>,
    ended: bool,
}

/// Returns true if a formula parts equations by blanks.
fn is_parted_by_blanks(text: &str, formula: Option<&Formula>) -> bool {
    let own = formula.and_then(|formula| text.get(formula.part.clone()));
    own.is_some_and(|own| own.contains(r"\quad") || own.contains(r"\qquad"))
}

impl<'a> Scan<'a> {
    /// Reads a document and what it includes; `preamble` defines macros and prints nothing.
    pub fn new(text: &str, preamble: &str, markup: Markup, include: Include<'a>) -> Self {
        let mut scan = Self {
            markup,
            include,
            text: String::new(),
            files: Vec::new(),
            formulas: Vec::new(),
            asides: Vec::new(),
            comments: Vec::new(),
            faults: Vec::new(),
            notes: Vec::new(),
            endless: None,
            macros: Macros::default(),
            groups_of_text: Groups::default(),
            absent: HashMap::new(),
            endings: HashMap::new(),
            line: 0..0,
            line_end: None,
            waiting: VecDeque::new(),
            environments: HashMap::new(),
            hidden: Vec::new(),
            switches: HashMap::new(),
            layouts: HashSet::new(),
            has_lost_count: false,
            counted: 0,
            group: None,
            section: 0,
            is_appendix: false,
            within_sections: false,
            has_chapters: false,
            groups: 0,
            conditionals: Vec::new(),
            unknown_until: 0,
            searched: 0,
            open: Vec::new(),
            ended: false,
        };
        scan.macros.learn(preamble);
        scan.file(None, text);
        let asides = scan.asides.iter_mut().map(|aside| &mut aside.formula);
        let formulas = scan.formulas.iter_mut().chain(asides);
        let all = formulas.filter_map(|formula| formula.tex.as_mut().ok()).collect();
        fonts::read_as_meant(&scan.text, &scan.macros, all);
        if let Some((at, _)) = scan.faults.get(MOST_FAULTS).cloned() {
            let more = scan.faults.len() - MOST_FAULTS;
            scan.faults.truncate(MOST_FAULTS);
            scan.faults
                .push((at, format!("{more} more things from here on cannot be read")));
        }
        scan
    }

    fn file(&mut self, name: Option<String>, text: &str) {
        let start = self.text.len();
        self.files.push(File { start, name });
        match self.markup {
            Markup::Tex => self.text.push_str(text),
            Markup::Markdown => self.text.push_str(&unescaped(&unquoted(text))),
        }
        if !text.ends_with('\n') {
            self.text.push('\n');
        }
        let end = self.text.len();
        let comments = match self.markup {
            Markup::Tex => self.comments_of_tex(start..end),
            Markup::Markdown => self.comments_of_markdown(start..end),
        };
        self.groups_of_text.add(&self.text, start..end);
        let outer = std::mem::replace(&mut self.waiting, comments.into());
        let endless = self.endless.take();
        self.displays(start..end);
        self.take_comments(usize::MAX, None);
        (self.waiting, self.endless) = (outer, endless);
    }

    /// What stands between the braces, or these other brackets, that open at byte `at`, or blanks later.
    fn group(&self, at: usize, brackets: [u8; 2]) -> Option<Range<usize>> {
        self.groups_of_text.group(&self.text, at, brackets)
    }

    /// The first place of a sign between two bytes.
    fn find(&mut self, sign: &'static str, from: usize, end: usize) -> Option<usize> {
        let is_absent = |none: &Range<usize>| none.start <= from && end <= none.end;
        if self.absent.get(sign).is_some_and(is_absent) {
            return None;
        }
        let found = self.text.get(from..end).and_then(|rest| rest.find(sign));
        if found.is_none() {
            self.absent.insert(sign, from..end);
        }
        found.map(|found| from + found)
    }

    fn comments_of_tex(&mut self, part: Range<usize>) -> Vec<usize> {
        let mut numbers = Vec::new();
        let mut at = part.start;
        while at < part.end {
            let line = self
                .text
                .get(at..part.end)
                .and_then(|rest| rest.find('\n'))
                .map_or(part.end, |end| at + end);
            let bytes = self.text.as_bytes();
            let is_escaped = |at: usize| {
                bytes[part.start..at]
                    .iter()
                    .rev()
                    .take_while(|byte| **byte == b'\\')
                    .count()
                    % 2
                    == 1
            };
            let start = (at..line).find(|&at| bytes[at] == b'%' && !is_escaped(at));
            if let Some(start) = start {
                numbers.extend(self.comment(start + 1..line, start));
                blank(&mut self.text, start..line);
            }
            at = line + 1;
        }
        numbers
    }

    fn comments_of_markdown(&mut self, part: Range<usize>) -> Vec<usize> {
        let mut numbers = Vec::new();
        let mut at = part.start;
        while let Some(start) = self
            .text
            .get(at..part.end)
            .and_then(|rest| rest.find("<!--"))
            .map(|found| at + found)
        {
            let end = self
                .text
                .get(start..part.end)
                .and_then(|rest| rest.find("-->"))
                .map(|found| start + found);
            let Some(end) = end else {
                self.faults.push((start, "this comment does not end".to_owned()));
                break;
            };
            numbers.extend(self.comment(start + 4..end, start));
            blank(&mut self.text, start..end + 3);
            at = end + 3;
        }
        numbers
    }

    /// Keeps a comment that is for us.
    fn comment(&mut self, part: Range<usize>, start: usize) -> Option<usize> {
        let text = self.text.get(part.clone())?.trim();
        let text = match text.strip_prefix("audit:") {
            Some(keys) => keys.trim().to_owned(),
            None if is_misspelt(text) => text.to_owned(),
            None => return None,
        };
        let bound = start.saturating_sub(LONGEST_LINE);
        let bound = (bound..=start).find(|at| self.text.is_char_boundary(*at))?;
        let from = self
            .text
            .get(bound..start)?
            .rfind('\n')
            .map_or(bound, |end| bound + end + 1);
        let before = self.text.get(from..start)?.trim();
        let is_on_line = !before.is_empty();
        let line = if is_on_line {
            before.to_owned()
        } else {
            let next = self.next_line(part.end)?;
            let line = self.text.get(next)?;
            line.chars().take(LONGEST_LINE).collect()
        };
        self.comments.push(Comment {
            part,
            text,
            line,
            is_on_line,
            after: 0,
        });
        Some(self.comments.len() - 1)
    }

    /// The first line from byte `at` on that prints something.
    fn next_line(&mut self, at: usize) -> Option<Range<usize>> {
        if self.line.start < at {
            let (mut from, rest) = (at, self.text.get(at..)?);
            let lines = rest.split('\n').map(|line| {
                let own = from..from + line.len();
                from = own.end + 1;
                (own, line)
            });
            let prints = |(_, line): &(Range<usize>, &str)| !line.trim().is_empty() && !line.contains("-->");
            let none = self.text.len()..self.text.len();
            self.line = lines.into_iter().find(prints).map_or(none, |(own, _)| own);
        }
        Some(self.line.clone()).filter(|line| !line.is_empty())
    }

    /// Hands the comments before byte `end` to a formula; what is left at the end of a file is about none.
    fn take_comments(&mut self, end: usize, formula: Option<usize>) {
        let count = self.formulas.len();
        let comments = &self.comments;
        let is_before = |number: &usize| comments.get(*number).is_some_and(|comment| comment.part.start < end);
        let many = self.waiting.iter().take_while(|number| is_before(number)).count();
        let taken: Vec<usize> = self.waiting.drain(..many).collect();
        for &number in &taken {
            if let Some(comment) = self.comments.get_mut(number) {
                comment.after = formula.unwrap_or(count);
            }
        }
        if let Some(formula) = formula.and_then(|formula| self.formulas.get_mut(formula)) {
            let is_of_one = |number: &usize| self.comments.get(*number).is_some_and(|own| !is_of_document(&own.text));
            formula.comments.extend(taken.into_iter().filter(is_of_one));
        }
    }

    /// Returns true once there are as many formulas as are read: the next one, at byte `at`, ends the document.
    fn is_full(&mut self, at: usize) -> bool {
        let is_full = self.formulas.len() >= MOST_FORMULAS;
        if is_full && !self.ended {
            let problem = format!("more than {MOST_FORMULAS} formulas: what follows is not read");
            self.faults.push((at, problem));
            self.ended = true;
        }
        is_full
    }

    fn displays(&mut self, part: Range<usize>) {
        let mut at = part.start;
        while at < part.end && !self.ended {
            if self.is_full(at) {
                break;
            }
            let rest = self.text.get(at..part.end).unwrap_or_default();
            let Some(found) = rest.find(['\\', '$', '`', '~', ':', '{', '}']) else {
                break;
            };
            let here = at + found;
            at = match self.text.as_bytes().get(here) {
                Some(b'{') if self.markup == Markup::Tex => {
                    self.groups += 1;
                    here + 1
                }
                Some(b'}') => {
                    self.groups = self.groups.saturating_sub(1);
                    here + 1
                }
                Some(b'`') if self.markup == Markup::Markdown => self.code('`', here, part.end),
                Some(sign @ (b'~' | b':'))
                    if self.markup == Markup::Markdown && self.is_fence(char::from(*sign), here) =>
                {
                    self.code(char::from(*sign), here, part.end)
                }
                Some(b'$') => self.dollars(here, part.end),
                Some(b'\\') => self.command(here, part.end),
                _ => here + 1,
            };
        }
    }

    /// Returns true if three of these signs stand here at the start of a line.
    fn is_fence(&self, sign: char, here: usize) -> bool {
        let before = self.text.get(..here).unwrap_or_default().trim_end_matches(' ');
        let is_first = before.is_empty() || before.ends_with('\n');
        let mut signs = self.text.get(here..).unwrap_or_default().chars().take(3);
        is_first && signs.by_ref().filter(|c| *c == sign).count() == 3
    }

    /// Passes over the code that a fence of these signs starts here and returns its end. A block of `math` is a display; in a
    /// directive that holds text its displays are read.
    fn code(&mut self, sign: char, here: usize, end: usize) -> usize {
        let rest = self.text.get(here..end).unwrap_or_default();
        let fence: String = rest.chars().take_while(|c| *c == sign).collect();
        let body = here + fence.len();
        let rest = self.text.get(body..end).unwrap_or_default();
        let line = rest.find('\n').unwrap_or(rest.len());
        let information = rest.get(..line).unwrap_or_default();
        let directive = directive(information).filter(|_| fence.len() >= 3).map(str::to_owned);
        let is_text = directive.as_deref().is_some_and(holds_text);
        // a fence of colons holds text unless its directive says otherwise
        let is_apart = |name: &str| name == MATH || name.starts_with("code");
        if sign == ':' && !directive.as_deref().is_some_and(is_apart) {
            return body + line;
        }
        let is_endless = self.endless.is_some_and(|shortest| fence.len() >= shortest);
        let close = match directive {
            Some(_) if is_endless => None,
            Some(_) => end_of_fence(rest, &fence, sign),
            None => rest.find(&fence),
        };
        let Some(close) = close.map(|found| body + found) else {
            if directive.is_some() {
                self.endless = Some(fence.len().min(self.endless.unwrap_or(usize::MAX)));
            }
            return body;
        };
        let is_math = fence.len() >= 3 && information.split_whitespace().next() == Some("math");
        match directive.as_deref() {
            Some(MATH) => {
                let start = body + information.find('}').map_or(0, |brace| brace + 1);
                self.options(body + line..close);
                self.display(start..close, Numbers::None, "math");
            }
            // its end must not open another
            Some(_) if is_text => {
                blank(&mut self.text, close..close + fence.len());
                return body + line;
            }
            Some(name) => {
                let own = self.text.get(body..close).unwrap_or_default();
                if own.contains("$$") || words(own).any(|(word, _)| word == "[" || word == "begin") {
                    let problem = format!("`{{{name}}}` is taken for code: a display in it is not read");
                    self.notes.push((here, problem));
                }
            }
            None if is_math => {
                let start = body + information.find("math").unwrap_or(0) + "math".len();
                self.display(start..close, Numbers::None, "math");
            }
            None => {}
        }
        close + fence.len()
    }

    /// Blanks out the options at the start of a directive, such as `:label: law`, which becomes a `\label`.
    fn options(&mut self, body: Range<usize>) {
        let mut at = body.start;
        while at < body.end {
            let own = self.text.get(at..body.end).unwrap_or_default();
            let length = own.find('\n').map_or(own.len(), |end| end + 1);
            let line = own.get(..length).unwrap_or_default();
            let part = at..at + line.trim_end().len();
            at += length;
            if line.trim().is_empty() {
                continue;
            }
            let option = line.trim().strip_prefix(':').and_then(|line| line.split_once(':'));
            let Some((key, value)) = option.filter(|(key, _)| key.chars().all(|c| c.is_alphabetic() || c == '-'))
            else {
                return;
            };
            let label = format!(r"\label{{{}}}", value.trim());
            let is_label = key == "label" && !value.contains(['{', '}', '\\']) && label.len() <= part.len();
            blank(&mut self.text, part.clone());
            if is_label {
                self.text.replace_range(part.start..part.start + label.len(), &label);
            }
        }
    }

    /// Keeps a formula within the text, that opens here, where words announce that it holds.
    fn aside(&mut self, here: usize, body: Range<usize>) {
        let text = |part: Range<usize>| self.text.get(part).unwrap_or_default();
        let tex = text(body.clone());
        let conditions = asides::signs(tex);
        if !conditions.is_empty() {
            self.conditions(here, body, conditions);
            return;
        }
        if !asides::states(tex) {
            return;
        }
        let last = self.asides.last();
        let between = last.map(|last| (text(last.formula.part.end + 1..here), last.announced));
        let since = self.formulas.last().map(|last| text(last.part.end..here));
        let behind = self.text.get(body.end + 1..).unwrap_or_default();
        let far = behind.char_indices().nth(FARTHEST).map_or(behind.len(), |(far, _)| far);
        let behind = behind.get(..far).unwrap_or_default();
        let announced = asides::announced(text(0..here), since, between, behind);
        let Some(announced) = announced.filter(|_| asides::is_plain_behind(behind)) else {
            return;
        };
        let until = match announced {
            Announced::Next => asides::next_display(&self.text, body.end + 1),
            _ => Some(asides::scope_end(&self.text, here)),
        };
        let Some(until) = until else { return };
        // of the display before, where nothing but this sentence stands between
        let display = self
            .formulas
            .last()
            .filter(|last| announced == Announced::Behind && !has_empty_line(text(last.part.end..here)));
        let after = display.map_or(self.formulas.len(), |last| last.first);
        let tex = tex.to_owned();
        self.keep_aside(body, &tex, announced, after, until);
    }

    /// Keeps conditions within the text, whose formula opens here, where words say of which displays they hold.
    fn conditions(&mut self, here: usize, body: Range<usize>, conditions: Vec<String>) {
        let text = |part: Range<usize>| self.text.get(part).unwrap_or_default();
        let last = self.formulas.last();
        let since = last.map(|last| text(last.part.end..here));
        let behind = self.text.get(body.end + 1..).unwrap_or_default();
        let far = behind.char_indices().nth(FARTHEST).map_or(behind.len(), |(far, _)| far);
        let behind = behind.get(..far).unwrap_or_default();
        let front = here.saturating_sub(FARTHEST);
        let front = (front..=here)
            .find_map(|from| self.text.get(from..here))
            .unwrap_or_default();
        let Some(announced) = asides::condition_announced(front, since, behind) else {
            return;
        };
        let until = match announced {
            Announced::Next => asides::next_display(&self.text, body.end + 1),
            Announced::FromHere => Some(asides::scope_end(&self.text, here)),
            Announced::Behind => Some(here),
        };
        let after = last
            .filter(|_| announced == Announced::Behind)
            .map_or(self.formulas.len(), |last| last.first);
        for condition in conditions {
            if let Some(until) = until {
                self.keep_aside(body.clone(), &condition, announced, after, until);
            }
        }
    }

    /// Keeps a formula that is said of the formulas from one number on, up to a place in the text.
    fn keep_aside(&mut self, part: Range<usize>, tex: &str, announced: Announced, after: usize, until: usize) {
        let Ok(tex) = self.macros.expanded(tex) else { return };
        self.asides.push(Aside {
            formula: Formula {
                part,
                tex: Ok(tex),
                number: None,
                labels: Vec::new(),
                is_doubtful: false,
                is_link: false,
                goes_with_last: false,
                first: 0,
                comments: Vec::new(),
                is_of_display: false,
                is_aside: true,
                until,
            },
            announced,
            after,
        });
    }

    fn dollars(&mut self, here: usize, end: usize) -> usize {
        let is_display = self.text.as_bytes().get(here + 1) == Some(&b'$');
        let sign = if is_display { "$$" } else { "$" };
        let start = here + sign.len();
        let mut at = start;
        loop {
            let Some(found) = self.find(sign, at, end) else {
                self.absent.insert(sign, here + 1..end);
                if is_display {
                    self.faults
                        .push((here, "this display does not end: there is no second `$$`".to_owned()));
                }
                return start;
            };
            if self.text.as_bytes().get(found.wrapping_sub(1)) == Some(&b'\\') {
                at = found + 1;
                continue;
            }
            let body = start..found;
            let is_parted = self.text.get(body.clone()).is_some_and(has_empty_line);
            if is_parted {
                if is_display {
                    self.faults
                        .push((here, "a display ends before an empty line: `$$` is missing".to_owned()));
                }
                return start;
            }
            if is_display {
                let first = self.formulas.len();
                self.display(body, Numbers::None, "$$");
                let label = self.text.get(found + sign.len()..).and_then(label_behind);
                let label = label.filter(|_| self.markup == Markup::Markdown).map(str::to_owned);
                if let Some(formula) = self.formulas.get_mut(first) {
                    formula.labels.extend(label);
                }
            } else {
                self.aside(here, body);
            }
            return found + sign.len();
        }
    }

    fn command(&mut self, here: usize, end: usize) -> usize {
        let (name, next) = command(&self.text, here);
        let name = name.to_owned();
        if let Some((opens, own)) = self.macros.layout(&name).map(|(opens, own)| (opens, own.to_owned())) {
            return match numbers_of(&own).filter(|_| opens) {
                Some(numbers) => self.environment(here, next, end, [&own, &own], numbers),
                None => next,
            };
        }
        if let Some(close) = self
            .macros
            .leaves_out(&name, &self.text, next, &self.groups_of_text)
            .filter(|close| *close <= end)
        {
            return self.leave_out(here, close);
        }
        self.has_lost_count |= self.layouts.contains(&name);
        if let Some((switch, holds)) = self.switched(&name) {
            // behind the end of a group nobody says what it is again
            match self.groups {
                0 => drop(self.switches.insert(switch, holds)),
                _ => drop(self.switches.remove(&switch)),
            }
        }
        let known = name.strip_prefix("if").and_then(|switch| self.switches.get(switch));
        let name = match known {
            Some(true) => "iftrue".to_owned(),
            Some(false) => "iffalse".to_owned(),
            None => name,
        };
        match name.as_str() {
            "begin" => {
                let Some(environment_name) = self.group(next, BRACES) else {
                    return next;
                };
                let inside = environment_name.end + 1;
                let own = self.text.get(environment_name).unwrap_or_default().to_owned();
                let meant = self.environments.get(&own).cloned();
                if meant == Some(None) {
                    let problem = "an environment of your own is not read: write the display out";
                    self.faults.push((here, problem.to_owned()));
                    self.has_lost_count = true;
                }
                let meant = meant.flatten().unwrap_or_else(|| own.clone());
                if let Some(numbers) = numbers_of(&meant) {
                    return self.environment(here, inside, end, [&own, &meant], numbers);
                }
                if let Some((body, kind)) = self.wrapped(&own, inside)
                    && let Some(numbers) = numbers_of(&kind)
                {
                    return self.environment(here, body, end, [&own, &kind], numbers);
                }
                if COUNTING.contains(&own.as_str()) {
                    let problem = format!("`{own}` is not read: write its formulas as an align");
                    self.faults.push((here, problem));
                    self.has_lost_count = true;
                }
                if VERBATIM.contains(&own.as_str()) || self.hidden.contains(&own) {
                    return match self.ending(inside, end, &own) {
                        Some((_, close)) => self.leave_out(here, close),
                        None => self.without_end(here, inside, &own),
                    };
                }
                if own == "subequations" {
                    self.counted += 1;
                    self.group = Some((self.counted, 0));
                }
                self.groups += usize::from(own != "document");
                inside
            }
            "end" => {
                let own = self.group(next, BRACES);
                let close = own.as_ref().map_or(next, |own| own.end + 1);
                let own = own.and_then(|own| self.text.get(own)).unwrap_or_default();
                if own == "document" {
                    self.ended = true;
                } else {
                    self.groups = self.groups.saturating_sub(1);
                }
                if own == "subequations" {
                    self.group = None;
                }
                close
            }
            "begingroup" | "bgroup" => {
                self.groups += 1;
                next
            }
            "endgroup" | "egroup" => {
                self.groups = self.groups.saturating_sub(1);
                next
            }
            "[" => {
                let Some(close) = self.find(r"\]", next, end) else {
                    self.faults
                        .push((here, r"this display does not end: there is no `\]`".to_owned()));
                    return next;
                };
                self.display(next..close, Numbers::None, "[");
                close + 2
            }
            "verb" => {
                let sign = self.text.get(next..).and_then(|rest| rest.chars().next());
                let close = sign.and_then(|sign| {
                    let start = next + sign.len_utf8();
                    let mut line = self.text.get(start..)?.char_indices().take(LONGEST_VERB);
                    let (at, end) = line.find(|(_, c)| *c == sign || *c == '\n')?;
                    (end == sign).then_some(start + at + sign.len_utf8())
                });
                close.unwrap_or(next)
            }
            _ if DEFINING.contains(&name.as_str()) => self.definition(here, &name, next),
            "newenvironment" | "renewenvironment" => self.own_environment(next),
            "excludecomment" => {
                let own = self.group(next, BRACES);
                self.hidden
                    .extend(own.and_then(|own| self.text.get(own)).map(str::to_owned));
                next
            }
            "newif" => {
                let (switch, next) = command(&self.text, after_blanks(&self.text, next));
                if let Some(switch) = switch.strip_prefix("if") {
                    self.switches.insert(switch.to_owned(), false);
                }
                next
            }
            "iftrue" => {
                self.conditionals.push(true);
                next
            }
            "iffalse" => match self.branches(next, end) {
                Some((Some(other), _)) => {
                    self.conditionals.push(false);
                    self.leave_out(here, other + r"\else".len())
                }
                Some((None, close)) => self.leave_out(here, close + r"\fi".len()),
                None => {
                    self.faults.push((here, r"this `\iffalse` has no `\fi`".to_owned()));
                    next
                }
            },
            "else" if self.conditionals.last() == Some(&true) => {
                let close = self.branches(next, end).map_or(next, |(_, close)| close);
                self.leave_out(here, close)
            }
            "fi" => {
                self.conditionals.pop();
                next
            }
            name if name.starts_with("if") && name != "iff" => self.conditional(here, name, next, end),
            "setcounter" | "addtocounter" | "stepcounter" | "refstepcounter" => self.counter(here, &name, next),
            "numberwithin" | "counterwithin" => {
                let own = self.text.get(next..).unwrap_or_default();
                self.within_sections |= own.starts_with("{equation}{section}");
                // by chapter and section, or anew by chapter
                self.has_lost_count |=
                    own.starts_with("{equation}") && (self.has_chapters || own.starts_with("{equation}{chapter}"));
                next
            }
            "documentclass" => {
                let options = self.group(next, SQUARE).map_or(next, |own| own.end + 1);
                let class = self.group(options, BRACES).and_then(|own| self.text.get(own));
                self.has_chapters = class.is_some_and(|class| CLASSES_WITH_CHAPTERS.contains(&class.trim()));
                self.within_sections |= self.has_chapters;
                next
            }
            division @ ("chapter" | "section")
                if (division == "chapter") == self.has_chapters && self.text.as_bytes().get(next) != Some(&b'*') =>
            {
                self.section += 1;
                if self.within_sections {
                    self.counted = 0;
                }
                next
            }
            "appendix" => {
                (self.section, self.is_appendix) = (0, true);
                next
            }
            "input" | "include" | "subfile" => {
                let argument = self.group(next, BRACES);
                let close = argument.as_ref().map_or(next, |own| own.end + 1);
                if let Some(file) = argument
                    .and_then(|own| self.text.get(own))
                    .map(|own| own.trim().to_owned())
                {
                    self.included(here, file);
                }
                close
            }
            _ => next,
        }
    }

    /// The conditional that `\drafttrue` or `\draftfalse` sets, if it is known, and whether it holds then.
    fn switched(&self, name: &str) -> Option<(String, bool)> {
        let (switch, holds) = match name.strip_suffix("true") {
            Some(switch) => (switch, true),
            None => (name.strip_suffix("false")?, false),
        };
        self.switches.contains_key(switch).then(|| (switch.to_owned(), holds))
    }

    /// Takes note of an environment of the author's own; says where its definition ends.
    fn own_environment(&mut self, next: usize) -> usize {
        let star = usize::from(self.text.as_bytes().get(next) == Some(&b'*'));
        let Some(name) = self.group(next + star, BRACES) else {
            return next;
        };
        let mut close = name.end + 1;
        while let Some(own) = self.group(close, SQUARE) {
            close = own.end + 1;
        }
        let mut parts: [&str; 2] = [""; 2];
        for part in &mut parts {
            let Some(own) = self.group(close, BRACES) else {
                return close;
            };
            close = own.end + 1;
            *part = self.text.get(own).unwrap_or_default().trim();
        }
        let alone = |part: &str, command: &str| {
            let inner = part
                .strip_prefix(command)?
                .trim_start()
                .strip_prefix('{')?
                .strip_suffix('}')?;
            (!inner.contains('}')).then(|| inner.to_owned())
        };
        let [begins, ends] = parts;
        let meant = alone(begins, r"\begin").filter(|meant| alone(ends, r"\end").as_ref() == Some(meant));
        let has_layout = words(begins).chain(words(ends)).any(|(word, _)| LAYOUT.contains(&word));
        if let Some(name) = self.text.get(name).map(|name| name.trim().to_owned())
            && (meant.is_some() || has_layout)
        {
            self.environments.insert(name, meant);
        }
        close
    }

    /// Reads the display that an environment is, whose body starts at byte `inside`; says where it ends. It goes by the first
    /// name and is what the second is.
    fn environment(&mut self, here: usize, inside: usize, end: usize, names: [&str; 2], numbers: Numbers) -> usize {
        let [own, meant] = names;
        let Some((body, close)) = self.ending(inside, end, own) else {
            return self.without_end(here, inside, own);
        };
        let mut body = inside..body;
        if meant.contains("alignat") || meant.contains("IEEE") {
            body.start = self.group(body.start, BRACES).map_or(body.start, |count| count.end + 1);
        }
        let shown = self.text.get(body.clone()).unwrap_or_default();
        if words(shown).any(|(word, next)| is_counter(shown, word, next)) {
            let problem = "a counter is changed within a display: do it before or behind";
            self.faults.push((here, problem.to_owned()));
        }
        self.display(body, numbers, meant);
        close
    }

    /// Returns where the body of a display in an environment of a package begins, and the environment of amsmath that it is laid out
    /// as; nothing for one with something to the left of its rows.
    fn wrapped(&self, own: &str, inside: usize) -> Option<(usize, String)> {
        match own {
            "numcases" | "subnumcases" => {
                let left = self.group(inside, BRACES)?;
                let shown = self.text.get(left.clone())?.trim();
                let is_label = shown.starts_with(r"\label{") && shown.find('}') == Some(shown.len() - 1);
                (shown.is_empty() || is_label).then(|| (left.end + 1, "align".to_owned()))
            }
            "empheq" => {
                let options = self.group(inside, SQUARE).map_or(inside, |options| options.end + 1);
                let kind = self.group(options, BRACES)?;
                let shown = self.text.get(kind.clone())?.split('=').next()?.trim();
                Some((kind.end + 1, shown.to_owned()))
            }
            _ => None,
        }
    }

    fn without_end(&mut self, here: usize, inside: usize, own: &str) -> usize {
        self.faults
            .push((here, format!(r"`\begin{{{own}}}` has no `\end{{{own}}}`")));
        inside
    }

    /// Where the body of an environment ends that starts at byte `start`, and where its end does.
    fn ending(&mut self, start: usize, end: usize, own: &str) -> Option<(usize, usize)> {
        if let Some((known, searched)) = self.endings.get(own)
            && searched.contains(&start)
            && searched.end == end
        {
            return known.get(&start).copied();
        }
        // the bodies that are open, and the ends of those that are not
        let (mut open, mut known) = (vec![start], HashMap::new());
        for (word, next) in words(self.text.get(start..end)?) {
            let next = start + next;
            let here = next - word.len() - 1;
            let (opens, name, close) = match word {
                "begin" | "end" => {
                    let Some(name) = self.group(next, BRACES) else {
                        continue;
                    };
                    (word == "begin", self.text.get(name.clone())?, name.end + 1)
                }
                word => match self.macros.layout(word) {
                    Some((opens, name)) => (opens, name, next),
                    None => continue,
                },
            };
            match (name == own, opens) {
                (false, _) => {}
                (true, true) => open.push(close),
                (true, false) => {
                    if let Some(body) = open.pop() {
                        known.insert(body, (here, close));
                    }
                }
            }
            if open.is_empty() {
                return Some((here, close)).filter(|(_, close)| *close <= end);
            }
        }
        self.endings.insert(own.to_owned(), (known, start..end));
        None
    }

    /// Reads the definition of a macro; says where it ends.
    fn definition(&mut self, here: usize, name: &str, next: usize) -> usize {
        let before = self.text.get(..here).unwrap_or_default().trim_end();
        let is_global = name == "gdef" || before.ends_with(r"\global");
        let problem = if here < self.unknown_until {
            Some("is defined where a conditional decides: write `\\iftrue` or `\\iffalse`")
        } else if self.groups > 0 && !is_global {
            Some("is defined within a group: define it outside")
        } else {
            None
        };
        let Some((defined, close)) = self.macros.read(&self.text, name, next, &self.groups_of_text, problem) else {
            self.faults.push((here, format!(r"this `\{name}` cannot be read")));
            return next;
        };
        if let Some(problem) = problem {
            self.faults.push((here, format!(r"the macro `\{defined}` {problem}")));
        }
        if defined == "theequation" {
            let problem = r"what `\theequation` prints is not followed: formulas are called by label or line";
            self.faults.push((here, problem.to_owned()));
            self.has_lost_count = true;
        }
        let is_display = |(_, own): (bool, &str)| numbers_of(own).is_some();
        let own = self.text.get(next..close).unwrap_or_default();
        if !self.macros.layout(&defined).is_some_and(is_display) && words(own).any(|(word, _)| LAYOUT.contains(&word)) {
            let problem =
                "a macro that opens or ends an environment, or that numbers or labels, is not read: write it out";
            self.faults.push((here, problem.to_owned()));
            self.layouts.insert(defined);
        }
        close
    }

    /// Where the `\\else` and the `\\fi` of a conditional stand that begins at byte `start`.
    fn branches(&mut self, start: usize, end: usize) -> Option<(Option<usize>, usize)> {
        let found = (self.searched < MOST_SEARCHED)
            .then(|| branches(&self.text, start, end))
            .flatten();
        self.searched += found.map_or(end, |(_, close)| close) - start;
        found
    }

    /// Passes over what does not print, with its comments.
    fn leave_out(&mut self, start: usize, end: usize) -> usize {
        let comments = &self.comments;
        let count_before = |at: usize| {
            let is_before = |number: &usize| comments.get(*number).is_some_and(|comment| comment.part.start < at);
            self.waiting.partition_point(is_before)
        };
        let left_out = count_before(start)..count_before(end);
        for number in self.waiting.drain(left_out) {
            if let Some(comment) = self.comments.get_mut(number) {
                comment.text.clear();
            }
        }
        end
    }

    /// A conditional of which nobody says which branch prints: both are read, and what would matter is a fault.
    fn conditional(&mut self, here: usize, name: &str, next: usize, end: usize) -> usize {
        let is_braced = BRACED.contains(&name);
        let branches = if is_braced { None } else { self.branches(next, end) };
        let close = match branches {
            Some((_, close)) => {
                self.conditionals.push(false);
                close
            }
            None => {
                let mut close = next;
                while let Some(own) = self.group(close, BRACES) {
                    close = own.end + 1;
                }
                close
            }
        };
        let (start, own) = (next, self.text.get(next..close).unwrap_or_default());
        // what it sets is not known from here on
        let set: Vec<String> = words(own)
            .filter_map(|(word, _)| self.switched(word))
            .map(|(switch, _)| switch)
            .collect();
        self.switches.retain(|switch, _| !set.contains(switch));
        let counts = |(word, next): (&str, usize)| {
            let opens = || {
                let name = self.group(start + next, BRACES).and_then(|name| self.text.get(name));
                name.is_some_and(|name| name == "subequations" || numbers_of(name).is_some())
            };
            (word == "begin" && opens()) || is_counter(own, word, next) || self.macros.layout(word).is_some()
        };
        let has_count = words(own).any(counts);
        let matters = has_count
            || own.contains("$$")
            || words(own).any(|(word, _)| DECIDED.contains(&word) || DEFINING.contains(&word));
        if here >= self.unknown_until && matters {
            let problem = format!(r"nobody says which branch of `\{name}` prints: write `\iftrue` or `\iffalse`");
            self.faults.push((here, problem));
            self.unknown_until = close;
            self.has_lost_count |= has_count;
        }
        next
    }

    /// Follows what changes the number of equations, or of sections.
    fn counter(&mut self, here: usize, name: &str, next: usize) -> usize {
        if !is_counter(&self.text, name, next) {
            return next;
        }
        let own = self.group(next, BRACES);
        let inside = own.as_ref().map_or(next, |own| own.end + 1);
        let own = own.and_then(|own| self.text.get(own)).unwrap_or_default().to_owned();
        let written = self.group(inside, BRACES).and_then(|value| self.text.get(value));
        let written = written.and_then(|value| value.trim().parse::<i64>().ok());
        let steps = matches!(name, "stepcounter" | "refstepcounter");
        let count = match (&self.group, own.as_str()) {
            (Some((_, letter)), "equation") => i64::from(*letter),
            (None, "equation") => i64::try_from(self.counted).unwrap_or(i64::MAX),
            _ => i64::try_from(self.section).unwrap_or(i64::MAX),
        };
        let count = match written {
            _ if steps => count.checked_add(1),
            Some(value) if name == "addtocounter" => count.checked_add(value),
            value => value,
        };
        let is_known = matches!(own.as_str(), "equation" | "section");
        match count.filter(|_| is_known).and_then(|count| u32::try_from(count).ok()) {
            Some(count) => match (&mut self.group, own.as_str()) {
                (Some((_, letter)), "equation") => *letter = count.min(MOST_LETTERS),
                (None, "equation") => self.counted = count as usize,
                _ => {
                    self.section = count as usize;
                    if steps && self.within_sections {
                        self.counted = 0;
                    }
                }
            },
            None => {
                let problem = format!(r"this `\{name}` of `{own}` is not followed: write a number");
                self.faults.push((here, problem));
            }
        }
        inside
    }

    fn included(&mut self, here: usize, name: String) {
        let problem = if self.open.contains(&name) {
            format!("`{name}` includes itself")
        } else if self.open.len() >= DEEPEST || self.files.len() >= MOST_FILES {
            format!("`{name}` is not included: the files are too many, or too deep in each other")
        } else {
            match (self.include)(&name) {
                Ok(text) if self.text.len() + text.len() > LONGEST => {
                    format!(
                        "`{name}` is not included: all together is more than {} MB",
                        LONGEST >> 20
                    )
                }
                Ok(text) => {
                    self.open.push(name.clone());
                    self.file(Some(name), &text);
                    self.open.pop();
                    return;
                }
                Err(problem) => format!("`{name}` cannot be included: {problem}"),
            }
        };
        self.faults.push((here, problem));
    }

    fn display(&mut self, body: Range<usize>, numbers: Numbers, name: &str) {
        let first = self.formulas.len();
        let (start, end) = (body.start, body.end);
        print_relations(&mut self.text, body.clone());
        if self.markup == Markup::Markdown {
            let comments = self.comments_of_tex(body.clone());
            self.waiting.extend(comments);
            let place = |number: &usize| self.comments.get(*number).map(|comment| comment.part.start);
            self.waiting.make_contiguous().sort_by_key(place);
        }
        let mut last_has_number = true;
        // a row behind the last sign of a row has a number too, empty as it is
        let mut rows_end = outside(&self.text, body.clone())
            .into_iter()
            .filter_map(|found| match found {
                Outside::Row(at) => Some(at.end),
                _ => None,
            });
        let has_empty_row = rows_end
            .next_back()
            .and_then(|at| self.text.get(at..end))
            .is_some_and(|rest| rest.trim().is_empty());
        for (place, row) in rows(&mut self.text, body, name).into_iter().enumerate() {
            if self.is_full(row.part.start) {
                break;
            }
            let is_own = match numbers {
                Numbers::Rows => row.numbers > 0,
                // one number of several rows is that of the first
                Numbers::One => row.numbers > 0 && place == 0,
                Numbers::None => false,
            };
            let has_lost_count = self.has_lost_count;
            let number = || is_own.then(|| self.count()).filter(|_| !has_lost_count);
            let number = row.tag.clone().or_else(number);
            if numbers == Numbers::Rows && number.is_some() {
                // the other numbers of a formula of several rows
                for _ in 1..row.numbers {
                    self.count();
                }
            }
            // a row without a number has that of the next
            let shares = row.continues.is_some() || numbers != Numbers::Rows || !last_has_number;
            let goes_with_last = place > 0 && shares;
            last_has_number = number.is_some() || (goes_with_last && last_has_number);
            self.formula(row, number, goes_with_last, first, end);
        }
        if has_empty_row && numbers == Numbers::Rows {
            self.count();
        }
        if self.formulas.len() > first {
            for (part, said) in asides::at_braces(&self.text, start..end) {
                // it holds of its row, and of the links behind it
                let rows = self.formulas.get(first..).unwrap_or_default();
                let own = rows
                    .iter()
                    .position(|row| row.part.start <= part.start && part.start < row.part.end);
                let Some(own) = own.filter(|own| !is_parted_by_blanks(&self.text, rows.get(*own))) else {
                    continue;
                };
                let links = rows.iter().skip(own + 1).take_while(|row| row.is_link);
                let until = links.last().or(rows.get(own)).map_or(end, |row| row.part.end);
                self.keep_aside(part, &said, Announced::Behind, first + own, until);
            }
        }
        // what is said behind a display of one number is said of all of it
        let known = self.line_end.as_ref();
        if !known.is_some_and(|known| (known.start..=known.end).contains(&end)) {
            let rest = self.text.get(end..).unwrap_or_default();
            self.line_end = Some(end..rest.find('\n').map_or(self.text.len(), |found| end + found));
        }
        let line = self.line_end.as_ref().map_or(end, |known| known.end);
        let last = self.formulas.len().wrapping_sub(1);
        let own = self.text.get(start..end).unwrap_or_default();
        let is_apart = !own.contains('\n') || own.trim_end_matches([' ', '\t']).ends_with('\n');
        let is_silent = |formula: &Formula| formula.comments.is_empty();
        let is_of_display =
            is_apart && first < last && self.formulas.get(first..).is_some_and(|all| all.iter().all(is_silent));
        let formula = match numbers {
            Numbers::Rows if !is_of_display => last,
            _ => first,
        };
        let behind = self.text.get(end..line).unwrap_or_default();
        let closing = ["$$", r"\]", "```"]
            .iter()
            .find(|sign| behind.starts_with(**sign))
            .map_or(0, |sign| sign.len());
        let behind = behind.get(closing..).unwrap_or_default();
        let opens = |at: &usize| {
            let rest = behind.get(*at..).unwrap_or_default();
            ["$$", r"\[", r"\begin"].iter().any(|sign| rest.starts_with(sign))
        };
        let next = behind.match_indices(['$', '\\']).map(|(at, _)| at).find(opens);
        let line = next.map_or(line, |next| end + closing + next);
        if self.formulas.len() > first {
            self.take_comments(line, Some(formula));
            if let Some(formula) = self.formulas.get_mut(formula) {
                formula.is_of_display = is_of_display && !formula.comments.is_empty();
            }
        }
    }

    fn count(&mut self) -> String {
        let letter = |number: usize| {
            u32::try_from(number)
                .ok()
                .and_then(|number| char::from_u32(64 + number))
        };
        let section = match (self.within_sections, self.is_appendix) {
            (true, true) => letter(self.section).map_or(String::new(), |letter| format!("{letter}.")),
            (true, false) => format!("{}.", self.section),
            (false, _) => String::new(),
        };
        let number = match &mut self.group {
            Some((number, letter)) => {
                *letter += 1;
                let letter = char::from_u32(u32::from('a') + *letter - 1).unwrap_or('?');
                format!("{number}{letter}")
            }
            None => {
                self.counted += 1;
                self.counted.to_string()
            }
        };
        section + &number
    }

    /// Adds a formula of a display that ends at byte `end`.
    fn formula(&mut self, row: Row, number: Option<String>, goes_with_last: bool, first: usize, end: usize) {
        let own = self.text.get(row.part.clone()).unwrap_or_default();
        let side = row
            .continues
            .clone()
            .and_then(|side| self.text.get(side))
            .unwrap_or_default();
        let tex = match side {
            "" => own.to_owned(),
            side => format!("{side} {own}"),
        };
        let tex = match row.problem {
            Some(problem) => Err(problem.to_owned()),
            None => self.macros.expanded(&tex),
        };
        self.formulas.push(Formula {
            part: row.part,
            tex,
            number,
            labels: row.labels,
            is_link: row.continues.is_some(),
            is_doubtful: row.is_doubtful,
            goes_with_last,
            first,
            comments: Vec::new(),
            is_of_display: false,
            is_aside: false,
            until: usize::MAX,
        });
        self.take_comments(row.line_end.min(end), Some(self.formulas.len() - 1));
    }
}

/// The name of the directive that the line of a fence opens: `note` of `{note} Title`.
fn directive(information: &str) -> Option<&str> {
    let (name, _) = information.trim_start().strip_prefix('{')?.split_once('}')?;
    let is_name = |c: char| c.is_ascii_alphanumeric() || "-_:+".contains(c);
    (!name.is_empty() && name.chars().all(is_name)).then_some(name)
}

/// Returns the start of the fence that ends a block: a line of nothing but its sign, no fewer than at its start.
fn end_of_fence(text: &str, fence: &str, sign: char) -> Option<usize> {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let own = line.trim();
        if at > 0 && own.starts_with(fence) && own.chars().all(|c| c == sign) {
            return Some(at + line.len() - line.trim_start().len());
        }
        at += line.len();
    }
    None
}

/// Returns true if a directive holds text.
fn holds_text(name: &str) -> bool {
    TEXT.contains(&name) || name.starts_with("prf:") || name.starts_with("proof:")
}

/// Where the `\else` and the `\fi` of a conditional stand that begins at byte `start`.
fn branches(text: &str, start: usize, end: usize) -> Option<(Option<usize>, usize)> {
    let own = text.get(start..end)?;
    let (mut depth, mut other, mut is_name) = (0_usize, None, false);
    for (word, next) in words(own) {
        let here = start + next - word.len() - 1;
        match word {
            _ if is_name => is_name = false,
            "newif" => is_name = true,
            "else" if depth == 0 => other = other.or(Some(here)),
            "fi" if depth == 0 => return Some((other, here)),
            "fi" => depth -= 1,
            "iff" => {}
            word if word.starts_with("if") && !BRACED.contains(&word) => depth += 1,
            _ => {}
        }
    }
    None
}

/// Whether a command changes the number of equations or sections.
fn is_counter(text: &str, word: &str, next: usize) -> bool {
    let own = text
        .get(after_blanks(text, next)..)
        .and_then(|rest| rest.strip_prefix('{'));
    let is = |name: &&str| own.is_some_and(|own| own.strip_prefix(*name).is_some_and(|rest| rest.starts_with('}')));
    matches!(word, "setcounter" | "addtocounter" | "stepcounter" | "refstepcounter")
        && ["equation", "parentequation", "section"].iter().any(is)
}

/// Whether a line between the first and the last holds nothing.
fn has_empty_line(text: &str) -> bool {
    let lines: Vec<&str> = text.split('\n').collect();
    let inner = lines.get(1..lines.len().saturating_sub(1)).unwrap_or_default();
    inner.iter().any(|line| line.trim().is_empty())
}

/// The label that Quarto and pandoc-crossref, `$$ {#eq-law}`, and MyST, `$$ (law)`, have behind a display of Markdown.
fn label_behind(rest: &str) -> Option<&str> {
    let line = rest.lines().next()?.trim();
    let label = match line.strip_prefix("{#") {
        Some(attributes) => attributes.strip_suffix('}')?.split_whitespace().next()?,
        None => line.strip_prefix('(')?.strip_suffix(')')?,
    };
    let is_of_a_label = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | ':' | '.');
    (!label.is_empty() && label.chars().all(is_of_a_label)).then_some(label)
}
