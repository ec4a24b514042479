//! The same work on each of several values, on every core.

use rayon::prelude::*;
use stop::Token;

/// What `work` gives for each of `values`, in their order, whatever the number of threads.
pub(crate) fn each<V: Sync, R: Send>(values: &[V], work: impl Fn(&V) -> R + Sync + Send) -> Vec<R> {
    let token = Token::current();
    let work = |value| token.during(|| work(value));
    values.par_iter().map(work).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_results_are_in_the_order_of_the_values() {
        let values: Vec<u64> = (0..1000).collect();
        let squares: Vec<u64> = values.iter().map(|value| value * value).collect();
        assert_eq!(each(&values, |value| value * value), squares);
    }
}
