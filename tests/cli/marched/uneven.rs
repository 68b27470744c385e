//! What is not round twice over, so that its equations vary: exponents of the march, which are the logarithms of its Floquet
//! multipliers, against those by Hill's method.

use std::fs;

use super::exponents::{Window, exponents};
use super::{March, extrapolated, listed, nearest, push, pushed};
use crate::uneven::point_mass;
use crate::workbench::Workbench;

/// Holds motions after a push against the modes, as many of the least damped ones.
fn floquet(march: &March, workbench: Workbench, speed: &str, count: usize) {
    let (workbench, histories) = march.histories(workbench);
    let found = histories.map(|own| exponents(&own, &march.window));
    let mut modes = listed(&workbench, &["--speed", speed]);
    modes.truncate(count);
    assert_eq!(modes.len(), count);
    for (value, _) in modes {
        let own = extrapolated(found.each_ref().map(|all| nearest(all, value)));
        let apart = (own - value).norm() / value.norm();
        assert!(apart <= 1e-6, "{value}: marched {own}, {apart:e} apart");
    }
}

/// Stable, and in one of its instabilities.
#[test]
fn an_asymmetric_shaft_on_an_asymmetric_ground_has_the_multipliers_of_its_march() {
    let ground = "stiffness = { xx = \"1500 N/m\", yy = \"-1500 N/m\" }\n\
                  damping = { xx = \"0.5 N*s/m\", yy = \"0.5 N*s/m\" }";
    for speed in ["60 rad/s", "89 rad/s"] {
        let head = pushed("mass", "sets = \"NODE_1\"");
        let workbench = point_mass([0.9e4, 1.1e4], ground, "", speed);
        let case = fs::read_to_string(workbench.path("case.toml")).expect("a case") + &head;
        let columns = ["x_mass_um", "y_mass_um"];
        let window = Window { columns: &columns, from: 0.01, every: 2e-3, count: 12 };
        let march = March { case: &case, step: 4e-4, duration: 0.6, window };
        floquet(&march, workbench.file("push.csv", &push(1e-3)), speed, 2);
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
             damping = {{ xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }}\n",
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
    let window = Window { columns: &columns, from: 0.004, every: 1e-4, count: 60 };
    let march = March { case: &case, step: 1e-5, duration: 0.05, window };
    floquet(&march, Workbench::new().file("push.csv", &push(1.0)), speed, 2);
}
