//! The parts of a formula that are a matter of print: bold by LaTeX 2.09, the imaginary unit in bold or sans serif, assignments.

use super::macros::Macros;
use super::members::j_is_unit;
use super::tex::{BRACES, command, group, words};

/// Fonts other than upright in which authors print the imaginary unit.
const FONTS: [&str; 4] = [r"\mathbf", r"\boldsymbol", r"\bm", r"\mathsf"];

/// The longest formula within the text that may define the unit, in bytes.
const LONGEST: usize = 200;

/// Writes `\mbox{\boldmath$v$}` as `\boldsymbol{v}`, leaves out assignments of TeX that change nothing printed, and writes the
/// imaginary unit and e upright where the text or a formula defines the unit in another font: `\mathbf{i}^2 = -1` or
/// `\mathbf{i} = \sqrt{-1}`.
pub(super) fn read_as_meant(text: &str, macros: &Macros, mut all: Vec<&mut String>) {
    for tex in &mut all {
        if let Some(plain) = without_boldmath(tex) {
            **tex = plain;
        }
        if let Some(plain) = without_assignments(tex) {
            **tex = plain;
        }
    }
    let within = text.split('$').filter(|tex| tex.len() < LONGEST && tex.contains("-1"));
    let within: Vec<String> = within.filter_map(|tex| macros.expanded(tex).ok()).collect();
    let printed = || {
        within
            .iter()
            .map(String::as_str)
            .chain(all.iter().map(|tex| tex.as_str()))
    };
    // of quaternions i is but one of three
    let is_one_of_three = |font: &str| {
        let others = [format!("{font}{{j}}"), format!("{font}{{k}}")];
        printed().any(|tex| others.iter().any(|other| tex.contains(other)))
    };
    let is_unit = |font: &&&str| printed().any(|tex| defines_unit(tex, font)) && !is_one_of_three(font);
    if let Some(font) = FONTS.iter().find(is_unit).copied() {
        for tex in all {
            upright(tex, font);
        }
        return;
    }
    // engineers call it j, as i is a current
    let prints_i = || {
        all.iter()
            .any(|tex| letters_at(tex, 'i').next().is_some() || tex.contains(r"\mathrm{i}"))
    };
    if j_is_unit(all.iter().map(|tex| tex.as_str())) && !prints_i() {
        for tex in all {
            let mut plain = tex.replace(r"\mathrm{j}", "j");
            let places: Vec<usize> = letters_at(&plain, 'j').collect();
            for at in places.into_iter().rev() {
                plain.replace_range(at..=at, r"\mathrm{i}");
            }
            *tex = plain;
        }
    }
}

/// Returns the places at which a letter stands in a formula, and in no command or word in braces.
fn letters_at(tex: &str, letter: char) -> impl Iterator<Item = usize> {
    let is_letter = move |at: usize| {
        let (front, rest) = (tex.get(..at).unwrap_or_default(), tex.get(at + 1..).unwrap_or_default());
        let front = front.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let behind = rest.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let is_alone = front.len() == at && behind.len() == rest.len();
        let is_word = !is_alone && front.ends_with('{') && behind.starts_with('}');
        !front.ends_with('\\') && !is_word
    };
    tex.match_indices(letter)
        .map(|(at, _)| at)
        .filter(move |at| is_letter(*at))
}

fn defines_unit(tex: &str, font: &str) -> bool {
    if !tex.contains(font) {
        return false;
    }
    let compact = tex.replace(r"\mkern1mu", "").replace([' ', '\n'], "");
    let unit = format!("{font}{{i}}");
    ["^2=-1", "^{2}=-1", r"=\sqrt{-1}"]
        .iter()
        .any(|value| compact.contains(&format!("{unit}{value}")) || compact.contains(&format!("{{{unit}}}{value}")))
}

/// Writes i upright, and e where it is but the base of powers.
fn upright(tex: &mut String, font: &str) {
    *tex = tex.replace(&format!("{font}{{i}}"), r"\mathrm{i}");
    let e = format!("{font}{{e}}");
    let is_base = |(at, _): (usize, &str)| {
        tex.get(at + e.len()..)
            .is_some_and(|rest| rest.trim_start().starts_with('^'))
    };
    if tex.match_indices(&e).all(is_base) {
        *tex = tex.replace(&e, r"\mathrm{e}");
    }
}

