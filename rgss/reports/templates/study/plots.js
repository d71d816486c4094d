// -------------------------------------------------- plots: drawn when they become visible
const MOST_POINTS = 400, MOST_SCATTERED = 2000;
const drawings = [];
// Source of figures that are computed from all variants together.
const ANALYSED = `From all trials of the study in ${data.evidence}; “rgss trade${data.study_file === data.default_study ? "" : ` ${data.study_file}`}” computes them again.`;

// The library is embedded as text, and run when the first plot is about to become visible.
const needPlotly = () => {
  if (typeof Plotly !== "undefined") return;
  document.head.append(element("script", {}, document.querySelector("script.held").textContent));
};

const layoutOf = (more) => {
  const style = getComputedStyle(document.documentElement);
  const ink = style.getPropertyValue("--ink").trim(), line = style.getPropertyValue("--line").trim();
  // Distance of a title from the ticks, and so from the edge of the picture.
  const spaced = (one) => (one.title ? { ...one, title: { standoff: 12, ...one.title } } : one);
  const axis = (one) => ({ gridcolor: line, zerolinecolor: line, linecolor: ink, automargin: true, fixedrange: false, exponentformat: "power", minexponent: 6, separatethousands: true, ...spaced(one) });
  const { xaxis = {}, yaxis = {}, ...rest } = more;
  return {
    font: { family: "system-ui, sans-serif", size: 13, color: ink },
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    margin: { l: 60, r: 16, t: 48, b: 64 }, hovermode: "closest",
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, traceorder: "normal" },
    ...Object.fromEntries(Object.entries(rest).map(([name, one]) => [name, /^[xy]axis\d/.test(name) ? axis(one) : one])), xaxis: axis(xaxis), yaxis: axis(yaxis),
  };
};
// The library places a legend by its size in the layout before: of a width that is new, it is laid out twice.
const layOut = (host, change) => {
  if (!host.classList.contains("js-plotly-plot")) return;
  Plotly.relayout(host, change);
  Plotly.redraw(host);
};
// make() → {traces, layout}, or null if there is nothing to draw; bySize: whether its traces depend on the plot's width.
const plot = (id, make, { bySize = false } = {}) => {
  const host = byId(`${id}-plot`);
  // A section without a use in this study is hidden, and has no picture.
  if (host.closest("[hidden]")) return () => {};
  let near = false, stale = true, offer = () => {}, drawnWidth = 0;
  const draw = (always = false) => {
    stale = true;
    // Invisible plots are drawn when they are about to become visible, so that a brush responds fast.
    if (!near && !always) return;
    stale = false;
    needPlotly();
    drawnWidth = host.clientWidth;
    const made = make();
    offer(made !== null);
    if (made === null) {
      Plotly.purge(host);
      host.style.height = "auto";
      delete host.dataset.linked;
      host.replaceChildren(element("p", {}, "There is nothing to draw here."));
      return;
    }
    if (!host.classList.contains("js-plotly-plot")) host.replaceChildren();
    const height = `${made.layout.height || 340}px`, grown = host.style.height !== height;
    host.style.minHeight = "0";
    host.style.height = height;
    Plotly.react(host, made.traces, layoutOf({ ...made.layout, height: undefined }), {
      displaylogo: false, modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"], displayModeBar: false,
    });
    if (grown) Plotly.Plots.resize(host);
    if (!host.dataset.linked) {
      host.dataset.linked = "yes";
      host.on("plotly_click", (event) => {
        const point = event.points[0];
        const chosen = point && point.data.meta && point.data.meta[point.pointIndex ?? point.pointNumber];
        if (known(chosen)) location.hash = `#variant-${chosen}`;
      });
    }
  };
  new IntersectionObserver((entries) => {
    near = entries[entries.length - 1].isIntersecting;
    if (near && stale) draw();
  }, { rootMargin: "300px" }).observe(host);
  const redraw = () => draw();
  onShown(redraw);
  let waiting = 0;
  new ResizeObserver(() => {
    clearTimeout(waiting);
    waiting = setTimeout(() => {
      if (!host.clientWidth || host.clientWidth === drawnWidth) return;
      if (bySize) draw();
      drawnWidth = host.clientWidth;
      layOut(host, { autosize: true });
    }, 100);
  }).observe(host);
  offer = downloadsFor(host, id, { csv: true, svg: async () => {
    if (stale) draw(true);
    if (!host.classList.contains("js-plotly-plot")) throw new Error(`plot ${id} has nothing to draw`);
    const size = { width: host.clientWidth, height: host.clientHeight };
    return [await Plotly.toImage(host, { format: "svg", ...size }), size.width, size.height];
  } });
  drawings.push({ redraw, drawForPaper: () => { if (stale) draw(true); }, host });
  return redraw;
};
// Colour and hatching, so that bars can be distinguished without colours too.
const SHAPES = ["", "/", "x", "-", "\\", "+", ".", "|"];
const filling = (colour, index) => ({ color: colour, pattern: { shape: SHAPES[index % SHAPES.length], fillmode: "replace", bgcolor: colour, fgcolor: "#ffffff", size: 7, solidity: 0.15 } });
const markerOf = (kind, size = 9) => ({ color: KINDS[kind].colour, symbol: KINDS[kind].symbol, size: kind === CHOSEN ? size + 7 : size, line: { width: 1.5, color: KINDS[kind].colour } });

