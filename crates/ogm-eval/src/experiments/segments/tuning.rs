//! X6a and X6b: translation and rotation from approximate poses, beside Saeedi et al.

use ogm_core::{ClassThresholds, OccupancyGrid};
use radon_merge::{
    Disagreement, EntropyHistogram, Objective, RotationCorrelation, TranslationParams,
    joint_entropy, radon, tune_by_peaks, tune_translation, verification_index,
};

use crate::cases::team_world::{CELL, PRINTED, Printed};
use crate::report::{Criterion, Section, Table};

const TRANSLATION_ANALYSIS: &str = "\
Three robots with the paper's lidar in plan B (17 × 10 m), maps of 400 × 400 cells of 0.05 m whose \
true relative poses are those that the paper prints. The window of shifts starts at the printed \
approximate pose; the rotation is the printed one.

As printed, dis counts cells known in at least one map, and the absolute value of J is made \
greatest. The entropy depends on its histogram, which the paper does not define: averaged grey \
takes a conflict for unknown space.";

const ROTATION_ANALYSIS: &str = "\
The rotation starts off by 4 and 8 degrees either way and is tuned by the Radon images of the \
occupied cells: by the highest peak within 12 degrees at steps of one degree, and by the \
correlation of both profiles at 0.25 degrees. The paper corrects 4 degrees in its simple test.";

/// The forms of the similarity index; the first is the one that is judged.
const FORMS: [(&str, Objective, Disagreement); 5] = [
    ("agr − dis", Objective::AgreementLessDisagreement, Disagreement::KnownInBoth),
    ("walls − dis (our default)", Objective::Walls, Disagreement::KnownInBoth),
    ("least entropy", Objective::LeastEntropy, Disagreement::KnownInBoth),
    ("|dis − agr|", Objective::AsPrinted, Disagreement::KnownInBoth),
    ("|dis − agr|, dis as printed", Objective::AsPrinted, Disagreement::AsPrinted),
];

const HISTOGRAMS: [(&str, EntropyHistogram); 4] = [
    ("entropy, joint", EntropyHistogram::Joint),
    ("entropy, known in both (our default)", EntropyHistogram::KnownInBoth),
    ("entropy, conflict label", EntropyHistogram::ConflictLabel),
    ("entropy, averaged grey", EntropyHistogram::AveragedGrey),
];

/// X6a.
pub(super) fn translations(maps: &[OccupancyGrid; 3]) -> anyhow::Result<Section> {
    let mut rows = Vec::new();
    let mut criteria = Vec::new();
    for (printed, source) in PRINTED.iter().zip(&maps[1..]) {
        let start_target_from_source = printed.target_from_source(printed.approximate);
        let tune = |objective, disagreement| {
            let histogram = EntropyHistogram::Joint;
            let params =
                TranslationParams { objective, disagreement, histogram, ..Default::default() };
            let thresholds = ClassThresholds::default();
            tune_translation(&maps[0], source, start_target_from_source, &thresholds, &params)
        };
        for (name, objective, disagreement) in FORMS {
            let window = tune(objective, disagreement)?;
            let counts = window.best_counts();
            let index = verification_index(counts.agreement(), counts.disagreement());
            rows.push(row(printed, name, window.shift, index));
        }
        let window = tune(FORMS[0].1, FORMS[0].2)?;
        for (name, histogram) in HISTOGRAMS {
            let radius = (window.counts.width() / 2) as i64;
            let least = window.counts.indexed().min_by(|(_, a), (_, b)| {
                joint_entropy(a, histogram).total_cmp(&joint_entropy(b, histogram))
            });
            if let Some((at, counts)) = least {
                let shift = [at.column as i64 - radius, at.row as i64 - radius];
                let index = verification_index(counts.agreement(), counts.disagreement());
                rows.push(row(printed, name, shift, index));
            }
        }
        let counts = window.best_counts();
        let index = verification_index(counts.agreement(), counts.disagreement());
        let similarity = cells_off(printed, window.shift);
        let entropy = cells_off(printed, window.entropy_shift);
        let paper = format!("({}, {})", printed.tuned[0], printed.tuned[1]);
        let criterion = |what: &str, statement: &str, paper: String, ours: f64, pass| Criterion {
            id: format!("X6a {what}, {}", printed.name),
            statement: statement.to_owned(),
            paper: Some(paper),
            ours,
            interval: None,
            pass,
        };
        let near = "within one cell of the printed tuning, in cells off";
        criteria.push(criterion("similarity", near, paper.clone(), similarity, similarity <= 1.0));
        criteria.push(criterion("joint entropy", near, paper, entropy, entropy <= 1.0));
        let index = index.unwrap_or(f64::NAN);
        let paper = format!("{} %", printed.index);
        criteria.push(criterion("V", "V ≥ 97 %", paper, index, index >= 97.0));
    }
    Ok(Section {
        id: "X6a".to_owned(),
        title: "Translation from the printed approximate poses (Figs. 8, 10 and 13)".to_owned(),
        analysis: TRANSLATION_ANALYSIS.to_owned(),
        tables: vec![Table {
            caption: "Best pose of the window, cells, by what is made best.".to_owned(),
            header: ["maps", "by", "start", "paper", "ours", "V (%)"].map(str::to_owned).to_vec(),
            rows,
        }],
        figures: Vec::new(),
        criteria,
    })
}

