
// The live page: asks the server how far the rendering is, and for the image when it has changed.
// #layer=…&curve=filmic&ev=1&x=10&y=20 sets the initial view, beside the theme and the chart.
const byId = id => document.getElementById(id), live = byId("live");
// Sets a text only if it changes, since browsers paint anew what is set
const write = (id, text) => { if (byId(id).textContent !== text) byId(id).textContent = text; };
let waited = 0; // for the server, in milliseconds
async function ask(what) {
  const began = performance.now();
  try { return await fetch(what); } finally { waited += performance.now() - began; }
}
const me = Math.random().toString(36).slice(2);

// By name: what they do to a channel, at the places √(v / (1 + v)) of its values v; the matrices before
// and after, and a power
const { curves: ToneCurves, luminance: Luminance } = JSON.parse(byId("display").textContent);

// Writes the display codes of linear sRGB at c to out
function displays(curve) {
  const { table, mixing, power } = ToneCurves[curve], n = table.length - 1, m = Float32Array.of(0, 0, 0);
  // Of what is toned: at the place v / (1 + v) of 16384
  const toned = Float32Array.from({ length: 16385 }, (_, i) => {
    const place = Math.sqrt(i / 16384) * n, at = Math.min(n - 1, place | 0);
    return table[at] + (table[at + 1] - table[at]) * (place - at);
  });
  // Of what is shown: at the place √v of 4096; the array rounds
  const codes = Uint8ClampedArray.from({ length: 4097 }, (_, i) =>
    255 * encode(Math.pow((i / 4096) ** 2, power)));
  const tone = v => v > 0 ? toned[v === Infinity ? 16384 : 16384 * v / (1 + v) + 0.5 | 0] : toned[0];
  const code = v => v > 0 ? codes[v < 1 ? 4096 * Math.sqrt(v) + 0.5 | 0 : 4096] : 0;
  const row = (a, k, c) => a[k] * c[0] + a[k + 1] * c[1] + a[k + 2] * c[2];
  return (c, out, o) => {
    for (let k = 0; k < 3; k++) m[k] = tone(mixing ? row(mixing[0], 3 * k, c) : c[k]);
    for (let k = 0; k < 3; k++) out[o + k] = code(mixing ? row(mixing[1], 3 * k, m) : m[k]);
  };
}

// Mixes colours with negative components with the grey of their luminance, as pictures do
function inGamut(c) {
  const least = Math.min(c[0], c[1], c[2]);
  if (!(least < 0)) return;
  const y = Luminance[0] * c[0] + Luminance[1] * c[1] + Luminance[2] * c[2];
  const share = y > 0 ? y / (y - least) : 0;
  for (let k = 0; k < 3; k++) c[k] = y > 0 ? Math.max(0, y + (c[k] - y) * share) : 0;
}

const clock = seconds => {
  const s = Math.round(seconds), two = n => String(n).padStart(2, "0");
  return seconds < 60 ? `${seconds.toFixed(1)} s` : s < 3600 ? `${s / 60 | 0}:${two(s % 60)}`
    : `${s / 3600 | 0}:${two((s / 60 | 0) % 60)}:${two(s % 60)}`;
};
const metric = n => n >= 1e9 ? `${(n / 1e9).toPrecision(3)} G` : n >= 1e6 ? `${(n / 1e6).toPrecision(3)} M`
  : n >= 1e3 ? `${(n / 1e3).toPrecision(3)} k` : n.toPrecision(3);

