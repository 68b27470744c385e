//! The figures of docs/validation.md: series of numbers on the page, theirs as circles, ours as lines.
//!
//! A figure is drawn from the tables of the page alone, which their tests hold against what is computed. Here the files are held
//! against the tables; with WHIRL_RENEW_GOLDEN=1 they are written anew.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use kuva::backend::svg::SvgBackend;
use kuva::plot::{LegendEntry, LegendShape, LinePlot, MarkerShape, ScatterPlot};
use kuva::render::figure::{Figure as Sheet, FigureLegendPosition};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

/// A figure of a page.
struct Figure {
    /// Of the file, without its ending.
    name: &'static str,
    title: &'static str,
    x: &'static str,
    y: &'static str,
    /// Section and row of its points, with a bar between them; `{x}`: the abscissa, `{s}`: to which series it belongs, `{}`:
    /// anything.
    pattern: &'static str,
    scale: Scale,
}

/// Its name, and its points: x, theirs, ours.
type Series = (String, Vec<[f64; 3]>);

#[derive(Clone, Copy, PartialEq)]
enum Scale {
    Linear,
    LogY,
    Log,
}

const FIGURES: [Figure; 14] = [
    figure("ross-example", ["A rotor of ROSS, meshed", "speed (rad/s)", "natural frequency (Hz)"])
        .of("Modes: ross example, solid|{s} at {x} rad/s (Hz)", Scale::Linear),
    figure("ross-example-table", ["The same rotor, from a table of sections", "speed (rad/s)", "natural frequency (Hz)"])
        .of("Modes: ross example, from a table of sections|{s} at {x} rad/s (Hz)", Scale::Linear),
    figure("lalanne-ferraris", ["A rotor of Lalanne and Ferraris", "speed (rpm)", "natural frequency (Hz)"])
        .of("Modes: lalanne-ferraris, solid|{s} at {x} rpm (Hz)", Scale::Linear),
    figure("lalanne-ferraris-damping", ["A rotor of Lalanne and Ferraris", "speed (rpm)", "damping ratio"])
        .of("Modes: lalanne-ferraris, solid|damping ratio of {s} at {x} rpm", Scale::Linear),
    figure("coaxial", ["Two coaxial rotors at one speed", "speed (rad/s)", "natural frequency (Hz)"])
        .of("Modes: ross coaxial, solid|{s}, both at {x} rad/s (Hz)", Scale::Linear),
    figure("damped-bearings", ["A rotor of ROSS in damped bearings", "speed (rad/s)", "damping ratio"])
        .of("Modes: ross damped bearings, solid|damping ratio of {s} at {x} rad/s", Scale::Linear),
    figure("films-damping", ["A rotor in oil films", "speed (rpm)", "damping ratio"])
        .of("Modes: jeffcott in films, steel shaft, solid|damping ratio of {s} at {x} rpm", Scale::Linear),
    figure("short-film-stiffness", ["Stiffness of a short film", "eccentricity", "|K| c/W"])
        .of("Coefficients of a short film at eccentricity {x}|K c/W {s}", Scale::LogY),
    figure("short-film-damping", ["Damping of a short film", "eccentricity", "|C| c ω/W"])
        .of("Coefficients of a short film at eccentricity {x}|C c omega/W {s}", Scale::LogY),
    figure("short-film-whirl", ["A rigid rotor in a short film, at its threshold", "eccentricity", "whirl over speed"])
        .of("A rigid rotor in a short film at its threshold|ε {x}: whirl ratio at the {s} of a rigid rotor", Scale::Linear),
    figure("short-film-threshold", ["A rigid rotor in a short film, at its threshold", "eccentricity", "m ω² c/W"])
        .of("A rigid rotor in a short film at its threshold|ε {x}: m omega^2 c/W at the {s}", Scale::Linear),
    figure("journal-bearings", ["Journal bearings, Reynolds' equation", "Sommerfeld number S", "eccentricity"])
        .of("Journal bearings fed at their widest gap, from case files, on 72 × 7 nodes|{s}, S {x}: ε", Scale::Log),
    figure("jeffcott-peak", ["Resonance of a Jeffcott rotor", "damping ratio", "height of the peak (µm)"])
        .of("Peaks of a Jeffcott rotor|ζ = {x}: {s} (µm)", Scale::Log),
    figure("restitution", ["Impact by Hunt and Crossley's law", "speed before (m/s)", "speed after over before"])
        .of("Restitution of Hunt and Crossley's law|{s} over {x} m/s before", Scale::Linear),
];

const fn figure(name: &'static str, [title, x, y]: [&'static str; 3]) -> Figure {
    Figure { name, title, x, y, pattern: "", scale: Scale::Linear }
}

impl Figure {
    const fn of(self, pattern: &'static str, scale: Scale) -> Figure {
        Figure { pattern, scale, ..self }
    }

    /// Every series as it comes, its points by x.
    fn series(&self, page: &str) -> Vec<Series> {
        let mut all: Vec<Series> = Vec::new();
        for section in page.split("\n## ").skip(1) {
            let title = section.lines().next().unwrap_or_default();
            for line in section.lines().filter(|line| line.starts_with("| ")) {
                let cells: Vec<&str> = line.split('|').map(str::trim).collect();
                let Some((x, series)) = matched(self.pattern, &format!("{title}|{}", cells[1]))
                else {
                    continue;
                };
                let number = |cell: &str| cell.parse::<f64>().expect("a number");
                let size = |value: f64| if self.scale == Scale::LogY { value.abs() } else { value };
                let values = [x, size(number(cells[2])), size(number(cells[3]))];
                match all.iter_mut().find(|own| own.0 == series) {
                    Some(own) => own.1.push(values),
                    None => all.push((series, vec![values])),
                }
            }
        }
        all.iter_mut().for_each(|own| own.1.sort_by(|a, b| a[0].total_cmp(&b[0])));
        all
    }

