//! Figures of a case: laws, reactions, eccentricity orbits, rotation.

mod draw;
mod figure;
mod histories;
mod laws;
mod orders;
mod over_speed;
mod spectra;
mod stack;

use std::any::Any;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;

use whirl_codegen::kinds::law::LawSpec;
use whirl_solver::output::Wanted;

use self::histories::Span;
use crate::case::{Case, NamedBody};
use crate::history::ReadHistory;
use crate::machine::Built;
use crate::output::Output;
use crate::report::{begun, films, oscillations};

/// Names of all figures that a run may draw, without their endings.
pub(crate) const NAMES: [&str; 11] = [
    "orders-over-speed",
    "envelope-over-speed",
    "laws",
    "reactions",
    "eccentricity",
    "eccentricity-stretched",
    "rotation",
    "displacement",
    "film",
    "spectrum",
    "waterfall",
];

pub(crate) use self::draw::{png, svg};
pub(crate) use self::figure::{
    Cells, Cloud, Dot, Figure, Label, Line, Map, Mark, Panel, Stroke, Style,
};
pub(crate) use self::laws::at_zero;
pub use self::laws::{Curve, curves};
pub(crate) use self::spectra::{Lines, Spectrum, last_spectra, lines};
pub(crate) use self::stack::{Stacked, stack};

/// Draws a law as `stem.svg` and `stem.png` into `output`.
pub(crate) fn draw_law(law: &LawSpec, stem: &str, output: &mut Output) {
    put(stem, &laws::law(law), output);
}

fn put(stem: &str, figure: &Figure, output: &mut Output) {
    for (name, content) in pictures(stem, figure) {
        output.put(&name, content);
    }
}

/// A figure as files: SVG, and PNG where it has an area.
fn pictures(stem: &str, figure: &Figure) -> Vec<(String, Vec<u8>)> {
    let svg = draw::svg(figure);
    let png = draw::png(&svg).map(|png| (format!("{stem}.png"), png));
    png.into_iter().chain([(format!("{stem}.svg"), svg.into_bytes())]).collect()
}

/// Draws the figures of a case as SVG and PNG, each written by `write`; why some are missing. `built`: the
/// machine that was run; what is not `sound` is marked. Nothing that happens to a figure keeps another one from being
/// drawn, but for `stop`.
pub(crate) fn draw(
    (case, sound): (&Case, bool),
    built: &Built,
    history: &dyn ReadHistory,
    write: &dyn Fn(&str, &[u8]) -> Result<(), String>,
    stop: &dyn Fn() -> bool,
) -> Vec<String> {
    let mut missing = Vec::new();
    for (stem, number) in wanted(case) {
        if stop() {
            missing.push("interrupted before all figures were drawn".to_string());
            return missing;
        }
        let made = || {
            let figure = figure(stem, case, built, history)?;
            let place = number.map_or(String::new(), |k| format!(" (Fig. {k} of the paper)"));
            let mark = if sound { "" } else { " [NOT SOUND: see the verdict]" };
            Ok(figure.map(|figure| {
                let title = format!("{}: {}{place}{mark}", case.name, figure.title);
                Figure { title, ..figure }
            }))
        };
        missing.extend(put_figure(stem, made, write));
    }
    missing
}

/// Draws a figure, if there is one, as SVG and PNG, each written by `write`; why it is missing.
pub(crate) fn put_figure(
    stem: &str,
    make: impl FnOnce() -> io::Result<Option<Figure>>,
    write: &dyn Fn(&str, &[u8]) -> Result<(), String>,
) -> Option<String> {
    let drawn = guarded(|| Ok(make()?.map_or(Vec::new(), |figure| pictures(stem, &figure))));
    match drawn {
        Err(reason) => Some(format!("the figure `{stem}` cannot be drawn: {reason}")),
        Ok(files) => files.iter().try_for_each(|(name, content)| write(name, content)).err(),
    }
}

/// What `draw` gives, or why it gives nothing: a plotting library may panic over values that no axis can show. What
/// it says then is the reason, since a panic may come from elsewhere, too.
fn guarded<T>(draw: impl FnOnce() -> io::Result<T>) -> Result<T, String> {
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let drawn = panic::catch_unwind(AssertUnwindSafe(draw));
    panic::set_hook(hook);
    match drawn {
        Ok(drawn) => drawn.map_err(|error| error.to_string()),
        Err(panic) => Err(format!("drawing it has failed: {}", message(&*panic))),
    }
}

