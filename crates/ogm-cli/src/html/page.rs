//! The page's text.

use std::fmt::Write;

use ogm_merge::{PoseDegrees, Verdict};
use ogm_view::wall_colour;

use crate::answer::PairAnswer;
use crate::merged::{Conflict, MergeAnswer};

const STYLE: &str = include_str!("style.css");
const SLIDER: &str = include_str!("slider.js");

/// The most places of conflict that the page lists.
const LISTED: usize = 20;

/// Pictures as data URLs.
#[derive(Default)]
pub(super) struct Pictures {
    /// Each map on the merged one, by its place.
    pub(super) layers: Vec<(usize, String)>,
    pub(super) merged: Option<String>,
    pub(super) overlay: Option<String>,
}

pub(super) fn page(answer: &MergeAnswer, pictures: &Pictures) -> String {
    let merged = match &answer.team {
        Some(_) => answer.components.len() == 1,
        None => answer.pairs.iter().all(|pair| pair.report.verdict() == Verdict::Merged),
    };
    let (class, title) = if merged { ("good", "Merged") } else { ("bad", "Not merged") };
    let files: Vec<String> = answer.maps.iter().map(|map| escaped(&map.file)).collect();
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}: {}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <h1><span class=\"{class}\">{title}</span></h1>\n<p class=\"files\">{}</p>\n",
        files.join(", "),
        files.join("<br>")
    );
    page += &viewer(&files, pictures);
    page += &result(answer, &files, pictures);
    page += &poses(answer, &files);
    for pair in &answer.pairs {
        page += &verdict(pair);
    }
    page += "<h2>Files</h2>\n<div class=\"scroll\"><table>\n<tr><th>map</th><th>SHA-256 of the image</th></tr>\n";
    for (file, map) in files.iter().zip(&answer.maps) {
        let _ = writeln!(page, "<tr><td>{file}</td><td><code>{}</code></td></tr>", map.sha256);
    }
    page + "</table></div>\n<script>\n" + SLIDER + "</script>\n</body>\n</html>\n"
}

/// Two maps to slide between, or the picture of what was refused.
fn viewer(files: &[String], pictures: &Pictures) -> String {
    let Some((first, _)) = pictures.layers.first() else {
        return pictures.overlay.as_ref().map_or_else(String::new, |overlay| {
            format!(
                "<p>The best transform, which was refused:</p>\n<div class=\"picture\">\
                 <img alt=\"both maps on each other\" src=\"{overlay}\"></div>\n"
            )
        });
    };
    let second = pictures.layers.get(1).map_or(*first, |(map, _)| *map);
    let options = |chosen: usize| -> String {
        let option = |(place, (map, _)): (usize, &(usize, String))| {
            let selected = if *map == chosen { " selected" } else { "" };
            format!("<option value=\"{place}\"{selected}>{}</option>", files[*map])
        };
        pictures.layers.iter().enumerate().map(option).collect()
    };
    let mut text = "<h2>The maps on each other</h2>\n<div class=\"stack both\">\n".to_owned();
    for (map, layer) in &pictures.layers {
        let _ = writeln!(text, "<img alt=\"{}\" src=\"{layer}\">", files[*map]);
    }
    text += "<span class=\"edge\"></span></div>\n<div class=\"controls\">\n";
    let _ = writeln!(
        text,
        "<label>left <select id=\"left\">{}</select></label>\n\
         <label>right <select id=\"right\">{}</select></label>\n\
         <input type=\"range\" id=\"slider\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"where the left map ends\">\n\
         <label><input type=\"checkbox\" id=\"both\" checked> all at once</label>\n</div>",
        options(*first),
        options(second),
    );
    text += "<div class=\"controls\">";
    for (map, _) in &pictures.layers {
        let _ = writeln!(text, "<label>{} {}</label>", swatch(*map), files[*map]);
    }
    text += "</div>\n";
    text
}

fn result(answer: &MergeAnswer, files: &[String], pictures: &Pictures) -> String {
    let (Some(output), Some(picture)) = (&answer.output, &pictures.merged) else {
        return "<p class=\"quiet\">No map was made.</p>\n".to_owned();
    };
    let mut text = format!(
        "<h2>The merged map</h2>\n<p>{}</p>\n<div class=\"picture\">\
         <img alt=\"the merged map, conflicts in red\" src=\"{picture}\"></div>\n",
        escaped(&output.summary())
    );
    if output.conflicts.is_empty() {
        return text + "<p>The maps contradict each other nowhere.</p>\n";
    }
    text += "<p>Conflicts, red in the picture: walls of one map where another says free and has none \
             as near as the poses leave open. They stay obstacles.</p>\n<div class=\"scroll\"><table>\n\
             <tr><th class=\"n\">x, m</th><th class=\"n\">y, m</th><th class=\"n\">size, m</th>\
             <th>occupied in</th><th>free in</th></tr>\n";
    for conflict in output.conflicts.iter().take(LISTED) {
        text += &place(conflict, files);
    }
    text += "</table></div>\n";
    if output.conflict_places > LISTED {
        let _ = writeln!(
            text,
            "<p class=\"quiet\">The largest {LISTED} of {}.</p>",
            output.conflict_places
        );
    }
    text
}

