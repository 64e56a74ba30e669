// What a body looks like: meshes, each fixed on a link's frame.
import { BufferAttribute, BufferGeometry, Group, Matrix4, Mesh, Vector3 } from "three";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import { valueAt } from "./decode.js";
import { toView } from "./figure.js";

const crease = 0.6; // rad: a sharper edge is one
const origin = new Vector3(), x = new Vector3(), y = new Vector3(), z = new Vector3();
const matrix = new Matrix4();

const placeAt = ([f, l, u], where, out) =>
  toView(valueAt(f, where), valueAt(l, where), valueAt(u, where), out);

export class Meshes {
  constructor(scene, materials, ghost) {
    this.group = new Group();
    this.parts = scene.meshes.map(({ frame, side, vertices, triangles }) => {
      const plain = new BufferGeometry();
      plain.setAttribute("position", new BufferAttribute(Float32Array.from(vertices), 3));
      plain.setIndex(new BufferAttribute(Uint32Array.from(triangles), 1));
      const mesh = new Mesh(toCreasedNormals(plain, crease), materials[side]);
      mesh.castShadow = !ghost;
      mesh.matrixAutoUpdate = false;
      mesh.frustumCulled = false;
      this.group.add(mesh);
      return { mesh, frame };
    });
  }

  // height of the highest vertex as posed: heads reach above the last joint
  top() {
    let high = -Infinity;
    for (const { mesh } of this.parts) {
      mesh.geometry.computeBoundingBox();
      high = Math.max(high, mesh.geometry.boundingBox.clone().applyMatrix4(mesh.matrix).max.y);
    }
    return high;
  }

  pose(where) {
    for (const { mesh, frame } of this.parts) {
      placeAt(frame[0], where, origin);
      placeAt(frame[1], where, x).sub(origin).normalize();
      placeAt(frame[2], where, y).sub(origin);
      z.crossVectors(x, y).normalize();
      y.crossVectors(z, x);
      mesh.matrix.copy(matrix.makeBasis(x, y, z).setPosition(origin));
    }
  }
}
