//! Floor plans as text.

use nalgebra::{Point2, Vector2};

use crate::plan::{Kind, Solid};
use crate::symmetry::refuse_symmetric;
use crate::{FloorPlan, SimError};

/// Longest side that a plan may have, metres.
const MAX_SIDE: f64 = 200.0;

/// A wall by its centre line, before doors are cut out of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wall {
    pub(crate) start: Point2<f64>,
    pub(crate) end: Point2<f64>,
    pub(crate) thickness: f64,
}

/// An opening in the walls that pass through `centre`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Door {
    pub(crate) centre: Point2<f64>,
    pub(crate) width: f64,
}

impl FloorPlan {
    /// Reads a plan: one primitive a line, lengths in metres, angles in degrees, `#` comments.
    ///
    /// ```text
    /// size W H                        the frame, lower-left corner at (0, 0)
    /// wall X0 Y0 X1 Y1 THICKNESS      a wall by its centre line
    /// door X Y WIDTH                  an opening in every wall through (X, Y)
    /// box CX CY W H DEGREES           a piece of furniture
    /// route target|source X Y X Y …   way points; lines of one robot append
    /// ```
    ///
    /// # Errors
    /// A line that is none of these, a missing size or route, or a plan that equals itself turned
    /// by 90 or 180 degrees.
    pub fn parse(text: &str) -> Result<Self, SimError> {
        let mut size = None;
        let (mut walls, mut doors, mut solids) = (Vec::new(), Vec::new(), Vec::new());
        let (mut target, mut source) = (Vec::new(), Vec::new());
        let mut lines = 0;
        for (index, line) in text.lines().enumerate() {
            lines = index + 1;
            let syntax = |expected| SimError::PlanSyntax { line: index + 1, expected };
            let line = line.split('#').next().unwrap_or_default();
            let mut words = line.split_whitespace();
            match words.next() {
                None => {}
                Some("size") => {
                    let [w, h] = numbers(words)
                        .filter(|side: &[f64; 2]| side.iter().all(|&s| s > 0.0 && s <= MAX_SIDE))
                        .ok_or_else(|| syntax("size W H, each above 0 and at most 200"))?;
                    size = Some(Vector2::new(w, h));
                }
                Some("wall") => {
                    let [x0, y0, x1, y1, thickness] = numbers(words)
                        .filter(|&[x0, y0, x1, y1, t]: &[f64; 5]| t > 0.0 && (x0, y0) != (x1, y1))
                        .ok_or_else(|| syntax("wall X0 Y0 X1 Y1 THICKNESS, not of length 0"))?;
                    walls.push(Wall {
                        start: Point2::new(x0, y0),
                        end: Point2::new(x1, y1),
                        thickness,
                    });
                }
                Some("door") => {
                    let [x, y, width] = numbers(words)
                        .filter(|&[_, _, width]: &[f64; 3]| width > 0.0)
                        .ok_or_else(|| syntax("door X Y WIDTH"))?;
                    doors.push(Door { centre: Point2::new(x, y), width });
                }
                Some("box") => {
                    let [x, y, w, h, degrees] = numbers(words)
                        .filter(|&[_, _, w, h, _]: &[f64; 5]| w > 0.0 && h > 0.0)
                        .ok_or_else(|| syntax("box CX CY W H DEGREES"))?;
                    let (centre, size) = (Point2::new(x, y), Vector2::new(w, h));
                    solids.push(Solid::new(Kind::Furniture, centre, size, degrees.to_radians()));
                }
                Some("route") => {
                    let route = match words.next() {
                        Some("target") => &mut target,
                        Some("source") => &mut source,
                        _ => return Err(syntax("route target or route source")),
                    };
                    let points = way_points(words).ok_or_else(|| syntax("pairs X Y"))?;
                    route.extend(points);
                }
                Some(_) => return Err(syntax("size, wall, door, box or route")),
            }
        }
        let missing = |expected| SimError::PlanSyntax { line: lines, expected };
        let size = size.ok_or_else(|| missing("a line size W H before the end"))?;
        if target.len() < 2 || source.len() < 2 {
            return Err(missing("two way points for each robot before the end"));
        }
        solids.extend(cut(&walls, &doors));
        let plan = Self::new(size, solids, target, source);
        refuse_symmetric(&plan, 1.0)?;
        Ok(plan)
    }
}

