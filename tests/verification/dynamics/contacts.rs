//! Laws that take or give more than Q(h, ḣ): tangential forces, laws of whole rings.

use num_dual::{Dual64, DualNum};
use whirl_solver::Error;
use whirl_solver::bearing::{Bearing, SpringLaw};
use whirl_solver::dynamics::{March, march};
use whirl_solver::equations::State;
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;

use super::equations::{random_state, worst_column};
use super::free_shaft::momentum;
use super::lumped::Jeffcott;
use super::{DISCS, INERTIA, bearing, bores, discs, options, parts, stops};

/// A law given by its formula, whose slopes follow by dual numbers.
pub(super) struct Formula {
    pub(super) name: &'static str,
    pub(super) inputs: &'static [&'static str],
    pub(super) outputs: &'static [&'static str],
    pub(super) value: fn(&[Dual64]) -> Vec<Dual64>,
}

impl SpringLaw for &'static Formula {
    fn name(&self) -> &str {
        self.name
    }
    fn hash(&self) -> &str {
        ""
    }
    fn inputs(&self) -> Vec<&str> {
        self.inputs.to_vec()
    }
    fn outputs(&self) -> Vec<&str> {
        self.outputs.to_vec()
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        let n = self.inputs.len();
        for j in 0..springs {
            for seed in 0..n {
                let seeded =
                    |i: usize| Dual64::new(inputs[i * springs + j], f64::from(u8::from(i == seed)));
                let z: Vec<Dual64> = (0..n).map(seeded).collect();
                for (o, value) in (self.value)(&z).into_iter().enumerate() {
                    outputs[o * (1 + n) * springs + j] = value.re;
                    outputs[(o * (1 + n) + 1 + seed) * springs + j] = value.eps;
                }
            }
        }
    }
}

const ALL_OF_SPRINGS: &[&str] = &["theta", "h", "v_t", "psi", "h_dot", "omega"];
const ALL_OF_RINGS: &[&str] = &["omega", "e_x", "e_y", "theta", "e_x_dot", "e_y_dot"];
/// Of the journals (m).
pub(super) const RADIUS: f64 = 0.03;

/// A film with friction in which everything that a spring has plays a part.
pub(super) static FILM: Formula = Formula {
    name: "film with friction",
    inputs: ALL_OF_SPRINGS,
    outputs: &["T", "Q"],
    value: |z| {
        let [theta, h, v_t, psi, h_dot, omega] = z else { panic!("six inputs") };
        let thin = (*h / -5e-4).exp() * 50.0;
        let uneven = (*theta * 3.0 + *psi).sin() * 0.2 + 1.0 + *omega * *omega * 1e-5;
        let q = thin * uneven * (*h_dot * -0.5 + 1.0);
        vec![q * (*v_t / 2.0).tanh() * -0.3, q]
    },
};

/// A ring on which all that it has plays a part.
pub(super) static RING: Formula = Formula {
    name: "ring",
    inputs: ALL_OF_RINGS,
    outputs: &["F_x", "M_z", "F_y"],
    value: |z| {
        let [omega, x, y, theta, x_dot, y_dot] = z else { panic!("six inputs") };
        let square = (*x * *x + *y * *y) * 1e6 + 1.0;
        let stiff = square * 2e4 * (theta.sin() * 0.1 + 1.0);
        let cross = *omega * 30.0;
        vec![
            -stiff * x - cross * y - *x_dot * 40.0,
            -*omega * 1e-2 * square - *x * *y_dot * 5.0,
            -stiff * y + cross * x - *y_dot * 40.0,
        ]
    },
};

