//! House rules that no compiler holds: file heads, sizes, names, frames in names, circles of files,
//! left-overs.

#![expect(clippy::disallowed_methods, reason = "the rules are about files")]

mod circles;
mod frames;
mod text;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use text::line_number;

/// No source file is longer, tests included.
const MAX_LINES: usize = 400;
/// A `lib.rs` is a table of contents.
const MAX_LIB_LINES: usize = 100;
/// Where a file of this workspace cannot be on another machine.
const MACHINE_PATHS: [&str; 3] = ["/work", "/tmp/", "/home/"];
const LEFT_OVERS: [&str; 3] = ["TODO", "FIXME", "XXX"];
/// The rules name what they forbid.
const RULEBOOK: &str = "xtask/src/tidy/";

/// What in the workspace at `root` breaks a house rule, as "path:line: what"; empty if all is well.
pub(crate) fn problems(root: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let mut sources: BTreeMap<String, String> = BTreeMap::new();
    for path in text_files(root, &mut found) {
        let text = match fs::read_to_string(root.join(&path)) {
            Ok(text) => text,
            Err(error) => {
                found.push(format!("{path}: {error}"));
                continue;
            }
        };
        check_layout(&path, &text, &mut found);
        if !path.starts_with(RULEBOOK) {
            check_words(&path, &text, &mut found);
        }
        if path.ends_with(".rs") {
            check_source(&path, &text, &mut found);
        }
        if is_member_manifest(&path) {
            check_member(root, &path, &text, &mut found);
        }
        if path.ends_with(".rs") {
            sources.insert(path, text);
        }
    }
    check_circles(&sources, &mut found);
    if sources.is_empty() {
        found.push("no source file: is this the root of the workspace?".to_owned());
    }
    found
}

/// Rules on the files of a crate together.
fn check_circles(sources: &BTreeMap<String, String>, found: &mut Vec<String>) {
    let mut crates: BTreeMap<&str, BTreeMap<&str, &str>> = BTreeMap::new();
    for (path, text) in sources {
        if let Some((package, _)) = path.split_once("/src/") {
            crates.entry(package).or_default().insert(path, text);
        }
    }
    for sources in crates.values() {
        circles::check(sources, found);
    }
}

