//! What an analysis comes to for programs: numbers under names of their own, as tables of sweeps have them, and notes.

use whirl_solver::linear::{Campbell, Critical, Doubt, JointCoefficients, Mode, Modes, Whirl};
use whirl_solver::linear::{Threshold, Through, Undamped};

use super::orders::Orders;
use super::words;

/// Numbers and notes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Facts {
    /// By names that end with the unit, or with a place from 1 after it; NaN where there is none.
    pub(crate) numbers: Vec<(String, f64)>,
    /// What limits their worth, a line each.
    pub(crate) notes: Vec<String>,
}

/// Lists of a column in a file of joints: stiffness and damping along x and y.
pub(super) const COEFFICIENTS: [&str; 8] = [
    "k_xx_N_m",
    "k_xy_N_m",
    "k_yx_N_m",
    "k_yy_N_m",
    "c_xx_Ns_m",
    "c_xy_Ns_m",
    "c_yx_Ns_m",
    "c_yy_Ns_m",
];

impl Facts {
    /// Adds a number, or that there is none.
    pub(super) fn put(&mut self, name: impl Into<String>, value: impl Into<Option<f64>>) {
        self.numbers.push((name.into(), value.into().unwrap_or(f64::NAN)));
    }

    /// Adds what is to be said, if there is something.
    pub(super) fn note(&mut self, words: &str) {
        let words = words.trim();
        let words = words.strip_prefix("note: ").unwrap_or(words);
        if !words.is_empty() && !self.notes.iter().any(|own| own == words) {
            self.notes.push(words.to_owned());
        }
    }

    /// Adds lines of them.
    pub(super) fn lines(&mut self, words: &str) {
        words.lines().for_each(|line| self.note(line));
    }

    /// Adds what limits modes.
    pub(super) fn doubts(&mut self, all: &[Doubt]) {
        all.iter().for_each(|own| self.note(&own.to_string()));
    }

    /// Of modes over speeds: critical speeds and stability.
    pub(super) fn of_campbell(all: &Campbell, known: &Orders) -> Facts {
        let mut facts = Facts::default();
        let mut orders: Vec<f64> = all.criticals.iter().map(|own| own.order).collect();
        orders.push(1.0);
        orders.sort_by(f64::total_cmp);
        orders.dedup();
        for order in orders {
            let own = all.criticals.iter().filter(|own| own.order == order);
            let own: Vec<&Critical> = own.collect();
            let forward = own.iter().filter(|own| own.mode.whirl(own.speed) == Whirl::Forward);
            // Those of other bodies by their names: with their ratio the order may vary from point to point of a sweep.
            let way = match known.called(order) {
                own if own == "1X" => String::new(),
                own => format!("{}.", own.replace("1X of ", "").replace(", ", "+")),
            };
            facts.each(&format!("critical_rpm.{way}"), own.iter().map(|own| words::rpm(own.speed)));
            let decrements = own.iter().map(|own| own.mode.log_decrement());
            facts.each(&format!("critical_log_decrement.{way}"), decrements);
            let forward = forward.map(|own| words::rpm(own.speed));
            facts.each(&format!("forward_critical_rpm.{way}"), forward);
        }
        facts.stability(all);
        facts
    }

    /// Of the least stable motion over speeds.
    pub(super) fn of_stability(all: &Campbell) -> Facts {
        let mut facts = Facts::default();
        facts.stability(all);
        facts
    }

    /// A number each, from 1 on; where there are none, one that says so.
    pub(super) fn each(&mut self, name: &str, values: impl Iterator<Item = f64>) {
        let before = self.numbers.len();
        for (place, value) in values.enumerate() {
            self.put(format!("{name}{}", place + 1), value);
        }
        if self.numbers.len() == before {
            self.put(format!("{name}1"), None);
        }
    }

