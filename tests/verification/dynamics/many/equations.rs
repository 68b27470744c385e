//! Residual and tangent of the machine of everything: against forces by virtual work, against its bodies alone, and
//! against differences.

use num_dual::Dual64;
use whirl_solver::bearing::{Bearing, MotionKind};
use whirl_solver::dynamics::{BodyStart, Coefficients, March, Newmark};
use whirl_solver::equations::{Equations, State};
use whirl_solver::history::History;
use whirl_solver::machine::{Machine, MachineParts, Rotation};

use super::super::audit::{strict, without_bearings, worst_row};
use super::super::contacts::Formula;
use super::super::wild;
use super::{LAWS, Measures, every_load, everything, measures, other_measures};

/// A state in which nothing is small: angles and speeds of their size, displacements a part of the clearance.
fn wild_state(machine: &Machine, seed: u64) -> State {
    let mut random = wild(seed);
    let mut state = State::new(machine.size());
    for i in 0..machine.size() {
        let length = if is_angle(machine, i) { 1.0 } else { 1e-4 };
        state.q[i] = length * random();
        state.v[i] = 100.0 * length * random();
        state.a[i] = 1e4 * length * random();
    }
    state
}

fn is_angle(machine: &Machine, place: usize) -> bool {
    machine.places().iter().any(|own| own.rotation == Some(place))
}

/// Springs of a bearing in a plane, or one if its law acts once there.
fn springs(own: &Bearing) -> usize {
    if LAWS[own.law].outputs.contains(&"F_x") { 1 } else { own.angles.len() }
}

/// What the law of a bearing gives at a spring.
fn given(own: &Bearing, spring: usize, moving: &Measures) -> Vec<Dual64> {
    given_by(LAWS[own.law], own.angles[spring], moving)
}

/// What a law gives at an angle ψ.
fn given_by(law: &Formula, psi: f64, moving: &Measures) -> Vec<Dual64> {
    let [h, s, alpha, e_x, e_y, e_z, alpha_x, alpha_y] = moving.values;
    let taken = |name: &&str| match *name {
        "h" => h.re,
        "h_dot" => h.eps,
        "v_t" => s.eps,
        "omega" => alpha.eps,
        "theta" => moving.theta.re,
        "psi" => psi,
        "e_x" => e_x.re,
        "e_y" => e_y.re,
        "e_x_dot" => e_x.eps,
        "e_y_dot" => e_y.eps,
        "e_z" => e_z.re,
        "alpha_x" => alpha_x.re,
        "alpha_y" => alpha_y.re,
        "e_z_dot" => e_z.eps,
        "alpha_x_dot" => alpha_x.eps,
        "alpha_y_dot" => alpha_y.eps,
        other => panic!("{other} is no input"),
    };
    let inputs: Vec<Dual64> = law.inputs.iter().map(taken).map(Dual64::from).collect();
    (law.value)(&inputs)
}

/// The forces of all bearings on q by virtual work: Σ F ∂(measure)/∂q; one product a force and a place of q.
fn products(machine: &Machine, parts: &MachineParts, state: &State) -> Vec<Vec<f64>> {
    let mut products = vec![Vec::new(); machine.size()];
    let direction = |along: &[f64]| -> Vec<Dual64> {
        state.q.iter().zip(along).map(|(q, v)| Dual64::new(*q, *v)).collect()
    };
    let mut add = |law: &Formula, psi: f64, at: &dyn Fn(&[f64]) -> Measures| {
        let given = given_by(law, psi, &at(&state.v));
        for (place, products) in products.iter_mut().enumerate() {
            let mut unit = vec![0.0; machine.size()];
            unit[place] = 1.0;
            let slopes = at(&unit).values.map(|own| own.eps);
            for (name, force) in law.outputs.iter().zip(&given) {
                let measure = ["Q", "T", "M_z", "F_x", "F_y", "F_z", "M_x", "M_y"];
                let measure = measure.iter().position(|own| own == name).expect("known");
                products.push(force.re * slopes[measure]);
            }
        }
    };
    for own in &parts.bearings {
        for station in &own.stations {
            for spring in 0..springs(own) {
                add(LAWS[own.law], own.angles[spring], &|along| {
                    measures(machine, own, *station, spring, &direction(along))
                });
            }
        }
        for other in &own.others {
            add(LAWS[other.law], 0.0, &|along| {
                other_measures(machine, own, other, &direction(along))
            });
        }
    }
    products
}

