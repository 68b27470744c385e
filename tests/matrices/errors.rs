//! Files that are wrong: each is an error with its place and what to do.

use super::formats::{as_calculix, as_dmig, as_market};
use super::{Texts, bar, calculix, dmig, market};
use whirl_solver::mesh::matrices::Request;

/// What is said of files in which one has another text.
fn said(texts: &Texts, request: &Request, file: &str, change: &dyn Fn(&str) -> String) -> String {
    let text = &texts.0[std::path::Path::new(file)];
    let changed = change(text);
    assert!(changed != *text, "{file}: nothing has changed");
    match texts.clone().with(file, changed).read(request) {
        Ok(_) => panic!("{file}: nothing is said"),
        Err(errors) => errors.to_string(),
    }
}

type Change<'a> = &'a dyn Fn(&str) -> String;

fn all(texts: &Texts, request: &Request, cases: &[(&str, Change, &[&str])]) {
    for (file, change, words) in cases {
        let said = said(texts, request, file, change);
        for word in *words {
            assert!(said.contains(word), "`{word}` is not in:\n{said}");
        }
        assert!(said.contains("help: "), "{said}");
    }
}

/// The text without its last lines.
fn cut(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    lines[..lines.len() - 20].join("\n")
}

/// The line of this number, from 1, changed.
fn line(text: &str, number: usize, change: impl Fn(&str) -> String) -> String {
    let lines = text.lines().enumerate();
    let lines = lines.map(|(i, own)| if i + 1 == number { change(own) } else { own.to_owned() });
    lines.map(|own| own + "\n").collect()
}

#[test]
fn matrix_market_files_that_are_wrong() {
    let texts = as_market(&bar());
    let value = |line: &str, value: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        format!("{} {} {value}", words[0], words[1])
    };
    all(
        &texts,
        &market(),
        &[
            ("K.mtx", &cut, &["K.mtx:", "its line of sizes says", "cut off"]),
            (
                "K.mtx",
                &|_| String::new(),
                &["K.mtx:1: K is not in the Matrix Market format", "scipy.io.mmwrite"],
            ),
            ("K.mtx", &|text| text.replace("real", "complex"), &["K.mtx:1: K has complex values"]),
            (
                "K.mtx",
                &|text| text.replace("symmetric", "hermitian"),
                &["`hermitian` is no symmetry"],
            ),
            ("K.mtx", &|text| text.replace("symmetric", "skew-symmetric"), &["skew-symmetric"]),
            (
                "K.mtx",
                &|text| line(text, 3, |_| "900000000000 900000000000 5".to_owned()),
                &["has 900000000000 rows, but", "dofs are listed"],
            ),
            (
                "K.mtx",
                &|_| {
                    "%%MatrixMarket matrix array real general\n99999999999999999 99999999999999999\n1\n".to_owned()
                },
                &["K.mtx:2: K has 99999999999999999 rows"],
            ),
            (
                "K.mtx",
                &|text| line(text, 4, |own| value(own, "nan")),
                &["K.mtx:4:1: a value of K must be a finite number, found `nan`"],
            ),
            (
                "K.mtx",
                &|text| line(text, 4, |own| value(own, "1e999")),
                &["K.mtx:4:1:", "beyond all numbers"],
            ),
            (
                "K.mtx",
                &|text| line(text, 4, |own| value(own, "-1")),
                &["K.mtx:4: the diagonal of K is negative at node 1 x"],
            ),
            ("K.mtx", &|text| line(text, 4, |_| "0 1 1".to_owned()), &["(0, 1) is no place in K"]),
            (
                "M.mtx",
                &|text| line(text, 5, |own| value(own, "7")),
                &["M.mtx:", "M is not symmetric: (node"],
            ),
            (
                "M.mtx",
                &|text| line(text, 5, |_| text.lines().nth(3).expect("a line").to_owned()),
                &["M.mtx:5: the entry (node 1 x, node 1 x) of M is given twice", "line 4"],
            ),
            ("dofs.csv", &cut, &["dofs are listed", "list each dof once"]),
            ("dofs.csv", &|_| String::new(), &["the table of dofs is empty", "node, direction"]),
            (
                "dofs.csv",
                &|text| text.replace("[mm]", "[parsec]"),
                &["dofs.csv:1:18: `parsec` is no unit of length"],
            ),
            (
                "dofs.csv",
                &|text| line(text, 3, |own| own.replace(", y,", ", w,")),
                &["dofs.csv:3:4: `w` is no direction of a dof", "rx, ry, rz or mode"],
            ),
            (
                "dofs.csv",
                &|text| line(text, 3, |own| own.replace(", y,", ", x,")),
                &["dofs.csv:3:1: node 1 x is listed twice", "line 2"],
            ),
            (
                "dofs.csv",
                &|text| line(text, 3, |own| own.replace(", y, ", ", y, 1")),
                &["node 1 stands at"],
            ),
            (
                "dofs.csv",
                &|text| {
                    text.lines()
                        .map(|own| own.split(", ").take(2).collect::<Vec<_>>().join(", ") + "\n")
                        .collect()
                },
                &["node, direction, x, y, z"],
            ),
            (
                "dofs.csv",
                &|text| {
                    text.lines()
                        .map(|own| {
                            if own.starts_with("7,") {
                                own.split(", ").take(2).collect::<Vec<_>>().join(", ") + "\n"
                            } else {
                                own.to_owned() + "\n"
                            }
                        })
                        .collect()
                },
                &["1 node without a place: 7"],
            ),
        ],
    );
    // K and M exchanged.
    let swapped = texts.clone().with("M.mtx", texts.0[std::path::Path::new("K.mtx")].clone());
    let said = swapped.read(&market()).expect_err("another mass along each axis").to_string();
    assert!(
        said.contains("M has another mass along each axis") || said.contains("M.mtx"),
        "{said}"
    );
    let gone = Texts::default().with("dofs.csv", texts.0[std::path::Path::new("dofs.csv")].clone());
    let said = gone.read(&market()).expect_err("no K").to_string();
    assert!(
        said.contains("K.mtx: it cannot be read") && said.contains("M.mtx: it cannot"),
        "{said}"
    );
}

