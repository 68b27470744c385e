//! Trains with gears: modes against equations written down here, marches against a Runge–Kutta integration of the same,
//! backlash, invariances, torsion, and what is refused.

use std::f64::consts::TAU;

use crate::analyses::{column, numbers, ran};
use crate::workbench::Workbench;

/// Motor, pinion, wheel, load: polar inertias (kg·m²); masses of pinion and wheel (kg).
const INERTIA: [f64; 4] = [1e-2, 2e-3, 32e-3, 0.1];
const MASS: [f64; 2] = [2.0, 8.0];
/// Couplings (N·m/rad), bearings (N/m), teeth (N/m).
const COUPLINGS: [f64; 2] = [2e4, 5e4];
const BEARINGS: [f64; 2] = [5e7, 8e7];
const TEETH: f64 = 2e8;
/// Pitch radii (m), pressure angle, ratio.
const RADII: [f64; 2] = [0.04, 0.08];
const RATIO: f64 = -0.5;

/// θ of motor, pinion, wheel and load; x, y of pinion and wheel.
const SIZE: usize = 8;

/// How the machine stands, and what is put in.
#[derive(Clone, Copy)]
struct Train {
    /// Angle of the line of centres (deg).
    turn: f64,
    /// Pressure angle (deg).
    pressure: f64,
    /// N·s/m.
    damping: f64,
    /// µm.
    backlash: Option<f64>,
    /// rpm of the motor.
    speed: f64,
}

const PLAIN: Train =
    Train { turn: 90.0, pressure: 20.0, damping: 0.0, backlash: None, speed: 3000.0 };

impl Train {
    fn gear(&self) -> String {
        let backlash =
            self.backlash.map_or(String::new(), |own| format!("backlash = \"{own} um\"\n"));
        format!(
            "[joint.mesh]\nkind = \"gear\"\nfirst = {{ body = \"pinion\" }}\nsecond = {{ body = \"wheel\" }}\nteeth = [20, 40]\n\
             pressure_angle = \"{} deg\"\nmesh_stiffness = \"{TEETH} N/m\"\nmesh_damping = \"{} N*s/m\"\n{backlash}\n",
            self.pressure, self.damping
        )
    }

    fn bodies(&self) -> [String; 4] {
        let (y, x) = self.turn.to_radians().sin_cos();
        let axis = format!("axis = [\"{:.15} mm\", \"{:.15} mm\"]\n", 120.0 * x, 120.0 * y);
        let body = |name: &str, place: usize, mass: f64, axis: &str, speed: f64| {
            format!(
                "[body.{name}]\nturns = \"free\"\n{axis}mass = \"{mass} kg\"\npolar_inertia = \"{} kg*m^2\"\n\
                 initial_speed = \"{speed} rpm\"\n\n",
                INERTIA[place]
            )
        };
        [
            body("motor", 0, 5.0, "", self.speed),
            body("pinion", 1, MASS[0], "", self.speed),
            body("wheel", 2, MASS[1], &axis, RATIO * self.speed),
            body("load", 3, 20.0, &axis, RATIO * self.speed),
        ]
    }

    fn joints(&self) -> [String; 6] {
        let coupling = |name: &str, first: &str, second: &str, k: f64| {
            format!(
                "[joint.{name}]\nkind = \"coupling\"\nfirst = {{ body = \"{first}\" }}\nsecond = {{ body = \"{second}\" }}\n\
                 stiffness = \"{k} N*m/rad\"\n\n"
            )
        };
        let bushing = |body: &str, k: f64| {
            format!(
                "[joint.{body}]\nkind = \"bushing\"\nfirst = {{ body = \"{body}\" }}\n\
                 stiffness = {{ xx = \"{k} N/m\", yy = \"{k} N/m\" }}\n\n"
            )
        };
        [
            coupling("input", "motor", "pinion", COUPLINGS[0]),
            coupling("outgoing", "wheel", "load", COUPLINGS[1]),
            bushing("pinion", BEARINGS[0]),
            bushing("wheel", BEARINGS[1]),
            bushing("motor", 5e7),
            bushing("load", 8e7),
        ]
    }

    /// The case with couples (N·m) on motor and load.
    fn case(&self, couples: [f64; 2], rest: &str) -> String {
        let load = |body: &str, couple: f64| {
            format!("[loads.{body}]\nbody = \"{body}\"\ncouple = \"{couple} N*m\"\n\n")
        };
        let loads = load("motor", couples[0]) + &load("load", couples[1]);
        let (bodies, joints) = (self.bodies().concat(), self.joints().concat());
        format!("title = \"a train\"\n\n{bodies}{}{joints}{loads}{rest}", self.gear())
    }

