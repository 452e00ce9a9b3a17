//! Ways through free space on a coarse lattice.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::Point2;
use ogm_core::{CellIndex, Grid, GridFrame, l2_distance_sq};

/// The largest connected part of free space that a disc can move in, on a lattice of nodes half a
/// clearance apart, so that the straight line between neighbours is free as well.
pub(crate) struct FreeSpace {
    frame: GridFrame,
    /// Squared cells to the nearest blocked cell.
    distance_sq: Grid<u32>,
    clearance_cells: f64,
    /// Cells between two nodes.
    stride: usize,
    /// Which nodes belong to the region.
    region: Grid<bool>,
}

/// A node by its position in the row-major lattice.
pub(crate) type Node = usize;

impl FreeSpace {
    /// The largest region where a disc of radius `clearance` fits; `None` if it fits nowhere.
    /// Everything outside the grid is blocked.
    pub(crate) fn largest(blocked: &Grid<bool>, frame: &GridFrame, clearance: f64) -> Option<Self> {
        let space = Self::everywhere(blocked, frame, clearance)?;
        let mut seen = space.region.map(|_| false);
        let mut best = Vec::new();
        for node in 0..seen.cells().len() {
            if space.region.cells()[node] && !seen.cells()[node] {
                let component = space.flood(node, &mut seen);
                if component.len() > best.len() {
                    best = component;
                }
            }
        }
        space.restrict_to(&best)
    }

    /// The region of the disc that stands at `start`; `None` if it cannot stand near there.
    pub(crate) fn around(
        blocked: &Grid<bool>,
        frame: &GridFrame,
        clearance: f64,
        start: Point2<f64>,
    ) -> Option<Self> {
        let space = Self::everywhere(blocked, frame, clearance)?;
        let node = space.node_near(start)?;
        let component = space.flood(node, &mut space.region.map(|_| false));
        space.restrict_to(&component)
    }

    fn everywhere(blocked: &Grid<bool>, frame: &GridFrame, clearance: f64) -> Option<Self> {
        let clearance_cells = clearance / frame.resolution();
        let stride = half(clearance_cells);
        let distance_sq = l2_distance_sq(blocked).unwrap_or_else(|| blocked.map(|_| u32::MAX));
        let columns = blocked.width().div_ceil(stride);
        let rows = blocked.height().div_ceil(stride);
        let mut space = Self {
            frame: *frame,
            distance_sq,
            clearance_cells,
            stride,
            region: Grid::filled(columns, rows, false).ok()?,
        };
        let fits: Vec<bool> =
            (0..columns * rows).map(|node| space.fits(space.cell_of(node), 1.0)).collect();
        space.region = Grid::new(columns, rows, fits).ok()?;
        Some(space)
    }

    fn restrict_to(mut self, nodes: &[Node]) -> Option<Self> {
        self.region.cells_mut().fill(false);
        for &node in nodes {
            self.region.cells_mut()[node] = true;
        }
        (!nodes.is_empty()).then_some(self)
    }

    /// Square metres of the region.
    pub(crate) fn area(&self) -> f64 {
        let side = self.stride as f64 * self.frame.resolution();
        self.nodes().count() as f64 * side * side
    }

