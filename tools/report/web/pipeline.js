import { dag } from "./dag.js";
import { el } from "./dom.js";
import { bytes, facts, plain, seconds, shortId } from "./facts.js";
import { table } from "./table.js";

/** The stages as they hang together, and everything that is known of the chosen one. */
export function pipeline(instance) {
  const detail = el("div", { id: "stage-detail" });
  const picture = dag(instance, (stage) => {
    picture.choose(stage.name);
    detail.replaceChildren(...describe(stage));
  });
  const first = instance.stages[0];
  if (first) {
    picture.choose(first.name);
    detail.replaceChildren(...describe(first));
  }
  const rows = instance.stages;
  return el("div", {},
    el("p", { class: "lead" }, "A stage is chosen by a click, or by Tab and Enter. Times are those of the run that made the result."),
    picture, detail,
    el("h3", {}, "All stages"),
    table("stages", [
      { name: "stage", value: (stage) => stage.name },
      { name: "state", value: (stage) => stage.state },
      { name: "wall [s]", value: (stage) => stage.wall_s, show: (stage) => stage.wall_s.toFixed(1), number: true },
      { name: "CPU [s]", value: (stage) => stage.cpu_s, show: (stage) => stage.cpu_s.toFixed(1), number: true },
      { name: "memory [B]", value: (stage) => stage.peak_bytes, show: (stage) => bytes(stage.peak_bytes), number: true },
      { name: "result [B]", value: (stage) => stage.bytes, show: (stage) => bytes(stage.bytes), number: true },
      { name: "result", value: (stage) => stage.object, show: (stage) => shortId(stage.object), mono: true },
      { name: "program", value: (stage) => stage.program, show: (stage) => shortId(stage.program), mono: true },
      { name: "receipt", value: (stage) => stage.key, show: (stage) => shortId(stage.key), mono: true }], rows),
    el("h3", {}, "All parameters"),
    table("parameters", parameterColumns(), rows.flatMap(parametersOf), { tall: true }),
    el("p", { class: "note" }, `Made by sediment ${facts.version} from ${instance.folder}. Results and programs are known by the digest of their content (XXH3-128); a receipt holds the whole key.`));
}

const parametersOf = (stage) => Object.entries(stage.params).map(([name, value]) => ({ stage: stage.name, name, value: Array.isArray(value) ? value.join(",") : value }));
const parameterColumns = () => [
  { name: "stage", value: (row) => row.stage }, { name: "parameter", value: (row) => row.name },
  { name: "value", value: (row) => row.value, show: (row) => row.value === "" ? "\u2013" : plain(row.value), wrap: true }];

function describe(stage) {
  const parameters = parametersOf(stage);
  const numbers = Object.entries(flat(stage.metrics ?? {}));
  return [
    el("h3", {}, stage.name),
    el("p", { class: "note" }, `${stage.state}; made ${stage.started.replace("T", " ").replace("Z", " UTC")} on ${stage.host} in ${seconds(stage.wall_s)}, because: ${stage.why}`,
      stage.accepted ? `; accepted: ${JSON.stringify(stage.accepted)}` : ""),
    el("div", { class: "two" },
      el("div", {}, parameters.length ? table(`parameters-${stage.name}`, parameterColumns().slice(1), parameters) : el("p", { class: "note" }, "no parameters")),
      el("div", {}, numbers.length ? table(`metrics-${stage.name}`, [
        { name: "metric", value: ([name]) => name }, { name: "value", value: ([, value]) => value, show: ([, value]) => plain(value), number: true }],
      numbers, { most: 60 }) : el("p", { class: "note" }, "no metrics"))),
    el("pre", {}, stage.argv.map((word) => /[^\w@%+=:,./-]/.test(word) || word === "" ? `'${word.replaceAll("'", "'\\''")}'` : word).join(" ")),
  ];
}

function flat(json, name = "", all = {}) {
  for (const [key, value] of Object.entries(json)) {
    const path = name ? `${name}.${key}` : key;
    if (value !== null && typeof value === "object" && !Array.isArray(value)) flat(value, path, all);
    else if (typeof value === "number" || typeof value === "boolean" || typeof value === "string") all[path] = value;
  }
  return all;
}
