//! Digits at the extremes: where denominators vanish, differences cancel, impacts graze or accumulate and time is long.
//!
//! Each row holds a form of a formula, evaluated in one number type, against the exact value: in 100 digits, by a formula
//! that neither form uses, confirmed to 60 digits by the default form in those digits. The printed form is evaluated from
//! the paper's own TeX where that has it. The default form is the very function that the commands call. Forms that lose
//! digits and what the program does instead:
//!
//! | printed | loses where | used by default |
//! |---|---|---|
//! | (14), (15), (16) for the velocity | 1 - r_B r_T, T_1 - r_T T_2, r_B vanish | [`OneOneEquations`](dynamics::orbit::OneOneEquations): its determinant 1 + 2 r_B + r_B r_T does not |
//! | (20), (21) | the arrival is slow: their denominator is its velocity as a difference | [`Link::scaled_jacobian`](dynamics::orbit::FlightJacobian::scaled_jacobian), divided by the velocity itself |
//! | (22) | an impact is slow | [`trace`](dynamics::orbit::trace): one division, by the velocities |
//! | (23), and m_11 m_22 - m_12 m_21 | an impact is slow | [`determinant`](dynamics::orbit::determinant): the product of r² |
//! | (19) | Delta near 0; multipliers far apart | [`multipliers`](dynamics::orbit::multipliers): Delta as a product, the smaller one from their product |
//! | (4) | the flight is short | [`Flight::state`](dynamics::model::Flight::state): integrals since the start, by sines of half angles |
//! | cos(pi t) | the time is late | [`Forcing::at`](dynamics::model::Forcing::at): whole periods taken off first, exactly |
//! | (5), (6) | the impact is slight | [`Membrane::voltage`](dynamics::model::Membrane::voltage): neither the square nor the difference |
//! | (14) to (16) together | r_B r_T near 1, r_B near 0 | [`find`](dynamics::orbit::find): every motion enclosed by proof |
//! | (8) in absolute time | many impacts | [`Simulation`](dynamics::impact::Simulation): the phase of the forcing instead of the time |
//! | (8) impact by impact | chatter | [`Simulation`](dynamics::impact::Simulation): its end in closed form |

mod approach;
mod branches;
mod chatter;
mod closed;
mod curve;
mod driven;
mod eigenvalue;
mod fall;
mod frozen;
mod impacts;
mod jacobian;
mod lanes;
mod long;
mod motion;
mod paper;
mod phase;
mod quantity;
mod row;
mod search;
mod sweeps;
mod unusual;
mod velocity;
mod voltage;

pub use approach::Approach;
pub use curve::CurveRow;
pub use frozen::{WORST, WORST_PATH, frozen_text};
pub use row::{BAR, Form, StressRow};

use curve::Curves;
use frozen::Frozen;
use motion::{Scene, Triple};
use paper::Paper;
use quantity::{Quantity, Visitor, rows};
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};
use search::Search;
use std::time::Duration;

/// A measurement that could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StressError {
    /// The reference and the other means that is to confirm it disagree, so neither may judge.
    #[error("{case} at {at}: the reference is confirmed to {digits:.1} digits only")]
    Reference {
        /// The extreme.
        case: &'static str,
        /// The point.
        at: String,
        /// How far they agree.
        digits: f64,
    },
    /// The embedded paper does not have a formula as it is needed.
    #[error("the paper: {0}")]
    Paper(String),
    /// A point of a case is none.
    #[error("{case} has no value at {at}")]
    Point {
        /// The extreme.
        case: &'static str,
        /// The point.
        at: String,
    },
    /// The frozen points cannot be used.
    #[error("the frozen points, line {line}: {what}")]
    Frozen {
        /// From 1; 0 of the whole file.
        line: u64,
        /// What is wrong.
        what: String,
    },
    /// No extreme that is approached has this name.
    #[error("no extreme has `{name}` in its name; there are {known}")]
    NoExtreme {
        /// What was asked for.
        name: String,
        /// The names.
        known: String,
    },
    /// No case has this name.
    #[error("no case has `{0}` in its name; `stress` without it lists them")]
    NoCase(String),
}

