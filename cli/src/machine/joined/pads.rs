//! Films that can hardly be meant: pads over each other, journals of two radii, gaps as wide as the journal.

use whirl_text::rounded;

use crate::case::{Joint, JointKind, LawSource};

/// Clearance over radius of a film that is far from thin.
const WIDE: f64 = 0.05;
/// Shares of radii, and of an arc, that are rounding.
const SAME: f64 = 1e-6;

/// A film that does not close.
struct Pad<'a> {
    joint: &'a Joint,
    /// Where it begins, how far it reaches (rad), its radius (m).
    arc: [f64; 3],
    /// From where to where along z (m).
    z: [f64; 2],
}

/// Warnings of all films. `placed`: clearance and planes along z (m) of a joint by its place.
pub(super) fn warnings(
    joints: &[Joint],
    laws: &[LawSource],
    placed: &dyn Fn(usize) -> (f64, Vec<f64>),
) -> Vec<String> {
    let mut all = Vec::new();
    let mut pads: Vec<Pad> = Vec::new();
    for (place, (joint, law)) in joints.iter().zip(laws).enumerate() {
        let Some(film) = law.film().filter(|_| joint.kind == JointKind::Bearing) else { continue };
        let (clearance, z) = placed(place);
        if let Some(radius) = joint.bearing.journal_radius.filter(|own| clearance > WIDE * own) {
            all.push(format!(
                "the clearance of `{}`, {} µm, is more than a twentieth of the radius of its journal, {} mm: films are thin, with clearances \
                 of about a thousandth of the radius; look at both",
                joint.name.text(),
                rounded(1e6 * clearance, 6),
                rounded(1e3 * radius, 6)
            ));
        }
        let Some([start, size, radius, length]) = film.pad() else { continue };
        let middle = z.iter().sum::<f64>() / z.len().max(1) as f64;
        let z = [middle - 0.5 * length, middle + 0.5 * length];
        let own = Pad { joint, arc: [start, size, radius], z };
        let beside = pads.iter().find_map(|other| told(other, &own));
        all.extend(beside);
        pads.push(own);
    }
    all
}

/// What cannot be of two pads on one journal.
fn told(a: &Pad, b: &Pad) -> Option<String> {
    let apart = a.z[0].max(b.z[0]) - a.z[1].min(b.z[1]) >= -SAME * (a.z[1] - a.z[0]);
    if a.joint.sides[0].body != b.joint.sides[0].body || apart {
        return None;
    }
    let [first, second] = [a, b].map(|own| own.joint.name.text());
    if (a.arc[2] - b.arc[2]).abs() > SAME * a.arc[2] {
        let [one, other] = [a, b].map(|own| rounded(1e3 * own.arc[2], 6));
        return Some(format!(
            "`{first}` and `{second}` run on the same part of one journal, but with radii of {one} and {other} mm: give both the \
             same `journal_radius`"
        ));
    }
    // How far one begins behind the beginning of the other.
    let behind = |from: &Pad, to: &Pad| (to.arc[0] - from.arc[0]).rem_euclid(std::f64::consts::TAU);
    let over = (a.arc[1] - behind(a, b)).max(b.arc[1] - behind(b, a));
    (over > SAME * a.arc[1]).then(|| {
        format!(
            "the pads of `{first}` and `{second}` are over each other by {}° on the same part of one journal: oil there counts twice; look at \
             their `arc`",
            rounded(over.to_degrees(), 4)
        )
    })
}
