//! Laws with states that only integrate: in modes, in an equilibrium, and in a march from it or from rest.

use num_complex::Complex64;

use super::{numbers, ran};
use crate::workbench::Workbench;

/// A law that holds by the integral of the displacement alone, beside a spring and a damper: F = −k e − d ė − i z, ż = e.
const INTEGRAL: &str = r#"
kind = "law"
name = "own"
title = "spring with an integral"
source = "closed form"
[inputs]
e_x = { unit = "m", range = [-1e-3, 1e-3] }
e_y = { unit = "m", range = [-1e-3, 1e-3] }
e_x_dot = { unit = "m/s", range = [-1, 1] }
e_y_dot = { unit = "m/s", range = [-1, 1] }
[states]
z = { unit = "m*s", start = "rest", range = [-1e-3, 1e-3] }
w = { unit = "m*s", start = "rest", range = [-1e-3, 1e-3] }
[rates]
z = 'e_x'
w = 'e_y'
[parameters]
k = { value = 1e6, unit = "N/m" }
d = { value = 2000, unit = "N*s/m" }
i = { value = 5e7, unit = "N/m/s" }
[outputs.F_x]
unit = "N"
value = '-k*e_x - d*e_x_dot - i*z'
[outputs.F_y]
unit = "N"
value = '-k*e_y - d*e_y_dot - i*w'
"#;

fn integral(more: &str, march: &str) -> Workbench {
    let case = format!(
        "title = \"a mass that an integral holds\"\n{more}\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\n\
         mass = \"10 kg\"\npolar_inertia = \"1e-3 kg*m^2\"\n\
         [joint.hold]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\nlaw = \"own.toml\"\n{march}"
    );
    Workbench::new().file("own.toml", INTEGRAL).file("case.toml", &case)
}

/// λ of m λ³ + d λ² + k λ + i = 0, by Newton's method from a motion on the spring.
#[test]
fn a_state_that_only_integrates_has_modes() {
    let workbench = integral("gravity = [\"0 m/s^2\", \"-9.81 m/s^2\", \"0 m/s^2\"]", "");
    ran(&workbench, &["modes", "case.toml", "--out", "out"]);
    let (re, im) = (
        numbers(&workbench, "out/modes.csv", "real_1_s"),
        numbers(&workbench, "out/modes.csv", "imaginary_1_s"),
    );
    let [m, d, k, i] = [10.0, 2000.0, 1e6, 5e7];
    let mut value = Complex64::new(0.0, 300.0);
    for _ in 0..60 {
        let f = ((m * value + d) * value + k) * value + i;
        value -= f / ((3.0 * m * value + 2.0 * d) * value + k);
    }
    assert_eq!(re.len(), 2, "{re:?} {im:?}");
    for (re, im) in re.into_iter().zip(im) {
        let found = Complex64::new(re, im);
        assert!((found - value).norm() < 1e-8 * value.norm(), "{found}, not {value}");
    }
}

/// Its rate is zero where the balance leaves no displacement; there the integral carries the weight, and a march from there goes
/// nowhere, whether its steps are given or chosen.
#[test]
fn a_state_that_only_integrates_carries_what_stands() {
    let march = |steps: &str| {
        format!(
            "[output.at]\nquantity = \"displacement\"\nbody = \"rotor\"\n[start]\nkind = \"equilibrium\"\n[march]\n{steps}\n"
        )
    };
    for steps in [
        "time_step = \"0.1 ms\"\nsteps = 2000",
        "time_step = \"auto\"\noutput_step = \"0.1 ms\"\nduration = \"0.2 s\"",
    ] {
        let weight = "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\", \"0 m/s^2\"]";
        let workbench = integral(weight, &march(steps));
        ran(&workbench, &["run", "case.toml", "--out", "out", "--no-figures"]);
        let history = workbench.history("out");
        let names: Vec<&String> =
            history.names().iter().filter(|own| own.ends_with("_at_um")).collect();
        assert!(names.len() >= 2, "{:?}", history.names());
        for name in names {
            // 98.1 N on the spring alone would be 98 µm; rows are solved to 5e-7 of their largest term.
            let all = history.column(name).iter();
            let worst = all.fold(0.0_f64, |worst, own| worst.max(own.abs()));
            assert!(worst < 5e-7 * 98.1, "{name}: {worst}");
        }
    }
}

