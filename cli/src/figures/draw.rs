//! A figure as SVG and PNG; the only file that names the plotting crates.

use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

use kuva::backend::svg::SvgBackend;
use kuva::plot::{ColorMap, Heatmap, LegendEntry, LegendShape, LinePlot, LineStyle, ScatterPlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::figure::{Figure as Sheet, FigureLegendPosition};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb::Database};

use super::figure::{Cells, Cloud, Dot, Figure, Label, Line, Map, Panel, Stroke, Style};

/// Pixels of a panel in the SVG.
const PANEL: (f64, f64) = (460.0, 320.0);
/// Pixels of a panel with equal axes.
const SQUARE: (f64, f64) = (400.0, 420.0);
/// Sizes of a title, the usual one first, and pixels of a letter for one of them.
const TITLE: [u32; 2] = [17, 10];
const LETTER: f64 = 0.47;
/// Pixels beside the panels of a row.
const PADDING: f64 = 20.0;
/// Pixels of a PNG for one of the SVG.
const PNG_SCALE: f32 = 2.0;

/// The figure as SVG text.
pub(crate) fn svg(figure: &Figure) -> String {
    let columns = figure.columns.clamp(1, figure.panels.len().max(1));
    let rows = figure.panels.len().div_ceil(columns);
    let square = figure.panels.iter().any(|panel| panel.equal_axes);
    let (width, height) = if square { SQUARE } else { PANEL };
    // A long title is set in smaller letters than stand out at the sides.
    let sheet_width = columns as f64 * width + PADDING;
    let letters = figure.title.chars().count().max(1) as f64;
    let room = (sheet_width / (LETTER * letters)) as u32;
    let [usual, smallest] = TITLE;
    let plots: Vec<Vec<Plot>> = figure.panels.iter().map(plots).collect();
    let layouts = figure.panels.iter().zip(&plots).map(|(p, plots)| layout(p, plots)).collect();
    let mut sheet = Sheet::new(rows, columns)
        .with_title(figure.title.clone())
        .with_title_size(room.clamp(smallest, usual))
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(width, height);
    let legend = legend(figure);
    if legend.len() > 1 {
        sheet = sheet
            .with_shared_legend_position(FigureLegendPosition::BottomCenter)
            .with_shared_legend_entries(legend);
    }
    rounded(&SvgBackend::new().render_scene(&sheet.render()))
}

/// Lines with round joins, which all of them inherit: at the sharp turns of a dense line pointed ones stand out
/// far beyond its points, up to four times its width.
fn rounded(svg: &str) -> String {
    svg.replacen("<svg ", r#"<svg stroke-linejoin="round" "#, 1)
}

/// An SVG as PNG, with the font built into the program; `None` if the SVG has no area.
pub(crate) fn png(svg: &str) -> Option<Vec<u8>> {
    let options = Options { fontdb: fonts(), font_family: FONT.to_string(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).ok()?;
    let pixels = |length: f32| (length * PNG_SCALE).ceil() as u32;
    let mut pixmap = Pixmap::new(pixels(tree.size().width()), pixels(tree.size().height()))?;
    pixmap.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, Transform::from_scale(PNG_SCALE, PNG_SCALE), &mut pixmap.as_mut());
    pixmap.encode_png().ok()
}

const FONT: &str = "DejaVu Sans";

fn fonts() -> Arc<Database> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    let load = || {
        let mut fonts = Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        fonts.load_font_data(dejavu::sans::bold().to_vec());
        fonts.set_sans_serif_family(FONT);
        Arc::new(fonts)
    };
    FONTS.get_or_init(load).clone()
}

fn plots(panel: &Panel) -> Vec<Plot> {
    let map = panel.map.iter().map(|map| Plot::Heatmap(cells(map)));
    let lines = panel.lines.iter().map(|line| Plot::Line(curve(line)));
    let strokes = panel.strokes.iter().map(|own| {
        let Stroke { line, width } = own;
        Plot::Line(curve(line).with_stroke_width(*width))
    });
    let clouds = panel.clouds.iter().map(|cloud| Plot::Scatter(points(cloud)));
    let dots = panel.dots.iter().map(|dot| Plot::Scatter(mark(dot)));
    let labels = (!panel.labels.is_empty()).then(|| Plot::Scatter(words(&panel.labels)));
    map.chain(lines).chain(strokes).chain(clouds).chain(dots).chain(labels).collect()
}

