//! The top level of a YAML mapping, every value as the text that stands in the file.
//!
//! Errors can then quote a value, numbers that YAML does not know, such as `-nan`, reach our own
//! parser, and what is wrong with the shape of one value does not hide the others.

use granit_parser::{Event, Parser, ScalarStyle, ScanError};

/// A key of the top level, in the order of the file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) value: Value,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    /// Nothing, `~` or `null`.
    Null,
    Scalar(String),
    /// A sequence of scalars.
    List(Vec<String>),
    /// Anything else, by its YAML name.
    Other(&'static str),
}

/// The entries of the first document of `text`, or why it is no mapping.
pub(crate) fn parse(text: &str) -> Result<Vec<Entry>, String> {
    let mut events = Parser::new_from_str(text);
    let mut next = move || match events.next() {
        Some(Ok((event, span))) => Ok((event, span.start.line())),
        Some(Err(error)) => Err(said(&error)),
        None => Ok((Event::StreamEnd, 0)),
    };
    loop {
        match next()? {
            (Event::StreamStart | Event::DocumentStart(..), _) => {}
            (Event::MappingStart(..), _) => break,
            (Event::StreamEnd | Event::DocumentEnd, _) => {
                return Err("it is empty".to_owned());
            }
            (_, line) => return Err(format!("line {line} is no `key: value`")),
        }
    }
    let mut entries = Vec::new();
    loop {
        let key = match next()? {
            (Event::Scalar(key, ..), _) => key.into_owned(),
            (Event::MappingEnd, _) => {
                // The end of the document; what stands behind that may be malformed.
                next()?;
                next()?;
                return Ok(entries);
            }
            (_, line) => return Err(format!("the key on line {line} is no word")),
        };
        let (event, line) = next()?;
        let value = value(event, &mut next)
            .map_err(|error| format!("key `{key}` on line {line}: {error}"))?;
        entries.push(Entry { key, value });
    }
}

/// The value that starts with `event`; `next` is left behind its end.
fn value<'a>(
    event: Event<'a>,
    next: &mut impl FnMut() -> Result<(Event<'a>, usize), String>,
) -> Result<Value, String> {
    Ok(match event {
        Event::Scalar(text, style, ..) => scalar(&text, style),
        Event::SequenceStart(..) => {
            let mut items = Vec::new();
            let mut is_flat = true;
            loop {
                match next()?.0 {
                    Event::SequenceEnd => break,
                    Event::Scalar(text, ..) => items.push(text.into_owned()),
                    opening @ (Event::SequenceStart(..) | Event::MappingStart(..)) => {
                        is_flat = false;
                        skip(&opening, next)?;
                    }
                    _ => is_flat = false,
                }
            }
            if is_flat { Value::List(items) } else { Value::Other("a nested sequence") }
        }
        Event::MappingStart(..) => {
            skip(&event, next)?;
            Value::Other("a mapping")
        }
        _ => Value::Other("an alias"),
    })
}

fn scalar(text: &str, style: ScalarStyle) -> Value {
    match text {
        "" | "~" | "null" | "Null" | "NULL" if style == ScalarStyle::Plain => Value::Null,
        _ => Value::Scalar(text.to_owned()),
    }
}

/// Goes behind the end of what `opening` opens.
fn skip<'a>(
    opening: &Event<'a>,
    next: &mut impl FnMut() -> Result<(Event<'a>, usize), String>,
) -> Result<(), String> {
    let depth_of = |event: &Event<'_>| match event {
        Event::SequenceStart(..) | Event::MappingStart(..) => 1,
        Event::SequenceEnd | Event::MappingEnd => -1,
        _ => 0,
    };
    let mut depth = depth_of(opening);
    while depth > 0 {
        depth += depth_of(&next()?.0);
    }
    Ok(())
}

fn said(error: &ScanError) -> String {
    let place = error.marker();
    format!("{} at line {}, column {}", error.info(), place.line(), place.col() + 1)
}
