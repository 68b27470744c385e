//! Bode plots of the probes with the speed range and the margins, and the logarithmic decrement over cross-coupled stiffness.

use whirl_solver::linear::Peak;

use super::done::{AS_IT_IS, Done};
use super::standard;
use crate::analysis::words;
use crate::case::{Case, Lateral};
use crate::figures::{Dot, Figure, Line, Mark, Panel, Style};

const STYLES: [Style; 4] = [Style::First, Style::Second, Style::Third, Style::Fourth];

/// Panels of the case as it is, and the decrement of all variants.
pub(super) fn figure(case: &Case, lateral: &Lateral, all: &[Done]) -> Figure {
    let mut panels = Vec::new();
    for done in all.iter().filter(|own| own.name == AS_IT_IS) {
        panels.extend((0..done.responses.all.len()).map(|place| bode(lateral, done, place)));
    }
    if let Some(panel) = decrement(all) {
        panels.push(panel);
    }
    Figure { title: format!("{}: {}", case.name, case.title), panels, columns: 2 }
}

/// Readings over speed, and from each critical speed as far as its margin reaches.
fn bode(lateral: &Lateral, done: &Done, place: usize) -> Panel {
    let response = &done.responses.all[place];
    let body = done.model.linear.machine().bodies[done.model.of].name();
    let mut lines: Vec<Line> = done
        .probes
        .iter()
        .enumerate()
        .zip(STYLES)
        .map(|((probe, own), style)| Line {
            points: done
                .responses
                .speeds
                .iter()
                .zip(&response.readings)
                .map(|(speed, readings)| (words::rpm(*speed), readings[probe]))
                .collect(),
            style,
            name: own.name.clone(),
        })
        .collect();
    let limit = standard::vibration_limit(words::rpm(lateral.maximum));
    let range = [lateral.minimum, lateral.maximum].map(words::rpm);
    lines.push(Line {
        points: range.map(|speed| (speed, limit)).to_vec(),
        style: Style::Limit,
        name: "A_vl from N_ma to N_mc".to_owned(),
    });
    let peaks = || response.peaks.iter().flatten();
    // What grows without limit is shown at the limit of vibration.
    let height = |own: &Peak| if own.is_undamped() { limit } else { own.height };
    for own in peaks() {
        let factor = own.amplification().unwrap_or(0.0);
        if factor < standard::CRITICAL {
            continue;
        }
        let speed = words::rpm(own.speed);
        let end = match own.speed {
            below if below < lateral.minimum => {
                speed / (1.0 - 0.01 * standard::margin_below(factor))
            }
            above if above > lateral.maximum => {
                speed / (1.0 + 0.01 * standard::margin_above(factor))
            }
            _ => continue,
        };
        lines.push(Line {
            points: vec![(speed, height(own)), (end, height(own))],
            style: Style::Doubted,
            name: "required separation margin".to_owned(),
        });
    }
    let dots = peaks()
        .map(|own| Dot { at: (words::rpm(own.speed), height(own)), name: "peaks".to_owned() });
    let mark = |name: &str, speed: f64| Mark { x: words::rpm(speed), name: name.to_owned() };
    Panel {
        title: format!("unbalance {}", response.name),
        x: format!("speed of {body} (rpm)"),
        y: "probe (µm, peak to peak)".to_owned(),
        lines,
        dots: dots.collect(),
        marks: vec![mark("N_ma", lateral.minimum), mark("N_mc", lateral.maximum)],
        ..Panel::default()
    }
}

fn decrement(all: &[Done]) -> Option<Panel> {
    let of = |done: &Done| {
        done.stability.as_ref().filter(|own| !own.curve.is_empty()).map(|own| own.curve.clone())
    };
    let curves = all.iter().filter_map(|done| Some((done, of(done)?))).zip(STYLES);
    let mut lines: Vec<Line> = curves
        .map(|((done, points), style)| Line {
            points,
            style,
            name: format!("level I, {}", done.name),
        })
        .collect();
    let most = lines.first()?.points.last()?.0;
    lines.push(Line {
        points: vec![(0.0, standard::DECREMENT), (most, standard::DECREMENT)],
        style: Style::Limit,
        name: "least decrement".to_owned(),
    });
    let expected = all.first()?.stability.as_ref()?.expected;
    Some(Panel {
        title: "least damped forward mode at N_mc".to_owned(),
        x: "cross-coupled stiffness Q (N/m)".to_owned(),
        y: "logarithmic decrement (1)".to_owned(),
        lines,
        marks: vec![Mark { x: expected, name: "Q_A".to_owned() }],
        ..Panel::default()
    })
}
