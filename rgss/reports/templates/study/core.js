// ------------------------------------------------- data, numbers, elements, selection
const variants = data.variants;
const total = variants.id.length;
const byId = (id) => document.getElementById(id);

// A column is a list with an entry for each variant, or a single value if all are equal.
const at = (column, place) => (Array.isArray(column) ? column[place] : column);
const known = (value) => value !== null && value !== undefined;
const placeOf = new Map(variants.id.map((id, place) => [id, place]));
const measureOf = new Map(data.measures.map((measure) => [measure.id, measure]));

// Roles of a variant in the decision, from infeasible to chosen.
const INFEASIBLE = 0, FEASIBLE = 1, FRONT = 2, CHOSEN = 3;
// Colours by Okabe and Ito; shapes, dashes and labels repeat the information.
const KINDS = [
  { name: "infeasible by estimates", colour: "#8a8a8a", symbol: "x-thin-open", dash: [5, 4], width: 1 },
  { name: "feasible by estimates", colour: "#009e73", symbol: "circle-open", dash: [], width: 1 },
  { name: "Pareto front", colour: "#0072b2", symbol: "diamond", dash: [], width: 1.75 },
  { name: "chosen", colour: "#d55e00", symbol: "star", dash: [], width: 3.5 },
];
const PALETTE = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#8a8a8a"];
const DASHES = ["solid", "dash", "dot", "dashdot", "longdash", "longdashdot"];
// Whether the known values of a measure differ.
const varies = (measure) => {
  const values = Array.isArray(measure.value) ? measure.value.filter(known) : [];
  return values.some((value) => value !== values[0]);
};
// The measure that a plot of one measure opens with: the first that says most about the decision.
const openingMeasure = (measures) => {
  const merit = (one) => (varies(one) ? 4 : 0) + (one.weight !== null ? 2 : 0) + (one.from_trials ? 1 : 0);
  return measures.reduce((best, one) => (merit(one) > merit(best) ? one : best), measures[0]);
};
const kindOf = variants.id.map((id, place) => {
  if (id === data.decision.chosen) return CHOSEN;
  if (!variants.feasible[place]) return INFEASIBLE;
  return variants.pareto[place] === null ? FEASIBLE : FRONT;
});

// A number with some significant digits. Python rounds exact ties to the even digit, JavaScript away from 0: here as Python.
const rounded = (value, digits) => {
  const [mantissa, power] = value.toExponential(40).split("e");
  const end = mantissa.indexOf(".") + digits, kept = mantissa.slice(0, end);
  const isEven = /[02468]\.?$/.test(kept), isTie = /^50*$/.test(mantissa.slice(end).replace(".", ""));
  return isTie && isEven ? Number(`${kept}e${power}`) : Number(value.toPrecision(digits));
};
const withDecimals = (value, decimals) => {
  const digits = 1 + Number(value.toExponential(40).split("e")[1]) + decimals;
  return (digits < 1 ? value : rounded(value, digits)).toFixed(decimals);
};
// As rounded_figure in Python: four digits; from 10,000 whole, with separators; from 1e9 and below 1e-4 with a power of ten.
const figureText = (value) => {
  const size = Math.abs(value), short = rounded(value, 4);
  if (size >= 1e9 || (size > 0 && Math.abs(short) < 1e-4)) return short.toExponential(3).replace(/\.?0*e\+?/, "e");
  return Math.abs(short) >= 10000 ? Number(withDecimals(value, 0)).toLocaleString("en-US") : String(short);
};
const show = (value, unit = "1") => {
  if (!known(value)) return "–";
  if (typeof value !== "number") return String(value);
  const text = figureText(value);
  return unit === "1" || unit === "" ? text : `${text} ${unit}`;
};
// As share_in_words in Python.
const percent = (share) => {
  if (!known(share)) return "–";
  if (share > 0 && share < 0.001) return "< 0.1 %";
  if (share >= 0.9995 && share < 1 - 1e-9) return "> 99.9 %";
  const isNearEnd = (share > 0 && share < 0.1) || (share >= 0.995 && share < 1 - 1e-9);
  return `${withDecimals(100 * share, isNearEnd ? 1 : 0)} %`;
};
const withUnit = (name, unit) => (unit === "1" || unit === "" ? name : `${name} [${unit}]`);
const interval = (measure, place) => {
  const low = at(measure.low, place), high = at(measure.high, place);
  return known(low) && known(high) && low !== high ? `${show(low)} to ${show(high)}` : "";
};
const estimate = (measure, place) => {
  const spread = interval(measure, place);
  return show(at(measure.value, place), measure.unit) + (spread ? ` (${spread})` : "");
};

