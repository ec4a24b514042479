//! Proofs and counterexamples as data, in JSON, for checkers that share nothing with this crate. `check.py` is one.

use super::formula::{list, quoted};
use super::{Options, Outcome, decided, proof_in_words};
use claims::{Goal, Named, Names, Question, Sheet, Verdict};
use kernel::{
    AXIOMS, Axiom, Certificate, Elementary, Function, FunctionOf, Given, Inference, LawSource, Letter, Node, Origin,
    Polynomial, Property, Quantity, Statement, Summand, Symbol, Term, Terms, With, Witness, Word, WordMultiple,
    WordProof, WordQuestion, WordSource, Words,
};
use numbers::Rational;
use std::collections::{BTreeSet, HashMap};
use std::sync::LazyLock;
use texmath::Name;

/// The checker of proof data, a program that is given files: it needs Python with python-flint, and nothing of this crate.
pub static CHECKER: LazyLock<String> = LazyLock::new(|| {
    include_str!("check.py")
        .replace("@AXIOMS@", AXIOMS)
        .replace("@SCHEMA@", SCHEMA)
});

/// The form of proof data, as a JSON Schema (draft 2020-12).
pub const SCHEMA: &str = include_str!("proof.schema.json");

/// The version of proof data, which changes where a checker must.
const VERSION: u32 = 1;

/// What was found for a question, and accepted by the kernel.
#[derive(Clone, Debug)]
pub enum Found {
    Proved {
        certificate: Box<With<Certificate>>,
        point: Box<With<Witness>>,
    },
    Refuted {
        witness: Box<With<Witness>>,
    },
}

impl Found {
    /// Returns the proof or the counterexample of an outcome.
    pub(super) fn of(outcome: Outcome) -> Option<Self> {
        match outcome {
            Outcome::Proved(_, certificate, point) => Some(Self::Proved { certificate, point }),
            Outcome::Refuted(_, witness) => Some(Self::Refuted { witness }),
            Outcome::Contradictory(_) | Outcome::Undecided(_) => None,
        }
    }

    pub(super) fn verdict(&self) -> Verdict {
        match self {
            Self::Proved { .. } => Verdict::Proved,
            Self::Refuted { .. } => Verdict::Refuted,
        }
    }
}

/// A question of a claim with what decides it.
#[derive(Clone, Debug)]
pub struct Decided {
    pub label: String,
    /// The claim as it was read, in TeX.
    pub printed: String,
    pub question: Question,
    pub found: Found,
    pub(super) goal: Goal,
    /// True for one of the questions that show a claim to be `conditional`.
    pub(super) of_exception: bool,
}

/// The claims and givens about letters that need not commute, with their proof, as JSON.
fn words_data(question: &WordQuestion, proof: &WordProof) -> String {
    let word = |word: &Word| {
        let scalars = word
            .scalars
            .iter()
            .map(|(name, power)| format!("[{}, {power}]", quoted(name)));
        let turned = |letter: &Letter| u8::from(letter.is_transposed);
        let letters = word.letters.iter();
        let letters = letters.map(|letter| format!("[{}, {}]", quoted(&letter.name), turned(letter)));
        format!("{}, {}", list(scalars), list(letters))
    };
    let number = |number: &Rational| quoted(&number.to_string());
    let sum = |words: &Words| {
        list(
            words
                .terms()
                .map(|(own, coefficient)| format!("[{}, {}]", number(coefficient), word(own))),
        )
    };
    let multiple = |multiple: &WordMultiple| {
        let (kind, source) = match multiple.of {
            WordSource::Given(source) => ("given", source),
            WordSource::Transposed(source) => ("transposed", source),
            WordSource::Line(source) => ("line", source),
        };
        let (front, behind) = (word(&multiple.front), word(&multiple.behind));
        let coefficient = number(&multiple.coefficient);
        format!("[{coefficient}, [{front}], {}, {source}, [{behind}]]", quoted(kind))
    };
    let point = proof
        .point
        .iter()
        .map(|(name, value)| format!("{}: {}", quoted(name), number(value)));
    let fields = [
        field("claims", list(question.claims.iter().map(sum))),
        field("givens", list(question.givens.iter().map(sum))),
        field(
            "lines",
            list(proof.lines.iter().map(|line| list(line.iter().map(multiple)))),
        ),
        field("claim_lines", integers(proof.claims.iter())),
        field("point", format!("{{{}}}", point.collect::<Vec<_>>().join(", "))),
    ];
    format!("{{\n    {}\n}}", fields.join(",\n    "))
}

