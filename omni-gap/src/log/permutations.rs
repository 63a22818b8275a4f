//! All orders of so many things.

/// Every order of `count` places, the one as it stands first.
pub(crate) fn permutations(count: usize) -> Vec<Vec<usize>> {
    let mut all = vec![vec![]];
    for _ in 0..count {
        let longer = |order: Vec<usize>| {
            let free: Vec<usize> = (0..count).filter(|place| !order.contains(place)).collect();
            free.into_iter().map(move |place| [order.clone(), vec![place]].concat())
        };
        all = all.into_iter().flat_map(longer).collect();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::permutations;

    #[test]
    fn all_orders_are_different_and_the_first_is_as_it_stands() {
        let all = permutations(4);
        assert_eq!((all.len(), &all[0]), (24, &vec![0, 1, 2, 3]));
        assert!((1..24).all(|k| !all[..k].contains(&all[k])));
    }
}
