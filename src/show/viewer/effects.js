// Which columns of a study say most: the axis whose values set an outcome apart, and that outcome.
//
// An axis explains the share of an outcome's variance that lies between its values:
//   share = 1 - [sum within groups / (n - groups)] / [sum of all / (n - 1)]
// the degrees of freedom keep chance near 0. Axes of many values are cut into groups of like count. An
// outcome counts by how much it varies: standard deviation over root mean square, 0 to 1.

const mostGroups = 6, leastOfRest = 0.3, leastRest = 1e-3;
const mean = (list) => list.reduce((sum, x) => sum + x, 0) / list.length;
const squares = (list, about = mean(list)) => list.reduce((sum, x) => sum + (x - about) ** 2, 0);

// the group of each: one for each value, or for each range of them
function groups(values) {
  const own = [...new Set(values)], count = Math.min(mostGroups, Math.floor(values.length / 2));
  if (own.length <= mostGroups && own.length < values.length) return values.map((x) => own.indexOf(x));
  const place = [];
  values.map((x, i) => [x, i]).sort((a, b) => a[0] - b[0]).forEach(([, i], k) => {
    place[i] = Math.floor((k * count) / values.length);
  });
  return place;
}

// y without the means of the groups
function rest(group, y) {
  const lists = [];
  group.forEach((g, i) => (lists[g] ??= []).push(y[i]));
  const means = lists.map(mean);
  return y.map((value, i) => value - means[group[i]]);
}

export function share(x, y) {
  const group = groups(x), free = y.length - new Set(group).size, all = squares(y);
  if (free < 1 || free === y.length - 1 || !(all > 0)) return 0;
  return Math.max(1 - (squares(rest(group, y), 0) / free) / (all / (y.length - 1)), 0);
}

export function variation(values) {
  const size = squares(values, 0);
  return values.length > 1 && size > 0 ? Math.sqrt(squares(values) / size) : 0;
}

// {x, y, shade} of columns: `axes` and `outcomes` are lists of them, cell(row, column) a value or null. Shade
// is the axis that says most of what x leaves of y; -1: none does. null: no axis has an effect.
export function strongest(rows, axes, outcomes, cell) {
  const isNumber = (x) => typeof x === "number" && Number.isFinite(x);
  const columns = (...wanted) => {
    const whole = rows.map((row) => wanted.map((c) => cell(row, c))).filter((list) => list.every(isNumber));
    return wanted.map((_, i) => whole.map((list) => list[i]));
  };
  const most = (list) => list.reduce((a, b) => (b.effect > a.effect ? b : a), { effect: 0 });
  const best = most(axes.flatMap((x) => outcomes.map((y) => {
    const [a, b] = columns(x, y);
    return { x, y, effect: a.length > 2 ? share(a, b) * variation(b) : 0 };
  })));
  if (!(best.effect > 0)) return null;
  const second = most(axes.filter((z) => z !== best.x).map((z) => {
    const [a, b, c] = columns(best.x, best.y, z), left = rest(groups(a), b);
    return { z, effect: squares(left, 0) > leastRest * squares(b) ? share(c, left) : 0 };
  }));
  return { x: best.x, y: best.y, shade: second.effect > leastOfRest ? second.z : -1 };
}
