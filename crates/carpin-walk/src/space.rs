//! Where samples may lie.

use ogm_core::wrap_period;

use crate::WalkError;

/// A placement of the source map: x and y of its centre in cells and its turn in degrees.
///
/// These are the units of the paper, in which one covariance fits all three: a turn by 1° moves a
/// point 57 cells away by one cell. [`MapDistance`](crate::MapDistance) converts.
pub type Placement = [f64; 3];

/// The closed box S of placements; turns wrap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SearchBox {
    /// Its middle.
    pub centre: Placement,
    /// From the middle to each side; 180 degrees or more admits every turn.
    pub reach: [f64; 3],
}

impl SearchBox {
    /// The placement with its turn wrapped into [−180, 180), or `None` outside the box.
    #[must_use]
    pub fn admit(&self, placement: Placement) -> Option<Placement> {
        let turn = wrap_period(placement[2], 360.0);
        let inside = self
            .offset(placement)
            .iter()
            .zip(&self.reach)
            .all(|(distance, reach)| distance.abs() <= *reach);
        inside.then_some([placement[0], placement[1], turn])
    }

    pub(crate) fn check_start(&self, start: Placement) -> Result<Placement, WalkError> {
        let [x, y, turn] = self.offset(start);
        let [reach_x, reach_y, reach_turn] = self.reach;
        self.admit(start).ok_or(WalkError::StartOutside {
            x,
            y,
            turn,
            reach_x,
            reach_y,
            reach_turn,
        })
    }

    fn offset(&self, placement: Placement) -> [f64; 3] {
        let [x, y, turn] = placement;
        let turn = wrap_period(turn - self.centre[2], 360.0);
        [x - self.centre[0], y - self.centre[1], turn]
    }
}

#[cfg(test)]
mod tests {
    use super::SearchBox;

    #[test]
    fn turns_wrap_and_places_do_not() {
        let all = SearchBox { centre: [0.0; 3], reach: [50.0, 40.0, 180.0] };
        assert_eq!(all.admit([50.0, -40.0, 190.0]), Some([50.0, -40.0, -170.0]));
        assert_eq!(all.admit([50.1, 0.0, 0.0]), None);
        assert_eq!(all.admit([0.0, f64::NAN, 0.0]), None);
        let narrow = SearchBox { centre: [5.0, 0.0, 175.0], reach: [1.0, 1.0, 10.0] };
        assert_eq!(narrow.admit([5.0, 0.0, -176.0]), Some([5.0, 0.0, -176.0]));
        assert_eq!(narrow.admit([5.0, 0.0, -174.0]), None);
    }
}
