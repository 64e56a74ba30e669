#!/usr/bin/env python3
"""A robot on two legs walks in MuJoCo; 25 times a second ambulo plans its next two steps.

    robot_walks.py ROBOT.urdf [--seconds 10] [--push FORWARD LEFT AT] [--lock REGEX] [--moving] [--film FILE.png]

--push: N s at the trunk within 0.1 s, from the second AT on. --lock: joints to hold at zero.
--moving: begin at the speed of the walk, not at rest. --help has lengths of steps and the like.
docs/tutorial-mpc.md tells how it works. Needs mujoco; --film needs Pillow and a graphics library
(MUJOCO_GL=egl, for example).
"""
import argparse
import os
import tempfile
import time
from typing import NamedTuple

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import ambulo  # noqa: E402
import mujoco  # noqa: E402
import numpy as np  # noqa: E402

from robot_in_mujoco import BASE, SIDES, Robot, rotation  # noqa: E402

STEP, DOUBLE, TICK = 0.4, 0.08, 0.04  # s: a step; its part on both feet; from one plan to the next
PHASES, HORIZON = round(STEP / TICK), 2 * STEP
MILLISECONDS = round(TICK / 0.001)
SAMPLE = 0.005  # s, of a plan

PROBLEM = """
ambulo: 1
kind: problem
model: robot.yaml
angles: radians
time: {{grid: events, intervals: {intervals}{duration}}}
trajectory: {{basis: bspline, degree: 4, intervals: {knots}}}
{steps}
ground_reaction: {{kind: shared, loading_rate: 40, friction: 0.5, free_moment: 0.03, minimum_force: 0.4,
  pressure: {{flat: [0.02, -0.02], width: {sole}}}}}
constraints: {{contact_tolerance: 0.002, orientation_tolerance: 0.02, joint_limits: nodes, speed_limits: true,
  torque_limits: true, clearance: {{height: {height}, tip_from: 0.15, inward: 0.4, outward: 0.4}}}}
ends: {ends}
objective: [{{term: torque_squared, weight: 3e-4}}, {{term: acceleration, weight: 1e-5}}]
"""


class Plan(NamedTuple):
    """What joints do from a tick on, [time / SAMPLE][joint]."""
    q: np.ndarray
    qd: np.ndarray
    tau: np.ndarray

    def at(self, time):
        k, part = divmod(time / SAMPLE, 1.0)
        k = min(int(k), len(self.q) - 2)
        return (rows[k] + part * (rows[k + 1] - rows[k]) for rows in self)


