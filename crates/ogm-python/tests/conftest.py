"""Two maps of one building, as two robots made them, and the truth about them."""

import json
import math
from pathlib import Path

import pytest

import ogm_maps as ogm

PLAN_A = Path(__file__).parents[3] / "fixtures" / "plan-a"


@pytest.fixture(scope="session")
def folder() -> Path:
    return PLAN_A


@pytest.fixture(scope="session")
def target() -> ogm.Map:
    return ogm.load(PLAN_A / "target.yaml")


@pytest.fixture(scope="session")
def source() -> ogm.Map:
    return ogm.load(PLAN_A / "source.yaml")


@pytest.fixture(scope="session")
def truth() -> ogm.Transform:
    pose = json.loads((PLAN_A / "truth.json").read_text())["target_from_source"]
    return ogm.Transform(pose["x_m"], pose["y_m"], math.radians(pose["theta_deg"]))


@pytest.fixture(scope="session")
def found(target, source) -> ogm.Alignment:
    return ogm.align(target, source)
