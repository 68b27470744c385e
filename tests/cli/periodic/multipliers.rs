//! Which multipliers are of the motion, and which of modes that its steps do not resolve.

use super::{analysed, column};
use crate::workbench::Workbench;

/// x″ + 0.1 x′ + x + x³ = 8.5 cos t + 0.5, just beside a doubling: its multipliers are −0.752 and −0.709, by shooting with an
/// integrator of eighth order. 60 steps a cycle make −0.952 of the first and 120 steps −0.831, so that by chance its logarithm is
/// nearly four times as large; yet the motion is resolved, and these steps cannot tell whether it is stable.
#[test]
fn an_error_of_the_steps_is_no_mode_that_they_do_not_resolve() {
    const CUBIC: &str = "kind = \"law\"\nname = \"cubic\"\ntitle = \"a cubic spring\"\nsource = \"Duffing\"\n\
        [inputs.e_x]\nunit = \"m\"\nrange = [-5, 5]\n[inputs.e_y]\nunit = \"m\"\nrange = [-5, 5]\n\
        [parameters.k]\nvalue = 1\nunit = \"N/m^3\"\n\
        [outputs.F_x]\nunit = \"N\"\nvalue = '-k*e_x^3'\n[outputs.F_y]\nunit = \"N\"\nvalue = '0*k*e_y^3'\n";
    let case = |steps: usize| {
        format!(
            "title = \"a Duffing oscillator with a bias\"\n[body.m]\nturns = \"no\"\nmass = \"1 kg\"\n\
             stiffness = {{ x = \"1 N/m\", y = \"5 N/m\" }}\ndamping = {{ x = \"0.1 N*s/m\", y = \"0.3 N*s/m\" }}\n\
             [joint.b]\nkind = \"bearing\"\njournal = {{ body = \"m\" }}\nlaw = \"cubic.toml\"\nradial_clearance = \"100 m\"\n\
             [loads.f]\nbody = \"m\"\nforce = \"8.5 N\"\nfrequency = \"{} Hz\"\n\
             [loads.g]\nbody = \"m\"\nforce = \"0.5 N\"\n\
             [analysis.cycle]\nkind = \"periodic\"\nsteps = {steps}\nmethod = \"shooting\"\n",
            1.0 / std::f64::consts::TAU
        )
    };
    let found = |steps: usize| {
        let bench = Workbench::new().file("case.toml", &case(steps)).file("cubic.toml", CUBIC);
        let outcome = analysed(&bench);
        let file = "cycle.multipliers.csv";
        let largest =
            [column(&bench, file, "modulus")[0], column(&bench, file, "modulus_of_half_steps")[0]];
        (outcome.stdout, largest)
    };
    let (told, [coarse, finer]) = found(60);
    assert!(told.contains("undecided"), "{told}");
    assert!(coarse > 0.94 && (coarse - finer) > 0.1, "{coarse} {finer}");
    let (told, [own, finer]) = found(720);
    assert!(told.contains("stable: the largest multiplier is 0.7"), "{told}");
    assert!(((4.0 * finer - own) / 3.0 - 0.7522).abs() < 2e-4, "{own} {finer}");
}
