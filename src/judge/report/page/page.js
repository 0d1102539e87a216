// Shared by the pages: numbers as text, elements, and sortable tables.
"use strict";

function powerOfTen(power) {
  return (power < 0 ? "10⁻" : "10") + String(Math.abs(power)).replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);
}

// Three digits, as a decimal from 0.001 to 99999, else as 5.9·10⁻⁷; "-" for null.
function shortNumber(value) {
  if (value === null || Number.isNaN(value)) return "-";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "-∞";
  if (value === 0) return "0";
  // After rounding: 999.6 has four digits before the point.
  const [digits, exponent] = value.toExponential(2).split("e");
  const power = Number(exponent);
  if (power >= -3 && power <= 4) return value.toFixed(Math.max(0, 2 - power));
  return digits + "·" + powerOfTen(power);
}

// The shortest decimal that reads back as the number, without a power of ten.
function plainNumber(value) {
  return value.toLocaleString("en-US", {useGrouping: false, maximumFractionDigits: 20});
}

// Children are nodes, and texts, which are never parsed as markup.
function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

function code(word) {
  return element("code", {}, word);
}

// Replaces every slot of that name in the page by the nodes of `make`.
function put(name, make) {
  for (const slot of document.querySelectorAll(`[data-slot="${name}"]`)) slot.replaceWith(...[make()].flat());
}

// Appends to the slot.
function fill(name, ...children) {
  document.querySelector(`[data-slot="${name}"]`).append(...children);
}

// ---- tables

// Columns: of words, of texts that may be long, of numbers.
const word = (name) => ({name, type: ""});
const long = (name) => ({name, type: "wrap"});
const number = (name, unit) => ({name, unit, type: "n"});

// Cells with a number, by which rows are sorted, and a text other than shortNumber().
const shown = (value, text) => ({value, text});
const whole = (value) => shown(value, String(value));
const percent = (share, digits = 0) =>
    shown(share, Number.isFinite(share) ? (100 * share).toFixed(digits) + " %" : "-");

function headOf(column) {
  const button = element("button", {type: "button"}, column.name);
  if (column.unit) button.append(" ", element("span", {class: "unit"}, column.unit));
  const head = element("th", column.type === "n" ? {scope: "col", class: "n"} : {scope: "col"}, button);
  button.addEventListener("click", () => sortBy(head));
  return head;
}

function cellOf(content, column) {
  const {value, text} = typeof content === "string" ? shown(null, content)
      : content === null || typeof content === "number" ? shown(content, shortNumber(content)) : content;
  const cell = element("td", column.type ? {class: column.type} : {}, text);
  if (Number.isFinite(value)) cell.dataset.v = value;
  return cell;
}

// Rows are {cells, marked, first}: a marked row is highlighted, as on a Pareto front; the first row of a group has a gap
// above it, until the table is sorted. Cells are words, numbers or results of shown().
function table(caption, columns, rows) {
  const body = element("tbody", {});
  for (const {cells, marked, first} of rows) {
    const type = marked ? "marked" : first && body.rows.length > 0 ? "first" : "";
    const row = element("tr", type ? {class: type} : {}, ...cells.map((cell, i) => cellOf(cell, columns[i])));
    body.append(row);
  }
  const head = element("thead", {}, element("tr", {}, ...columns.map(headOf)));
  return element("div", {class: "scroll"}, element("table", {}, element("caption", {}, caption), head, body));
}

function sortBy(head) {
  const heads = Array.from(head.parentNode.children), column = heads.indexOf(head);
  const sign = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
  heads.forEach((other) => other.removeAttribute("aria-sort"));
  head.setAttribute("aria-sort", sign === 1 ? "ascending" : "descending");
  const key = (row) => {
    const cell = row.children[column];
    return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
  };
  const compared = (x, y) =>
      typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y));
  const body = head.closest("table").tBodies[0];
  for (const row of Array.from(body.rows).sort((a, b) => sign * compared(key(a), key(b)))) {
    row.classList.remove("first");
    body.append(row);
  }
}

// ---- data

// Infinite and absent numbers are null in JSON; in an error, null is infinite.
const report = JSON.parse(document.getElementById("report").textContent, (key, value) => {
  if (key === "error") for (const statistic of Object.keys(value)) value[statistic] ??= Infinity;
  return key === "rmse" || key === "rel_mse" ? value ?? Infinity : value;
});
