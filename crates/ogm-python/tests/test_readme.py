"""The lines of Python in the README do what they say."""

import re
import shutil
from pathlib import Path

README = Path(__file__).parents[1] / "README.md"


def test_the_readme_runs(tmp_path, monkeypatch, folder, truth):
    for file in folder.iterdir():
        shutil.copy(file, tmp_path)
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    assert len(blocks) >= 4
    names = {}
    for block in blocks:
        exec(compile(block, str(README), "exec"), names)
    assert (tmp_path / "merged.yaml").is_file()
    assert abs(names["r"].transform.x - truth.x) < 0.1
    assert names["known"].map.shape == names["t"].components[0].map.shape
    assert names["refined"].termination == "converged"
