//! `whirl lateral`: the table of API 617 against ROSS, variants of a case, and what is wrong with one.

use std::cell::RefCell;

use super::{column, numbers, ran, section};
use crate::workbench::Workbench;

pub(super) const CASE: &str = include_str!("lateral.toml");

/// The example rotor of ROSS with damped bearings (c_xx = c_yy = 1000 N·s/m), by the matrices of ROSS 2.3.0: K and M of
/// its elements, and of its M and G, with S that turns x to y, H = −(MS + ½G), Y = −MS² − ½GS and the G of a case, ½GS.
pub(super) fn bench(case: &str) -> Workbench {
    macro_rules! with {
        ($bench:expr, $($name:literal)*) => {
            $bench$(.file($name, include_str!(concat!("../../data/ross-example/", $name))))*
        };
    }
    let bench =
        with!(Workbench::new(), "K.mtx" "M.mtx" "Y.mtx" "H.mtx" "G.mtx" "load.mtx" "dofs.csv");
    bench.file("case.toml", case)
}

pub(super) fn lateral(bench: &Workbench) -> String {
    ran(bench, &["lateral", "case.toml", "--out", "out", "--no-figures"]).stdout
}

/// Rows of the table that fit: value, speed, limit and `pass`.
pub(super) fn lines(
    bench: &Workbench,
    unbalance: &str,
    quantity: &str,
    place: &str,
) -> Vec<(f64, f64, f64, String)> {
    let of = |name: &str| column(bench, "out/api.csv", name);
    let number = |name: &str| numbers(bench, "out/api.csv", name);
    let (unbalances, quantities, places) = (of("unbalance"), of("quantity"), of("place"));
    let (values, speeds, limits, passes) =
        (number("value"), number("speed_rpm"), number("limit"), of("pass"));
    (0..values.len())
        .filter(|&k| unbalances[k] == unbalance && quantities[k] == quantity && places[k] == place)
        .map(|k| (values[k], speeds[k], limits[k], passes[k].clone()))
        .collect()
}

fn line(
    bench: &Workbench,
    unbalance: &str,
    quantity: &str,
    place: &str,
) -> (f64, f64, f64, String) {
    let all = lines(bench, unbalance, quantity, place);
    assert_eq!(all.len(), 1, "{unbalance}, {quantity}, {place}: {all:?}");
    all[0].clone()
}

/// Both programs solve the same matrices: what differs is rounding of the reduction, and of peaks that both seek to 1e-8.
fn agree(what: &str, found: f64, known: f64) {
    assert!((found / known - 1.0).abs() < 1e-7, "{what}: {found}, {known}");
}