/// Exactly `N` finite numbers of a size that a plan can have.
fn numbers<'a, const N: usize>(words: impl Iterator<Item = &'a str>) -> Option<[f64; N]> {
    let values: Vec<f64> = words.map(number).collect::<Option<_>>()?;
    values.try_into().ok()
}

fn number(word: &str) -> Option<f64> {
    let value: f64 = word.parse().ok()?;
    (value.abs() <= MAX_SIDE).then_some(value)
}

fn way_points<'a>(words: impl Iterator<Item = &'a str>) -> Option<Vec<Point2<f64>>> {
    let values: Vec<f64> = words.map(number).collect::<Option<_>>()?;
    let (pairs, rest) = values.as_chunks::<2>();
    rest.is_empty().then(|| pairs.iter().map(|&[x, y]| Point2::new(x, y)).collect())
}

/// The pieces of the walls that the doors leave.
pub(crate) fn cut(walls: &[Wall], doors: &[Door]) -> Vec<Solid> {
    let mut solids = Vec::new();
    for wall in walls {
        let along = wall.end - wall.start;
        let length = along.norm();
        let mut openings: Vec<[f64; 2]> = doors
            .iter()
            .filter_map(|door| {
                let offset = door.centre - wall.start;
                let (at, beside) = (offset.dot(&along) / length, offset.perp(&along) / length);
                let inside = beside.abs() <= wall.thickness / 2.0 && at >= 0.0 && at <= length;
                inside.then_some([at - door.width / 2.0, at + door.width / 2.0])
            })
            .collect();
        openings.sort_by(|a, b| a[0].total_cmp(&b[0]));
        openings.push([length, length]);
        let mut from = 0.0_f64;
        for [open, close] in openings {
            if open > from {
                let centre = wall.start + along * ((from + open) / 2.0 / length);
                let size = Vector2::new(open - from, wall.thickness);
                let angle = along.y.atan2(along.x);
                solids.push(Solid::new(Kind::Wall, centre, size, angle));
            }
            from = from.max(close);
        }
    }
    solids
}

#[cfg(test)]
mod tests {
    use crate::{FloorPlan, SOURCE, SimError};
    use nalgebra::Point2;

    const ROUTES: &str = "route target 1 1 2 2\nroute source 2 2\nroute source 1 1";

    #[test]
    fn a_door_is_a_hole_as_wide_as_it_says() {
        let text = format!("size 6 4\nwall 0 2 5 2 0.1\ndoor 2 2 0.8 # to the yard\n{ROUTES}");
        let plan = FloorPlan::parse(&text).unwrap();
        for (x, solid) in [(1.59, true), (1.61, false), (2.39, false), (2.41, true)] {
            assert_eq!(plan.is_solid(Point2::new(x, 2.0)), solid, "x = {x}");
        }
        assert_eq!(plan.route(SOURCE).unwrap(), [[2.0, 2.0].into(), [1.0, 1.0].into()]);
    }

    #[test]
    fn what_is_no_plan_says_where() {
        for (text, line) in [
            ("size 6 4\nwall 0 2 5 2\n", 2),
            ("size 6 4\nwall 1 1 1 1 0.1\n", 2),
            ("size nan 4\n", 1),
            ("size 6 4\n\nroof 1 1", 3),
            ("size 6 4\nroute target 1 1 2\n", 2),
            ("size 6 4\nbox 1 1 1 -1 0", 2),
            ("size 6 4\nbox 1 1 1 1e300 0", 2),
            (ROUTES, 3),
            ("", 0),
        ] {
            match FloorPlan::parse(text) {
                Err(SimError::PlanSyntax { line: found, .. }) => assert_eq!(found, line, "{text}"),
                other => panic!("{text}: {other:?}"),
            }
        }
    }
}