function liveView(size) {
  const { width, height } = size, canvas = live.querySelector("canvas"), context = canvas.getContext("2d");
  const stage = live.querySelector(".stage"), readout = live.querySelector(".readout");
  const number = (key, other) => asked.has(key) ? +asked.get(key) : other;
  const s = { zoom: 1, left: 0, top: 0, x: number("x", -1), y: number("y", -1), held: null,
    ev: number("ev", 0), curve: asked.get("curve") in ToneCurves ? asked.get("curve") : "linear",
    layer: asked.get("layer") || "", version: -1, points: 0, tiles: [] };
  const pixels = Object.assign(document.createElement("canvas"), { width, height });
  const paper = pixels.getContext("2d");
  // While the camera moves, pictures are smaller than the image
  let [wide, high] = [width, height], out = paper.createImageData(wide, high);
  let titles = {}; // of the layers, by name
  let data = null, channels = 3, matrix = null, display = displays(s.curve), asking = null;

  function paint() {
    if (!data) return;
    const gain = Math.pow(2, s.ev), n = wide * high, last = channels - 1, c = new Float32Array(3);
    const isColor = s.layer === "color";
    for (let i = 0, o = 0; i < n; i++, o += 4) {
      for (let k = 0; k < 3; k++) {
        const at = i * channels, m = 3 * k;
        const light = matrix
          ? matrix[m] * data[at] + matrix[m + 1] * data[at + 1] + matrix[m + 2] * data[at + 2]
          : data[at + (k < last ? k : last)];
        c[k] = light * gain;
      }
      if (isColor) inGamut(c);
      display(c, out.data, o);
      out.data[o + 3] = 255;
    }
    paper.putImageData(out, 0, 0);
    byId("evtext").textContent = `${s.ev >= 0 ? "+" : ""}${s.ev.toFixed(1)} EV`;
    draw();
  }

  function draw() {
    const scale = canvas.width / width * s.zoom, at = (x, y) => [(x - s.left) * scale, (y - s.top) * scale];
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.imageSmoothingEnabled = false;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.drawImage(pixels, ...at(0, 0), width * scale, height * scale);
    context.lineWidth = 2;
    if (byId("showtiles").checked) {
      context.strokeStyle = "#fb0";
      for (const [x0, y0, x1, y1] of s.tiles)
        context.strokeRect(...at(x0, y0), (x1 - x0) * scale, (y1 - y0) * scale);
    }
    const [x, y] = at(s.x, s.y), side = Math.max(3, scale) + 2;
    if (s.x >= 0) { context.strokeStyle = "#0ff"; context.strokeRect(x - 1, y - 1, side, side); }
    if (`${s.x} ${s.y}` !== live.dataset.cursor) readOut();
  }

  // The values come from the server: all layers, as exact as the file.
  function readOut() {
    live.dataset.cursor = `${s.x} ${s.y}`;
    if (!(s.x >= 0 && s.x < width && s.y >= 0 && s.y < height)) {
      readout.textContent = Unpointed;
    } else {
      clearTimeout(asking);
      asking = setTimeout(async () => {
        const [x, y, version] = [s.x, s.y, s.version];
        try {
          const [px, py] = [x * wide / width | 0, y * high / height | 0];
          const rows = await (await fetch(`pixel?x=${px}&y=${py}`)).json();
          const text = v => (v === null ? "–" : short(v)).padStart(10);
          const title = r => titles[r.layer] || r.layer;
          const column = Math.max(18, ...rows.map(r => title(r).length));
          readout.textContent = `pixel (${x + size.x0}, ${y + size.y0})\n` +
            rows.map(r => `${title(r).padEnd(column)} ${r.values.map(text).join(" ")}`).join("\n");
          live.dataset.pixel = JSON.stringify({ x, y, version, rows });
        } catch (e) { /* the next state tells that the server has gone */ }
      }, 40);
    }
  }

  async function load(state) {
    const answer = await ask(`image?layer=${encodeURIComponent(s.layer)}`);
    if (!answer.ok) return;
    channels = +answer.headers.get("X-Channels");
    const toSrgb = answer.headers.get("X-To-Srgb");
    matrix = toSrgb && toSrgb.split(",").map(Number);
    data = new Float32Array(await answer.arrayBuffer());
    const [w, h] = ["X-Width", "X-Height"].map(name => +answer.headers.get(name));
    if (w !== wide || h !== high) {
      [wide, high] = [pixels.width, pixels.height] = [w, h];
      out = paper.createImageData(w, h);
    }
    s.version = +answer.headers.get("X-Version");
    byId("waiting").hidden = true;
    paint(); readOut();
    live.dataset.version = s.version;
    live.dataset.mean = data.reduce((a, b) => a + b, 0) / data.length;
  }

  // The image only if there is time for it, or if it was asked for or is the last one
  async function show(state, hasTime) {
    const select = byId("layer"), names = state.layers.map(l => l.name);
    if (names.length && names.join() !== Object.keys(titles).join()) {
      titles = Object.fromEntries(state.layers.map(l => [l.name, l.title]));
      select.replaceChildren(...state.layers.map(l =>
        new Option(l.meaning ? `${l.title}: ${l.meaning}` : l.title, l.name)));
      if (!names.includes(s.layer)) s.layer = names[0];
      select.value = s.layer;
    }
    select.disabled = !names.length;
    s.tiles = state.tiles.map(t => [t[0] - size.x0, t[1] - size.y0, t[2] - size.x0, t[3] - size.y0]);
    if (!hasTime && !s.stale) return;
    if (state.version > 0 && (state.version !== s.version || s.stale)) { s.stale = false; await load(state); }
    else draw();
    if (state.points !== s.points) {
      s.points = state.points;
      byId("charts").innerHTML = await (await ask("charts")).text();
      byId("charts").querySelectorAll(".charts").forEach(charts);
    }
  }

  function set(changes) {
    Object.assign(s, changes);
    byId("ev").value = s.ev; byId("curve").value = s.curve; byId("layer").value = s.layer;
    if ("curve" in changes) display = displays(s.curve);
    if ("layer" in changes) { s.stale = true; poll(); } else paint();
  }
  const next = (select, by = 1) => {
    const n = select.options.length;
    return select.options[(select.selectedIndex + by + n) % n].value;
  };

  const moves = typeof mover === "function" ? mover(stage, (x, y) => ({
    x: s.left / width + x / s.zoom, y: s.top / height + y / s.zoom,
  })) : { keys: {} };
  navigate(stage, width, height, s, draw, {
    isOnly: true,
    keys: {
      e: () => set({ ev: Math.min(10, s.ev + 0.5) }), E: () => set({ ev: Math.max(-10, s.ev - 0.5) }),
      c: () => set({ curve: next(byId("curve")) }), l: () => set({ layer: next(byId("layer")) }),
      t: () => { byId("showtiles").click(); },
      ...moves.keys,
    },
  });
  byId("ev").addEventListener("input", e => set({ ev: +e.target.value }));
  byId("curve").addEventListener("change", e => set({ curve: e.target.value }));
  byId("layer").addEventListener("change", e => set({ layer: e.target.value }));
  byId("showtiles").addEventListener("change", draw);
  byId("ev").value = s.ev; byId("curve").value = s.curve;
  return { show, s };
}

