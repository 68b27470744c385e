//! Histories of marches that are compared.

use std::error::Error;

/// All displacements of the text of a history, row after row.
///
/// # Errors
/// An empty history, and one without displacements or with what is no number.
pub fn displacements(text: &str) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut lines = text.lines();
    let names = lines.next().ok_or("an empty history")?.split(',');
    let is_own: Vec<bool> = names.map(|name| name.ends_with("um")).collect();
    let mut path = Vec::new();
    for line in lines {
        for (value, _) in line.split(',').zip(&is_own).filter(|(_, own)| **own) {
            path.push(value.parse()?);
        }
    }
    if path.is_empty() { Err("no displacements".into()) } else { Ok(path) }
}
