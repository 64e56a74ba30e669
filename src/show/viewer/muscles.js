// Muscles as rods along the limbs, thicker where stronger, coloured by the root of their activation,
// which is small in most motions; and the forces that joints bear.
import { Color, CylinderGeometry, Group, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion,
  Vector3 } from "three";
import { valueAt } from "./decode.js";
import { toView } from "./figure.js";
import { Arrow } from "./world.js";

const up = new Vector3(0, 1, 0), way = new Vector3(), size = new Vector3(), middle = new Vector3();
const turn = new Quaternion(), matrix = new Matrix4(), color = new Color();
const forceLength = 0.12; // m for the body weight
const thickness = 1.5e-4; // m for the root of a newton

const placeAt = ([f, l, u], where, out) =>
  toView(valueAt(f, where), valueAt(l, where), valueAt(u, where), out);

export class Muscles {
  constructor({ muscles, weight }, colors) {
    this.muscles = muscles.muscles.filter((m) => m.path.length > 1);
    this.frames = muscles.frames.map((places) => ({ places, origin: new Vector3(), x: new Vector3(),
      y: new Vector3(), z: new Vector3() }));
    this.weight = weight;
    this.rest = new Color(colors.muscle);
    this.active = new Color(colors.active);
    const count = this.muscles.reduce((sum, m) => sum + m.path.length - 1, 0);
    this.rods = new InstancedMesh(new CylinderGeometry(1, 1, 1, 10),
      new MeshStandardMaterial({ roughness: 0.5, transparent: true }), count);
    this.rods.frustumCulled = false;
    this.rods.renderOrder = 2; // after the flesh, which would dull their colours
    this.joints = muscles.joints.map((joint) => ({ joint, arrow: new Arrow(colors.contact) }));
    this.group = new Group();
    this.group.add(this.rods, ...this.joints.map(({ arrow }) => arrow.group));
    this.points = [];
  }

  // a corner is fixed on one link, or in the middle between where two have it
  corner(list, out) {
    out.set(0, 0, 0);
    for (let i = 0; i < list.length; i += 4) {
      const { origin, x, y, z } = this.frames[list[i]];
      out.add(origin).addScaledVector(x, list[i + 1]).addScaledVector(y, list[i + 2])
        .addScaledVector(z, list[i + 3]);
    }
    return out.multiplyScalar(4 / list.length);
  }

  poseFrames(where) {
    for (const { places: [origin, x, y], ...frame } of this.frames) {
      placeAt(origin, where, frame.origin);
      placeAt(x, where, frame.x).sub(frame.origin).normalize();
      placeAt(y, where, frame.y).sub(frame.origin).normalize();
      frame.z.crossVectors(frame.x, frame.y);
    }
  }

  pose(where, shows) {
    this.rods.visible = shows.muscles;
    if (shows.muscles) this.poseRods(where);
    for (const { joint, arrow } of this.joints) {
      placeAt(joint.force, where, way);
      arrow.set(placeAt(joint.at, where, middle), way,
        shows.contacts ? (way.length() / this.weight) * forceLength : 0);
    }
  }

  poseRods(where) {
    let rod = 0;
    this.poseFrames(where);
    for (const m of this.muscles) {
      const radius = thickness * Math.sqrt(m.strength);
      color.lerpColors(this.rest, this.active, Math.sqrt(Math.max(valueAt(m.activation, where), 0)));
      const points = m.path.map((list, i) => this.corner(list, this.points[i] ??= new Vector3()));
      for (let i = 1; i < points.length; i++, rod++) {
        way.subVectors(points[i], points[i - 1]);
        const length = Math.max(way.length(), 1e-6);
        middle.addVectors(points[i], points[i - 1]).multiplyScalar(0.5);
        turn.setFromUnitVectors(up, way.divideScalar(length));
        this.rods.setMatrixAt(rod, matrix.compose(middle, turn, size.set(radius, length, radius)));
        this.rods.setColorAt(rod, color);
      }
    }
    this.rods.instanceMatrix.needsUpdate = true;
    this.rods.instanceColor.needsUpdate = true;
  }
}