/// The claim at a position with what decides it, as JSON: one text for each question that is decided, in the form of [`SCHEMA`].
pub fn proof_data(sheet: &Sheet, position: usize, options: &Options) -> Vec<String> {
    let entry = sheet.entries.get(position);
    let claim = entry.map_or("", |entry| entry.tex.tex.as_str());
    let label = entry.map_or("", |entry| entry.label.as_str());
    let text = |mut fields: Vec<String>, own: Vec<String>| {
        fields.extend(own);
        format!("{{\n  {}\n}}\n", fields.join(",\n  "))
    };
    let decided = decided(sheet, position, options);
    if decided.is_empty() {
        let words = proof_in_words(sheet, position, options).map(|(question, proof)| {
            let own = field("words", words_data(&question, &proof));
            text(head_fields(label, claim), vec![field("verdict", quoted("proved")), own])
        });
        return words.into_iter().collect();
    }
    let of_one = |one: &Decided| {
        let mut own = one.goal_fields();
        own.extend(one.fields());
        text(head_fields(label, claim), own)
    };
    decided.iter().map(of_one).collect()
}

/// The first fields of proof data.
fn head_fields(label: &str, claim: &str) -> Vec<String> {
    vec![
        field("format", quoted("vibro-audit-proof")),
        field("version", VERSION.to_string()),
        field("label", quoted(label)),
        field("claim", quoted(claim)),
    ]
}

/// The longest name of a file without its ending: file systems allow 255 bytes.
const LONGEST_NAME: usize = 200;

/// Returns a file name without its ending for each claim at these positions, from its label. No two are the same, in upper
/// or lower case, and none has a `-` and a number at its end, which tells several files of one claim apart.
pub fn file_names(sheet: &Sheet, positions: &[usize]) -> Vec<String> {
    let mut taken = BTreeSet::from(["schema".to_owned()]);
    let named = positions.iter().enumerate().map(|(number, &position)| {
        let label = sheet.entries.get(position).map_or("", |entry| entry.label.as_str());
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '.' { c } else { '_' };
        let mut name: String = label.chars().map(plain).take(LONGEST_NAME).collect();
        // a hidden file would be overlooked
        if !name.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_') {
            name.insert(0, '_');
        }
        if !taken.insert(name.to_ascii_lowercase()) {
            name = format!("{name}-claim{}", number + 1);
        }
        name
    });
    named.collect()
}

impl Decided {
    /// The goal in TeX, and how the claim was reduced to it.
    fn goal_fields(&self) -> Vec<String> {
        let rules = self.goal.statements.rules.iter();
        let premises = self.goal.statements.premises.iter().map(|premise| {
            let fields = [
                field("label", quoted(&premise.label)),
                field("tex", quoted(&premise.equation.to_string())),
            ];
            format!("{{{}}}", fields.join(", "))
        });
        vec![
            field("goal", quoted(&self.question.equation.to_string())),
            field("part", quoted(&self.goal.part)),
            field("instance", quoted(&self.question.instance)),
            field("reductions", list(rules.map(|rule| quoted(&rule.to_string())))),
            field("premises", list(premises)),
        ]
    }

    fn fields(&self) -> Vec<String> {
        let statement = &self.question.statement;
        let base = statement.terms().len();
        let mut fields = vec![match self.found {
            Found::Proved { .. } => field("verdict", quoted("proved")),
            Found::Refuted { .. } => field("verdict", quoted("refuted")),
        }];
        fields.extend(self.statement_fields());
        let empty = With {
            statement: statement.clone(),
            evidence: Certificate::default(),
        };
        let (certificate, point): (&With<Certificate>, &With<Witness>) = match &self.found {
            Found::Proved { certificate, point } => (certificate, point),
            Found::Refuted { witness } => (&empty, witness),
        };
        if let Found::Proved { .. } = self.found {
            let numbers = Numbers::new(certificate, base, &|roots| roots_of(&certificate.evidence, roots));
            let mut own = numbers.fields(&self.question.names, statement, &certificate.statement);
            own.extend(certificate_fields(&numbers, &certificate.evidence));
            fields.push(field("proof", format!("{{{}}}", own.join(", "))));
        }
        let numbers = Numbers::new(point, base, &|roots| {
            let witness = &point.evidence;
            roots.extend(witness.solved.iter().chain(&witness.sample).map(|(_, term)| *term));
            roots.extend(witness.functions.iter().map(|(.., term)| *term));
            roots.extend(witness.table.iter().flat_map(|(_, _, at, value)| [*at, *value]));
            roots_of(&witness.certificate, roots);
        });
        let mut own = numbers.fields(&self.question.names, statement, &point.statement);
        own.extend(witness_fields(&numbers, &point.evidence));
        fields.push(field("point", format!("{{{}}}", own.join(", "))));
        fields
    }

