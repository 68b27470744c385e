use super::*;
use crate::diagnostic::Source;

const JOURNAL: &str = include_str!("../../../../specs/motion/clearance.toml");

fn read(text: &str) -> Result<ClearanceSpec, String> {
    ClearanceSpec::read(&Source::new("motion/clearance.toml", text))
        .map_err(|errors| errors.iter().map(|e| format!("{e}\n")).collect())
}

#[test]
fn the_journal_is_read() {
    let spec = read(JOURNAL).expect("a clearance");
    assert_eq!(spec.ring.each_ref().map(|c| c.name.as_str()), ["theta", "eps_x", "eps_y"]);
    assert_eq!((spec.clearance.as_str(), spec.radial.name.as_str()), ("h", "delta"));
    let names: Vec<_> = spec.definitions.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["u_x", "u_y"]);
}

#[test]
fn a_force_does_no_work_that_the_clearance_does_not_do() {
    // Σ (generalised force) · (rate) = Q ḣ.
    let spec = read(JOURNAL).expect("a clearance");
    let mut d = spec.derive().expect("derivatives");
    let g = &mut d.graph;
    let mut work = g.mul(d.force.radial, d.radial_rate.symbol);
    for (force, rate) in d.force.ring.iter().zip(&d.ring_rates) {
        let part = g.mul(*force, rate.symbol);
        work = g.add(work, part);
    }
    let expected = g.mul(d.q, d.h_dot);
    assert!(crate::expression::normal::equal(g, work, expected));
    assert!(!g.is_zero(d.force.ring[0]), "the force on the rotation is not zero");
}

#[test]
fn errors_name_the_place() {
    let error = |from: &str, to: &str| read(&JOURNAL.replace(from, to)).expect_err("an error");
    assert!(error("[ring.eps_y]", "[ring.psi]").contains("the name `psi` is taken"));
    assert!(
        error("unit = \"m\"\ntitle = \"radial clearance", "unit = \"mm\"\ntitle = \"r")
            .contains("SI")
    );
    assert!(error("+ delta'", "+ dleta'").contains("delta"));
    assert!(error("'2*s^2 - s'", "'2*s^2 - psi'").contains("psi"));
    assert!(error(", '2*s^2 - s'", "").contains("2 axial functions, but 3 are needed"));
    assert!(error("c - cos(psi)*u_x", "theta - cos(psi)*u_x").contains("clearance.toml:"));
    assert!(error("[ring.theta]", "[ring.j]").contains("kept for the kernels"));
}
