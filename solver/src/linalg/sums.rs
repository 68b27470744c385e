//! Sums in parts: terms that wait for the sum before them take four times as long as those that do not.

use whirl_specs::registers::{Register, Registers, Task};

/// Terms side by side.
const PARTS: usize = 8;

/// Σ term(i), i from 0 to n − 1.
#[inline(always)]
pub(crate) fn sum_of(n: usize, term: impl Fn(usize) -> f64) -> f64 {
    let mut parts = [0.0; PARTS];
    let whole = n - n % PARTS;
    for start in (0..whole).step_by(PARTS) {
        for (k, part) in parts.iter_mut().enumerate() {
            *part += term(start + k);
        }
    }
    for (part, i) in parts.iter_mut().zip(whole..n) {
        *part += term(i);
    }
    together(parts)
}

/// Σ term(a[i], b[i], …) over slices that are as long as the first, on the widest registers.
#[inline(always)]
pub(crate) fn sum_over<const K: usize>(slices: [&[f64]; K], term: impl Fn([f64; K]) -> f64) -> f64 {
    Registers::current().run(SumOver(slices, term))
}

struct SumOver<'a, F, const K: usize>([&'a [f64]; K], F);

impl<F: Fn([f64; K]) -> f64, const K: usize> Task for SumOver<'_, F, K> {
    type Output = f64;

    #[inline(always)]
    fn run<L: Register>(self) -> f64 {
        let n = self.0[0].len();
        // Of one length, so that no bound is checked on the way.
        let slices = self.0.map(|own| &own[..n]);
        sum_of(n, |i| self.1(slices.map(|own| own[i])))
    }
}

/// The sum of all, in pairs: few wait for one before them.
#[inline(always)]
fn together([a, b, c, d, e, f, g, h]: [f64; PARTS]) -> f64 {
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

/// The largest |term(i)| and Σ |term(i)|, i from 0 to n − 1. A term that is no number makes the sum none; it is
/// never the largest.
#[inline(always)]
pub(crate) fn largest_and_sum(n: usize, term: impl Fn(usize) -> f64) -> (f64, f64) {
    let (mut largest, mut parts) = ([0.0; PARTS], [0.0; PARTS]);
    let whole = n - n % PARTS;
    for start in (0..whole).step_by(PARTS) {
        let sizes: [f64; PARTS] = std::array::from_fn(|k| term(start + k).abs());
        for k in 0..PARTS {
            parts[k] += sizes[k];
            largest[k] = if sizes[k] > largest[k] { sizes[k] } else { largest[k] };
        }
    }
    for i in whole..n {
        let size = term(i).abs();
        parts[i - whole] += size;
        largest[i - whole] = if size > largest[i - whole] { size } else { largest[i - whole] };
    }
    (largest.into_iter().fold(0.0, f64::max), together(parts))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_any_length_take_every_term_once() {
        for n in [0, 1, 7, 8, 9, 16, 29] {
            // Powers of two: a sum shows which terms it has.
            let term =
                |i: usize| (1_u64 << i) as f64 * if i.is_multiple_of(3) { -1.0 } else { 1.0 };
            assert_eq!(sum_of(n, term), (0..n).map(term).sum::<f64>());
            let sizes = || (0..n).map(|i| term(i).abs());
            let expected = (sizes().fold(0.0, f64::max), sizes().sum());
            assert_eq!(largest_and_sum(n, term), expected);
        }
    }

    #[test]
    fn what_is_no_number_makes_the_sum_none() {
        for place in 0..11 {
            let (largest, sum) = largest_and_sum(11, |i| if i == place { f64::NAN } else { -2.0 });
            assert!(largest == 2.0 && sum.is_nan(), "{place}");
        }
    }
}
