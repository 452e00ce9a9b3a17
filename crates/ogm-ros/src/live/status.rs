//! The state of every robot in words, for `rqt_robot_monitor` and for whoever reads a topic.

use ogm_io::ros::Time;
use ogm_merge::{PoseDegrees, RobotState};

use crate::message::{DiagnosticStatus, KeyValue, Level};

use super::intake::Intake;

/// One robot, of which a join is asked a probability of `accept`.
pub(super) fn of_robot(
    name: &str,
    intake: &Intake,
    state: Option<&RobotState>,
    accept: f64,
    now: Time,
) -> DiagnosticStatus {
    let placement = state.and_then(|state| state.placement.as_ref());
    let mut values = vec![
        value("maps received", intake.received),
        value("maps refused", intake.refused),
        value("seconds since", seconds_between(intake.heard, now)),
    ];
    if let Some(placement) = placement {
        let PoseDegrees { x_m, y_m, theta_deg } = placement.world_from_map.into();
        values.push(value("probability", format!("{:.4}", placement.probability)));
        for (key, number) in [("x_m", x_m), ("y_m", y_m), ("theta_deg", theta_deg)] {
            values.push(value(key, format!("{number:.4}")));
        }
        if let Some(covariance) = placement.covariance {
            let sigma_m = covariance.fixed_view::<2, 2>(0, 0).trace().max(0.0).sqrt();
            values.push(value("sigma_m", format!("{sigma_m:.4}")));
        }
    }
    let (level, message) = if !intake.trouble.is_empty() {
        (Level::Error, format!("refused: {}", intake.trouble))
    } else if let Some(placement) = placement {
        (Level::Ok, format!("placed with probability {:.3}", placement.probability))
    } else {
        (Level::Warn, why_not(state, accept))
    };
    DiagnosticStatus {
        level: level.byte(),
        name: format!("ogm: {name}"),
        message,
        hardware_id: String::new(),
        values,
    }
}

/// The node as a whole.
pub(super) fn of_team(
    placed: usize,
    robots: usize,
    turned_away: u64,
    last: &str,
) -> DiagnosticStatus {
    let mut message = format!("{placed} of {robots} robots placed");
    let mut level = if placed < robots { Level::Warn } else { Level::Ok };
    if turned_away > 0 {
        level = Level::Error;
        message += "; there are more robots than max_robots";
    }
    if !last.is_empty() {
        message = format!("{message}; {last}");
    }
    DiagnosticStatus {
        level: level.byte(),
        name: "ogm: team".to_owned(),
        message,
        hardware_id: String::new(),
        values: vec![value("messages turned away", turned_away)],
    }
}

fn why_not(state: Option<&RobotState>, accept: f64) -> String {
    let Some(state) = state else {
        return "no map of it was taken up yet".to_owned();
    };
    let mut message = if state.is_separated {
        "separated by order; `release` searches for it again".to_owned()
    } else {
        match &state.best_match {
            Some((other, probability)) => format!(
                "no place yet: the best match is {other} with probability {probability:.4} of \
                 {accept}; it needs walls that another robot has seen"
            ),
            None => "no place yet: no other map to match".to_owned(),
        }
    };
    if !state.with.is_empty() {
        message += &format!("; it hangs together with {}", state.with.join(", "));
    }
    message
}

fn value(key: &str, value: impl ToString) -> KeyValue {
    KeyValue { key: key.to_owned(), value: value.to_string() }
}

fn seconds_between(earlier: Time, later: Time) -> u64 {
    later.nanoseconds().saturating_sub(earlier.nanoseconds()) / 1_000_000_000
}
