// One job of the page: {wasm, kind: "draft", "simulate" or "closeloop", rig, logs: [{name, role, bytes}], sheet: ["key=value"]}.
// Answers {kind: "progress", text}, then {kind: "done", ...} or {kind: "error", text}.
"use strict";

const ROLES = { rig: 0, fit: 1, holdout: 2, baseline: 3 };
const ANSWERS = ["sentence", "json", "html", "model", "residual", "rig", "prediction"];

// Copies into the module's memory, where they stay: the worker ends with its job.
function copyText(lab, text) {
  const size = lab.lengthBytesUTF8(text) + 1, at = lab._malloc(size);
  lab.stringToUTF8(text, at, size);
  return at;
}

function copyBytes(lab, bytes) {
  const at = lab._malloc(bytes.length + 1);
  lab.HEAPU8.set(bytes, at);
  return at;
}

function give(lab, role, name, bytes) {
  return lab._web_give(ROLES[role], copyText(lab, name), copyBytes(lab, bytes), bytes.length);
}

function ask(lab, job) {
  let status = 0;
  if (job.kind !== "draft") status = give(lab, "rig", "rig.cfg", new TextEncoder().encode(job.rig));
  for (const log of job.logs) status = status || give(lab, log.role, log.name, log.bytes);
  for (const word of job.sheet) status = status || lab._web_say(copyText(lab, word));
  return status || lab["_web_" + job.kind]();
}

self.onmessage = async ({ data: job }) => {
  try {
    const lab = await makeLab({ wasmBinary: job.wasm });
    if (ask(lab, job) !== 0) {
      self.postMessage({ kind: "error", text: lab.UTF8ToString(lab._web_error()) });
      return;
    }
    const answer = { kind: "done" };
    ANSWERS.forEach((name, i) => {
      const text = lab._web_answer(i);
      if (text) answer[name] = lab.UTF8ToString(text);
    });
    self.postMessage(answer);
  } catch (fault) {
    self.postMessage({ kind: "error", text: "The computation broke off: " + fault });
  }
};
