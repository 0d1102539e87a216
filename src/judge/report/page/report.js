// The sections of the report, from report.json and the pictures beside it.
"use strict";

const pictures = JSON.parse(document.getElementById("pictures").textContent);
const firstSubject = report.subjects[0];
const sameLook = (row) => (other) => other.subject === row.subject && other.look === row.look;
const startsGroup = (rows, i) => i === 0 || !sameLook(rows[i])(rows[i - 1]);
const about = (what, time, error) => `${what}: ${shortNumber(time)} ns/pixel, error ${shortNumber(error)}`;

const frontCaption =
    "Filled, on the stepped line: the Pareto front. Hollow: other choices. Both axes are logarithmic.";
const bandCaption = " Markers in the band 0 have no error.";

// ---- the most important numbers

function physicalItem(physical) {
  const {name, kind, width, height, wet_share} = firstSubject;
  const several = report.looks_by_runner.filter((row) =>
      sameLook(physical)(row) && row.runner === "fused" && row.threads !== 1).map((row) =>
      `, ${shortNumber(row.ns_per_pixel)} ns on ${row.threads} threads: ` +
      `${shortNumber(row.ns_per_pixel * 1920 * 1080 / 1e6)} ms for 1920x1080 pixels`);
  return element("li", {}, "The look ", code("physical"), " takes ",
      element("b", {}, shortNumber(physical.ns_per_pixel) + " ns per pixel"), ` on the ${kind} `, code(name),
      ` (${width}x${height}, ${percent(wet_share).text} wet, one thread, ${report.simd})`, ...several, ".");
}

function fastItem(physical, fast) {
  return element("li", {}, "The look ", code("fast"), " takes ",
      element("b", {}, percent(fast.ns_per_pixel / physical.ns_per_pixel).text),
      " of that; its picture differs from that of ", code("physical"),
      ` by ${shortNumber(fast.error.mean)} in the mean (white = 1).`);
}

function fusedItem() {
  const references = report.looks_by_runner.filter((row) => row.runner === "reference");
  const fused = report.looks_by_runner.filter((row) =>
      row.runner === "fused" && row.threads === 1 && row.simd === report.simd);
  const times = fused.flatMap((row) =>
      references.filter(sameLook(row)).map((judge) => judge.ns_per_pixel / row.ns_per_pixel));
  if (times.length === 0) return [];
  return element("li", {}, "The fused runner is ",
      element("b", {}, `${shortNumber(Math.min(...times))} to ${shortNumber(Math.max(...times))} times`),
      " as fast as the reference in double, both on one thread; its mean error is at most " +
      `${shortNumber(Math.max(...fused.map((row) => row.error.mean)))} over all looks and subjects.`);
}

function truthItem() {
  const named = (choice) => report.refraction_beside_truth.rows.find((row) => row.choice === choice);
  const none = named("no refraction"), march = named("snell march, shorten");
  if (!none || !march) return [];
  return element("li", {}, "Against a path-traced picture of the same water, the march along refracted rays reduces the " +
      "error from ", element("b", {}, percent(none.relative_error_wet, 1).text), " to ",
      element("b", {}, percent(march.relative_error_wet, 1).text),
      `, at ${shortNumber(march.ns_per_pixel / none.ns_per_pixel)} times the time.`);
}

function summary() {
  const row = (look) => report.looks_beside_physical.find((r) => r.subject === firstSubject.name && r.look === look);
  const physical = row("physical"), fast = row("fast");
  return [physical ? physicalItem(physical) : [], physical && fast ? fastItem(physical, fast) : [], fusedItem(),
          truthItem()].flat();
}

// ---- plates and scenes

function subjectTable() {
  return table("Plates and scenes. Wet: share of the pixels that the look physical changes.",
      [word("name"), word("kind"), number("width", "pixels"), number("height", "pixels"),
       number("wet", "of all pixels")],
      report.subjects.map((s) =>
          ({cells: [s.name, s.kind, whole(s.width), whole(s.height), percent(s.wet_share)]})));
}

