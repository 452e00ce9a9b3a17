//! The figures of X5: the trend of ψ, the maps before and after, and Theorem 1.

use anyhow::Context;
use carpin_walk::{
    Budget, Drift, Params, Placement, RandomWalk, SearchBox, Walk, align, random_walk,
};
use ogm_core::{ClassThresholds, l1_distance};
use ogm_sim::FloorPlan;
use ogm_view::{enlarge, occupancy, overlay, png, side_by_side};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::cases::rescue::{CASES, Coverage, RescuePair};
use crate::draw::{Chart, Heat, Mark, Series, chart, heat};
use crate::options::Options;
use crate::report::{Figure, Image};

/// Walks behind a curve of Theorem 1, and their samples.
const WALKS: u64 = 40;
const SAMPLES: usize = 1000;

/// What counts as near the optimum: this share of ψ there, more than ψ there.
const EPSILON: f64 = 0.25;

/// Draws one walk on plan A for each coverage, and the convergence of many.
pub(super) fn draw(options: &Options) -> anyhow::Result<Vec<Figure>> {
    let mut figures = Vec::new();
    for (case, name) in [(&CASES[1], "full"), (&CASES[3], "partial")] {
        let pair = RescuePair::of(&FloorPlan::plan_a(), case.coverage, options.seed)?;
        let start = pair.start(case.start)?;
        let params = Params { seed: options.seed, ..Params::default() };
        let outcome =
            align(&pair.target, &pair.source, start, &RandomWalk::default(), &params, &())?;
        let Some(found) = outcome.found() else { continue };
        let truth = pair.distance()?.psi(&pair.target_from_source)?.psi;
        figures.push(trend(&found, truth, name, case.name));
        let panels = [start, found.target_from_source].map(|motion| {
            overlay(&pair.target, &pair.source, motion).map(|image| enlarge(&image, 3))
        });
        let [before, after] = panels;
        figures.push(Figure {
            name: format!("walk-maps-{name}"),
            caption: format!(
                "Plan A, {}: at the start and after 200 samples; target blue, source orange, both \
                 black.",
                case.name
            ),
            image: Image::Png(png(&side_by_side(&[before?, after?], 8))?),
        });
    }
    figures.push(distance_map(options.seed)?);
    figures.push(theorem(options)?);
    Ok(figures)
}

/// The counterparts of the paper's figures 6a, 6b and 4.
fn distance_map(seed: u64) -> anyhow::Result<Figure> {
    let pair = RescuePair::of(&FloorPlan::plan_a(), CASES[1].coverage, seed)?;
    let thresholds = ClassThresholds::default();
    let walls = pair.target.cells().map(|&cell| thresholds.is_occupied(cell));
    let distance = l1_distance(&walls).context("the map of plan A has walls")?;
    let style = Heat { upscale: 3, ..Heat::default() };
    let distance = heat(&distance.map(|&cells| f64::from(cells)), &style)?;
    let [target, source] = [&pair.target, &pair.source].map(|map| enlarge(&occupancy(map), 3));
    Ok(Figure {
        name: "walk-distance-map".to_owned(),
        caption:
            "Two robots' maps of plan A, and the distance map of the first one's walls; light \
                  is far."
                .to_owned(),
        image: Image::Png(png(&side_by_side(&[target, source, distance], 8))?),
    })
}

/// The counterpart of the paper's figure 6d.
fn trend(found: &carpin_walk::Alignment, truth: f64, name: &str, case: &str) -> Figure {
    let trace = || (1_u32..).zip(&found.trace).map(|(k, sample)| (f64::from(k), sample));
    let end = found.trace.len() as f64;
    let series = |name: &str, points, mark| Series { name: name.to_owned(), points, mark };
    let sampled = trace().map(|(k, sample)| (k, sample.psi.unwrap_or(f64::NAN))).collect();
    let current = trace().map(|(k, sample)| (k, sample.current_psi)).collect();
    let best = trace().map(|(k, sample)| (k, sample.best_psi)).collect();
    Figure {
        name: format!("walk-trend-{name}"),
        caption: format!(
            "ψ along one walk on plan A, {case}: every sample, where the walk stands, and the best \
             so far. The paper's figure 6d shows the first."
        ),
        image: Image::Svg(chart(&Chart {
            title: "Trend of the picture distance".to_owned(),
            x_label: "sample".to_owned(),
            y_label: "ψ, cells".to_owned(),
            log_y: false,
            series: vec![
                series("sample", sampled, Mark::Line),
                series("current", current, Mark::Line),
                series("best", best, Mark::Line),
                series("ψ(truth)", vec![(1.0, truth), (end, truth)], Mark::Dashed),
            ],
        })),
    }
}

