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
    // Half a unit of the last digit: of sixteen in what is as Abaqus writes, of ten in fields of pyNastran.
    for (what, request, digits) in [
        ("MATRIX INPUT", by_labels("input"), 0.5e-15),
        ("LABELS", by_labels("labels"), 0.5e-15),
        ("COORDINATE", by_rows("coordinate_STIF1.mtx", "coordinate_MASS1.mtx"), 0.5e-15),
        ("DMIG", dmig, 0.5e-9),
    ] {
        let read = mesh(&request);
        let found = entries(&read);
        for (own, wanted) in found.iter().zip(&wanted) {
            assert_eq!(own.len(), wanted.len(), "{what}");
            for (a, b) in own.iter().zip(wanted) {
                assert_eq!((a.0, a.1), (b.0, b.1), "{what}");
                // A digit counts most where the number begins with a one; the mean of M rounds once more.
                let most = digits * b.2.abs() * 1.0000001 + 4.0 * f64::EPSILON * b.2.abs();
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
    let [k, m] = written::of_mesh(&yardstick());
    // A mass is the mean of those along x, y and z, which rounds.
    let market = Folder::default()
        .with("K2.mtx", written::market(&k, "symmetric"))
        .with("M2.mtx", written::market(&m, "symmetric"));
    let known = market.read(&by_rows("K2.mtx", "M2.mtx")).expect("a body").mesh;
    let wanted = written::of_mesh(&known);
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
                    true => assert!(rounded(found) == rounded(wanted.clone()), "{what}"),
                    false => assert!(found == wanted, "{what}"),
                }
            }
        }
    }
}
