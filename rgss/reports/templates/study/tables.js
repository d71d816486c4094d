// ----------------------------------- tables of any length: a page of rows and a search
const PAGE_ROWS = 100, LEAST_SOUGHT = 8, MOST_PRINTED = 500;

// Search words; a verdict of two words is one word.
const wordsOf = (text) => text.toLowerCase().replace(/\bnot (met|run)\b/g, "not_$1").split(/\s+/).filter(Boolean);
// Words of a search field: a comparison is one word with its unit, and its number has no commas between thousands.
const COMPARED_UNITS = new Set([...data.parameters, ...data.measures].map((one) => one.unit.toLowerCase()).filter((unit) => unit && unit !== "1").concat("%"));
const soughtWords = (text) => wordsOf(text.toLowerCase()
  .replace(/\s*(!=|==|[<>]=?|=)\s*/g, "$1")
  .replace(/([=<>][-+]?\d{1,3})((?:,\d{3})+)(?!\d)/g, (_, start, rest) => start + rest.replace(/,/g, ""))
  .replace(/([=<>][-+]?[\d.]+(?:e[-+]?\d+)?)\s+(\S+)/g, (whole, start, unit) => (COMPARED_UNITS.has(unit) ? start + unit : whole)));

// The leading number of a text; the text if it has none; null for a dash.
const numberOf = (text) => {
  const plain = text.trim().replace(/^< /, "").replace(/,(?=\d{3})/g, "").replace("−", "-");
  if (plain === "" || plain === "–") return null;
  return /^[-+]?[\d.]/.test(plain) && !Number.isNaN(parseFloat(plain)) ? parseFloat(plain) : text;
};
const collator = new Intl.Collator("en", { numeric: true });
const sorter = FindAndSort.createNewSortInstance({
  comparer: (one, other) => (typeof one === "number" && typeof other === "number" ? one - other : collator.compare(String(one), String(other))),
});
// A button in each head: a first press sorts ascending, a second descending, a third restores the order.
const sortable = (heads, changed) => {
  let by = -1, down = false;
  const mark = () => heads.forEach((head, index) => {
    if (index === by) head.setAttribute("aria-sort", down ? "descending" : "ascending");
    else head.removeAttribute("aria-sort");
  });
  heads.forEach((head, index) => {
    // The link of a head is kept beside the button.
    const linked = head.querySelector("a") !== null;
    const button = element("button", { type: "button", class: "sort", "aria-label": linked ? `Sort by ${textIn(head)}` : null }, ...(linked ? [] : head.childNodes));
    if (linked) head.append(" ", button);
    else head.replaceChildren(button);
    button.addEventListener("click", () => {
      if (by !== index) [by, down] = [index, false];
      else if (!down) down = true;
      else by = -1;
      mark();
      changed();
    });
  });
  // Missing values come last in either direction.
  const apply = (rows, sortedBy) => {
    if (by < 0) return rows;
    const value = sortedBy(by);
    const pairs = rows.map((row) => ({ row, value: value(row) }));
    const there = sorter(pairs.filter((one) => known(one.value)));
    const sorted = down ? there.desc((one) => one.value) : there.asc((one) => one.value);
    return [...sorted, ...pairs.filter((one) => !known(one.value))].map((one) => one.row);
  };
  return { heads, apply };
};

