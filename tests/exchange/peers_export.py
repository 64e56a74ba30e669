"""Exported models and motions: imported again, and in OpenSim, Pinocchio and MuJoCo.

Arguments: the program, the folder of the models and a scratch folder. Prints a line for each
comparison and, last, "N passed, N failed"; "skipped: ..." where a package is missing. Torques and
mass matrices of models are those of `ambulo inverse` (tests/import/peers_import.py).
"""

import csv
import importlib.util
import json
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "import"))
import peers_import as imports  # noqa: E402

MODELS = ["pendulum", "two_link", "walker_2d", "lower_body_21", "lower_body_23", "whole_body_29",
          "whole_body_31", "whole_body_45", "yardstick_body"]
# a seat, a wall, a box in two hands, a tendon between two points, springs at joints
WORN = ["sit_to_stand", "push_wall", "lift", "walk_exotendon", "walk_ankle_exoskeleton"]
SEED = 7


def table(path):
    """Columns of a CSV, STO or MOT by name."""
    lines = [line for line in open(path, encoding="utf-8") if not line.startswith("#")]
    if not path.endswith(".csv"):
        lines = lines[lines.index("endheader\n") + 1:]
    rows = list(csv.reader(lines, delimiter="," if path.endswith(".csv") else "\t"))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def said(label, worst, bound, of):
    good = worst <= bound  # NaN is no good
    print(f"{'ok' if good else 'FAILED':8} {label}: {worst:.1e} {of} (at most {bound:.0e})")
    return good


