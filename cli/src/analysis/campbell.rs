//! Modes over speeds: table, critical speeds, thresholds of stability, figure.

use std::fmt::Write;

use whirl_solver::linear::{Branch, Campbell, Critical, LinearMachine, Mode, Way, Whirl};

use super::facts::Facts;
use super::found::{Found, drawn, followed};
use super::orders::Orders;
use super::space::{InSpace, Pictures, SPEEDS, Space, Told, evenly};
use super::speeds::Wanted;
use super::{roots, words};
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::figures::{Cloud, Dot, Figure, Label, Line, Mark, Panel, Stroke, Style};
use crate::report::table;
use crate::signals::Interruption;

/// Modes followed over the speeds.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    pictures: Pictures,
) -> Result<Found, Failure> {
    let of = wanted.of.expect("a body that turns");
    let orders = Orders::of(linear, (of, analysis));
    let follow = || followed(linear, (analysis, wanted), interruption, &orders.values());
    let all = pictures.space.map_or_else(follow, |space| space.while_made(follow))?;
    let ways = ways(linear, (of, analysis), &all)?;
    let name = &analysis.name;
    let mut files = vec![
        (format!("{name}.csv"), rows(&all).into_bytes()),
        (format!("{name}.critical.csv"), criticals(&all, &ways, &orders).into_bytes()),
    ];
    if pictures.figures {
        files.extend(drawn(name, &figure(case, linear, of, &all, &orders)));
        let body = linear.machine().bodies[of].name();
        let stem = format!("{name}.roots");
        files.extend(drawn(&stem, &roots::figure(&case.name, body, &all)));
    }
    if let Some(mut space) = pictures.space.map(Space::begin).transpose()?.flatten() {
        in_space(linear, (of, analysis), (&all, &orders), &mut space);
        files.extend(space.file(name));
    }
    let mut text = text(case, linear, of, (&all, &ways, &orders));
    text += &words::doubts(&all.doubts);
    let facts = Facts::of_campbell(&all, &orders);
    Ok(Found { text, files, interrupted: all.interrupted, facts })
}

/// Which way the modes at critical speeds move, and those where modes begin or end to grow.
struct Ways {
    criticals: Vec<Way>,
    thresholds: Vec<Option<Way>>,
}

fn ways(
    linear: &LinearMachine,
    (of, analysis): (usize, &Analysis),
    all: &Campbell,
) -> Result<Ways, Failure> {
    let mut found = Ways { criticals: Vec::new(), thresholds: Vec::new() };
    let speeds = all.criticals.iter().map(|own| own.speed);
    // M and the angles of small motions are the same at all speeds.
    let Some(speed) = speeds.chain(all.thresholds.iter().map(|own| own.speed)).next() else {
        return Ok(found);
    };
    let at = linear.standing(&linear.speeds(of, speed, &analysis.ratios), None)?;
    let equations = linear.linearised(&at)?;
    let way = |mode: &Mode| linear.way(&equations.turning, &equations.mass, mode);
    for own in &all.criticals {
        found.criticals.push(way(&own.mode)?);
    }
    for own in &all.thresholds {
        found.thresholds.push(own.mode.as_ref().map(way).transpose()?);
    }
    Ok(found)
}

/// Modes at critical speeds and where they begin to grow, and those at some of the speeds.
fn in_space(
    linear: &LinearMachine,
    (of, analysis): (usize, &Analysis),
    (all, orders): (&Campbell, &Orders),
    space: &mut InSpace,
) {
    let named = |speed: f64, what: &str, mode: &Mode| {
        let whirl = words::whirl(mode, speed);
        let whirl = if whirl == "-" { String::new() } else { format!(", {whirl}") };
        format!("{} rpm{what}: {} Hz{whirl}", words::speed(speed), words::hertz(mode))
    };
    let mut shown: Vec<(f64, Vec<Shown>)> = Vec::new();
    for own in &all.criticals {
        let name = named(own.speed, &format!(", {}", orders.called(own.order)), &own.mode);
        let called = Some(("critical speeds".to_owned(), name));
        shown.push((own.speed, vec![(&own.mode, called)]));
    }
    for own in &all.thresholds {
        let Some(mode) = &own.mode else { continue };
        let group = if own.grows { "unstable above" } else { "stable above" };
        let called = Some((group.to_owned(), named(own.speed, "", mode)));
        shown.push((own.speed, vec![(mode, called)]));
    }
    let places: Vec<usize> = (0..all.speeds.len()).collect();
    for &place in evenly(&places, SPEEDS) {
        let mut modes: Vec<&Mode> =
            all.branches.iter().filter_map(|branch| branch[place].as_ref()).collect();
        modes.sort_by(|a, b| a.value.im.total_cmp(&b.value.im));
        let modes = modes.into_iter().map(|own| (own, None)).collect();
        shown.push((all.speeds[place], modes));
    }
    let mut room = space.room();
    let fit = shown.iter().take_while(|own| {
        let fits = room > 0;
        room = room.saturating_sub(own.1.len());
        fits
    });
    let fit = fit.count();
    space.leave_out(shown[fit..].iter().map(|own| own.1.len()).sum());
    shown.truncate(fit);
    let speeds: Vec<_> =
        shown.iter().map(|own| linear.speeds(of, own.0, &analysis.ratios)).collect();
    for ((speed, modes), at) in shown.iter().zip(linear.standing_all(&speeds)) {
        // Where it does not stand there is nothing to be seen.
        let Ok(at) = at else { continue };
        for (place, (mode, called)) in modes.iter().enumerate() {
            let mut told = Told::at_speed(linear, Some((of, *speed)), (place, mode));
            if let Some((group, name)) = called {
                (told.group, told.name) = (group.clone(), name.clone());
            }
            space.mode((linear, &at), mode, Some((of, *speed)), told);
        }
    }
}

