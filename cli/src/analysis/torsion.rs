//! Torsion of a train: its modes, the interference diagram with what excites them, and what couplings and gears carry.
//!
//! The modes are those of the whole machine of which a part is torsion, motions sideways of gears included.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_solver::bodies::Rotation;
use whirl_solver::cache::Cache;
use whirl_solver::linear::{Campbell, Critical, LinearMachine, Mode, Node, Torque, Torsion};
use whirl_text::{rounded, shown};

use super::found::{Found, drawn, followed};
use super::speeds::Wanted;
use super::words;
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::figures::{Dot, Figure, Line, Mark, Panel, Style};
use crate::machine;
use crate::report::table;
use crate::signals::Interruption;

/// Share of torsion from which on a mode is one of the train.
const SHARE: f64 = 0.1;
/// Modes that are looked for beside each that is asked for: most move sideways.
const BESIDE: usize = 3;
/// Modes that are drawn in any case.
const FEW: usize = 2;
/// Mode shapes in the figure.
const SHAPES: usize = 4;
/// Speeds are alike to this share.
const ALIKE: f64 = 1e-9;

/// The machine of a train: rotations that the case prescribes are free, so that no drive holds an end of it.
///
/// # Errors
/// As [`machine::build_planned`].
pub(super) fn released(
    (case, linear): (&Case, &LinearMachine),
    of: Option<usize>,
    cache: Option<&Cache>,
) -> Result<(LinearMachine, Vec<usize>), Failure> {
    let mut bodies = linear.machine().tied_bodies();
    bodies.extend(of.filter(|of| !bodies.contains(of)));
    let mut free = case.clone();
    let prescribed = |body: &usize| case.machine.bodies[*body].rotation != Some(Rotation::Free);
    let bodies: Vec<usize> = bodies.into_iter().filter(prescribed).collect();
    for &body in &bodies {
        let own = &mut free.machine.bodies[body];
        (own.rotation, own.speeds, own.initial_speed) = (Some(Rotation::Free), None, None);
    }
    // What there is to warn of was said of the machine as it is.
    let built = machine::build_planned(&free, cache, &mut Vec::new())?;
    Ok((LinearMachine::new(built.machine)?.with_swinging_bodies(), bodies))
}

/// What excites a train.
struct Excitation {
    name: String,
    kind: String,
    /// Of the speed over which the diagram is.
    order: f64,
}

/// A mode of the train at the speed of operation.
struct Own {
    mode: Mode,
    torsion: Torsion,
}

/// Modes, diagram and torques.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    released: &[usize],
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let of = wanted.of.expect("a body that turns");
    let mut analysis = analysis.clone();
    analysis.ratios.resize(linear.machine().bodies.len(), None);
    for &body in released {
        let told = |body: usize| told(case, body).filter(|own| *own != 0.0);
        let known = analysis.ratios[body].is_some() || body == of;
        if let (false, Some(own), Some(first)) = (known, told(body), told(of)) {
            analysis.ratios[body] = Some(own / first);
        }
    }
    let operation = operation(case, &analysis, wanted);
    let at = linear.standing(&linear.speeds(of, operation[1], &analysis.ratios), None)?;
    let equations = linear.linearised(&at)?;
    let torsion = |mode: &Mode| linear.torsion(&equations.turning, &equations.mass, mode);
    let looked_for = analysis.count * (1 + BESIDE) + 2 * BESIDE;
    let mut modes = Vec::new();
    for mode in linear.modes(&equations, looked_for)?.oscillating {
        let torsion = torsion(&mode)?;
        if torsion.share >= SHARE && modes.len() < analysis.count {
            modes.push(Own { mode, torsion });
        }
    }
    let all = excitations(case, linear, (&analysis, of), &at.speeds);
    let mut orders: Vec<f64> = all.iter().map(|own| own.order).collect();
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    let looked_for = Analysis { count: looked_for, ..analysis.clone() };
    let (campbell, interrupted) = followed(linear, (&looked_for, wanted), interruption, &orders)?;
    // Branches of torsion, each by the largest share that one of its modes has.
    let mut branches = Vec::new();
    for (place, branch) in campbell.branches.iter().enumerate() {
        let mut most = 0.0_f64;
        for mode in branch.iter().flatten() {
            most = most.max(torsion(mode)?.share);
        }
        if most >= SHARE && branches.len() < analysis.count {
            branches.push(place);
        }
    }
    let torques = linear.torques(&at);
    let train = Train {
        case,
        linear,
        of,
        operation,
        modes: &modes,
        excitations: &all,
        campbell: &campbell,
        branches: &branches,
        margin: analysis.margin,
    };
    let name = &analysis.name;
    let mut files = vec![
        (format!("{name}.csv"), train.rows(&torsion)?.into_bytes()),
        (format!("{name}.modes.csv"), train.shapes().into_bytes()),
        (format!("{name}.interference.csv"), train.interference().into_bytes()),
        (format!("{name}.torques.csv"), train.torques(&torques).into_bytes()),
    ];
    if figures {
        files.extend(drawn(name, &train.figure()));
    }
    let mut text = train.text(&torques);
    for body in released {
        let name = linear.machine().bodies[*body].name();
        let _ = writeln!(
            text,
            "note: {name} turns freely here, though its speed is prescribed: a drive holds no end of a train"
        );
    }
    text += &words::doubts(&campbell.doubts);
    Ok(Found { text, files, interrupted })
}

