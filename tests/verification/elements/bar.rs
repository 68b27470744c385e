//! A free shaft of quadratic hexahedra: bending, torsion and stretching against a beam's and a rod's closed
//! forms and another program's bending frequencies.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_4, PI};

use whirl_solver::assembly::{assemble, mass_properties};
use whirl_solver::mesh::{Block, Material, Mesh, MeshParts};
use whirl_solver::reduction::Solid;

use super::element;

/// Length, radius (m), E (Pa), ν, ρ (kg/m³).
const SHAFT: [f64; 5] = [1.0, 0.025, 2.1e11, 0.3, 7850.0];
const LAYERS: usize = 10;

/// Corners and the middles of the edges of five quadrilaterals that fill a circle, counter-clockwise.
fn section(radius: f64) -> Vec<[[f64; 2]; 8]> {
    let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let on = |radius: f64, eighth: usize| {
        let angle = FRAC_PI_4 * eighth as f64;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let inner: Vec<[f64; 2]> = (0..4).map(|k| on(0.5 * radius, 2 * k + 1)).collect();
    let outer: Vec<[f64; 2]> = (0..4).map(|k| on(radius, 2 * k + 1)).collect();
    let straight = |corners: [[f64; 2]; 4]| -> [[f64; 2]; 8] {
        std::array::from_fn(|k| match k {
            0..4 => corners[k],
            _ => middle(corners[k - 4], corners[(k - 3) % 4]),
        })
    };
    let mut quadrilaterals = vec![straight([inner[0], inner[1], inner[2], inner[3]])];
    for k in 0..4 {
        let next = (k + 1) % 4;
        let mut nodes = straight([inner[k], outer[k], outer[next], inner[next]]);
        nodes[5] = on(radius, 2 * k + 2);
        quadrilaterals.push(nodes);
    }
    quadrilaterals
}

/// The shaft in layers of equal height.
fn shaft() -> Mesh {
    let [length, radius, e, nu, rho] = SHAFT;
    let mut numbers: BTreeMap<[i64; 3], usize> = BTreeMap::new();
    let (mut nodes, mut connectivity) = (Vec::new(), Vec::new());
    for layer in 0..LAYERS {
        let height = |half: usize| length * (2 * layer + half) as f64 / (2 * LAYERS) as f64;
        for quadrilateral in section(radius) {
            // Corners below and above, the middles below and above, those of the upright edges.
            let places = [(0..4, 0), (0..4, 2), (4..8, 0), (4..8, 2), (0..4, 1)];
            for (range, half) in places {
                for [x, y] in &quadrilateral[range] {
                    let at = [*x, *y, height(half)];
                    let key = at.map(|x| (x * 1e9).round() as i64);
                    connectivity.push(*numbers.entry(key).or_insert_with(|| {
                        nodes.push(at);
                        nodes.len() - 1
                    }));
                }
            }
        }
    }
    let labels = (1..=5 * LAYERS as u64).collect();
    let block = Block { element: element("hex20"), material: 0, labels, connectivity };
    Mesh::new(MeshParts {
        origin: "free shaft".to_owned(),
        labels: (1..=nodes.len() as u64).collect(),
        nodes,
        blocks: vec![block],
        materials: vec![Material::isotropic("steel", e, nu, rho).unwrap()],
        ..MeshParts::default()
    })
    .unwrap()
}

#[test]
fn a_free_shaft_of_quadratic_hexahedra_has_its_frequencies() {
    let [length, radius, e, nu, rho] = SHAFT;
    let mesh = shaft();
    let [stiffness, mass] = ["stiffness", "mass"].map(|form| assemble(&mesh, form).unwrap());
    let solid =
        Solid { stiffness: &stiffness, mass: &mass, coordinates: mesh.nodes(), memory: 1 << 32 };
    let found = solid.free_modes(16).unwrap().hertz();
    println!("{found:.3?}");
    assert!(found[5] < 1e-3 * found[6], "{found:?}");

    // Parabolas through three points of a quarter of the rim lie inside the circle: a bending frequency is
    // as the section's radius of gyration.
    let body = mass_properties(&mesh).unwrap();
    let gyration = (body.second_moment[0][0] / body.mass).sqrt() / (radius / 2.0);
    assert!((0.99..1.0).contains(&gyration), "{gyration}");
    let step = length / LAYERS as f64;
    for (mode, frequency) in [228.73, 623.21, 1201.8].into_iter().enumerate() {
        // Deflections of the second degree in a cell without shear have a constant curvature: at worst the
        // energy is in excess by (k h)²/12 of itself, the frequency by half of that. The other program's
        // figures have five digits and an error of their own.
        let wave = ((2.0 * PI * frequency).powi(2) * rho * 4.0 / (e * radius * radius)).powf(0.25);
        let (least, most) = (-5e-4, (wave * step).powi(2) / 24.0 + 5e-4);
        for found in &found[6 + 2 * mode..8 + 2 * mode] {
            let error = found / (frequency * gyration) - 1.0;
            println!("bending {frequency}: {error:.1e} of {most:.1e}");
            assert!(
                (least..most).contains(&error),
                "{found} {frequency}: {error:.1e} of {most:.1e}"
            );
        }
    }
    // Twist and stretch do not depend on the radius, apart from the sideways motion of a stretched rod. A
    // rim that is off by 1 % twists as one of another shape: by the square of that, eight times at most.
    let (twist, stretch) = ((e / (2.0 * (1.0 + nu) * rho)).sqrt(), (e / rho).sqrt());
    let sideways = (nu * PI * radius / length).powi(2) / 4.0;
    let expected = [twist / (2.0 * length), stretch / (2.0 * length) * (1.0 - sideways)];
    for (found, expected) in [found[12], found[15]].into_iter().zip(expected) {
        let error = found / expected - 1.0;
        println!("{expected}: {error:.1e}");
        assert!(error.abs() < 8e-4, "{found} {expected}: {error:.1e}");
    }
}
