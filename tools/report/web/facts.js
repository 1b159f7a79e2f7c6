// What the page knows, and how numbers are written.
export const facts = JSON.parse(document.getElementById("facts").textContent);

const kNarrow = "\u202f";

export function blockText(name) {
  return document.getElementById(name).textContent;
}

export function blockBytes(name) {
  const text = atob(blockText(name));
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

export const grouped = (number) => String(Math.round(number)).replace(/\B(?=(\d{3})+$)/g, kNarrow);

export function bytes(number) {
  if (number === undefined || number === null) return "\u2013";
  for (const [unit, size] of [["GB", 1e9], ["MB", 1e6], ["kB", 1e3]])
    if (number >= size) return `${(number / size).toFixed(number >= 100 * size ? 0 : 1)} ${unit}`;
  return `${number} B`;
}

export function seconds(number) {
  if (number >= 90) return `${Math.floor(number / 60)} min ${Math.round(number % 60)} s`;
  return number >= 10 ? `${number.toFixed(0)} s` : `${number.toFixed(1)} s`;
}

export const metres = (number) =>
  Math.abs(number) < 1 ? `${(number * 100).toFixed(Math.abs(number) < 0.1 ? 2 : 1)} cm` : `${number.toFixed(2)} m`;
export const percent = (share, digits = 1) => `${(share * 100).toFixed(digits)} %`;

/** A number as plain as it can be said. */
export function plain(value) {
  if (typeof value !== "number") return String(value);
  if (Number.isInteger(value)) return Math.abs(value) >= 10000 ? grouped(value) : String(value);
  return String(Number(value.toPrecision(6)));
}

export const shortId = (id) => id.replace(/^x3:/, "").slice(0, 12);
export const labelColor = (name) => {
  const label = facts.labels[name];
  return label ? `rgb(${label.rgb.join(",")})` : "#9a9a9a";
};

/** From the world to the frame in which z is up and the ground is 0: 3 x 4, row by row. */
export function mapFromWorld(instance) {
  return instance.grid?.map_from_world ?? [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0];
}
export function moved(m, [x, y, z]) {
  return [m[0] * x + m[1] * y + m[2] * z + m[3], m[4] * x + m[5] * y + m[6] * z + m[7], m[8] * x + m[9] * y + m[10] * z + m[11]];
}

/** Turbo (Mikhailov 2019), as a polynomial; 0 .. 1 to three bytes. */
export function turbo(t) {
  const x = Math.min(1, Math.max(0, t));
  const at = (c) => Math.min(255, Math.max(0, 255 * (c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))))));
  return [
    at([0.13572138, 4.6153926, -42.66032258, 132.13108234, -152.94239396, 59.28637943]),
    at([0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604]),
    at([0.1066733, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973]),
  ];
}
export const css = (rgb) => `rgb(${rgb.map((value) => Math.round(value)).join(",")})`;

/** The frame everybody looks at: its stamp. */
const listeners = [];
export const frame = {
  stamp: null,
  choose(stamp) {
    frame.stamp = stamp;
    for (const listener of listeners) listener(stamp);
  },
  onchange: (listener) => listeners.push(listener),
  forget: () => { listeners.length = 0; },
};
