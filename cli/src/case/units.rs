//! Units of mesh files.

use whirl_codegen::units::{Dimension, Unit};
use whirl_solver::mesh::format::MeshUnits;

/// Units of mesh files only, with what they measure and their values in SI units.
const IMPERIAL: [(&str, &str, f64); 4] = [
    ("in", "length", 0.0254),
    ("lbf", "force", 4.448_221_615_260_5),
    ("lb", "mass", 0.453_592_37),
    ("lbf*s^2/in", "mass", 4.448_221_615_260_5 / 0.0254),
];

const HELP: &str = "write the units of length, force and mass, such as \"mm, N, t\", \"m, N, kg\" or \
                    \"in, lbf, lbf*s^2/in\"";

/// The units that a text lists.
///
/// # Errors
/// What is wrong, and what to write.
pub(crate) fn mesh_units(text: &str) -> Result<MeshUnits, (String, String)> {
    let words: Vec<&str> = text.split(',').map(str::trim).collect();
    if words.len() != 3 {
        return Err((format!("`{text}` are {} units, not three", words.len()), HELP.to_owned()));
    }
    let wanted =
        [("length", Dimension::LENGTH), ("force", Dimension::FORCE), ("mass", Dimension::MASS)];
    let mut factors = [1.0; 3];
    for ((word, (title, dimension)), factor) in words.into_iter().zip(wanted).zip(&mut factors) {
        let imperial = IMPERIAL.iter().find(|(name, of, _)| *name == word && *of == title);
        match Unit::parse(word) {
            _ if imperial.is_some() => *factor = imperial.map_or(1.0, |(_, _, factor)| *factor),
            Ok(unit) if *unit.dimension() == dimension => *factor = unit.to_si(1.0),
            Ok(_) => return Err((format!("`{word}` is no unit of {title}"), HELP.to_owned())),
            Err(error) => {
                let message = format!("`{word}` is no unit of {title}: {}", error.message);
                return Err((message, error.help.unwrap_or_else(|| HELP.to_owned())));
            }
        }
    }
    let [length, force, mass] = factors;
    Ok(MeshUnits { length, force, mass })
}
