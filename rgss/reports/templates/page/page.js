"use strict";
(() => {
  const root = document.documentElement;
  root.classList.remove("no-js");
  const all = (selector, within = document) => Array.from(within.querySelectorAll(selector));

  // ------------------------------------------------------------------ filter
  const search = document.getElementById("search");
  const gapsOnly = document.getElementById("gaps-only");
  const count = document.getElementById("count");
  const rows = all("[data-row]");
  const texts = new Map(rows.map((row) => [row, row.textContent.toLowerCase()]));
  const filter = () => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const gaps = gapsOnly !== null && gapsOnly.checked;
    let shown = 0;
    for (const row of rows) {
      const wanted = words.every((word) => texts.get(row).includes(word));
      row.hidden = !wanted || (gaps && row.dataset.row !== "gap");
      shown += row.hidden ? 0 : 1;
    }
    const filtered = words.length > 0 || gaps;
    // Matching rows are shown, also within folded sections.
    if (filtered) for (const fold of all("details.fold:not([open])")) fold.open = all("[data-row]", fold).some((row) => !row.hidden);
    count.textContent = filtered ? `${shown} of ${rows.length} rows and diagrams` : "";
    for (const none of all("[data-none]")) {
      const mine = all("[data-row]", none.closest("section"));
      none.hidden = !filtered || mine.some((row) => !row.hidden);
    }
  };
  if (search !== null) {
    let waiting = 0;
    search.form.addEventListener("submit", (event) => event.preventDefault());
    search.addEventListener("input", () => {
      clearTimeout(waiting);
      waiting = setTimeout(filter, 120);
    });
    search.addEventListener("keydown", (event) => {
      if (event.key === "Escape") {
        search.value = "";
        filter();
      }
    });
    if (gapsOnly !== null) gapsOnly.addEventListener("change", filter);
    // A link to a row that the filter hides shows it again.
    const reveal = () => {
      let name = "";
      try { name = decodeURIComponent(location.hash.slice(1)); } catch { /* an invalid fragment */ }
      const target = document.getElementById(name);
      const row = target && target.closest("[data-row]");
      if (row && row.hidden) {
        search.value = "";
        if (gapsOnly !== null) gapsOnly.checked = false;
        filter();
        target.scrollIntoView();
      }
    };
    addEventListener("hashchange", reveal);
    filter();
  }

  // ------------------------- scroll targets must not end below sticky heads
  const makeRoom = () => {
    // All sizes are read before any is changed, so that the page is laid out once.
    const rooms = all(".scroll").map((box) => {
      const table = box.querySelector("table");
      const first = table.classList.contains("matrix") ? table.tBodies[0].querySelector("th") : null;
      return [box, table.tHead.offsetHeight, first === null ? 0 : first.offsetWidth];
    });
    for (const [box, above, before] of rooms) {
      box.style.scrollPaddingTop = `${above}px`;
      box.style.scrollPaddingLeft = `${before}px`;
    }
  };
  setTimeout(makeRoom);
  addEventListener("resize", makeRoom);
  document.addEventListener("toggle", (event) => { if (event.target.matches(".fold")) makeRoom(); }, true);

  // ------------- a table that is higher than its box ends with a whole row, and says that it goes on
  const waitingBoxes = new Set();
  const endWithWholeRows = () => {
    const boxes = Array.from(waitingBoxes, (box) => ({ box, table: box.querySelector("table") })).filter(({ table }) => table !== null);
    waitingBoxes.clear();
    for (const { box } of boxes) {
      box.style.removeProperty("--whole");
      box.removeAttribute("data-more");
    }
    // Styles are written between the sizes that are read, so that the page is laid out twice at the most.
    for (const one of boxes) one.most = parseFloat(getComputedStyle(one.box).maxHeight);
    const cut = boxes.filter(({ box, table, most }) => table.offsetHeight > most - (box.offsetHeight - box.clientHeight) + 1 && getComputedStyle(table).display === "table");
    for (const { box, table } of cut) box.dataset.more = `${table.tBodies[0].rows.length} rows here: scroll to see them`;
    for (const one of cut) {
      const { box, table, most } = one, top = table.getBoundingClientRect().top;
      const besides = box.offsetHeight - box.clientHeight + parseFloat(getComputedStyle(box, "::after").height);
      const ends = Array.from(table.tBodies[0].rows, (row) => row.getBoundingClientRect().bottom - top);
      const last = ends.filter((end) => end <= most - besides).pop();
      if (last !== undefined) one.whole = last + besides;
    }
    for (const { box, whole } of cut) if (whole !== undefined) box.style.setProperty("--whole", `${whole}px`);
  };
  const fitRows = (boxes) => {
    if (!waitingBoxes.size) requestAnimationFrame(endWithWholeRows);
    for (const box of boxes) waitingBoxes.add(box);
  };
  const sizes = new ResizeObserver((entries) => fitRows(entries.map(({ target }) => target.closest(".scroll"))));
  const observeTables = (within) => { for (const table of all(".scroll > table", within)) sizes.observe(table); };
  observeTables(document);
  // A script that adds a table reports it.
  document.addEventListener("rgss-table", (event) => observeTables(event.target));
  addEventListener("resize", () => fitRows(all(".scroll")));

  // -------------------------------------------------- cells by the arrow keys
  for (const table of all("table.matrix")) {
    const told = document.getElementById(table.dataset.told);
    const heads = all("thead th", table);
    const body = table.tBodies[0];
    let marked = [];
    const tell = (cell) => {
      const row = cell.parentElement;
      const head = heads[cell.cellIndex];
      for (const one of marked) one.classList.remove("cross");
      marked = [head, row.cells[0], cell];
      for (const one of marked) one.classList.add("cross");
      const relation = cell.classList.contains("y") ? table.dataset.relation : `has no link to`;
      told.textContent = `${row.dataset.id} ${relation} ${head.title}`;
    };
    const visible = () => Array.from(body.rows).filter((row) => !row.hidden);
    const go = (cell) => {
      if (!cell || cell.tagName !== "TD") return;
      const before = table.querySelector('td[tabindex="0"]');
      if (before) before.tabIndex = -1;
      cell.tabIndex = 0;
      cell.focus();
      cell.scrollIntoView({ block: "nearest", inline: "nearest" });
    };
    const first = body.querySelector("td");
    if (first) first.tabIndex = 0;
    table.addEventListener("focusin", (event) => {
      if (event.target.tagName === "TD") tell(event.target);
    });
    table.addEventListener("mouseover", (event) => {
      const cell = event.target.closest("td");
      if (cell && table.contains(cell)) tell(cell);
    });
    table.addEventListener("click", (event) => {
      if (!event.target.closest("a")) go(event.target.closest("td"));
    });
    table.addEventListener("keydown", (event) => {
      const cell = event.target;
      if (cell.tagName !== "TD" || event.altKey || event.ctrlKey || event.metaKey) return;
      const there = visible();
      const at = there.indexOf(cell.parentElement);
      const column = cell.cellIndex;
      const last = heads.length - 1;
      const within = (index) => there[Math.max(0, Math.min(there.length - 1, index))];
      const moves = {
        ArrowRight: () => cell.parentElement.cells[Math.min(column + 1, last)],
        ArrowLeft: () => cell.parentElement.cells[Math.max(column - 1, 1)],
        ArrowDown: () => within(at + 1).cells[column],
        ArrowUp: () => within(at - 1).cells[column],
        Home: () => cell.parentElement.cells[1],
        End: () => cell.parentElement.cells[last],
        PageDown: () => within(at + 10).cells[column],
        PageUp: () => within(at - 10).cells[column],
      };
      if (event.key in moves) {
        event.preventDefault();
        go(moves[event.key]());
      }
    });
  }

  // ---------------------------------------------------------------- diagrams
  for (const button of all("button[data-fit]")) {
    const drawing = document.getElementById(button.dataset.fit);
    const say = () => {
      const fits = drawing.classList.contains("fit");
      button.textContent = fits ? "Show at full size" : "Fit to the page";
      button.setAttribute("aria-pressed", String(fits));
    };
    button.addEventListener("click", () => {
      drawing.classList.toggle("fit");
      say();
    });
    say();
  }

  // ------------------------------------------------------------------- print
  let opened = [];
  addEventListener("beforeprint", () => {
    // What is printed on demand alone stays as the reader left it.
    opened = all("details:not([open]):not(.on-demand)");
    for (const one of opened) one.open = true;
  });
  addEventListener("afterprint", () => {
    for (const one of opened) one.open = false;
  });
})();