// ---- looks by runner

function runnerPlot() {
  const rows = report.looks_by_runner.filter((row) =>
      row.subject === firstSubject.name && row.threads === 1 && row.runner === "fused");
  return plotFigure({
    title: "Looks by instruction set on " + firstSubject.name,
    errorAxis: "mean error against the reference",
    points: rows.map((row) => ({
      time: row.ns_per_pixel, error: row.error.mean, series: row.simd, label: row.look,
      about: about(row.look + ", " + row.simd, row.ns_per_pixel, row.error.mean),
    })),
  }, "The fused runner on ", code(firstSubject.name), ": a marker per look and instruction set.");
}

// A row is a look on a subject, with a column for each runner.
function runnerTable() {
  const ways = [{runner: "reference", simd: null, threads: 1, head: "reference"},
                ...report.machine.simd.map((simd) => ({runner: "fused", simd, threads: 1, head: simd}))];
  const {simd, settings: {threads}} = report;
  if (threads > 1) ways.push({runner: "fused", simd, threads, head: `${simd}, ${threads} threads`});
  const gpu = report.looks_by_runner.find((row) => row.runner === "gpu");
  if (gpu) ways.push({runner: "gpu", simd: gpu.simd, threads: gpu.threads, head: gpu.simd});
  const cells = (subject, look) => {
    const rows = report.looks_by_runner.filter(sameLook({subject, look}));
    const time = (way) => rows.find((row) =>
        row.runner === way.runner && row.simd === way.simd && row.threads === way.threads)?.ns_per_pixel ?? "-";
    const worst = (statistic) => Math.max(0, ...rows.map((row) => row.error[statistic]));
    return [subject, look, ...ways.map(time), worst("mean"), worst("p99_99"), worst("max")];
  };
  return table("One thread unless noted. Errors: the worst of all runs, against the reference.",
      [word("subject"), word("look"), ...ways.map((way) => number(way.head, "ns/pixel")),
       number("mean", "error"), number("99.99 %", "error"), number("max", "error")],
      report.subjects.flatMap((subject) =>
          report.looks.map((look, i) => ({cells: cells(subject.name, look), first: i === 0}))));
}

// ---- looks and physical

function lookPlot() {
  return plotFigure({
    title: "Looks and physical",
    errorAxis: "mean difference from physical",
    points: report.looks_beside_physical.map((row) => ({
      time: row.ns_per_pixel, error: row.error.mean, series: row.look, label: row.look === "fast" ? row.subject : "",
      about: about(row.look + " on " + row.subject, row.ns_per_pixel, row.error.mean),
    })),
  }, "A marker per look and subject; the subjects are named beside ", code("fast"),
      ", and under the pointer. Both axes are logarithmic; ", code("physical"),
      " itself, without a difference, is in the band 0.");
}

function differences() {
  return report.looks_beside_physical
      .filter((row) => row.subject === firstSubject.name && row.differs.length > 0)
      .flatMap((row) => [element("dt", {}, code(row.look)), element("dd", {}, row.differs.join("; "))]);
}

function lookTable() {
  const rows = report.looks_beside_physical;
  const physical = (subject) => rows.find((row) => row.subject === subject && row.look === "physical")?.ns_per_pixel;
  return table("Values above 4 count as 4.",
      [word("subject"), word("look"), number("time", "ns/pixel"), number("of physical", "time"),
       number("mean", "difference"), number("99 %", "difference"), number("99.99 %", "difference"),
       number("max", "difference")],
      rows.map(({subject, look, ns_per_pixel, error}) => ({
        cells: [subject, look, ns_per_pixel, percent(ns_per_pixel / physical(subject)), error.mean, error.p99,
                error.p99_99, error.max],
        first: look === report.looks[0],
      })));
}

// ---- models of refraction and the truth