/// Words at points that are not seen.
fn words(labels: &[Label]) -> ScatterPlot {
    ScatterPlot::new()
        .with_data(labels.iter().map(|own| own.at))
        .with_size(NO_SIZE)
        .with_marker_opacity(0.0)
        .with_labels(labels.iter().map(|own| own.text.clone()))
        .with_repel_labels()
}

fn cells(map: &Map) -> Heatmap {
    // A cell without a value is white.
    let colour = |share: f64| match share.is_nan() {
        true => "#ffffff".to_string(),
        false => ColorMap::Viridis.map(share),
    };
    let mut cells = Heatmap::new()
        .with_data(map.values.iter().map(|row| row.iter().copied()))
        .with_color_map(ColorMap::Custom(Arc::new(colour)));
    cells.cell_size = 1.0;
    cells.x_range = ends(&map.x, map.values.first().map_or(0, Vec::len));
    cells.y_range = ends(&map.y, map.values.len());
    cells
}

/// Outer edges of so many cells that are evenly spaced.
fn ends(cells: &Cells, count: usize) -> Option<(f64, f64)> {
    let Cells::Even([first, last]) = cells else { return None };
    let half = 0.5 * (last - first) / (count.max(2) - 1) as f64;
    Some((first - half, last + half))
}

fn points(cloud: &Cloud) -> ScatterPlot {
    ScatterPlot::new()
        .with_data(cloud.points.iter().copied())
        .with_color(stroke(cloud.style).0)
        .with_size(cloud.radius)
}

fn curve(line: &Line) -> LinePlot {
    let (colour, width, dash) = stroke(line.style);
    LinePlot::new()
        .with_data(line.points.iter().copied())
        .with_color(colour)
        .with_stroke_width(width)
        .with_line_style(dash)
}

fn mark(dot: &Dot) -> ScatterPlot {
    ScatterPlot::new().with_data([dot.at]).with_color(DOT).with_size(3.5)
}

const DOT: &str = "#d62728";
const MARK: &str = "#707070";
/// Of a point at which words stand, from which they keep off as from a dot.
const NO_SIZE: f64 = 3.5;
/// Of bodies that are told apart; after the last one they begin again.
const BODIES: [&str; 6] = ["#222222", "#2a7f3f", "#8a3ea8", "#7a5230", "#0b8a8f", "#b03a6a"];

fn stroke(style: Style) -> (String, f64, LineStyle) {
    let (colour, width, dash) = match style {
        Style::Body(number) => {
            let colour = BODIES[usize::from(number) % BODIES.len()];
            return (colour.to_string(), 2.0, LineStyle::Solid);
        }
        Style::Shade(value) => {
            let colour = ColorMap::Viridis.map(f64::from(value) / f64::from(u8::MAX));
            return (colour, 1.6, LineStyle::Solid);
        }
        Style::First => ("#1f4e9c", 1.6, LineStyle::Solid),
        Style::Second => ("#d9730d", 1.6, LineStyle::Custom("6 3".to_string())),
        Style::Third => ("#2a7f3f", 1.6, LineStyle::Custom("3 2".to_string())),
        Style::Fourth => ("#8a3ea8", 1.6, LineStyle::Custom("7 2 2 2".to_string())),
        Style::Thin => ("#1f4e9c", 0.8, LineStyle::Solid),
        Style::Limit => ("#707070", 1.0, LineStyle::Custom("2 3".to_string())),
        Style::Doubted => (DOT, 1.0, LineStyle::Solid),
    };
    (colour.to_string(), width, dash)
}

