//! What a unit computes, against runs of cases that say the same.

use crate::bench::{Bench, History, PORT, rotor};
use crate::importer::Instance;

const DT: f64 = 1e-4;

/// Steps of `every` time steps, each held against its row of the run to the bit.
fn same(unit: &Instance, history: &History, every: usize) {
    let names = history.names();
    assert!(names.len() > 5);
    for step in 0..history.rows() / every {
        unit.step((step * every) as f64 * DT, every as f64 * DT);
        assert_eq!(unit.all(&names), history.row((step + 1) * every - 1), "step {step}");
    }
}

#[test]
fn the_numbers_are_those_of_a_run_to_the_bit() {
    let load = "[loads.beat]\nbody = \"r\"\nforce = [\"40 N\", \"-25 N\", \"0 N\"]\nfrequency = \"30 Hz\"\n\
                [loads.turning]\nbody = \"r\"\nforce = \"7 N\"\nframe = \"body\"\n";
    let bench = Bench::new(&rotor(load));
    let (folder, history) = (bench.unit(&[]), bench.history("case.toml"));
    for every in [1, 8] {
        let unit = Instance::new(&folder).unwrap().started();
        assert_eq!(unit.get("omega_rad_s"), 3000.0 * std::f64::consts::TAU / 60.0);
        same(&unit, &history, every);
    }
    // Told what it would do anyway.
    let unit = Instance::new(&folder).unwrap().started();
    for (name, value) in [("load.beat.fx", 40.0), ("load.beat.fy", -25.0), ("load.turning.fx", 7.0)]
    {
        assert_eq!(unit.get(name), value);
        unit.set(name, value);
    }
    unit.set("speed.r", unit.get("speed.r"));
    same(&unit, &history, 1);
}

/// Inputs that are not set are those of the case with the parameters as they are.
#[test]
fn inputs_follow_parameters_until_they_are_set() {
    let beat = "[loads.beat]\nbody = \"r\"\nforce = [\"40 N\", \"-25 N\", \"0 N\"]\nfrequency = \"30 Hz\"\n";
    let bench = Bench::new(&rotor(beat));
    bench.file("other.toml", &rotor(beat).replace("3000 rpm", "4500 rpm"));
    let (folder, history) =
        (bench.unit(&["--parameter", "body.r.speed"]), bench.history("other.toml"));
    let unit = Instance::new(&folder).unwrap();
    unit.set("body.r.speed", 4500.0);
    let unit = unit.started();
    assert_eq!(unit.get("speed.r"), unit.get("omega_rad_s"));
    // An importer that writes back what it reads changes nothing.
    unit.set("speed.r", unit.get("speed.r"));
    unit.set("load.beat.fx", unit.get("load.beat.fx"));
    same(&unit, &history, 1);
}

/// A force that is told at a communication point acts from there on as one of the case that begins at that time.
#[test]
fn a_told_load_is_one_that_begins_there() {
    let step = "[loads.port]\nbody = \"r\"\nforce = \"300 N\"\nstart = \"0.01 s\"\n";
    let bench = Bench::new(&rotor(PORT));
    bench.file("step.toml", &rotor(step));
    let (folder, history) = (bench.unit(&[]), bench.history("step.toml"));
    let unit = Instance::new(&folder).unwrap().started();
    let names = history.names();
    let place = |name: &str| names.iter().position(|own| own == name).unwrap();
    let [acceleration, across, couple] = ["ax_a_m_s2", "ay_a_m_s2", "M_r_Nm"].map(place);
    for step in 0..history.rows() {
        if step == 100 {
            unit.set("load.port.fx", 300.0);
        }
        unit.step(step as f64 * DT, DT);
        let (mut own, mut run) = (unit.all(&names), history.row(step));
        if step == 99 {
            // The row at the jump has what is behind it, which nobody had told the unit of.
            assert!((run[acceleration] - own[acceleration] - 300.0 / 4.0).abs() < 1e-6);
            for place in [acceleration, across, couple] {
                (own[place], run[place]) = (0.0, 0.0);
            }
        }
        assert_eq!(own, run, "step {step}");
    }
}

