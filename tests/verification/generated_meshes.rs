//! Meshes made from dimensions: the reference bodies, and bodies of other dimensions.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use whirl_benches::hand::elements::ELEMENTS;
use whirl_solver::assembly::{assemble, mass_properties};
use whirl_solver::mesh::crank::CrankThrow;
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::support::{RingSupport, SupportCells};
use whirl_solver::mesh::{Block, Material, Mesh};
use whirl_solver::reduction::Solid;

use crate::bodies::reference;

fn steel() -> Material {
    Material::isotropic("STEEL", 200e9, 0.3, 7860.0).unwrap()
}

fn shaft() -> SolidShaft {
    SolidShaft {
        length: 1.404,
        diameter: 0.068,
        supports: vec![0.024, 0.476, 0.928, 1.380],
        support_length: 0.025,
        layers_in_support: 2,
        layers_between: 22,
        loads: vec![0.25, 0.702, 1.154],
        sections: Vec::new(),
        section: SectionCells::default(),
        material: steel(),
    }
}

fn support() -> RingSupport {
    RingSupport {
        start: 0.0115,
        length: 1.381,
        height: 0.05,
        width: 0.08,
        pedestal_height: 0.01,
        rings: vec![0.024, 0.476, 0.928, 1.380],
        ring_length: 0.025,
        ring_thickness: 0.02,
        bore_radius: 0.034035687,
        layers_in_ring: 2,
        layers_between: 20,
        section: SupportCells::default(),
        material: steel(),
    }
}

/// The node of `b` at each node of `a`, within 1e-9 m.
fn matching(a: &Mesh, b: &Mesh) -> Vec<usize> {
    const NEAR: f64 = 1e-9;
    // Neighbouring boxes far larger than `NEAR` and far smaller than any cell.
    let key = |x: [f64; 3], shift: [i64; 3]| {
        let at = |i: usize| (x[i] / 1e-5).round() as i64 + shift[i];
        [at(0), at(1), at(2)]
    };
    let mut boxes: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    for (node, &x) in b.nodes().iter().enumerate() {
        boxes.entry(key(x, [0; 3])).or_default().push(node);
    }
    let find = |&x: &[f64; 3]| {
        let shifts = (0..27).map(|k| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1]);
        let near = |&node: &usize| (0..3).all(|i| (b.nodes()[node][i] - x[i]).abs() <= NEAR);
        let mut found =
            shifts.filter_map(|shift| boxes.get(&key(x, shift))).flatten().copied().filter(near);
        let node = found.next().unwrap_or_else(|| panic!("no node at {x:?}"));
        assert_eq!(found.next(), None, "two nodes at {x:?}");
        node
    };
    a.nodes().iter().map(find).collect()
}

/// Element name and node set of every cell, nodes renumbered by `place`.
fn cells(mesh: &Mesh, place: impl Fn(usize) -> usize) -> BTreeSet<(&str, BTreeSet<usize>)> {
    let of_block = |block: &'_ Block| -> Vec<(&'static str, BTreeSet<usize>)> {
        let nodes = |cell: &[usize]| cell.iter().map(|&node| place(node)).collect();
        block.cells().map(|cell| (block.element.origin.name, nodes(cell))).collect()
    };
    mesh.blocks().iter().flat_map(of_block).collect()
}

fn assert_same(made: &Mesh, reference: &Mesh) {
    assert_eq!(made.nodes().len(), reference.nodes().len());
    assert_eq!(made.cell_count(), reference.cell_count());
    let place = matching(made, reference);
    assert!(cells(made, |node| place[node]) == cells(reference, |node| node), "other cells");
    let names = |mesh: &Mesh| mesh.node_sets().keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(made), names(reference));
    for (name, set) in made.node_sets() {
        let set: Vec<usize> = set.iter().map(|&node| place[node]).collect();
        let (mut set, mut other) = (set, reference.node_sets()[name].clone());
        set.sort_unstable();
        other.sort_unstable();
        assert_eq!(set, other, "{name}");
    }
    let sizes = |mesh: &Mesh| -> Vec<(String, usize)> {
        mesh.element_sets().iter().map(|(name, set)| (name.clone(), set.len())).collect()
    };
    assert_eq!(sizes(made), sizes(reference));
    assert_eq!(made.materials(), reference.materials());
    let mass = |mesh: &Mesh| mass_properties(mesh).unwrap().mass;
    assert!((mass(made) / mass(reference) - 1.0).abs() < 1e-9);
}

