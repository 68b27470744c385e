//! S of bodies whose turns are known, and how far those are from round that are not.

use super::*;
use crate::attached::{Disc, PointMass};
use crate::body::{BodySpec, Rayleigh, Retained};
use crate::constraints::Constraints;
use crate::linalg::{congruence, multiply};
use crate::mesh::{Block, Cell, Material, MeanComponent, Mesh, MeshParts, NodeSetMean};
use crate::rigid::RigidBody;

/// Largest |entry| of SᵀX + XS over that of X, of all matrices.
fn left(shaft: &Shaft, s: &Matrix) -> f64 {
    let matrices = [
        &shaft.mass,
        &shaft.stiffness,
        &shaft.damping,
        &shaft.spin_inertia,
        &shaft.spin_net,
        &shaft.spin_coupling,
    ];
    // In coordinates in which M is the identity, as those of tilts and displacements differ in their units.
    let mut lower = Cholesky::new(shaft.size());
    lower.factor(&shaft.mass.data).unwrap();
    let mut scale = Matrix::identity(shaft.size());
    lower.solve_upper_in_place(&mut scale.data);
    let all = matrices.into_iter().map(|x| {
        let turned = multiply(x.view(), s.view());
        let turned = congruence(&turned, &scale);
        let own = congruence(x, &scale);
        // SᵀX = ±(XS)ᵀ.
        let sign = if std::ptr::eq(x, &shaft.spin_coupling) { -1.0 } else { 1.0 };
        let sum =
            Matrix::from_fn(own.rows, own.cols, |i, j| turned[(i, j)] + sign * turned[(j, i)]);
        if own.norm_max() > 0.0 { sum.norm_max() / own.norm_max() } else { 0.0 }
    });
    all.fold(0.0, f64::max)
}

/// A prism of `sectors` around and `layers` long: solid of wedges, or a ring of hexahedra. Lateral places are moved by
/// `shape`.
pub(crate) struct Prism {
    pub(crate) sectors: usize,
    pub(crate) inner: Option<f64>,
    modes: usize,
    pub(crate) shape: fn([f64; 3]) -> [f64; 3],
}

const RADIUS: f64 = 0.02;
pub(crate) const LENGTH: f64 = 0.3;
const LAYERS: usize = 12;

impl Prism {
    pub(crate) fn solid(sectors: usize) -> Prism {
        Prism { sectors, inner: None, modes: 30, shape: |x| x }
    }

    fn mesh(&self) -> Mesh {
        let &Prism { sectors, inner, shape, .. } = self;
        let first = inner.map_or(1, |_| sectors);
        let in_plane = first + sectors;
        let mut nodes = Vec::new();
        for plane in 0..=LAYERS {
            let z = LENGTH * plane as f64 / LAYERS as f64;
            let ring = |radius: f64| {
                let angle = |k: usize| std::f64::consts::TAU * k as f64 / sectors as f64 + 0.3;
                (0..sectors).map(move |k| [radius * angle(k).cos(), radius * angle(k).sin(), z])
            };
            match inner {
                Some(radius) => nodes.extend(ring(radius)),
                None => nodes.push([0.0, 0.0, z]),
            }
            nodes.extend(ring(RADIUS));
        }
        let mut connectivity = Vec::new();
        for plane in 0..LAYERS {
            for k in 0..sectors {
                let next = (k + 1) % sectors;
                for plane in [plane, plane + 1] {
                    let at = |place: usize| plane * in_plane + place;
                    match inner {
                        None => connectivity.extend([at(0), at(first + k), at(first + next)]),
                        Some(_) => {
                            connectivity.extend([at(k), at(first + k), at(first + next), at(next)])
                        }
                    }
                }
            }
        }
        let name = if inner.is_some() { "hex8i" } else { "wedge6" };
        let element = whirl_specs::ELEMENTS.iter().find(|own| own.origin.name == name).unwrap();
        let cells = LAYERS * sectors;
        let count = nodes.len();
        Mesh::new(MeshParts {
            origin: "a prism".to_owned(),
            nodes: nodes.into_iter().map(shape).collect(),
            labels: (1..=count as u64).collect(),
            blocks: vec![Block {
                element,
                material: 0,
                labels: (1..=cells as u64).collect(),
                connectivity,
            }],
            materials: vec![Material::isotropic("STEEL", 200e9, 0.3, 7860.0).unwrap()],
            node_sets: std::collections::BTreeMap::new(),
            element_sets: std::collections::BTreeMap::<String, Vec<Cell>>::new(),
            ties: Vec::new(),
            matrices: None,
        })
        .unwrap()
    }

