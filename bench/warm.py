#!/usr/bin/env python3
"""Solves beside a solved problem, in turns with the same from zero: iterations and processor seconds.

    python3 bench/warm.py build/ambulo WORK [OUT.csv]

Each line of the table is a shipped problem with one number changed. It is solved from zero, and from
the solution of the problem as it is shipped, whose control points and multipliers its solution.yaml
has. Seconds are of the whole command, with files and audit. The last line is a chain of twenty
people, each from the one before.
"""

import json
import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path

CHANGES = [
    ("walk", "gait.speed", 1.2813), ("walk", "gait.speed", 1.293), ("walk", "gait.speed", 1.344),
    ("walk", "subject.stature", 1.76), ("walk", "subject.mass", 80), ("walk", "time.intervals", 120),
    ("walk_normal", "gait.step_length", 0.6868), ("walk_uphill", "gait.step_length", 0.6666),
    ("walk_loaded", "gait.step_length", 0.6868), ("walk_whole_body", "gait.speed", 1.293),
    ("walk_whole_body_45", "gait.speed", 1.293), ("walk_knee_brace", "gait.speed", 1.293),
    ("run", "gait.speed", 3.03), ("run", "gait.speed", 3.15),
]
PEOPLE = [(62 + 1.3 * i, 1.58 + 0.015 * i) for i in range(20)]


def solve(program, problem, overrides, folder, start=None):
    """Iterations, processor seconds, objective, verdict."""
    command = [program, "solve", f"models/{problem}.yaml", "-o", str(folder), "--force", "--quiet"]
    for name, value in overrides:
        command += ["--set", f"{name}={value}"]
    if start:
        command += ["--start", str(start / "solution.yaml")]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, env=dict(os.environ, OPENBLAS_NUM_THREADS="1"), stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    summary = json.loads((folder / "summary.json").read_text())
    return summary["iterations"], seconds, summary["objective"]["total"], summary["verdict"]


def line(out, name, cold, warm):
    gain = 100 * (warm[2] / cold[2] - 1)
    text = (f"{name},{cold[0]},{cold[1]:.3f},{warm[0]},{warm[1]:.3f},{gain:+.3f},"
            f"{cold[3]},{warm[3]}")
    print(text, flush=True)
    out.write(text + "\n")


def chain(program, work, warm):
    total, previous = [0, 0.0, 0.0, ""], None
    for i, (mass, stature) in enumerate(PEOPLE):
        folder = work / f"person_{i}"
        found = solve(program, "walk", [("subject.mass", mass), ("subject.stature", stature)], folder,
                      previous if warm else None)
        total = [total[0] + found[0], total[1] + found[1], total[2] + found[2], found[3]]
        previous = folder
    return total


def main():
    program, work = sys.argv[1], Path(sys.argv[2])
    work.mkdir(parents=True, exist_ok=True)
    with open(sys.argv[3] if len(sys.argv) > 3 else os.devnull, "w") as out:
        out.write("change,cold iterations,cold s,warm iterations,warm s,objective %,cold,warm\n")
        for problem in dict.fromkeys(c[0] for c in CHANGES):
            solve(program, problem, [], work / problem)
        for problem, name, value in CHANGES:
            changed = [(name, value)]
            cold = solve(program, problem, changed, work / "cold")
            warm = solve(program, problem, changed, work / "warm", work / problem)
            line(out, f"{problem} {name}={value}", cold, warm)
        line(out, "twenty people in a chain", chain(program, work, False), chain(program, work, True))
    shutil.rmtree(work)


main()
