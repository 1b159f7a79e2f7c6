// Points as the page holds them, and the colours they are shown in.
import { facts, turbo } from "./facts.js";

/** The block of a cloud or an octree: positions in the world, and where that is in the frame of the map. */
export function unpack(part, bytes, m) {
  const { count, origin, step } = part;
  const positions = new Float32Array(3 * count), x = new Float32Array(count), y = new Float32Array(count), heights = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    for (let k = 0; k < 3; ++k) {
      const at = 6 * i + 2 * k;
      positions[3 * i + k] = origin[k] + step[k] * (bytes[at] | bytes[at + 1] << 8);
    }
    const px = positions[3 * i], py = positions[3 * i + 1], pz = positions[3 * i + 2];
    x[i] = m[0] * px + m[1] * py + m[2] * pz + m[3];
    y[i] = m[4] * px + m[5] * py + m[6] * pz + m[7];
    heights[i] = m[8] * px + m[9] * py + m[10] * pz + m[11];
  }
  return { count, positions, x, y, heights,
    rgb: bytes.subarray(6 * count, 9 * count), labels: bytes.subarray(9 * count, 10 * count), levels: bytes.subarray(10 * count, 11 * count) };
}

export function colorsOf(part, data, color, [low, high]) {
  if (color === "image") return data.rgb.slice();
  const colors = new Uint8Array(3 * data.count);
  const classes = part.labels.map(({ name, rgb }) => rgb ?? facts.labels[name]?.rgb ?? null);
  for (let i = 0; i < data.count; ++i) {
    const shown = color === "height" ? turbo((data.heights[i] - low) / (high - low)) : classColor(classes[data.labels[i]], data.rgb, i);
    for (let k = 0; k < 3; ++k) colors[3 * i + k] = shown[k];
  }
  return colors;
}

/** The class's colour, a little lighter or darker with the picture, so that shapes show; unlabelled is grey. */
function classColor(rgb, image, i) {
  const grey = 0.299 * image[3 * i] + 0.587 * image[3 * i + 1] + 0.114 * image[3 * i + 2];
  if (!rgb) return Array(3).fill(95 + 0.45 * grey);
  return rgb.map((value) => Math.min(255, value * (0.72 + 0.28 * grey / 160)));
}

/** Of many values every n-th is enough to tell. */
export function quantile(values, share) {
  if (!values.length) return 0;
  const every = Math.ceil(values.length / 20000);
  const sorted = (every > 1 ? values.filter((_, i) => i % every === 0) : Float32Array.from(values)).sort();
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}
