//! What was found about maps, and what was made of them.

use numpy::PyArray2;
use ogm_merge::TeamReport;
use pyo3::prelude::{Bound, Py, PyResult, Python, pyclass, pymethods};
use pyo3::types::PyBytes;

use crate::alignment::Alignment;
use crate::component::Component;
use crate::error::MapError;
use crate::map::Map;
use crate::transform::Transform;

/// What was found about maps, and what was made of them.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Merge {
    pub(crate) components: Vec<Py<Component>>,
    pub(crate) pairs: Vec<Py<Pair>>,
    /// Without the pairs, which are above.
    pub(crate) team: Option<TeamReport>,
}

/// Two of the maps that were merged.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug)]
pub(crate) struct Pair {
    /// Which map is the target, from 0.
    #[pyo3(get)]
    pub(crate) target: usize,
    /// Which map is the source.
    #[pyo3(get)]
    pub(crate) source: usize,
    /// What the two maps say by themselves; `None` where both poses were given.
    #[pyo3(get)]
    pub(crate) alignment: Option<Py<Alignment>>,
    /// Where the merge puts the source in the target; `None` if they do not hang together.
    #[pyo3(get)]
    pub(crate) transform: Option<Transform>,
}

#[pymethods]
impl Pair {
    fn __repr__(&self) -> String {
        let (target, source) = (self.target, self.source);
        let together = if self.transform.is_some() { "together" } else { "apart" };
        format!("Pair({target}, {source}, {together})")
    }
}

impl Merge {
    /// The component of all maps, if they hang together.
    fn whole(&self) -> Option<&Component> {
        let [whole] = &self.components[..] else { return None };
        Some(whole.get())
    }
}

#[pymethods]
impl Merge {
    /// Maps that hang together, that of the first map first; a map that could not be placed is
    /// alone.
    #[getter]
    fn components(&self, py: Python<'_>) -> Vec<Py<Component>> {
        self.components.iter().map(|component| component.clone_ref(py)).collect()
    }

    /// The pairs that were searched.
    #[getter]
    fn pairs(&self, py: Python<'_>) -> Vec<Py<Pair>> {
        self.pairs.iter().map(|pair| pair.clone_ref(py)).collect()
    }

    /// All maps as one; `None` unless they hang together.
    #[getter]
    fn map(&self, py: Python<'_>) -> Option<Py<Map>> {
        self.whole().map(|whole| whole.map(py))
    }

    /// Cells of `map` where one map says wall and another says free; `None` without it.
    #[getter]
    fn conflicts(&self, py: Python<'_>) -> Option<Py<PyArray2<bool>>> {
        self.whole().map(|whole| whole.conflicts(py))
    }

    /// Which maps are apart, and why; `None` where all hang together.
    #[getter]
    fn reason(&self) -> Option<String> {
        if self.whole().is_some() {
            return None;
        }
        if let [pair] = &self.pairs[..]
            && let Some(alignment) = &pair.get().alignment
        {
            return alignment.get().reason();
        }
        let groups = self.components.iter().map(|component| component.get().members());
        let groups: Vec<String> = groups.map(|members| format!("{members:?}")).collect();
        Some(format!("these do not hang together: {}", groups.join(", ")))
    }

    /// What joined groups of maps, in the order in which it did; of more than two maps.
    #[getter]
    fn joins(&self) -> Vec<Join> {
        let joins = self.team.iter().flat_map(|team| &team.joins);
        joins.cloned().map(Join).collect()
    }

    /// Maps that hold the same cells in the same place as another: (copy, original).
    #[getter]
    fn copies(&self) -> Vec<(usize, usize)> {
        self.team.iter().flat_map(|team| team.copies.iter().copied()).collect()
    }

    /// Probability that maps `a` and `b` lie as their component says; 1 for a map and its copy.
    /// `None` for maps that do not hang together, or that a method without a probability put
    /// together.
    fn probability(&self, a: usize, b: usize) -> PyResult<Option<f64>> {
        let maps: usize =
            self.components.iter().map(|component| component.get().members().len()).sum();
        if let Some(map) = [a, b].into_iter().find(|&map| map >= maps) {
            return Err(MapError::new_err(format!("there is no map {map} of {maps}")));
        }
        if a == b {
            return Ok(Some(1.0));
        }
        Ok(match (&self.team, &self.pairs[..]) {
            (Some(team), _) => team.probability(a, b),
            (None, [pair]) => pair.get().transform.and_then(|_| {
                pair.get().alignment.as_ref().and_then(|alignment| alignment.get().probability())
            }),
            _ => None,
        })
    }

    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        self.whole().map(|whole| whole._repr_png_(py)).transpose()
    }

    fn __bool__(&self) -> bool {
        self.whole().is_some()
    }

    fn __repr__(&self) -> String {
        let members = self.components.iter().map(|component| component.get().members());
        format!("Merge(components={:?})", members.collect::<Vec<_>>())
    }
}

/// Two groups of maps that became one.
#[pyclass(frozen, module = "ogm_maps")]
#[derive(Debug, Clone)]
pub(crate) struct Join(ogm_merge::Join);

#[pymethods]
impl Join {
    /// The maps of one group, ascending.
    #[getter]
    fn first(&self) -> Vec<usize> {
        self.0.first.clone()
    }

    /// The maps of the other.
    #[getter]
    fn second(&self) -> Vec<usize> {
        self.0.second.clone()
    }

    /// Probability that they lie on each other as they were joined.
    #[getter]
    fn probability(&self) -> f64 {
        self.0.probability
    }

    /// Log-odds of that, by what all of their walls say together.
    #[getter]
    fn score(&self) -> f64 {
        self.0.score
    }

    fn __repr__(&self) -> String {
        let ogm_merge::Join { first, second, probability, .. } = &self.0;
        format!("Join({first:?}, {second:?}, probability={probability:.3})")
    }
}
