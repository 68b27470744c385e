//! Figures of analyses: marks stand where the files of results have them.

use std::fs::read_to_string;

use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// Pixels by which a mark may be off, as coordinates and labels of axes have two digits.
const OFF: f64 = 0.6;
/// Colour of marked points.
const DOT: &str = "#d62728";

/// A panel of a figure, as its SVG has it.
struct Panel {
    text: String,
    /// Pixels at 0, and of a unit.
    x: (f64, f64),
    y: (f64, f64),
}

impl Panel {
    /// With axes by the numbers that stand at their ticks.
    fn read(text: &str) -> Panel {
        let ticks = |anchor: &str, axis: &str| -> (f64, f64) {
            let sought = format!("font-size=\"11\" text-anchor=\"{anchor}\"");
            let own = text.split("<text ").skip(1).filter(|own| own.contains(&sought));
            let own = own.filter_map(|own| {
                let value = own.split_once('>')?.1.split('<').next()?.parse::<f64>().ok()?;
                Some((attribute(own, axis)?, value))
            });
            let all: Vec<(f64, f64)> = own.collect();
            let [(a, first), .., (b, last)] = all.as_slice() else { return (0.0, 0.0) };
            let unit = (b - a) / (last - first);
            (a - first * unit, unit)
        };
        let (zero, unit) = ticks("end", "y");
        // Numbers stand a little below their lines: the one at the ends of lines tells by how much.
        let axis = text.split("<line ").skip(1).filter_map(|own| {
            let level = attribute(own, "y1")?;
            (attribute(own, "y2")? == level).then_some(level)
        });
        let shift = axis.map(|level| zero_shift(text, level)).find_map(|own| own).unwrap_or(0.0);
        Panel { text: text.to_owned(), x: ticks("middle", "x"), y: (zero - shift, unit) }
    }

    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.x.0 + self.x.1 * x, self.y.0 + self.y.1 * y)
    }

    /// Centres of circles of a colour; those of the legend, behind the last panel, are larger.
    fn circles(&self, colour: &str) -> Vec<(f64, f64)> {
        let own = self.text.split("<circle ").skip(1).filter_map(|own| own.split('>').next());
        let own = own.filter(|own| own.contains(colour) && !own.contains("r=\"5\""));
        own.filter_map(|own| Some((attribute(own, "cx")?, attribute(own, "cy")?))).collect()
    }

    /// Points of lines of a colour.
    fn lines(&self, colour: &str) -> Vec<Vec<(f64, f64)>> {
        let own = self.text.split("<path d=\"").skip(1);
        let own = own.filter(|own| own.split('>').next().is_some_and(|own| own.contains(colour)));
        let points = |own: &str| {
            let values: Vec<f64> = own
                .split('"')
                .next()
                .unwrap_or("")
                .split(' ')
                .filter_map(|own| own.parse().ok())
                .collect();
            values.chunks(2).map(|own| (own[0], own[1])).collect()
        };
        own.map(points).collect()
    }

    fn has(&self, words: &str) -> bool {
        self.text.contains(&format!(">{words}<"))
    }
}

/// How far below a level of the axis its number stands.
fn zero_shift(text: &str, level: f64) -> Option<f64> {
    let own = text.split("<text ").skip(1).filter(|own| own.contains("text-anchor=\"end\""));
    let away = own.filter_map(|own| Some(attribute(own, "y")? - level));
    away.filter(|own| (0.0..6.0).contains(own)).min_by(f64::total_cmp)
}

fn attribute(text: &str, name: &str) -> Option<f64> {
    let (_, rest) = text.split_once(&format!("{name}=\""))?;
    rest.split('"').next()?.parse().ok()
}

/// The panels of a figure.
fn panels(workbench: &Workbench, path: &str) -> Vec<Panel> {
    let text = read_to_string(workbench.path(path)).expect("a figure");
    assert!(text.ends_with("</svg>") && !text.contains("NaN"), "{path}");
    assert!(workbench.path(&path.replace(".svg", ".png")).is_file(), "{path}");
    text.split("<g transform=").skip(1).map(Panel::read).collect()
}

/// Whether a mark is there.
fn stands(all: &[(f64, f64)], at: (f64, f64)) -> bool {
    all.iter().any(|own| (own.0 - at.0).abs() < OFF && (own.1 - at.1).abs() < OFF)
}

