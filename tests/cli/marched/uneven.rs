//! What is not round twice over, so that its equations vary: exponents of the march, which are the logarithms of its Floquet
//! multipliers, against those by Hill's method.

use std::f64::consts::TAU;
use std::fs;

use nalgebra::Complex;

use super::exponents::{Window, exponents};
use super::{March, extrapolated, listed, nearest, push, pushed};
use crate::uneven::point_mass;
use crate::workbench::Workbench;

/// Holds motions after a push, seen once a period, against the least damped modes: their multipliers e^{λT}.
fn floquet(march: &March, workbench: Workbench, speed: &str, count: usize) {
    let (workbench, histories) = march.histories(workbench);
    let found = histories.map(|own| exponents(&own, &march.window));
    let mut modes = listed(&workbench, &["--speed", speed]);
    modes.sort_by(|a, b| b.0.re.total_cmp(&a.0.re));
    let shift = Complex::new(0.0, TAU / march.window.every);
    for (value, _) in modes.into_iter().take(count) {
        // λ but for whole turns a period.
        let turns = (value / shift).re.round();
        let own = extrapolated(found.each_ref().map(|all| nearest(all, value - shift * turns)));
        let apart = (own + shift * turns - value).norm() / value.norm();
        assert!(apart <= 1e-6, "{value}: marched {}, {apart:e} apart", own + shift * turns);
    }
}

/// Stable, and in one of its instabilities.
#[test]
fn an_asymmetric_shaft_on_an_asymmetric_ground_has_the_multipliers_of_its_march() {
    let ground = "stiffness = { xx = \"1500 N/m\", yy = \"-1500 N/m\" }\n\
                  damping = { xx = \"0.5 N*s/m\", yy = \"0.5 N*s/m\" }";
    for (omega, count) in [(60.0, 2), (89.0, 1)] {
        let speed = &format!("{omega} rad/s");
        let period = 0.5 * TAU / omega;
        let head = pushed("mass", "sets = \"NODE_1\"");
        let workbench = point_mass([0.9e4, 1.1e4], ground, "", speed);
        let case = fs::read_to_string(workbench.path("case.toml")).expect("a case") + &head;
        let columns = ["x_mass_um", "y_mass_um"];
        let window = Window { columns: &columns, from: period, every: period, count: 4 };
        let march = March { case: &case, step: period / 128.0, duration: 50.0 * period, window };
        floquet(&march, workbench.file("push.csv", &push(0.1)), speed, count);
    }
}

/// The crank of the built-in machine in springs that are not alike along x and y, in its flexible block.
#[test]
fn a_crank_in_uneven_supports_has_the_multipliers_of_its_march() {
    let built_in = include_str!("../../../specs/cases/crank.toml");
    let (machine, _) = built_in.split_once("[joint.main1]").expect("joints");
    let joint = |number: usize| {
        let sets = |kind: &str| {
            let names = ["LEFT", "MIDDLE", "RIGHT"].map(|own| format!("\"{kind}{number}_{own}\""));
            names.join(", ")
        };
        format!(
            "[joint.main{number}]\nkind = \"bushing\"\n\
             first = {{ body = \"crank\", sets = [{}] }}\nsecond = {{ body = \"block\", sets = [{}] }}\n\
             stiffness = {{ xx = \"2e7 N/m\", yy = \"5e7 N/m\" }}\n\
             damping = {{ xx = \"20 N*s/m\", yy = \"20 N*s/m\" }}\n",
            sets("JOURNAL"),
            sets("BORE")
        )
    };
    let speed = "6000 rpm";
    let case = format!(
        "{}{}{}{}",
        machine.replace("2000 rpm\"\nmaterial", "6000 rpm\"\nmaterial"),
        joint(1),
        joint(2),
        pushed("crank", "sets = \"PIN_MIDDLE\"")
    );
    let columns = ["X_main1_um", "Y_main1_um", "X_main2_um", "Y_main2_um"];
    let window = Window { columns: &columns, from: 0.05, every: 0.01, count: 16 };
    let march = March { case: &case, step: 8e-6, duration: 0.6, window };
    floquet(&march, Workbench::new().file("push.csv", &push(1e4)), speed, 2);
}