    /// Flanks: e_n as a row over the coordinates, on which the force is −k ⟨e_n − b/2⟩ with backlash.
    fn flanks(&self) -> Vec<[f64; SIZE]> {
        let (y, x) = self.turn.to_radians().sin_cos();
        let flank = |alpha: f64, sense: f64| {
            let (sin, cos) = alpha.to_radians().sin_cos();
            // Along the line of centres and across it.
            let n = [sin * x - sense * cos * y, sin * y + sense * cos * x];
            let [r, s] = RADII.map(|radius| sense * radius * cos);
            [0.0, r, s, 0.0, n[0], n[1], -n[0], -n[1]]
        };
        match self.backlash {
            None => vec![flank(self.pressure, 1.0)],
            Some(_) => vec![flank(self.pressure, 1.0), flank(self.pressure, -1.0)],
        }
    }

    /// q̈ of the equations in space.
    fn acceleration(&self, q: &[f64; SIZE], v: &[f64; SIZE], couples: [f64; 2]) -> [f64; SIZE] {
        let mut force = [0.0; SIZE];
        (force[0], force[3]) = (couples[0], couples[1]);
        for (k, [a, b]) in COUPLINGS.into_iter().zip([[0, 1], [2, 3]]) {
            force[a] -= k * (q[a] - q[b]);
            force[b] += k * (q[a] - q[b]);
        }
        for (k, first) in BEARINGS.into_iter().zip([4, 6]) {
            force[first] -= k * q[first];
            force[first + 1] -= k * q[first + 1];
        }
        for row in self.flanks() {
            let [e, rate] = [q, v].map(|x| row.iter().zip(x).map(|(row, x)| row * x).sum::<f64>());
            let own = match self.backlash {
                None => -TEETH * e - self.damping * rate,
                Some(b) if e > 0.5e-6 * b => {
                    let overlap = e - 0.5e-6 * b;
                    // Damping rises over the first 2 µm.
                    let damping = self.damping * f64::min(overlap / 2e-6, 1.0);
                    -f64::max(TEETH * overlap + damping * rate, 0.0)
                }
                Some(_) => 0.0,
            };
            force.iter_mut().zip(row).for_each(|(sum, row)| *sum += own * row);
        }
        let inertia = masses();
        [0, 1, 2, 3, 4, 5, 6, 7].map(|i| force[i] / inertia[i])
    }

    /// Runge and Kutta's fourth order from rest in space but for the speeds, in steps of `dt` s.
    fn integrated(&self, couples: [f64; 2], dt: f64, steps: usize) -> [f64; SIZE] {
        let speed = self.speed * TAU / 60.0;
        let mut q = [0.0; SIZE];
        let mut v = [speed, speed, RATIO * speed, RATIO * speed, 0.0, 0.0, 0.0, 0.0];
        let add = |x: &[f64; SIZE], y: &[f64; SIZE], h: f64| -> [f64; SIZE] {
            std::array::from_fn(|i| x[i] + h * y[i])
        };
        for _ in 0..steps {
            let k1 = (v, self.acceleration(&q, &v, couples));
            let at = |k: &([f64; SIZE], [f64; SIZE]), h: f64| (add(&q, &k.0, h), add(&v, &k.1, h));
            let next = |k: &([f64; SIZE], [f64; SIZE]), h: f64| {
                let (q, v) = at(k, h);
                (v, self.acceleration(&q, &v, couples))
            };
            let k2 = next(&k1, 0.5 * dt);
            let k3 = next(&k2, 0.5 * dt);
            let k4 = next(&k3, dt);
            let mean = |of: fn(&([f64; SIZE], [f64; SIZE])) -> [f64; SIZE], i: usize| {
                (of(&k1)[i] + 2.0 * of(&k2)[i] + 2.0 * of(&k3)[i] + of(&k4)[i]) / 6.0
            };
            q = std::array::from_fn(|i| q[i] + dt * mean(|k| k.0, i));
            v = std::array::from_fn(|i| v[i] + dt * mean(|k| k.1, i));
        }
        q
    }

