//! The robots that there are on the network, and what they send.

use std::collections::BTreeMap;

use ogm_io::ros::{OccupancyGridMessage, Time};
use ogm_ros::dds::{DdsError, Durability, Node, Subscription, Writer};
use ogm_ros::live::{Live, robot_of};
use ogm_ros::message::{OccupancyGridUpdate, PoseWithCovarianceStamped};

use super::config::Config;
use super::terminal;

/// The topics of one robot.
#[derive(Debug)]
struct Topics {
    map: Subscription,
    updates: Subscription,
    prior: Subscription,
}

/// All robots that were found.
#[derive(Debug, Default)]
pub(crate) struct Robots(BTreeMap<String, Topics>);

impl Robots {
    /// Listens to robots that were not there before.
    pub(crate) fn discover(&mut self, node: &Node, config: &Config) -> Result<(), DdsError> {
        let writers = node.writers();
        for writer in &writers {
            let is_map = writer.kind == OccupancyGridMessage::TYPE
                && writer.topic != config.merged_map_topic;
            let robot = robot_of(&writer.topic, &config.robot_map_topic).filter(|_| is_map);
            let Some(robot) = robot.filter(|robot| robot.contains(&config.robot_namespace)) else {
                continue;
            };
            // One more than are taken, so that the status can say so.
            if self.0.contains_key(robot) || self.0.len() > config.live.limits.robots {
                continue;
            }
            terminal::news(&format!("{robot}: found on {}", writer.topic));
            let topics = Topics::subscribe(node, robot, &writer.topic, &writers)?;
            self.0.insert(robot.to_owned(), topics);
        }
        Ok(())
    }

    /// Hands on what came.
    pub(crate) fn take(&mut self, live: &mut Live, now: Time) {
        for (robot, topics) in &mut self.0 {
            if let Some(map) = topics.map.take().pop() {
                live.put_map(robot, map, now);
            }
            for update in topics.updates.take() {
                live.put_update(robot, update, now);
            }
            for prior in topics.prior.take() {
                if let Err(error) = live.put_prior(robot, &prior) {
                    terminal::warning(&format!("{robot}: a prior is refused: {error}"));
                }
            }
        }
    }
}

impl Topics {
    fn subscribe(
        node: &Node,
        robot: &str,
        topic: &str,
        writers: &[Writer],
    ) -> Result<Self, DdsError> {
        let mut of_map = writers.iter().filter(|writer| writer.topic == topic);
        let is_latched = of_map.clone().all(|writer| writer.is_latched);
        let is_reliable = of_map.all(|writer| writer.is_reliable);
        let latched = if is_latched { Durability::TransientLocal } else { Durability::Volatile };
        let updates = format!("{topic}_updates");
        let prior = format!("/{robot}/ogm/prior");
        Ok(Self {
            map: node.subscribe(topic, OccupancyGridMessage::TYPE, latched, is_reliable, 1)?,
            updates: node.subscribe(
                &updates,
                OccupancyGridUpdate::TYPE,
                Durability::Volatile,
                false,
                64,
            )?,
            prior: node.subscribe(
                &prior,
                PoseWithCovarianceStamped::TYPE,
                Durability::Volatile,
                true,
                1,
            )?,
        })
    }
}
