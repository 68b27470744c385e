//! Bands of surfaces that end within faces, and sections of cells: areas, middles and mean motions of what is cut.

use std::f64::consts::PI;

use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean, Selection, Surface};
use whirl_specs::{ELEMENTS, Element};

use super::surfaces::{INNER, LENGTH, OUTER, bent_ring, ring};
use super::{element, near};

const AXIS: [f64; 2] = [0.1, -0.2];

fn band(z: [f64; 2]) -> Selection {
    Selection::Cylinder { centre: AXIS, radius: INNER, within: 1e-9, z }
}

/// The mesh with the bore from one z to another as its set BAND.
fn with_band(mesh: &Mesh, z: [f64; 2]) -> Mesh {
    let place = mesh.select(&band(z));
    mesh.clone().with_place("BAND", place)
}

fn mean(mesh: &Mesh) -> NodeSetMean {
    NodeSetMean::of_sets(mesh, &["BAND"]).unwrap()
}

/// A component of a mean motion, of nodes that move by `u`.
fn component(
    mesh: &Mesh,
    mean: &NodeSetMean,
    motion: MeanComponent,
    u: impl Fn([f64; 3]) -> [f64; 3],
) -> f64 {
    let value = |(dof, c): (usize, f64)| c * u(mesh.nodes()[dof / 3])[dof % 3];
    mean.row(motion).into_iter().map(value).sum()
}

fn is_linear(element: &Element) -> bool {
    element.nodes <= 8
}

/// Rigid motions are told exactly, whatever the weights are: to the rounding of lengths over the smallest arm.
fn tells_rigid_motions(mesh: &Mesh, mean: &NodeSetMean) {
    let (d, w) = ([0.3, -0.2, 0.7], [0.5, -0.4, 0.9]);
    let c = mean.centre();
    let u = |x: [f64; 3]| {
        let r = [0, 1, 2].map(|k| x[k] - c[k]);
        [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            d[k] + w[i] * r[j] - w[j] * r[i]
        })
    };
    for k in 0..3 {
        let displacement = component(mesh, mean, MeanComponent::Displacement(k), u);
        assert!((displacement - d[k]).abs() < 1e-12, "{displacement} {k}");
        let turn = component(mesh, mean, MeanComponent::Rotation(k), u);
        assert!((turn - w[k]).abs() < 1e-10, "{turn} {k}");
    }
}

#[test]
fn a_band_that_ends_within_faces_has_its_area_middle_and_mean_motion() {
    for element in ELEMENTS.iter() {
        let whole = ring(element, [1, 12, 2]);
        // Over both layers of cells, and within one of them.
        for z in [[0.0031, 0.0333], [0.011, 0.0125]] {
            let mesh = with_band(&whole, z);
            assert!(mesh.is_cut("band"), "{}", element.origin.name);
            let (mean, length) = (mean(&mesh), z[1] - z[0]);
            near(&mean.centre(), &[AXIS[0], AXIS[1], 0.5 * (z[0] + z[1])], 1e-12);
            let polygon = 24.0 * INNER * (PI / 12.0).sin() * length;
            let area = mean.area().unwrap();
            match is_linear(element) {
                true => assert!((area / polygon - 1.0).abs() < 1e-12, "{area} {polygon}"),
                // Parabolas between a polygon of twelve corners and the circle, off it by 2e-4 of the sagitta's part.
                false => assert!((area / (2.0 * PI * INNER * length) - 1.0).abs() < 1e-4, "{area}"),
            }
            let caught = mesh.caught("BAND").unwrap();
            assert!((caught.share.unwrap() - 1.0).abs() < 1e-8, "{caught:?}");
            assert!(caught.off_axis.unwrap() < 1e-12 && caught.cut > 0);
            tells_rigid_motions(&mesh, &mean);
            // What bends along z is met by the functions of quadratic faces, and interpolated by linear ones.
            let found = component(&mesh, &mean, MeanComponent::Displacement(0), |x| {
                [x[2] * x[2], 0.0, 0.0]
            });
            let integral = |z: f64| match is_linear(element) {
                false => z.powi(3) / 3.0,
                true if z <= 0.02 => 0.01 * z * z,
                true => 0.01 * 4e-4 + 0.03 * (z * z - 4e-4) - 8e-4 * (z - 0.02),
            };
            let exact = (integral(z[1]) - integral(z[0])) / length;
            assert!(
                (found / exact - 1.0).abs() < 1e-10,
                "{}: {found} {exact}",
                element.origin.name
            );
            let surface = Surface::of_set(&mesh, "BAND", AXIS).unwrap();
            near(&surface.ends(), &z, 1e-15);
            for angle in [0.0, 1.0, 3.3] {
                assert!(z.iter().all(|&z| surface.at(angle, z).is_some()));
            }
            let moved = mesh.moved([0.5, 0.25]).unwrap();
            near(&self::mean(&moved).centre()[..2], &[0.6, 0.05], 1e-12);
            assert!(moved.caught("BAND").unwrap().off_axis.unwrap() < 1e-12);
        }
    }
}

