//! The pictures of X8: the ways of the robots, and the map that they made.

use anyhow::Context;
use ogm_sim::FloorPlan;
use ogm_view::{crop_known, occupancy, png};

use super::record::{Filter, Team};
use crate::draw::{Layer, Plan, plan};
use crate::report::{Figure, Image};

/// Three robots with their true ways, and one of them as every filter has it.
pub(super) fn paths(teams: &[Team]) -> anyhow::Result<Figure> {
    let team = teams.first().context("no teams")?;
    let floor = FloorPlan::plan_b();
    let walls = floor.faces().map(|face| [face.start, face.end]).collect();
    let pieces = |path: &[nalgebra::Point2<f64>]| {
        path.windows(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>()
    };
    let layer = |name: &str, lines| Layer { name: name.to_owned(), lines, ..Layer::default() };
    let mut layers = vec![layer("walls", walls)];
    let robot = team.robots.first().context("no robots")?;
    layers.push(layer("robot 1", pieces(&robot.paths[0])));
    for filter in [Filter::DeadReckoning, Filter::EkfWithScans] {
        layers.push(layer(filter.name(), pieces(&robot.paths[1 + filter as usize])));
    }
    for (index, robot) in team.robots.iter().enumerate().skip(1) {
        layers.push(layer(&format!("robot {}", index + 1), pieces(&robot.paths[0])));
    }
    let title = format!("The floor and the robots of seed {} (Fig. 12)", team.seed);
    let drawing = plan(&Plan { title, background: None, layers })?;
    Ok(Figure {
        name: "x8-paths".to_owned(),
        caption: "The true ways of three robots, and that of the first by two filters.".to_owned(),
        image: Image::Svg(drawing),
    })
}

/// The last fused map.
pub(super) fn fused(teams: &[Team]) -> anyhow::Result<Figure> {
    let share = teams.first().and_then(|team| team.shares.last()).context("no teams")?;
    Ok(Figure {
        name: "x8-fused".to_owned(),
        caption: "The map of all robots that could be placed, in the frame of the first."
            .to_owned(),
        image: Image::Png(png(&occupancy(&crop_known(&share.fused)?))?),
    })
}