    /// What the statement says, without any evidence.
    fn statement_fields(&self) -> Vec<String> {
        let (statement, symbols) = (&self.question.statement, &self.goal.symbols);
        let numbers = Numbers {
            base: 0,
            kept: (0..u32::try_from(statement.terms().len()).unwrap_or(0))
                .map(Term)
                .collect(),
            number: HashMap::new(),
        };
        debug_assert_eq!(numbers.base, 0);
        let mut fields = vec![field("complex", u8::from(statement.is_complex()).to_string())];
        let names = |names: &[Name]| list(names.iter().map(|name| quoted(&name.to_string())));
        let states: Vec<Name> = symbols.states().cloned().collect();
        let continuous: Vec<Name> = symbols.continuous().cloned().collect();
        fields.push(field("states", names(&states)));
        fields.push(field("continuous", names(&continuous)));
        fields.push(field("letter", quoted(&symbols.index)));
        let roots = statement.functions().iter().filter_map(|of| match *of {
            FunctionOf::Interval { piecewise, .. } => self.question.names.motion_name(piecewise).cloned(),
            FunctionOf::Line => None,
        });
        let roots: BTreeSet<Name> = roots.chain(states).collect();
        let dots = roots.into_iter().map(|root| {
            let mut chain = vec![root];
            for _ in 0..8 {
                chain.extend(chain.last().map(Name::dotted));
            }
            names(&chain)
        });
        fields.push(field("dots", list(dots)));
        fields.push(field("flight", option(statement.interval())));
        fields.extend(numbers.fields(&self.question.names, &Statement::default(), statement));
        let definitions = statement.definitions().iter();
        fields.push(field(
            "definitions",
            list(definitions.map(|(symbol, term)| integers([symbol.0, term.0]))),
        ));
        let mut derivatives: Vec<[u32; 2]> = statement.derivatives().iter().map(|(f, g)| [f.0, g.0]).collect();
        derivatives.sort_unstable();
        fields.push(field("derivatives", list(derivatives.into_iter().map(integers))));
        let symbols = |symbols: &[Symbol]| integers(symbols.iter().map(|symbol| symbol.0));
        fields.push(field("complex_symbols", symbols(statement.complex_symbols())));
        fields.push(field("generic", symbols(statement.generic())));
        let givens = statement.givens().iter().map(given);
        fields.push(field("givens", list(givens)));
        fields.push(field("goals", conditions(statement.goal())));
        let maps = statement.implicit().iter().map(|map| {
            let equations = map.equations.iter();
            let equations = equations.map(|(label, term)| list([quoted(&named(label)), term.0.to_string()]));
            list([symbols(&map.of), symbols(&map.by), list(equations)])
        });
        fields.push(field("maps", list(maps)));
        fields.push(field("beside", integers(statement.beside().iter().map(|term| term.0))));
        fields
    }

    /// Another certificate, over the same terms as the one found, as JSON on one line; none where the claim is refuted.
    pub fn steps(&self, certificate: &Certificate) -> Option<String> {
        let Found::Proved { certificate: found, .. } = &self.found else {
            return None;
        };
        let numbers = Numbers::new(found, self.question.statement.terms().len(), &|roots| {
            roots_of(&found.evidence, roots);
        });
        Some(format!("{{{}}}", certificate_fields(&numbers, certificate).join(", ")))
    }
}

pub(super) fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

fn field(name: &str, value: String) -> String {
    format!("{}: {value}", quoted(name))
}

fn integers<N: ToString>(items: impl IntoIterator<Item = N>) -> String {
    list(items.into_iter().map(|item| item.to_string()))
}

/// A list of one or none.
fn option<N: ToString>(item: Option<N>) -> String {
    list(item.map(|item| item.to_string()))
}

