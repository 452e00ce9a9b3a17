//! What a run will take, told before the work, and what there is.

use std::path::Path;
use std::str::FromStr;

use anyhow::bail;
use ogm_io::MapSize;
use ogm_merge::{aligning_bytes, bending_bytes, fusing_bytes};

/// A number of bytes as people write it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Bytes(pub(crate) u64);

impl FromStr for Bytes {
    type Err = &'static str;

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const FORM: &str = "write bytes, or a number with K, M, G or T, such as 800M or 1.5G";
        let text = text.trim().trim_end_matches(['b', 'B']).trim_end_matches(['i', 'I']);
        let split = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
        let (number, unit) = text.split_at(split);
        let shift = match unit.to_ascii_uppercase().as_str() {
            "" => 0,
            "K" => 10,
            "M" => 20,
            "G" => 30,
            "T" => 40,
            _ => return Err(FORM),
        };
        let bytes = number.trim().parse::<f64>().map_err(|_no_number| FORM)? * 2_f64.powi(shift);
        if (1.0..9e18).contains(&bytes) { Ok(Self(bytes as u64)) } else { Err(FORM) }
    }
}

/// What a command does with its maps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Work {
    /// Nothing but looking at them.
    Reading,
    /// Another grid as large as all together.
    Moving,
    /// A picture of them.
    Drawing,
    /// Searching a transform.
    Aligning,
    /// The same, and one map of them, of which a cell of the first map becomes so many; before that
    /// they may be made straight.
    Merging { refined: f64, bends: bool },
}

/// Refuses what `work` on maps of these sizes would take beyond the limit.
pub(crate) fn check(maps: &[MapSize], work: Work, most: Option<Bytes>) -> anyhow::Result<()> {
    let need = need(maps, work);
    let (limit, whose) = match (most, free()) {
        (Some(most), _) => (most.0, "--max-memory allows"),
        (None, Some((free, whose))) => (free, whose),
        (None, None) => return Ok(()),
    };
    if need <= limit {
        return Ok(());
    }
    let sizes: Vec<String> =
        maps.iter().map(|map| format!("{} x {}", map.width, map.height)).collect();
    bail!(
        "maps of {} cells need about {} of memory, and {whose} {}; crop them, save them at a \
         coarser resolution, or allow more",
        sizes.join(" and "),
        said(need),
        said(limit)
    )
}

fn need(maps: &[MapSize], work: Work) -> u64 {
    let cells = |maps: &[MapSize]| maps.iter().map(MapSize::cells).sum::<u64>();
    let reading = (0..maps.len()).map(|at| cells(&maps[..at]) + maps[at].reading_bytes).max();
    let all = cells(maps);
    let each: Vec<u64> = maps.iter().map(MapSize::cells).collect();
    let beyond = match work {
        Work::Reading => 0,
        // Turned by an eighth, a square needs twice its cells.
        Work::Moving => 2 * all,
        Work::Drawing => PICTURE_BYTES,
        Work::Aligning => aligning_bytes(&each),
        Work::Merging { refined, bends } => {
            let largest = each.iter().copied().max().unwrap_or(0);
            let bending = if bends { bending_bytes(&each) } else { 0 };
            aligning_bytes(&each).max(bending).max(fusing_bytes(largest, refined))
        }
    };
    reading.unwrap_or(0).max(all.saturating_add(beyond)).saturating_add(BASE_BYTES)
}

/// The program itself, its threads and what does not grow with the maps.
const BASE_BYTES: u64 = 24 << 20;
/// A picture, whatever the size of its maps.
const PICTURE_BYTES: u64 = 32 << 20;

fn said(bytes: u64) -> String {
    match bytes {
        0..0x4000_0000 => format!("{:.0} MiB", bytes as f64 / f64::from(1 << 20)),
        _ => format!("{:.2} GiB", bytes as f64 / f64::from(1 << 30)),
    }
}

/// The least of what the machine, the control groups and the limits of this process leave, and
/// which it is; nothing where the system does not say.
fn free() -> Option<(u64, &'static str)> {
    let machine = field("/proc/meminfo", "MemAvailable:").map(|kib| kib << 10);
    let process = field("/proc/self/limits", "Max address space");
    let groups = groups();
    [
        machine.map(|bytes| (bytes, "this machine has left")),
        groups.map(|bytes| (bytes, "its control group leaves")),
        process.map(|bytes| (bytes, "the limit of this process (ulimit -v) is")),
    ]
    .into_iter()
    .flatten()
    .min()
}

/// The first number behind `name` at the start of a line.
fn field(path: impl AsRef<Path>, name: &str) -> Option<u64> {
    let text = std::fs::read_to_string(path).ok()?;
    let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
    rest.split_whitespace().next()?.parse().ok()
}

/// What the tightest control group of this process leaves, of version 2 or 1; files that are only
/// cached do not count as used.
fn groups() -> Option<u64> {
    let own = std::fs::read_to_string("/proc/self/cgroup").ok()?;
    let mut least: Option<u64> = None;
    for line in own.lines() {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, path) = (parts.next()?, parts.next()?);
        let (root, most, used) = match controllers {
            "" => ("/sys/fs/cgroup", "memory.max", "memory.current"),
            joint if joint.split(',').any(|controller| controller == "memory") => {
                ("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes")
            }
            _ => continue,
        };
        // In a container the path may be one of the host; the root then is the container's own.
        for group in Path::new(path).ancestors().chain([Path::new("/")]) {
            let group = Path::new(root).join(group.strip_prefix("/").unwrap_or(group));
            let (Some(most), Some(used)) =
                (field(group.join(most), ""), field(group.join(used), ""))
            else {
                continue;
            };
            let stat = group.join("memory.stat");
            let cached = field(&stat, "inactive_file ").unwrap_or(0)
                + field(&stat, "active_file ").unwrap_or(0);
            let left = most.saturating_sub(used.saturating_sub(cached));
            least = Some(least.map_or(left, |least| least.min(left)));
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::{Bytes, Work, check, need};
    use ogm_io::MapSize;

    fn map(side: usize) -> MapSize {
        MapSize { width: side, height: side, reading_bytes: (side * side) as u64 }
    }

    #[test]
    fn bytes_are_read_as_people_write_them() {
        for (text, bytes) in
            [("1024", 1024), ("1K", 1024), ("1.5M", 3 << 19), ("2GiB", 2 << 30), ("1tb", 1 << 40)]
        {
            assert_eq!(text.parse(), Ok(Bytes(bytes)), "{text}");
        }
        for text in ["", "much", "-1", "1X", "nan", "inf", "1e40", "0"] {
            assert!(text.parse::<Bytes>().is_err(), "{text}");
        }
    }

    #[test]
    fn more_and_larger_maps_need_more() {
        let needs = [
            need(&[map(1000)], Work::Reading),
            need(&[map(1000)], Work::Moving),
            need(&[map(1000), map(1000)], Work::Aligning),
            need(&[map(2000), map(1000)], Work::Aligning),
            need(&[map(2000), map(1000)], Work::Merging { refined: 16.0, bends: false }),
        ];
        assert!(needs.is_sorted_by(|a, b| a < b), "{needs:?}");
    }

    #[test]
    fn a_refusal_says_both_numbers() {
        let maps = [map(20_000), map(20_000)];
        let error = check(&maps, Work::Aligning, Some(Bytes(1 << 30))).unwrap_err().to_string();
        for part in ["20000 x 20000", "1.00 GiB", "--max-memory"] {
            assert!(error.contains(part), "{error}");
        }
        check(&[map(100)], Work::Aligning, Some(Bytes(1 << 30))).unwrap();
    }
}
