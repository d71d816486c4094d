// ----------------------------------------------------- planning times, failures, timelines
const startPlanning = () => {
  const planning = data.planning;
  const longest = Math.max(...planning.planners.map((planner) => planner.longest_limit_s), 0), simplifying = planning.simplification_limit_s;
  const limits = longest ? ` The time is that of the search, for which the longest limit is ${show(longest, "s")}, and of the simplification of its path${simplifying ? `, which has a limit of its own of ${show(simplifying, "s")}` : ""}: it can exceed the first limit.` : "";
  byId("planning-note").textContent = "Each search once, however many variants share it, with the longest limit of these. A curve that ends below 100 % found no path in the other searches." + limits + (planning.thinned ? " There are so many that quantiles stand for them, of all variants whatever is brushed." : "");
  const searchesOf = (index) => {
    const planner = planning.planners[index];
    if (planning.thinned) return { count: planner.searches, times: planner.quantiles_s.length ? planner.quantiles_s : planner.quartiles_s, solved: planner.solved };
    const there = planning.groups.map((group) => group.some((place) => shownMask[place]));
    const times = [];
    let count = 0;
    planning.planner.forEach((one, row) => {
      if (one !== index || !there[planning.group[row]]) return;
      count += 1;
      if (known(planning.time_s[row])) times.push(planning.time_s[row]);
    });
    return { count, times: times.sort((one, other) => one - other), solved: times.length };
  };
  const quantile = (times, share) => {
    if (!times.length) return null;
    const spot = share * (times.length - 1), low = Math.floor(spot), high = Math.min(times.length - 1, low + 1);
    return times[low] + (spot - low) * (times[high] - times[low]);
  };
  const rows = () => planning.planners.map((planner, index) => ({ planner, ...searchesOf(index) })).filter((row) => row.count);
  plot("planning", () => {
    const found = rows();
    if (!found.length) return null;
    // A time includes the simplification, beyond the limit of the search. The margin shows the last step; no curve turns back.
    const end = 1.04 * found.reduce((most, row) => Math.max(most, row.planner.longest_limit_s, row.times[row.times.length - 1] ?? 0), 0);
    return { traces: found.map((row, index) => ({ x: [0, ...row.times, end], y: [0, ...row.times.map((_, place) => ((place + 1) / row.times.length) * (row.solved / row.count)), row.solved / row.count], mode: "lines", name: plotText(row.planner.name), line: { shape: "hv", color: PALETTE[index % PALETTE.length], dash: DASHES[index % DASHES.length], width: 2.5 }, hovertemplate: "%{x:.3g} s: %{y:.0%}<extra>%{fullData.name}</extra>" })),
      layout: { showlegend: true, xaxis: { title: { text: "planning time [s]" }, range: [0, end] }, yaxis: { title: { text: "searches that had found a path" }, tickformat: ".0%", range: [0, 1.02] } } };
  });
  onShown(tableIn("planning-table", {
    label: "Planning times by planner",
    columns: [{ head: "planner", cell: (row) => row.planner.name }, { head: "searches", number: true, cell: (row) => show(row.count) }, { head: "found a path", number: true, cell: (row) => show(row.solved) },
      ...[["least", 0], ["quarter", 0.25], ["median", 0.5], ["three quarters", 0.75], ["most", 1]].map(([head, share]) => ({ head: `${head} [s]`, number: true, cell: (row) => show(quantile(row.times, share)), value: (row) => quantile(row.times, share) }))],
    rows, source: `From the searches that the trials in ${data.evidence} recorded; “rgss export ompl” writes each of them.`,
  }));
};

