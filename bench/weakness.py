#!/usr/bin/env python3
"""The table of weak muscles in docs/guide-muscles.md, from the folder of models/sweep_weakness.yaml.

    build/ambulo batch models/sweep_weakness.yaml -o weakness
    build/ambulo collect weakness
    python3 bench/weakness.py weakness

Of the right leg: peaks over the stride, those of loading over the first 30 % of stance, the trunk's
lean and the pelvis' drop over the time between the other foot's lift and its strike.
"""
import csv, glob, json, math, os, sys

COLUMNS = ["effort", "ankle moment, N m/kg", "ankle push-off, W/kg", "hip pull, N m/kg", "hip pull, W/kg",
           "abduction, N m/kg", "knee in loading, N m/kg", "knee in loading, deg", "pelvis drops, deg",
           "trunk leans, deg"]


def measures(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        summary = json.load(file)
    with open(os.path.join(folder, "motion.csv")) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    mass, gait = summary["body"]["mass"], summary["gait"]
    stride = 2 * gait["step_time"]
    strike = [s["time"] for s in summary["strikes"] if s["foot"] == "right"][0]

    def peak(value, first=0.0, last=1.0):
        """Largest value between two shares of the stride that begins with the right foot's strike."""
        phases = ((((float(row["time"]) - strike) / stride) % 1.0, row) for row in rows)
        return max(value(row) for phase, row in phases if first <= phase <= last)

    def torque(name, sign):
        return lambda row: sign * float(row["tau." + name]) / mass

    def power(name, sign):
        return lambda row: (float(row["tau." + name]) * float(row["qd." + name]) / mass
                            if sign * float(row["tau." + name]) > 0 else 0.0)

    def angle(*names, sign=1):
        return lambda row: sign * math.degrees(sum(float(row["q." + name]) for name in names))

    loading, lift = 0.3 * gait["duty_factor"], gait["duty_factor"] - 0.5
    return [summary["objective"]["terms"]["muscle_effort"],
            peak(torque("ankle_angle_r", -1)), peak(power("ankle_angle_r", -1)),
            peak(torque("hip_flexion_r", 1)), peak(power("hip_flexion_r", 1)),
            peak(torque("hip_adduction_r", -1)),
            peak(torque("knee_angle_r", -1), 0, loading), peak(angle("knee_angle_r"), 0, loading),
            peak(angle("pelvis_list", sign=-1), lift, 0.5),
            peak(angle("pelvis_list", "lumbar_bending"), lift, 0.5)]


def main(folder):
    print("| strength | " + " | ".join(COLUMNS) + " |")
    print("| --- |" + " ---: |" * len(COLUMNS))
    with open(os.path.join(folder, "results.csv")) as file:
        for case in csv.DictReader(file):
            weak = [f"{name} {case[name]}" for name in ("plantarflexors", "abductors", "quadriceps")
                    if float(case[name]) < 1]
            found = glob.glob(os.path.join(folder, "cases", "*", case["id"]))
            values = measures(found[0]) if found else [math.nan] * len(COLUMNS)
            print(f"| {weak[0] if weak else 'all'} | " + " | ".join(f"{v:.2f}" for v in values) + " |")


if __name__ == "__main__":
    main(sys.argv[1])