// ------------------------------------------------------------ measures with intervals
const startMeasures = () => {
  const choice = byId("measure-choice");
  const fill = () => {
    const there = data.measures.filter((measure) => Array.isArray(measure.value) ? measure.value.some(known) : known(measure.value));
    const before = choice.value;
    options(choice, there.map((measure) => [measure.id, `${measure.id}: ${measure.name}`]));
    if (before) choice.value = before;
    return there;
  };
  const shownMeasures = fill();
  arrivals.push(fill);
  const current = () => measureOf.get(choice.value);
  const ordered = () => {
    const measure = current();
    return shownPlaces.filter((place) => known(at(measure.value, place)))
      .sort((one, other) => at(measure.value, one) - at(measure.value, other) || variants.id[one] - variants.id[other]);
  };
  const redraw = plot("measures", () => {
    const measure = current();
    const places = ordered();
    if (!places.length) return null;
    const texts = (list) => list.map((place) => plotText(`variant ${variants.id[place]}: ${estimate(measure, place)}`));
    const traces = [];
    const index = new Map(places.map((place, position) => [place, position + 1]));
    if (places.length > MOST_POINTS) {
      const every = Math.ceil(places.length / 1000);
      const kept = places.filter((_, index) => index % every === 0 || index === places.length - 1);
      const across = kept.map((place) => index.get(place));
      const value = (place) => at(measure.value, place);
      traces.push({ x: across, y: kept.map((place) => at(measure.low, place) ?? value(place)), mode: "lines", line: { width: 0 }, showlegend: false, hoverinfo: "skip" });
      traces.push({ x: across, y: kept.map((place) => at(measure.high, place) ?? value(place)), mode: "lines", line: { width: 0 }, fill: "tonexty", fillcolor: "rgba(0,114,178,0.3)", name: "interval", hoverinfo: "skip" });
      traces.push({ x: across, y: kept.map(value), mode: "lines", line: { color: KINDS[FRONT].colour }, name: "estimate", text: texts(kept), hoverinfo: "text", meta: kept.map((place) => variants.id[place]) });
    }
    for (const kind of [INFEASIBLE, FEASIBLE, FRONT, CHOSEN]) {
      const mine = places.filter((place) => kindOf[place] === kind);
      if (!mine.length || (places.length > MOST_POINTS && kind < FRONT)) continue;
      const value = (place) => at(measure.value, place);
      traces.push({
        x: mine.map((place) => index.get(place)), y: mine.map(value), mode: "markers", name: KINDS[kind].name,
        marker: markerOf(kind), cliponaxis: false, text: texts(mine), hoverinfo: "text", meta: mine.map((place) => variants.id[place]),
        error_y: measure.from_trials ? {
          type: "data", symmetric: false, color: KINDS[kind].colour, thickness: 1, width: 2,
          array: mine.map((place) => (at(measure.high, place) ?? value(place)) - value(place)),
          arrayminus: mine.map((place) => value(place) - (at(measure.low, place) ?? value(place))),
        } : { visible: false },
      });
    }
    const limits = data.requirements.filter((one) => one.measure === measure.id);
    // The legend names the limits: a label in the plot would cover intervals.
    traces.push(...limits.map((one) => ({ x: [null], y: [null], mode: "lines", line: { color: "#d55e00", dash: "dash", width: 1.5 }, name: plotText(`${one.id}: ${one.criterion}`), hoverinfo: "skip" })));
    return { traces, layout: {
      shapes: limits.map((one) => ({ type: "line", xref: "paper", x0: 0, x1: 1, y0: one.threshold, y1: one.threshold, line: { color: "#d55e00", dash: "dash", width: 1.5 } })),
      xaxis: { title: { text: "variants, by this measure" }, ...(places.length <= 12 ? { dtick: 1 } : {}) },
      yaxis: { title: { text: plotText(withBetter(measure)) }, ...scaleOf([...places.flatMap((place) => [measure.value, measure.low, measure.high].map((column) => at(column, place)).filter(known)), ...limits.map((one) => one.threshold)], measure) },
    } };
  });
  const update = tableIn("measures-table", {
    label: "Measures of the shown variants",
    columns: [...variantColumns, ...effectiveness.map((measure) => ({ head: withUnit(measure.id, measure.unit), title: measure.name, number: true, cell: (place) => show(at(measure.value, place)) + (interval(measure, place) ? ` (${interval(measure, place)})` : ""), sort: (place) => at(measure.value, place), ends: measure.from_trials ? (place) => [at(measure.low, place), at(measure.high, place)] : null, to: (place) => figureAddress(variants.id[place], measure.id) })),
      { head: "trials", number: true, cell: (place) => show(at(variants.trials, place)), value: (place) => at(variants.trials, place), to: (place) => figureAddress(variants.id[place], "trials") }],
    rows: byRank, search: finds, problem: filterProblem,
  });
  onShown(update);
  const tell = () => {
    const measure = current();
    const counts = Array.isArray(measure.n) ? measure.n : [measure.n ?? 0];
    let fewest = Infinity, most = 0;
    for (const count of counts) { fewest = Math.min(fewest, count); most = Math.max(most, count); }
    const unknown = shownPlaces.filter((place) => !known(at(measure.value, place))).length;
    const better = measure.better === "none" ? "" : ` ${measure.better === "higher" ? "Higher" : "Lower"} is better.`;
    const lacking = unknown ? ` ${unknown} of the shown variants have none and are not drawn.` : "";
    byId("measure-note").textContent = measure.from_trials
      ? `Estimated from ${fewest === most ? most : `${fewest} to ${most}`} trials of each variant, with intervals of 95 %.${better}${lacking}`
      : `It follows from the design alone, without trials.${better}${lacking}`;
  };
  choice.addEventListener("change", () => { tell(); redraw(); });
  onShown(tell);
  const first = openingMeasure(shownMeasures);
  if (first) { choice.value = first.id; tell(); }
};

