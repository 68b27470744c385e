//! Torques of a history: a column for every bearing whose law turns or brakes the journal, and for no other.

use std::ops::ControlFlow;

use whirl_solver::bearing::Bearing;
use whirl_solver::dynamics::march;
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;

use super::contacts::MOMENT;
use super::quality::MOUNT;
use super::{FILM, bearing, boxed, discs, options, parts};

/// Springs, a ring that pushes, and two rings that brake, one in three planes and one in one.
#[test]
fn every_bearing_that_brakes_has_the_torque_of_its_planes() {
    let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
    parts.laws = vec![boxed(&FILM), Box::new(&MOUNT), Box::new(&MOMENT)];
    let in_planes = |law: usize, stations: &[f64]| {
        let bore = Default::default();
        Bearing { bore, journal_radius: Some(0.03), stations: stations.to_vec(), ..bearing(law) }
    };
    parts.bearings = vec![
        in_planes(2, &[0.0, 0.5, 1.0]),
        in_planes(0, &[0.5]),
        in_planes(1, &[0.5]),
        in_planes(2, &[0.5]),
    ];
    let machine = Machine::new(parts).expect("a machine");
    let mut options = options(1e-3, 5);
    options.initial[0].speed = 40.0;
    let outcome = march(&machine, &options, &mut |_| ControlFlow::Continue(())).expect("marches");
    let history = outcome.history;
    let torques: Vec<&String> =
        history.names().iter().filter(|name| name.starts_with("MZ")).collect();
    assert_eq!(torques, ["MZ1_Nm", "MZ4_Nm"]);
    let column = |name| history.column(name).expect("a column");
    let (first, last) = (column("MZ1_Nm"), column("MZ4_Nm"));
    for (row, speed) in column("omega_rad_s").iter().enumerate() {
        let moment = -0.02 * speed * speed;
        assert!((first[row] / (3.0 * moment) - 1.0).abs() < 1e-12, "{} {moment}", first[row]);
        assert!((last[row] / moment - 1.0).abs() < 1e-12, "{} {moment}", last[row]);
        assert!(column("iterations")[row] >= 1.0);
    }
}
