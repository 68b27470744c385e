//! Bushings on tilts and along the axis, and over the speed, against closed forms.

use std::f64::consts::TAU;

use crate::workbench::Workbench;

use super::{march, run};

/// A wheel in the middle of a bushing.
fn wheel(joint: &str, rest: &str) -> String {
    format!(
        r#"title = "x"
[body.wheel]
turns = "prescribed"
speed = "3000 rpm"
mass = "4 kg"
polar_inertia = "0.5 kg*m^2"
transverse_inertia = "0.3 kg*m^2"
z = "20 mm"
moves_along_z = true

[joint.mount]
kind = "bushing"
first = {{ body = "wheel", z = "20 mm" }}
stiffness = {{ xx = "1e6 N/m", yy = "1e6 N/m" }}
{joint}
{rest}"#
    )
}

/// A couple that is fixed in space and begins at t = 0: I_d γ″ − i I_p Ω γ′ + k γ = M with γ = α + iβ.
#[test]
fn a_wheel_on_a_tilting_stiffness_nutates_as_a_gyroscope() {
    let joint = "tilting_stiffness = { xx = \"2e4 N*m/rad\", yy = \"2e4 N*m/rad\" }\naxial_stiffness = \"1e6 N/m\"\n";
    let load = "[loads.turn]\nbody = \"wheel\"\ncouple = [\"10 N*m\", \"3 N*m\", \"0 N*m\"]\nframe = \"space\"\n";
    let done = run(&wheel(joint, &format!("{load}{}", march("2e-5 s", 3000))), &[]);
    let (time, mx, my) = (
        done.history.column("t_s"),
        done.history.column("MX_mount_Nm"),
        done.history.column("MY_mount_Nm"),
    );
    let (polar, across, k, moment) = (0.5, 0.3, 2e4, [10.0, 3.0]);
    let spin = polar * TAU * 50.0;
    let root = f64::sqrt(spin * spin + 4.0 * k * across);
    let [fast, slow] = [0.5 * (spin + root) / across, 0.5 * (spin - root) / across];
    for ((t, x), y) in time.iter().zip(mx).zip(my) {
        // γ k / M = 1 + (ω₂ exp(iω₁t) − ω₁ exp(iω₂t)) / (ω₁ − ω₂).
        let [fast_sin, fast_cos] = [(fast * t).sin(), (fast * t).cos()];
        let [slow_sin, slow_cos] = [(slow * t).sin(), (slow * t).cos()];
        let real = 1.0 + (slow * fast_cos - fast * slow_cos) / (fast - slow);
        let imaginary = (slow * fast_sin - fast * slow_sin) / (fast - slow);
        let exact =
            [moment[0] * real - moment[1] * imaginary, moment[0] * imaginary + moment[1] * real];
        // Newmark's period is long by (ωΔt)²/12, a part of 1e-5 here, over some ten periods.
        let error = (-x - exact[0]).hypot(-y - exact[1]);
        assert!(error < 1e-3 * moment[0].hypot(moment[1]), "{t}: {x}, {y} for {exact:?}");
    }
}

/// Weight along the axis: m z″ + c z′ + k z = −m g.
#[test]
fn an_axial_stiffness_and_damping_carry_a_weight_along_z() {
    let joint = "tilting_stiffness = { xx = \"2e4 N*m/rad\", yy = \"2e4 N*m/rad\" }\n\
                 axial_stiffness = \"5e5 N/m\"\naxial_damping = \"300 N*s/m\"\n";
    let rest = format!(
        "[output.hub]\nquantity = \"displacement\"\nbody = \"wheel\"\ncomponents = [\"z\"]\n{}",
        march("1e-5 s", 4000)
    );
    let case =
        format!("gravity = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n{}", wheel(joint, &rest));
    let done = run(&case, &[]);
    let (m, c, k) = (4.0, 300.0, 5e5);
    let decay = c / (2.0 * m);
    let omega = f64::sqrt(k / m - decay * decay);
    let time = done.history.column("t_s");
    for ((t, z), force) in
        time.iter().zip(done.history.column("z_hub_um")).zip(done.history.column("RZ_mount_N"))
    {
        let swing = (-decay * t).exp() * ((omega * t).cos() + decay / omega * (omega * t).sin());
        let exact = -m * 9.81 / k * (1.0 - swing);
        assert!((1e-6 * z - exact).abs() < 1e-4 * m * 9.81 / k, "{t}: {z} for {exact}");
        let rate = -m * 9.81 / k
            * (-decay * t).exp()
            * (omega + decay * decay / omega)
            * (omega * t).sin();
        let exact = -k * exact - c * rate;
        assert!((force - exact).abs() < 1e-3 * m * 9.81, "{t}: {force} for {exact}");
    }
}

