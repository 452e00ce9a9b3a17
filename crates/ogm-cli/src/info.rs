//! `ogm info`: what a map is and what is wrong with it.

use std::fmt::Write;

use ogm_core::{CellClass, ClassThresholds, OccupancyGrid, Se2};
use ogm_io::MapMode;
use ogm_merge::PoseDegrees;
use serde::Serialize;

use crate::answer::SCHEMA;
use crate::args::InfoArgs;
use crate::ending::Ending;
use crate::input::Input;
use crate::memory::Work;
use crate::progress::Wheel;
use crate::terminal;

#[derive(Debug, Serialize)]
struct Info {
    schema: u32,
    file: String,
    image: String,
    sha256: String,
    width: usize,
    height: usize,
    resolution_m: f64,
    origin: PoseDegrees,
    mode: &'static str,
    negate: bool,
    occupied_thresh: f64,
    free_thresh: f64,
    cells: Counts,
    known_area_m2: f64,
    warnings: Vec<String>,
}

#[derive(Debug, Default, Serialize)]
struct Counts {
    occupied: usize,
    free: usize,
    undecided: usize,
    unknown: usize,
}

pub(crate) fn run(args: &InfoArgs) -> anyhow::Result<Ending> {
    let input = {
        let _progress = Wheel::start("reading", false);
        args.reading.check_memory(&[&args.map], Work::Reading)?;
        Input::read_silently(&args.map, &args.reading)?
    };
    let info = Info::of(&input);
    let text = if args.json { serde_json::to_string_pretty(&info)? + "\n" } else { info.text() };
    terminal::result(&text)?;
    Ok(Ending::Done)
}

impl Info {
    fn of(input: &Input) -> Self {
        let (map, header) = (input.map(), &input.loaded.header);
        let resolution_m = map.frame().resolution();
        let cells = Counts::of(map);
        let known = cells.occupied + cells.free + cells.undecided;
        Self {
            schema: SCHEMA,
            file: input.name(),
            image: input.loaded.image.display().to_string(),
            sha256: input.sha256.clone(),
            width: map.width(),
            height: map.height(),
            resolution_m,
            origin: map.frame().map_from_grid().into(),
            mode: match header.mode {
                MapMode::Trinary => "trinary",
                MapMode::Scale => "scale",
                MapMode::Raw => "raw",
            },
            negate: header.negate,
            occupied_thresh: header.occupied_thresh,
            free_thresh: header.free_thresh,
            known_area_m2: known as f64 * resolution_m * resolution_m,
            cells,
            warnings: input.loaded.warnings.iter().map(ToString::to_string).collect(),
        }
    }

    fn text(&self) -> String {
        let Counts { occupied, free, undecided, unknown } = &self.cells;
        let [width_m, height_m] =
            [self.width, self.height].map(|cells| cells as f64 * self.resolution_m);
        let negated = if self.negate { ", negated" } else { "" };
        let mut text = format!(
            "{}\n  image: {}\n  sha256 of the image: {}\n  \
             size: {} x {} cells of {} m, {width_m:.2} x {height_m:.2} m\n  \
             origin: {}\n  \
             mode: {}{negated}, occupied above {}, free below {}\n  \
             cells: {occupied} occupied, {free} free, {undecided} undecided, {unknown} unknown\n  \
             known area: {:.2} m2\n",
            self.file,
            self.image,
            self.sha256,
            self.width,
            self.height,
            self.resolution_m,
            Se2::from(self.origin),
            self.mode,
            self.occupied_thresh,
            self.free_thresh,
            self.known_area_m2,
        );
        for warning in &self.warnings {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {}: {warning}", terminal::highlight("warning", "33"));
        }
        if self.warnings.is_empty() {
            text.push_str("  nothing suspicious\n");
        }
        text
    }
}

impl Counts {
    fn of(map: &OccupancyGrid) -> Self {
        let thresholds = ClassThresholds::default();
        let mut counts = Self::default();
        for &cell in map.cells().cells() {
            *match thresholds.classify(cell) {
                CellClass::Occupied => &mut counts.occupied,
                CellClass::Free => &mut counts.free,
                CellClass::Undecided => &mut counts.undecided,
                CellClass::Unknown => &mut counts.unknown,
            } += 1;
        }
        counts
    }
}
