//! Rows of tables that are far closer than steps: none is passed over, whatever it does to the motion that meets it.

use crate::workbench::Workbench;

/// A rotor of 0.01 kg·m² that turns freely in a bushing.
fn rotor(table: &str, march: &str) -> String {
    format!(
        "title = \"x\"\n[body.a]\nturns = \"free\"\ninitial_speed = \"600 rpm\"\nmass = \"1 kg\"\n\
         polar_inertia = \"0.01 kg*m^2\"\n[joint.b]\nkind = \"bushing\"\nfirst = {{ body = \"a\" }}\n\
         stiffness = {{ xx = \"1e4 N/m\", yy = \"1e4 N/m\" }}\n{table}\nbody = \"a\"\ntable = \"t.csv\"\n\
         [march]\n{march}\n"
    )
}

const METHODS: [&str; 4] = [
    "time_step = \"1e-4 s\"",
    "time_step = \"5e-4 s\"",
    "time_step = \"5e-4 s\"\nintegrator = \"generalized-alpha\"",
    "time_step = \"auto\"\noutput_step = \"5e-4 s\"",
];

fn last_speed(case: &str, table: &str) -> f64 {
    let bench = Workbench::new().file("case.toml", case).file("t.csv", table);
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(bench.summary("out")["verdict"]["sound"], true, "{}", outcome.stdout);
    bench.history("out").last("omega_rad_s")
}

/// The work of a couple over an angle is what its table says, so the rotor has what is left of its energy: it goes on, as slow as
/// that, and is not thrown back, though going back conserves energy as well.
#[test]
fn a_pulse_over_an_angle_takes_its_work() {
    let start = std::f64::consts::TAU * 10.0;
    for (half, share) in [(5e-4, 0.1_f64), (0.02, 0.3), (0.05, 0.5), (0.5, 0.85)] {
        let peak = share * 0.5 * 0.01 * start.powi(2) / f64::to_radians(half);
        let table = format!(
            "angle [deg], couple [N*m]\n0, 0\n{}, 0\n90, {}\n{}, 0\n400, 0\n",
            90.0 - half,
            -peak,
            90.0 + half
        );
        for method in METHODS {
            let case = rotor("[loads.m]", &format!("{method}\nduration = \"0.05 s\""));
            let (found, exact) = (last_speed(&case, &table), start * (1.0 - share).sqrt());
            // An impulse of a pulse over an angle has 1 % of what a row adds, of the speed that it takes.
            let allowed = 0.01 * (start - exact);
            assert!((found - exact).abs() < allowed, "{half}° {method}: {found} for {exact}");
        }
    }
}

/// A motor that brakes at one speed holds the rotor there, however narrow the dip.
#[test]
fn a_dip_over_the_speed_is_not_tunnelled() {
    let table = "speed [rpm], couple [N*m]\n0, 10\n999.9, 10\n1000, -50\n1000.1, 10\n9000, 10\n";
    // Where the falling line is zero.
    let exact = std::f64::consts::TAU / 60.0 * (999.9 + 0.1 * 10.0 / 60.0);
    for method in METHODS {
        let case = rotor("[drives.m]", &format!("{method}\nduration = \"0.2 s\""));
        let found = last_speed(&case, table);
        assert!((found / exact - 1.0).abs() < 1e-5, "{method}: {found} for {exact}");
    }
}

/// An impulse of 1e-3 N·m·s over a microsecond or two, whatever the method carries from part to part.
#[test]
fn a_pulse_over_time_has_its_impulse() {
    let start = std::f64::consts::TAU * 10.0;
    let table = "time [s], couple [N*m]\n0, 0\n0.01003, 0\n0.010031, 1000\n0.010032, 0\n1, 0\n";
    let damped = |radius: f64| {
        format!(
            "time_step = \"1e-4 s\"\nintegrator = \"generalized-alpha\"\nspectral_radius = {radius}"
        )
    };
    let methods = METHODS.map(str::to_owned).into_iter().chain([damped(0.01), damped(0.5)]);
    for method in methods {
        let case = rotor("[drives.m]", &format!("{method}\nduration = \"0.1 s\""));
        let found = last_speed(&case, table);
        assert!((found - start - 0.1).abs() < 1e-7, "{method}: {found}");
    }
}
