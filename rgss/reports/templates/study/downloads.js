// ----------------------------------------------- each plot and its figures as PNG, SVG and CSV
const specifications = new Map();

const fileName = (id, kind) => `${String(data.study).replace(/[^\w.-]+/g, "-")}-${id}.${kind}`;
const save = (name, href) => {
  const link = element("a", { href, download: name });
  document.body.append(link);
  link.click();
  link.remove();
};
const saveText = (name, type, text) => {
  const href = URL.createObjectURL(new Blob([text], { type }));
  save(name, href);
  setTimeout(() => URL.revokeObjectURL(href), 10000);
};
// A text that a spreadsheet would evaluate as a formula is kept a text.
const csvCell = (value) => {
  if (typeof value === "number") return String(value);
  const text = String(value ?? "");
  const safe = /^[=+@\t\r-]/.test(text) && Number.isNaN(Number(text)) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replace(/"/g, '""')}"` : safe;
};
// A column of numbers has plain numbers, none where the value is unknown; the ends of an interval are columns of their own.
const csvColumns = (column) => {
  const textOf = (one) => (one instanceof Node ? textIn(one) : one ?? "");
  const head = textOf(column.head), said = (row) => textOf(column.cell(row));
  const figure = (row) => {
    const value = column.value ?? column.sort;
    if (value) return value(row) ?? "";
    const text = said(row), plain = text.replace(/,(?=\d{3})/g, "").replace("−", "-");
    return text === "–" ? "" : text !== "" && Number.isFinite(Number(plain)) ? Number(plain) : text;
  };
  // "t_e [s]" has the ends "t_e low [s]" and "t_e high [s]".
  const end = (index, name) => ({ head: head.replace(/( \[[^[]*\])?$/, ` ${name}$1`), cell: (row) => column.ends(row)[index] });
  return [{ head, cell: column.number ? figure : said }, ...(column.ends ? [end(0, "low"), end(1, "high")] : [])];
};
const csvOf = ({ columns, csv = columns.filter((column) => !column.merged).flatMap(csvColumns), rows }) => {
  const lines = [csv.map((column) => csvCell(column.head)), ...rows().map((row) => csv.map((column) => csvCell(column.cell(row))))];
  return `${lines.map((line) => line.join(",")).join("\r\n")}\r\n`;
};
// An SVG picture rasterised at twice the resolution of a screen.
const savePng = (name, svgAddress, width, height) => {
  const picture = new Image();
  picture.addEventListener("load", () => {
    const canvas = element("canvas", { width: 2 * width, height: 2 * height });
    const pen = canvas.getContext("2d");
    pen.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--paper");
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(picture, 0, 0, canvas.width, canvas.height);
    save(name, canvas.toDataURL("image/png"));
  });
  picture.src = svgAddress;
};
const svgAddress = (text) => `data:image/svg+xml,${encodeURIComponent(text)}`;

// A picture opened alone is on the white of its viewer, on which the light ink of the dark scheme would be unreadable.
const onPaper = (address) => {
  const drawing = new DOMParser().parseFromString(decodeURIComponent(address.slice(address.indexOf(",") + 1)), "image/svg+xml").documentElement;
  const paper = document.createElementNS(drawing.namespaceURI, "rect");
  for (const [name, value] of [["width", "100%"], ["height", "100%"], ["fill", getComputedStyle(document.documentElement).getPropertyValue("--paper").trim()]]) paper.setAttribute(name, value);
  drawing.prepend(paper);
  return svgAddress(new XMLSerializer().serializeToString(drawing));
};

// ways: {svg() → a promise of [address, width, height], csv} for the content of the host. Returns a function that offers
// only what there is, given whether the host has a picture.
const downloadsFor = (host, id, { svg = null, csv = false }) => {
  const button = (text, act) => {
    const made = element("button", { type: "button", "aria-label": `Save ${id} as ${text}` }, text);
    made.addEventListener("click", act);
    return made;
  };
  const bar = element("p", { class: "downloads" }, "Save as "), pictures = element("span");
  if (svg) {
    pictures.append(button("PNG", () => svg().then(([address, width, height]) => savePng(fileName(id, "png"), address, width, height))), " ");
    pictures.append(button("SVG", () => svg().then(([address]) => save(fileName(id, "svg"), onPaper(address)))), " ");
    bar.append(pictures);
  }
  const table = button("CSV", () => saveText(fileName(id, "csv"), "text/csv", csvOf(specifications.get(`${id}-table`))));
  if (csv) bar.append(table);
  host.after(bar);
  return (drawn) => {
    pictures.hidden = !drawn;
    table.hidden = !drawn && !specifications.get(`${id}-table`)?.rows().length;
    bar.hidden = pictures.hidden && table.hidden;
  };
};

// Canvas context that writes SVG: only the methods that the parallel coordinates use.
const svgPen = (width, height) => {
  const marks = [];
  let path = "";
  const ruler = element("canvas").getContext("2d");
  const escaped = (text) => String(text).replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
  const look = (pen) => `stroke="${escaped(pen.strokeStyle)}" stroke-width="${pen.lineWidth}" opacity="${pen.globalAlpha}"${pen.dashes ? ` stroke-dasharray="${pen.dashes}"` : ""}`;
  const words = (pen, text, x, y, more) => marks.push(`<text x="${x}" y="${y}" text-anchor="${{ right: "end", center: "middle" }[pen.textAlign] ?? "start"}" style="font:${escaped(pen.font)}" ${more}>${escaped(text)}</text>`);
  const n = (value) => Number(value.toFixed(2));
  return {
    globalAlpha: 1, lineWidth: 1, strokeStyle: "#000", fillStyle: "#000", font: "12px sans-serif", textAlign: "start", dashes: "",
    scale() {},
    setLineDash(dash) { this.dashes = dash.join(" "); },
    beginPath() { path = ""; },
    moveTo(x, y) { path += `M${n(x)} ${n(y)}`; },
    lineTo(x, y) { path += `L${n(x)} ${n(y)}`; },
    stroke() { marks.push(`<path d="${path}" fill="none" ${look(this)}/>`); },
    fillRect(x, y, w, h) { marks.push(`<rect x="${n(x)}" y="${n(y)}" width="${n(w)}" height="${n(h)}" fill="${escaped(this.fillStyle)}"/>`); },
    strokeRect(x, y, w, h) { marks.push(`<rect x="${n(x)}" y="${n(y)}" width="${n(w)}" height="${n(h)}" fill="none" ${look(this)}/>`); },
    fillText(text, x, y) { words(this, text, n(x), n(y), `fill="${escaped(this.fillStyle)}"`); },
    measureText(text) { ruler.font = this.font; return ruler.measureText(text); },
    text: () => `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">${marks.join("")}</svg>`,
  };
};

