//! A mass and stops, against closed forms and the values of validation manuals.

use whirl_solver::bearing::{Bearing, SpringLaw};
use whirl_solver::dynamics::{March, MarchOptions, march};
use whirl_solver::history::{History, JointColumns};
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::{LAWS, Law};

use super::{boxed, force, law, options, parts, stops};

/// A stop in the way of a mass (N/m, m), and the force that pushes it there (N).
struct Stop {
    stiffness: f64,
    gap: f64,
    mass: f64,
    spring: f64,
    force: f64,
}

impl Stop {
    /// Energy of the mass and of all that pushes it (J), from position and speed.
    fn energy(&self, x: f64, v: f64) -> f64 {
        let depth = (x - self.gap).max(0.0);
        let kinetic = 0.5 * self.mass * v * v;
        kinetic + 0.5 * self.spring * x * x + 0.5 * self.stiffness * depth * depth - self.force * x
    }

    /// Marches, and checks the energy that every step makes, by the potentials themselves.
    fn run(&self, machine: &Machine, options: &MarchOptions) -> History {
        let mut march = March::new(machine, options).unwrap_or_else(|bad| panic!("{}", bad.error));
        let at = |march: &March| [march.state().q[1], march.state().v[1]];
        let [mut x, mut v] = at(&march);
        let flowing = self.energy(x, v).abs().max(0.5 * self.mass * v * v);
        let (mut met, mut between) = (0, 0.0);
        let mut history = History::for_bearings(&[JointColumns::of("1")], &[], &[]);
        for step in 0..options.steps {
            march.advance().unwrap_or_else(|error| panic!("{error}"));
            history.push(march.row());
            let [x_end, v_end] = at(&march);
            let made = (self.energy(x_end, v_end) - self.energy(x, v)).abs();
            // Average acceleration keeps the energy of anything linear. Where a step of length d meets the stop
            // at a distance a, ½ (Q_n + Q_{n+1}) d differs from ∫Q dx by ½ k a (d − a), at most ⅛ k d².
            let length = (x_end - x).abs();
            let meets = (x > self.gap) != (x_end > self.gap);
            met += usize::from(meets);
            let most = if meets { 0.125 * self.stiffness * length * length } else { 0.0 };
            between += most;
            // Steps are solved to 1e-10 of their forces; the energies themselves have sixteen digits.
            let forces = self.spring * x.abs().max(x_end.abs())
                + self.stiffness * (x.max(x_end) - self.gap).max(0.0)
                + self.force.abs()
                + self.mass * (v_end - v).abs() / options.time_step;
            let rounding = 1e-9 * forces * length + 64.0 * f64::EPSILON * flowing;
            assert!(made <= most + rounding, "step {step} makes {made:e} J, allowed {most:e} J");
            [x, v] = [x_end, v_end];
        }
        assert!(met >= 2, "the stop is met and left");
        let [kept, lost] = [march.energy().spring_stored, march.energy().spring_dissipated];
        let depth = (x - self.gap).max(0.0);
        let stored = 0.5 * self.stiffness * depth * depth;
        // What the march says of it is no worse than the trapezium where a step meets the stop.
        let tiny = between + 1e-12 * flowing;
        assert!((kept - stored).abs() <= tiny && lost.abs() <= tiny, "{kept} {lost} {stored}");
        history
    }
}

/// Time, displacement along x (m) and force on the mass along x (N).
fn columns(history: &History) -> [Vec<f64>; 3] {
    let column = |name| history.column(name).expect("a column of every history");
    [column("t_s"), column("X1_um").iter().map(|x| 1e-6 * x).collect(), column("RX1_N")]
}

fn shipped(name: &str) -> &'static Law {
    LAWS.iter().find(|law| law.origin.name == name).expect("a shipped law")
}