/// A mode to be seen, with its group and its name there if they are not those of modes at a speed.
type Shown<'a> = (&'a Mode, Option<(String, String)>);

/// Every mode at every speed.
fn rows(all: &Campbell) -> String {
    let mut text = String::from(
        "speed_rpm,branch,frequency_hz,damping_ratio,log_decrement,whirl,sense,real_1_s,imaginary_1_s,beside_hz\n",
    );
    for (place, &speed) in all.speeds.iter().enumerate() {
        for (number, branch) in all.branches.iter().enumerate() {
            let Some(mode) = &branch[place] else { continue };
            writeln!(text, "{},{},{}", words::rpm(speed), number + 1, values(mode, speed))
                .expect("text can be written");
        }
    }
    text
}

/// Critical speeds, and where modes begin or end to grow.
fn criticals(all: &Campbell, ways: &Ways, orders: &Orders) -> String {
    let mut text = String::from(
        "what,order,speed_rpm,branch,frequency_hz,damping_ratio,log_decrement,whirl,sense,real_1_s,imaginary_1_s,beside_hz,motion,once_a_turn_of\n",
    );
    let mut add = |what: &str,
                   order: Option<f64>,
                   speed: f64,
                   branch: Option<usize>,
                   mode: Option<(&Mode, Way)>| {
        let rpm = words::rpm(speed);
        let branch = branch.map_or(String::new(), |own| (own + 1).to_string());
        // A motion that does not oscillate has none of them.
        let values = mode.map_or(",,,,,,,,".to_owned(), |(mode, way)| {
            format!("{},{}", values(mode, speed), words::way(way))
        });
        let others = order.map_or(String::new(), |own| orders.others(own).join(" "));
        let order = order.map_or(String::new(), |own| own.to_string());
        writeln!(text, "{what},{order},{rpm},{branch},{values},{others}")
            .expect("text can be written");
    };
    for (own, way) in all.criticals.iter().zip(&ways.criticals) {
        add(
            "critical speed",
            Some(own.order),
            own.speed,
            Some(own.branch),
            Some((&own.mode, *way)),
        );
    }
    for (own, way) in all.thresholds.iter().zip(&ways.thresholds) {
        let what = words::threshold(own);
        add(what, None, own.speed, own.branch, own.mode.as_ref().zip(*way));
    }
    text
}

fn values(mode: &Mode, speed: f64) -> String {
    let numbers = [mode.hertz(), mode.damping_ratio(), mode.log_decrement()];
    let numbers = numbers.map(|value| value.to_string()).join(",");
    let whirl = words::whirl(mode, speed);
    let (sense, value, beside) = (mode.sense, mode.value, words::beside(mode));
    format!("{numbers},{whirl},{sense},{},{},{beside}", value.re, value.im)
}

