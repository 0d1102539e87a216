#pragma once

namespace limpid {

/// Style and script of the page, both without any '<' or '&', so that the page is XML as well.
inline constexpr const char* kPageStyle = R"css(
:root {
  color-scheme: light dark;
  --paper: #ffffff; --ink: #1c2126; --soft: #59636e; --rule: #d5dade; --faint: #eceff1;
  --mark: #eaf2f8; --link: #0b5c94; --halo: #ffffff;
  --s0: #0072b2; --s1: #c04a00; --s2: #00795a; --s3: #a8478a; --s4: #8a6a00; --s5: #3a7ca5; --s6: #444444;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #14181b; --ink: #e3e7ea; --soft: #9aa5af; --rule: #3a434b; --faint: #252c31;
    --mark: #1d2c38; --link: #7cc0ee; --halo: #14181b;
    --s0: #56b4e9; --s1: #f0884a; --s2: #3cc79b; --s3: #dd94c4; --s4: #e6b422; --s5: #9fd3f0; --s6: #c0c7cd;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Liberation Sans", sans-serif;
}
main, header, footer { max-width: 1120px; margin: 0 auto; padding: 0 24px; }
header { padding-top: 40px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 4px; font-weight: 600; }
h2 { font-size: 21px; line-height: 1.3; margin: 0 0 12px; padding-top: 14px; border-top: 1px solid var(--rule); font-weight: 600; }
h3 { font-size: 16px; margin: 28px 0 8px; font-weight: 600; }
section { margin: 44px 0 0; }
p, li { max-width: 76ch; }
p { margin: 0 0 12px; }
.sub { color: var(--soft); margin: 0 0 20px; }
ul.short { margin: 0 0 20px; padding-left: 20px; }
ul.short li { margin-bottom: 6px; }
nav { margin: 0 0 8px; font-size: 15px; }
nav a { display: inline-block; margin: 0 18px 6px 0; }
a { color: var(--link); }
code { font: 0.92em/1 ui-monospace, "SFMono-Regular", Menlo, Consolas, "Liberation Mono", monospace; }
dl.facts { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 4px 20px; margin: 0 0 20px; font-size: 15px; }
dl.facts dt { color: var(--soft); }
dl.facts dd { margin: 0; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14px; line-height: 1.35; margin: 0 0 8px; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--soft); padding: 0 0 6px; max-width: 90ch; }
th, td { padding: 4px 14px 4px 0; text-align: left; vertical-align: baseline; white-space: nowrap; }
td.wrap { white-space: normal; min-width: 20ch; }
th { border-bottom: 1px solid var(--ink); font-weight: 600; vertical-align: bottom; padding-bottom: 5px; }
td { border-bottom: 1px solid var(--faint); }
.n { text-align: right; }
tr.first td { padding-top: 12px; }
tr.marked td { background: var(--mark); }
tr.marked td:first-child { font-weight: 600; }
th button { all: unset; cursor: pointer; }
th button:focus-visible { outline: 2px solid var(--link); }
th button:hover { text-decoration: underline; }
th[aria-sort="ascending"] button::after { content: " \2191"; }
th[aria-sort="descending"] button::after { content: " \2193"; }
.unit { display: block; color: var(--soft); font-weight: 400; }
figure { margin: 0; }
figcaption { font-size: 14px; color: var(--soft); margin: 4px 0 0; max-width: 90ch; }
figure.chart { margin: 16px 0 24px; }
figure.legend { margin: 8px 0 20px; }
.gallery { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(320px, 100%), 1fr)); gap: 16px; margin: 12px 0 16px; }
.gallery img { display: block; width: 100%; height: auto; background: var(--faint); }
svg.plot { display: block; min-width: 600px; max-width: 100%; height: auto; }
figure.legend svg { display: block; max-width: 100%; height: auto; }
svg text { fill: var(--ink); font-family: inherit; }
svg .tick { fill: var(--soft); }
svg .label { paint-order: stroke; stroke: var(--halo); stroke-width: 3px; stroke-linejoin: round; }
svg .grid { stroke: var(--faint); stroke-width: 1; }
svg .grid.main { stroke: var(--rule); }
svg .frame { fill: none; stroke: var(--soft); stroke-width: 1; }
svg .break { stroke: var(--soft); stroke-width: 1; stroke-dasharray: 2 4; }
svg .front { fill: none; stroke: var(--ink); stroke-width: 1.5; stroke-dasharray: 6 3; opacity: 0.55; }
svg .lead { stroke: var(--soft); stroke-width: 0.8; }
svg .link { fill: none; stroke-width: 1.5; opacity: 0.6; }
svg .m { fill: var(--paper); stroke-width: 1.6; }
svg .s0 { stroke: var(--s0); } svg .s0.on { fill: var(--s0); }
svg .s1 { stroke: var(--s1); } svg .s1.on { fill: var(--s1); }
svg .s2 { stroke: var(--s2); } svg .s2.on { fill: var(--s2); }
svg .s3 { stroke: var(--s3); } svg .s3.on { fill: var(--s3); }
svg .s4 { stroke: var(--s4); } svg .s4.on { fill: var(--s4); }
svg .s5 { stroke: var(--s5); } svg .s5.on { fill: var(--s5); }
svg .s6 { stroke: var(--s6); } svg .s6.on { fill: var(--s6); }
footer { color: var(--soft); font-size: 14px; padding-top: 32px; padding-bottom: 48px; }
@media (max-width: 600px) {
  main, header, footer { padding-left: 14px; padding-right: 14px; }
  dl.facts { grid-template-columns: minmax(0, 1fr); gap: 0; }
  dl.facts dd { margin-bottom: 8px; }
}
@media print {
  :root { --paper: #ffffff; --ink: #000000; --soft: #444444; --rule: #bbbbbb; --faint: #dddddd; --mark: #eeeeee; --halo: #ffffff; }
  body { font-size: 10pt; }
  nav { display: none; }
  figure, tr { break-inside: avoid; }
  h2 { break-after: avoid; }
  .scroll { overflow-x: visible; }
  table { font-size: 7pt; }
}
)css";

inline constexpr const char* kPageScript = R"js(
document.querySelectorAll("th button").forEach(function (button) {
  button.addEventListener("click", function () {
    var head = button.parentNode, heads = Array.from(head.parentNode.children);
    var column = heads.indexOf(head), body = head.closest("table").tBodies[0];
    var sign = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    heads.forEach(function (other) { other.removeAttribute("aria-sort"); });
    head.setAttribute("aria-sort", sign === 1 ? "ascending" : "descending");
    var key = function (row) {
      var cell = row.children[column];
      return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
    };
    Array.from(body.rows).sort(function (a, b) {
      var x = key(a), y = key(b);
      if (typeof x === "number" ? typeof y === "number" : false) return sign * (x - y);
      return sign * String(x).localeCompare(String(y));
    }).forEach(function (row) {
      row.classList.remove("first");
      body.appendChild(row);
    });
  });
});
)js";

}  // namespace limpid
