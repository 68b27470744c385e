//! A free shaft of quadratic hexahedra: bending, torsion and stretching converge with the fourth power of
//! the size of the cells, to a beam's and a rod's closed forms and another program's bending frequencies.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_4, PI};

use whirl_solver::assembly::assemble;
use whirl_solver::mesh::{Block, Material, Mesh, MeshParts};
use whirl_solver::reduction::Solid;

use super::element;

/// Length, radius (m), E (Pa), ν, ρ (kg/m³).
const SHAFT: [f64; 5] = [1.0, 0.025, 2.1e11, 0.3, 7850.0];

/// Corners and the middles of the edges of quadrilaterals that fill a circle, counter-clockwise: a square in
/// the middle and four blocks around it, each of `fine` × `fine`, between straight lines and the rim.
fn section(radius: f64, fine: usize) -> Vec<[[f64; 2]; 8]> {
    let on = |radius: f64, quarters: f64| {
        let angle = FRAC_PI_4 * (1.0 + 2.0 * quarters);
        [radius * angle.cos(), radius * angle.sin()]
    };
    let between = |a: [f64; 2], b: [f64; 2], share: f64| -> [f64; 2] {
        std::array::from_fn(|i| (1.0 - share) * a[i] + share * b[i])
    };
    let corner = |quarter: usize| on(0.5 * radius, (quarter % 4) as f64);
    // Of a block: across (outwards, or from one side of the square to the other), and along.
    let at = |block: usize, across: f64, along: f64| match block {
        0 => between(
            between(corner(2), corner(3), across),
            between(corner(1), corner(0), across),
            along,
        ),
        _ => between(
            between(corner(block - 1), corner(block), along),
            on(radius, block as f64 - 1.0 + along),
            across,
        ),
    };
    let corners = [[0, 0], [2, 0], [2, 2], [0, 2]];
    let middles = [[1, 0], [2, 1], [1, 2], [0, 1]];
    let places = [corners, middles].concat();
    let mut quadrilaterals = Vec::new();
    for block in 0..5 {
        for cell in 0..fine * fine {
            quadrilaterals.push(std::array::from_fn(|node| {
                let [across, along] = [0, 1].map(|axis| {
                    let first = 2 * [cell % fine, cell / fine][axis];
                    (first + places[node][axis]) as f64 / (2 * fine) as f64
                });
                at(block, across, along)
            }));
        }
    }
    quadrilaterals
}

