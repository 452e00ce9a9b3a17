//! The charts of X4: error by method and regime.

use super::record::{Cell, MATCH, REGIMES, TABLE_4, case_name, case_without_tags};
use crate::cases::worlds::Building;
use crate::draw::{Bars, Chart, Mark, Series, bars, chart};
use crate::judge::METHOD_3;
use crate::measured::Run;
use crate::report::{Figure, Image};
use crate::stats::Summary;

/// Mean error of each method beside the paper's, and how the errors are spread.
pub(super) fn draw(runs: &[Run]) -> Vec<Figure> {
    vec![
        Figure {
            name: "table-4".to_owned(),
            caption: "Mean squared displacement of each method on random plans, beside the \
                      paper's Table 4."
                .to_owned(),
            image: Image::Svg(means(runs)),
        },
        Figure {
            name: "error-spread".to_owned(),
            caption: "Share of the unrefused runs on random plans whose error is at most this, \
                      tags + 10 px; match takes no tags."
                .to_owned(),
            image: Image::Svg(spread(runs, 10.0)),
        },
    ]
}

fn means(runs: &[Run]) -> String {
    let mean = |case: &str, variant: &str| {
        Summary::of(&Cell::new(runs, case, variant).mse_disp()).map_or(f64::NAN, |s| s.mean)
    };
    let paper = TABLE_4.iter().map(|(_, mse, _)| mse.parse().unwrap_or(f64::NAN));
    let ours = REGIMES.map(|sigma_px| {
        let case = case_name(Building::Random, sigma_px);
        let means = TABLE_4.map(|(variant, ..)| mean(&case, variant));
        (format!("tags + {sigma_px:.0} px"), means.to_vec())
    });
    let matched = mean(&case_without_tags(Building::Random), MATCH);
    let none = TABLE_4.map(|_| f64::NAN);
    let groups = TABLE_4.map(|(variant, ..)| variant).into_iter().chain([MATCH]);
    bars(&Bars {
        title: "Mean squared displacement".to_owned(),
        y_label: "px² of 0.02 m".to_owned(),
        log_y: true,
        groups: groups.map(str::to_owned).collect(),
        series: std::iter::once(("paper".to_owned(), paper.collect()))
            .chain(ours)
            .chain([("without tags".to_owned(), [&none[..], &[matched]].concat())])
            .collect(),
    })
}

fn spread(runs: &[Run], sigma_px: f64) -> String {
    let case = case_name(Building::Random, sigma_px);
    let curve = |case: &str, variant: &str| {
        let mut errors = Cell::new(runs, case, variant).mse_disp();
        errors.sort_by(f64::total_cmp);
        let count = errors.len() as f64;
        let points = errors.into_iter().enumerate();
        Series {
            name: variant.to_owned(),
            points: points.map(|(i, mse)| (100.0 * (i + 1) as f64 / count, mse)).collect(),
            mark: Mark::Line,
        }
    };
    let by_tags = TABLE_4.map(|(variant, ..)| curve(&case, variant));
    let by_maps = curve(&case_without_tags(Building::Random), MATCH);
    let reference = Series {
        name: "paper, #3".to_owned(),
        points: vec![(0.0, METHOD_3.walls), (100.0, METHOD_3.walls)],
        mark: Mark::Dashed,
    };
    chart(&Chart {
        title: case,
        x_label: "share of runs, %".to_owned(),
        y_label: "mse_disp, px²".to_owned(),
        log_y: true,
        series: by_tags.into_iter().chain([by_maps, reference]).collect(),
    })
}
