//! A printed value against a computed one.

use super::Verdict;
use super::figures::{Figures, LEGIBLE, agreeing, power_of_ten, rounded, size};
use super::range::Range;
use super::value::Value;
use num_traits::Zero;
use numbers::{Field, Rational};

/// Places of a computed value that a message shows beyond the printed ones.
const PLACES_BEYOND: i32 = 4;

/// What a comparison finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The verdict.
    pub verdict: Verdict,
    /// The agreeing digits: `-log10` of the relative difference; where the values are equal, the printed figures.
    pub digits: Option<f64>,
    /// Why it is not `reproduced`, in one line; empty where it is.
    pub reason: String,
}

impl Comparison {
    fn new(verdict: Verdict, digits: Option<f64>, reason: String) -> Self {
        Self {
            verdict,
            digits,
            reason,
        }
    }
}

/// Compares what is printed with what is computed, in exact decimals.
///
/// - A count, which CSV prints without a point, is `reproduced` where it is equal, else `wrong`.
/// - Any other number is `reproduced` if it is within half a unit of its last figure of the computed value (or within the
///   uncertainty that is printed with it, if that is more); `truncated` if it is the computed value with its last figures cut
///   off; `off-by-one` if it is within one unit otherwise; `rounded` if it is within one unit of the figure before, if it has
///   one; and `wrong` otherwise. A 0 without places after the point is nothing else than 0.
/// - A range `(a, b)`, or one open to a side, `< b` or `> a`, is `reproduced` where the computed value lies strictly
///   within, else `wrong`.
/// - A word is `reproduced` where the computed one is the same, else `wrong`.
///
/// Where the bound of the computed value leaves the verdict open, and where there is no bound, it is `undecided`.
///
/// # Errors
/// A message for a person, where a number is printed and a word computed or the other way round.
pub fn compare(printed: &str, computed: &Value) -> Result<Comparison, String> {
    if computed.text.is_empty() {
        let reason = "the computed value is not known: nothing is decided".to_owned();
        return Ok(Comparison::new(Verdict::Undecided, None, reason));
    }
    let number = Figures::read(&computed.text);
    // `inf` and `NaN` are what numbers may come to, not words.
    let is_number = number.is_some() || computed.text.parse::<f64>().is_ok();
    match (Printed::read(printed), number) {
        (Printed::Number(number), Some(found)) => Ok(numbers(printed.trim(), &number, &found.value, computed)),
        (Printed::Range(range), Some(number)) => Ok(within(&range, &number.value, computed)),
        (Printed::Number(_) | Printed::Range(_), None) if is_number => {
            let reason = format!("printed {printed}, computed {}", computed.text);
            Ok(Comparison::new(Verdict::Wrong, Some(0.0), reason))
        }
        (Printed::Number(_) | Printed::Range(_), None) => Err(format!(
            "`{printed}` is a number, and what is computed is a word: {}",
            computed.text
        )),
        (Printed::Word, _) if is_number => Err(format!(
            "`{printed}` is not a number such as 0.677449, 5.3e-3, 5.3 \\times 10^{{-3}} or 0.6774(5), nor a range (a, b), < b or > a, and what is computed is \
             one: {}",
            computed.text
        )),
        (Printed::Word, _) => Ok(words(printed, &computed.text)),
    }
}

/// Compares a certified value, right to its last figure, with a computed one: `reproduced` where they differ by no
/// more than the bound of the computed one and half a unit of the last figure, else `wrong`.
///
/// # Errors
/// A message for a person, where either is no number.
pub fn certified_against(certified: &str, computed: &Value) -> Result<Comparison, String> {
    let number = |text: &str| Figures::read(text).ok_or_else(|| format!("`{text}` is not a number"));
    let (value, found) = (number(certified)?, number(&computed.text)?);
    let difference = size(found.value.clone() - value.value.clone());
    let digits = if difference.is_zero() {
        f64::from(value.count)
    } else {
        agreeing(&difference, &value.value)
    };
    let Some(bound) = &computed.bound else {
        let reason = "no bound of the computed value is certified: nothing is decided".to_owned();
        return Ok(Comparison::new(Verdict::Undecided, Some(digits), reason));
    };
    if difference <= bound.clone() + value.unit() / Rational::from_integer(2) {
        return Ok(Comparison::new(Verdict::Reproduced, Some(digits), String::new()));
    }
    let reason = format!(
        "differs from the {} figure on, by up to {} where the bound is {}: certified {certified}, computed {}",
        ordinal(value.first_differing(&found.value)),
        power_above(&difference),
        power_above(bound),
        computed.text
    );
    Ok(Comparison::new(Verdict::Wrong, Some(digits), reason))
}

