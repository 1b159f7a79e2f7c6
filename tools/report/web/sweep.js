import { chart } from "./chart.js";
import { el, selection } from "./dom.js";
import { bytes, metres, percent, seconds } from "./facts.js";
import { coverage, fileBytes, peakBytes, pointsOf, stageThat, wallSeconds } from "./figures.js";
import { table } from "./table.js";

/** All instances side by side, and one figure over another. */
export function sweep(facts, chosen, choose) {
  const axes = [...new Set(facts.instances.flatMap((one) => one.values.map(([name]) => name)))];
  const valueOf = (axis) => (one) => {
    const text = one.values.find(([name]) => name === axis)?.[1];
    return text === undefined ? null : text !== "" && Number.isFinite(Number(text)) ? Number(text) : text;
  };
  const measures = measuresOf(facts.instances);
  const columns = [
    ...axes.map((axis, i) => ({
      name: axis, value: valueOf(axis),
      show: i > 0 ? undefined : (one) => el("button", { type: "button", class: "link", onclick: () => choose(one) }, String(valueOf(axis)(one))),
    })),
    ...measures.map(({ name, value, shown }) => ({ name, value, number: true, show: (one) => value(one) === null ? null : shown(value(one)) })),
  ];
  return el("div", {},
    el("p", { class: "lead" }, "Every instance with what its receipts say. A click on the first column shows it below."),
    table("sweep", columns, facts.instances, { chosen: (one) => one === chosen, tall: facts.instances.length > 14 }),
    plot(facts.instances, axes, valueOf, measures));
}

function measuresOf(instances) {
  const clouds = (one) => stageThat(one, "cloud");
  const size = (stage) => fileBytes(stage, "cloud.pcd") ?? null;
  const all = [
    { name: "ATE RMSE [m]", value: (one) => one.trajectory?.evaluation?.ate.rmse ?? null, shown: metres },
    { name: "coverage", value: coverage, shown: (x) => percent(x, 0) },
    { name: "dense cloud [B]", value: (one) => size(clouds(one)[0]), shown: bytes },
    { name: "last cloud [B]", value: (one) => size(clouds(one).at(-1)), shown: bytes },
    { name: "kept", value: (one) => size(clouds(one)[0]) ? size(clouds(one).at(-1)) / size(clouds(one)[0]) : null, shown: percent },
    { name: "points", value: (one) => clouds(one).length ? pointsOf(one, clouds(one).at(-1)) : null, shown: (x) => String(x) },
    { name: "map.ot [B]", value: (one) => fileBytes(stageThat(one, "octree").at(-1), "map.ot") ?? null, shown: bytes },
    { name: "time [s]", value: wallSeconds, shown: seconds },
    { name: "memory [B]", value: peakBytes, shown: bytes },
  ];
  return all.filter(({ value }) => instances.some((one) => value(one) !== null));
}

function plot(instances, axes, valueOf, measures) {
  const numeric = axes.filter((axis) => instances.every((one) => typeof valueOf(axis)(one) === "number"));
  const over = [...numeric.map((axis) => [axis, valueOf(axis)]), ...measures.map(({ name, value }) => [name, value])];
  let [x, y] = [over[0], over.find(([name]) => name === "kept") ?? over[1] ?? over[0]];
  const place = el("div");
  const draw = () => place.replaceChildren(chart([{
    points: instances.map((one) => [x[1](one), y[1](one), one.name]).filter(([a, b]) => a !== null && b !== null),
    dots: () => "", title: (point) => point[2],
  }], { xLabel: x[0], yLabel: y[0], height: 280 }));
  const options = over.map(([name]) => [name, name]);
  const xList = selection("Horizontal", options, (name) => { x = over.find((one) => one[0] === name); draw(); });
  const yList = selection("Vertical", options, (name) => { y = over.find((one) => one[0] === name); draw(); });
  [xList.value, yList.value] = [x[0], y[0]];
  draw();
  return el("div", { id: "sweep-plot" }, el("div", { class: "controls" }, el("label", {}, yList), "over", el("label", {}, xList)), place);
}
