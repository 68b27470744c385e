//! Two units that turn each other by a couple, against one machine that has both.

use crate::bench::Bench;
use crate::importer::Instance;

/// Two discs that turn freely, joined by a coupling: relative motion from a difference of speed.
const INERTIA: [f64; 2] = [0.5, 0.2];
const STIFFNESS: f64 = 2e3;
const DAMPING: f64 = 1.5;
const DT: f64 = 1e-4;
const STEPS: usize = 2000;

fn disc(name: &str, inertia: f64, speed: f64) -> String {
    format!(
        "[body.{name}]\nturns = \"free\"\ninitial_speed = \"{speed} rad/s\"\nmass = \"10 kg\"\n\
         polar_inertia = \"{inertia} kg*m^2\"\n[joint.b{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n"
    )
}

const MARCH: &str = "[march]\ntime_step = \"1e-4 s\"\nsteps = 2000\n";

fn half(name: &str, inertia: f64, speed: f64) -> Bench {
    let port = format!("[loads.shaft]\nbody = \"{name}\"\ncouple = \"0 N*m\"\n");
    Bench::new(&format!("title = \"half\"\n{}{port}{MARCH}", disc(name, inertia, speed)))
}

#[test]
fn two_units_turn_each_other_as_one_machine_does() {
    let coupling = format!(
        "[joint.c]\nkind = \"coupling\"\nfirst = {{ body = \"m\" }}\nsecond = {{ body = \"p\" }}\n\
         stiffness = \"{STIFFNESS} N*m/rad\"\ndamping = \"{DAMPING} N*m*s/rad\"\n"
    );
    let both = disc("m", INERTIA[0], 100.0) + &disc("p", INERTIA[1], 90.0);
    let whole = Bench::new(&format!("title = \"both\"\n{both}{coupling}{MARCH}"));
    let history = whole.history("case.toml");
    let known = [history.column("omega_rad_s"), history.column("omega_p_rad_s")];
    let swing = known[1].iter().fold(0.0, |most, own| f64::max(most, (own - 90.0).abs()));
    assert!(swing > 10.0, "{swing}");

    let halves = [half("m", INERTIA[0], 100.0), half("p", INERTIA[1], 90.0)];
    let folders = halves.each_ref().map(|own| own.unit(&[]));
    // The couple of the communication point, told with the slope that it has had since the one before.
    let worst = |every: usize, linear: bool| {
        let units = folders.each_ref().map(|own| Instance::new(own).unwrap().started());
        let length = every as f64 * DT;
        let (mut before, mut most): (Option<f64>, f64) = (None, 0.0);
        for step in 0..STEPS / every {
            let angles = units.each_ref().map(|own| own.get("theta_rad"));
            let speeds = units.each_ref().map(|own| own.get("omega_rad_s"));
            let couple = STIFFNESS * (angles[0] - angles[1]) + DAMPING * (speeds[0] - speeds[1]);
            let slope = before.map_or(0.0, |own| (couple - own) / length);
            before = Some(couple);
            for (unit, sign) in units.iter().zip([-1.0, 1.0]) {
                unit.set("load.shaft.mz", sign * couple);
                if linear {
                    unit.set_rate("load.shaft.mz", sign * slope);
                }
                unit.step(step as f64 * length, length);
            }
            for (unit, known) in units.iter().zip(&known) {
                let off = unit.get("omega_rad_s") - known[(step + 1) * every - 1];
                most = most.max(off.abs());
            }
        }
        most
    };
    // Held, each half takes the couple too late by half a communication step on average: first order.
    let [coarse, fine] = [2, 1].map(|every| worst(every, false));
    assert!(fine < 0.06 * swing, "{fine} of {swing}");
    assert!((1.7..2.4).contains(&(coarse / fine)), "{coarse}, {fine}");
    // With its slope: second order.
    let [coarse, fine] = [2, 1].map(|every| worst(every, true));
    assert!(fine < 0.004 * swing, "{fine} of {swing}");
    assert!((3.3..5.0).contains(&(coarse / fine)), "{coarse}, {fine}");
}
