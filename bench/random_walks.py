#!/usr/bin/env python3
"""Three hundred walks that nobody chose: how many are solved, and how many are within human ranges.

    python3 bench/random_walks.py build/ambulo [count] [jobs]

Draws speed (0.6 to 2.2 m/s), stature, mass for that stature (body mass index 17 to 32), sex, slope
(-6 to 6 degrees), a load on the back (none for half of them, else up to 25 kg) and step width
independently, from a generator of its own, solves models/walk_slow.yaml with them from zero as one
batch, and prints: the verdicts; dense checks that failed; time and iterations; what is outside people's
ranges by a factor of 1.5, by quantity; and each case that is not `optimal`. Phases follow the speed:
toe-off .64 at 1.0 m/s, .60 at 1.6, heel rise .24 before (models/sweep_walk_speeds.csv), held within
.58 and .66.
"""
import csv, os, subprocess, sys, tempfile

HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# Level walking of adults over these speeds, the widest of Winter (1991), Schwartz et al. (2008) and
# Perry (1992): range of the knee, degrees; peaks of moments, N m/kg, and of the vertical force, body
# weights.
RANGES = {"knee range": (45, 75), "hip moment": (0.3, 1.6), "knee moment": (0.15, 1.2),
          "ankle moment": (0.9, 1.9), "vertical force": (0.95, 1.7)}
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
    toe_off = min(0.66, max(0.58, 0.64 - 0.04 * (speed - 1.0) / 0.6))
    return {"gait.speed": speed, "subject.stature": stature, "subject.mass": mass,
            "subject.sex": "female" if draws.between(0, 1) < 0.5 else "male",
            "ground.slope": draws.between(-6, 6), "load.mass": max(1e-6, load),
            "gait.step_width": draws.between(0.06, 0.18),
            "gait.phases.heel_off": toe_off - 0.24, "gait.phases.toe_off": toe_off}


def write_sweep(folder, cases):
    with open(os.path.join(folder, "cases.csv"), "w", newline="") as out:
        table = csv.writer(out)
        table.writerow(cases[0])
        for case in cases:
            table.writerow([v if isinstance(v, str) else "%.6g" % v for v in case.values()])
    with open(os.path.join(HERE, "models", "walk_slow.yaml")) as f:
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
outputs: [objective, iterations, audit.kkt, between_nodes.failing, range(q.knee_angle_r), max(tau.hip_flexion_r), min(tau.hip_flexion_r),
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


def report(results):
    with open(os.path.join(results, "results.csv")) as f:
        rows = list(csv.DictReader(f))
    verdicts, outside, dense = {}, {name: [] for name in RANGES}, 0
    for row in rows:
        verdicts[row["state"]] = verdicts.get(row["state"], 0) + 1
        about = "%.2f m/s, %.2f m, %.0f kg, %s, slope %+.1f, load %.0f kg" % (
            float(row["gait.speed"]), float(row["subject.stature"]), float(row["subject.mass"]),
            row["subject.sex"], float(row["ground.slope"]), float(row["load.mass"]))
        if row["state"] != "optimal":
            print("%s: %s" % (row["state"], about))
        if row["state"] not in ("optimal", "feasible"):
            continue
        dense += float(row["between_nodes.failing"]) > 0
        for name, value in peaks(row, float(row["subject.mass"]) + float(row["load.mass"])).items():
            low, high = RANGES[name]
            if value < low / SLACK or value > high * SLACK:
                outside[name].append((value, about))
    print("%d walks: %s" % (len(rows), ", ".join("%d %s" % (n, v) for v, n in sorted(verdicts.items()))))
    iterations = sorted(int(row["iterations"]) for row in rows if row["iterations"])
    print("iterations: median %d, nine in ten below %d, most %d" % (
        iterations[len(iterations) // 2], iterations[9 * len(iterations) // 10], iterations[-1]))
    print("beyond a tolerance between the nodes: %d" % dense)
    for name, cases in outside.items():
        low, high = RANGES[name]
        print("%s outside %g to %g: %d" % (name, low / SLACK, high * SLACK, len(cases)))
        for value, about in sorted(cases)[:3] + sorted(cases)[3:][-3:]:
            print("  %.2f: %s" % (value, about))


if __name__ == "__main__":
    main()