/// The rows of all cases, or of those that have `only` in their names: the listed points, then the frozen ones, of
/// the file `frozen` ([`WORST`]).
///
/// # Errors
/// A point without a value, a reference without confirmation, frozen points that make no sense, a name of no case.
pub fn stress(only: Option<&str>, frozen: &str) -> Result<Vec<StressRow>, StressError> {
    let is_wanted = |case: &str| only.is_none_or(|only| case.contains(only));
    let paper = Paper::new()?;
    let mut listed = Listed {
        only,
        frozen: frozen::read(frozen)?,
        rows: Vec::new(),
    };
    visit_all(&paper, &mut listed)?;
    if only.is_none()
        && let Some(left) = listed.frozen.first()
    {
        let what = format!("no case `{}` has a formula `{}`", left.case, left.formula);
        return Err(StressError::Frozen { line: 0, what });
    }
    let mut rows = listed.rows;
    let triple = Triple::new(&paper)?;
    let scenes: Vec<Scene> = motion::scenes()
        .into_iter()
        .filter(|scene| is_wanted(scene.case))
        .collect();
    let restitutions = chatter::RESTITUTIONS
        .into_iter()
        .filter(|r| is_wanted(chatter::case(*r)));
    let (scenes, (chatters, long)) = rayon::join(
        || gathered(scenes.par_iter().map(|scene| motion::rows(&triple, scene))),
        || {
            rayon::join(
                || gathered(restitutions.collect::<Vec<_>>().into_par_iter().map(chatter::rows)),
                || {
                    let wanted = long::CASES.into_iter().filter(|(case, _)| is_wanted(case));
                    gathered(
                        wanted
                            .collect::<Vec<_>>()
                            .into_par_iter()
                            .map(|(case, impacts)| long::rows(case, impacts, long::OFF)),
                    )
                },
            )
        },
    );
    rows.extend(scenes?);
    rows.extend(chatters?);
    rows.extend(long?);
    let wanted = |case: &&str| is_wanted(case);
    let in_lanes: Vec<&str> = lanes::cases().filter(wanted).collect();
    rows.extend(gathered(in_lanes.into_par_iter().map(lanes::rows))?);
    let driven: Vec<&str> = driven::cases().filter(wanted).collect();
    rows.extend(gathered(driven.into_par_iter().map(driven::rows))?);
    let swept: Vec<&str> = sweeps::cases().filter(wanted).collect();
    rows.extend(gathered(swept.into_par_iter().map(sweeps::rows))?);
    let branches: Vec<&str> = branches::cases().filter(wanted).collect();
    rows.extend(gathered(branches.into_par_iter().map(branches::rows))?);
    rows.extend(unusual::rows().into_iter().filter(|row| is_wanted(&row.case)));
    match only {
        Some(only) if rows.is_empty() => Err(StressError::NoCase(only.to_owned())),
        _ => Ok(rows),
    }
}

/// All rows in order, or the first error.
fn gathered(
    rows: impl ParallelIterator<Item = Result<Vec<StressRow>, StressError>>,
) -> Result<Vec<StressRow>, StressError> {
    let rows: Result<Vec<Vec<StressRow>>, StressError> = rows.collect();
    Ok(rows?.concat())
}

/// The worst points of each formula that a search of so many seconds in all finds: one where the printed form, one where
/// the default form keeps the fewest of f64's digits, as compared with what conditioning allows. The same course each time; time decides how far.
///
/// # Errors
/// A reference without confirmation.
pub fn search(seconds: f64) -> Result<Vec<StressRow>, StressError> {
    let paper = Paper::new()?;
    let mut count = Count(0);
    visit_all(&paper, &mut count)?;
    let share = Duration::try_from_secs_f64(seconds / f64::from(2 * count.0.max(1)));
    let mut search = Search {
        share: share.unwrap_or(Duration::ZERO),
        visited: 0,
        rows: Vec::new(),
    };
    visit_all(&paper, &mut search)?;
    Ok(search.rows)
}

