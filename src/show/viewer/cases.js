// Cases of a study, opened one at a time: what src/show/case_block.h and motion_pack.h wrote.
import { short } from "./dom.js";
import { bytesOf, inflatedBytes, textOf } from "./inflated.js";

// whole numbers, seven bits a byte from the lowest on; the last bit of all is the sign's
class Numbers {
  constructor(bytes, at) {
    this.bytes = bytes;
    this.at = at;
  }

  next() {
    let value = 0, times = 1, byte;
    do {
      byte = this.bytes[this.at++];
      value += (byte & 127) * times;
      times *= 128;
    } while (byte > 127);
    return value % 2 ? -(value + 1) / 2 : value / 2;
  }
}

// sums along each series, in place
function addUp(values, samples, order) {
  for (let from = 0; from < values.length; from += samples)
    for (let round = 0; round < order; round++)
      for (let k = from + 1; k < from + samples; k++) values[k] += values[k - 1];
  return values;
}

// motions of one family: v = (M + sum c e B) / Q + r, in steps
class Motions {
  constructor(numbers, { kinds, samples, count }) {
    Object.assign(this, { kinds, samples });
    this.size = kinds.length * samples;
    const row = (order) => addUp(Float64Array.from({ length: this.size }, () => numbers.next()),
      samples, order);
    const components = numbers.next();
    this.order = numbers.next();
    this.q = 2 * Math.ceil(Math.sqrt(components + 1));
    this.mean = row(2);
    this.components = Array.from({ length: components }, () => row(1));
    const scales = this.components.map((b) =>
      this.q / (4 * b.reduce((most, x) => Math.max(most, Math.abs(x)), 1)));
    this.weights = scales.map((e) => Float64Array.from({ length: count }, () => numbers.next() * e));
    this.rests = Array.from({ length: count }, () => {
      const left = numbers.next();
      return Float64Array.from({ length: 2 * left }, () => numbers.next());
    });
  }

  // series of one motion, in steps
  row(i) {
    const rest = new Float64Array(this.size), pairs = this.rests[i];
    for (let k = 0, at = -1; k < pairs.length; k += 2) {
      at += pairs[k] + 1;
      rest[at] = pairs[k + 1];
    }
    addUp(rest, this.samples, this.order);
    const sum = this.mean.slice();
    this.components.forEach((b, k) => {
      const weight = this.weights[k][i];
      for (let v = 0; v < sum.length; v++) sum[v] += weight * b[v];
    });
    for (let v = 0; v < sum.length; v++) rest[v] += sum[v] / this.q;
    return rest;
  }
}

// a tree with a leaf or a series in place of each number
function filled(tree, leaf, series) {
  if (typeof tree === "number") return tree >= 0 ? leaf(tree) : series(-1 - tree);
  if (Array.isArray(tree)) return tree.map((x) => filled(x, leaf, series));
  return Object.fromEntries(Object.entries(tree).map(([key, x]) => [key, filled(x, leaf, series)]));
}

class Block {
  constructor(packed) {
    const bytes = inflatedBytes(bytesOf(packed)), end = bytes.indexOf(0);
    Object.assign(this, JSON.parse(textOf(bytes.subarray(0, end))));
    const numbers = new Numbers(bytes, end + 1);
    this.motions = this.families.map((f) => f.kinds && new Motions(numbers, f));
    const rows = [{}, {}]; // how many cases of a form, and of a family, came before
    this.rows = this.cases.map((pair) => pair.map((n, i) => {
      rows[i][n] = (rows[i][n] ?? -1) + 1;
      return rows[i][n];
    }));
  }

  // {summary, scene} of a case; series are arrays of SI units
  open(i) {
    const [form, family] = this.cases[i], [row, number] = this.rows[i];
    const { tree, columns } = this.forms[form], motions = this.motions[family];
    const leaf = (c) => {
      const column = columns[c];
      if (!Array.isArray(column)) return leaf(column.of) * column.by;
      return column.length === 1 ? column[0] : column[row];
    };
    const values = motions && motions.row(number), sizes = {};
    const series = (s) => {
      const { kinds, samples } = motions, kind = kinds[s], scale = this.steps[kind] * (sizes[kind] ?? 1);
      return Float32Array.from(values.subarray(s * samples, (s + 1) * samples), (x) => x * scale);
    };
    const positive = (c) => c !== undefined && leaf(c) > 0 ? leaf(c) : 1;
    sizes.t = sizes.p = positive(tree.scene.mass);
    sizes.f = positive(tree.scene.weight);
    const data = filled(tree, leaf, series);
    data.scene.samples = this.families[family].samples;
    return data;
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
