#!/usr/bin/env python3
"""Muscles of a measured and of predicted walks: tables and figures of docs/guide-muscles.md.

usage: muscle_validation.py AMBULO MEASURED OUT [--activation A] [--metabolic B] [--lag SECONDS]

MEASURED is the folder OpenSim/Examples/Moco/example3DWalking of opensim-core (Apache-2.0), of which
subject_walk_scaled.osim, coordinates.sto, grf_walk.mot and electromyography.sto are read:

    git clone --depth 1 https://github.com/opensim-org/opensim-core
    python3 bench/muscle_validation.py build/ambulo opensim-core/OpenSim/Examples/Moco/example3DWalking out

Needs numpy and matplotlib; takes about a minute.

1. The measured walk: the imported body gets the bodies' axes (the ankle about the shank's Z, a subtalar joint
   about the foot's X through the same centre) and link names; the measured turn of the foot is taken apart
   along these axes. Inverse dynamics, muscles, one right stride.
2. EMG: Pearson's r of each channel, LAG later, with the activation of its muscles (means by volume).
3. Contact forces of this walk and of walk.yaml at 1.28 m/s; cost of transport at 0.6 to 2.0 m/s.
4. Net metabolic cost of walk.yaml under other conditions beside people's (bench/walking_cost.py).

Writes to OUT: tables to standard output, muscles_emg.svg, muscles_contact.svg, muscles_transport.svg.
"""
import argparse
import json
import pathlib
import re
import subprocess

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from walking_cost import CHANGES  # noqa: E402

MODELS = pathlib.Path(__file__).resolve().parent.parent / "models"
STRIKE, STRIDE = 0.267, 1.1445   # s: a right strike of the measured walk, and its stride
WINDOW = (0.4545, 1.599)         # s: one stride of what was measured
FILTER = "6"                     # Hz
KNEE = 0.15                      # rad: where the knee's slides and turns are frozen, as in stance
ROWS = 5                         # each fifth row is drawn
SPEEDS = [0.6, 0.8, 1.0, 1.1, 1.2, 1.28, 1.4, 1.6, 1.8, 2.0]
CHANNELS = {"soleus": "soleus", "gastrocnemius": "gasmed gaslat", "tibialis_anterior": "tibant",
            "medial_hamstrings": "semimem semiten", "biceps_femoris": "bflh", "vastus_lateralis": "vaslat",
            "vastus_medius": "vasmed", "rectus_femoris": "recfem", "gluteus_maximus": "glmax1 glmax2 glmax3",
            "gluteus_medius": "glmed1 glmed2 glmed3"}
DOUBTFUL = {"biceps_femoris", "rectus_femoris", "gluteus_maximus"}  # noise or cross-talk: emg_notes.md
JOINTS = {"hip": (2.4, 3.2), "knee": (2.2, 2.8), "ankle": None}      # instrumented joints, peaks, body weights
STYLE = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "ambulo",
         "svg.fonttype": "path", "axes.linewidth": 0.7}


# ---------------------------------------------------------------- tables

def read_table(path):
    """Columns of a CSV of ambulo or of a STO or MOT file."""
    lines = [line for line in pathlib.Path(path).read_text().split("\n") if line and line[0] != "#"]
    first = next(i for i, line in enumerate(lines) if re.split(r"[,\t]", line)[0].strip() == "time")
    names = [name.strip() for name in re.split(r"[,\t]", lines[first])]
    rows = np.array([[float(x) for x in re.split(r"[,\t ]+", line.strip())] for line in lines[first + 1:]])
    return dict(zip(names, rows.T))


def write_sto(path, columns):
    names = list(columns)
    with open(path, "w") as file:
        file.write(f"Coordinates\nversion=1\nnRows={len(columns['time'])}\nnColumns={len(names)}\n"
                   "inDegrees=no\nendheader\n" + "\t".join(names) + "\n")
        for row in np.array([columns[name] for name in names]).T:
            file.write("\t".join(f"{x:.10g}" for x in row) + "\n")


def cut_rows(source, target, start, end):
    kept = [line for line in pathlib.Path(source).read_text().split("\n")
            if line and (not line[0].isdigit() or start <= float(line.split(",")[0]) <= end)]
    pathlib.Path(target).write_text("\n".join(kept) + "\n")


# ---------------------------------------------------------------- the measured walk

def run(*arguments):
    return subprocess.run([str(a) for a in arguments], check=True, capture_output=True, text=True).stdout