// "snell march, shorten" is the point "march" of the series "rejection shorten".
function truthPlot(over, statistic, front) {
  const rows = report.refraction_beside_truth.rows.filter((row) => row.ns_per_pixel !== null);
  return plotFigure({
    title: "Models of refraction and a path-traced truth, " + over,
    errorAxis: "mean error over mean truth, " + over,
    hasFront: true,
    points: rows.map((row) => {
      const [way, rejection] = row.choice.split(", ");
      return {time: row.ns_per_pixel, error: row[statistic], label: way.replace(/^snell /, ""),
              series: rejection ? "rejection " + rejection : row.choice, onFront: row[front],
              about: about(row.choice, row.ns_per_pixel, row[statistic])};
    }),
  }, frontCaption);
}

function truthTable() {
  return table("Mean |picture - truth| over mean truth, values above 4 counted as 4. Highlighted: on the Pareto front of " +
      "time and error over all wet pixels.",
      [word("refraction, rejection"), number("time", "ns/pixel"), number("all wet", "error"),
       number("in frame", "error"), word("Pareto front")],
      report.refraction_beside_truth.rows.map((row) => ({
        cells: [row.choice, row.ns_per_pixel, percent(row.relative_error_wet, 2),
                percent(row.relative_error_in_frame, 2),
                [row.on_front_wet ? "all wet" : [], row.on_front_in_frame ? "in frame" : []].flat().join(", ") || "-"],
        marked: row.on_front_wet,
      })));
}

// ---- models and traced light

function tracedPlot() {
  return plotFigure({
    title: "Looks and traced light",
    errorAxis: "FLIP, mean",
    points: report.models_beside_traced_light.filter((row) => row.parameter === null).map((row) => ({
      time: row.ns_per_pixel, error: row.flip, series: row.look, label: row.look === "physical" ? row.subject : "",
      about: about(row.look + " on " + row.subject, row.ns_per_pixel, row.flip),
    })),
  }, "A marker per look and scene; the scenes are named beside ", code("physical"), ". Both axes are logarithmic.");
}

function modelTable(caption, first, second, rows) {
  return table(caption,
      [word(first), word(second), number("time", "ns/pixel"), number("mean", "error"), number("RMSE"), number("relMSE"),
       number("SSIM"), number("FLIP"), number("HDR-FLIP"), number("flicker", "mean"), number("off", "median px"),
       number("off", "95 % px"), number("rejected", "wrongly"), number("accepted", "wrongly")],
      rows.map(({names, row, first}) => ({
        cells: [...names, row.ns_per_pixel, row.error.mean, row.rmse, row.rel_mse, row.ssim, row.flip, row.hdr_flip,
                row.flicker, row.offset_pixels.median, row.offset_pixels.p95, percent(row.wrongly_rejected, 1),
                percent(row.wrongly_accepted, 1)],
        first,
      })));
}

function tracedTable() {
  const rows = report.models_beside_traced_light.filter((row) => row.parameter === null);
  return modelTable("Every look against the traced water of physical.", "scene", "look",
      rows.map((row) => ({names: [row.subject, row.look], row, first: row.look === report.looks[0]})));
}

function tracedChoices() {
  const subject = report.models_beside_traced_light.findLast((row) => row.parameter !== null)?.subject;
  if (subject === undefined) return [];
  const rows = report.models_beside_traced_light.filter(sameLook({subject, look: "physical"}));
  return [element("h3", {}, "One parameter of physical changed, on " + subject),
          modelTable("The look physical with one parameter changed, against the same truth.", "choice", "value",
              rows.map((row) => ({names: [row.parameter ?? "physical unchanged", row.value ?? ""], row})))];
}

// ---- looks by the buffers of a plate

// For physical: error and time, from buffer to buffer.
function broughtPlot() {
  const {rows} = report.looks_by_what_is_brought;
  return plotFigure({
    title: "physical by the buffers of a plate",
    errorAxis: "mean error over mean truth, all wet pixels",
    connected: true,
    points: rows.flatMap((row, i) => row.look !== "physical" ? [] : {
      time: row.ns_per_pixel, error: row.relative_error_wet ?? Infinity, series: row.subject,
      label: startsGroup(rows, i) ? row.subject : "",
      about: about(row.subject + ", " + row.brought, row.ns_per_pixel, row.relative_error_wet),
    }),
  }, "A line per subject, from color and depth alone, at its name, to all buffers. Both axes are logarithmic.");
}

