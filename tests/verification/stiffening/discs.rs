//! Meshed discs against their moments of inertia.

use std::collections::BTreeMap;

use nalgebra::DVector;
use whirl_solver::assembly::mass_properties;
use whirl_solver::attached::Disc;
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::{Block, Mesh, MeshParts};
use whirl_solver::shaft::Shaft;

use super::{dense, elements, mean_motion, sparse, spec, steel, turning};

const RADIUS: f64 = 0.2;
const THICKNESS: f64 = 0.02;
const DENSITY: f64 = 7860.0;

/// A disc about z, its middle at z = 0.
fn disc() -> Mesh {
    let disc = SolidShaft {
        length: THICKNESS,
        diameter: 2.0 * RADIUS,
        supports: vec![0.5 * THICKNESS],
        support_length: 0.5 * THICKNESS,
        layers_in_support: 2,
        layers_between: 1,
        loads: Vec::new(),
        sections: Vec::new(),
        section: SectionCells { sectors: 16, rings: 5, order: 1 },
        material: steel(DENSITY),
    };
    disc.mesh(&elements()).expect("a mesh")
}

fn altered(mesh: &Mesh, change: impl FnOnce(&mut MeshParts)) -> Mesh {
    let mut parts = MeshParts {
        origin: mesh.origin().to_owned(),
        nodes: mesh.nodes().to_vec(),
        labels: mesh.labels().to_vec(),
        blocks: mesh.blocks().to_vec(),
        materials: mesh.materials().to_vec(),
        node_sets: BTreeMap::new(),
        element_sets: BTreeMap::new(),
        ties: Vec::new(),
        matrices: None,
    };
    change(&mut parts);
    Mesh::new(parts).expect("a mesh")
}

/// η of a rigid motion: modes rest, the retained dofs follow.
fn rigid(
    shaft: &Shaft,
    dofs: &[usize],
    modes: usize,
    motion: impl Fn(usize) -> [f64; 3],
) -> DVector<f64> {
    DVector::from_fn(shaft.size(), |j, _| match j.checked_sub(modes) {
        Some(j) => motion(dofs[j] / 3)[dofs[j] % 3],
        None => 0.0,
    })
}

/// Three nodes that hold a free body where it is, and no straighter.
fn three(mesh: &Mesh) -> Vec<usize> {
    let far = |[x, y]: [f64; 2]| {
        let distance = |a: &[f64; 3]| (a[0] - x).powi(2) + (a[1] - y).powi(2) + a[2].powi(2);
        let nodes = mesh.nodes().iter().enumerate();
        nodes.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).expect("a node").0
    };
    let (c, s) = (0.5 * RADIUS, 0.866 * RADIUS);
    let nodes = [[RADIUS, 0.0], [-c, s], [-c, -s]].map(far);
    nodes.iter().flat_map(|node| [3 * node, 3 * node + 1, 3 * node + 2]).collect()
}

#[test]
fn a_free_disc_that_tilts_has_y_less_g_of_its_moments_of_inertia() {
    let mesh = disc();
    let middle = mass_properties(&mesh).expect("a mass").centre[2];
    let mesh = altered(&mesh, |parts| parts.nodes.iter_mut().for_each(|x| x[2] -= middle));
    let dofs = three(&mesh);
    let shaft = Shaft::from_mesh(&mesh, &spec(&dofs, 0, 3, Vec::new())).expect("a body");
    let (mass, polar) =
        (std::f64::consts::PI * RADIUS.powi(2) * THICKNESS * DENSITY, RADIUS.powi(2) / 2.0);
    let (polar, diametral) = (mass * polar, mass * (polar / 2.0 + THICKNESS.powi(2) / 12.0));
    let own = mass_properties(&mesh).expect("a mass").second_moment;
    let [y, g] = [&shaft.spin_inertia, &shaft.spin_stiffening()].map(dense);
    for axis in [0, 1] {
        let tilt = rigid(&shaft, &dofs, 3, |node| {
            let [x, y, z] = mesh.nodes()[node];
            if axis == 0 { [0.0, -z, y] } else { [z, 0.0, -x] }
        });
        let of = |matrix: &nalgebra::DMatrix<f64>| tilt.dot(&(matrix * &tilt));
        // ∫σ_xx dV = ∫ρx² dV, in the mesh as in the disc.
        let square = own[1 - axis][1 - axis];
        assert!((of(&g) / square - 1.0).abs() < 1e-8, "{} {square}", of(&g));
        let (found, expected) = (of(&y) - of(&g), diametral - polar);
        assert!((found / expected - 1.0).abs() < 5e-3, "{found} {expected}");
        assert!((of(&dense(&shaft.mass)) / diametral - 1.0).abs() < 5e-3);
    }
    // A shift of the whole is no strain.
    let shift = rigid(&shaft, &dofs, 3, |_| [1.0, 0.0, 0.0]);
    assert!((&g * &shift).amax() < 1e-9 * g.amax());
}

