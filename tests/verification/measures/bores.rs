//! What bores yield under loads around them: of a mesh, of its modes, and of modes with static correction.

use std::collections::BTreeSet;

use whirl_solver::contacts::{BoreNodes, HARMONICS, lacking, patterns};
use whirl_solver::mesh::support::{RingSupport, SupportCells};
use whirl_solver::mesh::{Material, Mesh, MeshParts};
use whirl_solver::reduced::{BodyKind, Reduced};
use whirl_solver::reduction::Interface;
use whirl_specs::ELEMENTS;

use super::{Matrices, applied, dofs, near, spec, statics};

/// Two rings below a beam.
fn frame() -> Mesh {
    let support = RingSupport {
        start: 0.02,
        length: 0.16,
        height: 0.015,
        width: 0.02,
        pedestal_height: 0.005,
        rings: vec![0.05, 0.15],
        ring_length: 0.012,
        ring_thickness: 0.006,
        bore_radius: 0.010,
        layers_in_ring: 2,
        layers_between: 2,
        section: SupportCells { height: 1, width: 2, pedestal: 1, around: 16, radial: 1, order: 1 },
        material: Material::isotropic("STEEL", 2e11, 0.3, 7860.0).expect("steel"),
    };
    support.mesh(&ELEMENTS.iter().collect::<Vec<_>>()).expect("a mesh")
}

fn bore(mesh: &Mesh) -> BoreNodes {
    let ring = |place: &str| mesh.node_set(&format!("BORE1_{place}")).expect("a set").to_vec();
    BoreNodes {
        name: "one".into(),
        rings: ["LEFT", "MIDDLE"].map(ring).into(),
        surface: None,
        axis: [0.0; 2],
        pressures: Vec::new(),
    }
}

/// Loads count from the axis of the bore, wherever that is.
#[test]
fn patterns_stand_around_the_axis_of_the_bore() {
    let mesh = frame();
    let own = bore(&mesh);
    let aside = [0.013, -0.007];
    let nodes = mesh.nodes().iter().map(|[x, y, z]| [x + aside[0], y + aside[1], *z]);
    let moved = Mesh::new(MeshParts {
        origin: "moved".into(),
        nodes: nodes.collect(),
        labels: mesh.labels().to_vec(),
        blocks: mesh.blocks().to_vec(),
        materials: mesh.materials().to_vec(),
        node_sets: mesh.node_sets().clone(),
        ..MeshParts::default()
    });
    let found = patterns(&moved.expect("a mesh"), &BoreNodes { axis: aside, ..own.clone() });
    let (found, exact) = (found.expect("patterns"), patterns(&mesh, &own).expect("patterns"));
    assert_eq!(found.len(), exact.len());
    for (found, exact) in found.iter().zip(&exact) {
        assert_eq!((found.harmonic, found.load.len()), (exact.harmonic, exact.load.len()));
        for ((dof, found), (other, exact)) in found.load.iter().zip(&exact.load) {
            // Positions are rounded anew: eps · 0.2 m over the radius of 0.01 m, times the harmonic.
            assert!(dof == other && (found - exact).abs() < 1e-13, "{found} for {exact}");
        }
    }
}

/// With correction the reduced body moves under each load as the mesh does, everywhere; without it much is lacking, as much
/// as is said.
#[test]
fn corrected_modes_answer_loads_on_bores_as_the_mesh_does() {
    let mesh = frame();
    let matrices = Matrices::new(&mesh);
    let own = bore(&mesh);
    let loads = patterns(&mesh, &own).expect("patterns");
    assert_eq!(loads.len(), 2 * (2 * HARMONICS - 1));
    // The mounts stand on a line.
    let held: BTreeSet<usize> =
        ["MOUNTS", "GROUND_SPRINGS"].iter().flat_map(|set| dofs(&mesh, set)).collect();
    let held: Vec<usize> = held.into_iter().collect();
    let mut plain = spec(12);
    plain.held = held.clone();
    let nodes: BTreeSet<usize> = own.rings.iter().flatten().copied().collect();
    plain.nodes = nodes.into_iter().collect();
    let mut corrected = plain.clone();
    corrected.corrections = loads.iter().map(|own| own.load.clone()).collect();
    let of = |spec: &_| {
        let reduced = Reduced::new(BodyKind::Support, &mesh, spec).expect("a body");
        lacking(&mesh, spec, &reduced, std::slice::from_ref(&own)).expect("compliances")[0]
    };
    let (without, with) = (of(&plain), of(&corrected));
    assert!(with.iter().all(|part| *part < 1e-8), "{with:?}");
    assert!(without.iter().skip(2).all(|part| *part > 0.1), "{without:?}");

    let interface =
        Interface { held: &held, corrections: &corrected.corrections, ..Interface::default() };
    let reduced = matrices.solid(&mesh).reduce(&interface, 12).expect("a reduction");
    let few = Interface { held: &held, ..Interface::default() };
    let few = matrices.solid(&mesh).reduce(&few, 12).expect("a reduction");
    assert_eq!(reduced.hertz[..12], few.hertz[..]);
    assert!(reduced.coordinates() > 12 && reduced.coordinates() <= 12 + loads.len());
    // Mass-orthonormal, and K̄ diagonal.
    let mass = reduced.reduce(&matrices.mass);
    let stiffness = reduced.reduce(&matrices.stiffness);
    for i in 0..mass.rows {
        for j in 0..mass.cols {
            let unit = f64::from(u8::from(i == j));
            assert!((mass[(i, j)] - unit).abs() < 1e-8, "{i} {j}: {}", mass[(i, j)]);
            let scale = (reduced.stiffness[(i, i)] * reduced.stiffness[(j, j)]).sqrt();
            let error = (stiffness[(i, j)] - reduced.stiffness[(i, j)]).abs();
            assert!(error < 1e-8 * scale, "{i} {j}: {error}");
        }
    }
    let mut worst = [0.0; HARMONICS];
    for pattern in &loads {
        let mut force = vec![0.0; mesh.dof_count()];
        pattern.load.iter().for_each(|&(dof, value)| force[dof] += value);
        let exact = statics(&matrices, &held, &force);
        let answer = |reduced: &whirl_solver::reduction::CraigBampton| {
            let mut found = vec![0.0; exact.len()];
            for j in 0..reduced.coordinates() {
                let q = applied(&pattern.load, reduced.shapes.col(j)) / reduced.stiffness[(j, j)];
                found.iter_mut().zip(reduced.shapes.col(j)).for_each(|(sum, x)| *sum += q * x);
            }
            found
        };
        near(&answer(&reduced), &exact, 1e-7);
        let (has, full) = (applied(&pattern.load, &answer(&few)), applied(&pattern.load, &exact));
        worst[pattern.harmonic] = f64::max(worst[pattern.harmonic], 1.0 - has / full);
    }
    near(&worst, &without, 1e-7);
}
