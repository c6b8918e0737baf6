
// Moving the camera: drags, fingers, wheel and keys become requests, one at a time; what happens meanwhile
// is added up. The server answers once it has a picture.
let tool = "orbit", wanted = [], isAsking = false, shownCamera = null;

function request(move) {
  const last = wanted[wanted.length - 1];
  if (last && last.move === move.move && !move.begin && "by" in move) last.by += move.by;
  else if (last && last.move === move.move && !move.begin && ["orbit", "pan"].includes(move.move)) {
    last.x += move.x; last.y += move.y;
  } else if (last && last.move === move.move && "to" in move) last.to = move.to;
  else wanted.push(move);
  send();
}

async function send() {
  if (isAsking || !wanted.length) return;
  isAsking = true;
  const move = wanted.shift(), started = performance.now();
  try {
    const answer = await fetch(`camera?${new URLSearchParams(move)}`, { method: "POST" });
    if (!answer.ok) write("copied", await answer.text());
    live.dataset.answered = performance.now() - started;
    live.dataset.moves = +(live.dataset.moves || 0) + 1;
  } catch (e) { /* the next state tells that the server has gone */ }
  isAsking = false;
  await refresh();
  send();
}

// The picture of the move, even if the page is asking already
async function refresh() {
  while (polling) await new Promise(r => setTimeout(r, 5));
  await poll();
}

function cameraFigures(state, words) {
  const c = state.camera;
  words.rendering = state.samples ? "refining" : "a first picture";
  words.done = "done: move on, or write the camera";
  shownCamera = c;
  byId("stop").hidden = byId("keep").hidden = true;
  const edits = id => document.activeElement === byId(id);
  for (const id of ["fov", "lens"]) {
    byId(id).disabled = c[id] === null;
    if (c[id] !== null && !edits(id)) byId(id).value = c[id];
  }
  for (const b of document.querySelectorAll(".tool[data-tool=focus]")) b.disabled = c.focus === null;
  write("fovtext", c.fov === null ? "–" : `${+c.fov.toFixed(2)}°`);
  write("focustext", c.focus === null || c.lens === 0 && !c.focus ? "everything" : `${+c.focus.toPrecision(6)}`);
  write("remarks", [...c.remarks, ...(c.problem ? [c.problem] : [])].join("; "));
  const form = byId("form");
  if (c.native && form.options.length === 1) {
    form.prepend(new Option(c.native.title, "native")); form.value = "native";
  }
  write("cameratext", form.value === "native" ? c.native.text : c.statements);
  live.dataset.complete = state.stage === "done";
  live.dataset.samples = state.samples;
}

function choose(name) {
  const button = document.querySelector(`.tool[data-tool=${name}]`);
  if (button.disabled) return;
  tool = name;
  for (const b of document.querySelectorAll(".tool")) b.setAttribute("aria-pressed", b === button);
}

