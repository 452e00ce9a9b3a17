//! Two robots map one floor; the segments of their walls say how the maps fit.
#![expect(clippy::print_stdout, reason = "an example shows its result")]

use ogm_core::Outcome;
use ogm_sim::{FloorPlan, PairParams, simulate_pair};
use radon_merge::{RadonParams, find_transform};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pair = simulate_pair(&FloorPlan::random(7)?, &PairParams { seed: 7, ..PairParams::sa() })?;
    let found = find_transform(&pair.target.map, &pair.source.map, &RadonParams::default(), &())?;

    println!("{} pairs of segments, {} hypotheses", found.compared, found.hypotheses);
    for candidate in &found.candidates {
        let (judged, verified) = (&candidate.verification, candidate.verified);
        println!(
            "score {:.2}, V {:.1} %, walls {:.2} and {:.2}{}",
            candidate.hypothesis.score,
            judged.index.unwrap_or(0.0),
            judged.source_walls.share(),
            judged.target_walls.share(),
            if verified { ", verified" } else { "" },
        );
    }
    match found.outcome {
        Outcome::Found(target_from_source) => {
            let error = target_from_source.between(&pair.target_from_source);
            println!(
                "off by {:.3} m, {:.2}°",
                error.translation().norm(),
                error.theta().to_degrees()
            );
        }
        Outcome::Refused(reason) => println!("refused: {reason}"),
    }
    Ok(())
}