    /// det(K − ω²M), scaled by rows.
    fn determinant(&self, omega: f64) -> f64 {
        let inertia = masses();
        let mut a = [[0.0; SIZE]; SIZE];
        for j in 0..SIZE {
            let mut unit = [0.0; SIZE];
            unit[j] = 1.0;
            let column = self.acceleration(&unit, &[0.0; SIZE], [0.0; 2]);
            for i in 0..SIZE {
                // In coordinates of mass 1.
                a[i][j] = -column[i] * (inertia[i] / inertia[j]).sqrt() / (omega * omega);
            }
            a[j][j] -= 1.0;
        }
        let mut determinant = 1.0;
        for k in 0..SIZE {
            let pivot =
                (k..SIZE).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).expect("rows");
            if pivot != k {
                a.swap(pivot, k);
                determinant = -determinant;
            }
            determinant *= a[k][k];
            for i in k + 1..SIZE {
                let factor = a[i][k] / a[k][k];
                let first = a[k];
                a[i].iter_mut().zip(first).skip(k).for_each(|(own, first)| *own -= factor * first);
            }
        }
        determinant
    }

    /// Frequencies above 1 Hz at which the determinant changes its sign, or touches zero twice (Hz).
    fn frequencies(&self) -> Vec<f64> {
        let mut all = Vec::new();
        let at = |hertz: f64| self.determinant(TAU * hertz);
        let mut low = 1.0;
        while low < 5000.0 {
            let mut ends = [low, low * 1.0007];
            if at(ends[0]) * at(ends[1]) < 0.0 {
                for _ in 0..60 {
                    let middle = 0.5 * (ends[0] + ends[1]);
                    let place = usize::from(at(ends[0]) * at(middle) < 0.0);
                    ends[place] = middle;
                }
                all.push(ends[0]);
            }
            low *= 1.0007;
        }
        all
    }
}

fn masses() -> [f64; SIZE] {
    let [a, b, c, d] = INERTIA;
    [a, b, c, d, MASS[0], MASS[0], MASS[1], MASS[1]]
}

/// Frequencies of a case at 3000 rpm of the motor (Hz).
fn modes(case: &str) -> Vec<f64> {
    let bench = Workbench::new().file("case.toml", case);
    let arguments = ["--speed", "3000 rpm", "--of", "motor", "--count", "20", "--out", "out"];
    ran(&bench, &[&["modes", "case.toml"][..], &arguments].concat());
    numbers(&bench, "out/modes.csv", "frequency_hz")
}

/// All modes of the equations are among those of the machine, which has the four of motor and load on their bearings beside.
#[test]
fn lateral_torsional_modes_are_those_of_the_equations() {
    for turn in [0.0, 90.0, 37.0, 211.0] {
        for pressure in [20.0, -20.0, 14.5] {
            let train = Train { turn, pressure, ..PLAIN };
            let found = modes(&train.case([0.0; 2], ""));
            let expected = train.frequencies();
            assert_eq!(expected.len(), 7, "{expected:?}");
            assert_eq!(found.len(), 7 + 4, "{found:?}");
            for hertz in expected {
                let near = found.iter().map(|own| (own / hertz - 1.0).abs()).fold(1.0, f64::min);
                assert!(near < 1e-9, "{turn}°, {pressure}°: {hertz} Hz of {found:?}");
            }
        }
    }
}

/// With stiff bearings and teeth the wheel and all behind it count by the square of the ratio.
#[test]
fn a_stiff_gear_is_the_equivalent_inertia() {
    let train = PLAIN;
    let stiff = |text: &str| {
        let text = text.replace(&format!("\"{TEETH} N/m\""), "\"1e15 N/m\"");
        let text = text.replace(&format!("\"{} N/m\"", BEARINGS[0]), "\"1e15 N/m\"");
        text.replace(&format!("\"{} N/m\"", BEARINGS[1]), "\"1e15 N/m\"")
    };
    let found = modes(&stiff(&train.case([0.0; 2], "")));
    // Motor, both gears in one, load on a coupling of i² its stiffness: two roots of a quadratic equation.
    let [motor, pinion, wheel, load] = INERTIA;
    let square = RATIO * RATIO;
    let (middle, end) = (pinion + square * wheel, square * load);
    let [k, l] = [COUPLINGS[0], square * COUPLINGS[1]];
    let b = k / motor + (k + l) / middle + l / end;
    let c = k * l * (motor + middle + end) / (motor * middle * end);
    for sign in [-1.0, 1.0] {
        let hertz = (0.5 * (b + sign * (b * b - 4.0 * c).sqrt())).sqrt() / TAU;
        let near = found.iter().map(|own| (own / hertz - 1.0).abs()).fold(1.0, f64::min);
        // What 1e15 N/m still give: k/(r² 1e15).
        assert!(near < 1e-6, "{hertz} Hz: {found:?}");
    }
}

/// The order of bodies and joints, of both gears, and the direction of the machine change nothing.
#[test]
fn the_order_of_sides_and_bodies_changes_nothing() {
    let train = Train { turn: 33.0, ..PLAIN };
    let expected = modes(&train.case([0.0; 2], ""));
    let [motor, pinion, wheel, load] = train.bodies();
    let joints = train.joints().concat();
    let swapped = train
        .gear()
        .replace("first = { body = \"pinion\" }", "first = { body = \"wheel\" }")
        .replace("second = { body = \"wheel\" }", "second = { body = \"pinion\" }")
        .replace("[20, 40]", "[40, 20]");
    for (bodies, gear) in [
        ([&load, &wheel, &pinion, &motor], train.gear()),
        ([&wheel, &motor, &load, &pinion], swapped.clone()),
        ([&motor, &pinion, &wheel, &load], swapped),
    ] {
        let bodies: String = bodies.into_iter().cloned().collect();
        let found = modes(&format!("title = \"a train\"\n{bodies}{joints}{gear}"));
        assert_eq!(found.len(), expected.len());
        for (own, other) in found.iter().zip(&expected) {
            assert!((own / other - 1.0).abs() < 1e-10, "{found:?} {expected:?}");
        }
    }
}

