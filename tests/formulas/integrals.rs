//! Definite integrals that depend on an integer, and those that a map of their interval onto itself takes into others.

use vibro_audit::claim::{Sheet, Verdict};
use vibro_audit::prove::{self, Options};
use vibro_audit::tex::Symbols;

/// Returns the verdict of a claim in x, a and b, and integers n and m that are not negative, with the rules that it used.
fn decide(tex: &str) -> (Verdict, String) {
    let symbols =
        "parameters = ['x', 'a', 'b']\nintegers = ['n', 'm', 'k']\nnonnegative = ['n', 'm']\npositive = ['b']";
    let text = format!("[symbols]\n{symbols}\n[[equation]]\nlabel = '1'\nrole = 'claim'\ntex = '''{tex}'''\n");
    let sheet = Sheet::read(&text, &Symbols::default()).unwrap();
    let decision = prove::decide(&sheet, 0, &Options::default());
    (decision.verdict, decision.reductions())
}

#[test]
fn integrals_with_an_integer_follow_by_a_reduction_formula_and_induction() {
    for tex in [
        r"\int_0^{\pi/2} \sin^{2n} x \, dx = \frac{(2n)!}{4^n (n!)^2} \frac{\pi}{2}",
        r"\int_0^{\pi/2} \sin^{2n+1} x \, dx = \frac{4^n (n!)^2}{(2n+1)!}",
        r"\int_0^{\pi/2} \cos^{2n} x \, dx = \binom{2n}{n} \frac{\pi}{2^{2n+1}}",
        r"\int_0^1 x^m (1-x)^n \, dx = \frac{m! n!}{(m+n+1)!}",
        r"\int_0^1 x^n (1-x)^n \, dx = \frac{(n!)^2}{(2n+1)!}",
        r"\int_{-1}^1 (1-x^2)^n \, dx = \frac{2^{2n+1} (n!)^2}{(2n+1)!}",
        r"\int_0^1 \frac{x^n}{\sqrt{1-x}} \, dx = \frac{2^{2n+1} (n!)^2}{(2n+1)!}",
        r"\int_0^1 (\ln x)^n \, dx = (-1)^n n!",
        r"\int_0^1 x^m (\ln x)^n \, dx = \frac{(-1)^n n!}{(m+1)^{n+1}}",
        r"\int_0^\infty \frac{1}{(1+x^2)^{n+1}} \, dx = \frac{\pi \cdot (2n)!}{2^{2n+1} (n!)^2}",
        r"\int_0^\pi \frac{\sin((2n+1) x)}{\sin x} \, dx = \pi",
        r"\int_0^\pi \frac{\sin^2(n x)}{\sin^2 x} \, dx = n \pi",
    ] {
        let (verdict, rules) = decide(tex);
        assert_eq!(verdict, Verdict::Proved, "{tex}");
        assert!(rules.contains("integral: reduction formula"), "{tex}: {rules}");
    }
}

#[test]
fn wrong_integrals_with_an_integer_are_refuted_and_none_without_a_value_is_proved() {
    for tex in [
        r"\int_0^{\pi/2} \sin^{2n} x \, dx = \frac{(2n)!}{4^n (n!)^2} \frac{\pi}{4} (1 + \frac{1}{n+1})",
        r"\int_0^1 x^m (1-x)^n \, dx = \frac{m! n!}{(m+n)!}",
        r"\int_0^1 (\ln x)^n \, dx = n!",
        // right at 0 and 1 alone, and at 0, 1 and 2
        r"\int_0^1 x^n (1-x) \, dx = \frac{3 - n}{6}  \cdot \frac{1}{n+1}",
        r"\int_0^1 (\ln x)^n \, dx = (-1)^n (n! + n(n-1)(n-2))",
        r"\int_0^1 (1-x)^{n-2} x^2 \, dx = n",
        r"\int_0^\pi \frac{\sin(2n x)}{\sin x} \, dx = \pi",
    ] {
        assert_eq!(decide(tex).0, Verdict::Refuted, "{tex}");
    }
    for tex in [
        r"\int_0^1 \frac{x^n}{2x - 1} \, dx = n",
        r"\int_0^1 \frac{(1-x)^n}{x^2} \, dx = n",
        r"\int_0^1 x^{k} (1-x)^2 \, dx = \frac{2}{(k+1)(k+2)(k+3)}",
        r"\int_0^\infty x^n \sin x \, dx = n!",
    ] {
        assert_ne!(decide(tex).0, Verdict::Proved, "{tex}");
    }
}

#[test]
fn integrals_are_folded_by_what_exchanges_their_ends() {
    for tex in [
        r"\int_0^\infty \frac{1}{(x+1)(\ln^2 x + \pi^2)} \, dx = \frac{1}{2}",
        r"\int_{\frac{1}{2}}^{2} \frac{x^8}{x^8-x^6+x^4-x^2+1} \, dx = \frac{3}{2}",
        r"\int_0^\pi \cos(x+\cos x) \, dx = 0",
        r"\int_1^{2011} \frac{\sqrt{x}}{\sqrt{2012-x}+\sqrt{x}} \, dx = 1005",
    ] {
        let (verdict, rules) = decide(tex);
        assert_eq!(verdict, Verdict::Proved, "{tex}");
        assert!(rules.contains("integral: reflection"), "{tex}: {rules}");
    }
    // the integral of the sum of the integrand and its image has a value where the integral itself has none
    for tex in [
        r"\int_0^\infty \frac{\ln x}{x} \, dx = 0",
        r"\int_0^1 \frac{1}{1-2x} \, dx = 0",
        r"\int_0^1 \left(\frac{1}{x} - \frac{1}{1-x}\right) dx = 0",
        r"\int_0^\infty \left(1 - \frac{1}{x^2}\right) dx = 0",
        r"\int_{\frac{1}{2}}^{2} \frac{x^8}{x^8-x^6+x^4-x^2+1} \, dx = \frac{5}{3}",
    ] {
        assert_ne!(decide(tex).0, Verdict::Proved, "{tex}");
    }
}

#[test]
fn roots_have_one_spelling_and_logarithms_are_sums_of_others() {
    for tex in [
        r"\int_0^6 \sqrt{6 x - x^2} \, dx = \frac{9 \pi}{2}",
        r"\int_0^1 \sqrt{x (1 - x)} \, dx = \frac{\pi}{8}",
        r"\int_1^e \ln(\sqrt{x}) \, dx = \frac{1}{2}",
    ] {
        assert_eq!(decide(tex).0, Verdict::Proved, "{tex}");
    }
}
