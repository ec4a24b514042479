//! What a paper prints of a figure, and whether it is right.

use crate::reference::Verdict;
use crate::report::plot::{Colour, Form, Mark, Marker, Point, Series};

/// A printed value that has a place in a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Where: the parameter, and the value.
    pub at: Point,
    /// The value as printed.
    pub printed: String,
    /// What is found of it.
    pub verdict: Verdict,
    /// The bifurcation that it is said to be at, if so.
    pub bifurcation: Option<String>,
}

/// Claims of voltages, where the axis has kilovolts.
pub(super) fn in_kilovolts(claims: &[Claim]) -> Vec<Claim> {
    let in_thousands = |claim: &Claim| Claim {
        at: (claim.at.0, claim.at.1 / 1000.0),
        printed: format!("{} V", claim.printed),
        ..claim.clone()
    };
    claims.iter().map(in_thousands).collect()
}

/// The claims, those of one verdict in one look. Where several stand at one place, it has one label.
pub(super) fn series(claims: &[Claim]) -> Vec<Series> {
    let mut labelled: Vec<Point> = Vec::new();
    let mut series = Vec::new();
    for verdict in Verdict::EXPECTED {
        for at_bifurcation in [false, true] {
            let found = claims
                .iter()
                .filter(|claim| claim.verdict == verdict && claim.bifurcation.is_some() == at_bifurcation);
            let marks: Vec<Mark> = found
                .map(|claim| {
                    let known = labelled.contains(&claim.at);
                    labelled.push(claim.at);
                    let label = if known { String::new() } else { claim.printed.clone() };
                    Mark { at: claim.at, label }
                })
                .collect();
            if marks.is_empty() {
                continue;
            }
            let what = if at_bifurcation {
                "printed bifurcation"
            } else {
                "printed value"
            };
            series.push(Series::marks(
                format!("{what}: {verdict}"),
                marks,
                marker(verdict, at_bifurcation),
            ));
        }
    }
    series
}

/// What is wrong is a cross, upright where a bifurcation is claimed; what is right is open.
fn marker(verdict: Verdict, at_bifurcation: bool) -> Marker {
    let (colour, form, size) = match (verdict, at_bifurcation) {
        (Verdict::Wrong, false) => (Colour::Vermillion, Form::Cross, 10.0),
        (Verdict::Wrong, true) => (Colour::Vermillion, Form::Plus, 15.0),
        (Verdict::OffByOne | Verdict::Rounded, false) => (Colour::Vermillion, Form::Diamond, 12.0),
        (Verdict::OffByOne | Verdict::Rounded, true) => (Colour::Vermillion, Form::Wedge, 12.0),
        (_, false) => (Colour::Green, Form::Circle, 11.0),
        (_, true) => (Colour::Green, Form::Square, 12.0),
    };
    Marker {
        size,
        ..Marker::open(colour, form)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::plot::Shape;

    #[test]
    fn right_and_wrong_differ_in_form_and_one_place_has_one_label() {
        let claim = |verdict, bifurcation: Option<&str>| Claim {
            at: (0.4, 0.83272),
            printed: "0.83272".to_owned(),
            verdict,
            bifurcation: bifurcation.map(str::to_owned),
        };
        let found = series(&[
            claim(Verdict::Wrong, Some("node-focus")),
            claim(Verdict::Reproduced, None),
        ]);
        let names: Vec<&str> = found.iter().map(|series| series.name.as_str()).collect();
        assert_eq!(names, ["printed value: reproduced", "printed bifurcation: wrong"]);
        let looks: Vec<(Form, String)> = found
            .iter()
            .filter_map(|series| match &series.shape {
                Shape::Marks { marks, marker } => Some((marker.form, marks[0].label.clone())),
                _ => None,
            })
            .collect();
        assert_eq!(
            looks,
            [(Form::Circle, "0.83272".to_owned()), (Form::Plus, String::new())]
        );
    }
}
