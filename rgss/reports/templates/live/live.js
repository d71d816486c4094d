"use strict";
(() => {
  const PERIOD_MS = 2000;
  const part = (id) => document.getElementById(id);
  const put = (id, text) => {
    part(id).textContent = text;
    part(id).hidden = !text;
  };
  const list = (id, tag, texts) => part(id).replaceChildren(...texts.map((text) => {
    const made = document.createElement(tag);
    made.textContent = text;
    return made;
  }));
  const rows = (id, table) => part(id).replaceChildren(...table.map((cells) => {
    const row = document.createElement("tr");
    cells.forEach((text, place) => {
      const cell = document.createElement(place ? "td" : "th");
      if (!place) cell.scope = "row";
      if (typeof text === "number") cell.className = "number";
      cell.append(text);
      row.append(cell);
    });
    return row;
  }));
  const replay = (trial) => {
    const link = document.createElement("a");
    link.href = `replay/${trial}`;
    link.target = "_blank";
    link.rel = "noopener";
    link.textContent = trial;
    return link;
  };
  const counted = (counts) => [counts.met, counts.not_met, counts.inconclusive + counts.not_run + counts.stale];

  const show = (found) => {
    const { progress, decision } = found;
    part("bar").max = Math.max(1, progress.planned);
    part("bar").value = progress.done;
    put("progress", progress.sentence);
    list("progress-notes", "p", progress.notes);
    put("decision-standing", decision.standing);
    put("headline", decision.headline);
    put("problem", decision.problem);
    list("decision-lines", "li", [...decision.lines, ...decision.why, ...decision.cautions]);
    rows("requirements", found.requirements.map((one) => [`${one.id} ${one.text}`, ...counted(one.counts)]));
    rows("variants", found.variants.map((one) => [one.id, one.done, one.failed, one.missing, ...counted(one.verdicts), one.not_met.join(", ")]));
    put("more-variants", found.more_variants ? `${found.more_variants} more variants are not listed.` : "");
    rows("failures", found.failures.map((one) => [found.replayable ? replay(one.trial) : one.trial, one.failure, one.phase, one.detail]));
    put("replays", found.replayable && found.failures.length ? "A trial's number opens its replay: the trial is run again, which takes seconds." : "");
    part("failure-table").hidden = !found.failures.length;
    part("no-failures").hidden = found.failures.length > 0;
    put("more-failures", found.more_failures ? `${found.more_failures} more are not listed.` : "");
  };

  let version = "";
  const look = async () => {
    try {
      const answer = await fetch(`state.json?seen=${version}`, { cache: "no-store" });
      if (!answer.ok) throw new Error(String(answer.status));
      const state = await answer.json();
      put("standing", state.sentence);
      put("notice", state.problem);
      if (state.study) {
        show(state.study);
        part("found").hidden = false;
      } else if (state.study === null) {
        part("found").hidden = true;
      }
      version = state.version;
    } catch {
      put("notice", "The server does not answer; its last answer is shown. Start 'rgss serve' again.");
    }
    setTimeout(look, PERIOD_MS);
  };
  look();
})();
