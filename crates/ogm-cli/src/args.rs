//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use ogm_core::Se2;
use ogm_merge::{FusionRule, Method, TagMethod};

use crate::pose::{Sigma, transform};

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
    Merge(MergeArgs),
    /// Says what a map file holds, and what is wrong with it
    Info(InfoArgs),
    /// Writes a map as it looks in another frame
    Apply(ApplyArgs),
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
    pub(crate) search: SearchArgs,
}

#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// The maps, or folders of maps; the frame of the first is kept
    #[arg(value_name = "MAP.yaml", required = true, num_args = 1..)]
    pub(crate) maps: Vec<PathBuf>,
    /// The merged map; its image goes beside it
    #[arg(short, long, value_name = "OUT.yaml")]
    pub(crate) output: PathBuf,
    /// Writes what was found and done as JSON
    #[arg(long, value_name = "R.json")]
    pub(crate) report: Option<PathBuf>,
    /// Draws the maps on each other: the first blue, the second orange, common walls black
    #[arg(long, value_name = "O.png")]
    pub(crate) overlay: Option<PathBuf>,
    /// Of more than two maps, that whose frame is kept [default: the first]
    #[arg(long, value_name = "MAP.yaml")]
    pub(crate) reference: Option<PathBuf>,
    /// What a cell becomes that both maps know
    #[arg(long, value_name = "RULE", value_enum, default_value_t)]
    pub(crate) fusion: Fusion,
    /// Metres a cell of the merged map [default: that of the first map]
    #[arg(long, value_name = "M", value_parser = metres)]
    pub(crate) resolution: Option<f64>,
    /// Where not all maps match, writes those that hang together with the first; the exit code is
    /// still 3
    #[arg(long)]
    pub(crate) allow_partial: bool,
    /// Overwrites existing outputs; never an input
    #[arg(long)]
    pub(crate) force: bool,
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
    /// robot positions in the frame of that map
    #[arg(long, value_name = "MAP.yaml=TAGS.csv")]
    pub(crate) tags: Vec<String>,
    /// A transform that is already believed: maps points of B into A (match and carpin only)
    #[arg(long = "prior", id = "prior", value_name = "X,Y,DEG", allow_hyphen_values = true)]
    #[arg(requires = "prior_sigma", value_parser = transform)]
    pub(crate) prior_target_from_source: Option<Se2>,
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
    /// Prints the result as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ApplyArgs {
    /// The map
    #[arg(value_name = "B.yaml")]
    pub(crate) map: PathBuf,
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
    /// By a random walk from --prior, or else from the maps' middles on each other
    Carpin,
    /// By wall segments that look alike, then the Radon transform
    Radon,
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
            MethodArg::Carpin => Self::Carpin,
            MethodArg::Radon => Self::Radon,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Fusion {
    /// Sum of log-odds: the maps are independent evidence
    #[default]
    LogOdds,
    /// The map that is surest
    MaxConfidence,
    /// The first map that knows the cell
    First,
    /// The last map that knows the cell
    Last,
}

impl Fusion {
    pub(crate) fn rule(self) -> FusionRule {
        match self {
            Self::LogOdds => FusionRule::LogOddsSum,
            Self::MaxConfidence => FusionRule::MaxConfidence,
            Self::First => FusionRule::PreferFirst,
            Self::Last => FusionRule::Overwrite,
        }
    }
}

fn probability(text: &str) -> Result<f64, String> {
    let in_range = |value: &f64| *value > 0.0 && *value <= 1.0;
    text.parse().ok().filter(in_range).ok_or("a number above 0 and at most 1".to_owned())
}

fn metres(text: &str) -> Result<f64, String> {
    let usable = |value: &f64| value.is_finite() && *value > 0.0;
    text.parse().ok().filter(usable).ok_or("a finite number of metres above 0".to_owned())
}