/// The numbers that terms have in the data: those of the statement as they are, those of the evidence without what
/// nothing speaks of.
struct Numbers {
    base: usize,
    kept: Vec<Term>,
    number: HashMap<Term, usize>,
}

impl Numbers {
    fn new<T>(with: &With<T>, base: usize, roots: &dyn Fn(&mut Vec<Term>)) -> Self {
        let terms = with.statement.terms();
        let mut open = Vec::new();
        roots(&mut open);
        let all = (base..terms.len()).filter_map(|n| u32::try_from(n).ok()).map(Term);
        // every term that may be a generator keeps its place among the others
        let arithmetic = |term: &Term| {
            let node = terms.node(*term);
            matches!(
                node,
                Node::Number(_) | Node::Sum(_) | Node::Product(_) | Node::Power(..) | Node::Quotient(..)
            )
        };
        open.extend(all.filter(|term| !arithmetic(term)));
        let mut kept: BTreeSet<Term> = BTreeSet::new();
        while let Some(term) = open.pop() {
            if term.0 as usize >= base && kept.insert(term) {
                open.extend(terms.parts(term));
                if let Node::Integral { of, low, high } = *terms.node(term) {
                    open.extend([of, low, high]);
                }
            }
        }
        let kept: Vec<Term> = kept.into_iter().collect();
        let number = kept.iter().enumerate().map(|(n, term)| (*term, base + n)).collect();
        Self { base, kept, number }
    }

    fn of(&self, term: Term) -> String {
        match self.number.get(&term) {
            Some(number) => number.to_string(),
            None => term.0.to_string(),
        }
    }

    fn list(&self, terms: &[Term]) -> String {
        list(terms.iter().map(|term| self.of(*term)))
    }

    fn polynomial(&self, polynomial: &Polynomial) -> String {
        list(polynomial.terms().iter().map(|(monomial, value)| {
            let flat = monomial
                .iter()
                .flat_map(|(term, power)| [self.of(*term), power.to_string()]);
            list([quoted(&value.to_string()), list(flat)])
        }))
    }

    /// Symbols, functions and terms that a copy has beyond the statement.
    fn fields(&self, names: &Names, statement: &Statement, copy: &Statement) -> Vec<String> {
        let from = (statement.quantities().len(), statement.functions().len());
        let terms = list(self.kept.iter().map(|term| node(self, copy.terms(), *term)));
        let mut fields = meanings(names, copy, from.0, from.1);
        fields.push(field("terms", terms));
        fields
    }
}

fn meanings(names: &Names, statement: &Statement, symbols: usize, functions: usize) -> Vec<String> {
    let all = (symbols..statement.quantities().len()).filter_map(|n| u32::try_from(n).ok());
    let symbols = list(all.map(|n| symbol(names, statement, Symbol(n))));
    let all = statement.functions().iter().enumerate().skip(functions);
    let functions = list(all.map(|(place, of)| match *of {
        FunctionOf::Line => {
            let function = Function(u32::try_from(place).unwrap_or(u32::MAX));
            list([quoted("line"), quoted(statement.terms().function_name(function))])
        }
        FunctionOf::Interval { piecewise, offset } => {
            let name = names.motion_name(piecewise).map_or(String::new(), Name::to_string);
            list([quoted("flight"), quoted(&name), offset.to_string()])
        }
    }));
    vec![field("symbols", symbols), field("functions", functions)]
}

fn symbol(names: &Names, statement: &Statement, symbol: Symbol) -> String {
    let text = |name: &Name| quoted(&name.to_string());
    let meaning = match (names.of(statement, symbol), statement.quantity(symbol)) {
        (Some(Named::Parameter(name)), _) => vec![quoted("parameter"), text(&name)],
        (Some(Named::Running), _) => vec![quoted("running")],
        (Some(Named::Time { family, index }), _) => vec![quoted("time"), text(&family), index.to_string()],
        (Some(Named::State { state, index, after }), _) => {
            let after = u8::from(after).to_string();
            vec![quoted("state"), text(&state), index.to_string(), after]
        }
        (Some(Named::Absolute { state, index }), _) => vec![quoted("absolute"), text(&state), index.to_string()],
        (Some(Named::Invariant { kind, of }), _) => {
            vec![quoted("invariant"), quoted(&format!("{kind:?}")), text(&of)]
        }
        (Some(Named::Local { name, scope }), _) => vec![quoted("local"), text(&name), scope.to_string()],
        (None, Some(Quantity::Partial { of, by })) => vec![quoted("partial"), of.0.to_string(), by.0.to_string()],
        (None, _) => vec![quoted("fresh"), symbol.0.to_string()],
    };
    let printed = quoted(statement.terms().symbol_name(symbol));
    list([vec![printed], meaning].concat())
}

