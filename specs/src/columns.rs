//! Products of matrices with one vector over registers: what a time step reads most.
//!
//! No operation is fused and the order of every sum is fixed, so that results do not depend on the width of the machine's
//! registers.

use std::ops::{Add, Mul};

use crate::registers::{Double, Register, Registers, Sums, Task};

/// Columns that are added together: y is read and written once for all of them.
const TOGETHER: usize = 16;
/// Numbers of columns that are read block of rows after block of rows, so few that they stay in the second cache.
const NEAR: usize = 1 << 17;
/// Rows beyond which columns are read to their end, one beside few others.
const LONG: usize = 1024;
/// Columns that are then read beside each other.
const FAR: usize = 8;
/// Registers of rows that are summed at once, of 16 or 32 that processors have.
const REGISTERS: usize = 12;

/// Partial sums of a product of two columns.
const PARTS: usize = 8;
/// Columns that are multiplied by x together.
const BESIDE: usize = 4;

/// A number in double or single precision.
pub trait Number: Copy + Default + PartialEq + Add<Output = Self> + Mul<Output = Self> {
    /// A register of them.
    type Of<L: Register>: Sums<Number = Self>;
}

impl Number for f64 {
    type Of<L: Register> = Double<L>;
}

impl Number for f32 {
    type Of<L: Register> = L::Single;
}

/// y += Σ x_j a_j over pairs (a_j, x_j), to the bits of one column after the other. Columns with x_j = 0 are not read.
///
/// # Panics
/// If a column is shorter than y.
pub fn add_columns<'a, T: Number + 'a>(y: &mut [T], columns: impl Iterator<Item = (&'a [T], T)>) {
    Registers::current().run(AddColumns { y, columns });
}

/// y += Σ x_j a_j over columns a_j that stand one after the other, as [`add_columns`]. Those with x_j = 0 are not read.
///
/// # Panics
/// If there are fewer columns than x has values.
pub fn add_matrix<T: Number>(y: &mut [T], columns: &[T], x: &[T]) {
    if y.len() * x.len() > NEAR {
        return add_large(y, columns, x);
    }
    Registers::current().run(AddMatrix { y, columns, x });
}

/// [`add_matrix`] of what the caches next to the processor do not hold.
#[inline(never)]
fn add_large<T: Number>(y: &mut [T], columns: &[T], x: &[T]) {
    let (n, registers) = (y.len(), Registers::current());
    let columns = &columns[..n * x.len()];
    if n > LONG {
        return registers.run(AddFar { y, columns, x });
    }
    let some = NEAR / n;
    for (columns, x) in columns.chunks(n * some).zip(x.chunks(some)) {
        registers.run(AddMatrix { y, columns, x });
    }
}

/// y_j += a_j·x over columns a_j that stand one after the other, each product in eight partial sums that are added pairwise, or
/// in order where it has fewer terms.
///
/// # Panics
/// If there are fewer columns than y has values.
pub fn add_products(y: &mut [f64], columns: &[f64], x: &[f64]) {
    Registers::current().run(AddProducts { y, columns, x });
}

struct AddMatrix<'a, T> {
    y: &'a mut [T],
    columns: &'a [T],
    x: &'a [T],
}

impl<T: Number> Task for AddMatrix<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let n = self.y.len();
        let columns = self.columns[..n * self.x.len()].chunks_exact(n.max(1));
        add_rows::<T, T::Of<L>>(self.y, columns.zip(self.x.iter().copied()));
    }
}

/// Columns that no cache holds.
struct AddFar<'a, T> {
    y: &'a mut [T],
    columns: &'a [T],
    x: &'a [T],
}

impl<T: Number> Task for AddFar<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        add_far::<T, T::Of<L>>(self.y, self.columns, self.x);
    }
}

struct AddColumns<'y, T, I> {
    y: &'y mut [T],
    columns: I,
}

impl<'a, T: Number + 'a, I: Iterator<Item = (&'a [T], T)>> Task for AddColumns<'_, T, I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let y = self.y;
        let mut some: [(&[T], T); TOGETHER] = [(&[], T::default()); TOGETHER];
        let mut count = 0;
        for column in self.columns {
            some[count] = column;
            count += 1;
            if count == TOGETHER {
                add_rows::<T, T::Of<L>>(y, some.iter().copied());
                count = 0;
            }
        }
        add_rows::<T, T::Of<L>>(y, some[..count].iter().copied());
    }
}

