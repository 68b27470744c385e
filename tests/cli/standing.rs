//! What stands in space from the start on: couplings that carry their couples, speeds in films, discs and added masses by
//! their inertias, bodies that are not round.

use crate::workbench::Workbench;

const MOTOR: &str = "speed [rad/s], couple [N*m]\n0, 8\n300, 6\n600, 1\n700, -3\n";
const FAN: &str = "speed [rad/s], couple [N*m]\n0, 0\n300, -1\n600, -4\n900, -9\n";
/// Where 6 − (ω − 300)/60 is 1 + (ω − 300)/100 (rad/s), and both (N·m).
const SPEED: f64 = 487.5;
const COUPLE: f64 = 2.875;
const STIFFNESS: f64 = 400.0;

/// A rotor and a fan in bushings, with a coupling between them. `more`: keys of the rotor, of the coupling, and tables.
fn coupled([rotor, coupling, more]: [&str; 3]) -> String {
    let body = |name: &str, turns: &str, mass: f64, inertia: f64| {
        format!(
            "[body.{name}]\n{turns}\nmass = \"{mass} kg\"\npolar_inertia = \"{inertia} kg*m^2\"\n\
             [joint.of_{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\ndamping = {{ xx = \"100 N*s/m\", yy = \"100 N*s/m\" }}\n"
        )
    };
    format!(
        "title = \"coupled\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n{}{}\
         [joint.c]\nkind = \"coupling\"\nfirst = {{ body = \"rotor\" }}\nsecond = {{ body = \"fan\" }}\n\
         stiffness = \"{STIFFNESS} N*m/rad\"\n{coupling}\
         [drives.f]\nbody = \"fan\"\ntable = \"fan.csv\"\n{more}\
         [output.tw]\nquantity = \"deformation\"\njoint = \"c\"\n\
         [start]\nkind = \"equilibrium\"\n\
         [march]\ntime_step = \"1e-5 s\"\nsteps = 400\ncycle_frequency = \"1000 Hz\"\n",
        body("rotor", rotor, 6.0, 0.01),
        body("fan", "turns = \"free\"", 4.0, 0.03),
    )
}

#[test]
fn bodies_on_a_coupling_start_at_one_speed_with_the_twist_that_carries_the_couple() {
    let drive = "[drives.m]\nbody = \"rotor\"\ntable = \"motor.csv\"\n";
    let damping = "damping = \"0.1 N*m*s/rad\"\n";
    let prescribed = format!("turns = \"prescribed\"\nspeed = \"{SPEED} rad/s\"");
    let given = format!("turns = \"free\"\ninitial_speed = \"{SPEED} rad/s\"");
    let cases = [
        ("damped", coupled(["turns = \"free\"", damping, drive])),
        ("undamped", coupled(["turns = \"free\"", "", drive])),
        ("prescribed", coupled([&prescribed, "", ""])),
        ("given", coupled([&given, "", drive])),
    ];
    for (name, text) in cases {
        let bench =
            Workbench::new().file("case.toml", &text).file("motor.csv", MOTOR).file("fan.csv", FAN);
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
        assert_eq!(outcome.status, 0, "{name}: {}", outcome.stderr);
        let history = bench.history("results/case");
        let tolerance = 1e-9;
        for speed in ["omega_rad_s", "omega_fan_rad_s"] {
            for found in history.column(speed) {
                assert!((found / SPEED - 1.0).abs() < tolerance, "{name}: {speed} {found}");
            }
        }
        for found in history.column("twist_tw_rad") {
            let exact = COUPLE / STIFFNESS;
            assert!((found / exact - 1.0).abs() < 1e-6, "{name}: {found} for {exact} rad");
        }
    }
}