    /// The mean motions of both ends and the middle; those of the ends are retained along x and y, and the first one does
    /// not turn about the axis nor move along it.
    pub(crate) fn shaft(&self) -> Shaft {
        let mesh = self.mesh();
        let plane = |z: f64| -> NodeSetMean {
            let at = |node: &usize| (mesh.nodes()[*node][2] - z).abs() < 1e-9;
            NodeSetMean::new(&mesh, &(0..mesh.nodes().len()).filter(at).collect::<Vec<_>>())
                .unwrap()
        };
        let means = [0.0, LENGTH / 2.0, LENGTH].map(plane);
        let mut retained = Vec::new();
        let mut constraints = Constraints::new();
        for (mean, motion) in [
            (0, MeanComponent::Displacement(2)),
            (0, MeanComponent::Rotation(2)),
            (0, MeanComponent::Displacement(0)),
            (0, MeanComponent::Displacement(1)),
            (2, MeanComponent::Displacement(0)),
            (2, MeanComponent::Displacement(1)),
        ] {
            if retained.len() < 2 {
                constraints.fix("held", retained.len());
            }
            retained.push(Retained::mean(&means[mean], motion, format!("{mean} {motion:?}")));
        }
        let spec = BodySpec {
            corrections: Vec::new(),
            sections: Vec::new(),
            retained,
            held: Vec::new(),
            modes: self.modes,
            constraints,
            springs: Vec::new(),
            damping: Rayleigh { alpha: 3.0, beta: 1e-6 },
            nodes: Vec::new(),
            stiffening: true,
            means: means.to_vec(),
            memory: 1 << 30,
        };
        Shaft::from_mesh(&mesh, &spec).unwrap()
    }
}

/// Twenty-four modes of a prism are in pairs or still; none is alone.
fn check_round(shaft: &Shaft, called: &str) -> Roundness {
    let found = shaft.roundness().unwrap();
    let s = &found.generator;
    let three = multiply(multiply(s.view(), s.view()).view(), s.view());
    // S³ = −S: turns by whole revolutions.
    let cube = three.data.iter().zip(&s.data).map(|(a, b)| (a + b).abs()).fold(0.0, f64::max);
    let left = left(shaft, s);
    println!("{called}: {left:.1e}, S³ + S {:.1e}, rows {:.1e}", cube / s.norm_max(), found.rows);
    // Rounding of eigenvectors by the stiffest mode over the softest: 1e-16 · 1e4.
    assert!(left < 1e-11 && cube < 1e-9 * s.norm_max() && found.rows < 1e-9, "{called}: {left}");
    assert!(found.alone.is_none() && found.is_round_at(1e4), "{called}: {found:?}");
    assert!(found.splitting < 1e-8 && found.shares.iter().all(|own| own.1 < 1e-8), "{found:?}");
    found
}

#[test]
fn prisms_of_three_sides_or_more_are_exactly_round() {
    for sectors in [3, 4, 6, 8] {
        let shaft = Prism::solid(sectors).shaft();
        let found = check_round(&shaft, &format!("{sectors} sides"));
        // Damped by its stiffness alone, rigid motions have rounding of it.
        let mut damping = shaft.stiffness.clone();
        damping.data.iter_mut().for_each(|own| *own *= 1e-6);
        check_round(&Shaft { damping, ..shaft }, &format!("{sectors} sides, damped by stiffness"));
        // Bending modes with both ends held along x and y, and what is axial and torsional.
        assert!(found.paired.len() == 3 && !found.still.is_empty(), "{found:?}");
    }
}

/// The rows see nothing of it: it turns by twice the angle.
#[test]
fn a_ring_that_turns_oval_is_no_pair() {
    let ring = Prism { inner: Some(0.017), modes: 29, ..Prism::solid(8) };
    let found = check_round(&ring.shaft(), "a thin ring");
    // The mode after these moves sideways: without its partner it would turn into nothing.
    let kept = Prism { modes: 30, ..ring }.shaft();
    let whole = kept.roundness().unwrap();
    assert!(kept.hertz.len() == 31 && whole.alone.is_none() && whole.is_round_at(0.0), "{whole:?}");
    assert_eq!(whole.paired.len(), found.paired.len() + 1);
    let twins = found.still.windows(2).filter(|pair| pair[1] - pair[0] < 1e-6 * pair[1]).count();
    assert!(twins >= 2, "{found:?}");
}

