//! A bore that gives way: shapes of it that open the gap, and what the film does to them.

use super::balance::Balance;
use super::journal::Journal;
use super::oil::Oil;
use super::reaction::{INPUTS, OUTPUTS, WIDE};
use super::slopes::Weights;
use crate::linalg::{Matrix, add_product, add_transposed, transpose_multiply};

/// Shapes in which a bore deforms beside the motions of a rigid one.
#[derive(Debug, Clone)]
pub struct Shapes {
    /// By how much each opens the gap at the nodes (m/m): nodes × shapes.
    opened: Matrix,
    /// The same by node, as many shapes at a time as fill a register.
    blocks: Vec<Vec<[f64; WIDE]>>,
}

/// Slopes of what a film does where its bore deforms; see [`Journal::slopes_of_shapes`].
#[derive(Debug, Clone)]
pub struct ShapeSlopes {
    /// By each shape and by its rate: of forces and moments on the journal.
    pub on_journal: [Vec<[f64; OUTPUTS]>; 2],
    /// Of the force on each shape by displacements, tilts, their rates and the speed.
    pub by_inputs: Vec<[f64; INPUTS]>,
    /// Of the force on each shape (row) by shapes (column), and by their rates.
    pub by_shapes: [Matrix; 2],
}

impl Shapes {
    /// Shapes by how much each opens the gap: nodes × shapes.
    pub fn new(opened: Matrix) -> Self {
        let blocks = (0..opened.cols.div_ceil(WIDE)).map(|block| {
            let at = |a: usize| {
                std::array::from_fn(|n| {
                    let shape = block * WIDE + n;
                    if shape < opened.cols { opened[(a, shape)] } else { 0.0 }
                })
            };
            (0..opened.rows).map(at).collect()
        });
        Shapes { blocks: blocks.collect(), opened }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.opened.cols
    }

    /// By how much so much of every shape opens the gap at the nodes (m).
    pub fn open(&self, by: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        add_product(out, &self.opened, by);
    }
}

impl ShapeSlopes {
    /// Zeros.
    pub fn new(shapes: &Shapes) -> Self {
        let count = shapes.count();
        ShapeSlopes {
            on_journal: [(); 2].map(|()| vec![[0.0; OUTPUTS]; count]),
            by_inputs: vec![[0.0; INPUTS]; count],
            by_shapes: [(); 2].map(|()| Matrix::zeros(count, count)),
        }
    }
}

/// Of the forces at the nodes those that push the surfaces apart, on some of the shapes.
struct OnShapes<'a> {
    pushes: &'a [bool],
    block: &'a [[f64; WIDE]],
}

impl Weights for OnShapes<'_> {
    fn of_force(&self, force: usize) -> bool {
        self.pushes.get(force).copied().unwrap_or(false)
    }

    #[inline(always)]
    fn at(&self, _: usize, node: usize, _: f64) -> [f64; WIDE] {
        self.block[node]
    }
}

impl Journal {
    /// The forces on shapes of the bore (N), after [`Journal::forces`].
    pub fn push(&self, balance: &Balance, shapes: &Shapes, out: &mut [f64]) {
        let kernel = self.film.kernel;
        let [across, up] = self.film.grid.cells();
        let count = kernel.nodes[0] * kernel.nodes[1];
        let mut apart = vec![0.0; self.film.grid.nodes()];
        for k in 0..up {
            let values = &balance.surface[k * kernel.surface.count * across..];
            for (value, row) in kernel.surface.rows.iter().enumerate() {
                let (force, a) = (value / count, value % count);
                if !self.pushes.get(force).copied().unwrap_or(false) {
                    continue;
                }
                let nodes = &balance.places[(k * count + a) * across..][..across];
                for (value, node) in values[row * across..][..across].iter().zip(nodes) {
                    apart[*node] += value;
                }
            }
        }
        out.fill(0.0);
        add_transposed(out, &shapes.opened, &apart);
    }

    /// Slopes of all forces by shapes of the bore, and of those on the shapes, right after [`Journal::slopes`] for the same step.
    pub fn slopes_of_shapes(
        &self,
        step: Option<f64>,
        oil: &Oil,
        balance: &mut Balance,
        shapes: &Shapes,
        out: &mut ShapeSlopes,
    ) {
        let grid = &self.film.grid;
        let (nodes, count) = (grid.nodes(), shapes.count());
        // Slopes of outputs by the gap at every node, and by its rate: those of the journal first.
        let mut both = [(); 2].map(|()| Matrix::zeros(nodes, WIDE * (1 + shapes.blocks.len())));
        let mut by_speed = vec![[0.0; WIDE]; 1 + shapes.blocks.len()];
        take_nodes(balance, step, 0, &mut both);
        for (block, own) in shapes.blocks.iter().enumerate() {
            let weights = OnShapes { pushes: &self.pushes, block: own };
            by_speed[1 + block] = balance.slopes_by_nodes(&self.film, oil, &weights);
            take_nodes(balance, step, 1 + block, &mut both);
        }
        for (which, slopes) in both.iter().enumerate() {
            let product = transpose_multiply(shapes.opened.view(), slopes.view());
            for shape in 0..count {
                out.on_journal[which][shape] = std::array::from_fn(|n| product[(shape, n)]);
                let column = out.by_shapes[which].col_mut(shape);
                for (k, value) in column.iter_mut().enumerate() {
                    *value = product[(shape, WIDE + k)];
                }
            }
            let gradients =
                Matrix::from_fn(nodes, 4, |a, q| self.opening(a % grid.around, a / grid.around)[q]);
            let product = transpose_multiply(gradients.view(), slopes.view());
            for (k, inputs) in out.by_inputs.iter_mut().enumerate() {
                for q in 0..4 {
                    inputs[4 * which + q] = product[(q, WIDE + k)];
                }
                inputs[INPUTS - 1] = by_speed[1 + k / WIDE][k % WIDE] * self.speed;
            }
        }
    }
}

/// Takes slopes of outputs by the gap and by its rate from those by the gap and by what holds oil.
fn take_nodes(balance: &Balance, step: Option<f64>, block: usize, both: &mut [Matrix; 2]) {
    let [by_gap, by_stored] = &balance.by_node;
    let half = step.map(|step| 0.5 * step);
    let [values, rates] = both;
    for (a, (gap, stored)) in by_gap.iter().zip(by_stored).enumerate() {
        for n in 0..WIDE {
            let (value, rate) = match half {
                Some(half) => (gap[n] + stored[n], half * stored[n]),
                None => (gap[n], stored[n]),
            };
            values[(a, WIDE * block + n)] = value;
            rates[(a, WIDE * block + n)] = if balance.motion.shifted[a] { rate } else { 0.0 };
        }
    }
}