/// The rows along the approaches to all extremes, or to those that have `only` in their names, from harmless to extreme.
///
/// # Errors
/// `NoExtreme`, a point without a value, a reference without confirmation.
pub fn curves(only: Option<&str>) -> Result<Vec<CurveRow>, StressError> {
    let paper = Paper::new()?;
    let mut curves = Curves::new(only)?;
    visit_all(&paper, &mut curves)?;
    curves.add_motions(&Triple::new(&paper)?)?;
    Ok(curves.into_rows())
}

fn visit_all(paper: &Paper, visitor: &mut impl Visitor) -> Result<(), StressError> {
    velocity::each(paper, visitor)?;
    jacobian::each(paper, visitor)?;
    eigenvalue::each(paper, visitor)?;
    fall::each(paper, visitor)?;
    phase::each(visitor)?;
    voltage::each(visitor)
}

struct Count(u32);

impl Visitor for Count {
    fn visit(&mut self, _: &impl Quantity) -> Result<(), StressError> {
        self.0 += 1;
        Ok(())
    }
}

/// The listed points and the frozen ones.
struct Listed<'a> {
    only: Option<&'a str>,
    /// Those whose quantity has not been visited yet.
    frozen: Vec<Frozen>,
    rows: Vec<StressRow>,
}

impl Visitor for Listed<'_> {
    fn visit(&mut self, quantity: &impl Quantity) -> Result<(), StressError> {
        let (case, formula) = (quantity.case(), quantity.formula());
        if self.only.is_some_and(|only| !case.contains(only)) {
            return Ok(());
        }
        for setting in quantity.settings() {
            let inputs = quantity.set(&setting);
            let found = rows(quantity, &inputs)?;
            self.rows.extend(found.ok_or_else(|| StressError::Point {
                case,
                at: row::place(quantity.inputs(), &inputs),
            })?);
        }
        let is_own = |frozen: &mut Frozen| frozen.case == case && frozen.formula == formula;
        let derived = quantity.derived_names();
        let mut own = Vec::new();
        for frozen in self.frozen.extract_if(.., is_own) {
            let inputs = row::values(quantity.inputs(), &derived, &frozen.at);
            own.push((inputs.ok_or_else(|| frozen.fault("these are not its inputs"))?, frozen));
        }
        while let Some(inputs) = own.first().map(|(inputs, _)| inputs.clone()) {
            let here: Vec<_> = own.extract_if(.., |(other, _)| *other == inputs).collect();
            let here: Vec<Frozen> = here.into_iter().map(|(_, frozen)| frozen).collect();
            self.rows.extend(again(quantity, &inputs, &here)?);
        }
        Ok(())
    }
}

