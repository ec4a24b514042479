//! Decisions that are kept: a formula is decided anew only if something has changed on which its verdict can depend.

use crate::claim::{Fault, Fingerprint, Sheet, Standing, Verdict};
use crate::cli::audit_table::Row;
use crate::cli::decide::{Judged, complete, judge, mend};
use crate::prove;
use crate::repair::Repairs;
use crate::stop::Token;
use crate::tex::{Meaning, Name, names_of};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The entries on either side of a claim that its repairs take names and terms from.
const NEIGHBOURS: usize = 12;

/// The decisions that are kept, at most.
const MOST_KEPT: usize = 20_000;

/// Keys of the claims of a sheet.
pub struct Keys {
    /// A key of all that a verdict depends on: the claim and what it follows from, over any number of steps, as
    /// printed and as read; what is declared of the names in them; the names that definitions give; and the options.
    alone: Vec<u128>,
    /// A key of all that repairs depend on too: the entries around the claim, the laws before it, and which
    /// names there are.
    near: Vec<u128>,
}

/// Something that is said of a name in the symbols of a sheet, which bears on the entries that speak of the name.
struct Declared {
    /// The base of the name, without a backslash.
    base: String,
    said: String,
}

/// Returns true for a meaning that bears on nothing but the formulas that print its name.
fn is_plain(meaning: &Meaning) -> bool {
    matches!(
        meaning,
        Meaning::Parameter
            | Meaning::Generic
            | Meaning::Positive
            | Meaning::AtMostOne
            | Meaning::Nonnegative
            | Meaning::Nonzero
            | Meaning::Integer
            | Meaning::Complex
    )
}

/// Returns what the symbols say of single names, and a fingerprint of all else in them.
fn declared(sheet: &Sheet) -> (Vec<Declared>, Fingerprint) {
    let (symbols, mut rest) = (&sheet.symbols, Fingerprint::default());
    let mut of_name: BTreeMap<&Name, Vec<&Meaning>> = BTreeMap::new();
    for (name, meaning) in symbols.declarations() {
        of_name.entry(name).or_default().push(meaning);
    }
    let (plain, others): (Vec<_>, Vec<_>) = of_name
        .into_iter()
        .partition(|(_, meanings)| meanings.iter().all(|meaning| is_plain(meaning)));
    rest.add(&others);
    rest.add(&(&symbols.index, &symbols.relations, &symbols.laws));
    let names = &symbols.names;
    rest.add(&(&names.matrices, &names.running, names.opaque.is_some()));
    let base = |text: &str| text.trim_start_matches('\\').to_owned();
    let mut all: Vec<Declared> = Vec::new();
    for (name, meanings) in plain {
        let said = format!("{name:?} {meanings:?}");
        let base = base(&name.base);
        all.push(Declared { base, said });
    }
    let lists = [&names.functions, &names.defined, &names.several, &names.complex];
    for (number, list) in lists.into_iter().enumerate() {
        all.extend(list.iter().map(|name| Declared {
            base: base(&name.base),
            said: format!("{number} {name:?}"),
        }));
    }
    let (opaque_factors, opaque_functions) = names
        .opaque
        .as_ref()
        .map(|opaque| (opaque.factors.iter().collect(), opaque.functions.iter().collect()))
        .unwrap_or_default();
    let lists: [Vec<&String>; 4] = [
        names.words.iter().collect(),
        names.letters.iter().collect(),
        opaque_factors,
        opaque_functions,
    ];
    for (number, list) in lists.into_iter().enumerate() {
        all.extend(list.into_iter().map(|text| Declared {
            base: base(text),
            said: format!("text {number} {text}"),
        }));
    }
    (all, rest)
}

