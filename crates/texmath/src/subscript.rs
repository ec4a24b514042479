//! Subscripts, in one spelling each: equal times must have equal names.

use super::error::Fault;
use super::token::{Bracket, Kind, Token};

/// The text of a subscript, without blanks, braces and fonts.
pub(super) fn subscript_text(content: &[Token<'_>]) -> Result<String, Fault> {
    let mut text = String::new();
    let mut before: Option<Token<'_>> = None;
    for (place, token) in content.iter().enumerate() {
        let scripted = place >= 2 && content.get(place - 2).is_some_and(|token| token.kind == Kind::Sub);
        let nested = before.is_some_and(|before| before.kind == Kind::Sub);
        let fits = match token.kind {
            Kind::Letter | Kind::Word | Kind::Number => {
                !nested || token.text.len() == 1 || token.text.starts_with('\\')
            }
            Kind::Plus | Kind::Minus | Kind::Star | Kind::Comma | Kind::Slash => !nested && token.text != ";",
            Kind::Open(Bracket::Round) | Kind::Close(Bracket::Round) | Kind::Prime => !nested,
            Kind::Infinity | Kind::Extremum => !nested,
            Kind::Sub => !nested && !scripted && before.is_some(),
            _ => false,
        };
        if !fits {
            return Err(Fault::unexpected(token.at, token.text, "a plain subscript"));
        }
        // A command must not run into the letter behind it.
        let letter = plain(token).starts_with(|c: char| c.is_ascii_alphabetic());
        if letter && before.is_some_and(|before| before.text.starts_with('\\')) {
            text.push(' ');
        }
        text.push_str(plain(token));
        before = Some(*token);
    }
    match before {
        Some(last) if last.kind == Kind::Sub => Err(Fault::unexpected(last.at, "_", "a plain subscript")),
        _ => Ok(text),
    }
}

/// The text of a sign as ASCII.
pub(super) fn plain<'a>(token: &Token<'a>) -> &'a str {
    match token.kind {
        Kind::Minus => "-",
        Kind::Star => "*",
        Kind::Slash => "/",
        Kind::Prime => "'",
        Kind::Infinity => "\\infty",
        Kind::Extremum => token.text.trim_start_matches('\\'),
        _ => token.text,
    }
}

/// `1+k` -> `k+1`: in each index the integers come last, added up, so that equal times have equal names.
pub(super) fn canonical(text: &str) -> String {
    let parts: Vec<String> = text.split(',').map(index).collect();
    parts.join(",")
}

fn index(text: &str) -> String {
    ordered(text).unwrap_or_else(|| text.to_owned())
}

fn ordered(text: &str) -> Option<String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "+-\\ ".contains(c);
    if !text.contains(['+', '-']) || !text.chars().all(plain) {
        return None;
    }
    let (mut symbols, mut constant): (Vec<(String, char)>, i64) = (Vec::new(), 0);
    let signed = text.replace('-', "+-");
    for (place, term) in signed.split('+').enumerate() {
        let (sign, body) = match term.strip_prefix('-') {
            Some(body) => ('-', body),
            None => ('+', term),
        };
        match body.parse::<i32>() {
            Ok(value) if sign == '-' => constant -= i64::from(value),
            Ok(value) => constant += i64::from(value),
            Err(_) if body.is_empty() && place == 0 => {}
            Err(_) if body.is_empty() || body.contains('-') => return None,
            Err(_) => symbols.push((body.to_owned(), sign)),
        }
    }
    if symbols.is_empty() {
        return None;
    }
    // Added indices first, so that no minus need lead where it can be helped.
    symbols.sort_by(|a, b| a.1.cmp(&b.1).then_with(|| a.0.cmp(&b.0)));
    let mut out = String::new();
    for (body, sign) in &symbols {
        if *sign == '-' || !out.is_empty() {
            out.push(*sign);
        }
        out.push_str(body);
    }
    if constant != 0 {
        out.push_str(&format!("{constant:+}"));
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::super::spelled::{check, refuse};

    #[test]
    fn subscripts() {
        check(&[
            ("t_{1+k}", "t_{k+1}"),
            ("t_{ k + 1 }", "t_{k+1}"),
            ("t_{-1+k}", "t_{k-1}"),
            ("t_{k+1+1}", "t_{k+2}"),
            ("t_{k+0}", "t_k"),
            ("t_{2-k}", "t_{-k+2}"),
            (r"\lambda_{1, 2}", r"\lambda_{1,2}"),
            (r"r_{\mathrm{B}}", "r_B"),
            (r"r_{\rm B}", "r_B"),
            (r"r_\mathrm{B}", "r_B"),
            (r"U_{\text{in}}", "U_{in}"),
            (r"x_{\phi k}", r"x_{\phi k}"),
            (r"V_{\max}", "V_{max}"),
            (r"V_\min", "V_{min}"),
            (r"x_{\text{max}}", "x_{max}"),
            (r"x_{\max,1}", "x_{max,1}"),
            (r"x_{\rm crit}", "x_{crit}"),
            ("E_{kin}", "E_{kin}"),
            (r"\rho_\infty", r"\rho_\infty"),
            (r"\rho_{\infty}", r"\rho_\infty"),
            (r"\rho_{∞}", r"\rho_\infty"),
            (r"\rho_{\infty k}", r"\rho_{\infty k}"),
            (r"x_\varphi", r"x_\phi"),
            ("t_{k_1}", "t_{k_1}"),
            ("x_1y", "(* x_1 y)"),
        ]);
        refuse(&[
            ("x_12", "write { }"),
            ("x_{}", "`nothing`"),
            ("x_{1,}", "`nothing`"),
            ("x_{(}", "plain subscript"),
            ("x_a_b", "second subscript"),
            ("{x_a}_b", "second subscript"),
            ("x_{a^2}", "plain subscript"),
            ("x_{k_{12}}", "plain subscript"),
            ("x_{k_}", "plain subscript"),
            ("x_{k_1_2}", "plain subscript"),
            ("x_(a)", "a script"),
        ]);
    }
}