fn place(conflict: &Conflict, files: &[String]) -> String {
    let names =
        |maps: &[usize]| maps.iter().map(|&map| files[map].as_str()).collect::<Vec<_>>().join(", ");
    let [width, height] = conflict.size_m;
    format!(
        "<tr><td class=\"n\">{:.2}</td><td class=\"n\">{:.2}</td>\
         <td class=\"n\">{width:.2} × {height:.2}</td><td>{}</td><td>{}</td></tr>\n",
        conflict.x_m,
        conflict.y_m,
        names(&conflict.occupied),
        names(&conflict.free)
    )
}

fn poses(answer: &MergeAnswer, files: &[String]) -> String {
    let mut text = String::from(
        "<h2>Poses</h2>\n<div class=\"scroll\"><table>\n<tr><th>map</th><th class=\"n\">x, m</th>\
         <th class=\"n\">y, m</th><th class=\"n\">θ, °</th><th class=\"n\">σ x, m</th>\
         <th class=\"n\">σ y, m</th><th class=\"n\">σ θ, °</th></tr>\n",
    );
    for (number, component) in answer.components.iter().enumerate() {
        if answer.components.len() > 1 {
            let _ = writeln!(text, "<tr><th colspan=\"7\">group {}</th></tr>", number + 1);
        }
        for member in &component.members {
            let pose = PoseDegrees::from(member.reference_from_map);
            let _ = write!(
                text,
                "<tr><td>{} {}</td><td class=\"n\">{:.3}</td><td class=\"n\">{:.3}</td>\
                 <td class=\"n\">{:.2}</td>",
                swatch(member.map),
                files[member.map],
                pose.x_m,
                pose.y_m,
                pose.theta_deg
            );
            for axis in 0..3 {
                let sigma = member.covariance.map(|covariance| covariance[(axis, axis)].sqrt());
                let sigma = sigma.map_or("–".to_owned(), |sigma| match axis {
                    2 => format!("{:.2}", sigma.to_degrees()),
                    _ => format!("{sigma:.3}"),
                });
                let _ = write!(text, "<td class=\"n\">{sigma}</td>");
            }
            text += "</tr>\n";
        }
    }
    text + "</table></div>\n"
}

fn verdict(pair: &PairAnswer) -> String {
    let report = &pair.report;
    let class = if report.verdict() == Verdict::Merged { "good" } else { "bad" };
    let mut text = format!(
        "<h2>{} on {}</h2>\n<p><strong class=\"{class}\">{}</strong>",
        escaped(&pair.source.file),
        escaped(&pair.target.file),
        report.verdict().name()
    );
    if let Some(refusal) = report.outcome.refusal() {
        let _ = write!(text, ": {}", escaped(&refusal.to_string()));
    }
    let _ = write!(text, " <span class=\"quiet\">by the method {}", report.method.name());
    for (name, share) in [
        ("probability", report.probability()),
        ("overlap", report.overlap),
        ("walls agree", report.agreement),
    ] {
        if let Some(share) = share {
            let _ = write!(text, "; {name} {share:.2}");
        }
    }
    text += "</span></p>\n";
    for warning in &report.warnings {
        let _ = writeln!(text, "<p class=\"warning\">{}</p>", escaped(&warning.to_string()));
    }
    if report.hypotheses.len() > 1 {
        text += "<div class=\"scroll\"><table>\n<tr><th class=\"n\">x, m</th><th class=\"n\">y, m</th>\
                 <th class=\"n\">θ, °</th><th class=\"n\">probability</th></tr>\n";
        for one in &report.hypotheses {
            let pose = PoseDegrees::from(one.target_from_source);
            let probability = one.probability.map_or("–".to_owned(), |p| format!("{p:.3}"));
            let _ = writeln!(
                text,
                "<tr><td class=\"n\">{:.3}</td><td class=\"n\">{:.3}</td><td class=\"n\">{:.2}</td>\
                 <td class=\"n\">{probability}</td></tr>",
                pose.x_m, pose.y_m, pose.theta_deg
            );
        }
        text += "</table></div>\n";
    }
    text
}

fn swatch(map: usize) -> String {
    let [red, green, blue] = wall_colour(map).0;
    format!("<span class=\"swatch\" style=\"background:rgb({red},{green},{blue})\"></span>")
}

/// Text as text, whatever is in a file's name.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\'' => escaped += "&#39;",
            letter => escaped.push(letter),
        }
    }
    escaped
}