/// The speed that a case gives a body (rad/s), with its sign.
fn told(case: &Case, body: usize) -> Option<f64> {
    let own = &case.machine.bodies[body];
    match own.rotation.as_ref()? {
        Rotation::Free => own.initial_speed,
        Rotation::Prescribed { speed, .. } => Some(*speed),
        Rotation::Scheduled(own) => Some(own.at(0.0)[1]),
        Rotation::Held | Rotation::Spinning { .. } => None,
    }
}

/// Least and largest speed of operation (rad/s).
fn operation(case: &Case, analysis: &Analysis, wanted: &Wanted) -> [f64; 2] {
    let top = case.machine.top_speed(wanted.of.unwrap_or(0), case.run());
    let last = wanted.speeds.last().copied().unwrap_or(0.0);
    match (analysis.operation.first(), analysis.operation.last()) {
        (Some(first), Some(last)) => [*first, *last],
        _ if top > 0.0 => [top; 2],
        _ => [last; 2],
    }
}

/// Orders of all bodies of the train that turn at speeds of their own, and of the teeth.
fn excitations(
    case: &Case,
    linear: &LinearMachine,
    (analysis, of): (&Analysis, usize),
    speeds: &[f64],
) -> Vec<Excitation> {
    let mut tied = linear.machine().tied_bodies();
    tied.extend(Some(of).filter(|of| !tied.contains(of)));
    // That of the diagram first.
    tied.sort_by_key(|body| (*body != of, *body));
    let first = speeds[of];
    let mut shafts: Vec<(usize, f64)> = Vec::new();
    for body in tied {
        let ratio = if first == 0.0 { 1.0 } else { (speeds[body] / first).abs() };
        let alike = |own: &(usize, f64)| (own.1 - ratio).abs() <= ALIKE * ratio;
        if ratio > 0.0 && !shafts.iter().any(alike) {
            shafts.push((body, ratio));
        }
    }
    let name = |body: usize| linear.machine().bodies[body].name();
    let mut all = Vec::new();
    for &(body, ratio) in &shafts {
        all.extend(analysis.orders.iter().map(|order| Excitation {
            name: format!("{order} × {}", name(body)),
            kind: format!("orders of {}", name(body)),
            order: order * ratio,
        }));
    }
    for joint in &case.machine.joints {
        let (Some(gears), Some(body)) = (&joint.gears, joint.sides[0].body) else { continue };
        let Some([teeth, _]) = gears.teeth else { continue };
        let ratio = if first == 0.0 { 1.0 } else { (speeds[body] / first).abs() };
        all.extend(analysis.mesh_orders.iter().map(|order| Excitation {
            name: format!("{order} × teeth of {}", joint.name.text()),
            kind: format!("teeth of {}", joint.name.text()),
            order: order * teeth * ratio,
        }));
    }
    all
}

/// All that is known of a train.
struct Train<'a> {
    case: &'a Case,
    linear: &'a LinearMachine,
    of: usize,
    /// Least and largest speed of operation (rad/s).
    operation: [f64; 2],
    modes: &'a [Own],
    excitations: &'a [Excitation],
    campbell: &'a Campbell,
    /// Those of torsion.
    branches: &'a [usize],
    margin: f64,
}

