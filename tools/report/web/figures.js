// Numbers of an instance that several sections show.
export const stageThat = (instance, kind) => instance.stages.filter((stage) => stage.outputs.some((output) => output[1] === kind));
export const fileBytes = (stage, name) => stage?.files.find((file) => file[0] === name)?.[1];
export const wallSeconds = (instance) => instance.stages.reduce((sum, stage) => sum + stage.wall_s, 0);
export const peakBytes = (instance) => Math.max(0, ...instance.stages.map((stage) => stage.peak_bytes));

/** Points in a cloud: what its stage counted, else what the page read. */
export function pointsOf(instance, stage) {
  const shown = instance.clouds.find((cloud) => cloud.stage === stage.name);
  const counted = ["points_written", "points"].map((name) => stage.metrics?.[name]).find((value) => typeof value === "number");
  return shown?.of ?? counted ?? null;
}

export function coverage(instance) {
  const tracked = instance.trajectory?.tracking.tracked;
  return tracked?.length ? tracked.reduce((sum, one) => sum + one, 0) / tracked.length : null;
}
