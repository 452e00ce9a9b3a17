//! The criteria for machines.

use anyhow::Context;
use serde::Serialize;

use super::Report;

/// One criterion; the fields keep this order.
#[derive(Serialize)]
struct Entry<'a> {
    id: &'a str,
    experiment: &'a str,
    paper: Option<&'a str>,
    ours: f64,
    interval: Option<[f64; 2]>,
    criterion: &'a str,
    pass: bool,
}

/// One object a criterion, in the order of the report; numbers that are not finite become null.
///
/// # Errors
/// None that a report could cause; the serializer is asked all the same.
pub(crate) fn summary_json(report: &Report) -> anyhow::Result<String> {
    let entries: Vec<Entry<'_>> = report
        .criteria()
        .map(|(section, criterion)| Entry {
            id: &criterion.id,
            experiment: &section.id,
            paper: criterion.paper.as_deref(),
            ours: criterion.ours,
            interval: criterion.interval.map(|(low, high)| [low, high]),
            criterion: &criterion.statement,
            pass: criterion.pass,
        })
        .collect();
    let text = serde_json::to_string_pretty(&entries).context("cannot write the summary")?;
    Ok(text + "\n")
}

#[cfg(test)]
mod tests {
    use super::summary_json;
    use crate::report::sample;

    #[test]
    fn entries_keep_their_order_and_null_what_is_not_finite() {
        let text = summary_json(&sample::report()).unwrap();
        let fields = ["id", "experiment", "paper", "ours", "interval", "criterion", "pass"];
        let positions = fields.map(|name| text.find(&format!("\"{name}\"")).unwrap());
        assert!(positions.is_sorted(), "{positions:?}");

        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value[0]["id"], "X3a.sigma");
        assert_eq!(value[0]["experiment"], "X3a");
        assert_eq!(value[0]["ours"], 0.434);
        assert_eq!(value[0]["interval"], serde_json::json!([0.4, 0.47]));
        assert_eq!(value[1]["interval"], serde_json::json!([null, 1.0]));
        assert!(value[1]["ours"].is_null() && value[1]["paper"].is_null());
        assert_eq!(value[1]["pass"], false);
        assert!(value.get(2).is_none());
    }
}
