import { chart, keys } from "./chart.js";
import { el, svg } from "./dom.js";
import { css, frame, mapFromWorld, metres, moved, percent, turbo } from "./facts.js";
import { coverage } from "./figures.js";
import { table } from "./table.js";

/** The camera's path from above, its error over time, and the figures by both conventions. */
export function trajectory(instance) {
  const made = instance.trajectory;
  if (!made) return null;
  const m = mapFromWorld(instance);
  const path = made.poses.map((pose) => moved(m, pose));
  const errors = made.errors ?? [];
  const start = Number(made.stamps[0]);
  const time = (stamp) => Number(stamp) - start;
  const xRange = [0, time(made.stamps.at(-1))];
  const pick = (x) => frame.choose(nearest(made.stamps, x + start));
  const above = chart([
    { name: "truth", kind: "truth", points: errors.map((row) => moved(m, row.slice(1, 4))) },
    { name: "estimate", points: path, draw: (X, Y) => estimate(path, errors, X, Y) },
  ], { xLabel: "x [m]", yLabel: "y [m]", equal: true, overlay: (X, Y) => here(made, path, X, Y) });
  const charts = errors.length
    ? [chart([{ kind: "estimate", points: errors.map((row) => [time(made.stamps[row[0]]), row[4] * 100]) }],
      { xLabel: "time [s]", xRange, yLabel: "distance from the truth after alignment [cm]", fromZero: true, height: 215, pick }),
    chart([{ kind: "estimate", points: errors.map((row) => row[5] === null ? null : [time(made.stamps[row[0]]), row[5] * 100]) }],
      { xLabel: "time [s]", xRange, yLabel: "drift within the next second [cm]", fromZero: true, height: 215, pick })]
    : [chart([{ kind: "estimate", points: made.tracking.stamps.map((stamp, i) => [time(stamp), made.tracking.inliers[i]]) }],
      { xLabel: "time [s]", xRange, yLabel: "points of the map found again", fromZero: true, height: 215, pick })];
  frame.onchange((stamp) => charts.forEach((one) => one.cursor(time(stamp))));
  const largest = errors.length ? Math.max(...errors.map((row) => row[4])) : 0;
  return el("div", {},
    made.not_evaluated ? el("p", { class: "warning" }, `Not compared with the truth: ${made.not_evaluated}`) : null,
    el("div", { class: "two" },
      el("figure", {}, el("figcaption", {}, "From above, in the frame of the grid map"), above,
        errors.length ? keys(["var(--truth)", "truth", true], [css(turbo(0.15)), "estimate: near", true], [css(turbo(0.9)), `${metres(largest)} off`, true]) : null),
      el("figure", {}, el("figcaption", {}, errors.length ? "Error over time; a click shows that frame" : "Tracking over time; a click shows that frame"), charts)),
    made.evaluation ? numbers(made.evaluation, instance) : null);
}

const nearest = (stamps, seconds) =>
  stamps.reduce((best, stamp) => Math.abs(Number(stamp) - seconds) < Math.abs(Number(best) - seconds) ? stamp : best, stamps[0]);

/** Coloured by its error where that is known. */
function estimate(path, errors, X, Y) {
  const point = ([x, y]) => `${X(x).toFixed(1)} ${Y(y).toFixed(1)}`;
  if (!errors.length) return svg("path", { class: "estimate", d: path.map((p, i) => (i ? "L" : "M") + point(p)).join("") });
  const largest = Math.max(...errors.map((row) => row[4]), 1e-9);
  const line = svg("g", { fill: "none", "stroke-width": 2.4, "stroke-linecap": "round" });
  for (let i = 1; i < errors.length; ++i)
    line.append(svg("path", { d: `M${point(path[errors[i - 1][0]])}L${point(path[errors[i][0]])}`, stroke: css(turbo(0.15 + 0.75 * errors[i][4] / largest)) }));
  return line;
}

function here(made, path, X, Y) {
  const dot = svg("circle", { class: "here", r: 5.5, visibility: "hidden" });
  const show = (stamp) => {
    const i = made.stamps.indexOf(stamp);
    if (i < 0) return;
    dot.setAttribute("cx", X(path[i][0]));
    dot.setAttribute("cy", Y(path[i][1]));
    dot.setAttribute("visibility", "visible");
  };
  frame.onchange(show);
  if (frame.stamp) show(frame.stamp);
  return dot;
}

function numbers(evaluation, instance) {
  const rows = [];
  const add = (convention, measure, one, unit) => one && rows.push({ convention, measure, unit, ...one });
  add("TUM", "ATE, rigid alignment", evaluation.ate, "m");
  for (const [key, name] of [["rpe", "RPE over 1 s"], ["rpe_frame", "RPE over 1 frame"], ["rpe_random", "RPE, 10 000 random pairs"]]) {
    const one = evaluation[key];
    if (!one) continue;
    add("TUM", `${name}, translation`, { ...one.translation, pairs: one.pairs }, "m");
    add("TUM", `${name}, rotation`, { ...one.rotation_deg, pairs: one.pairs }, "\u00b0");
  }
  for (const [key, name] of [["ape", "APE as it is"], ["ape_aligned", "APE, rigid alignment"], ["ape_scaled", "APE, alignment with scale"], ["rpe", "RPE over 1 frame"]]) {
    const one = evaluation.evo?.[key];
    if (!one) continue;
    const pairs = one.pairs ?? evaluation.evo.pairs;
    add("evo", `${name}, translation`, { ...(one.translation ?? one), pairs }, "m");
    if (one.rotation_deg) add("evo", `${name}, rotation`, { ...one.rotation_deg, pairs }, "\u00b0");
  }
  const number = (name) => ({ name, number: true, value: (row) => row[name] ?? null, show: (row) => row[name] === undefined ? null : row[name].toFixed(row.unit === "m" ? 4 : 3) });
  return el("div", {}, el("h3", {}, "By both conventions"),
    el("p", { class: "note" }, `${percent(coverage(instance), 1)} of the frames have a pose. An error of few poses means little.`),
    table("trajectory", [
      { name: "convention", value: (row) => row.convention }, { name: "measure", value: (row) => row.measure },
      { name: "unit", value: (row) => row.unit }, number("rmse"), number("mean"), number("median"), number("max"),
      { name: "pairs", number: true, value: (row) => row.pairs ?? null }], rows));
}
