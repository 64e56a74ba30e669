// A body: its meshes, or capsules along its bones and shoes on its soles; what it carries; posed at a
// time.
import {
  BufferAttribute, BufferGeometry, CapsuleGeometry, Color, Group, Matrix4, Mesh,
  MeshStandardMaterial, Quaternion, SphereGeometry, BoxGeometry, CylinderGeometry, Vector3,
} from "three";
import { sampleAt, valueAt } from "./decode.js";
import { Trunk, limb } from "./limbs.js";
import { Meshes } from "./meshes.js";

// forward, left, up to the axes of three.js: x forward, y up, z to the right
export const toView = (f, l, u, out = new Vector3()) => out.set(f, u, -l);

const up = new Vector3(0, 1, 0), way = new Vector3(), one = new Vector3(), other = new Vector3();
const turn = new Quaternion(), basis = new Matrix4();
const braceWidth = 0.078; // from the middle of a limb to a bar, m

export function pointAt(scene, point, where, out) {
  const [f, l, u] = scene.points[point];
  return toView(valueAt(f, where), valueAt(l, where), valueAt(u, where), out);
}

// thickness of a line of a stick figure, m
const lineRadius = (length) => Math.min(Math.max(0.13 * length, 0.018), 0.055);

function lengthAt(scene, ends) {
  pointAt(scene, ends[0], [0, 0], one);
  pointAt(scene, ends[1], [0, 0], other);
  return one.distanceTo(other);
}

// capsules of feet are covered by shoes
const isFoot = (bone) => /foot|toes/.test(bone.name ?? "");

export class Figure {
  constructor(scene, colors, ghost) {
    this.scene = scene;
    this.group = new Group();
    this.flesh = new Group(); // the body, and what it carries
    this.body = new Group();
    this.lines = new Group();
    this.flesh.add(this.body);
    this.group.add(this.flesh, this.lines);
    this.parts = [];
    this.ghost = ghost;
    const material = (color) => new MeshStandardMaterial({
      color: new Color(color), roughness: 0.62, metalness: 0.02,
      transparent: ghost, opacity: ghost ? 0.32 : 1, depthWrite: !ghost,
    });
    this.materials = { left: material(colors.left), right: material(colors.right),
      middle: material(colors.middle), carried: material(colors.carried),
      device: material(colors.device) };
    this.lineMaterials = {};
    for (const side of ["left", "right", "middle"])
      this.lineMaterials[side] = material(colors[side]);
    if (scene.meshes.length) {
      for (const side of ["left", "right", "middle"]) {
        this.materials[`mesh ${side}`] = material(colors[side]);
        this.materials[`mesh ${side}`].side = 2;
      }
      this.meshes = new Meshes(scene, this.materials, ghost);
      this.group.add(this.meshes.group);
      this.parts.push((where) => this.meshes.pose(where));
    }
    this.build();
  }

  build() {
    const { scene } = this;
    const capsules = scene.bones.filter((b) => b.kind === "capsule");
    const shod = scene.feet.some((foot) => foot.sole.length === 4);
    const trunk = new Trunk(scene);
    const covered = (bone) => (shod && isFoot(bone)) ||
      (trunk.isThere && /^(pelvis|trunk|shoulders)$/.test(bone.name));
    if (trunk.isThere) this.addTrunk(trunk);
    for (const bone of scene.bones) {
      const thin = bone.kind !== "capsule" && capsules.length > 0;
      if (bone.kind === "head") {
        if (!thin) this.addHead(bone);
        this.addBone({ ...bone, radius: 0 }, thin);
      } else if (!(bone.kind === "capsule" && covered(bone))) this.addBone(bone, thin);
    }
    for (const foot of scene.feet) if (foot.sole.length === 4) this.addShoe(foot);
    if (!scene.ground.is_there) this.addPivot();
    this.addCarried();
    this.showBones(false, false, true);
  }

  addMesh(geometry, material, parent = this.flesh) {
    const mesh = new Mesh(geometry, material);
    mesh.castShadow = !this.ghost;
    parent.add(mesh);
    return mesh;
  }

  addBone(bone, thin) {
    const length = Math.max(lengthAt(this.scene, bone.points), 1e-4);
    const radius = thin ? 0.011 : bone.radius || lineRadius(length);
    const mesh = this.addMesh((!thin && limb(bone.name, radius, length)) ||
      new CapsuleGeometry(radius, length, 8, 20),
      (thin ? this.lineMaterials : this.materials)[bone.side], thin ? this.lines : this.body);
    this.parts.push((where) => {
      pointAt(this.scene, bone.points[0], where, one);
      pointAt(this.scene, bone.points[1], where, other);
      way.subVectors(other, one);
      const now = way.length();
      mesh.position.addVectors(one, other).multiplyScalar(0.5);
      if (now > 1e-6) mesh.quaternion.copy(turn.setFromUnitVectors(up, way.divideScalar(now)));
    });
  }

