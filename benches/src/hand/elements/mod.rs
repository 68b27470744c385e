//! Elements written by hand: trilinear hexahedron, the same with incompatible modes, linear wedge; the quadratic ones in
//! a module of their own.
//!
//! Code that uses all that is known of the forms: the 3 × 3 blocks of an isotropic stiffness all
//! follow from Σ ∇Nₐ ⊗ ∇N_b, of which the upper triangle is summed with gradients scaled by √(w det J);
//! M, Y and H are one scalar matrix with few distinct values, summed one reference direction at a time.
//! As many cells as a register holds go side by side, and nothing is allocated.

mod hex8;
mod isotropic;
mod modes;
pub mod quadratic;
mod space;
mod wedge6;

use whirl_specs::{CellKernel, Element, FormKernel, Origin, Structure, Variable};

/// Trilinear hexahedron, 2 × 2 × 2 Gauss points.
pub static HEX8: Element = hexahedron(
    "hex8",
    "trilinear hexahedron",
    &["C3D8"],
    None,
    None,
    &[
        stiffness(hex8::stiffness, hex8::STIFFNESS_FLOPS),
        MASS_HEX8,
        SPIN_INERTIA_HEX8,
        SPIN_COUPLING_HEX8,
    ],
);

/// Hexahedron with the incompatible modes of Wilson and Taylor.
pub static HEX8I: Element = hexahedron(
    "hex8i",
    "hexahedron with incompatible modes (Wilson, Taylor)",
    &["C3D8I"],
    Some((5, &[0, 1, 2, 3, 4, 5, 6, 7])),
    Some(("CHEXA", &[0, 1, 2, 3, 4, 5, 6, 7])),
    &[
        stiffness(hex8::incompatible_stiffness, hex8::INCOMPATIBLE_FLOPS),
        MASS_HEX8,
        SPIN_INERTIA_HEX8,
        SPIN_COUPLING_HEX8,
    ],
);

/// Linear wedge, 3 × 2 points.
pub static WEDGE6: Element = Element {
    origin: origin("wedge6", "linear wedge"),
    nodes: 6,
    reference_nodes: &wedge6::NODES,
    abaqus: &["C3D6"],
    abaqus_order: &[0, 1, 2, 3, 4, 5],
    gmsh: Some((6, &[0, 1, 2, 3, 4, 5])),
    nastran: Some(("CPENTA", &[0, 1, 2, 3, 4, 5])),
    vtk: 13,
    // VTK lists the lower triangle the other way round.
    vtk_order: &[0, 2, 1, 3, 5, 4],
    shape: wedge6::shape,
    faces: &[],
    forms: &[
        stiffness(wedge6::stiffness, wedge6::STIFFNESS_FLOPS),
        scalar("mass", DOT, wedge6::mass, wedge6::MASS_FLOPS),
        scalar("spin_inertia", LATERAL, wedge6::mass, wedge6::MASS_FLOPS),
        scalar("spin_coupling", QUARTER_TURN, wedge6::mass, wedge6::MASS_FLOPS),
    ],
    stresses: &[],
};

/// All of them.
pub static ELEMENTS: [&Element; 3] = [&HEX8, &HEX8I, &WEDGE6];

const DOT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// A_θᵀA_θ.
const LATERAL: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]];
/// A_θᵀA.
const QUARTER_TURN: [[f64; 3]; 3] = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]];

const MASS_HEX8: FormKernel = scalar("mass", DOT, hex8::mass, hex8::MASS_FLOPS);
const SPIN_INERTIA_HEX8: FormKernel = scalar("spin_inertia", LATERAL, hex8::mass, hex8::MASS_FLOPS);
const SPIN_COUPLING_HEX8: FormKernel =
    scalar("spin_coupling", QUARTER_TURN, hex8::mass, hex8::MASS_FLOPS);

const fn origin(name: &'static str, title: &'static str) -> Origin {
    Origin { name, title, source: "written by hand", spec: "", text: "", hash: "" }
}

const fn hexahedron(
    name: &'static str,
    title: &'static str,
    abaqus: &'static [&'static str],
    gmsh: Option<(u8, &'static [usize])>,
    nastran: Option<(&'static str, &'static [usize])>,
    forms: &'static [FormKernel],
) -> Element {
    Element {
        origin: origin(name, title),
        nodes: 8,
        reference_nodes: &hex8::NODES,
        abaqus,
        abaqus_order: &[0, 1, 2, 3, 4, 5, 6, 7],
        gmsh,
        nastran,
        vtk: 12,
        vtk_order: &[0, 1, 2, 3, 4, 5, 6, 7],
        shape: hex8::shape,
        faces: &[],
        forms,
        stresses: &[],
    }
}

const fn stiffness(evaluate: CellKernel, flops: usize) -> FormKernel {
    FormKernel {
        form: "stiffness",
        material: &[
            Variable { name: "E", unit: "Pa", title: "Young's modulus" },
            Variable { name: "nu", unit: "1", title: "Poisson's ratio" },
        ],
        structure: Structure::Symmetric,
        under_stress: false,
        flops,
        evaluate,
    }
}

const fn scalar(
    form: &'static str,
    pattern: [[f64; 3]; 3],
    evaluate: CellKernel,
    flops: usize,
) -> FormKernel {
    FormKernel {
        form,
        material: &[Variable { name: "rho", unit: "kg/m^3", title: "density" }],
        structure: Structure::Kronecker { pattern },
        under_stress: false,
        flops,
        evaluate,
    }
}
