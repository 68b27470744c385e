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

/// Two discs on a thin shaft, and a motor's curve that falls by 1 N·m per rad/s on the section of the small one: the couple follows the
/// speed of that section, and damps the torsion as the same couple does that a law makes of the journal's speed there. Of two discs on
/// a spring, 2ζ/ω of the mode follows from s³ I₁I₂ + s² c I₂ + s k (I₁ + I₂) + c k = 0, with the inertias and the frequency of the
/// modes without it.
#[test]
fn the_curve_of_a_motor_follows_the_speed_of_its_section() {
    let case = |drive: &str| {
        format!(
            "title = \"two discs\"\n[material.steel]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\n\
             density = \"7860 kg/m^3\"\n[body.r]\nturns = \"free\"\ninitial_speed = \"3000 rpm\"\nmaterial = \"steel\"\n\
             modes = 12\ndamping = \"0 s\"\naxial_restraint = \"JOURNAL1_MIDDLE\"\n\
             disc.a = {{ mass = \"2 kg\", polar_inertia = \"0.01 kg*m^2\", transverse_inertia = \"0.006 kg*m^2\", z = \"20 mm\" }}\n\
             disc.b = {{ mass = \"8 kg\", polar_inertia = \"0.1 kg*m^2\", transverse_inertia = \"0.06 kg*m^2\", z = \"480 mm\" }}\n\
             [body.r.dimensions]\nlength = \"500 mm\"\ndiameter = \"16 mm\"\nsupports = [\"100 mm\", \"400 mm\"]\n\
             support_length = \"16 mm\"\n[body.r.sets.AA]\nradius = \"8 mm\"\nz = [\"15 mm\", \"25 mm\"]\n\
             [joint.n]\nkind = \"bushing\"\nfirst = {{ body = \"r\", sets = \"JOURNAL1_MIDDLE\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}\n\
             [joint.f]\nkind = \"bushing\"\nfirst = {{ body = \"r\", sets = \"JOURNAL2_MIDDLE\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}\n{drive}"
        )
    };
    let motor = "[drives.m]\nbody = \"r\"\nsection = \"AA\"\ntable = \"motor.csv\"\n";
    let bench = Workbench::new()
        .file("without.toml", &case(""))
        .file("with.toml", &case(motor))
        .file("motor.csv", "speed [rpm], couple [N*m]\n0, 314.159265\n6000, -314.159265\n");
    let torsion = |name: &str| -> Vec<[f64; 2]> {
        ran(&bench, &["modes", name, "--speeds", "3000 rpm", "--out", "out", "--no-figures"]);
        let [frequency, damping] = ["frequency_hz", "damping_ratio"]
            .map(|column| numbers(&bench, "out/modes.csv", column));
        let whirl = super::column(&bench, "out/modes.csv", "whirl");
        let all = frequency.iter().zip(&damping).zip(&whirl);
        let own = all.filter(|((f, _), whirl)| !whirl.contains("ward") && **f < 200.0);
        own.map(|((f, damping), _)| [*f, *damping]).collect()
    };
    let [without, with] = ["without.toml", "with.toml"].map(torsion);
    let (&[[own, none]], &[[found, damping]]) = (&without[..], &with[..]) else {
        panic!("{without:?} {with:?}");
    };
    assert!(none.abs() < 1e-9, "{none}");
    let [first, second, motor] = [0.01, 0.1, 1.0];
    let stiffness = (TAU * own).powi(2) * first * second / (first + second);
    // Newton's method from the mode without the motor.
    let mut s = Complex64::new(-motor / (2.0 * first), TAU * own);
    for _ in 0..40 {
        let value = s * s * s * first * second
            + s * s * motor * second
            + s * stiffness * (first + second)
            + motor * stiffness;
        let slope =
            3.0 * s * s * first * second + 2.0 * s * motor * second + stiffness * (first + second);
        s -= value / slope;
    }
    let exact = -s.re / s.norm();
    // The shaft itself has some inertia between the discs.
    assert!((damping / exact - 1.0).abs() < 0.02, "ζ = {damping} for {exact}");
    assert!((found / own - s.norm() / (TAU * own)).abs() < 0.02, "{found} of {own}");
}

/// Two free bodies on a coupling, one pushed by a couple that nothing holds: both speed up, of which motions across the axis know
/// nothing. m ẍ + k x = 0 has no damping, whatever θ̈ is.
#[test]
fn a_couple_that_is_left_over_is_no_stiffness() {
    let body = |name: &str, inertia: &str| {
        format!(
            "[body.{name}]\nturns = \"free\"\ninitial_speed = \"3000 rpm\"\nmass = \"4 kg\"\npolar_inertia = \"{inertia} kg*m^2\"\n\
             [joint.of_{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n"
        )
    };
    let case = |push: &str| {
        format!(
            "title = \"a train that speeds up\"\n{}{}[joint.c]\nkind = \"coupling\"\nfirst = {{ body = \"motor\" }}\n\
             second = {{ body = \"load\" }}\nstiffness = \"1e4 N*m/rad\"\n\
             [loads.weight]\nbody = \"motor\"\nforce = [\"100 N\", \"0 N\", \"0 N\"]\n{push}",
            body("motor", "0.05"),
            body("load", "0.08")
        )
    };
    let push = "[loads.push]\nbody = \"motor\"\ncouple = \"100 N*m\"\n";
    for push in ["", push] {
        let workbench = Workbench::new().file("case.toml", &case(push));
        let outcome =
            ran(&workbench, &["modes", "case.toml", "--speeds", "3000 rpm", "--out", "out"]);
        let [hertz, damping] = ["frequency_hz", "damping_ratio"]
            .map(|column| numbers(&workbench, "out/modes.csv", column));
        let across = hertz.iter().filter(|own| (**own / (500.0 / TAU) - 1.0).abs() < 1e-9);
        assert_eq!(across.count(), 4, "{hertz:?}");
        assert!(damping.iter().all(|own| own.abs() < 1e-9), "{damping:?}");
        assert!(!outcome.stdout.contains("NOT STABLE"), "{}", outcome.stdout);
    }
}
