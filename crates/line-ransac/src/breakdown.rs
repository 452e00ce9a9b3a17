//! Breaking lines that jump from one obstacle to another.

use crate::farthest::squared_distance;
use crate::line::Line;
use crate::params::{BreakRule, DirectionRule};

/// The pieces of `line` between its gaps (Tsardoulias et al., section 4.1.1, breakdown); a piece of
/// one cell vanishes.
pub(crate) fn break_at_gaps(
    line: &Line,
    max_gap: f64,
    rule: BreakRule,
    direction: DirectionRule,
) -> Vec<Line> {
    let from = line.limits[0];
    let mut cells: Vec<_> =
        line.cells.iter().map(|&cell| (squared_distance(from, cell), cell)).collect();
    cells.sort_unstable();
    cells
        .chunk_by(|&(near, _), &(far, _)| {
            !is_break((near as f64).sqrt(), (far as f64).sqrt(), max_gap, rule)
        })
        .filter_map(|piece| Line::new(piece.iter().map(|&(_, cell)| cell).collect(), direction))
        .collect()
}

/// Whether a line is cut between neighbours at distances `near` and `far` from its first limit.
fn is_break(near: f64, far: f64, max_gap: f64, rule: BreakRule) -> bool {
    match rule {
        BreakRule::Wider => far - near > max_gap,
        BreakRule::AsPrinted => far - near < max_gap,
    }
}

#[cfg(test)]
mod tests {
    use super::{break_at_gaps, is_break};
    use crate::line::Line;
    use crate::params::{BreakRule, DirectionRule};
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};

    #[test]
    fn t_l2_breakdown_cuts_at_wide_gaps_and_its_misprint_at_narrow_ones() {
        let distances = [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 50.0, 52.0, 54.0];
        let pieces = |rule| -> Vec<&[f64]> {
            distances.chunk_by(|&near, &far| !is_break(near, far, 30.0, rule)).collect()
        };
        let wider: [&[f64]; 2] = [&distances[..6], &distances[6..]];
        assert_eq!(pieces(BreakRule::Wider), wider);
        let printed: [&[f64]; 8] =
            [&[0.0], &[2.0], &[4.0], &[6.0], &[8.0], &[10.0, 50.0], &[52.0], &[54.0]];
        assert_eq!(pieces(BreakRule::AsPrinted), printed);
    }

    proptest! {
        #[test]
        fn pieces_part_the_line_at_its_wide_gaps(
            steps in prop::collection::vec(1_i32..60, 1..40), side in prop::collection::vec(-1_i32..=1, 40),
        ) {
            let mut column = 0;
            let cells: Vec<_> = steps.iter().zip(side).map(|(step, row)| {
                column += step;
                [column, row]
            }).collect();
            let max_gap = 30.0;
            let Some(line) = Line::new(cells.clone(), DirectionRule::Endpoints) else {
                return Ok(());
            };
            let pieces = break_at_gaps(&line, max_gap, BreakRule::Wider, DirectionRule::Endpoints);
            let distance = |cell: [i32; 2]| {
                let [x, y] = [cell[0] - line.limits[0][0], cell[1] - line.limits[0][1]];
                f64::from(x * x + y * y).sqrt()
            };
            let mut reached = f64::NEG_INFINITY;
            for piece in &pieces {
                let mut along: Vec<_> = piece.cells.iter().map(|&cell| distance(cell)).collect();
                along.sort_by(f64::total_cmp);
                prop_assert!(along[0] - reached > max_gap);
                prop_assert!(along.windows(2).all(|pair| pair[1] - pair[0] <= max_gap));
                reached = along[along.len() - 1];
            }
            let alone = cells.iter().filter(|&&cell| {
                cells.iter().all(|&other| other == cell || (distance(other) - distance(cell)).abs() > max_gap)
            });
            let kept: usize = pieces.iter().map(|piece| piece.cells.len()).sum();
            prop_assert_eq!(kept + alone.count(), cells.len());
        }
    }
}