/// The error of held inputs is of first order in the communication step, that of linear ones of second order.
#[test]
fn inputs_have_the_orders_that_are_stated() {
    let force = |t: f64| 500.0 * (2.0 * std::f64::consts::PI * 20.0 * t).sin();
    let rate = |t: f64, length: f64| (force(t + length) - force(t)) / length;
    let sine = "[loads.port]\nbody = \"r\"\nforce = \"500 N\"\nfrequency = \"20 Hz\"\n";
    let bench = Bench::new(&rotor(PORT));
    bench.file("sine.toml", &rotor(sine));
    let (folder, history) = (bench.unit(&[]), bench.history("sine.toml"));
    let exact = history.column("X_b_um");
    let error = |every: usize, linear: bool| {
        let unit = Instance::new(&folder).unwrap().started();
        let mut worst = 0.0;
        for step in 0..400 / every {
            let (t, length) = ((step * every) as f64 * DT, every as f64 * DT);
            unit.set("load.port.fx", force(t));
            if linear {
                unit.set_rate("load.port.fx", rate(t, length));
            }
            unit.step(t, length);
            worst = f64::max(worst, (unit.get("X_b_um") - exact[(step + 1) * every - 1]).abs());
        }
        worst
    };
    let [held, halved] = [8, 4].map(|every| error(every, false));
    let ratio = held / halved;
    assert!((1.7..2.3).contains(&ratio), "held: {held} µm, {halved} µm");
    let [line, halved] = [40, 20].map(|every| error(every, true));
    let ratio = line / halved;
    assert!((3.3..4.7).contains(&ratio), "linear: {line} µm, {halved} µm");
    assert!(error(8, true) < 0.05 * held);
}

/// A speed that is told is reached in proportion to time, as a table of the case has it.
#[test]
fn told_speeds_are_lines_as_of_a_table() {
    let table = "[body.r]\nturns = \"prescribed\"\ntable = \"speed.csv\"\n";
    let told = rotor("").replace("[body.r]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\n", table);
    let bench = Bench::new(&rotor(""));
    bench.file("told.toml", &told);
    bench.file("speed.csv", "time [s], speed [rad/s]\n0, 300\n0.01, 320\n0.03, 290\n1, 290\n");
    bench.file("case.toml", &rotor("").replace("3000 rpm", "300 rad/s"));
    let (folder, history) = (bench.unit(&[]), bench.history("told.toml"));
    let unit = Instance::new(&folder).unwrap().started();
    let (speeds, angles) = (history.column("omega_rad_s"), history.column("theta_rad"));
    let place = history.column("X_b_um");
    for (step, target) in [320.0, 305.0, 290.0, 290.0].into_iter().enumerate() {
        unit.set("speed.r", target);
        unit.step(step as f64 * 0.01, 0.01);
        let last = 100 * (step + 1) - 1;
        assert!((unit.get("omega_rad_s") - speeds[last]).abs() < 1e-9, "step {step}");
        assert!((unit.get("theta_rad") - angles[last]).abs() < 1e-9, "step {step}");
        assert!((unit.get("X_b_um") - place[last]).abs() < 1e-6 * place[last].abs().max(1.0));
    }
}

