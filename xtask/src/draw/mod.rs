//! Pictures for reports: charts and plans as SVG, maps and heat maps as PNG.

mod axes;
mod bars;
mod chart;
mod embed;
mod heat;
mod overlay;
mod palette;
mod plan;
mod raster;
mod svg;

pub(crate) use bars::{Bars, Histogram, bars, histogram};
pub(crate) use chart::{Chart, Mark, Series, chart};
pub(crate) use embed::png_data_uri;
pub(crate) use heat::{Heat, heat};
pub(crate) use overlay::overlay;
pub(crate) use plan::{Layer, Plan, plan};
pub(crate) use raster::{crop_known, enlarge, occupancy, png, side_by_side};
pub(crate) use svg::escape;
