//! Units of the package siunitx, `\kilo\gram\per\cubic\meter`, as powers of ten and of base units.

use std::collections::BTreeMap;

/// Prefixes with their letters, where these are read, and powers of ten.
const PREFIXES: [(&str, &str, i32); 15] = [
    ("femto", "f", -15),
    ("pico", "p", -12),
    ("nano", "n", -9),
    ("micro", "u", -6),
    ("milli", "m", -3),
    ("centi", "c", -2),
    ("deci", "d", -1),
    ("deca", "", 1),
    ("deka", "", 1),
    ("hecto", "h", 2),
    ("kilo", "k", 3),
    ("mega", "M", 6),
    ("giga", "G", 9),
    ("tera", "T", 12),
    ("peta", "", 15),
];

/// The name of a unit, a whole factor, a power of ten, and powers of base units.
type Unit = (&'static str, i32, i32, &'static [(&'static str, i32)]);

/// The units that are known. Degrees Celsius are none: their zero is another.
const UNITS: [Unit; 32] = [
    ("meter", 1, 0, &[("meter", 1)]),
    ("metre", 1, 0, &[("meter", 1)]),
    ("gram", 1, 0, &[("gram", 1)]),
    ("tonne", 1, 6, &[("gram", 1)]),
    ("second", 1, 0, &[("second", 1)]),
    ("minute", 60, 0, &[("second", 1)]),
    ("hour", 3600, 0, &[("second", 1)]),
    ("day", 86400, 0, &[("second", 1)]),
    ("ampere", 1, 0, &[("ampere", 1)]),
    ("kelvin", 1, 0, &[("kelvin", 1)]),
    ("mole", 1, 0, &[("mole", 1)]),
    ("candela", 1, 0, &[("candela", 1)]),
    ("radian", 1, 0, &[]),
    ("percent", 1, -2, &[]),
    ("hertz", 1, 0, &[("second", -1)]),
    ("newton", 1, 3, &[("gram", 1), ("meter", 1), ("second", -2)]),
    ("pascal", 1, 3, &[("gram", 1), ("meter", -1), ("second", -2)]),
    ("bar", 1, 8, &[("gram", 1), ("meter", -1), ("second", -2)]),
    ("joule", 1, 3, &[("gram", 1), ("meter", 2), ("second", -2)]),
    ("watt", 1, 3, &[("gram", 1), ("meter", 2), ("second", -3)]),
    ("coulomb", 1, 0, &[("ampere", 1), ("second", 1)]),
    (
        "volt",
        1,
        3,
        &[("gram", 1), ("meter", 2), ("second", -3), ("ampere", -1)],
    ),
    (
        "ohm",
        1,
        3,
        &[("gram", 1), ("meter", 2), ("second", -3), ("ampere", -2)],
    ),
    (
        "siemens",
        1,
        -3,
        &[("gram", -1), ("meter", -2), ("second", 3), ("ampere", 2)],
    ),
    (
        "farad",
        1,
        -3,
        &[("gram", -1), ("meter", -2), ("second", 4), ("ampere", 2)],
    ),
    (
        "weber",
        1,
        3,
        &[("gram", 1), ("meter", 2), ("second", -2), ("ampere", -1)],
    ),
    ("tesla", 1, 3, &[("gram", 1), ("second", -2), ("ampere", -1)]),
    (
        "henry",
        1,
        3,
        &[("gram", 1), ("meter", 2), ("second", -2), ("ampere", -2)],
    ),
    ("liter", 1, -3, &[("meter", 3)]),
    ("litre", 1, -3, &[("meter", 3)]),
    ("hectare", 1, 4, &[("meter", 2)]),
    ("electronvolt", 1, 0, &[("electronvolt", 1)]),
];

/// Symbols of units: those of `\SI{5}{km/h}`, and of the short names `\kHz` and `\kohm`.
const SYMBOLS: [(&str, &str); 27] = [
    ("m", "meter"),
    ("g", "gram"),
    ("t", "tonne"),
    ("s", "second"),
    ("min", "minute"),
    ("h", "hour"),
    ("d", "day"),
    ("A", "ampere"),
    ("K", "kelvin"),
    ("mol", "mole"),
    ("cd", "candela"),
    ("rad", "radian"),
    ("Hz", "hertz"),
    ("N", "newton"),
    ("Pa", "pascal"),
    ("bar", "bar"),
    ("J", "joule"),
    ("W", "watt"),
    ("C", "coulomb"),
    ("V", "volt"),
    ("ohm", "ohm"),
    ("F", "farad"),
    ("T", "tesla"),
    ("H", "henry"),
    ("L", "liter"),
    ("l", "liter"),
    ("eV", "electronvolt"),
];

/// The largest power of a unit.
const LARGEST: i32 = 20;

/// The signs around a unit, `\per\milli` and `\squared`: the power of ten of its prefix, and its own.
#[derive(Clone, Copy, PartialEq)]
struct Said {
    prefix: i32,
    power: i32,
    is_below: bool,
}

const NOTHING: Said = Said {
    prefix: 0,
    power: 1,
    is_below: false,
};

/// Returns a unit as a product in TeX, `10^{3} \cdot \upsilon_{\mathrm{gram}} \cdot \upsilon_{\mathrm{meter}}^{-3}`; nothing
/// where it is not known.
pub fn unit(text: &str) -> Option<String> {
    let (mut ten, mut powers) = (0, BTreeMap::<&str, i32>::new());
    let mut parts = Vec::new();
    for ((_, whole, own, bases), said) in factors(text)? {
        let power = if said.is_below { -said.power } else { said.power };
        ten += (own + said.prefix) * power;
        if *whole != 1 {
            parts.push(format!("{whole}^{{{power}}}"));
        }
        for (base, exponent) in *bases {
            *powers.entry(base).or_default() += exponent * power;
        }
    }
    powers.retain(|_, power| *power != 0);
    if ten != 0 || (parts.is_empty() && powers.is_empty()) {
        parts.push(format!("10^{{{ten}}}"));
    }
    for (base, power) in powers {
        parts.push(match power {
            1 => format!(r"\upsilon_{{\mathrm{{{base}}}}}"),
            power => format!(r"\upsilon_{{\mathrm{{{base}}}}}^{{{power}}}"),
        });
    }
    Some(parts.join(r" \cdot "))
}

/// Returns the unit of a name or symbol, with the power of ten of its prefix: `kilogram`, `kHz`, `min`.
fn named(name: &str) -> Option<(i32, &'static Unit)> {
    let known = |name: &str| UNITS.iter().find(|(known, ..)| *known == name);
    let symbol = |symbol: &str| {
        SYMBOLS
            .iter()
            .find(|(known, _)| *known == symbol)
            .and_then(|(_, name)| known(name))
    };
    let plain = || Some((0, known(name).or_else(|| symbol(name))?));
    let whole = || {
        let of_prefix = |(prefix, _, power): &(&str, &str, i32)| Some((*power, known(name.strip_prefix(prefix)?)?));
        PREFIXES.iter().find_map(of_prefix)
    };
    let short = || {
        let mut lettered = PREFIXES.iter().filter(|(_, letter, _)| !letter.is_empty());
        lettered.find_map(|(_, letter, power)| Some((*power, symbol(name.strip_prefix(letter)?)?)))
    };
    plain().or_else(whole).or_else(short)
}

/// Returns the units that a unit is the product of, each with what is said of it.
fn factors(text: &str) -> Option<Vec<(&'static Unit, Said)>> {
    let (mut found, mut next, mut rest) = (Vec::<(&Unit, Said)>::new(), NOTHING, text.trim());
    while !rest.is_empty() {
        let (is_command, behind) = match rest.strip_prefix('\\') {
            Some(behind) => (true, behind),
            None => (false, rest),
        };
        let length = behind.bytes().take_while(u8::is_ascii_alphabetic).count();
        let (name, behind) = behind.split_at_checked(length)?;
        rest = behind.trim_start_matches(|c: char| c.is_whitespace() || "~.".contains(c));
        match (is_command, name) {
            (true, "per") => next.is_below = true,
            (true, "square") => next.power = 2,
            (true, "cubic") => next.power = 3,
            (true, "squared") => found.last_mut()?.1.power = 2,
            (true, "cubed") => found.last_mut()?.1.power = 3,
            (true, "cdot") => {}
            (true, "tothe") => found.last_mut()?.1.power = exponent(&mut rest)?,
            (false, "") => {
                let sign = rest.chars().next()?;
                rest = rest.get(sign.len_utf8()..)?;
                match sign {
                    '/' if !found.is_empty() => next.is_below = true,
                    '^' => found.last_mut()?.1.power = exponent(&mut rest)?,
                    _ => return None,
                }
                rest = rest.trim_start_matches(|c: char| c.is_whitespace() || "~.".contains(c));
            }
            (_, name) => match PREFIXES.iter().find(|(known, ..)| is_command && *known == name) {
                Some((.., power)) => next.prefix = *power,
                None => {
                    let (power, unit) = named(name)?;
                    next.prefix += power;
                    found.push((unit, next));
                    next = NOTHING;
                }
            },
        }
    }
    (next == NOTHING && !found.is_empty()).then_some(found)
}

/// Takes an exponent from the front of a text, in braces or a digit.
fn exponent(rest: &mut &str) -> Option<i32> {
    let (digits, behind) = match rest.strip_prefix('{') {
        Some(inside) => inside.split_once('}')?,
        None => rest.split_at_checked(1)?,
    };
    *rest = behind.trim_start();
    let power = digits.trim().parse().ok();
    power.filter(|power| (-LARGEST..=LARGEST).contains(power))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_products_of_base_units() {
        for (text, wanted) in [
            (r"\metre", r"\upsilon_{\mathrm{meter}}"),
            (
                r"\kilo\gram\per\cubic\metre",
                r"10^{3} \cdot \upsilon_{\mathrm{gram}} \cdot \upsilon_{\mathrm{meter}}^{-3}",
            ),
            (r"\centi\meter\squared", r"10^{-4} \cdot \upsilon_{\mathrm{meter}}^{2}"),
            (r"\km", r"10^{3} \cdot \upsilon_{\mathrm{meter}}"),
            (
                r"\kohm",
                r"10^{6} \cdot \upsilon_{\mathrm{ampere}}^{-2} \cdot \upsilon_{\mathrm{gram}} \cdot \upsilon_{\mathrm{meter}}^{2} \cdot \upsilon_{\mathrm{second}}^{-3}",
            ),
            (r"\kilogram", r"10^{3} \cdot \upsilon_{\mathrm{gram}}"),
            (
                "m/s^2",
                r"\upsilon_{\mathrm{meter}} \cdot \upsilon_{\mathrm{second}}^{-2}",
            ),
            (
                "kg.m^{2} s^{-1}",
                r"10^{3} \cdot \upsilon_{\mathrm{gram}} \cdot \upsilon_{\mathrm{meter}}^{2} \cdot \upsilon_{\mathrm{second}}^{-1}",
            ),
            ("mm", r"10^{-3} \cdot \upsilon_{\mathrm{meter}}"),
            ("min", r"60^{1} \cdot \upsilon_{\mathrm{second}}"),
            ("1/s", ""),
            ("/s", ""),
            ("euros", ""),
            (
                r"\kilo\meter\per\hour",
                r"3600^{-1} \cdot 10^{3} \cdot \upsilon_{\mathrm{meter}} \cdot \upsilon_{\mathrm{second}}^{-1}",
            ),
            (
                r"\newton \metre",
                r"10^{3} \cdot \upsilon_{\mathrm{gram}} \cdot \upsilon_{\mathrm{meter}}^{2} \cdot \upsilon_{\mathrm{second}}^{-2}",
            ),
            (r"\per\second\tothe{4}", r"\upsilon_{\mathrm{second}}^{-4}"),
            (r"\radian", "10^{0}"),
            (r"\degreeCelsius", ""),
            (r"\meter\per", ""),
            (r"\tothe{2}", ""),
            (r"\meter\tothe{200000}", ""),
            ("", ""),
        ] {
            assert_eq!(unit(text).unwrap_or_default(), wanted, "{text}");
        }
    }
}
