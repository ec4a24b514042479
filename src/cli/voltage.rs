//! The voltages of the certified orbits along a sweep, for golden values.

use super::{Asked, Failure};
use crate::model::Membrane;
use crate::number::{Decimals, Field, Interval, Rung, Telling, Told, Wide};
use crate::orbit::{
    EnclosedVoltage, Family, Fixed, OneOneBranches, OrbitVoltages, Output, OutputPrecision, RoundedOrbit,
    VoltageEndpoint, Word, confirm_orbit, find_as, is_covered,
};
use crate::report::{Cell, Table};
use crate::scene::{Quantity, Scene, Setting};

/// The columns of an orbit at a value of the sweep, its velocities and voltages in word order, their mean (7), the means of the bottom
/// and of the top impacts and how far they lie apart, V.
const COLUMNS: [&str; 12] = [
    "d",
    "word",
    "periods",
    "stable",
    "admissible",
    "velocities",
    "voltages",
    "mean_voltage",
    "bottom_voltage",
    "top_voltage",
    "apart",
    "error_bound",
];

/// The table, in f64 or in decimals of at most 40 figures, from the proved enclosures, with the bound of its errors. Words
/// come in the order of the scene, each along the whole sweep, and orbits with fewer periods first.
///
/// # Errors
/// A scene that lacks `[sweep]`, `[membrane]`, or what its motions and units require.
pub fn table(scene: &Scene, asked: &Asked) -> Result<Table, Failure> {
    let mut table = Table::new(COLUMNS);
    match asked {
        Asked::Doubles(goal) => each(scene, goal, |_, voltages, orbit| Ok(table.push(voltages.row(&orbit))?))?,
        Asked::Decimals(goal) => each(scene, goal, |_, voltages, orbit| Ok(table.push(voltages.row(&orbit))?))?,
    }
    Ok(table)
}

/// The same by two means, from the proved enclosures and from the return map; an orbit that the second means does not
/// reach has no row there.
///
/// # Errors
/// As [`table`].
pub fn twice(scene: &Scene, decimals: Decimals) -> Result<[Table; 2], Failure> {
    let mut tables = [Table::new(COLUMNS), Table::new(COLUMNS)];
    let goal = OutputPrecision::decimals(decimals, Rung::Wide(50));
    each(scene, &goal, |fixed, voltages, orbit| {
        if let Ok(again) = confirm_orbit(fixed, &orbit, decimals) {
            tables[1].push(voltages.row(&again))?;
        }
        Ok(tables[0].push(voltages.row(&orbit))?)
    })?;
    Ok(tables)
}

/// Hands each orbit over, with the motion it is one of and what makes its voltages.
fn each<W: Output>(
    scene: &Scene,
    wanted: &W,
    mut take: impl FnMut(&Fixed<'_, Setting, Quantity>, &Voltages<'_, W>, RoundedOrbit<W::Number>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let membrane = scene.membrane::<EnclosedVoltage>()?;
    let sweep = scene.sweep()?;
    let setting = scene.swept_setting()?;
    let values: Vec<Quantity> = sweep.values().collect();
    for word in scene.words()? {
        let found = found(&setting, &values, &word, scene.max_periods()?, wanted)?;
        for (value, orbits) in values.iter().zip(found) {
            let voltages = Voltages {
                wanted,
                membrane: &membrane,
                unit: scene.swept_scales::<EnclosedVoltage>(sweep.over, value)?.velocity,
                d: scene.swept::<EnclosedVoltage>(sweep.over, value)?.d().clone(),
            };
            for orbit in orbits {
                take(&setting.fixed(value), &voltages, orbit)?;
            }
        }
    }
    Ok(())
}

/// The orbits of a word at each value, those with fewer periods first.
fn found<W: Output>(
    setting: &Setting,
    values: &[Quantity],
    word: &Word,
    max_periods: u32,
    wanted: &W,
) -> Result<Vec<Vec<RoundedOrbit<W::Number>>>, Failure> {
    let is_of_pairs =
        |value: &Quantity| Ok::<_, Failure>(is_covered(&setting.motion_at(&value.value::<Interval>())?, word));
    let ends = values.first().zip(values.last());
    let is_followed = ends.map(|(from, _)| is_of_pairs(from)).transpose()?;
    let Some((from, to)) = ends.filter(|_| is_followed == Some(true)) else {
        let at = |value| Ok(find_as(wanted, &setting.fixed(value), word, max_periods)?.orbits);
        return values.iter().map(at).collect();
    };
    // prepared once for the whole sweep, each value is next to nothing
    let [from, to] = [from, to].map(|end| end.value::<Interval<f64>>());
    let mut orbits = vec![Vec::new(); values.len()];
    for periods in 1..=max_periods {
        let prepared = OneOneBranches::new(setting, periods, from.hull(&to), wanted.options())?;
        for (orbits, found) in orbits.iter_mut().zip(prepared.points_as(wanted, values)?) {
            orbits.extend(found.orbits);
        }
    }
    Ok(orbits)
}

/// What makes voltages of the velocities at one value of a sweep.
struct Voltages<'a, W> {
    wanted: &'a W,
    membrane: &'a Membrane<EnclosedVoltage>,
    /// The velocity unit, m/s.
    unit: EnclosedVoltage,
    d: EnclosedVoltage,
}

