//! From a start to walls that lie on each other (section 4.3), or the reason why not.

use icp2d::{Termination, WallPoints};
use ogm_core::{Refusal, Se2};
use rfid_loc::{QuadrantConfidence, least_squares_transform, sure_tags};

use crate::TagEvidence;
use crate::checks::{tags_confirm, walls_confirm};
use crate::stop::Stop;
use crate::task::Task;

/// Where walls and tags differ by more, radians (10°), the tags' own rotation is tried too.
const DOUBTFUL: f64 = 10.0 * std::f64::consts::TAU / 360.0;

/// Refines from what tags and walls gave; from the tags alone where the walls have no clear
/// direction or that refinement is not borne out. Of two that are, the one whose walls agree more.
pub(crate) fn from_walls_or_tags(
    task: &Task<'_>,
    by_walls: Result<Se2, Stop>,
    seen: &mut TagEvidence,
) -> Result<Se2, Stop> {
    let mut after_walls = seen.clone();
    let from_walls = match by_walls {
        Err(Stop::Error(error)) => return Err(Stop::Error(error)),
        Err(refused) => Err(refused),
        Ok(start_target_from_source) => refined(task, start_target_from_source, &mut after_walls),
    };
    if from_walls.is_ok() && !is_doubtful(seen) {
        *seen = after_walls;
        return from_walls;
    }
    let mut after_tags = seen.clone();
    let from_tags = from_tags(task, &mut after_tags);
    let share = |seen: &TagEvidence| seen.wall_agreement.and_then(|walls| walls.share());
    let prefers_tags = match (&from_walls, &from_tags) {
        (_, Err(Stop::Error(_))) | (Err(Stop::Refused(_)), Ok(_)) => true,
        (Ok(_), Ok(_)) => share(&after_tags) > share(&after_walls),
        (_, Err(Stop::Refused(_))) | (Err(Stop::Error(_)), _) => false,
    };
    let (answer, evidence) =
        if prefers_tags { (from_tags, after_tags) } else { (from_walls, after_walls) };
    *seen = evidence;
    answer
}

/// Refines from the rigid motion that fits all sure tags best.
pub(crate) fn from_tags(task: &Task<'_>, seen: &mut TagEvidence) -> Result<Se2, Stop> {
    let pairs = sure_tags(&seen.common_tags, &task.params.selection);
    let start_target_from_source =
        least_squares_transform(pairs, &task.params.rotation).into_result()?;
    seen.started_from_tags = true;
    refined(task, start_target_from_source, seen)
}

fn is_doubtful(seen: &TagEvidence) -> bool {
    let is_weak = seen.walls.iter().flatten().any(|walls| walls.vector.weak);
    let differ = seen.quadrant.is_some_and(|quadrant| {
        quadrant.residual.abs() > DOUBTFUL || quadrant.confidence != QuadrantConfidence::Clear
    });
    is_weak || differ
}

/// ICP around a start, borne out by walls and tags.
fn refined(
    task: &Task<'_>,
    start_target_from_source: Se2,
    seen: &mut TagEvidence,
) -> Result<Se2, Stop> {
    let params = task.params;
    let target_points = WallPoints::from_grid(task.target.map, &params.thresholds)?;
    let source_points = WallPoints::from_grid(task.source.map, &params.thresholds)?;
    let start_target_from_source = match &params.start {
        Some(search) => {
            icp2d::search_start(&target_points, &source_points, start_target_from_source, search)?
                .into_result()?
        }
        None => start_target_from_source,
    };
    seen.start_target_from_source = Some(start_target_from_source);
    task.progress.go_on(0.7)?;
    let alignment =
        icp2d::align(&target_points, &source_points, start_target_from_source, &params.icp)?
            .into_result()?;
    let target_from_source = alignment.target_from_source;
    seen.refinement = Some(alignment);
    // A fit that the iterations could not improve on is still the best there is; one that left the
    // surroundings of its start is none.
    if let Termination::MovedTooFar { .. } = alignment.termination {
        let (iterations, rmse_m) = (alignment.iterations, alignment.rmse);
        return Err(Refusal::NotConverged { iterations, rmse_m }.into());
    }
    walls_confirm(task, target_from_source, seen)?;
    tags_confirm(target_from_source, params, seen)?;
    Ok(target_from_source)
}
