"""A predicted walk, read by OpenSim into its own model: is the body where Ambulo shows it?

Arguments: the OpenSim model, the result folder (of `ambulo solve --samples 161`, the times of its
scene.json), and how far apart the centres of mass may be, m. Heights of heels and toes of OpenSim's
model are reported too. Prints "N passed, N failed".
"""

import json
import sys

import opensim as osim

POINTS = ((0.0, 0.0, 0.0), (0.18, 0.0, 0.0))


def series(steps, unit):
    """As docs/results.md says: whole numbers of a unit, added up twice."""
    value, slope, found = steps[0], 0, [steps[0] * unit]
    for step in steps[1:]:
        slope += step
        value += slope
        found.append(value * unit)
    return found


def main():
    source, folder, bound = sys.argv[1], sys.argv[2], float(sys.argv[3])
    with open(folder + "/scene.json", encoding="utf-8") as file:
        scene = json.load(file)
    ours = list(zip(*(series(s, scene["units"]["length"]) for s in scene["center_of_mass"])))
    osim.Logger.setLevelString("error")
    model = osim.Model(source)
    state = model.initSystem()
    table = osim.TimeSeriesTable(folder + "/motion.sto")
    labels, coordinates = table.getColumnLabels(), model.getCoordinateSet()
    unknown = [n for n in labels if coordinates.getIndex(n) < 0]
    worst, lowest, ways = 0.0, 1.0, 0.0
    for i in range(table.getNumRows()):
        row = table.getRowAtIndex(i)
        for k, name in enumerate(labels):
            if name not in unknown:
                coordinates.get(name).setValue(state, row[k], False)
        model.realizePosition(state)
        at = model.calcMassCenterPosition(state)
        if i < len(ours):  # forward, left and up are x, -z and y
            worst = max(worst, *(abs(a - b) for a, b in zip(ours[i], (at[0], -at[2], at[1]))))
            ways = max(ways, abs(ours[i][0] - ours[0][0]))
        for side in "rl":
            body = model.getBodySet().get("calcn_" + side)
            lowest = min(lowest, *(body.findStationLocationInGround(state, osim.Vec3(*p))[1] for p in POINTS))
    print(f"OpenSim {osim.GetVersion()}: {table.getNumRows()} times; centres of mass at most {1000 * worst:.2f} mm apart on "
          f"{ways:.2f} m; lowest point of the feet {1000 * lowest:.1f} mm; columns without coordinate: {unknown or 'none'}")
    good = [not unknown, table.getNumRows() == len(ours) and worst <= bound, ways > 0.5]
    if not all(good):
        print(f"FAILED: more than {1000 * bound:.1f} mm apart, or not the same times")
    print(f"{sum(good)} passed, {len(good) - sum(good)} failed")
    return not all(good)


if __name__ == "__main__":
    sys.exit(main())
