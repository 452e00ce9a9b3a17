//! Motions say in their names which frames they join.

use super::text::line_number;

/// Every field, parameter and typed variable of type `Se2` names both of its frames. The type's own
/// file and tests may speak of any two motions.
pub(super) fn check(path: &str, text: &str, found: &mut Vec<String>) {
    if path.ends_with("/se2.rs") || path.contains("/tests/") {
        return;
    }
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or(text);
    for (position, _) in code.match_indices("Se2") {
        let (before, after) = (&code[..position], &code[position + 3..]);
        let ends = after.starts_with([',', ')', '\n', ' ', '|', '>', ';']);
        let Some(name) = declared_name(before).filter(|_| ends) else {
            continue;
        };
        let both = name.split_once("_from_");
        if !both.is_some_and(|(to, from)| !to.is_empty() && !from.is_empty()) {
            let number = line_number(code, position);
            found
                .push(format!("{path}:{number}: `{name}: Se2` is not called `target_from_source`"));
        }
    }
}

/// The name that a type after `before` is given to, references and `Option` aside.
fn declared_name(before: &str) -> Option<&str> {
    let mut rest = before.trim_end_matches("ogm_core::");
    for prefix in ["Option<", "mut ", "&"] {
        rest = rest.strip_suffix(prefix).unwrap_or(rest);
    }
    let rest = rest.strip_suffix(": ")?;
    let start = rest.rfind(|c: char| !c.is_alphanumeric() && c != '_').map_or(0, |at| at + 1);
    let name = &rest[start..];
    name.starts_with(|c: char| c.is_lowercase() || c == '_').then_some(name)
}

#[cfg(test)]
mod tests {
    use super::check;

    fn found_in(path: &str, text: &str) -> Vec<String> {
        let mut found = Vec::new();
        check(path, text, &mut found);
        found
    }

    #[test]
    fn a_motion_without_its_frames_is_found_wherever_it_is_declared() {
        for (text, name) in [
            ("pub struct A {\n    pub pose: Se2,\n}\n", "pose"),
            ("struct A { pose: Option<Se2> }", "pose"),
            ("struct A(Se2);\nfn f(a: u8, start: &Se2) {}", "start"),
            ("fn f(start: &mut Se2) {}", "start"),
            ("fn f(_from_b: ogm_core::Se2) {}", "_from_b"),
            ("let a_from_: Se2 = x;", "a_from_"),
            ("let f = |turn: Se2| turn;", "turn"),
        ] {
            let found = found_in("a.rs", text);
            assert_eq!(found.len(), 1, "{text} gives {found:?}");
            assert!(found[0].contains(&format!("`{name}: Se2`")), "{text} gives {found:?}");
        }
        assert!(found_in("a.rs", "\n\nfn f(pose: Se2) {}")[0].starts_with("a.rs:3: "));
    }

    #[test]
    fn motions_with_frames_and_other_uses_of_the_type_are_none() {
        for text in [
            "fn f(a_from_b: Se2, start_target_from_source: &Se2) -> Se2 { Se2::new(0.0) }",
            "fn f(poses: &[Se2], x: Se2Thing) {}",
            "impl Mul<Se2> for A {}",
            "use ogm_core::{Se2, Segment};",
            "#[cfg(test)]\nmod tests {\n    fn distance(a: Se2, b: Se2) {}\n}\n",
        ] {
            assert_eq!(found_in("a.rs", text), Vec::<String>::new(), "{text}");
        }
        for path in ["src/se2.rs", "crates/a/tests/b.rs"] {
            assert!(found_in(path, "fn f(a: Se2) {}").is_empty(), "{path}");
        }
    }
}