class Run:
    def __init__(self, ambulo, models, scratch):
        self.ambulo, self.models, self.scratch = ambulo, models, scratch
        self.names = {}

    def path(self, name):
        return os.path.join(self.scratch, name)

    def model(self, name):
        return os.path.join(self.models, name + ".yaml")

    def export(self, name, *words):
        target = self.path(words[-1])
        imports.run(self.ambulo, "export", self.model(name), *words[:-1], "-o", target, "--force")
        return target

    def coordinates(self, name):
        """Names in the order of the file."""
        if name not in self.names:
            text = open(self.model(name), encoding="utf-8").read()
            base = re.search(r"^model: (\S+)", text, re.M)
            if base:
                return self.coordinates(base.group(1).removesuffix(".yaml"))
            self.names[name] = re.findall(r"coordinate:\s*\{\s*name: ([\w.-]+)", text)
        return self.names[name]

    def ours(self, name, states):
        return imports.our_torques(self.ambulo, self.model(name), self.coordinates(name), states,
                                   self.scratch)

    # -------------------------------------------------------------- round trips

    def round_trip(self, name, kind):
        source = self.export(name, "--format", "opensim" if kind == "osim" else kind,
                             f"{name}.{kind}")
        back = imports.convert(self.ambulo, source, self.path("back.yaml"))
        names = self.coordinates(name)
        order = [n for n, _ in imports.coordinates(back)]
        assert sorted(order) == sorted(names), (order, names)
        states = imports.random_states(names, SEED)
        # tables go by name: the order of the other model does not matter
        theirs = imports.our_torques(self.ambulo, back, names, states, self.scratch)
        return imports.judge(f"{name}.{kind}, imported", self.ours(name, states), theirs)

    def motion_in_space(self, problem, result):
        """.mot and forces in the imported model: the moment about the origin knows where in space
        the body is, what is left over whether the forces are where they belong."""
        folder = self.export(problem, result, "--format", "opensim", "motion_opensim")
        back = imports.convert(self.ambulo, os.path.join(folder, "model.osim"),
                               self.path("back.yaml"), "--heel", "right=foot_r:0,0,0",
                               "--toe", "right=foot_r:0.1,0,0", "--heel", "left=foot_l:0,0,0",
                               "--toe", "left=foot_l:0.1,0,0")
        # values alone: rates by a spline on both sides, so that they are alike
        words = ["--derivatives", "spline"]
        imports.run(self.ambulo, "inverse", self.model(problem), os.path.join(result, "motion.csv"),
                    *words, "-o", self.path("a.csv"))
        imports.run(self.ambulo, "inverse", back, os.path.join(folder, "motion.mot"), "--grf",
                    os.path.join(folder, "external_loads.xml"), *words, "-o", self.path("b.csv"))
        a, b = table(self.path("a.csv")), table(self.path("b.csv"))
        weight = max(abs(x) for x in a["wrench.force.y"])
        columns = [c for c in a if c.startswith(("tau.", "wrench.", "residual.", "grf."))]
        assert any(c.startswith("residual.moment") for c in columns)
        worst = max(abs(x - y) for c in columns for x, y in zip(a[c], b[c])) / weight
        return said(f"{problem}: .mot and external loads in the imported model", worst, 1e-9,
                    "of the weight times 1 m")

    # ------------------------------------------------------------------- OpenSim

    def opensim_torques(self, name):
        import opensim as osim

        osim.Logger.setLevelString("error")
        source = self.export(name, "--format", "opensim", f"{name}.osim")
        names = self.coordinates(name)
        states = imports.random_states(names, SEED)
        model = osim.Model(source)
        model.initSystem()
        theirs = list(imports.osim_torques(osim, model, names, {}, dict.fromkeys(names, 0.0),
                                           states))
        return imports.judge(f"{name}.osim in OpenSim", self.ours(name, states), theirs)

    def opensim_run(self, problem, result):
        """OpenSim's own inverse dynamics of the folder: all files open and fit each other."""
        import opensim as osim

        osim.Logger.setLevelString("error")
        folder = self.export(problem, result, "--format", "opensim", "motion_opensim")
        motion = table(os.path.join(folder, "motion.mot"))
        tool = osim.InverseDynamicsTool()
        tool.setModelFileName(os.path.join(folder, "model.osim"))
        tool.setCoordinatesFileName(os.path.join(folder, "motion.mot"))
        tool.setExternalLoadsFileName(os.path.join(folder, "external_loads.xml"))
        tool.setLowpassCutoffFrequency(-1)
        tool.setStartTime(motion["time"][0])
        tool.setEndTime(motion["time"][-1])
        tool.setResultsDir(self.scratch)
        tool.setOutputGenForceFileName("id.sto")
        assert tool.run()
        return table(self.path("id.sto"))

    def opensim_worst(self, problem, ours, theirs, weight):
        """Largest difference at times that both have, away from the ends, where OpenSim's splines
        are others than ours."""
        worst, count = 0.0, 0
        for name in self.coordinates(problem):
            column = [c for c in theirs if c in (name + "_moment", name + "_force")][0]
            for t, x in zip(theirs["time"], theirs[column]):
                k = min(range(len(ours["time"])), key=lambda i: abs(ours["time"][i] - t))
                if abs(ours["time"][k] - t) < 1e-6 and 0.02 < t < ours["time"][-1] - 0.02:
                    worst = max(worst, abs(ours["tau." + name][k] - x))
                    count += 1
        assert count > 0
        return worst / weight

    def opensim_tool(self, problem, result):
        theirs = self.opensim_run(problem, result)
        imports.run(self.ambulo, "inverse", self.model(problem), os.path.join(result, "motion.csv"),
                    "--derivatives", "spline", "-o", self.path("a.csv"))
        ours = table(self.path("a.csv"))
        weight = max(abs(x) for x in ours["wrench.force.y"])
        return said(f"{problem}: OpenSim's inverse dynamics tool",
                    self.opensim_worst(problem, ours, theirs, weight), 1e-3,
                    "of the weight times 1 m")

    def opensim_person(self, problem, result):
        """The same with forces of hands, a seat, devices: the torques of the result, and nothing
        left at the root. Its rates are not those of a spline: bounds are wider."""
        theirs = self.opensim_run(problem, result)
        ours = table(os.path.join(result, "motion.csv"))
        weight = json.load(open(os.path.join(result, "summary.json")))["body"]["mass"] * 9.81
        return said(f"{problem}: OpenSim's inverse dynamics tool with all loads",
                    self.opensim_worst(problem, ours, theirs, weight), 2e-3,
                    "of the weight times 1 m")

    # ----------------------------------------------------------------- Pinocchio

    def pinocchio_torques(self, name):
        import numpy as np
        import pinocchio as pin

        source = self.export(name, "--format", "urdf", f"{name}.urdf")
        names = self.coordinates(name)
        model = pin.buildModelFromUrdf(source)
        model.gravity.linear[:] = [0, 0, -9.81]
        data, columns = model.createData(), imports.pin_columns(model, names)
        states = imports.random_states(names, SEED)
        theirs = [pin.rnea(model, data, q, np.array(v), np.array(a))[columns].tolist()
                  for q, v, a in imports.pin_states(pin, model, names, {}, states)]
        return imports.judge(f"{name}.urdf in Pinocchio", self.ours(name, states), theirs)

    def points(self, name):
        """Markers in OpenSim where Pinocchio has the URDF's points: two texts, two programs. The
        coordinates of the former count as its defaults say."""
        import numpy as np
        import opensim as osim
        import pinocchio as pin

        names = self.coordinates(name)
        urdf = pin.buildModelFromUrdf(self.export(name, "--format", "urdf", f"{name}.urdf"))
        model = osim.Model(self.export(name, "--format", "opensim", f"{name}.osim"))
        state, data, worst, count = model.initSystem(), urdf.createData(), 0.0, 0
        for q, _, _ in imports.random_states(names, SEED)[:imports.POSES]:
            values = dict(zip(names, q))
            for k in range(model.getCoordinateSet().getSize()):
                c = model.getCoordinateSet().get(k)
                c.setValue(state, values[c.getName()] + c.getDefaultValue(), False)
            model.realizePosition(state)
            own = next(imports.pin_states(pin, urdf, names, {}, [(q, q, q)]))[0]
            pin.framesForwardKinematics(urdf, data, own)
            for k in range(model.getMarkerSet().getSize()):
                marker = model.getMarkerSet().get(k)
                x = marker.getLocationInGround(state)
                at = data.oMf[urdf.getFrameId(marker.getName() + "_point")].translation
                worst = max(worst, np.abs(np.array([x.get(0), -x.get(2), x.get(1)]) - at).max())
                count += 1
        assert count > 0
        return said(f"{name}: markers in OpenSim and points in Pinocchio", worst, 1e-12, "m")

    def replay(self, problem, result):
        """The .npz in Pinocchio: torques of the motion less those of all loads are the result's."""
        import numpy as np
        import pinocchio as pin

        urdf = self.export(problem, "--format", "urdf", "--free-root", "free.urdf")
        archive = np.load(self.export(problem, result, "--format", "npz", "motion.npz"))
        model = pin.buildModelFromUrdf(urdf, pin.JointModelFreeFlyer())
        model.gravity.linear[:] = archive["gravity"]
        data = model.createData()
        order = [model.joints[model.getJointId(n)].idx_v for n in archive["joint_names"]]
        worst = drift = rest = own = 0.0
        written = table(os.path.join(result, "motion.csv"))
        weight = sum(i.mass for i in model.inertias) * 9.81
        for k in range(len(archive["times"])):
            q, v, a = pin.neutral(model), np.zeros(model.nv), np.zeros(model.nv)
            for to, name in ((q, "q"), (v, "v"), (a, "a")):
                base = 7 if name == "q" else 6
                to[:base] = archive[name][k, :base]
                to[[o + base - 6 for o in order]] = archive[name][k, base:]
            for i, joint in enumerate(model.joints):  # continuous joints have two numbers
                assert i < 2 or joint.nq == 1
            tau = pin.rnea(model, data, q, v, a)
            pin.computeJointJacobians(model, data, q)
            pin.updateFramePlacements(model, data)
            for c, link in enumerate(archive["contact_links"]):
                frame = model.getFrameId(str(link))
                jacobian = pin.getFrameJacobian(model, data, frame, pin.LOCAL_WORLD_ALIGNED)
                wrench, point = archive["contact_wrench"][k, c], archive["contact_point"][k, c]
                arm = point - data.oMf[frame].translation
                tau -= jacobian.T @ np.r_[wrench[:3], wrench[3:] + np.cross(arm, wrench[:3])]
            given = np.r_[archive["tau"][k, :6], archive["tau"][k, 6:][np.argsort(order)]]
            worst = max(worst, np.abs(tau[:6]).max() / weight)
            rest = max(rest, np.abs(tau - given).max() / weight)
            for name, o in zip(archive["joint_names"], order):
                own = max(own, abs(tau[o] - written[f"tau.{name}"][k]) / weight)
            turn = pin.Quaternion(archive["q"][k, 3:7]).matrix()
            drift = max(drift, np.abs(archive["qvel"][k, :3] - turn @ v[:3]).max(),
                        np.abs(archive["qacc"][k, :3]
                               - turn @ (a[:3] + np.cross(v[3:6], v[:3]))).max(),
                        np.abs(archive["qpos"][k, 3:7] - archive["q"][k, [6, 3, 4, 5]]).max())
        label = f"{problem}.npz in Pinocchio"
        carried = len(archive["contact_links"]) == 0 or said(label + ", root", worst, 1e-8,
                                                             "of the weight (times 1 m)")
        carried = carried and (len(archive["contact_links"]) == 0
                               or said(label + ", torques of the result", own, 1e-8,
                                       "of the weight times 1 m"))
        return all([carried,
                    said(label + ", torques", rest, 1e-8, "of the weight times 1 m"),
                    said(label + ", MuJoCo's rates", drift, 1e-9, "SI")])

    def mujoco_torques(self, problem, result):
        """qpos, qvel, qacc in MuJoCo, of a body each of whose joints has one axis; no contacts."""
        import mujoco
        import numpy as np

        urdf = self.export(problem, "--format", "urdf", "--free-root", "free.urdf")
        archive = np.load(self.export(problem, result, "--format", "npz", "motion.npz"))
        spec = mujoco.MjSpec.from_file(urdf)
        spec.compiler.fusestatic = False
        spec.body(str(archive["root_link"][0])).add_freejoint()
        spec.option.gravity = archive["gravity"]
        model = spec.compile()
        data, worst = mujoco.MjData(model), 0.0
        at = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, str(n)) for n in archive["joint_names"]]
        to = {"qpos": (data.qpos, 7, model.jnt_qposadr[at]), "qvel": (data.qvel, 6, model.jnt_dofadr[at]),
              "qacc": (data.qacc, 6, model.jnt_dofadr[at])}
        weight = model.body_mass.sum() * 9.81
        for k in range(len(archive["times"])):
            for name, (field, base, columns) in to.items():
                field[:base], field[columns] = archive[name][k, :base], archive[name][k, base:]
            mujoco.mj_fwdPosition(model, data)
            mujoco.mj_fwdVelocity(model, data)
            tau, own = np.zeros(model.nv), archive["tau"][k]
            mujoco.mj_rne(model, data, 1, tau)
            turn = np.zeros(9)
            mujoco.mju_quat2Mat(turn, archive["qpos"][k, 3:7])
            force = turn.reshape(3, 3) @ own[:3]  # MuJoCo's is in the world's axes
            worst = max(worst, np.abs(tau[:3] - force).max(), np.abs(tau[3:6] - own[3:6]).max(),
                        np.abs(tau[model.jnt_dofadr[at]] - own[6:]).max())
        return said(f"{problem}.npz in MuJoCo", worst / weight, 1e-9, "of the weight (times 1 m)")


