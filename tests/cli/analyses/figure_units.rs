//! Every figure of an analysis says what its axes are, and in which unit.

use std::fs::read_to_string;

use super::ran;
use crate::workbench::Workbench;

const UNITS: [&str; 11] = ["rpm", "Hz", "1", "1/s", "N/m", "N s/m", "nm", "µm", "mm", "deg", "N"];

/// Whether a text ends with a unit in brackets, after which words may stand, and before it a power of ten.
fn has_unit(text: &str) -> bool {
    let inner = text.split('(').nth(1).and_then(|own| own.split(')').next()).unwrap_or("");
    let unit = inner.split(',').next().unwrap_or("");
    let unit = unit.split_once(' ').filter(|own| own.0.starts_with("1e")).map_or(unit, |own| own.1);
    UNITS.contains(&unit)
}

/// Shapes have one such axis, lengths seen from the side or turns of bodies; all others have two.
#[test]
fn every_axis_has_its_unit() {
    let mut figures = 0;
    for case in ["weight", "unbalance", "geared"] {
        let bench = Workbench::new();
        ran(&bench, &["analyse", case, "--out", "out"]);
        let names = bench.listing_of("out").into_iter().filter(|own| own.ends_with(".svg"));
        for name in names {
            let text = read_to_string(bench.path(&format!("out/{name}"))).expect("a figure");
            for panel in text.split("<g transform=").skip(1) {
                let is_shape = name.contains("modes") || panel.contains(">turn (1)<");
                let least = if is_shape { 1 } else { 2 };
                let words = panel.split("<text ").skip(1);
                let words = words.filter_map(|own| own.split_once('>')?.1.split('<').next());
                let axes: Vec<&str> = words.filter(|own| has_unit(own)).collect();
                assert!(axes.len() >= least, "{case}, {name}: {axes:?}");
            }
            figures += 1;
        }
    }
    assert!(figures >= 12, "{figures}");
}
