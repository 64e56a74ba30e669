// Reads what src/page/packed_text.h wrote: base64 of the deflate format (RFC 1951). Browsers have it
// too, but not all of them, and not at once.

const order = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];

// least lengths or distances of codes and how many bits follow: `flat` codes have none, then every
// `step` codes one more
function ladder(first, codes, flat, step) {
  const base = [], bits = [];
  for (let code = 0, next = first; code < codes; code++) {
    bits.push(code < flat ? 0 : Math.floor((code - flat) / step) + 1);
    base.push(next);
    next += 2 ** bits[code];
  }
  return { base, bits };
}
const lengths = ladder(3, 29, 8, 4), distances = ladder(1, 30, 4, 2);
[lengths.base[28], lengths.bits[28]] = [258, 0];

// symbols in the order of their codes, and how many there are of each length
function codeOf(bitsOf) {
  const counts = new Uint16Array(16), symbols = [];
  for (let length = 1; length < 16; length++)
    bitsOf.forEach((bits, symbol) => {
      if (bits !== length) return;
      counts[length] += 1;
      symbols.push(symbol);
    });
  return { counts, symbols };
}

// The text that was packed.
export function inflate(base64) {
  const bytes = Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));
  let out = new Uint8Array(8 * bytes.length + 1024), size = 0, place = 0, held = 0, left = 0;
  const bit = () => {
    if (left === 0) {
      if (place === bytes.length) throw new Error("the page is cut off");
      held = bytes[place++];
      left = 8;
    }
    left -= 1;
    const value = held & 1;
    held >>= 1;
    return value;
  };
  const number = (bits) => {
    let value = 0;
    for (let i = 0; i < bits; i++) value |= bit() << i;
    return value;
  };
  const symbol = ({ counts, symbols }) => {
    let code = 0, first = 0, index = 0;
    for (let length = 1; length < 16; length++) {
      code |= bit();
      if (code - first < counts[length]) return symbols[index + code - first];
      index += counts[length];
      first = (first + counts[length]) << 1;
      code <<= 1;
    }
    throw new Error("the page is damaged");
  };
  const room = (more) => {
    if (size + more <= out.length) return;
    const larger = new Uint8Array(2 * out.length + more);
    larger.set(out);
    out = larger;
  };
  const codes = () => {
    const literals = number(5) + 257, others = number(5) + 1, told = number(4) + 4;
    const tells = new Array(19).fill(0), bits = [];
    for (let i = 0; i < told; i++) tells[order[i]] = number(3);
    const code = codeOf(tells);
    while (bits.length < literals + others) {
      const next = symbol(code);
      if (next < 16) bits.push(next);
      else {
        const run = next === 16 ? 3 + number(2) : next === 17 ? 3 + number(3) : 11 + number(7);
        const value = next === 16 ? bits[bits.length - 1] : 0;
        for (let i = 0; i < run; i++) bits.push(value);
      }
    }
    return [codeOf(bits.slice(0, literals)), codeOf(bits.slice(literals))];
  };
  for (let last = 0; !last;) {
    last = number(1);
    if (number(2) !== 2) throw new Error("the page is packed as nobody packs it here");
    const [literal, distance] = codes();
    for (let next = symbol(literal); next !== 256; next = symbol(literal)) {
      if (next < 256) {
        room(1);
        out[size++] = next;
        continue;
      }
      const length = lengths.base[next - 257] + number(lengths.bits[next - 257]);
      const code = symbol(distance);
      const from = size - distances.base[code] - number(distances.bits[code]);
      room(length);
      for (let i = 0; i < length; i++) out[size++] = out[from + i];
    }
  }
  return new TextDecoder().decode(out.subarray(0, size));
}
