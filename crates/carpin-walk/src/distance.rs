//! The picture distance ψ between a target map and a placed source map.

use nalgebra::Point2;
use ogm_core::{CellClass, Grid, GridError, GridFrame, OccupancyGrid, Se2};

use crate::class_map::{CLASSES, ClassMap, NEITHER};
use crate::layer::Layer;
use crate::raster::{CellBox, place};
use crate::{DistanceParams, Objective, Placement, WalkError};

/// How little two maps look alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dissimilarity {
    /// ψ, cells: 0 for equal maps, infinite where the maps overlap too little for
    /// [`Objective::Overlap`].
    pub psi: f64,
    /// Classes, obstacles and free, that both maps have where they are compared.
    pub common_classes: usize,
    /// Whether neither map has a cell of either class: ψ is 0 then and means nothing.
    pub no_information: bool,
}

/// ψ of two pictures on one lattice (Carpin and Birk, section 4): for each class, the mean city-block
/// distance from a cell of it in one picture to the nearest in the other, both ways, summed.
///
/// A class that only one picture has costs twice the largest distance in the picture; undecided
/// cells are unknown.
///
/// # Errors
/// Pictures of different size.
pub fn psi(m1: &Grid<CellClass>, m2: &Grid<CellClass>) -> Result<Dissimilarity, GridError> {
    if (m1.width(), m1.height()) != (m2.width(), m2.height()) {
        return Err(GridError::ResolutionMismatch {
            a_width: m1.width(),
            a_height: m1.height(),
            a_resolution: 1.0,
            b_width: m2.width(),
            b_height: m2.height(),
            b_resolution: 1.0,
        });
    }
    let (target, source) = (ClassMap::new(m1), ClassMap::new(m2));
    Ok(Pictures::new(&target, source, 0, Objective::Picture).compare(&[0.0; 3]))
}

/// ψ of a target map and a source map anywhere on it.
///
/// What does not depend on the place is computed once and the buffers are kept, so that a look at
/// a place allocates nothing.
#[derive(Debug, Clone)]
pub struct MapDistance {
    pictures: Pictures,
    target_frame: GridFrame,
    source_frame: GridFrame,
}

impl MapDistance {
    /// Prepares to compare `source` with `target`.
    ///
    /// # Errors
    /// Maps of different resolution, or a parameter outside its range.
    pub fn new(
        target: &OccupancyGrid,
        source: &OccupancyGrid,
        params: &DistanceParams,
    ) -> Result<Self, WalkError> {
        params.check()?;
        target.check_same_resolution(source)?;
        let classes = |map: &OccupancyGrid| {
            ClassMap::new(&map.cells().map(|&cell| params.thresholds.classify(cell)))
        };
        let (in_target, in_source) = (classes(target), classes(source));
        let sides = in_target.size.into_iter().chain(in_source.size);
        let side = sides.max().unwrap_or(1) as f64;
        #[expect(clippy::cast_possible_truncation, reason = "at most twice a map's side")]
        let margin = (params.padding * side).ceil() as i64;
        Ok(Self {
            pictures: Pictures::new(&in_target, in_source, margin, params.objective),
            target_frame: *target.frame(),
            source_frame: *source.frame(),
        })
    }

    /// ψ under a transform.
    ///
    /// # Errors
    /// A transform that is not finite.
    pub fn psi(&mut self, target_from_source: &Se2) -> Result<Dissimilarity, GridError> {
        target_from_source.check_finite()?;
        Ok(self.psi_at(&self.placement(target_from_source)))
    }

    /// ψ where the source's reference point is moved to `placement`.
    pub fn psi_at(&mut self, placement: &Placement) -> Dissimilarity {
        self.pictures.compare(placement)
    }

    /// Where a transform puts the centre of the source, from the centre of the target along its
    /// rows and columns, and how it turns the source's rows.
    #[must_use]
    pub fn placement(&self, target_from_source: &Se2) -> Placement {
        let [x, y] = self.pictures.source.centre();
        let centre = *target_from_source * self.source_frame.point_from_cells(Point2::new(x, y));
        let at = self.target_frame.cells_from_point(centre);
        let [x, y] = self.pictures.target_centre;
        let targets = self.target_frame.map_from_grid();
        let turn = targets.inverse() * *target_from_source * self.source_frame.map_from_grid();
        [at.x - x, at.y - y, turn.theta().to_degrees()]
    }

    /// The transform of a placement, the reverse of [`placement`](Self::placement).
    #[must_use]
    pub fn target_from_source(&self, placement: &Placement) -> Se2 {
        let metres = self.target_frame.resolution();
        let [x, y] = self.pictures.target_centre;
        let moved = Se2::new(
            (x + placement[0]) * metres,
            (y + placement[1]) * metres,
            placement[2].to_radians(),
        );
        let metres = self.source_frame.resolution();
        let [x, y] = self.pictures.source.centre();
        let about_centre = Se2::new(-x * metres, -y * metres, 0.0);
        self.target_frame.map_from_grid()
            * moved
            * about_centre
            * self.source_frame.map_from_grid().inverse()
    }