/// A parameter that is set is the key of the case with that value, to the bit.
#[test]
fn parameters_are_keys_of_the_case() {
    let keys = ["--parameter", "joint.b.stiffness.xx", "--parameter", "body.r.unbalance.u.mass"];
    let bench = Bench::new(&rotor(PORT));
    let folder = bench.unit(&keys);
    bench.file(
        "other.toml",
        &rotor(PORT).replace("\"1e6 N/m\"", "\"1.3e6 N/m\"").replace("2 g", "3.7 g"),
    );
    let (own, other) = (bench.history("case.toml"), bench.history("other.toml"));
    let unit = Instance::new(&folder).unwrap();
    assert_eq!((unit.get("joint.b.stiffness.xx"), unit.get("body.r.unbalance.u.mass")), (1e6, 2.0));
    unit.set("joint.b.stiffness.xx", 1.3e6);
    unit.set("body.r.unbalance.u.mass", 3.7);
    let unit = unit.started();
    same(&unit, &other, 4);
    // After a reset it is that of the case again.
    unit.expect(|own| unsafe { whirl_fmu::fmi2Reset(own) });
    let unit = unit.started();
    same(&unit, &own, 4);
}

/// Joints, and with them columns and value references, keep their order whichever of them has a parameter.
#[test]
fn parameters_leave_joints_in_their_order() {
    let other = "[joint.a]\nkind = \"bushing\"\nfirst = { body = \"r\" }\n\
                 stiffness = { xx = \"3e5 N/m\", yy = \"4e5 N/m\" }\n";
    let bench = Bench::new(&rotor(other));
    let folder = bench.unit(&["--parameter", "joint.b.stiffness.xx"]);
    bench.file("other.toml", &rotor(other).replace("\"1e6 N/m\"", "\"1.3e6 N/m\""));
    let unit = Instance::new(&folder).unwrap();
    unit.set("joint.b.stiffness.xx", 1.3e6);
    same(&unit.started(), &bench.history("other.toml"), 4);
}

/// A beam with a foot, of which one mode is kept, with a load of this force in its middle.
fn beam(force: &str) -> String {
    format!(
        "title = \"a beam\"\n[material]\nsteel = {{ youngs_modulus = \"200 GPa\", poissons_ratio = 0.3, density = \"7860 kg/m^3\" }}\n\
         [body.s]\nturns = \"no\"\nmaterial = \"steel\"\nmodes = 1\ndamping = \"1e-4 s\"\nheld = [\"FOOT\"]\n\
         sets.FOOT = {{ plane = \"0 mm\" }}\nsections = [{{ length = \"400 mm\", outer = \"40 mm\" }}]\n\
         [body.mass]\nturns = \"no\"\nmass = \"2 kg\"\n[joint.tip]\nkind = \"bushing\"\n\
         first = {{ body = \"mass\" }}\nsecond = {{ body = \"s\", z = \"400 mm\" }}\n\
         stiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}\ndamping = {{ xx = \"2e3 N*s/m\", yy = \"2e3 N*s/m\" }}\n\
         [loads.q]\nbody = \"s\"\nz = \"150 mm\"\nforce = {force}\n\
         [output.o]\nquantity = \"displacement\"\nbody = \"s\"\nz = \"150 mm\"\ncomponents = [\"x\", \"y\", \"z\"]\n\
         [march]\ntime_step = \"2e-5 s\"\nsteps = 300\n"
    )
}

/// A body answers a load that is zero as it would one of the case, along every axis.
#[test]
fn a_port_moves_a_reduced_body_as_a_load_does() {
    let bench = Bench::new(&beam("\"0 N\""));
    let folder = bench.unit(&[]);
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        let force: Vec<&str> =
            (0..3).map(|own| if own == axis { "\"1000 N\"" } else { "\"0 N\"" }).collect();
        bench.file("told.toml", &beam(&format!("[{}]", force.join(", "))));
        let run = bench.history("told.toml").column(&format!("{letter}_o_um"));
        let unit = Instance::new(&folder).unwrap();
        unit.set(&format!("load.q.f{letter}"), 1000.0);
        let unit = unit.started();
        let most = run.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        for (step, known) in run.iter().enumerate() {
            unit.step(step as f64 * 2e-5, 2e-5);
            let own = unit.get(&format!("{letter}_o_um"));
            assert!((own - known).abs() < 1e-6 * most, "{letter}, step {step}: {own} for {known}");
        }
    }
}