#[test]
fn the_reference_shaft_is_made_from_its_dimensions() {
    let made = shaft().mesh(&ELEMENTS).unwrap();
    assert_same(&made, &reference("shaft"));
    assert_eq!((made.cell_count(), made.nodes().len(), made.dof_count()), (1824, 1925, 5775));
}

#[test]
fn the_reference_support_is_made_from_its_dimensions() {
    let made = support().mesh(&ELEMENTS).unwrap();
    assert_same(&made, &reference("support"));
    assert_eq!((made.cell_count(), made.nodes().len(), made.dof_count()), (2752, 4269, 12_807));
}

#[test]
fn another_shaft_has_the_mass_of_its_polygon() {
    let other = SolidShaft {
        length: 0.9,
        diameter: 0.05,
        supports: vec![0.1, 0.5, 0.8],
        support_length: 0.03,
        layers_in_support: 4,
        layers_between: 10,
        loads: vec![0.3],
        sections: Vec::new(),
        section: SectionCells { sectors: 12, rings: 4, order: 1 },
        material: Material::isotropic("bronze", 110e9, 0.34, 8800.0).unwrap(),
    };
    let mesh = other.mesh(&ELEMENTS).unwrap();
    // Ends of 85 mm next to layers of 37 mm: three layers each.
    let layers = 3 + 4 + 10 + 4 + 10 + 4 + 3;
    assert_eq!(mesh.cell_count(), layers * 12 * 4);
    assert_eq!(mesh.nodes().len(), (layers + 1) * (1 + 12 * 4));
    let rim = mesh.nodes()[mesh.single_node("DRIVE_TOP").unwrap()];
    let polygon = 6.0 * rim[0] * rim[0] * (PI / 6.0).sin();
    let body = mass_properties(&mesh).unwrap();
    assert!((body.mass / (8800.0 * polygon * 0.9) - 1.0).abs() < 1e-12);
    assert!((body.centre[2] - 0.45).abs() < 1e-12);
    // The same radius of gyration as the circle, to the four digits of the coefficient.
    let gyration = body.second_moment[0][0] / body.mass;
    assert!((gyration / (0.025 * 0.025 / 4.0) - 1.0).abs() < 1e-3);
    assert_eq!(mesh.nodes()[mesh.single_node("JOURNAL3_MIDDLE").unwrap()], [0.0, 0.0, 0.8]);
    assert_eq!(mesh.nodes()[mesh.single_node("LOAD1").unwrap()][2], 0.3);
    assert!(mesh.node_set("JOURNAL4_LEFT").is_err());
}

