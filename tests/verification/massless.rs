//! Parts without mass and very stiff ones: M is positive semidefinite, and K spans more digits.

use std::collections::BTreeSet;

use whirl_solver::assembly::{assemble, mass_properties};
use whirl_solver::error::ReductionError;
use whirl_solver::linalg::LowerTriangle;
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::{Material, Mesh};
use whirl_solver::reduction::{CraigBampton, Interface, Row, Solid};
use whirl_specs::{ELEMENTS, Element};

const DENSITY: f64 = 7860.0;

fn steel(name: &str, density: f64) -> Material {
    Material::isotropic(name, 2e11, 0.3, density).expect("a material")
}

/// A shaft whose first quarter has another density.
fn shaft(layers: usize, density: f64) -> Mesh {
    let shaft = SolidShaft {
        length: 0.4,
        diameter: 0.03,
        supports: vec![0.02, 0.38],
        support_length: 0.02,
        layers_in_support: 2,
        layers_between: layers,
        loads: Vec::new(),
        sections: Vec::new(),
        section: SectionCells { sectors: 8, rings: 2, order: 1 },
        material: steel("STEEL", DENSITY),
    };
    let elements: Vec<&'static Element> = ELEMENTS.iter().collect();
    let mesh = shaft.mesh(&elements).expect("a mesh");
    let nodes = mesh.nodes().to_vec();
    let blocks = mesh.blocks().to_vec();
    let near = |cell: whirl_solver::mesh::Cell| {
        let block = &blocks[cell.block];
        let size = block.element.nodes;
        let own = &block.connectivity[size * cell.cell..size * (cell.cell + 1)];
        own.iter().all(|&node| nodes[node][2] < 0.1 + 1e-9)
    };
    mesh.with_material(&steel("LIGHT", density), near).expect("a mesh")
}

/// Reduced with the ends of the centre line retained: as nodes, or one of them as the mean of its section.
fn reduced(mesh: &Mesh, modes: usize, mean: bool) -> Result<CraigBampton, ReductionError> {
    let stiffness = assemble(mesh, "stiffness").expect("K");
    let mass = assemble(mesh, "mass").expect("M");
    let solid = Solid {
        stiffness: &stiffness,
        mass: &mass,
        coordinates: mesh.nodes(),
        slots: &[],
        ties: &[],
        memory: usize::MAX,
    };
    let at = |z: f64| -> Vec<usize> {
        let near = |node: &usize| (mesh.nodes()[*node][2] - z).abs() < 1e-9;
        (0..mesh.nodes().len()).filter(near).collect()
    };
    let mut retained: Vec<Row> = Vec::new();
    // A whole section, so that nothing turns.
    for node in at(0.4) {
        retained.extend((0..3).map(|i| vec![(3 * node + i, 1.0)]));
    }
    let first = at(0.0);
    let share = 1.0 / first.len() as f64;
    for i in 0..2 {
        retained.push(match mean {
            true => first.iter().map(|node| (3 * node + i, share)).collect(),
            false => vec![(3 * first[0] + i, 1.0)],
        });
    }
    solid.reduce(&Interface { retained: &retained, ..Interface::default() }, modes)
}

/// ω² M x = K x of the modes, also in the rows of what has no mass; the largest error against the largest force.
fn residual(mesh: &Mesh, reduced: &CraigBampton) -> f64 {
    let lower = |form: &str| -> LowerTriangle {
        assemble(mesh, form).expect("a matrix").lower().expect("symmetric").into_owned()
    };
    let (stiffness, mass) = (lower("stiffness"), lower("mass"));
    let inner: Vec<bool> = {
        let mut inner = vec![true; stiffness.size];
        reduced.retained.iter().flatten().for_each(|&(dof, _)| inner[dof] = false);
        inner
    };
    let mut worst: f64 = 0.0;
    for (mode, hertz) in reduced.hertz.iter().enumerate() {
        let shape = reduced.shapes.col(mode);
        let mut force = vec![0.0; shape.len()];
        stiffness.multiply(shape, &mut force);
        let mut inertia = vec![0.0; shape.len()];
        mass.multiply(shape, &mut inertia);
        let square = (std::f64::consts::TAU * hertz).powi(2);
        let most = inertia.iter().fold(0.0, |most: f64, x| most.max((square * x).abs()));
        for dof in (0..shape.len()).filter(|&dof| inner[dof]) {
            worst = worst.max((force[dof] - square * inertia[dof]).abs() / most);
        }
    }
    worst
}

/// Of 1e-3 and 1e-6 of the density the frequencies differ from those of none by the same, a thousandth of it.
#[test]
fn modes_of_a_part_without_mass_are_the_limit_of_small_densities() {
    // By iteration, by decomposition, and by that with constraints.
    for (layers, modes, mean) in [(22, 12, false), (22, 12, true), (3, 12, false), (3, 12, true)] {
        let [none, tiny, small] = [0.0, 1e-6, 1e-3].map(|part| {
            let mesh = shaft(layers, part * DENSITY);
            let reduced = reduced(&mesh, modes, mean).expect("modes");
            if part == 0.0 {
                // Converged pairs have residuals of 1e-10 of θ; K amplifies what is left of the fastest motions by far.
                let left = residual(&mesh, &reduced);
                assert!(left < 1e-4, "{layers} {mean}: {left}");
            }
            reduced
        });
        for i in 0..modes {
            let off = |own: &CraigBampton| 1.0 - own.hertz[i] / none.hertz[i];
            let (by_tiny, by_small) = (off(&tiny), off(&small));
            // First order in the density: its second order is below a hundredth, and eigenvalues are known to 1e-11.
            assert!(by_small > 1e-9 && by_small < 2e-2, "{i}: {by_small}");
            let wanted = 1e-3 * by_small;
            assert!((by_tiny - wanted).abs() < 0.02 * wanted + 1e-9, "{i}: {by_tiny} for {wanted}");
        }
        assert!(none.mass.data.iter().all(|value| value.is_finite()));
    }
}

/// There are as many modes as motions with mass.
#[test]
fn no_modes_are_made_of_motions_without_mass() {
    let mesh = shaft(3, 0.0);
    for mean in [false, true] {
        let Err(ReductionError::TooManyModes { available, .. }) = reduced(&mesh, 400, mean) else {
            panic!("of all modes some have no mass")
        };
        let heavy: BTreeSet<usize> = mesh
            .blocks()
            .iter()
            .filter(|block| mesh.materials()[block.material].name == "STEEL")
            .flat_map(|block| block.connectivity.iter().copied())
            .filter(|&node| mesh.nodes()[node][2] < 0.4 - 1e-9)
            .collect();
        assert_eq!(available, 3 * heavy.len(), "{mean}");
        assert_eq!(reduced(&mesh, available, mean).expect("all of them").hertz.len(), available);
    }
}

#[test]
fn what_has_no_mass_has_a_volume() {
    let [light, heavy] = [0.0, DENSITY].map(|rho| mass_properties(&shaft(10, rho)).expect("sums"));
    assert!((light.volume / heavy.volume - 1.0).abs() < 1e-12);
    assert!(light.mass < 0.9 * heavy.mass && light.mass > 0.7 * heavy.mass);
}
