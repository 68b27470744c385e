//! Matrices that are reduced already: dofs of few nodes, and coordinates of modes.

use std::fmt::Write;

use whirl_solver::assembly::assemble;
use whirl_solver::body::BodySpec;
use whirl_solver::mesh::format::MeshUnits;
use whirl_solver::mesh::matrices::Request;
use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean};
use whirl_solver::reduced::{BodyKind, Reduced};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::turning::turning;
use super::{Texts, bar, market, spec, supports_agree};

/// A dense matrix as an array, column after column.
fn array(n: usize, columns: usize, value: impl Fn(usize, usize) -> f64) -> String {
    let mut text = format!("%%MatrixMarket matrix array real general\n{n} {columns}\n");
    for j in 0..columns {
        (0..n).for_each(|i| writeln!(text, "{:e}", value(i, j)).expect("text"));
    }
    text
}

/// The Craig–Bampton matrices of a shaft with these nodes retained, as files; its modes come first.
fn reduced(mesh: &Mesh, nodes: &[usize], shaft: &Shaft) -> Texts {
    reduced_in(1.0, 1.0, mesh, nodes, shaft)
}

/// The same with displacements in units of `length` m and energies in units of `energy` J; modes have no unit.
fn reduced_in(length: f64, energy: f64, mesh: &Mesh, nodes: &[usize], shaft: &Shaft) -> Texts {
    let n = shaft.size();
    let modes = n - 3 * nodes.len();
    let mut dofs = "node, direction, x [m], y [m], z [m]\n".to_owned();
    (1..=modes).for_each(|mode| writeln!(dofs, "{mode}, mode").expect("text"));
    for &node in nodes {
        let ([x, y, z], label) = (mesh.nodes()[node], mesh.labels()[node]);
        for direction in ["x", "y", "z"] {
            writeln!(dofs, "{label}, {direction}, {x:e}, {y:e}, {z:e}").expect("text");
        }
    }
    let by = |dof: usize| if dof < modes { 1.0 } else { length };
    let of = |matrix: &whirl_solver::linalg::Matrix| {
        array(n, n, |i, j| matrix[(i, j)] * by(i) * by(j) / energy)
    };
    Texts::default()
        .with("dofs.csv", dofs)
        .with("K.mtx", of(&shaft.stiffness))
        .with("M.mtx", of(&shaft.mass))
        .with("Y.mtx", of(&shaft.spin_inertia))
        .with("H.mtx", of(&shaft.spin_coupling))
        .with("G.mtx", of(&shaft.spin_stiffening()))
        .with("load.mtx", array(n, 1, |i, _| shaft.y0[i] * by(i) / energy))
}

/// A request for all of these files.
fn turning_request() -> Request {
    let mut request = market();
    for (place, name) in [
        (&mut request.spin_inertia, "Y.mtx"),
        (&mut request.spin_coupling, "H.mtx"),
        (&mut request.spin_load, "load.mtx"),
        (&mut request.stiffening, "G.mtx"),
    ] {
        *place = Some(name.to_owned());
    }
    request
}

/// A body with the same mesh and other matrices is another body.
#[test]
fn every_matrix_of_a_body_is_in_its_key() {
    let mesh = bar();
    let own = BodySpec { stiffening: true, ..turning(&mesh, 4) };
    let made = Shaft::from_mesh(&mesh, &own).expect("a shaft");
    let texts = reduced(&mesh, &own.nodes, &made);
    let request = turning_request();
    let key = |texts: &Texts| {
        let read = texts.mesh(&request);
        let spec = BodySpec { stiffening: true, ..spec(&read, &[0, 1, 2], 4) };
        Reduced::key(BodyKind::Shaft, &read, &spec)
    };
    let mut keys = vec![key(&texts)];
    assert_eq!(keys[0], key(&texts));
    for name in ["K.mtx", "M.mtx", "Y.mtx", "H.mtx", "G.mtx", "load.mtx"] {
        // Another number on the last line: a pair of dofs of the last node; of the skew H the line before, along y and z.
        let text = &texts.0[std::path::Path::new(name)];
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let n = made.size();
        let last = lines.len() - 1;
        let changed: &[usize] = if name == "H.mtx" { &[last - 1, last - n] } else { &[last] };
        for (place, sign) in changed.iter().zip([1.0, -1.0]) {
            let value: f64 = lines[*place].parse().expect("a number");
            lines[*place] = format!("{:e}", value + sign * 1e-6);
        }
        let other = key(&texts.clone().with(name, lines.join("\n") + "\n"));
        assert!(!keys.contains(&other), "{name} is not in the key");
        keys.push(other);
    }
}

