"""Features of the maps as images: AKAZE or ORB, ratio test, RANSAC, refit without a scale."""

import math

import cv2
import numpy as np

import maps

RATIO = 0.8
THRESHOLD_PIXELS = 3.0
LEAST_INLIERS = 12
SCALE_TOLERANCE = 0.03


def detector(name):
    return cv2.AKAZE_create() if name == "akaze" else cv2.ORB_create(nfeatures=2000)


def rigid_fit(source, target):
    """The rigid motion of least squares between points that correspond, one row each."""
    middle_of_source, middle_of_target = source.mean(axis=0), target.mean(axis=0)
    arms, images = source - middle_of_source, target - middle_of_target
    cross = float((arms[:, 0] * images[:, 1] - arms[:, 1] * images[:, 0]).sum())
    turn = maps.motion(0.0, 0.0, math.atan2(cross, float((arms * images).sum())))
    turn[:2, 2] = middle_of_target - turn[:2, :2] @ middle_of_source
    return turn


def solve(target, source, arguments):
    # Both images on the target's cells, so that a right match has scale 1.
    enlarged = source.resolution / target.resolution
    images = [target.grey(), source.grey()]
    if abs(enlarged - 1.0) > 1e-6:
        size = None
        images[1] = cv2.resize(
            images[1], size, fx=enlarged, fy=enlarged, interpolation=cv2.INTER_AREA
        )
    if arguments.blur > 0.0:
        images = [cv2.GaussianBlur(image, (0, 0), arguments.blur) for image in images]
    find = detector(arguments.detector)
    (points_a, words_a), (points_b, words_b) = (
        find.detectAndCompute(image, None) for image in images
    )
    if words_a is None or words_b is None or min(len(words_a), len(words_b)) < 3:
        return None, "too few features"

    neighbours = cv2.BFMatcher(cv2.NORM_HAMMING).knnMatch(words_b, words_a, k=2)
    kept = [
        pair[0]
        for pair in neighbours
        if len(pair) == 2 and pair[0].distance < RATIO * pair[1].distance
    ]
    note = f"{len(kept)} matches of {len(points_a)} and {len(points_b)} features"
    if len(kept) < 3:
        return None, note
    from_b = np.array([points_b[match.queryIdx].pt for match in kept])
    to_a = np.array([points_a[match.trainIdx].pt for match in kept])
    similarity, inliers = cv2.estimateAffinePartial2D(
        from_b,
        to_a,
        method=cv2.RANSAC,
        ransacReprojThreshold=THRESHOLD_PIXELS,
        maxIters=5000,
        confidence=0.999,
    )
    if similarity is None:
        return None, f"{note}, no similarity"
    inliers = inliers.ravel() > 0
    scale = math.hypot(similarity[0, 0], similarity[1, 0])
    note = f"{note}, {inliers.sum()} inliers, scale {scale:.3f}"
    if inliers.sum() < LEAST_INLIERS or abs(scale - 1.0) > SCALE_TOLERANCE:
        return None, note
    # The centre of source pixel 0 lies half an enlarged pixel into the enlarged image.
    offset = 0.5 * (enlarged - 1.0)
    onto_enlarged = np.array([[enlarged, 0, offset], [0, enlarged, offset], [0, 0, 1]])
    return rigid_fit(from_b[inliers], to_a[inliers]) @ onto_enlarged, note


if __name__ == "__main__":
    maps.run(
        "features",
        [
            ("--detector", {"choices": ["akaze", "orb"], "required": True}),
            ("--blur", {"type": float, "default": 0.0, "help": "sigma, pixels"}),
        ],
        solve,
    )
