//! The same work on each of several values: on every core with the feature `parallel`, else one after the other.

use crate::stop::Token;
#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// What `work` gives for each of `values`, in their order, whatever the number of threads.
///
/// The bounds are those of threads on either path, so that what compiles does not depend on the feature.
pub(crate) fn each<V: Sync, R: Send>(values: &[V], work: impl Fn(&V) -> R + Sync + Send) -> Vec<R> {
    #[cfg(feature = "parallel")]
    let values = values.par_iter();
    #[cfg(not(feature = "parallel"))]
    let values = values.iter();
    let token = Token::current();
    values.map(|value| token.during(|| work(value))).collect()
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
