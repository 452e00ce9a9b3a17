//! What merging ever larger teams costs: time and memory over the number of maps and of pairs.
//!
//! - `team_growth [--splice DOCUMENT]`: a process of its own for every row, on two threads; prints a
//!   table, and puts it into the document between its marks.
//! - `team_growth MAPS PARTNERS`: one row; of the pairs those that look alike from inside, so many a
//!   map, or all where PARTNERS is `all`.

use std::process::{Command, ExitCode};
use std::time::Instant;

use ogm_core::{Grid, GridFrame, Occupancy, OccupancyGrid, Se2};
use ogm_merge::{PairAlignment, PreparedMap, RobotMap, TeamParams, candidate_pairs, merge_team};
use ogm_sim::{FloorKind, labelled_team};

type Failure = Box<dyn std::error::Error>;

/// Cells of every map.
const SIZE: [usize; 2] = [700, 600];
/// Robots of one floor.
const ROBOTS: usize = 10;
const SEED: u64 = 9_300_000;
/// Maps, and partners of each.
const ROWS: [(usize, &str); 7] =
    [(10, "all"), (20, "all"), (30, "all"), (30, "8"), (60, "all"), (100, "all"), (100, "8")];
const BEGIN: &str = "<!-- BEGIN: growth -->";
const END: &str = "<!-- END: growth -->";

fn main() -> Result<ExitCode, Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [] => print(&table()?),
        ["--splice", document] => {
            let table = table()?;
            print(&table)?;
            splice(document, &table)
        }
        [maps, partners] => print(&row(maps.parse()?, partners.parse().ok())?),
        _ => Err("team_growth [--splice DOCUMENT | MAPS PARTNERS]".into()),
    }
}

fn table() -> Result<String, Failure> {
    let mut table =
        "| maps | partners a map | pairs searched | of all | components | largest | s | CPU s \
         | memory before, MB | at most, MB |\n"
            .to_owned();
    table += "| --: | --: | --: | --: | --: | --: | --: | --: | --: | --: |\n";
    for (maps, partners) in ROWS {
        let one = Command::new(std::env::current_exe()?)
            .args([&maps.to_string(), partners])
            .env("RAYON_NUM_THREADS", "2")
            .output()?;
        if !one.status.success() {
            return Err(String::from_utf8_lossy(&one.stderr).into());
        }
        table += &String::from_utf8(one.stdout)?;
    }
    Ok(table)
}

fn row(count: usize, partners: Option<usize>) -> Result<String, Failure> {
    let maps = maps(count)?;
    let robots: Vec<RobotMap<'_>> = maps.iter().map(RobotMap::from).collect();
    // The peak from here on.
    write_file("/proc/self/clear_refs", "5")?;
    let before_mb = memory_mb("VmRSS:")?;
    let (start, processor_start_s) = (now(), processor_s()?);
    let all = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    let mut params = TeamParams::default();
    if let Some(partners) = partners {
        let thresholds = params.align.matching.thresholds;
        let signature = |map| Ok(PreparedMap::new(map, &thresholds, &())?.signature());
        let signatures: Vec<_> = maps.iter().map(signature).collect::<Result<_, Failure>>()?;
        let likely = candidate_pairs(&signatures, partners);
        let others = all.clone().filter(|pair| likely.binary_search(pair).is_err());
        let silent = |(target, source)| PairAlignment { target, source, hypotheses: Vec::new() };
        params.alignments = others.map(silent).collect();
    }
    let searched = all.count() - params.alignments.len();
    let report = merge_team(&robots, &params, &())?;
    let (seconds, processor) = (start.elapsed().as_secs_f64(), processor_s()? - processor_start_s);
    let largest = report.components.iter().map(|part| part.members.len()).max().unwrap_or(0);
    Ok(format!(
        "| {count} | {} | {searched} | {} | {} | {largest} | {seconds:.1} | {processor:.1} \
         | {before_mb:.0} | {:.0} |\n",
        partners.map_or("all".to_owned(), |partners| partners.to_string()),
        count * (count - 1) / 2,
        report.components.len(),
        memory_mb("VmHWM:")?,
    ))
}