/// Unbalance moves both shafts through the teeth, as the equations say, and has one order.
#[test]
fn unbalance_acts_through_the_teeth() {
    let train = Train { turn: 50.0, ..PLAIN };
    let unbalance = "unbalance.own = { mass = \"3 g\", radius = \"40 mm\" }\n";
    let case = train.case([0.0; 2], "");
    let case = case.replacen("[body.pinion]\n", &format!("[body.pinion]\n{unbalance}"), 1);
    let bench = Workbench::new().file("case.toml", &case);
    let arguments = ["response", "case.toml", "--speeds", "3000 rpm", "--of", "motor"];
    ran(&bench, &[&arguments[..], &["--out", "out", "--no-figures"]].concat());
    // (K − ω²M) u of unit forces on the pinion along x and y: X = F (u_x − i u_y).
    let omega = 3000.0 * TAU / 60.0;
    let inertia = masses();
    let mut columns = [[0.0; SIZE]; SIZE];
    for (j, column) in columns.iter_mut().enumerate() {
        let mut unit = [0.0; SIZE];
        unit[j] = 1.0;
        let force = train.acceleration(&unit, &[0.0; SIZE], [0.0; 2]);
        *column = std::array::from_fn(|i| -force[i] * inertia[i]);
        column[j] -= omega * omega * inertia[j];
    }
    let solved = |place: usize| -> [f64; SIZE] {
        // Symmetric: rows are columns.
        let mut a = columns;
        let mut x = [0.0; SIZE];
        x[place] = 1.0;
        for k in 0..SIZE {
            let (first, own) = (a[k], x[k]);
            for i in k + 1..SIZE {
                let factor = a[i][k] / first[k];
                a[i].iter_mut().zip(first).for_each(|(sum, part)| *sum -= factor * part);
                x[i] -= factor * own;
            }
        }
        for k in (0..SIZE).rev() {
            let rest: f64 = (k + 1..SIZE).map(|j| a[k][j] * x[j]).sum();
            x[k] = (x[k] - rest) / a[k][k];
        }
        x
    };
    let force = 3e-3 * 0.04 * omega * omega;
    let (along, across) = (solved(4), solved(5));
    let points = column(&bench, "out/response.csv", "point");
    let orders = numbers(&bench, "out/response.csv", "order");
    assert!(orders.iter().all(|own| *own == 1.0), "{orders:?}");
    for (name, first) in [("joint.pinion", 4), ("joint.wheel", 6)] {
        let place = points.iter().position(|own| own == name).expect("a point");
        for (k, axis) in ["x_um", "y_um"].into_iter().enumerate() {
            let exact = 1e6 * force * along[first + k].hypot(across[first + k]);
            let found = numbers(&bench, "out/response.csv", axis)[place];
            assert!((found / exact - 1.0).abs() < 1e-6, "{name} {axis}: {found} {exact}");
        }
    }
}

/// Coordinates at the end of a march: angles (rad), displacements (m).
fn marched(train: &Train, couples: [f64; 2], step: &str, steps: usize) -> [f64; SIZE] {
    let march = format!("[march]\ntime_step = \"{step}\"\nsteps = {steps}\n");
    let bench = Workbench::new().file("case.toml", &train.case(couples, &march));
    ran(&bench, &["run", "case.toml", "--no-figures", "--out", "out"]);
    let history = bench.history("out");
    let last = |name: &str| history.last(name);
    [
        last("theta_rad"),
        last("theta_pinion_rad"),
        last("theta_wheel_rad"),
        last("theta_load_rad"),
        1e-6 * last("X_pinion_um"),
        1e-6 * last("Y_pinion_um"),
        1e-6 * last("X_wheel_um"),
        1e-6 * last("Y_wheel_um"),
    ]
}

/// Differences of two ends over the sizes of their kinds: angles less those of uniform turns, displacements.
fn apart(train: &Train, found: &[f64; SIZE], exact: &[f64; SIZE], t: f64) -> f64 {
    let speed = train.speed * TAU / 60.0 * t;
    let turned = [speed, speed, RATIO * speed, RATIO * speed];
    let angles = (0..4).map(|i| (exact[i] - turned[i]).abs()).fold(0.0, f64::max);
    let sides = (4..8).map(|i| exact[i].abs()).fold(0.0, f64::max);
    let sizes = [angles, angles, angles, angles, sides, sides, sides, sides];
    (0..SIZE).map(|i| (found[i] - exact[i]).abs() / sizes[i]).fold(0.0, f64::max)
}

