//! X4: methods #1, #2 and #3 on simulated worlds, beside the paper's Table 4.

use std::time::Instant;

use grid_match::{MatchParams, match_maps};
use icp2d::{IcpParams, Pairing};
use nalgebra::Point2;
use ogm_core::{Length, OccupancyGrid, Outcome, Se2};
use ogm_merge::{Anchor, Method, RfidParams, RobotMap, align};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rfid_loc::{RotationCentre, TagFrame, TagOnlyParams, TagOnlyRotation, TagOnlyTranslation};

use super::evaluation::{Overlap, PIXEL};
use super::record::{Run, RunResult};
use super::worlds::{Building, World};
use super::{Args, Measured, Timing, method_charts, method_figures, method_tables, progress};

/// Standard deviation of the error added to each tag as localised, an axis, px of 0.02 m.
pub(crate) const REGIMES: [f64; 4] = [0.0, 2.0, 5.0, 10.0];

/// The method that looks at the maps alone. It runs once a world, whatever the tags.
pub(crate) const MATCH: &str = "match";

/// How many of the variants, from the front, are the defaults of #1, #2 and #3.
const DEFAULT_VARIANTS: usize = 3;

/// Worlds of plan A, shown apart.
const PLAN_A_WORLDS: u64 = 10;

/// A row of the table: a method in one of its forms.
pub(crate) struct Variant {
    pub(crate) name: &'static str,
    pub(crate) method: Method,
    params: fn(&World) -> RfidParams,
}

/// The defaults first.
pub(crate) const VARIANTS: [Variant; 16] = [
    Variant { name: "#1", method: Method::Rfid1, params: |_| RfidParams::default() },
    Variant { name: "#2", method: Method::Rfid2, params: |_| RfidParams::default() },
    Variant { name: "#3", method: Method::Rfid3, params: |_| RfidParams::default() },
    Variant {
        name: "#1 with tags 1 and 2",
        method: Method::Rfid1,
        params: |_| tag_only(TagOnlyParams { rotation: TagOnlyRotation::P2, ..Default::default() }),
    },
    Variant {
        name: "#1b least squares",
        method: Method::Rfid1b,
        params: |_| RfidParams::default(),
    },
    Variant {
        name: "#1 rotation as printed",
        method: Method::Rfid1,
        params: |_| {
            tag_only(TagOnlyParams { rotation: TagOnlyRotation::AsPrinted, ..Default::default() })
        },
    },
    Variant {
        name: "#1 translation as printed",
        method: Method::Rfid1,
        params: |_| {
            tag_only(TagOnlyParams {
                translation: TagOnlyTranslation::AsPrinted,
                ..Default::default()
            })
        },
    },
    Variant {
        name: "#1 translation by unrotated centroids, sign repaired",
        method: Method::Rfid1,
        params: |_| {
            tag_only(TagOnlyParams {
                translation: TagOnlyTranslation::SignFixed,
                ..Default::default()
            })
        },
    },
    Variant {
        name: "#1 all as printed",
        method: Method::Rfid1,
        params: |_| {
            tag_only(TagOnlyParams {
                rotation: TagOnlyRotation::AsPrinted,
                translation: TagOnlyTranslation::AsPrinted,
                ..Default::default()
            })
        },
    },
    Variant {
        name: "#1 cropped image, turned about its centre, sign repaired",
        method: Method::Rfid1,
        params: |world| {
            tag_only(TagOnlyParams {
                translation: TagOnlyTranslation::SignFixed,
                frame: TagFrame::Cropped {
                    target_corner: corner(&world.pair.target.map),
                    source_corner: corner(&world.pair.source.map),
                },
                centre: RotationCentre::At(image_centre(&world.pair.source.map)),
                ..Default::default()
            })
        },
    },
    Variant {
        name: "#2 printed weights",
        method: Method::Rfid2,
        params: |_| RfidParams {
            vector: ogm_vector::Params {
                weights: ogm_vector::Weights::AsPrinted,
                ..Default::default()
            },
            ..Default::default()
        },
    },
    Variant {
        name: "#2 all three tags carry the translation",
        method: Method::Rfid2,
        params: |_| RfidParams { anchor: Anchor::AllTags, ..Default::default() },
    },
    Variant {
        name: "#3 from where #2 ends",
        method: Method::Rfid3,
        params: |_| icp(IcpParams::default()),
    },
    Variant {
        name: "#3 reciprocal only",
        method: Method::Rfid3,
        params: |_| icp(IcpParams { pairing: Pairing::Reciprocal, ..Default::default() }),
    },
    Variant {
        name: "#3 one-way, gate to 5 px",
        method: Method::Rfid3,
        params: |_| icp(IcpParams { pairing: Pairing::OneWay, ..Default::default() }),
    },
    Variant {
        name: "#3 rectangle only, no gate",
        method: Method::Rfid3,
        params: |_| {
            icp(IcpParams {
                pairing: Pairing::OneWay,
                initial_gate: Length::metres(f64::INFINITY),
                final_gate: Length::metres(f64::INFINITY),
                ..Default::default()
            })
        },
    },
];

