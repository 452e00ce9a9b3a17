//! What a simulated robot is like.

use std::f64::consts::TAU;

use nalgebra::Vector2;
use ogm_core::{ParameterError, require};

/// A robot, its sensors and the seed of everything random about a pair of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairParams {
    /// Decides map headings, tag places and all noise; the plan has a seed of its own.
    pub seed: u64,
    /// Metres between the points of a path, each of which reads the tags; at least 0.001.
    pub step: f64,
    /// The range sensor.
    pub lidar: LidarParams,
    /// How scans become a map.
    pub mapping: MappingParams,
    /// The tag reader.
    pub tags: TagParams,
    /// How wrong a robot is about its own pose; not at all by default.
    pub drift: DriftParams,
}

impl PairParams {
    /// The robots of Tsardoulias et al.: long-range lidar, 0.02 m cells. Also the default.
    #[must_use]
    pub fn rf() -> Self {
        Self {
            seed: 0,
            step: 0.03,
            lidar: LidarParams::rf(),
            mapping: MappingParams::default(),
            tags: TagParams::default(),
            drift: DriftParams::default(),
        }
    }

    /// The robots of Saeedi et al.: short-range lidar, 0.05 m cells (the paper prints none).
    #[must_use]
    pub fn sa() -> Self {
        Self {
            lidar: LidarParams::sa(),
            mapping: MappingParams { resolution: 0.05, ..MappingParams::default() },
            ..Self::rf()
        }
    }

    /// The robots of Carpin and Birk: few beams, 0.14 m cells, imprecise poses.
    #[must_use]
    pub fn cb() -> Self {
        Self {
            lidar: LidarParams::cb(),
            mapping: MappingParams { resolution: 0.14, ..MappingParams::default() },
            drift: DriftParams {
                odometry_share: 0.01,
                compass_sigma: 2.0_f64.to_radians(),
                ..DriftParams::default()
            },
            ..Self::rf()
        }
    }

    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        check_step(self.step)?;
        self.lidar.check()?;
        self.mapping.check()?;
        self.tags.check()?;
        not_negative("odometry_share", self.drift.odometry_share)?;
        not_negative("compass_sigma", self.drift.compass_sigma)?;
        not_negative("bend", self.drift.bend)
    }
}

impl Default for PairParams {
    fn default() -> Self {
        Self::rf()
    }
}

/// A range sensor that looks forward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LidarParams {
    /// Angle between the first and the last beam, radians.
    pub field_of_view: f64,
    /// Beams of a scan, at least 2.
    pub beams: usize,
    /// Furthest range that returns, metres.
    pub max_range: f64,
    /// Standard deviation of a range, metres.
    pub range_sigma: f64,
    /// Ranges are multiples of this, metres; 0 is continuous.
    pub quantum: f64,
    /// Share of readings that end anywhere short of the wall.
    pub spurious_share: f64,
    /// Metres between two scans.
    pub scan_every: f64,
}

impl LidarParams {
    /// 270°, 1081 beams, 8 m; Tsardoulias et al. print no sensor, this is a common one.
    #[must_use]
    pub fn rf() -> Self {
        Self {
            field_of_view: 270.0_f64.to_radians(),
            beams: 1081,
            max_range: 8.0,
            range_sigma: 0.01,
            quantum: 0.0,
            spurious_share: 0.0,
            scan_every: 0.24,
        }
    }

    /// 513 beams 0.36° apart, 4.5 m (Saeedi et al.).
    #[must_use]
    pub fn sa() -> Self {
        Self {
            field_of_view: (512.0 * 0.36_f64).to_radians(),
            beams: 513,
            max_range: 4.5,
            range_sigma: 0.02,
            ..Self::rf()
        }
    }

    /// 162°, 91 beams, 4 m in steps of 1 cm (Carpin and Birk), one reading in a hundred spurious.
    #[must_use]
    pub fn cb() -> Self {
        Self {
            field_of_view: 162.0_f64.to_radians(),
            beams: 91,
            max_range: 4.0,
            range_sigma: 0.01,
            quantum: 0.01,
            spurious_share: 0.01,
            ..Self::rf()
        }
    }