#[test]
fn campbell_diagrams_mark_what_their_files_have() {
    let workbench = Workbench::new();
    ran(&workbench, &["analyse", "weight", "campbell", "--out", "out"]);
    let file = "out/campbell.critical.csv";
    let what = column(&workbench, file, "what");
    let [speeds, hertz] = ["speed_rpm", "frequency_hz"].map(|name| numbers(&workbench, file, name));
    let all = panels(&workbench, "out/campbell.svg");
    let [diagram, damping] = all.as_slice() else { panic!("{} panels", all.len()) };
    let critical = diagram.circles(DOT);
    let thresholds = [diagram, damping].map(|own| own.circles("#8a3ea8"));
    let mut found = [0, 0];
    for ((what, speed), hertz) in what.iter().zip(&speeds).zip(&hertz) {
        let at = diagram.at(*speed, *hertz);
        if what == "critical speed" {
            found[0] += 1;
            assert!(stands(&critical, at), "{speed}: {at:?} {critical:?}");
        } else {
            found[1] += 1;
            assert!(stands(&thresholds[0], at), "{speed}: {at:?} {:?}", thresholds[0]);
            assert!(stands(&thresholds[1], damping.at(*speed, 0.0)), "{speed}");
            assert!(damping.has(&format!("{speed:.0}")));
        }
    }
    assert!(found[0] >= 3 && found[1] == 1, "{found:?}");
    assert_eq!(critical.len(), found[0]);
    // Order lines, and curves by whirl, damping and growth: what grows is red beyond the threshold only.
    assert!(diagram.has("1X") && diagram.has("0.5X"));
    assert!(!diagram.lines("#1f4e9c").is_empty() && !diagram.lines("#d9730d").is_empty());
    let threshold = damping.at(6183.28, 0.0).0;
    let growing = damping.lines(DOT);
    assert!(!growing.is_empty());
    for (x, y) in growing.iter().flat_map(|own| own.iter().skip(1)) {
        assert!(*x > threshold && *y > damping.at(0.0, 0.0).1, "{x} {y}");
    }
    let widths = ["1.7", "2.7", "4"].map(|own| format!("stroke-width=\"{own}\""));
    let wide = widths.iter().filter(|own| diagram.text.contains(*own)).count();
    assert!(wide >= 2, "{wide} widths");
}

#[test]
fn root_loci_go_through_the_eigenvalues() {
    let workbench = Workbench::new();
    ran(&workbench, &["analyse", "weight", "stability", "--out", "out"]);
    ran(
        &workbench,
        &["campbell", "weight", "--speeds", "3000 rpm .. 9000 rpm, 25", "--out", "out"],
    );
    let [re, im] =
        ["real_1_s", "imaginary_1_s"].map(|name| numbers(&workbench, "out/campbell.csv", name));
    for path in ["out/campbell.roots.svg", "out/stability.roots.svg"] {
        let all = panels(&workbench, path);
        let [panel] = all.as_slice() else { panic!("{} panels", all.len()) };
        let circles = panel.circles("fill=\"#");
        for (re, im) in re.iter().zip(&im) {
            assert!(stands(&circles, panel.at(*re, *im)), "{path}: {re} {im}");
        }
    }
    // The axis Re λ = 0 is between the roots before and beyond the threshold.
    let roots = panels(&workbench, "out/stability.roots.svg");
    assert!(re.iter().any(|own| *own > 0.0) && roots[0].text.contains("stroke-dasharray"));
    let all = panels(&workbench, "out/stability.svg");
    let threshold = numbers(&workbench, "out/stability.thresholds.csv", "speed_rpm")[0];
    assert!(stands(&all[0].circles(DOT), all[0].at(threshold, 0.0)));
    assert!(all[0].has("6183 rpm"));
}

