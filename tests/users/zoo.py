"""Robots and persons as they come: imported, given a problem, solved, compared with their own program.

Arguments: the program, zoo.txt, a scratch folder; then names, if not all. A line of zoo.txt is a model.
Prints a row of a table for each, and "N passed, N failed": a model passes whose walk is optimal, holds
between the nodes, keeps its torque limits and has no residual at the root.

What is compared, each a share of the largest torque or of the weight (m g, times 1 m):
  mass     columns of the mass matrix and torques at random poses, tests/import/peers_import.py
  root     what the root would need besides the forces of the ground, in MuJoCo or Pinocchio
MuJoCo's rotors (armature) count where the import has them, and are zero where it has not.
"""

import csv
import importlib.util
import json
import os
import re
import resource
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
PEERS = os.path.join(HERE, "..", "import")
SOLES = [word for side in ("right", "left") for word in
         ("--heel", f"{side}=calcn_{side[0]}:0,0,-0.03:0,0,0.03", "--toe", f"{side}=calcn_{side[0]}:0.18,0,-0.04:0.18,0,0.04")]
KINDS = {"menagerie": "mjcf", "erd": "urdf", "opensim": "osim"}
ROOT_BOUND = 1e-10


def folder_of(source):
    zoo = os.environ.get("AMBULO_ZOO", "")
    if source == "menagerie":
        return os.path.join(zoo, "mujoco_menagerie")
    if source == "opensim":
        return os.path.join(zoo, "opensim-models")
    spec = importlib.util.find_spec("pinocchio")
    up = os.path.dirname(spec.origin) if spec else ""
    found = [os.path.join(up, part, "example-robot-data/robots")
             for part in ("../../../../share", "../../cmeel.prefix/share")]
    return next((path for path in found if os.path.isdir(path)), "")


