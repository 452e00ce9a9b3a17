//! Readers that are not as the filter of tags has them: reflections, a bias, noise.

use nalgebra::Point2;
use ogm_core::{Se2, TagEstimate};
use ogm_merge::{RfidParams, RobotMap, TagMethod, align_by_tags};
use ogm_sim::{RobotRun, TagParams, tag_readings};
use rfid_loc::{FilterParams, localise};

use super::record::{Cell, TWO_TAGS};
use crate::cases::worlds::World;
use crate::judge::Overlap;
use crate::measured::{Run, RunResult};
use crate::report::{Criterion, Table, format};
use crate::stats::Share;

/// Certainty from which on a tag counts as sure (Tsardoulias et al., section 4).
const SURE: f64 = 0.9;
/// A tag is off from here on, metres.
const OFF_M: f64 = 0.05;
/// Of the tags that are off, at most this share may be believed as sure.
const MOST_BELIEVED: f64 = 0.02;
/// Of a few runs, which have some dozen such tags: two.
const MOST_BELIEVED_QUICK: f64 = 0.12;
const METHODS: [(&str, TagMethod); 2] = [("#3", TagMethod::Rfid3), (TWO_TAGS, TagMethod::TwoTags)];

/// A reader.
struct Reader {
    name: &'static str,
    params: TagParams,
}

/// The filter knows none of this.
fn readers() -> [Reader; 4] {
    let as_modelled = TagParams::default();
    [
        Reader {
            name: "one reading in ten an echo",
            params: TagParams { echo_share: 0.1, ..as_modelled },
        },
        Reader {
            name: "half of the readings lost",
            params: TagParams { lost_share: 0.5, ..as_modelled },
        },
        Reader { name: "bias 0.2 m", params: TagParams { range_bias: 0.2, ..as_modelled } },
        Reader {
            name: "ten times the noise",
            params: TagParams { range_sigma: 0.5, ..as_modelled },
        },
    ]
}

fn case(reader: &str) -> String {
    format!("random plan, {reader}")
}

/// What a robot believes of a tag by one reader.
#[derive(Debug, Clone, Copy)]
pub(super) struct Believed {
    reader: &'static str,
    is_sure: bool,
    is_off: bool,
}

/// A world by every reader.
pub(super) fn run(world: &World) -> anyhow::Result<(Vec<Run>, Vec<Believed>)> {
    let pair = &world.pair;
    let overlap = Overlap::new(&pair.target.map, &pair.source.map, world.target_from_source());
    let (mut runs, mut believed) = (Vec::new(), Vec::new());
    for Reader { name, params } in readers() {
        let mut read = |robot: &RobotRun, seed: u64| -> anyhow::Result<Vec<TagEstimate>> {
            let map_from_world = robot.world_from_map.inverse();
            let places: Vec<(u32, Point2<f64>)> =
                pair.tags.iter().map(|&(id, tag)| (id, map_from_world * tag)).collect();
            let readings = tag_readings(&robot.path, &places, &params, seed)?;
            let tags = localise(&readings, &FilterParams::default(), &())?;
            believed.extend(tags.iter().filter_map(|tag| {
                let (_, place) = places.iter().find(|&&(id, _)| tag.tag_id == id.into())?;
                let is_off = (tag.position - place).norm() > OFF_M;
                Some(Believed { reader: name, is_sure: tag.certainty > SURE, is_off })
            }));
            Ok(tags)
        };
        // The two robots hear different noise.
        let tags = [read(&pair.target, 2 * world.seed)?, read(&pair.source, 2 * world.seed + 1)?];
        let target = RobotMap { map: &pair.target.map, tags: &tags[0] };
        let source = RobotMap { map: &pair.source.map, tags: &tags[1] };
        for (variant, method) in METHODS {
            let report = align_by_tags(method, &target, &source, &RfidParams::default(), &())?;
            let errors = Some(|target_from_source: &Se2| overlap.errors(target_from_source));
            runs.push(Run {
                experiment: "X4",
                case: case(name),
                variant: variant.to_owned(),
                seed: world.seed,
                result: RunResult::of(&report.outcome, errors),
            });
        }
    }
    Ok((runs, believed))
}

fn counts(believed: &[Believed], reader: &str) -> [usize; 4] {
    let of: Vec<&Believed> = believed.iter().filter(|tag| tag.reader == reader).collect();
    let count = |holds: fn(&Believed) -> bool| of.iter().filter(|tag| holds(tag)).count();
    let off_and_sure = count(|tag| tag.is_off && tag.is_sure);
    [of.len(), count(|tag| tag.is_sure), count(|tag| tag.is_off), off_and_sure]
}

pub(super) fn table(runs: &[Run], believed: &[Believed]) -> Table {
    let row = |Reader { name, .. }: &Reader| {
        let [tags, sure, off, both] = counts(believed, name);
        let of_methods = METHODS.map(|(variant, _)| {
            let case = case(name);
            let cell = Cell::new(runs, &case, variant);
            let median = cell.summary().map_or(f64::NAN, |summary| summary.median);
            format!("{} ({} − {})", format::px2(median), cell.len(), cell.refused())
        });
        let tags = [tags, sure, off, both].map(|count| count.to_string());
        [vec![(*name).to_owned()], tags.to_vec(), of_methods.to_vec()].concat()
    };
    Table {
        caption: "Readers of which the filter knows nothing: tags, those believed with more than \
                  0.9, those off by more than 5 cm, and those that are both; median mse_disp in px² \
                  (runs − refused)."
            .to_owned(),
        header: ["reader", "tags", "sure", "off", "sure and off", "#3", TWO_TAGS]
            .map(str::to_owned)
            .to_vec(),
        rows: readers().iter().map(row).collect(),
    }
}

/// No reader makes the filter sure of what is wrong.
pub(super) fn criteria(believed: &[Believed], quick: bool) -> Vec<Criterion> {
    let most = if quick { MOST_BELIEVED_QUICK } else { MOST_BELIEVED };
    let of = |Reader { name, .. }: &Reader| {
        let [_, _, off, both] = counts(believed, name);
        let share = Share { hits: both, of: off };
        Criterion {
            id: format!("X4: {name}"),
            statement: format!(
                "{name}: of the tags off by more than 5 cm, at most {} % believed with more than 0.9",
                100.0 * most
            ),
            paper: None,
            ours: if off == 0 { 0.0 } else { share.fraction() },
            interval: Some(share.ci95()),
            pass: off == 0 || share.fraction() <= most,
        }
    };
    readers().iter().map(of).collect()
}
