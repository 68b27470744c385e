//! Where cylinders of a shaft run in bores of its support.

use whirl_solver::mesh::{Cylinder, Mesh};

use crate::mesh_file::{mm, named};

/// A bore is larger than its journal by at most this part of the journal's radius: more than bearings with a film, less than
/// a hole through which a shaft only passes.
const LARGEST_GAP: f64 = 0.03;
/// Journal and bore share at least this part of the shorter one.
const SHARED: f64 = 0.2;

/// A journal in a bore.
pub(super) struct Meeting {
    /// What the sets are called.
    pub(super) names: [String; 2],
    pub(super) journal: Cylinder,
    pub(super) bore: Cylinder,
}

impl Meeting {
    /// Where they are around each other (m).
    pub(super) fn z(&self) -> [f64; 2] {
        shared(&self.journal, &self.bore)
    }
}

/// From where to where both are.
fn shared(a: &Cylinder, b: &Cylinder) -> [f64; 2] {
    [a.z[0].max(b.z[0]), a.z[1].min(b.z[1])]
}

/// The bearings from small to large z, and what keeps journals out of the other bores.
pub(super) fn find([shaft, support]: [&Mesh; 2], axis: [f64; 2]) -> (Vec<Meeting>, Vec<String>) {
    let (journals, bores) = (shaft.cylinders(axis), support.cylinders(axis));
    let outside: Vec<_> = named(&journals).filter(|(_, own)| !own.hollow).collect();
    let (mut meetings, mut left) = (Vec::new(), Vec::new());
    for (name, bore) in named(&bores).filter(|(_, own)| own.hollow) {
        let length = |own: &Cylinder| own.z[1] - own.z[0];
        let around = outside.iter().filter(|(_, journal)| {
            let [from, to] = shared(journal, bore);
            to - from >= SHARED * length(journal).min(length(bore)) && to > from
        });
        let nearest = around.min_by(|(_, a), (_, b)| {
            let apart = |own: &Cylinder| {
                let gap = bore.radius - own.radius;
                // A journal that does not fit is further than any that does.
                if gap > 0.0 { gap } else { f64::MAX - 1.0 / gap.abs().max(1e-300) }
            };
            apart(a).total_cmp(&apart(b))
        });
        let radius = mm(bore.radius);
        let Some((journal_name, journal)) = nearest else {
            left.push(format!("no journal is in {name} (radius {radius} mm)"));
            continue;
        };
        let gap = bore.radius - journal.radius;
        let both =
            format!("{journal_name} (radius {} mm) in {name} ({radius} mm)", mm(journal.radius));
        if gap <= 0.0 {
            left.push(format!("{both} is not the smaller one"));
        } else if gap > LARGEST_GAP * journal.radius {
            left.push(format!("{both} leaves {} mm, which is much for a bearing", mm(gap)));
        } else {
            let names = [journal_name.clone(), name];
            meetings.push(Meeting { names, journal: **journal, bore: *bore });
        }
    }
    (meetings, left)
}
