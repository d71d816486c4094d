// ------------------------------------------------------------------------------ start
drawLegends();
countShown();
byId("find-note").append("Find, here and above, takes filters of variants and comparisons of their parameters and estimates",
  ...filterExamples().flatMap((one, index) => [index ? " or " : ", such as ", element("code", {}, one)]), ".");
onShown(parallel.draw);
onShown(verdictsTable());
onShown(tableIn("parallel-table", {
  label: "The shown variants",
  columns: [...variantColumns, ...parameterColumns, ...effectivenessColumns, valueColumn],
  rows: byRank, search: finds, problem: filterProblem,
}));
startMeasures();
startPareto();
startDistributions();
startTornado();
startWeights();
startAcceptability();
startEffects();
startPlanning();
startFailures();
startTimeline();
startEvidence();
startCompare();
startContents();
startUnfolding();
startSorting();
startFind();
startAddress();
parallel.draw();

// Colours come from the style sheet, which follows the reader's colour scheme; print is always light.
const redrawAll = () => {
  parallel.draw();
  for (const { redraw } of drawings) redraw();
};
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redrawAll);
addEventListener("beforeprint", () => {
  // The page's own script has opened the closed details, but their events come too late for printing.
  for (const refresh of refreshers) refresh();
  for (const drawRows of paged) drawRows(true);
  for (const { drawForPaper, host } of drawings) {
    drawForPaper();
    layOut(host, { width: 960, autosize: false });
  }
});
addEventListener("afterprint", () => {
  for (const drawRows of paged) drawRows(false);
  for (const { host } of drawings) layOut(host, { width: null, autosize: true });
});
performance.mark("rgss-report");
const ready = () => { document.documentElement.dataset.ready = "yes"; };
// With many variants, measures without a weight and a limit come last.
if (later === null) ready();
else {
  later().then((columns) => {
    for (const [id, column] of Object.entries(columns)) Object.assign(measureOf.get(id), column);
    for (const fill of arrivals) fill();
    if (addressNow().sent) readAddress();
    ready();
  });
}
