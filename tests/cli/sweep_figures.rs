//! Figures of sweeps: which there are, what they are labelled with, and that a resumed sweep draws the same.

use std::fs;
use std::process::Stdio;

use crate::workbench::Workbench;

/// A rotor off its axis between two stops, for so many steps.
fn rattler(steps: usize) -> String {
    format!(
        "title = \"a rotor that rattles\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\ndamping = \"4 N*s/m\"\n\
         unbalance = {{ eccentricity = \"0.3 mm\", speed = \"1000 rpm\" }}\n\
         [[stop]]\nside = \"above\"\ngap = \"0.2 mm\"\nlaw = \"gap-linear-1e6\"\n\
         [march]\ntime_step = \"2e-4 s\"\nsteps = {steps}\nforce_tolerance = \"1e-6 N\"\n"
    )
}

fn bench(steps: usize, study: &str) -> Workbench {
    let study = format!("case = \"rattler.toml\"\n{study}");
    Workbench::new().file("rattler.toml", &rattler(steps)).file("study.toml", &study)
}

/// Runs the sweep, and gives the figures that it has drawn.
fn drawn(bench: &Workbench, more: &[&str]) -> Vec<String> {
    let outcome = bench.whirl(&[&["sweep", "study.toml", "--out", "out"], more].concat());
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let names = bench.listing_of("out").into_iter();
    let stems: Vec<String> =
        names.filter_map(|name| name.strip_suffix(".svg").map(str::to_owned)).collect();
    for stem in &stems {
        let png = fs::read(bench.path(&format!("out/{stem}.png"))).expect("a PNG of each");
        assert!(png.starts_with(b"\x89PNG"));
    }
    stems
}

fn svg(bench: &Workbench, stem: &str) -> String {
    fs::read_to_string(bench.path(&format!("out/{stem}.svg"))).expect("a figure")
}

fn shows(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "`{word}` is not in the figure");
    }
}

#[test]
fn a_single_point_has_what_figures_of_more_need() {
    let study = "[vary]\nmass.unbalance.speed = [\"500 rpm\"]\n";
    let bench = bench(3000, study);
    assert!(drawn(&bench, &[]).is_empty());
    let more = study.replace("\"]", "\", \"900 rpm\", \"1300 rpm\"]");
    let bench = bench.file("study.toml", &format!("case = \"rattler.toml\"\n{more}"));
    let figures = drawn(&bench, &["--resume"]);
    let own = svg(&bench, "bifurcation");
    assert_eq!(drawn(&bench, &[]), figures);
    assert!(svg(&bench, "bifurcation") == own, "a figure of other points");
}

#[test]
fn over_one_value_there_are_curves_a_bifurcation_diagram_and_spectra() {
    let bench = bench(3000, "[vary]\nmass.unbalance.speed = \"500 rpm .. 2000 rpm, 7\"\n");
    let expected = ["bifurcation", "displacement", "orders", "reactions", "waterfall"];
    assert_eq!(drawn(&bench, &[]), expected);
    let x = "mass.unbalance.speed (rpm)";
    shows(
        &svg(&bench, "reactions"),
        &["study: Reactions", x, "force on the shaft (N)", "RX, vertical"],
    );
    shows(&svg(&bench, "displacement"), &[x, "displacement (µm)", "minimum and maximum"]);
    shows(&svg(&bench, "orders"), &[x, "amplitude (µm)", "1X, once a revolution", "2X, "]);
    shows(&svg(&bench, "bifurcation"), &[x, "displacement (µm)", "sampled once a cycle"]);
    shows(&svg(&bench, "waterfall"), &["frequency (Hz)", x, "1X", "2X", "½X"]);
    // In 0.3 s: 2 or 3, 3 or 4, 5, 6, 7, 8 or 9, and 10 revolutions, of X and Y, and two in the legend.
    let circles = svg(&bench, "bifurcation").matches("<circle").count();
    assert!((2 * 40 + 2..=2 * 48 + 2).contains(&circles), "{circles}");
    let before = fs::read(bench.path("out/reactions.png")).unwrap();
    assert_eq!(drawn(&bench, &["--jobs", "1", "--quiet"]), expected);
    assert!(fs::read(bench.path("out/reactions.png")).unwrap() == before, "the same bytes");
    assert!(drawn(&bench, &["--no-figures"]).is_empty(), "those of before are gone");
}

