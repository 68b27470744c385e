//! One row of a table of sections, from a file or from the case.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_solver::mesh::Material;
use whirl_solver::mesh::sections::SectionRow;

use crate::case::dimensions::RowRing;
use crate::case::machine::Materials;
use crate::ring::Ring;

/// What a row may say: diameters and places along z.
pub(super) const LENGTHS: [&str; 9] = [
    "z",
    "length",
    "outer",
    "outer_left",
    "outer_right",
    "inner",
    "inner_left",
    "inner_right",
    "mass_outer",
];
pub(super) const TEXTS: [&str; 2] = ["material", "name"];

/// A row as it is written.
pub(super) struct RowDraft {
    /// All of it.
    pub(super) place: Located,
    /// SI.
    pub(super) lengths: BTreeMap<&'static str, (f64, Located)>,
    pub(super) texts: BTreeMap<&'static str, Located>,
    /// Whether all that it says could be read: only then it is told what it lacks.
    pub(super) is_read: bool,
}

/// A row in a list of the case.
pub(super) fn inline(own: &Table) -> RowDraft {
    let errors = own.errors();
    let lengths =
        LENGTHS.into_iter().filter_map(|key| Some((key, (own.quantity(key)?, own.written(key)))));
    let lengths = lengths.collect();
    let texts =
        TEXTS.into_iter().filter_map(|key| Some((key, own.optional_string(key)?))).collect();
    let place = own.heading().text("");
    RowDraft { place, lengths, texts, is_read: own.errors() == errors }
}

impl RowDraft {
    fn get(&self, key: &str) -> Option<f64> {
        self.lengths.get(key).map(|own| own.0)
    }

    /// Radii at both ends: of `both`, or of the one and the other; none if neither is given, or if what is given is wrong.
    fn radii(&self, table: &Table, both: &str, [left, right]: [&str; 2]) -> Option<[f64; 2]> {
        match (self.get(both), self.get(left), self.get(right)) {
            (Some(d), None, None) => Some([0.5 * d; 2]),
            (None, Some(a), Some(b)) => Some([0.5 * a, 0.5 * b]),
            (None, None, None) => None,
            (Some(_), _, _) => {
                let message = format!(
                    "`{both}` is the diameter at both ends: `{left}` or `{right}` is one too many"
                );
                self.refuse(table, both, message, "keep the one or the other");
                None
            }
            (None, one, _) => {
                let (given, lacks) = if one.is_some() { (left, right) } else { (right, left) };
                let message = format!("`{given}` is given without `{lacks}`");
                let help = format!("give both, or `{both}` for both ends");
                self.refuse(table, given, message, &help);
                None
            }
        }
    }

    fn refuse(&self, table: &Table, key: &str, message: String, help: &str) {
        let place = self.lengths.get(key).map_or(&self.place, |own| &own.1);
        table.push(place.error_here(Code::BAD_VALUE, message).help(help));
    }
}

/// The rows as the mesh is made from them, and what their cells lack of their mass and inertia; `places` get the place of each row.
/// None where one is wrong, which is noted.
pub(super) fn rows(
    table: &Table,
    drafts: &[RowDraft],
    (materials, usual, turns): (&Materials, Option<&Material>, bool),
    places: &mut BTreeMap<String, Located>,
) -> Option<(Vec<SectionRow>, Vec<RowRing>)> {
    let before = table.errors();
    let (mut rows, mut rings, mut next) = (Vec::with_capacity(drafts.len()), Vec::new(), 0.0);
    let mut names = BTreeSet::new();
    let mut lacks_material = false;
    for (k, draft) in drafts.iter().enumerate() {
        places.insert(format!("sections[{}]", k + 1), draft.place.clone());
        for key in LENGTHS.into_iter().filter(|key| *key != "z") {
            let may_be_zero = key.starts_with("inner");
            let own = draft.get(key).filter(|own| *own < 0.0 || *own == 0.0 && !may_be_zero);
            if own.is_some() {
                let what = if may_be_zero { "is negative" } else { "is not positive" };
                let help = if may_be_zero {
                    "give 0 or a positive diameter"
                } else {
                    "give a length above zero"
                };
                draft.refuse(table, key, format!("`{key}` {what}"), help);
            }
        }
        let missing = |key: &str, help: &str| {
            if !draft.is_read {
                return;
            }
            let message = format!("a row has no `{key}`");
            table.push(draft.place.error_here(Code::MISSING_KEY, message).help(help));
        };
        let errors = table.errors();
        let outer = draft.radii(table, "outer", ["outer_left", "outer_right"]);
        if outer.is_none() && table.errors() == errors {
            missing(
                "outer",
                "give the outer diameter `outer`, or `outer_left` and `outer_right` of a cone",
            );
        }
        let inner = draft.radii(table, "inner", ["inner_left", "inner_right"]).unwrap_or([0.0; 2]);
        if draft.get("length").is_none() {
            missing("length", "give its length along z");
        }
        let own = match draft.texts.get("material") {
            Some(name) => materials.called(table, name),
            None => {
                if usual.is_none() && !table.gives("material") && !lacks_material {
                    lacks_material = true;
                    missing(
                        "material",
                        "name one in the row, or `material = \"…\"` of the body for all rows without",
                    );
                }
                usual.cloned()
            }
        };
        let name = draft.texts.get("name");
        if let Some(name) = name {
            if !named_well(name.text()) {
                let message =
                    format!("`{}` cannot be the name of a row", name.text().escape_debug());
                let help = "names are of letters, digits, `_` and `-`, begin with a letter, and are none of `LEFT_END`, \
                            `RIGHT_END`, `Nall`, `Ehex20` and `Ewedge15`";
                table.push(name.error_here(Code::BAD_VALUE, message).help(help));
            }
            if let Some(message) = taken(&names, name.text()) {
                let help = "call it something else; rows of the same name share its sets";
                table.push(name.error_here(Code::BAD_VALUE, message).help(help));
            }
            names.insert(name.text().to_owned());
        }
        let z = draft.get("z").unwrap_or(next);
        let length = draft.get("length").unwrap_or(0.0);
        next = z + length;
        let (Some(outer), Some(material)) = (outer, own) else { continue };
        let mut row = SectionRow {
            z: [z, next],
            outer,
            inner,
            material,
            name: name.map(|own| own.text().to_owned()),
        };
        if let Some(reach) = draft.get("mass_outer").filter(|_| table.errors() == before) {
            if 0.5 * reach < outer[0].max(outer[1]) {
                let message =
                    "`mass_outer` is smaller than the outer diameter, which has the stiffness"
                        .to_owned();
                let help = "give the diameter of the stiffness as `outer`, and the larger one of the mass as `mass_outer`";
                draft.refuse(table, "mass_outer", message, help);
            } else if !turns {
                let message = "`mass_outer` is of a body that turns".to_owned();
                let help = "give the part beside the stiffness a row of its own, with a material of small stiffness";
                draft.refuse(table, "mass_outer", message, help);
            } else {
                let called = format!("beside row {}", k + 1);
                let place = Located::new(draft.place.source(), draft.place.span(), called);
                rings.extend(carry(&mut row, 0.5 * reach, &place));
            }
        }
        rows.push(row);
    }
    (table.errors() == before).then_some((rows, rings))
}

