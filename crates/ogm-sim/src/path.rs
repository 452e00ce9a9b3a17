//! Way points become the path of a robot.

use nalgebra::{Point2, Vector2};

/// A smooth path through `way_points`, a point every `step` metres along it.
///
/// Centripetal Catmull-Rom spans; a span that `is_clear` forbids somewhere is replaced by the
/// straight line between its way points.
///
/// # Errors
/// The first point that is not clear on a straight line either.
pub(crate) fn smooth(
    way_points: &[Point2<f64>],
    step: f64,
    is_clear: impl Fn(Point2<f64>) -> bool,
) -> Result<Vec<Point2<f64>>, Point2<f64>> {
    let mut points = way_points.to_vec();
    points.dedup_by(|a, b| (*a - *b).norm() < 1e-3);
    let mut dense = Vec::new();
    for (index, ends) in points.windows(2).enumerate() {
        let [from, to] = [ends[0], ends[1]];
        let before = if index > 0 { points[index - 1] } else { from + (from - to) };
        let after = points.get(index + 2).copied().unwrap_or(to + (to - from));
        let start = dense.len();
        dense.extend(span([before, from, to, after], step));
        if let Some(blocked) = first_blocked(&dense[start..], &is_clear) {
            dense.truncate(start);
            dense.extend(line(from, to, step));
            if first_blocked(&dense[start..], &is_clear).is_some() {
                return Err(blocked);
            }
        }
    }
    dense.extend(points.last());
    Ok(resample(&dense, step))
}

fn first_blocked(
    points: &[Point2<f64>],
    is_clear: impl Fn(Point2<f64>) -> bool,
) -> Option<Point2<f64>> {
    points.iter().copied().find(|&point| !is_clear(point))
}

/// Share `i / n` for `n` pieces of at most half a step over `length`.
fn shares(length: f64, step: f64) -> impl Iterator<Item = f64> {
    let pieces = (2.0 * length / step).ceil().max(1.0);
    (0_u32..).map(move |i| f64::from(i) / pieces).take_while(|&share| share < 1.0)
}

fn line(from: Point2<f64>, to: Point2<f64>, step: f64) -> impl Iterator<Item = Point2<f64>> {
    shares((to - from).norm(), step).map(move |share| from + (to - from) * share)
}

/// The span from `p1` to `p2` by the pyramid of Barry and Goldman (1988), without its end.
fn span([p0, p1, p2, p3]: [Point2<f64>; 4], step: f64) -> impl Iterator<Item = Point2<f64>> {
    let knot = |t: f64, a: Point2<f64>, b: Point2<f64>| t + (b - a).norm().sqrt();
    let t0 = 0.0;
    let t1 = knot(t0, p0, p1);
    let t2 = knot(t1, p1, p2);
    let t3 = knot(t2, p2, p3);
    let mix = |a: Point2<f64>, b: Point2<f64>, from: f64, to: f64, t: f64| {
        a + (b - a) * ((t - from) / (to - from))
    };
    // A curve is at most this much longer than its chord in practice; only the sampling depends
    // on it, and that is made even afterwards.
    shares(1.5 * (p2 - p1).norm(), step).map(move |share| {
        let t = t1 + (t2 - t1) * share;
        let [a, b, c] = [mix(p0, p1, t0, t1, t), mix(p1, p2, t1, t2, t), mix(p2, p3, t2, t3, t)];
        mix(mix(a, b, t0, t2, t), mix(b, c, t1, t3, t), t1, t2, t)
    })
}

/// Points every `step` metres along the polyline, from its start; the last one may be short of
/// its end.
fn resample(dense: &[Point2<f64>], step: f64) -> Vec<Point2<f64>> {
    let mut path: Vec<Point2<f64>> = dense.first().copied().into_iter().collect();
    let mut until_next = step;
    for ends in dense.windows(2) {
        let along = ends[1] - ends[0];
        let length = along.norm();
        let mut at = until_next;
        while at <= length {
            path.push(ends[0] + along * (at / length));
            at += step;
        }
        until_next = at - length;
    }
    path
}

/// The direction of travel at every point of a path, radians.
pub(crate) fn headings(path: &[Point2<f64>]) -> Vec<f64> {
    (0..path.len())
        .map(|index| {
            let before = path[index.saturating_sub(1)];
            let after = path[(index + 1).min(path.len() - 1)];
            let along: Vector2<f64> = after - before;
            along.y.atan2(along.x)
        })
        .collect()
}

/// Metres along a path.
#[cfg(test)]
pub(crate) fn length(path: &[Point2<f64>]) -> f64 {
    path.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum()
}

#[cfg(test)]
mod tests {
    use super::{headings, length, smooth};
    use nalgebra::Point2;

    fn corner() -> Vec<Point2<f64>> {
        [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [4.0, 2.0]].map(Point2::from).to_vec()
    }

    #[test]
    fn a_path_passes_its_way_points_in_even_steps_and_turns_smoothly() {
        let path = smooth(&corner(), 0.03, |_| true).unwrap();
        for point in corner() {
            let nearest = path.iter().map(|p| (p - point).norm()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.03, "{point} is {nearest} m off the path");
        }
        let steps = path.windows(2).map(|ends| (ends[1] - ends[0]).norm());
        assert!(steps.into_iter().all(|step| (0.0295..=0.0300001).contains(&step)));
        let turns = headings(&path).windows(2).map(|h| (h[1] - h[0]).abs()).fold(0.0, f64::max);
        assert!(turns < 0.15, "{turns} rad in one step");
    }

    #[test]
    fn where_the_curve_is_blocked_the_straight_line_is_taken() {
        let outside = |p: Point2<f64>| p.y >= -1e-9 && p.y <= 2.0 + 1e-9;
        let path = smooth(&corner(), 0.03, outside).unwrap();
        assert!(path.iter().all(|&p| outside(p)));
        assert!(length(&path) > 5.8, "{} m", length(&path));

        let wall = |p: Point2<f64>| (p.x - 1.0).abs() > 0.1;
        let blocked = smooth(&corner(), 0.03, wall).unwrap_err();
        assert!(!wall(blocked));
    }
}