#[test]
fn bode_plots_mark_peaks_with_speed_and_amplification() {
    let workbench = Workbench::new();
    ran(&workbench, &["analyse", "unbalance", "response", "--out", "out"]);
    let file = "out/response.peaks.csv";
    let points = column(&workbench, file, "point");
    let names = ["speed_rpm", "major_um", "amplification_factor"];
    let [speeds, heights, factors] = names.map(|name| numbers(&workbench, file, name));
    let all = panels(&workbench, "out/response.svg");
    let [amplitude, phase] = all.as_slice() else { panic!("{} panels", all.len()) };
    assert!(amplitude.has("major semi-axis (µm, zero to peak)") && phase.has("phase (deg)"));
    let circles = amplitude.circles(DOT);
    // The largest of each of the two groups of peaks.
    for group in [2000.0..3000.0, 9000.0..10000.0] {
        let own = (0..points.len()).filter(|own| group.contains(&speeds[*own]));
        let most = own.max_by(|a, b| heights[*a].total_cmp(&heights[*b])).expect("a peak");
        let at = amplitude.at(speeds[most], heights[most]);
        assert!(stands(&circles, at), "{at:?} {circles:?}");
        let factor = factors[most];
        let factor = if factor > 70.0 { format!("{factor:.0}") } else { format!("{factor:.1}") };
        assert!(amplitude.has(&format!("{:.1} rpm, AF {factor}", speeds[most])), "{factor}");
    }
    // Curves reach the peaks, which lie between speeds of the table.
    let curve = |colour: &str| {
        let all = amplitude.lines(colour);
        all.iter().flatten().map(|own| own.1).fold(f64::INFINITY, f64::min)
    };
    let top = circles.iter().map(|own| own.1).fold(f64::INFINITY, f64::min);
    assert!((curve("#2a7f3f") - top).abs() < OFF, "{} {top}", curve("#2a7f3f"));
    // Phases have no jumps of whole turns.
    for own in phase.lines("#1f4e9c") {
        let turn = 180.0 * phase.y.1.abs();
        assert!(own.windows(2).all(|own| (own[1].1 - own[0].1).abs() < turn));
    }
    let polar = panels(&workbench, "out/response.polar.svg");
    let [major, x, degrees] = ["major_um", "x_um", "x_phase_deg"]
        .map(|name| numbers(&workbench, "out/response.csv", name));
    let rows = column(&workbench, "out/response.csv", "point");
    for (panel, point) in polar.iter().zip(["joint.left", "joint.right", "output.left"]) {
        assert!(panel.has(&format!("{point}: order 1 of rotor")));
        let line = panel.lines("#1f4e9c").concat();
        for k in (0..rows.len()).filter(|k| rows[*k] == point) {
            let phase = degrees[k].to_radians();
            assert!(stands(&line, panel.at(x[k] * phase.cos(), x[k] * phase.sin())), "{point} {k}");
            assert!(x[k] <= major[k] * (1.0 + 1e-9));
        }
    }
    let orbits = panels(&workbench, "out/response.orbits.svg");
    assert_eq!(orbits.len(), 4);
    for (panel, point) in orbits.iter().zip(["joint.left", "joint.right", "output.left"]) {
        let own = (0..points.len()).filter(|own| points[*own] == point);
        let radii: Vec<f64> = own.map(|own| heights[own]).collect();
        let widths = ["#1f4e9c", "#d9730d"].map(|colour| {
            let all = panel.lines(colour).concat();
            let ends = all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), own| {
                (own.0.min(least), own.0.max(most))
            });
            0.5 * (ends.1 - ends.0) / panel.x.1
        });
        // Orbits of a round machine are circles; both are at one speed for all points.
        for (width, radius) in widths.iter().zip(&radii) {
            assert!((width / radius - 1.0).abs() < 0.02, "{point}: {width} {radius}");
        }
        assert_eq!(panel.circles(DOT).len(), 2);
        assert!(panel.has("forward"));
    }
}

#[test]
fn probes_read_along_their_directions() {
    let workbench = Workbench::new();
    ran(&workbench, &["analyse", "weight", "response", "--out", "out"]);
    let names = ["x_um", "x_phase_deg", "y_um", "y_phase_deg"];
    let [x, along, y, across] = names.map(|name| numbers(&workbench, "out/response.csv", name));
    let file = "out/response.probes.csv";
    let names = ["probe_deg", "amplitude_um", "phase_deg"];
    let [angle, amplitude, phase] = names.map(|name| numbers(&workbench, file, name));
    assert_eq!(angle.len(), 2 * x.len());
    for k in 0..angle.len() {
        assert_eq!(angle[k], if k % 2 == 0 { 45.0 } else { 135.0 });
        let (sin, cos) = angle[k].to_radians().sin_cos();
        let part = |wave: fn(f64) -> f64| {
            let row = k / 2;
            cos * x[row] * wave(along[row].to_radians())
                + sin * y[row] * wave(across[row].to_radians())
        };
        let (re, im) = (part(f64::cos), part(f64::sin));
        assert!((amplitude[k] / re.hypot(im) - 1.0).abs() < 1e-9);
        assert!(
            (im.atan2(re).to_degrees() - phase[k])
                .rem_euclid(360.0)
                .min((phase[k] - im.atan2(re).to_degrees()).rem_euclid(360.0))
                < 1e-6
        );
    }
    let all = panels(&workbench, "out/response.svg");
    assert!(all[0].has("probe (µm, zero to peak)"));
    let text = read_to_string(workbench.path("out/response.svg")).expect("a figure");
    assert!(text.contains("joint.left at 45°") && text.contains("joint.left at 135°"));
}

