//! Names: letters, declared words, accents.

use super::Name;
use super::elementary::Elementary;
use super::error::{Fault, Reason};
use super::reader::Reader;
use super::token::{Kind, Token};

impl<'a> Reader<'a> {
    /// A name with all its scripts, which must not be a power.
    pub(super) fn full_name(&mut self) -> Result<Name, Fault> {
        let mut name = self.bare_name()?;
        let at = self.here();
        match self.scripts(&mut name)? {
            None => Ok(name),
            Some(_) => Err(Fault::unsupported(at, "a power here", "a name alone must stand here")),
        }
    }

    /// A name with its accents, before the scripts that follow; braces around it are dropped.
    pub(super) fn bare_name(&mut self) -> Result<Name, Fault> {
        let Some(token) = self.peek() else {
            return Err(self.instead_of("a name"));
        };
        match token.kind {
            Kind::Letter => Ok(self.run(token)?),
            Kind::Word => {
                self.next += 1;
                self.word(token)
            }
            Kind::Accent => self.accented(token),
            Kind::BraceOpen => {
                self.next += 1;
                self.deepen()?;
                let name = self.full_name()?;
                self.rise();
                self.close_brace(token.at).map(|()| name)
            }
            _ => Err(self.instead_of("a name")),
        }
    }

    fn accented(&mut self, accent: Token<'a>) -> Result<Name, Fault> {
        self.next += 1;
        self.deepen()?;
        let mut name = match self.peek() {
            // TeX takes one letter where there are no braces, whatever word it begins.
            Some(token) if token.kind == Kind::Letter => {
                self.next += 1;
                Name::plain(token.text)
            }
            _ => self.bare_name()?,
        };
        self.rise();
        name.accents.push(accent.text.to_owned());
        Ok(name)
    }

    /// The name at the start of a run of letters: a declared word, or one letter.
    fn run(&mut self, first: Token<'a>) -> Result<Name, Fault> {
        let run = self.letters(true);
        if let Some(word) = self.names.word_at_start(&run).map(str::to_owned) {
            self.next += word.len();
            return Ok(Name::plain(&word));
        }
        if let Some(function) = Elementary::at_start(&run) {
            let instead = "write it with a backslash or a bracket behind it, or its letters apart for a product";
            let found = function.command.trim_start_matches('\\');
            return Err(Fault::ambiguous(first.at, &format!("`{found}`"), instead));
        }
        self.next += 1;
        Ok(Name::plain(first.text))
    }

    /// The Latin letters that stand next; where `close`, only up to the first gap.
    pub(super) fn letters(&self, close: bool) -> String {
        let mut run = String::new();
        let mut end = None;
        // No word is longer; without this bound a long run would be walked once for each of its letters.
        for token in self.tokens.iter().skip(self.next).take(64) {
            let gap = close && end.is_some_and(|end| end != token.at);
            if token.kind != Kind::Letter || token.text.starts_with('\\') || gap {
                break;
            }
            run.push_str(token.text);
            end = Some(token.end);
        }
        run
    }

    fn word(&self, token: Token<'a>) -> Result<Name, Fault> {
        match token.text.len() == 1 || self.names.words.iter().any(|word| word == token.text) {
            true => Ok(Name::plain(token.text)),
            false => {
                let found = format!("`{}`", token.text);
                Err(Fault::new(token.at, Reason::UnknownWord { found }))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};

    #[test]
    fn accents() {
        for tex in [
            r"{\dot Z}_k",
            r"\dot{Z}_k",
            r"\dot Z_k",
            r"\dot{Z_k}",
            r"\dot{Z}_{k}",
            r"\mathbf{\dot Z}_k",
        ] {
            check(&[(tex, r"\dot{Z}_k")]);
        }
        for tex in [r"\bar g", r"\bar{g}", r"\overline{g}", r"\overline g"] {
            check(&[(tex, r"\overline{g}")]);
        }
        check(&[
            (r"\dot{\bar{g}}", r"\dot{\overline{g}}"),
            (r"\varphi \varepsilon", r"(* \phi \epsilon)"),
            (
                r"\ddot{X} \hat F \tilde x \vec v",
                r"(* \ddot{X} \hat{F} \tilde{x} \vec{v})",
            ),
        ]);
        check(&[
            (
                r"\dddot{x} \ddddot x \mathring{x} \check x \breve{x}_1",
                r"(* \dddot{x} \ddddot{x} \mathring{x} \check{x} \breve{x}_1)",
            ),
            (
                r"\mathcal{L} L \mathcal L_1 \mathfrak{g} \mathscr{H} \dot{\mathcal{L}}",
                r"(* \mathcal{L} L \mathcal{L}_1 \mathfrak{g} \mathscr{H} \dot{\mathcal{L}})",
            ),
        ]);
        refuse(&[
            (r"\mathcal{LM}", "found `M` where `}`"),
            (r"\dot{x^2}", "a power here"),
            (r"\dot{2}", "a name"),
            (r"\dot", "a name"),
        ]);
    }

    #[test]
    fn words() {
        check(&[
            ("eta", "eta"),
            ("e t a", "(* e t a)"),
            ("xeta_1y", "(* x eta_1 y)"),
            ("ety", "(* et y)"),
            (r"\mathrm{eta}", "eta"),
        ]);
        refuse(&[
            (r"\mathrm{abc}", "no declared name"),
            ("-gsin b", "a bracket behind it"),
            (r"cos\theta", "a bracket behind it"),
        ]);
    }
}