def aligned_body(imported):
    """The imported model with the links and foot joints that leg_muscles.yaml knows, and the old ankle's axis."""
    text, axis = imported, None
    for side, sign, other in (("r", 1, "l"), ("l", -1, "r")):
        text = text.replace(f"femur_{side}", f"thigh_{side}").replace(f"tibia_{side}", f"shank_{side}")
        ankle = re.search(rf"  - \{{name: talus_{side}, parent: shank_{side}, joint: revolute,\n"
                          r"     origin: \{xyz: (\[.*?\])\}, axis: (\[.*?\]),", text)
        axis = axis or json.loads(ankle[2])
        text = text.replace(ankle[0], f"  - {{name: ankle_{side}, parent: shank_{side}, joint: fixed,\n"
                            f"     origin: {{xyz: {ankle[1]}}}}}\n"
                            f"  - {{name: talus_{side}, parent: ankle_{side}, joint: revolute,\n"
                            "     origin: {xyz: [0, 0, 0]}, axis: [0, 0, 1],")
        heel = re.search(rf"  - \{{name: calcn_{side}, parent: talus_{side}, joint: fixed,", text)
        text = text.replace(heel[0], f"  - {{name: subtalar_{side}, parent: talus_{side}, joint: revolute,\n"
                            f"     origin: {{xyz: [0, 0, 0]}}, axis: [{sign}, 0, 0],\n"
                            f"     coordinate: {{name: subtalar_angle_{side}, range: [-20, 20], "
                            f"mirror: subtalar_angle_{other}}}}}\n"
                            f"  - {{name: calcn_{side}, parent: subtalar_{side}, joint: fixed,")
    return text, np.array(axis)


def rotation(axis, angle):
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle)[:, None, None] * cross + (1 - np.cos(angle))[:, None, None] * cross @ cross


def aligned_motion(columns, axis):
    """R(axis, q) = Rz(ankle) Rx(subtalar) Ry(rest); the rest, up to 3 degrees, is dropped."""
    named = {name.split("/")[-2] if "/" in name else name: values for name, values in columns.items()}
    for side, mirror, sign in (("r", [1, 1, 1], 1), ("l", [-1, -1, 1], -1)):
        turn = rotation(axis * mirror, named[f"ankle_angle_{side}"])
        named[f"ankle_angle_{side}"] = np.arctan2(-turn[:, 0, 1], turn[:, 1, 1])
        named[f"subtalar_angle_{side}"] = sign * np.arcsin(turn[:, 2, 1])
        named[f"mtp_angle_{side}"] = 0 * turn[:, 0, 0]
        named.pop(f"knee_angle_{side}_beta", None)
    return named


def measured_walk(ambulo, folder, out, prices):
    feet = [part for foot, side in (("right", "r"), ("left", "l"))
            for part in ("--heel", f"{foot}=calcn_{side}:0,0,0", "--toe", f"{foot}=calcn_{side}:0.18,0,0")]
    pose = ["--pose", f"knee_angle_r={KNEE}", "--pose", f"knee_angle_l={KNEE}"]
    text, axis = aligned_body(run(ambulo, "import", folder / "subject_walk_scaled.osim", *pose, *feet))
    (out / "body.yaml").write_text(text)
    write_sto(out / "motion.sto", aligned_motion(read_table(folder / "coordinates.sto"), axis))
    run(ambulo, "inverse", out / "body.yaml", out / "motion.sto", "--grf", folder / "grf_walk.mot", "--filter", FILTER,
        "--grf-filter", FILTER, "--force-columns", "right=ground_force_r,left=ground_force_l", "--force",
        "-o", out / "torques.csv")
    cut_rows(out / "torques.csv", out / "stride.csv", *WINDOW)
    return analysis(ambulo, out / "body.yaml", out / "stride.csv", out / "measured.csv", prices)


def analysis(ambulo, body, motion, table, prices, *options):
    """The table of muscles and the lines that the command prints."""
    text = run(ambulo, "muscles", body, motion, "--muscles", MODELS / "leg_muscles.yaml",
               *prices, "--force", "-o", table, *options)
    numbers = {key: [float(x) for x in re.findall(r"-?\d+\.\d+", line)]
               for line in text.split("\n")[:4] for key in [line.split(" ")[0]]}
    return read_table(table), numbers


def predicted_walk(ambulo, speed, out, prices):
    problem, folder = MODELS / "walk.yaml", out / f"walk_{speed}"
    options = ["--set", f"gait.speed={speed}"]
    run(ambulo, "solve", problem, *options, "-o", folder, "--force")
    return analysis(ambulo, problem, folder, out / f"walk_{speed}.csv", prices, *options)


# ---------------------------------------------------------------- other conditions

def loaded(link, mass, place):
    both = [f"{{link: {link}_{side}, mass: {mass}, position: {place}}}" for side in "rl"]
    return ["load=[" + ", ".join(both) + "]"]


def trunk(mass):
    return [f"load={{link: thorax, mass: {mass}, position: [0, 0.25, 0]}}"]