/// Frames turn by many revolutions, while the equations in space are linear. The trapezoidal rule is of second order.
#[test]
fn a_march_is_the_solution_of_the_equations() {
    for train in [
        Train { turn: 90.0, ..PLAIN },
        Train { turn: -25.0, pressure: -20.0, damping: 2000.0, speed: -1200.0, ..PLAIN },
    ] {
        let couples = [100.0, 150.0];
        let exact = train.integrated(couples, 1e-6, 20_000);
        let errors = [("1e-5 s", 2000), ("5e-6 s", 4000)].map(|(step, steps)| {
            apart(&train, &marched(&train, couples, step, steps), &exact, 0.02)
        });
        assert!(errors[1] < 0.02, "{errors:?}");
        let ratio = errors[0] / errors[1];
        assert!((3.0..5.0).contains(&ratio), "{errors:?}");
    }
}

/// Teeth part and meet on both flanks; each has its own line of action.
#[test]
fn backlash_is_that_of_the_equations() {
    let train = Train { backlash: Some(20.0), damping: 500.0, turn: 60.0, ..PLAIN };
    // The couple of the load turns about: flanks change.
    for couples in [[100.0, 200.0], [-60.0, 400.0], [0.0, -100.0]] {
        let exact = train.integrated(couples, 1e-6, 8000);
        let errors = [("4e-6 s", 2000), ("2e-6 s", 4000)].map(|(step, steps)| {
            apart(&train, &marched(&train, couples, step, steps), &exact, 0.008)
        });
        assert!(errors[1] < 5e-3 && errors[1] < 0.5 * errors[0], "{couples:?}: {errors:?}");
    }
}

/// The start in equilibrium has the forces of statics, and stays.
#[test]
fn static_torque_is_carried_from_the_first_row_on() {
    for backlash in [None, Some(40.0)] {
        for sense in [1.0, -1.0] {
            // Without backlash the line of action is that of the flank which carries the couple.
            let pressure = if backlash.is_none() { 20.0 * sense } else { 20.0 };
            let train = Train { backlash, pressure, ..PLAIN };
            let rest =
                "[start]\nkind = \"equilibrium\"\n\n[march]\ntime_step = \"5e-6 s\"\nsteps = 400\n";
            let bench = Workbench::new()
                .file("case.toml", &train.case([100.0 * sense, 200.0 * sense], rest));
            ran(&bench, &["run", "case.toml", "--no-figures", "--out", "out"]);
            let history = bench.history("out");
            // The wheel stands towards y: its teeth push the pinion along x and towards −y, away from it.
            let across = 100.0 / RADII[0];
            for (name, expected) in
                [("RX_mesh_N", sense * across), ("RY_mesh_N", -across * 20_f64.to_radians().tan())]
            {
                for value in history.column(name) {
                    assert!((value / expected - 1.0).abs() < 1e-6, "{name}: {value} {expected}");
                }
            }
            let moment = history.last("MZ_mesh_Nm");
            assert!((moment / (-100.0 * sense) - 1.0).abs() < 1e-6, "{moment}");
            assert_eq!(bench.summary("out")["verdict"]["sound"], true);
        }
    }
}

/// A march that goes on from a state has the same rows.
#[test]
fn a_state_goes_on_with_teeth() {
    let train = Train { backlash: Some(20.0), ..PLAIN };
    let case = |steps: usize, start: &str| {
        train.case(
            [100.0, -50.0],
            &format!("{start}[march]\ntime_step = \"5e-6 s\"\nsteps = {steps}\n"),
        )
    };
    let from = "[start]\nfrom = \"half\"\n\n";
    let bench = Workbench::new()
        .file("whole.toml", &case(600, ""))
        .file("half.toml", &case(300, ""))
        .file("rest.toml", &case(300, from));
    for name in ["whole", "half", "rest"] {
        ran(&bench, &["run", &format!("{name}.toml"), "--no-figures", "--out", name]);
    }
    let [whole, rest] = ["whole", "rest"].map(|name| bench.history_text(name));
    let tail = |text: &str| text.lines().rev().take(299).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(tail(&whole), tail(&rest));
}