impl Keys {
    /// Computes the keys of the claims of a sheet.
    pub fn new(sheet: &Sheet, options: &prove::Options) -> Self {
        let count = sheet.entries.len();
        let own: Vec<u128> = sheet.fingerprints().iter().map(Fingerprint::value).collect();
        let (declared, mut shared) = declared(sheet);
        shared.add(&options.effort);
        shared.add(&sheet.definitions().collect::<Vec<_>>());
        let shared = shared.value();
        let names: Vec<BTreeSet<Name>> = sheet.entries.iter().map(|entry| names_of(&entry.equations)).collect();
        let texts = sheet.printed_texts();
        let spoken_of = texts.iter().zip(&names).map(|(text, names)| {
            // a letter of Unicode may be a command
            let is_met = |own: &&Declared| {
                !text.is_ascii()
                    || text.contains(&own.base)
                    || names.iter().any(|name| name.base.trim_start_matches('\\') == own.base)
            };
            declared.iter().filter(is_met).map(|own| own.said.as_str()).collect()
        });
        let spoken_of: Vec<Vec<&str>> = spoken_of.collect();
        let below = |position: usize| {
            let (mut seen, mut next) = (BTreeSet::new(), vec![position]);
            while let Some(position) = next.pop() {
                if seen.insert(position) {
                    next.extend(sheet.entries.get(position).map_or(&[][..], |entry| &entry.follows_from));
                }
            }
            seen
        };
        let mut before: HashSet<&Name> = HashSet::new();
        let mut alone = Vec::with_capacity(count);
        for (position, entry) in sheet.entries.iter().enumerate() {
            let mut key = Fingerprint::default();
            key.add(&shared);
            let all: Vec<usize> = below(position).into_iter().collect();
            let rank = |position: &usize| all.binary_search(position).unwrap_or(usize::MAX);
            for part in &all {
                let follows_from = sheet.entries.get(*part).map_or(&[][..], |entry| &entry.follows_from);
                key.add(&(own.get(*part), follows_from.iter().map(rank).collect::<Vec<_>>()));
            }
            let said = all.iter().filter_map(|&part| spoken_of.get(part)).flatten();
            key.add(&said.collect::<BTreeSet<_>>());
            key.add(&rank(&position));
            let names = names.get(position);
            if entry.standing == Standing::Link {
                // whether a letter is new is seen from what stands before
                key.add(&names.map(|names| names.iter().filter(|name| before.contains(name)).collect::<Vec<_>>()));
            }
            before.extend(names.into_iter().flatten());
            alone.push(key.value());
        }
        let mut all = Fingerprint::default();
        for entry in &sheet.entries {
            all.add(&(&entry.label, &entry.follows_from, entry.unread.is_some()));
        }
        all.add(&before.iter().collect::<BTreeSet<_>>());
        let all = all.value();
        let near = (0..count).map(|position| {
            let mut key = Fingerprint::default();
            key.add(&(all, alone.get(position)));
            let window = position.saturating_sub(NEIGHBOURS)..(position + NEIGHBOURS + 1).min(count);
            key.add(&(window.start.abs_diff(position), alone.get(window)));
            let empty = BTreeSet::new();
            let letters = names.get(position).unwrap_or(&empty);
            for (law, entry) in sheet.entries.iter().enumerate().take(position) {
                if entry.standing == Standing::Law && names.get(law).is_some_and(|names| names.is_subset(letters)) {
                    key.add(&own.get(law));
                }
            }
            key.value()
        });
        let near = near.collect();
        Self { alone, near }
    }
}

/// A kept decision, and the analysis that has used it last.
struct Kept<T> {
    value: T,
    used: u64,
}

/// Kept decisions by their keys.
struct Table<T>(Mutex<HashMap<u128, Kept<T>>>);

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T: Clone> Table<T> {
    fn lock(&self) -> MutexGuard<'_, HashMap<u128, Kept<T>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn get(&self, key: u128, now: u64) -> Option<T> {
        let mut table = self.lock();
        let kept = table.get_mut(&key)?;
        kept.used = now;
        Some(kept.value.clone())
    }

    fn keep(&self, key: u128, value: &T, now: u64) {
        let mut table = self.lock();
        if table.len() >= MOST_KEPT {
            table.retain(|_, kept| kept.used + 1 >= now);
        }
        if table.len() < MOST_KEPT {
            let value = value.clone();
            table.insert(key, Kept { value, used: now });
        }
    }
}

/// The decisions on the formulas of a document, kept from one version of its text to the next.
#[derive(Default)]
pub struct Memory {
    judged: Table<Judged>,
    mended: Table<Option<Repairs>>,
    now: Mutex<u64>,
}

/// The rows of a sheet, and how many claims that can be read were decided for them.
pub struct Decided {
    pub rows: Vec<Row>,
    pub anew: usize,
    /// True if the repairs of a refuted claim are not looked for yet.
    pub lacks_repairs: bool,
}

