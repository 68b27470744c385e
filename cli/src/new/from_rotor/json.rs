//! JSON as programs in Python write it, with NaN and Infinity, and with the place of every value.

use std::ops::Range;

use super::value::{Entry, Value, What};

/// Lists and tables are at most so deep in each other.
const DEEPEST: usize = 64;

/// Where and why a text is no JSON.
type Wrong = (Range<usize>, String);

/// The tree of a file of JSON.
pub(super) fn of_json(text: &str) -> Result<Value, Wrong> {
    let mut own = Parser { text, at: 0, depth: 0 };
    own.space();
    let value = own.value()?;
    own.space();
    match own.peek() {
        None => Ok(value),
        Some(_) => Err(own.wrong("something stands behind the end of the JSON value")),
    }
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
}

impl Parser<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn space(&mut self) {
        let after = self.rest().trim_start_matches([' ', '\t', '\r', '\n', '\u{feff}']);
        self.at = self.text.len() - after.len();
    }

    /// An error at the next letter.
    fn wrong(&self, what: &str) -> Wrong {
        let length = self.peek().map_or(0, char::len_utf8);
        let what = if length == 0 { "the file ends in the middle of a value" } else { what };
        (self.at..self.at + length, what.to_owned())
    }

    fn takes(&mut self, word: &str) -> bool {
        let found = self.rest().starts_with(word);
        if found {
            self.at += word.len();
        }
        found
    }

    fn value(&mut self) -> Result<Value, Wrong> {
        let start = self.at;
        const WORDS: [(&str, What); 6] = [
            ("null", What::Nothing),
            ("true", What::Flag(true)),
            ("false", What::Flag(false)),
            ("NaN", What::Number(f64::NAN)),
            ("Infinity", What::Number(f64::INFINITY)),
            ("-Infinity", What::Number(f64::NEG_INFINITY)),
        ];
        let word = WORDS.into_iter().find(|(word, _)| self.takes(word)).map(|own| own.1);
        let what = match (word, self.peek()) {
            (Some(what), _) => what,
            (_, Some('"')) => What::Text(self.string()?),
            (_, Some('{')) => What::Table(self.inside(Self::table)?),
            (_, Some('[')) => What::List(self.inside(Self::list)?),
            (_, Some('-' | '0'..='9')) => What::Number(self.number()?),
            _ => return Err(self.wrong("a value is missing")),
        };
        Ok(Value { place: start..self.at, what })
    }

    fn inside<T>(&mut self, read: fn(&mut Self) -> Result<T, Wrong>) -> Result<T, Wrong> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.wrong("too many lists and tables are within each other"));
        }
        self.at += 1;
        let read = read(self)?;
        self.depth -= 1;
        Ok(read)
    }

    fn table(&mut self) -> Result<Vec<Entry>, Wrong> {
        let mut all: Vec<Entry> = Vec::new();
        self.each('}', |own| {
            let start = own.at;
            let name = own.string()?;
            let place = start..own.at;
            if all.iter().any(|other| other.name == name) {
                return Err((place, "this key is there twice".to_owned()));
            }
            own.space();
            if !own.takes(":") {
                return Err(own.wrong("`:` is missing behind a key"));
            }
            own.space();
            let value = own.value()?;
            all.push(Entry { name, place, value });
            Ok(())
        })?;
        Ok(all)
    }

    fn list(&mut self) -> Result<Vec<Value>, Wrong> {
        let mut all = Vec::new();
        self.each(']', |own| {
            all.push(own.value()?);
            Ok(())
        })?;
        Ok(all)
    }

    /// What is between commas up to the end.
    fn each(
        &mut self,
        end: char,
        mut read: impl FnMut(&mut Self) -> Result<(), Wrong>,
    ) -> Result<(), Wrong> {
        let end = end.to_string();
        self.space();
        if self.takes(&end) {
            return Ok(());
        }
        loop {
            read(self)?;
            self.space();
            if self.takes(&end) {
                return Ok(());
            }
            if !self.takes(",") {
                return Err(self.wrong("`,` or the end of a list or table is missing"));
            }
            self.space();
        }
    }

    fn string(&mut self) -> Result<String, Wrong> {
        if !self.takes("\"") {
            return Err(self.wrong("a text in quotes is missing"));
        }
        let mut text = String::new();
        loop {
            let Some(letter) = self.peek() else { return Err(self.wrong("")) };
            let start = self.at;
            self.at += letter.len_utf8();
            match letter {
                '"' => return Ok(text),
                '\\' => text.push(self.escaped(start)?),
                letter if letter < ' ' => {
                    return Err((start..self.at, "a text ends in its line".to_owned()));
                }
                letter => text.push(letter),
            }
        }
    }

    fn escaped(&mut self, start: usize) -> Result<char, Wrong> {
        let Some(letter) = self.peek() else { return Err(self.wrong("")) };
        self.at += letter.len_utf8();
        let simple = [('n', '\n'), ('t', '\t'), ('r', '\r'), ('b', '\u{8}'), ('f', '\u{c}')];
        match letter {
            '"' | '\\' | '/' => Ok(letter),
            'u' => {
                let mut code = self.code(start)?;
                // Letters beyond 16 bits are written as two halves.
                if (0xd800..0xdc00).contains(&code) && self.takes("\\u") {
                    let low = self.code(start)?;
                    code = 0x10000 + ((code - 0xd800) << 10) + (low.wrapping_sub(0xdc00) & 0x3ff);
                }
                Ok(char::from_u32(code).unwrap_or('\u{fffd}'))
            }
            letter => match simple.iter().find(|own| own.0 == letter) {
                Some(own) => Ok(own.1),
                None => Err((start..self.at, "nothing is escaped so".to_owned())),
            },
        }
    }

    fn code(&mut self, start: usize) -> Result<u32, Wrong> {
        let digits = self.rest().get(..4).unwrap_or("");
        let fine = digits.len() == 4 && digits.chars().all(|own| own.is_ascii_hexdigit());
        let code = u32::from_str_radix(digits, 16).ok().filter(|_| fine);
        let code = code
            .ok_or_else(|| (start..self.at, "four digits are missing behind `\\u`".to_owned()))?;
        self.at += 4;
        Ok(code)
    }

    fn number(&mut self) -> Result<f64, Wrong> {
        let start = self.at;
        let of_number =
            |own: char| own.is_ascii_digit() || matches!(own, '+' | '-' | '.' | 'e' | 'E');
        let length = self.rest().find(|own| !of_number(own)).unwrap_or(self.rest().len());
        self.at += length;
        let number = self.text[start..self.at].parse();
        number.map_err(|_| (start..self.at, "this is no number".to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_as_json_has_them() {
        let text = " {\"a\": [1, -2.5e3, NaN, -Infinity, null], \"b \\u00e9\\ud83d\\ude00\\n\": {\"c\": true, \"d\": \"x\"}, \"e\": []}\n";
        let tree = of_json(text).expect("JSON");
        let [a, b, e] = tree.entries() else { panic!("three keys") };
        let What::List(list) = &a.value.what else { panic!("a list") };
        let numbers: Vec<f64> =
            list.iter().map(|own| if let What::Number(x) = own.what { x } else { 7.0 }).collect();
        assert_eq!(numbers[..2], [1.0, -2500.0]);
        assert!(numbers[2].is_nan() && numbers[3] == f64::NEG_INFINITY && numbers[4] == 7.0);
        assert_eq!(&text[list[1].place.clone()], "-2.5e3");
        assert_eq!(b.name, "b é😀\n");
        assert_eq!(b.value.entries()[0].value.what, What::Flag(true));
        assert_eq!(e.value.what, What::List(Vec::new()));
    }

    #[test]
    fn what_is_no_json_is_refused_where_it_is() {
        for (text, at) in [
            ("", 0),
            ("{", 1),
            ("{\"a\": 1", 7),
            ("{\"a\" 1}", 5),
            ("{\"a\": 1,}", 8),
            ("[1 2]", 3),
            ("{\"a\": 1} x", 9),
            ("{\"a\": 1, \"a\": 2}", 9),
            ("[1e]", 1),
            ("[\"a\nb\"]", 3),
            ("[\"\\u12\"]", 2),
            ("[\"\\q\"]", 2),
            ("nul", 0),
        ] {
            let (place, what) = of_json(text).expect_err(text);
            assert_eq!(place.start, at, "{text}: {what}");
        }
        let deep = "[".repeat(100_000);
        assert!(of_json(&deep).is_err());
        // Cut anywhere, it is refused and nothing else happens.
        let whole = "{\"a\": [1, {\"b\": \"\\u00e9é\"}], \"c\": null}";
        for end in (0..whole.len()).filter(|end| whole.is_char_boundary(*end)) {
            assert!(of_json(&whole[..end]).is_err(), "{}", &whole[..end]);
        }
    }
}