fn by_virtual_work(machine: &Machine, parts: &MachineParts, state: &State) -> Vec<f64> {
    products(machine, parts, state).iter().map(|own| own.iter().sum()).collect()
}

/// Forces, displacements and eccentricities of the history are those that laws give and see, in space; every rotation
/// has its columns.
#[test]
fn outputs_are_what_the_laws_see() {
    let parts = everything();
    let machine = Machine::new(everything()).expect("a machine");
    let mut options = strict(5e-5, 40);
    let start = |speed: f64| BodyStart { speed, ..BodyStart::default() };
    options.initial = vec![start(50.0), start(-20.0)];
    let mut march = March::new(&machine, &options).expect("starts");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    let state = march.state();
    let mut history = History::for_machine(&machine);
    history.push(march.row());
    let column = |name: String| history.column(&name).unwrap_or_else(|| panic!("no {name}"))[0];
    let q: Vec<Dual64> = state.q.iter().zip(&state.v).map(|(q, v)| Dual64::new(*q, *v)).collect();
    let angle = |body: usize| machine.places()[body].rotation.map_or(0.0, |place| state.q[place]);
    for (number, own) in parts.bearings.iter().enumerate() {
        let turn = |theta: f64, [x, y]: [f64; 2]| {
            [theta.cos() * x - theta.sin() * y, theta.sin() * x + theta.cos() * y]
        };
        let [journal, bore] = own.sides.bodies;
        let mut force = [0.0; 2];
        for station in &own.stations {
            for spring in 0..springs(own) {
                let seen = measures(&machine, own, *station, spring, &q);
                let (sin, cos) = seen.beta.re.sin_cos();
                let given = given(own, spring, &seen);
                let psi = own.angles[spring];
                for (name, value) in LAWS[own.law].outputs.iter().zip(&given) {
                    let along = match *name {
                        "Q" => [-psi.cos(), -psi.sin()],
                        "T" => [-psi.sin(), psi.cos()],
                        "F_x" => [cos, sin],
                        "F_y" => [-sin, cos],
                        _ => [0.0; 2],
                    };
                    force = [0, 1].map(|axis| force[axis] + value.re * along[axis]);
                }
            }
        }
        let force = turn(angle(bore), force);
        let middle = measures(&machine, own, 0.5, 0, &q);
        let [_, _, _, e_x, e_y, ..] = middle.values;
        let eccentricity = turn(angle(bore) + middle.beta.re, [e_x.re, e_y.re]).map(|e| 1e6 * e);
        let node = &machine.bodies[journal].nodes()[own.journal[1]];
        let place = machine.places()[journal].flexible.clone();
        let moved = [0, 1].map(|axis| {
            place.clone().enumerate().map(|(j, own)| node.shapes[(axis, j)] * state.q[own]).sum()
        });
        let displacement = turn(angle(journal), moved).map(|u| 1e6 * u);
        for (axis, name) in ["X", "Y"].into_iter().enumerate() {
            let pairs = [
                (column(format!("R{name}_{number}_N")), force[axis]),
                (column(format!("{name}_{number}_um")), displacement[axis]),
                (column(format!("E{name}_{number}_um")), eccentricity[axis]),
            ];
            for (found, exact) in pairs {
                let error = (found - exact).abs();
                assert!(error < 1e-9 * (1.0 + exact.abs()), "{number} {name}: {found} {exact}");
            }
        }
        let mut columns = Vec::new();
        if let [_, _, along, x, y, torque] = &given(own, 0, &middle)[..] {
            let [x, y] = turn(angle(bore) + middle.beta.re, [x.re, y.re]);
            let torque = ("MZ", torque.re, "Nm");
            columns.push(vec![("MX", x, "Nm"), ("MY", y, "Nm"), ("RZ", along.re, "N"), torque]);
        }
        for other in &own.others {
            let seen = other_measures(&machine, own, other, &q);
            let given = given_by(LAWS[other.law], 0.0, &seen);
            let [x, y] = turn(angle(bore) + seen.beta.re, [given[0].re, given[1].re]);
            columns.push(match other.kind {
                MotionKind::Tilts => vec![("MX", x, "Nm"), ("MY", y, "Nm")],
                MotionKind::Along => vec![("RZ", given[0].re, "N")],
            });
        }
        for columns in columns {
            for (name, exact, unit) in columns {
                let found = column(format!("{name}_{number}_{unit}"));
                let error = (found - exact).abs();
                assert!(
                    exact != 0.0 && error < 1e-9 * (1.0 + exact.abs()),
                    "{number} {name}: {found} {exact}"
                );
            }
        }
    }
    assert_eq!(column("theta_rad".to_owned()), angle(0));
    assert_eq!(column("theta_ring_rad".to_owned()), angle(1));
    assert_eq!(column("theta_second_rad".to_owned()), angle(3));
    let t = 40.0 * 5e-5;
    assert!((angle(3) - (80.0 - 150.0 * t) * t).abs() < 1e-14);
    assert_eq!(column("omega_second_rad_s".to_owned()), 80.0 - 300.0 * t);
}