/// Free bodies at a given speed whose couples are not in balance: both speed up alike, and the coupling carries that.
#[test]
fn a_coupling_carries_what_speeds_up_both_sides() {
    let text = coupled([
        "turns = \"free\"\ninitial_speed = \"300 rad/s\"",
        "",
        "[drives.m]\nbody = \"rotor\"\ntable = \"motor.csv\"\n",
    ]);
    let bench =
        Workbench::new().file("case.toml", &text).file("motor.csv", MOTOR).file("fan.csv", FAN);
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    // (6 − 1) N·m on 0.04 kg·m²; of that 0.03 kg·m² are the fan's, and 1 N·m more.
    let exact = (1.0 + 0.03 * 5.0 / 0.04) / STIFFNESS;
    let twist = bench.history("results/case").column("twist_tw_rad").to_vec();
    let apart = twist.iter().map(|own| (own / exact - 1.0).abs()).fold(0.0, f64::max);
    println!("{apart:.1e}");
    // Couples fall by 1.5 % within the 4 ms, as the speeds rise by 0.5 rad/s.
    assert!(apart < 2e-3, "{apart}");
}

/// A rotor that a motor turns, in a ring that floats between two films.
fn floating(table: &str, weight: f64) -> Workbench {
    let film = |name: &str, sides: &str, radius: f64, clearance: f64| {
        format!(
            "[joint.{name}]\nkind = \"bearing\"\n{sides}\nlaw = \"ocvirk\"\nradial_clearance = \"{clearance} um\"\n\
             journal_radius = \"{radius} mm\"\nlength = \"20 mm\"\n"
        )
    };
    let text = format!(
        "title = \"a floating ring\"\n[body.rotor]\nturns = \"free\"\nmass = \"10 kg\"\npolar_inertia = \"0.02 kg*m^2\"\n\
         [body.ring]\nturns = \"free\"\nmass = \"0.5 kg\"\npolar_inertia = \"4e-4 kg*m^2\"\n{}{}\
         [loads.weight]\nbody = \"rotor\"\nforce = \"-{weight} N\"\n\
         [drives.m]\nbody = \"rotor\"\ntable = \"motor.csv\"\n\
         [start]\nkind = \"equilibrium\"\n[march]\ntime_step = \"2e-5 s\"\nsteps = 50\n",
        film("inner", "journal = { body = \"rotor\" }\nbore = { body = \"ring\" }", 25.0, 50.0),
        film("outer", "journal = { body = \"ring\" }", 32.0, 80.0),
    );
    let table = format!("speed [rad/s], couple [N*m]\n{table}");
    Workbench::new().file("case.toml", &text).file("motor.csv", &table)
}

/// Tables that end while they still drive, loads that films carry near their walls, speeds far below that without a load.
#[test]
fn a_rotor_on_a_motor_finds_its_speed_in_a_floating_ring() {
    for (table, weight) in [
        ("0, 8\n300, 6\n600, 1\n700, -3\n", 98.1),
        ("0, 8\n300, 6\n600, 1\n", 98.1),
        ("0, 8\n300, 6\n600, 1\n700, -3\n", 3000.0),
        ("0, 1\n3000, 0.5\n", 98.1),
        ("0, 1.5\n300, 0.7\n600, 0.1\n2000, -0.1\n", 800.0),
        ("0, 0.1\n30, 0.05\n60, -0.1\n", 98.1),
    ] {
        let bench = floating(table, weight);
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
        assert_eq!(outcome.status, 0, "{table} {weight}: {}", outcome.stderr);
        println!(
            "{}",
            outcome.stderr.lines().find(|line| line.contains("equilibrium")).unwrap_or("")
        );
        let history = bench.history("results/case");
        for column in ["omega_rad_s", "omega_ring_rad_s"] {
            let speeds = history.column(column);
            let moved = (speeds[speeds.len() - 1] / speeds[0] - 1.0).abs();
            // Half a millisecond in balance; where its couples are not, it gains 5 % in that time.
            assert!(moved < 1e-5, "{table} {weight}: {column} by {moved}");
        }
    }
}

