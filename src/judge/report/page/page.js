// What the pages have in common: numbers as text, elements, and tables that a click sorts.
"use strict";

function powerOfTen(power) {
  return (power < 0 ? "10⁻" : "10") + String(Math.abs(power)).replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);
}

// To read: three digits, as a decimal from 0.001 to 99999, else as 5.9·10⁻⁷; "-" for null, which is none.
function shortNumber(value) {
  if (value === null || Number.isNaN(value)) return "-";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "-∞";
  if (value === 0) return "0";
  // Of the number as it will be rounded: 999.6 has four digits before the point.
  const [digits, exponent] = value.toExponential(2).split("e");
  const power = Number(exponent);
  if (power >= -3 && power <= 4) return value.toFixed(Math.max(0, 2 - power));
  return digits + "·" + powerOfTen(power);
}

// As it was written by hand: as many digits as it takes, no power of ten.
function plainNumber(value) {
  return value.toLocaleString("en-US", {useGrouping: false, maximumFractionDigits: 20});
}

// Children are nodes, and words, which are never markup.
function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

function code(word) {
  return element("code", {}, word);
}

// Every place of that name in the page gives way to what `make` makes.
function put(name, make) {
  for (const slot of document.querySelectorAll(`[data-slot="${name}"]`)) slot.replaceWith(...[make()].flat());
}

// The same, into the place.
function fill(name, ...children) {
  document.querySelector(`[data-slot="${name}"]`).append(...children);
}

// ---- tables

// Heads: of words, of texts that may be long, of numbers.
const word = (name) => ({name, type: ""});
const long = (name) => ({name, type: "wrap"});
const number = (name, unit) => ({name, unit, type: "n"});

// Cells that hold a number, by which rows are sorted, and show it in another way than shortNumber().
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

// Rows are {cells, marked, first}: a marked one is set off, as those of a Pareto front; the first of a group stands
// apart from those above it, until the table is sorted. Cells are words, numbers or what shown() makes.
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

// An infinite number is null in JSON; of an error null is nothing else.
const report = JSON.parse(document.getElementById("report").textContent, (key, value) => {
  if (key === "error") for (const statistic of Object.keys(value)) value[statistic] ??= Infinity;
  return key === "rmse" || key === "rel_mse" ? value ?? Infinity : value;
});
