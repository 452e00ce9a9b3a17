"""The examples run, and show what they say."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import ogm_maps as ogm

EXAMPLES = Path(__file__).parents[1] / "examples"


def test_a_folder_of_maps_becomes_groups(tmp_path, folder):
    for file in ("target.yaml", "target.pgm", "source.yaml", "source.pgm"):
        shutil.copy(folder / file, tmp_path)
    out = tmp_path / "out"
    run = subprocess.run(
        [sys.executable, EXAMPLES / "folder.py", tmp_path, out],
        capture_output=True,
        check=True,
        text=True,
    )
    assert [line.split(":")[0].strip() for line in run.stdout.splitlines()] == [
        "group 0", "source.yaml", "target.yaml"
    ]
    assert ogm.load(out / "group-0.yaml").width > 300


def test_the_notebook_runs_and_shows_maps():
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    notebook = nbformat.read(EXAMPLES / "two_maps.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "save it without outputs"
    nbclient.NotebookClient(
        notebook, timeout=300, resources={"metadata": {"path": str(EXAMPLES)}}
    ).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) == 5, "two maps, one on the other, the merged map, the plot"
    said = "".join(output.get("text", "") for output in outputs)
    assert "Transform(x=-6.4" in said and "conflicts" in said
