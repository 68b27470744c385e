//! A picture of the surface of a mesh: SVG, and PNG made from it.

mod depth;
mod surface;
mod view;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use whirl_solver::mesh::Mesh;
use whirl_text::rounded;

use self::depth::Depth;
use self::surface::{OuterFace, ShownSet};
use self::view::View;
use super::open::bounds;
use crate::errors::Failure;
use crate::picture_file;

/// Adds a line to a text.
macro_rules! line {
    ($text:expr, $($what:tt)*) => {
        writeln!($text, $($what)*).expect("text can be written")
    };
}

/// Points of the sheet.
const SHEET: [f64; 2] = [960.0, 600.0];
/// Left, top, width and height of the body on it, with a legend, and without one.
const BESIDE_LEGEND: [f64; 4] = [60.0, 70.0, 620.0, 450.0];
const ALONE: [f64; 4] = [60.0, 70.0, 840.0, 450.0];
/// Where the legend begins.
const LEGEND: [f64; 2] = [716.0, 84.0];
/// Sets in the legend; others are counted.
const SHOWN: usize = 20;
/// Faces that are polygons of the file; with more of them the picture is one of pixels.
const POLYGONS: usize = 50_000;
/// Pixels a point: to find what is hidden, and of a picture of pixels.
const FINE: f64 = 2.5;
const PIXELS: f64 = 2.0;
/// Brightnesses of a picture of pixels.
const LEVELS: f64 = 24.0;
/// The colour of faces of no set.
const PLAIN: [f64; 3] = [196.0, 202.0, 210.0];
/// Those of sets, one after the other.
const COLOURS: [[f64; 3]; 10] = [
    [66.0, 133.0, 214.0],
    [233.0, 134.0, 46.0],
    [74.0, 165.0, 84.0],
    [204.0, 74.0, 80.0],
    [151.0, 111.0, 196.0],
    [149.0, 109.0, 92.0],
    [222.0, 129.0, 186.0],
    [176.0, 176.0, 52.0],
    [62.0, 181.0, 190.0],
    [110.0, 120.0, 135.0],
];
/// Fonts as all figures have them.
const TEXT: &str = "font-family=\"DejaVu Sans, sans-serif\" fill=\"#202020\"";

/// Draws a mesh into a file, which ends in `.svg` or `.png`. `name`: what the title calls it.
///
/// # Errors
/// Another ending, a file that cannot be written.
pub(super) fn draw(mesh: &Mesh, name: &str, file: &Path) -> Result<(), Failure> {
    picture_file::write(svg(mesh, name), file)
}

fn svg(mesh: &Mesh, name: &str) -> String {
    let mut faces = surface::outer_faces(mesh);
    let sets = surface::colour(mesh, &mut faces);
    let place = if sets.is_empty() { ALONE } else { BESIDE_LEGEND };
    let view = View::of(faces.iter().flat_map(|face| &face.corners), place);
    let [width, height] = SHEET;
    let mut text = String::new();
    line!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         stroke-linejoin=\"round\">"
    );
    line!(text, "<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>");
    let title = format!("{name}: {} nodes, {} cells", mesh.nodes().len(), mesh.cell_count());
    line!(text, "<text x=\"24\" y=\"36\" font-size=\"17\" {TEXT}>{}</text>", escaped(&title));
    let depth = body(&mut text, &faces, &view);
    axis(&mut text, mesh, (&view, &depth));
    for (set, own) in sets.iter().enumerate() {
        points(&mut text, own, colour(Some(set), 1.0), (&view, &depth));
    }
    legend(&mut text, &sets);
    triad(&mut text, &view);
    bar(&mut text, view.scale);
    line!(text, "</svg>");
    text
}

