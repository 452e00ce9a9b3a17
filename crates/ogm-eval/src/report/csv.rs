//! Comma-separated values.

/// Rows under a header, quoted as RFC 4180 asks and no more, each line ended by `\n`.
pub(crate) fn csv<H: AsRef<str>, C: AsRef<str>>(header: &[H], rows: &[Vec<C>]) -> String {
    let mut text = line(header);
    for row in rows {
        text.push_str(&line(row));
    }
    text
}

fn line<C: AsRef<str>>(cells: &[C]) -> String {
    let fields: Vec<String> = cells.iter().map(|cell| field(cell.as_ref())).collect();
    fields.join(",") + "\n"
}

fn field(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::csv;

    #[test]
    fn only_what_needs_quotes_has_them() {
        let rows = [vec!["1.5", "a, b"], vec!["say \"no\"", "two\nlines"], vec!["", "±"]];
        let expected = "x,\"y,z\"\n1.5,\"a, b\"\n\"say \"\"no\"\"\",\"two\nlines\"\n,±\n";
        assert_eq!(csv(&["x", "y,z"], &rows), expected);
    }
}
