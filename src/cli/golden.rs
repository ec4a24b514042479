//! What golden rows ask for, answered by the commands themselves.

use super::{Failure, Options, basins, branch, decide, map, optimise, orbits, simulate, sweep, trajectory, voltage};
use crate::number::{Analytic, Decimals, Field, Wide};
use crate::reference::{Computed, Directory, Made, Quantity, Request, Setting};
use crate::report::{Cell, Table, note_input};
use crate::scene::{self, Scene};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// The commands whose columns a golden row may name. `motion` is the scene's own: its parameters and units; `summary` is
/// `sweep --summary`; `basins` has the attractors; `voltage` are the certified orbits along the sweep with their voltages.
const KNOWN: [&str; 13] = [
    "audit",
    "basins",
    "branch",
    "inferred",
    "map",
    "motion",
    "optimise",
    "orbits",
    "simulate",
    "summary",
    "sweep",
    "trajectory",
    "voltage",
];

/// The columns of `motion`: the parameters without unit, where the walls are, and the device's amplitude and units.
const MOTION: [&str; 11] = [
    "g",
    "d",
    "r_b",
    "r_t",
    "bottom",
    "top",
    "forcing_amplitude",
    "length_unit",
    "velocity_unit",
    "time_unit",
    "error_bound",
];

/// The figures they are computed with, before they are rounded to f64.
const FIGURES: usize = 40;

/// What computing them over [`Wide`] may cost; rounding to f64 comes on top.
const MOTION_BOUND: f64 = 1e-30;

/// The figures in which references are made: more than the 30 that are kept.
const MADE: Decimals = Decimals(40);

/// What makes references, and what confirms them.
const FIRST_MEANS: &str = "proved enclosure";
const SECOND_MEANS: &str = "return map";

/// The table that answers a request of a golden row.
///
/// # Errors
/// A scene that cannot be read or lacks something, a command that is not known.
pub fn answer(directory: &Directory, request: &Request, options: &Options) -> Result<Computed, Failure> {
    // the digits of a row are those of its scene: --digits is for what is printed
    let options = &Options {
        digits: None,
        ..options.clone()
    };
    let table = match request.command.as_str() {
        "audit" => verdicts(directory, request)?,
        "motion" => motion(&scene(directory, request)?)?,
        "orbits" => orbits::table(&scene(directory, request)?, options)?,
        "basins" => basins::attractors(&scene(directory, request)?, options)?,
        "map" => map::rows(&scene(directory, request)?, options)?.table()?,
        "optimise" => optimise::table(&scene(directory, request)?)?,
        "branch" => branch::rows(&scene(directory, request)?, options)?.table()?,
        "sweep" => sweep::table(&scene(directory, request)?, options)?,
        "summary" => sweep::summary(&scene(directory, request)?, options)?,
        "simulate" => simulate::table(&scene(directory, request)?, options)?,
        "trajectory" => trajectory::table(&scene(directory, request)?, options)?,
        "voltage" => {
            let scene = scene(directory, request)?;
            voltage::table(&scene, &options.goal_for(&scene)?)?
        }
        command => return Err(no_answer(command)),
    };
    let mut computed = as_text(&table);
    if ["branch", "sweep", "summary", "voltage"].contains(&request.command.as_str())
        && let Ok(sweep) = scene(directory, request).and_then(|scene| Ok(scene.sweep()?))
    {
        computed.swept = sweep.step().map(|step| (sweep.over.name().to_owned(), step));
    }
    Ok(computed)
}

fn no_answer(command: &str) -> Failure {
    Failure::NoAnswer {
        found: command.to_owned(),
        known: KNOWN.to_vec(),
    }
}

/// Values with 30 digits by two means: the proved enclosure of a motion or a bifurcation, and the return map of the
/// model, which share no equation. Each request is computed once.
pub struct Maker<'a> {
    directory: &'a Directory,
    known: HashMap<Request, [Computed; 2]>,
}

impl<'a> Maker<'a> {
    /// Nothing has been made yet.
    pub fn new(directory: &'a Directory) -> Self {
        let known = HashMap::new();
        Self { directory, known }
    }

