//! What a kernel of cells takes and gives.

use crate::matrices::{Batch, CellMatrix};
use crate::origin::Variable;

/// How the matrix of one cell is stored; found by the generator from the form.
/// Degree of freedom 3a + i is component i of node a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Structure {
    /// Symmetric, upper triangle by rows: (0,0), (0,1), …, (0,n−1), (1,1), …; n = 3·nodes.
    Symmetric,
    /// All n × n entries by rows.
    Full,
    /// A symmetric scalar matrix s (nodes × nodes, upper triangle by rows) times a 3 × 3 pattern:
    /// entry (3a+i, 3b+j) = `s[a,b] · pattern[i][j]`.
    Kronecker {
        /// `pattern[i][j]`; symmetric or skew.
        pattern: [[f64; 3]; 3],
    },
}

impl Structure {
    /// Number of stored values of one cell with `nodes` nodes.
    pub fn len(&self, nodes: usize) -> usize {
        let n = 3 * nodes;
        match self {
            Structure::Symmetric => n * (n + 1) / 2,
            Structure::Full => n * n,
            Structure::Kronecker { .. } => nodes * (nodes + 1) / 2,
        }
    }
}

/// Computes the matrices of a block of cells.
///
/// `coordinates`: cells × nodes × 3, in m; of a form under a stress ([`FormKernel::under_stress`]) cells × 2·nodes × 3,
/// the displacements of a cell's nodes behind their coordinates. `material`: the values named by [`FormKernel::material`], SI.
/// `matrices`: ⌈cells/8⌉ × [`Structure::len`], eight cells side by side, so that registers are stored as they are;
/// [`CellMatrix`] reads those of one cell, and what stands where no cell is has no meaning. `jacobians`: cells; the
/// smallest det J over the cell's quadrature points, so that the caller can name an inverted cell (det J ≤ 0; its
/// matrix is then meaningless, not an error of the kernel).
pub type CellKernel =
    fn(coordinates: &[f64], material: &[f64], matrices: &mut [Batch], jacobians: &mut [f64]);

/// One bilinear form on one element.
#[derive(Debug, Clone, Copy)]
pub struct FormKernel {
    /// Name of the form in its spec: `stiffness`, `stiffening` (G), `mass`, `spin_inertia` (Y), `spin_coupling` (H).
    pub form: &'static str,
    /// Material properties in the order the kernel takes them, such as `E`, `nu`, `rho`.
    pub material: &'static [Variable],
    /// Storage of a cell's matrix.
    pub structure: Structure,
    /// Whether the form is one under the stress of a displacement, of which it is linear: then the displacements of the
    /// nodes of every cell (m) are given behind their coordinates.
    pub under_stress: bool,
    /// Floating-point operations a cell that what it writes needs, a·b + c counted as two.
    pub flops: usize,
    /// The kernel.
    pub evaluate: CellKernel,
}

/// The stress that a form gives to a displacement, on one element.
#[derive(Debug, Clone, Copy)]
pub struct StressKernel {
    /// Its name in the spec: `sigma`.
    pub stress: &'static str,
    /// The form that gives it, at whose points it is found: `stiffness`.
    pub form: &'static str,
    /// Material properties in the order the kernel takes them.
    pub material: &'static [Variable],
    /// The points (ξ, η, ζ) and their weights.
    pub points: &'static [([f64; 3], f64)],
    /// Exponents of (ξ, η, ζ) in the monomials of which the cell's linear functions are sums, the lowest first.
    pub linear: &'static [[u8; 3]],
    /// Floating-point operations a cell, as of forms.
    pub flops: usize,
    /// The kernel; it takes nodes and their displacements as one of a form under a stress, and gives σ_xx, σ_yy, σ_zz,
    /// σ_xy, σ_yz, σ_zx (Pa) at every point in place of a matrix.
    pub evaluate: CellKernel,
}

impl FormKernel {
    /// The matrix of one cell, [`Structure::len`] values, and its smallest det J. `coordinates`: those of its nodes and no
    /// more (nodes × 3, m), with the displacements behind them where there is a stress.
    ///
    /// # Panics
    /// If there are fewer coordinates or properties than the kernel takes.
    pub fn of_cell(&self, coordinates: &[f64], material: &[f64]) -> (Vec<f64>, f64) {
        let given = if self.under_stress { 2 } else { 1 };
        let stored = self.structure.len(coordinates.len() / (3 * given));
        let (mut matrices, mut jacobians) = (Batch::storage(1, stored), [0.0]);
        (self.evaluate)(coordinates, material, &mut matrices, &mut jacobians);
        (CellMatrix::new(&matrices, stored, 0).values().collect(), jacobians[0])
    }
}
