//! ICP on two lists of points in files, timed: the half of `peers/icp.py` that is ours.
//!
//! Arguments: the target and the source, one `x y` a line in metres, and how often to repeat. Prints
//! JSON: the least seconds of all, and of the alignment with a kept index, and where it ended.

use std::time::Instant;

use icp2d::{IcpParams, Pairing, Target, WallPoints, align_points, align_to};
use nalgebra::Point2;
use ogm_core::Se2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [target, source, repeats] = &arguments[..] else {
        return Err("TARGET SOURCE REPEATS".into());
    };
    let (target, source) = (read(target)?, read(source)?);
    // As the peer: nearest points within a metre, without looking back.
    let params = IcpParams { pairing: Pairing::OneWay, ..IcpParams::default() };
    let kept = Target::new(WallPoints::from_positions(&target)?);
    let walls = WallPoints::from_positions(&source)?;
    let (mut all, mut kept_index) = (f64::INFINITY, f64::INFINITY);
    let mut ended = None;
    for _ in 0..repeats.parse::<usize>()? {
        let start = now();
        ended = align_points(&target, &source, Se2::identity(), &params)?.found();
        all = all.min(start.elapsed().as_secs_f64());
        let start = now();
        let again = align_to(&kept, &walls, Se2::identity(), &params)?;
        kept_index = kept_index.min(start.elapsed().as_secs_f64());
        assert!(again.found().is_some(), "the same points align");
    }
    let ended = ended.ok_or("the points do not align")?;
    let pose = ended.target_from_source;
    let (x, y, theta) = (pose.x(), pose.y(), pose.theta());
    let iterations = ended.iterations;
    write(&format!(
        "{{\"all_s\": {all}, \"kept_index_s\": {kept_index}, \"iterations\": {iterations}, \
         \"x\": {x}, \"y\": {y}, \"theta\": {theta}}}\n"
    ))
}

#[expect(clippy::disallowed_methods, reason = "it measures time")]
fn now() -> Instant {
    Instant::now()
}

#[expect(clippy::disallowed_methods, reason = "it reads what the peer wrote")]
fn read(path: &str) -> Result<Vec<Point2<f64>>, Box<dyn std::error::Error>> {
    let point = |line: &str| -> Result<Point2<f64>, Box<dyn std::error::Error>> {
        let (x, y) = line.split_once(' ').ok_or("a line is `x y`")?;
        Ok(Point2::new(x.parse()?, y.parse()?))
    };
    std::fs::read_to_string(path)?.lines().map(point).collect()
}

fn write(text: &str) -> Result<(), Box<dyn std::error::Error>> {
    use std::io::Write;
    Ok(std::io::stdout().write_all(text.as_bytes())?)
}
