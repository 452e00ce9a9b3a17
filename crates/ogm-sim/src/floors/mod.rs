//! Floors of many kinds, drawn at random.

mod bare;
mod clutter;
mod flat;
mod hall;
mod offices;
mod repeated;
mod ring;

use rand_chacha::ChaCha8Rng;

use crate::FloorPlan;
use crate::draft::Draft;
use crate::draw::{Stream, generator};

/// What kind of building a floor belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FloorKind {
    /// Rooms of many widths on both sides of a corridor, 14–34 m long.
    Offices,
    /// Rooms in rooms, 7–16 m.
    Flat,
    /// A hall with rows of shelves, pillars and a few rooms, 16–34 m.
    Hall,
    /// One room full of things that stand askew; walls have no common direction.
    Clutter,
    /// A corridor around a closed core, rooms outside of it, 20–34 m.
    Ring,
    /// Equal rooms along a corridor, some with something of their own inside.
    RepeatedRooms,
    /// Offices that turn into themselves by half a turn, but for a few pieces of furniture.
    HalfTurn,
    /// One room of 3–18 m a side with little in it, as the arena of a test or an empty hall.
    Bare,
}

impl FloorKind {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Offices,
        Self::Flat,
        Self::Hall,
        Self::Clutter,
        Self::Ring,
        Self::RepeatedRooms,
        Self::HalfTurn,
        Self::Bare,
    ];

    /// Whether parts of such a floor look like other parts, so that two maps may fit in several
    /// ways.
    #[must_use]
    pub fn repeats(self) -> bool {
        matches!(self, Self::RepeatedRooms | Self::HalfTurn)
    }

    /// A short name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Offices => "offices",
            Self::Flat => "flat",
            Self::Hall => "hall",
            Self::Clutter => "clutter",
            Self::Ring => "ring",
            Self::RepeatedRooms => "repeated rooms",
            Self::HalfTurn => "half turn",
            Self::Bare => "bare",
        }
    }

    /// A floor of this kind, without routes.
    #[must_use]
    pub(crate) fn draw(self, seed: u64) -> FloorPlan {
        let mut rng = generator(seed, Stream::Floor, self as u64);
        let draft: fn(&mut ChaCha8Rng) -> Draft = match self {
            Self::Offices => offices::draw,
            Self::Flat => flat::draw,
            Self::Hall => hall::draw,
            Self::Clutter => clutter::draw,
            Self::Ring => ring::draw,
            Self::RepeatedRooms => repeated::draw_rooms,
            Self::HalfTurn => repeated::draw_half_turn,
            Self::Bare => bare::draw,
        };
        draft(&mut rng).into_plan()
    }
}