// ---------------------------------------------------------------------- Pareto scatter
const startPareto = () => {
  if (!variants.feasible.some(Boolean)) byId("pareto-note").textContent = "No variant is feasible by its estimates, and so there is no front.";
  const across = byId("pareto-x"), up = byId("pareto-y");
  for (const select of [across, up]) options(select, effectiveness.map((measure) => [measure.id, `${measure.id}: ${measure.name}`]));
  const spread = effectiveness.filter((measure) => varies(measure) && measure.weight !== null);
  across.value = (spread[1] || effectiveness[0]).id;
  up.value = ([spread[2], spread[0], ...effectiveness].find((measure) => measure && measure.id !== across.value) || effectiveness[0]).id;
  const redraw = plot("pareto", () => {
    const [horizontal, vertical] = [measureOf.get(across.value), measureOf.get(up.value)];
    const places = shownPlaces.filter((place) => known(at(horizontal.value, place)) && known(at(vertical.value, place)));
    if (!places.length) return null;
    const traces = [];
    const dense = places.length > MOST_SCATTERED;
    if (dense) {
      const others = places.filter((place) => kindOf[place] < FRONT);
      traces.push({ type: "histogram2d", x: others.map((place) => at(horizontal.value, place)), y: others.map((place) => at(vertical.value, place)), nbinsx: 60, nbinsy: 40, colorscale: [[0, "rgba(138,138,138,0)"], [0.001, "#e3e6ea"], [1, "#4d5660"]], colorbar: { title: { text: "variants" } }, hovertemplate: "%{z} variants<extra></extra>" });
    }
    const groups = coinciding(dense ? places.filter((place) => kindOf[place] >= FRONT) : places, horizontal, vertical, byId("pareto-plot"));
    const size = (group) => markerOf(kindOf[group[0]]).size + Math.min(3, Math.log2(group.length));
    const labels = countLabels(groups, horizontal, vertical, size, byId("pareto-plot"));
    for (const kind of [INFEASIBLE, FEASIBLE, FRONT, CHOSEN]) {
      const mine = groups.filter((group) => kindOf[group[0]] === kind);
      if (!mine.length) continue;
      const marker = markerOf(kind);
      traces.push({ x: mine.map(([place]) => at(horizontal.value, place)), y: mine.map(([place]) => at(vertical.value, place)), mode: "markers+text", name: KINDS[kind].name,
        marker: { ...marker, opacity: 1, size: mine.map(size) }, hoverinfo: "text", meta: mine.map(([place]) => variants.id[place]),
        text: mine.map((group) => labels.get(group)?.text ?? ""), textposition: mine.map((group) => labels.get(group)?.position ?? "top right"), textfont: { size: 12 }, cliponaxis: false,
        hovertext: mine.map((group) => namesOf(group) + `<br>${plotText(`${horizontal.id}: ${together(horizontal, group)}`)}<br>${plotText(`${vertical.id}: ${together(vertical, group)}`)}`) });
    }
    const axis = (measure) => ({ title: { text: plotText(withBetter(measure)) }, ...scaleOf(places.map((place) => at(measure.value, place)), measure) });
    return { traces, layout: { showlegend: true, xaxis: axis(horizontal), yaxis: axis(vertical) } };
  }, { bySize: true });
  for (const select of [across, up]) select.addEventListener("change", redraw);
  onShown(tableIn("pareto-table", {
    label: "The Pareto front among the shown variants",
    columns: [...variantColumns, { head: "support", cell: (place) => String(variants.pareto[place]).replace(/_/g, " ") }, ...effectivenessColumns],
    rows: () => byRank().filter((place) => variants.pareto[place] !== null),
  }));
};

