//! Large samples at a rate that receivers keep up with.
//!
//! RustDDS hands all fragments of a sample to the kernel at once. A receiver on the same machine
//! with CycloneDDS's default buffer keeps one or two megabytes of such a burst; what it then asks for
//! again comes in repairs of 2 kB each 10 ms. So fragments that are not acknowledged are sent again
//! from here, spread over time, in the name of the same writer: receivers go by the writer's
//! identity, not by the socket that a datagram comes from.

#![expect(clippy::disallowed_methods, reason = "the edge to the network has a clock")]

use std::net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

use rustdds::SampleIdentity;

use super::error::DdsError;
use super::fragments::datagrams;

/// Bytes of data a datagram to this machine: as large as UDP takes.
const LOCAL_BYTES: usize = 60_000;
/// And to another, below what Ethernet carries in one piece.
const REMOTE_BYTES: usize = 1_280;

/// Bytes a second: half of what CycloneDDS took without loss on two busy cores.
const BYTES_A_SECOND: f64 = 40e6;
/// Bytes sent between two looks at the clock.
const BURST_BYTES: usize = 60_000;

/// Sends samples again.
#[derive(Debug)]
pub(super) struct Pacer {
    socket: UdpSocket,
}

impl Pacer {
    pub(super) fn new() -> Result<Self, DdsError> {
        let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0))
            .map_err(|cause| DdsError::System { what: "a UDP socket", cause })?;
        Ok(Self { socket })
    }

    /// Sends `sample` to each of `readers`; what does not get through, the next round brings.
    pub(super) fn send(
        &self,
        identity: SampleIdentity,
        sample: &[u8],
        readers: &[Vec<SocketAddr>],
    ) {
        for addresses in readers {
            let ipv4 = || addresses.iter().filter(|address| address.is_ipv4());
            let local = ipv4().find(|address| is_local(address.ip()));
            let most_bytes = if local.is_some() { LOCAL_BYTES } else { REMOTE_BYTES };
            if let Some(&address) = local.or_else(|| ipv4().next()) {
                self.send_to(identity, sample, address, most_bytes);
            }
        }
    }

    fn send_to(&self, identity: SampleIdentity, sample: &[u8], to: SocketAddr, most_bytes: usize) {
        let start = Instant::now();
        let (mut sent, mut unchecked) = (0, 0);
        for datagram in datagrams(identity, sample, most_bytes) {
            // An unreachable reader is the discovery's to notice.
            let _lost = self.socket.send_to(&datagram, to);
            unchecked += datagram.len();
            if unchecked >= BURST_BYTES {
                sent += unchecked;
                unchecked = 0;
                let due = start + Duration::from_secs_f64(sent as f64 / BYTES_A_SECOND);
                std::thread::sleep(due.saturating_duration_since(Instant::now()));
            }
        }
    }
}

/// Whether packets to `address` stay on this machine.
fn is_local(address: IpAddr) -> bool {
    address.is_loopback() || UdpSocket::bind((address, 0)).is_ok()
}
