//! Journals and bores that are surfaces of meshes, chosen by where they are.

use super::run;
use crate::workbench::Workbench;

/// A rotor in a block, without joints.
const MACHINE: &str = include_str!("surfaces.toml");

/// Bearings on single nodes and rings, as the meshes made from dimensions have them.
fn on_rings() -> String {
    let joint = |k: usize| {
        let sets = |prefix: &str| {
            ["LEFT", "MIDDLE", "RIGHT"].map(|end| format!("{prefix}{k}_{end}")).to_vec()
        };
        format!(
            "[joint.b{k}]\nkind = \"bearing\"\nlaw = \"hu2003-nonlinear\"\nradial_clearance = \"50 um\"\nsprings = 24\n\
             journal = {{ body = \"rotor\", sets = {:?} }}\nbore = {{ body = \"block\", sets = {:?} }}\n",
            sets("JOURNAL"),
            sets("BORE")
        )
    };
    MACHINE.to_owned() + &joint(1) + &joint(2)
}

/// Bearings on the faces at the same places.
fn on_faces() -> String {
    let joint = |k: usize, from: usize| {
        let z = format!("z = [\"{from} mm\", \"{} mm\"]", from + 30);
        format!(
            "[body.rotor.sets.J{k}]\nradius = \"20.26 mm\"\n{z}\n\
             [body.block.sets.B{k}]\nradius = \"20.05 mm\"\nwithin = \"10 um\"\n{z}\n\
             [joint.b{k}]\nkind = \"bearing\"\nlaw = \"hu2003-nonlinear\"\nradial_clearance = \"50 um\"\nsprings = 24\n\
             journal = {{ body = \"rotor\", surface = \"J{k}\" }}\nbore = {{ body = \"block\", surface = \"B{k}\" }}\n"
        )
    };
    MACHINE.to_owned() + &joint(1, 35) + &joint(2, 235)
}

#[test]
fn bearings_on_faces_do_what_bearings_on_rings_do() {
    let (rings, faces) = (run(&on_rings(), &[]), run(&on_faces(), &[]));
    for column in ["EX_b1_um", "EY_b1_um", "EX_b2_um", "EY_b2_um"] {
        let [a, b] = [&rings, &faces].map(|run| run.history.column(column));
        let largest = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let apart = a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        // The mean motion of a journal is not that of three nodes of its axis, and faces are flat between nodes.
        println!("{column}: {apart} of {largest}");
        assert!(largest > 10.0 && apart < 0.05 * largest, "{column}: {apart} of {largest}");
    }
}

#[test]
fn what_the_meshes_leave_is_compared_with_the_clearance() {
    let outcome = Workbench::new().file("case.toml", &on_faces()).whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    // The polygon of a shaft made from dimensions has the section of the round one.
    let wanted = "the meshes leave -0.206865 mm between the surfaces of the joint `b1` (radii 20.256865 mm and 20.05 mm)";
    assert!(outcome.stderr.contains(wanted), "{}", outcome.stderr);
}
