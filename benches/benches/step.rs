//! One time step of the fifth analysis, with generated kernels and with hand-written ones: the same machine,
//! the same steps, in one run.

use criterion::{Criterion, criterion_group, criterion_main};
use whirl_benches::hand;
use whirl_solver::dynamics::{
    BodyStart, Integrator, March, MarchOptions, NewtonOptions, SteadyRule,
};
use whirl_solver::machine::{Machine, MachineParts};

/// Steps before the timing, so that the shaft turns and the springs switch.
const WARM: usize = 1500;

fn options() -> MarchOptions {
    MarchOptions {
        time_step: 7.4e-5,
        automatic: None,
        steps: WARM,
        integrator: Integrator::default(),
        newton: NewtonOptions::default(),
        cycle: None,
        steady_rule: SteadyRule::default(),
        stop_when_steady: false,
        initial: vec![BodyStart::default()],
        laws_at_rest: false,
    }
}

fn parts() -> MachineParts {
    whirl_cli::machine_parts("hu2003-5").unwrap_or_else(|text| panic!("{text}"))
}

fn step(c: &mut Criterion) {
    let generated = Machine::new(parts()).expect("a machine");
    let by_hand = Machine::new(MachineParts {
        motion: &hand::motion::MOTION,
        clearance: &hand::clearance::CLEARANCE,
        laws: vec![Box::new(&hand::law::NONLINEAR)],
        ..parts()
    })
    .expect("a machine");
    let mut group = c.benchmark_group("one step of analysis 5, 226 coordinates, 288 springs");
    for (name, machine) in [("generated", &generated), ("by hand", &by_hand)] {
        let mut march = March::new(machine, &options()).expect("initial accelerations");
        for _ in 0..WARM {
            march.advance().expect("the step converges");
        }
        group.bench_function(name, |b| b.iter(|| march.advance().expect("the step converges")));
    }
}

criterion_group!(steps, step);
criterion_main!(steps);