  // what hangs on the world, hangs there
  addPivot() {
    const still = ([f, l, u]) => [f, l, u].every((x) => Math.max(...x) - Math.min(...x) < 1e-3);
    const points = new Set(this.scene.bones.flatMap((b) => b.points));
    for (const point of points) {
      if (!still(this.scene.points[point])) continue;
      const mesh = this.addMesh(new SphereGeometry(0.05, 24, 16), this.materials.device);
      pointAt(this.scene, point, [0, 0], mesh.position);
    }
  }

  addTrunk(trunk) {
    const mesh = this.addMesh(trunk.geometry, this.materials.middle, this.body);
    mesh.frustumCulled = false;
    this.materials.middle.side = 2;
    this.parts.push((where) => trunk.pose(where));
  }

  addHead(bone) {
    const mesh = this.addMesh(new SphereGeometry(bone.radius, 28, 20), this.materials.middle, this.body);
    this.parts.push((where) => pointAt(this.scene, bone.points[1], where, mesh.position));
  }

  // sole: heel inside and outside, toe outside and inside; the upper part leads to the ankle
  addShoe(foot) {
    const corners = foot.sole, position = new Float32Array(9 * 3);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    const quads = [[0, 1, 2, 3], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]];
    const index = quads.flatMap(([a, b, c, d]) => [a, c, b, a, d, c]);
    index.push(4, 8, 5, 5, 8, 6, 6, 8, 7, 7, 8, 4);
    geometry.setIndex(index);
    const flat = this.materials[foot.side].clone();
    flat.flatShading = true;
    flat.side = 2;
    this.materials[`shoe ${foot.name}`] = flat;
    const mesh = this.addMesh(geometry, flat, this.body);
    mesh.frustumCulled = false;
    const at = corners.map(() => new Vector3()), ankle = new Vector3(), middle = new Vector3();
    const set = (i, v) => position.set([v.x, v.y, v.z], 3 * i);
    this.parts.push((where) => {
      corners.forEach((p, i) => pointAt(this.scene, p, where, at[i]));
      pointAt(this.scene, foot.ankle, where, ankle);
      middle.set(0, 0, 0);
      for (const corner of at) middle.addScaledVector(corner, 0.25);
      // away from the sole, at right angles to it
      one.subVectors(at[3], at[0]);
      other.subVectors(at[1], at[0]);
      way.crossVectors(one, other).normalize();
      if (way.dot(other.subVectors(ankle, middle)) < 0) way.negate();
      const height = Math.max(other.subVectors(ankle, at[0]).dot(way), 0.03);
      at.forEach((corner, i) => {
        set(i, corner);
        const lift = i < 2 ? 0.62 * height : 0.03;
        other.lerpVectors(corner, middle, i < 2 ? 0.1 : 0.16).addScaledVector(way, lift);
        set(4 + i, other);
      });
      set(8, other.copy(ankle).addScaledVector(way, 0.012));
      geometry.attributes.position.needsUpdate = true;
      geometry.computeVertexNormals();
    });
  }

  // two loads that keep their distance, one on each side, are one box between them
  addCarried() {
    for (const h of this.scene.held ?? []) if (h.mass > 0) this.addHeld(h);
    const loads = this.scene.worn.filter((w) => w.kind === "load");
    const pair = ["left", "right"].map((side) => loads.filter((w) => w.side === side));
    if (pair[0].length === 1 && pair[1].length === 1 && loads.length === 2 && this.keepApart(pair))
      return this.addBox(pair[0][0], pair[1][0]);
    for (const load of loads) this.addLoad(load);
    for (const device of this.scene.worn.filter((w) => w.kind === "device")) this.addDevice(device);
    return undefined;
  }

  // a box about a point, along those in the middles of its front and its top
  addLoad(load) {
    const [f, l, u] = load.size ?? [0.1, 0.14, 0.2]; // scenes of older versions have none
    const mesh = this.addMesh(new BoxGeometry(f, u, l), this.materials.carried);
    this.parts.push((where) => {
      pointAt(this.scene, load.from, where, mesh.position);
      if (load.ahead === undefined) return;
      pointAt(this.scene, load.ahead, where, one).sub(mesh.position).normalize();
      pointAt(this.scene, load.above, where, other).sub(mesh.position).normalize();
      mesh.quaternion.setFromRotationMatrix(basis.makeBasis(one, other, way.crossVectors(one, other)));
    });
  }

  // between the hands while they hold it; before and after, where they took it and put it down
  addHeld(held) {
    const [f, l, u] = held.size.every((x) => x > 0) ? held.size : [0.12, 0.12, 0.12];
    const mesh = this.addMesh(new BoxGeometry(f, u, l), this.materials.carried);
    this.parts.push((where) => {
      const last = this.scene.samples - 1, { duration } = this.scene;
      const t = ((where[0] + where[1]) / last) * duration;
      const at = sampleAt(this.scene, Math.min(Math.max(t, held.from), held.to));
      pointAt(this.scene, held.one, at, one);
      pointAt(this.scene, held.other, at, other);
      way.subVectors(other, one);
      mesh.position.addVectors(one, other).multiplyScalar(0.5).add(toView(...held.center, one));
      mesh.rotation.set(0, way.lengthSq() > 1e-6 ? Math.atan2(-way.x, -way.z) : 0, 0);
    });
  }

  keepApart([[left], [right]]) {
    const gaps = [];
    for (let k = 0; k < this.scene.samples - 1; k += 4) {
      pointAt(this.scene, left.from, [k, 0], one);
      pointAt(this.scene, right.from, [k, 0], other);
      gaps.push(one.distanceTo(other));
    }
    return Math.max(...gaps) - Math.min(...gaps) < 0.03;
  }

  addBox(left, right) {
    const gap = lengthAt(this.scene, [left.from, right.from]);
    const mesh = this.addMesh(new BoxGeometry(0.3, 0.24, Math.max(gap - 0.05, 0.1)),
      this.materials.carried);
    this.parts.push((where) => {
      pointAt(this.scene, left.from, where, one);
      pointAt(this.scene, right.from, where, other);
      mesh.position.addVectors(one, other).multiplyScalar(0.5);
      mesh.position.y -= 0.06;
      way.subVectors(other, one);
      mesh.rotation.set(0, Math.atan2(way.x, way.z), 0);
    });
  }

  // a rod of the device's colour between two places, which moves
  addRod(radius, place) {
    const mesh = this.addMesh(new CylinderGeometry(radius, radius, 1, 12), this.materials.device);
    this.parts.push((where) => {
      const thick = place(where, one, other);
      way.subVectors(other, one);
      const now = Math.max(way.length(), 1e-6);
      mesh.position.addVectors(one, other).multiplyScalar(0.5);
      mesh.scale.set(thick, now, thick);
      mesh.quaternion.copy(turn.setFromUnitVectors(up, way.divideScalar(now)));
    });
  }

  // a cable, or a brace: cuffs around the limbs, bars on both sides from them to the hinge
  addDevice(device) {
    const most = Math.max(...device.effort.map(Math.abs), 1e-9);
    const share = (where) => Math.abs(valueAt(device.effort, where)) / most;
    const { from, to = from, hinge = device.radius === undefined ? undefined : from } = device;
    if (hinge === undefined) {
      this.addRod(0.012, (where, a, b) => {
        pointAt(this.scene, from, where, a);
        pointAt(this.scene, to, where, b);
        return 0.5 + share(where);
      });
      return;
    }
    for (const end of [from, to]) {
      for (const side of [-braceWidth, braceWidth])
        this.addRod(0.013, (where, a, b) => {
          pointAt(this.scene, end, where, a).z += side;
          pointAt(this.scene, hinge, where, b).z += side;
          return 1;
        });
      this.addRod(braceWidth + 0.008, (where, a, b) => {
        pointAt(this.scene, end, where, a);
        pointAt(this.scene, hinge, where, b).sub(a).setLength(0.03);
        b.add(a);
        return 1;
      });
    }
    for (const side of [-braceWidth, braceWidth])
      this.addRod(0.05, (where, a, b) => {
        pointAt(this.scene, hinge, where, a).z += side - 0.012;
        b.copy(a).z += 0.024;
        return 0.55 + 0.45 * share(where);
      });
  }

  // thin lines or muscles seen through the body, or the body alone; with meshes in its place
  showBones(on, through, meshes) {
    const skin = Boolean(meshes && this.meshes), bare = this.lines.children.length === 0;
    this.lines.visible = on || !this.body.children.length;
    this.body.visible = !skin || (on && bare);
    if (this.meshes) this.meshes.group.visible = skin;
    if (this.ghost) return;
    for (const [name, m] of Object.entries(this.materials)) {
      const faint = through && (!skin || name.startsWith("mesh "));
      m.transparent = faint;
      m.opacity = faint ? 0.22 : 1;
      m.depthWrite = !faint;
      m.needsUpdate = true;
    }
  }

  pose(time) {
    const where = sampleAt(this.scene, time);
    for (const part of this.parts) part(where);
  }
}
