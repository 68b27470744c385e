//! Branches of motions over a key: folds, corners, doublings, and where they end.

use std::f64::consts::TAU;

use serde_json::Value;

use super::{column, film, followed, motions, number, rub};
use crate::workbench::Workbench;

/// Where contact all around begins and ends in rub A with N = 48 steps a turn, by the closed form with ω̃.
const CORNERS: [f64; 2] = [93.9316738679, 109.6170957619];

/// Rub A from one speed to another, in so many points.
fn branch_of_rub(ends: [f64; 2], points: usize) -> (Workbench, Vec<(String, f64)>) {
    let [from, to] = ends;
    let rest = format!(
        "steps = 48\nvary = \"mass.unbalance.speed = {from} rad/s .. {to} rad/s\"\npoints = {points}\n"
    );
    followed(&rub(from, 0.25e-3, &rest), &[])
}

/// The motion in contact folds at 287.17 rad/s and is unstable back to 109.62, where contact ends all around; the motion without contact
/// goes on from there, up to the end of the range.
#[test]
fn a_rub_is_followed_through_its_fold_and_beyond_where_contact_ends() {
    let (bench, events) = branch_of_rub([80.0, 320.0], 400);
    let of = |kind: &str| -> Vec<f64> {
        events.iter().filter(|own| own.0 == kind).map(|own| own.1).collect()
    };
    let folds = of("fold");
    assert_eq!(folds.len(), 1, "{events:?}");
    assert!((folds[0] / 287.1673208443 - 1.0).abs() < 1e-8, "{folds:?}");
    let corners = of("corner");
    assert_eq!(corners.len(), 2, "{events:?}");
    for (corner, exact) in corners.iter().zip(CORNERS) {
        assert!((corner / exact - 1.0).abs() < 1e-5, "{corner} for {exact}");
    }
    let value = column(&bench, "cycle.csv", "value");
    let most = column(&bench, "cycle.csv", "X1_um.max");
    assert_eq!(value.last(), Some(&320.0));
    let text = std::fs::read_to_string(bench.path("out/cycle.csv")).expect("a table");
    let unstable: Vec<bool> = text.lines().skip(1).map(|line| line.contains("unstable")).collect();
    // What is unstable is in contact, between the corner and the fold.
    let mut count = 0;
    for ((value, most), unstable) in value.iter().zip(&most).zip(&unstable) {
        if *unstable {
            count += 1;
            assert!((109.6..287.2).contains(value) && *most > 999.0, "{value}: {most}");
        }
    }
    assert!(count > 20, "{count}");
    let least = value.iter().zip(&unstable).filter(|own| *own.1).map(|own| *own.0);
    assert!(least.fold(f64::INFINITY, f64::min) < 112.0);
}

/// From any speed below and from above: contact begins where the closed form has it, and the branch goes on in contact.
#[test]
fn a_rub_is_followed_into_contact_from_either_side() {
    for (ends, exact) in
        [([60.0, 320.0], CORNERS[0]), ([85.0, 110.0], CORNERS[0]), ([320.0, 60.0], CORNERS[1])]
    {
        let (bench, events) = branch_of_rub(ends, 90);
        let corners: Vec<f64> =
            events.iter().filter(|own| own.0 == "corner").map(|own| own.1).collect();
        assert_eq!(corners.len(), 1, "{ends:?}: {events:?}");
        assert!((corners[0] / exact - 1.0).abs() < 1e-5, "{ends:?}: {corners:?} for {exact}");
        let most = column(&bench, "cycle.csv", "X1_um.max");
        assert!(most.last().is_some_and(|last| *last > 1001.0), "{ends:?}: {:?}", most.last());
        let value = column(&bench, "cycle.csv", "value");
        assert!(
            value.iter().all(|own| (ends[0].min(ends[1])..=ends[0].max(ends[1])).contains(own))
        );
    }
}

/// The last point is the end of the range, which a key need not outlive: there is no damping below zero. Of an undamped oscillator
/// nothing but the range ends the branch.
/// The film with unbalance doubles its period at 670.33 rad/s, in steps of 1/240 turn; the branch of two turns that begins there comes
/// to the motion of 680 rad/s that a search of its own finds, which is stable.
#[test]
fn a_branch_is_left_where_the_period_doubles() {
    let keys = "steps = 240\nvary = \"body.rotor.speed = 660 rad/s .. 680 rad/s\"\ndoublings = 1\n";
    let (bench, events) = followed(&film(660.0, 0.2, keys), &[]);
    assert_eq!(events.len(), 1, "{events:?}");
    assert_eq!(events[0].0, "period doubling");
    assert!((events[0].1 - 670.33).abs() < 0.3, "{events:?}");
    let of = |name: &str| column(&bench, "cycle.doubled-1.csv", name);
    let (values, periods) = (of("value"), of("period_s"));
    assert_eq!((values[0], values[values.len() - 1]), (events[0].1, 680.0));
    assert!((periods[periods.len() - 1] - 2.0 * TAU / 680.0).abs() < 1e-12);
    let words = std::fs::read_to_string(bench.path("out/cycle.doubled-1.csv")).expect("a table");
    assert!(words.lines().last().expect("a row").contains(",stable,"), "{words}");
    let (_, own) = motions(&film(680.0, 0.2, "steps = 480\nperiods = 2\nmarched = 60\n"));
    let columns = &own[0]["columns"];
    for name in ["RX_film_N", "EX_film_um", "EY_film_um"] {
        for end in ["min", "max"] {
            let value = number(&columns[name], end);
            let followed = of(&format!("{name}.{end}"));
            let last = followed[followed.len() - 1];
            assert!((last - value).abs() < 1e-6 * value.abs(), "{name}.{end}: {last}, {value}");
            // Of the doubling itself it is the motion of one turn.
            assert!((followed[0] - value).abs() > 1e-2 * value.abs(), "{name}.{end}: {followed:?}");
        }
    }
    let text = std::fs::read_to_string(bench.path("out/cycle.json")).expect("a summary");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(whole["doubled"][0]["periods"], 2);
    assert_eq!(whole["doubled"][0]["end"], "the end of the range");
}