impl Train<'_> {
    fn joint(&self, own: &Torque) -> &str {
        self.case.machine.joints[own.joint].name.text()
    }

    fn torques(&self, all: &[Torque]) -> String {
        let mut text =
            String::from("joint,torque_on_first_Nm,torque_on_second_Nm,force_of_teeth_N\n");
        for own in all {
            let force = own.force.map_or(String::new(), |force| force.to_string());
            let [first, second] = own.torques;
            writeln!(text, "{},{first},{second},{force}", self.joint(own))
                .expect("text can be written");
        }
        text
    }

    fn body(&self) -> &str {
        self.linear.machine().bodies[self.of].name()
    }

    /// Modes over speeds.
    fn rows(
        &self,
        torsion: &dyn Fn(&Mode) -> Result<Torsion, whirl_solver::Error>,
    ) -> Result<String, Failure> {
        let mut text = String::from(
            "speed_rpm,mode,frequency_hz,damping_ratio,log_decrement,torsional_share\n",
        );
        for (place, &speed) in self.campbell.speeds.iter().enumerate() {
            for (number, &branch) in self.branches.iter().enumerate() {
                let Some(mode) = &self.campbell.branches[branch][place] else { continue };
                let values = [mode.hertz(), mode.damping_ratio(), mode.log_decrement()];
                let values = values.map(|value| value.to_string()).join(",");
                let share = torsion(mode)?.share;
                writeln!(text, "{},{},{values},{share}", words::rpm(speed), number + 1)
                    .expect("text can be written");
            }
        }
        Ok(text)
    }

    /// Shapes of the modes at the speed of operation.
    fn shapes(&self) -> String {
        let mut text = String::from(
            "mode,frequency_hz,damping_ratio,torsional_share,body,twist,share_of_torsion\n",
        );
        for (number, Own { mode, torsion }) in self.modes.iter().enumerate() {
            let values = [mode.hertz(), mode.damping_ratio(), torsion.share];
            let values = values.map(|value| value.to_string()).join(",");
            for (body, own) in self.linear.machine().bodies.iter().enumerate() {
                let twist = torsion.twists[body].map_or(String::new(), |own| own.to_string());
                let share = torsion.bodies[body];
                if own.rotation().is_some() {
                    writeln!(text, "{},{values},{},{twist},{share}", number + 1, own.name())
                        .expect("text can be written");
                }
            }
        }
        text
    }

    /// Least distance of a frequency from that of an excitation in operation, over the latter, with its sign.
    fn separation(&self, mode: &Mode, excitation: &Excitation) -> Option<f64> {
        let [first, last] = self.operation.map(|speed| excitation.order * speed.abs() / TAU);
        let (least, most) = (first.min(last), first.max(last));
        let own = mode.hertz();
        if most == 0.0 {
            return None;
        }
        Some(match () {
            () if own > most => own / most - 1.0,
            () if own < least => own / least - 1.0,
            () => 0.0,
        })
    }

    /// All pairs of a mode and an excitation that come too close in operation.
    fn close(&self) -> Vec<(usize, &Excitation, f64)> {
        let pairs = self.modes.iter().enumerate().flat_map(|(number, own)| {
            self.excitations.iter().filter_map(move |excitation| {
                let separation = self.separation(&own.mode, excitation)?;
                (separation.abs() < self.margin).then_some((number, excitation, separation))
            })
        });
        pairs.collect()
    }

    /// Critical speeds, each with its mode of torsion and its excitation.
    fn criticals(&self) -> Vec<(usize, &Excitation, &Critical)> {
        let mut all = Vec::new();
        for own in &self.campbell.criticals {
            let Some(mode) = self.branches.iter().position(|branch| *branch == own.branch) else {
                continue;
            };
            let excitation = self.excitations.iter().filter(|other| other.order == own.order);
            all.extend(excitation.map(|excitation| (mode, excitation, own)));
        }
        all.sort_by(|a, b| a.2.speed.abs().total_cmp(&b.2.speed.abs()).then(a.0.cmp(&b.0)));
        all
    }

    /// How far a speed is from those of operation: nearest of them over it, less one; 0 within.
    fn margin_of(&self, speed: f64) -> f64 {
        let [least, most] = self.operation;
        match () {
            () if speed > most => speed / most - 1.0,
            () if speed < least => speed / least - 1.0,
            () => 0.0,
        }
    }

    fn interference(&self) -> String {
        let mut text = String::from(
            "what,excitation,order,mode,frequency_hz,speed_rpm,separation,within_margin\n",
        );
        for (number, excitation, own) in self.criticals() {
            let (order, hertz, rpm) = (excitation.order, own.mode.hertz(), words::rpm(own.speed));
            let margin = self.margin_of(own.speed);
            let close = if margin.abs() < self.margin { "yes" } else { "no" };
            writeln!(
                text,
                "critical speed,{},{order},{},{hertz},{rpm},{margin},{close}",
                excitation.name,
                number + 1
            )
            .expect("text can be written");
        }
        for (number, own) in self.modes.iter().enumerate() {
            for excitation in self.excitations {
                let Some(separation) = self.separation(&own.mode, excitation) else { continue };
                let close = if separation.abs() < self.margin { "yes" } else { "no" };
                let rpm = words::rpm(self.operation[1]);
                writeln!(
                    text,
                    "operation,{},{},{},{},{rpm},{separation},{close}",
                    excitation.name,
                    excitation.order,
                    number + 1,
                    own.mode.hertz()
                )
                .expect("text can be written");
            }
        }
        text
    }

    fn nodes(&self, torsion: &Torsion) -> String {
        let name = |node: &Node| match node {
            Node::Joint(place) => self.case.machine.joints[*place].name.text(),
            Node::Body(place) => self.linear.machine().bodies[*place].name(),
        };
        let names: Vec<&str> = torsion.nodes.iter().map(name).collect();
        names.join(", ")
    }

    fn text(&self, torques: &[Torque]) -> String {
        let mut text = format!("{}: {}\n", self.case.name, self.case.title);
        let range = match self.operation {
            [first, last] if first == last => format!("{} rpm", words::speed(last)),
            [first, last] => format!("{} to {} rpm", words::speed(first), words::speed(last)),
        };
        let _ = writeln!(text, "torsion over the speed of {}; in operation {range}\n", self.body());
        let head = ["mode", "frequency (Hz)", "damping ratio", "torsion", "turns", "nodes in"];
        let mut rows = vec![head.map(str::to_owned).to_vec()];
        for (number, Own { mode, torsion }) in self.modes.iter().enumerate() {
            rows.push(vec![
                (number + 1).to_string(),
                words::hertz(mode),
                words::damping(mode),
                format!("{} %", rounded(100.0 * torsion.share, 3)),
                words::most(self.linear, &torsion.bodies),
                self.nodes(torsion),
            ]);
        }
        match self.modes.is_empty() {
            true => text.push_str("no mode of torsion among those that were looked for\n"),
            false => text.push_str(&table(&rows)),
        }
        text.push('\n');
        let criticals = self.criticals();
        if criticals.is_empty() {
            text.push_str("no torsional critical speed in this range\n");
        } else {
            let head =
                ["critical speed (rpm)", "excitation", "mode", "frequency (Hz)", "margin", ""];
            let mut rows = vec![head.map(str::to_owned).to_vec()];
            for (number, excitation, own) in criticals {
                let margin = self.margin_of(own.speed);
                rows.push(vec![
                    words::speed(own.speed),
                    excitation.name.clone(),
                    (number + 1).to_string(),
                    words::hertz(&own.mode),
                    format!("{} %", rounded(100.0 * margin, 3)),
                    if margin.abs() < self.margin { "CLOSE" } else { "" }.to_owned(),
                ]);
            }
            text.push_str(&table(&rows));
        }
        text.push('\n');
        let percent = rounded(100.0 * self.margin, 6);
        for (number, excitation, separation) in self.close() {
            let _ = writeln!(
                text,
                "CLOSE: mode {} is {} % from {} in operation, less than {percent} %",
                number + 1,
                rounded(100.0 * separation.abs(), 3),
                excitation.name
            );
        }
        if self.close().is_empty() {
            let _ = writeln!(
                text,
                "all modes are {percent} % and more from all excitations in operation"
            );
        }
        if !torques.is_empty() {
            let head = ["static torque", "on the first (N·m)", "on the second (N·m)", "teeth (N)"];
            let mut rows = vec![head.map(str::to_owned).to_vec()];
            let value =
                |own: f64| if own.abs() < 1e-9 { "0".to_owned() } else { shown(own, 6, 1e-3..1e7) };
            for own in torques {
                let force = own.force.map_or(String::new(), value);
                rows.push(vec![
                    self.joint(own).to_owned(),
                    value(own.torques[0]),
                    value(own.torques[1]),
                    force,
                ]);
            }
            text.push('\n');
            text.push_str(&table(&rows));
        }
        let pulls = torques.iter().filter(|own| own.force.is_some_and(|force| force < -1e-6));
        for own in pulls {
            let _ = writeln!(
                text,
                "note: the teeth of {} would pull: the torque is carried by their other flank, along another line; change the sign of its \
                 `pressure_angle`",
                self.joint(own)
            );
        }
        text
    }

    fn figure(&self) -> Figure {
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
