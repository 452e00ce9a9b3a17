"""Aligns and merges occupancy grid maps of robot teams.

Lengths are metres and angles radians. A transform maps points of a source map into the frame of a
target map. Row 0 of an array of cells is the lowest, as in a ROS message.
"""

from ogm_maps._native import (
    Alignment,
    Component,
    Hypothesis,
    Map,
    MapError,
    Merge,
    Pair,
    Picture,
    Refinement,
    Segment,
    Tag,
    Transform,
    Walk,
    Walls,
    __version__,
    align,
    fuse,
    icp,
    load,
    localise_tags,
    merge,
    overlay,
    random_walk,
    wall_segments,
)

__all__ = [
    "Alignment",
    "Component",
    "Hypothesis",
    "Map",
    "MapError",
    "Merge",
    "Pair",
    "Picture",
    "Refinement",
    "Segment",
    "Tag",
    "Transform",
    "Walk",
    "Walls",
    "__version__",
    "align",
    "fuse",
    "icp",
    "load",
    "localise_tags",
    "merge",
    "overlay",
    "random_walk",
    "wall_segments",
]
