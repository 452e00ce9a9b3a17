//! No two files of a crate import each other, in circles of any length.
//!
//! What a file imports is the file that defines it, through whatever `lib.rs` or `mod.rs` exports
//! it again; to export a name again, or to declare a module, imports nothing.

mod file;
mod graph;
mod tokens;

use std::collections::BTreeMap;

use graph::Crate;

/// The circles of one crate: `sources` are its files below `src` with their texts.
pub(super) fn check(sources: &BTreeMap<&str, &str>, found: &mut Vec<String>) {
    for circle in Crate::read(sources).circles() {
        let [first, rest @ ..] = &circle[..] else { continue };
        let chain = rest.iter().map(|file| format!(" imports {file}")).collect::<String>();
        found.push(format!("{first}{chain} imports {first}"));
    }
}

#[cfg(test)]
mod tests {
    use super::check;
    use std::collections::BTreeMap;

    fn circles(files: &[(&str, &str)]) -> Vec<String> {
        let sources: BTreeMap<&str, &str> = files.iter().copied().collect();
        let mut found = Vec::new();
        check(&sources, &mut found);
        found
    }

    #[test]
    fn two_files_that_import_each_other_are_named() {
        let found = circles(&[
            ("src/lib.rs", "mod a;\nmod b;\npub use a::A;\npub use b::B;\n"),
            ("src/a.rs", "use crate::B;\npub struct A(B);\n"),
            ("src/b.rs", "use super::a::A;\npub struct B(Option<Box<A>>);\n"),
        ]);
        assert_eq!(found, ["src/a.rs imports src/b.rs imports src/a.rs"]);
    }

    #[test]
    fn three_files_in_a_circle_are_named_whatever_form_the_import_has() {
        let found = circles(&[
            ("src/lib.rs", "mod a;\nmod b;\n"),
            ("src/a.rs", "pub fn a() { crate::b::c::c() }\n"),
            ("src/b/mod.rs", "pub mod c;\nuse crate::a;\npub fn b() { a::a() }\n"),
            ("src/b/c.rs", "use super::*;\npub fn c() { b() }\n"),
        ]);
        let expected =
            "src/a.rs imports src/b/c.rs imports src/b/mod.rs imports src/a.rs".to_owned();
        assert_eq!(found, [expected]);
    }

    #[test]
    fn a_parent_that_uses_what_it_exports_imports_it() {
        let child = ("src/a/b.rs", "use super::A;\npub fn b(a: &A) {}\n");
        let uses = "mod b;\npub use b::b;\npub struct A;\nimpl A { fn f(&self) { b(self) } }\n";
        let found = circles(&[("src/lib.rs", "mod a;\n"), ("src/a/mod.rs", uses), child]);
        assert_eq!(found, ["src/a/b.rs imports src/a/mod.rs imports src/a/b.rs"]);
    }

    #[test]
    fn a_parent_that_only_declares_and_exports_is_in_no_circle() {
        let found = circles(&[
            ("src/lib.rs", "//! `use a::A;`\npub mod a;\npub use a::{A, b as c};\n"),
            (
                "src/a/mod.rs",
                "mod b;\nmod d;\npub use b::b;\npub(crate) use d::*;\npub struct A;\n",
            ),
            ("src/a/b.rs", "use super::A;\npub fn b(a: &A) -> crate::a::D { crate::a::D }\n"),
            ("src/a/d.rs", "use crate::A;\npub struct D;\nimpl From<A> for D {}\n"),
        ]);
        assert_eq!(found, Vec::<String>::new());
    }

    #[test]
    fn what_tests_import_does_not_count() {
        let test = "pub fn a() {}\n#[cfg(test)]\nmod tests {\n    use crate::b::b;\n}\n";
        let found = circles(&[
            ("src/main.rs", "mod a;\nmod b;\nfn main() { b::b() }\n"),
            ("src/a.rs", test),
            ("src/b.rs", "use crate::a::a;\npub fn b() { a() }\n"),
        ]);
        assert_eq!(found, Vec::<String>::new());
    }
}
