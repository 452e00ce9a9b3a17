//! The figures of X4: how a tag is found, how the methods align, how cells are fused.

use anyhow::Context;
use grid_merge::{ForwardRounding, FusionParams, GapTreatment, Mapping, PlacedMap, merge};
use image::RgbImage;
use nalgebra::Point2;
use ogm_core::{OccupancyGrid, Se2, TagReading};
use ogm_merge::{RfidParams, RobotMap, TagMethod, align_by_tags};
use ogm_view::{crop_known, occupancy, overlay, png, side_by_side};
use rfid_loc::{FilterParams, TagFilter};

use super::worked_figures;
use crate::cases::worlds::{Building, World};
use crate::draw::{Heat, heat};
use crate::report::{Figure, Image};

/// Tag error of the alignment pictures, px an axis: at 10 px the three methods differ visibly.
const SIGMA_PX: f64 = 10.0;

/// Pixels between pictures side by side.
const GAP: u32 = 8;

/// Draws the world of plan A with this seed.
pub(super) fn draw(seed: u64) -> anyhow::Result<Vec<Figure>> {
    let world = World::simulate(Building::PlanA, seed)?;
    let (target, source) = (&world.pair.target.map, &world.pair.source.map);
    let mut figures = posteriors(&world)?;
    let [target_tags, source_tags] = world.displaced_tags(SIGMA_PX);
    let robots = [
        RobotMap { map: target, tags: &target_tags },
        RobotMap { map: source, tags: &source_tags },
    ];
    let mut best = None;
    for (name, method) in
        [("#1", TagMethod::Rfid1), ("#2", TagMethod::Rfid2), ("#3", TagMethod::Rfid3)]
    {
        let report = align_by_tags(method, &robots[0], &robots[1], &RfidParams::default(), &())?;
        let Some(target_from_source) = report.outcome.found() else {
            continue;
        };
        figures.push(Figure {
            name: format!("alignment-{}", &name[1..]),
            caption: format!(
                "Method {name} on plan A with tags off by {SIGMA_PX:.0} px: walls of the target \
                 blue, of the source orange, of both black."
            ),
            image: Image::Png(png(&overlay(target, source, target_from_source)?)?),
        });
        best = Some(target_from_source);
    }
    if let Some(target_from_source) = best {
        figures.push(merged(target, source, target_from_source)?);
        figures.push(gaps(target, source, target_from_source)?);
    }
    figures.extend(worked_figures::draw(&world)?);
    Ok(figures)
}

/// The posterior of the tag that the target robot read most, as readings come in.
fn posteriors(world: &World) -> anyhow::Result<Vec<Figure>> {
    let readings = &world.pair.target.readings;
    let most_read = world.target_tags.iter().max_by_key(|tag| tag.readings);
    let tag = most_read.context("plan A has tags that the target robot reads")?;
    let of_tag: Vec<&TagReading> =
        readings.iter().filter(|reading| reading.tag_id == tag.tag_id).collect();
    let params = FilterParams::default();
    let first = of_tag.first().context("a tag that was read has a reading")?;
    let after = |readings: &[&TagReading], window: bool| -> anyhow::Result<RgbImage> {
        let mut filter = TagFilter::around(first.robot_position, &params)?;
        for reading in readings {
            filter.update(reading.robot_position, reading.range)?;
        }
        let window = window.then(|| window_around(&filter, tag.position));
        let style = Heat { gamma: 0.25, upscale: 2, window, ..Heat::default() };
        heat(&filter.posterior(), &style)
    };
    let middle = of_tag[of_tag.len() / 2];
    let rings =
        [after(&[first], false)?, after(&[middle], false)?, after(&[first, middle], false)?];
    let counts = [30, 100, 200, 300].map(|count| &of_tag[..count.min(of_tag.len())]);
    let panels =
        counts.map(|readings| after(readings, true)).into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(vec![
        Figure {
            name: "tag-rings".to_owned(),
            caption: "Where a tag may be, by one reading, by another, and by both.".to_owned(),
            image: Image::Png(png(&side_by_side(&rings, GAP))?),
        },
        Figure {
            name: "tag-posterior".to_owned(),
            caption: "Where a tag may be, after its first 30, 100, 200 and 300 readings; \
                      2.4 × 2.4 m, faint values lifted."
                .to_owned(),
            image: Image::Png(png(&side_by_side(&panels, GAP))?),
        },
    ])
}

/// Columns and rows of the filter's cells within 1.2 m of `place`.
fn window_around(filter: &TagFilter, place: Point2<f64>) -> [(usize, usize); 2] {
    filter.frame().lattice_cell(place).map(|centre| {
        let bound = |at: i64| usize::try_from(at).unwrap_or(0);
        (bound(centre - 60), bound(centre + 60))
    })
}

/// The picture that shows what this is about: two maps, and the two merged.
fn merged(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: Se2,
) -> anyhow::Result<Figure> {
    let merged = fuse(target, source, target_from_source, &FusionParams::default())?;
    let panels = [
        occupancy(&crop_known(target)?),
        occupancy(&crop_known(source)?),
        occupancy(&crop_known(&merged)?),
    ];
    Ok(Figure {
        name: "merge".to_owned(),
        caption: "Two robots' maps of plan A, each in its own frame, and the merged map."
            .to_owned(),
        image: Image::Png(png(&side_by_side(&panels, GAP))?),
    })
}

/// The merged map by forward mapping, before and after its gaps are treated.
fn gaps(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: Se2,
) -> anyhow::Result<Figure> {
    let forward = |gaps| FusionParams {
        mapping: Mapping::Forward { rounding: ForwardRounding::Centre, gaps },
        ..FusionParams::paper()
    };
    let mut panels = Vec::new();
    for gaps in [GapTreatment::None, GapTreatment::HoleFill] {
        let merged = fuse(target, source, target_from_source, &forward(gaps))?;
        panels.push(occupancy(&crop_known(&merged)?));
    }
    Ok(Figure {
        name: "gaps".to_owned(),
        caption: "The merged map by forward mapping, before and after gaps are filled. Inverse \
                  mapping, the default, leaves none."
            .to_owned(),
        image: Image::Png(png(&side_by_side(&panels, GAP))?),
    })
}

fn fuse(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: Se2,
    params: &FusionParams,
) -> anyhow::Result<OccupancyGrid> {
    let maps =
        [PlacedMap::new(target, Se2::identity()), PlacedMap::new(source, target_from_source)];
    Ok(merge(&maps, params, &())?.map)
}
