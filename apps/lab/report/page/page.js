/* Draws the curves with uPlot: drag to zoom, double-click to see all, point, touch or move the slider to read values. */
const { columns, runs, t, keys, panels } = JSON.parse(document.getElementById("curves").textContent);
const PAPER = 690, FLAT = 0.32, SIDE = 0.39, SIDE_FLAT = 0.42; /* px: width of what is printed; its height against that on a screen; both beside a table */

for (const column of columns) {
  let sum = 0;
  column.v = column.d.split(",").map(d => d === "" ? null : (sum += Number(d)) / 10 ** column.k);
}
const isPaper = () => document.documentElement.classList.contains("paper");
/* a column with a single value has it everywhere */
const valueAt = (column, i) => column.v[column.v.length === 1 ? 0 : i];
const runOf = i => Math.max(0, runs.filter(r => r.entry <= i).length - 1);
const decimal = (x, column) => x.toFixed(column.k).replace("-", "\u2212");
const withUnit = unit => unit ? " " + unit : "";
const inBrackets = (name, unit) => name + (unit ? " [" + unit + "]" : "");
const colour = name => getComputedStyle(document.documentElement).getPropertyValue("--f-" + name);

/* "t = 3.21 s"; of several runs one after the other, that of its log */
function where(panel, i) {
  const x = columns[panel.x], run = panel.x === t ? runs[runOf(i)] : { shift: 0 };
  return (panel.x === t && runs.length > 1 ? "run " + (runOf(i) + 1) + ", " : "") + panel.x_name + " = " +
    decimal(x.v[i] - run.shift, x) + withUnit(panel.x_unit);
}

/* A line ends with its run, and where no value is for long: a fiftieth of the axis, and four times what is usual. */
function gaps(u, series, from, to) {
  const x = u.data[0], y = u.data[series], found = [];
  const wide = (x[x.length - 1] - x[0]) * Math.max(0.02, 4 / (y.filter(v => v !== null).length - 1));
  const ends = runs.map(r => x === columns[t].v ? r.entry : 0);
  for (let i = from, last = -1; i <= to; i++) {
    if (y[i] === null) continue;
    if (last >= 0 && (x[i] - x[last] > wide || ends.some(e => last < e && e <= i)))
      found.push([u.valToPos(x[last], "x", true), u.valToPos(x[i], "x", true)]);
    last = i;
  }
  return found;
}

const forms = {
  line: () => ({}),
  dashed: () => ({ dash: [7, 3] }),
  steps: () => ({ paths: uPlot.paths.stepped({ align: 1 }) }),
  points: hue => ({ points: { show: true, size: 4, fill: hue, stroke: hue } }),
  bars: hue => ({ paths: uPlot.paths.bars({ size: [0.6, 6] }), fill: hue, width: 0 }),
  band: () => ({ width: 0, points: { show: false } }),
};

/* Series of a curve: one, or both edges of a band. */
function seriesOf(curve) {
  const { colour: name, width } = keys[curve.key], hue = () => colour(name);
  const one = { key: curve.key, stroke: hue, width, gaps, points: { show: false }, ...forms[curve.form](hue) };
  return curve.form === "band" ? [one, { ...one }] : [one];
}

function dataOf(panel) {
  const x = columns[panel.x], of = (curve, sign) => x.v.map((_, i) => { const v = valueAt(columns[curve.y], i); return v === null ? null : sign * v; });
  return [x.v, ...panel.curves.flatMap(c => c.form === "band" ? [of(c, 1), of(c, -1)] : [of(c, 1)])];
}

/* the axis of what is drawn, so that nothing touches its ends */
const around = (u, low, high) => low === null ? [0, 1] : low < high ? [low - 0.05 * (high - low), high + 0.05 * (high - low)] : [low - 1, low + 1];
const heightOf = (panel, labelled, scale) => scale * panel.height + (labelled ? 70 : 35);

function optionsOf(panel, title, labelled, width, read) {
  const axis = { stroke: () => colour("ink"), grid: { stroke: () => colour("rule"), width: 1 }, ticks: { show: false }, font: "12px sans-serif", labelFont: "12px sans-serif" };
  const bands = panel.curves[0].form === "band" ? [{ series: [1, 2], fill: () => colour("sand") }] : [];
  return {
    title, width, height: panel.height + (labelled ? 70 : 35), legend: { show: false }, bands,
    padding: [6, 8, labelled ? 0 : 8, 0],
    scales: { x: { time: false }, y: { range: panel.reach ? [-panel.reach, panel.reach] : around } },
    axes: [
      { ...axis, space: 40, ...(labelled ? { label: inBrackets(panel.x_name, panel.x_unit), labelSize: 18, size: 26 } : { size: 0, values: (u, v) => v.map(() => "") }) },
      { ...axis, space: 24, size: 48 },
    ],
    series: [{}, ...panel.curves.flatMap(seriesOf)],
    cursor: { y: false, sync: { key: panel.x_name, scales: ["x", null] }, hover: { skip: [] }, points: { size: 8 } },
    hooks: { setCursor: [u => read(panel, u)] },
  };
}