let view = null, run = null, timer = null, polling = false;

const isOver = state => ["done", "stopped"].includes(state.stage);

function figures(state) {
  const words = { rendering: state.version ? "rendering" : "waiting for the first pass", stopping: "stopping",
    stopped: "stopped: a partial image", done: "done" };
  if (state.camera) cameraFigures(state, words);
  write("stage", `${words[state.stage]}${state.saved ? `; saved ${state.saved}` : ""}` +
    (state.viewers > 1 ? `; ${state.viewers} viewers` : ""));
  byId("done").style.width = `${100 * state.part}%`;
  byId("progress").setAttribute("aria-valuenow", Math.round(100 * state.part));
  write("samples", state.planned === null ? `${state.samples}` : `${state.samples} / ${state.planned}`);
  write("seconds", clock(state.seconds));
  write("left", state.left === null ? "–" : clock(state.left));
  write("rate", metric(state.rate));
  write("error", state.error === null ? "–" : `${short(100 * state.error)} %`);
  byId("stop").disabled = state.stage !== "rendering";
  const hadFocus = ["stop", "keep", "save"].includes(document.activeElement.id);
  const over = isOver(state) && !state.camera;
  byId("stop").hidden = byId("save").hidden = over;
  byId("keep").hidden = state.keepsOn === null;
  byId("files").hidden = !over;
  if (over) {
    write("files", state.files === null ? "The files are being written."
      : state.files.length ? `Written: ${state.files.join(", ")}` : "No file was written.");
    if (!state.version) write("waiting", "there is no image");
    // Focus must not be lost with a button
    if (hadFocus) byId("files").focus();
  }
  byId("keep").setAttribute("aria-pressed", state.keepsOn === true);
  byId("keep").disabled = byId("save").disabled = byId("end").disabled = false;
  byId("end").hidden = !((over || state.camera) && state.stays);
  live.dataset.stage = state.stage; live.dataset.latest = state.version;
}

// Pauses between two looks, in milliseconds; the server forgets pages that don't ask for six seconds
const Soonest = 400, Latest = 4000;
// Pause in relation to the time so far
const Growth = 0.05;
// A page on the machine that renders takes its processors' time. Scripts get this share of it, images
// wait for it; what the browser does to show them takes about as long again. The first images are
// awaited most: for them there are some milliseconds at once.
const isNear = /^(127\..*|\[::1\]|localhost)$/.test(location.hostname);
const Share = isNear ? 0.006 : 0.1, First = 150;
let busy = 0; // milliseconds in scripts

async function poll() {
  if (polling) return;
  polling = true;
  clearTimeout(timer);
  const began = performance.now();
  let pause = Soonest;
  waited = 0;
  try {
    const version = view ? view.s.version : -1;
    const state = await (await ask(`state?viewer=${me}&shown=${version}`)).json();
    if (run && run !== state.run) { location.reload(); return; }
    run = state.run;
    figures(state);
    view ||= liveView(state);
    await view.show(state, state.camera || isOver(state) || began > (busy - First) / Share);
    busy += performance.now() - began - waited;
    const isSoon = isOver(state) && state.files === null && !state.camera;
    const end = isSoon ? Soonest : state.left === null ? Latest : Math.max(Soonest, 1000 * state.left);
    pause = Math.min(Latest, end, Math.max(Soonest, 1000 * Growth * state.seconds));
    if (state.camera && !isOver(state)) pause = Math.min(pause, 100 + 100 * state.seconds);
    live.dataset.lost = "";
  } catch (e) {
    const over = isOver(live.dataset);
    write("stage", over ? `${live.dataset.stage}; the program has ended` : "no connection to the program");
    for (const b of ["stop", "keep", "save", "end", "layer"]) byId(b).disabled = true;
    if (over) byId("end").hidden = true;
    live.dataset.lost = "yes";
    pause = 2000;
  }
  polling = false;
  timer = setTimeout(poll, document.hidden ? Math.max(2000, pause) : view && view.s.stale ? 0 : pause);
}

for (const action of ["stop", "keep", "save", "end"])
  byId(action).addEventListener("click", async () => {
    await fetch(action, { method: "POST" }).catch(() => {});
    poll();
  });
document.addEventListener("visibilitychange", () => { if (!document.hidden) poll(); });
poll();
