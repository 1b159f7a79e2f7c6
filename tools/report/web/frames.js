import { el, toggle } from "./dom.js";
import { blockBytes, blockText, facts, frame, labelColor, percent } from "./facts.js";

const kMoves = [226, 52, 52], kMoved = [240, 156, 0];

/** Pictures with what was seen in them, one after the other. */
export function frames(instance) {
  const part = instance.frames;
  if (!part?.frames.length) return null;
  const shown = { instances: true, dynamic: true, features: false };
  const canvas = el("canvas", { width: part.width, height: part.height, role: "img", "aria-label": "Frame with masks" });
  const names = el("div");
  const title = el("span", { class: "mono" });
  const slider = el("input", { type: "range", min: 0, max: part.frames.length - 1, step: 1, "aria-label": "Frame",
    oninput: () => frame.choose(part.frames[slider.value].stamp) });
  const tracking = instance.trajectory?.tracking;
  let drawing = 0;

  const show = async () => {
    const one = part.frames[slider.value], mine = ++drawing;
    title.textContent = `frame ${one.index} of ${part.of}`;
    names.replaceChildren(...described(one, tracking));
    const [image, masks] = await Promise.all([picture("image/jpeg", one.image), one.masks ? picture("image/png", one.masks) : null]);
    if (mine !== drawing) return;  // somebody has gone on
    draw(canvas, image, masks, one, shown);
    canvas.dataset.frame = one.index;
  };
  frame.onchange((stamp) => {
    slider.value = nearest(part.frames, stamp);
    show();
  });
  const layer = (name, text) => toggle(text, shown[name], (on) => { shown[name] = on; show(); });
  return el("div", {},
    el("p", { class: "lead" }, part.frames.length < part.of
      ? `${part.frames.length} of ${part.of} frames, evenly spread, ${part.width} pixels wide.` : `All ${part.of} frames, ${part.width} pixels wide.`),
    el("div", { class: "frame-facts" },
      el("div", {}, el("div", { class: "stage-picture" }, canvas),
        el("div", { class: "scrub" }, player(slider, part), slider, title),
        el("div", { class: "controls" }, layer("instances", "Instances"), layer("dynamic", "What moves"), layer("features", "Features"))),
      el("div", {}, names,
        el("p", { class: "note" }, "What moves by itself is red, what somebody moves is orange. Features are ORB corners on what stands still, found anew for this page."))));
}

function player(slider, part) {
  let timer = null;
  const button = el("button", { type: "button", "aria-label": "Play", onclick: () => timer ? stop() : start() }, "\u25b6");
  const stop = () => { clearInterval(timer); timer = null; button.textContent = "\u25b6"; };
  const start = () => {
    button.textContent = "\u2016";
    timer = setInterval(() => {
      if (!button.isConnected) return stop();
      frame.choose(part.frames[(Number(slider.value) + 1) % part.frames.length].stamp);
    }, 160);
  };
  return button;
}

function nearest(frames, stamp) {
  let best = 0;
  frames.forEach((one, i) => {
    if (Math.abs(Number(one.stamp) - Number(stamp)) < Math.abs(Number(frames[best].stamp) - Number(stamp))) best = i;
  });
  return best;
}

const pictures = new Map();
function picture(type, block) {
  if (!pictures.has(block)) {
    const image = new Image();
    image.src = `data:${type};base64,${blockText(block)}`;
    pictures.set(block, image.decode().then(() => image));
  }
  return pictures.get(block);
}

function draw(canvas, image, masks, one, shown) {
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const { width, height } = canvas;
  context.drawImage(image, 0, 0, width, height);
  if (masks && (shown.instances || shown.dynamic)) {
    const picture = context.getImageData(0, 0, width, height);
    context.drawImage(masks, 0, 0, width, height);
    tint(picture.data, context.getImageData(0, 0, width, height).data, width, colorsOf(one), shown);
    context.putImageData(picture, 0, 0);
  }
  if (!shown.features) return;
  const at = blockBytes(one.features);
  context.lineWidth = 1.2;
  context.strokeStyle = "#35e0c0";
  for (let i = 0; i + 3 < at.length; i += 4) {
    context.beginPath();
    context.arc((at[i] | at[i + 1] << 8) / 10, (at[i + 2] | at[i + 3] << 8) / 10, 2.6, 0, 2 * Math.PI);
    context.stroke();
  }
}

/** The instances in the colours of their classes with an outline, what moves hatched. */
function tint(data, masks, width, colors, shown) {
  for (let i = 0, at = 0; i < data.length; i += 4, ++at) {
    const instance = masks[i], dynamic = masks[i + 1];
    if (shown.instances && instance && colors[instance - 1]) {
      const edge = masks[i + 4] !== instance || masks[i - 4] !== instance || masks[i + 4 * width] !== instance || masks[i - 4 * width] !== instance;
      mix(data, i, colors[instance - 1], edge ? 1 : 0.42);
    }
    if (!shown.dynamic || !dynamic) continue;
    const hatch = (at % width + Math.floor(at / width)) % 9 < 3;
    mix(data, i, dynamic === 1 ? kMoves : kMoved, hatch ? 0.8 : 0.28);
  }
}
function mix(data, i, rgb, share) {
  for (let k = 0; k < 3; ++k) data[i + k] += (rgb[k] - data[i + k]) * share;
}
const colorsOf = (one) => one.instances.map((instance) => facts.labels[instance.class]?.rgb ?? [154, 154, 154]);

function described(one, tracking) {
  const i = tracking ? tracking.stamps.indexOf(one.stamp) : -1;
  return [
    el("p", { class: "mono" }, one.stamp),
    el("ul", { class: "names" }, classesOf(one).map(([name, all]) => el("li", {},
      el("i", { style: `background:${labelColor(name)}` }), el("span", {}, all.length > 1 ? `${all.length} \u00d7 ${name}` : name),
      el("span", {}, all.map(said).join(", ")))),
    one.instances.length ? null : el("li", {}, "nothing found")),
    i < 0 ? null : el("p", {}, tracking.tracked[i]
      ? `${tracking.keyframes[i] ? "Keyframe" : "Tracked"}: ${tracking.inliers[i]} of ${tracking.matches[i]} matches fit, ${tracking.residual_px[i].toFixed(2)} px`
      : "Lost: no pose"),
  ].filter(Boolean);
}

/** Movers first, then the classes by name. */
function classesOf(one) {
  const classes = new Map();
  for (const instance of one.instances) classes.set(instance.class, [...(classes.get(instance.class) ?? []), instance]);
  const moves = (name) => (facts.labels[name]?.dynamic ? 0 : 1);
  return [...classes].sort(([a], [b]) => moves(a) - moves(b) || a.localeCompare(b));
}
const said = ({ id, score, speed_m_s: speed }) =>
  `#${id}${score < 1 ? ` ${percent(score, 0)}` : ""}${speed ? ` ${speed.toFixed(2)} m/s` : ""}`;
