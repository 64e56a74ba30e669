#!/usr/bin/env python3
"""Calibrates the estimate of a walk's metabolic cost (src/people/walking_cost.h), and tests it.

    ambulo batch models/sweep_conditions.yaml -o conditions && ambulo collect conditions
    python3 bench/walking_cost.py conditions

From W, U, S and D of each condition it solves three linear equations for damping, recoil and force: people's
cost on the level at 1.25 m/s, and their changes with steps 0.3 m wide and with 4 kg on each foot. All other
conditions are held out. Prints the three numbers for src/people/walking_cost.c, then predicted and measured
changes with these numbers, and with those in the engine. A change is right within a factor of 1.5.

People: mass on trunk, shank, foot Browning et al. 2007; slopes Koelewijn et al. 2019, whose numbers are gross
(4.1 W/kg on the level at 1.3 m/s), so changes with slope are of gross cost here; width Donelan, Kram & Kuo 2001,
cost growing with the square of the width by 45 % from 0.12 to 0.45 leg lengths of 0.93 m; cadence Umberger &
Martin 2007; speed Ralston 1958.
"""
import csv, os, sys

EFFICIENCY, GRAVITY, MASS, STANDING, SPEED = 0.22, 9.81, 75.0, 1.25, 1.25
WORK, UNSTEADY, SWING, WAY = ("work.walking.limb_work", "work.walking.unsteadiness", "work.walking.swing",
                              "center_of_mass.distance")


def people(speed):
    return (2.02 + 1.33 * speed ** 2 - STANDING) / speed


def width(metres):
    square = lambda w: (w / 0.93) ** 2
    return 0.45 * (square(metres) - square(0.1248)) / (0.45 ** 2 - 0.12 ** 2)


# change beside level walking at 1.25 m/s; net but for the slopes
CHANGES = {"trunk_8": 0.139, "trunk_16": 0.323, "shank_2": 0.166, "shank_4": 0.233, "foot_2": 0.345,
           "foot_4": 0.680, "width_0.2": width(0.2), "width_0.3": width(0.3), "cadence_-20": 0.40,
           "cadence_-10": 0.08, "cadence_10": 0.07, "cadence_20": 0.21, "incline_-8": -0.359,
           "incline_8": 0.877}
CHANGES.update({"speed_%s" % v: people(float(v)) / people(SPEED) - 1.0
                for v in ("0.7", "1.0", "1.5", "1.75", "2.0")})
CALIBRATED = ("foot_4", "width_0.3")


def read(folder):
    with open(os.path.join(folder, "results.csv")) as file:
        return {row["name"]: row for row in csv.DictReader(file)}


def terms(row):
    """W, U, m0 g D and S by body mass and way"""
    way = MASS * float(row[WAY])
    return [float(row[WORK]) / way, float(row[UNSTEADY]) / way, GRAVITY, float(row[SWING]) / way]


def cost(row, numbers):
    damping, recoil, force = numbers
    w, u, g, s = terms(row)
    return max(0.0, w + damping * u - recoil * g) / EFFICIENCY + force * s


def solve(a, b):
    """Gauss's elimination with pivots"""
    rows = [list(r) + [y] for r, y in zip(a, b)]
    n = len(rows)
    for i in range(n):
        p = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[p] = rows[p], rows[i]
        for k in range(n):
            if k != i:
                f = rows[k][i] / rows[i][i]
                rows[k] = [x - f * y for x, y in zip(rows[k], rows[i])]
    return [r[n] / r[i] for i, r in enumerate(rows)]


def calibrate(table):
    equations, right = [], []
    for name in ("level",) + CALIBRATED:
        w, u, g, s = terms(table[name])
        equations.append([u / EFFICIENCY, -g / EFFICIENCY, s])
        right.append(people(SPEED) * (1.0 + CHANGES.get(name, 0.0)) - w / EFFICIENCY)
    return solve(equations, right)


def show(table, of, note):
    level, counts = of(table["level"]), {}
    standing = STANDING / SPEED
    print("\n%s: %.2f J/(kg m) on the level at %.2f m/s; people %.2f" % (note, level, SPEED, people(SPEED)))
    for name, measured in CHANGES.items():
        base = standing if name.startswith("incline") else 0.0
        change = (of(table[name]) + base) / (level + base) - 1.0
        sign = change * measured > 0.0
        near = sign and 1.0 / 1.5 <= change / measured <= 1.5
        for group in ["all"] + (["held out"] if name not in CALIBRATED else []) \
                + (["without speeds"] if not name.startswith("speed") else []):
            n, s, k = counts.get(group, (0, 0, 0))
            counts[group] = (n + 1, s + sign, k + near)
        print("  %-12s %+4.0f %%  people %+4.0f %%  %s%s" % (name, 100 * change, 100 * measured,
              "" if near else "off" if sign else "wrong sign", "  calibrated" if name in CALIBRATED else ""))
    for name in table:
        if name != "level" and name not in CHANGES:
            print("  %-12s %+4.0f %%" % (name, 100 * (of(table[name]) / level - 1.0)))
    gross = {s: of(table[n]) + STANDING / s for n, s in [("level", SPEED)] +
             [(n, float(n[6:])) for n in table if n.startswith("speed")]}
    print("  gross, J/(kg m): " + ", ".join("%.2f at %g m/s" % (gross[s], s) for s in sorted(gross)))
    for group, (n, s, k) in counts.items():
        print("  %s: sign right in %d, within a factor of 1.5 in %d of %d" % (group, s, k, n))


def main():
    table = read(sys.argv[1])
    numbers = calibrate(table)
    print("damping = %.3f /s, recoil = %.4f, force = %.3f s; efficiency = %.2f" % (*numbers, EFFICIENCY))
    show(table, lambda row: cost(row, numbers), "calibrated")
    show(table, lambda row: float(row["work.metabolic_per_kg_metre"]), "as the engine has it")


if __name__ == "__main__":
    main()
