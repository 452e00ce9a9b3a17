//! Rust sources as words and signs: enough to see what a file imports, and no more.

/// The words and signs of a source: no comments, no literals, no modules for tests.
///
/// `::` is one sign; every other sign is one character.
pub(super) fn tokens(source: &str) -> Vec<String> {
    without_tests(split(&without_literals(source)))
}

/// Comments, strings and characters as white space.
fn without_literals(source: &str) -> String {
    let chars: Vec<char> = source.chars().collect();
    let mut code = String::with_capacity(source.len());
    let mut at = 0;
    while at < chars.len() {
        let end = literal_end(&chars, at);
        code.push(if end > at { ' ' } else { chars[at] });
        at = end.max(at + 1);
    }
    code
}

/// Behind the literal or comment that begins at `at`; `at` if none does.
fn literal_end(chars: &[char], at: usize) -> usize {
    let next = |offset: usize| chars.get(at + offset).copied().unwrap_or('\0');
    let starts_word = at == 0 || !is_word(chars[at - 1]);
    match chars[at] {
        '/' if next(1) == '/' => end_of(chars, at, "\n"),
        '/' if next(1) == '*' => end_of(chars, at + 2, "*/"),
        '"' => quoted_end(chars, at + 1, '"'),
        'r' if starts_word && (next(1) == '"' || next(1) == '#') => raw_end(chars, at + 1),
        'b' if starts_word && next(1) == 'r' && matches!(next(2), '"' | '#') => {
            raw_end(chars, at + 2)
        }
        // A lifetime has no second quote.
        '\'' if next(1) == '\\' || next(2) == '\'' => quoted_end(chars, at + 1, '\''),
        _ => at,
    }
}

/// Behind the first `pattern` from `from` on.
fn end_of(chars: &[char], from: usize, pattern: &str) -> usize {
    let pattern: Vec<char> = pattern.chars().collect();
    let found = (from..chars.len()).find(|&at| chars[at..].starts_with(&pattern));
    found.map_or(chars.len(), |at| at + pattern.len())
}

/// Behind the next `quote` without a backslash before it.
fn quoted_end(chars: &[char], from: usize, quote: char) -> usize {
    let mut at = from;
    while at < chars.len() && chars[at] != quote {
        at += if chars[at] == '\\' { 2 } else { 1 };
    }
    at + 1
}

/// Behind a raw string whose signs begin at `from`; `from - 1` for a raw identifier.
fn raw_end(chars: &[char], from: usize) -> usize {
    let hashes = chars[from..].iter().take_while(|&&c| c == '#').count();
    if chars.get(from + hashes) != Some(&'"') {
        return from - 1;
    }
    end_of(chars, from + hashes + 1, &format!("\"{}", "#".repeat(hashes)))
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn split(code: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else if rest.starts_with("::") {
            2
        } else {
            first.len_utf8()
        };
        tokens.push(rest[..length].to_owned());
        rest = rest[length..].trim_start();
    }
    tokens
}

/// Leaves out what stands under `#[cfg(test)]`.
fn without_tests(tokens: Vec<String>) -> Vec<String> {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while at < tokens.len() {
        if tokens[at..].iter().take(MARK.len()).eq(MARK) {
            at = item_end(&tokens, at + MARK.len());
        } else {
            kept.push(tokens[at].clone());
            at += 1;
        }
    }
    kept
}

/// Behind the item that begins at `from`: its block, or its semicolon.
fn item_end(tokens: &[String], from: usize) -> usize {
    let mut depth = 0_usize;
    for (at, token) in tokens.iter().enumerate().skip(from) {
        match token.as_str() {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => {
                depth = depth.saturating_sub(1);
                if depth == 0 && token == "}" {
                    return at + 1;
                }
            }
            ";" if depth == 0 => return at + 1,
            _ => {}
        }
    }
    tokens.len()
}

#[cfg(test)]
mod tests {
    use super::tokens;

    #[test]
    fn only_code_is_left() {
        let source = r##"
            //! use crate::a;
            /* use crate::b; */
            use crate::c;
            fn f<'a>(x: &'a str) -> char { let q = '\''; let b = '"'; r#"use crate::d;"#; q }
            #[cfg(test)]
            mod tests { use crate::e; fn g() { "}" } }
            #[cfg(test)]
            mod only_tests;
            fn h() {}
        "##;
        let text = tokens(source).join(" ");
        assert!(text.starts_with("use crate :: c ; fn f < ' a > ("), "{text}");
        assert!(text.ends_with("q } fn h ( ) { }"), "{text}");
    }
}
