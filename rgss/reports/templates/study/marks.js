// ------------------------------------------------------- coinciding marks, titles of axes
// The scale of a measure ends where its estimates must, such as a share at 1, unless something drawn lies beyond.
// Values that are all alike have a tenth of them on both sides, where the library takes 1, whatever they are.
const scaleOf = (values, { least, most } = {}) => {
  const [low, high] = [Math.min(...values), Math.max(...values)], room = Math.abs(low) / 10 || 1;
  const from = known(least) && low >= least ? least : null, to = known(most) && high <= most ? most : null;
  if (high - low > 1e-9 * Math.abs(low)) return { autorangeoptions: { ...(from === null ? {} : { clipmin: from }), ...(to === null ? {} : { clipmax: to }) } };
  return { range: [Math.max(low - room, from ?? -Infinity), Math.min(high + room, to ?? Infinity)] };
};
const SHARE = { least: 0, most: 1 };
// Width and height in pixels that the marks of a plot have: some nine tenths of the room between its margins.
const roomOf = (host) => [0.9 * Math.max(100, host.clientWidth - 110), 0.85 * 220];
// Variants whose marks would cover each other are one mark, that of the most prominent, with their number.
const coinciding = (places, horizontal, vertical, host) => {
  const ends = (measure) => {
    let low = Infinity, high = -Infinity;
    for (const place of places) { const value = at(measure.value, place); low = Math.min(low, value); high = Math.max(high, value); }
    return high - low || 1;
  };
  // Two marks of 9 pixels, one of which may be larger for their number.
  const apart = 10, room = roomOf(host);
  const near = [ends(horizontal) * apart / room[0], ends(vertical) * apart / room[1]];
  const groups = [];
  for (const place of places.slice().sort((one, other) => kindOf[other] - kindOf[one] || variants.id[one] - variants.id[other])) {
    const group = groups.find(([first]) => Math.abs(at(horizontal.value, first) - at(horizontal.value, place)) <= near[0] && Math.abs(at(vertical.value, first) - at(vertical.value, place)) <= near[1]);
    if (group) group.push(place);
    else groups.push([place]);
  }
  return groups;
};
// Ranges of numbers: 28 to 33, 36.
const inRuns = (numbers) => {
  const runs = [];
  for (const one of numbers.slice().sort((left, right) => left - right)) {
    const last = runs[runs.length - 1];
    if (last && one === last[1] + 1) last[1] = one;
    else runs.push([one, one]);
  }
  return runs.map(([from, to]) => (from === to ? `${from}` : to === from + 1 ? `${from}, ${to}` : `${from} to ${to}`)).join(", ");
};
// All names of a mark, a line for each kind, broken so that the label stays within the plot.
const namesOf = (group) => [CHOSEN, FRONT, FEASIBLE, INFEASIBLE].map((kind) => [kind, group.filter((place) => kindOf[place] === kind)]).filter(([, mine]) => mine.length)
  .map(([kind, mine]) => plotText(`${mine.length > 1 ? "variants" : "variant"} ${inRuns(mine.map((place) => variants.id[place]))}, ${KINDS[kind].name}`).replace(/(.{50,70}?), /g, "$1,<br>")).join("<br>");
const together = (measure, group) => {
  if (group.length === 1) return estimate(measure, group[0]);
  const values = group.map((place) => at(measure.value, place)), low = Math.min(...values), high = Math.max(...values);
  return show(low, measure.unit) === show(high, measure.unit) ? show(low, measure.unit) : `${show(low)} to ${show(high, measure.unit)}`;
};
const withBetter = (measure) => withUnit(measure.id, measure.unit) + ({ higher: ", higher is better", lower: ", lower is better" }[measure.better] ?? "");
// The number of variants at a mark, beside it if there is room; otherwise only on hover.
const countLabels = (groups, horizontal, vertical, size, host) => {
  const span = (measure) => {
    const values = groups.map(([place]) => at(measure.value, place));
    const low = values.reduce((one, other) => Math.min(one, other), Infinity), high = values.reduce((one, other) => Math.max(one, other), -Infinity);
    return [low, high - low || 1];
  };
  const [[left, width], [foot, height]] = [span(horizontal), span(vertical)];
  const room = roomOf(host), middle = (group) => [room[0] * (at(horizontal.value, group[0]) - left) / width, -room[1] * (at(vertical.value, group[0]) - foot) / height];
  // No number lies on a mark or on another number.
  const found = new Map();
  const taken = groups.map((group) => {
    const [x, y] = middle(group), half = size(group) / 2;
    return [x - half, y - half, 2 * half, 2 * half];
  });
  for (const group of groups.filter((one) => one.length > 1).sort((one, other) => other.length - one.length)) {
    const text = `×${group.length}`, wide = 7.5 * text.length + 6, tall = 19, gap = size(group) / 2 + 1;
    const [x, y] = middle(group);
    const [before, behind, above, below] = [x - gap - wide, x + gap, y - gap - tall, y + gap];
    const places = [["top right", behind, above], ["bottom right", behind, below], ["top left", before, above], ["bottom left", before, below], ["middle right", behind, y - tall / 2]];
    const free = places.find(([, from, top]) => taken.every(([one, other, w, h]) => from + wide <= one || one + w <= from || top + tall <= other || other + h <= top));
    if (!free) continue;
    taken.push([free[1], free[2], wide, tall]);
    found.set(group, { text, position: free[0] });
  }
  return found;
};
