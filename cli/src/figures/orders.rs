//! Multiples of the speed of rotation that spectra mark.

/// Orders that are marked, and their names.
pub(super) const ORDERS: [(f64, &str); 3] = [(0.5, "½X"), (1.0, "1X"), (2.0, "2X")];
