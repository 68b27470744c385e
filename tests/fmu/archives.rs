//! Archives: what is in them, that it is always the same, and that cases come whole.

use std::fs;

use crate::bench::{Bench, PORT, files, rotor};
use crate::importer::{Instance, attribute};

#[test]
fn the_same_case_gives_the_same_bytes() {
    let bench = Bench::new(&rotor(PORT));
    bench.unit(&[]);
    let first = fs::read(bench.path("unit.fmu")).unwrap();
    bench.unit(&[]);
    assert!(first == fs::read(bench.path("unit.fmu")).unwrap());
    let names: Vec<String> = files(&first).into_iter().map(|own| own.0).collect();
    assert_eq!(names[0], "modelDescription.xml");
    assert!(names[1].starts_with("binaries/") && names[1].contains("/case."), "{names:?}");
    assert_eq!(names[2..], ["resources/unit.json", "resources/case/case.toml"]);
    // Another case has another token.
    bench.file("case.toml", &rotor(PORT).replace("4 kg", "5 kg"));
    bench.unit(&[]);
    let token = |bytes: &[u8]| {
        let text = String::from_utf8(files(bytes).remove(0).1).unwrap();
        attribute(&text, "guid").unwrap()
    };
    assert_ne!(token(&first), token(&fs::read(bench.path("unit.fmu")).unwrap()));
}

#[test]
fn descriptions_say_units_and_what_variables_are() {
    let table = "[loads.record]\nbody = \"r\"\ntable = \"t.csv\"\n";
    let bench = Bench::new(&rotor(&format!("{PORT}{table}")));
    bench.file("t.csv", "time [s], force [N]\n0, 0\n1, 5\n");
    let folder = bench.unit(&["--parameter", "joint.b.stiffness.xx"]);
    let text = fs::read_to_string(folder.join("modelDescription.xml")).unwrap();
    for line in [
        "<Unit name=\"N/m\"><BaseUnit kg=\"1\" s=\"-2\"/></Unit>",
        "<Unit name=\"um\"><BaseUnit m=\"1\" factor=\"1e-6\"/></Unit>",
        "name=\"load.port.fx\" valueReference=\"",
        "description=\"force along x on r, fixed in space\" causality=\"input\" variability=\"continuous\"><Real unit=\"N\" start=\"0.0\"/>",
        "description=\"`joint.b.stiffness.xx` of the case\" causality=\"parameter\" variability=\"fixed\" initial=\"exact\"><Real unit=\"N/m\" start=\"1000000.0\"/>",
        "<DefaultExperiment startTime=\"0.0\" stopTime=\"0.04\" stepSize=\"0.0001\"/>",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    // A load whose table has the unit is told as a factor.
    let record = text.lines().find(|line| line.contains("load.record.fx")).unwrap();
    assert!(record.contains("<Real unit=\"1\" start=\"1.0\"/>"), "{record}");
}

/// A case of several files, with a mesh and reduced bodies, is used far from where they stood.
#[test]
fn cases_come_with_all_that_they_name() {
    let bench = Bench::new("");
    let shaft = "title = \"shaft\"\ninclude = \"../common/march.toml\"\n[material]\n\
                 steel = { youngs_modulus = \"200 GPa\", poissons_ratio = 0.3, density = \"7860 kg/m^3\" }\n\
                 [body.s]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmaterial = \"steel\"\nmodes = 4\n\
                 axial_restraint = \"JOURNAL1_MIDDLE\"\n\
                 [body.s.dimensions]\nlength = \"200 mm\"\ndiameter = \"20 mm\"\nsupports = [\"20 mm\", \"180 mm\"]\n\
                 support_length = \"10 mm\"\nlayers_in_support = 2\nlayers_between = 4\nloads = [\"100 mm\"]\n\
                 [loads.port]\nbody = \"s\"\nsets = [\"LOAD1\"]\ntable = \"../common/force.csv\"\n\
                 [joint.a]\nkind = \"bushing\"\nfirst = { body = \"s\", sets = \"JOURNAL1_MIDDLE\" }\n\
                 stiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\n\
                 [joint.b]\nkind = \"bushing\"\nfirst = { body = \"s\", sets = \"JOURNAL2_MIDDLE\" }\n\
                 stiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\n";
    bench.file("cases/shaft.toml", shaft);
    bench.file("common/march.toml", "[march]\ntime_step = \"1e-5 s\"\nsteps = 60\n");
    bench.file("common/force.csv", "time [s], force [N]\n0, 100\n1, 200\n");
    let case = bench.path("cases/shaft.toml");
    assert!(bench.exports(case.to_str().unwrap(), &["--parameter", "joint.a.stiffness.xx"]));
    let history = bench.history("cases/shaft.toml");
    let folder = bench.unpack();
    let own = |name: &str| folder.join("resources").join(name).exists();
    for name in
        ["case/cases/shaft.toml", "case/common/march.toml", "case/common/force.csv", "bodies/1.bin"]
    {
        assert!(own(name), "{name}");
    }
    // Nothing is left where it was.
    fs::remove_dir_all(bench.path("cases")).unwrap();
    fs::remove_dir_all(bench.path("common")).unwrap();
    let unit = Instance::new(&folder).unwrap().started();
    for step in 0..history.rows() {
        unit.step(step as f64 * 1e-5, 1e-5);
        assert_eq!(unit.all(&history.names()), history.row(step), "step {step}");
    }
    // Keys that change the mesh are no parameters.
    bench.file("cases/shaft.toml", shaft);
    bench.file("common/march.toml", "[march]\ntime_step = \"1e-5 s\"\nsteps = 60\n");
    bench.file("common/force.csv", "time [s], force [N]\n0, 100\n1, 200\n");
    fs::remove_file(bench.path("unit.fmu")).unwrap();
    for key in ["body.s.dimensions.diameter", "material.steel.density", "body.s.modes"] {
        assert!(!bench.exports(case.to_str().unwrap(), &["--parameter", key]), "{key}");
    }
    // Nor can a file be named by its whole path.
    let whole = format!("\"{}\"", bench.path("common/force.csv").display());
    bench.file("cases/shaft.toml", &shaft.replace("\"../common/force.csv\"", &whole));
    assert!(!bench.exports(case.to_str().unwrap(), &[]));
    assert!(!bench.path("unit.fmu").exists());
}
