//! The curves of bifurcations over the two parameters of `[branch]`, alone or over a map.

use super::super::{Failure, curves};
use crate::orbit::{ParameterPlane, SpecialPoint};
use crate::report::figure::{BifurcationCurve, BifurcationCurves, Parameter};
use crate::report::plot::{Panel, Series};
use crate::scene::{Over, Scene, Want};

/// The curves that a scene wants, and over which parameters they go.
pub(super) struct Curves {
    overs: [Over; 2],
    drawn: BifurcationCurves,
}

/// The curves of a scene, where it wants them.
pub(super) fn of(scene: &Scene) -> Result<Option<Curves>, Failure> {
    if !(scene.want()?.contains(&Want::Branch) && scene.branches_over_two()) {
        return Ok(None);
    }
    let plane = scene.plane()?;
    let overs = [plane.x.over, plane.y.over];
    let ranges = plane.ranges();
    let parameter = |i: usize| Parameter::new(overs[i].name(), (ranges[i].low(), ranges[i].high()));
    let mut drawn = BifurcationCurves {
        x: parameter(0),
        y: parameter(1),
        curves: Vec::new(),
        special: Vec::new(),
    };
    let options = scene.options()?;
    for (word, periods) in scene.words_and_periods()? {
        for points in curves::curves(&plane, &word, periods, &options)? {
            let Some(kind) = points.first().map(|point| point.motion.kind) else {
                continue;
            };
            let at = points.iter().map(|point| ((point.motion.parameter, point.y), point));
            let named = at.clone().filter(|(_, point)| point.special != SpecialPoint::Step);
            drawn.special.extend(named.map(|(at, point)| (point.special, at)));
            drawn.curves.push(BifurcationCurve {
                kind,
                points: at.map(|(at, point)| (at, point.motion.admissible)).collect(),
            });
        }
    }
    Ok(Some(Curves { overs, drawn }))
}

impl Curves {
    /// What is drawn over a map of these parameters; nothing over a map of others.
    pub fn over(&self, overs: [Over; 2]) -> Vec<Series> {
        if overs == self.overs {
            self.drawn.series()
        } else {
            Vec::new()
        }
    }

    /// A panel of the curves alone.
    pub fn panel(&self) -> Panel {
        self.drawn.panel()
    }
}
