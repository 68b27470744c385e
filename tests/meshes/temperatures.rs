//! Properties that depend on temperature: those of a room are read, or of the end of the table that is nearest.

use whirl_solver::mesh::format::ReadMesh;

use crate::open;

const CUBE: &str = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n\
                    *ELEMENT, TYPE=C3D8I, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*SOLID SECTION, ELSET=ALL, MATERIAL=HOT\n\
                    *MATERIAL, NAME=HOT\n";

fn read(elastic: &str, density: &str) -> Result<ReadMesh, String> {
    let text = format!("{CUBE}*ELASTIC\n{elastic}*DENSITY\n{density}");
    open(text.as_bytes(), "hot.inp").map_err(|errors| errors.to_string())
}

#[test]
fn properties_are_those_of_a_room() {
    for (elastic, e, nu, at) in [
        // A line at that temperature, between two lines, and beyond either end.
        ("210e9, .29, 20\n200e9, .30, 100\n", 210e9, 0.29, "20"),
        ("212e9, .28, 0\n204e9, .30, 40\n190e9, .3, 300\n", 208e9, 0.29, "20"),
        ("205e9, .29, 25\n190e9, .30, 600\n", 205e9, 0.29, "25"),
        ("220e9, .27, -200\n215e9, .28, -50\n", 215e9, 0.28, "-50"),
        // In kelvin.
        ("211e9, .29, 273.15\n207e9, .31, 313.15\n", 209e9, 0.30, "293.15"),
        ("211e9, .29, 293\n207e9, .31, 900\n", 211e9, 0.29, "293.15"),
    ] {
        let ReadMesh { mesh, warnings, .. } = read(elastic, "7850., 20.\n").unwrap();
        let own = &mesh.materials()[0].properties;
        let close = |found: f64, known: f64, most: f64| (found / known - 1.0).abs() < most;
        assert!(close(own["E"], e, 1e-4) && close(own["nu"], nu, 1e-3), "{own:?} {elastic}");
        assert_eq!((own["rho"], warnings.len()), (7850.0, 1), "{warnings:?}");
        let what = &warnings[0].what;
        assert!(what.starts_with("*ELASTIC of HOT depends on temperature: read is E = "), "{what}");
        assert!(what.contains(&format!(" at a temperature of {at}, of ")), "{what}");
        assert_eq!((warnings[0].line, warnings[0].help.is_empty()), (14, false));
    }
    let warnings = read("2e11, .3\n", "7850, 20\n7700, 400\n").unwrap().warnings;
    let known = "*DENSITY of HOT depends on temperature: read is ρ = 7850 at a temperature of 20, of 2 lines from 20 to 400";
    assert_eq!(warnings[0].what, known);
}

#[test]
fn tables_that_say_no_temperature_are_not_read() {
    let found = read("2e11, .3, 100\n2.1e11, .3, 20\n", "7850\n").map(drop).unwrap_err();
    let known = "hot.inp:16:13: the temperatures of *ELASTIC do not increase: 20 stands below 100\n  help: sort";
    assert!(found.starts_with(known), "{found}");
    let warnings = read("2e11, .3\n2.1e11, .3\n", "7850\n").unwrap().warnings;
    assert_eq!((warnings[0].what.as_str(), warnings[0].line), ("*ELASTIC has 2 lines", 16));
    let found = read("2e11, .3, 20\n2.1e11, .3, hot\n", "7850\n").map(drop).unwrap_err();
    assert!(
        found.starts_with("hot.inp:16:13: a temperature must be a number, found `hot`"),
        "{found}"
    );
    // Of a material that no cell has nothing is said.
    let unused = "*MATERIAL, NAME=UNUSED\n*ELASTIC\n2e11, .3, 20\n1e11, .3, 90\n";
    let warnings = read("2e11, .3\n", &format!("7850\n{unused}")).unwrap().warnings;
    assert_eq!(warnings, []);
}

#[test]
fn a_material_of_nastran_has_its_own_values() {
    let nodes = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n";
    let rest = "CTETRA,1,1,1,2,3,4\nPSOLID,1,5\nMAT1,5,2e11,,.3,7850.,,20.\nMATT1,5,11\nTABLEM1,11\n,0.,1.,100.,.9,ENDT\n";
    let read = open(format!("{nodes}{rest}").as_bytes(), "hot.bdf").unwrap();
    assert_eq!(read.mesh.materials()[0].properties["E"], 2e11);
    let known = "MAT1 5 depends on temperature (MATT1): read are its own values, as they are without a temperature";
    assert_eq!((read.warnings[0].what.as_str(), read.warnings[0].line), (known, 8));
}
