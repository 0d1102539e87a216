// Put into a copy of the report's page by report_test.cpp: what a browser makes of the page, as JSON
// in an element of its own.
var complaints = [];
window.addEventListener("error", function (event) { complaints.push(event.message); });
window.addEventListener("load", function () {
  function name(element) {
    return element.tagName + "." + (element.getAttribute("class") || "") + " '" +
        element.textContent.trim().slice(0, 30) + "'";
  }
  function meet(a, b) { // by more than a pixel
    return Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 &&
        Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  }
  function within(a, b) {
    return a.left >= b.left - 1 && a.right <= b.right + 1 && a.top >= b.top - 1 &&
        a.bottom <= b.bottom + 1;
  }
  var wide = Array.from(document.body.querySelectorAll("*")).filter(function (element) {
    var scroller = element.parentElement.closest(".scroll");
    return !scroller && element.getBoundingClientRect().right > window.innerWidth + 1;
  }).map(name);
  var plots = Array.from(document.querySelectorAll("svg.plot")).map(function (svg) {
    var box = svg.getBoundingClientRect(), texts = Array.from(svg.querySelectorAll("text"));
    var boxes = texts.map(function (text) { return text.getBoundingClientRect(); });
    var overlaps = [], outside = [];
    texts.forEach(function (text, i) {
      if (!within(boxes[i], box)) outside.push(name(text));
      for (var j = 0; j < i; ++j) {
        if (meet(boxes[i], boxes[j])) overlaps.push(name(texts[j]) + " and " + name(text));
      }
    });
    return {
      title: svg.getAttribute("aria-label"), width: box.width, height: box.height,
      texts: texts.length, markers: svg.querySelectorAll("g > .m").length,
      overlaps: overlaps, outside: outside,
    };
  });
  // A click on a column's head sorts by it, a second one the other way.
  var table = document.querySelector("#runners table"), buttons = table.querySelectorAll("button");
  function column() {
    return Array.from(table.tBodies[0].rows).map(function (row) {
      return Number(row.children[2].dataset.v);
    });
  }
  buttons[2].click();
  var rising = column();
  buttons[2].click();
  var falling = column();

  var result = document.createElement("script");
  result.type = "application/json";
  result.id = "result";
  result.textContent = JSON.stringify({
    complaints: complaints, wide: wide, plots: plots, rising: rising, falling: falling,
    window_width: window.innerWidth, page_width: document.documentElement.scrollWidth,
    page_height: document.documentElement.scrollHeight,
    broken_images: Array.from(document.images).filter(function (image) {
      return image.naturalWidth === 0;
    }).length,
    images: document.images.length,
  });
  document.body.appendChild(result);
});