/// Modes with their torsion, critical speeds, separation and torques.
#[test]
fn torsion_names_modes_critical_speeds_and_torques() {
    let rest = "[analysis.train]\nkind = \"torsion\"\nof = \"motor\"\nspeeds = \"0 rpm .. 12000 rpm, 7\"\norders = [1, 3]\n\
                operation = \"2900 rpm .. 3100 rpm\"\nmargin = 0.15\ncount = 4\n";
    let case = PLAIN.case([100.0, 200.0], rest);
    let bench = Workbench::new().file("case.toml", &case);
    let said = ran(&bench, &["analyse", "case.toml", "--out", "out"]).stdout;
    let own = numbers(&bench, "out/train.modes.csv", "frequency_hz");
    let bodies = column(&bench, "out/train.modes.csv", "body");
    let first: Vec<f64> =
        (0..own.len()).filter(|k| bodies[*k] == "motor").map(|k| own[k]).collect();
    assert_eq!(first.len(), 4);
    let expected = PLAIN.frequencies();
    for hertz in &first {
        assert!(expected.iter().any(|other| (hertz / other - 1.0).abs() < 1e-9), "{hertz}");
    }
    // The first two modes of a chain have one node and two.
    assert!((first[0] / expected[0] - 1.0).abs() < 1e-9, "{said}");
    let shares = numbers(&bench, "out/train.modes.csv", "torsional_share");
    assert!(shares.iter().all(|own| (0.1..=1.0).contains(own)), "{shares:?}");
    // Orders of both shafts: 1 and 3 times the speed, and half of that of the wheel.
    let what = column(&bench, "out/train.interference.csv", "what");
    let orders = numbers(&bench, "out/train.interference.csv", "order");
    let speeds = numbers(&bench, "out/train.interference.csv", "speed_rpm");
    let hertz = numbers(&bench, "out/train.interference.csv", "frequency_hz");
    let mut found = 0;
    for k in (0..what.len()).filter(|k| what[*k] == "critical speed") {
        assert!((hertz[k] / (orders[k] * speeds[k] / 60.0) - 1.0).abs() < 1e-9);
        found += 1;
    }
    let within =
        |order: f64| first.iter().filter(|hertz| **hertz * 60.0 / order <= 12000.0).count();
    assert_eq!(found, [1.0, 3.0, 0.5, 1.5, 20.0].map(within).into_iter().sum::<usize>(), "{said}");
    // 3 × motor at 2900 to 3100 rpm is 145 to 155 Hz, and the first mode 1.3 % below that.
    assert!(said.contains("in operation, less than 15 %"), "{said}");
    assert!((1.0 - first[0] / 145.0 - 0.01303).abs() < 1e-5, "{first:?}");
    assert!(said.contains("mode 1 is 1.3 % from 3 × motor"), "{said}");
    let of = |name: &str| numbers(&bench, "out/train.torques.csv", name);
    let joints = column(&bench, "out/train.torques.csv", "joint");
    assert_eq!(joints, ["mesh", "input", "outgoing"]);
    let force = 100.0 / (RADII[0] * 20_f64.to_radians().cos());
    for (found, expected) in [
        (of("torque_on_first_Nm"), [-100.0, -100.0, 200.0]),
        (of("torque_on_second_Nm"), [-200.0, 100.0, -200.0]),
    ] {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
        }
    }
    assert!((of("force_of_teeth_N")[0] / force - 1.0).abs() < 1e-6);
    for file in ["train.csv", "train.svg", "train.png"] {
        assert!(bench.path(&format!("out/{file}")).is_file(), "{file}");
    }
}

/// Speeds that are prescribed hold no end of a train: modes are those of free bodies, and the run says so.
#[test]
fn prescribed_speeds_hold_no_end_of_a_train() {
    let free = PLAIN.case([0.0; 2], "");
    let given = |name: &'static str, speed: f64| {
        let from = format!("initial_speed = \"{speed} rpm\"\n");
        move |text: String| {
            let (head, tail) = text.split_once(&format!("[body.{name}]")).expect("a body");
            let tail = tail.replacen("turns = \"free\"", "turns = \"prescribed\"", 1);
            format!("{head}[body.{name}]{}", tail.replacen(&from, &from.replace("initial_", ""), 1))
        }
    };
    let one = given("motor", 3000.0)(free.clone());
    let all = given("load", -1500.0)(given("wheel", -1500.0)(given("pinion", 3000.0)(one.clone())));
    let torsion = |case: &str| {
        let bench = Workbench::new().file("case.toml", case);
        let arguments = ["torsion", "case.toml", "--of", "motor", "--count", "4", "--out", "out"];
        let said = ran(&bench, &arguments).stdout;
        (numbers(&bench, "out/torsion.modes.csv", "frequency_hz"), said)
    };
    let (expected, said) = torsion(&free);
    assert!(!said.contains("turns freely in these modes"), "{said}");
    for case in [one, all] {
        let case = case.replace("[loads.motor]", "[loads.motors]");
        let (found, said) = torsion(&case);
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(&expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-10), "{found:?}");
        assert!(
            said.contains("motor turns freely in these modes, though its speed is prescribed"),
            "{said}"
        );
    }
}