    fn stability(&mut self, all: &Campbell) {
        let first = all.thresholds.iter().find(|own| own.grows);
        let mode = |own: &Threshold| own.mode.clone();
        let found = first.and_then(mode);
        self.put("threshold_rpm", first.map(|own| words::rpm(own.speed)));
        self.put("threshold_hz", found.as_ref().map(Mode::hertz));
        let ratio = first.zip(found.as_ref()).map(|(own, mode)| mode.value.im / own.speed.abs());
        self.put("threshold_whirl_ratio", ratio);
        let mut least: Option<(f64, f64)> = None;
        for branch in &all.branches {
            for (mode, speed) in branch.iter().zip(&all.speeds) {
                let Some(decrement) = mode.as_ref().map(Mode::log_decrement) else { continue };
                if least.is_none_or(|own| decrement < own.0) {
                    least = Some((decrement, words::rpm(*speed)));
                }
            }
        }
        self.put("least_log_decrement", least.map(|own| own.0));
        self.put("least_log_decrement_rpm", least.map(|own| own.1));
        let stable = all.growing.iter().all(Option::is_none) && first.is_none();
        self.put("stable", truth(stable));
        if let (Some(Some(_)), Some(speed)) = (all.growing.first(), all.speeds.first()) {
            self.note(&format!("UNSTABLE at the first speed, {} rpm", words::speed(*speed)));
        }
        if let Some((_, error)) = all.lost.last() {
            let speeds: Vec<String> = all.lost.iter().map(|own| words::speed(own.0)).collect();
            self.note(&format!("left out: {} rpm, as {error}", speeds.join(", ")));
        }
        if !all.unclear.is_empty() {
            let at = all.unclear.iter().map(|&step| words::speed(all.speeds[step]));
            let at = at.collect::<Vec<_>>().join(", ");
            self.note(&format!("not clear which mode is which above {at} rpm"));
        }
        self.doubts(&all.doubts);
    }

    /// Of the modes at a speed: the first of them.
    pub(super) fn modes(&mut self, modes: &Modes, count: usize) {
        let listed = &modes.oscillating[..modes.oscillating.len().min(count)];
        self.numbers.clear();
        self.each("frequency_hz.", listed.iter().map(Mode::hertz));
        self.each("log_decrement.", listed.iter().map(Mode::log_decrement));
        let least = listed.iter().map(Mode::log_decrement).reduce(f64::min);
        self.put("least_log_decrement", least);
        self.put("stable", truth(modes.is_stable()));
    }

    /// Of a joint at a speed.
    pub(super) fn joint(&mut self, label: &str, own: &JointCoefficients, values: [f64; 8]) {
        for (name, value) in COEFFICIENTS.into_iter().zip(values) {
            self.put(format!("{label}.{name}"), value);
        }
        self.put(format!("{label}.eccentricity_ratio"), own.eccentricity);
        self.put(format!("{label}.attitude_deg"), own.attitude.map(f64::to_degrees));
        let [x, y] = own.force;
        self.put(format!("{label}.force_x_N"), x);
        self.put(format!("{label}.force_y_N"), y);
    }

    /// Of a bearing with bodies of its own, at an order of the speed.
    pub(super) fn bearing(&mut self, order: f64, own: &Through) {
        let order =
            if order == 1.0 { String::new() } else { format!("{}X.", Orders::rounded(order)) };
        let label = own.joints.join("+");
        let values = [own.stiffness, own.damping].into_iter().flatten().flatten();
        for (name, value) in COEFFICIENTS.into_iter().zip(values) {
            self.put(format!("{label}.{order}{name}"), value);
        }
    }

    /// Of undamped critical speeds at a stiffness.
    pub(super) fn undamped(&mut self, all: &[Undamped], is_forward: impl Fn(&Undamped) -> bool) {
        self.numbers.clear();
        self.each("critical_rpm.", all.iter().map(|own| words::rpm(own.speed())));
        let forward = all.iter().filter(|own| is_forward(own)).map(|own| words::rpm(own.speed()));
        self.each("forward_critical_rpm.", forward);
    }
}

/// 1 or 0.
pub(super) fn truth(is: bool) -> f64 {
    f64::from(u8::from(is))
}
