//! Absolute values between plain bars: which of them open and which close.
//!
//! `|` says neither. A bar at the start, or after an operator, opens; one at the end, or before an operator, closes;
//! one between two factors may do either. Where all the bars of a bracket can be paired in one way only, they are;
//! where in two ways, as in `|a|b|c|`, the formula is refused with both.

use super::error::Fault;
use super::token::{Bracket, Kind, Token};

/// The most plain bars on one level of brackets.
const MOST: usize = 200;

/// A plain bar: its place among the tokens, and what its neighbours allow.
struct Bar {
    place: usize,
    may_open: bool,
    may_close: bool,
}

/// Replaces each plain bar, single or double, by an opening or a closing one.
pub(super) fn pair_bars(tokens: &mut [Token<'_>]) -> Result<(), Fault> {
    pair(tokens, Kind::DoubleBar, Bracket::DoubleBar)?;
    pair(tokens, Kind::Bar, Bracket::Bar)
}

fn pair(tokens: &mut [Token<'_>], plain: Kind, bracket: Bracket) -> Result<(), Fault> {
    if !tokens.iter().any(|token| token.kind == plain) {
        return Ok(());
    }
    // The bars of each bracket that is open, and where it starts.
    let mut levels: Vec<(usize, Vec<Bar>)> = vec![(0, Vec::new())];
    let mut done = Vec::new();
    for place in 0..tokens.len() {
        match tokens.get(place).map(|token| token.kind) {
            Some(Kind::Open(_) | Kind::BraceOpen) => levels.push((place + 1, Vec::new())),
            Some(Kind::Close(_) | Kind::BraceClose) => {
                if let Some((start, bars)) = levels.pop() {
                    done.push((start, place, bars));
                }
            }
            Some(kind) if kind == plain => {
                let bar = neighbours(tokens, place);
                match levels.last_mut() {
                    Some((_, bars)) => bars.push(bar),
                    None => levels.push((place, vec![bar])),
                }
            }
            _ => {}
        }
    }
    let end = tokens.len();
    done.extend(levels.into_iter().map(|(start, bars)| (start, end, bars)));
    for (start, end, bars) in done {
        resolve(tokens, start, end, &bars, bracket)?;
    }
    Ok(())
}

/// What the tokens beside the bar at `place` allow.
fn neighbours(tokens: &[Token<'_>], place: usize) -> Bar {
    let kind = |place: usize| tokens.get(place).map(|token| token.kind);
    let before = place.checked_sub(1).and_then(kind);
    let script = place.checked_sub(2).and_then(kind);
    let scripted = matches!(script, Some(Kind::Sup | Kind::Sub));
    Bar {
        place,
        may_open: kind(place + 1).is_some_and(starts_content),
        may_close: before.is_some_and(|before| scripted || ends_factor(before)),
    }
}

fn starts_content(kind: Kind) -> bool {
    let sign = matches!(kind, Kind::Plus | Kind::Minus | Kind::PlusMinus | Kind::MinusPlus);
    sign || matches!(kind, Kind::Bar | Kind::DoubleBar) || super::part::starts_factor(kind)
}

fn ends_factor(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::Number
            | Kind::Letter
            | Kind::Word
            | Kind::Close(_)
            | Kind::BraceClose
            | Kind::Prime
            | Kind::Bar
            | Kind::DoubleBar
            | Kind::Degree
            | Kind::Factorial
    )
}

/// Decides the bars of one level of brackets, whose tokens are `start..end`.
fn resolve(tokens: &mut [Token<'_>], start: usize, end: usize, bars: &[Bar], bracket: Bracket) -> Result<(), Fault> {
    let Some(first) = bars.first().and_then(|bar| tokens.get(bar.place)).copied() else {
        return Ok(());
    };
    if bars.len() > MOST {
        let instead = "write \\left| and \\right|";
        return Err(Fault::unsupported(first.at, "so many bars", instead));
    }
    let pairing = Pairing::new(bars);
    let Some(one) = pairing.complete(Vec::new()) else {
        return Err(Fault::unclosed(first.at, first.text));
    };
    if let Some(other) = pairing.other_than(&one) {
        let level = tokens.get(start..end).unwrap_or_default();
        let plain = first.kind;
        let [one, other] = [one, other].map(|opens| printed(level, plain, &opens));
        return Err(Fault::two_readings(first.at, "these bars", &one, &other));
    }
    for (bar, opens) in bars.iter().zip(one) {
        if let Some(token) = tokens.get_mut(bar.place) {
            token.kind = match opens {
                true => Kind::Open(bracket),
                false => Kind::Close(bracket),
            };
        }
    }
    Ok(())
}

/// The ways to pair the bars of one level.
struct Pairing<'a> {
    bars: &'a [Bar],
    /// At `[n][depth]`: whether the bars from the n-th on can be paired where `depth` are open before it, and the
    /// same where the one right before it opens.
    possible: Vec<Vec<[bool; 2]>>,
}

impl<'a> Pairing<'a> {
    fn new(bars: &'a [Bar]) -> Self {
        let most = bars.len();
        let mut possible = vec![vec![[false; 2]; most + 2]; most + 1];
        if let Some(row) = possible.last_mut() {
            row[0] = [true, false];
        }
        let mut pairing = Self { bars, possible };
        for n in (0..most).rev() {
            for depth in 0..=most {
                for opened in [false, true] {
                    let fits = [false, true].map(|opens| pairing.allows(n, depth, opened, opens));
                    pairing.possible[n][depth][usize::from(opened)] = fits.contains(&true);
                }
            }
        }
        pairing
    }

    /// Whether the n-th bar may open, or close, where `depth` are open before it and the one before it `opened`.
    fn allows(&self, n: usize, depth: usize, opened: bool, opens: bool) -> bool {
        let Some(bar) = self.bars.get(n) else {
            return false;
        };
        let beside = n.checked_sub(1).and_then(|before| self.bars.get(before));
        let empty = opened && beside.is_some_and(|before| before.place + 1 == bar.place);
        let after = match opens {
            true if bar.may_open => depth + 1,
            false if bar.may_close && depth > 0 && !empty => depth - 1,
            _ => return false,
        };
        let row = self.possible.get(n + 1).and_then(|row| row.get(after));
        row.is_some_and(|fits| fits[usize::from(opens)])
    }

    /// A pairing that begins with `opens`: which bars open. It closes as soon as it can.
    fn complete(&self, mut opens: Vec<bool>) -> Option<Vec<bool>> {
        for n in 0..self.bars.len() {
            let depth = |opens: &[bool]| {
                let open = opens.iter().filter(|opens| **opens).count();
                open.checked_sub(opens.len() - open)
            };
            let before = opens.get(..n)?;
            let (depth, opened) = (depth(before)?, before.last() == Some(&true));
            match opens.get(n) {
                Some(chosen) => self.allows(n, depth, opened, *chosen).then_some(())?,
                None => {
                    let chosen = [false, true]
                        .into_iter()
                        .find(|opens| self.allows(n, depth, opened, *opens))?;
                    opens.push(chosen);
                }
            }
        }
        Some(opens)
    }

    /// A pairing that differs from `known`.
    fn other_than(&self, known: &[bool]) -> Option<Vec<bool>> {
        (0..known.len()).find_map(|n| {
            let mut opens = known.get(..=n)?.to_vec();
            let last = opens.last_mut()?;
            *last = !*last;
            self.complete(opens)
        })
    }
}

/// The tokens of a level with its plain bars as `opens` has them.
fn printed(tokens: &[Token<'_>], plain: Kind, opens: &[bool]) -> String {
    let mut opens = opens.iter();
    let mut out = String::new();
    for token in tokens {
        let text = match token.kind {
            Kind::DoubleBar if opens.next() == Some(&true) => "\\left\\|",
            Kind::DoubleBar => "\\right\\|",
            Kind::Bar if plain != Kind::Bar => token.text,
            Kind::Bar if opens.next() == Some(&true) => "\\left|",
            Kind::Open(Bracket::Bar) => "\\left|",
            Kind::Bar | Kind::Close(Bracket::Bar) => "\\right|",
            _ => token.text,
        };
        let command = out.rsplit('\\').next().is_some_and(|last| {
            last.len() < out.len() && !last.is_empty() && last.bytes().all(|byte| byte.is_ascii_alphabetic())
        });
        if command && text.starts_with(|c: char| c.is_ascii_alphabetic()) {
            out.push(' ');
        }
        out.push_str(text);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};

    #[test]
    fn absolute_values() {
        for tex in [
            "|x|",
            r"\left|x\right|",
            r"\lvert x \rvert",
            r"\vert x\vert",
            r"\bigl|x\bigr|",
            r"\left\vert x \right\vert",
        ] {
            check(&[(tex, r"<\operatorname{abs} x>")]);
        }
        let cases = [
            ("|a| + |b|", "(+ <|| a> <|| b>)"),
            ("|a||b|", "(* <|| a> <|| b>)"),
            ("||a| - |b||", "<|| (+ <|| a> (- <|| b>))>"),
            ("||a||", "<|| <|| a>>"),
            ("2|-a|", "(* 2 <|| (- a)>)"),
            ("|Z_k^-|^2", "(^ <|| Z_k^-> 2)"),
            (r"\frac{|a|}{|b|}", "(/ <|| a> <|| b>)"),
            ("|a (|b| + c)|", "<|| (* a (+ <|| b> c))>"),
            (r"\lvert a \lvert b \rvert c \rvert", "<|| (* a <|| b> c)>"),
            (r"\lvert a\rvert b |c|", "(* <|| a> b <|| c>)"),
            ("e^{-|x|}", "(^^ e (- <|| x>))"),
            ("a/|b|", "(/ a <|| b>)"),
            (r"\sqrt{|a|} |b|", "(* (sqrt <|| a>) <|| b>)"),
            (r"|a| \cdot b \cdot |c|", "(* <|| a> b <|| c>)"),
        ];
        for (tex, wanted) in cases {
            check(&[(tex, wanted.replace("||", r"\operatorname{abs}").as_str())]);
        }
        refuse(&[
            (
                "|a|b|c|",
                r"these bars can be read as \left|a\right|b\left|c\right| or as \left|a\left|b\right|c\right|",
            ),
            (r"|\alpha a| - b |c|", r"or as \left|\alpha a\left|-b\right|c\right|"),
            ("|a", "`|` is not closed"),
            ("a|", "`|` is not closed"),
            ("|a + |", "`|` is not closed"),
            ("||", "`|` is not closed"),
            ("(|a)|", "`|` is not closed"),
            (r"\left|a)", "`|` is closed by `)`"),
            (r"\rvert a", "a factor"),
            (r"\det|DP|", "a name"),
            (&"|a| + ".repeat(101), "so many bars"),
        ]);
    }
}
