import { el } from "./dom.js";
import { bytes, grouped, metres, percent, seconds } from "./facts.js";
import { coverage, fileBytes, pointsOf, stageThat, wallSeconds } from "./figures.js";

/** What came out, in six figures; what went wrong, if anything did. */
export function overview(instance, facts, chooser) {
  const figures = [tracked(instance), error(instance), cloud(instance), octree(instance), grid(instance), time(instance)].filter(Boolean);
  const instances = facts.instances.length;
  return el("div", {},
    el("h1", {}, facts.name),
    el("p", { class: "lead" }, instances > 1 ? `Sweep of ${instances} instances` : instance.sequence
      ? `${grouped(instance.sequence.frames)} frames of ${instance.sequence.width} \u00d7 ${instance.sequence.height} pixels, ${instance.stages.length} stages`
      : `${instance.stages.length} stages`),
    chooser || null,
    instance.missing.filter((stage) => stage.state !== "kept").map((stage) =>
      el("p", { class: "warning" }, `${stage.name} has no result: ${stage.state}${stage.why ? `, ${stage.why}` : ""}`)),
    instance.not_shown.map((one) => el("p", { class: "warning" }, `Not shown: ${one.part}. ${one.why}`)),
    el("dl", { class: "figures" }, figures.map(([name, value, detail]) =>
      el("div", {}, el("dt", {}, name), el("dd", {}, value, el("small", {}, detail))))));
}

function tracked(instance) {
  const share = coverage(instance);
  if (share === null) return null;
  const keyframes = instance.trajectory.tracking.keyframes.reduce((sum, one) => sum + one, 0);
  return ["Frames with a pose", percent(share, share === 1 ? 0 : 1), `${instance.trajectory.poses.length} poses, ${keyframes} keyframes`];
}
function error(instance) {
  const ate = instance.trajectory?.evaluation?.ate;
  return ate ? ["Trajectory error", metres(ate.rmse), `ATE RMSE over ${ate.pairs} pairs, rigid alignment`] : null;
}
function cloud(instance) {
  const clouds = stageThat(instance, "cloud");
  if (!clouds.length) return null;
  const [first, last] = [clouds[0], clouds[clouds.length - 1]];
  const kept = fileBytes(last, "cloud.pcd") / fileBytes(first, "cloud.pcd");
  const points = pointsOf(instance, last);
  return points === null ? ["Cloud", bytes(fileBytes(last, "cloud.pcd")), "as a file"] : ["Points in the cloud", grouped(points),
    first === last ? bytes(fileBytes(last, "cloud.pcd")) : `${bytes(fileBytes(last, "cloud.pcd"))}, ${percent(kept)} of the dense one`];
}
function octree(instance) {
  if (!instance.octree) return null;
  const stage = stageThat(instance, "octree").at(-1);
  return ["Leaves of the octree", grouped(instance.octree.of), `${metres(instance.octree.resolution_m)}; ${bytes(fileBytes(stage, "map.ot"))}, without colour ${bytes(fileBytes(stage, "map.bt"))}`];
}
function grid(instance) {
  const map = instance.grid;
  if (!map) return null;
  const area = map.resolution_m ** 2;
  return ["Occupied in the grid", `${(map.occupied * area).toFixed(1)} m\u00b2`,
    `${map.width} \u00d7 ${map.height} cells of ${metres(map.resolution_m)}${map.free ? `, ${(map.free * area).toFixed(1)} m\u00b2 free` : ""}`];
}
function time(instance) {
  const cpu = instance.stages.reduce((sum, stage) => sum + stage.cpu_s, 0);
  return ["Time", seconds(wallSeconds(instance)), `all stages together, ${seconds(cpu)} of CPU`];
}
