//! Figures of a case: laws, reactions, eccentricity orbits, rotation.

mod draw;
mod figure;
mod histories;
mod laws;

use std::sync::Arc;

use whirl_codegen::spec::law::LawSpec;
use whirl_solver::history::History;

use self::figure::Figure;
use self::histories::Span;
use crate::case::{Case, System};
use crate::output::Output;

pub(crate) use self::laws::{Curve, curves};

/// Draws a law as `stem.svg` and `stem.png` into `output`.
pub(crate) fn draw_law(law: &LawSpec, stem: &str, output: &mut Output) {
    put(stem, &laws::law(law), output);
}

fn put(stem: &str, figure: &Figure, output: &mut Output) {
    let svg = draw::svg(figure);
    if let Some(png) = draw::png(&svg) {
        output.put(&format!("{stem}.png"), png);
    }
    output.put(&format!("{stem}.svg"), svg);
}

/// Draws the figures of a case as SVG and PNG into `output`. `clearances`: of every support, in m.
pub(crate) fn draw(case: &Case, history: &History, clearances: &[f64], output: &mut Output) {
    for (name, number, figure) in figures(case, history, clearances) {
        let place = number.map_or(String::new(), |number| format!(" (Fig. {number} of the paper)"));
        let figure = Figure { title: format!("{}: {}{place}", case.name, figure.title), ..figure };
        put(name, &figure, output);
    }
}

type Named = (&'static str, Option<usize>, Figure);

fn figures(case: &Case, history: &History, clearances: &[f64]) -> Vec<Named> {
    let named = &case.figures;
    let laws: Vec<Arc<LawSpec>> = match named.laws.as_slice() {
        [] => case.laws().into_iter().map(|law| law.spec()).collect(),
        laws => laws.iter().map(|law| law.spec()).collect(),
    };
    let mut figures = vec![("laws", named.law, laws::laws(&laws))];
    let span = Span::fitting(history, case.march.cycle);
    let micrometres: Vec<f64> = clearances.iter().map(|clearance| 1e6 * clearance).collect();
    let titles = support_names(case);
    match &case.system {
        System::Rotor(rotor) => {
            let orbits = histories::eccentricities(history, &titles, &micrometres, span);
            figures.push((
                "reactions",
                named.reactions,
                histories::reactions(history, &titles, span),
            ));
            if span != Span::All {
                let stretched = histories::stretched(&orbits);
                figures.push(("eccentricity-stretched", named.eccentricity, stretched));
            }
            figures.push(("eccentricity", named.eccentricity, orbits));
            if rotor.drive.acts {
                figures.push(("rotation", named.rotation, histories::rotation(history)));
            }
        }
        System::Lumped(_) => {
            let reactions = histories::reactions(history, &titles, Span::All);
            figures.push(("reactions", named.reactions, reactions));
            figures.push(("displacement", None, histories::displacement(history)));
        }
    }
    figures
}

/// What results call the supports, in order.
pub(crate) fn support_names(case: &Case) -> Vec<String> {
    let (word, count) = match &case.system {
        System::Rotor(rotor) => ("Support", rotor.bearings.len()),
        System::Lumped(lumped) => ("Stop", lumped.stops.len()),
    };
    (1..=count).map(|k| format!("{word} {k}")).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;
    use std::sync::Arc;

    use resvg::tiny_skia::Pixmap;
    use whirl_codegen::diagnostic::Source;
    use whirl_codegen::spec::law::LawSpec;

    use super::histories::{Span, eccentricities, reactions, rotation};
    use super::laws::laws;
    use super::{draw, figure::Figure};
    use crate::report::last_cycle;
    use whirl_solver::history::History;

    /// One support, two revolutions at 10 Hz after 0.1 s at rest, in steps of 1 ms.
    fn history() -> History {
        let mut history = History::for_bearings(1, &[]);
        for step in 1..=300 {
            let time = 1e-3 * f64::from(step);
            let theta = (TAU * 10.0 * (time - 0.1)).max(0.0);
            let (sin, cos) = theta.sin_cos();
            let reaction = [400.0 * cos, -40.0 * sin];
            let journal = [20.0 * cos, 10.0 * sin];
            let mut row = vec![time, theta, TAU * 10.0];
            row.extend([reaction, journal, journal].concat());
            row.push(1.0);
            history.push(&row);
        }
        history
    }

    fn names() -> Vec<String> {
        vec!["Support 1".to_string()]
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
        let history = history();
        for span in [Span::All, Span::LastCycle(0.2)] {
            decodes(&reactions(&history, &names(), span));
            decodes(&eccentricities(&history, &names(), &[35.687], span));
        }
        decodes(&rotation(&history));
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
        let history = history();
        assert_eq!(last_cycle(&history.column("t_s").unwrap(), 0.2), 99..300);
        assert_eq!(Span::fitting(&history, 0.2), Span::LastCycle(0.2));
        assert_eq!(Span::fitting(&history, 0.01), Span::All);
        let orbit = eccentricities(&history, &names(), &[35.687], Span::LastCycle(0.2));
        let dots = &orbit.panels[0].dots;
        assert!(!dots.is_empty() && dots.len() <= 3);
        for dot in dots {
            assert!(dot.at.0.abs() < 0.7 && (dot.at.1 - 20.0).abs() < 0.1, "{dot:?}");
        }
    }

    /// What lines are drawn through: of every support its own columns, over the last cycle only.
    #[test]
    fn reactions_and_orbits_go_through_their_own_columns_in_the_last_cycle() {
        let mut history = History::for_bearings(2, &[]);
        let names = history.names().to_vec();
        // Every column has values of its own, which no cycle of 0.1 s repeats.
        let angle = |step: u32| 0.3 + TAU * 10.0 * 1e-3 * f64::from(step);
        let value = |column: usize, step: u32| 10.0 * column as f64 + 1e-3 * f64::from(step);
        for step in 1..=300 {
            let mut row = vec![1e-3 * f64::from(step), angle(step), TAU * 10.0];
            row.extend((3..names.len()).map(|column| value(column, step)));
            history.push(&row);
        }
        let column = |name: &str| names.iter().position(|own| own == name).expect("a column");
        let titles = ["Support 1", "Support 2"].map(str::to_owned);
        let span = Span::LastCycle(0.1);
        let steps = 200..=300;
        let near = |found: (f64, f64), expected: (f64, f64)| {
            (found.0 - expected.0).abs() < 1e-9 && (found.1 - expected.1).abs() < 1e-9
        };
        for (k, panel) in reactions(&history, &titles, span).panels.iter().enumerate() {
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
        let orbits = eccentricities(&history, &titles, &[35.687, 20.0], span);
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
}
