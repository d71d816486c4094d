// ------------------------- filters, weights and choices in the URL, so that a view can be shared
const addressNow = () => {
  const [, anchor, query] = /^#?([^?]*)\??(.*)$/s.exec(location.hash);
  return { anchor, query: new URLSearchParams(query), sent: query !== "" };
};
// Each part of a view writes its differences from the initial state into the URL, and reads them from it.
const views = [];
const inAddress = (name, write, read) => views.push({ name, write, read });
// What a URL names but the page cannot show is ignored, and reported to the reader.
let refused = [];
const MOST_NAMED = 80;
const refuse = (part, why = "") => {
  const brief = (text) => (text.length > MOST_NAMED ? `${text.slice(0, MOST_NAMED - 1)}…` : text);
  refused.push(why ? `${brief(part)} (${brief(why)})` : brief(part));
};
const tellRefused = () => { byId("address-note").textContent = refused.length ? `Ignored of the address: ${refused.join("; ")}.` : ""; };
// Whether a URL leads to something on the page; rows of a variant's figures are made only once they are shown.
const isPlace = (anchor) => {
  const [, id, name] = /^variant-(\d+)(?:\/(.*))?$/s.exec(anchor) ?? [];
  const isFigure = (text) => text === "trials" || data.trials.key.includes(text) || [...data.parameters, ...data.measures, ...data.requirements].some((one) => one.id === text);
  if (placeOf.has(Number(id))) return name === undefined || isFigure(named(name));
  return ["", "top"].includes(anchor) || byId(named(anchor)) !== null || (anchor.startsWith("page-") && byId(anchor.slice(5))?.matches("figure"));
};
const refusePlace = () => {
  const { anchor } = addressNow();
  if (!isPlace(anchor)) refuse(`#${anchor}`, "no such place");
};
let writing = 0, reading = false;
const tellAddress = () => {
  if (reading) return;
  clearTimeout(writing);
  // A browser allows about a hundred changes of the URL in half a minute.
  writing = setTimeout(() => {
    const query = new URLSearchParams();
    for (const { write } of views) write(query);
    const text = query.toString().replace(/%3A/g, ":").replace(/%2C/g, ",");
    const { anchor } = addressNow();
    const hash = text ? `#${anchor}?${text}` : anchor ? `#${anchor}` : "";
    if (hash !== location.hash) history.replaceState(history.state, "", location.href.split("#")[0] + hash);
  }, 250);
};
const readAddress = () => {
  const { query } = addressNow();
  reading = true;
  refused = [];
  const names = new Set(views.map(({ name }) => name));
  for (const name of new Set(query.keys())) {
    if (!names.has(name)) refuse(name, "unknown");
    // An axis has a range each; of anything else the first counts.
    else if (name !== "only") for (const text of query.getAll(name).slice(1)) refuse(`${name}=${text}`, "given twice");
  }
  for (const { read } of views) read(query);
  refusePlace();
  tellRefused();
  reading = false;
};
const choiceInAddress = (name, choice) => {
  const first = choice.value;
  inAddress(name, (query) => { if (choice.value !== first) query.set(name, choice.value); }, (query) => {
    const wanted = query.get(name) ?? first;
    if (choice.value === wanted) return;
    const before = choice.value;
    choice.value = wanted;
    if (choice.value === wanted && (choice.type !== "number" || placeOf.has(Number(wanted)))) choice.dispatchEvent(new Event("change"));
    else {
      choice.value = before;
      if (query.has(name)) refuse(`${name}=${wanted}`);
    }
  });
  choice.addEventListener("change", tellAddress);
};
// The weights that a text such as "t_p:0.6,S:0.4" gives, with 0 for measures that it does not name; null if it is invalid.
const weightsIn = (text) => {
  const parts = text.split(",").map((one) => {
    const [id, number = ""] = one.split(":");
    return [id, number === "" ? NaN : Number(number)];
  });
  const given = new Map(parts);
  const unknown = [...given.keys()].filter((id) => !weighted.some((one) => one.id === id));
  const sum = [...given.values()].reduce((before, one) => before + one, 0);
  const wrong = unknown.length ? `no weight in this study: ${unknown.join(", ")}` : given.size < parts.length ? "a weight is given twice"
    : [...given.values()].every((one) => one >= 0) && sum > 0 && Number.isFinite(sum) ? "" : "not numbers of 0 or more, one above 0";
  if (wrong) refuse(`weights=${text}`, wrong);
  return wrong ? null : weighted.map((one) => (given.get(one.id) ?? 0) / sum);
};
const startAddress = () => {
  inAddress("only", (query) => {
    for (const { axis, low, high } of brushes.values()) query.append("only", `${axis.id}:${axis.write(low, -1)}:${axis.write(high, 1)}`);
  }, (query) => {
    brushes.clear();
    for (const text of query.getAll("only")) {
      const [id, from, to, ...more] = text.split(":");
      const axis = axes.find((one) => one.id === id);
      const [low, high] = axis && !more.length ? [axis.read(from), axis.read(to)] : [NaN, NaN];
      if (brushes.has(id)) refuse(`only=${text}`, "an axis has one range");
      else if (low <= high && (low > 0 || high < 1)) brushes.set(id, { axis, low, high });
      else if (!(low <= high)) refuse(`only=${text}`, axis ? "no such range" : `no axis ${id}`);
    }
    for (const tell of axisControls) tell();
    applyBrushes();
  });
  inAddress("weights", (query) => {
    if (raw.some((one, index) => Math.abs(one - weighted[index].weight) > 5e-5)) query.set("weights", weighted.map((one, index) => `${one.id}:${Number(raw[index].toFixed(4))}`).join(","));
  }, (query) => {
    setWeights((query.has("weights") ? weightsIn(query.get("weights")) : null) ?? weighted.map((one) => one.weight));
  });
  for (const [name, id] of [["measure", "measure-choice"], ["across", "pareto-x"], ["up", "pareto-y"], ["effect", "effect-choice"], ["trial", "timeline-choice"], ["variant", "variant-choice"], ["by", "distribution-by"], ["compare", "compare-choice"]]) choiceInAddress(name, byId(id));
  rankingWatchers.push(tellAddress);
  onShown(tellAddress);
  const follow = () => {
    const { anchor, sent } = addressNow();
    // A link within the page keeps the view.
    if (!sent) { refused = []; refusePlace(); tellRefused(); tellAddress(); return; }
    readAddress();
    byId(named(anchor))?.scrollIntoView();
  };
  addEventListener("hashchange", follow);
  follow();
};
