//! The knobs of the alignment.

use ogm_core::{Length, ParameterError, require};

/// Which nearest neighbours count as the same piece of wall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Pairing {
    /// Free sides agree and each is nearest to the other. Safe where the robots saw different
    /// faces of a wall.
    #[default]
    NormalsReciprocal,
    /// Free sides agree.
    Normals,
    /// Each is nearest to the other.
    Reciprocal,
    /// Every source point with its nearest target point: ICP as in Besl and McKay.
    OneWay,
    /// The given share, in (0, 1], of the one-way pairs, shortest first.
    Trimmed(f64),
}

/// What an iteration minimises.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Metric {
    /// Squared distance to the line through the wall around the target point; where there is no
    /// such line, to the point. Walls slide freely along each other, so no lattice holds it.
    #[default]
    PointToLine,
    /// Squared distance between the points of a pair; closed form. Where both maps have their
    /// cells on parallel lattices, it can come to rest a cell or two off.
    PointToPoint,
}

/// How much less a large residual counts than its square.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Kernel {
    /// Not at all; the largest distance of a correspondence bounds what an outlier can do.
    #[default]
    None,
    /// Linear beyond this residual.
    Huber(Length),
    /// Logarithmic beyond about this residual, so that outliers hardly pull.
    Cauchy(Length),
}

impl Kernel {
    /// The weight of a residual, in (0, 1], where a cell has this many metres.
    pub(crate) fn weight(&self, residual: f64, spacing: f64) -> f64 {
        match self {
            Self::None => 1.0,
            Self::Huber(width) => (width.resolve(spacing) / residual.abs()).min(1.0),
            Self::Cauchy(width) => 1.0 / (1.0 + (residual / width.resolve(spacing)).powi(2)),
        }
    }
}

/// How to align; see [`align`](crate::align).
///
/// Tsardoulias et al. give no values. Those here were found on simulated maps of 0.02 m a cell;
/// lengths keep their metres on other maps, and never fall below the stated cells of the coarser
/// one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IcpParams {
    /// How far the common section reaches beyond the intersection of the bounding boxes: 0.5 m,
    /// the first distance of correspondences, so that no pair is lost at its border.
    pub section_margin: Length,
    /// Largest distance of a correspondence at first: 0.5 m, the error that a start from tags has.
    /// `f64::INFINITY` for none, then in `max_correspondence_distance` too.
    pub initial_correspondence_distance: Length,
    /// That distance shrinks by this factor an iteration, in (0, 1): 0.8, from the first
    /// to the last in eight. Nearer to 1 forgives a worse start.
    pub distance_factor: f64,
    /// Largest distance of a correspondence at last: 0.1 m, below the thickness of a wall, and 2.5 cells,
    /// above the noise of a coarse map.
    pub max_correspondence_distance: Length,
    /// Which neighbours are pairs.
    pub pairing: Pairing,
    /// Free sides agree if the cosine between them exceeds this: 0.3, about 70 degrees, since the
    /// free side of a cell near a corner turns by 45.
    pub min_side_cosine: f64,
    /// The point nearest to the partner of a point may be this far from the point itself: 0.03 m
    /// and 1.5 cells, its neighbours on the lattice.
    pub reciprocity: Length,
    /// What an iteration minimises.
    pub metric: Metric,
    /// How much less a large residual counts.
    pub kernel: Kernel,
    /// Iterations at most: 80; maps without drift take 13 to 46 on average.
    pub max_iterations: usize,
    /// Converged when an iteration turns by less than this, radians: 1e-6, a millimetre in a kilometre.
    pub rotation_epsilon: f64,
    /// and moves the centre of the pairs by less than this: a hundredth of a cell.
    pub translation_epsilon: Length,
    /// Correspondences needed: 10; fewer say nothing about two maps.
    pub min_correspondences: usize,
    /// Furthest that the result may move from the start: 1 m, twice the first distance.
    pub max_translation: Length,
    /// Furthest that the result may turn from the start, radians: 10 degrees.
    pub max_rotation: f64,
    /// The walls are those of a corridor if the smaller eigenvalue of Σ n nᵀ over their normals n
    /// is below this share of the larger: 0.02, walls within about 8 degrees of one direction.
    pub min_eigenvalue_ratio: f64,
}