/// Numbers in mm, N, t with coordinates of modes, which have no unit, give the tensors of those in SI: all that turns and
/// stiffens, too.
#[test]
fn all_matrices_are_converted_from_their_units() {
    let mesh = bar();
    let own = BodySpec { stiffening: true, ..turning(&mesh, 10) };
    let made = Shaft::from_mesh(&mesh, &own).expect("a shaft");
    let mut request = turning_request();
    let shaft = |texts: Texts, request: &Request| {
        let read = texts.mesh(request);
        let spec = BodySpec { stiffening: true, ..spec(&read, &[0, 1, 2], 10) };
        Shaft::from_mesh(&read, &spec).expect("a shaft")
    };
    let plain = shaft(reduced(&mesh, &own.nodes, &made), &request);
    // A unit of energy is N·mm, and t·mm² of M likewise.
    request.units = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
    let found = shaft(reduced_in(1e-3, 1e-3, &mesh, &own.nodes, &made), &request);
    // One reduction twice, but for the rounding of the numbers, which modes of equal frequency enlarge.
    assert!((plain.j0 / found.j0 - 1.0).abs() < 1e-9);
    for name in ["y0", "g0", "M", "Y", "W", "H"] {
        let n = made.size();
        let [one, other] = [&plain, &found].map(|own| own.tensor(name).expect(name).to_vec());
        let kept = |place: &usize| match one.len() {
            own if own == n => *place >= 10,
            _ => place / n >= 10 && place % n >= 10,
        };
        let largest = one.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for place in (0..one.len()).filter(kept) {
            let (a, b) = (one[place], other[place]);
            assert!((a - b).abs() <= 1e-9 * largest, "{name}: {a} {b} of {largest}");
        }
    }
}

/// Reduced again with all its modes, a superelement is what it was: at rest, and turning.
#[test]
fn a_superelement_is_reduced_again_without_loss() {
    let mesh = bar();
    let own = BodySpec { stiffening: true, ..turning(&mesh, 10) };
    let made = Shaft::from_mesh(&mesh, &own).expect("a shaft");
    let texts = reduced(&mesh, &own.nodes, &made);
    let request = turning_request();
    let read = texts.mesh(&request);
    assert_eq!((read.placed(), read.nodes().len()), (3, 3 + 4));
    let matrices = read.matrices().expect("matrices");
    assert_eq!(matrices.count(), 10 + 9);
    assert_eq!(matrices.lacks_to_be_free("that turns"), None);
    let nodes: Vec<usize> = (0..3).collect();
    let again = BodySpec { stiffening: true, ..spec(&read, &nodes, 10) };
    let found = Shaft::from_mesh(&read, &again).expect("a shaft");
    for (a, b) in made.hertz.iter().zip(&found.hertz) {
        assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    }
    // Modes of one frequency may be other mixtures: the retained dofs, and what does not depend on coordinates.
    for name in ["J0", "y0", "g0", "M", "Y", "W", "H"] {
        let n = made.size();
        let [one, other] = [&made, &found].map(|own| own.tensor(name).expect(name).to_vec());
        let kept = |place: &usize| match one.len() {
            1 => true,
            own if own == n => *place >= 10,
            _ => place / n >= 10 && place % n >= 10,
        };
        let largest = one.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for place in (0..one.len()).filter(kept) {
            let (a, b) = (one[place], other[place]);
            assert!((a - b).abs() <= 1e-9 * largest, "{name}: {a} {b} of {largest}");
        }
    }
    let [one, other] = [&made, &found].map(|own| own.frequencies_at(3000.0).expect("values"));
    let (one, other) = (one.expect("stable"), other.expect("stable"));
    let largest = one.iter().fold(0.0, |most: f64, x| most.max(*x));
    for (a, b) in one.iter().zip(&other) {
        // Those of free motions are roots of rounding.
        assert!((a - b).abs() <= 1e-8 * a.max(1e-3 * largest), "{a} {b}");
    }
    let [mass, other] = [&made, &found].map(|own| own.centre_of_mass.mass);
    assert!((mass / other - 1.0).abs() < 1e-9, "{mass} {other}");
    let [z, other] = [&made, &found].map(|own| own.centre_of_mass.node.position[2]);
    assert!((z - other).abs() < 1e-9, "{z} {other}");
}