#[test]
fn another_support_has_the_mass_of_its_parts() {
    let other = RingSupport {
        start: -0.05,
        length: 0.7,
        height: 0.03,
        width: 0.05,
        pedestal_height: 0.02,
        rings: vec![0.02, 0.55],
        ring_length: 0.04,
        ring_thickness: 0.015,
        bore_radius: 0.025,
        layers_in_ring: 4,
        layers_between: 15,
        section: SupportCells { height: 3, width: 6, pedestal: 4, around: 30, radial: 3, order: 1 },
        material: steel(),
    };
    let mesh = other.mesh(&ELEMENTS).unwrap();
    // 50 mm and 80 mm beyond the rings, in layers no longer than the 32.7 mm between them.
    let layers = 2 + 4 + 15 + 4 + 3;
    assert_eq!(mesh.cell_count(), layers * 3 * 6 + 2 * 4 * (4 * 6 + 30 * 3));
    let body = mass_properties(&mesh).unwrap();
    // Section areas by the corners' polygons.
    let bore: Vec<[f64; 2]> = mesh
        .node_set("BORE1_LEFT")
        .unwrap()
        .iter()
        .map(|&n| [mesh.nodes()[n][0], mesh.nodes()[n][1]])
        .collect();
    let cross = |a: [f64; 2], b: [f64; 2]| 0.5 * (a[0] * b[1] - a[1] * b[0]);
    let polygon: f64 = (0..30).map(|i| cross(bore[i], bore[(i + 1) % 30])).sum();
    let ratio: f64 = 0.04 / 0.025;
    let ring = polygon * (ratio * ratio - 1.0);
    let foot = |j: usize| (0.04_f64.powi(2) - (0.05 * (j as f64 / 6.0 - 0.5)).powi(2)).sqrt();
    let mean = (0..6).map(|j| 0.5 * (foot(j) + foot(j + 1))).sum::<f64>() / 6.0;
    let pedestal = 0.05 * (0.06 - mean);
    let volume = 0.7 * 0.03 * 0.05 + 2.0 * 0.04 * (ring + pedestal);
    assert!((body.volume / volume - 1.0).abs() < 1e-12, "{} {volume}", body.volume);
    assert!((body.mass / (7860.0 * volume) - 1.0).abs() < 1e-12);
    assert!(body.centre[1].abs() < 1e-15);
    let mounts = mesh.node_set("MOUNTS").unwrap();
    let z: Vec<f64> = mounts.iter().map(|&node| mesh.nodes()[node][2]).collect();
    assert!((z[0] + 0.05).abs() < 1e-15 && (z[2] - 0.65).abs() < 1e-15, "{z:?}");
    assert!((z[1] - 0.3).abs() < 0.5 * 0.49 / 15.0);
    for &node in mounts {
        assert!((mesh.nodes()[node][0] - 0.09).abs() < 1e-15 && mesh.nodes()[node][1] == 0.0);
    }
}

#[test]
fn impossible_dimensions_are_named() {
    let message = |shaft: SolidShaft| shaft.mesh(&ELEMENTS).unwrap_err().to_string();
    let starts = |text: String, start: &str| assert!(text.starts_with(start), "{text}");
    starts(
        message(SolidShaft { diameter: -0.068, ..shaft() }),
        "diameter = -68 mm is not positive: give a length above zero",
    );
    starts(
        message(SolidShaft { length: f64::NAN, ..shaft() }),
        "length = NaN mm is not positive: give a length above zero",
    );
    starts(
        message(SolidShaft { supports: vec![], ..shaft() }),
        "supports = [] lists no place: list the middle of one at least",
    );
    let overlap = SolidShaft { supports: vec![0.024, 0.04], ..shaft() };
    starts(message(overlap), "supports[1] = 40 mm overlaps or touches the one before it");
    let beyond = SolidShaft { supports: vec![0.024, 1.4], ..shaft() };
    starts(message(beyond), "supports[1] = 1400 mm with support_length = 25 mm reaches beyond");
    let odd = SolidShaft { layers_in_support: 3, ..shaft() };
    starts(message(odd), "layers_in_support = 3 is not an even number");
    let off = SolidShaft { loads: vec![0.26], ..shaft() };
    let text = message(off);
    assert!(
        text.starts_with("loads[0] = 260 mm has no node: no layer of cells ends there"),
        "{text}"
    );

    let message = |support: RingSupport| support.mesh(&ELEMENTS).unwrap_err().to_string();
    let wide = RingSupport { width: 0.12, ..support() };
    starts(message(wide), "width = 120 mm makes the pedestals as wide as the rings");
    let early = RingSupport { start: 0.012, ..support() };
    starts(message(early), "rings[0] = 24 mm with ring_length = 25 mm reaches beyond");
    let coarse = SupportCells { around: 6, ..SupportCells::default() };
    starts(
        message(RingSupport { section: coarse, ..support() }),
        "cells.around = 6 makes cells of a right angle or more: make it 7 at least",
    );
    let error = shaft().mesh(&[]).unwrap_err().to_string();
    assert!(error.contains("no element for C3D6"), "{error}");
    let error = Material::isotropic("tin", 50e9, 0.5, 7300.0).unwrap_err().to_string();
    assert_eq!(
        error,
        "nu of tin = 0.5 is not between −1 and 0.5: give a number between these, such as 0.3"
    );
}

