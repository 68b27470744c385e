//! Flexible shafts between gear and disc against rods with wave equations.

use std::f64::consts::TAU;

use crate::analyses::{column, numbers, ran};
use crate::workbench::Workbench;

/// Two shafts made from dimensions, each with a disc at its far end and held sideways where its gear is.
fn shafts(order: [usize; 2], turn: f64) -> String {
    let (y, x) = f64::to_radians(turn).sin_cos();
    let axis = |place: usize| match place {
        0 => String::new(),
        _ => format!("axis = [\"{:.15} mm\", \"{:.15} mm\"]\n", 150.0 * x, 150.0 * y),
    };
    let body = |place: usize| {
        let (diameter, inertia) = [(40, DISCS[0]), (60, DISCS[1])][place];
        let name = ["thin", "thick"][place];
        let joint = |at: usize, stiffness: &str| {
            format!(
                "[joint.{name}{at}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\", sets = \"JOURNAL{at}_MIDDLE\" }}\n\
                 stiffness = {{ xx = \"{stiffness} N/m\", yy = \"{stiffness} N/m\" }}\n\n"
            )
        };
        format!(
            "[body.{name}]\nturns = \"free\"\n{}material = \"steel\"\nmodes = 10\naxial_restraint = \"JOURNAL1_MIDDLE\"\n\
             disc.end = {{ mass = \"4 kg\", polar_inertia = \"{inertia} kg*m^2\", transverse_inertia = \"{inertia} kg*m^2\", z = \"380 mm\" }}\n\n\
             [body.{name}.dimensions]\nlength = \"400 mm\"\ndiameter = \"{diameter} mm\"\nsupports = [\"20 mm\", \"380 mm\"]\n\
             support_length = \"20 mm\"\ncells = {{ sectors = 16, rings = 2 }}\n\n{}{}",
            axis(place),
            joint(1, "1e13"),
            joint(2, "1e13"),
        )
    };
    format!(
        "title = \"two shafts\"\n[material]\nsteel = {{ youngs_modulus = \"200 GPa\", poissons_ratio = 0.3, density = \"7860 kg/m^3\" }}\n\n\
         {}{}[joint.mesh]\nkind = \"gear\"\nfirst = {{ body = \"thin\", sets = \"JOURNAL1_MIDDLE\" }}\n\
         second = {{ body = \"thick\", sets = \"JOURNAL1_MIDDLE\" }}\nteeth = [20, 30]\nmesh_stiffness = \"1e13 N/m\"\n",
        body(order[0]),
        body(order[1])
    )
}

/// Polar inertias of the discs (kg·m²).
const DISCS: [f64; 2] = [0.01, 0.06];

/// Torsional modes of flexible shafts, the twist between gear and disc included, are those of rods with wave equations.
#[test]
fn flexible_shafts_twist_between_gear_and_disc() {
    const DENSITY: f64 = 7860.0;
    const SHEAR: f64 = 200e9 / 2.6;
    let area = |diameter: f64| std::f64::consts::PI / 32.0 * f64::powi(diameter, 4);
    // Torque at the gear for a unit of twist there, with the 20 mm beyond each end as masses.
    let balance = |omega: f64| {
        let wave = omega * (DENSITY / SHEAR).sqrt();
        let side = |diameter: f64, disc: f64| {
            let (rigid, beyond) = (SHEAR * area(diameter) * wave, DENSITY * area(diameter) * 0.02);
            let (sin, cos) = (0.36 * wave).sin_cos();
            let end = (disc + beyond) * omega * omega;
            beyond * omega * omega + rigid * (end * cos + rigid * sin) / (rigid * cos - end * sin)
        };
        side(0.04, DISCS[0]) + (2.0_f64 / 3.0).powi(2) * side(0.06, DISCS[1])
    };
    let mut roots = Vec::new();
    let mut hertz = 20.0;
    while hertz < 4000.0 {
        let mut ends = [hertz, hertz + 0.5];
        let [a, b] = ends.map(|own| balance(TAU * own));
        // A root, and no pole.
        if a * b < 0.0 && a.abs() + b.abs() < 1e7 {
            for _ in 0..50 {
                let middle = 0.5 * (ends[0] + ends[1]);
                let place = usize::from(balance(TAU * ends[0]) * balance(TAU * middle) < 0.0);
                ends[place] = middle;
            }
            roots.push(ends[0]);
        }
        hertz += 0.5;
    }
    assert!(roots.len() >= 2, "{roots:?}");
    let mut all = Vec::new();
    for (order, turn) in [([0, 1], 0.0), ([1, 0], 0.0), ([0, 1], 77.0)] {
        let bench = Workbench::new().file("case.toml", &shafts(order, turn));
        let arguments = [
            "torsion",
            "case.toml",
            "--of",
            "thin",
            "--speeds",
            "0 rpm .. 900 rpm, 2",
            "--count",
            "4",
        ];
        ran(&bench, &[&arguments[..], &["--out", "out", "--no-figures"]].concat());
        let bodies = column(&bench, "out/torsion.modes.csv", "body");
        let of = |name: &str| {
            let values = numbers(&bench, "out/torsion.modes.csv", name).into_iter().zip(&bodies);
            values.filter(|own| own.1 == "thin").map(|own| own.0).collect::<Vec<_>>()
        };
        let (found, shares) = (of("frequency_hz"), of("torsional_share"));
        for (own, root) in found.iter().zip(&roots).take(2) {
            // Cells of the shafts, and the place where the mean of a section turns.
            assert!((own / root - 1.0).abs() < 5e-3, "{found:?} {roots:?}");
        }
        assert!(shares[..2].iter().all(|own| *own > 0.999), "{shares:?}");
        all.push(found);
    }
    for other in &all[1..] {
        for (own, first) in other.iter().zip(&all[0]).take(2) {
            assert!((own / first - 1.0).abs() < 1e-6, "{all:?}");
        }
    }
}
