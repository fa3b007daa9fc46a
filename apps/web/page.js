"use strict";

// Words of a data sheet, as closeloop --init --sheet takes them: key, label, example, what it is.
const SHEET = [
  ["name", "Name", "FV-101", "of the valve"],
  ["bench_set", "Bench set", "0.2..1.0 bar", "pressures at which the stem leaves its stop and reaches the other"],
  ["stroke", "Stroke", "20 mm", "way of the stem between the stops"],
  ["area", "Effective area", "400 cm2", "of the diaphragm or piston"],
  ["fail", "Fails", "close", "close or open: where the spring takes the valve; travel is how far it is open"],
  ["supply", "Supply pressure", "4 bar", "gauge, as the regulator shows it"],
  ["positioner", "Positioner", "samson-3730", "by maker and type, if the catalogue has it"],
  ["Kv", "Else its Kv", "0.1", "m³/h, filling and venting alike"],
  ["dead_volume", "Dead volume", "0.3 dm3", "of the chamber at the lower stop"],
  ["moving_mass", "Moving mass", "5 kg", "of stem, plug and diaphragm plate"],
  ["tube.length", "Length of the tube", "2 m", "from positioner to actuator"],
  ["tube.bore", "Bore of the tube", "6 mm", "inside diameter"],
];
const ROLES = [["fit", "to fit"], ["holdout", "held out, to judge by"], ["baseline", "baseline: as it was before"]];
const SAVES = [["html", "report.html", "text/html"], ["json", "report.json", "application/json"], ["model", "model.cfg", "text/plain"],
  ["residual", "residual.csv", "text/csv"]];

const byId = id => document.getElementById(id);
const textOf = id => byId(id).textContent.trim();
const logs = []; // {name, role, bytes}
let edited = false; // the rig file, by hand or by a file
let job = null; // {worker, kind, timer}
let answer = null;

function make(tag, properties, ...inner) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...inner);
  return element;
}

// ---- Work in a worker ----

const wasm = Uint8Array.from(atob(textOf("wasm")), c => c.charCodeAt(0));
const workerUrl = URL.createObjectURL(new Blob([byId("worker").textContent], { type: "text/javascript" }));

function stop() {
  if (!job) return;
  job.worker.terminate();
  clearInterval(job.timer);
  job = null;
  byId("progress").hidden = true;
  byId("cancel").disabled = true;
  showReady();
}

function say(text) {
  byId("status").textContent = text;
}

function showReady() {
  const fits = logs.some(log => log.role === "fit");
  byId("run").disabled = job !== null || !fits || !byId("rig").value.trim();
  byId("draft").disabled = !fits;
  byId("save-rig").disabled = !byId("rig").value;
}

// Start a job; what ran before ends. done(answer) is called when it is there.
function start(kind, done) {
  const begun = performance.now(), worker = new Worker(workerUrl);
  let doing = kind === "draft" ? "drafting the rig file" : "reading the logs";
  stop();
  const tell = () => say(`${doing} (${Math.round((performance.now() - begun) / 1000)} s)`);
  const fail = text => {
    stop();
    say("");
    byId("error").textContent = text;
  };
  job = { worker, kind, timer: setInterval(tell, 1000) };
  byId("error").textContent = "";
  byId("progress").hidden = false;
  byId("cancel").disabled = false;
  showReady();
  tell();
  worker.onerror = event => fail("The computation broke off: " + event.message);
  worker.onmessage = ({ data }) => {
    if (data.kind === "progress") {
      doing = data.text;
      tell();
    } else if (data.kind === "error") fail(data.text);
    else {
      stop();
      done(data, (performance.now() - begun) / 1000);
    }
  };
  worker.postMessage({ kind, wasm, rig: byId("rig").value, logs, sheet: sheetWords() });
}

// ---- Logs ----

