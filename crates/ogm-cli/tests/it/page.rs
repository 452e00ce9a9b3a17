//! The page that a merge writes.

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use crate::{draw, ends_with, fixtures};

/// Addresses that the page loads or links to.
fn addresses(page: &str) -> Vec<&str> {
    let after = |mark| page.split(mark).skip(1);
    let parts = after("src=\"").chain(after("href=\"")).chain(after("url("));
    parts.map(|part| part.split(['"', ')']).next().unwrap()).collect()
}

#[test]
fn the_page_of_a_merge_needs_no_other_file_and_tells_what_the_report_does() {
    let folder = tempdir().unwrap();
    let command = "merge {F}/target.yaml {F}/source.yaml -o {T}/m.yaml --html {T}/r.html --json";
    let (said, _) = ends_with(0, folder.path(), command);
    let page = fs::read_to_string(folder.path().join("r.html")).unwrap();
    let addresses = addresses(&page);
    assert_eq!(addresses.len(), 3, "two maps and the merged one");
    assert!(addresses.iter().all(|one| one.starts_with("data:image/png;base64,")));
    assert!(!page.contains("http"), "nothing from a network");
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("type=\"range\""));

    let report: serde_json::Value = serde_json::from_str(&said).unwrap();
    let pair = &report["pairs"][0];
    for number in ["x_m", "y_m"] {
        let shown = format!("{:.3}", pair["target_from_source"][number].as_f64().unwrap());
        assert!(page.contains(&shown), "{shown}");
    }
    for text in [&pair["verdict"], &pair["target"]["sha256"], &pair["source"]["sha256"]] {
        assert!(page.contains(text.as_str().unwrap()), "{text}");
    }
    ends_with(1, folder.path(), command);
}

#[test]
fn a_refusal_has_a_page_and_names_of_files_are_text() {
    let folder = tempdir().unwrap();
    draw(folder.path(), "a<b>&", &".....\n".repeat(5));
    fs::copy(fixtures().join("target.yaml"), folder.path().join("t.yaml")).unwrap();
    for entry in fs::read_dir(fixtures()).unwrap() {
        let path = entry.unwrap().path();
        let is_image =
            |path: &Path| path.extension().is_some_and(|end| end == "pgm" || end == "png");
        if is_image(&path) {
            fs::copy(&path, folder.path().join(path.file_name().unwrap())).unwrap();
        }
    }
    let command = "merge {T}/t.yaml {T}/a<b>&.yaml -o {T}/m.yaml --html {T}/r.html";
    ends_with(3, folder.path(), command);
    let page = fs::read_to_string(folder.path().join("r.html")).unwrap();
    assert!(page.contains("Not merged") && page.contains("a&lt;b&gt;&amp;.yaml"));
    assert!(!page.contains("a<b>"), "a name is no tag");
    assert!(!folder.path().join("m.yaml").exists());
}