fn tag_only(tag_only: TagOnlyParams) -> RfidParams {
    RfidParams { tag_only, ..Default::default() }
}

/// Refinement from where #2 ends, as the paper has it.
fn icp(icp: IcpParams) -> RfidParams {
    RfidParams { icp, start: None, ..Default::default() }
}

fn corner(map: &OccupancyGrid) -> Point2<f64> {
    map.frame().point_from_cells(Point2::origin())
}

fn image_centre(map: &OccupancyGrid) -> Point2<f64> {
    let half = Point2::new(map.width() as f64 / 2.0, map.height() as f64 / 2.0);
    map.frame().point_from_cells(half)
}

/// Runs every variant on its share of the worlds.
pub(crate) fn run(args: &Args) -> anyhow::Result<Measured> {
    let bar = progress("X4 worlds", args.worlds() + PLAN_A_WORLDS.min(args.worlds()));
    let random: Vec<(Vec<Run>, Vec<Timing>)> = (0..args.worlds())
        .into_par_iter()
        .map(|index| {
            let all = index < args.variant_worlds();
            let measured = run_world(Building::Random, args.seed + index, all);
            bar.inc(1);
            measured
        })
        .collect::<anyhow::Result<_>>()?;
    let plan_a: Vec<(Vec<Run>, Vec<Timing>)> = (0..PLAN_A_WORLDS.min(args.worlds()))
        .into_par_iter()
        .map(|index| {
            let measured = run_world(Building::PlanA, args.seed + index, true);
            bar.inc(1);
            measured
        })
        .collect::<anyhow::Result<_>>()?;
    bar.finish_and_clear();

    let (runs, timings): (Vec<_>, Vec<_>) = random.into_iter().chain(plan_a).unzip();
    let runs = runs.concat();
    let timings = timings.concat();
    let mut section = method_tables::section(args, &runs, &timings);
    section.figures = method_charts::draw(&runs);
    section.figures.extend(method_figures::draw(args.seed)?);
    Ok(Measured { sections: vec![section], runs, timings })
}

fn run_world(
    building: Building,
    seed: u64,
    all_variants: bool,
) -> anyhow::Result<(Vec<Run>, Vec<Timing>)> {
    let world = World::simulate(building, seed)?;
    let overlap =
        Overlap::new(&world.pair.target.map, &world.pair.source.map, world.target_from_source());
    let variants = if all_variants { &VARIANTS[..] } else { &VARIANTS[..DEFAULT_VARIANTS] };
    let (mut runs, mut timings) = (Vec::new(), Vec::new());
    for sigma_px in REGIMES {
        let [target_tags, source_tags] = world.displaced_tags(sigma_px);
        let target = RobotMap { map: &world.pair.target.map, tags: &target_tags };
        let source = RobotMap { map: &world.pair.source.map, tags: &source_tags };
        for variant in variants {
            let params = (variant.params)(&world);
            let start = Instant::now();
            let report = align(variant.method, &target, &source, &params)?;
            let milliseconds = start.elapsed().as_secs_f64() * 1e3;
            let result = judge(&overlap, report.outcome);
            runs.push(Run {
                experiment: "X4",
                case: case_name(building, sigma_px),
                variant: variant.name.to_owned(),
                seed,
                result,
            });
            timings.push(Timing { experiment: "X4", step: variant.name, seed, milliseconds });
        }
    }
    let start = Instant::now();
    let (target, source) = (&world.pair.target.map, &world.pair.source.map);
    let report = match_maps(target, source, &MatchParams::default())?;
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    runs.push(Run {
        experiment: "X4",
        case: case_without_tags(building),
        variant: MATCH.to_owned(),
        seed,
        result: judge(&overlap, report.outcome),
    });
    timings.push(Timing { experiment: "X4", step: MATCH, seed, milliseconds });
    Ok((runs, timings))
}

fn judge(overlap: &Overlap<'_>, outcome: Outcome<Se2>) -> RunResult {
    match outcome {
        Outcome::Found(target_from_source) => {
            RunResult::Transform(overlap.errors(&target_from_source))
        }
        Outcome::Refused(refusal) => RunResult::Refused(refusal),
    }
}

/// The name of a regime on one kind of building.
pub(crate) fn case_name(building: Building, sigma_px: f64) -> String {
    let building = building.name();
    if sigma_px == 0.0 {
        format!("{building}, tags as localised")
    } else {
        format!("{building}, tags + {sigma_px:.0} px ({:.0} cm)", sigma_px * PIXEL * 100.0)
    }
}

/// The name of one kind of building where tags do not matter.
pub(crate) fn case_without_tags(building: Building) -> String {
    format!("{}, without tags", building.name())
}