class Figure {
  constructor(figure, list) {
    const box = figure.querySelector(".panels"), across = Number(getComputedStyle(box).getPropertyValue("--across"));
    this.figure = figure;
    this.list = list;
    this.plots = list.map((panel, i) => {
      const labelled = !list[i + across] || list[i + 1].x_name !== panel.x_name;
      const cell = box.appendChild(document.createElement("div"));
      const title = i % across && list[i - 1].name === panel.name ? "\u00a0" : inBrackets(panel.name, panel.unit);
      const u = new uPlot(optionsOf(panel, title, labelled, cell.clientWidth, (p, u) => this.read(p, u)), dataOf(panel), cell);
      u.fit = (width, scale) => width && u.setSize({ width, height: heightOf(panel, labelled, scale) });
      new ResizeObserver(() => isPaper() || u.fit(cell.clientWidth, 1)).observe(cell);
      return u;
    });
    this.across = across;
    this.keys();
    this.slide();
  }

  keys() {
    this.figure.querySelector(".keys").hidden = false;
    for (const input of this.figure.querySelectorAll("[data-key]"))
      input.addEventListener("change", () => {
        for (const u of this.plots)
          u.series.forEach((s, i) => { if (s.key === input.dataset.key) u.setSeries(i, { show: input.checked }); });
        this.read(this.panel, this.plot);
      });
  }

  /* the keyboard's way, and the screen reader's; of several axes it moves along the one that is chosen */
  slide() {
    const row = document.createElement("div"), names = [...new Set(this.list.map(p => p.x_name))];
    row.className = "point screen";
    row.innerHTML = "<input type=\"range\" min=\"0\" step=\"1\"/><select aria-label=\"Axis to read along\"></select>";
    this.output = document.createElement("output");
    this.output.className = "reading screen";
    this.output.textContent = "Point, touch or move the slider to read values; drag to zoom, double-click to see all.";
    this.figure.querySelector(".panels").after(row, this.output);
    [this.slider, this.axis] = row.children;
    this.axis.append(...names.map(name => new Option(name)));
    this.axis.hidden = names.length < 2;
    this.axis.addEventListener("change", () => { this.choose(this.axis.value); this.move(); });
    this.slider.addEventListener("input", () => this.move());
    this.choose(names[0]);
    this.slider.value = this.slider.max >> 1;
  }

  choose(name) {
    const i = this.list.findIndex(p => p.x_name === name);
    this.panel = this.list[i];
    this.plot = this.plots[i];
    this.axis.value = name;
    this.slider.max = columns[this.panel.x].v.length - 1;
    this.slider.setAttribute("aria-label", "Read the curves at " + name);
  }

  move() {
    this.plot.setCursor({ left: this.plot.valToPos(columns[this.panel.x].v[this.slider.value], "x"), top: 1 });
  }

  /* What is under the cursor of a panel, and of those that share its axis. */
  read(panel, u) {
    const i = u && u.cursor.idx;
    if (i === null || i === undefined || !this.output) return;
    if (panel.x_name !== this.panel.x_name) this.choose(panel.x_name);
    const told = [where(panel, i), ...this.list.filter(p => p.x === panel.x).map(p => this.values(p, i)).filter(p => p)];
    this.output.replaceChildren(...told.map((text, k) => {
      const span = document.createElement("span");
      span.appendChild(k ? new Text(text) : document.createElement("strong")).textContent = text;
      return span;
    }));
    this.slider.value = i;
    this.slider.setAttribute("aria-valuetext", told.join("; "));
  }

  /* "Pressure p: measured 231.10, declared 230.87 kPa"; several curves of a key: "measured 240 / 180, found 241 / 181 kPa" */
  values(panel, i) {
    const isOn = key => (this.figure.querySelector("[data-key=" + key + "]") || { checked: true }).checked;
    const on = panel.curves.filter(c => isOn(c.key) && valueAt(columns[c.y], i) !== null && (c.form !== "band" || columns[c.y].v.length > 1));
    const of = key => on.filter(c => c.key === key).map(c => (c.form === "band" ? "\u00b1" : "") + decimal(valueAt(columns[c.y], i), columns[c.y])).join(" / ");
    return on.length && panel.name + ": " + [...new Set(on.map(c => c.key))].map(key => (keys[key].brief ? keys[key].brief + " " : "") + of(key)).join(", ") +
      withUnit(panel.unit);
  }
}

const figures = Object.keys(panels).map(name => new Figure(document.getElementById("figure-" + name), panels[name]));
const redraw = () => figures.forEach(f => f.plots.forEach(u => u.redraw(false)));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
for (const [type, paper] of [["beforeprint", true], ["afterprint", false]])
  addEventListener(type, () => {
    document.documentElement.classList.toggle("paper", paper);
    for (const f of figures)
      for (const u of f.plots)
        paper ? f.figure.closest(".side") ? u.fit(PAPER * SIDE, SIDE_FLAT) : u.fit(PAPER / f.across, FLAT) : u.fit(u.root.parentElement.clientWidth, 1);
    redraw();
  });
