"use strict";
// The URL fragment sets the initial view, which makes views shareable:
// #theme=dark&chart=flip&axis=samples&mode=slider&a=…&b=…&metric=mae&ev=1.5&x=10&y=20
const asked = new URLSearchParams(location.hash.slice(1));

function press(group, button) {
  for (const b of group.querySelectorAll("button")) b.setAttribute("aria-pressed", b === button);
}

function theme(name) { document.documentElement.dataset.theme = name; }
if (asked.get("theme")) theme(asked.get("theme"));
document.querySelector("#theme").addEventListener("click", () => {
  const dark = getComputedStyle(document.documentElement).colorScheme === "dark" ||
    (!document.documentElement.dataset.theme && matchMedia("(prefers-color-scheme:dark)").matches);
  theme(dark ? "light" : "dark");
});

// Charts: one per metric and axis; the buttons select the visible one.
function charts(part) {
  const state = { chart: asked.get("chart"), axis: asked.get("axis") };
  const all = [...part.querySelectorAll(".chart")];
  const known = key => all.some(c => c.dataset[key] === state[key]);
  for (const key of ["chart", "axis"]) if (!known(key)) state[key] = all[0].dataset[key];
  const show = () => {
    for (const c of all) c.hidden = c.dataset.chart !== state.chart || c.dataset.axis !== state.axis;
    for (const b of part.querySelectorAll("button[data-key]"))
      b.setAttribute("aria-pressed", state[b.dataset.key] === b.dataset.value);
  };
  for (const b of part.querySelectorAll("button[data-key]"))
    b.addEventListener("click", () => {
      state[b.dataset.key] = b.dataset.value; asked.set(b.dataset.key, b.dataset.value); show();
    });
  show();
}
for (const part of document.querySelectorAll(".charts")) charts(part);

