import { el } from "./dom.js";
import { bytes, grouped, percent } from "./facts.js";
import { fileBytes, pointsOf, stageThat } from "./figures.js";
import { table } from "./table.js";

/** From the dense cloud to what a robot carries: what each step leaves. */
export function sizes(instance) {
  const clouds = stageThat(instance, "cloud"), trees = stageThat(instance, "octree"), grids = stageThat(instance, "grid-map");
  if (!clouds.length) return null;
  const steps = [
    ...clouds.map((stage) => ({ name: stage.name, file: "cloud.pcd", size: fileBytes(stage, "cloud.pcd"), points: pointsOf(instance, stage), stage })),
    ...trees.flatMap((stage) => ["map.ot", "map.bt"].map((file) => ({ name: stage.name, file, size: fileBytes(stage, file), stage }))),
    ...grids.map((stage) => ({ name: stage.name, file: "map.pgm", size: fileBytes(stage, "map.pgm"), stage })),
  ].filter((step) => step.size !== undefined);
  const dense = steps[0].size;
  const largest = Math.max(...steps.map((step) => step.size));
  const width = (size) => `${100 * size / largest}%`;
  const rows = instance.stages.flatMap((stage) => stage.files.map(([file, size]) => ({ stage: stage.name, file, size })));
  return el("div", {},
    el("p", { class: "lead" }, "What each step leaves of the dense cloud; hatched is what it took away. Files as they lie on the disk, MB = 10\u2076 bytes."),
    el("div", { class: "fall" }, steps.map((step, i) => {
      const before = step.stage && stageThat(instance, "cloud").includes(step.stage) && i > 0 ? steps[i - 1].size : clouds.length ? steps[clouds.length - 1].size : step.size;
      const lost = Math.max(0, before - step.size);
      return [
        el("span", {}, step.name, " ", el("small", {}, step.file)),
        el("div", { class: "track" }, el("div", { class: "now", style: `width:${width(step.size)}` }),
          el("div", { class: "lost", style: `left:${width(step.size)};width:${width(lost)}` })),
        el("span", { class: "amount" }, bytes(step.size), " ", el("small", {}, `${percent(step.size / dense)}${step.points ? ` \u00b7 ${grouped(step.points)} points` : ""}`)),
      ];
    })),
    el("h3", {}, "Every file"),
    table("files", [
      { name: "stage", value: (row) => row.stage }, { name: "file", value: (row) => row.file, mono: true },
      { name: "bytes", value: (row) => row.size, show: (row) => grouped(row.size), number: true }], rows, { tall: true, most: 300 }));
}
