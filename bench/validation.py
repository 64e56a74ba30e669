#!/usr/bin/env python3
"""The tables and the picture of docs/validation.md: models/walk.yaml at five speeds beside people.

    python3 bench/validation.py build/ambulo [PICTURE.svg [PEOPLE]]

Curves are compared with models/norms, which are of people at a comfortable speed, and with the tables
in the folder PEOPLE (bench/fit_references.py) at theirs, whose values stand in brackets. The picture
needs matplotlib, the rest numpy.
"""
import csv, json, math, os, subprocess, sys, tempfile
import numpy

HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SPEEDS = [0.7, 0.9, 1.28, 1.72, 2.0]
PEOPLE = {0.9: "slow", 1.28: "usual", 1.72: "fast"}
MASS, WEIGHT = 75.0, 75.0 * 9.81
CURVES = ["pelvis_up_obliquity", "pelvis_internal_rotation", "hip_flexion", "hip_adduction",
          "knee_flexion", "ankle_dorsiflexion", "hip_extension_moment", "knee_extension_moment",
          "ankle_plantarflexion_moment", "grf_vertical", "grf_forward"]


def run(program, speed, folder, people):
    subprocess.run([program, "solve", os.path.join(HERE, "models", "walk.yaml"), "--set",
                    f"gait.speed={speed}", "-o", folder, "--force", "--quiet", "--samples", "401"],
                   check=False)
    with open(os.path.join(folder, "summary.json")) as file:
        summary = json.load(file)
    with open(os.path.join(folder, "motion.csv")) as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    table = numpy.array([[float(cell or "nan") for cell in row] for row in rows[1:]])
    table_of = [os.path.join(people, PEOPLE[speed] + ".csv")] if people and speed in PEOPLE else []
    scores = subprocess.run([program, "compare", folder, *table_of, "--json"], check=False,
                            capture_output=True, text=True)
    return summary, {name: table[:, i] for i, name in enumerate(rows[0])}, \
        json.loads(scores.stdout)["curves"]


def cycle(summary, motion):
    """The right foot's stride in 1001 points: what each name is at a percent of it."""
    start = [s["time"] for s in summary["strikes"] if s["foot"] == "right"][0]
    time = motion["time"]
    at = numpy.mod(start + numpy.linspace(0.0, 1.0, 1001) * time[-1], time[-1])
    return lambda name: numpy.interp(at, time, numpy.nan_to_num(motion[name]))


def measure(summary, motion):
    get = cycle(summary, motion)
    part = lambda low, high: slice(int(10 * low), int(10 * high) + 1)
    force = get("grf.right.y") / WEIGHT
    knee = numpy.degrees(get("q.knee_angle_r"))
    ankle = -get("tau.ankle_angle_r") / MASS
    power = get("tau.ankle_angle_r") * get("qd.ankle_angle_r") / MASS
    both = get("grf.right.y") + get("grf.left.y")
    return {
        "knee at strike, deg": knee[0], "knee, loading, deg": knee[part(0, 25)].max(),
        "knee, swing, deg": knee[part(55, 100)].max(),
        "vertical force, first peak, BW": force[part(5, 26)].max(),
        "vertical force, valley, BW": force[part(20, 42)].min(),
        "vertical force, second peak, BW": force[part(36, 60)].max(),
        "front foot's share at 4 % of the stride": get("grf.right.y")[40] / both[40],
        "dorsiflexor moment after strike, N m/kg": max(0.0, -ankle[part(0, 15)].min()),
        "ankle power, peak, W/kg": power.max(),
        "positive work, J/(kg m)": summary["work"]["positive_per_kg_metre"],
        "centre of mass, rise, cm": 100 * summary["center_of_mass"]["rise"],
        "centre of mass, sway, cm": 100 * summary["center_of_mass"]["sway"],
        "pelvis list, range, deg": numpy.degrees(numpy.ptp(get("q.pelvis_list"))),
        "hip adduction, range, deg": numpy.degrees(numpy.ptp(get("q.hip_adduction_r"))),
        "step length, m": summary["gait"]["step_length"],
        "objective": summary["objective"]["total"],
    }


def measure_people(folder, speed):
    if not folder or speed not in PEOPLE:
        return {}
    with open(os.path.join(folder, PEOPLE[speed] + ".csv")) as file:
        rows = list(csv.DictReader(file))
    get = lambda name: numpy.array([float(row[name]) for row in rows])
    knee, force = get("knee_flexion"), get("grf_vertical") / 9.81
    moment, power = get("ankle_plantarflexion_moment"), get("ankle_power")
    return {"knee at strike, deg": knee[0], "knee, loading, deg": knee[:26].max(),
            "knee, swing, deg": knee[55:].max(),
            "vertical force, first peak, BW": force[5:27].max(),
            "vertical force, valley, BW": force[20:43].min(),
            "vertical force, second peak, BW": force[36:61].max(),
            "dorsiflexor moment after strike, N m/kg": max(0.0, -moment[:16].min()),
            "ankle power, peak, W/kg": power.max(),
            "pelvis list, range, deg": numpy.ptp(get("pelvis_up_obliquity")),
            "hip adduction, range, deg": numpy.ptp(get("hip_adduction"))}