/// Laws as machines take them.
pub(super) fn laws(list: &[&'static Formula]) -> Vec<Box<dyn SpringLaw>> {
    list.iter().map(|law| Box::new(*law) as Box<dyn SpringLaw>).collect()
}

/// Friction at springs and a ring's law on discs in vibrating bores.
fn busy() -> Machine {
    let mut parts = parts(discs(1e5), bores(), Rotation::Free);
    parts.laws = laws(&[&RING, &FILM]);
    parts.bearings = vec![bearing(1), Bearing { stations: vec![0.2, 0.9], ..bearing(0) }];
    Machine::new(parts).expect("a machine")
}

#[test]
fn the_tangent_is_minus_the_derivative_of_the_residual() {
    let machine = busy();
    for seed in 1..4 {
        let state = random_state(machine.size(), seed);
        let (coarse, fine) =
            (worst_column(&machine, &state, 1e-2), worst_column(&machine, &state, 1e-3));
        for (j, (coarse, fine)) in coarse.iter().zip(&fine).enumerate() {
            // As for laws Q(h, ḣ): a hundredth of the coarser step's error, or rounding.
            assert!(*fine < 2e-5, "{seed} column {j}: {fine}");
            assert!(*fine <= 0.02 * coarse + 1e-9, "{seed} column {j}: {coarse} {fine}");
        }
    }
}

/// Hertz-like contact all around, with friction.
pub(super) static RUB: Formula = Formula {
    name: "rub",
    inputs: &["h", "v_t"],
    outputs: &["Q", "T"],
    value: |z| {
        let [h, v_t] = z else { panic!("two inputs") };
        let depth = -*h + 2e-3;
        // Far out, where a first trial may lead, nothing touches.
        if depth.re <= 0.0 {
            return vec![Dual64::from_re(0.0); 2];
        }
        let q = depth * depth.sqrt() * 1e8;
        vec![q, q * (*v_t / 2.0).tanh() * -0.3]
    },
};

#[test]
fn the_angular_momentum_changes_by_the_torque_of_the_law() {
    let errors = [2e-4, 1e-4].map(|time_step: f64| {
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
        parts.laws = laws(&[&RING]);
        parts.bearings =
            vec![Bearing { stations: vec![0.5], bore: Default::default(), ..bearing(0) }];
        let machine = Machine::new(parts).expect("a machine");
        let steps = (0.02 / time_step).round() as usize;
        let mut options = options(time_step, steps);
        options.initial[0].speed = 60.0;
        [options.initial[0].position, options.initial[0].velocity] =
            [vec![1e-3; 2 * DISCS], (0..2 * DISCS).map(|i| 0.5 * (i as f64).cos()).collect()];
        // Torque about the axis of the fixed frame: e × F + M_z, from the formula alone.
        let torque = |state: &State| {
            let (sin, cos) = state.q[0].sin_cos();
            let place = 1 + 2 * 2;
            let turn = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
            let [x, y] = turn(state.q[place], state.q[place + 1]);
            let [vx, vy] = turn(state.v[place], state.v[place + 1]);
            let omega = state.v[0];
            let z = [omega, x, y, state.q[0], vx - omega * y, vy + omega * x];
            let out = (RING.value)(&z.map(Dual64::from_re));
            x * out[2].re - y * out[0].re + out[1].re
        };
        let mut march = March::new(&machine, &options).expect("starts");
        let start = momentum(&machine, &march);
        let (mut impulse, mut before, mut worst) = (0.0, torque(march.state()), 0.0_f64);
        for _ in 0..steps {
            march.advance().expect("converges");
            let after = torque(march.state());
            impulse += 0.5 * time_step * (before + after);
            before = after;
            worst = worst.max((momentum(&machine, &march) - start - impulse).abs());
        }
        assert!(impulse.abs() > 1e-3, "{impulse}");
        worst
    });
    let ratio = errors[0] / errors[1];
    assert!(errors[0] < 1e-4 && (3.0..5.0).contains(&ratio), "{errors:?}, ratio {ratio}");
}

/// A brake by a moment, and no force.
pub(super) static MOMENT: Formula = Formula {
    name: "moment",
    inputs: &["omega"],
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| vec![Dual64::from_re(0.0), Dual64::from_re(0.0), z[0] * z[0] * -0.02],
};

/// A moment counts as the force that it is at the journal's surface.
#[test]
fn moments_are_measured_over_the_journals_radius() {
    let change = |radius: f64| {
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
        parts.laws = laws(&[&MOMENT]);
        let bore = Default::default();
        let journal_radius = Some(radius);
        parts.bearings = vec![Bearing { stations: vec![0.5], bore, journal_radius, ..bearing(0) }];
        let machine = Machine::new(parts).expect("a machine");
        let mut options = options(1e-3, 1);
        options.initial[0].speed = 40.0;
        // One iteration is too few, and leaves its change of force behind.
        (options.newton.max_iterations, options.newton.max_halvings) = (1, 0);
        let go_on = &mut |_: &_| std::ops::ControlFlow::Continue(());
        let failure = march(&machine, &options, go_on).expect_err("one iteration");
        let Error::NewtonDiverged { force_change, .. } = failure.error else {
            panic!("{}", failure.error)
        };
        force_change
    };
    // By Newton's method from the prediction, of the moment −0.02 ω² N·m on 0.05 kg·m².
    let (omega, dt) = (40.0, 1e-3);
    let moment = |omega: f64| -0.02 * omega * omega;
    let predicted = omega + dt * moment(omega) / INERTIA;
    // ω̇ = 2 (ω − ω_n)/Δt − ω̇_n, so that the residual at the prediction is M(ω_p) − M(ω_n).
    let slope = INERTIA * 2.0 / dt + 0.04 * predicted;
    let solved = predicted + (moment(predicted) - moment(omega)) / slope;
    let expected = (moment(solved) - moment(predicted)).abs();
    // Over a metre where there is no radius.
    for (radius, arm) in [(RADIUS, RADIUS), (0.1 * RADIUS, 0.1 * RADIUS), (0.0, 1.0)] {
        let found = change(radius) * arm;
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} N·m, expected {expected} N·m");
    }
}