SHANK, FOOT, STEP = "[0, -0.1917, 0]", "[0.0546, -0.045, 0]", 0.542  # step: s, on the level at 1.25 m/s
CONDITIONS = {"trunk_8": trunk(8), "trunk_16": trunk(16),
              "shank_2": loaded("shank", 2, SHANK), "shank_4": loaded("shank", 4, SHANK),
              "foot_2": loaded("foot", 2, FOOT), "foot_4": loaded("foot", 4, FOOT),
              "width_0.2": ["gait.step_width=0.2"], "width_0.3": ["gait.step_width=0.3"],
              "incline_-8": ["ground.slope=-4.574"], "incline_8": ["ground.slope=4.574"]}
CONDITIONS.update({f"cadence_{change}": [f"gait.step_time={STEP / (1 + change / 100):.4f}"]
                   for change in (-20, -10, 10, 20)})


def metabolic(ambulo, settings, out, prices):
    """Gross power by both models, W/kg."""
    options = [part for setting in ["gait.speed=1.25", *settings] for part in ("--set", setting)]
    run(ambulo, "solve", MODELS / "walk.yaml", *options, "-o", out / "condition", "--force")
    text = run(ambulo, "muscles", MODELS / "walk.yaml", out / "condition", *options, "--json", *prices)
    found = json.loads(text)["metabolic"]
    return np.array([found["bhargava"], found["umberger"]]), found["resting"]


def print_conditions(ambulo, out, prices):
    level, resting = metabolic(ambulo, [], out, prices)
    print("level, 1.25 m/s", level, "W/kg gross")
    for name, settings in CONDITIONS.items():
        at_rest = 0.0 if name.startswith("incline") else resting  # people's numbers of slopes are gross
        gross, _ = metabolic(ambulo, settings, out, prices)
        change = 100 * ((gross - at_rest) / (level - at_rest) - 1)
        print(f"{name:12s} {change[0]:+4.0f} % {change[1]:+4.0f} %  people {100 * CHANGES[name]:+4.0f} %")


# ---------------------------------------------------------------- comparison

def volumes(ambulo):
    text = (MODELS / "leg_muscles.yaml").read_text()
    found = re.findall(r"- name: (\w+)_r\n.*?force: ([\d.]+).*?fiber: ([\d.]+)", text, re.S)
    return {name: float(force) * float(fiber) for name, force, fiber in found}


def with_seam(phase, *values):
    """Every ROWS-th row, with a gap where the window's end and its start meet."""
    seam = (WINDOW[0] - STRIKE) % STRIDE / STRIDE * 100
    kept = [np.array(x[::ROWS], float) for x in (phase, *values)]
    at = np.searchsorted(kept[0], seam)
    return [np.insert(x, at, np.nan) for x in kept]


def activation_of(table, muscles, volume):
    share = np.array([volume[name] for name in muscles])
    return share @ np.array([table[f"activation.{name}_r"] for name in muscles]) / share.sum()


def compare_emg(table, emg, volume, lag):
    """channel: phase of the right stride in %, activation, EMG of `lag` ago, r; rows in order of phase"""
    phase = (table["time"] - STRIKE) % STRIDE / STRIDE * 100
    order, result = np.argsort(phase), {}
    for channel, muscles in CHANNELS.items():
        own = activation_of(table, muscles.split(), volume)[order]
        other = np.interp(table["time"] - lag, emg["time"], emg[channel])[order]
        result[channel] = (phase[order], own, other, np.corrcoef(own, other)[0, 1])
    return result


def contact(table, strike, stride, weight):
    """joint: phase in %, size of the contact force of the right leg in body weights"""
    phase = (table["time"] - strike) % stride / stride * 100
    order = np.argsort(phase)
    return {joint: (phase[order], np.sqrt(sum(table[f"contact.{joint}_r.{axis}"] ** 2 for axis in "xyz"))[order]
                    / weight) for joint in JOINTS}


def right_strike(motion):
    columns = read_table(motion)
    up = columns["grf.right.y"] > 20
    first = np.flatnonzero(up[1:] & ~up[:-1])[0] + 1
    return columns["time"][first], columns["time"][-1] - columns["time"][0]


# ---------------------------------------------------------------- figures

def draw_activations(compared, lag, path):
    figure, axes = plt.subplots(5, 2, figsize=(8.333, 8), dpi=100, sharex=True)
    for axis, (channel, (phase, own, other, r)) in zip(axes.T.flat, compared.items()):
        x, line, area = with_seam(phase, own / own.max(), other / other.max())
        axis.fill_between(x, 0, area, color="0.85", lw=0)
        axis.plot(x, line, color="#b2182b", lw=1.5)
        doubt = " (doubtful signal)" if channel in DOUBTFUL else ""
        axis.set_title(f"{channel.replace('_', ' ')}, r = {r:.2f}, largest {own.max():.2f}{doubt}", fontsize=8.5,
                       loc="left")
        axis.set(xlim=(0, 100), ylim=(0, 1.05), yticks=[0, 1])
        axis.axvline(66, color="0.6", lw=0.6, ls=":")
    for axis in axes[-1]:
        axis.set_xlabel("right stride, %")
    figure.suptitle(f"Activation (red) and EMG {1e3 * lag:.0f} ms before (grey), each by its largest value;"
                    " dotted: toe-off; gap: ends of the record", fontsize=9, x=0.02, ha="left")
    figure.tight_layout(rect=(0, 0, 1, 0.98))
    save(figure, path)