    /// The value of a quantity in the row that the setting names.
    ///
    /// # Errors
    /// A command that has no two means of so many digits; none or several rows meant.
    pub fn make(&mut self, request: &Request, quantity: &Quantity, setting: &Setting) -> Result<Made, Failure> {
        let tables = match self.known.entry(request.clone()) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => new.insert(twice(self.directory, request)?),
        };
        let meant = |table: &Computed, by: &str| {
            let value = table.value(quantity, setting);
            let value = value.map_err(|message| Failure::NotMade(format!("{by}: {message}")))?;
            Ok::<String, Failure>(value.text)
        };
        let [first, second] = tables;
        Ok(Made {
            value: meant(first, FIRST_MEANS)?,
            by: FIRST_MEANS.to_owned(),
            other: meant(second, SECOND_MEANS)?,
            confirmed_by: SECOND_MEANS.to_owned(),
        })
    }
}

fn twice(directory: &Directory, request: &Request) -> Result<[Computed; 2], Failure> {
    let scene = scene(directory, request)?;
    let tables = match request.command.as_str() {
        "orbits" => orbits::twice(&scene, MADE)?,
        "branch" => branch::twice(&scene, MADE)?,
        "voltage" => voltage::twice(&scene, MADE)?,
        command => {
            let found = command.to_owned();
            let known = vec!["branch", "orbits", "voltage"];
            return Err(Failure::NoAnswer { found, known });
        }
    };
    Ok(tables.map(|table| as_text(&table)))
}

/// The scene of a request with its overrides: a path in the directory where it has a `/` or ends in `.toml`, else
/// the name of a built-in one. Of the paper's own directory, the scenes are those that are built in.
fn scene(directory: &Directory, request: &Request) -> Result<Scene, Failure> {
    let name = request.scene.as_str();
    if name.is_empty() {
        return Err(Failure::NoSceneNamed);
    }
    let is_path = name.contains('/') || name.ends_with(".toml");
    let built_in = match (directory, is_path) {
        (_, false) => scene::find(name),
        (Directory::BuiltIn, true) => name
            .strip_prefix("scenes/")
            .and_then(|name| name.strip_suffix(".toml"))
            .and_then(scene::find),
        (_, true) => None,
    };
    let text = match built_in {
        Some(text) => text.to_owned(),
        None if is_path => read(directory, name)?,
        None => return Err(Failure::NoScene(name.to_owned())),
    };
    let mut scene = Scene::read(&text, name)?;
    for (key, value) in &request.overrides {
        scene.set(&format!("{key}={value}"))?;
    }
    Ok(scene)
}

/// The verdicts of the sheet that a request names; the directory's own `equations.toml` where it names none.
fn verdicts(directory: &Directory, request: &Request) -> Result<Table, Failure> {
    let sheet = match request.scene.as_str() {
        "" => "equations.toml",
        name => name,
    };
    decide::verdicts(&read(directory, sheet)?, &directory.name(sheet))
}

/// The scene's own numbers. What it does not give, such as units without a frequency, stays empty.
fn motion(scene: &Scene) -> Result<Table, Failure> {
    let motion = scene.motion::<Wide<FIGURES>>()?;
    let half = motion.d().clone() / Wide::from_integer(2);
    let walls = [half.clone(), -half];
    let restitutions = [crate::model::Side::Bottom, crate::model::Side::Top].map(|side| motion.restitution(side));
    let amplitude = scene.forcing_amplitude().ok().map(|amplitude| amplitude.value::<f64>());
    let units = scene.scales::<Wide<FIGURES>>().ok();
    let units = units.map_or([None; 3], |scales| {
        [&scales.length, &scales.velocity, &scales.time].map(|scale| Some(scale.to_f64()))
    });
    let parameters = [motion.g(), motion.d()].into_iter().chain(restitutions).chain(&walls);
    let mut cells: Vec<Cell> = parameters.map(|number| Cell::from(number.to_f64())).collect();
    cells.push(Cell::from(amplitude));
    cells.extend(units.map(Cell::from));
    cells.push(Cell::from(MOTION_BOUND));
    let mut table = Table::new(MOTION);
    table.push(cells)?;
    Ok(table)
}

fn as_text(table: &Table) -> Computed {
    let columns = table.columns().iter().map(|column| column.name.clone()).collect();
    let row = |row: &Vec<Cell>| row.iter().map(|cell| cell.plain().into_owned()).collect();
    Computed {
        columns,
        rows: table.rows().iter().map(row).collect(),
        note: String::new(),
        swept: None,
    }
}
/// A file of the directory, which no output replaces from now on.
fn read(directory: &Directory, name: &str) -> Result<String, Failure> {
    if let Some(path) = directory.path() {
        note_input(&path.join(name));
    }
    Ok(directory.read(name)?)
}