    /// Mean of the widths and of the heights of both maps, cells.
    pub(crate) fn mean_size(&self) -> [f64; 2] {
        let [a, b] = [self.pictures.target_centre, self.pictures.source.centre()];
        [a[0] + b[0], a[1] + b[1]]
    }

    /// Cells of each class in the target and in the source.
    pub(crate) fn class_counts(&self) -> [[usize; CLASSES]; 2] {
        [self.pictures.target_counts, self.pictures.source.counts]
    }
}

/// Both pictures and the buffers.
#[derive(Debug, Clone)]
struct Pictures {
    source: ClassMap,
    target_counts: [usize; CLASSES],
    target_centre: [f64; 2],
    /// Where the target has cells of either class.
    target_box: CellBox,
    target_codes: Grid<u8>,
    layers: [Layer; CLASSES],
    /// Cells of the box that both maps know; used by the overlap only.
    known_in_both: Vec<bool>,
    canvas: CellBox,
    objective: Objective,
}

impl Pictures {
    fn new(target: &ClassMap, source: ClassMap, margin: i64, objective: Objective) -> Self {
        let size = |cells: usize| i64::try_from(cells).unwrap_or(i64::MAX);
        let [low_x, low_y] = target.first;
        let high = [low_x + size(target.codes.width()), low_y + size(target.codes.height())];
        let [width, height] = target.size;
        Self {
            target_counts: target.counts,
            target_centre: target.centre(),
            target_box: CellBox { low: target.first, high },
            layers: [Layer::new(target, 1), Layer::new(target, 2)],
            known_in_both: vec![false; target.codes.cells().len()],
            target_codes: target.codes.clone(),
            canvas: CellBox {
                low: [-margin; 2],
                high: [size(width) + margin, size(height) + margin],
            },
            source,
            objective,
        }
    }

    fn compare(&mut self, placement: &Placement) -> Dissimilarity {
        match self.objective {
            Objective::Picture => {
                self.lay::<false>(placement);
                self.sum_up(false)
            }
            Objective::Overlap { min_share } => {
                let common = self.lay::<true>(placement);
                let fewer = self.source.known().min(self.target_counts.iter().sum());
                let too_little = (common as f64) < min_share * fewer as f64;
                let mut found = self.sum_up(true);
                if too_little {
                    found.psi = f64::INFINITY;
                }
                found
            }
        }
    }

    /// Puts the source onto the layers and returns how many cells both maps know, if asked for.
    fn lay<const OVERLAP: bool>(&mut self, placement: &Placement) -> usize {
        self.layers.iter_mut().for_each(Layer::clear);
        if OVERLAP {
            self.known_in_both.fill(false);
        }
        let CellBox { low, high } = self.target_box;
        let width = self.target_codes.width();
        let (layers, known) = (&mut self.layers, &mut self.known_in_both);
        let codes = self.target_codes.cells();
        let mut common = 0;
        place(&self.source, placement, self.target_centre, self.canvas, |column, row, code| {
            let (x, y) = (column.clamp(low[0], high[0] - 1), row.clamp(low[1], high[1] - 1));
            let away = x.abs_diff(column) + y.abs_diff(row);
            #[expect(clippy::cast_possible_truncation, reason = "inside the box")]
            let position =
                (y - low[1]).unsigned_abs() as usize * width + (x - low[0]).unsigned_abs() as usize;
            let both = OVERLAP && away == 0 && codes[position] != NEITHER;
            if both {
                common += 1;
                known[position] = true;
            }
            let away = u32::try_from(away).unwrap_or(u32::MAX);
            layers[usize::from(code - 1)].add(position, away, !OVERLAP || both);
        });
        common
    }

    fn sum_up(&mut self, overlap: bool) -> Dissimilarity {
        let counts = overlap.then_some(self.known_in_both.as_slice());
        let CellBox { low, high } = self.canvas;
        let farthest = (high[0] - low[0] + high[1] - low[1] - 2) as f64;
        let (mut psi, mut common_classes) = (0.0, 0);
        for layer in &mut self.layers {
            let term = layer.finish(counts);
            psi += match (term.target_cells, term.source_cells) {
                (0, 0) => 0.0,
                (0, _) | (_, 0) => 2.0 * farthest,
                (in_target, in_source) => {
                    common_classes += 1;
                    term.target_sum as f64 / in_target as f64
                        + term.source_sum as f64 / in_source as f64
                }
            };
        }
        let no_information = self.target_counts == [0, 0] && self.source.counts == [0, 0];
        Dissimilarity { psi, common_classes, no_information }
    }
}