/// Metres of the pixel in which the lengths were found.
const PIXEL: f64 = 0.02;

impl Default for IcpParams {
    fn default() -> Self {
        Self {
            section_margin: Length::metres(25.0 * PIXEL),
            initial_correspondence_distance: Length::metres(25.0 * PIXEL),
            distance_factor: 0.8,
            max_correspondence_distance: Length::metres(5.0 * PIXEL).at_least_cells(2.5),
            pairing: Pairing::default(),
            min_side_cosine: 0.3,
            reciprocity: Length::metres(1.5 * PIXEL).at_least_cells(1.5),
            metric: Metric::default(),
            kernel: Kernel::default(),
            max_iterations: 80,
            rotation_epsilon: 1e-6,
            translation_epsilon: Length::cells(0.01),
            min_correspondences: 10,
            max_translation: Length::metres(50.0 * PIXEL),
            max_rotation: 10_f64.to_radians(),
            min_eigenvalue_ratio: 0.02,
        }
    }
}

impl IcpParams {
    /// ICP as the paper describes it (section 4.3): every source point of the common section with
    /// its nearest target point however far, squared distances between points, and an end that is
    /// taken wherever it lies.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            initial_correspondence_distance: Length::metres(f64::INFINITY),
            max_correspondence_distance: Length::metres(f64::INFINITY),
            pairing: Pairing::OneWay,
            metric: Metric::PointToPoint,
            max_translation: Length::metres(f64::INFINITY),
            max_rotation: std::f64::consts::PI,
            min_eigenvalue_ratio: 0.0,
            ..Self::default()
        }
    }

    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let lengths = [
            ("section_margin", self.section_margin),
            ("initial_correspondence_distance", self.initial_correspondence_distance),
            ("max_correspondence_distance", self.max_correspondence_distance),
            ("reciprocity", self.reciprocity),
            ("translation_epsilon", self.translation_epsilon),
            ("max_translation", self.max_translation),
        ];
        for (name, length) in lengths {
            for value in [length.metres, length.min_cells] {
                require(value >= 0.0, name, "a length of at least 0", value)?;
            }
        }
        let factor = self.distance_factor;
        require(0.0 < factor && factor < 1.0, "distance_factor", "in (0, 1)", factor)?;
        let (first, last) = (
            self.initial_correspondence_distance.resolve(1.0),
            self.max_correspondence_distance.resolve(1.0),
        );
        require(
            first.is_finite() || last.is_infinite(),
            "max_correspondence_distance",
            "infinite where the initial distance is, which never shrinks",
            last,
        )?;
        if let Kernel::Huber(width) | Kernel::Cauchy(width) = self.kernel {
            let width = width.resolve(1.0);
            require(width.is_finite() && width > 0.0, "kernel", "a width above 0", width)?;
        }
        let cosine = self.min_side_cosine;
        require((-1.0..=1.0).contains(&cosine), "min_side_cosine", "in [-1, 1]", cosine)?;
        let angles =
            [("rotation_epsilon", self.rotation_epsilon), ("max_rotation", self.max_rotation)];
        for (name, value) in angles {
            require(value >= 0.0, name, "an angle of at least 0", value)?;
        }
        let pairs = self.min_correspondences;
        require(pairs >= 2, "min_correspondences", "at least 2", pairs as f64)?;
        let ratio = self.min_eigenvalue_ratio;
        require((0.0..=1.0).contains(&ratio), "min_eigenvalue_ratio", "in [0, 1]", ratio)?;
        if let Pairing::Trimmed(share) = self.pairing {
            let fits = 0.0 < share && share <= 1.0;
            require(fits, "pairing", "a trimmed share in (0, 1]", share)?;
        }
        Ok(())
    }
}
