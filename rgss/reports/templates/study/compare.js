// ------------------------------ variants side by side, and distributions of the measures
const MOST_COMPARED = 12;

const startCompare = () => {
  const field = byId("compare-choice"), differing = byId("compare-differing"), note = byId("compare-note"), host = byId("compare-table");
  const best = variants.id.map((_, place) => place).filter((place) => known(variants.rank[place])).sort((one, other) => variants.rank[one] - variants.rank[other]).slice(0, 2);
  const first = best.length === 2 ? best : [0, 1].filter((place) => place < total);
  field.value = [...new Set([placeOf.get(data.decision.chosen) ?? first[0], placeOf.get(data.decision.runner_up) ?? first[1], ...first])].slice(0, 2).map((place) => variants.id[place]).join(", ");
  // One variant has none to be compared with: the section is hidden.
  byId("variant-compare").hidden = byId("clear").hidden = total < 2;
  if (total < 2) {
    field.value = "";
    return;
  }
  const wanted = () => [...new Set(field.value.split(/[\s,;]+/).filter(Boolean))];
  const compared = () => wanted().map((text) => placeOf.get(Number(text))).filter(known).slice(0, MOST_COMPARED);
  const rowsOf = (places) => {
    const rows = [];
    const add = (name, kind, key, better, value, text, { unit = "", ends = () => [] } = {}) => {
      const values = places.map(value);
      const there = values.filter((one) => typeof one === "number");
      const top = better === "higher" ? Math.max(...there) : better === "lower" ? Math.min(...there) : null;
      // What is written alike neither differs nor is better.
      const differs = new Set(places.map(text)).size > 1;
      const topText = top === null ? "" : text(places.find((place) => value(place) === top));
      rows.push({ name, kind, key, differs, text, value, unit: unit === "1" ? "" : unit, ends, best: (place) => differs && top !== null && text(place) === topText });
    };
    for (const one of data.parameters) add(one.name, "parameter", one.id, "none", (place) => at(one.values, place), (place) => show(at(one.values, place), one.unit), { unit: one.unit });
    for (const one of data.measures) {
      if (places.some((place) => known(at(one.value, place)))) add(`${one.id}: ${one.name}`, "measure", one.id, one.better, (place) => at(one.value, place), (place) => estimate(one, place), { unit: one.unit, ends: (place) => [at(one.low, place), at(one.high, place)] });
    }
    for (const one of data.requirements) add(`${one.id}: ${one.criterion}`, "verdict", one.id, "none", (place) => VERDICTS[at(one.verdict, place)][1], (place) => VERDICTS[at(one.verdict, place)].join(" "));
    add("weighted value", "value", "value", "higher", (place) => variants.value[place], (place) => show(variants.value[place]));
    add("rank", "value", "value", "lower", (place) => variants.rank[place], (place) => show(variants.rank[place]));
    return rows;
  };
  const cell = (row, place) => {
    const link = element("a", { href: figureAddress(variants.id[place], row.key), class: "quiet" }, row.text(place));
    return row.best(place) ? element("strong", { title: "best of these" }, link, " ★") : link;
  };
  let specification = null;
  const draw = () => {
    const places = compared();
    const lacking = wanted().filter((text) => !placeOf.has(Number(text)));
    note.textContent = lacking.length ? `Unknown variant ${lacking.join(", ")}.` : places.length < 2 ? "Name two variants or more." : wanted().length > MOST_COMPARED ? `The first ${MOST_COMPARED} are shown.` : "★ is the best of these by the estimates, where they differ.";
    if (!places.length) { host.replaceChildren(); return; }
    specification = {
      label: "Variants side by side", size: 200,
      columns: [{ head: "of the variant", cell: (row) => row.name, sort: (row) => row.name }, { head: "kind", cell: (row) => row.kind },
        ...places.map((place) => ({ head: element("span", {}, variants.id[place] === data.decision.chosen ? `${variants.id[place]} (chosen)` : String(variants.id[place])), number: true, cell: (row) => cell(row, place) }))],
      // In the file a number has its unit, and the ends of its interval, in columns of their own.
      csv: [{ head: "of the variant", cell: (row) => row.name }, { head: "kind", cell: (row) => row.kind }, { head: "unit", cell: (row) => row.unit },
        ...places.flatMap((place) => ["", " low", " high"].map((end, index) => ({ head: `${variants.id[place]}${end}`, cell: (row) => (index ? row.ends(place)[index - 1] : row.value(place)) })))],
      rows: () => rowsOf(places).filter((row) => row.differs || !differing.checked),
    };
    specifications.set("compare-table", specification);
    pagedTable(host, specification)();
  };
  let waiting = 0;
  field.addEventListener("input", () => { clearTimeout(waiting); waiting = setTimeout(() => { draw(); tellAddress(); }, 150); });
  field.addEventListener("change", draw);
  field.form.addEventListener("submit", (event) => event.preventDefault());
  differing.addEventListener("change", draw);
  arrivals.push(draw);
  byId("variant-compare").addEventListener("click", () => {
    const id = byId("variant-choice").value;
    if (!wanted().includes(id)) field.value = [...wanted(), id].join(", ");
    draw();
    tellAddress();
    byId("compare").scrollIntoView();
  });
  downloadsFor(host, "compare", { csv: true });
  draw();
};

