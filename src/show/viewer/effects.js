// Which columns of a study say most: the axis whose values set an outcome apart, and that outcome.
//
// An axis explains the share of an outcome's variance that lies between its values:
//   share = 1 - [sum within groups / (n - groups)] / [sum of all / (n - 1)]
// the degrees of freedom keep chance near 0. Axes of many values are cut into groups of like count. An
// outcome counts by how much it varies: standard deviation over root mean square, 0 to 1.

const mostGroups = 6;
const mean = (list) => list.reduce((sum, x) => sum + x, 0) / list.length;
const squares = (list, about = mean(list)) => list.reduce((sum, x) => sum + (x - about) ** 2, 0);

// pairs [x, y] to lists of y, one for each value of x, or for each range of them
function groups(pairs) {
  const byValue = new Map();
  for (const [x, y] of pairs) byValue.set(x, [...(byValue.get(x) ?? []), y]);
  if (byValue.size <= mostGroups && byValue.size < pairs.length) return [...byValue.values()];
  const sorted = [...pairs].sort((a, b) => a[0] - b[0]), count = Math.min(mostGroups, Math.floor(pairs.length / 2));
  const list = Array.from({ length: count }, () => []);
  sorted.forEach(([, y], i) => list[Math.floor((i * count) / sorted.length)].push(y));
  return list;
}

export function share(pairs) {
  const list = groups(pairs), values = pairs.map(([, y]) => y), all = squares(values);
  const free = pairs.length - list.length;
  if (list.length < 2 || free < 1 || !(all > 0)) return 0;
  const within = list.reduce((sum, group) => sum + squares(group), 0);
  return Math.max(1 - (within / free) / (all / (pairs.length - 1)), 0);
}

export function variation(values) {
  const size = squares(values, 0);
  return values.length > 1 && size > 0 ? Math.sqrt(squares(values) / size) : 0;
}

// {x, y, shade} of columns: `axes` and `outcomes` are lists of them, cell(row, column) a value or null. Shade
// is the axis that says most of y besides x, -1 where none says a twentieth of what x does. null: no effects.
export function strongest(rows, axes, outcomes, cell) {
  const isNumber = (x) => typeof x === "number" && Number.isFinite(x);
  const effect = (x, y) => {
    const pairs = rows.map((row) => [cell(row, x), cell(row, y)]).filter((pair) => pair.every(isNumber));
    return pairs.length > 2 ? share(pairs) * variation(pairs.map((pair) => pair[1])) : 0;
  };
  const all = axes.flatMap((x) => outcomes.map((y) => ({ x, y, effect: effect(x, y) })));
  const best = all.reduce((a, b) => (b.effect > a.effect ? b : a), { effect: 0 });
  if (!(best.effect > 0)) return null;
  const second = all.filter((one) => one.y === best.y && one.x !== best.x)
    .reduce((a, b) => (b.effect > a.effect ? b : a), { x: -1, effect: 0.05 * best.effect });
  return { x: best.x, y: best.y, shade: second.x };
}
