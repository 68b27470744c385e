//! Order of convergence, by standing waves that have a closed form in a cube: three of its faces are mirrors
//! of the wave, three hold the tangential displacement.

use std::f64::consts::{FRAC_PI_2, PI};

use whirl_solver::assembly::assemble;
use whirl_solver::linalg::{LowerTriangle, SparseCholesky};
use whirl_solver::mesh::{self, Material, Mesh, MeshParts};
use whirl_specs::{ELEMENTS, Element};

use super::patches::block;
use super::{property, spec};

/// u = (a₁ sin kx cos ky cos kz, a₂ cos kx sin ky cos kz, a₃ cos kx cos ky sin kz) with k = π/2 is an eigenmode of
/// the cube, transverse if a·k = 0 and longitudinal if a is along k.
const WAVES: [(&str, [f64; 3]); 2] =
    [("transverse", [1.0, -2.0, 1.0]), ("longitudinal", [1.0, 1.0, 1.0])];

fn displacement([a, b, c]: [f64; 3], x: &[f64; 3]) -> [f64; 3] {
    let [(sx, cx), (sy, cy), (sz, cz)] = x.map(|x| (FRAC_PI_2 * x).sin_cos());
    [a * sx * cy * cz, b * cx * sy * cz, c * cx * cy * sz]
}

/// ω² (rad²/s²) of a wave with |k|² = 3π²/4.
fn omega_squared(a: [f64; 3]) -> f64 {
    let [e, nu, rho] = ["E", "nu", "rho"].map(property);
    let mu = e / (2.0 * (1.0 + nu));
    let modulus = if a.iter().sum::<f64>() == 0.0 {
        mu
    } else {
        e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
    };
    modulus / rho * 0.75 * PI * PI
}

/// Whether a component of the displacement vanishes at a point of the surface: across the faces through the
/// origin, along the others.
fn held(x: &[f64; 3], component: usize) -> bool {
    (0..3).any(|axis| if axis == component { x[axis] == 0.0 } else { x[axis] == 1.0 })
}

/// The cube of `count`³ smaller ones, the nodes within displaced smoothly.
fn cube(element: &'static Element, count: usize) -> Mesh {
    let bent = |x: [f64; 3]| {
        let bump: f64 = x.iter().map(|x| (PI * x).sin()).product();
        if x.iter().any(|x| *x == 0.0 || *x == 1.0) {
            return x;
        }
        [x[0] + 0.04 * bump, x[1] - 0.03 * bump, x[2] + 0.025 * bump]
    };
    let cube = block(element, [1.0; 3], [count; 3], bent);
    let [e, nu, rho] = ["E", "nu", "rho"].map(property);
    Mesh::new(MeshParts {
        origin: "cube".to_owned(),
        labels: (1..=cube.nodes.len() as u64).collect(),
        blocks: vec![mesh::Block {
            element,
            material: 0,
            labels: (1..=cube.cells.len() as u64).collect(),
            connectivity: cube.cells.concat(),
        }],
        nodes: cube.nodes,
        materials: vec![Material::isotropic("steel", e, nu, rho).unwrap()],
        ..MeshParts::default()
    })
    .unwrap()
}

/// Errors of the static displacements u_h under the inertia forces of each wave: R(u_h)/ω² − 1, where R is
/// Rayleigh's quotient. For a mode u with ω², whatever u_h is, this is (a(d, d) − ω² m(d, d))/(ω² m(u_h, u_h)) with
/// d = u_h − u: the square of the error in energy.
fn errors(element: &'static Element, count: usize) -> [f64; 2] {
    let mesh = cube(element, count);
    let [stiffness, mass] = ["stiffness", "mass"].map(|form| assemble(&mesh, form).unwrap());
    let nodes = mesh.nodes();
    // By layers, which keeps the factor in a band.
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    order.sort_by(|a, b| nodes[*a].partial_cmp(&nodes[*b]).unwrap());
    let free: Vec<usize> = (order.iter())
        .flat_map(|node| (0..3).filter(|i| !held(&nodes[*node], *i)).map(move |i| 3 * node + i))
        .collect();
    let mut place = vec![usize::MAX; 3 * nodes.len()];
    free.iter().enumerate().for_each(|(at, dof)| place[*dof] = at);
    let columns = stiffness.to_columns();
    let (columns, place) = (&columns, &place);
    let inner = LowerTriangle::from_columns(free.len(), |column| {
        let entries = columns.column(free[column]).map(move |(row, value)| (place[row], value));
        entries.filter(|(row, _)| *row != usize::MAX)
    });
    let natural: Vec<usize> = (0..free.len()).collect();
    let factor = SparseCholesky::new(&inner, &natural, usize::MAX).unwrap();
    WAVES.map(|(_, a)| {
        let wave: Vec<f64> = nodes.iter().flat_map(|x| displacement(a, x)).collect();
        let mut force = vec![0.0; wave.len()];
        mass.multiply(&wave, &mut force);
        let mut solution: Vec<f64> = free.iter().map(|dof| force[*dof]).collect();
        factor.solve_in_place(&mut solution);
        let mut u = vec![0.0; wave.len()];
        free.iter().zip(solution).for_each(|(dof, value)| u[*dof] = value);
        stiffness.bilinear(&u, &u) / mass.bilinear(&u, &u) / omega_squared(a) - 1.0
    })
}

/// The error in energy falls as h^p, p the degree of completeness. If it is h^p (1 + c h + …), the order
/// between two meshes is off by an amount that falls with h, and is extrapolated from two orders. What is
/// off as h² is then off by −1.7 times as much: of the order of (k h)² on the finer meshes, with k h = π/2 over
/// the number of cells, hundredths.
#[test]
fn displacements_converge_with_the_order_of_completeness() {
    for element in ELEMENTS {
        let complete = spec(element).complete;
        let counts = if complete == 1 { [4, 8, 12] } else { [2, 4, 6] };
        let all = counts.map(|count| errors(element, count));
        let [coarse, middle, fine] = counts.map(|count| count as f64);
        for (w, (wave, _)) in WAVES.iter().enumerate() {
            let [a, b, c] = all.map(|errors| errors[w].abs());
            let orders = [
                0.5 * (a / b).ln() / (middle / coarse).ln(),
                0.5 * (b / c).ln() / (fine / middle).ln(),
            ];
            // Between two meshes h is their geometric mean.
            let finer = (coarse / fine).sqrt();
            let order = orders[1] + (orders[1] - orders[0]) * finer / (1.0 - finer);
            let name = element.origin.name;
            println!("{name} {wave}: {orders:.3?} → {order:.3}, errors {a:.1e} {b:.1e} {c:.1e}");
            let off = (order - f64::from(complete)).abs();
            assert!(off < 0.1, "{name} {wave}: order {order:.3} from {orders:.3?}");
        }
    }
}
