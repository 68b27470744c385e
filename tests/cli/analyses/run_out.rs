//! Run-out turns with its journal: it is no part of the state that stands, and excites the order 1 as an unbalance does.

use num_complex::Complex64;

use super::{column, numbers, ran};
use crate::workbench::Workbench;

const EPSILON: [f64; 2] = [15.0, 5.0];

/// A mass on a joint, with a run-out of its journal or with an unbalance.
fn mass(law: &str, more: &str, body: &str) -> Workbench {
    let case = format!(
        "title = \"a mass on a joint\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n\
         [body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"10 kg\"\npolar_inertia = \"0.05 kg*m^2\"\n{body}\
         [joint.z]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\nlaw = \"{law}\"\nradial_clearance = \"1 mm\"\n\
         journal_radius = \"20 mm\"\nlength = \"20 mm\"\n{more}\
         [output.o]\nquantity = \"displacement\"\nbody = \"rotor\"\n"
    );
    Workbench::new().file("case.toml", &case)
}

/// The motion of the mass along x and y (µm) at order 1.
fn moved(bench: &Workbench, speed: &str) -> [Complex64; 2] {
    ran(bench, &["response", "case.toml", "--speeds", speed, "--out", "out", "--no-figures"]);
    let (points, orders) =
        (column(bench, "out/response.csv", "point"), numbers(bench, "out/response.csv", "order"));
    let of = |name: &str| numbers(bench, "out/response.csv", name);
    let [x, y] =
        ["x", "y"].map(|axis| (of(&format!("{axis}_um")), of(&format!("{axis}_phase_deg"))));
    let row = (0..points.len())
        .find(|row| points[*row] == "output.o" && orders[*row] == 1.0)
        .expect("order 1 of the mass");
    [x, y].map(|(size, phase)| Complex64::from_polar(size[row], phase[row].to_radians()))
}

/// With w = u + ε what the law sees, M ẅ + F(w) = M ε̈: w is the motion by the unbalance −Mε, whatever the law remembers. The law is
/// linear, so that rounding and the eight digits of the unbalance below are all that differs.
#[test]
fn run_out_moves_a_mass_as_the_unbalance_that_it_amounts_to() {
    let run_out = format!("run_out = [\"{} um\", \"{} um\"]\n", EPSILON[0], EPSILON[1]);
    let [x, y] = EPSILON;
    let unbalance = format!(
        "unbalance.u = {{ mass = \"10 g\", radius = \"{} mm\", angle = \"{} deg\" }}\n",
        x.hypot(y),
        (-y).atan2(-x).to_degrees()
    );
    for speed in ["500 rpm", "3000 rpm"] {
        let u = moved(&mass("zener-mount", &run_out, ""), speed);
        let w = moved(&mass("zener-mount", "", &unbalance), speed);
        let along = Complex64::new(x, y);
        for (axis, turned) in [along, -Complex64::i() * along].into_iter().enumerate() {
            let apart = (u[axis] + turned - w[axis]).norm();
            assert!(apart < 1e-6 * w[axis].norm(), "{speed}: {} {}", u[axis], w[axis]);
        }
    }
}

/// A film whose journal runs out has the coefficients and the modes of one that does not.
#[test]
fn run_out_is_no_part_of_the_state_that_stands() {
    let film = |more: &str| {
        let spring = "[joint.spring]\nkind = \"bushing\"\nfirst = { body = \"rotor\" }\n\
                      stiffness = { xx = \"5e6 N/m\", yy = \"5e6 N/m\" }\n";
        let bench = mass("ocvirk", &format!("{more}{spring}"), "");
        ran(
            &bench,
            &["coefficients", "case.toml", "--speeds", "3000 rpm", "--out", "out", "--no-figures"],
        );
        ran(
            &bench,
            &["modes", "case.toml", "--speeds", "3000 rpm", "--out", "modes", "--no-figures"],
        );
        ["k_xx_N_m", "k_xy_N_m", "c_xx_Ns_m", "e_x_um"]
            .map(|name| column(&bench, "out/coefficients.csv", name))
            .into_iter()
            .chain([column(&bench, "modes/modes.csv", "frequency_hz")])
            .collect::<Vec<_>>()
    };
    assert_eq!(film("run_out = [\"300 um\", \"0 um\"]\n"), film(""));
}