/// What a panic says.
fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("without a message")
}

/// Names of the figures of a case, and their numbers in the paper.
fn wanted(case: &Case) -> Vec<(&'static str, Option<usize>)> {
    let named = &case.figures;
    let machine = &case.machine;
    // Of a run-up what goes over the speed comes first.
    let turns = machine.bodies.iter().any(NamedBody::turns);
    let mut wanted: Vec<(&str, Option<usize>)> = Vec::new();
    wanted.extend(
        ["orders-over-speed", "envelope-over-speed"]
            .into_iter()
            .filter(|_| turns)
            .map(|stem| (stem, None)),
    );
    wanted.extend([("laws", named.law), ("reactions", named.reactions)]);
    if machine.is_mass() {
        wanted.push(("displacement", None));
    } else {
        wanted.extend(
            ["eccentricity-stretched", "eccentricity"].map(|stem| (stem, named.eccentricity)),
        );
        let driven = machine.is_named() || machine.drives.iter().any(|own| own.couple.acts);
        wanted.extend((turns && driven).then_some(("rotation", named.rotation)));
    }
    let has_films = case.outputs.iter().any(|own| matches!(own.what, Wanted::Film { .. }));
    wanted.extend(has_films.then_some(("film", None)));
    wanted.extend(["spectrum", "waterfall"].map(|stem| (stem, None)));
    wanted
}

/// A figure by its name; none where it would show nothing, or no more than another one: a history has columns of
/// supports only.
fn figure(
    stem: &str,
    case: &Case,
    built: &Built,
    history: &dyn ReadHistory,
) -> io::Result<Option<Figure>> {
    if matches!(stem, "spectrum" | "waterfall" | "orders-over-speed" | "envelope-over-speed") {
        let all = oscillations(case, &built.machine);
        let step = case.march().time_step * case.march().output_every as f64;
        return match stem {
            "spectrum" => spectra::spectrum(history, &all, (step, case.march().cycle)),
            "orders-over-speed" => over_speed::orders(history, &all, begun(history, step)?),
            "envelope-over-speed" => over_speed::envelope(history, &all, begun(history, step)?),
            _ => spectra::waterfall(history, &all, step),
        };
    }
    let span = match case.machine.is_mass() {
        true => Span::All,
        false => Span::fitting(history, case.march().cycle)?,
    };
    if stem == "film" {
        let mut charts = films(case, &built.machine);
        charts.retain(|own| own.angle.is_some());
        return if charts.is_empty() {
            Ok(None)
        } else {
            histories::films(history, &charts, span).map(Some)
        };
    }
    let titles = case.supports();
    let laws = drawn_laws(case, built);
    let empty = if stem == "laws" { laws.is_empty() } else { titles.is_empty() };
    if empty {
        return Ok(None);
    }
    let micrometres: Vec<f64> = built.clearances.iter().map(|clearance| 1e6 * clearance).collect();
    let orbits = || histories::eccentricities(history, &titles, &micrometres, span);
    Ok(Some(match stem {
        "laws" => {
            // Laws of rings have no force over the clearance.
            let figure = laws::laws(&laws);
            return Ok(figure.panels.iter().any(|own| !own.lines.is_empty()).then_some(figure));
        }
        "reactions" => histories::reactions(history, &titles, span)?,
        "eccentricity" => orbits()?,
        "eccentricity-stretched" if span == Span::All => return Ok(None),
        "eccentricity-stretched" => histories::stretched(&orbits()?),
        "rotation" => histories::rotation(history, &case.turning())?,
        _ => histories::displacement(history)?,
    }))
}

