// ------------------------- filters of variants, spelled as after --only: gripper=three, d8!=RRT
const plainName = (name) => name.toLowerCase().replace(/^(component|design)\./, "");
const parameterOf = new Map(), parameterByName = new Map(), columnsOf = new Map();
for (const one of data.parameters) {
  for (const name of [one.id, one.sets, ...one.ranged]) if (name) parameterOf.set(name.toLowerCase(), one);
  const named = one.name.replace(/ /g, "_").toLowerCase();
  if (!parameterByName.has(named)) parameterByName.set(named, one);
}
for (const one of data.filters) {
  const name = one.name.toLowerCase();
  if (!columnsOf.has(name)) columnsOf.set(name, []);
  columnsOf.get(name).push({ values: one.values.map((value) => value.toLowerCase()), entries: one.entries });
}
const filterNames = [...new Set([...parameterOf.keys(), ...columnsOf.keys(), ...parameterByName.keys(), ...data.requirements.map((one) => one.id.toLowerCase())])];

// Number of insertions, deletions, replacements and exchanges of neighbours between two words.
const distance = (one, other) => {
  let before = null;
  let row = Array.from({ length: other.length + 1 }, (_, place) => place);
  for (let at = 1; at <= one.length; at += 1) {
    const next = [at];
    for (let place = 1; place <= other.length; place += 1) {
      const exchanged = before && place > 1 && one[at - 1] === other[place - 2] && one[at - 2] === other[place - 1];
      next.push(Math.min(row[place] + 1, next[place - 1] + 1, row[place - 1] + (one[at - 1] === other[place - 1] ? 0 : 1), exchanged ? before[place - 2] + 1 : Infinity));
    }
    [before, row] = [row, next];
  }
  return row[other.length];
};
const nearest = (word, words) => {
  const [best] = words.map((one) => ({ one, far: distance(word, one) })).sort((left, right) => left.far - right.far);
  return best && best.far <= Math.max(1, Math.floor(word.length / 3)) ? best.one : null;
};

// The number of a text in the unit of a parameter; NaN for another text.
const numberIn = (parameter, text) => {
  const [, number, unit] = /^([-+]?[\d.]+(?:e[-+]?\d+)?)(.*)$/.exec(text) ?? [];
  return number === undefined || (unit && unit !== parameter.unit.toLowerCase()) ? NaN : Number(number);
};
const isText = (parameter) => typeof at(parameter.values, 0) === "string";
const textsOf = (parameter) => [...new Set(variants.id.map((_, place) => String(at(parameter.values, place)).toLowerCase()))];

// A word such as name=value as a filter of places; { problem } where name or value is unknown; null for other words.
const filterOf = (word) => {
  const [, written, sign, value] = /^([a-z][a-z0-9_.-]*)(!=|==?)([^=<>!,]+)$/.exec(word) ?? [];
  const requirement = data.requirements.find((one) => one.id.toLowerCase() === written);
  if (written === undefined || (requirement && !(value in VERDICTS) && !parameterOf.has(written))) return null;
  const name = plainName(written);
  const columns = columnsOf.get(name);
  const parameter = parameterOf.get(written) ?? parameterOf.get(name) ?? (columns ? undefined : parameterByName.get(name));
  const has = columns?.filter((one) => one.values.includes(value)) ?? [];
  const signed = (holds) => ({ holds: sign === "!=" ? (place) => !holds(place) : holds });
  if (requirement && !parameter && !columns) return signed((place) => at(requirement.verdict, place) === value);
  if (parameter) {
    const fits = isText(parameter) ? textsOf(parameter).includes(value) : !Number.isNaN(numberIn(parameter, value));
    if (fits && isText(parameter)) return signed((place) => String(at(parameter.values, place)).toLowerCase() === value);
    if (fits) return signed((place) => Math.abs(at(parameter.values, place) - numberIn(parameter, value)) <= 1e-6 * Math.abs(numberIn(parameter, value)));
  }
  if (has.length) return signed((place) => has.some((one) => one.values[at(one.entries, place)] === value));
  if (parameter || columns) {
    const values = [...new Set([...(columns ?? []).flatMap((one) => one.values), ...(parameter ? textsOf(parameter) : [])])];
    const near = nearest(value, values);
    const unit = parameter && !isText(parameter) && parameter.unit ? ` ${parameter.unit}` : "";
    return { problem: `${written} is never ${value}: ${near ? `did you mean ${near}${unit}?` : `known are ${values.slice(0, 12).join(", ")}${unit}`}` };
  }
  const near = nearest(name, filterNames);
  return { problem: `nothing is named ${written}${near ? `: did you mean ${near}?` : ""}` };
};
// The first word that is a filter with an unknown name or value, in a sentence; empty if there is none.
const filterProblem = (words) => words.flatMap((word) => word.split(",")).map((word) => filterOf(word)?.problem).find(Boolean) ?? "";
