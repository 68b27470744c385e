//! The registers of the processor, and the choice among them when a kernel runs.

use std::cell::Cell;
use std::sync::OnceLock;

pub use crate::register::{Double, Register, Sums, Zeros};
#[cfg(target_arch = "x86_64")]
use crate::x86;

/// Work over registers of any width.
pub trait Task {
    /// What it gives.
    type Output;

    /// Does the work. To be `#[inline(always)]`, like all that it calls over lanes: only then is it compiled
    /// for the instructions of L.
    fn run<L: Register>(self) -> Self::Output;
}

/// Registers that this processor has. A value of this type is the proof that it has them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Registers(Width);

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Width {
    Single,
    #[cfg(test)]
    Traced,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

thread_local! {
    static CHOSEN: Cell<Option<Registers>> = const { Cell::new(None) };
}

impl Registers {
    /// One value at a time.
    pub const SINGLE: Registers = Registers(Width::Single);

    /// One value at a time, and where it comes from.
    #[cfg(test)]
    pub(crate) const TRACED: Registers = Registers(Width::Traced);

    /// All that this processor has, narrow to wide.
    pub fn all() -> Vec<Registers> {
        let mut all = vec![Registers::SINGLE];
        all.extend(wide().into_iter().filter(|(_, here)| *here).map(|(kind, _)| Registers(kind)));
        all
    }

    /// Names of those that kernels are compiled for and this processor lacks.
    pub fn absent() -> Vec<&'static str> {
        wide().into_iter().filter(|(_, here)| !here).map(|(kind, _)| kind.name()).collect()
    }

    /// Those that kernels use: the widest, unless [`Registers::within`] says otherwise.
    #[inline(never)]
    pub fn current() -> Registers {
        CHOSEN.get().unwrap_or_else(Registers::widest)
    }

    #[inline]
    fn widest() -> Registers {
        static WIDEST: OnceLock<Registers> = OnceLock::new();
        *WIDEST.get_or_init(|| {
            let mut here = wide().into_iter().filter(|(_, here)| *here);
            here.next_back().map_or(Registers::SINGLE, |(kind, _)| Registers(kind))
        })
    }

    /// Does `work` with these registers in all kernels that this thread calls meanwhile, so that results on
    /// different registers can be compared.
    pub fn within<T>(self, work: impl FnOnce() -> T) -> T {
        /// Puts back what was chosen before, also when the work panics.
        struct Before(Option<Registers>);
        impl Drop for Before {
            fn drop(&mut self) {
                CHOSEN.set(self.0);
            }
        }
        let _before = Before(CHOSEN.replace(Some(self)));
        work()
    }

    /// Values side by side.
    pub fn width(self) -> usize {
        match self.0 {
            Width::Single => 1,
            #[cfg(test)]
            Width::Traced => 1,
            #[cfg(target_arch = "x86_64")]
            Width::Avx2 => 4,
            #[cfg(target_arch = "x86_64")]
            Width::Avx512 => 8,
        }
    }

    /// Name for people.
    pub fn name(self) -> &'static str {
        self.0.name()
    }

    /// Does a task over these registers.
    #[inline(always)]
    pub fn run<T: Task>(self, task: T) -> T::Output {
        match self.0 {
            Width::Single => task.run::<f64>(),
            #[cfg(test)]
            Width::Traced => task.run::<crate::traced::Traced>(),
            // SAFETY: a value of this kind is made only where the processor has the instructions.
            #[cfg(target_arch = "x86_64")]
            Width::Avx2 => unsafe { avx2(task) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Width::Avx512 => unsafe { avx512(task) },
        }
    }
}

impl Width {
    fn name(self) -> &'static str {
        match self {
            Width::Single => "one value at a time",
            #[cfg(test)]
            Width::Traced => "where values come from",
            #[cfg(target_arch = "x86_64")]
            Width::Avx2 => "AVX2 with FMA",
            #[cfg(target_arch = "x86_64")]
            Width::Avx512 => "AVX-512",
        }
    }
}

/// Registers wider than one value, and whether this processor has them, narrow to wide.
#[cfg(target_arch = "x86_64")]
fn wide() -> [(Width, bool); 2] {
    [(Width::Avx2, has_avx2()), (Width::Avx512, has_avx512())]
}

