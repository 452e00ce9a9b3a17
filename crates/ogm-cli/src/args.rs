//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use ogm_core::Se2;
use ogm_merge::{AlignParams, FusionRule, Method, TagMethod, WalkObjective};

use crate::pose::{Sigma, transform};
use crate::reading::ReadingArgs;

const EXIT_CODES: &str = "Exit codes:
  0  done; for align and merge: the maps match
  1  a file that cannot be read or written, or an invalid one
  2  a command line that cannot be meant
  3  ran, and refused to match the maps
  130  ended by Ctrl-C; nothing is written";

/// Aligns and merges the occupancy grid maps of robot teams, or says why not.
#[derive(Debug, Parser)]
#[command(name = "ogm", version, after_help = EXIT_CODES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Finds the transform between two maps
    Align(AlignArgs),
    /// Makes one map of several
    Merge(Box<MergeArgs>),
    /// Says what a map file holds, and what is wrong with it
    Info(InfoArgs),
    /// Writes a map as it looks in another frame
    Apply(ApplyArgs),
    /// Turns a map so that its walls lie along the axes
    Straighten(StraightenArgs),
    /// Draws a map, or two maps on each other
    View(ViewArgs),
}

#[derive(Debug, Args)]
pub(crate) struct AlignArgs {
    /// The map whose frame is kept
    #[arg(value_name = "A.yaml")]
    pub(crate) target: PathBuf,
    /// The map to be laid on it
    #[arg(value_name = "B.yaml")]
    pub(crate) source: PathBuf,
    #[command(flatten)]
    pub(crate) reading: ReadingArgs,
    #[command(flatten)]
    pub(crate) search: SearchArgs,
}

#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// The maps, or folders of maps; the frame of the first is kept
    #[arg(value_name = "MAP.yaml", required = true, num_args = 1..)]
    pub(crate) maps: Vec<PathBuf>,
    /// The merged map; its image goes beside it. OUT.mcap, in builds with bags, holds it on /map in
    /// frame world, and where the maps' frames lie there on /tf_static
    #[arg(short, long, value_name = "OUT.yaml")]
    pub(crate) output: PathBuf,
    /// Writes what was found and done as JSON
    #[arg(long, value_name = "R.json")]
    pub(crate) report: Option<PathBuf>,
    /// Draws the maps on each other: the first blue, the second orange, common walls black
    #[arg(long, value_name = "O.png")]
    pub(crate) overlay: Option<PathBuf>,
    /// Draws the merged map with the places where maps contradict each other in red
    #[arg(long, value_name = "C.png")]
    pub(crate) conflicts: Option<PathBuf>,
    /// Draws which map says what: walls in the colour of their map, black where several agree
    #[arg(long, value_name = "P.png")]
    pub(crate) provenance: Option<PathBuf>,
    /// Writes a page on what was found and done that needs no other file: a slider between the maps,
    /// conflicts, poses, verdicts
    #[arg(long, value_name = "REPORT.html")]
    pub(crate) html: Option<PathBuf>,
    /// A pose that is known, repeatable: maps points of that map into the frame of the merged map.
    /// Nothing is searched where every map but the first has one; the others are searched for
    #[arg(long = "transform", id = "transform", value_name = "MAP.yaml=X,Y,DEG")]
    pub(crate) transforms: Vec<String>,
    /// A folder of what `ogm align --json` found for pairs of these maps, which are not searched
    /// again; known by the maps' SHA-256
    #[arg(long, value_name = "DIR")]
    pub(crate) alignments: Option<PathBuf>,
    /// The map whose frame is kept [default: the first]
    #[arg(long, value_name = "MAP.yaml")]
    pub(crate) reference: Option<PathBuf>,
    /// What a cell becomes that several maps know
    #[arg(long, value_name = "RULE", value_enum, default_value_t)]
    pub(crate) fusion: Fusion,
    /// Whether maps that drift bent are made straight before they are fused: auto where walls that
    /// were held out say so, report only says how far they are bent. Poses stay what they are
    /// [default: auto; off with --transform, and for maps of over 16 777 216 cells]
    #[arg(long, value_name = "WHEN", value_enum)]
    pub(crate) bend: Option<BendArg>,
    /// Draws the straightened maps on each other, and how far each place was moved, enlarged
    #[arg(long, value_name = "B.png")]
    pub(crate) bend_picture: Option<PathBuf>,
    /// Metres a cell of the merged map [default: that of the first map]
    #[arg(long, value_name = "M", value_parser = metres)]
    pub(crate) resolution: Option<f64>,
    /// Names of the maps' frames in the ROS command that is printed and in a bag, in the order of the
    /// maps
    /// [default: robot1/map,robot2/map,…]
    #[arg(long, value_name = "NAME,NAME", value_delimiter = ',')]
    pub(crate) frames: Vec<String>,
    /// Writes the first map alone where the maps do not match; the exit code is still 3
    #[arg(long)]
    pub(crate) allow_partial: bool,
    /// Overwrites existing outputs; never an input
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) reading: ReadingArgs,
    #[command(flatten)]
    pub(crate) search: SearchArgs,
}