/// The rows of a frozen point with what was frozen of each.
fn again(quantity: &impl Quantity, inputs: &[f64], frozen: &[Frozen]) -> Result<Vec<StressRow>, StressError> {
    let mut found = rows(quantity, inputs)?.unwrap_or_default();
    for frozen in frozen {
        let same = |row: &&mut StressRow| row.number == frozen.number && row.form == frozen.form;
        let row = found.iter_mut().find(same);
        let row = row.ok_or_else(|| frozen.fault("there is no value in such a number and form"))?;
        row.frozen = Some(frozen.digits);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "case,formula,number,form,digits,at\n";

    #[test]
    fn a_frozen_point_is_looked_at_again_with_what_was_frozen_of_it() {
        let frozen = format!("{HEADER}late time,f,f64,stable,15.0,t=1.3\nlate time,f,f64,printed,99.0,t=1.3\n");
        let rows = stress(Some("late time"), &frozen).unwrap();
        let here: Vec<_> = rows.iter().filter(|row| row.at == "t=1.3").collect();
        assert_eq!(here.len(), 8);
        assert_eq!(here.iter().filter(|row| row.frozen.is_some()).count(), 2);
        assert_eq!(rows.iter().filter(|row| row.has_lost_a_digit()).count(), 1);
    }

    #[test]
    fn frozen_points_that_no_case_answers_are_errors() {
        for row in [
            "late time,f,f64,other,1,t=1.3",
            "late time,f,f16,stable,1,t=1.3",
            "late time,f,f64,stable,1,s=1",
        ] {
            let found = stress(Some("late time"), &format!("{HEADER}{row}\n"));
            assert!(matches!(found, Err(StressError::Frozen { .. })), "{row}: {found:?}");
        }
    }

    #[test]
    fn every_row_of_a_formula_is_evaluated_again_from_its_own_place_alone() {
        visit_all(&Paper::new().unwrap(), &mut quantity::tests::Again).unwrap();
    }

    /// The digits of a form in f64 along an approach.
    fn kept<'a>(rows: &'a [CurveRow], formula: &str, form: Form) -> Vec<&'a StressRow> {
        let of_f64 = rows.iter().map(|row| &row.row).filter(|row| row.number == "f64");
        of_f64
            .filter(|row| row.formula == formula && row.form == form)
            .collect()
    }

    #[test]
    fn printed_digits_fall_towards_an_extreme_and_default_ones_stay_within_the_bar() {
        for (extreme, formula) in [
            ("Delta to 0", "(19) imaginary"),
            ("T_1 to r_T T_2", "(15)"),
            ("r_B to 0", "(16)"),
            ("flight to 0", "(4)"),
            ("voltage to 0", "(5)-(6)"),
        ] {
            let rows = curves(Some(extreme)).unwrap();
            assert!(rows.iter().all(|row| !row.row.is_below_bar()), "{extreme}");
            let printed = kept(&rows, formula, Form::Printed);
            assert!(printed.len() >= 27, "{extreme}: {}", printed.len());
            // a rounding may favour a point: two decades on, digits are fewer all the same, until none is left
            for later in printed.windows(5).filter(|rows| rows[0].digits > 2.0) {
                assert!(later[4].digits < later[0].digits, "{extreme}: {later:#?}");
            }
            let lost = printed[0].digits - printed[printed.len() - 1].digits;
            assert!(lost > 6.0, "{extreme}: {lost}");
        }
    }

    #[test]
    fn every_extreme_is_approached_in_both_forms_and_several_numbers() {
        let rows = curves(None).unwrap();
        for approach in Approach::ALL {
            let own: Vec<_> = rows.iter().filter(|row| row.approach == approach).collect();
            let steps = own.chunk_by(|one, other| one.distance == other.distance).count();
            assert!(steps >= 10, "{approach:?}: {steps}");
            for form in [Form::Printed, Form::Stable] {
                let numbers = own.iter().filter(|row| row.row.form == form);
                let numbers: std::collections::BTreeSet<&str> = numbers.map(|row| row.row.number.as_str()).collect();
                assert!(numbers.len() >= 2, "{approach:?} {form:?}: {numbers:?}");
            }
        }
    }

    #[test]
    fn a_name_of_no_extreme_is_an_error_that_names_them() {
        let found = curves(Some("no extreme"));
        let Err(StressError::NoExtreme { known, .. }) = found else {
            panic!("{found:?}");
        };
        assert!(
            Approach::ALL.iter().all(|approach| known.contains(approach.name)),
            "{known}"
        );
    }

    #[test]
    fn a_name_of_no_case_is_an_error() {
        let found = stress(Some("no case"), WORST);
        assert_eq!(found, Err(StressError::NoCase("no case".into())));
    }
}
