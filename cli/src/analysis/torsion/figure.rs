//! The interference diagram, and the shapes of modes.

use std::f64::consts::TAU;

use whirl_text::rounded;

use super::train::Train;
use crate::analysis::words;
use crate::figures::{Dot, Figure, Line, Mark, Panel, Style};

/// Modes that are drawn in any case.
const FEW: usize = 2;
/// Mode shapes in the figure.
const SHAPES: usize = 4;

impl Train<'_> {
    pub(super) fn figure(&self) -> Figure {
        let all = self.campbell;
        let ends = [all.speeds.first(), all.speeds.last()].map(|own| own.copied().unwrap_or(0.0));
        let excited = self.excitations.iter().map(|own| own.order * ends[1].abs() / TAU);
        let excited = 1.05 * excited.fold(0.0, f64::max);
        // Modes beyond all excitations say nothing in this diagram, but it has some.
        let shown = |(number, line): &(usize, Line)| {
            let least = line.points.iter().map(|own| own.1).fold(f64::INFINITY, f64::min);
            *number < FEW || least <= excited
        };
        let lines = self.branches.iter().map(|&branch| Line {
            points: all.branches[branch]
                .iter()
                .zip(&all.speeds)
                .filter_map(|(mode, &speed)| Some((words::rpm(speed), mode.as_ref()?.hertz())))
                .collect(),
            style: Style::First,
            name: "modes of torsion".to_owned(),
        });
        let lines = lines.enumerate().filter(shown).map(|own| own.1);
        let mut diagram = Panel {
            title: "interference diagram".to_owned(),
            x: format!("speed of {} (rpm)", self.body()),
            y: "frequency (Hz)".to_owned(),
            lines: lines.collect(),
            ..Panel::default()
        };
        let points = diagram.lines.iter().flat_map(|own| &own.points);
        let highest = 1.1 * points.fold(0.0, |most: f64, own| most.max(own.1));
        let styles = [Style::Limit, Style::Third, Style::Fourth, Style::Second];
        let mut kinds: Vec<&str> = Vec::new();
        for own in self.excitations {
            let place = kinds.iter().position(|kind| *kind == own.kind).unwrap_or(kinds.len());
            if place == kinds.len() {
                kinds.push(&own.kind);
            }
            let last = ends[1].min(highest * TAU / own.order);
            if last > ends[0] {
                let at = |speed: f64| (words::rpm(speed), own.order * speed.abs() / TAU);
                diagram.lines.push(Line {
                    points: vec![at(ends[0]), at(last)],
                    style: styles[place % styles.len()],
                    name: own.kind.clone(),
                });
            }
        }
        for (.., own) in self.criticals() {
            let at = (words::rpm(own.speed), own.mode.hertz());
            diagram.dots.push(Dot { at, name: "critical speeds".to_owned() });
        }
        for (speed, name) in [
            (
                self.operation[0] * (1.0 - self.margin),
                format!("−{} %", rounded(100.0 * self.margin, 3)),
            ),
            (
                self.operation[1] * (1.0 + self.margin),
                format!("+{} %", rounded(100.0 * self.margin, 3)),
            ),
        ] {
            if speed > ends[0] && speed < ends[1] {
                diagram.marks.push(Mark { x: words::rpm(speed), name });
            }
        }
        let machine = self.linear.machine();
        let bodies: Vec<usize> = machine.tied_bodies();
        let mut shapes = Panel {
            title: "shapes, in the speed of the first body".to_owned(),
            y: "turn (1)".to_owned(),
            x_names: bodies.iter().map(|&body| machine.bodies[body].name().to_owned()).collect(),
            ..Panel::default()
        };
        let styles = [Style::First, Style::Second, Style::Third, Style::Fourth];
        for ((number, own), style) in self.modes.iter().enumerate().take(SHAPES).zip(styles) {
            let points = bodies.iter().enumerate();
            let points = points
                .filter_map(|(place, &body)| Some((place as f64 + 1.0, own.torsion.twists[body]?)));
            let name = format!("mode {}", number + 1);
            shapes.lines.push(Line { points: points.collect(), style, name });
        }
        let panels = match bodies.len() {
            0 | 1 => vec![diagram],
            _ => vec![diagram, shapes],
        };
        let columns = panels.len();
        Figure { title: format!("{}: {}", self.case.name, self.case.title), panels, columns }
    }
}