def run(words):
    """Exit code, what it said, processor seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return done.returncode, done.stdout + done.stderr, used


def rows_of(motion):
    with open(motion, encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            yield {name: float(value) for name, value in row.items() if value}


# ---------------------------------------------------------------- comparisons


def mass_error(ambulo, kind, source, scratch):
    python = os.environ.get("AMBULO_OPENSIM_PYTHON", sys.executable) if kind == "osim" else sys.executable
    code = ("import sys; sys.path.insert(0, sys.argv[1]); import peers_import as peers; "
            "getattr(peers, 'compare_' + sys.argv[2])(sys.argv[3], sys.argv[4], sys.argv[5], 1)")
    _, said, _ = run([python, "-c", code, PEERS, kind, ambulo, source, scratch])
    found = re.search(r"worst difference (\S+) of", said)
    return found.group(1) if found else "-"


def feet_of(text):
    return dict(re.findall(r"- \{name: (left|right)_heel, link: ([^,]+),", text))


def lift_root(mujoco, model, text):
    """Where an import has put the whole body, so that its feet stand on the ground."""
    name, xyz = re.search(r"- \{name: (\w+), parent: \w+, joint: prismatic,\s+origin: \{xyz: \[([^]]*)\]", text).groups()
    joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
    model.body_pos[model.jnt_bodyid[joint]] = [float(x) for x in xyz.split(",")]


def root_in_mujoco(source, text, motion):
    sys.path.insert(0, PEERS)
    import mujoco
    import numpy as np
    import peers_import as peers

    model = peers.mujoco_model(mujoco, np, source)
    if "armature:" not in text:
        model.dof_armature[:] = 0
    model.jnt_stiffness[:] = 0
    friction = peers.mujoco_friction(mujoco, np, model)
    lift_root(mujoco, model, text)
    data, worst = mujoco.MjData(model), 0.0
    weight = 9.81 * sum(model.body_mass)
    names = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, j) for j in range(model.njnt)]
    for row in rows_of(motion):
        for j, name in enumerate(names):
            at, dof = model.jnt_qposadr[j], model.jnt_dofadr[j]
            data.qpos[at] = row["q." + name]
            data.qvel[dof], data.qacc[dof] = row["qd." + name], row["qdd." + name]
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        needed, ground = np.zeros(model.nv), np.zeros(model.nv)
        mujoco.mj_rne(model, data, 1, needed)
        needed += model.dof_armature * data.qacc - data.qfrc_damper + friction(data.qvel)
        for foot, link in feet_of(text).items():
            force = np.array([row[f"grf.{foot}.{axis}"] for axis in "xyz"])
            if force.any():
                at = np.array([row[f"cop.{foot}.{axis}"] for axis in "xyz"])
                turn = np.array([0, 0, row[f"free_moment.{foot}"]])
                mujoco.mj_applyFT(model, data, force, turn, at, model.body(link).id, ground)
        left = needed - ground
        for j, name in enumerate(names):
            left[model.jnt_dofadr[j]] -= row.get("tau." + name, 0.0)
        worst = max(worst, float(np.abs(left).max()) / weight)
    return f"{worst:.1e}"


def root_in_pinocchio(source, model, motion):
    _, said, _ = run([sys.executable, os.path.join(HERE, "replay.py"), source, model, motion])
    found = re.search(r"root (\S+), joints", said)
    return found.group(1) if found else "-"


def torque_share(text, motion):
    """The largest torque as a share of its limit, and whose; "" where there are no limits."""
    limits = {}
    for name, rest in re.findall(r"coordinate: \{name: ([^,}]+)([^}]*)\}", text):
        found = re.search(r"torque: \[([^,]+), ([^\]]+)\]", rest)
        if found:
            limits[name] = [float("inf") if x == "none" else float(x) for x in found.groups()]
    most = (0.0, "")
    for row in rows_of(motion):
        for name, (low, high) in limits.items():
            tau = row.get("tau." + name, 0.0)
            most = max(most, (tau / (high if tau > 0 else low) if tau else 0.0, name))
    return most


# ---------------------------------------------------------------------- models


def walk(ambulo, name, source, path, options):
    """A row of the table, and whether the model passes."""
    kind = KINDS[source]
    model, problem = name + ".yaml", name + "_walk.yaml"
    words = SOLES if options == ["SOLES"] else options
    code, said, _ = run([ambulo, "import", path, "-o", model, "--force", *words])
    if code:
        return [name, source, "refused: " + said.splitlines()[0][-80:]] + ["-"] * 6, False
    text = open(model, encoding="utf-8").read()
    count = str(text.count("coordinate: {"))
    mass = mass_error(ambulo, kind, path, os.getcwd())
    code, said, _ = run([ambulo, "new", "walk", "--for", model, "-o", problem, "--force"])
    if code:
        return [name, source, count, "no problem", "-", "-", mass, "-", "-"], False
    _, said, used = run([ambulo, "solve", problem, "-o", name, "--force"])
    summary = json.load(open(os.path.join(name, "summary.json"), encoding="utf-8"))
    verdict = summary["verdict"]
    if verdict == "optimal" and re.search("nodes only|off between the nodes", said):
        verdict = "optimal, off between the nodes"
    motion = os.path.join(name, "motion.csv")
    share, joint = torque_share(text, motion)
    root = {"mjcf": lambda: root_in_mujoco(path, text, motion),
            "urdf": lambda: root_in_pinocchio(path, model, motion),
            "osim": lambda: "-"}[kind]
    try:
        residual = root()
    except Exception as fault:  # a model that the peer does not read; said, and not passed over
        print(f"{name}: no replay: {fault}", file=sys.stderr)
        residual = "-"
    ends = "mirrored" if "kind: mirrored" in open(problem, encoding="utf-8").read() else "periodic"
    good = verdict == "optimal" and share <= 1.001 and (residual == "-" or float(residual) <= ROOT_BOUND)
    limit = f"{share:.2f} {joint}" if joint else "none given"
    return [name, source, count, ends, verdict, f"{used:.1f}", mass, residual, limit], good


def main():
    ambulo, table = (os.path.abspath(path) for path in sys.argv[1:3])
    os.environ["AMBULO_ZOO"] = os.path.abspath(os.environ.get("AMBULO_ZOO", "zoo"))
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    os.chdir(sys.argv[3])
    wanted, passed, failed, skipped = sys.argv[4:], 0, 0, set()
    print("| model | source | coordinates | ends | verdict | processor s | mass matrix | root residual | largest torque |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for line in open(table, encoding="utf-8"):
        if line.startswith("#") or not line.strip():
            continue
        name, source, path, *options = line.split()
        path = os.path.join(folder_of(source), path)
        if wanted and name not in wanted:
            continue
        if not os.path.exists(path):
            skipped.add(source)
            continue
        row, good = walk(ambulo, name, source, path, options)
        print("| " + " | ".join(row) + " |", flush=True)
        passed, failed = passed + good, failed + (not good)
    for source in sorted(skipped):
        print(f"skipped: models of {source} that are not there")
    print(f"{passed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
