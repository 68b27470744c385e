//! A body from rows with every key: its mass, centre and inertia as those of cones.

use std::f64::consts::PI;

use super::FILES;
use crate::workbench::Workbench;

/// Mass (kg), its moment about z = 0 (kg m), and polar inertia (kg m²) of a row by its z, radii and density.
fn cone([from, to]: [f64; 2], [a, b]: [f64; 2], density: f64) -> [f64; 3] {
    // Powers of a radius that runs evenly, over many slices.
    let count = 20_000;
    let step = (to - from) / f64::from(count);
    (0..count).fold([0.0; 3], |[mass, moment, polar], k| {
        let part = (f64::from(k) + 0.5) / f64::from(count);
        let (z, r) = (from + part * (to - from), a + part * (b - a));
        let own = density * PI * r * r * step;
        [mass + own, moment + own * z, polar + 0.5 * own * r * r]
    })
}

#[test]
fn a_body_from_rows_has_their_mass() {
    let bench = FILES.iter().fold(Workbench::new(), |bench, (name, text)| bench.file(name, text));
    let said = bench.whirl(&["check", "rows.toml"]);
    assert_eq!(said.status, 0, "{}", said.stderr);
    let (steel, bronze) = (7860.0, 8800.0);
    let rows = [
        ([0.01, 0.11], [0.02; 2], steel),
        ([0.01, 0.11], [0.006; 2], -steel),
        ([0.11, 0.16], [0.03, 0.025], steel),
        ([0.11, 0.16], [0.006, 0.01], -steel),
        ([0.16, 0.24], [0.028; 2], steel),
        ([0.02, 0.06], [0.027; 2], bronze),
        ([0.02, 0.06], [0.02; 2], -bronze),
    ];
    let [mass, moment, polar] = rows.into_iter().fold([0.0; 3], |sum, (z, radii, density)| {
        let own = cone(z, radii, density);
        [0, 1, 2].map(|k| sum[k] + own[k])
    });
    let line = said.stdout.lines().find(|line| line.starts_with("rotor ")).expect("its mass");
    let found: Vec<f64> = line.split_whitespace().filter_map(|cell| cell.parse().ok()).collect();
    let known = [mass, 1e3 * moment / mass, polar];
    for (found, known) in found.iter().zip(known) {
        assert!((found / known - 1.0).abs() < 1e-5, "{line}: {known}");
    }
    assert!(found.len() >= 3, "{line}");
    // What the cells of a row have not stands beside it.
    assert!(said.stdout.contains("carries disc beside row 3 at z = 180 mm"), "{}", said.stdout);
    assert!(said.stdout.contains("JOURNAL_BORE"), "{}", said.stdout);
}

/// The march under a load: reactions carry it, shared by the lever.
#[test]
fn a_body_from_rows_is_marched() {
    let bench = FILES.iter().fold(Workbench::new(), |bench, (name, text)| bench.file(name, text));
    let said = bench.whirl(&["run", "rows.toml", "--out", "out"]);
    assert_eq!(said.status, 0, "{}", said.stderr);
    let text = std::fs::read_to_string(bench.path("out/history.csv")).expect("a history");
    let names: Vec<&str> = text.lines().next().expect("a head").split(',').collect();
    let last: Vec<f64> = text
        .lines()
        .last()
        .expect("a row")
        .split(',')
        .map(|cell| cell.parse().expect("a number"))
        .collect();
    let of = |name: &str| last[names.iter().position(|own| *own == name).expect(name)];
    assert!(of("x_middle_um").is_finite() && of("x_middle_um") != 0.0);
    assert!(of("RX_left_N") != 0.0);
}
