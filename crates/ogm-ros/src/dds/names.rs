//! What ROS 2 calls a topic and a type, and what DDS does.

use super::error::DdsError;

/// Topics, as against services and actions.
const TOPIC_PREFIX: &str = "rt";

/// `/map` is `rt/map`.
pub(super) fn dds_topic(topic: &str) -> Result<String, DdsError> {
    let is_word = |word: &str| {
        !word.is_empty()
            && !word.starts_with(|first: char| first.is_ascii_digit())
            && word.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
    };
    let words = topic.strip_prefix('/').filter(|words| words.split('/').all(is_word));
    let words = words.ok_or_else(|| DdsError::Topic { name: topic.to_owned() })?;
    Ok(format!("{TOPIC_PREFIX}/{words}"))
}

/// `rt/map` is `/map`; `None` for what is no topic of ROS 2.
pub(super) fn ros_topic(topic: &str) -> Option<&str> {
    topic.strip_prefix(TOPIC_PREFIX).filter(|rest| rest.starts_with('/'))
}

/// `nav_msgs/msg/OccupancyGrid` is `nav_msgs::msg::dds_::OccupancyGrid_`.
pub(super) fn dds_type(name: &str) -> String {
    match name.rsplit_once('/') {
        Some((path, last)) => format!("{}::dds_::{last}_", path.replace('/', "::")),
        None => name.to_owned(),
    }
}

/// And back; `None` for what is no type of ROS 2.
pub(super) fn ros_type(name: &str) -> Option<String> {
    let (path, last) = name.rsplit_once("::dds_::")?;
    Some(format!("{}/{}", path.replace("::", "/"), last.strip_suffix('_')?))
}

#[cfg(test)]
mod tests {
    use super::{dds_topic, dds_type, ros_topic, ros_type};

    #[test]
    fn names_go_to_dds_and_back() {
        for topic in ["/map", "/robot1/map", "/a/b_2/map_updates"] {
            assert_eq!(ros_topic(&dds_topic(topic).unwrap()), Some(topic));
        }
        let name = "nav_msgs/msg/OccupancyGrid";
        assert_eq!(dds_type(name), "nav_msgs::msg::dds_::OccupancyGrid_");
        assert_eq!(ros_type(&dds_type(name)).as_deref(), Some(name));
    }

    #[test]
    fn what_ros_does_not_call_a_topic_is_none() {
        for topic in ["map", "", "/", "/1robot/map", "/a//b", "/a b", "/map/"] {
            assert!(dds_topic(topic).is_err(), "{topic:?}");
        }
        assert_eq!(ros_topic("rq/get_mapRequest"), None);
        assert_eq!(ros_topic("rtx"), None);
        assert_eq!(ros_type("HelloWorld"), None);
    }
}
