//! Bodies that several tests use.

use std::io::Read;
use std::path::Path;

use whirl_solver::mesh::{Mesh, inp};

/// A mesh among the test data (`shaft` or `support`), read with elements written by hand.
pub(crate) fn reference(name: &str) -> Mesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("data/{name}.inp.gz"));
    let packed = std::fs::File::open(&path).expect("the test data is there");
    let mut text = String::new();
    flate2::read::GzDecoder::new(packed).read_to_string(&mut text).expect("the test data is text");
    let read = inp::read(&text, &format!("{name}.inp"), &whirl_benches::hand::elements::ELEMENTS);
    let read = read.unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(read.warnings, []);
    read.mesh
}
