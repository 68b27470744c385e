//! What results call supports, stops and joints.

/// What results call a support, a stop or a joint.
#[derive(Debug, Clone)]
pub(crate) struct SupportName {
    /// In columns, between the quantity and its unit.
    pub(crate) label: String,
    /// In figures and tables.
    pub(crate) title: String,
    /// Within a sentence.
    pub(crate) word: String,
}

impl SupportName {
    /// One of many that have numbers, from 1.
    pub(crate) fn numbered(word: &str, k: usize) -> SupportName {
        let title = format!("{word} {k}");
        SupportName { label: k.to_string(), word: title.to_lowercase(), title }
    }

    pub(super) fn joint(name: &str) -> SupportName {
        let (label, word) = (format!("_{name}"), format!("joint {name}"));
        SupportName { label, title: name.to_string(), word }
    }

    /// A column, such as `RX1_N` of `RX_N`, or `RX_front_N`.
    pub(crate) fn column(&self, quantity: &str, unit: &str) -> String {
        format!("{quantity}{}_{unit}", self.label)
    }
}
