//! The amplitude of the forcing, from the printed pairs of velocities alone.
//!
//! (9) and (11) added, on a 1-1 orbit of one forcing period (T = 2, where the terms of the forcing cancel), are
//! `(1 + r_B) Zdot_k + (1 + r_T) Zdot_{k+1} = 2 g`, with `g = M g_0 sin(beta) / A`. So each printed pair allows an
//! interval of A, as wide as the last printed figures are worth, whatever phase, gap and frequency are: no number
//! without a unit depends on the frequency at all. Rows say `A` in `rests_on` where they rest on it.

use super::figures::{Figures, rounded};
use super::request::{Asked, Request};
use super::{Computed, Fault, Printed};
use num_traits::{One, Zero};
use numbers::{Field, Rational};

/// The command by which rows ask for what is inferred.
pub const COMMAND: &str = "inferred";

/// The column that has the amplitude, N.
const COLUMN: &str = "forcing_amplitude";

/// Places to which the interval is printed.
const PLACES: i32 = 9;

/// A closed interval of amplitudes, and the rows that allow no other.
struct Allowed {
    rows: String,
    least: Rational,
    most: Rational,
}

/// What the printed pairs allow, as a table of one row: the middle, and half the width as its bound.
///
/// A pair is two rows of equal scene and set, `orbits.velocities[0]` and `[1]`, whose set says `row.word=BT`. `row` is
/// the row that asks; its scene's own amplitude must lie within, else the value stays empty and the note says why.
///
/// # Errors
/// A pair's scene cannot be used.
pub fn infer(row: &Printed, rows: &[Printed], asked: &mut Asked) -> Result<Computed, Fault> {
    let mut allowed = Vec::new();
    for (bottom, top) in pairs(rows) {
        allowed.extend(of_pair(bottom, top, asked)?);
    }
    let scene = amplitude_of_scene(row, asked)?;
    Ok(told(&allowed, &scene))
}

/// Of each 1-1 orbit whose two velocities are printed, the rows of both.
fn pairs(rows: &[Printed]) -> Vec<(&Printed, &Printed)> {
    let is = |row: &Printed, quantity: &str| {
        row.setting.names_word("BT") && row.quantity.as_ref().is_some_and(|found| found.to_string() == quantity)
    };
    let bottoms = rows.iter().filter(|row| is(row, "orbits.velocities[0]"));
    bottoms
        .filter_map(|bottom| {
            let top = rows.iter().find(|row| {
                is(row, "orbits.velocities[1]")
                    && row.setting == bottom.setting
                    && row.record.field("scene") == bottom.record.field("scene")
            })?;
            Some((bottom, top))
        })
        .collect()
}

/// The amplitudes that a pair allows, each figure taken as right to one unit; none where g might be 0.
fn of_pair(bottom: &Printed, top: &Printed, asked: &mut Asked) -> Result<Option<Allowed>, Fault> {
    let Some((v, w)) = Figures::read(bottom.printed()).zip(Figures::read(top.printed())) else {
        return Ok(None);
    };
    let [g, amplitude, r_b, r_t] = of_motion(bottom, ["g", COLUMN, "r_b", "r_t"], asked)?;
    // M g_0 sin(beta), N: in g A the scene's own amplitude cancels.
    let weight = g * amplitude;
    let (from_v, from_w) = (Rational::one() + r_b, Rational::one() + r_t);
    let twice = from_v.clone() * v.value.clone() + from_w.clone() * w.value.clone();
    let slack = from_v * v.unit() + from_w * w.unit();
    let amplitude_at = |twice_g: Rational| Rational::from_integer(2) * weight.clone() / twice_g;
    let (low, high) = (twice.clone() - slack.clone(), twice + slack);
    if low <= Rational::zero() || weight <= Rational::zero() {
        return Ok(None);
    }
    Ok(Some(Allowed {
        rows: format!("{} and {}", bottom.id(), top.id()),
        least: amplitude_at(high),
        most: amplitude_at(low),
    }))
}

fn amplitude_of_scene(row: &Printed, asked: &mut Asked) -> Result<Rational, Fault> {
    of_motion(row, [COLUMN], asked).map(|[amplitude]| amplitude)
}

/// These columns of the row's motion.
fn of_motion<const N: usize>(row: &Printed, names: [&str; N], asked: &mut Asked) -> Result<[Rational; N], Fault> {
    let motion = asked.ask(&Request::new("motion", &row.record, &row.setting), &row.record)?;
    let mut found = [const { None }; N];
    for (place, name) in found.iter_mut().zip(names) {
        let index = motion.columns.iter().position(|column| column == name);
        let field = index.and_then(|index| motion.rows.first()?.get(index));
        let number = field
            .and_then(|field| Figures::read(field))
            .map(|figures| figures.value);
        let lacks = || {
            row.record.fault(
                "scene",
                format!("the scene has no `{name}`, which the printed pairs need"),
            )
        };
        *place = Some(number.ok_or_else(lacks)?);
    }
    Ok(found.map(|number| number.unwrap_or_else(Rational::zero)))
}