function logItem(log) {
  const role = make("select", { ariaLabel: "What " + log.name + " is for" },
    ...ROLES.map(([value, label]) => make("option", { value, textContent: label, selected: log.role === value })));
  role.onchange = () => { log.role = role.value; showReady(); };
  const remove = make("button", { type: "button", textContent: "Remove", ariaLabel: "Remove " + log.name });
  remove.onclick = () => { logs.splice(logs.indexOf(log), 1); showLogs(); byId("files").focus(); };
  const size = log.bytes.length < 1e6 ? Math.ceil(log.bytes.length / 1000) + " kB" : (log.bytes.length / 1e6).toFixed(1) + " MB";
  return make("li", {}, make("span", { className: "name", textContent: log.name + ", " + size }), role, remove);
}

function showLogs() {
  byId("list").replaceChildren(...logs.map(logItem));
  if (!job) say(logs.length ? "Ready." : "There is no log yet.");
  showReady();
}

// Two files of one name are told apart by a number.
function ownName(name) {
  let own = name;
  for (let i = 2; logs.some(log => log.name === own); i++) own = `${name} (${i})`;
  return own;
}

async function take(files) {
  for (const file of files) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.cfg$/i.test(file.name)) {
      byId("rig").value = new TextDecoder().decode(bytes);
      edited = true;
    } else {
      const role = /hold.?out/i.test(file.name) ? "holdout" : "fit";
      logs.push({ name: ownName(file.name), role, bytes });
    }
  }
  showLogs();
  if (!edited) draft();
}

// ---- The rig file ----

function sheetWords() {
  const words = SHEET.map(([key]) => [key, byId("sheet-" + key).value.trim()]).filter(([, value]) => value);
  const others = byId("sheet-others").value.split("\n").map(line => line.trim()).filter(line => line);
  return words.map(([key, value]) => `${key}=${value}`).concat(others);
}

function draft() {
  const first = logs.find(log => log.role === "fit");
  if (!first) return;
  start("draft", found => {
    byId("rig").value = found.rig;
    edited = false;
    say("The rig file is drafted. Look through it, then close the loop.");
    showReady();
  });
}

function field(key, label, example, note, element) {
  const id = "sheet-" + key, input = Object.assign(element, { id, placeholder: "e.g. " + example });
  input.setAttribute("aria-describedby", id + "-note");
  input.onchange = () => { if (!edited) draft(); };
  return make("div", {}, make("label", { htmlFor: id, textContent: label }), input, make("small", { id: id + "-note", textContent: note }));
}

function showSheet() {
  byId("sheet").append(
    ...SHEET.map(([key, label, example, note]) => field(key, label, example, note, make("input", { type: "text" }))),
    field("others", "Other words", "vent.Kv=0.2", "key=value, one a line, as pneu-rig(5) names them", make("textarea", { rows: 2 })));
  byId("sheet").onsubmit = event => event.preventDefault();
}

// ---- The answer ----

function save(name, text, type) {
  const link = make("a", { download: name, href: URL.createObjectURL(new Blob([text], { type })) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function show(found, seconds) {
  answer = found;
  byId("answer").hidden = false;
  byId("report").srcdoc = found.html;
  say(`Done in ${seconds.toFixed(1)} s.`);
  byId("answer-head").focus();
}

function showSaves() {
  byId("saves").append(...SAVES.map(([key, name, type]) => {
    const button = make("button", { type: "button", textContent: "Save " + name });
    button.onclick = () => save(name, answer[key], type);
    return button;
  }));
}

// ---- Begin ----

const drop = byId("drop");
// A file that misses the field must not take the place of the page.
for (const kind of ["dragover", "drop"]) document.addEventListener(kind, event => event.preventDefault());
document.addEventListener("dragover", () => drop.classList.add("over"));
document.addEventListener("dragleave", event => { if (!event.relatedTarget) drop.classList.remove("over"); });
document.addEventListener("drop", event => { drop.classList.remove("over"); take(event.dataTransfer.files); });
byId("files").onchange = event => { take([...event.target.files]); event.target.value = ""; };
byId("rig").oninput = () => { edited = true; showReady(); };
byId("draft").onclick = draft;
byId("save-rig").onclick = () => save("rig.cfg", byId("rig").value, "text/plain");
byId("run").onclick = () => start("closeloop", show);
byId("cancel").onclick = () => { stop(); say("Cancelled."); };
showSheet();
showSaves();
showReady();