def beside(runs):
    """r and rmse of each curve against people at that speed, or at a comfortable one"""
    rows = []
    for curve in CURVES:
        cells = []
        for speed, (_, _, scores) in runs.items():
            score = scores.get(curve)
            cells.append(f"{score['r']:.2f}, {score['rmse']:.2g}" if score else "–")
        rows.append([curve] + cells)
    return rows


def print_table(head, rows):
    print("| " + " | ".join(head) + " |\n| --- |" + " ---: |" * (len(head) - 1))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


PANELS = [("pelvis_list", -1, "q.pelvis_list", "pelvis, this side up, deg", "pelvic_obliquity"),
          ("pelvis_rotation", 1, "q.pelvis_rotation", "pelvis, this side forward, deg", None),
          ("hip_flexion", 1, "q.hip_flexion_r", "hip flexion, deg", "hip_flexion"),
          ("hip_adduction", 1, "q.hip_adduction_r", "hip adduction, deg", "hip_adduction"),
          ("knee", 1, "q.knee_angle_r", "knee flexion, deg", "knee_flexion"),
          ("ankle", 1, "q.ankle_angle_r", "ankle dorsiflexion, deg", "ankle_dorsiflexion"),
          ("hip_moment", -1, "tau.hip_flexion_r", "hip extension, N m/kg", None),
          ("knee_moment", -1, "tau.knee_angle_r", "knee extension, N m/kg", None),
          ("ankle_moment", -1, "tau.ankle_angle_r", "plantarflexion, N m/kg", None),
          ("ankle_power", 1, "power", "ankle power, W/kg", None),
          ("vertical", 1, "grf.right.y", "vertical force, BW", None),
          ("forward", 1, "grf.right.x", "forward force, BW", None)]
TILT = 11.4  # deg, docs/compare.md


def norms():
    people = {}
    with open(os.path.join(HERE, "models", "norms", "young_adults.csv")) as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        for row in rows:
            people.setdefault(row["variable"], []).append(
                [float(row["percent"]), float(row["mean_deg"]), float(row["sd_deg"])])
    return {name: numpy.array(sorted(rows)) for name, rows in people.items()}


def draw(runs, path):
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"font.size": 8, "svg.fonttype": "none", "svg.hashsalt": "ambulo"})
    import matplotlib.pyplot as plot
    figure, axes = plot.subplots(4, 3, figsize=(9, 9.5))
    people, percent = norms(), numpy.linspace(0.0, 100.0, 1001)
    for axis, (_, sign, name, title, norm) in zip(axes.flat, PANELS):
        band = people.get(norm or {"q.pelvis_rotation": "pelvic_rotation"}.get(name))
        if band is not None:
            axis.fill_between(band[:, 0], band[:, 1] - band[:, 2], band[:, 1] + band[:, 2],
                              color="0.85", linewidth=0)
        for i, (speed, (summary, motion, _)) in enumerate(runs.items()):
            get = cycle(summary, motion)
            if name == "power":
                y = get("tau.ankle_angle_r") * get("qd.ankle_angle_r") / MASS
            else:
                y = sign * get(name)
                y = numpy.degrees(y) if name[0] == "q" else \
                    y / (MASS if name[0] == "t" else WEIGHT)
            if name == "q.hip_flexion_r":
                y = y + TILT
            axis.plot(percent, y, color=plot.cm.viridis(i / 4.6), linewidth=1.1,
                      label=f"{speed} m/s")
        axis.set_title(title, fontsize=8)
        axis.set_xlim(0, 100)
        axis.grid(alpha=0.25, linewidth=0.5)
    axes.flat[-1].legend(fontsize=7, frameon=False)
    for axis in axes[-1]:
        axis.set_xlabel("% of the stride")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def main():
    program = os.path.abspath(sys.argv[1])
    people = sys.argv[3] if len(sys.argv) > 3 else None
    with tempfile.TemporaryDirectory() as folder:
        runs = {v: run(program, v, os.path.join(folder, f"v{v}"), people) for v in SPEEDS}
    measured = {v: measure(summary, motion) for v, (summary, motion, _) in runs.items()}
    theirs = {v: measure_people(people, v) for v in SPEEDS}
    rows = [["verdict"] + [runs[v][0]["verdict"] for v in SPEEDS]]
    for name in measured[SPEEDS[0]]:
        rows.append([name] + [f"{measured[v][name]:.3g}"
                              + (f" ({theirs[v][name]:.3g})" if name in theirs[v] else "")
                              for v in SPEEDS])
    print_table(["m/s"] + [str(v) for v in SPEEDS], rows)
    print_table(["r, rmse"] + [str(v) for v in SPEEDS], beside(runs))
    if len(sys.argv) > 2 and sys.argv[2] != "-":
        draw(runs, sys.argv[2])


if __name__ == "__main__":
    main()
