//! Solutions for blocks of a few right sides by a supernodal factor, whose values are read once for all of a block, in the order in
//! which they stand. The supernodes fall into two parts that do not see each other and those on top of both, whatever processors
//! there are, so that all machines compute the same.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use super::packed::{BLOCK, Backward, Forward, pack, solve};
use super::values::Values;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;

use crate::together::both;

/// Share of all values up to which the larger part is good enough, and splits of subtrees at most to reach it.
const EVEN: f64 = 0.55;
const SPLITS: usize = 64;

/// Values of a factor times right sides of a block beyond which a solution is worth a thread.
const WORTH: usize = 1 << 20;

/// A factor L, packed for solutions.
#[derive(Debug)]
pub(super) struct BlockSolve {
    supernodes: Supernodes,
    parts: [Vec<usize>; 2],
    /// Supernodes that both parts, or several subtrees of a part, lead to.
    top: Vec<usize>,
    /// Columns of the second part and of those on top.
    second: Vec<Range<usize>>,
    last: Vec<Range<usize>>,
    /// Rows of the matrix, and of the largest supernode.
    size: usize,
    largest: usize,
    memory: Mutex<Vec<Memory>>,
}

/// Of either part the solution, a row of [`BLOCK`] values an unknown, and that of a supernode.
#[derive(Debug)]
struct Memory {
    rows: [Vec<f64>; 2],
    local: [Vec<f64>; 2],
}

impl BlockSolve {
    /// Takes the values of a factor of one row at least, each supernode column after column, the rows of its own columns first;
    /// none if one is not finite.
    pub(super) fn new(
        symbolic: &SymbolicSupernodalCholesky<usize>,
        mut values: Values,
    ) -> Option<BlockSolve> {
        let count = symbolic.n_supernodes();
        let (begin, end) = (symbolic.supernode_begin(), symbolic.supernode_end());
        let (mut own, mut rows) = (Vec::with_capacity(count), Vec::new());
        let mut children = vec![Vec::new(); count];
        let mut roots = Vec::new();
        let mut costs = vec![0; count];
        for s in 0..count {
            let (cols, pattern) = (end[s] - begin[s], symbolic.supernode(s).pattern());
            let from = symbolic.col_ptr_for_val()[s];
            let block = from..from + cols * (cols + pattern.len());
            costs[s] += block.len();
            match pattern.first() {
                Some(first) => {
                    let parent = begin[..count].partition_point(|own| own <= first) - 1;
                    children[parent].push(s);
                    costs[parent] += costs[s];
                }
                None => roots.push(s),
            }
            let below = rows.len()..rows.len() + pattern.len();
            rows.extend_from_slice(pattern);
            own.push(Supernode { columns: begin[s]..end[s], below, block });
        }
        if !pack_all(&own, &mut values) {
            return None;
        }
        let (parts, mut top) = divide(roots, &children, &costs);
        let parts = parts.map(|roots| {
            let mut all = roots;
            let mut next = 0;
            while next < all.len() {
                all.extend_from_slice(&children[all[next]]);
                next += 1;
            }
            all.sort_unstable();
            all
        });
        top.sort_unstable();
        let columns = |all: &[usize]| all.iter().map(|&s| begin[s]..end[s]).collect();
        Some(BlockSolve {
            second: columns(&parts[1]),
            last: columns(&top),
            largest: own.iter().map(Supernode::rows).max().unwrap_or(0),
            size: end.last().copied().unwrap_or(0),
            supernodes: Supernodes { own, rows, values },
            parts,
            top,
            memory: Mutex::new(Vec::new()),
        })
    }

