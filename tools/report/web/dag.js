// The stages of an instance and what they read, from left to right; on a narrow screen from top to bottom.
import { responsive, svg } from "./dom.js";
import { bytes, seconds } from "./facts.js";

const kWidth = 146, kHeight = 50, kBend = 34;

export function dag(instance, choose) {
  const { nodes, edges } = graphOf(instance);
  const ranks = layers(nodes, edges);
  let chosen = null;
  const place = responsive((width) => {
    const down = width < 700;
    const deep = down ? kHeight + 34 : kWidth + 44, apart = down ? kWidth + 14 : kHeight + 20;
    const most = Math.max(...ranks.map((rank) => rank.length));
    for (const [r, rank] of ranks.entries())
      rank.forEach((node, i) => {
        const [along, across] = [r * deep + 2, (i + (most - rank.length) / 2) * apart + 2 + (down ? 0 : kBend)];
        [node.x, node.y] = down ? [across, along] : [along, across];
      });
    const size = [ranks.length * deep, most * apart];
    const [w, h] = down ? [most * apart, ranks.length * deep - 30] : [size[0] - 40, size[1] - 14 + kBend];
    const scale = down ? Math.min(1, width / w) : Math.max(0.72, Math.min(1, width / w));
    const picture = svg("svg", { width: w * scale, height: h * scale, viewBox: `0 0 ${w} ${h}`, style: "max-width:none" },
      edges.map((edge) => svg("path", { class: "edge", "data-from": edge.from.name, "data-to": edge.to.name, d: curve(edge, down) }, svg("title", {}, edge.role))),
      nodes.map((node) => drawn(node, choose)));
    mark(picture, chosen);
    return picture;
  });
  place.className = "dag";
  place.choose = (name) => {
    chosen = name;
    mark(place, name);
  };
  return place;
}

function mark(picture, name) {
  for (const node of picture.querySelectorAll(".node")) node.classList.toggle("chosen", node.dataset.name === name);
  for (const edge of picture.querySelectorAll(".edge")) edge.classList.toggle("lit", edge.dataset.from === name || edge.dataset.to === name);
}

function graphOf(instance) {
  const nodes = instance.stages.map((stage) => ({ name: stage.name, stage }));
  const edges = [];
  for (const node of nodes.slice())
    for (const input of node.stage.inputs) {
      let from = nodes.find((other) => other.stage && other.name === input.stage);
      if (!from) {
        const name = input.role;
        from = nodes.find((other) => !other.stage && other.id === input.id);
        if (!from) nodes.push(from = { name, id: input.id, source: input.source });
      }
      edges.push({ from, to: node, role: input.role });
    }
  return { nodes, edges };
}

/** A node stands behind all it reads. */
function layers(nodes, edges) {
  for (const node of nodes) node.rank = 0;
  for (let again = true; again;) {
    again = false;
    for (const { from, to } of edges)
      if (to.rank < from.rank + 1) {
        to.rank = from.rank + 1;
        again = true;
      }
  }
  const ranks = [];
  for (const node of nodes) (ranks[node.rank] ??= []).push(node);
  return ranks;
}

function curve({ from, to }, down) {
  if (down) {
    const [x0, y0, x1, y1] = [from.x + kWidth / 2, from.y + kHeight, to.x + kWidth / 2, to.y];
    const bend = to.rank - from.rank > 1 ? 44 : 0;
    return `M${x0} ${y0}C${x0 + bend * 2} ${y0 + 26},${x1 + bend * 2} ${y1 - 26},${x1} ${y1}`;
  }
  const [x0, y0, x1, y1] = [from.x + kWidth, from.y + kHeight / 2, to.x, to.y + kHeight / 2];
  const skips = to.rank - from.rank;
  // An edge past other stages swings out, so that it does not run through them.
  const bend = skips > 1 && Math.abs(y1 - y0) < kHeight ? Math.min(78, 30 + 10 * skips) * (y0 <= y1 ? -1 : 1) : 0;
  return `M${x0} ${y0}C${x0 + 40} ${y0 + bend},${x1 - 40} ${y1 + bend},${x1} ${y1}`;
}

function drawn(node, choose) {
  const stage = node.stage;
  const press = (event) => {
    if (event.type === "keydown" && event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    choose(stage);
  };
  return svg("g", { class: `node ${stage ? stage.state : "source"}`, transform: `translate(${node.x} ${node.y})`, "data-name": node.name,
    tabindex: stage ? 0 : null, role: stage ? "button" : null, "aria-label": stage ? `${node.name}, ${stage.state}, ${seconds(stage.wall_s)}` : null,
    onclick: stage ? press : null, onkeydown: stage ? press : null },
  svg("rect", { width: kWidth, height: kHeight, rx: 7 }),
  svg("text", { class: "title", x: 12, y: 21 }, node.name),
  stage ? [svg("circle", { class: "state", cx: kWidth - 13, cy: 34.5, r: 4 }), svg("text", { x: 12, y: 39 }, `${seconds(stage.wall_s)} \u00b7 ${bytes(stage.bytes)}`)]
    : svg("text", { x: 12, y: 39 }, short(node.source ?? "")),
  svg("title", {}, stage ? `${node.name}: ${stage.state}` : node.source ?? node.name));
}

function short(path) {
  const words = path.split("/").filter(Boolean);
  const name = words.at(-1) === "sequence.yaml" ? words.at(-2) ?? "" : words.at(-1) ?? "";
  return name.length > 18 ? `${name.slice(0, 17)}\u2026` : name;
}
