"""Merges the maps of a folder: one map for each group that hangs together.

    python folder.py MAPS OUT
"""

import sys
from pathlib import Path

import ogm_maps as ogm


def main(folder: Path, out: Path) -> None:
    maps = {path.name: ogm.load(path) for path in sorted(folder.glob("*.yaml"))}
    names = list(maps)
    t = ogm.merge(list(maps.values()))
    out.mkdir(exist_ok=True)
    for number, component in enumerate(t.components):
        component.map.save(out / f"group-{number}.yaml", overwrite=True)
        print(f"group {number}:")
        for member, pose in zip(component.members, component.poses):
            sure = t.probability(component.members[0], member)
            x, y, theta = pose
            print(f"  {names[member]}: {x:.3f} m, {y:.3f} m, {theta:.4f} rad, probability {sure}")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