// A line does not break at the hyphens of an option of a command, or of an id, in a command, a link or a sentence.
const WHOLE = /((?<![\w-])(?:--[a-z][a-z-]*|[A-Z][A-Z0-9]*(?:-[A-Z0-9]+)*-\d+[a-z]?(?![\w-])))/;
const TAGS_OF_SENTENCES = new Set(["code", "a", "li", "p", "span"]);
const withWholeOptions = (child) => (typeof child !== "string" || !child.includes("-") ? [child] : child.split(WHOLE).map((part, index) => (index % 2 === 0 ? part : element("span", { class: "option" }, document.createTextNode(part)))));
// Texts are inserted as text nodes, never as markup.
const element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null) continue;
    made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...(TAGS_OF_SENTENCES.has(tag) ? children.flatMap(withWholeOptions) : children));
  return made;
};
// The text of a node as it is read: the cells of a row, and what is on lines of its own, do not run together.
const textIn = (node) => {
  const said = (one) => {
    if (one.nodeType === Node.TEXT_NODE) return one.data;
    if (one.tagName === "TR") return Array.from(one.cells, textIn).filter(Boolean).join(" · ");
    const text = Array.from(one.childNodes, said).join("");
    return /^(BR|LI|P|DIV|H\d|BUTTON)$/.test(one.tagName) || one.classList?.contains("words") ? ` ${text} ` : text;
  };
  return said(node).replace(/\s+/g, " ").trim();
};
const variantLink = (id) => element("a", { href: `#variant-${id}` }, String(id));
// The anchor of a variant's figure with its evidence.
const figureAddress = (id, name) => `#variant-${id}/${encodeURIComponent(name)}`;
const options = (select, entries) => {
  select.replaceChildren(...entries.map(([value, text]) => element("option", { value }, text)));
};
// Plotly interprets some markup in texts, which is escaped.
const plotText = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");

// ------------------------------------------------------------------ the brush
const brushes = new Map();
const shownMask = new Uint8Array(total).fill(1);
let shownPlaces = Array.from(shownMask.keys());
const watchers = [];
const onShown = (watcher) => watchers.push(watcher);
// Callbacks after the deferred measures are loaded.
const arrivals = [];
let waiting = false;
const countShown = () => {
  const all = shownPlaces.length === total;
  byId("shown").textContent = all ? (total === 1 ? "The one variant is shown" : `All ${total} variants are shown`) : `${shownPlaces.length} of ${total} variants are shown`;
  byId("clear").disabled = brushes.size === 0;
};
const tellShown = () => {
  countShown();
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    for (const watcher of watchers) watcher();
  });
};
const applyBrushes = () => {
  const ends = Array.from(brushes.values());
  shownPlaces = [];
  for (let place = 0; place < total; place += 1) {
    const inside = ends.every(({ axis, low, high }) => {
      const position = axis.position[place];
      return !Number.isNaN(position) && position >= low - 1e-9 && position <= high + 1e-9;
    });
    shownMask[place] = inside ? 1 : 0;
    if (inside) shownPlaces.push(place);
  }
  tellShown();
};
