//! Sine and cosine of all values of a lane side by side, with the bits of `libm`.
//!
//! That takes n, the nearest multiple of π/2, off the argument in two parts (Cody and Waite), and sums polynomials of the rest y₀ + y₁
//! between −π/4 and π/4 (those of FreeBSD's msun: the same constants in the same order of operations). Left to it are arguments beyond
//! 2²⁰ π/2, those so near to a multiple of π/2 that two parts are too few, and what is no number.

use crate::{Lane, Shared};

/// 1.5 · 2⁵²: added and taken off, it leaves the nearest whole number.
const TO_WHOLE: f64 = 6_755_399_441_055_744.0;
/// 2/π.
const PER_QUARTER: f64 = f64::from_bits(0x3FE4_5F30_6DC9_C883);
/// The first 33 bits of π/2, and the rest of it.
const QUARTER: f64 = f64::from_bits(0x3FF9_21FB_5440_0000);
const QUARTER_REST: f64 = f64::from_bits(0x3DD0_B461_1A62_6331);

/// Below the first nothing is taken off, below each of the others one more π/2: their high words decide. Beyond the last it is the
/// nearest multiple.
const ENDS: [f64; 5] = [
    f64::from_bits(0x3FE9_21FC_0000_0000),
    f64::from_bits(0x4002_D97D_0000_0000),
    f64::from_bits(0x400F_6A7B_0000_0000),
    f64::from_bits(0x4015_FDBD_0000_0000),
    f64::from_bits(0x401C_463C_0000_0000),
];
/// From here on two parts of π/2 are too few.
const FAR: f64 = f64::from_bits(0x4139_21FB_0000_0000);
/// So much smaller than its argument a rest has too few digits: 2⁻¹⁶.
const CANCELLED: f64 = 1.0 / 65536.0;
/// Below it sin x = x: 2⁻²⁶.
const TINY: f64 = 1.0 / 67_108_864.0;

const S: [f64; 6] = [
    f64::from_bits(0xBFC5_5555_5555_5549),
    f64::from_bits(0x3F81_1111_1110_F8A6),
    f64::from_bits(0xBF2A_01A0_19C1_61D5),
    f64::from_bits(0x3EC7_1DE3_57B1_FE7D),
    f64::from_bits(0xBE5A_E5E6_8A2B_9CEB),
    f64::from_bits(0x3DE5_D93A_5ACF_D57C),
];
const C: [f64; 6] = [
    f64::from_bits(0x3FA5_5555_5555_554C),
    f64::from_bits(0xBF56_C16C_16C1_5177),
    f64::from_bits(0x3EFA_01A0_19CB_1590),
    f64::from_bits(0xBE92_7E4F_809C_52AD),
    f64::from_bits(0x3E21_EE9E_BDB4_B1C4),
    f64::from_bits(0xBDA8_FAE9_BE88_38D4),
];

/// The sine of a lane, and where that is left to `libm`.
pub(crate) struct Sine<L>(pub(crate) L);

/// The cosine of a lane, and where that is left to `libm`.
pub(crate) struct Cosine<L>(pub(crate) L);

impl<L: Lane> Shared<L> for Sine<L> {
    type Output = (L, L::Mask);

    #[inline(always)]
    fn run(self) -> Self::Output {
        let (size, zero) = (self.0.abs(), L::splat(0.0));
        let own = Reduced::of(size);
        let [odd, negative] = [own.is(1.0, 3.0), L::splat(1.5).lt(own.quarter)];
        let value = L::select(odd, own.cos(), own.sin());
        let value = L::select(negative, -value, value);
        let value = L::select(self.0.lt(zero), -value, value);
        (L::select(size.lt(L::splat(TINY)), self.0, value), own.left)
    }
}

impl<L: Lane> Shared<L> for Cosine<L> {
    type Output = (L, L::Mask);

    #[inline(always)]
    fn run(self) -> Self::Output {
        let own = Reduced::of(self.0.abs());
        let [odd, negative] = [own.is(1.0, 3.0), own.is(1.0, 2.0)];
        let value = L::select(odd, own.sin(), own.cos());
        (L::select(negative, -value, value), own.left)
    }
}

/// An argument of zero or more without a multiple of π/2.
struct Reduced<L: Lane> {
    y: [L; 2],
    /// Whether nothing was taken off.
    whole: L::Mask,
    /// The multiple by 4: 0, 1, 2 or 3.
    quarter: L,
    left: L::Mask,
}

