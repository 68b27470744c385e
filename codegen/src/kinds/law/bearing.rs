//! What a parameter of a law is of the bearing that uses it.

use crate::units::Dimension;

/// A value of a bearing that a law can take from it. The parameter's own value is then for plots and tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BearingValue {
    /// c: radius of the bore less that of the journal.
    RadialClearance,
    /// 2c: the clearance across the diameter, as makers of rolling bearings give it.
    DiametralClearance,
    /// R.
    JournalRadius,
    /// D = 2R.
    JournalDiameter,
    /// R + c.
    BoreRadius,
    /// 2(R + c).
    BoreDiameter,
    /// L: along the axis.
    Length,
    /// 2π (R + c) L over the number of all springs: the area of the bore that one spring stands for.
    SpringArea,
}

impl BearingValue {
    /// All of them.
    pub(crate) const ALL: [BearingValue; 8] = [
        BearingValue::RadialClearance,
        BearingValue::DiametralClearance,
        BearingValue::JournalRadius,
        BearingValue::JournalDiameter,
        BearingValue::BoreRadius,
        BearingValue::BoreDiameter,
        BearingValue::Length,
        BearingValue::SpringArea,
    ];

    /// How law files call them, in the order of [`BearingValue::ALL`].
    pub(super) const WORDS: &[&str] = &[
        "radial_clearance",
        "diametral_clearance",
        "journal_radius",
        "journal_diameter",
        "bore_radius",
        "bore_diameter",
        "length",
        "spring_area",
    ];

    /// How law files call it.
    pub fn word(self) -> &'static str {
        Self::WORDS[self as usize]
    }

    /// The value that law files call `word`.
    pub(crate) fn called(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|value| value.word() == word)
    }

    /// What it measures.
    pub const fn dimension(self) -> Dimension {
        match self {
            BearingValue::SpringArea => Dimension::AREA,
            _ => Dimension::LENGTH,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_has_its_word() {
        assert_eq!(BearingValue::ALL.len(), BearingValue::WORDS.len());
        for (value, word) in BearingValue::ALL.into_iter().zip(BearingValue::WORDS) {
            assert_eq!(value.word(), *word);
            assert_eq!(BearingValue::called(word), Some(value));
        }
    }
}
