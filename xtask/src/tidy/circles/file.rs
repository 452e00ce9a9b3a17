//! One source file: what it declares, what it imports, and which paths it writes out.

use std::collections::BTreeSet;

use super::tokens::tokens;

/// A file of a crate as far as imports go.
#[derive(Debug, Default)]
pub(super) struct File {
    /// Modules with files of their own that it declares.
    pub(super) modules: BTreeSet<String>,
    /// Items that it defines.
    pub(super) items: BTreeSet<String>,
    /// What its `use` items bring in.
    pub(super) imports: Vec<Import>,
    /// Paths of two and more words outside of `use` items.
    pub(super) paths: Vec<Vec<String>>,
    /// Words outside of `use` and `mod` items that may name something imported.
    pub(super) words: BTreeSet<String>,
}

/// One name of a `use` item.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Import {
    pub(super) path: Vec<String>,
    /// The name in this file; `*` for all names.
    pub(super) name: String,
    /// Whether others see it here: a re-export.
    pub(super) is_public: bool,
}

impl File {
    pub(super) fn read(source: &str) -> Self {
        let tokens = tokens(source);
        let words: Vec<&str> = tokens.iter().map(String::as_str).collect();
        let mut file = Self::default();
        let mut at = 0;
        let mut is_public = false;
        while at < words.len() {
            match words[at] {
                "pub" => {
                    let is_limited = words.get(at + 1) == Some(&"(");
                    let length = if is_limited { closing(&words, at + 1) + 1 - at } else { 1 };
                    (is_public, at) = (true, at + length);
                    continue;
                }
                "use" => {
                    let end = position(&words, at, ";");
                    file.add_tree(&words[at + 1..end], &[], is_public);
                    at = end;
                }
                "mod" if words.get(at + 2) == Some(&";") => {
                    file.modules.insert(words[at + 1].to_owned());
                    at += 2;
                }
                "struct" | "enum" | "union" | "trait" | "type" | "const" | "static" | "fn"
                    if words.get(at + 1).is_some_and(|name| is_name(name)) =>
                {
                    file.items.insert(words[at + 1].to_owned());
                    // The name itself is no use of the name.
                    at += 1;
                }
                "macro_rules" if words.get(at + 1) == Some(&"!") => {
                    file.items.insert(words[at + 2].to_owned());
                    at += 2;
                }
                word if is_name(word) => at = file.add_path(&words, at),
                _ => {}
            }
            (is_public, at) = (false, at + 1);
        }
        file
    }

    /// Notes the path that begins at `from`; gives its last word.
    fn add_path(&mut self, words: &[&str], from: usize) -> usize {
        let before = from.checked_sub(1).map_or("", |before| words[before]);
        let mut path = vec![words[from].to_owned()];
        let mut at = from;
        while words.get(at + 1) == Some(&"::") && words.get(at + 2).is_some_and(|w| is_name(w)) {
            at += 2;
            path.push(words[at].to_owned());
        }
        let is_field = before == "." || words.get(at + 1) == Some(&":");
        if before != "::" && !is_field {
            self.words.insert(path[0].clone());
            if path.len() > 1 {
                self.paths.push(path);
            }
        }
        at
    }

    /// Adds the names of a `use` tree below `prefix`.
    fn add_tree(&mut self, tree: &[&str], prefix: &[String], is_public: bool) {
        let mut path = prefix.to_vec();
        for (at, &word) in tree.iter().enumerate() {
            match word {
                "::" => {}
                "{" => {
                    let end = closing(tree, at);
                    for branch in branches(&tree[at + 1..end]) {
                        self.add_tree(branch, &path, is_public);
                    }
                    return;
                }
                "as" => {
                    let name = tree[at + 1].to_owned();
                    self.imports.push(Import { path, name, is_public });
                    return;
                }
                "self" if !path.is_empty() => {}
                "*" => {
                    self.imports.push(Import { path, name: "*".to_owned(), is_public });
                    return;
                }
                word => path.push(word.to_owned()),
            }
        }
        if let Some(name) = path.last().cloned() {
            self.imports.push(Import { path, name, is_public });
        }
    }
}

fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The first `sign` from `from` on, or the end.
fn position(words: &[&str], from: usize, sign: &str) -> usize {
    let found = words[from..].iter().position(|word| *word == sign);
    found.map_or(words.len(), |offset| from + offset)
}

/// Where the bracket at `open` is closed, or the end.
fn closing(words: &[&str], open: usize) -> usize {
    let mut depth = 0_usize;
    for (at, word) in words.iter().enumerate().skip(open) {
        match *word {
            "{" | "(" => depth += 1,
            "}" | ")" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at;
        }
    }
    words.len().saturating_sub(1)
}

/// The parts of a `use` list between its own commas.
fn branches<'a>(list: &'a [&'a str]) -> Vec<&'a [&'a str]> {
    let (mut found, mut depth, mut from) = (Vec::new(), 0_usize, 0);
    for (at, word) in list.iter().enumerate() {
        match *word {
            "{" => depth += 1,
            "}" => depth -= 1,
            "," if depth == 0 => {
                found.push(&list[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    found.push(&list[from..]);
    found.retain(|branch| !branch.is_empty());
    found
}

#[cfg(test)]
mod tests {
    use super::File;

    #[test]
    fn every_form_of_an_import_is_read() {
        let file = File::read(
            "use crate::a::{self, B, c::{D as E, *}};\npub(crate) use super::f;\nmod g;\n\
             fn h(x: crate::i::J) { g::k(x.l, M::N); } struct O;",
        );
        let shown = |import: &super::Import| {
            let mark = if import.is_public { "pub " } else { "" };
            format!("{mark}{} as {}", import.path.join("::"), import.name)
        };
        let imports: Vec<String> = file.imports.iter().map(shown).collect();
        let expected = [
            "crate::a as a",
            "crate::a::B as B",
            "crate::a::c::D as E",
            "crate::a::c as *",
            "pub super::f as f",
        ];
        assert_eq!(imports, expected);
        assert!(file.modules.contains("g") && file.items.contains("O"), "{file:?}");
        let paths: Vec<String> = file.paths.iter().map(|path| path.join("::")).collect();
        assert_eq!(paths, ["crate::i::J", "g::k", "M::N"]);
        assert!(!file.words.contains("l"), "a field is no name: {file:?}");
    }
}
