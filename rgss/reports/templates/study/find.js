// ------------------------------------------ contents, full-text search, sorted tables
const MOST_FOUND = 8, LEAST_SORTED = 6;

const startContents = () => {
  const menu = byId("contents"), list = menu.querySelector("ul");
  const links = Array.from(menu.querySelectorAll("a"));
  const sections = links.map((link) => byId(link.hash.slice(1))).filter(Boolean);
  const wide = matchMedia("(min-width: 75rem)");
  const fit = () => { menu.open = wide.matches; };
  wide.addEventListener("change", fit);
  fit();
  menu.addEventListener("click", (event) => { if (event.target.closest("a") && !wide.matches) menu.open = false; });
  // The section at a fifth of the window's height is marked as current.
  const inSight = new Set();
  const watcher = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) inSight[isIntersecting ? "add" : "delete"](target);
    const now = sections.filter((section) => inSight.has(section)).pop();
    if (!now) return;
    for (const link of links) {
      if (link.hash.slice(1) === now.id) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
    // Only the list is scrolled, never the page.
    const link = menu.querySelector("[aria-current]");
    if (link && wide.matches) list.scrollTop = link.offsetTop - list.clientHeight / 2;
  }, { rootMargin: "-20% 0px -75% 0px" });
  for (const section of sections) watcher.observe(section);
};

// The target of a link is shown, also within folded sections.
const unfold = (target) => {
  for (let details = target.closest("details"); details; details = details.parentElement.closest("details")) details.open = true;
};
const startUnfolding = () => {
  const follow = () => {
    const target = byId(named(addressNow().anchor));
    if (target === null) return;
    unfold(target);
    // Unfolding and drawing move the rest of the page, after which it scrolls to the target again.
    const seek = () => {
      const { top, bottom } = target.getBoundingClientRect();
      if (bottom < 0 || top > innerHeight * 0.7) target.scrollIntoView();
    };
    requestAnimationFrame(() => requestAnimationFrame(seek));
    setTimeout(seek, 400);
  };
  addEventListener("hashchange", follow);
  addEventListener("click", (event) => {
    const link = event.target.closest?.('a[href^="#"]');
    if (link && link.hash === `#${addressNow().anchor}`) follow();
  });
  follow();
};

// Tables of the template, which no script wrote, get the same sorting.
const startSorting = () => {
  for (const table of document.querySelectorAll("main table:not(.matrix)")) {
    const body = table.tBodies[0];
    if (table.querySelector("button.sort") || !table.tHead || body.rows.length < LEAST_SORTED || body.querySelector("[colspan]")) continue;
    const before = Array.from(body.rows);
    const order = sortable(Array.from(table.tHead.rows[0].cells), () => {
      body.append(...order.apply(before, (index) => (row) => numberOf(row.cells[index].textContent.trim())));
    });
  }
};

// ------------------------------------------------------- full-text search
// A word with punctuation is found as a whole and by its parts, a number only as a whole; a verdict of two words is one word.
const SIGNS = /[^\p{L}\p{N}_.=-]+/u;
const wholeWords = (text) => wordsOf(text).join(" ").split(SIGNS).map((word) => word.replace(/^[.=-]+|[.=-]+$/g, "")).filter(Boolean);
const withParts = (text) => wholeWords(text).flatMap((word) => (word in VERDICTS || /^[\d.]+$/.test(word) ? [word] : [word, ...word.split(/[_.=-]/).filter((part) => part && part !== word)]));

const everything = () => {
  const found = [];
  const add = (kind, title, text, to) => found.push({ id: found.length, kind, title, text, to });
  const place = placeOf.get(data.decision.chosen ?? variants.id[0]) ?? 0;
  for (const head of document.querySelectorAll("main :is(h2, h3)")) {
    const section = head.id || head.closest("section, figure")?.id;
    if (section && !head.closest("#variant-evidence, [hidden]")) add("Sections", textIn(head), "", `#${section}`);
  }
  for (const one of data.requirements) {
    const verdict = VERDICTS[at(one.verdict, place)][1];
    add("Requirements", `${one.id}: ${verdict} by variant ${variants.id[place]}`, `${one.text} ${one.criterion} ${one.measure}`, `#r-${one.id}`);
  }
  for (const one of data.measures) add("Measures", `${one.id}: ${one.name}`, one.unit, figureAddress(variants.id[place], one.id));
  for (const one of data.parameters) add("Parameters", `${one.id}: ${one.name}`, `${one.description} ${Array.isArray(one.values) ? [...new Set(one.values)].slice(0, 50).join(" ") : one.values}`, figureAddress(variants.id[place], one.id));
  const failures = new Set();
  data.trials.variant.forEach((of, trial) => {
    const outcome = outcomeOf(trial);
    if (outcome === "success" || failures.has(outcome)) return;
    failures.add(outcome);
    add("Failures", outcome, `first in variant ${variants.id[of]}, seed ${data.trials.seed[trial]}`, figureAddress(variants.id[of], data.trials.key[trial]));
  });
  document.querySelectorAll("main table:not(.matrix) tbody > tr").forEach((row, index) => {
    const host = row.closest("[id$=-table], #variant-evidence");
    const head = row.querySelector("th");
    if (host || head === null) return;
    if (!row.id) row.id = `row-${index}`;
    if (found.some((one) => one.to === `#${row.id}`)) return;
    add("Rows of tables", textIn(head.querySelector(".id") ?? head), `${row.closest("section")?.querySelector("h2")?.textContent ?? ""}: ${textIn(row)}`, `#${row.id}`);
  });
  for (const figure of document.querySelectorAll("main figure[id]")) add("Diagrams", figure.querySelector("h3")?.textContent ?? figure.id, Array.from(figure.querySelector("figcaption").childNodes).filter((one) => !one.matches?.("h3, button, .as-page")).map(textIn).join(" ").trim(), `#${figure.id}`);
  return found;
};

