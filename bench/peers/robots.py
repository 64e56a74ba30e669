#!/usr/bin/env python3
"""Two steps from rest of two robots by Crocoddyl and by ambulo, in turn, judged by one measure.

    robots.py AMBULO BIPED.urdf WORK RESULTS.csv [ROUNDS]

Crocoddyl solves its own example (utils/biped.py: FDDP; the feet that stand, and where the other
foot and the centre of mass go, are given at every knot; all else is a cost). Both programs have the
same robot, initial state, footholds, times, distance of knots and coefficient of friction. Seconds
are processor seconds of one core, the least of ROUNDS: building the problem and solving it for
Crocoddyl, the whole command with files and audit for ambulo.

Both motions are judged at their nodes by Pinocchio's model of the URDF: the distance of feet that
stand from their footholds, angles and torques beyond the limits of the URDF. Forces are those each
program states: by how many N they leave the cone of friction, by how many N m the sole.
"""
import csv
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
import crocoddyl  # noqa: E402
import example_robot_data  # noqa: E402
import numpy as np  # noqa: E402
import pinocchio as pin  # noqa: E402
from crocoddyl.utils.biped import SimpleBipedGaitProblem  # noqa: E402

HERE = pathlib.Path(__file__).parent
FRICTION = 0.5
SIDES = ("right", "left")


class Task:
    """A robot with its two steps: model, soles (a frame and the box about it), lengths and times."""

    def __init__(self, name, urdf, model, soles, box, step, knots, support, interval):
        self.name, self.urdf, self.model, self.soles, self.box = name, urdf, model, soles, box
        self.step, self.knots, self.support, self.interval = step, knots, support, interval
        self.initial = model.referenceConfigurations["half_sitting"].copy()
        one, both = knots * interval, support * interval
        self.stances = {"right": [(0, both, 0), (one, 2 * one, step / 2)],
                        "left": [(0, one + both, 0), (2 * one, 2 * one, step)]}


def biped(urdf):
    model = pin.buildModelFromUrdf(str(urdf), pin.JointModelFreeFlyer())
    for side in SIDES:
        foot = model.getFrameId(side + "_foot")
        place = model.frames[foot].placement * pin.SE3(np.eye(3), np.array([0.03, 0, -0.06]))
        model.addFrame(pin.Frame(side + "_sole", model.frames[foot].parentJoint, foot, place,
                                 pin.FrameType.OP_FRAME))
    angles = {"hip_pitch": -0.25, "knee": 0.5, "ankle_pitch": -0.25}
    q = pin.neutral(model)
    for side in SIDES:
        for joint, angle in angles.items():
            q[model.joints[model.getJointId(f"{side}_{joint}")].idx_q] = angle
    q[2] = 0.7 * np.cos(0.25) + 0.11
    model.referenceConfigurations["half_sitting"] = q
    return Task("biped", urdf, model, {s: s + "_sole" for s in SIDES}, (-0.09, 0.11, 0.045), 0.35, 58, 12, 0.01)


def talos():
    robot = example_robot_data.load("talos")
    return Task("talos", robot.urdf, robot.model, {s: s + "_sole_link" for s in SIDES},
                (-0.11585, 0.10455, 0.0672), 0.3, 47, 9, 0.02)


# ------------------------------------------------------------------ two solves


def crocoddyl_solve(task):
    model, state = task.model, np.r_[task.initial, np.zeros(task.model.nv)]
    begin = time.process_time()
    gait = SimpleBipedGaitProblem(model, task.soles["right"], task.soles["left"])
    gait.mu = FRICTION
    problem = gait.createWalkingProblem(state, task.step, 0.1, task.interval, task.knots - task.support, task.support)
    problem.nthreads = 1
    solver = crocoddyl.SolverFDDP(problem)
    solver.th_stop = 1e-7
    states, controls = [state] * (problem.T + 1), problem.quasiStatic([state] * problem.T)
    converged = solver.solve(states, controls, 200, False, 0.1)
    return {"seconds": time.process_time() - begin, "iterations": solver.iter,
            "verdict": "converged" if converged else "not converged", "solver": solver, "problem": problem}