async function unpacked(base64) {
  const packed = Uint8Array.from(atob(base64), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function floats(base64) {
  const bytes = await unpacked(base64), n = bytes.length / 3, bits = new Uint32Array(n);
  for (let i = 0; i < n; i++)
    bits[i] = (bytes[i] << 24 | bytes[n + i] << 16 | bytes[2 * n + i] << 8) >>> 0;
  return new Float32Array(bits.buffer);
}

const encode = v => v <= 0.0031308 ? 12.92 * v : 1.055 * Math.pow(v, 1 / 2.4) - 0.055;
const Codes = Uint8ClampedArray.from({ length: 4097 }, (_, i) => 255 * encode(i / 4096));
const short = v => v === 0 ? "0" : Math.abs(v) >= 1e-3 && Math.abs(v) < 1e5 ? v.toPrecision(4) : v.toExponential(3);

const Unpointed = "point at a pixel, or use arrow keys";

// Per-channel errors; the FLIP map is precomputed by the program.
const Errors = {
  relmse: (a, b) => { const r = (a - b) / (b + 0.01); return isFinite(r) ? r * r : 0; },
  mse: (a, b) => (a - b) * (a - b),
  mae: (a, b) => Math.abs(a - b),
};

// Zoom by wheel, buttons and keys, pan by dragging, the pixel under the pointer or moved by arrows: s has
// zoom, left, top, x, y, and held while the pointer is down. `pans` tells whether a drag moves the image;
// `clicked` is called without one; `keys` are further ones, by name. `isOnly`: the page has no other
// picture, and letters need no focus.
function navigate(stage, width, height, s, draw, { pans = () => true, clicked = () => {}, keys = {}, isOnly }) {
  const canvas = stage.querySelector("canvas"), hint = stage.querySelector(".hint"), root = stage.parentElement;
  const pixelOf = event => {
    const box = canvas.getBoundingClientRect();
    return [s.left + (event.clientX - box.left) / box.width * width / s.zoom,
            s.top + (event.clientY - box.top) / box.height * height / s.zoom];
  };
  const keepInside = () => {
    s.left = Math.min(Math.max(0, s.left), width - width / s.zoom);
    s.top = Math.min(Math.max(0, s.top), height - height / s.zoom);
  };
  const zoomAt = (x, y, factor) => {
    const before = s.zoom;
    s.zoom = Math.min(64, Math.max(1, s.zoom * factor));
    s.left = x - (x - s.left) * before / s.zoom; s.top = y - (y - s.top) * before / s.zoom;
    // A finger moves the page, until there is something to move in the image
    stage.dataset.zoomed = s.zoom > 1;
    keepInside(); draw();
  };
  canvas.addEventListener("pointerdown", e => {
    s.held = { x: e.clientX, y: e.clientY, moved: false };
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointermove", e => {
    const box = canvas.getBoundingClientRect(), held = s.held;
    if (held && pans()) {
      held.moved ||= Math.hypot(e.clientX - held.x, e.clientY - held.y) > 3;
      if (held.moved) {
        s.left -= (e.clientX - held.x) / box.width * width / s.zoom;
        s.top -= (e.clientY - held.y) / box.height * height / s.zoom;
        held.x = e.clientX; held.y = e.clientY; keepInside();
      }
    }
    [s.x, s.y] = pixelOf(e).map(Math.floor);
    draw();
  });
  canvas.addEventListener("pointerup", () => {
    if (s.held && pans() && !s.held.moved) clicked();
    s.held = null;
  });
  canvas.addEventListener("pointercancel", () => { s.held = null; });
  // The wheel is the page's, unless the picture has the focus and can follow, or a key asks for it
  let hiding = null;
  const hide = () => { hint.hidden = true; };
  canvas.addEventListener("wheel", e => {
    const isAsked = e.ctrlKey || e.metaKey, isFocused = document.activeElement === stage;
    if (isAsked || isFocused && (s.zoom > 1 || e.deltaY < 0)) {
      e.preventDefault(); hide();
      zoomAt(...pixelOf(e), Math.pow(1.2, -Math.sign(e.deltaY)));
    } else if (!isFocused) {
      hint.hidden = false; clearTimeout(hiding); hiding = setTimeout(hide, 1500);
    }
  }, { passive: false });
  const whole = () => { s.left = s.top = 0; zoomAt(0, 0, 1 / 64); };
  canvas.addEventListener("dblclick", whole);

  function move(dx, dy) {
    const clamp = (v, n) => Math.min(n - 1, Math.max(0, v));
    s.x = s.x < 0 ? width >> 1 : clamp(s.x + dx, width);
    s.y = s.y < 0 ? height >> 1 : clamp(s.y + dy, height);
    const w = width / s.zoom, h = height / s.zoom;
    if (s.x < s.left || s.x >= s.left + w) s.left = s.x - w / 2;
    if (s.y < s.top || s.y >= s.top + h) s.top = s.y - h / 2;
    keepInside(); draw();
  }
  const middle = () => s.x >= 0 && s.y >= 0 ? [s.x + 0.5, s.y + 0.5]
    : [s.left + width / s.zoom / 2, s.top + height / s.zoom / 2];
  const zooms = { in: () => zoomAt(...middle(), 1.5), out: () => zoomAt(...middle(), 1 / 1.5), whole };
  for (const b of root.querySelectorAll("[data-zoom]")) b.addEventListener("click", zooms[b.dataset.zoom]);
  document.addEventListener("keydown", e => {
    const isFocused = document.activeElement === stage;
    const isMeant = isFocused || isOnly && !e.key.startsWith("Arrow") &&
      e.target.tagName !== "SELECT" && e.target.type !== "number";
    if (!isMeant || e.ctrlKey || e.metaKey || e.altKey) return;
    const far = e.shiftKey ? 10 : 1;
    const all = {
      "+": zooms.in, "=": zooms.in, "-": zooms.out, "0": whole,
      ArrowLeft: () => move(-far, 0), ArrowRight: () => move(far, 0),
      ArrowUp: () => move(0, -far), ArrowDown: () => move(0, far), ...keys,
    };
    if (Object.hasOwn(all, e.key)) { e.preventDefault(); all[e.key](); }
  });
  // Values are read out to those who move the cursor by keys
  const readout = root.querySelector(".readout");
  stage.addEventListener("focus", () => readout.setAttribute("aria-live", "polite"));
  stage.addEventListener("blur", () => readout.removeAttribute("aria-live"));
  canvas.width = Math.max(width, Math.min(1600, Math.ceil(1000 / width) * width));
  canvas.height = Math.round(canvas.width * height / width);
}

async function viewer(root) {
  const data = JSON.parse(root.querySelector("script[type='application/json']").textContent);
  const { width, height, magma } = data;
  const pictures = await Promise.all(data.pictures.map(async p => ({
    name: p.name, isReference: p.isReference, data: await floats(p.data),
    flip: p.flip ? await unpacked(p.flip) : null,
  })));
  const reference = pictures.find(p => p.isReference);
  const find = s => root.querySelector(s), canvas = find("canvas"), context = canvas.getContext("2d");
  const named = (name, other) => Math.max(0, pictures.findIndex(p => p.name === name) + 1 || other + 1) - 1;
  const s = {
    a: named(asked.get("a"), 0), b: named(asked.get("b"), pictures.length - 1),
    mode: asked.get("mode") || "slider", metric: asked.get("metric") || "relmse",
    ev: +asked.get("ev") || 0, split: 0.5, zoom: 1, left: 0, top: 0, flipped: false,
    x: asked.has("x") ? +asked.get("x") : -1, y: asked.has("y") ? +asked.get("y") : -1,
  };
  const layers = [0, 1].map(() => Object.assign(document.createElement("canvas"), { width, height }));

  function paintPicture(layer, picture) {
    const gain = 4096 * Math.pow(2, s.ev), c = layer.getContext("2d"), out = c.createImageData(width, height);
    for (let i = 0, o = 0; i < 3 * width * height; i += 3, o += 4) {
      for (let k = 0; k < 3; k++) {
        const v = picture.data[i + k] * gain;
        out.data[o + k] = v > 0 ? Codes[v < 4096 ? v | 0 : 4096] : 0;
      }
      out.data[o + 3] = 255;
    }
    c.putImageData(out, 0, 0);
  }

  function errorAt(picture, i) {
    if (s.metric === "flip") return picture.flip[i] / 255;
    let sum = 0;
    for (let k = 0; k < 3; k++) sum += Errors[s.metric](picture.data[3 * i + k], reference.data[3 * i + k]);
    return sum / 3;
  }

  function paintErrors(layer, picture) {
    const n = width * height, errors = new Float32Array(n), c = layer.getContext("2d");
    let sum = 0;
    for (let i = 0; i < n; i++) sum += errors[i] = errorAt(picture, i);
    const most = s.metric === "flip" ? 1 : Float32Array.from(errors).sort()[Math.floor(n * 0.99)] || 1e-9;
    const top = most * Math.pow(2, -s.ev), out = c.createImageData(width, height);
    for (let i = 0; i < n; i++) {
      const place = Math.min(1, errors[i] / top) * (magma.length - 1), at = Math.min(magma.length - 2, place | 0);
      for (let k = 0; k < 3; k++) {
        const low = magma[at] >> (16 - 8 * k) & 255, high = magma[at + 1] >> (16 - 8 * k) & 255;
        out.data[4 * i + k] = low + (high - low) * (place - at);
      }
      out.data[4 * i + 3] = 255;
    }
    c.putImageData(out, 0, 0);
    find(".most").textContent = short(top);
    find(".mean").textContent = `mean ${short(sum / n)}`;
    root.dataset.mean = sum / n;
  }

  function repaint() {
    const [a, b] = [pictures[s.a], pictures[s.b]];
    const heat = s.mode === "heat" && reference && (s.metric !== "flip" || a.flip);
    if (heat) paintErrors(layers[0], a); else { paintPicture(layers[0], a); paintPicture(layers[1], b); }
    for (const e of root.querySelectorAll(".heat")) e.hidden = !heat;
    find(".evtext").textContent = `${s.ev >= 0 ? "+" : ""}${s.ev.toFixed(1)} EV`;
    press(find(".modes"), find(`.modes [data-mode=${s.mode}]`));
    draw();
  }

  function draw() {
    const scale = canvas.width / width * s.zoom;
    const put = layer => context.drawImage(layer, -s.left * scale, -s.top * scale, width * scale, height * scale);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.imageSmoothingEnabled = false;
    context.clearRect(0, 0, canvas.width, canvas.height);
    const two = s.mode === "slider", second = s.mode === "flip" && s.flipped;
    put(layers[second ? 1 : 0]);
    if (two) {
      const x = s.split * canvas.width;
      context.save(); context.beginPath(); context.rect(x, 0, canvas.width - x, canvas.height); context.clip();
      put(layers[1]); context.restore();
      context.fillStyle = "#fff"; context.fillRect(x - 1, 0, 2, canvas.height);
    }
    if (s.x >= 0) {
      context.strokeStyle = "#0ff"; context.lineWidth = 2;
      context.strokeRect((s.x - s.left) * scale - 1, (s.y - s.top) * scale - 1, Math.max(3, scale) + 2, Math.max(3, scale) + 2);
    }
    find(".left").textContent = s.mode === "heat" ? `error of ${pictures[s.a].name}` : pictures[second ? s.b : s.a].name;
    find(".right").textContent = two ? pictures[s.b].name : "";
    root.dataset.ready = `${s.mode} ${s.metric}`;
    readOut();
  }

  function readOut() {
    if (!(s.x >= 0 && s.x < width && s.y >= 0 && s.y < height)) { find(".readout").textContent = Unpointed; return; }
    const i = s.y * width + s.x, text = p => [0, 1, 2].map(k => short(p.data[3 * i + k]).padStart(10)).join(" ");
    const lines = [...new Set([pictures[s.a], pictures[s.b]])].map(p => `${p.name.padEnd(24)} ${text(p)}`);
    const a = pictures[s.a];
    if (reference && a !== reference)
      for (const m of ["relmse", ...(a.flip ? ["flip"] : [])]) {
        const kept = s.metric; s.metric = m; lines.push(`${m.padEnd(24)} ${short(errorAt(a, i)).padStart(10)}`); s.metric = kept;
      }
    find(".readout").textContent = `pixel (${s.x}, ${s.y})\n${lines.join("\n")}`;
  }

  canvas.addEventListener("pointerdown", e => {
    const box = canvas.getBoundingClientRect(), at = (e.clientX - box.left) / box.width;
    s.splits = s.mode === "slider" && Math.abs(at - s.split) < 0.04;
  });
  canvas.addEventListener("pointermove", e => {
    const box = canvas.getBoundingClientRect();
    if (s.held && s.splits) s.split = Math.min(1, Math.max(0, (e.clientX - box.left) / box.width));
  });
  const flip = () => {
    if (s.mode === "flip") { s.flipped = !s.flipped; draw(); } else { s.mode = "flip"; repaint(); }
  };
  const split = by => { s.split = Math.min(1, Math.max(0, s.split + by)); draw(); };
  const expose = by => { s.ev = Math.min(6, Math.max(-6, s.ev + by)); ev.value = s.ev; repaint(); };
  navigate(find(".stage"), width, height, s, draw, {
    pans: () => !s.splits, clicked: () => { if (s.mode === "flip") flip(); },
    keys: { ",": () => split(-0.05), ".": () => split(0.05), f: flip, e: () => expose(0.5), E: () => expose(-0.5) },
  });

  for (const key of ["a", "b"]) {
    const select = find(`select.${key}`);
    pictures.forEach((p, i) => select.add(new Option(p.name, i)));
    select.value = s[key];
    select.addEventListener("change", () => { s[key] = +select.value; repaint(); });
  }
  const metric = find("select.metric"), ev = find("input.ev");
  metric.value = s.metric; ev.value = s.ev;
  metric.addEventListener("change", () => { s.metric = metric.value; s.mode = "heat"; repaint(); });
  ev.addEventListener("input", () => { s.ev = +ev.value; repaint(); });
  for (const b of root.querySelectorAll(".modes button"))
    b.addEventListener("click", () => {
      if (b.dataset.mode === "flip" && s.mode === "flip") flip();
      else { s.mode = b.dataset.mode; repaint(); }
    });
  repaint();
}

for (const root of document.querySelectorAll(".viewer"))
  viewer(root).catch(e => { root.dataset.failed = e; root.querySelector(".readout").textContent = `the pictures can't be shown: ${e}`; });
