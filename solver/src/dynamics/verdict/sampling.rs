//! Which steps the verdict measures, and for how many each stands.

/// Displacements, errors and motions in modes are taken from the first steps and one in so many of those
/// after, in no order that a motion could keep to.
const SAMPLED: u64 = 32;
const ALL_SAMPLED: u64 = 128;

/// Whether a step is one of those that are measured.
pub(super) fn is_sampled(step: u64) -> bool {
    step < ALL_SAMPLED || scattered(step).is_multiple_of(SAMPLED)
}

/// For how many steps one that is measured stands.
pub(super) fn stands_for(step: u64) -> u64 {
    if step < ALL_SAMPLED { 1 } else { SAMPLED }
}

/// A number for each step in which no order is to be seen (the finish of splitmix64).
pub(super) fn scattered(step: u64) -> u64 {
    let mut hash = step.wrapping_add(0x9e37_79b9_7f4a_7c15);
    hash = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    hash = (hash ^ (hash >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    hash ^ (hash >> 31)
}
