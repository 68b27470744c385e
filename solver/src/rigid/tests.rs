use super::*;

fn body() -> RigidBody {
    RigidBody {
        mass: 4.0,
        polar_inertia: 0.5,
        transverse_inertia: Some(0.25),
        along: false,
        rocks: false,
        centre: [0.1, 0.0, 0.2],
        stiffness: [1e4, 2e4],
        damping: [8.0, 0.0],
    }
}

#[test]
fn nodes_move_as_a_rigid_body_does() {
    let position = [0.3, -0.1, 0.5];
    let shapes = &body().turning(&[position]).nodes[0].shapes;
    // α × r and β × r, with r from the centre.
    let expected = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -0.3, -0.1], [0.3, 0.0, -0.2]];
    for (j, column) in expected.iter().enumerate() {
        for (i, value) in column.iter().enumerate() {
            assert!((shapes[(i, j)] - value).abs() < 1e-15, "{i} {j}");
        }
    }
}

#[test]
fn a_body_that_moves_along_z_has_its_mass_there_and_no_spin() {
    let body = RigidBody { along: true, ..body() };
    let shaft = body.turning(&[[0.3, -0.1, 0.5]]);
    assert_eq!(shaft.coordinates.last().map(String::as_str), Some("centre z"));
    let matrices = [&shaft.mass, &shaft.spin_inertia, &shaft.spin_net, &shaft.spin_coupling];
    assert_eq!(matrices.map(|own| own[(4, 4)]), [4.0, 0.0, 0.0, 0.0]);
    assert!((0..4).all(|j| matrices.iter().all(|own| own[(4, j)] == 0.0 && own[(j, 4)] == 0.0)));
    assert_eq!(shaft.nodes[0].shapes.col(4), [0.0, 0.0, 1.0]);
    let flat = RigidBody { transverse_inertia: None, ..body }.standing(&[[0.0; 3]]);
    assert_eq!(flat.nodes[0].shapes.col(2), [0.0, 0.0, 0.5]);
    assert_eq!(flat.measures[0].displacement.col(2), [0.0, 0.0, 0.5]);
}

#[test]
fn a_turning_body_has_its_springs_in_its_frame() {
    let shaft = body().turning(&[]);
    let diagonals = [&shaft.stiffness, &shaft.damping].map(|own| [0, 1, 2].map(|i| own[(i, i)]));
    assert_eq!(diagonals, [[1e4, 2e4, 0.0], [8.0, 0.0, 0.0]]);
}

/// Points and their masses, anywhere.
const POINTS: [([f64; 3], f64); 4] = [
    ([0.3, -0.1, 0.4], 1.5),
    ([-0.2, 0.25, -0.1], 2.0),
    ([0.1, 0.4, 0.7], 0.7),
    ([-0.3, -0.2, 0.2], 1.1),
];

/// What they are together, as a body that tilts.
fn of_points(points: &[([f64; 3], f64)]) -> RigidInertia {
    let mass: f64 = points.iter().map(|(_, m)| m).sum();
    let centre = [0, 1, 2].map(|i| points.iter().map(|(x, m)| m * x[i]).sum::<f64>() / mass);
    let arm = |x: &[f64; 3], i: usize| x[i] - centre[i];
    let second = [0, 1, 2]
        .map(|i| [0, 1, 2].map(|j| points.iter().map(|(x, m)| m * arm(x, i) * arm(x, j)).sum()));
    RigidInertia { mass, centre, second, tilts: true, along: false, rocks: false }
}

/// The mass of points anywhere, by the shapes of nodes there, is the identity.
#[test]
fn a_body_that_rocks_has_its_inertia_about_z() {
    let points = POINTS;
    let inertia = RigidInertia { along: true, rocks: true, ..of_points(&points) };
    let standing = inertia.standing(&points.map(|(x, _)| x), [0.0; 2], [0.0; 2]);
    assert_eq!(standing.coordinates.last().map(String::as_str), Some("turn about z"));
    for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
        let product = |(node, (_, m)): (&BodyNode, &([f64; 3], f64))| -> f64 {
            (0..3).map(|axis| m * node.shapes[(axis, i)] * node.shapes[(axis, j)]).sum()
        };
        let found: f64 = standing.nodes.iter().zip(&points).map(product).sum();
        assert!((found - f64::from(u8::from(i == j))).abs() < 1e-13, "{i} {j}: {found}");
    }
    // A pad that does not tilt: its arm about its centre over the root of its inertia.
    let pad = RigidBody { transverse_inertia: None, rocks: true, ..body() };
    let node = &pad.standing(&[[0.4, -0.2, 0.0]]).nodes[0];
    let by = 1.0 / 0.5_f64.sqrt();
    assert!((node.shapes[(0, 2)] - 0.2 * by).abs() < 1e-15);
    assert!((node.shapes[(1, 2)] - 0.3 * by).abs() < 1e-15);
    let turn = &pad.standing(&[]).measures[0].rotation;
    assert_eq!([turn[(2, 0)], turn[(2, 1)], turn[(2, 2)]], [0.0, 0.0, by]);
    assert_eq!(pad.turning(&[]), RigidBody { rocks: false, ..pad }.turning(&[]));
}

