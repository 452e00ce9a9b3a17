//! Measured numbers put into documents that people write.

use anyhow::{bail, ensure};

/// `document` with the text between its two `marker` comments replaced by `content` under the
/// `command` that produced it; everything else stays as it is, to the byte.
///
/// # Errors
/// A marker that is missing, stands more than once, or in the wrong order; content that holds a
/// marker itself.
pub(crate) fn splice(
    document: &str,
    marker: &str,
    content: &str,
    command: &str,
) -> anyhow::Result<String> {
    let begin = format!("<!-- BEGIN: {marker} -->");
    let end = format!("<!-- END: {marker} -->");
    ensure!(
        !content.contains(&begin) && !content.contains(&end),
        "the text to put in holds a `{marker}` marker itself"
    );
    let from = position_of(document, &begin)? + begin.len();
    let to = position_of(document, &end)?;
    ensure!(from <= to, "`{end}` stands before `{begin}`");
    let (head, tail) = (&document[..from], &document[to..]);
    let content = content.trim_matches('\n');
    Ok(format!("{head}\n\nWritten by `{command}`:\n\n{content}\n\n{tail}"))
}

fn position_of(document: &str, marker: &str) -> anyhow::Result<usize> {
    let mut found = document.match_indices(marker).map(|(position, _)| position);
    match (found.next(), found.count()) {
        (Some(position), 0) => Ok(position),
        (Some(_), more) => bail!("`{marker}` stands {} times in the document", more + 1),
        (None, _) => bail!("`{marker}` is missing in the document"),
    }
}

#[cfg(test)]
mod tests {
    use super::splice;

    const BEGIN: &str = "<!-- BEGIN: results -->";
    const END: &str = "<!-- END: results -->";

    #[test]
    fn the_rest_of_the_document_keeps_every_byte() {
        let document = format!("# Title  \r\n{BEGIN}\nold\n{END}\n\ttail");
        let once = splice(&document, "results", "| a |\n", "cargo xtask compare").unwrap();
        let expected = format!(
            "# Title  \r\n{BEGIN}\n\nWritten by `cargo xtask compare`:\n\n| a |\n\n{END}\n\ttail"
        );
        assert_eq!(once, expected);
        let twice = splice(&once, "results", "| a |\n", "cargo xtask compare").unwrap();
        assert_eq!(twice, once, "splicing again changes nothing");
    }

    #[test]
    fn an_error_names_the_marker_that_is_wrong() {
        for (document, complaint) in [
            (format!("text {END}"), "`<!-- BEGIN: results -->` is missing"),
            (format!("{BEGIN} text"), "`<!-- END: results -->` is missing"),
            (format!("{BEGIN}{BEGIN}{END}"), "BEGIN: results -->` stands 2 times"),
            (format!("{BEGIN}{END}{END}{END}"), "END: results -->` stands 3 times"),
            (format!("{END}{BEGIN}"), "stands before"),
        ] {
            let error = splice(&document, "results", "x", "y").unwrap_err().to_string();
            assert!(error.contains(complaint), "{document}: {error}");
        }
        let error = splice(&format!("{BEGIN}{END}"), "results", END, "y").unwrap_err();
        assert!(error.to_string().contains("marker itself"));
    }
}