// ------------------------------------------------------------- contributions of the measures
const startWeights = () => {
  const shownRanking = drawSliders();
  const parts = (row) => weighted.map((one, index) => normalised()[index] * (at(one.worth, row.place) ?? 0));
  const redraw = plot("weights", () => {
    const rows = shownRanking().slice(0, 10);
    if (!rows.length) return null;
    const names = rows.map((row) => `variant ${variants.id[row.place]}`);
    return { traces: weighted.map((one, index) => ({ type: "bar", orientation: "h", name: plotText(one.id), y: names, x: rows.map((row) => parts(row)[index]), marker: filling(PALETTE[index % PALETTE.length], index), hovertemplate: "%{x:.4f}<extra>%{fullData.name}</extra>", meta: rows.map((row) => variants.id[row.place]) })),
      layout: { barmode: "stack", yaxis: { autorange: "reversed", type: "category" }, xaxis: { title: { text: "weighted value, higher is better" }, range: [0, 1] } } };
  });
  rankingWatchers.push(redraw);
  const update = tableIn("weights-table", {
    label: "Contribution of each measure at these weights",
    columns: [{ head: "rank", cell: (row) => String(row.rank) }, { head: "variant", number: true, cell: (row) => variantLink(variants.id[row.place]) },
      ...weighted.map((one, index) => ({ head: one.id, number: true, cell: (row) => withDecimals(parts(row)[index], 4), value: (row) => parts(row)[index], to: (row) => figureAddress(variants.id[row.place], one.id) })), { head: "value", number: true, cell: (row) => withDecimals(row.value, 4), value: (row) => row.value, to: (row) => figureAddress(variants.id[row.place], "value") }],
    rows: shownRanking, size: 20, source: "Computed here: the weight times the value of the variant's figure.",
  });
  rankingWatchers.push(update);
  onShown(update);
};

