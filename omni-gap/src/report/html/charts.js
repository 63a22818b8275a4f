// Signals over time, and residuals over what shows them, that can be read under the pointer, zoomed and switched: each
// `figure.chart` is drawn as SVG, which stays for paper and for readers without scripts, and carries its numbers, of which
// this makes a chart of uPlot's.
(() => {
  "use strict";
  const HEIGHT = 180, GUTTER = 46, STEP = 0.25;
  // the least that is shown: so many points, or this share of a chart that has few
  const FEWEST = 16, LEAST = 0.25;

  const ink = (name, of) => getComputedStyle(of).getPropertyValue(name).trim();
  const shown = (value) => (value == null ? "–" : Number(value.toPrecision(4)).toString());
  const element = (tag, attributes, text = "") => {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    made.textContent = text;
    return made;
  };

  const within = (ends) => (ends ? ` (${ends.map(shown).join(" to ")})` : "");

  // what a class means to the eye: a measurement is broad, what the file says is dashed
  const line = (series, key) => ({
    label: series.name,
    stroke: () => ink("--c", key),
    width: series.ink === "measured" ? 3.5 : 1.5,
    dash: series.ink === "nominal" ? [5, 3] : [],
    points: { show: false },
    spanGaps: true,
  });

  // a prediction begins anew at each restart: no line leads there
  const gaps = (restarts) => (chart, at, first, last, found) => {
    const times = chart.data[0];
    const broken = [];
    for (const restart of restarts) {
      const after = times.findIndex((time) => time >= restart - 1e-9);
      if (after > first && after <= last)
        broken.push([times[after - 1], times[after]].map((time) => Math.round(chart.valToPos(time, "x", true))));
    }
    return found.concat(broken);
  };

  // room for all values and their intervals
  const around = (intervals, series) => {
    const all = intervals.flat().concat(series.flatMap((one) => one.values.filter((value) => value != null)));
    const [low, high] = [Math.min(...all), Math.max(...all)], air = 0.06 * (high - low || 1);
    return [low - air, high + air];
  };

  class Group {
    constructor(around, figures, name) {
      this.around = around;
      this.name = name;
      this.charts = [];
      this.hidden = new Set();
      this.whole = null;
      this.range = null;
      this.legend();
      figures.forEach((figure) => this.chart(figure));
    }

    // the legend's keys become switches; beside them stand those of the axis, for fingers and keyboards
    legend() {
      const legend = this.around.querySelector(".legend");
      for (const key of legend.querySelectorAll(".key")) {
        const button = element("button", { type: "button", class: key.className, "aria-pressed": "true" }, key.textContent);
        button.addEventListener("click", () => this.toggle(button));
        key.replaceWith(button);
      }
      const time = element("span", { class: "time", role: "group", "aria-label": "Stretch shown" });
      const buttons = [
        ["◀", "lower", () => this.move(-STEP)],
        ["▶", "higher", () => this.move(STEP)],
        ["+", "closer", () => this.scale(0.5)],
        ["−", "farther", () => this.scale(2)],
        ["all", "the whole stretch", () => this.show(null)],
      ];
      for (const [text, name, act] of buttons) {
        const button = element("button", { type: "button", "aria-label": name, title: name }, text);
        button.addEventListener("click", act);
        time.append(button);
      }
      legend.append(time);
    }

    toggle(button) {
      const name = button.textContent, on = this.hidden.delete(name);
      if (!on) this.hidden.add(name);
      button.setAttribute("aria-pressed", String(on));
      for (const { chart, series } of this.charts)
        series.forEach((one, at) => one.name === name && chart.setSeries(at + 1, { show: on }));
    }

    move(share) {
      const [from, to] = this.range ?? this.whole;
      const by = share * (to - from);
      const [first, last] = this.whole;
      const held = Math.max(first - from, Math.min(last - to, by));
      this.show([from + held, to + held]);
    }

    scale(factor) {
      const [from, to] = this.range ?? this.whole;
      const [first, last] = this.whole;
      const least = Math.min(FEWEST * this.step, LEAST * (last - first));
      const half = 0.5 * Math.max(factor * (to - from), least);
      const middle = 0.5 * (from + to);
      const next = [Math.max(first, middle - half), Math.min(last, middle + half)];
      this.show(next[0] <= first && next[1] >= last ? null : next);
    }

    // all charts of a group show the same time
    show(range) {
      this.range = range;
      const [min, max] = range ?? this.whole;
      for (const { chart } of this.charts) chart.setScale("x", { min, max });
    }

    chart(figure) {
      const { unit, over, t, series, restarts, intervals = [] } = JSON.parse(figure.querySelector("script").textContent);
      if (t.length < 2) return;
      const drawing = figure.querySelector("svg");
      const place = element("div", { class: "live", role: "img", "aria-label": drawing.getAttribute("aria-label") });
      const read = element("p", { class: "read" });
      figure.append(place, read);
      const keys = series.map((one) => place.appendChild(element("i", { class: one.ink, hidden: "" })));
      const axis = (more) => ({
        stroke: () => ink("--soft", place),
        grid: { stroke: () => ink("--grid", place), width: 1 },
        ticks: { show: false },
        font: "11.5px system-ui, sans-serif",
        ...more,
      });
      const broken = gaps(restarts);
      const options = {
        width: figure.clientWidth || 420,
        height: HEIGHT,
        padding: [8, over.unit.length > 1 ? 34 : 8, 0, 0],
        legend: { show: false },
        scales: { x: { time: false }, ...(intervals.length ? { y: { range: around(intervals, series) } } : {}) },
        cursor: {
          sync: { key: this.name },
          points: { show: false },
          drag: { x: true, y: false, setScale: false },
          bind: { dblclick: () => () => (this.show(null), null) },
        },
        axes: [
          axis({ values: (_, ticks) => ticks.map((tick, at) => (at + 1 < ticks.length ? tick : `${tick} ${over.unit}`)), grid: { show: false }, size: 24 }),
          axis({ size: GUTTER }),
        ],
        series: [{}, ...series.map((one, at) => ({ ...line(one, keys[at]), ...(at === 0 && intervals.length ? { paths: () => null } : {}), ...(one.ink === "measured" ? {} : { gaps: broken }) }))],
        hooks: {
          setSelect: [(chart) => this.selected(chart)],
          setCursor: [(chart) => (read.textContent = this.reading(chart, series, { unit, over, intervals }))],
          drawClear: [(chart) => uprights(chart, restarts, ink("--quiet", place))],
          draw: [(chart) => intervals.length && whiskers(chart, intervals, ink("--c", keys[0]))],
        },
      };
      const chart = new uPlot(options, [t, ...series.map((one) => one.values)], place);
      this.charts.push({ chart, series });
      this.whole ??= [t[0], t[t.length - 1]];
      this.step ??= (t[t.length - 1] - t[0]) / (t.length - 1);
      figure.classList.add("alive");
      new ResizeObserver(() => figure.clientWidth > 0 && chart.setSize({ width: figure.clientWidth, height: HEIGHT })).observe(figure);
    }

    selected(chart) {
      const { left, width } = chart.select;
      if (width < 4) return;
      const range = [left, left + width].map((at) => chart.posToVal(at, "x"));
      chart.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      this.show(range);
    }

    reading(chart, series, { unit, over, intervals }) {
      const at = chart.cursor.idx;
      if (at == null || chart.cursor.left < 0) return "";
      const values = series
        .map((one, k) => [one.name, chart.data[k + 1][at], k === 0 && intervals[at]])
        .filter(([name]) => !this.hidden.has(name))
        .map(([name, value, ends]) => `${name} ${shown(value)}${within(ends)}`);
      return `${shown(chart.data[0][at])} ${over.unit}: ${values.join(", ")} ${unit}`;
    }
  }

  // the values of the first series as dots, each with its interval
  const whiskers = (chart, intervals, stroke) => {
    if (!chart.series[1].show) return;
    const { ctx, bbox } = chart;
    ctx.save();
    ctx.beginPath();
    const beside = 5 * devicePixelRatio;
    ctx.rect(bbox.left - beside, bbox.top, bbox.width + 2 * beside, bbox.height);
    ctx.clip();
    ctx.strokeStyle = ctx.fillStyle = stroke;
    ctx.lineWidth = 1.5 * devicePixelRatio;
    intervals.forEach((ends, at) => {
      const x = chart.valToPos(chart.data[0][at], "x", true);
      const [low, high, value] = [...ends, chart.data[1][at]].map((y) => chart.valToPos(y, "y", true));
      ctx.beginPath();
      ctx.moveTo(x, low);
      ctx.lineTo(x, high);
      ctx.stroke();
      ctx.beginPath();
      ctx.arc(x, value, 3.5 * devicePixelRatio, 0, 2 * Math.PI);
      ctx.fill();
    });
    ctx.restore();
  };

  // where predictions restart
  const uprights = (chart, restarts, stroke) => {
    const { ctx, bbox } = chart;
    ctx.save();
    ctx.strokeStyle = stroke;
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([devicePixelRatio, 3 * devicePixelRatio]);
    ctx.beginPath();
    for (const restart of restarts) {
      const x = Math.round(chart.valToPos(restart, "x", true));
      if (x < bbox.left || x > bbox.left + bbox.width) continue;
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
    }
    ctx.stroke();
    ctx.restore();
  };

  // charts belong together that stand under one legend
  const groups = new Map();
  for (const figure of document.querySelectorAll("figure.chart")) {
    let around = figure.parentElement;
    while (around && !around.querySelector(".legend")) around = around.parentElement;
    if (around) groups.set(around, [...(groups.get(around) ?? []), figure]);
  }
  const all = [...groups].map(([around, figures], at) => new Group(around, figures, `charts-${at}`));
  const redraw = () => all.forEach(({ charts }) => charts.forEach(({ chart }) => chart.redraw()));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
})();