#[test]
fn gears_that_cannot_be_are_refused() {
    let case = PLAIN.case([0.0; 2], "[march]\ntime_step = \"5e-6 s\"\nsteps = 10\n");
    let axis = "axis = [\"0.000000000000007 mm\", \"120.000000000000000 mm\"]\n";
    assert!(case.contains(axis), "{case}");
    let prescribed = case
        .replace("turns = \"free\"", "turns = \"prescribed\"")
        .replace("initial_speed", "speed")
        .replace("\"-1500 rpm\"", "\"-1499 rpm\"");
    for (text, message, help) in [
        (
            case.replace("[20, 40]", "[20, 40.5]"),
            "`teeth` are two whole numbers",
            "teeth = [20, 40]",
        ),
        (case.replace("[20, 40]", "[20]"), "`teeth` are two whole numbers", "teeth = [20, 40]"),
        (case.replace("teeth = [20, 40]\n", ""), "`teeth` is missing", "pitch_radii"),
        (
            case.replace("mesh_stiffness = \"200000000 N/m\"\n", ""),
            "`mesh_stiffness` is missing",
            "along the line of action",
        ),
        (case.replace(axis, ""), "turn about one axis, where no gear can join them", "axis = ["),
        (
            case.replace("teeth = [20, 40]", "pitch_radii = [\"40 mm\", \"90 mm\"]"),
            "are 120 mm apart, and the pitch radii say 130 mm",
            "\"130 mm\"]",
        ),
        (
            case.replace("[20, 40]\n", "[20, 40]\npitch_radii = [\"40 mm\", \"79 mm\"]\n"),
            "the ratio of the pitch radii is",
            "leave `pitch_radii` out",
        ),
        (
            case.replace("[20, 40]\n", "[20, 20]\ninternal = true\n"),
            "an internal gear is larger",
            "sizes",
        ),
        (case.replace("\"20 deg\"", "\"60 deg\""), "less than 45°", "pressure_angle"),
        (case.replace("[20, 40]\n", "[20, 40]\nbacklash = \"-20 um\"\n"), "`backlash`", ""),
        (prescribed, "`wheel` turns with -1499 rpm and `pinion` with 3000 rpm", "-1500 rpm"),
        (
            case.replace("initial_speed = \"-1500 rpm\"", "initial_speed = \"1500 rpm\""),
            "has the ratio -0.5",
            "leave the `initial_speed` out of `[body.wheel]`",
        ),
        (
            case.replace("second = { body = \"wheel\" }\nteeth", "teeth"),
            "the ground does not turn",
            "turns = \"free\"",
        ),
        (
            case.replacen("kind = \"bushing\"", "kind = \"bearing\"\nlaw = \"gear-mesh\"", 1)
                .replacen(
                    "first = { body = \"pinion\" }\nstiffness",
                    "journal = { body = \"pinion\" }\nx",
                    1,
                ),
            "is a law of the teeth of gears",
            "kind = \"gear\"",
        ),
    ] {
        let bench = Workbench::new().file("case.toml", &text);
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 2, "{message}: {}", outcome.stdout);
        for part in [message, help] {
            assert!(outcome.stderr.contains(part), "{part}: {}", outcome.stderr);
        }
        assert!(outcome.stderr.contains("case.toml:"), "{}", outcome.stderr);
    }
}

/// A wheel without an `initial_speed` starts with that of its teeth.
#[test]
fn speeds_follow_through_the_teeth() {
    let case = PLAIN.case([0.0; 2], "[march]\ntime_step = \"5e-6 s\"\nsteps = 10\n");
    let (head, tail) = case.split_once("[body.wheel]").expect("a wheel");
    let left_out = tail.replacen("initial_speed = \"-1500 rpm\"\n", "", 1);
    let bench = Workbench::new().file("case.toml", &format!("{head}[body.wheel]{left_out}"));
    let said = ran(&bench, &["check", "case.toml"]).stdout;
    assert!(said.contains("wheel: free, from -1500 rpm"), "{said}");
    assert!(said.contains("speed ratio -0.5, pitch radii 40 and 80 mm"), "{said}");
}

