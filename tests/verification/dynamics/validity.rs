//! Measures of laws over a march: the worst value at every bearing is that of the accepted steps.

use whirl_solver::bearing::{Bearing, Worst};
use whirl_solver::dynamics::March;
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::{LAWS, Law, Validity};

use super::{bearing, bores, boxed, force, law, options, parts, stops};

fn shipped(name: &str) -> &'static Law {
    LAWS.iter().find(|law| law.origin.name == name).expect("a shipped law")
}

/// A mass that swings in an oil film and between two stops, one of which is out of reach.
#[test]
fn the_worst_values_are_those_of_the_steps() {
    let shaft = Shaft::lumped(2.0, [1e5; 2], [20.0; 2], 0.0);
    let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
    parts.laws =
        ["squeeze-film-damper", "gap-linear", "hu2003-linear"].map(|n| boxed(shipped(n))).into();
    let clearance = 1e-4;
    let film = Bearing { angles: Vec::new(), ..stops("film", clearance, &[], 0) };
    let sides = [0.0, std::f64::consts::PI];
    parts.bearings = vec![
        stops("near", 5e-5, &sides, 2),
        film,
        stops("no limit", 9e-5, &sides, 1),
        stops("far", 9e-5, &sides[..1], 2),
    ];
    let sine = |frequency| TimeFunction::Sine { frequency, phase: 0.4 };
    parts.loads = vec![
        force(&parts.bodies[0].nodes()[0], [300.0, 0.0, 0.0], sine(40.0), Frame::Space),
        force(&parts.bodies[0].nodes()[0], [0.0, 200.0, 0.0], sine(55.0), Frame::Space),
    ];
    let machine = Machine::new(parts).expect("a machine");
    let measures = machine.springs.measures();
    let names: Vec<(usize, &str)> =
        measures.iter().map(|own| (own.bearing, own.validity.name.as_str())).collect();
    // Law after law, each with its bearings; a law without measures has none.
    assert_eq!(names, [(1, "eccentricity"), (1, "slenderness"), (0, "film"), (3, "film")]);
    let mut march = March::new(&machine, &options(2e-4, 400)).expect("starts");
    assert!(march.worst().iter().all(Option::is_none));
    let (mut near, mut far, mut ratio) = ((f64::INFINITY, 0.0), (f64::INFINITY, 0.0), (0.0, 0.0));
    for step in 1..=400 {
        march.advance().unwrap_or_else(|error| panic!("{error}"));
        let time = f64::from(step) * 2e-4;
        let [x, y] = [march.state().q[1], march.state().q[2]];
        let least = |worst: &mut (f64, f64), value: f64| {
            if value < worst.0 {
                *worst = (value, time);
            }
        };
        least(&mut near, 5e-5 - x.abs());
        least(&mut far, 9e-5 - x);
        least(&mut ratio, -x.hypot(y) / clearance);
    }
    let worst: Vec<Worst> = march.worst().iter().map(|own| own.expect("measured")).collect();
    let [eccentricity, slenderness, at_near, at_far] = worst.as_slice() else { panic!("four") };
    let pairs = [(eccentricity, (-ratio.0, ratio.1)), (at_near, near), (at_far, far)];
    for (found, (value, time)) in pairs {
        // A few roundings apart.
        assert!((found.value - value).abs() < 1e-12 * value.abs().max(1e-4), "{found:?} {value}");
        assert_eq!(found.time, time);
    }
    assert!(near.0 < 4e-5 && ratio.0 < -0.1, "it swings: {near:?} {ratio:?}");
    // A constant is as bad in the first step as in any other.
    assert_eq!((slenderness.value, slenderness.time), (0.25, 2e-4));
    assert!(measures[2].excess(near.0) < 0.0 && measures[0].excess(1.0) > 0.0);
}

/// h, at most 1.02 mm; and its rate.
pub(super) static MEASURED: Law = Law {
    valid: &[
        Validity {
            name: "thickness",
            title: "",
            help: "",
            unit: "mm",
            per_unit: 1e-3,
            limits: [f64::NEG_INFINITY, 1.02e-3],
        },
        Validity {
            name: "rate",
            title: "",
            help: "",
            unit: "m/s",
            per_unit: 1.0,
            limits: [-1.0, 1.0],
        },
    ],
    measure: |springs, inputs, measures| measures.copy_from_slice(&inputs[..2 * springs]),
    ..law("measured", true, super::FILM.evaluate)
};

/// Every spring of every plane of a bearing counts, and of no other: two bearings in one bore, of which one has
/// twice the clearance, on a support that moves.
#[test]
fn every_spring_of_a_bearing_counts() {
    let mut parts = parts(super::discs(1e6), bores(), Rotation::Held);
    parts.laws = vec![boxed(&MEASURED)];
    let wide = Bearing { clearance: 2e-3, stations: vec![0.5], ..bearing(0) };
    parts.bearings = vec![bearing(0), wide];
    parts.loads = vec![force(
        &parts.bodies[0].nodes()[2],
        [3.0, 1.0, 0.0],
        TimeFunction::Sine { frequency: 60.0, phase: 0.0 },
        Frame::Space,
    )];
    let machine = Machine::new(parts).expect("a machine");
    let mut march = March::new(&machine, &options(1e-3, 20)).expect("starts");
    for _ in 0..20 {
        march.advance().unwrap_or_else(|error| panic!("{error}"));
    }
    let value = |place: usize| march.worst()[place].expect("measured").value;
    assert!(1e-3 < value(0) && value(0) < 1.9e-3, "{}", value(0));
    assert!(2e-3 < value(2) && value(2) < 2.9e-3, "{}", value(2));
    // The plane of the second is one of the first.
    assert!(value(3).abs() > 0.0 && value(1).abs() >= value(3).abs());
}
