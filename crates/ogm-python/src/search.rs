//! What a caller may say about how a transform is looked for.

use ogm_core::TagEstimate;
use ogm_merge::{AlignParams, MatchParams, Method, Prior};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::{Bound, PyAny, PyResult};

use crate::error::MapError;
use crate::transform::pose;

/// How a transform is looked for.
#[derive(Debug, Clone)]
pub(crate) struct Search {
    pub(crate) method: Method,
    pub(crate) params: AlignParams,
}

impl Search {
    pub(crate) fn new(
        method: &str,
        accept: Option<f64>,
        repeats: bool,
        seed: u64,
    ) -> PyResult<Self> {
        let named = Method::ALL.into_iter().find(|known| known.name() == method);
        let method = named.ok_or_else(|| {
            let known = Method::ALL.map(Method::name).join(", ");
            MapError::new_err(format!("no method is called {method:?}; there are {known}"))
        })?;
        let mut matching = MatchParams { repeats, ..MatchParams::default() };
        if let Some(accept) = accept {
            if !(accept > 0.0 && accept <= 1.0) {
                let text = format!("accept must be above 0 and at most 1, got {accept}");
                return Err(MapError::new_err(text));
            }
            matching.accept = accept;
        }
        let params = AlignParams { seed, matching, ..AlignParams::default() };
        Ok(Self { method, params })
    }

    /// From a pose that is already believed, `sigma` being its standard deviations in metres and
    /// radians.
    pub(crate) fn starting_at(
        mut self,
        prior: Option<&Bound<'_, PyAny>>,
        sigma: Option<(f64, f64)>,
    ) -> PyResult<Self> {
        self.params.prior = match (prior, sigma) {
            (None, None) => return Ok(self),
            (Some(prior), Some((sigma_m, sigma_rad))) => {
                Some(Prior { target_from_source: pose(prior)?, sigma_m, sigma_rad })
            }
            _ => {
                let text = "prior and prior_sigma, (metres, radians), go together";
                return Err(PyTypeError::new_err(text));
            }
        };
        if !self.method.takes_prior() {
            let text = format!("the method {} takes no prior", self.method.name());
            return Err(MapError::new_err(text));
        }
        Ok(self)
    }

    /// Whether the method has the tags that it needs.
    pub(crate) fn check_tags(&self, tags: &[Vec<TagEstimate>]) -> PyResult<()> {
        if self.method.needs_tags() && tags.iter().any(Vec::is_empty) {
            let name = self.method.name();
            let text = format!("the method {name} needs tags of both maps: tags=(of_a, of_b)");
            return Err(MapError::new_err(text));
        }
        Ok(())
    }
}
