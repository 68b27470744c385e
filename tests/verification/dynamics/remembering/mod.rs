//! Laws with states: a mass on a mount that relaxes, against exact solutions, and what a march has to carry of states.

mod carried;
mod exact;
mod judged;
mod library;
mod linear;

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::tape::Tape;
use whirl_solver::bearing::{Remembered, SpringLaw};
use whirl_solver::dynamics::{March, MarchOptions};
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::LAWS;

use super::{boxed, force, parts, stops};

/// The values of `zener-mount`: k, k_m (N/m) and tau (s); and the mass on it (kg).
const SLOW: f64 = 2e6;
const RELAXING: f64 = 1e6;
const TAU: f64 = 2e-3;
const MASS: f64 = 20.0;

/// A mass on a law of a ring, pushed along x.
fn mass_on(
    law: Box<dyn SpringLaw>,
    (push, time_function): (f64, TimeFunction),
    rotation: Rotation,
) -> Machine {
    let shaft = Shaft::lumped(MASS, [0.0; 2], [0.0; 2], 0.0);
    let mut parts = parts(shaft, Support::rigid(&[]), rotation);
    parts.laws = vec![law];
    parts.bearings = vec![stops("mount", 1e-3, &[0.0], 0)];
    let node = &parts.bodies[0].nodes()[0];
    parts.loads = vec![force(node, [push, 0.0, 0.0], time_function, Frame::Space)];
    Machine::new(parts).expect("a machine")
}

/// A law that is shipped.
fn shipped(name: &str) -> Box<dyn SpringLaw> {
    boxed(LAWS.iter().find(|law| law.origin.name == name).expect("a shipped law"))
}

/// The mass on the shipped mount.
fn on_mount(push: (f64, TimeFunction)) -> Machine {
    mass_on(shipped("zener-mount"), push, Rotation::Held)
}

/// A law of a file, by the tape.
struct Taped {
    spec: LawSpec,
    tape: Tape,
}

impl Taped {
    fn new(body: &str) -> Self {
        let head = "kind = \"law\"\nname = \"taped\"\ntitle = \"t\"\nsource = \"s\"\n";
        Taped::of(format!("{head}{body}"))
    }

    fn of(text: String) -> Self {
        let spec = LawSpec::read(&Source::new("law.toml", text));
        let spec = spec.unwrap_or_else(|errors| panic!("{errors}"));
        let tape = Tape::new(&spec.program().expect("a program"));
        Taped { spec, tape }
    }
}

/// A law of displacements and their rates in the plane with states z, which begins at `start`, and w.
fn with_states(start: &str, rates_and_outputs: &str) -> String {
    format!(
        "[inputs]
e_x = {{ unit = \"mm\", range = [-1, 1] }}
e_y = {{ unit = \"mm\", range = [-1, 1] }}
e_x_dot = {{ unit = \"mm/s\", range = [-100, 100] }}
e_y_dot = {{ unit = \"mm/s\", range = [-100, 100] }}
[states.z]
unit = \"mm\"
start = {start}
range = [-1, 1]
[states.w]
unit = \"N\"
start = \"rest\"
range = [-100, 100]
[parameters]
a = {{ value = 0.5, unit = \"mm\" }}
tau = {{ value = 3, unit = \"ms\" }}
k = {{ value = 900, unit = \"N/mm\" }}
c = {{ value = 0.2, unit = \"N*s/mm\" }}
{rates_and_outputs}"
    )
}

/// Rates of (q, q̇, z) of the mass on the shipped mount, row after row.
#[rustfmt::skip]
const ON_MOUNT: [f64; 9] = [
    0.0, 1.0, 0.0,
    -(SLOW + RELAXING) / MASS, 0.0, RELAXING / MASS,
    1.0 / TAU, 0.0, -1.0 / TAU,
];

impl SpringLaw for Taped {
    fn name(&self) -> &str {
        &self.spec.name
    }
    fn hash(&self) -> &str {
        ""
    }
    fn inputs(&self) -> Vec<&str> {
        self.spec.taken().iter().map(|own| own.name.as_str()).collect()
    }
    fn outputs(&self) -> Vec<&str> {
        self.spec.given().iter().map(|own| own.name.as_str()).collect()
    }
    fn workspace(&self) -> usize {
        self.tape.workspace()
    }
    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        self.tape.evaluate(springs, inputs, outputs, workspace);
    }
    fn states(&self) -> Vec<Remembered> {
        let own = self.spec.remembered().iter().zip(&self.spec.states);
        let own = own.map(|(input, state)| Remembered {
            name: input.name.clone(),
            unit: input.unit.dimension().si_unit(),
            start: state.start,
            range: input.range,
        });
        own.collect()
    }
}

/// Marches to the end.
fn marched(machine: &Machine, options: &MarchOptions, mut each: impl FnMut(&March)) {
    let mut march = March::new(machine, options).expect("starts");
    while !march.is_done() {
        march.advance().unwrap_or_else(|error| panic!("{error}"));
        each(&march);
    }
}