// problem(words) → what is wrong with them, in a sentence; empty if nothing is.
// columns: [{head, cell(row) → text or node, number, to(row) → link to its evidence, sort(row) → sort key}];
// rows() → list of rows; search(row, word) → true if the row has it; key(row) → its name in links; source: origin of its figures.
// Tables of at most MOST_PRINTED rows are printed whole; a longer one prints its page and says which rows it has.
const paged = [];
const pagedTable = (host, { label, columns, rows, search = null, problem = null, size = PAGE_ROWS, key = null, source = "" }) => {
  let first = 0;
  let found = [];
  let printing = false;
  const body = element("tbody");
  const order = sortable(columns.map((column) => element("th", { scope: "col", title: column.title || null }, column.head)), () => { first = 0; update(); });
  const said = (column, row) => {
    const cell = column.cell(row);
    return cell instanceof Node ? textIn(cell) : cell ?? "";
  };
  const sortedBy = (index) => columns[index].sort ?? ((row) => (columns[index].number || index === 0 ? numberOf(said(columns[index], row)) : said(columns[index], row)));
  const has = search ?? ((row, word) => columns.some((column) => said(column, row).toLowerCase().includes(word)));
  const table = element("table", {}, element("thead", {}, element("tr", {}, ...order.heads)), body);
  const box = element("div", { class: "scroll", role: "region", tabindex: 0, "aria-label": label }, table);
  const told = element("output", { "aria-live": "polite" });
  const back = element("button", { type: "button" }, "Previous rows");
  const on = element("button", { type: "button" }, "Next rows");
  const wanted = element("input", { type: "search", placeholder: (problem && filterExamples().join(", ")) || "number or words", autocomplete: "off" });
  const pager = element("p", { class: "pager" });
  const finder = element("label", {}, "Find ", wanted);
  pager.append(finder, told, back, on);
  host.replaceChildren(pager, box);
  host.dispatchEvent(new CustomEvent("rgss-table", { bubbles: true }));
  if (source) host.append(element("p", { class: "small source" }, source));

  const draw = () => {
    const whole = printing && found.length <= MOST_PRINTED;
    const page = whole ? found : found.slice(first, first + size);
    body.replaceChildren(...page.map((row) => {
      const line = element("tr", key ? { "data-key": key(row) } : {});
      columns.forEach((column, index) => {
        const said = column.cell(row);
        // Only the row's head is in the tab order: it leads to the same evidence.
        const cell = column.to && typeof said === "string" && /\d/.test(said) ? element("a", { href: column.to(row), tabindex: -1, class: "quiet" }, said) : said;
        const tag = index === 0 ? "th" : "td";
        const attributes = index === 0 ? { scope: "row" } : { class: column.number ? "number" : null };
        line.append(element(tag, attributes, ...(cell === null ? [] : [cell])));
      });
      return line;
    }));
    const many = !whole && found.length > size;
    const wrong = found.length || problem === null ? "" : problem(soughtWords(wanted.value));
    told.textContent = wrong ? `0 rows; ${wrong}` : many ? `Rows ${first + 1} to ${first + page.length} of ${found.length}` : `${found.length} ${found.length === 1 ? "row" : "rows"}`;
    back.hidden = on.hidden = !many;
    back.disabled = first === 0;
    on.disabled = first + size >= found.length;
  };
  const update = () => {
    const words = soughtWords(wanted.value);
    found = rows();
    finder.hidden = !words.length && found.length < LEAST_SOUGHT;
    if (words.length) found = found.filter((row) => words.every((word) => has(row, word)));
    found = order.apply(found, sortedBy);
    first = Math.min(first, Math.max(0, Math.floor((found.length - 1) / size) * size));
    draw();
  };
  back.addEventListener("click", () => { first = Math.max(0, first - size); draw(); });
  on.addEventListener("click", () => { first += size; draw(); });
  wanted.addEventListener("input", () => { first = 0; update(); });
  paged.push((onPaper) => {
    printing = onPaper;
    if (found.length > size) draw();
  });
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
  specifications.set(id, specification);
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
// Filters of this study as examples: of a name, and of a measure with a limit, if there are such.
const filterExamples = () => {
  const texts = varying.filter(isText).slice(0, 1).map((one) => `${one.id}=${at(one.values, 0)}`);
  const limits = data.requirements.filter((one) => known(one.threshold) && measureOf.has(one.measure)).slice(0, 1).map((one) => `${one.measure}${one.comparison}${one.threshold}`);
  return [...texts, ...limits];
};
// Columns of parameters and measures of a variant, each figure with a link to its evidence.
const parameterColumns = varying.map((one) => ({ head: withUnit(one.name, one.unit), number: true, cell: (place) => show(at(one.values, place)), sort: (place) => at(one.values, place), to: (place) => figureAddress(variants.id[place], one.id) }));
const effectivenessColumns = effectiveness.map((one) => ({ head: withUnit(one.id, one.unit), title: one.name, number: true, cell: (place) => show(at(one.value, place)), sort: (place) => at(one.value, place), to: (place) => figureAddress(variants.id[place], one.id) }));
const valueColumn = { head: "value", number: true, cell: (place) => show(variants.value[place]), sort: (place) => variants.value[place], to: (place) => figureAddress(variants.id[place], "value") };
// Search terms of a variant: its role, levels such as gripper=three, and its verdicts, alone or as SYS-1=met.
const saidOf = (() => {
  const texts = new Map();
  return (place) => {
    if (!texts.has(place)) {
      const pairs = varying.flatMap((one) => [`${one.name}=${at(one.values, place)}`, `${one.id}=${at(one.values, place)}`]);
      const verdicts = data.requirements.map((one) => [one.id.toLowerCase(), at(one.verdict, place)]);
      texts.set(place, {
        text: [KINDS[kindOf[place]].name, ...pairs, ...data.requirements.map((one) => one.id)].join("\n").toLowerCase(),
        verdicts: new Set(verdicts.flatMap(([id, verdict]) => [verdict, `${id}=${verdict}`])),
      });
    }
    return texts.get(place);
  };
})();
// A whole number matches a variant's id, name=value its filter, a verdict its verdicts; other words match its search terms.
const filterMade = new Map();
const finds = (place, word) => {
  if (!filterMade.has(word)) filterMade.set(word, filterOf(word));
  const filter = filterMade.get(word);
  if (filter) return filter.holds?.(place) ?? false;
  // Parts that a comma separates are alternatives, as after --only.
  const parts = word.split(",").filter(Boolean);
  if (parts.length > 1 && parts.every((one) => filterOf(one) || /^\d+$/.test(one))) return parts.some((one) => finds(place, one));
  if (/^\d+$/.test(word)) return String(variants.id[place]) === word;
  const { text, verdicts } = saidOf(place);
  return verdicts.has(word) || (!(word in VERDICTS) && text.includes(word));
};
const variantColumns = [
  { head: "Variant", cell: (place) => variantLink(variants.id[place]), sort: (place) => variants.id[place] },
  { head: "rank", number: true, cell: (place) => show(variants.rank[place]), sort: (place) => variants.rank[place], to: (place) => figureAddress(variants.id[place], "value") },
  { head: "role", cell: (place) => element("span", { class: "stands" }, KINDS[kindOf[place]].name), sort: (place) => -kindOf[place] },
];
