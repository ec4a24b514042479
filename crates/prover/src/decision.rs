//! What was decided of one claim, and why.

use super::counterexample::Counterexample;
use claims::{Fault, Rules, Sheet, Standing, Statements, Verdict};
use numbers::Rational;
use std::collections::HashSet;
use texmath::{DoubtKind, Equation, Name};

/// What was decided of one claim, and why.
///
/// The verdict is set by `accept_proofs`, `accept_refutation` and `conclude` alone, or is `undecided` or `unread`; `on_doubts` may
/// keep it back, and `settle_second_values` gives it back. There is no
/// default: that of a verdict is the one that a sheet expects, `proved`.
#[derive(Clone, Debug)]
pub struct Decision {
    pub label: String,
    pub verdict: Verdict,
    pub expected: Verdict,
    /// The standing of the formula in a document without comments.
    pub standing: Standing,
    pub counterexample: Option<Counterexample>,
    pub reason: String,
    /// What the proof excludes: sets that are thin in generic symbols, derivatives that must exist.
    pub provided: Vec<String>,
    /// The rules by which the claim was reduced to the goals that were decided.
    pub rules: Rules,
    /// The meanings that were taken wherever its notation, or that of what it rests on, has more than one.
    pub readings: Vec<String>,
    /// True if it was decided in the sheet in which premises that take one index to the next hold at each.
    pub at_each_index: bool,
    /// The equation that was not proved, of the several that a label may have.
    pub failed: Option<Equation>,
    /// The file that the formula stands in, where it is one that the document includes.
    pub file: Option<String>,
    /// The point of a proof, at which what is given holds: what the claim speaks of, with its values.
    pub point: Vec<(String, String)>,
    /// Whether nothing is left to decide: what is given contradicts itself, or the claim is nowhere defined.
    pub is_vacuous: bool,
    /// True if it would be refuted should the guess be right.
    pub fails: bool,
    /// A verdict that waits until second values of letters are proved: else they may be new meanings.
    pub(super) waiting: Option<Waiting>,
    /// The condition, that a factor is not 0, under which a claim follows that fails at some points without it and holds at others.
    pub(super) exception: Option<Equation>,
    /// The other meanings that its premises may have, where they bear on the verdict.
    pub(super) doubts: Vec<DoubtKind>,
    /// Line and column in the file: of what cannot be read, else of the formula.
    pub place: Option<(usize, usize)>,
}

/// A verdict that is kept back until other formulas are proved.
#[derive(Clone, Debug)]
pub(super) struct Waiting {
    /// The formulas that must be proved.
    labels: Vec<String>,
    verdict: Verdict,
    reason: String,
}

impl Decision {
    /// Returns the verdict once the second values of letters that a proof rests on are proved.
    pub(super) fn found(&self) -> Verdict {
        self.waiting.as_ref().map_or(self.verdict, |waiting| waiting.verdict)
    }

    /// Adds what the verdict holds under.
    pub(super) fn provide(&mut self, conditions: impl IntoIterator<Item = String>) {
        for condition in conditions {
            if !self.provided.contains(&condition) {
                self.provided.push(condition);
            }
        }
    }

    /// Makes the decision on a goal a proof of it: by what the kernel accepted for each of its questions, of which there is
    /// one at least.
    pub(super) fn accept_proofs(&mut self, proofs: &[kernel::Proved]) {
        if !proofs.is_empty() {
            self.verdict = Verdict::Proved;
        }
    }

    /// Makes the decision on a goal a refutation of it, by what the kernel accepted for one of its questions.
    pub(super) fn accept_refutation(&mut self, refuted: &kernel::Refuted) {
        self.verdict = Verdict::Refuted;
        self.is_vacuous = refuted.is_nowhere_defined();
    }

    /// Makes the decision on a claim a proof of it: by its goals, which are enough together, and all proved.
    pub(super) fn conclude(&mut self, goals: Vec<Self>) {
        if !goals.is_empty() && goals.iter().all(|goal| goal.verdict == Verdict::Proved) {
            self.verdict = Verdict::Proved;
        }
        for goal in goals {
            if self.point.is_empty() {
                self.point = goal.point;
            }
            self.provide(goal.provided);
            self.rules.extend(goal.rules);
        }
    }

