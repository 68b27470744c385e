//! Files of other programs that are wrong: each is an error with its place and what to do.

use whirl_solver::mesh::matrices::Request;

use super::programs::{Folder, by_labels, by_rows, data};

fn said(folder: &Folder, request: &Request) -> String {
    match folder.read(request) {
        Ok(_) => panic!("nothing is said"),
        Err(errors) => errors.to_string(),
    }
}

/// What is wrong in files of OUTPUT4.
#[test]
fn files_of_output4_that_are_wrong() {
    let text = String::from_utf8(data("yeti-nonbigmat-text.op4")).expect("a text");
    let dense = String::from_utf8(data("yeti-dense-text.op4")).expect("a text");
    let binary = data("yeti-bigmat-little.op4");
    let changed = |own: &str, from: &str, to: &str| -> Vec<u8> {
        assert!(own.contains(from), "{from}");
        own.replacen(from, to, 1).into_bytes()
    };
    let with = |bytes: Vec<u8>, name: &str| -> String {
        let folder = Folder::default().with("a.op4", bytes);
        said(&folder, &by_rows(&format!("a.op4{name}"), "M.mtx"))
    };
    let nan: Vec<u8> = {
        let mut own = binary.clone();
        // The first value of the first string: behind the head, and the heads of column and string.
        own[32 + 4 + 12 + 8..][..8].copy_from_slice(&f64::NAN.to_le_bytes());
        own
    };
    let (half, lines) = (binary.len() / 2, dense.lines().count());
    let cut: String = dense.lines().take(lines / 3).map(|line| format!("{line}\n")).collect();
    for (bytes, name, words) in [
        (
            text.clone().into_bytes(),
            "",
            &[
                "a.op4: the file has more than one matrix that may be K: KAA, MAA",
                "`model.op4:KAA`",
            ][..],
        ),
        (
            text.clone().into_bytes(),
            ":KXX",
            &["the file has no matrix `KXX`", "the file has KAA, MAA"],
        ),
        (
            data("yeti-complex.op4"),
            ":KAA",
            &["K (KAA) has complex values", "without structural damping"],
        ),
        (cut.into_bytes(), ":KAA", &["the file ends where", "cut off"]),
        (
            binary[..half].to_vec(),
            ":KAA",
            &["the file ends or is damaged within column", "write it again"],
        ),
        (binary[..20].to_vec(), ":KAA", &["within the head of a matrix"]),
        (nan, ":KAA", &["row 1 of column 1 of KAA is no finite number"]),
        (
            changed(
                &text,
                "      36      36       6       2KAA",
                "      36      35       6       2KAA",
            ),
            ":KAA",
            &["goes beyond its 35 rows"],
        ),
        (
            changed(
                &dense,
                "      36      36       6       2KAA",
                "      36      40       6       2KAA",
            ),
            ":KAA",
            &["a.op4:1: K has 40 rows, but 36 dofs are listed"],
        ),
        (
            changed(&dense, "       6       2KAA", "       4       2KAA"),
            ":KAA",
            &["K (KAA) has the form 4, and must be square"],
        ),
        (
            changed(&dense, "       6       2KAA", "       6       7KAA"),
            ":KAA",
            &["a.op4:1: KAA has values of type 7"],
        ),
        (
            changed(&dense, "       2       1      24", "       1       1      24"),
            ":KAA",
            &["column 1 of KAA stands behind column 1 of 36"],
        ),
        (
            changed(&dense, "       2       1      24", "       2       1     -24"),
            ":KAA",
            &["column 2 of KAA has -24 values"],
        ),
        (
            changed(&dense, "7.5860869307751572E+08", "                   nan"),
            ":KAA",
            &["a.op4:3:", "should stand here"],
        ),
        (
            changed(&dense, "7.5860869307751572E+08", "7.5860869307751572E+07"),
            ":KAA",
            &["K (KAA) is not symmetric: (node 2 y, node 2 x)"],
        ),
        (
            changed(&dense, " 1.9285027437279179E+09", "-1.9285027437279179E+09"),
            ":KAA",
            &["a.op4:3: the diagonal of K (KAA) is negative at node 2 x"],
        ),
        (
            b"\x04\0\0\0\x03\0\0\0\x04\0\0\0".to_vec(),
            "",
            &["K is in a file of OUTPUT2", "OUTPUT4, or as DMIG"],
        ),
        (Vec::new(), "", &["K is not in the Matrix Market format"]),
    ] {
        let said = with(bytes, name);
        for word in words {
            assert!(said.contains(word), "`{word}` is not in:\n{said}");
        }
        assert!(said.contains("help: "), "{said}");
    }
}

