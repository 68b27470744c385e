//! Orders and envelopes over a run as a page has them.

use serde::Serialize;

use super::encode::Packed;
use crate::report::{Envelope, Extremes, Tracked, TrackedSignal};

/// Orders over a run.
#[derive(Debug, Serialize)]
pub(super) struct PackedOrders {
    /// Revolutions of a window.
    revolutions: f64,
    /// s.
    time: Packed,
    rpm: Packed,
    /// A column each.
    signals: Vec<PackedSignal>,
}

#[derive(Debug, Serialize)]
struct PackedSignal {
    column: String,
    /// From 0 to the peak.
    overall: Packed,
    first: Packed,
    first_phase_deg: Packed,
    second: Packed,
    second_phase_deg: Packed,
    /// Of the largest part below 1X, and its order.
    below: Packed,
    below_order: Packed,
}

impl From<Tracked> for PackedOrders {
    fn from(own: Tracked) -> Self {
        let signal = |own: TrackedSignal| {
            let [first, second] = own.amplitudes.map(Packed::single);
            let [first_phase_deg, second_phase_deg] = own.phases.map(Packed::single);
            let [below, below_order] = own.below.map(Packed::single);
            PackedSignal {
                column: own.column,
                overall: Packed::single(own.overall),
                first,
                first_phase_deg,
                second,
                second_phase_deg,
                below,
                below_order,
            }
        };
        PackedOrders {
            revolutions: own.revolutions,
            time: Packed::single(own.time),
            rpm: Packed::single(own.rpm),
            signals: own.signals.into_iter().map(signal).collect(),
        }
    }
}

/// Least and largest values over a run.
#[derive(Debug, Serialize)]
pub(super) struct PackedEnvelope {
    /// Of a point.
    revolutions: f64,
    /// s, in the middle.
    time: Packed,
    rpm: Packed,
    /// A column each.
    signals: Vec<PackedExtremes>,
}

#[derive(Debug, Serialize)]
struct PackedExtremes {
    column: String,
    least: Packed,
    most: Packed,
}

impl From<Envelope> for PackedEnvelope {
    fn from(own: Envelope) -> Self {
        let signal = |Extremes { column, least, most }: Extremes| {
            let [least, most] = [least, most].map(Packed::single);
            PackedExtremes { column, least, most }
        };
        PackedEnvelope {
            revolutions: own.revolutions,
            time: Packed::single(own.time),
            rpm: Packed::single(own.rpm),
            signals: own.signals.into_iter().map(signal).collect(),
        }
    }
}
