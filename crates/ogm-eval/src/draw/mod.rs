//! Pictures for reports: charts and plans as SVG, heat maps as PNG; maps are drawn by `ogm-view`.

mod axes;
mod bars;
mod chart;
mod embed;
mod heat;
mod palette;
mod plan;
mod svg;

pub(crate) use bars::{Bars, Histogram, bars, histogram};
pub(crate) use chart::{Chart, Mark, Series, chart};
pub(crate) use embed::png_data_uri;
pub(crate) use heat::{Heat, heat};
pub(crate) use plan::{Layer, Plan, plan};
pub(crate) use svg::escape;