/// A printed number, and the uncertainty that is printed with it.
struct Uncertain {
    figures: Figures,
    uncertainty: Option<Rational>,
}

enum Printed {
    Number(Uncertain),
    Range(Range),
    Word,
}

impl Printed {
    fn read(text: &str) -> Self {
        if let Some((figures, uncertainty)) = Figures::read_printed(text) {
            return Self::Number(Uncertain { figures, uncertainty });
        }
        Range::read(text).map_or(Self::Word, Self::Range)
    }
}

fn words(printed: &str, computed: &str) -> Comparison {
    if printed == computed {
        return Comparison::new(Verdict::Reproduced, None, String::new());
    }
    // The audit has such a verdict too, and there as here it is never a pass.
    if computed == Verdict::Undecided.name() {
        return Comparison::new(
            Verdict::Undecided,
            None,
            format!("printed {printed}, and nothing is decided"),
        );
    }
    let reason = format!("printed {printed}, it is {computed}");
    Comparison::new(Verdict::Wrong, None, reason)
}

/// Returns the verdict on a printed number if this is exactly the computed one.
fn exact_verdict(printed: &Uncertain, number: &Rational) -> Verdict {
    let figures = &printed.figures;
    let difference = size(number.clone() - figures.value.clone());
    let (unit, half) = (figures.unit(), figures.unit() / Rational::from_integer(2));
    if figures.is_zero_alone() {
        return match difference.is_zero() {
            true => Verdict::Reproduced,
            false => Verdict::Wrong,
        };
    }
    let zero = Rational::zero();
    let has_its_sign = figures.value.is_zero() || (figures.value < zero) == (*number < zero);
    let is_larger = size(number.clone()) > size(figures.value.clone());
    // a value that rounds to 0 there leaves no figure to be off by one
    let has_figures = figures.count > 1 || size(number.clone()) >= half;
    if difference <= half || printed.uncertainty.as_ref().is_some_and(|most| difference <= *most) {
        Verdict::Reproduced
    } else if difference < unit && is_larger && has_its_sign {
        Verdict::Truncated
    } else if difference <= unit && has_figures {
        Verdict::OffByOne
    } else if difference <= unit.clone() * Rational::from_integer(10) && figures.count > 1 {
        Verdict::Rounded
    } else {
        Verdict::Wrong
    }
}

/// Returns the verdict on a printed number if the computed one is known to within a bound; `undecided` if the bound leaves
/// it open.
fn verdict_within(printed: &Uncertain, number: &Rational, bound: &Rational) -> Verdict {
    if printed.figures.is_zero_alone() && number.is_zero() {
        return Verdict::Reproduced;
    }
    let [low, high] = [number.clone() - bound.clone(), number.clone() + bound.clone()];
    // on either side of the printed value a verdict holds on one interval: the ends and the nearest point tell
    let value = &printed.figures.value;
    let nearest = if *value < low {
        low.clone()
    } else if *value > high {
        high.clone()
    } else {
        value.clone()
    };
    let [low, nearest, high] = [low, nearest, high].map(|number| exact_verdict(printed, &number));
    match low == nearest && nearest == high {
        true => nearest,
        false => Verdict::Undecided,
    }
}

fn numbers(text: &str, printed: &Uncertain, number: &Rational, computed: &Value) -> Comparison {
    let figures = &printed.figures;
    let difference = size(number.clone() - figures.value.clone());
    let digits = if difference.is_zero() {
        f64::from(figures.count)
    } else {
        agreeing(&difference, number)
    };
    let both = format!("printed {text}, computed {}", shown(number, figures.places, computed));
    if !computed.text.contains(['.', 'e', 'E']) {
        let (verdict, reason) = if difference.is_zero() {
            (Verdict::Reproduced, String::new())
        } else {
            (Verdict::Wrong, format!("{both}, a count"))
        };
        return Comparison::new(verdict, Some(digits), reason);
    }
    let Some(bound) = &computed.bound else {
        let reason = format!("no bound of the computed value is certified: nothing is decided; {both}");
        return Comparison::new(Verdict::Undecided, Some(digits), reason);
    };
    let verdict = verdict_within(printed, number, bound);
    let reason = match verdict {
        Verdict::Reproduced => String::new(),
        Verdict::Truncated => format!("cut off instead of rounded: {both}"),
        Verdict::OffByOne => format!("the last figure is off by one: {both}"),
        Verdict::Rounded => {
            let off = rounded(&(difference / figures.unit()), 1);
            format!("right but for the last figure, off by {off}: {both}")
        }
        Verdict::Undecided => format!(
            "computed only to within {}, which leaves the verdict open; {both}",
            power_above(bound)
        ),
        _ => match figures.first_differing(number) {
            1 => format!("no figure agrees: {both}"),
            figure => format!("differs from the {} figure on: {both}", ordinal(figure)),
        },
    };
    Comparison::new(verdict, Some(digits), reason)
}

