"""What runs of `team_run.py` came to, as a table of Markdown.

table.py COMMAND DOCUMENT OUT-FOLDER …

Prints it, and puts it into the document between its marks.
"""

import json
import pathlib
import sys

import team_run

BEGIN, END = "<!-- BEGIN: teams -->", "<!-- END: teams -->"


def soon(runs, wall_m):
    waited = [late for run in runs for late in run[team_run.WAITED][str(wall_m)].values()]
    return f"{sum(late <= team_run.SOON_S for late in waited)} of {len(waited)}"


def row(name, runs):
    errors = [error for run in runs for error in run["errors m, deg"].values()]
    latency = sorted(run["latency median, max s"] for run in runs)
    medians = [f"{latency[0][0]:.2f}", f"{latency[-1][0]:.2f}"][: len(runs)]
    memory = [run["memory MB, thirds"] for run in runs]
    held = [run["memory MB, held: halves"] for run in runs if "memory MB, held: halves" in run]
    return [
        name,
        sum(run["robots"] for run in runs),
        sum(len(run["right after s"]) for run in runs),
        sum(len(run["wrong"]) for run in runs),
        *(soon(runs, wall_m) for wall_m in team_run.WALLS_M),
        f"{max(metres for metres, _ in errors):.3f}",
        f"{max(degrees for _, degrees in errors):.2f}",
        "–".join(medians),
        f"{max(most for _, most in latency):.1f}",
        max(max(it) for it in memory),
        " → ".join(map(str, held[0])) if held else "",
        f"{max(run['processors'] for run in runs):.2f}",
    ]


def main():
    command, document, *folders = sys.argv[1], *map(pathlib.Path, sys.argv[2:])
    runs = [json.loads((folder / "summary.json").read_text()) for folder in folders]
    rows = []
    for robots in sorted({run["robots"] for run in runs}):
        of = [run for run in runs if run["robots"] == robots]
        rows.append(row(f"{len(of)} of {robots}", of))
    rows.append(row(f"all {len(runs)}", runs))
    walls = [f"of {wall_m} m" for wall_m in team_run.WALLS_M]
    head = ["teams", "robots", "placed right", "wrong", *walls, "error, m", "°"]
    head += ["latency, s", "most", "memory, MB", "held", "processors"]
    lines = [head, ["---"] + ["--:"] * (len(head) - 1), *rows]
    table = "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)
    print(table)
    before, rest = document.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    text = f"{before}{BEGIN}\n\nWritten by `{command}`:\n\n{table}\n\n{END}{after}"
    document.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
