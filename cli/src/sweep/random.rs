//! Numbers that look random and are the same everywhere for the same seed.

/// SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, OOPSLA 2014): a counter that goes on by
/// the golden ratio, mixed by two multiplications.
pub(super) struct Random(u64);

impl Random {
    /// Begins with `seed`.
    pub(super) fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// All 64 bits of the next number.
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number from 0 up to, but not, 1: a multiple of 2⁻⁵³.
    fn fraction(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number below `end`, each as likely as any other to 2⁻⁶⁴ · `end`: the upper word of a product.
    fn below(&mut self, end: usize) -> usize {
        ((u128::from(self.next()) * end as u128) >> 64) as usize
    }

    /// One coordinate of a Latin hypercube: a number in every n-th of the way from 0 to 1, in an order that is drawn.
    pub(super) fn stratified(&mut self, n: usize) -> Vec<f64> {
        let mut strata: Vec<usize> = (0..n).collect();
        for last in (1..n).rev() {
            strata.swap(last, self.below(last + 1));
        }
        strata.into_iter().map(|own| (own as f64 + self.fraction()) / n as f64).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_generator_is_the_published_one() {
        // The first numbers of the authors' program for the seed 1234567.
        let mut random = Random::new(1_234_567);
        let found = [(); 3].map(|()| random.next());
        assert_eq!(
            found,
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]
        );
    }

    #[test]
    fn every_stratum_has_one_number() {
        let mut random = Random::new(3);
        for n in [1, 2, 7, 100] {
            let mut drawn = random.stratified(n);
            assert_eq!(drawn.len(), n);
            drawn.sort_by(f64::total_cmp);
            for (place, share) in drawn.iter().enumerate() {
                assert!(
                    (place as f64..place as f64 + 1.0).contains(&(share * n as f64)),
                    "{share}"
                );
            }
        }
        let all = |seed| Random::new(seed).stratified(20);
        assert_eq!(all(5), all(5));
        assert_ne!(all(5), all(6));
    }
}
