// The table of the hard cases, from hard.json.
"use strict";

fill("made", "limpid " + [report.limpid, report.compiler, report.processor, ...report.simd].join(", "));
fill("passed", `${report.rows.filter((row) => row.passed).length} of ${report.rows.length}`);
put("hard_table", () => table(
    "Margin: the unused share of the bound. A case beyond its bound is highlighted.",
    [long("case"), long("measured is"), number("bound"), number("measured"), number("margin"), number("values"),
     long("bound from"), long("largest at")],
    report.rows.map((row, i) => ({
      cells: [row.group + ": " + row.name, row.quantity, row.bound, row.measured ?? "not finite",
              percent(row.margin, 1), whole(row.values), row.reason, row.worst || "-"],
      marked: !row.passed,
      first: row.group !== report.rows[i - 1]?.group,
    }))));
