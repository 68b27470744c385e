//! What `whirl check` says of the node sets and of the ties of a mesh.

use std::fmt::Write;

use whirl_solver::mesh::Mesh;
use whirl_text::rounded;

use crate::errors::Failure;
use crate::mesh_file::{mm, ties};
use crate::report::table;

/// Ties by kind; all sets with their numbers of nodes; of those with faces, and of those by place, a table of what they have.
///
/// # Errors
/// Of linear algebra.
pub(super) fn say(text: &mut String, name: &str, mesh: &Mesh) -> Result<(), Failure> {
    ties(mesh).iter().for_each(|own| line!(text, "{name} is joined by {own}"));
    if mesh.node_sets().is_empty() {
        return Ok(());
    }
    let all: Vec<String> =
        mesh.node_sets().iter().map(|(set, nodes)| format!("{set} ({})", nodes.len())).collect();
    line!(text, "node sets of {name}: {}", all.join(", "));
    let heads =
        ["", "nodes", "faces", "area (mm²)", "of the band (%)", "centre (mm)", "off the axis (mm)"];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for (set, nodes) in mesh.node_sets() {
        // A set of all nodes, such as many a mesher writes, is no surface; one or two nodes have no face.
        let by_place = mesh.place_of(set).is_some();
        if !by_place && (nodes.len() < 3 || nodes.len() == mesh.nodes().len()) || nodes.is_empty() {
            continue;
        }
        let caught = mesh.caught(set)?;
        if caught.faces == 0 && !by_place {
            continue;
        }
        let or_none = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
        let faces = match caught.cut {
            0 => caught.faces.to_string(),
            cut => format!("{} ({cut} cut)", caught.faces),
        };
        rows.push(vec![
            set.clone(),
            caught.nodes.to_string(),
            faces,
            or_none(caught.area.map(|area| rounded(1e6 * area, 6).to_string())),
            or_none(caught.share.map(|share| rounded(100.0 * share, 4).to_string())),
            caught.centre.map(mm).join(", "),
            or_none(caught.off_axis.map(mm)),
        ]);
    }
    if rows.len() > 1 {
        text.push_str(&table(&rows));
        text.push('\n');
    }
    Ok(())
}
