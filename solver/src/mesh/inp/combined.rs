//! `*SURFACE, COMBINE=…`: a surface of others.

use std::collections::{BTreeMap, HashSet};

use super::super::raw::{FaceOfCell, MeshReport, NodeTable, did_you_mean};
use super::cards::{Card, Token};

/// Faces of cells by the names of surfaces, in capitals.
pub(super) type Surfaces = BTreeMap<String, Vec<FaceOfCell>>;

/// Nodes and faces.
type Members = (Vec<usize>, Vec<FaceOfCell>);

/// Nodes and faces of the union, the intersection or the difference of surfaces that stand above; `None` after an error.
pub(super) fn of_others(
    card: &Card,
    how: Token,
    (nodes, surfaces): (&NodeTable, &Surfaces),
    report: &mut MeshReport,
) -> Option<Members> {
    let mut all: Vec<Members> = Vec::new();
    for token in card.lines.iter().flatten().filter(|token| !token.text.is_empty()) {
        let faces = surfaces.get(&token.text.to_uppercase());
        let Some((faces, own)) = faces.zip(nodes.named.sets.get(token.text)) else {
            let what = format!("no surface called {} stands above this line", token.text);
            let known = surfaces.keys().map(String::as_str);
            report.error(*token, what, did_you_mean(token.text, known));
            return None;
        };
        all.push((own.to_vec(), faces.clone()));
    }
    let way = how.text.to_uppercase();
    if !["UNION", "INTERSECTION", "DIFFERENCE"].contains(&way.as_str()) {
        let what =
            format!("COMBINE of *SURFACE is UNION, INTERSECTION or DIFFERENCE, found {}", how.text);
        report.error(
            how,
            what,
            did_you_mean(&way, ["UNION", "INTERSECTION", "DIFFERENCE"].into_iter()),
        );
        return None;
    }
    let mut rest = all.into_iter();
    let mut own = rest.next().unwrap_or_default();
    for other in rest {
        own = match way.as_str() {
            "UNION" => ([own.0, other.0].concat(), [own.1, other.1].concat()),
            _ => chosen(own, &other, way == "INTERSECTION"),
        };
    }
    Some(own)
}

/// What of a surface another one has, too, or has not.
fn chosen((nodes, faces): Members, other: &Members, in_both: bool) -> Members {
    let key = |(cell, face): &FaceOfCell| (*cell, face.nodes.as_ptr());
    let there: HashSet<_> = other.1.iter().map(key).collect();
    let faces: Vec<FaceOfCell> =
        faces.into_iter().filter(|own| there.contains(&key(own)) == in_both).collect();
    let there: HashSet<usize> = other.0.iter().copied().collect();
    let nodes = nodes.into_iter().filter(|own| there.contains(own) == in_both).collect();
    (nodes, faces)
}
