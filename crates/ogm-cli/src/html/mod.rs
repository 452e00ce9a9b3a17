//! The report of a merge as one page that needs nothing else.

mod page;

use anyhow::Context;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use ogm_merge::{Component, Merged};
use ogm_view::{ViewError, wall_colour};

use crate::input::Input;
use crate::merged::MergeAnswer;

/// What the pictures of the page show.
pub(crate) struct Shown<'a> {
    /// The maps of the merged one, and that.
    pub(crate) made: Option<(&'a Component, &'a Merged)>,
    /// Two maps on each other, where nothing was made of them.
    pub(crate) overlay: Option<Vec<u8>>,
}

/// The page.
pub(crate) fn report(
    answer: &MergeAnswer,
    inputs: &[Input],
    shown: &Shown<'_>,
) -> anyhow::Result<String> {
    let mut pictures = page::Pictures {
        overlay: shown.overlay.as_deref().map(data_url),
        ..page::Pictures::default()
    };
    if let Some((component, merged)) = shown.made {
        let drawn = component.members.iter().map(|member| {
            let colour = wall_colour(member.map);
            let map = inputs[member.map].map();
            ogm_view::seen_on(&merged.map, map, member.reference_from_map, colour)
                .and_then(|picture| ogm_view::png(&picture))
                .map(|png| (member.map, data_url(&png)))
        });
        pictures.layers =
            drawn.collect::<Result<_, ViewError>>().context("cannot draw the maps")?;
        let marked = ogm_view::marked(&merged.map, merged.conflicts.iter())
            .map_err(ViewError::from)
            .and_then(|picture| ogm_view::png(&picture))
            .context("cannot draw the merged map")?;
        pictures.merged = Some(data_url(&marked));
    }
    Ok(page::page(answer, &pictures))
}

fn data_url(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", BASE64_STANDARD.encode(png))
}