#[test]
fn files_of_calculix_that_are_wrong() {
    let texts = as_calculix(&bar());
    all(
        &texts,
        &calculix(),
        &[
            (
                "job.sti",
                &|text| text.lines().take(3000).map(|own| own.to_owned() + "\n").collect(),
                &["job.sti: K has no entries in row", "of one run"],
            ),
            ("job.sti", &cut, &["larger than √(0e0", "in another order"]),
            (
                "job.sti",
                &|text| line(text, 2, |_| "1 900000000000 1".to_owned()),
                &["job.sti:2:1: (1, 900000000000) is beyond the"],
            ),
            (
                "job.sti",
                &|text| line(text, 2, |_| "1 2".to_owned()),
                &["job.sti:2:1:", "this line has 2 words"],
            ),
            (
                "job.mas",
                &|text| line(text, 2, |_| "1 2 inf".to_owned()),
                &["job.mas:2:1: a value of M must be a finite number, found `inf`"],
            ),
            (
                "job.dof",
                &|text| line(text, 2, |_| "1.9".to_owned()),
                &["job.dof:2:1: `1.9` is no dof"],
            ),
            ("job.dof", &|_| String::new(), &["job.dof: the file lists no dofs"]),
            ("job.dof", &cut, &["is beyond the"]),
            ("job.inp", &|text| line(text, 3, |_| String::new()), &["1 node without a place: 2"]),
            (
                "job.inp",
                &|text| format!("*TRANSFORM, NSET=A\n1,0,0,0,1,0\n{text}"),
                &["job.inp:1:1: *TRANSFORM turns the axes of nodes"],
            ),
        ],
    );
}