fn tuned(printed: &Printed, shift: [i64; 2]) -> [f64; 2] {
    [0, 1].map(|axis| printed.approximate[axis] + shift[axis] as f64)
}

/// Cells to the printed tuning, the longer axis.
fn cells_off(printed: &Printed, shift: [i64; 2]) -> f64 {
    let ours = tuned(printed, shift);
    (ours[0] - printed.tuned[0]).abs().max((ours[1] - printed.tuned[1]).abs())
}

fn row(printed: &Printed, by: &str, shift: [i64; 2], index: Option<f64>) -> Vec<String> {
    let cells = |[x, y]: [f64; 2]| format!("({x:.0}, {y:.0})");
    vec![
        printed.name.to_owned(),
        by.to_owned(),
        cells(printed.approximate),
        cells(printed.tuned),
        cells(tuned(printed, shift)),
        index.map_or_else(|| "–".to_owned(), |index| format!("{index:.1}")),
    ]
}

/// X6b.
pub(super) fn rotations(maps: &[OccupancyGrid; 3]) -> anyhow::Result<Section> {
    let thresholds = ClassThresholds::default();
    let image = |map: &OccupancyGrid, degrees: f64| {
        let image = radon(&map.occupied_points(&thresholds), CELL, degrees.to_radians())?;
        image.ok_or_else(|| anyhow::anyhow!("a map without walls"))
    };
    let window = 12.0_f64.to_radians();
    let (coarse, fine) = (image(&maps[0], 1.0)?, image(&maps[0], 0.25)?);
    let mut rows = Vec::new();
    let mut worst: f64 = 0.0;
    for (printed, source) in PRINTED.iter().zip(&maps[1..]) {
        let (source_coarse, source_fine) = (image(source, 1.0)?, image(source, 0.25)?);
        let correlation = RotationCorrelation::between(&fine, &source_fine)?;
        for off in [4.0, -4.0, 8.0, -8.0] {
            let start = (printed.degrees + off).to_radians();
            let by_peaks = tune_by_peaks(&coarse, &source_coarse, start, window)?.to_degrees();
            let by_profiles = correlation.correction(start, window).to_degrees();
            worst = worst.max((by_profiles + off).abs());
            rows.push(vec![
                printed.name.to_owned(),
                format!("{:.0}", -off),
                format!("{by_peaks:.2}"),
                format!("{by_profiles:.2}"),
            ]);
        }
    }
    let outcome = Criterion {
        id: "X6b".to_owned(),
        statement: "rotation by the profiles within 0.5°, worst of eight".to_owned(),
        paper: Some("4° corrected".to_owned()),
        ours: worst,
        interval: None,
        pass: worst <= 0.5,
    };
    Ok(Section {
        id: "X6b".to_owned(),
        title: "Rotation by the Radon transform (Fig. 9)".to_owned(),
        analysis: ROTATION_ANALYSIS.to_owned(),
        tables: vec![Table {
            caption: "Correction, degrees.".to_owned(),
            header: ["maps", "needed", "by peaks", "by profiles"].map(str::to_owned).to_vec(),
            rows,
        }],
        figures: Vec::new(),
        criteria: vec![outcome],
    })
}
