//! Discs of little mass that join rows where a wide bore follows a thinner shaft: beams are joined by their node alone.

use super::draft::Row;
use super::model::Material;
use super::notes::Notes;

/// The density of what joins two rows, as a part of that of the wide one: as little as a solid may have.
const LIGHT: f64 = 0.01;
/// z nearer than this part of a row are the same, and shorter pieces than this part are none.
const SAME: f64 = 1e-6;
const SLIVER: f64 = 0.05;

/// Adds such discs to the rows of a shaft, of which `materials` are.
pub(super) fn join(
    rows: &mut Vec<Row>,
    materials: &mut Vec<(String, Material)>,
    notes: &mut Notes,
) {
    let mut all = rows.clone();
    let mut planes: Vec<f64> = rows.iter().map(|own| own.z).collect();
    planes.sort_by(f64::total_cmp);
    for z in planes {
        let near = |a: f64, own: &Row| (a - z).abs() <= SAME * own.length;
        let left: Vec<&Row> = rows.iter().filter(|own| near(own.z + own.length, own)).collect();
        let right: Vec<&Row> = rows.iter().filter(|own| near(own.z, own)).collect();
        // What reaches beyond this z on both sides joins them.
        let through = rows
            .iter()
            .any(|own| own.z < z - SAME * own.length && own.z + own.length > z + SAME * own.length);
        let meets = |a: &Row, b: &Row| {
            a.outer[1].min(b.outer[0]) > a.inner[1].max(b.inner[0]) * (1.0 + SAME)
        };
        let apart = !left.iter().any(|a| right.iter().any(|b| meets(a, b)));
        if left.is_empty() || right.is_empty() || through || !apart {
            continue;
        }
        let widest =
            |own: &[&Row], end: usize| own.iter().map(|row| row.outer[end]).fold(0.0, f64::max);
        let bore = |own: &[&Row], end: usize| {
            own.iter().map(|row| row.inner[end]).fold(f64::MAX, f64::min)
        };
        // The side with the bore in which the other one would vanish.
        let of_left = bore(&left, 1) >= widest(&right, 0);
        let (end, thin) = if of_left { (1, widest(&right, 0)) } else { (0, widest(&left, 1)) };
        let wide = if of_left { &left } else { &right };
        let Some(ring) = wide.iter().copied().min_by(|a, b| a.inner[end].total_cmp(&b.inner[end]))
        else {
            continue;
        };
        let mut length = (0.5 * (ring.inner[end] - thin)).max(0.25 * thin).min(ring.length);
        if ring.length - length < SLIVER * ring.length {
            length = ring.length;
        }
        let far = ring.inner[end] + (ring.inner[1 - end] - ring.inner[end]) * length / ring.length;
        let outer = if of_left { [far, ring.inner[1]] } else { [ring.inner[0], far] };
        let material = like(&materials[ring.material].clone(), materials);
        let start = if of_left { ring.z + ring.length - length } else { ring.z };
        let elements = [format!("joins {} with what follows", ring.elements[end]), String::new()];
        notes.add(format!(
            "differs: at z = {} mm a bore of {} mm and a shaft of {} mm do not touch; a disc of {} mm and a hundredth of the density joins them, where \
             beams are joined by their node",
            whirl_text::rounded(1e3 * z, 6),
            whirl_text::rounded(1e3 * ring.inner[end], 6),
            whirl_text::rounded(1e3 * thin, 6),
            whirl_text::rounded(1e3 * length, 6)
        ));
        all.push(Row {
            z: start,
            length,
            outer,
            inner: [0.0; 2],
            mass_outer: None,
            material,
            elements,
        });
    }
    *rows = all;
}

/// A material that is as stiff and has a hundredth of the mass.
fn like((name, own): &(String, Material), materials: &mut Vec<(String, Material)>) -> usize {
    let name = format!("{name}_light");
    if let Some(known) = materials.iter().position(|own| own.0 == name) {
        return known;
    }
    materials.push((name, Material { density: LIGHT * own.density, ..own.clone() }));
    materials.len() - 1
}
