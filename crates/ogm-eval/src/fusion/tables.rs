//! The tables of the fused pairs.

use grid_merge::FusionQuality;
use ogm_merge::FusionRule;

use super::record::{Fused, Pose};
use crate::report::Table;
use crate::stats::median;

/// What is bounded, and by how much.
type Bound = (&'static str, &'static str, fn(&[&Fused], FusionRule) -> Vec<f64>);

const BOUNDS: [Bound; 5] = [
    ("walls lost, % of an input's", "median 1, worst 5", |fused, rule| {
        let qualities = fused.iter().filter_map(|one| one.quality(rule));
        let shares = qualities.flat_map(|quality| {
            quality.inputs.iter().map(|input| 100.0 * input.lost as f64 / input.walls.max(1) as f64)
        });
        shares.collect()
    }),
    ("conflicts, % of the wall, maps of one drive", "5", |fused, rule| {
        let unchanged = fused.iter().filter(|one| one.one_session);
        let qualities = unchanged.filter_map(|one| one.quality(rule));
        qualities.map(|quality| 100.0 * quality.conflict_share()).collect()
    }),
    ("conflicts, % of the wall, all", "–", |fused, rule| {
        let qualities = fused.iter().filter_map(|one| one.quality(rule));
        qualities.map(|quality| 100.0 * quality.conflict_share()).collect()
    }),
    ("walls thicker than the thicker input's, cells", "0.5", |fused, rule| {
        let thicker = |one: &&Fused| Some(one.quality(rule)?.thicker_cells(one.resolution));
        fused.iter().filter_map(thicker).collect()
    }),
    ("free in both and closed, %", "0.5", |fused, rule| {
        let qualities = fused.iter().filter_map(|one| one.quality(rule));
        qualities.map(|quality| 100.0 * quality.closed_share()).collect()
    }),
];

pub(super) fn all(fused: &[Fused]) -> Vec<Table> {
    vec![summary(fused), by_pair(fused)]
}

fn summary(fused: &[Fused]) -> Table {
    let everything: Vec<&Fused> = fused.iter().collect();
    let rules: Vec<FusionRule> = fused
        .first()
        .map_or(Vec::new(), |one| one.qualities.iter().map(|(rule, _)| *rule).collect());
    let rows = BOUNDS.iter().map(|(what, bound, values)| {
        let of_rules = rules.iter().map(|&rule| {
            let values = values(&everything, rule);
            let worst = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            format!("{:.2} / {worst:.2}", median(&values).unwrap_or(f64::NAN))
        });
        [(*what).to_owned(), (*bound).to_owned()].into_iter().chain(of_rules).collect()
    });
    let names = rules.iter().map(|rule| format!("{rule:?}"));
    Table {
        caption: format!("Median / worst over {} pairs.", fused.len()),
        header: ["", "at most"].map(str::to_owned).into_iter().chain(names).collect(),
        rows: rows.collect(),
    }
}

fn by_pair(fused: &[Fused]) -> Table {
    let rows = fused.iter().filter_map(|one| {
        let quality: &FusionQuality = one.quality(FusionRule::KeepWalls)?;
        let lost = quality
            .inputs
            .iter()
            .map(|input| format!("{:.2}", 100.0 * input.lost as f64 / input.walls.max(1) as f64));
        let mut row = vec![one.name.clone()];
        row.push(match one.pose {
            Pose::Found => "found".to_owned(),
            Pose::True => "true".to_owned(),
        });
        row.extend(lost);
        row.push(format!("{:.1}", 100.0 * quality.conflict_share()));
        row.push(format!("{:.2}", quality.thicker_cells(one.resolution)));
        row.push(format!("{:.2}", 100.0 * quality.closed_share()));
        Some(row)
    });
    Table {
        caption: "Under keep-walls. Pose: the matcher's where it answered rightly, else the true \
                  one, of whose uncertainty nothing is said."
            .to_owned(),
        header: [
            "pair",
            "pose",
            "lost of A, %",
            "lost of B, %",
            "conflicts, % of the wall",
            "thicker, cells",
            "closed, %",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows: rows.collect(),
    }
}
