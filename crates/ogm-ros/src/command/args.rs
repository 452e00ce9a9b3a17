//! The command line.

use std::path::PathBuf;

use clap::{Args as Group, Parser, Subcommand};

use super::pose::{InitPose, Sigma};

/// Merges the maps of a running ROS 2 robot team, without a ROS installation.
#[derive(Debug, Parser)]
#[command(version)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) verb: Verb,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    /// Merges the maps that robots publish, and publishes the merged one
    Live(LiveArgs),
    /// Merges the maps of a bag as if they came now
    Replay(ReplayArgs),
    /// Writes what `live` publishes into a bag
    Record(RecordArgs),
}

/// How maps are found and merged.
#[derive(Debug, Group)]
pub(crate) struct MergingArgs {
    /// A ROS 2 parameter file, as of multirobot_map_merge; flags count more
    #[arg(long, value_name = "YAML")]
    pub(crate) params: Option<PathBuf>,
    /// What the robots' map topics end in: /ROBOT/map [default: map]
    #[arg(long, value_name = "NAME")]
    pub(crate) robot_map_topic: Option<String>,
    /// Only robots whose names have this in them
    #[arg(long, value_name = "TEXT")]
    pub(crate) robot_namespace: Option<String>,
    /// The topic of the merged map [default: /map]
    #[arg(long, value_name = "TOPIC")]
    pub(crate) merged_map_topic: Option<String>,
    /// The frame of the merged map [default: world]
    #[arg(long, value_name = "FRAME")]
    pub(crate) world_frame: Option<String>,
    /// Where the map frame of a robot lies in the world, repeatable: metres and degrees
    #[arg(long, value_name = "ROBOT=X,Y,DEG")]
    pub(crate) init_pose: Vec<InitPose>,
    /// Standard deviation of these poses; 0,0 is exact: nothing is searched and nothing doubted
    #[arg(long, value_name = "M,DEG", default_value = "0,0")]
    pub(crate) init_pose_sigma: Sigma,
    /// Probability that a merge must reach [default: 0.999]
    #[arg(long, value_name = "P")]
    pub(crate) accept: Option<f64>,
    /// Most robots that are listened to [default: 16]
    #[arg(long, value_name = "N")]
    pub(crate) max_robots: Option<usize>,
    /// Most cells that a map may have [default: 36000000]
    #[arg(long, value_name = "N")]
    pub(crate) max_cells: Option<usize>,
}

#[derive(Debug, Group)]
pub(crate) struct LiveArgs {
    #[command(flatten)]
    pub(crate) merging: MergingArgs,
    /// Most merges a second; fewer where the machine needs longer [default: 4]
    #[arg(long, value_name = "HZ")]
    pub(crate) merging_rate: Option<f64>,
    /// Where the state is kept, to go on after a restart
    #[arg(long, value_name = "FILE")]
    pub(crate) state: Option<PathBuf>,
    /// Also writes all that is published into this bag, NAME.mcap or a folder
    #[arg(long, value_name = "BAG")]
    pub(crate) record: Option<PathBuf>,
    /// The DDS domain
    #[arg(long, env = "ROS_DOMAIN_ID", value_name = "N", default_value_t = 0)]
    pub(crate) domain: u16,
}

#[derive(Debug, Group)]
pub(crate) struct ReplayArgs {
    /// The bag: an .mcap or .db3 file, or the folder of one
    pub(crate) bag: PathBuf,
    #[command(flatten)]
    pub(crate) merging: MergingArgs,
    /// Where the merged map and the transforms go, NAME.mcap or a folder
    #[arg(short, long, value_name = "BAG")]
    pub(crate) output: PathBuf,
    /// How many times as fast as it was recorded [default: as fast as it can]
    #[arg(long, value_name = "FACTOR")]
    pub(crate) pace: Option<f64>,
}

#[derive(Debug, Group)]
pub(crate) struct RecordArgs {
    /// The bag, NAME.mcap or a folder
    #[arg(short, long, value_name = "BAG")]
    pub(crate) output: PathBuf,
    /// The topic of the merged map
    #[arg(long, value_name = "TOPIC", default_value = "/map")]
    pub(crate) merged_map_topic: String,
    /// The DDS domain
    #[arg(long, env = "ROS_DOMAIN_ID", value_name = "N", default_value_t = 0)]
    pub(crate) domain: u16,
}
