// Tables that sort by a click on a heading, and that can be taken along as CSV or JSON.
import { el } from "./dom.js";

/** columns: [{name, value(row), show?(row), number?}]; `value` sorts and is what a download holds. */
export function table(name, columns, rows, options = {}) {
  let order = rows.slice(), sorted = -1, up = true;
  const body = el("tbody");
  const heads = columns.map((column, i) =>
    el("th", { class: column.number ? "number" : null, scope: "col" },
      el("button", { type: "button", onclick: () => sort(i) }, column.name)));

  const fill = () => {
    const most = options.most ?? Infinity;
    body.replaceChildren(...order.slice(0, most).map((row) => {
      const line = el("tr", { class: options.chosen?.(row) ? "chosen" : null }, columns.map((column) => {
        const shown = column.show ? column.show(row) : column.value(row);
        return el("td", { class: [column.number ? "number" : "", column.wrap ? "wrap" : "", column.mono ? "mono" : ""].join(" ").trim() || null },
          shown ?? "\u2013");
      }));
      if (options.pick) line.addEventListener("click", () => options.pick(row));
      return line;
    }));
  };
  const sort = (i) => {
    up = sorted === i ? !up : !columns[i].number;
    sorted = i;
    const value = columns[i].value;
    order.sort((a, b) => {
      const [x, y] = [value(a), value(b)];
      if (x === y) return 0;
      if (x === null || x === undefined) return 1;
      if (y === null || y === undefined) return -1;
      const less = typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y), undefined, { numeric: true });
      return up ? less : -less;
    });
    heads.forEach((head, k) => k === i ? head.setAttribute("aria-sort", up ? "ascending" : "descending") : head.removeAttribute("aria-sort"));
    fill();
  };
  fill();

  const count = order.length > (options.most ?? Infinity) ? `first ${options.most} of ${order.length} rows; a download has all` : "";
  return el("div", { class: "table", "data-table": name },
    el("div", { class: options.tall ? "scroll tall" : "scroll", tabindex: options.tall ? 0 : null },
      el("table", {}, el("thead", {}, el("tr", {}, heads)), body)),
    el("div", { class: "tools" }, el("span", { class: "note" }, count),
      el("span", {},
        el("button", { type: "button", class: "link", onclick: () => save(`${name}.csv`, "text/csv", csv(columns, order)) }, "CSV"), " \u00a0 ",
        el("button", { type: "button", class: "link", onclick: () => save(`${name}.json`, "application/json", json(columns, order)) }, "JSON"))));
}

function csv(columns, rows) {
  const quoted = (value) => {
    const text = value === null || value === undefined ? "" : String(value);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return [columns.map((column) => quoted(column.name)), ...rows.map((row) => columns.map((column) => quoted(column.value(row))))]
    .map((cells) => cells.join(",")).join("\n") + "\n";
}

function json(columns, rows) {
  return JSON.stringify(rows.map((row) => Object.fromEntries(columns.map((column) => [column.name, column.value(row) ?? null]))), null, 1) + "\n";
}

function save(file, type, text) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  el("a", { href: url, download: file }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