    /// Unit vectors along the beams of a robot that looks along x, from right to left.
    #[must_use]
    pub fn directions(&self) -> Vec<Vector2<f64>> {
        let increment = self.field_of_view / (self.beams - 1) as f64;
        let angles = (0..self.beams).map(|beam| increment * beam as f64 - self.field_of_view / 2.0);
        angles.map(|angle| Vector2::new(angle.cos(), angle.sin())).collect()
    }

    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        positive("field_of_view", self.field_of_view)?;
        require(
            self.field_of_view <= TAU,
            "field_of_view",
            "at most a full turn",
            self.field_of_view,
        )?;
        let beams = self.beams as f64;
        let fits = (2..=1_000_000).contains(&self.beams);
        require(fits, "beams", "2 to 1 000 000", beams)?;
        positive("max_range", self.max_range)?;
        not_negative("range_sigma", self.range_sigma)?;
        not_negative("quantum", self.quantum)?;
        not_negative("spurious_share", self.spurious_share)?;
        require(self.spurious_share <= 1.0, "spurious_share", "at most 1", self.spurious_share)?;
        positive("scan_every", self.scan_every)
    }
}

/// How scans become an occupancy grid: log-odds with one update a cell and scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MappingParams {
    /// Metres a cell; 0.02 as in Tsardoulias et al.
    pub resolution: f64,
    /// Added to the log-odds of a cell where a beam ends.
    pub occupied_update: f64,
    /// Added to the log-odds of a cell that a beam passes; below 0.
    pub free_update: f64,
    /// Log-odds stay within ± this.
    pub limit: f64,
}

impl Default for MappingParams {
    /// p = 0.70 for a hit and 0.40 for a pass, clamped to ±8: common values.
    fn default() -> Self {
        Self { resolution: 0.02, occupied_update: 0.85, free_update: -0.4, limit: 8.0 }
    }
}

impl MappingParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        positive("resolution", self.resolution)?;
        positive("occupied_update", self.occupied_update)?;
        positive("-free_update", -self.free_update)?;
        positive("limit", self.limit)
    }
}

/// Radio tags and their reader (Tsardoulias et al., section 3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TagParams {
    /// Tags on the walls of a plan.
    pub count: usize,
    /// A tag is read while its true distance is at most this, metres, through walls too.
    pub max_range: f64,
    /// Standard deviation of a range, metres; no reading is off by more than four of them.
    pub range_sigma: f64,
    /// Added to every range, metres.
    pub range_bias: f64,
    /// Share of the readings that come by way of a wall and are longer, by up to `echo_length`.
    pub echo_share: f64,
    /// Most that a reflection adds to a range, metres.
    pub echo_length: f64,
    /// Share of the readings that are lost.
    pub lost_share: f64,
    /// Standard deviation, per axis, of how far each robot takes each tag from its place, metres;
    /// stands for whatever makes two robots disagree about a tag.
    pub tag_position_sigma: f64,
}

impl Default for TagParams {
    fn default() -> Self {
        Self {
            count: 16,
            max_range: 3.0,
            range_sigma: 0.05,
            range_bias: 0.0,
            echo_share: 0.0,
            echo_length: 1.5,
            lost_share: 0.0,
            tag_position_sigma: 0.0,
        }
    }
}

impl TagParams {
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        positive("tags.max_range", self.max_range)?;
        not_negative("tags.range_sigma", self.range_sigma)?;
        not_negative("tags.range_bias.abs()", self.range_bias.abs())?;
        for (name, share) in [("echo_share", self.echo_share), ("lost_share", self.lost_share)] {
            require((0.0..=1.0).contains(&share), name, "0 to 1", share)?;
        }
        not_negative("echo_length", self.echo_length)?;
        not_negative("tag_position_sigma", self.tag_position_sigma)
    }
}

/// How wrong a robot is about its own pose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DriftParams {
    /// Standard deviation, per axis, of the position gained on each metre travelled, metres; it
    /// grows with the root of the distance.
    pub odometry_share: f64,
    /// Standard deviation of the heading of each scan, radians; does not accumulate.
    pub compass_sigma: f64,
    /// Standard deviation, per axis, of a smooth displacement over 15 m and more, metres: the bend
    /// that remains in a map after its loops are closed.
    pub bend: f64,
}

pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), ParameterError> {
    require(value.is_finite() && value > 0.0, name, "finite and above 0", value)
}

/// Steps below a millimetre are a mistake and would not end.
pub(crate) fn check_step(step: f64) -> Result<(), ParameterError> {
    require(step.is_finite() && step >= 0.001, "step", "finite and at least 0.001 m", step)
}

pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<(), ParameterError> {
    require(value.is_finite() && value >= 0.0, name, "finite and not below 0", value)
}
