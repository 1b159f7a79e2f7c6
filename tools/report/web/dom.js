// Elements from JavaScript: el("p", {class: "note"}, "text", other).
const kSvg = "http://www.w3.org/2000/svg";

function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return node;
}

export const el = (name, attributes, ...children) => filled(document.createElement(name), attributes, children);
export const svg = (name, attributes, ...children) => filled(document.createElementNS(kSvg, name), attributes, children);

/** Draws again with its present width whenever that changes. */
export function responsive(draw) {
  const place = el("div");
  let drawn = 0;
  const redraw = () => {
    if (place.clientWidth > 0) place.replaceChildren(draw((drawn = place.clientWidth)));
  };
  new ResizeObserver(() => {
    if (Math.abs(place.clientWidth - drawn) > 1) redraw();
  }).observe(place);
  place.redraw = redraw;
  return place;
}

/** Buttons of which one is pressed. */
export function choice(label, options, chosen, pick) {
  const buttons = options.map(([value, text]) =>
    el("button", { type: "button", "aria-pressed": String(value === chosen), "data-value": value, onclick: () => press(value) }, text));
  const press = (value) => {
    for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.value === value));
    pick(value);
  };
  return el("span", { class: "group", role: "group", "aria-label": label }, buttons);
}

export function toggle(label, checked, change) {
  const box = el("input", { type: "checkbox", onchange: () => change(box.checked) });
  box.checked = checked;
  return el("label", {}, box, label);
}

export function selection(label, options, pick) {
  const list = el("select", { "aria-label": label, onchange: () => pick(list.value) },
    options.map(([value, text]) => el("option", { value }, text)));
  return list;
}
