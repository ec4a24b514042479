//! A scene, read key by key as it is asked.

use super::document::{Document, Entry, Value};
use super::error::{Origin, SceneError, SceneProblem};
use super::harmonics::{Harmonics, driven};
use super::key::{self, DiagramKeys, ExtentKeys, Key, RangeKeys, SpacedKeys, one_of};
use super::sweep::{Begin, Diagram, Extent, Map, MapWant, Over, Spaced, StartGrid, Sweep};
use super::{Quantity, Start, Want};
use dynamics::model::{Device, Membrane, MembraneError, Motion, Scales, Side, gravity_component};
use dynamics::orbit::{OrbitOptions, Word, WordError};
use numbers::Analytic;

/// The most impacts for an error that is asked for, where the scene does not say.
const FOR_AN_ERROR: u32 = 1_000_000;

/// What a person wants to know, of which device and motion.
///
/// The syntax and the names of sections and keys are checked when it is read, a value when it is asked for: what is
/// not wanted may be wrong. [`Scene::check`] asks for all that some wants require.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub(super) document: Document,
}

/// What stands in the place of keys along a sweep, or at a point of a map.
pub(super) type Swept<'a> = &'a [(Over, &'a Quantity)];

impl Scene {
    /// Reads the TOML of the scene that errors call `name`.
    ///
    /// # Errors
    /// Malformed TOML, an unknown section or key: with its place and what was probably meant.
    pub fn read(text: &str, name: &str) -> Result<Self, SceneError> {
        Document::read(text, name).map(|document| Self { document })
    }

    /// Gives one key another value, by `key=value` as `--set` has it. The value is TOML; a bare word is text.
    ///
    /// # Errors
    /// An argument that is no `key=value`, an unknown key. The scene stays as it was.
    pub fn set(&mut self, argument: &str) -> Result<(), SceneError> {
        self.document.set(argument)
    }

    /// The file as the user gave it, `stdin`, or the name of a built-in scene.
    pub fn name(&self) -> &str {
        self.document.name()
    }

    /// The title, where there is one.
    ///
    /// # Errors
    /// A title that is no text.
    pub fn title(&self) -> Result<Option<&str>, SceneError> {
        match self.document.get(&key::TITLE) {
            None => Ok(None),
            Some(entry) => self.text(&key::TITLE, entry).map(Some),
        }
    }

    /// What is wanted, each once, in the order given; empty where nothing is said.
    ///
    /// # Errors
    /// What is no list of wants.
    pub fn want(&self) -> Result<Vec<Want>, SceneError> {
        let mut wants = Vec::new();
        for (name, entry) in self.names(&key::WANT)? {
            let want = Want::find(name).ok_or_else(|| {
                let known = Want::ALL.map(Want::name);
                self.wrong(&key::WANT, entry, one_of(name, &known))
            })?;
            if !wants.contains(&want) {
                wants.push(want);
            }
        }
        Ok(wants)
    }

    /// What is wanted, at least one thing.
    ///
    /// # Errors
    /// As [`Scene::want`], and where nothing is wanted.
    pub fn wanted(&self) -> Result<Vec<Want>, SceneError> {
        let entry = self.require(&key::WANT, None)?;
        let wants = self.want()?;
        if wants.is_empty() {
            let allowed = format!("a list of some of {}", Want::ALL.map(Want::name).join(", "));
            return Err(self.wrong(&key::WANT, entry, allowed));
        }
        Ok(wants)
    }

    /// The words of `orbits` and `branch`, each once, in the order given; BT where none is given, of one wall B.
    ///
    /// # Errors
    /// What is no word.
    pub fn words(&self) -> Result<Vec<Word>, SceneError> {
        let mut words: Vec<Word> = Vec::new();
        for (text, entry) in self.names(&key::WORDS)? {
            let word = read_word(text).map_err(|allowed| self.wrong(&key::WORDS, entry, allowed))?;
            if !words.contains(&word) {
                words.push(word);
            }
        }
        match self.document.get(&key::WORDS) {
            None if self.has_top()? => words.push(Word::pair()),
            // of one wall there is no other of one impact
            None => words.extend("B".parse::<Word>()),
            Some(entry) if words.is_empty() => {
                return Err(self.wrong(&key::WORDS, entry, "a list of words, as [\"BT\"]".to_owned()));
            }
            Some(_) => {}
        }
        Ok(words)
    }

    /// The words of [`Scene::words`], each with 1 to [`Scene::max_periods`] forcing periods.
    ///
    /// # Errors
    /// Those of both.
    pub fn words_and_periods(&self) -> Result<Vec<(Word, u32)>, SceneError> {
        let most = self.max_periods()?;
        let words = self.words()?.into_iter();
        Ok(words
            .flat_map(|word| (1..=most).map(move |periods| (word.clone(), periods)))
            .collect())
    }

    /// The most forcing periods of a motion, at least 1; 1 where nothing is said.
    ///
    /// # Errors
    /// What is no such number.
    pub fn max_periods(&self) -> Result<u32, SceneError> {
        self.count_or(&key::MAX_PERIODS, 1)
    }

    /// The significant digits to reach, from 1 to [`MOST_DIGITS`](super::MOST_DIGITS); 12 where nothing is said.
    ///
    /// # Errors
    /// What is no such number.
    pub fn digits(&self) -> Result<u32, SceneError> {
        self.count_or(&key::DIGITS, 12)
    }

    /// The digits that the scene asks for, where it does.
    ///
    /// # Errors
    /// What is no such number.
    pub fn asked_digits(&self) -> Result<Option<u32>, SceneError> {
        let asked = self.document.get(&key::DIGITS).is_some();
        asked.then(|| self.digits()).transpose()
    }

    /// The motion, without unit: g from `[device]` or `motion.g`, the rest from `[motion]`.
    ///
    /// # Errors
    /// A key that is lacking or out of its range, g given twice.
    pub fn motion<T: Analytic>(&self) -> Result<Motion<T>, SceneError> {
        self.motion_with(&[])
    }

    /// The motion with the swept parameter at `value`.
    ///
    /// # Errors
    /// As [`Scene::motion`], and a value that the parameter cannot have.
    pub fn swept<T: Analytic>(&self, over: Over, value: &Quantity) -> Result<Motion<T>, SceneError> {
        self.motion_with(&[(over, value)])
    }

    pub(super) fn motion_with<T: Analytic>(&self, swept: Swept) -> Result<Motion<T>, SceneError> {
        let g = self.gravity(swept)?;
        let number = |key| self.value_with::<T>(key, swept);
        let motion = match self.has_top()? {
            true => Motion::new(g, number(&key::D)?, number(&key::R_B)?, number(&key::R_T)?),
            false => Motion::one_wall(g, number(&key::R_B)?),
        };
        let forcing = self.harmonics()?;
        motion
            .and_then(|motion| driven(motion, forcing.map(|harmonics| harmonics.over_number())))
            .map_err(|error| self.error(None, error))
    }

    /// Returns true if there is a wall at the top.
    pub(super) fn has_top(&self) -> Result<bool, SceneError> {
        Ok(self.one_of_known(&key::WALLS)? == "both")
    }

    /// The forcing where `[forcing]` gives it; else it is cos(pi t).
    pub(super) fn harmonics(&self) -> Result<Option<Harmonics<Quantity>>, SceneError> {
        if !self.document.has_section("forcing") {
            return Ok(None);
        }
        Ok(Some(Harmonics {
            cosines: self.numbers(&key::COSINES)?,
            sines: self.numbers(&key::SINES)?,
        }))
    }

    /// g, from wherever it comes.
    pub(super) fn gravity<T: Analytic>(&self, swept: Swept) -> Result<T, SceneError> {
        let number = |key| self.value_with::<T>(key, swept);
        let keys = self.motion_keys(&swept.iter().map(|(over, _)| *over).collect::<Vec<_>>());
        if keys.iter().any(|key| key.gives_g()) {
            self.one_gravity()?;
        }
        if !keys.contains(&&key::CAPSULE_MASS) {
            return number(&key::G);
        }
        Ok(gravity_component(
            number(&key::CAPSULE_MASS)?,
            number(&key::FORCING_AMPLITUDE)?,
            &number(&key::INCLINE)?,
            number(&key::GRAVITY)?,
        ))
    }

    /// The number of a key, or that of the sweep in its place.
    fn value_with<T: Analytic>(&self, key: &'static Key, swept: Swept) -> Result<T, SceneError> {
        let Some(&(over, value)) = swept.iter().find(|(over, _)| over.takes(key)) else {
            return Ok(self.number(key)?.value());
        };
        if key.allowed.instead_of(value).is_some() {
            let found = value.to_string();
            return Err(self.error(None, SceneProblem::Swept { over, found }));
        }
        Ok(value.value())
    }

    /// The units of length, velocity and time that the device gives, and its g.
    ///
    /// # Errors
    /// A key of `[device]` that is lacking or out of its range.
    pub fn scales<T: Analytic>(&self) -> Result<Scales<T>, SceneError> {
        self.scales_with(&[])
    }

    /// The scales with the swept parameter at `value`; of all that can be swept, the forcing amplitude changes them.
    ///
    /// # Errors
    /// As [`Scene::scales`], and a value that the parameter cannot have.
    pub fn swept_scales<T: Analytic>(&self, over: Over, value: &Quantity) -> Result<Scales<T>, SceneError> {
        self.scales_with(&[(over, value)])
    }

    pub(super) fn scales_with<T: Analytic>(&self, swept: Swept) -> Result<Scales<T>, SceneError> {
        let number = |key| self.value_with::<T>(key, swept);
        let device = Device {
            capsule_mass: number(&key::CAPSULE_MASS)?,
            forcing_amplitude: number(&key::FORCING_AMPLITUDE)?,
            angular_frequency: number(&key::ANGULAR_FREQUENCY)?,
            incline: number(&key::INCLINE)?,
            gravity: number(&key::GRAVITY)?,
        };
        let section = self.document.section("device").cloned();
        device.scales().map_err(|error| self.error(section, error))
    }

    /// The membrane and the ball that strikes it.
    ///
    /// # Errors
    /// A key of `[membrane]` that is lacking or out of its range, a membrane that is not wider than the ball.
    pub fn membrane<T: Analytic>(&self) -> Result<Membrane<T>, SceneError> {
        let number = |key| Ok::<T, SceneError>(self.number(key)?.value());
        let membrane = Membrane::new(
            number(&key::BALL_MASS)?,
            number(&key::STIFFNESS)?,
            number(&key::EXPONENT)?,
            number(&key::BALL_RADIUS)?,
            number(&key::MEMBRANE_RADIUS)?,
            number(&key::INPUT_VOLTAGE)?,
        );
        membrane.map_err(|error| {
            let narrow = matches!(error, MembraneError::Narrow { .. });
            let entry = self.document.get(&key::MEMBRANE_RADIUS).filter(|_| narrow);
            let origin = entry.map(|entry| entry.origin.clone());
            self.error(origin.or_else(|| self.document.section("membrane").cloned()), error)
        })
    }

    /// The amplitude of the force, N.
    ///
    /// # Errors
    /// It is lacking or out of its range.
    pub fn forcing_amplitude(&self) -> Result<Quantity, SceneError> {
        self.number(&key::FORCING_AMPLITUDE)
    }

    /// The start of a motion.
    ///
    /// # Errors
    /// A key of `[start]` that is lacking or out of its range.
    pub fn start(&self) -> Result<Start, SceneError> {
        let is_given = |key| self.document.get(key).is_some();
        let start = Start {
            phase: self.number(&key::PHASE)?,
            velocity: self.number(&key::VELOCITY)?,
            side: self.start_side()?,
            position: is_given(&key::Z).then(|| self.number(&key::Z)).transpose()?,
        };
        if is_given(&key::Z) && is_given(&key::SIDE) {
            let allowed = "left out where start.z says where the ball is in flight".to_owned();
            return Err(self.wrong(&key::SIDE, self.require(&key::SIDE, None)?, allowed));
        }
        self.check_start(&start, self.require(&key::VELOCITY, None)?)?;
        Ok(start)
    }

    /// The wall of the first impact.
    pub(super) fn start_side(&self) -> Result<Side, SceneError> {
        match self.one_of_known(&key::SIDE)? {
            "top" if self.has_top()? => Ok(Side::Top),
            "top" => {
                let allowed = "bottom: motion.walls leaves no other".to_owned();
                Err(self.wrong(&key::SIDE, self.require(&key::SIDE, None)?, allowed))
            }
            _ => Ok(Side::Bottom),
        }
    }

    /// That the velocity of an impact is its size.
    fn check_start(&self, start: &Start, velocity: &Entry) -> Result<(), SceneError> {
        match start.position {
            None if start.velocity.sign() == std::cmp::Ordering::Less => Err(self.wrong(
                &key::VELOCITY,
                velocity,
                "0 or more: the size of that of an impact".to_owned(),
            )),
            _ => Ok(()),
        }
    }

    /// That the ball starts between the walls.
    pub(super) fn check_place(&self) -> Result<(), SceneError> {
        let (Some(entry), Some(z)) = (self.document.get(&key::Z), self.start()?.position) else {
            return Ok(());
        };
        let motion = self.motion::<f64>()?;
        let (z, half) = (z.value::<f64>(), 0.5 * motion.d());
        if z >= half || (motion.has_top() && z <= -half) {
            let at_wall = "a ball at a wall starts with start.side, and the velocity before its impact";
            let allowed = match motion.has_top() {
                true => format!("between -d/2 and d/2, {half}; {at_wall}"),
                false => format!("below 0: the wall is at 0, and Z points down; {at_wall}"),
            };
            return Err(self.wrong(&key::Z, entry, allowed));
        }
        Ok(())
    }

    /// The values of the sweep.
    ///
    /// # Errors
    /// A key of `[sweep]` that is lacking or out of its range, an end that the swept parameter cannot have, two
    /// ends that are one although several points are asked for.
    pub fn sweep(&self) -> Result<Sweep, SceneError> {
        self.range(RangeKeys::SWEEP)
    }

    fn range(&self, keys: RangeKeys) -> Result<Sweep, SceneError> {
        let Extent { over, from, to } = self.extent(keys.extent())?;
        let points = self.count(keys.values.points)?;
        self.refuse_one_end(keys.values, [&from, &to], points)?;
        Ok(Sweep { over, from, to, points })
    }

    pub(super) fn extent(&self, keys: ExtentKeys) -> Result<Extent, SceneError> {
        let over = self.over(keys.over, None)?;
        Ok(Extent {
            over,
            from: self.end(keys.from, over)?,
            to: self.end(keys.to, over)?,
        })
    }

    /// That several points are not asked for between two ends that are one.
    fn refuse_one_end(&self, keys: SpacedKeys, [from, to]: [&Quantity; 2], points: u32) -> Result<(), SceneError> {
        if points > 1 && from == to {
            let allowed = format!("other than {}, where there are {points} points", keys.from.path());
            return Err(self.wrong(keys.to, self.require(keys.to, None)?, allowed));
        }
        Ok(())
    }

    /// What is computed and kept at each value of the sweep.
    ///
    /// # Errors
    /// A key of `[sweep]` that is lacking or out of its range.
    pub fn diagram(&self) -> Result<Diagram, SceneError> {
        for key in [DiagramKeys::SWEEP.keep, DiagramKeys::SWEEP.begin] {
            self.require(key, None)?;
        }
        self.diagram_of(DiagramKeys::SWEEP)
    }

    fn diagram_of(&self, keys: DiagramKeys) -> Result<Diagram, SceneError> {
        let (impacts, keep) = (self.count(keys.impacts)?, self.count_or(keys.keep, 1)?);
        if keep > impacts {
            let allowed = format!("at most {}, {impacts}", keys.impacts.path());
            return Err(self.wrong(keys.keep, self.require(keys.keep, None)?, allowed));
        }
        let error = match self.document.get(keys.error) {
            Some(_) => Some(self.number(keys.error)?.value()),
            None => None,
        };
        let most_impacts = self.count_or(keys.most_impacts, FOR_AN_ERROR)?;
        if let (true, Some(entry)) = (
            error.is_some() && most_impacts < impacts,
            self.document.get(keys.most_impacts),
        ) {
            let allowed = format!("at least {}, {impacts}", keys.impacts.path());
            return Err(self.wrong(keys.most_impacts, entry, allowed));
        }
        let name = self.one_of_known(keys.begin)?;
        let start = Begin::ALL.into_iter().find(|begin| begin.name() == name);
        Ok(Diagram {
            impacts,
            keep,
            start: start.unwrap_or(Begin::Each),
            error,
            most_impacts,
            options: self.options()?,
        })
    }

    /// How often a branch that parts from another is followed in its turn; 0 where nothing is said.
    ///
    /// # Errors
    /// What is no such number.
    pub fn switches(&self) -> Result<u32, SceneError> {
        self.count_or(&key::SWITCHES, 0)
    }

    /// The tolerances and limits of `[options]`, and those that hold where nothing else is said.
    ///
    /// # Errors
    /// A key of `[options]` that is out of its range.
    pub fn options(&self) -> Result<OrbitOptions, SceneError> {
        let default = OrbitOptions::DEFAULT;
        let real = |key, default| match self.document.get(key) {
            Some(_) => Ok(self.number(key)?.value()),
            None => Ok(default),
        };
        Ok(OrbitOptions {
            finest_cell: real(&key::FINEST_CELL, default.finest_cell)?,
            most_cells: self.count_or(&key::MOST_CELLS, default.most_cells)?,
            most_cover_cells: self.count_or(&key::MOST_COVER_CELLS, default.most_cover_cells)?,
            most_covers: self.count_or(&key::MOST_COVERS, default.most_covers)?,
            word_starts: self.count_or(&key::WORD_STARTS, default.word_starts)?,
            branch_values: self.count_or(&key::BRANCH_VALUES, default.branch_values)?,
            branch_starts: self.count_or(&key::BRANCH_STARTS, default.branch_starts)?,
            longest_step: real(&key::LONGEST_STEP, default.longest_step)?,
            shortest_step: real(&key::SHORTEST_STEP, default.shortest_step)?,
            most_steps: self.count_or(&key::MOST_STEPS, default.most_steps)?,
            longest_word: self.count_or(&key::LONGEST_WORD, default.longest_word)?,
            settled: real(&key::SETTLED, default.settled)?,
            settling_impacts: self.count_or(&key::SETTLING_IMPACTS, default.settling_impacts)?,
            resting_digits: self.count_or(&key::RESTING_DIGITS, default.resting_digits)?,
        })
    }

    /// The grid of `[map]`, and what is computed at each of its points.
    ///
    /// # Errors
    /// A key of `[map]`, or of `[start]` where that is read, that is lacking or out of its range; x and y that are one
    /// parameter, or of which one leaves the other unread.
    pub fn map(&self) -> Result<Map, SceneError> {
        let [x, y] = [self.range(RangeKeys::X)?, self.range(RangeKeys::Y)?];
        self.check_pair(
            RangeKeys::Y.over,
            (x.over, [&x.from, &x.to]),
            (y.over, [&y.from, &y.to]),
        )?;
        Ok(Map {
            diagram: self.diagram_of(DiagramKeys::MAP)?,
            starts: self.starts()?,
            wants: self.wants_of_map()?,
            x,
            y,
        })
    }

    /// That two parameters can go together, with what is typed for their ends.
    pub(super) fn check_pair(
        &self,
        second: &'static Key,
        (x, x_ends): (Over, [&Quantity; 2]),
        (y, y_ends): (Over, [&Quantity; 2]),
    ) -> Result<(), SceneError> {
        let is_pair = |one, other| (x, y) == (one, other) || (x, y) == (other, one);
        let is_twice = x == y || is_pair(Over::R, Over::RB) || is_pair(Over::R, Over::RT);
        if is_twice || is_pair(Over::G, Over::Incline) {
            let allowed = format!("another parameter than {x}, and not both g and incline, nor r with r_b or r_t");
            return Err(self.wrong(second, self.require(second, None)?, allowed));
        }
        // every parameter of the one goes with every parameter of the other
        for (x_end, y_end) in x_ends.into_iter().zip(y_ends) {
            self.motion_with::<f64>(&[(x, x_end), (y, y_end)])?;
        }
        Ok(())
    }

    /// Whether `branch` goes over the two parameters of `[branch]`, not along `[sweep]`.
    pub fn branches_over_two(&self) -> bool {
        self.document.has_section("branch")
    }

    /// The starts of `[basins]`, and how their motions are followed.
    ///
    /// # Errors
    /// A key of `[basins]` that is lacking or out of its range.
    pub fn start_grid(&self) -> Result<StartGrid, SceneError> {
        let impacts = self.count(&key::BASINS_IMPACTS)?;
        let keep = self.count_or(&key::BASINS_KEEP, 1)?;
        if keep > impacts {
            let allowed = format!("at most basins.impacts, {impacts}");
            return Err(self.wrong(&key::BASINS_KEEP, self.require(&key::BASINS_KEEP, None)?, allowed));
        }
        Ok(StartGrid {
            phase: self.spaced(SpacedKeys::PHASE)?,
            velocity: self.spaced(SpacedKeys::VELOCITY)?,
            diagram: Diagram {
                impacts,
                keep,
                start: Begin::Each,
                error: None,
                most_impacts: impacts,
                options: self.options()?,
            },
        })
    }

    fn spaced(&self, keys: SpacedKeys) -> Result<Spaced, SceneError> {
        let spaced = Spaced {
            from: self.number(keys.from)?,
            to: self.number(keys.to)?,
            points: self.count(keys.points)?,
        };
        self.refuse_one_end(keys, [&spaced.from, &spaced.to], spaced.points)?;
        Ok(spaced)
    }

    pub(super) fn has_starts(&self) -> bool {
        self.document.get(&key::MAP_STARTS).is_some()
    }

    /// The starts of a map: those of `map.starts`, else `[start]`.
    pub(super) fn starts(&self) -> Result<Vec<Start>, SceneError> {
        let Some(entry) = self.document.get(&key::MAP_STARTS) else {
            return Ok(vec![self.start()?]);
        };
        let key = &key::MAP_STARTS;
        let allowed = || "a list of starts, as in [{ phase = 6.18, velocity = 0.53 }, …]".to_owned();
        let list = match &entry.value {
            Value::List(list) if !list.is_empty() => list,
            _ => return Err(self.wrong(key, entry, allowed())),
        };
        let start = |entry: &Entry| {
            let Value::Table(keys) = &entry.value else {
                return Err(self.wrong(key, entry, allowed()));
            };
            if let Some((name, entry)) = keys
                .iter()
                .find(|(name, _)| !["phase", "velocity", "z"].contains(&name.as_str()))
            {
                return Err(self.wrong(key, entry, format!("phase, velocity and z, not {name}")));
            }
            let find = |name: &str| keys.iter().find(|(own, _)| own == name).map(|(_, entry)| entry);
            let required = |like: &'static key::Key| find(like.name).ok_or_else(|| self.wrong(key, entry, allowed()));
            let start = Start {
                phase: self.number_in(&key::PHASE, required(&key::PHASE)?)?,
                velocity: self.number_in(&key::VELOCITY, required(&key::VELOCITY)?)?,
                side: Side::Bottom,
                position: find("z").map(|entry| self.number_in(&key::Z, entry)).transpose()?,
            };
            self.check_start(&start, required(&key::VELOCITY)?)?;
            Ok(start)
        };
        list.iter().map(start).collect()
    }

    /// What is wanted at each point of a map; without `map.want` the word, the exponent and, where there is a membrane,
    /// the voltages.
    pub(super) fn wants_of_map(&self) -> Result<Vec<MapWant>, SceneError> {
        let key = &key::MAP_WANT;
        let Some(entry) = self.document.get(key) else {
            let is_known = |want: &MapWant| !want.is_voltage() || self.has_membrane();
            return Ok(MapWant::ALL.into_iter().filter(is_known).collect());
        };
        let mut wants = Vec::new();
        for (name, entry) in self.names(key)? {
            let want = MapWant::ALL.into_iter().find(|want| want.name() == name);
            let want = want.ok_or_else(|| self.wrong(key, entry, one_of(name, &MapWant::ALL.map(MapWant::name))))?;
            if !wants.contains(&want) {
                wants.push(want);
            }
        }
        if wants.is_empty() {
            let allowed = format!("a list of some of {}", MapWant::ALL.map(MapWant::name).join(", "));
            return Err(self.wrong(key, entry, allowed));
        }
        Ok(wants)
    }

    /// The parameter that a key names; where `by` needs it, an error says so.
    pub(super) fn over(&self, key: &'static Key, by: Option<Want>) -> Result<Over, SceneError> {
        let entry = self.require(key, by)?;
        let name = self.text(key, entry)?;
        let known = Over::ALL.map(Over::name);
        let over = Over::ALL.into_iter().find(|over| over.name() == name);
        over.ok_or_else(|| self.wrong(key, entry, one_of(name, &known)))
    }

    fn end(&self, end: &'static Key, over: Over) -> Result<Quantity, SceneError> {
        let value = self.number(end)?;
        match over.key().allowed.instead_of(&value) {
            None => Ok(value),
            Some(allowed) => Err(self.wrong(end, self.require(end, None)?, format!("{allowed}, as {over} is"))),
        }
    }

    pub(super) fn has_device(&self) -> bool {
        self.document.has_section("device")
    }

    pub(super) fn has_membrane(&self) -> bool {
        self.document.has_section("membrane")
    }

    /// That g is not given both ways.
    pub(super) fn one_gravity(&self) -> Result<(), SceneError> {
        match self.document.get(&key::G) {
            Some(entry) if self.has_device() => Err(self.error(Some(entry.origin.clone()), SceneProblem::TwoGravities)),
            _ => Ok(()),
        }
    }

    pub(super) fn entries(&self) -> impl Iterator<Item = (&'static Key, &Entry)> {
        self.document.entries()
    }

    pub(super) fn error(&self, origin: Option<Origin>, problem: impl Into<SceneProblem>) -> SceneError {
        self.document.error(origin, problem)
    }
}

/// A word in a spelling of its own, or what is allowed: a rotation such as TB would be taken for a misprint of another.
fn read_word(text: &str) -> Result<Word, String> {
    let word: Word = text
        .parse()
        .map_err(|error: WordError| format!("words such as \"BT\", which is a 1-1 motion, or \"BTT\": {error}"))?;
    let one_wall = !(text.contains('B') && text.contains('T'));
    if one_wall || (text.starts_with('B') && text.ends_with('T')) {
        return Ok(word);
    }
    Err(format!(
        "written from a bottom impact that follows a top one, as \"{word}\""
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::find;
    use dynamics::orbit::{Family, ParameterPlane};

    #[test]
    fn a_word_starts_at_a_bottom_impact_that_follows_a_top_one() {
        for text in ["BT", "BTT", "BBT", "BTBT", "B", "T", "TT", "BBBTTT", "BTBBT"] {
            assert_eq!(read_word(text), Ok(text.parse().expect("a word")), "{text}");
        }
        for (text, wanted) in [
            ("TB", "\"BT\""),
            ("BTB", "\"BBT\""),
            ("TBT", "\"BTT\""),
            ("bt", "only B (bottom) and T (top)"),
            ("", "as in BT or BTT"),
            ("BTBTBTBTBTBTB", "at most 12"),
        ] {
            assert!(read_word(text).is_err_and(|allowed| allowed.contains(wanted)), "{text}");
        }
    }

    fn changed(settings: &[&str]) -> Scene {
        let mut scene = Scene::read(find("fig02").expect("a scene that is built in"), "fig02").expect("a scene");
        for setting in settings {
            scene.set(setting).expect("a setting");
        }
        scene
    }

    #[test]
    fn both_restitutions_are_swept_as_one() {
        let over = ["sweep.over=r", "sweep.from=0.2", "sweep.to=0.7"];
        let scene = changed(&over);
        let setting = scene.swept_setting().expect("a sweep");
        let motion = setting.over_number::<f64>().at(&0.35).expect("a motion");
        assert_eq!(
            [*motion.restitution(Side::Bottom), *motion.restitution(Side::Top)],
            [0.35; 2]
        );
        assert!(!Family::is_symmetric(&setting));
        let level = changed(&[&over[..], &["device.incline=0"]].concat());
        assert!(Family::is_symmetric(&level.swept_setting().expect("a sweep")));
    }

    #[test]
    fn a_plane_is_symmetric_where_both_restitutions_are_one_parameter_and_not_where_they_are_two() {
        let plane = |x: &str, y: &str| {
            let [x, y] = [("x", x), ("y", y)]
                .map(|(axis, over)| format!("branch.{axis}={{over = \"{over}\", from = 0.3, to = 0.7}}"));
            changed(&["device.incline=0", &x, &y]).plane()
        };
        let is_symmetric = |x: &str, y: &str| ParameterPlane::is_symmetric(&plane(x, y).expect("a plane"));
        assert!(is_symmetric("d", "r") && is_symmetric("r", "d"));
        assert!(!is_symmetric("r_b", "r_t") && !is_symmetric("d", "r_b") && !is_symmetric("d", "r_t"));
        for (x, y) in [("r", "r_b"), ("r_t", "r"), ("r", "r")] {
            assert!(plane(x, y).is_err(), "{x} {y}");
        }
    }
}