    /// The nodes of the region, in order.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = Node> {
        let cells = self.region.cells().iter().enumerate();
        cells.filter(|(_, inside)| **inside).map(|(node, _)| node)
    }

    /// Where a node is.
    pub(crate) fn point(&self, node: Node) -> Point2<f64> {
        self.frame.cell_centre(self.cell_of(node))
    }

    /// Whether a disc of `share` times the clearance can stand at `point`.
    pub(crate) fn is_clear(&self, point: Point2<f64>, share: f64) -> bool {
        let [column, row] = self.frame.lattice_cell(point);
        let cell = usize::try_from(column).ok().zip(usize::try_from(row).ok());
        cell.is_some_and(|(column, row)| self.fits(CellIndex { column, row }, share))
    }

    /// Whether the disc can move straight from `from` to `to`.
    pub(crate) fn is_clear_between(&self, from: Point2<f64>, to: Point2<f64>) -> bool {
        let pieces = ((to - from).norm() / self.frame.resolution()).ceil().max(1.0);
        let share = |piece: u32| f64::from(piece) / pieces;
        (0_u32..)
            .map(share)
            .take_while(|&share| share <= 1.0)
            .all(|along| self.is_clear(from + (to - from) * along, 1.0))
    }

    /// Whether the region comes within a node of `point`.
    pub(crate) fn reaches(&self, point: Point2<f64>) -> bool {
        self.node_near(point).is_some()
    }

    /// The node of the region nearest to `point`, at most two nodes away.
    pub(crate) fn node_near(&self, point: Point2<f64>) -> Option<Node> {
        let [column, row] = self.frame.lattice_cell(point);
        let stride = i64::try_from(self.stride).ok()?;
        let near = |cell: i64| {
            let node = cell.div_euclid(stride);
            (node - 1..=node + 2).filter_map(|node| usize::try_from(node).ok())
        };
        near(row)
            .flat_map(|row| near(column).map(move |column| CellIndex { column, row }))
            .filter(|&index| self.region.get(index) == Some(&true))
            .map(|index| index.row * self.region.width() + index.column)
            .min_by(|&a, &b| {
                let distance = |node| (self.point(node) - point).norm();
                distance(a).total_cmp(&distance(b))
            })
    }

    /// The shortest way from node to node through the region, both included; `None` if there is
    /// none.
    pub(crate) fn way(&self, from: Node, to: Node) -> Option<Vec<Node>> {
        let count = self.region.cells().len();
        let mut cost = vec![u32::MAX; count];
        let mut previous = vec![from; count];
        let mut open = BinaryHeap::new();
        *cost.get_mut(from)? = 0;
        open.push(Reverse((self.octile(from, to), from)));
        while let Some(Reverse((estimate, node))) = open.pop() {
            if node == to {
                let mut way = vec![to];
                while let Some(&node) = way.last().filter(|&&node| node != from) {
                    way.push(previous[node]);
                }
                way.reverse();
                return Some(way);
            }
            if estimate > cost[node].saturating_add(self.octile(node, to)) {
                continue;
            }
            for (neighbour, step) in self.neighbours(node) {
                let reached = cost[node].saturating_add(step);
                if reached < cost[neighbour] {
                    cost[neighbour] = reached;
                    previous[neighbour] = node;
                    let estimate = reached.saturating_add(self.octile(neighbour, to));
                    open.push(Reverse((estimate, neighbour)));
                }
            }
        }
        None
    }

    /// The corners that remain of a way when every straight stretch that is clear is taken.
    pub(crate) fn straightened(&self, way: &[Node]) -> Vec<Point2<f64>> {
        let points: Vec<_> = way.iter().map(|&node| self.point(node)).collect();
        let mut corners: Vec<_> = points.first().copied().into_iter().collect();
        let mut at = 0;
        while at + 1 < points.len() {
            let visible = |&next: &usize| self.is_clear_between(points[at], points[next]);
            let mut next = at + 1;
            let mut leap = 1;
            // Doubling finds a far visible node with few tests; it need not be the furthest.
            while let Some(further) =
                Some(next + leap).filter(|&n| n < points.len()).filter(visible)
            {
                next = further;
                leap *= 2;
            }
            while leap > 1 {
                leap /= 2;
                if let Some(further) =
                    Some(next + leap).filter(|&n| n < points.len()).filter(visible)
                {
                    next = further;
                }
            }
            corners.push(points[next]);
            at = next;
        }
        corners
    }

    fn cell_of(&self, node: Node) -> CellIndex {
        let at = self.region.index_of(node);
        CellIndex { column: at.column * self.stride, row: at.row * self.stride }
    }

    fn fits(&self, cell: CellIndex, share: f64) -> bool {
        let clearance = share * self.clearance_cells;
        let (width, height) = (self.distance_sq.width(), self.distance_sq.height());
        let Some(&distance_sq) = self.distance_sq.get(cell) else {
            return false;
        };
        let to_border = [cell.column + 1, cell.row + 1, width - cell.column, height - cell.row];
        let nearest = to_border.into_iter().min().unwrap_or(0) as f64;
        nearest >= clearance && f64::from(distance_sq) >= clearance * clearance
    }

    fn flood(&self, start: Node, seen: &mut Grid<bool>) -> Vec<Node> {
        let mut component = vec![start];
        seen.cells_mut()[start] = true;
        let mut next = 0;
        while let Some(&node) = component.get(next) {
            next += 1;
            for (neighbour, _) in self.neighbours(node) {
                if !seen.cells()[neighbour] {
                    seen.cells_mut()[neighbour] = true;
                    component.push(neighbour);
                }
            }
        }
        component
    }

    /// Nodes of the region beside `node`, with the cost of the step in tenths.
    fn neighbours(&self, node: Node) -> impl Iterator<Item = (Node, u32)> {
        let (columns, at) = (self.region.width(), self.region.index_of(node));
        let around = |x: usize| [x.wrapping_sub(1), x, x + 1];
        around(at.row)
            .into_iter()
            .flat_map(move |row| around(at.column).map(|column| CellIndex { column, row }))
            .filter(move |&index| index != at && self.region.get(index) == Some(&true))
            .map(move |index| {
                let diagonal = index.row != at.row && index.column != at.column;
                (index.row * columns + index.column, if diagonal { 14 } else { 10 })
            })
    }

    /// A lower bound of the cost between two nodes.
    fn octile(&self, a: Node, b: Node) -> u32 {
        let (a, b) = (self.region.index_of(a), self.region.index_of(b));
        let (dx, dy) = (a.column.abs_diff(b.column), a.row.abs_diff(b.row));
        u32::try_from(10 * dx.max(dy) + 4 * dx.min(dy)).unwrap_or(u32::MAX)
    }
}

