//! The dense block of a supernode, packed for solutions: columns that are taken together stand beside each other, row after row.

use whirl_specs::Registers;
use whirl_specs::registers::{Double, Register, Sums, Task};

/// Right sides of a block, which lie side by side in memory.
pub(super) const BLOCK: usize = 8;
/// Columns of a supernode that are taken together.
const TOGETHER: usize = 8;

/// Puts a supernode's columns beside each other, as many as are taken together, row after row, and what solutions multiply by in
/// place of its diagonal.
pub(super) fn pack(block: &mut [f64], cols: usize, memory: &mut Vec<f64>) {
    let rows = block.len() / cols;
    for (group, own) in block.chunks_mut(TOGETHER * rows).enumerate() {
        let width = own.len() / rows;
        memory.clear();
        memory.extend_from_slice(own);
        for (k, column) in memory.chunks_exact(rows).enumerate() {
            own.iter_mut().skip(k).step_by(width).zip(column).for_each(|(to, from)| *to = *from);
            let diagonal = &mut own[(TOGETHER * group + k) * width + k];
            *diagonal = 1.0 / *diagonal;
        }
    }
}

/// What a supernode does with its rows.
pub(super) trait Way {
    /// Whether the last columns come first.
    const REVERSED: bool;

    /// Does it by N columns, whose own first row comes behind so many others.
    fn columns<S: Sums<Number = f64>, const N: usize>(
        columns: &[f64],
        skipped: usize,
        local: &mut [f64],
    );
}

/// L⁻¹ of a supernode.
pub(super) struct Forward;

/// L⁻ᵀ of a supernode.
pub(super) struct Backward;

impl Way for Forward {
    const REVERSED: bool = false;

    /// Solves by the triangle of N columns, whose first row comes behind so many others, and takes them off the rows below.
    #[inline(always)]
    fn columns<S: Sums<Number = f64>, const N: usize>(
        columns: &[f64],
        skipped: usize,
        local: &mut [f64],
    ) {
        let (triangle, below) = columns.as_chunks::<N>().0[skipped..].split_at(N);
        let (own, rest) = local.split_at_mut(N * BLOCK);
        let (own, rest) = (own.as_chunks_mut::<BLOCK>().0, rest.as_chunks_mut::<BLOCK>().0);
        let zero = S::load_from(&[0.0; BLOCK]);
        for lane in (0..BLOCK).step_by(S::WIDTH) {
            let mut less = [zero; N];
            for j in 0..N {
                let mut x = S::load_from(&own[j][lane..]);
                for k in 0..j {
                    x = x.plus(triangle[j][k], less[k]);
                }
                zero.plus(triangle[j][j], x).store_to(&mut own[j][lane..]);
                less[j] = zero.plus(-triangle[j][j], x);
            }
            for (row, entries) in rest.iter_mut().zip(below) {
                let mut sum = S::load_from(&row[lane..]);
                for k in 0..N {
                    sum = sum.plus(entries[k], less[k]);
                }
                sum.store_to(&mut row[lane..]);
            }
        }
    }
}

impl Way for Backward {
    const REVERSED: bool = true;

    /// Takes the rows below off N columns, and solves by the transpose of their triangle.
    #[inline(always)]
    fn columns<S: Sums<Number = f64>, const N: usize>(
        columns: &[f64],
        skipped: usize,
        local: &mut [f64],
    ) {
        let (triangle, below) = columns.as_chunks::<N>().0[skipped..].split_at(N);
        let (own, rest) = local.split_at_mut(N * BLOCK);
        let (own, rest) = (own.as_chunks_mut::<BLOCK>().0, rest.as_chunks_mut::<BLOCK>().0);
        let zero = S::load_from(&[0.0; BLOCK]);
        for lane in (0..BLOCK).step_by(S::WIDTH) {
            let mut sums = [zero; N];
            for (row, entries) in rest.iter().zip(below) {
                let x = S::load_from(&row[lane..]);
                for k in 0..N {
                    sums[k] = sums[k].plus(entries[k], x);
                }
            }
            let mut found = [zero; N];
            for j in (0..N).rev() {
                for k in j + 1..N {
                    sums[j] = sums[j].plus(triangle[k][j], found[k]);
                }
                let x = S::load_from(&own[j][lane..]).plus(-1.0, sums[j]);
                found[j] = zero.plus(triangle[j][j], x);
                found[j].store_to(&mut own[j][lane..]);
            }
        }
    }
}

/// Goes one way through a packed block with its rows of right sides.
pub(super) fn solve<W: Way>(block: &[f64], local: &mut [f64]) {
    Registers::current().run(Solve { block, local, way: std::marker::PhantomData::<W> });
}

struct Solve<'a, W> {
    block: &'a [f64],
    local: &'a mut [f64],
    way: std::marker::PhantomData<W>,
}

impl<W: Way> Task for Solve<'_, W> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let Solve { block, local, .. } = self;
        let rows = local.len() / BLOCK;
        let groups = block.len().div_ceil(TOGETHER * rows);
        for step in 0..groups {
            let group = if W::REVERSED { groups - 1 - step } else { step };
            let skipped = TOGETHER * group;
            let own = &block[skipped * rows..usize::min(block.len(), (skipped + TOGETHER) * rows)];
            let local = &mut local[skipped * BLOCK..];
            match own.len() / rows {
                1 => W::columns::<Double<L>, 1>(own, skipped, local),
                2 => W::columns::<Double<L>, 2>(own, skipped, local),
                3 => W::columns::<Double<L>, 3>(own, skipped, local),
                4 => W::columns::<Double<L>, 4>(own, skipped, local),
                5 => W::columns::<Double<L>, 5>(own, skipped, local),
                6 => W::columns::<Double<L>, 6>(own, skipped, local),
                7 => W::columns::<Double<L>, 7>(own, skipped, local),
                _ => W::columns::<Double<L>, TOGETHER>(own, skipped, local),
            }
        }
    }
}