/// y += Σ x_j a_j in blocks of rows that stay in registers; rows that fill none are added with some before them again, to the
/// same bits.
#[inline(always)]
fn add_rows<'a, T: Number + 'a, S: Sums<Number = T>>(
    y: &mut [T],
    columns: impl Iterator<Item = (&'a [T], T)> + Clone,
) {
    let n = y.len();
    if n < S::WIDTH || S::WIDTH == 1 {
        for (column, x) in columns.filter(|(_, x)| *x != T::default()) {
            let column = &column[..n];
            y.iter_mut().zip(column).for_each(|(sum, entry)| *sum = *sum + x * *entry);
        }
        return;
    }
    let last = S::load_from(&y[n - S::WIDTH..]);
    let registers = n.div_ceil(S::WIDTH);
    let blocks = registers.div_ceil(REGISTERS);
    let mut start = 0;
    for block in 0..blocks {
        let count = registers * (block + 1) / blocks - registers * block / blocks;
        let end = start + count * S::WIDTH;
        if end > n {
            last.store_to(&mut y[n - S::WIDTH..]);
        }
        let rows = (start, end.min(n) - S::WIDTH);
        match count {
            1 => add_block::<S, 0>(y, columns.clone(), rows),
            2 => add_block::<S, 1>(y, columns.clone(), rows),
            3 => add_block::<S, 2>(y, columns.clone(), rows),
            4 => add_block::<S, 3>(y, columns.clone(), rows),
            5 => add_block::<S, 4>(y, columns.clone(), rows),
            6 => add_block::<S, 5>(y, columns.clone(), rows),
            7 => add_block::<S, 6>(y, columns.clone(), rows),
            8 => add_block::<S, 7>(y, columns.clone(), rows),
            9 => add_block::<S, 8>(y, columns.clone(), rows),
            10 => add_block::<S, 9>(y, columns.clone(), rows),
            11 => add_block::<S, 10>(y, columns.clone(), rows),
            _ => add_block::<S, { REGISTERS - 1 }>(y, columns.clone(), rows),
        }
        start = end;
    }
}

/// y += Σ x_j a_j of columns that no cache holds: each is read to its end, beside few others.
#[inline(always)]
fn add_far<T: Number, S: Sums<Number = T>>(y: &mut [T], columns: &[T], x: &[T]) {
    let n = y.len();
    for (columns, x) in columns.chunks(FAR * n).zip(x.chunks(FAR)) {
        let is_whole = S::WIDTH > 1 && !x.contains(&T::default());
        let (Some(x), true) = (x.first_chunk::<FAR>(), is_whole) else {
            add_rows::<T, S>(y, columns.chunks_exact(n).zip(x.iter().copied()));
            continue;
        };
        let columns: [&[T]; FAR] = std::array::from_fn(|j| &columns[j * n..(j + 1) * n]);
        let last = S::load_from(&y[n - S::WIDTH..]);
        let whole = n - n % S::WIDTH;
        for row in (0..whole).step_by(S::WIDTH) {
            add_at(S::load_from(&y[row..]), columns, x, row).store_to(&mut y[row..]);
        }
        if whole < n {
            let row = n - S::WIDTH;
            add_at(last, columns, x, row).store_to(&mut y[row..]);
        }
    }
}

/// A register of sums with what columns give from a row on.
#[inline(always)]
fn add_at<T: Number, S: Sums<Number = T>>(
    mut sum: S,
    columns: [&[T]; FAR],
    x: &[T; FAR],
    row: usize,
) -> S {
    for j in 0..FAR {
        sum = sum.plus(x[j], S::load_from(&columns[j][row..]));
    }
    sum
}

/// y += Σ x_j a_j for N registers of rows side by side from the first row on, and one at its own row.
#[inline(always)]
fn add_block<'a, S: Sums, const N: usize>(
    y: &mut [S::Number],
    columns: impl Iterator<Item = (&'a [S::Number], S::Number)>,
    (first, last): (usize, usize),
) where
    S::Number: Number + 'a,
{
    let rows = first..first + N * S::WIDTH;
    let mut sums: [S; N] = std::array::from_fn(|own| S::load_from(&y[first + own * S::WIDTH..]));
    let mut last_sum = S::load_from(&y[last..]);
    for (column, x) in columns {
        if x == Default::default() {
            continue;
        }
        let column = &column[..y.len()];
        let entries = &column[rows.clone()];
        for own in 0..N {
            sums[own] = sums[own].plus(x, S::load_from(&entries[own * S::WIDTH..]));
        }
        last_sum = last_sum.plus(x, S::load_from(&column[last..]));
    }
    for own in 0..N {
        sums[own].store_to(&mut y[first + own * S::WIDTH..]);
    }
    last_sum.store_to(&mut y[last..]);
}

struct AddProducts<'a> {
    y: &'a mut [f64],
    columns: &'a [f64],
    x: &'a [f64],
}

impl Task for AddProducts<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let AddProducts { y, columns, x } = self;
        let n = x.len();
        let columns = &columns[..n * y.len()];
        let (sums, rest) = y.as_chunks_mut::<BESIDE>();
        let (some, others) = columns.split_at(n * BESIDE * sums.len());
        let (whole, few) = x.as_chunks::<PARTS>();
        let mut last = [0.0; PARTS];
        last[PARTS - few.len()..].copy_from_slice(few);
        let x = Rows { all: x, whole, last };
        for (sums, columns) in sums.iter_mut().zip(some.chunks_exact(n.max(1) * BESIDE)) {
            add_beside::<L, BESIDE>(sums, columns, &x);
        }
        for (sum, column) in rest.iter_mut().zip(others.chunks_exact(n.max(1))) {
            add_beside::<L, 1>(std::array::from_mut(sum), column, &x);
        }
    }
}

