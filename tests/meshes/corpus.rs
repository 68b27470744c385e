//! Files as Gmsh, meshio, pyNastran, cgx and CalculiX write them (tests/data/corpus/make.py): all meshes are read, with the
//! nodes, cells and volume that went into them, and all that are none are named.

use std::collections::BTreeMap;

use whirl_solver::assembly::mass_properties;

use crate::packed::data;
use crate::{open, steel};

/// The files of an archive (ustar) by name.
fn files(archive: &[u8]) -> BTreeMap<String, Vec<u8>> {
    const BLOCK: usize = 512;
    let mut files = BTreeMap::new();
    let mut at = 0;
    while at + BLOCK <= archive.len() && archive[at] != 0 {
        let text = |from: usize, to: usize| {
            let field = &archive[at + from..at + to];
            let end = field.iter().position(|byte| *byte == 0).unwrap_or(field.len());
            std::str::from_utf8(&field[..end]).expect("a header of an archive").trim().to_owned()
        };
        let size = usize::from_str_radix(&text(124, 136), 8).expect("a size");
        let start = at + BLOCK;
        files.insert(text(0, 100), archive[start..start + size].to_vec());
        at = start + size.div_ceil(BLOCK) * BLOCK;
    }
    files
}

#[test]
fn what_other_programs_write_is_read_or_named() {
    let mut files = files(&data("corpus/corpus.tar"));
    let table = String::from_utf8(data("corpus/corpus.csv")).expect("a table");
    let mut wrong = Vec::new();
    let mut number = 0;
    for row in table.lines().skip(1) {
        number += 1;
        let values: Vec<&str> = row.split(',').collect();
        let name = values[0];
        let bytes = files.remove(name).unwrap_or_else(|| panic!("{name}"));
        match (open(&bytes, name), values[1]) {
            (Err(errors), "refused") => {
                let known = format!("{name}: this is {}, which is not read", values[2]);
                if errors.0.len() != 1 || !errors.to_string().starts_with(&known) {
                    wrong.push(format!("{known}\n{errors}"));
                }
            }
            (Err(errors), _) => wrong.push(errors.to_string()),
            (Ok(_), "refused") => wrong.push(format!("{name} is read")),
            (Ok(read), nodes) => {
                let mesh = read.mesh.with_material(&steel(), |_| true).expect("the mesh");
                let volume = mass_properties(&mesh).expect("cells").volume;
                let known: f64 = values[3].parse().expect("a volume");
                // Surfaces of less than 10 m², displaced by what the digits of a file leave out: in fields of eight
                // columns five behind the point (pyNastran is given such a file), six of meshio as the script has them;
                // else nothing but rounding.
                let small = name.starts_with("pynastran") || name.contains("BdfFieldFormat-");
                let digits = match (small, name.starts_with("meshio")) {
                    (true, _) => 10.0 * 0.5e-5,
                    (_, true) => 10.0 * 0.5e-6,
                    _ => 1e-9,
                };
                let counts = [mesh.nodes().len().to_string(), mesh.cell_count().to_string()];
                if counts != [nodes, values[2]] || (volume - known).abs() > digits * known.max(1.0)
                {
                    wrong.push(format!("{row}: found {counts:?} {volume}"));
                }
                // The names of groups are sets in every format that has them.
                let grouped = name.contains("groups-") && !name.ends_with(".bdf");
                if grouped && mesh.node_set("foot").map_or(0, <[usize]>::len) < 4 {
                    wrong.push(format!("{name} has no set `foot`"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {number}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(files.is_empty() && number > 120, "{number}, not in the table: {:?}", files.keys());
}
