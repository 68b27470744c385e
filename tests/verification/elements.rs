//! Generated elements: against textbook integrals and the generator's own definitions, patch test,
//! zero-energy modes, convergence, locking, inverted cells.

mod bar;
mod convergence;
mod dropped;
mod files;
mod gradients;
mod patches;
mod stress;

pub(crate) use patches::block;

use std::collections::BTreeMap;
use std::sync::LazyLock;

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use whirl_benches::hand;
use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::element::ElementSpec;
use whirl_codegen::kinds::element::direct;
use whirl_codegen::kinds::form::FormSpec;
use whirl_specs::{ELEMENTS, Element, Structure};

use crate::reference_kernels;

const FORMS: [&str; 2] = [
    include_str!("../../specs/forms/elasticity.toml"),
    include_str!("../../specs/forms/inertia.toml"),
];

/// Steel.
fn property(name: &str) -> f64 {
    match name {
        "E" => 200e9,
        "nu" => 0.3,
        "rho" => 7860.0,
        _ => panic!("no value for the property {name}"),
    }
}

fn element(name: &str) -> &'static Element {
    ELEMENTS.iter().find(|element| element.origin.name == name).expect("a shipped element")
}

/// The matrix of one cell by the generated kernel, all dofs, and the smallest det J.
fn generated(element: &Element, form: &str, nodes: &[[f64; 3]]) -> (DMatrix<f64>, f64) {
    let kernel = element.form(form).unwrap();
    let material: Vec<f64> = kernel.material.iter().map(|m| property(m.name)).collect();
    let given = given(element, form, nodes);
    let (matrix, det) = reference_kernels::kernel(element, form, &material, &given);
    let full = match kernel.structure {
        Structure::Kronecker { pattern } => {
            let pattern = DMatrix::from_fn(3, 3, |i, j| pattern[i][j]);
            matrix.kronecker(&pattern)
        }
        _ => matrix,
    };
    (full, det)
}

/// A displacement of nodes that is no rigid motion and strains no two points alike.
fn displacement(nodes: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let wild = |[x, y, z]: &[f64; 3]| {
        [3.0 * x + 2.0 * x * y - z, y * z - 0.5 * x, 4.0 * z - x * z + 0.7 * x * x]
            .map(|u| 1e-3 * u)
    };
    nodes.iter().map(wild).collect()
}

/// What a kernel is given of a cell: coordinates, and displacements behind them under a stress.
fn given(element: &Element, form: &str, nodes: &[[f64; 3]]) -> Vec<f64> {
    let mut given = nodes.as_flattened().to_vec();
    if element.form(form).unwrap().under_stress {
        given.extend(displacement(nodes).as_flattened());
    }
    given
}

/// The specs of the elements and of the forms, read once.
static SPECS: LazyLock<(BTreeMap<&str, ElementSpec>, [FormSpec; 2])> = LazyLock::new(|| {
    let read = |element: &Element| {
        let source = Source::new("element.toml", element.origin.text);
        (element.origin.name, ElementSpec::read_unproved(&source).unwrap())
    };
    let forms = FORMS.map(|text| FormSpec::read(&Source::new("form.toml", text)).unwrap());
    (ELEMENTS.iter().map(read).collect(), forms)
});

/// What the spec of an element says.
fn spec(element: &Element) -> &'static ElementSpec {
    &SPECS.0[element.origin.name]
}

/// The matrix of a cell straight from a spec, without generated code.
fn direct(element: &ElementSpec, form: &str, nodes: &[[f64; 3]]) -> DMatrix<f64> {
    let found = SPECS.1.iter().find_map(|s| Some((s, s.forms.iter().find(|f| f.name == form)?)));
    let (spec, form) = found.expect("a shipped form");
    let material: BTreeMap<String, f64> =
        spec.material.iter().map(|p| (p.name.clone(), property(&p.name))).collect();
    let cell = direct::evaluate(element, spec, form, [nodes, &displacement(nodes)], &material);
    DMatrix::from_row_slice(cell.size, cell.size, &cell.entries)
}