// The tornado is inline SVG; its file includes the colours of the page's style sheet.
const startTornado = () => {
  const host = byId("tornado"), drawn = host?.querySelector("svg.wide");
  if (!drawn) return;
  const side = (name, index, beyond) => [{ head: name, cell: (row) => row.numbers.ends[index].value }, { head: `${name} lead`, cell: (row) => row.numbers.ends[index].lead },
    { head: `${name} feasible`, cell: (row) => (row.numbers.ends[index].feasible ? "yes" : "no") }, { head: `${name} wins`, cell: (row) => row.ends[index].wins }, { head: `changes ${beyond}`, cell: (row) => row.numbers.ends[index].flip }];
  specifications.set("tornado-table", { rows: () => data.sensitivity.tornado.rows, csv: [
    { head: "input", cell: (row) => row.input }, { head: "unit", cell: (row) => row.numbers.unit }, { head: "is", cell: (row) => row.numbers.base },
    ...side("low", 0, "below"), ...side("high", 1, "above"), { head: "changes are", cell: (row) => (row.numbers.exact ? "exact" : "approximate") }, { head: "range is", cell: (row) => row.range_is },
  ] });
  downloadsFor(host, "tornado", { csv: true, svg: async () => {
    const copy = drawn.cloneNode(true), { width, height } = drawn.viewBox.baseVal;
    const parts = Array.from(drawn.querySelectorAll("*"));
    Array.from(copy.querySelectorAll("*")).forEach((one, index) => {
      const look = getComputedStyle(parts[index]);
      for (const name of ["fill", "stroke", "stroke-width", "stroke-dasharray", "font-size", "font-family"]) one.setAttribute(name, look.getPropertyValue(name));
    });
    copy.setAttribute("width", width);
    copy.setAttribute("height", height);
    return [svgAddress(new XMLSerializer().serializeToString(copy)), width, height];
  } });
};
