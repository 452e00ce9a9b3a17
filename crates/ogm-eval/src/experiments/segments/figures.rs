//! The pictures of Saeedi et al. that X6 redraws.

use image::RgbImage;
use ogm_core::{ClassThresholds, Grid, OccupancyGrid, Se2};
use ogm_merge::merge_by_radon;
use radon_merge::{
    EntropyHistogram, Objective, RadonImage, RadonParams, TranslationParams, TranslationWindow,
    WallSegment, find_transform, tune_translation, verification_index,
};

use super::histograms;
use crate::cases::team_world::PRINTED;
use crate::draw::{Chart, Heat, Mark, Series, chart, heat};
use crate::report::{Figure, Image};
use ogm_view::{crop_known, occupancy, overlay, png, side_by_side};

/// Pixels between pictures in a row.
const GAP: u32 = 8;

pub(super) fn draw(maps: &[OccupancyGrid; 3]) -> anyhow::Result<Vec<Figure>> {
    let [first, second, third] = maps;
    let params = RadonParams::default();
    let found = find_transform(first, second, &params, &())?;
    let mut figures = Vec::new();
    let shown = found.accepted.unwrap_or(0);
    if let (Some(stages), Some(candidate)) = (&found.maps, found.candidates.get(shown)) {
        let hypothesis = &candidate.hypothesis;
        let chosen = [hypothesis.target_segment, hypothesis.source_segment];
        for (index, map) in [first, second].into_iter().enumerate() {
            let stages = &stages[index];
            let row = [
                occupancy(map),
                heat(&picture(&stages.edges), &Heat::default())?,
                heat(&picture(&stages.smoothed), &Heat::default())?,
                with_segment(map, &stages.smoothed, stages.segments.get(chosen[index]))?,
            ];
            figures.push(Figure {
                name: format!("x6-fig{}-map{}", index + 3, index + 1),
                caption: format!(
                    "Map {}: cells, Canny edges, smoothed edges, the segment that matches.",
                    index + 1
                ),
                image: Image::Png(png(&side_by_side(&row, GAP))?),
            });
        }
        if let Some(featured) = stages[0].segments.get(chosen[0]) {
            figures.extend(histograms::draw(featured)?);
        }
        let turned_target_from_source = hypothesis.turned_target_from_source;
        let poses = [
            Se2::identity(),
            hypothesis.approximate_target_from_source,
            turned_target_from_source,
            candidate.target_from_source(),
        ];
        let row: Vec<RgbImage> =
            poses.iter().map(|&pose| overlay(first, second, pose)).collect::<Result<_, _>>()?;
        figures.push(Figure {
            name: "x6-fig8-poses".to_owned(),
            caption: "Map 2 on map 1: in one frame, by the segments, with the rotation tuned, \
                      with the translation tuned."
                .to_owned(),
            image: Image::Png(png(&side_by_side(&row, GAP))?),
        });
        let row = [radon_picture(&stages[0].radon)?, radon_picture(&stages[1].radon)?];
        figures.push(Figure {
            name: "x6-fig9-radon".to_owned(),
            caption: "Radon images of maps 1 and 2: angle to the right, ρ upwards.".to_owned(),
            image: Image::Png(png(&side_by_side(&row, GAP))?),
        });
        figures.push(peaks(&stages[0].radon, &stages[1].radon));
    }
    figures.push(surfaces(first, second)?);
    let fusion = grid_merge::FusionParams::default();
    let team = merge_by_radon(first, &[second, third], &params, &fusion, &())?;
    let row = [first, second, third, &team.merged.map]
        .map(|map| crop_known(map).map(|cropped| occupancy(&cropped)));
    let row: Vec<RgbImage> = row.into_iter().collect::<Result<_, _>>()?;
    let aligned = team.matches.iter().filter(|found| found.accepted.is_some()).count();
    figures.push(Figure {
        name: "x6-fig13-team".to_owned(),
        caption: format!("Three maps, and those aligned to the first ({aligned} of 2) fused."),
        image: Image::Png(png(&side_by_side(&row, GAP))?),
    });
    Ok(figures)
}

fn picture(mask: &Grid<bool>) -> Grid<f64> {
    mask.map(|&set| if set { 1.0 } else { 0.0 })
}

fn with_segment(
    map: &OccupancyGrid,
    smoothed: &Grid<bool>,
    segment: Option<&WallSegment>,
) -> anyhow::Result<RgbImage> {
    let mut field = smoothed.map(|&set| if set { 0.4 } else { 0.0 });
    for &point in segment.iter().flat_map(|segment| &segment.points) {
        if let Some(cell) = map.cell_at(point).and_then(|index| field.get_mut(index)) {
            *cell = 1.0;
        }
    }
    heat(&field, &Heat::default())
}

/// Angles as columns.
fn radon_picture(image: &RadonImage) -> anyhow::Result<RgbImage> {
    let bins = &image.bins;
    let columns = (0..bins.width()).flat_map(|rho| bins.rows().map(move |row| f64::from(row[rho])));
    let field = Grid::new(bins.height(), bins.width(), columns.collect())?;
    heat(&field, &Heat { gamma: 0.5, ..Heat::default() })
}

fn peaks(first: &RadonImage, second: &RadonImage) -> Figure {
    let series = [("map 1", first), ("map 2", second)].map(|(name, image)| {
        let degrees = |index: usize| (index as f64 * image.angle_step).to_degrees();
        let peaks = image.peaks().into_iter().enumerate();
        Series {
            name: name.to_owned(),
            points: peaks.map(|(index, peak)| (degrees(index), peak)).collect(),
            mark: Mark::Line,
        }
    });
    let svg = chart(&Chart {
        title: "Peaks of the Radon images".to_owned(),
        x_label: "angle (°)".to_owned(),
        y_label: "greatest bin (cells)".to_owned(),
        log_y: false,
        series: series.to_vec(),
    });
    Figure {
        name: "x6-fig9-peaks".to_owned(),
        caption: "The highest bin at every Radon angle; walls are a right angle apart.".to_owned(),
        image: Image::Svg(svg),
    }
}

/// Similarity, verification index and joint entropy around the printed approximate pose of map 2.
fn surfaces(first: &OccupancyGrid, second: &OccupancyGrid) -> anyhow::Result<Figure> {
    let start_target_from_source = PRINTED[0].target_from_source(PRINTED[0].approximate);
    let params = TranslationParams {
        objective: Objective::AgreementLessDisagreement,
        histogram: EntropyHistogram::Joint,
        ..Default::default()
    };
    let thresholds = ClassThresholds::default();
    let window: TranslationWindow =
        tune_translation(first, second, start_target_from_source, &thresholds, &params)?;
    let index = window.counts.map(|counts| {
        verification_index(counts.agreement(), counts.disagreement()).unwrap_or(f64::NAN)
    });
    let style = Heat { upscale: 12, ..Heat::default() };
    let row = [&window.similarity, &index, &window.entropy]
        .map(|field| heat(field, &style))
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    Ok(Figure {
        name: "x6-fig10-surfaces".to_owned(),
        caption: "Map 2 to map 1 over the window: similarity, verification index, joint entropy; \
                  light is high."
            .to_owned(),
        image: Image::Png(png(&side_by_side(&row, GAP))?),
    })
}
