/* Read the curves of the figures by pointing, touching, or with the slider below each; the page is whole without. */
(() => {
  const svgNS = document.querySelector(".drawing svg").namespaceURI;
  const { columns, panels, runs, t, labels } = JSON.parse(document.getElementById("readings").textContent);
  const shown = {}; /* group: x that is pointed at */

  for (const column of columns) {
    let sum = 0;
    column.v = column.d.split(",").map(d => d === "" ? NaN : (sum += Number(d)) / 10 ** column.k);
  }
  /* times are those of the logs; the axis has one run after the other */
  const runOf = i => Math.max(0, runs.filter(r => r.entry <= i).length - 1);
  const time = columns[t], clock = time.v;
  time.v = clock.map((x, i) => x + runs[runOf(i)].shift);
  const decimal = (x, k) => x.toFixed(k).replace("-", "\u2212");
  const text = (column, i) => decimal(column.v[i], column.k);

  /* index of the entry nearest to x, of growing ones */
  function nearest(v, x) {
    let low = 0, high = v.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (v[middle] > x) high = middle; else low = middle;
    }
    return v[high] - x < x - v[low] ? high : low;
  }

  const place = (x, [from, to], start, end) => start + (x - from) / (to - from) * (end - start);
  const withUnit = unit => unit ? " " + unit : "";

  /* "t = 3.21 s"; of several runs one after the other, that of its log */
  function where(panel, i) {
    if (panel.at !== t)
      return panel.x_name + " = " + text(columns[panel.at], i) + withUnit(panel.x_unit);
    return (runs.length > 1 ? "run " + (runOf(i) + 1) + ", " : "") + "t = " + decimal(clock[i], time.k) + " s";
  }

  function element(name, className, parent) {
    const e = parent.namespaceURI === svgNS ? document.createElementNS(svgNS, name) : document.createElement(name);
    if (className) e.setAttribute("class", className);
    return parent.appendChild(e);
  }

  function attributes(e, values) {
    for (const name in values) e.setAttribute(name, values[name]);
  }

  class Figure {
    constructor(figure, list) {
      this.figure = figure;
      this.list = list;
      this.svg = figure.querySelector("svg");
      this.groups = [...new Set(list.map(p => p.group))];
      this.group = this.groups[0];
      this.cursor = element("g", "cursor", this.svg);
      const row = element("div", "point screen", figure.querySelector(".plot"));
      this.slider = element("input", "", row);
      attributes(this.slider, { type: "range", min: 0, step: 1, "aria-label": "Read the curves at" });
      this.slider.addEventListener("input", () => point(this.group, this.at().v[this.slider.value]));
      if (this.groups.length > 1) this.choose(row);
      this.output = element("output", "reading screen", figure.querySelector(".plot"));
      this.output.textContent = "Point at the figure, touch it or move the slider to read values.";
      for (const type of ["pointermove", "pointerdown"])
        this.svg.addEventListener(type, event => this.under(event));
      for (const input of figure.querySelectorAll("[data-key]"))
        input.addEventListener("change", () => this.show());
      this.select(this.group);
    }

    /* which axis the slider moves along */
    choose(row) {
      this.axis = element("select", "", row);
      this.axis.setAttribute("aria-label", "Axis to read along");
      for (const group of this.groups) element("option", "", this.axis).textContent = group;
      this.axis.addEventListener("change", () => { this.select(this.axis.value); this.show(); });
    }

    at() { return columns[this.list.find(p => p.group === this.group).at]; }

    select(group) {
      this.group = group;
      const n = this.at().v.length;
      this.slider.max = n - 1;
      this.slider.value = shown[group] === undefined ? n >> 1 : nearest(this.at().v, shown[group]);
      attributes(this.slider, { "aria-label": "Read the curves at " + group });
      if (this.axis) this.axis.value = group;
    }

    /* the panel that is nearest, above each other first */
    under(event) {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
      const off = (v, from, to) => Math.max(from - v, 0, v - to);
      const far = ({ box: [left, top, right, bottom] }) => 10 * off(at.x, left, right) + off(at.y, top, bottom);
      const panel = this.list.reduce((a, b) => far(b) < far(a) ? b : a);
      if (panel.group !== this.group) this.select(panel.group);
      point(panel.group, place(at.x, [panel.box[0], panel.box[2]], ...panel.x));
    }

    isOn(key) {
      const input = this.figure.querySelector("[data-key=" + key + "]");
      return !input || input.checked;
    }

    show() {
      const x = shown[this.group];
      this.cursor.replaceChildren();
      if (x === undefined) return;
      const parts = this.list.filter(p => p.group === this.group).map(p => this.read(p, x));
      this.output.replaceChildren();
      const first = this.list.find(p => p.group === this.group), i = nearest(this.at().v, x);
      const spans = [where(first, i), ...parts.filter(p => p)];
      spans.forEach((part, k) => {
        const span = element("span", "", this.output);
        (k ? span : element("strong", "", span)).textContent = part;
      });
      this.slider.value = i;
      this.slider.setAttribute("aria-valuetext", spans.join("; "));
    }

    /* "Pressure p: measured 231.10, declared 230.87 kPa", and the marks in the panel */
    read(panel, x) {
      const [left, top, right, bottom] = panel.box, at = columns[panel.at], i = nearest(at.v, x);
      const on = panel.curves.filter(c => this.isOn(c.key)).filter(c => !isNaN(columns[c.of].v[i]));
      const px = place(at.v[i], panel.x, left, right);
      attributes(element("line", "", this.cursor), { x1: px, x2: px, y1: top, y2: bottom });
      for (const curve of on.filter(c => c.key !== "band"))
        attributes(element("circle", "c-" + curve.key, this.cursor),
          { cx: px, cy: place(columns[curve.of].v[i], panel.y, bottom, top), r: 4.5 });
      if (!on.length) return "";
      return panel.name + ": " + on.map(c => (on.length > 1 || panel.curves.length > 1 ? labels[c.key] + " " : "") +
        (c.key === "band" ? "\u00b1" : "") + text(columns[c.of], i)).join(", ") + withUnit(panel.unit);
    }
  }

  const figures = Object.keys(panels).map(name => [document.getElementById("figure-" + name), panels[name]])
    .filter(([figure]) => figure).map(([figure, list]) => new Figure(figure, list));

  function point(group, x) {
    shown[group] = x;
    for (const f of figures)
      if (f.group === group) f.show();
  }
})();