    /// The rules that a verdict rests on; none of a claim that is open.
    pub fn reductions(&self) -> String {
        let is_decided = matches!(self.verdict, Verdict::Proved | Verdict::Refuted | Verdict::Conditional);
        let rules = self.rules.iter().filter(|_| is_decided).map(ToString::to_string);
        rules.collect::<Vec<_>>().join("; ")
    }

    /// Returns true if the verdict is the one that the sheet expects; of a document without comments nothing is expected, and nothing
    /// may be suspect.
    pub fn is_expected(&self) -> bool {
        match self.standing {
            Standing::Said => self.verdict == self.expected,
            _ => !matches!(self.verdict, Verdict::Suspect | Verdict::Refuted),
        }
    }

    /// Makes the decision on a formula of which nobody says what it is that it is suspect: it fails, and a small repair of it is
    /// proved.
    pub fn suspect(&mut self) {
        if self.fails && self.standing != Standing::Said {
            self.verdict = Verdict::Suspect;
        }
    }

    /// Makes the decision on a formula that it is given.
    pub(super) fn given(mut self, reason: String) -> Self {
        (self.verdict, self.reason) = (Verdict::Given, reason);
        self.provided.clear();
        self
    }

    /// The decision on the entry at a position before anything is known of it: undecided.
    pub fn of(sheet: &Sheet, position: usize) -> Self {
        let entry = sheet.entries.get(position);
        Self {
            label: entry.map(|entry| entry.label.clone()).unwrap_or_default(),
            verdict: Verdict::Undecided,
            expected: entry.map(|entry| entry.expect).unwrap_or_default(),
            standing: entry.map(|entry| entry.standing).unwrap_or_default(),
            counterexample: None,
            reason: String::new(),
            provided: Vec::new(),
            rules: Rules::new(),
            readings: Vec::new(),
            failed: None,
            file: entry.and_then(|entry| entry.tex.file.clone()),
            doubts: Vec::new(),
            point: Vec::new(),
            is_vacuous: false,
            fails: false,
            at_each_index: false,
            exception: None,
            waiting: None,
            place: entry.map(|entry| entry.tex.place()),
        }
    }

    /// The decision on a part of a claim as that on the claim.
    pub(super) fn in_part(mut self, part: &str) -> Self {
        if !part.is_empty() {
            self.reason = format!("{part}: {}", self.reason);
        }
        self
    }

    /// Says at which numbers for letters of the claim it fails, of which the counterexample does not speak.
    pub(super) fn with(mut self, values: &[(Name, Rational)]) -> Self {
        if let Some(own) = &mut self.counterexample {
            let new = values.iter().map(|(name, value)| (name.to_string(), value.to_string()));
            let new: Vec<(String, String)> = new
                .filter(|(name, _)| own.point.iter().all(|(known, _)| known != name))
                .collect();
            own.point.splice(0..0, new);
        }
        self
    }

