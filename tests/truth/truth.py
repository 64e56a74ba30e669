"""make truth: are the motions of Ambulo possible for a body?

Solves problems, rebuilds every motion from its model file and its control points in Pinocchio, and prints
a table: a row a problem, a column a question, BOUNDS at the top of it. A cell outside its bound has a `*`,
and what is wrong stands below the table. Exit code 1 if there is any. Nothing here uses Ambulo's library:
only files of problems, models and results are read.

    truth.py [--ambulo PROGRAM] [--models FOLDER] [--results FOLDER] [--markdown FILE] [--jobs N] [--keep]
             [PROBLEM...]

PROBLEM is the name of a shipped problem (walk) or a file; without any, all of --models. --keep takes
results that are in --results already. Seconds are those of a processor, with reading and writing.
"""

import argparse
import concurrent.futures
import glob
import os
import resource
import subprocess
import sys
import traceback

FINER = 10  # times for each node
# what is asked, its unit, how it is written, the bound
COLUMNS = [
    ("spline", "", ".0e", 1e-9, "the table's q, qd, qdd are those of the control points, relative"),
    ("torque", "", ".0e", 1e-9, "torques, relative to the largest"),
    ("root", "BW", ".0e", 1e-9, "forces and moments (times 1 m) at the root that nothing exerts, while something is in contact"),
    ("energy", "", ".0e", 1e-7, "power of torques, ground, hands and devices less dE/dt, relative to the largest sum of powers"),
    ("cone", "BW", ".4f", 1e-3, "friction: tangential force beyond mu times the normal force"),
    ("pull", "BW", ".4f", 0.005, "normal force below zero"),
    ("pressure", "mm", ".1f", 1.0, "centre of pressure outside the sole at its pitch, above .05 body weights"),
    ("ground work", "%", ".2f", 1.0, "work of the ground, of the joints' positive work"),
    ("overlap", "mm", ".0f", 1.0, "largest overlap of two solids"),
    ("flight force", "BW", ".4f", 0.002, "force in flight"),
    ("flight momentum", "kg m²/s", ".3f", 0.05, "change of angular momentum in flight"),
    ("flight energy", "J", ".2f", 0.3, "work of what is missing in flight"),
    ("slip", "mm", ".2f", 3.0, "largest way of a held point along the ground"),
    ("sinks", "mm", ".2f", 2.0, "deepest point of a sole in the ground"),
    ("devices", "", ".0e", 1e-6, "efforts of devices against their law, relative"),
    ("held", "BW", ".0e", 1e-6, "wrench of hands against what their load needs"),
    ("joint limits", "deg", ".2f", 0.3, "beyond the range of a joint"),
    ("torque limits", "%", ".1f", 1.0, "beyond the strength of a joint"),
]


def main():
    arguments = parse()
    missing = [name for name in ("numpy", "pinocchio") if not importable(name)]
    if missing:
        print(f"skipped: make truth (no Python with {' and '.join(missing)}; `make setup-truth` installs it)")
        print("[  SKIPPED ]")
        return 0
    problems = chosen(arguments)
    os.makedirs(arguments.results, exist_ok=True)
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        rows = list(pool.map(row_of, problems, [arguments] * len(problems)))
    print(text(rows))
    if arguments.markdown:
        with open(arguments.markdown, "w", encoding="utf-8") as file:
            file.write(markdown(rows))
    return any(faults(row) for row in rows)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ambulo", default="build/ambulo")
    parser.add_argument("--models", default="models")
    parser.add_argument("--results", default="build/truth")
    parser.add_argument("--markdown")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("problems", nargs="*")
    return parser.parse_args()


def importable(name):
    try:
        __import__(name)
    except ImportError:
        return False
    return True


def chosen(arguments):
    names = arguments.problems or sorted(glob.glob(os.path.join(arguments.models, "*.yaml")))
    files = [n if n.endswith(".yaml") else os.path.join(arguments.models, n + ".yaml") for n in names]
    return [f for f in files if any(line.strip() == "kind: problem" for line in open(f, encoding="utf-8"))]


# ------------------------------------------------------------------------ a row

def row_of(problem, arguments):
    """{column: (value, where) or None}, with the name, what the solve said, its seconds."""
    row = {"name": os.path.splitext(os.path.basename(problem))[0], "cells": {}, "verdict": "", "seconds": None}
    try:
        folder = solve(problem, row["name"], arguments)
        examine(problem, folder, row)
    except Exception as error:  # one problem must not hide the others; the row says what happened
        row["error"] = f"{type(error).__name__}: {error}"
        if not isinstance(error, ValueError):
            row["error"] += "\n" + traceback.format_exc()
    return row