fn text(
    case: &Case,
    linear: &LinearMachine,
    of: usize,
    (all, ways, orders): (&Campbell, &Ways, &Orders),
) -> String {
    let body = linear.machine().bodies[of].name();
    let mut text = format!("{}: {}\n", case.name, case.title);
    let ends = [all.speeds.first(), all.speeds.last()];
    if let [Some(first), Some(last)] = ends {
        let _ = writeln!(
            text,
            "{} modes over the speed of {body}, {} to {} rpm\n",
            all.branches.len(),
            words::speed(*first),
            words::speed(*last)
        );
    }
    if all.criticals.is_empty() {
        // Only between the speeds at which the machine stands something was looked for.
        text.push_str(&match (all.interrupted, all.speeds.as_slice()) {
            (true, _) => "no critical speed was found before the interruption\n".to_owned(),
            (false, [first, .., last]) => {
                let [first, last] = [first, last].map(|own| words::speed(*own));
                format!("no critical speed from {first} to {last} rpm\n")
            }
            _ => "no critical speed is looked for at a single speed\n".to_owned(),
        });
    } else {
        let head =
            ["critical speed (rpm)", "order", "frequency (Hz)", "log decrement", "whirl", "moves"];
        let mut rows = vec![head.map(str::to_owned).to_vec()];
        for (own, way) in all.criticals.iter().zip(&ways.criticals) {
            let whirl = words::whirl(&own.mode, own.speed);
            rows.push(vec![
                words::speed(own.speed),
                Orders::rounded(own.order).to_string(),
                words::hertz(&own.mode),
                words::decrement(&own.mode),
                words::whirl_or_way(whirl, *way).to_owned(),
                words::movers(linear, &own.mode),
            ]);
        }
        text.push_str(&table(&rows));
        text.push_str(&orders.told());
        let damped = all.criticals.iter().filter(|own| own.mode.damping_ratio() > DAMPED);
        let damped: Vec<String> = damped.map(|own| words::speed(own.speed)).collect();
        if !damped.is_empty() {
            let _ = writeln!(
                text,
                "critically damped, the amplification factor 1/(2ζ) being below 2.5: {} rpm",
                damped.join(", ")
            );
        }
    }
    text.push('\n');
    text.push_str(&words::thresholds(linear, all));
    if let Some(own) = &all.reduced {
        let error = whirl_text::shown(own.error, 1, 1e-3..1e4);
        let _ = writeln!(
            text,
            "modes in {} slow motions of {} coordinates, within {error} of those in all",
            own.columns, own.of
        );
    }
    if !all.unclear.is_empty() {
        let at: Vec<String> =
            all.unclear.iter().map(|&step| words::speed(all.speeds[step])).collect();
        let _ = writeln!(
            text,
            "between speeds modes change places so closely that it is not clear which is which: above {} rpm",
            at.join(", ")
        );
    }
    text
}

/// Frequencies over speed, the wider the more they are damped, beside logarithmic decrements over speed.
fn figure(
    case: &Case,
    linear: &LinearMachine,
    of: usize,
    all: &Campbell,
    orders: &Orders,
) -> Figure {
    let body = linear.machine().bodies[of].name();
    let x = format!("speed of {body} (rpm)");
    let mut strokes = strokes(all, &|mode| mode.hertz(), &|mode| width(mode.damping_ratio()));
    let (ceiling, above) = ceiling(all, &orders.values());
    for own in &mut strokes {
        own.line.points.retain(|point| point.1 <= ceiling);
    }
    strokes.retain(|own| !own.line.points.is_empty());
    let points = strokes.iter().flat_map(|own| &own.line.points);
    let highest = points.fold(0.0, |most: f64, own| most.max(own.1));
    let more = match above {
        0 => String::new(),
        own => format!("; {own} more above"),
    };
    let mut frequencies = Panel {
        title: format!("frequencies (wider: ζ above 0.01, 0.05, 0.2){more}"),
        x: x.clone(),
        y: "frequency (Hz)".to_owned(),
        strokes,
        ..Panel::default()
    };
    let ends =
        [all.speeds.first().copied().unwrap_or(0.0), all.speeds.last().copied().unwrap_or(0.0)];
    for order in orders.values() {
        let last = ends[1].min(highest * std::f64::consts::TAU / order);
        if last > ends[0] {
            let at = |speed: f64| (words::rpm(speed), order * speed.abs() / std::f64::consts::TAU);
            frequencies.lines.push(Line {
                points: vec![at(ends[0]), at(last)],
                style: Style::Limit,
                name: "orders of the rotation".to_owned(),
            });
            frequencies.labels.push(Label { at: at(last), text: orders.called(order) });
        }
    }
    // Where several are near each other, unbalance excites the forward one.
    let is_forward = |own: &Critical| own.mode.whirl(own.speed) == Whirl::Forward;
    let (forward, others): (Vec<_>, Vec<_>) = all.criticals.iter().partition(|own| is_forward(own));
    for own in forward.into_iter().chain(others) {
        let at = (words::rpm(own.speed), own.mode.hertz());
        frequencies.dots.push(Dot { at, name: "critical speeds".to_owned() });
        let is_near = |own: &Label| {
            (own.at.0 - at.0).abs() < NEAR * words::rpm(ends[1] - ends[0])
                && (own.at.1 - at.1).abs() < NEAR * highest
        };
        if !frequencies.labels.iter().any(is_near) {
            frequencies.labels.push(Label { at, text: format!("{:.0}", at.0) });
        }
    }
    let threshold = |grows: bool| {
        let own = all.thresholds.iter().filter(move |own| own.grows == grows);
        own.filter_map(|own| Some((words::rpm(own.speed), own.mode.as_ref()?)))
    };
    let mut decrements = Panel {
        title: "damping".to_owned(),
        x,
        y: "logarithmic decrement (1)".to_owned(),
        strokes: self::strokes(all, &|mode| mode.log_decrement(), &|_| THIN),
        levels: vec![Mark { x: 0.0, name: String::new() }],
        ..Panel::default()
    };
    for (grows, style, name) in
        [(true, Style::Fourth, "unstable above"), (false, Style::Third, "stable above")]
    {
        for (speed, mode) in threshold(grows) {
            for (panel, value) in [(&mut frequencies, mode.hertz()), (&mut decrements, 0.0)] {
                let points = vec![(speed, value)];
                let name = name.to_owned();
                panel.clouds.push(Cloud { points, style, radius: 4.5, name });
            }
            decrements.labels.push(Label { at: (speed, 0.0), text: format!("{speed:.0}") });
        }
    }
    Figure {
        title: format!("{}: {}", case.name, case.title),
        panels: vec![frequencies, decrements],
        columns: 2,
    }
}