/// Every step that is accepted solves its equations, by an evaluation that shares nothing with the solver's.
#[test]
fn every_step_of_the_machine_of_everything_is_solved() {
    let parts = everything();
    let machine = Machine::new(everything()).expect("a machine");
    let rows = |t: f64, state: &State| {
        let mut rows = without_bearings(&machine, t, state);
        for (place, products) in products(&machine, &parts, state).into_iter().enumerate() {
            let largest = products.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            rows.project(place, largest);
            rows.term(place, products);
        }
        rows
    };
    let mut options = strict(5e-5, 150);
    let start = |speed: f64| BodyStart { speed, ..BodyStart::default() };
    options.initial = vec![start(50.0), start(-20.0)];
    let mut march = March::new(&machine, &options).expect("starts");
    let mut before = rows(0.0, march.state());
    for step in 1..=options.steps {
        march.advance().expect("the step converges");
        let after = rows(step as f64 * options.time_step, march.state());
        let worst = worst_row(&before, &after, machine.first_unknown());
        assert!(worst <= 1.0, "step {step}: a row is {worst} times what it may be");
        before = after;
    }
}

#[test]
fn bearings_act_on_both_bodies_by_virtual_work() {
    let parts = everything();
    let machine = Machine::new(everything()).expect("a machine");
    let alone =
        Machine::new(MachineParts { bearings: Vec::new(), ..everything() }).expect("bodies");
    for seed in 1..5 {
        let state = wild_state(&machine, seed);
        let residual = |machine: &Machine| {
            let mut equations = Equations::new(machine);
            equations.evaluate(0.013, &state);
            equations.residual().to_vec()
        };
        let (all, without) = (residual(&machine), residual(&alone));
        let exact = by_virtual_work(&machine, &parts, &state);
        let largest = exact.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        for (place, exact) in exact.iter().enumerate() {
            let found = all[place] - without[place];
            // What is subtracted rounds, too.
            let error = 1e-12 * (largest + without[place].abs());
            assert!((found - exact).abs() < error, "{seed} {place}: {found} for {exact}");
        }
    }
}

