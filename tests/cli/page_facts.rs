//! What pages tell of contacts, teeth, laws and bodies.

use crate::report::{numbers, page, ran};
use crate::workbench::Workbench;

/// Contacts are those of the history, the curve of a law is its formula, and bodies are told with their sections, materials and bearings.
#[test]
fn pages_tell_contacts_laws_and_what_bodies_are_made_of() {
    let bench = Workbench::new();
    ran(&bench, &["run", "annular-rub", "--out", "out", "--no-figures"]);
    let (_, data) = page(&bench, "out");
    let text = bench.history_text("out");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let names = lines.next().expect("names");
    let place = |name: &str| names.iter().position(|own| *own == name).expect("a column");
    let [time, x, y] = ["t_s", "EX1_um", "EY1_um"].map(place);
    let rows = lines.map(|row| {
        let number = |place: usize| row[place].parse::<f64>().expect("a number");
        (number(time), number(x).hypot(number(y)) > 1000.0)
    });
    let rows: Vec<(f64, bool)> = rows.collect();
    let begins: Vec<f64> =
        rows.windows(2).filter(|pair| !pair[0].1 && pair[1].1).map(|pair| pair[1].0).collect();
    let contact = &data["run"]["contacts"][0];
    assert_eq!(contact["times"], begins.len());
    assert_eq!(contact["first_s"].as_f64(), begins.first().copied());
    let share = rows.iter().filter(|own| own.1).count() as f64 / rows.len() as f64;
    assert!((contact["share"].as_f64().expect("a share") - share).abs() < 1e-12);
    assert_eq!(contact["lasts"], rows[rows.len() - 1].1);
    // A ring of 1e5 N/m beyond a gap of 1 mm.
    let points = data["about"]["laws"][0]["points"].as_array().expect("points");
    assert!(points.len() > 100);
    for own in points {
        let [e, force] = [0, 1].map(|k| own[k].as_f64().expect("a number"));
        let known = -1e5 * 1e-3 * (e.abs() - 1.0).max(0.0) * e.signum();
        assert!((force - known).abs() < 1e-4, "{force} N for {known} at {e} mm");
    }

    let case = "title = \"sections\"\n[material]\nsteel = { youngs_modulus = \"210 GPa\", poissons_ratio = 0.3, density = \"7850 kg/m^3\" }\n\
                [body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmaterial = \"steel\"\nmodes = 4\ndamping = \"1e-5 s\"\n\
                sections = [{ length = \"100 mm\", outer = \"40 mm\" }, { length = \"50 mm\", outer = \"60 mm\", inner = \"20 mm\" }]\n\
                unbalance.u = { mass = \"1 g\", radius = \"30 mm\", z = \"120 mm\" }\n\
                [joint.a]\nkind = \"bushing\"\nfirst = { body = \"rotor\", z = \"10 mm\" }\n\
                stiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\ndamping = { xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }\n\
                axial_stiffness = \"1e6 N/m\"\naxial_damping = \"1e2 N*s/m\"\n\
                [joint.b]\nkind = \"bushing\"\nfirst = { body = \"rotor\", z = \"140 mm\" }\n\
                stiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\ndamping = { xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }\n\
                [march]\ntime_step = \"1e-4 s\"\nduration = \"0.05 s\"\n";
    let bench = Workbench::new().file("case.toml", case);
    ran(&bench, &["modes", "case.toml", "--out", "out", "--no-figures"]);
    let (_, data) = page(&bench, "out");
    let words = data["analyses"]["words"].as_array().expect("words");
    let of = |title: &str| words.iter().find(|own| own["title"] == title).expect("a part");
    let rows = &of("Sections of rotor")["table"];
    assert_eq!(rows[1], serde_json::json!(["0 to 100", "40", "–", "steel"]));
    assert_eq!(rows[2], serde_json::json!(["100 to 150", "60", "20", "steel"]));
    let bodies = of("Bodies")["lines"].to_string();
    assert!(bodies.contains("steel: E = 210 GPa, ν = 0.3, ρ = 7850 kg/m³"), "{bodies}");
    // The speed of the run is marked in charts over the speed.
    assert_eq!(data["analyses"]["analyses"][0]["run_rpm"], serde_json::json!([3000.0]));
}

