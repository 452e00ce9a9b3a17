//! `ogm-ros replay`: the live merging over a bag.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use anyhow::Context;
use ogm_core::Progress;
use ogm_io::read_bag;
use ogm_io::ros::{OccupancyGridMessage, Time};
use ogm_ros::live::{Live, robot_of};
use ogm_ros::message::OccupancyGridUpdate;
use ogm_ros::recorder::Recorder;

use super::args::ReplayArgs;
use super::config::Config;
use super::stop::Stop;
use super::terminal;

pub(crate) fn run(args: &ReplayArgs) -> anyhow::Result<()> {
    let config = Config::new(&args.merging)?;
    let stop = Stop::on_signals()?;
    let mut live = Live::new(config.live.clone())?;
    let mut recorder = Recorder::create(&args.output, &config.merged_map_topic)?;
    let updates = format!("{}_updates", config.robot_map_topic);
    let robot_on = |topic: &str, kind: &str| -> Option<(String, bool)> {
        let is_update = kind == OccupancyGridUpdate::TYPE;
        let is_map = kind == OccupancyGridMessage::TYPE && topic != config.merged_map_topic;
        let name = if is_update { &updates } else { &config.robot_map_topic };
        let robot = robot_of(topic, name).filter(|_| is_map || is_update)?;
        let is_ours = robot.contains(&config.robot_namespace);
        is_ours.then(|| (robot.to_owned(), is_update))
    };
    let mut failed = None;
    let mut pace = Pace { factor: args.pace, began: None };
    read_bag(&args.bag, &|topic, kind| robot_on(topic, kind).is_some(), &mut |message| {
        let Some((robot, is_update)) = robot_on(&message.topic, &message.kind) else {
            return ControlFlow::Continue(());
        };
        pace.wait(message.log_time_ns, &stop);
        let now = Time::from_nanoseconds(message.log_time_ns);
        if is_update {
            live.put_update(&robot, message.data, now);
        } else {
            live.put_map(&robot, message.data, now);
        }
        match merge(&mut live, &mut recorder, now, &stop) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                failed = Some(error);
                ControlFlow::Break(())
            }
        }
    })?;
    recorder.finish()?;
    if stop.is_asked() {
        terminal::warning("stopped before the end of the bag");
    }
    match failed {
        Some(error) if !stop.is_asked() => Err(error),
        _ => Ok(()),
    }
}

fn merge(
    live: &mut Live,
    recorder: &mut Recorder,
    now: Time,
    progress: &dyn Progress,
) -> anyhow::Result<()> {
    loop {
        let step = live.step(now, progress)?;
        step.news.iter().for_each(|line| terminal::news(line));
        for message in &step.messages {
            recorder.write(message, now.nanoseconds()).context("the bag cannot be written on")?;
        }
        if !live.is_waiting() {
            return Ok(());
        }
    }
}

/// How fast the bag goes by.
struct Pace {
    factor: Option<f64>,
    /// When the first message was played, and its time.
    began: Option<(Instant, u64)>,
}

impl Pace {
    fn wait(&mut self, time_ns: u64, stop: &Stop) {
        let Some(factor) = self.factor.filter(|factor| *factor > 0.0) else {
            return;
        };
        let (began, first_ns) = *self.began.get_or_insert_with(|| (Instant::now(), time_ns));
        let after = Duration::from_nanos(time_ns.saturating_sub(first_ns)).div_f64(factor);
        while let Some(left) = after.checked_sub(began.elapsed())
            && !stop.is_asked()
        {
            std::thread::sleep(left.min(Duration::from_millis(100)));
        }
    }
}
