//! `ogm-ros record`: what `live` publishes, into a bag.

use std::time::{Duration, SystemTime};

use ogm_ros::dds::{Durability, Node, Subscription};
use ogm_ros::live::{Message, Output};
use ogm_ros::recorder::Recorder;

use super::args::RecordArgs;
use super::stop::Stop;
use super::terminal;

const LOOK_EVERY: Duration = Duration::from_millis(20);

pub(crate) fn run(args: &RecordArgs) -> anyhow::Result<()> {
    let stop = Stop::on_signals()?;
    let node = Node::new(args.domain)?;
    let mut topics: Vec<(Output, Subscription)> = Vec::new();
    for output in Output::ALL {
        let topic = output.topic(&args.merged_map_topic);
        let latched = Durability::TransientLocal;
        topics.push((output, node.subscribe(topic, output.kind(), latched, true, 16)?));
    }
    let mut recorder = Recorder::create(&args.output, &args.merged_map_topic)?;
    terminal::news(&format!("recording {}", args.output.display()));
    while !stop.is_asked() {
        for (output, topic) in &mut topics {
            for bytes in topic.take() {
                recorder.write(&Message { output: *output, bytes }, now_ns())?;
            }
        }
        std::thread::sleep(LOOK_EVERY);
    }
    Ok(recorder.finish()?)
}

fn now_ns() -> u64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    u64::try_from(since.as_nanos()).unwrap_or(u64::MAX)
}
