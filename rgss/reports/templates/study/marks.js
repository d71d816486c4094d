// ------------------------------------------------------- marks that coincide, axes in words
// Variants whose marks would cover each other are one mark, that of the most prominent, with their number.
const coinciding = (places, horizontal, vertical) => {
  const ends = (measure) => {
    let low = Infinity, high = -Infinity;
    for (const place of places) { const value = at(measure.value, place); low = Math.min(low, value); high = Math.max(high, value); }
    return high - low || 1;
  };
  const near = [ends(horizontal) / 90, ends(vertical) / 45];
  const groups = [];
  for (const place of places.slice().sort((one, other) => kindOf[other] - kindOf[one] || variants.id[one] - variants.id[other])) {
    const group = groups.find(([first]) => Math.abs(at(horizontal.value, first) - at(horizontal.value, place)) <= near[0] && Math.abs(at(vertical.value, first) - at(vertical.value, place)) <= near[1]);
    if (group) group.push(place);
    else groups.push([place]);
  }
  return groups;
};
// Numbers in words: 28 to 33, 36.
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