#[test]
fn cards_of_nastran_that_are_wrong() {
    let texts = as_dmig(&bar());
    all(
        &texts,
        &dmig(),
        &[
            (
                "body.pch",
                &|text| text.replace("DMIG,MAAX", "DMIG,MXX"),
                &["the file has no DMIG `MAAX`", "KAAX, MXX"],
            ),
            (
                "body.pch",
                &|_| "GRID,1,,0.,0.,0.\n".to_owned(),
                &["body.pch: the file has no cards DMIG", "DMIGPCH"],
            ),
            (
                "body.pch",
                &|text| text.replace("DMIG,KAAX,0,6,2,0", "DMIG,KAAX,0,6,4,0"),
                &["body.pch:1:1: KAAX has values of type 4"],
            ),
            (
                "body.pch",
                &|text| text.replace("DMIG,KAAX,0,6,2,0", "DMIG,KAAX,0,9,2,0"),
                &["K (KAAX) has the form 9"],
            ),
            (
                "body.pch",
                &|text| text.replace("DMIG,KAAX,0,6,2,0\n", ""),
                &["a column of KAAX stands before its head"],
            ),
            (
                "body.pch",
                &|text| format!("{text}DMIG,MAAX,0,6,2,0\n"),
                &["there is a second head of MAAX"],
            ),
            (
                "body.pch",
                &|text| text.replace("DMIG,KAAX,1,1,,1,1,", "DMIG,KAAX,1,1,,1,7,"),
                &["7 is no component of node 1"],
            ),
            (
                "body.pch",
                &|text| text.replace("DMIG,KAAX,1,1,,1,1,", "DMIG,KAAX,1,1,,1,1,x"),
                &["value of an entry (field 8 of DMIG) must be a number"],
            ),
            (
                "body.bdf",
                &|text| text.replace("GRID,7,", "GRID,7000,"),
                &["1 node without a place: 7", "say where they are in body.bdf"],
            ),
            (
                "body.bdf",
                &|text| line(text, 2, |own| format!("{own},5")),
                &["the displacements of node 1 are along the axes of coordinate system 5"],
            ),
        ],
    );
}

/// An entry larger than its diagonal allows, and a stiffness that is not positive semidefinite beyond that.
#[test]
fn matrices_of_no_body_are_refused() {
    let table = "node, direction, x, y, z\n1, x, 0, 0, 0\n2, x, 0, 0, 1\n3, x, 0, 0, 2\n";
    let head = "%%MatrixMarket matrix coordinate real symmetric\n3 3 6\n";
    let unit = format!("{head}1 1 1\n2 2 1\n3 3 1\n2 1 0\n3 1 0\n3 2 0\n");
    let texts = |k: &str| {
        Texts::default()
            .with("dofs.csv", table)
            .with("M.mtx", unit.clone())
            .with("K.mtx", format!("{head}{k}"))
    };
    let large = texts("1 1 1\n2 2 1\n3 3 1\n2 1 1.5\n3 1 0\n3 2 0\n");
    let said = large.read(&market()).expect_err("no K").to_string();
    assert!(
        said.contains("K.mtx:6: the entry (node 2 x, node 1 x) of K is 1.5e0, larger than"),
        "{said}"
    );
    let indefinite = texts("1 1 1\n2 2 1\n3 3 1\n2 1 -.9\n3 1 -.9\n3 2 -.9\n");
    let said = indefinite.read(&market()).expect_err("no K").to_string();
    assert!(said.contains("K.mtx: K is not positive semidefinite (found near node"), "{said}");
    // A body that the matrices hold is no error, but said.
    let held = texts("1 1 2\n2 2 2\n3 3 2\n2 1 0\n3 1 0\n3 2 0\n").read(&market()).expect("a body");
    let said: Vec<String> = held.warnings.iter().map(ToString::to_string).collect();
    assert!(
        said.concat()
            .contains("K holds the body to the ground against shifts along x, turns about y"),
        "{said:?}"
    );
    let (what, _) =
        held.mesh.matrices().expect("matrices").lacks_to_be_free("that turns").expect("held");
    assert!(what.contains("but a body that turns must be free"), "{what}");
}
