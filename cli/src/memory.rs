//! Memory of the machine, and how cases write it.

use std::fs;

/// Bytes that programs may take without others being moved out, where the platform says so.
pub(crate) fn available() -> Option<usize> {
    in_kilobytes(&fs::read_to_string("/proc/meminfo").ok()?)
}

/// `MemAvailable` of Linux, in bytes.
fn in_kilobytes(text: &str) -> Option<usize> {
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<usize>().ok()?.checked_mul(1024)
}

/// Units in which a size is written, in bytes.
const UNITS: [(&str, f64); 6] = [
    ("MB", 1e6),
    ("GB", 1e9),
    ("TB", 1e12),
    ("MiB", 1_048_576.0),
    ("GiB", 1_073_741_824.0),
    ("TiB", 1_099_511_627_776.0),
];

/// A positive number with one of the units, in bytes.
pub(crate) fn read(text: &str) -> Option<usize> {
    let unit_at = text.find(|c: char| c.is_ascii_alphabetic() && c != 'e' && c != 'E')?;
    let (number, unit) = text.split_at(unit_at);
    let (_, bytes) = UNITS.iter().find(|(name, _)| *name == unit)?;
    let value = number.trim_end().parse::<f64>().ok()? * bytes;
    (value.is_finite() && value >= 1.0).then_some(value as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_with_their_units() {
        assert_eq!(read("8 GiB"), Some(8 << 30));
        assert_eq!(read("1.5MB"), Some(1_500_000));
        assert_eq!(read("2e-3 TB"), Some(2_000_000_000));
        let wrong =
            ["8", "GiB", "8 gib", "-1 GB", "0 GB", "8 GiB or so", "inf GB", "nan GB", "", "1 2 MB"];
        assert!(wrong.iter().all(|text| read(text).is_none()));
    }

    #[test]
    fn what_is_available_is_read_where_it_is_said() {
        let text = "MemTotal:       65842580 kB\nMemAvailable:   40000000 kB\nBuffers: 3 kB\n";
        assert_eq!(in_kilobytes(text), Some(40_960_000_000));
        assert_eq!(in_kilobytes("MemTotal: 3 kB\n"), None);
    }
}
