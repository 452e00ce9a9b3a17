//! One topic that is written, by a thread of its own.

#![expect(clippy::disallowed_methods, reason = "the edge to the network has a clock")]

use std::collections::VecDeque;
use std::net::SocketAddr;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rustdds::bytes::Bytes;
use rustdds::no_key::DataWriter;
use rustdds::{DomainParticipant, RTPSEntity, SampleIdentity, WriteOptionsBuilder};

use super::error::DdsError;
use super::pacing::Pacer;
use super::raw::{AsIs, Raw};

/// Samples below this arrive in one burst.
const LARGE_BYTES: usize = 256 * 1024;
/// How long receivers have to say that all is there.
const ACKNOWLEDGED_WITHIN: Duration = Duration::from_millis(60);
/// How often who comes late is looked for.
const LOOK_EVERY: Duration = Duration::from_millis(250);
/// How often samples are sent again before new readers come: what does not get through then has
/// another reason.
const MOST_ROUNDS: u32 = 12;
/// RustDDS lets go of old samples every 4 s, and without readers keeps a few for ever; whoever comes
/// late waits for them too.
const KEPT_BY_DDS: Duration = Duration::from_secs(5);
const KEPT_FOR_EVER: usize = 4;

/// A topic to publish on; dropped, it is no longer offered.
#[derive(Debug)]
pub struct Publication {
    queue: Arc<Queue>,
    thread: Option<JoinHandle<()>>,
}

impl Publication {
    pub(super) fn start(
        participant: DomainParticipant,
        topic: String,
        writer: DataWriter<Raw, AsIs>,
        depth: usize,
    ) -> Result<Self, DdsError> {
        let queue = Arc::new(Queue { state: Mutex::default(), changed: Condvar::new(), depth });
        let name = format!("dds {topic}");
        let pacer = Pacer::new()?;
        let sending = Sending {
            participant,
            topic,
            writer,
            pacer,
            sent: VecDeque::new(),
            reached: Reached::default(),
            pending: None,
        };
        let shared = Arc::clone(&queue);
        let thread = std::thread::Builder::new()
            .name(name)
            .spawn(move || sending.run(&shared))
            .map_err(|cause| DdsError::System { what: "a thread", cause })?;
        Ok(Self { queue, thread: Some(thread) })
    }

    /// Sends a message, its header included, as soon as those before it are gone; where more wait
    /// than the topic keeps, the oldest is left out.
    pub fn send(&self, message: Vec<u8>) {
        let mut state = self.queue.lock();
        state.waiting.push_back(message.into());
        while state.waiting.len() > self.queue.depth {
            state.waiting.pop_front();
        }
        self.queue.changed.notify_all();
    }
}

impl Drop for Publication {
    fn drop(&mut self) {
        self.queue.lock().is_over = true;
        self.queue.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            // What it panicked of, it has printed.
            let _panicked = thread.join();
        }
    }
}

#[derive(Debug)]
struct Queue {
    state: Mutex<State>,
    changed: Condvar,
    depth: usize,
}

#[derive(Debug, Default)]
struct State {
    waiting: VecDeque<Bytes>,
    is_over: bool,
}

impl Queue {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next message; `Some(None)` if none came `within` that time, `None` when all is over.
    fn next(&self, within: Duration) -> Option<Option<Bytes>> {
        let waiting = |state: &mut State| state.waiting.is_empty() && !state.is_over;
        let (mut state, _) = self
            .changed
            .wait_timeout_while(self.lock(), within, waiting)
            .unwrap_or_else(PoisonError::into_inner);
        let message = state.waiting.pop_front();
        (message.is_some() || !state.is_over).then_some(message)
    }
}

/// What the thread owns.
struct Sending {
    participant: DomainParticipant,
    topic: String,
    writer: DataWriter<Raw, AsIs>,
    pacer: Pacer,
    /// Large samples that someone may still ask for, oldest first.
    sent: VecDeque<Sent>,
    reached: Reached,
    /// For which there was no room.
    pending: Option<Bytes>,
}

/// A large sample.
struct Sent {
    identity: SampleIdentity,
    message: Bytes,
    at: Instant,
}

/// Whom the samples have reached.
#[derive(Default)]
struct Reached {
    readers: Vec<[u8; 16]>,
    /// How many of `sent` all of them have.
    samples: usize,
    /// How often the others were sent again.
    rounds: u32,
}

impl Sending {
    fn run(mut self, queue: &Queue) {
        let mut is_behind = false;
        loop {
            let has_work = is_behind || self.pending.is_some();
            let within = if has_work { Duration::ZERO } else { LOOK_EVERY };
            let Some(message) = queue.next(within) else {
                return;
            };
            if let Some(message) = message.or_else(|| self.pending.take()) {
                self.write(message);
            }
            is_behind = self.repeat();
        }
    }

    fn write(&mut self, message: Bytes) {
        let options = WriteOptionsBuilder::new().build();
        // It waits for a while if readers lack too many of those before.
        match self.writer.write_with_options(Raw(message.clone()), options) {
            Ok(identity) => {
                self.pending = None;
                if message.len() >= LARGE_BYTES {
                    self.sent.push_back(Sent { identity, message, at: Instant::now() });
                    self.reached.rounds = 0;
                }
            }
            Err(_no_room) => self.pending = Some(message),
        }
        while self.sent.len() > KEPT_FOR_EVER && self.sent[0].at.elapsed() > KEPT_BY_DDS {
            self.sent.pop_front();
            self.reached.samples = self.reached.samples.saturating_sub(1);
        }
    }

    /// Sends large samples again to readers that lack them; whether that may have to be done again.
    fn repeat(&mut self) -> bool {
        if self.sent.is_empty() {
            return false;
        }
        let is_there = self.writer.wait_for_acknowledgments(ACKNOWLEDGED_WITHIN);
        if is_there.unwrap_or(true) {
            self.reached.samples = self.sent.len();
            return false;
        }
        let (readers, addresses): (Vec<[u8; 16]>, Vec<Vec<SocketAddr>>) = self
            .participant
            .discovered_readers()
            .into_iter()
            .filter(|reader| reader.subscription_topic_data.topic_name == self.topic)
            .map(|reader| reader.reader_proxy)
            .map(|reader| {
                let locators = reader.unicast_locator_list.into_iter();
                (reader.remote_reader_guid.to_bytes(), locators.map(SocketAddr::from).collect())
            })
            .unzip();
        if readers != self.reached.readers {
            self.reached = Reached { readers, ..Reached::default() };
        }
        if self.reached.rounds < MOST_ROUNDS {
            self.reached.rounds += 1;
            for sent in self.sent.iter().skip(self.reached.samples) {
                self.pacer.send(sent.identity, &sent.message, &addresses);
            }
        }
        self.reached.rounds < MOST_ROUNDS
    }
}

impl std::fmt::Debug for Sending {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Sending").field("writer", &self.writer.guid()).finish_non_exhaustive()
    }
}
