//! Cases with meshes in Nastran's bulk data.

use std::fmt::Write;

use crate::bad_input::{case, refused};
use crate::read_meshes::reference;
use crate::workbench::Workbench;

/// A mesh of Abaqus in free fields of bulk data; its element sets become properties.
fn bulk_data(mesh: &str) -> String {
    let mut control = "SOL 103\nCEND\n".to_owned();
    let mut bulk = "BEGIN BULK\nMAT1,1,2e11,,.3,7860.\n".to_owned();
    let (mut sets, mut properties) = (0, 0);
    let mut keyword = String::new();
    let mut members = Vec::new();
    let mut card = "";
    for line in mesh.lines().chain(["*END"]).filter(|line| !line.starts_with("**")) {
        let values: Vec<&str> = line.split(',').map(str::trim).filter(|v| !v.is_empty()).collect();
        if line.starts_with('*') {
            if keyword == "*NSET" {
                let lines: Vec<String> =
                    members.chunks(6).map(|own: &[&str]| own.join(",")).collect();
                writeln!(control, "SET {sets} = {}", lines.join(",\n")).expect("text");
                members.clear();
            }
            keyword = values[0].to_owned();
            let name =
                values.iter().find_map(|v| v.strip_prefix("NSET=").or(v.strip_prefix("ELSET=")));
            if let (Some(name), "*NSET") = (name, keyword.as_str()) {
                sets += 1;
                writeln!(control, "$HMSET {sets} 1 \"{name}\"").expect("text");
            } else if let (Some(name), "*ELEMENT") = (name, keyword.as_str()) {
                properties += 1;
                card = if line.contains("C3D8") { "CHEXA" } else { "CPENTA" };
                writeln!(bulk, "$HMNAME PROP {properties}\"{name}\"\nPSOLID,{properties},1")
                    .expect("text");
            }
            continue;
        }
        match keyword.as_str() {
            "*NODE" => {
                writeln!(bulk, "GRID,{},,{}", values[0], values[1..].join(",")).expect("text")
            }
            "*ELEMENT" => {
                let property = properties.to_string();
                let fields = [&[values[0], property.as_str()], &values[1..]].concat();
                let lines: Vec<String> = fields.chunks(8).map(|own| own.join(",")).collect();
                writeln!(bulk, "{card},{}", lines.join("\n,")).expect("text");
            }
            "*NSET" => members.extend(values),
            _ => {}
        }
    }
    control + &bulk
}

/// What `check` says of a shaft in a file of this name and text.
fn checked(name: &str, text: &str) -> (String, String) {
    let text_of_case = case(&format!("[shaft]\nmesh = \"{name}\"\n"));
    let bench = Workbench::new().file("case.toml", &text_of_case).file(name, text);
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    (outcome.stdout.replace(name, "FILE"), outcome.stderr)
}

#[test]
fn the_reference_shaft_is_the_same_in_bulk_data() {
    let mesh = reference("shaft");
    let bulk = bulk_data(&mesh);
    let (wanted, _) = checked("shaft.inp", &mesh);
    let (found, warnings) = checked("shaft.bdf", &bulk);
    // That set stands beside *NODE, which has no match among cards.
    assert_eq!(found.replace("MAT1_1", "STEEL"), wanted.replace(", Nall (1925)", ""));
    assert_eq!(warnings, "");
    // The content counts, whatever the file's name.
    assert_eq!(checked("shaft.dat", &bulk).0, found);
}

#[test]
fn masses_are_shown_as_a_case_writes_them() {
    let text = bulk_data(&reference("shaft")) + "GRID,9001,,.01,0.,.5\nCONM2,9002,9001,,2.5\n";
    let (_, warnings) = checked("shaft.bdf", &text);
    assert_eq!(
        warnings,
        "warning: shaft.bdf: CONM2_9002, 2.5 kg, is not part of the mesh\n  help: if the body turns about x = y = 0, \
         write into the case\n    [body.NAME.added.CONM2_9002]\n    mass = \"2.5 kg\"\n    radius = \"0.01 m\"\n    \
         angle = \"0 deg\"\n    z = \"0.5 m\"\n"
    );
}

/// Errors stand at their lines in the file that has them.
#[test]
fn errors_of_included_files_are_shown_there() {
    let text = bulk_data(&reference("shaft"));
    let (start, end) = text.split_once("CPENTA").expect("elements");
    let part = format!("CPENTA{end}").replacen(",1,", ",x,", 1);
    let bench = Workbench::new()
        .file("case.toml", &case("[shaft]\nmesh = \"shaft.bdf\"\n"))
        .file("shaft.bdf", &format!("{start}INCLUDE 'part.bdf'\n"))
        .file("part.bdf", &part);
    refused(
        &bench,
        &[
            "--> part.bdf:1:",
            "label of the element (field 2 of CPENTA) must be a whole number from 1, found `x`",
            "1 | CPENTA,",
        ],
    );
}

#[test]
fn elements_turned_inside_out_are_found_in_the_file() {
    let text = bulk_data(&reference("shaft"));
    let line = text.lines().find(|line| line.starts_with("CPENTA")).expect("a wedge");
    let mut values: Vec<&str> = line.split(',').collect();
    values.swap(3, 4);
    let bench = Workbench::new()
        .file("case.toml", &case("[shaft]\nmesh = \"shaft.bdf\"\n"))
        .file("shaft.bdf", &text.replace(line, &values.join(",")));
    let label = values[1];
    refused(
        &bench,
        &[
            "--> shaft.bdf:",
            &format!("cell {label} (wedge6) is inverted or flat"),
            &format!("| {}", values.join(",")),
        ],
    );
}
