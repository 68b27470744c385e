//! What a march over one rotation makes of small changes of its start: the growth of each mode, however fast others grow beside it.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector};
use whirl_cli::machine_parts;
use whirl_solver::dynamics::{
    BodyStart, Integrator, March, MarchOptions, NewtonOptions, SteadyRule, equilibrium,
};
use whirl_solver::equations::State;
use whirl_solver::machine::{BodyPlace, Machine};

use super::{extrapolated, listed, nearest};
use crate::workbench::Workbench;

/// Changes of positions (m) and of rates (m/s, rad/s), small beside every clearance.
const CHANGES: [f64; 2] = [1e-8, 1e-5];

/// The body turns by couples: its coordinates, two of a rigid body, turn with an angle that is unknown.
fn is_free(machine: &Machine, rotation: &usize) -> bool {
    *rotation >= machine.first_unknown()
}

/// Positions, rates and speeds of all bodies, those of free ones as space sees them; angles are left out, which round bodies do
/// not feel.
fn flattened(machine: &Machine, State { q, v, .. }: &State) -> DVector<f64> {
    let of = |place: &BodyPlace| {
        let (x, rates) = (&q[place.flexible.clone()], &v[place.flexible.clone()]);
        let Some(rotation) = place.rotation.filter(|own| is_free(machine, own)) else {
            return [x, rates].concat();
        };
        let ((sin, cos), speed) = (q[rotation].sin_cos(), v[rotation]);
        let turned = |x: f64, y: f64| [x * cos - y * sin, x * sin + y * cos];
        let moving = turned(rates[0] - speed * x[1], rates[1] + speed * x[0]);
        [&turned(x[0], x[1])[..], &moving, &[speed]].concat()
    };
    DVector::from_vec(machine.places().iter().flat_map(of).collect())
}

/// Entries of the starts of bodies in that order, each with how far it is changed.
fn entries(machine: &Machine, starts: &mut [BodyStart], each: &mut dyn FnMut(&mut f64, f64)) {
    for (place, own) in machine.places().iter().zip(starts) {
        own.position.resize(place.flexible.len(), 0.0);
        own.velocity.resize(place.flexible.len(), 0.0);
        own.position.iter_mut().for_each(|own| each(own, CHANGES[0]));
        own.velocity.iter_mut().for_each(|own| each(own, CHANGES[1]));
        if place.rotation.is_some_and(|own| is_free(machine, &own)) {
            each(&mut own.speed, CHANGES[1]);
        }
    }
}

/// What so many steps, together one rotation of the prescribed speed (rad/s), make of small changes about the equilibrium.
fn multipliers(machine: &Machine, speed: f64, steps: usize) -> Vec<Complex<f64>> {
    let time_step = TAU / speed / steps as f64;
    let rest = vec![None; machine.bodies.len()];
    let balanced = equilibrium(machine, &rest, Some(time_step)).expect("an equilibrium").bodies;
    let options = MarchOptions {
        time_step,
        automatic: None,
        steps,
        integrator: Integrator::default(),
        newton: NewtonOptions { to_rounding: true, ..NewtonOptions::default() },
        cycle: None,
        steady_rule: SteadyRule::default(),
        stop_when_steady: false,
        initial: balanced,
        laws_at_rest: false,
    };
    // The state before and after, with an entry of the start changed.
    let marched = |place: usize, sign: f64| {
        let (mut options, mut at) = (options.clone(), 0);
        entries(machine, &mut options.initial, &mut |own, size| {
            *own += if at == place { sign * size } else { 0.0 };
            at += 1;
        });
        let mut march = March::new(machine, &options).unwrap_or_else(|own| panic!("{}", own.error));
        let before = flattened(machine, march.state());
        (0..steps).for_each(|_| march.advance().expect("a step"));
        [before, flattened(machine, march.state())]
    };
    let mut size = 0;
    entries(machine, &mut options.initial.clone(), &mut |_, _| size += 1);
    let changes = (0..size).map(|place| {
        let ([before, after], [other, last]) = (marched(place, 1.0), marched(place, -1.0));
        (before - other, after - last)
    });
    let (before, after): (Vec<_>, Vec<_>) = changes.unzip();
    let [before, after] = [before, after].map(|own| DMatrix::from_columns(&own));
    let map = after * before.try_inverse().expect("changes of all coordinates");
    map.complex_eigenvalues().iter().copied().collect()
}

/// Holds the growth of the mode with about that frequency (Hz) against the march.
pub(super) fn grows_as_its_mode(case: &str, rpm: f64, hertz: f64, grows: bool) {
    let march = "[march]\ntime_step = \"1e-5 s\"\nsteps = 1\n";
    let workbench = Workbench::new().file("fine.toml", &format!("{case}\n{march}"));
    let path = workbench.path("fine.toml");
    let parts = machine_parts(path.to_str().expect("a name")).expect("a machine");
    let machine = Machine::new(parts).expect("a machine");
    let speed = rpm * TAU / 60.0;
    let found = [100, 200].map(|steps| multipliers(&machine, speed, steps));
    let all = listed(&workbench, &["--speed", &format!("{rpm} rpm")]);
    let own =
        nearest(&all.iter().map(|own| own.0).collect::<Vec<_>>(), Complex::new(0.0, TAU * hertz));
    let turn = TAU / speed;
    let marched = extrapolated(found.each_ref().map(|all| nearest(all, (own * turn).exp())));
    let marched = marched.ln() / turn;
    assert!(
        (marched - own).norm() <= 1e-4 * own.norm(),
        "{rpm} rpm, mode {own}: marched {marched}"
    );
    assert_eq!([own.re > 0.0, marched.re > 0.0], [grows; 2], "{rpm} rpm: {own}, {marched}");
}