// Takes what happens on the picture before the image's own zoom and pan get it; `part` maps a place on the
// canvas to the image
function mover(stage, part) {
  const canvas = stage.querySelector("canvas"), fingers = new Map();
  stage.dataset.moving = "yes";
  let held = null, pinch = null;
  const place = e => {
    const box = canvas.getBoundingClientRect();
    return { x: (e.clientX - box.left) / box.width, y: (e.clientY - box.top) / box.height };
  };
  const two = () => {
    const [a, b] = fingers.values();
    const box = canvas.getBoundingClientRect();
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2,
      size: Math.hypot((a.x - b.x) * box.width, (a.y - b.y) * box.height) };
  };
  const take = e => { e.stopPropagation(); e.preventDefault(); };
  stage.addEventListener("contextmenu", e => e.preventDefault());
  stage.addEventListener("pointerdown", e => {
    if (e.target !== canvas) return;
    take(e); stage.focus({ preventScroll: true });
    canvas.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, place(e));
    if (fingers.size === 2) { pinch = two(); held = null; }
    else if (fingers.size === 1) {
      const pans = e.shiftKey || e.button > 0 || tool === "pan";
      held = { ...place(e), kind: pans ? "pan" : "orbit", begin: true, moved: false };
    }
  }, true);
  stage.addEventListener("pointermove", e => {
    if (!fingers.has(e.pointerId)) return;
    take(e);
    const now = place(e);
    fingers.set(e.pointerId, now);
    if (pinch && fingers.size === 2) {
      const next = two();
      request({ move: "pan", x: next.x - pinch.x, y: next.y - pinch.y });
      if (next.size > 0 && pinch.size > 0)
        request({ move: "dolly", by: Math.log(next.size / pinch.size) / Math.log(1 / 0.9) });
      pinch = next;
    } else if (held) {
      const [dx, dy] = [now.x - held.x, now.y - held.y], box = canvas.getBoundingClientRect();
      held.moved ||= Math.hypot(dx * box.width, dy * box.height) > 3;
      if (!held.moved) return;
      const move = { move: held.kind, x: dx, y: dy };
      if (held.begin && held.kind === "orbit") move.begin = 1;
      held = { ...held, ...now, begin: false };
      request(move);
    }
  }, true);
  const lift = e => {
    if (!fingers.delete(e.pointerId)) return;
    take(e);
    if (held && !held.moved && e.type === "pointerup" && ["aim", "focus"].includes(tool))
      request({ move: tool, ...inside(place(e)) });
    held = null;
    if (fingers.size < 2) pinch = null;
  };
  const clamped = x => Math.min(1, Math.max(0, x));
  const inside = p => { const at = part(p.x, p.y); return { x: clamped(at.x), y: clamped(at.y) }; };
  stage.addEventListener("pointerup", lift, true);
  stage.addEventListener("pointercancel", lift, true);
  stage.addEventListener("dblclick", e => { take(e); request({ move: "aim", ...inside(place(e)) }); }, true);
  stage.addEventListener("wheel", e => {
    // Ctrl is left to the image's own zoom
    if (e.ctrlKey || e.metaKey) return;
    take(e);
    const steps = -Math.sign(e.deltaY || e.deltaX);
    if (e.altKey) changeFov(-steps * 2); else request({ move: "dolly", by: steps });
  }, { capture: true, passive: false });
  const by = (move, x, y) => () => request({ move, x, y });
  return { keys: {
    ArrowLeft: by("orbit", -0.04, 0), ArrowRight: by("orbit", 0.04, 0),
    ArrowUp: by("orbit", 0, -0.04), ArrowDown: by("orbit", 0, 0.04),
    a: by("pan", 0.05, 0), d: by("pan", -0.05, 0), w: by("pan", 0, 0.05), s: by("pan", 0, -0.05),
    "+": () => request({ move: "dolly", by: 1 }), "=": () => request({ move: "dolly", by: 1 }),
    "-": () => request({ move: "dolly", by: -1 }),
    "[": () => changeFov(-2), "]": () => changeFov(2),
    o: () => choose("orbit"), p: () => choose("pan"), k: () => choose("aim"), f: () => choose("focus"),
    r: () => request({ move: "reset" }),
  } };
}

function changeFov(by) {
  if (!shownCamera || shownCamera.fov === null) return;
  shownCamera.fov = Math.min(179, Math.max(0.1, shownCamera.fov + by));
  request({ move: "fov", to: shownCamera.fov });
}

for (const b of document.querySelectorAll(".tool")) b.addEventListener("click", () => choose(b.dataset.tool));
byId("fov").addEventListener("input", e => request({ move: "fov", to: +e.target.value }));
byId("lens").addEventListener("change", e => request({ move: "lens", to: Math.max(0, +e.target.value) }));
byId("reset").addEventListener("click", () => request({ move: "reset" }));
byId("form").addEventListener("change", () => poll());
byId("copy").addEventListener("click", async () => {
  const text = byId("cameratext");
  try { await navigator.clipboard.writeText(text.textContent); write("copied", "copied"); }
  catch (e) {
    // Without a secure connection, browsers have no clipboard: the text is selected
    getSelection().selectAllChildren(text);
    write("copied", document.execCommand("copy") ? "copied" : "selected: copy it");
  }
});
