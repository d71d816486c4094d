// --------------------------------------------- parallel coordinates, drawn on a canvas
const DENSE = 600;
const BINS = 48;
const TOP = 62, BOTTOM = 46, HEIGHT = 420, SIDE = 64, AWAY = 9, LEAST_STEP = 90, MOST_STEP = 160;

// Multiples of 1, 2, 2.5 or 5 times a power of ten within the ends, some four to seven of them.
const roundTicks = (low, high) => {
  const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 2.5, 5, 10].find((factor) => factor * power >= rough * 0.999);
  const found = [];
  for (let count = Math.ceil(low / step - 1e-9); count * step <= high + 1e-9 * step; count += 1) found.push(Number((count * step).toPrecision(12)));
  return found;
};

const axes = (() => {
  const made = [];
  const seen = new Set();
  for (const parameter of varying) {
    if (parameter.factor !== null && seen.has(parameter.factor)) continue;
    seen.add(parameter.factor);
    made.push({ id: parameter.id, title: parameter.name, unit: parameter.unit, column: parameter.values, better: "" });
  }
  for (const measure of effectiveness) {
    made.push({ id: measure.id, title: measure.id, unit: measure.unit, column: measure.value, better: { higher: "↑ better", lower: "↓ better" }[measure.better] ?? "" });
  }
  made.push({ id: "value", title: "value", unit: "1", column: variants.value, better: "↑ better" });
  for (const axis of made) {
    const values = variants.id.map((_, place) => at(axis.column, place));
    const there = values.filter(known);
    const named = there.some((value) => typeof value !== "number");
    if (named) {
      axis.levels = Array.from(new Set(there.map(String)));
      const last = Math.max(1, axis.levels.length - 1);
      const index = new Map(axis.levels.map((level, place) => [level, place / last]));
      axis.position = Float64Array.from(values, (value) => (known(value) ? index.get(String(value)) : NaN));
      axis.ticks = axis.levels.slice(0, 24).map((level) => [index.get(level), level]);
      axis.tell = (share) => axis.levels[Math.round(share * last)] ?? "";
      axis.write = (share, side) => axis.levels[side < 0 ? Math.ceil(share * last - 1e-9) : Math.floor(share * last + 1e-9)] ?? "";
      axis.read = (text) => index.get(text) ?? NaN;
    } else {
      let low = Infinity, high = -Infinity;
      for (const value of there) { if (value < low) low = value; if (value > high) high = value; }
      if (!there.length) { low = 0; high = 1; }
      const span = high - low || 1;
      axis.position = Float64Array.from(values, (value) => (known(value) ? (high === low ? 0.5 : (value - low) / span) : NaN));
      const different = Array.from(new Set(there)).sort((one, other) => one - other);
      const apart = different.every((value, index) => index === 0 || (value - different[index - 1]) / span > 0.05);
      const few = different.length <= 8 && apart ? different : roundTicks(low, high);
      axis.ticks = high === low ? [[0.5, show(low)]] : few.map((value) => [(value - low) / span, show(value)]);
      // With all digits: a rounded end may lie within the axis, and leave out the variant there.
      axis.write = (share) => String(high === low ? low : low + share * span);
      axis.read = (text) => {
        if (text === "") return NaN;
        if (high === low) return Number(text) === low ? 0.5 : NaN;
        return Math.min(1, Math.max(0, (Number(text) - low) / span));
      };
      axis.tell = (share) => show(high === low ? low : low + share * span, axis.unit);
    }
  }
  return made;
})();