/// From rest in the middle under a load that begins at once the mass ends where it began, as the integral brings it back: in steps
/// that are chosen as in those that are given.
#[test]
fn a_march_with_a_state_that_only_integrates_ends_where_its_rate_is_zero() {
    let march = "[loads.push]\nbody = \"rotor\"\ndirection = \"x\"\nforce = \"100 N\"\n\
                 [output.at]\nquantity = \"displacement\"\nbody = \"rotor\"\n\
                 [march]\ntime_step = \"auto\"\noutput_step = \"0.1 ms\"\nduration = \"0.4 s\"\n";
    let workbench = integral("", march);
    ran(&workbench, &["run", "case.toml", "--out", "out", "--no-figures"]);
    let history = workbench.history("out");
    let name = history.names().iter().find(|own| *own == "x_at_um").expect("a column");
    let way = history.column(name);
    let most = way.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    let last = way.last().expect("a row").abs();
    assert!(most > 0.0 && last < 1e-3 * most, "{last} of {most}");
}

/// A controller that integrates what the speed lacks of 3000 rpm, on a rotor that a couple brakes.
const SPEED: &str = r#"
kind = "law"
name = "speed"
title = "speed controller"
source = "own"
[inputs.omega]
unit = "rad/s"
range = [0, 1000]
[parameters]
ref = { value = 3000, unit = "rpm" }
p = { value = 0.5, unit = "N*m*s" }
i = { value = 20, unit = "N*m" }
[states.q]
unit = "rad"
start = 0
range = [-3, 3]
[rates]
q = "ref - omega"
[outputs.F_x]
unit = "N"
value = "0"
[outputs.F_y]
unit = "N"
value = "0"
[outputs.M_z]
unit = "N*m"
value = "p*(ref - omega) + i*q"
"#;

fn driven(rotor: &str) -> Workbench {
    let case = format!(
        "title = \"a rotor at its speed\"\n[body.rotor]\n{rotor}\nmass = \"4 kg\"\npolar_inertia = \"0.05 kg*m^2\"\n\
         [joint.hold]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
         [joint.drive]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\nlaw = \"speed.toml\"\nradial_clearance = \"1 mm\"\n\
         [loads.brake]\nbody = \"rotor\"\ncouple = \"-10 N*m\"\n\
         [output.q]\nquantity = \"states\"\njoint = \"drive\"\n\
         [start]\nkind = \"equilibrium\"\n[march]\ntime_step = \"0.1 ms\"\nsteps = 100\n"
    );
    Workbench::new().file("speed.toml", SPEED).file("case.toml", &case)
}

/// Where the speed is open it is the one at which the rate is zero, with q = 10 N·m over 20 N·m; where it is told, nothing that q does
/// brings its rate to zero, and a start in equilibrium is refused. Modes at a told speed are those of the bushing.
#[test]
fn a_state_that_nothing_brings_to_rest_has_no_equilibrium() {
    let free = driven("turns = \"free\"");
    ran(&free, &["run", "case.toml", "--out", "out", "--no-figures"]);
    let history = free.history("out");
    assert!((history.last("q_q_rad") - 0.5).abs() < 1e-6, "{:?}", history.names());
    assert!((history.last("omega_rad_s") - 100.0 * std::f64::consts::PI).abs() < 1e-6);
    for rotor in [
        "turns = \"free\"\ninitial_speed = \"1000 rpm\"",
        "turns = \"prescribed\"\nspeed = \"1000 rpm\"",
    ] {
        let bench = driven(rotor);
        let before = bench.listing();
        let outcome = bench.whirl(&["run", "case.toml", "--out", "out"]);
        assert_ne!(outcome.status, 0, "{rotor}: {}", outcome.stdout);
        for words in ["the state q of its law speed has no equilibrium", "209.44 rad a second"] {
            assert!(outcome.stderr.contains(words), "{words}: {}", outcome.stderr);
        }
        assert_eq!(bench.listing(), before);
        ran(&bench, &["modes", "case.toml", "--speeds", "1000 rpm", "--out", "modes"]);
        let hertz = numbers(&bench, "modes/modes.csv", "frequency_hz");
        let damping = numbers(&bench, "modes/modes.csv", "damping_ratio");
        let lateral = hertz.iter().zip(&damping).filter(|own| (own.0 - 79.57747).abs() < 1e-4);
        let lateral: Vec<&f64> = lateral.map(|own| own.1).collect();
        assert!(
            lateral.len() == 2 && lateral.iter().all(|own| own.abs() < 1e-9),
            "{hertz:?} {damping:?}"
        );
    }
}
