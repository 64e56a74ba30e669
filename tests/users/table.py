"""The table of a study in pandas: does a spring of 180 N m/rad help everybody, beside one of 1, and by how much?

Arguments: results.csv, the number of subjects. Prints "N passed, N failed".
"""

import sys

import pandas

ANKLE = "min(tau.ankle_angle_r)"


def main():
    table = pandas.read_csv(sys.argv[1])
    subjects = int(sys.argv[2])
    wide = table[table.state == "optimal"].pivot(index=["stature", "mass"], columns="stiffness", values="objective")
    whole = wide.dropna()
    saved = 100 * (1 - whole[180] / whole[1])
    ankle = table[table.state == "optimal"].groupby("stiffness")[ANKLE].mean()
    print(f"{len(table)} walks, {len(whole)} subjects with both; the spring saves "
          f"{saved.min():.1f} to {saved.max():.1f} % of the objective")
    checks = {
        "a row for each walk": len(table) == 2 * subjects,
        "at least 95 % of subjects with both": len(whole) >= 0.95 * subjects,
        "numbers are numbers": all(table[c].dtype.kind in "fi" for c in ("stature", "mass", "objective", ANKLE)),
        "the spring saves everybody something": len(saved) > 0 and (saved > 0).all(),
        "it takes load off the ankle": ankle[180] > ankle[1],
    }
    for name, good in checks.items():
        if not good:
            print(f"FAILED: {name}\n{table.head()}")
    print(f"{sum(map(bool, checks.values()))} passed, {len(checks) - sum(map(bool, checks.values()))} failed")
    return not all(checks.values())


if __name__ == "__main__":
    sys.exit(main())