#[test]
fn a_standing_body_has_its_mass_and_its_springs() {
    let body = RigidBody { transverse_inertia: None, ..body() };
    let standing = body.standing(&[[0.0; 3]]);
    assert_eq!(standing.stiffness, [2500.0, 5000.0]);
    assert_eq!(standing.damping, [2.0, 0.0]);
    assert_eq!(standing.nodes[0].shapes[(1, 1)].powi(2), 0.25);
}

/// The energy of the motion specs with these tensors is that of the angular velocity in the axes of the body.
#[test]
fn the_energy_of_tilts_is_that_of_a_rigid_body() {
    let body = body();
    let shaft = body.turning(&[]);
    let (tilt, rate, speed) = ([3e-4, -2e-4], [5e-2, 7e-2], 40.0);
    let (eta, eta_dot) = ([0.0, 0.0, tilt[0], tilt[1]], [0.0, 0.0, rate[0], rate[1]]);
    let product = |matrix: &Matrix, a: &[f64; 4], b: &[f64; 4]| -> f64 {
        (0..4)
            .flat_map(|i| (0..4).map(move |j| (i, j)))
            .map(|(i, j)| a[i] * matrix[(i, j)] * b[j])
            .sum()
    };
    // g = g0 − Hη, so that g·η̇ = −η̇ᵀHη.
    let found = 0.5 * speed * speed * product(&shaft.spin_net, &eta, &eta)
        - speed * product(&shaft.spin_coupling, &eta_dot, &eta)
        + 0.5 * product(&shaft.mass, &eta_dot, &eta_dot);
    let own = body.transverse_inertia.unwrap_or_default();
    let across = (rate[0] - speed * tilt[1]).powi(2) + (rate[1] + speed * tilt[0]).powi(2);
    let along = -speed * speed * (tilt[0].powi(2) + tilt[1].powi(2))
        - speed * (tilt[0] * rate[1] - tilt[1] * rate[0]);
    let exact = 0.5 * own * across + 0.5 * body.polar_inertia * along;
    assert!((found / exact - 1.0).abs() < 1e-12, "{found} for {exact}");
}