const parallel = (() => {
  const host = byId("parallel");
  // The axes fill the width of the page, with a least distance that keeps them legible.
  const gaps = Math.max(1, axes.length - 1);
  const STEP = Math.min(MOST_STEP, Math.max(LEAST_STEP, Math.floor((host.clientWidth - 2 * SIDE) / gaps)));
  const width = 2 * SIDE + STEP * (axes.length - 1);
  const canvas = element("canvas", { role: "img", "aria-label": "Parallel coordinates of all variants; the table below has the figures" });
  canvas.dataset.step = String(STEP);
  host.append(canvas);
  const x = (index) => SIDE + STEP * index;
  const y = (share) => HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM);
  const yUnknown = HEIGHT - BOTTOM + 22;
  const heightAt = (axis, place) => (Number.isNaN(axis.position[place]) ? yUnknown : y(axis.position[place]));

  // Dashes start at each axis, so that coinciding lines stay dashed.
  const line = (pen, place) => {
    pen.beginPath();
    for (let index = 0; index + 1 < axes.length; index += 1) {
      pen.moveTo(x(index), heightAt(axes[index], place));
      pen.lineTo(x(index + 1), heightAt(axes[index + 1], place));
    }
    pen.stroke();
  };
  // With many variants, the number of lines between two positions is drawn, not each line.
  const density = (pen, places) => {
    for (let index = 0; index + 1 < axes.length; index += 1) {
      const counts = new Map();
      for (const place of places) {
        const bin = (axis) => (Number.isNaN(axis.position[place]) ? BINS : Math.min(BINS - 1, Math.floor(axis.position[place] * BINS)));
        const key = bin(axes[index]) * (BINS + 1) + bin(axes[index + 1]);
        counts.set(key, (counts.get(key) || 0) + 1);
      }
      const most = Math.max(1, ...counts.values());
      const middle = (bin) => (bin === BINS ? yUnknown : y((bin + 0.5) / BINS));
      for (const [key, found] of counts) {
        pen.globalAlpha = 0.06 + 0.74 * (Math.log1p(found) / Math.log1p(most));
        pen.beginPath();
        pen.moveTo(x(index), middle(Math.floor(key / (BINS + 1))));
        pen.lineTo(x(index + 1), middle(key % (BINS + 1)));
        pen.stroke();
      }
    }
    pen.globalAlpha = 1;
  };

  const draw = () => {
    const scale = Math.min(3, devicePixelRatio || 1);
    canvas.width = width * scale;
    canvas.height = HEIGHT * scale;
    canvas.style.width = `${width}px`;
    canvas.style.height = `${HEIGHT}px`;
    paint(canvas.getContext("2d"), scale);
  };
  const paint = (pen, scale) => {
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue("--ink"), muted = style.getPropertyValue("--muted"), paper = style.getPropertyValue("--paper");
    pen.scale(scale, scale);
    pen.fillStyle = paper;
    pen.fillRect(0, 0, width, HEIGHT);
    const groups = [[], [], [], []];
    for (const place of shownPlaces) groups[kindOf[place]].push(place);
    canvas.dataset.drawn = groups.map((group) => group.length > DENSE ? "density" : String(group.length)).join(" ");
    groups.forEach((places, kind) => {
      const look = KINDS[kind];
      pen.strokeStyle = look.colour;
      pen.lineWidth = look.width;
      pen.setLineDash(look.dash);
      if (places.length > DENSE) density(pen, places);
      else {
        pen.globalAlpha = kind >= FRONT ? 1 : Math.max(0.25, Math.min(0.8, 60 / Math.max(1, places.length)));
        for (const place of places) line(pen, place);
        pen.globalAlpha = 1;
      }
    });
    pen.setLineDash([]);
    pen.textAlign = "center";
    axes.forEach((axis, index) => {
      pen.strokeStyle = ink;
      pen.lineWidth = 1;
      pen.beginPath();
      pen.moveTo(x(index), y(0));
      pen.lineTo(x(index), y(1));
      pen.stroke();
      pen.fillStyle = ink;
      pen.font = "600 12px system-ui, sans-serif";
      titleLines(axis.title).forEach((text, row, lines) => pen.fillText(text, x(index), TOP - 28 - 14 * (lines.length - 1 - row), STEP - 6));
      pen.font = "12px system-ui, sans-serif";
      pen.fillStyle = muted;
      const under = [axis.unit && axis.unit !== "1" ? `[${axis.unit}]` : "", axis.better].filter(Boolean).join("  ");
      if (under) pen.fillText(under, x(index), TOP - 13, STEP - 12);
      for (const [share, text] of axis.ticks) {
        const shown = fitting(pen, text);
        pen.lineWidth = 1;
        pen.strokeStyle = ink;
        pen.beginPath();
        pen.moveTo(x(index) - 4, y(share));
        pen.lineTo(x(index), y(share));
        pen.stroke();
        // A line that runs through a number, or ends at its first digit as a minus sign, would make it another one.
        const room = pen.measureText(shown).width + 2 + AWAY;
        pen.fillStyle = paper;
        pen.fillRect(x(index) - 5 - room, y(share) - 7.5, room, 15);
        pen.textAlign = "right";
        pen.fillStyle = ink;
        pen.fillText(shown, x(index) - 7, y(share) + 4);
      }
      pen.textAlign = "center";
      if (axis.position.some(Number.isNaN)) {
        pen.fillStyle = muted;
        pen.fillText("unknown", x(index), yUnknown + 14);
      }
      const brush = brushes.get(axis.id);
      if (brush) {
        pen.strokeStyle = ink;
        pen.lineWidth = 2;
        pen.fillStyle = "rgba(230, 159, 0, 0.35)";
        pen.fillRect(x(index) - 9, y(brush.high), 18, y(brush.low) - y(brush.high));
        pen.strokeRect(x(index) - 9, y(brush.high), 18, y(brush.low) - y(brush.high));
      }
    });
  };
  // A label is cut where it would reach the axis before its own.
  const fitting = (pen, text) => {
    let shown = text;
    for (let kept = text.length - 1; kept > 0 && pen.measureText(shown).width > STEP - 12 - AWAY; kept -= 1) shown = `${text.slice(0, kept)}…`;
    return shown;
  };
  const titleLines = (title) => {
    if (title.length <= 15 || !title.includes(" ")) return [title];
    const words = title.split(" ");
    let best = 1;
    const longest = (cut) => Math.max(words.slice(0, cut).join(" ").length, words.slice(cut).join(" ").length);
    for (let cut = 2; cut < words.length; cut += 1) if (longest(cut) < longest(best)) best = cut;
    return [words.slice(0, best).join(" "), words.slice(best).join(" ")];
  };

  // ------------------------------------------------------- brushing by hand
  const share = (event) => {
    const box = canvas.getBoundingClientRect();
    return Math.min(1, Math.max(0, (HEIGHT - BOTTOM - (event.clientY - box.top)) / (HEIGHT - TOP - BOTTOM)));
  };
  let dragged = null;
  canvas.addEventListener("pointerdown", (event) => {
    const index = Math.round((event.clientX - canvas.getBoundingClientRect().left - SIDE) / STEP);
    if (index < 0 || index >= axes.length) return;
    if (Math.abs(event.clientX - canvas.getBoundingClientRect().left - x(index)) > 24) return;
    dragged = { axis: axes[index], start: share(event), moved: false };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (dragged === null) return;
    const end = share(event);
    if (Math.abs(end - dragged.start) < 0.015 && !dragged.moved) return;
    dragged.moved = true;
    setBrush(dragged.axis, Math.min(end, dragged.start), Math.max(end, dragged.start));
  });
  canvas.addEventListener("pointerup", () => {
    if (dragged !== null && !dragged.moved) setBrush(dragged.axis, 0, 1);
    dragged = null;
  });
  downloadsFor(host, "parallel", { csv: true, svg: async () => {
    const pen = svgPen(width, HEIGHT);
    paint(pen, 1);
    return [svgAddress(pen.text()), width, HEIGHT];
  } });
  return { draw };
})();