/// Sources, manifests and documents below `root`, relative to it with `/`, in a fixed order.
fn text_files(root: &Path, found: &mut Vec<String>) -> Vec<String> {
    let mut files = Vec::new();
    let mut folders = vec![String::new()];
    while let Some(folder) = folders.pop() {
        let entries = match fs::read_dir(root.join(&folder)) {
            Ok(entries) => entries.flatten(),
            Err(error) => {
                found.push(format!("{folder}: {error}"));
                continue;
            }
        };
        for entry in entries {
            let name = entry.file_name().to_string_lossy().into_owned();
            let path = if folder.is_empty() { name.clone() } else { format!("{folder}/{name}") };
            // Unlike the type of the entry, this follows a link.
            if entry.path().is_dir() {
                if name != "target"
                    && (!name.starts_with('.') || matches!(&*name, ".ci" | ".cargo"))
                {
                    folders.push(path);
                }
            } else if is_text(&path) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

fn is_text(path: &str) -> bool {
    let ending = Path::new(path).extension().and_then(|ending| ending.to_str());
    matches!(ending, Some("rs" | "md" | "toml" | "css")) || path.starts_with(".ci/")
}

/// Rules on white space and on the file as a whole.
fn check_layout(path: &str, text: &str, found: &mut Vec<String>) {
    if !text.ends_with('\n') || text.ends_with("\n\n") {
        found.push(format!("{path}: does not end with one newline"));
    }
    for (number, line) in (1..).zip(text.split_terminator('\n')) {
        if line.ends_with(char::is_whitespace) {
            found.push(format!("{path}:{number}: trailing white space"));
        }
    }
}

/// Rules on what text may say.
fn check_words(path: &str, text: &str, found: &mut Vec<String>) {
    for (number, line) in (1..).zip(text.lines()) {
        for machine in MACHINE_PATHS {
            if stands_alone(line, machine, |c| c.is_alphanumeric() || "_-.~})".contains(c)) {
                found.push(format!("{path}:{number}: {machine} is a path of one machine"));
            }
        }
        for word in LEFT_OVERS {
            if stands_alone(line, word, |c| c.is_alphanumeric() || c == '_') {
                found.push(format!("{path}:{number}: {word} left over"));
            }
        }
    }
}

/// Whether `word` stands in `line` with no character of its kind before it, nor a letter or digit
/// after it unless it ends with a slash.
fn stands_alone(line: &str, word: &str, joins: impl Fn(char) -> bool) -> bool {
    line.match_indices(word).any(|(position, _)| {
        let (before, after) = (&line[..position], &line[position + word.len()..]);
        let open_end = word.ends_with('/') || !after.starts_with(|c: char| c.is_alphanumeric());
        open_end && !before.ends_with(&joins)
    })
}

/// Rules on Rust sources.
fn check_source(path: &str, text: &str, found: &mut Vec<String>) {
    if !text.starts_with("//!") {
        found.push(format!("{path}: does not start with a line of `//!`"));
    }
    let lines = text.lines().count();
    let limit = if path.ends_with("src/lib.rs") { MAX_LIB_LINES } else { MAX_LINES };
    if lines > limit {
        found.push(format!("{path}: {lines} lines, at most {limit}"));
    }
    let stem = path.trim_end_matches("/mod.rs").trim_end_matches(".rs");
    let stem = stem.rsplit('/').next().unwrap_or(stem);
    let vague = matches!(stem, "utils" | "common" | "types" | "prelude");
    if vague || stem.starts_with("helper") || stem.starts_with("manager") {
        found.push(format!("{path}: `{stem}` says nothing about what is in it"));
    }
    if !path.starts_with(RULEBOOK) {
        check_attributes(path, text, found);
        frames::check(path, text, found);
    }
}

/// Every `allow` says why.
fn check_attributes(path: &str, text: &str, found: &mut Vec<String>) {
    for (position, opening) in text.match_indices("[allow(") {
        let attribute = &text[position + opening.len()..];
        let attribute = &attribute[..attribute.find(']').unwrap_or(attribute.len())];
        if text[..position].ends_with(['#', '!']) && !attribute.contains("reason") {
            let number = line_number(text, position);
            found.push(format!("{path}:{number}: `allow` without a reason"));
        }
    }
}

/// Whether `path` is the manifest of a workspace member.
fn is_member_manifest(path: &str) -> bool {
    let parts: Vec<&str> = path.split('/').collect();
    matches!(parts[..], ["crates", _, "Cargo.toml"] | ["xtask", "Cargo.toml"])
}

/// Rules on a member of the workspace.
fn check_member(root: &Path, path: &str, manifest: &str, found: &mut Vec<String>) {
    if !manifest.contains("[lints]\nworkspace = true") {
        found.push(format!("{path}: does not inherit the lints of the workspace"));
    }
    let readme = path.replace("Cargo.toml", "README.md");
    if path.starts_with("crates/") && !root.join(&readme).is_file() {
        found.push(format!("{readme}: is missing"));
    }
}

#[cfg(test)]
mod tests {
    use super::problems;
    use std::fs;
    use std::path::Path;

    #[test]
    fn the_workspace_is_tidy() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let found = problems(&root);
        assert!(found.is_empty(), "{}", found.join("\n"));
    }

    const MANIFEST: &str = "[package]\nname = \"a\"\n\n[lints]\nworkspace = true\n";

    /// The problems of a small workspace, clean but for what `files` add or replace.
    fn found_with(files: &[(&str, &str)]) -> Vec<String> {
        let root = tempfile::tempdir().unwrap();
        let clean = [
            ("crates/a/Cargo.toml", MANIFEST),
            ("crates/a/README.md", "# a\n"),
            ("crates/a/src/lib.rs", "//! A crate.\n"),
        ];
        for (path, text) in clean.iter().chain(files) {
            let path = root.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        problems(root.path())
    }

    #[test]
    fn every_rule_can_be_broken() {
        let long = format!("//! Long.\n{}", "// line\n".repeat(400));
        let long_lib = format!("//! Long.\n{}", "// line\n".repeat(100));
        for (path, text, complaint) in [
            ("crates/a/src/b.rs", "//! B.\npub pose: Se2,\n", "b.rs:2: `pose: Se2` is not"),
            ("crates/a/src/b.rs", "fn b() {}\n", "b.rs: does not start with"),
            ("crates/a/src/b.rs", long.as_str(), "b.rs: 401 lines, at most 400"),
            ("crates/a/src/lib.rs", long_lib.as_str(), "lib.rs: 101 lines, at most 100"),
            ("crates/a/src/utils.rs", "//! B.\n", "`utils` says nothing"),
            ("crates/a/src/common/mod.rs", "//! B.\n", "`common` says nothing"),
            ("xtask/src/helpers.rs", "//! B.\n", "`helpers` says nothing"),
            ("crates/a/src/manager.rs", "//! B.\n", "`manager` says nothing"),
            ("crates/a/src/types.rs", "//! B.\n", "`types` says nothing"),
            ("crates/a/src/prelude.rs", "//! B.\n", "`prelude` says nothing"),
            ("crates/a/src/b.rs", "//! B.\n#[allow(dead_code)]\n", "b.rs:2: `allow` without"),
            ("crates/a/src/b.rs", "//! B.\n#![allow(\n    unused,\n)]\n", ":2: `allow` without"),
            ("crates/a/README.md", "See /work/main.\n", "README.md:1: /work is a path"),
            ("crates/a/src/b.rs", "//! B.\n// \"/tmp/x\"\n", "b.rs:2: /tmp/ is a path"),
            ("docs/b.md", "file:///home/me\n", "docs/b.md:1: /home/ is a path"),
            ("docs/b.md", "two  \nlines\n", "docs/b.md:1: trailing white space"),
            (".ci/run", "echo\t\n", ".ci/run:1: trailing white space"),
            ("docs/b.md", "no newline", "docs/b.md: does not end with one newline"),
            ("docs/b.md", "two newlines\n\n", "docs/b.md: does not end with one newline"),
            ("docs/b.md", "carriage\r\n", "docs/b.md:1: trailing white space"),
            ("crates/a/src/b.rs", "//! B.\n// TODO: more\n", "b.rs:2: TODO left over"),
            ("crates/a/src/b.rs", "//! B. FIXME\n", "b.rs:1: FIXME left over"),
            ("crates/a/Cargo.toml", &format!("# XXX\n{MANIFEST}"), "Cargo.toml:1: XXX left over"),
            ("xtask/Cargo.toml", "[package]\n", "xtask/Cargo.toml: does not inherit the lints"),
            ("crates/b/Cargo.toml", MANIFEST, "crates/b/README.md: is missing"),
        ] {
            let found = found_with(&[(path, text)]);
            assert_eq!(found.len(), 1, "{path} {text:?} gives {found:?}");
            assert!(found[0].contains(complaint), "{path} {text:?} gives {found:?}");
        }
    }

    #[test]
    fn files_that_import_each_other_are_found_in_their_own_crate_only() {
        let a = "//! A.\nuse crate::b::B;\npub struct A(B);\n";
        let b = "//! B.\nuse crate::a::A;\npub struct B(A);\n";
        let lib = "//! A crate.\nmod a;\nmod b;\n";
        let circle =
            [("crates/a/src/lib.rs", lib), ("crates/a/src/a.rs", a), ("crates/a/src/b.rs", b)];
        let expected = "crates/a/src/a.rs imports crates/a/src/b.rs imports crates/a/src/a.rs";
        assert_eq!(found_with(&circle), [expected]);
        let apart = [("crates/a/src/a.rs", a), ("xtask/src/b.rs", b)];
        assert_eq!(found_with(&apart), Vec::<String>::new());
    }

    #[test]
    fn what_only_looks_like_a_breach_is_none() {
        let source = "//! B.\n#[allow(dead_code, reason = \"why\")]\n\
            // target/tmp/x, https://a.org/work, /workspace, a TODOS list\n";
        let limits = format!("//! B.\n{}", "// line\n".repeat(399));
        let files = [("crates/a/src/b.rs", source), ("crates/a/src/c.rs", &limits)];
        assert_eq!(found_with(&files), Vec::<String>::new());
        let ignored = [("target/b.md", "no newline"), (".git/b.md", "no newline")];
        assert_eq!(found_with(&ignored), Vec::<String>::new());
    }

    #[test]
    fn a_folder_without_sources_is_not_tidy_but_wrong() {
        let empty = tempfile::tempdir().unwrap();
        assert_eq!(problems(empty.path()).len(), 1);
        assert!(!problems(&empty.path().join("missing")).is_empty());
    }
}
