//! Rotors from tables of their sections: against other programs, closed forms, and finer meshes of themselves.

use std::f64::consts::PI;

use super::{CASES, coaxial, column, compare, numbers, ran};
use crate::workbench::Workbench;

/// A case of the reference with its shaft from a section in place of dimensions, and its joints by their z.
fn from_section(case: &str, length: &str, diameter: &str) -> String {
    let (before, rest) = case.split_once("[body.rotor.dimensions]").expect("dimensions");
    let (_, after) = rest.split_once("[body.rotor.disc.one]").expect("a disc");
    let rows = format!("sections = [{{ length = \"{length}\", outer = \"{diameter}\" }}]");
    let case = format!("{before}{rows}\n[body.rotor.disc.one]{after}");
    let restraint = "axial_restraint = \"JOURNAL1_MIDDLE\"\n";
    let changes = [
        (restraint, String::new()),
        ("sets = \"LEFT\"", "z = \"0 mm\"".to_owned()),
        ("sets = \"RIGHT\"", format!("z = \"{length}\"")),
    ];
    changes.into_iter().fold(case, |case, (old, new)| {
        assert!(case.contains(old), "{old}");
        case.replace(old, &new)
    })
}

#[test]
fn modes_of_tables_are_those_of_other_programs() {
    let ross = from_section(CASES[0].1, "1500 mm", "50 mm");
    let lalanne = from_section(CASES[1].1, "1300 mm", "100 mm");
    let cases = [(CASES[0].0, ross.as_str()), (CASES[1].0, lalanne.as_str())];
    let test = "modes_of_tables_are_those_of_other_programs";
    assert_eq!(compare(&cases, "from a table of sections", test), 44 + 35);
}

/// Both shafts, of which the outer one is hollow and carries the bore of a bearing.
#[test]
fn modes_of_coaxial_tables_are_those_of_another_program() {
    let case = include_str!("coaxial.toml");
    let cut = |case: &str, from: &str, to: &str, new: &str| -> String {
        let (before, rest) = case.split_once(from).expect("its begin");
        let (_, after) = rest.split_once(to).expect("its end");
        format!("{before}{new}{to}{after}")
    };
    let inner = "sections = [{ length = \"2500 mm\", outer = \"50 mm\" }]\n";
    let case = cut(case, "[body.inner.dimensions]", "[body.inner.disc.left]", inner);
    let outer = "turns = \"prescribed\"\nspeed = \"200 rad/s\"\nsections = \"outer.csv\"\nmaterial = \"steel\"\nmodes = 30\n";
    let case =
        cut(&case, "[body.outer]", "[body.outer.disc.left]", &format!("[body.outer]\n{outer}"));
    let changes = [
        ("axial_restraint = \"JOURNAL1_MIDDLE\"\n", ""),
        ("\"inner\", sets = \"LEFT\"", "\"inner\", z = \"0 mm\""),
        ("\"inner\", sets = \"RIGHT\"", "\"inner\", z = \"2.5 m\""),
        ("\"outer\", sets = \"LEFT\"", "\"outer\", z = \"500 mm\""),
        ("\"inner\", sets = \"INTERSHAFT\"", "\"inner\", z = \"2 m\""),
        ("\"outer\", sets = \"RIGHT\"", "\"outer\", z = \"2 m\""),
    ];
    let case = changes.into_iter().fold(case, |case, (old, new)| {
        assert!(case.contains(old), "{old}");
        case.replace(old, new)
    });
    let workbench = Workbench::new()
        .file("outer.csv", "z [m], length [mm], outer [mm], inner [mm]\n0.5, 1500, 300, 250\n")
        .file("case.toml", &case);
    let test = "modes_of_coaxial_tables_are_those_of_another_program";
    assert_eq!(coaxial::compare(&workbench, "from tables of sections", test), 32);
}

/// A pipe from a section on stiff bushings at both of its ends, which stand still.
fn pipe(rest: &str) -> String {
    format!(
        "title = \"a pipe\"\n[material.steel]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\ndensity = \"7800 kg/m^3\"\n\
         [body.pipe]\nturns = \"prescribed\"\nspeed = \"0 rpm\"\nmaterial = \"steel\"\nmodes = 20\n\
         sections = [{{ length = \"1 m\", outer = \"60 mm\", inner = \"40 mm\" }}]\n{rest}\
         [joint.left]\nkind = \"bushing\"\nfirst = {{ body = \"pipe\", z = \"0 mm\" }}\nstiffness = {{ xx = \"1e12 N/m\", yy = \"1e12 N/m\" }}\n\
         [joint.right]\nkind = \"bushing\"\nfirst = {{ body = \"pipe\", z = \"1 m\" }}\nstiffness = {{ xx = \"1e12 N/m\", yy = \"1e12 N/m\" }}\n"
    )
}

