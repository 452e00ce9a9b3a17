"""The same numbers as the command."""

import json
import os
import subprocess

import pytest

import ogm_maps as ogm

COMMAND = os.environ.get("OGM_COMMAND")


@pytest.mark.skipif(COMMAND is None, reason="OGM_COMMAND names the command `ogm`")
@pytest.mark.parametrize("options", [{}, {"repeats": True, "seed": 5}, {"method": "radon"}, "tags"])
def test_a_pair_has_the_same_answer_as_from_the_command(folder, target, source, options):
    paths = [folder / "target.yaml", folder / "source.yaml"]
    logs = [folder / "target.tags.csv", folder / "source.tags.csv"]
    flags = []
    if options == "tags":
        options = {"tags": logs}
        flags = [f"--tags={path}={log}" for path, log in zip(paths, logs)]
    else:
        for name, given in options.items():
            flags += [f"--{name}"] if given is True else [f"--{name}", str(given)]
    run = subprocess.run(
        [COMMAND, "align", *paths, "--json", "--quiet", *flags], capture_output=True, check=False
    )
    assert run.returncode in (0, 3), run.stderr
    said = json.loads(run.stdout)
    here = ogm.align(target, source, **options).to_dict()
    for name in ("schema", "target", "source", "elapsed_ms"):
        said.pop(name)
    assert here == said
