#!/usr/bin/env python3
"""Solves the yardstick by CasADi + IPOPT and by ambulo, in turn, and compares.

    ipopt.py FOLDER AMBULO MODELS N...

FOLDER holds gait_ipopt.py, an independent statement of the yardstick with exact Hessians;
AMBULO is the program, MODELS the folder of yardstick_N.yaml. Times are processor seconds:
IPOPT's of the solve alone, ours of the whole command, files included.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

time.perf_counter = time.process_time  # the other statement then reports processor seconds
sys.path.insert(0, sys.argv[1])
import gait_ipopt  # noqa: E402


def ours(program, models, intervals):
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([program, "solve", f"{models}/yardstick_{intervals}.yaml", "--start", "zero", "--quiet",
                        "--force", "-o", folder + "/out"], check=False,
                       stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        with open(folder + "/out/summary.json") as file:
            summary = json.load(file)
    seconds = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return summary, seconds


def main():
    program, models = sys.argv[2:4]
    print(f"{'N':>4} {'IPOPT s':>9} {'objective':>10} {'ambulo s':>9} {'objective':>10}"
          f" {'verdict':>9} {'faster':>7}")
    for intervals in (int(word) for word in sys.argv[4:]):
        result = gait_ipopt.solve(intervals, None, "exact")[0]
        runs = [ours(program, models, intervals) for _ in range(3)]
        summary, seconds = sorted(runs, key=lambda run: run[1])[1]
        print(f"{intervals:4d} {result['solve_s']:9.2f} {result['f']:10.5f} {seconds:9.3f}"
              f" {summary['objective']['total']:10.5f} {summary['verdict']:>9}"
              f" {result['solve_s'] / seconds:6.1f}x", flush=True)
        if result["status"] != "Solve_Succeeded":
            print(f"     (IPOPT: {result['status']})")


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    main()