/// `Rotor.api617_unbalance` and `run_clearance_analysis` of ROSS at commit 6320eab9f890 (pull request 1377, after 2.3.0), which
/// samples speeds; peaks, half powers and `run_level1` by ROSS 2.3.0, of which the former were refined.
#[test]
fn the_table_of_a_rotor_is_that_of_ross() {
    let source =
        "ROSS 2.3.0, and its `run_clearance_analysis` at commit 6320eab9f890, on the same matrices";
    let test = "the_table_of_a_rotor_is_that_of_ross";
    let section = RefCell::new(section("API 617: the table of a rotor", source, test));
    let agree = |what: &str, found: f64, known: f64| {
        section.borrow_mut().compare(what, known, found, 1e-7);
    };
    let bench = bench(CASE);
    let text = lateral(&bench);
    let names = column(&bench, "out/api.unbalance.csv", "unbalance");
    assert_eq!(names, ["mode 1", "mode 2", "mode 2"]);
    let of = |name: &str| numbers(&bench, "out/api.unbalance.csv", name);
    let z = of("z_mm");
    assert!(z.iter().zip([750.0, 0.0, 1500.0]).all(|(own, z)| (own - z).abs() < 1e-6), "{z:?}");
    for (own, known) in
        of("load_kg").iter().zip([88.18180401658343, 44.09090200829096, 44.09090200829096])
    {
        agree("static load W (kg)", *own, known);
    }
    for (own, known) in
        of("unbalance_g_mm").iter().zip([124.43432344562272, 62.21716172281058, 62.21716172281058])
    {
        agree("unbalance U_a (g mm)", *own, known);
    }
    let phases = of("phase_deg");
    assert_eq!((phases[1] - phases[2]).abs(), 180.0);

    // Readings and orbits at speeds that ROSS samples (rpm, µm).
    let speeds = numbers(&bench, "out/api.response.csv", "speed_rpm");
    let (places, unbalances) = (
        column(&bench, "out/api.response.csv", "place"),
        column(&bench, "out/api.response.csv", "unbalance"),
    );
    let readings = numbers(&bench, "out/api.response.csv", "unscaled_um_pkpk");
    let scale = 1.03663543848906;
    for (speed, place, known) in [
        (1000.0, "joint.DE 45 deg", 7.497174443570098),
        (1000.0, "joint.NDE 135 deg", 7.75821325030761),
        (7000.0, "joint.DE 45 deg", 16.075358719950074),
        (7000.0, "joint.NDE 135 deg", 18.377_411_377_016_31),
        (8800.0, "joint.NDE 135 deg", 24.502345816984197),
        (9000.0, "joint.NDE 135 deg", 24.463175534437076),
        (10000.0, "joint.DE 45 deg", 23.026701135726476),
        (1000.0, "joint.DE", 8.854192290748573 / scale),
        (1000.0, "output.eye", 24.099399288342703 / scale),
        (8800.0, "joint.NDE", 25.839151542324683 / scale),
        (10000.0, "output.eye", 4.650702605445936 / scale),
    ] {
        let at = |k: &usize| {
            (speeds[*k] - speed).abs() < 1e-6 && places[*k] == place && unbalances[*k] == "mode 1"
        };
        let found = (0..speeds.len()).find(at).unwrap_or_else(|| panic!("{place} at {speed} rpm"));
        agree(&format!("{place} at {speed} rpm (µm pk-pk)"), readings[found], known);
    }

    // Peaks (rpm), amplification factors, required margins (%) by hand.
    for (unbalance, place, known) in [
        (
            "mode 1",
            "joint.DE 45 deg",
            &[(868.6592102706, 20.5430352783, 16.0), (927.3590068665, 24.5496530846, 16.0)][..],
        ),
        ("mode 1", "joint.NDE 135 deg", &[(917.4492126883, 13.9126262784, 15.630427)]),
        ("mode 2", "joint.DE 45 deg", &[(2964.5521749098, 5.4458334046, 12.691658)]),
        ("mode 2", "joint.NDE 135 deg", &[(2839.0154455483, 4.5084526369, 11.349255)]),
    ] {
        // ROSS looked up to 10 000 rpm; margins are looked for up to 130 % of N_mc.
        let up_to = |quantity: &str| {
            let mut all = lines(&bench, unbalance, quantity, place);
            all.retain(|own| own.1 <= 10_000.0);
            all
        };
        let [factors, margins] = ["amplification factor", "separation margin"].map(up_to);
        assert_eq!(margins.len(), known.len());
        for ((factor, margin), (speed, known, required)) in factors.iter().zip(&margins).zip(known)
        {
            agree(&format!("{place}: peak (rpm)"), factor.1, *speed);
            agree(&format!("{place}: amplification factor"), factor.0, *known);
            agree(
                &format!("{place}: separation margin (%)"),
                margin.0,
                100.0 * (1.0 - speed / 7000.0),
            );
            assert!((margin.2 / required - 1.0).abs() < 1e-6, "{} {required}", margin.2);
            assert_eq!(margin.3, "yes");
        }
    }
    // A peak within the speeds of operation, which falls on one side only.
    let inside = lines(&bench, "mode 1", "amplification factor", "joint.NDE 135 deg");
    assert_eq!((inside.len(), inside[1].3.as_str()), (2, "yes"));
    agree("peak within the speeds of operation (rpm)", inside[1].1, 8839.551348106525);
    let most = line(&bench, "mode 1", "probe vibration A_max", "joint.DE 135 deg");
    agree("mode 1: A_max (µm pk-pk)", most.0, 24.5050577724339);
    assert_eq!((most.2, most.3.as_str()), (25.4, "yes"));
    let factor = line(&bench, "mode 1", "scale factor S_cc", "").0;
    agree("scale factor S_cc", factor, 25.4 / 24.5050577724339);
    for (place, height, limit) in [
        ("joint.DE", 36.614557482167484, 150.0),
        ("output.eye", 100.58951924812379, 375.0),
        ("joint.NDE", 36.614557482167484, 180.0),
    ] {
        let own = line(&bench, "mode 1", "scaled response at clearance", place);
        agree(&format!("{place}: scaled response (µm pk-pk)"), own.0, factor * height);
        assert!((own.2 - limit).abs() < 1e-9 && own.3 == "yes");
    }
    let most = line(&bench, "mode 2", "probe vibration A_max", "joint.DE 135 deg");
    agree("mode 2: A_max (µm pk-pk)", most.0, 91.17137286766348);
    assert_eq!(most.3, "NO");

    let (across, decrements) = (
        numbers(&bench, "out/api.stability.csv", "cross_coupling_N_m"),
        numbers(&bench, "out/api.stability.csv", "log_decrement"),
    );
    for (q, known) in [
        (0.0, 0.1329036401031138),
        (1e5, -0.31645610161690096),
        (2e5, -0.7949820444354158),
        (3e5, -1.233864268332647),
        (5e5, -1.9778833285971933),
        (1e6, -3.1586997688298553),
    ] {
        let place = across.iter().position(|own| (own - q).abs() < 1e-6).expect("Q of the curve");
        agree(&format!("log decrement at {q:e} N/m"), decrements[place], known);
    }
    let expected = line(&bench, "", "level I log decrement at Q_A", "");
    agree("level I log decrement at Q_A", expected.0, -0.31645610161690096);
    assert_eq!(expected.3, "level II");
    assert_eq!(line(&bench, "", "level II log decrement", "").3, "NO");
    assert!(text.contains("DOES NOT PASS"), "{text}");
    section.into_inner().finish();
}