/// The shear coefficient of a pipe by the ratio of its diameters, ν 0.3: Cowper (1966).
fn shear(ratio: f64) -> f64 {
    let (nu, squared): (f64, f64) = (0.3, 1.0 + ratio.powi(2));
    6.0 * (1.0 + nu) * squared.powi(2)
        / ((7.0 + 6.0 * nu) * squared.powi(2) + (20.0 + 12.0 * nu) * (squared - 1.0))
}

/// Bending between hinges after Timoshenko with the shear coefficient of Cowper (1966), torsion and stretching from the
/// left end, which is held, to the right one.
#[test]
fn a_pipe_bends_twists_and_stretches_as_closed_forms_do() {
    let workbench = Workbench::new().file("case.toml", &pipe(""));
    ran(&workbench, &["modes", "case.toml", "--count", "11", "--out", "out", "--no-figures"]);
    let found = numbers(&workbench, "out/modes.csv", "frequency_hz");
    let (e, nu, rho, length): (f64, f64, f64, f64) = (210e9, 0.3, 7800.0, 1.0);
    let (outer, inner): (f64, f64) = (0.03, 0.02);
    let g = 0.5 * e / (1.0 + nu);
    let (area, moment) =
        (PI * (outer.powi(2) - inner.powi(2)), 0.25 * PI * (outer.powi(4) - inner.powi(4)));
    let kappa = shear(inner / outer);
    let bending = |number: f64| {
        let p = number * PI / length;
        let a = rho * rho * moment / (kappa * g);
        let b = rho * area + rho * moment * p * p * (1.0 + e / (kappa * g));
        let c = e * moment * p.powi(4);
        ((b - (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)).sqrt() / (2.0 * PI)
    };
    let along = |stiffness: f64| (stiffness / rho).sqrt() / (4.0 * length);
    // The inertia across the axis that goes with stretching: 1 - ν² p² k² / 2, k the polar radius of gyration (Love, 1927).
    let love = 1.0 - (0.25 * PI * nu / length).powi(2) * (outer * outer + inner * inner);
    let known = [
        (bending(1.0), 3e-4),
        (bending(1.0), 3e-4),
        (bending(2.0), 1e-3),
        (bending(2.0), 1e-3),
        (along(g), 3e-5),
        (bending(3.0), 2e-3),
        (bending(3.0), 2e-3),
        (along(e) * love, 3e-5),
        (bending(4.0), 3e-3),
        (bending(4.0), 3e-3),
        (3.0 * along(g), 3e-5),
    ];
    for (found, (known, tolerance)) in found.iter().zip(known) {
        assert!((found / known - 1.0).abs() <= tolerance, "{found} Hz, not {known}");
    }
    assert_eq!(found.len(), known.len());
}

/// Ten diameters with steps up and down, a cone and a bore; a sleeve of another material is added.
const STEPPED: &str = "length [mm], outer_left [mm], outer_right [mm], inner [mm], material, name
80, 40, 40, 0, steel,
20, 62, 62, 0, steel,
60, 55, 55, 0, steel, JOURNAL
25, 150, 120, 0, steel,
110, 70, 70, 20, steel,
90, 66.5, 66.5, 20, steel,
40, 66, 66, 20, steel,
15, 110, 110, 20, steel,
70, 45, 45, 0, steel,
50, 30, 25, 0, steel,
";

fn stepped(cells: &str) -> Vec<f64> {
    let case = format!(
        "title = \"stepped\"\n[material.steel]\nyoungs_modulus = \"205 GPa\"\npoissons_ratio = 0.29\ndensity = \"7830 kg/m^3\"\n\
         [material.bronze]\nyoungs_modulus = \"110 GPa\"\npoissons_ratio = 0.34\ndensity = \"8800 kg/m^3\"\n\
         [body.rotor]\nturns = \"prescribed\"\nspeed = \"6000 rpm\"\nmodes = 30\nsections = \"rotor.csv\"\ncells = {{ {cells} }}\n\
         disc.wheel = {{ mass = \"3 kg\", polar_inertia = \"0.02 kg*m^2\", transverse_inertia = \"0.012 kg*m^2\", z = \"540 mm\" }}\n\
         [joint.left]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", z = \"130 mm\" }}\nstiffness = {{ xx = \"4e7 N/m\", yy = \"4e7 N/m\" }}\n\
         [joint.right]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", z = \"475 mm\" }}\nstiffness = {{ xx = \"5e7 N/m\", yy = \"5e7 N/m\" }}\n"
    );
    let sleeve = "z [mm], ".to_owned() + STEPPED.split_once('\n').expect("a head").0;
    let rows = STEPPED.lines().skip(1).map(|row| format!(", {row}\n"));
    let table =
        format!("{sleeve}\n{}185, 110, 90, 90, 70, bronze, SLEEVE\n", rows.collect::<String>());
    let workbench = Workbench::new().file("rotor.csv", &table).file("case.toml", &case);
    ran(&workbench, &["modes", "case.toml", "--count", "10", "--out", "out", "--no-figures"]);
    let whirls = column(&workbench, "out/modes.csv", "whirl");
    let hertz = numbers(&workbench, "out/modes.csv", "frequency_hz");
    // What neither whirls forward nor backward twists or stretches.
    hertz.into_iter().zip(whirls).filter(|own| own.1 != "-").map(|own| own.0).collect()
}

/// Lateral frequencies (Hz) of it as a beam in elements of up to 5 mm: Timoshenko, shear coefficients of Cowper, the sleeve
/// beside the shaft. First with all diameters stiff, then with those that at a step grow by twice the distance from it (45°),
/// mass and inertia unchanged. ROSS 2.3.0.
const BEAMS: [[f64; 2]; 8] = [
    [328.086, 326.565],
    [331.950, 331.520],
    [346.236, 342.895],
    [374.036, 371.995],
    [549.271, 538.961],
    [658.038, 643.540],
    [1115.591, 1085.439],
    [1151.149, 1122.074],
];

/// Corners of steps are met to some parts of a thousand. A beam, whose diameters are stiff up to each step, is too stiff, the
/// more so the shorter the waves; the rule of 45° takes away more than half of that.
#[test]
fn a_rotor_of_ten_diameters_is_as_its_finer_mesh_and_softer_than_a_beam() {
    let [usual, refined, around] = ["", "refine = 2", "sectors = 20"].map(stepped);
    assert_eq!([&usual, &refined, &around].map(Vec::len), [BEAMS.len(); 3]);
    for (place, [beam, ruled]) in BEAMS.into_iter().enumerate() {
        let [usual, refined, around] = [&usual, &refined, &around].map(|own| own[place]);
        assert!((0.0..6e-3).contains(&(usual / refined - 1.0)), "{usual} Hz, {refined} refined");
        assert!((usual / around - 1.0).abs() < 1e-3, "{usual} Hz, {around} of more sectors");
        assert!(refined < beam && refined / beam > 0.96, "{refined} Hz, {beam} of a beam");
        let apart = (refined / ruled - 1.0).abs();
        assert!(apart < 0.014, "{refined} Hz, {ruled} of a beam with the rule of 45°");
        assert!(apart < 0.5 * (beam / refined - 1.0), "{refined} Hz, {ruled} and {beam} of beams");
    }
}

/// A layer of the same material is no other body than one row: conforming cells, the same inertia and stiffness.
#[test]
fn layers_of_one_material_are_one_row() {
    let whole = pipe("");
    let row = "sections = [{ length = \"1 m\", outer = \"60 mm\", inner = \"40 mm\" }]";
    let layers = "sections = [{ length = \"1 m\", outer = \"52 mm\", inner = \"40 mm\" }, \
                  { z = \"0 mm\", length = \"1 m\", outer = \"60 mm\", inner = \"52.000001 mm\" }]";
    assert!(whole.contains(row));
    let [whole, layered] = [whole.clone(), whole.replace(row, layers)].map(|case| {
        let workbench = Workbench::new().file("case.toml", &case);
        ran(&workbench, &["modes", "case.toml", "--count", "8", "--out", "out", "--no-figures"]);
        numbers(&workbench, "out/modes.csv", "frequency_hz")
    });
    for (whole, layered) in whole.iter().zip(&layered) {
        assert!((whole / layered - 1.0).abs() < 2e-4, "{whole} and {layered} Hz");
    }
}

/// What `whirl check` says of a rotor in bearings.
#[test]
fn a_body_from_sections_is_round() {
    let march = "[march]\nduration = \"1 ms\"\ntime_step = \"0.1 ms\"\n";
    let case =
        pipe("unbalance.mid = { mass = \"1 g\", radius = \"30 mm\", z = \"500 mm\" }\n") + march;
    let workbench = Workbench::new().file("case.toml", &case);
    let said = ran(&workbench, &["check", "case.toml"]).stdout;
    assert!(said.contains("round"), "{said}");
    assert!(!said.contains("not round"), "{said}");
}

/// With as many modes as leave one of a pair of bending modes without the other the body would not be round, and modes at
/// speed those of its mean over a turn.
#[test]
fn modes_that_would_part_a_pair_are_kept_together() {
    let shaft = |modes: usize| {
        format!(
            "title = \"a shaft\"\n[material.steel]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n\
             density = \"7800 kg/m^3\"\n[body.shaft]\nturns = \"prescribed\"\nspeed = \"6000 rpm\"\n\
             material = \"steel\"\nmodes = {modes}\ncells = {{ sectors = 6, tolerance = 0.001 }}\n\
             sections = [{{ length = \"1 m\", outer = \"50 mm\" }}]\n\
             [joint.left]\nkind = \"bushing\"\nfirst = {{ body = \"shaft\", z = \"0 mm\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}\n\
             [joint.right]\nkind = \"bushing\"\nfirst = {{ body = \"shaft\", z = \"1 m\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}\n"
        )
    };
    let found = |modes: usize| {
        let workbench = Workbench::new().file("case.toml", &shaft(modes));
        let arguments = ["--speeds", "6000 rpm", "--count", "4", "--out", "out", "--no-figures"];
        ran(&workbench, &[&["modes", "case.toml"][..], &arguments].concat());
        numbers(&workbench, "out/modes.csv", "frequency_hz")
    };
    let many = found(24);
    for modes in 12..=16 {
        for (own, known) in found(modes).iter().zip(&many) {
            assert!((own / known - 1.0).abs() < 5e-4, "{modes} modes: {own} Hz, not {known} Hz");
        }
    }
}

/// What a row lacks is said only where the row could be read.
#[test]
fn a_row_with_a_wrong_length_does_not_lack_it() {
    let case = pipe("").replace("length = \"1 m\"", "length = \"1 yard\"");
    let workbench = Workbench::new().file("case.toml", &case);
    let outcome = workbench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("unknown unit `yard`"), "{}", outcome.stderr);
    assert!(!outcome.stderr.contains("a row has no"), "{}", outcome.stderr);
}

