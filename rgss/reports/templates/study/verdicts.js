// ------------------------------------------------------- verdicts of the shown variants
const VERDICTS = {
  __proto__: null, // so that a word such as "constructor" is none
  met: ["✔", "met"], not_met: ["✘", "not met"], inconclusive: ["◐", "inconclusive"],
  not_run: ["○", "not run"], stale: ["↻", "stale"],
};
const drawLegends = () => {
  const swatch = (kind) => {
    const look = KINDS[kind];
    const line = element("span", { class: `swatch kind-${kind}`, "aria-hidden": "true" });
    return element("li", {}, line, ` ${look.name}`);
  };
  byId("legend").replaceChildren(...[CHOSEN, FRONT, FEASIBLE, INFEASIBLE].filter((kind) => kindOf.includes(kind)).map(swatch));
  const shown = new Set(data.requirements.flatMap((one) => (Array.isArray(one.verdict) ? one.verdict : [one.verdict])));
  byId("verdict-legend").replaceChildren(...Object.entries(VERDICTS).filter(([name]) => shown.has(name))
    .map(([name, [sign, words]]) => element("li", {}, element("span", { class: `verdict ${name}` }, `${sign} ${words}`))));
};
const verdictCell = (requirement, place) => {
  const verdict = at(requirement.verdict, place);
  const [sign, words] = VERDICTS[verdict];
  const causes = requirement.stale[String(place)] || [];
  const measure = measureOf.get(requirement.measure);
  const spread = interval(measure, place);
  const number = element("a", { href: figureAddress(variants.id[place], requirement.id), tabindex: -1, class: "quiet" }, show(at(measure.value, place), measure.unit));
  const badge = element("span", { class: `verdict ${verdict}`, title: causes.length ? `${words}: ${causes.join(", ")} changed` : words },
    element("span", { "aria-hidden": "true" }, sign), element("span", { class: "vh" }, words));
  const figure = element("span", {}, badge, " ", number);
  return element("span", { class: "judged" }, figure, ...(spread ? [" ", element("span", { class: "small" }, `(${spread})`)] : []));
};
// A limit is not divided: a line ends before its sign.
const wholeLimit = (criterion) => criterion.replace(/([<>=]=?) (\S+)(?: (\S+))?$/, (_, ...parts) => parts.slice(0, 3).filter(Boolean).join("\u00a0"));
const verdictsTable = () => tableIn("verdict-table", {
  label: "Verdicts of the shown variants",
  columns: [
    ...variantColumns,
    valueColumn,
    ...data.requirements.map((requirement) => ({
      head: element("span", {}, element("span", { class: "id" }, requirement.id), element("br"), element("span", { class: "small" }, wholeLimit(requirement.criterion))),
      title: requirement.text,
      number: true,
      cell: (place) => verdictCell(requirement, place),
      sort: (place) => at(measureOf.get(requirement.measure).value, place),
    })),
  ],
  rows: byRank,
  search: finds, problem: filterProblem,
});