def draw_contact(curves, path):
    figure, axes = plt.subplots(1, 3, figsize=(8.333, 3.2), dpi=100, sharey=True)
    for axis, joint in zip(axes, JOINTS):
        if JOINTS[joint]:
            axis.axhspan(*JOINTS[joint], color="0.9", lw=0)
            axis.text(99, JOINTS[joint][1] + 0.08, "peaks of\nimplants", fontsize=7, ha="right",
                      color="0.4")
        for (label, curve), color in zip(curves.items(), ("black", "#2166ac")):
            drawn = with_seam(*curve[joint]) if label.startswith("measured") else curve[joint]
            axis.plot(*drawn, color=color, lw=1.5, label=label)
        axis.set_title(joint, loc="left")
        axis.set(xlim=(0, 100), ylim=(0, 8), xlabel="right stride, %")
    axes[0].set_ylabel("contact force, body weights")
    axes[0].legend(frameon=False, fontsize=8, loc="upper right")
    figure.tight_layout()
    save(figure, path)


def draw_transport(found, path):
    figure, axis = plt.subplots(figsize=(8.333, 3.6), dpi=100)
    for k, (label, color) in enumerate((("Bhargava et al. (2004)", "#2166ac"), ("Umberger et al. (2003)", "#b2182b"))):
        cost = [found[speed]["transport"][k] for speed in SPEEDS]
        axis.plot(SPEEDS, cost, "o-", color=color, lw=1.5, ms=4, label=label)
        axis.plot(SPEEDS[int(np.argmin(cost))], min(cost), "o", ms=10, mfc="none", color=color)
    axis.axvspan(1.1, 1.5, color="0.93", lw=0)
    axis.text(1.3, 0.15, "people's least: 1.1 to 1.5 m/s", ha="center", fontsize=8, color="0.4")
    axis.set(xlabel="speed, m/s", ylabel="gross cost of transport, J/(kg m)", ylim=(0, None))
    axis.legend(frameon=False)
    figure.tight_layout()
    save(figure, path)


def save(figure, path):
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


# ---------------------------------------------------------------- all

def print_contact(label, curve):
    for joint, (phase, size) in curve.items():
        peaks = [f"{size[part].max():.2f} at {phase[part][size[part].argmax()]:.0f} %"
                 for part in (phase < 30, (phase > 35) & (phase < 65))]
        print(f"{label:14s} {joint:6s} " + "  ".join(peaks))


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0])
    parser.add_argument("ambulo", type=pathlib.Path)
    parser.add_argument("measured", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--activation", default="1")
    parser.add_argument("--metabolic", default="0")
    parser.add_argument("--lag", type=float, default=0.05)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    plt.rcParams.update(STYLE)
    ambulo = options.ambulo.resolve()
    prices = ["--activation", options.activation, "--metabolic", options.metabolic]

    table, numbers = measured_walk(ambulo, options.measured, options.out, prices)
    compared = compare_emg(table, read_table(options.measured / "electromyography.sto"), volumes(ambulo), options.lag)
    for channel, (_, own, _, r) in compared.items():
        print(f"{channel:20s} r {r:5.2f}  largest activation {own.max():.2f}")
    print(f"r >= .7: {sum(r >= 0.7 for *_, r in compared.values())} of {len(compared)}")
    print("measured: W/kg", numbers["metabolic"][0], "and", numbers["metabolic"][1])
    draw_activations(compared, options.lag, options.out / "muscles_emg.svg")

    found = {}
    for speed in SPEEDS:
        walk, found[speed] = predicted_walk(ambulo, speed, options.out, prices)
        print(f"walk.yaml {speed:4.2f} m/s", found[speed]["metabolic"], found[speed]["transport"])
        if speed == 1.28:
            strike, stride = right_strike(options.out / "walk_1.28" / "motion.csv")
            predicted = contact(walk, strike, stride, 75 * 9.81)
    curves = {"measured, 1.25 m/s": contact(table, STRIKE, STRIDE, 85.27 * 9.80665), "predicted, 1.28 m/s": predicted}
    for label, curve in curves.items():
        print_contact(label.split(",")[0], curve)
    draw_contact(curves, options.out / "muscles_contact.svg")
    draw_transport(found, options.out / "muscles_transport.svg")
    print_conditions(ambulo, options.out, prices)


if __name__ == "__main__":
    main()