/// `\mbox{\boldmath$v$}` as `\boldsymbol{v}`; nothing where none is left.
fn without_boldmath(tex: &str) -> Option<String> {
    const START: &str = r"\mbox{\boldmath$";
    let mut found = String::new();
    let mut rest = tex;
    while let Some((before, behind)) = rest.split_once(START) {
        let (inside, after) = behind.split_once("$}")?;
        let inside = inside.trim().trim_start_matches(r"\displaystyle").trim();
        found.extend([before, r"\boldsymbol{", inside, "}"]);
        rest = after;
    }
    (!found.is_empty()).then(|| found + rest)
}

/// A formula without `\let\a\b` and `\renewcommand\a{...}` of commands that it does not print; nothing where it has none.
fn without_assignments(tex: &str) -> Option<String> {
    const ASSIGNING: [&str; 2] = [r"\let", r"\renewcommand"];
    let (mut found, mut assigned, mut at) = (String::new(), Vec::new(), 0);
    for (word, end) in words(tex) {
        let start = end - word.len() - 1;
        let sign = tex.get(start..end)?;
        if start < at || !ASSIGNING.contains(&sign) {
            continue;
        }
        let behind = |at: usize| tex.get(at..)?.starts_with('\\').then(|| command(tex, at).1);
        let name_end = behind(end)?;
        let close = match sign {
            r"\let" => behind(name_end)?,
            _ => group(tex, name_end, BRACES)?.end + 1,
        };
        assigned.push(tex.get(end..name_end)?);
        found.push_str(tex.get(at..start)?);
        at = close;
    }
    found.push_str(tex.get(at..)?);
    (at > 0 && !assigned.iter().any(|name| found.contains(name))).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_assignment_prints_nothing_unless_its_command_does() {
        let tex = r"a - \let\Old\Color\renewcommand\Color{}{a b}\renewcommand\Color{\Old} = c";
        assert_eq!(without_assignments(tex).as_deref(), Some("a - {a b} = c"));
        assert_eq!(without_assignments(r"\let\a\b \a = 1"), None);
        assert_eq!(without_assignments("a = b"), None);
    }

    #[test]
    fn bold_of_latex_209_is_bold() {
        let old = r"a\mbox{\boldmath$\displaystyle v$}=2\mbox{\boldmath$w$}";
        assert_eq!(
            without_boldmath(old).as_deref(),
            Some(r"a\boldsymbol{v}=2\boldsymbol{w}")
        );
        assert_eq!(without_boldmath(r"\boldsymbol{v}"), None);
        assert_eq!(without_boldmath(r"\mbox{\boldmath$v"), None);
    }

    #[test]
    fn a_letter_stands_in_no_command_and_no_word() {
        let at = |tex: &str| letters_at(tex, 'j').collect::<Vec<_>>();
        assert_eq!(at(r"e^{j\omega t} + 2j"), [3, 17]);
        assert_eq!(at(r"\jmath \mathrm{major} \Join{adj}"), []);
    }

    #[test]
    fn a_letter_is_the_unit_where_its_square_is_minus_one() {
        for tex in [
            r"\mathbf{i}^{2} = -1",
            r"\mathbf{i}\mkern1mu=\sqrt{-1}",
            r"{\mathbf{i}\mkern1mu}^2=-1",
        ] {
            assert!(defines_unit(tex, r"\mathbf"), "{tex}");
        }
        for tex in [
            r"\mathbf{i}^2 = 1",
            r"\mathbf{j} = \sqrt{-1}",
            r"\mathbf{i} \cdot \mathbf{j} = 0",
        ] {
            assert!(!defines_unit(tex, r"\mathbf"), "{tex}");
        }
        let mut tex = r"\mathbf{e}^{\mathbf{i} x} + \mathbf{i}".to_owned();
        upright(&mut tex, r"\mathbf");
        assert_eq!(tex, r"\mathrm{e}^{\mathrm{i} x} + \mathrm{i}");
        let mut tex = r"\mathbf{e}_1 \mathbf{e}^2".to_owned();
        upright(&mut tex, r"\mathbf");
        assert_eq!(tex, r"\mathbf{e}_1 \mathbf{e}^2");
    }
}
