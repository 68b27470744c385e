//! Tables inside a table: one, a list of them, or by names that the user chose.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::spec::schema::Shape;

use super::{Node, Place, Reader, Table, Value};

impl<'a> Reader<'a> {
    /// A table inside this one, if given.
    pub(crate) fn table(&self, key: &'static str) -> Option<Reader<'a>> {
        let shape = self.declared(key, Shape::is_table)?;
        self.asked.borrow_mut().insert(key);
        let (key_place, node) = self.table.entries.get(key)?;
        match &node.value {
            Value::Table(table) => Some(self.inner(self.path(key), shape, key_place, table)),
            _ => {
                self.wrong_table(node, key, "a table", &format!("[{}]", self.path(key)));
                None
            }
        }
    }

    /// Notes a value where tables stand under headings.
    fn wrong_table(&self, node: &Node, key: &str, wanted: &str, heading: &str) {
        self.note(
            &node.place,
            Code::BAD_VALUE,
            format!("`{key}` takes {wanted}, not {}", node.value.kind()),
            Some(format!("write its keys below a heading `{heading}`")),
        );
    }

    /// Tables in a list (`[[key]]`); none if the key is not given.
    pub(crate) fn tables(&self, key: &'static str) -> Vec<Reader<'a>> {
        let is_list = |shape: &Shape| shape.of_items().is_some_and(Shape::is_table);
        let Some((node, shape)) = self.get(key, is_list) else { return Vec::new() };
        let (Value::List(list), Some(shape)) = (&node.value, shape.of_items()) else {
            self.wrong_table(node, key, "tables", &format!("[[{}]]", self.path(key)));
            return Vec::new();
        };
        let mut readers = Vec::with_capacity(list.len());
        for item in list {
            match &item.value {
                Value::Table(table) => {
                    readers.push(self.inner(self.path(key), shape, &item.place, table));
                }
                _ => self.wrong_table(item, key, "tables", &format!("[[{}]]", self.path(key))),
            }
        }
        readers
    }

    /// Tables by names that the user chose, such as `[material.steel]`.
    pub(crate) fn named_tables(&self, key: &'static str) -> Vec<(String, Reader<'a>)> {
        let Some((node, shape)) = self.get(key, Shape::names_are_free) else { return Vec::new() };
        let Value::Table(outer) = &node.value else {
            let heading = format!("[{}.NAME]", self.path(key));
            self.wrong_table(node, key, "tables by name", &heading);
            return Vec::new();
        };
        let mut readers = Vec::new();
        for (name, (place, node)) in &outer.entries {
            match (&node.value, shape.of_key(name)) {
                (Value::Table(table), Some(shape)) => {
                    let path = format!("{}.{name}", self.path(key));
                    readers.push((name.clone(), self.inner(path, shape, place, table)));
                }
                _ => {
                    let heading = format!("[{}.{name}]", self.path(key));
                    self.wrong_table(node, name, "a table", &heading);
                }
            }
        }
        readers
    }

    /// Texts by names that the user chose, each with the place of its name.
    pub(crate) fn named_texts(&self, key: &'static str) -> Vec<(Located, Located)> {
        let Some((node, _)) = self.get(key, Shape::names_are_free) else { return Vec::new() };
        let Value::Table(table) = &node.value else {
            self.wrong_table(node, key, "texts by name", &format!("[{}]", self.path(key)));
            return Vec::new();
        };
        let mut texts = Vec::with_capacity(table.entries.len());
        for (name, (place, node)) in &table.entries {
            match &node.value {
                Value::Text(text) => texts.push((place.text(name), node.place.text(text))),
                _ => self.wrong(name, node, "text", "\"steel\""),
            }
        }
        texts
    }

    /// Quantities and numbers by names that the user chose: places of names and what is written there.
    pub(crate) fn named_values(&self, key: &'static str) -> Vec<(Located, Located)> {
        let Some((node, _)) = self.get(key, Shape::names_are_free) else { return Vec::new() };
        let Value::Table(table) = &node.value else {
            self.wrong(key, node, "a table", &self.example(key));
            return Vec::new();
        };
        let mut values = Vec::new();
        for (name, (place, node)) in &table.entries {
            let value = match &node.value {
                Value::Text(text) => node.place.text(text),
                Value::Integer(_) | Value::Number(_) => node.place.written(),
                _ => {
                    self.wrong(name, node, "a number with its unit, as text", "\"12 mm\"");
                    continue;
                }
            };
            values.push((place.text(name), value));
        }
        values
    }

    pub(super) fn path(&self, key: &str) -> String {
        match self.name.trim_matches(['[', ']']) {
            "" => key.to_string(),
            name => format!("{name}.{key}"),
        }
    }

    fn inner(
        &self,
        path: String,
        shape: &'static Shape,
        place: &Place,
        table: &'a Table,
    ) -> Reader<'a> {
        Reader::new(table, shape, format!("[{path}]"), place.clone(), self.errors)
    }
}
