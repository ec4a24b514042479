//! What a bracket makes of a name: calls, elementary functions, traces and determinants.

use super::command::{CONJUGATE, invariant};
use super::elementary::Elementary;
use super::error::{Fault, Reason};
use super::exponent::Exponent;
use super::part::{Form, Part, product};
use super::reader::Reader;
use super::token::{Bracket, Kind, Token};
use super::{At, DoubtKind, Invariant, Name, OtherReading, Tree};

impl<'a> Reader<'a> {
    /// What begins with a letter, a word or an accent: a symbol, a call, a trace or an elementary function.
    pub(super) fn named(&mut self, token: Token<'a>) -> Result<Part, Fault> {
        if token.kind == Kind::Word {
            if let Some(kind) = invariant(token.text) {
                return self.invariant(kind, 1);
            }
            if let Some(function) = self.function_word(token.text) {
                return self.elementary(function, 1);
            }
            if matches!(token.text, "max" | "min") && !self.names.words.iter().any(|word| word == token.text) {
                return self.extremum(token.text);
            }
        }
        if let Some((kind, length)) = self.plain_invariant() {
            return self.invariant(kind, length);
        }
        if let Some((function, length)) = self.plain_elementary() {
            return self.elementary(function, length);
        }
        self.no_foreign_function(token.at)?;
        let line = token.kind == Kind::Accent && token.text == "\\overline";
        if line && self.look(1).is_some_and(|next| next.kind == Kind::BraceOpen) {
            return self.conjugate(token.at);
        }
        let name = self.bare_name()?;
        self.symbol(name, token.at)
    }