/// Point masses anywhere about any centre, turned by tilts of finite size and at a speed: their energy has the
/// tensors as its derivatives.
#[test]
fn the_tensors_are_those_of_its_points() {
    let points = POINTS;
    let inertia = of_points(&points);
    let shaft = inertia.turning(&[]);
    let energy = |eta: [f64; 4], rate: [f64; 4], speed: f64| -> f64 {
        let product = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let j =
            shaft.j0 + 2.0 * product(&shaft.y0, &eta) + product(&eta, &shaft.spin_net.apply(&eta));
        let g = product(&shaft.g0, &rate) - product(&rate, &shaft.spin_coupling.apply(&eta));
        0.5 * speed * speed * j + speed * g + 0.5 * product(&rate, &shaft.mass.apply(&rate))
    };
    // x = centre + u + r + ω × r + ½ ω × (ω × r), and its rate in the frame that turns.
    let exact = |eta: [f64; 4], rate: [f64; 4], speed: f64| -> f64 {
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let (tilt, tilt_rate) = ([eta[2], eta[3], 0.0], [rate[2], rate[3], 0.0]);
        let points = points.iter().map(|(x, m)| {
            let r = [0, 1, 2].map(|i| x[i] - inertia.centre[i]);
            let (once, twice) = (cross(tilt, r), cross(tilt, cross(tilt, r)));
            let (own, a, b) = (
                cross(tilt_rate, r),
                cross(tilt_rate, cross(tilt, r)),
                cross(tilt, cross(tilt_rate, r)),
            );
            let shift = [eta[0], eta[1], 0.0];
            let moving = [rate[0], rate[1], 0.0];
            let place = [0, 1, 2].map(|i| x[i] + shift[i] + once[i] + 0.5 * twice[i]);
            let velocity = [0, 1, 2].map(|i| moving[i] + own[i] + 0.5 * (a[i] + b[i]));
            let turned =
                [velocity[0] - speed * place[1], velocity[1] + speed * place[0], velocity[2]];
            0.5 * m * turned.iter().map(|v| v * v).sum::<f64>()
        });
        points.sum()
    };
    // To second order in all that is small; g and M hold to first order of η, as the shaft's tensors do.
    let (eta, rate) = ([3e-4, -2e-4, 4e-4, 1e-4], [0.02, 0.05, -0.03, 0.04]);
    let scaled = |values: [f64; 4], by: f64| values.map(|value| by * value);
    for (eta, rate, speed) in [
        (eta, [0.0; 4], 30.0),
        (scaled(eta, -1.0), [0.0; 4], 30.0),
        ([0.0; 4], rate, 30.0),
        ([0.0; 4], rate, 0.0),
    ] {
        let zero = exact([0.0; 4], [0.0; 4], speed);
        let (found, wanted) = (energy(eta, rate, speed) - zero, exact(eta, rate, speed) - zero);
        assert!((found - wanted).abs() < 1e-6 * wanted.abs(), "{found} for {wanted}");
    }
    // H by what the energy has of both η and its rate, and changes its sign if they change places. (What does not is a
    // rate itself, by displacements of second order, which g leaves out.)
    let mixed = |energy: &dyn Fn([f64; 4], [f64; 4], f64) -> f64, eta, rate| {
        let of = |a: f64, b: f64| energy(scaled(eta, a), scaled(rate, b), 30.0);
        of(1.0, 1.0) - of(1.0, -1.0) - of(-1.0, 1.0) + of(-1.0, -1.0)
    };
    let skew = |energy: &dyn Fn([f64; 4], [f64; 4], f64) -> f64| {
        let small = scaled(rate, 0.02);
        mixed(energy, eta, small) - mixed(energy, small, eta)
    };
    let (found, wanted) = (skew(&energy), skew(&exact));
    assert!((found - wanted).abs() < 1e-6 * wanted.abs(), "{found} for {wanted}");
}

/// In its coordinates a standing body has mass one.
#[test]
fn tilts_of_a_standing_body_have_mass_one() {
    let second = [[0.5, 0.2, 0.1], [0.2, 0.7, -0.3], [0.1, -0.3, 0.9]];
    let own = RigidInertia {
        mass: 3.0,
        centre: [0.0; 3],
        second,
        tilts: true,
        along: false,
        rocks: false,
    };
    let by = own.to_unit_mass();
    let mass = own.turning(&[]).mass;
    for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
        let parts = (0..16).map(|k| by[k / 4][i] * mass[(k / 4, k % 4)] * by[k % 4][j]);
        let exact = f64::from(u8::from(i == j));
        assert!((parts.sum::<f64>() - exact).abs() < 1e-14, "{i} {j}");
    }
}

/// Coordinates of a body that stands have unit mass: ∫ρ |u|² dV of its points is their sum of squares, and its sections
/// move with its points.
#[test]
fn what_stands_moves_by_coordinates_of_unit_mass() {
    let points = POINTS;
    let positions = points.map(|(x, _)| x);
    let body = RigidInertia { along: true, ..of_points(&points) };
    let standing = body.standing(&positions, [0.0; 2], [0.0; 2]);
    for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
        let product = |(node, (_, m)): (&BodyNode, &([f64; 3], f64))| -> f64 {
            (0..3).map(|axis| m * node.shapes[(axis, i)] * node.shapes[(axis, j)]).sum()
        };
        let found: f64 = standing.nodes.iter().zip(&points).map(product).sum();
        let unit = f64::from(u8::from(i == j));
        assert!((found - unit).abs() < 1e-14, "{i} {j}: {found}");
    }
    let section = [0.07, -0.02, 0.31];
    let measure = &body.measures(&[section], false)[0];
    for node in &standing.nodes {
        let moved = measure.node_at(node.position).shapes;
        for (found, exact) in moved.data.iter().zip(&node.shapes.data) {
            assert!((found - exact).abs() < 1e-14, "{found} for {exact}");
        }
    }
}