/// With one speed of operation the scale factor is that of one reading of ROSS; another edition doubles the unbalance.
#[test]
fn editions_and_limits_change_what_they_say() {
    let case = CASE.replace("minimum_speed = \"7000 rpm\"", "minimum_speed = \"9000 rpm\"");
    let case = case.replace("[analysis.api.stages.one]\nstiffness = \"1e5 N/m\"\n", "");
    let older = bench(&case.replace(
        "kind = \"lateral\"",
        "kind = \"lateral\"\nedition = 7\nscale_limit = 0.25\nunbalance_modes = [1]",
    ));
    let text = lateral(&older);
    assert!(text.contains("note: no `stages`"), "{text}");
    agree(
        "U_a",
        numbers(&older, "out/api.unbalance.csv", "unbalance_g_mm")[0],
        2.0 * 124.43432344562272,
    );
    agree(
        "A_max",
        line(&older, "mode 1", "probe vibration A_max", "joint.DE 135 deg").0,
        2.0 * 24.463175534437076,
    );
    assert_eq!(line(&older, "mode 1", "scale factor S_cc", "").0, 0.25);
    let newer = bench(&case);
    lateral(&newer);
    agree("S_cc", line(&newer, "mode 1", "scale factor S_cc", "").0, 25.4 / 24.463175534437076);
    assert!(line(&newer, "", "level II log decrement", "").0 > 0.13);
}

