//! Meshes made from dimensions of quadratic cells, against beams with shear and against the areas of circles.

use std::f64::consts::{PI, TAU};

use nalgebra::Matrix4;
use whirl_solver::assembly::mass_properties;
use whirl_solver::mesh::crank::CrankThrow;
use whirl_solver::mesh::shaft::{FINE, SectionCells, SolidShaft};
use whirl_solver::mesh::support::{RingSupport, SupportCells};
use whirl_solver::mesh::{Material, MeanComponent, Mesh, NodeSetMean};
use whirl_solver::reduction::Interface;
use whirl_specs::ELEMENTS;

use super::Matrices;

const E: f64 = 206e9;
const NU: f64 = 0.3;
const RHO: f64 = 7850.0;
/// κ of a round section in bending vibrations (Hutchinson, J. Appl. Mech. 68 (2001) 87–92), which three-dimensional solutions
/// have to fewer errors than Cowper's.
const KAPPA: f64 = 6.0 * (1.0 + NU) * (1.0 + NU) / (7.0 + 12.0 * NU + 4.0 * NU * NU);
const G: f64 = E / (2.0 * (1.0 + NU));

fn steel() -> Material {
    Material::isotropic("steel", E, NU, RHO).unwrap()
}

fn made(shaft: &SolidShaft) -> Mesh {
    shaft.mesh(&ELEMENTS.iter().collect::<Vec<_>>()).unwrap()
}

/// A slender shaft in two supports, with a load half way.
fn shaft(diameter: f64, order: usize, between: usize) -> SolidShaft {
    SolidShaft {
        length: 0.84,
        diameter,
        supports: vec![0.02, 0.82],
        support_length: 0.01,
        layers_in_support: 2,
        layers_between: between,
        loads: vec![0.42],
        sections: Vec::new(),
        section: SectionCells { order, ..SectionCells::default() },
        material: steel(),
    }
}

/// Deflection (m) half way under 1 N there, spread over the section as are both supports.
fn deflection(mesh: &Mesh) -> f64 {
    let section = |z: f64| {
        let near = |&node: &usize| (mesh.nodes()[node][2] - z).abs() < 1e-9;
        let nodes: Vec<usize> = (0..mesh.nodes().len()).filter(near).collect();
        NodeSetMean::new(mesh, &nodes).unwrap()
    };
    let [left, right, middle] = [0.02, 0.82, 0.42].map(section);
    let displacement = MeanComponent::Displacement;
    let retained = [
        left.row(displacement(0)),
        left.row(displacement(1)),
        left.row(displacement(2)),
        left.row(MeanComponent::Rotation(2)),
        right.row(displacement(0)),
        right.row(displacement(1)),
        middle.row(displacement(0)),
    ];
    let matrices = Matrices::new(mesh);
    let interface = Interface { corrections: &[], retained: &retained, held: &[] };
    let reduced = matrices.solid(mesh).reduce(&interface, 1).unwrap();
    let last = reduced.coordinates() - 1;
    1.0 / reduced.reduce(&matrices.stiffness)[(last, last)]
}

/// F L³/(48 E I) + F L/(4 κ G A).
fn beam_deflection(diameter: f64) -> f64 {
    let (span, radius) = (0.8_f64, 0.5 * diameter);
    let (area, moment) = (PI * radius.powi(2), 0.25 * PI * radius.powi(4));
    span.powi(3) / (48.0 * E * moment) + span / (4.0 * KAPPA * G * area)
}

#[test]
fn quadratic_shafts_bend_as_beams_do_and_long_linear_ones_do_not() {
    // The part of the shear is 12 EI/(κGA L²) = 2.2e-3 of the first at L/d = 20, of which κ is uncertain by some percent;
    // loads spread over a section bend it by (d/L)² = 2.5e-3 of a shear's part.
    let exact = beam_deflection(0.02);
    for between in [20, 30] {
        let found = deflection(&made(&shaft(0.02, 2, between)));
        // Layers of 39 mm cost 7e-4 by the formula of their fineness, and sections of eight sectors as much.
        assert!((found / exact - 1.0).abs() < 2e-3, "{between}: {found} {exact}");
    }
    // What is said of linear cells: half of the error of the stiffness, to the part that hexahedra of trapezoids add to
    // that of the wedges.
    let linear = shaft(0.02, 1, 10);
    let said = linear.fineness().unwrap();
    let error = 0.5 * (exact / deflection(&made(&linear)) - 1.0);
    assert!((said.longest - 0.079).abs() < 1e-12 && error > 0.2, "{said:?} {error}");
    assert!((said.error / error - 1.0).abs() < 0.25, "{said:?} {error}");
}

