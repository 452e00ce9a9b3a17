//! Knobs of the extraction.

use ogm_core::{ClassThresholds, Length};

/// Knobs of [`extract_segments`](crate::extract_segments).
///
/// Lengths that the paper prints in pixels are metres at its 0.02 m a pixel. `Params::default()`
/// holds the corrected method; [`Params::paper`] what is printed, counted in cells of the map.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// A cell votes for a line when it is closer than this: 2 px (section 4.1.1), at least 1.5
    /// cells, since a rasterised line strays by half a cell.
    pub line_distance: Length,
    /// Share of the sampled cells above which a line is accepted at once: 0.15 (section 4.1.1).
    /// A building of several rooms hardly ever has such a line.
    pub accept_share: f64,
    /// The search ends when fewer than this share of the sampled cells is left: 0.02, which leaves
    /// out no wall that could pass the other tests. The paper ends at 0.5 (section 4.1.1), with
    /// half of the walls.
    pub stop_share: f64,
    /// A wider gap between neighbours on a line parts two walls: 30 px (section 4.1.1), at least 3
    /// cells, or a wall of a coarse map falls into its cells.
    pub max_gap: Length,
    /// Segments must be longer than this: 30 px (section 4.1.1).
    pub min_length: Length,
    /// Segments must be at least this reliable, in [0, 1]: 0.6 (section 4.1.1).
    pub min_reliability: f64,
    /// Segments closer in direction than this may be one wall, radians: 3°, not printed; the
    /// spread of the result is flat from 2° to 5°.
    pub join_angle: f64,
    /// Segments whose ends come closer than this may be one wall: 5 px, at least 2 cells. Not
    /// printed; it must stay below the thickness of a wall, or its two faces become one slanted
    /// line.
    pub join_distance: Length,
    /// Most occupied cells that take part, drawn without replacement: 2000. The paper samples but
    /// does not say how much; fewer than 1000 widen the spread of the directions.
    pub max_points: usize,
    /// Pairs of cells that are tried for one line: 200, not printed; more do not help.
    pub trials_per_line: usize,
    /// When no trial passes `accept_share`, the best is accepted with at least this many votes:
    /// 10, enough to tell a wall from clutter.
    pub fallback_votes: usize,
    /// … and at least this share of the sampled cells: 0.01.
    pub fallback_share: f64,
    /// Most lines: 60, a bound on the cost.
    pub max_lines: usize,
    /// Half width in cells of the band under a segment in which the most occupied cell counts for
    /// its reliability: 1, as a segment between extreme cells runs off a thin wall by about that.
    pub reliability_band: u16,
    /// How the direction of a segment is estimated.
    pub direction: DirectionRule,
    /// Which gaps part two walls.
    pub break_rule: BreakRule,
    /// Which cells are occupied: p ≥ 0.65, symmetric in log-odds to the free ones.
    pub classes: ClassThresholds,
    /// Seed of all draws.
    pub seed: u64,
}

/// How the direction of a segment, and from it the segment's ends, are estimated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum DirectionRule {
    /// The principal axis of the cells of the segment, from the outermost of them to the other.
    TotalLeastSquares,
    /// From one of the two farthest cells to the other, as the paper has it; those of a thick wall lie on its
    /// diagonal.
    Endpoints,
}

/// Which gaps between neighbours on a line part two walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BreakRule {
    /// Those wider than [`Params::max_gap`].
    Wider,
    /// Those narrower than [`Params::max_gap`], the misprint |d(k) − d(k+1)| < `D_s`.
    AsPrinted,
}

impl Params {
    /// The values that Tsardoulias et al. print, lengths in cells of the map; an angle of 5° and
    /// a distance of 10 cells for the joining, which they do not print.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            line_distance: Length::cells(2.0),
            stop_share: 0.5,
            max_gap: Length::cells(30.0),
            min_length: Length::cells(30.0),
            join_angle: 5.0_f64.to_radians(),
            join_distance: Length::cells(10.0),
            direction: DirectionRule::Endpoints,
            ..Self::default()
        }
    }
}

impl Default for Params {
    fn default() -> Self {
        Self {
            line_distance: Length::metres(0.04).at_least_cells(1.5),
            accept_share: 0.15,
            stop_share: 0.02,
            max_gap: Length::metres(0.6).at_least_cells(3.0),
            min_length: Length::metres(0.6),
            min_reliability: 0.6,
            join_angle: 3.0_f64.to_radians(),
            join_distance: Length::metres(0.1).at_least_cells(2.0),
            max_points: 2000,
            trials_per_line: 200,
            fallback_votes: 10,
            fallback_share: 0.01,
            max_lines: 60,
            reliability_band: 1,
            direction: DirectionRule::TotalLeastSquares,
            break_rule: BreakRule::Wider,
            classes: ClassThresholds::default(),
            seed: 0,
        }
    }
}

/// The lengths of [`Params`] in cells of one map.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InCells {
    pub(crate) line_distance: f64,
    pub(crate) max_gap: f64,
    pub(crate) min_length: f64,
    pub(crate) join_distance: f64,
}

impl InCells {
    pub(crate) fn new(params: &Params, resolution: f64) -> Self {
        let cells = |length: &Length| length.resolve(resolution) / resolution;
        Self {
            line_distance: cells(&params.line_distance),
            max_gap: cells(&params.max_gap),
            min_length: cells(&params.min_length),
            join_distance: cells(&params.join_distance),
        }
    }

    /// The same in cells that are smaller by `times`.
    pub(crate) fn finer(&self, times: f64) -> Self {
        Self {
            line_distance: times * self.line_distance,
            max_gap: times * self.max_gap,
            min_length: times * self.min_length,
            join_distance: times * self.join_distance,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{InCells, Params};

    fn lengths(params: &Params, resolution: f64) -> [f64; 4] {
        let cells = InCells::new(params, resolution);
        [cells.line_distance, cells.max_gap, cells.min_length, cells.join_distance]
    }

    #[test]
    fn default_lengths_are_the_printed_pixels_at_two_centimetres_and_floored_on_coarse_maps() {
        for (resolution, expected) in [(0.02, [2.0, 30.0, 30.0, 5.0]), (0.1, [1.5, 6.0, 6.0, 2.0])]
        {
            for (cells, expected) in lengths(&Params::default(), resolution).iter().zip(expected) {
                assert!((cells - expected).abs() < 1e-9, "{cells} at {resolution}");
            }
        }
        assert_eq!(lengths(&Params::paper(), 0.25), [2.0, 30.0, 30.0, 10.0]);
    }
}