// ----------------------------------------------------------------------- acceptability
const startAcceptability = () => {
  const found = data.decision.acceptability;
  const note = byId("acceptability-note");
  if (found === null) {
    note.textContent = data.decision.not_computed.find((line) => line.includes("acceptability")) || "Acceptability was not analysed, since the choice is not made by weighted value or nothing is feasible.";
  } else {
    const noise = found.with_noise ? " and the noise of the replicates" : "";
    note.textContent = `The share of ${found.iterations.toLocaleString("en-US")} draws of ${found.elicited ? "the elicited" : "all"} weights${noise} in which no variant is better.` + (found.drawn_by === "hit_and_run" ? " The weights are drawn by random walks (hit-and-run)." : "") + (found.more ? ` ${found.more} more come first in some draws.` : "");
  }
  const rows = () => (found === null ? [] : found.variants.filter((one) => shownMask[placeOf.get(one.variant)]));
  plot("acceptability", () => {
    const all = rows();
    if (!all.length) return null;
    // As many bars as have room for their numbers; the chosen variant is one of them.
    const most = Math.max(4, Math.floor((byId("acceptability-plot").clientWidth - 100) / (12 + 8 * Math.max(...all.map((one) => String(one.variant).length)))));
    const bars = all.slice(0, most);
    const chosen = all.find((one) => one.variant === data.decision.chosen);
    if (chosen && !bars.includes(chosen)) bars.splice(-1, 1, chosen);
    const ink = getComputedStyle(document.documentElement).getPropertyValue("--ink").trim();
    return { traces: [{ type: "bar", x: bars.map((one) => String(one.variant)), y: bars.map((one) => one.first), error_y: { type: "data", symmetric: false, color: ink, thickness: 1, array: bars.map((one) => Math.min(1 - one.first, 1.96 * one.error)), arrayminus: bars.map((one) => Math.min(one.first, 1.96 * one.error)) }, marker: { color: bars.map((one) => KINDS[kindOf[placeOf.get(one.variant)]].colour), pattern: { shape: bars.map((one) => (kindOf[placeOf.get(one.variant)] === INFEASIBLE ? "/" : "")), fillmode: "replace", bgcolor: "#8a8a8a", fgcolor: "#ffffff", size: 7, solidity: 0.15 } }, hoverinfo: "text", text: bars.map((one) => plotText(`variant ${one.variant}: first in ${percent(one.first)}`)), textposition: "none", meta: bars.map((one) => one.variant) }],
      layout: { xaxis: { type: "category", title: { text: `variant${chosen ? " (chosen: bold)" : ""}${bars.length < all.length ? `, ${bars.length} of ${all.length}` : ""}` }, tickmode: "array", tickangle: 0, tickvals: bars.map((one) => String(one.variant)), ticktext: bars.map((one) => (one.variant === data.decision.chosen ? `<b>${one.variant}</b>` : String(one.variant))) }, yaxis: { title: { text: "share of draws, higher is better" }, rangemode: "tozero", ...scaleOf([0, ...bars.map((one) => one.first)], SHARE), tickformat: ".0%" } } };
  });
  onShown(tableIn("acceptability-table", {
    label: "Acceptability of the shown variants",
    columns: [{ head: "variant", cell: (one) => variantLink(one.variant) }, { head: "first", number: true, cell: (one) => percent(one.first), value: (one) => one.first }, { head: "± (1.96 standard errors)", number: true, cell: (one) => percent(1.96 * one.error), value: (one) => 1.96 * one.error }, { head: "confidence", number: true, cell: (one) => percent(one.confidence), value: (one) => one.confidence }, { head: "feasible in", number: true, cell: (one) => percent(one.feasible), value: (one) => one.feasible }, { head: "share of weights", number: true, cell: (one) => percent(one.region), value: (one) => one.region }],
    rows, source: ANALYSED,
  }));
};