/// Determinant of what is left free at the far end of a free beam with shear and rotary inertia at ω: zero at its frequencies.
fn free_end(omega: f64, length: f64, radius: f64) -> f64 {
    let (area, moment) = (PI * radius.powi(2), 0.25 * PI * radius.powi(4));
    let square = omega * omega;
    // w' = ψ + V/κGA, ψ' = M/EI, M' = −V − ρIω²ψ, V' = −ρAω²w; lengths over L, M and V over EI/L and EI/L².
    let (stiff, l) = (E * moment, length);
    let slopes = Matrix4::new(
        0.0,
        1.0,
        0.0,
        stiff / (l * l * KAPPA * G * area),
        0.0,
        0.0,
        1.0,
        0.0,
        0.0,
        -RHO * moment * square * l * l / stiff,
        0.0,
        -1.0,
        -RHO * area * square * l.powi(4) / stiff,
        0.0,
        0.0,
        0.0,
    );
    let ends = slopes.exp();
    ends[(2, 0)] * ends[(3, 1)] - ends[(2, 1)] * ends[(3, 0)]
}

/// The lowest frequencies of bending of a free beam (Hz).
fn beam_frequencies(length: f64, radius: f64) -> [f64; 3] {
    let slender = (E * 0.25 * radius * radius / RHO).sqrt() / (length * length);
    // Of a beam without shear; shear and rotary inertia make them lower.
    [4.730_040_745, 7.853_204_624, 10.995_607_838].map(|root| {
        let (mut low, mut high) = (0.8 * root * root * slender, 1.001 * root * root * slender);
        let sign = free_end(low, length, radius).signum();
        assert!(sign != free_end(high, length, radius).signum());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let below = free_end(middle, length, radius).signum() == sign;
            if below { low = middle } else { high = middle }
        }
        low / TAU
    })
}

