//! Figures of a case: laws, reactions, eccentricity orbits, rotation.

mod draw;
mod figure;
mod histories;
mod laws;

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;
    use std::sync::Arc;

    use resvg::tiny_skia::Pixmap;
    use whirl_codegen::diagnostic::Source;
    use whirl_codegen::spec::law::LawSpec;

    use super::histories::{Span, eccentricities, last_cycle, reactions, rotation};
    use super::laws::laws;
    use super::{draw, figure::Figure};
    use crate::report::Columns;

    /// One support, two revolutions at 10 Hz after one at rest, 100 steps each.
    fn history() -> Columns {
        let time: Vec<f64> = (1..=300).map(|step| 1e-3 * f64::from(step)).collect();
        let theta: Vec<f64> = time.iter().map(|t| (TAU * 10.0 * (t - 0.1)).max(0.0)).collect();
        let of_theta =
            |scale: f64, f: fn(f64) -> f64| theta.iter().map(|angle| scale * f(*angle)).collect();
        let mut columns = Columns::default();
        columns.push("RX1_N", of_theta(400.0, f64::cos));
        columns.push("RY1_N", of_theta(-40.0, f64::sin));
        columns.push("EX1_um", of_theta(20.0, f64::cos));
        columns.push("EY1_um", of_theta(10.0, f64::sin));
        columns.push("omega_rad_s", vec![TAU * 10.0; time.len()]);
        columns.push("theta_rad", theta);
        columns.push("t_s", time);
        columns
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
            decodes(&reactions(&history, 1, span));
            decodes(&eccentricities(&history, &[35.687], span));
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
        assert_eq!(last_cycle(&history["t_s"], 0.2), 99..300);
        assert_eq!(Span::fitting(&history, 0.2), Span::LastCycle(0.2));
        assert_eq!(Span::fitting(&history, 0.01), Span::All);
        let orbit = eccentricities(&history, &[35.687], Span::LastCycle(0.2));
        let dots = &orbit.panels[0].dots;
        assert!(!dots.is_empty() && dots.len() <= 3);
        for dot in dots {
            assert!(dot.at.0.abs() < 0.7 && (dot.at.1 - 20.0).abs() < 0.1, "{dot:?}");
        }
    }
}
