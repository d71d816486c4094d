// ---------------------------------------------- the document: as it is, or packed with gzip
(() => {
  const holder = document.getElementById("report-data");
  if (holder.type === "application/json") {
    rgssReport(JSON.parse(holder.textContent));
    return;
  }
  const bytes = Uint8Array.from(atob(holder.textContent), (sign) => sign.charCodeAt(0));
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  new Response(unpacked).json().then(rgssReport);
})();
