//! Parameters of the cards that are read: one that is not read is an error, since the card may mean something else
//! by it.

use whirl_text::nearest_in_any_case;

use super::super::raw::MeshReport;
use super::cards::Card;

/// A card with the parameters that it needs, those that are read beside them, and those that change nothing of a mesh
/// of isotropic solids.
type Known =
    (&'static str, &'static [&'static str], &'static [&'static str], &'static [&'static str]);

pub(super) const KNOWN: [Known; 21] = [
    ("NODE", &[], &["NSET", "SYSTEM"], &[]),
    ("ELEMENT", &["TYPE"], &["ELSET"], &[]),
    ("NSET", &["NSET"], &["ELSET", "GENERATE", "INSTANCE"], &["INTERNAL", "UNSORTED"]),
    ("ELSET", &["ELSET"], &["GENERATE", "INSTANCE"], &["INTERNAL", "UNSORTED"]),
    (
        "SURFACE",
        &["NAME"],
        &["TYPE", "COMBINE"],
        &["INTERNAL", "NO OFFSET", "NO THICK", "REGION TYPE", "TRIM"],
    ),
    ("MATERIAL", &["NAME"], &[], &["DESCRIPTION", "RTOL", "SRATE FACTOR"]),
    ("ELASTIC", &[], &["TYPE"], &["MODULI"]),
    ("DENSITY", &[], &[], &[]),
    (
        "SOLID SECTION",
        &["ELSET", "MATERIAL"],
        &[],
        &["CONTROLS", "OFFSET", "ORIENTATION", "STACK DIRECTION", "REF NODE"],
    ),
    ("INCLUDE", &["INPUT"], &[], &[]),
    ("PART", &["NAME"], &[], &["INTERNAL"]),
    ("ASSEMBLY", &["NAME"], &[], &[]),
    ("INSTANCE", &["NAME"], &["PART"], &["DEPENDENT"]),
    ("EQUATION", &[], &[], &[]),
    ("MPC", &[], &[], &[]),
    (
        "TIE",
        &[],
        &["POSITION TOLERANCE", "ADJUST", "TIED NSET"],
        &["NAME", "TYPE", "NO ROTATION", "NO THICKNESS"],
    ),
    (
        "RIGID BODY",
        &[],
        &["REF NODE", "ROT NODE", "NSET", "ELSET", "PIN NSET", "TIE NSET"],
        &["NAME", "ANALYTICAL SURFACE", "ISOTHERMAL"],
    ),
    (
        "COUPLING",
        &[],
        &["REF NODE", "SURFACE", "INFLUENCE RADIUS", "ORIENTATION"],
        &["CONSTRAINT NAME", "ALPHA"],
    ),
    ("KINEMATIC", &[], &[], &[]),
    ("DISTRIBUTING", &[], &[], &["COUPLING"]),
    ("KINEMATIC COUPLING", &[], &["REF NODE"], &[]),
];

/// Values that say what holds without them.
const USUAL: [(&str, &str); 3] =
    [("DEPENDENCIES", "0"), ("WEIGHTING METHOD", "UNIFORM"), ("POSITION", "INPUT")];

/// Notes the parameters of a card that are not read. Where one is missing that the card needs, that is the error.
pub(super) fn check(card: &Card, report: &mut MeshReport) {
    let Some((keyword, needed, read, idle)) =
        KNOWN.iter().find(|(keyword, ..)| *keyword == card.keyword)
    else {
        return;
    };
    if needed.iter().any(|name| card.parameter(name).is_none()) {
        return;
    }
    let known = || needed.iter().chain(*read).chain(*idle).copied();
    for (place, parameter) in card.parameters.iter().enumerate() {
        let name = parameter.name.as_str();
        if !name.is_empty() && card.parameters[..place].iter().any(|other| other.name == name) {
            let what = format!("{name} of *{keyword} is given twice");
            report.error(parameter.place, what, "leave one of them");
            continue;
        }
        let usual = parameter.value.is_some_and(|value| {
            let is = |(own, usual): &(&str, &str)| {
                *own == name && value.text.eq_ignore_ascii_case(usual)
            };
            USUAL.iter().any(is)
        });
        // The lines of any card may be in another file.
        if name.is_empty() || name == "INPUT" || usual || known().any(|known| known == name) {
            continue;
        }
        let help = match nearest_in_any_case(name, known()) {
            Some(close) => format!("is {close} meant?"),
            None => {
                "take it out if the mesh is the same without it; else write out what it stands for"
                    .to_owned()
            }
        };
        report.error(parameter.place, format!("{name} of *{keyword} is not read"), help);
    }
}