#[test]
fn a_branch_ends_at_the_end_of_its_range() {
    let rest = "steps = 48\nvary = \"mass.damping = 30 N*s/m .. 0 N*s/m\"\n";
    let (bench, events) = followed(&rub(60.0, 0.05e-3, rest), &[]);
    let value = column(&bench, "cycle.csv", "value");
    assert_eq!(value.last(), Some(&0.0));
    assert!(value.windows(2).all(|own| own[0] > own[1]), "{value:?}");
    assert!(events.iter().all(|own| own.0 == "second frequency"), "{events:?}");
    // r = m e Ω²/(k − m Ω²), Ω that of the steps.
    let omega = 60.0 * (std::f64::consts::PI / 48.0).tan() / (std::f64::consts::PI / 48.0);
    let exact = 1e6 * 0.05e-3 * omega * omega / (1e4 - omega * omega);
    let most = column(&bench, "cycle.csv", "X1_um.max");
    let last = most.last().expect("points");
    assert!((last / exact - 1.0).abs() < 3e-3, "{last} for {exact}");
}

/// x″ + 0.05 x′ + x + 0.1 x³ = 0.18 cos Ωt (Krack and Gross, Harmonic Balance for Nonlinear Vibration Problems, 2019, example 01): it
/// folds at 1.2696019555 and 1.1157002518.
#[test]
fn a_duffing_oscillator_folds_where_others_find_it() {
    const CUBIC: &str = "kind = \"law\"\nname = \"cubic\"\ntitle = \"a cubic spring\"\nsource = \"Duffing\"\n\
        [inputs.e_x]\nunit = \"m\"\ntitle = \"x\"\nrange = [-5, 5]\n[inputs.e_y]\nunit = \"m\"\ntitle = \"y\"\nrange = [-5, 5]\n\
        [parameters.k]\nvalue = 0.1\nunit = \"N/m^3\"\ntitle = \"of the cube\"\n\
        [outputs.F_x]\nunit = \"N\"\ntitle = \"force\"\nvalue = '-k*e_x^3'\n\
        [outputs.F_y]\nunit = \"N\"\ntitle = \"force\"\nvalue = '-k*e_y^3'\n";
    let folds = |steps: usize| {
        let case = format!(
            "title = \"a Duffing oscillator\"\n[body.block]\nturns = \"no\"\nmass = \"1 kg\"\n\
             stiffness = {{ x = \"1 N/m\", y = \"1 N/m\" }}\ndamping = {{ x = \"0.05 N*s/m\", y = \"0.05 N*s/m\" }}\n\
             [joint.spring]\nkind = \"stop\"\njournal = {{ body = \"block\" }}\nside = \"around\"\n\
             law = \"cubic.law.toml\"\n\
             [loads.push]\nbody = \"block\"\nforce = \"0.18 N\"\nfrequency = \"0.11 Hz\"\n\
             [analysis.cycle]\nkind = \"periodic\"\nsteps = {steps}\npoints = 400\n\
             vary = \"loads.push.frequency = 0.11 Hz .. 0.24 Hz\"\n"
        );
        let (_, events) = followed(&case, &[("cubic.law.toml", CUBIC)]);
        let own = events.iter().filter(|own| own.0 == "fold").map(|own| TAU * own.1);
        let own: Vec<f64> = own.collect();
        assert_eq!(own.len(), 2, "{events:?}");
        own
    };
    let (coarse, fine) = (folds(80), folds(160));
    for ((coarse, fine), exact) in coarse.iter().zip(&fine).zip([1.2696019555, 1.1157002518]) {
        let limit = (4.0 * fine - coarse) / 3.0;
        assert!((limit - exact).abs() < 2e-6, "{limit} for {exact}: {coarse}, {fine}");
    }
}

/// A mass on a spring that meets a stop in every turn: its multipliers come together at −0.895 and one of them passes −1 at
/// 229.812 rad/s, by shooting with the exact instants at which it meets and leaves. In steps the multiplier jumps as these come to
/// other steps, though the branch goes straight on: no corner.
#[test]
fn a_doubling_is_none_the_less_one_as_contact_moves_from_step_to_step() {
    let case = "title = \"a mass at a stop\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\ndamping = \"8 N*s/m\"\n\
                [mass.unbalance]\neccentricity = \"0.3 mm\"\nspeed = \"200 rad/s\"\n[[stop]]\nside = \"above\"\ngap = \"0.05 mm\"\n\
                law = \"gap-linear\"\nparameters = { k = \"8e4 N/m\" }\n[analysis.cycle]\nkind = \"periodic\"\npoints = 400\n\
                vary = \"mass.unbalance.speed = 200 rad/s .. 250 rad/s\"\n";
    for steps in [240, 480] {
        let (_, events) = followed(&format!("{case}steps = {steps}\n"), &[]);
        assert_eq!(events.len(), 1, "{steps}: {events:?}");
        let (kind, value) = &events[0];
        assert_eq!(kind, "period doubling", "{steps}");
        assert!((value - 229.812).abs() < 0.3, "{steps}: {value}");
    }
}