/// The shaft in layers of equal height.
fn shaft(fine: usize, layers: usize) -> Mesh {
    let [length, radius, e, nu, rho] = SHAFT;
    let mut numbers: BTreeMap<[i64; 3], usize> = BTreeMap::new();
    let (mut nodes, mut connectivity) = (Vec::new(), Vec::new());
    for layer in 0..layers {
        let height = |half: usize| length * (2 * layer + half) as f64 / (2 * layers) as f64;
        for quadrilateral in section(radius, fine) {
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
    let cells = 5 * fine * fine * layers;
    let labels = (1..=cells as u64).collect();
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

/// The elastic frequencies in Hz, ascending.
fn frequencies(fine: usize, layers: usize) -> Vec<f64> {
    let mesh = shaft(fine, layers);
    let [stiffness, mass] = ["stiffness", "mass"].map(|form| assemble(&mesh, form).unwrap());
    let solid = Solid {
        stiffness: &stiffness,
        mass: &mass,
        coordinates: mesh.nodes(),
        slots: &[],
        ties: &[],
        memory: 1 << 32,
    };
    let found = solid.free_modes(16).unwrap().hertz();
    assert!(found[5] < 1e-3 * found[6], "{found:?}");
    found[6..].to_vec()
}

/// What the frequencies tend to with cells of all directions an mth as long, and how far that may be off: by
/// Richardson, where the terms of the fourth and sixth power vanish; without the latter it differs by what
/// the next power leaves, or more.
fn limit([one, two, three]: [f64; 3]) -> (f64, f64) {
    // f = f₀ + A/m⁴ + B/m⁶ for m = 1, 2, 3.
    let powers = |m: f64| [m.powi(-4), m.powi(-6)];
    let [p, q, r] = [1.0, 2.0, 3.0].map(powers);
    let [a, b] = [p[0] - q[0], p[1] - q[1]];
    let [c, d] = [q[0] - r[0], q[1] - r[1]];
    let (x, y) = (one - two, two - three);
    let determinant = a * d - b * c;
    let (fourth, sixth) = ((x * d - b * y) / determinant, (a * y - x * c) / determinant);
    let plain = three - r[0] * y / c;
    let limit = three - r[0] * fourth - r[1] * sixth;
    (limit, (limit - plain).abs())
}

/// Frequency (Hz) of the nth bending mode of Timoshenko's beam with free ends, n from 1, with the
/// coefficient of shear of Hutchinson (J. Appl. Mech. 68 (2001) 87-92) for a circle.
fn timoshenko(mode: usize) -> f64 {
    let [length, radius, e, nu, rho] = SHAFT;
    let coefficient = 6.0 * (1.0 + nu).powi(2) / (7.0 + 12.0 * nu + 4.0 * nu * nu);
    let shear = coefficient * e / (2.0 * (1.0 + nu));
    let gyration = 0.5 * radius;
    // Symmetric about the middle: cosh αx and cos βx; antisymmetric: sinh αx and sin βx. No moment and no
    // shear force at the ends, where ψ' = y'' + g y.
    let condition = |omega: f64| {
        let square = rho * omega * omega;
        let (g, mean) = (square / shear, 0.5 * square * (1.0 / e + 1.0 / shear));
        let root = (mean * mean - g * square / e + square / (e * gyration * gyration)).sqrt();
        let (alpha, beta) = ((root - mean).sqrt(), (root + mean).sqrt());
        let (tanh, (sin, cos)) = ((0.5 * alpha * length).tanh(), (0.5 * beta * length).sin_cos());
        let (first, second) = ((alpha * alpha + g) * alpha, (beta * beta - g) * beta);
        if mode % 2 == 1 {
            first * sin + second * tanh * cos
        } else {
            first * tanh * cos - second * sin
        }
    };
    // Euler's beam, k L = (n + ½)π to half a percent, is stiffer, by less than a tenth here.
    let wave = (mode as f64 + 0.5) * PI / length;
    let euler = wave * wave * gyration * (e / rho).sqrt() * 1.01;
    let (mut low, mut high) = (0.9 * euler, euler);
    assert!(condition(low) * condition(high) < 0.0, "one root between");
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if condition(low) * condition(middle) > 0.0 { low = middle } else { high = middle }
    }
    low / (2.0 * PI)
}

#[test]
fn a_free_shaft_of_quadratic_hexahedra_has_its_frequencies() {
    let [length, radius, e, nu, rho] = SHAFT;
    // The circle is off by the fourth power of the arcs, as the modes by that of the cells.
    let found = [1, 2, 3].map(|m| frequencies(m, 5 * m));
    let check = |what: &str, found: [f64; 3], expected: f64, share: f64| {
        let (limit, unsure) = limit(found);
        let (error, most) = ((limit / expected - 1.0).abs(), unsure / expected + share);
        println!("{what} {found:.3?}: {limit:.3}, off by {error:.1e} of {most:.1e}");
        assert!(error <= most, "{what} {limit} {expected}: {error:.1e} of {most:.1e}");
        // Richardson's estimate says something only where it is small.
        assert!(unsure < 1e-3 * expected, "{what} {found:?}: {unsure}");
    };
    for (mode, program) in [228.73, 623.21, 1201.8].into_iter().enumerate() {
        // Timoshenko's beam is right up to (k r/2)⁴; the other program's figures have five digits.
        let wave = (mode as f64 + 1.5) * PI / length;
        let share = (0.5 * wave * radius).powi(4);
        for place in [2 * mode, 2 * mode + 1] {
            let found = found.each_ref().map(|found| found[place]);
            check("bending", found, timoshenko(mode + 1), share);
            check("bending, program", found, program, share + 5e-5);
        }
    }
    let twist = (e / (2.0 * (1.0 + nu) * rho)).sqrt() / (2.0 * length);
    check("twist", found.each_ref().map(|found| found[6]), twist, 0.0);
    // A stretched rod moves sideways (Rayleigh); what that leaves out is of the fourth power.
    let sideways = (nu * PI * radius / length).powi(2) / 4.0;
    let stretch = (e / rho).sqrt() / (2.0 * length) * (1.0 - sideways);
    let nearest = |found: &Vec<f64>| {
        let off = |f: &f64| (f - stretch).abs();
        found.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b))).expect("modes")
    };
    let share = (PI * radius / length).powi(4);
    check("stretch", found.each_ref().map(nearest), stretch, share);
}