/// `reproduced` where the number lies strictly within, whatever its bound leaves open, `wrong` where it does not.
fn within(range: &Range, number: &Rational, computed: &Value) -> Comparison {
    let places = range.ends().map(|end| end.places).max().unwrap_or(0);
    let shown = shown(number, places, computed);
    let Some(bound) = &computed.bound else {
        let reason = format!("no bound of the computed value is certified: nothing is decided; computed {shown}");
        return Comparison::new(Verdict::Undecided, None, reason);
    };
    let (least, most) = (number.clone() - bound.clone(), number.clone() + bound.clone());
    let from = range.from.as_ref().map(|end| &end.value);
    let to = range.to.as_ref().map(|end| &end.value);
    if from.is_none_or(|from| *from < least) && to.is_none_or(|to| most < *to) {
        return Comparison::new(Verdict::Reproduced, None, String::new());
    }
    if from.is_some_and(|from| most <= *from) || to.is_some_and(|to| *to <= least) {
        let which = if range.ends().count() > 1 { "outside" } else { "not" };
        let reason = format!("computed {shown}, which is {which} {range}");
        return Comparison::new(Verdict::Wrong, None, reason);
    }
    let reason = format!("computed {shown}, too near an end of {range} to tell");
    Comparison::new(Verdict::Undecided, None, reason)
}

/// A computed number to some places beyond the printed ones; as it is written where that is long, or shows nothing of it.
fn shown(number: &Rational, places: i32, computed: &Value) -> String {
    let decimal = rounded(number, places.max(0) + PLACES_BEYOND);
    let is_lost = decimal == "0" && !number.is_zero();
    if is_lost || decimal.len() > LEGIBLE {
        return computed.text.clone();
    }
    decimal
}

/// The power of ten at or above a small number, as `1e-9`.
fn power_above(value: &Rational) -> String {
    let power = (-400..=400).find(|&power| *value <= power_of_ten(power));
    power.map_or_else(|| "more than 1e400".to_owned(), |power| format!("1e{power}"))
}

