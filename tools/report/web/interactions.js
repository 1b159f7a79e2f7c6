import { chart, keys } from "./chart.js";
import { el, selection } from "./dom.js";
import { frame } from "./facts.js";
import { table } from "./table.js";

/** Which object is moved by somebody: every pair that was looked at, over time and as a table. */
export function interactions(instance) {
  const part = instance.interactions;
  if (!part) return null;
  if (!part.rows.length) return el("p", { class: "lead" }, "No person or animal was seen together with an object.");
  const rows = part.rows.map(([stamp, dynamicId, dynamicClass, staticId, staticClass, pairs, metres, yes]) =>
    ({ stamp, dynamicId, staticId, pairs, metres: pairs ? metres : null, yes, mover: part.classes[dynamicClass], object: part.classes[staticClass] }));
  const start = Number(rows[0].stamp);
  const threshold = instance.stages.map((stage) => stage.params?.threshold_m).find((x) => x !== undefined);
  const place = el("div"), list = el("div");
  const show = (name) => {
    const some = rows.filter((row) => !name || row.object === name);
    const near = some.filter((row) => row.metres !== null);
    const dots = chart([{ points: near.map((row) => [Number(row.stamp) - start, row.metres, row]), dots: ([, , row]) => row.yes ? "yes" : "no",
      title: ([, , row]) => `${row.mover} #${row.dynamicId}, ${row.object} #${row.staticId}: ${row.metres.toFixed(3)} m over ${row.pairs} pairs` }],
    { xLabel: "time [s]", yLabel: "mean difference in depth [m]", fromZero: true, height: 230, pick: (x) => frame.choose(String(x + start)) });
    frame.onchange((stamp) => dots.cursor(Number(stamp) - start));
    if (frame.stamp) dots.cursor(Number(frame.stamp) - start);
    place.replaceChildren(dots);
    list.replaceChildren(table("interactions", [
      { name: "frame", value: (row) => row.stamp, mono: true, show: (row) => el("button", { type: "button", class: "link mono", onclick: () => frame.choose(row.stamp) }, row.stamp) },
      { name: "moves", value: (row) => `${row.mover} #${row.dynamicId}` },
      { name: "object", value: (row) => `${row.object} #${row.staticId}` },
      { name: "pixel pairs", value: (row) => row.pairs, number: true },
      { name: "difference [m]", value: (row) => row.metres, show: (row) => row.metres?.toFixed(3), number: true },
      { name: "decision", value: (row) => row.yes ? "moved" : "rests" }], some, { tall: true, most: 500 }));
  };
  const objects = [...new Set(rows.map((row) => row.object))].sort();
  show("");
  const moved = rows.filter((row) => row.yes).length;
  return el("div", {},
    el("p", { class: "lead" }, `${rows.length} pairs of someone who moves and an object were looked at; ${moved} times the object counts as moved.`),
    el("div", { class: "controls" }, el("label", {}, "Object", selection("Object", [["", "all"], ...objects.map((name) => [name, name])], show)),
      keys(["var(--moved)", "moved by somebody"], ["var(--muted)", "rests"]),
      threshold === undefined ? null : el("span", { class: "note" }, `threshold ${threshold} m`)),
    place, list);
}