#[test]
fn discs_by_numbers_leave_a_body_round_however_thin() {
    let plain = Prism::solid(6).shaft();
    let mean = plain.measures[1].clone();
    let tilt = mean.rotation.select(&[0, 1], &(0..mean.rotation.cols).collect::<Vec<_>>());
    let twist: Vec<f64> = (0..mean.rotation.cols).map(|j| mean.rotation[(2, j)]).collect();
    // A disc without thickness, of which Y and H have nothing; one next to it; a long one.
    for diametral in [0.5, 0.5004, 3.0] {
        let polar = 0.02;
        let disc = Disc {
            mass: 4.0,
            polar_inertia: polar,
            diametral_inertia: diametral * polar,
            z: mean.centre[2],
            displacement: &mean.displacement,
            tilt: &tilt,
            twist: Some(&twist),
        };
        let found = check_round(&plain.clone().with_disc(&disc), &format!("I_d = {diametral} I_p"));
        // Tilts turn as displacements do, whatever H has of them.
        let rows = [0, 1].map(|i| (0..tilt.cols).map(|j| tilt[(i, j)]).collect::<Vec<f64>>());
        let turned = rows.each_ref().map(|row| found.generator.apply_transpose(row));
        let largest = tilt.norm_max();
        for j in 0..tilt.cols {
            let apart = (turned[0][j] + rows[1][j]).abs().max((turned[1][j] - rows[0][j]).abs());
            assert!(apart < 1e-8 * largest, "{apart}");
        }
    }
}

#[test]
fn rigid_bodies_and_points_turn_by_their_coordinates() {
    let body = RigidBody {
        mass: 4.0,
        polar_inertia: 0.5,
        transverse_inertia: Some(0.25),
        along: true,
        rocks: false,
        centre: [0.0, 0.0, 0.2],
        stiffness: [0.0; 2],
        damping: [0.0; 2],
    };
    let s = body.turning(&[]).roundness().unwrap().generator;
    let exact = |i: usize, j: usize| match (i, j) {
        (1, 0) | (3, 2) => 1.0,
        (0, 1) | (2, 3) => -1.0,
        _ => 0.0,
    };
    for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
        assert!((s[(i, j)] - exact(i, j)).abs() < 1e-14, "{i} {j}: {}", s[(i, j)]);
    }
    let point =
        |stiffness, damping| Shaft::lumped(2.0, stiffness, damping, 0.1).roundness().unwrap();
    assert!(point([3e5; 2], [7.0; 2]).is_round_at(100.0));
    let stiffer = point([3e5, 3.1e5], [7.0; 2]);
    assert!(!stiffer.is_round_at(0.0));
    // 1 : 31/30 about the mean: 2 · ½ · 1/30.5.
    assert!((stiffer.splitting - 1.0 / 30.5).abs() < 1e-9, "{stiffer:?}");
    assert!(!point([3e5; 2], [7.0, 5.0]).is_round_at(0.0));
}

#[test]
fn what_differs_along_x_and_y_is_not_round() {
    let flat = Prism { shape: |[x, y, z]| [x, 0.8 * y, z], ..Prism::solid(8) }.shaft();
    let found = flat.roundness().unwrap();
    // Its lowest bending mode has no partner at its frequency.
    assert!(!found.is_round_at(0.0) && found.alone.is_some(), "{:?}", found.alone);
    // A mass on one side of the axis.
    let plain = Prism::solid(8).shaft();
    let mean = plain.measures[1].clone();
    let node = mean.node_at([0.015, 0.0, mean.centre[2]]);
    let loaded = plain.with_point_mass(&PointMass { mass: 0.5, node: &node, turn: &mean.rotation });
    assert!(!loaded.roundness().unwrap().is_round_at(0.0));
}

/// Nodes off their places by a tenth of a percent of the radius: nearly round, and said to be so far from it.
#[test]
fn a_mesh_without_symmetry_is_round_but_for_its_asymmetry() {
    let small =
        Prism { shape: |x| nudged(1e-4, x), ..Prism::solid(8) }.shaft().roundness().unwrap();
    let large = Prism { shape: |x| nudged(0.1, x), ..Prism::solid(8) }.shaft().roundness().unwrap();
    println!("{:.1e} {:.1e} rows {:.1e}", small.splitting, large.splitting, small.rows);
    assert!(small.is_round_at(1e3) && small.splitting > 1e-7, "{:?}", small.shares);
    assert!(!large.is_round_at(1e3), "{:?}", large.shares);
}

fn nudged(size: f64, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let by = |k: f64| size * RADIUS * (k * x + 1.7 * k * y + 0.6 * k * z).sin();
    [x + by(911.0), y + by(1273.0), z]
}
