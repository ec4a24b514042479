//! The reader and the printer of TeX: every formula of the paper, every spelling, and what no input may do.

mod common;

use common::formulas::{PAPER, names};
use vibro_audit::tex::read;

#[test]
fn the_papers_formulas_are_read_as_printed() {
    for (label, count, tex) in PAPER {
        let equations = read(tex, &names()).unwrap_or_else(|error| panic!("({label}) {error}\n{}", error.caret(tex)));
        assert_eq!(equations.len(), *count, "({label})");
        for equation in equations {
            let printed = equation.to_string();
            let again = read(&printed, &names()).unwrap_or_else(|error| panic!("{error}\n{}", error.caret(&printed)));
            assert_eq!(again, [equation], "({label}) {printed}");
        }
    }
}
