//! The shipped cases of the reference system stay where their laws may be believed.

use whirl_solver::dynamics::{
    BodyStart, Integrator, March, MarchOptions, NewtonOptions, SteadyRule,
};
use whirl_solver::machine::Machine;

/// Steps of each analysis, as its file has them, and its step in s.
const STEPS: [(&str, usize); 5] = [
    ("hu2003-1", 4054),
    ("hu2003-2", 5405),
    ("hu2003-3", 2162),
    ("hu2003-4", 5405),
    ("hu2003-5", 5405),
];
const TIME_STEP: f64 = 7.4e-5;

#[test]
fn the_reference_system_stays_within_its_films() {
    for (case, steps) in STEPS {
        let parts = whirl_cli::machine_parts(case).unwrap_or_else(|error| panic!("{error}"));
        let machine = Machine::new(parts).unwrap_or_else(|e| panic!("{e}"));
        let options = MarchOptions {
            time_step: TIME_STEP,
            automatic: None,
            steps,
            integrator: Integrator::default(),
            newton: NewtonOptions { force_tolerance: 1e-3, ..NewtonOptions::default() },
            cycle: None,
            steady_rule: SteadyRule::default(),
            stop_when_steady: false,
            initial: vec![BodyStart::default()],
            laws_at_rest: false,
        };
        let mut march = March::new(&machine, &options).unwrap_or_else(|e| panic!("{}", e.error));
        for _ in 0..steps {
            march.advance().unwrap_or_else(|error| panic!("{case}: {error}"));
        }
        let measures = machine.springs.measures();
        assert_eq!(measures.len(), 4, "{case}: one a bearing");
        for (measure, worst) in measures.iter().zip(march.worst()) {
            let worst = worst.expect("measured");
            println!(
                "{case}: bearing {}: h = {:.3} µm at {:.4} s",
                measure.bearing + 1,
                1e6 * worst.value,
                worst.time
            );
            assert!(measure.excess(worst.value) <= 0.0, "{case}: {worst:?} of {measure:?}");
        }
    }
}
