//! The report of a law as text.

use std::fmt;

use super::report::{Break, LawReport, OutputReport, Trend};

/// A number to 6 digits.
pub(super) fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    if rounded != 0.0 && !(1e-5..1e7).contains(&rounded.abs()) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
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
        for output in &self.outputs {
            let OutputReport { name, unit, points, extent: [least, most], .. } = output;
            writeln!(f, "{name} over {} ({points} points):", ranges.join(", "))?;
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
            for found in &output.breaks {
                writeln!(f, "  {found}, {unit}")?;
            }
            for (input, at) in &output.poles {
                writeln!(f, "  pole at {input} = {}", short(*at))?;
            }
            if let Some(point) = &output.undefined {
                let point: Vec<String> = point.iter().map(|x| short(*x)).collect();
                writeln!(f, "  no finite value at ({})", point.join(", "))?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Break {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "break at {} = {} {}", self.input, short(self.at), self.unit)?;
        if let Some(from) = self.moved_from {
            write!(f, " (moved from {})", short(from))?;
        }
        let [below, above] = self.values.map(short);
        if self.jumps() {
            write!(f, ": value {below} to {above}")?;
        } else {
            write!(f, ": no jump")?;
        }
        write!(f, ", slope {} to {}", short(self.slopes[0]), short(self.slopes[1]))
    }
}