#[test]
fn shapes_show_orbits_of_every_body() {
    let workbench = Workbench::new();
    ran(&workbench, &["analyse", "unbalance", "modes", "--out", "out"]);
    let whirl = column(&workbench, "out/modes.csv", "whirl");
    let all = panels(&workbench, "out/modes.svg");
    assert_eq!(all.len(), 7);
    for (panel, whirl) in all.iter().zip(&whirl) {
        // Where a shape has a node an orbit is small, and may go round otherwise.
        let count = |colour: &str| panel.lines(colour).len();
        let [forward, backward, flat] = ["#1f4e9c", "#d9730d", "#2a7f3f"].map(count);
        assert_eq!(panel.circles(DOT).len(), forward + backward + flat);
        match whirl.as_str() {
            "forward" => {
                assert!(forward >= 6 && backward + flat <= 1, "{forward} {backward} {flat}")
            }
            "backward" => {
                assert!(backward >= 6 && forward + flat <= 1, "{forward} {backward} {flat}")
            }
            _ => {
                assert_eq!((forward, backward, flat), (0, 0, 0));
                assert!(panel.text.contains("along or about z"));
            }
        }
        // The first bending mode is a half wave: its largest ellipse is in the middle.
        assert!(!panel.lines("#222222").is_empty());
        assert!(panel.has("z (mm); x up, y to the viewer"));
    }
    let heights: Vec<f64> = all[0]
        .lines("#d9730d")
        .iter()
        .map(|own| {
            let ends = own.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), own| {
                (own.1.min(least), own.1.max(most))
            });
            ends.1 - ends.0
        })
        .collect();
    let most = heights.iter().copied().fold(0.0, f64::max);
    let middle = heights[heights.len() / 2];
    assert!((middle / most - 1.0).abs() < 1e-3, "{heights:?}");
    assert!(heights[0] < 0.3 * most && heights[heights.len() - 1] < 0.3 * most, "{heights:?}");
    ran(&workbench, &["analyse", "turbocharger", "modes", "--out", "many"]);
    let text = read_to_string(workbench.path("many/modes.svg")).expect("a figure");
    for body in ["rotor", "ring1", "ring2", "housing", "start of the orbit", "orbit, forward"] {
        assert!(text.contains(&format!(">{body}<")), "{body}");
    }
}

#[test]
fn coefficients_stand_in_two_panels() {
    let workbench = Workbench::new();
    ran(&workbench, &["analyse", "weight", "coefficients", "--out", "out"]);
    let speeds = numbers(&workbench, "out/coefficients.left.csv", "speed [rpm]");
    let all = panels(&workbench, "out/coefficients.svg");
    assert_eq!(all.len(), 4);
    for (panel, scale, names) in [
        (&all[0], 1e6, ["k_xx [N/m]", "k_xy [N/m]", "k_yx [N/m]", "k_yy [N/m]"]),
        (&all[1], 1e3, ["c_xx [N*s/m]", "c_xy [N*s/m]", "c_yx [N*s/m]", "c_yy [N*s/m]"]),
    ] {
        for (name, colour) in names.into_iter().zip(["#1f4e9c", "#d9730d", "#2a7f3f", "#8a3ea8"]) {
            let line = panel.lines(colour).concat();
            let values = numbers(&workbench, "out/coefficients.left.csv", name);
            for (speed, value) in speeds.iter().zip(values) {
                assert!(stands(&line, panel.at(*speed, value / scale)), "{name} at {speed}");
            }
        }
    }
    assert!(all[0].has("K (1e6 N/m)") && all[1].has("C (1e3 N s/m)"));
}

/// One speed, one mode, no peaks: figures that say what there is, or none.
#[test]
fn figures_of_little_are_drawn() {
    let workbench = Workbench::new();
    let one = ["--speeds", "7000 rpm", "--out", "one"];
    for kind in ["campbell", "stability", "coefficients", "response"] {
        ran(&workbench, &[&[kind, "weight"], one.as_slice()].concat());
    }
    ran(&workbench, &[&["modes", "weight", "--count", "1"], one.as_slice()].concat());
    assert!(!workbench.path("one/coefficients.svg").is_file());
    assert!(!workbench.path("one/stability.svg").is_file());
    assert_eq!(panels(&workbench, "one/modes.svg").len(), 1);
    // At one speed a response is its orbits.
    let orbits = panels(&workbench, "one/response.svg");
    assert!(orbits.len() == 2 && orbits[0].has("x (µm)"));
    ran(&workbench, &["response", "weight", "--speeds", "4000 rpm .. 6000 rpm, 5", "--out", "two"]);
    assert_eq!(panels(&workbench, "two/response.svg")[0].circles(DOT).len(), 0);
    assert!(!workbench.path("two/response.orbits.svg").is_file());
    let again = || read_to_string(workbench.path("two/response.polar.svg")).expect("a figure");
    let first = again();
    ran(&workbench, &["response", "weight", "--speeds", "4000 rpm .. 6000 rpm, 5", "--out", "two"]);
    assert_eq!(first, again());
    ran(&workbench, &["response", "weight", "--no-figures", "--out", "three"]);
    assert!(workbench.listing_of("three").iter().all(|own| !own.ends_with("svg")));
}
