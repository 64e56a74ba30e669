#!/usr/bin/env python3
"""Every shipped problem from zero: sizes, counts and times, as docs/performance.md has them.

    python3 bench/shipped.py build/ambulo models RUNS > bench/results/MACHINE/shipped.csv

Seconds are processor seconds of `ambulo solve`, reading and writing included, the least of RUNS.
"""
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

program, folder, runs = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]), int(sys.argv[3])
os.environ["OPENBLAS_NUM_THREADS"] = "1"
print("problem,coordinates,unknowns,equalities,inequalities,calls,outer,inner,seconds,objective,verdict,ended_by,holds_between")
for path in sorted(folder.glob("*.yaml")):
    if "\nkind: problem" not in path.read_text():
        continue
    least, summary = float("inf"), None
    for _ in range(runs):
        with tempfile.TemporaryDirectory() as out:
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run([program, "solve", str(path), "-o", out + "/result", "--quiet", "--start", "zero"], check=False,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            summary = json.loads(pathlib.Path(out, "result", "summary.json").read_text())
            least = min(least, seconds)
    sizes, nlopt = summary["sizes"], summary["nlopt"]
    print(path.stem, sizes["coordinates"], sizes["variables"], sizes["equalities"], sizes["inequalities"],
          nlopt["calls"], nlopt["outer_iterations"], nlopt["inner_evaluations"], f"{least:.3f}",
          f"{summary['objective']['total']:.5f}", summary["verdict"], summary["ended_by"],
          summary["between_nodes"]["holds"], sep=",")