/// The share of walks that have been within ε of the optimum, against the samples drawn.
fn theorem(options: &Options) -> anyhow::Result<Figure> {
    let (walks, samples) = if options.quick { (8, 200) } else { (WALKS, SAMPLES) };
    let pair = RescuePair::of(&FloorPlan::plan_a(), Coverage::Full, options.seed)?;
    let distance = pair.distance()?;
    let everywhere = SearchBox { centre: [0.0; 3], reach: [50.0, 50.0, 180.0] };
    let rules = RandomWalk::default();
    let budget = |stream| Budget { samples, seed: options.seed, stream };
    // Far enough off that descent alone does not do: a third of the building, and a quarter turn.
    let truth = distance.placement(&pair.target_from_source);
    let start = everywhere.admit([truth[0] + 25.0, truth[1] - 15.0, truth[2] + 60.0]);
    let start: Placement = start.unwrap_or_default();
    let on_maps: Vec<Walk> = (0..walks)
        .into_par_iter()
        .map(|stream| {
            let mut distance = distance.clone();
            let psi = |at: &Placement| distance.psi_at(at).psi;
            random_walk(psi, start, &everywhere, &rules, &budget(stream), &())
        })
        .collect::<Result<_, _>>()?;
    let toy_box = SearchBox { centre: [0.0; 3], reach: [5.0; 3] };
    let blind = RandomWalk { drift: Drift::None, ..rules };
    let on_toy: Vec<Walk> = (0..walks)
        .into_par_iter()
        .map(|stream| {
            let psi = |at: &Placement| at.iter().map(|part| part.abs()).sum();
            random_walk(psi, [4.0, -4.0, 4.0], &toy_box, &blind, &budget(stream), &())
        })
        .collect::<Result<_, _>>()?;
    let least = on_maps.iter().map(|walk| walk.best_psi).fold(f64::INFINITY, f64::min);
    let limit = (1.0 + EPSILON) * least;
    let series = |name: String, walks: &[Walk], limit| Series {
        name,
        points: (0..samples)
            .map(|k| (((k + 1) as f64).log10(), arrived(walks, k, limit)))
            .collect(),
        mark: Mark::Line,
    };
    Ok(Figure {
        name: "walk-theorem-1".to_owned(),
        caption: format!(
            "Theorem 1, corrected: the share of {walks} walks whose best sample so far is within ε \
             of the optimum tends to 1. Maps: plan A, from 25 and 15 cells and 60° off, ε = {:.0} % \
             of the least ψ that any walk found ({least:.2} cells). Toy: |x| + |y| + |θ| on \
             [−5, 5]³ without a gradient, ε = 1.",
            100.0 * EPSILON
        ),
        image: Image::Svg(chart(&Chart {
            title: "Convergence in probability".to_owned(),
            x_label: "log₁₀ of the samples".to_owned(),
            y_label: "share of walks".to_owned(),
            log_y: false,
            series: vec![
                series("maps".to_owned(), &on_maps, limit),
                series("toy".to_owned(), &on_toy, 1.0),
            ],
        })),
    })
}

/// The share of walks whose best of the first `k + 1` samples is at most `limit`.
fn arrived(walks: &[Walk], k: usize, limit: f64) -> f64 {
    let best = |walk: &Walk| walk.trace.get(k).map_or(walk.best_psi, |sample| sample.best_psi);
    walks.iter().filter(|walk| best(walk) <= limit).count() as f64 / walks.len() as f64
}
