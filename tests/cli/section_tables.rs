//! Rows of sections that are hard to make solid: hair-thin steps, mass around cones, tables as spreadsheets write them.

use std::f64::consts::PI;

use crate::analyses::{numbers, ran};
use crate::workbench::Workbench;

/// A case of a rotor on two bearings.
fn rotor(sections: &str, bearings: [&str; 2]) -> String {
    let [a, b] = bearings;
    format!(
        r#"title = "a rotor"
[material.steel]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = "7850 kg/m^3"
[body.r]
turns = "prescribed"
speed = "3000 rpm"
sections = {sections}
material = "steel"
modes = 8
[joint.f]
kind = "bushing"
first = {{ body = "r", z = "{a}" }}
stiffness = {{ xx = "1e7 N/m", yy = "1e7 N/m" }}
[joint.g]
kind = "bushing"
first = {{ body = "r", z = "{b}" }}
stiffness = {{ xx = "1e7 N/m", yy = "1e7 N/m" }}
"#
    )
}

/// The line of a body's mass that `whirl check` prints.
fn masses(bench: &Workbench) -> Vec<f64> {
    let said = bench.whirl(&["check", "rotor.toml"]);
    assert_eq!(said.status, 0, "{}", said.stderr);
    let line = said.stdout.lines().find(|line| line.starts_with("r ")).expect("its mass");
    line.split_whitespace().filter_map(|cell| cell.parse().ok()).collect()
}

/// A step of a hair on a slender rotor is as good as none: a ring of its thickness would swamp the digits of bending.
#[test]
fn a_step_of_a_hair_is_no_loose_part() {
    let modes = |sections: &str| {
        let case = rotor(sections, ["100 mm", "2700 mm"]);
        let bench = Workbench::new().file("rotor.toml", &case);
        ran(&bench, &["modes", "rotor.toml", "--count", "6", "--out", "out", "--no-figures"]);
        numbers(&bench, "out/modes.csv", "frequency_hz")
    };
    let even = modes(r#"[{ length = "2800 mm", outer = "53.865 mm" }]"#);
    for step in [
        r#"[{ length = "1400 mm", outer = "53.85 mm" }, { length = "1400 mm", outer = "53.88 mm" }]"#,
        r#"[{ length = "1400 mm", outer = "53.86 mm" }, { length = "1400 mm", outer = "53.87 mm" }]"#,
        r#"[{ length = "1400 mm", outer = "53.86 mm", name = "LEFT" }, { length = "1400 mm", outer = "53.87 mm" }]"#,
    ] {
        let found = modes(step);
        assert_eq!(found.len(), even.len());
        for (found, even) in found.iter().zip(&even) {
            assert!((found / even - 1.0).abs() < 5e-4, "{step}: {found} Hz, {even} Hz");
        }
    }
}

/// Mass up to a cylinder around a cone has the centre and the inertia of the cylinder.
#[test]
fn mass_around_a_cone_is_where_it_is() {
    let cone = |mass_outer: &str| {
        format!(
            r#"[{{ length = "100 mm", outer = "40 mm" }},
              {{ length = "300 mm", outer_left = "50 mm", outer_right = "120 mm", inner_left = "10 mm", inner_right = "30 mm"{mass_outer} }},
              {{ length = "100 mm", outer = "40 mm", inner = "20 mm" }}]"#
        )
        .replace('\n', " ")
    };
    let case = rotor(&cone(r#", mass_outer = "160 mm""#), ["50 mm", "450 mm"]);
    let found = masses(&Workbench::new().file("rotor.toml", &case));
    // Radii at both ends of what there is, between its z: full ones, and bores.
    let parts = [
        ([0.0, 0.1], [0.02, 0.02], 1.0),
        ([0.1, 0.4], [0.08, 0.08], 1.0),
        ([0.1, 0.4], [0.005, 0.015], -1.0),
        ([0.4, 0.5], [0.02, 0.02], 1.0),
        ([0.4, 0.5], [0.01, 0.01], -1.0),
    ];
    // By the midpoint of many slices.
    let slices = 20_000;
    let [mut mass, mut first, mut second, mut polar] = [0.0; 4];
    for (z, r, sign) in parts {
        for k in 0..slices {
            let part = (f64::from(k) + 0.5) / f64::from(slices);
            let (z, dz) = (z[0] + (z[1] - z[0]) * part, (z[1] - z[0]) / f64::from(slices));
            let r: f64 = r[0] + (r[1] - r[0]) * part;
            let own = sign * 7850.0 * PI * r * r * dz;
            mass += own;
            first += own * z;
            second += own * (z * z + r * r / 4.0);
            polar += own * r * r / 2.0;
        }
    }
    let centre = first / mass;
    let known = [mass, 1e3 * centre, polar, second - mass * centre * centre];
    for (found, known) in found.iter().zip(known) {
        assert!((found / known - 1.0).abs() < 2e-5, "{found} for {known}");
    }
    assert_eq!(found.len(), 4);
}

/// Lines and columns of separators alone, quoted cells, names with capitals, and units in round brackets.
#[test]
fn tables_of_spreadsheets_are_read() {
    let plain = "length [mm],outer [mm],name\n100,40,\n300,60.5,MIDDLE\n100,40,\n";
    let bench = |table: &str| {
        let case = rotor("\"table.csv\"", ["50 mm", "450 mm"]);
        Workbench::new().file("rotor.toml", &case).file("table.csv", table)
    };
    let known = masses(&bench(plain));
    for table in [
        "\u{feff}Length [mm];Outer (mm);Name;;\r\n100;40;;;\r\n300;60.5;MIDDLE;;\r\n100;40;;;\r\n;;;;\r\n;;;;\r\n",
        "\"length [mm]\",\"outer [mm]\",\"name\",\n\"100\",\"40\",,\n300.,.605e2,\"MIDDLE\",\n100,40,,\n,,,\n",
    ] {
        assert_eq!(masses(&bench(table)), known, "{table}");
    }
}