/// A bearing in the middle: three elements of 0.25 m and a disc are beyond it.
#[test]
fn unbalance_beyond_a_bearing_is_by_the_mass_there() {
    let case = CASE
        .replace("sets = \"NODE_7\"", "sets = \"NODE_4\"")
        .replace("\"output.eye\" = \"500 um\", ", "")
        .replace("kind = \"lateral\"", "kind = \"lateral\"\nunbalance_modes = [1]");
    let bench = bench(&case);
    lateral(&bench);
    let of = |name: &str| numbers(&bench, "out/api.unbalance.csv", name);
    let place = of("z_mm").iter().position(|z| (z - 1500.0).abs() < 1e-6).expect("the end");
    let element = 7810.0 * std::f64::consts::PI * 0.025 * 0.025 * 0.25;
    agree("W", of("load_kg")[place], 3.0 * element + 32.58972765);
}

/// Placed by hand at the antinodes of the first two modes, unbalance acts as it does by itself.
#[test]
fn unbalance_that_the_case_places_acts_alike() {
    let by_hand = bench(&format!(
        "{CASE}[analysis.api.unbalance.middle]\nz = [\"750 mm\"]\nload = [\"88.18180401658343 kg\"]\n\
         [analysis.api.unbalance.ends]\nz = [\"0 mm\", \"1500 mm\"]\nload = [\"44.09090200829171 kg\", \"44.09090200829171 kg\"]\n\
         phase = [\"0 deg\", \"180 deg\"]\n"
    ));
    lateral(&by_hand);
    for (unbalance, known) in [("middle", 24.5050577724339), ("ends", 91.17137286766348)] {
        let most = |place: &str| lines(&by_hand, unbalance, "probe vibration A_max", place);
        let all: Vec<f64> = ["joint.DE 135 deg", "joint.NDE 135 deg"]
            .iter()
            .flat_map(|own| most(own))
            .map(|own| own.0)
            .collect();
        assert_eq!(all.len(), 1);
        agree(unbalance, all[0], known);
    }
}

/// A rigid rotor of 40 kg in two films: loads by its weight, clearances by its bearings, in every variant.
const FILMS: &str = r#"
title = "a rigid rotor"
gravity = ["-9.80665 m/s^2", "0 m/s^2", "0 m/s^2"]
[body.rotor]
turns = "prescribed"
speed = "6000 rpm"
mass = "40 kg"
polar_inertia = "0.2 kg*m^2"
transverse_inertia = "1.5 kg*m^2"
z = "200 mm"
[joint.left]
kind = "bearing"
journal = { body = "rotor", z = "0 mm" }
law = "ocvirk"
parameters = { mu = "20 mPa*s" }
radial_clearance = "60 um"
journal_radius = "30 mm"
length = "30 mm"
[joint.right]
kind = "bearing"
journal = { body = "rotor", z = "500 mm" }
law = "ocvirk"
parameters = { mu = "20 mPa*s" }
radial_clearance = "60 um"
journal_radius = "30 mm"
length = "30 mm"
[analysis.api]
kind = "lateral"
minimum_speed = "4000 rpm"
maximum_speed = "6000 rpm"
[analysis.api.variants.wide]
set = ["joint.left.radial_clearance = 75 um", "joint.right.radial_clearance = 75 um"]
[analysis.api.variants.thin.set]
"#;

#[test]
fn variants_set_keys_as_sweeps_do() {
    let case = FILMS.replace(
        "[analysis.api.variants.thin.set]\n",
        "[analysis.api.variants.thin]\nset = \"joint.left.parameters.mu = 10 mPa*s\"\n",
    );
    let bench = Workbench::new().file("case.toml", &case);
    lateral(&bench);
    let (variants, limits, quantities) = (
        column(&bench, "out/api.csv", "variant"),
        numbers(&bench, "out/api.csv", "limit"),
        column(&bench, "out/api.csv", "quantity"),
    );
    let limits = |variant: &str| -> Vec<f64> {
        let fits =
            |k: &usize| variants[*k] == variant && quantities[*k] == "scaled response at clearance";
        (0..limits.len()).filter(fits).map(|k| limits[k]).collect()
    };
    for (variant, limit) in [("as given", 90.0), ("wide", 112.5), ("thin", 90.0)] {
        let found = limits(variant);
        assert!(
            !found.is_empty() && found.iter().all(|own| (own - limit).abs() < 1e-9),
            "{variant}: {found:?}"
        );
    }
    let loads = numbers(&bench, "out/api.unbalance.csv", "load_kg");
    // By levers 24 kg and 16 kg, as one unbalance or two.
    assert!(
        loads
            .iter()
            .all(|own| [40.0, 24.0, 16.0].iter().any(|known| (own / known - 1.0).abs() < 1e-6)),
        "{loads:?}"
    );
    let decrements: Vec<f64> = {
        let values = numbers(&bench, "out/api.csv", "value");
        (0..values.len())
            .filter(|k| quantities[*k] == "level II log decrement")
            .map(|k| values[k])
            .collect()
    };
    assert_eq!(decrements.len(), 3);
    assert!(decrements[0] != decrements[1] && decrements[0] != decrements[2], "{decrements:?}");
}

