//! Names that preprocessors write into comments.

use std::collections::{BTreeMap, HashMap};

/// Names by what they name and its label.
#[derive(Debug, Default)]
pub(super) struct Names {
    properties: HashMap<u64, String>,
    materials: HashMap<u64, String>,
    /// HyperMesh: name of a component, which is a property's where that has none.
    components: HashMap<u64, String>,
    sets: HashMap<u64, String>,
    /// HyperMesh: elements by the label of the first, with that of the last and their component.
    moved: BTreeMap<u64, [u64; 2]>,
    /// The component of which comments list the elements.
    listed: Option<u64>,
    /// Patran and ANSA: the name of the next card.
    next_property: Option<String>,
    next_material: Option<String>,
}

impl Names {
    /// Takes a comment, without the sign before it.
    pub(super) fn comment(&mut self, comment: &str) {
        let text = comment.trim();
        if let Some(component) = self.listed
            && self.elements(text, component)
        {
            return;
        }
        self.listed = None;
        let words: Vec<&str> = text.split_whitespace().take(4).collect();
        match words.as_slice() {
            ["HMNAME", kind, ..] => self.hypermesh(kind, text),
            ["HMSET", ..] => {
                let label = words.get(1).and_then(|label| label.parse().ok());
                if let (Some(label), Some((_, name, _))) = (label, quoted(text)) {
                    self.sets.insert(label, name.to_owned());
                }
            }
            ["HMMOVE", component, ..] => self.listed = component.parse().ok(),
            ["Pset:", ..] => {
                if let Some((_, name, rest)) = quoted(text)
                    && let Some((_, imported, _)) = quoted(rest)
                    && let Some(label) =
                        imported.strip_prefix("psolid.").and_then(|l| l.parse().ok())
                {
                    self.properties.insert(label, name.to_owned());
                }
            }
            ["Elements", "and", "Element", "Properties"] => self.next_property = behind_colon(text),
            ["Material", "Record", ..] => self.next_material = behind_colon(text),
            _ if text.starts_with("ANSA_NAME_COMMENT;") => self.ansa(text),
            _ if text.contains("Femap ") => self.femap(text),
            _ => {}
        }
    }

    fn hypermesh(&mut self, kind: &str, text: &str) {
        let Some((before, name, behind)) = quoted(text) else { return };
        let label = before.split_whitespace().next_back().and_then(|label| label.parse().ok());
        let Some(label) = label else { return };
        let names = match kind {
            "PROP" => &mut self.properties,
            "MAT" => &mut self.materials,
            "COMP" => {
                let property = behind.split_whitespace().next().and_then(|own| own.parse().ok());
                if let Some(property) = property.filter(|own| *own > 0) {
                    self.components.insert(property, name.to_owned());
                }
                &mut self.components
            }
            _ => return,
        };
        names.insert(label, name.to_owned());
    }

    /// `ANSA_NAME_COMMENT;12;PSOLID;rotor;`
    fn ansa(&mut self, text: &str) {
        let mut parts = text.split(';').skip(1);
        let (Some(label), Some(card), Some(name)) = (parts.next(), parts.next(), parts.next())
        else {
            return;
        };
        let Ok(label) = label.trim().parse() else { return };
        let names = match card.trim() {
            "PSOLID" => &mut self.properties,
            "MAT1" => &mut self.materials,
            "SET" => &mut self.sets,
            _ => return,
        };
        names.insert(label, name.trim().to_owned());
    }

    /// `Femap Property 12 : rotor`
    fn femap(&mut self, text: &str) {
        for (noun, names) in
            [(" Property ", &mut self.properties), (" Material ", &mut self.materials)]
        {
            if let Some((_, rest)) = text.split_once(noun)
                && let Some((label, name)) = rest.split_once(':')
                && let Ok(label) = label.trim().parse()
            {
                names.insert(label, name.trim().to_owned());
            }
        }
    }