fn ordinal(number: i32) -> String {
    let suffix = match number {
        1 => "st",
        2 => "nd",
        3 => "rd",
        _ => "th",
    };
    format!("{number}{suffix}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str, bound: &str) -> Value {
        Value {
            text: text.to_owned(),
            bound: Figures::read(bound).map(|figures| figures.value),
        }
    }

    fn verdict(printed: &str, computed: &str, bound: &str) -> Option<Verdict> {
        compare(printed, &value(computed, bound))
            .ok()
            .map(|found| found.verdict)
    }

    #[test]
    fn the_verdict_follows_the_last_printed_figure() {
        use Verdict::{OffByOne, Reproduced, Rounded, Truncated, Wrong};
        for (printed, computed, wanted) in [
            ("0.677449", "0.6774485037", Reproduced),
            ("0.677448", "0.6774485037", Truncated),
            ("0.677450", "0.6774492", OffByOne),
            ("-0.677450", "-0.6774492", OffByOne),
            ("-0.677448", "-0.6774488", Truncated),
            ("0.677447", "0.6774485037", Rounded),
            ("0.677444", "0.6774485037", Rounded),
            ("0.677438", "0.6774485037", Wrong),
            ("0.701752", "0.7017134314", Wrong),
            ("-0.555468", "-0.555471663", Rounded),
            ("0.555468", "-0.555471663", Wrong),
            ("37876.8", "37876.794", Reproduced),
            ("37877.4", "37876.794", Rounded),
            ("5.319e-3", "0.0053186", Reproduced),
            ("2", "2", Reproduced),
            ("3", "2", Wrong),
            ("1", "0.8868720826", Reproduced),
            ("-0.8", "-0.9038271786", Wrong),
            // of one figure something is left at its place; a 0 is nothing else
            ("5", "5.7", Truncated),
            ("5", "4.6", Reproduced),
            ("5", "4.2", OffByOne),
            ("5", "3.9", Wrong),
            ("1", "0.3", Wrong),
            ("-5", "-5.7", Truncated),
            ("-5", "5.7", Wrong),
            ("0", "0.0", Reproduced),
            ("0", "0.4", Wrong),
            ("0", "1e-9", Wrong),
            ("0.000", "1e-9", Reproduced),
            ("0.000", "-0.0004", Reproduced),
            ("0.000", "0.0006", Truncated),
            ("0.000", "-0.0006", Truncated),
            ("0.000", "0.002", Wrong),
            ("1e300", "9.6e299", Reproduced),
            ("1e300", "1.0e299", Wrong),
            ("1e300", "2.5", Wrong),
            ("1e400", "2.5", Wrong),
            ("0.0e300", "2.5", Wrong),
            ("0", "-0.0", Reproduced),
        ] {
            assert_eq!(
                verdict(printed, computed, "1e-12"),
                Some(wanted),
                "{printed} {computed}"
            );
        }
    }

    #[test]
    fn exactly_half_a_unit_is_reproduced_and_exactly_one_is_off_by_one() {
        for exact in ["0.255", "0.265"] {
            assert_eq!(verdict("0.26", exact, "0"), Some(Verdict::Reproduced));
        }
        for exact in ["0.25", "0.27"] {
            assert_eq!(verdict("0.26", exact, "0"), Some(Verdict::OffByOne));
        }
        assert_eq!(verdict("0.26", "0.16", "0"), Some(Verdict::Rounded));
    }

    #[test]
    fn a_reproduced_figure_that_is_changed_is_no_longer_reproduced() {
        let computed = value("0.6774485037", "1e-12");
        for last in 0..=9 {
            let changed: i32 = last - 9;
            let found = compare(&format!("0.67744{last}"), &computed).map(|found| found.verdict);
            assert_eq!(found == Ok(Verdict::Reproduced), changed == 0, "{last}");
        }
    }

    #[test]
    fn what_the_bound_leaves_open_is_undecided_and_never_a_pass() {
        assert_eq!(verdict("0.677449", "0.6774485", "1e-6"), Some(Verdict::Undecided));
        assert_eq!(verdict("0.677449", "0.6774488", "2e-7"), Some(Verdict::Reproduced));
        // on both sides wrong, and the printed value is between
        assert_eq!(verdict("0.677449", "0.6774", "0.1"), Some(Verdict::Undecided));
        assert_eq!(verdict("0.677449", "0.6774485", ""), Some(Verdict::Undecided));
        assert_eq!(verdict("0.677449", "", ""), Some(Verdict::Undecided));
        // whether it rounds to the only figure, and whether it is 0
        assert_eq!(verdict("5", "4.5001", "1e-3"), Some(Verdict::Undecided));
        assert_eq!(verdict("5", "4.51", "1e-3"), Some(Verdict::Reproduced));
        assert_eq!(verdict("5", "4.48", "1e-3"), Some(Verdict::OffByOne));
        assert_eq!(verdict("0", "1e-13", "1e-12"), Some(Verdict::Undecided));
        assert_eq!(verdict("0", "1e-11", "1e-12"), Some(Verdict::Wrong));
        assert_eq!(verdict("(0.4, 1)", "0.999999", "1e-3"), Some(Verdict::Undecided));
        assert_eq!(verdict("proved", "undecided", "0"), Some(Verdict::Undecided));
    }

    #[test]
    fn an_uncertainty_takes_the_place_of_half_a_unit() {
        use Verdict::{OffByOne, Reproduced, Rounded, Wrong};
        for (printed, computed, wanted) in [
            (r"8.327 \times 10^{-1}", "0.83272", Reproduced),
            ("0.8327(1)", "0.83279", Reproduced),
            ("0.8327(2)", "0.83251", Reproduced),
            ("0.8327(2)", "0.83249", Rounded),
            (r"0.8327 \pm 0.00001", "0.83264", OffByOne),
            (r"0.8327 \pm 0.01", "0.8411", Reproduced),
            (r"0.8327 \pm 0.01", "0.8511", Wrong),
        ] {
            assert_eq!(
                verdict(printed, computed, "1e-12"),
                Some(wanted),
                "{printed} {computed}"
            );
        }
    }

    #[test]
    fn ranges_and_words_are_compared_as_such() {
        assert_eq!(verdict("(0.4, 1)", "0.5", "1e-9"), Some(Verdict::Reproduced));
        assert_eq!(verdict("(-0.2, -0.15)", "0.165", "1e-9"), Some(Verdict::Wrong));
        assert_eq!(
            verdict("(0.5, 1)", "0.5", "0"),
            Some(Verdict::Wrong),
            "the range is open"
        );
        assert_eq!(verdict("BTT", "BTT", "0"), Some(Verdict::Reproduced));
        assert_eq!(verdict("BBT", "BTT", "0"), Some(Verdict::Wrong));
        assert_eq!(verdict("0.1", "inf", "0"), Some(Verdict::Wrong));
        assert_eq!(verdict("0.1", "NaN", "0"), Some(Verdict::Wrong));
    }

    #[test]
    fn a_range_open_to_a_side_has_one_end() {
        assert_eq!(verdict("< 60000", "58670.78", "1e-3"), Some(Verdict::Reproduced));
        let found = compare("<60000", &value("61152.5", "1e-3")).unwrap();
        assert_eq!(found.verdict, Verdict::Wrong);
        assert!(found.reason.ends_with("which is not < 60000"), "{}", found.reason);
        assert_eq!(verdict("> 0", "-0.5", "1e-3"), Some(Verdict::Wrong));
        assert_eq!(verdict("> 0", "1e-4", "1e-3"), Some(Verdict::Undecided));
        assert_eq!(verdict("> 0", "0.5", ""), Some(Verdict::Undecided));
    }

    #[test]
    fn a_number_is_not_compared_with_a_word() {
        let message = |printed: &str, computed: &str| compare(printed, &value(computed, "0")).err().unwrap_or_default();
        assert!(message("abc", "0.5").contains("`abc` is not a number"));
        assert!(message("0.5", "focus").contains("what is computed is a word: focus"));
    }

    #[test]
    fn the_reason_says_what_to_look_at() {
        let reason = |printed: &str, computed: &str| {
            compare(printed, &value(computed, "1e-12")).map_or_else(|message| message, |found| found.reason)
        };
        assert_eq!(
            reason("0.701752", "0.7017134314"),
            "differs from the 5th figure on: printed 0.701752, computed 0.7017134314"
        );
        assert_eq!(
            reason("-0.555468", "-0.55547166302"),
            "right but for the last figure, off by 3.7: printed -0.555468, computed -0.555471663"
        );
        assert_eq!(reason("0.677449", "0.6774485037"), "");
        assert_eq!(
            reason("0.677448", "0.6774485037"),
            "cut off instead of rounded: printed 0.677448, computed 0.6774485037"
        );
        assert_eq!(
            reason("0.677450", "0.6774492"),
            "the last figure is off by one: printed 0.677450, computed 0.6774492"
        );
        assert_eq!(
            reason("0.8330", "0.8318"),
            "differs from the 3rd figure on: printed 0.8330, computed 0.8318"
        );
        for (printed, computed, both) in [
            ("0", "0.4", "printed 0, computed 0.4"),
            ("5", "3.2", "printed 5, computed 3.2"),
            ("1e300", "2.5", "printed 1e300, computed 2.5"),
            ("-1e400", "2.5e-7", "printed -1e400, computed 2.5e-7"),
        ] {
            assert_eq!(reason(printed, computed), format!("no figure agrees: {both}"));
        }
        let tiny = compare("1.5e-300", &value("2.6e-300", "1e-310")).map(|found| found.reason);
        assert_eq!(
            tiny.as_deref(),
            Ok("no figure agrees: printed 1.5e-300, computed 2.6e-300")
        );
        assert_eq!(
            reason("(-0.2, -0.15)", "0.165"),
            "computed 0.165, which is outside (-0.2, -0.15)"
        );
    }

    #[test]
    fn a_certified_value_holds_within_the_bound_of_the_computed_one() {
        let found = |computed: &str, bound: &str| {
            certified_against("0.251070185389869230000000000000", &value(computed, bound)).map(|found| found.verdict)
        };
        assert_eq!(found("0.25107018538986923", "1e-16"), Ok(Verdict::Reproduced));
        assert_eq!(found("0.2510701853898", "1e-12"), Ok(Verdict::Reproduced));
        assert_eq!(found("0.2510701853898", "1e-14"), Ok(Verdict::Wrong));
        assert_eq!(found("0.2510701853898", ""), Ok(Verdict::Undecided));
        assert!(found("BT", "0").is_err());
    }

    #[test]
    fn digits_are_the_agreeing_ones() {
        let digits = |printed: &str, computed: &str| {
            compare(printed, &value(computed, "1e-12"))
                .ok()
                .and_then(|found| found.digits)
        };
        assert!(digits("0.83272", "0.8327202251").is_some_and(|digits| (digits - 6.568).abs() < 0.01));
        assert_eq!(digits("0.26", "0.26"), Some(2.0));
        assert_eq!(digits("1", "-1"), Some(0.0));
    }
}