/// The faces that are seen, the nearest last; what is in front.
fn body(text: &mut String, faces: &[OuterFace], view: &View) -> Depth {
    let shades: Vec<Option<f64>> = faces.iter().map(|face| view.shade(&face.corners)).collect();
    let many = shades.iter().flatten().count() > POLYGONS;
    let mut depth = Depth::new(SHEET, if many { PIXELS } else { FINE });
    let seen = |place: usize| -> Vec<[f64; 3]> {
        faces[place].corners.iter().map(|corner| view.seen(*corner)).collect()
    };
    let lit = |place: &usize| shades[*place].is_some();
    (0..faces.len()).filter(lit).for_each(|place| depth.put(place, &seen(place)));
    if many {
        let level = |place: usize| (shades[place].unwrap_or(0.0) * LEVELS).round();
        let set = |place: usize| faces[place].set.map_or(0, |set| set + 1);
        let key = |place: usize| set(place) * (LEVELS as usize + 1) + level(place) as usize;
        let mut paths: BTreeMap<usize, String> = BTreeMap::new();
        for ([x, y, long], own) in depth.stretches(key) {
            let y = y + 0.5 * depth.pixel_size();
            let path = paths.entry(own).or_default();
            write!(path, "M{} {}h{}", rounded(x, 5), rounded(y, 5), rounded(long, 5))
                .expect("text can be written");
        }
        let thick = 1.05 * depth.pixel_size();
        for (own, path) in paths {
            let (set, level) = (own / (LEVELS as usize + 1), own % (LEVELS as usize + 1));
            let fill = colour(set.checked_sub(1), level as f64 / LEVELS);
            line!(text, "<path d=\"{path}\" stroke=\"{fill}\" stroke-width=\"{thick:.3}\"/>");
        }
        return depth;
    }
    let front = depth.in_front(faces.len());
    let middle = |place: usize| {
        let seen = seen(place);
        let count = seen.len() as f64;
        [0, 1, 2].map(|k| seen.iter().map(|own| own[k]).sum::<f64>() / count)
    };
    // A face of less than a pixel may be nowhere the nearest, and still be seen.
    let shown = |place: &usize| front[*place] || depth.shows(middle(*place), 0.05);
    let mut order: Vec<(f64, usize)> =
        (0..faces.len()).filter(lit).filter(shown).map(|place| (middle(place)[2], place)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    line!(text, "<g stroke=\"#30363d\" stroke-opacity=\"0.55\" stroke-width=\"0.35\">");
    for (_, place) in order {
        let corners = seen(place);
        let corners: Vec<String> =
            corners.iter().map(|[x, y, _]| format!("{x:.2},{y:.2}")).collect();
        let fill = colour(faces[place].set, shades[place].unwrap_or(0.0));
        line!(text, "<polygon points=\"{}\" fill=\"{fill}\"/>", corners.join(" "));
    }
    line!(text, "</g>");
    depth
}

/// The axis along z, where it is outside the body.
fn axis(text: &mut String, mesh: &Mesh, (view, depth): (&View, &Depth)) {
    const PARTS: usize = 400;
    /// How far the axis reaches beyond the body, at least and at most, in points along it.
    const BEYOND: [usize; 2] = [45, 150];
    let Some([x, y]) = mesh.round_axis() else { return };
    let [low, high] = bounds(mesh.nodes().iter());
    // As far as it takes to come out from behind the body, where that is not very far.
    let end = |z: f64, away: f64, points: f64| z + away * points / view.scale;
    let visible = |z: f64, away: f64| {
        let mut reach =
            (BEYOND[0]..BEYOND[1]).step_by(10).map(|points| end(z, away, points as f64));
        let shows = |z: f64| depth.shows(view.seen([x, y, z]), 0.0);
        reach.find(|&own| shows(own) && shows(own - away * 25.0 / view.scale))
    };
    let from = visible(low[2], -1.0).unwrap_or_else(|| end(low[2], -1.0, BEYOND[0] as f64));
    let far = visible(high[2], 1.0);
    let to = far.unwrap_or(high[2]);
    let at = |part: usize| view.seen([x, y, from + (to - from) * part as f64 / PARTS as f64]);
    let mut path = String::new();
    let mut drawn = false;
    for part in 0..=PARTS {
        let seen = at(part);
        let shows = depth.shows(seen, 0.0);
        if shows {
            let letter = if drawn { 'L' } else { 'M' };
            write!(path, "{letter}{:.2} {:.2}", seen[0], seen[1]).expect("text can be written");
        }
        drawn = shows;
    }
    line!(
        text,
        "<path d=\"{path}\" fill=\"none\" stroke=\"#b02020\" stroke-width=\"1.1\" stroke-dasharray=\"9 3 2 3\"/>"
    );
    if far.is_none() {
        return;
    }
    let end = at(PARTS);
    line!(
        text,
        "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"13\" {TEXT}>z</text>",
        end[0] + 4.0,
        end[1] + 4.0
    );
}

/// Dots at the nodes of a set without faces that are seen.
fn points(text: &mut String, set: &ShownSet, fill: String, (view, depth): (&View, &Depth)) {
    for point in &set.points {
        let seen = view.seen(*point);
        if depth.shows(seen, 1.0) {
            line!(
                text,
                "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"2.6\" fill=\"{fill}\" stroke=\"white\" stroke-width=\"0.5\"/>",
                seen[0],
                seen[1]
            );
        }
    }
}

/// Names and counts of the sets.
fn legend(text: &mut String, sets: &[ShownSet]) {
    const LONGEST: usize = 24;
    let [left, top] = LEGEND;
    for (place, own) in sets.iter().take(SHOWN).enumerate() {
        let y = top + 22.0 * place as f64;
        let fill = colour(Some(place), 1.0);
        match own.points.is_empty() {
            true => line!(
                text,
                "<rect x=\"{left}\" y=\"{}\" width=\"13\" height=\"13\" fill=\"{fill}\"/>",
                y - 11.0
            ),
            false => line!(
                text,
                "<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{fill}\"/>",
                left + 6.5,
                y - 4.5
            ),
        }
        let mut name: String = own.name.chars().take(LONGEST).collect();
        if name.len() < own.name.len() {
            name.push('…');
        }
        let said = escaped(&format!("{name} ({})", own.count));
        line!(text, "<text x=\"{}\" y=\"{y}\" font-size=\"12\" {TEXT}>{said}</text>", left + 20.0);
    }
    if sets.len() > SHOWN {
        let y = top + 22.0 * SHOWN as f64;
        let said = format!("and {} more sets", sets.len() - SHOWN);
        line!(text, "<text x=\"{left}\" y=\"{y}\" font-size=\"12\" {TEXT}>{said}</text>");
    }
}

/// The directions of x, y and z.
fn triad(text: &mut String, view: &View) {
    const AT: [f64; 2] = [70.0, 545.0];
    const LONG: f64 = 34.0;
    for (name, own) in [("x", [1.0, 0.0, 0.0]), ("y", [0.0, 1.0, 0.0]), ("z", [0.0, 0.0, 1.0])] {
        let [right, down, _] = view.direction(own);
        let end = [AT[0] + LONG * right, AT[1] + LONG * down];
        let label = [AT[0] + (LONG + 10.0) * right - 4.0, AT[1] + (LONG + 10.0) * down + 4.0];
        line!(
            text,
            "<line x1=\"{}\" y1=\"{}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"#202020\" stroke-width=\"1.4\"/>",
            AT[0],
            AT[1],
            end[0],
            end[1]
        );
        line!(
            text,
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"12\" {TEXT}>{name}</text>",
            label[0],
            label[1]
        );
    }
}

/// A length to compare with.
fn bar(text: &mut String, scale: f64) {
    const LONGEST: f64 = 150.0;
    let most = LONGEST / scale;
    let power = 10f64.powi(most.log10().floor() as i32);
    let steps = [5.0, 2.0, 1.0].into_iter().find(|step| step * power <= most);
    let length = steps.unwrap_or(1.0) * power;
    if !length.is_finite() {
        return;
    }
    let (left, y) = (150.0, 570.0);
    let right = left + scale * length;
    line!(
        text,
        "<path d=\"M{left} {}v8m0 -4H{right:.1}m0 -4v8\" fill=\"none\" stroke=\"#202020\" stroke-width=\"1.4\"/>",
        y - 4.0
    );
    let said = rounded(1e3 * length, 6);
    line!(
        text,
        "<text x=\"{:.1}\" y=\"{}\" font-size=\"12\" {TEXT}>{said} mm</text>",
        right + 8.0,
        y + 4.0
    );
}

/// The colour of a set, or of no set, so bright.
fn colour(set: Option<usize>, bright: f64) -> String {
    let own = set.map_or(PLAIN, |set| COLOURS[set % COLOURS.len()]);
    let [r, g, b] = own.map(|part| (part * bright).round().clamp(0.0, 255.0) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Text as XML has it.
fn escaped(text: &str) -> String {
    let plain = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    plain.chars().filter(|c| !c.is_control()).collect()
}