    /// Elements of a component, such as `1THRU 20` or `7`; false where the comment says something else.
    fn elements(&mut self, text: &str, component: u64) -> bool {
        let spaced = text.replace("THRU", " THRU ");
        let words: Vec<&str> = spaced.split_whitespace().collect();
        let mut at = 0;
        let mut found = Vec::new();
        while at < words.len() {
            let Ok(first) = words[at].parse::<u64>() else { return false };
            let last = match words.get(at + 1..at + 3) {
                Some(["THRU", last]) => {
                    at += 2;
                    last.parse().ok()
                }
                _ => Some(first),
            };
            let Some(last) = last else { return false };
            found.push((first, [last, component]));
            at += 1;
        }
        let any = !found.is_empty();
        self.moved.extend(found);
        any
    }

    /// The name of a property, from comments before its card.
    pub(super) fn take_property(&mut self) -> Option<String> {
        self.next_property.take().filter(|name| !name.is_empty())
    }

    /// The name of a material, from comments before its card.
    pub(super) fn take_material(&mut self) -> Option<String> {
        self.next_material.take().filter(|name| !name.is_empty())
    }

    pub(super) fn property(&self, label: u64) -> Option<&str> {
        let name = self.properties.get(&label).or_else(|| self.components.get(&label));
        name.map(String::as_str).filter(|name| !name.is_empty())
    }

    pub(super) fn material(&self, label: u64) -> Option<&str> {
        self.materials.get(&label).map(String::as_str).filter(|name| !name.is_empty())
    }

    pub(super) fn set(&self, label: u64) -> Option<&str> {
        self.sets.get(&label).map(String::as_str).filter(|name| !name.is_empty())
    }

    /// The component that an element was moved to, with its name.
    pub(super) fn component(&self, element: u64) -> Option<(u64, &str)> {
        let (_, &[last, component]) = self.moved.range(..=element).next_back()?;
        let name = self.components.get(&component).filter(|name| !name.is_empty())?;
        (element <= last).then_some((component, name.as_str()))
    }
}

/// What stands before, between and behind quotation marks.
fn quoted(text: &str) -> Option<(&str, &str, &str)> {
    let (before, rest) = text.split_once('"')?;
    let (name, behind) = rest.split_once('"')?;
    Some((before, name.trim(), behind))
}

fn behind_colon(text: &str) -> Option<String> {
    text.split_once(':').map(|(_, name)| name.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::Names;

    #[test]
    fn preprocessors_have_their_own_ways() {
        let mut names = Names::default();
        for comment in [
            "HMNAME COMP             1\"rotor\"       4 \"solid\" 4",
            "HMNAME PROP             5\"housing, left\" 4",
            "HMNAME MAT              1\"steel\" \"MAT1\"",
            "HMSET        7        1 \"bore\"",
            "HMMOVE        1",
            "             1THRU          20      22",
            "HMWCOLOR COMP                   1      11",
            " Femap with NX Nastran Property 8 : disc : thick",
            " Femap Material 9 : Alloy 718",
            "ANSA_NAME_COMMENT;12;PSOLID;shaft;;NO;NO;NO;NO;",
            " Pset: \"impeller\" will be imported as: \"psolid.13\"",
            " Elements and Element Properties for region : turbine",
        ] {
            names.comment(comment);
        }
        let known = [(1, "rotor"), (4, "rotor"), (5, "housing, left"), (8, "disc : thick")];
        for (label, name) in known.into_iter().chain([(12, "shaft"), (13, "impeller")]) {
            assert_eq!(names.property(label), Some(name), "{label}");
        }
        assert_eq!((names.property(99), names.set(7)), (None, Some("bore")));
        assert_eq!((names.material(1), names.material(9)), (Some("steel"), Some("Alloy 718")));
        assert_eq!((names.component(20), names.component(21)), (Some((1, "rotor")), None));
        assert_eq!(names.component(22), Some((1, "rotor")));
        assert_eq!(names.take_property().as_deref(), Some("turbine"));
        assert_eq!(names.take_property(), None);
    }
}
