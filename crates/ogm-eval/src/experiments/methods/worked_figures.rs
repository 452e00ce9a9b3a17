//! The paper's drawings of single steps: four quarter turns, the common section, the field of
//! points, the blur.

use anyhow::Context;
use grid_merge::{ForwardRounding, FusionParams, GapTreatment, Mapping, PlacedMap, merge};
use icp2d::{IcpParams, WallPoints, align};
use image::RgbImage;
use nalgebra::{Point2, Vector2};
use ogm_core::{ClassThresholds, OccupancyGrid, Se2};
use ogm_view::{crop_known, occupancy, overlay, png, side_by_side};
use std::f64::consts::FRAC_PI_2;

use crate::cases::worlds::World;
use crate::draw::{Layer, Plan, plan};
use crate::report::{Figure, Image};

/// Pixels between pictures side by side.
const GAP: u32 = 8;

pub(super) fn draw(world: &World) -> anyhow::Result<Vec<Figure>> {
    let (target, source) = (&world.pair.target.map, &world.pair.source.map);
    let truth = world.pair.target_from_source;
    let centre = world.source_tags.first().context("plan A has tags")?.position;
    Ok(vec![
        quarters(target, source, truth, centre)?,
        section(target, source, truth)?,
        field()?,
        blur(target)?,
    ])
}

/// Figure 13: what a direction modulo a quarter turn leaves open.
fn quarters(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: Se2,
    centre: Point2<f64>,
) -> anyhow::Result<Figure> {
    let panels: Vec<RgbImage> = (0..4)
        .map(|quarter| {
            let about_centre = target_from_source * centre;
            let turn = Se2::about(about_centre, FRAC_PI_2 * f64::from(quarter), Vector2::zeros());
            overlay(target, source, turn * target_from_source)
        })
        .collect::<Result<_, _>>()?;
    Ok(Figure {
        name: "quarters".to_owned(),
        caption:
            "Figure 13: the walls allow four alignments, a quarter turn apart; the tags choose."
                .to_owned(),
        image: Image::Png(png(&side_by_side(&panels, GAP))?),
    })
}

/// Figure 18.
fn section(
    target: &OccupancyGrid,
    source: &OccupancyGrid,
    target_from_source: Se2,
) -> anyhow::Result<Figure> {
    let thresholds = ClassThresholds::default();
    let walls = [target, source].map(|map| WallPoints::from_grid(map, &thresholds));
    let [target_walls, source_walls] = walls;
    let (target_walls, source_walls) = (target_walls?, source_walls?);
    let found = align(&target_walls, &source_walls, target_from_source, &IcpParams::default())?;
    let section = found.found().context("the maps of plan A align")?.section;
    let corners = [
        section.min,
        Point2::new(section.max.x, section.min.y),
        section.max,
        Point2::new(section.min.x, section.max.y),
    ];
    let sides = (0..4).map(|side| [corners[side], corners[(side + 1) % 4]]).collect();
    let points = source_walls.points().iter().step_by(7);
    let drawing = plan(&Plan {
        title: "What both robots may have seen (Fig. 18)".to_owned(),
        background: Some(target),
        layers: vec![
            Layer { name: "common section".to_owned(), lines: sides, ..Layer::default() },
            Layer {
                name: "walls of the source".to_owned(),
                points: points.map(|wall| target_from_source * wall.position).collect(),
                ..Layer::default()
            },
        ],
    })?;
    Ok(Figure {
        name: "common-section".to_owned(),
        caption: "The part of the target's frame in which ICP compares walls.".to_owned(),
        image: Image::Svg(drawing),
    })
}

/// Figures 20 to 22: 25 points, turned by 30° about (200, 200), which lands on (300, 300), and rounded.
fn field() -> anyhow::Result<Figure> {
    let turn = Se2::about(Point2::new(200.0, 200.0), 30.0_f64.to_radians(), Vector2::repeat(100.0));
    let before: Vec<Point2<f64>> = (0..25)
        .map(|index| Point2::new(f64::from(98 + index % 5), f64::from(98 + index / 5)))
        .collect();
    let after: Vec<Point2<f64>> = before.iter().map(|&point| turn * point).collect();
    let rounded = after.iter().map(|point| Point2::from(point.coords.map(f64::floor))).collect();
    let layer = |name: &str, points| Layer { name: name.to_owned(), points, ..Layer::default() };
    let drawing = plan(&Plan {
        title: "A field of points, turned and rounded (Figs. 20–22)".to_owned(),
        background: None,
        layers: vec![layer("before", before), layer("turned", after), layer("rounded", rounded)],
    })?;
    Ok(Figure {
        name: "points-field".to_owned(),
        caption: "25 cells before, after the turn of Eq. 14, and on the cells of Eq. 15, some of \
                  which take two points and some none."
            .to_owned(),
        image: Image::Svg(drawing),
    })
}

/// Figures 23 and 24: the blur of Eq. 16, once and often.
fn blur(map: &OccupancyGrid) -> anyhow::Result<Figure> {
    let params = FusionParams {
        mapping: Mapping::Forward {
            rounding: ForwardRounding::Centre,
            gaps: GapTreatment::BlurEverywhere,
        },
        ..FusionParams::paper()
    };
    let mut panels = vec![occupancy(&crop_known(map)?)];
    let mut blurred = map.clone();
    for times in 1..=20 {
        blurred = merge(&[PlacedMap::new(&blurred, Se2::identity())], &params, &())?.map;
        if times == 1 || times == 20 {
            panels.push(occupancy(&crop_known(&blurred)?));
        }
    }
    Ok(Figure {
        name: "blur".to_owned(),
        caption:
            "Figures 23 and 24: a map, blurred once, and blurred twenty times, when its walls \
                  have diffused."
                .to_owned(),
        image: Image::Png(png(&side_by_side(&panels, GAP))?),
    })
}