#[test]
fn a_band_that_ends_on_edges_is_the_mean_of_its_nodes_bit_for_bit() {
    for element in ELEMENTS.iter() {
        let whole = ring(element, [1, 12, 2]);
        for z in
            [[0.0, 0.5 * LENGTH], [0.0, LENGTH], [f64::NEG_INFINITY, f64::INFINITY], [-1.0, 1.0]]
        {
            let mesh = with_band(&whole, z);
            assert!(!mesh.is_cut("BAND"), "{} {z:?}", element.origin.name);
            let nodes = mesh.node_set("BAND").unwrap();
            assert_eq!(mean(&mesh), NodeSetMean::new(&mesh, nodes).unwrap());
            let share = mesh.caught("BAND").unwrap().share.unwrap();
            let whole_band = if z[0] == -1.0 { LENGTH / 2.0 } else { 1.0 };
            assert!((share - whole_band).abs() < 1e-3, "{share}");
        }
    }
}

/// z of nodes within goes up and down around the ring: no end of a band meets edges.
fn ragged(element: &'static Element) -> Mesh {
    bent_ring(element, [1, 12, 3], |[x, y, z]| {
        z + 0.4 * z * (1.0 - z) * (3.0 * 2.0 * PI * y).sin() * (0.6 + 0.4 * x)
    })
}

#[test]
fn bands_side_by_side_add_up_to_the_whole_surface() {
    for element in ELEMENTS.iter() {
        let whole = ragged(element);
        let ends = [0.0, 0.0107, 0.0183, 0.0296, LENGTH];
        let (mut area, mut first, mut moments) = (0.0, [0.0; 3], 0.0);
        for pair in ends.windows(2) {
            let mesh = with_band(&whole, [pair[0], pair[1]]);
            let own = mean(&mesh);
            tells_rigid_motions(&mesh, &own);
            area += own.area().unwrap();
            (0..3).for_each(|k| first[k] += own.area().unwrap() * own.centre()[k]);
            let u = |x: [f64; 3]| [(200.0 * x[2]).sin() * x[1], 0.0, 0.0];
            moments +=
                own.area().unwrap() * component(&mesh, &own, MeanComponent::Displacement(0), u);
            assert!((mesh.caught("BAND").unwrap().share.unwrap() - 1.0).abs() < 1e-3);
        }
        let mesh = with_band(&whole, [0.0, LENGTH]);
        let own = mean(&mesh);
        let all = own.area().unwrap();
        // Planes of triangles are cut exactly; where z is curved over a face the rule of its whole and that of its parts
        // differ by their order.
        let exact = if element.origin.name == "tet4" { 1e-12 } else { 1e-3 };
        assert!((area / all - 1.0).abs() < exact, "{}: {area} {all}", element.origin.name);
        (0..3).for_each(|k| assert!((first[k] / all - own.centre()[k]).abs() < exact * LENGTH));
        let u = |x: [f64; 3]| [(200.0 * x[2]).sin() * x[1], 0.0, 0.0];
        let found = component(&mesh, &own, MeanComponent::Displacement(0), u);
        assert!((moments / all - found).abs() < 2.0 * exact * 0.2, "{}", element.origin.name);
    }
}

/// Area and first moment of a triangle within a band, by clipping its polygon.
fn clipped(corners: [[f64; 3]; 3], [from, to]: [f64; 2]) -> (f64, [f64; 3]) {
    let mut polygon = corners.to_vec();
    for (end, sign) in [(from, 1.0), (to, -1.0)] {
        let inside = |x: &[f64; 3]| sign * (x[2] - end) >= 0.0;
        let mut kept = Vec::new();
        for (place, a) in polygon.iter().enumerate() {
            let b = polygon[(place + 1) % polygon.len()];
            if inside(a) {
                kept.push(*a);
            }
            if inside(a) != inside(&b) {
                let part = (end - a[2]) / (b[2] - a[2]);
                kept.push([0, 1, 2].map(|k| a[k] + part * (b[k] - a[k])));
            }
        }
        polygon = kept;
    }
    let (mut area, mut first) = (0.0, [0.0; 3]);
    for pair in polygon.windows(2).skip(1) {
        let (a, b, c) = (polygon[0], pair[0], pair[1]);
        let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let normal = [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            u[i] * v[j] - u[j] * v[i]
        });
        let own = 0.5 * normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        area += own;
        (0..3).for_each(|k| first[k] += own * (a[k] + b[k] + c[k]) / 3.0);
    }
    (area, first)
}