/// Two shafts made from dimensions, each with a disc at its far end and held sideways where its gear is.
fn shafts(order: [usize; 2], turn: f64) -> String {
    let (y, x) = f64::to_radians(turn).sin_cos();
    let axis = |place: usize| match place {
        0 => String::new(),
        _ => format!("axis = [\"{:.15} mm\", \"{:.15} mm\"]\n", 150.0 * x, 150.0 * y),
    };
    let body = |place: usize| {
        let (diameter, inertia) = [(40, DISCS[0]), (60, DISCS[1])][place];
        let name = ["thin", "thick"][place];
        let joint = |at: usize, stiffness: &str| {
            format!(
                "[joint.{name}{at}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\", sets = \"JOURNAL{at}_MIDDLE\" }}\n\
                 stiffness = {{ xx = \"{stiffness} N/m\", yy = \"{stiffness} N/m\" }}\n\n"
            )
        };
        format!(
            "[body.{name}]\nturns = \"free\"\n{}material = \"steel\"\nmodes = 10\naxial_restraint = \"JOURNAL1_MIDDLE\"\n\
             disc.end = {{ mass = \"4 kg\", polar_inertia = \"{inertia} kg*m^2\", transverse_inertia = \"{inertia} kg*m^2\", z = \"380 mm\" }}\n\n\
             [body.{name}.dimensions]\nlength = \"400 mm\"\ndiameter = \"{diameter} mm\"\nsupports = [\"20 mm\", \"380 mm\"]\n\
             support_length = \"20 mm\"\ncells = {{ sectors = 16, rings = 2 }}\n\n{}{}",
            axis(place),
            joint(1, "1e13"),
            joint(2, "1e13"),
        )
    };
    format!(
        "title = \"two shafts\"\n[material]\nsteel = {{ youngs_modulus = \"200 GPa\", poissons_ratio = 0.3, density = \"7860 kg/m^3\" }}\n\n\
         {}{}[joint.mesh]\nkind = \"gear\"\nfirst = {{ body = \"thin\", sets = \"JOURNAL1_MIDDLE\" }}\n\
         second = {{ body = \"thick\", sets = \"JOURNAL1_MIDDLE\" }}\nteeth = [20, 30]\nmesh_stiffness = \"1e13 N/m\"\n",
        body(order[0]),
        body(order[1])
    )
}

/// Polar inertias of the discs (kg·m²).
const DISCS: [f64; 2] = [0.01, 0.06];

/// Torsional modes of flexible shafts, the twist between gear and disc included, are those of rods with wave equations.
#[test]
fn flexible_shafts_twist_between_gear_and_disc() {
    const DENSITY: f64 = 7860.0;
    const SHEAR: f64 = 200e9 / 2.6;
    let area = |diameter: f64| std::f64::consts::PI / 32.0 * f64::powi(diameter, 4);
    // Torque at the gear for a unit of twist there, with the 20 mm beyond each end as masses.
    let balance = |omega: f64| {
        let wave = omega * (DENSITY / SHEAR).sqrt();
        let side = |diameter: f64, disc: f64| {
            let (rigid, beyond) = (SHEAR * area(diameter) * wave, DENSITY * area(diameter) * 0.02);
            let (sin, cos) = (0.36 * wave).sin_cos();
            let end = (disc + beyond) * omega * omega;
            beyond * omega * omega + rigid * (end * cos + rigid * sin) / (rigid * cos - end * sin)
        };
        side(0.04, DISCS[0]) + (2.0_f64 / 3.0).powi(2) * side(0.06, DISCS[1])
    };
    let mut roots = Vec::new();
    let mut hertz = 20.0;
    while hertz < 4000.0 {
        let mut ends = [hertz, hertz + 0.5];
        let [a, b] = ends.map(|own| balance(TAU * own));
        // A root, and no pole.
        if a * b < 0.0 && a.abs() + b.abs() < 1e7 {
            for _ in 0..50 {
                let middle = 0.5 * (ends[0] + ends[1]);
                let place = usize::from(balance(TAU * ends[0]) * balance(TAU * middle) < 0.0);
                ends[place] = middle;
            }
            roots.push(ends[0]);
        }
        hertz += 0.5;
    }
    assert!(roots.len() >= 2, "{roots:?}");
    let mut all = Vec::new();
    for (order, turn) in [([0, 1], 0.0), ([1, 0], 0.0), ([0, 1], 77.0)] {
        let bench = Workbench::new().file("case.toml", &shafts(order, turn));
        let arguments = [
            "torsion",
            "case.toml",
            "--of",
            "thin",
            "--speeds",
            "0 rpm .. 900 rpm, 2",
            "--count",
            "4",
        ];
        ran(&bench, &[&arguments[..], &["--out", "out", "--no-figures"]].concat());
        let bodies = column(&bench, "out/torsion.modes.csv", "body");
        let of = |name: &str| {
            let values = numbers(&bench, "out/torsion.modes.csv", name).into_iter().zip(&bodies);
            values.filter(|own| own.1 == "thin").map(|own| own.0).collect::<Vec<_>>()
        };
        let (found, shares) = (of("frequency_hz"), of("torsional_share"));
        for (own, root) in found.iter().zip(&roots).take(2) {
            // Cells of the shafts, and the place where the mean of a section turns.
            assert!((own / root - 1.0).abs() < 5e-3, "{found:?} {roots:?}");
        }
        assert!(shares[..2].iter().all(|own| *own > 0.999), "{shares:?}");
        all.push(found);
    }
    for other in &all[1..] {
        for (own, first) in other.iter().zip(&all[0]).take(2) {
            assert!((own / first - 1.0).abs() < 1e-6, "{all:?}");
        }
    }
}