    fn svg(&self, page: &str) -> String {
        let series = self.series(page);
        let mut plots = Vec::new();
        for (place, (_, points)) in series.iter().enumerate() {
            let colour = COLOURS[place % COLOURS.len()];
            let line = points.iter().map(|own| (own[0], own[2]));
            plots.push(Plot::Line(
                LinePlot::new().with_data(line).with_color(colour).with_stroke_width(1.6),
            ));
            let theirs = points.iter().map(|own| (own[0], own[1]));
            plots.push(Plot::Scatter(
                ScatterPlot::new()
                    .with_data(theirs)
                    .with_color(colour)
                    .with_marker(MarkerShape::Circle)
                    .with_marker_opacity(0.0)
                    .with_marker_stroke_width(1.4)
                    .with_size(4.5),
            ));
        }
        let layout = Layout::auto_from_plots(&plots)
            .with_title(self.title)
            .with_title_size(14)
            .with_x_label(self.x)
            .with_y_label(self.y)
            .with_label_size(13)
            .with_tick_size(11)
            .with_font_family("DejaVu Sans")
            .with_ticks(6);
        let layout = match self.scale {
            Scale::Linear => layout,
            Scale::LogY => layout.with_log_y(),
            Scale::Log => layout.with_log_x().with_log_y(),
        };
        let entry = |label: String, color: &str, shape: LegendShape| LegendEntry {
            label,
            color: color.to_owned(),
            shape,
            dasharray: None,
        };
        let mut legend = vec![
            entry("theirs".to_owned(), "#222222", LegendShape::CircleSize(4.5)),
            entry("whirl".to_owned(), "#222222", LegendShape::Line),
        ];
        if series.len() > 1 {
            let named = series.iter().enumerate();
            legend.extend(named.map(|(place, (name, _))| {
                entry(name.clone(), COLOURS[place % COLOURS.len()], LegendShape::Rect)
            }));
        }
        let sheet = Sheet::new(1, 1)
            .with_plots(vec![plots])
            .with_layouts(vec![layout])
            .with_cell_size(460.0, 320.0)
            .with_shared_legend_position(FigureLegendPosition::RightMiddle)
            .with_shared_legend_entries(legend);
        SvgBackend::new().render_scene(&sheet.render())
    }
}

const COLOURS: [&str; 8] =
    ["#1f4e9c", "#d9730d", "#2a7f3f", "#8a3ea8", "#7a5230", "#0b8a8f", "#b03a6a", "#707070"];

/// The abscissa and the series of a row that a pattern fits.
fn matched(pattern: &str, text: &str) -> Option<(f64, String)> {
    let (mut x, mut series, mut rest) = (None, None, text);
    let mut pieces = pattern.split('{');
    rest = rest.strip_prefix(pieces.next()?)?;
    for piece in pieces {
        let (name, literal) = piece.split_once('}').expect("a closed brace");
        let end = if literal.is_empty() { rest.len() } else { rest.find(literal)? };
        let found = &rest[..end];
        rest = &rest[end + literal.len()..];
        match name {
            "x" => x = Some(found.parse::<f64>().ok()?),
            "s" => series = Some(found.to_owned()),
            _ => {}
        }
    }
    rest.is_empty().then_some((x?, series?))
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")
}

#[test]
fn figures_are_those_of_the_tables() {
    let page = fs::read_to_string(folder().join("validation.md")).expect("the page");
    let renew = env::var_os("WHIRL_RENEW_GOLDEN").is_some();
    for figure in &FIGURES {
        // Each series has its points at the same places, so that none is lost unseen.
        let series = figure.series(&page);
        let counts: Vec<usize> = series.iter().map(|own| own.1.len()).collect();
        let points: usize = counts.iter().sum();
        assert!(
            points >= 4 && counts.iter().all(|own| *own == counts[0]),
            "{}: {counts:?}",
            figure.name
        );
        let name = format!("validation/{}.svg", figure.name);
        assert!(page.contains(&format!("]({name})")), "docs/validation.md does not show {name}");
        let (path, drawn) = (folder().join(&name), figure.svg(&page));
        if renew {
            fs::write(&path, drawn).expect("the figure can be written");
        } else {
            let file = fs::read_to_string(&path).unwrap_or_default();
            assert!(
                file == drawn,
                "{name} is not drawn from docs/validation.md: run the test with WHIRL_RENEW_GOLDEN=1"
            );
        }
    }
}

#[test]
fn patterns_find_abscissa_and_series() {
    let found = matched("A {x} of|mode {s} at {}", "A 0.5 of|mode 3 at 2 rpm");
    assert_eq!(found, Some((0.5, "3".to_owned())));
    assert_eq!(matched("A {x}|mode {s} (Hz)", "A b|mode 3 (Hz)"), None);
    assert_eq!(matched("A {x}|mode {s} (Hz)", "A 1|mode 3 (Hz), more"), None);
}