/// Full annular contact: a radial stiffness beyond the gap, damping of the surroundings.
static ANNULUS: Formula = Formula {
    name: "annulus",
    inputs: &["e_x", "e_y"],
    outputs: &["F_x", "F_y"],
    value: |z| {
        let [x, y] = z else { panic!("two inputs") };
        let r = (*x * *x + *y * *y).sqrt();
        let push = if r.re > 1e-3 { (r - 1e-3) * 1e5 / r } else { Dual64::from_re(0.0) };
        vec![-push * x, -push * y]
    },
};

#[test]
fn an_unbalanced_mass_rubs_all_around_in_the_closed_form() {
    let law = laws(&[&ANNULUS]).remove(0);
    let [x, y, fx, fy] = Jeffcott::rubs(law, stops("annulus", 1e-3, &[], 0), (2e-5, 20_000));
    for i in x.len() - 2000..x.len() {
        let (r, push) = (x[i].hypot(y[i]), fx[i].hypot(fy[i]));
        // The amplitude is printed to 1e-6 mm; (Ω Δt)²/12 = 4e-7 changes it by less. N is k_c (r − c).
        assert!((r - 1e6 * Jeffcott::ORBIT).abs() < 2e-3, "r = {r} µm at row {i}");
        assert!((push - Jeffcott::PUSH).abs() < 2e-4, "N = {push} N at row {i}");
    }
}

#[test]
fn what_a_law_lacks_is_said() {
    let refused = |law: &'static Formula, support: Support, bearing: Bearing| {
        let mut parts = parts(discs(1e5), support, Rotation::Free);
        parts.laws = laws(&[law]);
        parts.bearings = vec![bearing];
        match Machine::new(parts) {
            Err(error @ Error::Law { bearing, .. }) => {
                assert_eq!(bearing, Some(0));
                error.to_string()
            }
            Err(error) => panic!("{error}"),
            Ok(_) => panic!("{} is refused", law.name),
        }
    };
    let free = || Bearing { bore: Default::default(), ..bearing(0) };
    let text = refused(&RUB, Support::rigid(&[]), free());
    assert!(text.contains("radius for v_t") && text.contains("journal_radius = "), "{text}");
    static MIXED: Formula = Formula { outputs: &["Q", "F_x"], ..FILM };
    let text = refused(&MIXED, bores(), bearing(0));
    assert!(text.contains("gives Q, a force of a spring, and F_x"), "{text}");
    static FOREIGN: Formula = Formula { inputs: &["h", "e_x"], ..FILM };
    let text = refused(&FOREIGN, bores(), bearing(0));
    assert!(text.contains("but takes e_x"), "{text}");
    static ALONE: Formula = Formula { outputs: &["T"], ..FILM };
    let text = refused(&ALONE, bores(), bearing(0));
    assert!(text.contains("gives T, but a spring needs Q"), "{text}");
    static MISSPELT: Formula = Formula { outputs: &["M_zz"], ..RING };
    let text = refused(&MISSPELT, bores(), bearing(0));
    assert!(text.contains("did you mean M_z?"), "{text}");
}
