//! A journal and its bore: on one axis, in the same planes, one inside the other.

mod comparison;
mod planes;
mod rings;

use whirl_codegen::diagnostic::{Diagnostics, Located};
use whirl_solver::mesh::Mesh;

use self::comparison::Comparison;
use self::planes::Length;
use super::place::digits;
use super::sets::{Bore, Journal, rim_of};
use super::stations::{self, Extent};
use crate::case::Bearing;
use crate::machine::wording::mm;

/// To this part the radius of a generated shaft's section is known: see `mesh::shaft`.
const SECTION_DIGITS: f64 = 2e-4;

/// Notes whatever in a bearing, whose journal turns about an axis of its mesh (m), does not fit together; `bodies`: names of those of journal and bore, where the case names
/// bodies; `extent`: where its rings may stand.
pub(in crate::machine) fn compare(
    (place, bearing, axis): (usize, &Bearing, [f64; 2]),
    bodies: Option<[&str; 2]>,
    [shaft, support]: [Option<&Mesh>; 2],
    extent: Extent,
    errors: &mut Diagnostics,
) {
    let means = shaft.and_then(|mesh| Journal::means(mesh, &bearing.journal));
    let journal = shaft.and_then(|mesh| Journal::find(mesh, &bearing.journal));
    let bore = support.and_then(|mesh| Bore::find(mesh, &bearing.bore));
    let mut own = Comparison { place, whole: bearing, axis, bodies, errors };
    if let Some(mesh) = shaft {
        own.rims_on_axis(mesh);
    }
    if let Some(journal) = &journal {
        own.on_axis(journal);
    }
    if let Some(bore) = &bore {
        own.radii(bore, journal.as_ref());
    }
    // Of sets of several nodes only the order is known: they may stand anywhere around the axis.
    if let (None, Some(means)) = (&journal, &means)
        && !own.ordered("journal", means.sets, means.planes(), digits(means.mesh))
    {
        return;
    }
    let length = own.length(journal.as_ref(), bore.as_ref());
    if matches!(length, Length::Wrong) {
        return;
    }
    stations::check(bearing, extent, own.errors);
    if let (Length::Planes(ends), Some(bore)) = (length, &bore) {
        own.rings(bore, ends, journal.as_ref());
    }
}

/// Whether a set stands in the list before its place already.
fn is_repeated(sets: &[Located], place: usize) -> bool {
    sets[..place].iter().any(|other| other.text().eq_ignore_ascii_case(sets[place].text()))
}

impl Comparison<'_, '_> {
    /// The journal's nodes stand on the axis about which the shaft turns.
    fn on_axis(&mut self, journal: &Journal) {
        let allowed = self.off_axis(journal.mesh);
        for (place, (set, [x, y, _])) in journal.sets.iter().zip(journal.at).enumerate() {
            if is_repeated(journal.sets, place) || x.hypot(y) <= allowed {
                continue;
            }
            let what = format!("the journal's node `{}` is at", set.text());
            let help = "name a node on the centre line x = y = 0, or move the mesh so that its axis lies there";
            self.note(set, self.off(&what, [x, y]), help.to_string());
        }
    }

    /// What is at a place (m) off the axis, in words.
    fn off(&self, what: &str, [x, y]: [f64; 2]) -> String {
        format!(
            "{what} x = {}, y = {}: {} off the axis about which {} turns",
            mm(x),
            mm(y),
            mm(x.hypot(y)),
            self.shaft()
        )
    }

    /// The rims of sets that go all around stand about the axis.
    fn rims_on_axis(&mut self, mesh: &Mesh) {
        let sets = &self.whole.journal;
        for (place, set) in sets.iter().enumerate() {
            let rim = rim_of(mesh, set).filter(|_| !is_repeated(sets, place));
            let Some(circle) = rim else { continue };
            let [x, y] = circle.centre;
            if x.hypot(y) <= self.off_axis(mesh).max(circle.deviation) {
                continue;
            }
            let what = format!("the nodes of `{}` stand about", set.text());
            let help = match self.bodies {
                Some([name, _]) => format!(
                    "if the whole mesh stands there, write `axis = [\"{}\", \"{}\"]` in [body.{name}]; else name nodes about x = y = 0",
                    mm(x + self.axis[0]),
                    mm(y + self.axis[1])
                ),
                None => "name nodes about x = y = 0, or move the mesh so that its axis lies there"
                    .to_owned(),
            };
            self.note(set, self.off(&what, [x, y]), help);
        }
    }

    /// A journal fits into its bore, and leaves the clearance.
    fn radii(&mut self, bore: &Bore, journal: Option<&Journal>) {
        let [mean, largest] = bore.radii();
        let c = self.whole.radial_clearance;
        if !(c < mean) {
            let message = format!(
                "`radial_clearance` of {} leaves no journal in a bore whose radius is {}",
                mm(c),
                mm(mean)
            );
            let help = "write the gap between journal and bore, such as \"35 um\"";
            self.note(&self.place_of("radial_clearance"), message, help.to_string());
        }
        let digits = digits(bore.mesh);
        if let Some(radius) = self.whole.journal_radius.filter(|radius| *radius > largest + digits)
        {
            let message = format!(
                "`journal_radius` of {} is larger than that of the bore, {}",
                mm(radius),
                mm(largest)
            );
            let help = format!("write {} or less, or leave it out", mm(mean - c));
            self.note(&self.place_of("journal_radius"), message, help);
        }
        let Some(shaft) = journal.and_then(Journal::radius) else { return };
        if shaft * (1.0 - SECTION_DIGITS) > largest + digits {
            let names = [bore.sets, journal.map_or(&[], |own| own.sets)];
            let [bore_name, journal_name] = names.map(|sets| sets[1].text().to_string());
            let message = format!(
                "the bore at `{bore_name}` has a radius of {}, {} at `{journal_name}` one of {}: {} more",
                mm(largest),
                self.shaft(),
                mm(shaft),
                mm(shaft - largest)
            );
            let help = format!(
                "name the bore of this journal, or make it larger than {} by the clearance",
                self.shaft()
            );
            self.note(&bore.sets[0], message, help);
        } else if shaft * (1.0 - SECTION_DIGITS) + 0.5 * c > largest + digits {
            let message = format!(
                "`radial_clearance` of {} is more than twice what a shaft whose radius is {} leaves in a bore whose \
                 radius is {}",
                mm(c),
                mm(shaft),
                mm(largest)
            );
            let help = "write the gap between journal and bore, such as \"35 um\"";
            self.note(&self.place_of("radial_clearance"), message, help.to_string());
        }
    }
}
