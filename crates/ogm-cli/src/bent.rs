//! How far maps were bent, and what is fused in their place.

use std::fmt::Write;

use ogm_core::{OccupancyGrid, Progress};
use ogm_merge::{BendParams, BendReport, BentComponent, Component, unbend_component};
use serde::Serialize;

use crate::args::{BendArg, MergeArgs};
use crate::input::Input;

/// What is fused of a component, and what is said about it.
#[derive(Debug)]
pub(crate) struct Straightened {
    bent: BentComponent,
    /// Whether the straightened maps stand for what they were.
    is_applied: bool,
}

impl Straightened {
    /// Of `component`, as far as the command line asks for it.
    pub(crate) fn of(
        maps: &[&OccupancyGrid],
        component: &Component,
        args: &MergeArgs,
        progress: &dyn Progress,
    ) -> anyhow::Result<Self> {
        let default = if args.transforms.is_empty() { BendArg::Auto } else { BendArg::Off };
        let when = args.bend.unwrap_or(default);
        let bent = match when {
            BendArg::Off => BentComponent { component: component.clone(), maps: Vec::new() },
            BendArg::Auto | BendArg::Report => {
                unbend_component(maps, component, &BendParams::default(), progress)?
            }
        };
        Ok(Self { bent, is_applied: when == BendArg::Auto })
    }

    /// The maps as they are fused.
    pub(crate) fn maps<'a>(&'a self, maps: &[&'a OccupancyGrid]) -> Vec<&'a OccupancyGrid> {
        if self.is_applied { self.bent.straight(maps) } else { maps.to_vec() }
    }

    /// The component as it is fused.
    pub(crate) fn component<'a>(&'a self, rigid: &'a Component) -> &'a Component {
        if self.is_applied { &self.bent.component } else { rigid }
    }

    /// The maps made straight, applied or not.
    pub(crate) fn bent(&self) -> &BentComponent {
        &self.bent
    }

    pub(crate) fn answers(&self) -> Vec<BendAnswer> {
        let answer = |bent: &ogm_merge::BentMap| {
            BendAnswer::new(bent.map, &bent.report, self.is_applied && bent.straight.is_some())
        };
        self.bent.maps.iter().map(answer).collect()
    }
}

/// How far a map is bent, as the JSON says it.
#[derive(Debug, Serialize)]
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

/// How far maps are bent, for people; of maps that are not, only where that was `asked` for.
pub(crate) fn said(answers: &[BendAnswer], inputs: &[Input], asked: bool) -> String {
    let mut said = String::new();
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