def crocoddyl_motion(task, run):
    """Times and postures of all knots; torques and forces, {foot: force and moment about the sole's middle, world's axes}."""
    solver, problem = run["solver"], run["problem"]
    problem.calc(solver.xs, solver.us)
    now, times, torques, forces = 0.0, [], [], []
    for model, data, control in zip(problem.runningModels, problem.runningDatas, solver.us):
        times.append(now)
        if not hasattr(data, "differential"):  # the switch of a foot takes no time
            continue
        now += model.dt
        torques.append(control)
        contacts = data.differential.multibody.contacts.contacts.todict()
        forces.append({})
        for side, sole in task.soles.items():
            if sole + "_contact" in contacts:
                contact = contacts[sole + "_contact"]
                turn = pin.SE3(contact.pinocchio.oMf[task.model.getFrameId(sole)].rotation, np.zeros(3))
                forces[-1][side] = turn.act(contact.jMf.actInv(contact.fext)).vector
    postures = np.array([x[:task.model.nq] for x in solver.xs])
    return np.array(times + [now]), postures, np.array(torques), forces


def told_cone(forces):
    """N by which the forces leave the pyramid that Crocoddyl is told, with its small sole."""
    cone = crocoddyl.WrenchCone(np.eye(3), FRICTION, np.array([0.1, 0.05]))
    rows = [cone.A @ wrench for node in forces for wrench in node.values()]
    return max(0.0, max(max((cone.lb - row).max(), (row - cone.ub).max()) for row in rows))


def ambulo_solve(task, program, work):
    result = work / f"{task.name}_start"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "solve", str(work / f"{task.name}_start.yaml"), "-o", str(result), "--force", "--quiet"],
                   check=True, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = json.loads((result / "summary.json").read_text())
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    holds = "" if summary["between_nodes"]["holds"] else ", off between nodes"
    return {"seconds": seconds, "iterations": summary["iterations"],
            "verdict": summary["verdict"] + holds, "result": result}


def ambulo_motion(task, run, work):
    lines = (run["result"] / "motion.csv").read_text().splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    table = [{key: float(value or 0) for key, value in row.items()} for row in rows]
    height = float(re.search(r"xyz: \[0, 0, ([-0-9.]+)\]", (work / f"{task.name}.yaml").read_text()).group(1))
    model, data = task.model, task.model.createData()
    joints = [(model.names[i], model.joints[i].idx_q) for i in range(2, model.njoints)]
    postures, torques, forces = [], [], []
    for row in table:
        turn = (pin.utils.rotate("y", row["q.base_tilt"]) @ pin.utils.rotate("x", row["q.base_list"])
                @ pin.utils.rotate("z", row["q.base_rotation"]))
        q = pin.neutral(model)
        q[:3] = [row["q.base_tx"], row["q.base_ty"], row["q.base_tz"] + height]
        q[3:7] = pin.Quaternion(turn).coeffs()
        for name, place in joints:
            q[place] = row["q." + name]
        pin.framesForwardKinematics(model, data, q)
        node = {}
        for side, sole in task.soles.items():
            middle = pin.SE3(np.eye(3), data.oMf[model.getFrameId(sole)].translation)
            force = np.array([row[f"grf.{side}.{axis}"] for axis in "xyz"])
            moment = np.array([row[f"moment.{side}.{axis}"] for axis in "xyz"])
            if force.any():
                node[side] = middle.actInv(pin.Force(force, moment)).vector
        postures.append(q)
        torques.append([row["tau." + name] for name, _ in joints])
        forces.append(node)
    return np.array([row["time"] for row in table]), np.array(postures), np.array(torques), forces


