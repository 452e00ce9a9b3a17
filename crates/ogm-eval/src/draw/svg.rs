//! An SVG document as text.

use std::fmt::{Display, Write};

use super::palette::INK;

/// Escapes text for XML and HTML, in elements and in quoted attributes.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            _ => escaped.push(character),
        }
    }
    escaped
}

/// Where a text is held by its position.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A drawing on a white panel, which keeps it readable on a dark page; units are pixels, y down.
#[derive(Debug)]
pub(crate) struct Svg {
    body: String,
}

impl Svg {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let mut svg = Self { body: String::new() };
        svg.push(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
             height=\"{h}\" font-family=\"system-ui, sans-serif\" font-size=\"12\" role=\"img\">\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>",
            w = round(width),
            h = round(height),
        ));
        svg
    }

    /// Adds an element as it stands.
    pub(crate) fn push(&mut self, element: impl Display) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.body, "{element}");
    }

    pub(crate) fn line(&mut self, from: [f64; 2], to: [f64; 2], colour: &str, width: f64) {
        self.push(format_args!(
            "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{colour}\" \
             stroke-width=\"{width}\"/>",
            round(from[0]),
            round(from[1]),
            round(to[0]),
            round(to[1]),
        ));
    }

    pub(crate) fn dot(&mut self, centre: [f64; 2], radius: f64, colour: &str) {
        self.push(format_args!(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{radius}\" fill=\"{colour}\" fill-opacity=\"0.75\"/>",
            round(centre[0]),
            round(centre[1]),
        ));
    }

    /// The box between two opposite corners.
    pub(crate) fn bar(&mut self, a: [f64; 2], b: [f64; 2], colour: &str) {
        self.push(format_args!(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{colour}\"/>",
            round(a[0].min(b[0])),
            round(a[1].min(b[1])),
            round((a[0] - b[0]).abs()),
            round((a[1] - b[1]).abs()),
        ));
    }

    pub(crate) fn path(&mut self, points: &[[f64; 2]], colour: &str, dashed: bool) {
        let mut positions = String::new();
        for [x, y] in points {
            let _ = write!(positions, "{},{} ", round(*x), round(*y));
        }
        let dashes = if dashed { " stroke-dasharray=\"6 4\"" } else { "" };
        self.push(format_args!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"\
             {dashes}/>",
            positions.trim_end(),
        ));
    }

    pub(crate) fn text(&mut self, at: [f64; 2], anchor: Anchor, text: &str) {
        self.styled_text(at, anchor, text, "");
    }

    /// A text with a white rim, readable on lines and bars.
    pub(crate) fn text_on_data(&mut self, at: [f64; 2], anchor: Anchor, text: &str) {
        let rim = " stroke=\"#ffffff\" stroke-width=\"4\" paint-order=\"stroke\"";
        self.styled_text(at, anchor, text, rim);
    }

    /// A text in bold.
    pub(crate) fn title(&mut self, at: [f64; 2], text: &str) {
        self.styled_text(at, Anchor::Start, text, " font-weight=\"600\" font-size=\"13\"");
    }

    /// A text that reads upwards.
    pub(crate) fn upward_text(&mut self, at: [f64; 2], text: &str) {
        let turn = format!(" transform=\"rotate(-90 {} {})\"", round(at[0]), round(at[1]));
        self.styled_text(at, Anchor::Middle, text, &turn);
    }

    fn styled_text(&mut self, at: [f64; 2], anchor: Anchor, text: &str, style: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.push(format_args!(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" fill=\"{INK}\"{style}>{}</text>",
            round(at[0]),
            round(at[1]),
            escape(text),
        ));
    }

    /// The document.
    pub(crate) fn finish(mut self) -> String {
        self.body.push_str("</svg>\n");
        self.body
    }
}

/// Hundredths of a pixel: what no eye sees only makes the file long.
pub(crate) fn round(value: f64) -> f64 {
    let rounded = (value * 100.0).round() / 100.0;
    // Minus zero prints its sign.
    if rounded == 0.0 { 0.0 } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::{Anchor, Svg, escape};

    #[test]
    fn text_cannot_leave_its_element() {
        assert_eq!(escape("a<b & \"c\" 'd'>"), "a&lt;b &amp; &quot;c&quot; &#39;d&#39;&gt;");
        let mut svg = Svg::new(10.0, 10.0);
        svg.text([0.0, -0.001], Anchor::Start, "</text><script>");
        let svg = svg.finish();
        assert!(!svg.contains("<script>"));
        assert!(svg.contains("y=\"0\"") && svg.ends_with("</svg>\n"));
    }
}