function broughtTable() {
  const {rows} = report.looks_by_what_is_brought;
  return table("Each row has the buffers of the rows above it, too. Error: mean |picture - truth| over mean truth, of " +
      "wet pixels, values above 4 counted as 4. FLIP: mean of the wet pixels.",
      [word("subject"), word("look"), long("buffers"), number("time", "ns/pixel"), number("all wet", "error"),
       number("near", "error"), number("far", "error"), number("FLIP")],
      rows.map((row, i) => {
        const first = startsGroup(rows, i);
        return {cells: [row.subject, row.look, (first ? "" : "and ") + row.brought, row.ns_per_pixel,
                        row.relative_error_wet, row.relative_error_near, row.relative_error_far, row.flip_wet], first};
      }));
}

function broughtSubjects() {
  return table("Near: wet pixels whose footprint is shorter than the waves.",
      [word("subject"), number("waves", "units long"), number("wet", "of all pixels"), number("near", "of wet pixels")],
      report.looks_by_what_is_brought.subjects.map((s) =>
          ({cells: [s.subject, s.wave_length, percent(s.wet_share), percent(s.near_share_of_wet)]})));
}

// ---- choices of the look physical

const choiceName = (row) => row.parameter === null ? "physical unchanged" : `${row.parameter} = ${row.value}`;

function choicePlot() {
  const {rows} = report.choices_of_physical, own = rows[0].ns_per_pixel;
  return plotFigure({
    title: "The look physical with one parameter changed",
    errorAxis: "mean difference from physical",
    hasFront: true,
    points: rows.map((row, i) => {
      const [operator, ...key] = (row.parameter ?? "physical unchanged").split(".");
      const label = row.parameter === null ? operator : `${key.join(".")} ${row.value}`;
      // The table has the choices that save hardly any time.
      const isNamed = row.on_front || i === 0 || row.ns_per_pixel < 0.9 * own;
      return {time: row.ns_per_pixel, error: row.error.mean, series: operator, label: isNamed ? label : "",
              about: about(choiceName(row), row.ns_per_pixel, row.error.mean), onFront: row.on_front};
    }),
  }, frontCaption + bandCaption);
}

function choiceTable() {
  const {rows} = report.choices_of_physical, own = rows[0].ns_per_pixel;
  return table("Highlighted: on the Pareto front. Values above 4 count as 4.",
      [word("choice"), number("time", "ns/pixel"), number("of physical", "time"), number("mean", "difference"),
       number("99 %", "difference"), number("max", "difference")],
      rows.map((row) => ({
        cells: [choiceName(row), row.ns_per_pixel, percent(row.ns_per_pixel / own), row.error.mean, row.error.p99,
                row.error.max],
        marked: row.on_front,
      })));
}

// ---- error budgets

function budgetPlots() {
  const waters = [...new Set(report.error_budgets.map((row) => row.water))];
  return waters.flatMap((water) => {
    const rows = report.error_budgets.filter((row) => row.water === water);
    if (!rows.some((row) => row.error.max > 0)) {
      return element("p", {}, water + ": no budget changed a pixel.");
    }
    return plotFigure({
      title: "Error budgets, " + water,
      errorAxis: "largest error measured",
      connected: true,
      points: rows.map((row) => ({
        time: row.ns_per_pixel, error: row.error.max, series: row.subject, label: plainNumber(row.max_error),
        about: about(`${row.subject}, budget ${plainNumber(row.max_error)}`, row.ns_per_pixel, row.error.max),
      })),
    }, water + ": each line is a subject, each marker a budget." + bandCaption);
  });
}

