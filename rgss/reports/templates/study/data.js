// ---------------------------------------------- the document: plain, or compressed with gzip
(() => {
  const holder = document.getElementById("report-data");
  if (holder.type === "application/json") {
    rgssReport(JSON.parse(holder.textContent), null);
    return;
  }
  const unpacked = (text) => {
    const signs = atob(text);
    const bytes = new Uint8Array(signs.length);
    for (let place = 0; place < signs.length; place += 1) bytes[place] = signs.charCodeAt(place);
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).json();
  };
  // Data that no initial plot needs is decompressed after the page is shown.
  const later = () => new Promise((tell) => {
    const whenIdle = window.requestIdleCallback ?? setTimeout;
    whenIdle(() => tell(unpacked(document.getElementById("report-later").textContent)));
  });
  unpacked(holder.textContent).then((document) => rgssReport(document, later));
})();
