//! How far maps were bent, and what is fused in their place.

use std::fmt::Write;
use std::path::Path;

use ogm_core::Progress;
use ogm_merge::{
    BendParams, BendReport, BentComponent, BentMap, Component, MOST_BENT_CELLS, unbend_component,
};
use serde::Serialize;

use crate::args::{BendArg, MergeArgs};
use crate::drawn;
use crate::input::Input;

/// Whether maps of these numbers of cells are made straight.
pub(crate) fn when(args: &MergeArgs, cells: &[u64]) -> BendArg {
    let is_small = cells.iter().all(|&cells| cells <= MOST_BENT_CELLS);
    let default = if args.transforms.is_empty() && is_small { BendArg::Auto } else { BendArg::Off };
    args.bend.unwrap_or(default)
}

/// What became of the bends of a component.
#[derive(Debug)]
pub(crate) struct Straightened {
    /// The component as it is fused.
    pub(crate) component: Component,
    pub(crate) answers: Vec<BendAnswer>,
    /// Its maps made straight on each other, where that is to be drawn.
    pub(crate) picture: Option<Vec<u8>>,
}

impl Straightened {
    /// Makes the maps of `component` straight if `when` says so: then they take the place of what
    /// they were in `inputs`, for there may be no memory for both and the fused map. The file at
    /// `picture` is only named.
    pub(crate) fn of(
        inputs: &mut [Input],
        component: &Component,
        when: BendArg,
        picture: Option<&Path>,
        progress: &dyn Progress,
    ) -> anyhow::Result<Self> {
        let bent = match when {
            BendArg::Off => BentComponent { component: component.clone(), maps: Vec::new() },
            BendArg::Auto | BendArg::Report => {
                let maps: Vec<_> = inputs.iter().map(Input::map).collect();
                unbend_component(&maps, component, &BendParams::default(), progress)?
            }
        };
        let picture = picture.map(|path| drawn::bend(path, inputs, &bent)).transpose()?;
        let is_applied = when == BendArg::Auto;
        let answer = |bent: &BentMap| {
            BendAnswer::new(bent.map, &bent.report, is_applied && bent.straight.is_some())
        };
        let answers = bent.maps.iter().map(answer).collect();
        if !is_applied {
            return Ok(Self { component: component.clone(), answers, picture });
        }
        for bent in bent.maps {
            if let Some(straight) = bent.straight {
                inputs[bent.map].loaded.map = straight;
            }
        }
        Ok(Self { component: bent.component, answers, picture })
    }
}

/// How far a map is bent, as the JSON says it.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct BendAnswer {
    /// Which map, from 0.
    map: usize,
    /// Whether the map was made straight before it was fused.
    applied: bool,
    /// Whether walls that were held out say that it is bent.
    significant: bool,
    /// By how many standard scores.
    score: f64,
    /// How badly they lie after it, of how badly before.
    loss_left: f64,
    rms_m: f64,
    max_m: f64,
    /// Where it moves most, in the frame of the map.
    x_m: f64,
    y_m: f64,
    /// Standard deviation of where a wall lies after it.
    sigma_m: f64,
    patches: usize,
    contradicted: usize,
}

impl BendAnswer {
    fn new(map: usize, report: &BendReport, applied: bool) -> Self {
        Self {
            map,
            applied,
            significant: report.is_borne_out,
            score: report.score,
            loss_left: report.loss_left,
            rms_m: report.rms_m,
            max_m: report.max_m,
            x_m: report.at.x,
            y_m: report.at.y,
            sigma_m: report.sigma_m,
            patches: report.patches,
            contradicted: report.contradicted,
        }
    }
}

/// How far maps are bent, for people; of maps that are not, only where that was asked for.
pub(crate) fn said(answers: &[BendAnswer], inputs: &[Input], args: &MergeArgs) -> String {
    let asked = args.bend == Some(BendArg::Report);
    let mut said = String::new();
    let is_large =
        |input: &Input| (input.map().width() * input.map().height()) as u64 > MOST_BENT_CELLS;
    if args.bend.is_none() && args.transforms.is_empty() && inputs.iter().any(is_large) {
        said += "  maps of this size are not looked at for bends unasked: --bend auto does\n";
    }
    for answer in answers {
        let name = inputs[answer.map].name();
        let BendAnswer { rms_m, max_m, x_m, y_m, score, .. } = answer;
        let by = format!(
            "by {rms_m:.2} m rms, at most {max_m:.2} m at ({x_m:.2}, {y_m:.2}) in its own frame"
        );
        // Writing to a string cannot fail.
        let _ = match (answer.applied, answer.significant) {
            (true, _) => writeln!(said, "  {name} was bent and is made straight: {by}"),
            (false, true) => writeln!(said, "  {name} is bent {by}; left as it is"),
            (false, false) if asked => writeln!(
                said,
                "  {name} is not bent by what held-out walls say ({score:.1} standard scores)"
            ),
            _ => Ok(()),
        };
    }
    said
}
