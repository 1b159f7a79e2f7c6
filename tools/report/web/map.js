import { choice, el, selection, toggle } from "./dom.js";
import { css, grouped, labelColor, metres, turbo } from "./facts.js";
import { Viewer } from "./viewer.js";

/** The world in three dimensions, with its controls and its legend. */
export function map(instance) {
  if (!instance.clouds.length && !instance.octree && !instance.trajectory) return null;
  const place = el("div", { class: "viewer", id: "viewer", tabindex: 0, role: "application",
    "aria-label": "Three-dimensional view. Arrows turn, plus and minus zoom, W A S D move, T from above, R from the side" });
  const note = el("p", { class: "note", id: "viewer-note" });
  const about = el("p", { class: "lead" });
  const controls = el("div", { class: "controls" });
  // The place must have its size before anything is drawn in it.
  new ResizeObserver((_, observer) => {
    if (!place.clientWidth) return;
    observer.disconnect();
    start(instance, place, controls, about);
  }).observe(place);
  note.textContent = "Drag turns, two fingers or the right button move, the wheel zooms. With the keyboard: arrows, W A S D, + and \u2212, T from above, R from the side.";
  return el("div", {}, about, controls, place, note);
}

function start(instance, place, controls, about) {
  let viewer;
  try {
    viewer = new Viewer(place, instance);
  } catch (error) {
    place.replaceChildren(el("p", { class: "warning", style: "margin:1rem" }, `No three-dimensional view: ${error.message}`));
    return;
  }
  const legend = el("div", { class: "legend" });
  place.append(legend);
  const clouds = instance.clouds.map((cloud, i) => [String(i), cloud.stage]);
  const state = { what: clouds.length ? String(clouds.length - 1) : "octree", color: "image" };
  const update = () => {
    viewer.show(state.what, state.color);
    about.textContent = describe(instance, state.what);
    fill(legend, viewer, state.color);
  };
  const things = [...clouds.map(([i, stage]) => [i, clouds.length > 1 ? `Cloud of ${stage}` : "Cloud"]), ...(instance.octree ? [["octree", "Octree"]] : [])];
  const [low, high] = viewer.heights();
  const slider = el("input", { type: "range", min: low, max: high, step: 0.01, "aria-label": "Cut off above" });
  const cut = el("span", { class: "mono" });
  const cutAt = (height) => {
    viewer.cutAbove(height >= high - 1e-6 ? Infinity : height);
    cut.textContent = height >= high - 1e-6 ? "everything" : `below ${height.toFixed(2)} m`;
  };
  slider.addEventListener("input", () => cutAt(Number(slider.value)));
  slider.value = instance.grid ? Math.min(high, 2.2) : high;
  const size = el("input", { type: "range", min: 0.4, max: 4, step: 0.1, value: 1, "aria-label": "Size of points", oninput: () => viewer.pointSize(Number(size.value)) });
  controls.append(
    choice("What", things, state.what, (what) => { state.what = what; update(); }),
    choice("Colour", [["image", "Image"], ["label", "Class"], ["height", "Height"]], state.color, (color) => { state.color = color; update(); }),
    el("span", { class: "group" }, el("button", { type: "button", onclick: () => viewer.view("side") }, "Side"),
      el("button", { type: "button", onclick: () => viewer.view("top") }, "Top"),
      el("button", { type: "button", onclick: () => viewer.view("camera") }, "Camera")),
    instance.grid ? toggle("Grid map", true, (on) => viewer.toggle("grid", on)) : null,
    instance.trajectory ? toggle("Trajectory", true, (on) => viewer.toggle("trajectory", on)) : null,
    instance.trajectory ? toggle("Cameras", true, (on) => viewer.toggle("frusta", on)) : null,
    instance.trajectory?.errors ? toggle("Truth", false, (on) => viewer.toggle("truth", on)) : null,
    el("label", {}, "Height", slider, cut), el("label", {}, "Points", size));
  for (const empty of [...controls.childNodes]) if (empty.nodeType === Node.TEXT_NODE) empty.remove();
  cutAt(Number(slider.value));
  update();
  place.viewer = viewer;
}

function describe(instance, what) {
  if (what === "octree") {
    const { count, of, level, resolution_m: side } = instance.octree;
    return level ? `${grouped(count)} boxes of ${metres(side * 2 ** level)}: the octree's ${grouped(of)} leaves of ${metres(side)}, ${level} levels coarser.`
      : `All ${grouped(count)} occupied leaves of the octree; the smallest have ${metres(side)}.`;
  }
  const cloud = instance.clouds[Number(what)];
  return cloud.count < cloud.of ? `${grouped(cloud.count)} of the ${grouped(cloud.of)} points of ${cloud.stage}, evenly spread.` : `All ${grouped(cloud.of)} points of ${cloud.stage}.`;
}

function fill(legend, viewer, color) {
  legend.hidden = color === "image";
  if (color === "label")
    legend.replaceChildren(...viewer.labels().slice(0, 14).map(({ name, rgb }) => el("span", { class: "key" }, el("i", { style: `background:${rgb ? css(rgb) : labelColor(name)}` }), name)));
  if (color !== "height") return;
  const [low, high] = viewer.colorRange();
  const stops = [...Array(12).keys()].map((i) => css(turbo(i / 11))).join(",");
  legend.replaceChildren(el("div", { class: "ramp", style: `background:linear-gradient(90deg,${stops})` }),
    el("div", { class: "ends" }, el("span", {}, `${low.toFixed(1)} m`), el("span", {}, `${high.toFixed(1)} m`)));
}