/// The response of a rotor to a pulse at its end.
fn tipped(body: &str, more: &str) -> Vec<f64> {
    let text = format!(
        "title = \"tipped\"\n{body}\n[joint.l]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", z = \"0 mm\" }}\n\
         stiffness = {{ xx = \"2e6 N/m\", yy = \"2e6 N/m\" }}\n[joint.r]\nkind = \"bushing\"\n\
         first = {{ body = \"rotor\", z = \"250 mm\" }}\nstiffness = {{ xx = \"3e6 N/m\", yy = \"3e6 N/m\" }}\n\
         [loads.p]\nbody = \"rotor\"\nz = \"250 mm\"\nforce = \"100 N\"\ntable = \"pulse.csv\"\n\
         [output.p]\nquantity = \"displacement\"\nbody = \"rotor\"\nz = \"250 mm\"\n\
         [march]\ntime_step = \"1e-5 s\"\nduration = \"0.02 s\"\n{more}"
    );
    let pulse = "time [s], factor [1]\n0, 0\n0.001, 1\n0.002, 0\n";
    let bench = Workbench::new().file("case.toml", &text).file("pulse.csv", pulse);
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("results/case");
    [history.column("x_p_um"), history.column("y_p_um")].concat()
}

/// Four masses around the axis and the same inertias by numbers.
#[test]
fn masses_around_the_axis_move_as_their_inertias_do() {
    let body = |mass: f64, polar: f64, transverse: f64| {
        format!(
            "[body.rotor]\nturns = \"prescribed\"\nspeed = \"12000 rpm\"\nz = \"100 mm\"\nmass = \"{mass} kg\"\n\
             polar_inertia = \"{polar} kg*m^2\"\ntransverse_inertia = \"{transverse} kg*m^2\"\n"
        )
    };
    let added = (0..4).map(|k| {
        format!(
            "added.m{k} = {{ mass = \"0.5 kg\", radius = \"100 mm\", angle = \"{} deg\", z = \"100 mm\" }}\n",
            90 * k
        )
    });
    let added = format!("{}{}", body(3.0, 0.004, 0.004), added.collect::<String>());
    let [added, numbers] = [added, body(5.0, 0.024, 0.014)].map(|body| tipped(&body, ""));
    let peak = numbers.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    let apart = added.iter().zip(&numbers).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("{:.1e} of {peak:.2e} um", apart / peak);
    // Iterations end at a force that is a billionth of what acts.
    assert!(apart < 1e-6 * peak, "{apart} of {peak}");
}

#[test]
fn check_says_what_is_not_round_and_moves_at_twice_its_speed() {
    let bench = Workbench::new();
    let crank = bench.whirl(&["check", "crank"]);
    assert_eq!(crank.status, 0, "{}", crank.stderr);
    println!("{}", crank.stdout);
    assert!(crank.stdout.contains("is not round") && crank.stdout.contains("twice its speed"));
    let round = bench.whirl(&["check", "weight"]);
    assert!(round.status == 0 && !round.stdout.contains("is not round"), "{}", round.stdout);
}

/// Four modes end between the two of a pair, and answers to a load stand behind them: the partner is kept.
#[test]
fn answers_to_loads_leave_a_round_shaft_round() {
    for modes in [3, 4, 6, 9, 12] {
        let case = format!(
            "include = \"overhung-disc.toml\"\ntitle = \"few modes\"\n[body.rotor]\nmodes = {modes}\n\
             [body.rotor.sets.middle]\npoint = [\"0 mm\", \"0 mm\", \"180 mm\"]\nwithin = \"13 mm\"\n\
             [loads.push]\nbody = \"rotor\"\nsets = [\"middle\"]\nforce = [\"1 N\", \"0 N\", \"0 N\"]\n\
             frame = \"body\"\n"
        );
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        assert!(!outcome.stdout.contains("is not round"), "{modes}: {}", outcome.stdout);
    }
}
