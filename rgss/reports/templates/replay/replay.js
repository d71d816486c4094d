"use strict";
// Player of a replay: play, pause, scrub, speed, chapters, layers, viewpoint; by mouse, touch and keys.
const replays = (() => {
  const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
  const SHOWN = [["forces", "Contact forces"], ["path", "Planned path"], ["graph", "Planner's tree"], ["perceived", "Perceived pose"]];
  const STEP_S = 0.1;
  const TURN_DEG = 10, CLOSER = 0.8;
  const KEYS = "Keys in the scene: space plays, left and right step, page up and page down change the phase, shift and an arrow turn, + and − zoom, as the wheel does there.";
  const MOST_TOUCHES = 6;
  // A slow machine, or a page that was out of sight, plays slowly; it leaves nothing out.
  const LONGEST_FRAME_S = 0.25;

  const made = (name, attributes = {}, ...children) => {
    const one = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
      if (key in one && key !== "list") one[key] = value; else one.setAttribute(key, value);
    }
    one.append(...children);
    return one;
  };

  class Player {
    constructor(place, trials) {
      this.place = place;
      this.trials = trials;
      this.timelines = trials.map((trial) => trial.timeline);
      this.end = Math.max(...this.timelines.map((one) => one.end_s));
      this.time = 0;
      this.speed = 1;
      this.playing = false;
      this.build();
      this.view = this.viewOf(trials);
      this.arrange();
      this.drawPlots();
      matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.view.redraw());
      this.seek(0);
    }

    viewOf(trials) {
      const { place } = this;
      try {
        return new replayScene.View(this.stage, trials, { onDraw: () => { place.dataset.drawn = String(Number(place.dataset.drawn || 0) + 1); } });
      } catch (error) {
        return new replayScene.NoView(this.stage, error);
      }
    }

    build() {
      const lead = this.timelines[0];
      this.stage = made("div", { className: "replay-view", tabIndex: 0, role: "application", "aria-label": `Scene in three dimensions. ${KEYS}` });
      this.names = made("div", { className: "replay-names" });
      this.stage.append(this.names);
      this.playButton = made("button", { type: "button", className: "replay-play", textContent: "Play" });
      this.playButton.addEventListener("click", () => this.toggle());
      this.clock = made("output", { className: "replay-time" });
      this.scrub = made("input", { type: "range", className: "replay-scrub", min: 0, max: this.end, step: 0.01, value: 0, "aria-label": "Time of the replay" });
      this.scrub.addEventListener("input", () => { this.pause(); this.seek(Number(this.scrub.value)); });
      const speed = made("select", {}, ...SPEEDS.map((one) => made("option", { value: one, textContent: `${one}×`, selected: one === 1 })));
      speed.addEventListener("change", () => { this.speed = Number(speed.value); });
      const view = made("select", {}, ...replayScene.views.map((one) => made("option", { value: one, textContent: one })));
      view.addEventListener("change", () => this.view.choose(view.value));
      const bar = made("div", { className: "replay-bar" }, this.playButton, this.clock, made("label", {}, "Speed ", speed), made("label", {}, "View ", view));
      if (this.trials.length > 1) {
        this.mode = made("select", {}, made("option", { value: "ghost", textContent: "as a ghost" }), made("option", { value: "beside", textContent: "side by side" }));
        this.mode.addEventListener("change", () => this.arrange());
        bar.append(made("label", {}, "Second trial ", this.mode));
      }
      const shows = made("div", { className: "replay-bar" }, ...SHOWN.map(([name, text]) => this.checkbox(name, text)));
      this.trials.forEach((trial) => shows.append(this.download(trial)));
      this.chapters = made("ol", { className: "replay-chapters" }, ...lead.phases.map((phase, place) => this.chapter(phase, place)));
      const side = made("div", { className: "replay-side" });
      for (const one of this.timelines) side.append(made("p", {}, made("strong", {}, one.title), made("br"), one.outcome));
      const [first] = lead.perceived;
      const perceived = lead.perceived.length === 1
        ? `The object is perceived ${first.distance_mm} mm and ${first.angle_deg}° from where it is (violet).`
        : `Objects are perceived (violet) beside where they are: ${lead.perceived.map((one) => `${one.object} by ${one.distance_mm} mm and ${one.angle_deg}°`).join(", ")}.`;
      side.append(made("h3", { textContent: "Phases" }), this.chapters);
      side.append(made("p", { className: "replay-note" }, `${perceived} An arrow is the force at the instant shown, the longest ${lead.greatest_force_n.toFixed(1)} N; the plots have the greatest between instants. ${KEYS}`));
      if (lead.touches.length > 0) side.append(made("h3", { textContent: "Touched (pink)" }), this.touches(lead.touches));
      this.plotPlace = made("div", { className: "replay-plots" });
      this.place.append(made("div", { className: "replay-stage" }, this.stage, this.scrub, bar, shows), side, this.plotPlace);
      this.stage.addEventListener("keydown", (event) => this.key(event));
    }

    // What the robot touched that it was not meant to; a button each that goes there.
    touches(all) {
      const rows = all.slice(0, MOST_TOUCHES).map(({ link, body, start_s: start, force_n: force }) => {
        const button = made("button", { type: "button" },
          made("span", { textContent: `${link} – ${body}` }),
          made("span", { textContent: `${start.toFixed(2)} s, ${Math.hypot(...force).toFixed(0)} N` }));
        button.addEventListener("click", () => { this.pause(); this.seek(start); });
        return made("li", {}, button);
      });
      if (all.length > MOST_TOUCHES) rows.push(made("li", { textContent: `and ${all.length - MOST_TOUCHES} more` }));
      return made("ol", { className: "replay-touches" }, ...rows);
    }

    checkbox(name, text) {
      const box = made("input", { type: "checkbox", checked: true });
      box.dataset.show = name;
      box.addEventListener("change", () => {
        for (const trial of this.trials) trial.show(name, box.checked);
        this.view.pose(this.time);
      });
      return made("label", {}, box, ` ${text}`);
    }

    download(trial) {
      const button = made("button", { type: "button", textContent: this.trials.length > 1 ? `Save ${trial.timeline.title} as GLB` : "Save as GLB" });
      button.addEventListener("click", () => {
        const address = URL.createObjectURL(new Blob([trial.glb], { type: "model/gltf-binary" }));
        made("a", { href: address, download: `${trial.timeline.title.toLowerCase().replace(/[^a-z0-9]+/g, "-")}.glb` }).click();
        setTimeout(() => URL.revokeObjectURL(address), 1000);
      });
      return button;
    }

    chapter(phase, place) {
      const button = made("button", { type: "button", disabled: phase.start_s === null },
        made("span", { textContent: `${place + 1} ${phase.name}` }),
        made("span", { className: phase.failed ? "failed" : "", textContent: phase.start_s === null || phase.failed ? phase.outcome : `${(phase.end_s - phase.start_s).toFixed(2)} s` }));
      button.addEventListener("click", () => this.seek(phase.start_s));
      return made("li", {}, button);
    }

    drawPlots() {
      this.plotPlace.replaceChildren();
      this.plots = this.timelines[0].plots.map((_, index) => new replayPlots.Plot(this.plotPlace, this.timelines, index, this.end, (time) => this.seek(time)));
      // Their width is known after layout.
      for (const plot of this.plots) plot.draw();
      let width = this.plotPlace.clientWidth;
      if (this.watch) return;
      this.watch = new ResizeObserver(() => {
        if (this.plotPlace.clientWidth === width) return;
        width = this.plotPlace.clientWidth;
        this.drawPlots();
        for (const plot of this.plots) plot.point(this.time);
      });
      this.watch.observe(this.plotPlace);
    }

    arrange() {
      const mode = this.mode ? this.mode.value : "one";
      this.view.arrange(mode);
      const names = mode === "beside" ? this.timelines.map((one) => one.title) : mode === "ghost" ? [`${this.timelines[0].title}; as a ghost ${this.timelines[1].title}`] : [];
      this.names.replaceChildren(...names.map((text) => made("span", { textContent: text })));
    }

    seek(time) {
      this.time = Math.min(this.end, Math.max(0, time));
      this.view.pose(this.time);
      const { phases } = this.timelines[0];
      this.current = replayScene.phaseAt(phases, this.time);
      this.scrub.value = this.time;
      const name = this.current >= 0 ? phases[this.current].name : "";
      this.scrub.setAttribute("aria-valuetext", `${this.time.toFixed(2)} seconds, ${name}`);
      this.clock.textContent = `${this.time.toFixed(2)} of ${this.end.toFixed(2)} s`;
      Array.from(this.chapters.querySelectorAll("button")).forEach((button, place) => {
        if (place === this.current) button.setAttribute("aria-current", "true"); else button.removeAttribute("aria-current");
      });
      for (const plot of this.plots || []) plot.point(this.time);
      this.place.dataset.time = this.time.toFixed(3);
    }

    toggle() { if (this.playing) this.pause(); else this.play(); }

    play() {
      if (this.time >= this.end - 1e-6) this.seek(0);
      this.playing = true;
      this.playButton.textContent = "Pause";
      let before = performance.now();
      const advance = (now) => {
        if (!this.playing) return;
        this.seek(this.time + Math.min(LONGEST_FRAME_S, Math.max(0, now - before) / 1000) * this.speed);
        before = now;
        if (this.time >= this.end) this.pause(); else requestAnimationFrame(advance);
      };
      requestAnimationFrame(advance);
    }

    pause() {
      this.playing = false;
      this.playButton.textContent = "Play";
    }

    turnTo(direction) {
      const starts = this.timelines[0].phases.map((one) => one.start_s).filter((one) => one !== null);
      const found = direction > 0 ? starts.find((one) => one > this.time + 1e-6) : starts.reverse().find((one) => one < this.time - 0.05);
      this.seek(found === undefined ? (direction > 0 ? this.end : 0) : found);
    }

    key(event) {
      const steps = {
        " ": () => this.toggle(),
        ArrowLeft: () => { this.pause(); this.seek(this.time - STEP_S); },
        ArrowRight: () => { this.pause(); this.seek(this.time + STEP_S); },
        PageUp: () => this.turnTo(-1),
        PageDown: () => this.turnTo(1),
        Home: () => this.seek(0),
        End: () => this.seek(this.end),
        "+": () => this.view.orbit(0, 0, CLOSER),
        "-": () => this.view.orbit(0, 0, 1 / CLOSER),
      };
      const turns = {
        ArrowLeft: () => this.view.orbit(-TURN_DEG, 0),
        ArrowRight: () => this.view.orbit(TURN_DEG, 0),
        ArrowUp: () => this.view.orbit(0, TURN_DEG),
        ArrowDown: () => this.view.orbit(0, -TURN_DEG),
      };
      const act = event.shiftKey && event.key in turns ? turns[event.key] : steps[event.key];
      if (act === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    }
  }

  const players = new WeakMap();
  const start = async (place) => {
    if (players.has(place)) return players.get(place);
    players.set(place, null);
    try {
      const trials = await Promise.all(Array.from(place.querySelectorAll(".replay-data")).map(replayScene.load));
      const player = new Player(place, trials);
      players.set(place, player);
      place.dataset.state = "ready";
      return player;
    } catch (error) {
      place.dataset.state = "failed";
      place.append(made("p", { role: "alert", textContent: `The replay cannot be drawn here: ${error.message}` }));
      return null;
    }
  };

  const all = Array.from(document.querySelectorAll("[data-replay]"));
  const open = [];
  for (const place of all) {
    const folded = place.closest("details");
    if (folded === null || folded.open) open.push(start(place));
    else folded.addEventListener("toggle", () => { if (folded.open) start(place); });
  }
  if (all.length > 0 && open.length === all.length) Promise.all(open).then(() => { document.documentElement.dataset.ready = "yes"; });
  return { start, playerOf: (place) => players.get(place) };
})();