    /// Replaces each column b of `rhs` by A⁻¹b; `order`: the row of each unknown of the factor.
    ///
    /// # Panics
    /// If they are not whole columns.
    pub(super) fn solve(&self, order: &[usize], rhs: &mut [f64]) {
        assert!(rhs.len().is_multiple_of(self.size), "right sides of {} rows", self.size);
        let kept = self.memory.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let values = |rows: usize| vec![0.0; rows * BLOCK];
        let mut memory = kept.unwrap_or_else(|| Memory {
            rows: [values(self.size), values(self.size)],
            local: [values(self.largest), values(self.largest)],
        });
        for block in rhs.chunks_mut(BLOCK * self.size) {
            self.solve_block(order, block, &mut memory);
        }
        self.memory.lock().unwrap_or_else(PoisonError::into_inner).push(memory);
    }

    fn solve_block(&self, order: &[usize], rhs: &mut [f64], memory: &mut Memory) {
        let (n, supernodes) = (self.size, &self.supernodes);
        let Memory { rows: [first, second], local: [local, other] } = memory;
        for (i, row) in rows_of(first).iter_mut().enumerate() {
            *row = [0.0; BLOCK];
            let given = rhs.chunks_exact(n).map(|column| column[order[i]]);
            row.iter_mut().zip(given).for_each(|(own, value)| *own = value);
        }
        // What the second part begins with goes over to it, and what it leaves on top comes back.
        copy(&self.second, first, second);
        self.last.iter().for_each(|rows| rows_of(second)[rows.clone()].fill([0.0; BLOCK]));
        self.both(
            rhs.len() / n,
            || supernodes.forward(&self.parts[0], first, local),
            || supernodes.forward(&self.parts[1], second, other),
        );
        for rows in &self.last {
            let rows = rows.start * BLOCK..rows.end * BLOCK;
            let sums = first[rows.clone()].iter_mut().zip(&second[rows]);
            sums.for_each(|(sum, value)| *sum += value);
        }
        supernodes.forward(&self.top, first, local);
        supernodes.backward(&self.top, first, local);
        copy(&self.last, first, second);
        self.both(
            rhs.len() / n,
            || supernodes.backward(&self.parts[0], first, local),
            || supernodes.backward(&self.parts[1], second, other),
        );
        copy(&self.second, second, first);
        for (i, row) in rows_of(first).iter().enumerate() {
            let found = rhs.chunks_exact_mut(n).map(|column| &mut column[order[i]]);
            found.zip(row).for_each(|(value, own)| *value = *own);
        }
    }

    /// Does both, side by side if that is worth it for so many right sides.
    fn both(&self, columns: usize, a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
        if columns * self.supernodes.values.len() >= WORTH {
            both(a, b);
        } else {
            a();
            b();
        }
    }
}

fn rows_of(values: &mut [f64]) -> &mut [[f64; BLOCK]] {
    values.as_chunks_mut().0
}

fn copy(rows: &[Range<usize>], from: &[f64], to: &mut [f64]) {
    for rows in rows {
        let rows = rows.start * BLOCK..rows.end * BLOCK;
        to[rows.clone()].copy_from_slice(&from[rows]);
    }
}

/// Packs every block of a factor, those of the first half of its values beside those of the second; whether all are finite.
fn pack_all(supernodes: &[Supernode], values: &mut [f64]) -> bool {
    let middle = supernodes.partition_point(|own| own.block.end <= values.len() / 2);
    let (first, second) = supernodes.split_at(middle);
    let start = second.first().map_or(values.len(), |own| own.block.start);
    let pack = |supernodes: &[Supernode], values: &mut [f64], start: usize| {
        let mut memory = Vec::new();
        supernodes.iter().all(|own| {
            let block = &mut values[own.block.start - start..own.block.end - start];
            let finite = block.iter().all(|value| value.is_finite());
            pack(block, own.columns.len(), &mut memory);
            finite
        })
    };
    if values.len() >= WORTH {
        let (early, late) = values.split_at_mut(start);
        let finite = both(|| pack(first, early, 0), || pack(second, late, start));
        finite.0 && finite.1
    } else {
        pack(supernodes, values, 0)
    }
}

