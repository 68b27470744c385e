//! Stiffness and damping of steady bearings with grooves: Lund and Thomsen (1978), A calculation method and data for the
//! dynamic coefficients of oil-lubricated journal bearings; rows as in ross/tests/test_fluid_film_literature.py of
//! petrobras/ross (631a249).

use super::{Bench, CLEARANCE, OMEGA, RADIUS, VISCOSITY, film, turning};
use crate::film::JournalMotion;

/// L/D, then S, ε, φ (deg), K_xx, K_xy, K_yx, K_yy, B_xx, B_xy, B_yy: x along the load, y a quarter of a turn on.
const ROWS: [[f64; 11]; 6] = [
    [0.5, 1.656, 0.244, 65.85, 1.69, 5.06, -2.2, 1.95, 9.93, 2.15, 4.8],
    [0.5, 0.58, 0.477, 51.01, 2.67, 3.7, -0.78, 1.75, 6.96, 1.94, 2.4],
    [0.5, 0.244, 0.655, 40.25, 4.21, 3.74, -0.13, 1.64, 6.87, 1.82, 1.54],
    [1.0, 0.991, 0.15, 70.58, 1.56, 7.29, -2.16, 1.52, 14.66, 1.58, 4.49],
    [1.0, 0.235, 0.46, 49.27, 2.19, 3.57, -0.8, 1.55, 7.36, 1.89, 2.19],
    [1.0, 0.108, 0.65, 39.72, 3.45, 3.34, -0.23, 1.44, 6.89, 1.72, 1.43],
];

/// Two grooves of 20° across the load. Where the film is full its pressure begins at the last node that is fed.
fn bench(length: f64, nodes: [usize; 2]) -> Bench {
    let mut film = film("reynolds", nodes, length, 0.0);
    for (name, middle) in [("groove", 90f64), ("other groove", 270.0)] {
        let edges = [middle - 10.01, middle + 10.01].map(f64::to_radians);
        film.supply(name, edges[0]..edges[1], -length / 2.0..length / 2.0, 0.0).unwrap();
    }
    Bench::new(film)
}

#[test]
fn coefficients_are_those_of_lund_and_thomsen() {
    for [ratio, s, eps, phi, coefficients @ ..] in ROWS {
        let length = 2.0 * RADIUS * ratio;
        // Where the cavity begins within a cell shows in slopes: on 144 nodes by twice as much.
        let mut bench = bench(length, [288, 9]);
        let turns = OMEGA / std::f64::consts::TAU;
        // S = μ N D L/W (R/c)².
        let load = VISCOSITY * turns * 2.0 * RADIUS * length / s * (RADIUS / CLEARANCE).powi(2);
        // Newton's method with the slopes themselves: the load pulls along x.
        let mut place = [0.5 * CLEARANCE, 0.3 * CLEARANCE];
        let mut steps = 0;
        let slopes = loop {
            let motion = JournalMotion { displacement: place, ..turning(0.0) };
            let reaction = bench.react(&motion);
            let slopes = reaction.slopes;
            let rest = [reaction.forces[0] + load, reaction.forces[1]];
            if rest[0].hypot(rest[1]) < 1e-9 * load {
                break slopes;
            }
            let [[a, b], [c, d]] = [[slopes[0][0], slopes[0][1]], [slopes[1][0], slopes[1][1]]];
            let determinant = a * d - b * c;
            let change = [
                (d * rest[0] - b * rest[1]) / determinant,
                (a * rest[1] - c * rest[0]) / determinant,
            ];
            // Within the bore.
            let mut share = 1.0;
            while (place[0] - share * change[0]).hypot(place[1] - share * change[1])
                > 0.95 * CLEARANCE
            {
                share *= 0.5;
            }
            place = [place[0] - share * change[0], place[1] - share * change[1]];
            steps += 1;
            assert!(steps < 25, "L/D {ratio}, S {s}: not found");
        };
        let found = place[0].hypot(place[1]) / CLEARANCE;
        let what = format!("L/D {ratio}, S {s}");
        assert!((found - eps).abs() < 1.5e-3, "{what}: ε {found} against {eps}");
        let angle = place[1].atan2(place[0]).to_degrees();
        assert!((angle - phi).abs() < 0.2, "{what}: φ {angle} against {phi}");
        let unit = CLEARANCE / load;
        let k = |i: usize, j: usize| -slopes[i][j] * unit;
        let b = |i: usize, j: usize| -slopes[i][4 + j] * unit * OMEGA;
        let all = [k(0, 0), k(0, 1), k(1, 0), k(1, 1), b(0, 0), b(0, 1), b(1, 1)];
        for (n, (found, expected)) in all.into_iter().zip(coefficients).enumerate() {
            let most = (0.02 * expected.abs()).max(0.07);
            assert!((found - expected).abs() < most, "{what}, {n}: {found} against {expected}");
        }
        // Damping of a film without inertia is symmetric.
        assert!((b(0, 1) - b(1, 0)).abs() < 1e-2 * b(0, 0), "{what}: {} {}", b(0, 1), b(1, 0));
    }
}