def solve(problem, name, arguments):
    """The result folder, whose table has FINER times the nodes of the solve."""
    folder = os.path.join(arguments.results, name)
    if arguments.keep and os.path.exists(os.path.join(folder, "motion.csv")):
        return folder
    import strict_yaml
    said = strict_yaml.load(problem)
    stride = 2 if (said.get("ends") or {}).get("kind") == "mirrored" else 1
    samples = stride * FINER * said["time"]["intervals"] + 1
    words = [arguments.ambulo, "solve", problem, "-o", folder, "--force", "-q", "--samples", str(samples)]
    before = processor_time()
    done = subprocess.run(words, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"}, capture_output=True, text=True)
    if done.returncode > 1:
        raise ValueError(f"ambulo solve ended with {done.returncode}: {done.stderr.strip()}")
    with open(folder + ".seconds", "w", encoding="utf-8") as file:
        file.write(f"{processor_time() - before:.3f}\n")
    return folder


def processor_time():
    """Of children so far: unlike the time of the clock, what else runs hardly matters."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def examine(problem, folder, row):
    import dynamics
    import flight
    import ground
    import limits
    import motion
    import sole
    import solids
    import devices

    m = motion.Motion(problem, folder)
    row["verdict"] = m.summary["verdict"]
    row["between"] = (m.summary.get("between_nodes") or {}).get("holds")
    if os.path.exists(folder + ".seconds"):
        with open(folder + ".seconds", encoding="utf-8") as file:
            row["seconds"] = float(file.read())
    for part in (dynamics, ground, flight, sole, solids, devices, limits):
        for name, cell in part.check(m).items():
            row["cells"][name] = None if cell is None else cell if isinstance(cell, tuple) else (float(cell), "")


def beyond(column, cell):
    return cell is not None and not cell[0] <= column[3]  # NaN is outside


def faults(row):
    """(column, cell) outside their bound."""
    wrong = [(column, row["cells"].get(column[0])) for column in COLUMNS]
    wrong = [(column, cell) for column, cell in wrong if beyond(column, cell)]
    return wrong + ([("error", row["error"])] if "error" in row else [])


# -------------------------------------------------------------------- the table

def written(column, row):
    cell = row["cells"].get(column[0])
    if cell is None:
        return "–"
    number = format(cell[0], column[2])
    return number + ("*" if beyond(column, cell) else "")


def heading(column):
    return column[0] + (f" ({column[1]})" if column[1] else "")


def grid(rows):
    """Lines of cells: heads, bounds, problems."""
    lines = [["problem", "verdict", "s"] + [heading(c) for c in COLUMNS],
             ["at most", "", ""] + [f"{c[3]:g}" for c in COLUMNS]]
    for row in rows:
        verdict = row["verdict"] + ("" if row.get("between", 1) else ", not between")
        seconds = "" if row["seconds"] is None else f"{row['seconds']:.2f}"
        lines.append([row["name"], verdict, seconds] + [written(c, row) for c in COLUMNS])
    return lines


def text(rows):
    """Columns under heads of two words' height, and what is wrong."""
    lines = grid(rows)
    heads = [h.split(" ", 1) if i > 2 else [h] for i, h in enumerate(lines[0])]
    upper, lower = [h[0] for h in heads], [h[1] if len(h) > 1 else "" for h in heads]
    lines = [upper, lower] + lines[1:]
    widths = [max(len(line[i]) for line in lines) for i in range(len(upper))]
    out = [f"{c[0]:16} {c[4]}" for c in COLUMNS] + [""]
    for line in lines:
        out.append("  ".join(x.ljust(w) if i < 2 else x.rjust(w) for i, (x, w) in enumerate(zip(line, widths))).rstrip())
    count = sum(len(faults(row)) for row in rows)
    seconds = sum(row["seconds"] or 0 for row in rows)
    out += ["", f"{len(rows)} problems, solved in {seconds:.1f} processor seconds; {count} cells outside their bound"]
    for row in rows:
        for column, cell in faults(row):
            out.append(f"  {row['name']:24} " + (f"{column[0]:16} {format(cell[0], column[2])} {column[1]}  {cell[1]}"
                                                 if column != "error" else cell))
    return "\n".join(out)


def markdown(rows):
    lines = grid(rows)
    ruled = [lines[0], ["---", "---"] + ["---:"] * (len(lines[0]) - 2)] + lines[1:]
    return "".join("| " + " | ".join(line) + " |\n" for line in ruled)


if __name__ == "__main__":
    sys.exit(main())