/// A meshed shaft on one bushing, which alone holds it against tilts and along z: a load at its end moves it as a beam that
/// is clamped elastically, its weight along z rests on the bushing.
#[test]
fn a_bushing_alone_holds_a_shaft_at_its_end() {
    let case = r#"title = "x"
gravity = ["0 m/s^2", "0 m/s^2", "9.81 m/s^2"]

[material.steel]
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
density = "7860 kg/m^3"

[body.shaft]
turns = "prescribed"
speed = "1 rpm"
material = "steel"
modes = 12

[body.shaft.dimensions]
length = "400 mm"
diameter = "20 mm"
supports = ["10 mm", "390 mm"]
support_length = "20 mm"
layers_in_support = 2
layers_between = 30
cells = { sectors = 12, rings = 4, order = 1 }

[body.shaft.sets.END]
plane = "0 mm"
within = "0.1 mm"

[joint.clamp]
kind = "bushing"
first = { body = "shaft", sets = "END" }
stiffness = { xx = "1e8 N/m", yy = "1e8 N/m" }
tilting_stiffness = { xx = "4e3 N*m/rad", yy = "4e3 N*m/rad" }
axial_stiffness = "1e6 N/m"

[loads.pull]
body = "shaft"
sets = ["JOURNAL2_RIGHT"]
direction = "y"
force = "20 N"

[output.tip]
quantity = "displacement"
body = "shaft"
set = "JOURNAL2_RIGHT"

[output.seat]
quantity = "displacement"
body = "shaft"
set = "JOURNAL1_LEFT"
components = ["z"]

[march]
time_step = "1e-5 s"
steps = 3

[start]
kind = "equilibrium"
"#;
    let done = run(case, &[]);
    let (length, radius, force) = (0.4, 0.01, 20.0);
    // The section has twelve corners and the radius of gyration of the circle, to the four digits of the reference model.
    let corner = radius * f64::sqrt(0.25 / 0.2388);
    let area = 6.0 * corner * corner * (TAU / 12.0).sin();
    let inertia = area * radius * radius / 4.0;
    let weight = -done.last("RZ_clamp_N");
    let mass = 7860.0 * area * length;
    // The force tolerance of Newton's method is 1e-3 N.
    assert!((weight - mass * 9.81).abs() < 1e-3, "{weight} for {}", mass * 9.81);
    assert!((1e-6 * done.last("z_seat_um") / (weight / 1e6) - 1.0).abs() < 0.01);
    assert!(
        (done.last("MX_clamp_Nm") / (force * length) - 1.0).abs() < 1e-4,
        "{}",
        done.last("MX_clamp_Nm")
    );
    assert!(done.last("MY_clamp_Nm").abs() < 1e-3);
    let exact = force * length.powi(3) / (3.0 * 200e9 * inertia)
        + force * length * length / 4e3
        + force / 1e8;
    let found = 1e-6 * done.last("y_tip_um");
    assert!((found / exact - 1.0).abs() < 0.01, "{found} for {exact}");
}

const FILM: &str = "# from a program for films\nspeed [rpm]; k_xx [kN/mm]; k_xy [kN/mm]; k_yx [kN/mm]; k_yy [kN/mm]; \
                    c_xx [N*s/mm]; c_xy [N*s/mm]; c_yx [N*s/mm]; c_yy [N*s/mm]\n\
                    0; 9; 0; 0; 9; 3; 0; 0; 3\n\
                    2000; 8; 2; -3; 6; 2; 0.3; 0.2; 1.5\n\
                    4000; 7; 3; -4; 5; 1.5; 0.4; 0.3; 1.2\n";

/// At the speed of a row the coefficients are those of the row; between two rows others. Beyond them the run is not sound.
#[test]
fn coefficients_over_the_speed_are_those_of_the_file() {
    let case = |speed: f64, joint: &str| {
        format!(
            r#"title = "x"
[body.rotor]
turns = "prescribed"
speed = "{speed} rpm"
mass = "40 kg"
polar_inertia = "0.5 kg*m^2"

[body.rotor.unbalance.fan]
mass = "2 g"
radius = "100 mm"

[joint.film]
kind = "bushing"
first = {{ body = "rotor" }}
{joint}
[loads.weight]
body = "rotor"
force = "-300 N"

{}"#,
            march("1e-4 s", 2000)
        )
    };
    let row = "stiffness = { xx = \"8 kN/mm\", xy = \"2 kN/mm\", yx = \"-3 kN/mm\", yy = \"6 kN/mm\" }\n\
               damping = { xx = \"2 N*s/mm\", xy = \"0.3 N*s/mm\", yx = \"0.2 N*s/mm\", yy = \"1.5 N*s/mm\" }\n";
    let table = "table = \"film.csv\"\n";
    let files = [("film.csv", FILM)];
    let last = |case: &str| {
        let done = run(case, &files);
        ["RX_film_N", "RY_film_N", "EX_film_um", "EY_film_um"].map(|name| done.last(name))
    };
    let (of_table, of_row) = (last(&case(2000.0, table)), last(&case(2000.0, row)));
    for (found, exact) in of_table.iter().zip(of_row) {
        assert!((found - exact).abs() < 1e-6 * exact.abs(), "{of_table:?} for {of_row:?}");
    }
    let between = last(&case(3000.0, table));
    assert!((between[0] - last(&case(3000.0, row))[0]).abs() > 1.0);
    let bench = Workbench::new().file("film.csv", FILM).file("case.toml", &case(6000.0, table));
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.stdout.matches("6000 rpm, limit 4000 rpm").count(), 1, "{}", outcome.stdout);
    assert!(outcome.stdout.contains("add rows to `film.csv`"), "{}", outcome.stdout);
    let said = bench.whirl(&["check", "case.toml"]).stdout;
    assert!(said.contains("stiffness and damping over speed in film.csv"), "{said}");
}

/// Nothing moves, and no energy flows: what is left of the balance is rounding, and no reason to doubt the run.
#[test]
fn a_machine_that_stands_still_is_sound() {
    let bench = Workbench::new().file("case.toml", include_str!("at-rest.toml"));
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(
        bench.summary("out")["verdict"]["sound"].as_bool(),
        Some(true),
        "{}",
        outcome.stdout
    );
    let history = bench.history("out");
    for (column, held) in [("RZ_a_N", 29.43), ("MX_a_Nm", -2.0), ("MY_a_Nm", 0.0), ("RX_a_N", 0.0)]
    {
        let values = history.column(column);
        assert!(values.iter().all(|own| (own - held).abs() < 1e-9), "{column}: {values:?}");
    }
}
