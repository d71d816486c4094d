"use strict";
// The plots of a replay: lines over time with a cursor, drawn as SVG; a click or a drag moves the cursor.
const replayPlots = (() => {
  const HEIGHT = 170, LEFT = 46, RIGHT = 8, TOP = 8, BOTTOM = 24;
  // Eight colours; lines of the same group of four differ in hue, and each group has a pattern of its own, so that a
  // colour that a reader confuses with another is not of the same pattern. Dots are of a second trial, equal dashes
  // of what is commanded.
  const COLOURS = 8, PATTERNS = ["none", "14 3 2 3", "20 4", "14 3 2 3 2 3"];
  const styled = (line, series, place) => {
    if (series.dashed) return line;
    line.style.stroke = `var(--series-${place % COLOURS + 1})`;
    const pattern = PATTERNS[Math.floor(place / 4) % PATTERNS.length];
    if (!line.classList.contains("second")) line.style.strokeDasharray = pattern;
    return line;
  };
  const drawn = (name, attributes = {}, text = "") => {
    const one = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
    one.textContent = text;
    return one;
  };

  // The line of a legend's entry, drawn as in the plot.
  const keyOf = (line) => {
    const key = drawn("svg", { class: "replay-key", viewBox: "0 0 36 10", "aria-hidden": "true" });
    key.append(line);
    return key;
  };

  // Tick step: 1, 2 or 5 times a power of ten that divides a range into about `count`.
  const roundStep = (range, count) => {
    const raw = range / count, power = 10 ** Math.floor(Math.log10(raw));
    return power * [1, 2, 5, 10].find((factor) => factor * power >= raw * 0.999);
  };
  const ticks = (low, high, count) => {
    const step = roundStep(high - low, count), found = [];
    for (let at = Math.ceil(low / step - 1e-9); at * step <= high + 1e-9; at += 1) found.push(Number((at * step).toPrecision(6)));
    return found;
  };
  const shown = (value) => value === null || value === undefined ? "–" : Math.abs(value) >= 100 ? value.toFixed(0) : value.toFixed(Math.abs(value) >= 10 ? 1 : 2);

  class Plot {
    // One plot of all trials: the first in full lines, the second dotted.
    constructor(place, timelines, index, end, seek) {
      this.timelines = timelines;
      this.index = index;
      this.end = end;
      const plot = timelines[0].plots[index];
      const figure = document.createElement("figure");
      const caption = document.createElement("figcaption");
      caption.textContent = `${plot.title} [${plot.unit}]`;
      this.legend = document.createElement("ul");
      this.legend.className = "replay-legend";
      this.svg = drawn("svg", { role: "img", "aria-label": `${plot.title} over time` });
      figure.append(caption, this.svg, this.legend);
      place.append(figure);
      this.seek = seek;
    }

    draw() {
      const { timelines, end } = this;
      // Drawn for the available width, so that the text keeps its size.
      this.width = Math.max(280, Math.round(this.svg.getBoundingClientRect().width) || 640);
      this.svg.setAttribute("viewBox", `0 0 ${this.width} ${HEIGHT}`);
      this.scale();
      this.drawAxes();
      timelines.forEach((timeline, trial) => this.drawSeries(timeline, trial));
      this.drawLimit(timelines[0].plots[this.index].limit);
      this.cursor = drawn("line", { class: "cursor", y1: TOP, y2: HEIGHT - BOTTOM });
      this.svg.append(this.cursor);
      this.readouts = this.entries();
      const at = (event) => {
        const box = this.svg.getBoundingClientRect();
        const share = ((event.clientX - box.left) / box.width * this.width - LEFT) / (this.width - LEFT - RIGHT);
        this.seek(Math.min(1, Math.max(0, share)) * end);
      };
      this.svg.addEventListener("pointerdown", (event) => { this.svg.setPointerCapture(event.pointerId); at(event); });
      this.svg.addEventListener("pointermove", (event) => { if (event.buttons & 1) at(event); });
    }

    scale() {
      const values = this.timelines.flatMap((one) => one.plots[this.index].series.flatMap((series) => series.values)).filter((value) => value !== null);
      const limits = this.timelines.map((one) => one.plots[this.index].limit).filter(Boolean).map((limit) => limit.value);
      this.low = Math.min(0, ...values.map(Number), ...limits);
      this.high = Math.max(...values, ...limits, this.low + 1e-3);
      const step = roundStep(this.high - this.low, 4);
      this.low = step * Math.floor(this.low / step + 1e-9);
      this.high = step * Math.ceil(this.high / step - 1e-9);
    }

    x(time) { return LEFT + time / this.end * (this.width - LEFT - RIGHT); }
    y(value) { return TOP + (this.high - value) / (this.high - this.low) * (HEIGHT - TOP - BOTTOM); }

    drawAxes() {
      this.timelines[0].phases.filter((one) => one.start_s !== null).forEach((phase, place) => {
        if (place % 2) return;
        const left = this.x(phase.start_s);
        this.svg.append(drawn("rect", { class: "band", x: left, y: TOP, width: Math.max(0, this.x(phase.end_s) - left), height: HEIGHT - TOP - BOTTOM }));
      });
      for (const value of ticks(this.low, this.high, 4)) {
        this.svg.append(drawn("line", { class: "grid", x1: LEFT, x2: this.width - RIGHT, y1: this.y(value), y2: this.y(value) }));
        this.svg.append(drawn("text", { x: LEFT - 6, y: this.y(value) + 4, "text-anchor": "end" }, String(value)));
      }
      for (const time of ticks(0, this.end, 8)) {
        const last = this.x(time) > this.width - 30;
        this.svg.append(drawn("text", { x: last ? this.width - RIGHT : this.x(time), y: HEIGHT - 6, "text-anchor": last ? "end" : "middle" }, `${time} s`));
      }
    }

    drawSeries(timeline, trial) {
      timeline.plots[this.index].series.forEach((series, place) => {
        const steps = [];
        let pen = "M";
        series.values.forEach((value, sample) => {
          if (value === null) { pen = "M"; return; }
          steps.push(`${pen}${this.x(timeline.time_s[sample]).toFixed(1)} ${this.y(value).toFixed(1)}`);
          pen = "L";
        });
        const kind = `series${series.dashed ? " dashed" : ""}${trial ? " second" : ""}`;
        this.svg.append(styled(drawn("path", { class: kind, d: steps.join("") }), series, place));
      });
    }

    drawLimit(limit) {
      if (limit) this.svg.append(drawn("line", { class: "series limit", x1: LEFT, x2: this.width - RIGHT, y1: this.y(limit.value), y2: this.y(limit.value) }));
    }

    entries() {
      const found = [];
      const { series, limit } = this.timelines[0].plots[this.index];
      series.forEach((one, place) => {
        const item = document.createElement("li"), values = document.createElement("b");
        const line = drawn("line", { class: `series${one.dashed ? " dashed" : ""}`, x1: 0, x2: 36, y1: 5, y2: 5 });
        item.append(keyOf(styled(line, one, place)), `${one.name} `, values);
        this.legend.append(item);
        found.push({ place, values });
      });
      if (limit) {
        const item = document.createElement("li");
        item.append(keyOf(drawn("line", { class: "series limit", x1: 0, x2: 36, y1: 5, y2: 5 })), `${limit.name} ${shown(limit.value)}`);
        this.legend.append(item);
      }
      return found;
    }

    point(time) {
      const x = this.x(time);
      this.cursor.setAttribute("x1", x);
      this.cursor.setAttribute("x2", x);
      for (const { place, values } of this.readouts) {
        values.textContent = this.timelines.map((timeline) => {
          const series = timeline.plots[this.index].series[place];
          return series ? shown(series.values[replayScene.sampleAt(timeline.time_s, time)]) : "–";
        }).join(" · ");
      }
    }
  }

  return { Plot };
})();
