//! X1 and X2: the worked tables of the RFID paper, which must come out exactly.

use nalgebra::{Matrix2, Point2};
use ogm_core::{Outcome, Segment, TagEstimate, TagId};
use ogm_vector::ogm_vector;
use rfid_loc::{SelectionParams, common_tags, select_tags};

use crate::measured::Measured;
use crate::report::{Criterion, Section, Table};

/// Table 1: directions of six walls, degrees.
const TABLE_1: [f64; 6] = [2.0, 90.0, -1.0, -89.0, 179.0, 79.0];
/// Table 2: the same after grouping, degrees, with the group of each.
const TABLE_2: [(f64, usize); 6] =
    [(2.0, 0), (90.0, 1), (-1.0, 0), (91.0, 1), (-1.0, 0), (79.0, 1)];

/// Table 3: tag, certainty in the first and in the second map, percent.
const TABLE_3: [(u32, f64, f64); 3] = [(5, 82.0, 92.0), (7, 99.0, 76.0), (9, 91.0, 92.0)];
/// The order that the paper derives, with the precision of each pair.
const TABLE_3_ORDER: [(u32, f64); 3] = [(9, 91.0), (5, 82.0), (7, 76.0)];

/// X1: the grouping of walls of Tables 1 and 2.
pub(crate) fn grouping_of_walls() -> Measured {
    let segments = TABLE_1.map(|degrees| {
        let direction = degrees.to_radians();
        let end = Point2::new(direction.cos(), direction.sin());
        Segment { start: Point2::origin(), end, direction, reliability: 1.0, support: 1 }
    });
    let mut ours = [(f64::NAN, usize::MAX); 6];
    if let Outcome::Found(vector) = ogm_vector(&segments, &ogm_vector::Params::default()) {
        for (number, group) in vector.groups.iter().enumerate() {
            for member in &group.members {
                ours[member.segment] = (member.direction.to_degrees(), number);
            }
        }
    }
    let equal = ours
        .iter()
        .zip(&TABLE_2)
        .filter(|(ours, paper)| (ours.0 - paper.0).abs() < 1e-9 && ours.1 == paper.1);
    let equal = equal.count();
    let rows = (0..6).map(|i| {
        vec![
            i.to_string(),
            format!("{}°", TABLE_1[i]),
            format!("{}°, group {}", TABLE_2[i].0, TABLE_2[i].1 + 1),
            format!("{:.0}°, group {}", ours[i].0, ours[i].1.wrapping_add(1)),
        ]
    });
    Measured::of_section(Section {
        id: "X1".to_owned(),
        title: "Grouping of walls (Tables 1 and 2)".to_owned(),
        analysis: "Six walls are sorted into two perpendicular groups around the first.".to_owned(),
        tables: vec![Table {
            caption: "Directions before and after the grouping.".to_owned(),
            header: ["wall", "Table 1", "Table 2", "ours"].map(str::to_owned).to_vec(),
            rows: rows.collect(),
        }],
        figures: Vec::new(),
        criteria: vec![Criterion {
            id: "X1".to_owned(),
            statement: "all six angles and groups of Table 2, exactly".to_owned(),
            paper: Some("6".to_owned()),
            ours: equal as f64,
            interval: None,
            pass: equal == 6,
        }],
    })
}

/// X2: the choice of tags of Table 3.
pub(crate) fn choice_of_tags() -> anyhow::Result<Measured> {
    let estimates = |pick: fn(&(u32, f64, f64)) -> f64| {
        TABLE_3.map(|row| TagEstimate {
            tag_id: row.0.into(),
            position: Point2::origin(),
            mode: Point2::origin(),
            covariance: Matrix2::zeros(),
            certainty: pick(&row) / 100.0,
            misfit: 1.0,
            readings: 1,
            dropped: 0,
            touches_border: false,
            second_peak_ratio: 0.0,
        })
    };
    let pairs = common_tags(&estimates(|row| row.1), &estimates(|row| row.2))?;
    let selected = select_tags(&pairs, &SelectionParams::default())?;
    let ours: Vec<(TagId, f64)> = match &selected {
        Outcome::Found(pairs) => {
            pairs.iter().map(|pair| (pair.tag_id(), pair.certainty() * 100.0)).collect()
        }
        Outcome::Refused(_) => Vec::new(),
    };
    let equal = ours
        .iter()
        .zip(&TABLE_3_ORDER)
        .filter(|(ours, paper)| ours.0 == paper.0.into() && (ours.1 - paper.1).abs() < 1e-9);
    let equal = equal.count();
    let rows = TABLE_3_ORDER.iter().enumerate().map(|(rank, (id, precision))| {
        let ours =
            ours.get(rank).map_or("refused".to_owned(), |o| format!("{} ({:.0} %)", o.0, o.1));
        vec![(rank + 1).to_string(), format!("{id} ({precision} %)"), ours]
    });
    Ok(Measured::of_section(Section {
        id: "X2".to_owned(),
        title: "Choice of tags (Table 3)".to_owned(),
        analysis: "Three common tags are ordered by the lesser of their two certainties."
            .to_owned(),
        tables: vec![Table {
            caption: "Order and precision of the pairs.".to_owned(),
            header: ["rank", "paper", "ours"].map(str::to_owned).to_vec(),
            rows: rows.collect(),
        }],
        figures: Vec::new(),
        criteria: vec![Criterion {
            id: "X2".to_owned(),
            statement: "tags 9, 5, 7 with 91, 82, 76 %, exactly".to_owned(),
            paper: Some("3".to_owned()),
            ours: equal as f64,
            interval: None,
            pass: equal == 3,
        }],
    }))
}
