//! How a map of a bag is named on a command line.

use std::path::{Path, PathBuf};

/// A map of a bag: `team.mcap:/robot1/map` is the last one on that topic, and
/// `team.mcap:/robot1/map@12.5` the last one by 12.5 s after the bag's start.
#[derive(Debug, Clone, PartialEq)]
pub struct BagMap {
    /// The bag, a file or the folder of one.
    pub bag: PathBuf,
    /// The topic, with its leading slash.
    pub topic: String,
    /// Seconds from the start of the bag; `None` for the last.
    pub at_s: Option<f64>,
}

impl BagMap {
    /// What `name` names; `None` if it has not this form.
    ///
    /// ```
    /// use ogm_io::BagMap;
    ///
    /// let map = BagMap::parse("team.mcap:/robot1/map@12.5".as_ref()).expect("of this form");
    /// assert_eq!(map.bag.to_str(), Some("team.mcap"));
    /// assert_eq!((map.topic.as_str(), map.at_s), ("/robot1/map", Some(12.5)));
    /// assert_eq!(BagMap::parse("map.yaml".as_ref()), None);
    /// ```
    #[must_use]
    pub fn parse(name: &Path) -> Option<Self> {
        let (bag, topic) = name.to_str()?.rsplit_once(":/")?;
        // A drive of Windows is no bag.
        if bag.len() < 2 || topic.is_empty() {
            return None;
        }
        let (topic, at_s) = match topic.rsplit_once('@') {
            None => (topic, None),
            Some((topic, time)) => {
                let time: f64 = time.parse().ok().filter(|time: &f64| *time >= 0.0)?;
                (topic, Some(time))
            }
        };
        Some(Self { bag: bag.into(), topic: format!("/{topic}"), at_s })
    }
}