fn crank() -> CrankThrow {
    CrankThrow {
        throw: 0.055,
        diameter: 0.05,
        support_length: 0.03,
        pin_diameter: 0.044,
        pin_length: 0.028,
        web_width: 0.07,
        web_thickness: 0.018,
        layers_in_support: 4,
        layers_between: 2,
        section: SectionCells { sectors: 16, rings: 3, order: 1 },
        material: steel(),
    }
}

/// Mass and centre are those of polygons and plates, all cells hang together, and a body without supports has six rigid
/// motions.
#[test]
fn a_crank_has_the_mass_and_the_centre_of_its_parts() {
    let own = crank();
    let mesh = own.mesh(&ELEMENTS).unwrap();
    let rim = mesh.nodes()[mesh.single_node("DRIVE_TOP").unwrap()][0];
    let area = |radius: f64| 8.0 * radius * radius * (PI / 8.0).sin();
    let pin = rim * own.pin_diameter / own.diameter;
    let plate = own.web_width * (own.throw + own.web_width);
    let volumes = [
        2.0 * own.support_length * area(rim),
        own.pin_length * area(pin),
        2.0 * own.web_thickness * plate,
    ];
    let body = mass_properties(&mesh).unwrap();
    let volume: f64 = volumes.iter().sum();
    assert!((body.mass / (7860.0 * volume) - 1.0).abs() < 1e-12);
    let x = (volumes[1] * own.throw + volumes[2] * 0.5 * own.throw) / volume;
    let z = own.support_length + own.web_thickness + 0.5 * own.pin_length;
    for (found, exact) in body.centre.iter().zip([x, 0.0, z]) {
        assert!((found - exact).abs() < 1e-12, "{found} {exact}");
    }
    assert_eq!(mesh.nodes()[mesh.single_node("PIN_MIDDLE").unwrap()], [0.055, 0.0, z]);
    let (stiffness, mass) =
        (assemble(&mesh, "stiffness").unwrap(), assemble(&mesh, "mass").unwrap());
    let solid = Solid {
        stiffness: &stiffness,
        mass: &mass,
        coordinates: mesh.nodes(),
        slots: &[],
        ties: &[],
        memory: 1 << 30,
    };
    let hertz = solid.free_modes(7).unwrap().hertz();
    assert!(hertz[5] < 1e-2 * hertz[6] && hertz[6] > 500.0, "{hertz:?}");
}

#[test]
fn dimensions_of_a_crank_that_cannot_be_are_named() {
    let message = |crank: CrankThrow| crank.mesh(&ELEMENTS).unwrap_err().to_string();
    let section = SectionCells { sectors: 12, rings: 3, order: 1 };
    for (wrong, expected) in [
        (CrankThrow { throw: 0.04, ..crank() }, "throw"),
        (CrankThrow { web_width: 0.05, ..crank() }, "web_width"),
        (CrankThrow { pin_length: f64::NAN, ..crank() }, "pin_length"),
        (CrankThrow { layers_in_support: 3, ..crank() }, "layers_in_support"),
        (CrankThrow { layers_between: usize::MAX, ..crank() }, "too many cells"),
        (CrankThrow { section, ..crank() }, "cells.sectors"),
    ] {
        let found = message(wrong);
        assert!(found.contains(expected), "{expected}: {found}");
    }
}
