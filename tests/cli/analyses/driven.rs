//! Trains that a body with a given speed drives, and carry couples where they stand: against closed forms.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::{numbers, ran};
use crate::workbench::Workbench;

/// A fan on an uneven bushing behind a soft coupling, driven at 3000 rpm and held back by a couple (N·m); `turns` of the fan.
fn fan(couple: f64, turns: &str) -> Workbench {
    let case = format!(
        "title = \"a fan behind a soft coupling\"\n\
         [body.fan]\nturns = \"free\"\n{turns}mass = \"10 kg\"\npolar_inertia = \"0.1 kg*m^2\"\n\
         unbalance.u = {{ mass = \"1 g\", radius = \"100 mm\" }}\n\
         [body.motor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"5 kg\"\npolar_inertia = \"0.05 kg*m^2\"\n\
         [joint.m]\nkind = \"bushing\"\nfirst = {{ body = \"motor\" }}\nstiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}\n\
         [joint.f]\nkind = \"bushing\"\nfirst = {{ body = \"fan\" }}\nstiffness = {{ xx = \"4e6 N/m\", yy = \"1.6e6 N/m\" }}\n\
         damping = {{ xx = \"100 N*s/m\", yy = \"100 N*s/m\" }}\n\
         [joint.c]\nkind = \"coupling\"\nfirst = {{ body = \"motor\" }}\nsecond = {{ body = \"fan\" }}\n\
         stiffness = \"200 N*m/rad\"\ndamping = \"1 N*m*s/rad\"\n\
         [loads.fan]\nbody = \"fan\"\ncouple = \"{couple} N*m\"\n\
         [loads.belt]\nbody = \"fan\"\nforce = \"5000 N\"\n\
         [output.f]\nquantity = \"displacement\"\nbody = \"fan\"\n"
    );
    Workbench::new().file("case.toml", &case)
}

/// m e Ω²/(k − mΩ² + icΩ), counted from the angle of the fan itself, which lags by half a radian; a belt pulls it off the axis, of
/// which the motion in space knows nothing.
#[test]
fn a_fan_that_lags_moves_along_the_axes_of_space() {
    let workbench = fan(-100.0, "");
    ran(
        &workbench,
        &["response", "case.toml", "--of", "motor", "--speeds", "3000 rpm", "--out", "out"],
    );
    let omega = 3000.0 * TAU / 60.0;
    let amplitude = |k: f64| {
        let dynamic = Complex64::new(k - 10.0 * omega * omega, 100.0 * omega);
        Complex64::from(1e-4 * omega * omega) / dynamic
    };
    // Along y the unbalance is a quarter of a turn behind.
    let [x, y] = [amplitude(4e6), -Complex64::i() * amplitude(1.6e6)];
    let points = super::column(&workbench, "out/response.csv", "point");
    let place = points.iter().position(|own| own == "output.f").expect("the output");
    let own = |name: &str| numbers(&workbench, "out/response.csv", name)[place];
    for (found, expected) in [
        (own("x_um"), 1e6 * x.norm()),
        (own("y_um"), 1e6 * y.norm()),
        (own("x_phase_deg"), x.arg().to_degrees()),
        (own("y_phase_deg"), y.arg().to_degrees()),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-6, "{found}, not {expected}");
    }
}

/// The motor holds its speed, so that the coupling carries the couple of the fan whatever both weigh.
#[test]
fn a_coupling_carries_what_the_drive_holds_against() {
    let workbench = fan(-100.0, "");
    ran(&workbench, &["torsion", "case.toml", "--out", "out", "--no-figures"]);
    let first = numbers(&workbench, "out/torsion.torques.csv", "torque_on_first_Nm");
    assert!((first[0] + 100.0).abs() < 1e-6, "{first:?}");
}

/// Of two bodies of one train that are equally fast the one with a given speed counts, and a free one takes it along.
#[test]
fn bodies_of_a_train_keep_their_ratios_whichever_is_asked_for() {
    let workbench = fan(-1.0, "initial_speed = \"3000 rpm\"\n");
    for of in [&[][..], &["--of", "fan"], &["--of", "motor"]] {
        let outcome =
            ran(&workbench, &[&["modes", "case.toml", "--speeds", "6000 rpm"], of].concat());
        for line in ["fan at 6000 rpm", "motor at 6000 rpm"] {
            assert!(outcome.stdout.contains(line), "{of:?}: {}", outcome.stdout);
        }
    }
}
