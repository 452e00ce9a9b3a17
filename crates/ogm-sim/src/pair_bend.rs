//! Where two maps show the same places.

use nalgebra::Point2;
use ogm_core::Se2;

use crate::RobotRun;
use crate::shown::Shown;

/// Where every place of one map lies in another, whatever their robots believed about their poses.
#[derive(Debug, Clone, PartialEq)]
pub struct PairBend {
    target: Shown,
    source: Shown,
    /// Of places, which no error displaces.
    target_from_source: Se2,
}

impl PairBend {
    pub(crate) fn between(target: &RobotRun, source: &RobotRun) -> Self {
        Self {
            target: target.shown.clone(),
            source: source.shown.clone(),
            target_from_source: target.world_from_map.between(&source.world_from_map),
        }
    }

    /// Where the target shows what the source shows at `shown`, each in its map frame; `None` if
    /// either robot's lidar hit nothing there.
    #[must_use]
    pub fn in_target(&self, shown: Point2<f64>) -> Option<Point2<f64>> {
        let place = self.source.place(shown)?;
        self.target.shown(self.target_from_source * place)
    }
}

/// Where both maps show the walls that both robots saw (target, source): a pair for every tenth of a
/// metre.
pub(crate) fn shared_walls(target: &RobotRun, source: &RobotRun) -> Vec<[Point2<f64>; 2]> {
    let target_from_source = target.world_from_map.between(&source.world_from_map);
    let places = source.shown.places();
    let both = places.filter_map(|place| {
        let in_target = target.shown.shown(target_from_source * place)?;
        Some([in_target, source.shown.shown(place)?])
    });
    both.collect()
}
