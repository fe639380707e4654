//! A few of many, to tell whether something is likely to pay.

/// At most `most` different numbers below `count`, the same in every run,
/// spread evenly and without a period that what is counted might have too
/// (multiples of the golden ratio).
pub fn sample(count: usize, most: usize) -> impl Iterator<Item = usize> {
    const STEP: u64 = 0x9e37_79b9_7f4a_7c15;
    (0..count.min(most) as u64).map(move |i| {
        let fraction = u128::from((i + 1).wrapping_mul(STEP));
        ((fraction * count as u128) >> 64) as usize
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_below_the_count_and_everywhere() {
        assert_eq!(sample(0, 9).count(), 0);
        let found: Vec<usize> = sample(1000, 100).collect();
        assert!(found.iter().all(|&number| number < 1000));
        // One in ten: no gap is much longer.
        let mut sorted = found.clone();
        sorted.sort_unstable();
        assert!(sorted.windows(2).all(|pair| pair[0] < pair[1] && pair[1] - pair[0] < 30));
    }
}