/// Damping ratio of an amplification factor 1/(2ζ) of 2.5, below which API 617 calls a response critically damped.
const DAMPED: f64 = 0.2;
/// Modes that are drawn in any case, lowest first.
const DRAWN: usize = 5;
/// Multiples of the highest order at the last speed up to which modes are drawn in any case.
const ORDERS: f64 = 5.0;
/// Modes above are left out where they would leave those below less than this share of the panel.
const SQUEEZED: f64 = 0.5;

/// The frequency (Hz) up to which modes are drawn, and how many are above at all speeds.
fn ceiling(all: &Campbell, orders: &[f64]) -> (f64, usize) {
    let highest = |own: &Branch| own.iter().flatten().map(Mode::hertz).fold(0.0, f64::max);
    let mut tops: Vec<f64> = all.branches.iter().map(highest).collect();
    tops.sort_by(f64::total_cmp);
    let order = orders.iter().copied().fold(1.0, f64::max);
    let fastest = all.speeds.iter().map(|own| own.abs()).fold(0.0, f64::max);
    let low = tops.get(DRAWN - 1).copied().unwrap_or(f64::INFINITY);
    let ceiling = low.max(ORDERS * order * fastest / std::f64::consts::TAU);
    if tops.last().is_none_or(|top| SQUEEZED * top <= ceiling) {
        return (f64::INFINITY, 0);
    }
    let lowest = |own: &Branch| own.iter().flatten().map(Mode::hertz).fold(f64::INFINITY, f64::min);
    (ceiling, all.branches.iter().filter(|own| lowest(own) > ceiling).count())
}

/// Critical speeds nearer than this share of both axes have one label.
const NEAR: f64 = 0.04;
/// Of a line (pixels) that says nothing by its width.
const THIN: f64 = 1.4;

/// Of a line by a damping ratio: steps, so that a branch is a few lines and not one a speed.
fn width(ratio: f64) -> f64 {
    match ratio {
        own if own < 0.01 => 0.9,
        own if own < 0.05 => 1.7,
        own if own < 0.2 => 2.7,
        _ => 4.0,
    }
}

/// Branches in pieces by how they whirl, how wide they are, and whether they grow.
fn strokes(all: &Campbell, of: &dyn Fn(&Mode) -> f64, wide: &dyn Fn(&Mode) -> f64) -> Vec<Stroke> {
    let kind = |mode: &Mode, speed: f64| match mode.whirl(speed) {
        _ if mode.grows() => (Style::Doubted, "unstable"),
        Whirl::Forward => (Style::First, "forward whirl"),
        Whirl::Backward => (Style::Second, "backward whirl"),
        Whirl::None => (Style::Third, "neither"),
    };
    let mut strokes: Vec<Stroke> = Vec::new();
    for branch in &all.branches {
        let mut last: Option<(Style, f64, (f64, f64))> = None;
        for (mode, &speed) in branch.iter().zip(&all.speeds) {
            let Some(mode) = mode else {
                last = None;
                continue;
            };
            let ((style, name), width) = (kind(mode, speed), wide(mode));
            let point = (words::rpm(speed), of(mode));
            match (&last, strokes.last_mut()) {
                (Some((own, as_wide, _)), Some(stroke)) if (*own, *as_wide) == (style, width) => {
                    stroke.line.points.push(point);
                }
                (before, _) => {
                    let points = before.iter().map(|own| own.2).chain([point]).collect();
                    let line = Line { points, style, name: name.to_owned() };
                    strokes.push(Stroke { line, width });
                }
            }
            last = Some((style, width, point));
        }
    }
    strokes
}