/// Shares subtrees out to two parts of about the same cost, each split into those below its root while they are uneven: the roots
/// of either part, and those on top.
fn divide(
    mut roots: Vec<usize>,
    children: &[Vec<usize>],
    costs: &[usize],
) -> ([Vec<usize>; 2], Vec<usize>) {
    let mut top = Vec::new();
    loop {
        roots.sort_by_key(|&root| std::cmp::Reverse(costs[root]));
        let (mut parts, mut sums) = ([Vec::new(), Vec::new()], [0, 0]);
        for &root in &roots {
            let lighter = usize::from(sums[1] < sums[0]);
            parts[lighter].push(root);
            sums[lighter] += costs[root];
        }
        let even = EVEN * (sums[0] + sums[1]) as f64;
        let Some((&largest, rest)) = roots.split_first() else { return (parts, top) };
        if (sums[0].max(sums[1]) as f64) <= even
            || top.len() == SPLITS
            || children[largest].is_empty()
        {
            return (parts, top);
        }
        top.push(largest);
        roots = rest.iter().chain(&children[largest]).copied().collect();
    }
}

/// Dense blocks of a factor.
#[derive(Debug)]
struct Supernodes {
    own: Vec<Supernode>,
    /// Rows below the columns of each.
    rows: Vec<usize>,
    /// As [`pack`] leaves them.
    values: Values,
}

#[derive(Debug)]
struct Supernode {
    columns: Range<usize>,
    /// Where its further rows and its values stand.
    below: Range<usize>,
    block: Range<usize>,
}

impl Supernode {
    fn rows(&self) -> usize {
        self.columns.len() + self.below.len()
    }
}

impl Supernodes {
    /// L⁻¹ of some of them, in their order.
    fn forward(&self, which: &[usize], rows: &mut [f64], local: &mut [f64]) {
        for &s in which {
            let own = &self.own[s];
            self.gather(own, rows, local);
            let local = &mut local[..own.rows() * BLOCK];
            let block = &self.values[own.block.clone()];
            solve::<Forward>(block, local);
            self.put_back(own, local, rows);
            let rows = rows_of(rows);
            let (below, from) =
                (&self.rows[own.below.clone()], &rows_of(local)[own.columns.len()..]);
            below.iter().zip(from).for_each(|(&to, from)| rows[to] = *from);
        }
    }

    /// L⁻ᵀ of some of them, in the other order.
    fn backward(&self, which: &[usize], rows: &mut [f64], local: &mut [f64]) {
        for &s in which.iter().rev() {
            let own = &self.own[s];
            self.gather(own, rows, local);
            let local = &mut local[..own.rows() * BLOCK];
            let block = &self.values[own.block.clone()];
            solve::<Backward>(block, local);
            self.put_back(own, local, rows);
        }
    }

    fn gather(&self, own: &Supernode, rows: &[f64], local: &mut [f64]) {
        let columns = own.columns.start * BLOCK..own.columns.end * BLOCK;
        let (local, below) = local.split_at_mut(columns.len());
        local.copy_from_slice(&rows[columns]);
        let rows = rows.as_chunks::<BLOCK>().0;
        let from = self.rows[own.below.clone()].iter();
        rows_of(below).iter_mut().zip(from).for_each(|(to, &from)| *to = rows[from]);
    }

    /// The rows of its columns.
    fn put_back(&self, own: &Supernode, local: &[f64], rows: &mut [f64]) {
        let columns = own.columns.start * BLOCK..own.columns.end * BLOCK;
        let count = columns.len();
        rows[columns].copy_from_slice(&local[..count]);
    }
}

#[cfg(test)]
mod tests {
    use whirl_specs::Registers;

    use crate::linalg::{LowerTriangle, SparseCholesky};

    use super::*;

    /// A chain of stiff cells, whose factor has supernodes of many widths.
    fn grid(n: usize) -> LowerTriangle {
        let entry =
            |i: usize, j: usize| if i == j { 9.0 } else { -0.1 - ((i + j) % 7) as f64 / 10.0 };
        LowerTriangle::from_columns(n, |j| {
            [0, 1, 2, 3, 5, 13, 14]
                .into_iter()
                .map(move |k| (j + k, entry(j, j + k)))
                .filter(move |&(i, _)| i < n)
        })
    }

