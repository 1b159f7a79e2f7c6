// Line and dot charts as SVG, drawn for the width they have.
import { el, responsive, svg } from "./dom.js";

function stepOf(range, count) {
  const raw = range / count, power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].find((factor) => factor * power >= raw) * power;
}

export function ticks(low, high, count) {
  if (!(high > low)) return [low];
  const step = stepOf(high - low, count), all = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) all.push(i * step);
  return all;
}

const shownTick = (value, all) => {
  const step = all.length > 1 ? all[1] - all[0] : 1;
  return value.toFixed(Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9))));
};

/**
 * series: [{name, points: [[x, y] or null], kind: class of the line, dots: class(point) or nothing}].
 * options: {xLabel, yLabel, xRange, fromZero, height, equal, pick(x)}; returns the element, with cursor(x).
 */
export function chart(series, options) {
  let marker = null, scaleX = null, at = null;
  const place = responsive((width) => {
    const height = options.equal ? Math.min(width, 460) : options.height ?? 240;
    const left = 52, right = 22, top = 22, bottom = 34;
    const all = series.flatMap((one) => one.points).filter(Boolean);
    let [x0, x1] = options.xRange ?? extent(all, 0), [y0, y1] = extent(all, 1);
    if (options.fromZero) y0 = Math.min(0, y0);
    if (y1 <= y0) y1 = y0 + 1;
    if (x1 <= x0) x1 = x0 + 1;
    const inner = [width - left - right, height - top - bottom];
    if (options.equal) {
      const perPixel = 1.06 * Math.max((x1 - x0) / inner[0], (y1 - y0) / inner[1]);
      [x0, x1] = around(x0, x1, perPixel * inner[0]);
      [y0, y1] = around(y0, y1, perPixel * inner[1]);
    } else y1 += 0.06 * (y1 - y0);
    const X = (x) => left + (x - x0) / (x1 - x0) * inner[0], Y = (y) => top + (1 - (y - y0) / (y1 - y0)) * inner[1];
    scaleX = { X, invert: (px) => x0 + (px - left) / inner[0] * (x1 - x0), top, bottom: height - bottom };
    const xs = ticks(x0, x1, Math.max(2, width / 110)), ys = ticks(y0, y1, height / 60);
    marker = options.equal ? null : svg("line", { class: "cursor", y1: top, y2: height - bottom, visibility: "hidden" });
    const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${options.yLabel} over ${options.xLabel}` },
      ys.map((y) => [svg("line", { class: "axis", x1: left, x2: width - right, y1: Y(y), y2: Y(y) }),
        svg("text", { x: left - 8, y: Y(y) + 4, "text-anchor": "end" }, shownTick(y, ys))]),
      xs.map((x) => svg("text", { x: X(x), y: height - bottom + 17, "text-anchor": "middle" }, shownTick(x, xs))),
      svg("text", { x: 0, y: 11 }, options.yLabel),
      svg("text", { x: width - right, y: height - 2, "text-anchor": "end" }, options.xLabel),
      series.map((one) => one.draw ? one.draw(X, Y) : one.dots ? dotsOf(one, X, Y) : svg("path", { class: one.kind, d: pathOf(one.points, X, Y) })),
      marker, options.overlay?.(X, Y));
    if (options.pick) picture.addEventListener("pointerdown", (event) => options.pick(scaleX.invert(event.offsetX)));
    requestAnimationFrame(() => place.cursor(at));
    return picture;
  });
  place.cursor = (x) => {
    at = x;
    if (!marker || x === null || x === undefined) return;
    marker.setAttribute("x1", scaleX.X(x));
    marker.setAttribute("x2", scaleX.X(x));
    marker.setAttribute("visibility", "visible");
  };
  return place;
}

function dotsOf(one, X, Y) {
  return one.points.map((point) => svg("circle", { class: `dot ${one.dots(point)}`, cx: X(point[0]), cy: Y(point[1]), r: 3 },
    svg("title", {}, one.title?.(point) ?? "")));
}
const around = (low, high, size) => [(low + high - size) / 2, (low + high + size) / 2];
function extent(points, axis) {
  let low = Infinity, high = -Infinity;
  for (const point of points) {
    if (point[axis] < low) low = point[axis];
    if (point[axis] > high) high = point[axis];
  }
  return low > high ? [0, 1] : [low, high];
}
function pathOf(points, X, Y) {
  let text = "", pen = false;
  for (const point of points) {
    if (point) text += `${pen ? "L" : "M"}${X(point[0]).toFixed(1)} ${Y(point[1]).toFixed(1)}`;
    pen = Boolean(point);
  }
  return text;
}

export const keys = (...entries) =>
  el("div", {}, entries.map(([color, text, line]) => el("span", { class: "key" }, el("i", { class: line ? "line" : null, style: `background:${color}` }), text)));