/// Half of `cells`, at least 1.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates; a stride beyond the grid leaves one node"
)]
fn half(cells: f64) -> usize {
    ((cells / 2.0) as usize).clamp(1, 1 << 20)
}

#[cfg(test)]
mod tests {
    use super::FreeSpace;
    use nalgebra::Point2;
    use ogm_core::{ClassThresholds, GridFrame, OccupancyGrid, Se2};

    const ROOMS: &str = "
        #####################
        #.........#.........#
        #.........#.........#
        #.........#.........#
        #...................#
        #...................#
        #...................#
        #.........#.........#
        #.........#.........#
        ##############.######
        #...#...............#
        #####################";

    fn space(clearance: f64) -> Option<FreeSpace> {
        let frame = GridFrame::new(0.1, Se2::new(1.0, 2.0, 0.5)).unwrap();
        let map = OccupancyGrid::from_ascii(frame, ROOMS).unwrap();
        let blocked = map.occupied_mask(&ClassThresholds::default());
        FreeSpace::largest(&blocked, &frame, clearance)
    }

    #[test]
    fn ways_are_free_and_straight_where_they_can_be() {
        let space = space(0.19).unwrap();
        let nodes: Vec<_> = space.nodes().collect();
        let (from, to) = (nodes[0], *nodes.last().unwrap());
        let way = space.way(from, to).unwrap();
        assert_eq!((way[0], *way.last().unwrap()), (from, to));
        let corners = space.straightened(&way);
        assert!(corners.windows(2).all(|ends| space.is_clear_between(ends[0], ends[1])));
        assert!((3..=6).contains(&corners.len()), "{corners:?}");
    }

    #[test]
    fn narrow_doors_divide_and_large_robots_fit_nowhere() {
        let wide = space(0.1).unwrap();
        let narrow = space(0.19).unwrap();
        let frame = GridFrame::new(0.1, Se2::new(1.0, 2.0, 0.5)).unwrap();
        let behind = frame.point_from_cells(Point2::new(10.5, 1.5));
        assert!(wide.reaches(behind) && !narrow.reaches(behind));
        assert!(wide.area() > narrow.area());
        assert!(space(0.6).is_none());
    }
}