#[test]
fn without_bearings_every_body_moves_as_it_does_alone() {
    let parts = || MachineParts { bearings: Vec::new(), ..everything() };
    let machine = Machine::new(parts()).expect("bodies");
    let state = wild_state(&machine, 9);
    let mut equations = Equations::new(&machine);
    equations.evaluate(0.013, &state);
    for (number, place) in machine.places().iter().enumerate() {
        let mut own = parts();
        own.bodies = vec![own.bodies.swap_remove(number)];
        own.loads.retain(|load| load.body == number);
        own.loads.iter_mut().for_each(|load| load.body = 0);
        let alone = Machine::new(own).expect("a body");
        let places: Vec<usize> = place.rotation.into_iter().chain(place.flexible.clone()).collect();
        let of = |all: &[f64]| places.iter().map(|&place| all[place]).collect::<Vec<f64>>();
        let mut by_itself = Equations::new(&alone);
        let [q, v, a, lag] = [&state.q, &state.v, &state.a, &state.lag].map(|all| of(all));
        let state = State { q, v, a, lag, laws: state.laws.clone() };
        by_itself.evaluate(0.013, &state);
        assert_eq!(of(equations.residual()), by_itself.residual(), "body {number}");
    }
}

/// Of one step length: the largest difference between columns of the tangent and central differences of the residual,
/// over the largest entry of each column.
fn worst_column(machine: &Machine, state: &State, share: f64) -> Vec<f64> {
    let (t, size) = (0.013, machine.size());
    let (method, dt) = (Newmark { gamma: 0.55, beta: 0.3 }, 1e-3);
    let (a1, a2) = (method.gamma / (method.beta * dt), 1.0 / (method.beta * dt * dt));
    let step = Coefficients::new(method, dt);
    let mut equations = Equations::new(machine);
    let mut tangent = vec![0.0; size * size];
    equations.evaluate(t, state);
    equations.tangent(t, state, step.weights(), &mut tangent);
    let column = |j: usize| {
        let h = share * if is_angle(machine, j) { 1.0 } else { 1e-4 };
        let mut side = |h: f64| {
            let mut moved = state.clone();
            moved.q[j] += h;
            moved.v[j] += a1 * h;
            moved.a[j] += a2 * h;
            equations.evaluate(t, &moved);
            equations.residual().to_vec()
        };
        let (above, below) = (side(h), side(-h));
        let exact = &tangent[j * size..(j + 1) * size];
        let scale = exact.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let errors = (0..size).map(|i| (exact[i] - (below[i] - above[i]) / (2.0 * h)).abs());
        errors.fold(0.0, f64::max) / scale
    };
    (0..size).map(column).collect()
}

#[test]
fn the_tangent_is_minus_the_derivative_of_the_residual() {
    let machine = Machine::new(everything()).expect("a machine");
    for seed in 1..4 {
        let state = wild_state(&machine, seed);
        let (coarse, fine) =
            (worst_column(&machine, &state, 1e-2), worst_column(&machine, &state, 1e-3));
        for (j, (coarse, fine)) in coarse.iter().zip(&fine).enumerate() {
            assert!(*fine < 2e-5, "{seed} column {j}: {fine}");
            assert!(*fine <= 0.02 * coarse + 1e-9, "{seed} column {j}: {coarse} {fine}");
        }
    }
}

