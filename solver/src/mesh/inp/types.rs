//! What becomes of the elements of a type.

use whirl_specs::Element;

use super::super::raw::{FACE_MIDDLES, MeshReport, did_you_mean, has_face_middles};
use super::cards::Card;
use super::values::required;

/// What becomes of the elements of a type.
pub(super) enum Kind {
    /// They are cells, of an element that is named in the file or has the same nodes.
    Solid(&'static Element, Option<Remark>),
    /// They are no solids.
    LeftOut,
    /// They are solids that are not read, which is an error by itself.
    Refused,
}

/// What is to be said of a type.
pub(super) struct Remark {
    /// What becomes of its cells, behind their number.
    pub(super) what: String,
    /// How results differ, and the remedy where there is one.
    pub(super) difference: &'static str,
}

/// The type of hexahedra without incompatible modes, and how they differ from those that have them: frequencies of
/// tests/meshes/calculix.rs.
const STIFF: (&str, &str) = (
    "C3D8",
    "C3D8 bends too stiffly: the first bending frequency of a cantilever of 300 x 60 x 50 mm is 18 % higher with 2 cells across \
     than with C3D8I, and 5 % higher with 4; C3D8I is within 2 % of the limit with either. Hexahedra of other formats have its \
     incompatible modes; write `TYPE=C3D8I`, which has the same nodes",
);

/// The letters before the number of types that are no solids: lines, faces, shells, membranes, beams, rigid
/// surfaces, masses, springs, dashpots, connectors, gaps and the points of couplings.
const NO_SOLIDS: [&str; 44] = [
    "T", "B", "PIPE", "ELBOW", "FRAME", "CPS", "CPE", "CPEG", "CAX", "CAXA", "CGAX", "S", "STRI",
    "SAX", "SAXA", "DS", "DSAX", "M", "MCL", "MAX", "MGAX", "SFM", "SFMCL", "SFMAX", "SFMGAX", "R",
    "RB", "RAX", "MASS", "ROTARYI", "HEATCAP", "SPRING", "SPRINGA", "DASHPOT", "DASHPOTA", "CONN",
    "JOINTC", "GAPUNI", "GAPUNIT", "GAPCYL", "GAPSPHER", "DCOUP", "ITSUNI", "D",
];

/// How results differ, by the letters behind the number of nodes of a type. Those of R are frequencies that
/// CalculiX 2.20 gives for tests/data/calculix/reduced.py.
const DIFFERENCES: [(&str, &str); 8] = [
    (
        "8R",
        "C3D8R bends more softly: CalculiX finds the first bending frequency of a cantilever 13 % lower with 2 cells \
         across, and 3 % lower with 4; C3D8I is within 2 % of the limit with either",
    ),
    (
        "20R",
        "C3D20R is softer: CalculiX finds frequencies of a cantilever 3 % lower with 2 x 2 x 2 cells, 0.4 % with \
         6 x 2 x 2 and 0.1 % with 12 x 4 x 4. A body by `matrices = { calculix = … }` keeps C3D20R",
    ),
    (
        "8T",
        "temperatures are left out, and cells without incompatible modes bend too stiffly: C3D8I has the same nodes",
    ),
    ("R", "elements with fewer points are softer, and have the same limit"),
    ("H", "hybrid elements differ where ν is near 0.5"),
    ("M", "modified elements have the same limit: compare with a finer mesh"),
    ("T", "temperatures are left out"),
    ("I", "it differs in its stresses only"),
];

/// What becomes of the elements of a card.
pub(super) fn of_card(card: &Card, elements: &[&'static Element], report: &mut MeshReport) -> Kind {
    let Some(name) = required(card, "TYPE", "*ELEMENT, TYPE=C3D8I, ELSET=NAME", report) else {
        return Kind::Refused;
    };
    let is_named = |element: &&&Element| {
        element.abaqus.iter().any(|known| known.eq_ignore_ascii_case(name.text))
    };
    let capitals = name.text.to_uppercase();
    if let Some(element) = elements.iter().find(is_named) {
        let stiff = (capitals == STIFF.0)
            .then(|| Remark { what: "without incompatible modes".to_owned(), difference: STIFF.1 });
        return Kind::Solid(element, stiff);
    }
    if !may_be_solid(&capitals) {
        return Kind::LeftOut;
    }
    if let Some((element, known, behind)) = alike(&capitals, elements)
        && let Some((_, difference)) = DIFFERENCES.iter().find(|(end, _)| behind.contains(end))
    {
        let what = format!("read as {known}");
        return Kind::Solid(element, Some(Remark { what, difference }));
    }
    let digits = |c: char| !c.is_ascii_digit();
    let nodes = capitals.strip_prefix("C3D").and_then(|rest| rest.split(digits).next());
    if nodes.and_then(|nodes| nodes.parse().ok()).is_some_and(has_face_middles) {
        report.error(name, format!("no element is known for type {}", name.text), FACE_MIDDLES);
        return Kind::Refused;
    }
    let types: Vec<&str> =
        elements.iter().flat_map(|element| element.abaqus.iter().copied()).collect();
    let close = did_you_mean(name.text, types.iter().copied());
    let listed = format!("solids that are read: {}", types.join(", "));
    let help = if close.starts_with("did") { format!("{close} {listed}") } else { listed };
    report.error(name, format!("no element is known for type {}", name.text), help);
    Kind::Refused
}

/// Whether a type is none of those that are known not to be solids.
pub(super) fn may_be_solid(name: &str) -> bool {
    let letters = name.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(name.len());
    !NO_SOLIDS.contains(&name[..letters].to_uppercase().as_str())
}

/// The element that has the nodes of a type such as `C3D20RH`, which differs in its integration (R), is hybrid (H),
/// modified (M) or coupled to temperatures (T), with its own type and the end of `name` from the number of nodes on.
/// Of several the one with incompatible modes.
fn alike<'t>(
    name: &'t str,
    elements: &[&'static Element],
) -> Option<(&'static Element, &'static str, &'t str)> {
    let behind = name.strip_prefix("C3D")?;
    let nodes: usize = behind.trim_end_matches(|c: char| c.is_ascii_alphabetic()).parse().ok()?;
    let ways = behind.trim_start_matches(|c: char| c.is_ascii_digit());
    if !ways.chars().all(|c| "RHMTI".contains(c)) {
        return None;
    }
    let solids = elements.iter().filter(|element| element.nodes == nodes);
    let mut types: Vec<(&'static Element, &'static str)> = solids
        .flat_map(|element| element.abaqus.iter().map(|known| (*element, *known)))
        .filter(|(_, known)| known.starts_with("C3D"))
        .collect();
    // Elements coupled to temperatures have no incompatible modes.
    let modes = !ways.contains('T') || ways.contains('R');
    types.sort_by_key(|(_, known)| known.ends_with('I') != modes);
    types.first().map(|&(element, known)| (element, known, behind))
}