/// Peaks of |force|: runs of contact as (start, end, largest force, impulse), ends between steps by a
/// straight line in displacement.
fn contacts(history: &History, gap: f64) -> Vec<[f64; 4]> {
    let [t, x, force] = columns(history);
    let mut found: Vec<[f64; 4]> = Vec::new();
    let mut current: Option<[f64; 4]> = (x[0] > gap).then_some([0.0; 4]);
    for i in 1..t.len() {
        let meets = |a: usize, b: usize| t[a] + (gap - x[a]) / (x[b] - x[a]) * (t[b] - t[a]);
        match (&mut current, x[i] > gap) {
            (None, true) => current = Some([meets(i - 1, i), 0.0, force[i].abs(), 0.0]),
            (Some(contact), true) => {
                contact[2] = contact[2].max(force[i].abs());
                contact[3] += 0.5 * (force[i] + force[i - 1]).abs() * (t[i] - t[i - 1]);
            }
            (Some(contact), false) => {
                contact[1] = meets(i - 1, i);
                found.push(*contact);
                current = None;
            }
            (None, false) => {}
        }
    }
    found
}

/// Code_Aster SDND101: 100 kg on 10 kN/m strikes a stop of 1 MN/m at 1 m/s.
#[test]
fn a_mass_on_a_spring_strikes_a_stop() {
    let mut parts =
        parts(Shaft::lumped(100.0, [1e4; 2], [0.0; 2], 0.0), Support::rigid(&[]), Rotation::Held);
    parts.laws = vec![boxed(shipped("gap-linear-1e6"))];
    parts.bearings = vec![stops("stop", 0.0, &[0.0], 0)];
    let machine = Machine::new(parts).expect("a machine");
    let mut options = options(1e-5, 40_000);
    options.initial[0].velocity = vec![1.0, 0.0];
    let stop = Stop { stiffness: 1e6, gap: 0.0, mass: 100.0, spring: 1e4, force: 0.0 };
    let history = stop.run(&machine, &options);
    let contacts = contacts(&history, 0.0);
    // The values of the manual, to the digits it prints; steps of 1e-5 s resolve them.
    assert!((contacts[0][2] - 9950.0).abs() < 1.0, "{:?}", contacts[0]);
    assert!((contacts[0][1] - contacts[0][0] - 0.03126).abs() < 1e-5, "{:?}", contacts[0]);
    assert!((contacts[0][3] - 198.05).abs() < 0.05, "{:?}", contacts[0]);
    let [t, _, force] = columns(&history);
    let later = (0..t.len()).filter(|&i| t[i] > 0.2);
    let peak = later.max_by(|&a, &b| force[a].abs().total_cmp(&force[b].abs())).expect("rows");
    assert!((t[peak] - 0.361).abs() < 5e-4, "{}", t[peak]);
    assert!((force[peak].abs() - 9950.0).abs() < 2.0, "{}", force[peak]);
}

/// Code_Aster SDND108: 1 kg falls from a height of 2 m at 1 m/s on a stop of 100 N/m; x points down.
#[test]
fn a_thrown_mass_bounces_on_a_stop() {
    let mut parts =
        parts(Shaft::lumped(1.0, [0.0; 2], [0.0; 2], 0.0), Support::rigid(&[]), Rotation::Held);
    let weight =
        force(&parts.bodies[0].nodes()[0], [10.0, 0.0, 0.0], TimeFunction::Constant, Frame::Space);
    parts.laws = vec![boxed(shipped("gap-linear-1e2"))];
    parts.bearings = vec![stops("floor", 2.0, &[0.0], 0)];
    parts.loads = vec![weight];
    let machine = Machine::new(parts).expect("a machine");
    let mut options = options(1e-4, 12_000);
    options.initial[0].velocity = vec![1.0, 0.0];
    let stop = Stop { stiffness: 100.0, gap: 2.0, mass: 1.0, spring: 0.0, force: 10.0 };
    let history = stop.run(&machine, &options);
    let first = contacts(&history, 2.0)[0];
    let [_, x, _] = columns(&history);
    let deepest = x.iter().fold(0.0, |m: f64, x| m.max(*x)) - 2.0;
    assert!((first[0] - 0.54031).abs() < 1e-5, "{first:?}");
    assert!((deepest - 0.74807).abs() < 1e-5, "{deepest}");
    assert!((first[2] - 74.807).abs() < 1e-3, "{first:?}");
    assert!((first[1] - first[0] - 0.34514).abs() < 2e-5, "{first:?}");
}