fn node(numbers: &Numbers, terms: &Terms, term: Term) -> String {
    let of = |term: &Term| numbers.of(*term);
    list(match terms.node(term) {
        Node::Number(value) => vec![quoted("number"), quoted(&value.to_string())],
        Node::Pi => vec![quoted("pi")],
        Node::Bound => vec![quoted("bound")],
        Node::Integral {
            of: integrand,
            low,
            high,
        } => {
            let mut parts = vec![quoted("integral")];
            parts.extend([integrand, low, high].map(of));
            parts
        }
        Node::Imaginary => vec![quoted("i")],
        Node::Symbol(symbol) => vec![quoted("symbol"), symbol.0.to_string()],
        Node::Sum(parts) => vec![quoted("sum"), numbers.list(parts)],
        Node::Product(parts) => vec![quoted("product"), numbers.list(parts)],
        Node::Power(base, exponent) => vec![quoted("power"), of(base), exponent.to_string()],
        Node::Quotient(above, below) => vec![quoted("quotient"), of(above), of(below)],
        Node::RealPower(base, exponent) => vec![quoted("realpower"), of(base), of(exponent)],
        Node::Elementary(Elementary::Root(index), radicand) => {
            vec![quoted("root"), index.to_string(), of(radicand)]
        }
        Node::Elementary(function, argument) => {
            vec![quoted(&format!("{function:?}").to_lowercase()), of(argument)]
        }
        Node::Value(function, order, at) => {
            vec![quoted("value"), function.0.to_string(), order.to_string(), of(at)]
        }
    })
}

fn property(property: Property) -> String {
    quoted(&format!("{property:?}").to_lowercase())
}

fn conditions(of: &[(Property, Term)]) -> String {
    list(
        of.iter()
            .map(|(holds, term)| list([property(*holds), term.0.to_string()])),
    )
}

fn given(given: &Given) -> String {
    let law = given.law.as_ref().map(|law| {
        list([
            option(law.time.map(|time| time.0)),
            option(law.interval),
            u8::from(law.every_index).to_string(),
            conditions(&law.conditions),
        ])
    });
    list([
        quoted(&named(&given.origin)),
        property(given.property),
        given.term.0.to_string(),
        law.unwrap_or_else(|| "[]".into()),
    ])
}

fn certificate_fields(numbers: &Numbers, certificate: &Certificate) -> Vec<String> {
    vec![
        field("whole", numbers.list(&certificate.whole)),
        field("steps", steps(numbers, &certificate.steps)),
    ]
}

fn witness_fields(numbers: &Numbers, witness: &Witness) -> Vec<String> {
    let values = |values: &[(Symbol, Term)]| {
        list(
            values
                .iter()
                .map(|(symbol, term)| list([symbol.0.to_string(), numbers.of(*term)])),
        )
    };
    let functions = witness.functions.iter();
    let functions =
        functions.map(|(function, time, term)| list([function.0.to_string(), time.0.to_string(), numbers.of(*term)]));
    let table = witness.table.iter();
    let table = table.map(|(function, order, at, value)| {
        list([
            function.0.to_string(),
            order.to_string(),
            numbers.of(*at),
            numbers.of(*value),
        ])
    });
    let certificate = certificate_fields(numbers, &witness.certificate);
    vec![
        field("solved", values(&witness.solved)),
        field("sample", values(&witness.sample)),
        field("functions_named", list(functions)),
        field("table", list(table)),
        field("certificate", format!("{{{}}}", certificate.join(", "))),
    ]
}

fn source(of: LawSource) -> String {
    match of {
        LawSource::Given { given, shift } => list([quoted("given"), given.to_string(), shift.to_string()]),
        LawSource::Derived(number) => list([quoted("derived"), number.to_string()]),
    }
}

fn steps(numbers: &Numbers, steps: &[Inference]) -> String {
    list(steps.iter().map(|step| self::step(numbers, step)))
}

