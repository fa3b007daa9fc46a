/* Search, filter and sort the lines. Only those that can be seen are in the page; without this script all are. */
(() => {
  const PAGE = 200;
  const $ = id => document.getElementById(id);
  const table = $("lines"), body = table.tBodies[0], heads = [...table.tHead.rows[0].cells];
  const NUMBERS = [5, 6, 7, 8], VERDICT = 1, FOUND = 2, BEFORE = 5;
  const lines = [...body.rows].map((row, place) => {
    const cell = [...row.cells].map(c => c.textContent);
    const key = cell.map((text, c) => NUMBERS.includes(c) ? parseFloat(text) : text.toLowerCase());
    return { row, place, cell, key, all: cell.join("\n").toLowerCase() };
  });
  let matching = lines, shown = 0, sorted = { column: -1, down: false };

  /* empty cells last, both ways */
  function compare(a, b, column, down) {
    const x = a.key[column], y = b.key[column];
    const gone = v => v === "" || Number.isNaN(v);
    if (gone(x) || gone(y)) return gone(x) - gone(y) || a.place - b.place;
    const way = x < y ? -1 : x > y ? 1 : 0;
    return (down ? -way : way) || a.place - b.place;
  }

  function more() {
    const next = matching.slice(shown, shown + PAGE);
    body.append(...next.map(line => line.row));
    shown += next.length;
    $("more").hidden = shown >= matching.length;
  }

  function show() {
    const words = $("search").value.toLowerCase().split(/\s+/).filter(w => w);
    const verdict = $("verdict").value, found = $("found").value, least = parseFloat($("least").value);
    matching = lines.filter(line => (!verdict || line.cell[VERDICT] === verdict) &&
      (!found || line.cell[FOUND].split(" + ").includes(found)) &&
      (Number.isNaN(least) || line.key[BEFORE] >= least) && words.every(w => line.all.includes(w)));
    if (sorted.column >= 0) matching.sort((a, b) => compare(a, b, sorted.column, sorted.down));
    heads.forEach((head, c) => c === sorted.column ?
      head.setAttribute("aria-sort", sorted.down ? "descending" : "ascending") : head.removeAttribute("aria-sort"));
    $("sort").value = sorted.column;
    $("count").textContent = matching.length + " of " + lines.length + " lines";
    body.replaceChildren();
    shown = 0;
    more();
  }

  /* numbers begin with the largest */
  function sort(column) {
    sorted = { column, down: column === sorted.column ? !sorted.down : NUMBERS.includes(column) };
    show();
  }

  function option(select, value, text) {
    const o = document.createElement("option");
    o.value = value;
    o.textContent = text;
    $(select).append(o);
  }

  function count(values) {
    const n = new Map();
    for (const v of values) n.set(v, (n.get(v) || 0) + 1);
    return n;
  }

  for (const [verdict, n] of count(lines.map(line => line.cell[VERDICT]))) option("verdict", verdict, verdict + " (" + n + ")");
  for (const [found, n] of [...count(lines.flatMap(line => line.cell[FOUND].split(" + ")).filter(f => f))].sort((a, b) => b[1] - a[1]))
    option("found", found, found + " (" + n + ")");
  option("sort", -1, "severity");
  heads.forEach((head, c) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = head.textContent;
    button.addEventListener("click", () => sort(c));
    head.replaceChildren(button);
    option("sort", c, button.textContent);
  });
  $("sort").addEventListener("change", () => { sorted.column = -2; sort(Number($("sort").value)); });
  for (const id of ["search", "verdict", "found", "least"]) $(id).addEventListener("input", show);
  $("controls").addEventListener("reset", () => { sorted = { column: -1, down: false }; setTimeout(show); });
  $("controls").addEventListener("submit", event => event.preventDefault());
  $("more").addEventListener("click", more);
  new IntersectionObserver(seen => { if (seen.some(s => s.isIntersecting) && !$("more").hidden) more(); }).observe($("more"));
  $("controls").hidden = false;
  show();
  table.className = "ready";
})();
