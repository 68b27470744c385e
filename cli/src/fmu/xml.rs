//! Pieces of XML.

/// An attribute with a space before it.
pub(super) fn attribute(name: &str, value: &str) -> String {
    let mut text = format!(" {name}=\"");
    for letter in value.chars() {
        match letter {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            // What XML 1.0 has no place for, and what a reader would turn into a space.
            own if own.is_control() => text.push(' '),
            own => text.push(own),
        }
    }
    text.push('"');
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_written_out() {
        assert_eq!(attribute("a", "x < \"y\" & z\n"), " a=\"x &lt; &quot;y&quot; &amp; z \"");
    }
}
