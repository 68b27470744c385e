//! Arrays of rows, one row a variable and one value a spring in each.

use std::array::from_fn;
use std::marker::PhantomData;

use crate::Lane;
use crate::registers::{Register, Registers, Task};

/// What is computed for one spring, over any lane type and without fused operations.
pub trait SpringKernel<const INPUTS: usize, const OUTPUTS: usize> {
    /// Outputs of one lane of springs. To be `#[inline(always)]`.
    fn spring<L: Lane>(inputs: [L; INPUTS]) -> [L; OUTPUTS];
}

/// Evaluates a kernel for all springs, several side by side where the processor can. Rows of `springs`
/// values, one an input and one an output.
///
/// # Panics
/// If there are fewer values than that.
pub fn each_spring<K: SpringKernel<I, O>, const I: usize, const O: usize>(
    springs: usize,
    inputs: &[f64],
    outputs: &mut [f64],
) {
    assert!(
        inputs.len() >= I * springs && outputs.len() >= O * springs,
        "a value a spring and row"
    );
    Registers::current().run(EachSpring { springs, inputs, outputs, kernel: PhantomData::<K> });
}

struct EachSpring<'a, K, const I: usize, const O: usize> {
    springs: usize,
    inputs: &'a [f64],
    outputs: &'a mut [f64],
    kernel: PhantomData<K>,
}

impl<K: SpringKernel<I, O>, const I: usize, const O: usize> EachSpring<'_, K, I, O> {
    /// Whole registers from spring `first` on; gives the spring behind them.
    #[inline(always)]
    fn chunks<L: Register>(&mut self, first: usize) -> usize {
        let springs = self.springs;
        let count = (springs - first) / L::WIDTH;
        const { assert!(size_of::<L::Chunk>() == L::WIDTH * size_of::<f64>()) };
        // Slices of every row would cost more to compile than most laws.
        let (from, to) = (self.inputs.as_ptr(), self.outputs.as_mut_ptr());
        for k in 0..count {
            let spring = first + k * L::WIDTH;
            let mut values = [L::splat(0.0); I];
            for (i, value) in values.iter_mut().enumerate() {
                // SAFETY: a row has as many values as there are springs, `each_spring` saw I such rows, and a
                // register from this spring on ends within the row.
                *value = L::load(unsafe { &*from.add(i * springs + spring).cast() });
            }
            let values = K::spring(values);
            for (o, value) in values.iter().enumerate() {
                // SAFETY: the same of O rows, which nothing else refers to.
                value.store(unsafe { &mut *to.add(o * springs + spring).cast() });
            }
        }
        first + count * L::WIDTH
    }

    /// Springs from `first` on one by one: without fused operations the bits are the same. Compiled once,
    /// not for every register.
    #[inline(never)]
    fn rest(&mut self, first: usize) {
        self.chunks::<f64>(first);
    }
}

impl<K: SpringKernel<I, O>, const I: usize, const O: usize> Task for EachSpring<'_, K, I, O> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(mut self) {
        let first = if L::WIDTH == 1 { 0 } else { self.chunks::<L>(0) };
        if first < self.springs {
            self.rest(first);
        }
    }
}

/// The first N rows of `len` values.
///
/// # Panics
/// If `data` is shorter.
#[inline(always)]
pub fn rows<const N: usize>(len: usize, data: &[f64]) -> [&[f64]; N] {
    let mut rest = data;
    from_fn(|_| {
        let (row, behind) = rest.split_at(len);
        rest = behind;
        row
    })
}

/// The first N rows of `len` values, to be written.
///
/// # Panics
/// If `data` is shorter.
#[inline(always)]
pub fn rows_mut<const N: usize>(len: usize, data: &mut [f64]) -> [&mut [f64]; N] {
    let mut rest = data;
    from_fn(|_| {
        let (row, behind) = std::mem::take(&mut rest).split_at_mut(len);
        rest = behind;
        row
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_follow_each_other() {
        let mut data = [1.0, 2.0, 3.0, 4.0, 5.0];
        let [a, b] = rows(2, &data);
        assert_eq!((a, b), (&[1.0, 2.0][..], &[3.0, 4.0][..]));
        let [_, b] = rows_mut(2, &mut data);
        b[1] = 9.0;
        assert_eq!(data[3], 9.0);
    }
}
