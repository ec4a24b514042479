//! The guide for assistants: instructions, and pages as resources.

use serde_json::{Value, json};

/// Instructions for an assistant, with the grammar of comments in short. A test runs their examples.
pub const INSTRUCTIONS: &str = r#"vibro-audit decides if a formula of TeX follows from its premises.

How to work:
1. Call `audit` with the text of a document and its name (paper.tex, notes.md, fall.toml), or with the path of a file.
2. Where the document lacks comments, all is guessed and nothing is refuted. Write comments that say what each formula
   is, and audit again. The column `reason` says what a row needs.
3. `explain` prints the proof or the counterexample of one formula.
4. `repair` gives edits that make a refuted formula provable. Apply one, and audit again: it is `proved` then.

Verdicts: `proved`; `refuted` (at the values in `counterexample` every premise holds and both sides differ); `undecided`
(neither was found; never a pass; `effort` searches further); `unread` (`reason` says why); and in documents without
comments `given` (a definition or a law), `suspect` (a likely misprint) and `conditional`.

Comments that do not print: `% audit: ...` in TeX, `<!-- audit: ... -->` in Markdown; on the line of the display
or before it; keys are separated by `;`:
  symbols a, b; positive m, g      once: declares letters; also `states`, `indices n`, `functions F' = f`
  claim | premise | definition     the role of the formula; `skip` leaves it out; `default claim` is said once for all
  follows from (9), \eqref{fall}   what a claim follows from; a claim without it is an identity
  assume x > 0                     a condition
  where \Delta = b^2 - 4 a c       a definition for this formula alone
  with r = r_B                     a substitution in the premises
  expect refuted                   the verdict that the author expects; `label X` names the formula

Example, fall.tex:
  % audit: symbols E, v, h, H; positive m, g
  \begin{equation} E = \frac{1}{2} m v^2 + m g h \label{energy} \end{equation}  % audit: premise
  \begin{equation} E = m g H \label{rest} \end{equation}                        % audit: premise
  \begin{equation} v^2 = 2 g (H - h) \end{equation}  % audit: claim; follows from \eqref{energy}, \eqref{rest}

The same as a sheet, fall.toml:
  [symbols]
  parameters = ['E', 'v', 'h', 'H', 'm', 'g']
  positive = ['m', 'g']
  [[equation]]
  label = "energy"
  role = "premise"
  tex = '''E = \frac{1}{2} m v^2 + m g h'''
  [[equation]]
  label = "rest"
  role = "premise"
  tex = '''E = m g H'''
  [[equation]]
  label = "speed"
  role = "claim"
  tex = '''v^2 = 2 g (H - h)'''
  follows_from = ["energy", "rest"]

Never weaken a claim, or add a premise or condition, only to make it `proved`: tell the author what fails."#;

/// A page of the guide.
#[derive(Clone, Copy, Debug)]
pub struct Resource {
    pub uri: &'static str,
    title: &'static str,
    description: &'static str,
    text: &'static str,
}

/// The pages that an assistant may read.
pub const RESOURCES: [Resource; 4] = [
    Resource {
        uri: "vibro-audit://guide/documents",
        title: "Documents",
        description: "TeX and Markdown documents: which formulas are read, and all keys of `% audit:` comments",
        text: include_str!("../../../doc/reference/documents.md"),
    },
    Resource {
        uri: "vibro-audit://guide/sheets",
        title: "Sheets of formulas",
        description: "Sheets in TOML: symbols, premises, claims",
        text: include_str!("../../../doc/reference/sheets.md"),
    },
    Resource {
        uri: "vibro-audit://guide/truth",
        title: "What the verdicts mean",
        description: "The promise of each verdict, when a claim is true, and how notation is read",
        text: include_str!("../../../doc/reference/verdicts.md"),
    },
    Resource {
        uri: "vibro-audit://guide/scenes",
        title: "Scenes",
        description: "Scenes in TOML: the motions of a vibro-impact device",
        text: include_str!("../../../doc/reference/scenes.md"),
    },
];

/// The media type of the pages.
const MARKDOWN: &str = "text/markdown";

impl Resource {
    /// Returns the resource as a list names it.
    pub fn described(self) -> Value {
        json!({
            "uri": self.uri,
            "name": self.title,
            "description": self.description,
            "mimeType": MARKDOWN,
        })
    }

    /// Returns the text of the resource.
    pub fn content(self) -> Value {
        json!({ "uri": self.uri, "mimeType": MARKDOWN, "text": self.text })
    }
}
