/// Linear tetrahedron, 4 nodes.
///
/// Spec: `elements/tet4.toml`. Source: Zienkiewicz, Taylor & Zhu, The Finite Element Method, 7th ed., ch. 6.
///
/// 4 nodes on the tetrahedron; integrated with tetrahedron(4).
/// `stiffness` is integrated with tetrahedron(1).
pub mod tet4 {
    use crate::{
        cells, forms, Batch, Matrix, Register, Element, Face, FacePoint, FormKernel,
        Origin, StressKernel, Structure, Variable,
    };
    /// The rows of ∂x/∂ξ, ∂x/∂η and ∂x/∂ζ at every point.
    const COLUMNS_: [[usize; 3]; 4] = [[0, 1, 2], [0, 1, 2], [0, 1, 2], [0, 1, 2]];
    /// The rows of ∂x/∂ξ, ∂x/∂η and ∂x/∂ζ at every point.
    const COLUMNS_STIFFNESS_: [[usize; 3]; 1] = [[0, 1, 2]];
    /// N_a at the points.
    const SHAPES_: [[f64; 4]; 4] = [
        [0.5854101966249684, 0.1381966011250105, 0.1381966011250105, 0.1381966011250105],
        [0.1381966011250105, 0.5854101966249684, 0.1381966011250105, 0.1381966011250105],
        [0.1381966011250105, 0.1381966011250105, 0.5854101966249684, 0.1381966011250105],
        [0.1381966011250105, 0.1381966011250105, 0.1381966011250105, 0.5854101966249684],
    ];
    /// ∂N_a/∂(ξ, η, ζ) at the points.
    const SLOPES_STIFFNESS_: [[[f64; 3]; 4]; 1] = [
        [[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    ];
    /// Weights of the points.
    const WEIGHTS_: [f64; 4] = [
        0.041666666666666664,
        0.041666666666666664,
        0.041666666666666664,
        0.041666666666666664,
    ];
    /// Weights of the points.
    const WEIGHTS_STIFFNESS_: [f64; 1] = [0.16666666666666666];
    /// `stiffness`: ∫ `lambda*div(u)*div(v) + 2*mu*inner(eps(u), eps(v))` dV, rows from v, columns from u (`forms/elasticity.toml`), of every cell of a block ([`crate::CellKernel`]).
    ///
    /// A cell: 4 nodes × 3 (m); E (Pa), nu (1); symmetric 12 × 12, upper triangle by rows: 78 values; the smallest det J.
    ///
    /// Rule: tetrahedron(1). 10 pairs × 1 points. Once a cell: 3 add, 3 mul, 2 div for coefficients, then 1 add, 1 mul; once a pair: 12 add, 18 mul. Together 543 operations a cell, a multiplication with the addition behind it counted as two; 96 bytes read, 632 written.
    pub fn stiffness(
        coordinates: &[f64],
        material: &[f64],
        matrices: &mut [Batch],
        jacobians: &mut [f64],
    ) {
        enum Cells {}
        unsafe impl cells::CellLanes<4, 2, 78> for Cells {
            type Workspace<L: Register> = cells::Workspace<L, 4, 1, 3, 3, ()>;
            const IN_REGISTERS: bool = false;
            #[inline(always)]
            fn cell<L: Register>(
                x: &[[L; 3]; 4],
                material: [L; 2],
                workspace: &mut Self::Workspace<L>,
                matrix: Matrix<L>,
            ) -> L {
                let once = forms::elasticity::stiffness_once_(material);
                for i in 0..cells::looped(3) {
                    let part_0 = x[1][i] - x[0][i];
                    let part_1 = x[2][i] - x[0][i];
                    let part_2 = x[3][i] - x[0][i];
                    workspace.tangents[0][i] = part_0;
                    workspace.tangents[1][i] = part_1;
                    workspace.tangents[2][i] = part_2;
                }
                let least_det = cells::maps(
                    &workspace.tangents,
                    &COLUMNS_STIFFNESS_,
                    &WEIGHTS_STIFFNESS_,
                    &mut workspace.maps,
                    &mut workspace.roots,
                );
                cells::gradients(
                    &workspace.maps,
                    SLOPES_STIFFNESS_.as_flattened(),
                    workspace.basis[..4].as_flattened_mut(),
                );
                forms::elasticity::stiffness_pairs_(
                    workspace.basis.as_flattened(),
                    1,
                    once,
                    matrix,
                );
                least_det
            }
        }
        cells::each_cell::<Cells, 4, 2, 78>(coordinates, material, matrices, jacobians);
    }
    /// `stiffening`: ∫ `inner(sigma, transpose(grad(u))*grad(v))` dV, rows from v, columns from u (`forms/elasticity.toml`), of every cell of a block ([`crate::CellKernel`]).
    ///
    /// A cell: 4 nodes × 3 (m), then their displacements × 3 (m), whose stress is that of `stiffness`; E (Pa), nu (1); a symmetric 4 × 4 matrix times a constant 3 × 3 pattern, upper triangle by rows: 10 values; the smallest det J.
    ///
    /// Rule: tetrahedron(1). 10 pairs × 1 points. Once a cell: 3 add, 3 mul, 2 div for coefficients, then 1 add, 1 mul; once a point: 9 add, 9 mul. Together 355 operations a cell, a multiplication with the addition behind it counted as two; 192 bytes read, 88 written.
    pub fn stiffening(
        coordinates: &[f64],
        material: &[f64],
        matrices: &mut [Batch],
        jacobians: &mut [f64],
    ) {
        enum Cells {}
        unsafe impl cells::CellLanes<8, 2, 10> for Cells {
            type Workspace<L: Register> = cells::Workspace<L, 4, 1, 3, 3, ()>;
            const IN_REGISTERS: bool = false;
            #[inline(always)]
            fn cell<L: Register>(
                x: &[[L; 3]; 8],
                material: [L; 2],
                workspace: &mut Self::Workspace<L>,
                matrix: Matrix<L>,
            ) -> L {
                let [x, displacement] = cells::halves::<L, 4, 8>(x);
                let once = forms::elasticity::stiffening_once_(material);
                for i in 0..cells::looped(3) {
                    let part_0 = x[1][i] - x[0][i];
                    let part_1 = x[2][i] - x[0][i];
                    let part_2 = x[3][i] - x[0][i];
                    workspace.tangents[0][i] = part_0;
                    workspace.tangents[1][i] = part_1;
                    workspace.tangents[2][i] = part_2;
                }
                let least_det = cells::maps(
                    &workspace.tangents,
                    &COLUMNS_STIFFNESS_,
                    &WEIGHTS_STIFFNESS_,
                    &mut workspace.maps,
                    &mut workspace.roots,
                );
                cells::gradients(
                    &workspace.maps,
                    SLOPES_STIFFNESS_.as_flattened(),
                    workspace.basis[..4].as_flattened_mut(),
                );
                let modes = [];
                forms::elasticity::stiffening_pairs_(
                    &workspace.basis,
                    &workspace.roots,
                    [displacement, &modes],
                    once,
                    matrix,
                );
                least_det
            }
        }
        cells::each_cell::<Cells, 8, 2, 10>(coordinates, material, matrices, jacobians);
    }
    /// `sigma`: the stress of a displacement as `stiffness` has it (`forms/elasticity.toml`), of every cell of a block ([`crate::CellKernel`]).
    ///
    /// A cell: 4 nodes × 3 (m), then their displacements × 3 (m), whose stress is that of `stiffness`; E (Pa), nu (1); σ_xx, σ_yy, σ_zz, σ_xy, σ_yz, σ_zx (Pa) at every point of the rule: 6 values; the smallest det J.
    ///
    /// Rule: tetrahedron(1). 1 points. Once a cell: 3 add, 3 mul, 2 div for coefficients, then 1 add, 1 mul; once a point: 9 add, 9 mul. Together 223 operations a cell, a multiplication with the addition behind it counted as two; 192 bytes read, 56 written.
    pub fn sigma(
        coordinates: &[f64],
        material: &[f64],
        matrices: &mut [Batch],
        jacobians: &mut [f64],
    ) {
        enum Cells {}
        unsafe impl cells::CellLanes<8, 2, 6> for Cells {
            type Workspace<L: Register> = cells::Workspace<L, 4, 1, 3, 3, ()>;
            const IN_REGISTERS: bool = false;
            #[inline(always)]
            fn cell<L: Register>(
                x: &[[L; 3]; 8],
                material: [L; 2],
                workspace: &mut Self::Workspace<L>,
                matrix: Matrix<L>,
            ) -> L {
                let [x, displacement] = cells::halves::<L, 4, 8>(x);
                let once = forms::elasticity::sigma_once_(material);
                for i in 0..cells::looped(3) {
                    let part_0 = x[1][i] - x[0][i];
                    let part_1 = x[2][i] - x[0][i];
                    let part_2 = x[3][i] - x[0][i];
                    workspace.tangents[0][i] = part_0;
                    workspace.tangents[1][i] = part_1;
                    workspace.tangents[2][i] = part_2;
                }
                let least_det = cells::maps(
                    &workspace.tangents,
                    &COLUMNS_STIFFNESS_,
                    &WEIGHTS_STIFFNESS_,
                    &mut workspace.maps,
                    &mut workspace.roots,
                );
                cells::gradients(
                    &workspace.maps,
                    SLOPES_STIFFNESS_.as_flattened(),
                    workspace.basis[..4].as_flattened_mut(),
                );
                let modes = [];
                forms::elasticity::sigma_points_(
                    &workspace.basis,
                    &workspace.roots,
                    [displacement, &modes],
                    once,
                    matrix,
                );
                least_det
            }
        }
        cells::each_cell::<Cells, 8, 2, 6>(coordinates, material, matrices, jacobians);
    }
    /// `mass`: ∫ `rho*dot(u, v)` dV, rows from v, columns from u (`forms/inertia.toml`), of every cell of a block ([`crate::CellKernel`]).
    ///
    /// A cell: 4 nodes × 3 (m); rho (kg/m^3); a symmetric 4 × 4 matrix times a constant 3 × 3 pattern, upper triangle by rows: 10 values; the smallest det J.
    ///
    /// Rule: tetrahedron(4). 10 pairs × 4 points. Once a cell: no operations for coefficients, then no operations, then 1 mul. Together 170 operations a cell, a multiplication with the addition behind it counted as two; 96 bytes read, 88 written.
    pub fn mass(
        coordinates: &[f64],
        material: &[f64],
        matrices: &mut [Batch],
        jacobians: &mut [f64],
    ) {
        enum Cells {}
        unsafe impl cells::CellLanes<4, 1, 10> for Cells {
            type Workspace<L: Register> = cells::Scalars<L, 4, 3>;
            const IN_REGISTERS: bool = false;
            #[inline(always)]
            fn cell<L: Register>(
                x: &[[L; 3]; 4],
                material: [L; 1],
                workspace: &mut Self::Workspace<L>,
                matrix: Matrix<L>,
            ) -> L {
                let factor = {
                    let [rho] = material;
                    let s_nn_ = L::splat(1.0);
                    let s = s_nn_ * rho;
                    s
                };
                for i in 0..cells::looped(3) {
                    let part_0 = x[1][i] - x[0][i];
                    let part_1 = x[2][i] - x[0][i];
                    let part_2 = x[3][i] - x[0][i];
                    workspace.tangents[0][i] = part_0;
                    workspace.tangents[1][i] = part_1;
                    workspace.tangents[2][i] = part_2;
                }
                let least_det = cells::determinants(
                    &workspace.tangents,
                    &COLUMNS_,
                    &WEIGHTS_,
                    factor,
                    &mut workspace.det,
                );
                cells::products(
                    &workspace.det,
                    SHAPES_.as_flattened(),
                    &mut workspace.weighted,
                    matrix,
                );
                least_det
            }
        }
        cells::each_cell::<Cells, 4, 1, 10>(coordinates, material, matrices, jacobians);
    }
    /// `spin_inertia`: ∫ `rho*dot(D*v, D*u)` dV, rows from v, columns from u (`forms/inertia.toml`), of every cell of a block ([`crate::CellKernel`]).
    ///
    /// A cell: 4 nodes × 3 (m); rho (kg/m^3); a symmetric 4 × 4 matrix times a constant 3 × 3 pattern, upper triangle by rows: 10 values; the smallest det J.
    ///
    /// Rule: tetrahedron(4). 10 pairs × 4 points. Once a cell: no operations for coefficients, then no operations, then 1 mul. Together 170 operations a cell, a multiplication with the addition behind it counted as two; 96 bytes read, 88 written.
    pub fn spin_inertia(
        coordinates: &[f64],
        material: &[f64],
        matrices: &mut [Batch],
        jacobians: &mut [f64],
    ) {
        mass(coordinates, material, matrices, jacobians);
    }
    /// `spin_coupling`: ∫ `rho*dot(D*v, u)` dV, rows from v, columns from u (`forms/inertia.toml`), of every cell of a block ([`crate::CellKernel`]).
    ///
    /// A cell: 4 nodes × 3 (m); rho (kg/m^3); a symmetric 4 × 4 matrix times a constant 3 × 3 pattern, upper triangle by rows: 10 values; the smallest det J.
    ///
    /// Rule: tetrahedron(4). 10 pairs × 4 points. Once a cell: no operations for coefficients, then no operations, then 1 mul. Together 170 operations a cell, a multiplication with the addition behind it counted as two; 96 bytes read, 88 written.
    pub fn spin_coupling(
        coordinates: &[f64],
        material: &[f64],
        matrices: &mut [Batch],
        jacobians: &mut [f64],
    ) {
        mass(coordinates, material, matrices, jacobians);
    }
    /// N_a and ∂N_a/∂(ξ, η, ζ) at a point of the cell; 3 add.
    pub fn shape(at_: [f64; 3], values_: &mut [f64], slopes_: &mut [[f64; 3]]) {
        let [xi, eta, zeta] = at_;
        let N_1_ = 1.0 - xi - eta - zeta;
        values_[0] = N_1_;
        slopes_[0] = [-1.0, -1.0, -1.0];
        values_[1] = xi;
        slopes_[1] = [1.0, 0.0, 0.0];
        values_[2] = eta;
        slopes_[2] = [0.0, 1.0, 0.0];
        values_[3] = zeta;
        slopes_[3] = [0.0, 0.0, 1.0];
    }
    /// The entry of the registry.
    pub const ENTRY: Element = Element {
        origin: Origin {
            name: "tet4",
            title: "Linear tetrahedron, 4 nodes",
            source: "Zienkiewicz, Taylor & Zhu, The Finite Element Method, 7th ed., ch. 6",
            spec: "elements/tet4.toml",
            text: "kind = \"element\"\nname = \"tet4\"\ntitle = \"Linear tetrahedron, 4 nodes\"\nsource = \"Zienkiewicz, Taylor & Zhu, The Finite Element Method, 7th ed., ch. 6\"\ncell = \"tetrahedron\"\n\nnodes = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]\n# Volume coordinates.\nshape = ['1 - xi - eta - zeta', 'xi', 'eta', 'zeta']\n\n# Products of the functions are quadratic.\n[quadrature]\nrule = [\"tetrahedron(4)\"]\ndegree = 2\n\n# Their gradients are constant.\n[quadrature.forms.stiffness]\nrule = [\"tetrahedron(1)\"]\ndegree = 1\n\n[abaqus]\ntypes = [\"C3D4\"]\n\n[gmsh]\ntype = 4\n\n[nastran]\ncard = \"CTETRA\"\n\n[vtk]\ntype = 10\n",
            hash: "2c34cc041a5fa67a72ae47018e5735d4",
        },
        nodes: 4,
        reference_nodes: &[
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ],
        abaqus: &["C3D4"],
        abaqus_order: &[0, 1, 2, 3],
        gmsh: Some((4, &[0, 1, 2, 3])),
        nastran: Some(("CTETRA", &[0, 1, 2, 3])),
        vtk: 10,
        vtk_order: &[0, 1, 2, 3],
        shape,
        faces: &[
            Face {
                nodes: &[0, 1, 2],
                corners: 3,
                origin: [0.0, 0.0, 0.0],
                along: [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
                points: &[
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.6666666666666666,
                            0.16666666666666666,
                            0.16666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [0.0, 1.0], [1.0, 0.0]],
                    },
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.16666666666666666,
                            0.16666666666666666,
                            0.6666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [0.0, 1.0], [1.0, 0.0]],
                    },
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.16666666666666666,
                            0.6666666666666666,
                            0.16666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [0.0, 1.0], [1.0, 0.0]],
                    },
                ],
            },
            Face {
                nodes: &[0, 1, 3],
                corners: 3,
                origin: [0.0, 0.0, 0.0],
                along: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
                points: &[
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.6666666666666666,
                            0.16666666666666666,
                            0.16666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]],
                    },
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.16666666666666666,
                            0.6666666666666666,
                            0.16666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]],
                    },
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.16666666666666666,
                            0.16666666666666666,
                            0.6666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]],
                    },
                ],
            },
            Face {
                nodes: &[0, 2, 3],
                corners: 3,
                origin: [0.0, 0.0, 0.0],
                along: [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
                points: &[
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.6666666666666666,
                            0.16666666666666666,
                            0.16666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [0.0, 1.0], [1.0, 0.0]],
                    },
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.16666666666666666,
                            0.16666666666666666,
                            0.6666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [0.0, 1.0], [1.0, 0.0]],
                    },
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.16666666666666666,
                            0.6666666666666666,
                            0.16666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [0.0, 1.0], [1.0, 0.0]],
                    },
                ],
            },
            Face {
                nodes: &[1, 2, 3],
                corners: 3,
                origin: [1.0, 0.0, 0.0],
                along: [[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]],
                points: &[
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.6666666666666666,
                            0.16666666666666666,
                            0.16666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]],
                    },
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.16666666666666666,
                            0.6666666666666666,
                            0.16666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]],
                    },
                    FacePoint {
                        weight: 0.16666666666666666,
                        values: &[
                            0.16666666666666666,
                            0.16666666666666666,
                            0.6666666666666666,
                        ],
                        slopes: &[[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]],
                    },
                ],
            },
        ],
        forms: &[
            FormKernel {
                form: "stiffness",
                material: &[
                    Variable {
                        name: "E",
                        unit: "Pa",
                        title: "Young's modulus",
                    },
                    Variable {
                        name: "nu",
                        unit: "1",
                        title: "Poisson's ratio",
                    },
                ],
                structure: Structure::Symmetric,
                under_stress: false,
                flops: 543,
                evaluate: stiffness,
            },
            FormKernel {
                form: "stiffening",
                material: &[
                    Variable {
                        name: "E",
                        unit: "Pa",
                        title: "Young's modulus",
                    },
                    Variable {
                        name: "nu",
                        unit: "1",
                        title: "Poisson's ratio",
                    },
                ],
                structure: Structure::Kronecker {
                    pattern: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                },
                under_stress: true,
                flops: 355,
                evaluate: stiffening,
            },
            FormKernel {
                form: "mass",
                material: &[
                    Variable {
                        name: "rho",
                        unit: "kg/m^3",
                        title: "density",
                    },
                ],
                structure: Structure::Kronecker {
                    pattern: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                },
                under_stress: false,
                flops: 170,
                evaluate: mass,
            },
            FormKernel {
                form: "spin_inertia",
                material: &[
                    Variable {
                        name: "rho",
                        unit: "kg/m^3",
                        title: "density",
                    },
                ],
                structure: Structure::Kronecker {
                    pattern: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]],
                },
                under_stress: false,
                flops: 170,
                evaluate: spin_inertia,
            },
            FormKernel {
                form: "spin_coupling",
                material: &[
                    Variable {
                        name: "rho",
                        unit: "kg/m^3",
                        title: "density",
                    },
                ],
                structure: Structure::Kronecker {
                    pattern: [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]],
                },
                under_stress: false,
                flops: 170,
                evaluate: spin_coupling,
            },
        ],
        stresses: &[
            StressKernel {
                stress: "sigma",
                form: "stiffness",
                material: &[
                    Variable {
                        name: "E",
                        unit: "Pa",
                        title: "Young's modulus",
                    },
                    Variable {
                        name: "nu",
                        unit: "1",
                        title: "Poisson's ratio",
                    },
                ],
                points: &[([0.25, 0.25, 0.25], 0.16666666666666666)],
                linear: &[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                flops: 223,
                evaluate: sigma,
            },
        ],
    };
}