function budgetTable() {
  const exact = (row) => report.error_budgets.find((other) =>
      other.subject === row.subject && other.water === row.water && other.max_error === 0)?.ns_per_pixel;
  return table("Pixels: in cells without water; in cells with a hidden bottom; in cells that leave out nothing.",
      [word("subject"), word("water"), number("budget", "error"), number("time", "ns/pixel"),
       number("of exact", "time"), number("mean", "error"), number("max", "error"), number("bound", "error"),
       number("dry", "of pixels"), number("opaque", "of pixels"), number("full", "of pixels")],
      report.error_budgets.map((row) => ({
        cells: [row.subject, row.water, shown(row.max_error, plainNumber(row.max_error)), row.ns_per_pixel,
                percent(row.ns_per_pixel / exact(row)), row.error.mean, row.error.max, row.bound,
                percent(row.dry_share), percent(row.opaque_share), percent(row.full_share)],
        first: row.max_error === 0,
      })));
}

// ---- the machine

function machineFacts() {
  const {machine, build, settings: {rounds, threads}} = report;
  return Object.entries({
    "processor": machine.processor,
    "cores": machine.cores,
    "instruction sets": machine.simd.join(", "),
    "system": `${machine.system}, kernel ${machine.kernel}`,
    "limpid": build.limpid,
    "compiler": `${build.compiler}, build type ${build.type}`,
    "libraries": build.libraries,
    "rounds": rounds,
    "threads": threads === 1 ? "1" : `1, or ${threads} where noted`,
  }).flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]);
}

// ---- the page

function removeUnless(rows, id) {
  if (rows.length > 0) return;
  document.getElementById(id).remove();
  document.querySelector(`nav a[href="#${id}"]`).remove();
}

// Empty sections are removed first; put() finds no slot of theirs, and makes nothing.
removeUnless(report.looks_by_runner, "runners");
removeUnless(report.looks_beside_physical, "looks");
removeUnless(report.refraction_beside_truth.rows, "truth");
removeUnless(report.models_beside_traced_light, "traced");
removeUnless(report.looks_by_what_is_brought.rows, "brought");
removeUnless(report.choices_of_physical.rows, "choices");
removeUnless(report.error_budgets, "budgets");

const {made, build, machine} = report;
fill("made", `${made}, limpid ${build.limpid}, ${machine.processor}, ${machine.cores} cores`);
fill("summary", ...summary());
for (const gallery of document.querySelectorAll("[data-figures]")) {
  const name = gallery.dataset.figures;
  report.figures[name].forEach(({caption, width, height}, i) => gallery.append(element("figure", {},
      element("img", {alt: caption, width, height, src: "data:image/jpeg;base64," + pictures[name][i]}),
      element("figcaption", {}, caption))));
}
put("subject_table", subjectTable);
put("runner_plot", runnerPlot);
put("runner_table", runnerTable);
put("heat_legend", () => heatLegend(report.heat_scale));
put("look_plot", lookPlot);
put("first_subject", () => firstSubject.name);
put("differs", () => element("dl", {class: "facts"}, ...differences()));
put("look_table", lookTable);
put("in_frame_share", () => percent(report.refraction_beside_truth.in_frame_share).text);
put("wet_plot", () => truthPlot("all wet pixels", "relative_error_wet", "on_front_wet"));
put("in_frame_plot", () => truthPlot("in frame", "relative_error_in_frame", "on_front_in_frame"));
put("truth_table", truthTable);
put("traced_plot", tracedPlot);
put("traced_table", tracedTable);
put("traced_choices", tracedChoices);
put("samples", () => String(report.looks_by_what_is_brought.samples_a_pixel));
put("brought_plot", broughtPlot);
put("brought_table", broughtTable);
put("brought_subjects", broughtSubjects);
put("choices_subject", () => code(report.choices_of_physical.subject));
put("choice_plot", choicePlot);
put("choice_table", choiceTable);
put("budget_plots", budgetPlots);
put("budget_table", budgetTable);
put("rounds", () => String(report.settings.rounds));
fill("machine", ...machineFacts());