/// By how much the third frequency of bending of the mesh is above that of the beam; the largest of the first three.
fn error(shaft: &SolidShaft) -> f64 {
    let mesh = made(shaft);
    let matrices = Matrices::new(&mesh);
    let hertz = matrices.solid(&mesh).free_modes(20).unwrap().hertz();
    let pairs = beam_frequencies(shaft.length, 0.5 * shaft.diameter).map(|exact| {
        let near = |found: &f64| (found / exact - 1.0).abs();
        let nearest = hertz.iter().copied().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap();
        // Along x and along y alike.
        assert!(hertz.iter().filter(|own| (*own / nearest - 1.0).abs() < 1e-6).count() >= 2);
        nearest / exact - 1.0
    });
    pairs.into_iter().fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn layers_are_chosen_by_the_error_of_frequencies() {
    for (diameter, tolerance) in [(0.02, FINE), (0.04, FINE)] {
        // Without a load, which an odd number of layers has no node for.
        let mut own = SolidShaft { loads: Vec::new(), ..shaft(diameter, 2, 0) };
        [own.layers_in_support, own.layers_between] = own.layers_for(tolerance);
        let said = own.fineness().unwrap();
        assert!(said.error <= tolerance && said.order == 2, "{said:?}");
        let found = error(&own);
        // Sections of eight sectors are too stiff by 4e-4 of their own: quadratic functions of trapezoids lack some of
        // the bending of the section in its plane. κ adds less.
        assert!(
            found <= tolerance + 5e-4 && found > -5e-4,
            "{diameter} {tolerance}: {found}, {own:?}"
        );
        // Not far more layers than it takes.
        own.layers_between = own.layers_between.div_ceil(4);
        let coarse = error(&own);
        assert!(coarse > tolerance, "{diameter} {tolerance}: {coarse}, {own:?}");
    }
}

#[test]
fn quadratic_rounds_have_the_mass_and_the_inertia_of_circles() {
    let own = shaft(0.03, 2, 10);
    let mesh = made(&own);
    assert_eq!(mesh.worst_cell().unwrap().1, 0);
    let body = mass_properties(&mesh).unwrap();
    // Second moments are those of the circle, areas as near as parabolas of 45° are.
    let mass = RHO * PI * 0.015_f64.powi(2) * own.length;
    assert!((body.mass / mass - 1.0).abs() < 1e-4, "{} {mass}", body.mass);
    let across = body.second_moment[0][0];
    assert!((across / (0.25 * mass * 0.015_f64.powi(2)) - 1.0).abs() < 1e-5, "{across}");
    // Cells by corners are those of the linear mesh; sets stand where they stood.
    let linear = made(&shaft(0.03, 1, 10));
    assert_eq!(mesh.cell_count(), linear.cell_count());
    for set in ["JOURNAL1_LEFT", "JOURNAL2_MIDDLE", "LOAD1"] {
        let at = |mesh: &Mesh| mesh.nodes()[mesh.single_node(set).unwrap()];
        assert_eq!(at(&mesh), at(&linear));
    }
    for (set, name) in [("Ewedge15", "wedge15"), ("Ehex20", "hex20")] {
        let cells = mesh.element_set(set).unwrap();
        assert_eq!(mesh.blocks()[cells[0].block].element.origin.name, name);
    }
}

#[test]
fn cranks_and_supports_have_quadratic_cells_too() {
    let elements: Vec<_> = ELEMENTS.iter().collect();
    let crank = |order| CrankThrow {
        throw: 0.055,
        diameter: 0.05,
        support_length: 0.03,
        pin_diameter: 0.044,
        pin_length: 0.028,
        web_width: 0.07,
        web_thickness: 0.018,
        layers_in_support: 2,
        layers_between: 1,
        section: SectionCells { sectors: 8, rings: 2, order },
        material: steel(),
    };
    let [linear, own] = [1, 2].map(|order| crank(order).mesh(&elements).unwrap());
    assert_eq!((own.cell_count(), own.worst_cell().unwrap().1), (linear.cell_count(), 0));
    let body = mass_properties(&own).unwrap();
    let round = |diameter: f64| PI * diameter * diameter / 4.0;
    let plate = 0.07 * (0.055 + 0.07);
    let volume = 2.0 * 0.03 * round(0.05) + 0.028 * round(0.044) + 2.0 * 0.018 * plate;
    assert!((body.volume / volume - 1.0).abs() < 1e-4, "{} {volume}", body.volume);
    assert_eq!(crank(2).default_layers(), [2, 1]);

    let support = |order| RingSupport {
        start: -0.05,
        length: 0.7,
        height: 0.03,
        width: 0.05,
        pedestal_height: 0.02,
        rings: vec![0.02, 0.55],
        ring_length: 0.04,
        ring_thickness: 0.015,
        bore_radius: 0.025,
        layers_in_ring: 2,
        layers_between: 9,
        section: SupportCells { height: 2, width: 2, pedestal: 2, around: 16, radial: 1, order },
        material: steel(),
    };
    let [linear, own] = [1, 2].map(|order| support(order).mesh(&elements).unwrap());
    assert_eq!((own.cell_count(), own.worst_cell().unwrap().1), (linear.cell_count(), 0));
    assert_eq!(own.blocks().len(), 1);
    let bore = own.node_set("BORE2_RIGHT").unwrap();
    assert_eq!(bore.len(), 32);
    for &node in bore {
        let [x, y, z] = own.nodes()[node];
        assert!((x.hypot(y) - 0.025).abs() < 1e-12 && (z - 0.57).abs() < 1e-12);
    }
    // In the order of their angles, as those of linear cells are.
    let angle = |node: usize| own.nodes()[node][1].atan2(own.nodes()[node][0]);
    let turn = |place: usize| (angle(bore[(place + 1) % 32]) - angle(bore[place])).rem_euclid(TAU);
    assert!(((0..32).map(turn).sum::<f64>() / TAU - 1.0).abs() < 1e-9);
    let mounts = |mesh: &Mesh| -> Vec<[f64; 3]> {
        mesh.node_set("MOUNTS").unwrap().iter().map(|&node| mesh.nodes()[node]).collect()
    };
    assert_eq!(mounts(&own), mounts(&linear));
    let volume = |mesh: &Mesh| mass_properties(mesh).unwrap().volume;
    // Rings of arcs have more than those of polygons, by the sagittas of 16 corners.
    assert!((volume(&own) / volume(&linear) - 1.0) > 1e-4);
    assert!((volume(&own) / volume(&linear) - 1.0) < 1e-2);
}

#[test]
fn other_orders_are_refused() {
    let section = SectionCells { order: 3, ..SectionCells::default() };
    let error =
        SolidShaft { section, ..shaft(0.02, 1, 10) }.mesh(&ELEMENTS.iter().collect::<Vec<_>>());
    assert!(error.unwrap_err().to_string().contains("cells.order"));
}
