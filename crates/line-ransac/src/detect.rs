//! The RANSAC loop: line after line out of the pool of cells.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::farthest::farthest_pair;
use crate::line::Line;
use crate::params::Params;
use crate::pool::Pool;
use crate::strip::{Cell, Strip};

/// Lines in the order in which they were found, and what that took.
#[derive(Debug)]
pub(crate) struct Detection {
    pub(crate) lines: Vec<Line>,
    pub(crate) trials: usize,
    pub(crate) fallback_lines: usize,
}

/// Finds lines until few cells are left or no line has enough votes (Tsardoulias et al., section
/// 4.1.1, steps 2 to 5, and the new limits).
///
/// The printed text recomputes the set of all points for the new limits; it is the points of the
/// line that are meant.
pub(crate) fn detect(
    cells: Vec<Cell>,
    line_distance: f64,
    params: &Params,
    rng: &mut ChaCha8Rng,
) -> Detection {
    let initial = cells.len() as f64;
    let mut pool = Pool::new(cells);
    let mut detection = Detection { lines: Vec::new(), trials: 0, fallback_lines: 0 };
    while detection.lines.len() < params.max_lines
        && pool.cells().len() as f64 >= params.stop_share * initial
    {
        let winner = search(&mut pool, line_distance, params, initial, rng);
        detection.trials += winner.trials;
        let Some(strip) = winner.strip else { break };
        let Some([b, c]) = farthest_pair(&pool.inside(&strip)) else {
            break;
        };
        let taken = pool.take(&Strip::new(b, c, line_distance));
        let Some(line) = Line::new(taken, params.direction) else {
            break;
        };
        detection.lines.push(line);
        detection.fallback_lines += usize::from(winner.by_fallback);
    }
    detection
}

/// What the trials for one line gave.
struct Winner {
    strip: Option<Strip>,
    trials: usize,
    by_fallback: bool,
}

/// Tries random pairs until one has the share of votes that is accepted at once, or else takes the
/// best if it has enough to be a wall.
fn search(
    pool: &mut Pool,
    line_distance: f64,
    params: &Params,
    initial: f64,
    rng: &mut ChaCha8Rng,
) -> Winner {
    let mut best = None;
    let mut best_votes = 0;
    let last = pool.cells().len().saturating_sub(1);
    for trial in 1..=params.trials_per_line {
        let (first, second) = (rng.random_range(0..=last), rng.random_range(0..=last));
        if first == second {
            continue;
        }
        let strip = Strip::new(pool.cells()[first], pool.cells()[second], line_distance);
        let votes = pool.votes(&strip, best_votes);
        if votes > best_votes {
            best_votes = votes;
            best = Some(strip);
            if votes as f64 > params.accept_share * initial {
                return Winner { strip: best, trials: trial, by_fallback: false };
            }
        }
    }
    let enough =
        best_votes >= params.fallback_votes && best_votes as f64 >= params.fallback_share * initial;
    Winner { strip: best.filter(|_| enough), trials: params.trials_per_line, by_fallback: enough }
}

#[cfg(test)]
mod tests {
    use super::{Detection, detect};
    use crate::Params;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn detect_all(cells: Vec<[i32; 2]>, params: &Params) -> Detection {
        detect(cells, 2.0, params, &mut ChaCha8Rng::seed_from_u64(7))
    }

    #[test]
    fn t_l6_cells_without_a_line_end_by_the_fallback_and_within_the_bound() {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let cells: Vec<_> =
            (0..2000).map(|_| [rng.random_range(0..700), rng.random_range(0..600)]).collect();
        for max_lines in [60, 5] {
            let params = Params { max_lines, ..Params::paper() };
            let detection = detect_all(cells.clone(), &params);
            let most_votes = detection.lines.iter().map(|line| line.cells.len()).max();
            assert!(most_votes < Some(100), "a line of more than 5 %");
            assert!((1..=max_lines).contains(&detection.lines.len()));
            assert_eq!(detection.fallback_lines, detection.lines.len());
        }
    }

    #[test]
    fn a_dominant_line_is_accepted_without_trying_on() {
        let cells = (0..100).map(|column| [column, 50]).collect();
        let detection = detect_all(cells, &Params::paper());
        assert_eq!((detection.lines.len(), detection.fallback_lines), (1, 0));
        assert!(detection.trials < 5, "{} trials", detection.trials);
    }

    #[test]
    fn a_line_has_the_cells_near_its_own_limits_and_leaves_the_others() {
        let mut cells: Vec<_> = (0..200).map(|column| [column, 0]).collect();
        cells.extend((0..200).map(|column| [column, 40]));
        let detection = detect_all(cells, &Params { stop_share: 0.1, ..Params::paper() });
        let mut rows: Vec<_> = detection.lines.iter().map(|line| line.limits).collect();
        rows.sort_unstable();
        assert_eq!(rows, [[[0, 0], [199, 0]], [[0, 40], [199, 40]]]);
    }
}