impl<L: Lane> Reduced<L> {
    #[inline(always)]
    fn of(size: L) -> Self {
        // Without closures, which would be compiled for other instructions than those of the lane.
        let mut n = (size * PER_QUARTER + TO_WHOLE) - TO_WHOLE;
        let mut k = ENDS.len();
        while k > 1 {
            k -= 1;
            n = L::select(size.lt(L::splat(ENDS[k])), L::splat(k as f64), n);
        }
        let whole = size.lt(L::splat(ENDS[0]));
        let rest = size - n * QUARTER;
        let off = n * QUARTER_REST;
        let first = rest - off;
        let second = (rest - first) - off;
        let too_few = first.abs().lt(size * CANCELLED);
        let near = L::and(too_few, L::not(whole));
        let far = L::not(size.lt(L::splat(FAR)));
        let zero = L::splat(0.0);
        let quarter = n - ((n * 0.25 - 0.375 + TO_WHOLE) - TO_WHOLE) * 4.0;
        Reduced {
            y: [L::select(whole, size, first), L::select(whole, zero, second)],
            whole,
            quarter: L::select(whole, zero, quarter),
            left: L::or(near, far),
        }
    }

    /// Whether the multiple is one of two.
    #[inline(always)]
    fn is(&self, a: f64, b: f64) -> L::Mask {
        let [from_a, from_b] = [(self.quarter - a).abs(), (self.quarter - b).abs()];
        L::or(from_a.lt(L::splat(0.5)), from_b.lt(L::splat(0.5)))
    }

    #[inline(always)]
    fn sin(&self) -> L {
        let [x, y] = self.y;
        let z = x * x;
        let w = z * z;
        let r = (z * (z * S[3] + S[2]) + S[1]) + z * w * (z * S[5] + S[4]);
        let v = z * x;
        let alone = x + v * (z * r + S[0]);
        let both = x - ((z * (y * 0.5 - v * r) - y) - v * S[0]);
        L::select(self.whole, alone, both)
    }

    #[inline(always)]
    fn cos(&self) -> L {
        let [x, y] = self.y;
        let z = x * x;
        let w = z * z;
        let r = z * (z * (z * C[2] + C[1]) + C[0]) + w * w * (z * (z * C[5] + C[4]) + C[3]);
        let half = z * 0.5;
        let one = L::splat(1.0);
        let w = one - half;
        w + (((one - w) - half) + (z * r - x * y))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::register::Register;
    use crate::registers::{Registers, Task};

    /// Sines, then cosines, of as many values as fill whole registers.
    struct Both<'a>(&'a [f64]);

    impl Task for Both<'_> {
        type Output = Vec<[f64; 2]>;

        #[inline(always)]
        fn run<L: Register>(self) -> Self::Output {
            let mut all = Vec::new();
            for own in L::chunks(self.0) {
                let own = L::load(own);
                let mut rows = vec![[0.0; 2]; L::WIDTH];
                L::scatter(&[own.sin(), own.cos()], rows.as_flattened_mut());
                all.extend(rows);
            }
            all
        }
    }

    /// Of every size that a number has, at and beside the ends of every way of reduction, and beside multiples of π/2.
    fn arguments() -> Vec<f64> {
        let mut all =
            vec![0.0, f64::INFINITY, f64::NAN, f64::MIN_POSITIVE, 5e-324, 1e300, f64::MAX];
        let beside =
            |at: f64| (-3..4).map(move |k| f64::from_bits(at.to_bits().wrapping_add_signed(k)));
        for end in ENDS.into_iter().chain([FAR, TINY, 0.5_f64.powi(27) * 2_f64.sqrt(), 1.0]) {
            all.extend(beside(end));
        }
        for k in 1..2000 {
            all.extend(beside(f64::from(k) * FRAC_PI_2));
            all.extend([1e-4, 1e-5, 1e-6].map(|off| f64::from(k) * FRAC_PI_2 * (1.0 + off)));
        }
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        all.extend((0..200_000).map(|_| 12.0 * random()));
        all.extend((0..200_000).map(|_| 10_f64.powf(40.0 * random() - 30.0)));
        let other: Vec<f64> = all.iter().map(|own| -own).collect();
        all.extend(other);
        all.resize(all.len().next_multiple_of(8), 1.0);
        all
    }

    #[test]
    fn sines_side_by_side_have_the_bits_of_those_one_by_one() {
        let all = arguments();
        for registers in Registers::all() {
            let found = registers.run(Both(&all));
            assert_eq!(found.len(), all.len());
            for (own, found) in all.iter().zip(found) {
                for (known, found) in [libm::sin(*own), libm::cos(*own)].into_iter().zip(found) {
                    let same =
                        known.to_bits() == found.to_bits() || known.is_nan() && found.is_nan();
                    assert!(same, "{}: {found} for {known} at {own:e}", registers.name());
                }
            }
        }
    }
}
