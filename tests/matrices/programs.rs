//! One body as other programs write it (tests/data/matrices/make.py), against what SciPy wrote in the Matrix Market format.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use whirl_solver::error::InputErrors;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::matrices::{Files, ReadMatrices, Request, read};
use whirl_solver::support::Support;
use whirl_tests::matrices as written;

use super::op4::{Layout, Written, op4};
use super::{on_feet, request};

/// Files by name: changed ones, else those of the folder.
#[derive(Default)]
pub(super) struct Folder(pub(super) BTreeMap<PathBuf, Vec<u8>>);

impl Folder {
    pub(super) fn with(mut self, name: &str, bytes: impl Into<Vec<u8>>) -> Folder {
        self.0.insert(PathBuf::from(name), bytes.into());
        self
    }

    pub(super) fn read(&self, request: &Request) -> Result<ReadMatrices, InputErrors> {
        let load = |path: &Path| match self.0.get(path) {
            Some(own) => Ok(own.clone()),
            None => packed(path),
        };
        read(request, &load)
    }
}

fn packed(path: &Path) -> io::Result<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/matrices");
    let file = std::fs::File::open(folder.join(format!("{}.gz", path.display())))?;
    let mut bytes = Vec::new();
    io::Read::read_to_end(&mut flate2::read::GzDecoder::new(file), &mut bytes)?;
    Ok(bytes)
}

