//! Joining lines that lie on one wall.

use ogm_core::undirected_difference;

use crate::line::Line;
use crate::params::DirectionRule;
use crate::strip::{Cell, difference};

/// How alike two lines must be to be one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JoinLimits {
    /// Radians.
    pub(crate) angle: f64,
    /// Cells.
    pub(crate) distance: f64,
}

/// Joins `lines` until no two are alike (Tsardoulias et al., section 4.1.1, merging), always the
/// first pair in order.
///
/// The direction of a line has no sign: 89.9° and −89.9° are 0.2° apart, where the paper's plain
/// difference is 179.8°.
pub(crate) fn join(lines: Vec<Line>, limits: JoinLimits, direction: DirectionRule) -> Vec<Line> {
    let mut lines = lines;
    let mut changed = 0;
    while let Some((first, second)) = first_alike(&lines, changed, limits) {
        let mut cells = lines.remove(second).cells;
        cells.append(&mut lines[first].cells);
        if let Some(joined) = Line::new(cells, direction) {
            lines[first] = joined;
        }
        changed = first;
    }
    lines
}

/// The first pair that is alike, when no pair that starts before `changed` is, except with it.
fn first_alike(lines: &[Line], changed: usize, limits: JoinLimits) -> Option<(usize, usize)> {
    let with_changed = (0..changed).map(|first| (first, changed));
    let after = (changed..lines.len())
        .flat_map(|first| (first + 1..lines.len()).map(move |second| (first, second)));
    with_changed.chain(after).find(|&(first, second)| alike(&lines[first], &lines[second], limits))
}

fn alike(a: &Line, b: &Line, limits: JoinLimits) -> bool {
    undirected_difference(a.direction, b.direction) < limits.angle
        && (a.limits.iter().any(|&end| distance(end, b.limits) < limits.distance)
            || b.limits.iter().any(|&end| distance(end, a.limits) < limits.distance))
}

/// Distance from `point` to the nearest point of the segment from `a` to `b`.
fn distance(point: Cell, [a, b]: [Cell; 2]) -> f64 {
    let as_f64 = |[x, y]: [i64; 2]| [x as f64, y as f64];
    let [along_x, along_y] = as_f64(difference(b, a));
    let [x, y] = as_f64(difference(point, a));
    let share = (x * along_x + y * along_y) / (along_x * along_x + along_y * along_y);
    let share = share.clamp(0.0, 1.0);
    (x - share * along_x).hypot(y - share * along_y)
}

#[cfg(test)]
mod tests {
    use super::{JoinLimits, alike, distance, join};
    use crate::line::Line;
    use crate::params::DirectionRule;
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};

    const LIMITS: JoinLimits =
        JoinLimits { angle: 3.0 * std::f64::consts::PI / 180.0, distance: 5.0 };

    fn between(a: [i32; 2], b: [i32; 2]) -> Line {
        Line::new(vec![a, b], DirectionRule::Endpoints).unwrap()
    }

    fn joined(lines: Vec<Line>) -> Vec<Line> {
        join(lines, LIMITS, DirectionRule::Endpoints)
    }

    #[test]
    fn t_l3_upright_walls_join_across_the_cut_of_the_angle() {
        let (leaning_right, leaning_left) =
            (between([0, 0], [1, 573]), between([1, 573], [0, 1146]));
        let degrees = [&leaning_right, &leaning_left].map(|line| line.direction.to_degrees());
        assert!((degrees[0] - 89.9).abs() < 1e-3 && (degrees[1] + 89.9).abs() < 1e-3);
        let wall = joined(vec![leaning_right, leaning_left]);
        assert_eq!(wall.len(), 1);
        assert_eq!(wall[0].limits, [[0, 0], [0, 1146]]);

        let (level, inclined) = (between([0, 0], [200, 0]), between([200, 0], [400, 14]));
        assert!((inclined.direction.to_degrees() - 4.0).abs() < 1e-2);
        assert_eq!(joined(vec![level, inclined]).len(), 2);
    }

    #[test]
    fn the_distance_is_to_the_segment_and_not_to_its_line() {
        assert_eq!(distance([13, 4], [[0, 0], [10, 0]]), 5.0);
        assert_eq!(distance([5, 4], [[0, 0], [10, 0]]), 4.0);
    }

    proptest! {
        #[test]
        fn joining_keeps_the_cells_and_leaves_no_pair(
            starts in prop::collection::vec(([0_i32..60, 0_i32..60], [1_i32..30, -1_i32..2]), 1..25),
        ) {
            let lines: Vec<_> = starts.iter()
                .map(|&([x, y], [along, up])| between([x, y], [x + along, y + up])).collect();
            let result = joined(lines.clone());
            let cells = |lines: &[Line]| -> usize { lines.iter().map(|line| line.cells.len()).sum() };
            prop_assert_eq!(cells(&result), cells(&lines));
            for (index, a) in result.iter().enumerate() {
                prop_assert!(result[index + 1..].iter().all(|b| !alike(a, b, LIMITS)));
            }
            prop_assert_eq!(joined(result.clone()), result);
        }

        #[test]
        fn the_order_is_that_of_a_full_restart(
            starts in prop::collection::vec(([0_i32..40, 0_i32..40], [1_i32..20, -1_i32..2]), 1..20),
        ) {
            let mut lines: Vec<_> = starts.iter()
                .map(|&([x, y], [along, up])| between([x, y], [x + along, y + up])).collect();
            let quick = joined(lines.clone());
            while let Some((first, second)) = super::first_alike(&lines, 0, LIMITS) {
                let mut cells = lines.remove(second).cells;
                cells.append(&mut lines[first].cells);
                lines[first] = Line::new(cells, DirectionRule::Endpoints).unwrap();
            }
            prop_assert_eq!(quick, lines);
        }
    }
}
