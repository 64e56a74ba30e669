// Cases of a study, opened one at a time: what src/study/case_pack.h wrote.
import { short } from "./dom.js";
import { bytesOf, inflatedBytes, textOf } from "./inflated.js";

// a tree with an array in place of each {"series": k}
function filled(tree, series) {
  if (tree === null || typeof tree !== "object") return tree;
  if (Array.isArray(tree)) return tree.map((x) => filled(x, series));
  if (typeof tree.series === "number") return series(tree.series);
  return Object.fromEntries(Object.entries(tree).map(([key, x]) => [key, filled(x, series)]));
}

class Block {
  constructor(packed) {
    this.bytes = inflatedBytes(bytesOf(packed));
    const end = this.bytes.indexOf(0);
    Object.assign(this, JSON.parse(textOf(this.bytes.subarray(0, end))));
    let at = end + 1;
    for (const one of this.cases) {
      one.at = at;
      at += one.bytes;
    }
  }

  // all series of a case, in steps: sums of whole numbers, seven bits a byte from the lowest on,
  // whose last bit is the sign's; and those of the case that it is like
  values({ at, kinds, samples, like }) {
    const sum = like < 0 ? new Float64Array(kinds.length * samples) : this.values(this.cases[like]);
    for (let i = 0, own = 0; i < sum.length; i++) {
      let value = 0, times = 1, byte;
      do {
        byte = this.bytes[at++];
        value += (byte & 127) * times;
        times *= 128;
      } while (byte > 127);
      own = (i % samples ? own : 0) + (value % 2 ? -(value + 1) / 2 : value / 2);
      sum[i] += own;
    }
    return sum;
  }

  // {summary, scene} of a case; series are arrays of SI units
  open(i) {
    const one = this.cases[i], { samples, kinds, summary, scene } = one, values = this.values(one);
    const positive = (x) => typeof x === "number" && x > 0 ? x : 1;
    const mass = positive(scene.mass), weight = positive(scene.weight);
    const size = { l: 1, a: 1, t: mass, p: mass, f: weight };
    const series = (k) => Float32Array.from(values.subarray(k * samples, (k + 1) * samples),
      (x) => x * this.steps[kinds[k]] * size[kinds[k]]);
    return { summary, scene: { ...filled(scene, series), samples } };
  }
}

// All of them: [{count, packed}, ...]; a block is unpacked when a case of it is first asked for.
export class Cases {
  constructor(blocks) {
    this.blocks = blocks;
  }

  open(i) {
    for (const block of this.blocks) {
      if (i < block.count) return (block.opened ??= new Block(block.packed)).open(i);
      i -= block.count;
    }
    return null;
  }

  // how near a motion that was opened is to that of the case's own folder
  precision(scene) {
    const { steps, every } = this.blocks.find((block) => block.opened).opened;
    const half = (kind, unit = 1) => short((unit * steps[kind]) / 2, 2);
    return `Motions in this page are packed: at the ${scene.samples} times that they have`
      + `${every > 1 ? ` (one in ${every} of the case's own page)` : ""}, places are within `
      + `${half("l", 1000)} mm, angles within ${half("a", 180 / Math.PI)}°, forces within `
      + `${half("f", 100)} % of the weight, torques and powers within ${half("t")} N m/kg and `
      + `${half("p")} W/kg of what the case's own folder says, of which a page of its own has all digits.`;
  }
}