const startFailures = () => {
  const trials = data.trials;
  const counted = () => {
    const found = new Map();
    let ran = 0, failed = 0;
    trials.variant.forEach((place, trial) => {
      if (!shownMask[place]) return;
      ran += 1;
      const failure = at(trials.failure, trial);
      if (failure < 0) return;
      failed += 1;
      const key = `${failure},${at(trials.failed_phase, trial)}`;
      if (!found.has(key)) found.set(key, { failure, phase: at(trials.failed_phase, trial), count: 0, example: trial });
      found.get(key).count += 1;
    });
    const rows = Array.from(found.values()).sort((one, other) => other.count - one.count || one.failure - other.failure || one.phase - other.phase);
    return { rows, ran, failed };
  };
  plot("failures", () => {
    const { rows } = counted();
    if (!rows.length) return null;
    const trialsOf = (kind, phase = null) => rows.filter((row) => row.failure === kind && (phase === null || row.phase === phase)).reduce((sum, row) => sum + row.count, 0);
    const kinds = [...new Set(rows.map((row) => row.failure))].sort((one, other) => trialsOf(other) - trialsOf(one) || one - other);
    const phases = [...new Set(rows.map((row) => row.phase))].sort((one, other) => one - other);
    return { traces: phases.map((phase, index) => ({ type: "bar", orientation: "h", name: plotText(trials.phases[phase] ?? "no phase"), y: kinds.map((kind) => plotText(trials.failures[kind])), x: kinds.map((kind) => trialsOf(kind, phase)), marker: filling(PALETTE[index % PALETTE.length], index), hovertemplate: "%{x} trials<extra>%{fullData.name}</extra>" })),
      layout: { barmode: "stack", height: 200 + 46 * kinds.length, yaxis: { type: "category", autorange: "reversed" }, xaxis: { title: { text: "trials" }, rangemode: "tozero" } } };
  });
  const update = tableIn("failures-table", {
    label: "Failures of trials of the shown variants",
    columns: [{ head: "failure", cell: (row) => trials.failures[row.failure] }, { head: "in the phase", cell: (row) => trials.phases[row.phase] ?? "–" }, { head: "trials", number: true, cell: (row) => String(row.count), to: (row) => figureAddress(variants.id[trials.variant[row.example]], trials.key[row.example]) },
      { head: "first in variant", number: true, cell: (row) => variantLink(variants.id[trials.variant[row.example]]) }, { head: "see the first", cell: (row) => element("code", {}, replayOf(row.example)) }],
    rows: () => counted().rows,
  });
  const tell = () => {
    const { ran, failed } = counted();
    byId("failure-note").textContent = `${failed} of ${ran} trials of the shown variants failed.`;
  };
  onShown(() => { update(); tell(); });
  tell();
};

const startTimeline = () => {
  const trials = data.trials, choice = byId("timeline-choice"), note = byId("timeline-note");
  const name = (trial) => `variant ${variants.id[trials.variant[trial]]}, seed ${trials.seed[trial]}`;
  const why = new Map(trials.notable.map((one) => [one.trial, one]));
  const fill = () => {
    const before = choice.value;
    const others = Object.keys(trials.timelines).map(Number).filter((trial) => !why.has(trial) && shownMask[trials.variant[trial]]);
    options(choice, [...trials.notable.map((one) => [one.trial, `${name(one.trial)}: ${one.why}`]), ...others.map((trial) => [trial, `${name(trial)}: ${outcomeOf(trial)}`])]);
    if (Array.from(choice.options).some((one) => one.value === before)) choice.value = before;
  };
  const rows = () => {
    const line = trials.timelines[choice.value];
    if (!line) return [];
    let time = 0;
    return trials.phases.map((phase, index) => {
      const planning = line.planning_s[index] ?? 0, moving = line.duration_s[index] ?? 0;
      const row = { phase, outcome: line.outcome[index].replace(/_/g, " "), start: time, planning, moving };
      time += planning + moving;
      return row;
    });
  };
  const redraw = plot("timeline", () => {
    const found = rows();
    if (!found.length) return null;
    const names = found.map((row, index) => `${index + 1} ${row.phase}${row.outcome === "completed" ? "" : ` (${row.outcome})`}`);
    const bar = (label, start, length, colour, shape) => ({ type: "bar", orientation: "h", name: label, y: names, base: start, x: length, marker: filling(colour, shape), hovertemplate: "%{x:.3g} s<extra>%{fullData.name}</extra>" });
    return { traces: [bar("planning", found.map((row) => row.start), found.map((row) => row.planning), "#e69f00", 1), bar("phase", found.map((row) => row.start + row.planning), found.map((row) => row.moving), "#0072b2", 0)],
      layout: { barmode: "overlay", yaxis: { type: "category", autorange: "reversed" }, xaxis: { title: { text: "time [s], shorter is better" }, rangemode: "tozero" } } };
  });
  const update = tableIn("timeline-table", {
    label: "Phases of the trial",
    columns: [{ head: "phase", cell: (row) => row.phase }, { head: "outcome", cell: (row) => row.outcome }, { head: "begins [s]", number: true, cell: (row) => (row.outcome === "not run" ? "–" : show(row.start)), value: (row) => (row.outcome === "not run" ? null : row.start) }, { head: "planning [s]", number: true, cell: (row) => show(row.planning), value: (row) => row.planning }, { head: "phase [s]", number: true, cell: (row) => show(row.moving), value: (row) => row.moving }],
    rows, source: "From the record of the trial that is named above, with the command that runs it again.",
  });
  const tell = () => {
    const trial = Number(choice.value), notable = why.get(trial);
    note.replaceChildren();
    if (choice.value === "") return;
    note.append(`${outcomeOf(trial)}${notable && notable.detail ? `: ${notable.detail}` : ""}. `, element("code", {}, replayOf(trial)), trials.every_timeline ? "" : " There are so many trials that only these have a time line here.");
  };
  choice.addEventListener("change", () => { tell(); redraw(); update(); });
  onShown(() => { fill(); tell(); update(); });
  fill(); tell(); update();
};
