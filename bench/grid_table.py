#!/usr/bin/env python3
"""What a time grid and a trajectory cost and give: the table of docs/performance.md.

    python3 bench/grid_table.py build/ambulo models shipped walk walk_normal walk_loaded
    python3 bench/grid_table.py build/ambulo tests/support walk_rigid

shipped: each walk as its file says, and how far its objective is from that of four times the
nodes. Without it, for each walk and setting of a list (walks on rigid feet), solved from
zero:
  f           objective, and how far it is from that of a grid four times as fine (K 48 of degree
              4, nodes and knots on events), %, and from that trajectory's on sixteen times the nodes
  slip ...    worst violation between the nodes by family (summary.json, ten samples an interval)
  extrema     of one foot's vertical force in stance, rises and falls of less than 0.002 body weights
              left out; 2001 samples a stride
  rms > 15 Hz of one foot's vertical force over the stride, body weights
  time        of the fastest of five solves, s
Needs numpy.
"""
import json, math, os, re, subprocess, sys, tempfile
import numpy

SAMPLES = 2001


def grid(nodes, pieces, degree, uniform=False, knots=False):
    """label and settings of a grid"""
    label = "%s %d, K %d %s%s" % ("uniform" if uniform else "events", nodes, pieces,
                                  "cubic" if degree == 3 else "degree %d" % degree,
                                  ", knots on events" if knots else "")
    return label, ["time.grid=" + ("uniform" if uniform else "events"), "time.intervals=%d" % nodes,
                   "trajectory.degree=%d" % degree, "trajectory.intervals=%d" % pieces,
                   "trajectory.knots=" + ("events" if knots else "uniform")]


SETTINGS = [grid(25, 17, 3, uniform=True), grid(25, 12, 4, uniform=True),
            grid(25, 17, 3), grid(25, 17, 3, knots=True),
            grid(25, 12, 4), grid(25, 12, 4, knots=True), grid(25, 14, 4, knots=True),
            grid(36, 12, 4, knots=True), grid(36, 17, 3, knots=True), grid(36, 17, 4, knots=True),
            grid(50, 12, 4, knots=True), grid(50, 17, 3, knots=True)]
FINE, FINEST = grid(100, 48, 4, knots=True), grid(400, 48, 4, knots=True)


def solve(program, problem, settings, folder):
    command = [program, "solve", problem, "--start", "zero", "--output", folder, "--force", "--samples",
               str(SAMPLES), "--quiet"]
    for setting in settings:
        command += ["--set", setting]
    subprocess.run(command, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)


def motion(folder):
    with open(os.path.join(folder, "motion.csv")) as file:
        lines = [line for line in file if not line.startswith("#")]
    names = lines[0].strip().split(",")
    values = numpy.array([[float(v) if v else math.nan for v in line.split(",")]
                          for line in lines[1:]])
    return {name: values[:, i] for i, name in enumerate(names)}


def extrema(force, least=0.002):
    """turning points, of a curve whose smaller waves are left out"""
    count, direction, last = 0, 0, force[0]
    for value in force[1:]:
        if direction >= 0 and value > last or direction <= 0 and value < last:
            if direction == 0 and abs(value - last) < least:
                continue
            direction = direction or (1 if value > last else -1)
            last = value
        elif abs(value - last) >= least:
            count, direction, last = count + 1, -direction, value
    return count


def curves(folder, mass):
    m = motion(folder)
    weight = mass * 9.81
    feet = sorted(name for name in m if name.startswith("grf.") and name.endswith(".y"))
    vertical = [m[name] / weight for name in feet]
    foot = vertical[0]
    spectrum = numpy.fft.rfft(foot[:-1]) / len(foot[:-1])
    frequency = numpy.arange(len(spectrum)) / (m["time"][-1] - m["time"][0])
    rms = math.sqrt(2.0 * float(numpy.sum(numpy.abs(spectrum[frequency > 15.0]) ** 2)))
    loaded = numpy.where(foot > 1e-9)[0]
    # from the strike on, beyond the end of the stride
    start = next(i for i in loaded if foot[i - 1] <= 1e-9) if len(loaded) < len(foot) else 0
    stance = numpy.concatenate([foot[start:-1], foot[:start]])
    stance = stance[: int(numpy.argmax(stance <= 1e-9)) or None] if stance[0] > 1e-9 else stance
    return extrema(stance), rms


