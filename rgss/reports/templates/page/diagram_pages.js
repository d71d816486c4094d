// -------------- a page for each diagram, with an address of its own, to be zoomed and moved
(() => {
  const boxes = Array.from(document.querySelectorAll(".drawing"));
  if (boxes.length === 0) return;
  const figureOf = (box) => box.closest("figure");
  const element = (name, attributes = {}, text = "") => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.textContent = text;
    return made;
  };
  const dialog = element("dialog", { class: "diagram-page", "aria-labelledby": "diagram-page-title" });
  const title = element("h2", { id: "diagram-page-title" });
  const view = element("div", { class: "diagram-view", tabindex: "0", role: "group", "aria-describedby": "diagram-page-help" });
  const help = element("p", { id: "diagram-page-help", class: "small" }, "Drag, scroll or use the arrow keys to move, Ctrl and the wheel or + and − to zoom, 0 for the whole, 1 for full size, Page Up and Page Down for the other diagrams, Escape to close.");
  const told = element("output", { "aria-live": "polite" });
  const bar = element("div", { class: "diagram-bar", role: "toolbar", "aria-label": "Diagram" });
  let shown = null, before = null, scale = 1, x = 0, y = 0;

  const drawingIn = () => view.querySelector("svg");
  const size = () => ({ width: drawingIn().viewBox.baseVal.width, height: drawingIn().viewBox.baseVal.height });
  const draw = () => {
    drawingIn().style.transform = `translate(${x}px, ${y}px) scale(${scale})`;
    told.textContent = `${Math.round(100 * scale)} %`;
  };
  const fit = () => {
    const { width, height } = size();
    scale = Math.min(view.clientWidth / width, view.clientHeight / height, 2);
    x = (view.clientWidth - scale * width) / 2;
    y = (view.clientHeight - scale * height) / 2;
    draw();
  };
  // Texts are 12 px high at full size. A drawing that is whole in sight only below it is opened at its beginning, as
  // wide as the page if it can be.
  const FULL = 1, WIDEST = 1.25;
  const begin = () => {
    fit();
    if (scale >= FULL) return;
    const { width } = size();
    scale = Math.max(FULL, Math.min(view.clientWidth / width, WIDEST));
    x = Math.max(0, (view.clientWidth - scale * width) / 2);
    y = 0;
    draw();
  };
  // Scrolls as far as there is a part of the drawing out of sight.
  const scroll = (across, down) => {
    const { width, height } = size();
    const within = (at, by, seen, whole) => (whole <= seen ? at : Math.min(Math.max(at - by, Math.min(at, seen - whole)), Math.max(at, 0)));
    x = within(x, across, view.clientWidth, scale * width);
    y = within(y, down, view.clientHeight, scale * height);
    draw();
  };
  // The point of the drawing below (u, v) stays there.
  const zoom = (factor, u = view.clientWidth / 2, v = view.clientHeight / 2) => {
    const wanted = Math.min(8, Math.max(0.05, scale * factor));
    x = u - (u - x) * wanted / scale;
    y = v - (v - y) * wanted / scale;
    scale = wanted;
    draw();
  };
  const fullSize = () => zoom(1 / scale);
  const move = (across, down) => { x += across; y += down; draw(); };

  const putBack = () => {
    if (shown === null) return;
    drawingIn().style.transform = "";
    shown.append(drawingIn());
    shown = null;
  };
  const addressOf = (box) => `#page-${figureOf(box).id}`;
  const wanted = () => boxes.find((box) => addressOf(box) === location.hash.split("?")[0]);
  const follow = () => {
    const box = wanted();
    if (box === undefined) { if (dialog.open) dialog.close(); return; }
    if (box === shown) return;
    if (!dialog.open) before = document.activeElement;
    putBack();
    shown = box;
    title.textContent = figureOf(box).querySelector("h3").textContent;
    view.setAttribute("aria-label", title.textContent);
    view.replaceChildren(box.querySelector("svg"));
    if (!dialog.open) dialog.showModal();
    view.focus();
    begin();
  };
  const go = (box) => {
    const address = location.href.split("#")[0] + addressOf(box);
    // From one page to the next the way back leads to where the reader came from.
    if (dialog.open) history.replaceState(history.state, "", address);
    else history.pushState(null, "", address);
    follow();
  };
  const step = (by) => go(boxes[(boxes.indexOf(shown) + by + boxes.length) % boxes.length]);
  const buttons = { "Zoom in": () => zoom(1.25), "Zoom out": () => zoom(0.8), "Fit": fit, "Full size": fullSize, "Previous": () => step(-1), "Next": () => step(1), "Close": () => dialog.close() };
  for (const [name, act] of Object.entries(buttons)) {
    const button = element("button", { type: "button" }, name);
    button.addEventListener("click", act);
    bar.append(button);
  }
  bar.append(told);
  dialog.append(title, bar, view, help);
  document.body.append(dialog);

  dialog.addEventListener("close", () => {
    const figure = shown === null ? null : figureOf(shown);
    putBack();
    if (figure !== null && location.hash.startsWith("#page-")) history.replaceState(history.state, "", `${location.href.split("#")[0]}#${figure.id}`);
    if (before !== null && before.isConnected) before.focus();
    before = null;
  });
  const keys = { "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), "0": fit, "1": fullSize, ArrowLeft: () => move(60, 0), ArrowRight: () => move(-60, 0), ArrowUp: () => move(0, 60), ArrowDown: () => move(0, -60), PageUp: () => step(-1), PageDown: () => step(1) };
  dialog.addEventListener("keydown", (event) => {
    const act = keys[event.key];
    if (act === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  });
  // From a place of the window to one within the border of the view.
  const inside = (u, v) => {
    const box = view.getBoundingClientRect();
    return [u - box.left - view.clientLeft, v - box.top - view.clientTop];
  };
  view.addEventListener("wheel", (event) => {
    event.preventDefault();
    const line = event.deltaMode === 0 ? 1 : 33;
    // Two fingers on a touchpad that spread are a wheel with Ctrl.
    if (event.ctrlKey || event.metaKey) zoom(Math.exp(-event.deltaY * line / 400), ...inside(event.clientX, event.clientY));
    else if (event.shiftKey) scroll(line * event.deltaY, 0);
    else scroll(line * event.deltaX, line * event.deltaY);
  }, { passive: false });
  const fingers = new Map();
  view.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    fingers.set(event.pointerId, event);
    view.setPointerCapture(event.pointerId);
  });
  view.addEventListener("pointermove", (event) => {
    const last = fingers.get(event.pointerId);
    if (last === undefined) return;
    const other = Array.from(fingers.values()).find((one) => one.pointerId !== event.pointerId);
    fingers.set(event.pointerId, event);
    if (other === undefined) { move(event.clientX - last.clientX, event.clientY - last.clientY); return; }
    const apart = (one) => Math.max(1, Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY));
    zoom(apart(event) / apart(last), ...inside((event.clientX + other.clientX) / 2, (event.clientY + other.clientY) / 2));
  });
  for (const end of ["pointerup", "pointercancel"]) view.addEventListener(end, (event) => fingers.delete(event.pointerId));
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[data-page-of]");
    if (link === null || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    go(document.getElementById(link.dataset.pageOf).querySelector(".drawing"));
  });
  addEventListener("hashchange", follow);
  addEventListener("popstate", follow);
  addEventListener("resize", () => { if (dialog.open) begin(); });
  addEventListener("beforeprint", () => { if (dialog.open) dialog.close(); });
  follow();
})();
