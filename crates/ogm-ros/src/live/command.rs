//! What somebody asks for while it runs.

use std::str::FromStr;

/// An order, as a line of text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Command {
    /// `separate ROBOT`: take its map out of the merged one, and keep it out.
    Separate(String),
    /// `release ROBOT`: forget its pose and that it was separated; search again.
    Release(String),
    /// `remove ROBOT`: forget it.
    Remove(String),
    /// `reconsider`: forget what stands and arrange all maps anew.
    Reconsider,
}

impl FromStr for Command {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let words: Vec<&str> = text.split_whitespace().collect();
        let robot = |robot: &str| robot.trim_matches('/').to_owned();
        match words[..] {
            ["separate", name] => Ok(Self::Separate(robot(name))),
            ["release", name] => Ok(Self::Release(robot(name))),
            ["remove", name] => Ok(Self::Remove(robot(name))),
            ["reconsider"] => Ok(Self::Reconsider),
            _ => Err(format!(
                "\"{}\" is no order; write separate ROBOT, release ROBOT, remove ROBOT or reconsider",
                text.chars().take(80).collect::<String>().escape_debug()
            )),
        }
    }
}