/// A rotor that turns from y to x, with a seal that drives whirl in that sense, is the mirror image of one that turns from x to y:
/// all but rounding is the same, what is seen by probes at 45° and 135° in each other's place.
#[test]
fn a_rotor_that_turns_the_other_way_round_is_its_mirror_image() {
    let done = |speed: &str, across: &str| {
        let case = FILMS
            .split("[analysis.api.variants.wide]")
            .next()
            .expect("a case")
            .replace("\nspeed = \"6000 rpm\"", &format!("\nspeed = \"{speed}\""))
            .replace(
                "kind = \"lateral\"",
                "kind = \"lateral\"\nseals = [\"seal\"]\nunbalance_modes = [1]",
            );
        let seal = format!(
            "[joint.seal]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", z = \"250 mm\" }}\n\
             stiffness = {{ xx = \"1e4 N/m\", yy = \"1e4 N/m\", xy = \"{across} N/m\", yx = \"{} N/m\" }}\n",
            across.strip_prefix('-').map_or(format!("-{across}"), str::to_owned)
        );
        let bench = Workbench::new().file("case.toml", &format!("{case}{seal}"));
        lateral(&bench);
        bench
    };
    let (one, other) = (done("6000 rpm", "2e5"), done("-6000 rpm", "-2e5"));
    for (quantity, places) in [
        ("level II log decrement", [["", ""]; 2]),
        (
            "scaled response at clearance",
            [["joint.left", "joint.left"], ["joint.right", "joint.right"]],
        ),
        (
            "amplification factor",
            [
                ["joint.left 45 deg", "joint.left 135 deg"],
                ["joint.right 135 deg", "joint.right 45 deg"],
            ],
        ),
    ] {
        let unbalance = if quantity.starts_with("level") { "" } else { "mode 1" };
        for [place, mirrored] in places {
            let (a, b) = (
                lines(&one, unbalance, quantity, place),
                lines(&other, unbalance, quantity, mirrored),
            );
            assert_eq!(a.len(), b.len(), "{quantity}, {place}");
            assert!(quantity.starts_with("amplification") || !a.is_empty(), "{quantity}");
            for (a, b) in a.iter().zip(&b) {
                assert!((a.0 / b.0 - 1.0).abs() < 1e-6, "{quantity}, {place}: {a:?} {b:?}");
            }
        }
    }
    let driven = done("6000 rpm", "-2e5");
    let apart = |bench: &Workbench| line(bench, "", "level II log decrement", "").0;
    // What drives whirl in the sense of the rotation takes of its damping, what drives it against adds to it.
    assert!(1.01 * apart(&one) < apart(&driven), "{} {}", apart(&one), apart(&driven));
}

