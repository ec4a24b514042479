//! `\max(a, b)` and `\min\{a, b, c\}` of real numbers, as trees: max(a, b) = (a + b + |a - b|)/2.

use super::command::ABSOLUTE;
use super::error::Fault;
use super::part::{Form, Part};
use super::reader::Reader;
use super::token::Kind;
use super::{At, Name, Tree};
use numbers::{Field, Rational};

/// The most arguments of one maximum.
const MOST: usize = 4;

/// The longest text of the arguments of one maximum: each of them stands twice in its tree.
const LONGEST: usize = 1000;

impl Reader<'_> {
    /// The maximum or minimum whose `word` stands next.
    pub(super) fn extremum(&mut self, word: &str) -> Result<Part, Fault> {
        let at = self.here();
        self.next += 1;
        let Some((open, kind)) = self.open() else {
            return Err(self.instead_of("brackets around what the largest or smallest is of"));
        };
        let mut values = vec![*self.sum()?];
        while self
            .peek()
            .is_some_and(|token| token.kind == Kind::Comma && token.text == ",")
        {
            self.next += 1;
            values.push(*self.sum()?);
        }
        self.close(open, kind)?;
        let length: usize = values.iter().map(|value| value.to_string().len()).sum();
        if !(2..=MOST).contains(&values.len()) || length > LONGEST {
            let instead = "two to four short arguments stand in its brackets";
            return Err(Fault::unsupported(at, "this maximum or minimum", instead));
        }
        let is_largest = word.ends_with("max");
        let of_all = values
            .into_iter()
            .reduce(|one, other| of_two(one, other, is_largest, at));
        let tree = of_all.ok_or_else(|| self.instead_of("an argument"))?;
        self.carried(Box::new(tree), Form::Plain)
    }
}

impl Tree {
    /// What this is the maximum or minimum of, where it is written as the reader writes one.
    pub fn extremum_of(&self) -> Option<[&Tree; 2]> {
        let Tree::Quotient(above, _, _) = self else {
            return None;
        };
        let Tree::Sum(terms) = &**above else {
            return None;
        };
        let [one, other, distance] = terms.as_slice() else {
            return None;
        };
        let is_largest = !matches!(distance, Tree::Negate(_));
        (*self == of_two(one.clone(), other.clone(), is_largest, 0)).then_some([one, other])
    }
}

fn of_two(one: Tree, other: Tree, is_largest: bool, at: usize) -> Tree {
    let difference = Tree::Sum(vec![one.clone(), Tree::Negate(Box::new(other.clone()))]);
    let distance = Tree::Call(Name::plain(ABSOLUTE), Box::new(difference), At(at));
    let distance = match is_largest {
        true => distance,
        false => Tree::Negate(Box::new(distance)),
    };
    let two = Tree::Number(Rational::from_integer(2));
    Tree::Quotient(Box::new(Tree::Sum(vec![one, other, distance])), Box::new(two), At(at))
}

#[cfg(test)]
mod tests {
    use super::super::read_expression;
    use super::super::spelled::{check, names, refuse};

    #[test]
    fn maxima_and_minima() {
        let largest = "(/ (+ a b <|| (+ a (- b))>) 2)";
        let smallest = "(/ (+ a b (- <|| (+ a (- b))>)) 2)";
        for (tex, wanted) in [
            (r"\max(a, b)", largest),
            (r"\max\{a, b\}", largest),
            (r"\max\left[a,b\right]", largest),
            (r"\operatorname{max}(a, b)", largest),
            (r"\mathrm{min}\{a, b\}", smallest),
            (r"\min\left(a, b\right)", smallest),
        ] {
            check(&[(tex, wanted.replace("||", r"\operatorname{abs}").as_str())]);
        }
        for tex in [
            r"\max(a, b, c)",
            r"\min(-a, b + c)^2",
            r"2\max(a - b, -c) x",
            r"\max(\min(a, b), c)",
            r"\max(\pm a, \mp b)",
        ] {
            let tree = read_expression(tex, &names()).unwrap();
            assert_eq!(read_expression(&tree.to_string(), &names()).unwrap(), tree, "{tex}");
        }
        let smallest = read_expression(r"\min(a, b + c)", &names()).unwrap();
        let values = smallest.extremum_of().map(|values| values.map(ToString::to_string));
        assert_eq!(values, Some(["a".to_string(), "b + c".to_string()]));
        refuse(&[
            (r"\max(a)", "two to four"),
            (r"\max(a; b)", "a closing bracket"),
            (r"\max a", "brackets around"),
            (r"\max_x f(x)", "brackets around"),
            (r"\max^2(a, b)", "brackets around"),
            (r"\max|a|", "brackets around"),
            (r"\sin x \max(a, b)", "can be read as"),
            ("max(a, b)", r"`max(` can be read"),
        ]);
        let nested = (0..30).fold("a".to_owned(), |inner, _| format!(r"\max({inner}, b)"));
        refuse(&[(&nested, "two to four")]);
    }
}