#[test]
fn a_disc_off_the_axis_is_stressed_as_one_on_it() {
    let centred = disc();
    let off = altered(&centred, |parts| parts.nodes.iter_mut().for_each(|x| x[0] += 0.3 * RADIUS));
    let dofs = three(&centred);
    let stiffening = |mesh: &Mesh| {
        let shaft = Shaft::from_mesh(mesh, &spec(&dofs, 0, 3, Vec::new())).expect("a body");
        dense(&shaft.spin_stiffening())
    };
    let [centred, off] = [&centred, &off].map(stiffening);
    // Shapes of modes may differ in their signs, so that those of the retained dofs are compared.
    let [centred, off] = [centred, off].map(|g| g.view((3, 3), (9, 9)).into_owned());
    assert!(
        (&centred - &off).amax() < 1e-6 * centred.amax(),
        "{}",
        (&centred - &off).amax() / centred.amax()
    );
}

/// A disc at the end of a thin shaft, z from 0 to 0.3 m.
fn overhung() -> Mesh {
    let whole = SolidShaft {
        length: 0.3,
        diameter: 0.12,
        supports: vec![0.29],
        support_length: 0.02,
        layers_in_support: 2,
        layers_between: 14,
        loads: Vec::new(),
        sections: Vec::new(),
        section: SectionCells { sectors: 8, rings: 6, order: 1 },
        material: steel(DENSITY),
    };
    let whole = whole.mesh(&elements()).expect("a mesh");
    altered(&whole, |parts| {
        // Of the shaft only the wedges about the axis are left.
        let (mut disc, mut shaft) = (Vec::new(), Vec::new());
        for block in &parts.blocks {
            let size = block.element.nodes;
            let kept = |cell: &&[usize], in_disc: bool| {
                let far = cell.iter().all(|&node| parts.nodes[node][2] > 0.2799);
                far == in_disc && (far || size == 6)
            };
            for (in_disc, blocks) in [(true, &mut disc), (false, &mut shaft)] {
                let cells = block.connectivity.chunks(size).filter(|cell| kept(cell, in_disc));
                let connectivity: Vec<usize> = cells.flatten().copied().collect();
                let labels = (1..=(connectivity.len() / size) as u64).collect();
                let material = usize::from(in_disc);
                if !connectivity.is_empty() {
                    blocks.push(Block { element: block.element, material, labels, connectivity });
                }
            }
        }
        parts.blocks = disc.into_iter().chain(shaft).collect();
        parts.materials = vec![steel(DENSITY), steel(DENSITY)];
        parts.materials[1].name = "DISC".to_owned();
        let mut used = vec![None; parts.nodes.len()];
        let mut nodes = Vec::new();
        for node in parts.blocks.iter_mut().flat_map(|block| &mut block.connectivity) {
            *node = *used[*node].get_or_insert_with(|| {
                nodes.push(parts.nodes[*node]);
                nodes.len() - 1
            });
        }
        parts.labels = (1..=nodes.len() as u64).collect();
        parts.nodes = nodes;
    })
}

