// ------------------------- filters, weights and choices in the URL, so that a view can be shared
const addressNow = () => {
  const [, anchor, query] = /^#?([^?]*)\??(.*)$/s.exec(location.hash);
  return { anchor, query: new URLSearchParams(query), sent: query !== "" };
};
// Each part of a view writes its differences from the initial state into the URL, and reads them from it.
const views = [];
const inAddress = (write, read) => views.push({ write, read });
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
  for (const { read } of views) read(query);
  reading = false;
};
const choiceInAddress = (name, choice) => {
  const first = choice.value;
  inAddress((query) => { if (choice.value !== first) query.set(name, choice.value); }, (query) => {
    const wanted = query.get(name) ?? first;
    if (choice.value === wanted || (choice.type === "number" && !placeOf.has(Number(wanted)))) return;
    const before = choice.value;
    choice.value = wanted;
    if (choice.value === wanted) choice.dispatchEvent(new Event("change"));
    else choice.value = before;
  });
  choice.addEventListener("change", tellAddress);
};
const startAddress = () => {
  const numbers = (text) => text.split(":").map(Number);
  inAddress((query) => {
    for (const { axis, low, high } of brushes.values()) query.append("only", `${axis.id}:${axis.write(low, -1)}:${axis.write(high, 1)}`);
  }, (query) => {
    brushes.clear();
    for (const text of query.getAll("only")) {
      const [id, from, to] = text.split(":");
      const axis = axes.find((one) => one.id === id);
      const [low, high] = axis ? [axis.read(from), axis.read(to)] : [NaN, NaN];
      if (low <= high && (low > 0 || high < 1)) brushes.set(id, { axis, low, high });
    }
    for (const tell of axisControls) tell();
    applyBrushes();
  });
  inAddress((query) => {
    if (raw.some((one, index) => Math.abs(one - weighted[index].weight) > 5e-5)) query.set("weights", weighted.map((one, index) => `${one.id}:${Number(raw[index].toFixed(4))}`).join(","));
  }, (query) => {
    const given = new Map((query.get("weights") ?? "").split(",").map((one) => [one.split(":")[0], numbers(one)[1]]));
    const found = weighted.map((one) => given.get(one.id));
    const sum = found.reduce((before, one) => before + one, 0);
    setWeights(found.every((one) => one >= 0) && sum > 0 && Number.isFinite(sum) ? found.map((one) => one / sum) : weighted.map((one) => one.weight));
  });
  for (const [name, id] of [["measure", "measure-choice"], ["across", "pareto-x"], ["up", "pareto-y"], ["effect", "effect-choice"], ["trial", "timeline-choice"], ["variant", "variant-choice"], ["by", "distribution-by"], ["compare", "compare-choice"]]) choiceInAddress(name, byId(id));
  rankingWatchers.push(tellAddress);
  onShown(tellAddress);
  const follow = () => {
    const { anchor, sent } = addressNow();
    // A link within the page keeps the view.
    if (!sent) { tellAddress(); return; }
    readAddress();
    byId(named(anchor))?.scrollIntoView();
  };
  addEventListener("hashchange", follow);
  if (addressNow().sent) follow();
};
