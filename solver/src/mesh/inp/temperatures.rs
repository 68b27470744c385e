//! Properties that depend on temperature: the values that a machine at rest in a room has.

use super::super::raw::MeshReport;
use super::cards::{Card, Token};
use super::values::number;

/// A room in °C and in K.
const ROOM: [f64; 2] = [20.0, 293.15];
/// A table that begins so high or higher, and not above a room, is in K.
const COLDEST_IN_KELVIN: f64 = 200.0;

/// Values of several lines at the temperature of a room, if that lies within the table, and else at the nearest end, as
/// Abaqus keeps values constant beyond a table. The temperature is the column behind the values. `None` where lines have none, or
/// after an error.
pub(super) fn at_room(
    card: &Card,
    titles: &[&str],
    report: &mut MeshReport,
) -> Option<(Vec<f64>, f64, [f64; 2])> {
    let columns = titles.len();
    let has_temperature =
        |line: &Vec<Token>| line.get(columns).is_some_and(|own| !own.text.is_empty());
    if !card.lines.iter().all(has_temperature) {
        return None;
    }
    let mut rows: Vec<(f64, Vec<f64>)> = Vec::new();
    for line in &card.lines {
        let temperature = number(&line[columns], "a temperature", report)?;
        let values = line.iter().zip(titles).map(|(token, title)| number(token, title, report));
        rows.push((temperature, values.collect::<Option<_>>()?));
    }
    if let Some(k) = (1..rows.len()).find(|&k| rows[k].0 <= rows[k - 1].0) {
        let what = format!(
            "the temperatures of *{} do not increase: {} stands below {}",
            card.keyword,
            rows[k].0,
            rows[k - 1].0
        );
        report.error(card.lines[k][columns], what, "sort the lines by temperature, each one once");
        return None;
    }
    let range = [rows.first()?.0, rows.last()?.0];
    let kelvin = (COLDEST_IN_KELVIN..=ROOM[1]).contains(&range[0]);
    let wanted = ROOM[usize::from(kelvin)].clamp(range[0], range[1]);
    let above = rows.iter().position(|(own, _)| *own >= wanted)?;
    let (hot, values) = &rows[above];
    let Some((cold, below)) =
        above.checked_sub(1).map(|below| &rows[below]).filter(|_| *hot > wanted)
    else {
        return Some((values.clone(), wanted, range));
    };
    let part = (wanted - cold) / (hot - cold);
    let between = below.iter().zip(values).map(|(a, b)| a + part * (b - a));
    Some((between.collect(), wanted, range))
}
