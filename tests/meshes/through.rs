//! The reference shaft and support through each format of Gmsh.

use whirl_solver::mesh::Mesh;

use crate::open;
use crate::packed::data;
use crate::writer::{Kind, gmsh};

fn reference(name: &str) -> Mesh {
    let path = format!("{name}.inp");
    open(&data(&path), &path).unwrap_or_else(|errors| panic!("{errors}")).mesh
}

fn sorted(set: &[usize]) -> Vec<usize> {
    let mut set = set.to_vec();
    set.sort_unstable();
    set
}

#[test]
fn the_reference_bodies_are_the_same_through_every_format() {
    for name in ["shaft", "support"] {
        let known = reference(name);
        for (version, kind) in [
            (2, Kind::Text),
            (2, Kind::Little),
            (2, Kind::Big),
            (4, Kind::Text),
            (4, Kind::Little),
            (4, Kind::Big),
        ] {
            let read = open(&gmsh(&known, version, kind), "body.msh");
            let found = read.unwrap_or_else(|errors| panic!("{version} {kind:?}: {errors}")).mesh;
            assert_eq!(found.nodes(), known.nodes());
            assert_eq!(found.labels(), known.labels());
            assert_eq!(found.blocks().len(), known.blocks().len());
            for (place, (a, b)) in found.blocks().iter().zip(known.blocks()).enumerate() {
                assert_eq!(a.element.origin.name, b.element.origin.name);
                assert_eq!((&a.labels, &a.connectivity), (&b.labels, &b.connectivity));
                let set = found.element_set(&format!("block{}", place + 1)).unwrap();
                assert_eq!(set.len(), b.len());
            }
            for (set, members) in known.node_sets() {
                assert_eq!(found.node_set(set).unwrap(), sorted(members), "{set}");
            }
        }
    }
}
