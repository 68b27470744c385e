//! Tables inside a table: one, a list of them, or by names that the user chose.

use super::schema::Shape;
use super::tree::{Content, Node, Place, Tree};
use super::wording::Wording;
use super::{Item, Table};
use crate::diagnostic::{Code, Located};

impl<'d> Item<'d> {
    /// The element as a table called `path` in messages; another type is an error.
    pub(crate) fn table(&self, path: &str) -> Option<Table<'d>> {
        match &self.node.content {
            Content::Table(tree) => {
                let place = self.node.place.clone();
                Some(Table::new(self.document, tree, self.shape, place, path.to_owned()))
            }
            _ => {
                let wording = self.document.wording;
                self.document.push(wording.wrong_type(path, self.node, "a table", "{ … }"));
                None
            }
        }
    }
}

impl<'d> Table<'d> {
    /// A table, if the key is there.
    pub fn optional_table(&self, key: &str) -> Option<Table<'d>> {
        let (node, shape) = self.entry(key, Shape::is_table)?;
        let (place, _) = self.tree.entries.get(key)?;
        match (&node.content, self.wording()) {
            (Content::Table(tree), Wording::Spec) => {
                return Some(self.inner(self.full(key), shape, &node.place, tree));
            }
            (Content::Table(tree), Wording::Case) => {
                return Some(self.inner(self.full(key), shape, place, tree));
            }
            (_, Wording::Spec) => self.wrong(key, node, "a table", "{ … }"),
            (_, Wording::Case) => {
                self.wrong_table(node, key, "a table", &format!("[{}]", self.full(key)));
            }
        }
        None
    }

    /// A table that must be there.
    pub fn table(&self, key: &str) -> Option<Table<'d>> {
        self.demand(key);
        self.optional_table(key)
    }

    /// What `read` makes of a table, if the key is there; the table is finished then.
    pub fn in_table<T>(&self, key: &str, read: impl FnOnce(&Table<'d>) -> T) -> Option<T> {
        self.optional_table(key).map(|table| table.read(read))
    }

    /// What `read` makes of this table, which is finished then.
    pub fn read<T>(self, read: impl FnOnce(&Table<'d>) -> T) -> T {
        let read_value = read(&self);
        self.finish();
        read_value
    }

    /// Tables in a list (`[[key]]`); none if the key is not given.
    pub fn tables(&self, key: &str) -> Vec<Table<'d>> {
        let is_list = |shape: &Shape| shape.of_items().is_some_and(Shape::is_table);
        let Some((node, shape)) = self.entry(key, is_list) else { return Vec::new() };
        let heading = format!("[[{}]]", self.full(key));
        let (Content::List(list), Some(shape)) = (&node.content, shape.of_items()) else {
            self.wrong_table(node, key, "tables", &heading);
            return Vec::new();
        };
        let mut tables = Vec::with_capacity(list.len());
        for item in list {
            match &item.content {
                Content::Table(tree) => {
                    tables.push(self.inner(self.full(key), shape, &item.place, tree));
                }
                _ => self.wrong_table(item, key, "tables", &heading),
            }
        }
        tables
    }

    /// Every key, in the order of the file, each counted as known: for tables whose keys are names.
    pub(crate) fn names(&self) -> Vec<Located> {
        debug_assert!(self.shape.names_are_free(), "the keys of `{}` are fixed", self.path);
        let entries = self.tree.entries.iter();
        let mut names: Vec<Located> = entries.map(|(key, (place, _))| place.text(key)).collect();
        names.sort_by_key(|name| name.span().start);
        names.iter().for_each(|name| self.pass_over(name.text()));
        names
    }

    /// Tables by names that the user chose, such as `[material.steel]`.
    pub fn named_tables(&self, key: &str) -> Vec<(String, Table<'d>)> {
        let heading = format!("[{}.NAME]", self.full(key));
        let mut tables = Vec::new();
        for (name, place, node, shape) in self.named(key, "tables by name", &heading) {
            let path = format!("{}.{name}", self.full(key));
            match &node.content {
                Content::Table(tree) => {
                    tables.push((name.clone(), self.inner(path, shape, place, tree)));
                }
                _ => self.wrong_table(node, name, "a table", &format!("[{path}]")),
            }
        }
        tables
    }

    /// Texts by names that the user chose, each with the place of its name.
    pub fn named_texts(&self, key: &str) -> Vec<(Located, Located)> {
        let heading = format!("[{}]", self.full(key));
        let mut texts = Vec::new();
        for (name, place, node, _) in self.named(key, "texts by name", &heading) {
            match &node.content {
                Content::Text(text) => texts.push((place.text(name), node.place.text(text))),
                _ => self.wrong(name, node, "text", "\"steel\""),
            }
        }
        texts
    }

    /// Quantities and numbers by names that the user chose: places of names and what is written there.
    pub fn named_values(&self, key: &str) -> Vec<(Located, Located)> {
        let Some((node, _)) = self.entry(key, Shape::names_are_free) else { return Vec::new() };
        let Content::Table(tree) = &node.content else {
            self.wrong(key, node, "a table", &self.example(key));
            return Vec::new();
        };
        let mut values = Vec::new();
        for (name, (place, node)) in &tree.entries {
            let value = match &node.content {
                Content::Text(text) => node.place.text(text),
                // A value of a range is not what stands at its place.
                Content::Number(number) => match number.as_decimal() {
                    Some(text) => node.place.text(text),
                    None => node.place.written(),
                },
                _ => {
                    self.wrong(name, node, "a number with its unit, as text", "\"12 mm\"");
                    continue;
                }
            };
            values.push((place.text(name), value));
        }
        values
    }

    /// The entries of a table whose keys are names, with what they take.
    fn named(
        &self,
        key: &str,
        wanted: &str,
        heading: &str,
    ) -> impl Iterator<Item = (&'d String, &'d Place, &'d Node, &'static Shape)> {
        let found = self.entry(key, Shape::names_are_free);
        let entries = found.and_then(|(node, shape)| match &node.content {
            Content::Table(tree) => Some((&tree.entries, shape)),
            _ => {
                self.wrong_table(node, key, wanted, heading);
                None
            }
        });
        entries.into_iter().flat_map(|(entries, shape)| {
            let taken = move |(name, (place, node)): (&'d String, &'d (Place, Node))| {
                Some((name, place, node, shape.of_key(name)?))
            };
            entries.iter().filter_map(taken)
        })
    }

    /// Reports a value where tables stand under headings.
    fn wrong_table(&self, node: &Node, key: &str, wanted: &str, heading: &str) {
        let found = self.wording().of(&node.content);
        let message = format!("`{key}` takes {wanted}, not {found}");
        let help = format!("write its keys below a heading `{heading}`");
        self.push(node.place.error(Code::BAD_VALUE, message).help(help));
    }

    fn inner(
        &self,
        path: String,
        shape: &'static Shape,
        heading: &Place,
        tree: &'d Tree,
    ) -> Table<'d> {
        Table::new(self.document, tree, shape, heading.clone(), path)
    }
}
