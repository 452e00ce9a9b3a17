//! `ogm-ros live`: the network on one side, the merging on the other.

use std::time::{Duration, Instant, SystemTime};

use anyhow::Context;
use ogm_io::ros::Time;
use ogm_ros::dds::{Durability, Node, Publication};
use ogm_ros::live::{LiveError, Message, Output};
use ogm_ros::message::Text;
use ogm_ros::recorder::Recorder;

use super::args::LiveArgs;
use super::config::Config;
use super::intake::Robots;
use super::state;
use super::stop::Stop;
use super::terminal;

/// Topic of orders.
const COMMAND: &str = "/ogm/command";
/// Merges a second, as multirobot_map_merge has it.
const RATE_HZ: f64 = 4.0;
/// How often new robots are looked for, and the state is written.
const DISCOVER_EVERY: Duration = Duration::from_millis(500);
const SAVE_EVERY: Duration = Duration::from_secs(10);
/// Share of the time of a merge that others get after it.
const REST: f64 = 0.1;

pub(crate) fn run(args: &LiveArgs) -> anyhow::Result<()> {
    let config = Config::new(&args.merging)?;
    let stop = Stop::on_signals()?;
    let rate = args.merging_rate.or(config.merging_rate).unwrap_or(RATE_HZ);
    let period = Duration::try_from_secs_f64(1.0 / rate).context("merging_rate is not above 0")?;
    let mut live = state::resume(args.state.as_deref(), config.live.clone(), &stop)?;
    let node = Node::new(args.domain)?;
    let outputs = Outputs::new(&node, &config.merged_map_topic)?;
    let mut recorder = match &args.record {
        Some(bag) => Some(Recorder::create(bag, &config.merged_map_topic)?),
        None => None,
    };
    let mut commands = node.subscribe(COMMAND, Text::TYPE, Durability::Volatile, true, 16)?;
    let mut robots = Robots::default();
    terminal::news(&format!(
        "listening on domain {} for /ROBOT/{}; merged map on {}",
        args.domain, config.robot_map_topic, config.merged_map_topic
    ));
    let mut due = Due::default();
    while !stop.is_asked() {
        let start = Instant::now();
        if due.discovery.is_none_or(|last| last.elapsed() >= DISCOVER_EVERY) {
            due.discovery = Some(start);
            robots.discover(&node, &config)?;
        }
        let now = now();
        robots.take(&mut live, now);
        for command in commands.take() {
            if let Err(error) = live.put_command(&command) {
                terminal::warning(&format!("an order is refused: {error}"));
            }
        }
        match live.step(now, &stop) {
            Ok(step) => {
                step.news.iter().for_each(|line| terminal::news(line));
                due.is_unsaved |= step.messages.iter().any(|it| it.output != Output::Status);
                for message in step.messages {
                    if let Some(recorder) = &mut recorder {
                        recorder.write(&message, now.nanoseconds())?;
                    }
                    outputs.send(message);
                }
            }
            Err(LiveError::Merge(error)) if error.is_cancelled() => break,
            Err(error) => return Err(error.into()),
        }
        if let Some(path) = &args.state
            && due.is_unsaved
            && due.save.is_none_or(|last| last.elapsed() >= SAVE_EVERY)
        {
            state::save(path, &live)?;
            (due.save, due.is_unsaved) = (Some(Instant::now()), false);
        }
        let took = start.elapsed();
        std::thread::sleep(period.saturating_sub(took).max(took.mul_f64(REST)));
    }
    if let Some(path) = &args.state {
        state::save(path, &live)?;
    }
    recorder.map_or(Ok(()), Recorder::finish)?;
    Ok(())
}

/// When things were done last.
#[derive(Debug, Default)]
struct Due {
    discovery: Option<Instant>,
    save: Option<Instant>,
    is_unsaved: bool,
}

/// The topics that are written.
#[derive(Debug)]
struct Outputs(Vec<(Output, Publication)>);

impl Outputs {
    fn new(node: &Node, merged_map: &str) -> anyhow::Result<Self> {
        let mut publications = Vec::new();
        for output in Output::ALL {
            let topic = output.topic(merged_map);
            let latched = Durability::TransientLocal;
            publications.push((output, node.publish(topic, output.kind(), latched, 1)?));
        }
        Ok(Self(publications))
    }

    fn send(&self, message: Message) {
        if let Some((_, publication)) = self.0.iter().find(|(output, _)| *output == message.output)
        {
            publication.send(message.bytes);
        }
    }
}

fn now() -> Time {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    Time::from_nanoseconds(u64::try_from(since.as_nanos()).unwrap_or(u64::MAX))
}
