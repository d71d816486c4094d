// ----------------------------------- tables of any length: a page of rows and a search
const PAGE_ROWS = 100;

// columns: [{head, cell(row) → text or node, number, to(row) → where its evidence stands}];
// rows() → list of rows; key(row) → what a link names it by; source: what all its figures stand on.
const pagedTable = (host, { label, columns, rows, search = null, size = PAGE_ROWS, key = null, source = "" }) => {
  let first = 0;
  let found = [];
  const body = element("tbody");
  const heads = columns.map((column) => element("th", { scope: "col", title: column.title || null }, column.head));
  const table = element("table", {}, element("thead", {}, element("tr", {}, ...heads)), body);
  const box = element("div", { class: "scroll", role: "region", tabindex: 0, "aria-label": label }, table);
  const told = element("output", { "aria-live": "polite" });
  const back = element("button", { type: "button" }, "Previous rows");
  const on = element("button", { type: "button" }, "Next rows");
  const wanted = element("input", { type: "search", placeholder: "number or words", autocomplete: "off" });
  const pager = element("p", { class: "pager" });
  if (search) pager.append(element("label", {}, "Find ", wanted));
  pager.append(told, back, on);
  host.replaceChildren(pager, box);
  if (source) host.append(element("p", { class: "small source" }, source));

  const draw = () => {
    const page = found.slice(first, first + size);
    body.replaceChildren(...page.map((row) => {
      const line = element("tr", key ? { "data-key": key(row) } : {});
      columns.forEach((column, index) => {
        const said = column.cell(row);
        // Only the row's own head is in the order of the tabulator: it leads to the same evidence.
        const cell = column.to && typeof said === "string" && /\d/.test(said) ? element("a", { href: column.to(row), tabindex: -1, class: "quiet" }, said) : said;
        const tag = index === 0 ? "th" : "td";
        const attributes = index === 0 ? { scope: "row" } : { class: column.number ? "number" : null };
        line.append(element(tag, attributes, ...(cell === null ? [] : [cell])));
      });
      return line;
    }));
    const many = found.length > size;
    told.textContent = many ? `Rows ${first + 1} to ${first + page.length} of ${found.length}` : `${found.length} rows`;
    back.hidden = on.hidden = !many;
    back.disabled = first === 0;
    on.disabled = first + size >= found.length;
  };
  const update = () => {
    const words = wanted.value.toLowerCase().split(/\s+/).filter(Boolean);
    found = rows();
    if (search && words.length) found = found.filter((row) => words.every((word) => search(row, word)));
    first = Math.min(first, Math.max(0, Math.floor((found.length - 1) / size) * size));
    draw();
  };
  back.addEventListener("click", () => { first = Math.max(0, first - size); draw(); });
  on.addEventListener("click", () => { first += size; draw(); });
  wanted.addEventListener("input", () => { first = 0; update(); });
  update.reveal = (name) => {
    const index = key === null ? -1 : found.findIndex((row) => key(row) === name);
    if (index < 0) return null;
    first = Math.floor(index / size) * size;
    draw();
    return body.rows[index - first];
  };
  return update;
};

const refreshers = [];

// A table inside closed details is filled when it is opened, and kept up to date while it is open.
const tableIn = (id, specification) => {
  const host = byId(id);
  const details = host.closest("details");
  let update = null;
  const refresh = () => {
    if (details && !details.open) return;
    if (update === null) update = pagedTable(host, specification);
    update();
  };
  if (details) details.addEventListener("toggle", refresh);
  refreshers.push(refresh);
  refresh();
  return refresh;
};

const byRank = () => shownPlaces.slice().sort((one, other) => {
  const left = variants.rank[one] ?? Infinity, right = variants.rank[other] ?? Infinity;
  return left === right ? variants.id[one] - variants.id[other] : left - right;
});
const varying = data.parameters.filter((parameter) => parameter.varies);
const effectiveness = data.measures.filter((measure) => measure.kind === "moe" || measure.weight !== null);
// Columns of parameters and measures of a variant, each figure with the way to its evidence.
const parameterColumns = varying.map((one) => ({ head: withUnit(one.name, one.unit), number: true, cell: (place) => show(at(one.values, place)), to: (place) => figureAddress(variants.id[place], one.id) }));
const effectivenessColumns = effectiveness.map((one) => ({ head: withUnit(one.id, one.unit), title: one.name, number: true, cell: (place) => show(at(one.value, place)), to: (place) => figureAddress(variants.id[place], one.id) }));
const valueColumn = { head: "value", number: true, cell: (place) => show(variants.value[place]), to: (place) => figureAddress(variants.id[place], "value") };
// A whole number names a variant; other words stand in what is said of it.
const finds = (place, word) => {
  if (/^\d+$/.test(word)) return String(variants.id[place]) === word;
  const said = [KINDS[kindOf[place]].name, ...varying.map((one) => at(one.values, place))];
  return said.join(" ").toLowerCase().includes(word);
};
const variantColumns = [
  { head: "Variant", cell: (place) => variantLink(variants.id[place]) },
  { head: "rank", number: true, cell: (place) => show(variants.rank[place]), to: (place) => figureAddress(variants.id[place], "value") },
  { head: "stands", cell: (place) => element("span", { class: "stands" }, KINDS[kindOf[place]].name) },
];