const setBrush = (axis, low, high) => {
  if (low <= 0 && high >= 1) brushes.delete(axis.id);
  else brushes.set(axis.id, { axis, low, high });
  for (const tell of axisControls) tell();
  applyBrushes();
};

// --------------------------------------------------- brushing by the keyboard
const axisControls = axes.map((axis) => {
  const ends = ["from", "to"].map((name) => {
    const slider = element("input", { type: "range", min: 0, max: 1000, step: axis.levels ? 1000 / Math.max(1, axis.levels.length - 1) : 1, "aria-label": `${axis.title} ${name}` });
    const told = element("output");
    return { slider, told, name };
  });
  const tell = () => {
    const brush = brushes.get(axis.id);
    ends.forEach(({ slider, told, name }, index) => {
      const end = brush ? (index === 0 ? brush.low : brush.high) : index;
      slider.value = String(1000 * end);
      told.textContent = `${name} ${axis.tell(end)}`;
      slider.setAttribute("aria-valuetext", axis.tell(end));
    });
  };
  for (const { slider } of ends) {
    slider.addEventListener("input", () => {
      const [low, high] = ends.map((one) => Number(one.slider.value) / 1000);
      setBrush(axis, Math.min(low, high), Math.max(low, high));
    });
  }
  byId("axis-controls").append(element("fieldset", {}, element("legend", {}, withUnit(axis.title, axis.unit)),
    ...ends.flatMap(({ slider, told }) => [element("label", {}, told, slider)])));
  tell();
  return tell;
});
byId("clear").addEventListener("click", () => {
  brushes.clear();
  for (const tell of axisControls) tell();
  applyBrushes();
});