# --------------------------------------------------------------------- measure


def measures(task, times, postures, torques, forces):
    model, data = task.model, task.model.createData()

    def sole(q, side):
        pin.framesForwardKinematics(model, data, q)
        return data.oMf[model.getFrameId(task.soles[side])].translation.copy()

    # the steps begin where the feet of each motion stand at t = 0, on the ground of the initial posture
    foothold = 0.0
    for side, stances in task.stances.items():
        start = sole(postures[0], side)
        for begin, end, travel in stances:
            for now, q in zip(times, postures):
                if begin - 1e-9 <= now <= end + 1e-9:
                    foothold = max(foothold, np.linalg.norm(sole(q, side) - start - [travel, 0, 0]))
    angles = postures[:, 7:]
    beyond = max((model.lowerPositionLimit[7:] - angles).max(), (angles - model.upperPositionLimit[7:]).max())
    limits = model.effortLimit[6:]
    back, front, half = task.box
    friction = pressure = 0.0
    for fx, fy, fz, mx, my, _ in (wrench for node in forces for wrench in node.values()):
        friction = max(friction, np.hypot(fx, fy) - FRICTION * fz, -fz)
        pressure = max(pressure, -my - front * fz, my + back * fz, abs(mx) - half * fz)
    return {"friction_N": friction, "pressure_Nm": pressure,
            "torque_over_limit_Nm": max(0.0, (np.abs(torques) - limits).max()),
            "torque_of_limit": (np.abs(torques) / limits).max(),
            "joint_beyond_deg": np.degrees(max(0.0, beyond)), "foothold_mm": 1000 * foothold}


TOLD = """
What each must be told, beside the robot, the initial posture and the friction:
  Crocoddyl  at every knot the feet that stand; at every knot of a swing where the foot goes (with its height)
             and the centre of mass; an impulse where a foot lands; a sole's size; the posture to keep near, and
             the weights of seven costs. It knows no limits of joints, speeds or torques (SolverBoxFDDP takes
             those of torques) and no collisions; cone and footholds are costs.
  ambulo     which foot stands where, from when to when, within which tolerance; a sole's width; a clearance; the
             weights of three terms of the objective. Footholds, friction, pressure, limits of joints, speeds and
             torques, clearance and collisions are constraints.
"""


def main():
    program, urdf, work, results = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]), sys.argv[4]
    rounds = int(sys.argv[5]) if len(sys.argv) > 5 else 3
    table = []
    for task in (biped(urdf), talos()):
        subprocess.run([program, "import", str(task.urdf), "-o", str(work / f"{task.name}.yaml"), "--force"],
                       check=True, stderr=subprocess.DEVNULL)
        shutil.copy(HERE / f"{task.name}_start.yaml", work)
        runs = [(crocoddyl_solve(task), ambulo_solve(task, program, work)) for _ in range(rounds)]
        theirs, ours = (min(side, key=lambda run: run["seconds"]) for side in zip(*runs))
        for who, run, motion in (("Crocoddyl", theirs, crocoddyl_motion(task, theirs)),
                                 ("ambulo", ours, ambulo_motion(task, ours, work))):
            table.append({"robot": task.name, "program": who, "coordinates": task.model.nv,
                          "nodes": len(np.unique(motion[0])), "seconds": run["seconds"], "iterations": run["iterations"],
                          **measures(task, *motion), "verdict": run["verdict"]})
            print(*(f"{key} {value:.3g}" if isinstance(value, float) else f"{key} {value}"
                    for key, value in table[-1].items()), sep=", ")
            if who == "Crocoddyl":
                print(f"  beyond the pyramid of its own costs by {told_cone(motion[3]):.1f} N")
    print(TOLD)
    with open(results, "w", encoding="utf-8") as file:
        writer = csv.DictWriter(file, table[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()}
                         for row in table)


if __name__ == "__main__":
    main()