    /// The elementary function that an upright word names; `Re` may be declared to be something else.
    pub(super) fn function_word(&self, word: &str) -> Option<&'static Elementary> {
        let is_declared = self.names.words.iter().any(|declared| declared == word);
        Elementary::by_word(word).filter(|function| !(is_declared && function.is_part()))
    }

    /// `\overline{..}`: over a symbol an accent, over any other formula its conjugate.
    fn conjugate(&mut self, at: usize) -> Result<Part, Fault> {
        self.next += 1;
        let open = self.here();
        self.next += 1;
        self.deepen()?;
        let tree = self.sum()?;
        self.close_brace(open)?;
        self.rise();
        match *tree {
            Tree::Symbol(mut name, _) => {
                name.accents.push("\\overline".to_owned());
                self.symbol(name, at)
            }
            _ => self.carried(
                Box::new(Tree::Call(Name::plain(CONJUGATE), tree, At(at))),
                Form::Bracketed,
            ),
        }
    }

    /// `name` with the scripts and the argument that follow it.
    pub(super) fn symbol(&mut self, mut name: Name, at: usize) -> Result<Part, Fault> {
        let power = self.scripts(&mut name)?;
        if self.names.is_function(&name)
            && let Some(argument) = self.argument_of(&name)?
        {
            // u(1 - u): no function is taken where it holds itself
            let is_sum = matches!(*argument, Tree::Sum(_) | Tree::Product(_));
            if is_sum && self.names.has_bare_derivative_of(&name, &argument) {
                let letter = raise(Box::new(Tree::Symbol(name, At(at))), power);
                let bracket = self.call(argument, None)?;
                let tree = product(vec![*letter.tree, *bracket.tree]);
                return Ok(Part { tree, form: Form::Knot });
            }
            let power = power.map(Exponent::before_argument).transpose()?;
            let is_power = power.is_some();
            let part = self.call(Box::new(Tree::Call(name.clone(), argument.clone(), At(at))), power)?;
            if is_power {
                let taken = (*part.tree).clone();
                let readings = matches!(taken, Tree::Power(_, 2, _)).then(|| {
                    let value = Tree::Call(name.clone(), argument, At(at));
                    let other = Tree::Call(name.clone(), Box::new(value), At(at));
                    OtherReading { taken, other }
                });
                let readings = readings.into_iter().collect();
                self.doubt(at, DoubtKind::PowerOfFunction { of: name, readings });
            }
            return Ok(part);
        }
        let is_plain = power.is_none();
        let factors = self.names.opaque.as_ref().map(|opaque| &opaque.factors);
        let is_factor = factors.is_some_and(|factors| factors.contains(&name.base)) && self.letters_in_brackets() > 1;
        let is_refused = self.single_term_in_brackets_follows() && !self.power_of_negative_follows();
        if is_plain && !is_factor && is_refused {
            let found = format!("`{name}` before a single term in brackets");
            let instead = "a product needs none; declare what is a function";
            return Err(Fault::ambiguous(at, &found, instead));
        }
        let symbol = raise(Box::new(Tree::Symbol(name, At(at))), power);
        match is_plain {
            true => self.in_degrees(symbol),
            false => Ok(symbol),
        }
    }

    /// The number of letters that stand next in a bracket, before anything else: 2 in `(B K)`.
    fn letters_in_brackets(&self) -> usize {
        let is_letter = |ahead: &usize| self.look(*ahead).is_some_and(|token| token.kind == Kind::Letter);
        (1..).take_while(is_letter).count()
    }

    /// Returns true if `(-1)^n` stands next in a sheet: a product needs the brackets.
    pub(super) fn power_of_negative_follows(&self) -> bool {
        let kinds = [0, 1, 2, 3, 4].map(|ahead| self.look(ahead).map(|token| token.kind));
        let (open, close) = (Kind::Open(Bracket::Round), Kind::Close(Bracket::Round));
        let wanted = [open, Kind::Minus, Kind::Number, close, Kind::Sup].map(Some);
        self.names.opaque.is_none() && kinds == wanted
    }

    /// Whether `(x)`, `(0)` or `(-2 t)` stands next.
    fn single_term_in_brackets_follows(&self) -> bool {
        let kind = |ahead: usize| self.look(ahead).map(|token| token.kind);
        let first = 1 + usize::from(kind(1) == Some(Kind::Minus));
        let is_part = |ahead: &usize| {
            let part = [
                Kind::Letter,
                Kind::Number,
                Kind::Sub,
                Kind::BraceOpen,
                Kind::BraceClose,
                Kind::Prime,
            ];
            kind(*ahead).is_some_and(|kind| part.contains(&kind))
        };
        // a term is short; looking further would make long input slow
        let length = (first..first + 12).take_while(is_part).count();
        let ends = kind(first + length) == Some(Kind::Close(Bracket::Round));
        kind(0) == Some(Kind::Open(Bracket::Round)) && length > 0 && ends
    }

    /// The argument of a function of this name that stands next in brackets; that of one that a definition gives may be several.
    fn argument_of(&mut self, name: &Name) -> Result<Option<Box<Tree>>, Fault> {
        self.skip_empty();
        let is_round = self.peek_kind() == Some(Kind::Open(Bracket::Round));
        match is_round && self.names.is_defined(name) {
            true => self.arguments().map(Some),
            false => self.bracketed_argument(),
        }
    }

    /// The argument between brackets that stands next, perhaps with braces around them.
    fn bracketed_argument(&mut self) -> Result<Option<Box<Tree>>, Fault> {
        self.skip_empty();
        match self.peek_kind() {
            Some(Kind::Open(kind))
                if !matches!(
                    kind,
                    Bracket::Bar | Bracket::DoubleBar | Bracket::Floor | Bracket::Ceiling
                ) =>
            {
                self.argument_bracket(kind)?;
                self.bracketed().map(Some)
            }
            Some(Kind::BraceOpen) => self.braced_argument(),
            _ => Ok(None),
        }
    }

    /// The argument of `f{(x)}`, which prints as `f(x)`; `None` where the braces hold something else.
    fn braced_argument(&mut self) -> Result<Option<Box<Tree>>, Fault> {
        let is = |ahead: usize, kind: Kind| self.look(ahead).is_some_and(|token| token.kind == kind);
        let braces = (0..).take_while(|&ahead| is(ahead, Kind::BraceOpen)).count();
        // looked for among the tokens, not by reading: what is read twice at each depth takes for ever
        let (mut depth, mut end) = (0_usize, braces);
        while let Some(token) = self.look(end) {
            match token.kind {
                Kind::Open(_) | Kind::BraceOpen => depth += 1,
                Kind::Close(_) | Kind::BraceClose => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth == 0 {
                break;
            }
            end += 1;
        }
        let opens = is(braces, Kind::Open(Bracket::Round)) || is(braces, Kind::Open(Bracket::Square));
        if !(opens && (1..=braces).all(|more| is(end + more, Kind::BraceClose))) {
            return Ok(None);
        }
        let at = self.here();
        self.next += braces;
        let argument = self.bracketed()?;
        for _ in 0..braces {
            self.close_brace(at)?;
        }
        Ok(Some(argument))
    }

    /// A finished call: the power before its argument, or the one behind.
    fn call(&mut self, call: Box<Tree>, before: Option<Exponent>) -> Result<Part, Fault> {
        let at = self.here();
        match (before, self.power()?) {
            (Some(_), Some(_)) => Err(Fault::unsupported(
                at,
                "a second power of one call",
                "put brackets around the first",
            )),
            (power, None) | (None, power) => Ok(raise(call, power)),
        }
    }

    fn argument_bracket(&self, kind: Bracket) -> Result<(), Fault> {
        match kind {
            Bracket::Curly => {
                let instead = "an argument stands in ( ) or [ ]; write \\cdot for a product";
                Err(Fault::ambiguous(self.here(), "\\{ after a function", instead))
            }
            _ => Ok(()),
        }
    }

    /// An elementary function, whose name is the next `length` tokens.
    pub(super) fn elementary(&mut self, function: &'static Elementary, length: usize) -> Result<Part, Fault> {
        let at = self.here();
        self.next += length;
        let base = self.logarithm_base(function)?;
        let value = |argument| match &base {
            Some(base) => logarithm(base.clone(), argument, at),
            None => function.of(argument, at),
        };
        let power = match self.peek_kind() {
            Some(Kind::Sup | Kind::Sub | Kind::Prime) => self.power_of(function)?,
            _ => None,
        };
        let inverse = power.as_ref().filter(|power| power.is_minus_one());
        let inverse = inverse.and_then(|_| function.inverse());
        let (argument, part) = match self.bracketed_argument()? {
            Some(argument) => (argument.clone(), self.call(value(argument), power)?),
            None => {
                let argument = self.bare_argument(function)?;
                // without brackets a power behind it would be one of the argument, even behind braces
                let form = Form::Bare;
                (
                    argument.clone(),
                    Part {
                        form,
                        ..raise(value(argument), power)
                    },
                )
            }
        };
        let Some(inverse) = inverse else {
            return Ok(part);
        };
        let taken = *inverse.of(argument, at);
        let readings = vec![OtherReading {
            taken: taken.clone(),
            other: *part.tree,
        }];
        self.doubt(
            at,
            DoubtKind::Inverse {
                of: function.command,
                readings,
            },
        );
        let tree = Box::new(taken);
        Ok(Part { tree, ..part })
    }

    /// The base of a logarithm, as in `\log_2 x`.
    fn logarithm_base(&mut self, function: &Elementary) -> Result<Option<Box<Tree>>, Fault> {
        match (function.command, self.peek_kind()) {
            (r"\log", Some(Kind::Sub)) => {
                self.next += 1;
                self.argument().map(Some)
            }
            _ => Ok(None),
        }
    }

    /// The power between an elementary function and its argument.
    fn power_of(&mut self, function: &Elementary) -> Result<Option<Exponent>, Fault> {
        let is = |ahead: usize, kind: Kind| self.look(ahead).is_some_and(|token| token.kind == kind);
        // `\sin^{(n)}` is a derivative
        let in_brackets = is(1, Kind::BraceOpen) && matches!(self.look(2).map(|token| token.kind), Some(Kind::Open(_)));
        let power = self.power()?;
        match function.has_powers && !in_brackets {
            // a symbol is a power too, as in `\sin^n x`
            true => Ok(power),
            false => power.map(Exponent::before_argument).transpose(),
        }
    }

    /// Whether `Tr(`, `det^2[` and their like stand next, in letters: which, and how many letters.
    fn plain_invariant(&self) -> Option<(Invariant, usize)> {
        let run = self.letters(true);
        let fits = |length: &usize| run.get(..*length).and_then(invariant).is_some();
        let length = [3, 2].into_iter().find(fits)?;
        let kind = run.get(..length).and_then(invariant)?;
        self.bracket_follows(length).then_some((kind, length))
    }

    /// Whether `cos(` or its like stands next, in letters: which, and how many letters. Without the bracket such
    /// letters are an error, not a product.
    fn plain_elementary(&self) -> Option<(&'static Elementary, usize)> {
        let run = self.letters(true);
        let function = Elementary::at_start(&run).filter(|_| self.names.word_at_start(&run).is_none())?;
        let length = function.command.len() - 1;
        self.bracket_follows(length).then_some((function, length))
    }

    /// Refuses `sqrt(` and its like in letters: a programmer means the function, TeX prints a product.
    fn no_foreign_function(&self, at: usize) -> Result<(), Fault> {
        let run = self.letters(true);
        let is_next = |word: &&&str| run.starts_with(**word) && self.bracket_follows(word.len());
        let word = FOREIGN_FUNCTIONS.iter().find(is_next);
        match word.filter(|_| self.names.word_at_start(&run).is_none()) {
            Some(word) => {
                let letters = word.chars().map(String::from).collect::<Vec<_>>().join(" ");
                let function = format!("\\operatorname{{{word}}}");
                Err(Fault::two_readings(at, &format!("`{word}(`"), &function, &letters))
            }
            None => Ok(()),
        }
    }

    /// Whether a bracket stands behind the next `skip` tokens and, perhaps, a power.
    fn bracket_follows(&self, skip: usize) -> bool {
        let mut ahead = skip;
        if self.look(ahead).is_some_and(|token| token.kind == Kind::Sup) {
            let braced = self.look(ahead + 1).is_some_and(|token| token.kind == Kind::BraceOpen);
            // A power is short; looking further would make long input slow.
            let close = (2..12).find(|more| {
                self.look(ahead + more)
                    .is_some_and(|token| token.kind == Kind::BraceClose)
            });
            ahead += match (braced, close) {
                (true, Some(close)) => close + 1,
                (true, None) => return false,
                (false, _) => 2,
            };
        }
        let after = self.look(ahead).map(|token| token.kind);
        matches!(after, Some(Kind::Open(Bracket::Round | Bracket::Square)))
    }

    /// A trace or determinant, whose name is the next `length` tokens.
    pub(super) fn invariant(&mut self, kind: Invariant, length: usize) -> Result<Part, Fault> {
        let at = self.here();
        self.next += length;
        let power = match self.peek_kind() {
            Some(Kind::Sup | Kind::Sub | Kind::Prime) => self.power()?,
            _ => None,
        };
        if self.rows_follow() || self.names.matrices.is_empty() {
            let tree = self.invariant_of(kind, at)?;
            return self.call(tree, power);
        }
        let of = match self.open() {
            Some((open, bracket)) => {
                let name = self.matrix()?;
                // `DP(H_k)` says where the matrix is taken; the name alone matters.
                if let Some(Kind::Open(Bracket::Round | Bracket::Square)) = self.peek_kind() {
                    self.bracketed()?;
                }
                self.close(open, bracket)?;
                name
            }
            None => self.matrix()?,
        };
        let at = At(at);
        let power = power.map(Exponent::before_argument).transpose()?;
        self.call(Box::new(Tree::Invariant { kind, of, at }), power)
    }

    /// The name of a declared matrix.
    fn matrix(&mut self) -> Result<Name, Fault> {
        let at = self.here();
        let letters = self.letters(false);
        let mut name = match (letters.is_empty(), self.take(Kind::Word)) {
            (false, _) => {
                self.next += letters.len();
                Name::plain(&letters)
            }
            (true, Some(word)) => Name::plain(word.text),
            (true, None) => self.bare_name()?,
        };
        let power = self.scripts(&mut name)?;
        if power.is_none() && self.names.matrices.contains(&name) {
            return Ok(name);
        }
        let known: Vec<String> = self.names.matrices.iter().map(Name::to_string).collect();
        let known = known.join(", ");
        let found = format!("`{name}`");
        Err(Fault::new(at, Reason::UnknownMatrix { found, known }))
    }
}