class Planner:
    """The nominal walk; and for each phase of a step on either foot a solver and its solution there."""

    def __init__(self, robot, folder, *, length=0.15, width=0.24, knee=0.7, sole=0.03, iterations=6):
        self.robot, self.folder, self.sole = robot, folder, sole
        self.length, self.width, self.iterations = length, width, iterations
        off = (STEP + DOUBLE) / 2 / STEP
        gait = (f"gait: {{steps: 2, first_foot: left, step_length: {length}, step_time: {STEP}, step_width: {width}, "
                f"phases: {{heel_strike: 0, foot_flat: 0, heel_off: {off}, toe_off: {off}}}}}")
        bent = np.array([knee * ("knee" in name) for name in robot.names])
        rest = np.array([1.4 * (name in BASE[3:]) + ("knee" in name) for name in robot.names])
        walk = self.problem(56, 24, gait, "{kind: periodic, order: 2}", 0.03).extend(
            terms=[ambulo.Term("posture", weight=10, scale=rest, offset=bent)]).solve()
        if not walk.is_solution:
            raise RuntimeError(f"no nominal walk: {walk.verdict}")
        self.times = np.linspace(0, HORIZON, 161)
        self.walk = walk.motion(self.times)
        self.weights = np.full(len(robot.names), 0.3)
        self.weights[robot.base] = 1, 1, 5, 2, 2, 1
        self.nominal, self.solver, self.start = {}, {}, {}
        for side in SIDES:
            for phase in range(PHASES):
                self.prepare(side, phase)

    def problem(self, intervals, knots, steps, ends, height, duration=""):
        text = PROBLEM.format(intervals=intervals, knots=knots, steps=steps, ends=ends, height=height, duration=duration,
                              sole=self.sole)
        return ambulo.Problem.load_text(text, folder=self.folder)

    def reference(self, side, since):
        """Nominal states, times since the foot of that side landed, its heel at place(side)."""
        right = SIDES.index(side)
        t = np.atleast_1d(since) + STEP * right
        q, qd = (np.array([np.interp(t % HORIZON, self.times, row) for row in rows.T]).T
                 for rows in (self.walk.q, self.walk.qd))
        q[:, self.robot.base[0]] += self.length * (2 * (t // HORIZON) - right)
        return q, qd

    def place(self, side, step=0):
        """Nominal footholds: of the foot that stands, of the next step of the other one, and so on."""
        return np.array([step * self.length, (0.5 - (SIDES.index(side) + step) % 2) * self.width])

    def prepare(self, side, phase):
        now, other = phase * TICK, SIDES[1 - SIDES.index(side)]
        q, qd = (rows[0] for rows in self.reference(side, now))
        spans = [(side, 0, 0, STEP + DOUBLE - now), (other, 1, STEP - now, HORIZON), (side, 2, HORIZON - now, HORIZON),
                 (other, -1, 0, DOUBLE - now)]
        contacts = [f"{{foot: {foot}, mode: flat, from: {begin:.6g}, to: {min(end, HORIZON):.6g}, "
                    f"place: {list(map(float, self.place(side, step)))}}}"
                    for foot, step, begin, end in spans if end > begin + 1e-9]
        values = [", ".join(f"{name}: {value:.9g}" for name, value in zip(self.robot.names, state)) for state in (q, qd)]
        # a foot that is about to land cannot be high again at once
        height = [0, 0, 0.008, 0.015, 0.02, 0.025, 0.03][min(PHASES - 1 - phase, 6)]
        problem = self.problem(28, 12, f"contacts: [{', '.join(contacts)}]",
                               f"{{initial: {{{values[0]}}}, initial_speed: {{{values[1]}}}}}", height,
                               f", duration: {HORIZON}")
        follow = ambulo.Term("tracking", weight=20, scale=self.weights,
                             reference=self.reference(side, now + problem.times)[0])
        solver = ambulo.Solver(problem.extend(terms=[follow]), dense_samples=1)
        solver.iterate(150)
        self.nominal[side, phase] = self.robot.capture_point(q, qd)[0]
        self.solver[side, phase], self.start[side, phase] = solver, solver.result()

    def step_aside(self, side, phase, q, qd):
        """How far the next foothold is from its nominal place. Of a linear inverted pendulum the
        capture point leaves its nominal course as e^(omega t), and the foot should land as far off:

            shift = (xi - xi_nominal) e^(omega (time until it lands))
        """
        xi, omega = self.robot.capture_point(q, qd)
        shift = np.clip((xi - self.nominal[side, phase]) * np.exp(omega * (STEP - phase * TICK)), -0.3, 0.3)
        out = 1 if side == "left" else -1  # heels keep 0.12 m apart
        shift[1] = out * min(out * shift[1], self.width - 0.12)
        return shift

    def plan(self, data, side, phase, shift):
        """From a state of the simulation, `side` standing: the shift of the next foothold, the plan,
        and how the solver ended."""
        robot, solver, other = self.robot, self.solver[side, phase], SIDES[1 - SIDES.index(side)]
        now, own = phase * TICK, self.place(side)
        heel, yaw = robot.foot(data, side)
        q, qd = robot.take(data, heel, own, yaw)  # the foot that stands is the origin
        q, qd = robot.ground(q, qd, side, own, 0.0)
        if now < DOUBLE - 1e-9:
            behind, turned = robot.foot(data, other)
            behind, turned = own + rotation("z", -yaw)[:2, :2] @ (behind - heel), turned - yaw
            q, qd = robot.ground(q, qd, other, behind, turned)
            solver.set_foothold(3 if phase else 2, behind, heading=turned)
        if shift is None or STEP - now > 0.07:  # later the foot could not follow
            shift = self.step_aside(side, phase, q, qd)
        for step in (1, 2) if phase else (1,):
            solver.set_foothold(step, self.place(side, step) + shift)
        for i in range(len(q)):
            solver.set_end(i, q[i])
            solver.set_end(i, qd[i], order=1)
        times = solver.problem.times
        reference = self.reference(side, now + times)[0]
        reference[:, robot.base[:2]] += np.outer(np.minimum(times / (STEP - now), 1), shift)
        solver.set_reference(2, reference)
        solver.start(self.start[side, phase])
        x, state = solver.iterate(self.iterations)
        motion = solver.problem.motion(x, np.arange(0, 3 * TICK, SAMPLE))
        return shift, Plan(*(rows[:, robot.joint] for rows in (motion.q, motion.qd, motion.tau))), state


def walk(urdf, *, seconds=10.0, push=None, lock=None, moving=False, camera=None, **settings):
    """Walks until the time is over or the robot has fallen. push: N s forward, N s left, from s on.
    moving: begins at the speed of the walk, not at rest."""
    with tempfile.TemporaryDirectory() as folder:
        robot = Robot(urdf, lock, folder)
        planner = Planner(robot, folder, **settings)
    data, ahead, spent, worst = robot.data, robot.ahead, [], []
    posture, rates = (rows[0] for rows in planner.reference("left", 0))
    robot.put(data, posture, rates if moving else 0 * rates)
    mujoco.mj_forward(robot.body, data)
    shift, plan, _ = planner.plan(data, "left", 0, None)
    for tick in range(round(seconds / TICK)):
        # The next plan is made while this one runs. So it begins where this one will have led by then,
        # as far as the robot knows: of a push to come it knows nothing.
        begin = time.process_time()
        mujoco.mj_copyData(ahead, robot.body, data)
        ahead.xfrc_applied[:] = 0
        for k in range(MILLISECONDS):
            robot.drive(ahead, plan, 0.001 * k)
        mujoco.mj_kinematics(robot.body, ahead)
        step, phase = divmod(tick + 1, PHASES)
        shift, following, state = planner.plan(ahead, SIDES[step % 2], phase, shift if phase else None)
        spent.append(time.process_time() - begin)
        worst.append(state.worst.worst / state.worst.size)
        for k in range(MILLISECONDS):
            now = tick * TICK + 0.001 * k
            pushed = push and push[2] <= now < push[2] + 0.1
            data.xfrc_applied[1, :2] = np.array(push[:2]) / 0.1 if pushed else 0
            robot.drive(data, plan, 0.001 * k)
        plan = following
        if camera:
            camera(robot, tick)
        upright = data.qpos[2] > 0.6 * robot.height and data.xmat[1][8] > 0.7
        if not upright:
            break
    return {"upright": bool(upright), "seconds": (tick + 1) * TICK, "steps": step, "ahead": float(data.qpos[0]),
            "left": float(data.qpos[1]), "spent": np.array(spent), "worst": np.array(worst)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("urdf")
    parser.add_argument("--push", type=float, nargs=3, metavar=("FORWARD", "LEFT", "AT"))
    parser.add_argument("--lock", metavar="REGEX")
    parser.add_argument("--moving", action="store_true")
    parser.add_argument("--film", metavar="FILE.png")
    for name, usual in (("seconds", 10.0), ("length", 0.15), ("width", 0.24), ("knee", 0.7), ("sole", 0.03)):
        parser.add_argument("--" + name, type=float, default=usual)
    parser.add_argument("--iterations", type=int, default=6)
    settings = vars(parser.parse_args())
    film, pictures = settings.pop("film"), []

    def camera(robot, tick):
        if film and tick % 10 == 5:
            view = mujoco.MjvCamera()
            view.lookat[:], view.distance, view.azimuth, view.elevation = robot.data.qpos[:3] - [0, 0, 0.2], 2.4, 120, -8
            with mujoco.Renderer(robot.body, 300, 180) as renderer:
                renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0
                renderer.update_scene(robot.data, view)
                pictures.append(renderer.render().copy())

    found = walk(settings.pop("urdf"), camera=camera, **settings)
    middle, high, most = 1e3 * np.percentile(found["spent"], [50, 95, 100])
    print(f"{'upright' if found['upright'] else 'fell'} after {found['seconds']:.2f} s and {found['steps']} steps, "
          f"{found['ahead']:.2f} m ahead, {found['left']:+.2f} m to the left")
    print(f"processor time of a plan: median {middle:.1f} ms, 95 of 100 within {high:.1f} ms, at most {most:.1f} ms")
    if film:
        from PIL import Image
        Image.fromarray(np.hstack(pictures[:12])).save(film)


if __name__ == "__main__":
    main()