fn layout(panel: &Panel, plots: &[Plot]) -> Layout {
    let layout = Layout::auto_from_plots(plots)
        .with_title(panel.title.clone())
        .with_title_size(14)
        .with_x_label(panel.x.clone())
        .with_y_label(panel.y.clone())
        .with_label_size(13)
        .with_tick_size(11)
        .with_body_size(10)
        .with_font_family(FONT)
        .with_ticks(6);
    let layout = panel.marks.iter().fold(layout, |layout, mark| {
        layout.with_reference_line(
            ReferenceLine::vertical(mark.x).with_color(MARK).with_label(mark.name.clone()),
        )
    });
    let layout = panel.levels.iter().fold(layout, |layout, level| {
        layout.with_reference_line(
            ReferenceLine::horizontal(level.x).with_color(MARK).with_label(level.name.clone()),
        )
    });
    if let Some([x, y]) = panel.view {
        let mut layout = layout
            .with_x_axis_min(x.0)
            .with_x_axis_max(x.1)
            .with_y_axis_min(y.0)
            .with_y_axis_max(y.1)
            .with_show_grid(false);
        layout.suppress_y_ticks = true;
        return layout;
    }
    if let Some(map) = &panel.map {
        return over_cells(layout, map);
    }
    if !panel.x_names.is_empty() {
        return layout.with_x_categories(panel.x_names.clone());
    }
    let layout = if panel.x_log { layout.with_log_x() } else { layout };
    if panel.equal_axes {
        return layout.with_equal_aspect();
    }
    if let Some((end, step)) = panel.x_scale {
        return layout.with_x_axis_min(0.0).with_x_axis_max(end).with_x_tick_step(step);
    }
    if panel.is_loose {
        return layout;
    }
    let lines = panel.lines.iter().chain(panel.strokes.iter().map(|own| &own.line));
    let abscissae = lines.flat_map(|line| &line.points).map(|point| point.0);
    let (first, last) = abscissae
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (x.min(least), x.max(most)));
    // A first step a little after zero is no reason to start there.
    let near_zero = first > 0.0 && first < 0.02 * last && !panel.x_log;
    let first = if near_zero { 0.0 } else { first };
    if first < last { layout.with_x_axis_min(first).with_x_axis_max(last) } else { layout }
}

/// Axes that end where the cells do.
fn over_cells(layout: Layout, map: &Map) -> Layout {
    let (columns, rows) = (map.values.first().map_or(0, Vec::len), map.values.len());
    let layout = match (&map.x, ends(&map.x, columns)) {
        (_, Some((first, last))) => layout.with_x_axis_min(first).with_x_axis_max(last),
        (Cells::Named(names), _) => layout.with_x_categories(names.clone()),
        _ => layout,
    };
    match (&map.y, ends(&map.y, rows)) {
        (_, Some((first, last))) => layout.with_y_axis_min(first).with_y_axis_max(last),
        (Cells::Named(names), _) => layout.with_y_categories(names.clone()),
        _ => layout,
    }
}

fn legend<'a>(figure: &'a Figure) -> Vec<LegendEntry> {
    let mut named = BTreeSet::new();
    let mut entries = Vec::new();
    let strokes = |panel: &'a Panel| panel.strokes.iter().map(|own| &own.line);
    let lines = figure.panels.iter().flat_map(|panel| panel.lines.iter().chain(strokes(panel)));
    for line in lines.filter(|own| !own.name.is_empty()) {
        if named.insert(line.name.as_str()) {
            let (colour, _, dash) = stroke(line.style);
            entries.push(LegendEntry {
                label: line.name.clone(),
                color: colour,
                shape: LegendShape::Line,
                dasharray: dash.dasharray(),
            });
        }
    }
    let clouds = figure.panels.iter().flat_map(|panel| &panel.clouds);
    for cloud in clouds.filter(|own| !own.name.is_empty()) {
        if named.insert(cloud.name.as_str()) {
            entries.push(LegendEntry {
                label: cloud.name.clone(),
                color: stroke(cloud.style).0,
                shape: LegendShape::Circle,
                dasharray: None,
            });
        }
    }
    for dot in figure.panels.iter().flat_map(|panel| &panel.dots) {
        if named.insert(dot.name.as_str()) {
            entries.push(LegendEntry {
                label: dot.name.clone(),
                color: DOT.to_string(),
                shape: LegendShape::Circle,
                dasharray: None,
            });
        }
    }
    entries
}