/// Two gears that rattle: the force between their teeth is the couple of inertia by the base radius, on either flank.
#[test]
fn pages_tell_the_force_between_teeth_and_when_they_part() {
    let case = "title = \"rattle\"\n\
                [body.a]\nturns = \"free\"\nmass = \"2 kg\"\npolar_inertia = \"2e-3 kg*m^2\"\n\
                [body.b]\nturns = \"free\"\naxis = [\"120 mm\", \"0 mm\"]\nmass = \"4 kg\"\npolar_inertia = \"9e-3 kg*m^2\"\n\
                [joint.pair]\nkind = \"gear\"\nfirst = { body = \"a\" }\nsecond = { body = \"b\" }\nteeth = [20, 40]\n\
                mesh_stiffness = \"1e7 N/m\"\nmesh_damping = \"2e3 N*s/m\"\nbacklash = \"100 um\"\n\
                [joint.left]\nkind = \"bushing\"\nfirst = { body = \"a\" }\nstiffness = { xx = \"1e8 N/m\", yy = \"1e8 N/m\" }\ndamping = { xx = \"5e3 N*s/m\", yy = \"5e3 N*s/m\" }\n\
                [joint.right]\nkind = \"bushing\"\nfirst = { body = \"b\" }\nstiffness = { xx = \"1e8 N/m\", yy = \"1e8 N/m\" }\ndamping = { xx = \"5e3 N*s/m\", yy = \"5e3 N*s/m\" }\n\
                [loads.ripple]\nbody = \"a\"\ncouple = \"20 N*m\"\nfrequency = \"50 Hz\"\n\
                [march]\ntime_step = \"1e-5 s\"\noutput_step = \"5e-5 s\"\nduration = \"0.1 s\"\n";
    let bench = Workbench::new().file("case.toml", case);
    ran(&bench, &["run", "case.toml", "--out", "out", "--no-figures"]);
    let (_, data) = page(&bench, "out");
    let text = bench.history_text("out");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let names = lines.next().expect("names");
    let place = |name: &str| names.iter().position(|own| *own == name).expect("a column");
    let [time, force, moment] = ["t_s", "RY_pair_N", "MZ_pair_Nm"].map(place);
    let rows = lines
        .map(|row| [time, force, moment].map(|place| row[place].parse::<f64>().expect("a number")));
    let rows: Vec<[f64; 3]> = rows.collect();
    // Pitch radii 40 and 80 mm; the couple on the first gear is the normal force by its base radius, against its motion.
    let normal = data["run"]["histories"]["columns"].as_array().expect("columns").last();
    let normal = numbers(&normal.expect("a column")["values"]);
    assert_eq!(normal.len(), rows.len());
    let base = 0.04 * 20_f64.to_radians().cos();
    let most = rows.iter().fold(0.0, |most: f64, row| most.max(row[2].abs() / base));
    for (own, row) in normal.iter().zip(&rows) {
        assert!((own + row[2] / base).abs() < 1e-5 * most, "{own} {row:?}");
        assert!((own + row[1] / 20_f64.to_radians().cos()).abs() < 1e-5 * most, "{own} {row:?}");
    }
    assert!(
        normal.iter().any(|own| *own > 0.3 * most) && normal.iter().any(|own| *own < -0.3 * most)
    );
    let apart: Vec<bool> = rows.iter().map(|row| row[2] == 0.0).collect();
    let own = &data["run"]["teeth"][0];
    let begins =
        apart.windows(2).filter(|pair| !pair[0] && pair[1]).count() + usize::from(apart[0]);
    assert!(begins > 4, "{begins}");
    assert_eq!(
        (own["apart"]["times"].as_u64(), own["backlash"].as_bool()),
        (Some(begins as u64), Some(true))
    );
    let share = apart.iter().filter(|own| **own).count() as f64 / apart.len() as f64;
    assert!((own["apart"]["share"].as_f64().expect("a share") - share).abs() < 1e-12);
}
