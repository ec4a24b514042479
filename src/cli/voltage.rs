//! The voltages of the certified orbits along a sweep, for golden values.

use super::Failure;
use crate::model::{Membrane, Side};
use crate::number::{Analytic, Decimal, Decimals, Field, Interval, Telling, Wide};
use crate::orbit::{Family, Rounded, confirmed, find_as};
use crate::report::{Cell, Table};
use crate::scene::Scene;

/// More digits than are told.
const DIGITS: usize = 60;

type Number = Interval<Wide<DIGITS>>;

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

/// The table by two means, in decimals of at most 40 figures: from the proved enclosures, with the bound of its errors,
/// and from the return map; an orbit that the second means does not reach has no row there. Words come in the order
/// of the scene, each along the whole sweep, and orbits with fewer periods first.
///
/// # Errors
/// A scene that lacks `[sweep]`, `[membrane]`, or what its motions and units require.
pub fn twice(scene: &Scene, decimals: Decimals) -> Result<[Table; 2], Failure> {
    let membrane = scene.membrane::<Number>()?;
    let sweep = scene.sweep()?;
    let setting = scene.swept_setting()?;
    let mut tables = [Table::new(COLUMNS), Table::new(COLUMNS)];
    for word in scene.words()? {
        for value in sweep.values() {
            let fixed = setting.fixed(&value);
            let unit = scene.swept_scales::<Number>(sweep.over, &value)?.velocity;
            let d = scene.swept::<Number>(sweep.over, &value)?.d().clone();
            let voltages = Voltages {
                decimals,
                membrane: &membrane,
                unit,
                d: decimals.tell(&d),
            };
            for orbit in find_as(&decimals, &fixed, &word, scene.max_periods()?)?.orbits {
                if let Ok(again) = confirmed(&fixed, &orbit, decimals) {
                    tables[1].push(voltages.row(&again))?;
                }
                tables[0].push(voltages.row(&orbit))?;
            }
        }
    }
    Ok(tables)
}

/// What makes voltages of the velocities at one value of a sweep.
struct Voltages<'a> {
    decimals: Decimals,
    membrane: &'a Membrane<Number>,
    /// The velocity unit, m/s.
    unit: Number,
    d: Decimal,
}

impl Voltages<'_> {
    fn row(&self, orbit: &Rounded<Decimal>) -> Vec<Cell> {
        let read = |text: &Decimal| Wide::parse(text.as_str()).unwrap_or(Wide::INVALID);
        let bound = orbit.error_bound.as_ref().map(read);
        let room = bound.clone().unwrap_or_else(|| Wide::from_integer(0));
        let voltage = |velocity: &Decimal| {
            let velocity = read(velocity);
            let around = Number::new(velocity.clone() - room.clone(), velocity + room.clone());
            self.membrane.voltage(&(around * self.unit.clone()))
        };
        let voltages: Vec<(Side, Number)> = orbit.word.sides().zip(orbit.velocities.iter().map(voltage)).collect();
        let mean = |side: Option<Side>| {
            let of_side = voltages
                .iter()
                .filter(|(wall, _)| side.is_none_or(|side| side == *wall));
            let (sum, count) = of_side.fold((Number::from_integer(0), 0), |(sum, count), (_, voltage)| {
                (sum + voltage.clone(), count + 1)
            });
            (count > 0).then(|| sum / Number::from_integer(count))
        };
        let [all, bottom, top] = [None, Some(Side::Bottom), Some(Side::Top)].map(mean);
        let apart = bottom.clone().zip(top.clone()).map(|(bottom, top)| {
            let apart = bottom - top;
            if apart.to_f64() < 0.0 { -apart } else { apart }
        });
        let numbers = voltages.iter().map(|(_, voltage)| Some(voltage));
        let numbers: Vec<Option<&Number>> = numbers
            .chain([&all, &bottom, &top, &apart].map(Option::as_ref))
            .collect();
        let told: Vec<Option<Decimal>> = numbers
            .iter()
            .map(|number| number.map(|number| self.decimals.tell(number)))
            .collect();
        let errors = told.iter().zip(&numbers).filter_map(|(told, number)| {
            let (told, number) = (told.as_ref()?, (*number)?);
            Some(self.decimals.error(told, number))
        });
        let worst = errors.fold(
            Wide::from_integer(0),
            |worst, error| if error <= worst { worst } else { error },
        );
        let worst = bound.map(|_| Telling::<Wide<DIGITS>>::bound(&self.decimals, worst));
        let (list, means) = told.split_at(voltages.len());
        let mut cells = vec![
            Cell::from(self.d.clone()),
            Cell::from(orbit.word.to_string()),
            Cell::from(i64::from(orbit.periods)),
            Cell::from(orbit.stable),
            Cell::from(orbit.admissible),
            Cell::from(orbit.velocities.clone()),
            Cell::from(list.iter().flatten().cloned().collect::<Vec<Decimal>>()),
        ];
        cells.extend(means.iter().cloned().map(Cell::from));
        cells.push(Cell::from(worst));
        cells
    }
}
