"""The table of a study in pandas: do springs of 90 and 180 N m/rad help everybody, beside none, and by how much?

Arguments: results.csv, the number of subjects. Prints "N passed, N failed".
"""

import sys

import pandas

PERSON = ["subject.sex", "subject.stature", "subject.mass"]


def main():
    table = pandas.read_csv(sys.argv[1])
    subjects = int(sys.argv[2])
    solved = table[table.state == "optimal"]
    effort = solved.pivot(index=PERSON, columns="stiffness", values="effort").dropna()
    saved = 100 * (1 - effort.div(effort[0], axis=0))
    ankle = solved.groupby("stiffness").plantarflexion.mean()
    print(f"{len(table)} walks, {len(solved)} optimal, {(solved['between nodes'] == 0).sum()} of them between the nodes too; "
          f"{len(effort)} subjects with all three")
    for stiffness in (90, 180):
        print(f"{stiffness} N m/rad saves {saved[stiffness].mean():.1f} +- {saved[stiffness].std():.1f} % of the objective, "
              f"{saved[stiffness].min():.1f} to {saved[stiffness].max():.1f}; plantarflexion {ankle[stiffness]:.0f} N m "
              f"({ankle[0]:.0f} without)")
    none = solved[solved.stiffness == 0].spring
    checks = {
        "a row for each walk": len(table) == 3 * subjects,
        "at least 95 % of subjects with all three": len(effort) >= 0.95 * subjects,
        "numbers are numbers": all(table[c].dtype.kind in "fi" for c in ("subject.stature", "effort", "plantarflexion")),
        "a spring of no stiffness pulls at nobody": len(none) > 0 and (none == 0).all(),
        "the springs save nearly everybody something": (saved[[90, 180]] > 0).mean().min() >= 0.99,
        "more stiffness saves more": saved[180].mean() > saved[90].mean(),
        "it takes load off the ankle": ankle[180] > ankle[90] > ankle[0],
    }
    for name, good in checks.items():
        if not good:
            print(f"FAILED: {name}\n{table.head()}")
    print(f"{sum(map(bool, checks.values()))} passed, {len(checks) - sum(map(bool, checks.values()))} failed")
    return not all(checks.values())


if __name__ == "__main__":
    sys.exit(main())