/// Speeds of API 617 have no sign, and `speeds` have that of the case.
#[test]
fn signs_against_the_rotation_are_refused() {
    let whole = FILMS.split("[analysis.api.variants.wide]").next().expect("a case");
    for (from, to, words) in [
        (
            "maximum_speed = \"6000 rpm\"",
            "maximum_speed = \"-6000 rpm\"",
            "`maximum_speed` must be greater than zero",
        ),
        (
            "kind = \"lateral\"",
            "kind = \"lateral\"\nspeeds = \"-8000 rpm .. 0 rpm, 9\"",
            "turns the other way round",
        ),
    ] {
        let bench = Workbench::new().file("case.toml", &whole.replace(from, to));
        let outcome = bench.whirl(&["lateral", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert!(outcome.stderr.contains(words), "{}", outcome.stderr);
    }
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let refused = |case: &str, words: &[&str]| {
        let bench = bench(case);
        let outcome = bench.whirl(&["lateral", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert!(words.iter().all(|own| outcome.stderr.contains(own)), "{}", outcome.stderr);
        assert!(!bench.path("out").exists(), "nothing is written");
    };
    let of_kind = "kind = \"lateral\"";
    let with = |line: &str| CASE.replace(of_kind, &format!("{of_kind}\n{line}"));
    refused(
        &with("probes = \"output.ey\""),
        &["there is no point `output.ey`", "case.toml", "output.eye"],
    );
    refused(&CASE.replace("\"output.eye\" =", "eye ="), &["there is no point `eye`"]);
    refused(&with("seals = [\"DE\", \"NDE\"]"), &["`rotor` has no journal"]);
    refused(
        &CASE.replace(of_kind, "kind = \"campbell\""),
        &["is of an analysis of the kind `lateral`"],
    );
    let without = CASE.split("[analysis.api]").next().expect("a case");
    refused(without, &["has no lateral analysis", "minimum_speed"]);
    let far = format!("{CASE}[analysis.api.unbalance.far]\nz = [\"2 m\"]\nload = [\"1 kg\"]\n");
    refused(&far, &["no section of", "2000 mm"]);
    let misspelt =
        format!("{CASE}[analysis.api.variants.soft]\nset = [\"joint.DE.stifness.xx = 5e5 N/m\"]\n");
    refused(&misspelt, &["stifness"]);
}

/// What is not round is refused, and so is a machine in which nothing turns.
#[test]
fn rotors_that_turn_and_are_round_are_needed() {
    let still = FILMS
        .replace("turns = \"prescribed\"\nspeed = \"6000 rpm\"\n", "turns = \"no\"\n")
        .split("[analysis.api.variants.wide]")
        .next()
        .expect("a case")
        .to_owned();
    let bench = Workbench::new().file("case.toml", &still);
    let outcome = bench.whirl(&["lateral", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
}

/// A lateral analysis passes or not, with what is least of each of its lines; variants of the case are left out.
#[test]
fn a_lateral_analysis_is_judged_at_every_point() {
    let study =
        "case = \"case.toml\"\nanalyse = \"api\"\n[vary]\nanalysis.api.scale_limit = [6.0, 2.0]\n";
    let more = "\n[analysis.api.variants.soft]\nset = [\"joint.DE.stiffness.xx = 5e5 N/m\"]\n";
    let bench = bench(&format!("{CASE}{more}")).file("study.toml", study);
    ran(&bench, &["sweep", "study.toml", "--out", "swept"]);
    lateral(&bench);
    let lines = |name: &str| column(&bench, "out/api.csv", name);
    let (variant, quantity) = (lines("variant"), lines("quantity"));
    let (value, pass) = (lines("value"), lines("pass"));
    let own: Vec<usize> = (0..value.len()).filter(|&own| variant[own] == "as given").collect();
    let failed = own.iter().filter(|&&own| pass[own] == "NO").count();
    let table = "swept/table.csv";
    let of = |what: &str| numbers(&bench, table, &format!("api.{what}"))[0];
    assert_eq!(of("lines_failed"), failed as f64);
    assert_eq!(of("pass"), f64::from(u8::from(failed == 0)));
    let all = |what: &str| -> Vec<f64> {
        let of = own.iter().filter(|&&own| quantity[own] == what);
        of.map(|&own| value[own].parse().unwrap()).collect()
    };
    let factor = all("amplification factor").into_iter().reduce(f64::max).unwrap();
    assert_eq!(of("amplification_factor"), factor);
    assert_eq!(of("level_2_log_decrement"), all("level II log decrement")[0]);
    assert!(bench.path("swept/margins.svg").is_file());
}