    #[test]
    fn blocks_of_any_number_of_right_sides_are_solved() {
        let n = 700;
        let a = grid(n);
        let order: Vec<usize> = (0..n).map(|i| (i * 37) % n).collect();
        let factor = SparseCholesky::new(&a, &order, usize::MAX).unwrap();
        for cols in [0, 1, 3, 8, 9, 21] {
            let x: Vec<f64> = (0..cols * n).map(|i| (1.7 * i as f64).cos()).collect();
            let mut b = vec![0.0; cols * n];
            a.multiply(&x, &mut b);
            let given = b.clone();
            factor.solve_in_place(&mut b);
            for (own, exact) in b.iter().zip(&x) {
                assert!((own - exact).abs() < 1e-12, "{own} for {exact}");
            }
            // No register changes a bit.
            for registers in Registers::all() {
                let mut again = given.clone();
                registers.within(|| factor.solve_in_place(&mut again));
                assert_eq!(again, b, "{}", registers.name());
            }
        }
    }

    /// Two chains beside each other and what joins them last, large enough for both parts to be worth a thread.
    #[test]
    fn parts_do_not_see_each_other() {
        const N: usize = 12_001;
        let half = N / 2;
        let entry = |k: usize| if k == 0 { 60.0 } else { -1.0 - (k % 3) as f64 };
        let chain = |j: usize, end: usize| {
            (0..14).map(move |k| (j + k, entry(k))).filter(move |&(i, _)| i < end)
        };
        let a = LowerTriangle::from_columns(N, |j| {
            let end = if j < half { half } else { N - 1 };
            let own = (j < N - 1).then(|| chain(j, end)).into_iter().flatten();
            let joined = j == 0 || j == half || j == N - 1;
            own.chain(joined.then_some((N - 1, if j == N - 1 { 60.0 } else { -1.0 })))
        });
        let order: Vec<usize> = (0..N).collect();
        let factor = SparseCholesky::new(&a, &order, usize::MAX).unwrap();
        let solve = factor.blocks().expect("rows");
        assert!(solve.supernodes.values.len() * BLOCK >= WORTH);
        let rows = |part: usize| -> Vec<usize> {
            let own = solve.parts[part].iter().map(|&s| &solve.supernodes.own[s]);
            own.flat_map(|own| {
                own.columns.clone().chain(solve.supernodes.rows[own.below.clone()].iter().copied())
            })
            .collect()
        };
        let (first, second): (Vec<usize>, std::collections::HashSet<usize>) =
            (rows(0), rows(1).into_iter().collect());
        assert!(first.len() > N / 4 && second.len() > N / 4 && !solve.top.is_empty());
        let on_top = |row: &usize| solve.last.iter().any(|columns| columns.contains(row));
        assert!(first.iter().all(|row| !second.contains(row) || on_top(row)));
        let x: Vec<f64> = (0..BLOCK * N).map(|i| (1.7 * i as f64).cos()).collect();
        let mut b = vec![0.0; BLOCK * N];
        a.multiply(&x, &mut b);
        factor.solve_in_place(&mut b);
        assert!(b.iter().zip(&x).all(|(own, exact)| (own - exact).abs() < 1e-12));
    }

    #[test]
    fn subtrees_are_shared_out_evenly() {
        // A root with two large subtrees, of which one forks again, and a small tree beside it.
        let children = [vec![], vec![], vec![0, 1], vec![], vec![2, 3], vec![]];
        let costs = [40, 30, 75, 60, 140, 5];
        let (parts, top) = divide(vec![4, 5], &children, &costs);
        assert_eq!((parts, top), ([vec![2], vec![3, 5]], vec![4]));
        let (parts, top) = divide(vec![], &[], &[]);
        assert_eq!((parts, top), ([vec![], vec![]], vec![]));
    }
}