/// Of every kind of load by itself: what it adds to the tangent against differences of what it adds to the residual.
#[test]
fn the_tangent_of_every_load_is_that_of_its_force() {
    let alone = || MachineParts { bearings: Vec::new(), loads: Vec::new(), ..everything() };
    let without = Machine::new(alone()).expect("bodies");
    let (t, size) = (0.013, without.size());
    let step = Coefficients::new(Newmark::default(), 1e-2);
    let a1 = 2.0 / 1e-2;
    for (name, load) in every_load(&everything().bodies) {
        let machine = Machine::new(MachineParts { loads: vec![load], ..alone() }).expect("a load");
        let mut state = wild_state(&machine, 5);
        state.a.fill(0.0);
        let both = [&machine, &without];
        let tangents = both.map(|machine| {
            let mut tangent = vec![0.0; size * size];
            let mut equations = Equations::new(machine);
            equations.evaluate(t, &state);
            equations.tangent(t, &state, step.weights(), &mut tangent);
            tangent
        });
        let force = |state: &State| -> Vec<f64> {
            let [with, without] = both.map(|machine| {
                let mut equations = Equations::new(machine);
                equations.evaluate(t, state);
                equations.residual().to_vec()
            });
            with.iter().zip(&without).map(|(a, b)| a - b).collect()
        };
        let at_all = force(&state).iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        assert!(at_all > 0.1, "{name}: {at_all}");
        for j in 0..size {
            let h = if is_angle(&machine, j) { 1e-5 } else { 1e-6 };
            let side = |h: f64| {
                let mut moved = state.clone();
                moved.q[j] += h;
                moved.v[j] += a1 * h;
                force(&moved)
            };
            let (above, below) = (side(h), side(-h));
            for i in 0..size {
                let exact = (below[i] - above[i]) / (2.0 * h);
                let found = tangents[0][j * size + i] - tangents[1][j * size + i];
                // Differences round by what stands beside the load, and so does the tangent.
                let rounding = 1e-15 * tangents[1][j * size + i].abs() + 1e-11 / h;
                let allowed = 1e-6 * (at_all + exact.abs()) + rounding;
                assert!((found - exact).abs() < allowed, "{name} {i} {j}: {found} for {exact}");
            }
        }
    }
}

/// The blocks of the bearings alone: what a machine with them has more than one without. Whatever the masses, an
/// error in the derivative of a joint is one here.
#[test]
fn the_tangent_of_the_bearings_is_that_of_virtual_work() {
    let parts = everything();
    let machine = Machine::new(everything()).expect("a machine");
    let alone =
        Machine::new(MachineParts { bearings: Vec::new(), ..everything() }).expect("bodies");
    let state = wild_state(&machine, 3);
    let step = Coefficients::new(Newmark::default(), 1e-2);
    let a1 = 2.0 / 1e-2;
    let tangent = |machine: &Machine| {
        let mut equations = Equations::new(machine);
        let mut tangent = vec![0.0; machine.size() * machine.size()];
        equations.evaluate(0.013, &state);
        equations.tangent(0.013, &state, step.weights(), &mut tangent);
        tangent
    };
    let (all, without) = (tangent(&machine), tangent(&alone));
    let size = machine.size();
    for j in 0..size {
        let h = if is_angle(&machine, j) { 1e-4 } else { 1e-8 };
        let side = |h: f64| {
            let mut moved = state.clone();
            moved.q[j] += h;
            moved.v[j] += a1 * h;
            by_virtual_work(&machine, &parts, &moved)
        };
        let (above, below) = (side(h), side(-h));
        let exact: Vec<f64> = (0..size).map(|i| (below[i] - above[i]) / (2.0 * h)).collect();
        let scale = exact.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        assert!(scale > 0.0, "column {j}");
        for (i, exact) in exact.iter().enumerate() {
            let found = all[j * size + i] - without[j * size + i];
            let rounding = 1e-12 * without[j * size + i].abs();
            let error = (found - exact).abs();
            assert!(error < 1e-6 * scale + rounding, "{i} {j}: {found} for {exact} of {scale}");
        }
    }
}

/// The row of a rotation that is prescribed is no unknown, and what is left in it the couple of its drive.
#[test]
fn prescribed_rotations_stand_before_the_unknowns() {
    let machine = Machine::new(everything()).expect("a machine");
    assert_eq!(machine.first_unknown(), 1);
    assert_eq!(machine.places()[3].rotation, Some(0));
    assert!(matches!(machine.bodies[3].rotation(), Some(Rotation::Prescribed { .. })));
    assert_eq!(machine.size(), 3 + 10 + 2 + 4 + 10 + 2);
    assert_eq!(machine.active(), machine.size() - 1);
}