/// The rotor with its disc meshed, and with one by numbers on the same cells with hardly any mass.
#[test]
fn an_overhung_disc_whirls_as_its_moments_of_inertia_say() {
    whirls_as_by_numbers(100.0, 1e-4, 5e-3);
}

/// The same of a disc a thousand times stiffer, whose cells have no mass at all where its numbers take their place.
#[test]
fn a_disc_that_is_a_thousand_times_stiffer_whirls_as_a_rigid_one() {
    whirls_as_by_numbers(1000.0, 0.0, 5e-3);
}

/// `stiffer`: E of the disc over that of the shaft; `left`: what is left of its cells' density beside its numbers.
fn whirls_as_by_numbers(stiffer: f64, left: f64, tolerance: f64) {
    let mesh = altered(&overhung(), |parts| {
        *parts.materials[1].properties.get_mut("E").expect("a modulus") *= stiffer;
    });
    let nodes = |keep: &dyn Fn(&[f64; 3]) -> bool| -> Vec<usize> {
        (0..mesh.nodes().len()).filter(|&node| keep(&mesh.nodes()[node])).collect()
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let root = nodes(&|x| near(x[2], 0.0));
    let ends =
        nodes(&|x| near(x[0], 0.0) && near(x[1], 0.0) && (near(x[2], 0.28) || near(x[2], 0.3)));
    // Points that turn with the disc.
    let rim = nodes(&|x| near(x[2], 0.29) && near(x[1], 0.0) && x[0].abs() > 0.055);
    assert_eq!((root.len(), ends.len(), rim.len()), (9, 2, 2));
    let held = root.iter().flat_map(|node| [3 * node, 3 * node + 1, 3 * node + 2]);
    let dofs: Vec<usize> = held
        .chain(ends.iter().flat_map(|node| [3 * node, 3 * node + 1]))
        .chain(rim.iter().map(|node| 3 * node + 1))
        .collect();
    let middle = nodes(&|x| near(x[2], 0.29));
    let spec = spec(&dofs, 27, 16, middle.clone());
    let meshed = Shaft::from_mesh(&mesh, &spec).expect("a body");

    let light = altered(&mesh, |parts| {
        *parts.materials[1].properties.get_mut("rho").expect("a density") *= left;
    });
    let (all, rest) =
        (mass_properties(&mesh).expect("a mass"), mass_properties(&light).expect("a mass"));
    let second = |i: usize| all.second_moment[i][i] - rest.second_moment[i][i];
    let mass = all.mass - rest.mass;
    let about = second(2) - mass * 0.29_f64.powi(2);
    let bare = Shaft::from_mesh(&light, &spec).expect("a body");
    let places: Vec<usize> = (0..middle.len()).collect();
    let [x, y, z, alpha, beta, twist] = mean_motion(&bare, &places).map(|row| row.transpose());
    let by_numbers = bare.with_disc(&Disc {
        mass,
        polar_inertia: second(0) + second(1),
        diametral_inertia: second(0) + about,
        z: 0.29,
        displacement: &sparse(&nalgebra::DMatrix::from_rows(&[x, y, z])),
        tilt: &sparse(&nalgebra::DMatrix::from_rows(&[alpha, beta])),
        twist: Some(twist.as_slice()),
    });
    for speed in [0.0, 500.0, 3000.0] {
        // Forward and backward whirl of the two bending modes, and the turn of the disc against its root.
        let count = 5;
        let (found, expected) = (turning(&meshed, speed), turning(&by_numbers, speed));
        println!("{speed}: {:?} {:?}", &found[..6], &expected[..6]);
        let bends = |all: &[f64]| all[..count].to_vec();
        for (found, expected) in bends(&found).iter().zip(bends(&expected)) {
            assert!((found / expected - 1.0).abs() < tolerance, "{speed}: {found} {expected}");
        }
    }
}
