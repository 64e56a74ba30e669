"""A robot of a URDF as a model of ambulo and as a body of MuJoCo, and the way between the two.

For robot_walks.py, which docs/tutorial-mpc.md explains. States q, qd are those of ambulo: first
where the base is and how it is turned, then the joints.
"""
import pathlib
import re
import subprocess
import xml.etree.ElementTree as xml

import ambulo
import mujoco
import numpy as np

BASE = ["base_tx", "base_ty", "base_tz", "base_tilt", "base_list", "base_rotation"]
SIDES = ("left", "right")
STIFFNESS, DAMPING = 200.0, 5.0  # N m/rad, N m s/rad
ARMATURE = 0.01  # kg m^2 of each motor, which plans do not know
PALE = dict(contype=0, conaffinity=0, mass=0, rgba=[0.3, 0.5, 0.8, 1])  # seen, but not there


def rotation(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    first = "xyz".index(axis)
    return np.roll([[1, 0, 0], [0, c, -s], [0, s, c]], (first, first), (0, 1))


def prepared(urdf, lock):
    """The URDF without meshes and a floating base, with the joints that match `lock` held at zero."""
    root = xml.parse(urdf).getroot()
    for joint in root.findall("joint"):
        if lock and joint.get("type") == "revolute" and re.search(lock, joint.get("name")):
            joint.set("type", "fixed")
        if joint.get("type") == "floating":
            root.remove(joint)
            root.remove(root.find(f"link[@name='{joint.find('parent').get('link')}']"))
    for link in root.findall("link"):
        for part in link.findall("visual") + link.findall("collision"):
            if part.tag == "visual" or part.find(".//mesh") is not None:
                link.remove(part)
    return xml.tostring(root, "unicode")


class Robot:
    def __init__(self, urdf, lock, folder):
        source, target = pathlib.Path(folder) / "robot.urdf", pathlib.Path(folder) / "robot.yaml"
        source.write_text(prepared(urdf, lock))
        subprocess.run([ambulo.program(), "import", source, "-o", target], check=True, stderr=subprocess.DEVNULL)
        self.model = ambulo.Model.load(target)
        coordinates = self.model.coordinates
        self.names = [c.name for c in coordinates]
        self.base = [self.names.index(name) for name in BASE]
        self.joint = [i for i in range(len(self.names)) if i not in self.base]
        self.range, self.speed, self.torque = (np.array([getattr(coordinates[i], what) for i in self.joint])
                                               for what in ("range", "speed", "torque"))
        self.height = float(re.search(r"xyz: \[0, 0, ([-0-9.]+)\]", target.read_text()).group(1))
        self.body = self.build(mujoco.MjSpec.from_file(str(source)))
        self.data, self.ahead, self.scratch = (mujoco.MjData(self.body) for _ in range(3))
        joints = [self.body.joint(self.names[i]) for i in self.joint]
        self.at, self.rate_at = ([int(getattr(j, what)[0]) for j in joints] for what in ("qposadr", "dofadr"))
        self.leg = {side: [k for k, i in enumerate(self.joint) if self.names[i].startswith(side)] for side in SIDES}

    def build(self, spec):
        spec.compiler.discardvisual = False
        spec.option.timestep, spec.option.integrator = 0.001, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        shape = mujoco.mjtGeom
        spec.worldbody.add_geom(type=shape.mjGEOM_PLANE, size=[50, 50, 0.1], friction=[0.8, 0.005, 1e-4])
        spec.worldbody.add_light(pos=[0, 0, 6], type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL)
        trunk = spec.worldbody.bodies[0]
        trunk.add_freejoint()
        trunk.add_geom(type=shape.mjGEOM_BOX, pos=[0, 0, 0.2], size=[0.07, 0.12, 0.2], **PALE)
        for link in spec.bodies[1:]:
            for child in link.bodies:
                if np.linalg.norm(child.pos) > 0.03:
                    link.add_geom(type=shape.mjGEOM_CAPSULE, fromto=[0, 0, 0, *child.pos], size=[0.04, 0, 0], **PALE)
        for i in self.joint:
            spec.joint(self.names[i]).armature = ARMATURE
            spec.add_actuator(name=self.names[i], target=self.names[i], trntype=mujoco.mjtTrn.mjTRN_JOINT)
        self.add_heels(spec)
        return spec.compile()

    def add_heels(self, spec):
        """A site for each foot: where its heel is, with the axes of the world at q = 0."""
        bare = spec.compile()
        data = mujoco.MjData(bare)
        data.qpos[:3] = 0, 0, self.height
        mujoco.mj_kinematics(bare, data)
        points = self.model.inverse_dynamics(np.zeros((1, len(self.names)))).points[0]
        for foot in self.model.feet:
            link = data.body(self.model.links[self.model.points[foot.heel_center].link].name)
            turn = link.xmat.reshape(3, 3).T
            site = spec.body(link.name).add_site(name=foot.name, pos=turn @ (points[foot.heel_center] - link.xpos))
            mujoco.mju_mat2Quat(site.quat, turn.ravel())

    # ------------------------------------------------------------------- states

    @staticmethod
    def turning(b, c):
        """The base is turned by tilt a about y, then list b about x, then rotation c about z: from
        the rates of these to the angular velocity in its own axes."""
        own = rotation("z", c).T
        return np.array([own @ rotation("x", b).T @ [0, 1, 0], own @ [1, 0, 0], [0, 0, 1]]).T

    def put(self, data, q, qd):
        x, y, z, a, b, c = q[self.base]
        data.qpos[:3] = x, y, z + self.height
        mujoco.mju_mat2Quat(data.qpos[3:7], (rotation("y", a) @ rotation("x", b) @ rotation("z", c)).ravel())
        data.qpos[self.at], data.qvel[self.rate_at] = q[self.joint], qd[self.joint]
        data.qvel[:3], data.qvel[3:6] = qd[self.base[:3]], self.turning(b, c) @ qd[self.base[3:]]

    def take(self, data, origin, place, yaw):
        """The state in axes turned by yaw, in which the point `origin` of the ground is at `place`."""
        turn, own = rotation("z", -yaw), np.zeros(9)
        mujoco.mju_quat2Mat(own, data.qpos[3:7])
        own = turn @ own.reshape(3, 3)
        a, b, c = np.arctan2(own[0, 2], own[2, 2]), np.arcsin(-own[1, 2]), np.arctan2(own[1, 0], own[1, 1])
        q, qd = np.zeros((2, len(self.names)))
        q[self.base] = *(turn @ (data.qpos[:3] - [*origin, 0]) + [*place, -self.height]), a, b, c
        qd[self.base] = *(turn @ data.qvel[:3]), *np.linalg.solve(self.turning(b, c), data.qvel[3:6])
        q[self.joint], qd[self.joint] = data.qpos[self.at], data.qvel[self.rate_at]
        return q, qd

    @staticmethod
    def foot(data, side):
        """Where its heel is, and its yaw."""
        site = data.site(side)
        return site.xpos[:2].copy(), np.arctan2(site.xmat[3], site.xmat[0])

    def ground(self, q, qd, side, place, yaw):
        """The state with that foot flat on its place, and still. The base stays as it was measured,
        the leg gives way: Newton's method on the pose of the foot, dq = J^T (J J^T + e)^-1 error."""
        data, leg = self.scratch, self.leg[side]
        at, rate_at = np.array(self.at)[leg], np.array(self.rate_at)[leg]
        self.put(data, q, qd)
        jacobian, site, goal = np.zeros((6, self.body.nv)), data.site(side), rotation("z", yaw)
        for _ in range(5):
            mujoco.mj_kinematics(self.body, data)
            mujoco.mj_comPos(self.body, data)
            mujoco.mj_jacSite(self.body, data, jacobian[:3], jacobian[3:], site.id)
            off = goal @ site.xmat.reshape(3, 3).T
            turned = 0.5 * np.array([off[2, 1] - off[1, 2], off[0, 2] - off[2, 0], off[1, 0] - off[0, 1]])
            own = jacobian[:, rate_at]
            inverse = own.T @ np.linalg.inv(own @ own.T + 1e-4 * np.eye(6))
            data.qpos[at] = np.clip(data.qpos[at] + inverse @ [*([*place, 0] - site.xpos), *turned], *self.range[leg].T)
        data.qvel[rate_at] = 0
        data.qvel[rate_at] = -inverse @ (jacobian @ data.qvel)
        q, qd = q.copy(), qd.copy()
        q[self.joint] = np.clip(data.qpos[self.at], *(self.range.T + [[1e-3], [-1e-3]]))
        qd[self.joint] = np.clip(data.qvel[self.rate_at], *(0.98 * self.speed.T))
        return q, qd

    def capture_point(self, q, qd):
        """xi = c + v / omega, of the centre of mass, on the ground; and omega = sqrt(g / height)."""
        data = self.scratch
        self.put(data, q, qd)
        for function in (mujoco.mj_kinematics, mujoco.mj_comPos, mujoco.mj_comVel, mujoco.mj_subtreeVel):
            function(self.body, data)
        omega = np.sqrt(-self.model.gravity[2] / data.subtree_com[0][2])
        return data.subtree_com[0][:2] + data.subtree_linvel[0][:2] / omega, omega

    def drive(self, data, plan, since):
        """A millisecond of a plan that began `since` s ago, within the limits of the motors:

            tau = tau_plan + K (q_plan - q) + D (qd_plan - qd)
        """
        q, qd, tau = plan.at(since)
        data.ctrl[:] = np.clip(tau + STIFFNESS * (q - data.qpos[self.at]) + DAMPING * (qd - data.qvel[self.rate_at]),
                               *self.torque.T)
        mujoco.mj_step(self.body, data)
