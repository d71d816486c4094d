// ------------------------------------- one variant: its figures, and the trials behind them
const trialsOf = (() => {
  const lists = new Map();
  data.trials.variant.forEach((place, trial) => {
    if (!lists.has(place)) lists.set(place, []);
    lists.get(place).push(trial);
  });
  return (place) => lists.get(place) || [];
})();
const outcomeOf = (trial) => {
  const failure = at(data.trials.failure, trial);
  if (failure < 0) return "success";
  const phase = at(data.trials.failed_phase, trial);
  return `${data.trials.failures[failure]} in ${data.trials.phases[phase] ?? "no phase"}`;
};
const quoted = (word) => (/^[\w./-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`);
const study = data.study_file === data.default_study ? "" : ` --study ${quoted(data.study_file)}`;
const replayOf = (trial) => `rgss replay ${data.trials.key[trial]}${study}`;
const runOf = (trial) => `rgss run ${variants.id[data.trials.variant[trial]]} --seed ${data.trials.seed[trial]} --fidelity ${data.fidelity}${study}`;

// The trials that a measure of a variant is estimated from, each with a link to the command that runs it again.
const trialLinks = (place) => {
  const id = variants.id[place], trials = trialsOf(place);
  const links = trials.slice(0, 8).flatMap((trial, index) => [index ? ", " : "", element("a", { href: figureAddress(id, data.trials.key[trial]) }, `seed ${data.trials.seed[trial]}`)]);
  return trials.length > 8 ? [...links, `, and ${trials.length - 8} more`] : links;
};
const standsOn = (measure, place) => {
  const used = at(measure.n, place), trials = trialsOf(place).length;
  if (!measure.from_trials) return "the design alone";
  if (!used) return "nothing: no trial has a value";
  return element("span", { class: "many" }, used === trials ? "" : `${used} of these trials: `, ...trialLinks(place));
};
let tables = [];
const showVariant = (place) => {
  const id = variants.id[place];
  byId("variant-choice").value = String(id);
  const violated = variants.violates[place];
  const rank = known(variants.rank[place]) ? `rank ${variants.rank[place]}` : `misses ${violated.join(", ") || "a requirement"}`;
  byId("variant-note").textContent = `Variant ${id}: ${KINDS[kindOf[place]].name}; ${rank}; value ${show(variants.value[place])}.`;
  const hosts = ["Design", "Measures", "Requirements", "Trials"].map((title) => {
    const host = element("div");
    byId("variant-evidence").append(element("h3", {}, `${title} of variant ${id}`), host);
    return host;
  });
  byId("variant-evidence").replaceChildren(...Array.from(byId("variant-evidence").children).slice(-8));
  const figure = (name) => figureAddress(id, name);
  const design = pagedTable(hosts[0], {
    label: `Design of variant ${id}`,
    key: (one) => one.id,
    source: `From ${data.design_space}.`,
    columns: [
      { head: "parameter", cell: (one) => one.id },
      { head: "name", cell: (one) => one.name },
      { head: "value", number: true, cell: (one) => show(at(one.values, place), one.unit) },
    ],
    rows: () => data.parameters,
  });
  const measures = pagedTable(hosts[1], {
    label: `Measures of variant ${id}`,
    key: (one) => one.id,
    source: `Measures that depend on the design alone are computed from ${data.design_space} and ${data.catalogue}; “rgss measure” computes it again.`,
    columns: [
      { head: "measure", cell: (one) => one.id },
      { head: "name", cell: (one) => one.name },
      { head: "value", number: true, cell: (one) => show(at(one.value, place), one.unit) },
      { head: "interval", number: true, cell: (one) => interval(one, place) },
      { head: "depends on", cell: (one) => standsOn(one, place) },
      { head: "assumptions", cell: (one) => element("span", { class: "many" }, one.assumptions.join(", ")) },
    ],
    rows: () => data.measures.filter((one) => known(at(one.value, place))),
  });
  const requirements = pagedTable(hosts[2], {
    label: `Requirements and variant ${id}`,
    key: (one) => one.id,
    columns: [
      { head: "requirement", cell: (one) => element("a", { href: `#r-${one.id}` }, one.id) },
      { head: "criterion", cell: (one) => one.criterion },
      { head: "verdict", cell: (one) => element("span", { class: `verdict ${at(one.verdict, place)}` }, VERDICTS[at(one.verdict, place)].join(" ")) },
      { head: "figure", number: true, cell: (one) => estimate(measureOf.get(one.measure), place), to: (one) => figure(one.measure) },
      { head: "text", cell: (one) => element("span", { class: "words" }, one.text) },
    ],
    rows: () => data.requirements,
  });
  const trials = pagedTable(hosts[3], {
    label: `Trials of variant ${id}`,
    key: (trial) => data.trials.key[trial],
    source: `From ${data.evidence}.`,
    columns: [
      { head: "trial", cell: (trial) => element("code", {}, data.trials.key[trial]) },
      { head: "seed", number: true, cell: (trial) => String(data.trials.seed[trial]) },
      { head: "outcome", cell: outcomeOf },
      { head: "run it again and compare", cell: (trial) => element("code", {}, replayOf(trial)) },
      { head: "run it", cell: (trial) => element("code", {}, runOf(trial)) },
    ],
    rows: () => trialsOf(place),
  });
  tables = [design, measures, requirements, trials];
  for (const update of tables) update();
};
// The row of a figure, a requirement or a trial of the shown variant; null if it has none.
const rowNamed = (name) => {
  for (const update of tables) {
    const row = update.reveal(name);
    if (row !== null) return row;
  }
  return name === "trials" ? tables[3].reveal(data.trials.key[trialsOf(placeOf.get(Number(byId("variant-choice").value)))[0]]) : null;
};
const named = (text) => {
  try { return decodeURIComponent(text); } catch { return ""; }
};
const startEvidence = () => {
  const choice = byId("variant-choice");
  const fromAddress = () => {
    const match = /^#variant-(\d+)(?:\/(.*))?$/.exec(`#${addressNow().anchor}`);
    if (match === null) return;
    const place = placeOf.get(Number(match[1]));
    if (place === undefined) return;
    showVariant(place);
    const row = match[2] === undefined ? null : rowNamed(named(match[2]));
    if (row === null) {
      byId("evidence-title").focus({ preventScroll: true });
      byId("evidence").scrollIntoView();
      return;
    }
    row.classList.add("sought");
    row.tabIndex = -1;
    row.focus({ preventScroll: true });
    row.scrollIntoView({ block: "center" });
  };
  choice.addEventListener("change", () => {
    const place = placeOf.get(Number(choice.value));
    if (place === undefined) byId("variant-note").textContent = `Unknown variant ${choice.value}.`;
    else showVariant(place);
  });
  addEventListener("hashchange", fromAddress);
  // Following the same link again does not change the URL.
  addEventListener("click", (event) => {
    const link = event.target.closest?.('a[href^="#variant-"]');
    if (link && link.hash === `#${addressNow().anchor}`) { event.preventDefault(); fromAddress(); }
  });
  arrivals.push(() => tables[1]());
  showVariant(placeOf.get(data.decision.chosen ?? variants.id[0]) ?? 0);
  fromAddress();
};