/// Maps of floors with ten robots each, all of one size.
fn maps(count: usize) -> Result<Vec<OccupancyGrid>, Failure> {
    // Kinds that are large enough, one after the other.
    let kinds = [FloorKind::Offices, FloorKind::Ring, FloorKind::Hall];
    let mut maps = Vec::new();
    for (seed, kind) in (SEED..).zip(kinds.into_iter().cycle()) {
        if maps.len() >= count {
            break;
        }
        // Some floors have places that no robot reaches.
        let Ok(team) = labelled_team(kind, ROBOTS, false, seed) else { continue };
        for map in team.maps {
            maps.push(resized(&map)?);
        }
    }
    maps.truncate(count);
    Ok(maps)
}

/// The map on [`SIZE`] cells: cut, or with unknown around it, its middle in the middle.
fn resized(map: &OccupancyGrid) -> Result<OccupancyGrid, Failure> {
    let [width, height] = SIZE;
    let low = |size: usize, of: usize| (of as isize - size as isize) / 2;
    let (left, bottom) = (low(width, map.width()), low(height, map.height()));
    let mut cells = vec![Occupancy::UNKNOWN; width * height];
    for (index, cell) in cells.iter_mut().enumerate() {
        let [x, y] = [(index % width) as isize + left, (index / width) as isize + bottom];
        if let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y))
            && x < map.width()
            && y < map.height()
        {
            *cell = map.cells().row(y)[x];
        }
    }
    let resolution = map.frame().resolution();
    let grid_from_cut = Se2::new(left as f64 * resolution, bottom as f64 * resolution, 0.0);
    let map_from_grid = map.frame().map_from_grid() * grid_from_cut;
    let frame = GridFrame::new(resolution, map_from_grid)?;
    Ok(OccupancyGrid::new(frame, Grid::new(width, height, cells)?))
}

fn splice(document: &str, table: &str) -> Result<ExitCode, Failure> {
    let text = read_file(document)?;
    let (before, rest) = text.split_once(BEGIN).ok_or("the document has no marks")?;
    let (_, after) = rest.split_once(END).ok_or("the document has no second mark")?;
    let command = "cargo run --release -p ogm-bench --example team_growth -- --splice";
    write_file(
        document,
        &format!("{before}{BEGIN}\n\nWritten by `{command} {document}`:\n\n{table}\n{END}{after}"),
    )?;
    Ok(ExitCode::SUCCESS)
}

/// A line of what Linux says about the memory of this process.
fn memory_mb(name: &str) -> Result<f64, Failure> {
    let status = read_file("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix(name)).ok_or("no such line")?;
    let kilobytes: f64 = line.trim().trim_end_matches("kB").trim().parse()?;
    Ok(kilobytes / 1024.0)
}

/// Seconds on a processor of all threads, which Linux counts in hundredths.
fn processor_s() -> Result<f64, Failure> {
    let stat = read_file("/proc/self/stat")?;
    // The name of the program may hold anything but ends with the last bracket.
    let (_, fields) = stat.rsplit_once(')').ok_or("no fields")?;
    let ticks = fields.split_ascii_whitespace().skip(11).take(2).map(str::parse::<f64>);
    Ok(ticks.sum::<Result<f64, _>>()? / 100.0)
}

#[expect(clippy::disallowed_methods, reason = "it measures time")]
fn now() -> Instant {
    Instant::now()
}

#[expect(clippy::disallowed_methods, reason = "an example of files")]
fn read_file(path: &str) -> Result<String, Failure> {
    Ok(std::fs::read_to_string(path)?)
}

#[expect(clippy::disallowed_methods, reason = "an example of files")]
fn write_file(path: &str, text: &str) -> Result<(), Failure> {
    Ok(std::fs::write(path, text)?)
}

fn print(text: &str) -> Result<ExitCode, Failure> {
    use std::io::Write;
    std::io::stdout().write_all(text.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}