def row(program, problem, settings, folder):
    summaries = [solve(program, problem, settings, folder) for _ in range(5)]
    summary, seconds = summaries[-1], min(s["seconds"]["total"] for s in summaries)
    worst = {(f["family"], f["unit"]): f["worst"] for f in summary["between_nodes"]["families"]}
    turns, rms = curves(folder, summary["body"]["mass"])
    return summary["verdict"], objective_of(summary), worst, turns, rms, seconds


def objective_of(summary):
    return summary["objective"]["total"]


def shipped(program, models, names):
    """each walk as its file says: against four times its nodes, between them, forces, time"""
    print("| walk | N, K | f | off 4x % | worst between nodes: mm | rad | BW | extrema | rms > 15 Hz BW"
          " | iterations | CPU s |")
    print("| --- | --- |" + " ---: |" * 9)
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            problem = os.path.join(models, name + ".yaml")
            before = os.times()
            summary = solve(program, problem, [], folder)
            after = os.times()
            cpu = after.children_user + after.children_system - before.children_user - before.children_system
            turns, rms = curves(folder, summary["body"]["mass"])
            worst = {"m": 0.0, "rad": 0.0, "body weights": 0.0}
            for family in summary["between_nodes"]["families"]:
                if family["unit"] in worst:
                    worst[family["unit"]] = max(worst[family["unit"]], family["worst"])
            with open(problem) as file:
                text = file.read()
            nodes, pieces = (int(re.search(key + r":.*intervals: (\d+)", text)[1])
                             for key in ("time", "trajectory"))
            f = objective_of(summary)
            fine = solve(program, problem, [f"time.intervals={4 * nodes}"], folder)
            marks = ["" if s["verdict"] == "optimal" else f" ({s['verdict']})" for s in (summary, fine)]
            print(f"| {name} | {nodes}, {pieces} | {f:.5f}{marks[0]}"
                  f" | {100.0 * (f / objective_of(fine) - 1.0):+.1f}{marks[1]} | {1e3 * worst['m']:.2f}"
                  f" | {worst['rad']:.4f} | {worst['body weights']:.3f} | {turns} | {rms:.4f}"
                  f" | {summary['iterations']} | {cpu:.2f} |", flush=True)


def main():
    program, models, names = sys.argv[1], sys.argv[2], sys.argv[3:]
    if names[:1] == ["shipped"]:
        shipped(program, models, names[1:])
        return
    print("| walk | grid, trajectory | f | off 4x % | off 16x % | slip mm | contact mm | contact rad | clearance mm"
          " | pressure mm | ground force BW | friction BW | extrema | rms > 15 Hz BW | time s |")
    print("| --- | --- |" + " ---: |" * 13)
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            problem = os.path.join(models, name + ".yaml")
            fine = finest = None
            for label, settings in [FINEST, FINE] + SETTINGS:
                verdict, f, worst, turns, rms, seconds = row(program, problem, settings, folder)
                finest, fine = finest or f, f if settings is FINE[1] else fine or f
                get = lambda family, unit, factor=1.0: worst.get((family, unit), 0.0) * factor
                print(f"| {name} | {label} | {f:.5f} | {100.0 * (f / fine - 1.0):+.1f} | {100.0 * (f / finest - 1.0):+.1f}"
                      f" | {get('slip', 'm', 1e3):.2f} | {get('contact', 'm', 1e3):.2f}"
                      f" | {get('contact', 'rad'):.4f} | {get('clearance', 'm', 1e3):.2f}"
                      f" | {get('pressure', 'm', 1e3):.2f}"
                      f" | {get('ground_force', 'body weights'):.3f}"
                      f" | {get('friction', 'body weights'):.3f}"
                      f" | {turns} | {rms:.4f} | {seconds:.2f}"
                      f"{'' if verdict == 'optimal' else ' (' + verdict + ')'} |", flush=True)


if __name__ == "__main__":
    main()