#[test]
fn over_two_values_there_are_maps_and_over_three_none() {
    let two = "[vary]\nmass.unbalance.speed = \"500 rpm .. 2000 rpm, 4\"\nmass.damping = [\"0 N*s/m\", \"4 N*s/m\", \"20 N*s/m\"]\n";
    let bench = bench(400, two);
    assert_eq!(drawn(&bench, &[]), ["displacement", "orders", "reactions"]);
    let map = svg(&bench, "reactions");
    let words = ["mass.unbalance.speed (rpm)", "mass.damping (N·s/m)", "Stop 1, largest |RX| (N)"];
    shows(&map, &words);
    // Values that are not evenly spaced are named.
    shows(&map, &[">20<", ">4<"]);
    let three = format!("{two}stop.1.gap = [\"0.1 mm\", \"0.2 mm\"]\n");
    let bench = bench.file("study.toml", &format!("case = \"rattler.toml\"\n{three}"));
    assert!(drawn(&bench, &[]).is_empty());
}

#[test]
fn a_latin_hypercube_is_drawn_over_every_key() {
    let study = "samples = 12\n[vary]\nmass.unbalance.speed = \"500 rpm .. 2000 rpm\"\nstop.1.gap = \"0.1 mm .. 0.3 mm\"\n\
                 stop.1.law = [\"gap-linear-1e6\"]\n";
    let bench = bench(400, study);
    assert_eq!(drawn(&bench, &[]), ["displacement", "orders", "reactions"]);
    shows(&svg(&bench, "displacement"), &["mass.unbalance.speed (rpm)", "stop.1.gap (mm)"]);
}

#[test]
fn texts_and_ways_are_named_and_what_is_not_sound_is_marked() {
    let laws = "[vary]\nstop.1.law = [\"gap-linear-1e6\", \"hu2003-nonlinear\"]\n";
    let bench = bench(400, laws);
    drawn(&bench, &[]);
    shows(&svg(&bench, "reactions"), &["gap-linear-1e6", "hu2003-nonlinear", "stop.1.law"]);
    // The second half of a point has a revolution at least.
    let bench = bench.file("rattler.toml", &rattler(1600));
    let both = "continue = \"both\"\n[vary]\nmass.unbalance.speed = \"500 rpm .. 2000 rpm, 4\"\n";
    let bench = bench.file("study.toml", &format!("case = \"rattler.toml\"\n{both}"));
    drawn(&bench, &[]);
    shows(&svg(&bench, "displacement"), &["X, vertical, up", "X, vertical, down"]);
    shows(&svg(&bench, "bifurcation"), &["x, up", "x, down"]);
    let steps = "[vary]\nmarch.time_step = [\"0.2 ms\", \"2.5 ms\"]\n";
    let bench = bench.file("study.toml", &format!("case = \"rattler.toml\"\n{steps}"));
    drawn(&bench, &[]);
    shows(
        &svg(&bench, "reactions"),
        &["[1 of 2 NOT SOUND]", "NOT SOUND: see `remark` in the table"],
    );
}

#[test]
fn clearances_are_drawn_where_there_are_some() {
    let bushings = "case = \"unbalance\"\n[vary]\nmarch.duration = [\"3 ms\"]\n\
                    body.rotor.speed = [\"300 rpm\", \"400 rpm\"]\n";
    let bench = Workbench::new().file("study.toml", bushings);
    drawn(&bench, &[]);
    assert!(!svg(&bench, "eccentricity").contains("radial clearance"));
    let bearings = "case = \"hu2003-5\"\n[vary]\nmarch.steps = [5]\n\
                    springs.radial_clearance = [\"20 um\", \"30 um\"]\n";
    let bench = bench.file("study.toml", bearings);
    drawn(&bench, &[]);
    shows(&svg(&bench, "eccentricity"), &["radial clearance", "Bearing 4"]);
}

/// Figures are functions of the journal, which survives a kill at any moment.
#[cfg(unix)]
#[test]
fn a_resumed_sweep_draws_the_same_figures() {
    let bench = bench(20_000, "[vary]\nmass.unbalance.speed = \"500 rpm .. 2000 rpm, 12\"\n");
    let expected = drawn(&bench, &[]);
    let arguments = ["sweep", "study.toml", "--out", "cut", "--quiet"];
    for more in [&[][..], &["--resume"], &["--resume"]] {
        let mut command = bench.command(&[&arguments, more].concat());
        let mut child = command.stderr(Stdio::null()).spawn().expect("it runs");
        let length = || fs::metadata(bench.path("cut/sweep.journal")).map_or(0, |own| own.len());
        let first = length();
        while length() < first + 8000 && child.try_wait().expect("a child").is_none() {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        let _ = child.kill();
        child.wait().expect("it ends");
    }
    let outcome = bench.whirl(&[&arguments[..], &["--resume"]].concat());
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    for stem in expected {
        for ending in ["svg", "png"] {
            let [whole, cut] = ["out", "cut"]
                .map(|own| fs::read(bench.path(&format!("{own}/{stem}.{ending}"))).unwrap());
            assert!(whole == cut, "{stem}.{ending}");
        }
    }
}
