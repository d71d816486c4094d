// ----------------------------------------------------- weights, and the resulting ranking
const TIE = 1e-9;
const weighted = data.weights.measures;
let raw = weighted.map((one) => one.weight);

// Weights that sum to one: the gain of one is taken from the others in proportion; zeros are restored as they were.
const lastAbove = raw.slice();
const moveWeight = (index, to) => {
  const there = raw.some((weight, other) => other !== index && weight > 0) ? raw : lastAbove;
  const sum = there.reduce((before, weight, other) => (other === index ? before : before + weight), 0);
  if (raw.length === 1) return;
  raw = there.map((weight, other) => (other === index ? to : (1 - to) * (sum > 0 ? weight / sum : 1 / (raw.length - 1))));
  raw.forEach((weight, other) => { if (weight > 0) lastAbove[other] = weight; });
};
const normalised = () => {
  const sum = raw.reduce((before, weight) => before + weight, 0);
  return raw.map((weight) => (sum > 0 ? weight / sum : 1 / raw.length));
};
const worth = (place, weights) => {
  let value = 0;
  for (let index = 0; index < weighted.length; index += 1) {
    if (weights[index] === 0) continue;
    const one = at(weighted[index].worth, place);
    if (!known(one)) return null;
    value += weights[index] * one;
  }
  return value;
};
// Quantities that differ by less are equal: those of the page have seven digits.
const SAME = 1.5e-6, NOTHING = 1e-9;
// The place of each number among those that differ, from the least.
const placesOf = (numbers) => {
  const order = numbers.map((_, index) => index).sort((one, other) => numbers[one] - numbers[other]);
  const places = new Array(numbers.length);
  let place = 0;
  order.forEach((index, rank) => {
    const [before, now] = [numbers[order[Math.max(0, rank - 1)]], numbers[index]];
    if (now - before > Math.max(SAME * Math.max(Math.abs(now), Math.abs(before)), NOTHING)) place += 1;
    places[index] = place;
  });
  return places;
};
// Of variants of the same value those that another surpasses: at least as good in the quantity of every measure that
// has a weight now, and better in one. A measure with a target counts by its value.
const surpassedOf = (tied, weights) => {
  const columns = [];
  weighted.forEach((one, index) => {
    if (weights[index] === 0) return;
    const quantities = tied.map(({ place }) => at(one.more_is_better === null ? one.worth : measureOf.get(one.id).value, place));
    const scale = quantities.every(known) ? Math.max(...quantities.map(Math.abs)) : 0;
    if (scale > 0) columns.push(placesOf(quantities.map((quantity) => (one.more_is_better === false ? -quantity : quantity) / scale)));
  });
  const rows = tied.map((one, index) => ({ place: one.place, places: columns.map((column) => column[index]) }));
  const sum = ({ places }) => places.reduce((before, place) => before + place, 0);
  const best = new Map();
  const found = new Set();
  // What surpasses another has a greater sum of places, and comes before it.
  for (const row of rows.sort((one, other) => sum(other) - sum(one))) {
    const surpasses = (other) => sum(other) > sum(row) && other.places.every((place, index) => place >= row.places[index]);
    if ([...best.values()].some(surpasses)) found.add(row.place);
    else best.set(row.places.join(), row);
  }
  return found;
};
// Same ranking as the trade-off: ties with the best first, of these what an equal surpasses last, by smallest or largest
// id, then the rest.
const ranked = (weights, places) => {
  const found = [];
  for (const place of places) {
    const value = worth(place, weights);
    if (value !== null) found.push({ place, value });
  }
  found.sort((one, other) => other.value - one.value || variants.id[one.place] - variants.id[other.place]);
  for (let first = 0; first < found.length;) {
    let end = first + 1;
    while (end < found.length && found[first].value - found[end].value <= TIE) end += 1;
    const tied = found.slice(first, end).sort((one, other) => variants.id[one.place] - variants.id[other.place]);
    if (first === 0 && tied.length > 1) {
      if (data.weights.of_equals === "last") tied.reverse();
      const surpassed = surpassedOf(tied, weights);
      tied.sort((one, other) => surpassed.has(one.place) - surpassed.has(other.place));
    }
    tied.forEach((one, index) => { found[first + index] = one; });
    first = end;
  }
  return found;
};
const allowed = variants.id.map((_, place) => place).filter((place) => variants.feasible[place]);
let ranking = [];
const rankingWatchers = [];
const rankAnew = () => {
  const weights = normalised();
  ranking = ranked(weights, allowed);
  const best = ranking.length ? variants.id[ranking[0].place] : null;
  const winner = byId("weight-winner");
  if (best === null) winner.textContent = "No variant is feasible by its estimates.";
  else if (best === data.decision.chosen) winner.textContent = `Variant ${best} stays the best.`;
  else {
    const chosen = data.decision.chosen;
    const equals = ranking.filter((one) => ranking[0].value - one.value <= TIE).map((one) => variants.id[one.place]);
    if (equals.includes(chosen)) winner.textContent = `Variant ${chosen} stays one of the best, with ${equals.filter((id) => id !== chosen).join(", ")}.`;
    else winner.textContent = `${equals.length > 1 ? "Variants" : "Variant"} ${equals.join(", ")} would be the best${chosen === null ? "" : `, instead of ${chosen}`}.`;
  }
  for (const watcher of rankingWatchers) watcher();
};
let setWeights = () => {};
const drawSliders = () => {
  const rows = weighted.map((one, index) => {
    const slider = element("input", { type: "range", min: 0, max: 1, step: 0.01, id: `weight-${index}` });
    const told = element("output", { for: `weight-${index}` });
    const measure = measureOf.get(one.id);
    slider.addEventListener("input", () => { moveWeight(index, Number(slider.value)); rankAnew(); });
    rankingWatchers.push(() => {
      const share = normalised()[index];
      // The slider that is dragged keeps its position.
      if (Math.abs(Number(slider.value) - share) > 0.005) slider.value = String(share);
      told.textContent = withDecimals(share, 3);
      slider.setAttribute("aria-valuetext", `${withDecimals(share, 3)} of the weight`);
    });
    const worst = [one.worst, one.too_high].filter(known).map((end) => show(end, measure.unit)).join(" and ");
    const scale = worst ? `0 at ${worst}, 1 at ${show(one.best, measure.unit)}` : "";
    byId("weight-rows").append(element("div", { class: "weight" },
      element("label", { for: `weight-${index}` }, `${one.id}: ${measure.name}`), told, slider, element("span", { class: "small" }, scale)));
    return slider;
  });
  setWeights = (weights) => {
    raw = weights.slice();
    rows.forEach((slider, index) => { slider.value = String(raw[index]); });
    rankAnew();
  };
  const reset = () => setWeights(weighted.map((one) => one.weight));
  byId("weight-reset").addEventListener("click", reset);
  byId("weight-sliders").addEventListener("submit", (event) => event.preventDefault());
  const shownRanking = () => ranking.map((one, index) => ({ ...one, rank: index + 1 })).filter((one) => shownMask[one.place]);
  const update = pagedTable(byId("ranking-table"), {
    label: "Ranking at these weights",
    size: 10,
    columns: [
      { head: "rank", cell: (row) => String(row.rank) },
      { head: "variant", number: true, cell: (row) => variantLink(variants.id[row.place]) },
      { head: "value", number: true, cell: (row) => withDecimals(row.value, 4), to: () => "#weights-plot" },
      { head: "rank in the study", number: true, cell: (row) => show(variants.rank[row.place]), to: (row) => figureAddress(variants.id[row.place], "value") },
    ],
    rows: shownRanking,
  });
  rankingWatchers.push(update);
  onShown(update);
  reset();
  return shownRanking;
};