// How well a title fits: 0 if it, its id or its name is what is sought, 1 if it has all words, 2 if only the text beside it does.
const fitOf = (title, text) => {
  const plain = title.trim().toLowerCase(), sought = text.trim().toLowerCase();
  if ([plain, ...plain.split(": ")].includes(sought)) return 0;
  const words = wholeWords(title);
  return wholeWords(text).every((word) => words.includes(word)) ? 1 : 2;
};
// Of equal fit, what a reader names comes before rows and pictures that mention it.
const KIND_ORDER = ["Variants", "Requirements", "Measures", "Parameters", "Failures", "Sections", "Rows of tables", "Diagrams"];

const startFind = () => {
  const field = byId("find"), box = byId("found"), told = byId("found-count");
  let index = null, entries = [];
  const make = () => {
    if (index !== null) return;
    entries = everything().map((one) => ({ ...one, all: `${one.title} ${one.text}`.toLowerCase() }));
    index = new FindAndSort.MiniSearch({ fields: ["title", "text"], storeFields: ["kind", "title", "text", "to"], tokenize: withParts, searchOptions: { tokenize: wholeWords, combineWith: "AND", boost: { title: 3 } } });
    index.addAll(entries);
  };
  // The first kind of match that there is: whole words, beginnings, parts (of words, or of a script without spaces), similar words.
  const sought = (text, onlyWhole) => {
    const words = wordsOf(text);
    const ways = onlyWhole ? [() => index.search(text)] : [
      () => index.search(text),
      () => index.search(text, { prefix: true }),
      () => entries.filter((one) => words.every((word) => !(word in VERDICTS) && one.all.includes(word))),
      () => index.search(text, { prefix: true, fuzzy: (word) => (word.length > 4 ? 0.25 : false) }),
    ];
    for (const way of ways) {
      const found = way();
      if (found.length) return found;
    }
    return [];
  };
  const brief = (text) => (text.length > 140 ? `${text.slice(0, 139)}…` : text);
  const close = () => { box.hidden = true; told.textContent = ""; };
  const list = (kind, entries, more) => element("div", {}, element("h3", {}, kind), element("ul", {},
    ...entries.slice(0, MOST_FOUND).map(({ title, text, to }) => element("li", {}, element("a", { href: to }, title), element("span", { class: "small" }, ` ${brief(text)}`))),
    ...(more > 0 ? [element("li", { class: "small" }, `and ${more} more`)] : [])));
  const look = () => {
    const words = soughtWords(field.value);
    if (!words.length) { close(); return; }
    make();
    const number = /^\s*(?:variant\s+)?(\d+)\s*$/i.exec(field.value);
    const named = number ? placeOf.get(Number(number[1])) : undefined;
    const groups = new Map();
    const fits = new Map();
    const ranked = sought(field.value, named !== undefined).map((one) => ({ ...one, fit: fitOf(one.title, field.value) }));
    for (const one of ranked.sort((left, right) => left.fit - right.fit)) {
      if (!groups.has(one.kind)) { groups.set(one.kind, []); fits.set(one.kind, one.fit); }
      groups.get(one.kind).push(one);
    }
    const those = named !== undefined ? [named] : variants.id.map((_, place) => place).filter((place) => words.every((word) => finds(place, word)));
    if (those.length) {
      fits.set("Variants", named === undefined ? 3 : -1);
      const listed = those.slice(0, MOST_FOUND).map((place) => ({ title: `Variant ${variants.id[place]}`, text: `${KINDS[kindOf[place]].name}; ${varying.map((one) => `${one.name} ${show(at(one.values, place), one.unit)}`).join(", ")}`, to: `#variant-${variants.id[place]}` }));
      groups.set("Variants", Object.assign(listed, { count: those.length }));
    }
    let count = 0;
    const inOrder = Array.from(groups).sort(([one], [other]) => fits.get(one) - fits.get(other) || KIND_ORDER.indexOf(one) - KIND_ORDER.indexOf(other));
    box.replaceChildren(...inOrder.map(([kind, entries]) => {
      const all = entries.count ?? entries.length;
      count += all;
      return list(kind, entries, all - MOST_FOUND);
    }));
    const wrong = filterProblem(words);
    told.textContent = `${count || "Nothing"} found${wrong ? `; ${wrong}` : ""}`;
    box.hidden = count === 0;
  };
  let waiting = 0;
  field.addEventListener("input", () => { clearTimeout(waiting); waiting = setTimeout(look, 120); });
  field.addEventListener("focus", () => { if (field.value && box.hidden) look(); });
  field.form.addEventListener("submit", (event) => event.preventDefault());
  const step = (event) => {
    const links = Array.from(box.querySelectorAll("a"));
    const place = links.indexOf(document.activeElement);
    if (event.key === "Escape") { field.focus(); close(); return; }
    if (box.hidden || (event.key !== "ArrowDown" && event.key !== "ArrowUp")) return;
    event.preventDefault();
    const next = place + (event.key === "ArrowDown" ? 1 : -1);
    if (next < 0) field.focus();
    else links[Math.min(next, links.length - 1)].focus();
  };
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter") { clearTimeout(waiting); look(); box.querySelector("a")?.click(); } else step(event);
  });
  box.addEventListener("keydown", step);
  box.addEventListener("click", (event) => { if (event.target.closest("a")) close(); });
  addEventListener("pointerdown", (event) => { if (!event.target.closest("#filter-bar")) close(); });
  addEventListener("keydown", (event) => {
    if (event.key !== "/" || event.ctrlKey || event.metaKey || event.target.closest("input, select, textarea")) return;
    event.preventDefault();
    field.focus();
  });
};
