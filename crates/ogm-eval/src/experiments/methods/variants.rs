//! The rows of X4: each method in its forms, corrected and as printed.

use icp2d::{IcpParams, Metric, Pairing};
use nalgebra::Point2;
use ogm_core::OccupancyGrid;
use ogm_merge::{Anchor, RfidParams, TagMethod};
use rfid_loc::{RotationCentre, TagFrame, TagOnlyParams, TagOnlyRotation, TagOnlyTranslation};

use super::record::{CROPPED_1, LITERAL, PRINTED_1, TWO_TAGS};
use crate::cases::worlds::World;

/// A row of the table: a method in one of its forms.
pub(super) struct Variant {
    pub(super) name: &'static str,
    pub(super) method: TagMethod,
    pub(super) params: fn(&World) -> RfidParams,
}

/// How many of the variants, from the front, are methods as the command has them.
pub(super) const METHODS: usize = 6;

/// How many, from the front, run on every world: the methods, and what #1, #2 and #3 would have
/// answered unguarded.
pub(super) const ON_ALL_WORLDS: usize = METHODS + 3;

/// The methods first.
pub(super) const VARIANTS: [Variant; 23] = [
    Variant { name: "#1", method: TagMethod::Rfid1, params: |_| RfidParams::default() },
    Variant { name: "#2", method: TagMethod::Rfid2, params: |_| RfidParams::default() },
    Variant { name: "#3", method: TagMethod::Rfid3, params: |_| RfidParams::default() },
    Variant { name: "#1b", method: TagMethod::Rfid1b, params: |_| RfidParams::default() },
    Variant { name: TWO_TAGS, method: TagMethod::TwoTags, params: |_| RfidParams::default() },
    Variant { name: "#1b + ICP", method: TagMethod::TagsIcp, params: |_| RfidParams::default() },
    Variant { name: "#1 unguarded", method: TagMethod::Rfid1, params: |_| RfidParams::unguarded() },
    Variant { name: "#2 unguarded", method: TagMethod::Rfid2, params: |_| RfidParams::unguarded() },
    Variant { name: "#3 unguarded", method: TagMethod::Rfid3, params: |_| RfidParams::unguarded() },
    Variant { name: PRINTED_1, method: TagMethod::Rfid1, params: |_| RfidParams::paper() },
    Variant { name: "#2 paper()", method: TagMethod::Rfid2, params: |_| RfidParams::paper() },
    Variant { name: LITERAL, method: TagMethod::Rfid3, params: |_| RfidParams::paper() },
    Variant {
        name: "#1 with tags 1 and 2",
        method: TagMethod::Rfid1,
        params: |_| tag_only(TagOnlyParams { rotation: TagOnlyRotation::P2, ..Default::default() }),
    },
    Variant {
        name: "#1 rotation as printed",
        method: TagMethod::Rfid1,
        params: |_| {
            tag_only(TagOnlyParams { rotation: TagOnlyRotation::AsPrinted, ..Default::default() })
        },
    },
    Variant {
        name: "#1 translation as printed",
        method: TagMethod::Rfid1,
        params: |_| {
            tag_only(TagOnlyParams {
                translation: TagOnlyTranslation::AsPrinted,
                ..Default::default()
            })
        },
    },
    Variant {
        name: "#1 translation by unrotated centroids, sign repaired",
        method: TagMethod::Rfid1,
        params: |_| {
            tag_only(TagOnlyParams {
                translation: TagOnlyTranslation::SignFixed,
                ..Default::default()
            })
        },
    },
    Variant {
        name: CROPPED_1,
        method: TagMethod::Rfid1,
        params: |world| {
            tag_only(TagOnlyParams {
                translation: TagOnlyTranslation::SignFixed,
                frame: TagFrame::Cropped {
                    target_corner: corner(&world.pair.target.map),
                    source_corner: corner(&world.pair.source.map),
                },
                centre: RotationCentre::At(image_centre(&world.pair.source.map)),
                ..Default::default()
            })
        },
    },
    Variant {
        name: "#2 printed weights",
        method: TagMethod::Rfid2,
        params: |_| RfidParams {
            vector: ogm_vector::Params {
                weights: ogm_vector::Weights::AsPrinted,
                ..Default::default()
            },
            ..RfidParams::unguarded()
        },
    },
    Variant {
        name: "#2 all three tags carry the translation",
        method: TagMethod::Rfid2,
        params: |_| RfidParams { anchor: Anchor::AllTags, ..RfidParams::unguarded() },
    },
    Variant {
        name: "#3 from where #2 ends",
        method: TagMethod::Rfid3,
        params: |_| icp(IcpParams::default()),
    },
    Variant {
        name: "#3 point to point",
        method: TagMethod::Rfid3,
        params: |_| icp(IcpParams { metric: Metric::PointToPoint, ..Default::default() }),
    },
    Variant {
        name: "#3 reciprocal only",
        method: TagMethod::Rfid3,
        params: |_| icp(IcpParams { pairing: Pairing::Reciprocal, ..Default::default() }),
    },
    Variant {
        name: "#3 one-way, gate to 5 px",
        method: TagMethod::Rfid3,
        params: |_| icp(IcpParams { pairing: Pairing::OneWay, ..Default::default() }),
    },
];

/// The names of the methods.
pub(super) fn methods() -> [&'static str; METHODS] {
    std::array::from_fn(|index| VARIANTS[index].name)
}

/// A printed form of #1; what it gives is not asked about.
fn tag_only(tag_only: TagOnlyParams) -> RfidParams {
    RfidParams { tag_only, ..RfidParams::unguarded() }
}

/// Refinement from where #2 ends, as the paper has it.
fn icp(icp: IcpParams) -> RfidParams {
    RfidParams { icp, start: None, ..Default::default() }
}

fn corner(map: &OccupancyGrid) -> Point2<f64> {
    map.frame().point_from_cells(Point2::origin())
}

fn image_centre(map: &OccupancyGrid) -> Point2<f64> {
    let half = Point2::new(map.width() as f64 / 2.0, map.height() as f64 / 2.0);
    map.frame().point_from_cells(half)
}