fn told(allowed: &[Allowed], scene: &Rational) -> Computed {
    let interval = |least: &Rational, most: &Rational| format!("[{}, {}]", rounded(least, 5), rounded(most, 5));
    let least = allowed.iter().max_by(|left, right| left.least.cmp(&right.least));
    let most = allowed.iter().min_by(|left, right| left.most.cmp(&right.most));
    let scene_text = rounded(scene, 5);
    let (value, note) = match least.zip(most) {
        None => (None, "no printed pair of a 1-1 orbit tells the amplitude".to_owned()),
        Some((least, most)) if least.least > most.most => {
            let both = [least, most].map(|pair| format!("{} allow {}", pair.rows, interval(&pair.least, &pair.most)));
            (
                None,
                format!("the printed pairs contradict each other: {}", both.join(", ")),
            )
        }
        Some((least, most)) if !(least.least <= *scene && *scene <= most.most) => {
            let pair = if *scene < least.least { least } else { most };
            let note = format!(
                "{} allow only {}, and not the scene's {scene_text}",
                pair.rows,
                interval(&pair.least, &pair.most)
            );
            (None, note)
        }
        Some((least, most)) => {
            let rows: Vec<&str> = allowed.iter().map(|pair| pair.rows.as_str()).collect();
            let note = format!(
                "no other than {} reproduces {}; the scene's {scene_text} is within",
                interval(&least.least, &most.most),
                rows.join(", ")
            );
            (Some((least.least.clone(), most.most.clone())), note)
        }
    };
    let half = Rational::from_integer(2);
    let fields = value.map_or([String::new(), String::new()], |(least, most)| {
        let middle = (least.clone() + most.clone()) / half.clone();
        let printing = super::figures::power_of_ten(-PLACES);
        let bound = (most - least) / half + printing.clone() + printing;
        [rounded(&middle, PLACES), rounded(&bound, PLACES)]
    });
    // A whole number would be read as a count.
    let [middle, bound] = fields;
    let middle = if middle.is_empty() || middle.contains('.') {
        middle
    } else {
        format!("{middle}.0")
    };
    Computed {
        columns: vec![COLUMN.to_owned(), "error_bound".to_owned()],
        rows: vec![vec![middle, bound]],
        note,
        swept: None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::printed::COLUMNS;
    use super::*;

    fn rows(pairs: &[(&str, &str, &str)]) -> Vec<Printed> {
        let mut text = COLUMNS.join(",");
        for (d, v, w) in pairs {
            for (n, printed) in [v, w].into_iter().enumerate() {
                let set = format!("motion.d={d};row.word=BT");
                text.push_str(&format!(
                    "\nd{d}-{n},p,s,{set},orbits.velocities[{n}],{printed},,reproduced,,"
                ));
            }
        }
        text.push_str("\nA,Table 1,s,,inferred.forcing_amplitude,1,N,wrong,,\n");
        Printed::read("printed.csv", &text).unwrap_or_default()
    }

    fn infer_from(pairs: &[(&str, &str, &str)]) -> (String, String, String) {
        let rows = rows(pairs);
        let mut answer = |_: &Request| {
            let columns = ["g", "forcing_amplitude", "r_b", "r_t"].map(str::to_owned).to_vec();
            let fields = ["0.12201", "5.0", "0.5", "0.5"].map(str::to_owned).to_vec();
            Ok(Computed {
                columns,
                rows: vec![fields],
                note: String::new(),
                swept: None,
            })
        };
        let mut asked = Asked::new(&mut answer);
        let found = rows
            .last()
            .and_then(|row| infer(row, &rows, &mut asked).ok())
            .unwrap_or_default();
        let fields = found.rows.first().cloned().unwrap_or_default();
        let field = |index: usize| fields.get(index).cloned().unwrap_or_default();
        (field(0), field(1), found.note)
    }

    const RIGHT: [(&str, &str, &str); 2] = [("0.4", "0.83272", "-0.67004"), ("0.26", "0.677449", "-0.514769")];

    #[test]
    fn the_printed_pairs_allow_five_and_nothing_like_one() {
        let (middle, bound, note) = infer_from(&RIGHT);
        let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        assert!((number(&middle) - 5.0).abs() <= number(&bound), "{middle} {bound}");
        assert!(number(&bound) < 1e-4, "{bound}");
        assert!(
            note.starts_with("no other than [4.99994, 5.00006] reproduces"),
            "{note}"
        );
    }

    #[test]
    fn a_last_figure_changed_by_five_in_either_pair_excludes_the_amplitude() {
        for (changed, row) in [("0.83277", 0), ("0.83267", 0), ("0.677444", 1), ("0.677454", 1)] {
            let mut pairs = RIGHT;
            pairs[row].1 = changed;
            let (middle, _, note) = infer_from(&pairs);
            assert!(middle.is_empty(), "{changed}: {note}");
            assert!(
                note.contains("contradict") || note.contains("and not the scene's 5"),
                "{changed}: {note}"
            );
        }
    }

    #[test]
    fn without_a_pair_nothing_is_inferred() {
        let (middle, _, note) = infer_from(&[]);
        assert_eq!(
            (middle.as_str(), note.as_str()),
            ("", "no printed pair of a 1-1 orbit tells the amplitude")
        );
    }
}