/// The values of x, by partial sums, and the last ones behind zeros.
struct Rows<'a> {
    all: &'a [f64],
    whole: &'a [[f64; PARTS]],
    last: [f64; PARTS],
}

/// y_j += a_j·x. Rows at the end that are fewer than the partial sums are read with some before them, those by zeros in x.
#[inline(always)]
fn add_beside<L: Register, const N: usize>(y: &mut [f64; N], columns: &[f64], x: &Rows) {
    let n = x.all.len();
    let columns: [&[f64]; N] = std::array::from_fn(|j| &columns[j * n..][..n]);
    if n < PARTS {
        for (y, column) in y.iter_mut().zip(columns) {
            column.iter().zip(x.all).for_each(|(entry, x)| *y += entry * x);
        }
        return;
    }
    let mut sums = [[L::splat(0.0); PARTS]; N];
    for (place, x) in x.whole.iter().enumerate() {
        add_some(&mut sums, columns, place * PARTS, x);
    }
    if n > x.whole.len() * PARTS {
        add_some(&mut sums, columns, n - PARTS, &x.last);
    }
    for (y, sums) in y.iter_mut().zip(sums) {
        let mut parts = [0.0; PARTS];
        for (chunk, sum) in L::chunks_mut(&mut parts).iter_mut().zip(sums) {
            sum.store(chunk);
        }
        let [a, b, c, d, e, f, g, h] = parts;
        *y += ((a + b) + (c + d)) + ((e + f) + (g + h));
    }
}

/// Adds what some rows give to partial sums.
#[inline(always)]
fn add_some<L: Register, const N: usize>(
    sums: &mut [[L; PARTS]; N],
    columns: [&[f64]; N],
    row: usize,
    x: &[f64; PARTS],
) {
    let x = L::chunks(x);
    for j in 0..N {
        let column = L::chunks(&columns[j][row..][..PARTS]);
        for own in 0..PARTS / L::WIDTH {
            sums[j][own] = sums[j][own] + L::load(&column[own]) * L::load(&x[own]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<T: Number>(rows: usize, cols: usize, number: fn(f64) -> T) -> Vec<T> {
        (0..rows * cols).map(|k| number((1.3 * k as f64 + 0.2).sin())).collect()
    }

    fn sums_are_in_order<T: Number + std::fmt::Debug>(number: fn(f64) -> T) {
        for rows in [0, 1, 3, 4, 5, 8, 15, 16, 23, 96, 97, 130, 201, 400, 1030, 4100] {
            for cols in [0, 1, 2, 7, 16, 17, 35, 83] {
                let columns = matrix(rows, cols, number);
                let x = matrix(cols, 1, number);
                let start = matrix(rows, 1, number);
                let mut expected = start.clone();
                for j in 0..cols {
                    for (i, sum) in expected.iter_mut().enumerate() {
                        *sum = *sum + x[j] * columns[j * rows + i];
                    }
                }
                for registers in Registers::all() {
                    let mut y = start.clone();
                    let pairs = (0..cols).map(|j| (&columns[j * rows..(j + 1) * rows], x[j]));
                    registers.within(|| add_columns(&mut y, pairs));
                    assert_eq!(y, expected, "{rows} × {cols}, {}", registers.name());
                    let mut y = start.clone();
                    registers.within(|| add_matrix(&mut y, &columns, &x));
                    assert_eq!(y, expected, "{rows} × {cols}, {}", registers.name());
                }
            }
        }
    }

    #[test]
    fn bits_are_those_of_one_column_after_the_other() {
        sums_are_in_order::<f64>(|value| value);
        sums_are_in_order::<f32>(|value| value as f32);
    }

    #[test]
    fn products_of_columns_have_the_same_bits_on_all_registers() {
        for rows in [0, 1, 7, 8, 9, 36, 77] {
            for cols in [0, 1, 3, 4, 9, 44] {
                let columns = matrix(rows, cols, |value| value);
                let x = matrix(rows, 1, |value| value);
                let start = vec![0.25; cols];
                let mut single = start.clone();
                Registers::SINGLE.within(|| add_products(&mut single, &columns, &x));
                for (j, y) in single.iter().enumerate() {
                    let product = crate::vector::dot(&columns[j * rows..][..rows], &x);
                    assert!((y - 0.25 - product).abs() < 1e-14, "{rows} × {cols}");
                }
                for registers in Registers::all() {
                    let mut y = start.clone();
                    registers.within(|| add_products(&mut y, &columns, &x));
                    assert_eq!(y, single, "{rows} × {cols}, {}", registers.name());
                }
            }
        }
    }

    #[test]
    #[should_panic(expected = "range end index")]
    fn a_column_that_is_cut_is_no_column() {
        add_columns(&mut [0.0; 9], std::iter::once((&[1.0; 8][..], 1.0)));
    }
}
