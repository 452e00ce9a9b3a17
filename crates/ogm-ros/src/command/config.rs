//! What a parameter file and the flags come to.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, bail};
use ogm_core::Se2;
use ogm_merge::RobotPrior;
use ogm_ros::live::LiveParams;
use serde::Deserialize;

use super::args::MergingArgs;
use super::terminal;

/// How a run merges.
#[derive(Debug, Clone)]
pub(crate) struct Config {
    pub(crate) live: LiveParams,
    pub(crate) robot_map_topic: String,
    pub(crate) robot_namespace: String,
    pub(crate) merged_map_topic: String,
    pub(crate) merging_rate: Option<f64>,
}

/// The file: a node's name, or `/**`, over `ros__parameters`.
type File = BTreeMap<String, NodeParameters>;

#[derive(Debug, Deserialize)]
struct NodeParameters {
    #[serde(default, rename = "ros__parameters")]
    parameters: BTreeMap<String, Value>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Value {
    Bool(bool),
    Number(f64),
    Text(String),
}

impl Config {
    pub(crate) fn new(args: &MergingArgs) -> anyhow::Result<Self> {
        let mut config = Self {
            live: LiveParams::default(),
            robot_map_topic: "map".to_owned(),
            robot_namespace: String::new(),
            merged_map_topic: "/map".to_owned(),
            merging_rate: None,
        };
        if let Some(path) = &args.params {
            config.read(path).with_context(|| path.display().to_string())?;
        }
        let flags = [
            (&args.robot_map_topic, &mut config.robot_map_topic),
            (&args.robot_namespace, &mut config.robot_namespace),
            (&args.merged_map_topic, &mut config.merged_map_topic),
            (&args.world_frame, &mut config.live.world_frame),
        ];
        for (flag, value) in flags {
            if let Some(flag) = flag {
                value.clone_from(flag);
            }
        }
        let matching = &mut config.live.session.align.matching;
        matching.accept = args.accept.unwrap_or(matching.accept);
        let limits = &mut config.live.limits;
        limits.robots = args.max_robots.unwrap_or(limits.robots);
        limits.cells = args.max_cells.unwrap_or(limits.cells);
        let sigma = args.init_pose_sigma;
        for prior in config.live.priors.values_mut() {
            (prior.sigma_m, prior.sigma_rad) = (sigma.sigma_m, sigma.sigma_rad);
        }
        for pose in &args.init_pose {
            let prior = RobotPrior {
                world_from_map: pose.world_from_map,
                sigma_m: sigma.sigma_m,
                sigma_rad: sigma.sigma_rad,
            };
            config.live.priors.insert(pose.robot.clone(), prior);
        }
        if !config.merged_map_topic.starts_with('/') {
            config.merged_map_topic.insert(0, '/');
        }
        Ok(config)
    }

    fn read(&mut self, path: &Path) -> anyhow::Result<()> {
        let text = std::fs::read_to_string(path)?;
        let file: File = serde_saphyr::from_str(&text)?;
        let mut poses: BTreeMap<String, [f64; 3]> = BTreeMap::new();
        let mut are_known = true;
        for (key, value) in file.into_values().flat_map(|node| node.parameters) {
            match (key.as_str(), value) {
                ("robot_map_topic", Value::Text(text)) => self.robot_map_topic = text,
                ("robot_namespace", Value::Text(text)) => self.robot_namespace = text,
                ("merged_map_topic", Value::Text(text)) => self.merged_map_topic = text,
                ("world_frame", Value::Text(text)) => self.live.world_frame = text,
                ("merging_rate", Value::Number(rate)) => self.merging_rate = Some(rate),
                ("known_init_poses", Value::Bool(known)) => are_known = known,
                ("estimation_confidence", _) => terminal::warning(
                    "estimation_confidence is no probability and is not used; see --accept",
                ),
                ("discovery_rate" | "estimation_rate" | "robot_map_updates_topic", _) => {
                    terminal::warning(&format!("{key} is not needed and not used"));
                }
                (other, value) => match (pose_key(other), value) {
                    (Some((robot, Some(axis))), Value::Number(number)) => {
                        poses.entry(robot).or_default()[axis] = number;
                    }
                    (Some((_, None)), _) => {}
                    (_, value) => bail!("{key}: {value:?} is no parameter of this node"),
                },
            }
        }
        if are_known {
            for (robot, [x, y, yaw]) in poses {
                let world_from_map = Se2::new(x, y, yaw);
                let prior = RobotPrior { world_from_map, sigma_m: 0.0, sigma_rad: 0.0 };
                self.live.priors.insert(robot, prior);
            }
        }
        Ok(())
    }
}

/// The robot and the axis of `/robot1/map_merge/init_pose_x`; there is none for the height.
fn pose_key(key: &str) -> Option<(String, Option<usize>)> {
    let (robot, axis) = key.trim_start_matches('/').rsplit_once("/map_merge/init_pose_")?;
    let axis = match axis {
        "x" => Some(0),
        "y" => Some(1),
        "yaw" => Some(2),
        "z" => None,
        _ => return None,
    };
    Some((robot.to_owned(), axis))
}
