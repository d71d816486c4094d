// ------------- filters of variants, spelled as after --only: gripper=three, d8!=RRT, d3>=0.8; also of measures: t_e<12
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
// A measure has its symbol, its name, and the requirements that bound it.
const measureNamed = new Map();
for (const one of data.measures) {
  for (const name of [one.id, one.name.replace(/ /g, "_")]) if (!measureNamed.has(name.toLowerCase())) measureNamed.set(name.toLowerCase(), one);
}
for (const one of data.requirements) {
  const measure = data.measures.find((other) => other.id === one.measure);
  if (measure) measureNamed.set(one.id.toLowerCase(), measure);
}
const filterNames = [...new Set([...parameterOf.keys(), ...columnsOf.keys(), ...parameterByName.keys(), ...measureNamed.keys(), ...data.requirements.map((one) => one.id.toLowerCase())])];
// Numbers are equal up to the digits with which the page has them.
const isEqual = (one, other) => Math.abs(one - other) <= 1e-6 * Math.abs(other);
const COMPARED = {
  "=": isEqual, "==": isEqual, "!=": (one, other) => !isEqual(one, other),
  "<": (one, other) => one < other && !isEqual(one, other), "<=": (one, other) => one < other || isEqual(one, other),
  ">": (one, other) => one > other && !isEqual(one, other), ">=": (one, other) => one > other || isEqual(one, other),
};
const isOrdered = (sign) => /[<>]/.test(sign);

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

// The number of a text in the unit of a parameter or measure; NaN for another text.
const numberIn = (one, text) => {
  const [, number, unit] = /^([-+]?[\d.]+(?:e[-+]?\d+)?)(.*)$/.exec(text) ?? [];
  if (unit === "%" && one.unit === "1") return Number(number) / 100;
  return number === undefined || (unit && unit !== one.unit.toLowerCase()) ? NaN : Number(number);
};
const isText = (parameter) => typeof at(parameter.values, 0) === "string";
const textsOf = (parameter) => [...new Set(variants.id.map((_, place) => String(at(parameter.values, place)).toLowerCase()))];

// A word such as name=value as a filter of places; { problem } where name or value is unknown; null for other words.
const filterOf = (word) => {
  const [, written, sign, value] = /^([a-z][a-z0-9_.-]*)(!=|==?|[<>]=?)([^=<>!,]+)$/.exec(word) ?? [];
  const requirement = data.requirements.find((one) => one.id.toLowerCase() === written);
  if (written === undefined || (requirement && !measureNamed.has(written) && !(value in VERDICTS) && !parameterOf.has(written))) return null;
  const name = plainName(written);
  const columns = columnsOf.get(name);
  const parameter = parameterOf.get(written) ?? parameterOf.get(name) ?? (columns ? undefined : parameterByName.get(name));
  const has = columns?.filter((one) => one.values.includes(value)) ?? [];
  const signed = (holds) => ({ holds: sign === "!=" ? (place) => !holds(place) : holds });
  if (requirement && !parameter && !columns && value in VERDICTS) return signed((place) => at(requirement.verdict, place) === value);
  const measure = parameter || columns ? undefined : measureNamed.get(written) ?? measureNamed.get(name);
  const numeric = parameter && !isText(parameter) ? { unit: parameter.unit, of: () => parameter.values } : measure && { unit: measure.unit, of: () => measure.value };
  const limit = numeric ? numberIn(numeric, value) : NaN;
  // An estimate that is not known fulfils no comparison.
  if (!Number.isNaN(limit)) return { holds: (place) => known(at(numeric.of(), place)) && COMPARED[sign](at(numeric.of(), place), limit) };
  if (measure || (numeric && isOrdered(sign))) return { problem: `${written} is compared with a number${numeric.unit && numeric.unit !== "1" ? ` in ${numeric.unit}` : ""}, got ${value}` };
  if (isOrdered(sign) && (parameter || columns)) return { problem: `${written} has no order: compare it by = or !=` };
  if (parameter && isText(parameter) && textsOf(parameter).includes(value)) return signed((place) => String(at(parameter.values, place)).toLowerCase() === value);
  if (has.length) return signed((place) => has.some((one) => one.values[at(one.entries, place)] === value));
  if (parameter || columns) {
    const values = [...new Set([...(columns ?? []).flatMap((one) => one.values), ...(parameter ? textsOf(parameter) : [])])];
    const near = nearest(value, values);
    const unit = parameter && !isText(parameter) && parameter.unit ? ` ${parameter.unit}` : "";
    return { problem: `${written} is never ${value}: ${near ? `did you mean ${near}${unit}?` : `known are ${values.slice(0, 12).join(", ")}${unit}`}` };
  }
  const near = nearest(name, filterNames) ?? data.measures.find((one) => name.length > 2 && one.name.toLowerCase().includes(name.replace(/_/g, " ")))?.id;
  return { problem: `nothing is named ${written}${near ? `: did you mean ${near}?` : ""}` };
};
// The first word that is a filter with an unknown name or value, in a sentence; empty if there is none.
const filterProblem = (words) => words.flatMap((word) => word.split(",")).map((word) => filterOf(word)?.problem).find(Boolean) ?? "";