/// Springs around a ring that push only beyond the gap. Their number is 360, so that the ring is as round
/// as the gap is small; at r they push with 7.8299 N in all, as the radial contact of the closed form does:
/// Σ k (r cos α − c) cos α over r cos α > c is k n/2π (r a − c sin a), cos a = c/r.
static ANNULUS: Law = law("annulus", false, |n, h, out| {
    let (springs, c) = (360.0, 1e-3_f64);
    let a = (c / Jeffcott::ORBIT).acos();
    let stiffness =
        Jeffcott::PUSH * std::f64::consts::TAU / springs / (Jeffcott::ORBIT * a - c * a.sin());
    for j in 0..n {
        out[j] = if h[j] < 0.0 { -stiffness * h[j] } else { 0.0 };
        out[n + j] = if h[j] < 0.0 { -stiffness } else { 0.0 };
    }
});

/// Jeffcott's rotor with full annular contact: |k + k_c (1 − c/r) − mΩ² + i dΩ| r = m e Ω².
pub(super) struct Jeffcott;

impl Jeffcott {
    /// Amplitude r (m).
    pub(super) const ORBIT: f64 = 1.078299e-3;
    /// Force k_c (r − c) of the contact (N).
    pub(super) const PUSH: f64 = 7.8299;

    /// x, y (µm) and the force along them (N) of `steps` steps from the orbit in closed form, in contact by
    /// a law.
    pub(super) fn rubs(
        law: Box<dyn SpringLaw>,
        bearing: Bearing,
        (time_step, steps): (f64, usize),
    ) -> [Vec<f64>; 4] {
        let (mass, damping, stiffness, speed, offset) = (1.0, 20.0, 1e4, 110.0, 0.5e-3);
        let unbalance = mass * offset * speed * speed;
        // The numbers solve their own equation.
        let dynamic: f64 = stiffness + Self::PUSH / Self::ORBIT - mass * speed * speed;
        let needed = dynamic.hypot(damping * speed) * Self::ORBIT;
        assert!((needed / unbalance - 1.0).abs() < 1e-5);

        let mut parts = parts(
            Shaft::lumped(mass, [stiffness; 2], [damping; 2], 0.0),
            Support::rigid(&[]),
            Rotation::Held,
        );
        let frequency = speed / std::f64::consts::TAU;
        let turning = |phase: f64, direction: [f64; 3]| {
            let time_function = TimeFunction::Sine { frequency, phase };
            force(&parts.bodies[0].nodes()[0], direction, time_function, Frame::Space)
        };
        parts.loads = vec![
            turning(0.5 * std::f64::consts::PI, [unbalance, 0.0, 0.0]),
            turning(0.0, [0.0, unbalance, 0.0]),
        ];
        parts.laws = vec![law];
        parts.bearings = vec![bearing];
        let machine = Machine::new(parts).expect("a machine");
        let mut options = options(time_step, steps);
        // On the orbit, behind the unbalance by atan(dΩ / dynamic stiffness).
        let lag = (damping * speed).atan2(dynamic);
        let (x, y) = (Self::ORBIT * lag.cos(), -Self::ORBIT * lag.sin());
        [options.initial[0].position, options.initial[0].velocity] =
            [vec![x, y], vec![-speed * y, speed * x]];
        let outcome = march(&machine, &options, &mut |_| std::ops::ControlFlow::Continue(()));
        let history = outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).history;
        ["X1_um", "Y1_um", "RX1_N", "RY1_N"]
            .map(|name| history.column(name).expect("a column").to_vec())
    }
}

#[test]
fn an_unbalanced_mass_rubs_all_around() {
    let angles: Vec<f64> = (0..360).map(|j| f64::from(j).to_radians()).collect();
    let bearing = stops("annulus", 1e-3, &angles, 0);
    let [x, y, fx, fy] = Jeffcott::rubs(boxed(&ANNULUS), bearing, (5e-5, 40_000));
    for i in x.len() - 2000..x.len() {
        let (r, push) = (x[i].hypot(y[i]), fx[i].hypot(fy[i]));
        // 1° between springs of the 44° in contact: the ring is round to 1e-4 of its push.
        assert!((r - 1e6 * Jeffcott::ORBIT).abs() < 0.05, "r = {r} µm at row {i}");
        assert!((push - Jeffcott::PUSH).abs() < 0.02, "N = {push} N at row {i}");
    }
}