// No parameter has such an id, so that an address means one of them.
const ROLE = "-role";
const startDistributions = () => {
  const by = byId("distribution-by");
  const level = (one) => (place) => show(at(one.values, place), one.unit);
  const groupings = new Map([["", () => "shown variants"], [ROLE, (place) => KINDS[kindOf[place]].name], ...varying.filter((one) => new Set(one.values).size <= 8).map((one) => [one.id, level(one)])]);
  options(by, [["", "nothing"], [ROLE, "role in the decision"], ...varying.filter((one) => groupings.has(one.id)).map((one) => [one.id, one.name])]);
  const rows = () => {
    const groupOf = groupings.get(by.value);
    const groups = new Map();
    for (const place of shownPlaces) {
      const name = groupOf(place);
      if (!groups.has(name)) groups.set(name, []);
      groups.get(name).push(place);
    }
    const names = Array.from(groups.keys()).sort(collator.compare);
    return effectiveness.flatMap((measure) => names.map((name) => {
      const places = groups.get(name).filter((place) => known(at(measure.value, place)));
      return { measure, name, places, values: places.map((place) => at(measure.value, place)).sort((one, other) => one - other) };
    })).filter((row) => row.values.length);
  };
  const redraw = plot("distributions", () => {
    const found = rows();
    if (!found.length) return null;
    const names = [...new Set(found.map((row) => row.name))];
    const measures = effectiveness.filter((measure) => found.some((row) => row.measure === measure));
    const each = 1 / measures.length, layout = { height: 60 + measures.length * (92 + 22 * (names.length - 1)), boxmode: "group", showlegend: names.length > 1, margin: { l: 90, r: 16, t: 48, b: 40 } };
    const colourOf = (name) => (by.value === ROLE ? KINDS.find((one) => one.name === name).colour : PALETTE[names.indexOf(name) % PALETTE.length]);
    const traces = [];
    measures.forEach((measure, index) => {
      const number = index === 0 ? "" : String(index + 1), from = 1 - each * (index + 1);
      // Each measure has its own scale, with its name and its preferred direction below it.
      layout[`xaxis${number}`] = { anchor: `y${number}`, title: { text: plotText(withBetter(measure)), standoff: 4, font: { size: 12 } }, automargin: false, ...scaleOf(found.filter((one) => one.measure === measure).flatMap((one) => one.values), measure) };
      layout[`yaxis${number}`] = { anchor: `x${number}`, domain: [from + each * 0.5, from + each * 0.98], showticklabels: false, type: "category", automargin: false };
      for (const row of found.filter((one) => one.measure === measure)) {
        const few = row.places.length <= MOST_POINTS;
        traces.push({ type: "box", orientation: "h", x: row.places.map((place) => at(measure.value, place)), y: row.places.map(() => measure.id), xaxis: `x${number}`, yaxis: `y${number}`, name: plotText(row.name), legendgroup: row.name, showlegend: index === 0, offsetgroup: row.name, marker: { color: colourOf(row.name), size: 5, opacity: 0.7 }, boxpoints: few ? "all" : "outliers", jitter: 0.6, pointpos: 0, hoveron: "points+boxes", hovertext: row.places.map((place) => plotText(`variant ${variants.id[place]}: ${estimate(measure, place)}`)), hoverinfo: "text+x", meta: row.places.map((place) => variants.id[place]) });
      }
      const place = placeOf.get(data.decision.chosen);
      if (place !== undefined && shownMask[place] && known(at(measure.value, place))) traces.push({ x: [at(measure.value, place)], y: [measure.id], xaxis: `x${number}`, yaxis: `y${number}`, mode: "markers", cliponaxis: false, name: `variant ${variants.id[place]}, chosen`, showlegend: index === 0, legendgroup: "chosen", marker: markerOf(CHOSEN, 6), hoverinfo: "text", text: [plotText(`variant ${variants.id[place]}, chosen: ${estimate(measure, place)}`)], meta: [variants.id[place]] });
    });
    return { traces, layout: { ...layout, showlegend: true } };
  });
  const quantile = (values, share) => {
    const spot = share * (values.length - 1), low = Math.floor(spot);
    return values[low] + (spot - low) * ((values[low + 1] ?? values[low]) - values[low]);
  };
  const update = tableIn("distributions-table", {
    label: "Distributions of the measures over the shown variants",
    columns: [{ head: "measure", cell: (row) => withUnit(row.measure.id, row.measure.unit) }, { head: "of", cell: (row) => row.name }, { head: "variants", number: true, cell: (row) => String(row.values.length) },
      ...[["least", 0], ["quarter", 0.25], ["median", 0.5], ["three quarters", 0.75], ["most", 1]].map(([head, share]) => ({ head, number: true, cell: (row) => show(quantile(row.values, share)), value: (row) => quantile(row.values, share) }))],
    rows, source: "Computed here from the estimates of the shown variants; their evidence is below.",
  });
  by.addEventListener("change", () => { redraw(); update(); });
  onShown(update);
};