/// How the transform is looked for.
#[derive(Debug, Args)]
pub(crate) struct SearchArgs {
    /// How the transform is found; auto is rfid3 where three tags are known well enough in both
    /// maps, else match, which also stands in where rfid3 refuses
    #[arg(long, value_enum, default_value_t)]
    pub(crate) method: MethodArg,
    /// Tag readings of a map, repeatable; CSV with the header tag_id,robot_x_m,robot_y_m,range_m,
    /// robot positions in the frame of that map; a tag is a number or the 24 or 32 hexadecimal
    /// digits of an EPC
    #[arg(long, value_name = "MAP.yaml=TAGS.csv")]
    pub(crate) tags: Vec<String>,
    /// Longest range of the tag reader, metres; readings beyond it are left out
    #[arg(long, value_name = "M", default_value_t = 3.0, value_parser = metres)]
    pub(crate) tag_range: f64,
    /// Standard deviation of a range that the tag reader gives, metres
    #[arg(long, value_name = "M", default_value_t = 0.05, value_parser = metres)]
    pub(crate) tag_sigma: f64,
    /// A pose that is already believed: maps points of B, or of the map that is named, into the
    /// first map; repeatable with names (match and carpin only)
    #[arg(long = "prior", id = "prior", value_name = "[MAP.yaml=]X,Y,DEG")]
    #[arg(allow_hyphen_values = true, requires = "prior_sigma")]
    pub(crate) priors: Vec<String>,
    /// One standard deviation of the prior; the search is bounded at three
    #[arg(long, value_name = "M,DEG", allow_hyphen_values = true, requires = "prior")]
    pub(crate) prior_sigma: Option<Sigma>,
    /// Least probability of an accepted match (match only)
    #[arg(long, value_name = "P", default_value_t = 0.90, value_parser = probability)]
    pub(crate) accept: f64,
    /// The building is known to repeat itself, with equal rooms or mirrored halves: only what is
    /// beyond doubt is believed (match only)
    #[arg(long)]
    pub(crate) repeats: bool,
    /// What the random walk makes least (carpin only)
    #[arg(long, value_enum, default_value_t)]
    pub(crate) objective: ObjectiveArg,
    /// Seed of everything random
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Prints the result as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// No warnings and no progress
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct InfoArgs {
    /// The map
    #[arg(value_name = "MAP.yaml")]
    pub(crate) map: PathBuf,
    #[command(flatten)]
    pub(crate) reading: ReadingArgs,
    /// Prints the result as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ApplyArgs {
    /// The map
    #[arg(value_name = "B.yaml")]
    pub(crate) map: PathBuf,
    #[command(flatten)]
    pub(crate) reading: ReadingArgs,
    /// Maps points of the map into the frame that it is written in
    #[arg(long = "transform", value_name = "X,Y,DEG", allow_hyphen_values = true)]
    #[arg(value_parser = transform)]
    pub(crate) output_from_map: Se2,
    /// The moved map; its image goes beside it
    #[arg(short, long, value_name = "OUT.yaml")]
    pub(crate) output: PathBuf,
    /// Overwrites existing outputs; never an input
    #[arg(long)]
    pub(crate) force: bool,
    /// No warnings and no progress
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct StraightenArgs {
    /// The map
    #[arg(value_name = "MAP.yaml")]
    pub(crate) map: PathBuf,
    #[command(flatten)]
    pub(crate) reading: ReadingArgs,
    /// The turned map; its image goes beside it
    #[arg(short, long, value_name = "OUT.yaml")]
    pub(crate) output: PathBuf,
    /// Overwrites existing outputs; never an input
    #[arg(long)]
    pub(crate) force: bool,
    /// No warnings and no progress
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ViewArgs {
    /// The map
    #[arg(value_name = "A.yaml")]
    pub(crate) target: PathBuf,
    /// A map to draw on it: the first blue, this one orange, both black
    #[arg(value_name = "B.yaml", requires = "transform")]
    pub(crate) source: Option<PathBuf>,
    /// Maps points of B into A
    #[arg(
        long = "transform",
        id = "transform",
        value_name = "X,Y,DEG",
        allow_hyphen_values = true
    )]
    #[arg(requires = "source", value_parser = transform)]
    pub(crate) target_from_source: Option<Se2>,
    #[command(flatten)]
    pub(crate) reading: ReadingArgs,
    /// The picture
    #[arg(short, long, value_name = "OUT.png")]
    pub(crate) output: PathBuf,
    /// Overwrites an existing output; never an input
    #[arg(long)]
    pub(crate) force: bool,
    /// No warnings and no progress
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum MethodArg {
    /// By the tags if they suffice, else by the maps
    #[default]
    Auto,
    /// By the maps alone
    Match,
    /// By three tags
    Rfid1,
    /// By three tags, in the least-squares sense
    Rfid1b,
    /// Rotation by walls and tags, position by the surest tag
    Rfid2,
    /// As rfid2, then refined on the walls
    Rfid3,
    /// As rfid3, from two tags
    TwoTags,
    /// As rfid1b, then refined on the walls
    TagsIcp,
    /// By a random walk from --prior, or else from the maps' middles on each other
    Carpin,
    /// By wall segments that look alike, then the Radon transform
    Radon,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum ObjectiveArg {
    /// The distance of walls where both maps know
    #[default]
    Overlap,
    /// The picture distance of the paper, which draws maps together that overlap in part
    Picture,
}

impl From<ObjectiveArg> for WalkObjective {
    fn from(objective: ObjectiveArg) -> Self {
        match objective {
            ObjectiveArg::Overlap => AlignParams::default().walk_objective,
            ObjectiveArg::Picture => Self::Picture,
        }
    }
}

impl From<MethodArg> for Method {
    fn from(method: MethodArg) -> Self {
        match method {
            MethodArg::Auto => Self::Auto,
            MethodArg::Match => Self::Match,
            MethodArg::Rfid1 => Self::Tags(TagMethod::Rfid1),
            MethodArg::Rfid1b => Self::Tags(TagMethod::Rfid1b),
            MethodArg::Rfid2 => Self::Tags(TagMethod::Rfid2),
            MethodArg::Rfid3 => Self::Tags(TagMethod::Rfid3),
            MethodArg::TwoTags => Self::Tags(TagMethod::TwoTags),
            MethodArg::TagsIcp => Self::Tags(TagMethod::TagsIcp),
            MethodArg::Carpin => Self::Carpin,
            MethodArg::Radon => Self::Radon,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Fusion {
    /// No wall is lost: a wall beside another map's is the same wall, any other stays as a conflict
    #[default]
    KeepWalls,
    /// Sum of log-odds: the maps are independent evidence, cell by cell
    LogOdds,
    /// The map that is surest of the cell
    MaxConfidence,
    /// Occupied if any map says so
    Occupied,
    /// The first map that knows the cell
    First,
    /// The last map that knows the cell
    Last,
}

impl Fusion {
    /// As the command line calls it.
    pub(crate) fn name(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

impl From<Fusion> for FusionRule {
    fn from(fusion: Fusion) -> Self {
        match fusion {
            Fusion::KeepWalls => Self::KeepWalls,
            Fusion::LogOdds => Self::LogOdds,
            Fusion::MaxConfidence => Self::MaxConfidence,
            Fusion::Occupied => Self::Occupied,
            Fusion::First => Self::First,
            Fusion::Last => Self::Last,
        }
    }
}

/// Whether bent maps are made straight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum BendArg {
    /// Where held-out walls say that it is significantly better
    Auto,
    /// Never
    Off,
    /// Never, but says what auto would do
    Report,
}

fn probability(text: &str) -> Result<f64, String> {
    let in_range = |value: &f64| *value > 0.0 && *value <= 1.0;
    text.parse().ok().filter(in_range).ok_or("a number above 0 and at most 1".to_owned())
}

fn metres(text: &str) -> Result<f64, String> {
    let usable = |value: &f64| value.is_finite() && *value > 0.0;
    text.parse().ok().filter(usable).ok_or("a finite number of metres above 0".to_owned())
}