impl Memory {
    /// Decides the claims of a sheet on all cores, with the repairs of refuted ones where they are asked for.
    /// Decisions that are stopped on the way are not kept.
    ///
    /// # Errors
    /// The faults of [`judge`], and a token that is stopped.
    pub fn decide(&self, sheet: &Sheet, keys: &Keys, options: &prove::Options, repair: bool) -> Result<Decided, Fault> {
        let now = {
            let mut now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
            *now += 1;
            *now
        };
        let token = Token::current();
        let each = |&position: &usize| {
            token.during(|| {
                if token.is_stopped() {
                    return Err(Fault::new("stopped"));
                }
                let mut is_new = false;
                let key = |keys: &[u128]| keys.get(position).copied().unwrap_or_default();
                let known = self.judged.get(key(&keys.alone), now);
                let judged = match known {
                    Some(judged) => judged.moved(sheet, position),
                    None => {
                        let judged = judge(sheet, position, options)?;
                        is_new = judged.verdict() != Verdict::Unread;
                        // the place of what cannot be read may be another
                        if is_new && !token.is_stopped() {
                            self.judged.keep(key(&keys.alone), &judged, now);
                        }
                        judged
                    }
                };
                let is_refuted = judged.verdict() == Verdict::Refuted;
                let repairs = match judged.is_accused() || is_refuted {
                    false => None,
                    true => match self.mended.get(key(&keys.near), now) {
                        Some(repairs) => repairs,
                        None if is_refuted && !repair => None,
                        None => {
                            is_new = true;
                            let repairs = mend(sheet, position, options, &judged, repair);
                            if !token.is_stopped() {
                                self.mended.keep(key(&keys.near), &repairs, now);
                            }
                            repairs
                        }
                    },
                };
                Ok((judged.row(position, repairs), is_new))
            })
        };
        let rows: Vec<(Row, bool)> = sheet.rows().par_iter().map(each).collect::<Result<_, Fault>>()?;
        let anew = rows.iter().filter(|(_, is_new)| *is_new).count();
        let mut rows: Vec<Row> = rows.into_iter().map(|(row, _)| row).collect();
        let is_lacking = |row: &Row| row.decision.verdict == Verdict::Refuted && row.repairs.is_none();
        let lacks_repairs = rows.iter().any(is_lacking);
        complete(sheet, &mut rows, options);
        Ok(Decided {
            rows,
            anew,
            lacks_repairs,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::{Document, Markup, vocabulary};
    use crate::cli::audit_table::table;
    use crate::cli::decide::decide;
    use crate::report::Format;

    fn sheet(text: &str) -> Option<Sheet> {
        let document = Document::read(text, Markup::Tex, &mut |_| Err("none".to_owned()));
        document.sheet(&vocabulary().unwrap()).ok()
    }

    fn csv(rows: &[Row], sheet: &Sheet) -> String {
        let mut bytes = Vec::new();
        table(rows, sheet, Format::Csv)
            .unwrap()
            .write(&mut bytes, Format::Csv, 12)
            .unwrap();
        String::from_utf8(bytes).unwrap()
    }

    /// Holds the rows of a memory against those that are decided anew, and returns how many it has decided.
    fn step(memory: &Memory, text: &str) -> Option<usize> {
        let (sheet, options) = (sheet(text)?, prove::Options::default());
        let decided = memory
            .decide(&sheet, &Keys::new(&sheet, &options), &options, true)
            .unwrap();
        let fresh = sheet
            .rows()
            .into_par_iter()
            .map(|position| decide(&sheet, position, &options, true).unwrap());
        let mut fresh: Vec<Row> = fresh.collect();
        complete(&sheet, &mut fresh, &options);
        assert_eq!(csv(&decided.rows, &sheet), csv(&fresh, &sheet), "{text}");
        Some(decided.anew)
    }

    /// Holds the memory against fresh decisions after each of these edits.
    fn edit(text: &str, edits: &[(&str, &str)]) -> Vec<usize> {
        let (memory, mut text) = (Memory::default(), text.to_owned());
        let mut counts = vec![step(&memory, &text).unwrap()];
        for (old, new) in edits {
            assert!(text.contains(old), "{old}");
            text = text.replacen(old, new, 1);
            counts.extend(step(&memory, &text));
        }
        counts
    }

    const COMMENTED: &str = r"% audit: symbols a, b, c, d; positive m
\begin{equation} a = b + c \label{sum} \end{equation} % audit: premise
\begin{equation} E = m a^2 \end{equation} % audit: definition
\begin{equation} a^2 = b^2 + 2 b c + c^2 \label{square} \end{equation} % audit: claim; follows from \eqref{sum}
\begin{equation} E = m (b + c)^2 \end{equation} % audit: claim; follows from (2), \eqref{sum}
\begin{equation} (b + c)^2 = b^2 + c^2 \end{equation} % audit: claim
\begin{equation} \frac{a d}{d} = a \end{equation} % audit: claim
\begin{equation} \sqrt{m^2} = m \end{equation} % audit: claim
";

    #[test]
    fn a_formula_is_decided_anew_only_if_what_it_depends_on_changes() {
        let counts = edit(
            COMMENTED,
            &[
                // nothing that is read
                ("% audit: symbols", "% a note\n% audit: symbols"),
                // one claim; the repairs beside it take its terms
                (r"\frac{a d}{d}", r"\frac{a d^2}{d^2}"),
                // a premise, and what follows from it
                ("a = b + c", "a = c + b"),
                // a declaration of a letter that one claim prints
                ("d; positive m", "d, m"),
            ],
        );
        assert_eq!(counts[0], 5);
        assert_eq!(counts[1], 0, "{counts:?}");
        assert_eq!(counts[2], 2, "{counts:?}");
        assert!(counts[3] >= 2 && counts[3] < 5, "{counts:?}");
        assert!(counts[4] >= 1 && counts[4] < 5, "{counts:?}");
    }

    #[test]
    fn kept_decisions_are_those_that_are_decided_anew_after_edits() {
        edit(
            COMMENTED,
            &[
                ("follows from (2), ", "follows from "),
                ("% audit: definition", "% audit: claim; follows from \\eqref{sum}"),
                ("b^2 + c^2 \\end", "b^2 + 2 b c + c^2 \\end"),
                (
                    "\\begin{equation} a = b + c",
                    "\\begin{equation} d = 1 \\end{equation}\n\\begin{equation} a = b + c",
                ),
                ("positive m", "positive m; only"),
            ],
        );
        let links = r"A ball falls. Its energy is
\begin{equation} E = \frac{1}{2} m v^2 + m g h \label{energy} \end{equation}
where $h = H - s$. Then
\begin{align} (x + y)^2 &= x^2 + x y + y^2 \\ &= x^2 + 2 x y + y^2 \end{align}
\begin{equation} v = g t \end{equation}
\begin{align} E &= \frac{1}{2} m g^2 t^2 + m g h \\ &= m g (g t^2/2 - h) \end{align}
\begin{equation} \sin^2 x + \cos^2 x = 1 \end{equation}
";
        edit(
            links,
            &[
                ("x^2 + x y + y^2", "x^2 + 2 x y + y^2"),
                ("x^2 + 2 x y + y^2 \\\\", "x^2 - 2 x y + y^2 \\\\"),
                ("v = g t", "v = 2 g t"),
                ("where $h = H - s$.", ""),
                ("A ball falls.", "Let $t > 0$. Here $A$ is a matrix."),
                ("\\sin^2 x", "\\sin^2 A"),
                ("g t^2/2 - h", "g t^2/2 + h"),
                ("v = 2 g t", "v = g t"),
                ("E = \\frac{1}{2}", "E = \\frac{1}{3}"),
            ],
        );
    }

    /// Changes signs in a paper, about so many of them, and holds the memory against fresh decisions each time.
    fn change_signs(text: &str, count: usize) {
        let memory = Memory::default();
        step(&memory, text);
        let signs: Vec<usize> = text.match_indices(" + ").map(|(at, _)| at).collect();
        for at in signs.iter().step_by(signs.len().div_ceil(count)) {
            let (before, behind) = text.split_at(*at);
            step(&memory, &format!("{before} - {}", &behind[3..]));
        }
        assert_eq!(step(&memory, text), Some(0));
    }

    #[test]
    fn kept_decisions_of_a_paper_are_those_that_are_decided_anew() {
        change_signs(include_str!("../../../tests/papers/matrices.tex"), 4);
    }

    #[test]
    #[ignore = "minutes: for .ci/long"]
    fn kept_decisions_of_long_papers_are_those_that_are_decided_anew() {
        for text in [
            include_str!("../../../tests/papers/bouncing_ball.tex"),
            include_str!("../../../tests/papers/impact_oscillator.tex"),
            include_str!("../../../tests/papers/rigid_body_optics.tex"),
        ] {
            change_signs(text, 8);
        }
    }
}
