//! How much memory a factorisation may take, with what stands beside it.

/// Bytes that may be in use while a sparse matrix is factored and what follows is done with its factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryLimit {
    /// Bytes at most.
    pub most: usize,
    /// What is in use at a time; that which takes the most counts.
    pub stages: [Stage; 2],
}

/// What is in use at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stage {
    /// Factors of one pattern.
    pub factors: usize,
    /// Further bytes.
    pub besides: usize,
}

impl From<usize> for MemoryLimit {
    /// For one factor alone.
    fn from(most: usize) -> MemoryLimit {
        MemoryLimit { most, stages: [Stage { factors: 1, besides: 0 }; 2] }
    }
}

impl MemoryLimit {
    /// Bytes in use at most, with factors of so many bytes each.
    pub(super) fn estimate(&self, factor: usize) -> usize {
        let of = |own: &Stage| own.factors.saturating_mul(factor).saturating_add(own.besides);
        self.stages.iter().map(of).max().unwrap_or(0)
    }
}

/// Bytes as people say them: `2.81 GiB`.
pub fn readable_bytes(bytes: usize) -> String {
    let (value, unit) = in_units(bytes);
    let digits = if value < 10.0 { 2 } else { usize::from(value < 100.0) };
    format!("{value:.digits$} {unit}")
}

/// How much memory something takes: `about 2.9 GiB of memory`; as many bytes as there are numbers stand for more than there is.
pub fn readable_need(bytes: usize) -> String {
    match bytes {
        usize::MAX => "more memory than the system gives".to_owned(),
        _ => format!("about {} of memory", readable_estimate(bytes)),
    }
}

/// Bytes that are estimated, rounded up to two digits, as no more of them is known: `2.9 GiB`.
pub fn readable_estimate(bytes: usize) -> String {
    let (value, unit) = in_units(bytes);
    let step = if value < 10.0 { 0.1 } else { 10_f64.powf(value.log10().floor() - 1.0) };
    let digits = usize::from(value < 10.0);
    format!("{:.digits$} {unit}", (value / step).ceil() * step)
}

fn in_units(bytes: usize) -> (f64, &'static str) {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    let mut value = bytes as f64 / 1024.0;
    let mut unit = 0;
    while value >= 1000.0 && unit + 1 < UNITS.len() {
        value /= 1024.0;
        unit += 1;
    }
    (value, UNITS[unit])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_stage_counts() {
        let few = Stage { factors: 1, besides: 50 };
        let many = Stage { factors: 2, besides: 30 };
        let limit = MemoryLimit { most: 100, stages: [few, many] };
        assert_eq!([10, 20, 30].map(|factor| limit.estimate(factor)), [60, 70, 90]);
        assert_eq!(limit.estimate(usize::MAX), usize::MAX);
    }

    #[test]
    fn bytes_are_shown_with_three_digits() {
        let shown = [1000, 3 << 20, 12_345_678, 3_000_000_000, usize::MAX].map(readable_bytes);
        assert_eq!(shown[..4], ["0.98 KiB", "3.00 MiB", "11.8 MiB", "2.79 GiB"]);
        assert!(shown[4].ends_with(" TiB"));
        let about = [1000, 3 << 20, 12_345_678, 145_000_000, 3_000_000_000].map(readable_estimate);
        assert_eq!(about, ["1.0 KiB", "3.0 MiB", "12 MiB", "140 MiB", "2.8 GiB"]);
    }
}