#[test]
fn triangles_are_cut_as_polygons_are_clipped() {
    let whole = ragged(element("tet4"));
    for z in [[0.0107, 0.0183], [0.0121, 0.0122], [0.0, 0.033]] {
        let own = mean(&with_band(&whole, z));
        let (mut area, mut first) = (0.0, [0.0; 3]);
        let on = |node: usize| {
            let [x, y, _] = whole.nodes()[node];
            ((x - AXIS[0]).hypot(y - AXIS[1]) - INNER).abs() < 1e-9
        };
        for cell in whole.blocks()[0].cells() {
            for face in whole.blocks()[0].element.faces {
                let nodes: Vec<usize> = face.nodes.iter().map(|&place| cell[place]).collect();
                if nodes.iter().all(|&node| on(node)) {
                    let (part, moment) = clipped([0, 1, 2].map(|k| whole.nodes()[nodes[k]]), z);
                    area += part;
                    (0..3).for_each(|k| first[k] += moment[k]);
                }
            }
        }
        assert!((own.area().unwrap() / area - 1.0).abs() < 1e-12);
        near(&own.centre(), &first.map(|sum| sum / area), 1e-13);
    }
}

#[test]
fn the_section_of_cells_has_its_area_middle_and_motion() {
    for element in ELEMENTS.iter() {
        let mesh = ring(element, [1, 12, 2]);
        for z in [0.0131, 0.031, 0.5 * LENGTH, LENGTH] {
            let own = NodeSetMean::of_section(&mesh, z).unwrap().unwrap();
            near(&own.centre(), &[AXIS[0], AXIS[1], z], 1e-12);
            let (circle, name) = (OUTER * OUTER - INNER * INNER, element.origin.name);
            let area = own.area().unwrap();
            match is_linear(element) {
                true => assert!(
                    (area / (6.0 * (PI / 6.0).sin() * circle) - 1.0).abs() < 1e-12,
                    "{name} {area}"
                ),
                false => assert!((area / (PI * circle) - 1.0).abs() < 2e-3, "{name} {area}"),
            }
            tells_rigid_motions(&mesh, &own);
        }
        assert!(NodeSetMean::of_section(&mesh, -1e-6).unwrap().is_none());
        assert!(NodeSetMean::of_section(&mesh, LENGTH + 1e-6).unwrap().is_none());
    }
}

#[test]
fn both_sides_of_a_thin_wall_are_told_apart() {
    let mesh = ring(element("hex8"), [1, 12, 2]);
    let both = |within: f64| {
        let z = [f64::NEG_INFINITY, f64::INFINITY];
        mesh.select(&Selection::Cylinder { centre: AXIS, radius: 0.022, within, z })
    };
    let [outer, hole] = both(0.01).two_sides(&mesh).unwrap();
    near(&outer, &[OUTER - 0.022; 2], 1e-12);
    near(&hole, &[0.022 - INNER; 2], 1e-12);
    assert!(both(0.005).two_sides(&mesh).is_none());
}

#[test]
fn a_square_bar_has_no_cylinders() {
    let block = crate::elements::block(element("hex8"), [0.02, 0.02, 0.1], [2, 2, 5], |x| x);
    let mesh = super::mesh("hex8", block.nodes, block.cells.concat(), Default::default());
    assert_eq!(mesh.round_axis(), None);
    for centre in [[0.01, 0.01], [0.005, 0.005], [0.0, 0.0], [0.005, 0.01]] {
        assert_eq!(mesh.cylinders(centre), [], "{centre:?}");
    }
    let z = [f64::NEG_INFINITY, f64::INFINITY];
    let [centre, radius] = [[0.005, 0.005], [0.005 * 2_f64.sqrt(); 2]];
    let found = mesh.selected(&Selection::Cylinder { centre, radius: radius[0], within: 1e-4, z });
    assert!(found.is_empty());
}