impl<N: Told, W: Output<Number = N> + Telling<VoltageEndpoint, Number = N>> Voltages<'_, W>
where
    Cell: From<N> + From<Vec<N>>,
{
    fn row(&self, orbit: &RoundedOrbit<N>) -> Vec<Cell> {
        let bound = orbit.error_bound.as_ref();
        let voltages = OrbitVoltages::of(orbit, self.membrane, &self.unit);
        let numbers = voltages.each.iter().map(Some);
        let means = [
            Some(&voltages.mean),
            voltages.bottom.as_ref(),
            voltages.top.as_ref(),
            voltages.apart.as_ref(),
        ];
        let numbers: Vec<Option<&EnclosedVoltage>> = numbers.chain(means).collect();
        let told: Vec<Option<N>> = numbers
            .iter()
            .map(|number| number.map(|number| self.wanted.tell(number)))
            .collect();
        let errors = told.iter().zip(&numbers).filter_map(|(told, number)| {
            let (told, number) = (told.as_ref()?, (*number)?);
            Some(self.wanted.error(told, number))
        });
        let worst = errors.fold(
            Wide::from_integer(0),
            |worst, error| if error <= worst { worst } else { error },
        );
        let worst = bound.map(|_| self.wanted.bound(worst));
        let (list, means) = told.split_at(voltages.each.len());
        let mut cells = vec![
            Cell::from(self.wanted.tell(&self.d)),
            Cell::from(orbit.word.to_string()),
            Cell::from(i64::from(orbit.periods)),
            Cell::from(orbit.stable),
            Cell::from(orbit.admissible),
            Cell::from(orbit.velocities.clone()),
            Cell::from(list.iter().flatten().cloned().collect::<Vec<N>>()),
        ];
        cells.extend(means.iter().cloned().map(Cell::from));
        cells.push(Cell::from(worst));
        cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Analytic;
    use crate::scene::find;

    fn scene(name: &str, sets: &[&str]) -> Scene {
        let mut scene = Scene::read(find(name).unwrap(), name).unwrap();
        for set in sets {
            scene.set(set).unwrap();
        }
        scene
    }

    /// The numbers of the first row of a column.
    fn numbers(table: &Table, column: &str) -> Vec<VoltageEndpoint> {
        let index = table.position(column).unwrap();
        let text = table.rows()[0][index].plain().into_owned();
        text.split(';').map(|number| Wide::parse(number).unwrap()).collect()
    }

    #[test]
    fn both_means_and_f64_agree_within_the_bound() {
        let at = ["sweep.from=0.4", "sweep.points=1", "words=['BT']"];
        let [first, second] = twice(&scene("fig02", &at), Decimals(30)).unwrap();
        let float = table(&scene("fig02", &at), &Asked::Doubles(OutputPrecision::DOUBLES)).unwrap();
        let bound = |table: &Table| numbers(table, "error_bound")[0].to_f64();
        assert!(bound(&first) < 1e-21 && bound(&float) < 1e-9);
        for column in ["velocities", "voltages", "mean_voltage", "apart"] {
            let exact = numbers(&first, column);
            // each is within its bound; the second means has none, and as many figures as the first
            for (other, bound) in [(&second, 2.0 * bound(&first)), (&float, bound(&float))] {
                for (one, other) in exact.iter().zip(numbers(other, column)) {
                    let off = (one.clone() - other.clone()).to_f64().abs();
                    assert!(off <= bound, "{column}: {one} and {other}");
                }
            }
        }
    }

    #[test]
    fn the_mean_is_that_of_all_impacts_and_apart_that_of_the_walls() {
        let three = scene("fig03", &["sweep.from=0.25", "sweep.points=1", "words=['BTT']"]);
        let table = table(&three, &Asked::Doubles(OutputPrecision::DOUBLES)).unwrap();
        let of = |column: &str| {
            numbers(&table, column)
                .iter()
                .map(Analytic::to_f64)
                .collect::<Vec<f64>>()
        };
        let (voltages, mean) = (of("voltages"), of("mean_voltage")[0]);
        let [bottom, top] = ["bottom_voltage", "top_voltage"].map(|column| of(column)[0]);
        assert_eq!(voltages.len(), 3);
        assert!((voltages.iter().sum::<f64>() / 3.0 - mean).abs() < 1e-9);
        assert!((voltages[0] - bottom).abs() < 1e-9 && ((voltages[1] + voltages[2]) / 2.0 - top).abs() < 1e-9);
        assert!((of("apart")[0] - (bottom - top).abs()).abs() < 1e-9);
    }
}