/// Functions that programs spell in letters and this reader does not know under that name.
const FOREIGN_FUNCTIONS: [&str; 19] = [
    "sqrt", "cbrt", "asinh", "acosh", "atanh", "asin", "acos", "atan", "max", "min", "mod", "sign", "floor", "ceil",
    "round", "gcd", "Re", "Im", "arg",
];

/// `\log_a x` = ln x / ln a.
fn logarithm(of_base: Box<Tree>, argument: Box<Tree>, at: usize) -> Box<Tree> {
    let [above, below] = [argument, of_base].map(|of| Box::new(Tree::Call(Name::plain(r"\ln"), of, At(at))));
    Box::new(Tree::Quotient(above, below, At(at)))
}

/// `tree` to `power`.
pub(super) fn raise(tree: Box<Tree>, power: Option<Exponent>) -> Part {
    match power {
        Some(exponent) => Part {
            tree: Box::new(exponent.of(tree)),
            form: Form::Knot,
        },
        None => Part {
            tree,
            form: Form::Plain,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};

    #[test]
    fn calls_and_products() {
        check(&[
            ("F_1(t_k)", "<F_1 t_k>"),
            ("F_{1}[t_k]", "<F_1 t_k>"),
            (r"F_1\left(t_k\right)", "<F_1 t_k>"),
            ("{F_1}(t)", "<F_1 t>"),
            (r"\dot{Z}^{-}(t_k)", r"<\dot{Z}^- t_k>"),
            (r"\dot{Z}_k^-(t - t_k)", r"(* \dot{Z}_k^- (+ t (- t_k)))"),
            (r"\overline{g}(t - t_k)", r"(* \overline{g} (+ t (- t_k)))"),
            (r"F_1 \cdot (t)", "(* F_1 t)"),
            ("f^2(t_k)", "(^ <f t_k> 2)"),
            ("f(t_k)^2", "(^ <f t_k> 2)"),
            ("f(t)(t - a)", "(* <f t> (+ t (- a)))"),
            ("f{a}", "(* f a)"),
            (r"f{\left(t + a \right)}", "<f (+ t a)>"),
            ("f{(t)} f{}(t) {f}{(t)} {f}(t)", "(* <f t> <f t> <f t> <f t>)"),
            (r"f^{2}{\left(t\right)} f'{(t)}", "(* (^ <f t> 2) <f' t>)"),
            ("f{{(t)}}", "<f t>"),
            (r"\dot Z{(t)}", r"<\dot{Z} t>"),
            ("f", "f"),
        ]);
        refuse(&[
            ("f^{-1}(t)", "inverse function"),
            ("f^2(t)^2", "second power"),
            (r"f\{t\}", "an argument stands in"),
            ("(f)(t)", "a bracket after a function without argument"),
            ("(f + a)(t)", "a bracket after a function without argument"),
            (r"\frac{f}{a}(t)", "a bracket after a function without argument"),
            (r"\frac{a + f}{2}[t + a]", "a bracket after a function without argument"),
            ("f(t", "`(` is not closed"),
            ("sqrt(4)", r"`sqrt(` can be read as \operatorname{sqrt} or as s q r t"),
            ("a asin[t]", "`asin(` can be read"),
        ]);
    }

    #[test]
    fn parts_of_complex_numbers() {
        check(&[
            (r"\operatorname{Re} z", r"<\Re z>"),
            (r"\Re z + w", r"(+ <\Re z> w)"),
            (r"\mathrm{Im}(z w)", r"<\Im (* z w)>"),
            (r"2\operatorname{Im}\frac{1}{z}", r"(* 2 <\Im (/ 1 z)>)"),
            (r"\arg z", r"<\arg z>"),
            (r"\arg f(t)", r"<\arg <f t>>"),
            (r"\overline{z w}", r"<\conjugate (* z w)>"),
            (r"\overline{z + w}^2", r"(^ <\conjugate (+ z w)> 2)"),
            (r"\overline{z_1} \bar w", r"(* \overline{z}_1 \overline{w})"),
            (r"\operatorname{Re}\overline{z w}", r"<\Re <\conjugate (* z w)>>"),
            ("R e z", "(* R e z)"),
        ]);
        refuse(&[
            (r"\operatorname{Re} z w", "can be read as"),
            ("Im(z)", "`Im(` can be read"),
            (r"\overline{z w", "is not closed"),
            (r"\overline{}", "found `}`"),
        ]);
    }

    #[test]
    fn braces_behind_a_function_are_read_once_at_each_depth() {
        let nested = |depth: usize| (0..depth).fold("a".to_owned(), |inner, _| format!("f{{({inner} + b)}}"));
        let spelled = |depth: usize| (0..depth).fold("a".to_owned(), |inner, _| format!("<f (+ {inner} b)>"));
        // read twice at each, this would be read 2^40 times
        check(&[(&nested(2), &spelled(2))]);
        assert!(super::super::read_expression(&nested(40), &super::super::spelled::names()).is_ok());
    }

    #[test]
    fn elementary_functions() {
        check(&[
            (r"\cos(\pi t)", r"<\cos (* \pi t)>"),
            (r"\sin[x]", r"<\sin x>"),
            (r"\cos^2(x)", r"(^ <\cos x> 2)"),
            (r"\operatorname{cos}(x)", r"<\cos x>"),
            (r"cos(\pi t + \phi)", r"<\cos (+ (* \pi t) \phi)>"),
            ("2sin^2[x]", r"(* 2 (^ <\sin x> 2))"),
            ("gsin(x)", r"(* g <\sin x>)"),
            (r"\arctan(x) \ln(y)", r"(* <\arctan x> <\ln y>)"),
            (
                r"\operatorname{arsinh}(x) \operatorname{sgn}(y)",
                r"(* <\operatorname{arsinh} x> <\operatorname{sgn} y>)",
            ),
            (
                r"\coth(x) \cot(x) \sec(x) \csc(x)",
                r"(* <\coth x> <\cot x> <\sec x> <\csc x>)",
            ),
            (
                r"\operatorname{arcosh}^2(x) + artanh(x)",
                r"(+ (^ <\operatorname{arcosh} x> 2) <\operatorname{artanh} x>)",
            ),
            (r"\sin^{1/3}(x)", r"(^^ <\sin x> (/ 1 3))"),
            ("f^{2/3}(t)", "(^^ <f t> (/ 2 3))"),
            ("f|x|", r"(* f <\operatorname{abs} x>)"),
        ]);
        refuse(&[
            (r"f^n(t)", "behind brackets around the call"),
            (r"f^{-a}(t)", "behind brackets around the call"),
            (r"\ln_2(x)", "only a name"),
            (r"\log_12 x", "write { }"),
            ("arcsinh(x)", "a bracket behind it"),
        ]);
    }

    #[test]
    fn logarithms() {
        check(&[
            (r"\log x", r"<\log x>"),
            (r"\log_a x", r"(/ <\ln x> <\ln a>)"),
            (r"\log_{10} 2x", r"(/ <\ln (* 2 x)> <\ln 10>)"),
            (r"\log_2(x)", r"(/ <\ln x> <\ln 2>)"),
            (r"\log_\alpha^2(x)", r"(^ (/ <\ln x> <\ln \alpha>) 2)"),
            (r"\log_{a+b}\frac{x}{y}", r"(/ <\ln (/ x y)> <\ln (+ a b)>)"),
            (r"\log_a b \log_b c", r"(* (/ <\ln b> <\ln a>) (/ <\ln c> <\ln b>))"),
            (r"\lg x", r"(/ <\ln x> <\ln 10>)"),
            (r"\operatorname{lg}(x)", r"(/ <\ln x> <\ln 10>)"),
            ("m l g(x + y)", "(* m l g (+ x y))"),
            ("mlg(x + y)", "(* m l g (+ x y))"),
            (
                r"\arcsinh x + \operatorname{arccosh}(x)",
                r"(+ <\operatorname{arsinh} x> <\operatorname{arcosh} x>)",
            ),
        ]);
        check(&[
            (r"\log_a x y", r"(/ <\ln (* x y)> <\ln a>)"),
            (r"\ln x y \cos x", r"(* <\ln (* x y)> <\cos x>)"),
        ]);
    }

    #[test]
    fn traces_and_determinants() {
        for tex in [
            "Tr(DP)",
            r"\mathrm{Tr}(DP)",
            r"\text{Tr}[DP]",
            r"\operatorname{Tr}\left( DP \right)",
            r"\operatorname{tr}(DP)",
            r"\mathrm{tr}(D P)",
            "tr(DP)",
            r"Tr(DP(\mathbf{H}_k^*))",
            r"\mathrm{Tr}\,\mathrm{DP}",
            r"Tr(\mathbf{DP})",
        ] {
            check(&[(tex, "trace(DP)")]);
        }
        for tex in [
            "Det(DP)",
            r"\det(DP)",
            r"\det DP",
            "det(DP)",
            r"\mathrm{det}(DP)",
            r"\text{Det}(DP)",
        ] {
            check(&[(tex, "determinant(DP)")]);
        }
        for tex in ["[Tr(DP)]^2", "Tr(DP)^2", "Tr^2(DP)", "Tr^{2}(DP)", r"\mathrm{Tr}^2(DP)"] {
            check(&[(tex, "(^ trace(DP) 2)")]);
        }
        check(&[
            ("T r(a + 1)", "(* T r (+ a 1))"),
            ("Tr + 1", "(+ (* T r) 1)"),
            ("4 \\cdot Det(DP)", "(* 4 determinant(DP))"),
            ("aTr(DP)", "(* a trace(DP))"),
        ]);
        refuse(&[
            ("T r(a)", "`r` before a single term in brackets"),
            ("Tr(A)", "`A` is no known matrix (known: DP)"),
            ("Tr(DP", "`(` is not closed"),
            ("Tr(DP_2)", "is no known matrix"),
            ("Tr^{-1}(DP)", "inverse function"),
            (r"\det", "a name"),
        ]);
    }
}