/// What is wrong in files of Abaqus.
#[test]
fn files_of_abaqus_that_are_wrong() {
    let text = |name: &str| String::from_utf8(data(name)).expect("a text");
    let (input, labels, coordinate) =
        (text("input_STIF1.mtx"), text("labels_STIF1.mtx"), text("coordinate_STIF1.mtx"));
    let half = |own: &str| -> String {
        own.lines().take(own.lines().count() / 2).map(|line| format!("{line}\n")).collect()
    };
    let line = |own: &str, number: usize, new: &str| -> String {
        let lines = own.lines().enumerate();
        lines
            .map(|(place, line)| format!("{}\n", if place + 1 == number { new } else { line }))
            .collect()
    };
    let by_row = by_rows("coordinate_STIF1.mtx", "coordinate_MASS1.mtx");
    for (request, file, changed, words) in [
        (
            by_labels("input"),
            "input_STIF1.mtx",
            half(&input),
            &["input_STIF1.mtx: K has no entries of", "cut off"][..],
        ),
        (
            by_labels("input"),
            "input_STIF1.mtx",
            line(&input, 2, "2,2, 2,1"),
            &[
                "input_STIF1.mtx:2:1: an entry of K is `node, dof, node, dof, value`, this line has 4 words",
            ],
        ),
        (
            by_labels("input"),
            "input_STIF1.mtx",
            line(&input, 2, "2,2, 2,1, nan"),
            &["a value of K must be a finite number, found `nan`"],
        ),
        (
            by_labels("input"),
            "input_STIF1.mtx",
            line(&input, 2, "2,2, -7,1, 1.5"),
            &["node -7 is one that Abaqus adds to the model", "hybrid"],
        ),
        (
            by_labels("input"),
            "input_STIF1.mtx",
            line(&input, 2, "2,2, 2,11, 1.5"),
            &["11 is no displacement or rotation of node 2"],
        ),
        (
            by_labels("input"),
            "input_STIF1.mtx",
            line(&input, 1, "9,2, 9,2, 1.5e9"),
            &["1 node without a place: 9", "say where they are in body.inp"],
        ),
        (
            by_labels("labels"),
            "labels_STIF1.mtx",
            line(&labels, 2, "2 1 2 2 5.0"),
            &["K is not symmetric: (node 2 y, node 2 x)"],
        ),
        (
            by_labels("input"),
            "input_STIF1.mtx",
            format!("{input}*MATRIX,TYPE=STIFFNESS\n"),
            &["`*MATRIX,TYPE=STIFFNESS` is no entry of K", "substructures are not read"],
        ),
        (
            by_labels("input"),
            "input_MASS1.mtx",
            coordinate.clone(),
            &["input_MASS1.mtx: M has no labels of nodes and dofs", "FORMAT=MATRIX INPUT"],
        ),
        (
            by_row.clone(),
            "coordinate_STIF1.mtx",
            half(&coordinate),
            // Nodes in the middle have entries with all others.
            &["coordinate_STIF1.mtx:", "K is not symmetric"],
        ),
        (
            by_row.clone(),
            "coordinate_STIF1.mtx",
            line(&coordinate, 2, "37, 1, 2.0"),
            &["coordinate_STIF1.mtx:2:1: (37, 1) is no place in K of 36 rows"],
        ),
        (
            by_row.clone(),
            "coordinate_STIF1.mtx",
            line(&coordinate, 2, "1, 2"),
            &["this line has 2 words"],
        ),
        (
            by_row.clone(),
            "coordinate_STIF1.mtx",
            input.clone(),
            &["K is listed by nodes and dofs", "leave `dofs` out"],
        ),
    ] {
        let said = said(&Folder::default().with(file, changed), &request);
        for word in words {
            assert!(said.contains(word), "`{word}` is not in:\n{said}");
        }
        assert!(said.contains("help: "), "{said}");
    }
    // A mass that is missing may be none: it is said.
    let mass = half(&text("input_MASS1.mtx"));
    let read = Folder::default().with("input_MASS1.mtx", mass).read(&by_labels("input"));
    let said = match read {
        Ok(read) => read.warnings.iter().map(ToString::to_string).collect::<String>(),
        Err(errors) => errors.to_string(),
    };
    assert!(said.contains("M "), "{said}");
}
