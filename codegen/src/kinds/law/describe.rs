//! The report of a law as text.

use std::fmt;

use super::report::{Break, LawReport, OutputReport, StateReport, TableReport, Trend};
use super::table::Extend;

/// A number to 6 digits, for people.
pub fn short(x: f64) -> String {
    whirl_text::shown(x, 6, 1e-5..1e7)
}

/// The unit of a slope.
pub(super) fn per(unit: &str, input: &str) -> String {
    let bracketed = |text: &str| match text.contains(['*', '/']) {
        true => format!("({text})"),
        false => text.to_owned(),
    };
    match input {
        "1" => unit.to_owned(),
        _ => format!("{unit}/{}", bracketed(input)),
    }
}

impl fmt::Display for Trend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Trend::Constant => "does not change",
            Trend::Rising => "never falls",
            Trend::Falling => "never rises",
            Trend::Mixed => "rises and falls",
        })
    }
}

/// One fact a line.
impl fmt::Display for LawReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ranges: Vec<String> = (self.ranges.iter())
            .map(|(name, unit, [low, high])| {
                format!("{name} from {} to {} {unit}", short(*low), short(*high))
            })
            .collect();
        for table in &self.tables {
            writeln!(f, "{table}")?;
        }
        for output in &self.outputs {
            let OutputReport { name, unit, points, extent: [least, most], .. } = output;
            let how = match points {
                0 => "exactly".to_owned(),
                _ => format!("sampled at {points} points"),
            };
            writeln!(f, "{name} over {} ({how}):", ranges.join(", "))?;
            let sign = if *least >= 0.0 {
                "never negative"
            } else if *most <= 0.0 {
                "never positive"
            } else {
                "of both signs"
            };
            writeln!(f, "  {} to {} {unit}, {sign}", short(*least), short(*most))?;
            for (input, trend) in &output.trends {
                writeln!(f, "  {trend} with rising {input}")?;
            }
            if let Some((motion, opposes)) = &output.opposes {
                let never = if *opposes { "never drives" } else { "drives in places" };
                writeln!(f, "  {never} {motion}: {name}*{motion} is the power that it gives")?;
            }
            for found in &output.breaks {
                found.write(f, unit)?;
            }
            for (input, at) in &output.poles {
                writeln!(f, "  pole at {input} = {}", short(*at))?;
            }
            if let Some(point) = &output.undefined {
                let point: Vec<String> = point.iter().map(|x| short(*x)).collect();
                writeln!(f, "  no finite value at ({})", point.join(", "))?;
            }
        }
        for state in &self.states {
            writeln!(f, "{state}")?;
        }
        Ok(())
    }
}

impl fmt::Display for StateReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let StateReport { name, rates: [least, most] } = self;
        match (*least, *most) {
            (0.0, 0.0) => write!(f, "{name} does not come to rest by itself"),
            (least, most) if least == most && least > 0.0 => {
                write!(f, "{name} relaxes at {} 1/s", short(least))
            }
            (least, most) if least >= 0.0 => {
                write!(f, "{name} relaxes at {} to {} 1/s", short(least), short(most))
            }
            (least, most) if most <= 0.0 => {
                write!(f, "{name} grows at {} to {} 1/s", short(-most), short(-least))
            }
            (least, most) => write!(
                f,
                "{name} relaxes at up to {} 1/s, and grows at up to {} 1/s in places",
                short(most),
                short(-least)
            ),
        }
    }
}

impl LawReport {
    /// What a user of the law should know of it: values that jump, poles, springs that pull or have a negative stiffness,
    /// friction that drives. Most laws have nothing of this.
    pub fn remarks(&self) -> Vec<String> {
        self.outputs.iter().flat_map(OutputReport::remarks).collect()
    }
}

impl OutputReport {
    fn remarks(&self) -> Vec<String> {
        let OutputReport { name, unit, extent: [least, _], .. } = self;
        let mut all = Vec::new();
        if name == "Q" && *least < 0.0 {
            let least = short(*least);
            all.push(format!("`Q` pulls journal and bore together in places: {least} {unit}"));
        }
        let over_gap = self.trends.iter().find(|(input, _)| name == "Q" && input == "h");
        if let Some((_, Trend::Rising | Trend::Mixed)) = over_gap {
            all.push("`Q` rises with rising h in places: a negative stiffness".to_owned());
        }
        if let Some((motion, false)) = self.opposes.as_ref().filter(|_| name == "T") {
            all.push(format!("`T` drives {motion} in places, which friction opposes"));
        }
        let jumps = self.breaks.iter().filter(|found| found.jumps());
        all.extend(jumps.map(|found| found.words(name, unit)));
        let poles = self.poles.iter();
        all.extend(
            poles.map(|(input, at)| format!("`{name}` has a pole at {input} = {}", short(*at))),
        );
        if self.undefined.is_some() {
            all.push(format!("`{name}` has no finite value in places"));
        }
        all
    }
}

impl fmt::Display for TableReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let TableReport { name, file, rows, input: [input, unit], span: [first, last], extend } =
            self;
        let (first, last) = (short(*first), short(*last));
        let beyond = match extend {
            Extend::Constant => "constant beyond",
            Extend::Linear => "straight beyond",
            Extend::Periodic => "repeated beyond",
            Extend::Refuse => "no value beyond",
        };
        write!(
            f,
            "{name}: monotone cubic through {rows} rows of {file}, {input} from {first} to {last} {unit}, \
             continuous slope, {beyond}"
        )
    }
}

impl Break {
    /// The jump of an output in words.
    pub(super) fn words(&self, name: &str, unit: &str) -> String {
        let size = short((self.values[1] - self.values[0]).abs());
        let per = per(unit, &self.unit);
        let [below, above] = [0, 1].map(|side| {
            format!(
                "{} {unit} with slope {} {per}",
                short(self.values[side]),
                short(self.slopes[side])
            )
        });
        let places = std::iter::once((&self.input, self.at, &self.unit))
            .chain(self.beside.iter().map(|(input, at, unit)| (input, *at, unit)))
            .map(|(input, at, unit)| format!("{input} = {} {unit}", short(at)));
        let place = places.collect::<Vec<_>>().join(", ");
        format!("`{name}` jumps by {size} {unit} at {place}: {below} below, {above} above")
    }

    /// One line, with the unit of the output.
    fn write(&self, f: &mut fmt::Formatter<'_>, unit: &str) -> fmt::Result {
        write!(f, "  break at {} = {} {}", self.input, short(self.at), self.unit)?;
        if let Some(from) = self.moved_from {
            write!(f, " (moved from {})", short(from))?;
        }
        if let Some(length) = self.blended {
            write!(f, " (blended over {} {})", short(length), self.unit)?;
        }
        let [below, above] = self.values.map(short);
        if self.jumps() {
            write!(f, ": value {below} to {above} {unit}")?;
        } else {
            write!(f, ": no jump")?;
        }
        let [below, above] = self.slopes.map(short);
        let per = per(unit, &self.unit);
        writeln!(f, ", slope {below} to {above} {per}")
    }
}