    /// Says what the verdict rests on that nobody said, and which other meanings the claim may have: nothing is refuted on a
    /// guess, or under one meaning of several, nor proved where that is not the usual one.
    pub(super) fn on_doubts(mut self, mut doubts: Vec<DoubtKind>) -> Self {
        doubts.append(&mut self.doubts);
        let (guesses, others): (Vec<&DoubtKind>, Vec<&DoubtKind>) =
            doubts.iter().partition(|kind| matches!(kind, DoubtKind::Guess(_)));
        let joined = |kinds: &[&DoubtKind]| kinds.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
        let is_binding = |kind: &DoubtKind| !kind.spares_proofs() && !matches!(kind, DoubtKind::Factor { .. });
        if self.verdict == Verdict::Refuted
            && let Some(condition) = self.exception.take().filter(|_| !doubts.iter().any(is_binding))
        {
            self.verdict = Verdict::Conditional;
            self.reason = format!("follows but for values at which {} = 0", condition.left);
            self.provide([condition.to_string()]);
            return self;
        }
        let is_refuted = self.verdict == Verdict::Refuted;
        let binding: Vec<&DoubtKind> = match self.verdict {
            Verdict::Refuted => others,
            Verdict::Proved => others.into_iter().filter(|kind| !kind.spares_proofs()).collect(),
            _ => Vec::new(),
        };
        if guesses.is_empty() && binding.is_empty() {
            return self;
        }
        if let Some(point) = self.counterexample.take() {
            self.reason = format!("fails at {point}");
        }
        if !guesses.is_empty() {
            let link = if is_refuted {
                ", if the guess is right that "
            } else {
                "; guessed: "
            };
            self.reason = format!("{}{link}{}", self.reason, joined(&guesses));
        }
        let second_value = |kind: &&DoubtKind| match kind {
            DoubtKind::SecondValue(label) => Some(label.clone()),
            _ => None,
        };
        let labels: Option<Vec<String>> = binding.iter().map(second_value).collect();
        self.waiting = labels
            .filter(|labels| !labels.is_empty() && !is_refuted)
            .map(|labels| Waiting {
                labels,
                verdict: self.verdict,
                reason: self.reason.clone(),
            });
        if !binding.is_empty() {
            self.reason = format!("{}; it may be meant in another way: {}", self.reason, joined(&binding));
        }
        // numbers are matrices of one row, and complex
        let spares = |kind: &&DoubtKind| matches!(kind, DoubtKind::Marked(_));
        self.fails = is_refuted && binding.iter().all(spares);
        if is_refuted || !binding.is_empty() {
            self.verdict = Verdict::Undecided;
        }
        self
    }

    /// What bears on the claim at a position, where there is anything to search for.
    ///
    /// # Errors
    /// The decision, where the claim cannot be read, or something that it follows from.
    pub fn without_search(sheet: &Sheet, position: usize) -> Result<Statements, Box<Self>> {
        let decision = Self::of(sheet, position);
        let unread = |fault: &Fault| {
            Box::new(Self {
                verdict: Verdict::Unread,
                reason: fault.message.clone(),
                place: fault.place.or(decision.place),
                ..decision.clone()
            })
        };
        if let Some(fault) = sheet.entries.get(position).and_then(|entry| entry.unread.as_ref()) {
            return Err(unread(fault));
        }
        let below = sheet.unread_below(position);
        if !below.is_empty() {
            let labels: Vec<String> = below.iter().map(|label| format!("({label})")).collect();
            let reason = format!("rests on {}, which cannot be read", labels.join(", "));
            return Err(Box::new(Self { reason, ..decision }));
        }
        Statements::gather(sheet, position).map_err(|fault| unread(&fault))
    }
}

/// Takes the proofs of decisions, in the order of their formulas, that rest on second values of letters, where these are proved: what
/// follows from what stands before gives no letter a new meaning.
pub fn settle_second_values<'a>(decisions: impl Iterator<Item = &'a mut Decision>) {
    let mut proved: HashSet<String> = HashSet::new();
    for decision in decisions {
        if let Some(waiting) = decision.waiting.take()
            && waiting.labels.iter().all(|label| proved.contains(label))
        {
            decision.verdict = waiting.verdict;
            decision.reason = waiting.reason;
        }
        if decision.verdict == Verdict::Proved {
            proved.insert(decision.label.clone());
        }
    }
}

/// Says of each decision that rests on a refuted claim that it does.
pub fn mention_refuted<'a>(sheet: &Sheet, decisions: impl Iterator<Item = &'a mut Decision>) {
    let mut decisions: Vec<&mut Decision> = decisions.collect();
    let refuted = decisions.iter().filter(|d| d.verdict == Verdict::Refuted);
    let refuted: HashSet<String> = refuted.map(|d| d.label.clone()).collect();
    let positions = sheet.positions();
    for decision in &mut decisions {
        let position = positions.get(decision.label.as_str());
        let Some(entry) = position.and_then(|&n| sheet.entries.get(n)) else {
            continue;
        };
        let premises = entry.follows_from.iter().filter_map(|&n| sheet.entries.get(n));
        let wrong = premises.filter(|premise| refuted.contains(&premise.label));
        let wrong: Vec<String> = wrong.map(|premise| format!("({})", premise.label)).collect();
        if !wrong.is_empty() && decision.verdict != Verdict::Unread {
            decision.reason = format!(
                "{}; taken as given although refuted: {}",
                decision.reason,
                wrong.join(", ")
            );
        }
    }
}
