//! The layers of the workspace, held against the manifests.
//!
//! `ogm-core` stands on nothing of ours. Crates of one idea stand on `ogm-core` and not on each
//! other; their tests may use `ogm-sim`. `ogm-merge` composes them. The proof measures all of
//! these and is for `xtask` alone. The tools use anything else.

use serde_json::Value;

/// Registry crates that only these packages may depend on directly.
const HOMES: [(&str, &[&str]); 5] = [
    ("faer", &["pose-graph2d"]),
    ("parry2d", &["icp2d"]),
    ("image", &["ogm-io", "ogm-view", "ogm-bench", "ogm-eval"]),
    ("granit-parser", &["ogm-io"]),
    ("wait4", &["ogm-eval"]),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Layer {
    /// The words that all share.
    Vocabulary,
    /// One idea each.
    Idea,
    /// Recipes over the ideas.
    Composition,
    /// What measures all of these.
    Proof,
    /// What touches the world.
    Tool,
}

/// The layer of a package; what is not listed is held to the strictest rule that a new crate can
/// meet.
fn layer(package: &str) -> Layer {
    match package {
        "ogm-core" => Layer::Vocabulary,
        "ogm-merge" => Layer::Composition,
        "ogm-eval" => Layer::Proof,
        "ogm-cli" | "ogm-bench" | "xtask" => Layer::Tool,
        _ => Layer::Idea,
    }
}

fn may_depend(from: &str, to: &str, for_tests_only: bool) -> bool {
    match (layer(from), layer(to)) {
        (Layer::Vocabulary, _) => false,
        (Layer::Idea, Layer::Vocabulary) => true,
        (Layer::Idea, _) => for_tests_only && to == "ogm-sim",
        (Layer::Composition, to) => matches!(to, Layer::Vocabulary | Layer::Idea),
        (Layer::Proof, to) => !matches!(to, Layer::Proof | Layer::Tool),
        (Layer::Tool, Layer::Proof) => from == "xtask",
        (Layer::Tool, _) => true,
    }
}

/// What the command must not use: what a search needs is chosen, tried and believed below it.
const NOT_FOR_THE_COMMAND: [&str; 7] =
    ["grid-match", "carpin-walk", "radon-merge", "rfid-loc", "icp2d", "line-ransac", "ogm-vector"];

/// Edges of the output of `cargo metadata --no-deps` that the layers forbid, and what keeps them
/// from being judged.
fn violations(metadata: &Value) -> Vec<String> {
    let packages = metadata["packages"].as_array().map_or(&[][..], Vec::as_slice);
    let names: Vec<&str> = packages.iter().filter_map(|package| package["name"].as_str()).collect();
    if !names.contains(&"ogm-core") {
        return vec!["the metadata holds no ogm-core".to_owned()];
    }
    let mut found = Vec::new();
    for package in packages {
        let from = package["name"].as_str().unwrap_or_default();
        for edge in package["dependencies"].as_array().into_iter().flatten() {
            let to = edge["name"].as_str().unwrap_or_default();
            let for_tests_only = edge["kind"] == "dev";
            if names.contains(&to) && !may_depend(from, to, for_tests_only) {
                let kind = if for_tests_only { " in its tests" } else { "" };
                found.push(format!("{from} depends on {to}{kind}"));
            }
            if from == "ogm-cli" && !for_tests_only && NOT_FOR_THE_COMMAND.contains(&to) {
                found.push(format!("{from} depends on {to}, which ogm-merge calls for it"));
            }
            let home = HOMES.iter().find(|(guest, _)| *guest == to);
            if let Some((_, hosts)) = home.filter(|(_, hosts)| !hosts.contains(&from)) {
                found.push(format!("{from} depends on {to}, which is for {}", hosts.join(", ")));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::violations;
    use serde_json::{Value, json};
    use std::path::Path;
    use std::process::Command;

    #[test]
    fn the_workspace_keeps_its_layers() {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let output = Command::new(cargo)
            .args(["metadata", "--no-deps", "--format-version", "1"])
            .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let found = violations(&serde_json::from_slice(&output.stdout).unwrap());
        assert!(found.is_empty(), "{}", found.join("\n"));
    }

    /// Metadata of a workspace with one dependency; packages that it does not name exist too.
    fn edge(from: &str, to: &str, kind: Value) -> Value {
        let others = ["ogm-core", "icp2d", "ogm-sim", "ogm-merge", "ogm-eval", "ogm-cli", "xtask"];
        let mut packages: Vec<Value> = others
            .iter()
            .filter(|name| **name != from)
            .map(|name| json!({ "name": name, "dependencies": [] }))
            .collect();
        packages.push(json!({ "name": from, "dependencies": [{ "name": to, "kind": kind }] }));
        json!({ "packages": packages })
    }

    #[test]
    fn forbidden_edges_are_found() {
        let normal = || Value::Null;
        for (from, to, kind) in [
            ("ogm-core", "icp2d", normal()),
            ("ogm-core", "ogm-sim", json!("dev")),
            ("line-ransac", "icp2d", normal()),
            ("line-ransac", "icp2d", json!("dev")),
            ("line-ransac", "ogm-sim", normal()),
            ("line-ransac", "ogm-sim", json!("build")),
            ("a-new-crate", "ogm-merge", normal()),
            ("ogm-merge", "xtask", json!("dev")),
            ("ogm-cli", "grid-match", normal()),
            ("ogm-cli", "ogm-vector", json!("build")),
            ("icp2d", "image", normal()),
            ("ogm-merge", "image", json!("dev")),
            ("ogm-merge", "ogm-eval", json!("dev")),
            ("ogm-sim", "ogm-eval", normal()),
            ("ogm-cli", "ogm-eval", normal()),
            ("ogm-bench", "ogm-eval", normal()),
            ("ogm-eval", "ogm-cli", normal()),
            ("ogm-eval", "xtask", json!("dev")),
            ("xtask", "parry2d", normal()),
            ("xtask", "image", normal()),
            ("xtask", "wait4", normal()),
            ("xtask", "granit-parser", normal()),
            ("ogm-merge", "faer", normal()),
        ] {
            let found = violations(&edge(from, to, kind.clone()));
            assert_eq!(found.len(), 1, "{from} to {to}, {kind}: {found:?}");
            assert!(found[0].starts_with(&format!("{from} depends on {to}")), "{found:?}");
        }
    }

    #[test]
    fn edges_of_the_layers_are_not() {
        let normal = || Value::Null;
        for (from, to, kind) in [
            ("line-ransac", "ogm-core", normal()),
            ("line-ransac", "ogm-sim", json!("dev")),
            ("line-ransac", "nalgebra", normal()),
            ("ogm-merge", "icp2d", normal()),
            ("ogm-merge", "ogm-sim", json!("dev")),
            ("ogm-cli", "ogm-merge", normal()),
            ("ogm-cli", "ogm-sim", json!("dev")),
            ("xtask", "ogm-merge", normal()),
            ("ogm-eval", "icp2d", normal()),
            ("ogm-eval", "ogm-merge", normal()),
            ("ogm-eval", "image", normal()),
            ("xtask", "ogm-eval", normal()),
            ("ogm-io", "granit-parser", normal()),
            ("icp2d", "parry2d", normal()),
        ] {
            let found = violations(&edge(from, to, kind));
            assert!(found.is_empty(), "{found:?}");
        }
    }

    #[test]
    fn metadata_of_something_else_is_not_a_pass() {
        assert_eq!(violations(&json!({})).len(), 1);
        assert_eq!(violations(&json!({ "packages": [] })).len(), 1);
    }
}
