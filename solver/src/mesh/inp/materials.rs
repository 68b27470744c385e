//! Materials: linear elastic, isotropic, with a density.

use whirl_text::shown;

use super::super::raw::{MeshReport, RawMaterial, count};
use super::cards::{Card, Token};
use super::temperatures::at_room;
use super::values::{number, required};

pub(super) fn read_materials(cards: &[&Card], report: &mut MeshReport) -> Vec<RawMaterial> {
    let mut materials: Vec<RawMaterial> = Vec::new();
    let mut open = false;
    for card in cards {
        match card.keyword.as_str() {
            "MATERIAL" => {
                let name = required(card, "NAME", "*MATERIAL, NAME=STEEL", report);
                let name = name.map_or(String::new(), |name| name.text.to_owned());
                let same = |raw: &&RawMaterial| raw.name.eq_ignore_ascii_case(&name);
                let first = materials.iter().find(same);
                let broken = name.is_empty() || first.is_some();
                if let Some(first) = first {
                    let help =
                        format!("{} has the first", report.line(first.place, card.place.into()));
                    report.error(card.place, format!("material {name} is defined twice"), help);
                }
                open = true;
                let mut material = RawMaterial::new(name, card.place.into());
                material.broken = broken;
                materials.push(material);
            }
            "ELASTIC" | "DENSITY" => match materials.last_mut().filter(|_| open) {
                Some(material) => property(card, material, report),
                None => {
                    let what = format!("*{} belongs to no material", card.keyword);
                    report.error(card.place, what, "put *MATERIAL, NAME=… above it");
                }
            },
            "NODE" | "ELEMENT" | "NSET" | "ELSET" | "SURFACE" | "SOLID SECTION" => open = false,
            _ => {}
        }
    }
    materials
}

fn property(card: &Card, material: &mut RawMaterial, report: &mut MeshReport) {
    let before = report.error_count();
    let name = material.name.clone();
    let kind = card.parameter("TYPE").and_then(|parameter| parameter.value);
    let isotropic =
        |kind: &Token| ["ISO", "ISOTROPIC"].contains(&kind.text.to_uppercase().as_str());
    if let Some(kind) = kind.filter(|kind| !isotropic(kind)) {
        let what = format!("material {name} is {}: only isotropic materials are read", kind.text);
        material.unread.push((kind.into(), what, "write *ELASTIC and E, ν".to_owned()));
        return;
    }
    let wanted: &[(&'static str, &str)] = match card.keyword.as_str() {
        "ELASTIC" => &[("E", "Young's modulus"), ("nu", "Poisson's ratio")],
        _ => &[("rho", "density")],
    };
    if card.lines.len() > 1 {
        let titles: Vec<&str> = wanted.iter().map(|(_, title)| *title).collect();
        if let Some((values, temperature, range)) = at_room(card, &titles, report) {
            let own = wanted.iter().zip(&values);
            let shown: Vec<String> =
                own.clone().map(|((symbol, _), value)| said(symbol, *value)).collect();
            for (&(symbol, title), value) in own {
                material.set(symbol, title, *value, card.lines[0][0].into(), report);
            }
            let what = format!(
                "*{} of {name} depends on temperature: read is {} at a temperature of {temperature}, of {} from {} to {}",
                card.keyword,
                shown.join(", "),
                count(card.lines.len(), "line"),
                range[0],
                range[1]
            );
            let help = "if the machine runs at another temperature, keep the line of that temperature alone";
            material.remarks.push((card.place.into(), what, help.to_owned()));
        } else if report.error_count() == before {
            let what = format!("*{} has {}", card.keyword, count(card.lines.len(), "line"));
            let help = format!(
                "keep one line, or write the temperature of each behind its {}",
                titles.last().copied().unwrap_or_default()
            );
            material.unread.push((card.lines[1][0].into(), what, help));
        }
        material.broken |= report.error_count() > before;
        return;
    }
    let line: &[Token] = card.lines.first().map_or(&[], Vec::as_slice);
    // Behind the values of one line stands a temperature at most: more are the halves of decimal commas.
    if let Some(more) = line.get(wanted.len() + 1) {
        let what = format!("*{} of {name} has {} values on its line", card.keyword, line.len());
        let help = "write decimals with points, such as 0.3, and one line of values with their temperature at most";
        report.error(*more, what, help);
        material.broken = true;
        return;
    }
    for (place, &(symbol, title)) in wanted.iter().enumerate() {
        let Some(token) = line.get(place) else {
            let at = line.last().map_or(card.place, |token| *token);
            report.error(
                at,
                format!("*{} lacks the {title}", card.keyword),
                "write E, ν below *ELASTIC, and ρ below *DENSITY",
            );
            continue;
        };
        let Some(value) = number(token, title, report) else { continue };
        material.set(symbol, title, value, (*token).into(), report);
    }
    material.broken |= report.error_count() > before;
}

/// A value with its symbol, for people.
fn said(symbol: &str, value: f64) -> String {
    let symbol = match symbol {
        "nu" => "ν",
        "rho" => "ρ",
        other => other,
    };
    format!("{symbol} = {}", shown(value, 6, 1e-3..1e6))
}
