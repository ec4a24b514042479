//! A judge of its own for claims on the impact pair: exact evaluation at points of the solution set of the premises,
//! constructed by hand. It shares nothing with the code it judges but the reader of formulas.
//!
//! The names of premises are those of the paper: `9` to `13`, `characteristic`; `motion` is the law of flight with
//! the impact law, from t_k on. Extra ones: `r_B = r_T`, `T = 2`, `g = 0`.

use std::collections::HashMap;
use vibro_audit::number::{Field, Rational};
use vibro_audit::tex::{Equation, EvaluationError, Invariant, Name, Scope, Tree, Unsupported, evaluate};

type Value = Rational;

/// Random draws, the same for the same seed and name.
fn draw(seed: u64, name: &str) -> u64 {
    let start = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0xcbf2_9ce4_8422_2325;
    let mixed = name.bytes().fold(start, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let mixed = (mixed ^ (mixed >> 31)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 29)
}

/// A rational that no formula knows of.
fn random(seed: u64, name: &str) -> Value {
    let draw = draw(seed, name);
    let above = i64::try_from(draw % 1_000_003).unwrap() + 1;
    let below = i64::try_from((draw >> 32) % 97).unwrap() + 2;
    let value = Rational::from_ratio(above, below * 1009);
    if draw >> 63 == 0 { value } else { -value }
}

fn positive(seed: u64, name: &str) -> Value {
    let value = random(seed, name);
    if value < Rational::from_integer(0) {
        -value
    } else {
        value
    }
}

/// In (0, 1).
fn fraction(seed: u64, name: &str) -> Value {
    let draw = draw(seed, name);
    Rational::from_ratio(i64::try_from(draw % 9973).unwrap() + 1, 9975)
}

/// Values for everything a formula on the impact pair may speak of.
pub struct Point {
    seed: u64,
    symbols: HashMap<String, Value>,
    values: HashMap<(String, Value), Value>,
    /// Partial derivatives of the two maps: of what, by what.
    partials: HashMap<(String, String), Value>,
    /// Trace and determinant of DP where no map is known.
    invariants: Option<[Value; 2]>,
    eigenvalues: Option<[Value; 2]>,
    periodic: bool,
    locals: Vec<(Name, Tree)>,
    upper: Option<bool>,
}

fn half(value: Value) -> Value {
    value / Rational::from_integer(2)
}

const TIMES: [&str; 3] = ["t_k", "t_{k+1}", "t_{k+2}"];
const VELOCITIES: [&str; 3] = [r"\dot{Z}_k", r"\dot{Z}_{k+1}", r"\dot{Z}_{k+2}"];

impl Point {
    /// A point of the solution set of the premises named.
    pub fn new(premises: &[&str], seed: u64) -> Self {
        let has = |label: &str| premises.contains(&label);
        let mut point = Self {
            seed,
            symbols: HashMap::new(),
            values: HashMap::new(),
            partials: HashMap::new(),
            invariants: None,
            eigenvalues: None,
            periodic: has("13"),
            locals: Vec::new(),
            upper: None,
        };
        let (r_b, mut r_t) = (fraction(seed, "r_B"), fraction(seed, "r_T"));
        if has("r_B = r_T") {
            r_t = r_b.clone();
        }
        let g = if has("g = 0") {
            Rational::from_integer(0)
        } else {
            random(seed, "g")
        };
        let (mut t_1, mut t_2) = (positive(seed, "T_1"), positive(seed, "T_2"));
        let mut whole = positive(seed, "T");
        if has("13") {
            if has("T = 2") {
                let two = Rational::from_integer(2);
                t_1 = two.clone() * fraction(seed, "T_1");
                t_2 = two - t_1.clone();
            }
            whole = t_1.clone() + t_2.clone();
        } else if has("T = 2") {
            whole = Rational::from_integer(2);
        }
        let start = random(seed, "t_k");
        let times = [
            start.clone(),
            start.clone() + t_1.clone(),
            start + t_1.clone() + t_2.clone(),
        ];
        let mut d = positive(seed, "d");
        let mut z = [0, 1, 2].map(|n| random(seed, VELOCITIES[n]));
        let draw_at = |name: &str, n: usize| random(seed, &format!("{name} at {n}"));
        let mut f1 = [0, 1, 2].map(|n| draw_at("F_1", n));
        let mut f2 = [0, 1, 2].map(|n| draw_at("F_2", n));
        let mut f = [0, 1, 2].map(|n| draw_at("f", n));
        if has("13") {
            f[2] = f[0].clone();
            // Increments over the first flight; over the second they are the opposite.
            let a = f1[1].clone() - f1[0].clone();
            let rise = g.clone() * t_1.clone() + a.clone();
            if has("9") && has("11") {
                // z_0 = -r_T z_1 + g T_2 - a and z_1 = -r_B z_0 + rise.
                let above = g.clone() * t_2.clone() - a.clone() - r_t.clone() * rise.clone();
                z[0] = above / (Rational::from_integer(1) - r_b.clone() * r_t.clone());
            } else if has("11") {
                // z_1 from (11), the velocity at the start given.
                z[1] = (g.clone() * t_2.clone() - a.clone() - z[0].clone()) / r_t.clone();
            }
            if has("9") {
                z[1] = rise - r_b.clone() * z[0].clone();
            }
            z[2] = z[0].clone();
            if has("10") && has("12") {
                // (10) plus (12): r_B z_0 T_1 + r_T z_1 T_2 + F_1(t_k) T_1 + F_1(t_{k+1}) T_2 = g (T_1^2 + T_2^2) / 2.
                let squares = t_1.clone() * t_1.clone() + t_2.clone() * t_2.clone();
                let rest = half(g.clone() * squares)
                    - r_b.clone() * z[0].clone() * t_1.clone()
                    - r_t.clone() * z[1].clone() * t_2.clone();
                f1[0] = (rest - a.clone() * t_2.clone()) / (t_1.clone() + t_2.clone());
                f1[1] = f1[0].clone() + a;
            }
            f1[2] = f1[0].clone();
            f2[2] = f2[0].clone();
        } else {
            if has("9") {
                let gain = f1[1].clone() - f1[0].clone();
                z[1] = g.clone() * t_1.clone() + gain - r_b.clone() * z[0].clone();
            }
            if has("11") {
                let gain = f1[2].clone() - f1[1].clone();
                z[2] = g.clone() * t_2.clone() + gain - r_t.clone() * z[1].clone();
            }
        }
        // What (4) adds to the position over a flight.
        let climb = |r: &Value, time: &Value, n: usize, f1: &[Value; 3], f2: &[Value; 3], z: &[Value; 3]| {
            half(g.clone() * time.clone() * time.clone()) + f2[n + 1].clone()
                - f2[n].clone()
                - f1[n].clone() * time.clone()
                - r.clone() * z[n].clone() * time.clone()
        };
        if has("10") {
            d = -climb(&r_b, &t_1, 0, &f1, &f2, &z);
        }
        if has("12") {
            let wanted = d.clone() - climb(&r_t, &t_2, 1, &f1, &f2, &z);
            if !has("13") {
                f2[2] += wanted;
            } else if !has("10") {
                d -= wanted;
            }
        }
        point.differentiate(&has, [&r_b, &r_t], &g, [&t_1, &t_2], [&f, &f1], &z);
        for (name, value) in [
            ("r", fraction(seed, "r")),
            ("r_B", r_b),
            ("r_T", r_t),
            (r"\overline{g}", g.clone()),
            ("d", d),
            ("T", whole),
            ("T_1", t_1),
            ("T_2", t_2),
        ] {
            point.symbols.insert(name.to_string(), value);
        }
        for n in 0..3 {
            point.symbols.insert(TIMES[n].to_string(), times[n].clone());
            point.symbols.insert(VELOCITIES[n].to_string(), z[n].clone());
            for (name, table) in [("f", &f), ("F_1", &f1), ("F_2", &f2)] {
                point
                    .values
                    .insert((name.to_string(), times[n].clone()), table[n].clone());
            }
        }
        if has("13") {
            let position = random(seed, "Z_k");
            point.symbols.insert("Z_k".into(), position.clone());
            point.symbols.insert("Z_{k+2}".into(), position);
        }
        if has("characteristic") {
            let [a, b] = [random(seed, "one"), random(seed, "other")];
            point.invariants = Some([a.clone() + b.clone(), a.clone() * b.clone()]);
            point.eigenvalues = Some([a, b]);
        }
        if has("motion") {
            point.fly();
        }
        point
    }

    /// The state at the running time `t` of the flight that starts at t_k.
    fn fly(&mut self) {
        let t = random(self.seed, "t");
        let [start, z, r, g] = ["t_k", r"\dot{Z}_k", "r", r"\overline{g}"].map(|name| self.symbols[name].clone());
        let after = -r * z;
        self.symbols.insert(r"\dot{Z}_k+".into(), after.clone());
        let position = random(self.seed, "Z_k");
        self.symbols.insert("Z_k".into(), position.clone());
        let past = t.clone() - start.clone();
        let at = |name: &str, time: &Value, point: &Self| point.value(name, time.clone());
        let (f1, f1_k) = (at("F_1", &t, self), at("F_1", &start, self));
        let (f2, f2_k) = (at("F_2", &t, self), at("F_2", &start, self));
        let velocity = after.clone() + g.clone() * past.clone() + f1 - f1_k.clone();
        let place = position + after * past.clone() + half(g * past.clone() * past.clone()) + f2 - f2_k - f1_k * past;
        self.values.insert((r"\dot{Z}".into(), t.clone()), velocity);
        self.values.insert(("Z".into(), t.clone()), place);
        self.symbols.insert("t".into(), t);
    }

    /// The entries of DP_1 and DP_2: (9) to (12) differentiated with times and velocities as variables.
    fn differentiate(
        &mut self,
        has: &dyn Fn(&str) -> bool,
        r: [&Value; 2],
        g: &Value,
        flight: [&Value; 2],
        [f, f1]: [&[Value; 3]; 2],
        z: &[Value; 3],
    ) {
        for (n, velocity_law, position_law) in [(0, "9", "10"), (1, "11", "12")] {
            let (time, r) = (flight[n], r[n]);
            let push = |f: &Value| f.clone() + g.clone();
            // The slopes of the right side of (10) by the later time, the earlier time and the velocity.
            let later = g.clone() * time.clone() + f1[n + 1].clone() - f1[n].clone() - r.clone() * z[n].clone();
            let earlier = r.clone() * z[n].clone() - push(&f[n]) * time.clone();
            let by_velocity = -r.clone() * time.clone();
            let mut of_time = [
                random(self.seed, &format!("dt/dt {n}")),
                random(self.seed, &format!("dt/dz {n}")),
            ];
            if has(position_law) {
                of_time = [-earlier / later.clone(), -by_velocity / later];
            }
            let mut of_velocity = [
                random(self.seed, &format!("dz/dt {n}")),
                random(self.seed, &format!("dz/dz {n}")),
            ];
            if has(velocity_law) {
                of_velocity = [
                    push(&f[n + 1]) * of_time[0].clone() - push(&f[n]),
                    push(&f[n + 1]) * of_time[1].clone() - r.clone(),
                ];
            }
            for (by, column) in [(TIMES[n], 0), (VELOCITIES[n], 1)] {
                let mut insert = |of: &str, value: &Value| {
                    self.partials.insert((of.to_string(), by.to_string()), value.clone());
                };
                insert(TIMES[n + 1], &of_time[column]);
                insert(VELOCITIES[n + 1], &of_velocity[column]);
            }
        }
        // Over both flights: DP = DP_2 DP_1.
        for of in [TIMES[2], VELOCITIES[2]] {
            for by in [TIMES[0], VELOCITIES[0]] {
                let sum = [TIMES[1], VELOCITIES[1]]
                    .iter()
                    .fold(Rational::from_integer(0), |sum, between| {
                        sum + self.slope(of, between) * self.slope(between, by)
                    });
                self.partials.insert((of.to_string(), by.to_string()), sum);
            }
        }
    }

    fn slope(&self, of: &str, by: &str) -> Value {
        self.partials[&(of.to_string(), by.to_string())].clone()
    }

    /// The value of a function at a time, whole periods taken off.
    fn value(&self, name: &str, time: Value) -> Value {
        let mut time = time;
        if self.periodic && ["f", "F_1", "F_2"].contains(&name) {
            let (start, period) = (&self.symbols["t_k"], &self.symbols["T"]);
            let past = (time.clone() - start.clone()) / period.clone();
            let whole = Rational(past.0.floor().into());
            time -= whole * period.clone();
        }
        let key = (name.to_string(), time.clone());
        match self.values.get(&key) {
            Some(value) => value.clone(),
            None => random(self.seed, &format!("{name} at {time}")),
        }
    }

    fn side(&mut self, tree: &Tree, upper: Option<bool>) -> Result<Value, EvaluationError<Unsupported>> {
        self.upper = upper;
        evaluate(tree, self)
    }

    /// Whether an equation holds here; `None` where it is not defined.
    fn holds(&mut self, equation: &Equation) -> Option<bool> {
        let undefined = |error: &EvaluationError<Unsupported>| match error {
            EvaluationError::DivisionByZero { .. } => true,
            EvaluationError::Scope {
                error: Unsupported::Root,
                ..
            } => false,
            other => panic!("the judge cannot read {equation}: {other}"),
        };
        let pair = matches!(&equation.left, Tree::Symbol(name, _) if name.subscript == "1,2");
        if let (true, Some([a, b])) = (pair, self.eigenvalues.clone()) {
            let sides = (
                self.side(&equation.right, Some(true)),
                self.side(&equation.right, Some(false)),
            );
            return match sides {
                (Ok(x), Ok(y)) => Some((x == a && y == b) || (x == b && y == a)),
                (Err(error), _) | (_, Err(error)) if undefined(&error) => None,
                // A root that is not rational cannot be one of these.
                _ => Some(false),
            };
        }
        match (self.side(&equation.left, None), self.side(&equation.right, None)) {
            (Ok(left), Ok(right)) => Some(left == right),
            (Err(error), _) | (_, Err(error)) if undefined(&error) => None,
            _ => Some(false),
        }
    }
}

impl Scope<Value> for Point {
    type Error = Unsupported;

    fn symbol(&mut self, name: &Name) -> Result<Value, Unsupported> {
        if let Some((_, tree)) = self.locals.iter().find(|(known, _)| known == name) {
            let tree = tree.clone();
            return evaluate(&tree, self).map_err(|error| match error {
                EvaluationError::Scope { error, .. } => error,
                _ => Unsupported::Number(Rational::from_integer(0)),
            });
        }
        let mut plain = Name {
            mark: String::new(),
            ..name.clone()
        }
        .to_string();
        if name.mark == "+" && !name.accents.is_empty() {
            plain.push('+');
        }
        if plain == r"\lambda" {
            return self
                .eigenvalues
                .clone()
                .map(|[a, _]| a)
                .ok_or(Unsupported::Symbol(name.clone()));
        }
        let known = [
            "Z_k",
            "Z_{k+1}",
            "Z_{k+2}",
            r"\dot{Z}_k+",
            r"\dot{Z}_{k+1}+",
            r"\dot{Z}_{k+2}+",
        ];
        match self.symbols.get(&plain) {
            Some(value) => Ok(value.clone()),
            None if known.contains(&plain.as_str()) => Ok(random(self.seed, &plain)),
            None => Err(Unsupported::Symbol(name.clone())),
        }
    }

    fn call(&mut self, function: &Name, argument: &Tree) -> Result<Value, Unsupported> {
        let plain = Name {
            mark: String::new(),
            ..function.clone()
        }
        .to_string();
        if plain == r"\dot{Z}" || plain == "Z" {
            let Tree::Symbol(time, _) = argument else {
                return Err(Unsupported::Call(function.clone()));
            };
            if !time.subscript.is_empty() {
                return self.symbol(&Name {
                    subscript: time.subscript.clone(),
                    ..function.clone()
                });
            }
        }
        let time = evaluate(argument, self).map_err(|_| Unsupported::Call(function.clone()))?;
        Ok(self.value(&plain, time))
    }

    fn partial(&mut self, of: &Name, by: &Name) -> Result<Value, Unsupported> {
        let found = self.partials.get(&(of.to_string(), by.to_string()));
        found
            .cloned()
            .ok_or(Unsupported::Partial(Box::new(of.clone()), Box::new(by.clone())))
    }

    fn invariant(&mut self, kind: Invariant, of: &Name) -> Result<Value, Unsupported> {
        if let Some([trace, determinant]) = &self.invariants {
            if !of.subscript.is_empty() {
                return Ok(random(self.seed, &format!("{kind:?} {of}")));
            }
            return Ok(if kind == Invariant::Trace { trace } else { determinant }.clone());
        }
        let (first, last) = match of.subscript.as_str() {
            "1" => (0, 1),
            "2" => (1, 2),
            _ => (0, 2),
        };
        let entry = |of: &[&str], by: &[&str]| self.slope(of[last], by[first]);
        let (a, d) = (entry(&TIMES, &TIMES), entry(&VELOCITIES, &VELOCITIES));
        Ok(match kind {
            Invariant::Trace => a + d,
            Invariant::Determinant => a * d - entry(&TIMES, &VELOCITIES) * entry(&VELOCITIES, &TIMES),
        })
    }

    fn root(&mut self, radicand: Value, index: u32) -> Result<Value, Unsupported> {
        if index != 2 {
            return Err(Unsupported::Root);
        }
        let root = |whole: dashu_int::UBig| {
            let root = whole.sqrt_exact();
            root.ok_or(Unsupported::Root)
        };
        let (sign, above) = radicand.0.numerator().clone().into_parts();
        if sign == dashu_int::Sign::Negative {
            return Err(Unsupported::Root);
        }
        let (above, below) = (root(above)?, root(radicand.0.denominator().clone())?);
        Ok(Rational(
            dashu_ratio::RBig::from(above) / dashu_ratio::RBig::from(below),
        ))
    }

    fn upper_sign(&self) -> Option<bool> {
        self.upper
    }
}

trait ExactRoot: Sized {
    fn sqrt_exact(&self) -> Option<Self>;
}

impl ExactRoot for dashu_int::UBig {
    fn sqrt_exact(&self) -> Option<Self> {
        let root = dashu_int::ops::SquareRoot::sqrt(self);
        (&root * &root == *self).then_some(root)
    }
}

/// Whether a claim, all its equations, follows from the premises named: at several points of their solution set it
/// holds wherever it is defined, and somewhere it is.
pub fn follows(premises: &[&str], claim: &[Equation], locals: &[Equation]) -> bool {
    let mut locals: Vec<(Name, Tree)> = locals
        .iter()
        .map(|equation| (name_of(equation), equation.right.clone()))
        .collect();
    // A symbol that only the claim gives is defined by it.
    let defines = |equation: &&Equation| matches!(&equation.left, Tree::Symbol(name, _) if name.base == r"\Delta");
    locals.extend(
        claim
            .iter()
            .filter(defines)
            .map(|equation| (name_of(equation), equation.right.clone())),
    );
    let mut defined = 0;
    for seed in 1..=4 {
        let mut point = Point::new(premises, seed);
        point.locals = locals.clone();
        let each: Vec<Option<bool>> = claim
            .iter()
            .filter(|equation| !defines(equation))
            .map(|equation| point.holds(equation))
            .collect();
        if each.contains(&Some(false)) {
            return false;
        }
        defined += usize::from(each.iter().all(Option::is_some));
    }
    defined > 0
}

fn name_of(equation: &Equation) -> Name {
    match &equation.left {
        Tree::Symbol(name, _) => name.clone(),
        other => panic!("{other} is no name"),
    }
}