#[cfg(not(target_arch = "x86_64"))]
fn wide() -> [(Width, bool); 0] {
    []
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f") && has_avx2()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2<T: Task>(task: T) -> T::Output {
    task.run::<x86::F64x4>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx2,fma")]
fn avx512<T: Task>(task: T) -> T::Output {
    task.run::<x86::F64x8>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Lane;
    use crate::lane::{FUNCTIONS, each_function};

    /// Values that expose a wrong order of lanes, signed zeros and what is not a number.
    fn numbers(count: usize) -> Vec<f64> {
        let special = [0.0, -0.0, f64::INFINITY, f64::NAN, 1e-310, -2.5];
        let number = |i: usize| match i % 13 {
            6 => special[i / 13 % special.len()],
            _ => (1.7 * i as f64 + 0.3).sin() * 3.0,
        };
        (0..count).map(number).collect()
    }

    /// Every operation of a lane, over rows.
    struct Everything<'a>(&'a [f64], &'a [f64]);

    macro_rules! values {
        ($($about:literal, $name:ident = $value:path;)*) => {
            fn functions<L: Lane>(a: L) -> [L; FUNCTIONS.len()] {
                [$(Lane::$name(a)),*]
            }
        };
    }
    each_function!(values);

    const OPERATORS: usize = 17;
    const RESULTS: usize = OPERATORS + FUNCTIONS.len();

    impl Task for Everything<'_> {
        type Output = Vec<[f64; RESULTS]>;

        #[inline(always)]
        fn run<L: Register>(self) -> Self::Output {
            let mut all = Vec::new();
            for (a, b) in L::chunks(self.0).iter().zip(L::chunks(self.1)) {
                let (a, b) = (L::load(a), L::load(b));
                let (less, at_most) = (L::lt(a, b), L::le(a, b));
                let truth = |mask| L::select(mask, L::splat(1.0), L::splat(0.0));
                let operators: [L; OPERATORS] = [
                    a + b,
                    a - b,
                    a * b,
                    a / b,
                    -a,
                    a + 0.3,
                    a - 0.3,
                    a * 0.3,
                    a / 0.3,
                    L::splat(0.3),
                    Lane::sqrt(a),
                    Lane::abs(a),
                    Lane::powf(a, b),
                    truth(L::and(less, L::lt(a, L::splat(0.5)))),
                    truth(L::or(less, L::lt(a, L::splat(0.5)))),
                    truth(L::not(at_most)),
                    L::select(at_most, a, b),
                ];
                let functions = functions(a);
                let results: [L; RESULTS] = std::array::from_fn(|place| {
                    operators.get(place).copied().unwrap_or_else(|| functions[place - OPERATORS])
                });
                let mut rows = vec![[0.0; RESULTS]; L::WIDTH];
                L::scatter(&results, rows.as_flattened_mut());
                all.extend(rows);
            }
            all
        }
    }

    #[test]
    fn every_operation_gives_the_same_bits_on_all_registers() {
        let a = numbers(8 * 13);
        let b: Vec<f64> = a.iter().rev().copied().collect();
        let single = Registers::SINGLE.run(Everything(&a, &b));
        assert_eq!(single.len(), a.len());
        for registers in Registers::all() {
            let found = registers.run(Everything(&a, &b));
            for (place, (found, single)) in found.iter().zip(&single).enumerate() {
                for (result, (found, single)) in found.iter().zip(single).enumerate() {
                    // Which NaN an operation gives is not part of its value.
                    assert!(
                        found.to_bits() == single.to_bits() || found.is_nan() && single.is_nan(),
                        "{}: result {result} of {}, {}: {found} instead of {single}",
                        registers.name(),
                        a[place],
                        b[place]
                    );
                }
            }
        }
    }

    /// a·a + c and −a·a − c, where a·a needs more than 53 bits.
    struct MulAdd;

    impl Task for MulAdd {
        type Output = [f64; 2];

        #[inline(always)]
        fn run<L: Register>(self) -> [f64; 2] {
            let a = L::splat(1.0 + f64::EPSILON);
            let c = L::splat(-1.0 - 2.0 * f64::EPSILON);
            let mut out = vec![0.0; 2 * L::WIDTH];
            L::scatter(&[a.mul_add(a, c), a.neg_mul_add(a, -c)], &mut out);
            [out[2 * L::WIDTH - 2], out[2 * L::WIDTH - 1]]
        }
    }

    #[test]
    fn multiply_add_is_fused_on_wide_registers_only() {
        for registers in Registers::all() {
            // (1 + ε)² = 1 + 2ε + ε².
            let rest = if registers.width() == 1 { 0.0 } else { f64::EPSILON * f64::EPSILON };
            assert_eq!(registers.run(MulAdd), [rest, -rest], "{}", registers.name());
        }
    }

    /// Rows into lanes and back.
    struct Across<'a> {
        rows: &'a [f64],
        columns: usize,
        out: &'a mut [f64],
    }

    impl Task for Across<'_> {
        type Output = ();

        #[inline(always)]
        fn run<L: Register>(self) {
            let mut values = vec![L::splat(0.0); self.columns];
            let size = self.columns * L::WIDTH;
            for (from, to) in self.rows.chunks(size).zip(self.out.chunks_mut(size)) {
                L::gather(from, &mut values);
                // The same to every row: a row in the wrong lane shows.
                for (v, value) in values.iter_mut().enumerate() {
                    *value = *value * 2.0 + v as f64;
                }
                L::scatter(&values, to);
            }
        }
    }

    #[test]
    fn rows_of_any_number_and_length_go_into_lanes_and_back() {
        for registers in Registers::all() {
            for columns in [1, 3, 4, 5, 7, 8, 12, 21] {
                for rows in 1..20 {
                    let given: Vec<f64> = (0..rows * columns).map(|i| i as f64).collect();
                    let mut out = vec![f64::NAN; given.len()];
                    registers.run(Across { rows: &given, columns, out: &mut out });
                    for (i, out) in out.iter().enumerate() {
                        assert_eq!(*out, 2.0 * i as f64 + (i % columns) as f64);
                    }
                }
            }
        }
    }

    #[test]
    fn the_choice_of_registers_ends_with_its_work() {
        let before = Registers::current();
        Registers::SINGLE.within(|| {
            assert_eq!(Registers::current(), Registers::SINGLE);
            before.within(|| assert_eq!(Registers::current(), before));
            assert_eq!(Registers::current(), Registers::SINGLE);
        });
        assert_eq!(Registers::current(), before);
        assert_eq!(Registers::all().last(), Some(&before));
    }
}