// ------------------------------------------------------------------------ main effects
const startEffects = () => {
  const choice = byId("effect-choice"), note = byId("effect-note");
  const shownEffects = data.effects.filter((one) => one.main.length || one.shares.length);
  options(choice, shownEffects.map((one) => [one.measure, `${one.measure}: ${measureOf.get(one.measure).name}`]));
  const current = () => shownEffects.find((one) => one.measure === choice.value);
  const factorOf = new Map(data.factors.map((factor) => [factor.id, factor]));
  const meanAmongShown = (one, factorId, levelName) => {
    const factor = factorOf.get(factorId), level = factor.levels.indexOf(levelName), measure = measureOf.get(one.measure);
    let sum = 0, count = 0;
    for (const place of shownPlaces) {
      const value = factor.level[place] === level ? at(measure.value, place) : null;
      if (known(value)) { sum += value; count += 1; }
    }
    return count ? sum / count : null;
  };
  const rows = () => {
    const one = current();
    if (!one) return [];
    return one.main.flatMap((term) => term.levels.map((level, index) => ({
      factor: term.factor, share: term.share, level, effect: term.effect[index],
      low: term.low === null ? null : term.low[index], high: term.high === null ? null : term.high[index],
      mean: one.mean + term.effect[index], brushed: meanAmongShown(one, term.factor, level),
    }))).concat(one.shares.map((share) => ({ factor: share.factor, share: share.share, level: "", effect: null, low: share.low, high: share.high, mean: null, brushed: null })));
  };
  const redraw = plot("effects", () => {
    const one = current();
    if (!one || !varies(measureOf.get(one.measure))) return null;
    if (!one.main.length) {
      return { traces: [{ type: "bar", x: one.shares.map((share) => plotText(share.factor)), y: one.shares.map((share) => share.share), marker: { color: KINDS[FRONT].colour }, error_y: { type: "data", symmetric: false, array: one.shares.map((share) => share.high - share.share), arrayminus: one.shares.map((share) => share.share - share.low) } }], layout: { xaxis: { type: "category" }, yaxis: { title: { text: "share of the variance" }, rangemode: "tozero" } } };
    }
    const traces = [], found = rows();
    // Without room for two rows of names, only the legend distinguishes the factors.
    const narrow = byId("effects-plot").clientWidth < 640;
    const across = (those) => (narrow ? those.map((row) => found.indexOf(row)) : [those.map((row) => plotText(row.factor)), those.map((row) => plotText(row.level))]);
    one.main.forEach((term, index) => {
      const mine = found.filter((row) => row.factor === term.factor);
      traces.push({ x: across(mine), y: mine.map((row) => row.mean), mode: "lines+markers", cliponaxis: false, name: plotText(`${term.factor} (${percent(term.share)})`), line: { color: PALETTE[index % PALETTE.length], dash: DASHES[index % DASHES.length] }, marker: { size: 9 },
        error_y: term.low === null ? { visible: false } : { type: "data", symmetric: false, thickness: 1, array: mine.map((row) => row.high - row.effect), arrayminus: mine.map((row) => row.effect - row.low) } });
    });
    if (shownPlaces.length < total) {
      traces.push({ x: across(found), y: found.map((row) => row.brushed), mode: "markers", name: "mean of the shown variants", marker: { symbol: "x", size: 10, color: "#d55e00" } });
    }
    return { traces, layout: { xaxis: narrow ? { type: "linear", tickvals: found.map((_, index) => index), ticktext: found.map((row) => plotText(row.level)), tickangle: -90 } : { type: "multicategory" }, yaxis: { title: { text: plotText(`mean of ${withBetter(measureOf.get(one.measure))}`) }, ...scaleOf(found.flatMap((row) => [row.mean, row.brushed, ...(known(row.low) ? [row.mean - row.effect + row.low, row.mean - row.effect + row.high] : [])]).filter(known), measureOf.get(one.measure)) }, height: 390 } };
  });
  const update = tableIn("effects-table", {
    label: "Main effects",
    columns: [{ head: "factor", cell: (row) => row.factor }, { head: "share", number: true, cell: (row) => percent(row.share), value: (row) => row.share }, { head: "level", cell: (row) => row.level }, { head: "effect", number: true, cell: (row) => show(row.effect), value: (row) => row.effect, ends: (row) => [row.low, row.high] }, { head: "interval of 95 %", number: true, merged: true, cell: (row) => (known(row.low) ? `${show(row.low)} to ${show(row.high)}` : "–") }, { head: "mean of the shown variants", number: true, cell: (row) => show(row.brushed), value: (row) => row.brushed }],
    rows, source: ANALYSED,
  });
  onShown(update);
  const tell = () => {
    const one = current();
    if (!one) {
      const reasons = new Set(data.effects.map((each) => each.not_computed).filter((reason) => reason));
      note.textContent = reasons.size ? `Not computed: ${[...reasons].join("; ")}.` : "No factor varies.";
      return;
    }
    const measure = measureOf.get(one.measure);
    if (!varies(measure)) {
      note.textContent = `${one.measure} is ${show(measure.value, measure.unit)} in all ${one.designs} designs: no factor changes it.`;
      return;
    }
    const joint = one.interactions.map((term) => `${term.factors.join(" × ")} ${percent(term.share)}`).join(", ");
    note.textContent = `Over ${one.designs} designs${one.left_out.length ? `, without ${one.left_out.join(", ")}, which lack the measure` : ""}; ${one.main.length ? "in brackets the share of the differences between designs" : "the share of the differences between designs that each factor explains alone"}.${joint ? ` Interactions: ${joint}.` : ""}${one.note ? ` ${one.note}` : ""}`;
  };
  choice.addEventListener("change", () => { tell(); redraw(); update(); });
  const first = openingMeasure(shownEffects.map((one) => measureOf.get(one.measure)));
  if (first) choice.value = first.id;
  tell();
  update();
};