/// The laws that the case wants drawn; its own if it names none.
fn drawn_laws(case: &Case, built: &Built) -> Vec<Arc<LawSpec>> {
    match case.figures.laws.as_slice() {
        [] => built.laws.iter().filter_map(|law| law.spec()).collect(),
        laws => laws.iter().filter_map(|law| law.spec()).collect(),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;
    use std::sync::Arc;

    use resvg::tiny_skia::Pixmap;
    use whirl_codegen::diagnostic::Source;
    use whirl_codegen::kinds::law::LawSpec;

    use super::histories::{Span, eccentricities, reactions, rotation};
    use super::laws::laws;
    use super::{NAMES, draw, figure::Figure, guarded};
    use crate::case::SupportName;
    use crate::history::{HistoryFile, HistoryWriter, ReadHistory};
    use crate::report::last_cycle;
    use whirl_solver::history::{History, JointColumns};

    /// One support, two revolutions at 10 Hz after 0.1 s at rest, in steps of 1 ms.
    fn history() -> (tempfile::TempDir, HistoryFile) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let names = History::for_bearings(&[JointColumns::of("1")], &[], &[]).names().to_vec();
        let mut history = HistoryWriter::create(&path, &names).unwrap();
        for step in 1..=300 {
            let time = 1e-3 * f64::from(step);
            let theta = (TAU * 10.0 * (time - 0.1)).max(0.0);
            let (sin, cos) = theta.sin_cos();
            let reaction = [400.0 * cos, -40.0 * sin];
            let journal = [20.0 * cos, 10.0 * sin];
            let mut row = vec![time, theta, TAU * 10.0];
            row.extend([reaction, journal, journal].concat());
            row.push(1.0);
            history.push(&row).unwrap();
        }
        history.finish().unwrap();
        let history = HistoryFile::open(&path).unwrap();
        (folder, history)
    }

    fn names() -> Vec<SupportName> {
        vec![SupportName::numbered("Support", 1)]
    }

    fn decodes(figure: &Figure) {
        let svg = draw::svg(figure);
        assert!(svg.contains(&figure.title) && svg.contains(&figure.panels[0].x), "{svg}");
        let png = draw::png(&svg).unwrap();
        let pixels = Pixmap::decode_png(&png).unwrap();
        let white = pixels.pixels().iter().filter(|pixel| pixel.red() == 255).count();
        let all = pixels.pixels().len();
        assert!(pixels.width() > 800 && white > all / 2 && white < all);
    }

    #[test]
    fn every_figure_becomes_a_picture() {
        let (_folder, history) = history();
        for span in [Span::All, Span::LastCycle(0.2)] {
            decodes(&reactions(&history, &names(), span).unwrap());
            decodes(&eccentricities(&history, &names(), &[35.687], span).unwrap());
        }
        decodes(&rotation(&history, &[]).unwrap());
    }

    #[test]
    fn laws_are_drawn_over_their_range() {
        let read = |text: &str| {
            Arc::new(
                LawSpec::read(&Source::new("law.toml", text)).unwrap_or_else(|e| panic!("{e}")),
            )
        };
        let linear = read(include_str!("../../../specs/laws/hu2003-linear.toml"));
        let nonlinear = read(include_str!("../../../specs/laws/hu2003-nonlinear.toml"));
        let figure = laws(&[linear, nonlinear]);
        let curves = &figure.panels[0].lines;
        assert!((curves[0].points[0].1 - 233.0).abs() < 1e-9);
        assert!((curves[1].points[0].1 - 388.0).abs() < 1e-9);
        assert_eq!(curves[1].points.last().unwrap().1, 0.0);
        decodes(&figure);
    }

    #[test]
    fn the_last_cycle_has_its_rows_and_its_keyphasor_dots() {
        let (_folder, history) = history();
        let mut rows = Vec::new();
        let start = last_cycle(&history, 0.2).unwrap();
        history.scan(start, &["t_s"], &mut |row| rows.push(row[0])).unwrap();
        assert_eq!((rows.len(), rows[0]), (201, 0.1));
        assert_eq!(Span::fitting(&history, 0.2).unwrap(), Span::LastCycle(0.2));
        assert_eq!(Span::fitting(&history, 0.01).unwrap(), Span::All);
        let orbit = eccentricities(&history, &names(), &[35.687], Span::LastCycle(0.2)).unwrap();
        assert_eq!(orbit.panels[0].lines[1].points.len(), 201);
        let dots = &orbit.panels[0].dots;
        assert!(!dots.is_empty() && dots.len() <= 3);
        for dot in dots {
            assert!(dot.at.0.abs() < 0.7 && (dot.at.1 - 20.0).abs() < 0.1, "{dot:?}");
        }
    }

    /// Of a cycle of many revolutions the last ones are drawn, whose lines can be told apart.
    #[test]
    fn a_cycle_of_many_revolutions_is_cut_to_what_can_be_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let names = History::for_bearings(&[JointColumns::of("1")], &[], &[]).names().to_vec();
        let mut writer = HistoryWriter::create(&path, &names).unwrap();
        for step in 1..=3000 {
            let time = 1e-3 * f64::from(step);
            let mut row = vec![time, TAU * 10.0 * time, TAU * 10.0];
            row.resize(names.len(), 1.0);
            writer.push(&row).unwrap();
        }
        writer.finish().unwrap();
        let history = HistoryFile::open(&path).unwrap();
        let Span::LastTurns(seconds) = Span::fitting(&history, 2.0).unwrap() else {
            panic!("twenty revolutions");
        };
        assert!((seconds - 0.4).abs() < 1e-3, "{seconds}");
        assert_eq!(Span::fitting(&history, 0.4).unwrap(), Span::LastCycle(0.4));
        let figure = eccentricities(
            &history,
            &[SupportName::numbered("Support", 1)],
            &[30.0],
            Span::LastTurns(0.4),
        )
        .unwrap();
        assert!(figure.title.ends_with("in the last four revolutions"), "{}", figure.title);
    }

    /// What lines are drawn through: of every support its own columns, over the last cycle only.
    #[test]
    fn reactions_and_orbits_go_through_their_own_columns_in_the_last_cycle() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let names =
            History::for_bearings(&[JointColumns::of("1"), JointColumns::of("2")], &[], &[])
                .names()
                .to_vec();
        let mut writer = HistoryWriter::create(&path, &names).unwrap();
        // Every column has values of its own, which no cycle of 0.1 s repeats.
        let angle = |step: u32| 0.3 + TAU * 10.0 * 1e-3 * f64::from(step);
        let value = |column: usize, step: u32| 10.0 * column as f64 + 1e-3 * f64::from(step);
        for step in 1..=300 {
            let mut row = vec![1e-3 * f64::from(step), angle(step), TAU * 10.0];
            row.extend((3..names.len()).map(|column| value(column, step)));
            writer.push(&row).unwrap();
        }
        writer.finish().unwrap();
        let history = HistoryFile::open(&path).unwrap();
        let column = |name: &str| names.iter().position(|own| own == name).expect("a column");
        let titles = [1, 2].map(|k| SupportName::numbered("Support", k));
        let span = Span::LastCycle(0.1);
        let steps = 200..=300;
        let near = |found: (f64, f64), expected: (f64, f64)| {
            // The ten digits of an angle of 19 rad are right to 5e-9 rad, 3e-7°.
            (found.0 - expected.0).abs() < 1e-6 && (found.1 - expected.1).abs() < 1e-9
        };
        for (k, panel) in reactions(&history, &titles, span).unwrap().panels.iter().enumerate() {
            for (line, letters) in panel.lines.iter().zip(["RX", "RY"]) {
                assert!(line.name.starts_with(letters), "{}", line.name);
                let column = column(&format!("{letters}{}_N", k + 1));
                assert_eq!(line.points.len(), 101);
                for (&point, step) in line.points.iter().zip(steps.clone()) {
                    let turned = (angle(step) - angle(200)).to_degrees();
                    assert!(near(point, (turned, value(column, step))), "{letters} {k} {point:?}");
                }
            }
            assert_eq!(panel.lines.len(), 2);
        }
        let orbits = eccentricities(&history, &titles, &[35.687, 20.0], span).unwrap();
        for (k, panel) in orbits.panels.iter().enumerate() {
            let [x, y] = ["EX", "EY"].map(|letters| column(&format!("{letters}{}_um", k + 1)));
            let orbit = &panel.lines.last().expect("an orbit").points;
            assert_eq!(orbit.len(), 101);
            for (&point, step) in orbit.iter().zip(steps.clone()) {
                assert!(near(point, (value(y, step), value(x, step))), "{k} {point:?}");
            }
        }
        assert_eq!((orbits.panels.len(), orbits.panels[1].title.as_str()), (2, "Support 2"));
    }

    #[test]
    fn a_figure_that_cannot_be_drawn_is_a_reason_and_no_end() {
        assert_eq!(guarded(|| Ok(1)), Ok(1));
        let axis = std::hint::black_box(2);
        let reason = guarded(|| -> std::io::Result<()> { panic!("no axis {axis}") });
        assert!(reason.is_err_and(|why| why.ends_with("no axis 2")));
        let reason = guarded(|| -> std::io::Result<()> { panic!("no axis") });
        assert!(reason.is_err_and(|why| why.ends_with("no axis")));
        assert!(
            guarded(|| Err::<(), _>(std::io::Error::other("gone"))).is_err_and(|why| why == "gone")
        );
        let mut names = NAMES.to_vec();
        names.dedup();
        assert_eq!(names, NAMES);
    }
}