/// Condensed statically, a body keeps its mass, its centre and its stiffness against its nodes.
#[test]
fn condensed_matrices_stand_on_fewer_nodes() {
    let mesh = bar();
    let own = spec(&mesh, &turning(&mesh, 0).nodes, 0);
    let shaft = Shaft::from_mesh(&mesh, &own).expect("a shaft");
    let read = reduced(&mesh, &own.nodes, &shaft).mesh(&market());
    let made = Reduced::new(BodyKind::Support, &mesh, &own).expect("a body");
    let made = made.support(&own).expect("a support");
    let found = Support::from_mesh(&read, &spec(&read, &[0, 1, 2], 0)).expect("a support");
    supports_agree(&made, &found, 1e-8);
    let matrices = read.matrices().expect("matrices");
    // M is no multiple of the unit matrix any more: Y and H are to be given.
    let (what, help) = matrices.lacks_to_turn(false).expect("Y and H");
    assert!(what.contains("Y and H") && help.contains("spin_inertia"), "{what}; {help}");
    let error = assemble(&read, "spin_inertia").expect_err("no Y").to_string();
    assert!(error.contains("Y and H"), "{error}");
}

/// A beam element of Euler and Bernoulli in the x–z plane with turns, held as a cantilever: ω = 3.533 √(EI/(mL³)) for one
/// element with consistent mass, of which the exact solution of the beam has 3.516.
#[test]
fn turns_of_nodes_are_dofs() {
    let (ei, m, l): (f64, f64, f64) = (100.0, 2.0, 0.5);
    let k = ei / l.powi(3);
    let c = m / 420.0;
    // u at both ends along x, turns about y.
    let stiffness = [
        [12.0 * k, 6.0 * l * k, -12.0 * k, 6.0 * l * k],
        [6.0 * l * k, 4.0 * l * l * k, -6.0 * l * k, 2.0 * l * l * k],
        [-12.0 * k, -6.0 * l * k, 12.0 * k, -6.0 * l * k],
        [6.0 * l * k, 2.0 * l * l * k, -6.0 * l * k, 4.0 * l * l * k],
    ];
    let mass = [
        [156.0 * c, 22.0 * l * c, 54.0 * c, -13.0 * l * c],
        [22.0 * l * c, 4.0 * l * l * c, 13.0 * l * c, -3.0 * l * l * c],
        [54.0 * c, 13.0 * l * c, 156.0 * c, -22.0 * l * c],
        [-13.0 * l * c, -3.0 * l * l * c, -22.0 * l * c, 4.0 * l * l * c],
    ];
    let texts = Texts::default()
        .with(
            "dofs.csv",
            "node, direction, x, y, z\n1, x, 0, 0, 0\n1, ry, 0, 0, 0\n2, x, 0, 0, 0.5\n2, ry\n",
        )
        .with("K.mtx", array(4, 4, |i, j| stiffness[i][j]))
        .with("M.mtx", array(4, 4, |i, j| mass[i][j]));
    let read = texts.mesh(&market());
    let own = read.matrices().expect("matrices");
    // What places on a line do not show, turns of the nodes do.
    let end = NodeSetMean::new(&read, &[1]).expect("a node");
    assert!(end.turns_about(1) && !end.turns_about(0) && !end.turns_about(2));
    assert_eq!(end.row(MeanComponent::Rotation(1)), [(10, 1.0)]);
    assert_eq!(end.row(MeanComponent::Rotation(0)), []);
    // Free against shifts along x and turns about y: what is there strains nothing.
    assert_eq!(own.lacks_to_be_free("rigid"), None);
    let mut held = spec(&read, &[], 2);
    // Node 1 is held in x and in its turn, whose node is the third.
    held.held.extend([0, 7]);
    let found = Support::from_mesh(&read, &held).expect("a cantilever");
    let omega = std::f64::consts::TAU * found.hertz[0] / (ei / (m * l.powi(3))).sqrt();
    assert!((omega - 3.532_730).abs() < 1e-5, "{omega}");
    let properties = whirl_solver::assembly::mass_properties(&read).expect("a mass");
    assert!((properties.mass - m).abs() < 1e-12 && (properties.centre[2] - 0.25).abs() < 1e-12);
}
