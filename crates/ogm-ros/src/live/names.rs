//! Which robot a topic belongs to.

/// The robot whose map is on `topic`: what stands before the last word, if that is `map_topic`;
/// `None` for other topics and for a map without a robot, such as `/map`.
///
/// ```
/// use ogm_ros::live::robot_of;
///
/// assert_eq!(robot_of("/robot1/map", "map"), Some("robot1"));
/// assert_eq!(robot_of("/fleet/robot1/slam/map", "slam/map"), Some("fleet/robot1"));
/// assert_eq!(robot_of("/map", "map"), None);
/// ```
#[must_use]
pub fn robot_of<'a>(topic: &'a str, map_topic: &str) -> Option<&'a str> {
    let robot = topic.strip_prefix('/')?.strip_suffix(map_topic.trim_matches('/'))?;
    robot.strip_suffix('/').filter(|robot| !robot.is_empty())
}

/// The name of a robot's map frame, which no other robot's may be: what the map says if that names
/// the robot, else the robot's name before it.
pub(crate) fn map_frame(robot: &str, said: &str) -> String {
    let said = said.trim_matches('/');
    let names_it = said == robot || said.split('/').any(|word| robot.split('/').any(|r| r == word));
    match said {
        "" => format!("{robot}/map"),
        said if names_it => said.to_owned(),
        said => format!("{robot}/{said}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{map_frame, robot_of};

    #[test]
    fn only_maps_of_robots_have_a_robot() {
        assert_eq!(robot_of("/a/map", "/map"), Some("a"));
        for topic in ["/map", "/a/costmap", "/amap", "/a/map_updates", "a/map"] {
            assert_eq!(robot_of(topic, "map"), None, "{topic}");
        }
    }

    #[test]
    fn two_robots_that_call_their_frame_map_get_two_frames() {
        assert_eq!(map_frame("robot1", "map"), "robot1/map");
        assert_eq!(map_frame("robot1", ""), "robot1/map");
        assert_eq!(map_frame("robot1", "robot1/map"), "robot1/map");
        assert_eq!(map_frame("fleet/robot1", "robot1/odom"), "robot1/odom");
        assert_eq!(map_frame("robot1", "robot2/map"), "robot1/robot2/map");
    }
}
