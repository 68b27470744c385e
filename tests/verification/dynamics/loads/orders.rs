//! Orders of an angle, and tables over it.

use std::f64::consts::TAU;
use std::sync::Arc;

use whirl_solver::curve::Curve;
use whirl_solver::dynamics::March;
use whirl_solver::loads::{Frame, Load, Release, Target, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;

use super::rigid_turn;
use crate::dynamics::{discs, force, options, parts};

const ORDER: f64 = 2.0;
const PHASE: f64 = 0.7;

/// The lateral displacement of a disc after a run-up from rest through six revolutions under a load over the angle.
fn displacement(time_function: TimeFunction) -> f64 {
    let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
    let node = parts.bodies[0].nodes()[1].clone();
    let drive = TimeFunction::UntilSpeed(Target {
        speed: 200.0,
        from_above: false,
        release: Release::Located,
    });
    parts.loads = vec![
        force(&node, [300.0, -100.0, 0.0], time_function, Frame::Space),
        Load::couple(0, rigid_turn(), [0.0, 0.0, 30.0], drive, Frame::Body),
    ];
    let machine = Machine::new(parts).expect("a machine");
    let options = options(2e-4, 2000);
    let mut march = March::new(&machine, &options).expect("starts");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    // The work of a load that follows an angle, and of a couple that ends within a step.
    let energy = march.energy();
    assert!(energy.work_in > 10.0 && energy.error_fraction() < 1e-3, "{energy:?}");
    let state = march.state();
    assert!(state.q[0] > 6.0 * TAU, "{}", state.q[0]);
    state.q[3]
}

#[test]
fn an_order_is_its_table_to_third_order() {
    let exact = displacement(TimeFunction::Order { body: 0, order: ORDER, phase: PHASE });
    let errors = [24_u32, 48, 96].map(|count| {
        let angle = |row: u32| TAU / ORDER * f64::from(row) / f64::from(count);
        let rows: Vec<[f64; 2]> =
            (0..=count).map(|row| [angle(row), (ORDER * angle(row) + PHASE).sin()]).collect();
        let curve = Arc::new(Curve::smooth(&rows, true).expect("a curve"));
        (displacement(TimeFunction::OverAngle { body: 0, curve }) / exact - 1.0).abs()
    });
    println!("order against table of 24, 48, 96 rows: {errors:?}");
    assert!(exact.abs() > 1e-5 && errors[0] < 1e-2, "{exact} {errors:?}");
    assert!(errors[0] / errors[1] > 7.0 && errors[1] / errors[2] > 7.0, "{errors:?}");
}

/// A periodic table is the same wherever its period begins, also before its first row.
#[test]
fn a_periodic_table_may_begin_with_any_row() {
    let rows = [[30.0, 5.0], [150.0, 40.0], [400.0, -20.0], [600.0, 10.0]];
    let curve =
        |first: usize, kind: fn(&[[f64; 2]], bool) -> Result<Curve, whirl_solver::Error>| {
            let turned = (first..=first + rows.len()).map(|place| {
                let [x, y] = rows[place % rows.len()];
                [x + 720.0 * (place / rows.len()) as f64, y]
            });
            kind(&turned.collect::<Vec<_>>(), true).expect("a curve")
        };
    for kind in [Curve::smooth, Curve::linear] {
        let own = curve(0, kind);
        for other in (1..rows.len()).map(|first| curve(first, kind)) {
            for x in (-80..130).map(|place| 13.7 * f64::from(place)) {
                let (found, exact) = (other.value(x), own.value(x));
                // Rounding of x, by slopes below 1.
                assert!((found - exact).abs() < 1e-11, "{x}: {found} for {exact}");
            }
        }
    }
}

/// A load that follows what does not turn is refused.
#[test]
fn a_load_follows_a_body_that_turns() {
    let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
    let node = parts.bodies[0].nodes()[1].clone();
    for body in [1, 7] {
        let order = TimeFunction::Order { body, order: 1.0, phase: 0.0 };
        parts.loads.push(force(&node, [1.0, 0.0, 0.0], order, Frame::Space));
    }
    assert!(Machine::new(parts).is_err());
}
