//! Circles among things that use each other.

/// The first of those that use each other in a circle, where `uses` lists what each uses.
pub(super) fn circle(uses: &[Vec<usize>]) -> Option<usize> {
    ordered(uses).err()
}

/// Orders things so that each comes after those that it uses.
///
/// # Errors
/// The first of those that use each other in a circle.
pub(super) fn ordered(uses: &[Vec<usize>]) -> Result<Vec<usize>, usize> {
    let mut order = Vec::new();
    let mut users = vec![Vec::new(); uses.len()];
    let mut waits: Vec<usize> = uses.iter().map(Vec::len).collect();
    for (user, list) in uses.iter().enumerate() {
        for &used in list {
            if let Some(users) = users.get_mut(used) {
                users.push(user);
            }
        }
    }
    // What uses nothing that is left is taken away, until circles are left and what uses them.
    let mut free: Vec<usize> = (0..uses.len()).filter(|&n| waits.get(n) == Some(&0)).collect();
    while let Some(done) = free.pop() {
        order.push(done);
        for &user in users.get(done).into_iter().flatten() {
            if let Some(count) = waits.get_mut(user) {
                *count -= 1;
                if *count == 0 {
                    free.push(user);
                }
            }
        }
    }
    let left = |n: usize| waits.get(n).is_some_and(|&count| count > 0);
    let next = |n: usize| {
        uses.get(n)
            .and_then(|list| list.iter().copied().find(|&used| left(used)))
    };
    let Some(mut at) = (0..uses.len()).find(|&n| left(n)) else {
        return Ok(order);
    };
    // As many steps as there are things end on a circle; once around it gives its first.
    for _ in 0..uses.len() {
        at = next(at).unwrap_or(at);
    }
    let start = at;
    let mut first = start;
    while let Some(following) = next(at).filter(|&following| following != start) {
        first = first.min(following);
        at = following;
    }
    Err(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_a_circle_is_found() {
        assert_eq!(circle(&[vec![1], vec![2], vec![]]), None);
        assert_eq!(circle(&[vec![0]]), Some(0));
        assert_eq!(circle(&[vec![1], vec![2, 3], vec![], vec![1]]), Some(1));
        assert_eq!(circle(&[vec![], vec![3, 0], vec![1], vec![2]]), Some(1));
        assert_eq!(circle(&[vec![1, 1], vec![]]), None);
        assert_eq!(ordered(&[vec![1], vec![2, 3], vec![], vec![2]]), Ok(vec![2, 3, 1, 0]));
        let long: Vec<Vec<usize>> = (0..20_000).map(|n| vec![(n + 1) % 20_000]).collect();
        assert_eq!(circle(&long), Some(0));
    }
}
