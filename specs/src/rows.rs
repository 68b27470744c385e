//! Arrays of rows, one row a variable and one value a spring in each.

use std::array::from_fn;
use std::marker::PhantomData;

use crate::Lane;
use crate::registers::{Register, Registers, Task};

/// What is computed for one spring, over any lane type and without fused operations.
pub trait SpringKernel<const INPUTS: usize, const OUTPUTS: usize> {
    /// Whether all of it is computed side by side: a register that is not full takes no longer than a spring then.
    const SIDE_BY_SIDE: bool = true;

    /// Outputs of one lane of springs. To be `#[inline(always)]`.
    fn spring<L: Lane>(inputs: [L; INPUTS]) -> [L; OUTPUTS];
}

/// The same for any numbers in the places of those of a spec.
pub trait SkeletonKernel<const INPUTS: usize, const NUMBERS: usize, const OUTPUTS: usize> {
    /// As [`SpringKernel::SIDE_BY_SIDE`].
    const SIDE_BY_SIDE: bool = true;

    /// Outputs of one lane of springs. To be `#[inline(always)]`.
    fn spring<L: Lane>(inputs: [L; INPUTS], numbers: [L; NUMBERS]) -> [L; OUTPUTS];
}

/// A kernel that has its numbers is one that takes none.
impl<K: SpringKernel<I, O>, const I: usize, const O: usize> SkeletonKernel<I, 0, O> for K {
    const SIDE_BY_SIDE: bool = K::SIDE_BY_SIDE;

    #[inline(always)]
    fn spring<L: Lane>(inputs: [L; I], _: [L; 0]) -> [L; O] {
        K::spring(inputs)
    }
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
    each_spring_with::<K, I, 0, O>(springs, &[], inputs, outputs);
}

/// The same with as many numbers as the kernel takes.
///
/// # Panics
/// If there are fewer values than that, or another number of numbers.
pub fn each_spring_with<
    K: SkeletonKernel<I, N, O>,
    const I: usize,
    const N: usize,
    const O: usize,
>(
    springs: usize,
    numbers: &[f64],
    inputs: &[f64],
    outputs: &mut [f64],
) {
    let numbers: &[f64; N] = numbers.try_into().expect("a number for each place");
    // As divisions: no product can overflow.
    assert!(
        inputs.len() / I.max(1) >= springs && outputs.len() / O.max(1) >= springs,
        "a value a spring and row"
    );
    Registers::current().run(EachSpring::<K, I, N, O> {
        springs,
        numbers,
        inputs,
        outputs,
        kernel: PhantomData,
    });
}

struct EachSpring<'a, K, const I: usize, const N: usize, const O: usize> {
    springs: usize,
    numbers: &'a [f64; N],
    inputs: &'a [f64],
    outputs: &'a mut [f64],
    kernel: PhantomData<K>,
}

impl<K: SkeletonKernel<I, N, O>, const I: usize, const N: usize, const O: usize>
    EachSpring<'_, K, I, N, O>
{
    /// Springs from `first` on one by one: without fused operations the bits are the same. Compiled once,
    /// not for every register.
    #[inline(never)]
    fn rest(self, first: usize) {
        let springs = self.springs;
        for spring in first..springs {
            let mut values = [0.0; I];
            for (i, value) in values.iter_mut().enumerate() {
                *value = self.inputs[i * springs + spring];
            }
            for (o, value) in K::spring(values, *self.numbers).iter().enumerate() {
                self.outputs[o * springs + spring] = *value;
            }
        }
    }
}

impl<K: SkeletonKernel<I, N, O>, const I: usize, const N: usize, const O: usize> Task
    for EachSpring<'_, K, I, N, O>
{
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        const { assert!(size_of::<L::Chunk>() == L::WIDTH * size_of::<f64>() && L::WIDTH <= WIDEST) };
        let springs = self.springs;
        let whole = if L::WIDTH > 1 { springs / L::WIDTH } else { 0 };
        // What is left goes side by side, too, if that is no longer than one by one.
        let left = springs - whole * L::WIDTH;
        let last = L::WIDTH > 1 && K::SIDE_BY_SIDE && left > 1;
        // Slices of every row would cost more to compile than most laws.
        let (from, to) = (self.inputs.as_ptr(), self.outputs.as_mut_ptr());
        let numbers = self.numbers.map(L::splat);
        for k in 0..whole + usize::from(last) {
            let spring = k * L::WIDTH;
            let is_full = k < whole;
            let mut values = [L::splat(0.0); I];
            for (i, value) in values.iter_mut().enumerate() {
                // SAFETY: a row has as many values as there are springs, `each_spring` saw I such rows, and a
                // register from this spring on ends within the row, or as many values as are left.
                let row = unsafe { from.add(i * springs + spring) };
                *value = match is_full {
                    // SAFETY: as above.
                    true => L::load(unsafe { &*row.cast() }),
                    // SAFETY: as above.
                    false => some(unsafe { std::slice::from_raw_parts(row, left) }),
                };
            }
            for (o, value) in K::spring(values, numbers).iter().enumerate() {
                // SAFETY: the same of O rows, which nothing else refers to.
                let row = unsafe { to.add(o * springs + spring) };
                match is_full {
                    // SAFETY: as above.
                    true => value.store(unsafe { &mut *row.cast() }),
                    // SAFETY: as above.
                    false => keep(*value, unsafe { std::slice::from_raw_parts_mut(row, left) }),
                }
            }
        }
        let first = if last { springs } else { whole * L::WIDTH };
        if first < springs {
            self.rest(first);
        }
    }
}

/// The most values of a register.
const WIDEST: usize = 8;

/// Fewer values than a register has, and the first of them in the other places.
#[inline(always)]
fn some<L: Register>(values: &[f64]) -> L {
    let mut all = [values[0]; WIDEST];
    all[..values.len()].copy_from_slice(values);
    L::load(&L::chunks(&all)[0])
}

/// The first values of a register.
#[inline(always)]
fn keep<L: Register>(register: L, values: &mut [f64]) {
    let mut all = [0.0; WIDEST];
    register.store(&mut L::chunks_mut(&mut all)[0]);
    values.copy_from_slice(&all[..values.len()]);
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

/// The first `len` values of each of N rows that stand `stride` apart.
///
/// # Panics
/// If `data` is shorter.
#[inline(always)]
pub fn strided<const N: usize>(len: usize, stride: usize, data: &[f64]) -> [&[f64]; N] {
    from_fn(|row| &data[row * stride..][..len])
}

/// The same, to be written.
///
/// # Panics
/// If `data` is shorter, or if rows overlap.
#[inline(always)]
pub fn strided_mut<const N: usize>(len: usize, stride: usize, data: &mut [f64]) -> [&mut [f64]; N] {
    let mut rest = data;
    from_fn(|row| {
        // Behind the last row nothing need follow.
        let end = if row + 1 == N { len } else { stride };
        let (own, behind) = std::mem::take(&mut rest).split_at_mut(end);
        rest = behind;
        &mut own[..len]
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