/// Gives the cells of a row mass of what is around them up to a radius (m), as far as one density can, and returns what they
/// lack then: polar inertia, and along a cone mass, too, as rings that have its centre and its inertia.
fn carry(row: &mut SectionRow, reach: f64, place: &Located) -> Vec<RowRing> {
    let Some(density) = row.material.properties.get("rho").copied() else { return Vec::new() };
    let [from, to] = row.z;
    let length = to - from;
    let radii = |z: f64| {
        let at = |[a, b]: [f64; 2]| a + (b - a) * (z - from) / length;
        [at(row.inner), at(row.outer)]
    };
    // r₂ⁿ − r₁ⁿ of all that there is to be, and of the cells.
    let both = |z: f64, n: i32| {
        let [inner, outer] = radii(z);
        [reach.powi(n) - inner.powi(n), outer.powi(n) - inner.powi(n)]
    };
    let count = (length / (2.0 * reach)).ceil().max(1.0) as usize;
    let ends: Vec<f64> = (0..=count).map(|k| from + length * k as f64 / count as f64).collect();
    // Where the cells take most of it, no more is added to them than there is elsewhere.
    let fine = (0..=16).map(|k| from + length * f64::from(k) / 16.0);
    let ratio = |z: f64| {
        let [all, cells] = both(z, 2);
        all / cells
    };
    let factor = fine.map(ratio).fold(f64::MAX, f64::min);
    // Of a ring dz, per density.
    let lacks = |z: f64, n: i32| {
        let [all, cells] = both(z, n);
        all - factor * cells
    };
    let whole = density * PI * reach.powi(2) * length;
    let rings = ends.windows(2).map(|ends| {
        let ring = Ring::new([ends[0], ends[1]], density, whole, lacks);
        RowRing { place: place.clone(), ring }
    });
    let rings = rings.collect();
    row.material.properties.insert("rho".to_owned(), density * factor);
    row.material.name = format!("{} × {}", row.material.name, whirl_text::rounded(factor, 4));
    rings
}

/// Why a row cannot have a name beside those of other rows, whose bores have sets, too.
fn taken(names: &BTreeSet<String>, name: &str) -> Option<String> {
    let bore = |of: &str| format!("{of}_BORE");
    let mut others = names.iter().filter(|other| *other != name);
    let other = others.find(|other| {
        other.eq_ignore_ascii_case(name)
            || bore(other).eq_ignore_ascii_case(name)
            || bore(name).eq_ignore_ascii_case(other)
    })?;
    Some(match other.eq_ignore_ascii_case(name) {
        true => format!("`{name}` differs from the row `{other}` only by capitals"),
        false => format!("`{name}` and the row `{other}`: one would be the bore of the other"),
    })
}

/// Whether sets can be called so.
fn named_well(name: &str) -> bool {
    let own = ["LEFT_END", "RIGHT_END", "Nall", "Ehex20", "Ewedge15"];
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-')
        && !own.iter().any(|own| own.eq_ignore_ascii_case(name))
}
