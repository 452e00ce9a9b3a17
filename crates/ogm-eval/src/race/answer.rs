//! What a command says about a pair of maps, in either of two forms of JSON.

use ogm_core::Se2;
use serde::Deserialize;

/// An answer that could be read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Answer {
    /// `None` if the command refuses the pair, whatever its best guess.
    pub(super) target_from_source: Option<Se2>,
    /// CPU seconds without start-up and reading, if the command counts them itself.
    pub(super) own_cpu_s: Option<f64>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Json {
    /// As `ogm align --json` prints it.
    Ours { verdict: String, target_from_source: Option<Pose> },
    /// As scripts around other libraries print it.
    Peer {
        ok: bool,
        dx: Option<f64>,
        dy: Option<f64>,
        theta_deg: Option<f64>,
        cpu_seconds: Option<f64>,
    },
}

#[derive(Deserialize)]
struct Pose {
    x_m: f64,
    y_m: f64,
    theta_deg: f64,
}

impl Answer {
    /// The answer in `output`, from its first brace on; `None` for anything else than one JSON
    /// object of a known form, and for a match without its transform.
    pub(super) fn parse(output: &str) -> Option<Self> {
        let json = serde_json::from_str(&output[output.find('{')?..]).ok()?;
        let (matched, pose, own_cpu_s) = match json {
            Json::Ours { verdict, target_from_source } => {
                (verdict == "merged", target_from_source, None)
            }
            Json::Peer { ok, dx, dy, theta_deg, cpu_seconds } => {
                let pose = dx.zip(dy).zip(theta_deg);
                let pose = pose.map(|((x_m, y_m), theta_deg)| Pose { x_m, y_m, theta_deg });
                (ok, pose, cpu_seconds)
            }
        };
        let target_from_source = match (matched, pose) {
            (true, Some(pose)) => Some(Se2::new(pose.x_m, pose.y_m, pose.theta_deg.to_radians())),
            (true, None) => return None,
            (false, _) => None,
        };
        Some(Self { target_from_source, own_cpu_s })
    }
}

#[cfg(test)]
mod tests {
    use super::Answer;
    use ogm_core::Se2;
    use std::f64::consts::FRAC_PI_2;

    fn close(a_from_b: Option<Se2>, x: f64, y: f64, theta: f64) -> bool {
        a_from_b.is_some_and(|found| {
            let error_b_from_b = found.between(&Se2::new(x, y, theta));
            error_b_from_b.log().norm() < 1e-12
        })
    }

    #[test]
    fn both_forms_say_the_same() {
        let ours = Answer::parse(
            r#"{ "schema": 1, "verdict": "merged", "probability": 0.99,
                 "target_from_source": { "x_m": 1.5, "y_m": -2.0, "theta_deg": 90.0 } }"#,
        )
        .unwrap();
        let peer = Answer::parse(
            "a word of warning\n{\"peer\": \"fft\", \"ok\": true, \"dx\": 1.5, \"dy\": -2.0, \
             \"theta_deg\": 90, \"seconds\": 2.5, \"cpu_seconds\": 2.25, \"note\": \"\"}\n",
        )
        .unwrap();
        assert!(close(ours.target_from_source, 1.5, -2.0, FRAC_PI_2), "{ours:?}");
        assert!(close(peer.target_from_source, 1.5, -2.0, FRAC_PI_2), "{peer:?}");
        assert_eq!((ours.own_cpu_s, peer.own_cpu_s), (None, Some(2.25)));
    }

    #[test]
    fn a_refusal_is_one_whatever_its_best_guess() {
        for refusal in [
            r#"{"verdict": "no-match", "target_from_source": null}"#,
            r#"{"verdict": "ambiguous", "target_from_source": {"x_m": 1, "y_m": 2, "theta_deg": 3}}"#,
            r#"{"peer": "akaze", "ok": false, "dx": null, "dy": null, "theta_deg": null}"#,
        ] {
            assert_eq!(Answer::parse(refusal).unwrap().target_from_source, None, "{refusal}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_no_answer() {
        for output in [
            "",
            "Segmentation fault",
            "{",
            "{}",
            r#"{"verdict": "merged", "target_from_source": null}"#,
            r#"{"ok": true, "dx": 1.0, "dy": null, "theta_deg": 0.0}"#,
            r#"{"ok": true, "dx": NaN, "dy": 0.0, "theta_deg": 0.0}"#,
        ] {
            assert_eq!(Answer::parse(output), None, "{output}");
        }
    }
}