/// A file of the folder.
pub(super) fn data(name: &str) -> Vec<u8> {
    packed(Path::new(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// With the table of the dofs.
pub(super) fn by_rows(stiffness: &str, mass: &str) -> Request {
    request(Files::Market {
        stiffness: stiffness.into(),
        mass: mass.into(),
        dofs: "dofs.csv".into(),
    })
}

pub(super) fn by_labels(kind: &str) -> Request {
    request(Files::Abaqus {
        stiffness: format!("{kind}_STIF1.mtx").into(),
        mass: format!("{kind}_MASS1.mtx").into(),
        nodes: "body.inp".into(),
    })
}

fn mesh(request: &Request) -> Mesh {
    Folder::default().read(request).unwrap_or_else(|errors| panic!("{errors}")).mesh
}

fn entries(mesh: &Mesh) -> [Vec<(usize, usize, f64)>; 2] {
    written::of_mesh(mesh).map(|own| {
        let columns = 0..own.width();
        columns
            .flat_map(|j| own.column(j).map(move |(i, value)| (i, j, value)).collect::<Vec<_>>())
            .collect()
    })
}

fn yardstick() -> Mesh {
    mesh(&by_rows("K.mtx", "M.mtx"))
}

fn hertz(mesh: &Mesh) -> Vec<f64> {
    Support::from_mesh(mesh, &on_feet(mesh, 12)).expect("a body").hertz
}

/// Files with all digits give the same bits, matrices and frequencies.
#[test]
fn files_with_all_digits_give_the_same_bits() {
    let known = yardstick();
    assert_eq!((known.placed(), known.labels()[11]), (12, 70000));
    let (wanted, frequencies) = (entries(&known), hertz(&known));
    assert!(frequencies[0] > 1000.0 && wanted[0].len() > 700);
    let kinds = ["dense", "bigmat", "nonbigmat"];
    let of_yeti = kinds
        .into_iter()
        .flat_map(|kind| ["text", "little", "big"].map(|order| format!("yeti-{kind}-{order}.op4")));
    let of_nastran = ["double", "single"].map(|own| format!("nastran-{own}-text.op4"));
    for name in of_yeti.chain(of_nastran) {
        let read = mesh(&by_rows(&format!("{name}:KAA"), &format!("{name}:maa")));
        assert!(entries(&read) == wanted, "{name}");
        assert_eq!(hertz(&read), frequencies, "{name}");
    }
    // The only matrix of a file needs no name; K and M may be in files of different programs.
    let read = mesh(&by_rows("K.mtx", "yeti-one.op4"));
    assert!(entries(&read) == wanted);
}

/// Files with fewer digits agree to these.
#[test]
fn files_with_fewer_digits_agree_to_them() {
    let known = yardstick();
    let (wanted, frequencies) = (entries(&known), hertz(&known));
    let dmig = request(Files::Dmig {
        file: "body.pch".into(),
        nodes: "body.bdf".into(),
        stiffness: "KAAX".to_owned(),
        mass: "MAAX".to_owned(),
    });
    // Half a unit of the last digit: of sixteen in what is as Abaqus writes, of eleven in fields of pyNastran.
    for (what, request, digits) in [
        ("MATRIX INPUT", by_labels("input"), 0.5e-15),
        ("LABELS", by_labels("labels"), 0.5e-15),
        ("COORDINATE", by_rows("coordinate_STIF1.mtx", "coordinate_MASS1.mtx"), 0.5e-15),
        ("DMIG", dmig, 0.5e-10),
    ] {
        let read = mesh(&request);
        let found = entries(&read);
        for (own, wanted) in found.iter().zip(&wanted) {
            assert_eq!(own.len(), wanted.len(), "{what}");
            for (a, b) in own.iter().zip(wanted) {
                assert_eq!((a.0, a.1), (b.0, b.1), "{what}");
                // A digit counts most where the number begins with a one; the mean of M rounds once more.
                let most = digits * b.2.abs() * 1.0000001 + f64::EPSILON * b.2.abs();
                assert!((a.2 - b.2).abs() <= most, "{what}: {} {}", a.2, b.2);
            }
        }
        for (a, b) in hertz(&read).iter().zip(&frequencies) {
            // The square of a frequency is as wrong as K and M, times how much larger their entries are than the sums of
            // which it is: some hundreds here.
            assert!((a / b - 1.0).abs() <= 1000.0 * digits, "{what}: {a} {b}");
        }
    }
    let sets = mesh(&by_labels("input"));
    assert_eq!(sets.node_set("foot").expect("a set"), [0, 1, 2, 3]);
}

/// All that OUTPUT4 has and pyYeti does not write: single precision, and words of eight bytes.
#[test]
fn every_layout_of_output4_is_read() {
    let known = yardstick();
    let [k, m] = written::of_mesh(&known);
    // In single precision, as it has no more digits in a text either.
    let rounded = |all: [whirl_solver::sparse::SparseColumns; 2]| {
        all.map(|own| own.values.iter().map(|value| *value as f32).collect::<Vec<_>>())
    };
    for layout in [Layout::Dense, Layout::Big, Layout::Packed] {
        for written in Written::ALL {
            for is_single in [false, true] {
                let file: Vec<u8> = [("KAA", &k, 6), ("MASS_2", &m, 1)]
                    .into_iter()
                    .flat_map(|(name, own, form)| op4(name, own, form, layout, written, is_single))
                    .collect();
                let folder = Folder::default().with("all.op4", file);
                let what = format!("{layout:?} {written:?} {is_single}");
                let read = folder.read(&by_rows("all.op4:KAA", "all.op4:MASS_2"));
                let read = read.unwrap_or_else(|errors| panic!("{what}: {errors}")).mesh;
                // Words of eight bytes have all digits in either precision.
                let found = written::of_mesh(&read);
                match is_single && !matches!(written, Written::Wide { .. }) {
                    true => assert!(rounded(found) == rounded([k.clone(), m.clone()]), "{what}"),
                    false => assert!(found == [k.clone(), m.clone()], "{what}"),
                }
            }
        }
    }
}

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
    // M in place of K is a body without stiffness that is so soft, and is no error; K in place of M is one.
    let said =
        said(&Folder::default(), &by_rows("yeti-dense-text.op4:KAA", "yeti-dense-text.op4:KAA"));
    assert!(said.contains("M") && said.contains("help: "), "{said}");
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
            &["input_STIF1.mtx: K has no entries of", "node 70000 z", "cut off"][..],
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
            &["K is not symmetric: (node 2 x, node 2 y)"],
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
            &["coordinate_STIF1.mtx: K has no entries of", "cut off"],
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