/// The reference cell in metres, nodes displaced by `shifts` of half the smallest distance between nodes.
fn displaced(element: &Element, shifts: &[f64]) -> Vec<[f64; 3]> {
    let distance = |a: &[f64; 3], b: &[f64; 3]| -> f64 {
        (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
    };
    let nodes = element.reference_nodes;
    let apart = (1..nodes.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    let least = apart.map(|(a, b)| distance(&nodes[a], &nodes[b])).fold(f64::INFINITY, f64::min);
    let mut shifts = shifts.iter().cycle();
    let mut shift = || 0.5 * least * shifts.next().expect("it is endless");
    nodes.iter().map(|node| node.map(|x| x + shift())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn kernels_equal_textbook_integrals_and_hand_written_ones(
        shifts in prop::array::uniform24(-0.15..0.15_f64),
    ) {
        let references: [(&str, &Element, reference_kernels::Shapes, bool); 3] = [
            ("hex8", &hand::elements::HEX8, reference_kernels::hexahedron, false),
            ("hex8i", &hand::elements::HEX8I, reference_kernels::hexahedron, true),
            ("wedge6", &hand::elements::WEDGE6, reference_kernels::wedge, false),
        ];
        for (name, reference, shapes, modes) in references {
            let element = element(name);
            let nodes = displaced(element, &shifts);
            let x = nodes.as_flattened();
            let (k, det) = generated(element, "stiffness", &nodes);
            let textbook = reference_kernels::stiffness(reference, shapes, modes, x);
            let (by_hand, det_by_hand) = generated(reference, "stiffness", &nodes);
            // A few hundred terms, and the condensation, at rounding level.
            prop_assert!((&k - &textbook).amax() < 1e-12 * textbook.amax(), "{name}");
            prop_assert!((&k - &by_hand).amax() < 1e-12 * textbook.amax(), "{name}");
            prop_assert!((det / det_by_hand - 1.0).abs() < 1e-12, "{name}");
            let scalar = reference_kernels::mass(reference, shapes, x);
            for form in ["mass", "spin_inertia", "spin_coupling"] {
                let (m, _) = generated(element, form, &nodes);
                let (by_hand, _) = generated(reference, form, &nodes);
                prop_assert!((&m - &by_hand).amax() < 1e-13 * scalar.amax(), "{name} {form}");
            }
        }
    }

}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    /// The generated kernels of these are held against their definitions below.
    #[test]
    fn quadratic_kernels_equal_hand_written_ones(shifts in prop::array::uniform24(-0.1..0.1_f64)) {
        for reference in hand::elements::quadratic::ELEMENTS {
            let element = element(reference.origin.name);
            let nodes = displaced(element, &shifts);
            for form in ["stiffness", "mass"] {
                let (made, det) = generated(element, form, &nodes);
                let (by_hand, det_by_hand) = generated(reference, form, &nodes);
                let error = (&made - &by_hand).amax() / by_hand.amax();
                // A thousand terms at rounding level.
                prop_assert!(error < 1e-12, "{} {form}: {error:.1e}", reference.origin.name);
                prop_assert!((det / det_by_hand - 1.0).abs() < 1e-12, "{}", reference.origin.name);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..ProptestConfig::default() })]

    /// Holds of every element and form in the specs, whatever they are.
    #[test]
    fn kernels_equal_their_definitions(shifts in prop::array::uniform24(-0.1..0.1_f64)) {
        for element in ELEMENTS {
            let nodes = displaced(element, &shifts);
            for form in element.forms {
                let (matrix, _) = generated(element, form.form, &nodes);
                let expected = direct(spec(element), form.form, &nodes);
                let error = (matrix - &expected).amax() / expected.amax();
                prop_assert!(error < 1e-12, "{} {}: {error:.1e}", element.origin.name, form.form);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn a_distorted_cell_has_six_zero_energy_modes_and_no_more(
        shifts in prop::array::uniform24(-0.15..0.15_f64),
    ) {
        for element in ELEMENTS {
            let name = element.origin.name;
            let (k, _) = generated(element, "stiffness", &displaced(element, &shifts));
            // Every entry is a sum over points and components of strain, and some work on each: rounding
            // moves the matrix by at most so much in norm, and its eigenvalues by no more (Weyl).
            let terms = 6 * spec(element).rule("stiffness").points.len() + 64;
            let rounding = (k.nrows() * terms) as f64 * f64::EPSILON * k.amax();
            let mut values: Vec<f64> = k.symmetric_eigenvalues().iter().copied().collect();
            values.sort_by(f64::total_cmp);
            prop_assert!(values[..6].iter().all(|v| v.abs() < rounding), "{name}: {values:?}");
            // Above zero whatever rounding did.
            prop_assert!(values[6] > rounding, "{name}: {values:?}");
        }
    }
}

#[test]
fn the_registry_says_what_the_hand_written_elements_say() {
    for reference in hand::elements::ELEMENTS {
        let element = ELEMENTS
            .iter()
            .find(|element| element.abaqus == reference.abaqus)
            .expect("an element for every Abaqus type");
        assert_eq!(element.nodes, reference.nodes);
        assert_eq!(element.reference_nodes, reference.reference_nodes);
        assert_eq!(element.abaqus_order, reference.abaqus_order);
        assert_eq!(element.nastran, reference.nastran);
        assert_eq!(element.vtk, reference.vtk);
        assert_eq!(element.vtk_order, reference.vtk_order);
        for kernel in reference.forms {
            let made = element.form(kernel.form).expect("the same forms");
            assert_eq!(made.structure, kernel.structure, "{}", kernel.form);
            let names = |k: &whirl_specs::FormKernel| -> Vec<_> {
                k.material.iter().map(|m| (m.name, m.unit)).collect()
            };
            assert_eq!(names(made), names(kernel));
        }
    }
}

#[test]
fn inertia_is_symmetric_and_its_coupling_skew() {
    for element in ELEMENTS {
        let nodes = displaced(element, &[0.05, -0.1, 0.02, 0.08, -0.04]);
        for (form, sign) in
            [("stiffness", 1.0), ("mass", 1.0), ("spin_inertia", 1.0), ("spin_coupling", -1.0)]
        {
            let matrix = direct(spec(element), form, &nodes);
            let error = (&matrix - matrix.transpose() * sign).amax();
            assert!(error <= 1e-13 * matrix.amax(), "{} {form}", element.origin.name);
            let (matrix, _) = generated(element, form, &nodes);
            assert_eq!(matrix, matrix.transpose() * sign);
        }
    }
}

/// x₀ᵀYx₀ = ρ ∫(x² + y²) dV, the same from M for a turn about z, and x₀ᵀH of a turn is M's.
#[test]
fn a_rigid_turn_has_the_polar_moment_of_inertia() {
    for element in ELEMENTS {
        // An affine image of the reference cell, where the integral follows from its monomials.
        let cell = spec(element).cell;
        let (shift, side) = ([0.3, -0.2, 0.1], [0.05, 0.04, 0.03]);
        let nodes: Vec<[f64; 3]> = (element.reference_nodes.iter())
            .map(|node| std::array::from_fn(|i| shift[i] + side[i] * node[i]))
            .collect();
        let integral = |powers| {
            let exact = cell.monomial(powers);
            exact.numer().to_string().parse::<f64>().unwrap()
                / exact.denom().to_string().parse::<f64>().unwrap()
        };
        let volume = integral([0, 0, 0]);
        let square = |axis: usize| {
            let [one, two] = [1, 2].map(|power| {
                let mut powers = [0; 3];
                powers[axis] = power;
                integral(powers)
            });
            let (c, s) = (shift[axis], side[axis]);
            c * c * volume + 2.0 * c * s * one + s * s * two
        };
        let scale = property("rho") * side.iter().product::<f64>();
        let expected = scale * (square(0) + square(1));
        let x0 = DVector::from_iterator(3 * nodes.len(), nodes.iter().flatten().copied());
        let turned = DVector::from_iterator(
            3 * nodes.len(),
            nodes.iter().flat_map(|[x, y, _]| [-y, *x, 0.0]),
        );
        let [y, m, h] = ["spin_inertia", "mass", "spin_coupling"]
            .map(|form| generated(element, form, &nodes).0);
        for (what, found) in [
            ("x0 Y x0", x0.dot(&(y * &x0))),
            ("turn M turn", turned.dot(&(m * &turned))),
            ("x0 H turn", x0.dot(&(h * &turned))),
        ] {
            let error = (found / expected - 1.0).abs();
            assert!(error < 1e-13, "{} {what}: {error:.1e}", element.origin.name);
        }
    }
}

#[test]
fn an_inverted_cell_is_reported_by_its_determinant() {
    for element in ELEMENTS {
        let mirrored: Vec<[f64; 3]> =
            element.reference_nodes.iter().map(|[x, y, z]| [-x, *y, *z]).collect();
        for form in element.forms {
            let (_, det) = generated_det(element, form.form, &mirrored);
            assert!(det <= 0.0, "{} {}: {det}", element.origin.name, form.form);
            let flat: Vec<[f64; 3]> =
                element.reference_nodes.iter().map(|[x, y, _]| [*x, *y, 0.0]).collect();
            let (_, det) = generated_det(element, form.form, &flat);
            assert!(det <= 0.0, "{} {}: {det}", element.origin.name, form.form);
        }
    }
}

/// One corner pushed through the opposite face: det J changes its sign within the cell.
#[test]
fn a_partly_inverted_cell_is_reported_too() {
    let element = element("hex8i");
    let mut nodes = element.reference_nodes.to_vec();
    nodes[6] = [-1.5, -1.5, -1.5];
    assert!(generated_det(element, "stiffness", &nodes).1 < 0.0);
    nodes[6] = [0.9, 1.1, 0.9];
    assert!(generated_det(element, "stiffness", &nodes).1 > 0.0);
}

/// The stored values as the kernel gives them, which may not be numbers.
fn generated_det(element: &Element, form: &str, nodes: &[[f64; 3]]) -> (Vec<f64>, f64) {
    let kernel = element.form(form).unwrap();
    let material: Vec<f64> = kernel.material.iter().map(|m| property(m.name)).collect();
    kernel.of_cell(&given(element, form, nodes), &material)
}