def main():
    run = Run(*[os.path.abspath(path) for path in sys.argv[1:4]])
    os.chdir(run.scratch)  # where OpenSim leaves its log
    checks = [(run.round_trip, name, kind) for name in MODELS for kind in ("osim", "urdf")]
    result, step = run.path("walk"), run.path("step")
    imports.run(run.ambulo, "solve", run.model("walk_normal"), "-o", result)
    imports.run(run.ambulo, "solve", run.model("walker_2d_step"), "-o", step)
    checks.append((run.motion_in_space, "walk_normal", result))
    worn = {}
    peers = any(importlib.util.find_spec(package) for package in ("opensim", "pinocchio"))
    for name in WORN if peers else []:
        worn[name] = run.path(name)
        imports.run(run.ambulo, "solve", run.model(name), "-o", worn[name])
    if importlib.util.find_spec("opensim"):
        checks += [(run.opensim_torques, name) for name in MODELS]
        checks.append((run.opensim_tool, "walk_normal", result))
        checks += [(run.opensim_person, name, folder) for name, folder in worn.items()]
    else:
        print("skipped: exported models in OpenSim (no package `opensim`)")
    if importlib.util.find_spec("pinocchio"):
        checks += [(run.pinocchio_torques, name) for name in MODELS]
        checks += [(run.replay, "walk_normal", result), (run.replay, "walker_2d_step", step)]
        checks += [(run.replay, name, folder) for name, folder in worn.items()]
        if importlib.util.find_spec("opensim"):
            checks += [(run.points, name) for name in MODELS[2:]]
    else:
        print("skipped: exported models and motions in Pinocchio (no package `pin`)")
    if importlib.util.find_spec("mujoco"):
        checks.append((run.mujoco_torques, "walker_2d_step", step))
    else:
        print("skipped: exported motions in MuJoCo (no package `mujoco`)")
    results = [check(*words) for check, *words in checks]
    print(f"{sum(results)} passed, {len(results) - sum(results)} failed")
    return not all(results)


if __name__ == "__main__":
    sys.exit(main())