/// A force at a z is carried once, whatever the cells there: the statics of a beam on hinges.
#[test]
fn a_load_at_a_z_is_the_whole_force() {
    let load = "[loads.middle]\nbody = \"pipe\"\nz = \"500 mm\"\ndirection = \"x\"\nforce = \"1000 N\"\n\
                [output.middle]\nquantity = \"displacement\"\nbody = \"pipe\"\nz = \"500 mm\"\n\
                [output.left]\nquantity = \"force\"\njoint = \"left\"\n\
                [march]\nduration = \"40 ms\"\ntime_step = \"1 ms\"\n[start]\nkind = \"equilibrium\"\n";
    let case = pipe("") + load;
    let workbench = Workbench::new().file("case.toml", &case);
    ran(&workbench, &["run", "case.toml", "--out", "out"]);
    let left = numbers(&workbench, "out/history.csv", "fx_left_N");
    assert!(!left.is_empty() && left.iter().all(|own| (own + 500.0).abs() < 1e-3), "{left:?}");
    // Bending by F L³ / 48 E I, and shear.
    let deflection = numbers(&workbench, "out/history.csv", "x_middle_um")[0] * 1e-6;
    let (e, outer, inner): (f64, f64, f64) = (210e9, 0.03, 0.02);
    let moment = 0.25 * PI * (outer.powi(4) - inner.powi(4));
    let area = PI * (outer.powi(2) - inner.powi(2));
    let known =
        1000.0 / (48.0 * e * moment) + 1000.0 * 1.3 / (2.0 * e * shear(inner / outer) * area);
    assert!((deflection / known - 1.0).abs() < 2e-3, "{deflection} m, not {known}");
}