fn step(numbers: &Numbers, step: &Inference) -> String {
    let of = |term: &Term| numbers.of(*term);
    let polynomial = |p: &Polynomial| numbers.polynomial(p);
    let factors = |factors: &[(usize, u32)]| {
        list(
            factors
                .iter()
                .map(|(fact, power)| list([fact.to_string(), power.to_string()])),
        )
    };
    let terms = |terms: &[(Polynomial, usize)]| {
        list(
            terms
                .iter()
                .map(|(coefficient, fact)| list([polynomial(coefficient), fact.to_string()])),
        )
    };
    let parts = match step {
        Inference::Given(number) => vec![quoted("given"), number.to_string()],
        Inference::Law { source: law, at } => {
            vec![quoted("law"), source(*law), option(at.as_ref().map(of))]
        }
        Inference::Axiom(Axiom { name, terms }) => {
            vec![quoted("axiom"), quoted(name), numbers.list(terms)]
        }
        Inference::Unfold(term) => vec![quoted("unfold"), numbers.of(*term)],
        Inference::Enclosure(polynomial) => vec![quoted("enclosure"), numbers.polynomial(polynomial)],
        Inference::Between { target, within } => {
            let pairs = within
                .iter()
                .map(|[low, high]| list([low.to_string(), high.to_string()]));
            vec![quoted("between"), numbers.polynomial(target), list(pairs)]
        }
        Inference::Zero {
            target,
            power,
            squares,
            factors: own,
            terms: sum,
        } => {
            let squares = squares.iter();
            let squares = squares.map(|(factor, root)| list([quoted(&factor.to_string()), polynomial(root)]));
            vec![
                quoted("zero"),
                polynomial(target),
                power.to_string(),
                list(squares),
                factors(own),
                terms(sum),
            ]
        }
        Inference::Nonzero {
            target,
            cofactor,
            factors: own,
            terms: sum,
        } => vec![
            quoted("nonzero"),
            polynomial(target),
            polynomial(cofactor),
            factors(own),
            terms(sum),
        ],
        Inference::Sign {
            target,
            strict,
            factors: own,
            summands,
            terms: sum,
        } => {
            let summands = summands.iter().map(|Summand { factor, facts, root }| {
                list([quoted(&factor.to_string()), integers(facts), polynomial(root)])
            });
            vec![
                quoted("sign"),
                polynomial(target),
                u8::from(*strict).to_string(),
                factors(own),
                list(summands),
                terms(sum),
            ]
        }
        Inference::Squeezed { low, high } => vec![quoted("squeezed"), low.to_string(), high.to_string()],
        Inference::Congruence { left, right } => vec![quoted("congruence"), of(left), of(right)],
        Inference::Cases {
            on,
            order,
            property: shown,
            target,
            branches,
        } => vec![
            quoted("cases"),
            polynomial(on),
            u8::from(*order).to_string(),
            property(*shown),
            polynomial(target),
            list(branches.iter().map(|branch| self::steps(numbers, branch))),
        ],
        Inference::Derivative(law) => vec![quoted("derivative"), source(*law)],
        Inference::Constant {
            of: term,
            time,
            at,
            interval,
            steps,
        } => vec![
            quoted("constant"),
            of(term),
            time.0.to_string(),
            of(at),
            option(*interval),
            self::steps(numbers, steps),
        ],
        Inference::Generic(term) => vec![quoted("generic"), numbers.of(*term)],
        Inference::Along { implicit, equation, by } => {
            vec![
                quoted("along"),
                implicit.to_string(),
                equation.to_string(),
                by.0.to_string(),
            ]
        }
    };
    list(parts)
}

/// The name of a given in the data: what it comes from, where no label of a premise is taken for the words of others.
fn named(origin: &Origin) -> String {
    let others = ["the ", "derivatives exist", "[symbols]"];
    match origin {
        Origin::Premise(label) if others.iter().any(|words| label.starts_with(words)) => format!("premise {label}"),
        origin => origin.to_string(),
    }
}

/// The terms that a certificate speaks of.
fn roots_of(certificate: &Certificate, roots: &mut Vec<Term>) {
    roots.extend(&certificate.whole);
    for step in &certificate.steps {
        roots_of_step(step, roots);
    }
}

fn roots_of_step(step: &Inference, roots: &mut Vec<Term>) {
    roots.extend(step.terms());
    roots.extend(step.polynomials().into_iter().flat_map(Polynomial::generators));
    for inner in step.within() {
        roots_of_step(inner, roots);
    }
}
